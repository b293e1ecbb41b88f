//! The checker of states by itself, over drawn systems whose sections are made here, and whose fair runs are looked for
//! by closure.

use std::hash::Hasher;

use tautline_certificates::{Counts, Model, Refusal, Step, check_states, put};
use tautline_kernel::choice::Oracle;

use crate::drawn;

/// A system of so many states, in which three robots are awake or act by chance.
struct Drawn {
    seed: u64,
    states: u32,
    /// Whether two obligations are owed in drawn states, and most steps lead to near ones, so that runs come round.
    owes: bool,
}

/// The obligations.
const OWED: [u32; 2] = [0, 2];

impl Drawn {
    fn number(&self, state: u32, what: u64) -> u64 {
        drawn(self.seed + 1, u64::from(state) << 8 | what)
    }

    /// The step with these answers, and who acts in it.
    fn to(&self, state: u32, answers: [u32; 2]) -> (u32, Option<u16>) {
        let place = u64::from(2 * answers[0] + answers[1]);
        let far = !self.owes || self.number(state, place).is_multiple_of(4);
        let way = self.number(state, 16 + place) % if far { u64::from(self.states) } else { 3 };
        let acting = self.number(state, 32 + place) % 9;
        ((state + way as u32) % self.states, (acting < 8).then_some(acting as u16))
    }

    /// The answers that may be given in `state`, in their order.
    fn answers(&self, state: u32) -> Vec<[u32; 2]> {
        let of = self.number(state, 64) % 3;
        let second = |first| if first == 1 { 0..2 } else { 0..1 };
        (0..of as u32).flat_map(|first| second(first).map(move |second| [first, second])).collect()
    }

    fn steps(&self, state: u32) -> Vec<(u32, Option<u16>)> {
        self.answers(state).into_iter().map(|answers| self.to(state, answers)).collect()
    }
}

/// The place of a part, and its value by the number of the state.
type Part = (usize, fn(u32) -> u32);

/// Parts by which a state is told, of which some come behind the 64th.
const PARTS: [Part; 3] = [(0, |state| state % 4), (3, |state| state / 4), (66, |state| state % 3)];

impl Model for Drawn {
    type State = u32;
    type Plan = u32;

    fn starts(&self) -> Vec<u32> {
        vec![0, 1 % self.states, 0]
    }

    fn plan(&self, state: &mut u32) -> Option<u32> {
        let of = self.number(*state, 64) % 3;
        (of > 0).then_some(of as u32)
    }

    fn step(&self, &before: &u32, _: &u32, of: &u32, answers: &mut impl Oracle) -> Step<u32> {
        let first = answers.pick(*of);
        let second = first == 1 && answers.mishap();
        let (to, acting) = self.to(before, [first, second.into()]);
        Step { to, acting, breaks: None }
    }

    fn broken_at_end(&self, _: &u32) -> Option<String> {
        None
    }

    fn owed(&self, &state: &u32) -> u16 {
        let owed = OWED.map(|bit| {
            u16::from(self.owes && !self.number(state, 65 + u64::from(bit)).is_multiple_of(4)) << bit
        });
        owed[0] | owed[1]
    }

    fn awake(&self, &state: &u32) -> u16 {
        (self.number(state, 70) % 8) as u16
    }

    fn parts(&self, _: &u32) -> usize {
        70
    }

    fn differing(&self, one: &u32, other: &u32) -> u64 {
        let differs = |&&(place, value): &&Part| place < 64 && value(*one) != value(*other);
        PARTS.iter().filter(differs).map(|(place, _)| 1 << place).sum()
    }

    fn tell(&self, state: &u32, part: usize, to: &mut impl Hasher) {
        to.write_u32(PARTS.iter().find(|&&(place, _)| place == part).map_or(0, |(_, value)| value(*state)));
    }
}

