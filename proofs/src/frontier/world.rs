//! A team in a small area whose obstacles are decided as they are met: which robot acts next, which cell is blocked,
//! which message is lost, which fix is wrong, and which robot dies, are choices. What the clauses demand is in plain
//! arithmetic here; of the kernel's rule only what robots do is used.
//!
//! A robot decides by its own repository and by what the others have told it. A message says what its sender knows,
//! where it takes itself to be, and which cell it has claimed; a robot that misses a message knows none of the three.
//!
//! A move has three steps: a robot goes to the rim of its cell, looks, and arrives. Time is in slots, which count only
//! while a robot waits for its own. A robot that is under way when a slot begins arrives before that slot is over, and
//! a robot that has waited for its slot has made its move, or met another one again, before it is over.

mod demand;
mod merging;
mod rim;

use tautline_kernel::choice::Oracle;
use tautline_kernel::frontier::{
    Condition, Map, Next, Other, Place, Robot, Rule, Sight, Slot, Stance, Status, TinyMap, View,
};
use tautline_kernel::ground::{Area, Cell, Side};

pub use self::demand::Demand;
pub use self::rim::Rim;
use super::has_more;
use crate::engine::{Tape, outcomes};

/// The area and what goes on there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Setting<const ROBOTS: usize> {
    /// The rule of every robot.
    pub rule: Rule,
    /// The cells: at most 64.
    pub area: Area,
    /// Most obstacles that are met in one run.
    pub max_obstacles: u8,
    /// Most messages that are lost in one run.
    pub max_losses: u8,
    /// Most fixes in one run that are off by one cell.
    pub max_wrong: u8,
    /// Most looks in one run that meet an obstacle smaller than a cell. Such an obstacle stands nowhere for good: a
    /// robot that comes again may meet another one.
    pub max_small: u8,
    /// Most robots that die in one run.
    pub max_deaths: u8,
    /// The one demand that is looked at; all if there is none.
    pub demand: Option<Demand>,
    /// The obstacles, where they are given: then none is left to choose.
    pub given: Option<TinyMap>,
}

/// A team and what is decided of its area.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct World<const ROBOTS: usize> {
    robots: [Robot<TinyMap>; ROBOTS],
    /// Where the robots really are.
    cells: [Cell; ROBOTS],
    /// By robot: what each other one has told it last, if its rule asks for that.
    told: [[Option<Other>; ROBOTS]; ROBOTS],
    /// The cells entered, and the obstacles that were met.
    truth: TinyMap,
    /// By robot: whether it is on its way to its frontier cell.
    heading: [bool; ROBOTS],
    lost: u8,
    wrong: u8,
    small: u8,
    /// The robots that have died, a bit for each.
    dead: u8,
    slot: u8,
    /// Robots that were under way when the slot began, a bit for each.
    old: u8,
    /// Whether the one whose slot it is has met another one in it.
    has_tried: bool,
}

/// An event.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Event {
    /// A robot goes to the rim of its cell on its way to a cell, which it claims; the robots that miss that have a bit
    /// each.
    Decides(usize, Side, Cell, u8),
    /// A robot looks beyond the rim. The robots that miss what it says have a bit each; and the slot that it is when it
    /// begins to wait.
    Looks(usize, Side, Sight, u8, u8),
    /// A robot looks beyond the rim, into an explored cell that it took for unexplored, and turns back.
    Returns(usize, Side),
    /// A robot arrives, takes itself to be in this cell, and tells; the robots that miss it have a bit each.
    Arrives(usize, Cell, u8),
    /// A slot is over.
    Ticks,
    /// A robot dies, and stands where it is.
    Dies(usize),
}

/// A step, with what happens in it.
#[derive(Clone, Debug)]
pub struct Successor<const ROBOTS: usize> {
    /// The world after the turn.
    pub world: World<ROBOTS>,
    /// The event.
    pub event: Event,
    /// The demands that it breaks.
    pub breaks: Vec<Demand>,
}

impl<const ROBOTS: usize> World<ROBOTS> {
    /// The cell in which each robot is, or which it is entering.
    pub fn cells(&self) -> [Cell; ROBOTS] {
        std::array::from_fn(|robot| self.entering(robot).unwrap_or(self.cells[robot]))
    }

    /// The cells entered, and the obstacles that were met.
    pub const fn truth(&self) -> &TinyMap {
        &self.truth
    }

    /// The robots, with all that each knows.
    pub const fn robots(&self) -> &[Robot<TinyMap>; ROBOTS] {
        &self.robots
    }

