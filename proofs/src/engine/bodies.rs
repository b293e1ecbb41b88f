//! Engines: ways to answer every choice of a body. The same body is a bounded proof under [`exhaust`], a property
//! under a [`Tape`] that proptest or a fuzzer wrote, a random test under [`SeededOracle`], a regression under
//! [`Replay`], and a Kani harness under `cargo kani`.

use std::iter;

use tautline_kernel::choice::Oracle;

use super::threads;
use super::watchdog::Steps;

/// Why a body stopped before its end.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Stop {
    /// The choices made no case of the clause.
    Assumed,
    /// The answer that the case is compared with takes too long to find: the case was not decided.
    GivenUp,
    /// The clause is broken: what was required, in words.
    Violated(&'static str),
}

/// A body's outcome of a case: which of the situations that it claims to cover it was.
pub type Outcome = Result<&'static str, Stop>;

/// Goes on only if the case belongs to the clause.
///
/// # Errors
/// [`Stop::Assumed`] if it does not.
pub const fn assume(belongs: bool) -> Result<(), Stop> {
    if belongs { Ok(()) } else { Err(Stop::Assumed) }
}

/// Goes on only if what the clause demands is so.
///
/// # Errors
/// [`Stop::Violated`] if it is not.
pub const fn require(holds: bool, demand: &'static str) -> Result<(), Stop> {
    if holds { Ok(()) } else { Err(Stop::Violated(demand)) }
}

/// A count of a body's cases under many answers.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Tally {
    /// Cases that met the assumptions and were decided, up to the violation if there is one.
    pub cases: u64,
    /// Cases that were given up.
    pub given_up: u64,
    /// The situations that occurred, sorted.
    pub covered: Vec<&'static str>,
    /// The first violation: the choices, and the demand that was not met.
    pub violation: Option<(Vec<u32>, &'static str)>,
}

impl Tally {
    /// Counts one outcome. Returns whether it was a violation.
    fn count(&mut self, outcome: Outcome, choices: impl FnOnce() -> Vec<u32>) -> bool {
        match outcome {
            Err(Stop::Assumed) => return false,
            Err(Stop::GivenUp) => {
                self.given_up += 1;
                return false;
            }
            Err(Stop::Violated(demand)) => self.violation = Some((choices(), demand)),
            Ok(situation) => cover(&mut self.covered, situation),
        }
        self.cases += 1;
        self.violation.is_some()
    }
}

/// Adds a situation to those that occurred, sorted.
pub fn cover(covered: &mut Vec<&'static str>, situation: &'static str) {
    if let Err(place) = covered.binary_search(&situation) {
        covered.insert(place, situation);
    }
}

/// Runs `body` under every combination of answers, depth first, until the first violation.
pub fn exhaust(mut body: impl FnMut(&mut dyn Oracle) -> Outcome) -> Tally {
    let mut tally = Tally::default();
    let mut odometer = Odometer::default();
    let steps = Steps::begin();
    loop {
        steps.next();
        let outcome = body(&mut odometer);
        if tally.count(outcome, || odometer.answers()) || !odometer.advance() {
            return tally;
        }
    }
}

/// Runs of [`sample`] between two looks for a violation.
const WAVE: u64 = 16;

/// Runs `body` under `runs` sequences of random answers, until the first violation. The tally is the same on any
/// number of threads.
pub fn sample(runs: u64, seed: u64, body: impl Fn(&mut dyn Oracle) -> Outcome + Sync) -> Tally {
    let mut tally = Tally::default();
    let mut first = 0;
    while first < runs && tally.violation.is_none() {
        let wave = first..runs.min(first + WAVE);
        first = wave.end;
        let outcomes = threads::each(wave, |run| {
            let _steps = Steps::begin();
            let mut recorder = Recorder { oracle: SeededOracle::new(seed, run), choices: Vec::new() };
            (body(&mut recorder), recorder.choices)
        });
        for (outcome, choices) in outcomes {
            if tally.count(outcome, || choices) {
                break;
            }
        }
    }
    tally
}

/// The outcomes of `body` under every combination of answers, in the order of [`exhaust`]; nothing where it comes to
/// `None`.
pub fn outcomes<T>(mut body: impl FnMut(&mut dyn Oracle) -> Option<T>) -> impl Iterator<Item = T> {
    let mut odometer = Some(Odometer::default());
    iter::from_fn(move || {
        loop {
            let world = odometer.as_mut()?;
            let outcome = body(world);
            if !world.advance() {
                odometer = None;
            }
            if outcome.is_some() {
                return outcome;
            }
        }
    })
}

/// Every alternative in turn: a counter whose digits have each the base that the body asked for.
#[derive(Default)]
pub(super) struct Odometer {
    digits: Vec<Digit>,
    position: usize,
}

struct Digit {
    value: u32,
    below: u32,
}

impl Odometer {
    /// The combination that was last asked for.
    fn answers(&self) -> Vec<u32> {
        self.digits[..self.position].iter().map(|digit| digit.value).collect()
    }

    /// Goes to the first combination of a body that may ask for other ones.
    pub(super) fn begin(&mut self) {
        self.digits.clear();
        self.position = 0;
    }

    /// Goes to the next combination; false after the last.
    pub(super) fn advance(&mut self) -> bool {
        self.digits.truncate(self.position);
        self.position = 0;
        while let Some(digit) = self.digits.last_mut() {
            digit.value += 1;
            if digit.value < digit.below {
                return true;
            }
            self.digits.pop();
        }
        false
    }
}

