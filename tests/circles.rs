//! No file needs a file that needs it, directly or over others: within a crate, uses form no circle. A file needs the
//! one that defines what it names; one that passes a name on and does not use it needs nobody. Tests within a file may name
//! whatever they test.

use std::collections::{BTreeMap, BTreeSet};
use std::slice;

use crate::names::{Import, Names, Path};
use crate::tidy::sources;

/// The crates, by their folders.
const CRATES: [&str; 18] = [
    ".",
    "capi",
    "certificates",
    "field",
    "fuzz",
    "grids",
    "io",
    "kernel",
    "library",
    "logs",
    "monitor",
    "papers",
    "proofs",
    "python",
    "ros",
    "sim",
    "viewers",
    "web",
];

/// The files of a crate, by their modules.
type Modules = BTreeMap<Path, Names>;

/// The path from the root of the crate, if a module means one of it by `path`.
fn absolute(modules: &Modules, module: &[String], path: &[String]) -> Option<Path> {
    let (first, rest) = path.split_first()?;
    let below = |module: &[String]| Some([module, rest].concat());
    match first.as_str() {
        "crate" => below(&[]),
        "self" => below(module),
        "super" if rest.first().is_some_and(|next| next == "super") => {
            absolute(modules, module.split_last()?.1, rest)
        }
        "super" => below(module.split_last()?.1),
        _ if modules.contains_key(&[module, &path[..1]].concat()) => Some([module, path].concat()),
        name => {
            let import = modules[module].imports.iter().find(|import| import.name == name)?;
            let path = Some(&import.path).filter(|path| path[0] != name)?;
            Some([&absolute(modules, module, path)?, rest].concat())
        }
    }
}

/// How many segments of a path from the root are those of a file.
fn file(modules: &Modules, path: &[String]) -> usize {
    (0..=path.len()).rev().find(|&length| modules.contains_key(&path[..length])).unwrap_or_default()
}

/// The module that defines what has this path from the root; none if that is a module itself, or of another crate.
fn home(modules: &Modules, path: &[String]) -> Option<Path> {
    let (module, rest) = path.split_at(file(modules, path));
    let (name, rest) = rest.split_first()?;
    let names = modules.get(module)?;
    match names.imports.iter().find(|import| import.name == *name) {
        Some(import) => {
            let passed = [&absolute(modules, module, &import.path)?, rest].concat();
            if passed == path { Some(module.to_vec()) } else { home(modules, &passed) }
        }
        None => Some(module.to_vec()).filter(|_| !names.modules.contains(name)),
    }
}

/// The paths that `path` stands for in a module: of all that a prelude passes on, those that are used.
fn passed(modules: &Modules, module: &[String], path: &[String]) -> Vec<Path> {
    let Some(prelude) = path.split_last().filter(|(last, _)| *last == "*") else {
        return vec![path.to_vec()];
    };
    let prelude = absolute(modules, module, prelude.1).unwrap_or_default();
    let file = &prelude[..file(modules, &prelude)];
    let imports = modules.get(file).map_or(&[][..], |names| &names.imports);
    let used =
        imports.iter().filter(|import| import.is_public && modules[module].words.contains(&import.name));
    used.map(|import| [&["crate".to_owned()], file, slice::from_ref(&import.name)].concat()).collect()
}

/// The arrows between files of a crate that are part of a circle.
fn circles(files: &[(String, String)]) -> Vec<String> {
    let module = |file: &str| -> Path {
        let path = file.strip_suffix(".rs").unwrap_or(file).split('/');
        path.filter(|&name| !["lib", "main"].contains(&name)).map(str::to_owned).collect()
    };
    let modules: Modules = files.iter().map(|(file, text)| (module(file), Names::of(text, false))).collect();
    let mut arrows: BTreeSet<(Path, Path, String)> = BTreeSet::new();
    for (module, names) in &modules {
        let used = |import: &&Import| !import.is_public || names.words.contains(&import.name);
        let paths = names.imports.iter().filter(used).map(|import| &import.path).chain(&names.paths);
        for path in paths.flat_map(|path| passed(&modules, module, path)) {
            let home = absolute(&modules, module, &path).and_then(|path| home(&modules, &path));
            let arrow = |home| (module.clone(), home, path[path.len() - 1].clone());
            arrows.extend(home.filter(|home| home != module).map(arrow));
        }
    }
    let mut needs: BTreeMap<&Path, BTreeSet<&Path>> = BTreeMap::new();
    for (from, to, _) in &arrows {
        needs.entry(from).or_default().insert(to);
    }
    let leads_back = |from: &Path, to: &Path| {
        let (mut reached, mut left) = (BTreeSet::from([to]), vec![to]);
        while let Some(next) = left.pop() {
            left.extend(needs.get(next).into_iter().flatten().filter(|&&file| reached.insert(file)));
        }
        reached.contains(from)
    };
    let circle = arrows.iter().filter(|(from, to, _)| leads_back(from, to));
    circle.map(|(from, to, name)| format!("{} needs {name} of {}", from.join("::"), to.join("::"))).collect()
}

#[test]
fn no_file_needs_a_file_that_needs_it() {
    let found: Vec<String> = CRATES
        .into_iter()
        .flat_map(|part| {
            circles(&sources(&format!("{part}/src"))).into_iter().map(move |arrow| format!("{part}: {arrow}"))
        })
        .collect();
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn a_circle_is_found_however_it_is_written() {
    let found = |files: &[(&str, &str)]| {
        let files: Vec<_> =
            files.iter().map(|(file, text)| ((*file).to_owned(), (*text).to_owned())).collect();
        circles(&files)
    };
    let circle = ["a needs Y of b", "b needs X of a"];
    assert_eq!(found(&[("a.rs", "use crate::b::Y;"), ("b.rs", "use super::a::{X, Z as W};")])[..2], circle);
    assert_eq!(
        found(&[("a.rs", "fn a() { crate::b::Y }"), ("b.rs", "use super::a;\nfn b() { a::X }")]),
        circle
    );
    assert_eq!(
        found(&[
            ("lib.rs", "pub use a::X;\npub use b::Y;"),
            ("a.rs", "use crate::Y;"),
            ("b.rs", "use crate::{X};"),
        ]),
        circle
    );
    let parent = ("a.rs", "mod b;\npub use b::Y;\nstruct X(Y);");
    assert_eq!(found(&[parent, ("a/b.rs", "use super::X;")]), ["a needs Y of a::b", "a::b needs X of a"]);
    assert_eq!(found(&[("a.rs", "mod b;\npub use b::Y;\nstruct X;"), ("a/b.rs", "use super::X;")]), [""; 0]);
    assert_eq!(
        found(&[
            ("lib.rs", "mod prelude { pub use crate::a::X; }"),
            ("a.rs", "enum X { Y }\nmod c { use super::super::b::Y; }"),
            ("b.rs", "use crate::prelude::*;\nstruct Y(X);"),
        ]),
        ["a needs Y of b", "b needs X of a"]
    );
    let tested = "use crate::b::Y;\n\n#[cfg(test)]\nmod tests {\n    use crate::c::Z;\n}\n";
    assert_eq!(found(&[("a.rs", tested), ("b.rs", "use std::fmt;"), ("c.rs", "use crate::a::X;")]), [""; 0]);
    assert_eq!(found(&[("a.rs", "use crate::b::Y;"), ("b.rs", "// crate::a::X")]), [""; 0]);
}
