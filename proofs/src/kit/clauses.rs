//! The clauses of KIT, in the order of `SPEC.md`.

use tautline_kernel::kit::Condition::{
    Apart, Beside, Caravan, Flags, FromInReach, MakesRoom, Marked, NextInReach, Regroup, Repeats, Stays, Turn,
};
use tautline_kernel::kit::Fallback::{self, Admitted, Nearest, Random};
use tautline_kernel::kit::Records::{self, Others, Union};
use tautline_kernel::kit::Runs::{self, Ahead, Every};
use tautline_kernel::kit::{Answers as Answering, Filter, Rule};

use super::lattices::{Lattices, Pass, Size};
use super::local::{self, AtEqualSpeeds, Two};
use super::pairs::{self, Certainty};
use super::talks::{self, Hearing, Talks};
use super::world::{Answers, Demand, Speeds, Starts};
use crate::ambiguity::Charity::{Charitable, Literal, Probable};
use crate::ambiguity::{Ambiguity, Interpretation, Paper};
use crate::clause::{Check, Clause, NamedRule, Reading, holding};
use crate::decide::EveryState;
use crate::local::EveryNumber;
use crate::plural::counted;
use crate::step_checks;

const PUBLISHED: NamedRule<Rule> = NamedRule::new("published", Rule::PUBLISHED);
const REPAIRED: NamedRule<Rule> = NamedRule::new("repaired", Rule::REPAIRED);
const ROBUST: NamedRule<Rule> = NamedRule::new("robust", Rule::ROBUST);

const NO_NEXT: NamedRule<Rule> =
    NamedRule::new("where the other goes does not count", Rule::REPAIRED.without(NextInReach));
const NO_FROM: NamedRule<Rule> =
    NamedRule::new("where the other was does not count", Rule::REPAIRED.without(FromInReach));
const NOT_APART: NamedRule<Rule> =
    NamedRule::new("to where the other is or goes", Rule::REPAIRED.without(Apart));
const NO_STAY: NamedRule<Rule> = NamedRule::new("never stays", Rule::REPAIRED.without(Stays));
const NO_TURN: NamedRule<Rule> = NamedRule::new("no turns", Rule::REPAIRED.without(Turn));
const NO_REGROUP: NamedRule<Rule> = NamedRule::new("no joint way", Rule::REPAIRED.without(Regroup));
const UNMARKED: NamedRule<Rule> =
    NamedRule::new("blocked sides are not marked", Rule::REPAIRED.without(Marked));
const OLD_PATHS: NamedRule<Rule> =
    NamedRule::new("old paths alone are filtered", Rule { filter: Filter::OldPaths, ..Rule::REPAIRED });
const OTHERS: NamedRule<Rule> =
    NamedRule::new("the other's record alone counts", Rule { records: Others, ..Rule::REPAIRED });
const NO_LOOK_BESIDE: NamedRule<Rule> =
    NamedRule::new("neighbours are not looked at", Rule::REPAIRED.without(Beside));
const NO_CARAVAN: NamedRule<Rule> = NamedRule::new("each goes alone", Rule::REPAIRED.without(Caravan));
const NO_ROOM: NamedRule<Rule> = NamedRule::new("nobody makes room", Rule::REPAIRED.without(MakesRoom));

/// The published rule by a reading of where KIT runs, whose record counts, and which side is taken where none is left.
const fn reading(runs: Runs, records: Records, fallback: Fallback) -> Rule {
    Rule { runs, records, fallback, ..Rule::PUBLISHED }
}

/// The readings of the published rule but for the main one.
const READINGS: [(&str, Rule); 11] = [
    ("ahead", reading(Ahead, Union, Nearest)),
    ("the other's record", reading(Every, Others, Nearest)),
    ("ahead + the other's record", reading(Ahead, Others, Nearest)),
    ("any side", reading(Every, Union, Random)),
    ("ahead + any side", reading(Ahead, Union, Random)),
    ("the other's record + any side", reading(Every, Others, Random)),
    ("ahead + the other's record + any side", reading(Ahead, Others, Random)),
    ("filtered", reading(Every, Union, Admitted)),
    ("ahead + filtered", reading(Ahead, Union, Admitted)),
    ("the other's record + filtered", reading(Every, Others, Admitted)),
    ("ahead + the other's record + filtered", reading(Ahead, Others, Admitted)),
];

