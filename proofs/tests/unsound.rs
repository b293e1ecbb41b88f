//! Checks of which no verdict may be believed: systems that leave something of a state out, and questions about
//! nothing.

use std::ops::ControlFlow;

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Edge, Side};
use tautline_proofs::decide::{
    Cache, Context, EveryAnswer, EveryState, Method, MethodResult, RandomAnswers, Verdict,
};
use tautline_proofs::engine::states::{self, MemoryLimit, System, Unsound, repeats};
use tautline_proofs::engine::tree::Progress;
use tautline_proofs::engine::world::{Turn, World};
use tautline_proofs::engine::{Outcome, Stop, Until};
use tautline_proofs::team::{
    Act, Cover, Demand, Ground, Keeps, Places, Rule, Setting, Strategy, View, Which,
};

use crate::refuted;

fn decide<R>(method: &impl Method<R>, rule: &R) -> MethodResult {
    refuted::decide(method, rule, Until::Violation)
}

fn refusal<R>(method: &impl Method<R>, rule: &R) -> String {
    decide(method, rule).expect_err("it is refused").to_string()
}

/// A fault of a system.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Slip {
    None,
    NoStart,
    PartLeftOut,
    PutsNothing,
    WritesTooLittle,
    TakesAllForOne,
    TakesSevenForSix,
    NeverCanonical,
    LeavesOutADifference,
}

/// Two counters, of which the second goes round.
struct Counters(Slip);

impl World for Counters {
    type State = (u8, u8);
    type Plan = ();
    type Event = ();
    type Demand = &'static str;

    fn plan(&self, state: &mut (u8, u8), _: &[u8]) -> Option<()> {
        (state.0 < 10).then_some(())
    }

    fn settle(&self, state: &mut (u8, u8), (): &(), _: &mut Vec<u8>, world: &mut impl Oracle) {
        if world.flip() {
            state.0 += 1;
        } else {
            state.1 = (state.1 + 1) % 3;
        }
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<&'static str> {
        if *turn.after == (4, 2) { vec!["they never come to 4 and 2"] } else { Vec::new() }
    }
}

impl System for Counters {
    type Part = u8;

    fn places(&self, _: &(u8, u8)) -> usize {
        match self.0 {
            Slip::WritesTooLittle => 0,
            Slip::PartLeftOut => 1,
            _ => 2,
        }
    }

    fn part(&self, state: &(u8, u8), place: usize) -> u8 {
        [state.0, state.1][place]
    }

    fn put(&self, state: &mut (u8, u8), place: usize, &part: &u8) {
        match place {
            0 => state.0 = part,
            _ if self.0 == Slip::PutsNothing => {}
            _ => state.1 = part,
        }
    }

    fn write(&self, state: &(u8, u8), to: &mut Vec<u8>) {
        if self.0 == Slip::WritesTooLittle {
            to.push(state.0);
        }
    }

    fn read(&self, state: &mut (u8, u8), bytes: &[u8]) {
        state.0 = bytes.first().copied().unwrap_or(state.0);
    }

    fn differing(&self, _: &(u8, u8), _: &(u8, u8)) -> states::Places {
        if self.0 == Slip::LeavesOutADifference { 1 } else { states::Places::MAX }
    }

    fn make_canonical(&self, state: &mut (u8, u8)) {
        match self.0 {
            Slip::TakesAllForOne => state.1 = 0,
            // As many steps are made from both, and neither breaks anything.
            Slip::TakesSevenForSix if state.0 == 7 => state.0 = 6,
            Slip::NeverCanonical => state.1 = (state.1 + 1) % 3,
            _ => {}
        }
    }
}

static COUNTED: EveryState<Slip, Counters> = EveryState {
    range: || "up to 10".to_owned(),
    system: |&slip| Counters(slip),
    starts: |system| if system.0 == Slip::NoStart { Vec::new() } else { vec![(0, 0)] },
    most_steps: 1000,
    covers: &[],
    tell: |before, step| format!("{before:?} to {:?}", step.state),
};

#[test]
fn a_system_that_leaves_something_of_a_state_out_is_refused() {
    let verdict = |slip| decide(&COUNTED, &slip).expect("it can be decided").verdict;
    assert_eq!((verdict(Slip::None), verdict(Slip::NoStart)), (Verdict::Refuted, Verdict::Open));
    for slip in [Slip::PartLeftOut, Slip::PutsNothing, Slip::WritesTooLittle] {
        let refusal = refusal(&COUNTED, &slip);
        assert!(refusal.starts_with("a state that is taken apart and put together again"), "{refusal}");
    }
    for slip in [Slip::TakesAllForOne, Slip::TakesSevenForSix, Slip::NeverCanonical] {
        let refusal = refusal(&COUNTED, &slip);
        assert!(refusal.starts_with("a state and the one that `make_canonical` makes"), "{refusal}");
    }
    let refusal = refusal(&COUNTED, &Slip::LeavesOutADifference);
    assert!(refusal.starts_with("a step leads to a state that differs in a part"), "{refusal}");
}

/// A counter that may wait, of which one byte alone is kept.
struct OneByte;

impl World for OneByte {
    type State = u16;
    type Plan = ();
    type Event = ();
    type Demand = &'static str;

    fn plan(&self, _: &mut u16, _: &[u8]) -> Option<()> {
        Some(())
    }

    fn settle(&self, state: &mut u16, (): &(), _: &mut Vec<u8>, world: &mut impl Oracle) {
        *state += u16::from(world.flip());
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<&'static str> {
        if matches!(turn.after, 258 | 1402) { vec!["it is neither 258 nor 1402"] } else { Vec::new() }
    }
}

impl System for OneByte {
    type Part = u8;

    fn places(&self, _: &u16) -> usize {
        0
    }

