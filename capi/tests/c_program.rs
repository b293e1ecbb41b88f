//! A program in C explores 15×15 cells with the static library, and the header is as cbindgen writes it now.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use cbindgen::{Builder, Config, DocumentationStyle, EnumConfig, Language, RenameRule, Style};

fn here(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// A header: its name, the headers and the sources that it is made of, and its first words.
struct Header {
    name: &'static str,
    includes: &'static [&'static str],
    sources: &'static [&'static str],
    about: &'static str,
}

const HEADERS: [Header; 2] = [
    Header {
        name: "tautline.h",
        includes: &[],
        sources: &["src/status.rs", "src/chain.rs"],
        about: "/* Tautline's chain of robots for programs in C: see docs/embed.md. \
                Written by cbindgen; a test\n   compares it. */",
    },
    Header {
        name: "tautline_monitor.h",
        includes: &["tautline.h"],
        sources: &["src/monitor.rs"],
        about: "/* Tautline's monitors of robots for programs in C: see docs/monitor.md. \
                Written by cbindgen; a test\n   compares it. */",
    },
];

impl Header {
    /// The header of the sources, without what a caller in C does not need to be told about Rust.
    fn made(&self) -> String {
        let config = Config {
            language: Language::C,
            header: Some(self.about.to_owned()),
            no_includes: true,
            sys_includes: vec!["stddef.h".to_owned(), "stdint.h".to_owned()],
            includes: self.includes.iter().map(|&name| name.to_owned()).collect(),
            include_guard: Some(self.name.to_uppercase().replace('.', "_")),
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
        let begun = Builder::new().with_config(config);
        let builder = self.sources.iter().fold(begun, |builder, source| builder.with_src(here(source)));
        let mut text = Vec::new();
        builder.generate().expect("a header").write(&mut text);
        String::from_utf8(text).expect("text")
    }
}

/// Renewed by `TAUTLINE_RENEW=1 cargo test -p tautline-capi`.
#[test]
fn the_headers_are_those_of_the_sources() {
    for header in HEADERS {
        let (made, path) = (header.made(), here("include").join(header.name));
        if env::var_os("TAUTLINE_RENEW").is_some() {
            fs::write(&path, &made).expect("the header is written");
        }
        let kept = fs::read_to_string(&path).expect("a header");
        assert_eq!(kept, made, "write it again: TAUTLINE_RENEW=1 cargo test -p tautline-capi");
    }
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

/// Compiles a program of `tests` with the static library, and returns what it printed; nothing without a compiler.
fn printed(program: &str) -> Option<String> {
    let compiler = env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    if Command::new(&compiler).arg("--version").output().is_err() {
        println!("there is no C compiler {compiler} here: {program}.c was not tried");
        return None;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let built = folder.path().join(program);
    let made = Command::new(&compiler)
        .args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-I"])
        .arg(here("include"))
        .arg(here("tests").join(program).with_extension("c"))
        .arg(library())
        .args(["-lpthread", "-ldl", "-lm", "-o"])
        .arg(&built)
        .output()
        .expect("the compiler runs");
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let output = Command::new(&built).output().expect("the program runs");
    let (said, errors) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{:?} {said}{errors}", output.status.code());
    Some(said.into_owned())
}

/// Holds a page to what a program printed.
fn shows(page: &str, said: &str) {
    let text = fs::read_to_string(here("../docs").join(page)).expect("the page");
    assert!(text.contains(&format!("```text\n{said}```\n")), "docs/{page} shows something else, not\n{said}");
}

#[test]
fn a_program_in_c_explores_15x15_cells_in_62_team_moves() {
    let Some(said) = printed("explore") else { return };
    assert!(said.starts_with("62 team moves, 8 robots,"), "{said}");
    shows("embed.md", &said);
}

#[test]
fn a_program_in_c_watches_robots_and_sees_each_breach() {
    let Some(said) = printed("watch") else { return };
    assert_eq!(said.matches(" broken by ").count(), 4, "{said}");
    shows("monitor.md", &said);
}
