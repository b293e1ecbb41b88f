//! The catalogue of tables: names, options and settings agree, and jobs are independent of each other.

#[path = "../../tests/schema/mod.rs"]
mod schema;

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;
use tautline_papers::tables::parameter::Values;
use tautline_papers::tables::{Entry, Experiment, Report, TABLES, find};

/// Values that make any table quick.
const SMALL: [(&str, &[&str]); 6] = [
    ("agents", &["1", "3"]),
    ("map", &["open:4x3"]),
    ("max-steps", &["3000"]),
    ("max-walls", &["1"]),
    ("nodes", &["150"]),
    ("patience", &["20"]),
];

/// How often a table measures to be quick; none if it is quick as it is.
fn runs(id: &str) -> Option<&'static str> {
    match id {
        "antenna-fig4" => Some("20"),
        "chain-radio" | "chain-table1" | "floors-missed" => Some("2"),
        "floors" | "locate-convergence" | "locate-fig8" => None,
        _ => Some("3"),
    }
}

fn small(table: &dyn Entry) -> Box<dyn Experiment + '_> {
    let has = |name: &str| table.options().iter().any(|(option, _)| option.name == name);
    let given = SMALL.iter().filter(|(name, _)| has(name));
    let mut given: Vec<(String, Vec<String>)> = given
        .map(|(name, texts)| ((*name).to_owned(), texts.iter().map(ToString::to_string).collect()))
        .collect();
    if let Some(runs) = runs(table.about().id).filter(|_| has("runs")) {
        given.push(("runs".to_owned(), vec![runs.to_owned()]));
    }
    table.asked(&given).expect("values that it reads")
}

/// Everything that a person or a program is given of it.
fn told(table: &dyn Entry, made: &dyn Report) -> Vec<String> {
    let pictures = table.about().pictures.iter().map(|&(name, _)| match made.picture(name) {
        Ok(picture) => picture,
        Err(halt) => format!("{halt:?}"),
    });
    let texts = [
        made.text().expect("a text"),
        made.json(1).expect("JSON"),
        made.csv(1).expect("values"),
        made.is_broken().to_string(),
    ];
    texts.into_iter().chain(pictures).collect()
}

/// Which of so many shards measure nothing but their own jobs, from the last to the first.
fn merged_from_shards(table: &dyn Entry, shards: usize) -> Vec<String> {
    let settings = small(table).settings().expect("JSON");
    let count = small(table).jobs().expect("jobs").len();
    let mut results = vec![String::new(); count];
    for shard in 0..shards {
        let asked = table.restored(&settings).expect("its own settings");
        let jobs = asked.jobs().expect("jobs");
        for place in (shard..count).step_by(shards).rev() {
            results[place] = asked.measure(&jobs[place]).expect("a result");
        }
    }
    let asked = table.restored(&settings).expect("its own settings");
    told(table, &*asked.merge(&results).expect("all results"))
}

/// How many plain values there are at any depth.
fn plain_values(value: &Value) -> usize {
    match value {
        Value::Null => 0,
        Value::Bool(_) | Value::Number(_) | Value::String(_) => 1,
        Value::Array(items) => items.iter().map(plain_values).sum(),
        Value::Object(members) => members.values().map(plain_values).sum(),
    }
}

/// The values of a table, as a reader of others takes them, are those of its JSON: each at the place that its column
/// and the numbers of its row say, and none is left out.
fn has_all_values(id: &str, text: &str, json: &Value) {
    assert!(text.ends_with("\r\n") && !text.replace("\r\n", "").contains('\r'), "{id}");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let columns: Vec<String> = reader.headers().expect("columns").iter().map(str::to_owned).collect();
    let mut seen = BTreeSet::new();
    for row in reader.records() {
        let row = row.unwrap_or_else(|error| panic!("{id}: {error}"));
        let cells: BTreeMap<&str, &str> = columns.iter().map(String::as_str).zip(row.iter()).collect();
        assert_eq!(cells["id"], id);
        for (&column, &cell) in cells.iter().filter(|(column, cell)| **column != "list" && !cell.is_empty()) {
            // Each part of the column's name that is a list has the number of its element in a column of its own.
            let (mut pointer, mut path) = (String::new(), String::new());
            for part in column.split('.') {
                path = if path.is_empty() { part.to_owned() } else { format!("{path}.{part}") };
                let is_plain = part.parse::<usize>().is_ok();
                if is_plain {
                    pointer = format!("{pointer}/{}", part.parse::<usize>().expect("a number") - 1);
                } else {
                    if part != "each" {
                        pointer = format!("{pointer}/{part}");
                    }
                    let is_list = json.pointer(&pointer).is_some_and(|value| {
                        value
                            .as_array()
                            .is_some_and(|items| items.iter().any(|item| item.is_object() || item.is_array()))
                    });
                    if is_list {
                        pointer =
                            format!("{pointer}/{}", cells[&*path].parse::<usize>().expect("a number") - 1);
                    }
                }
            }
            let value =
                json.pointer(&pointer).unwrap_or_else(|| panic!("{id}: {column} is not at {pointer}"));
            match value {
                Value::String(text) => assert_eq!(cell, text),
                Value::Bool(_) | Value::Number(_) => assert_eq!(cell, value.to_string()),
                // This is the number of an element.
                Value::Object(_) | Value::Array(_) => continue,
                Value::Null => panic!("{id}: nothing is at {pointer}, but the cell says {cell}"),
            }
            seen.insert(pointer);
        }
    }
    assert_eq!(seen.len(), plain_values(json), "{id}");
}

