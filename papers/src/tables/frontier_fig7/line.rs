//! A team of a rule, and its runs.

use tautline_sim::explore::RuleId;

use super::super::prelude::*;

/// The outcome of one run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Outcome {
    /// Team moves until every cell is explored, if all are.
    pub(super) moves: Option<u32>,
    /// Explored cells, in thousandths.
    pub(super) explored: u32,
    /// Whether two robots were in one cell.
    pub(super) is_double: bool,
    /// Team moves in which a robot entered as its frontier cell what one had entered before, and how many these are if
    /// no robot hears another one; for some rules.
    pub(super) again: Option<[u32; 2]>,
    /// Cells that all robots together enter until every cell is explored, if all are.
    pub(super) entered: Option<u32>,
    /// The team moves and the entered cells until then if no robot hears another one, for some rules.
    pub(super) unheard: Option<[u32; 2]>,
    /// Cells that are left out if one robot dies, and those of them that the others could get to, for some rules.
    pub(super) left: Option<[u32; 2]>,
}

impl Outcome {
    /// Whether it explores fewer cells than `other` on the same layout, or all of them in more team moves.
    fn is_worse(&self, other: &Self) -> bool {
        let is_slower = self.moves.zip(other.moves).is_some_and(|(own, other)| own > other);
        is_slower || self.explored < other.explored
    }
}

/// A team of a rule.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// The rule.
    pub rule: RuleId,
    /// Robots.
    pub robots: u16,
    /// Team moves until every cell is explored, over the runs that explore all.
    pub moves: Option<Estimate>,
    /// Team moves more than the repaired rule takes on the same layout, over the layouts of which both explore every
    /// cell.
    pub behind: Option<Estimate>,
    /// Runs that explore every cell, in percent.
    pub whole: Option<Estimate>,
    /// Explored cells, in percent.
    pub explored: Option<Estimate>,
    /// Runs in which two robots were in one cell, in percent.
    pub double: Option<Estimate>,
    /// Team moves of a run in which a robot enters as its frontier cell what one has entered before.
    pub again: Option<Estimate>,
    /// How many more of them there are on the same layouts if no robot hears of another one's map.
    pub saved: Option<Estimate>,
    /// Layouts on which the team takes more team moves than one robot of the same rule, or explores fewer cells, in
    /// percent.
    pub worse: Option<Estimate>,
    /// How many more team moves it takes on the same layouts if no robot hears of another one's map, over those of
    /// which both explore every cell.
    pub sooner: Option<Estimate>,
    /// Cells that all robots together enter until every cell is explored, over the runs that explore all.
    pub entered: Option<Estimate>,
    /// How many more of them there are on the layouts of `sooner` if no robot hears of another one's map.
    pub spared: Option<Estimate>,
    /// Runs in which every cell is explored although one robot dies, in percent.
    pub tolerant: Option<Estimate>,
    /// Runs in which one robot dies and the others explore every cell that they can get to, in percent.
    pub cleared: Option<Estimate>,
}

impl Line {
    /// The mean of the team moves, where a run explores every cell.
    pub(super) fn mean(&self) -> f64 {
        self.moves.map_or(f64::INFINITY, |moves| moves.mean)
    }

    /// Beside these outcomes those of repaired robots, and of one robot of the same rule.
    pub(super) fn of(
        rule: RuleId,
        robots: u16,
        outcomes: &[Outcome],
        [repaired, one]: &[Vec<Outcome>; 2],
    ) -> Self {
        let percent =
            |is_such: fn(&Outcome) -> bool| share(outcomes, is_such).map(|share| share.times(100.0));
        let deaths: Vec<[u32; 2]> = outcomes.iter().filter_map(|outcome| outcome.left).collect();
        let none_left = |of: usize| share(&deaths, |left| left[of] == 0).map(|share| share.times(100.0));
        let worse = share(outcomes.iter().zip(one), |(own, one)| own.is_worse(one));
        let unheard = |place: usize, heard: fn(&Outcome) -> Option<u32>| {
            let more = move |one: &Outcome| Some(f64::from(one.unheard?[place]) - f64::from(heard(one)?));
            mean(outcomes.iter().filter_map(more))
        };
        let more = |(own, other): (&Outcome, &Outcome)| Some(f64::from(own.moves?) - f64::from(other.moves?));
        let again = |one: &Outcome| one.again.map(|[heard, _]| f64::from(heard));
        let saved = |one: &Outcome| one.again.map(|[heard, alone]| f64::from(alone) - f64::from(heard));
        Self {
            rule,
            robots,
            moves: mean(outcomes.iter().filter_map(|outcome| outcome.moves.map(f64::from))),
            behind: mean(outcomes.iter().zip(repaired).filter_map(more)),
            whole: percent(|outcome| outcome.moves.is_some()),
            explored: mean(outcomes.iter().map(|outcome| f64::from(outcome.explored) / 10.0)),
            double: percent(|outcome| outcome.is_double),
            again: mean(outcomes.iter().filter_map(again)),
            saved: mean(outcomes.iter().filter_map(saved)),
            worse: worse.map(|share| share.times(100.0)),
            sooner: unheard(0, |one| one.moves),
            entered: mean(outcomes.iter().filter_map(|one| one.entered.map(f64::from))),
            spared: unheard(1, |one| one.entered),
            tolerant: none_left(0),
            cleared: none_left(1).filter(|_| robots > 1),
        }
    }
}
