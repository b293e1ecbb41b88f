//! The judge of CHAIN-26: team moves in an open area that explore half, or three quarters, of its cells sooner than the
//! published rule does. The judge makes the team moves of the rule by itself.

use std::collections::BTreeSet;

use super::court::Court;
use super::duty::{Duty, MOST_LED};
use super::judge_input::{JudgeInput, Move, Repairs};
use super::place::{Place, add};
use crate::judge::change::plain;
use crate::judge::{Case, Objection, must};

/// An exploration that is said to be sooner than that of the rule.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Sooner {
    /// Robots, base included.
    pub robots: usize,
    /// The cells to be explored, of (2N−1)² with the base in the middle.
    pub cells: usize,
    /// The steps of all robots in each team move, base first.
    pub moves: Vec<Vec<Place>>,
}

plain!(Sooner { robots, cells, moves });

impl Case for Sooner {
    fn clause(&self) -> &'static str {
        "CHAIN-26"
    }

    fn step(&self) -> &'static str {
        "team move"
    }

    /// The moves are admitted as published, the last one and none before completes the cells, and the rule has explored
    /// fewer after as many team moves.
    fn judge(&self) -> Result<(), Objection> {
        let Self { robots, cells, ref moves } = *self;
        must((2..=MOST_LED).contains(&robots), "the judge follows a rule of 2 to 12 robots")?;
        let side = 2 * robots - 1;
        let is_share = |quarters: usize| {
            let of_all = quarters * side * side;
            [of_all / 4, of_all.div_ceil(4)].contains(&cells)
        };
        must(is_share(2) || is_share(3), "the cells are neither half nor three quarters of all")?;
        let (side, middle) = (side as i32, robots as i32 - 1);
        let open = JudgeInput {
            clause: self.clause(),
            repairs: Repairs::Without,
            width: side,
            height: side,
            walls: BTreeSet::new(),
            blocked: BTreeSet::new(),
            base: (middle, middle),
            robots,
            moves: Vec::new(),
        };
        let (mut sooner, mut rule) = (Court::new(&open, robots), Court::new(&open, robots));
        for (at, tried) in (1..).zip(moves) {
            let object = |what| Objection { at, what };
            must(sooner.explored.len() < cells, "the cells are explored before").map_err(object)?;
            sooner.make(tried).map_err(object)?;
            let Duty::Lead(step) = rule.duty()? else { return Err(object("the rule makes no advance here")) };
            let plan = rule.plan(step).ok_or(object("nobody follows the leader of the rule"))?;
            rule.make(&plan).map_err(object)?;
        }
        must(sooner.explored.len() >= cells, "the moves explore fewer cells")?;
        must(rule.explored.len() < cells, "the rule has explored as many cells by then")?;
        Ok(())
    }
}

impl Court<'_> {
    /// Makes a team move in the open.
    fn make(&mut self, tried: &[Place]) -> Result<(), &'static str> {
        let places = self.places.iter().zip(tried).map(|(&at, &step)| add(at, step)).collect();
        let (tried, blocked) = (tried.to_vec(), vec![false; tried.len()]);
        let made = Move { is_backtrack: false, tried, blocked, places };
        self.are_all_there(&made)?;
        self.hear(&made)?;
        self.places = made.places;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::change::all;

    /// Three robots, of which R_2 and R_3 come to these places one after the other.
    fn walked(cells: usize, places: &[[Place; 2]]) -> Sooner {
        let base = (2, 2);
        let all: Vec<[Place; 3]> =
            [[base; 2]].iter().chain(places).map(|&[one, two]| [base, one, two]).collect();
        let step = |(from, to): (&Place, &Place)| (to.0 - from.0, to.1 - from.1);
        let steps = |pair: &[[Place; 3]]| pair[0].iter().zip(&pair[1]).map(step).collect();
        Sooner { robots: 3, cells, moves: all.windows(2).map(steps).collect() }
    }

    /// 13 of the 25 cells of three robots in eight team moves.
    fn half() -> Sooner {
        let places = [
            [(3, 2), (2, 1)],
            [(3, 3), (2, 2)],
            [(3, 3), (2, 3)],
            [(2, 3), (2, 4)],
            [(1, 3), (1, 4)],
            [(1, 3), (0, 4)],
            [(1, 2), (0, 3)],
            [(1, 1), (0, 2)],
        ];
        walked(13, &places)
    }

    #[test]
    fn half_of_25_cells_in_eight_team_moves_is_sooner_than_the_rule() {
        assert_eq!(half().judge(), Ok(()));
        // The rule takes nine.
        let mut later = half();
        later.moves.insert(0, vec![(0, 0); 3]);
        assert_eq!(later.judge(), Err("the rule has explored as many cells by then".into()));
        let fewer = Sooner { moves: half().moves[..7].to_vec(), ..half() };
        assert_eq!(fewer.judge(), Err("the moves explore fewer cells".into()));
        let share = Sooner { cells: 14, ..half() };
        assert_eq!(share.judge(), Err("the cells are neither half nor three quarters of all".into()));
        let mut farther = half();
        farther.moves[0][1] = (1, 1);
        let what = "a step leads to a side neighbour or nowhere";
        assert_eq!(farther.judge(), Err(Objection { at: 1, what }));
    }

    #[test]
    fn no_single_change_of_an_exploration_passes_that_explores_fewer_cells_or_none_sooner() {
        let changes = all(&half());
        let right: Vec<&str> = changes
            .iter()
            .filter(|(_, changed)| changed.judge().is_ok())
            .map(|(what, _)| what.as_str())
            .collect();
        // Two team moves may be made in either order.
        assert_eq!((changes.len(), right), (180, vec!["moves: 2 exchanged with the next"]));
    }
}
