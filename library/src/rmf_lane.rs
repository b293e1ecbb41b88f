//! Open-RMF's mutex group of a lane, and its release after replanning: rmf_ros2, issue 448 and pull request 490. Robots
//! cross one lane from two bays. A robot locks the lane, enters, and releases it when it leaves; with the lock it
//! enters without a look at who is in the lane. A robot in the lane may be told to plan anew; the first step of its new
//! plan is to a midpoint of the lane, which belongs to no mutex group. The phase that moves it releases whatever the
//! steps ahead do not need, and so the lane that it stands in: another robot may lock it and enter. Mended, the phase
//! releases nothing while the robot is at a midpoint.

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy)]
struct Conditions {
    /// A robot at a midpoint keeps its lock.
    keeps_at_midpoint: bool,
    /// A robot that has left the lane releases it.
    releases: bool,
    /// A robot enters only with the lock.
    locks: bool,
}

compact! { enum Place { Bay, Lane, Midpoint, Across } }

bound! { Robots { robots: usize } "{robots} robots, one lane, each plans anew once at most, every order" }

/// Where robots are, and who holds the lock.
type State = (Vec<Place>, Option<usize>);

fn is_in_lane(place: &Place) -> bool {
    matches!(place, Place::Lane | Place::Midpoint)
}

impl Protocol for Conditions {
    type Bound = Robots;
    type State = State;
    demands! {
        always "at most one robot is in the lane",
            |_, _, _, (at, _)| at.iter().filter(|at| is_in_lane(at)).count() <= 1;
        eventually "every robot is across", |_, _, (places, _)| places.iter().all(|&place| place == Place::Across);
    }
    const COVERS: &'static [&'static str] = &["locks", "enters", "leaves", "plans anew"];

    fn starts(&self, bound: &Robots) -> impl IntoIterator<Item = State> {
        [(vec![Place::Bay; bound.robots], None)]
    }

    fn moves(&self, _: &Robots, (places, holder): &State) -> Vec<Move<State>> {
        let act = |(me, &place): (usize, &Place)| {
            let to = |place: Place, holder: Option<usize>| (with(places, me, place), holder);
            let left = |keeps: bool| holder.filter(|&holder| holder != me || keeps);
            let holds = *holder == Some(me) || !self.locks;
            let may_lock = place != Place::Across && holder.is_none() && self.locks;
            let may_enter = place == Place::Bay && holds;
            let across = to(Place::Across, left(!self.releases));
            let anew = to(Place::Midpoint, left(self.keeps_at_midpoint));
            [
                Move::of(me, "locks", to(place, Some(me))).when(may_lock),
                Move::of(me, "enters", to(Place::Lane, *holder)).when(may_enter),
                Move::of(me, "leaves", across).when(holds && is_in_lane(&place)),
                Move::fault("plans anew", anew).when(place == Place::Lane),
            ]
        };
        places.iter().enumerate().flat_map(act).flatten().collect()
    }

    fn draw(&self, _: &Robots, (places, holder): &State) -> String {
        let at = |wanted: Place| names(places, |&place| place == wanted);
        let lane = names(places, is_in_lane);
        let lock = holder.map_or("free".to_owned(), |holder| format!("of {holder}"));
        format!("[{:2}]={lane:=<2}=[{:2}]\nlock {lock}", at(Place::Bay), at(Place::Across))
    }
}

const RULE: Conditions = Conditions { keeps_at_midpoint: true, releases: true, locks: true };

entry! { Conditions: "rmf-lane", "Open-RMF's lane mutex", "LANE",
    "[rmf_ros2 issue 448](https://github.com/open-rmf/rmf_ros2/issues/448), mended by \
     [pull request 490](https://github.com/open-rmf/rmf_ros2/pull/490), 2025, problem 1";
    MENDED = "mended", RULE;
    BEFORE = "before the pull request", Conditions { keeps_at_midpoint: false, ..RULE };
    HOLDS_ON = "never releases", Conditions { releases: false, ..RULE };
    NO_LOCK = "no lock", Conditions { locks: false, ..RULE };
    1: "At most one robot MUST be in the lane." {
        Refuted BEFORE within Robots::of(2);
        Holds MENDED within Robots::of(3), not BEFORE, NO_LOCK;
    }
    2: "Every robot MUST come across." {
        Holds BEFORE within Robots::of(3), not HOLDS_ON;
        Holds MENDED within Robots::of(3), not HOLDS_ON;
    }
}
