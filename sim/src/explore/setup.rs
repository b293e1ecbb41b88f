//! A scheme as a row of data, a run of it before its start, and what is chosen in one where nobody says.

use std::fmt;
use std::ops::RangeInclusive;

use serde::{Serialize, Serializer};
use tautline_kernel::ground::Cell;

use super::catalogue::Scheme;
use super::clause::ClauseId;
use super::hunt::Hunt;
use super::rule::RuleId;
use super::run::{Limits, Report, Team, TeamMove, Watcher};
use super::survey::Survey;
use crate::diagnostic::{Diagnostic, Halt};
use crate::kit;
use crate::layout::generate::Probability;
use crate::layout::{Layout, Problem};
use crate::options::{Extra, Options};

/// A scheme: a way for a team to explore. Whatever is not the scheme's own asks this row.
pub struct Profile {
    /// The word for it on the command line and in files.
    pub name: &'static str,
    /// One line about it.
    pub about: &'static str,
    /// Its rules.
    pub rules: &'static [Rule],
    /// What its team is called.
    pub team: &'static str,
    /// How many robots a team can have, the base counted if there is one.
    pub robots: RangeInclusive<usize>,
    /// Where its robots start.
    pub starts: Starts,
    /// How its robots learn of the layout.
    pub senses: Senses,
    /// What a run of it can be told besides.
    pub extras: &'static [&'static Extra],
    /// What its runs draw by their seed.
    pub drawn: &'static [Drawn],
    /// How its team is drawn.
    pub look: Look,
    /// What its team knows of a sensor floor, if it is on one.
    pub knowledge: Option<Knowledge>,
    /// The clauses that its runs can break, in order.
    pub clauses: &'static [Clause],
}

/// A rule of a scheme.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// Its name.
    pub name: RuleId,
    /// One line about it.
    pub about: &'static str,
    /// The team of a setup at its start.
    pub start: Start,
    /// How it is hunted, if it is.
    pub hunt: Option<&'static dyn Hunt>,
}

/// The team of a setup at its start.
pub type Start = fn(&Setup) -> Result<Box<dyn Team>, Diagnostic>;

impl Rule {
    /// A rule that is not hunted.
    pub const fn new(name: RuleId, about: &'static str, start: Start) -> Self {
        Self { name, about, start, hunt: None }
    }

    /// The same rule, which is hunted so.
    pub const fn hunted(self, hunt: &'static dyn Hunt) -> Self {
        Self { hunt: Some(hunt), ..self }
    }

    /// As the paper publishes it.
    pub const fn published(start: Start, hunt: &'static dyn Hunt) -> Self {
        Self::new(RuleId::PUBLISHED, "As the paper publishes it", start).hunted(hunt)
    }

    /// With the repairs of its refuted claims.
    pub const fn repaired(start: Start, hunt: &'static dyn Hunt) -> Self {
        Self::new(RuleId::REPAIRED, "With the repairs of its refuted claims", start).hunted(hunt)
    }
}

/// Where the robots of a team start.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Starts {
    /// All of them at the base.
    Base,
    /// Each in any free cell.
    Anywhere,
    /// Each in any free cell: without another word as published all at the base, and else the first one there and the
    /// others beside it.
    Beside,
    /// Each in a free cell of its own: without another word the first one at the base, and the others beside it.
    Alone,
}

/// Something that runs of a scheme draw by their seed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Drawn {
    /// What it is.
    pub what: &'static str,
    /// In which runs it is drawn.
    pub by: By,
}

/// In which runs something is drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum By {
    /// In all.
    Every,
    /// Where sensors are missed by chance.
    Miss,
    /// Where this is told.
    Told(&'static Extra),
    /// In those of this rule.
    Rule(RuleId),
}

impl Drawn {
    /// Whether it is drawn in a run.
    fn is_in(&self, setup: &Setup) -> bool {
        match self.by {
            By::Every => true,
            By::Miss => !setup.miss.is_never(),
            By::Told(extra) => extra.is_told_by(&setup.options),
            By::Rule(rule) => rule == setup.rule,
        }
    }
}

