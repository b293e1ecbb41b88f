//! A rule of one's own is decided as ours are, and what is wrong with how it is asked is said: a situation that never
//! occurs, a run that neither ends nor comes back, an area that is too large.

use tautline_kernel::ground::{Cell, Side, Step};
use tautline_proofs::decide::{Answer, Desk, Memory, Method, Refused, Seen, Verdict};
use tautline_proofs::engine::Until;
use tautline_proofs::engine::states::Room;
use tautline_proofs::engine::tree::{Waves, unwatched};
use tautline_proofs::team::{Demand, Keeps, Layouts, Promise, Team};

/// What a robot does: it goes east and back for ever, or counts, or goes east until it meets a wall.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Rule {
    Patrols,
    Counts,
    Ends,
}

#[derive(Clone, Copy, PartialEq, Eq)]
struct Robot {
    rule: Rule,
    heading: Side,
    walls: u32,
    moves: u32,
}

impl Team<1> for Robot {
    fn plan(&mut self) -> Option<[Step; 1]> {
        let is_over = self.rule == Rule::Ends && self.walls > 0;
        (!is_over).then_some([Step::Cross(self.heading)])
    }

    fn settle(&mut self, _: [Cell; 1], [is_blocked]: [bool; 1]) {
        if is_blocked {
            self.heading = self.heading.opposite();
            self.walls = 1;
        }
        self.moves += u32::from(self.rule == Rule::Counts);
    }
}

const START: fn(&Rule) -> (Robot, [Cell; 1]) =
    |&rule| (Robot { rule, heading: Side::East, walls: 0, moves: 0 }, [Cell::new(0, 0)]);

const fn layouts(size: (i16, i16), demands: &'static [Demand<Robot, 1>]) -> Layouts<Rule, Robot, 1> {
    Layouts { scheme: "robot", size, max_walls: 2, longest_run: 50, start: START, demands, covers: &[] }
}

const STAYS: Demand<Robot, 1> = Demand::always("ROBOT-1", "it stays in its row", |moved| moved.to[0].y == 0);
const ENDS: Demand<Robot, 1> = Demand::never_endless("ROBOT-2", "its run ends");
const LEAVES: Demand<Robot, 1> = Demand::at_the_end("ROBOT-3", "it left", |_, cells| cells[0].x > 0);
const NOTHING: Demand<Robot, 1> = Demand::always("WALK-1", "it makes no team move", |_| false);
const ARRIVES: Demand<Robot, 1> = Demand::at_the_end("WALK-2", "it arrives", |_, cells| cells[0].x == 3);

static ROW: Layouts<Rule, Robot, 1> = layouts((4, 1), &[STAYS, ENDS, LEAVES]);
static PATROL: Layouts<Rule, Robot, 1> = layouts((4, 1), &[STAYS]);
static MASKED: Layouts<Rule, Robot, 1> = layouts((4, 1), &[NOTHING, ARRIVES]);
static ALONE: Layouts<Rule, Robot, 1> = layouts((4, 1), &[ARRIVES]);
static WIDE: Layouts<Rule, Robot, 1> = layouts((17, 1), &[STAYS]);
static NONE: Layouts<Rule, Robot, 1> = layouts((0, 1), &[STAYS]);
static UNCOVERED: Layouts<Rule, Robot, 1> = Layouts {
    covers: &[("a step", |moved| moved.from != moved.to), ("a step south", |moved| moved.to[0].y > 0)],
    ..layouts((4, 1), &[STAYS])
};

/// The first team move breaks the first demand.
static STILL_AND_ENDS: Layouts<Rule, Robot, 1> = layouts(
    (4, 1),
    &[Demand::always("ROBOT-4", "it stays where it is", |moved| moved.from == moved.to), ENDS],
);

