//! The clauses of frontier cells, in the order of `SPEC.md`.

use tautline_kernel::frontier::Condition::{
    self, Bypass, Claim, Corner, Detour, Fuse, Gate, Keep, Lapse, Look, Nearer, Record, Return, Route, Share,
    Sure, Tell, Track, Turn,
};
use tautline_kernel::frontier::{Basis, Occupancy, Rule};

use super::areas::{Areas, Size};
use super::detour::{self, Round};
use super::drift::{self, Drift, PARTS};
use super::fusion::{self, FusedBudget, StandingRobot};
use super::local::Alone;
use super::pairs;
use super::place::{self, ErrorBudget};
use super::readings::{LITERAL_T, OF_TEAMS, PAPER, READINGS, SEES, adaptive};
use super::world::Demand;
use crate::clause::{Check, Clause, NamedRule, Reading, holding};
use crate::decide::{EveryAnswer, EveryState};
use crate::local::EveryNumber;
use crate::plural::listed;
use crate::step_checks;

const PUBLISHED: NamedRule<Rule> = NamedRule::new("published", Rule::PUBLISHED);
const WANDERS: NamedRule<Rule> = NamedRule::new("wanders", Rule::WANDERS);
const LITERAL: NamedRule<Rule> = NamedRule::new("literal", Rule::LITERAL);
const PRINTED: NamedRule<Rule> = NamedRule::new("printed", Rule::PRINTED);
const PLAIN: NamedRule<Rule> = NamedRule::new("plain", Rule::PLAIN);
const REPAIRED: NamedRule<Rule> = NamedRule::new("repaired", Rule::REPAIRED);

/// Both among obstacles smaller than a cell, which no theorem of Rocq speaks of.
const PLAIN_SMALL: NamedRule<Rule> = NamedRule::new("plain-S", Rule::PLAIN);
const REPAIRED_SMALL: NamedRule<Rule> = NamedRule::new("repaired-S", Rule::REPAIRED);
/// Both where a robot dies, of which no theorem speaks either.
const PLAIN_DEATH: NamedRule<Rule> = NamedRule::new("plain-D", Rule::PLAIN);
const REPAIRED_DEATH: NamedRule<Rule> = NamedRule::new("repaired-D", Rule::REPAIRED);

/// Robots that wander, whose threshold is the mean of the probabilities of all cells, and of the neighbours alone.
const ALL_CELLS: NamedRule<Rule> = NamedRule::new("wanders-T", Rule { basis: Basis::Cells, ..Rule::WANDERS });
const NEIGHBOURS_ALONE: NamedRule<Rule> =
    NamedRule::new("the own cell does not count", adaptive(Rule::WANDERS));
/// Robots that do not store obstacles, whose threshold follows from earlier probabilities, and does not.
const ADAPTIVE: NamedRule<Rule> = NamedRule::new("literal-T", LITERAL_T);
const NEVER_ADAPTED: NamedRule<Rule> = NamedRule::new("the threshold stays as it is given", Rule::LITERAL);

const REFUTED: [Reading<Rule>; 15] = holding(READINGS, []);
/// Those as (11) is corrected: as it is printed, a robot alone never moves, so that nothing is shown.
const MARKS: [Reading<Rule>; 7] =
    [REFUTED[0], REFUTED[1], REFUTED[2], REFUTED[7], REFUTED[8], REFUTED[9], REFUTED[10]];
/// Robots that wander do not stop while a cell is left out, and know it then, unless they go to no unexplored one.
const COVERS: [Reading<Rule>; 15] = holding(READINGS, [0, 2]);
const COVERS_OF_TWO: [Reading<Rule>; 31] = holding(OF_TEAMS, [0, 2, 16, 18]);
/// Robots that do not see each other keep apart where none moves: as (11) is printed, robots move only if they wander,
/// and then to where others have started.
const APART: [Reading<Rule>; 31] =
    holding(OF_TEAMS, [3, 5, 11, 13, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30]);
