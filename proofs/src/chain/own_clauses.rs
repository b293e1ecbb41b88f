//! The clauses of what is ours in the chain: certified plans, the reel, contact in any order, and faults. They
//! follow those of [`super::clauses`] in the order of `SPEC.md`.

use tautline_kernel::chain::Condition::{CoveredBehind, Hold, NoExchange, SafeAhead};
use tautline_kernel::chain::{Habit, Pursuit, Rule, Walls};

use super::appearing_walls::{self, WallsCase};
use super::barrier::{self, Reading};
use super::clauses::{
    APART, AREAS, FICKLE, FIVE_TWO_WALLS, NOT_HELD, PUBLISHED, REEL, REPAIRED, UNHELD, UNREHEARSED, apart,
    fewer_walls, in_contact, lacking, narrowed, unheld,
};
use super::death::{self, Aftermath, DeathCase};
use super::every_area::EveryArea;
use super::invariant::Invariant;
use super::local::{self, Contact};
use super::search::EveryLayout;
use super::subject::Subject;
use super::{pair, whole_runs};
use crate::clause::{Check, Clause, NamedRule};
use crate::decide::{EveryAnswer, RandomAnswers};
use crate::ground::clauses::NARROWER;
use crate::local::EveryNumber;
use crate::step_checks;

step_checks! { Subject;
    hold: pair::hold, REEL, pair::goers,
        covers ["both have gone", "neither has gone", "the robot ahead has gone", "the robot behind has gone"],
        unwind 6, mutants {
            without_hold: "without hold" => Subject::REEL.without(Hold),
            without_safe_ahead: "without E_S ahead" => Subject::REEL.without(SafeAhead),
            without_covered_behind: "without E_C behind" => Subject::REEL.without(CoveredBehind),
        };
}

/// The bounds of the clause that is looked at by a slow procedure.
const FOUR_TWO_WALLS: (usize, u32) = (4, 2);
const THREE_FOUR_WALLS: (usize, u32) = (3, 4);
const THREE_FIVE_WALLS: (usize, u32) = (3, 5);
const THREE_ONE_WALL: (usize, u32) = (3, 1);

/// The reason why CHAIN-24 is broken.
const NO_ARGUMENT: &str = "N² is no result of an argument";

const NO_NEARER: NamedRule<Subject> = NamedRule::new(
    "an approach gets no nearer",
    Subject::REEL.without_habits(&[Habit::Rehearses, Habit::ComesNearer]),
);
const TAKES_BACK_ONE: NamedRule<Subject> =
    NamedRule::new("take-backs always of one", Subject::REEL.without_habits(&[Habit::Doubles]));

/// Followers kept nearer than the planners reckon with, in unrehearsed tasks.
const NARROWED_UNREHEARSED: NamedRule<Subject> =
    NamedRule::new("tasks are not rehearsed, E_S narrowed to E_N", UNREHEARSED.rule.with_safe(NARROWER));

/// A reel that pursues as the repaired rule does.
const IN_EPOCHS: NamedRule<Subject> = NamedRule::new(
    "epochs and backtracks",
    Subject::REEL.following(Rule { pursuit: Pursuit::Epochs, ..Rule::REEL }),
);

/// The contact of a reel of any number of robots, and what breaks it.
const CONTACT: NamedRule<Contact<true>> = in_contact(REEL);
const LOST_CONTACT: [NamedRule<Contact<true>>; 3] = [
    in_contact(NOT_HELD),
    in_contact(lacking(Subject::REEL, SafeAhead)),
    in_contact(lacking(Subject::REEL, CoveredBehind)),
];

const BARRIER: Check<Reading> = Check::holds(
    NamedRule::new("reel", Reading::True),
    &EveryAnswer::new(
        barrier::barrier,
        barrier::losses,
        &[
            "a byte is lost",
            "a byte of the team move before",
            "a byte of the team move after",
            "a byte that was missing",
        ],
    ),
    &[
        NamedRule::new("team moves are not told apart", Reading::Present),
        NamedRule::new("one bit counts team moves", Reading::OneBit),
        NamedRule::new("nobody says a byte again", Reading::Mute),
        NamedRule::new("answers are answered", Reading::NoAnswers),
    ],
);

/// A chain that re-forms when a robot dies.
const fn dying(observed: Subject, then: Aftermath) -> DeathCase {
    DeathCase { observed, then }
}

const DEATHS: [&str; 3] = [
    "the chain comes home before it goes on",
    "the chain goes on after some moves taken back",
    "the chain goes on at once",
];

