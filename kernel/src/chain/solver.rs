//! The step solver: of all the team moves that the conditions admit, one that costs least, as far as the steps of
//! neighbours in the chain decide it. What a robot's step costs hangs on its own and its neighbour's step alone, so the
//! cheapest move is found robot by robot from the base up, in O(N) (25 pairs of steps each). That every robot has a
//! planned cell of its own is no matter of neighbours: where the cheapest move breaks it, the next cheapest step behind
//! is tried, within a bound.

use super::plan::{mark_occupied, unmark_occupied};
use super::rule::{Condition, Move, Role, Rule};
use crate::ground::{Cell, CellMark, EdgeMark, Grid, Step, Steps, neighbouring_steps, steps_to};

/// A robot's possible steps, and their costs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wish {
    /// The steps that are wished for.
    pub(super) steps: Steps,
    /// The cost of each, by its place.
    pub(super) cost: [i32; Step::ALL.len()],
}

impl Wish {
    /// To stay.
    pub(super) const STAY: Self = Self { steps: Steps::only(Step::Stay), cost: [0; Step::ALL.len()] };
}

/// The cost of two neighbours in the chain that do not plan to be side by side, or in one cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Apart(pub(super) i32);

/// Steps that are tried beyond one for each robot, for each robot.
const PATIENCE: usize = 4;

/// A team move in the making.
struct Solver<'a, const ROBOTS: usize> {
    rule: &'a Rule,
    /// P_1 … P_N.
    team: &'a [Cell],
    wishes: &'a [Wish; ROBOTS],
    apart: Apart,
    /// The steps of each robot that its present neighbours, walls and full cells
    /// leave, and then also the robots behind it.
    left: [Steps; ROBOTS],
    /// By robot and place of a step that is left: the least that it and all behind it cost.
    least: [[i32; Step::ALL.len()]; ROBOTS],
}

/// The steps of the robots in `team`, base first, that `rule` admits and that cost least by `wishes` and `apart`;
/// `None` if none is found. A side that is not known to be a wall is never taken for open: so what is found does not
/// hang on what a team finds open on its way.
pub(super) fn solve<G: Grid, const ROBOTS: usize>(
    rule: &Rule,
    grid: &mut G,
    team: &[Cell],
    wishes: &[Wish; ROBOTS],
    apart: Apart,
) -> Option<[Step; ROBOTS]> {
    let left = [Steps::only(Step::Stay); ROBOTS];
    let mut solver = Solver { rule, team, wishes, apart, left, least: [[0; Step::ALL.len()]; ROBOTS] };
    mark_occupied(grid, team);
    let is_left = solver.leave(grid);
    unmark_occupied(grid, team);
    if is_left && solver.cost() { solver.choose(grid) } else { None }
}

