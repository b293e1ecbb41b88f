//! Checks that were decided, and what has kept others from it.

use tautline_io::diagnostic::Halt;
use tautline_proofs::engine::states::MemoryLimit;
use tautline_proofs::ledger::Row;
use tautline_proofs::plural::counted;

use super::row::{of_variants, story};
use crate::findings::{Case, Outcome};

/// Why a search was cut off, if one was.
fn cut_off(memory: &MemoryLimit) -> Option<String> {
    if let Some(fault) = memory.fault() {
        return Some(format!("A search over states could not go on in its folder: {fault}\n"));
    }
    let or_spill = if memory.has_folder() { "" } else { "; or give it a folder with --spill" };
    memory.was_too_small().then(|| {
        format!(
            "A search over states would have taken more than {} KiB: its check \
             is open, or its mutant was not rejected.\n\
             Give more with --memory: one search gets three quarters of it{or_spill}.\n",
            memory.most() >> 10
        )
    })
}

/// Whether a step of the check, or of one of its variants, did not end.
pub(super) fn is_undecided(row: &Row) -> bool {
    row.undecided.is_some()
}

/// The checks that were decided, and in which memory.
pub(crate) struct DecidedRows<'a> {
    pub(crate) rows: &'a [Row],
    pub(crate) memory: &'a MemoryLimit,
    /// Checks that were not, since a signal ended the work.
    pub(crate) left: usize,
}

/// The line about checks that a signal has left, and about all that there are.
fn not_decided(left: usize, of: usize) -> String {
    let (are, them) = if left == 1 { ("is", "it") } else { ("are", "them") };
    let of = counted(of, "check");
    format!("A signal ended the work: {left} of {of} {are} not decided, and nothing is claimed of {them}.\n")
}

impl DecidedRows<'_> {
    /// The checks that a signal has left; nothing if there are none.
    fn interrupted(&self) -> Option<String> {
        (self.left > 0).then(|| not_decided(self.left, self.left + self.rows.len()))
    }

    /// Which rows were cut off, and what can be done about it; nothing if none were.
    pub(super) fn unfinished(&self) -> String {
        let mut text = cut_off(self.memory).unwrap_or_default();
        if self.rows.iter().any(is_undecided) {
            text += "A step did not end, so its check is open, or its mutant was not rejected: the code under test \
                     loops, or it needs more time: give more with --patience.\n";
        }
        text + &self.interrupted().unwrap_or_default()
    }

    /// The rows as a CI shows them.
    pub(super) fn findings(&self) -> Result<Vec<Case>, Halt> {
        let cut_off = cut_off(self.memory);
        let found = self.rows.iter().map(|row| {
            let Row { clause, check, ref decision, seconds, .. } = *row;
            let (verdict, registered) = (decision.verdict.word(), check.expected().word());
            let variants = of_variants(row).into_iter().map(|words| words + "\n");
            let outcome = match (row.is_as_registered(), row.undecided, &cut_off) {
                (true, ..) => Outcome::Expected,
                (false, Some(undecided), _) => Outcome::Unfinished(format!("{undecided}\n")),
                (false, None, Some(why)) => Outcome::Unfinished(why.clone()),
                (false, None, None) => Outcome::Broken(
                    format!("{verdict}, registered as {registered}"),
                    variants.collect::<String>() + story(row, None)?.trim_start(),
                ),
            };
            Ok(Case {
                class: clause.scheme().to_owned(),
                name: format!("{} as {}, {}: {}", clause.id, check.rule(), check.engine(), check.bound()),
                outcome,
                seconds: Some(seconds),
            })
        });
        found.chain(self.interrupted().map(|why| Ok(Case::left(why)))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_check_that_is_left_is_told_as_one() {
        let told = [not_decided(1, 1), not_decided(1, 2), not_decided(2, 2)].concat();
        insta::assert_snapshot!(told, @r"
        A signal ended the work: 1 of 1 check is not decided, and nothing is claimed of it.
        A signal ended the work: 1 of 2 checks is not decided, and nothing is claimed of it.
        A signal ended the work: 2 of 2 checks are not decided, and nothing is claimed of them.
        ");
    }
}