    /// The news that `robot` has of the others, in the order of their turns after its own: the same order, whichever of
    /// them is the first.
    fn told_in_turn(&self, robot: usize) -> impl Iterator<Item = Other> {
        (1..ROBOTS).filter_map(move |later| self.told[robot][(robot + later) % ROBOTS])
    }

    /// The cell that a robot is entering.
    fn entering(&self, robot: usize) -> Option<Cell> {
        match self.robots[robot].stance() {
            Stance::Enters(side) => Some(self.cells[robot].beyond(side)),
            Stance::Stands | Stance::Tries(_) => None,
        }
    }

    /// The other robots that are in `cell` or entering it, a bit for each; those at its rim among them, if they are
    /// asked for.
    fn inside(&self, robot: usize, cell: Cell, rim: Rim) -> u8 {
        let is_there =
            |other: usize| other != robot && rim.is_met(cell, self.cells[other], self.robots[other].stance());
        (0..ROBOTS).filter(|&other| is_there(other)).fold(0, |set, other| set | 1 << other)
    }

    /// The robots that live.
    fn living(&self) -> impl Iterator<Item = usize> + use<ROBOTS> {
        let dead = self.dead;
        (0..ROBOTS).filter(move |robot| dead >> robot & 1 == 0)
    }

    /// The living robots that are under way, a bit for each.
    fn moving(&self) -> u8 {
        let moves = |robot: &usize| self.robots[*robot].stance() != Stance::Stands;
        self.living().filter(moves).fold(0, |set, robot| set | 1 << robot)
    }
}

impl<const ROBOTS: usize> Setting<ROBOTS> {
    /// Every start: the robots in different cells. They take their turns in the order of their numbers, round and
    /// round, so that the first may be the one in the first of the cells.
    pub fn starts(&self) -> Vec<World<ROBOTS>> {
        let cells: Vec<Cell> = self.area.cells().filter(|&cell| !self.is_given(cell)).collect();
        let of = cells.len();
        let all = (0..of.pow(ROBOTS as u32)).filter_map(|start| {
            let places: [usize; ROBOTS] = std::array::from_fn(|robot| start / of.pow(robot as u32) % of);
            let are_apart = (1..ROBOTS).all(|robot| !places[..robot].contains(&places[robot]));
            let is_first = places.iter().all(|&place| places[0] <= place);
            (are_apart && is_first).then(|| self.start(places.map(|place| cells[place]))).flatten()
        });
        all.collect()
    }

    /// The start with the robots in these cells; `None` if the area is too large.
    pub fn start(&self, cells: [Cell; ROBOTS]) -> Option<World<ROBOTS>> {
        let map = TinyMap::new(self.area)?;
        let mut truth = map;
        for cell in cells {
            truth.learn(cell, Status::Explored);
        }
        let robots = cells.map(|cell| Robot::new(map, cell, &cells));
        let told = std::array::from_fn(|to| {
            std::array::from_fn(|from| (from != to && self.asks()).then(|| says(&robots[from])))
        });
        Some(World {
            robots,
            cells,
            told,
            truth,
            heading: [false; ROBOTS],
            lost: 0,
            wrong: 0,
            small: 0,
            dead: 0,
            slot: 0,
            old: 0,
            has_tried: false,
        })
    }

    /// Whether what the others have told of themselves plays a part in a decision.
    const fn asks(&self) -> bool {
        self.rule.has(Condition::Nearer) || !self.rule.has(Condition::Route)
    }

    /// Whether robots that see each other take each other for obstacles, and wait for nobody.
    const fn are_obstacles(&self) -> bool {
        !self.rule.has(Condition::Tell) && !self.rule.has(Condition::Turn)
    }

    /// Whether an obstacle is given there.
    fn is_given(&self, cell: Cell) -> bool {
        self.given.is_some_and(|given| given.status(cell) == Status::Obstacle)
    }

    fn is_wanted(&self, demand: Demand) -> bool {
        self.demand.is_none_or(|wanted| wanted == demand)
    }

    /// The next action of `robot`, if it stands.
    fn next(&self, world: &World<ROBOTS>, robot: usize, slot: Slot, oracle: &mut dyn Oracle) -> Next {
        let (mut others, mut told) = ([says(&world.robots[robot]); ROBOTS], 0);
        for other in world.told_in_turn(robot) {
            (others[told], told) = (other, told + 1);
        }
        let view = View { others: &others[..told], slot };
        super::next::<ROBOTS>(&world.robots[robot], &self.rule, view, oracle)
    }

