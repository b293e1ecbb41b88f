//! Local rules, decided for every number of robots and every layout.

use tautline_kernel::chain::{Condition, Move, Role, Rule};
use tautline_kernel::ground::{Cell, Circle, Step};
use tautline_proofs::clause::{AnyCheck, Check, NamedRule};
use tautline_proofs::decide::{Cache, Context, Depiction, Method, Verdict};
use tautline_proofs::engine::states::MemoryLimit;
use tautline_proofs::engine::tree::unwatched;
use tautline_proofs::engine::{Choices, Until};
use tautline_proofs::local::{Act, EveryNumber, Far, Invariant, Local, Plan, Robot, all_tuples, chain};

/// The answer about a rule, which is played again if it is refuted: the verdict, how many robots refute it in how many
/// steps, and the drawing.
fn decided<R: Local>(rule: &R) -> (Verdict, Option<(u32, usize)>, String) {
    let (memory, watch) = (&mut Cache::default(), &mut unwatched);
    let mut desk = Context { memory, watch, room: MemoryLimit::any() };
    let answer = EveryNumber::DEFAULT.decide(rule, Until::Exhausted, &mut desk).expect("a local rule");
    let Some(evidence) = answer.counterexample else { return (answer.verdict, None, String::new()) };
    let choices: &Choices = &evidence.choices;
    let again = EveryNumber::DEFAULT.replay(rule, choices).expect("a run");
    assert_eq!(again.evidence, evidence);
    for place in 0..choices.once.len() {
        let cut = Choices { once: choices.once[..place].to_vec(), again: Vec::new() };
        assert!(EveryNumber::DEFAULT.replay(rule, &cut).is_err(), "cut at {place}");
    }
    let Depiction::Story(story) = &evidence.seen else { panic!("a drawing") };
    let size = (choices.once[0] + R::ROBOTS as u32, choices.once.len() - 1);
    (answer.verdict, Some(size), story.clone())
}

/// The contact of neighbours in a chain (CHAIN-1, CHAIN-19), by the kernel's own relation.
struct Contact<const FAULTS: bool>(Rule);

/// A step, and whether the side that it crosses is known to be open.
type Going = (Step, bool);

fn as_move(plan: &Plan<(), Going>) -> Move {
    Move { from: plan.robot.at, step: plan.step, known_open: plan.act.1 }
}

impl<const FAULTS: bool> Local for Contact<FAULTS> {
    type State = ();
    type Act = Going;
    const FAULTS: bool = FAULTS;

    fn states(&self) -> Vec<()> {
        vec![()]
    }

    fn acts(&self, (): ()) -> Vec<Act<(), Going>> {
        let act = |step: Step, is_open: bool| {
            let goes = vec![(true, ())];
            let may_not = step != Step::Stay && (!is_open || FAULTS);
            let ends = if may_not { [goes, vec![(false, ())]].concat() } else { goes };
            Act { act: (step, is_open), step, ends, needs_open: is_open }
        };
        let crossing = Step::ALL.into_iter().filter(|&step| step != Step::Stay);
        Step::ALL
            .into_iter()
            .map(|step| act(step, false))
            .chain(crossing.map(|step| act(step, true)))
            .collect()
    }

    fn admits(&self, plans: &[Plan<(), Going>]) -> bool {
        let (own, ahead) = (as_move(&plans[0]), as_move(&plans[1]));
        self.0.admits_ahead(own, ahead)
            && (ahead.step == Step::Stay || self.0.admits_behind(ahead.to(), own.from))
    }

    fn keeps(&self, robots: &[Robot<()>]) -> bool {
        Circle::COVERED.covers(robots[0].at, robots[1].at)
    }

    fn reach(&self) -> (i16, Far) {
        (2, Far::Broken)
    }

    fn may_start(&self, robots: &[Robot<()>]) -> bool {
        robots[1].at == robots[0].at
    }

    fn start(&self, robots: usize) -> Vec<Robot<()>> {
        vec![Robot { at: Cell::new(0, 0), state: () }; robots]
    }

    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        chain(robots)
    }

    fn is_fixed(&self, robot: usize) -> bool {
        robot == 0
    }
}

#[test]
fn contact_holds_for_every_n_by_the_repaired_relation_and_each_of_its_conditions_is_needed() {
    let invariant = Invariant::of(&Contact::<false>(Rule::REPAIRED)).expect("a local rule");
    assert_eq!((invariant.places, invariant.kept.len(), invariant.cases), ((25, 13), 13, 837));
    assert_eq!(decided(&Contact::<false>(Rule::REPAIRED)).0, Verdict::Holds);
    let (verdict, size, story) = decided(&Contact::<false>(Rule::PUBLISHED));
    assert_eq!((verdict, size), (Verdict::Refuted, Some((3, 3))), "{story}");
    let needed = Condition::ALL.into_iter().filter(|&condition| {
        decided(&Contact::<false>(Rule::REPAIRED.without(condition))).0 == Verdict::Refuted
    });
    assert_eq!(
        needed.collect::<Vec<_>>(),
        [Condition::SafeAhead, Condition::CoveredBehind, Condition::UnsureAhead]
    );
}

