//! A team on a small lattice whose walls are decided as it meets them: which robot arrives next, which decides, where it
//! turns, whether it sees another one, and whether a side is blocked, are choices. What the clauses demand is in plain
//! arithmetic here; of the kernel's rule only what robots do is used.

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Edge, EdgeMark, Grid, Side, Step, Steps, TinyGrid};
use tautline_kernel::kit::{Condition, Kit, Next, Records, Rule, Sight, Stance, touch};

use super::plain::Found;
use crate::engine::outcomes;
use crate::engine::states::{self, Bits, Places, System};

/// A team on a small lattice.
pub(super) type Team<const ROBOTS: usize> = Kit<TinyGrid, ROBOTS, 64>;

/// What is demanded.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Demand {
    /// KIT-1, KIT-2, KIT-12
    Contact,
    /// KIT-3
    Apart,
    /// KIT-6
    Moves,
    /// KIT-7
    Ends,
    /// KIT-8
    Covers,
    /// KIT-10
    Marks,
    /// KIT-11
    Shortens,
    /// KIT-13
    Whole,
}

impl Demand {
    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Contact => "the robots hear each other all the way",
            Self::Apart => "the robots stay 3 m apart",
            Self::Moves => "a robot moves while an uncovered side is within reach",
            Self::Ends => "no run goes on for ever",
            Self::Covers => "the run is over with every side within reach covered, and all know it",
            Self::Marks => "the sides that are driven or seen blocked count as covered, and no others",
            Self::Shortens => "a drive over an old path brings the team nearer to an uncovered side",
            Self::Whole => "the run is over with every side covered that paths join to the starts",
        }
    }
}

/// Where robots start.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Starts {
    /// At any nodes that the rule lets them start at.
    Anywhere,
    /// Each beside another one, and free paths between them join all.
    SideBySide,
}

/// How fast robots are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Speeds {
    /// Each drive takes any time.
    Any,
    /// All drives take the same time: who has left first arrives first.
    Equal,
}

/// Whether robots wait for answers.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Answers {
    /// A robot that stands may be overtaken by the arrival of the other one.
    AnyTime,
    /// A robot is answered at the moment when it arrives.
    AtOnce,
}

/// The lattice and what goes on there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Setting<const ROBOTS: usize> {
    pub(super) rule: Rule,
    pub(super) area: Area,
    /// Most walls that are met in one run.
    pub(super) max_walls: u8,
    pub(super) speeds: Speeds,
    pub(super) answers: Answers,
    pub(super) starts: Starts,
    /// The one demand that is looked at; all if there is none.
    pub(super) demand: Option<Demand>,
}

/// A team and what is decided of its lattice.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct World<const ROBOTS: usize> {
    pub(super) team: Team<ROBOTS>,
    /// Sides that are open, and walls that were met.
    pub(super) truth: TinyGrid,
    walls: u8,
    /// The robots that drive a path which was new when they left, a bit for each.
    fresh: u8,
    /// Of two robots that drive, the one that has left first.
    first: u8,
}

/// What happens.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Event {
    /// A robot arrives at a node.
    Arrives(usize, Cell),
    /// A robot looks at sides of its node, and does what comes of it.
    Decides(usize, Vec<(Side, Sight)>, Next),
}

/// A step, with what happens in it.
pub(super) struct Turned<const ROBOTS: usize> {
    pub(super) world: World<ROBOTS>,
    pub(super) events: Vec<Event>,
    robot: usize,
    situation: &'static str,
    breaks: Vec<Demand>,
}

impl<const ROBOTS: usize> Setting<ROBOTS> {
    /// The start with the robots at these nodes, if the rule lets them start there.
    pub(super) fn start(&self, cells: [Cell; ROBOTS]) -> Option<World<ROBOTS>> {
        let map = TinyGrid::new(self.area)?;
        let team = Team::new(self.rule, map, cells).ok()?;
        Some(World { team, truth: map, walls: 0, fresh: 0, first: 0 })
    }

    /// Every start.
    pub(super) fn starts(&self) -> Vec<World<ROBOTS>> {
        match self.starts {
            Starts::Anywhere => self.placed().collect(),
            Starts::SideBySide => self.placed().flat_map(|world| self.joined(&world)).collect(),
        }
    }

