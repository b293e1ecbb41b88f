//! Certificates of checks that search all states or all layouts.

use std::collections::{HashSet, VecDeque};
use std::time::Instant;

use rayon::{ThreadPool, ThreadPoolBuilder};
use tautline_certificates::{Counts, File, Header, Refusal, check_states, put, read, write};
use tautline_kernel::mrc::Rule;
use tautline_proofs::clause::Clause;
use tautline_proofs::decide::{Method, Verdict};
use tautline_proofs::engine::model::StatesModel;
use tautline_proofs::engine::states::{self, AnySystem, Limits, NoCertificate, System};
use tautline_proofs::ledger::{Misfit, certificate, clauses, examine};
use tautline_proofs::mrc::space::{Space, Until};
use tautline_proofs::mrc::{Demand, Faults, Leases, LossKind, RobotReading, Setting};

/// Holds a verdict against the certificates of what `method` searches for `rule`: if it holds there is one of each
/// system, which is accepted, and if it is refuted there is none of some.
pub(crate) fn certify<R>(method: &impl Method<R>, rule: &R, verdict: Verdict) {
    if verdict == Verdict::Open {
        return;
    }
    let systems = method.systems(rule).expect("systems");
    let sections: Vec<_> = systems.iter().map(|system| system.exhausted(Limits::NONE)).collect();
    match verdict {
        Verdict::Holds => {
            for (system, section) in systems.iter().zip(sections) {
                let (section, states) = section.expect("a section");
                assert_eq!(system.check(&section, 7).map(|counts| counts.states), Ok(states));
            }
        }
        _ => assert!(sections.contains(&Err(NoCertificate::Broken))),
    }
}

fn clause(id: &str) -> &'static Clause {
    clauses().find(|clause| clause.id == id).expect("a clause")
}

fn pool(threads: usize) -> ThreadPool {
    ThreadPoolBuilder::new().num_threads(threads).build().expect("threads")
}

fn examined(bytes: &[u8]) -> Result<Counts, (usize, Refusal)> {
    examine(bytes, clauses()).expect("a certificate").outcome
}

/// A check that holds, with the states of its systems: without endless runs, with them in many small systems, in one
/// whose runs have ranks, and of a search over layouts.
const ROWS: [(&str, usize, u64); 4] =
    [("KIT-5", 0, 940), ("BRICKS-6", 9, 84_382), ("MRC-5", 2, 11_640), ("CHAIN-14", 1, 4_595)];

#[test]
fn a_certificate_has_the_same_bytes_and_is_accepted_on_any_number_of_threads() {
    for (id, number, states) in ROWS {
        let clause = clause(id);
        let [one, two] = [1, 2].map(|threads| {
            pool(threads).install(|| certificate(clause, number, Limits::NONE)).expect("a certificate")
        });
        assert!(one == two, "{id}");
        let outcomes =
            [1, 2, 7].map(|threads| pool(threads).install(|| examined(&one)).expect("it is accepted"));
        assert!(
            outcomes.iter().all(|counts| *counts == outcomes[0] && counts.states == states),
            "{outcomes:?}"
        );
    }
}

/// The numbers of a section.
fn numbers(section: &[u8]) -> Vec<u64> {
    let each = section.split_inclusive(|byte| *byte < 0x80);
    each.map(|bytes| bytes.iter().rev().fold(0, |number, byte| number << 7 | u64::from(byte & 0x7f)))
        .collect()
}

fn section(numbers: &[u64]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for &number in numbers {
        put(&mut bytes, number);
    }
    bytes
}

/// The header and the only section of the certificate of a check.
fn opened(id: &str, number: usize) -> (Header, Vec<u64>) {
    let bytes = certificate(clause(id), number, Limits::NONE).expect("a certificate");
    let File { header, sections, .. } = read(&bytes).expect("a certificate");
    assert_eq!(sections.len(), 1);
    (header, numbers(sections[0]))
}

