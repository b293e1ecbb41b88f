//! A team of one's own, searched over all layouts. Whoever has a rule for robots on cells implements [`Team`], says in
//! [`Layouts`] where they start, what is demanded and what must occur, and has a search with levels of walls, mutants,
//! counterexamples that can be replayed, and a line in a ledger.
//!
//! The world remembers what the robots have found: an edge that was open stays open, and so does a wall.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};
use tautline_kernel::chain::Kind;
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Edge, EdgeMark, Grid, SmallGrid, Step};

use crate::decide::{Answer, Desk, Evidence, Method, Played, Refused, Seen, Verdict};
use crate::engine::tree::{Counterexample, Found, Game, Limits, Tree, Waves};
use crate::engine::world::{Turn, World};
use crate::engine::{Choices, Unfit, Until};
use crate::run::{Frame, Run, walls};

/// A team of robots on cells, as a plain value: where its robots are and all that they know.
pub trait Team<const ROBOTS: usize>: Copy + Eq + Send + Sync + 'static {
    /// What each robot tries next; `None` when the run is over.
    fn plan(&mut self) -> Option<[Step; ROBOTS]>;

    /// What came of it: where each robot is now, and whether it met a wall.
    fn settle(&mut self, cells: [Cell; ROBOTS], blocked: [bool; ROBOTS]);
}

/// One team move, as a demand sees it.
pub struct Moved<'a, T, const ROBOTS: usize> {
    /// The team before it.
    pub before: &'a T,
    /// The team after it.
    pub after: &'a T,
    /// Where the robots were.
    pub from: [Cell; ROBOTS],
    /// Where they are now.
    pub to: [Cell; ROBOTS],
}

/// When a demand is looked at.
enum When<T: 'static, const ROBOTS: usize> {
    Always(fn(&Moved<'_, T, ROBOTS>) -> bool),
    AtTheEnd(fn(&T, &[Cell; ROBOTS]) -> bool),
    NeverEndless,
}

/// What is demanded of a team.
pub struct Demand<T: 'static, const ROBOTS: usize> {
    /// The id of the clause that demands it.
    pub id: &'static str,
    /// What it demands, in words.
    pub words: &'static str,
    when: When<T, ROBOTS>,
}

impl<T, const ROBOTS: usize> Demand<T, ROBOTS> {
    /// Of every team move.
    pub const fn always(
        id: &'static str,
        words: &'static str,
        is_kept: fn(&Moved<'_, T, ROBOTS>) -> bool,
    ) -> Self {
        Self { id, words, when: When::Always(is_kept) }
    }

    /// Of the end of every run that ends.
    pub const fn at_the_end(
        id: &'static str,
        words: &'static str,
        is_kept: fn(&T, &[Cell; ROBOTS]) -> bool,
    ) -> Self {
        Self { id, words, when: When::AtTheEnd(is_kept) }
    }

    /// That no run comes back to where it was. Where this is not demanded, a run that does is over.
    pub const fn never_endless(id: &'static str, words: &'static str) -> Self {
        Self { id, words, when: When::NeverEndless }
    }

    /// Whether a team move breaks it.
    pub fn is_broken_by(&self, moved: &Moved<'_, T, ROBOTS>) -> bool {
        match self.when {
            When::Always(is_kept) => !is_kept(moved),
            When::AtTheEnd(_) | When::NeverEndless => false,
        }
    }

    /// Whether a run breaks it that ends with the robots in `cells`.
    pub fn is_broken_at_end(&self, team: &T, cells: &[Cell; ROBOTS]) -> bool {
        match self.when {
            When::AtTheEnd(is_kept) => !is_kept(team, cells),
            When::Always(_) | When::NeverEndless => false,
        }
    }

    /// Whether it is demanded of the end of a run.
    pub const fn is_of_the_end(&self) -> bool {
        matches!(self.when, When::AtTheEnd(_))
    }

    /// Whether a run breaks it that never ends.
    pub const fn is_broken_by_endless_runs(&self) -> bool {
        matches!(self.when, When::NeverEndless)
    }
}

/// A situation that must occur: its name, and whether a team move is one.
pub type Cover<T, const ROBOTS: usize> = (&'static str, fn(&Moved<'_, T, ROBOTS>) -> bool);