const DEATH: Check<DeathCase> = Check::holds(
    NamedRule::new("reel", dying(Subject::REEL, Aftermath::Reform)),
    &EveryAnswer::new(death::in_few_walls, death::few_walls, &DEATHS),
    &[
        NamedRule::new("the robots ahead wait", dying(Subject::REEL, Aftermath::Wait)),
        NamedRule::new("two team moves are taken back at once", dying(Subject::REEL, Aftermath::Skip)),
        NamedRule::new("the chain never comes home", dying(Subject::REEL, Aftermath::StayOut)),
        NamedRule::new("team moves are taken back that nobody made", dying(Subject::REEL, Aftermath::Beyond)),
    ],
);

const MEETING: Check<DeathCase> = Check::holds(
    DEATH.about,
    &EveryAnswer::new(
        death::whatever_the_log,
        death::meetings,
        &["one chain", "one chain, the part ahead home", "three robots in one cell", "two parts"],
    ),
    &[
        NamedRule::new("three robots go on in one cell", dying(Subject::REEL, Aftermath::Crowd)),
        NamedRule::new(
            "a refused log names robots as they count without the dead one",
            dying(Subject::REEL, Aftermath::Renumber),
        ),
    ],
);

const DEATH_AT_RANDOM: Check<DeathCase> = Check::unrefuted(
    DEATH.about,
    &RandomAnswers::new(death::at_random, 200, death::random_layouts, &DEATHS),
    &[
        NamedRule::new("without hold", dying(Subject::UNHELD, Aftermath::Reform)),
        NamedRule::new("without E_S ahead", dying(Subject::REEL.without(SafeAhead), Aftermath::Reform)),
    ],
);

/// A chain in a world in which walls appear.
const fn shut(observed: Subject, walls: Walls) -> WallsCase {
    WallsCase { observed, walls, plans_among: walls }
}

const UNTRIED: NamedRule<WallsCase> =
    NamedRule::new("crossed sides are not tried", shut(Subject::REEL, Walls::Lasting));

const SHUT: Check<WallsCase> = Check::holds(
    NamedRule::new("reel", shut(Subject::REEL, Walls::Changing)),
    &EveryAnswer::new(
        appearing_walls::in_few_walls,
        appearing_walls::few_walls,
        &["a wall appears", "no wall appears"],
    ),
    &[
        UNTRIED,
        NamedRule::new(
            "the history below a wall is kept",
            WallsCase { plans_among: Walls::Lasting, ..shut(Subject::REEL, Walls::Changing) },
        ),
    ],
);

const SHUT_AT_RANDOM: Check<WallsCase> = Check::unrefuted(
    SHUT.about,
    &RandomAnswers::new(
        appearing_walls::at_random,
        200,
        appearing_walls::random_layouts,
        &["a wall appears"],
    ),
    &[UNTRIED],
);

