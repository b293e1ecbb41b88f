//! A run as whoever makes it team move by team move needs it.

use tautline_kernel::ground::Cell;
use tautline_proofs::run::Frame;

use super::clause::ClauseId;
use super::run::{End, Limits, Report, StopReason, Surroundings, Team, TeamMove, Violation, limit};
use tautline_grids::layout::Layout;

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