impl Oracle for Odometer {
    fn pick(&mut self, below: u32) -> u32 {
        if self.position == self.digits.len() {
            self.digits.push(Digit { value: 0, below });
        }
        self.position += 1;
        self.digits[self.position - 1].value
    }
}

/// Answers from a list of numbers, reduced to what is asked; 0 when the list has ended. Any list is good, so a
/// property engine may write and shrink it freely.
#[derive(Clone, Debug)]
pub struct Tape<'a>(
    /// The numbers left.
    pub &'a [u32],
);

impl Oracle for Tape<'_> {
    fn pick(&mut self, below: u32) -> u32 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first % below
    }
}

/// The answers of a stored run again. Unlike a [`Tape`], it does not bend: an answer that does not fit the
/// question, or is missing, is remembered as a mismatch.
#[derive(Clone, Debug)]
pub struct Replay<'a> {
    answers: &'a [u32],
    asked: Vec<u32>,
    matches: bool,
}

impl<'a> Replay<'a> {
    /// Replays `answers`.
    pub const fn new(answers: &'a [u32]) -> Self {
        Self { answers, asked: Vec::new(), matches: true }
    }

    /// The questions so far: below what number each answer was to be.
    pub fn asked(&self) -> &[u32] {
        &self.asked
    }

    /// Whether every question was answered, and every answer used.
    pub const fn matches(&self) -> bool {
        self.matches && self.answers.is_empty()
    }
}

impl Oracle for Replay<'_> {
    fn pick(&mut self, below: u32) -> u32 {
        self.asked.push(below);
        match self.answers.split_first() {
            Some((&answer, rest)) if answer < below => {
                self.answers = rest;
                answer
            }
            _ => {
                self.matches = false;
                0
            }
        }
    }
}

/// Random answers, the same for the same seed and run on every machine: SplitMix64 (Steele, Lea and Flood,
/// OOPSLA 2014), its counter started by the pair.
#[derive(Clone, Debug)]
pub struct SeededOracle {
    state: u64,
}

impl SeededOracle {
    const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

    /// The answers of run number `run` under `seed`.
    pub const fn new(seed: u64, run: u64) -> Self {
        let mut start = Self { state: seed };
        Self { state: start.next().wrapping_add(run) }
    }

    const fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(Self::GOLDEN);
        let mut mixed = self.state;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }
}

impl Oracle for SeededOracle {
    fn pick(&mut self, below: u32) -> u32 {
        // The upper half of a 32 by 32 bit product is below `below`; its bias is under 2⁻³² times `below`.
        (((self.next() >> 32) * u64::from(below)) >> 32) as u32
    }
}

/// Passes questions on and keeps the answers.
struct Recorder<S> {
    oracle: S,
    choices: Vec<u32>,
}

impl<S: Oracle> Oracle for Recorder<S> {
    fn pick(&mut self, below: u32) -> u32 {
        let answer = self.oracle.pick(below);
        self.choices.push(answer);
        answer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_combination_comes_once() {
        let mut seen = Vec::new();
        let tally = exhaust(|oracle| {
            let first = oracle.pick(3);
            let second = oracle.pick(first + 1);
            assume(first != 1)?;
            seen.push((first, second));
            Ok(if first == 0 { "none" } else { "some" })
        });
        assert_eq!(seen, [(0, 0), (2, 0), (2, 1), (2, 2)]);
        assert_eq!(tally, Tally { cases: 4, given_up: 0, covered: vec!["none", "some"], violation: None });
    }

    #[test]
    fn the_first_violation_is_kept_and_replays() {
        let body = |oracle: &mut dyn Oracle| {
            let (a, b) = (oracle.pick(4), oracle.pick(4));
            require(a + b < 5, "a small sum")?;
            Ok("small")
        };
        let (choices, demand) = exhaust(body).violation.expect("4 = 2 + 3 is reached");
        assert_eq!((choices.as_slice(), demand), ([2, 3].as_slice(), "a small sum"));
        let mut replay = Replay::new(&choices);
        assert_eq!(body(&mut replay), Err(Stop::Violated("a small sum")));
        assert!(replay.matches());
        assert_eq!(body(&mut Tape(&[6, 7])), Err(Stop::Violated("a small sum")));
        assert!(sample(1000, 1, body).violation.is_some());
    }

    #[test]
    fn a_replay_notices_answers_that_do_not_fit() {
        for answers in [[7].as_slice(), &[], &[1, 1]] {
            let mut replay = Replay::new(answers);
            replay.pick(2);
            assert!(!replay.matches(), "{answers:?}");
        }
    }

    #[test]
    fn seeded_answers_are_pinned_and_in_range() {
        let mut oracle = SeededOracle::new(1, 2);
        let picked: Vec<u32> = (0..8).map(|_| oracle.pick(100)).collect();
        assert!(picked.iter().all(|&answer| answer < 100));
        let mut again = SeededOracle::new(1, 2);
        assert_eq!(picked, (0..8).map(|_| again.pick(100)).collect::<Vec<_>>());
        let mut other = SeededOracle::new(1, 3);
        assert_ne!(picked, (0..8).map(|_| other.pick(100)).collect::<Vec<_>>());
    }
}
