//! A game: a run that is made step by step, with the answers that were given. A question that stays open, and another
//! answer, make it again from its start.

use serde_json::{Value, json};
use tautline_io::diagnostic::Diagnostic;

use crate::ask::Answers;
use crate::by_hand;
use crate::play::{Play, Step, json as written};
use crate::run::Run;
use crate::schemes;
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

    /// The steps that robots cannot take next, and what refuses them. Where a team cannot say that, what each condition
    /// changes is seen without it: what would happen next then or, where it would have been another run before, from
    /// which step on.
    pub(crate) fn refusals(&self) -> Result<Value, Diagnostic> {
        let refused = self.play.refusals();
        if !refused.is_empty() {
            return Ok(json!({ "refused": refused }));
        }
        let Some((names, own)) = schemes::conditions(&self.settings) else {
            return Ok(json!({ "without": [] }));
        };
        let in_force = self.settings.on.unwrap_or(own);
        let own = self.next(&self.settings)?;
        let mut without = Vec::new();
        for (bit, name) in (0..).zip(&names).filter(|(bit, _)| in_force >> bit & 1 == 1) {
            let other = Settings { on: Some(in_force & !(1_u32 << bit)), ..self.settings.clone() };
            let Ok(other) = self.next(&other) else { continue };
            let since = own.0.iter().zip(&other.0).position(|(own, other)| own != other);
            let since =
                since.or_else(|| (own.0.len() != other.0.len()).then(|| own.0.len().min(other.0.len())));
            let next: Vec<&String> = other.1.iter().filter(|words| !own.1.contains(words)).collect();
            if since.is_some() || !next.is_empty() {
                without.push(json!({ "by": name, "since": since.map(|step| step + 1), "next": next }));
            }
        }
        Ok(json!({ "without": without }))
    }

    /// The game so far with these settings, a value for each step, and what can happen next.
    fn next(&self, settings: &Settings) -> Result<(Vec<Value>, Vec<String>), Diagnostic> {
        let answers = self.answers.taken().to_vec();
        let (mut game, opened) = Self::open(settings.clone(), answers, self.steps)?;
        let made = opened["made"].as_array().cloned().unwrap_or_default();
        let seen = made
            .iter()
            .map(|step| json!([step["made"]["cells"], step["made"]["tried"], step["made"]["words"]]));
        if settings.world {
            let asked = game.step(true, &[], 1)?;
            let options = asked["question"]["options"].as_array().cloned().unwrap_or_default();
            let one = asked["made"][0]["made"]["words"].as_str().into_iter();
            let options = options.iter().filter_map(Value::as_str).chain(one).map(str::to_owned);
            return Ok((seen.collect(), options.collect()));
        }
        let next = game.make(1).pop().unwrap_or_default();
        let tried = next["made"]["tried"].as_str().unwrap_or_default();
        let moves = (1..).zip(tried.chars()).map(|(robot, letter)| format!("{robot} {}", way(letter)));
        let moves =
            if next["over"].is_object() { vec!["the run is over".to_owned()] } else { moves.collect() };
        Ok((seen.collect(), moves))
    }
}

/// A step in words.
const fn way(letter: char) -> &'static str {
    match letter.to_ascii_uppercase() {
        'E' => "goes east",
        'S' => "goes south",
        'W' => "goes west",
        'N' => "goes north",
        _ => "stays",
    }
}
