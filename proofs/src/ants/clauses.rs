//! The clauses of Ants.

use std::convert::Infallible;

use tautline_kernel::ants::Rule;
use tautline_kernel::floor::SensorFate::{Beside, Counted};

use super::apart::{self, Apart, EntryRule, Pile};
use super::{replacement, ties};
use crate::ambiguity::Charity::{Literal, Probable};
use crate::ambiguity::{Ambiguity, Interpretation, Paper};
use crate::clause::{Check, Clause, NamedRule, Reading, holding};
use crate::decide::EveryAnswer;
use crate::floor::plans::Area;
use crate::floor::series::Deception::CountsNothing;
use crate::floor::series::{Floors, HOW_OFTEN, MISSED, Subject};
use crate::floor::team::FloorProperty::{Dark, UncountedStart};
use crate::floor::team::{Demand, Series};

const PUBLISHED: NamedRule<Subject<Rule>> = NamedRule::new("published", Subject::of(Rule::PUBLISHED));
const REPAIRED: NamedRule<Subject<Rule>> = NamedRule::new("repaired", Subject::of(Rule::Repaired));

static PAPER: Paper = Paper {
    ambiguities: &[
        MISSED,
        Ambiguity {
            words: "“Each time it steps into a cell, it updates its value”",
            interpretations: &[
                Interpretation::new(
                    "counted start",
                    "an agent steps into the cell where it starts",
                    Probable,
                ),
                Interpretation::new("uncounted start", "that cell says 0 until one steps into it", Literal),
            ],
        },
        HOW_OFTEN,
    ],
    excluded: &[],
    repairs: &["repaired"],
};

const BESIDE: NamedRule<Rule> = NamedRule::new("beside", Rule::Published(Beside));
const COUNTED: NamedRule<Rule> = NamedRule::new("counted", Rule::Published(Counted));
const READINGS: [(&str, Rule); 2] = [(BESIDE.name, BESIDE.rule), (COUNTED.name, COUNTED.rule)];

const LOSING: Subject<Rule> = Subject::of(Rule::PUBLISHED);
const STAYING: Subject<Rule> = Subject::of(BESIDE.rule);
const COUNTING: Subject<Rule> = Subject::of(COUNTED.rule);

const EXPLORING: [(&str, Subject<Rule>); 11] = [
    ("beside", STAYING),
    ("counted", COUNTING),
    ("uncounted start", LOSING.on(&[UncountedStart])),
    ("beside + uncounted start", STAYING.on(&[UncountedStart])),
    ("counted + uncounted start", COUNTING.on(&[UncountedStart])),
    ("in the dark", LOSING.on(&[Dark])),
    ("beside + in the dark", STAYING.on(&[Dark])),
    ("counted + in the dark", COUNTING.on(&[Dark])),
    ("uncounted start + in the dark", LOSING.on(&[UncountedStart, Dark])),
    ("beside + uncounted start + in the dark", STAYING.on(&[UncountedStart, Dark])),
    ("counted + uncounted start + in the dark", COUNTING.on(&[UncountedStart, Dark])),
];

/// Where the sensors that are missed are finitely many, everything is explored.
const HOLDS_BUT_IN_THE_DARK: [Reading<Subject<Rule>>; 11] = holding(EXPLORING, [0, 1, 2, 3, 4]);

/// Ants that lose what a missed sensor counts.
const LOST: &[NamedRule<Rule>] = &[NamedRule::new("the missed sensor is lost", Rule::PUBLISHED)];

/// Ants whose sensors count nothing.
const fn uncounted(scheme: Rule) -> NamedRule<Subject<Rule>> {
    NamedRule::new("sensors count nothing", Subject::of(scheme).deceived(CountsNothing))
}

/// A run is over when every cell is explored, since crossings go on to grow for ever.
const EXPLORES: Floors<Infallible> = Floors::new(
    &[
        Series::new(Area::blocked(4, 4), 1),
        Series::missing(Area::blocked(3, 3), 1, 2),
        Series::new(Area::blocked(3, 2), 2),
    ],
    Demand::Explores,
);

/// As [`EXPLORES`], without the floors on which no sensor is missed, where piles are single sensors.
const EXPLORES_APART: Floors<Infallible> =
    Floors::new(&[Series::missing(Area::blocked(3, 3), 1, 2)], Demand::Explores);

