//! A run as a message sequence chart: one column an actor, one line an event, and beside it what becomes of the actor.
//! A message is drawn where it arrives or is lost, with its epoch after the stroke.

use std::fmt::Write;

use tautline_kernel::mrc::{Phase, Task, Upward, WfrTimer, Word};

use super::space::Refutation;
use super::state::{Action, Actor, Message, Setting, State, place};
use crate::engine::states::Ending;
use crate::plural::counted;

/// Columns of text between two lifelines.
const GAP: usize = 18;
/// Columns of text before the first lifeline.
const MARGIN: usize = 4;

/// How far a message or a robot gets.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Reach {
    Arrives,
    IsLost,
}

/// Draws a run that breaks a demand.
pub fn chart(setting: &Setting, broken: &Refutation) -> String {
    let mut state = setting.starts().swap_remove(broken.run.start);
    let actors: Vec<Actor> =
        (0..setting.wfrs).map(Actor::Wfr).chain((0..setting.robots).map(Actor::Robot)).collect();
    let mut lines = vec![hops(setting, &state), String::new(), heads(&actors)];
    let mut play = |state: &mut State, action: Action| {
        let after = state.after(setting, action);
        lines.push(line(setting, &actors, state, action, &after));
        *state = after;
    };
    for &action in &broken.actions {
        play(&mut state, action);
    }
    let first = state.clone();
    for &action in &broken.round {
        play(&mut state, action);
    }
    lines.push(String::new());
    if !first.network().is_empty() && broken.round.is_empty() {
        let under_way: Vec<String> = first.network().iter().map(|&message| sentence(message)).collect();
        lines.push(format!("still on the way: {}", under_way.join(", ")));
    }
    let how = match &broken.run.ending {
        Ending::There => String::new(),
        Ending::Still => "nothing more is bound to happen: ".to_owned(),
        Ending::Round(round) => format!("the last {} can go on for ever: ", counted(round.len(), "event")),
    };
    lines.push(format!("{how}{}", broken.run.demand.broken()));
    lines.join("\n") + "\n"
}

/// The words for an `action` that leads to the state `after`: whatever happens before that.
pub fn happens(setting: &Setting, before: &State, action: Action, after: &State) -> String {
    let mut words = match action {
        Action::Raise(wfr) => format!("something happens at {}", name(Actor::Wfr(wfr))),
        Action::Deliver(at) => format!("{} arrives", sentence(before.network[at])),
        Action::Lose(at) => format!("{} is lost", sentence(before.network[at])),
        Action::Duplicate(at) => format!("{} will arrive twice", sentence(before.network[at])),
        Action::Expire(actor) => {
            let early = if before.is_bound_to_happen(setting, action) { "" } else { " early" };
            format!("{}: {}{early}", name(actor), timer(before, actor))
        }
        Action::Begin(robot) => format!("{} asks now", name(Actor::Robot(robot))),
        Action::Arrive(robot) => format!("{} comes", name(Actor::Robot(robot))),
        Action::Lapse(robot) => format!("the lease of {} lapses", name(Actor::Robot(robot))),
        Action::FailRobot(robot) => format!("{} fails", name(Actor::Robot(robot))),
        Action::FailNode { robot, wfr } => {
            format!("a node between {} and {} fails", name(Actor::Robot(robot)), name(Actor::Wfr(wfr)))
        }
    };
    let actors = (0..setting.wfrs).map(Actor::Wfr).chain((0..setting.robots).map(Actor::Robot));
    for change in actors.filter_map(|actor| change(before, after, actor)) {
        words += "; ";
        words += &change;
    }
    words
}

/// Who sends a message, and who is to get it.
pub const fn between(message: Message) -> (Actor, Actor) {
    ends(message)
}

/// How far each robot is from each WFR.
fn hops(setting: &Setting, state: &State) -> String {
    let to: Vec<String> = (0..setting.wfrs).map(|wfr| name(Actor::Wfr(wfr))).collect();
    let of = |robot: usize| {
        let far: Vec<String> = state.hops[robot][..setting.wfrs].iter().map(u16::to_string).collect();
        format!("{}: {}", name(Actor::Robot(robot)), far.join(", "))
    };
    let robots: Vec<String> = (0..setting.robots).map(of).collect();
    format!("hops to {}: {}", to.join(", "), robots.join("; "))
}