/// All layouts of an area, and what is demanded of a team in them that follows a rule of type `R`.
pub struct Layouts<R: 'static, T: 'static, const ROBOTS: usize> {
    /// The name of the scheme, in a stored run.
    pub scheme: &'static str,
    /// Columns and rows: at most 16.
    pub size: (i16, i16),
    /// Most walls that are met in one run; the border is not counted.
    pub max_walls: u32,
    /// Team moves after which a run is given up, which leaves the question open.
    pub longest_run: u32,
    /// The team that follows a rule, and where its robots start: cells are counted from 0,0 in the north-west.
    pub start: fn(&R) -> (T, [Cell; ROBOTS]),
    /// What is demanded.
    pub demands: &'static [Demand<T, ROBOTS>],
    /// The situations that must occur: where one does not, the question is open.
    pub covers: &'static [Cover<T, ROBOTS>],
}

/// The number of a demand.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub struct Promise(pub usize);

/// A check that no team breaks the demand with this number, in any of the layouts.
pub struct Keeps<R: 'static, T: 'static, const ROBOTS: usize>(
    /// The layouts and all demands.
    pub &'static Layouts<R, T, ROBOTS>,
    /// The number of the demand.
    pub usize,
);

impl<R, T: Team<ROBOTS>, const ROBOTS: usize> Layouts<R, T, ROBOTS> {
    fn area(&self) -> Option<Area> {
        Area::new(Cell::new(0, 0), Cell::new(self.size.0 - 1, self.size.1 - 1))
    }

    /// The search for teams that follow `rule`, at its start: it can be made wave by wave, left and taken up again. It
    /// is for the demands that are `wanted`, or for all if none is said to be; each is decided as if it stood alone, so
    /// a run goes on until it has broken all of them.
    ///
    /// # Errors
    /// [`Refused`] if the area is too large, a robot starts outside, or the limits are beyond what can be searched.
    pub fn search(
        &'static self,
        rule: &R,
        until: Until,
        wanted: &[Promise],
    ) -> Result<Tree<InLayouts<R, T, ROBOTS>>, Refused> {
        let area = self.area().ok_or_else(|| Refused::new("the area holds no cell"))?;
        let grid = SmallGrid::new(area).ok_or_else(|| Refused::new("an area has at most 16×16 cells"))?;
        let (team, cells) = (self.start)(rule);
        if let Some(outside) = cells.iter().find(|&&start| !area.contains(start)) {
            return Err(Refused::new(format_args!("a robot starts in {outside}, outside of the area")));
        }
        let state = State { team, cells, grid };
        let all = || (0..self.demands.len()).map(Promise).collect();
        let wanted = if wanted.is_empty() { all() } else { wanted.to_vec() };
        let limits = Limits { max_walls: self.max_walls, budget_moves: None, until };
        Tree::new(InLayouts { layouts: self, wanted, state }, &limits).map_err(Refused::new)
    }

