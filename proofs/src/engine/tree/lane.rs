//! One part of the tree of runs, searched depth first: a run, the places on its way where the world has more answers,
//! and the answers that it gave so far. The answers alone say where a lane is, so a list of them is all that a search
//! needs to be resumed.

use std::ops::ControlFlow;
use std::slice;

use serde::{Deserialize, Serialize};
use tautline_kernel::choice::Oracle;

use super::Game;
use super::count::{self, Count, Violation};
use super::forecast::Forecast;
use super::share::Share;
use crate::engine::ScriptError;
use crate::engine::watchdog::Steps;
use crate::engine::world::Turn;

/// One answer of the world.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Answer {
    value: u32,
    below: u32,
    /// Whether 1 counts as a mishap.
    is_mishap: bool,
}

/// The answers on the way, with at most `most` mishaps. Where all mishaps are spent, nothing is asked.
#[derive(Clone, Debug)]
struct Answers {
    given: Vec<Answer>,
    /// The share of the runs that begin so.
    share: Share,
    mishaps: u32,
    most: u32,
}

impl Answers {
    fn give(&mut self, answer: Answer) -> u32 {
        self.mishaps += u32::from(answer.is_mishap && answer.value == 1);
        self.share = self.share.part_of(answer.below);
        self.given.push(answer);
        answer.value
    }

    /// Takes the last answer back, if it is not one of the first `kept`.
    fn take(&mut self, kept: usize) -> Option<Answer> {
        let answer = (self.given.len() > kept).then(|| self.given.pop()).flatten()?;
        self.mishaps -= u32::from(answer.is_mishap && answer.value == 1);
        self.share = self.share.times(answer.below);
        Some(answer)
    }

    /// The values from place `from` on.
    fn values(&self, from: usize) -> impl Iterator<Item = u32> {
        self.given[from..].iter().map(|answer| answer.value)
    }
}

/// Answers as a script says, and plainly where it has ended.
struct ScriptOracle<'a> {
    answers: &'a mut Answers,
    script: slice::Iter<'a, u32>,
    /// Whether every line of the script was an answer to its question.
    fits: bool,
}

impl ScriptOracle<'_> {
    fn answer(&mut self, below: u32, is_mishap: bool) -> u32 {
        let value = self.script.next().copied().unwrap_or(0);
        self.fits &= value < below;
        self.answers.give(Answer { value: value.min(below - 1), below, is_mishap })
    }
}

impl Oracle for ScriptOracle<'_> {
    fn pick(&mut self, below: u32) -> u32 {
        if below > 1 { self.answer(below, false) } else { 0 }
    }

    fn mishap(&mut self) -> bool {
        self.answers.mishaps < self.answers.most && self.answer(2, true) == 1
    }
}

/// A team move that is planned, and how the run stood before it.
struct Fork<G: Game> {
    before: G::State,
    planned: G::State,
    plan: G::Plan,
    /// Team moves, bytes of the log and answers before it.
    steps: u32,
    sent: usize,
    answered: usize,
    /// Demands that the run had broken before it.
    broken: usize,
}

impl<G: Game> Clone for Fork<G> {
    fn clone(&self) -> Self {
        let (before, planned) = (self.before.clone(), self.planned.clone());
        Self { before, planned, plan: self.plan.clone(), ..*self }
    }
}

/// Where a lane is.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Place {
    /// The answers of its run.
    answers: Vec<u32>,
    /// How many of them, from the first on, are not its own to change.
    fixed: usize,
    next: Next,
    /// Team moves since the last answer, if the run goes on.
    #[serde(default, skip_serializing_if = "is_zero")]
    moved: u32,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "so serde calls it")]
const fn is_zero(moves: &u32) -> bool {
    *moves == 0
}

/// A lane's next action.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Next {
    /// The run goes on.
    #[default]
    Advance,
    /// The run is over, or another lane's: back to the last other answer.
    Retreat,
}

