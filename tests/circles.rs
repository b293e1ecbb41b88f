//! No file needs a file that needs it, directly or over others: within a crate, uses form no circle. A file needs the
//! one that defines what it names; one that passes a name on and does not use it needs nobody.

use std::collections::{BTreeMap, BTreeSet};

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

/// A name as it is imported: its path, how it is called here, and whether it is passed on.
struct Import<'a> {
    path: Vec<&'a str>,
    name: &'a str,
    is_public: bool,
}

/// The names in a file.
#[derive(Default)]
struct Names<'a> {
    imports: Vec<Import<'a>>,
    /// The paths of two segments and more behind the imports.
    paths: Vec<Vec<&'a str>>,
    /// The words behind the imports.
    words: BTreeSet<&'a str>,
    /// The modules that it declares.
    modules: BTreeSet<&'a str>,
}

/// The files of a crate, by their modules.
type Modules<'a> = BTreeMap<Vec<&'a str>, Names<'a>>;

/// Where a module within a file begins and ends: rustfmt lets its brace stand as far in as its first line.
const BEGINS: &str = "mod {";
const ENDS: &str = "mod }";

/// The text without comments and strings. Tests within a file may name whatever they test.
fn code(text: &str) -> String {
    let is_test = |(start, _): &(usize, &str)| {
        let line = text[*start..].lines().nth(1);
        line.is_some_and(|line| line.starts_with("mod ") && line.ends_with('{'))
    };
    let end = text.match_indices("#[cfg(test)]").find(is_test).map_or(text.len(), |(start, _)| start);
    let (mut rest, mut code) = (&text[..end], String::new());
    let after = |text: &'_ str, end: &str| text.find(end).map_or(text.len(), |start| start + end.len());
    while let Some(start) = rest.find(['/', '"', '\'']) {
        code += &rest[..start];
        let (found, is_raw) = (&rest[start..], code.ends_with("r#"));
        rest = match found {
            _ if found.starts_with("//") => &found[after(found, "\n") - 1..],
            _ if found.starts_with('"') && is_raw => &found[after(found, "\"#")..],
            _ if found.starts_with('"') => {
                let is_end = |place: &usize| {
                    let before =
                        found.as_bytes()[1..*place].iter().rev().take_while(|&&sign| sign == b'\\').count();
                    found.as_bytes()[*place] == b'"' && before % 2 == 0
                };
                &found[(1..found.len()).find(is_end).map_or(found.len(), |end| end + 1)..]
            }
            // A sign, and no lifetime.
            _ if found.starts_with("'\"'") => &found[3..],
            _ => &found[1..],
        };
    }
    code + rest
}

/// Words, `::`, single signs, and where modules within the file begin and end.
fn tokens(code: &str) -> Vec<&str> {
    let (mut tokens, mut inner) = (Vec::new(), Vec::new());
    for line in code.lines() {
        let indent = line.len() - line.trim_start().len();
        let mut rest = line;
        while let Some(sign) = rest.chars().next() {
            let word = rest.find(|sign: char| !sign.is_alphanumeric() && sign != '_').unwrap_or(rest.len());
            let length = if rest.starts_with("::") { 2 } else { word.max(sign.len_utf8()) };
            tokens.extend(Some(&rest[..length]).filter(|token| !token.trim().is_empty()));
            rest = &rest[length..];
        }
        if line.ends_with('{') && line.split_whitespace().any(|word| word == "mod") {
            inner.push(indent);
            tokens.push(BEGINS);
        } else if line.trim() == "}" && inner.pop_if(|start| *start == indent).is_some() {
            tokens.push(ENDS);
        }
    }
    tokens
}

fn is_word(token: &str) -> bool {
    token.chars().all(|sign| sign.is_alphanumeric() || sign == '_')
}

/// The leaves of the tree of a `use`, below `path`.
fn leaves<'a>(
    tokens: &mut impl Iterator<Item = &'a str>,
    path: &[&'a str],
    is_public: bool,
) -> Vec<Import<'a>> {
    let (mut imports, mut path, above) = (Vec::new(), path.to_vec(), path.len());
    let (mut name, mut is_renamed) = (None, false);
    while let Some(token) = tokens.next() {
        match token {
            "::" => {}
            "as" => is_renamed = true,
            "{" => {
                name = None;
                imports.extend(leaves(tokens, &path, is_public));
                path.truncate(above);
            }
            "," | "}" | ";" => {
                if name == Some("self") {
                    path.pop();
                    name = path.last().copied();
                }
                is_renamed = false;
                let name = name.take();
                imports.extend(name.map(|name| Import { path: path.clone(), name, is_public }));
                path.truncate(above);
                if token != "," {
                    break;
                }
            }
            word => {
                path.extend(Some(word).filter(|_| !is_renamed));
                name = Some(word);
            }
        }
    }
    imports
}

/// A path that stands so many modules within its file, as the file itself would write it.
fn outward(path: Vec<&str>, within: usize) -> Vec<&str> {
    let inner = path.iter().take(within).filter(|&&segment| segment == "super").count();
    if inner == 0 { path } else { [&["self"], &path[inner..]].concat() }
}