    /// What a search finds, which is made only once.
    fn found<'d>(
        &'static self,
        rule: &R,
        until: Until,
        wanted: Vec<Promise>,
        desk: &'d mut Desk<'_, '_>,
    ) -> Result<&'d Found<Promise, Frame>, Refused>
    where
        R: Clone + PartialEq,
    {
        let Desk { memory, watch, .. } = desk;
        let key = (std::ptr::from_ref(self).addr(), rule.clone(), until, wanted);
        memory.recall(key, |(_, rule, until, wanted)| {
            let mut tree = self.search(rule, *until, wanted)?;
            while tree.wave() && watch(&tree.progress()).is_continue() {}
            Ok(tree.found())
        })
    }

    /// The run that was found.
    pub fn run(&self, rule: &R, found: &Counterexample<Promise, Frame>) -> Run {
        Run {
            scheme: self.scheme,
            area: self.area().unwrap_or(Area::of(Cell::new(0, 0))),
            starts: (self.start)(rule).1.to_vec(),
            walls: walls(&found.frames),
            frames: found.frames.clone(),
            breaks: self.demands.get(found.broken.0).map(|demand| demand.id),
            is_over: self.demands.get(found.broken.0).is_some_and(Demand::is_of_the_end),
        }
    }

    fn evidence(&self, rule: &R, found: &Counterexample<Promise, Frame>) -> Evidence {
        let choices = Choices { once: found.answers.clone(), again: Vec::new() };
        Evidence { choices, demand: found.demand, seen: Seen::Robots(Box::new(self.run(rule, found))) }
    }
}

impl<R, T, const ROBOTS: usize> Method<R> for Keeps<R, T, ROBOTS>
where
    R: Clone + PartialEq + Sync,
    T: Team<ROBOTS>,
{
    fn engine(&self) -> &'static str {
        "search"
    }

    fn bound(&self) -> String {
        let Layouts { size: (width, height), max_walls, longest_run, .. } = self.0;
        let length = match *longest_run {
            u32::MAX => String::new(),
            most => format!(", runs of at most {most} team moves"),
        };
        format!("all layouts of {width}×{height} cells, {ROBOTS} robots, at most {max_walls} walls{length}")
    }

    /// The rule is left out of the name, as it has none: checks of several rules are decided one after the other, too.
    fn family(&self, _: &R) -> Option<String> {
        Some(format!("{:x}", std::ptr::from_ref(self.0).addr()))
    }

    fn decide(&self, rule: &R, until: Until, desk: &mut Desk<'_, '_>) -> Result<Answer, Refused> {
        let (layouts, promise) = (self.0, Promise(self.1));
        // A search that goes on for each demand answers for all of them.
        let wanted = match until {
            Until::Exhausted => Vec::new(),
            Until::Violation => vec![promise],
        };
        let found = layouts.found(rule, until, wanted, desk)?;
        let broken = found.counterexamples.iter().find(|found| found.broken == promise);
        let is_covered = layouts.covers.iter().all(|(name, _)| found.covered.contains(name));
        let evidence = broken.map(|found| layouts.evidence(rule, found));
        let is_whole = found.complete && found.given_up == 0 && is_covered;
        let answer = Answer::new(evidence, is_whole, Verdict::Holds, found.runs - found.given_up);
        Ok(Answer { given_up: found.given_up, ..answer })
    }

    fn replay(&self, rule: &R, choices: &Choices) -> Result<Played, Unfit> {
        if !choices.again.is_empty() {
            return Err(Unfit::Over { at: choices.once.len() });
        }
        let wanted = [Promise(self.1)];
        let tree = self.0.search(rule, Until::Exhausted, &wanted).map_err(|_| Unfit::Unbroken)?;
        let found = tree.replay(Promise(self.1), &choices.once)?;
        Ok(Played { of: vec![2; found.answers.len()], evidence: self.0.evidence(rule, &found) })
    }
}

/// A team in layouts, as the search plays it.
pub struct InLayouts<R: 'static, T: 'static, const ROBOTS: usize> {
    layouts: &'static Layouts<R, T, ROBOTS>,
    wanted: Vec<Promise>,
    state: State<T, ROBOTS>,
}

/// A team, where its robots are, and what they have found of the layout.
#[derive(Clone, Copy)]
pub struct State<T, const ROBOTS: usize> {
    team: T,
    cells: [Cell; ROBOTS],
    grid: SmallGrid,
}

impl<R, T: Team<ROBOTS>, const ROBOTS: usize> InLayouts<R, T, ROBOTS> {
    /// The demands that are wanted and broken.
    fn broken(&self, is_broken: impl Fn(&Demand<T, ROBOTS>) -> bool) -> Vec<Promise> {
        let is_broken = |promise: &Promise| self.layouts.demands.get(promise.0).is_some_and(&is_broken);
        self.wanted.iter().copied().filter(is_broken).collect()
    }
}

