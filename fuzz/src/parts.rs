//! Parts of several bodies.

use tautline_io::diagnostic::Diagnostic;

use super::report;

/// The bytes as the numbers of a tape.
pub(super) fn numbers(bytes: &[u8]) -> Vec<u32> {
    bytes.iter().copied().map(u32::from).collect()
}

/// A fault can be told in a line, and as a person sees it.
pub(super) fn told(fault: &Diagnostic) {
    let line = fault.to_string();
    assert!(!line.is_empty() && !line.contains('\n'), "{line}");
    assert!(!report::render(fault, report::Colour::Plain).is_empty());
}
