//! The checks of the rules, dealt out: a job is a check, or one of its mutants, in a portion of its surroundings. No
//! state of one is a state of another, so that no shard searches what another one has searched.

use std::path::Path;
use std::time::Instant;

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use tautline_io::checkpoint::{Facts, Part, decode, encode};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::shards::{Plan, ShardFile, Work};
use tautline_library::Entry;
use tautline_proofs::clause::{Clause, Decision};
use tautline_proofs::decide::{Answer, Cache, Context, Depiction, Evidence, Portion, Verdict};
use tautline_proofs::engine::Choices;
use tautline_proofs::engine::states::MemoryLimit;
use tautline_proofs::engine::tree::Progress;
use tautline_proofs::ledger::{Row, checks};
use tautline_proofs::plural::counted;

use super::rules::{chosen, clauses};
use crate::evidence::registered;
use crate::exit::Exit;
use crate::options::{ForceArgs, Format};
use crate::output::Output;
use crate::shards;

/// The remedy for a plan or a shard that says no such thing.
const AS_WRITTEN: &str = "take it as tautline wrote it";

/// A check by its place, the number of one of its variants, and the portion of it.
type Job = (usize, Option<usize>, Portion);

/// How far a shard is: the answers to its jobs, in their order.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ShardProgress {
    answers: Vec<JobAnswer>,
}

/// An answer as it is kept.
#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct JobAnswer {
    verdict: String,
    cases: u64,
    given_up: u64,
    /// The choices that make the counterexample; none if there is none.
    once: Vec<u32>,
    again: Vec<u32>,
    note: Option<String>,
    seconds: f64,
}

impl JobAnswer {
    fn of(answer: Answer, seconds: f64) -> Self {
        let Choices { once, again } = answer.counterexample.map(|found| found.choices).unwrap_or_default();
        let Answer { verdict, cases, given_up, note, .. } = answer;
        Self { verdict: verdict.word().to_owned(), cases, given_up, once, again, note, seconds }
    }

    fn verdict(&self) -> Result<Verdict, Diagnostic> {
        let all = [Verdict::Holds, Verdict::Unrefuted, Verdict::Refuted, Verdict::Open];
        let known = all.into_iter().find(|verdict| verdict.word() == self.verdict);
        known.ok_or_else(|| Diagnostic::usage(format_args!("{:?} is no verdict", self.verdict), AS_WRITTEN))
    }

    /// The answer, whose counterexample is yet to be played again.
    fn answer(self) -> Result<Answer, Diagnostic> {
        let verdict = self.verdict()?;
        let Self { cases, given_up, once, again, note, .. } = self;
        let (choices, seen) = (Choices { once, again }, Depiction::Choices);
        let counterexample = (!choices.once.is_empty()).then_some(Evidence { choices, demand: "", seen });
        Ok(Answer { verdict, cases, given_up, counterexample, note })
    }
}

/// The checks that a plan deals out, and the jobs that they make.
struct Dealt {
    checks: Vec<(&'static Clause, usize)>,
    jobs: Vec<Job>,
}

impl Dealt {
    fn of(clauses: &[&'static Clause], shards: u32) -> Self {
        let checks = checks(clauses);
        let jobs = (0..).zip(&checks).flat_map(|(place, (clause, number))| {
            let check = clause.checks[*number];
            let (variants, of) = (0..check.variants().len(), check.portions().clamp(1, shards as usize));
            let all = [None].into_iter().chain(variants.map(Some));
            all.flat_map(move |variant| (0..of).map(move |number| (place, variant, Portion { number, of })))
        });
        Self { jobs: jobs.collect(), checks }
    }

    /// The checks of a plan.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it is a plan of something else.
    fn restored(plan: &Plan) -> Result<Self, Diagnostic> {
        let Work::Library { rules, larger } = &plan.of else {
            return Err(plan.none_of("the library"));
        };
        let rules = chosen(rules).map_err(|fault| fault.found_in(plan.path()))?;
        Ok(Self::of(&clauses(&rules, *larger), plan.shards))
    }

    /// The jobs of a shard.
    fn of_shard(&self, plan: &Plan, shard: u32) -> Vec<Job> {
        self.jobs.iter().copied().skip(shard as usize - 1).step_by(plan.shards as usize).collect()
    }

    fn part(&self, plan: &Plan, shard: u32, far: Option<&RawValue>) -> Result<Shard<'_>, Halt> {
        plan.check_shard(shard)?;
        let jobs = self.of_shard(plan, shard);
        let far = far.map(|far| decode::<ShardProgress>(far, AS_WRITTEN)).transpose()?;
        let answers = far.map_or(Vec::new(), |far| far.answers);
        if answers.len() > jobs.len() {
            let what = format!("shard {shard} has {}, and kept are more", counted(jobs.len(), "job"));
            return Err(Diagnostic::usage(what, "remove its file, and run it again").into());
        }
        Ok(Shard { dealt: self, jobs, answers })
    }
}

/// A shard.
struct Shard<'a> {
    dealt: &'a Dealt,
    jobs: Vec<Job>,
    answers: Vec<JobAnswer>,
}