/// When a robot answers, otherwise than the main reading has it.
const ANSWERING: [(&str, Rule); 2] = [
    ("answers always", Rule { answers: Answering::Always, ..Rule::PUBLISHED }),
    ("the first goes first", Rule { answers: Answering::FirstGoesFirst, ..Rule::PUBLISHED }),
];

/// A robot that stands answers, too.
const ANSWERS_STANDING: NamedRule<Rule> = NamedRule::new("answered", ANSWERING[0].1);
const SILENT: NamedRule<Rule> = NamedRule::new("a robot that stands is silent", Rule::PUBLISHED);

const REFUTED: &[Reading<Rule>] = &holding(READINGS, []);

/// The readings of sentences that hold in a larger bound where KIT runs at every node and a robot stays rather than go
/// out of reach: but for that of these in which the other's record alone counts, whose states are too many.
const STAYING: &[Reading<Rule>] = {
    let [a, b, c, d, e, f, g, stays, ahead, _, other] = READINGS;
    &holding([a, b, c, d, e, f, g, stays, ahead, other], [7])
};

/// The contact of two robots that follow this rule.
const fn in_contact(named: NamedRule<Rule>) -> NamedRule<Two> {
    NamedRule::new(named.name, Two::in_contact(named.rule))
}

/// The ambiguities that these readings are about. Under *every* two robots have the paper's 78 % and keep its contact
/// more often, so that it is the more charitable one, though *ahead* is closer to the words.
static PAPER: Paper = Paper {
    ambiguities: &[
        Ambiguity {
            words: "“If there is no any obstacle within the range of 3.5m distances, robot moves forward”",
            interpretations: &[
                Interpretation::new("every", "KIT chooses the direction at every node", Charitable),
                Interpretation::new("ahead", "KIT chooses where the way ahead is blocked", Literal),
            ],
        },
        Ambiguity {
            words: "“nodes in the directions that Robot-B has not turned”",
            interpretations: &[
                Interpretation::new("both records", "what either robot has explored counts", Probable),
                Interpretation::new("the other's record", "what the other has explored counts", Literal),
            ],
        },
        Ambiguity {
            words: "“the robot does the processing again for all the directions regardless of whether direction is \
                    open or not. Then it will get the direction that has smallest communication distance”",
            interpretations: &[
                Interpretation::new(
                    "nearest side",
                    "of all sides the one that leads nearest to the other",
                    Probable,
                ),
                Interpretation::new("any side", "any of all sides", Literal),
                Interpretation::new(
                    "filtered",
                    "all sides are filtered again, and the nearest of what is left is taken, if any is",
                    Charitable,
                ),
            ],
        },
    ],
    excluded: &[],
    repairs: &["repaired", "robust"],
};

/// The ambiguity about who answers.
static PAPER_ON_ANSWERS: Paper = Paper {
    ambiguities: &[Ambiguity {
        words: "“send the respond … when it is moving one node to another. It does not send when it is turning”",
        interpretations: &[
            Interpretation::new("stands silent", "a robot that stands does not answer", Literal),
            Interpretation::new(
                "answers always",
                "one that stands and has not begun to turn answers",
                Charitable,
            ),
            Interpretation::new(
                "the first goes first",
                "of two that ask the first robot goes first",
                Probable,
            ),
        ],
    }],
    excluded: &[],
    repairs: &["repaired", "robust"],
};

