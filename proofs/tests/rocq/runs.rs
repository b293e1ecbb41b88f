//! Runs of the chain's planner in drawn layouts: what the robots sent, byte by byte.

use tautline_kernel::chain::{Chain, Intent, Kind, Plan, Rule, area};
use tautline_kernel::ground::{Area, Cell, Edge, Grid, MediumGrid, Side};

use super::term::{cell, definition, edge, list, number};
use crate::draw::Draw;

/// The base of all teams that run.
pub(super) const BASE: Cell = Cell::new(5, 5);
const MOST: usize = 6;

/// A drawn layout around the base: the area of so many robots, and the walls inside it.
pub(super) fn drawn(robots: usize, draw: &mut Draw) -> (Area, Vec<Edge>) {
    let whole = Area::new(Cell::new(0, 0), Cell::new(10, 10)).expect("an area");
    let area = area(whole, BASE, robots).expect("the base is inside");
    let share = 1 + draw.below(3);
    (area, area.edges().filter(|_| draw.below(10) < share).collect())
}

/// The edges between an area and what lies outside of it.
pub(super) fn border(area: Area) -> impl Iterator<Item = Edge> {
    let sides = area.cells().flat_map(|cell| Side::ALL.map(|side| (cell, side)));
    let sides = sides.filter(move |&(cell, side)| !area.contains(cell.beyond(side)));
    sides.map(|(cell, side)| Edge::new(cell, side))
}

/// The team moves up to the one that gains, of a chain that has just planned the first of them, as if no wall were met.
pub(super) fn until_gain<G: Grid, const MOST: usize>(
    mut chain: Chain<G, MOST>,
    mut plan: Plan<MOST>,
) -> Vec<String> {
    let mut script = Vec::new();
    loop {
        script.push(number(plan.steps().iter().skip(1).map(|step| step.place() as u8)));
        chain.settle(&plan, |_| true);
        if chain.gained() {
            return script;
        }
        let Ok(Intent::Go(next)) = chain.plan(&[]) else { panic!("it goes on until it gains") };
        plan = next;
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
    let (area, inside) = drawn(robots, draw);
    // The border is a wall, too.
    let walls = inside.iter().copied().chain(border(area)).map(edge);
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
        sent.push(number(settled.messages().iter().copied()));
        log.extend_from_slice(settled.messages());
    }
    let last = chain.cells().iter().copied().map(cell);
    format!("\n ({robots}%nat,{}%Z,{}%Z,\n  {}%N,{}%Z)", cell(BASE), list(walls), list(sent), list(last))
}
