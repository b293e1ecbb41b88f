//! Local rules, decided for every number of robots and every layout.

use std::sync::atomic::AtomicU64;
use std::sync::atomic::Ordering::Relaxed;

use tautline_kernel::ground::{Cell, Step};
use tautline_proofs::clause::{AnyCheck, Check, NamedRule};
use tautline_proofs::decide::{Cache, Depiction, Method, Verdict};
use tautline_proofs::engine::tree::unwatched;
use tautline_proofs::engine::{Choices, Until};
use tautline_proofs::local::{
    Act, EveryNumber, Far, GuardedPlanner, Invariant, Local, Plan, Robot, all_tuples, chain, in_a_row,
};

use crate::refuted::decide;

/// The answer about a rule, which is played again if it is refuted: the verdict, how many robots refute it in how many
/// steps, and the drawing.
pub(crate) fn decided<R: Local>(rule: &R) -> (Verdict, Option<(u32, usize)>, String) {
    decided_by(EveryNumber::DEFAULT, rule)
}

pub(crate) fn decided_by<R: Local>(method: EveryNumber, rule: &R) -> (Verdict, Option<(u32, usize)>, String) {
    let answer = decide(&method, rule, Until::Exhausted).expect("a local rule");
    let Some(evidence) = answer.counterexample else { return (answer.verdict, None, String::new()) };
    let choices: &Choices = &evidence.choices;
    let again = method.replay(rule, choices).expect("a run");
    assert_eq!(again.evidence, evidence);
    for place in 0..choices.once.len() {
        let cut = Choices { once: choices.once[..place].to_vec(), again: Vec::new() };
        assert!(method.replay(rule, &cut).is_err(), "cut at {place}");
    }
    let Depiction::Story(story) = &evidence.seen else { panic!("a drawing") };
    let size = (choices.once[0] + rule.least() as u32, choices.once.len() - 1);
    (answer.verdict, Some(size), story.clone())
}

/// Robots on a line that keep at most two cells from the next one: what may be wrong with a rule is a field.
#[derive(Clone, Copy)]
#[expect(clippy::struct_excessive_bools, reason = "each is one thing that may be wrong")]
struct Leash {
    /// A robot looks where the other one is, and not only where it goes.
    looks_at_present: bool,
    /// The rule depends on where robots are.
    is_here_alone: bool,
    /// Robots start too far apart.
    starts_apart: bool,
    /// The rule has a state that it does not name.
    grows: bool,
    reach: i16,
    slip: Slip,
}

/// A slip of the pen in a rule.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Slip {
    None,
    NoRobot,
    NoColour,
    NoState,
    NoAct,
    NoOutcome,
    NoWall,
    OnWhiteAlone,
    NoTuple,
    OneRobotTwice,
    StartsInNoState,
    FifthStartsFarAway,
    StartsBeyondAll,
    AdmitsNothing,
}

const LEASH: Leash = Leash {
    looks_at_present: true,
    is_here_alone: false,
    starts_apart: false,
    grows: false,
    reach: 2,
    slip: Slip::None,
};

fn apart(one: Cell, other: Cell) -> i16 {
    (one.x - other.x).abs() + (one.y - other.y).abs()
}

impl Local for Leash {
    type State = u8;
    type Act = Step;

    fn robots(&self) -> usize {
        if self.slip == Slip::NoRobot { 0 } else { 2 }
    }

    fn colours(&self) -> u8 {
        u8::from(self.slip != Slip::NoColour)
    }

    fn states(&self) -> Vec<u8> {
        if self.slip == Slip::NoState { Vec::new() } else { vec![0] }
    }

    fn acts(&self, state: u8) -> Vec<Act<u8, Step>> {
        let next = state + u8::from(self.grows);
        let ends = match self.slip {
            Slip::NoOutcome => Vec::new(),
            Slip::NoWall => vec![(true, next)],
            _ => vec![(true, next), (false, state)],
        };
        let act = |step| Act { act: step, step, ends: ends.clone(), needs_open: false };
        let all = if self.slip == Slip::NoAct { &[][..] } else { &Step::ALL };
        all.iter().copied().map(act).collect()
    }

