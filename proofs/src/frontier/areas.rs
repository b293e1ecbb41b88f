//! Small areas: all obstacles, all starts, all orders of moves, lost messages and wrong fixes (FRONTIER-1 to
//! FRONTIER-5). A counterexample has the fewest cells, of these the fewest obstacles, and of these the fewest steps.

use std::ops::ControlFlow;

use tautline_kernel::frontier::{Map, Rule, Sight, Status, TinyMap};
use tautline_kernel::ground::{Area, Cell};

use super::readings::LITERAL_T;
use super::world::{Demand, Event, Setting, World};
use crate::decide::{
    self, Answer, Context, Depiction, DrawnCertificate, Evidence, Method, MethodError, MethodResult,
    RefutationPlay, Systems,
};
use crate::engine::model::StatesModel;
use crate::engine::smallest::{Class, ClassFindings, Most, smallest};
use crate::engine::states::{AnySystem, Findings, Limits, Run, search};
use crate::engine::{Choices, Script, ScriptError, Until};
use crate::judge::{AnyCase, Floor, frontier as judge};
use crate::plural::{counted, listed};
use crate::run::{self, Ending, ScriptedRun, Words, place};

/// Columns and rows.
pub type Size = (i16, i16);

/// Areas to look at, and what is demanded of teams there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Areas<const ROBOTS: usize> {
    /// Fewest cells first.
    pub(super) sizes: &'static [Size],
    pub(super) max_losses: u8,
    pub(super) max_wrong: u8,
    pub(super) max_small: u8,
    pub(super) max_deaths: u8,
    pub(super) demand: Demand,
    /// The situations that must occur.
    pub(super) covers: &'static [&'static str],
}

/// A run that breaks a demand, and where.
#[derive(Clone, Debug)]
pub struct Counterexample<const ROBOTS: usize> {
    /// The area, with the fewest obstacles of which one run meets so many.
    pub setting: Setting<ROBOTS>,
    /// The run.
    pub run: Run<Demand>,
}

/// The teams of `rule` in one area.
pub fn setting<const ROBOTS: usize>(rule: Rule, (width, height): Size) -> Option<Setting<ROBOTS>> {
    let area = Area::new(Cell::new(0, 0), Cell::new(width - 1, height - 1))?;
    let (max_obstacles, max_losses, max_wrong, max_small, max_deaths) = (TinyMap::CELLS as u8, 0, 0, 0, 0);
    let (demand, given) = (None, None);
    Some(Setting { rule, area, max_obstacles, max_losses, max_wrong, max_small, max_deaths, demand, given })
}

/// The run with the fewest obstacles that breaks what `run` breaks in the area of `setting`. It breaks off where
/// `look`, which searches a setting, does.
pub fn fewest<const ROBOTS: usize>(
    setting: Setting<ROBOTS>,
    run: Run<Demand>,
    mut look: impl FnMut(&Setting<ROBOTS>) -> ControlFlow<(), Findings<Demand>>,
) -> ControlFlow<Run<Demand>, Counterexample<ROBOTS>> {
    let most = setting.max_obstacles.min((setting.area.width() * setting.area.height()) as u8);
    for max_obstacles in 0..most {
        let setting = Setting { max_obstacles, demand: Some(run.demand), ..setting };
        let ControlFlow::Continue(found) = look(&setting) else { return ControlFlow::Break(run) };
        if let Some(run) = found.broken.into_iter().next() {
            return ControlFlow::Continue(Counterexample { setting, run });
        }
    }
    ControlFlow::Continue(Counterexample { setting, run })
}

/// Steps, each with what comes of it.
type Steps<const ROBOTS: usize> = Vec<(Event, World<ROBOTS>)>;