/// What is drawn, and by which field.
impl fmt::Display for Drawn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, by } = self;
        match by {
            By::Every => f.write_str(what),
            By::Miss => write!(f, "{what}, with `miss`"),
            By::Told(extra) => write!(f, "{what}, with `{}`", extra.field),
            By::Rule(rule) => write!(f, "{what}, with `rule` {rule}"),
        }
    }
}

/// How a team is drawn and told of.
#[derive(Clone, Copy, Debug)]
pub enum Look {
    /// The first robot is the base, the last one leads, and those beside each other in their order have a link.
    Linked {
        /// Whether the link of two robots is lost that go from the first to the second of these pairs of cells.
        is_lost: fn(&[Cell], &[Cell]) -> bool,
    },
    /// The first robot is the base, and links join the robots in a tree.
    Tree {
        /// Whether robots in these cells have a link.
        is_linked: fn(Cell, Cell) -> bool,
    },
    /// Every robot is an agent for itself.
    Apart,
    /// The same, and agents are called robots.
    Robots,
}

impl Look {
    /// Whether the first robot is the base.
    pub const fn has_base(self) -> bool {
        match self {
            Self::Linked { .. } | Self::Tree { .. } => true,
            Self::Apart | Self::Robots => false,
        }
    }

    /// What a robot is called.
    pub const fn robot(self) -> &'static str {
        match self {
            Self::Linked { .. } | Self::Tree { .. } | Self::Robots => "robot",
            Self::Apart => "agent",
        }
    }
}

/// What agents know of a sensor floor in the end.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Knowledge {
    /// Nothing: whoever watches them ends the run.
    None,
    /// Which cells are visited, and when they are done.
    Visited,
}

/// How robots learn of a layout.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Senses {
    /// A robot knows the edges that were tried. What no robot met can go, and the run stays the same.
    Bumps,
    /// Agents read sensors on the floor, and may miss some.
    Floor,
}

/// A clause that a run can break.
#[derive(Clone, Copy, Debug)]
pub struct Clause {
    /// Its id.
    pub id: ClauseId,
    /// Which independent judge reads its counterexamples.
    pub judge: Option<Judge>,
    /// How a team move breaks it, one line for each pair or cell.
    pub told: fn(&Setup, &Survey, &TeamMove<'_>) -> Vec<String>,
    /// If it is about the end of a run: what the cells are that are missed.
    pub missed: Option<&'static str>,
}

/// A judge of counterexamples.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Judge {
    /// The judge of the chain.
    Chain,
    /// The judge of agents, for runs of one agent.
    Agent,
}

impl Clause {
    /// The clause with this id, of which the words of the clause itself tell enough, and which has no judge.
    pub const fn new(id: &'static str) -> Self {
        Self { id: ClauseId::new(id), judge: None, told: |_, _, _| Vec::new(), missed: None }
    }
}

impl Profile {
    /// The rule with this name, if the scheme offers it.
    pub fn rule(&self, name: RuleId) -> Option<&'static Rule> {
        self.rules.iter().find(|rule| rule.name == name)
    }

    /// Whether a run of it draws anything: whether its seed has an effect.
    pub fn draws(&self, setup: &Setup) -> bool {
        self.drawn.iter().any(|drawn| drawn.is_in(setup))
    }

    /// Where `robots` of this rule start in `layout` of which nobody says where, if not all start at the base.
    pub fn default_starts(
        &self,
        rule: RuleId,
        layout: &Layout,
        base: Cell,
        robots: u16,
    ) -> Option<Vec<Cell>> {
        match self.starts {
            Starts::Beside if rule != RuleId::PUBLISHED => Some(kit::starts(layout, base, robots.into())),
            Starts::Alone => Some(kit::starts(layout, base, robots.into())),
            Starts::Base | Starts::Anywhere | Starts::Beside => None,
        }
    }

    /// The clause with this id, if its runs can break it.
    pub fn clause(&self, id: ClauseId) -> Option<&'static Clause> {
        self.clauses.iter().find(|clause| clause.id == id)
    }
}