#[test]
fn each_of_a_thousand_changed_bytes_is_refused_and_with_the_digest_made_anew_too_unless_it_is_another_certificate()
 {
    for (id, number, _) in ROWS {
        let bytes = certificate(clause(id), number, Limits::NONE).expect("a certificate");
        for change in 0..1_000 {
            let mut changed = bytes.clone();
            let place = change * 7_919 % bytes.len();
            changed[place] ^= 1 << (change % 8);
            assert!(matches!(examine(&changed, clauses()), Err(Misfit::File(_))), "{id}, byte {place}");
        }
    }
    for (id, number, changes) in [("KIT-5", 0, 1_000), ("CHAIN-14", 1, 40)] {
        let (header, whole) = opened(id, number);
        let (bytes, mut refused) = (section(&whole), 0);
        for change in 0..changes {
            let mut changed = bytes.clone();
            let place = change * 7_919 % bytes.len();
            changed[place] ^= 1 << (change % 8);
            match examine(&write(&header, &[changed]), clauses()) {
                Ok(examined) => refused += usize::from(examined.outcome.is_err()),
                Err(_) => refused += 1,
            }
        }
        assert_eq!(refused, changes, "{id}");
    }
}

/// Of a section its states: where each begins among its numbers, and where the links end.
fn states(numbers: &[u64]) -> Vec<(usize, usize)> {
    let ranks = numbers[0].count_ones() as usize;
    let (mut next, mut states) = (2 + numbers[1] as usize, Vec::new());
    while next < numbers.len() {
        let end = next + 1 + numbers[next] as usize;
        states.push((next, end));
        next = end + ranks;
    }
    states
}

/// The parent of the last of these states, as the section has its trees.
fn parent_of_last(numbers: &[u64], states: &[(usize, usize)]) -> usize {
    let (mut open, mut parent): (Vec<(usize, usize)>, usize) = (Vec::new(), 0);
    for (place, &(begin, end)) in states.iter().enumerate() {
        if let Some((above, left)) = open.last_mut() {
            (parent, *left) = (*above, *left - 1);
        }
        open.push((place, numbers[begin + 1..end].iter().filter(|&&link| link == 0).count()));
        while open.pop_if(|(_, left)| *left == 0).is_some() {}
    }
    parent
}

#[test]
fn a_state_left_out_a_wrong_rank_and_a_wrong_start_are_refused_by_what_they_are() {
    let check = |header: &Header, numbers: &[u64]| {
        examine(&write(header, &[section(numbers)]), clauses())
            .expect("a certificate")
            .outcome
            .map_err(|found| found.1)
    };
    for (id, number) in [("KIT-5", 1), ("MRC-5", 2)] {
        let (mut header, numbers) = opened(id, number);
        let all = states(&numbers);
        assert_eq!((all.len() as u64, check(&header, &numbers).is_ok()), (header.states, true));
        // The last state, a leaf: the step to it is said to lead to its parent instead.
        let parent = parent_of_last(&numbers, &all);
        let (begin, end) = all[parent];
        let link = begin + 1 + numbers[begin + 1..end].iter().rposition(|&link| link == 0).expect("a child");
        let mut without = numbers.clone();
        without[link] = 1;
        without.truncate(all.last().expect("states").0);
        header.states -= 1;
        let refusal = check(&header, &without).expect_err("a state is missing");
        assert!(matches!(refusal, Refusal::Leads(..)), "{id}: {refusal}");
        header.states += 1;
        let mut other = numbers.clone();
        other[3] = 1;
        assert!(check(&header, &other).is_err(), "{id}");
    }
    let (header, numbers) = opened("MRC-5", 2);
    assert!(numbers[0] != 0, "there are ranks");
    let all = states(&numbers);
    let ranked = |change: &dyn Fn(usize, u64) -> u64| {
        let mut numbers = numbers.clone();
        for (place, &(_, end)) in all.iter().enumerate() {
            let of_state = end..end + numbers[0].count_ones() as usize;
            numbers[of_state].iter_mut().for_each(|rank| *rank = change(place, *rank));
        }
        check(&header, &numbers)
    };
    assert!(ranked(&|_, rank| rank).is_ok());
    assert!(matches!(ranked(&|_, _| 0), Err(Refusal::Endless(0, _))));
    let most = numbers.len() as u64;
    assert!(matches!(ranked(&|_, rank| rank + most), Err(Refusal::Malformed(_))));
    let last = all.len() - 1;
    let risen =
        (0..=last).rev().find_map(|state| ranked(&|place, rank| rank + u64::from(place == state)).err());
    assert!(matches!(risen, Some(Refusal::Rises(..) | Refusal::Endless(..))), "{risen:?}");
}