impl<const ROBOTS: usize> Counterexample<ROBOTS> {
    /// The world at the start, each step with what comes of it, and after how many steps those begin that come over and
    /// over.
    pub fn steps(&self) -> Option<(World<ROBOTS>, Steps<ROBOTS>, usize)> {
        let start = self.setting.starts().into_iter().nth(self.run.start)?;
        let (mut world, mut steps) = (start, Vec::new());
        for &number in self.run.steps.iter().chain(self.run.round()) {
            let turned = self.setting.turns(&world).into_iter().nth(number as usize)?;
            world = turned.world;
            steps.push((turned.event, world));
        }
        Some((start, steps, self.run.steps.len()))
    }

    /// This run where the obstacles that it has met are given, and no others: the setting, and the number of each step.
    pub fn given(&self) -> Option<(Setting<ROBOTS>, Vec<u32>)> {
        let (start, steps, _) = self.steps()?;
        let truth = *steps.last().map_or(start.truth(), |(_, world)| world.truth());
        let setting = Setting { given: Some(truth), demand: None, ..self.setting };
        let mut world = start;
        let numbers = steps.iter().map(|(event, _)| {
            let turns = setting.turns(&world);
            let number = turns.iter().position(|turned| turned.event == *event)?;
            world = turns[number].world;
            Some(number as u32)
        });
        let numbers = numbers.collect::<Option<Vec<u32>>>()?;
        Some((setting, numbers))
    }

    /// The choices that make the run in an area that has the obstacles that it met: the first two say how many messages
    /// are lost and how many fixes are wrong at most. Obstacles that are smaller than a cell are in no layout, nor are
    /// deaths.
    pub fn scripted(&self) -> Option<ScriptedRun> {
        if self.setting.max_small > 0 || self.setting.max_deaths > 0 {
            return None;
        }
        let (start, ..) = self.steps()?;
        let (setting, steps) = self.given()?;
        let obstacles = setting.given?;
        let obstacles =
            setting.area.cells().filter(|&cell| obstacles.status(cell) == Status::Obstacle).collect();
        let bounds = [setting.max_losses, setting.max_wrong].map(u32::from);
        let ending = if self.run.round().is_empty() { Ending::Move } else { Ending::Endless };
        let (starts, breaks) = (start.cells().to_vec(), Some(self.run.demand.clause()));
        let (walls, frames) = (Vec::new(), Vec::new());
        let run = run::Run {
            scheme: "frontier",
            area: setting.area,
            starts,
            walls,
            obstacles,
            frames,
            breaks,
            ending,
            words: Words::default(),
        };
        Some(ScriptedRun { run, choices: [&bounds[..], &steps].concat() })
    }

    /// The run by a rule without repairs, written down for the judge.
    fn case(&self) -> Option<Box<dyn AnyCase>> {
        let Setting { rule, area, .. } = self.setting;
        let (start, steps, once) = self.steps()?;
        let truth = steps.last().map_or(start.truth(), |(_, world)| world.truth());
        let barred = area.cells().filter(|&cell| truth.status(cell) == Status::Obstacle).collect();
        let round = steps.len() - once;
        let events: Vec<Event> = steps.into_iter().map(|(event, _)| event).collect();
        let floor = (rule, area, barred);
        case(self.run.demand.clause(), floor, &start.cells(), &events, round, self.setting.max_wrong > 0)
    }

    /// The events, a line for each step.
    pub fn story(&self) -> String {
        let area = self.setting.area;
        let mut lines = format!("{}×{} cells\n", area.width(), area.height());
        let Some((start, steps, once)) = self.steps() else { return lines };
        let starts = (1..).zip(start.cells()).map(|(robot, cell)| format!("R{robot} starts in {cell}"));
        lines += &listed(starts);
        lines.push('\n');
        for (number, (event, world)) in steps.iter().enumerate() {
            if number == once {
                lines += "and from here on over and over:\n";
            }
            if let Some(words) = words(event, &world.cells()) {
                lines += &words;
                lines.push('\n');
            }
        }
        lines
    }
}

