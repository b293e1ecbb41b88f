//! The team's knowledge, and what its rule says about a planned move: the judge hears one move after the other.

use std::collections::BTreeSet;

use super::judge_input::{JudgeInput, Move, Repairs};
use super::place::{Place, add, is_covered, is_safe, side_between};

/// The team's knowledge, kept by the judge.
#[derive(Clone)]
pub(super) struct Court<'a> {
    pub(super) input: &'a JudgeInput,
    pub(super) places: Vec<Place>,
    /// Displacements of the advances that are not taken back.
    pub(super) history: Vec<Vec<Place>>,
    pub(super) walls: BTreeSet<(Place, Place)>,
    pub(super) open: BTreeSet<(Place, Place)>,
    pub(super) explored: BTreeSet<Place>,
    /// The sides with a virtual obstacle.
    pub(super) refused: BTreeSet<(Place, Place)>,
    /// Whether this epoch has explored a cell or found a wall; the first begins with one explored.
    pub(super) gained: bool,
    /// Whether this epoch began by unfolding the chain.
    pub(super) unfolds: bool,
}

impl<'a> Court<'a> {
    /// Before the first move. The number of robots is checked with each move, and may be any before.
    pub(super) fn new(input: &'a JudgeInput, robots: usize) -> Self {
        Self {
            input,
            places: vec![input.base; robots],
            history: Vec::new(),
            walls: BTreeSet::new(),
            open: BTreeSet::new(),
            explored: BTreeSet::from([input.base]),
            refused: BTreeSet::new(),
            gained: true,
            unfolds: false,
        }
    }

