//! The checker of runs by itself, over a model whose runs can be counted by hand.

use std::collections::HashSet;
use std::ops::ControlFlow;

use tautline_certificates::{Counts, Ready, Refusal, Runs, check_runs, put};
use tautline_kernel::choice::Oracle;

use crate::drawn;

/// The end of a run, behind the last door.
#[derive(Clone, Copy, PartialEq)]
enum Behind {
    Stops,
    Waits,
    /// Waits, and breaks a demand by it.
    Breaks,
}

/// A robot that passes doors one after the other, and asks at each whether it is closed. It notes each in its log.
#[derive(Clone, Copy)]
struct Corridor {
    doors: usize,
    most_closed: u32,
    /// A closed door after which so many were passed breaks the demand.
    broken_at: Option<usize>,
    /// So many closed doors break it at the end.
    broken_by: u32,
    behind: Behind,
    longest_run: u32,
}

const CORRIDOR: Corridor = Corridor {
    doors: 12,
    most_closed: 2,
    broken_at: None,
    broken_by: 9,
    behind: Behind::Stops,
    longest_run: 100,
};

impl Runs for Corridor {
    /// Doors that were passed, and how many of them were closed.
    type State = (usize, u32);
    type Plan = usize;

    fn start(&self) -> (usize, u32) {
        (0, 0)
    }

    fn most_mishaps(&self) -> u32 {
        self.most_closed
    }

    fn longest_run(&self) -> u32 {
        self.longest_run
    }

    fn plan(&self, (passed, _): &mut (usize, u32), log: &[u8]) -> Option<usize> {
        assert_eq!(*passed, log.len(), "the log is that of the run");
        (*passed < self.doors || self.behind != Behind::Stops).then_some(*passed)
    }

    fn step(
        &self,
        ready: &Ready<(usize, u32), usize>,
        (passed, closed): &mut (usize, u32),
        log: &mut Vec<u8>,
        answers: &mut impl Oracle,
    ) -> Option<String> {
        assert_eq!(
            (ready.planned, ready.plan),
            ((*passed, *closed), *passed),
            "the state is as it was planned"
        );
        if *passed == self.doors {
            return None;
        }
        let is_closed = answers.mishap();
        *closed += u32::from(is_closed);
        *passed += 1;
        log.push(0);
        (is_closed && self.broken_at == Some(ready.before.0)).then(|| "a door".to_owned())
    }

    fn broken_at_end(&self, (_, closed): &(usize, u32), _: &[u8]) -> Option<String> {
        (*closed >= self.broken_by).then(|| "an end".to_owned())
    }

    fn recurs(
        &self,
        then: &(usize, u32),
        sent: usize,
        now: &(usize, u32),
        _: &[u8],
    ) -> ControlFlow<Option<String>> {
        assert_eq!(sent, then.0);
        if then != now {
            return ControlFlow::Continue(());
        }
        ControlFlow::Break((self.behind == Behind::Breaks).then(|| "waiting".to_owned()))
    }
}

/// In how many ways `of` doors can be closed among so many.
fn ways(doors: u64, of: u64) -> u64 {
    (0..of).fold(1, |ways, one| ways * (doors - one) / (one + 1))
}

/// The section that says how many runs there are.
fn said(corridor: Corridor) -> Vec<u64> {
    let doors = corridor.doors as u64;
    let level = |closed| {
        let steps: u64 =
            (1..=doors).filter(|passed| *passed >= closed).map(|passed| ways(passed, closed)).sum();
        [ways(doors, closed), steps]
    };
    let levels = (0..=u64::from(corridor.most_closed)).flat_map(level);
    [doors].into_iter().chain(levels).collect()
}

fn checked(corridor: Corridor, numbers: &[u64]) -> Result<Counts, Refusal> {
    let mut section = Vec::new();
    for &number in numbers {
        put(&mut section, number);
    }
    check_runs(&corridor, &section)
}

#[test]
fn all_runs_are_counted_also_where_they_are_parted() {
    for (doors, most_closed) in [(1, 1), (3, 0), (3, 3), (12, 2), (14, 4), (70, 3)] {
        let corridor = Corridor { doors, most_closed, ..CORRIDOR };
        let numbers = said(corridor);
        let sum = |place: usize| numbers[1..].chunks(2).map(|level| level[place]).sum::<u64>();
        let counts = Counts { states: sum(1) + 1, steps: sum(1), ends: sum(0) };
        assert_eq!(checked(corridor, &numbers), Ok(counts), "{doors} doors");
    }
    // A mark is set 32 steps after the last closed door; with the next step the robot is back there.
    for (doors, most_closed) in [(5, 5), (12, 2), (12, 12)] {
        let waits = Corridor { doors, most_closed, behind: Behind::Waits, ..CORRIDOR };
        let doors = doors as u64;
        let level = |closed| {
            let runs = ways(doors, closed);
            [runs, runs * if closed == 0 { 33 } else { 34 }]
        };
        let levels = (0..=u64::from(most_closed)).flat_map(level);
        let numbers: Vec<u64> = [doors + 33].into_iter().chain(levels).collect();
        assert!(checked(waits, &numbers).is_ok(), "{numbers:?}: {:?}", checked(waits, &numbers));
    }
}