/// A part of the tree.
pub(super) struct Lane<G: Game> {
    state: G::State,
    log: Vec<u8>,
    steps: u32,
    answers: Answers,
    /// The demands that the run has broken, in the order in which it did.
    broken: Vec<G::Demand>,
    forks: Vec<Fork<G>>,
    /// The forks before this one belong to other lanes.
    floor: usize,
    next: Next,
    mark: Mark<G::State>,
    /// The first answers to the next team move.
    script: Vec<u32>,
}

/// A state that the run may come back to, and the bytes of the log before it, moved on at powers of two (Brent's search
/// for cycles). An answer reveals something that was not known, so no state comes again after it, and the search begins
/// anew.
struct Mark<S> {
    at: Option<(S, usize)>,
    /// Team moves since the last answer, and at how many the mark is moved.
    moved: u32,
    due: u32,
}

impl<S> Mark<S> {
    /// Team moves without an answer from which on a run is watched.
    const FIRST: u32 = 32;

    const NONE: Self = Self { at: None, moved: 0, due: Self::FIRST };
}

impl<G: Game> Lane<G> {
    /// The memory that one answer on the way takes at most.
    pub(super) const FORK_BYTES: usize = size_of::<Fork<G>>() + size_of::<Answer>();

    /// The whole tree of runs with at most `mishaps`.
    pub(super) fn whole(game: &G, mishaps: u32) -> Self {
        Self {
            state: game.start(),
            log: Vec::new(),
            steps: 0,
            answers: Answers { given: Vec::new(), share: Share::WHOLE, mishaps: 0, most: mishaps },
            broken: Vec::new(),
            forks: Vec::new(),
            floor: 0,
            next: Next::Advance,
            mark: Mark::NONE,
            script: Vec::new(),
        }
    }

    /// The lane that was at `place`; `None` if no run gets there.
    pub(super) fn at(game: &G, mishaps: u32, place: &Place) -> Option<Self> {
        let mut lane = Self::whole(game, mishaps);
        let at = (place.answers.len(), place.moved);
        while (lane.answers.given.len(), lane.mark.moved) < at {
            let answered = lane.plan(game).filter(|_| !lane.is_spent(game))?;
            lane.script.extend_from_slice(place.answers.get(answered..)?);
            let event = lane.settle(game)?;
            let broken = game.broken_by(&lane.turn(&event));
            lane.keep();
            lane.note(broken, |_, _| ());
            if lane.recurs(game).is_break() || lane.steps > game.longest_run() {
                return None;
            }
        }
        lane.next = place.next;
        lane.floor = lane.forks.iter().filter(|fork| fork.answered < place.fixed).count();
        let is_over = lane.next == Next::Advance && lane.is_spent(game);
        (lane.place() == *place && !is_over).then_some(lane)
    }

    /// Where it is.
    pub(super) fn place(&self) -> Place {
        let fixed = self.forks.get(self.floor).map_or(self.answers.given.len(), |fork| fork.answered);
        let moved = if self.next == Next::Advance { self.mark.moved } else { 0 };
        Place { answers: self.answers.values(0).collect(), fixed, next: self.next, moved }
    }

    /// Plans the next team move of the run, the last of the forks until it is [kept](Self::keep): how many answers
    /// there are before it. `None` if the run is over.
    #[inline]
    fn plan(&mut self, game: &G) -> Option<usize> {
        let before = self.state.clone();
        let plan = game.plan(&mut self.state, &self.log)?;
        let (planned, steps, sent) = (self.state.clone(), self.steps, self.log.len());
        let (answered, broken) = (self.answers.given.len(), self.broken.len());
        self.forks.push(Fork { before, planned, plan, steps, sent, answered, broken });
        Some(answered)
    }

