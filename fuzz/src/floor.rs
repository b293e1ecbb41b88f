//! Agents on a small floor: the cells, the walls, the scheme, who acts next and which sensors are missed are in the
//! bytes. When the bytes have ended, the agents act in turn and miss nothing.

use tautline_grids::layout::{Layout, Size};
use tautline_kernel::ants;
use tautline_kernel::bricks::{Condition, Rule};
use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::floor::{Floor, Mark, Sensor};
use tautline_kernel::ground::{Cell, Edge, Side, Step};
use tautline_proofs::engine::Tape;
use tautline_proofs::floor::crew::{Body, BodyOf, Scheme, SensorData, Sight};

use super::parts::numbers;

/// The longest side, in cells.
const SIDE: u32 = 6;

/// The most agents.
const AGENTS: u32 = 3;

/// The most sensors that are missed in a run.
const MISSES: u32 = 4;

/// Rounds in which each agent acts once that are enough to end any run here.
const PATIENT: usize = 50_000;

/// Cells, one bit for each, row by row.
type Cells = u64;

/// A layout with sensors.
struct Patch {
    layout: Layout,
    /// Row by row.
    sensors: Vec<Sensor>,
    placed: Vec<u16>,
}

impl Patch {
    fn index(&self, cell: Cell) -> Option<usize> {
        let place = || cell.y as usize * self.layout.width() as usize + cell.x as usize;
        self.layout.is_free(cell).then(place)
    }

    fn bit(&self, cell: Cell) -> Cells {
        self.index(cell).map_or(0, |place| 1 << place)
    }

    fn cell(&self, place: u32) -> Cell {
        let width = self.layout.width() as u32;
        Cell::new((place % width) as i16, (place / width) as i16)
    }

    /// Whether both sensors say that the side between them is shut.
    fn is_shut(&self, edge: Edge) -> bool {
        let (one, side) = (edge.cell(), edge.side());
        let says = |cell, side| self.sensor(cell).is_some_and(|sensor| sensor.shut.has(Step::Cross(side)));
        says(one, side) && says(one.beyond(side), side.opposite())
    }

    /// Those of the cells that have such a mark.
    fn marked(&self, cells: Cells, is: impl Fn(Mark) -> bool) -> Cells {
        let places = (0..self.sensors.len()).filter(|place| cells >> place & 1 == 1);
        places.filter(|&place| is(self.sensors[place].mark)).fold(0, |set, place| set | 1 << place)
    }

    /// Whether the cells are connected, through sides that are not shut.
    fn are_connected(&self, cells: Cells) -> bool {
        self.spread(cells & cells.wrapping_neg(), cells) == cells
    }

    /// The cells among `cells` that are connected with the first one.
    fn spread(&self, first: Cells, cells: Cells) -> Cells {
        let mut found = first;
        let mut next = found;
        while next != 0 {
            let cell = self.cell(next.trailing_zeros());
            next &= next - 1;
            for side in Side::ALL {
                let new = self.bit(cell.beyond(side)) & cells & !found;
                let edge = Edge::new(cell, side);
                if new != 0 && self.layout.is_open(edge) && !self.is_shut(edge) {
                    found |= new;
                    next |= new;
                }
            }
        }
        found
    }
}

impl Floor for Patch {
    fn sensor(&self, cell: Cell) -> Option<Sensor> {
        self.index(cell).map(|place| self.sensors[place])
    }

    fn put(&mut self, cell: Cell, sensor: Sensor) {
        if let Some(place) = self.index(cell) {
            self.sensors[place] = sensor;
        }
    }

    fn unpack(&mut self, cell: Cell) -> u16 {
        self.index(cell).map_or(0, |place| {
            self.placed[place] += 1;
            self.placed[place]
        })
    }

    fn is_open(&self, edge: Edge) -> bool {
        self.layout.is_open(edge)
    }
}

