//! Runs of the paper's planner in drawn layouts: what the robots sent, the virtual obstacles that each plan puts, and
//! where epochs begin.

use tautline_kernel::chain::{Chain, Intent, Kind, Rule};
use tautline_kernel::ground::{Edge, EdgeMark, Grid, MediumGrid};

use super::runs::{BASE, border, drawn, until_gain};
use super::term::{cell, definition, edge, list, number};
use crate::draw::Draw;

const MOST: usize = 4;
const RUNS: usize = 9;

type Paper = Chain<MediumGrid, MOST>;

/// The situations that a set of runs must contain for the comparison to mean something.
#[derive(Default, Debug)]
struct Situations {
    taken_back: usize,
    refused: usize,
    epochs: usize,
    unfolded: usize,
}

/// Of each rule's runs: how many robots, the base, the walls inside and those of the border; of each team move what the
/// robots sent (R_2 in the lowest byte), whether an epoch begins with it, the virtual obstacles that it puts, and if it
/// begins to unfold the chain, all team moves of that as if no wall were met; and where robots are at the end.
pub(super) fn terms() -> String {
    let (published, met) = runs("PUBLISHED", Rule::PUBLISHED);
    assert!(met.taken_back > 50 && met.refused > 50 && met.epochs > 5 && met.unfolded == 0, "{met:?}");
    let (repaired, met) = runs("REPAIRED", Rule::REPAIRED);
    assert!(met.taken_back > 50 && met.refused > 50 && met.epochs > 5 && met.unfolded > 1, "{met:?}");
    published + &repaired
}

fn runs(name: &str, rule: Rule) -> (String, Situations) {
    let (mut draw, mut met) = (Draw(7), Situations::default());
    let runs: Vec<String> =
        (0..RUNS).map(|number| run(rule, 2 + number % (MOST - 1), &mut draw, &mut met)).collect();
    let kind = "list (nat * (Z * Z) * list ((Z * Z) * bool) * list ((Z * Z) * bool) * \
                list (N * bool * list ((Z * Z) * bool) * list N) * list (Z * Z))";
    (definition(&format!("epochs_{name}"), kind, &list(runs)), met)
}

fn virtual_obstacles(chain: &Paper) -> Vec<Edge> {
    let edges = chain.grid().area().edges();
    edges.filter(|&edge| chain.grid().edge_has(EdgeMark::Virtual, edge)).collect()
}

fn run(rule: Rule, robots: usize, draw: &mut Draw, met: &mut Situations) -> String {
    let (area, inside) = drawn(robots, draw);
    let grid = MediumGrid::new(area).expect("it is small");
    let mut chain = Paper::new(rule, robots, BASE, grid).expect("a chain");
    let (mut log, mut moves) = (Vec::new(), Vec::new());
    loop {
        let (epochs, mut before) = (chain.epochs(), virtual_obstacles(&chain));
        let Intent::Go(plan) = chain.plan(&log).expect("its own log") else { break };
        let begins = chain.epochs() > epochs;
        if begins {
            before.clear();
        }
        let new: Vec<Edge> =
            virtual_obstacles(&chain).into_iter().filter(|edge| !before.contains(edge)).collect();
        let script = if begins && chain.is_unfolding() { until_gain(chain, plan) } else { Vec::new() };
        met.taken_back += usize::from(plan.kind == Kind::Backtrack);
        met.refused += new.len();
        met.epochs += usize::from(begins);
        met.unfolded += usize::from(!script.is_empty());
        let settled = chain.settle(&plan, |edge| !inside.contains(&edge));
        let sent = number(settled.messages().iter().copied());
        moves.push(format!("({sent}%N,{begins},{}%Z,{}%N)", list(new.into_iter().map(edge)), list(script)));
        log.extend_from_slice(settled.messages());
    }
    let last = chain.cells().iter().copied().map(cell);
    format!(
        "\n ({robots}%nat,{}%Z,{}%Z,\n  {}%Z,\n  {},{}%Z)",
        cell(BASE),
        list(inside.iter().copied().map(edge)),
        list(border(area).map(edge)),
        list(moves),
        list(last)
    )
}