step_checks! { Certainty;
    contact: pairs::contact, NamedRule::new("repaired", Certainty::OURS), pairs::pairs,
        covers ["both drive", "both stand", "one drives"], unwind 9, mutants {
            ends: "where both go alone counts" => Certainty::ENDS,
            next: "where a robot was does not count" => Certainty::NEXT_OF_ONE,
        };
    apart: pairs::apart, NamedRule::new("repaired", Certainty::OURS), pairs::pairs,
        covers ["both drive", "both stand", "one drives"], unwind 9, mutants {
            ends: "where both go alone counts" => Certainty::ENDS,
            next: "where a robot was does not count" => Certainty::NEXT_OF_ONE,
        };
}

step_checks! { Rule;
    read_back: pairs::read_back, REPAIRED, pairs::messages,
        covers ["a request", "a response", "an acknowledgement"], unwind 9, mutants {
            published: "three flags" => Rule::REPAIRED.without(Flags),
        };
}

/// The lattices on which the published rule is looked at.
const LINES: [Size; 4] = [(2, 1, 1), (3, 1, 2), (4, 1, 3), (5, 1, 4)];
/// Two rows, few walls.
const ROWS: [Size; 2] = [(5, 1, 4), (5, 2, 2)];
/// The lattices on which the repaired rule is looked at.
const SMALL: [Size; 6] = [(2, 1, 1), (3, 1, 2), (2, 2, 4), (4, 1, 3), (5, 1, 4), (3, 2, 7)];
/// Those for three robots.
const THREE: [Size; 4] = [(2, 2, 4), (4, 1, 3), (5, 1, 4), (6, 1, 1)];

/// Those for three robots that start side by side.
const BESIDE: [Size; 4] = [(2, 2, 4), (4, 1, 3), (5, 1, 4), (3, 2, 7)];

/// The situations that a run of the published rule must have before it goes wrong.
const ANY: [&str; 0] = [];
/// Those that occur in runs of the published rule, by which no robot is ever done.
const MOVES: [&str; 4] = ["a new path", "a stay", "an arrival", "an old path"];
/// The situations that occur in the runs of the repaired rule.
const ALL: [&str; 5] = ["a new path", "a stay", "an arrival", "an old path", "done"];

const fn published(demand: Demand) -> Lattices<2> {
    let (speeds, answers, starts) = (Speeds::Any, Answers::AnyTime, Starts::Anywhere);
    Lattices { sizes: &LINES, speeds, answers, starts, demand, pass: Pass::Alone, covers: &ANY }
}

const fn repaired(demand: Demand) -> Lattices<2> {
    Lattices { sizes: &SMALL, pass: Pass::Together, covers: &ALL, ..published(demand) }
}

const fn three(demand: Demand) -> Lattices<3> {
    let (speeds, answers, starts) = (Speeds::Any, Answers::AnyTime, Starts::Anywhere);
    Lattices { sizes: &THREE, speeds, answers, starts, demand, pass: Pass::Alone, covers: &ALL }
}

const fn side_by_side(demand: Demand) -> Lattices<3> {
    let (sizes, starts, pass) = (&BESIDE, Starts::SideBySide, Pass::Together);
    Lattices { sizes, starts, pass, ..three(demand) }
}

/// Robots that are answered where the other one stands, too, and what they are told is true.
const ANSWERED_TRULY: Lattices<2> =
    Lattices { sizes: &SMALL, answers: Answers::TrueNews, covers: &MOVES, ..published(Demand::Moves) };

const AT_EQUAL_SPEEDS: Lattices<2> =
    Lattices { sizes: &ROWS, speeds: Speeds::Equal, ..published(Demand::Contact) };
/// Contact is judged where both robots stand.
const AT_NODES: Lattices<2> = Lattices { demand: Demand::AtNodes, ..AT_EQUAL_SPEEDS };
const APART_AT_EQUAL_SPEEDS: Lattices<2> =
    Lattices { sizes: &SMALL, speeds: Speeds::Equal, ..published(Demand::Apart) };

const fn repaired_at_equal_speeds(demand: Demand) -> Lattices<2> {
    Lattices { speeds: Speeds::Equal, pass: Pass::Alone, ..repaired(demand) }
}

