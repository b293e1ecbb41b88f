//! Frontier cells (Rajesh, Nagaraja and Suja 2024): their row, and their teams: the kernel's robots, rivals that assign
//! cells, and runs that a search has found.

mod hunt;
mod layers;
mod scripted;

use std::collections::BTreeSet;

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::frontier::{Condition, Rule as Frontier};
use tautline_kernel::ground::Cell;
use tautline_kernel::position::Odometry;
use tautline_proofs::run::Frame;

use self::hunt::{KernelHunt, RivalHunt};
use super::catalogue::{By, Look, Profile, RandomPart, Starts};
use super::clause::{Clause, ClauseId, broken};
use super::connectivity::has_double;
use super::rule::{Rule, RuleId, SwitchableRule};
use super::run::{End, Surroundings, Survey, Team};
use super::scene::{Layer, Scene};
use super::setup::Setup;
use crate::frontier::{Allowance, AssignedTeam, Assignment, Explorers, TeamEnd};
use crate::objects::ObjectReport;
use crate::options::{Extra, Options};
use tautline_grids::chance::Dice;
use tautline_grids::layout::Layout;

/// The run ends, and a cell in reach is unexplored.
pub const COVERS: ClauseId = ClauseId::new("FRONTIER-1");

/// Two robots are in one cell.
pub const ALONE: ClauseId = ClauseId::new("FRONTIER-2");

/// The run goes on for ever.
pub const ENDS: ClauseId = ClauseId::new("FRONTIER-3");

/// The run ends, and a robot does not know it.
pub const KNOWS: ClauseId = ClauseId::new("FRONTIER-4");

/// A robot notes of a cell what is not so.
pub const MARKS: ClauseId = ClauseId::new("FRONTIER-5");

/// The rule without preferences.
const PLAIN: RuleId = RuleId::new("plain");

/// The rule by which robots wander.
const WANDERS: RuleId = RuleId::new("wanders");

/// The most robots of a team.
const MAX_ROBOTS: usize = 64;

const MISSED: &str = "Within reach and unexplored";

/// A rule of the kernel, hunted through all states.
macro_rules! searched {
    ($name:expr, $about:expr, $rule:expr) => {
        Rule::new($name, $about, |setup| start(setup, $rule)).hunted(&KernelHunt($rule)).switched(
            &SwitchableRule { rule: $rule, start, hunt: |rule, _| Some(Box::new(KernelHunt(rule))) },
        )
    };
}

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
        searched!(RuleId::new("literal"), "Obstacles are avoided to the letter", Frontier::LITERAL),
        searched!(RuleId::new("printed"), "The occupancy probability is as printed", Frontier::PRINTED),
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
        Clause { missed: Some(MISSED), ..Clause::new(COVERS.as_str()) },
        Clause::new(ALONE.as_str()),
        Clause::new(ENDS.as_str()),
        Clause::new(KNOWS.as_str()),
        Clause::new(MARKS.as_str()),
    ],
    ..Profile::named("frontier")
};

/// Who explores.
enum Who {
    Robots(Box<Explorers>),
    Assigned(Box<AssignedTeam>),
}

struct FrontierTeam {
    who: Who,
    /// Cells in reach of a start.
    due: Vec<Cell>,
    /// Those of them that no robot was in.
    left: BTreeSet<Cell>,
    /// How it has ended.
    ended: Option<TeamEnd>,
}

/// The team of `setup`, each robot at its start.
fn start(setup: &Setup, rule: Frontier) -> Result<Box<dyn Team>, Diagnostic> {
    setup.refuse_walls("frontier cells", "cells:6x7:0.1")?;
    if !setup.choices.is_empty() {
        return scripted::start(setup, rule);
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

fn team(setup: &Setup, who: Who) -> Box<dyn Team> {
    let starts = setup.starts();
    let due = setup.layout.reachable(&starts);
    let left = due.iter().copied().filter(|cell| !starts.contains(cell)).collect();
    Box::new(FrontierTeam { who, due, left, ended: None })
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

impl Team for FrontierTeam {
    fn cells(&self) -> &[Cell] {
        match &self.who {
            Who::Robots(robots) => robots.cells(),
            Who::Assigned(robots) => robots.cells(),
        }
    }

    fn advance(&mut self, _: &mut dyn Surroundings) -> Result<Frame, End> {
        let made = match &mut self.who {
            Who::Robots(robots) => robots.advance(),
            Who::Assigned(robots) => robots.advance(),
        };
        if let Ok(frame) = &made {
            for cell in &frame.cells {
                self.left.remove(cell);
            }
        }
        made.map_err(|ended| {
            self.ended = Some(ended);
            match ended {
                TeamEnd::Known if self.left.is_empty() => End::Explored,
                TeamEnd::Known | TeamEnd::Still => End::Exhausted,
                TeamEnd::Endless => End::Endless,
                TeamEnd::Idle => End::Idle,
            }
        })
    }

    fn due(&self, _: &Layout) -> u32 {
        self.due.len() as u32
    }

    fn missed(&self, _: &Layout, chart: &Survey) -> Vec<Cell> {
        chart.unexplored(self.due.iter().copied())
    }

    fn broken_in_move(&self, _: &[Cell], frame: &Frame) -> Vec<ClauseId> {
        let is_double = has_double(&frame.cells);
        let is_wrong = match &self.who {
            Who::Robots(robots) => robots.is_wrong(),
            Who::Assigned(_) => false,
        };
        broken([(is_double, ALONE), (is_wrong, MARKS)])
    }

    fn broken_at_end(&self, layout: &Layout, chart: &Survey, end: End) -> Vec<ClauseId> {
        let is_endless = end == End::Endless;
        let is_short = !is_endless && end != End::Idle && !self.missed(layout, chart).is_empty();
        let knows_not = self.ended == Some(TeamEnd::Still);
        broken([(is_short, COVERS), (is_endless, ENDS), (knows_not, KNOWS)])
    }

    fn objects(&self) -> Vec<ObjectReport> {
        match &self.who {
            Who::Robots(robots) => {
                robots.objects().iter().map(|(at, known)| ObjectReport::new(*at, known.as_ref())).collect()
            }
            Who::Assigned(_) => Vec::new(),
        }
    }

    fn layers(&self) -> Vec<Layer> {
        match &self.who {
            Who::Robots(robots) => layers::layers(robots),
            Who::Assigned(_) => layers::layers_of_assigned(),
        }
    }

    fn show(&self, _: &[Cell], scene: &mut Scene) {
        match &self.who {
            Who::Robots(robots) => layers::show(robots, scene),
            Who::Assigned(robots) => layers::show_assigned(robots, scene),
        }
    }
}
