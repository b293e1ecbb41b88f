//! Spiral spanning tree coverage: Gabriely and Rimon (Annals of Mathematics and Artificial Intelligence 31, 2001; ICRA
//! 2002). Cells are gathered in blocks of four. The robot builds a spanning tree of the blocks while it goes round it:
//! at each side of a block it looks whether the next block is new; if it is, the tree grows there, and the robot enters.
//! So it goes through every cell of every block once, and comes back to where it began.

use tautline_kernel::ground::Side;

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Conditions {
    /// The tree grows only to blocks that are new.
    only_new: bool,
    /// The robot goes back along the tree.
    goes_back: bool,
}

/// Blocks in every connected layout.
struct Blocks(Graphs);

impl fmt::Display for Blocks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "1 robot, {} of 2×2, every start", self.0)
    }
}

struct Coverage(Conditions, Vec<Graph>);

/// The number of the layout, block and quarter where the robot is and began, cells that it has covered, the tree's edges.
type State = (u16, (u8, u8), (u8, u8), u64, Vec<(u8, u8)>);

const fn bit((block, quarter): (u8, u8)) -> u64 {
    1 << (block * 4 + quarter)
}

impl Protocol for Coverage {
    type Rule = Conditions;
    type Bound = Blocks;
    type State = State;
    const DEMANDS: &'static [Demand<Self>] = &[
        Demand::always("no cell is entered twice", |_, before: &State, after: &State| {
            before.3 & bit(after.1) == 0 || after.1 == after.2
        }),
        Demand::eventually(
            "all cells are covered, and the robot is back",
            |coverage, (graph, at, start, covered, _): &State| {
                at == start && covered.count_ones() as usize == 4 * coverage.1[usize::from(*graph)].len()
            },
        ),
    ];

    fn new(&rule: &Conditions, Blocks(graphs): &Blocks) -> Result<Self, MethodError> {
        Ok(Self(rule, graphs.all()?))
    }

    fn starts(&self) -> impl Iterator<Item = State> {
        self.1.iter().zip(0..).flat_map(|(graph, number)| {
            let starts = (0..graph.len() as u8).flat_map(|block| (0..4).map(move |quarter| (block, quarter)));
            starts.map(move |start| (number, start, start, bit(start), Vec::new()))
        })
    }

    /// Quarters are numbered clockwise from the north-west, and each looks at one side of the block: north, east, south,
    /// west. The run is over when the robot is back.
    fn moves(&self, (graph, at, start, covered, tree): &State) -> Vec<Move<State>> {
        if at == start && *covered != bit(*start) {
            return Vec::new();
        }
        let (block, quarter) = *at;
        let side = [Side::North, Side::East, Side::South, Side::West][usize::from(quarter)];
        let next = self.1[usize::from(*graph)].to_side(block, side);
        let is_new = |other: u8| (0..4).all(|quarter| covered & bit((other, quarter)) == 0);
        let edge = |other: u8| (block.min(other), block.max(other));
        let is_edge = |&other: &u8| tree.contains(&edge(other));
        let grows = next.filter(|&other| (is_new(other) || !self.0.only_new) && !is_edge(&other));
        let crosses = grows.or_else(|| next.filter(is_edge).filter(|_| self.0.goes_back));
        let to = crosses.map_or((block, (quarter + 1) % 4), |other| (other, (quarter + 3) % 4));
        let tree = tree.iter().copied().chain(grows.map(edge)).collect();
        let words = if grows.is_some() { "enters a new block" } else { "goes" };
        vec![Move::of(0, words, (*graph, to, *start, covered | bit(to), tree))]
    }

    fn draw(&self, (graph, at, _, covered, _): &State) -> String {
        let sign = |block: u8, quarter: u8| match covered & bit((block, quarter)) {
            _ if *at == (block, quarter) => '0',
            0 => '.',
            _ => '+',
        };
        let row = |first: u8, second: u8| {
            self.1[usize::from(*graph)]
                .draw(|block| [sign(block, first), sign(block, second)].iter().collect())
        };
        let (upper, lower) = (row(0, 1), row(3, 2));
        upper
            .lines()
            .zip(lower.lines())
            .map(|(upper, lower)| format!("{upper}\n{lower}\n"))
            .collect::<Vec<_>>()
            .concat()
    }
}

const BLOCKS: Blocks = Blocks(Graphs::within(Kind::Connected, 3, 3));
const RULE: Conditions = Conditions { only_new: true, goes_back: true };
const PUBLISHED: NamedRule<Conditions> = NamedRule::new("published", RULE);
const CYCLES: NamedRule<Conditions> = NamedRule::new("closes cycles", Conditions { only_new: false, ..RULE });
const STAYS: NamedRule<Conditions> =
    NamedRule::new("never goes back", Conditions { goes_back: false, ..RULE });

/// The rule.
pub(crate) static ENTRY: Entry = Entry {
    name: "spanning-tree",
    title: "spanning tree coverage",
    source: "Gabriely, Rimon, *Spiral-STC: An On-Line Coverage Algorithm of Grid Environments by a Mobile Robot*, \
             ICRA 2002; blocks that are wholly free",
    promises: &[
        promise(
            "STC-1",
            "No cell MUST be entered twice.",
            &[&Check::new(PUBLISHED, &Keeps::<Coverage>(BLOCKS, 0), Holds, &[STAYS])],
        ),
        promise(
            "STC-2",
            "Every cell MUST be covered, and the robot come back.",
            &[&Check::new(PUBLISHED, &Keeps::<Coverage>(BLOCKS, 1), Holds, &[CYCLES, STAYS])],
        ),
    ],
};
