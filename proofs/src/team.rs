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

use std::rc::Rc;
use std::{fmt, iter};

use serde::{Deserialize, Serialize};
use tautline_kernel::ground::Cell;

pub use self::check::Keeps;
pub use self::graph::{Crew, Deployment, Graph, Graphs, Kind, KnownGraph, Task, Teams, conflicts};
pub use self::ground::{Assumption, Ground, Map, Which};
use self::rule::When;
pub use self::rule::{Act, Body, Cover, Demand, Rule, Scene, Senses, TeamState, TeamStep, View};
pub use self::world::{Event, Part, TeamWorld};
use crate::decide::MethodError;
use crate::engine::states::Bits;

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

impl<R: Rule> Setting<'_, R> {
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
            if matches!(self.demands[number].when, When::Eventually(_) | When::AgainAndAgain(_)) {
                return true;
            }
            number += 1;
        }
        false
    }

    /// The cells in which robots may be placed, for each way to place them.
    fn placed(
        &self,
        places: &Places<R>,
        rule: &R,
        map: &Map,
    ) -> Result<Box<dyn Iterator<Item = Vec<Cell>>>, MethodError> {
        let robots = self.robots;
        let is_distinct = match places {
            Places::None => return Ok(Box::new(iter::once(Vec::new()))),
            Places::At(cells) => {
                let cells = cells(rule);
                let why = format_args!("{robots} robots are placed in {} cells", cells.len());
                MethodError::unless(cells.len() == robots, why)?;
                if let Some(outside) = cells.iter().find(|&&cell| map.cell(cell) == Some(false)) {
                    let why = if map.area().contains(*outside) {
                        "which is blocked"
                    } else {
                        "outside of the area"
                    };
                    return Err(MethodError::new(format_args!("a robot starts in {outside}, {why}")));
                }
                return Ok(Box::new(iter::once(cells)));
            }
            Places::Any => false,
            Places::Distinct => true,
        };
        let free: Rc<[Cell]> = map.free().into();
        if is_distinct && free.len() < robots {
            return Ok(Box::new(iter::empty()));
        }
        let one: Box<dyn Iterator<Item = Vec<Cell>>> = Box::new(iter::once(Vec::new()));
        Ok((0..robots).fold(one, |rows, _| {
            let free = Rc::clone(&free);
            Box::new(rows.flat_map(move |row| {
                let fits = |cell: &&Cell| !is_distinct || !row.contains(cell);
                let longer = |&cell: &Cell| [&row[..], &[cell]].concat();
                free.iter().filter(fits).map(longer).collect::<Vec<_>>()
            }))
        }))
    }

    /// The layouts that are decided before a run begins, in each of which robots can be placed as they are to be.
    ///
    /// # Errors
    /// [`MethodError`] as of [`Self::starts`].
    fn maps(&self, rule: &R) -> Result<Vec<Map>, MethodError> {
        let why = format_args!("a team has 1 to {MOST_ROBOTS} robots, not {}", self.robots);
        MethodError::unless((1..=MOST_ROBOTS).contains(&self.robots), why)?;
        let maps = self.ground.maps()?;
        for map in &maps {
            for places in [&self.starts, &self.goals] {
                drop(self.placed(places, rule, map)?);
            }
        }
        Ok(maps)
    }

    /// Every scene in which a run begins: of every layout that is decided before, with every start and goal. Each is
    /// made when it is asked for: they may be more than memory has room for.
    ///
    /// # Errors
    /// [`MethodError`] if the area, the number of robots or the number of layouts
    /// is too large, or a robot starts outside.
    pub fn starts(&self, rule: &R) -> Result<impl IntoIterator<Item = Scene<R>>, MethodError> {
        Ok(self.maps(rule)?.into_iter().flat_map(move |map| {
            let placed = move |places| self.placed(places, rule, &map).into_iter().flatten();
            placed(&self.starts).flat_map(move |starts| {
                placed(&self.goals).map(move |goals| {
                    let mut map = map;
                    for &cell in starts.iter().chain(&goals) {
                        map.note_cell(cell, true);
                    }
                    Self::scene(rule, &starts, goals, Some(&map))
                })
            })
        }))
    }

    fn scene(rule: &R, starts: &[Cell], goals: Vec<Cell>, map: Option<&Map>) -> Scene<R> {
        let body = |(robot, &cell)| Body::new(cell, rule.start(robot, starts));
        let bodies = starts.iter().enumerate().map(body).collect();
        TeamState { bodies, goals, map: map.copied(), losses: 0, deaths: 0 }
    }
}