impl Profile {
    /// A row of which nothing is known but its name, which has robots that are apart.
    pub const fn named(name: &'static str) -> Self {
        Self {
            name,
            about: "",
            rules: &[],
            team: "team",
            robots: 1..=u16::MAX as usize,
            starts: Starts::Anywhere,
            senses: Senses::Bumps,
            extras: &[],
            drawn: &[],
            look: Look::Robots,
            knowledge: None,
            clauses: &[],
        }
    }
}

impl PartialEq for Profile {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Profile {}

impl Serialize for Profile {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}

impl fmt::Debug for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// A run before its start: what stands still while it goes on. The same setup makes the same run.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The scheme.
    pub scheme: Scheme,
    /// One of its rules.
    pub rule: RuleId,
    /// Robots, the base of a chain included.
    pub robots: u16,
    /// The seed of whatever is left to chance.
    pub seed: u64,
    /// The ground truth.
    pub layout: Layout,
    /// Where the robots start that have no start of their own: a free cell.
    pub base: Cell,
    /// Where each agent starts, if not all start at the base: free cells.
    pub starts: Option<Vec<Cell>>,
    /// How likely it is that an agent misses a sensor that it could see.
    pub miss: Probability,
    /// Which sensors are missed besides: their numbers among all that agents ask about, counted from 1, in order.
    pub missed: Vec<u32>,
    /// What else the run is told.
    pub options: Options,
    /// The choices that make the run, where a search has found it; else it is left to chance.
    pub choices: Vec<u32>,
    /// When the run is stopped.
    pub limits: Limits,
}

impl Setup {
    /// A run of `scheme` in `layout` with a base, all robots starting there, nothing missed, and no limits.
    pub fn new(
        scheme: impl Into<Scheme>,
        rule: impl Into<RuleId>,
        robots: u16,
        layout: Layout,
        base: Cell,
    ) -> Self {
        Self {
            scheme: scheme.into(),
            rule: rule.into(),
            robots,
            seed: 0,
            layout,
            base,
            starts: None,
            miss: Probability::NEVER,
            missed: Vec::new(),
            options: Options::default(),
            choices: Vec::new(),
            limits: Limits::default(),
        }
    }

    /// A run of robots in these `starts`, the first of which is the base, by a rule that is in no catalogue: names are
    /// letters, digits and hyphens.
    pub fn named(scheme: &str, rule: &str, layout: Layout, starts: &[Cell]) -> Self {
        let base = starts.first().copied().unwrap_or(Cell::new(0, 0));
        let setup = Self::new(Scheme::named(scheme), RuleId::read(rule), starts.len() as u16, layout, base);
        setup.starting_in(starts.to_vec())
    }

    /// The same run with robots in these `starts`.
    pub(crate) fn starting_in(self, starts: Vec<Cell>) -> Self {
        let is_elsewhere = starts.iter().any(|&start| start != self.base);
        let starts = Some(starts).filter(|_| is_elsewhere || self.scheme.starts == Starts::Alone);
        Self { starts, ..self }
    }

    /// Where the robots start.
    pub fn starts(&self) -> Vec<Cell> {
        self.starts.clone().unwrap_or_else(|| vec![self.base; self.robots.into()])
    }

    /// The base of a run in `layout`: the one asked for, or that of the layout, or the free cell nearest the centre.
    ///
    /// # Errors
    /// [`Problem`] if it is not a free cell.
    pub fn choose_base(layout: &mut Layout, asked: Option<Cell>) -> Result<Cell, Problem> {
        let base = match asked.or(layout.base()) {
            Some(base) => base,
            None => layout.default_base()?,
        };
        layout.place_base(base)?;
        Ok(base)
    }
}