/// Two robots and a WFR that calls twice, with any one fault.
const PUBLISHED: Setting = Setting {
    rule: Rule::PUBLISHED,
    misread: None,
    reading: RobotReading::PUBLISHED,
    robots: 2,
    wfrs: 1,
    events: 2,
    max_hops: 2,
    faults: Faults::any(1),
    lossy: LossKind::All,
    leases: Leases::UntilCalled,
};

#[test]
fn a_demand_that_is_broken_is_not_shown_by_the_states_of_one_that_holds() {
    let setting = PUBLISHED;
    let started = |setting, demand| StatesModel {
        system: Space { setting, until: Until::Broken(demand) },
        starts: |space: &Space| space.setting.starts(),
        is_asked: |space, demand| space.until == Until::Broken(demand),
    };
    let (section, _) = started(setting, Demand::AsksNearest).exhausted(Limits::NONE).expect("it holds");
    let checked = |setting, demand| check_states(&started(setting, demand), &section, 1);
    assert!(checked(setting, Demand::AsksNearest).is_ok());
    assert!(matches!(checked(setting, Demand::OneRobotForACall), Err(Refusal::Breaks(..))));
    assert!(matches!(checked(setting, Demand::IsServed), Err(Refusal::Owes(..))));
    let repaired = Setting { rule: Rule::REPAIRED, ..setting };
    assert!(matches!(checked(repaired, Demand::AsksNearest), Err(Refusal::Leads(..) | Refusal::Steps(..))));
    let refusal = started(setting, Demand::OneRobotForACall).exhausted(Limits::NONE);
    assert_eq!(refusal.expect_err("it is broken").to_string(), "its search finds something broken");
}

/// The search and the checker look up again those parts alone that are said to differ.
#[test]
fn a_step_of_mrc_changes_no_part_that_it_is_not_said_to_change() {
    let (mut unsaid, mut changed) = (0, 0);
    for (rule, lossy, leases) in [
        (Rule::PUBLISHED, LossKind::All, Leases::UntilCalled),
        (Rule::REPAIRED, LossKind::All, Leases::Any),
        (Rule::REPAIRED, LossKind::Resb, Leases::UntilOver),
    ] {
        let setting = Setting { rule, wfrs: 2, lossy, leases, ..PUBLISHED };
        let space = Space { setting, until: Until::Exhausted };
        let parts =
            |state: &_| (0..space.places(state)).map(|place| space.part(state, place)).collect::<Vec<_>>();
        let mut starts = setting.starts();
        for state in &mut starts {
            space.make_canonical(state);
        }
        let (mut known, mut ahead) = (HashSet::new(), VecDeque::from(starts));
        while let Some(state) = ahead.pop_front() {
            let before = parts(&state);
            for mut step in states::steps(&space, &state) {
                space.make_canonical(&mut step.state);
                let (after, said) = (parts(&step.state), space.differing(&state, &step.state));
                for (place, (one, other)) in before.iter().zip(&after).enumerate() {
                    let is_said = said >> place & 1 == 1;
                    assert!(is_said || one == other, "{:?}: place {place} of {state:?}", step.event);
                    unsaid += u32::from(!is_said);
                    changed += u32::from(one != other);
                }
                if known.len() < 3_000 && known.insert(after) {
                    ahead.push_back(step.state);
                }
            }
        }
    }
    assert!(changed > 10_000 && unsaid > changed, "{changed} parts changed, {unsaid} were not looked up");
}

