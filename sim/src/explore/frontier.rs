//! Frontier cells (Rajesh, Nagaraja and Suja 2024): their row, and the start of their teams.

mod hunt;
mod layers;
mod scripted;
mod team;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::frontier::{Condition, Rule as Frontier};
use tautline_kernel::position::Odometry;

use self::hunt::{KernelHunt, RivalHunt};
pub use self::team::{ALONE, COVERS, ENDS, KNOWS, MARKS, ONCE};
use self::team::{Who, team};
use super::script::by_robots;
use super::switches::searched;
use super::{By, Clause, Look, Profile, RandomPart, Rule, RuleId, Setup, Starts, Team};
use crate::frontier::{Allowance, AssignedTeam, Assignment, Explorers};
use crate::options::{Extra, Options};
use tautline_grids::chance::Dice;

/// The rule without preferences.
const PLAIN: RuleId = RuleId::new("plain");

/// The rule by which robots wander.
const WANDERS: RuleId = RuleId::new("wanders");

/// The rule by which obstacles are not stored.
const LITERAL: RuleId = RuleId::new("literal");

/// The rule with equation (11) as printed.
const PRINTED: RuleId = RuleId::new("printed");

/// The most robots of a team.
const MAX_ROBOTS: usize = 64;

/// A rival, of which every layout is tried.
macro_rules! assigned {
    ($name:expr, $about:expr, $assignment:expr) => {
        Rule::new(RuleId::new($name), $about, |setup| start_assigned(setup, $assignment)).hunted(&RivalHunt)
    };
}

/// Robots that go to unexplored neighbours of their cells.
pub static FRONTIER: Profile = Profile {
    about: "Frontier cells: robots that go to unexplored cells beside explored ones and tell each other",
    rules: &[
        searched!(RuleId::PUBLISHED, "As the paper publishes it", Frontier::PUBLISHED),
        searched!(RuleId::REPAIRED, "With the repairs of its refuted claims", Frontier::REPAIRED),
        searched!(PLAIN, "With the repairs and without preferences", Frontier::PLAIN),
        searched!(WANDERS, "A robot without a candidate wanders", Frontier::WANDERS),
        searched!(LITERAL, "Obstacles are avoided to the letter", Frontier::LITERAL),
        searched!(PRINTED, "The occupancy probability is as printed", Frontier::PRINTED),
        assigned!("greedy", "The nearest pair of robot and frontier cell first", Assignment::Greedy),
        assigned!("hungarian", "Frontier cells by the Hungarian algorithm", Assignment::Hungarian),
        assigned!("hungarian-anew", "The same, anew at every move", Assignment::HungarianAnew),
        assigned!("earlier", "The nearest frontier cell that no earlier robot takes", Assignment::Earlier),
    ],
    robots: 1..=MAX_ROBOTS,
    starts: Starts::Alone,
    extras: &[
        Extra::RANGE,
        Extra::LOSS,
        Extra::NOISE,
        Extra::READINGS,
        Extra::ANCHORS,
        Extra::ODOMETRY,
        Extra::THRESHOLD,
        Extra::OBJECTS,
        Extra::OUTLIERS,
        Extra::SWARM,
        Extra::SMALL,
    ],
    needless,
    drawn: &[
        RandomPart { what: "which messages are lost", by: By::Told(Extra::LOSS) },
        RandomPart { what: "how far off each position is", by: By::Told(Extra::NOISE) },
        RandomPart { what: "how far off each move is", by: By::Told(Extra::ODOMETRY) },
        RandomPart { what: "where small obstacles are", by: By::Told(Extra::SMALL) },
        RandomPart { what: "where objects are, and are seen", by: By::Told(Extra::OBJECTS) },
        RandomPart { what: "to which of the nearest cells a robot goes", by: By::Rule(PLAIN) },
        RandomPart { what: "where a robot wanders", by: By::Rule(WANDERS) },
    ],
    look: Look::Robots,
    clauses: &[
        Clause { missed: Some("Within reach and unexplored"), ..Clause::new(COVERS.as_str()) },
        Clause::new(ALONE.as_str()),
        Clause::new(ENDS.as_str()),
        Clause::new(KNOWS.as_str()),
        Clause::new(MARKS.as_str()),
        Clause::new(ONCE.as_str()),
    ],
    ..Profile::named("frontier")
};