/// Robots of a team when nobody says how many: the team of the paper.
const DEFAULT_ROBOTS: u16 = 8;

/// What is asked of an exploration.
#[derive(Clone, Debug)]
pub struct Asked {
    /// The scheme.
    pub scheme: Scheme,
    /// One of its rules.
    pub rule: RuleId,
    /// Robots, the base counted if there is one. Else the layout says, or there are 8.
    pub robots: Option<u64>,
    /// The seed of whatever is left to chance.
    pub seed: u64,
    /// The base. Else it is where the first robot starts, or the layout says, or it is the free cell nearest the
    /// centre.
    pub base: Option<Cell>,
    /// Where the agents start: one cell for all, or one for each; none if the scheme is to choose.
    pub starts: Vec<Cell>,
    /// How likely it is that an agent misses a sensor.
    pub miss: Option<Probability>,
    /// What else the run is told.
    pub options: Options,
    /// When the run is stopped.
    pub limits: Limits,
}

impl Asked {
    /// A run of `rule` of which nothing else is said.
    pub fn new(scheme: impl Into<Scheme>, rule: impl Into<RuleId>) -> Self {
        Self {
            scheme: scheme.into(),
            rule: rule.into(),
            robots: None,
            seed: 0,
            base: None,
            starts: Vec::new(),
            miss: None,
            options: Options::default(),
            limits: Limits::default(),
        }
    }

    /// Refuses what fits no layout.
    ///
    /// # Errors
    /// A [`Diagnostic`] that says why.
    pub fn check(&self) -> Result<(), Diagnostic> {
        if self.scheme.senses == Senses::Bumps && self.miss.is_some() {
            return Err(self.scheme.no_sensors("miss", "how likely that is"));
        }
        Ok(())
    }

    /// The run in `layout`, before its start.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it does not fit its scheme or its layout.
    pub fn setup(self, mut layout: Layout) -> Result<Setup, Diagnostic> {
        self.check()?;
        let Self { scheme, rule, seed, starts, options, limits, .. } = self;
        let robots = self.robots.unwrap_or_else(|| layout.robots().unwrap_or(DEFAULT_ROBOTS).into());
        let robots = scheme.count(robots)?;
        if let Some(&first) = starts.first() {
            layout.check_start(first)?;
        }
        let base = Setup::choose_base(&mut layout, self.base.or(starts.first().copied()))?;
        let starts = match (scheme.starts, starts.len()) {
            (_, 0) => scheme.default_starts(rule, &layout, base, robots),
            (Starts::Anywhere | Starts::Beside, 1) => None,
            (Starts::Base | Starts::Anywhere | Starts::Beside | Starts::Alone, _) => Some(starts),
        };
        let miss = self.miss.unwrap_or(Probability::NEVER);
        let setup =
            Setup { seed, starts, miss, options, limits, ..Setup::new(scheme, rule, robots, layout, base) };
        setup.check()?;
        Ok(setup)
    }
}

/// A run that can be made as often as it is drawn: by its rule, or from what is stored of it.
pub trait Play {
    /// What makes it.
    fn setup(&self) -> &Setup;

    /// Makes the run. `watch` sees every team move, and may stop the run for good.
    ///
    /// # Errors
    /// [`Halt`] if the run cannot be made, or whatever `watch` returned.
    fn play(&self, watch: &mut Watcher<'_>) -> Result<Report, Halt>;

    /// How the team move `made` breaks `clause`, one line for each pair or cell.
    fn told(&self, clause: ClauseId, chart: &Survey, made: &TeamMove<'_>) -> Vec<String> {
        let _ = (clause, chart, made);
        Vec::new()
    }

    /// What the cells are that the end of the run must not miss by `clause`, and those that it misses.
    fn missed(&self, clause: ClauseId, chart: &Survey) -> Option<(&'static str, Vec<Cell>)> {
        let _ = (clause, chart);
        None
    }
}

impl fmt::Debug for dyn Play + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.setup().fmt(f)
    }
}
