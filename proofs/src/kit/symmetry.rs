//! Images of a lattice: turned, in a mirror, and with other numbers on two robots. A rule does alike in all of them
//! (`two_robots_do_alike_in_every_image`), so that of all images of a team one is searched.

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Edge, EdgeMark, Grid, Side, TinyGrid};
use tautline_kernel::kit::{Condition, Robot, Runs, Stance};

use super::world::{Demand, Part, SITUATIONS, Setting, Speeds, Successor, Team, World};
use crate::engine::states::{Bits, Places, System};
use crate::engine::world::{self, Turn};

/// A way to turn or mirror an area, so that it covers itself.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Image {
    /// Whether columns become rows.
    transposes: bool,
    /// Whether columns, and whether rows, are counted from the other end then.
    flips: [bool; 2],
    /// Where each edge is taken, by its number.
    edges: Vec<u8>,
}

impl Image {
    /// Every image of an area whose first node is 0,0, the area itself first.
    pub(super) fn all(area: Area) -> Vec<Self> {
        let edges: Vec<Edge> = area.edges().collect();
        let is_square = area.width() == area.height();
        let ways = [false, true].into_iter().take(if is_square { 2 } else { 1 }).flat_map(|transposes| {
            [[false, false], [true, false], [false, true], [true, true]].map(|flips| (transposes, flips))
        });
        let image = |(transposes, flips)| {
            let mut image = Self { transposes, flips, edges: Vec::new() };
            let taken = edges.iter().map(|edge| {
                let [one, other] = [edge.cell(), edge.cell().beyond(edge.side())];
                let ends = [one, other].map(|node| image.node(area, node));
                let is_image = |edge: &Edge| {
                    let (one, other) = (edge.cell(), edge.cell().beyond(edge.side()));
                    ends == [one, other] || ends == [other, one]
                };
                edges.iter().position(is_image).unwrap_or_default() as u8
            });
            image.edges = taken.collect();
            image
        };
        ways.map(image).collect()
    }

    /// Where a node is taken.
    pub(super) fn node(&self, area: Area, node: Cell) -> Cell {
        let last = area.last();
        let (x, y) = if self.transposes { (node.y, node.x) } else { (node.x, node.y) };
        let [flips_columns, flips_rows] = self.flips;
        Cell::new(if flips_columns { last.x - x } else { x }, if flips_rows { last.y - y } else { y })
    }

    /// Where a robot is taken that does not look at a side.
    fn robot(&self, area: Area, mut robot: Robot) -> Robot {
        let node = |node| self.node(area, node);
        let at = robot.stance.to();
        robot.stance = match robot.stance {
            Stance::Stands(at) => Stance::Stands(node(at)),
            Stance::Drives { from, to } => Stance::Drives { from: node(from), to: node(to) },
        };
        let side = |side| {
            let beyond = node(at.beyond(side));
            Side::ALL.into_iter().find(|&side| node(at).beyond(side) == beyond)
        };
        robot.heading = robot.heading.and_then(side);
        robot
    }

    /// Where the edges of a set are taken.
    pub(super) fn set(&self, edges: u64) -> u64 {
        let mut rest = edges;
        let mut image = 0;
        while rest != 0 {
            image |= 1 << self.edges[rest.trailing_zeros() as usize];
            rest &= rest - 1;
        }
        image
    }
}

/// A team without what no robot asks for any more: where it went last, if it runs KIT at every node, and whether the
/// path was new at the end of which it stands.
pub(super) fn stripped<const ROBOTS: usize>(mut team: Team<ROBOTS>) -> Team<ROBOTS> {
    let runs = team.rule().runs;
    for robot in team.robots_mut() {
        robot.is_new &= !robot.stance.stands();
        robot.heading = robot.heading.filter(|_| runs != Runs::Every);
    }
    team
}

/// By what images of a state are compared: of each robot where it was, where it goes, whether it is done, whether it
/// may decide, and whether it drives a new path; and whose turn it is.
type Robots = ([(Cell, Cell, bool, bool, bool); 2], Option<usize>);

/// Edges that are walls, that are known to be free, and that were driven.
type Edges = [u64; 3];

/// A lattice with two robots of which one image of each state is searched. An endless run is one that goes round,
/// whoever acts in it, since an image may have other numbers on its robots.
#[derive(Clone, Debug)]
pub struct SymmetricLattice {
    setting: Setting<2>,
    edges: Vec<Edge>,
    images: Vec<Image>,
    /// In which orders the robots may be numbered.
    orders: &'static [[usize; 2]],
}

