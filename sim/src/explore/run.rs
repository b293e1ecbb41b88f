//! The run loop. A [`Team`] sees what its robots know and makes one team move at a time; the layout answers for the
//! edges it tries. A run goes on after a violation, so that its cost can be compared. Any team can be run, of this
//! program or not.

use std::collections::BTreeMap;
use std::fmt;
use std::num::NonZeroU32;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_io::diagnostic::Halt;
use tautline_io::named_values::NamedValues;
use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Area, Cell, Edge};
use tautline_proofs::run::Frame;

use super::clause::ClauseId;
use super::course::Course;
use super::floor::Component;
use super::scene::{Layer, Refusal, Scene};
use crate::failures::Failures;
use crate::objects::ObjectReport;
use tautline_grids::layout::Layout;

/// The questions that a run asks of a team. Only where its robots are and how they make a team move is required.
pub trait Team {
    /// Where the robots are; if one of them is a base, it is the first.
    fn cells(&self) -> &[Cell];

    /// Makes one team move. `world` answers for every edge that is crossed
    /// without being known, and what no layout knows.
    ///
    /// # Errors
    /// [`End`] if the run is over.
    fn advance(&mut self, world: &mut dyn Surroundings) -> Result<Frame, End>;

    /// The cells of `layout` among which the team is to explore: all of them, unless it says otherwise.
    fn area(&self, layout: &Layout) -> Area {
        layout.size().area()
    }

    /// How many cells of `layout` the team is to explore: the free ones of its area, unless it says otherwise.
    fn due(&self, layout: &Layout) -> u32 {
        self.area(layout).cells().filter(|&cell| layout.is_free(cell)).count() as u32
    }

    /// How far the team comes in `layout`, if one with more robots came farther.
    fn reach(&self, layout: &Layout) -> Option<Reach> {
        let _ = layout;
        None
    }

    /// The cells of `layout` that the team must have explored, or marked as visited, before it ends, and has not, as
    /// `chart` shows. It must explore none, unless it says otherwise.
    fn missed(&self, layout: &Layout, chart: &Survey) -> Vec<Cell> {
        let _ = (layout, chart);
        Vec::new()
    }

    /// The words for the last team move that its steps cannot show, such as that a robot has died.
    fn title(&self) -> Option<&str> {
        None
    }

    /// Whether the last team move is one of those that come again and again in a run that goes round for ever.
    fn comes_again(&self) -> bool {
        false
    }

    /// The clauses that the last team move broke; `before` is where the robots were.
    fn broken_in_move(&self, before: &[Cell], frame: &Frame) -> Vec<ClauseId> {
        let _ = (before, frame);
        Vec::new()
    }

    /// The clauses that the end of the run breaks, in which the team has explored what is in `chart`.
    fn broken_at_end(&self, layout: &Layout, chart: &Survey, end: End) -> Vec<ClauseId> {
        let _ = (layout, chart, end);
        Vec::new()
    }

    /// The marks of cells that the last team move has changed, in order.
    fn marked(&self) -> &[(Cell, Mark)] {
        &[]
    }

    /// The cells of the sensors that agents missed in the last team move, agent by agent.
    fn unseen(&self) -> &[Cell] {
        &[]
    }

    /// The parts of a sensor floor in which agents started; none for teams without one.
    fn components(&self) -> &[Component] {
        &[]
    }

    /// The cells besides those where its robots are that the last team move has explored, or before the first one the
    /// start: none for teams that explore a cell by being in it.
    fn seen(&self) -> &[Cell] {
        &[]
    }

    /// How long the run has taken the slowest robot, where that is known.
    fn milliseconds(&self) -> Option<u64> {
        None
    }

    /// The steps that robots cannot take instead of theirs in the next team move, all others doing as they plan.
    fn refusals(&self) -> Vec<Refusal> {
        Vec::new()
    }

    /// The failures so far, in a run in which something is to fail.
    fn failures(&self) -> Option<Failures> {
        None
    }

