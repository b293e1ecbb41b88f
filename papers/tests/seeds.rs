//! Each scheme and its seed: a run in which nothing is drawn is the same with every seed, and whatever is drawn makes
//! runs differ.

use std::num::NonZeroU32;

use tautline_grids::chance::Probability;
use tautline_grids::layout::{Generator, Layout};
use tautline_papers::rivals::CATALOGUE;
use tautline_sim::explore::{By, ExplorationRequest, Limits, RandomPart, Rule, Scheme, explore};
use tautline_sim::options::Extra;

const SEEDS: u64 = 6;

/// An option that a run is told besides, if any.
#[derive(Clone, Copy, PartialEq, Debug)]
enum RunOption {
    Nothing,
    Miss,
    Extra(&'static Extra),
}

impl RunOption {
    fn all() -> impl Iterator<Item = Self> {
        [Self::Nothing, Self::Miss].into_iter().chain(Extra::ALL.map(Self::Extra))
    }

    fn tell(self, asked: &mut ExplorationRequest) {
        match self {
            Self::Nothing => {}
            Self::Miss => asked.miss = Probability::new(0.3),
            Self::Extra(extra) => {
                let word = match extra.field {
                    "range" | "objects" => "3",
                    "sight" => "2",
                    "loss" | "small" | "outliers" => "0.3",
                    "noise-db" => "12",
                    "readings" | "anchors" => "5",
                    "odometry" => "0.3:20",
                    "threshold" => "0.4",
                    "speed" | "spread" => "0.5",
                    "fail" => "3@9",
                    "wall" => "3,3,E@9",
                    "speeds" | "swarm" => "",
                    field => panic!("no value for {field}"),
                };
                (extra.read)(word, &mut asked.options).expect("a value");
            }
        }
    }
}

/// A run with this seed: whether it is said to draw anything, and all that came of it. `None` if the rule cannot be
/// told that.
fn run(scheme: Scheme, rule: &Rule, told: RunOption, layout: &Layout, seed: u64) -> Option<(bool, String)> {
    let limits = Limits { max_moves: NonZeroU32::new(60), ..Limits::default() };
    let mut asked =
        ExplorationRequest { robots: Some(4), seed, limits, ..ExplorationRequest::new(scheme, rule.name) };
    told.tell(&mut asked);
    let setup = asked.setup(layout.clone()).ok()?;
    let mut moves = Vec::new();
    let report = explore(&setup, &mut |made| {
        moves.push(format!("{:?}", made.frame));
        Ok(())
    });
    let report = report.ok()?;
    let seen = format!(
        "{moves:?} {:?} {:?} {:?} {:?}",
        report.violations, report.failures, report.milliseconds, report.objects
    );
    Some((scheme.draws(&setup), seen))
}

#[test]
fn each_scheme_says_what_its_seed_draws() {
    for scheme in CATALOGUE.schemes() {
        let mut seen: Vec<&RandomPart> = Vec::new();
        for (rule, told) in
            scheme.rules.iter().flat_map(|rule| RunOption::all().map(move |told| (rule, told)))
        {
            // An open area has most ways that are as good; obstacles make messages matter, and walls the order of
            // robots.
            for layout in ["open:7x6", "cells:7x6:0.2", "walls:7x6:0.2"] {
                let layout = layout.parse::<Generator>().and_then(|generator| generator.generate(5));
                let layout = layout.expect("a layout");
                let runs: Option<Vec<_>> =
                    (0..SEEDS).map(|seed| run(scheme, rule, told, &layout, seed)).collect();
                let Some(runs) = runs else { continue };
                let (draws, first) = &runs[0];
                let differ = runs.iter().any(|(_, other)| other != first);
                assert!(*draws || !differ, "{} ({}), {told:?}: a seed has an effect", scheme.name, rule.name);
                let by = scheme.drawn.iter().filter(|drawn| match drawn.by {
                    By::Every => told == RunOption::Nothing,
                    By::Miss => told == RunOption::Miss,
                    By::Told(extra) => told == RunOption::Extra(extra),
                    By::Rule(name) => name == rule.name && told == RunOption::Nothing,
                });
                seen.extend(by.filter(|_| differ));
            }
        }
        for drawn in scheme.drawn {
            assert!(seen.contains(&drawn), "{}: {drawn} has no effect in any run", scheme.name);
        }
    }
}

#[test]
fn of_a_scheme_in_which_every_run_draws_no_rule_is_without_chance() {
    let of_every = |scheme: &Scheme| scheme.drawn.iter().any(|drawn| drawn.by == By::Every);
    let open = Layout::open(7, 6).expect("a layout");
    for scheme in CATALOGUE.schemes().filter(of_every) {
        for rule in scheme.rules {
            let run = |seed| run(scheme, rule, RunOption::Nothing, &open, seed).expect("a run").1;
            assert!((1..SEEDS).any(|seed| run(seed) != run(0)), "{} ({})", scheme.name, rule.name);
        }
    }
}
