//! A team on a small lattice whose walls are decided as it meets them: which robot arrives next, which decides, where
//! it turns, whether it sees another one, and whether a side is blocked, are choices. What the clauses demand is in
//! plain arithmetic here; of the kernel's rule only what robots do is used.

mod turns;
mod violations;

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Edge, EdgeMark, Grid, Side, TinyGrid};
use tautline_kernel::kit::{Condition, Crew, Kit, Next, Rule, Sight, Stance};

use super::plain::Findings;
use crate::engine::states::{self, Bits, Places, System};
use crate::engine::world::{self, Turn};

/// A team on a small lattice.
pub type Team<const ROBOTS: usize> = Kit<TinyGrid, ROBOTS, 64>;

/// A demand on a team.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Demand {
    /// KIT-1, KIT-2, KIT-12
    Contact,
    /// KIT-1, judged where all robots stand alone
    AtNodes,
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
    /// KIT-14
    AnyShortest,
    /// KIT-13
    Whole,
}

impl Demand {
    /// All of them.
    pub const ALL: [Self; 10] = [
        Self::Contact,
        Self::AtNodes,
        Self::Apart,
        Self::Moves,
        Self::Ends,
        Self::Covers,
        Self::Marks,
        Self::Shortens,
        Self::AnyShortest,
        Self::Whole,
    ];

    /// The clause that so many robots break with it.
    pub const fn clause(self, robots: usize) -> &'static str {
        match self {
            Self::Contact if robots > 2 => "KIT-12",
            Self::Contact | Self::AtNodes => "KIT-1",
            Self::Apart => "KIT-3",
            Self::Moves => "KIT-6",
            Self::Ends => "KIT-7",
            Self::Covers => "KIT-8",
            Self::Marks => "KIT-10",
            Self::Shortens => "KIT-11",
            Self::AnyShortest => "KIT-14",
            Self::Whole => "KIT-13",
        }
    }

    pub(super) const fn words(self) -> &'static str {
        match self {
            Self::Contact => "the robots hear each other all the way",
            Self::AtNodes => "the robots hear each other where both stand",
            Self::Apart => "the robots stay 3 m apart",
            Self::Moves => "a robot moves while an uncovered side is within reach",
            Self::Ends => "no run goes on for ever",
            Self::Covers => "the run is over with every side within reach covered, and all know it",
            Self::Marks => "the sides that are driven or seen blocked count as covered, and no others",
            Self::Shortens => "a drive over an old path brings the team nearer to an uncovered side",
            Self::AnyShortest => "a robot takes any of the sides that begin a shortest way",
            Self::Whole => "the run is over with every side covered that paths join to the starts",
        }
    }
}

/// Where robots start.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Starts {
    /// At any nodes that the rule lets them start at.
    Anywhere,
    /// Each beside another one, and free paths between them join all.
    SideBySide,
}

/// How fast robots are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Speeds {
    /// Each drive takes any time.
    Any,
    /// All drives take the same time: who has left first arrives first. Of at most two robots.
    Equal,
    /// Nobody decides while another one drives.
    OneByOne,
}

/// Whether robots wait for answers.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Answers {
    /// A robot that stands may be overtaken by the arrival of the other one.
    AnyTime,
    /// A robot is answered at the moment when it arrives, if the other one drives.
    AtOnce,
    /// As *any time*; by the reading *answers always* a robot that stands answers, too, and what it says is still true
    /// when the other one decides.
    TrueNews,
}

/// The lattice and what goes on there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Setting<const ROBOTS: usize> {
    /// The rule that the robots follow.
    pub rule: Rule,
    /// The nodes.
    pub area: Area,
    /// Most walls that are met in one run.
    pub max_walls: u8,
    /// How fast the robots are.
    pub speeds: Speeds,
    /// Whether they wait for answers.
    pub answers: Answers,
    /// Where they start.
    pub starts: Starts,
    /// The one demand that is looked at; all if there is none.
    pub demand: Option<Demand>,
    /// The walls of the lattice, if they are not decided as they are met.
    pub given: Option<TinyGrid>,
}

/// The mark of the paths that a robot has driven or drives.
pub(super) const DRIVEN: EdgeMark = EdgeMark::Virtual;