/// Misses sensors as the bytes say, a bounded number of times.
struct Misses<'a, 'b> {
    bytes: &'a mut Tape<'b>,
    left: &'a mut u32,
}

impl Oracle for Misses<'_, '_> {
    fn pick(&mut self, below: u32) -> u32 {
        self.bytes.pick(below)
    }

    fn mishap(&mut self) -> bool {
        let is_missed = *self.left > 0 && self.bytes.pick(8) == 7;
        *self.left -= u32::from(is_missed);
        is_missed
    }
}

/// Agents on a floor.
struct Team<S: Scheme> {
    scheme: S,
    patch: Patch,
    bodies: Vec<BodyOf<S>>,
    /// The cells that are connected with the start of each.
    parts: Vec<Cells>,
    /// Sensors that may still be missed.
    misses: u32,
    /// Whether the clauses promise anything: without missed sensors of the repaired rule, with them of the robust one.
    is_promised: bool,
}

/// Agents of any scheme on any small floor: they go where they can, and no cell is taken back that is done with. Where
/// the clauses promise it, the cells that are left stay connected (BRICKS-2), an agent is done when nothing is left
/// (BRICKS-4), and the run ends with every cell explored (ANTS-1, BRICKS-5) and visited (BRICKS-6).
pub fn floor(bytes: &[u8]) {
    let numbers = numbers(bytes);
    let mut bytes = Tape(&numbers);
    match bytes.pick(5) {
        0 => run_bricks(Rule::REPAIRED, bytes),
        1 => run_bricks(Rule::ROBUST, bytes),
        2 => run(ants::Rule::Repaired, [true; 2], bytes),
        3 => run(ants::Rule::PUBLISHED, [true; 2], bytes),
        _ => run_bricks(Rule::PUBLISHED, bytes),
    }
}

fn run_bricks(rule: Rule, mut bytes: Tape) {
    let patience = one_of(&mut bytes, &[rule.patience, 0, 2]);
    let rule = Rule { patience, reach: one_of(&mut bytes, &[rule.reach, 4]), ..rule };
    run(rule, [Condition::Laps, Condition::SecondPass].map(|condition| rule.has(condition)), bytes);
}

/// A run of a scheme of which the clauses promise something without missed sensors, and with them.
fn run<S: Scheme<Sensor = Sensor>>(scheme: S, promises: [bool; 2], mut bytes: Tape) {
    let mut team = Team::new(scheme, promises, &mut bytes);
    while !bytes.0.is_empty() {
        let awake = team.awake();
        if awake.is_empty() || team.is_over() {
            return team.check_end();
        }
        let agent = awake[bytes.pick(awake.len() as u32) as usize];
        team.act(agent, &mut bytes);
    }
    for _ in 0..if team.is_promised { PATIENT } else { 64 } {
        let awake = team.awake();
        if awake.is_empty() || team.is_over() {
            return team.check_end();
        }
        for agent in awake {
            team.act(agent, &mut bytes);
        }
    }
    assert!(!team.is_promised, "the run is still under way:\n{}", team.patch.layout);
}

impl<S: Scheme<Sensor = Sensor>> Team<S> {
    fn new(scheme: S, [is_repaired, is_robust]: [bool; 2], bytes: &mut Tape) -> Self {
        let misses = bytes.pick(MISSES + 1);
        let (width, height) = (1 + bytes.pick(SIDE), 1 + bytes.pick(SIDE));
        let mut layout = Layout::of(Size::new(width.into(), height.into()).expect("a small layout"));
        let cells: Vec<Cell> = layout.cells().collect();
        // The plain case is an open floor: a zero byte builds nothing.
        for _ in 0..bytes.pick(16) {
            layout.block(cells[bytes.pick(cells.len() as u32) as usize]);
        }
        let edges: Vec<Edge> = layout.edges().collect();
        for _ in 0..if edges.is_empty() { 0 } else { bytes.pick(16) } {
            layout.build_wall(edges[bytes.pick(edges.len() as u32) as usize]);
        }
        let free: Vec<Cell> = cells.iter().copied().filter(|&cell| layout.is_free(cell)).collect();
        let agents = if free.is_empty() { 0 } else { 1 + bytes.pick(AGENTS) };
        let starts: Vec<Cell> = (0..agents).map(|_| free[bytes.pick(free.len() as u32) as usize]).collect();
        let blank = vec![Sensor::default(); cells.len()];
        let mut patch = Patch { layout, sensors: blank, placed: vec![0; cells.len()] };
        Sensor::settle(&mut patch, &starts);
        let parts = starts.iter().map(|&start| patch.spread(patch.bit(start), Cells::MAX)).collect();
        let bodies = Body::crew(&scheme, &starts);
        Self { scheme, patch, bodies, parts, misses, is_promised: is_repaired && (misses == 0 || is_robust) }
    }