    /// The next action of `robot` if the slot were its own.
    fn would(&self, world: &World<ROBOTS>, robot: usize) -> Next {
        self.next(world, robot, Slot::Own, &mut Tape(&[]))
    }

    /// Whether `robot` waits for its slot.
    fn waits(&self, world: &World<ROBOTS>, robot: usize) -> bool {
        let tries = |next| matches!(next, Next::Tries { .. });
        if !world.robots[robot].waits() {
            return false;
        }
        if !self.rule.has(Condition::Route) || !self.rule.has(Condition::Lapse) {
            return tries(self.would(world, robot));
        }
        // What the others have told decides where it would go, and not whether.
        let alone = View { others: &[], slot: Slot::Own };
        let does_try = tries(super::next::<ROBOTS>(&world.robots[robot], &self.rule, alone, &mut Tape(&[])));
        debug_assert_eq!(
            does_try,
            tries(self.would(world, robot)),
            "it is not the others who keep it from trying"
        );
        does_try
    }

    fn does_any_wait(&self, world: &World<ROBOTS>) -> bool {
        (0..ROBOTS).any(|robot| self.waits(world, robot))
    }

    /// Whether a slot may be over.
    fn ticks(&self, world: &World<ROBOTS>) -> bool {
        let owner = usize::from(world.slot);
        world.moving() & (world.old | 1 << owner) == 0
            && (world.has_tried || !self.waits(world, owner))
            && self.does_any_wait(world)
    }

    /// Each side and cell for which `robot` may decide now; none unless it can go somewhere.
    fn ways(&self, world: &World<ROBOTS>, robot: usize) -> impl Iterator<Item = (Side, Cell)> {
        let is_own = usize::from(world.slot) == robot && !world.has_tried;
        let slot = if is_own { Slot::Own } else { Slot::Others };
        outcomes(move |oracle| match self.next(world, robot, slot, oracle) {
            Next::Tries { side, aim } => Some((side, aim)),
            Next::Waits | Next::Stops | Next::Done => None,
        })
    }

    /// Whether `robot` may decide now.
    fn may_decide(&self, world: &World<ROBOTS>, robot: usize) -> bool {
        world.robots[robot].stance() == Stance::Stands && self.ways(world, robot).next().is_some()
    }

    /// Every step from `world`.
    pub fn turns(&self, world: &World<ROBOTS>) -> Vec<Successor<ROBOTS>> {
        let mut turns: Vec<Successor<ROBOTS>> = Vec::new();
        for robot in world.living() {
            match world.robots[robot].stance() {
                Stance::Stands => {
                    for way in self.ways(world, robot) {
                        turns.extend(outcomes(|oracle| Some(self.decide(world, robot, way, oracle))));
                    }
                }
                Stance::Tries(side) => {
                    turns.extend(outcomes(|oracle| Some(self.look(world, (robot, side), oracle))));
                }
                Stance::Enters(side) => {
                    turns.extend(outcomes(|oracle| Some(self.arrive(world, (robot, side), oracle))));
                }
            }
        }
        if self.ticks(world) {
            let slot = (world.slot + 1) % ROBOTS as u8;
            let after = World { slot, old: world.moving(), has_tried: false, ..*world };
            turns.push(Successor { world: after, event: Event::Ticks, breaks: Vec::new() });
        }
        if world.dead.count_ones() < self.max_deaths.into() {
            turns.extend(world.living().map(|robot| self.die(world, robot)));
        }
        turns
    }

    /// The death of a robot. What it knew plays no part any more. Its body is in its cell, and in the one that it was
    /// going to, since others meet it in both.
    fn die(&self, world: &World<ROBOTS>, robot: usize) -> Successor<ROBOTS> {
        let mut after = *world;
        after.dead |= 1 << robot;
        (after.heading[robot], after.told[robot]) = (false, [None; ROBOTS]);
        let (at, bare) = (world.cells[robot], self.bare(world, robot));
        let (mut body, mut to) = (Robot::new(bare.map, bare.at(), &[]), at);
        if let Stance::Tries(side) | Stance::Enters(side) = bare.stance() {
            to = at.beyond(side);
            body.tries(side, at);
        }
        if matches!(bare.stance(), Stance::Enters(_)) {
            body.looked(&self.rule, Sight::Open);
        }
        after.robots[robot] = body;
        for cell in [at, to].into_iter().filter(|&cell| world.truth.status(cell) != Status::Obstacle) {
            after.truth.learn(cell, Status::Body);
        }
        let mut breaks = Vec::new();
        self.settle(&mut after, &mut breaks);
        Successor { world: after, event: Event::Dies(robot), breaks }
    }