/// One robot that goes to no unexplored cell, at once or after a move, ends unless it wanders.
const ENDS: [Reading<Rule>; 15] = holding(READINGS, [3, 4, 5, 6, 7, 9, 11, 12, 13, 14]);
/// Two that wander go to and fro between their starts, and a threshold stays above 0 beside another robot.
const ENDS_OF_TWO: [Reading<Rule>; 31] = holding(OF_TEAMS, [3, 5, 7, 11, 13, 15, 19, 21, 23, 27, 29]);
/// Robots that see each other store one as an obstacle in an unexplored cell, which none enters as (11) is printed.
const MARKS_OF_TWO: [Reading<Rule>; 31] =
    holding(OF_TEAMS, [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 19, 20, 21, 22, 27, 28, 29, 30]);

/// As (11) is printed, no robot enters a frontier cell.
const ONCE: [Reading<Rule>; 31] =
    holding(OF_TEAMS, [3, 4, 5, 6, 11, 12, 13, 14, 19, 20, 21, 22, 27, 28, 29, 30]);

/// One condition taken out of a rule, under its name.
const fn without(rule: Rule, condition: Condition) -> NamedRule<Rule> {
    let name = match condition {
        Route => "no way through explored cells",
        Record => "obstacles are not stored",
        Look => "enters without a look",
        Turn => "no slots",
        Tell => "a robot is an obstacle",
        Track => "every fix is believed",
        Share => "only what is new is told",
        Nearer => "others do not count",
        Claim => "claims do not count",
        Corner => "unexplored neighbours do not count",
        Fuse => "fixes are believed without covariance",
        Gate => "no gate",
        Sure => "unsure robots move",
        Detour => "small obstacles fill cells",
        Lapse => "stale claims",
        Keep => "farther cells without news",
        Return => "nobody turns back",
        Bypass => "a dead robot is a robot",
    };
    NamedRule::new(name, rule.without(condition))
}

const fn plain(condition: Condition) -> NamedRule<Rule> {
    without(Rule::PLAIN, condition)
}

const fn repaired(condition: Condition) -> NamedRule<Rule> {
    without(Rule::REPAIRED, condition)
}

/// Any number of robots that follow this rule.
const fn alone(rule: NamedRule<Rule>) -> NamedRule<Alone> {
    NamedRule::new(rule.name, Alone::of(rule.rule))
}

/// The areas in which counterexamples are looked for.
const SMALLEST: [Size; 5] = [(1, 1), (2, 1), (3, 1), (4, 1), (2, 2)];
/// The areas of one robot.
const ONE: [Size; 9] = [(1, 1), (2, 1), (3, 1), (4, 1), (2, 2), (5, 1), (3, 2), (4, 2), (3, 3)];
/// Those of two.
const TWO: [Size; 6] = [(2, 1), (3, 1), (4, 1), (2, 2), (5, 1), (3, 2)];
/// The areas of two robots with preferences, which have fewer states.
const TWO_REPAIRED: [Size; 7] = [(2, 1), (3, 1), (4, 1), (2, 2), (5, 1), (3, 2), (4, 2)];
/// Those of three.
const THREE: [Size; 5] = [(3, 1), (4, 1), (2, 2), (5, 1), (3, 2)];

/// The situations of a robot that is alone.
const ALONE: [&str; 4] = ["a decision", "an open cell", "an obstacle", "an arrival"];
/// The situations of several robots.
const ALL: [&str; 6] = ["a decision", "an open cell", "an obstacle", "a robot", "an arrival", "a slot"];

const fn smallest<const ROBOTS: usize>(demand: Demand) -> Areas<ROBOTS> {
    Areas { sizes: &SMALLEST, max_losses: 0, max_wrong: 0, max_small: 0, max_deaths: 0, demand, covers: &[] }
}

const fn one(demand: Demand) -> Areas<1> {
    Areas { sizes: &ONE, covers: &ALONE, ..smallest(demand) }
}

const fn two(demand: Demand) -> Areas<2> {
    Areas { sizes: &TWO, covers: &ALL, ..smallest(demand) }
}

const fn three(demand: Demand) -> Areas<3> {
    Areas { sizes: &THREE, covers: &ALL, ..smallest(demand) }
}

/// These areas for a team of whom a robot turns back.
const fn turned_back<const ROBOTS: usize>(areas: Areas<ROBOTS>) -> Areas<ROBOTS> {
    Areas { covers: &["a way back", "an open cell"], ..areas }
}