fn name(actor: Actor) -> String {
    match actor {
        Actor::Robot(robot) => format!("robot {}", robot + 1),
        Actor::Wfr(wfr) => format!("WFR {}", wfr + 1),
    }
}

fn heads(actors: &[Actor]) -> String {
    let mut line = String::new();
    for (column, &actor) in actors.iter().enumerate() {
        let name = name(actor);
        let from = lifeline(column).saturating_sub(name.len() / 2);
        let _ = write!(line, "{:blank$}{name}", "", blank = from - line.len());
    }
    line
}

const fn lifeline(column: usize) -> usize {
    MARGIN + column * (GAP + 1)
}

/// A line of the chart, trailing blanks left out.
fn line(setting: &Setting, actors: &[Actor], before: &State, action: Action, after: &State) -> String {
    let width = lifeline(actors.len());
    let mut row = vec![' '; width];
    for (column, &actor) in actors.iter().enumerate() {
        let has_failed = match actor {
            Actor::Robot(robot) => before.failed[robot],
            Actor::Wfr(_) => false,
        };
        row[lifeline(column)] = if has_failed { ' ' } else { '│' };
    }
    let column = |actor: Actor| actors.iter().position(|&other| other == actor).unwrap_or(0);
    let mut remark = String::new();
    match action {
        Action::Raise(wfr) => mark(&mut row, column(Actor::Wfr(wfr)), '*', "event"),
        Action::Deliver(at) => {
            let (from, to) = ends(before.network[at]);
            arrow(&mut row, (column(from), column(to)), Reach::Arrives, &label(before.network[at]));
        }
        Action::Lose(at) => {
            let (from, to) = ends(before.network[at]);
            arrow(&mut row, (column(from), column(to)), Reach::IsLost, &label(before.network[at]));
            remark.push_str("lost");
        }
        Action::Duplicate(at) => {
            let _ = write!(remark, "{} will arrive twice", sentence(before.network[at]));
        }
        Action::Expire(actor) => {
            mark(&mut row, column(actor), '*', timer(before, actor));
            if !before.is_bound_to_happen(setting, action) {
                remark.push_str("early");
            }
        }
        Action::Arrive(robot) => {
            if let Task::Leased { call } = before.robots[robot].task() {
                let to = Actor::Wfr(place(call.wfr));
                arrow(&mut row, (column(Actor::Robot(robot)), column(to)), Reach::Arrives, "comes");
            }
        }
        Action::Begin(robot) => mark(&mut row, column(Actor::Robot(robot)), '*', "asks now"),
        Action::Lapse(robot) => mark(&mut row, column(Actor::Robot(robot)), '*', "lease lapses"),
        Action::FailRobot(robot) => mark(&mut row, column(Actor::Robot(robot)), '✗', "fails"),
        Action::FailNode { robot, wfr } => {
            let between = (column(Actor::Wfr(wfr)), column(Actor::Robot(robot)));
            arrow(&mut row, between, Reach::IsLost, "node fails");
        }
    }
    let changes = actors.iter().filter_map(|&actor| change(before, after, actor));
    let remarks: Vec<String> = (!remark.is_empty()).then_some(remark).into_iter().chain(changes).collect();
    let row: String = row.into_iter().collect();
    format!("{row}{}", remarks.join("; ")).trim_end().to_owned()
}

fn mark(row: &mut [char], column: usize, sign: char, text: &str) {
    let at = lifeline(column);
    row[at] = sign;
    for (cell, letter) in row[at + 2..].iter_mut().zip(text.chars()) {
        *cell = letter;
    }
}

