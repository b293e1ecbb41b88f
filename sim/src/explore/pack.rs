//! Pack exploration (Jasmine Xavier and Shantha Selva Kumari 2013, II): its row, and its team: the kernel's pack, a
//! layout that answers for what robots see, and the history on the heap.
//!
//! A cell is explored once a robot has seen it (II.A), and not only where a robot was.

mod layers;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Cell, Circle, Step};
use tautline_kernel::pack::{
    Chart, End as Over, MAX_ROBOTS, MoveKind, RangeError, Rule as Pack, Scratch, SetupError, Team as Robots,
};
use tautline_proofs::pack::{Moves, are_side_by_side};
use tautline_proofs::run::Frame;

use super::clause::broken;
use super::switches::SwitchableRule;
use super::{
    Clause, ClauseId, End, Layer, Look, Profile, Rule, Scene, Setup, Starts, Surroundings, Survey, Team,
    has_double, unlinked,
};
use crate::options::Extra;
use tautline_grids::layout::Layout;

/// The team is not connected after a team move.
pub const CONNECTED: ClauseId = ClauseId::new("PACK-1");

/// Two robots are in one cell.
pub const SINGLE: ClauseId = ClauseId::new("PACK-2");

/// The run ends, and a cell in reach is unexplored.
pub const COVERS: ClauseId = ClauseId::new("PACK-3");

/// As [`COVERS`], where robots do not start side by side.
pub const COVERS_APART: ClauseId = ClauseId::new("PACK-5");

/// The run goes on for ever.
pub const ENDS: ClauseId = ClauseId::new("PACK-4");

/// Team moves for each cell without anything new, after which a run is over.
const PATIENCE: usize = 100;

/// Robots that see, and stay connected.
pub static PACK: Profile = Profile {
    about: "Robots that see, go where most is to be seen for the way, and stay connected without a base",
    rules: &[
        Rule::published(|setup| start(setup, Pack::PUBLISHED)).switched(&switched(Pack::PUBLISHED)),
        Rule::repaired(|setup| start(setup, Pack::REPAIRED)).switched(&switched(Pack::REPAIRED)),
    ],
    team: "pack",
    robots: 1..=MAX_ROBOTS,
    starts: Starts::Alone,
    extras: &[Extra::RANGE, Extra::SIGHT],
    look: Look::Robots,
    clauses: &[
        Clause::new(CONNECTED.as_str()),
        Clause::new(SINGLE.as_str()),
        Clause { missed: Some("Within reach and unexplored"), ..Clause::new(COVERS.as_str()) },
        Clause::new(ENDS.as_str()),
        Clause { missed: Some("Within reach and unexplored"), ..Clause::new(COVERS_APART.as_str()) },
    ],
    ..Profile::named("pack")
};

struct PackTeam {
    robots: Robots,
    /// The clause about cells that are left out.
    covers: ClauseId,
    layout: Layout,
    chart: Chart<Vec<[u64; 2]>>,
    past: Moves,
    reached: Vec<u32>,
    queue: Vec<Cell>,
    gains: Vec<u16>,
    rounds: u32,
    /// The free cells, and the obstacles, that were seen in the last team move; before the first one those at the
    /// start.
    free: Vec<Cell>,
    obstacles: Vec<Cell>,
    /// The last team move.
    made: Option<MoveKind>,
    /// Team moves since something new was seen.
    idle: usize,
}

/// A rule whose conditions can be switched.
const fn switched(rule: Pack) -> SwitchableRule<Pack> {
    SwitchableRule { rule, start, hunt: |_, _| None }
}

/// The pack of `setup`, each robot at its start.
fn start(setup: &Setup, rule: Pack) -> Result<Box<dyn Team>, Diagnostic> {
    let layout = &setup.layout;
    setup.refuse_walls("a pack", "cells:64x64:0.1")?;
    let sight_cells = setup.options.sight_cells.unwrap_or(Pack::SIGHT_CELLS.into());
    let range_cells = setup.options.range_cells.unwrap_or(Pack::RANGE_CELLS);
    let rule = rule.within(sight_cells, range_cells).map_err(unfit)?;
    let robots = Robots::new(rule, &setup.starts()).map_err(refused)?;
    let area = layout.size().area();
    let words = vec![[0; 2]; Chart::<Vec<[u64; 2]>>::words(area)];
    let chart =
        Chart::new(area, words).unwrap_or_else(|| unreachable!("the words are as many as the map takes"));
    let cells = area.width() * area.height();
    let covers = if are_side_by_side(&setup.starts()) { COVERS } else { COVERS_APART };
    let mut team = PackTeam {
        robots,
        covers,
        layout: layout.clone(),
        chart,
        past: Moves::default(),
        reached: vec![0; cells],
        queue: vec![Cell::default(); cells],
        gains: vec![0; cells],
        rounds: 0,
        free: Vec::new(),
        obstacles: Vec::new(),
        made: None,
        idle: 0,
    };
    team.look();
    Ok(Box::new(team))
}

