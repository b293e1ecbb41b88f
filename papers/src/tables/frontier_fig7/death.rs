//! A robot that dies while a team explores (Rajesh, Nagaraja and Suja 2024, 1: “fault tolerance will be improved as
//! multiple robots will introduce redundancy”).
//!
//! The others do not know that it is dead: for them it keeps the cell that it has claimed last. Its body stays in its
//! cell. Robots of a rule with *Look* do not get past it; the sensors of the others see no robot, so that it is in
//! nobody's way.

use std::collections::BTreeSet;

use tautline_grids::chance::Dice;
use tautline_kernel::frontier::{Condition, Rule};
use tautline_kernel::ground::Cell;
use tautline_sim::frontier::Explorers;
use tautline_sim::options::Options;

use super::super::prelude::*;
use super::{Line, ends, is_judged};

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

/// The paper's sentence, in the mean of the layouts and on each of them.
pub(super) fn judged(lines: &[Line]) -> Vec<Judgement> {
    let teams = || lines.iter().filter(is_judged);
    let who = |line: &Line| format!("{} robots, {}, one dies", line.robots, line.rule);
    let in_mean = |line: &Line| {
        let one = lines.iter().find(|one| one.rule == line.rule && one.robots == 1);
        let one = one.and_then(|one| one.tolerant);
        let measured =
            format!("every cell in {} % of the runs, one robot {} %", text(line.tolerant, 1), text(one, 1));
        Judgement::new(
            "“fault tolerance will be improved” (1), in the mean",
            who(line),
            measured,
            below(ends(one), ends(line.tolerant)),
        )
    };
    let on_each = |line: &Line| {
        let measured = format!("all that the others can get to in {} % of the runs", text(line.cleared, 1));
        let verdict = always(line.cleared.map(|cleared| cleared.times(0.01)));
        Judgement::new("“fault tolerance will be improved” (1), on each layout", who(line), measured, verdict)
    };
    teams().map(in_mean).chain(teams().map(on_each)).collect()
}

#[cfg(test)]
mod tests {
    use tautline_sim::explore::{Milestone, RuleId};

    use super::super::{Outcome, drawn, follow};
    use super::*;

    /// A team of so many repaired robots, whose runs leave out these cells.
    fn line(robots: u16, left: &[[u32; 2]]) -> Line {
        let outcome = |left: &[u32; 2]| Outcome {
            moves: Some(9),
            explored: 1000,
            is_double: false,
            again: None,
            entered: None,
            unheard: None,
            left: Some(*left),
        };
        let outcomes: Vec<Outcome> = left.iter().map(outcome).collect();
        Line::of(RuleId::REPAIRED, robots, &outcomes, &[Vec::new(), Vec::new()])
    }

    #[test]
    fn a_team_tolerates_a_death_in_the_mean_or_on_each_layout() {
        use Verdict::{Fails, Holds, Open};
        let alone = line(1, &[[7, 0]; 100]);
        assert_eq!((alone.tolerant.map(|share| share.mean), alone.cleared), (Some(0.0), None));
        let verdicts = |left: &[[u32; 2]]| -> Vec<Verdict> {
            judged(&[alone.clone(), line(2, left)]).iter().map(|judgement| judgement.verdict).collect()
        };
        assert_eq!(verdicts(&[[0, 0]; 100]), [Holds, Holds]);
        assert_eq!(verdicts(&[[4, 0]; 100]), [Open, Holds], "the body shuts the way");
        let mut one = [[0, 0]; 100];
        one[30] = [4, 1];
        assert_eq!(verdicts(&one), [Holds, Fails], "on one layout they leave out what they can get to");
    }

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
    fn a_robot_stands_before_a_body_for_ever_although_another_way_is_as_short() {
        let square = Layout::open(2, 2).expect("a layout");
        let starts = [Cell::new(0, 0), Cell::new(1, 1)];
        let all = (0..40).filter_map(|seed| left(Rule::REPAIRED, &square, &starts, 1, seed));
        // Which of the two ways comes first for the robot that is left tells whether the body is in its way.
        assert_eq!(all.collect::<BTreeSet<_>>(), [[0, 0], [1, 1]].into());
    }

    #[test]
    fn the_body_stops_the_others_and_without_lapse_the_claim_does() {
        let settings = super::super::Settings::default();
        let rules = [
            Rule::REPAIRED,
            Rule::REPAIRED.without(Condition::Look),
            Rule::REPAIRED.without(Condition::Lapse),
        ];
        let cleared = |robots: usize| {
            let mut cleared = [0; 3];
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
        assert_eq!([2, 8].map(cleared), [[160, 200, 95], [197, 200, 130]]);
    }
}
