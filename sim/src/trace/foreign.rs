//! A stored run of a scheme that this program does not know. Its rule cannot be run again, so the file is believed
//! where it agrees with itself: every robot does what the layout allows, cells follow from steps, and the end follows
//! from the team moves. Which clauses are broken, and how many cells there were to explore, only the file knows.

use serde::de::IgnoredAny;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::json_lines::{Lines, MAX_LINE_BYTES};
use tautline_kernel::ground::Cell;
use tautline_proofs::run::Frame;

use super::line::{Header, Line, StoredEnd, StoredViolation, drawn};
use crate::explore::{
    ClauseId, End, Limits, Play, Report, RuleId, Scheme, Setup, StopReason, Surroundings, Survey, Team,
    Violation, Watcher, run,
};
use tautline_grids::layout::Layout;

const AGAIN: &str = "store the run again with the program that wrote it";

/// Robots that are held, over all team moves.
const MAX_HELD: usize = 1 << 22;

/// Letters of a name.
const MAX_WORD: usize = 64;

/// Letters of a sentence.
const MAX_SENTENCE: usize = 1 << 14;

/// Whether `words` can stand in one line.
fn is_line(words: &str) -> bool {
    words.len() <= MAX_SENTENCE && !words.chars().any(char::is_control)
}

/// Whether `name` can stand in every drawing as it is.
fn is_word(name: &str) -> bool {
    let is_fitting = |letter: char| letter.is_ascii_alphanumeric() || letter == '-';
    (1..=MAX_WORD).contains(&name.len()) && name.chars().all(is_fitting)
}

/// A run as it was written, which agrees with itself.
#[derive(Clone, Debug)]
pub struct ForeignRun {
    /// The clause that the file says it breaks, if it is a counterexample.
    pub clause: Option<ClauseId>,
    /// The demand that is broken, in words, if the file has them.
    demand: Option<String>,
    setup: Setup,
    frames: Vec<Frame>,
    /// Of each team move what its frame cannot show.
    titles: Vec<String>,
    /// How many of the last team moves come again and again.
    round: usize,
    end: StoredEnd,
    violations: Vec<Violation>,
}

/// A header that does not say when a run is stopped.
type ForeignHeader = Header<IgnoredAny>;

impl ForeignRun {
    /// Reads the lines of a run behind its header, which is `text`.
    pub(super) fn read(lines: Lines, text: &str) -> Result<Self, Diagnostic> {
        let mut lines = lines.made_by(AGAIN);
        let header: ForeignHeader = lines.parse(text, AGAIN)?;
        let layout = drawn(&lines, text, &header.layout, header.base, AGAIN)?;
        if let Err((key, what)) = check_header(&header, &layout) {
            return Err(lines.fault(text, key, what, AGAIN));
        }
        let moves = read_moves(&mut lines, &header, &layout)?;
        let StoredMoves { frames, titles, round, text, end } = moves;
        let wrong = |what: String| Err(lines.fault(&text, "violations", what, AGAIN));
        if let Some(broken) = end.violations.iter().find(|broken| !is_word(&broken.clause)) {
            return wrong(format!("{:?} is no name of a clause", broken.clause));
        }
        if !end.violations.is_sorted_by_key(|broken| broken.step) {
            return wrong("the team moves are not in order".to_owned());
        }
        if let Some(clause) = &header.clause
            && end.violations.iter().all(|broken| broken.clause != *clause)
        {
            return wrong(format!("the header promises that {clause} is broken, and it is not"));
        }
        let violation = |broken: &StoredViolation| Violation {
            clause: ClauseId::read(&broken.clause),
            step: broken.step,
        };
        let violations = end.violations.iter().map(violation).collect();
        let clause = header.clause.as_deref().map(ClauseId::read);
        let (scheme, rule) = (Scheme::named(&header.scheme), RuleId::read(&header.rule));
        let demand = header.demand.clone();
        let setup = header.setup(scheme, rule, layout);
        let recorded = Self { clause, demand, setup, frames, titles, round, end, violations };
        recorded.check(&lines, &text)?;
        lines.end()?;
        Ok(recorded)
    }