    /// This start with each set of free paths between neighbours that just suffices to join all.
    fn joined(&self, world: &World<ROBOTS>) -> Vec<World<ROBOTS>> {
        let ends = Self::ends(world);
        let is_between =
            |edge: &Edge| [edge.cell(), edge.cell().beyond(edge.side())].map(|end| ends.contains(&end));
        let between: Vec<Edge> = self.area.edges().filter(|edge| is_between(edge) == [true, true]).collect();
        let sets = (0_u32..1 << between.len()).filter(|set| set.count_ones() as usize == ROBOTS - 1);
        let with_paths = sets.filter_map(|set| {
            let mut truth = world.truth;
            for (number, &edge) in between.iter().enumerate() {
                if set >> number & 1 == 1 {
                    truth.put_edge(EdgeMark::Open, edge);
                }
            }
            let mut reached = vec![ends[0]];
            let mut place = 0;
            while let Some(&from) = reached.get(place) {
                let is_new = |node: &Cell| ends.contains(node) && !reached.contains(node);
                let is_open = |side: &Side| truth.edge_has(EdgeMark::Open, Edge::new(from, *side));
                let beside =
                    Side::ALL.into_iter().filter(is_open).map(|side| from.beyond(side)).filter(is_new);
                let beside: Vec<Cell> = beside.collect();
                reached.extend(beside);
                place += 1;
            }
            (reached.len() == ROBOTS).then_some(World { truth, ..*world })
        });
        with_paths.collect()
    }

    /// The robots in all places: all at one node where they may be there and nobody takes turns, since then one enters after
    /// the other; else each at a node of its own.
    fn placed(&self) -> impl Iterator<Item = World<ROBOTS>> {
        let nodes: Vec<Cell> = self.area.cells().collect();
        let enters_one_by_one = !self.rule.has(Condition::Turn) && !self.rule.has(Condition::Apart);
        let of = nodes.len();
        let all = if enters_one_by_one { of } else { of.pow(ROBOTS as u32) };
        (0..all).filter_map(move |start| {
            let place = |robot: u32| if enters_one_by_one { start } else { start / of.pow(robot) % of };
            let cells: [Cell; ROBOTS] = std::array::from_fn(|robot| nodes[place(robot as u32)]);
            let is_double = |robot: usize| cells[..robot].contains(&cells[robot]);
            if !enters_one_by_one && (0..ROBOTS).any(is_double) {
                return None;
            }
            self.start(cells)
        })
    }

    /// What has been driven, and what was met.
    fn found(&self, world: &World<ROBOTS>) -> TinyGrid {
        let mut map = world.truth;
        map.clear_edges(EdgeMark::Open);
        for edge in self.area.edges() {
            if world.team.records().iter().any(|record| record.edge_has(EdgeMark::Open, edge)) {
                map.put_edge(EdgeMark::Open, edge);
            }
        }
        map
    }

    /// Where each robot will be next.
    fn ends(world: &World<ROBOTS>) -> [Cell; ROBOTS] {
        std::array::from_fn(|robot| world.team.stance(robot).map_or(Cell::new(0, 0), Stance::to))
    }

    /// Whether a new path is within reach of a team that stands.
    fn is_owed(&self, world: &World<ROBOTS>) -> bool {
        let map = self.found(world);
        Found { map: &map, left: [None; ROBOTS] }.distance(Self::ends(world), u8::MAX).is_some()
    }

    /// Whether this is looked at, and promised to so many robots that start so.
    fn is_wanted(&self, demand: Demand) -> bool {
        let is_promised = match demand {
            Demand::Shortens => ROBOTS <= 2,
            Demand::Whole => ROBOTS > 2 && self.starts == Starts::SideBySide,
            Demand::Contact
            | Demand::Apart
            | Demand::Moves
            | Demand::Ends
            | Demand::Covers
            | Demand::Marks => true,
        };
        is_promised && self.demand.is_none_or(|wanted| wanted == demand)
    }
}