#[test]
fn a_certificate_of_another_clause_check_rule_or_program_says_so() {
    let (header, numbers) = opened("KIT-5", 0);
    let sections = [section(&numbers)];
    let mismatch = |change: &dyn Fn(&mut Header)| {
        let mut header = header.clone();
        change(&mut header);
        examine(&write(&header, &sections), clauses()).expect_err("it is another's").to_string()
    };
    let said = [
        mismatch(&|header| header.program = "tautline 0.0.9".to_owned()),
        mismatch(&|header| header.clause = "KIT-99".to_owned()),
        mismatch(&|header| header.check = 17),
        mismatch(&|header| header.check = 1),
        mismatch(&|header| header.claim ^= 1),
        mismatch(&|header| header.states = 1_000_000),
    ];
    insta::assert_snapshot!(said.join("\n").replace(env!("CARGO_PKG_VERSION"), "VERSION"), @r#"
    it is a certificate of "tautline 0.0.9", and this is tautline VERSION
    it is a certificate of the clause "KIT-99", which is not known here
    it is a certificate of check 17 of KIT-5, which it has not
    it is a certificate of the rule "published", and the check is about "repaired"
    it claims something else than the check: its sentence, bound or engine differs
    it has not as many states, or sections, as it should
    "#);
    let empty = Header { states: 1_000_000, ..header };
    let none = examine(&write(&empty, &[]), clauses()).expect_err("no states").to_string();
    assert_eq!(none, "it has not as many states, or sections, as it should");
}

/// Robots at frontier cells are searched in areas of which some have no room for them.
#[test]
fn the_certificate_of_every_small_search_of_frontier_cells_is_accepted() {
    let limits = Limits { most_steps: 2_000, ..Limits::NONE };
    let mut accepted = Vec::new();
    for clause in clauses().filter(|clause| clause.id.starts_with("FRONTIER-")) {
        for (number, check) in (0..).zip(clause.checks) {
            if check.engine() != "states" || check.expected() != Verdict::Holds {
                continue;
            }
            // A larger search is cut off.
            let Ok(file) = certificate(clause, number, limits) else { continue };
            let row = format!("{} {number}", clause.id);
            assert!(examined(&file).is_ok(), "{row}: {:?}", examined(&file));
            accepted.push(row);
        }
    }
    assert!(accepted.len() > 3, "{accepted:?}");
}

/// The processor time of this process in seconds; 0 where that cannot be had.
fn processor_s() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace().skip(11).take(2);
    fields.filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>() / 100.0
}

/// One row per check that holds and searches all states or layouts: states, bytes of the file, bytes a state; seconds
/// of processor time of the search and of the checker on one thread, and seconds that pass while two threads search and
/// while they check. `TAUTLINE_CERTIFICATES` names some of the clauses.
#[test]
#[ignore = "takes minutes: cargo test -p tautline-proofs --test all -- --ignored --nocapture certificates_of_all"]
fn certificates_of_all_rows_are_accepted_in_less_time_than_the_search_takes() {
    let wanted = std::env::var("TAUTLINE_CERTIFICATES").unwrap_or_default();
    let mut all = [0.0; 4];
    for clause in clauses().filter(|clause| wanted.is_empty() || wanted.split(',').any(|id| id == clause.id))
    {
        for (number, check) in (0..).zip(clause.checks) {
            if !["search", "states"].contains(&check.engine()) || check.expected() != Verdict::Holds {
                continue;
            }
            let search = || {
                for system in check.systems().expect("systems") {
                    system.search(Limits::NONE);
                }
            };
            let file = certificate(clause, number, Limits::NONE).expect("a certificate");
            let one = examined(&file).expect("it is accepted");
            let again = || assert_eq!(examined(&file), Ok(one));
            let alone = |work: &(dyn Fn() + Sync)| {
                let begun = processor_s();
                pool(1).install(work);
                processor_s() - begun
            };
            let by_two = |work: &(dyn Fn() + Sync)| {
                let begun = Instant::now();
                pool(2).install(work);
                begun.elapsed().as_secs_f64()
            };
            let seconds = [alone(&search), alone(&again), by_two(&search), by_two(&again)];
            let (id, rule, states, bytes) = (clause.id, check.rule(), one.states, file.len() as u64);
            let each = bytes / states;
            println!("{id:11} {rule:10} {states:>8} {bytes:>9} {each:>5} {seconds:>7.2?}");
            all.iter_mut().zip(seconds).for_each(|(all, seconds)| *all += seconds);
        }
    }
    println!("all: {all:.1?}");
}