impl SymmetricLattice {
    /// This lattice, with all its images.
    pub fn new(setting: Setting<2>) -> Self {
        let area = setting.area;
        // Else the first robot enters before the second one.
        let are_alike = setting.rule.has(Condition::Turn) && setting.rule.has(Condition::Apart);
        let orders: &[[usize; 2]] = if are_alike { &[[0, 1], [1, 0]] } else { &[[0, 1]] };
        let (edges, images) = (area.edges().collect(), Image::all(area));
        Self { setting, edges, images, orders }
    }

    /// The image of a map.
    fn map(&self, map: &TinyGrid, image: &Image) -> TinyGrid {
        let mut taken = TinyGrid::new(self.setting.area).unwrap_or(*map);
        for (edge, &to) in self.edges.iter().zip(&image.edges) {
            for mark in [EdgeMark::Wall, EdgeMark::Open, EdgeMark::Virtual] {
                if map.edge_has(mark, *edge) {
                    taken.put_edge(mark, self.edges[usize::from(to)]);
                }
            }
        }
        taken
    }

    /// The image of a team, in which the robot `order[n]` has the number n.
    fn team(&self, team: &Team<2>, image: &Image, order: [usize; 2]) -> Team<2> {
        let mut taken = team.with_records(|robot| self.map(&team.records()[order[robot]], image));
        for (robot, old) in taken.robots_mut().iter_mut().zip(order) {
            *robot = image.robot(self.setting.area, team.robots()[old]);
        }
        if let Some(turn) = team.turn() {
            taken.crew.turn = u8::from(order[0] != turn);
        }
        taken
    }

    /// The image of a state.
    fn image(&self, world: &World<2>, image: &Image, order: [usize; 2]) -> World<2> {
        let (team, truth) = (self.team(&world.team, image, order), self.map(&world.truth, image));
        let swapped = |bits: u8| bits >> 1 & 1 | (bits & 1) << 1;
        let is_swapped = order == [1, 0];
        let fresh = if is_swapped { swapped(world.fresh) } else { world.fresh };
        let is_told = self.setting.speeds == Speeds::Equal;
        let first = if is_swapped && is_told { 1 - world.first } else { world.first };
        self.setting.settled(World { team, truth, walls: world.walls, fresh, first })
    }

    /// A state without what nobody asks for any more.
    fn stripped(&self, world: &World<2>) -> World<2> {
        let first = if self.setting.speeds == Speeds::Equal { world.first } else { 0 };
        World { team: stripped(world.team), first, ..*world }
    }

    fn robots(&self, world: &World<2>, image: &Image, order: [usize; 2]) -> Robots {
        let area = self.setting.area;
        let robot = |robot: usize| {
            let stance = world.team.stance(robot).unwrap_or(Stance::Stands(area.first()));
            let [from, to] = [stance.from(), stance.to()].map(|node| image.node(area, node));
            (from, to, world.team.is_done(robot), world.team.asks(robot), world.fresh >> robot & 1 == 1)
        };
        let turn = world.team.turn().and_then(|turn| order.iter().position(|&robot| robot == turn));
        (order.map(robot), turn)
    }

    fn edges(&self, world: &World<2>) -> Edges {
        let set = |map: &TinyGrid, mark| {
            let marked = self.edges.iter().enumerate().filter(|&(_, &edge)| map.edge_has(mark, edge));
            marked.fold(0, |set: u64, (number, _)| set | 1 << number)
        };
        let truth = &world.truth;
        let record = &world.team.records()[0];
        [set(truth, EdgeMark::Wall), set(truth, EdgeMark::Open), set(record, EdgeMark::Open)]
    }
}

impl world::World for SymmetricLattice {
    type State = World<2>;
    type Plan = Vec<Successor<2>>;
    type Event = usize;
    type Demand = Demand;

    fn plan(&self, state: &mut World<2>, log: &[u8]) -> Option<Vec<Successor<2>>> {
        self.setting.plan(state, log)
    }

    fn settle(
        &self,
        state: &mut World<2>,
        turns: &Vec<Successor<2>>,
        log: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> usize {
        self.setting.settle(state, turns, log, world)
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<Demand> {
        turn.plan[*turn.event].breaks.clone()
    }

    fn broken_at_end(&self, state: &World<2>, log: &[u8]) -> Vec<Demand> {
        self.setting.broken_at_end(state, log)
    }

    fn covers(&self) -> Vec<&'static str> {
        SITUATIONS.to_vec()
    }

    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        world::bit(&SITUATIONS, turn.plan[*turn.event].situation)
    }
}

impl System for SymmetricLattice {
    type Part = Part<2>;