/// What comes of a demand, by its layouts and its number.
type Asked = (&'static Layouts<Rule, Robot, 1>, usize);

fn decided(rule: Rule, (layouts, demand): Asked) -> Result<Answer, Refused> {
    let memory = &mut Memory::default();
    let mut desk = Desk { memory, watch: &mut unwatched, room: Room::any() };
    Keeps(layouts, demand).decide(&rule, Until::Exhausted, &mut desk)
}

fn verdict(rule: Rule, asked: Asked) -> Verdict {
    decided(rule, asked).expect("it can be decided").verdict
}

#[test]
fn a_demand_is_decided_as_if_it_stood_alone() {
    assert_eq!(verdict(Rule::Patrols, (&STILL_AND_ENDS, 0)), Verdict::Refuted);
    let endless = decided(Rule::Patrols, (&STILL_AND_ENDS, 1)).expect("it can be decided");
    assert_eq!(endless.verdict, Verdict::Refuted);
    let choices = endless.counterexample.expect("there is a counterexample").choices;
    assert!(Keeps(&STILL_AND_ENDS, 1).replay(&Rule::Patrols, &choices).is_ok());
}

#[test]
fn every_demand_is_decided_in_its_own_way() {
    assert_eq!(verdict(Rule::Ends, (&ROW, 0)), Verdict::Holds);
    assert_eq!(verdict(Rule::Ends, (&ROW, 1)), Verdict::Holds);
    // A wall beside the start keeps it there.
    let left = decided(Rule::Ends, (&ROW, 2)).expect("it can be decided");
    assert_eq!(
        (left.verdict, left.counterexample.map(|found| found.choices.once)),
        (Verdict::Refuted, Some(vec![1]))
    );
}

#[test]
fn a_run_that_comes_back_breaks_what_demands_an_end_and_is_over_where_nothing_does() {
    let endless = decided(Rule::Patrols, (&ROW, 1)).expect("it can be decided");
    assert_eq!(endless.verdict, Verdict::Refuted);
    // East, a wall, and once there and back: then it is where it was when it had met the wall.
    let Some(Seen::Robots(run)) = endless.counterexample.map(|found| found.seen) else { panic!("a run") };
    assert_eq!(run.frames.len(), 3 + 1 + 8);
    let patrol = decided(Rule::Patrols, (&PATROL, 0)).expect("it can be decided");
    assert_eq!((patrol.verdict, patrol.given_up), (Verdict::Holds, 0));
}

#[test]
fn a_run_that_neither_ends_nor_comes_back_is_given_up_and_the_question_is_open() {
    let counting = decided(Rule::Counts, (&PATROL, 0)).expect("it can be decided");
    assert_eq!(counting.verdict, Verdict::Open);
    assert!(counting.given_up > 0, "{counting:?}");
    let bound = Keeps(&PATROL, 0).bound();
    assert!(bound.ends_with("runs of at most 50 team moves"), "{bound}");
}

#[test]
fn a_situation_that_never_occurs_leaves_the_question_open() {
    assert_eq!(verdict(Rule::Ends, (&PATROL, 0)), Verdict::Holds);
    assert_eq!(verdict(Rule::Ends, (&UNCOVERED, 0)), Verdict::Open);
}

/// A demand before the one in question is broken by every first team move.
#[test]
fn a_walker_that_never_arrives_is_refuted_whatever_it_breaks_before() {
    let masked = decided(Rule::Ends, (&MASKED, 1)).expect("it can be decided");
    let alone = decided(Rule::Ends, (&ALONE, 0)).expect("it can be decided");
    assert_eq!(masked.verdict, Verdict::Refuted);
    assert_eq!(masked.counterexample, alone.counterexample);
    assert_eq!(verdict(Rule::Ends, (&MASKED, 0)), Verdict::Refuted);
}

#[test]
fn what_cannot_be_searched_is_refused_in_words() {
    let refused = |asked| decided(Rule::Ends, asked).expect_err("it cannot be searched").to_string();
    assert_eq!(refused((&WIDE, 0)), "an area has at most 16×16 cells");
    assert_eq!(refused((&NONE, 0)), "the area holds no cell");
}

#[test]
fn a_search_of_ones_own_is_left_and_taken_up_again() {
    let start = || ROW.search(&Rule::Ends, Until::Exhausted, &[]).expect("it can be searched");
    let mut whole = start();
    let mut positions = vec![whole.position()];
    while whole.wave() {
        positions.push(whole.position());
    }
    for position in &positions {
        let mut again = start();
        again.go_to(position).expect("a position of its own");
        while again.wave() {}
        assert_eq!(again.found(), whole.found());
    }
    let broken: Vec<Promise> = whole.found().counterexamples.iter().map(|found| found.broken).collect();
    assert_eq!(broken, [Promise(2)]);
}
