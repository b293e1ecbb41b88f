//! A run that a search has found: the search's world makes it again by its choices. A team move is a robot's decision,
//! and the arrivals after it; whoever drives is drawn where it arrives. The first choice says whether robots drive at
//! equal speeds.

use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Cell, Edge, EdgeMark, Grid, Step, TinyGrid};
use tautline_kernel::kit::{Next, Rule as Kit, Sight};
use tautline_proofs::engine::states::{Bits, System};
use tautline_proofs::engine::world::World as _;
use tautline_proofs::kit::world::{Demand, Event, Setting, Speeds, Starts, World};
use tautline_proofs::run::Frame;

use super::{COVERS, ENDS, EQUAL, MOVES, WHOLE, nodes};
use crate::diagnostic::Diagnostic;
use crate::explore::ClauseId;
use crate::explore::fit::of_choices;
use crate::explore::run::{End, Team};
use crate::explore::setup::Setup;
use crate::explore::survey::Survey;
use crate::kit::paths;
use crate::layout::Layout;

/// The first choice of runs at any speeds, and of those at equal ones.
const ANY: u32 = 0;
const EQUALLY: u32 = 1;

/// The choices of a run at such speeds whose steps have these numbers.
pub(super) fn choices(speeds: Speeds, steps: &[u32]) -> Vec<u32> {
    let first = match speeds {
        Speeds::Any | Speeds::OneByOne => ANY,
        Speeds::Equal => EQUALLY,
    };
    [&[first], steps].concat()
}

/// The team of `setup`, which has choices.
pub(super) fn start(setup: &Setup, rule: Kit) -> Result<Box<dyn Team>, Diagnostic> {
    match setup.robots {
        1 => begin::<1>(setup, rule),
        2 => begin::<2>(setup, rule),
        3 => begin::<3>(setup, rule),
        robots => Err(of_choices(format_args!("{robots} robots make no choices"))),
    }
}

fn begin<const ROBOTS: usize>(setup: &Setup, rule: Kit) -> Result<Box<dyn Team>, Diagnostic> {
    let layout = &setup.layout;
    let starts = setup.starts();
    let setting = Setting::<ROBOTS>::new(rule, (layout.width(), layout.height()));
    let blank = TinyGrid::new(layout.size().area());
    let cells = <[Cell; ROBOTS]>::try_from(starts.as_slice());
    let (Some(setting), Some(mut given), Ok(cells)) = (setting, blank, cells) else {
        return Err(of_choices("the layout is too large for choices"));
    };
    for edge in setting.area.edges().filter(|&edge| !layout.is_open(edge)) {
        given.put_edge(EdgeMark::Wall, edge);
    }
    let (speeds, choices) = match setup.choices.split_first() {
        Some((&ANY, choices)) => (Speeds::Any, choices),
        Some((&EQUALLY, choices)) => (Speeds::Equal, choices),
        Some(_) | None => return Err(of_choices("the choices do not say how fast robots drive")),
    };
    let setting = Setting { given: Some(given), speeds, ..setting };
    let Some(world) = setting.start(cells) else {
        return Err(of_choices("the robots cannot start so"));
    };
    let due = paths(layout, setup.base);
    let choices = choices.to_vec();
    let (past, broken) = (Vec::new(), Vec::new());
    Ok(Box::new(Scripted { setting, world, choices, past, cells: starts, due, broken }))
}

struct Scripted<const ROBOTS: usize> {
    setting: Setting<ROBOTS>,
    world: World<ROBOTS>,
    choices: Vec<u32>,
    /// The world before each choice so far, and whose it was.
    past: Vec<(World<ROBOTS>, usize)>,
    cells: Vec<Cell>,
    /// The paths within reach.
    due: Vec<Edge>,
    /// What the last team move has broken.
    broken: Vec<Demand>,
}

/// What is to happen next.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Wanted {
    Decision,
    Arrival,
}