fn arrow(row: &mut [char], (from, to): (usize, usize), reach: Reach, label: &str) {
    let (left, right) = (lifeline(from.min(to)), lifeline(from.max(to)));
    for (at, cell) in row.iter_mut().enumerate().take(right).skip(left + 1) {
        let is_lifeline = (at - MARGIN).is_multiple_of(GAP + 1);
        *cell = if is_lifeline && *cell != ' ' { '┼' } else { '─' };
    }
    let head = if from < to { right - 1 } else { left + 1 };
    row[head] = match reach {
        Reach::Arrives if from < to => '▶',
        Reach::Arrives => '◀',
        Reach::IsLost => '✗',
    };
    let text = format!(" {label} ");
    let length = text.chars().count();
    // In the gap beside the receiver, that labels of arrows that cross stand apart.
    let start = if from < to { right - GAP } else { left + 1 } + (GAP - length.min(GAP)) / 2;
    for (cell, letter) in row[start..].iter_mut().zip(text.chars()) {
        *cell = letter;
    }
}

const fn ends(message: Message) -> (Actor, Actor) {
    let robot = Actor::Robot(message.robot().0 as usize);
    let wfr = Actor::Wfr(place(message.call().wfr));
    match message {
        Message::Notice(..) | Message::Resb(_) => (wfr, robot),
        Message::Up(_) => (robot, wfr),
    }
}

fn label(message: Message) -> String {
    let epoch = message.call().epoch.0;
    match message {
        Message::Notice(..) => format!("NOTICE/{epoch}"),
        Message::Resb(resb) => {
            let chosen = resb.chosen.map(|robot| name(Actor::Robot(robot.0.into())));
            format!("RESB/{epoch} {}", chosen.as_deref().unwrap_or("nobody"))
        }
        Message::Up(Upward { word: Word::Move { hops }, .. }) => format!("MOVE/{epoch} hops {hops}"),
        Message::Up(Upward { word: Word::Accept, .. }) => format!("accept/{epoch}"),
        Message::Up(Upward { word: Word::Decline, .. }) => format!("decline/{epoch}"),
    }
}

fn sentence(message: Message) -> String {
    let (from, to) = ends(message);
    format!("{} from {} to {}", label(message), name(from), name(to))
}

fn timer(state: &State, actor: Actor) -> &'static str {
    match actor {
        Actor::Robot(_) => "no RESB",
        Actor::Wfr(wfr) => match state.wfrs[wfr].timer() {
            Some(WfrTimer::Window(_)) => "window closes",
            Some(WfrTimer::Answer { .. }) => "no answer",
            Some(WfrTimer::Lease(_)) => "lease lapses",
            None => "",
        },
    }
}

/// The new state of an actor in words, if it does something else than before.
fn change(before: &State, after: &State, actor: Actor) -> Option<String> {
    let what = match actor {
        Actor::Robot(robot) => {
            let (old, new) = (before.robots[robot].task(), after.robots[robot].task());
            if old == new {
                return None;
            }
            match (old, new) {
                (_, Task::Free) => "is free".to_owned(),
                (Task::Asking { call: old, .. }, Task::Asking { call, .. }) if old == call => {
                    format!("asks {} again", name(Actor::Wfr(place(call.wfr))))
                }
                (_, Task::Asking { call, .. }) => format!("asks {}", name(Actor::Wfr(place(call.wfr)))),
                (_, Task::Leased { call }) => format!("sets out for {}", name(Actor::Wfr(place(call.wfr)))),
            }
        }
        Actor::Wfr(wfr) => {
            let (old, new) = (before.wfrs[wfr], after.wfrs[wfr]);
            if old.phase() == new.phase() && old.call() == new.call() {
                return None;
            }
            match new.phase() {
                Phase::Idle => "is idle".to_owned(),
                Phase::Collecting { best: None } => format!("calls, epoch {}", new.call().epoch.0),
                Phase::Collecting { best: Some(best) } => {
                    format!("has heard {}", name(Actor::Robot(best.robot.0.into())))
                }
                Phase::Offered { choice, .. } => {
                    format!("offers it to {}", name(Actor::Robot(choice.robot.0.into())))
                }
                Phase::Leased { choice } => {
                    format!("counts on {}", name(Actor::Robot(choice.robot.0.into())))
                }
                Phase::Rescued { by } => format!("is rescued by {}", name(Actor::Robot(by.0.into()))),
            }
        }
    };
    Some(format!("{} {what}", name(actor)))
}
