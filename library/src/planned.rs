//! Robots that plan all of their ways before they go, in all layouts of a bound.

use crate::prelude::*;

/// A planner.
pub(crate) trait Planner: Copy + Sync + 'static {
    /// Where all robots are after each step; `None` if it finds no plan.
    fn plan(&self, graph: &Graph, starts: &[u8], goals: &[u8]) -> Option<Vec<Vec<u8>>>;
}

/// Which starts and goals are meant.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Only {
    All,
    /// Those for which there is a plan at all.
    Solvable,
    /// Those in which a robot's way to its goal needs no other start and goal.
    WellFormed,
}

/// Teams, and which of their starts and goals are meant.
pub(crate) struct Tasks(pub(crate) Teams, pub(crate) Only);

impl fmt::Display for Tasks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let only = match self.1 {
            Only::All => "",
            Only::Solvable => " that can be solved",
            Only::WellFormed => " that are well-formed",
        };
        write!(f, "{}{only}", self.0)
    }
}

/// A planner's robots.
pub(crate) struct Planned<R>(R, Vec<Graph>, Vec<State>);

/// The number of the layout, where robots are and go to, and, once they have planned, where they will be.
type State = (u16, Vec<u8>, Vec<u8>, Option<Vec<Vec<u8>>>);

impl<R: Planner> Protocol for Planned<R> {
    type Rule = R;
    type Bound = Tasks;
    type State = State;
    const DEMANDS: &'static [Demand<Self>] = &[
        Demand::always(APART, |_, before: &State, after: &State| !conflicts(&before.1, &after.1)),
        Demand::at_the_end("every robot is at its goal", |_, (_, now, goals, _): &State| now == goals),
    ];

    fn new(rule: &R, Tasks(teams, only): &Tasks) -> Result<Self, MethodError> {
        let graphs = teams.graphs.all()?;
        let parts: Vec<Vec<Vec<Vec<u8>>>> = match only {
            Only::Solvable => graphs.iter().map(|graph| components(graph, teams.robots)).collect(),
            Only::All | Only::WellFormed => Vec::new(),
        };
        let is_meant = |(graph, starts, goals): &(usize, Vec<u8>, Vec<u8>)| match only {
            Only::All => true,
            Only::Solvable => parts[*graph].iter().any(|part| part.contains(starts) && part.contains(goals)),
            Only::WellFormed => is_well_formed(&graphs[*graph], starts, goals),
        };
        let tasks = teams.instances(&graphs).filter(is_meant);
        let starts = tasks.map(|(graph, starts, goals)| (graph as u16, starts, goals, None)).collect();
        Ok(Self(*rule, graphs, starts))
    }

    fn starts(&self) -> impl Iterator<Item = State> {
        self.2.iter().cloned()
    }

    fn moves(&self, (graph, now, goals, plan): &State) -> Vec<Move<State>> {
        let all = now.len();
        match plan.as_deref() {
            None => {
                let planned = self.0.plan(&self.1[usize::from(*graph)], now, goals).unwrap_or_default();
                vec![Move::of_all(all, "all plan", (*graph, now.clone(), goals.clone(), Some(planned)))]
            }
            Some([]) => Vec::new(),
            Some([next, rest @ ..]) => {
                let to = (*graph, next.clone(), goals.clone(), Some(rest.to_vec()));
                vec![Move::of_all(all, "all move", to)]
            }
        }
    }

    fn draw(&self, (graph, now, goals, _): &State) -> String {
        robots(&self.1[usize::from(*graph)], now, goals)
    }
}

/// Whether every robot has a way to its goal that leads through no other start and goal.
fn is_well_formed(graph: &Graph, starts: &[u8], goals: &[u8]) -> bool {
    let has_way = |(&start, &goal): (&u8, &u8)| {
        let is_free = |cell: u8| (cell == goal || !goals.contains(&cell)) && !starts.contains(&cell);
        start == goal || graph.steps_through(start, is_free)[usize::from(goal)] != u8::MAX
    };
    starts.iter().zip(goals).all(has_way)
}

/// The places of all robots, those together that can be reached from each other.
fn components(graph: &Graph, robots: usize) -> Vec<Vec<Vec<u8>>> {
    let mut parts: Vec<Vec<Vec<u8>>> = Vec::new();
    for places in graph.places(robots) {
        if parts.iter().any(|part| part.contains(&places)) {
            continue;
        }
        let (mut part, mut next) = (vec![places], 0);
        while let Some(now) = part.get(next).cloned() {
            next += 1;
            for to in joint_moves(graph, &now) {
                if !part.contains(&to) {
                    part.push(to);
                }
            }
        }
        parts.push(part);
    }
    parts
}

/// Every joint move of all robots.
fn joint_moves(graph: &Graph, now: &[u8]) -> Vec<Vec<u8>> {
    let moves = combinations(now.iter().map(|&cell| [graph.beside(cell), &[cell]].concat()));
    moves.filter(|to| !conflicts(now, to)).collect()
}
