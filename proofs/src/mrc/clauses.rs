//! The clauses of MRC, in the order of `SPEC.md`.

use tautline_kernel::mrc::Condition::{
    AnswersAgain, ChoiceStands, Consent, Epochs, LeastIdentity, NearestCall, NearestRobot, Renewal,
    Repetition, StillAsks, Window,
};
use tautline_kernel::mrc::{Condition, Rule};

use super::Records::{self, ByPacket, ByWfr};
use super::Service::{self, ByAny, ByItself};
use super::Start::{self, AtOnce, Later};
use super::within::Within;
use super::{Demand, Faults, Leases, LossKind, Misreading, RobotReading, Setting, Subject, records};
use crate::ambiguity::Charity::{Charitable, Literal, Probable};
use crate::ambiguity::{Ambiguity, Interpretation, Paper};
use crate::clause::{Check, Clause, NamedRule, Reading, holding};
use crate::decide::{EveryAnswer, Verdict};

const PUBLISHED: NamedRule<Subject> = NamedRule::new("published", Subject::rescuing(Rule::PUBLISHED));
const REPAIRED: NamedRule<Subject> = NamedRule::new("repaired", Subject::rescuing(Rule::REPAIRED));

const RECORDS: Check<Subject> = Check::holds(
    REPAIRED,
    &EveryAnswer { body: records::records, range: records::notices, covers: &["one call", "several calls"] },
    &[NO_EPOCH],
);

const SERVED: Check<Subject> = Check::holds(
    REPAIRED,
    &EveryAnswer {
        body: records::served,
        range: records::answers,
        covers: &["asked in vain", "no SBit", "told of a choice"],
    },
    &[NO_EPOCH],
);

const WAYS_BACK: Check<Subject> = Check::holds(
    REPAIRED,
    &EveryAnswer {
        body: records::ways_back,
        range: records::messages,
        covers: &["a way back", "no way back"],
    },
    &[
        NamedRule::new("all robots are one", Subject::misreading(Misreading::OneRobot)),
        NamedRule::new("all calls are one", Subject::misreading(Misreading::OneCall)),
    ],
);

const REPEATED: Check<Subject> = Check::holds(
    REPAIRED,
    &EveryAnswer {
        body: records::repeated,
        range: records::repeats,
        covers: &["a WFR", "a WFR that is answered", "a robot", "a robot that is answered"],
    },
    &[
        lacking("no repetition", Repetition),
        NamedRule::new("an answer is taken for none", Subject::misreading(Misreading::Answers)),
    ],
);

const FILLED: Check<Subject> = Check::holds(
    REPAIRED,
    &EveryAnswer {
        body: records::filled,
        range: records::fillings,
        covers: &["nobody gives way", "one gives way", "room for all"],
    },
    &[
        NamedRule::new("it gives its way up for a new WFR", Subject::misreading(Misreading::Ends)),
        lacking("whoever is chosen goes", StillAsks),
    ],
);

/// The repaired rule without this.
const fn lacking(name: &'static str, condition: Condition) -> NamedRule<Subject> {
    NamedRule::new(name, Subject::rescuing(Rule::REPAIRED.without(condition)))
}

/// The published rule with these conditions, under which a choice stands.
const fn chosen(conditions: &[Condition]) -> Rule {
    let mut rule = Rule::PUBLISHED.with(ChoiceStands);
    let mut left = conditions;
    while let [condition, rest @ ..] = left {
        rule = rule.with(*condition);
        left = rest;
    }
    rule
}

