//! Tables dealt out.

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use tautline_io::checkpoint::{Facts, Part, decode, encode};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::shards::{Plan, ShardFile, Work};
use tautline_proofs::engine::threads;
use tautline_proofs::plural::counted;

use crate::tables::{AS_WRITTEN, Experiment, find};

/// Jobs for each thread that are measured before the results are kept.
const JOBS_AT_ONCE: usize = 8;

/// How a table is dealt out: its jobs in turn.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Deal {
    settings: Box<RawValue>,
    jobs: usize,
}

/// How far a shard is.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ShardProgress {
    /// Work its jobs, in their order.
    results: Vec<Box<RawValue>>,
}

struct Jobs<'a> {
    asked: &'a (dyn Experiment + 'a),
    all: Vec<String>,
    results: Vec<Box<RawValue>>,
}

fn raw(text: String) -> Result<Box<RawValue>, Diagnostic> {
    RawValue::from_string(text)
        .map_err(|error| Diagnostic::usage(error, "report it: this is a bug of tautline"))
}

/// Deals the jobs of a table out.
///
/// # Errors
/// [`Halt`] if its settings cannot be measured.
pub fn deal_table(id: &str, asked: &dyn Experiment) -> Result<(Work, Box<RawValue>, usize), Halt> {
    let (settings, jobs) = (raw(asked.settings()?)?, asked.jobs()?.len());
    Ok((Work::Table { id: id.to_owned() }, encode(&Deal { settings, jobs })?, jobs))
}

/// The table that a plan deals out.
///
/// # Errors
/// [`Halt`] if it is none of a table, a person could not give its settings, or it has other jobs than they give.
pub fn restored(plan: &Plan) -> Result<Box<dyn Experiment>, Halt> {
    let none = || plan.none_of("a table");
    let Work::Table { id } = &plan.of else { return Err(none().into()) };
    let table = find(id).ok_or_else(none)?;
    let deal: Deal = decode(&plan.deal, AS_WRITTEN).map_err(|fault| fault.found_in(plan.path()))?;
    let settings = deal.settings.get();
    let asked = table.restored(settings).map_err(|fault| plan.fault(settings, &fault))?;
    let jobs = asked.jobs()?.len();
    if jobs == 0 {
        let what = "its settings give nothing to measure";
        return Err(Diagnostic::in_file(plan.path(), what, AS_WRITTEN).into());
    }
    if jobs != deal.jobs {
        let what = format!("{} are dealt out, and its settings give {jobs}", counted(deal.jobs, "job"));
        return Err(Diagnostic::in_file(plan.path(), what, AS_WRITTEN).into());
    }
    Ok(asked)
}

/// A shard of a table, where it was.
///
/// # Errors
/// [`Halt`] if the plan has no such shard, or it was never there.
pub fn table_part<'a>(
    plan: &Plan,
    asked: &'a dyn Experiment,
    shard: u32,
    far: Option<&RawValue>,
) -> Result<Box<dyn Part + 'a>, Halt> {
    plan.check_shard(shard)?;
    let (first, of) = (shard as usize - 1, plan.shards as usize);
    let jobs: Vec<String> = asked.jobs()?.into_iter().skip(first).step_by(of).collect();
    let results = far
        .map(|far| decode::<ShardProgress>(far, AS_WRITTEN))
        .transpose()?
        .map_or(Vec::new(), |far| far.results);
    if results.len() > jobs.len() {
        let what = format!("shard {shard} has {}, and kept are more", counted(jobs.len(), "job"));
        return Err(Diagnostic::usage(what, "remove its file, and run it again").into());
    }
    Ok(Box::new(Jobs { asked, all: jobs, results }))
}

/// The results of all jobs of the table that is `asked`, in their order.
///
/// # Errors
/// [`Halt`] if they do not fit their plan, or a shard has done less than it was dealt.
pub fn merge_table(plan: &Plan, asked: &dyn Experiment, shards: &[ShardFile]) -> Result<Vec<String>, Halt> {
    let deal: Deal = decode(&plan.deal, AS_WRITTEN)?;
    for (number, shard) in (1..).zip(shards) {
        shard.check(table_part(plan, asked, number, Some(&shard.far)))?;
    }
    let fars = shards
        .iter()
        .map(|shard| decode::<ShardProgress>(&shard.far, AS_WRITTEN))
        .collect::<Result<Vec<_>, _>>()?;
    let mut shards: Vec<_> = fars.into_iter().map(|far| far.results.into_iter()).collect();
    let of = shards.len();
    let next = |job: usize| {
        let result = shards.get_mut(job % of).and_then(Iterator::next);
        let missing =
            || Diagnostic::usage(format_args!("the result of job {job} is missing"), "run its shard again");
        Ok(result.ok_or_else(missing)?.get().to_owned())
    };
    (0..deal.jobs).map(next).collect()
}

impl Part for Jobs<'_> {
    fn step(&mut self) -> Result<bool, Halt> {
        let at_once = JOBS_AT_ONCE * rayon::current_num_threads();
        let next = self.all.iter().skip(self.results.len()).take(at_once);
        let measure = |job: &String| -> Result<_, Halt> { Ok(raw(self.asked.measure(job)?)?) };
        let measured = threads::try_each(next, measure)?;
        self.results.extend(measured);
        Ok(!self.is_done())
    }

    fn far(&self) -> Result<Box<RawValue>, Diagnostic> {
        encode(&ShardProgress { results: self.results.clone() })
    }

    fn is_done(&self) -> bool {
        self.results.len() == self.all.len()
    }

    fn facts(&self) -> Facts {
        Facts::Jobs { jobs: self.all.len(), jobs_done: self.results.len() }
    }

    fn words(&self) -> String {
        format!("{} of {}", self.results.len(), counted(self.all.len(), "job"))
    }
}
