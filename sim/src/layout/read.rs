//! Files as text or bytes, and the faults of what is wrong with them.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use tautline_proofs::plural::counted;

use super::problem::sizes;
use super::{Misread, Problem};
use crate::diagnostic::Diagnostic;

/// Larger files are refused before they are read. The drawing of the largest layout is smaller.
pub const MAX_FILE_BYTES: u64 = 128 << 20;

/// The text of `file`.
pub(super) fn read_text(file: &Path) -> Result<String, Diagnostic> {
    let bytes = read_bytes(file).map_err(|problem| in_file(file, &problem))?;
    let not_text = |byte| {
        in_file(
            file,
            &Problem::new(
                format!("byte {byte} is not UTF-8 text"),
                "a layout is a drawing, a MovingAI map or a ROS map's .yaml file",
            ),
        )
    };
    String::from_utf8(bytes).map_err(|error| not_text(error.utf8_error().valid_up_to()))
}

/// The bytes of `file`, at least one and at most [`MAX_FILE_BYTES`].
pub(super) fn read_bytes(file: &Path) -> Result<Vec<u8>, Problem> {
    let about = fs::metadata(file).map_err(|error| unreadable(&error))?;
    if about.is_dir() {
        return Err(Problem::no_file("this is a directory"));
    }
    if about.len() > MAX_FILE_BYTES {
        return Err(too_large());
    }
    let mut bytes = Vec::new();
    let opened = File::open(file).map_err(|error| unreadable(&error))?;
    opened.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes).map_err(|error| unreadable(&error))?;
    match bytes.len() as u64 {
        0 => Err(Problem::new("the file is empty", "a drawing begins with `tautline layout 1`")),
        size @ 1..=MAX_FILE_BYTES => {
            tracing::info!("read {}: {}", file.display(), counted(size, "byte"));
            Ok(bytes)
        }
        _ => Err(too_large()),
    }
}

fn too_large() -> Problem {
    Problem::new(format!("the file has more than {} MiB", MAX_FILE_BYTES >> 20), sizes())
}

fn unreadable(error: &io::Error) -> Problem {
    match error.kind() {
        io::ErrorKind::NotFound => Problem::no_file("there is no such file"),
        _ => Problem::new(format!("the file cannot be read: {error}"), "make the file readable"),
    }
}

/// The fault of a problem in a text.
pub(super) fn at(file: &Path, source: &str, misread: &Misread) -> Diagnostic {
    Diagnostic::at(file, source, misread.at.clone(), &misread.problem, misread.problem.remedy())
}

/// The fault of a problem with a file as a whole.
pub(super) fn in_file(file: &Path, problem: &Problem) -> Diagnostic {
    Diagnostic::in_file(file, problem, problem.remedy())
}
