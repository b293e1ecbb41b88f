//! Robots that plan all of their ways before they go, in all layouts of a bound.

use std::collections::BTreeSet;

use crate::prelude::*;

/// A planner.
pub(crate) trait Planner: Copy + Sync + 'static {
    /// Where all robots are after each step; `None` if it finds no plan.
    fn plan(&self, graph: &Graph, starts: &[u8], goals: &[u8]) -> Option<Vec<Vec<u8>>>;
}

/// Which starts and goals are meant.
#[derive(Clone, Copy)]
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

impl Bound for Tasks {
    type Surroundings = (Task, Only);

    fn each(&self) -> Result<Vec<(Task, Only)>, MethodError> {
        Ok(self.0.each()?.into_iter().map(|task| (task, self.1)).collect())
    }
}

/// A planner's robots.
#[derive(Clone, Copy)]
pub(crate) struct PlannerProtocol<R>(pub(crate) R);

/// Where robots are, and, once they have planned, where they will be.
type State = (Vec<u8>, Option<Vec<Vec<u8>>>);

impl<R: Planner> Protocol for PlannerProtocol<R> {
    type Bound = Tasks;
    type State = State;
    demands! {
        always APART, |_, _, before, after| !conflicts(&before.0, &after.0);
        at_the_end "every robot is at its goal", |_, (task, _), (now, _)| *now == task.goals;
    }

    fn starts(&self, (task, only): &(Task, Only)) -> impl IntoIterator<Item = State> {
        let starts = match only {
            Only::All => task.starts(),
            Only::Solvable => solvable(task),
            Only::WellFormed => {
                task.starts().into_iter().filter(|starts| is_well_formed(task, starts)).collect()
            }
        };
        starts.into_iter().map(|starts| (starts, None))
    }

    fn moves(&self, (task, _): &(Task, Only), (now, plan): &State) -> Vec<Move<State>> {
        let all =
            |words, now: &Vec<u8>, plan| vec![Move::of_all(now.len(), words, (now.clone(), Some(plan)))];
        match plan.as_deref() {
            None => all("all plan", now, self.0.plan(&task.graph, now, &task.goals).unwrap_or_default()),
            Some([]) => Vec::new(),
            Some([next, rest @ ..]) => all("all move", next, rest.to_vec()),
        }
    }

    fn draw(&self, (task, _): &(Task, Only), (now, _): &State) -> String {
        task.draw(now)
    }
}

/// Whether every robot has a way to its goal that leads through no other start and goal.
fn is_well_formed(Task { graph, goals }: &Task, starts: &[u8]) -> bool {
    let has_way = |(&start, &goal): (&u8, &u8)| {
        let is_free = |cell: u8| (cell == goal || !goals.contains(&cell)) && !starts.contains(&cell);
        start == goal || graph.steps_through(start, is_free)[usize::from(goal)] != u8::MAX
    };
    starts.iter().zip(goals).all(has_way)
}

/// The starts from which robots can come to their goals: those to which they can come from there.
fn solvable(Task { graph, goals }: &Task) -> Vec<Vec<u8>> {
    let (mut found, mut ahead) = (BTreeSet::from([goals.clone()]), vec![goals.clone()]);
    while let Some(now) = ahead.pop() {
        let moves = combinations(now.iter().map(|&cell| [graph.beside(cell), &[cell]].concat()));
        let new = moves.filter(|to| !conflicts(&now, to) && found.insert(to.clone()));
        ahead.extend(new);
    }
    found.into_iter().collect()
}