impl<const ROBOTS: usize> Solver<'_, ROBOTS> {
    /// Leaves the steps that nobody else's steps matter to; false if a robot has none.
    fn leave(&mut self, grid: &impl Grid) -> bool {
        let leader = self.team.len() - 1;
        (1..=leader).all(|robot| {
            let (at, behind) = (self.team[robot], self.team[robot - 1]);
            let role = if robot == leader { Role::Leader } else { Role::Follower };
            let mut steps = self.rule.steps_behind(at, behind);
            if robot == leader {
                steps = steps.with(Step::Stay);
            }
            steps = steps.and(self.wishes[robot].steps).minus(grid.sides(EdgeMark::Wall, at));
            self.left[robot] = self.rule.may_enter(grid, role, at, steps);
            !self.left[robot].is_empty()
        })
    }

    /// The steps of the robot behind `robot` that agree with its `step`.
    fn agreeing(&self, robot: usize, step: Step) -> Steps {
        let own = Move { from: self.team[robot], step, known_open: false };
        let at = self.team[robot - 1];
        let steps = self.left[robot - 1].and(self.rule.steps_ahead(at, own));
        let to = own.to();
        let is_taken = self.rule.has(Condition::Distinct) && to != self.team[0];
        if is_taken { steps.minus(steps_to(to, at)) } else { steps }
    }

    /// The cost of a step of the robot behind `robot`, and of all behind it, if `robot` does its `own`.
    fn behind(&self, robot: usize, own: Step) -> impl Fn(Step) -> i32 {
        let together = neighbouring_steps(self.team[robot].after(own), self.team[robot - 1]);
        let (least, apart) = (self.least[robot - 1], self.apart.0);
        move |step| least[step.place()] + if together.has(step) { 0 } else { apart }
    }

    /// Finds the least costs, and leaves the steps that have one; false if a robot has none.
    fn cost(&mut self) -> bool {
        (1..self.team.len()).all(|robot| {
            for step in self.left[robot].iter() {
                let least = self.agreeing(robot, step).iter().map(self.behind(robot, step)).min();
                match least {
                    Some(least) => {
                        self.least[robot][step.place()] = least + self.wishes[robot].cost[step.place()];
                    }
                    None => self.left[robot] = self.left[robot].without(step),
                }
            }
            !self.left[robot].is_empty()
        })
    }

    /// The cheapest steps from the leader backwards, each with a planned cell of its own.
    fn choose(&self, grid: &mut impl Grid) -> Option<[Step; ROBOTS]> {
        let leader = self.team.len() - 1;
        let is_distinct = self.rule.has(Condition::Distinct);
        let mut steps = [Step::Stay; ROBOTS];
        let mut tried = [Steps::NONE; ROBOTS];
        let planned = |robot: usize, step| self.team[robot].after(step);
        let (mut robot, mut left) = (leader, (PATIENCE + 1) * self.team.len());
        while robot > 0 && left > 0 {
            let at = self.team[robot];
            let mut fit =
                if robot == leader { self.left[leader] } else { self.agreeing(robot + 1, steps[robot + 1]) };
            fit = fit.minus(tried[robot]);
            if is_distinct {
                fit = fit.minus(grid.steps_to(CellMark::Planned, at, fit));
            }
            let cost = |step: Step| {
                if robot == leader {
                    self.least[leader][step.place()]
                } else {
                    self.behind(robot + 1, steps[robot + 1])(step)
                }
            };
            if let Some(step) = fit.iter().min_by_key(|&step| cost(step)) {
                left -= 1;
                tried[robot] = tried[robot].with(step);
                steps[robot] = step;
                let to = planned(robot, step);
                if is_distinct && to != self.team[0] {
                    grid.put(CellMark::Planned, to);
                }
                robot -= 1;
            } else if robot < leader {
                tried[robot] = Steps::NONE;
                robot += 1;
                grid.take(CellMark::Planned, planned(robot, steps[robot]));
            } else {
                break;
            }
        }
        for (claimed, &step) in steps.iter().enumerate().take(leader + 1).skip(robot + 1) {
            grid.take(CellMark::Planned, planned(claimed, step));
        }
        (robot == 0 && self.rule.keeps_sides(self.team, &steps)).then_some(steps)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choice::Oracle;
    use crate::choice::tests::Congruence;
    use crate::ground::{Area, Side, SmallGrid};

    const ROBOTS: usize = 5;

    /// The cost of `steps`, if each is wished for.
    fn cost(team: &[Cell], steps: &[Step], wishes: &[Wish], apart: i32) -> Option<i32> {
        let planned = |robot: usize| team[robot].after(steps[robot]);
        (1..team.len()).try_fold(0, |sum, robot| {
            let (one, other) = (planned(robot), planned(robot - 1));
            let is_apart = one.x.abs_diff(other.x) + one.y.abs_diff(other.y) > 1;
            let own = wishes[robot].cost[steps[robot].place()];
            let all = sum + own + if is_apart { apart } else { 0 };
            wishes[robot].steps.has(steps[robot]).then_some(all)
        })
    }

    #[test]
    fn what_is_solved_costs_least_of_all_that_is_admitted() {
        let mut drawn = Congruence(1);
        let area = Area::new(Cell::new(0, 0), Cell::new(4, 4)).expect("cells");
        let mut told = [0; 2];
        for round in 0..400 {
            let rule = [
                Rule::REEL,
                Rule::REEL.without(Condition::FullForLeader),
                Rule::REEL.without(Condition::FullForFollower),
                Rule::PUBLISHED,
            ][round % 4];
            let is_distinct = round / 4 % 2 == 0;
            let rule = if is_distinct { rule } else { rule.without(Condition::Distinct) };
            let mut grid = SmallGrid::new(area).expect("it fits");
            for edge in area.edges().filter(|_| drawn.pick(8) == 0) {
                grid.put_edge(EdgeMark::Wall, edge);
            }
            let mut team = [Cell::new(2, 2); ROBOTS];
            for robot in 1..ROBOTS {
                let to = (0..3).fold(team[robot - 1], |at, _| at.after(Step::ALL[drawn.pick(5) as usize]));
                team[robot] = if area.contains(to) { to } else { team[robot - 1] };
            }
            let mut wishes = [Wish::STAY; ROBOTS];
            for wish in &mut wishes[1..] {
                wish.steps = Steps::of_bits(drawn.pick(32) as u8).with(Step::Stay);
                wish.cost = core::array::from_fn(|_| drawn.pick(20) as i32 - 10);
            }
            let apart = drawn.pick(6) as i32;
            let before = grid;
            let solved = solve(&rule, &mut grid, &team, &wishes, Apart(apart));
            assert!(grid == before, "no mark is left behind");
            let all = (0..5_usize.pow(ROBOTS as u32 - 1)).map(|number| {
                let step = |robot: usize| Step::ALL[number / 5_usize.pow(robot as u32 - 1) % 5];
                core::array::from_fn(|robot| if robot == 0 { Step::Stay } else { step(robot) })
            });
            let costs = all.filter_map(|steps: [Step; ROBOTS]| {
                let cost = cost(&team, &steps, &wishes, apart)?;
                rule.admits_plan(&mut grid, &team, &steps).then_some(cost)
            });
            let least = costs.min();
            assert_eq!(solved.is_some(), least.is_some(), "{rule:?} {team:?}");
            told[usize::from(solved.is_some())] += 1;
            let Some(steps) = solved else { continue };
            let cost = cost(&team, &steps, &wishes, apart);
            assert!(rule.admits_plan(&mut grid, &team, &steps), "{rule:?} {team:?} {steps:?}");
            // A planned cell of its own for each robot is found first, and not always the cheapest ones.
            assert!(cost == least || is_distinct && cost > least, "{rule:?} {team:?} {steps:?}");
        }
        assert!(told.iter().all(|&times| times > 50), "{told:?}");
    }

    #[test]
    fn a_cell_that_both_ends_of_a_long_chain_wish_for_is_given_up_after_five_tries_a_robot() {
        const MOST: usize = 12;
        let area = Area::new(Cell::new(0, 0), Cell::new(4, 4)).expect("cells");
        let mut grid = SmallGrid::new(area).expect("it fits");
        let (base, step) = (Cell::new(2, 2), |side| Steps::only(Step::Cross(side)));
        let mut finds = |robots: usize| {
            // R_2 goes east from the base, where all are but the leader, which would
            // rather go north to the same cell than stay.
            let mut team = [base; MOST];
            team[robots - 1] = Cell::new(3, 3);
            let mut wishes = [Wish { steps: Steps::ALL, ..Wish::STAY }; MOST];
            wishes[robots - 1].steps = step(Side::North).with(Step::Stay);
            wishes[robots - 1].cost[Step::Stay.place()] = 9;
            wishes[1].steps = step(Side::East);
            solve(&Rule::REEL, &mut grid, &team[..robots], &wishes, Apart(0)).is_some()
        };
        assert!((3..=4).all(&mut finds) && !(6..=MOST).any(finds));
    }
}