/// A team and what is decided of its lattice.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct World<const ROBOTS: usize> {
    /// The robots.
    pub team: Team<ROBOTS>,
    /// Sides that are open, paths that were driven (marked as virtual), and walls that were met.
    pub truth: TinyGrid,
    pub(super) walls: u8,
    /// The robots that drive a path which was new when they left, a bit for each.
    pub(super) fresh: u8,
    /// Of two robots that drive, the one that has left first.
    pub(super) first: u8,
}

/// An event.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Event {
    /// A robot arrives at a node.
    Arrives(usize, Cell),
    /// A robot looks at sides of its node, and does what comes of it.
    Decides(usize, Vec<(Side, Sight)>, Next),
}

/// A step, with what happens in it.
#[derive(Clone, Debug)]
pub struct Successor<const ROBOTS: usize> {
    /// The world after it.
    pub world: World<ROBOTS>,
    /// The events, in order.
    pub events: Vec<Event>,
    pub(super) robot: usize,
    pub(super) situation: &'static str,
    /// The demands that it breaks.
    pub breaks: Vec<Demand>,
}

impl<const ROBOTS: usize> Setting<ROBOTS> {
    /// A lattice of so many columns and rows, with any walls, any starts and any speeds, of which everything is
    /// demanded; `None` if it is too large.
    pub fn new(rule: Rule, (columns, rows): (i16, i16)) -> Option<Self> {
        let area = Area::new(Cell::new(0, 0), Cell::new(columns.checked_sub(1)?, rows.checked_sub(1)?))?;
        TinyGrid::new(area)?;
        let (speeds, answers, starts) = (Speeds::Any, Answers::AnyTime, Starts::Anywhere);
        let max_walls = area.edges().count() as u8;
        Some(Self { rule, area, max_walls, speeds, answers, starts, demand: None, given: None })
    }

    /// The start with the robots at these nodes, if the rule lets them start there.
    pub fn start(&self, cells: [Cell; ROBOTS]) -> Option<World<ROBOTS>> {
        let map = TinyGrid::new(self.area)?;
        let team = Team::new(self.rule, map, &cells).ok()?;
        Some(World { team, truth: map, walls: 0, fresh: 0, first: 0 })
    }

