//! Runs that break a clause, as files that anyone can replay.

use std::path::{Path, PathBuf};

use crate::atomic_file::{AtomicFile, Replaceable};
use crate::diagnostic::{Diagnostic, Halt};
use crate::explore::{ClauseId, Report, Setup, explore};
use crate::trace;

/// The place in `folder` of a run of `setup` that breaks `clause`. The scheme is in its name unless the clause tells
/// it.
pub fn path(folder: &Path, setup: &Setup, clause: ClauseId) -> PathBuf {
    let clause = clause.as_str().to_lowercase();
    let Setup { scheme, rule, robots, .. } = setup;
    let is_told = clause.rsplit_once('-').is_some_and(|(family, _)| family == scheme.name);
    let scheme = if is_told { String::new() } else { format!("-{}", scheme.name) };
    folder.join(format!("{clause}{scheme}-{rule}-n{robots}.jsonl"))
}

/// Writes the run of `setup`, which breaks `clause`, to a file in `folder` under a name that says so. The file has yet
/// to be put in its place.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme.
pub fn store(
    folder: &Path,
    setup: &Setup,
    clause: ClauseId,
    replaceable: &Replaceable,
) -> Result<(AtomicFile, Report), Halt> {
    store_at(&path(folder, setup, clause), setup, clause, replaceable)
}

/// The same with another name.
///
/// # Errors
/// [`Halt`] if the setup does not fit its scheme.
pub fn store_at(
    path: &Path,
    setup: &Setup,
    clause: ClauseId,
    replaceable: &Replaceable,
) -> Result<(AtomicFile, Report), Halt> {
    let aside = AtomicFile::late(path, replaceable);
    let mut writer = trace::Writer::new(aside, setup, Some(clause)).map_err(Diagnostic::from)?;
    let report = explore(setup, &mut |made| {
        writer.add(made);
        Ok(())
    })?;
    Ok((writer.end(&report), report))
}

#[cfg(test)]
mod tests {
    use tautline_kernel::ground::Cell;

    use super::*;
    use crate::explore::RuleName;
    use crate::explore::bricks::{BRICKS, BRICKS_ANTS};
    use crate::explore::chain::CHAIN;
    use crate::layout::Layout;

    #[test]
    fn runs_of_two_schemes_have_two_names() {
        let name = |scheme, clause: &'static str| {
            let layout = Layout::open(3, 3).expect("a layout");
            let setup = Setup::new(scheme, RuleName::Repaired, 2, layout, Cell::new(1, 1));
            path(Path::new("a"), &setup, ClauseId::new(clause)).display().to_string()
        };
        assert_eq!(name(&CHAIN, "CHAIN-13"), "a/chain-13-repaired-n2.jsonl");
        assert_eq!(name(&BRICKS, "BRICKS-4"), "a/bricks-4-repaired-n2.jsonl");
        assert_eq!(name(&BRICKS_ANTS, "BRICKS-4"), "a/bricks-4-bricks-ants-repaired-n2.jsonl");
    }
}
