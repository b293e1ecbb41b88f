//! A stored run of a scheme that this program does not know. Its rule cannot be run again, so the file is believed where it
//! agrees with itself: every robot does what the layout allows, cells follow from steps, and the end follows from the team
//! moves. Which clauses are broken, and how many cells there were to explore, only the file knows.

use serde::de::IgnoredAny;
use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::run::Frame;

use super::format::{Header, Line, StoredEnd, StoredViolation, drawn};
use super::lines::{Lines, MAX_LINE_BYTES};
use crate::explore::{
    Chart, ClauseId, End, Limits, Look, Play, Report, Stage, Team, Violation, Watcher, run,
};
use crate::fault::{Fault, Halt};
use crate::layout::Layout;
use crate::layout::generate::Probability;

const AGAIN: &str = "store the run again with the program that wrote it";

/// Robots that are held, over all team moves.
const MAX_HELD: usize = 1 << 22;

/// A run as it was written, which agrees with itself.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// The clause that the file says it breaks, if it is a counterexample.
    pub clause: Option<ClauseId>,
    scheme: String,
    rule: String,
    seed: u64,
    layout: Layout,
    base: Cell,
    starts: Option<Vec<Cell>>,
    miss: Probability,
    missed: Vec<u32>,
    robots: u16,
    frames: Vec<Frame>,
    end: StoredEnd,
    violations: Vec<Violation>,
}

impl Recorded {
    /// Reads the lines of a run behind its header, which is `text`.
    pub(super) fn read(lines: Lines, text: &str) -> Result<Self, Fault> {
        let mut lines = lines.made_by(AGAIN);
        let header: Header<String, String, IgnoredAny> = lines.parse(text, AGAIN)?;
        let Header { scheme, rule, robots, seed, base, starts, miss, missed, clause, layout, .. } = header;
        let layout = drawn(&lines, text, &layout, base, AGAIN)?;
        if robots == 0 {
            return Err(lines.fault(text, "\"robots\"", "no robots are no team", AGAIN));
        }
        if let Some(starts) = starts.as_ref().filter(|starts| starts.len() != usize::from(robots)) {
            let what = format!("there are {} starts of {robots} robots", starts.len());
            return Err(lines.fault(text, "\"starts\"", what, AGAIN));
        }
        for &start in starts.iter().flatten() {
            let refused = layout.check_start(start).err();
            refused
                .map_or(Ok(()), |problem| Err(lines.fault(text, "\"starts\"", &problem, problem.remedy())))?;
        }
        let mut team = starts.clone().unwrap_or_else(|| vec![base; robots.into()]);
        let (mut frames, mut number) = (Vec::new(), 1);
        let (text, end) = loop {
            let Some(text) = lines.next(MAX_LINE_BYTES)? else {
                let what = format!("the trace ends after line {number}; a stored run has an end");
                return Err(Fault::in_file(lines.path(), what, AGAIN));
            };
            let made = match lines.parse(&text, AGAIN)? {
                Line::Move(made) => made,
                Line::End(end) => break (text, end),
            };
            if made.step != number {
                let what = format!("this is team move {number}");
                return Err(lines.fault(&text, "\"step\"", what, AGAIN));
            }
            let told = made.frame(&team, &layout);
            let frame =
                told.map_err(|(field, what)| lines.fault(&text, &format!("\"{field}\""), what, AGAIN))?;
            team.clone_from(&frame.cells);
            frames.push(frame);
            number += 1;
            if frames.len() * team.len() > MAX_HELD {
                let what = format!("more than {MAX_HELD} robots in all team moves");
                return Err(Fault::in_file(lines.path(), what, "store a shorter run"));
            }
        };
        let violation = |stored: &StoredViolation| Violation {
            clause: ClauseId::read(&stored.clause),
            step: stored.step,
        };
        let violations: Vec<Violation> = end.violations.iter().map(violation).collect();
        if !violations.is_sorted_by_key(|violation| violation.step) {
            return Err(lines.fault(&text, "\"violations\"", "the team moves are not in order", AGAIN));
        }
        let clause = clause.as_deref().map(ClauseId::read);
        if let Some(clause) = clause.filter(|&clause| violations.iter().all(|broken| broken.clause != clause))
        {
            let what =
                format!("the header promises that {clause} is broken, but the end does not tell of it");
            return Err(lines.fault(&text, "\"violations\"", what, AGAIN));
        }
        let miss = miss.unwrap_or_default();
        let recorded = Self {
            clause,
            scheme,
            rule,
            seed,
            layout,
            base,
            starts,
            miss,
            missed,
            robots,
            frames,
            end,
            violations,
        };
        recorded.check(&lines, &text)?;
        lines.end()?;
        Ok(recorded)
    }

    /// Checks that the end follows from the team moves.
    fn check(&self, lines: &Lines, text: &str) -> Result<(), Fault> {
        let report = self.run(&mut |_| Ok(()));
        let made = report.map_or_else(|_| self.end.clone(), |report| StoredEnd::from(&report));
        if made != self.end {
            return Err(lines.differs(text, &Line::End(made), "the team moves do not make this end, but"));
        }
        let free = self.layout.free_cells();
        if !(self.end.explored..=free as u32).contains(&self.end.cells) {
            let what = format!("{} are explored, and {free} are free", self.end.explored);
            return Err(lines.fault(text, "\"cells\"", what, AGAIN));
        }
        Ok(())
    }

    fn run(&self, watch: &mut Watcher<'_>) -> Result<Report, Halt> {
        let mut player = Player { recorded: self, made: 0, cells: self.stage().starts() };
        let report = run(&mut player, &self.layout, Limits::default(), watch)?;
        Ok(Report { stopped: self.end.stopped, ..report })
    }
}

impl Play for Recorded {
    fn stage(&self) -> Stage<'_> {
        Stage {
            scheme: &self.scheme,
            rule: &self.rule,
            robots: self.robots,
            seed: self.seed,
            layout: &self.layout,
            base: self.base,
            starts: self.starts.as_deref(),
            miss: self.miss,
            missed: &self.missed,
            limits: Limits::default(),
            look: Look::Apart,
            knowledge: None,
        }
    }

    fn play(&self, watch: &mut Watcher<'_>) -> Result<Report, Halt> {
        self.run(watch)
    }
}

/// A team that does what is written down.
struct Player<'a> {
    recorded: &'a Recorded,
    /// Team moves so far.
    made: usize,
    cells: Vec<Cell>,
}

impl Player<'_> {
    /// The clauses that the last team move is said to have broken.
    fn broken(&self) -> Vec<ClauseId> {
        let broken = self.recorded.violations.iter();
        broken.filter(|broken| broken.step as usize == self.made).map(|broken| broken.clause).collect()
    }
}

impl Team for Player<'_> {
    fn cells(&self) -> &[Cell] {
        &self.cells
    }

    fn advance(&mut self, _: &mut dyn FnMut(Edge) -> bool) -> Result<Frame, End> {
        let frame = self.recorded.frames.get(self.made).ok_or(End::Exhausted)?;
        self.made += 1;
        self.cells.clone_from(&frame.cells);
        Ok(frame.clone())
    }

    fn due(&self, _: &Layout) -> u32 {
        self.recorded.end.cells
    }

    fn broken_in_move(&self, _: &[Cell], _: &Frame) -> Vec<ClauseId> {
        self.broken()
    }

    /// What is broken before the first team move.
    fn broken_at_end(&self, _: &Layout, _: &Chart, _: End) -> Vec<ClauseId> {
        if self.made == 0 { self.broken() } else { Vec::new() }
    }
}
