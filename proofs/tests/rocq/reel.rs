//! Runs of the reel in drawn layouts: what the robots sent, the measure when a team move was planned and when it was
//! made, and what was rehearsed.

use std::cell::Cell as Switch;

use tautline_kernel::chain::{Chain, Condition, Intent, Kind, Rule};
use tautline_kernel::ground::{Area, Avoid, Cell, CellMark, Edge, EdgeMark, Grid, MediumGrid, Steps};

use super::runs::{BASE, border, drawn, until_gain};
use super::term::{cell, definition, edge, list, number};
use crate::draw::Draw;

const MOST: usize = 5;
const RUNS: usize = 12;

/// A grid that hides from the leader what is beside it while it is told to: then nothing is touched, and what is
/// rehearsed can be seen to its end.
#[derive(Clone, Copy)]
struct HidingGrid<'a> {
    grid: MediumGrid,
    hides: &'a Switch<bool>,
}

impl Grid for HidingGrid<'_> {
    type Bearings = <MediumGrid as Grid>::Bearings;
    fn area(&self) -> Area {
        self.grid.area()
    }
    fn has(&self, mark: CellMark, cell: Cell) -> bool {
        self.grid.has(mark, cell)
    }
    fn put(&mut self, mark: CellMark, cell: Cell) {
        self.grid.put(mark, cell);
    }
    fn take(&mut self, mark: CellMark, cell: Cell) {
        self.grid.take(mark, cell);
    }
    fn edge_has(&self, mark: EdgeMark, edge: Edge) -> bool {
        self.grid.edge_has(mark, edge)
    }
    fn steps_to(&self, mark: CellMark, at: Cell, steps: Steps) -> Steps {
        if mark == CellMark::Explored && self.hides.get() {
            steps
        } else {
            self.grid.steps_to(mark, at, steps)
        }
    }
    fn put_edge(&mut self, mark: EdgeMark, edge: Edge) {
        self.grid.put_edge(mark, edge);
    }
    fn clear_edges(&mut self, mark: EdgeMark) {
        self.grid.clear_edges(mark);
    }
    fn is_explored(&self) -> bool {
        self.grid.is_explored()
    }
    fn distance(&mut self, from: Cell, avoid: Avoid) -> Option<u32> {
        self.grid.distance(from, avoid)
    }
    fn stops(&mut self, from: Cell, stops: &mut [Cell]) -> Option<usize> {
        self.grid.stops(from, stops)
    }
    fn next_unexplored(&self, from: Cell, last: Option<(u32, Cell)>, most: u32) -> Option<(u32, Cell)> {
        self.grid.next_unexplored(from, last, most)
    }
    fn bearings(&mut self, to: Cell, most: u32) -> Self::Bearings {
        self.grid.bearings(to, most)
    }
    fn nearer(&self, bearings: &Self::Bearings, at: Cell) -> Steps {
        self.grid.nearer(bearings, at)
    }
}

type Reel<'a> = Chain<HidingGrid<'a>, MOST>;

/// The situations that a set of runs must contain for the comparison to mean something.
#[derive(Default, Debug)]
struct Situations {
    touched: usize,
    begun: usize,
    long: usize,
    taken_back: usize,
    doubled: usize,
    surprised: usize,
}

/// Of each rule's runs: how many robots, the base, the walls inside and those of the border, of each team move what the
/// robots sent (R_2 in the lowest byte), the measure planned and made, and if a task is begun, what was rehearsed; and
/// where they are at the end.
pub(super) fn terms() -> String {
    runs("REEL", Rule::REEL) + &runs("UNHELD", Rule::REEL.without(Condition::Hold))
}

fn runs(name: &str, rule: Rule) -> String {
    let (mut draw, mut met) = (Draw(17), Situations::default());
    let runs: Vec<String> =
        (0..RUNS).map(|number| run(rule, 2 + number % (MOST - 1), &mut draw, &mut met)).collect();
    let Situations { touched, begun, long, taken_back, doubled, surprised } = met;
    assert!(
        touched > 300 && begun > 100 && long > 50 && taken_back > 50 && doubled > 50 && surprised > 10,
        "{met:?}"
    );
    let kind = "list (nat * (Z * Z) * list ((Z * Z) * bool) * list ((Z * Z) * bool) * list (N * N * N * list N) * \
                list (Z * Z))";
    definition(&format!("reels_{name}"), kind, &list(runs))
}

/// The take-backs begun, whether one is under way, and the team moves left, as one number.
fn measure(chain: &Reel<'_>) -> String {
    let [not_begun, is_under_way, left] = chain.measure();
    assert!(left < 1 << 16, "four digits are enough");
    format!("0x{:x}", (u32::from(u8::MAX) - not_begun) << 20 | is_under_way << 16 | left)
}

fn run(rule: Rule, robots: usize, draw: &mut Draw, met: &mut Situations) -> String {
    let (area, inside) = drawn(robots, draw);
    let hides = Switch::new(false);
    let grid = HidingGrid { grid: MediumGrid::new(area).expect("it is small"), hides: &hides };
    let mut chain = Reel::new(rule, robots, BASE, grid).expect("a chain");
    let (mut log, mut moves) = (Vec::new(), Vec::new());
    loop {
        let goes_on = !chain.gained() && chain.until_gain().is_some();
        let Intent::Go(plan) = chain.plan(&log).expect("its own log") else { break };
        assert!(!chain.is_refused(), "what is planned is admitted");
        let mut script = Vec::new();
        match chain.until_gain() {
            Some(left) if !goes_on => {
                hides.set(true);
                script = until_gain(chain, plan);
                hides.set(false);
                assert_eq!(left as usize, script.len(), "the team moves left are those of the rehearsal");
                met.begun += 1;
                met.long += usize::from(left > 2);
            }
            None if plan.kind == Kind::Advance => met.touched += 1,
            Some(_) | None => {}
        }
        let planned = measure(&chain);
        met.doubled += usize::from(chain.measure()[0] < 254);
        met.taken_back += usize::from(plan.kind == Kind::Backtrack);
        let left = chain.until_gain();
        let settled = chain.settle(&plan, |edge| !inside.contains(&edge));
        met.surprised += usize::from(left.is_some_and(|left| left > 1) && chain.gained());
        let sent = number(settled.messages().iter().copied());
        moves.push(format!("({sent},{planned},{},{})", measure(&chain), list(script)));
        log.extend_from_slice(settled.messages());
    }
    let last = chain.cells().iter().copied().map(cell);
    format!(
        "\n ({robots}%nat,{}%Z,{}%Z,\n  {}%Z,\n  {}%N,{}%Z)",
        cell(BASE),
        list(inside.iter().copied().map(edge)),
        list(border(area).map(edge)),
        list(moves),
        list(last)
    )
}
