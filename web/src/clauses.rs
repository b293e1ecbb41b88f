//! The sentences of the clauses that a run can break. They stand in a text of their own, since the ledger, which has
//! them, would bring every check of every clause into the page.

use crate::own;

/// A line for each clause: its id, a tabulator, its sentence.
const SENTENCES: &str = include_str!("clauses.txt");

/// The sentence of a clause; none if it is not one of ours.
pub(crate) fn sentence(id: &str) -> &'static str {
    let ours = SENTENCES.lines().filter_map(|line| line.split_once('\t'));
    let own = own::page().into_iter().flat_map(|page| page.sentences.iter().copied());
    own.chain(ours).find(|&(known, _)| known == id).map_or("", |(_, sentence)| sentence)
}
