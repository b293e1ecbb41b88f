//! A program in C explores 15×15 cells with the static library, and the header is as cbindgen writes it now.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use cbindgen::{Builder, Config, DocumentationStyle, EnumConfig, Language, RenameRule, Style};

const HEADER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/include/tautline.h");

fn here(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// The header of the sources, without what a caller in C does not need to be told about Rust.
fn header() -> String {
    let preamble = "/* Tautline's chain of robots for programs in C: see docs/embed.md. Written by cbindgen; a test\n   compares it. */";
    let config = Config {
        language: Language::C,
        header: Some(preamble.to_owned()),
        no_includes: true,
        sys_includes: vec!["stddef.h".to_owned(), "stdint.h".to_owned()],
        include_guard: Some("TAUTLINE_H".to_owned()),
        cpp_compat: true,
        documentation_style: DocumentationStyle::C,
        style: Style::Type,
        usize_is_size_t: true,
        line_length: 110,
        enumeration: EnumConfig {
            rename_variants: RenameRule::QualifiedScreamingSnakeCase,
            ..EnumConfig::default()
        },
        ..Config::default()
    };
    let builder =
        Builder::new().with_config(config).with_src(here("src/status.rs")).with_src(here("src/chain.rs"));
    let mut text = Vec::new();
    builder.generate().expect("a header").write(&mut text);
    String::from_utf8(text).expect("text")
}

/// Renewed by `TAUTLINE_RENEW=1 cargo test -p tautline-capi`.
#[test]
fn the_header_is_that_of_the_sources() {
    let made = header();
    if env::var_os("TAUTLINE_RENEW").is_some() {
        fs::write(HEADER, &made).expect("the header is written");
    }
    let kept = fs::read_to_string(HEADER).expect("a header");
    assert_eq!(kept, made, "write it again: TAUTLINE_RENEW=1 cargo test -p tautline-capi");
}

/// The static library that was built with this test.
fn library() -> PathBuf {
    let folder = env::current_exe().expect("a program").parent().expect("a folder").to_owned();
    let is_ours = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        name.starts_with("libtautline_capi") && path.extension().is_some_and(|end| end == "a")
    };
    let files = fs::read_dir(&folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let newest =
        files.filter(is_ours).max_by_key(|path| path.metadata().and_then(|data| data.modified()).ok());
    newest.unwrap_or_else(|| panic!("there is no static library in {}", folder.display()))
}

#[test]
fn a_program_in_c_explores_15x15_cells_in_62_team_moves() {
    let compiler = env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    if Command::new(&compiler).arg("--version").output().is_err() {
        println!("there is no C compiler {compiler} here: the program in C was not tried");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let program = folder.path().join("explore");
    let made = Command::new(&compiler)
        .args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-I"])
        .arg(here("include"))
        .arg(here("tests/explore.c"))
        .arg(library())
        .args(["-lpthread", "-ldl", "-lm", "-o"])
        .arg(&program)
        .output()
        .expect("the compiler runs");
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let output = Command::new(&program).output().expect("the program runs");
    let (said, errors) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{:?} {said}{errors}", output.status.code());
    assert!(said.starts_with("62 team moves, 8 robots,"), "{said}");
    let page = fs::read_to_string(here("../docs/embed.md")).expect("the page");
    assert!(
        page.contains(&format!("```text\n{said}```\n")),
        "docs/embed.md shows something else, not\n{said}"
    );
}