const CHOOSES: EveryAnswer<Subject<Rule>> =
    EveryAnswer::new(ties::ties, ties::counts, &["a side", "no side"]);

const KEEPS: EveryAnswer<Rule> =
    EveryAnswer::new(replacement::keeps, replacement::pairs, &["a missed sensor", "a sensor that is seen"]);

/// The clauses.
pub const CLAUSES: [Clause; 3] = [
    Clause {
        id: "ANTS-1",
        sentence: "Ants MUST explore every cell that is connected with their start, whatever sensors are missed, as \
               its reading has it.",
        checks: &[
            &Check::holds(PUBLISHED, &EXPLORES, &[uncounted(Rule::PUBLISHED)])
                .under(&HOLDS_BUT_IN_THE_DARK)
                .of(&PAPER),
            &Check::holds(
                NamedRule::new("apart", Subject::of(Apart)),
                &EXPLORES_APART,
                &[NamedRule::new("sensors count nothing", Subject::of(Apart).deceived(CountsNothing))],
            ),
            &Check::holds(REPAIRED, &EXPLORES, &[uncounted(Rule::Repaired)]),
        ],
    },
    Clause {
        id: "ANTS-2",
        sentence: "An ant MUST go to the side neighbour that was entered least, the first in the order of the compass.",
        checks: &[
            &Check::holds(PUBLISHED, &CHOOSES, &[uncounted(Rule::PUBLISHED)]),
            &Check::holds(REPAIRED, &CHOOSES, &[uncounted(Rule::Repaired)]),
        ],
    },
    Clause {
        id: "ANTS-3",
        sentence: "A cell MUST NOT count fewer agents after a missed sensor was replaced than before.",
        checks: &[
            &Check::refuted(NamedRule::new("published", Rule::PUBLISHED), &KEEPS)
                .under(&holding(READINGS, [0, 1]))
                .of(&PAPER)
                .judged(replacement::replacement),
            &Check::holds(BESIDE, &KEEPS, LOST),
            &Check::holds(COUNTED, &KEEPS, LOST),
            &Check::holds(
                NamedRule::new("apart", Pile::entered as EntryRule),
                &EveryAnswer::new(
                    apart::keeps,
                    apart::piles,
                    &["both are missed", "both are seen", "one is missed"],
                ),
                &[NamedRule::new("the missed sensor is lost", apart::losing)],
            ),
            &Check::refuted(NamedRule::new("repaired", Rule::Repaired), &KEEPS)
                .because("the repair loses counts as well")
                .judged(replacement::replacement),
        ],
    },
];

#[cfg(test)]
mod tests {
    use rustc_hash::FxHashSet;
    use tautline_kernel::floor::{COMPASS, Mark, Sensor};
    use tautline_kernel::ground::Side;

    use super::*;
    use crate::engine::states::steps;
    use crate::floor::crew::SensorData;
    use crate::floor::small::StateOf;
    use crate::floor::team::{Demands, Team};

    /// A cell in the dark reads 0 however often an ant has been there; of equals an ant goes to the first in the order
    /// of the compass.
    #[test]
    fn an_ant_goes_to_and_fro_between_a_cell_and_one_in_the_dark_and_never_to_the_third() {
        for subject in [LOSING, STAYING, COUNTING] {
            let series = Series::missing(Area::blocked(3, 1), 1, 1);
            let teams = series.teams(&subject.on(&[Dark]), Demand::Explores);
            let lit = teams.into_iter().find(|team| (team.plan.free, team.dark) == (0b111, 0b100));
            let lit = lit.expect("three cells, the eastern one in the dark");
            let team = Team { series, ..lit };
            let mut state = team.starts().nth(1).expect("a start in the middle");
            for _ in 0..1000 {
                let made = steps(&team, &state).next().expect("it goes on");
                state = made.state;
            }
            assert!(!state.sensors.is_explored(&team.plan), "{subject:?}");
        }
    }