    fn decide(
        &self,
        world: &World<ROBOTS>,
        robot: usize,
        (side, aim): (Side, Cell),
        oracle: &mut dyn Oracle,
    ) -> Successor<ROBOTS> {
        let mut after = *world;
        let others: Vec<Other> = world.told_in_turn(robot).collect();
        let known = &world.robots[robot];
        after.heading[robot] = known.map.status(known.at().beyond(side)) == Status::Unexplored;
        after.robots[robot].decided(&self.rule, &others);
        after.robots[robot].tries(side, aim);
        let missed = if self.rule.has(Condition::Claim) {
            self.tell(&mut after, robot, (aim, Status::Unexplored), u8::MAX, oracle)
        } else {
            0
        };
        Successor { world: after, event: Event::Decides(robot, side, aim, missed), breaks: Vec::new() }
    }

    fn look(
        &self,
        world: &World<ROBOTS>,
        (robot, side): (usize, Side),
        oracle: &mut dyn Oracle,
    ) -> Successor<ROBOTS> {
        let mut after = *world;
        let cell = world.cells[robot].beyond(side);
        // One at the rim of its cell is an obstacle in that cell alone.
        let rim = if self.are_obstacles() { Rim::No } else { Rim::Counts };
        let met = if self.rule.has(Condition::Look) { world.inside(robot, cell, rim) } else { 0 };
        let sight = match met {
            _ if world.small < self.max_small && oracle.mishap() => Sight::Small,
            0 if self.is_obstacle(&mut after, cell, oracle) => Sight::Obstacle,
            0 => Sight::Open,
            _ if met & !world.dead == 0 && self.rule.has(Condition::Bypass) => Sight::Silent,
            _ => Sight::Robot,
        };
        after.robots[robot].looked(&self.rule, sight);
        after.small += u8::from(sight == Sight::Small);
        after.heading[robot] = false;
        let returns = sight == Sight::Open && after.robots[robot].stance() == Stance::Stands;
        let mut breaks = Vec::new();
        let mut missed = 0;
        match sight {
            Sight::Open if returns => {}
            Sight::Open => {
                let is_entered = world.truth.status(cell) == Status::Explored;
                if self.is_wanted(Demand::Once) && world.heading[robot] && is_entered {
                    breaks.push(Demand::Once);
                }
                if self.is_wanted(Demand::Alone) && world.inside(robot, cell, Rim::No) != 0 {
                    breaks.push(Demand::Alone);
                }
                after.truth.learn(cell, Status::Explored);
            }
            Sight::Small if self.rule.has(Condition::Detour) => {}
            Sight::Robot if !self.are_obstacles() => {
                // Nothing is known of the cell, but that the robot has claimed none any more.
                missed = self.tell(&mut after, robot, (cell, Status::Unexplored), u8::MAX, oracle);
                if self.rule.has(Condition::Share) {
                    for other in world.living().filter(|other| met >> other & 1 == 1) {
                        let to = 1 << robot;
                        missed |= self.tell(&mut after, other, (cell, Status::Unexplored), to, oracle);
                    }
                }
                let waited = self.does_any_wait(world);
                if after.robots[robot].waits() && !waited {
                    after.slot = oracle.pick(ROBOTS as u32) as u8;
                    after.has_tried = usize::from(after.slot) == robot;
                } else {
                    after.has_tried |= usize::from(world.slot) == robot;
                }
            }
            Sight::Obstacle | Sight::Small | Sight::Robot | Sight::Silent => {
                let known = world.robots[robot].at().beyond(side);
                let status = if sight == Sight::Silent { Status::Body } else { Status::Obstacle };
                missed = self.tell(&mut after, robot, (known, status), u8::MAX, oracle);
            }
        }
        self.settle(&mut after, &mut breaks);
        let event = if returns {
            Event::Returns(robot, side)
        } else {
            Event::Looks(robot, side, sight, missed, after.slot)
        };
        Successor { world: after, event, breaks }
    }