    /// Checks that the end follows from the team moves.
    fn check(&self, lines: &Lines, text: &str) -> Result<(), Diagnostic> {
        let report = self.play(&mut |_| Ok(()));
        let made = report.map_or_else(|_| self.end.clone(), |report| StoredEnd::from(&report));
        if made != self.end {
            return Err(lines.differs(text, &Line::End(made), "the team moves do not make this end, but"));
        }
        let free = self.setup.layout.free_cells();
        if self.end.cells != 0 && !(self.end.explored..=free as u32).contains(&self.end.cells) {
            let what = format!("{} are explored, and {free} are free", self.end.explored);
            return Err(lines.fault(text, "cells", what, AGAIN));
        }
        Ok(())
    }

    /// Whether a violation is one of the end: of a counterexample that was not stopped by a team move, or of a run
    /// without one.
    fn is_of_the_end(&self, broken: &Violation) -> bool {
        let is_found = self.end.stopped != StopReason::Violation && Some(broken.clause) == self.clause;
        broken.step as usize == self.frames.len() && (is_found || broken.step == 0)
    }
}

impl Play for ForeignRun {
    fn setup(&self) -> &Setup {
        &self.setup
    }

    fn play(&self, watch: &mut Watcher<'_>) -> Result<Report, Halt> {
        let (at_end, in_moves): (Vec<Violation>, Vec<Violation>) =
            self.violations.iter().partition(|broken| self.is_of_the_end(broken));
        let mut player = Player {
            frames: &self.frames,
            titles: &self.titles,
            round: self.round,
            end: End::Exhausted,
            broken: &in_moves,
            broken_at_end: at_end.iter().map(|broken| broken.clause).collect(),
            due: self.end.cells,
            cells: self.setup.starts(),
            made: 0,
        };
        let report = run(&mut player, &self.setup.layout, Limits::default(), watch)?;
        Ok(Report { stopped: self.end.stopped, ..report })
    }

    fn sentence(&self, clause: ClauseId) -> Option<&str> {
        self.demand.as_deref().filter(|_| self.clause == Some(clause))
    }

    fn round(&self) -> usize {
        self.round
    }

    fn missed(&self, clause: ClauseId, _: &Survey) -> Option<(&'static str, Vec<Cell>)> {
        let is_of_the_end = |broken: &Violation| broken.clause == clause && self.is_of_the_end(broken);
        self.violations.iter().any(is_of_the_end).then_some(("", Vec::new()))
    }
}

/// Where the robots of a header start.
fn starts(header: &ForeignHeader) -> Vec<Cell> {
    header.starts.clone().unwrap_or_else(|| vec![header.base; header.robots.into()])
}