#[test]
fn jobs_give_the_same_table_in_any_order_and_in_shards_and_its_json_is_as_its_schema_says() {
    // The atlas has no small settings; its page has all of it.
    for &table in TABLES.iter().filter(|table| table.about().id != "atlas") {
        let (asked, id) = (small(table), table.about().id);
        let at_once = told(table, &*asked.run(&()).expect("a table"));
        assert_eq!(merged_from_shards(table, 3), at_once, "{id}");
        insta::assert_snapshot!(format!("table_{id}"), at_once[0].trim());
        let json = serde_json::from_str(&at_once[1]).expect("JSON");
        has_all_values(id, &at_once[2], &json);
        schema::check(&format!("reproduce-{id}"), &json, id);
    }
}

#[test]
fn a_figure_of_agents_says_where_they_start_unless_that_is_the_centre() {
    let table = find("bricks-ideal").expect("it is in the catalogue");
    let measured = |starts: Option<&'static str>| {
        let given =
            [("runs", "1"), ("max-steps", "500")].into_iter().chain(starts.map(|word| ("starts", word)));
        let given: Vec<_> = given.map(|(name, word)| (name.to_owned(), vec![word.to_owned()])).collect();
        let asked = table.asked(&given).expect("values that it reads");
        let made = asked.run(&()).expect("a table");
        let json: Value = serde_json::from_str(&made.json(1).expect("JSON")).expect("JSON");
        schema::check("reproduce-bricks-ideal", &json, "bricks-ideal");
        json
    };
    let [untold, centre, apart, edge] = [None, Some("centre"), Some("apart"), Some("edge")].map(measured);
    assert_eq!(untold, centre);
    assert_eq!(
        [&centre["starts"], &apart["starts"], &edge["starts"]],
        [&Value::Null, &"apart".into(), &"edge".into()]
    );
    assert!(
        apart["lines"] != centre["lines"]
            && edge["lines"] != centre["lines"]
            && apart["lines"] != edge["lines"]
    );
}

#[test]
fn searches_of_the_atlas_find_the_same_in_any_order() {
    let asked = find("atlas").expect("it is in the catalogue").asked(&[]).expect("no value");
    let jobs = asked.jobs().expect("jobs");
    // Those of the fewest robots and of the fewest walls: the others take seconds.
    let short = || jobs[..2].iter().chain(&jobs[jobs.len() - 4..]);
    let results = |jobs: &mut dyn Iterator<Item = &String>| -> Vec<String> {
        jobs.map(|job| asked.measure(job).expect("a result")).collect()
    };
    let mut backwards = results(&mut short().rev());
    backwards.reverse();
    assert_eq!(results(&mut short()), backwards);
}

#[test]
fn results_of_other_jobs_are_refused() {
    let table = find("antenna-fig4").expect("it is in the catalogue");
    let asked = small(table);
    let refused = |results: &[String]| asked.merge(results).err().map(|halt| format!("{halt:?}"));
    assert!(refused(&[]).is_some_and(|said| said.contains("0 results of 5 jobs")));
    assert!(refused(&vec!["7".to_owned(); 5]).is_some());
    assert!(asked.measure("7").is_err() && table.restored("7").is_err());
}

#[test]
fn sums_that_no_layouts_have_are_refused() {
    let asked = small(find("repair-cost").expect("it is in the catalogue"));
    let jobs = asked.jobs().expect("jobs");
    let right: Vec<String> = jobs.iter().map(|job| asked.measure(job).expect("a result")).collect();
    let one: Value = serde_json::from_str(&right[0]).expect("JSON");
    for (place, wrong) in [
        ("/moves/difference/count", 16_777_217_u64),
        ("/explored/published/count", 0),
        ("/moves/repaired/squares", 1),
        ("/moves/repaired/sum", u64::MAX),
        ("/milestones/0/difference/count", 1000),
        ("/violations/0/0", 1000),
    ] {
        let (mut results, mut one) = (right.clone(), one.clone());
        *one.pointer_mut(place).expect("a number") = wrong.into();
        results[0] = one.to_string();
        let said = asked.merge(&results).err().map(|halt| format!("{halt:?}"));
        assert!(
            said.is_some_and(|said| said.contains("the result of job 0 is none of its layouts")),
            "{place}"
        );
    }
}