#[test]
fn contact_holds_whoever_fails_by_the_reel_alone() {
    assert_eq!(decided(&Contact::<true>(Rule::REEL)).0, Verdict::Holds);
    let (verdict, size, story) = decided(&Contact::<true>(Rule::REPAIRED));
    assert_eq!((verdict, size), (Verdict::Refuted, Some((3, 2))), "{story}");
}

/// At most two robots in a cell (CHAIN-2 away from the base): three robots at once, by the kernel's conditions.
struct Crowd(Rule);

impl Local for Crowd {
    type State = ();
    type Act = Step;
    const ROBOTS: usize = 3;

    fn states(&self) -> Vec<()> {
        vec![()]
    }

    fn acts(&self, (): ()) -> Vec<Act<(), Step>> {
        let act = |step| {
            let ends = if step == Step::Stay { vec![(true, ())] } else { vec![(true, ()), (false, ())] };
            Act { act: step, step, ends, needs_open: false }
        };
        Step::ALL.into_iter().map(act).collect()
    }

    fn admits(&self, plans: &[Plan<(), Step>]) -> bool {
        (0..3).all(|one| {
            let (own, others) = (&plans[one], [&plans[(one + 1) % 3], &plans[(one + 2) % 3]]);
            let is_apart =
                !self.0.has(Condition::Distinct) || others.iter().all(|other| other.to() != own.to());
            let occupants = others.iter().filter(|other| other.robot.at == own.to()).count();
            is_apart && (own.step == Step::Stay || self.0.admits_entry(Role::Follower, occupants))
        })
    }

    fn keeps(&self, robots: &[Robot<()>]) -> bool {
        robots[0].at != robots[1].at || robots[1].at != robots[2].at
    }

    fn reach(&self) -> (i16, Far) {
        (0, Far::Fine)
    }

    fn may_start(&self, robots: &[Robot<()>]) -> bool {
        self.keeps(robots)
    }

    fn start(&self, robots: usize) -> Vec<Robot<()>> {
        (0..robots as i16).map(|x| Robot { at: Cell::new(x, 0), state: () }).collect()
    }

    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        all_tuples(robots, 3)
    }
}

#[test]
fn no_three_robots_are_in_one_cell_for_every_n_and_each_condition_is_needed() {
    assert_eq!(decided(&Crowd(Rule::REPAIRED)).0, Verdict::Holds);
    for condition in [Condition::Distinct, Condition::FullForFollower] {
        let (verdict, size, story) = decided(&Crowd(Rule::REPAIRED.without(condition)));
        assert_eq!(verdict, Verdict::Refuted, "{condition:?}");
        assert!(size.is_some_and(|(robots, _)| robots <= 4), "{story}");
    }
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
}

const LEASH: Leash =
    Leash { looks_at_present: true, is_here_alone: false, starts_apart: false, grows: false, reach: 2 };

fn apart(one: Cell, other: Cell) -> i16 {
    (one.x - other.x).abs() + (one.y - other.y).abs()
}

impl Local for Leash {
    type State = u8;
    type Act = Step;

    fn states(&self) -> Vec<u8> {
        vec![0]
    }

    fn acts(&self, state: u8) -> Vec<Act<u8, Step>> {
        let next = state + u8::from(self.grows);
        let act = |step| Act { act: step, step, ends: vec![(true, next), (false, state)], needs_open: false };
        Step::ALL.into_iter().map(act).collect()
    }

    fn admits(&self, plans: &[Plan<u8, Step>]) -> bool {
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
        (0..robots as i16).map(|x| Robot { at: Cell::new(x, 0), state: 0 }).collect()
    }

    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        chain(robots)
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
    insta::assert_snapshot!(refusal(Leash { is_here_alone: true, ..LEASH }), @"the rule is not the same everywhere: it answers Cross(West) in 0,0, Cross(East) in -2,0 in another way 113 columns and 57 rows away");
    insta::assert_snapshot!(refusal(Leash { starts_apart: true, ..LEASH }), @"robots that start so break the promise: [Robot { at: (0,0), state: 0 }, Robot { at: (2,1), state: 0 }]");
    insta::assert_snapshot!(refusal(Leash { grows: true, ..LEASH }), @"1 is none of the states of the rule");
    insta::assert_snapshot!(
        refusal(Leash { reach: 0, ..LEASH }),
        @"no robots may start: the promise would be about nothing"
    );
    insta::assert_snapshot!(refusal(Leash { reach: 2_000, ..LEASH }), @"16008001 relative places are more than 4000000: let the rule look less far, or give it fewer states");
}
