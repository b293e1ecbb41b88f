//! Small lattices: all layouts of so many nodes, all starts, all orders of decisions and arrivals (KIT-1 to KIT-3,
//! KIT-6 to KIT-8, KIT-10 to KIT-12). A counterexample has the fewest nodes, of these the fewest walls, and of these
//! the fewest steps.

use tautline_kernel::kit::Rule;

use super::counterexample::Counterexample;
use super::world::{Answers, Demand, Setting, Speeds, Starts, World};
use crate::decide::{
    self, Answer, Context, Depiction, DrawnCertificate, Evidence, Method, MethodError, MethodResult,
    RefutationPlay, Systems,
};
use crate::engine::model::StatesModel;
use crate::engine::smallest::{Class, ClassFindings, Most, smallest};
use crate::engine::states::{AnySystem, END, Findings, Limits, search};
use crate::engine::{Choices, Script, ScriptError, Until};
use crate::judge::AnyCase;
use crate::plural::counted;
use crate::run::ScriptedRun;

/// Columns, rows, and the most walls that one run meets.
pub(super) type Size = (i16, i16, u8);

/// Lattices to look at, and what is demanded of teams on them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Lattices<const ROBOTS: usize> {
    /// Fewest nodes first.
    pub(super) sizes: &'static [Size],
    pub(super) speeds: Speeds,
    pub(super) answers: Answers,
    pub(super) starts: Starts,
    pub(super) demand: Demand,
    /// Whether other clauses are about the same teams, so that one pass answers all.
    pub(super) pass: Pass,
    /// The situations that must occur.
    pub(super) covers: &'static [&'static str],
}

/// How many demands are looked at in one pass.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Pass {
    /// One.
    Alone,
    /// All, as long as none is broken.
    Together,
}

/// A run that breaks something, and the choices that make it, if there is one.
type FirstBreach<const ROBOTS: usize> = Option<(Choices, Counterexample<ROBOTS>)>;

impl<const ROBOTS: usize> Lattices<ROBOTS> {
    /// The teams on one lattice.
    fn setting(&self, rule: &Rule, size: Size, demand: Option<Demand>) -> Option<Setting<ROBOTS>> {
        let (width, height, max_walls) = size;
        let Self { speeds, answers, starts, .. } = *self;
        let open = Setting::new(*rule, (width, height))?;
        Some(Setting { max_walls, speeds, answers, starts, demand, ..open })
    }

