//! The run loop. A [`Team`] sees what its robots know and makes one team move at a time; the layout answers for the
//! edges it tries. A run goes on after a violation, so that its cost can be compared. Any team can be run, of this
//! program or not.

use std::fmt;
use std::num::NonZeroU32;

use schemars::JsonSchema;
use serde::de::{self, Deserializer, Unexpected, Visitor};
use serde::{Deserialize, Serialize};
use tautline_io::diagnostic::Halt;
use tautline_io::named_values::NamedValues;
use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::run::Frame;

use super::clause::ClauseId;
use super::floor::Component;
use super::survey::Survey;
use super::team::{End, Surroundings, Team};
use crate::failures::Failures;
use crate::objects::ObjectReport;
use tautline_grids::layout::Layout;

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
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, JsonSchema, Serialize)]
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

impl<'de> Deserialize<'de> for Milestone {
    fn deserialize<D: Deserializer<'de>>(input: D) -> Result<Self, D::Error> {
        /// Says which words there are, also where there is no word.
        struct Word;

        impl Visitor<'_> for Word {
            type Value = Milestone;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(r#""50", "75" or "100""#)
            }

            fn visit_str<E: de::Error>(self, word: &str) -> Result<Milestone, E> {
                <Milestone as NamedValues>::of(word)
                    .ok_or_else(|| E::invalid_value(Unexpected::Str(word), &self))
            }
        }

        input.deserialize_str(Word)
    }
}

impl Milestone {
    /// All, in order.
    pub const ALL: [Self; 3] = [Self::Half, Self::ThreeQuarters, Self::Whole];

    /// The share.
    pub const fn percent(self) -> u32 {
        [50, 75, 100][self as usize]
    }

    /// How many of `cells` it takes, rounded up.
    pub const fn of(self, cells: u32) -> u32 {
        (cells as u64 * self.percent() as u64).div_ceil(100) as u32
    }
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
        Component::whole(&self.components)
    }

    /// The report of the start: where the robots are is explored.
    fn new(team: &dyn Team, layout: &Layout) -> Self {
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
    fn note(&mut self, cells: &[Cell], seen: &[Cell], marked: &[(Cell, Mark)]) {
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
    fn end(&mut self, stopped: StopReason, team: &dyn Team) {
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

/// A run that is made one team move at a time.
#[derive(Clone, Debug)]
pub struct Course {
    /// The report so far.
    pub report: Report,
    /// By robot, how many cells it has entered.
    entered: Vec<u32>,
}

/// A team move that was made.
#[derive(Clone, Debug)]
pub struct CourseMove {
    /// Where the robots were.
    pub before: Vec<Cell>,
    /// The steps that they made.
    pub frame: Frame,
    /// The clauses that were broken.
    pub broken: Vec<ClauseId>,
}

impl Course {
    /// The run of `team`, which is at its start, in `layout`.
    pub fn new(team: &dyn Team, layout: &Layout) -> Self {
        Self { report: Report::new(team, layout), entered: vec![0; team.cells().len()] }
    }

    /// Makes the next team move of the `team`, for which `world` answers; `None` if the run is over, and then the
    /// report says why.
    pub fn step(
        &mut self,
        team: &mut dyn Team,
        layout: &Layout,
        limits: Limits,
        world: &mut dyn Surroundings,
    ) -> Option<CourseMove> {
        let report = &mut self.report;
        if let Some(stopped) = limit(limits, report, &self.entered) {
            report.end(stopped, team);
            return None;
        }
        let before = team.cells().to_vec();
        let frame = match team.advance(world) {
            Ok(frame) => frame,
            Err(end) => {
                let stopped = match end {
                    End::Explored => StopReason::Explored,
                    End::Exhausted => StopReason::Exhausted,
                    End::Endless => StopReason::Endless,
                    End::Idle => StopReason::Idle,
                    End::Silent => StopReason::Silent,
                    End::Refused => StopReason::Refused,
                };
                let (step, broken) = (report.steps, team.broken_at_end(layout, &report.chart, end));
                report.violations.extend(broken.into_iter().map(|clause| Violation { clause, step }));
                report.end(stopped, team);
                return None;
            }
        };
        report.steps += 1;
        report.note(&frame.cells, team.seen(), team.marked());
        for (count, (from, to)) in self.entered.iter_mut().zip(before.iter().zip(&frame.cells)) {
            *count += u32::from(from != to);
        }
        let broken = team.broken_in_move(&before, &frame);
        let step = report.steps;
        report.violations.extend(broken.iter().map(|&clause| Violation { clause, step }));
        Some(CourseMove { before, frame, broken })
    }

    /// The last team move of the `team`, as a watcher sees it.
    pub fn team_move<'a>(&self, made: &'a CourseMove, team: &'a dyn Team) -> TeamMove<'a> {
        let CourseMove { before, frame, broken } = made;
        TeamMove { step: self.report.steps, before, frame, unseen: team.unseen(), broken, team }
    }
}

/// Why the limits stop a run, if they do.
fn limit(limits: Limits, report: &Report, entered: &[u32]) -> Option<StopReason> {
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

#[cfg(test)]
mod tests {
    use tautline_io::json_lines::parse;

    use super::*;

    #[test]
    fn limits_that_are_none_are_told_what_would_be_right() {
        let said = |until: &str, most: &str| {
            let text = format!(r#"{{"until":{until},"max_moves":{most},"violation":"go-on"}}"#);
            parse::<Limits>(&text).map_err(|(_, said)| said)
        };
        let milestones = r#"expected "50", "75" or "100""#;
        assert_eq!(said("33", "7"), Err(format!("invalid type: integer `33`, {milestones}")));
        assert_eq!(said("\"33\"", "7"), Err(format!("invalid value: string \"33\", {milestones}")));
        let whole = "expected a whole number from 1 on that is not too large";
        assert_eq!(said("null", "0"), Err(format!("invalid value: integer `0`, {whole}")));
        let limits = said("\"75\"", "7").expect("limits");
        assert_eq!((limits.until, limits.max_moves), (Some(Milestone::ThreeQuarters), NonZeroU32::new(7)));
    }
}