    fn make_canonical(&self, state: &mut World<2>) {
        let world = self.stripped(state);
        let edges = self.edges(&world);
        let all = self.images.iter().flat_map(|image| self.orders.iter().map(move |&order| (image, order)));
        let mut least: Option<(Robots, Edges, &Image, [usize; 2])> = None;
        for (image, order) in all {
            let robots = self.robots(&world, image, order);
            if least.as_ref().is_some_and(|(known, ..)| *known < robots) {
                continue;
            }
            let edges = edges.map(|set| image.set(set));
            if least.as_ref().is_none_or(|least| (&robots, &edges) < (&least.0, &least.1)) {
                least = Some((robots, edges, image, order));
            }
        }
        *state = match least {
            Some((.., image, order)) if *image != self.images[0] || order != [0, 1] => {
                self.image(&world, image, order)
            }
            Some(_) | None => world,
        };
    }

    fn places(&self, state: &World<2>) -> usize {
        self.setting.places(state)
    }

    fn part(&self, state: &World<2>, place: usize) -> Part<2> {
        self.setting.part(state, place)
    }

    fn differing(&self, one: &World<2>, other: &World<2>) -> Places {
        self.setting.differing(one, other)
    }

    fn put(&self, state: &mut World<2>, place: usize, part: &Part<2>) {
        self.setting.put(state, place, part);
    }

    fn acting(&self, turn: &Turn<'_, Self>) -> Bits {
        1 << turn.plan[*turn.event].robot
    }

    fn broken_by_endless_runs(&self) -> Option<Demand> {
        self.setting.broken_by_endless_runs()
    }

    fn awake(&self, _: &World<2>) -> Bits {
        0
    }