impl<const ROBOTS: usize> Scripted<ROBOTS> {
    /// Makes the next choice, if it is what is wanted.
    fn choose(&mut self, wanted: Wanted) -> Option<Event> {
        let number = *self.choices.get(self.past.len())?;
        let turned = self.setting.turns(&self.world).into_iter().nth(number as usize)?;
        let event = turned.events.into_iter().next()?;
        let (robot, is_wanted) = match event {
            Event::Arrives(robot, _) => (robot, wanted == Wanted::Arrival),
            Event::Decides(robot, ..) => (robot, wanted == Wanted::Decision),
        };
        if !is_wanted {
            return None;
        }
        self.past.push((self.world, robot));
        self.broken.extend(turned.breaks);
        self.world = turned.world;
        Some(event)
    }

    /// Whether the choices have led back to where the robots were, and keep nobody from acting: so they can go on for
    /// ever.
    fn goes_round(&self) -> bool {
        let Some(home) = self.past.iter().position(|(world, _)| *world == self.world) else { return false };
        let round = &self.past[home..];
        let awake = round.iter().fold(Bits::MAX, |awake, (world, _)| awake & self.setting.awake(world));
        let acting = round.iter().fold(0, |acting, (_, robot)| acting | 1 << robot);
        awake & !acting == 0
    }

    fn clause(&self, demand: Demand) -> ClauseId {
        let is_at_equal_speeds = self.setting.speeds == Speeds::Equal && demand == Demand::Contact;
        if is_at_equal_speeds { EQUAL } else { ClauseId::new(demand.clause(ROBOTS)) }
    }
}

impl<const ROBOTS: usize> Team for Scripted<ROBOTS> {
    fn cells(&self) -> &[Cell] {
        &self.cells
    }

    fn advance(&mut self, _: &mut dyn FnMut(Edge) -> bool) -> Result<Frame, End> {
        self.broken.clear();
        let Some(Event::Decides(robot, looks, next)) = self.choose(Wanted::Decision) else {
            return Err(if self.goes_round() { End::Endless } else { End::Exhausted });
        };
        while self.choose(Wanted::Arrival).is_some() {}
        let (mut steps, mut blocked) = (vec![Step::Stay; ROBOTS], vec![false; ROBOTS]);
        match (next, looks.last()) {
            (Next::Drives(to), Some(&(side, _))) => {
                steps[robot] = Step::Cross(side);
                self.cells[robot] = to;
            }
            (_, Some(&(side, Sight::Obstacle))) => {
                (steps[robot], blocked[robot]) = (Step::Cross(side), true);
            }
            (_, Some((_, Sight::Free | Sight::Robot)) | None) => {}
        }
        Ok(Frame { kind: Kind::Advance, steps, blocked, cells: self.cells.clone() })
    }

    fn due(&self, _: &Layout) -> u32 {
        nodes(&self.due, &self.cells).len() as u32
    }

    fn missed(&self, _: &Layout, chart: &Survey) -> Vec<Cell> {
        let mut missed = nodes(&self.due, &self.cells);
        missed.retain(|&node| chart.step(node).is_none());
        missed.into_iter().collect()
    }

    fn broken_in_move(&self, _: &[Cell], _: &Frame) -> Vec<ClauseId> {
        let mut broken: Vec<ClauseId> = self.broken.iter().map(|&demand| self.clause(demand)).collect();
        broken.sort_unstable();
        broken.dedup();
        broken
    }

    fn broken_at_end(&self, _: &Layout, _: &Survey, end: End) -> Vec<ClauseId> {
        if end == End::Endless {
            return vec![ENDS];
        }
        if !self.setting.turns(&self.world).is_empty() {
            return Vec::new();
        }
        let ends = [
            (Demand::Moves, Starts::Anywhere, MOVES),
            (Demand::Covers, Starts::Anywhere, COVERS),
            (Demand::Whole, Starts::SideBySide, WHOLE),
        ];
        let is_broken = |&(demand, starts, _): &(Demand, Starts, ClauseId)| {
            let asked = Setting { demand: Some(demand), starts, ..self.setting };
            asked.broken_at_end(&self.world, &[]).contains(&demand)
        };
        ends.iter().filter(|end| is_broken(end)).map(|&(.., clause)| clause).collect()
    }
}
