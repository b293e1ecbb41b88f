//! A check that a team keeps a demand in its setting.

use std::ops::ControlFlow;

use tautline_kernel::ground::{Area, Cell};

use super::ground::Map;
use super::rule::{Rule, Scene, When};
use super::{Moves, Places, Promise, Setting, Strategy, TeamWorld};
use crate::decide::{
    Answer, Context, Depiction, Evidence, Method, MethodError, MethodResult, RefutationPlay, Systems, Verdict,
};
use crate::engine::model::StatesModel;
use crate::engine::states::{self, Findings};
use crate::engine::tree::{self, AllRuns, Progress, Waves};
use crate::engine::{Choices, Script, ScriptError, Until};
use crate::plural::counted;
use crate::run::{Ending, Frame, Run, Words};

/// A check that no team breaks the demand with this number, in its setting.
pub struct Keeps<'a, R: Rule>(
    /// The setting with all demands.
    pub &'a Setting<'a, R>,
    /// The number of the demand.
    pub usize,
);

/// States between two words to the watch.
const BETWEEN: u64 = 1 << 10;

/// The findings of a tree: the frames, and the layout as far as it was known in each.
type TreeFindings = tree::Findings<Promise, (Frame, Option<Map>)>;

impl<R: Rule> Setting<'_, R> {
    /// The situations that must occur.
    fn situations(&self) -> impl Iterator<Item = &'static str> {
        self.covers.iter().map(|&(name, _)| name)
    }

    /// The run with these frames, the last of them in this layout.
    fn run_of(
        &self,
        starts: Vec<Cell>,
        frames: Vec<Frame>,
        map: Option<&Map>,
        (broken, ending): (Promise, Ending),
        (titles, round): (Vec<String>, usize),
    ) -> Run {
        let demand = self.demands.get(broken.0);
        Run {
            scheme: self.scheme,
            area: self.ground.area().unwrap_or(Area::of(Cell::new(0, 0))),
            starts,
            walls: map.map_or_else(Vec::new, Map::walls),
            obstacles: map.map_or_else(Vec::new, Map::obstacles),
            frames,
            breaks: demand.map(|demand| demand.id),
            ending,
            words: Words { demand: demand.map_or("", |demand| demand.words), titles, round },
        }
    }

    /// The run from these cells that a search as a tree has found.
    pub fn run(&self, starts: Vec<Cell>, found: &tree::Counterexample<Promise, (Frame, Option<Map>)>) -> Run {
        let known = || self.ground.maps().ok()?.first().copied();
        let map = found.frames.last().map_or_else(known, |(_, map)| *map);
        let frames = found.frames.iter().map(|(frame, _)| frame.clone()).collect();
        let ending = match self.demands[found.broken.0].when {
            When::Always(_) => Ending::Move,
            When::AtTheEnd(_) => Ending::Over,
            When::NeverEndless | When::Eventually(_) | When::AgainAndAgain(_) => Ending::Endless,
        };
        self.run_of(starts, frames, map.as_ref(), (found.broken, ending), (Vec::new(), 0))
    }

    fn evidence(
        &self,
        start: &Scene<R>,
        found: &tree::Counterexample<Promise, (Frame, Option<Map>)>,
    ) -> Evidence {
        let choices = Choices { once: found.answers.clone(), again: Vec::new() };
        let run = self.run(start.cells().collect(), found);
        Evidence { choices, demand: found.demand, seen: Depiction::Robots(Box::new(run)) }
    }
}

impl<R: Rule> TeamWorld<'_, R> {
    /// The frames of a run that was found among the states with their titles, and its last scene.
    fn played(&self, mut scene: Scene<R>, run: &states::Run<Promise>) -> (Vec<(Frame, String)>, Scene<R>) {
        let mut frames = Vec::new();
        for (_, step) in run.played(self, scene.clone()) {
            frames.push((step.event.frame(&step.state), self.title(&step.event)));
            scene = step.state;
        }
        (frames, scene)
    }

    /// The evidence of a run that was found among the states.
    fn evidence(
        &self,
        starts: impl IntoIterator<Item = Scene<R>>,
        run: &states::Run<Promise>,
    ) -> Option<Evidence> {
        let start = starts.into_iter().nth(run.start)?;
        let (played, last) = self.played(start.clone(), run);
        let (frames, titles) = played.into_iter().unzip();
        let ending = match run.ending {
            states::Ending::There => Ending::Move,
            states::Ending::Still => Ending::Over,
            states::Ending::Round(_) => Ending::Endless,
        };
        let found = self.setting.run_of(
            start.cells().collect(),
            frames,
            last.map.as_ref(),
            (run.demand, ending),
            (titles, run.round().len()),
        );
        let demand = self.demand(run.demand).words;
        Some(Evidence { choices: run.choices(), demand, seen: Depiction::Robots(Box::new(found)) })
    }
}

