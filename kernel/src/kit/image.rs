//! A team as it looks turned, in a mirror, or with other numbers on its robots. Two robots do alike in all images of a lattice:
//! whoever looks at one of them has looked at all.

use super::rule::Runs;
use super::stance::Stance;
use super::team::{Kit, Robot, Task};
use crate::ground::{Cell, Edge, EdgeMark, Grid, Side, Step, Steps};

/// Every mark of an edge.
const MARKS: [EdgeMark; 3] = [EdgeMark::Wall, EdgeMark::Open, EdgeMark::Virtual];

impl<G: Grid + Copy, const ROBOTS: usize, const NODES: usize> Kit<G, ROBOTS, NODES> {
    /// This team without what no robot asks for any more: where it went last, if it runs KIT at every node, and whether the path
    /// was new at the end of which it stands.
    #[must_use]
    pub fn settled(mut self) -> Self {
        for robot in &mut self.robots {
            robot.is_new &= !robot.stance.stands();
            if self.rule.runs == Runs::Every {
                robot.heading = None;
            }
        }
        self
    }

    /// The image of this team in which each node is where `to` takes it, and the robot `order[n]` has the number n. `to` takes
    /// neighbours to neighbours, and the area of the team's map to that of `blank`, an empty map. Robots that have not entered
    /// keep their numbers.
    #[must_use]
    pub fn image(&self, blank: G, to: impl Fn(Cell) -> Cell, order: [usize; ROBOTS]) -> Self {
        let map = |map: &G| {
            let mut image = blank;
            for edge in map.area().edges() {
                for mark in MARKS.into_iter().filter(|&mark| map.edge_has(mark, edge)) {
                    if let Some(edge) = edge_to(&to, edge) {
                        image.put_edge(mark, edge);
                    }
                }
            }
            image
        };
        let old = |number: usize| order.get(number).copied().filter(|&old| old < ROBOTS).unwrap_or(number);
        let records = core::array::from_fn(|number| map(&self.records[old(number)]));
        let turn = (0..ROBOTS).find(|&number| old(number) == usize::from(self.turn));
        Self {
            rule: self.rule,
            records,
            union: map(&self.union),
            robots: core::array::from_fn(|number| image_of(&self.robots[old(number)], &to)),
            entered: self.entered,
            turn: turn.map_or(self.turn, |turn| turn as u8),
        }
    }
}

/// Where an edge is taken.
fn edge_to(to: impl Fn(Cell) -> Cell, edge: Edge) -> Option<Edge> {
    let node = edge.cell();
    Some(Edge::new(to(node), side_to(&to, node, edge.side())?))
}

/// Where a side of a node is taken.
fn side_to(to: impl Fn(Cell) -> Cell, node: Cell, side: Side) -> Option<Side> {
    let (here, beyond) = (to(node), to(node.beyond(side)));
    Side::ALL.into_iter().find(|&side| here.beyond(side) == beyond)
}

fn image_of(robot: &Robot, to: impl Fn(Cell) -> Cell) -> Robot {
    let at = robot.stance.to();
    let stance = match robot.stance {
        Stance::Stands(at) => Stance::Stands(to(at)),
        Stance::Drives { from, to: next } => Stance::Drives { from: to(from), to: to(next) },
    };
    let side_of = |side: Side| side_to(&to, at, side).unwrap_or(side);
    let step_of = |step: Step| match step {
        Step::Cross(side) => Step::Cross(side_of(side)),
        Step::Stay => Step::Stay,
    };
    let task = match robot.task {
        Task::Looks { side, left, why } => {
            let left = left.iter().fold(Steps::NONE, |steps, step| steps.with(step_of(step)));
            Task::Looks { side: side_of(side), left, why }
        }
        task @ (Task::None | Task::Stays | Task::Done) => task,
    };
    Robot { stance, task, heading: robot.heading.map(side_of), is_new: robot.is_new }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choice::Oracle;
    use crate::ground::{Area, TinyGrid};
    use crate::kit::{Next, Rule, Sight};

    /// Answers 0.
    struct First;

    impl Oracle for First {
        fn pick(&mut self, _: u32) -> u32 {
            0
        }
    }

    #[test]
    fn an_image_has_its_drives_and_walls_where_they_are_taken() {
        let area = |width, height| {
            let area = Area::new(Cell::new(0, 0), Cell::new(width - 1_i16, height - 1_i16)).expect("an area");
            TinyGrid::new(area).expect("a small map")
        };
        let starts = [Cell::new(0, 0), Cell::new(2, 0)];
        let mut team = Kit::<_, 2, 64>::new(Rule::REPAIRED, area(3, 2), starts).expect("a team");
        assert_eq!(team.decide(0, &mut First), Ok(Next::Looks(Side::East)));
        assert_eq!(team.looked(0, Sight::Obstacle, &mut First), Ok(Next::Looks(Side::South)));
        assert_eq!(team.looked(0, Sight::Free, &mut First), Ok(Next::Drives(Cell::new(0, 1))));
        let turned = |node: Cell| Cell::new(1 - node.y, node.x);
        let image = team.image(area(2, 3), turned, [1, 0]);
        assert_eq!(image.stance(0), Some(Stance::Stands(Cell::new(1, 2))));
        assert_eq!(image.stance(1), Some(Stance::Drives { from: Cell::new(1, 0), to: Cell::new(0, 0) }));
        assert_eq!(image.turn(), Some(0), "the second one has the turn, and is the first now");
        assert!(image.known(EdgeMark::Wall, Cell::new(1, 0)).has(Step::Cross(Side::South)));
        assert!(image.known(EdgeMark::Open, Cell::new(1, 0)).has(Step::Cross(Side::West)));
        let back = |node: Cell| Cell::new(node.y, 1 - node.x);
        assert_eq!(image.image(area(3, 2), back, [1, 0]), team);
        // There is no third robot to take the second one's place: it keeps it.
        assert_eq!(image.image(area(3, 2), back, [1, 2]), image.image(area(3, 2), back, [1, 1]));
    }
}
