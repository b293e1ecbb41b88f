//! How the files begin that this program writes, by which it knows them again.

use std::fs::File;
use std::io::Read;
use std::path::Path;

/// How the files begin that this program writes: stored runs and kept hunts, certificates, pictures, pages, manual
/// pages, ITF traces, recordings, tables, maps of ROS, files that Rocq checks.
const OURS: [&[u8]; 11] = [
    b"{\"format\":\"tautline ",
    b"tautline certificate ",
    SVG_HEAD.as_bytes(),
    HTML_HEAD.as_bytes(),
    MAN_HEAD.as_bytes(),
    ITF_HEAD.as_bytes(),
    MCAP_HEAD,
    CSV_HEAD.as_bytes(),
    ROS_HEADS[0].as_bytes(),
    ROS_HEADS[1].as_bytes(),
    ROCQ_HEAD.as_bytes(),
];

/// How the files among them begin that keep work for later.
const KEPT_WORK: [&[u8]; 2] = [b"{\"format\":\"tautline hunt\"", b"{\"format\":\"tautline shard\""];

/// The beginning of a picture.
pub const SVG_HEAD: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" data-generator=\"tautline\" ";

/// The beginning of a page.
pub const HTML_HEAD: &str = "<!doctype html>
<html lang=\"en\">
<head>
<meta charset=\"utf-8\">
<meta name=\"generator\" content=\"tautline\">
";

/// The beginning of a trace for the viewers of model checkers.
pub const ITF_HEAD: &str = "{\"#meta\":{\"source\":\"tautline\",";

/// The profile in the first record of a recording.
pub const MCAP_PROFILE: &str = "ros2";
/// The library in the first record of a recording.
pub const MCAP_LIBRARY: &str = "tautline";

/// The beginning of a recording: what all begin with, a header record of 20 bytes, its profile and its library.
const MCAP_HEAD: &[u8] = b"\x89MCAP0\r\n\x01\x14\0\0\0\0\0\0\0\x04\0\0\0ros2\x08\0\0\0tautline";

/// The beginning of a table as comma-separated values: its first columns.
pub const CSV_HEAD: &str = "schema_version,id,list,";

/// The beginnings of a map of ROS: of its description, and of its image.
pub const ROS_HEADS: [&str; 2] = ["# Written by tautline.\n", "P5\n# tautline\n"];

/// The beginning of a manual page: a comment.
pub const MAN_HEAD: &str = ".\\\" Written by tautline.\n";

/// The beginning of a certificate of a local rule, a file that Rocq checks.
const ROCQ_HEAD: &str = "From Coq Require Import ZArith NArith List.
From Tautline Require Import Certificate.
Import ListNotations.
Local Open Scope Z_scope.

Definition rule_ : rule := {|
";

/// Why the file is not replaced, unless it is empty or begins as the files of this program do that can be made again.
pub(super) fn worth(file: &Path) -> Option<&'static str> {
    let longest = OURS.iter().chain(&KEPT_WORK).map(|head| head.len()).max().unwrap_or(0);
    let mut bytes = Vec::new();
    let read = File::open(file).and_then(|file| file.take(longest as u64).read_to_end(&mut bytes));
    let begins = |heads: &[&[u8]]| heads.iter().any(|head| bytes.starts_with(head));
    if read.is_err() || !bytes.is_empty() && !begins(&OURS) {
        return Some("tautline did not write this file, and does not overwrite it");
    }
    begins(&KEPT_WORK).then_some("work is kept in this file, and is not overwritten")
}
