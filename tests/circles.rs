//! No file needs a file that needs it, directly or over others: within a crate, uses form no circle. A file needs the
//! one that defines what it names; one that passes a name on and does not use it needs nobody.

use std::collections::{BTreeMap, BTreeSet};
use std::slice;

use proc_macro2::{Delimiter, TokenStream, TokenTree};

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

/// The segments of a path.
type Path = Vec<String>;

/// A name as it is imported: its path, how it is called here, and whether it is passed on.
struct Import {
    path: Path,
    name: String,
    is_public: bool,
}

/// The names in a file.
#[derive(Default)]
struct Names {
    imports: Vec<Import>,
    /// The paths of two segments and more behind the imports.
    paths: Vec<Path>,
    /// The words behind the imports.
    words: BTreeSet<String>,
    /// The modules that it declares.
    modules: BTreeSet<String>,
}

/// The files of a crate, by their modules.
type Modules = BTreeMap<Path, Names>;

fn word(token: Option<&TokenTree>) -> Option<String> {
    token.filter(|token| matches!(token, TokenTree::Ident(_))).map(TokenTree::to_string)
}

fn is(token: Option<&TokenTree>, sign: char) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == sign)
}

/// The tokens of a group.
fn inside(token: Option<&TokenTree>) -> Option<Vec<TokenTree>> {
    let Some(TokenTree::Group(group)) = token else { return None };
    Some(group.stream().into_iter().collect())
}

/// The paths in the tree of a `use`, below `above`, and how their ends are called here.
fn leaves(tree: &[TokenTree], above: &[String]) -> Vec<(Path, String)> {
    let branches = tree.split(|token| is(Some(token), ',')).filter(|branch| !branch.is_empty());
    let paths = branches.flat_map(|branch| {
        let mut path = above.to_vec();
        let (named, other) = match branch {
            [named @ .., TokenTree::Ident(renamed), other] if renamed == "as" => (named, word(Some(other))),
            _ => (branch, None),
        };
        path.extend(named.iter().filter_map(|token| word(Some(token))));
        if let Some(tree) = inside(branch.last()) {
            return leaves(&tree, &path);
        }
        path.extend(Some("*".to_owned()).filter(|_| is(branch.last(), '*')));
        let _ = path.pop_if(|last| last == "self" && branch.len() == 1 && !above.is_empty());
        let name = other.or_else(|| path.last().cloned()).unwrap_or_default();
        vec![(path, name)]
    });
    paths.collect()
}

/// A path that stands so many modules within its file, as the file itself would write it.
fn outward(path: Path, within: usize) -> Path {
    let supers = path.iter().take_while(|&segment| segment == "super").count();
    match supers.min(within) {
        0 => path,
        inner if inner < supers => path[inner..].to_vec(),
        inner => [&["self".to_owned()], &path[inner..]].concat(),
    }
}

/// Reads what stands so many modules within a file, in braces or not. Tests may name whatever they test.
fn read(tokens: &[TokenTree], (within, is_braced): (usize, bool), names: &mut Names) {
    let mut place = 0;
    while let Some(token) = tokens.get(place) {
        let token = Some(token);
        let before = place.checked_sub(1).and_then(|place| tokens.get(place));
        let next = tokens.get(place + 1);
        let (this, ahead) = (word(token), word(next));
        place += 1;
        match (this.as_deref(), ahead) {
            (Some("use"), _) if !is(next, '<') => {
                let end = tokens[place..].iter().position(|token| is(Some(token), ';'));
                let end = end.map_or(tokens.len(), |end| place + end);
                let is_public = match before {
                    // As in `pub(crate) use`.
                    Some(TokenTree::Group(group)) => group.delimiter() == Delimiter::Parenthesis,
                    before => word(before).is_some_and(|before| before == "pub"),
                };
                let imports = leaves(&tokens[place..end], &[]).into_iter();
                names.imports.extend(imports.map(|(path, name)| Import {
                    path: outward(path, within),
                    name,
                    is_public,
                }));
                place = end;
            }
            (Some("mod"), Some(module)) => {
                let is_test =
                    before.is_some_and(|attribute| attribute.to_string().replace(' ', "") == "[cfg(test)]");
                if let Some(inner) = inside(tokens.get(place + 1)).filter(|_| !is_test) {
                    read(&inner, (within + 1, true), names);
                }
                names.modules.insert(module);
                place += 2;
            }
            (Some(first), _) => {
                let mut path = vec![first.to_owned()];
                while is(tokens.get(place), ':')
                    && is(tokens.get(place + 1), ':')
                    && let Some(segment) = word(tokens.get(place + 2))
                {
                    path.push(segment);
                    place += 3;
                }
                // So stand variants and fields in a list, which may be called as anything is.
                let is_listed = is_braced
                    && (before.is_none() || is(before, ',') || inside(before).is_some())
                    && (next.is_none() || is(next, ','));
                if !is(before, '.') && !is_listed {
                    names.words.insert(first.to_owned());
                }
                names.paths.extend(Some(outward(path, within)).filter(|path| path.len() > 1));
            }
            (None, _) => inside(token).into_iter().for_each(|inner| {
                let is_braced =
                    matches!(token, Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace);
                read(&inner, (within, is_braced), names);
            }),
        }
    }
}

fn names(text: &str) -> Names {
    let tokens: TokenStream = text.parse().expect("Rust");
    let mut names = Names::default();
    read(&tokens.into_iter().collect::<Vec<_>>(), (0, false), &mut names);
    names
}

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
    let modules: Modules = files.iter().map(|(file, text)| (module(file), names(text))).collect();
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
