//! The checks of agents on small floors, whatever their scheme: which plans, how many agents, what they miss, whether
//! they fail, and what is demanded of every state.

use tautline_kernel::ground::{Area as Rect, Cell};

use super::plans::{Area, FloorPlan};
use super::search::Report;
use super::small::StateOf;
use super::team::{Conditions, Demand, Demands, FloorProperty, Series, Team, Turns};
use crate::ambiguity::Charity::{Charitable, Literal};
use crate::ambiguity::{Ambiguity, Interpretation};
use crate::decide::{
    Context, Depiction, DrawnCertificate, Evidence, Method, MethodError, MethodResult, RefutationPlay, Size,
    Systems,
};
use crate::engine::model::StatesModel;
use crate::engine::smallest::{Class, ClassFindings, Most, smallest};
use crate::engine::states::{AnySystem, Limits, Run, search};
use crate::engine::{Choices, Script, ScriptError, Until};
use crate::judge::{AnyCase, Case};

/// The readings of what becomes of a sensor that was missed.
pub(crate) const MISSED: Ambiguity = Ambiguity {
    words: "“moves into the cell and places a new sensor on the floor and marks it with the state 1 … traversed yet \
            one more time”",
    interpretations: &[
        Interpretation::new("lost", "the old sensor's content is lost", Literal),
        Interpretation::new(
            "beside",
            "the old sensor stays beside the new one, and the higher state is read",
            Charitable,
        ),
        Interpretation::new(
            "counted",
            "the new sensor takes the state of the old one over and counts on",
            Charitable,
        ),
    ],
};

/// Which sensors are missed.
pub(crate) const HOW_OFTEN: Ambiguity = Ambiguity {
    words: "“the percentage of undetected sensors, due to adverse light conditions … amounts to 5.56% of all sensors”",
    interpretations: &[
        Interpretation::new("anew", "each scan misses some, a finite number in all", Charitable),
        Interpretation::new("in the dark", "every scan misses those of the same cells", Literal),
    ],
};

/// How far sensors count crossings where some are always missed.
const IN_THE_DARK: u32 = 8;

/// How the observer of a mutant is deceived.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Deception {
    /// Not at all.
    None,
    /// Agents beside each other scan and write at once.
    ActsAtOnce,
    /// Sensors do not count who enters a cell again.
    CountsNothing,
}

/// A scheme whose agents are observed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Subject<S> {
    pub(crate) scheme: S,
    /// The deception of whoever observes the agents.
    pub(crate) deception: Deception,
    /// The floor on which they are.
    pub(crate) given: Conditions,
}

impl<S: Copy> Subject<S> {
    /// Agents that follow `scheme`.
    pub(crate) const fn of(scheme: S) -> Self {
        Self { scheme, deception: Deception::None, given: Conditions::of(&[]) }
    }

    /// The agents on such a floor.
    pub(crate) const fn on(self, given: &[FloorProperty]) -> Self {
        Self { given: Conditions::of(given), ..self }
    }

    /// The agents, whose observer is deceived.
    pub(crate) const fn deceived(self, deception: Deception) -> Self {
        Self { deception, ..self }
    }
}

impl Series {
    /// Every action one step, every schedule, nothing missed, nobody fails, no patience.
    pub(crate) const fn new(area: Area, agents: u32) -> Self {
        Self {
            area,
            agents,
            max_misses: 0,
            turns: Turns::Whole,
            max_streak: None,
            may_fail: false,
            patience: 0,
            most_crossings: None,
        }
    }

    /// Some sensors missed.
    pub(crate) const fn missing(area: Area, agents: u32, max_misses: u8) -> Self {
        Self { max_misses, ..Self::new(area, agents) }
    }

    /// All agents but one may fail.
    pub(crate) const fn failing(area: Area, agents: u32) -> Self {
        Self { may_fail: true, ..Self::new(area, agents) }
    }

    /// Two agents, of which scanning and writing are two steps.
    pub(crate) const fn taking_turns(area: Area) -> Self {
        Self { turns: Turns::Overlapping, ..Self::new(area, 2) }
    }

    /// The teams of `subject`, one in each plan, those with the fewest blocked cells and walls first.
    pub(crate) fn teams<S: Demands>(self, subject: &Subject<S>, demand: Demand<S::Own>) -> Vec<Team<S>> {
        let series = match (subject.deception, self.turns) {
            (Deception::ActsAtOnce, Turns::Overlapping) => Self { turns: Turns::Free, ..self },
            (Deception::CountsNothing, _) => Self { most_crossings: Some(1), ..self },
            // Ants that go to and fro in the dark count up for ever; they come to no more elsewhere.
            (Deception::None, _) if subject.given.has(FloorProperty::Dark) => {
                Self { most_crossings: Some(IN_THE_DARK), ..self }
            }
            (Deception::None | Deception::ActsAtOnce, _) => self,
        };
        let scheme = subject.scheme.with_patience(self.patience);
        let mut plans: Vec<FloorPlan> = self.area.plans().collect();
        plans.sort_by_key(FloorPlan::barriers);
        let (given, most) = (subject.given, u32::from(self.max_misses));
        let team = move |plan: FloorPlan| {
            let free = if given.has(FloorProperty::Dark) && most > 0 { plan.free } else { 0 };
            let dark = (0..=free).filter(move |dark| dark & !free == 0 && dark.count_ones() <= most);
            dark.map(move |dark| Team { plan, scheme, series, demand, given, dark })
        };
        plans.into_iter().flat_map(team).collect()
    }