    /// Those who are not done.
    fn awake(&self) -> Vec<usize> {
        (0..self.bodies.len()).filter(|&agent| !self.bodies[agent].is_done).collect()
    }

    fn is_explored(&self) -> bool {
        self.patch.marked(self.part(), |mark| mark == Mark::Unexplored) == 0
    }

    /// The cells that are connected with a start.
    fn part(&self) -> Cells {
        self.parts.iter().fold(0, |cells, part| cells | part)
    }

    /// Ants never know that they are done: for them the run is over when all is explored.
    fn is_over(&self) -> bool {
        self.scheme.may_roam(Sight::Whole) && self.is_explored()
    }

    /// The cells of a part that are left to go through.
    fn left(&self, part: Cells) -> Cells {
        self.patch.marked(part, |mark| self.scheme.passes(mark))
    }

    fn act(&mut self, agent: usize, bytes: &mut Tape<'_>) {
        let before = self.patch.sensors.clone();
        let body = &mut self.bodies[agent];
        let from = body.cell;
        let view = Sensor::look(&self.patch, from, &mut Misses { bytes, left: &mut self.misses });
        let act = self.scheme.decide(&mut body.memory, &view);
        body.carry_out(&self.scheme, &mut self.patch, &act);
        let (Body { cell, is_done, .. }, part) = (self.bodies[agent], self.parts[agent]);
        let is_open = |side: &Side| self.patch.layout.is_open(Edge::new(from, *side));
        let is_step = Side::ALL.iter().filter(|&side| is_open(side)).any(|&side| from.beyond(side) == cell);
        assert!(from == cell || is_step, "from {from} to {cell}:\n{}", self.patch.layout);
        for (before, after) in before.iter().zip(&self.patch.sensors) {
            let is_same = before.serial == after.serial;
            let is_back = !self.scheme.passes(before.mark) && self.scheme.passes(after.mark);
            let is_forgotten = before.mark != Mark::Unexplored && after.mark == Mark::Unexplored;
            assert!(!is_same || !is_back && !is_forgotten, "{before:?} is {after:?}");
        }
        if self.is_promised && self.scheme.promises(Sight::Whole) {
            let left = self.left(part);
            assert!(self.patch.are_connected(left), "BRICKS-2:\n{}", self.patch.layout);
            let is_all = self.patch.marked(part, |mark| mark == Mark::Unexplored) == 0;
            let is_rest = left & !self.patch.bit(cell) == 0;
            assert!(!is_done || is_all && is_rest, "BRICKS-4:\n{}", self.patch.layout);
        }
    }

    /// ANTS-1, BRICKS-5 and BRICKS-6.
    fn check_end(&self) {
        if !self.is_promised {
            return;
        }
        assert!(self.is_explored(), "a cell is unexplored in the end:\n{}", self.patch.layout);
        if self.scheme.promises(Sight::Whole) {
            let visited = self.patch.marked(self.part(), |mark| matches!(mark, Mark::Visited | Mark::Sealed));
            assert_eq!(visited, self.part(), "BRICKS-6:\n{}", self.patch.layout);
        }
    }
}
