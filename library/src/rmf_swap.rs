//! Two robots that patrol between two places and swap: the situation of rmf_ros2 issue 503, which is open. Its cause is
//! not settled there; decided here is the rule that the situation calls for: a place is reserved for one robot, and a
//! robot keeps its place until the next one is reserved for it. Two robots that want each other's place wait for ever.
//! With a waiting place to which a robot may retreat, one of them may wait there for ever while the other one goes to
//! and fro; where a place that a waiting robot wants is kept for it, both come to where they want.

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy)]
#[expect(clippy::struct_excessive_bools, reason = "each is a condition of the rule")]
struct Conditions {
    /// A robot whose destination is reserved for another one may go to the waiting place.
    retreats: bool,
    /// A robot that has gone gives its place up.
    gives_up: bool,
    /// A place that a waiting robot wants is for that robot.
    queues: bool,
    /// A robot goes to a place only if it is reserved for no other one.
    reserves: bool,
}

bound! {
    /// Robots, each with a destination that another one starts in.
    Robots { robots: u8 } "{robots} robots, {robots} places and one to wait in, every order";
    (2..=4).contains(&robots), "there are 2 to 4 robots"
}

/// Where each robot is and goes to, and for whom each place is reserved; the last place is to wait in.
type State = (Vec<(u8, u8)>, Vec<Option<u8>>);

impl Protocol for Conditions {
    type Bound = Robots;
    type State = State;
    demands! {
        always "no two robots are in one place", |_, _, _, (robots, _)| {
            (0..robots.len()).all(|one| (0..one).all(|other| robots[one].0 != robots[other].0))
        };
        again_and_again "every robot comes to its destination", |_, _, (robots, _)| {
            // A robot's destination is another one once it is there: it owes a visit to each place.
            let visits = (0..robots.len()).flat_map(|robot| (0..robots.len()).map(move |place| (robot, place)));
            let owed = visits.filter(|&(robot, place)| usize::from(robots[robot].0) != place);
            set(owed.map(|(robot, place)| robot * robots.len() + place))
        };
    }

    fn starts(&self, &Robots { robots }: &Robots) -> impl IntoIterator<Item = State> {
        let placed = (0..robots).map(|robot| (robot, (robot + 1) % robots)).collect();
        [(placed, (0..robots).map(Some).chain([None]).collect())]
    }

    fn moves(&self, &Robots { robots: wait }: &Robots, (robots, reserved): &State) -> Vec<Move<State>> {
        let act = |(me, &(here, goal)): (usize, &(u8, u8))| {
            let name = me as u8;
            let go = |place: u8| {
                let mut reserved = with(reserved, usize::from(place), Some(name));
                if self.gives_up || place == goal && here == wait {
                    reserved[usize::from(here)] = None;
                }
                let next = if place == goal { (place + 1) % wait } else { goal };
                (with(robots, me, (place, next)), reserved)
            };
            let is_free = |place: u8| {
                let is_wanted = robots.contains(&(wait, place)) && here != wait;
                let is_reserved = reserved[usize::from(place)].is_some_and(|other| other != name);
                !(is_reserved && self.reserves || is_wanted && self.queues)
            };
            let retreats = !is_free(goal) && here != wait && is_free(wait) && self.retreats;
            let goes_on = Move::of(me, "goes on", go(goal)).when(is_free(goal));
            goes_on.or(Move::of(me, "retreats", go(wait)).when(retreats))
        };
        robots.iter().enumerate().filter_map(act).collect()
    }

    fn draw(&self, bound: &Robots, (robots, reserved): &State) -> String {
        let place = |(place, owner): (u8, &Option<u8>)| {
            let here = names(robots, |robot| robot.0 == place);
            let owner = owner.map_or("free".to_owned(), |owner| format!("for {owner}"));
            let name = if place == bound.robots { "waiting" } else { "place" };
            format!("{name} {place}: {here:.<1} ({owner})\n")
        };
        (0..).zip(reserved).map(place).collect()
    }
}

const RULE: Conditions = Conditions { retreats: true, gives_up: true, queues: true, reserves: true };

entry! { Conditions: "rmf-swap", "two robots that swap", "SWAP",
    "the situation of [rmf_ros2 issue 503](https://github.com/open-rmf/rmf_ros2/issues/503), 2026; hold and wait: \
     Coffman, Elphick, Shoshani, *System Deadlocks*, ACM Computing Surveys 3, 1971";
    QUEUES = "retreats and queues", RULE;
    RETREATS = "retreats", Conditions { queues: false, ..RULE };
    HOLDS_ON = "holds and waits", Conditions { retreats: false, ..RULE };
    KEEPS = "retreats and keeps its place", Conditions { gives_up: false, ..RULE };
    RUSHES = "goes to any place", Conditions { reserves: false, ..RULE };
    1: "No two robots MUST be in one place." {
        Holds QUEUES within Robots::of(3), not RUSHES;
    }
    2: "Every robot MUST come to its destination, again and again." {
        Refuted HOLDS_ON within Robots::of(2);
        Refuted RETREATS within Robots::of(2);
        Holds QUEUES within Robots::of(2), not HOLDS_ON, KEEPS, RETREATS;
        Holds QUEUES within Robots::of(3), not HOLDS_ON, KEEPS, RETREATS;
    }
}