fn unfit(unfit: RangeError) -> Diagnostic {
    let (field, remedy) = match unfit {
        RangeError::Sight => ("sight", "give `sight` a number of cells from 1 to 31"),
        RangeError::Range => ("range", "give `range` a number of cells from 3 on"),
    };
    Diagnostic::of_field(field, unfit, remedy)
}

fn refused(refused: SetupError) -> Diagnostic {
    let (field, remedy) = match refused {
        SetupError::Robots(_) => ("robots", format!("give `robots` a number from 1 to {MAX_ROBOTS}")),
        SetupError::Together(_) => ("starts", "give each robot a start of its own".to_owned()),
        SetupError::Apart(..) => {
            ("starts", "start the robots nearer to each other, or give a greater `range`".to_owned())
        }
    };
    Diagnostic::of_field(field, refused, remedy)
}

impl PackTeam {
    /// All robots look round.
    fn look(&mut self) {
        let Self { robots, layout, chart, free, obstacles, .. } = self;
        for &cell in robots.cells() {
            let is_obstacle = |cell: Cell| !layout.is_free(cell);
            chart.look(robots.rule().sight(), cell, is_obstacle, |cell, is_obstacle| {
                if is_obstacle { &mut *obstacles } else { &mut *free }.push(cell);
            });
        }
    }

    /// Whether links by four corners join all robots: there is a spanning tree.
    fn is_connected(&self, cells: &[Cell]) -> bool {
        let range = u64::from(self.robots.rule().range_cells());
        let circle = Circle::new(4 * range * range);
        unlinked(cells[0], cells[1..].to_vec(), |one, other| circle.covers(one, other)) == 0
    }
}

impl Team for PackTeam {
    fn cells(&self) -> &[Cell] {
        self.robots.cells()
    }

    fn advance(&mut self, _: &mut dyn Surroundings) -> Result<Frame, End> {
        if self.idle > PATIENCE * self.reached.len() {
            return Err(End::Idle);
        }
        let Self { robots, chart, past, reached, queue, gains, rounds, .. } = self;
        let mut steps = [Step::Stay; MAX_ROBOTS];
        let mut memory = Scratch { reached, queue, gains, rounds };
        let made = robots.advance(chart, past, &mut memory, &mut steps).map_err(|over| match over {
            Over::Explored => End::Explored,
            Over::Stuck => End::Exhausted,
        })?;
        // What was seen at the start is shown with the first team move.
        if self.made.replace(made).is_some() {
            self.free.clear();
            self.obstacles.clear();
        }
        let known = self.free.len() + self.obstacles.len();
        self.look();
        let is_news = self.free.len() + self.obstacles.len() > known;
        self.idle = if is_news { 0 } else { self.idle + 1 };
        let kind = match made {
            MoveKind::TakenBack => Kind::Backtrack,
            MoveKind::Spread | MoveKind::Led(_) | MoveKind::Marched => Kind::Advance,
        };
        let cells = self.robots.cells().to_vec();
        Ok(Frame { kind, steps: steps[..cells.len()].to_vec(), blocked: vec![false; cells.len()], cells })
    }

    fn due(&self, layout: &Layout) -> u32 {
        layout.reachable(self.cells()).len() as u32
    }

    fn missed(&self, layout: &Layout, chart: &Survey) -> Vec<Cell> {
        chart.unexplored(layout.reachable(self.cells()))
    }

    fn seen(&self) -> &[Cell] {
        &self.free
    }

    fn broken_in_move(&self, _: &[Cell], frame: &Frame) -> Vec<ClauseId> {
        let is_double = has_double(&frame.cells);
        let is_apart = !self.is_connected(&frame.cells);
        broken([(is_apart, CONNECTED), (is_double, SINGLE)])
    }

    fn broken_at_end(&self, layout: &Layout, chart: &Survey, end: End) -> Vec<ClauseId> {
        let is_over = end != End::Endless && end != End::Idle;
        broken([(is_over && !self.missed(layout, chart).is_empty(), self.covers)])
    }

    fn layers(&self) -> Vec<Layer> {
        layers::layers(self.robots.rule())
    }

    fn show(&self, _: &[Cell], scene: &mut Scene) {
        layers::show(&self.obstacles, self.robots.aims().flatten(), scene);
    }
}
