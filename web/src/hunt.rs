//! Hunts in slices, so that a page can show how far they are and stop them. A hunt that can be made a little at a time
//! is; any other one is made again with four times the budget, which costs a third more at most.

use std::fmt::Write;
use std::ops::ControlFlow;

use serde::Deserialize;
use serde_json::{Value, json};
use tautline_grids::layout::Size;
use tautline_io::diagnostic::Diagnostic;
use tautline_proofs::plural::counted;
use tautline_sim::explore::hunt::{
    Bound, Exhibit, Far, Finding, Hunt, HuntReport, HuntRequest, Hunter, OngoingHunt,
};
use tautline_sim::explore::{Scheme, hunt};

use crate::by_hand::{self, HuntFindings, Order, Search};
use crate::clauses::sentence;
use crate::play::json as written;
use crate::settings::Settings;

/// The bounds of a hunt; what is not given is the hunt's to choose.
#[derive(Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct HuntBounds {
    robots: Option<u64>,
    size: Option<[u64; 2]>,
    max_walls: Option<u32>,
    max_misses: Option<u8>,
    max_losses: Option<u8>,
    error: Option<f64>,
}

/// Steps of the first slice of a hunt that is made again and again.
const FIRST: u64 = 1 << 14;

/// Team moves of a slice of a hunt that is made a little at a time.
const SLICE: u64 = 1 << 17;

/// Team moves by which it is known how many a hunt takes.
const PROBE: u64 = 1 << 20;

/// Steps after which a hunt that is made again and again is one for a terminal.
const MANY: u64 = 1 << 22;

/// A hunt of more expected team moves is one for a terminal: minutes of a browser's one thread.
const MOST_MOVES: f64 = 4e8;

/// A hunt on its way: of a row of the catalogue, or through every order of a world.
pub(crate) enum Hunting {
    Row(Box<RowHunt>),
    World(Box<WorldHunt>),
}

impl Hunting {
    /// The hunt of the rule of these settings, at its start, with the command that hunts so in a terminal.
    pub(crate) fn begin(settings: &Settings, bounds: HuntBounds) -> Result<(Self, Value), Diagnostic> {
        if let Some(search) = by_hand::hunt(settings) {
            let hunting = WorldHunt { settings: settings.clone(), search, budget: FIRST, last: None };
            return Ok((Self::World(Box::new(hunting)), json!({ "command": null })));
        }
        let (hunting, begun) = RowHunt::begin(settings, bounds)?;
        Ok((Self::Row(Box::new(hunting)), begun))
    }

    /// Hunts a little further.
    pub(crate) fn slice(&mut self) -> Result<Value, Diagnostic> {
        match self {
            Self::Row(hunt) => hunt.slice(),
            Self::World(hunt) => hunt.slice(),
        }
    }

    /// The findings so far.
    pub(crate) fn found(&self) -> Result<Value, Diagnostic> {
        match self {
            Self::Row(hunt) => hunt.found(),
            Self::World(hunt) => Ok(hunt.found()),
        }
    }
}

/// A hunt through every order of what may happen in a world, made again with four times the budget until it is whole.
pub(crate) struct WorldHunt {
    settings: Settings,
    search: Search,
    budget: u64,
    last: Option<HuntFindings>,
}

impl WorldHunt {
    fn slice(&mut self) -> Result<Value, Diagnostic> {
        let hunted = (self.search)(&self.settings, self.budget)?;
        let (made, more) = (self.budget, !hunted.is_complete);
        self.budget = self.budget.saturating_mul(4);
        let far = format!("searching, states {}", hunted.states);
        self.last = Some(hunted);
        let words = (more && made >= MANY).then(|| too_many(made));
        Ok(json!({ "more": more, "moves": made, "far": far, "large": words.is_some(), "words": words }))
    }

