//! The names in a file of Rust: what it imports, and the paths and words that stand in it.

use std::collections::BTreeSet;

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// The segments of a path.
pub(crate) type Path = Vec<String>;

/// A name as it is imported: its path, how it is called here, and whether it is passed on.
pub(crate) struct Import {
    pub(crate) path: Path,
    pub(crate) name: String,
    pub(crate) is_public: bool,
}

/// The names in a file.
#[derive(Default)]
pub(crate) struct Names {
    pub(crate) imports: Vec<Import>,
    /// The paths of two segments and more behind the imports.
    pub(crate) paths: Vec<Path>,
    /// The words behind the imports.
    pub(crate) words: BTreeSet<String>,
    /// The modules that it declares.
    pub(crate) modules: BTreeSet<String>,
}

fn word(token: Option<&TokenTree>) -> Option<String> {
    token.filter(|token| matches!(token, TokenTree::Ident(_))).map(TokenTree::to_string)
}

fn is(token: Option<&TokenTree>, sign: char) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == sign)
}

/// The tokens of a stream: what a macro calls `$name` is a word as others are.
fn tokens(stream: TokenStream) -> Vec<TokenTree> {
    stream.into_iter().filter(|token| !is(Some(token), '$')).collect()
}

/// The tokens of a group.
fn inside(token: Option<&TokenTree>) -> Option<Vec<TokenTree>> {
    let Some(TokenTree::Group(group)) = token else { return None };
    Some(tokens(group.stream()))
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

impl Names {
    /// The names in `text`, with those in tests within the file or without them.
    pub(crate) fn of(text: &str, has_tests: bool) -> Self {
        let mut names = Self::default();
        names.read(&tokens(text.parse().expect("Rust")), (0, false), has_tests);
        names
    }

    /// Reads what stands so many modules within a file, in braces or not.
    fn read(&mut self, tokens: &[TokenTree], (within, is_braced): (usize, bool), has_tests: bool) {
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
                    self.imports.extend(imports.map(|(path, name)| Import {
                        path: outward(path, within),
                        name,
                        is_public,
                    }));
                    place = end;
                }
                (Some("mod"), Some(module)) => {
                    let is_test =
                        before.is_some_and(|attribute| attribute.to_string().replace(' ', "") == "[cfg(test)]");
                    if let Some(inner) = inside(tokens.get(place + 1)).filter(|_| has_tests || !is_test) {
                        self.read(&inner, (within + 1, true), has_tests);
                    }
                    self.modules.insert(module);
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
                        self.words.insert(first.to_owned());
                    }
                    self.paths.extend(Some(outward(path, within)).filter(|path| path.len() > 1));
                }
                (None, _) => inside(token).into_iter().for_each(|inner| {
                    let is_braced =
                        matches!(token, Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace);
                    self.read(&inner, (within, is_braced), has_tests);
                }),
            }
        }
    }
}