fn names(code: &str) -> Names<'_> {
    let mut names = Names::default();
    let tokens = tokens(code);
    let (mut place, mut within) = (0, 0);
    while let Some(&token) = tokens.get(place) {
        let before = place.checked_sub(1).and_then(|place| tokens.get(place));
        if token == "use" && !matches!(before, Some(&"+" | &"->")) {
            let end = tokens[place..].iter().position(|&token| token == ";");
            let end = end.map_or(tokens.len(), |end| place + end + 1);
            let is_public = matches!(before, Some(&"pub" | &")"));
            let imports = leaves(&mut tokens[place + 1..end].iter().copied(), &[], is_public).into_iter();
            names
                .imports
                .extend(imports.map(|import| Import { path: outward(import.path, within), ..import }));
            place = end;
            continue;
        }
        within = within + usize::from(token == BEGINS) - usize::from(token == ENDS);
        let mut path = vec![token];
        while let (Some(&"::"), Some(next)) = (tokens.get(place + 1), tokens.get(place + 2))
            && is_word(next)
        {
            path.push(next);
            place += 2;
        }
        let is_part = matches!(before, Some(&"mod" | &"." | &"let" | &"fn"));
        // So stand variants and fields in a list, which may be called as anything is.
        let is_listed =
            matches!(before, Some(&"{" | &"," | &"]")) && matches!(tokens.get(place + 1), Some(&"," | &"}"));
        names.modules.extend(Some(token).filter(|_| before == Some(&"mod")));
        if is_word(token) && !is_part {
            names.words.extend(Some(token).filter(|_| !is_listed));
            names.paths.extend(Some(outward(path, within)).filter(|path| path.len() > 1));
        }
        place += 1;
    }
    names
}

/// The path from the root of the crate, if a module means one of it by `path`.
fn absolute<'a>(modules: &Modules<'a>, module: &[&'a str], path: &[&'a str]) -> Option<Vec<&'a str>> {
    let (&first, rest) = path.split_first()?;
    let below = |module: &[&'a str]| Some([module, rest].concat());
    match first {
        "crate" => below(&[]),
        "self" => below(module),
        "super" if rest.first() == Some(&"super") => absolute(modules, module.split_last()?.1, rest),
        "super" => below(module.split_last()?.1),
        child if modules.contains_key(&[module, &[child]].concat()) => Some([module, path].concat()),
        name => {
            let import = modules[module].imports.iter().find(|import| import.name == name)?;
            let path = Some(&import.path).filter(|path| path[0] != name)?;
            Some([absolute(modules, module, path)?, rest.to_vec()].concat())
        }
    }
}

/// The module that defines what has this path from the root.
fn home<'a>(modules: &Modules<'a>, path: &[&'a str]) -> Option<Vec<&'a str>> {
    let length = (0..=path.len()).rev().find(|&length| modules.contains_key(&path[..length]))?;
    let (module, rest) = path.split_at(length);
    let (name, rest) = rest.split_first()?;
    match modules[module].imports.iter().find(|import| import.name == *name) {
        Some(import) => {
            let passed = [absolute(modules, module, &import.path)?, rest.to_vec()].concat();
            if passed == path { Some(module.to_vec()) } else { home(modules, &passed) }
        }
        // That module is the file of another crate.
        None if modules[module].modules.contains(name) => None,
        None => Some(module.to_vec()),
    }
}

/// The paths that `path` stands for: of all that a prelude passes on, those that are used.
fn passed<'a>(
    modules: &Modules<'a>,
    module: &[&'a str],
    names: &Names<'a>,
    path: &[&'a str],
) -> Vec<Vec<&'a str>> {
    let Some((&"*", prelude)) = path.split_last() else { return vec![path.to_vec()] };
    let prelude = absolute(modules, module, prelude).unwrap_or_default();
    let length = (0..=prelude.len()).rev().find(|&length| modules.contains_key(&prelude[..length]));
    let file = &prelude[..length.unwrap_or_default()];
    let imports = modules.get(file).map_or(&[][..], |names| &names.imports);
    let used = imports.iter().filter(|import| import.is_public && names.words.contains(import.name));
    used.map(|import| [&["crate"], file, &[import.name]].concat()).collect()
}

/// The arrows between files of a crate that are part of a circle.
fn circles(files: &[(String, String)]) -> Vec<String> {
    let files: Vec<_> = files.iter().map(|(file, text)| (file, code(text))).collect();
    let modules: Modules<'_> = files
        .iter()
        .map(|(file, text)| {
            let path = file.strip_suffix(".rs").unwrap_or(file).split('/');
            (path.filter(|&name| !["lib", "main"].contains(&name)).collect(), names(text))
        })
        .collect();
    let mut arrows: BTreeSet<(Vec<&str>, Vec<&str>, &str)> = BTreeSet::new();
    for (module, names) in &modules {
        let used = |import: &&Import<'_>| !import.is_public || names.words.contains(import.name);
        let paths = names.imports.iter().filter(used).map(|import| &import.path).chain(&names.paths);
        for path in paths.flat_map(|path| passed(&modules, module, names, path)) {
            let home = absolute(&modules, module, &path).and_then(|path| home(&modules, &path));
            let arrow = |home| (module.clone(), home, path[path.len() - 1]);
            arrows.extend(home.filter(|home| home != module).map(arrow));
        }
    }
    let mut needs: BTreeMap<&[&str], BTreeSet<&[&str]>> = BTreeMap::new();
    for (from, to, _) in &arrows {
        needs.entry(from).or_default().insert(to);
    }
    let leads_back = |from: &[&str], to: &[&str]| {
        let (mut reached, mut left) = (BTreeSet::from([to.to_vec()]), vec![to.to_vec()]);
        while let Some(next) = left.pop() {
            let needed = needs.get(&next[..]).into_iter().flatten().map(|file| file.to_vec());
            left.extend(needed.filter(|file| reached.insert(file.clone())));
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
    let tested = "use crate::b::Y;\n\n#[cfg(test)]\nmod tests {\n    use crate::c::Z;\n}\n";
    assert_eq!(found(&[("a.rs", tested), ("b.rs", "use std::fmt;"), ("c.rs", "use crate::a::X;")]), [""; 0]);
    assert_eq!(found(&[("a.rs", "use crate::b::Y;"), ("b.rs", "// crate::a::X")]), [""; 0]);
}