    /// Makes the team move that is planned, with the answers of the script first; `None` if they do not fit its
    /// questions.
    #[inline]
    fn settle(&mut self, game: &G) -> Option<G::Event> {
        let fork = self.forks.last()?;
        self.steps += 1;
        let mut world = ScriptOracle { answers: &mut self.answers, script: self.script.iter(), fits: true };
        let event = game.settle(&mut self.state, &fork.plan, &mut self.log, &mut world);
        let fits = world.fits;
        self.script.clear();
        if self.answers.given.len() > fork.answered {
            self.mark = Mark::NONE;
        } else {
            self.mark.moved += 1;
        }
        fits.then_some(event)
    }

    /// The team move that was made last is done with: it stays among the forks if its outcome was asked for.
    #[inline]
    fn keep(&mut self) {
        let answers = self.answers.given.len();
        self.forks.pop_if(|fork| fork.answered == answers);
    }

    /// Searches on until `count` has `made` team moves, or `new` ones that are new.
    pub(super) fn search(
        &mut self,
        game: &G,
        (made, new): (u64, u64),
        steps: &Steps,
        count: &mut Count<G::Demand>,
    ) {
        while count.made < made && count.moves < new {
            steps.next();
            match self.next {
                Next::Advance => {
                    if self.plan(game).is_none() {
                        self.breaks(game.broken_at_end(&self.state, &self.log), count);
                        self.end(count);
                        continue;
                    }
                }
                Next::Retreat => {
                    if !self.retreat() {
                        return;
                    }
                }
            }
            self.make(game, count);
        }
    }

    /// Makes the team move that is planned and checks it.
    #[inline]
    fn make(&mut self, game: &G, count: &mut Count<G::Demand>) {
        let event = self.settle(game);
        self.next = Next::Advance;
        count.made += 1;
        count.moves += u64::from(self.is_new());
        if let Some(event) = &event {
            let turn = self.turn(event);
            count.covered |= game.occurs(&turn);
            let broken = game.broken_by(&turn);
            self.breaks(broken, count);
        }
        self.keep();
        if self.is_spent(game) {
            self.end(count);
        } else if let ControlFlow::Break(broken) = self.recurs(game) {
            self.breaks(broken, count);
            self.end(count);
        } else if self.steps >= game.longest_run() {
            count.given_up += u64::from(self.is_new());
            self.end(count);
        }
    }

    /// Notes what the run breaks, and hands on what it had not broken before.
    #[inline]
    fn note(&mut self, broken: Vec<G::Demand>, mut first: impl FnMut(&Self, G::Demand)) {
        for demand in broken {
            if !self.broken.contains(&demand) {
                self.broken.push(demand);
                first(self, demand);
            }
        }
    }

    /// Counts what the run breaks for the first time.
    #[inline]
    fn breaks(&mut self, broken: Vec<G::Demand>, count: &mut Count<G::Demand>) {
        self.note(broken, |lane, demand| {
            if lane.is_new() {
                let answers = lane.answers.values(0).collect();
                let smallest = Violation { mishaps: lane.answers.mishaps, steps: lane.steps, answers };
                count.add_broken(count::DemandRuns { demand, runs: 1, smallest });
            }
        });
    }

    /// Whether the run has broken everything that is wanted.
    #[inline]
    fn is_spent(&self, game: &G) -> bool {
        !self.broken.is_empty() && game.wanted().iter().all(|demand| self.broken.contains(demand))
    }

    /// The team move that was made last.
    fn turn<'a>(&'a self, event: &'a G::Event) -> Turn<'a, G> {
        let Fork { before, planned, plan, sent, .. } = &self.forks[self.forks.len() - 1];
        Turn { before, planned, after: &self.state, plan, event, sent: &self.log[*sent..] }
    }

    /// Whether the run comes back to where it was, and so never ends, and what is broken by that.
    fn recurs(&mut self, game: &G) -> ControlFlow<Vec<G::Demand>> {
        let Mark { at, moved, due } = &self.mark;
        if moved < due {
            return match at {
                Some((state, sent)) => game.recurs(state, *sent, &self.state, &self.log),
                None => ControlFlow::Continue(()),
            };
        }
        self.mark = Mark { at: Some((self.state.clone(), self.log.len())), moved: *moved, due: 2 * due };
        ControlFlow::Continue(())
    }