/// The readings of a WFR's choice: at each MOVE, at the first, or when a window closes; whether a MOVE that comes later
/// is answered; and of a robot's part.
static PAPER: Paper = Paper {
    ambiguities: &[
        Ambiguity {
            words: "“When a WFR node receives multiple MOVE packets … it first selects the mobile robot … with the \
                    smallest MHC value”",
            interpretations: &[
                Interpretation::new(
                    "anew",
                    "each MOVE makes it choose, so that none comes after the choice",
                    Literal,
                ),
                Interpretation::new("first", "the first MOVE decides", Probable),
                Interpretation::new("window", "all that come until a window closes decide", Charitable),
            ],
        },
        Ambiguity {
            words: "“sends the RESB<RSN, MID> packet to all mobile robots that have sent MOVE packets”",
            interpretations: &[
                Interpretation::new("unanswered", "a MOVE after the choice is not answered", Literal),
                Interpretation::new("answered", "a MOVE after the choice is answered with it", Charitable),
            ],
        },
        Ambiguity {
            words: "“represents if the associated WFR node has been served by the mobile robot”; “every mobile robot \
                    will set the SBit as 1”",
            interpretations: &[
                Interpretation::new("told", "each robot that is told of a choice sets it", Charitable),
                Interpretation::new("own", "the robot that is chosen sets it, and no other", Literal),
            ],
        },
        Ambiguity {
            words: "“On receiving a NOTICE packet, a mobile robot should add a new record”",
            interpretations: &[
                Interpretation::new("one record", "each WFR has one, with the least HC heard", Probable),
                Interpretation::new("packet", "each packet makes one, whose SBit is clear", Literal),
            ],
        },
        Ambiguity {
            words: "“When a mobile robot starts to serve, it first chooses from T_REQ the record with the minimum HC”",
            interpretations: &[
                Interpretation::new(
                    "at once",
                    "a free robot asks at the first NOTICE that it hears",
                    Literal,
                ),
                Interpretation::new("later", "it asks when it has collected some", Probable),
            ],
        },
    ],
    excluded: &[("anew", "answered")],
    repairs: &["repaired"],
};

/// The rule by each reading of a robot's part, under the name of the reading of the WFR's: the name alone, and before
/// what is added to it.
macro_rules! by_robots {
    ($alone:expr, $before:literal, $rule:expr) => {
        [
            ($alone, read($rule, ByAny, ByWfr, AtOnce)),
            (concat!($before, "later"), read($rule, ByAny, ByWfr, Later)),
            (concat!($before, "packet"), read($rule, ByAny, ByPacket, AtOnce)),
            (concat!($before, "packet + later"), read($rule, ByAny, ByPacket, Later)),
            (concat!($before, "own"), read($rule, ByItself, ByWfr, AtOnce)),
            (concat!($before, "own + later"), read($rule, ByItself, ByWfr, Later)),
            (concat!($before, "own + packet"), read($rule, ByItself, ByPacket, AtOnce)),
            (concat!($before, "own + packet + later"), read($rule, ByItself, ByPacket, Later)),
        ]
    };
}

const fn read(rule: Rule, served: Service, records: Records, start: Start) -> Subject {
    Subject { reading: RobotReading { served, records, start }, ..Subject::rescuing(rule) }
}

/// The readings of a WFR's choice and of late MOVEs, each by all of a robot's part, *published* first.
const CHOICES: [[(&str, Subject); 8]; 5] = [
    by_robots!(PUBLISHED.name, "", Rule::PUBLISHED),
    by_robots!("first", "first + ", chosen(&[])),
    by_robots!("first + answered", "first + answered + ", chosen(&[AnswersAgain])),
    by_robots!("window", "window + ", chosen(&[Window])),
    by_robots!("window + answered", "window + answered + ", chosen(&[Window, AnswersAgain])),
];

/// All readings but *published*.
const READINGS: [(&str, Subject); 39] = {
    let mut readings = [CHOICES[0][0]; 39];
    let mut number = 0;
    while number < 39 {
        readings[number] = CHOICES[(number + 1) / 8][(number + 1) % 8];
        number += 1;
    }
    readings
};

/// The readings, of which those hold that are so.
macro_rules! holding_where {
    ($is_so:expr) => {{
        const READ: [Reading<Subject>; 39] = {
            let mut readings = holding(READINGS, []);
            let mut number = 0;
            while number < 39 {
                if $is_so(&READINGS[number].1) {
                    readings[number].expected = Verdict::Holds;
                }
                number += 1;
            }
            readings
        };
        &READ
    }};
}

const REFUTED: &[Reading<Subject>] = &holding(READINGS, []);
/// The readings of the WFR's part, robots as published.
const REFUTED_BY_CHOICE: &[Reading<Subject>] =
    &holding([CHOICES[1][0], CHOICES[2][0], CHOICES[3][0], CHOICES[4][0]], []);

const fn stands(observed: &Subject) -> bool {
    observed.rule.has(ChoiceStands)
}

const fn has_packets(observed: &Subject) -> bool {
    matches!(observed.reading.records, ByPacket)
}

/// A robot that comes back to a WFR whose packet it still has may be chosen by it as by another.
const fn is_in_a_window_by_one_record(observed: &Subject) -> bool {
    observed.rule.has(Window) && !has_packets(observed)
}

