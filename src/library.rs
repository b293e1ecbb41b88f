//! `tautline library`: published rules of other people, listed and decided.

use std::fmt::Write;

use clap::Args;
use tautline_library::{Entry, RULES};
use tautline_proofs::clause::Clause;
use tautline_sim::diagnostic::{Diagnostic, Halt};

use super::output::Output;
use super::prove::{Deciding, Detail};
use super::{Exit, needless};

const EXAMPLES: &str = "\
Examples:
  tautline library
  tautline library pibt
  tautline library pibt rmf-lane --out refutations
  tautline library all --format json
  tautline library alpha --larger";

/// The word for every rule.
const ALL: &str = "all";

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
    #[command(flatten)]
    how: Deciding,
}

impl Library {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        if self.rules.is_empty() {
            if self.larger {
                return Err(needless("--larger", "without a name nothing is decided").into());
            }
            self.how.nothing_is_decided()?;
            out.text(list())?;
            return Ok(Exit::Expected);
        }
        let rules = self.chosen()?;
        let clauses: Vec<&'static Clause> = if self.larger {
            rules.iter().flat_map(|rule| rule.larger()).collect()
        } else {
            rules.iter().flat_map(|rule| rule.clauses()).collect()
        };
        if clauses.is_empty() {
            return Err(needless("--larger", "these rules have no larger bound").into());
        }
        self.how.decide(&clauses, Detail::Rows, out)
    }

    fn chosen(&self) -> Result<Vec<&'static Entry>, Diagnostic> {
        if self.rules == [ALL] {
            return Ok(RULES.to_vec());
        }
        let find = |name: &String| {
            RULES.iter().copied().find(|rule| rule.name.eq_ignore_ascii_case(name)).ok_or_else(|| {
                let known: Vec<&str> = RULES.iter().map(|rule| rule.name).collect();
                let remedy = format!("the rules are {}; or give {ALL} alone", known.join(", "));
                Diagnostic::usage(format_args!("there is no rule {name:?}"), remedy)
            })
        };
        self.rules.iter().map(find).collect()
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