/// Checks names, each by its key: else the key that is wrong, and what is wrong with it.
pub(crate) fn check_names(names: [(&'static str, Option<&str>); 3]) -> Result<(), (&'static str, String)> {
    for (key, name) in names {
        if let Some(name) = name.filter(|name| !is_word(name)) {
            let what = format!("{name:?} is no name: at most {MAX_WORD} letters, digits and hyphens");
            return Err((key, what));
        }
    }
    Ok(())
}

/// Checks what a header says of the team: else the key that is wrong, and what is wrong with it.
fn check_header(header: &ForeignHeader, layout: &Layout) -> Result<(), (&'static str, String)> {
    let Header { scheme, rule, robots, clause, .. } = header;
    check_names([("scheme", Some(scheme)), ("rule", Some(rule)), ("clause", clause.as_deref())])?;
    if !matches!(header.numbered_from, None | Some(0)) {
        return Err(("numbered_from", "robots count from 0".to_owned()));
    }
    if let Some(demand) = header.demand.as_ref().filter(|demand| demand.is_empty() || !is_line(demand)) {
        return Err(("demand", format!("{demand:?} is no sentence of one line")));
    }
    if *robots == 0 {
        return Err(("robots", "no robots are no team".to_owned()));
    }
    let starts = starts(header);
    if starts.len() != usize::from(*robots) {
        return Err(("starts", format!("there are {} starts of {robots} robots", starts.len())));
    }
    let refused = starts.iter().find_map(|&start| layout.check_start(start).err());
    refused.map_or(Ok(()), |problem| Err(("starts", problem.what().to_owned())))
}

/// The lines behind a header.
struct StoredMoves {
    frames: Vec<Frame>,
    titles: Vec<String>,
    /// How many of the last team moves come again and again.
    round: usize,
    /// The line of the end.
    text: String,
    end: StoredEnd,
}

/// The team moves of the robots of a header, and the end with its line.
fn read_moves(lines: &mut Lines, header: &ForeignHeader, layout: &Layout) -> Result<StoredMoves, Diagnostic> {
    let mut team = starts(header);
    let (mut frames, mut titles, mut round): (Vec<Frame>, Vec<String>, usize) = (Vec::new(), Vec::new(), 0);
    loop {
        let number = frames.len() + 1;
        let Some(text) = lines.next(MAX_LINE_BYTES)? else {
            let what = format!("the trace ends after line {number}; a stored run has an end");
            return Err(Diagnostic::in_file(lines.path(), what, AGAIN));
        };
        let made = match lines.parse(&text, AGAIN)? {
            Line::Move(made) => made,
            Line::End(end) => return Ok(StoredMoves { frames, titles, round, text, end }),
        };
        if made.step as usize != number {
            return Err(lines.fault(&text, "step", format_args!("this is team move {number}"), AGAIN));
        }
        if !is_line(&made.title) {
            return Err(lines.fault(&text, "title", "this is no sentence of one line", AGAIN));
        }
        if round > 0 && !made.again {
            let what = "a team move comes again and again, and this one after it does not";
            return Err(lines.fault(&text, "step", what, AGAIN));
        }
        round += usize::from(made.again);
        titles.push(made.title.clone());
        let told = made.frame(&team, layout, header.numbered_from.unwrap_or(1));
        let frame = told.map_err(|(key, what)| lines.fault(&text, key, what, AGAIN))?;
        team.clone_from(&frame.cells);
        frames.push(frame);
        if number * team.len() > MAX_HELD {
            let what = format!("more than {MAX_HELD} robots in all team moves");
            return Err(Diagnostic::in_file(lines.path(), what, "store a shorter run"));
        }
    }
}

/// A team that does what is written down, in whatever order its robots acted.
pub(crate) struct Player<'a> {
    pub(crate) frames: &'a [Frame],
    /// Of each team move what its frame cannot show; none, or one for each.
    pub(crate) titles: &'a [String],
    /// How many of the last team moves come again and again.
    pub(crate) round: usize,
    /// How the run ends behind the last team move.
    pub(crate) end: End,
    /// The clauses that team moves are said to break.
    pub(crate) broken: &'a [Violation],
    /// The clauses that the end is said to break.
    pub(crate) broken_at_end: Vec<ClauseId>,
    /// How many cells there are to explore.
    pub(crate) due: u32,
    pub(crate) cells: Vec<Cell>,
    /// Team moves so far.
    pub(crate) made: usize,
}

impl Team for Player<'_> {
    fn cells(&self) -> &[Cell] {
        &self.cells
    }

    fn advance(&mut self, _: &mut dyn Surroundings) -> Result<Frame, End> {
        let frame = self.frames.get(self.made).ok_or(self.end)?;
        self.made += 1;
        self.cells.clone_from(&frame.cells);
        Ok(frame.clone())
    }

    fn due(&self, _: &Layout) -> u32 {
        self.due
    }

    fn title(&self) -> Option<&str> {
        let title = self.titles.get(self.made.checked_sub(1)?)?;
        Some(title.as_str()).filter(|title| !title.is_empty())
    }

    fn comes_again(&self) -> bool {
        self.made > 0 && self.made + self.round > self.frames.len()
    }

    fn broken_in_move(&self, _: &[Cell], _: &Frame) -> Vec<ClauseId> {
        let broken = self.broken.iter().filter(|broken| broken.step as usize == self.made);
        broken.map(|broken| broken.clause).collect()
    }

    fn broken_at_end(&self, _: &Layout, _: &Survey, _: End) -> Vec<ClauseId> {
        self.broken_at_end.clone()
    }
}
