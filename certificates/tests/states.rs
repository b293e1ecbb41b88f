//! The checker of states by itself, over a model of a few numbers whose section is written by hand.

use std::collections::BTreeSet;
use std::hash::Hasher;

use tautline_certificates::{
    Counts, Fault, Header, Model, Refusal, Step, check_states, digest, put, read, take, write,
};
use tautline_kernel::choice::Oracle;

/// A walker on 0 to 3. From 1 it goes to 2 or back to 0, as it is asked twice; from 2 to 3, where it stays. What it
/// owes it owes below 2; two are awake, and the one with this bit makes every step.
#[derive(Clone, Copy)]
struct Walk {
    acting: u16,
    broken_step: Option<u8>,
    may_stay_in: u8,
}

const WALK: Walk = Walk { acting: 1, broken_step: None, may_stay_in: 3 };

impl Model for Walk {
    type State = u8;
    type Plan = ();

    fn starts(&self) -> Vec<u8> {
        vec![0, 2, 0]
    }

    fn plan(&self, state: &mut u8) -> Option<()> {
        (*state < 3).then_some(())
    }

    fn step(&self, &before: &u8, _: &u8, (): &(), answers: &mut impl Oracle) -> Step<u8> {
        let to = match before {
            0 => 1,
            1 if answers.pick(2) == 0 => 0,
            1 => 2 * answers.pick(2) as u8,
            _ => 3,
        };
        let breaks = (self.broken_step == Some(before)).then(|| "it".to_owned());
        Step { to, acting: Some(self.acting), breaks }
    }

    fn broken_at_end(&self, state: &u8) -> Option<String> {
        (*state != self.may_stay_in).then(|| "an end".to_owned())
    }

    fn owed(&self, state: &u8) -> u16 {
        u16::from(*state < 2)
    }

    fn awake(&self, _: &u8) -> u16 {
        0b11
    }

    fn tell(&self, state: &u8, _: usize, to: &mut impl Hasher) {
        to.write_u8(*state);
    }
}

/// The section: what is owed; the starts, of which two are new; and the states 0, 1, 2, 3, each with its steps, where
/// they lead, and its rank.
const SECTION: [u64; 18] = [1, 3, 0, 0, 1, 1, 0, 0, 3, 2, 2, 3, 0, 1, 0, 0, 0, 0];

fn section(numbers: &[u64]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for &number in numbers {
        put(&mut bytes, number);
    }
    bytes
}

fn with(changes: &[(usize, u64)]) -> Vec<u8> {
    let mut numbers = SECTION;
    for &(place, number) in changes {
        numbers[place] = number;
    }
    section(&numbers)
}

fn checked(model: Walk, section: &[u8]) -> Result<Counts, Refusal> {
    check_states(&model, section, 7)
}

#[test]
fn all_states_are_accepted() {
    assert_eq!(checked(WALK, &with(&[])), Ok(Counts { states: 4, steps: 5, ends: 1 }));
}

#[test]
fn what_is_not_so_is_refused_where_it_is_not() {
    let cases = [
        (vec![(4, 3)], Refusal::Start(2)),
        (vec![(4, 2)], Refusal::Leads(0, 0)),
        (vec![(9, 1)], Refusal::Leads(1, 0)),
        (vec![(11, 5)], Refusal::Leads(1, 2)),
        (vec![(11, 1 << 40)], Refusal::Leads(1, 2)),
        (vec![(7, 1)], Refusal::Rises(1, 0)),
        (vec![(7, 9)], Refusal::Malformed(18)),
        (vec![(2, 1)], Refusal::Malformed(13)),
    ];
    for (changes, refusal) in cases {
        assert_eq!(checked(WALK, &with(&changes)), Err(refusal), "{changes:?}");
    }
    assert_eq!(
        checked(Walk { broken_step: Some(2), ..WALK }, &with(&[])),
        Err(Refusal::Breaks(2, 0, "it".into()))
    );
    assert_eq!(checked(Walk { may_stay_in: 9, ..WALK }, &with(&[])), Err(Refusal::Ends(3, "an end".into())));
    assert_eq!(checked(Walk { acting: 0b11, ..WALK }, &with(&[])), Err(Refusal::Endless(0, 0)));
}