    fn admits(&self, plans: &[Plan<u8, Step>]) -> bool {
        if self.slip == Slip::AdmitsNothing {
            return false;
        }
        let is_white = (plans[0].robot.at.x + plans[0].robot.at.y).rem_euclid(2) == 0;
        if self.slip == Slip::OnWhiteAlone && !is_white {
            return true;
        }
        let (one, other) = (&plans[0], &plans[1]);
        let mut pairs = vec![(one.to(), other.to())];
        if self.looks_at_present {
            pairs.extend([(one.robot.at, other.to()), (one.to(), other.robot.at)]);
        }
        pairs.into_iter().all(|(one, other)| apart(one, other) <= 2)
            && (!self.is_here_alone || one.robot.at.x < 50)
    }

    fn keeps(&self, robots: &[Robot<u8>]) -> bool {
        apart(robots[0].at, robots[1].at) <= 2
    }

    fn reach(&self) -> (i16, Far) {
        (self.reach, Far::Broken)
    }

    fn may_start(&self, robots: &[Robot<u8>]) -> bool {
        robots[1].at == Cell::new(if self.starts_apart { 2 } else { 1 }, i16::from(self.starts_apart))
    }

    fn start(&self, robots: usize) -> Vec<Robot<u8>> {
        let mut team = in_a_row(robots, u8::from(self.slip == Slip::StartsInNoState));
        if let (Slip::FifthStartsFarAway, Some(fifth)) = (self.slip, team.get_mut(4)) {
            fifth.at = Cell::new(9, 9);
        }
        if self.slip == Slip::StartsBeyondAll {
            team[0].at = Cell::new(i16::MIN, 0);
        }
        team
    }

    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        match self.slip {
            Slip::NoTuple => Vec::new(),
            Slip::OneRobotTwice => vec![vec![1, 1]],
            _ => chain(robots),
        }
    }
}