#[test]
fn what_is_broken_is_refused_with_the_answers_that_break_it() {
    let refusal = |corridor| checked(corridor, &said(CORRIDOR)).expect_err("it is broken");
    let answers = |ones: &[usize], length| (0..length).map(|place| ones.contains(&place).into()).collect();
    let early = Corridor { broken_at: Some(1), ..CORRIDOR };
    assert_eq!(refusal(early), Refusal::Broken(answers(&[1], 2), "a door".into()));
    let late = Corridor { broken_at: Some(11), ..CORRIDOR };
    assert_eq!(refusal(late), Refusal::Broken(answers(&[11], 12), "a door".into()));
    // Runs of few answers come before the parts; where two doors were closed, nothing is asked any more.
    let end = Corridor { broken_by: 2, ..CORRIDOR };
    assert_eq!(refusal(end), Refusal::Broken(answers(&[7, 8], 9), "an end".into()));
    let waits = Corridor { most_closed: 12, behind: Behind::Breaks, ..CORRIDOR };
    assert_eq!(refusal(waits), Refusal::Broken(answers(&[], 12), "waiting".into()));
    let long = Corridor { longest_run: 12, ..CORRIDOR };
    assert_eq!(refusal(long), Refusal::Long(answers(&[7, 8], 9)));
}

#[test]
fn each_other_number_is_refused() {
    let right = said(CORRIDOR);
    let level = |mishaps: usize| Refusal::Runs(mishaps, right[1 + 2 * mishaps], right[2 + 2 * mishaps]);
    for (place, change) in (0..right.len()).flat_map(|place| [1, u64::MAX].map(|change| (place, change))) {
        let mut numbers = right.clone();
        numbers[place] = numbers[place].wrapping_add(change);
        let mishaps = place.saturating_sub(1) / 2;
        let refusal = if place == 0 { Refusal::Longest(12) } else { level(mishaps) };
        assert_eq!(checked(CORRIDOR, &numbers), Err(refusal), "{numbers:?}");
    }
    assert_eq!(checked(CORRIDOR, &right[..6]), Err(level(2)));
    assert_eq!(checked(CORRIDOR, &[]), Err(Refusal::Longest(12)));
    assert_eq!(checked(CORRIDOR, &[&right[..], &[0]].concat()), Err(Refusal::Malformed(9)));
    assert_eq!(check_runs(&CORRIDOR, &[12, 0x80]), Err(Refusal::Malformed(2)));
    assert_eq!(check_runs(&CORRIDOR, &[12, 0x80, 0, 5, 7]), Err(Refusal::Malformed(3)));
}

/// A robot that goes round on so many cells, and picks a number or asks whether it slips in some of them.
#[derive(Clone, Copy)]
struct Circle {
    cells: u32,
    picks: bool,
    slips_from: u32,
}

impl Runs for Circle {
    type State = u32;
    type Plan = ();

    fn start(&self) -> u32 {
        0
    }

    fn most_mishaps(&self) -> u32 {
        1
    }

    fn longest_run(&self) -> u32 {
        300
    }

    fn plan(&self, _: &mut u32, _: &[u8]) -> Option<()> {
        Some(())
    }

    fn step(
        &self,
        _: &Ready<u32, ()>,
        state: &mut u32,
        _: &mut Vec<u8>,
        answers: &mut impl Oracle,
    ) -> Option<String> {
        if self.picks && *state == 0 {
            answers.pick(2);
        }
        // A slip costs it nothing but is an event.
        let _ = *state >= self.slips_from && answers.mishap();
        *state = (*state + 1) % self.cells;
        None
    }

    fn broken_at_end(&self, _: &u32, _: &[u8]) -> Option<String> {
        None
    }