    fn is_enough(&self, demand: Demand) -> bool {
        self.setting.is_enough(demand)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;
    use std::time::Instant;

    use tautline_kernel::ground as kernel;
    use tautline_kernel::kit::{Next, Reach, Rule, Sight};

    use super::super::counterexample::Counterexample;
    use super::super::world::Starts;
    use super::*;
    use crate::engine::states::{Findings, Limits, Run, search};
    use crate::engine::{SeededOracle, Tape};

    /// The events that can happen next, and where they lead, as it looks in this image.
    type Nexts = HashSet<(&'static str, Vec<&'static str>, World<2>)>;

    fn nexts(lattice: &SymmetricLattice, world: &World<2>, image: &Image, order: [usize; 2]) -> Nexts {
        let turns = lattice.setting.turns(world).into_iter();
        let next = turns.map(|turned| {
            let breaks = turned.breaks.iter().map(|demand| demand.words()).collect();
            let after = lattice.image(&lattice.stripped(&turned.world), image, order);
            (turned.situation, breaks, after)
        });
        next.collect()
    }

    /// Whether what can happen next is the same in every image, in the states of random runs of so many columns and
    /// rows.
    fn do_alike(rule: Rule, size: (i16, i16), orders: &'static [[usize; 2]]) -> bool {
        let setting = Setting::new(rule, size).expect("a lattice");
        let lattice = SymmetricLattice { orders, ..SymmetricLattice::new(setting) };
        let starts = setting.starts();
        let identity = &lattice.images[0];
        (0..4).all(|seed| {
            let mut dice = SeededOracle::new(seed, 16);
            let mut world = starts[dice.pick(starts.len() as u32) as usize];
            (0..40).all(|_| {
                let images =
                    lattice.images.iter().flat_map(|image| orders.iter().map(move |&order| (image, order)));
                let is_alike = images.into_iter().all(|(image, order)| {
                    let other = lattice.image(&lattice.stripped(&world), image, order);
                    nexts(&lattice, &world, image, order) == nexts(&lattice, &other, identity, [0, 1])
                });
                let turns = setting.turns(&world);
                if !turns.is_empty() {
                    world = turns[dice.pick(turns.len() as u32) as usize].world;
                }
                is_alike
            })
        })
    }

    #[test]
    fn an_image_has_its_drives_and_walls_where_they_are_taken() {
        let setting = Setting::new(Rule::REPAIRED, (3, 3)).expect("a lattice");
        let lattice = SymmetricLattice::new(setting);
        let mut team = setting.start([Cell::new(0, 0), Cell::new(2, 0)]).expect("a start").team;
        assert_eq!(team.decide(0, &mut Tape(&[])), Ok(Next::Looks(Side::East)));
        assert_eq!(team.looked(0, Sight::Obstacle, &mut Tape(&[])), Ok(Next::Looks(Side::South)));
        assert_eq!(team.looked(0, Sight::Free, &mut Tape(&[])), Ok(Next::Drives(Cell::new(0, 1))));
        let turned = |flips| {
            let is_turned = |image: &&Image| image.transposes && image.flips == flips;
            lattice.images.iter().find(is_turned).expect("a square")
        };
        let image = lattice.team(&team, turned([true, false]), [1, 0]);
        assert_eq!(image.stance(0), Some(Stance::Stands(Cell::new(2, 2))));
        assert_eq!(image.stance(1), Some(Stance::Drives { from: Cell::new(2, 0), to: Cell::new(1, 0) }));
        assert_eq!(image.turn(), Some(0), "the second one has the turn, and is the first now");
        assert!(image.known(EdgeMark::Wall, Cell::new(2, 0)).has(kernel::Step::Cross(Side::South)));
        assert!(image.known(EdgeMark::Open, Cell::new(2, 0)).has(kernel::Step::Cross(Side::West)));
        assert_eq!(lattice.team(&image, turned([false, true]), [1, 0]), team);
    }

    #[test]
    fn two_robots_do_alike_in_every_image() {
        const BOTH: &[[usize; 2]] = &[[0, 1], [1, 0]];
        for size in [(3, 3), (4, 2), (5, 1)] {
            assert!(do_alike(Rule::REPAIRED, size, BOTH), "{size:?}");
            assert!(do_alike(Rule::PUBLISHED, size, &BOTH[..1]), "{size:?}");
        }
        let near = Rule { reach: Reach::of_paths(2).expect("a reach"), ..Rule::REPAIRED };
        assert!(do_alike(near, (3, 3), BOTH));
        // As published the first robot enters before the second one.
        assert!(!do_alike(Rule::PUBLISHED, (3, 3), BOTH));
    }

    #[test]
    fn one_image_of_each_state_is_enough() {
        for size in [(3, 1), (2, 2), (4, 1)] {
            let setting = Setting::new(Rule::REPAIRED, size).expect("a lattice");
            let all = search(&setting, setting.starts(), Limits::NONE);
            let lattice = SymmetricLattice::new(setting);
            let one = search(&lattice, setting.starts(), Limits::NONE);
            assert!(one.is_whole && one.broken.is_empty() && one.states < all.states, "{size:?}");
            assert_eq!(one.covered, all.covered);
            // Of each state there are the images that differ from it.
            let mut images = HashSet::new();
            let mut worlds: Vec<World<2>> = setting.starts();
            let mut known: HashSet<World<2>> = worlds.iter().copied().collect();
            while let Some(world) = worlds.pop() {
                let mut least = world;
                lattice.make_canonical(&mut least);
                images.insert(least);
                worlds.extend(
                    setting
                        .turns(&world)
                        .into_iter()
                        .map(|turned| turned.world)
                        .filter(|world| known.insert(*world)),
                );
            }
            assert_eq!((images.len() as u64, known.len() as u64), (one.states, all.states), "{size:?}");
        }
    }

    #[test]
    fn what_is_broken_is_broken_in_an_image() {
        for lost in [Condition::NextInReach, Condition::Apart, Condition::Marked, Condition::Stays] {
            let rule = Rule::REPAIRED.without(lost);
            let demands = |found: Findings<Demand>| -> HashSet<&'static str> {
                found.broken.iter().map(|run| run.demand.words()).collect()
            };
            let setting = Setting { max_walls: 1, ..Setting::new(rule, (5, 1)).expect("a lattice") };
            let all = demands(search(&setting, setting.starts(), Limits::NONE));
            let one = demands(search(&SymmetricLattice::new(setting), setting.starts(), Limits::NONE));
            assert!(all.is_subset(&one) && !one.is_empty(), "{lost:?}: {all:?}, {one:?}");
        }
    }

    #[test]
    fn a_run_of_images_is_one_of_the_lattice_itself() {
        for rule in [Rule::PUBLISHED, Rule::AHEAD] {
            let setting = Setting::new(rule, (5, 1)).expect("a lattice");
            let lattice = SymmetricLattice::new(setting);
            let broken = search(&lattice, setting.starts(), Limits::NONE).broken;
            let ends = |run: &&Run<Demand>| run.round().is_empty();
            for run in broken.iter().filter(ends) {
                let unfolded = Counterexample::of_image(setting, run).expect("a run");
                let start = setting.starts()[unfolded.run.start];
                let steps: Vec<_> = unfolded.run.played(&setting, start).collect();
                let (_, last) = steps.last().expect("a step");
                let is_broken = last.breaks.contains(&run.demand)
                    || world::World::broken_at_end(&setting, &last.state, &[]).contains(&run.demand);
                assert!(is_broken && steps.len() == run.steps.len(), "{rule:?}: {run:?}");
            }
            assert!(broken.iter().any(|run| run.round().is_empty()), "{rule:?}");
        }
    }