impl<R: Rule> Keeps<'_, R> {
    /// The states, and a run that breaks the demand if there is one: a shortest one, if [`Findings::is_shortest`]. The
    /// states are searched whatever the [strategy](Setting::strategy) of a check is, and the setting may be made while
    /// the program runs.
    ///
    /// # Errors
    /// [`MethodError`] as of [`Setting::playing`], or if the steps are not a function of the state. Without a start
    /// nothing is found.
    pub fn search(
        &self,
        rule: &R,
        limits: states::Limits<'_>,
    ) -> Result<Findings<&'static str>, MethodError> {
        let Some(playing) = self.states(rule)? else { return Ok(Findings::NONE) };
        Ok(states::search(&playing, self.0.starts(rule)?, limits)
            .told(|promise| playing.demand(promise).words))
    }

    /// The team whose states are searched; `None` without a start.
    fn states(&self, rule: &R) -> Result<Option<TeamWorld<'_, R>>, MethodError> {
        let mut starts = self.0.starts(rule)?.into_iter().peekable();
        let Some(start) = starts.peek().cloned() else { return Ok(None) };
        let playing = self.0.playing_from(rule, &[Promise(self.1)], start)?;
        states::repeats(&playing, starts).map_err(MethodError::new)?;
        Ok(Some(playing))
    }
}

impl<R: Rule + PartialEq + 'static> Keeps<'static, R> {
    /// The findings of a search as a tree, which is made only once.
    fn found<'d>(
        &self,
        rule: &R,
        until: Until,
        context: &'d mut Context<'_, '_>,
    ) -> Result<&'d TreeFindings, MethodError> {
        // A search that goes on for each demand answers for all of them.
        let wanted = match until {
            Until::Exhausted => Vec::new(),
            Until::Violation => vec![Promise(self.1)],
        };
        let Context { cache, watch, .. } = context;
        let key = (std::ptr::from_ref(self.0).addr(), rule.clone(), until, wanted);
        cache.recall(key, |(_, rule, until, wanted)| {
            let mut tree = self.0.search(rule, *until, wanted)?;
            while tree.wave() && watch(&tree.progress()).is_continue() {}
            Ok(tree.found())
        })
    }

    fn in_tree(&self, rule: &R, until: Until, context: &mut Context<'_, '_>) -> MethodResult {
        let playing = self.0.playing(rule, &[Promise(self.1)])?;
        let start = playing.start.clone();
        states::repeats(&playing, [start.clone()]).map_err(MethodError::new)?;
        let found = self.found(rule, until, context)?;
        let broken = found.counterexamples.iter().find(|found| found.broken.0 == self.1);
        let evidence = broken.map(|found| self.0.evidence(&start, found));
        let is_whole = found.complete && found.given_up == 0;
        let answer = Answer::new(evidence, is_whole, Verdict::Holds, found.runs - found.given_up);
        let answer = answer.covering(self.0.situations(), &found.covered);
        Ok(Answer { given_up: found.given_up, ..answer })
    }

    fn in_states(&self, rule: &R, context: &mut Context<'_, '_>) -> MethodResult {
        let Some(playing) = self.states(rule)? else { return Ok(Answer::startless()) };
        let limits = states::Limits { memory: context.memory, ..states::Limits::NONE };
        let mut hears = |looked_at| match looked_at % BETWEEN {
            0 => (context.watch)(&Progress::of_states(looked_at)),
            _ => ControlFlow::Continue(()),
        };
        let found = states::watched(&playing, self.0.starts(rule)?, limits, &mut hears);
        let starts = self.0.starts(rule)?;
        let evidence = found.broken.first().and_then(|run| playing.evidence(starts, run));
        Ok(Answer::of_states(evidence, &found, self.0.situations(), Verdict::Holds))
    }
}

