//! A rule of one's own, in surroundings that are put together from parts: which layouts, how many robots, where they
//! start and go, what they see, who acts when, which messages are lost, which robots die. Whoever implements [`Rule`]
//! and says the rest in a [`Setting`] has a search over all of it, mutants, counterexamples that can be replayed and
//! drawn, and a line in a ledger ([`Keeps`]).
//!
//! A setting is searched in one of two ways. As a tree ([`Game`](crate::engine::tree::Game)): the layout with the
//! fewest walls that breaks a demand comes first, and a search can be left, taken up again and dealt out. As states
//! ([`System`](crate::engine::states::System)): ways that lead to the same are gone once, and the shortest run that
//! ends comes first. [`Setting::strategy`] says which; where both can be asked, they agree.

mod check;
mod graph;
mod ground;
mod rule;
mod titles;
mod world;

use std::fmt;

use serde::{Deserialize, Serialize};
use tautline_kernel::ground::Cell;

pub use self::check::Keeps;
pub use self::graph::{Crew, Deployment, Graph, Graphs, Kind, KnownGraph, Task, Teams, conflicts};
pub use self::ground::{Assumption, Ground, Map, Which};
pub use self::rule::{Act, Body, Cover, Demand, Rule, Scene, TeamState, TeamStep, View};
pub use self::world::{Event, Part, TeamWorld};
use crate::decide::MethodError;
use crate::engine::Until;
use crate::engine::states::Bits;
use crate::engine::tree::{Limits, Tree};
use crate::plural::counted;
use crate::protocol::arrangements;

/// Where robots start, or where they are to go.
#[derive(Clone, Copy, Debug)]
pub enum Places<R> {
    /// Nowhere: only goals can be so.
    None,
    /// In these cells, a cell for each robot.
    At(fn(&R) -> Vec<Cell>),
    /// In any free cells.
    Any,
    /// In any free cells, no two in one.
    Distinct,
}

/// How far robots see, in steps as if nothing stood between; 0 is not at all, and [`u16::MAX`] everything.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Senses {
    /// Walls and blocked cells. A robot that does not see them finds out by going.
    pub ground: u16,
    /// Other robots.
    pub robots: u16,
}

impl Senses {
    /// A robot sees nothing, and feels what is in its way.
    pub const BUMP: Self = Self { ground: 0, robots: 0 };
    /// A robot feels what is in its way, and knows where the others are.
    pub const TEAM: Self = Self { ground: 0, robots: u16::MAX };
    /// A robot sees everything.
    pub const ALL: Self = Self { ground: u16::MAX, robots: u16::MAX };
}

impl fmt::Display for Senses {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let seen = |far: u16, what: &str| match far {
            0 => None,
            u16::MAX => Some(format!("all {what}")),
            _ => Some(format!("{what} within {}", counted(far, "step"))),
        };
        match (seen(self.ground, "walls"), seen(self.robots, "robots")) {
            (None, None) => f.write_str("sight of nothing"),
            (Some(seen), None) | (None, Some(seen)) => write!(f, "sight of {seen}"),
            (Some(ground), Some(robots)) => write!(f, "sight of {ground} and {robots}"),
        }
    }
}

/// Which robots act in a step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Moves {
    /// All that have something left to do (FSYNC).
    Together,
    /// Any one.
    OneAtATime,
    /// Any of them, at least one (SSYNC).
    AnySubset,
    /// Any one, which looks and decides in one step and moves in a later one (ASYNC).
    LookThenMove,
}

impl fmt::Display for Moves {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Together => "all together",
            Self::OneAtATime => "one at a time",
            Self::AnySubset => "any of them at a time",
            Self::LookThenMove => "each looks, then moves",
        })
    }
}

impl Moves {
    /// The sets of so many robots that may act in a step, a bit for each robot.
    pub fn sets(self, robots: usize) -> impl Iterator<Item = Bits> {
        let all: Bits = (0..robots).fold(0, |set, robot| set | 1 << robot);
        (1..=all).filter(move |set| match self {
            Self::Together => *set == all,
            Self::OneAtATime | Self::LookThenMove => set.is_power_of_two(),
            Self::AnySubset => true,
        })
    }
}