/// These areas for a team of whose messages one may be lost.
const fn lossy<const ROBOTS: usize>(areas: Areas<ROBOTS>) -> Areas<ROBOTS> {
    Areas { max_losses: 1, ..areas }
}

/// These areas with an obstacle that is smaller than a cell.
const fn small<const ROBOTS: usize>(areas: Areas<ROBOTS>) -> Areas<ROBOTS> {
    Areas { max_small: 1, covers: &["a small obstacle", "an arrival"], ..areas }
}

/// These areas for a team of whom a robot may die.
const fn deadly<const ROBOTS: usize>(areas: Areas<ROBOTS>) -> Areas<ROBOTS> {
    Areas { max_deaths: 1, covers: &["a body", "an arrival"], ..areas }
}

const fn two_repaired(demand: Demand) -> Areas<2> {
    Areas { sizes: &TWO_REPAIRED, ..two(demand) }
}

/// One robot, of whose fixes one may be wrong.
const fn wrong(demand: Demand) -> Areas<1> {
    Areas { max_wrong: 1, ..one(demand) }
}

/// One robot in small areas whose fixes drift.
const fn drifting(range: fn() -> String) -> EveryState<Drift, Drift> {
    EveryState {
        range,
        system: |&drift| drift,
        starts: |drift| drift.starts(&SMALLEST),
        most_steps: 10_000_000,
        covers: &["an obstacle", "an arrival"],
        tell: |before, step| drift::tell(before, &step.state),
    }
}

/// The bound with fixes that are off by so many sixteenths, in words.
fn off_by(error: u8) -> String {
    let sizes = listed(SMALLEST.map(|(width, height)| format!("{width}×{height}")));
    format!(
        "all obstacles in {sizes} cells, all starts, 1 robot, each fix off by 0 or {error}/{PARTS} of a cell"
    )
}

/// One robot that follows this rule, each of whose fixes is off by so many sixteenths of a cell.
const fn off(rule: NamedRule<Rule>, error: u8) -> NamedRule<Drift> {
    NamedRule::new(rule.name, Drift { rule: rule.rule, error, max_obstacles: 64 })
}

/// The least error of a fix with which 2E < L/2 does not hold, the greatest below it, and the greatest with E < L/2.
const QUARTER: u8 = 4;
const BELOW_QUARTER: u8 = 3;
const BELOW_HALF: u8 = 7;

step_checks! { ErrorBudget;
    believed: place::believes, NamedRule::new("repaired", ErrorBudget::FIXES), place::errors,
        covers ["at the midpoint", "beside the midpoint"], unwind 9, mutants {
            at_most: "2E + D = L/2 is borne" => ErrorBudget::FIXES_AT_MOST,
            once: "the fix before the move does not count" => ErrorBudget::TRACKED,
            no_odometry: "odometry does not count" => ErrorBudget::FIXES_ALONE,
        };
    tracked: place::counts, NamedRule::new("repaired", ErrorBudget::TRACKED), place::errors,
        covers ["at the midpoint", "beside the midpoint"], unwind 9, mutants {
            at_most: "E + D = L/2 is borne" => ErrorBudget::TRACKED_AT_MOST,
            no_odometry: "odometry does not count" => ErrorBudget::TRACKED_ALONE,
        };
}

step_checks! { Occupancy;
    occupancy: place::occupies, NamedRule::new("repaired", Occupancy::Corrected), place::places,
        covers ["inside", "outside"], unwind 9, mutants {
            printed: "as it is printed" => Occupancy::Printed,
        };
}

/// Equation (11) with the distance to the nearest side of the cell.
const SIDES: NamedRule<Occupancy> = NamedRule::new("sides", Occupancy::Rim);
/// The readings of its distance but for the one to the midpoint: to the circle's rim it is the corrected equation.
const OCCUPANCIES: [Reading<Occupancy>; 2] =
    holding([("circle", Occupancy::Corrected), (SIDES.name, SIDES.rule)], [0]);

