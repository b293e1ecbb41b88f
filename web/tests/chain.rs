//! The chain: drawn, stepped, decided by hand, hunted.

use serde_json::{Value, json};
use tautline_web::Page;

/// The answer of `page`, which must be none of a fault.
fn ask(page: &mut Page, request: &Value) -> Value {
    let answer: Value = serde_json::from_str(&page.answer(&request.to_string())).expect("JSON");
    assert!(answer["error"].is_null(), "{request}: {answer}");
    answer
}

fn settings(rule: &str, ground: &[&str]) -> Value {
    json!({ "scheme": "chain", "rule": rule, "robots": 3, "ground": ground, "base": [2, 2] })
}

const OPEN: [&str; 5] = ["5a"; 5];

/// All findings of a hunt of 3 or 4 robots with at most so many walls.
fn hunted(settings: &Value, robots: u64, walls: u32) -> Value {
    let mut page = Page::default();
    let bounds = json!({ "robots": robots, "max_walls": walls });
    ask(&mut page, &json!({ "do": "hunt", "settings": settings, "bounds": bounds }));
    while ask(&mut page, &json!({ "do": "slice" }))["more"] == true {}
    ask(&mut page, &json!({ "do": "found" }))
}

#[test]
fn a_hunt_in_slices_finds_what_the_program_finds() {
    let found = hunted(&settings("published", &OPEN), 3, 2);
    assert_eq!(found["complete"], true);
    assert_eq!((&found["facts"]["runs"], &found["facts"]["moves"]), (&json!(358), &json!(4604)));
    let clauses = |found: &Value| -> Vec<Value> {
        found["found"].as_array().expect("a list").iter().map(|one| one["clause"].clone()).collect()
    };
    assert_eq!(clauses(&found), ["CHAIN-13"]);
    let found = hunted(&settings("repaired", &OPEN), 3, 2);
    assert_eq!(clauses(&found), [""; 0]);
}

#[test]
fn a_counterexample_is_played_as_it_was_found() {
    let found = hunted(&settings("published", &OPEN), 3, 2);
    let one = &found["found"][0];
    let steps = one["facts"]["steps"].as_u64().expect("a number");
    let open = json!({ "do": "open", "settings": one["settings"], "steps": steps + 1 });
    let opened = ask(&mut Page::default(), &open);
    let made = opened["made"].as_array().expect("a list");
    assert_eq!(made.len() as u64, steps + 1);
    let end = &made[steps as usize]["over"];
    assert_eq!(end["broken"][0]["clause"], one["clause"]);
    assert_ne!(end["broken"][0]["cells"], json!([]));
}

#[test]
fn an_answer_by_hand_is_a_wall_and_stays_one() {
    let mut page = Page::default();
    let settings = settings("repaired", &OPEN);
    let opened = ask(&mut page, &json!({ "do": "open", "settings": settings }));
    assert_eq!(opened["board"]["start"]["cells"], json!([12, 12, 12]));
    let asked = ask(&mut page, &json!({ "do": "step", "by_hand": true }));
    assert_eq!(asked["question"]["options"], json!(["open", "a wall"]));
    let side = asked["question"]["side"].clone();
    assert_ne!(asked["would"][0]["made"]["cells"], asked["would"][1]["made"]["cells"]);
    let mut step = ask(&mut page, &json!({ "do": "step", "by_hand": true, "answers": [1] }));
    while !step["question"].is_null() {
        step = ask(&mut page, &json!({ "do": "step", "by_hand": true, "answers": [-1] }));
    }
    assert_eq!(step["made"][0]["made"]["walls"][0], json!([side, true]));
    // The same answers make the same game.
    let answers = step["answers"].clone();
    let again = json!({ "do": "open", "settings": settings, "answers": answers, "steps": 1 });
    assert_eq!(ask(&mut Page::default(), &again)["made"], step["made"]);
}

#[test]
fn a_condition_that_is_off_makes_a_mutant_that_breaks_its_clause() {
    let list = ask(&mut Page::default(), &json!({ "do": "schemes" }));
    let rules = &list["schemes"][0]["rules"];
    let repaired = &rules[1];
    assert_eq!(repaired["name"], "repaired");
    let conditions = repaired["conditions"].as_array().expect("a list");
    let place = conditions.iter().position(|one| one["name"] == "Unfold").expect("a condition");
    assert!(
        conditions[place]["sentence"].as_str().expect("words").starts_with("Repair: when an epoch is over")
    );
    let bits = (0..).zip(conditions).filter(|(bit, one)| one["on"] == true && *bit != place);
    let on: u16 = bits.map(|(bit, _)| 1 << bit).sum();
    let mut settings = settings("repaired", &OPEN);
    settings["on"] = json!(on);
    let found = hunted(&settings, 3, 2);
    assert_eq!(found["found"][0]["clause"], "CHAIN-13");
    assert_eq!(found["found"][0]["settings"]["on"], on);
}

