//! The words that go with a violation: what the clause demands, and what the robots did to break it.

use std::fmt::Write;

use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Cell, Side, Step};
use tautline_proofs::chain::breach::Breach;
use tautline_proofs::course::Course;
use tautline_proofs::ledger;
use tautline_proofs::words::counted;

use super::{Block, Pose, agents, beside, first_drawn, legend, outcome, team_move};
use crate::explore::{Chart, Crew, Report, Setup, TeamMove, Violation, explore, missed};
use crate::fault::Halt;
use crate::layout::{Layout, Problem};

/// The sentence of the clause `id`.
pub fn sentence(id: &str) -> &'static str {
    ledger::clauses().find(|clause| clause.id == id).map_or("", |clause| clause.sentence)
}

/// How the team move `made` breaks its clauses: the sentences, what each robot did, and the move drawn.
pub fn of(setup: &Setup, chart: &Chart, made: &TeamMove<'_>) -> String {
    let mut text = String::new();
    for &breach in made.breaches {
        let clause = breach.clause();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "Team move {} breaks {clause}: {}", made.step, sentence(clause));
    }
    text.push('\n');
    let who = match setup.crew() {
        Crew::Chain => "R_",
        Crew::Agents(_) => "Agent ",
    };
    for (robot, &from) in made.before.iter().enumerate().skip(first_drawn(setup.crew())) {
        let _ = writeln!(text, "  {who}{} at {from} {}.", robot + 1, did(made, robot));
    }
    for &breach in made.breaches {
        for line in result(breach, setup, chart, made) {
            let _ = writeln!(text, "  {line}");
        }
    }
    text.push('\n');
    let draw = |pose, title: &str| Block { title: title.to_owned(), ..team_move(setup, chart, made, pose) };
    text + &beside(vec![draw(Pose::Before, "before, with what each tries"), draw(Pose::After, "after")])
}

fn did(made: &TeamMove<'_>, robot: usize) -> String {
    let to = made.frame.cells[robot];
    match (made.frame.steps[robot], made.frame.blocked[robot]) {
        (Step::Stay, _) => "stays".to_owned(),
        (Step::Cross(side), true) => format!("tries to go {}, meets a wall and stays", towards(side)),
        (Step::Cross(side), false) => format!("goes {} to {to}", towards(side)),
    }
}

const fn towards(side: Side) -> &'static str {
    match side {
        Side::East => "east",
        Side::South => "south",
        Side::West => "west",
        Side::North => "north",
    }
}

/// What is wrong afterwards, one line for each pair or cell.
fn result(breach: Breach, setup: &Setup, chart: &Chart, made: &TeamMove<'_>) -> Vec<String> {
    let (before, after) = (made.before, made.frame.cells.as_slice());
    match breach {
        Breach::Contact => pairs(breach, before, after)
            .map(|(robot, pair)| {
                format!(
                    "So R_{} is {} from R_{robot}: outside E_C, its cell is not wholly covered.",
                    robot + 1,
                    apart(pair)
                )
            })
            .collect(),
        Breach::Crowding => {
            let mut crowded: Vec<Cell> = after.iter().copied().filter(|&cell| cell != after[0]).collect();
            crowded.sort_unstable();
            crowded
                .chunk_by(|one, other| one == other)
                .filter(|cells| cells.len() > 2)
                .map(|cells| {
                    let robots: Vec<String> = (1..)
                        .zip(after)
                        .filter(|&(_, &cell)| cell == cells[0])
                        .map(|(robot, _)| format!("R_{robot}"))
                        .collect();
                    format!("So {} are in one cell, {}.", robots.join(", "), cells[0])
                })
                .collect()
        }
        Breach::Coverage => pairs(breach, before, after)
            .map(|(robot, pair)| {
                format!(
                    "So the centres of R_{robot} and R_{}, {} apart in the end, may leave r_cov.",
                    robot + 1,
                    apart(pair)
                )
            })
            .collect(),
        Breach::Premature => {
            let is_left = |cell: &Cell| chart.mark(*cell, made.step) == Mark::Unexplored;
            let left = missed(setup, chart).into_iter().filter(is_left).count();
            vec![format!("So an agent is done, with {} unexplored.", counted(left, "cell"))]
        }
        Breach::Costly | Breach::Completeness | Breach::Unvisited => Vec::new(),
    }
}

/// The neighbours in the chain that commit `breach` by themselves: the number of the one behind, and where they are.
fn pairs<'a>(
    breach: Breach,
    before: &'a [Cell],
    after: &'a [Cell],
) -> impl Iterator<Item = (usize, [Cell; 2])> + use<'a> {
    (1..)
        .zip(before.windows(2).zip(after.windows(2)))
        .filter(move |(_, (from, to))| breach.is_in(from, to))
        .map(|(robot, (_, to))| (robot, [to[0], to[1]]))
}

fn apart([one, other]: [Cell; 2]) -> String {
    let (columns, rows) = one.apart(other);
    format!("{} and {}", counted(columns, "column"), counted(rows, "row"))
}