/// Two robots that talk, none of whose messages is lost or comes twice.
const fn talks(rule: &Rule, demand: talks::Demand) -> Talks {
    Talks { rule: *rule, forgets: false, demand, max_lost: 0, max_doubled: 0 }
}

/// Two such robots, each of which must know where the other one goes or stands when it decides.
const fn knowing(hearing: &Hearing) -> Talks {
    Talks { forgets: hearing.forgets, ..talks(&hearing.rule, talks::Demand::Fresh) }
}

/// Robots that keep what they are told.
const fn keeping(name: &'static str, rule: Rule) -> NamedRule<Hearing> {
    NamedRule::new(name, Hearing { rule, forgets: false })
}

/// Robots that do not.
const fn forgetting(rule: Rule) -> NamedRule<Hearing> {
    NamedRule::new("what is told is forgotten", Hearing { rule, forgets: true })
}

const fn every_talk<R>(range: fn() -> String, system: fn(&R) -> Talks) -> EveryState<R, Talks> {
    EveryState {
        range,
        system,
        starts: |talks| vec![talks.start()],
        most_steps: 40_000_000,
        covers: &["a drive", "a message", "a stay", "an arrival"],
        tell: |_, step| talks::tell(&step.state),
    }
}

/// The situations of talks of published robots, which do not stay.
const NO_STAYS: &[&str] = &["a drive", "a message", "an arrival"];

const ANSWERED_AS_PUBLISHED: EveryState<Rule, Talks> = EveryState { covers: NO_STAYS, ..ANSWERED };
const FRESH_AS_PUBLISHED: EveryState<Hearing, Talks> = EveryState { covers: NO_STAYS, ..FRESH };
const ANSWERED: EveryState<Rule, Talks> =
    every_talk(|| words(0, 0), |rule| talks(rule, talks::Demand::Answered));
const ANSWERED_THOUGH_LOST: EveryState<Rule, Talks> =
    every_talk(|| words(1, 0), |rule| Talks { max_lost: 1, ..talks(rule, talks::Demand::Answered) });
const FRESH: EveryState<Hearing, Talks> = every_talk(|| words(0, 0), knowing);
const FRESH_THOUGH_LOST: EveryState<Hearing, Talks> =
    every_talk(|| words(1, 0), |hearing| Talks { max_lost: 1, ..knowing(hearing) });
const FRESH_THOUGH_DOUBLED: EveryState<Hearing, Talks> =
    every_talk(|| words(0, 1), |hearing| Talks { max_doubled: 1, ..knowing(hearing) });

/// The bound when so many messages are lost, and so many come twice, in words.
fn words(lost: u8, doubled: u8) -> String {
    let [lost, doubled] = [lost, doubled].map(|count| counted(count, "message"));
    format!("2 robots, every order of messages, {lost} lost, {doubled} twice")
}