/// The clauses.
pub const CLAUSES: [Clause; 13] = [
    Clause {
        id: "FRONTIER-1",
        sentence: "Every cell that a robot can reach MUST be explored when the run ends.",
        checks: &[
            &Check::refuted(PUBLISHED, &smallest::<1>(Demand::Covers)).under(&COVERS).of(&PAPER),
            &Check::refuted(PUBLISHED, &smallest::<2>(Demand::Covers)).under(&COVERS_OF_TWO).of(&PAPER),
            &Check::refuted(PRINTED, &smallest::<1>(Demand::Covers)).because("another reading of the paper"),
            &Check::holds(ALL_CELLS, &smallest::<1>(Demand::Covers), &[NEIGHBOURS_ALONE]),
            &Check::holds(PLAIN, &one(Demand::Covers), &[plain(Route)]),
            &Check::holds(PLAIN, &two(Demand::Covers), &[plain(Route)]),
            &Check::holds(PLAIN, &three(Demand::Covers), &[plain(Route)]),
            &Check::holds(PLAIN, &lossy(two(Demand::Covers)), &[plain(Route)]),
            &Check::holds(REPAIRED, &one(Demand::Covers), &[repaired(Route)]),
            &Check::holds(REPAIRED, &two_repaired(Demand::Covers), &[repaired(Route)]),
            &Check::holds(REPAIRED, &three(Demand::Covers), &[repaired(Route)]),
            &Check::holds(REPAIRED, &lossy(two_repaired(Demand::Covers)), &[repaired(Route)]),
            &Check::holds(REPAIRED, &lossy(three(Demand::Covers)), &[repaired(Route)]),
            &Check::holds(PLAIN_SMALL, &small(one(Demand::Covers)), &[plain(Detour)]),
            &Check::holds(REPAIRED_SMALL, &small(two_repaired(Demand::Covers)), &[repaired(Detour)]),
            &Check::holds(PLAIN_DEATH, &deadly(two(Demand::Covers)), &[plain(Route)]),
            &Check::holds(REPAIRED_DEATH, &deadly(two_repaired(Demand::Covers)), &[repaired(Route)]),
            &Check::holds(REPAIRED_DEATH, &deadly(three(Demand::Covers)), &[repaired(Route)]),
            &Check::holds(REPAIRED_DEATH, &lossy(deadly(two(Demand::Covers))), &[repaired(Route)]),
        ],
    },
    Clause {
        id: "FRONTIER-2",
        sentence: "Two robots MUST never be in one cell.",
        checks: &[
            &Check::refuted(PUBLISHED, &smallest::<2>(Demand::Alone)).under(&APART).of(&PAPER),
            &Check::holds(PLAIN, &two(Demand::Alone), &[plain(Look)]),
            &Check::holds(PLAIN, &three(Demand::Alone), &[plain(Look)]),
            &Check::holds(PLAIN, &lossy(two(Demand::Alone)), &[plain(Look)]),
            &Check::holds(REPAIRED, &two_repaired(Demand::Alone), &[repaired(Look)]),
            &Check::holds(REPAIRED, &three(Demand::Alone), &[repaired(Look)]),
            &Check::holds(REPAIRED, &lossy(two_repaired(Demand::Alone)), &[repaired(Look)]),
            &Check::holds(REPAIRED, &lossy(three(Demand::Alone)), &[repaired(Look)]),
            &Check::holds(REPAIRED_SMALL, &small(two_repaired(Demand::Alone)), &[repaired(Look)]),
            &Check::holds(PLAIN_DEATH, &deadly(two(Demand::Alone)), &[plain(Look)]),
            &Check::holds(REPAIRED_DEATH, &deadly(two_repaired(Demand::Alone)), &[repaired(Look)]),
            &Check::holds(REPAIRED_DEATH, &deadly(three(Demand::Alone)), &[repaired(Look)]),
            &Check::holds(REPAIRED_DEATH, &lossy(deadly(two(Demand::Alone))), &[repaired(Look)]),
            &Check::holds(alone(PLAIN), &EveryNumber::DEFAULT, &[alone(plain(Look))]),
            &Check::holds(alone(REPAIRED), &EveryNumber::DEFAULT, &[alone(repaired(Look))]),
        ],
    },
    Clause {
        id: "FRONTIER-3",
        sentence: "Every run MUST end.",
        checks: &[
            &Check::holds(PUBLISHED, &smallest::<1>(Demand::Ends), &[without(Rule::PUBLISHED, Record)])
                .under(&ENDS)
                .of(&PAPER),
            &Check::holds(PUBLISHED, &smallest::<2>(Demand::Ends), &[without(Rule::PUBLISHED, Record)])
                .under(&ENDS_OF_TWO)
                .of(&PAPER),
            &Check::refuted(LITERAL, &smallest::<1>(Demand::Ends)).because("another reading of the paper"),
            &Check::refuted(WANDERS, &smallest::<1>(Demand::Ends)).because("another reading of the paper"),
            &Check::holds(ADAPTIVE, &smallest::<1>(Demand::Ends), &[NEVER_ADAPTED]),
            &Check::refuted(ADAPTIVE, &smallest::<2>(Demand::Ends)).because("another reading of the paper"),
            &Check::holds(PLAIN, &one(Demand::Ends), &[plain(Record)]),
            &Check::holds(PLAIN, &two(Demand::Ends), &[plain(Turn)]),
            &Check::holds(PLAIN, &three(Demand::Ends), &[plain(Turn)]),
            &Check::holds(PLAIN, &lossy(two(Demand::Ends)), &[plain(Share)]),
            &Check::holds(REPAIRED, &one(Demand::Ends), &[repaired(Record)]),
            &Check::holds(REPAIRED, &two_repaired(Demand::Ends), &[repaired(Turn)]),
            &Check::holds(REPAIRED, &three(Demand::Ends), &[repaired(Turn)]),
            &Check::holds(REPAIRED, &lossy(two_repaired(Demand::Ends)), &[repaired(Share)]),
            &Check::holds(REPAIRED, &lossy(three(Demand::Ends)), &[repaired(Share)]),
            &Check::holds(REPAIRED_SMALL, &small(two_repaired(Demand::Ends)), &[repaired(Turn)]),
            &Check::holds(PLAIN_DEATH, &deadly(two(Demand::Ends)), &[plain(Bypass)]),
            &Check::holds(REPAIRED_DEATH, &deadly(two_repaired(Demand::Ends)), &[repaired(Bypass)]),
            &Check::holds(REPAIRED_DEATH, &deadly(three(Demand::Ends)), &[repaired(Bypass)]),
            &Check::holds(REPAIRED_DEATH, &lossy(deadly(two(Demand::Ends))), &[repaired(Bypass)]),
        ],
    },
    Clause {
        id: "FRONTIER-4",
        sentence: "When the run ends, every robot MUST know that no cell is left that it could explore.",
        checks: &[
            &Check::refuted(PUBLISHED, &smallest::<1>(Demand::Knows)).under(&COVERS).of(&PAPER),
            &Check::holds(PLAIN, &one(Demand::Knows), &[plain(Route)]),
            &Check::holds(PLAIN, &two(Demand::Knows), &[plain(Route)]),
            &Check::holds(PLAIN, &three(Demand::Knows), &[plain(Route)]),
            &Check::holds(PLAIN, &lossy(two(Demand::Knows)), &[plain(Route)]),
            &Check::holds(REPAIRED, &one(Demand::Knows), &[repaired(Route)]),
            &Check::holds(REPAIRED, &two_repaired(Demand::Knows), &[repaired(Route)]),
            &Check::holds(REPAIRED, &three(Demand::Knows), &[repaired(Route)]),
            &Check::holds(REPAIRED, &lossy(two_repaired(Demand::Knows)), &[repaired(Lapse)]),
            &Check::holds(REPAIRED, &lossy(three(Demand::Knows)), &[repaired(Lapse)]),
            &Check::holds(REPAIRED_SMALL, &small(two_repaired(Demand::Knows)), &[repaired(Route)]),
            &Check::holds(PLAIN_DEATH, &deadly(two(Demand::Knows)), &[plain(Route)]),
            &Check::holds(REPAIRED_DEATH, &deadly(two_repaired(Demand::Knows)), &[repaired(Route)]),
            &Check::holds(REPAIRED_DEATH, &deadly(three(Demand::Knows)), &[repaired(Route)]),
            &Check::holds(REPAIRED_DEATH, &lossy(deadly(two(Demand::Knows))), &[repaired(Route)]),
        ],
    },
    Clause {
        id: "FRONTIER-5",
        sentence: "A robot MUST take a cell for explored only where a robot \
                   was, and for an obstacle only where one is.",
        checks: &[
            &Check::holds(
                PUBLISHED,
                &smallest::<2>(Demand::Marks),
                &[NamedRule::new("a robot is an obstacle", SEES)],
            )
            .under(&MARKS_OF_TWO)
            .of(&PAPER),
            &Check::refuted(PUBLISHED, &wrong(Demand::Marks)).under(&MARKS).of(&PAPER),
            &Check::refuted(off(PUBLISHED, QUARTER), &drifting(|| off_by(QUARTER)))
                .judged(|drift, choices| drift.case(&SMALLEST, choices)),
            &Check::holds(
                off(PUBLISHED, BELOW_QUARTER),
                &drifting(|| off_by(BELOW_QUARTER)),
                &[NamedRule::new("2E = L/2 is borne", off(PUBLISHED, QUARTER).rule)],
            ),
            &Check::holds(
                off(PLAIN, BELOW_HALF),
                &drifting(|| off_by(BELOW_HALF)),
                &[off(plain(Track), BELOW_HALF)],
            ),
            &Check::holds(PLAIN, &wrong(Demand::Marks), &[plain(Track)]),
            &Check::holds(
                off(REPAIRED, BELOW_HALF),
                &drifting(|| off_by(BELOW_HALF)),
                &[off(repaired(Track), BELOW_HALF)],
            ),
            &Check::holds(REPAIRED, &wrong(Demand::Marks), &[repaired(Track)]),
            &Check::holds(PLAIN, &two(Demand::Marks), &[plain(Tell)]),
            &Check::holds(PLAIN, &three(Demand::Marks), &[plain(Tell)]),
            &Check::holds(PLAIN, &lossy(two(Demand::Marks)), &[plain(Tell)]),
            &Check::holds(REPAIRED, &two_repaired(Demand::Marks), &[repaired(Tell)]),
            &Check::holds(REPAIRED, &three(Demand::Marks), &[repaired(Tell)]),
            &Check::holds(REPAIRED, &lossy(two_repaired(Demand::Marks)), &[repaired(Tell)]),
            &Check::holds(REPAIRED, &lossy(three(Demand::Marks)), &[repaired(Tell)]),
            &Check::holds(PLAIN_SMALL, &small(one(Demand::Marks)), &[plain(Detour)]),
            &Check::holds(REPAIRED_SMALL, &small(two_repaired(Demand::Marks)), &[repaired(Detour)]),
            &Check::holds(PLAIN_DEATH, &deadly(two(Demand::Marks)), &[plain(Tell)]),
            &Check::holds(REPAIRED_DEATH, &deadly(two_repaired(Demand::Marks)), &[repaired(Tell)]),
            &Check::holds(REPAIRED_DEATH, &deadly(three(Demand::Marks)), &[repaired(Tell)]),
            &Check::holds(REPAIRED_DEATH, &lossy(deadly(two(Demand::Marks))), &[repaired(Tell)]),
        ],
    },
    Clause {
        id: "FRONTIER-6",
        sentence: "A robot whose fixes err by at most E and whose moves by at most D, with 2E + D < L/2, MUST \
                   take each fix for the cell in which it is.",
        checks: &[&believed::CHECK],
    },
    Clause {
        id: "FRONTIER-7",
        sentence: "A robot that counts its cell by its moves, with E + D < L/2, \
                   MUST be in the cell that it has counted.",
        checks: &[&tracked::CHECK],
    },
    Clause {
        id: "FRONTIER-8",
        sentence: "The occupancy probability of a cell MUST be 1 at its midpoint, MUST not grow with the distance \
                   to it, and MUST be 0 from half a cell on.",
        checks: &[
            &Check::refuted(NamedRule::new("published", Occupancy::Printed), occupancy::CHECK.method)
                .under(&OCCUPANCIES)
                .judged(place::occupied),
            &Check::refuted(SIDES, occupancy::CHECK.method)
                .judged(place::occupied)
                .because("another reading of the paper"),
            &occupancy::CHECK,
        ],
    },
    Clause {
        id: "FRONTIER-9",
        sentence: "A robot with preferences MUST go to the unexplored cell that it is paired with, and to the one that \
                   comes first for it if all are the others', or if, without news, that one is farther than the one \
                   that it has claimed, or than a nearest one if it has claimed none.",
        checks: &[&Check::holds(
            REPAIRED,
            &EveryAnswer::new(pairs::goes, pairs::teams, &pairs::COVERS),
            &[repaired(Nearer), repaired(Claim), repaired(Corner), repaired(Lapse), repaired(Keep)],
        )],
    },
    Clause {
        id: "FRONTIER-10",
        sentence: "A robot whose fixes err by at most E and whose moves by at most D, and which corrects its place by \
                   at least the share K of what a fix says, MUST be in the cell that it has counted if E + D/K < L/2.",
        checks: &[&Check::holds(
            NamedRule::new("repaired", FusedBudget::FUSED),
            &EveryAnswer::new(
                fusion::stays,
                fusion::errors,
                &["a fix that is believed", "a fix that is weighed"],
            ),
            &[
                NamedRule::new("E + D/K = L/2 is borne", FusedBudget::AT_MOST),
                NamedRule::new("the share does not count", FusedBudget::WITHOUT_GAIN),
                NamedRule::new("wheels alone", FusedBudget::WHEELS_ALONE),
            ],
        )],
    },
    Clause {
        id: "FRONTIER-11",
        sentence: "A robot MUST stand where four standard deviations of its belief would not be inside the next cell, \
                   and fixes MUST make one that knows its heading, and whose drives err by less than an eighth of a \
                   cell, sure after finitely many.",
        checks: &[&Check::holds(
            NamedRule::new("repaired", StandingRobot::REPAIRED),
            &EveryAnswer::new(fusion::is_sure_again, fusion::stops, &["it moves on", "it stands"]),
            &[
                NamedRule::new(repaired(Sure).name, StandingRobot::UNSURE),
                NamedRule::new("wheels alone", StandingRobot::WHEELS_ALONE),
            ],
        )],
    },
    Clause {
        id: "FRONTIER-12",
        sentence: "A robot that takes itself to be at the midpoint of its cell and errs by at most E, with E + F < \
                   L/2 for the five steps F of a detour, MUST stay in its cell until it enters the next one through \
                   the side between both, and MUST pass the middle of that side at F/2 − (1 + F/L) E or more.",
        checks: &[&Check::holds(
            NamedRule::new("repaired", Round::FIVE_STEPS),
            &EveryAnswer::new(
                detour::goes_round,
                detour::errors,
                &["it passes an obstacle", "it may touch one"],
            ),
            &[
                NamedRule::new("E + F = L/2 is borne", Round::AT_MOST),
                NamedRule::new("it does not turn", Round::STRAIGHT),
                NamedRule::new("ten steps", Round::TEN_STEPS),
            ],
        )],
    },
    Clause {
        id: "FRONTIER-13",
        sentence: "A robot MUST never enter as its frontier cell one that a robot has entered before.",
        checks: &[
            &Check::refuted(PUBLISHED, &Areas { sizes: &TWO, ..smallest::<2>(Demand::Once) })
                .under(&ONCE)
                .of(&PAPER),
            &Check::holds(PLAIN, &turned_back(two(Demand::Once)), &[plain(Return), plain(Look)]),
            &Check::holds(PLAIN, &turned_back(three(Demand::Once)), &[plain(Return), plain(Look)]),
            &Check::holds(PLAIN, &lossy(turned_back(two(Demand::Once))), &[plain(Return)]),
            &Check::holds(
                REPAIRED,
                &turned_back(two_repaired(Demand::Once)),
                &[repaired(Return), repaired(Look)],
            ),
            &Check::holds(REPAIRED, &turned_back(three(Demand::Once)), &[repaired(Return), repaired(Look)]),
            &Check::holds(REPAIRED, &lossy(turned_back(two_repaired(Demand::Once))), &[repaired(Return)]),
            &Check::holds(REPAIRED, &lossy(turned_back(three(Demand::Once))), &[repaired(Return)]),
            &Check::holds(PLAIN_DEATH, &deadly(two(Demand::Once)), &[plain(Look)]),
            &Check::holds(REPAIRED_DEATH, &deadly(two_repaired(Demand::Once)), &[repaired(Look)]),
            &Check::holds(REPAIRED_DEATH, &deadly(three(Demand::Once)), &[repaired(Look)]),
            &Check::holds(REPAIRED_DEATH, &lossy(deadly(two(Demand::Once))), &[repaired(Look)]),
        ],
    },
];