/// How the end of a run breaks its clauses: the sentence, the cells that it missed, and the layout drawn. Nothing, if it
/// does not.
pub fn of_end(setup: &Setup, report: &Report) -> String {
    let what = |breach| match breach {
        Breach::Contact | Breach::Crowding | Breach::Coverage | Breach::Costly | Breach::Premature => None,
        Breach::Completeness => Some("Within reach and unexplored"),
        Breach::Unvisited => Some("Connected with a start and not visited"),
    };
    let mut broken = report.violations.iter().filter_map(|broken| Some((broken, what(broken.breach)?)));
    broken.next().map_or_else(String::new, |(Violation { breach, step }, what)| {
        let clause = breach.clause();
        let head = format!("The end after team move {step} breaks {clause}: {}", sentence(clause));
        unexplored(setup, report, &head, what, &missed(setup, &report.chart))
    })
}

fn unexplored(setup: &Setup, report: &Report, head: &str, what: &str, cells: &[Cell]) -> String {
    let cells: Vec<String> = cells.iter().map(|cell| format!("({cell})")).collect();
    format!("{head}\n\n  {what}: {}.\n\n{}", cells.join(" "), outcome(setup, &report.chart, &report.team))
}

/// How agents come into the trap of the run of `setup`: every team move before it is made, with what each agent tries
/// and the sensors that it misses, and the end.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme.
pub fn of_trap(setup: &Setup) -> Result<String, Halt> {
    let report = explore(setup, &mut |_| Ok(()))?;
    let (mut blocks, mut words) = (Vec::new(), String::new());
    explore(setup, &mut |made| {
        let before = team_move(setup, &report.chart, made, Pose::Before);
        blocks.push(Block { title: format!("before move {}", made.step), ..before });
        for cell in made.unseen {
            // Writing to a string cannot fail.
            let _ = writeln!(words, "  In team move {} the sensor of {cell} is missed.", made.step);
        }
        if !made.breaches.is_empty() {
            let after = outcome(setup, &report.chart, &report.team);
            blocks.push(Block {
                title: "the end".to_owned(),
                lines: after.lines().map(str::to_owned).collect(),
            });
        }
        for line in made.breaches.iter().flat_map(|&breach| result(breach, setup, &report.chart, made)) {
            let _ = writeln!(words, "  {line}");
        }
        Ok(())
    })?;
    Ok(format!("{}\n\n{words}\n{}", legend(setup.crew()), beside(blocks)))
}

/// What agents do in `course`, turn by turn: every turn before it is made, with what the agent tries and the sensors that
/// it misses, and the end. Of turns that can go on for ever only those are shown.
///
/// # Errors
/// [`Problem`] if it does not fit into a layout.
pub fn of_course(crew: Crew, course: &Course) -> Result<String, Problem> {
    let Course { width, height, blocked, walls, turns, round, end } = course;
    let mut layout = Layout::open(*width as u64, *height as u64)?;
    for &cell in blocked {
        layout.block(cell);
    }
    for &wall in walls {
        layout.build_wall(wall);
    }
    let shown = if *round == 0 { 0 } else { turns.len() - round };
    let (mut blocks, mut words) = (Vec::new(), String::new());
    for (number, turn) in (1..).zip(turns).skip(shown) {
        let lines = agents(crew, &layout, &turn.before, Some(turn));
        blocks.push(Block { title: format!("before turn {number}"), lines });
        for cell in &turn.unseen {
            // Writing to a string cannot fail.
            let _ =
                writeln!(words, "  In turn {number} agent {} misses the sensor of {cell}.", turn.agent + 1);
        }
    }
    let is_unexplored = |(_, mark): &&(Cell, Mark)| *mark == Mark::Unexplored;
    match (round, end.marks.iter().filter(is_unexplored).count()) {
        (0, 0) => {}
        (0, left) => {
            let _ = writeln!(words, "  The run ends with {} unexplored.", counted(left, "cell"));
        }
        (round, _) => {
            let _ = writeln!(words, "  The last {round} of {} turns can go on for ever.", turns.len());
        }
    }
    blocks.push(Block { title: "the end".to_owned(), lines: agents(crew, &layout, end, None) });
    Ok(format!("{}\n\n{words}\n{}", legend(crew), beside(blocks)))
}

/// How the last team move of the run of `setup`, or its end, breaks its clauses.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme.
pub fn last_move(setup: &Setup) -> Result<String, Halt> {
    let report = explore(setup, &mut |_| Ok(()))?;
    let end = of_end(setup, &report);
    if !end.is_empty() {
        return Ok(end);
    }
    if report.violations.is_empty() {
        let head = format!("The run ends after team move {}: {}.", report.steps, report.stopped.words());
        let left: Vec<Cell> =
            report.chart.area().cells().filter(|&cell| report.chart.step(cell).is_none()).collect();
        return Ok(unexplored(setup, &report, &head, "Unexplored", &left));
    }
    let mut story = String::new();
    explore(setup, &mut |made| {
        if made.step == report.steps {
            story = of(setup, &report.chart, made);
        }
        Ok(())
    })?;
    Ok(story)
}
