//! Two robots that patrol between two places and swap: the situation of rmf_ros2 issue 503, which is open. Its cause is
//! not settled there; decided here is the rule that the situation calls for: a place is reserved for one robot, and a
//! robot keeps its place until the next one is reserved for it. Two robots that want each other's place wait for ever.
//! With a waiting place to which a robot may retreat, one of them may wait there for ever while the other one goes to
//! and fro; where a place that a waiting robot wants is kept for it, both come to where they want.

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Conditions {
    /// A robot whose destination is reserved for another one may go to the waiting place.
    retreats: bool,
    /// A robot that has gone gives its place up.
    gives_up: bool,
    /// A place that a waiting robot wants is for that robot.
    queues: bool,
}

/// How many robots there are, each with a destination that another one starts in.
struct Robots(u8);

impl fmt::Display for Robots {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{0} robots, {0} places and one to wait in, every order", self.0)
    }
}

struct Places(Conditions, u8);

/// Where each robot is and goes to, and for whom each place is reserved; the last place is to wait in.
type State = (Vec<(u8, u8)>, Vec<Option<u8>>);

impl Protocol for Places {
    type Rule = Conditions;
    type Bound = Robots;
    type State = State;
    const DEMANDS: &'static [Demand<Self>] = &[
        Demand::always("no two robots are in one place", |_, _, (robots, _): &State| {
            let apart = |one: usize| (0..one).all(|other| robots[one].0 != robots[other].0);
            (0..robots.len()).all(apart)
        }),
        Demand::again_and_again("every robot comes to its destination", |places, (robots, _): &State| {
            // A robot's destination is another one once it is there: it owes a visit to each place.
            let bit = |robot: usize, place: u8| 1 << (robot * usize::from(places.1) + usize::from(place));
            let all = (0..robots.len()).flat_map(|robot| (0..places.1).map(move |place| (robot, place)));
            all.filter(|&(robot, place)| robots[robot].0 != place)
                .fold(0, |set, (robot, place)| set | bit(robot, place))
        }),
    ];

    fn new(&rule: &Conditions, &Robots(robots): &Robots) -> Result<Self, MethodError> {
        let fits = (2..=4).contains(&robots);
        fits.then_some(Self(rule, robots)).ok_or_else(|| MethodError::new("there are 2 to 4 robots"))
    }

    fn starts(&self) -> impl Iterator<Item = State> {
        let robots = (0..self.1).map(|robot| (robot, (robot + 1) % self.1)).collect();
        iter::once((robots, (0..self.1).map(Some).chain([None]).collect()))
    }

    fn moves(&self, (robots, reserved): &State) -> Vec<Move<State>> {
        let mut moves = Vec::new();
        let wait = self.1;
        for (me, &(here, goal)) in robots.iter().enumerate() {
            let name = me as u8;
            let go = |place: u8| {
                let (mut robots, mut reserved) = (robots.clone(), reserved.clone());
                reserved[usize::from(place)] = Some(name);
                let is_over = self.0.gives_up || place == goal && here == wait;
                if is_over {
                    reserved[usize::from(here)] = None;
                }
                robots[me] = if place == goal { (place, (place + 1) % self.1) } else { (place, goal) };
                (robots, reserved)
            };
            let is_free = |place: u8| {
                let is_wanted = robots.contains(&(wait, place)) && here != wait;
                reserved[usize::from(place)].is_none_or(|other| other == name)
                    && !(is_wanted && self.0.queues)
            };
            if is_free(goal) {
                moves.push(Move::of(me, "goes on", go(goal)));
            } else if here != wait && is_free(wait) && self.0.retreats {
                moves.push(Move::of(me, "retreats", go(wait)));
            }
        }
        moves
    }

    fn draw(&self, (robots, reserved): &State) -> String {
        let place = |(place, owner): (usize, &Option<u8>)| {
            let here = robots.iter().zip('0'..).find(|(robot, _)| usize::from(robot.0) == place);
            let owner = owner.map_or("free".to_owned(), |owner| format!("for {owner}"));
            let name = if place == usize::from(self.1) { "waiting" } else { "place" };
            format!("{name} {place}: {} ({owner})\n", here.map_or('.', |(_, name)| name))
        };
        reserved.iter().enumerate().map(place).collect()
    }
}

const RULE: Conditions = Conditions { retreats: true, gives_up: true, queues: true };
const QUEUES: NamedRule<Conditions> = NamedRule::new("retreats and queues", RULE);
const RETREATS: NamedRule<Conditions> = NamedRule::new("retreats", Conditions { queues: false, ..RULE });
const HOLDS_ON: NamedRule<Conditions> =
    NamedRule::new("holds and waits", Conditions { retreats: false, ..RULE });
const KEEPS: NamedRule<Conditions> =
    NamedRule::new("retreats and keeps its place", Conditions { gives_up: false, ..RULE });

/// The rule.
pub(crate) static ENTRY: Entry = Entry {
    name: "rmf-swap",
    title: "two robots that swap",
    source: "the situation of [rmf_ros2 issue 503](https://github.com/open-rmf/rmf_ros2/issues/503), 2026; hold and \
             wait: Coffman, Elphick, Shoshani, *System Deadlocks*, ACM Computing Surveys 3, 1971",
    promises: &[
        promise(
            "SWAP-1",
            "No two robots MUST be in one place.",
            &[&Check::new(QUEUES, &Keeps::<Places>(Robots(3), 0), Holds, &[])],
        ),
        promise(
            "SWAP-2",
            "Every robot MUST come to its destination, again and again.",
            &[
                &Check::new(HOLDS_ON, &Keeps::<Places>(Robots(2), 1), Refuted, &[]),
                &Check::new(RETREATS, &Keeps::<Places>(Robots(2), 1), Refuted, &[]),
                &Check::new(QUEUES, &Keeps::<Places>(Robots(2), 1), Holds, &[HOLDS_ON, KEEPS, RETREATS]),
                &Check::new(QUEUES, &Keeps::<Places>(Robots(3), 1), Holds, &[HOLDS_ON, KEEPS, RETREATS]),
            ],
        ),
    ],
};