/// A run from `starts` by a rule, in an area with obstacles, of which the last `round` steps come again for ever, said
/// to break `clause`: written down for the judge; `None` if it knows no such rule, or a message is lost. `errs` says
/// whether fixes may be off.
pub fn case(
    clause: &'static str,
    (rule, area, barred): (Rule, Area, Vec<Cell>),
    starts: &[Cell],
    events: &[Event],
    round: usize,
    errs: bool,
) -> Option<Box<dyn AnyCase>> {
    let rule = match rule {
        Rule::PUBLISHED => judge::Rule::Published,
        Rule::PRINTED => judge::Rule::Printed,
        Rule::LITERAL => judge::Rule::Literal,
        Rule::WANDERS => judge::Rule::Wanders,
        LITERAL_T => judge::Rule::AdaptiveLiteral,
        _ => return None,
    };
    let barred = barred.into_iter().map(place).collect();
    let floor = Floor { columns: area.width() as i32, rows: area.height() as i32, barred };
    let starts = starts.iter().copied().map(place).collect();
    let steps = events.iter().map(written).collect::<Option<Vec<_>>>()?;
    Some(Box::new(judge::Run { clause, rule, floor, starts, steps, round, errs }))
}

/// An event as the judge reads it, if no message is lost.
fn written(event: &Event) -> Option<judge::Step> {
    let (robot, what, side, fix) = match *event {
        Event::Decides(robot, side, _, 0) => (robot, judge::What::Decides, Some(side as usize), None),
        Event::Looks(robot, _, Sight::Open, ..) => (robot, judge::What::Enters, None, None),
        Event::Looks(robot, _, Sight::Obstacle, 0, _) => (robot, judge::What::IsBarred, None, None),
        Event::Arrives(robot, fix, 0) => (robot, judge::What::Arrives, None, Some(place(fix))),
        Event::Decides(..)
        | Event::Looks(..)
        | Event::Returns(..)
        | Event::Arrives(..)
        | Event::Ticks
        | Event::Dies(_) => return None,
    };
    Some(judge::Step { robot, what, side, fix })
}

/// An event in words; nothing of a robot that has only decided, unless a robot misses that.
pub fn words(event: &Event, cells: &[Cell]) -> Option<String> {
    let missed = |missed: u8| {
        let robots = (0..u8::BITS).filter(|robot| missed >> robot & 1 == 1);
        let each: Vec<String> = robots.map(|robot| format!("; R{} misses the message", robot + 1)).collect();
        each.concat()
    };
    match *event {
        Event::Decides(.., 0) => None,
        Event::Decides(robot, _, aim, lost) => Some(format!("R{} claims {aim}{}", robot + 1, missed(lost))),
        Event::Looks(robot, side, sight, lost, _) => {
            let (name, side) = (robot + 1, run::name_of(side));
            Some(match sight {
                Sight::Open => format!("R{name} goes {side}"),
                Sight::Obstacle => format!("R{name} finds an obstacle in the {side}{}", missed(lost)),
                Sight::Small => {
                    format!("R{name} meets an obstacle smaller than a cell in the {side}{}", missed(lost))
                }
                Sight::Robot => format!("R{name} meets a robot in the {side}{}", missed(lost)),
                Sight::Silent => format!("R{name} meets a dead robot in the {side}{}", missed(lost)),
            })
        }
        Event::Returns(robot, side) => {
            Some(format!("R{} turns back from the rim in the {}", robot + 1, run::name_of(side)))
        }
        Event::Arrives(robot, fix, lost) => {
            let cell = cells.get(robot)?;
            let fixed = if fix == *cell { String::new() } else { format!(", and its fix says {fix}") };
            Some(format!("R{} arrives in {cell}{fixed}{}", robot + 1, missed(lost)))
        }
        Event::Ticks => Some("the slot is over".to_owned()),
        Event::Dies(robot) => Some(format!("R{} dies", robot + 1)),
    }
}

impl<const ROBOTS: usize> Areas<ROBOTS> {
    fn setting(&self, rule: &Rule, size: Size) -> Result<Setting<ROBOTS>, MethodError> {
        let Self { max_losses, max_wrong, max_small, max_deaths, demand, .. } = *self;
        let setting = setting(*rule, size).ok_or_else(|| MethodError::new("the area is too large"))?;
        Ok(Setting { max_losses, max_wrong, max_small, max_deaths, demand: Some(demand), ..setting })
    }