    /// The run is over.
    fn end(&mut self, count: &mut Count<G::Demand>) {
        self.next = Next::Retreat;
        count.searched = count.searched.and(self.answers.share);
        if self.is_new() {
            count.runs += 1;
            count.longest = count.longest.max(self.steps);
        }
    }

    /// Whether a search with one mishap less did not come here.
    const fn is_new(&self) -> bool {
        self.answers.mishaps == self.answers.most
    }

    /// Goes back to the last team move that can come out otherwise, as it was when it was planned, and puts the next
    /// answers to it into the script. False if there is none.
    fn retreat(&mut self) -> bool {
        while let Some(fork) = self.forks[self.floor..].last() {
            while let Some(answer) = self.answers.take(fork.answered) {
                if answer.value + 1 < answer.below {
                    self.script.extend(self.answers.values(fork.answered));
                    self.script.push(answer.value + 1);
                    while self.answers.take(fork.answered).is_some() {}
                    self.state.clone_from(&fork.planned);
                    self.steps = fork.steps;
                    self.log.truncate(fork.sent);
                    self.broken.truncate(fork.broken);
                    return true;
                }
            }
            self.forks.pop();
        }
        false
    }

    /// The first fork from this place on with another outcome left, and where the answers to it end.
    fn first_open(&self, from: usize) -> Option<(usize, usize)> {
        (from..self.forks.len()).find_map(|place| {
            let from = self.forks[place].answered;
            let to = self.forks.get(place + 1).map_or(self.answers.given.len(), |next| next.answered);
            let is_open = self.answers.given[from..to].iter().any(|answer| answer.value + 1 < answer.below);
            is_open.then_some((place, to))
        })
    }

    /// Whether something is left of it.
    pub(super) fn has_more(&self) -> bool {
        self.next == Next::Advance || self.first_open(self.floor).is_some()
    }

    /// The fork whose other outcomes can be split off so that something is left: the first of its own that has any,
    /// unless these are all that is sure to be new in the lane.
    fn divisible(&self) -> Option<(usize, usize)> {
        let (place, answered) = self.first_open(self.floor)?;
        let is_sure = self.next == Next::Advance && self.is_new();
        (is_sure || self.first_open(place + 1).is_some()).then_some((place, answered))
    }

    /// About how many team moves are left of it.
    pub(super) fn left(&self, forecast: &Forecast) -> u64 {
        let below = |steps, mishaps| forecast.below(steps, self.answers.most - mishaps);
        let mut mishaps = self.answers.mishaps;
        let mut left = match self.next {
            Next::Advance => below(self.steps, mishaps),
            Next::Retreat => 0,
        };
        let mut to = self.answers.given.len();
        for fork in self.forks[self.floor..].iter().rev() {
            for answer in self.answers.given[fork.answered..to].iter().rev() {
                mishaps -= u32::from(answer.is_mishap && answer.value == 1);
                let others = answer.below - 1 - answer.value;
                if others > 0 {
                    let each = below(fork.steps, mishaps + u32::from(answer.is_mishap));
                    left = left.saturating_add(each.saturating_mul(others.into()));
                }
            }
            to = fork.answered;
        }
        left
    }

    /// The share of the tree that is left of it.
    pub(super) fn share_left(&self) -> Share {
        let own = self.forks.get(self.floor).map_or(self.answers.given.len(), |fork| fork.answered);
        let (mut share, mut left) = (Share::WHOLE, Share::NONE);
        for (place, answer) in self.answers.given.iter().enumerate() {
            share = share.part_of(answer.below);
            if place >= own {
                left = left.and(share.times(answer.below - 1 - answer.value));
            }
        }
        if self.next == Next::Advance { left.and(share) } else { left }
    }

