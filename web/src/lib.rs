//! The engine behind a page to draw on: one call takes a request as JSON and answers with JSON. A page draws cells,
//! sides, robots and layers as data; it knows no scheme. A scheme is a row of the simulator's catalogue, or a world of
//! the proofs that is played by hand.
//!
//! A game is a run that can be made again: its settings and the answers that were given say all, so that a step back,
//! another answer, a link and a file are the same thing.

mod ask;
mod by_hand;
mod clauses;
pub mod exports;
mod files;
mod game;
mod hunt;
pub mod own;
mod play;
mod run;
mod schemes;
mod settings;

use serde::Deserialize;
use serde_json::{Value, json};
use tautline_io::diagnostic::Diagnostic;

use game::Game;
use hunt::{HuntBounds, Hunting};
pub use settings::Settings;

/// A request of a page.
#[derive(Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case", deny_unknown_fields)]
enum Request {
    /// All schemes, as data.
    Schemes,
    /// Begins a game, and makes so many steps of it with these answers.
    Open {
        settings: Settings,
        #[serde(default)]
        answers: Vec<i32>,
        #[serde(default)]
        steps: u32,
    },
    /// Makes the next step of the game, with more answers; a question that has none stays open if it is played by hand.
    Step {
        #[serde(default)]
        by_hand: bool,
        #[serde(default)]
        answers: Vec<i32>,
        /// Steps that are made at once.
        #[serde(default)]
        steps: u32,
    },
    /// The steps that robots cannot take next, and what refuses them.
    Refusals,
    /// Begins a hunt.
    Hunt { settings: Settings, bounds: HuntBounds },
    /// Hunts a little further.
    Slice,
    /// The findings so far.
    Found,
    /// Reads a file that was dropped.
    Read { name: String, text: String },
    /// The game as a stored run.
    Store { settings: Settings },
    /// The layout as a drawing.
    Draw { settings: Settings },
}

/// The state behind a page.
#[derive(Default)]
pub struct Page {
    game: Option<Game>,
    hunting: Option<Hunting>,
}

impl Page {
    /// The answer to a request, both as JSON; what is wrong stands in `error`, and what would be right in `remedy`.
    pub fn answer(&mut self, request: &str) -> String {
        let answer = match serde_json::from_str(request.trim_end()) {
            Ok(request) => self.answered(request),
            Err(error) => Err(Diagnostic::usage(error, "open the page anew")),
        };
        answer
            .unwrap_or_else(
                |fault| json!({ "error": fault.what(), "remedy": fault.remedy(), "field": fault.field() }),
            )
            .to_string()
    }

    fn answered(&mut self, request: Request) -> Result<Value, Diagnostic> {
        let no_game = || Diagnostic::usage("there is no game", "begin one");
        let no_hunt = || Diagnostic::usage("there is no hunt", "begin one");
        match request {
            Request::Schemes => Ok(schemes::list()),
            Request::Open { settings, answers, steps } => {
                let (game, opened) = Game::open(settings, answers, steps)?;
                self.game = Some(game);
                Ok(opened)
            }
            Request::Step { by_hand, answers, steps } => {
                self.game.as_mut().ok_or_else(no_game)?.step(by_hand, &answers, steps)
            }
            Request::Refusals => self.game.as_ref().ok_or_else(no_game)?.refusals(),
            Request::Hunt { settings, bounds } => {
                let (hunting, begun) = Hunting::begin(&settings, bounds)?;
                self.hunting = Some(hunting);
                Ok(begun)
            }
            Request::Slice => self.hunting.as_mut().ok_or_else(no_hunt)?.slice(),
            Request::Found => self.hunting.as_ref().ok_or_else(no_hunt)?.found(),
            Request::Read { name, text } => files::read(&name, text),
            Request::Store { settings } => files::store(&settings),
            Request::Draw { settings } => {
                let mut layout = settings.layout()?;
                settings.base.map_or(Ok(()), |base| layout.place_base(base))?;
                Ok(json!({ "text": layout.to_string() }))
            }
        }
    }
}
