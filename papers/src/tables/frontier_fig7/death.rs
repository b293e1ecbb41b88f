//! A robot that dies while a team explores (Rajesh, Nagaraja and Suja 2024, 1: “fault tolerance will be improved as
//! multiple robots will introduce redundancy”).
//!
//! The others do not know that it is dead: for them it keeps the cell that it has claimed last. Its body stays in its
//! cell. Robots of a rule with *Look* do not get past it, and go round it if their rule has *Bypass*; the sensors of
//! the others see no robot, so that it is in nobody's way.

use std::collections::BTreeSet;

use tautline_grids::chance::Dice;
use tautline_kernel::frontier::{Condition, Rule};
use tautline_kernel::ground::Cell;
use tautline_sim::frontier::Explorers;
use tautline_sim::options::Options;

use super::super::prelude::*;

/// How many cells are left out if one robot dies, and how many of them the others could get to. The robot is drawn, and
/// so are the team moves before its death, fewer than `moves`.
pub(super) fn left(rule: Rule, layout: &Layout, starts: &[Cell], moves: u32, seed: u64) -> Option<[u32; 2]> {
    let mut dice = Dice::new(seed, *b"dies    ");
    let (dead, before) = (dice.below(starts.len() as u64) as usize, dice.below(moves.into()));
    let mut team = Explorers::new(rule, layout, starts, Options::default(), seed);
    let mut left: BTreeSet<Cell> = layout.reachable(starts).into_iter().collect();
    left.retain(|cell| !starts.contains(cell));
    let advance = |team: &mut Explorers, left: &mut BTreeSet<Cell>| {
        let made = team.advance().ok();
        made.iter().flat_map(|frame| &frame.cells).for_each(|cell| {
            left.remove(cell);
        });
        made.is_some()
    };
    if moves == 0 || !(0..before).all(|_| advance(&mut team, &mut left)) {
        return None;
    }
    team.dies(dead);
    let mut others = team.cells().to_vec();
    let body = others.swap_remove(dead);
    let past = layout.clone().with_blocked(rule.has(Condition::Look).then_some(body)).reachable(&others);
    let due = |left: &BTreeSet<Cell>| count(&past, |cell| left.contains(cell));
    while due(&left) > 0 && advance(&mut team, &mut left) {}
    Some([left.len() as u32, due(&left)])
}

#[cfg(test)]
mod tests {
    use tautline_sim::explore::{Milestone, RuleId};

    use super::super::{drawn, follow};
    use super::*;

    #[test]
    fn the_body_of_a_robot_shuts_a_corridor_to_robots_that_look() {
        let corridor = Layout::open(9, 1).expect("a layout");
        let starts = [Cell::new(0, 0), Cell::new(1, 0)];
        let of = |rule: Rule| -> BTreeSet<[u32; 2]> {
            (0..40).filter_map(|seed| left(rule, &corridor, &starts, 7, seed)).collect()
        };
        // The one behind, or the one ahead after 0 to 6 team moves, dies.
        assert_eq!(of(Rule::REPAIRED), (0..=7).map(|left| [left, 0]).collect());
        assert_eq!(of(Rule::WANDERS), [[0, 0]].into());
        assert_eq!(left(Rule::REPAIRED, &corridor, &starts[..1], 0, 0), None, "nothing is left to explore");
    }

    #[test]
    fn a_robot_goes_round_a_body_or_stands_before_it_for_ever() {
        let square = Layout::open(2, 2).expect("a layout");
        let starts = [Cell::new(0, 0), Cell::new(1, 1)];
        let of = |rule: Rule| -> BTreeSet<[u32; 2]> {
            (0..40).filter_map(|seed| left(rule, &square, &starts, 1, seed)).collect()
        };
        assert_eq!(of(Rule::REPAIRED), [[0, 0]].into());
        // Which of the two ways comes first for the robot that is left tells whether the body is in its way.
        assert_eq!(of(Rule::REPAIRED.without(Condition::Bypass)), [[0, 0], [1, 1]].into());
    }

    #[test]
    fn without_bypass_the_body_stops_the_others_and_without_lapse_the_claim_does() {
        let settings = super::super::Settings::default();
        let rules = [
            Rule::REPAIRED,
            Rule::REPAIRED.without(Condition::Bypass),
            Rule::REPAIRED.without(Condition::Bypass).without(Condition::Look),
            Rule::REPAIRED.without(Condition::Lapse),
        ];
        let cleared = |robots: usize| {
            let mut cleared = [0; 4];
            for seed in 0..200 {
                let (layout, starts) = drawn(&settings, seed).expect("a layout");
                let starts = &starts[..robots];
                let run = follow(RuleId::REPAIRED, &layout, starts, Options::default(), seed).expect("a run");
                let moves = run.0.reached(Milestone::Whole).expect("a repaired team explores every cell");
                for (rule, cleared) in rules.into_iter().zip(&mut cleared) {
                    *cleared +=
                        u32::from(left(rule, &layout, starts, moves, seed).is_none_or(|left| left[1] == 0));
                }
            }
            cleared
        };
        assert_eq!([2, 8].map(cleared), [[200, 160, 200, 102], [200, 197, 200, 131]]);
    }
}