    /// Where each scan may miss any sensor (row 90 of the readings in `SPEC.md`), all are seen but one beside the ant,
    /// whose cell it enters then: so it can be led to any cell, until it enters one that counts nothing.
    #[test]
    fn an_ant_is_led_to_any_cell_beside_it_by_a_sensor_that_it_misses_or_explores_another_one() {
        for subject in [LOSING, STAYING, COUNTING] {
            assert_is_led(&subject, 1);
            assert_is_led(&subject.on(&[UncountedStart]), 1);
        }
        assert_is_led(&REPAIRED.rule, 1);
        // A cell may have two sensors.
        assert_is_led(&Subject::of(Apart), 2);
    }

    /// Whatever the cells count, and wherever the ant is: so however often it was carried elsewhere before. A cell into
    /// which it was put counts nothing for that.
    #[test]
    fn an_ant_that_was_relocated_explores_every_cell_from_any_state() {
        const COUNTS: u32 = 4;
        let (mut states, mut most_moves) = (0, 0);
        for team in Series::new(Area::blocked(3, 2), 1).teams(&LOSING, Demand::Explores) {
            let cells: Vec<usize> = team.plan.cells().filter_map(|cell| team.plan.place(cell)).collect();
            for start in team.starts() {
                for counts in 0..COUNTS.pow(cells.len() as u32) {
                    let mut state = start.clone();
                    for (digit, &place) in (0..).zip(&cells) {
                        let crossings = counts / COUNTS.pow(digit) % COUNTS;
                        let mark = if crossings == 0 { Mark::Unexplored } else { Mark::Explored };
                        state.sensors.all[place] = Sensor { mark, crossings, ..Sensor::default() };
                    }
                    states += 1;
                    let mut moves = 0;
                    while !state.sensors.is_explored(&team.plan) && cells.len() > 1 {
                        let made = steps(&team, &state).next().expect("it goes on");
                        state = made.state;
                        moves += 1;
                        assert!(moves < 100, "{state:?}");
                    }
                    most_moves = most_moves.max(moves);
                }
            }
        }
        assert_eq!((states, most_moves), (67_704, 16));
    }

    #[test]
    fn an_ant_that_is_carried_back_for_ever_never_comes_to_the_third_cell() {
        let teams = Series::new(Area::blocked(3, 1), 1).teams(&LOSING, Demand::Explores);
        let team = teams.into_iter().find(|team| team.plan.free == 0b111).expect("three cells in a row");
        let mut state = team.starts().next().expect("a start in the west");
        let west = state.bodies[0].cell;
        for _ in 0..1000 {
            let made = steps(&team, &state).next().expect("it goes on");
            state = made.state;
            assert_eq!(state.bodies[0].cell, west.beyond(Side::East));
            state.bodies[0].cell = west;
        }
        assert!(!state.sensors.is_explored(&team.plan));
    }

    fn assert_is_led<S: Demands>(subject: &Subject<S>, most_sensors: u8) {
        let mut looked_at = 0;
        for team in Series::missing(Area::blocked(3, 2), 1, 3).teams(subject, Demand::Explores) {
            let mut left: Vec<_> = team.starts().collect();
            let mut known = FxHashSet::default();
            while let Some(state) = left.pop() {
                if !known.insert(state.clone()) {
                    continue;
                }
                let made: Vec<_> = steps(&team, &state).map(|made| made.state).collect();
                let uncounted =
                    |state: &StateOf<S>| state.sensors.cells(&team.plan, |sensor| sensor.crossings() == 0);
                let cell = state.bodies[0].cell;
                let beside = COMPASS.into_iter().map(|side| cell.beyond(side));
                for goal in beside.filter(|&goal| team.plan.place(goal).is_some()) {
                    let is_led = |after: &&StateOf<S>| {
                        let misses = after.misses - state.misses;
                        misses <= most_sensors
                            && (after.bodies[0].cell == goal || uncounted(after) != uncounted(&state))
                    };
                    let may_miss = state.misses + most_sensors <= team.series.max_misses;
                    assert!(
                        made.is_empty() || !may_miss || made.iter().any(|after| is_led(&after)),
                        "{subject:?}, {state:?}"
                    );
                    looked_at += usize::from(may_miss && !made.is_empty());
                }
                left.extend(made);
            }
        }
        assert!(looked_at > 1000, "{looked_at}");
    }
}
