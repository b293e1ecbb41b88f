//! The judge of counterexamples of agents on a sensor floor. It reads a layout, where the agents start and what
//! they do, turn by turn, as anyone may write it down, and decides from the sentences of `SPEC.md` whether
//! BRICKS-4, BRICKS-5, BRICKS-6 or BRICKS-12 is broken by it. It knows walls and where agents have been, and
//! nothing of marks: it shares no code with the rules, so it does not say whether a rule makes the agents act
//! so. Whoever asks it plays the rule, too.

use std::collections::BTreeSet;

use super::change::plain;
use super::{Case, must};
pub use super::{Objection, Place};

/// A counterexample, written down.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct JudgeInput {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// Columns of the layout.
    pub width: i32,
    /// Rows of the layout.
    pub height: i32,
    /// Pairs of neighbouring cells, the western or northern first, with a wall between them.
    pub walls: BTreeSet<(Place, Place)>,
    /// Cells that nobody can enter.
    pub blocked: BTreeSet<Place>,
    /// Where each agent starts.
    pub starts: Vec<Place>,
    /// The agents' turns.
    pub turns: Vec<Turn>,
    /// The last of the turns that are said to come again for ever; 0 if the run ends.
    pub round: usize,
}

/// One agent's turn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Turn {
    /// Its place among the agents.
    pub agent: usize,
    /// Where it is then.
    pub to: Place,
    /// Whether it is done from then on.
    pub is_done: bool,
}

/// The judgement of a run in which everything is possible.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Judgement {
    /// The clause is broken.
    Broken,
    /// Whether it is broken is a matter of marks, which the judge does not know.
    Unseen,
}

/// Judges a run: whether every turn is possible in its layout, and whether the last one, and no earlier one,
/// breaks the clause; or whether it is broken by how the run ends, or by going round for ever.
///
/// # Errors
/// The first [`Objection`].
pub fn judge(input: &JudgeInput) -> Result<Judgement, Objection> {
    let JudgeInput { clause, starts, turns, round, .. } = input;
    if starts.is_empty() || turns.is_empty() || *round > turns.len() {
        return Err("a counterexample needs an agent and its turns".into());
    }
    if !starts.iter().all(|&start| input.is_free(start)) {
        return Err("an agent starts where there is no free cell".into());
    }
    let due = input.connected();
    let mut court =
        Court { places: starts.clone(), done: vec![false; starts.len()], explored: BTreeSet::new() };
    court.explored.extend(starts);
    let home = turns.len() - round;
    let (mut before, mut acting, mut moves) = (None, BTreeSet::new(), 0);
    for (index, turn) in turns.iter().enumerate() {
        if index == home {
            before = Some(court.clone());
        }
        moves += usize::from(court.places.get(turn.agent).is_some_and(|&from| from != turn.to));
        court.hear(input, turn).map_err(|what| Objection { at: index + 1, what })?;
        acting.extend((index >= home).then_some(turn.agent));
        let is_early = turn.is_done && !due.is_subset(&court.explored);
        let is_broken = match *clause {
            "BRICKS-4" => is_early,
            "BRICKS-12" => moves > 2 * due.len(),
            _ => false,
        };
        if is_broken && index + 1 < turns.len() {
            return Err(Objection { at: index + 1, what: "the clause is broken before the last turn" });
        }
    }
    let is_unexplored = !due.is_subset(&court.explored);
    let is_over = court.done.iter().all(|&is_done| is_done);
    let goes_round = before.is_some_and(|before| {
        let acts = |agent: usize| before.done[agent] || acting.contains(&agent);
        before == court && (0..starts.len()).all(acts) && !is_over
    });
    let last_is_done = turns.last().is_some_and(|turn| turn.is_done);
    match (*clause, *round) {
        ("BRICKS-4", 0) if last_is_done && is_unexplored => Ok(Judgement::Broken),
        ("BRICKS-4", 0) if last_is_done => Ok(Judgement::Unseen),
        ("BRICKS-12", 0) if starts.len() == 1 && moves > 2 * due.len() => Ok(Judgement::Broken),
        ("BRICKS-12", _) => Err("an agent alone makes no more than two moves a cell".into()),
        ("BRICKS-4", _) => Err("in the last turn no agent is done".into()),
        ("BRICKS-5" | "BRICKS-6", 0) if is_over && is_unexplored => Ok(Judgement::Broken),
        ("BRICKS-5", 0) => Err("the run is not over, or every cell is explored".into()),
        ("BRICKS-6", 0) if is_over => Ok(Judgement::Unseen),
        ("BRICKS-6", 0) => Err("the run is not over".into()),
        ("BRICKS-5" | "BRICKS-6", _) if !goes_round => {
            Err("the last turns do not come back to where they began, or leave an agent out".into())
        }
        ("BRICKS-5", _) if !is_unexplored => Err("every cell is explored".into()),
        ("BRICKS-5" | "BRICKS-6", _) => Ok(Judgement::Broken),
        _ => Ok(Judgement::Unseen),
    }
}

