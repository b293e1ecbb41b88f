//! Runs of agents that search in trees, on drawn floors: what each action does to the sensors.

use std::collections::BTreeSet;

use tautline_kernel::bricks::tree::{Agent, Label, Next, Note, Rule, State, act, settle};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::Floor;
use tautline_kernel::ground::{Cell, Edge, Side};

use super::ground::Ground;
use super::runs::Draw;
use super::term::{cell, definition, list};

/// No sensor is missed.
struct Sees;

impl Oracle for Sees {
    fn pick(&mut self, _: u32) -> u32 {
        0
    }
}

/// What a sensor says but the crossings.
type Said = (State, Label, Option<Side>);

const fn said(note: Note) -> Said {
    (note.state, note.label, note.side)
}

/// A floor of at most 5×4 cells, of which those that are connected with the first.
fn floor(draw: &mut Draw) -> Ground<Note> {
    let mut floor = Ground::default();
    let (width, height) = (2 + draw.below(4) as i16, 2 + draw.below(3) as i16);
    let all = (0..height).flat_map(|y| (0..width).map(move |x| Cell::new(x, y)));
    let free: Vec<Cell> = all.filter(|_| draw.below(8) > 0).collect();
    for &cell in &free {
        let sides = [Side::East, Side::South].into_iter().filter(|_| draw.below(8) == 0);
        floor.walls.extend(sides.map(|side| Edge::new(cell, side)));
    }
    let mut left: Vec<Cell> = free.first().copied().into_iter().collect();
    while let Some(cell) = left.pop() {
        if floor.sensors.insert((cell.x, cell.y), Note::default()).is_none() {
            let open = Side::ALL.into_iter().filter(|&side| floor.is_open(Edge::new(cell, side)));
            left.extend(open.map(|side| cell.beyond(side)).filter(|next| free.contains(next)));
        }
    }
    floor
}

/// A run: the cells, the walls, where the agents start, and of each action the cell of the agent, what the sensors say
/// that it changes, and whether it is done then. Labels are numbered in their order.
fn run(rule: Rule, agents: u8, draw: &mut Draw, met: &mut BTreeSet<State>) -> String {
    let mut floor = floor(draw);
    let cells: Vec<Cell> = floor.sensors.keys().map(|&at| Cell::from(at)).collect();
    let starts: Vec<Cell> = (0..agents).map(|_| cells[draw.below(cells.len() as u64) as usize]).collect();
    settle(&mut floor, &starts);
    let mut team: Vec<(Agent, Cell, bool)> =
        (0..agents).zip(&starts).map(|(id, &start)| (Agent::new(id), start, false)).collect();
    let (mut actions, mut labels) = (Vec::new(), BTreeSet::new());
    while team.iter().any(|&(_, _, is_done)| !is_done) {
        let (agent, at, is_done) = &mut team[draw.below(agents.into()) as usize];
        if *is_done {
            continue;
        }
        let before = floor.clone();
        let here = *at;
        let (action, then) = act(rule, &mut floor, agent, here, &mut Sees);
        *at = then;
        *is_done = action.next == Next::Done;
        let changes = floor.sensors.iter().map(|(&at, &note)| (Cell::from(at), said(note)));
        let changes: Vec<(Cell, Said)> =
            changes.filter(|&(cell, note)| before.sensor(cell).map(said) != Some(note)).collect();
        assert!(changes.iter().all(|&(cell, _)| cell == here || cell == then), "it writes where it is");
        labels.extend(changes.iter().filter(|(_, said)| said.0 == State::Open).map(|(_, said)| said.1));
        met.extend(changes.iter().map(|(_, said)| said.0));
        // First what it does to its own cell.
        let (own, other): (Vec<_>, Vec<_>) = changes.into_iter().partition(|&(cell, _)| cell == here);
        actions.push((here, [own, other].concat(), *is_done));
    }
    let number = |label: Label| labels.iter().position(|&other| other == label).unwrap_or_default();
    let change = |(at, (state, label, side)): (Cell, Said)| {
        let label = if state == State::Open { number(label) } else { 0 };
        let side = side.map_or(0, |side| 1 + side as usize);
        format!("({},({},{label},{side})%nat)", cell(at), state as usize)
    };
    let action = |(here, changes, is_done): (Cell, Vec<(Cell, Said)>, bool)| {
        format!("({},{},{is_done})", cell(here), list(changes.into_iter().map(change)))
    };
    let walls = floor.walls.iter().map(|edge| (edge.cell(), edge.side() == Side::East));
    let mut walls: Vec<(Cell, bool)> = walls.collect();
    walls.sort_unstable_by_key(|&(cell, is_east)| (cell.x, cell.y, is_east));
    format!(
        "\n ({},\n  {},{},\n  {})%Z",
        list(cells.into_iter().map(cell)),
        list(walls.into_iter().map(|(at, is_east)| format!("({},{is_east})", cell(at)))),
        list(starts.into_iter().map(cell)),
        list(actions.into_iter().map(action)),
    )
}

pub(super) fn terms() -> String {
    let mut text = String::new();
    let kind = "list (list (Z * Z) * list ((Z * Z) * bool) * list (Z * Z)\n  \
                * list ((Z * Z) * list ((Z * Z) * (nat * nat * nat)) * bool))";
    let (mut draw, mut met) = (Draw(2024), BTreeSet::new());
    for (name, rule) in [("tree", Rule::TREE), ("helpers", Rule::HELPERS)] {
        let runs: Vec<String> =
            (0..12).map(|number| run(rule, 1 + number % 4, &mut draw, &mut met)).collect();
        text += &definition(&format!("runs_{name}"), kind, &list(runs));
    }
    assert_eq!(met.len(), 3, "{met:?}");
    text
}