/// What happens next.
impl<const ROBOTS: usize> Setting<ROBOTS> {
    /// Every step from `world`.
    pub(super) fn turns(&self, world: &World<ROBOTS>) -> Vec<Turned<ROBOTS>> {
        let mut turns = Vec::new();
        for robot in 0..ROBOTS {
            let is_driving = world.team.stance(robot).is_some_and(|stance| !stance.stands());
            if !is_driving {
                turns.extend(outcomes(|oracle| self.decide(world, robot, oracle)).flatten());
                continue;
            }
            let all_drive = world.team.stances().all(|stance| !stance.stands());
            if self.speeds == Speeds::Equal && all_drive && usize::from(world.first) != robot {
                continue;
            }
            let mut after = *world;
            if after.team.arrived(robot).is_err() {
                continue;
            }
            after.fresh &= !(1 << robot);
            // Of two, the other one is now the one that has left first.
            after.first = u8::from(robot == 0 && ROBOTS > 1);
            let node = Self::ends(&after)[robot];
            let arrival = Event::Arrives(robot, node);
            if self.answers == Answers::AtOnce && after.team.may_decide(robot) {
                let decided = outcomes(|oracle| self.decide(&after, robot, oracle)).flatten();
                turns.extend(decided.map(|mut turned| {
                    turned.events.insert(0, arrival.clone());
                    turned
                }));
                continue;
            }
            let breaks = self.broken_by_marks(&after);
            turns.push(Turned {
                world: self.settled(after),
                events: vec![arrival],
                robot,
                situation: "an arrival",
                breaks,
            });
        }
        turns
    }

    /// `robot` decides, if it may.
    fn decide(&self, world: &World<ROBOTS>, robot: usize, oracle: &mut dyn Oracle) -> Option<Turned<ROBOTS>> {
        let mut after = *world;
        let from = Self::ends(world)[robot];
        let mut next = after.team.decide(robot, oracle).ok()?;
        let mut looks = Vec::new();
        let mut is_old = false;
        while let Next::Looks(side) = next {
            is_old = world.team.known(EdgeMark::Open, from).has(Step::Cross(side));
            let sight = self.see(&mut after, (robot, from, side), oracle);
            looks.push((side, sight));
            next = after.team.looked(robot, sight, oracle).ok()?;
        }
        let situation = match next {
            Next::Drives(_) if is_old => "an old path",
            Next::Drives(_) => "a new path",
            Next::Stays | Next::Looks(_) => "a stay",
            Next::Done => "done",
        };
        let mut breaks = self.broken_by_marks(&after);
        if let Next::Drives(to) = next {
            if !is_old {
                after.fresh |= 1 << robot;
            }
            let others_drive = world.team.stances().any(|stance| !stance.stands());
            after.first = if others_drive { world.first } else { robot as u8 };
            let seen = World { team: world.team, ..after };
            breaks.extend(self.broken_by_drive(&seen, robot, Stance::Drives { from, to }, is_old));
        }
        let events = vec![Event::Decides(robot, looks, next)];
        Some(Turned { world: self.settled(after), events, robot, situation, breaks })
    }

    /// What `robot` sees at a side of its node.
    fn see(
        &self,
        world: &mut World<ROBOTS>,
        (robot, node, side): (usize, Cell, Side),
        oracle: &mut dyn Oracle,
    ) -> Sight {
        let edge = Edge::new(node, side);
        if !world.truth.edge_has(EdgeMark::Wall, edge) && !world.truth.edge_has(EdgeMark::Open, edge) {
            let is_wall = world.walls < self.max_walls && oracle.mishap();
            world.walls += u8::from(is_wall);
            world.truth.put_edge(if is_wall { EdgeMark::Wall } else { EdgeMark::Open }, edge);
        }
        if world.truth.edge_has(EdgeMark::Wall, edge) {
            return Sight::Obstacle;
        }
        let others = world.team.stances().enumerate().filter(|&(other, _)| other != robot);
        let seen: Vec<Option<bool>> = others.map(|(_, stance)| touch(node, side, stance)).collect();
        let is_seen = seen.contains(&Some(true)) || seen.contains(&None) && oracle.flip();
        if is_seen { Sight::Robot } else { Sight::Free }
    }