/// The surroundings of a rule, and what is demanded of a team there.
pub struct Setting<'a, R: Rule> {
    /// The name of the scheme, in a stored run.
    pub scheme: &'static str,
    /// The layouts.
    pub ground: Ground,
    /// How many robots there are: at most 16.
    pub robots: usize,
    /// Where they start.
    pub starts: Places<R>,
    /// Where they are to go.
    pub goals: Places<R>,
    /// The robots' senses.
    pub senses: Senses,
    /// Who acts.
    pub moves: Moves,
    /// Most messages that are lost in one run.
    pub losses: u32,
    /// Most robots that die in one run.
    pub deaths: u32,
    /// Steps after which a run of a tree is given up, which leaves the question open.
    pub longest_run: u32,
    /// The demands on the team.
    pub demands: &'a [Demand<'a, R>],
    /// The situations that must occur: where one does not, the question is open.
    pub covers: &'a [Cover<'a, R>],
}

/// The number of a demand.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub struct Promise(pub usize);

/// How a setting is searched.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Strategy {
    /// As a tree of runs, the fewest mishaps first.
    Tree,
    /// As states, the fewest steps first.
    States,
}

/// Most robots of a team.
const MOST_ROBOTS: usize = 16;

impl<'a, R: Rule> Setting<'a, R> {
    /// Robots that feel their way over this ground from these cells, all together, without faults; nothing is demanded
    /// of them yet.
    pub const fn new(scheme: &'static str, ground: Ground, robots: usize, starts: Places<R>) -> Self {
        Self {
            scheme,
            ground,
            robots,
            starts,
            goals: Places::None,
            senses: Senses::BUMP,
            moves: Moves::Together,
            losses: 0,
            deaths: 0,
            longest_run: u32::MAX,
            demands: &[],
            covers: &[],
        }
    }

    /// How it is searched: as a tree if there is one start, the layout alone is open, and nothing is demanded to be so
    /// eventually, or again and again; else as states.
    pub const fn strategy(&self) -> Strategy {
        let has_one_layout =
            !matches!(self.ground.walls, Which::Any(_)) && !matches!(self.ground.obstacles, Which::Any(_));
        let has_one_start =
            matches!(self.starts, Places::At(_)) && matches!(self.goals, Places::None | Places::At(_));
        let is_plain = matches!(self.moves, Moves::Together) && self.losses == 0 && self.deaths == 0;
        if has_one_layout && has_one_start && is_plain && !self.has_eventually() {
            Strategy::Tree
        } else {
            Strategy::States
        }
    }

    const fn has_eventually(&self) -> bool {
        let mut number = 0;
        while number < self.demands.len() {
            if matches!(self.demands[number].when, rule::When::Eventually(_) | rule::When::AgainAndAgain(_)) {
                return true;
            }
            number += 1;
        }
        false
    }

    /// The cells in which robots may be placed, for each way to place them.
    fn placed(&self, places: &Places<R>, rule: &R, map: &Map) -> Result<Vec<Vec<Cell>>, MethodError> {
        let robots = self.robots;
        Ok(match places {
            Places::None => vec![Vec::new()],
            Places::At(cells) => {
                let cells = cells(rule);
                if cells.len() != robots {
                    return Err(MethodError::new(format_args!(
                        "{robots} robots are placed in {} cells",
                        cells.len()
                    )));
                }
                if let Some(outside) = cells.iter().find(|&&cell| map.cell(cell) == Some(false)) {
                    let why = if map.area().contains(*outside) {
                        "which is blocked"
                    } else {
                        "outside of the area"
                    };
                    return Err(MethodError::new(format_args!("a robot starts in {outside}, {why}")));
                }
                vec![cells]
            }
            Places::Any => {
                let free = map.free();
                let longer = |row: Vec<Cell>| free.iter().map(move |&cell| [&row[..], &[cell]].concat());
                (0..robots).fold(vec![Vec::new()], |rows, _| rows.into_iter().flat_map(longer).collect())
            }
            Places::Distinct => arrangements(&map.free(), robots),
        })
    }