/// The states of a system as its section lists them, and what is so of them.
struct Listed {
    order: Vec<u32>,
    /// The numbers of the section, and whether each is a rank.
    numbers: Vec<(u64, bool)>,
    counts: Counts,
    /// The lowest rank and the obligation that a weakly fair run can owe for ever.
    endless: Option<Refusal>,
}

impl Listed {
    fn of(system: &Drawn) -> Self {
        let mut order = Vec::new();
        let mut links = vec![Vec::new(); system.states as usize];
        let mut seen = vec![false; system.states as usize];
        let starts = system.starts();
        let is_root: Vec<bool> =
            starts.iter().map(|&start| !std::mem::replace(&mut seen[start as usize], true)).collect();
        let mut ahead: Vec<u32> = starts
            .iter()
            .zip(&is_root)
            .filter(|(_, is_root)| **is_root)
            .map(|(&start, _)| start)
            .rev()
            .collect();
        while let Some(state) = ahead.pop() {
            order.push(state);
            let steps = system.steps(state);
            let new = steps.iter().map(|&(to, _)| !std::mem::replace(&mut seen[to as usize], true));
            links[state as usize] = new.collect();
            let children = steps.iter().zip(&links[state as usize]).filter(|(_, is_new)| **is_new);
            ahead.extend(children.map(|(&(to, _), _)| to).rev());
        }
        let mut place = vec![0; system.states as usize];
        for (at, &state) in (0_i64..).zip(&order) {
            place[state as usize] = at;
        }
        let owed = if system.owes { OWED.iter().map(|bit| 1_u64 << bit).sum() } else { 0 };
        let ranks: Vec<Vec<usize>> =
            OWED.iter().filter(|_| system.owes).map(|&bit| ranks(system, &order, bit)).collect();
        let mut numbers = vec![(owed, false), (starts.len() as u64, false)];
        for (&start, &is_root) in starts.iter().zip(&is_root) {
            numbers.push((if is_root { 0 } else { place[start as usize] as u64 + 1 }, false));
        }
        let mut counts = Counts { states: order.len() as u64, ..Counts::default() };
        for (at, &state) in (0_i64..).zip(&order) {
            let steps = system.steps(state);
            numbers.push((steps.len() as u64, false));
            for (&(to, _), &is_new) in steps.iter().zip(&links[state as usize]) {
                let way = place[to as usize] - at;
                numbers.push((if is_new { 0 } else { 1 + (way << 1 ^ way >> 63) as u64 }, false));
            }
            numbers.extend(ranks.iter().map(|ranks| (ranks[at as usize] as u64, true)));
            counts.steps += steps.len() as u64;
            counts.ends += u64::from(steps.iter().all(|(_, acting)| acting.is_none()));
        }
        let fair = OWED.iter().zip(&ranks).filter_map(|(&bit, ranks)| {
            let rank = (0..order.len()).find(|&rank| is_fair(system, &order, ranks, rank, bit))?;
            Some(Refusal::Endless(rank as u32, bit))
        });
        let endless = fair.into_iter().next();
        Self { order, numbers, counts, endless }
    }

    fn section(numbers: impl Iterator<Item = u64>) -> Vec<u8> {
        let mut section = Vec::new();
        numbers.for_each(|number| put(&mut section, number));
        section
    }

    fn checked(&self, system: &Drawn) -> Result<Counts, Refusal> {
        check_states(
            system,
            &Self::section(self.numbers.iter().map(|&(number, _)| number)),
            self.order.len() as u128,
        )
    }
}

/// Where steps lead that are bound to be made, and between states that owe this.
fn bound(system: &Drawn, state: u32, bit: u32) -> impl Iterator<Item = (u32, u16)> {
    let owes = move |state: u32| system.owed(&state) >> bit & 1 == 1;
    let steps = system.steps(state).into_iter().filter_map(|(to, acting)| Some((to, acting?)));
    steps.filter(move |&(to, _)| owes(state) && owes(to))
}

