//! Worlds of the proofs that are played by hand: whatever may happen next is a question, and the seed answers where
//! nobody else does. A world says how its states look; how it is played is the same for all.

mod frontier;
mod kit;
mod mrc;
mod notice;

use serde_json::Value;
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::choice::Oracle;
use tautline_kernel::conditions::Conditional;
use tautline_kernel::ground::{Area, Cell, Edge};
use tautline_proofs::engine::SeededOracle;
use tautline_proofs::engine::states::{self, Ending, Limits, System};
use tautline_proofs::engine::world::{Turn, World};
use tautline_sim::draw::page::{film, number_of, place_of, side_of};
use tautline_sim::explore::{Layer, Place};

use crate::ask::{Answers, Question};
use crate::clauses::sentence;
use crate::play::{Board, BrokenClause, Delta, Over, Play, Step};
use crate::settings::Settings;

/// A scheme whose world is played by hand.
pub(crate) struct ByHand {
    /// Its name.
    pub(crate) name: &'static str,
    /// Its world with these settings, at its start.
    start: Start,
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
fn search<W: System>(
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
    found.sort_by_key(|order| order.clause);
    HuntFindings { states: findings.states, is_complete: findings.is_whole, found }
}

/// How the world of these settings is hunted, if no catalogue has it.
pub(crate) fn hunt(settings: &Settings) -> Option<Search> {
    let world = WORLDS.iter().find(|world| world.name == settings.scheme)?;
    world.row.map(|(_, search)| search)
}

/// The worlds.
pub(crate) const WORLDS: [ByHand; 4] = [kit::KIT, frontier::FRONTIER, notice::NOTICE, mrc::MRC];

/// The world of these settings, at its start.
pub(crate) fn start(settings: &Settings) -> Result<Box<dyn Play>, Diagnostic> {
    let world = WORLDS.iter().find(|world| world.name == settings.scheme);
    let world = world.ok_or_else(|| {
        let what = format!("no world of {} is played by hand", settings.scheme);
        Diagnostic::usage(what, "play it on a layout")
    })?;
    (world.start)(settings)
}

/// A world with these settings, at its start.
type Start = fn(&Settings) -> Result<Box<dyn Play>, Diagnostic>;

/// The world of so many robots as the settings say, of which `of` has one for each number from one on.
fn small_team<const MOST: usize>(
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
fn chosen<R: Conditional>(rules: &[(&str, R)], settings: &Settings) -> Result<R, Diagnostic> {
    let found = rules.iter().find(|(name, _)| *name == settings.rule);
    let &(_, rule) = found.ok_or_else(|| {
        let names: Vec<&str> = rules.iter().map(|&(name, _)| name).collect();
        let what = format!("the rule {} asks nothing that could be decided by hand", settings.rule);
        Diagnostic::of_field("rule", what, format!("take {}", names.join(" or ")))
    })?;
    Ok(settings.on.map_or(rule, |on| rule.with_in_force(on)))
}

/// The fault of a layout that a small world does not hold.
fn too_large() -> Diagnostic {
    Diagnostic::of_field("layout", "the layout is too large to be played by hand", "take a smaller one")
}

/// A world whose states can be shown.
trait SceneWorld: World {
    /// The part that stands still.
    fn scene(&self) -> Scene;

    /// The events that may happen next, in words, as the plan lists them.
    fn options(&self, state: &Self::State, plan: &Self::Plan) -> Vec<String>;

    /// How a state looks.
    fn picture(&self, state: &Self::State) -> Picture;

    /// The id of the clause that a demand belongs to, and what is broken, in words.
    fn clause(&self, demand: Self::Demand) -> (&'static str, String);
}

/// The part of a world that stands still.
struct Scene {
    area: Area,
    /// The noun for whoever acts.
    actor: &'static str,
    /// The actors that are drawn as squares: so many of the first.
    squares: usize,
    /// The names of the actors, if they are not their numbers.
    names: Vec<String>,
    layers: Vec<Layer>,
}

/// How a state looks.
#[derive(Default)]
struct Picture {
    /// Where the actors are.
    cells: Vec<Cell>,
    explored: Vec<Cell>,
    /// Sides that are known, and whether they are open.
    known: Vec<(Edge, bool)>,
    /// Values in layers.
    put: Vec<(usize, Option<usize>, Place, u8)>,
    /// Layer, kind, and from whom to whom.
    say: Vec<(usize, usize, usize, usize)>,
    failed: Vec<usize>,
}

/// A world on its way.
struct WorldRun<W: SceneWorld> {
    world: W,
    state: W::State,
    log: Vec<u8>,
    dice: SeededOracle,
    step: u32,
}

impl<W: SceneWorld + 'static> WorldRun<W> {
    fn boxed(world: W, state: W::State, seed: u64) -> Box<dyn Play>
    where
        W::State: 'static,
    {
        Box::new(Self { world, state, log: Vec::new(), dice: SeededOracle::new(seed, 0), step: 0 })
    }
}

impl<W: SceneWorld> WorldRun<W> {
    fn delta(&self, picture: Picture) -> Delta {
        let Scene { area, layers, .. } = self.world.scene();
        let Picture { cells, explored, known, put, say, failed } = picture;
        let at = |at| number_of(area, at);
        Delta {
            step: self.step,
            tried: ".".repeat(cells.len()),
            explored: explored.iter().chain(&cells).filter_map(|&cell| place_of(area, cell)).collect(),
            cells: cells.into_iter().map(|cell| place_of(area, cell)).collect(),
            known: known.into_iter().filter_map(|(edge, is)| Some((side_of(area, edge)?, is))).collect(),
            clear: (0..layers.len()).collect(),
            put: put
                .into_iter()
                .filter_map(|(layer, robot, spot, value)| Some((layer, robot, at(spot)?, value)))
                .collect(),
            say: say.into_iter().map(|(layer, kind, from, to)| (layer, kind, from, Some(vec![to]))).collect(),
            failed,
            ..Delta::default()
        }
    }

    fn broken(&self, demands: Vec<W::Demand>) -> Vec<BrokenClause> {
        let broken = |demand| {
            let (clause, told) = self.world.clause(demand);
            BrokenClause {
                clause: clause.to_owned(),
                sentence: sentence(clause),
                told: vec![told],
                cells: Vec::new(),
            }
        };
        demands.into_iter().map(broken).collect()
    }
}

impl<W: SceneWorld> Play for WorldRun<W> {
    fn board(&self) -> Board {
        let Scene { area, actor, squares, names, layers } = self.world.scene();
        Board {
            columns: area.width(),
            rows: area.height(),
            area: [area.first().x, area.first().y, area.width() as i16, area.height() as i16],
            robot: actor,
            unit: "step",
            squares,
            names,
            has_leader: false,
            sees: false,
            due: 0,
            layers: layers.iter().map(film::layer).collect(),
            start: self.delta(self.world.picture(&self.state)),
        }
    }

    fn step(&mut self, answers: &mut Answers) -> Step {
        let Self { world, state, log, dice, .. } = self;
        let before = state.clone();
        let Some(plan) = world.plan(state, log) else {
            let broken = world.broken_at_end(state, log);
            return Step::Over(Over {
                words: "nothing can happen any more".to_owned(),
                broken: self.broken(broken),
            });
        };
        let options = world.options(state, &plan);
        let (planned, sent) = (state.clone(), log.len());
        let mut asked = AnswerSource { answers, dice, options, taken: String::new() };
        let event = world.settle(state, &plan, log, &mut asked);
        let words = asked.taken;
        let (before, planned, after) = (&before, &planned, &*state);
        let turn = Turn { before, planned, after, plan: &plan, event: &event, sent: &log[sent..] };
        let demands = world.broken_by(&turn);
        let picture = world.picture(state);
        self.step += 1;
        let broken = self.broken(demands);
        Step::Made(Box::new(Delta { words, broken, ..self.delta(picture) }))
    }
}

/// Answers as somebody gives them, or as the dice fall.
struct AnswerSource<'a> {
    answers: &'a mut Answers,
    dice: &'a mut SeededOracle,
    /// The events that may happen, until one of them is picked.
    options: Vec<String>,
    /// The event that was picked.
    taken: String,
}

impl Oracle for AnswerSource<'_> {
    fn pick(&mut self, below: u32) -> u32 {
        let usual = self.dice.pick(below);
        let mut options = std::mem::take(&mut self.options);
        let is_first = options.len() == below as usize;
        if !is_first {
            options = (1..=below).map(|number| number.to_string()).collect();
        }
        let question = || Question {
            words: if is_first { "What happens next?" } else { "Which one?" }.to_owned(),
            options: options.clone(),
            usual,
            side: None,
            robots: Vec::new(),
        };
        let picked = if below < 2 { 0 } else { self.answers.ask(usual, question).min(below - 1) };
        if is_first {
            self.taken.clone_from(&options[picked as usize]);
        }
        picked
    }
}

/// The cells in which actors start: those of the settings, and then those nearest to the middle.
fn starts(settings: &Settings, area: Area, count: usize) -> Vec<Cell> {
    let middle = |first: i16, last: i16| i32::from(first) + i32::from(last);
    let (x, y) = (middle(area.first().x, area.last().x), middle(area.first().y, area.last().y));
    let mut rest: Vec<Cell> = area.cells().filter(|cell| !settings.starts.contains(cell)).collect();
    rest.sort_by_key(|cell| (2 * i32::from(cell.x) - x).pow(2) + (2 * i32::from(cell.y) - y).pow(2));
    settings.starts.iter().copied().chain(rest).take(count).collect()
}

/// A whole number among the options.
fn number(settings: &Settings, field: &str, usual: u8, most: u8) -> Result<u8, Diagnostic> {
    let Some(text) = settings.options.get(field) else { return Ok(usual) };
    text.parse().ok().filter(|&number| number <= most).ok_or_else(|| {
        let what = format!("`{field}` is {text:?}, and not a number from 0 to {most}");
        Diagnostic::usage(what, "give it another value, or leave it out")
    })
}