    /// Where all records count, it does not matter who has driven a path.
    fn settled(&self, mut world: World<ROBOTS>) -> World<ROBOTS> {
        if self.rule.records == Records::Union {
            let blank = TinyGrid::new(self.area).unwrap_or(world.truth);
            let mut records = [blank; ROBOTS];
            for record in world.team.records() {
                records[0].add_edges(record);
            }
            world.team = world.team.with_records(records);
        }
        world
    }
}

/// What is broken.
impl<const ROBOTS: usize> Setting<ROBOTS> {
    fn broken_by_marks(&self, world: &World<ROBOTS>) -> Vec<Demand> {
        if !self.is_wanted(Demand::Marks) {
            return Vec::new();
        }
        let map = self.found(world);
        let is_covered = |node, side| {
            let edge = Edge::new(node, side);
            map.edge_has(EdgeMark::Open, edge) || map.edge_has(EdgeMark::Wall, edge)
        };
        let sides =
            |node| Steps::ALL.filter(|step| matches!(step, Step::Cross(side) if is_covered(node, side)));
        let is_right = |robot| self.area.cells().all(|node| world.team.covered(robot, node) == sides(node));
        if (0..ROBOTS).all(is_right) { Vec::new() } else { vec![Demand::Marks] }
    }

    /// What is broken by a drive that `robot` begins.
    fn broken_by_drive(
        &self,
        before: &World<ROBOTS>,
        robot: usize,
        path: Stance,
        is_old: bool,
    ) -> Vec<Demand> {
        let others: Vec<(usize, Stance)> =
            before.team.stances().enumerate().filter(|&(other, _)| other != robot).collect();
        let mut breaks = Vec::new();
        if self.is_wanted(Demand::Contact) && !self.is_in_contact(&others, path) {
            breaks.push(Demand::Contact);
        }
        if self.is_wanted(Demand::Apart) && others.iter().any(|(_, other)| other.has(path.to())) {
            breaks.push(Demand::Apart);
        }
        if is_old && self.is_wanted(Demand::Shortens) && !self.is_shorter(before, robot, path.to()) {
            breaks.push(Demand::Shortens);
        }
        breaks
    }

    /// Whether the robots are connected while one of them drives this path.
    fn is_in_contact(&self, others: &[(usize, Stance)], path: Stance) -> bool {
        let hear = |one: Stance, other: Stance| {
            let near = |one: Cell, other: Cell| {
                let (dx, dy) = one.apart(other);
                9 * (u32::from(dx).pow(2) + u32::from(dy).pow(2)) <= 100
            };
            let both = near(one.from(), other.from()) && near(one.to(), other.to());
            // Of two robots of one speed, who has left later is not at its end while the other is where it left.
            let late = near(one.to(), other.from())
                || self.speeds == Speeds::Equal && one == path && !other.stands();
            let early = near(one.from(), other.to())
                || self.speeds == Speeds::Equal && other == path && !one.stands();
            both && late && early
        };
        let mut reached = vec![path];
        let mut rest: Vec<Stance> = others.iter().map(|&(_, stance)| stance).collect();
        let mut place = 0;
        while place < reached.len() {
            let (near, far): (Vec<_>, Vec<_>) = rest.iter().partition(|&&other| hear(reached[place], other));
            reached.extend(near);
            rest = far;
            place += 1;
        }
        rest.is_empty()
    }

    /// Whether the team, or the robot alone while another one drives a new path, is nearer to an uncovered side at `to`.
    fn is_shorter(&self, before: &World<ROBOTS>, robot: usize, to: Cell) -> bool {
        let map = self.found(before);
        let cells = Self::ends(before);
        let mut after = cells;
        after[robot] = to;
        let is_nearer = |left, movers| {
            let found = Found { map: &map, left };
            match (found.distance(after, movers), found.distance(cells, movers)) {
                (Some(after), Some(before)) => after < before,
                (_, None) | (None, Some(_)) => false,
            }
        };
        let left =
            |other: usize| before.team.stance(other).filter(|stance| !stance.stands()).map(Stance::from);
        let goes_alone = self.rule.has(Condition::Meanwhile) && before.fresh & !(1 << robot) != 0;
        is_nearer([None; ROBOTS], u8::MAX) || goes_alone && is_nearer(std::array::from_fn(left), 1 << robot)
    }

