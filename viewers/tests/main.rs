//! Runs of rules of one's own, in the formats of viewers: what their steps cannot show stands there in words.

use std::fs;

use mcap::MessageStream;
use mcap::records::Record;
use serde_json::{Value, json};
use tautline_io::atomic_file::{AtomicFile, Replaceable};
use tautline_io::diagnostic::Halt;
use tautline_sim::explore::{Catalogue, Play};
use tautline_sim::trace::{self, StoredRun};
use tautline_viewers::{itf, mcap as recording};

/// A robot dies, and the other one waits for it for ever.
const RUN: &str = concat!(
    r#"{"format":"tautline run","version":1,"scheme":"patrol","rule":"looks","robots":2,"seed":0,"base":[1,0],"#,
    r#""starts":[[1,0],[0,0]],"limits":{"until":null,"max_moves":null,"violation":{"stop-at":"PATROL-2"}},"#,
    r#""clause":"PATROL-2","demand":"robot 1 comes to the south east","numbered_from":0,"#,
    r#""layout":"tautline layout 1\n+--+--+\n|  |B |\n+  +  +\n|     |\n+--+--+\n"}"#,
    "\n",
    r#"{"move":{"step":1,"kind":"advance","tried":"..","blocked":[],"cells":[[1,0],[0,0]],"title":"robot 0 dies"}}"#,
    "\n",
    r#"{"move":{"step":2,"kind":"advance","tried":"..","blocked":[],"cells":[[1,0],[0,0]],"title":"robot 1 acts","#,
    r#""again":true}}"#,
    "\n",
    r#"{"end":{"stopped":"endless","steps":2,"explored":2,"cells":0,"violations":[{"clause":"PATROL-2","step":2}]}}"#,
    "\n",
);

/// The bytes that `write` makes of the stored run in `text`.
fn written(text: &str, write: fn(&mut AtomicFile, &dyn Play) -> Result<(), Halt>) -> Vec<u8> {
    let read = trace::open_text("run.jsonl", text.to_owned(), Catalogue::OWN).expect("a stored run");
    let StoredRun::Foreign(run) = read else { panic!("the scheme is in no catalogue") };
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run");
    let mut file = AtomicFile::new(&path, &Replaceable::default()).expect("room");
    write(&mut file, &run).expect("a run");
    file.keep().expect("room");
    fs::read(&path).expect("a file")
}

/// The run as a file of before these words has it.
fn without_words() -> String {
    let words = [
        r#","demand":"robot 1 comes to the south east","numbered_from":0"#,
        r#","title":"robot 0 dies""#,
        r#","title":"robot 1 acts","again":true"#,
    ];
    words.iter().fold(RUN.to_owned(), |text, words| {
        assert_eq!(text.matches(words).count(), 1, "{words}");
        text.replacen(words, "", 1)
    })
}

#[test]
fn a_trace_has_the_words_of_a_rule_of_ones_own_in_the_meta_of_its_states() {
    let meta = |text: &str| {
        let read: Value = serde_json::from_slice(&written(text, itf::write)).expect("JSON");
        let states = read["states"].as_array().expect("a list").iter().map(|state| state["#meta"].clone());
        (read["#meta"]["numbered_from"].clone(), states.collect::<Vec<_>>())
    };
    let demands = json!({ "PATROL-2": "robot 1 comes to the south east" });
    let states = vec![
        json!({ "index": 0 }),
        json!({ "index": 1, "title": "robot 0 dies" }),
        json!({ "index": 2, "title": "robot 1 acts", "again": true, "demands": demands }),
    ];
    assert_eq!(meta(RUN), (json!(0), states));
    let bare = (0..3).map(|index| json!({ "index": index })).collect();
    assert_eq!(meta(&without_words()), (json!(0), bare));
}

/// The title of a team move, and whether it comes again, which are the last fields of its message.
fn last_fields(message: &[u8]) -> (String, bool) {
    let (again, before) = message.split_last().expect("a message");
    let text = before.strip_suffix(&[0]).expect("a zero at the end of a text");
    let length = |text: &[u8]| text.len() as u32 + 1;
    let start =
        (4..=text.len()).rev().find(|&start| text[start - 4..start] == length(&text[start..]).to_le_bytes());
    let title = String::from_utf8(text[start.expect("a length")..].to_vec()).expect("text");
    (title, *again == 1)
}

#[test]
fn a_recording_has_the_words_of_a_rule_of_ones_own_in_its_team_moves_and_its_metadata() {
    let told = |text: &str| {
        let bytes = written(text, recording::write);
        let messages =
            MessageStream::new(&bytes).expect("a recording").map(|message| message.expect("a message"));
        let moves = messages.filter(|message| message.channel.topic == "/team_move");
        let moves: Vec<_> = moves.map(|message| last_fields(&message.data)).collect();
        let records = mcap::read::LinearReader::new(&bytes).expect("a recording");
        let facts: Vec<_> = records
            .filter_map(|record| match record.expect("a record") {
                Record::Metadata(facts) => Some((facts.name, facts.metadata)),
                _ => None,
            })
            .collect();
        (moves, facts)
    };
    let (moves, facts) = told(RUN);
    assert_eq!(moves, [("robot 0 dies".to_owned(), false), ("robot 1 acts".to_owned(), true)]);
    let [(_, first), (name, demands)] = &facts[..] else { panic!("{facts:?}") };
    assert_eq!(first["numbered_from"], "0");
    assert_eq!(name, "tautline demands");
    assert_eq!(demands["PATROL-2"], "robot 1 comes to the south east");
    let (moves, facts) = told(&without_words());
    assert_eq!(moves, [(String::new(), false), (String::new(), false)]);
    assert_eq!((facts.len(), &*facts[0].1["numbered_from"]), (1, "0"), "{facts:?}");
}