    /// The objects that it has looked for, if it was to.
    fn objects(&self) -> Vec<ObjectReport> {
        Vec::new()
    }

    /// The layers that a page can show of the team beside its robots and the cells that they enter.
    fn layers(&self) -> Vec<Layer> {
        Vec::new()
    }

    /// Tells `scene` what the last team move has changed in [`layers`](Self::layers), whose robots were in the cells
    /// `before`.
    fn show(&self, before: &[Cell], scene: &mut Scene) {
        let _ = (before, scene);
    }
}

/// The answers to a team's questions. A function that knows which edges are open answers everything else as usual.
pub trait Surroundings {
    /// Whether robots can cross `edge`.
    fn is_open(&mut self, edge: Edge) -> bool;

    /// The place of the option that is chosen; `usual` is the one of the seed, or of the search that has found the run.
    fn choose(&mut self, words: &str, options: &mut dyn FnMut() -> Vec<String>, usual: u32) -> u32;
}

impl<F: FnMut(Edge) -> bool> Surroundings for F {
    fn is_open(&mut self, edge: Edge) -> bool {
        self(edge)
    }

    fn choose(&mut self, _: &str, _: &mut dyn FnMut() -> Vec<String>, usual: u32) -> u32 {
        usual
    }
}

/// How far a team comes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Reach {
    /// The cells within its reach.
    pub cells: usize,
    /// The cells that are connected with its start.
    pub connected: usize,
    /// The fewest robots that have all of those within reach.
    pub robots: usize,
}

impl fmt::Debug for dyn Team + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.cells()).finish()
    }
}

/// When a run is stopped before it ends by itself.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, JsonSchema, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// When so much is explored.
    pub until: Option<Milestone>,
    /// When a robot has entered so many cells.
    pub max_moves: Option<NonZeroU32>,
    /// The effect of a violation.
    pub violation: OnViolation,
}

impl Limits {
    /// A run that stops where it breaks `clause`, whatever it breaks before; at its first violation, if none is named.
    pub fn stopping_at(clause: Option<ClauseId>) -> Self {
        let violation = clause.map_or(OnViolation::Stop, OnViolation::StopAt);
        Self { violation, ..Self::default() }
    }

    /// The clause at whose violation the run stops.
    pub const fn stop(self) -> Option<ClauseId> {
        match self.violation {
            OnViolation::StopAt(clause) => Some(clause),
            OnViolation::GoOn | OnViolation::Stop => None,
        }
    }
}

/// The effect of a violation on a run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OnViolation {
    /// The run goes on.
    #[default]
    GoOn,
    /// It stops, as a counterexample does.
    Stop,
    /// It stops if this is what was broken, as a minimal run does; otherwise it goes on.
    StopAt(ClauseId),
}

impl OnViolation {
    /// Whether a run goes no farther when it breaks `clause`.
    fn is_final(self, clause: ClauseId) -> bool {
        match self {
            Self::GoOn => false,
            Self::Stop => true,
            Self::StopAt(last) => last == clause,
        }
    }
}

/// A share of the free cells of the area.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, JsonSchema, Serialize, Deserialize)]
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

impl NamedValues for Milestone {
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
    /// The cells that are left cannot be reached.
    Exhausted,
    /// The team goes round and round.
    Endless,
    /// Nothing new was found for so long that the team may go on for ever, or be slow.
    Idle,
    /// The robots that are left wait for one that is silent.
    Silent,
    /// The robots refuse what they have told each other.
    Refused,
}

/// Why a run is over.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StopReason {
    /// Every cell of the area is explored.
    Explored,
    /// The cells that are left cannot be reached.
    Exhausted,
    /// The team goes round and round, and would for ever.
    Endless,
    /// Nothing new was found for so long that the team may go on for ever, or be slow.
    Idle,
    /// The robots that are left wait for one that is silent, and would for ever.
    Silent,
    /// The robots refuse what they have told each other, as damaged.
    Refused,
    /// A robot has entered as many cells as it may.
    MaxMoves,
    /// As much is explored as was asked for.
    Until,
    /// A clause was broken.
    Violation,
}