    /// Whether there is an obstacle in `cell`, outside which there is nothing else.
    fn is_obstacle(&self, world: &mut World<ROBOTS>, cell: Cell, oracle: &mut dyn Oracle) -> bool {
        if world.truth.status(cell) == Status::Unexplored {
            let is_blocked = match self.given {
                Some(_) => self.is_given(cell),
                None => world.truth.obstacles() < self.max_obstacles.into() && oracle.mishap(),
            };
            if is_blocked {
                world.truth.learn(cell, Status::Obstacle);
            }
            return is_blocked;
        }
        world.truth.status(cell) == Status::Obstacle
    }

    fn arrive(
        &self,
        world: &World<ROBOTS>,
        (robot, side): (usize, Side),
        oracle: &mut dyn Oracle,
    ) -> Successor<ROBOTS> {
        let mut after = *world;
        let cell = world.cells[robot].beyond(side);
        after.cells[robot] = cell;
        let mut fix = cell;
        if after.wrong < self.max_wrong && oracle.mishap() {
            let beside = Side::ALL.map(|side| cell.beyond(side));
            let inside = beside.iter().filter(|&&cell| self.area.contains(cell));
            let number = oracle.pick(inside.clone().count() as u32) as usize;
            fix = inside.copied().nth(number).unwrap_or(cell);
            after.wrong += 1;
        }
        after.robots[robot].arrived(&self.rule, fix);
        let at = after.robots[robot].at();
        let missed = self.tell(&mut after, robot, (at, Status::Explored), u8::MAX, oracle);
        let mut breaks = Vec::new();
        self.settle(&mut after, &mut breaks);
        Successor { world: after, event: Event::Arrives(robot, fix, missed), breaks }
    }

    /// `from` tells the robots in `to` where it is, what it has claimed, and what is new, or all that it knows. Those
    /// that miss it have a bit each.
    fn tell(
        &self,
        world: &mut World<ROBOTS>,
        from: usize,
        (cell, status): (Cell, Status),
        to: u8,
        oracle: &mut dyn Oracle,
    ) -> u8 {
        let (map, said) = (world.robots[from].map, says(&world.robots[from]));
        let mut missed = 0;
        for other in world.living().filter(|&other| other != from && to >> other & 1 == 1) {
            if world.lost < self.max_losses && oracle.mishap() {
                world.lost += 1;
                missed |= 1 << other;
                continue;
            }
            world.told[other][from] = self.asks().then_some(said);
            if self.rule.has(Condition::Share) {
                world.robots[other].hears_all(&map);
            } else {
                world.robots[other].hears(cell, status);
            }
        }
        missed
    }

    /// Notes what wrong marks break, and makes states one that differ only in slots that nobody waits for.
    fn settle(&self, world: &mut World<ROBOTS>, breaks: &mut Vec<Demand>) {
        let is_right = |robot: &Robot<TinyMap>| robot.map.is_within(&world.truth);
        if self.is_wanted(Demand::Marks) && !world.robots.iter().all(is_right) {
            breaks.push(Demand::Marks);
        }
        let first = (0, 0, false);
        if (world.slot, world.old, world.has_tried) != first && !self.does_any_wait(world) {
            (world.slot, world.old, world.has_tried) = first;
        }
    }

    /// Whether a robot that lives could get to a cell that is neither entered nor known to be blocked.
    fn is_owed(&self, world: &World<ROBOTS>) -> bool {
        let mut truth = world.truth;
        self.area
            .cells()
            .filter(|&cell| self.is_given(cell))
            .for_each(|cell| truth.learn(cell, Status::Obstacle));
        world.living().any(|robot| has_more(&truth, world.cells[robot]))
    }
}

/// The message that a robot sends of itself.
fn says(robot: &Robot<TinyMap>) -> Other {
    Other { cell: robot.at(), place: Place::midpoint(robot.at()), aim: robot.aim() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frontier::areas::setting;

    #[test]
    fn a_robot_that_wanders_may_leave_a_cell_out_for_ever() {
        let setting = Setting { max_obstacles: 0, ..setting::<1>(Rule::WANDERS, (4, 1)).expect("4 cells") };
        let mut world = setting.start([Cell::new(2, 0)]).expect("4 cells");
        let mut goes = |side| {
            let is_other = |event| matches!(event, Event::Decides(_, decided, ..) if decided != side);
            for _ in 0..3 {
                let mut turns = setting.turns(&world).into_iter();
                world = turns.find(|turned| !is_other(turned.event)).expect("a turn").world;
            }
            world
        };
        goes(Side::West);
        let before = goes(Side::West);
        goes(Side::East);
        assert_eq!(goes(Side::West), before, "it goes to and fro");
        assert_eq!(before.truth.status(Cell::new(3, 0)), Status::Unexplored);
    }
}