/// A robot that asks again or late may ask when the WFR has called anew, and is answered for that call.
const fn is_answered_in_a_window(observed: &Subject) -> bool {
    let RobotReading { served, records, start } = observed.reading;
    observed.rule.has(Window)
        && observed.rule.has(AnswersAgain)
        && matches!((served, records, start), (ByAny, ByWfr, AtOnce))
}

/// One that is told that nobody is to come leaves a call whose SBit stays clear.
const fn asks_until_told(observed: &Subject) -> bool {
    !(observed.rule.has(AnswersAgain) && matches!(observed.reading.served, ByItself) && has_packets(observed))
}

const REDECIDE: NamedRule<Subject> = lacking("redecide on a late MOVE", ChoiceStands);
const FIRST_OF_EQUALS: Subject = Subject::rescuing(Rule::REPAIRED.without(LeastIdentity));
const NO_EPOCH: NamedRule<Subject> = lacking("no epoch", Epochs);
const NO_CONSENT: NamedRule<Subject> = lacking("no consent", Consent);
const NO_RENEWAL: NamedRule<Subject> = lacking("no renewal", Renewal);
const NO_LONGER_ASKS: NamedRule<Subject> = lacking("it no longer asks, and accepts", StillAsks);
const UNANSWERED: NamedRule<Subject> = lacking("late MOVEs unanswered", AnswersAgain);
/// Robots that ask for another call than the nearest, or of equals than the first by name.
const BY_OTHER_CALLS: [NamedRule<Subject>; 3] = [
    lacking("the least SN, however far", NearestCall),
    NamedRule::new("of equal HC the first heard", FIRST_OF_EQUALS),
    NamedRule::new(
        "the first call heard",
        Subject::rescuing(Rule::REPAIRED.without(NearestCall).without(LeastIdentity)),
    ),
];
const ACCEPTS: NamedRule<Subject> =
    NamedRule::new("on its way elsewhere it accepts", Subject::misreading(Misreading::Offers));

/// The settings of a rescue.
const TWO: Setting = Setting {
    rule: Rule::REPAIRED,
    misread: None,
    reading: RobotReading::PUBLISHED,
    robots: 2,
    wfrs: 2,
    events: 2,
    max_hops: 2,
    faults: Faults::any(1),
    lossy: LossKind::All,
    leases: Leases::UntilCalled,
};
const TWO_LONGER: Setting = Setting { events: 3, max_hops: 1, ..TWO };
const THREE_AND_TWO: Setting = Setting { robots: 3, max_hops: 1, ..TWO };
const TWO_AND_ONE: Setting = Setting { wfrs: 1, ..TWO };
/// For a robot alone all readings are alike but for what is lost. Two whose SBits
/// are their own go round in too many ways.
const ALONE: Setting = Setting { robots: 1, max_hops: 1, ..TWO_AND_ONE };
const ONE_AND_TWO: Setting = Setting { robots: 1, events: 3, ..TWO };
const ONE_AND_THREE: Setting = Setting { robots: 1, wfrs: 3, events: 3, ..TWO };
/// A robot that asks once more when its timer goes off bids for two calls at a time only if it goes off early twice.
const TWO_FAULTS: Setting = Setting { robots: 1, faults: Faults::any(2), ..TWO };

