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

bound! {
    /// Machines of a ring, and the states of each.
    pub Machines { machines: usize, states: u8 }
    "{machines} machines of {states} states, all starts, one at a time in any order";
    machines > 1 && states > 1, "a ring has two machines or more, of at least two states each";
    machines < 64 && usize::from(states).checked_pow(machines as u32).is_some(),
        "{machines} machines of {states} states have too many starts"
}

/// The state of the left neighbour.
fn left(ring: &[u8], machine: usize) -> u8 {
    ring[(machine + ring.len() - 1) % ring.len()]
}

impl Rule {
    fn has_privilege(self, ring: &[u8], machine: usize) -> bool {
        (ring[machine] == left(ring, machine)) == (machine == 0 && self != Self::Uniform)
    }

    fn is_legitimate(self, ring: &[u8]) -> bool {
        (0..ring.len()).filter(|&machine| self.has_privilege(ring, machine)).count() == 1
    }
}

impl Protocol for Rule {
    type Bound = Machines;
    type State = Vec<u8>;
    demands! {
        always "one privilege stays one", |rule, _, old, new| !rule.is_legitimate(old) || rule.is_legitimate(new);
        eventually "there is one privilege", |rule, _, ring| rule.is_legitimate(ring);
    }

    fn starts(&self, &Machines { machines, states }: &Machines) -> impl IntoIterator<Item = Vec<u8>> {
        combinations(vec![(0..states).collect(); machines])
    }

    /// All machines are one actor: nobody need be fair to them.
    fn moves(&self, bound: &Machines, ring: &Vec<u8>) -> Vec<Move<Vec<u8>>> {
        let counts_on = |machine| *self == Self::CountsOn || *self == Self::Published && machine == 0;
        let next = |machine| (left(ring, machine) + u8::from(counts_on(machine))) % bound.states;
        let act = |machine| Move::of(0, "acts", with(ring, machine, next(machine))).by(machine);
        (0..ring.len()).filter(|&machine| self.has_privilege(ring, machine)).map(act).collect()
    }

    fn draw(&self, _: &Machines, ring: &Vec<u8>) -> String {
        let mark = |machine: usize| if self.has_privilege(ring, machine) { "*" } else { " " };
        (0..ring.len()).map(|machine| ring[machine].to_string() + mark(machine)).collect()
    }
}

entry! { Rule: "dijkstra", "K-state ring", "KSTATE",
    "Dijkstra, *Self-stabilizing Systems in Spite of Distributed Control*, Communications of the ACM 17, 1974; \
     machines and states: Fokkink, Hoepman, Pang, *A Note on K-State Self-Stabilization in a Ring with K=N*, Nordic \
     Journal of Computing 12, 2005";
    PUBLISHED = "published", Rule::Published;
    OUTSIDE = "published outside its premises", Rule::Published;
    UNIFORM = "uniform", Rule::Uniform;
    COUNTS_ON = "all count on", Rule::CountsOn;
    1: "One privilege MUST stay one." {
        Holds PUBLISHED within Machines::of(5, 5), not COUNTS_ON;
    }
    2: "There MUST be exactly one privilege at some time, whatever the start." {
        Holds PUBLISHED within Machines::of(5, 5), not UNIFORM;
        Holds PUBLISHED within Machines::of(5, 4), not UNIFORM;
        Refuted OUTSIDE within Machines::of(5, 3);
        Refuted OUTSIDE within Machines::of(4, 2);
    } larger {
        Holds PUBLISHED within Machines::of(7, 7), not UNIFORM;
    }
}
