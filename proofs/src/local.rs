//! Rules that are local and the same everywhere, decided for every number of robots and every layout. Whoever
//! implements [`Local`] says what one robot can do and what `k` robots may plan at once; the promise is about `k`
//! robots, too. From that [`EveryNumber`] computes a set of relative places of `k` robots that keep the promise and
//! that no admitted step leaves: then no run of any number of robots in any layout leaves it, since the rule speaks of
//! nothing but `k` robots at a time. If there is no such set, teams of `k` and more robots are searched for a run that
//! breaks the promise, the walls decided as robots meet them. If none is found, and teams have more than `k` robots,
//! the places of `k + 1` robots are looked at in the same way; if that does not do, the question is open.
//!
//! The verdict is about the relation of plans that the rule admits, whoever picks among them; [`GuardedPlanner`] keeps
//! any planner to it. That the finite check is enough is proved in `proofs/rocq/Local.v`.

mod certificate;
mod guarded_planner;
mod invariant;
mod numbers;
mod rule;
mod team;
mod wider;

use self::certificate::terms;
pub use self::guarded_planner::GuardedPlanner;
pub use self::invariant::Invariant;
use self::numbers::{ByNumber, NumberedRule};
pub use self::rule::{Act, Far, Local, Plan, Robot, all_tuples, chain, in_a_row};
use self::team::Team;
use self::wider::Wider;
use crate::decide::{Answer, Context, Evidence, Method, MethodError, MethodResult, RefutationPlay, Verdict};
use crate::engine::states::{self, Limits, Memory};
use crate::engine::watchdog;
use crate::engine::{Choices, Script, ScriptError, Until};

/// The promise of a [`Local`] rule, for every number of robots and every layout.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct EveryNumber {
    /// The teams that the verdict is about, in words.
    pub teams: &'static str,
    /// The part of a clause that it is about, in words, or nothing.
    pub part: &'static str,
    /// The largest team that is searched for a run that breaks the promise.
    pub most_robots: usize,
    /// Steps of each of these searches.
    pub most_steps: u64,
    /// The largest team that is asked how it starts, and which of its robots are bound: of larger ones that is
    /// believed. A verdict about small teams alone has a smaller number.
    pub most_starts: usize,
}

impl EveryNumber {
    /// Every number of robots; teams of up to four robots, in a hundred thousand steps each, and starts and bound
    /// robots of up to 16.
    pub const DEFAULT: Self =
        Self { teams: "every N", part: "", most_robots: 4, most_steps: 100_000, most_starts: 16 };

    /// The teams that are looked at.
    ///
    /// # Errors
    /// [`MethodError`] if one does not start as its rule says, or a larger one whose start alone is looked at.
    fn teams(self, rule: &dyn NumberedRule) -> Result<Vec<Team<'_>>, MethodError> {
        let most = self.most_robots.max(self.most_starts).max(rule.least());
        let making = watchdog::Steps::begin();
        let team = |robots| {
            making.next();
            Team::new(rule, robots)
        };
        let mut teams: Vec<_> = (rule.least()..=most).map(team).collect::<Result<_, _>>()?;
        teams.truncate((self.most_robots + 1).saturating_sub(rule.least()));
        Ok(teams)
    }

    fn decided(self, rule: &dyn NumberedRule, memory: Memory<'_>) -> MethodResult {
        let (invariant, teams) = (Invariant::found(rule)?, self.teams(rule)?);
        if invariant.holds() {
            return Ok(of_teams(rule, invariant.answer()));
        }
        for (more, team) in (0..).zip(&teams) {
            let limits = Limits { memory, ..Limits::steps(self.most_steps) };
            let found = states::search(team, [team.start()], limits);
            if let Some(run) = found.broken.first() {
                let once = [&[more], &run.steps[..]].concat();
                let choices = Choices { once, again: Vec::new() };
                let evidence = Evidence { choices, demand: run.demand, seen: team.story(run) };
                return Ok(Answer::new(Some(evidence), true, Verdict::Holds, invariant.cases));
            }
        }
        if let Some(wider) = Wider::of(rule, self.most_robots.max(self.most_starts)) {
            // Where there are too many places of one robot more, they are no help.
            if let Ok(invariant) = Invariant::found(&wider)
                && invariant.holds()
            {
                return Ok(of_teams(rule, invariant.answer()));
            }
        }
        let note = format!(
            "places of {} robots are too coarse, and no run of up to {} robots was found; as far as these places tell, \
             robots may go from {}",
            rule.robots(),
            self.most_robots,
            invariant.way_out(rule)?.join(" to ")
        );
        Ok(Answer { note: Some(note), ..Answer::new(None, false, Verdict::Holds, invariant.cases) })
    }

    fn replayed(self, rule: &dyn NumberedRule, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let mut script = Script::new(choices);
        let more = script.choose((self.most_robots + 1).saturating_sub(rule.least()))?;
        let team = Team::new(rule, rule.least() + more).map_err(|_| ScriptError::Unbroken)?;
        let (of, run) = script.play(&team, (0, team.start()), |_| true)?;
        let seen = team.story(&run);
        Ok(RefutationPlay { of, evidence: Evidence { choices: choices.clone(), demand: run.demand, seen } })
    }
}

/// The answer, whose note says where teams have more robots than the rule speaks of: nothing is shown of smaller ones.
fn of_teams(rule: &dyn NumberedRule, answer: Answer) -> Answer {
    if rule.least() == rule.robots() {
        return answer;
    }
    let note = answer.note.map_or_else(String::new, |note| note + ", ");
    let note = Some(format!("{note}of teams of {} robots and more", rule.least()));
    Answer { note, ..answer }
}

impl<R: Local> Method<R> for EveryNumber {
    fn engine(&self) -> &'static str {
        "local"
    }

    fn bound(&self) -> String {
        let part = if self.part.is_empty() { String::new() } else { format!("; {}", self.part) };
        format!("{}, every layout{part}; {}", self.teams, R::subject())
    }

    /// The choices are how many robots there are beyond the fewest, and those of the steps.
    fn decide(&self, rule: &R, _: Until, context: &mut Context<'_, '_>) -> MethodResult {
        self.decided(&ByNumber::new(rule), context.memory)
    }

    /// There is one where places of as many robots as the rule speaks of suffice.
    fn certificate(&self, rule: &R) -> Option<Result<String, MethodError>> {
        let rule = ByNumber::new(rule);
        match (Invariant::found(&rule), self.teams(&rule)) {
            (Ok(invariant), Ok(_)) => invariant.holds().then(|| terms(&rule, &invariant)),
            (Err(error), _) | (Ok(_), Err(error)) => Some(Err(error)),
        }
    }

    fn replay(&self, rule: &R, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        self.replayed(&ByNumber::new(rule), choices)
    }
}