    fn found(&self) -> Value {
        let Some(HuntFindings { states, is_complete, found }) = &self.last else {
            return json!({ "found": [] });
        };
        let outcome = match (found.is_empty(), is_complete) {
            (true, true) => "No clause that is looked for is broken, whatever happens in which order.",
            (true, false) => "No clause that is looked for is broken so far.",
            (false, _) => "The shortest order of events that breaks each clause:",
        };
        let order = |order: &Order| {
            let round = match order.round {
                0 => String::new(),
                steps => format!(", of which the last {steps} come over and over"),
            };
            let steps = counted(order.steps, "step") + &round;
            json!({
                "clause": order.clause, "sentence": sentence(order.clause), "title": steps,
                "settings": written(&self.settings), "answers": order.answers,
                "steps": order.steps + usize::from(order.is_still),
            })
        };
        let Settings { scheme, rule, .. } = &self.settings;
        json!({
            "title": format!("{scheme} ({rule}), every order: {}", counted(*states, "state")),
            "outcome": outcome,
            "complete": is_complete,
            "found": found.iter().map(order).collect::<Vec<_>>(),
        })
    }
}

/// The words about a hunt that is one for a terminal.
fn too_many(made: u64) -> String {
    format!("This hunt takes more than {} million steps, and as many states.", made >> 20)
}

/// A hunt of a row of the catalogue.
pub(crate) struct RowHunt {
    scheme: Scheme,
    settings: Settings,
    bounds: HuntBounds,
    hunt: Box<dyn Hunt>,
    how: How,
    /// How far it is, in words.
    far: String,
}

enum How {
    /// A little at a time.
    Begun(Box<dyn OngoingHunt>),
    /// With a budget for the next slice, and what the last one has found.
    Again(u64, Option<Box<HuntReport>>),
}

/// Hears nothing but how far it is.
struct Listener<'a>(&'a mut String);

impl Hunter for Listener<'_> {
    fn hears(&mut self, far: Far<'_>) -> ControlFlow<()> {
        if let Far::Words(words) = far {
            *self.0 = words;
        }
        ControlFlow::Continue(())
    }

    fn is_left_out(&mut self, _: &Diagnostic) {}
}

impl RowHunt {
    fn begin(settings: &Settings, bounds: HuntBounds) -> Result<(Self, Value), Diagnostic> {
        let (scheme, rule) = (settings.scheme()?, settings.rule()?);
        let nothing = || scheme.not_hunted();
        let hunt = match (settings.switched(), rule.switches) {
            (Some(on), Some(switches)) => switches.hunt(on).ok_or_else(nothing)?,
            _ => Box::new(CatalogueHunt(rule.hunt.ok_or_else(nothing)?)),
        };
        let mut hunting = Self {
            scheme,
            settings: settings.clone(),
            bounds,
            hunt,
            how: How::Again(FIRST, None),
            far: String::new(),
        };
        let asked = hunting.asked()?;
        asked.check(&*hunting.hunt)?;
        if let Some(begun) = hunting.hunt.begin(&asked)? {
            hunting.how = How::Begun(begun);
        }
        let command = hunting.command();
        Ok((hunting, json!({ "command": command })))
    }

