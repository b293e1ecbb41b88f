//! A rule of one's own is decided as ours are, and what is wrong with how it is asked is said: a situation that never
//! occurs, a run that neither ends nor comes back, an area that is too large.

use tautline_kernel::ground::{Cell, Side};
use tautline_proofs::decide::{Answer, Depiction, Method, MethodError, Verdict};
use tautline_proofs::engine::Until;
use tautline_proofs::engine::tree::Waves;
use tautline_proofs::team::{Act, Demand, Ground, Keeps, Places, Promise, Rule, Scene, Setting, View, Which};

use crate::exhausted::certify;
use crate::refuted::decide;

/// A robot's walk: it goes east and back for ever, or counts, or goes east until it meets a wall.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Walk {
    Patrols,
    Counts,
    Ends,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
struct Walker {
    heading: Side,
    moves: u32,
}

impl Rule for Walk {
    type Memory = Walker;
    type Message = ();

    fn start(&self, _: usize, _: &[Cell]) -> Walker {
        Walker { heading: Side::East, moves: 0 }
    }

    fn act(&self, view: &mut View<'_, Self>, memory: &mut Walker) -> Act {
        if view.was_blocked() {
            memory.heading = memory.heading.opposite();
        }
        memory.moves += u32::from(*self == Self::Counts);
        Act::Go(memory.heading)
    }

    fn is_done(&self, robot: usize, scene: &Scene<Self>) -> bool {
        *self == Self::Ends && scene.was_blocked(robot)
    }
}

type WalkDemand = Demand<'static, Walk>;

const fn layouts(size: (i16, i16), demands: &'static [WalkDemand]) -> Setting<'static, Walk> {
    let ground = Ground::open(size.0, size.1).walls(Which::Met(2));
    let setting = Setting::new("robot", ground, 1, Places::At(|_: &Walk| vec![Cell::new(0, 0)]));
    Setting { longest_run: 50, demands, ..setting }
}

const STAYS: WalkDemand =
    Demand::always("ROBOT-1", "it stays in its row", &|moved| moved.after.cell(0).y == 0);
const ENDS: WalkDemand = Demand::never_endless("ROBOT-2", "its run ends");
const LEAVES: WalkDemand = Demand::at_the_end("ROBOT-3", "it left", &|scene| scene.cell(0).x > 0);
const NOTHING: WalkDemand = Demand::always("WALK-1", "it makes no team move", &|_| false);
const ARRIVES: WalkDemand = Demand::at_the_end("WALK-2", "it arrives", &|scene| scene.cell(0).x == 3);

static ROW: Setting<'static, Walk> = layouts((4, 1), &[STAYS, ENDS, LEAVES]);
static PATROL: Setting<'static, Walk> = layouts((4, 1), &[STAYS]);
static MASKED: Setting<'static, Walk> = layouts((4, 1), &[NOTHING, ARRIVES]);
static ALONE: Setting<'static, Walk> = layouts((4, 1), &[ARRIVES]);
static WIDE: Setting<'static, Walk> = layouts((17, 1), &[STAYS]);
static NONE: Setting<'static, Walk> = layouts((0, 1), &[STAYS]);
static UNCOVERED: Setting<'static, Walk> = Setting {
    covers: &[("a step", &|moved| moved.has_moved(0)), ("a step south", &|moved| moved.after.cell(0).y > 0)],
    ..layouts((4, 1), &[STAYS])
};

/// The first team move breaks the first demand.
static STILL_AND_ENDS: Setting<'static, Walk> =
    layouts((4, 1), &[Demand::always("ROBOT-4", "it stays where it is", &|moved| !moved.has_moved(0)), ENDS]);

/// A question about a demand: its layouts and its number.
type Question = (&'static Setting<'static, Walk>, usize);

fn decided(rule: Walk, (layouts, demand): Question) -> Result<Answer, MethodError> {
    let keeps = Keeps(layouts, demand);
    let answer = decide(&keeps, &rule, Until::Exhausted)?;
    certify(&keeps, &rule, answer.verdict);
    Ok(answer)
}