    fn part(&self, _: &u16, _: usize) -> u8 {
        0
    }

    fn put(&self, _: &mut u16, _: usize, _: &u8) {}

    fn write(&self, state: &u16, to: &mut Vec<u8>) {
        to.push(*state as u8);
    }

    fn read(&self, state: &mut u16, bytes: &[u8]) {
        *state = bytes[0].into();
    }
}

/// Neither steps that lead nowhere, nor hundreds of starts, keep the trial from going deep.
#[test]
fn a_state_that_is_lost_behind_hundreds_of_others_is_refused() {
    assert_eq!(repeats(&OneByte, [0]), Err(Unsound::Torn));
    assert_eq!(repeats(&OneByte, 1000..1400), Err(Unsound::Torn));
}

fn never_begins((): &(), _: &mut dyn Oracle) -> Outcome {
    Err(Stop::Assumed)
}

#[test]
fn a_body_without_a_case_leaves_the_question_open() {
    let range = || "cases".to_owned();
    let every = EveryAnswer { body: never_begins, range, covers: &[] };
    assert_eq!(decide(&every, &()).expect("a body").verdict, Verdict::Open);
    for runs in [0, 10] {
        let some = RandomAnswers { body: never_begins, runs, range, covers: &[] };
        assert_eq!(decide(&some, &()).expect("a body").verdict, Verdict::Open);
    }
}

/// A robot that goes east, or stays.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Goes;

impl Rule for Goes {
    type Memory = ();
    type Message = ();

    fn start(&self, _: usize, _: &[Cell]) {}

    fn act(&self, _: &mut View<'_, Self>, (): &mut ()) -> Act {
        Act::Go(Side::East)
    }
}

const fn setting(ground: Ground, starts: Places<Goes>) -> Setting<'static, Goes> {
    const STAYS: Demand<'static, Goes> = Demand::always("GO-1", "it is somewhere", &|_| true);
    Setting { demands: &[STAYS], ..Setting::new("goes", ground, 1, starts) }
}

const GROUND: Ground = Ground::open(3, 1);
const CORNER: Places<Goes> = Places::At(|_| vec![Cell::new(0, 0)]);

#[test]
fn a_demand_that_there_is_not_is_refused() {
    static TREE: Setting<'static, Goes> = setting(GROUND, CORNER);
    static STATES: Setting<'static, Goes> = setting(GROUND, Places::Any);
    for (of, by) in [(&TREE, Strategy::Tree), (&STATES, Strategy::States)] {
        assert_eq!(of.strategy(), by);
        assert_eq!(decide(&Keeps(of, 0), &Goes).expect("there is one").verdict, Verdict::Holds);
        assert_eq!(refusal(&Keeps(of, 5), &Goes), "there is no demand 5: the setting has 1");
        assert!(Keeps(of, 5).systems(&Goes).is_err());
    }
}

/// Two of them among states would be looked for as if one stood for both.
#[test]
fn several_demands_on_endless_runs_at_once_are_refused() {
    const ENDS: Demand<'static, Goes> = Demand::never_endless("GO-2", "it ends");
    static STATES: Setting<'static, Goes> =
        Setting { demands: &[ENDS, ENDS], ..setting(GROUND, Places::Any) };
    assert_eq!(decide(&Keeps(&STATES, 1), &Goes).expect("one is wanted").verdict, Verdict::Refuted);
    let refused = STATES.playing(&Goes, &[]).err().expect("both are wanted").to_string();
    assert_eq!(refused, "states are searched for one demand on endless runs at a time: name it");
}

#[test]
fn a_search_over_states_that_is_ended_leaves_the_question_open() {
    static MANY: Setting<'static, Goes> = Setting { robots: 4, ..setting(Ground::open(8, 1), Places::Any) };
    let mut ends = |_: &Progress<'_>| ControlFlow::Break(());
    let mut context = Context { cache: &mut Cache::default(), watch: &mut ends, memory: MemoryLimit::any() };
    let answer = Keeps(&MANY, 0).decide(&Goes, Until::Exhausted, &mut context).expect("it begins");
    assert_eq!(answer.verdict, Verdict::Open);
    assert_eq!(decide(&Keeps(&MANY, 0), &Goes).expect("it ends").verdict, Verdict::Holds);
}

#[test]
fn more_situations_than_can_be_told_apart_are_refused() {
    const fn covering(covers: &'static [Cover<'static, Goes>]) -> Setting<'static, Goes> {
        Setting { covers, ..setting(GROUND, CORNER) }
    }
    const MOVES: Cover<'static, Goes> = ("it moves", &|moved| moved.has_moved(0));
    static MOST: Setting<'static, Goes> = covering(&[MOVES; 64]);
    static TOO_MANY: Setting<'static, Goes> = covering(&[MOVES; 65]);
    assert_eq!(decide(&Keeps(&MOST, 0), &Goes).expect("they can be told apart").verdict, Verdict::Holds);
    let words = "more than 64 situations must occur: no more can be told apart";
    assert_eq!(refusal(&Keeps(&TOO_MANY, 0), &Goes), words);
}

#[test]
fn a_given_wall_or_blocked_cell_outside_of_the_area_is_refused() {
    static CELL: Setting<'static, Goes> =
        setting(GROUND.obstacles(Which::These(&[Cell::new(1, 0), Cell::new(7, 7)])), CORNER);
    static WALL: Setting<'static, Goes> =
        setting(GROUND.walls(Which::These(&[Edge::new(Cell::new(2, 0), Side::East)])), CORNER);
    assert_eq!(refusal(&Keeps(&CELL, 0), &Goes), "the blocked cell 7,7 is outside of the area");
    assert_eq!(refusal(&Keeps(&WALL, 0), &Goes), "the wall 2,0|3,0 is between no two cells of the area");
}