/// The clauses.
pub const CLAUSES: [Clause; 14] = [
    Clause {
        id: "MRC-1",
        sentence: "Two robots MUST never be on their way for the same call of a WFR.",
        checks: &[
            &Check::refuted(PUBLISHED, &Within(Demand::OneRobotForACall, TWO_AND_ONE))
                .under(holding_where!(stands))
                .of(&PAPER),
            &Check::holds(REPAIRED, &Within(Demand::OneRobotForACall, TWO), &[REDECIDE]),
            &Check::holds(REPAIRED, &Within(Demand::OneRobotForACall, TWO_LONGER), &[REDECIDE]),
            &Check::holds(REPAIRED, &Within(Demand::OneRobotForACall, THREE_AND_TWO), &[REDECIDE]),
        ],
    },
    Clause {
        id: "MRC-2",
        sentence: "Two WFRs MUST never count on the same robot.",
        checks: &[
            &Check::refuted(PUBLISHED, &Within(Demand::OneCallForARobot, ONE_AND_TWO))
                .under(holding_where!(is_in_a_window_by_one_record))
                .of(&PAPER),
            &Check::holds(REPAIRED, &Within(Demand::OneCallForARobot, TWO), &[NO_CONSENT]),
            &Check::holds(REPAIRED, &Within(Demand::OneCallForARobot, TWO_LONGER), &[NO_CONSENT]),
            &Check::holds(REPAIRED, &Within(Demand::OneCallForARobot, THREE_AND_TWO), &[NO_CONSENT]),
            &Check::holds(REPAIRED, &Within(Demand::OneCallForARobot, TWO_FAULTS), &[ACCEPTS]),
        ],
    },
    Clause {
        id: "MRC-3",
        sentence: "A WFR MUST choose the best of the MOVEs of its present call that it has received when its window \
                   closes.",
        checks: &[
            &Check::refuted(PUBLISHED, &Within(Demand::BestOfTheWindow, TWO_AND_ONE))
                .under(REFUTED)
                .of(&PAPER),
            &Check::holds(
                REPAIRED,
                &Within(Demand::BestOfTheWindow, TWO),
                &[
                    lacking("no collection window", Window),
                    REDECIDE,
                    lacking("the least MID, however far", NearestRobot),
                    NamedRule::new("of equal MHC the first heard", FIRST_OF_EQUALS),
                    NamedRule::new(
                        "the first MOVE heard",
                        Subject::rescuing(Rule::REPAIRED.without(NearestRobot).without(LeastIdentity)),
                    ),
                    NO_EPOCH,
                ],
            ),
            &Check::holds(REPAIRED, &Within(Demand::BestOfTheWindow, TWO_LONGER), &[REDECIDE, NO_EPOCH]),
            &Check::holds(REPAIRED, &Within(Demand::BestOfTheWindow, THREE_AND_TWO), &[REDECIDE, NO_EPOCH]),
        ],
    },
    Clause {
        id: "MRC-4",
        sentence: "A WFR MUST count on a robot only if the robot has taken the lease of its call.",
        checks: &[
            &Check::refuted(PUBLISHED, &Within(Demand::CountsOnConsent, TWO_AND_ONE))
                .under(REFUTED)
                .of(&PAPER),
            &Check::holds(REPAIRED, &Within(Demand::CountsOnConsent, TWO), &[NO_CONSENT]),
            &Check::holds(REPAIRED, &Within(Demand::CountsOnConsent, TWO_LONGER), &[NO_CONSENT]),
            &Check::holds(REPAIRED, &Within(Demand::CountsOnConsent, THREE_AND_TWO), &[NO_CONSENT]),
            &Check::holds(REPAIRED, &Within(Demand::CountsOnConsent, TWO_FAULTS), &[ACCEPTS]),
        ],
    },
    Clause {
        id: "MRC-5",
        sentence: "A WFR that waits MUST be rescued in the end, as long as a robot lives that its calls reach.",
        checks: &[
            &Check::refuted(PUBLISHED, &Within(Demand::IsServed, TWO_AND_ONE))
                .under(REFUTED_BY_CHOICE)
                .of(&PAPER),
            &Check::refuted(PUBLISHED, &Within(Demand::IsServed, ALONE)).under(REFUTED).of(&PAPER),
            &Check::holds(REPAIRED, &Within(Demand::IsServed, TWO_AND_ONE), &[NO_RENEWAL, NO_EPOCH]),
            &Check::holds(
                REPAIRED,
                &Within(Demand::IsServed, ONE_AND_TWO),
                &[lacking("no collection window", Window), NO_EPOCH],
            ),
            &Check::holds(REPAIRED, &Within(Demand::IsServed, TWO), &[NO_RENEWAL]),
            &Check::holds(REPAIRED, &Within(Demand::IsServed, TWO_LONGER), &[NO_RENEWAL]),
            &Check::holds(REPAIRED, &Within(Demand::IsServed, THREE_AND_TWO), &[NO_RENEWAL]),
        ],
    },
    Clause {
        id: "MRC-6",
        sentence: "A robot that hears a call under a new epoch MUST have its SBit clear.",
        checks: &[
            &Check::refuted(PUBLISHED, &Within(Demand::AsksAnew, ALONE))
                .under(holding_where!(has_packets))
                .of(&PAPER),
            &Check::holds(REPAIRED, &Within(Demand::AsksAnew, TWO), &[NO_EPOCH]),
            &Check::holds(REPAIRED, &Within(Demand::AsksAnew, TWO_LONGER), &[NO_EPOCH]),
            &Check::holds(REPAIRED, &Within(Demand::AsksAnew, THREE_AND_TWO), &[NO_EPOCH]),
        ],
    },
    Clause {
        id: "MRC-7",
        sentence: "A free robot MUST ask for the nearest of the calls that it has heard \
                   and whose SBit is clear, until it is set or the robot takes a lease.",
        checks: &[
            &Check::holds(
                PUBLISHED,
                &Within(Demand::AsksNearest, ONE_AND_THREE),
                &[
                    NamedRule::new(
                        "the least SN, however far",
                        Subject::rescuing(Rule::PUBLISHED.without(NearestCall)),
                    ),
                    NamedRule::new(
                        "of equal HC the first heard",
                        Subject::rescuing(Rule::PUBLISHED.without(LeastIdentity)),
                    ),
                ],
            )
            .under(holding_where!(asks_until_told))
            .of(&PAPER),
            &Check::holds(REPAIRED, &Within(Demand::AsksNearest, TWO), &BY_OTHER_CALLS),
            &Check::holds(REPAIRED, &Within(Demand::AsksNearest, ONE_AND_THREE), &BY_OTHER_CALLS),
            &Check::holds(
                REPAIRED,
                &Within(Demand::AsksNearest, THREE_AND_TWO),
                &[BY_OTHER_CALLS[1], BY_OTHER_CALLS[2]],
            ),
        ],
    },
    Clause {
        id: "MRC-8",
        sentence: "A robot MUST take the lease of a call only when it is told, while it asks for that call, that it is \
                   chosen.",
        checks: &[
            &Check::refuted(PUBLISHED, &Within(Demand::TakesWhatItAsksFor, TWO_AND_ONE))
                .under(REFUTED)
                .of(&PAPER),
            &Check::holds(REPAIRED, &Within(Demand::TakesWhatItAsksFor, TWO), &[NO_LONGER_ASKS, NO_CONSENT]),
            &Check::holds(
                REPAIRED,
                &Within(Demand::TakesWhatItAsksFor, TWO_LONGER),
                &[NO_LONGER_ASKS, NO_CONSENT],
            ),
            &Check::holds(
                REPAIRED,
                &Within(Demand::TakesWhatItAsksFor, THREE_AND_TWO),
                &[NO_LONGER_ASKS, NO_CONSENT],
            ),
        ],
    },
    Clause {
        id: "MRC-9",
        sentence: "A WFR MUST tell its choice to every robot whose MOVE of its call it has received, and to no other.",
        checks: &[
            &Check::refuted(PUBLISHED, &Within(Demand::TellsWhoAsked, TWO_AND_ONE))
                .under(holding_where!(is_answered_in_a_window))
                .of(&PAPER),
            &Check::holds(
                REPAIRED,
                &Within(Demand::TellsWhoAsked, TWO),
                &[
                    UNANSWERED,
                    NamedRule::new(
                        "a new call keeps who has asked under the one before",
                        Subject::misreading(Misreading::Askers),
                    ),
                ],
            ),
            &Check::holds(REPAIRED, &Within(Demand::TellsWhoAsked, TWO_LONGER), &[UNANSWERED]),
            &Check::holds(REPAIRED, &Within(Demand::TellsWhoAsked, THREE_AND_TWO), &[UNANSWERED]),
        ],
    },
    Clause {
        id: "MRC-10",
        sentence: "Of each WFR a robot MUST record the newest call that it has heard, one hop more than the fewest \
                   under it and the first node that told it so, and bid by that record.",
        checks: &[&Check::refuted(PUBLISHED, RECORDS.method).judged(records::recorded), &RECORDS],
    },
    Clause {
        id: "MRC-11",
        sentence: "A path node MUST send a robot's message on to its own parent, and a RESB of the robot's newest call \
                   to whom the robot's latest message of it came from.",
        checks: &[&WAYS_BACK],
    },
    Clause {
        id: "MRC-12",
        sentence: "A robot MUST set the SBit of a call when it is told whom the WFR has chosen or has asked in vain, \
                   and keep it until it hears a newer call.",
        checks: &[&SERVED],
    },
    Clause {
        id: "MRC-13",
        sentence: "A MOVE, and the RESB to the robot chosen, MUST be repeated as often as the rule says \
                   while nobody answers, and not more often.",
        checks: &[&REPEATED],
    },
    Clause {
        id: "MRC-14",
        sentence: "A robot whose records are full MUST put a new WFR in the place of the first that it is done with, \
                   unless it holds that one's lease, and leave it to others if there is none.",
        checks: &[&FILLED],
    },
];
