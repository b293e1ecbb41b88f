//! Runs of agents that search in trees, on drawn floors: what each action does to the sensors.

use std::collections::BTreeSet;

use tautline_kernel::bricks::tree::{Agent, Label, Next, Note, Rule, State, act, settle};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{COMPASS, Floor};
use tautline_kernel::ground::{Cell, Edge, Side};

use super::ground::Ground;
use super::term::{cell, definition, list};
use crate::draw::Draw;

/// Eyes that miss some sensors, until they have missed so many.
pub(super) struct Eyes {
    draw: Draw,
    misses: u32,
}

impl Eyes {
    /// Eyes that miss nothing.
    pub(super) const fn all() -> Self {
        Self { draw: Draw(0), misses: 0 }
    }
}

impl Oracle for Eyes {
    fn pick(&mut self, below: u32) -> u32 {
        let is_missed = self.misses > 0 && self.draw.below(6) == 0;
        self.misses -= u32::from(is_missed);
        u32::from(is_missed).min(below - 1)
    }
}

/// A sensor's words but the crossings.
type SensorWords = (State, Label, Option<Side>);

const fn said(note: Note) -> SensorWords {
    (note.state, note.label, note.side)
}

/// A floor of `width` by `height` cells, or those of its cells that are connected with the first free one.
fn floor<S: Copy + Default>(
    (width, height): (i16, i16),
    mut is_free: impl FnMut(Cell) -> bool,
    mut is_wall: impl FnMut(Edge) -> bool,
) -> Ground<S> {
    let mut floor = Ground::default();
    let all = (0..height).flat_map(|y| (0..width).map(move |x| Cell::new(x, y)));
    let free: Vec<Cell> = all.filter(|&cell| is_free(cell)).collect();
    for &cell in &free {
        let edges = [Side::East, Side::South].map(|side| Edge::new(cell, side));
        floor.walls.extend(edges.into_iter().filter(|&edge| is_wall(edge)));
    }
    let mut left: Vec<Cell> = free.first().copied().into_iter().collect();
    while let Some(cell) = left.pop() {
        if floor.sensors.insert((cell.x, cell.y), S::default()).is_none() {
            let open = Side::ALL.into_iter().filter(|&side| floor.is_open(Edge::new(cell, side)));
            left.extend(open.map(|side| cell.beyond(side)).filter(|next| free.contains(next)));
        }
    }
    floor
}

/// A floor of at most 5×4 cells.
pub(super) fn drawn<S: Copy + Default>(draw: &mut Draw) -> Ground<S> {
    let size = (2 + draw.below(4) as i16, 2 + draw.below(3) as i16);
    let mut walls = Draw(draw.below(1 << 30));
    floor(size, |_| draw.below(8) > 0, |_| walls.below(8) == 0)
}

/// A run in which agents act in this order: the cells, the walls, where the agents start, and of each action who acts,
/// whether it misses a sensor, through which side it goes, from which cell, and what the sensors say that it changes.
/// Labels are numbered in their order.
fn run(
    rule: Rule,
    mut floor: Ground<Note>,
    starts: &[Cell],
    order: impl IntoIterator<Item = usize>,
    eyes: &mut Eyes,
    met: &mut BTreeSet<State>,
) -> String {
    let cells: Vec<Cell> = floor.sensors.keys().map(|&at| Cell::from(at)).collect();
    settle(&mut floor, starts);
    let mut team: Vec<(Agent, Cell, bool)> =
        (0..).zip(starts).map(|(id, &start)| (Agent::new(id), start, false)).collect();
    let (mut actions, mut labels) = (Vec::new(), BTreeSet::new());
    for turn in order {
        if team.iter().all(|&(_, _, is_done)| is_done) {
            break;
        }
        let (agent, at, is_done) = &mut team[turn];
        if *is_done {
            continue;
        }
        let (before, misses) = (floor.clone(), eyes.misses);
        let here = *at;
        let (mut near, mut twin) = (floor.near(here), *agent);
        let mut twin_eyes = Eyes { draw: Draw(eyes.draw.0), misses };
        let (action, then) = act(rule, &mut floor, agent, here, eyes);
        let of_twin = act(rule, &mut near, &mut twin, here, &mut twin_eyes);
        assert_eq!((of_twin, twin), ((action, then), *agent), "it reads the cells around");
        *at = then;
        *is_done = action.next == Next::Done;
        let changes = floor.sensors.iter().map(|(&at, &note)| (Cell::from(at), said(note)));
        let changes: Vec<(Cell, SensorWords)> =
            changes.filter(|&(cell, note)| before.sensor(cell).map(said) != Some(note)).collect();
        assert!(changes.iter().all(|&(cell, _)| cell == here || cell == then), "it writes where it is");
        labels.extend(changes.iter().filter(|(_, said)| said.0 == State::Open).map(|(_, said)| said.1));
        met.extend(changes.iter().map(|(_, said)| said.0));
        // First what it does to its own cell.
        let (own, other): (Vec<_>, Vec<_>) = changes.into_iter().partition(|&(cell, _)| cell == here);
        let way = match action.next {
            Next::Done => 0,
            Next::Waits => 5,
            Next::Goes(side) | Next::Adopts(side) | Next::Explores(side) => 1 + side as usize,
        };
        actions.push((format!("({turn},{},{way})%nat", eyes.misses < misses), here, [own, other].concat()));
    }
    let number = |label: Label| labels.iter().position(|&other| other == label).unwrap_or_default();
    let change = |(at, (state, label, side)): (Cell, SensorWords)| {
        let label = if state == State::Open { number(label) } else { 0 };
        let side = side.map_or(0, |side| 1 + side as usize);
        format!("({},({},{label},{side})%nat)", cell(at), state as usize)
    };
    let action = |(turn, here, changes): (String, Cell, Vec<(Cell, SensorWords)>)| {
        format!("({turn},{},{})", cell(here), list(changes.into_iter().map(change)))
    };
    format!(
        "\n ({},\n  {},{},\n  {})%Z",
        list(cells.into_iter().map(cell)),
        floor.walls(),
        list(starts.iter().copied().map(cell)),
        list(actions.into_iter().map(action)),
    )
}

