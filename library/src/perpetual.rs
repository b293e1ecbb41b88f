//! Perpetual exploration of a ring by three robots that are alike and remember nothing: after Blin, Milani,
//! Potop-Butucaru and Tixeuil (DISC 2010), the legitimate phase of their algorithm for the fewest robots. The gaps
//! between the robots are 0, 2 and a large one. The robot ahead goes on (0, 3); the one behind the gap of 3 follows
//! (1, 2); the last one closes up (0, 2). No other robot of such a ring moves, so that the order of looks and moves does
//! not matter. From other starts robots may stand still for ever: the paper has a second phase for them.

use crate::prelude::*;

/// Which of the three moves a robot makes.
#[derive(Clone, Copy, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a condition of the rule")]
struct Conditions {
    goes_on: bool,
    follows: bool,
    closes_up: bool,
    /// The robot between the gaps 0 and 2, too, goes on: two robots may move at once.
    is_hasty: bool,
}

/// The nodes of the ring, and whether robots may start anywhere.
struct Size(u8, bool);

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let starts = if self.1 { "every start" } else { "gaps of 0 and 2" };
        write!(f, "3 robots, a ring of {} nodes, {starts}, each looks, then moves", self.0)
    }
}

struct Ring(Conditions, Size);

/// Where robots are, and to where each is about to go.
type State = [(u8, Option<u8>); 3];

impl Ring {
    /// The next node of a robot; the one where it is if it stays.
    fn wish(&self, robots: &State, me: usize) -> u8 {
        let (nodes, here) = (self.1.0, robots[me].0);
        let gap = |from: u8, to: u8| (to + nodes - from - 1) % nodes;
        let mut others: Vec<u8> = (1..3).map(|by| robots[(me + by) % 3].0).collect();
        others.sort_by_key(|&other| gap(here, other));
        let (right, across, left) = (gap(here, others[0]), gap(others[0], others[1]), gap(others[1], here));
        let (up, down) = ((here + 1) % nodes, (here + nodes - 1) % nodes);
        let far = |steps: u8| steps > 3;
        // The gaps on one side, on the other side, and across: seen from either side.
        for (near, beyond, to_near, to_beyond) in [(right, left, up, down), (left, right, down, up)] {
            match (near, beyond, across) {
                (2, large, 0) if far(large) && self.0.goes_on => return to_beyond,
                (3, 0, large) if far(large) && self.0.follows => return to_near,
                (1, large, 2) if far(large) && self.0.closes_up => return to_near,
                (2, 0, large) if far(large) && self.0.is_hasty => return to_near,
                _ => {}
            }
        }
        here
    }
}

impl Protocol for Ring {
    type Rule = Conditions;
    type Bound = Size;
    type State = State;
    const DEMANDS: &'static [Demand<Self>] = &[
        Demand::always(
            "no two robots are in one node, or change places",
            |_, before: &State, after: &State| {
                !conflicts(&before.map(|robot| robot.0), &after.map(|robot| robot.0))
            },
        ),
        Demand::again_and_again("robot 0 visits every node", |ring, robots: &State| {
            set((0..usize::from(ring.1.0)).filter(|&node| usize::from(robots[0].0) != node))
        }),
    ];

    fn new(&rule: &Conditions, &Size(nodes, is_any): &Size) -> Result<Self, MethodError> {
        let fits = (9..=16).contains(&nodes);
        MethodError::unless(fits, format_args!("a ring has 9 to 16 nodes, not {nodes}"))?;
        Ok(Self(rule, Size(nodes, is_any)))
    }

    fn starts(&self) -> impl Iterator<Item = State> {
        let from = |second: u8| (second + 1..self.1.0).map(move |third| [0, second, third]);
        let any: Vec<[u8; 3]> = (1..self.1.0).flat_map(from).collect();
        let cells = if self.1.1 { any } else { vec![[0, 1, 4]] };
        cells.into_iter().map(|cells| cells.map(|cell| (cell, None)))
    }

    fn moves(&self, robots: &State) -> Vec<Move<State>> {
        let go = |me: usize| {
            let mut to = *robots;
            to[me] = match robots[me] {
                (_, Some(next)) => (next, None),
                (here, None) => (here, Some(self.wish(robots, me)).filter(|&next| next != here)),
            };
            let words = if robots[me].1.is_some() { "moves" } else { "looks" };
            Move::of(me, words, to)
        };
        (0..3).map(go).filter(|next| next.to != *robots).collect()
    }

    fn draw(&self, robots: &State) -> String {
        let sign = |node: u8| robots.iter().position(|robot| robot.0 == node).map(|robot| b'0' + robot as u8);
        (0..self.1.0).map(|node| char::from(sign(node).unwrap_or(b'.'))).collect()
    }
}

const RULE: Conditions = Conditions { goes_on: true, follows: true, closes_up: true, is_hasty: false };
const PUBLISHED: NamedRule<Conditions> = NamedRule::new("legitimate phase", RULE);
const STOPS: NamedRule<Conditions> =
    NamedRule::new("does not close up", Conditions { closes_up: false, ..RULE });
const HASTY: NamedRule<Conditions> = NamedRule::new("two at once", Conditions { is_hasty: true, ..RULE });

/// The rule.
pub(crate) static ENTRY: Entry = Entry {
    name: "perpetual",
    title: "perpetual exploration of a ring",
    source: "after Blin, Milani, Potop-Butucaru, Tixeuil, *Exclusive Perpetual Ring Exploration without Chirality*, \
             DISC 2010: its legitimate phase, as we model it",
    promises: &[
        promise(
            "RING-1",
            "No two robots MUST come into one node, or change places.",
            &[&Check::new(PUBLISHED, &Keeps::<Ring>(Size(12, true), 0), Holds, &[])],
        ),
        promise(
            "RING-2",
            "Every node MUST be visited again and again, by each robot.",
            &[
                &Check::new(PUBLISHED, &Keeps::<Ring>(Size(12, false), 1), Holds, &[STOPS, HASTY]),
                &Check::new(PUBLISHED, &Keeps::<Ring>(Size(10, false), 1), Holds, &[STOPS]),
                &Check::new(PUBLISHED, &Keeps::<Ring>(Size(9, false), 1), Refuted, &[]),
                &Check::new(PUBLISHED, &Keeps::<Ring>(Size(10, true), 1), Refuted, &[]),
            ],
        ),
    ],
};
