//! The best joint step of a chain: of all plans that the chain's conditions admit, one with the greatest sum of values.
//!
//! The conditions between neighbours and those about one robot alone make a chain of choices, five a robot and 25 a
//! pair of neighbours: dynamic programming from the base to the leader finds the best plan. The condition that no two
//! robots plan to be in one cell ties robots that are no neighbours; with it the plans are searched depth first from
//! the leader, and what dynamic programming gives for the robots behind is the bound. It is a step solver, not Full
//! search: there links are a tree.

use tautline_kernel::chain::{Condition, Move, Role, Rule};
use tautline_kernel::ground::{Cell, Step, Steps};

/// One robot's options.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Options {
    /// The steps that it may take, as far as it alone is concerned: no side that is known to be a wall.
    pub allowed: Steps,
    /// Those that cross a side known to be open.
    pub known_open: Steps,
    /// The value of each step, in direction order; no farther from 0 than 2⁵³.
    pub values: [i64; Step::ALL.len()],
}

/// A chain before its team move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Position<'a> {
    /// Its rule.
    pub rule: &'a Rule,
    /// Where the robots are, the base first.
    pub cells: &'a [Cell],
    /// The options of each robot. The base stays, whatever stands here.
    pub options: &'a [Options],
}

/// A plan.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Plan {
    /// The steps of all robots, the base first.
    pub steps: Vec<Step>,
    /// Their value together, without the base.
    pub value: i64,
}

/// Branches after which the search for a plan with distinct cells gives up.
pub const MOST_NODES: u32 = 1_000_000;

/// The solver's answer.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Solution {
    /// No plan is better than this one.
    Best(Plan),
    /// The conditions admit no plan.
    Impossible,
    /// After [`MOST_NODES`] branches the best plan so far, if there is one. No plan is better than `bound`.
    GaveUp {
        /// The best so far.
        plan: Option<Plan>,
        /// An upper bound on the value of the best plan.
        bound: i64,
    },
}

/// The value of what is not admitted.
const NONE: i64 = i64::MIN;

/// For each robot and step, what the robots from the base to this one are worth at best.
struct Table<'a> {
    position: &'a Position<'a>,
    values: Vec<[i64; Step::ALL.len()]>,
}

/// The best plan of the chain in `position`. Ties go to the earlier direction, the leader first. A chain of which not
/// every robot has options has no plan.
pub fn best(position: &Position<'_>) -> Solution {
    if position.cells.is_empty() || position.cells.len() != position.options.len() {
        return Solution::Impossible;
    }
    let table = Table::new(position);
    let leader = position.cells.len() - 1;
    let bound = table.values[leader].into_iter().max().unwrap_or(NONE);
    if bound == NONE {
        return Solution::Impossible;
    }
    let is_distinct = position.rule.has(Condition::Distinct);
    let mut search =
        Search { table: &table, is_distinct, nodes: 0, best: None, steps: Vec::new(), taken: Vec::new() };
    let is_done = search.descend(leader, None, 0);
    let plan = search.best;
    match (is_done, plan) {
        (true, Some(plan)) => Solution::Best(plan),
        (true, None) => Solution::Impossible,
        (false, plan) => Solution::GaveUp { plan, bound },
    }
}

impl<'a> Table<'a> {
    fn new(position: &'a Position<'a>) -> Self {
        let Position { rule, cells, .. } = *position;
        let full = full(cells);
        let base = [NONE, NONE, NONE, NONE, 0];
        let mut table = Self { position, values: vec![[NONE; 5]; cells.len()] };
        table.values[0] = base;
        for robot in 1..cells.len() {
            let (at, behind) = (cells[robot], cells[robot - 1]);
            let Options { allowed, values, .. } = position.options[robot];
            let role = if robot + 1 == cells.len() { Role::Leader } else { Role::Follower };
            let is_guarded = !full.is_empty() && !rule.admits_entry(role, 2);
            for step in allowed.and(rule.steps_behind(at, behind)).iter() {
                if is_guarded && step != Step::Stay && full.contains(&at.after(step)) {
                    continue;
                }
                let least = table.admitted(robot, step).map(|(_, value)| value).max();
                if let Some(value) = least {
                    table.values[robot][step.place()] = value + values[step.place()];
                }
            }
        }
        table
    }

    /// The steps open to the robot behind `robot` if this one does `step`, and their value at best with the robots
    /// behind it.
    fn admitted(&self, robot: usize, step: Step) -> impl Iterator<Item = (Step, i64)> + use<'_> {
        let Position { rule, cells, options } = *self.position;
        let known_open = options[robot].known_open.has(step);
        let steps = rule.steps_ahead(cells[robot - 1], Move { from: cells[robot], step, known_open });
        let values = self.values[robot - 1];
        steps.iter().map(move |step| (step, values[step.place()])).filter(|&(_, value)| value != NONE)
    }
}

/// The cells outside the base that two robots or more are in.
fn full(cells: &[Cell]) -> Vec<Cell> {
    let Some((&base, rest)) = cells.split_first() else { return Vec::new() };
    let mut sorted = rest.to_vec();
    sorted.sort_unstable();
    let shared = sorted.chunk_by(|one, other| one == other).filter(|alike| alike.len() > 1);
    shared.map(|alike| alike[0]).filter(|&cell| cell != base).collect()
}

struct Search<'a> {
    table: &'a Table<'a>,
    is_distinct: bool,
    nodes: u32,
    best: Option<Plan>,
    /// The steps of the robots from the leader on, and where they lead.
    steps: Vec<Step>,
    taken: Vec<Cell>,
}