impl Case for JudgeInput {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn step(&self) -> &'static str {
        "turn"
    }

    fn judge(&self) -> Result<(), Objection> {
        let is_seen = judge(self)? == Judgement::Broken;
        Ok(must(is_seen, "whether it is broken is a matter of marks, which the judge does not know")?)
    }
}

impl JudgeInput {
    /// A run without a round in a layout of so many columns and rows without walls.
    pub fn open(
        clause: &'static str,
        (width, height): (i32, i32),
        starts: Vec<Place>,
        turns: Vec<Turn>,
    ) -> Self {
        let (walls, blocked) = (BTreeSet::new(), BTreeSet::new());
        Self { clause, width, height, walls, blocked, starts, turns, round: 0 }
    }

    fn is_free(&self, place: Place) -> bool {
        let (x, y) = place;
        (0..self.width).contains(&x) && (0..self.height).contains(&y) && !self.blocked.contains(&place)
    }

    /// Whether an agent can go from one cell to the other in one turn.
    fn is_open(&self, from: Place, to: Place) -> bool {
        let is_beside = (from.0 - to.0).abs() + (from.1 - to.1).abs() == 1;
        is_beside
            && self.is_free(from)
            && self.is_free(to)
            && !self.walls.contains(&(from.min(to), from.max(to)))
    }

    /// The cells that are connected with the start of an agent.
    fn connected(&self) -> BTreeSet<Place> {
        let mut found = BTreeSet::new();
        let mut left = self.starts.clone();
        while let Some(place) = left.pop() {
            if found.insert(place) {
                let (x, y) = place;
                let beside = [(x, y - 1), (x + 1, y), (x, y + 1), (x - 1, y)];
                left.extend(beside.into_iter().filter(|&next| self.is_open(place, next)));
            }
        }
        found
    }
}

/// The agents, as the judge sees them.
#[derive(Clone, PartialEq, Eq)]
struct Court {
    places: Vec<Place>,
    done: Vec<bool>,
    explored: BTreeSet<Place>,
}

impl Court {
    fn hear(&mut self, input: &JudgeInput, turn: &Turn) -> Result<(), &'static str> {
        let &Turn { agent, to, is_done } = turn;
        let Some(&from) = self.places.get(agent) else { return Err("there is no such agent") };
        if self.done[agent] {
            return Err("an agent acts that is done");
        }
        if to != from && !input.is_open(from, to) {
            return Err("an agent goes where it cannot go");
        }
        if is_done && to != from {
            return Err("an agent that goes is not done");
        }
        self.places[agent] = to;
        self.done[agent] = is_done;
        self.explored.insert(to);
        Ok(())
    }
}

/// The count of a sensor that is placed where one was missed, as its reading has it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Count {
    /// It says 1, and the old one is lost.
    FromNothing,
    /// It says 1, and of it and the old one the higher is read.
    TheHigher,
    /// It counts on from the old one.
    OnFromOld,
    /// It counts on from the cell that the ant comes from.
    OnFromCell,
}

/// A cell whose sensor an ant has missed and replaced.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Replacement {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// The reading.
    pub count: Count,
    /// The count of the cell that the ant comes from.
    pub from: i32,
    /// The count of the cell that it enters, before.
    pub before: i32,
    /// The count afterwards.
    pub after: i32,
}

plain!(Count one of FromNothing, TheHigher, OnFromOld, OnFromCell);
plain!(Replacement { count, from, before, after });

impl Case for Replacement {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        let Self { clause, count, from, before, after } = *self;
        must(clause == "ANTS-3", "the judge does not know this clause")?;
        must(from > 0 && before > 0, "there is no sensor where no agent has been")?;
        let due = match count {
            Count::FromNothing => 1,
            Count::TheHigher => before.max(1),
            Count::OnFromOld => before + 1,
            Count::OnFromCell => from,
        };
        must(after == due, "the new sensor counts otherwise")?;
        Ok(must(after < before, "the cell counts no fewer agents")?)
    }
}