#[test]
fn a_rule_of_ones_own_is_a_clause_like_any_other() {
    const FORGETS: Leash = Leash { looks_at_present: false, ..LEASH };
    static OWN: Check<Leash> = Check::new(
        NamedRule::new("leash", LEASH),
        &EveryNumber::DEFAULT,
        Verdict::Holds,
        &[NamedRule::new("looks at goals alone", FORGETS)],
    );
    let decision = OWN.decide(&mut Cache::default(), &mut unwatched).expect("a local rule");
    assert!(decision.is_as_registered(&OWN), "{decision:?}");
    assert_eq!((OWN.engine(), OWN.bound()), ("local", "every N, every layout; the relation".to_owned()));
    let (verdict, size, story) = decided(&FORGETS);
    assert_eq!((verdict, size), (Verdict::Refuted, Some((2, 2))), "{story}");
    insta::assert_snapshot!(story, @r"
    start   Cross(East), Cross(East)   Cross(East), Cross(East)
    0. 1.   0. .. 1.                   0. .. .. 1.
    0, 0    0, 0                       0, 0
            wall 0,0|1,0               wall 0,0|1,0
    ");
}

#[test]
fn what_is_no_local_rule_is_refused_with_the_reason() {
    let refusal = |rule: Leash| Invariant::of(&rule).expect_err("no local rule").to_string();
    insta::assert_snapshot!(refusal(Leash { is_here_alone: true, ..LEASH }),
        @"the rule is not the same everywhere: it answers Cross(West) in 0,0, Cross(East) in -2,0 in \
          another way 113 columns and 59 rows away");
    // A chessboard is the same 113 columns and 59 rows away.
    insta::assert_snapshot!(refusal(Leash { slip: Slip::OnWhiteAlone, ..LEASH }),
        @"the rule is not the same everywhere: it answers Cross(East) in 0,0, Cross(East) in -2,0 in \
          another way 1 column and 0 rows away");
    insta::assert_snapshot!(refusal(Leash { starts_apart: true, ..LEASH }),
        @"robots that start so break the promise: 0,0 0 | 2,1 0");
    insta::assert_snapshot!(refusal(Leash { grows: true, ..LEASH }), @"1 is none of the states of the rule");
    insta::assert_snapshot!(
        refusal(Leash { reach: 0, ..LEASH }),
        @"no robots may start: the promise would be about nothing"
    );
    insta::assert_snapshot!(refusal(Leash { reach: 2_000, ..LEASH }),
        @"16008001 relative places are more than 4000000: let the rule look less far, or give it fewer states");
    insta::assert_snapshot!(refusal(Leash { reach: i16::MAX, ..LEASH }),
        @"4294836225 relative places are more than 4000000: let the rule look less far, or give it fewer states");
}

/// Each was a promise of every number of robots once that speaks of nothing, or of robots that meet no wall.
#[test]
fn a_slip_of_the_pen_is_refused_with_what_would_be_right() {
    let refusal = |slip| {
        let rule = Leash { slip, ..LEASH };
        let refusal =
            decide(&EveryNumber::DEFAULT, &rule, Until::Exhausted).expect_err("it is refused").to_string();
        let certificate = EveryNumber::DEFAULT.certificate(&rule).expect("an answer");
        assert_eq!(certificate.expect_err("no certificate either").to_string(), refusal);
        refusal
    };
    insta::assert_snapshot!(refusal(Slip::NoRobot), @"the rule speaks of no robot: the promise would be about nothing");
    insta::assert_snapshot!(refusal(Slip::NoColour),
        @"the rule gives cells no colour: the promise would be about nothing");
    insta::assert_snapshot!(refusal(Slip::NoState), @"the rule names no state: the promise would be about nothing");
    insta::assert_snapshot!(refusal(Slip::NoAct),
        @"a robot in state 0 has no act: name one by which it stays in its cell");
    insta::assert_snapshot!(refusal(Slip::NoOutcome),
        @"Cross(East) in state 0 has no outcome: name at least one, or leave the act out");
    insta::assert_snapshot!(refusal(Slip::NoWall),
        @"Cross(East) in state 0 crosses a side that may be a wall: name an outcome in which the \
          robot stays, or say that the act is_sure");
    insta::assert_snapshot!(refusal(Slip::NoTuple),
        @"tuples names none of 2 robots: the promise would be about nothing");
    insta::assert_snapshot!(refusal(Slip::OneRobotTwice), @"tuples names [1, 1], which are not 2 of 2 robots");
    insta::assert_snapshot!(refusal(Slip::StartsInNoState),
        @"a team of 2 starts in 1, which is none of the states of the rule");
    insta::assert_snapshot!(refusal(Slip::FifthStartsFarAway), @"a team of 5 may not start so: 0,0 0 | 6,9 0");
    insta::assert_snapshot!(refusal(Slip::StartsBeyondAll),
        @"a team of 2 starts in -32768,0, more than 16000 columns or rows from 0,0: let it start nearer");
    insta::assert_snapshot!(refusal(Slip::AdmitsNothing),
        @"the rule admits no plan of robots that keep the promise, as far as is looked: the promise \
          would be about nothing; let admits say yes to a plan, such as that all stay");
    let reach = Invariant::of(&Leash { reach: -1, ..LEASH }).expect_err("it is refused").to_string();
    insta::assert_snapshot!(reach, @"the promise looks -1 cells far: give 0 or more");
    let fewer = EveryNumber { teams: "up to four robots", most_starts: 4, ..EveryNumber::DEFAULT };
    assert_eq!(decided_by(fewer, &Leash { slip: Slip::FifthStartsFarAway, ..LEASH }).0, Verdict::Holds);
}

/// Robots in one cell, of which the first of those that are bound stays: each two are bound in a team of three or four,
/// and in a larger one the first two alone.
struct FewAreBound;

impl Local for FewAreBound {
    type State = ();
    type Act = Step;

    fn least(&self) -> usize {
        3
    }

    fn states(&self) -> Vec<()> {
        vec![()]
    }

    fn acts(&self, (): ()) -> Vec<Act<(), Step>> {
        Act::steps(())
    }

    fn admits(&self, plans: &[Plan<(), Step>]) -> bool {
        plans[0].step == Step::Stay
    }

    fn keeps(&self, robots: &[Robot<()>]) -> bool {
        robots[0].at == robots[1].at
    }

    fn reach(&self) -> (i16, Far) {
        (1, Far::Broken)
    }

    fn may_start(&self, robots: &[Robot<()>]) -> bool {
        self.keeps(robots)
    }

    fn start(&self, robots: usize) -> Vec<Robot<()>> {
        vec![Robot::new(Cell::new(0, 0), ()); robots]
    }

    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        if robots < 5 { all_tuples(robots, 2) } else { vec![vec![0, 1]] }
    }
}