impl Search<'_> {
    /// Chooses for `robot`, when the one ahead does `ahead` and all ahead are worth `value`; whether all was looked at.
    fn descend(&mut self, robot: usize, ahead: Option<Step>, value: i64) -> bool {
        self.nodes += 1;
        if self.nodes > MOST_NODES {
            return false;
        }
        if robot == 0 {
            let is_better = self.best.as_ref().is_none_or(|best| value > best.value);
            if is_better {
                let steps = [Step::Stay].into_iter().chain(self.steps.iter().rev().copied());
                self.best = Some(Plan { steps: steps.collect(), value });
            }
            return true;
        }
        let Position { cells, options, .. } = *self.table.position;
        let mut choices = [(Step::Stay, NONE); Step::ALL.len()];
        let mut count = 0;
        let mut offer = |choice| {
            choices[count] = choice;
            count += 1;
        };
        match ahead {
            Some(step) => self.table.admitted(robot + 1, step).for_each(&mut offer),
            None => Step::ALL.into_iter().zip(self.table.values[robot]).for_each(&mut offer),
        }
        let choices = &mut choices[..count];
        // The sort is stable: ties stay in direction order.
        choices.sort_by_key(|&(_, least)| std::cmp::Reverse(least));
        for &(step, least) in &*choices {
            if least == NONE || self.best.as_ref().is_some_and(|best| value + least <= best.value) {
                break;
            }
            let to = cells[robot].after(step);
            if self.is_distinct && to != cells[0] && self.taken.contains(&to) {
                continue;
            }
            self.steps.push(step);
            self.taken.push(to);
            let is_done = self.descend(robot - 1, Some(step), value + options[robot].values[step.place()]);
            self.steps.pop();
            self.taken.pop();
            if !is_done {
                return false;
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tautline_grids::chance::Dice;
    use tautline_kernel::chain::Conditions;

    /// A chain, drawn at random: neighbours within E_C of each other, some in one cell.
    fn chain(dice: &mut Dice, robots: usize) -> (Vec<Cell>, Vec<Options>) {
        let mut cells = vec![Cell::new(0, 0)];
        let mut below = |below: u64| dice.below(below);
        for _ in 1..robots {
            let Cell { x, y } = *cells.last().expect("the base");
            let next = Cell::new(x + below(3) as i16 - 1, y + below(3) as i16 - 1);
            cells.push(next);
        }
        let option = |_| Options {
            allowed: Steps::of_bits(below(32) as u8 | below(32) as u8).with(Step::Stay),
            known_open: Steps::of_bits(below(32) as u8),
            values: [(); 5].map(|()| below(41) as i64 - 20),
        };
        let options = cells.iter().map(option).collect();
        (cells, options)
    }

    /// The best value by plain enumeration: every condition asked one by one.
    fn enumerated(position: &Position<'_>) -> Option<i64> {
        let Position { rule, cells, options } = *position;
        let robots = cells.len();
        let mut best = None;
        for number in 0..5_usize.pow(robots as u32 - 1) {
            let mut rest = number;
            let mut steps = vec![Step::Stay];
            for _ in 1..robots {
                steps.push(Step::ALL[rest % 5]);
                rest /= 5;
            }
            let moves: Vec<Move> = (0..robots)
                .map(|robot| Move {
                    from: cells[robot],
                    step: steps[robot],
                    known_open: options[robot].known_open.has(steps[robot]),
                })
                .collect();
            let is_admitted = (1..robots).all(|robot| {
                let to = moves[robot].to();
                let role = if robot + 1 == robots { Role::Leader } else { Role::Follower };
                let there = cells.iter().filter(|&&cell| cell == to).count();
                options[robot].allowed.has(steps[robot])
                    && rule.admits_behind(to, cells[robot - 1])
                    && rule.admits_ahead(moves[robot - 1], moves[robot])
                    && (steps[robot] == Step::Stay || to == cells[0] || rule.admits_entry(role, there))
                    && (!rule.has(Condition::Distinct)
                        || to == cells[0]
                        || moves[1..robot].iter().all(|other| other.to() != to))
            });
            if is_admitted {
                let value = (1..robots).map(|robot| options[robot].values[steps[robot].place()]).sum();
                best = best.max(Some(value));
            }
        }
        best
    }

    #[test]
    fn the_step_solver_finds_what_plain_enumeration_finds_in_10_000_positions() {
        let mut dice = Dice::new(7, *b"fixed   ");
        let bare = Rule { conditions: Conditions::of(&[]), ..Rule::PUBLISHED };
        let rules = [
            Rule::PUBLISHED,
            Rule::REPAIRED,
            Rule::PUBLISHED.without(Condition::Distinct),
            Rule::REPAIRED.without(Condition::Distinct),
            bare,
        ];
        let (mut met, mut impossible) = (0, 0);
        for case in 0..10_000 {
            let robots = 2 + dice.below(4) as usize;
            let (cells, options) = chain(&mut dice, robots);
            let position = Position { rule: &rules[case % rules.len()], cells: &cells, options: &options };
            let due = enumerated(&position);
            match best(&position) {
                Solution::Best(plan) => {
                    met += 1;
                    assert_eq!(due, Some(plan.value), "{position:?}");
                    let values = plan.steps.iter().zip(&options).skip(1);
                    assert_eq!(
                        plan.value,
                        values.map(|(step, option)| option.values[step.place()]).sum::<i64>()
                    );
                }
                Solution::Impossible => {
                    impossible += 1;
                    assert_eq!(due, None, "{position:?}");
                }
                Solution::GaveUp { .. } => panic!("five robots are searched to the end: {position:?}"),
            }
        }
        assert!(met > 5000 && impossible > 0, "{met} {impossible}");
    }
}
