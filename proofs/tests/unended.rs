//! A step that does not end leaves its check open, with a word, whichever engine makes it; one that takes its time does
//! not.

use std::convert::Infallible;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, Once, PoisonError};
use std::thread;
use std::time::Duration;

use tautline_kernel::choice::Oracle;
use tautline_proofs::clause::{AnyCheck, Check, Clause, NamedRule};
use tautline_proofs::decide::{
    Answer, Context, EveryAnswer, EveryState, Method, MethodError, RandomAnswers, RefutationPlay, Verdict,
};
use tautline_proofs::engine::cases::{self, Cases};
use tautline_proofs::engine::states::System;
use tautline_proofs::engine::tree::{self, Game, unwatched};
use tautline_proofs::engine::world::{Turn, World};
use tautline_proofs::engine::{Choices, Outcome, ScriptError, Until, assume};
use tautline_proofs::ledger::{Hear, Indecision, Limits, News, Row, checks, decide};

/// A rule by what it does in one of its steps.
#[derive(Clone, Copy)]
enum Rule {
    /// It ends at once.
    Sound,
    /// It ends after a while.
    Slow,
    /// One of its steps does not end before the test is over.
    Endless(&'static Slip),
}

/// A step that does not end.
#[derive(Default)]
struct Slip {
    is_begun: AtomicBool,
    is_released: AtomicBool,
}

impl Slip {
    fn new() -> &'static Self {
        Box::leak(Box::default())
    }

    /// Lets the step end.
    fn release(&self) {
        self.is_released.store(true, Ordering::Relaxed);
    }
}

/// The steps of a slow rule take longer together than the tests are patient with one.
const WHILE: Duration = Duration::from_millis(120);

impl Rule {
    fn step(self) {
        match self {
            Self::Sound => {}
            Self::Slow => thread::sleep(WHILE),
            Self::Endless(slip) => {
                if slip.is_begun.swap(true, Ordering::Relaxed) {
                    return;
                }
                while !slip.is_released.load(Ordering::Relaxed) {
                    thread::sleep(Duration::from_millis(1));
                }
            }
        }
    }
}

/// Steps of each engine.
const STEPS: u32 = 12;

fn range() -> String {
    format!("{STEPS} steps")
}

fn body(rule: &Rule, oracle: &mut dyn Oracle) -> Outcome {
    assume(oracle.pick(STEPS) < STEPS)?;
    rule.step();
    Ok("an end")
}

static EXHAUSTIVE: EveryAnswer<Rule> = EveryAnswer { body, range, covers: &[] };
static SAMPLED: RandomAnswers<Rule> = RandomAnswers { body, runs: STEPS as u64, range, covers: &[] };

/// A counter, or a team that counts its team moves.
struct Counter(Rule);

impl World for Counter {
    type State = u32;
    type Plan = ();
    type Event = ();
    type Demand = &'static str;

    fn plan(&self, state: &mut u32, _: &[u8]) -> Option<()> {
        (*state < STEPS).then_some(())
    }

    fn settle(&self, state: &mut u32, (): &(), _: &mut Vec<u8>, _: &mut impl Oracle) {
        self.0.step();
        *state += 1;
    }

    fn broken_by(&self, _: &Turn<'_, Self>) -> Vec<&'static str> {
        Vec::new()
    }
}

impl System for Counter {
    type Part = u32;

    fn part(&self, &state: &u32, _: usize) -> u32 {
        state
    }

    fn put(&self, state: &mut u32, _: usize, &part: &u32) {
        *state = part;
    }
}

static STATES: EveryState<Rule, Counter> = EveryState {
    range,
    system: |&rule| Counter(rule),
    starts: |_| vec![0],
    most_steps: 1000,
    covers: &[],
    tell: |before, step| format!("{before} to {}", step.state),
};

impl Game for Counter {
    type Frame = u32;

    fn start(&self) -> u32 {
        0
    }

    fn frame(&self, turn: &Turn<'_, Self>) -> u32 {
        *turn.after
    }

    fn wanted(&self) -> &[&'static str] {
        &["nothing"]
    }

    fn words(&self, demand: &'static str, _: Option<&Turn<'_, Self>>) -> &'static str {
        demand
    }

    fn recurs(&self, _: &u32, _: usize, _: &u32, _: &[u8]) -> ControlFlow<Vec<&'static str>> {
        ControlFlow::Continue(())
    }

    fn edges(&self) -> u32 {
        1
    }
}

/// So many cases in one stage.
impl Cases for Counter {
    type Stage = ();
    type Case = ();
    type Outcome = Glance;
    type Findings = u64;
    type Error = Infallible;

    fn stages(&self) -> Vec<()> {
        vec![()]
    }

    fn cases(&self, (): ()) -> Result<Vec<()>, Infallible> {
        Ok(vec![(); STEPS as usize])
    }

    fn weight(&self, (): (), (): &()) -> u64 {
        1
    }

    fn examine(&self, (): (), (): &(), _: u64) -> Result<Glance, Infallible> {
        self.0.step();
        Ok(Glance)
    }

    fn add(&self, found: &mut u64, (): &(), _: Glance) -> Result<(), Infallible> {
        *found += 1;
        Ok(())
    }

    fn cover(&self, _: &mut u64, (): ()) {}
}

struct Glance;

impl cases::Outcome for Glance {
    fn steps(&self) -> u64 {
        1
    }

    fn is_whole(&self) -> bool {
        true
    }

    fn is_enough(&self) -> bool {
        false
    }
}

/// Engines without a method of their own that anyone may use.
#[derive(Clone, Copy)]
enum By {
    Tree,
    Cases,
}

