//! Dijkstra's ring of K-state machines (Communications of the ACM 17, 1974). A machine of a ring sees its left
//! neighbour. Machine 0 has the privilege if it equals its neighbour, and counts on; another one has it if it differs,
//! and copies. From any states, one privilege goes round in the end, if there are as many states as machines; one state
//! fewer suffices where the machines act one at a time, and two fewer do not.

use crate::prelude::*;

/// The rule, and rules with one thing wrong.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Rule {
    /// As Dijkstra wrote it.
    Published,
    /// Machine 0 is as all others are.
    Uniform,
    /// All machines count on as machine 0 does.
    CountsOn,
}

/// Machines, and the states of each.
#[derive(Clone, Copy, Debug)]
pub struct Ring(pub usize, pub u8);

impl fmt::Display for Ring {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} machines of {} states, all starts, one at a time in any order", self.0, self.1)
    }
}

/// The machines of a ring.
#[derive(Debug)]
pub struct Machines(Rule, usize, u8);

impl Machines {
    fn has_privilege(&self, ring: &[u8], machine: usize) -> bool {
        let is_equal = ring[machine] == ring[(machine + self.1 - 1) % self.1];
        is_equal == (machine == 0 && self.0 != Rule::Uniform)
    }

    fn privileges(&self, ring: &[u8]) -> usize {
        (0..self.1).filter(|&machine| self.has_privilege(ring, machine)).count()
    }
}

impl Protocol for Machines {
    type Rule = Rule;
    type Bound = Ring;
    type State = Vec<u8>;
    const DEMANDS: &'static [Demand<Self>] = &[
        Demand::always("one privilege stays one", |machines, before: &Vec<u8>, after: &Vec<u8>| {
            machines.privileges(before) != 1 || machines.privileges(after) == 1
        }),
        Demand::eventually("there is one privilege", |machines, ring: &Vec<u8>| {
            machines.privileges(ring) == 1
        }),
    ];

    fn new(&rule: &Rule, &Ring(machines, states): &Ring) -> Result<Self, MethodError> {
        MethodError::unless(machines > 1 && states > 1, "a ring has at least two machines of two states")?;
        Ok(Self(rule, machines, states))
    }

    fn starts(&self) -> impl Iterator<Item = Vec<u8>> {
        combinations((0..self.1).map(|_| (0..self.2).collect()))
    }

    /// All machines are one actor: nobody need be fair to them.
    fn moves(&self, ring: &Vec<u8>) -> Vec<Move<Vec<u8>>> {
        let privileged = (0..self.1).filter(|&machine| self.has_privilege(ring, machine));
        let act = |machine: usize| {
            let left = ring[(machine + self.1 - 1) % self.1];
            let mut next = ring.clone();
            next[machine] = match self.0 {
                Rule::CountsOn => (left + 1) % self.2,
                Rule::Published if machine == 0 => (left + 1) % self.2,
                Rule::Published | Rule::Uniform => left,
            };
            Move::of_all(1, "acts", next)
        };
        privileged.map(act).collect()
    }

    fn draw(&self, ring: &Vec<u8>) -> String {
        let mark = |machine: usize| if self.has_privilege(ring, machine) { '*' } else { ' ' };
        ring.iter()
            .enumerate()
            .map(|(machine, state)| format!("{state}{}", mark(machine)))
            .collect::<Vec<_>>()
            .concat()
    }
}

const PUBLISHED: NamedRule<Rule> = NamedRule::new("published", Rule::Published);
const UNIFORM: NamedRule<Rule> = NamedRule::new("uniform", Rule::Uniform);
const COUNTS_ON: NamedRule<Rule> = NamedRule::new("all count on", Rule::CountsOn);

/// The rule.
pub(crate) static ENTRY: Entry = Entry {
    name: "dijkstra",
    title: "K-state ring",
    source: "Dijkstra, *Self-stabilizing Systems in Spite of Distributed Control*, Communications of the ACM 17, 1974; \
             machines and states: Fokkink, Hoepman, Pang, *A Note on K-State Self-Stabilization in a Ring with K=N*, \
             Nordic Journal of Computing 12, 2005",
    promises: &[
        promise(
            "KSTATE-1",
            "One privilege MUST stay one.",
            &[&Check::new(PUBLISHED, &Keeps::<Machines>(Ring(5, 5), 0), Holds, &[COUNTS_ON])],
        ),
        promise(
            "KSTATE-2",
            "There MUST be exactly one privilege at some time, whatever the start.",
            &[
                &Check::new(PUBLISHED, &Keeps::<Machines>(Ring(5, 5), 1), Holds, &[UNIFORM]),
                &Check::new(PUBLISHED, &Keeps::<Machines>(Ring(5, 4), 1), Holds, &[UNIFORM]),
                &Check::new(PUBLISHED, &Keeps::<Machines>(Ring(5, 3), 1), Refuted, &[]),
                &Check::new(PUBLISHED, &Keeps::<Machines>(Ring(4, 2), 1), Refuted, &[]),
            ],
        )
        .larger(&[&Check::new(PUBLISHED, &Keeps::<Machines>(Ring(7, 7), 1), Holds, &[UNIFORM])]),
    ],
};