impl StopReason {
    /// The reason in words.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Explored => "every cell of the area is explored",
            Self::Exhausted => "the team can explore nothing more",
            Self::Endless => "the team is where it was, and would go round for ever",
            Self::Idle => "nothing new was found for so long that the team may go on for ever, or be slow",
            Self::Silent => "the robots that are left stay where they are, and wait for one that is silent",
            Self::Refused => "the robots refuse what they have told each other, as damaged",
            Self::MaxMoves => "a robot has entered as many cells as it may",
            Self::Until => "as much is explored as was asked for",
            Self::Violation => "a clause was broken",
        }
    }
}

/// A clause that was broken, and when.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Violation {
    /// The clause.
    pub clause: ClauseId,
    /// The team move, counted from 1.
    pub step: u32,
}

/// One team move, as a watcher sees it.
#[derive(Clone, Copy, Debug)]
pub struct TeamMove<'a> {
    /// Its number, counted from 1.
    pub step: u32,
    /// Where the robots were; if one of them is a base, it is the first.
    pub before: &'a [Cell],
    /// The steps that they made.
    pub frame: &'a Frame,
    /// The cells of the sensors that agents missed before they did it.
    pub unseen: &'a [Cell],
    /// The clauses that were broken.
    pub broken: &'a [ClauseId],
    /// Who made it.
    pub team: &'a dyn Team,
}

/// Sees every team move of a run, and may stop the run for good.
pub type Watcher<'a> = dyn FnMut(&TeamMove<'_>) -> Result<(), Halt> + 'a;

/// The outcome of a run.
#[derive(Clone, PartialEq, Debug)]
pub struct Report {
    /// Team moves, backtracks included.
    pub steps: u32,
    /// Cells that were occupied.
    pub explored: u32,
    /// Cells that the team is to explore; none where a rule of one's own is not about exploring.
    pub cells: u32,
    /// In which team move each [`Milestone`] was reached, if it was.
    pub milestones: [Option<u32>; Milestone::ALL.len()],
    /// Why it is over.
    pub stopped: StopReason,
    /// The clauses that were broken, in order.
    pub violations: Vec<Violation>,
    /// Which cell was explored when, and how it was marked.
    pub chart: Survey,
    /// Where the robots are in the end.
    pub team: Vec<Cell>,
    /// The parts of a sensor floor in which agents started.
    pub components: Vec<Component>,
    /// How long the run took its slowest robot, where that is known.
    pub milliseconds: Option<u64>,
    /// The failures, in a run in which something was to fail.
    pub failures: Option<Failures>,
    /// The objects that the team has looked for.
    pub objects: Vec<ObjectReport>,
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

    /// The report of the start: where the robots are is explored.
    pub(super) fn new(team: &dyn Team, layout: &Layout) -> Self {
        let mut report = Self {
            steps: 0,
            explored: 0,
            cells: team.due(layout),
            milestones: [None; Milestone::ALL.len()],
            stopped: StopReason::Exhausted,
            violations: Vec::new(),
            chart: Survey::new(team.area(layout)),
            team: team.cells().to_vec(),
            components: Vec::new(),
            milliseconds: None,
            failures: None,
            objects: Vec::new(),
        };
        report.note(team.cells(), team.seen(), &[]);
        report
    }

    /// Notes where the robots are, what they have seen, and what they have marked.
    pub(super) fn note(&mut self, cells: &[Cell], seen: &[Cell], marked: &[(Cell, Mark)]) {
        for &cell in cells.iter().chain(seen) {
            self.explored += u32::from(self.chart.enter(cell, self.steps));
        }
        for &(cell, mark) in marked {
            self.chart.put(cell, self.steps, mark);
        }
        for milestone in Milestone::ALL {
            let reached = &mut self.milestones[milestone as usize];
            if reached.is_none() && self.cells > 0 && self.explored >= milestone.of(self.cells) {
                *reached = Some(self.steps);
            }
        }
    }

