//! Open-RMF's mutex group of a lane, and its release after replanning: rmf_ros2, issue 448 and pull request 490. Robots
//! cross one lane from two bays. A robot locks the lane, enters, and releases it when it leaves. A robot in the lane may
//! be told to plan anew; the first step of its new plan is to a midpoint of the lane, which belongs to no mutex group.
//! The phase that moves it releases whatever the steps ahead do not need, and so the lane that it stands in. Mended, the
//! phase releases nothing while the robot is at a midpoint.

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Conditions {
    /// A robot at a midpoint keeps its lock.
    keeps_at_midpoint: bool,
    /// A robot that has left the lane releases it.
    releases: bool,
    /// A robot enters only with the lock.
    locks: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
enum Place {
    Bay,
    Lane,
    Midpoint,
    Across,
}
compact! { Place: Bay, Lane, Midpoint, Across }

/// How many robots there are.
struct Robots(usize);

impl fmt::Display for Robots {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} robots, one lane, each plans anew once at most, every order", self.0)
    }
}

struct Lane(Conditions, usize);

/// Where robots are, and who holds the lock.
type State = (Vec<Place>, Option<usize>);

impl Protocol for Lane {
    type Rule = Conditions;
    type Bound = Robots;
    type State = State;
    const DEMANDS: &'static [Demand<Self>] = &[
        Demand::always("one robot is in the lane", |_, _, (places, _): &State| {
            places.iter().filter(|place| matches!(place, Place::Lane | Place::Midpoint)).count() <= 1
        }),
        Demand::eventually("every robot is across", |_, (places, _): &State| {
            places.iter().all(|&place| place == Place::Across)
        }),
    ];
    const COVERS: &'static [&'static str] = &["locks", "enters", "leaves", "plans anew"];

    fn new(&rule: &Conditions, &Robots(robots): &Robots) -> Result<Self, MethodError> {
        Ok(Self(rule, robots))
    }

    fn starts(&self) -> impl Iterator<Item = State> {
        iter::once((vec![Place::Bay; self.1], None))
    }

    fn moves(&self, (places, holder): &State) -> Vec<Move<State>> {
        let is_free = !places.iter().any(|place| matches!(place, Place::Lane | Place::Midpoint));
        let with = |me: usize, place: Place, holder: Option<usize>| {
            let mut to = places.clone();
            to[me] = place;
            (to, holder)
        };
        let mut moves = Vec::new();
        for (me, &place) in places.iter().enumerate() {
            let holds = *holder == Some(me) || !self.0.locks;
            let released = holder.filter(|&holder| holder != me || !self.0.releases);
            match place {
                Place::Bay | Place::Lane | Place::Midpoint if holder.is_none() && self.0.locks => {
                    moves.push(Move::of(me, "locks", with(me, place, Some(me))));
                }
                Place::Bay if holds && (is_free || !self.0.locks) => {
                    moves.push(Move::of(me, "enters", with(me, Place::Lane, *holder)));
                }
                Place::Lane | Place::Midpoint if holds => {
                    moves.push(Move::of(me, "leaves", with(me, Place::Across, released)));
                }
                Place::Bay | Place::Lane | Place::Midpoint | Place::Across => {}
            }
            if place == Place::Lane {
                let kept = holder.filter(|&holder| holder != me || self.0.keeps_at_midpoint);
                moves.push(Move::fault("plans anew", with(me, Place::Midpoint, kept)));
            }
        }
        moves
    }

    fn draw(&self, (places, holder): &State) -> String {
        let at = |wanted: &[Place]| {
            let here = places.iter().zip('0'..).filter(|(place, _)| wanted.contains(place));
            here.map(|(_, name)| name).collect::<String>()
        };
        let lane = at(&[Place::Lane, Place::Midpoint]);
        let lock = holder.map_or("free".to_owned(), |holder| format!("of {holder}"));
        format!("[{:2}]={lane:=<2}=[{:2}]\nlock {lock}", at(&[Place::Bay]), at(&[Place::Across]))
    }
}

const RULE: Conditions = Conditions { keeps_at_midpoint: true, releases: true, locks: true };
const MENDED: NamedRule<Conditions> = NamedRule::new("mended", RULE);
const BEFORE: NamedRule<Conditions> =
    NamedRule::new("before the pull request", Conditions { keeps_at_midpoint: false, ..RULE });
const HOLDS_ON: NamedRule<Conditions> =
    NamedRule::new("never releases", Conditions { releases: false, ..RULE });
const NO_LOCK: NamedRule<Conditions> = NamedRule::new("no lock", Conditions { locks: false, ..RULE });

/// The rule.
pub(crate) static ENTRY: Entry = Entry {
    name: "rmf-lane",
    title: "Open-RMF's lane mutex",
    source: "[rmf_ros2 issue 448](https://github.com/open-rmf/rmf_ros2/issues/448), mended by \
             [pull request 490](https://github.com/open-rmf/rmf_ros2/pull/490), 2025, problem 1",
    promises: &[
        promise(
            "LANE-1",
            "At most one robot MUST be in the lane.",
            &[&Check::new(MENDED, &Keeps::<Lane>(Robots(3), 0), Holds, &[NO_LOCK])],
        ),
        promise(
            "LANE-2",
            "Every robot MUST come across.",
            &[
                &Check::new(BEFORE, &Keeps::<Lane>(Robots(2), 1), Refuted, &[]),
                &Check::new(MENDED, &Keeps::<Lane>(Robots(3), 1), Holds, &[BEFORE, HOLDS_ON]),
            ],
        ),
    ],
};
