//! The words that go with a violation: what the clause demands, and what the robots did to break it.

use std::fmt::Write;

use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::text_blocks::{Block, beside};
use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Cell, Step};
use tautline_proofs::floor_trace::Course;
use tautline_proofs::plural::counted;
use tautline_proofs::run::{Ending, Run, name_of};

use super::{Pose, agents, first_drawn, legend, outcome, team_move};
use crate::explore::{ClauseId, Look, OnViolation, Play, Report, StopReason, Survey, TeamMove, Violation};
use tautline_grids::layout::Layout;

/// The words behind the id of a clause: its sentence, where `run` knows it. That of a rule of one's own says what is so
/// where it is kept.
pub fn words_of(run: &dyn Play, id: ClauseId) -> String {
    let says = if matches!(run.setup().scheme.look, Look::Own) { "; it demands:" } else { ":" };
    run.sentence(id).map_or_else(|| ".".to_owned(), |sentence| format!("{says} {sentence}"))
}

/// The words that begin the story of a run whose end breaks `clause` after team move number `step`.
fn end_breaks(run: &dyn Play, report: &Report, step: u32, clause: ClauseId) -> String {
    let broken = format!("{clause}{}", words_of(run, clause));
    if report.stopped != StopReason::Endless {
        return format!("The end after team move {step} breaks {broken}");
    }
    match run.round() {
        0 => format!("The run goes on for ever, and breaks {broken}"),
        1 => format!("Team move {step} comes again and again. Such a run breaks {broken}"),
        round => {
            let first = step as usize + 1 - round;
            format!("Team moves {first} to {step} come again and again. Such a run breaks {broken}")
        }
    }
}

/// How the team move `made` breaks its clauses: the sentences, what each robot did, and the move drawn.
pub fn of(run: &dyn Play, chart: &Survey, made: &TeamMove<'_>) -> String {
    let mut text = String::new();
    for &clause in made.broken {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "Team move {} breaks {clause}{}", made.step, words_of(run, clause));
    }
    text.push('\n');
    let look = run.setup().scheme.look;
    let who = match look {
        Look::Linked { .. } | Look::Tree { .. } => "R_",
        Look::Robots | Look::Own => "Robot ",
        Look::Apart => "Agent ",
    };
    let mut title = made.team.title().unwrap_or_default().chars();
    if let Some(first) = title.next() {
        let _ = writeln!(text, "  {}{}.", first.to_uppercase(), title.as_str());
    }
    for (robot, &from) in made.before.iter().enumerate().skip(first_drawn(look)) {
        let _ = writeln!(text, "  {who}{} at {from} {}.", robot + look.first_number(), did(made, robot));
    }
    for &clause in made.broken {
        for line in run.lines(clause, chart, made) {
            let _ = writeln!(text, "  {line}");
        }
    }
    text.push('\n');
    let draw = |pose, title: &str| Block { title: title.to_owned(), ..team_move(run, chart, made, pose) };
    text + &beside(vec![draw(Pose::Before, "before, with what each tries"), draw(Pose::After, "after")])
}

fn did(made: &TeamMove<'_>, robot: usize) -> String {
    let to = made.frame.cells[robot];
    match (made.frame.steps[robot], made.frame.blocked[robot]) {
        (Step::Stay, _) => "stays".to_owned(),
        (Step::Cross(side), true) => format!("tries to go {}, meets a wall and stays", name_of(side)),
        (Step::Cross(side), false) => format!("goes {} to {to}", name_of(side)),
    }
}

/// How the end of a run breaks its clauses: the sentence, the cells that it missed, and the layout drawn. Nothing, if
/// it does not.
pub fn of_end(run: &dyn Play, report: &Report) -> String {
    let missed = |broken: &Violation| Some((*broken, run.missed(broken.clause, &report.chart)?));
    let found = report.violations.iter().find_map(missed);
    found.map_or_else(String::new, |(Violation { clause, step }, (what, cells))| {
        let head = end_breaks(run, report, step, clause);
        unexplored(run, report, &head, what, &cells)
    })
}

fn unexplored(run: &dyn Play, report: &Report, head: &str, what: &str, cells: &[Cell]) -> String {
    let listed: Vec<String> = cells.iter().map(|cell| format!("({cell})")).collect();
    let left = if cells.is_empty() { String::new() } else { format!("  {what}: {}.\n\n", listed.join(" ")) };
    format!("{head}\n\n{left}{}", outcome(run, &report.chart, &report.team))
}

/// The cells that no robot has explored, and what they are.
fn left(report: &Report) -> (&'static str, Vec<Cell>) {
    ("Unexplored", report.chart.unexplored(report.chart.area().cells()))
}

