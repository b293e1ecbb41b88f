//! The run loop of all exploration schemes. A [`Scheme`] sees what its team knows and makes one team move at a time;
//! the layout answers for the edges it tries; every move becomes a [`Frame`] and is checked for the sentences of
//! `SPEC.md` that the scheme is bound to. A run goes on after a violation, so that its cost can be compared.

pub mod agents;
pub(crate) mod chain;
pub mod floor;
mod misfit;

use std::collections::BTreeMap;
use std::fmt;
use std::num::NonZeroU32;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use tautline_kernel::ants;
use tautline_kernel::bricks;
use tautline_kernel::chain::{self as kernel, Rule};
use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Area, Cell, Edge};
use tautline_proofs::chain::breach::Breach;
use tautline_proofs::chain::links::within_reach;
use tautline_proofs::run::Frame;

use crate::fault::{Fault, Halt};
use crate::layout::generate::Probability;
use crate::layout::{Layout, Problem};
use crate::words::Worded;

use self::agents::Way;
use self::floor::Component;
pub use self::misfit::Misfit;

/// A way for a team to explore.
pub trait Scheme {
    /// The cells among which it is to explore.
    fn area(&self) -> Area;
    /// Where the robots are; the base of a chain is the first.
    fn cells(&self) -> &[Cell];
    /// How many cells of `layout` it is to explore.
    fn due(&self, layout: &Layout) -> u32;
    /// Makes one team move. `is_open` answers for every edge that is crossed without being known.
    ///
    /// # Errors
    /// [`End`] if the run is over.
    fn advance(&mut self, is_open: &mut dyn FnMut(Edge) -> bool) -> Result<Frame, End>;
    /// What the last team move, in which the robots went on from `before`, may not be.
    fn broken_in_move(&self, before: &[Cell], frame: &Frame) -> Vec<Breach>;
    /// What the end of a run that has explored what is in `chart` may not be.
    fn broken_at_end(&self, setup: &Setup, chart: &Chart, end: End) -> Vec<Breach>;
    /// The marks of cells that the last team move has changed, in order.
    fn marked(&self) -> &[(Cell, Mark)];
    /// The cells of the sensors that agents missed in the last team move, agent by agent.
    fn unseen(&self) -> &[Cell];
    /// The parts of a sensor floor in which agents started; none for schemes without one.
    fn components(&self) -> &[Component];
    /// How long the run has taken its slowest robot, where that is known.
    fn milliseconds(&self) -> Option<u64>;
}

/// Every scheme.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SchemeName {
    /// A base, a leader that seeks the frontier, and followers that keep radio contact.
    Chain,
    /// Agents on a sensor floor that go where they have been least; they never know that they are done.
    Ants,
    /// Brick&Mortar: agents on a sensor floor that mark cells as visited until none is left.
    Bricks,
    /// Brick&Mortar with ants' ways, robust against missed sensors.
    BricksAnts,
}

impl Worded for SchemeName {
    const WORDS: &'static [(Self, &'static str, &'static str)] = &[
        (
            Self::Chain,
            "chain",
            "A base, a leader that seeks the frontier, and followers that keep radio contact",
        ),
        (
            Self::Ants,
            "ants",
            "Agents on a sensor floor that go where they have been least; they never know that they are done",
        ),
        (
            Self::Bricks,
            "bricks",
            "Brick&Mortar: agents on a sensor floor that mark cells as visited until none is left",
        ),
        (Self::BricksAnts, "bricks-ants", "Brick&Mortar with ants' ways, robust against missed sensors"),
    ];
}

/// Who explores.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Crew {
    /// Robots in a chain from the base, which is the first of them.
    Chain,
    /// Agents on a sensor floor, each for itself.
    Agents(Way),
}

impl SchemeName {
    /// Who explores by it under `rule`.
    pub const fn crew(self, rule: RuleName) -> Crew {
        match (self, rule) {
            (Self::Chain, _) => Crew::Chain,
            (Self::Ants, RuleName::Published) => Crew::Agents(Way::Ants(ants::Rule::Published)),
            (Self::Ants, RuleName::Repaired) => Crew::Agents(Way::Ants(ants::Rule::Repaired)),
            (Self::Bricks, RuleName::Published) => Crew::Agents(Way::Bricks(bricks::Rule::PUBLISHED)),
            (Self::Bricks, RuleName::Repaired) => Crew::Agents(Way::Bricks(bricks::Rule::REPAIRED)),
            (Self::BricksAnts, _) => Crew::Agents(Way::Bricks(bricks::Rule::ROBUST)),
        }
    }
}