    /// The words for it in a bound, `who` standing for its agents.
    pub(crate) fn words(self, who: &str) -> String {
        let Self { area, agents, max_misses, turns, max_streak, may_fail, patience, most_crossings } = self;
        let turns = match turns {
            Turns::Whole => None,
            Turns::Overlapping => Some("scans and writes in every order unless scans overlap".to_owned()),
            Turns::Free => Some("scans and writes in every order".to_owned()),
        };
        let streak = max_streak.filter(|_| agents > 1);
        let words = [
            Some(format!("{agents}{who} to {area}")),
            (max_misses > 0).then(|| format!("{max_misses} missed")),
            (patience > 0).then(|| format!("patience {patience}")),
            may_fail.then(|| "all but one may fail".to_owned()),
            most_crossings.map(|most| format!("crossings counted to {most}")),
            turns,
            streak.map(|most| format!("at most {most} acts in a row")),
        ];
        words.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

/// The small floors of a check, and what is demanded of every state of the agents on them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Floors<D: 'static> {
    /// Those on which the demand is first broken, if that is known.
    first: Option<Series>,
    series: &'static [Series],
    demand: Demand<D>,
    /// Whether other clauses are about them, so that all demands are looked at in one pass.
    is_shared: bool,
}

impl<D: Copy> Floors<D> {
    /// Floors that one clause alone is about.
    pub(crate) const fn new(series: &'static [Series], demand: Demand<D>) -> Self {
        Self { first: None, series, demand, is_shared: false }
    }

    /// Floors that several clauses are about.
    pub(crate) const fn shared(series: &'static [Series], demand: Demand<D>) -> Self {
        Self { first: None, series, demand, is_shared: true }
    }

    /// Floors on which the demand is broken, first on `first`.
    pub(crate) const fn broken_on(first: Series, series: &'static [Series], demand: Demand<D>) -> Self {
        Self { first: Some(first), series, demand, is_shared: false }
    }

    /// The series, in their order.
    fn all(&self) -> impl Iterator<Item = Series> {
        self.first.into_iter().chain(self.series.iter().copied())
    }

    /// All series with their numbers. What is wrong with a mutant is sought in small areas first.
    fn in_order(&self, until: Until) -> Vec<(u32, Series)> {
        let mut series: Vec<(u32, Series)> = (0..).zip(self.all()).collect();
        if until == Until::Violation {
            series.sort_by_key(|(_, series)| (series.patience, series.area.cells()));
        }
        series
    }

    /// These floors with the demands of all clauses that are about them, if these are several.
    fn together(&self) -> Option<Self> {
        self.is_shared.then_some(Self { demand: Demand::All, ..*self })
    }

    /// Looks at the states of each plan within `limits`, series by series, until the first violation. Its choices are
    /// the numbers of the series, the plan and the start, then the steps.
    fn explore<S: Demands<Own = D>>(
        &self,
        subject: &Subject<S>,
        (limits, until): (Limits<'_>, Until),
    ) -> Report {
        let mut report = Report::new();
        for (number, series) in self.in_order(until) {
            if report.add(number, &series.teams(subject, self.demand), (limits, until)) {
                break;
            }
        }
        report
    }
}

impl<S: Demands> Method<Subject<S>> for Floors<S::Own> {
    fn engine(&self) -> &'static str {
        "states"
    }

    fn bound(&self) -> String {
        let series = (0..).zip(self.all()).map(|(place, series)| series.words(S::name(place, series.agents)));
        series.chain(S::bounds()).collect::<Vec<_>>().join("; ")
    }

    fn family(&self, subject: &Subject<S>) -> Option<String> {
        self.together().map(|together| format!("{together:?} {subject:?}"))
    }

    /// Looks at the demands of several clauses on the same floors in one pass. Where something is broken there, each
    /// clause looks for its own first violation.
    fn decide(&self, subject: &Subject<S>, until: Until, context: &mut Context<'_, '_>) -> MethodResult {
        let limits = Limits { memory: context.memory, ..Limits::NONE };
        let shown = Method::<Subject<S>>::shows(self);
        let Some(together) = self.together().filter(|_| until == Until::Exhausted) else {
            return Ok(self.explore(subject, (limits, until)).answer(shown));
        };
        let key = (together, *subject);
        let report: Result<&Report, MethodError> =
            context.cache.recall(key, |(floors, subject)| Ok(floors.explore(subject, (limits, until))));
        let report = report?.clone();
        let is_kept = report.tally.violation.is_none();
        Ok(if is_kept { report } else { self.explore(subject, (limits, until)) }.answer(shown))
    }