/// How agents come into the trap of `run`: every team move before it is made, with what each agent tries
/// and the sensors that it misses, and the end.
///
/// # Errors
/// [`Halt`] if the run cannot be made.
pub fn of_trap(run: &dyn Play) -> Result<String, Halt> {
    let report = run.play(&mut |_| Ok(()))?;
    let end = || {
        let lines = outcome(run, &report.chart, &report.team).lines().map(str::to_owned).collect();
        Block { title: "the end".to_owned(), lines }
    };
    let (mut blocks, mut words) = (Vec::new(), String::new());
    run.play(&mut |made| {
        let before = team_move(run, &report.chart, made, Pose::Before);
        blocks.push(Block { title: format!("before move {}", made.step), ..before });
        for cell in made.unseen {
            // Writing to a string cannot fail.
            let _ = writeln!(words, "  In team move {} the sensor of {cell} is missed.", made.step);
        }
        if !made.broken.is_empty() {
            blocks.push(end());
        }
        for line in made.broken.iter().flat_map(|&clause| run.lines(clause, &report.chart, made)) {
            let _ = writeln!(words, "  {line}");
        }
        Ok(())
    })?;
    if report.stopped == StopReason::Endless {
        blocks.push(end());
        let setup = run.setup();
        let left = report.chart.unexplored(setup.layout.reachable(&setup.starts())).len();
        let again = format!("After team move {} all is as it was before", report.steps);
        let _ = writeln!(words, "  {again}, and so on for ever, with {} unexplored.", counted(left, "cell"));
    }
    Ok(format!("{}\n\n{words}\n{}", legend(run.setup().scheme.look), beside(blocks)))
}

/// The turns of agents in `course`, drawn beside each other, with the legend and what to know above.
///
/// # Errors
/// As of [`turns`].
pub fn of_course(course: &Course) -> Result<String, Diagnostic> {
    let (words, turns) = turns(course)?;
    Ok(format!("{words}\n{}", beside(turns)))
}

/// The turns of agents in `course`, one by one: the legend and what to know, every turn before it is made, with what
/// the agent tries and the sensors that it misses, and the end. Of turns that can go on for ever only those are shown.
///
/// # Errors
/// [`Diagnostic`] if it does not fit into a layout.
pub fn turns(course: &Course) -> Result<(String, Vec<Block>), Diagnostic> {
    let Course { width, height, blocked, walls, turns, round, end } = course;
    let layout = Layout::open(*width as u64, *height as u64)?;
    let layout = layout.with_blocked(blocked.iter().copied()).with_walls(walls.iter().copied());
    let shown = if *round == 0 { 0 } else { turns.len() - round };
    let (mut blocks, mut words) = (Vec::new(), String::new());
    for (number, turn) in (1..).zip(turns).skip(shown) {
        let lines = agents(&layout, &turn.before, Some(turn));
        blocks.push(Block { title: format!("before turn {number}"), lines });
        for cell in &turn.unseen {
            // Writing to a string cannot fail.
            let _ =
                writeln!(words, "  In turn {number} agent {} misses the sensor of {cell}.", turn.agent + 1);
        }
    }
    let is_unexplored = |(_, mark): &&(Cell, Mark)| *mark == Mark::Unexplored;
    let last = match (round, end.marks.iter().filter(is_unexplored).count()) {
        (0, 0) => String::new(),
        (0, left) => format!("  The run ends with {} unexplored.\n", counted(left, "cell")),
        (round, _) => format!("  The last {round} of {} turns can go on for ever.\n", turns.len()),
    };
    blocks.push(Block { title: "the end".to_owned(), lines: agents(&layout, end, None) });
    Ok((format!("{}\n\n{words}{last}", legend(Look::Apart)), blocks))
}

/// How the last team move of `run`, or its end, breaks the clause at which the run stops, or else those that it breaks.
///
/// # Errors
/// [`Halt`] if the run cannot be made.
pub fn last_move(run: &dyn Play) -> Result<String, Halt> {
    let report = run.play(&mut |_| Ok(()))?;
    let is_asked = |broken: &&Violation| run.setup().limits.violation == OnViolation::StopAt(broken.clause);
    let misses = |broken: &&Violation| run.missed(broken.clause, &report.chart).is_some();
    let mut broken = report.violations.iter();
    let asked = broken.clone().find(is_asked).or_else(|| broken.clone().find(misses));
    let Some(&Violation { clause, step }) = asked.or(broken.next_back()) else {
        let head = format!("The run ends after team move {}: {}.", report.steps, report.stop_words());
        let (what, cells) = left(&report);
        return Ok(unexplored(run, &report, &head, what, &cells));
    };
    // An end that misses no cell is drawn as it is.
    let (what, cells) = run.missed(clause, &report.chart).unwrap_or_default();
    let mut story = unexplored(run, &report, &end_breaks(run, &report, step, clause), what, &cells);
    run.play(&mut |made| {
        if made.step == report.steps && made.broken.contains(&clause) {
            story = of(run, &report.chart, made);
        }
        Ok(())
    })?;
    Ok(story)
}

/// How `run`, the run that a search has `found`, breaks `clause`: by the last team move that was found, or by its end.
/// Whoever watches it need not see that the clause is broken, and may see it go on.
///
/// # Errors
/// [`Halt`] if the run cannot be made.
pub fn of_found(run: &dyn Play, clause: ClauseId, found: &Run) -> Result<String, Halt> {
    let (step, mut story) = (found.frames.len() as u32, String::new());
    let report = run.play(&mut |_| Ok(()))?;
    if found.ending == Ending::Over {
        let head = end_breaks(run, &report, step, clause);
        let (what, cells) = run.missed(clause, &report.chart).unwrap_or_else(|| left(&report));
        return Ok(unexplored(run, &report, &head, what, &cells));
    }
    run.play(&mut |made| {
        if made.step == step {
            story = of(run, &report.chart, &TeamMove { broken: &[clause], ..*made });
        }
        Ok(())
    })?;
    Ok(story)
}
