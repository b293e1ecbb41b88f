//! Every scheme: a game that is begun, stepped and made again.

use serde_json::{Value, json};
use tautline_web::Page;

/// The answer of `page`, which must be none of a fault.
fn ask(page: &mut Page, request: &Value) -> Value {
    let answer: Value = serde_json::from_str(&page.answer(&request.to_string())).expect("JSON");
    assert!(answer["error"].is_null(), "{request}: {answer}");
    answer
}

/// Settings of a scheme in a small layout without walls.
fn settings(scheme: &Value, rule: &Value) -> Value {
    let robots = scheme["robots"][0].as_u64().expect("a number").max(2);
    let sight = scheme["options"].as_array().expect("a list").iter().any(|option| option["field"] == "sight");
    let options = if sight { json!({ "sight": "1" }) } else { json!({}) };
    json!({
        "scheme": scheme["name"], "rule": rule["name"], "robots": robots, "ground": ["4a", "4a", "4a"],
        "options": options, "world": scheme["by_hand"] == "only",
    })
}

#[test]
fn a_step_under_noise_marks_where_robots_and_objects_are_and_are_taken_to_be() {
    let options = json!({ "noise-db": "2", "readings": "20", "objects": "3" });
    let settings = json!({
        "scheme": "frontier", "rule": "repaired", "robots": 2, "options": options,
        "ground": ["7a", "2a2b3a", "7a", "7a"], "base": [3, 3],
    });
    let opened = ask(&mut Page::default(), &json!({ "do": "open", "settings": settings, "steps": 9 }));
    let layer = |name: &str| {
        let layers = opened["board"]["layers"].as_array().expect("a list");
        layers.iter().position(|layer| layer["name"] == name).expect("the layer")
    };
    let marks = opened["made"][8]["made"]["marks"].as_array().expect("marks");
    for (name, guesses, figures) in [("beliefs", 2, 7), ("fixes", 2, 5)] {
        let is_guess = |mark: &&Value| mark[0] == layer(name) && mark[2] == 1;
        let of: Vec<&Value> = marks.iter().filter(is_guess).collect();
        assert_eq!(of.len(), guesses, "{name}");
        assert!(of.iter().all(|mark| mark[3].as_array().is_some_and(|all| all.len() == figures)), "{of:?}");
    }
    assert!(marks.iter().filter(|mark| mark[0] == layer("objects")).count() >= 3);
}

#[test]
fn every_rule_of_every_scheme_is_played_and_made_again() {
    let list = ask(&mut Page::default(), &json!({ "do": "schemes" }));
    let schemes = list["schemes"].as_array().expect("a list");
    assert!(schemes.len() > 10, "{}", schemes.len());
    for scheme in schemes {
        for rule in scheme["rules"].as_array().expect("a list") {
            let settings = settings(scheme, rule);
            let opened =
                ask(&mut Page::default(), &json!({ "do": "open", "settings": settings, "steps": 6 }));
            let made = opened["made"].as_array().expect("a list");
            // A rule that breaks a clause at once needs no step.
            let is_game = |step: &Value| step["made"].is_object() || step["over"]["broken"][0].is_object();
            assert!(made.iter().any(is_game), "{settings}: {opened}");
            let again = ask(&mut Page::default(), &json!({ "do": "open", "settings": settings, "steps": 6 }));
            assert_eq!(opened, again, "{settings}");
        }
    }
}

#[test]
fn what_is_decided_by_hand_is_the_same_game_when_it_is_made_at_once() {
    let list = ask(&mut Page::default(), &json!({ "do": "schemes" }));
    let mut asking = Vec::new();
    for scheme in list["schemes"].as_array().expect("a list") {
        let mut settings = settings(scheme, &scheme["rules"][0]);
        settings["world"] = json!(scheme["by_hand"] == "world" || scheme["by_hand"] == "only");
        let mut page = Page::default();
        ask(&mut page, &json!({ "do": "open", "settings": settings }));
        let (mut made, mut answers, mut questions) = (Vec::new(), json!([]), 0);
        while made.len() < 4 {
            let mut step = ask(&mut page, &json!({ "do": "step", "by_hand": true }));
            while let Some(options) = step["question"]["options"].as_array() {
                assert_eq!(step["would"].as_array().map(Vec::len), Some(options.len()), "{step}");
                questions += 1;
                let last = options.len() - 1;
                step = ask(&mut page, &json!({ "do": "step", "by_hand": true, "answers": [last] }));
            }
            answers = step["answers"].clone();
            made.extend(step["made"].as_array().expect("a list").clone());
            if made.last().is_none_or(|step| step["over"].is_object()) {
                break;
            }
        }
        let open = json!({ "do": "open", "settings": settings, "answers": answers, "steps": made.len() });
        assert_eq!(ask(&mut Page::default(), &open)["made"], Value::from(made), "{settings}");
        if questions > 0 {
            asking.push(scheme["name"].as_str().expect("a name").to_owned());
        }
    }
    // The page knows no scheme; a test may.
    for name in ["chain", "ants", "bricks", "kit", "frontier", "notice", "mrc"] {
        assert!(asking.iter().any(|asked| asked == name), "{name} asks nothing: {asking:?}");
    }
}

