//! Gathering with local vision: Guilbault and Pelc (Theoretical Computer Science 509, 2013), on a ring. Robots are
//! alike, remember nothing, and see the nodes beside theirs. A robot that is alone and sees robots on one side goes
//! there; one that sees them on both sides, or has company, stays. Of all starts, only a *star* gathers: three robots
//! in a row. Two robots change places for ever.

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Conditions {
    /// A robot in company stays.
    pub counts: bool,
    /// A robot between two others stays.
    pub stays_between: bool,
}

/// Nodes of the ring, robots in a row, and who acts at once.
#[derive(Clone, Copy, Debug)]
pub struct Row(pub u8, pub u8, pub Moves);

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} robots in a row, a ring of {} nodes, {}", self.1, self.0, self.2)
    }
}

/// The robots of a ring.
#[derive(Debug)]
pub struct Ring(Conditions, Row);

/// Where robots are, and to where each is about to go.
type State = Vec<(u8, Option<u8>)>;

impl Ring {
    /// The node to which a robot wishes to go.
    fn wish(&self, robots: &State, me: usize) -> u8 {
        let (nodes, here) = (self.1.0, robots[me].0);
        let at = |node: u8| robots.iter().filter(|robot| robot.0 == node).count();
        let (left, right) = ((here + nodes - 1) % nodes, (here + 1) % nodes);
        match (at(left) > 0, at(right) > 0) {
            _ if at(here) > 1 && self.0.counts => here,
            (true, true) if self.0.stays_between => here,
            (true, _) => left,
            (_, true) => right,
            (false, false) => here,
        }
    }
}

impl Protocol for Ring {
    type Rule = Conditions;
    type Bound = Row;
    type State = State;
    const DEMANDS: &'static [Demand<Self>] =
        &[Demand::eventually("all are in one node, and stay", |ring, robots: &State| {
            let is_still = |me: usize| robots[me].1.is_none() && ring.wish(robots, me) == robots[me].0;
            robots.iter().all(|robot| robot.0 == robots[0].0) && (0..robots.len()).all(is_still)
        })];

    fn new(&rule: &Conditions, &Row(nodes, robots, order): &Row) -> Result<Self, MethodError> {
        MethodError::unless(robots <= nodes, "the ring has no room for the robots")?;
        Ok(Self(rule, Row(nodes, robots, order)))
    }

    fn starts(&self) -> impl Iterator<Item = State> {
        iter::once((0..self.1.1).map(|robot| (robot, None)).collect())
    }

    fn moves(&self, robots: &State) -> Vec<Move<State>> {
        if self.1.2 == Moves::Together {
            let to = (0..robots.len()).map(|me| (self.wish(robots, me), None)).collect();
            return vec![Move::of_all(robots.len(), "all go", to)];
        }
        let go = |me: usize| {
            let (mut to, wish) = (robots.clone(), self.wish(robots, me));
            let words = match robots[me].1 {
                Some(pending) => {
                    to[me] = (pending, None);
                    "moves"
                }
                None if self.1.2 == Moves::LookThenMove && wish != robots[me].0 => {
                    to[me].1 = Some(wish);
                    "looks"
                }
                None => {
                    to[me].0 = wish;
                    "goes"
                }
            };
            Move::of(me, words, to)
        };
        (0..robots.len()).map(go).filter(|next| next.to != *robots).collect()
    }

    fn draw(&self, robots: &State) -> String {
        let node = |node: u8| {
            let here = robots.iter().zip(b'0'..).filter(|(robot, _)| robot.0 == node);
            format!("[{}]", here.map(|(_, name)| char::from(name)).collect::<String>())
        };
        (0..self.1.0).map(node).collect()
    }
}

/// The published rule.
pub const RULE: Conditions = Conditions { counts: true, stays_between: true };
const PUBLISHED: NamedRule<Conditions> = NamedRule::new("published", RULE);
const BLIND: NamedRule<Conditions> = NamedRule::new("does not count", Conditions { counts: false, ..RULE });
const LEAVES: NamedRule<Conditions> =
    NamedRule::new("leaves the middle", Conditions { stays_between: false, ..RULE });

/// The rule.
pub(crate) static ENTRY: Entry = Entry {
    name: "gathering",
    title: "gathering with local vision",
    source: "Guilbault, Pelc, *Gathering Asynchronous Oblivious Agents with Local Vision in Regular Bipartite Graphs*, \
             Theoretical Computer Science 509, 2013",
    promises: &[promise(
        "GATHER-1",
        "All robots MUST come into one node, and stay.",
        &[
            &Check::new(
                PUBLISHED,
                &Keeps::<Ring>(Row(6, 3, Moves::LookThenMove), 0),
                Holds,
                &[BLIND, LEAVES],
            ),
            &Check::new(PUBLISHED, &Keeps::<Ring>(Row(6, 2, Moves::OneAtATime), 0), Holds, &[]),
            &Check::new(PUBLISHED, &Keeps::<Ring>(Row(6, 2, Moves::Together), 0), Refuted, &[]),
            &Check::new(PUBLISHED, &Keeps::<Ring>(Row(6, 2, Moves::LookThenMove), 0), Refuted, &[]),
            &Check::new(PUBLISHED, &Keeps::<Ring>(Row(6, 4, Moves::LookThenMove), 0), Refuted, &[]),
        ],
    )],
};