impl Method<Rule> for By {
    fn engine(&self) -> &'static str {
        match self {
            Self::Tree => "tree",
            Self::Cases => "cases",
        }
    }

    fn bound(&self) -> String {
        range()
    }

    fn decide(&self, rule: &Rule, until: Until, _: &mut Context<'_, '_>) -> Result<Answer, MethodError> {
        let cases = match self {
            Self::Tree => {
                let limits = tree::Limits { max_walls: 0, budget_moves: None, until };
                tree::search(Counter(*rule), &limits, &mut unwatched).map_err(MethodError::new)?.moves
            }
            Self::Cases => {
                let Ok((cases, _)) = cases::search(&Counter(*rule), None, &mut |_| ControlFlow::Continue(()));
                cases
            }
        };
        Ok(Answer::new(None, true, Verdict::Holds, cases))
    }

    fn replay(&self, _: &Rule, _: &Choices) -> Result<RefutationPlay, ScriptError> {
        Err(ScriptError::Unbroken)
    }
}

static METHODS: [&'static dyn Method<Rule>; 5] = [&EXHAUSTIVE, &SAMPLED, &STATES, &By::Tree, &By::Cases];

/// Tests share the threads that decide, of which an endless step keeps one: so they run one after the other, on threads
/// enough.
fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    static THREADS: Once = Once::new();
    THREADS.call_once(|| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(4)
            .build_global()
            .expect("the first pool of this process");
    });
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Decides a clause that has these checks.
fn decided(checked: Vec<Check<Rule>>, patience_s: u32) -> (Vec<Row>, Vec<&'static str>) {
    let checked = checked.into_iter().map(|check| &*Box::leak(Box::new(check)) as &dyn AnyCheck);
    let (id, sentence) = ("COUNT-1", "A step MUST end.");
    let clause = Box::leak(Box::new(Clause { id, sentence, checks: checked.collect::<Vec<_>>().leak() }));
    let unended = Arc::new(Mutex::new(Vec::new()));
    let heard = Arc::clone(&unended);
    let hear: Hear = Arc::new(move |told: News<'_>| {
        if let News::Unended { clause } = told {
            heard.lock().unwrap_or_else(PoisonError::into_inner).push(clause);
        }
        ControlFlow::Continue(())
    });
    let limits = Limits { patience_s, ..Limits::default() };
    let rows = decide(&checks(&[clause]), &limits, &hear).expect("every method can begin");
    let unended = unended.lock().unwrap_or_else(PoisonError::into_inner).clone();
    (rows, unended)
}

fn check(rule: Rule, method: &'static dyn Method<Rule>) -> Check<Rule> {
    Check::new(NamedRule::new("counting", rule), method, method.shows(), &[])
}

#[test]
fn a_check_of_any_engine_is_open_if_a_step_does_not_end_and_the_others_are_decided() {
    let _alone = alone();
    for method in METHODS {
        let slip = Slip::new();
        let (rows, unended) =
            decided(vec![check(Rule::Endless(slip), method), check(Rule::Sound, method)], 1);
        slip.release();
        let [endless, sound] = &rows[..] else { panic!("{rows:?}") };
        assert_eq!(endless.undecided, Some(Indecision::Unended { variant: None, seconds: 1 }), "{rows:?}");
        assert_eq!((endless.decision.verdict, endless.is_as_registered()), (Verdict::Open, false));
        assert_eq!((sound.undecided, sound.is_as_registered()), (None, true), "{rows:?}");
        assert_eq!(unended, ["COUNT-1"], "{}", method.engine());
    }
}

#[test]
fn steps_that_take_their_time_are_waited_for() {
    let _alone = alone();
    for method in METHODS {
        let (rows, unended) = decided(vec![check(Rule::Slow, method)], 1);
        assert!(rows.iter().all(Row::is_as_registered), "{rows:?}");
        assert_eq!(unended, [""; 0], "{}", method.engine());
    }
}

#[test]
fn a_mutant_whose_step_does_not_end_is_not_rejected() {
    let _alone = alone();
    let slip = Slip::new();
    let mutants = vec![NamedRule::new("endless", Rule::Endless(slip))].leak();
    let check = Check { mutants, ..check(Rule::Sound, &EXHAUSTIVE) };
    let (rows, _) = decided(vec![check], 1);
    slip.release();
    let [row] = &rows[..] else { panic!("{rows:?}") };
    assert_eq!((row.decision.verdict, &row.decision.survived[..]), (Verdict::Holds, &["endless"][..]));
    let words = row.undecided.map(|undecided| undecided.to_string());
    assert_eq!(words.as_deref(), Some("a step of the mutant \"endless\" did not end within 1 s"));
}

#[test]
fn a_check_behind_those_that_do_not_end_is_open() {
    let _alone = alone();
    let slips = [(); 4].map(|()| Slip::new());
    let mut all: Vec<_> = slips.iter().map(|slip| check(Rule::Endless(slip), &EXHAUSTIVE)).collect();
    all.push(check(Rule::Sound, &EXHAUSTIVE));
    let (rows, _) = decided(all, 1);
    for slip in slips {
        slip.release();
    }
    let words: Vec<String> =
        rows.iter().filter_map(|row| row.undecided).map(|undecided| undecided.to_string()).collect();
    let step = "a step of the rule did not end within 1 s";
    assert_eq!(words, [step, step, step, step, "not decided, since a step of another check did not end"]);
    assert!(rows.iter().all(|row| row.decision.verdict == Verdict::Open), "{rows:?}");
}