/// Whether a scheme is taken as its paper has it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RuleName {
    /// As the paper publishes it.
    Published,
    /// With the repairs of its refuted claims.
    Repaired,
}

impl Worded for RuleName {
    const WORDS: &'static [(Self, &'static str, &'static str)] = &[
        (Self::Published, "published", "As the paper publishes it"),
        (Self::Repaired, "repaired", "With the repairs of its refuted claims"),
    ];
}

impl RuleName {
    /// Both rules.
    pub const ALL: [Self; 2] = [Self::Published, Self::Repaired];

    /// The chain's rule.
    pub const fn chain(self) -> Rule {
        match self {
            Self::Published => Rule::PUBLISHED,
            Self::Repaired => Rule::REPAIRED,
        }
    }
}

impl fmt::Display for RuleName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

/// A run before its start: the same setup makes the same run.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The scheme.
    pub scheme: SchemeName,
    /// As published or repaired.
    pub rule: RuleName,
    /// Robots, the base of a chain included.
    pub robots: u16,
    /// The seed of whatever is left to chance.
    pub seed: u64,
    /// The ground truth.
    pub layout: Layout,
    /// Where the robots start that have no start of their own: a free cell.
    pub base: Cell,
    /// Where each agent starts, if not all start at the base: free cells.
    pub starts: Option<Vec<Cell>>,
    /// How likely it is that an agent misses a sensor that it could see.
    pub miss: Probability,
    /// Which sensors are missed besides: their numbers among all that agents ask about, counted from 1, in order.
    pub missed: Vec<u32>,
    /// When the run is stopped.
    pub limits: Limits,
}

impl Setup {
    /// A run of `scheme` in `layout` with a base, all robots starting there, nothing missed, and no limits.
    pub fn new(scheme: SchemeName, rule: RuleName, robots: u16, layout: Layout, base: Cell) -> Self {
        let (limits, miss) = (Limits::default(), Probability::NEVER);
        let missed = Vec::new();
        Self { scheme, rule, robots, seed: 0, layout, base, starts: None, miss, missed, limits }
    }

    /// Who explores.
    pub const fn crew(&self) -> Crew {
        self.scheme.crew(self.rule)
    }

    /// The cells among which the team explores.
    pub fn area(&self) -> Area {
        let whole = self.layout.size().area();
        match self.crew() {
            Crew::Chain => kernel::area(whole, self.base, self.robots.into()).unwrap_or(whole),
            Crew::Agents(_) => whole,
        }
    }

    /// Where the robots start.
    pub fn starts(&self) -> Vec<Cell> {
        self.starts.clone().unwrap_or_else(|| vec![self.base; self.robots.into()])
    }

    /// The number of robots, the base counted, if a team of `most` can have so many.
    ///
    /// # Errors
    /// A [`Fault`] of the command line.
    pub fn count_robots(robots: u64, most: usize) -> Result<u16, Fault> {
        let count = u16::try_from(robots).ok().filter(|&count| (2..=most).contains(&usize::from(count)));
        count.ok_or_else(|| {
            let what = match robots {
                0 => "no robots".to_owned(),
                1 => "the base alone".to_owned(),
                _ => format!("{robots} robots"),
            };
            Fault::usage(
                format_args!("{what} cannot be the team"),
                format_args!("give --robots a number from 2 to {most}, the base counted"),
            )
        })
    }

    /// The base of a run in `layout`: the one asked for, or that of the layout, or the free cell nearest the centre.
    ///
    /// # Errors
    /// [`Problem`] if it is not a free cell.
    pub fn choose_base(layout: &mut Layout, asked: Option<Cell>) -> Result<Cell, Problem> {
        let base = match asked.or(layout.base()) {
            Some(base) => base,
            None => layout.default_base()?,
        };
        layout.place_base(base)?;
        Ok(base)
    }
}

