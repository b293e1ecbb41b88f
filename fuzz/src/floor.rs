//! Agents on a small floor: the cells, the walls, the scheme, who acts next and which sensors are missed are in the
//! bytes. When the bytes have ended, the agents act in turn and miss nothing.

use tautline_kernel::ants;
use tautline_kernel::bricks::{self, Agent, Condition, Next};
use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::floor::{Floor, Mark, Scan, Sensor, settle};
use tautline_kernel::ground::{Cell, Edge, Side, Step};
use tautline_proofs::engine::Tape;
use tautline_sim::layout::{Layout, Size};

use super::numbers;

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

/// The way that agents follow.
#[derive(Clone, Copy)]
enum Way {
    Ants(ants::Rule),
    Bricks(bricks::Rule),
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

struct Body {
    agent: Agent,
    cell: Cell,
    is_done: bool,
    /// The cells that are connected with its start.
    part: Cells,
}

/// Agents on a floor.
struct Team {
    way: Way,
    patch: Patch,
    bodies: Vec<Body>,
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
    let mut team = Team::new(&mut bytes);
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

impl Team {
    fn new(bytes: &mut Tape) -> Self {
        let way = one_of(
            bytes,
            &[
                Way::Bricks(bricks::Rule::REPAIRED),
                Way::Bricks(bricks::Rule::ROBUST),
                Way::Ants(ants::Rule::Repaired),
                Way::Ants(ants::Rule::Published),
                Way::Bricks(bricks::Rule::PUBLISHED),
            ],
        );
        let way = match way {
            Way::Ants(_) => way,
            Way::Bricks(rule) => {
                let patience = one_of(bytes, &[rule.patience, 0, 2]);
                Way::Bricks(bricks::Rule { patience, reach: one_of(bytes, &[rule.reach, 4]), ..rule })
            }
        };
        let is_robust = matches!(way, Way::Ants(_))
            || matches!(way, Way::Bricks(rule) if rule.has(Condition::SecondPass));
        let misses = bytes.pick(MISSES + 1);
        let is_repaired = !matches!(way, Way::Bricks(rule) if !rule.has(Condition::Laps));
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
        settle(&mut patch, &starts);
        let body = |(id, &cell)| {
            let part = patch.spread(patch.bit(cell), Cells::MAX);
            Body { agent: Agent::new(id), cell, is_done: false, part }
        };
        let bodies = (0..).zip(&starts).map(body).collect();
        Self { way, patch, bodies, misses, is_promised: is_repaired && (misses == 0 || is_robust) }
    }

    /// Those who are not done.
    fn awake(&self) -> Vec<usize> {
        (0..self.bodies.len()).filter(|&agent| !self.bodies[agent].is_done).collect()
    }

    fn is_explored(&self) -> bool {
        let parts = self.bodies.iter().fold(0, |cells, body| cells | body.part);
        self.patch.marked(parts, |mark| mark == Mark::Unexplored) == 0
    }

    /// Ants never know that they are done: for them the run is over when all is explored.
    fn is_over(&self) -> bool {
        matches!(self.way, Way::Ants(_)) && self.is_explored()
    }

    /// Whether a cell with such a mark is left to go through.
    fn is_left(&self, mark: Mark) -> bool {
        match mark {
            Mark::Unexplored | Mark::Explored | Mark::Closing => true,
            Mark::Visited => matches!(self.way, Way::Bricks(rule) if rule.has(Condition::SecondPass)),
            Mark::Sealed => false,
        }
    }

    /// The cells of a part that are left to go through.
    fn left(&self, part: Cells) -> Cells {
        self.patch.marked(part, |mark| self.is_left(mark))
    }

    fn act(&mut self, agent: usize, bytes: &mut Tape<'_>) {
        let before = self.patch.sensors.clone();
        let body = &mut self.bodies[agent];
        let from = body.cell;
        let scan = Scan::new(&self.patch, from, &mut Misses { bytes, left: &mut self.misses });
        match self.way {
            Way::Ants(rule) => {
                if let Some(side) = ants::act(rule, &mut self.patch, from, &scan) {
                    body.cell = from.beyond(side);
                }
            }
            Way::Bricks(rule) => {
                let act = body.agent.decide(rule, &scan);
                body.cell = bricks::carry_out(&mut self.patch, from, &act);
                body.is_done = act.next == Next::Done;
            }
        }
        let Body { cell, is_done, part, .. } = self.bodies[agent];
        let is_open = |side: &Side| self.patch.layout.is_open(Edge::new(from, *side));
        let is_step = Side::ALL.iter().filter(|&side| is_open(side)).any(|&side| from.beyond(side) == cell);
        assert!(from == cell || is_step, "from {from} to {cell}:\n{}", self.patch.layout);
        for (before, after) in before.iter().zip(&self.patch.sensors) {
            let is_same = before.serial == after.serial;
            let is_back = !self.is_left(before.mark) && self.is_left(after.mark);
            let is_forgotten = before.mark != Mark::Unexplored && after.mark == Mark::Unexplored;
            assert!(!is_same || !is_back && !is_forgotten, "{before:?} is {after:?}");
        }
        if self.is_promised && matches!(self.way, Way::Bricks(_)) {
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
        if let Way::Bricks(_) = self.way {
            let parts = self.bodies.iter().fold(0, |cells, body| cells | body.part);
            let visited = self.patch.marked(parts, |mark| matches!(mark, Mark::Visited | Mark::Sealed));
            assert_eq!(visited, parts, "BRICKS-6:\n{}", self.patch.layout);
        }
    }
}