/// A run of so many agents on a drawn floor, until all are done.
fn drawn_run(rule: Rule, agents: usize, misses: u32, draw: &mut Draw, met: &mut BTreeSet<State>) -> String {
    let floor = drawn(draw);
    let cells: Vec<Cell> = floor.sensors.keys().map(|&at| Cell::from(at)).collect();
    let starts: Vec<Cell> = (0..agents).map(|_| cells[draw.below(cells.len() as u64) as usize]).collect();
    let mut eyes = Eyes { draw: Draw(draw.below(1 << 30)), misses };
    let order = std::iter::repeat_with(|| draw.below(agents as u64) as usize);
    run(rule, floor, &starts, order, &mut eyes, met)
}

/// An order of two agents of brick-tree in 6×2 cells, in which the first makes more than four moves a cell, though
/// there is one tree.
const MANY_MOVES: &str = "000000100000000000000110000000000001100000001000000000000";

/// The lowest `bits` of the labels of the first trees, of those around a byte more, and of the last ones, of agents
/// with the least ids, those around half of them, and the greatest.
fn labels(bits: u8) -> String {
    let founded = [0, 1, 2, 255, 256, 65_535, 65_536, Label::TREES - 2, Label::TREES - 1];
    let answers = founded.iter().flat_map(|&founded| [0, 1, 127, 128, 254, 255].map(|id| (founded, id)));
    let answers = answers.filter_map(|(founded, id)| {
        let label = Label::new(founded, id)?.lowest(bits).number();
        Some(format!("({founded},{id},{label})%N"))
    });
    definition(&format!("labels_{bits}"), "list (N * N * N)", &list(answers))
}

/// How many times the cells beyond the sides of a cell were entered, in the order of the compass, 0 where a wall is,
/// the others being its children; and to which of them, counted from 1, an agent goes, 0 if to none.
fn children(rule: Rule) -> String {
    let label = Label::new(0, 0).unwrap_or_default();
    let counts = (0..256_u16).map(|number| [0, 2, 4, 6].map(|place| number >> place & 3));
    let answers = counts.map(|counts| {
        let (here, mut floor) = (Cell::new(1, 1), Ground::default());
        floor.put(here, Note::default().of_tree(label, None));
        for (side, crossings) in COMPASS.into_iter().zip(counts).filter(|&(_, crossings)| crossings > 0) {
            let child = Note::default().of_tree(label, Some(side.opposite()));
            floor.put(here.beyond(side), Note { crossings, ..child });
        }
        let (action, _) = act(rule, &mut floor, &mut Agent::new(0), here, &mut Eyes::all());
        let way = COMPASS.into_iter().position(|side| action.next == Next::Goes(side));
        format!("({},{})%nat", list(counts.map(|count| count.to_string())), way.map_or(0, |way| way + 1))
    });
    list(answers)
}

pub(super) fn terms() -> String {
    let mut text = String::new();
    let kind = "list (list (Z * Z) * list ((Z * Z) * bool) * list (Z * Z)\n  \
                * list ((nat * bool * nat) * (Z * Z) * list ((Z * Z) * (nat * nat * nat))))";
    let (mut draw, mut met) = (Draw(2024), BTreeSet::new());
    for (name, rule, misses) in
        [("tree", Rule::TREE, 0), ("helpers", Rule::HELPERS, 0), ("careful", Rule::ROBUST, 12)]
    {
        let runs: Vec<String> =
            (0..12).map(|number| drawn_run(rule, 1 + number % 4, misses, &mut draw, &mut met)).collect();
        text += &definition(&format!("runs_{name}"), kind, &list(runs));
    }
    assert_eq!(met.len(), 3, "{met:?}");
    let mut sees = Eyes::all();
    let has_wall = |edge: Edge| edge.side() == Side::South && [(1, 0), (4, 0)].contains(&edge.cell().into());
    let starts = [Cell::new(3, 0), Cell::new(0, 1)];
    let order = MANY_MOVES.bytes().map(|digit| usize::from(digit - b'0'));
    let many = run(Rule::TREE, floor((6, 2), |_| true, has_wall), &starts, order, &mut sees, &mut met);
    text += &definition("runs_of_many_moves", kind, &list([many]));
    let is_wall = |edge: Edge| edge == Edge::new(Cell::new(1, 0), Side::South);
    let alone = run(
        Rule::TREE,
        floor((3, 2), |_| true, is_wall),
        &[Cell::new(1, 1)],
        std::iter::repeat(0),
        &mut sees,
        &mut met,
    );
    text += &definition("runs_of_a_brick_tree_alone", kind, &list([alone]));
    for (name, rule) in [("tree", Rule::TREE), ("helpers", Rule::HELPERS)] {
        text += &definition(&format!("children_{name}"), "list (list nat * nat)", &children(rule));
    }
    text + &labels(32) + &labels(8)
}
