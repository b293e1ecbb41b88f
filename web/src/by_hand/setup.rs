//! The world that settings ask for: its rule, its team and its start, and the search of every order in it.

use serde_json::{Value, json};
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::conditions::Conditional;
use tautline_kernel::ground::{Area, Cell};
use tautline_proofs::engine::states::{self, Ending, Limits, System};
use tautline_sim::explore::ClauseId;

use crate::play::Play;
use crate::settings::Settings;

/// A world with these settings, at its start.
pub(super) type Start = fn(&Settings) -> Result<Box<dyn Play>, Diagnostic>;

/// A scheme whose world is played by hand.
pub(crate) struct ByHand {
    /// Its name.
    pub(crate) name: &'static str,
    /// Its world with these settings, at its start.
    pub(super) start: Start,
    /// The row that a page shows, and how it is hunted, if no catalogue has one.
    pub(crate) row: Option<(fn() -> Value, Search)>,
}

/// Searches every order of what may happen in the world of these settings, for at most so many steps.
pub(crate) type Search = fn(&Settings, u64) -> Result<HuntFindings, Diagnostic>;

/// The findings of such a search.
pub(crate) struct HuntFindings {
    pub(crate) states: u64,
    pub(crate) is_complete: bool,
    pub(crate) found: Vec<Order>,
}

/// An order that breaks a clause.
pub(crate) struct Order {
    pub(crate) clause: &'static str,
    /// The answers that make it, and how many steps it has.
    pub(crate) answers: Vec<i32>,
    pub(crate) steps: usize,
    /// How many of them, the last ones, come over and over.
    pub(crate) round: usize,
    /// Whether it is broken by the end of the run.
    pub(crate) is_still: bool,
}

/// Searches every order of what may happen in `world` from `state` on; of demands with one clause the first is told.
pub(super) fn search<W: System>(
    world: &W,
    state: &W::State,
    most_steps: u64,
    clause: impl Fn(W::Demand) -> Option<&'static str>,
) -> HuntFindings {
    let limits = Limits { most_steps, ..Limits::NONE };
    let findings = states::search(world, [state.clone()], limits);
    let mut found: Vec<Order> = Vec::new();
    for run in &findings.broken {
        let Some(clause) = clause(run.demand).filter(|&clause| found.iter().all(|one| one.clause != clause))
        else {
            continue;
        };
        // That nothing happens any more is seen by one step more.
        let is_still = run.ending == Ending::Still;
        let round = run.round().len();
        let (mut state, mut order) =
            (state.clone(), Order { clause, answers: Vec::new(), steps: 0, round, is_still });
        for &number in run.steps.iter().chain(run.round()) {
            let mut next: Vec<W::State> = states::steps(world, &state).map(|step| step.state).collect();
            // What alone can happen is no question.
            order.answers.extend((next.len() > 1).then_some(number as i32));
            order.steps += 1;
            state = next.swap_remove(number as usize);
        }
        found.push(order);
    }
    found.sort_by_key(|order| ClauseId::new(order.clause));
    HuntFindings { states: findings.states, is_complete: findings.is_whole, found }
}

/// The row of a rule of a world, of which every order is hunted through.
pub(super) fn of_world<R: Conditional>(name: &str, about: &str, rule: &R) -> Value {
    let conditions = switched(R::CONDITIONS, rule.in_force());
    json!({ "name": name, "about": about, "conditions": conditions, "hunt": [] })
}

/// The conditions of a rule, each by its name, its sentence, and whether it is in force.
pub(crate) fn switched(conditions: &[(&str, &str)], in_force: u32) -> Value {
    let row = |(bit, (name, sentence)): (u32, &(&str, &str))| {
        let is_on = in_force >> bit & 1 == 1;
        json!({ "name": name, "sentence": sentence.trim(), "on": is_on })
    };
    (0..).zip(conditions).map(row).collect()
}

/// The world of so many robots as the settings say, of which `of` has one for each number from one on.
pub(super) fn small_team<const MOST: usize>(
    settings: &Settings,
    of: [Start; MOST],
) -> Result<Box<dyn Play>, Diagnostic> {
    let start = usize::from(settings.robots).checked_sub(1).and_then(|place| of.get(place));
    let start = start.ok_or_else(|| {
        let what = format!("{} robots are too many to play every order of theirs by hand", settings.robots);
        Diagnostic::of_field("robots", what, format!("take 1 to {MOST}"))
    })?;
    start(settings)
}

/// The rule of this name among `rules`, with the conditions that are switched on.
pub(super) fn chosen<R: Conditional>(rules: &[(&str, R)], settings: &Settings) -> Result<R, Diagnostic> {
    let found = rules.iter().find(|(name, _)| *name == settings.rule);
    let &(_, rule) = found.ok_or_else(|| {
        let names: Vec<&str> = rules.iter().map(|&(name, _)| name).collect();
        let what = format!("the rule {} asks nothing that could be decided by hand", settings.rule);
        Diagnostic::of_field("rule", what, format!("take {}", names.join(" or ")))
    })?;
    Ok(settings.on.map_or(rule, |on| rule.with_in_force(on)))
}

/// The fault of a layout that a small world does not hold.
pub(super) fn too_large() -> Diagnostic {
    Diagnostic::of_field("layout", "the layout is too large to be played by hand", "take a smaller one")
}

/// The cells in which actors start: those of the settings, and then those nearest to the middle.
pub(super) fn starts(settings: &Settings, area: Area, count: usize) -> Vec<Cell> {
    let middle = |first: i16, last: i16| i32::from(first) + i32::from(last);
    let (x, y) = (middle(area.first().x, area.last().x), middle(area.first().y, area.last().y));
    let mut rest: Vec<Cell> = area.cells().filter(|cell| !settings.starts.contains(cell)).collect();
    rest.sort_by_key(|cell| (2 * i32::from(cell.x) - x).pow(2) + (2 * i32::from(cell.y) - y).pow(2));
    settings.starts.iter().copied().chain(rest).take(count).collect()
}

/// A whole number among the options.
pub(super) fn number(settings: &Settings, field: &str, usual: u8, most: u8) -> Result<u8, Diagnostic> {
    let Some(text) = settings.options.get(field) else { return Ok(usual) };
    text.parse().ok().filter(|&number| number <= most).ok_or_else(|| {
        let what = format!("`{field}` is {text:?}, and not a number from 0 to {most}");
        Diagnostic::usage(what, "give it another value, or leave it out")
    })
}