/// The clauses.
pub const CLAUSES: [Clause; 14] = [
    Clause {
        id: "KIT-1",
        sentence: "Two robots MUST hear each other all the time, at whatever speeds they drive.",
        checks: &[
            &contact::CHECK,
            &Check::refuted(PUBLISHED, &published(Demand::Contact)).under(REFUTED).of(&PAPER),
            &Check::refuted(NamedRule::new("ahead", Rule::AHEAD), &published(Demand::Contact))
                .because("another reading of the paper"),
            &Check::holds(REPAIRED, &repaired(Demand::Contact), &[NO_NEXT, NO_FROM, NO_STAY, OLD_PATHS]),
            &Check::holds(in_contact(REPAIRED), &local::TWO, &[in_contact(NO_NEXT), in_contact(NO_FROM)]),
            &Check::refuted(PUBLISHED, &AT_NODES).under(STAYING).of(&PAPER),
            &Check::holds(
                NamedRule::new("at-nodes", Two::at_nodes(Rule::PUBLISHED)),
                &local::AT_NODES,
                &[NamedRule::new(NO_NEXT.name, Two::at_nodes(Rule::PUBLISHED.without(NextInReach)))],
            ),
        ],
    },
    Clause {
        id: "KIT-2",
        sentence: "Two robots that drive at equal speeds MUST hear each other all the time.",
        checks: &[
            &Check::refuted(PUBLISHED, &AT_EQUAL_SPEEDS).under(STAYING).of(&PAPER),
            &Check::holds(
                NamedRule::new("filtered", AtEqualSpeeds(Rule::PUBLISHED)),
                &local::TOLD,
                &[NamedRule::new(NO_NEXT.name, AtEqualSpeeds(Rule::PUBLISHED.without(NextInReach)))],
            ),
            &Check::holds(
                REPAIRED,
                &repaired_at_equal_speeds(Demand::Contact),
                &[NO_NEXT, NO_STAY, OLD_PATHS],
            ),
            &Check::holds(in_contact(REPAIRED), &local::TWO, &[in_contact(NO_NEXT)]),
        ],
    },
    Clause {
        id: "KIT-3",
        sentence: "Two robots MUST never be nearer to each other than 3 m, once both have left their starts.",
        checks: &[
            &apart::CHECK,
            &Check::refuted(PUBLISHED, &published(Demand::Apart)).under(REFUTED).of(&PAPER),
            &Check::refuted(PUBLISHED, &APART_AT_EQUAL_SPEEDS).under(REFUTED).of(&PAPER),
            &Check::holds(REPAIRED, &repaired(Demand::Apart), &[NOT_APART, NO_STAY]),
            &Check::holds(REPAIRED, &repaired_at_equal_speeds(Demand::Apart), &[NOT_APART, NO_STAY]),
            &Check::holds(
                NamedRule::new("repaired", Two::apart(Rule::REPAIRED)),
                &EveryNumber::DEFAULT,
                &[NamedRule::new(NOT_APART.name, Two::apart(NOT_APART.rule))],
            ),
        ],
    },
    Clause {
        id: "KIT-4",
        sentence: "A robot that waits for an answer MUST be answered in the end.",
        checks: &[
            &Check::refuted(PUBLISHED, &ANSWERED_AS_PUBLISHED)
                .judged(|rule, choices| talks::case(&talks(rule, talks::Demand::Answered), choices))
                .under(&holding(ANSWERING, [0, 1]))
                .of(&PAPER_ON_ANSWERS),
            &Check::holds(REPAIRED, &ANSWERED, &[NO_TURN]),
            &Check::refuted(REPAIRED, &ANSWERED_THOUGH_LOST)
                .because("a message is lost; the rule robust asks again")
                .judged(|rule, choices| {
                    talks::case(&Talks { max_lost: 1, ..talks(rule, talks::Demand::Answered) }, choices)
                }),
            &Check::holds(
                ROBUST,
                &ANSWERED_THOUGH_LOST,
                &[NamedRule::new("no repeats", Rule::ROBUST.without(Repeats))],
            ),
        ],
    },
    Clause {
        id: "KIT-5",
        sentence: "A robot that decides MUST know where the other one goes or stands.",
        checks: &[
            &Check::holds(
                keeping(PUBLISHED.name, PUBLISHED.rule),
                &FRESH_AS_PUBLISHED,
                &[
                    keeping(ANSWERING[0].0, ANSWERING[0].1),
                    keeping(ANSWERING[1].0, ANSWERING[1].1),
                    forgetting(Rule::PUBLISHED),
                ],
            ),
            &Check::holds(
                keeping(REPAIRED.name, REPAIRED.rule),
                &FRESH,
                &[
                    keeping("answers always", Rule { answers: Answering::Always, ..Rule::REPAIRED }),
                    forgetting(Rule::REPAIRED),
                ],
            ),
            &Check::refuted(keeping(REPAIRED.name, REPAIRED.rule), &FRESH_THOUGH_DOUBLED)
                .because("a message comes twice; the rule robust knows it")
                .judged(|hearing, choices| {
                    talks::case(&Talks { max_doubled: 1, ..knowing(hearing) }, choices)
                }),
            &Check::holds(
                keeping(ROBUST.name, ROBUST.rule),
                &FRESH_THOUGH_LOST,
                &[
                    keeping("answers always", Rule { answers: Answering::Always, ..Rule::ROBUST }),
                    forgetting(Rule::ROBUST),
                ],
            ),
        ],
    },
    Clause {
        id: "KIT-6",
        sentence: "While an uncovered side is within reach, a robot MUST drive or be able to decide.",
        checks: &[
            &Check::refuted(PUBLISHED, &published(Demand::Moves)).under(REFUTED).of(&PAPER),
            &Check::holds(REPAIRED, &repaired(Demand::Moves), &[NO_TURN, NO_REGROUP]),
            &Check::holds(ANSWERS_STANDING, &ANSWERED_TRULY, &[SILENT]),
        ],
    },
    Clause {
        id: "KIT-7",
        sentence: "Every run MUST end.",
        checks: &[
            &Check::refuted(PUBLISHED, &published(Demand::Ends)).under(REFUTED).of(&PAPER),
            &Check::holds(REPAIRED, &repaired(Demand::Ends), &[NO_STAY]),
            &Check::holds(REPAIRED, &side_by_side(Demand::Ends), &[NO_STAY]),
        ],
    },
    Clause {
        id: "KIT-8",
        sentence: "When a run ends, every side within reach MUST be driven or \
                   seen blocked, and every robot MUST know it.",
        checks: &[
            &Check::refuted(PUBLISHED, &published(Demand::Covers)).under(REFUTED).of(&PAPER),
            &Check::holds(REPAIRED, &repaired(Demand::Covers), &[NO_REGROUP, UNMARKED]),
            &Check::refuted(REPAIRED, &three(Demand::Covers))
                .because("three robots that start anywhere; side by side it holds"),
        ],
    },
    Clause {
        id: "KIT-9",
        sentence: "Every message MUST be read as it was sent, and fields that are no message MUST be refused.",
        checks: &[&Check::refuted(PUBLISHED, read_back::CHECK.method).judged(pairs::wire), &read_back::CHECK],
    },
    Clause {
        id: "KIT-10",
        sentence: "A side MUST count as covered for every robot if any of them has driven through \
                   it or seen it blocked, and no other side.",
        checks: &[
            &Check::refuted(PUBLISHED, &published(Demand::Marks)).under(REFUTED).of(&PAPER),
            &Check::holds(REPAIRED, &repaired(Demand::Marks), &[UNMARKED, OTHERS]),
        ],
    },
    Clause {
        id: "KIT-11",
        sentence: "A robot that drives a path again MUST shorten the joint way to an uncovered side, or its \
                   own while another one drives a new path.",
        checks: &[
            &Check::refuted(PUBLISHED, &published(Demand::Shortens)).under(REFUTED).of(&PAPER),
            &Check::holds(REPAIRED, &repaired(Demand::Shortens), &[NO_STAY]),
        ],
    },
    Clause {
        id: "KIT-12",
        sentence: "Robots that hear each other directly or over others when they start MUST do so all the time.",
        checks: &[&Check::holds(REPAIRED, &three(Demand::Contact), &[NO_NEXT, NO_FROM, OLD_PATHS])],
    },
    Clause {
        id: "KIT-13",
        sentence: "Three robots and more that start side by side MUST drive, or see blocked, every side of every node \
                   that paths join to their starts, unless they fill all of these nodes; and every robot MUST know it.",
        checks: &[&Check::holds(
            REPAIRED,
            &side_by_side(Demand::Whole),
            &[NO_LOOK_BESIDE, NO_CARAVAN, NO_ROOM],
        )],
    },
    Clause {
        id: "KIT-14",
        sentence: "Of two robots one that drives a path again MUST be able to take each side \
                   that begins a shortest way, and no other.",
        checks: &[
            &Check::refuted(PUBLISHED, &published(Demand::AnyShortest)).under(REFUTED).of(&PAPER),
            &Check::holds(REPAIRED, &repaired(Demand::AnyShortest), &[NO_STAY, NO_NEXT]),
        ],
    },
];