    fn recurs(&self, then: &u32, _: usize, now: &u32, _: &[u8]) -> ControlFlow<Option<String>> {
        if then == now { ControlFlow::Break(None) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn a_run_is_over_where_it_comes_back_to_a_mark_of_which_there_are_ever_fewer() {
    let longest = |circle: Circle| match check_runs(&circle, &[0]) {
        Err(Refusal::Longest(steps)) => steps,
        other => panic!("{other:?}"),
    };
    let circle = Circle { cells: 20, picks: false, slips_from: u32::MAX };
    // Marks are set at 32 and 64 steps: the first one is met again by up to 31 cells, the second by more.
    for (cells, steps) in [(20, 52), (31, 63), (40, 104), (63, 127)] {
        assert_eq!(longest(Circle { cells, ..circle }), steps, "{cells} cells");
    }
    // Who picks a number in every round may come out otherwise in every round.
    let refusal = check_runs(&Circle { picks: true, ..circle }, &[0]);
    assert!(matches!(refusal, Err(Refusal::Long(_))), "{refusal:?}");
    // The tenth question, at 54 steps, parts the runs, which have the mark of 32 still. The last one is at 62: who
    // slips then sets a mark at 94.
    assert_eq!(longest(Circle { cells: 31, slips_from: 22, ..circle }), 125);
}

/// Runs whose steps are drawn from what was answered: each asks several questions, some after a mishap alone.
struct RandomRuns {
    seed: u64,
    most: u32,
}

impl RandomRuns {
    fn go(&self, state: &mut (u64, u32), answers: &mut dyn Oracle) {
        let (now, steps) = *state;
        let mut next = drawn(self.seed, now);
        for question in 0..drawn(self.seed, now + 1) % 4 {
            let answer = match drawn(now, question) % 3 {
                0 => answers.pick(3),
                _ => answers.mishap().into(),
            };
            next = drawn(next, u64::from(answer) + 1);
            if answer == 1 && next.is_multiple_of(2) {
                break;
            }
        }
        *state = (next, steps + 1);
    }
}

fn is_over((now, steps): (u64, u32)) -> bool {
    steps == 9 || drawn(now, 7).is_multiple_of(9)
}

impl Runs for RandomRuns {
    type State = (u64, u32);
    type Plan = ();

    fn start(&self) -> (u64, u32) {
        (1, 0)
    }

    fn most_mishaps(&self) -> u32 {
        self.most
    }

    fn longest_run(&self) -> u32 {
        100
    }

    fn plan(&self, state: &mut (u64, u32), _: &[u8]) -> Option<()> {
        (!is_over(*state)).then_some(())
    }

    fn step(
        &self,
        _: &Ready<(u64, u32), ()>,
        state: &mut (u64, u32),
        _: &mut Vec<u8>,
        answers: &mut impl Oracle,
    ) -> Option<String> {
        self.go(state, answers);
        None
    }

    fn broken_at_end(&self, _: &(u64, u32), _: &[u8]) -> Option<String> {
        None
    }

    fn recurs(&self, _: &(u64, u32), _: usize, _: &(u64, u32), _: &[u8]) -> ControlFlow<Option<String>> {
        ControlFlow::Continue(())
    }
}

/// Answers of a list, and then 0; at most so many mishaps.
struct AnswerList {
    given: Vec<(u32, u32)>,
    asked: usize,
    mishaps: u32,
    most: u32,
}

impl Oracle for AnswerList {
    fn pick(&mut self, below: u32) -> u32 {
        if self.asked == self.given.len() {
            self.given.push((0, below));
        }
        self.asked += 1;
        self.given[self.asked - 1].0
    }

    fn mishap(&mut self) -> bool {
        let is_one = self.mishaps < self.most && self.pick(2) == 1;
        self.mishaps += u32::from(is_one);
        is_one
    }
}

/// The section of these runs: each is made from the start, and steps are told apart by their number and all answers
/// up to their end.
fn counted(drawn: &RandomRuns) -> Vec<u64> {
    let (mut longest, mut levels) = (0, vec![[0, 0]; drawn.most as usize + 1]);
    let (mut given, mut steps) = (Vec::new(), HashSet::new());
    loop {
        let (mut state, mut listed) =
            (drawn.start(), AnswerList { given, asked: 0, mishaps: 0, most: drawn.most });
        while !is_over(state) {
            drawn.go(&mut state, &mut listed);
            if steps.insert((state.1, listed.given[..listed.asked].to_vec())) {
                levels[listed.mishaps as usize][1] += 1;
            }
        }
        levels[listed.mishaps as usize][0] += 1;
        longest = longest.max(state.1.into());
        given = listed.given;
        while given.pop_if(|(answer, below)| *answer + 1 == *below).is_some() {}
        let Some((answer, _)) = given.last_mut() else { break };
        *answer += 1;
    }
    [longest].into_iter().chain(levels.into_iter().flatten()).collect()
}

#[test]
fn runs_of_drawn_systems_are_counted_as_one_by_one() {
    let mut parted = 0;
    for seed in 0..24 {
        let drawn = RandomRuns { seed, most: seed as u32 % 4 };
        let mut section = Vec::new();
        let numbers = counted(&drawn);
        for &number in &numbers {
            put(&mut section, number);
        }
        let counts = check_runs(&drawn, &section);
        assert!(counts.is_ok(), "{seed}: {counts:?} {numbers:?}");
        parted += u32::from(counts.is_ok_and(|counts| counts.ends > 2_000));
    }
    assert!(parted > 2, "{parted} systems have many runs");
}