    pub(super) fn are_all_there(&self, made: &Move) -> Result<(), &'static str> {
        let robots = self.input.robots;
        if [made.tried.len(), made.blocked.len(), made.places.len(), self.places.len()] != [robots; 4] {
            return Err("every robot has a step, an outcome and a place");
        }
        Ok(())
    }

    pub(super) fn hear(&mut self, made: &Move) -> Result<(), &'static str> {
        if made.tried.iter().any(|&(x, y)| x.unsigned_abs().saturating_add(y.unsigned_abs()) > 1) {
            return Err("a step leads to a side neighbour or nowhere");
        }
        if made.tried[0] != (0, 0) || made.blocked[0] || made.places[0] != self.input.base {
            return Err("the base does something");
        }
        if made.is_backtrack {
            self.hear_backtrack(made)?;
        } else {
            self.hear_advance(made)?;
        }
        for robot in 0..self.input.robots {
            let arrived = if made.blocked[robot] { self.places[robot] } else { self.target(made, robot) };
            if made.places[robot] != arrived {
                return Err("a robot is not where its step leads");
            }
            self.gained |= self.explored.insert(arrived);
        }
        Ok(())
    }

    fn hear_backtrack(&mut self, made: &Move) -> Result<(), &'static str> {
        let Some(last) = self.history.pop() else { return Err("there is nothing to take back") };
        if made.blocked.contains(&true) {
            return Err("a backtrack is not blocked");
        }
        if last.iter().zip(&made.tried).any(|(&(x, y), &back)| (-x, -y) != back) {
            return Err("a backtrack takes the last open move back");
        }
        Ok(())
    }

    fn hear_advance(&mut self, made: &Move) -> Result<(), &'static str> {
        self.admits(&made.tried)?;
        for robot in 1..made.tried.len() {
            let is_step = made.tried[robot] != (0, 0);
            if made.blocked[robot] && !is_step {
                return Err("a robot that stays is not blocked");
            }
            if is_step && made.blocked[robot] == self.input.is_open(self.side(robot, made.tried[robot])) {
                return Err("a robot is blocked where nothing is in the way, or passes where something is");
            }
        }
        for robot in 1..made.tried.len() {
            let side = self.side(robot, made.tried[robot]);
            if made.blocked[robot] {
                self.gained |= self.walls.insert(side);
            } else if made.tried[robot] != (0, 0) {
                self.open.insert(side);
            }
        }
        let displaced = |robot: usize| if made.blocked[robot] { (0, 0) } else { made.tried[robot] };
        self.history.push((0..made.tried.len()).map(displaced).collect());
        Ok(())
    }

    /// The sentences of the rule about a planned move, given by its steps.
    pub(super) fn admits(&self, tried: &[Place]) -> Result<(), &'static str> {
        let planned: Vec<Place> = tried.iter().zip(&self.places).map(|(&step, &at)| add(at, step)).collect();
        for robot in 1..planned.len() {
            self.admits_step(robot, tried[robot])?;
            self.admits_pair(robot, tried[robot], planned[robot - 1])?;
            if planned[robot] != self.input.base && planned[1..robot].contains(&planned[robot]) {
                return Err("two robots plan to be in one cell outside the base");
            }
        }
        Ok(())
    }

    /// Those about a robot alone.
    pub(super) fn admits_step(&self, robot: usize, step: Place) -> Result<(), &'static str> {
        let (stays, planned) = (step == (0, 0), add(self.places[robot], step));
        if !stays && self.is_known_wall(self.side(robot, step)) {
            return Err("a robot plans to cross a known wall");
        }
        let is_null = stays && robot + 1 == self.input.robots;
        if !is_null && !is_covered(self.places[robot - 1], planned) {
            return Err("a planned position is not in E_C of the present position behind");
        }
        let others = self.places.iter().filter(|&&place| place == planned).count();
        let is_full = !stays && planned != self.input.base && others >= 2;
        if is_full && self.input.repairs == Repairs::With {
            return Err("a robot plans to enter a cell that two others occupy");
        }
        Ok(())
    }

    /// Those about a robot that plans to make `step`, and the one behind it, which plans to be at `behind`.
    pub(super) fn admits_pair(&self, robot: usize, step: Place, behind: Place) -> Result<(), &'static str> {
        if !is_safe(add(self.places[robot], step), behind) {
            return Err("a planned position is not in E_S of the planned position ahead");
        }
        let is_sure = step == (0, 0) || self.open.contains(&self.side(robot, step));
        if self.input.repairs == Repairs::With && !is_sure && !is_covered(self.places[robot], behind) {
            return Err("behind an unsure neighbour a robot plans to leave E_C of its present position");
        }
        Ok(())
    }

    pub(super) fn is_known_wall(&self, side: (Place, Place)) -> bool {
        self.walls.contains(&side) || self.input.is_border(side)
    }

    fn target(&self, made: &Move, robot: usize) -> Place {
        add(self.places[robot], made.tried[robot])
    }

    pub(super) fn side(&self, robot: usize, step: Place) -> (Place, Place) {
        side_between(self.places[robot], add(self.places[robot], step))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn input(repairs: Repairs) -> JudgeInput {
        JudgeInput::open("", repairs, (7, 7), (3, 3), 4)
    }

    #[test]
    fn only_the_leader_may_stay_where_it_is_not_in_e_c_of_the_robot_behind() {
        let input = input(Repairs::Without);
        let mut court = Court::new(&input, 4);
        let stays = |court: &Court<'_>, robot| court.admits_step(robot, (0, 0)).is_ok();
        assert!((1..4).all(|robot| stays(&court, robot)));
        court.places[3] = (5, 4);
        assert!((1..4).all(|robot| stays(&court, robot)) && court.admits_step(3, (1, 0)).is_err());
        assert!(court.admits_step(3, (0, -1)).is_ok());
        for robot in [1, 2] {
            let mut court = Court::new(&input, 4);
            court.places[robot] = (5, 4);
            assert!((1..4).all(|other| stays(&court, other) == (other == 3 || other != robot && other != robot + 1)));
        }
    }

    #[test]
    fn who_crosses_a_side_that_was_crossed_before_is_sure() {
        let input = input(Repairs::With);
        let mut court = Court::new(&input, 4);
        let made = |tried: [Place; 4], blocked: [bool; 4], places: [Place; 4]| Move {
            is_backtrack: false,
            tried: tried.to_vec(),
            blocked: blocked.to_vec(),
            places: places.to_vec(),
        };
        let (nowhere, east) = ((0, 0), (1, 0));
        let out = made([nowhere, nowhere, nowhere, east], [false; 4], [(3, 3), (3, 3), (3, 3), (4, 3)]);
        assert!(!court.open.contains(&((3, 3), (4, 3))));
        assert_eq!(court.hear(&out), Ok(()));
        assert_eq!(court.open, BTreeSet::from([((3, 3), (4, 3))]));
        court.places = vec![(3, 3), (3, 3), (4, 3), (5, 3)];
        // The robot behind may leave E_C of where the leader is if the leader is sure to come.
        let is_left = |court: &Court<'_>, step: Place, behind| court.admits_pair(3, step, behind).is_err();
        court.open.insert(((4, 3), (5, 3)));
        assert!(!is_left(&court, (-1, 0), (3, 4)));
        court.open.clear();
        assert!(is_left(&court, (-1, 0), (3, 4)) && !is_left(&court, (-1, 0), (4, 4)));
        assert!(!is_left(&court, nowhere, (4, 4)));
    }
}