    /// Why the run is over, in words.
    pub const fn stop_words(&self) -> &'static str {
        match self.stopped {
            StopReason::Exhausted if self.cells == 0 => "no robot has anything left to do",
            stopped => stopped.words(),
        }
    }

    /// The run is over.
    pub(super) fn end(&mut self, stopped: StopReason, team: &dyn Team) {
        self.stopped = stopped;
        (self.team, self.components) = (team.cells().to_vec(), team.components().to_vec());
        (self.milliseconds, self.failures, self.objects) =
            (team.milliseconds(), team.failures(), team.objects());
    }
}

/// Runs `team`, which is at its start, in `layout`. `watch` sees every team move, and may stop the run for good.
///
/// # Errors
/// Whatever `watch` returned.
pub fn run(
    team: &mut dyn Team,
    layout: &Layout,
    limits: Limits,
    watch: &mut Watcher<'_>,
) -> Result<Report, Halt> {
    let mut course = Course::new(team, layout);
    while let Some(made) = course.step(team, layout, limits, &mut |edge: Edge| layout.is_open(edge)) {
        watch(&course.team_move(&made, team))?;
    }
    Ok(course.report)
}

/// Why the limits stop a run, if they do.
pub(super) fn limit(limits: Limits, report: &Report, entered: &[u32]) -> Option<StopReason> {
    let is_far = |most: NonZeroU32| entered.iter().any(|&count| count >= most.get());
    let is_broken = report.violations.iter().any(|broken| limits.violation.is_final(broken.clause));
    if is_broken {
        Some(StopReason::Violation)
    } else if limits.until.is_some_and(|milestone| report.reached(milestone).is_some()) {
        Some(StopReason::Until)
    } else if limits.max_moves.is_some_and(is_far) {
        Some(StopReason::MaxMoves)
    } else {
        None
    }
}

/// Which cell was explored when, and how it was marked.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Survey {
    area: Area,
    /// Row by row: the team move, or `UNEXPLORED`.
    steps: Vec<u32>,
    /// The marks that cells have from a team move on; a cell that has none from before is as explored as `steps` says.
    marks: BTreeMap<(Cell, u32), Mark>,
}

const UNEXPLORED: u32 = u32::MAX;

impl Survey {
    /// Nothing of `area` is explored.
    fn new(area: Area) -> Self {
        Self { area, steps: vec![UNEXPLORED; area.width() * area.height()], marks: BTreeMap::new() }
    }

    /// The cells that robots explore which are in those of `teams` at the start and after each team move.
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

    /// The team move in which `cell` was first occupied, 0 for the start; `None` if it never was.
    pub fn step(&self, cell: Cell) -> Option<u32> {
        self.area.place(cell).map(|place| self.steps[place]).filter(|&step| step != UNEXPLORED)
    }

    /// Those of `cells` that were never occupied.
    pub fn unexplored(&self, cells: impl IntoIterator<Item = Cell>) -> Vec<Cell> {
        cells.into_iter().filter(|&cell| self.step(cell).is_none()).collect()
    }

    /// The mark of `cell` after team move number `step`.
    pub fn mark(&self, cell: Cell, step: u32) -> Mark {
        match self.marks.range((cell, 0)..=(cell, step)).next_back() {
            Some((_, &mark)) => mark,
            None if self.step(cell).is_some_and(|explored| explored <= step) => Mark::Explored,
            None => Mark::Unexplored,
        }
    }

    /// Notes that a robot is in `cell`; whether that is new.
    fn enter(&mut self, cell: Cell, step: u32) -> bool {
        let Some(place) = self.area.place(cell).filter(|&place| self.steps[place] == UNEXPLORED) else {
            return false;
        };
        self.steps[place] = step;
        true
    }

    /// Notes that `cell` has this mark from team move number `step` on.
    fn put(&mut self, cell: Cell, step: u32, mark: Mark) {
        if mark != self.mark(cell, step) {
            self.marks.insert((cell, step), mark);
        }
    }
}
