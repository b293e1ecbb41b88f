//! A table as comma-separated values (RFC 4180), made of its JSON, so that a table needs no code for it.
//!
//! Each element of each list is a row: of `lines`, of `lines.rules` within it. A row has what stands beside the lists
//! in which it is, from the settings on. The column `list` says of which list it is; the column with a list's name has
//! the element's number, from 1. A list of plain values, such as an interval, makes columns of its values, numbered
//! from 1.

use std::collections::BTreeMap;
use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, Visitor};

use tautline_io::atomic_file::CSV_HEAD;
use tautline_io::diagnostic::Diagnostic;

/// A value of JSON.
#[derive(Deserialize)]
#[serde(untagged)]
enum Node {
    Bool(bool),
    Number(serde_json::Number),
    Text(String),
    List(Vec<Self>),
    Object(Members),
    Null(()),
}

impl Node {
    /// Whether its elements make rows.
    fn has_rows(&self) -> bool {
        match self {
            Self::List(items) => items.iter().any(|item| matches!(item, Self::List(_) | Self::Object(_))),
            Self::Bool(_) | Self::Number(_) | Self::Text(_) | Self::Object(_) | Self::Null(()) => false,
        }
    }
}

/// The members of an object, in their order.
struct Members(Vec<(String, Node)>);

impl<'de> Deserialize<'de> for Members {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct InOrder;

        impl<'de> Visitor<'de> for InOrder {
            type Value = Members;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("any value")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut object: A) -> Result<Members, A::Error> {
                let mut members = Vec::new();
                while let Some(member) = object.next_entry()? {
                    members.push(member);
                }
                Ok(Members(members))
            }
        }

        deserializer.deserialize_map(InOrder)
    }
}

/// The path of a member.
fn below(path: &str, name: impl fmt::Display) -> String {
    if path.is_empty() { name.to_string() } else { format!("{path}.{name}") }
}

/// Cells of a row, each with its column.
type Cells = Vec<(String, String)>;

/// Adds what stands in `node`, but for its lists of rows.
fn plain(path: &str, node: &Node, cells: &mut Cells) {
    match node {
        Node::Bool(value) => cells.push((path.to_owned(), value.to_string())),
        Node::Number(value) => cells.push((path.to_owned(), value.to_string())),
        Node::Text(value) => cells.push((path.to_owned(), value.clone())),
        Node::Null(()) => {}
        Node::List(items) => {
            if !node.has_rows() {
                for (number, item) in (1..).zip(items) {
                    plain(&below(path, number), item, cells);
                }
            }
        }
        Node::Object(Members(members)) => {
            for (name, member) in members {
                plain(&below(path, name), member, cells);
            }
        }
    }
}

/// The rows of all lists in `node`, each beginning with `before`, the cells of what it is within.
fn rows(path: &str, node: &Node, before: &Cells, found: &mut Vec<(String, Cells)>) {
    match node {
        Node::Bool(_) | Node::Number(_) | Node::Text(_) | Node::Null(()) => {}
        Node::Object(Members(members)) => {
            for (name, member) in members {
                rows(&below(path, name), member, before, found);
            }
        }
        Node::List(items) => {
            for (number, item) in (1..).zip(items.iter().filter(|_| node.has_rows())) {
                let mut cells = before.clone();
                cells.push((path.to_owned(), number.to_string()));
                plain(path, item, &mut cells);
                found.push((path.to_owned(), cells.clone()));
                // A list that is an element of a list has no name of its own.
                let within =
                    if matches!(item, Node::List(_)) { below(path, "each") } else { path.to_owned() };
                rows(&within, item, &cells, found);
            }
        }
    }
}

/// A field as it stands in a file.
fn field(text: &str) -> String {
    if text.contains([',', '"', '\r', '\n']) || text.is_empty() {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// The file of a table that is told by this JSON.
///
/// # Errors
/// A [`Diagnostic`] if it is none.
pub(super) fn csv(json: &str) -> Result<String, Diagnostic> {
    let node: Node = serde_json::from_str(json)
        .map_err(|error| Diagnostic::usage(error, "take it as tautline wrote it"))?;
    let (mut before, mut found) = (Vec::new(), Vec::new());
    plain("", &node, &mut before);
    rows("", &node, &before, &mut found);
    let mut columns: Vec<String> = CSV_HEAD.trim_end_matches(',').split(',').map(str::to_owned).collect();
    let mut places: BTreeMap<String, usize> = columns.iter().cloned().zip(0..).collect();
    for (column, _) in found.iter().flat_map(|(_, cells)| cells) {
        if !places.contains_key(column) {
            places.insert(column.clone(), columns.len());
            columns.push(column.clone());
        }
    }
    let line = |fields: &[String]| fields.join(",") + "\r\n";
    let mut text = line(&columns.iter().map(|column| field(column)).collect::<Vec<_>>());
    for (list, cells) in found {
        let mut fields = vec![String::new(); columns.len()];
        for (column, value) in cells.into_iter().chain([("list".to_owned(), list)]) {
            if let Some(field_of) = places.get(&column).and_then(|&place| fields.get_mut(place)) {
                *field_of = field(&value);
            }
        }
        text += &line(&fields);
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_element_of_each_list_is_a_row() {
        let json = r#"{"schema_version":1,"id":"t","seed":7,"lines":[
            {"rule":"a,\"b\"","mean":{"of":1.5,"interval":[1,2.0]},"rules":[{"x":null},{"x":""}]},
            {"rule":"c\nd","mean":null,"rules":[]}],"ways":[[[0,1],[2,3]]]}"#;
        let expected = [
            "schema_version,id,list,seed,lines,lines.rule,lines.mean.of,lines.mean.interval.1,\
             lines.mean.interval.2,lines.rules,lines.rules.x,ways,ways.each,ways.each.1,ways.each.2",
            "1,t,lines,7,1,\"a,\"\"b\"\"\",1.5,1,2.0,,,,,,",
            "1,t,lines.rules,7,1,\"a,\"\"b\"\"\",1.5,1,2.0,1,,,,,",
            "1,t,lines.rules,7,1,\"a,\"\"b\"\"\",1.5,1,2.0,2,\"\",,,,",
            "1,t,lines,7,2,\"c\nd\",,,,,,,,,",
            "1,t,ways,7,,,,,,,,1,,,",
            "1,t,ways.each,7,,,,,,,,1,1,0,1",
            "1,t,ways.each,7,,,,,,,,1,2,2,3",
        ];
        assert_eq!(csv(json).expect("a table"), expected.join("\r\n") + "\r\n");
        assert!(csv("no table").is_err());
    }
}