/// A rank for each set of states that lead to one another, lower ones behind.
fn ranks(system: &Drawn, order: &[u32], bit: u32) -> Vec<usize> {
    let mut reached: Vec<Vec<bool>> = vec![vec![false; system.states as usize]; system.states as usize];
    for &state in order {
        reached[state as usize][state as usize] = true;
        bound(system, state, bit).for_each(|(to, _)| reached[state as usize][to as usize] = true);
    }
    for &by in order {
        for &from in order {
            if reached[from as usize][by as usize] {
                let behind = reached[by as usize].clone();
                reached[from as usize].iter_mut().zip(behind).for_each(|(is, also)| *is |= also);
            }
        }
    }
    let first = |state: u32| {
        let both = |&&other: &&u32| {
            reached[state as usize][other as usize] && reached[other as usize][state as usize]
        };
        order.iter().find(both).copied()
    };
    let class = |&state: &u32| (reached[state as usize].iter().filter(|is| **is).count(), first(state));
    let mut classes: Vec<_> = order.iter().map(class).collect();
    classes.sort_unstable();
    classes.dedup();
    order.iter().map(|state| classes.binary_search(&class(state)).expect("it is one of them")).collect()
}

/// Whether a run that goes round in all states of this rank for ever leaves nobody out who is always awake there.
fn is_fair(system: &Drawn, order: &[u32], ranks: &[usize], rank: usize, bit: u32) -> bool {
    let within: Vec<u32> =
        order.iter().zip(ranks).filter(|&(_, &other)| other == rank).map(|(&state, _)| state).collect();
    let steps =
        |state: u32| bound(system, state, bit).filter(|(to, _)| within.contains(to)).collect::<Vec<_>>();
    let acting = within.iter().flat_map(|&state| steps(state)).fold(0, |all, (_, acting)| all | acting);
    let mut ways = within.iter().filter(|&&state| !steps(state).is_empty()).peekable();
    ways.peek().is_some() && ways.fold(u16::MAX, |awake, state| awake & system.awake(state)) & !acting == 0
}

#[test]
fn drawn_systems_are_accepted_unless_a_fair_run_owes_something_for_ever() {
    let mut verdicts = [0; 2];
    for seed in 0..400 {
        let system = Drawn { seed, states: 1 + seed as u32 % 14, owes: true };
        let listed = Listed::of(&system);
        let expected = listed.endless.clone().map_or(Ok(listed.counts), Err);
        assert_eq!(listed.checked(&system), expected, "{seed}");
        verdicts[usize::from(expected.is_ok())] += 1;
    }
    assert!(verdicts.into_iter().min() >= Some(60), "{verdicts:?}");
}

#[test]
fn no_other_number_is_accepted_and_no_ranks_hide_a_fair_run() {
    for seed in 0..60 {
        let system = Drawn { seed, states: 2 + seed as u32 % 9, owes: true };
        let listed = Listed::of(&system);
        for (place, change) in
            (1..listed.numbers.len()).flat_map(|place| [1, 2, u64::MAX].map(|change| (place, change)))
        {
            let (number, is_rank) = listed.numbers[place];
            if is_rank && listed.endless.is_none() {
                continue;
            }
            let other = |(at, &(number, _)): (usize, &(u64, bool))| {
                number.wrapping_add(if at == place { change } else { 0 })
            };
            let section = Listed::section(listed.numbers.iter().enumerate().map(other));
            let checked = check_states(&system, &section, 5);
            assert!(checked.is_err(), "{seed}: {number} in place {place}: {checked:?}");
        }
    }
}

#[test]
fn many_states_are_looked_at_by_several_threads() {
    let systems = (0..40).map(|seed| Drawn { seed, states: 20_000, owes: false });
    let (system, listed) = systems
        .map(|system| (Listed::of(&system), system))
        .find_map(|(listed, system)| (listed.order.len() > 5_000).then_some((system, listed)))
        .expect("some have many states");
    assert_eq!(listed.checked(&system), Ok(listed.counts));
}
