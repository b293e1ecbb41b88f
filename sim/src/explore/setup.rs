//! A run before its start: what is chosen in it where nobody says, whether it fits its scheme, and how it is made.

use std::ops::RangeInclusive;
use std::{fmt, slice};

use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_kernel::ground::Cell;
use tautline_proofs::plural::counted;

use super::{
    ClauseId, Limits, RandomPart, Report, Rule, RuleId, Scheme, Senses, Setup, Starts, Survey, Team,
    TeamMove, Watcher, run,
};
use crate::options::{Extra, Options};
use tautline_grids::chance::Probability;
use tautline_grids::layout::Layout;

/// Why nothing that is heard has an effect on one robot, and what would be right.
pub(super) const ALONE: (&str, &str) = ("one robot hears nobody", "leave it out, or take more `robots`");

/// The fault of a field that has no effect, why it has none, and what would be right.
pub(super) fn needless(field: &'static str, (why, remedy): (&str, &str)) -> Diagnostic {
    Diagnostic::of_field(field, format_args!("`{field}` has no effect: {why}"), remedy)
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

    /// This run with robots in these `starts`.
    pub(crate) fn starting_in(self, starts: Vec<Cell>) -> Self {
        let is_elsewhere = starts.iter().any(|&start| start != self.base);
        let starts = Some(starts).filter(|_| is_elsewhere || self.scheme.starts == Starts::Alone);
        Self { starts, ..self }
    }

    /// The title of a picture of the run.
    pub fn title(&self) -> String {
        let Self { scheme, rule, robots, .. } = self;
        format!("{} ({rule}), {}", scheme.name, counted(*robots, scheme.look.robot()))
    }

    /// Where the robots start.
    pub fn starts(&self) -> Vec<Cell> {
        self.starts.clone().unwrap_or_else(|| vec![self.base; self.robots.into()])
    }

    /// The base of a run in `layout`: the one asked for, or that of the layout, or the free cell nearest the centre.
    ///
    /// # Errors
    /// [`Diagnostic`] if it is not a free cell.
    pub fn choose_base(layout: &mut Layout, asked: Option<Cell>) -> Result<Cell, Diagnostic> {
        let base = asked.or(layout.base()).map_or_else(|| layout.default_base(), Ok)?;
        layout.place_base(base)?;
        Ok(base)
    }
}

/// Robots of a team when nobody says how many, if a team of the scheme can have so many: those of the chain's paper.
const DEFAULT_ROBOTS: u16 = 8;

/// An exploration that is asked for.
#[derive(Clone, Debug)]
pub struct ExplorationRequest {
    /// The scheme.
    pub scheme: Scheme,
    /// One of its rules.
    pub rule: RuleId,
    /// Robots, the base counted if there is one. Else the layout says, or there are 8, or as many as
    /// a team of the scheme can have.
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
    /// The options that the run is told.
    pub options: Options,
    /// When the run is stopped.
    pub limits: Limits,
}

impl ExplorationRequest {
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

    /// The request that makes `setup`, but for its layout, its limits, and what a search has chosen in it.
    pub fn again(setup: &Setup) -> Self {
        let Setup { scheme, rule, robots, seed, base, starts, miss, options, .. } = setup.clone();
        let starts = starts.unwrap_or_default();
        let base = starts.is_empty().then_some(base);
        let miss = (!miss.is_never()).then_some(miss);
        Self { robots: Some(robots.into()), seed, base, starts, miss, options, ..Self::new(scheme, rule) }
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
        let usual = || usize::from(DEFAULT_ROBOTS).clamp(*scheme.robots.start(), *scheme.robots.end()) as u64;
        let robots = self.robots.or(layout.robots().map(u64::from)).unwrap_or_else(usual);
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
    /// The setup that makes it.
    fn setup(&self) -> &Setup;

    /// Makes the run. `watch` sees every team move, and may stop the run for good.
    ///
    /// # Errors
    /// [`Halt`] if the run cannot be made, or whatever `watch` returned.
    fn play(&self, watch: &mut Watcher<'_>) -> Result<Report, Halt>;

    /// Makes the run as far as the last of `moves`, and lets `watch` see those.
    ///
    /// # Errors
    /// As of [`Play::play`].
    fn among(&self, moves: &RangeInclusive<u32>, watch: &mut Watcher<'_>) -> Result<(), Halt> {
        let mut is_over = false;
        let made = self.play(&mut |made| {
            is_over = made.step > *moves.end();
            match (is_over, moves.contains(&made.step)) {
                (true, _) => Err(Halt::Interrupted),
                (false, true) => watch(made),
                (false, false) => Ok(()),
            }
        });
        match made {
            Err(Halt::Interrupted) if is_over => Ok(()),
            made => made.map(drop),
        }
    }

    /// How a team move breaks a clause, one line for each pair or cell.
    fn lines(&self, _clause: ClauseId, _chart: &Survey, _made: &TeamMove<'_>) -> Vec<String> {
        Vec::new()
    }

    /// The sentence that `clause` stands for, if it is known.
    fn sentence(&self, clause: ClauseId) -> Option<&str> {
        clause.sentence()
    }

    /// How many of the last team moves come again and again, if the run goes round for ever and says so.
    fn round(&self) -> usize {
        0
    }

    /// The noun for the cells that the end of the run must not miss by a clause, and those that it misses.
    fn missed(&self, _clause: ClauseId, _chart: &Survey) -> Option<(&'static str, Vec<Cell>)> {
        None
    }
}

impl fmt::Debug for dyn Play + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.setup().fmt(f)
    }
}

