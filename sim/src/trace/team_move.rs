//! One team move as a stored run has it: what each robot tried, where it is, and what no step can show.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_grids::layout::{ColumnRow, Layout};
use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Cell, Edge, Step};
use tautline_proofs::run::Frame;

use crate::explore::{Look, TeamMove};

/// One team move, in the order of the robots, as it is stored.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StoredMove {
    /// Its number, counted from 1.
    pub(super) step: u32,
    #[schemars(with = "String")]
    kind: Kind,
    /// One letter a robot: E, S, W, N, or `.` for a robot that stays.
    tried: String,
    /// The numbers of the robots that met a wall; the base of a chain is 1, the first robot of a rule of one's own 0.
    blocked: Vec<usize>,
    /// Where the robots are now.
    #[schemars(with = "Vec<ColumnRow>")]
    cells: Vec<Cell>,
    /// Of a rule of one's own what the steps cannot show: who acted, who died, which message was lost.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) title: String,
    /// Whether it is one of the team moves that come again and again in a run that goes round for ever.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(super) again: bool,
}

impl StoredMove {
    /// A team move of robots that look so.
    pub fn new(made: &TeamMove<'_>, look: Look) -> Self {
        Self::numbered(made, numbered_from(look))
    }

    /// A team move of robots that count from `numbered_from`; without it from 1, and then it has no title.
    pub(super) fn numbered(made: &TeamMove<'_>, numbered_from: Option<usize>) -> Self {
        let TeamMove { step, frame, team, .. } = made;
        let is_titled = numbered_from.is_some();
        Self {
            step: *step,
            kind: frame.kind,
            tried: frame.steps.iter().map(|&step| letter(step)).collect(),
            blocked: blocked_numbers(frame, numbered_from.unwrap_or(1)),
            cells: frame.cells.clone(),
            title: team.title().filter(|_| is_titled).map_or_else(String::new, one_line),
            again: is_titled && team.comes_again(),
        }
    }

    /// Whether it seeks new cells or takes a move back, in a word.
    pub const fn kind(&self) -> &'static str {
        match self.kind {
            Kind::Advance => "advance",
            Kind::Backtrack => "backtrack",
        }
    }

    /// One letter a robot.
    pub fn tried(&self) -> &str {
        &self.tried
    }

    /// A sentence about what the steps cannot show, of a rule of one's own; empty where there is nothing to say.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Whether it is one of those that come again and again.
    pub const fn is_again(&self) -> bool {
        self.again
    }

    /// The team move that it tells of robots in the cells `before`, of which the first has this number.
    ///
    /// # Errors
    /// The field that contradicts the others or `layout`, and what is wrong with it.
    pub(super) fn frame(
        self,
        before: &[Cell],
        layout: &Layout,
        first: usize,
    ) -> Result<Frame, (&'static str, String)> {
        let Self { step: _, kind, tried, blocked, cells, title: _, again: _ } = self;
        let (robots, numbers) = (before.len(), first..first + before.len());
        let steps = steps(&tried, robots).map_err(|what| ("tried", what))?;
        if !blocked.is_sorted_by(|one, other| one < other)
            || blocked.iter().any(|robot| !numbers.contains(robot))
        {
            let last = numbers.end - 1;
            return Err(("blocked", format!("name robots from {first} to {last}, in order, each once")));
        }
        if cells.len() != robots {
            return Err(("cells", format!("there are {} cells of {robots} robots", cells.len())));
        }
        let mut is_blocked = vec![false; robots];
        for robot in blocked {
            is_blocked[robot - first] = true;
        }
        for (robot, (&from, &to)) in before.iter().zip(&cells).enumerate() {
            let name = robot + first;
            let is_open = |side| layout.is_open(Edge::new(from, side));
            let wrong = match (steps[robot], is_blocked[robot]) {
                (Step::Stay, true) => Some(("blocked", format!("robot {name} has tried to go nowhere"))),
                (Step::Cross(side), true) if is_open(side) => {
                    Some(("blocked", format!("nothing is in the way of robot {name} at {from}")))
                }
                (Step::Stay, false) | (Step::Cross(_), true) => {
                    (to != from).then(|| ("cells", format!("robot {name} stays in {from}")))
                }
                (Step::Cross(side), false) if !is_open(side) => {
                    Some(("tried", format!("robot {name} at {from} cannot cross a wall")))
                }
                (Step::Cross(side), false) => {
                    let due = from.beyond(side);
                    (to != due).then(|| ("cells", format!("robot {name} goes from {from} to {due}")))
                }
            };
            if let Some(wrong) = wrong {
                return Err(wrong);
            }
        }
        let blocked = is_blocked;
        Ok(Frame { kind, steps, blocked, cells })
    }
}

/// The number of the first robot that a header tells, if robots do not count from 1.
pub fn numbered_from(look: Look) -> Option<usize> {
    Some(look.first_number()).filter(|&first| first != 1)
}

/// The numbers of the robots that met a wall, of which the first robot has the number `first`.
pub fn blocked_numbers(frame: &Frame, first: usize) -> Vec<usize> {
    let numbers = (first..).zip(&frame.blocked).filter(|&(_, &blocked)| blocked);
    numbers.map(|(robot, _)| robot).collect()
}

/// `words` in one line.
pub(super) fn one_line(words: &str) -> String {
    words.replace(char::is_control, " ")
}

/// The letter of what a robot tries: E, S, W, N, or `.` for one that stays.
pub const fn letter(step: Step) -> char {
    ['E', 'S', 'W', 'N', '.'][step.place()]
}

/// The step that has this letter.
pub fn step(of: char) -> Option<Step> {
    Step::ALL.into_iter().find(|&step| letter(step) == of)
}

/// The steps of so many robots, of which `tried` has a letter for each.
///
/// # Errors
/// The words for what is to be written instead.
pub fn steps(tried: &str, robots: usize) -> Result<Vec<Step>, String> {
    let steps: Option<Vec<Step>> = tried.chars().map(step).collect();
    steps
        .filter(|steps| steps.len() == robots)
        .ok_or_else(|| format!("write one letter of E, S, W, N or . for each of {robots} robots"))
}