/// The team of `setup`, each robot at its start.
fn start(setup: &Setup, rule: Frontier) -> Result<Box<dyn Team>, Diagnostic> {
    setup.refuse_walls("frontier cells", "cells:6x7:0.1")?;
    if !setup.choices.is_empty() {
        return by_robots(setup, rule, [scripted::start::<1>, scripted::start::<2>, scripted::start::<3>]);
    }
    allowed(setup, &rule)?;
    let (starts, options) = (setup.starts(), setup.options.clone());
    let mut dice = Dice::new(setup.seed, *b"objects ");
    let objects =
        options.objects.as_ref().map(|objects| objects.places(&setup.layout.reachable(&starts), &mut dice));
    let robots = Explorers::new(rule, &setup.layout, &starts, options, setup.seed);
    let robots = robots.among(objects.unwrap_or_default()).looked_around();
    Ok(team(setup, Who::Robots(Box::new(robots))))
}

/// The team of `setup` whose cells are assigned.
fn start_assigned(setup: &Setup, assignment: Assignment) -> Result<Box<dyn Team>, Diagnostic> {
    setup.refuse_walls("frontier cells", "cells:6x7:0.1")?;
    if setup.options != Options::default() || !setup.choices.is_empty() {
        let what = format!("the rule {} knows neither radio nor positions", setup.rule);
        let remedy = "leave `range`, `loss`, `noise-db` and `threshold` out, or take `rule` repaired";
        return Err(Diagnostic::usage(what, remedy));
    }
    let robots = AssignedTeam::new(assignment, &setup.layout, &setup.starts());
    Ok(team(setup, Who::Assigned(Box::new(robots))))
}

/// Why an option has no effect in a run, and what would be right.
fn needless(setup: &Setup, extra: &Extra) -> Option<(&'static str, &'static str)> {
    let Setup { rule, options, .. } = setup;
    let (is_exact, has_wheels) = (options.noise_db == 0.0, options.odometry() != Odometry::EXACT);
    let exact = ("positions without noise are exact", "leave it out, or give `noise-db` as well");
    match extra.field {
        "threshold" if [RuleId::REPAIRED, PLAIN].contains(rule) => Some((
            "by this rule robots go to the nearest unexplored cells, whatever their occupancy probability",
            "leave it out, or take `rule` published",
        )),
        "anchors" if is_exact => Some(exact),
        // Without readings a robot goes by its wheels alone, which may err.
        "readings" if is_exact && (options.readings() > 0 || !has_wheels) => Some(exact),
        _ => None,
    }
}

/// Refuses a floor on which a robot would stand too long, before the run.
fn allowed(setup: &Setup, rule: &Frontier) -> Result<(), Diagnostic> {
    let allowance = Allowance::new(&setup.options, setup.layout.size().area());
    match allowance.filter(|_| rule.has(Condition::Fuse) && rule.has(Condition::Sure)) {
        None | Some(Allowance::Stops(0..=MOST_STOPS)) => Ok(()),
        Some(Allowance::Stops(stops)) => {
            let what = format!(
                "this floor is larger than its noise allows: in its worst cell a robot \
                 stands for {stops} team moves before each move"
            );
            let remedy = "take a smaller floor, less `noise-db`, or more `readings` or `anchors`";
            Err(Diagnostic::usage(what, format!("{remedy}; at most {MOST_STOPS} team moves are borne")))
        }
        Some(Allowance::Never) => {
            let what =
                "with wheels that err so much no fix makes a robot sure that it stays inside the next cell";
            Err(Diagnostic::of_field("odometry", what, "give `odometry` smaller errors, such as 0.02:1"))
        }
    }
}

/// The most team moves that a robot may have to stand in its worst cell.
const MOST_STOPS: u32 = 100;