/// The team of `setup` at its start.
///
/// # Errors
/// A [`Diagnostic`] if the setup does not fit its scheme.
pub fn team(setup: &Setup) -> Result<Box<dyn Team>, Diagnostic> {
    (setup.check()?.start)(setup)
}

/// Runs `setup`. `watch` sees every team move, and may stop the run for good.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme, or whatever `watch` returned.
pub fn explore(setup: &Setup, watch: &mut Watcher<'_>) -> Result<Report, Halt> {
    run(&mut *team(setup)?, &setup.layout, setup.limits, watch)
}

impl Play for Setup {
    fn setup(&self) -> &Setup {
        self
    }

    fn play(&self, watch: &mut Watcher<'_>) -> Result<Report, Halt> {
        explore(self, watch)
    }

    fn lines(&self, clause: ClauseId, chart: &Survey, made: &TeamMove<'_>) -> Vec<String> {
        self.scheme.clause(clause).map_or_else(Vec::new, |clause| (clause.lines)(self, chart, made))
    }

    fn missed(&self, clause: ClauseId, chart: &Survey) -> Option<(&'static str, Vec<Cell>)> {
        let words = self.scheme.clause(clause)?.missed?;
        Some((words, team(self).ok()?.missed(&self.layout, chart)))
    }
}

/// The fault of choices that no search has made.
pub(super) fn of_choices(what: impl fmt::Display) -> Diagnostic {
    Diagnostic::of_field("choices", what, "hunt again: choices come from a counterexample alone")
}

impl Scheme {
    /// The fault of a seed by which nothing is drawn.
    pub fn needless_seed(self) -> Diagnostic {
        let name = self.name;
        let drawn: Vec<String> = self.drawn.iter().map(RandomPart::to_string).collect();
        let drawn = match drawn[..] {
            [] => format!(": in runs of {name} nothing is drawn but layouts, such as cells:15x15:0.1"),
            [..] => format!("; of {name} there would be drawn: {}", drawn.join("; ")),
        };
        let remedy = format!("leave it out{drawn}");
        Diagnostic::of_field("seed", "`seed` has no effect: nothing here is left to chance", remedy)
    }

    /// The fault of sensors that are missed where there are none; `what` says what is to be left out.
    fn no_sensors(self, field: &'static str, what: &str) -> Diagnostic {
        let wrong = format!("the {}s of a {} have no floor sensors to miss", self.look.robot(), self.team);
        let remedy = format!("take {}, or leave out {what}", self.sensing(Senses::Floor));
        Diagnostic::of_field(field, wrong, remedy)
    }
}