    /// One in each plan.
    fn systems(&self, subject: &Subject<S>) -> Result<Systems, MethodError> {
        let teams = self.all().flat_map(|series| series.teams(subject, self.demand));
        let started = |team| -> Box<dyn AnySystem> {
            Box::new(StatesModel::new(team, |team: &Team<S>| team.starts().collect()))
        };
        Ok(teams.map(started).collect())
    }

    fn replay(&self, subject: &Subject<S>, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let (of, team, start, run) = self.found(subject, choices)?;
        let seen = Depiction::Agents(Box::new(team.course(start, &run)));
        Ok(RefutationPlay { of, evidence: Evidence { choices: choices.clone(), demand: run.demand, seen } })
    }

    /// With marks, if it is no counterexample without them.
    fn case(&self, subject: &Subject<S>, choices: &Choices) -> Option<Box<dyn AnyCase>> {
        let (clause, (_, team, start, run)) = (self.clause()?, self.found(subject, choices).ok()?);
        let unmarked = team.written(clause, start.clone(), &run, false);
        let is_enough = unmarked.judge().is_ok();
        Some(Box::new(if is_enough { unmarked } else { team.written(clause, start, &run, true) }))
    }

    fn size(&self, subject: &Subject<S>, choices: &Choices) -> Option<Size> {
        let Depiction::Agents(course) = self.replay(subject, choices).ok()?.evidence.seen else {
            return None;
        };
        let area = Rect::new(Cell::new(0, 0), Cell::new(course.width - 1, course.height - 1))?;
        let barriers = (course.blocked.len() + course.walls.len()) as u32;
        let class = Class { area, barriers, robots: course.end.cells.len() };
        Some((class.to_string(), course.turns.len()))
    }

    fn smallest(&self, subject: &Subject<S>) -> Result<Option<DrawnCertificate>, MethodError> {
        // What is missed, and which turns are taken, as in the series with least of it.
        let least = self.all().min_by_key(|series| (series.patience, series.max_misses));
        let Some(least) = least else { return Ok(None) };
        let cells = if least.max_misses == 0 { 10 } else { 6 };
        let most = Most { cells, barriers: 2, robots: 1..=2 };
        let search = |class, until| Ok::<_, MethodError>(self.shortest(subject, class, (least, until)));
        Ok(Some(smallest(&most, search)?.drawn_by_cells(|plan| plan)))
    }
}

/// From how many each choice was made, the team, its start, and the run.
type Witness<S> = (Vec<u32>, Team<S>, StateOf<S>, Run<&'static str>);

impl<D: Copy> Floors<D> {
    /// The run that these choices make.
    fn found<S: Demands<Own = D>>(
        &self,
        subject: &Subject<S>,
        choices: &Choices,
    ) -> Result<Witness<S>, ScriptError> {
        let mut script = Script::new(choices);
        let all: Vec<Series> = self.all().collect();
        let series = all[script.choose(all.len())?];
        let mut teams = series.teams(subject, self.demand);
        let team = script.choose(teams.len())?;
        let team = teams.swap_remove(team);
        let mut starts: Vec<_> = team.starts().collect();
        let number = script.choose(starts.len())?;
        let start = starts.swap_remove(number);
        let (of, run) = script.play(&team, (number, start.clone()), |_| true)?;
        Ok((of, team, start, run))
    }

    /// The clause about these floors that is refuted for some rule, if one is.
    fn clause(&self) -> Option<&'static str> {
        Some(match self.demand {
            Demand::Connected if self.all().all(|series| series.turns == Turns::Whole) => "BRICKS-2",
            Demand::Connected => "BRICKS-3",
            Demand::Knowing => "BRICKS-4",
            Demand::Explores => "BRICKS-5",
            Demand::Ends if self.all().any(|series| series.may_fail) => "BRICKS-11",
            Demand::Ends => "BRICKS-6",
            Demand::Own(_) => "BRICKS-12",
            Demand::All => return None,
        })
    }

    /// The shortest run in a class that breaks the demand, each kind of barriers by itself.
    fn shortest<S: Demands<Own = D>>(
        &self,
        subject: &Subject<S>,
        class: Class,
        (least, until): (Series, Until),
    ) -> ClassFindings<String> {
        let ((width, height), agents) = (class.size(), class.robots as u32);
        let mut all = ClassFindings::default();
        for area in [Area::blocked(width, height), Area::walled(width, height)] {
            let series = Series { area, agents, ..least };
            let mut teams = series.teams(subject, self.demand);
            teams.retain(|team| team.plan.barriers() <= class.barriers);
            for team in teams {
                let found = search(&team, team.starts(), Limits::NONE);
                let run = found.broken.into_iter().next();
                let shortest = run.map(|run| (run.length(), team.plan.to_string()));
                let is_enough = shortest.is_some() && until == Until::Violation;
                all.add(ClassFindings { cases: found.states, is_whole: found.is_shortest, shortest });
                if is_enough {
                    return all;
                }
            }
        }
        all
    }
}
