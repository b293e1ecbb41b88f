//! The schemes as data: what a page needs to offer each of them.

use serde_json::{Value, json};
use tautline_sim::explore::hunt::{Bound, Hunt};
use tautline_sim::explore::{Catalogue, Rule, Scheme, Senses, Starts};
use tautline_sim::options::{Extra, Takes};

/// All schemes.
pub(crate) fn list() -> Value {
    let schemes: Vec<Value> = Catalogue::OWN.schemes().map(scheme).collect();
    json!({ "version": env!("CARGO_PKG_VERSION"), "schemes": schemes })
}

fn scheme(scheme: Scheme) -> Value {
    let starts = match scheme.starts {
        Starts::Base => "base",
        Starts::Anywhere => "anywhere",
        Starts::Beside => "beside",
        Starts::Alone => "alone",
    };
    json!({
        "name": scheme.name,
        "about": scheme.about,
        "team": scheme.team,
        "robot": scheme.look.robot(),
        "robots": [scheme.robots.start(), scheme.robots.end()],
        "base": scheme.look.has_base(),
        "starts": starts,
        "misses": scheme.senses == Senses::Floor,
        "draws": !scheme.drawn.is_empty(),
        "options": scheme.extras.iter().map(|extra| option(extra)).collect::<Vec<_>>(),
        "rules": scheme.rules.iter().map(rule).collect::<Vec<_>>(),
    })
}

fn option(extra: &Extra) -> Value {
    let takes = match extra.takes {
        Takes::Nothing => None,
        Takes::Word(word) | Takes::Real(word) => Some(word),
    };
    json!({ "field": extra.field, "about": extra.about, "takes": takes })
}

fn rule(rule: &Rule) -> Value {
    let switches = rule.switches.map(|switches| {
        let conditions: Vec<Value> = (0..)
            .zip(switches.conditions())
            .map(|(bit, (name, sentence))| {
                json!({ "name": name, "sentence": sentence.trim(), "on": switches.in_force() >> bit & 1 == 1 })
            })
            .collect();
        json!(conditions)
    });
    let hunt = rule.hunt.map(|hunt: &dyn Hunt| {
        let bounds: Vec<&str> =
            hunt.takes().iter().filter(|&&bound| bound != Bound::Resume).map(|bound| bound.field()).collect();
        json!(bounds)
    });
    json!({ "name": rule.name, "about": rule.about, "conditions": switches, "hunt": hunt })
}