#[test]
fn in_every_scheme_that_has_conditions_some_step_shows_what_one_of_them_does() {
    let list = ask(&mut Page::default(), &json!({ "do": "schemes" }));
    let shows = |settings: &Value| {
        let mut page = Page::default();
        ask(&mut page, &json!({ "do": "open", "settings": settings }));
        (0..40).any(|_| {
            let all = ask(&mut page, &json!({ "do": "refusals" }));
            ask(&mut page, &json!({ "do": "step", "steps": 1 }));
            let mut refused = all["refused"].as_array().into_iter().flatten();
            refused.any(|one| one["by"][0].is_string()) || all["without"][0].is_object()
        })
    };
    for scheme in list["schemes"].as_array().expect("a list") {
        let rules = scheme["rules"].as_array().expect("a list").iter();
        let mut switched = rules.filter(|rule| rule["conditions"].is_array()).peekable();
        let is_shown = switched.peek().is_none()
            || switched.any(|rule| {
                let mut settings = settings(scheme, rule);
                settings["robots"] = json!(settings["robots"].as_u64().max(Some(3)));
                // Rooms with doors, in which agents meet.
                settings["ground"] = json!(["a2b3a", "a2ba1ba", "4a1ba", "a2ba1ba", "6a", "a4ba"]);
                settings["world"] = json!(scheme["by_hand"] == "only" || scheme["by_hand"] == "world");
                shows(&settings)
            });
        assert!(is_shown, "{}", scheme["name"]);
    }
}

#[test]
fn every_hunt_is_made_in_slices_and_its_findings_are_played() {
    let list = ask(&mut Page::default(), &json!({ "do": "schemes" }));
    let mut hunted = Vec::new();
    for (name, rule, bounds) in [
        ("kit", "published", json!({ "robots": 2, "size": [2, 2] })),
        ("frontier", "published", json!({ "robots": 2, "size": [2, 2] })),
        ("ants", "published", json!({ "size": [3, 2] })),
        ("bricks", "published", json!({ "size": [3, 2] })),
    ] {
        let schemes = list["schemes"].as_array().expect("a list");
        let scheme = schemes.iter().find(|scheme| scheme["name"] == name).expect("a scheme");
        let settings = settings(scheme, &json!({ "name": rule }));
        let mut page = Page::default();
        ask(&mut page, &json!({ "do": "hunt", "settings": settings, "bounds": bounds }));
        while ask(&mut page, &json!({ "do": "slice" }))["more"] == true {}
        let found = ask(&mut page, &json!({ "do": "found" }));
        assert_eq!(found["complete"], true, "{name}");
        for one in found["found"].as_array().expect("a list") {
            let open = json!({ "do": "open", "settings": one["settings"], "steps": 1000 });
            let opened = ask(&mut Page::default(), &open);
            let last = opened["made"].as_array().and_then(|made| made.last()).cloned().unwrap_or_default();
            let is_over = last["over"].is_object();
            hunted.push(format!("{name} {} {is_over}", one["clause"].as_str().unwrap_or_default()));
        }
    }
    assert!(hunted.iter().any(|one| one.starts_with("kit KIT-3 ")), "{hunted:?}");
    assert!(hunted.iter().any(|one| one.starts_with("frontier FRONTIER-")), "{hunted:?}");
}

#[test]
fn a_rule_that_is_played_by_hand_is_itself_or_refused() {
    let list = ask(&mut Page::default(), &json!({ "do": "schemes" }));
    let schemes = list["schemes"].as_array().expect("a list");
    let opened = |name: &str, rule: &str| {
        let scheme = schemes.iter().find(|scheme| scheme["name"] == name).expect("a scheme");
        let mut settings = settings(scheme, &json!({ "name": rule }));
        settings["world"] = json!(true);
        let open = json!({ "do": "open", "settings": settings, "steps": 30 });
        Page::default().answer(&open.to_string())
    };
    let games = ["published", "repaired", "ahead"].map(|rule| opened("kit", rule));
    assert!(games[0] != games[1] && games[1] != games[2] && games[2] != games[0], "{games:?}");
    for name in ["frontier", "mrc", "notice"] {
        let refused = opened(name, "hungarian");
        assert!(
            refused.contains("hungarian asks nothing") && refused.contains("take published or "),
            "{refused}"
        );
    }
}

/// Agent 1 of two is done before agent 2 enters the last cell in the same team move.
#[test]
fn an_agent_that_is_done_too_early_is_not_said_to_leave_no_cell() {
    let settings =
        json!({ "scheme": "mdfs", "rule": "published", "robots": 2, "ground": ["5a"], "base": [0, 0] });
    let mut page = Page::default();
    let bounds = json!({ "robots": 2, "max_misses": 0 });
    ask(&mut page, &json!({ "do": "hunt", "settings": settings, "bounds": bounds }));
    while ask(&mut page, &json!({ "do": "slice" }))["more"] == true {}
    let found = ask(&mut page, &json!({ "do": "found" }));
    let found = found["found"].as_array().expect("a list");
    let early = found.iter().find(|one| one["clause"] == "BRICKS-4").expect("a finding");
    let opened =
        ask(&mut page, &json!({ "do": "open", "settings": early["settings"], "steps": 1000 })).to_string();
    assert!(opened.contains("is done before all other cells are explored and gone through"), "{opened}");
    assert!(!opened.contains("with 0 cells"), "{opened}");
}
