//! The settings of a game, as a link holds them.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use tautline_grids::chance::Probability;
use tautline_grids::layout::{Layout, Size};
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::{Cell, Edge, Side};
use tautline_sim::draw::page::film;
use tautline_sim::explore::{ExplorationRequest, Limits, Rule, Scheme, Setup, Starts, Team};
use tautline_sim::options::{Extra, Options};

use crate::own;

/// The settings of a game.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// The scheme.
    pub scheme: String,
    /// One of its rules.
    pub rule: String,
    /// The conditions in force, a bit for each, where they are not the rule's own.
    pub on: Option<u32>,
    /// Robots, the base counted if there is one.
    pub robots: u16,
    /// The seed of whatever is left to chance.
    pub seed: u64,
    /// Row by row, a letter for so many cells: `a`, one letter more if they are blocked, two for a wall in the east and
    /// four for one in the south.
    pub ground: Vec<String>,
    /// The base.
    pub base: Option<Cell>,
    /// Where each robot starts, if not all start at the base.
    pub starts: Vec<Cell>,
    /// The options that are told, as they are typed.
    pub options: BTreeMap<String, String>,
    /// How likely it is that an agent misses a sensor.
    pub miss: f64,
    /// The sensors that are missed besides, by their numbers.
    pub missed: Vec<u32>,
    /// The choices that make the run, where a search has found it.
    pub choices: Vec<u32>,
    /// The clause at whose violation the run stops.
    pub stop: Option<String>,
    /// Whether it is a world of the proofs, which asks about everything.
    pub world: bool,
}

/// The bits of a letter of the ground.
const BLOCKED: u8 = 1;
const EAST: u8 = 2;
const SOUTH: u8 = 4;

impl Settings {
    /// The settings that make the run of `setup`, with these conditions in force.
    pub(crate) fn of(setup: &Setup, on: Option<u32>) -> Self {
        let Setup {
            scheme,
            rule,
            robots,
            seed,
            layout,
            base,
            starts,
            miss,
            missed,
            options,
            choices,
            limits,
        } = setup;
        let typed = |extra: &&Extra| Some((extra.field.to_owned(), (extra.typed)(options)?));
        Self {
            scheme: scheme.name.to_owned(),
            rule: rule.to_string(),
            on,
            robots: *robots,
            seed: *seed,
            ground: ground(layout),
            base: Some(*base),
            starts: starts.clone().unwrap_or_default(),
            options: Extra::ALL.iter().filter_map(typed).collect(),
            miss: f64::from(*miss),
            missed: missed.clone(),
            choices: choices.clone(),
            stop: limits.stop().map(|clause| clause.to_string()),
            world: false,
        }
    }

    /// The scheme.
    pub(crate) fn scheme(&self) -> Result<Scheme, Diagnostic> {
        own::catalogue().scheme(&self.scheme).ok_or_else(|| {
            let what = format!("this page does not know the scheme {:?}", self.scheme);
            Diagnostic::of_field("scheme", what, "take a scheme of the list")
        })
    }

