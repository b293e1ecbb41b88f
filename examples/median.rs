//! A rule of one step: a robot takes the median of three ranges for the true one, as one of them may be wrong. Every
//! reading of a coarse scale is looked at, any tape of numbers is a test, and its Kani harnesses take all answers at
//! once.

use tautline_kernel::choice::Oracle;
use tautline_proofs::clause::{AnyCheck, NamedRule};
use tautline_proofs::decide::{Cache, MethodError};
use tautline_proofs::engine::tree::unwatched;
use tautline_proofs::engine::{Outcome, require};
use tautline_proofs::step_checks;

/// A way to make one range of three.
type Merge = fn([u32; 3]) -> u32;

fn median(mut ranges: [u32; 3]) -> u32 {
    ranges.sort_unstable();
    ranges[1]
}

fn mean(ranges: [u32; 3]) -> u32 {
    ranges.iter().sum::<u32>() / 3
}

fn largest([one, other, third]: [u32; 3]) -> u32 {
    one.max(other).max(third)
}

/// Readings of a range.
const READINGS: u32 = 10;

fn readings() -> String {
    format!("{READINGS} ranges, any reading of any one of three anchors")
}

/// One of three anchors says anything; the others tell the truth.
fn one_may_be_wrong(merge: &Merge, oracle: &mut dyn Oracle) -> Outcome {
    let truth = oracle.pick(READINGS);
    let (liar, said) = (oracle.pick(3), oracle.pick(READINGS));
    let mut ranges = [truth; 3];
    ranges[liar as usize] = said;
    require(merge(ranges) == truth, "what two of three anchors say is believed")?;
    Ok(if said == truth { "all are right" } else { "one is wrong" })
}

step_checks! { Merge;
    believes_two_of_three: one_may_be_wrong, NamedRule::new("the median", median as Merge), readings,
        covers ["all are right", "one is wrong"], unwind 4, mutants {
            the_mean: "the mean" => mean as Merge,
            the_largest: "the largest" => largest as Merge,
        };
}

fn main() -> Result<(), MethodError> {
    let check = &believes_two_of_three::CHECK;
    let decision = check.decide(&mut Cache::default(), &mut unwatched)?;
    println!(
        "{check:?}: {}, {} cases",
        decision.verdict.word(),
        decision.cases,
        check = check as &dyn AnyCheck
    );
    println!("rejected: {}", decision.killed.join(", "));
    Ok(())
}
