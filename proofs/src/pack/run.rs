//! One run of a pack on one small floor, and what it breaks.

use std::fmt::Write;
use std::ops::ControlFlow;

use tautline_kernel::ground::{Area, Cell, Circle, Side, Step, neighbours};
use tautline_kernel::pack::{Chart, MAX_ROBOTS, MoveKind, Past, Rule, Scratch, Team};

use super::gains::{Gains, Outlook};
use super::readings::{Flaw, Subject};
use crate::judge::pack::{self as judge, Choice};
use crate::judge::{Floor as Written, Place};
use crate::plural::{counted, listed};
use crate::run::place;

/// Team moves at which a run on a small floor counts as endless.
pub(super) const MOST_MOVES: usize = 1000;

/// The situations of a team move.
pub(super) const SITUATIONS: [&str; 4] =
    ["each goes its way", "one leads", "a move is taken back", "a caterpillar"];

/// A demand on a pack.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Demand {
    /// Links by four corners join all robots after every team move.
    Connected,
    /// Links by midpoints do.
    Near,
    /// No two robots are in one cell.
    Single,
    /// All cells that can be reached are explored in the end.
    Covers,
    /// The run ends.
    Ends,
    /// Robots are in free cells, and go one step at most.
    Free,
    /// A robot goes where the metric gain is greatest.
    Best,
}

impl Demand {
    pub(super) const ALL: [Self; 7] =
        [Self::Connected, Self::Near, Self::Single, Self::Covers, Self::Ends, Self::Free, Self::Best];

    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Connected => "the pack is not connected",
            Self::Near => "the pack is not connected by midpoints",
            Self::Single => "two robots are in one cell",
            Self::Covers => "a cell within reach is unexplored",
            Self::Ends => "the run goes on",
            Self::Free => "a robot is in no free cell, or has gone more than one step",
            Self::Best => "a robot goes where the metric gain is less than elsewhere",
        }
    }
}

/// A floor of at most 64 cells, and where robots start on it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Floor {
    pub(super) area: Area,
    /// A bit for each cell, row by row.
    pub(super) obstacles: u64,
    pub(super) starts: Vec<Cell>,
}

impl Floor {
    pub(super) fn is_free(&self, cell: Cell) -> bool {
        self.area
            .locate(cell)
            .is_some_and(|(column, row)| self.obstacles >> (row * self.area.width() + column) & 1 == 0)
    }

    /// The free cells that a robot could walk to from a start.
    fn reachable(&self) -> Vec<Cell> {
        let mut reached = self.starts.clone();
        let mut next = 0;
        while let Some(&cell) = reached.get(next) {
            next += 1;
            for beyond in Side::ALL.map(|side| cell.beyond(side)) {
                if self.is_free(beyond) && !reached.contains(&beyond) {
                    reached.push(beyond);
                }
            }
        }
        reached
    }

    /// A run of `subject` on it, written down for the judge; no team moves yet.
    pub(super) fn written(&self, subject: &Subject) -> judge::Run {
        let Self { area, ref starts, .. } = *self;
        let barred = area.cells().filter(|&cell| !self.is_free(cell)).map(place).collect();
        judge::Run {
            clause: "",
            floor: Written { columns: area.width() as i32, rows: area.height() as i32, barred },
            sight: subject.rule.sight().radius_cells().into(),
            range: subject.rule.range_cells().into(),
            choice: subject.choice,
            starts: starts.iter().copied().map(place).collect(),
            moves: Vec::new(),
        }
    }

    /// The floor with its starts, a line for each row.
    fn drawing(&self) -> String {
        let sign = |cell: Cell| match self.starts.iter().position(|&start| start == cell) {
            Some(robot) => char::from_digit(robot as u32 + 1, 36).unwrap_or('?'),
            None if self.is_free(cell) => '.',
            None => '#',
        };
        let rows = (self.area.first().y..=self.area.last().y).map(|y| {
            (self.area.first().x..=self.area.last().x)
                .map(|x| sign(Cell::new(x, y)))
                .chain(['\n'])
                .collect::<String>()
        });
        rows.collect()
    }
}

/// The history of a pack, a step for each robot and team move.
#[derive(Clone, Debug, Default)]
pub struct Moves(Vec<Step>);

impl Past for Moves {
    fn push(&mut self, steps: &[Step]) {
        self.0.extend_from_slice(steps);
    }

    fn pop(&mut self, steps: &mut [Step]) -> bool {
        let Some(kept) = self.0.len().checked_sub(steps.len()) else { return false };
        steps.copy_from_slice(&self.0[kept..]);
        self.0.truncate(kept);
        true
    }