impl<R: Rule + PartialEq + 'static> Method<R> for Keeps<'static, R> {
    fn engine(&self) -> &'static str {
        match self.0.strategy() {
            Strategy::Tree => "search",
            Strategy::States => "states",
        }
    }

    fn bound(&self) -> String {
        let Setting { ground, robots, starts, goals, senses, moves, losses, deaths, longest_run, .. } =
            self.0;
        let placed = |places: &Places<R>, what: &str| match places {
            Places::None => None,
            Places::At(_) => Some(format!("given {what}")),
            Places::Any => Some(format!("any {what}")),
            Places::Distinct => Some(format!("any {what} apart")),
        };
        let most = |most: u32, what: &str| (most > 0).then(|| format!("at most {}", counted(most, what)));
        let parts = [
            Some(ground.to_string()),
            Some(counted(*robots as u32, "robot")),
            placed(starts, "starts"),
            placed(goals, "goals"),
            Some(senses.to_string()),
            (*moves != Moves::Together).then(|| moves.to_string()),
            most(*losses, "lost message"),
            most(*deaths, "death"),
            (*longest_run != u32::MAX && self.0.strategy() == Strategy::Tree)
                .then(|| format!("runs of at most {longest_run} team moves")),
        ];
        parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    /// The rule is left out of the name, as it has none: checks of several rules are decided one after the other, too.
    fn family(&self, _: &R) -> Option<String> {
        Some(format!("{:x}", std::ptr::from_ref(self.0).addr()))
    }

    /// The choices are the answers of the world in a tree; among states, the
    /// number of the start and those of the steps.
    fn decide(&self, rule: &R, until: Until, context: &mut Context<'_, '_>) -> MethodResult {
        match self.0.strategy() {
            Strategy::Tree => self.in_tree(rule, until, context),
            Strategy::States => self.in_states(rule, context),
        }
    }

    fn systems(&self, rule: &R) -> Result<Systems, MethodError> {
        let demand = Promise(self.1);
        let playing = self.0.playing(rule, &[demand])?;
        match self.0.strategy() {
            Strategy::Tree => states::repeats(&playing, [playing.start.clone()]),
            Strategy::States => states::repeats(&playing, self.0.starts(rule)?),
        }
        .map_err(MethodError::new)?;
        Ok(vec![match self.0.strategy() {
            Strategy::Tree => {
                Box::new(AllRuns::new(Box::new(self.0.search(rule, Until::Exhausted, &[])?), demand))
            }
            Strategy::States => {
                let starts = |playing: &TeamWorld<'_, R>| {
                    playing.setting.starts(&playing.rule).into_iter().flatten().collect()
                };
                Box::new(StatesModel::new(playing, starts))
            }
        }])
    }

    fn replay(&self, rule: &R, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let wanted = [Promise(self.1)];
        match self.0.strategy() {
            Strategy::Tree => {
                if !choices.again.is_empty() {
                    return Err(ScriptError::Over { at: choices.once.len() });
                }
                let start = self.0.playing(rule, &wanted).map_err(|_| ScriptError::Unbroken)?.start;
                let tree =
                    self.0.search(rule, Until::Exhausted, &wanted).map_err(|_| ScriptError::Unbroken)?;
                let found = tree.replay(Promise(self.1), &choices.once)?;
                Ok(RefutationPlay {
                    of: vec![2; found.answers.len()],
                    evidence: self.0.evidence(&start, &found),
                })
            }
            Strategy::States => {
                let playing = self.0.playing(rule, &wanted).map_err(|_| ScriptError::Unbroken)?;
                let starts = || self.0.starts(rule).into_iter().flatten();
                let mut script = Script::new(choices);
                let number = script.choose(starts().count())?;
                let start = starts().nth(number).ok_or(ScriptError::Unbroken)?;
                let (of, run) = script.play(&playing, (number, start), |_| true)?;
                let evidence = playing.evidence(starts(), &run).ok_or(ScriptError::Unbroken)?;
                Ok(RefutationPlay { of, evidence })
            }
        }
    }
}