    /// The request, without a budget. The only option that a hunt takes is how far robots hear each other.
    fn asked(&self) -> Result<HuntRequest<'static>, Diagnostic> {
        let HuntBounds { robots, size, max_walls, max_misses, max_losses, error } = self.bounds;
        let size = size.map(|[columns, rows]| Size::new(columns, rows)).transpose()?;
        let rule = self.settings.rule()?.name;
        let (error_cells, range_cells, others) = (error, self.range_cells()?, hunt::HuntBounds::default());
        let others = hunt::HuntBounds { error_cells, range_cells, ..others };
        let bounds = hunt::HuntBounds { robots, size, max_walls, max_misses, max_losses, ..others };
        Ok(HuntRequest { bounds, ..HuntRequest::new(self.scheme, rule) })
    }

    fn range_cells(&self) -> Result<Option<u16>, Diagnostic> {
        let mut others = self.settings.options.keys().filter(|&field| field != Bound::Range.field());
        if let Some(field) = others.next() {
            let what = format!("no hunt looks at the option `{field}`");
            let remedy = "take it back under More options, or run single layouts with it";
            return Err(Diagnostic::usage(what, remedy));
        }
        Ok(self.settings.options()?.range_cells)
    }

    /// How one hunts so in a terminal; a rule whose conditions are switched only a page hunts.
    fn command(&self) -> Option<String> {
        if self.settings.switched().is_some() {
            return None;
        }
        let HuntBounds { robots, size, max_walls, max_misses, max_losses, error } = &self.bounds;
        let mut command =
            format!("tautline hunt --scheme {} --rule {}", self.settings.scheme, self.settings.rule);
        let mut tell = |field: &str, value: Option<String>| {
            if let Some(value) = value {
                // Writing to a string cannot fail.
                let _ = write!(command, " --{field} {value}");
            }
        };
        tell("robots", robots.map(|robots| robots.to_string()));
        tell("size", size.map(|[columns, rows]| format!("{columns}x{rows}")));
        tell("max-walls", max_walls.map(|walls| walls.to_string()));
        tell("max-misses", max_misses.map(|misses| misses.to_string()));
        tell("max-losses", max_losses.map(|losses| losses.to_string()));
        tell("error", error.map(|error| error.to_string()));
        tell("range", self.settings.options.get(Bound::Range.field()).cloned());
        Some(command)
    }

    /// Hunts a little further.
    fn slice(&mut self) -> Result<Value, Diagnostic> {
        let asked = self.asked()?;
        match &mut self.how {
            How::Begun(begun) => {
                let until = begun.progress().moves + SLICE;
                let mut has_more = true;
                while has_more && begun.progress().moves < until {
                    has_more = begun.step();
                }
                let progress = begun.progress();
                let expected = progress.expected_moves();
                let is_large = progress.moves >= PROBE && expected.is_some_and(|moves| moves > MOST_MOVES);
                Ok(json!({
                    "more": has_more,
                    "runs": progress.runs,
                    "moves": progress.moves,
                    "expected": expected,
                    "large": is_large,
                    "walls": progress.levels.len(),
                }))
            }
            How::Again(budget, last) => {
                let far = &mut self.far;
                let report =
                    self.hunt.hunt(&HuntRequest { budget: Some(*budget), ..asked }, &mut Listener(far))?;
                let more = !report.is_complete;
                let made = *budget;
                (*budget, *last) = (budget.saturating_mul(4), Some(Box::new(report)));
                let words = (more && made >= MANY).then(|| too_many(made));
                Ok(json!({
                    "more": more, "moves": made, "far": self.far, "large": words.is_some(), "words": words,
                }))
            }
        }
    }

    /// The findings so far.
    fn found(&self) -> Result<Value, Diagnostic> {
        let report = match &self.how {
            How::Begun(begun) => begun.report(&self.asked()?)?,
            How::Again(_, Some(report)) => (**report).clone(),
            How::Again(_, None) => return Ok(json!({ "found": [] })),
        };
        let HuntReport { title, outcome, is_complete, found, facts, .. } = &report;
        Ok(json!({
            "title": title,
            "outcome": outcome,
            "complete": is_complete,
            "facts": written(facts),
            "found": found.iter().map(|finding| self.finding(finding)).collect::<Vec<_>>(),
        }))
    }

    fn finding(&self, finding: &Finding) -> Value {
        let story = match &finding.shown {
            Exhibit::Run(_) | Exhibit::Endless => None,
            Exhibit::Story(_, story) | Exhibit::Told(story) => Some(story),
        };
        json!({
            "clause": finding.clause,
            "sentence": sentence(finding.clause),
            "title": finding.title,
            "facts": written(&finding.facts),
            "story": story,
            "settings": written(&Settings::of(&finding.setup, self.settings.on)),
        })
    }
}

/// A hunt that stands in a catalogue.
#[derive(Debug)]
struct CatalogueHunt(&'static dyn Hunt);

impl Hunt for CatalogueHunt {
    fn takes(&self) -> &'static [Bound] {
        self.0.takes()
    }

    fn refusal(&self, bound: Bound) -> (String, String) {
        self.0.refusal(bound)
    }

    fn hunt(&self, asked: &HuntRequest<'_>, hunter: &mut dyn Hunter) -> Result<HuntReport, Diagnostic> {
        self.0.hunt(asked, hunter)
    }

    fn begin(&self, asked: &HuntRequest<'_>) -> Result<Option<Box<dyn OngoingHunt>>, Diagnostic> {
        self.0.begin(asked)
    }
}
