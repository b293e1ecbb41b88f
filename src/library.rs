//! `tautline library`: published rules of other people, listed, decided, and hunted by random runs.

pub(super) mod hunt;
mod jobs;
mod rules;

use std::fmt::Write;
use std::num::{NonZeroU32, NonZeroU64};
use std::path::PathBuf;

use clap::Args;
use tautline_io::diagnostic::Halt;
use tautline_io::value_parser::{number, whole};
use tautline_library::RULES;
use tautline_proofs::decide::RandomRuns;
use tautline_proofs::ledger::Limits;

pub(super) use self::jobs::rows;
use self::rules::{chosen, clauses};
use super::exit::Exit;
use super::options::refuse_needless;
use super::output::Output;
use super::prove::{DecisionArgs, Detail};
use super::shards::Scope;
use super::value_parser::positive;

const EXAMPLES: &str = "\
Examples:
  tautline library
  tautline library pibt
  tautline library pibt rmf-lane --out refutations
  tautline library all --format json
  tautline library alpha --larger
  tautline library pibt --larger --memory 1GiB --spill /var/tmp/states
  tautline library pibt --larger --runs 100000 --out found
  tautline library all --plan plan.json --shards 8
  tautline library --plan plan.json --shard 1";

/// Most moves of a random run, unless the user says otherwise.
const MAX_MOVES: u32 = 1000;

/// Decide published rules of other people; without a name, list them.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Library {
    /// The rules to decide, by their names, or `all`. Without one, the rules are listed.
    #[arg(value_name = "RULE")]
    rules: Vec<String>,
    /// Decide the larger bounds, which take minutes and gigabytes. Some rules have none.
    #[arg(long)]
    larger: bool,
    /// Hunt: in place of all states, make at most N random runs for each check, until one breaks its promise. Of
    /// mutants none are made.
    #[arg(long, value_name = "N", value_parser = positive::<NonZeroU64>)]
    #[arg(conflicts_with_all = ["html", "certificate", "memory", "spill"])]
    runs: Option<NonZeroU64>,
    /// The seed of the random runs, 0 unless this says otherwise.
    #[arg(long, value_name = "SEED", value_parser = number::<u64>, requires = "runs")]
    seed: Option<u64>,
    /// Most moves of a random run, 1000 unless this says otherwise.
    #[arg(long, value_name = "K", value_parser = positive::<NonZeroU32>, requires = "runs")]
    max_moves: Option<NonZeroU32>,
    /// The plan: with --shards it is stored in FILE, with --shard it is read from there.
    #[arg(long, value_name = "FILE")]
    plan: Option<PathBuf>,
    /// Decide nothing yet, but deal the checks and their mutants out among N shards, each to be run on any machine.
    #[arg(long, value_name = "N", value_parser = whole::<u32>, requires = "plan")]
    #[arg(conflicts_with_all = ["shard", "runs", "out", "html", "certificate", "memory", "spill", "patience"])]
    shards: Option<u32>,
    /// Run shard K of the plan, from 1 on, and keep how far it is beside the plan; if it was begun, go on.
    #[arg(long, value_name = "K", value_parser = whole::<u32>, requires = "plan")]
    #[arg(conflicts_with_all = ["rules", "larger", "runs", "out", "html", "certificate"])]
    #[arg(conflicts_with_all = ["memory", "spill", "patience", "force"])]
    shard: Option<u32>,
    #[command(flatten)]
    how: DecisionArgs,
}

impl Library {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let (folder, replaceable, format) = self.how.files();
        let scope = Scope::of(self.plan.as_deref(), self.shards, self.shard)?;
        if let Scope::Shard(path, shard) = scope {
            return jobs::run(path, shard, format.plain()?, out);
        }
        if self.rules.is_empty() {
            let (has_runs, has_plan) = (self.runs.is_some(), self.plan.is_some());
            let wanted = [("--larger", self.larger), ("--runs", has_runs), ("--plan", has_plan)];
            refuse_needless(wanted, "without a name nothing is decided")?;
            self.how.nothing_is_decided()?;
            out.text(list())?;
            return Ok(Exit::Expected);
        }
        let rules = chosen(&self.rules)?;
        let clauses = clauses(&rules, self.larger);
        refuse_needless([("--larger", clauses.is_empty())], "these rules have no larger bound")?;
        match (scope, self.runs) {
            (Scope::Plan(path, shards), _) => {
                jobs::plan((path, shards), (&rules, self.larger), (self.how.force(), format.plain()?), out)
            }
            (_, Some(runs)) => {
                let (seed, most_moves) =
                    (self.seed.unwrap_or(0), self.max_moves.map_or(MAX_MOVES, NonZeroU32::get));
                let runs = RandomRuns { runs: runs.get(), seed, most_moves };
                let limits = Limits { patience_s: self.how.patience_s(), ..Limits::default() };
                hunt::hunt(&clauses, (&runs, &limits), (folder, &replaceable), format, out)
            }
            (_, None) => self.how.decide(&clauses, Detail::Rows, out),
        }
    }
}

/// The rules with their promises, and how many of the checks of each hold and are refuted.
fn list() -> String {
    let mut text = String::new();
    for rule in RULES {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}  {}\n  {}", rule.name, rule.title, rule.source);
        for clause in rule.clauses() {
            let _ = writeln!(text, "  {}  {}", clause.id, clause.sentence);
            for check in clause.checks {
                let _ = writeln!(text, "    {} {}: {}", check.expected().word(), check.rule(), check.bound());
            }
        }
        text.push('\n');
    }
    text + "Decide a rule, and see its counterexamples: tautline library NAME\n"
}
