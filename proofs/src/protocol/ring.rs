//! Robots on a ring of nodes, which are alike and remember nothing: each looks, and goes to a node, or stays.

use std::fmt;

use super::{Move, combinations, names};
use crate::bound;
use crate::engine::states::Bits;
use crate::team::Moves;

/// How robots start on a ring: no two in one node.
#[derive(Clone, Copy, Debug)]
pub enum Start {
    /// In nodes that follow one another.
    InARow,
    /// In these nodes.
    At(&'static [u8]),
    /// Anywhere: robot 0 in node 0, and the others behind it in their order.
    Any,
}

impl Start {
    /// Whether so many robots can start so on a ring of so many nodes.
    fn is_of(self, nodes: u8, robots: u8) -> bool {
        let Self::At(places) = self else { return true };
        let differ = |place: usize| places[place] < nodes && !places[..place].contains(&places[place]);
        places.len() == usize::from(robots) && (0..places.len()).all(differ)
    }
}

impl fmt::Display for Start {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::InARow => f.write_str("in a row"),
            Self::At(nodes) => write!(f, "at first in {nodes:?}"),
            Self::Any => f.write_str("every start"),
        }
    }
}

bound! {
    /// A ring, and the robots on it.
    pub Ring { nodes: u8, robots: u8, starts: Start, moves: Moves }
    "{robots} robots, a ring of {nodes} nodes, {starts}, {moves}";
    robots <= nodes, "the ring has no room for the robots";
    robots <= 16 && nodes <= 128, "a ring has at most 16 robots and 128 nodes";
    starts.is_of(nodes, robots),
        "{robots} robots of a ring of {nodes} nodes do not start {starts}: each has a node of its own"
}

/// A robot: where it is, and to where it is about to go.
pub type Walker = (u8, Option<u8>);

impl Ring {
    /// The node so many steps on.
    pub const fn on(&self, node: u8, steps: u8) -> u8 {
        (node + steps) % self.nodes
    }

    /// The node before.
    pub const fn back(&self, node: u8) -> u8 {
        (node + self.nodes - 1) % self.nodes
    }

    /// The robots at the start.
    pub fn starts(&self) -> Vec<Vec<Walker>> {
        let any = || {
            combinations((0..self.robots).map(|me| if me == 0 { vec![0] } else { (1..self.nodes).collect() }))
        };
        let all = match self.starts {
            Start::InARow => vec![(0..self.robots).collect()],
            Start::At(nodes) => vec![nodes.to_vec()],
            Start::Any => any().filter(|nodes| nodes.is_sorted_by(|one, other| one < other)).collect(),
        };
        all.into_iter().map(|nodes| nodes.into_iter().map(|node| (node, None)).collect()).collect()
    }

    /// The moves of robots, each of which wishes to go to a node. Where one looks, others may act before it moves.
    pub fn moves(&self, robots: &[Walker], wish: impl Fn(usize) -> u8) -> Vec<Move<Vec<Walker>>> {
        let looks = self.moves == Moves::LookThenMove;
        let go = |actors: Bits| {
            let acted = |(me, &(here, pending)): (usize, &Walker)| match pending {
                _ if actors >> me & 1 == 0 => (here, pending),
                Some(pending) => (pending, None),
                None if looks => (here, Some(wish(me)).filter(|&wish| wish != here)),
                None => (wish(me), None),
            };
            let words = match robots[actors.trailing_zeros() as usize].1 {
                Some(_) => "moves",
                None if looks => "looks",
                None if actors.is_power_of_two() => "goes",
                None => "all go",
            };
            Move::of_set(actors, words, robots.iter().enumerate().map(acted).collect())
        };
        self.moves.sets(robots.len()).map(go).filter(|next| next.to != robots).collect()
    }

    /// The nodes in a row, with the robots in each by number.
    pub fn draw(&self, robots: &[Walker]) -> String {
        let node = |node| ["[", &names(robots, |robot| robot.0 == node), "]"].concat();
        (0..self.nodes).map(node).collect()
    }
}