/// When a run is stopped before it ends by itself.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// When so much is explored.
    pub until: Option<Milestone>,
    /// When a robot has entered so many cells.
    pub max_moves: Option<NonZeroU32>,
    /// What a violation does.
    pub violation: OnViolation,
}

/// What a violation does to a run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OnViolation {
    /// The run goes on.
    #[default]
    GoOn,
    /// It stops, as a counterexample does.
    Stop,
    /// It stops if this is what was broken, as a minimal run does; otherwise it goes on.
    #[serde(serialize_with = "write_clause", deserialize_with = "read_clause")]
    StopAt(Breach),
}

impl OnViolation {
    /// Whether a run goes no farther when it breaks `breach`.
    pub fn is_final(self, breach: Breach) -> bool {
        match self {
            Self::GoOn => false,
            Self::Stop => true,
            Self::StopAt(last) => last == breach,
        }
    }
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "so serde calls it")]
fn write_clause<S: Serializer>(breach: &Breach, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(breach.clause())
}

fn read_clause<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Breach, D::Error> {
    String::deserialize(deserializer)?.parse().map_err(de::Error::custom)
}

/// A share of the free cells of the area.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
pub enum Milestone {
    /// 50 %
    #[serde(rename = "50")]
    Half,
    /// 75 %
    #[serde(rename = "75")]
    ThreeQuarters,
    /// 100 %
    #[serde(rename = "100")]
    Whole,
}

impl Worded for Milestone {
    const WORDS: &'static [(Self, &'static str, &'static str)] =
        &[(Self::Half, "50", "50 %"), (Self::ThreeQuarters, "75", "75 %"), (Self::Whole, "100", "100 %")];
}

impl Milestone {
    /// All, in order.
    pub const ALL: [Self; 3] = [Self::Half, Self::ThreeQuarters, Self::Whole];

    /// The share.
    pub const fn percent(self) -> u32 {
        match self {
            Self::Half => 50,
            Self::ThreeQuarters => 75,
            Self::Whole => 100,
        }
    }

    /// How many of `cells` it takes, rounded up.
    pub const fn of(self, cells: u32) -> u32 {
        (cells as u64 * self.percent() as u64).div_ceil(100) as u32
    }
}

/// How a run ended by itself.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum End {
    /// Every cell of the area is explored.
    Explored,
    /// What is left cannot be reached.
    Exhausted,
    /// The team goes round and round.
    Endless,
}

/// Why a run is over.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stopped {
    /// Every cell of the area is explored.
    Explored,
    /// What is left cannot be reached.
    Exhausted,
    /// The team goes round and round, and would for ever.
    Endless,
    /// A robot has entered as many cells as it may.
    MaxMoves,
    /// As much is explored as was asked for.
    Until,
    /// A clause was broken.
    Violation,
}

impl Stopped {
    /// The reason in words.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Explored => "every cell of the area is explored",
            Self::Exhausted => "the team can explore nothing more",
            Self::Endless => "the team is where it was, and would go round for ever",
            Self::MaxMoves => "a robot has entered as many cells as it may",
            Self::Until => "as much is explored as was asked for",
            Self::Violation => "a clause was broken",
        }
    }
}

/// A clause that was broken, and when.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Violation {
    /// What was broken.
    pub breach: Breach,
    /// The team move, counted from 1.
    pub step: u32,
}

/// One team move, as a watcher sees it.
#[derive(Clone, Copy, Debug)]
pub struct TeamMove<'a> {
    /// Its number, counted from 1.
    pub step: u32,
    /// Where the robots were; the base of a chain is the first.
    pub before: &'a [Cell],
    /// What they did.
    pub frame: &'a Frame,
    /// The cells of the sensors that agents missed before they did it.
    pub unseen: &'a [Cell],
    /// What was broken.
    pub breaches: &'a [Breach],
}

/// Which cell was explored when, and how it was marked.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Chart {
    area: Area,
    /// Row by row: the team move, or `UNEXPLORED`.
    steps: Vec<u32>,
    /// The marks that cells have from a team move on; a cell that has none from before is as explored as `steps` says.
    marks: BTreeMap<(Cell, u32), Mark>,
}

const UNEXPLORED: u32 = u32::MAX;