#[test]
fn a_step_that_is_refused_names_the_condition() {
    let mut page = Page::default();
    let settings = settings("repaired", &OPEN);
    ask(&mut page, &json!({ "do": "open", "settings": settings, "steps": 2 }));
    let refused = ask(&mut page, &json!({ "do": "refusals" }));
    let refused = refused["refused"].as_array().expect("a list");
    assert!(refused.iter().any(|one| !one["by"].as_array().expect("a list").is_empty()), "{refused:?}");
}

#[test]
fn a_bound_that_a_hunt_does_not_take_is_refused_in_the_words_of_the_hunt() {
    let settings = settings("published", &OPEN);
    let hunt = json!({ "do": "hunt", "settings": settings, "bounds": { "robots": 3, "max_misses": 1 } });
    let refused = Page::default().answer(&hunt.to_string());
    assert!(refused.contains("the robots of a chain have no floor sensors to miss"), "{refused}");
}

#[test]
fn a_hunt_takes_the_range_that_is_chosen_and_refuses_what_it_does_not_look_at() {
    let mut settings = settings("published", &OPEN);
    settings["options"] = json!({ "loss": "0.5" });
    let hunt = |settings: &Value| json!({ "do": "hunt", "settings": settings, "bounds": { "max_walls": 2 } });
    let refused = Page::default().answer(&hunt(&settings).to_string());
    assert!(refused.contains("no hunt looks at the option `loss`"), "{refused}");
    settings["options"] = json!({ "range": "2" });
    let refused = Page::default().answer(&hunt(&settings).to_string());
    assert!(refused.contains("the robots of a chain hear each other as far as their rule says"), "{refused}");
    (settings["scheme"], settings["rule"]) = (json!("kit"), json!("published"));
    let mut page = Page::default();
    let begun = ask(&mut page, &hunt(&settings));
    assert_eq!(begun["command"], "tautline hunt --scheme kit --rule published --max-walls 2 --range 2");
    while ask(&mut page, &json!({ "do": "slice" }))["more"] == true {}
    let found = ask(&mut page, &json!({ "do": "found" }));
    assert!(found["title"].as_str().expect("words").contains("a range of 2 cells"), "{found}");
    assert_eq!(found["found"][0]["settings"]["options"]["range"], "2");
}

#[test]
fn a_stored_run_whose_seed_a_page_cannot_hold_exactly_is_refused() {
    let mut settings = settings("repaired", &OPEN);
    settings["scheme"] = json!("ants");
    let mut page = Page::default();
    for (seed, is_held) in [((1_u64 << 53) - 1, true), ((1 << 53) + 1, false)] {
        settings["seed"] = json!(seed);
        let stored = ask(&mut page, &json!({ "do": "store", "settings": settings }));
        let read =
            page.answer(&json!({ "do": "read", "name": "a.jsonl", "text": stored["text"] }).to_string());
        assert_eq!(!read.contains("its seed is larger"), is_held, "{read}");
    }
}

#[test]
fn what_is_no_request_or_no_layout_is_said() {
    let mut page = Page::default();
    let mut wrong = |request: Value| {
        let answer: Value = serde_json::from_str(&page.answer(&request.to_string())).expect("JSON");
        answer["error"].as_str().map_or_else(|| panic!("{request}: {answer}"), str::to_owned)
    };
    for request in [
        json!({ "do": "dance" }),
        json!({ "do": "step" }),
        json!({ "do": "slice" }),
        json!({ "do": "open", "settings": settings("repaired", &["5a", "4a"]) }),
        json!({ "do": "open", "settings": settings("repaired", &["5z"]) }),
        json!({ "do": "open", "settings": settings("unheard-of", &OPEN) }),
        json!({ "do": "open", "settings": { "scheme": "none" } }),
        json!({ "do": "read", "name": "a.png", "text": "\u{0}PNG" }),
        json!({ "do": "read", "name": "a.map", "text": "type octile\nheight 3\n" }),
        json!({ "do": "read", "name": "a.txt", "text": "tautline layout 2\n" }),
        json!({ "do": "read", "name": "a.jsonl", "text": "{\"format\":\"tautline run\",\"version\":1}" }),
    ] {
        assert!(!wrong(request).is_empty());
    }
}

#[test]
fn a_stored_run_is_read_and_written() {
    let mut page = Page::default();
    let settings = settings("repaired", &["5a", "bc3a", "5a", "2a2ea", "5a"]);
    let stored = ask(&mut page, &json!({ "do": "store", "settings": settings }));
    let read = ask(&mut page, &json!({ "do": "read", "name": "a.jsonl", "text": stored["text"] }));
    let again = ask(&mut page, &json!({ "do": "store", "settings": read["run"]["settings"] }));
    assert_eq!(stored, again);
    let drawn = ask(&mut page, &json!({ "do": "draw", "settings": settings }));
    let read = ask(&mut page, &json!({ "do": "read", "name": "a.txt", "text": drawn["text"] }));
    assert_eq!(read["layout"]["ground"], settings["ground"]);
    assert_eq!(read["layout"]["base"], settings["base"]);
}