#[test]
fn a_state_that_is_counted_twice_is_refused() {
    // The state 2 as a start, and once more where a step leads to it.
    let numbers = [1, 3, 0, 0, 1, 1, 0, 0, 3, 2, 2, 0, 0, 1, 0, 0, 0, 0, 1, 2, 0];
    assert_eq!(checked(WALK, &section(&numbers)), Err(Refusal::Twice(4)));
}

#[test]
fn a_section_without_a_state_a_step_or_a_rank_is_refused() {
    let without = |from: usize, to: usize| {
        let numbers: Vec<u64> = [&SECTION[..from], &SECTION[to..]].concat();
        section(&numbers)
    };
    // Without the state 3, to which a step would lead; and without that step, too.
    assert_eq!(checked(WALK, &without(16, 18)), Err(Refusal::Malformed(16)));
    let numbers = [&SECTION[..13], &[0, 0]].concat();
    assert_eq!(checked(WALK, &section(&numbers)), Err(Refusal::Steps(2, 1)));
    let unranked = [0, 3, 0, 0, 1, 1, 0, 3, 2, 2, 3, 1, 0, 0];
    assert_eq!(checked(WALK, &section(&unranked)), Err(Refusal::Owes(0)));
    assert_eq!(checked(WALK, &[]), Err(Refusal::Malformed(0)));
    // A rank is one of as many as there are states.
    assert_eq!(checked(WALK, &with(&[(17, 3)])), Ok(Counts { states: 4, steps: 5, ends: 1 }));
    assert_eq!(checked(WALK, &with(&[(17, 4)])), Err(Refusal::Malformed(18)));
    let fewer = [&[1, 2], &SECTION[2..4], &SECTION[5..]].concat();
    assert_eq!(checked(WALK, &section(&fewer)), Err(Refusal::Starts(3)));
    // A million starts, and more states than there are atoms, of which none is there.
    assert_eq!(checked(WALK, &section(&[1, 1_000_000])), Err(Refusal::Malformed(4)));
    assert_eq!(checked(WALK, &section(&[1, u64::MAX, 0])), Err(Refusal::Malformed(12)));
}

/// A system in which nothing begins.
struct Nothing;

impl Model for Nothing {
    type State = u8;
    type Plan = ();

    fn starts(&self) -> Vec<u8> {
        Vec::new()
    }

    fn plan(&self, _: &mut u8) -> Option<()> {
        None
    }

    fn step(&self, &to: &u8, _: &u8, (): &(), _: &mut impl Oracle) -> Step<u8> {
        Step { to, acting: None, breaks: None }
    }

    fn broken_at_end(&self, _: &u8) -> Option<String> {
        None
    }

    fn owed(&self, _: &u8) -> u16 {
        0
    }

    fn awake(&self, _: &u8) -> u16 {
        0
    }

    fn tell(&self, state: &u8, _: usize, to: &mut impl Hasher) {
        to.write_u8(*state);
    }
}

#[test]
fn a_system_without_a_start_is_refused() {
    assert!(check_states(&Nothing, &section(&[0, 0]), 7).is_err());
    assert_eq!(check_states(&Nothing, &section(&[0, 1, 0, 0]), 7), Err(Refusal::Starts(0)));
}

#[test]
fn a_number_comes_back_and_has_one_form() {
    for number in [0, 1, 0x7f, 0x80, 0x3fff, 0x4000, u64::MAX >> 1, u64::MAX] {
        let bytes = section(&[number, 5]);
        let mut rest = &bytes[..];
        assert_eq!((take(&mut rest), take(&mut rest), take(&mut rest)), (Some(number), Some(5), None));
    }
    let most = section(&[u64::MAX]);
    let above = [&most[..9], &[2]].concat();
    let eleven = [&most[..9], &[0x81, 1]].concat();
    for mut bytes in [&[][..], &[0x80], &[0x80, 0], &[0xff, 0x80, 0], &above, &eleven] {
        assert_eq!(take(&mut bytes), None, "{bytes:?}");
    }
}

