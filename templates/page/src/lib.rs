//! The rule of the folder beside this one on a page to draw on. Copy both folders, and change here
//! the surroundings and the promises. `web/build --rule FOLDER` makes one HTML file of it: there the
//! rule is run, decided by hand, and hunted.
//!
//! The robots move one at a time, in any order.

use my_rule::{East, STARTS};
use tautline_proofs::team::{Demand, Ground, Moves, Places, Senses, Setting, Which};
use tautline_sim::explore::{self, Clause, OwnRule, Profile, RuleId};
use tautline_web::own::OwnPage;

/// The surroundings of the rule: every layout of 4×2 cells with at most two walls on the way.
static SETTING: Setting<'_, East> = Setting {
    senses: Senses::TEAM,
    moves: Moves::OneAtATime,
    demands: &[Demand::always("EAST-1", "the robots are in different cells", &|moved| {
        moved.after.cells_differ()
    })],
    ..Setting::new("east", Ground::open(4, 2).walls(Which::Met(2)), 2, Places::At(|_| STARTS.to_vec()))
};

const OURS: OwnRule<East> = OwnRule { setting: &SETTING, rule: East { looks: true } };
const BLIND: OwnRule<East> = OwnRule { setting: &SETTING, rule: East { looks: false } };

/// The row of the scheme on the page.
static SCHEME: Profile = Profile {
    about: "Two robots go east, one behind the other",
    rules: &[
        explore::Rule::new(RuleId::new("ours"), "The second robot waits for the first", |setup| {
            OURS.start(setup)
        })
        .hunted(&OURS),
        explore::Rule::new(RuleId::new("blind"), "The second robot does not look", |setup| {
            BLIND.start(setup)
        })
        .hunted(&BLIND),
    ],
    robots: 2..=2,
    clauses: &[Clause::new("EAST-1")],
    ..Profile::named("east")
};

tautline_web::page!(OwnPage {
    scheme: &SCHEME,
    sentences: &[("EAST-1", "The robots MUST never share a cell.")],
    size: SETTING.ground.size,
    starts: &STARTS,
});

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};
    use tautline_web::Page;

    /// The answer of the page.
    fn ask(page: &mut Page, request: &Value) -> Value {
        super::page_begin();
        let answer: Value = serde_json::from_str(&page.answer(&request.to_string())).expect("JSON");
        assert!(answer["error"].is_null(), "{request}: {answer}");
        answer
    }

    /// The findings of the hunt of a rule.
    fn found(rule: &str) -> Value {
        let mut page = Page::default();
        let settings = json!({ "scheme": "east", "rule": rule, "robots": 2, "ground": ["4a", "4a"] });
        ask(&mut page, &json!({ "do": "hunt", "settings": settings, "bounds": {} }));
        while ask(&mut page, &json!({ "do": "slice" }))["more"] == true {}
        ask(&mut page, &json!({ "do": "found" }))
    }

    #[test]
    fn the_rule_is_hunted_and_what_breaks_it_is_played() {
        assert_eq!(found("ours")["found"], json!([]));
        let blind = found("blind");
        let one = &blind["found"][0];
        assert_eq!((&one["clause"], &blind["complete"]), (&json!("EAST-1"), &json!(true)));
        assert_eq!(one["sentence"], "The robots MUST never share a cell.");
        let open = json!({ "do": "open", "settings": one["settings"], "steps": 100 });
        let opened = ask(&mut Page::default(), &open);
        let made = opened["made"].as_array().expect("a list");
        assert!(made.iter().any(|step| step["made"]["broken"][0]["clause"] == "EAST-1"), "{opened}");
    }

    #[test]
    fn who_acts_is_decided_by_hand() {
        let mut page = Page::default();
        let settings = json!({ "scheme": "east", "rule": "blind", "robots": 2, "ground": ["4a", "4a"] });
        ask(&mut page, &json!({ "do": "open", "settings": settings }));
        let step = ask(&mut page, &json!({ "do": "step", "by_hand": true }));
        assert_eq!(step["question"]["options"], json!(["robot 0", "robot 1"]));
        assert_eq!(step["question"]["words"], "Who acts next?");
    }
}
