//! `tautline schemes`: the schemes that explore, their rules, and what can be done with each.

use std::fmt::Write;

use clap::Args;
use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_sim::explore::{Scheme, Senses};

use super::catalogue::CATALOGUE;
use super::exit::Exit;
use super::options::{Format, FormatArgs};
use super::output::Output;

const EXAMPLES: &str = "\
Examples:
  tautline schemes
  tautline schemes kit
  tautline schemes --format json";

/// List the schemes that explore, their rules, and what can be done with each.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Schemes {
    /// The schemes to list, by their names. Without one, all are.
    #[arg(value_name = "SCHEME")]
    names: Vec<String>,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(JsonSchema, Serialize)]
pub(super) struct SchemesJson {
    schemes: Vec<SchemeJson>,
}

#[derive(JsonSchema, Serialize)]
struct SchemeJson {
    name: &'static str,
    about: &'static str,
    /// The fewest and the most robots, the base counted if there is one.
    robots: [usize; 2],
    /// Whether its runs can be shrunk by `minimise`.
    minimise: bool,
    /// The clauses that its runs can break.
    clauses: Vec<&'static str>,
    /// The options of `explore` that it has beside those of all.
    options: Vec<String>,
    rules: Vec<RuleJson>,
}

#[derive(JsonSchema, Serialize)]
struct RuleJson {
    name: &'static str,
    about: &'static str,
    /// Whether it is taken where nobody says which.
    is_default: bool,
    /// Whether `hunt` searches all its runs.
    hunt: bool,
}

impl Schemes {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let schemes = self.chosen()?.into_iter().map(described).collect();
        match self.format.format {
            Format::Json => out.json(&SchemesJson { schemes })?,
            Format::Text => out.text(list(&schemes))?,
        }
        Ok(Exit::Expected)
    }

    fn chosen(&self) -> Result<Vec<Scheme>, Diagnostic> {
        if self.names.is_empty() {
            return Ok(CATALOGUE.schemes().collect());
        }
        let find = |name: &String| {
            CATALOGUE.scheme(name).ok_or_else(|| {
                let remedy = format!("the schemes are {}", CATALOGUE.names(|_| true).join(", "));
                Diagnostic::usage(format_args!("there is no scheme {name:?}"), remedy)
            })
        };
        self.names.iter().map(find).collect()
    }
}

fn described(scheme: Scheme) -> SchemeJson {
    let rules = scheme.rules.iter().map(|rule| RuleJson {
        name: rule.name.as_str(),
        about: rule.about,
        is_default: rule.name == scheme.default_rule(),
        hunt: rule.hunt.is_some(),
    });
    let miss = (scheme.senses == Senses::Floor).then(|| "--miss".to_owned());
    SchemeJson {
        name: scheme.name,
        about: scheme.about,
        robots: [*scheme.robots.start(), *scheme.robots.end()],
        minimise: !scheme.clauses.is_empty(),
        clauses: scheme.clauses.iter().map(|clause| clause.id.as_str()).collect(),
        options: miss
            .into_iter()
            .chain(scheme.extras.iter().map(|extra| format!("--{}", extra.field)))
            .collect(),
        rules: rules.collect(),
    }
}

fn list(schemes: &Vec<SchemeJson>) -> String {
    let mut text = String::new();
    for SchemeJson { name, about, robots: [fewest, most], minimise, clauses, options, rules } in schemes {
        let rest = if *minimise { "; explore, minimise" } else { "; explore" };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name}: {about}\n  {fewest} to {most} robots{rest}");
        if !options.is_empty() {
            let _ = writeln!(text, "  options: {}", options.join(" "));
        }
        if !clauses.is_empty() {
            let _ = writeln!(text, "  can break: {}", clauses.join(" "));
        }
        let width = rules.iter().map(|rule| rule.name.len()).max().unwrap_or(0);
        for RuleJson { name, about, is_default, hunt } in rules {
            let marks = [(*is_default, "the default"), (*hunt, "hunt")];
            let marks: Vec<&str> = marks.into_iter().filter(|(is, _)| *is).map(|(_, mark)| mark).collect();
            let marks = if marks.is_empty() { String::new() } else { format!(" ({})", marks.join(", ")) };
            let _ = writeln!(text, "  --rule {name:width$}  {about}{marks}");
        }
        text.push('\n');
    }
    text + "Run one: tautline explore open:15x15 --scheme NAME --rule RULE\n"
}
