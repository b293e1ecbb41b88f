//! A game: a run that is made step by step, with the answers that were given. A question that stays open, and another
//! answer, make it again from its start.

use serde_json::{Value, json};
use tautline_sim::diagnostic::Diagnostic;

use crate::ask::Answers;
use crate::by_hand;
use crate::play::{Play, Step, json as written};
use crate::run::Run;
use crate::settings::Settings;

/// A game on its way.
pub(crate) struct Game {
    settings: Settings,
    play: Box<dyn Play>,
    answers: Answers,
    steps: u32,
    is_over: bool,
}

/// The play of these settings, at its start.
fn start(settings: &Settings) -> Result<Box<dyn Play>, Diagnostic> {
    if settings.world { by_hand::start(settings) } else { Ok(Box::new(Run::new(settings)?)) }
}

impl Game {
    /// The game of these settings after so many steps with these answers, and what a page shows of it.
    pub(crate) fn open(
        settings: Settings,
        answers: Vec<i32>,
        steps: u32,
    ) -> Result<(Self, Value), Diagnostic> {
        let play = start(&settings)?;
        let board = written(&play.board());
        let mut game = Self { settings, play, answers: Answers::new(answers), steps: 0, is_over: false };
        let made = game.make(steps);
        Ok((game, json!({ "board": board, "made": made })))
    }

    /// Makes so many steps, or as many as there are.
    fn make(&mut self, steps: u32) -> Vec<Value> {
        let mut made = Vec::new();
        while !self.is_over && (made.len() as u32) < steps {
            let step = self.play.step(&mut self.answers);
            match step {
                Step::Made(_) => self.steps += 1,
                Step::Over(_) => self.is_over = true,
            }
            let mut step = written(&step);
            step["asked"] = json!(self.answers.taken().len());
            made.push(step);
        }
        made
    }

    /// The game after so many steps, made again with these answers.
    fn again(&self, steps: u32, answers: Vec<i32>) -> Result<Self, Diagnostic> {
        let (game, _) = Self::open(self.settings.clone(), answers, steps)?;
        Ok(game)
    }

    /// Gives more answers and makes the next steps, by hand only one. A question that stays open comes back, with what
    /// would happen under each answer.
    pub(crate) fn step(&mut self, by_hand: bool, more: &[i32], steps: u32) -> Result<Value, Diagnostic> {
        let before = self.steps;
        self.answers.give(more);
        self.answers.by_hand = by_hand;
        let made = self.make(if by_hand { 1 } else { steps.max(1) });
        self.answers.by_hand = false;
        let given = self.answers.taken().to_vec();
        let Some(question) = self.answers.open.take() else {
            return Ok(json!({ "made": made, "answers": given }));
        };
        let under = |option: u32| {
            let answers = [&given[..], &[option as i32]].concat();
            Ok(self.again(before, answers)?.make(1).pop().unwrap_or_default())
        };
        let options = question.options.len() as u32;
        let would = (0..options).map(under).collect::<Result<Vec<Value>, Diagnostic>>()?;
        // The step that asked is made again when it is answered.
        *self = self.again(before, given.clone())?;
        Ok(json!({ "question": question, "would": would, "answers": given }))
    }

    /// The steps that robots cannot take next, and what refuses them.
    pub(crate) fn refusals(&self) -> Value {
        written(&self.play.refusals())
    }
}