impl Chart {
    fn new(area: Area) -> Self {
        Self { area, steps: vec![UNEXPLORED; area.width() * area.height()], marks: BTreeMap::new() }
    }

    /// What the robots explore that are in the cells of `teams` at the start and after each team move.
    pub fn of<'a>(area: Area, teams: impl IntoIterator<Item = &'a [Cell]>) -> Self {
        let mut chart = Self::new(area);
        for (step, team) in (0..).zip(teams) {
            for &cell in team {
                chart.enter(cell, step);
            }
        }
        chart
    }

    /// The cells that it spans.
    pub const fn area(&self) -> Area {
        self.area
    }

    fn place(&self, cell: Cell) -> Option<usize> {
        self.area.locate(cell).map(|(column, row)| row * self.area.width() + column)
    }

    /// The team move in which `cell` was first occupied, 0 for the start; `None` if it never was.
    pub fn step(&self, cell: Cell) -> Option<u32> {
        self.place(cell).map(|place| self.steps[place]).filter(|&step| step != UNEXPLORED)
    }

    /// The mark of `cell` after team move number `step`.
    pub fn mark(&self, cell: Cell, step: u32) -> Mark {
        match self.marks.range((cell, 0)..=(cell, step)).next_back() {
            Some((_, &mark)) => mark,
            None if self.step(cell).is_some_and(|explored| explored <= step) => Mark::Explored,
            None => Mark::Unexplored,
        }
    }

    /// All marks that cells got after they were explored: from which team move on, row by row and in order.
    pub fn marks(&self) -> impl Iterator<Item = (Cell, u32, Mark)> {
        self.marks.iter().map(|(&(cell, step), &mark)| (cell, step, mark))
    }

    /// Notes that a robot is in `cell`; whether that is new.
    fn enter(&mut self, cell: Cell, step: u32) -> bool {
        let Some(place) = self.place(cell).filter(|&place| self.steps[place] == UNEXPLORED) else {
            return false;
        };
        self.steps[place] = step;
        true
    }
}

/// What came of a run.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Report {
    /// Team moves, backtracks included.
    pub steps: u32,
    /// Cells that were occupied.
    pub explored: u32,
    /// Cells that the team is to explore.
    pub cells: u32,
    /// In which team move each [`Milestone`] was reached, if it was.
    pub milestones: [Option<u32>; Milestone::ALL.len()],
    /// Why it is over.
    pub stopped: Stopped,
    /// What was broken, in order.
    pub violations: Vec<Violation>,
    /// Which cell was explored when, and how it was marked.
    pub chart: Chart,
    /// Where the robots are in the end.
    pub team: Vec<Cell>,
    /// The parts of a sensor floor in which agents started.
    pub components: Vec<Component>,
    /// How long the run took its slowest robot, where that is known.
    pub milliseconds: Option<u64>,
}

impl Report {
    /// The team move in which `milestone` was reached, if it was.
    pub const fn reached(&self, milestone: Milestone) -> Option<u32> {
        self.milestones[milestone as usize]
    }

    /// All parts of a sensor floor in which agents started, taken together.
    pub fn whole(&self) -> Component {
        self.components.iter().fold(Component::default(), |sum, part| Component {
            robots: sum.robots + part.robots,
            active: sum.active + part.active,
            cells: sum.cells + part.cells,
            explored: sum.explored + part.explored,
            visited: sum.visited + part.visited,
        })
    }

    /// What is known at the start: where the robots are is explored.
    fn new(setup: &Setup, scheme: &dyn Scheme) -> Self {
        let area = scheme.area();
        let mut report = Self {
            steps: 0,
            explored: 0,
            cells: scheme.due(&setup.layout),
            milestones: [None; Milestone::ALL.len()],
            stopped: Stopped::Exhausted,
            violations: Vec::new(),
            chart: Chart::new(area),
            team: scheme.cells().to_vec(),
            components: Vec::new(),
            milliseconds: None,
        };
        report.note(scheme.cells(), &[]);
        report
    }