impl Part for Shard<'_> {
    fn step(&mut self) -> Result<bool, Halt> {
        let Some(&(place, variant, portion)) = self.jobs.get(self.answers.len()) else { return Ok(false) };
        let (clause, number) = self.dealt.checks[place];
        let (check, start) = (clause.checks[number], Instant::now());
        let watch = &mut |_: &Progress<'_>| std::ops::ControlFlow::Continue(());
        let mut context = Context { cache: &mut Cache::default(), watch, memory: MemoryLimit::any() };
        let answer = registered(check.decide_portion(variant, portion, &mut context));
        self.answers.push(JobAnswer::of(answer, start.elapsed().as_secs_f64()));
        Ok(!self.is_done())
    }

    fn far(&self) -> Result<Box<RawValue>, Diagnostic> {
        encode(&ShardProgress { answers: self.answers.clone() })
    }

    fn is_done(&self) -> bool {
        self.answers.len() == self.jobs.len()
    }

    fn facts(&self) -> Facts {
        Facts::Jobs { jobs: self.jobs.len(), jobs_done: self.answers.len() }
    }

    fn words(&self) -> String {
        format!("{} of {}", self.answers.len(), counted(self.jobs.len(), "job"))
    }
}

/// The facts of a plan, for programs.
#[derive(Serialize)]
struct PlanFacts {
    jobs: usize,
}

/// Deals the checks of these rules out among shards.
pub(super) fn plan(
    (path, shards): (&Path, u32),
    (rules, larger): (&[&'static Entry], bool),
    how: (&ForceArgs, Format),
    out: &mut Output,
) -> Result<Exit, Halt> {
    Plan::check(shards)?;
    let jobs = Dealt::of(&clauses(rules, larger), shards).jobs.len();
    let rules = rules.iter().map(|rule| rule.name.to_owned()).collect();
    let words = format!("{} for {}.", counted(jobs, "job"), counted(shards as usize, "shard"));
    let of = (Work::Library { rules, larger }, &*encode(&jobs)?);
    shards::plan((path, shards), of, (&PlanFacts { jobs }, &words), how, out)
}

/// Runs a shard.
pub(super) fn run(path: &Path, shard: u32, format: Format, out: &mut Output) -> Result<Exit, Halt> {
    let plan = Plan::read(path)?;
    let dealt = Dealt::restored(&plan)?;
    shards::run(&plan, shard, format, out, |far| Ok(Box::new(dealt.part(&plan, shard, far)?)))
}

/// The rows of all checks of a plan, of which these are the shards.
///
/// # Errors
/// [`Halt`] if a shard has done less than it was dealt, or what it has found is no counterexample.
pub(crate) fn rows(plan: &Plan, shards: &[ShardFile]) -> Result<Vec<Row>, Halt> {
    let dealt = Dealt::restored(plan)?;
    let mut answers = Vec::new();
    for (number, shard) in (1..).zip(shards) {
        shard.check(
            dealt.part(plan, number, Some(&shard.far)).map(|part| Box::new(part) as Box<dyn Part + '_>),
        )?;
        answers.extend(
            dealt.of_shard(plan, number).into_iter().zip(dealt.part(plan, number, Some(&shard.far))?.answers),
        );
    }
    answers.sort_by_key(|(job, _)| *job);
    let mut rows: Vec<Row> = Vec::new();
    for portions in
        answers.chunk_by(|((place, variant, _), _), (other, _)| (*place, *variant) == (other.0, other.1))
    {
        let (place, variant, _) = portions[0].0;
        let (clause, number) = dealt.checks[place];
        let check = clause.checks[number];
        let seconds: f64 = portions.iter().map(|(_, kept)| kept.seconds).sum();
        let answers = portions.iter().map(|(_, kept)| kept.clone().answer());
        let answer = Answer::merged(answers.collect::<Result<Vec<_>, _>>()?);
        match (variant.and_then(|variant| check.variants().get(variant).copied()), rows.last_mut()) {
            (Some(variant), Some(row)) => {
                row.decision.add(variant, answer);
                row.seconds += seconds;
            }
            (Some(_), None) => {}
            (None, _) => {
                let played = answer.counterexample.as_ref().map(|found| check.replay(&found.choices));
                let played = played.transpose().map_err(|unfit| {
                    let what = format!("what refutes {} cannot be played again: {unfit}", clause.id);
                    Diagnostic::usage(what, "remove the file of its shard, and run it again")
                })?;
                let counterexample = played.map(|played| played.evidence);
                let decision = Decision::of(Answer { counterexample, ..answer });
                rows.push(Row { clause, number, check, decision, undecided: None, seconds });
            }
        }
    }
    Ok(rows)
}