    /// Looks at these areas in their order, until this is broken, or anything where no demand is named: what is found,
    /// and the number of the last area.
    fn look(
        &self,
        rule: &Rule,
        demand: Option<Demand>,
        limits: Limits<'_>,
    ) -> Result<(Findings<Demand>, usize), MethodError> {
        let mut looked = Findings::NONE;
        for (number, &size) in self.sizes.iter().enumerate() {
            let setting = Setting { demand, ..self.setting(rule, size)? };
            looked.add(search(&setting, setting.starts(), limits));
            if !looked.broken.is_empty() {
                return Ok((looked, number));
            }
        }
        Ok((looked, self.sizes.len()))
    }

    fn evidence(choices: Choices, found: &Counterexample<ROBOTS>) -> Evidence {
        Evidence { choices, demand: found.run.demand.words(), seen: Depiction::Story(found.story()) }
    }
}

impl<const ROBOTS: usize> Method<Rule> for Areas<ROBOTS> {
    fn engine(&self) -> &'static str {
        "states"
    }

    fn bound(&self) -> String {
        let sizes = listed(self.sizes.iter().map(|(width, height)| format!("{width}×{height}")));
        let lost = match self.max_losses {
            0 => String::new(),
            lost => format!(", at most {} lost", counted(lost, "message")),
        };
        let wrong = match self.max_wrong {
            0 => String::new(),
            1 => ", at most 1 fix off by one cell".to_owned(),
            wrong => format!(", at most {wrong} fixes off by one cell"),
        };
        let small = match self.max_small {
            0 => String::new(),
            small => format!(", at most {} smaller than a cell", counted(small, "obstacle")),
        };
        let deaths = match self.max_deaths {
            0 => String::new(),
            deaths => format!(", {deaths} of whom may die at any step"),
        };
        let robots = counted(ROBOTS as u64, "robot");
        format!(
            "all obstacles in {sizes} cells, all starts, {robots}{deaths}, every order{lost}{wrong}{small}"
        )
    }

    fn family(&self, rule: &Rule) -> Option<String> {
        let Self { sizes, max_losses, max_wrong, max_small, max_deaths, .. } = self;
        Some(format!("{ROBOTS} {sizes:?} {max_losses} {max_wrong} {max_small} {max_deaths} {rule:?}"))
    }

    /// One search answers the checks of all demands, if it finds none of them broken. Else each demand has its own
    /// search.
    ///
    /// The choices are the numbers of the area, of the most obstacles, of the start, and of the steps.
    fn decide(&self, rule: &Rule, until: Until, context: &mut Context<'_, '_>) -> MethodResult {
        let limits = Limits { memory: context.memory, ..Limits::NONE };
        let answer = |found: &Findings<Demand>, evidence| {
            let is_covered = self.covers.iter().all(|situation| found.covered.contains(situation));
            Answer::new(evidence, found.is_whole && is_covered, Method::<Rule>::shows(self), found.states)
        };
        if until == Until::Exhausted {
            let Self { sizes, max_losses, max_wrong, max_small, max_deaths, .. } = *self;
            let asked = (ROBOTS, sizes, max_losses, max_wrong, max_small, max_deaths, *rule);
            let (found, _) = context.cache.recall(asked, |_| self.look(rule, None, limits))?;
            if found.broken.is_empty() {
                return Ok(answer(found, None));
            }
        }
        let (found, number) = self.look(rule, Some(self.demand), limits)?;
        let Some(run) = found.broken.first() else { return Ok(answer(&found, None)) };
        let setting = self.setting(rule, self.sizes[number])?;
        let look =
            |setting: &Setting<ROBOTS>| ControlFlow::Continue(search(setting, setting.starts(), limits));
        let fewest = match fewest(setting, run.clone(), look) {
            ControlFlow::Continue(fewest) => fewest,
            ControlFlow::Break(run) => Counterexample { setting, run },
        };
        let first = [number as u32, fewest.setting.max_obstacles.into()];
        let evidence = Self::evidence(fewest.run.choices_after(&first), &fewest);
        Ok(answer(&found, Some(evidence)))
    }

    /// The areas in which there is room for the robots.
    fn systems(&self, rule: &Rule) -> Result<Systems, MethodError> {
        let settings =
            self.sizes.iter().map(|&size| self.setting(rule, size)).collect::<Result<Vec<_>, _>>()?;
        let of = |setting| -> Box<dyn AnySystem> { Box::new(StatesModel::new(setting, Setting::starts)) };
        let with_starts = settings.into_iter().filter(|setting| !setting.starts().is_empty());
        Ok(with_starts.map(of).collect())
    }

    fn replay(&self, rule: &Rule, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let (of, found) = self.found(rule, choices)?;
        Ok(RefutationPlay { of, evidence: Self::evidence(choices.clone(), &found) })
    }

    fn case(&self, rule: &Rule, choices: &Choices) -> Option<Box<dyn AnyCase>> {
        self.found(rule, choices).ok()?.1.case()
    }

    fn scripted(&self, rule: &Rule, choices: &Choices) -> Option<ScriptedRun> {
        self.found(rule, choices).ok()?.1.scripted()
    }

    fn size(&self, rule: &Rule, choices: &Choices) -> Option<decide::Size> {
        let (_, Counterexample { setting, run }) = self.found(rule, choices).ok()?;
        let class = Class { area: setting.area, barriers: setting.max_obstacles.into(), robots: ROBOTS };
        Some((class.to_string(), run.length()))
    }

    fn smallest(&self, rule: &Rule) -> Result<Option<DrawnCertificate>, MethodError> {
        let most = Most { cells: 4, barriers: 4, robots: 1..=2 };
        let of = |class: Class, _| match class.robots {
            1 => Areas::<1>::of(self).shortest(rule, class),
            2 => Areas::<2>::of(self).shortest(rule, class),
            _ => Ok(ClassFindings::default()),
        };
        Ok(Some(smallest(&most, of)?.drawn_by_cells(|story| story)))
    }
}

