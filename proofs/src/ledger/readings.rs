//! Rows under the readings of a paper: which of them a check refutes, which it does not, and what a repair adds to
//! these.

use std::fmt::Write;
use std::ptr;

use super::Row;
use crate::clause::Variant;
use crate::decide::{Evidence, Verdict};

/// Readings that are named whatever comes out under them.
const FEW: usize = 4;

/// A reading, and the verdict under it.
type ReadingVerdict = (&'static str, Verdict);

/// Whether nothing refutes the sentence.
const fn stands(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::Holds | Verdict::Unrefuted)
}

impl Row {
    /// The readings other than that of the rule itself, in their order.
    fn others(&self) -> impl Iterator<Item = &'static str> {
        self.check.variants().into_iter().filter_map(Variant::reading).map(|(name, _)| name)
    }

    /// The verdict under each reading, that of the rule itself first.
    fn read(&self) -> impl Iterator<Item = ReadingVerdict> {
        let verdicts = self.decision.readings.iter().map(|answer| answer.verdict);
        [(self.check.rule(), self.decision.verdict)].into_iter().chain(self.others().zip(verdicts))
    }

    /// Under which readings of the rule it is refuted, and under which it is not; `None` if there is one alone. Of more
    /// than a few those of the most frequent verdict are not named, and no others that one interpretation sets apart.
    pub(super) fn readings(&self) -> Option<String> {
        let all: Vec<ReadingVerdict> = self.read().collect();
        let of = all.len();
        let with = |is: &dyn Fn(Verdict) -> bool| -> Vec<&'static str> {
            all.iter().filter(|one| is(one.1)).map(|one| one.0).collect()
        };
        let kinds = [Verdict::Refuted, Verdict::Holds, Verdict::Unrefuted, Verdict::Open];
        let most = kinds.into_iter().max_by_key(|&verdict| with(&|one| one == verdict).len());
        let groups = kinds.map(|verdict| {
            let (names, others) = (with(&|one| one == verdict), with(&|one| one != verdict));
            let dividing = self.check.paper().and_then(|paper| paper.dividing(&names, &others));
            let short = match dividing {
                _ if of <= FEW => None,
                _ if Some(verdict) == most => Some("the others".to_owned()),
                Some(one) => Some(format!("those with {}", one.name)),
                None => None,
            };
            (verdict, names, short)
        });
        let [(_, refuted, short), others @ ..] = &groups;
        let charitable = self.most_charitable();
        let named = |name: &&'static str| match charitable {
            Some((most, evidence)) if most == *name => {
                format!("{name} (the most charitable, {})", evidence.size())
            }
            Some(_) | None => (*name).to_owned(),
        };
        let count = match refuted.len() {
            0 => "refuted under no reading".to_owned(),
            1 => format!("refuted under one of {of} readings"),
            all if all == of => format!("refuted under all {of} readings"),
            some => format!("refuted under {some} of {of} readings"),
        };
        let head = match (short, charitable) {
            _ if refuted.is_empty() => count,
            (Some(short), Some((name, evidence))) => {
                let which = if Some(Verdict::Refuted) == most { "" } else { &format!(", {short}") };
                format!("{count}{which}, the most charitable {name} ({})", evidence.size())
            }
            _ => format!("{count}: {}", refuted.iter().map(named).collect::<Vec<_>>().join(", ")),
        };
        let others =
            others.iter().filter(|(_, names, _)| !names.is_empty()).map(|(verdict, names, short)| {
                format!("{} under {}", verdict.word(), short.clone().unwrap_or_else(|| names.join(", ")))
            });
        let words = [head].into_iter().chain(others).collect::<Vec<_>>().join("; ");
        (of > 1).then_some(words)
    }

    /// The most charitable reading that is refuted, of equals the first, with its counterexample.
    fn most_charitable(&self) -> Option<(&'static str, &Evidence)> {
        let paper = self.check.paper()?;
        let others = self.others().zip(&self.decision.readings);
        let others = others.filter_map(|(name, answer)| Some((name, answer.counterexample.as_ref()?)));
        let own = self.decision.counterexample.as_ref().map(|evidence| (self.check.rule(), evidence));
        let most = |best: (_, _), one: (_, _)| {
            if paper.charity(one.0) > paper.charity(best.0) { one } else { best }
        };
        own.into_iter().chain(others).reduce(most)
    }

    /// The row before this one that has the paper's readings of its clause, if this one is the first after it that is
    /// about this repair.
    fn published<'a>(&self, rows: &'a [Self]) -> Option<&'a Self> {
        let place =
            rows.iter().position(|row| row.clause.id == self.clause.id && row.number == self.number)?;
        let before = rows[..place].iter().rev().take_while(|row| row.clause.id == self.clause.id);
        let paper = before.clone().find(|row| row.check.paper().is_some())?;
        let is_first = before
            .take_while(|row| row.number != paper.number)
            .all(|row| row.check.rule() != self.check.rule());
        let is_repair = paper.check.paper()?.repairs.contains(&self.check.rule());
        (is_first && is_repair).then_some(paper)
    }

    /// Under which readings of the paper the sentence of a repair's row holds without the repair, and which sentences
    /// the repair adds: those of `rows` that hold of it, and that all these readings break.
    pub(super) fn credit(&self, rows: &[Self]) -> Option<String> {
        let paper = self.published(rows)?;
        let mut holding: Vec<&str> = paper.read().filter(|one| stands(one.1)).map(|one| one.0).collect();
        let mut words = match holding.as_slice() {
            [] => return None,
            [own, ..] if *own == paper.check.rule() => {
                holding.truncate(1);
                "holds as published, too".to_owned()
            }
            others if others.len() <= FEW => format!("holds as published under {}", others.join(", ")),
            others => format!("holds as published under {} readings", others.len()),
        };
        if !stands(self.decision.verdict) {
            return Some(words + "; our repair does not");
        }
        let is_broken = |row: &Self, name: &&str| {
            row.read().any(|(other, verdict)| other == *name && verdict == Verdict::Refuted)
        };
        let is_of = |other: &Self| match (paper.check.paper(), other.check.paper()) {
            (Some(one), Some(other)) => ptr::eq(one, other),
            _ => false,
        };
        let adds = |row: &&Self| {
            let of = row.published(rows).filter(|of| is_of(of));
            let is_kept = row.check.rule() == self.check.rule() && stands(row.decision.verdict);
            is_kept && of.is_some_and(|of| holding.iter().all(|name| is_broken(of, name)))
        };
        let mut added: Vec<&str> = rows.iter().filter(adds).map(|row| row.clause.id).collect();
        added.dedup();
        if !added.is_empty() {
            let _ = write!(words, "; our repair adds {}", added.join(", "));
        }
        Some(words)
    }
}