    /// Looks at these lattices in their order, until something is broken.
    fn look(
        &self,
        rule: &Rule,
        demand: Option<Demand>,
        (until, limits): (Until, Limits<'_>),
    ) -> (Findings<Demand>, FirstBreach<ROBOTS>) {
        let mut looked = Findings::NONE;
        for (number, &(width, height, most)) in (0..).zip(self.sizes) {
            // Mostly nothing is broken; where it is, the fewest walls are looked for, unless one violation is enough.
            let all = self.search(rule, (width, height, most), demand, (limits, &mut looked));
            if all.is_none() {
                continue;
            }
            let mut tried = if until == Until::Exhausted { 0..most } else { 0..0 };
            let fewer = tried.find_map(|walls| {
                let size = (width, height, walls);
                self.search(rule, size, demand, (limits, &mut looked)).map(|found| (walls, found))
            });
            let Some((walls, found)) = fewer.or_else(|| all.map(|found| (most, found))) else {
                continue;
            };
            let choices = found.run.choices_after(&[number, walls.into()]);
            return (looked, Some((choices, found)));
        }
        (looked, None)
    }

    /// The first run that breaks something on one lattice.
    fn search(
        &self,
        rule: &Rule,
        size: Size,
        demand: Option<Demand>,
        (limits, looked): (Limits<'_>, &mut Findings<Demand>),
    ) -> Option<Counterexample<ROBOTS>> {
        let setting = self.setting(rule, size, demand)?;
        let mut found = search(&setting, setting.starts(), limits);
        let run = found.broken.drain(..).next();
        looked.add(found);
        Some(Counterexample { setting, run: run? })
    }

    fn answer(&self, looked: &Findings<Demand>, broken: FirstBreach<ROBOTS>) -> Answer {
        let is_covered = self.covers.iter().chain(&[END]).all(|situation| looked.covered.contains(situation));
        let evidence = broken.map(|(choices, found)| evidence(choices, &found));
        Answer::new(evidence, looked.is_whole && is_covered, Method::<Rule>::shows(self), looked.states)
    }
}

impl<const ROBOTS: usize> Method<Rule> for Lattices<ROBOTS> {
    fn engine(&self) -> &'static str {
        "states"
    }

    fn bound(&self) -> String {
        let sizes: Vec<String> = self
            .sizes
            .iter()
            .map(|&(width, height, walls)| {
                let edges = width * (height - 1) + height * (width - 1);
                match i16::from(walls) {
                    walls if walls == edges => format!("{width}×{height}"),
                    walls => format!("{width}×{height} (at most {})", counted(walls, "wall")),
                }
            })
            .collect();
        let robots = counted(ROBOTS as u64, "robot");
        let speeds = match self.speeds {
            Speeds::Any => "any speeds",
            Speeds::Equal => "equal speeds",
            Speeds::OneByOne => "one drive at a time",
        };
        let answers = match self.answers {
            Answers::AnyTime => "",
            Answers::AtOnce => ", answered at once",
            Answers::TrueNews => ", true news",
        };
        let starts = match self.starts {
            Starts::Anywhere => "all starts",
            Starts::SideBySide => "all starts side by side",
        };
        let at_nodes = if self.demand == Demand::AtNodes { ", where both stand" } else { "" };
        format!("all layouts of {} nodes, {starts}, {robots}, {speeds}{answers}{at_nodes}", sizes.join(", "))
    }

    fn family(&self, rule: &Rule) -> Option<String> {
        let Self { sizes, speeds, answers, starts, .. } = self;
        (self.pass == Pass::Together)
            .then(|| format!("kit {ROBOTS} {sizes:?} {speeds:?} {answers:?} {starts:?} {rule:?}"))
    }

    /// The choices are the numbers of the lattice, of the most walls, of the start, and of the steps.
    fn decide(&self, rule: &Rule, until: Until, context: &mut Context<'_, '_>) -> MethodResult {
        let limits = Limits { memory: context.memory, ..Limits::NONE };
        if self.pass == Pass::Together && until == Until::Exhausted {
            let key = (self.family(rule), *rule);
            let kept: Result<&(Findings<Demand>, FirstBreach<ROBOTS>), MethodError> =
                context.cache.recall(key, |_| Ok(self.look(rule, None, (until, limits))));
            if let (looked, None) = kept? {
                return Ok(self.answer(looked, None));
            }
        }
        let (looked, broken) = self.look(rule, Some(self.demand), (until, limits));
        Ok(self.answer(&looked, broken))
    }

    fn systems(&self, rule: &Rule) -> Result<Systems, MethodError> {
        let started = |&size: &Size| -> Result<Box<dyn AnySystem>, MethodError> {
            let setting = self.setting(rule, size, Some(self.demand));
            let setting = setting.ok_or_else(|| MethodError::new("the lattice is too large"))?;
            Ok(Box::new(StatesModel::new(setting, Setting::starts)))
        };
        self.sizes.iter().map(started).collect()
    }

    fn replay(&self, rule: &Rule, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let (of, found) = self.found(rule, choices)?;
        Ok(RefutationPlay { of, evidence: evidence(choices.clone(), &found) })
    }

    fn case(&self, rule: &Rule, choices: &Choices) -> Option<Box<dyn AnyCase>> {
        self.found(rule, choices).ok()?.1.case()
    }

    fn size(&self, rule: &Rule, choices: &Choices) -> Option<decide::Size> {
        let (_, Counterexample { setting, run }) = self.found(rule, choices).ok()?;
        let class = Class { area: setting.area, barriers: setting.max_walls.into(), robots: ROBOTS };
        Some((class.to_string(), run.length()))
    }

    fn smallest(&self, rule: &Rule) -> Result<Option<DrawnCertificate>, MethodError> {
        // In which order three robots of one speed arrive is not modelled.
        let robots = if self.speeds == Speeds::Equal { 1..=2 } else { 1..=3 };
        let most = Most { cells: 10, barriers: 4, robots };
        let of = |class: Class, _| match class.robots {
            1 => Ok(Lattices::<1>::of(self).shortest(rule, class)),
            2 => Ok(Lattices::<2>::of(self).shortest(rule, class)),
            _ => Ok(Lattices::<3>::of(self).shortest(rule, class)),
        };
        Ok(Some(smallest(&most, of)?.drawn_by_cells(|story| story)))
    }

    fn scripted(&self, rule: &Rule, choices: &Choices) -> Option<ScriptedRun> {
        self.found(rule, choices).ok()?.1.scripted()
    }
}

impl<const ROBOTS: usize> Lattices<ROBOTS> {
    /// This demand on so many robots.
    const fn of<const OTHERS: usize>(other: &Lattices<OTHERS>) -> Self {
        let Lattices { sizes, speeds, answers, starts, demand, pass, covers } = *other;
        Self { sizes, speeds, answers, starts, demand, pass, covers }
    }

    /// The shortest run in a class that breaks the demand; nothing where the lattice is too large.
    fn shortest(&self, rule: &Rule, class: Class) -> ClassFindings<String> {
        let ((width, height), walls) = (class.size(), class.barriers as u8);
        let mut looked = Findings::NONE;
        let context = (Limits::NONE, &mut looked);
        let found = self.search(rule, (width, height, walls), Some(self.demand), context);
        let shortest = found.map(|found| (found.run.length(), found.story()));
        ClassFindings { cases: looked.states, is_whole: looked.is_shortest, shortest }
    }

    /// From how many each choice is made, and the run.
    fn found(
        &self,
        rule: &Rule,
        choices: &Choices,
    ) -> Result<(Vec<u32>, Counterexample<ROBOTS>), ScriptError> {
        let mut script = Script::new(choices);
        let (width, height, most) = self.sizes[script.choose(self.sizes.len())?];
        let walls = script.choose(usize::from(most) + 1)? as u8;
        let setting =
            self.setting(rule, (width, height, walls), Some(self.demand)).ok_or(ScriptError::Unbroken)?;
        let starts: Vec<World<ROBOTS>> = setting.starts();
        let number = script.choose(starts.len())?;
        let (of, run) = script.play(&setting, (number, starts[number]), |&demand| demand == self.demand)?;
        Ok((of, Counterexample { setting, run }))
    }
}

fn evidence<const ROBOTS: usize>(choices: Choices, found: &Counterexample<ROBOTS>) -> Evidence {
    Evidence { choices, demand: found.run.demand.words(), seen: Depiction::Story(found.story()) }
}