/// Places of three robots keep the promise, but no three of five robots are bound so. Before, only teams that are
/// searched were asked which of them are bound, and the promise of five was taken to hold.
#[test]
fn robots_that_only_a_small_team_binds_prove_nothing_of_larger_ones() {
    assert_eq!(decided(&FewAreBound).0, Verdict::Open);
    let up_to_five = EveryNumber { most_robots: 5, ..EveryNumber::DEFAULT };
    let (verdict, size, _) = decided_by(up_to_five, &FewAreBound);
    assert_eq!((verdict, size), (Verdict::Refuted, Some((5, 1))));
    let up_to_four = EveryNumber { teams: "three and four robots", most_starts: 4, ..EveryNumber::DEFAULT };
    assert_eq!(decided_by(up_to_four, &FewAreBound).0, Verdict::Holds);
}

/// A planner that picks any acts, and a generator of its own.
fn any_acts(drawn: &AtomicU64) -> u64 {
    let next = |known: u64| {
        Some(known.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407))
    };
    drawn.fetch_update(Relaxed, Relaxed, next).unwrap_or_default() >> 33
}

#[test]
fn any_planner_that_is_kept_to_the_relation_keeps_the_promise() {
    static DRAWN: AtomicU64 = AtomicU64::new(2011);
    let any = |robot: &Robot<u8>| {
        let acts = LEASH.acts(robot.state);
        acts[any_acts(&DRAWN) as usize % acts.len()].clone()
    };
    let planner = move |robots: &[Robot<u8>]| robots.iter().map(any).collect::<Vec<_>>();
    let kept = GuardedPlanner { rule: LEASH, planner };
    let check = Check::holds(NamedRule::new("kept", kept), &EveryNumber::DEFAULT, &[]);
    assert_eq!(check.bound(), "every N, every layout; what runs, each plan kept to the relation");
    assert_eq!(decided(&kept).0, Verdict::Holds);
    let is_kept = |team: &[Robot<u8>]| team.windows(2).all(|pair| apart(pair[0].at, pair[1].at) <= 2);
    let after = |team: &[Robot<u8>], acts: &[Act<u8, Step>]| -> Vec<Robot<u8>> {
        let goes = |(robot, act): (&Robot<u8>, &Act<u8, Step>)| match any_acts(&DRAWN) % 3 {
            0 => *robot,
            _ => Robot::new(robot.at.after(act.step), robot.state),
        };
        team.iter().zip(acts).map(goes).collect()
    };
    let (mut team, mut moves) = (LEASH.start(5), 0);
    for _ in 0..20_000 {
        if let Some(acts) = kept.plan(&team, |_| true, |_| 0) {
            team = after(&team, &acts);
            moves += 1;
        }
        assert!(is_kept(&team), "{team:?}");
    }
    assert!(moves > 100, "{moves}");
    let mut free = LEASH.start(5);
    let breaks = (0..100).any(|_| {
        free = after(&free, &(kept.planner)(&free));
        !is_kept(&free)
    });
    assert!(breaks, "the planner alone keeps nothing");
}

/// A leash in a layout whose cells have colours: those of a team that starts may be wrong.
struct ColouredLeash(u8);

impl Local for ColouredLeash {
    type State = u8;
    type Act = Step;

    fn colours(&self) -> u8 {
        2
    }

    fn states(&self) -> Vec<u8> {
        LEASH.states()
    }

    fn acts(&self, state: u8) -> Vec<Act<u8, Step>> {
        LEASH.acts(state)
    }

    fn admits(&self, _: &[Plan<u8, Step>]) -> bool {
        true
    }

    fn keeps(&self, robots: &[Robot<u8>]) -> bool {
        LEASH.keeps(robots)
    }

    fn reach(&self) -> (i16, Far) {
        LEASH.reach()
    }

    fn may_start(&self, robots: &[Robot<u8>]) -> bool {
        LEASH.may_start(robots)
    }

    fn start(&self, robots: usize) -> Vec<Robot<u8>> {
        LEASH.start(robots).into_iter().map(|robot| Robot { on: self.0, ..robot }).collect()
    }

    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        chain(robots)
    }
}

#[test]
fn a_team_that_starts_in_cells_without_a_colour_is_refused() {
    assert_eq!(decided(&ColouredLeash(1)).0, Verdict::Refuted);
    let refusal = decide(&EveryNumber::DEFAULT, &ColouredLeash(2), Until::Exhausted);
    insta::assert_snapshot!(
        refusal.expect_err("there is no such colour"),
        @"a team of 2 starts in cells that have no colour below 2, or two"
    );
}
