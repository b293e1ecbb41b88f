//! Spiral spanning tree coverage: Gabriely and Rimon (Annals of Mathematics and Artificial Intelligence 31, 2001; ICRA
//! 2002). Cells are gathered in blocks of four. The robot builds a spanning tree of the blocks while it goes round it:
//! at each side of a block it looks whether the next block is new; if it is, the tree grows there, and the robot
//! enters. So it goes through every cell of every block once, and comes back to where it began.

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy)]
struct Conditions {
    /// The tree grows only to blocks that are new.
    only_new: bool,
    /// The robot goes back along the tree.
    goes_back: bool,
}

/// Block and quarter where the robot is and began, cells that it has covered, and the tree's edges.
type State = ((u8, u8), (u8, u8), u64, Vec<(u8, u8)>);

const fn bit((block, quarter): (u8, u8)) -> u64 {
    1 << (block * 4 + quarter)
}

impl Protocol for Conditions {
    type Bound = Crew;
    type State = State;
    demands! {
        always "no cell is entered twice", |_, _, old, new| old.2 & bit(new.0) == 0 || new.0 == new.1;
        eventually "all cells are covered, and the robot is back", |_, crew, (at, start, covered, _)| {
            at == start && covered.count_ones() as usize == 4 * crew.graph.len()
        };
    }

    fn starts(&self, crew: &Deployment) -> impl IntoIterator<Item = State> {
        let starts =
            (0..crew.graph.len() as u8).flat_map(|block| (0..4).map(move |quarter| (block, quarter)));
        starts.map(|start| (start, start, bit(start), Vec::new()))
    }

    /// Quarters are numbered clockwise from the north-west, and each looks at one side of the block: north, east,
    /// south, west. The run is over when the robot is back.
    fn moves(&self, crew: &Deployment, (at, start, covered, tree): &State) -> Vec<Move<State>> {
        if at == start && *covered != bit(*start) {
            return Vec::new();
        }
        let (block, quarter) = *at;
        let side = [Side::North, Side::East, Side::South, Side::West][usize::from(quarter)];
        let next = crew.graph.to_side(block, side);
        let is_new = |other: u8| (0..4).all(|quarter| covered & bit((other, quarter)) == 0);
        let edge = |other: u8| (block.min(other), block.max(other));
        let is_edge = |&other: &u8| tree.contains(&edge(other));
        let grows = next.filter(|&other| (is_new(other) || !self.only_new) && !is_edge(&other));
        let crosses = grows.or_else(|| next.filter(is_edge).filter(|_| self.goes_back));
        let to = crosses.map_or((block, (quarter + 1) % 4), |other| (other, (quarter + 3) % 4));
        let tree = tree.iter().copied().chain(grows.map(edge)).collect();
        let words = if grows.is_some() { "enters a new block" } else { "goes" };
        vec![Move::of(0, words, (to, *start, covered | bit(to), tree))]
    }

    fn draw(&self, crew: &Deployment, (at, _, covered, _): &State) -> String {
        let sign = |cell: (u8, u8)| match covered & bit(cell) {
            _ if *at == cell => '0',
            0 => '.',
            _ => '+',
        };
        let half = |quarters: [u8; 2]| {
            crew.graph.draw(|block| quarters.map(|quarter| sign((block, quarter))).iter().collect())
        };
        let (upper, lower) = (half([0, 1]), half([3, 2]));
        upper.lines().zip(lower.lines()).map(|(upper, lower)| [upper, lower, ""].join("\n")).collect()
    }
}

const BLOCKS: Crew = Crew { robots: 1, graphs: Graphs::within(Kind::Connected, 3, 3) };
const RULE: Conditions = Conditions { only_new: true, goes_back: true };

entry! { Conditions: "spanning-tree", "spanning tree coverage", "STC",
    "Gabriely, Rimon, *Spiral-STC: An On-Line Coverage Algorithm of Grid Environments by a Mobile Robot*, ICRA \
     2002; a cell of the layouts is a block of four, wholly free";
    PUBLISHED = "published", RULE;
    CYCLES = "closes cycles", Conditions { only_new: false, ..RULE };
    STAYS = "never goes back", Conditions { goes_back: false, ..RULE };
    1: "No cell MUST be entered twice." {
        Holds PUBLISHED within BLOCKS, not STAYS;
    }
    2: "Every cell MUST be covered, and the robot come back." {
        Holds PUBLISHED within BLOCKS, not CYCLES, STAYS;
    }
}