impl<const ROBOTS: usize> Areas<ROBOTS> {
    /// This demand on so many robots.
    const fn of<const OTHERS: usize>(other: &Areas<OTHERS>) -> Self {
        let Areas { sizes, max_losses, max_wrong, max_small, max_deaths, demand, covers } = *other;
        Self { sizes, max_losses, max_wrong, max_small, max_deaths, demand, covers }
    }

    /// The shortest run in a class that breaks the demand.
    fn shortest(&self, rule: &Rule, class: Class) -> Result<ClassFindings<String>, MethodError> {
        let setting = self.setting(rule, class.size())?;
        let setting = Setting { max_obstacles: class.barriers as u8, ..setting };
        let found = search(&setting, setting.starts(), Limits::NONE);
        let run = found.broken.into_iter().next();
        let shortest = run.map(|run| (run.length(), Counterexample { setting, run }.story()));
        Ok(ClassFindings { cases: found.states, is_whole: found.is_shortest, shortest })
    }

    /// From how many each choice is made, and the run.
    fn found(
        &self,
        rule: &Rule,
        choices: &Choices,
    ) -> Result<(Vec<u32>, Counterexample<ROBOTS>), ScriptError> {
        let mut script = Script::new(choices);
        let size = self.sizes[script.choose(self.sizes.len())?];
        let max_obstacles = script.choose(TinyMap::CELLS + 1)? as u8;
        let setting = self.setting(rule, size).map_err(|_| ScriptError::Unbroken)?;
        let setting = Setting { max_obstacles, ..setting };
        let starts = setting.starts();
        let number = script.choose(starts.len())?;
        let (of, run) = script.play(&setting, (number, starts[number]), |&demand| demand == self.demand)?;
        Ok((of, Counterexample { setting, run }))
    }
}