    /// The first of the demands that are looked at and broken by staying in `world`.
    fn broken_by_staying(&self, world: &World<ROBOTS>) -> Option<Demand> {
        let is_over = world.team.is_over();
        let is_stuck = || !is_over && self.is_owed(world);
        if self.is_wanted(Demand::Moves) && is_stuck() {
            return Some(Demand::Moves);
        }
        let is_short = || !is_over || self.is_owed(world);
        if self.is_wanted(Demand::Covers) && is_short() {
            return Some(Demand::Covers);
        }
        let is_left_over = || {
            let map = self.found(world);
            !is_over || Found { map: &map, left: [None; ROBOTS] }.is_left_over(Self::ends(world))
        };
        (self.is_wanted(Demand::Whole) && is_left_over()).then_some(Demand::Whole)
    }
}

/// What a world is made of.
#[derive(Clone, PartialEq, Eq, Hash)]
pub(super) enum Part<const ROBOTS: usize> {
    /// A record, or the truth.
    Map(TinyGrid),
    /// All but the maps.
    Rest(Box<World<ROBOTS>>),
}

impl<const ROBOTS: usize> System for Setting<ROBOTS> {
    type State = World<ROBOTS>;
    type Part = Part<ROBOTS>;
    type Demand = Demand;

    fn places(&self, _: &World<ROBOTS>) -> usize {
        ROBOTS + 2
    }

    fn part(&self, state: &World<ROBOTS>, place: usize) -> Part<ROBOTS> {
        match place.checked_sub(ROBOTS) {
            None => Part::Map(state.team.records()[place]),
            Some(0) => Part::Map(state.truth),
            Some(_) => Part::Rest(Box::new(self.bare(state))),
        }
    }

    /// Nearly every step changes something beside the maps.
    fn differing(&self, one: &World<ROBOTS>, other: &World<ROBOTS>) -> Places {
        let records = one.team.records().iter().zip(other.team.records()).map(|(one, other)| one != other);
        let differing = records.chain([one.truth != other.truth, true]);
        (0..).zip(differing).fold(0, |places, (place, differs)| places | Places::from(differs) << place)
    }

    fn put(&self, state: &mut World<ROBOTS>, place: usize, part: &Part<ROBOTS>) {
        match part {
            Part::Map(map) if place == ROBOTS => state.truth = *map,
            Part::Map(map) => {
                let mut records = *state.team.records();
                records[place] = *map;
                state.team = state.team.with_records(records);
            }
            Part::Rest(rest) => {
                let (records, truth) = (*state.team.records(), state.truth);
                *state = **rest;
                state.team = state.team.with_records(records);
                state.truth = truth;
            }
        }
    }

    fn steps(&self, state: &World<ROBOTS>) -> impl Iterator<Item = states::Step<World<ROBOTS>, Demand>> {
        self.turns(state).into_iter().map(|turned| states::Step {
            state: turned.world,
            situation: turned.situation,
            acting: 1 << turned.robot,
            is_bound: true,
            breaks: turned.breaks,
        })
    }

    fn broken_at_end(&self, state: &World<ROBOTS>) -> Option<Demand> {
        self.broken_by_staying(state)
    }

    fn broken_by_endless_runs(&self) -> Option<Demand> {
        self.is_wanted(Demand::Ends).then_some(Demand::Ends)
    }

    /// Whoever drives arrives, and whoever may decide decides.
    fn awake(&self, state: &World<ROBOTS>) -> Bits {
        let is_awake = |robot: &usize| {
            let is_driving = state.team.stance(*robot).is_some_and(|stance| !stance.stands());
            is_driving || state.team.may_decide(*robot)
        };
        (0..ROBOTS).filter(is_awake).fold(0, |set, robot| set | 1 << robot)
    }

    fn is_enough(&self, _: Demand) -> bool {
        self.demand.is_some()
    }
}

impl<const ROBOTS: usize> Setting<ROBOTS> {
    /// `world` without its maps.
    fn bare(&self, world: &World<ROBOTS>) -> World<ROBOTS> {
        let blank = TinyGrid::new(self.area).unwrap_or(world.truth);
        World { team: world.team.with_records([blank; ROBOTS]), truth: blank, ..*world }
    }
}
