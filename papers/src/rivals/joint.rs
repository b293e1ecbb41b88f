//! The joint moves of a team whose links are a tree through the base: what each robot can do, and how a joint move is
//! judged.

use tautline_grids::chance::Dice;
use tautline_kernel::ground::{Cell, Step};
use tautline_sim::explore::unlinked;

use super::parameters::{Cells, Links};

/// One robot's candidate: a step, and its cost.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Candidate {
    /// The step.
    pub step: Step,
    /// Where it is then.
    pub to: Cell,
    /// The price of being there.
    pub price: i64,
}

/// The candidates of all robots.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Joint {
    /// Where the base is.
    pub base: Cell,
    /// For each robot besides the base: what it can do, at least one thing, the cheapest first.
    pub robots: Vec<Vec<Candidate>>,
    /// Which two have a link.
    pub links: Links,
    /// Whether they may share cells.
    pub cells: Cells,
}

/// How good a joint move is: the less, the better. Failures come first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Score {
    /// Robots that no links join to the base, and robots in a cell that another one has already, if that counts.
    pub faults: u32,
    /// The sum of the prices.
    pub price: i64,
}

impl Joint {
    /// How good it is if the robots besides the base are in the cells `team`, at this price.
    pub fn score(&self, team: &[Cell], price: i64) -> Score {
        let shared = match self.cells {
            Cells::Distinct => self.sharing(team),
            Cells::Shared => 0,
        };
        let circle = self.links.circle();
        let unlinked = unlinked(self.base, team.to_vec(), |one, other| circle.covers(one, other));
        Score { faults: shared + unlinked as u32, price }
    }

    /// How good it is to stay, if all robots can.
    pub fn staying(&self) -> Option<Score> {
        let stays =
            self.robots.iter().map(|robot| robot.iter().find(|candidate| candidate.step == Step::Stay));
        let stays: Option<Vec<&Candidate>> = stays.collect();
        let stays = stays?;
        let team: Vec<Cell> = stays.iter().map(|stay| stay.to).collect();
        Some(self.score(&team, stays.iter().map(|stay| stay.price).sum()))
    }

    /// Robots in a cell outside the base that another one has already.
    fn sharing(&self, team: &[Cell]) -> u32 {
        let has_company = |(robot, cell): (usize, &Cell)| *cell != self.base && team[..robot].contains(cell);
        team.iter().enumerate().filter(|&named| has_company(named)).count() as u32
    }
}

/// The best joint move met so far, each of those as good as likely.
#[derive(Clone, Debug)]
pub(super) struct Best<T> {
    score: Score,
    ties: u64,
    chosen: Option<T>,
}

impl<T> Best<T> {
    /// None is met; what is worse than `score` is none.
    pub(super) const fn within(score: Score) -> Self {
        Self { score, ties: 0, chosen: None }
    }

    /// Meets a joint move with this score.
    pub(super) fn meet(&mut self, score: Score, chosen: impl FnOnce() -> T, dice: &mut Dice) {
        if score > self.score {
            return;
        }
        if score < self.score {
            (self.score, self.ties) = (score, 0);
        }
        self.ties += 1;
        if dice.below(self.ties) == 0 {
            self.chosen = Some(chosen());
        }
    }

    /// How good the best one is.
    pub(super) const fn score(&self) -> Score {
        self.score
    }

    /// How many are as good as the best one.
    pub(super) const fn ties(&self) -> u64 {
        self.ties
    }

    pub(super) fn chosen(self) -> Option<T> {
        self.chosen
    }
}

/// Nothing is as bad.
pub(super) const WORST: Score = Score { faults: u32::MAX, price: i64::MAX };
