//! The schemes as data: what a page needs to offer each of them.

use serde_json::{Value, json};
use tautline_sim::explore::hunt::{Bound, Hunt};
use tautline_sim::explore::{Rule, Scheme, Senses, Starts};
use tautline_sim::options::{Extra, Takes};

use crate::by_hand::{WORLDS, switched};
use crate::own::{self, OwnPage};
use crate::settings::Settings;

/// All schemes.
pub(crate) fn list() -> Value {
    let own = own::catalogue().schemes().map(scheme);
    let worlds = WORLDS.iter().filter_map(|world| Some(world.row?.0()));
    let schemes: Vec<Value> = own.chain(worlds).collect();
    json!({ "version": env!("CARGO_PKG_VERSION"), "schemes": schemes })
}

fn scheme(scheme: Scheme) -> Value {
    let starts = match scheme.starts {
        Starts::Base => "base",
        Starts::Anywhere => "anywhere",
        Starts::Beside => "beside",
        Starts::Alone => "alone",
    };
    let by_hand = match scheme.senses {
        _ if WORLDS.iter().any(|world| world.name == scheme.name) => "world",
        Senses::Bumps if own::page().is_some_and(|page| page.scheme.name == scheme.name) => "choices",
        Senses::Bumps => "sides",
        Senses::Floor => "sensors",
    };
    json!({
        "name": scheme.name,
        "opens": own::page().filter(|page| page.scheme.name == scheme.name).map(OwnPage::opens),
        "about": scheme.about,
        "team": scheme.team,
        "robot": scheme.look.robot(),
        "robots": [scheme.robots.start(), scheme.robots.end()],
        "base": scheme.look.has_base(),
        "starts": starts,
        "misses": scheme.senses == Senses::Floor,
        "draws": !scheme.drawn.is_empty(),
        "by_hand": by_hand,
        "options": scheme.extras.iter().map(|extra| option(extra)).collect::<Vec<_>>(),
        "rules": scheme.rules.iter().map(rule).collect::<Vec<_>>(),
    })
}

/// The names of the conditions of the rule of these settings, and those that are its own, a bit for each.
pub(crate) fn conditions(settings: &Settings) -> Option<(Vec<String>, u32)> {
    let list = list();
    let named = |all: &Value, name: &str| all.as_array()?.iter().find(|one| one["name"] == name).cloned();
    let rule = named(&named(&list["schemes"], &settings.scheme)?["rules"], &settings.rule)?;
    let all = rule["conditions"].as_array()?;
    let in_force =
        (0..).zip(all).filter(|(_, one)| one["on"] == true).fold(0, |bits, (bit, _)| bits | 1 << bit);
    Some((all.iter().filter_map(|one| Some(one["name"].as_str()?.to_owned())).collect(), in_force))
}

fn option(extra: &Extra) -> Value {
    let takes = match extra.takes {
        Takes::Nothing => None,
        Takes::Word(word) | Takes::Real(word) => Some(word),
    };
    json!({ "field": extra.field, "about": extra.about, "takes": takes })
}

fn rule(rule: &Rule) -> Value {
    let switches = rule.switches.map(|switches| switched(switches.conditions(), switches.in_force()));
    let hunt = rule.hunt.map(|hunt: &dyn Hunt| {
        let bounds: Vec<&str> =
            hunt.takes().iter().filter(|&&bound| bound != Bound::Resume).map(|bound| bound.field()).collect();
        json!(bounds)
    });
    json!({ "name": rule.name, "about": rule.about, "conditions": switches, "hunt": hunt })
}