#[test]
fn a_repaired_team_that_breaks_a_clause_makes_the_table_say_so() {
    let (yes, one) = (Value::from(true), Value::from(1));
    for (id, places) in [
        ("repair-cost", vec![("/violations/1/0", one.clone())]),
        // Two repaired robots are out of contact, or leave paths out.
        ("kit-fig14", vec![("/5/is_cut", yes.clone()), ("/5/paths", Value::Array(Vec::new()))]),
        ("kit-range", vec![("/0/is_cut", yes.clone()), ("/9/paths", Value::Array(Vec::new()))]),
        // One repaired robot, behind the five teams of the published rule.
        ("frontier-fig7", vec![("/5/is_double", yes), ("/5/again/0", one), ("/5/moves", Value::Null)]),
    ] {
        let asked = small(find(id).expect("it is in the catalogue"));
        let jobs = asked.jobs().expect("jobs");
        let mut results: Vec<String> = jobs.iter().map(|job| asked.measure(job).expect("a result")).collect();
        assert!(!asked.merge(&results).expect("a table").is_broken(), "{id}");
        let first: Value = serde_json::from_str(&results[0]).expect("JSON");
        for (place, broken) in places {
            let mut first = first.clone();
            *first.pointer_mut(place).expect("a part") = broken;
            results[0] = first.to_string();
            assert!(asked.merge(&results).expect("a table").is_broken(), "{id}{place}");
        }
    }
}

#[test]
fn every_table_has_a_name_of_its_own() {
    let ids: BTreeSet<&str> = TABLES.iter().map(|table| table.about().id).collect();
    assert_eq!(ids.len(), TABLES.len());
    for id in ids {
        assert_eq!(find(id).map(|table| table.about().id), Some(id));
    }
    assert!(find("fig99").is_none());
}

#[test]
fn options_and_pictures_of_a_table_have_names_of_their_own() {
    for table in TABLES {
        let options = table.options().into_iter().map(|(option, _)| option.name);
        let names: Vec<&str> = options.chain(table.about().pictures.iter().map(|&(name, _)| name)).collect();
        assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len(), "{:?}", table.about());
    }
}

#[test]
fn what_stands_for_an_option_that_is_not_given_is_what_its_settings_have() {
    for table in TABLES {
        let settings = |given: &[(String, Vec<String>)]| {
            table.asked(given).and_then(|asked| asked.settings()).expect("settings")
        };
        let unasked = settings(&[]);
        for (option, shown) in table.options() {
            let texts: Vec<String> = match option.values {
                Values::List => shown.iter().flat_map(|text| text.split(',')).map(str::to_owned).collect(),
                Values::None | Values::One | Values::Word(_) | Values::Repeated => shown,
            };
            for text in &texts {
                assert_eq!(table.check(option.name, text), Ok(()), "--{} {text}", option.name);
            }
            if !texts.is_empty() {
                assert_eq!(settings(&[(option.name.to_owned(), texts)]), unasked, "--{}", option.name);
            }
        }
    }
}

#[test]
fn every_option_can_be_wrong_and_changes_the_settings() {
    let values = ["9", "2", "5", "shared", "once", "largest", "apart", "1,2,3,4", "open:4x3", "0.25"];
    for table in TABLES {
        let unasked = table.asked(&[]).and_then(|asked| asked.settings()).expect("settings");
        for (option, _) in table.options() {
            let name = option.name;
            let texts: Vec<String> = match option.values {
                Values::None => Vec::new(),
                Values::One | Values::Word(_) | Values::List | Values::Repeated => {
                    assert!(table.check(name, "no such value").is_err(), "--{name}");
                    let wrong = [(name.to_owned(), vec!["no such value".to_owned()])];
                    assert!(table.asked(&wrong).is_err(), "--{name}");
                    let right = values.iter().find(|text| table.check(name, text).is_ok());
                    vec![(*right.expect("one that is right")).to_owned()]
                }
            };
            let asked = table.asked(&[(name.to_owned(), texts)]).and_then(|asked| asked.settings());
            assert_ne!(asked.expect("settings"), unasked, "--{name} of {}", table.about().id);
        }
    }
}