impl Setup {
    /// The rule of its scheme, if everything fits that.
    ///
    /// # Errors
    /// A [`Diagnostic`] that names the first field that does not fit.
    pub fn check(&self) -> Result<&'static Rule, Diagnostic> {
        self.scheme.count(self.robots.into())?;
        let rule = self.scheme.find_rule(self.rule)?;
        self.check_misses()?;
        self.check_extras()?;
        self.check_starts()?;
        Ok(rule)
    }

    /// Refuses an option that is told and has no effect in this run.
    ///
    /// # Errors
    /// A [`Diagnostic`] that says why it has none.
    pub fn check_effect(&self, extra: &Extra) -> Result<(), Diagnostic> {
        let is_deaf = self.robots == 1 && [Extra::RANGE, Extra::LOSS].contains(&extra);
        let why = if is_deaf { Some(ALONE) } else { (self.scheme.needless)(self, extra) };
        why.map_or(Ok(()), |why| Err(needless(extra.field, why)))
    }

    /// Refuses missed sensors where there are none, and those that make no run.
    fn check_misses(&self) -> Result<(), Diagnostic> {
        let Self { scheme, missed, .. } = self;
        match scheme.senses {
            Senses::Bumps if !self.miss.is_never() => Err(scheme.no_sensors("miss", "how likely that is")),
            Senses::Bumps if !missed.is_empty() => Err(scheme.no_sensors("missed", "what is missed")),
            Senses::Floor if self.miss.is_certain() && self.limits.max_moves.is_none() => {
                let remedy = "give a probability below 1, or end the run by `max-moves`";
                Err(Diagnostic::of_field("miss", "agents that miss every sensor go on for ever", remedy))
            }
            Senses::Floor if missed.first() == Some(&0) || !missed.is_sorted_by(|a, b| a < b) => {
                let what = "the numbers of the sensors that are missed are not in order";
                Err(Diagnostic::of_field("missed", what, "number them from 1 on, in order, each once"))
            }
            Senses::Bumps | Senses::Floor => Ok(()),
        }
    }

    /// Refuses walls between cells, which `robots` do not know.
    ///
    /// # Errors
    /// A [`Diagnostic`] with the `example` of a layout that they know.
    pub(super) fn refuse_walls(&self, robots: &str, example: &str) -> Result<(), Diagnostic> {
        if self.layout.walls().next().is_none() {
            return Ok(());
        }
        let what = format!("this layout has walls between cells: for {robots} an obstacle fills a cell");
        let remedy = format!("take a layout with blocked cells, such as {example}");
        Err(Diagnostic::of_field("layout", what, remedy))
    }

    /// Refuses what the scheme cannot be told, and what is out of bounds.
    fn check_extras(&self) -> Result<(), Diagnostic> {
        let Self { scheme, robots, layout, options, .. } = self;
        let is_refused = |extra: &&Extra| extra.is_told_by(options) && !scheme.extras.contains(extra);
        if let Some(extra) = Extra::ALL.into_iter().find(is_refused) {
            let what = format!("`{}` says nothing to the scheme {}", extra.field, scheme.name);
            let names = scheme.among.names(|scheme| scheme.extras.contains(&extra));
            let remedy = format!("take the scheme {}, or leave it out", names.join(" or "));
            return Err(Diagnostic::of_field(extra.field, what, remedy));
        }
        let wrong = |extra: &Extra| {
            let (what, remedy) = (extra.wrong)(options, *robots, layout)?;
            Some(Diagnostic::of_field(extra.field, what, remedy))
        };
        Extra::ALL.into_iter().find_map(wrong).map_or(Ok(()), Err)
    }

    /// Refuses starts that the scheme does not have.
    fn check_starts(&self) -> Result<(), Diagnostic> {
        let Self { scheme, robots, .. } = self;
        let robot = scheme.look.robot();
        let wrong = |what: String, remedy: &str| Err(Diagnostic::of_field("starts", what, remedy));
        let is_alone = scheme.starts == Starts::Alone;
        let (starts, is_for_each) = match (scheme.starts, self.starts.as_deref()) {
            (Starts::Base, None) => return Ok(()),
            (Starts::Base, Some(_)) => {
                let what = format!("the {robot}s of a {} start at the base", scheme.team);
                return wrong(what, "give the base another place by `base`");
            }
            (Starts::Alone | Starts::Beside, Some(starts)) if self.is_full(starts) => {
                let (robots, cells) = (counted(*robots, "robot"), starts.len());
                let reached = counted(cells, "cell");
                let what = format!("{robots} do not find room: from the base {reached} can be reached");
                let remedy = format!("give `robots` a number up to {cells}, or take a larger layout");
                return Err(Diagnostic::of_field("robots", what, remedy));
            }
            (Starts::Anywhere | Starts::Beside | Starts::Alone, given) => {
                let is_for_each = given.map_or(!is_alone, |starts| starts.len() == usize::from(*robots));
                (given.unwrap_or(slice::from_ref(&self.base)), is_for_each)
            }
        };
        if !is_for_each {
            let for_all = if is_alone { "give each" } else { "give one start for all, or one for each" };
            let own = if is_alone { " a start of its own" } else { "" };
            let what = format!("{} for {}", counted(starts.len(), "start"), counted(*robots, robot));
            return wrong(what, &format!("{for_all} {robot}{own}"));
        }
        for &start in starts {
            let refused = self.layout.check_start(start);
            refused.or_else(|problem| wrong(problem.what().to_owned(), problem.remedy()))?;
        }
        let is_again = |&(place, start): &(usize, &Cell)| starts[..place].contains(start);
        starts.iter().enumerate().find(is_again).filter(|_| is_alone).map_or(Ok(()), |(_, cell)| {
            wrong(format!("two robots start in the cell {cell}"), "give each robot a start of its own")
        })
    }

    /// Whether there are fewer starts than robots since there is no more room.
    fn is_full(&self, starts: &[Cell]) -> bool {
        let is_default = self.scheme.default_starts(self.rule, &self.layout, self.base, self.robots);
        starts.len() < self.robots.into() && is_default.is_some_and(|found| found == starts)
    }
}