    fn clear(&mut self) {
        self.0.clear();
    }
}

/// The outcome of a run.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(super) struct RunOutcome {
    /// The demands that it breaks, each once.
    pub(super) broken: Vec<Demand>,
    /// The situations that occurred.
    pub(super) covered: Vec<&'static str>,
    /// Where the robots were after each team move, and what it was.
    moves: Vec<(MoveKind, Vec<Cell>)>,
    /// The cells within reach that were not explored when it ended.
    left: Vec<Cell>,
}

impl RunOutcome {
    fn judge(&mut self, demand: Demand, is_broken: bool) {
        if is_broken && !self.broken.contains(&demand) {
            self.broken.push(demand);
        }
    }

    /// Adds a team move to `now`; whether the run is cut off there.
    fn goes_on(&mut self, rule: &Rule, floor: &Floor, made: MoveKind, now: Vec<Cell>) -> ControlFlow<()> {
        let before = self.moves.last().map_or(&floor.starts, |(_, cells)| cells);
        let is_step =
            |(&from, &to): (&Cell, &Cell)| floor.is_free(to) && (from == to || neighbours(from, to));
        let are_steps = before.iter().zip(&now).all(is_step);
        let is_double = now.iter().enumerate().any(|(robot, cell)| now[..robot].contains(cell));
        self.judge(Demand::Free, !are_steps);
        self.judge(Demand::Connected, !is_connected(&now, rule.range_cells()));
        self.judge(Demand::Near, !is_near(&now, rule.range_cells()));
        self.judge(Demand::Single, is_double);
        self.moves.push((made, now));
        if self.moves.len() < MOST_MOVES {
            return ControlFlow::Continue(());
        }
        self.judge(Demand::Ends, true);
        ControlFlow::Break(())
    }

    /// Ends the run, these cells being left.
    fn end(&mut self, left: Vec<Cell>) {
        self.judge(Demand::Covers, !left.is_empty());
        self.left = left;
    }

    /// Where the robots were after each team move, up to the one that breaks a demand of each of them.
    pub(super) fn until(&self, demand: Demand, range_cells: u16) -> impl Iterator<Item = &Vec<Cell>> {
        let breaks =
            move |cells: &Vec<Cell>| demand == Demand::Connected && !is_connected(cells, range_cells);
        let first = self.moves.iter().position(|(_, cells)| breaks(cells)).unwrap_or(self.moves.len());
        self.moves.iter().map(|(_, cells)| cells).take(first + 1)
    }
}

/// Whether links of R_c by four corners join all robots.
fn is_connected(cells: &[Cell], range_cells: u16) -> bool {
    let circle = Circle::new(4 * u64::from(range_cells).pow(2));
    are_joined(cells, |one, other| circle.covers(one, other))
}

/// Whether links of R_c by midpoints join all robots.
fn is_near(cells: &[Cell], range_cells: u16) -> bool {
    let squared = |one: i16, other: i16| u64::from(one.abs_diff(other)).pow(2);
    let most = u64::from(range_cells).pow(2);
    are_joined(cells, |one, other| squared(one.x, other.x) + squared(one.y, other.y) <= most)
}

fn are_joined(cells: &[Cell], has_link: impl Fn(Cell, Cell) -> bool) -> bool {
    let mut joined = vec![false; cells.len()];
    joined[0] = true;
    for _ in cells {
        for robot in 0..cells.len() {
            joined[robot] |=
                (0..cells.len()).any(|other| joined[other] && has_link(cells[other], cells[robot]));
        }
    }
    joined.into_iter().all(|is_joined| is_joined)
}

