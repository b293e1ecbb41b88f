//! Two robots among frontier cells, as a local rule: FRONTIER-2 for every number of robots, every area and every order
//! of events, by what the kernel's robots do.

use tautline_kernel::frontier::{Condition, Robot as Explorer, Rule, Sight, Stance, TinyMap};
use tautline_kernel::ground::{Area, Cell, Side, Step};

use super::world::Rim;
use crate::local::{Act, Far, Local, Plan, Robot, in_a_row};

/// Robots of which no two are to be in one cell.
#[derive(Clone, Copy, Debug)]
pub struct Alone {
    /// Their rule.
    pub rule: Rule,
    /// Whether a robot in a cell counts as one that is in another cell or enters it, by its stance.
    pub is_met: fn(Cell, Cell, Stance) -> bool,
    /// Whether several robots may act at once.
    pub at_once: bool,
}

impl Alone {
    /// Robots that act one at a time by this rule.
    pub const fn of(rule: Rule) -> Self {
        Self { rule, is_met: |cell, at, stance| Rim::Counts.is_met(cell, at, stance), at_once: false }
    }

    /// The cell in which robots are looked at, and the one round it.
    const HERE: Cell = Cell::new(1, 1);

    /// The kernel's robot with this stance.
    fn explorer(&self, stance: Stance) -> Option<Explorer<TinyMap>> {
        let map = TinyMap::new(Area::new(Cell::new(0, 0), Cell::new(2, 2))?)?;
        let mut robot = Explorer::new(map, Self::HERE, &[]);
        if let Stance::Tries(side) | Stance::Enters(side) = stance {
            robot.tries(side, Self::HERE.beyond(side));
        }
        if let Stance::Enters(_) = stance {
            robot.looked(&self.rule, Sight::Open);
        }
        Some(robot)
    }
}

/// The act of a robot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ExplorerAct {
    /// It goes to the rim of its cell at a side.
    Tries(Side),
    /// It looks into the cell beyond the rim.
    Looks(Sight),
    /// It arrives in that cell.
    Arrives,
    /// It does nothing.
    Idles,
}

impl Local for Alone {
    type State = Stance;
    type Act = ExplorerAct;

    fn states(&self) -> Vec<Stance> {
        let sides = Side::ALL.into_iter();
        let under_way = sides.flat_map(|side| [Stance::Tries(side), Stance::Enters(side)]);
        under_way.chain([Stance::Stands]).collect()
    }

    fn acts(&self, stance: Stance) -> Vec<Act<Stance, ExplorerAct>> {
        let after = |act: &dyn Fn(&mut Explorer<TinyMap>)| {
            let mut robot = self.explorer(stance)?;
            act(&mut robot);
            Some(robot.stance())
        };
        // What a robot cannot do is none of its acts.
        let act = |act, step, state: Option<Stance>| {
            let ends = vec![(step != Step::Stay, state?)];
            Some(Act { act, step, ends, needs_open: false })
        };
        let own = match stance {
            Stance::Stands => Side::ALL
                .map(|side| {
                    let tries = after(&|robot| robot.tries(side, Self::HERE.beyond(side)));
                    act(ExplorerAct::Tries(side), Step::Stay, tries)
                })
                .to_vec(),
            // A small obstacle leaves a robot in its cell as another robot does.
            Stance::Tries(_) => [Sight::Open, Sight::Obstacle, Sight::Robot]
                .map(|sight| {
                    act(
                        ExplorerAct::Looks(sight),
                        Step::Stay,
                        after(&|robot| robot.looked(&self.rule, sight)),
                    )
                })
                .to_vec(),
            Stance::Enters(side) => {
                let arrives = after(&|robot| robot.arrived(&self.rule, Self::HERE.beyond(side)));
                vec![act(ExplorerAct::Arrives, Step::Cross(side), arrives)]
            }
        };
        own.into_iter().chain([act(ExplorerAct::Idles, Step::Stay, Some(stance))]).flatten().collect()
    }

    /// A robot that looks sees another one that is in the cell, or counts as entering it, if its rule lets it look.
    fn admits(&self, plans: &[Plan<Stance, ExplorerAct>]) -> bool {
        let sees = |own: &Plan<Stance, ExplorerAct>, other: &Robot<Stance>| match (own.act, own.robot.state) {
            (ExplorerAct::Looks(Sight::Open | Sight::Obstacle), Stance::Tries(side)) => {
                !self.rule.has(Condition::Look)
                    || !(self.is_met)(own.robot.at.beyond(side), other.at, other.state)
            }
            _ => true,
        };
        (self.at_once || plans.iter().any(|plan| plan.act == ExplorerAct::Idles))
            && sees(&plans[0], &plans[1].robot)
            && sees(&plans[1], &plans[0].robot)
    }

    fn keeps(&self, robots: &[Robot<Stance>]) -> bool {
        robots[0].at != robots[1].at
    }

    fn reach(&self) -> (i16, Far) {
        (0, Far::Fine)
    }

    fn may_start(&self, robots: &[Robot<Stance>]) -> bool {
        robots[0].at != robots[1].at && robots.iter().all(|robot| robot.state == Stance::Stands)
    }

    fn start(&self, robots: usize) -> Vec<Robot<Stance>> {
        in_a_row(robots, Stance::Stands)
    }

    /// A robot has looked before it enters.
    fn is_sure(&self, act: ExplorerAct) -> bool {
        act == ExplorerAct::Arrives
    }
}
