//! Runs of the chain's planner in drawn layouts: what the robots sent, byte by byte.

use tautline_kernel::chain::{Chain, Intent, Kind, Rule, area};
use tautline_kernel::ground::{Area, Cell, Edge, MediumGrid, Side};

use super::term::{cell, definition, list};

const BASE: Cell = Cell::new(5, 5);
const MOST: usize = 6;

/// A generator of our own, so that the file is the same everywhere.
pub(super) struct Draw(pub(super) u64);

impl Draw {
    pub(super) fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % n
    }
}

/// The situations that a set of runs must contain for the comparison to mean something.
#[derive(Default)]
struct Situations {
    backtracks: usize,
    blocked: usize,
    unfolding: usize,
}

/// Of each rule's runs: how many robots, the base, the walls, what the robots sent in each team move (R_2 in the lowest
/// byte), and where they are at the end.
pub(super) fn terms() -> String {
    let (repaired, met) = runs("REPAIRED", Rule::REPAIRED);
    let Situations { backtracks, blocked, unfolding } = met;
    assert!(backtracks > 100 && blocked > 100 && unfolding > 10, "{backtracks} {blocked} {unfolding}");
    let (reel, met) = runs("REEL", Rule::REEL);
    let Situations { backtracks, blocked, .. } = met;
    assert!(backtracks > 10 && blocked > 100, "{backtracks} {blocked}");
    repaired + &reel
}

fn runs(name: &str, rule: Rule) -> (String, Situations) {
    let (mut draw, mut met) = (Draw(2011), Situations::default());
    let runs: Vec<String> =
        (0..15).map(|number| run(rule, 2 + number % (MOST - 1), &mut draw, &mut met)).collect();
    let kind = "list (nat * (Z * Z) * list ((Z * Z) * bool) * list N * list (Z * Z))";
    (definition(&format!("runs_{name}"), kind, &list(runs)), met)
}

fn run(rule: Rule, robots: usize, draw: &mut Draw, met: &mut Situations) -> String {
    let whole = Area::new(Cell::new(0, 0), Cell::new(10, 10)).expect("an area");
    let area = area(whole, BASE, robots).expect("the base is inside");
    let share = 1 + draw.below(3);
    let inside: Vec<Edge> = area.edges().filter(|_| draw.below(10) < share).collect();
    // The border is a wall, too.
    let border = area.cells().flat_map(|cell| Side::ALL.map(|side| (cell, side)));
    let border = border.filter(|&(cell, side)| !area.contains(cell.beyond(side)));
    let walls = inside.iter().copied().chain(border.map(|(cell, side)| Edge::new(cell, side)));
    let walls = walls.map(|edge| format!("({},{})", cell(edge.cell()), edge.side() == Side::East));

    let grid = MediumGrid::new(area).expect("it is small");
    let mut chain = Chain::<_, MOST>::new(rule, robots, BASE, grid).expect("a chain");
    let (mut log, mut sent) = (Vec::new(), Vec::new());
    while let Intent::Go(plan) = chain.plan(&log).expect("its own log") {
        met.unfolding += usize::from(chain.is_unfolding());
        met.backtracks += usize::from(plan.kind == Kind::Backtrack);
        let planned: Vec<Cell> =
            chain.cells().iter().zip(plan.steps()).map(|(cell, &step)| cell.after(step)).collect();
        let settled = chain.settle(&plan, |edge| !inside.contains(&edge));
        met.blocked += planned.iter().zip(chain.cells()).filter(|(planned, now)| planned != now).count();
        // R_2 in the lowest byte.
        let number =
            settled.messages().iter().rev().fold(0_u64, |number, &byte| number << 8 | u64::from(byte));
        let digits = 2 * settled.messages().len();
        sent.push(format!("0x{number:0digits$x}"));
        log.extend_from_slice(settled.messages());
    }
    let last = chain.cells().iter().copied().map(cell);
    format!("\n ({robots}%nat,{}%Z,{}%Z,\n  {}%N,{}%Z)", cell(BASE), list(walls), list(sent), list(last))
}