#[test]
fn every_refusal_has_words_of_its_own() {
    let (demand, answers) = (|| "a demand".to_owned(), || vec![1, 0]);
    let refusals = [
        Refusal::Malformed(4),
        Refusal::Starts(4),
        Refusal::Start(4),
        Refusal::Steps(4, 4),
        Refusal::Leads(4, 4),
        Refusal::Breaks(4, 4, demand()),
        Refusal::Ends(4, demand()),
        Refusal::Twice(4),
        Refusal::Owes(4),
        Refusal::Rises(4, 4),
        Refusal::Endless(4, 4),
        Refusal::Broken(answers(), demand()),
        Refusal::Long(answers()),
        Refusal::Runs(4, 4, 4),
        Refusal::Longest(4),
    ];
    let faults = [Fault::Foreign, Fault::Damaged, Fault::Line(4, "claim"), Fault::Sections];
    let words = refusals.iter().map(ToString::to_string).chain(faults.iter().map(ToString::to_string));
    let words: BTreeSet<String> = words.filter(|words| words.len() > 20).collect();
    assert_eq!(words.len(), refusals.len() + faults.len(), "{words:?}");
}

#[test]
fn counts_of_sections_are_added() {
    let counts = |states, steps, ends| Counts { states, steps, ends };
    assert_eq!(counts(3, 5, 7).with(counts(10, 20, 30)), counts(13, 25, 37));
}

fn header() -> Header {
    let words = |text: &str| text.to_owned();
    let (program, clause, rule) = (words("walks 1"), words("WALK-1"), words("a rule"));
    Header { program, clause, check: 2, rule, claim: 3 << 99, states: 1_000_000 }
}

#[test]
fn a_file_comes_back_and_each_changed_or_missing_byte_is_found() {
    let bytes = write(&header(), &[section(&SECTION), Vec::new(), section(&[1])]);
    let file = read(&bytes).expect("a file");
    assert_eq!((file.header, file.sections.len(), file.sections[0]), (header(), 3, &section(&SECTION)[..]));
    for place in 0..bytes.len() {
        for bit in 0..8 {
            let mut changed = bytes.clone();
            changed[place] ^= 1 << bit;
            assert!(read(&changed).is_err(), "byte {place}, bit {bit}");
        }
        assert!(read(&bytes[..place]).is_err(), "{place} bytes");
    }
}

#[test]
fn a_header_that_is_none_and_sections_without_an_end_are_told_although_the_digest_is_right() {
    let bytes = write(&header(), &[section(&SECTION)]);
    let content = String::from_utf8_lossy(&bytes[..bytes.len() - 16]).into_owned();
    let fault = |text: &str| {
        let mut bytes = text.as_bytes().to_vec();
        let digest = digest(&bytes);
        bytes.extend(digest.to_le_bytes());
        read(&bytes).expect_err("it is no certificate")
    };
    assert_eq!(fault(&content.replace("rule a rule", "role a rule")), Fault::Line(5, "rule"));
    for other in ["check two", "check +2", "check 02"] {
        assert_eq!(fault(&content.replace("check 2", other)), Fault::Line(4, "check"));
    }
    assert_eq!(fault(&content.replace("claim 0", "claim ")), Fault::Line(6, "claim"));
    assert_eq!(fault(&content.replace("claim 0", "claim +")), Fault::Line(6, "claim"));
    assert_eq!(fault(&content.to_uppercase().replace("CLAIM", "claim")), Fault::Foreign);
    for other in ["states +1", "states 01"] {
        assert_eq!(fault(&content.replace("states 1", other)), Fault::Line(7, "states"));
    }
    assert_eq!(fault(&content.replace("states 1000000\n", &"9".repeat(2000))), Fault::Line(7, "states"));
    assert_eq!(fault(&(content.clone() + "\u{7f}")), Fault::Sections);
    assert_eq!(fault(&content.replace("certificate 1", "certificate 2")), Fault::Foreign);
    assert_eq!(read(b"\x7fELF").expect_err("no certificate"), Fault::Foreign);
}