/// Runs a pack of `subject` on `floor`; `None` if the robots are no pack there.
pub(super) fn play(subject: &Subject, floor: &Floor, choices: Gains) -> Option<RunOutcome> {
    let rule = &subject.rule;
    let mut team = Team::new(*rule, &floor.starts).ok()?;
    if subject.choice != Choice::PUBLISHED {
        return Some(play_plainly(subject, floor));
    }
    let area = floor.area;
    let cells = area.width() * area.height();
    let blank = Chart::new(area, vec![[0; 2]; Chart::<Vec<[u64; 2]>>::words(area)])?;
    let mut chart = blank.clone();
    let (mut reached, mut queue) = (vec![0; cells], vec![Cell::default(); cells]);
    let (mut gains, mut rounds) = (vec![0; cells], 0);
    let (mut past, mut steps) = (Moves::default(), [Step::Stay; MAX_ROBOTS]);
    let mut played = RunOutcome::default();
    let mut seen = floor.starts.clone();
    loop {
        if subject.flaw == Some(Flaw::Forgets) {
            chart = blank.clone();
        }
        for &cell in team.cells() {
            chart.look(
                rule.sight(),
                cell,
                |cell| !floor.is_free(cell),
                |cell, is_obstacle| {
                    if !is_obstacle {
                        seen.push(cell);
                    }
                },
            );
        }
        let mut memory =
            Scratch { reached: &mut reached, queue: &mut queue, gains: &mut gains, rounds: &mut rounds };
        let (before, aims) = (team.cells().to_vec(), team.aims().collect::<Vec<_>>());
        let Ok(made) = team.advance(&chart, &mut past, &mut memory, &mut steps) else { break };
        if subject.flaw == Some(Flaw::TwoAtOnce) {
            let _ended = team.advance(&chart, &mut past, &mut memory, &mut steps);
        }
        if made == MoveKind::Spread && choices == Gains::Compared {
            // A robot that has gone its own way keeps its aim as long as that is a frontier cell.
            let has_spread = played.moves.last().is_none_or(|&(last, _)| last == MoveKind::Spread);
            let is_kept = |&aim: &Cell| has_spread && chart.is_frontier(aim);
            let kept: Vec<Option<Cell>> = aims.into_iter().map(|aim| aim.filter(is_kept)).collect();
            let outlook = Outlook { rule, chart: &chart };
            let chosen: Vec<Option<Cell>> = if subject.flaw == Some(Flaw::HeedsNoWay) {
                outlook.most_seen(&before, &kept)
            } else {
                team.aims().collect()
            };
            played.judge(Demand::Best, !outlook.are_best(&before, &kept, &chosen));
        }
        let situation = SITUATIONS[match made {
            MoveKind::Spread => 0,
            MoveKind::Led(_) => 1,
            MoveKind::TakenBack => 2,
            MoveKind::Marched => 3,
        }];
        if !played.covered.contains(&situation) {
            played.covered.push(situation);
        }
        if played.goes_on(rule, floor, made, team.cells().to_vec()).is_break() {
            return Some(played);
        }
    }
    played.end(floor.reachable().into_iter().filter(|cell| !seen.contains(cell)).collect());
    Some(played)
}

/// Runs a pack under another reading than the published one, as the judge does.
fn play_plainly(subject: &Subject, floor: &Floor) -> RunOutcome {
    let (moves, left) = floor.written(subject).played(MOST_MOVES);
    let cell = |(x, y): Place| Cell::new(x as i16, y as i16);
    let mut played = RunOutcome::default();
    for cells in moves {
        let cells = cells.into_iter().map(cell).collect();
        if played.goes_on(&subject.rule, floor, MoveKind::Spread, cells).is_break() {
            return played;
        }
    }
    played.end(left.into_iter().map(cell).collect());
    played
}

/// Most team moves that are told.
const MOST_TOLD: usize = 40;

/// The run in lines, up to the team move that breaks a demand of each of them.
pub(super) fn story(rule: &Rule, floor: &Floor, played: &RunOutcome, demand: Demand) -> String {
    let (width, height) = (floor.area.width(), floor.area.height());
    let (sight, range) = (rule.sight().radius_cells(), rule.range_cells());
    let mut lines = format!("{width}×{height} cells, R_s {sight}, R_c {range}\n{}", floor.drawing());
    let moves = played.until(demand, rule.range_cells()).count();
    for (made, cells) in played.moves.iter().take(moves.min(MOST_TOLD)) {
        let what = match made {
            MoveKind::Spread => "each goes its way".to_owned(),
            MoveKind::Led(robot) => format!("R{} leads", robot + 1),
            MoveKind::TakenBack => "a move is taken back".to_owned(),
            MoveKind::Marched => "a caterpillar".to_owned(),
        };
        let cells = listed((1..).zip(cells).map(|(robot, cell)| format!("R{robot} {cell}")));
        // Writing to a string cannot fail.
        let _ = writeln!(lines, "{what}: {cells}");
    }
    if let Some(more) = moves.checked_sub(MOST_TOLD).filter(|&more| more > 0) {
        let _ = writeln!(lines, "and {} more", counted(more as u64, "team move"));
    }
    if demand == Demand::Covers && !played.left.is_empty() {
        let left: Vec<String> = played.left.iter().map(Cell::to_string).collect();
        let _ = writeln!(lines, "the run ends, and nobody has seen {}", left.join(" "));
    }
    lines
}