fn verdict(rule: Walk, asked: Question) -> Verdict {
    decided(rule, asked).expect("it can be decided").verdict
}

#[test]
fn a_demand_is_decided_as_if_it_stood_alone() {
    assert_eq!(verdict(Walk::Patrols, (&STILL_AND_ENDS, 0)), Verdict::Refuted);
    let endless = decided(Walk::Patrols, (&STILL_AND_ENDS, 1)).expect("it can be decided");
    assert_eq!(endless.verdict, Verdict::Refuted);
    let choices = endless.counterexample.expect("there is a counterexample").choices;
    assert!(Keeps(&STILL_AND_ENDS, 1).replay(&Walk::Patrols, &choices).is_ok());
}

#[test]
fn every_demand_is_decided_in_its_own_way() {
    assert_eq!(verdict(Walk::Ends, (&ROW, 0)), Verdict::Holds);
    assert_eq!(verdict(Walk::Ends, (&ROW, 1)), Verdict::Holds);
    // A wall beside the start keeps it there.
    let left = decided(Walk::Ends, (&ROW, 2)).expect("it can be decided");
    assert_eq!(
        (left.verdict, left.counterexample.map(|found| found.choices.once)),
        (Verdict::Refuted, Some(vec![1]))
    );
}

#[test]
fn a_run_that_comes_back_breaks_what_demands_an_end_and_is_over_where_nothing_does() {
    let endless = decided(Walk::Patrols, (&ROW, 1)).expect("it can be decided");
    assert_eq!(endless.verdict, Verdict::Refuted);
    // East once, and then there and back, with a wall at either end, until it learns no more of the layout.
    let Some(Depiction::Robots(run)) = endless.counterexample.map(|found| found.seen) else {
        panic!("a run")
    };
    assert_eq!(run.frames.len(), 1 + 10);
    let patrol = decided(Walk::Patrols, (&PATROL, 0)).expect("it can be decided");
    assert_eq!((patrol.verdict, patrol.given_up), (Verdict::Holds, 0));
}

#[test]
fn a_run_that_neither_ends_nor_comes_back_is_given_up_and_the_question_is_open() {
    let counting = decided(Walk::Counts, (&PATROL, 0)).expect("it can be decided");
    assert_eq!(counting.verdict, Verdict::Open);
    assert!(counting.given_up > 0, "{counting:?}");
    let bound = Keeps(&PATROL, 0).bound();
    assert!(bound.ends_with("runs of at most 50 team moves"), "{bound}");
}

#[test]
fn a_situation_that_never_occurs_leaves_the_question_open() {
    assert_eq!(verdict(Walk::Ends, (&PATROL, 0)), Verdict::Holds);
    assert_eq!(verdict(Walk::Ends, (&UNCOVERED, 0)), Verdict::Open);
}

/// A demand before the one in question is broken by every first team move.
#[test]
fn a_walker_that_never_arrives_is_refuted_whatever_it_breaks_before() {
    let masked = decided(Walk::Ends, (&MASKED, 1)).expect("it can be decided");
    let alone = decided(Walk::Ends, (&ALONE, 0)).expect("it can be decided");
    assert_eq!(masked.verdict, Verdict::Refuted);
    assert_eq!(masked.counterexample, alone.counterexample);
    assert_eq!(verdict(Walk::Ends, (&MASKED, 0)), Verdict::Refuted);
}

#[test]
fn what_cannot_be_searched_is_refused_in_words() {
    let refused = |asked| decided(Walk::Ends, asked).expect_err("it cannot be searched").to_string();
    assert_eq!(refused((&WIDE, 0)), "an area has at most 16×16 cells");
    assert_eq!(refused((&NONE, 0)), "the area holds no cell");
}

#[test]
fn a_search_of_ones_own_is_left_and_taken_up_again() {
    let start = || ROW.search(&Walk::Ends, Until::Exhausted, &[]).expect("it can be searched");
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