    /// The rule.
    pub(crate) fn rule(&self) -> Result<&'static Rule, Diagnostic> {
        let scheme = self.scheme()?;
        scheme.rules.iter().find(|rule| rule.name.as_str() == self.rule).ok_or_else(|| {
            let what = format!("{} has no rule {:?}", scheme.name, self.rule);
            Diagnostic::of_field("rule", what, scheme.which_rule())
        })
    }

    /// The layout, without a base.
    pub(crate) fn layout(&self) -> Result<Layout, Diagnostic> {
        let wrong = || Diagnostic::of_field("layout", "the ground is damaged", "draw it anew");
        let rows: Option<Vec<Vec<u8>>> = self.ground.iter().map(|row| letters(row)).collect();
        let rows = rows.ok_or_else(wrong)?;
        let width = rows.first().map_or(0, Vec::len);
        if rows.iter().any(|row| row.len() != width) {
            return Err(wrong());
        }
        let mut layout = Layout::of(Size::new(width as u64, rows.len() as u64)?);
        for (y, row) in (0..).zip(&rows) {
            for (x, &letter) in (0..).zip(row) {
                let cell = Cell::new(x, y);
                if letter & BLOCKED != 0 {
                    layout.block(cell);
                }
                for (bit, side) in [(EAST, Side::East), (SOUTH, Side::South)] {
                    if letter & bit != 0 {
                        layout.build_wall(Edge::new(cell, side));
                    }
                }
            }
        }
        Ok(layout)
    }

    /// The options that are told.
    pub(crate) fn options(&self) -> Result<Options, Diagnostic> {
        let mut options = Options::default();
        for (field, text) in &self.options {
            let wrong = |what: String| Diagnostic::usage(what, "give it another value, or leave it out");
            let extra = Extra::ALL.into_iter().find(|extra| extra.field == field);
            let extra = extra.ok_or_else(|| wrong(format!("there is no option `{field}`")))?;
            (extra.read)(text, &mut options).map_err(|what| wrong(format!("`{field}`: {what}")))?;
        }
        Ok(options)
    }

    /// The run, before its start.
    pub(crate) fn setup(&self) -> Result<Setup, Diagnostic> {
        let probability = || Diagnostic::of_field("miss", "a probability is from 0 to 1", "give one");
        let miss = Probability::new(self.miss).ok_or_else(probability)?;
        let scheme = self.scheme()?;
        let starts = if scheme.starts == Starts::Base { Vec::new() } else { self.starts.clone() };
        let asked = ExplorationRequest {
            robots: Some(self.robots.into()),
            seed: self.seed,
            base: self.base,
            starts,
            miss: Some(miss).filter(|miss| !miss.is_never()),
            options: self.options()?,
            limits: match &self.stop {
                Some(clause) => Limits::stopping_at(Some(own::catalogue().clause(clause)?)),
                None => Limits::default(),
            },
            ..ExplorationRequest::new(scheme, self.rule()?.name)
        };
        let setup = asked.setup(self.layout()?)?;
        Ok(Setup { missed: self.missed.clone(), choices: self.choices.clone(), ..setup })
    }

    /// The conditions that are in force, if they are not those of the rule.
    pub(crate) fn switched(&self) -> Option<u32> {
        let own = self.rule().ok()?.switches?.in_force();
        self.on.filter(|&on| on != own)
    }

    /// The team at its start.
    pub(crate) fn team(&self, setup: &Setup) -> Result<Box<dyn Team>, Diagnostic> {
        match (self.switched(), self.rule()?.switches) {
            (Some(on), Some(switches)) => switches.start(setup, on),
            _ => tautline_sim::explore::team(setup),
        }
    }
}

/// The rows of a layout.
pub(crate) fn ground(layout: &Layout) -> Vec<String> {
    let letter = |cell: Cell| {
        let inner = |side: Side| layout.contains(cell.beyond(side)) && layout.has_wall(Edge::new(cell, side));
        let bit = |is: bool, bit: u8| if is { bit } else { 0 };
        let walls = bit(inner(Side::East), EAST) + bit(inner(Side::South), SOUTH);
        char::from(b'a' + bit(!layout.is_free(cell), BLOCKED) + walls)
    };
    film::rows(layout.size().area(), letter)
}

/// The letters of a row, each from 0 on; `None` if it is damaged.
fn letters(row: &str) -> Option<Vec<u8>> {
    let (mut letters, mut count) = (Vec::new(), 0_usize);
    for sign in row.bytes() {
        match sign {
            b'0'..=b'9' => count = (10 * count + usize::from(sign - b'0')).min(1 << 16),
            b'a'..=b'h' => {
                letters.extend(std::iter::repeat_n(sign - b'a', count.max(1)));
                count = 0;
            }
            _ => return None,
        }
    }
    (count == 0).then_some(letters)
}
