//! Runs of robots that keep in touch, in drawn layouts: what they do and see, which paths again they may drive, and
//! which sides count as covered for each of them. By the repaired rule, and by two others that forget sides.

use std::collections::BTreeSet;

use tautline_kernel::ground::{Area, Cell, Edge, EdgeMark, Grid, Side, Step, Steps, TinyGrid};
use tautline_kernel::kit::{Condition, Next, Records, Rule, Sight};
use tautline_proofs::kit::world::{Event, Setting, Successor, Team};

use super::term::{bits, cell, definition, edge, list};
use crate::draw::Draw;

const KIND: &str =
    "list ((nat * Z * Z) * list edge * list cell\n  * list (list event * option (nat * list side) * list N))";

/// The most steps of a run: without its conditions a rule goes on for ever.
const MOST: usize = 80;

/// The situations that a set of runs must contain for the comparison to mean something.
#[derive(Default)]
struct Situations {
    walls: usize,
    old: usize,
    choices: usize,
}

/// Of each rule's runs: robots, columns and rows; the walls and the starts; of each step the events, of two robots the
/// one that decides and the sides of old paths that it may take, and of each robot a bit for each side of each node
/// that counts as covered.
pub(super) fn terms() -> String {
    let (mut draw, mut met) = (Draw(2015), Situations::default());
    let mut two: Vec<String> = Vec::new();
    for size in [(3, 3), (4, 2), (5, 1), (4, 3)] {
        two.extend((0..8).map(|_| run::<2>(Rule::REPAIRED, size, &mut draw, &mut met)));
    }
    let Situations { walls, old, choices } = met;
    assert!(walls > 10 && old > 20 && choices > 1, "{walls} {old} {choices}");
    let mut runs = |rule, size| {
        let all = (0..2).map(|_| run::<3>(rule, size, &mut draw, &mut met));
        list(all.collect::<Vec<_>>())
    };
    let others = Rule { records: Records::Others, ..Rule::REPAIRED };
    "From Tautline Require Import Lattice Sides.\n\n".to_owned()
        + &definition("runs_two", KIND, &list(two))
        + &definition("runs_three", KIND, &runs(Rule::REPAIRED, (3, 3)))
        + &definition("runs_unmarked", KIND, &runs(Rule::REPAIRED.without(Condition::Marked), (3, 2)))
        + &definition("runs_others", KIND, &runs(others, (3, 2)))
}

fn run<const ROBOTS: usize>(rule: Rule, size: (i16, i16), draw: &mut Draw, met: &mut Situations) -> String {
    let setting = Setting::<ROBOTS>::new(rule, size).expect("a small lattice");
    let mut given = TinyGrid::new(setting.area).expect("a small lattice");
    let walls: Vec<Edge> = setting.area.edges().filter(|_| draw.below(4) == 0).collect();
    for &edge in &walls {
        given.put_edge(EdgeMark::Wall, edge);
    }
    let setting = Setting { given: Some(given), ..setting };
    let cells: Vec<Cell> = setting.area.cells().collect();
    let (starts, mut world) = loop {
        let starts = std::array::from_fn(|_| cells[draw.below(cells.len() as u64) as usize]);
        if let Some(world) = setting.start(starts) {
            break (starts, world);
        }
    };
    let mut steps = Vec::new();
    while steps.len() < MOST {
        let turns = setting.turns(&world);
        let Some(turn) = turns.get(draw.below(turns.len().max(1) as u64) as usize) else { break };
        let old = old(&world.team, &turns, turn, met);
        let events: Vec<String> =
            turn.events.iter().flat_map(|event| events(&world.team, event, met)).collect();
        world = turn.world;
        let covered = (0..ROBOTS).map(|robot| covered(&world.team, setting.area, robot));
        steps.push(format!("\n  ({},{old},{})", list(events), list(covered)));
    }
    let (columns, rows) = size;
    let [walls, starts] = [list(walls.into_iter().map(edge)), list(starts.map(cell))];
    format!("\n (({ROBOTS}%nat,{columns},{rows})%Z,{walls}%Z,{starts}%Z,{})", list(steps))
}

/// The sides of old paths that the robot of this turn may take, if one of two decides.
fn old<const ROBOTS: usize>(
    team: &Team<ROBOTS>,
    turns: &[Successor<ROBOTS>],
    turn: &Successor<ROBOTS>,
    met: &mut Situations,
) -> String {
    let &[Event::Decides(robot, ..)] = &turn.events[..] else { return "None".to_owned() };
    if ROBOTS != 2 {
        return "None".to_owned();
    }
    let at = team.stance(robot).expect("a robot").to();
    let taken = |turn: &Successor<ROBOTS>| match &turn.events[..] {
        [Event::Decides(other, looks, Next::Drives(_))] if *other == robot && looks.len() == 1 => {
            Some(looks[0].0)
        }
        _ => None,
    };
    let is_old = |side: &Side| team.known(EdgeMark::Open, at).has(Step::Cross(*side));
    let sides: BTreeSet<Side> = turns.iter().filter_map(taken).filter(is_old).collect();
    met.old += usize::from(!sides.is_empty());
    met.choices += usize::from(sides.len() > 1);
    format!("Some ({robot}%nat,{})", list(sides.iter().map(|side| format!("{side:?}"))))
}

/// An event as those of the proofs.
fn events<const ROBOTS: usize>(team: &Team<ROBOTS>, event: &Event, met: &mut Situations) -> Vec<String> {
    let (robot, looks, next) = match event {
        Event::Arrives(robot, _) => return vec![format!("Comes {robot}")],
        Event::Decides(robot, looks, next) => (*robot, looks, next),
    };
    let at = cell(team.stance(robot).expect("a robot").to());
    let last = if matches!(next, Next::Drives(_)) { looks.len() } else { 0 };
    let seen = |(number, &(side, sight)): (usize, &(Side, Sight))| {
        let word = match sight {
            Sight::Obstacle => "SeesBlocked",
            Sight::Free if number + 1 == last => "Leaves",
            Sight::Free | Sight::Robot => "SeesOther",
        };
        met.walls += usize::from(sight == Sight::Obstacle);
        format!("{word} {robot} {at}%Z {side:?}")
    };
    looks.iter().enumerate().map(seen).collect()
}

/// The sides that count as covered for `robot`, node by node.
fn covered<const ROBOTS: usize>(team: &Team<ROBOTS>, area: Area, robot: usize) -> String {
    let has = |sides: Steps| Side::ALL.map(|side| sides.has(Step::Cross(side)));
    bits(&area.cells().flat_map(|node| has(team.covered(robot, node))).collect::<Vec<_>>())
}