    /// Every scene in which a run begins: of every layout that is decided before, with every start and goal.
    ///
    /// # Errors
    /// [`MethodError`] if the area, the number of robots or the number of layouts
    /// is too large, or a robot starts outside.
    pub fn starts(&self, rule: &R) -> Result<Vec<Scene<R>>, MethodError> {
        if !(1..=MOST_ROBOTS).contains(&self.robots) {
            return Err(MethodError::new(format_args!(
                "a team has 1 to {MOST_ROBOTS} robots, not {}",
                self.robots
            )));
        }
        let mut scenes = Vec::new();
        for map in self.ground.maps()? {
            for starts in self.placed(&self.starts, rule, &map)? {
                for goals in self.placed(&self.goals, rule, &map)? {
                    let mut map = map;
                    for &cell in starts.iter().chain(&goals) {
                        map.note_cell(cell, true);
                    }
                    scenes.push(Self::scene(rule, &starts, goals, Some(&map)));
                }
            }
        }
        Ok(scenes)
    }

    fn scene(rule: &R, starts: &[Cell], goals: Vec<Cell>, map: Option<&Map>) -> Scene<R> {
        let body = |(robot, &cell)| Body::new(cell, rule.start(robot, starts));
        let bodies = starts.iter().enumerate().map(body).collect();
        TeamState { bodies, goals, map: map.copied(), losses: 0, deaths: 0 }
    }

    /// The search for teams that follow `rule`, as a tree, at its start: it can be made wave by wave, left and taken up
    /// again. It is for the demands that are `wanted`, or for all if none is said to be; each is decided as if it stood
    /// alone, so a run goes on until it has broken all of them.
    ///
    /// # Errors
    /// [`MethodError`] if the setting is not one for a [tree](Strategy::Tree), or the limits are beyond what can be
    /// searched.
    pub fn search(
        &'a self,
        rule: &R,
        until: Until,
        wanted: &[Promise],
    ) -> Result<Tree<TeamWorld<'a, R>>, MethodError> {
        if self.strategy() != Strategy::Tree {
            let why = "a tree of runs is of one start in one layout, in which robots move together and lose nothing: \
                       decide by `Keeps`, which searches the states of all else";
            return Err(MethodError::new(why));
        }
        let playing = self.playing(rule, wanted)?;
        let max_walls = self.ground.walls.most_met() + self.ground.obstacles.most_met();
        Tree::new(playing, &Limits { max_walls, budget_moves: None, until }).map_err(MethodError::new)
    }

    /// A team that follows `rule` in it; of its demands those are looked at that are `wanted`, or all if none is.
    ///
    /// # Errors
    /// [`MethodError`] as of [`Self::starts`], or if there is no start, or no such demand, or if states would be
    /// searched for several demands on endless runs.
    pub fn playing(&'a self, rule: &R, wanted: &[Promise]) -> Result<TeamWorld<'a, R>, MethodError> {
        let starts = self.starts(rule)?;
        let start =
            starts.into_iter().next().ok_or_else(|| MethodError::new("there is no layout to start in"))?;
        self.playing_from(rule, wanted, start)
    }

    /// A team as of [`Self::playing`] that begins so.
    fn playing_from(
        &'a self,
        rule: &R,
        wanted: &[Promise],
        start: Scene<R>,
    ) -> Result<TeamWorld<'a, R>, MethodError> {
        let demands = self.demands.len();
        if let Some(Promise(none)) = wanted.iter().find(|promise| promise.0 >= demands) {
            return Err(MethodError::new(format_args!(
                "there is no demand {none}: the setting has {demands}"
            )));
        }
        let wanted = if wanted.is_empty() { (0..demands).map(Promise).collect() } else { wanted.to_vec() };
        let is_endless = |promise: &&Promise| self.demands[promise.0].is_broken_by_endless_runs();
        if self.strategy() == Strategy::States && wanted.iter().filter(is_endless).count() > 1 {
            let why = "states are searched for one demand on endless runs at a time: name it";
            return Err(MethodError::new(why));
        }
        Ok(TeamWorld { setting: self, rule: rule.clone(), wanted, start })
    }

    /// A team that follows `rule` from these cells, to these goals if there are any, in a layout of any size that
    /// answers for itself. All its demands are looked at.
    pub fn in_layout(&'a self, rule: &R, starts: &[Cell], goals: Vec<Cell>) -> TeamWorld<'a, R> {
        let wanted = (0..self.demands.len()).map(Promise).collect();
        TeamWorld { setting: self, rule: rule.clone(), wanted, start: Self::scene(rule, starts, goals, None) }
    }
}