    /// Every start.
    pub fn starts(&self) -> Vec<World<ROBOTS>> {
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

    /// The robots in all places: all at one node where they may be there and nobody takes turns, since then one enters
    /// after the other; else each at a node of its own.
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

    /// The paths driven, whatever the robots' records say, and the obstacles met.
    fn found(&self, world: &World<ROBOTS>) -> TinyGrid {
        let mut map = world.truth;
        map.clear_edges(EdgeMark::Open);
        map.clear_edges(DRIVEN);
        let driven = self.area.edges().filter(|&edge| world.truth.edge_has(DRIVEN, edge));
        driven.for_each(|edge| map.put_edge(EdgeMark::Open, edge));
        map
    }

    /// Where each robot will be next.
    fn ends(world: &World<ROBOTS>) -> [Cell; ROBOTS] {
        std::array::from_fn(|robot| world.team.stance(robot).map_or(Cell::new(0, 0), Stance::to))
    }

    /// The findings of a team that stands.
    fn findings<'a>(&self, map: &'a TinyGrid) -> Findings<'a, ROBOTS> {
        Findings { map, left: [None; ROBOTS], reach: self.rule.reach }
    }

    /// Whether a new path is within reach of a team that stands.
    fn is_owed(&self, world: &World<ROBOTS>) -> bool {
        let (map, ends) = (self.found(world), Self::ends(world));
        let found = self.findings(&map);
        // A robot comes to no path but those that are left over, and whether one is takes less time to find.
        found.is_left_over(ends) && found.distance(ends, u8::MAX).is_some()
    }

    /// The demands that are looked at.
    pub fn demands(&self) -> impl Iterator<Item = Demand> {
        Demand::ALL.into_iter().filter(|&demand| self.is_wanted(demand))
    }

    /// Whether this is looked at, and promised to so many robots that start so.
    fn is_wanted(&self, demand: Demand) -> bool {
        let is_promised = match demand {
            Demand::Shortens | Demand::AnyShortest => ROBOTS == 2,
            Demand::Whole => ROBOTS > 2 && self.starts == Starts::SideBySide,
            // Who keeps in touch all the way does so at nodes.
            Demand::AtNodes => self.demand.is_some(),
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

/// A part of a world.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Part<const ROBOTS: usize> {
    /// A record, or the truth.
    Map(TinyGrid),
    /// All but the maps: the crew, the number of walls, who drives a new path, and who has left first.
    Rest(Crew<ROBOTS>, [u8; 3]),
}

/// The situations that occur.
pub(super) const SITUATIONS: [&str; 5] = ["a new path", "a stay", "an arrival", "an old path", "done"];

impl<const ROBOTS: usize> world::World for Setting<ROBOTS> {
    type State = World<ROBOTS>;
    type Plan = Vec<Successor<ROBOTS>>;
    type Event = usize;
    type Demand = Demand;

    fn plan(&self, state: &mut World<ROBOTS>, _: &[u8]) -> Option<Vec<Successor<ROBOTS>>> {
        world::any_of(self.turns(state))
    }

    fn settle(
        &self,
        state: &mut World<ROBOTS>,
        turns: &Vec<Successor<ROBOTS>>,
        _: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> usize {
        let number = world.pick(turns.len() as u32) as usize;
        *state = turns[number].world;
        number
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<Demand> {
        turn.plan[*turn.event].breaks.clone()
    }

    fn broken_at_end(&self, state: &World<ROBOTS>, _: &[u8]) -> Vec<Demand> {
        self.broken_by_staying(state)
    }

    fn covers(&self) -> Vec<&'static str> {
        SITUATIONS.to_vec()
    }

    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        world::bit(&SITUATIONS, turn.plan[*turn.event].situation)
    }
}

impl<const ROBOTS: usize> System for Setting<ROBOTS> {
    type Part = Part<ROBOTS>;

    fn places(&self, _: &World<ROBOTS>) -> usize {
        ROBOTS + 2
    }

    fn part(&self, state: &World<ROBOTS>, place: usize) -> Part<ROBOTS> {
        match place.checked_sub(ROBOTS) {
            None => Part::Map(state.team.records()[place]),
            Some(0) => Part::Map(state.truth),
            Some(_) => Part::Rest(state.team.crew, [state.walls, state.fresh, state.first]),
        }
    }

    /// Nearly every step changes something beside the maps.
    fn differing(&self, one: &World<ROBOTS>, other: &World<ROBOTS>) -> Places {
        let records = one.team.records().iter().zip(other.team.records()).map(|(one, other)| one != other);
        states::places(records.chain([one.truth != other.truth, true]))
    }

    fn put(&self, state: &mut World<ROBOTS>, place: usize, part: &Part<ROBOTS>) {
        match part {
            Part::Map(map) if place == ROBOTS => state.truth = *map,
            Part::Map(map) => {
                let team = state.team;
                let record = |robot| if robot == place { *map } else { team.records()[robot] };
                state.team = team.with_records(record);
            }
            Part::Rest(crew, [walls, fresh, first]) => {
                state.team.crew = *crew;
                (state.walls, state.fresh, state.first) = (*walls, *fresh, *first);
            }
        }
    }

    fn acting(&self, turn: &Turn<'_, Self>) -> Bits {
        1 << turn.plan[*turn.event].robot
    }

    fn broken_by_endless_runs(&self) -> Option<Demand> {
        self.is_wanted(Demand::Ends).then_some(Demand::Ends)
    }

    /// Whoever drives arrives, and whoever may decide decides.
    fn awake(&self, state: &World<ROBOTS>) -> Bits {
        let is_awake = |robot: &usize| {
            let is_driving = state.team.stance(*robot).is_some_and(|stance| !stance.stands());
            is_driving || self.may_decide(&state.team, *robot)
        };
        (0..ROBOTS).filter(is_awake).fold(0, |set, robot| set | 1 << robot)
    }

    fn is_enough(&self, _: Demand) -> bool {
        self.demand.is_some()
    }
}