/// The clauses.
pub const CLAUSES: [Clause; 10] = [
    Clause {
        id: "CHAIN-16",
        sentence: "A planner MUST make no plan that the admission relation refuses.",
        checks: &[
            &Check::holds(
                PUBLISHED,
                &fewer_walls(Invariant::Certified),
                &[lacking(Subject::PUBLISHED, SafeAhead), lacking(Subject::PUBLISHED, CoveredBehind)],
            ),
            &Check::holds(REPAIRED, &fewer_walls(Invariant::Certified), &[narrowed(Subject::REPAIRED)]),
            &Check::holds(
                UNHELD,
                &fewer_walls(Invariant::Certified),
                &[unheld(NARROWED_UNREHEARSED), lacking(Subject::UNHELD, SafeAhead)],
            ),
            &Check::holds(
                REEL,
                &fewer_walls(Invariant::Certified),
                &[NARROWED_UNREHEARSED, lacking(Subject::REEL, SafeAhead)],
            ),
            &Check::holds(
                APART,
                &fewer_walls(Invariant::Certified),
                &[lacking(Subject::APART, SafeAhead), lacking(Subject::APART, NoExchange)],
            ),
        ],
    },
    Clause {
        id: "CHAIN-17",
        sentence: "Each team move of the reel MUST gain, or bring its measure down; so every run ends.",
        checks: &[
            &Check::holds(
                UNHELD,
                &fewer_walls(Invariant::Falls),
                &[unheld(UNREHEARSED), unheld(FICKLE), unheld(NO_NEARER), unheld(TAKES_BACK_ONE)],
            ),
            &Check::holds(
                REEL,
                &fewer_walls(Invariant::Falls),
                &[UNREHEARSED, FICKLE, NO_NEARER, TAKES_BACK_ONE],
            ),
            &Check::holds(REEL, &fewer_walls(Invariant::Ends), &[UNREHEARSED, FICKLE, NO_NEARER]),
            &Check::holds(APART, &fewer_walls(Invariant::Falls), &[apart(UNREHEARSED), apart(FICKLE)]),
        ],
    },
    Clause {
        id: "CHAIN-18",
        sentence: "A rehearsal of the reel that meets no surprise MUST explore a cell in exactly its number of team \
                   moves.",
        checks: &[
            &Check::holds(UNHELD, &fewer_walls(Invariant::Arrives), &[unheld(UNREHEARSED)]),
            &Check::holds(REEL, &fewer_walls(Invariant::Arrives), &[UNREHEARSED]),
        ],
    },
    Clause {
        id: "CHAIN-19",
        sentence: "Whichever robots go, and in whatever order, each robot MUST be in E_C of its neighbours in the \
                   chain before, between and after their moves.",
        checks: &[
            &Check::refuted(REPAIRED, &EveryArea(Invariant::AnyOrder, AREAS, AREAS))
                .because("all robots go at once; the reel keeps contact in any order"),
            &hold::CHECK,
            // Without hold four robots keep contact in any order among so few walls.
            &Check::holds(REEL, &fewer_walls(Invariant::AnyOrder), &[lacking(Subject::REEL, SafeAhead)]),
            &Check::holds(APART, &fewer_walls(Invariant::AnyOrder), &[lacking(Subject::APART, SafeAhead)]),
            &Check::holds(REEL, &EveryLayout(Invariant::AnyOrder, FIVE_TWO_WALLS), &[NOT_HELD]),
            &Check::unrefuted(
                REEL,
                &RandomAnswers::new(whole_runs::any_order, 200, whole_runs::orders, &["a whole run"]),
                &[NOT_HELD],
            ),
            &Check::holds(CONTACT, &EveryNumber::DEFAULT, &LOST_CONTACT),
        ],
    },
    Clause {
        id: "CHAIN-20",
        sentence: "Whichever bytes are lost, repeated or late, robots at the barrier MUST go on with the same \
                   messages of all, and go on once no byte is lost.",
        checks: &[&BARRIER],
    },
    Clause {
        id: "CHAIN-21",
        sentence: "When a robot dies, the parts of the reel behind and ahead of it MUST keep contact \
                   within themselves, come into contact with each other, and explore all that is \
                   within reach of a chain of one robot fewer.",
        checks: &[&DEATH, &MEETING, &DEATH_AT_RANDOM],
    },
    Clause {
        id: "CHAIN-22",
        sentence: "When walls appear where robots have crossed, the reel MUST keep to CHAIN-1 and CHAIN-2, take no \
                   robot to be through a wall, and end its run.",
        checks: &[&SHUT, &SHUT_AT_RANDOM, &Check::holds(CONTACT, &local::ITS_CONTACT, &LOST_CONTACT)],
    },
    Clause {
        id: "CHAIN-23",
        sentence: "As long as nothing is gained, the reel MUST take back one team move, then two, then four, each \
                   time twice as many, as far as there are.",
        checks: &[
            &Check::holds(UNHELD, &fewer_walls(Invariant::Doubles), &[unheld(TAKES_BACK_ONE)]),
            &Check::holds(REEL, &fewer_walls(Invariant::Doubles), &[TAKES_BACK_ONE]),
            &Check::holds(APART, &fewer_walls(Invariant::Doubles), &[apart(TAKES_BACK_ONE)]),
        ],
    },
    Clause {
        id: "CHAIN-24",
        sentence: "A reel of N robots MUST be done after at most 9(N−1)−1 team moves, \
                   and N² more for each wall that it meets.",
        checks: &[
            &Check::holds(UNHELD, &fewer_walls(Invariant::Short), &[unheld(IN_EPOCHS), unheld(UNREHEARSED)]),
            &Check::holds(REEL, &fewer_walls(Invariant::Short), &[IN_EPOCHS]),
            &Check::holds(REEL, &EveryLayout(Invariant::Short, FIVE_TWO_WALLS), &[IN_EPOCHS]),
            &Check::refuted(REEL, &EveryLayout(Invariant::Short, THREE_FIVE_WALLS)).because(NO_ARGUMENT),
            &Check::refuted(APART, &EveryLayout(Invariant::Short, THREE_ONE_WALL)).because(NO_ARGUMENT),
        ],
    },
    Clause {
        id: "CHAIN-25",
        sentence: "Each team move of the reel MUST be the one that its procedure names first.",
        checks: &[
            &Check::holds(
                REEL,
                &EveryLayout(Invariant::Chosen, FOUR_TWO_WALLS),
                &[UNREHEARSED, FICKLE, IN_EPOCHS],
            ),
            &Check::holds(
                REEL,
                &EveryLayout(Invariant::Chosen, THREE_FOUR_WALLS),
                &[UNREHEARSED, FICKLE, IN_EPOCHS],
            ),
        ],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chain::search::{Bounds, search};
    use crate::engine::tree::unwatched;
    use crate::engine::{SeededOracle, Stop};
    use tautline_kernel::chain::{Chain, Intent};
    use tautline_kernel::choice::Oracle;
    use tautline_kernel::ground::SmallGrid;

    use crate::chain::breach::Breach;

    /// Runs, team moves, and the longest run of both reels.
    fn searched(robots: usize, walls: u32) -> [(u64, u64, u32); 2] {
        [Subject::REEL, Subject::UNHELD].map(|observed| {
            let invariants = Invariant::Falls.companions(&observed.intended).to_vec();
            let bounds = Bounds { invariants, ..Bounds::new(observed, robots, walls) };
            let found = search(&bounds, &mut unwatched).expect("it can be searched");
            assert!(found.complete && found.counterexamples.is_empty(), "{:?}", found.counterexamples);
            (found.runs, found.moves, found.longest)
        })
    }

    /// Whether contact is lost when one robot stops on its way and the others go, in a run in a random layout.
    fn breaks_when_one_stops(observed: Subject, seed: u64) -> bool {
        let mut world = SeededOracle::new(23, seed);
        let mut chain: Chain<SmallGrid, 8> =
            whole_runs::start(&observed, 8, SmallGrid::new).expect("it fits");
        let mut log = Vec::new();
        while let Intent::Go(plan) = chain.plan(&log).expect("its own log") {
            let before = chain.cells().to_vec();
            log.extend_from_slice(chain.settle(&plan, |_| world.pick(100) >= 10).messages());
            for robot in 1..before.len() {
                let mut team = chain.cells().to_vec();
                team[robot] = before[robot];
                if Breach::Contact.is_in(&before, &team) {
                    return true;
                }
            }
        }
        false
    }

    #[test]
    fn the_repaired_rule_breaks_contact_in_each_of_three_ways() {
        let broken = |runs: &dyn Fn(u64) -> bool| (0..100).filter(|&seed| runs(seed)).count();
        let breaks = |observed: Subject| {
            let world = |seed| SeededOracle::new(19, seed);
            let speeds = broken(&|seed| whole_runs::any_order(&observed, &mut world(seed)).is_err());
            let stops = broken(&|seed| breaks_when_one_stops(observed, seed));
            let lost = Err(Stop::Violated("neighbours are in contact when walls have appeared"));
            let walls = broken(&|seed| {
                appearing_walls::at_random(&shut(observed, Walls::Changing), &mut world(seed)) == lost
            });
            [speeds, stops, walls]
        };
        assert!(breaks(Subject::REPAIRED).iter().all(|&runs| runs > 0), "{:?}", breaks(Subject::REPAIRED));
        assert_eq!(breaks(Subject::REEL), [0; 3]);
    }

    #[test]
    fn while_tasks_are_rehearsed_no_promise_needs_the_last_place_on_a_walk() {
        let observed = Subject::REEL.without_habits(&[Habit::LastPlace]);
        let invariants = Invariant::Falls.companions(&observed.intended).to_vec();
        let found = search(&Bounds { invariants, ..Bounds::new(observed, 3, 3) }, &mut unwatched);
        let found = found.expect("it can be searched");
        assert!(found.complete && found.counterexamples.is_empty(), "{:?}", found.counterexamples);
    }

    #[test]
    fn two_walls_break_nothing_of_a_reel_of_three_robots() {
        assert_eq!(searched(3, 2).map(|(runs, ..)| runs), [363, 363]);
    }

    #[test]
    fn no_layout_within_the_wider_bounds_breaks_anything_of_a_reel() {
        assert_eq!(searched(3, 4), [(31_286, 278_645, 52); 2]);
        assert_eq!(searched(4, 3), [(26_389, 346_459, 71); 2]);
        assert_eq!(searched(5, 2), [(3_582, 65_481, 80), (3_574, 64_527, 80)]);
    }
}