    /// Splits off the other outcomes of its first fork.
    pub(super) fn split(&mut self) -> Option<Self> {
        let (place, answered) = self.divisible()?;
        self.floor = place + 1;
        let given = self.answers.given[..answered].to_vec();
        let mishaps = given.iter().filter(|answer| answer.is_mishap && answer.value == 1).count() as u32;
        let share = given.iter().fold(Share::WHOLE, |share, answer| share.part_of(answer.below));
        Some(Self {
            state: self.state.clone(),
            log: self.log[..self.forks[place].sent].to_vec(),
            steps: self.steps,
            answers: Answers { given, share, mishaps, most: self.answers.most },
            broken: self.broken[..self.forks[place].broken].to_vec(),
            forks: vec![self.forks[place].clone()],
            floor: 0,
            next: Next::Retreat,
            mark: Mark::NONE,
            script: Vec::new(),
        })
    }
}

/// A run made again.
pub(super) struct Rerun<F> {
    /// The broken demand, in words.
    pub(super) words: &'static str,
    /// Its team moves; of a run without end, as far as it first comes back to where it was.
    pub(super) frames: Vec<F>,
    /// Team moves until the search saw what it breaks.
    pub(super) steps: u32,
}

/// Makes the run with these answers, at most `most` of them mishaps, as far as it breaks `demand`, whatever else it
/// breaks.
pub(super) fn replay<G: Game>(
    game: &G,
    most: u32,
    demand: G::Demand,
    answers: &[u32],
) -> Result<Rerun<G::Frame>, ScriptError> {
    let words = |broken: Vec<G::Demand>| broken.contains(&demand).then(|| game.words(demand, None));
    let mut lane = Lane::whole(game, most);
    let mut frames = Vec::new();
    // Where it was since the last answer.
    let mut been = vec![(lane.state.clone(), 0)];
    let broken = loop {
        let Some(answered) = lane.plan(game) else {
            break words(game.broken_at_end(&lane.state, &lane.log));
        };
        lane.script.extend_from_slice(answers.get(answered..).unwrap_or_default());
        let Some(event) = lane.settle(game) else {
            let mut given = lane.answers.given.iter().zip(answers);
            let at = given.position(|(given, &answer)| given.value != answer).unwrap_or(answered);
            return Err(ScriptError::None { at, of: lane.answers.given[at].below });
        };
        if lane.answers.given.len() > answers.len() {
            return Err(ScriptError::Unbroken);
        }
        let turn = lane.turn(&event);
        frames.push(game.frame(&turn));
        if game.broken_by(&turn).contains(&demand) {
            break Some(game.words(demand, Some(&turn)));
        }
        lane.keep();
        if lane.mark.moved == 0 {
            been.clear();
        }
        been.push((lane.state.clone(), lane.log.len()));
        match lane.recurs(game) {
            ControlFlow::Break(broken) => {
                frames.truncate(frames.len() + 1 - been.len() + first_round(game, &been, &lane.log));
                break words(broken);
            }
            ControlFlow::Continue(()) if lane.steps >= game.longest_run() => break None,
            ControlFlow::Continue(()) => {}
        }
    };
    let used = lane.answers.given.len();
    if used < answers.len() {
        return Err(ScriptError::Over { at: used });
    }
    Ok(Rerun { words: broken.ok_or(ScriptError::Unbroken)?, frames, steps: lane.steps })
}

/// The place in these states where a run that has come back to one of them first did.
fn first_round<G: Game>(game: &G, been: &[(G::State, usize)], log: &[u8]) -> usize {
    let recurs = |then: usize, now: usize| {
        let ((then, sent), (now, end)) = (&been[then], &been[now]);
        game.recurs(then, *sent, now, &log[..*end]).is_break()
    };
    let last = been.len() - 1;
    let Some(round) = (1..=last).find(|round| recurs(last - round, last)) else { return last };
    (0..last).find(|&first| recurs(first, first + round)).map_or(last, |first| first + round)
}