impl<R, T: Team<ROBOTS>, const ROBOTS: usize> World for InLayouts<R, T, ROBOTS> {
    type State = State<T, ROBOTS>;
    type Plan = [Step; ROBOTS];
    type Event = ();
    type Demand = Promise;

    fn plan(&self, state: &mut Self::State, _: &[u8]) -> Option<Self::Plan> {
        state.team.plan()
    }

    fn settle(&self, state: &mut Self::State, plan: &Self::Plan, log: &mut Vec<u8>, world: &mut impl Oracle) {
        let mut blocked = [false; ROBOTS];
        for (robot, step) in plan.iter().enumerate() {
            let Step::Cross(side) = *step else { continue };
            let edge = Edge::new(state.cells[robot], side);
            if !state.grid.edge_has(EdgeMark::Wall, edge) && !state.grid.edge_has(EdgeMark::Open, edge) {
                let mark = if world.is_open(edge) { EdgeMark::Open } else { EdgeMark::Wall };
                state.grid.put_edge(mark, edge);
            }
            blocked[robot] = state.grid.edge_has(EdgeMark::Wall, edge);
            if !blocked[robot] {
                state.cells[robot] = state.cells[robot].after(*step);
            }
        }
        log.extend(blocked.map(u8::from));
        state.team.settle(state.cells, blocked);
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<Promise> {
        let moved = moved(turn);
        self.broken(|demand| demand.is_broken_by(&moved))
    }

    fn broken_at_end(&self, state: &Self::State, _: &[u8]) -> Vec<Promise> {
        self.broken(|demand| demand.is_broken_at_end(&state.team, &state.cells))
    }
}

impl<R, T: Team<ROBOTS>, const ROBOTS: usize> Game for InLayouts<R, T, ROBOTS> {
    type Frame = Frame;

    fn words(&self, Promise(demand): Promise, _: Option<&Turn<'_, Self>>) -> &'static str {
        self.layouts.demands.get(demand).map_or("", |demand| demand.words)
    }

    fn start(&self) -> Self::State {
        self.state
    }

    fn frame(&self, turn: &Turn<'_, Self>) -> Frame {
        Frame {
            kind: Kind::Advance,
            steps: turn.plan.to_vec(),
            blocked: turn.sent.iter().map(|&blocked| blocked == 1).collect(),
            cells: turn.after.cells.to_vec(),
        }
    }

    fn wanted(&self) -> &[Promise] {
        &self.wanted
    }

    fn recurs(&self, then: &Self::State, _: usize, now: &Self::State, _: &[u8]) -> ControlFlow<Vec<Promise>> {
        if (&then.team, then.cells) != (&now.team, now.cells) {
            return ControlFlow::Continue(());
        }
        ControlFlow::Break(self.broken(Demand::is_broken_by_endless_runs))
    }

    fn edges(&self) -> u32 {
        self.state.grid.area().edges().count() as u32
    }

    fn longest_run(&self) -> u32 {
        self.layouts.longest_run
    }

    fn covers(&self) -> impl Iterator<Item = &'static str> {
        self.layouts.covers.iter().map(|&(name, _)| name)
    }

    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        let moved = moved(turn);
        let occurs = self.layouts.covers.iter().zip(0..).filter(|((_, is_one), _)| is_one(&moved));
        occurs.fold(0, |bits, (_, bit)| bits | 1 << bit)
    }
}

fn moved<'a, R, T: Team<ROBOTS>, const ROBOTS: usize>(
    turn: &Turn<'a, InLayouts<R, T, ROBOTS>>,
) -> Moved<'a, T, ROBOTS> {
    let Turn { before, after, .. } = turn;
    Moved { before: &before.team, after: &after.team, from: before.cells, to: after.cells }
}