    /// Notes where the robots are and what they have marked.
    fn note(&mut self, cells: &[Cell], marked: &[(Cell, Mark)]) {
        for &cell in cells {
            self.explored += u32::from(self.chart.enter(cell, self.steps));
        }
        for &(cell, mark) in marked {
            if mark != self.chart.mark(cell, self.steps) {
                self.chart.marks.insert((cell, self.steps), mark);
            }
        }
        for milestone in Milestone::ALL {
            let reached = &mut self.milestones[milestone as usize];
            if reached.is_none() && self.explored >= milestone.of(self.cells) {
                *reached = Some(self.steps);
            }
        }
    }

    /// The report of a run that is over.
    fn ended(self, stopped: Stopped, scheme: &dyn Scheme) -> Self {
        let (team, components) = (scheme.cells().to_vec(), scheme.components().to_vec());
        Self { stopped, team, components, milliseconds: scheme.milliseconds(), ..self }
    }
}

/// Runs `setup`. `watch` sees every team move, and may stop the run for good.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme, or whatever `watch` returned.
pub fn explore(
    setup: &Setup,
    watch: &mut dyn FnMut(&TeamMove<'_>) -> Result<(), Halt>,
) -> Result<Report, Halt> {
    setup.check().map_err(|misfit| Fault::usage(&misfit, misfit.remedy()))?;
    let mut scheme = match setup.crew() {
        Crew::Chain => chain::start(setup)?,
        Crew::Agents(way) => agents::start(setup, way),
    };
    let mut report = Report::new(setup, &*scheme);
    let mut entered = vec![0_u32; scheme.cells().len()];
    let mut before = scheme.cells().to_vec();
    loop {
        if let Some(stopped) = limit(setup.limits, &report, &entered) {
            return Ok(report.ended(stopped, &*scheme));
        }
        let frame = match scheme.advance(&mut |edge| setup.layout.is_open(edge)) {
            Ok(frame) => frame,
            Err(end) => {
                let stopped = match end {
                    End::Explored => Stopped::Explored,
                    End::Exhausted => Stopped::Exhausted,
                    End::Endless => Stopped::Endless,
                };
                let (step, broken) = (report.steps, scheme.broken_at_end(setup, &report.chart, end));
                report.violations.extend(broken.into_iter().map(|breach| Violation { breach, step }));
                return Ok(report.ended(stopped, &*scheme));
            }
        };
        report.steps += 1;
        report.note(&frame.cells, scheme.marked());
        for (count, (from, to)) in entered.iter_mut().zip(before.iter().zip(&frame.cells)) {
            *count += u32::from(from != to);
        }
        let breaches = scheme.broken_in_move(&before, &frame);
        let step = report.steps;
        report.violations.extend(breaches.iter().map(|&breach| Violation { breach, step }));
        let unseen = scheme.unseen();
        watch(&TeamMove { step, before: &before, frame: &frame, unseen, breaches: &breaches })?;
        before = frame.cells;
    }
}

/// The cells that the run of `setup` is bound to explore, and on a sensor floor to mark as visited, before it ends, and
/// has not, as `chart` shows.
pub fn missed(setup: &Setup, chart: &Chart) -> Vec<Cell> {
    match setup.crew() {
        Crew::Chain => {
            let is_open = |edge| setup.layout.is_open(edge);
            let due = within_reach(chart.area(), setup.base, setup.robots.into(), is_open);
            due.into_iter().filter(|&cell| chart.step(cell).is_none()).collect()
        }
        Crew::Agents(way) => {
            let team = agents::Team::of(setup, way);
            let due = chart.area().cells().filter(|&cell| team.floor().component(cell).is_some());
            due.filter(|&cell| !floor::is_visited(chart.mark(cell, u32::MAX))).collect()
        }
    }
}

fn limit(limits: Limits, report: &Report, entered: &[u32]) -> Option<Stopped> {
    let is_far = |most: NonZeroU32| entered.iter().any(|&count| count >= most.get());
    let is_broken = report.violations.iter().any(|broken| limits.violation.is_final(broken.breach));
    if is_broken {
        Some(Stopped::Violation)
    } else if limits.until.is_some_and(|milestone| report.reached(milestone).is_some()) {
        Some(Stopped::Until)
    } else if limits.max_moves.is_some_and(is_far) {
        Some(Stopped::MaxMoves)
    } else {
        None
    }
}