    #[test]
    fn two_robots_of_another_reach_break_nothing_within_it() {
        for paths in 2..=Reach::MOST_PATHS {
            let rule = Rule { reach: Reach::of_paths(paths).expect("a reach"), ..Rule::REPAIRED };
            for size in [(5, 1), (3, 2)] {
                let setting = Setting::new(rule, size).expect("a lattice");
                let found = search(&SymmetricLattice::new(setting), setting.starts(), Limits::NONE);
                assert!(
                    found.is_whole && found.broken.is_empty(),
                    "{paths} paths, {size:?}: {:?}",
                    found.broken
                );
            }
        }
    }

    #[test]
    #[ignore = "takes a minute: cargo test --release -p tautline-proofs --lib -- \
                --ignored --nocapture three_robots_of_another"]
    fn three_robots_of_another_reach_break_nothing_side_by_side() {
        for paths in 2..=Reach::MOST_PATHS {
            let rule = Rule { reach: Reach::of_paths(paths).expect("a reach"), ..Rule::REPAIRED };
            for size in [(2, 2), (4, 1), (5, 1), (3, 2)] {
                let setting = Setting::<3> {
                    starts: Starts::SideBySide,
                    ..Setting::new(rule, size).expect("a lattice")
                };
                let found = search(&setting, setting.starts(), Limits::NONE);
                println!("{paths} paths, {size:?}: {} states", found.states);
                assert!(
                    found.is_whole && found.broken.is_empty(),
                    "{paths} paths, {size:?}: {:?}",
                    found.broken
                );
            }
        }
    }

    /// Searches all teams of two on one lattice, of each one image: none breaks anything.
    fn all_teams((columns, rows): (i16, i16), max_walls: u8, speeds: Speeds) {
        let begun = Instant::now();
        let setting = Setting::new(Rule::REPAIRED, (columns, rows)).expect("a lattice");
        let setting = Setting { max_walls: max_walls.min(setting.max_walls), speeds, ..setting };
        let lattice = SymmetricLattice::new(setting);
        let found = search(&lattice, setting.starts(), Limits::NONE);
        println!(
            "{columns}×{rows}, at most {} walls, {speeds:?}: {} states, {} steps, {} MiB, {:.0} s",
            setting.max_walls,
            found.states,
            found.steps,
            found.bytes >> 20,
            begun.elapsed().as_secs_f64()
        );
        assert!(found.is_whole && found.broken.is_empty(), "{:?}", found.broken);
    }

    #[test]
    #[ignore = "3,751,960 states at most, 88 s: cargo test --release -p \
                tautline-proofs -- --ignored --nocapture all_walls"]
    fn two_robots_keep_every_promise_with_all_walls() {
        for speeds in [Speeds::OneByOne, Speeds::Any] {
            for size in [(3, 2), (4, 2), (3, 3), (5, 2)] {
                all_teams(size, u8::MAX, speeds);
            }
        }
    }

    #[test]
    #[ignore = "10,174,954 states at most, 118 s, 671 MiB: cargo test --release -p \
                tautline-proofs -- --ignored --nocapture few_walls"]
    fn two_robots_keep_every_promise_with_few_walls() {
        for (size, walls) in [((6, 2), 4), ((4, 3), 3)] {
            all_teams(size, walls, Speeds::OneByOne);
        }
    }

    /// Three robots that radio alone binds, side by side on a small lattice, leave no path undriven.
    #[test]
    #[ignore = "715,382 states, 11 s: cargo test --release -p tautline-proofs -- --ignored --nocapture without_ties"]
    fn three_robots_without_ties_drive_everything_in_two_rows_of_three_nodes() {
        let begun = Instant::now();
        let rule = Rule::REPAIRED.without(Condition::Tether);
        // Two rows of four nodes with at most one wall did not come to an end within eight minutes, and nothing was
        // broken so far.
        let setting = Setting::<3>::new(rule, (3, 2)).expect("a lattice");
        let setting = Setting { starts: Starts::SideBySide, demand: Some(Demand::Whole), ..setting };
        let found = search(&setting, setting.starts(), Limits::NONE);
        println!("{} states, {:.0} s", found.states, begun.elapsed().as_secs_f64());
        assert!(found.is_whole && found.broken.is_empty(), "{:?}", found.broken);
    }
}
