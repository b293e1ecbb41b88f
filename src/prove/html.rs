//! All verdicts as a page: what is decided, what it rests on, and each counterexample beside it, which plays.

use std::collections::BTreeMap;

use tautline_io::atomic_file::HTML_HEAD;
use tautline_io::diagnostic::Halt;
use tautline_proofs::ledger::{Row, title};
use tautline_sim::draw::page::film::{json, shared, without_shared};

use super::row::Ledger;
use crate::evidence;

const TEMPLATE: &str = include_str!("report.html");

/// The page about `rows`, of which `ledger` tells.
pub(super) fn report(rows: &[Row], ledger: &Ledger) -> Result<String, Halt> {
    let titles: BTreeMap<&str, &str> =
        rows.iter().map(|row| row.clause.scheme()).map(|scheme| (scheme, title(scheme))).collect();
    let pages = rows.iter().map(page).collect::<Result<Vec<_>, Halt>>()?;
    let beyond: Vec<Vec<String>> = rows.iter().map(|row| row.beyond(rows)).collect();
    let [style, script] = shared();
    let parts = [
        ("{{titles}}", json(&titles)),
        ("{{ledger}}", json(ledger)),
        ("{{beyond}}", json(&beyond)),
        ("{{style}}", json(&style)),
        ("{{script}}", json(&script)),
        // Last, since pages have marks, too.
        ("{{pages}}", json(&pages)),
    ];
    let filled = |text: String, (mark, part): (&str, String)| text.replacen(mark, &part, 1);
    Ok(parts.into_iter().fold(HTML_HEAD.to_owned() + TEMPLATE, filled))
}

/// The page of the counterexample of a row, without what all pages share; none if there is no counterexample.
fn page(row: &Row) -> Result<Option<String>, Halt> {
    let Some(found) = &row.decision.counterexample else { return Ok(None) };
    let mut page = String::new();
    evidence::page(row.clause, row.check, found, &mut page)?;
    Ok(Some(without_shared(&page)))
}
