//! Robots that explore together: they share a map of what each has seen, the cell where it is and those beside it. A
//! frontier is a cell on the map beside which a cell is not yet on it. Robots act one at a time, in any order.

use crate::prelude::*;

/// How robots choose where to go.
pub(crate) trait Explorers: Copy + Sync + 'static {
    /// The frontier to which a robot goes now, if any.
    fn target(&self, team: &Team<'_>, robot: usize) -> Option<u8>;

    /// Whether ways lead round other robots.
    fn goes_round(&self) -> bool {
        false
    }
}

/// Robots in a layout, as far as it is on their map.
pub(crate) struct Team<'a> {
    pub(crate) graph: &'a Graph,
    seen: u16,
    pub(crate) cells: &'a [u8],
    /// The frontier for which each has set out.
    pub(crate) targets: &'a [Option<u8>],
    goes_round: bool,
}

impl Team<'_> {
    fn has_seen(&self, cell: u8) -> bool {
        self.seen >> cell & 1 == 1
    }

    /// Whether a cell is a frontier.
    pub(crate) fn is_frontier(&self, cell: u8) -> bool {
        self.has_seen(cell) && self.graph.beside(cell).iter().any(|&other| !self.has_seen(other))
    }

    /// The frontiers, by number.
    pub(crate) fn frontiers(&self) -> impl Iterator<Item = u8> {
        (0..self.graph.len() as u8).filter(|&cell| self.is_frontier(cell))
    }

    /// Steps on the map from a cell to each; `u8::MAX` where no way leads.
    pub(crate) fn steps(&self, from: u8) -> Vec<u8> {
        let is_free = |cell: u8| self.has_seen(cell) && !(self.goes_round && self.cells.contains(&cell));
        self.graph.steps_through(from, is_free)
    }
}

/// All robots follow a rule in one of the layouts.
pub(crate) struct Exploration<R>(R, usize, Vec<Graph>);

/// The number of the layout, the cells on the map, where robots are, and for where they have set out.
type State = (u16, u16, Vec<u8>, Vec<Option<u8>>);

impl<R: Explorers> Exploration<R> {
    fn team<'a>(&'a self, (graph, seen, cells, targets): &'a State) -> Team<'a> {
        let goes_round = self.0.goes_round();
        Team { graph: &self.2[usize::from(*graph)], seen: *seen, cells, targets, goes_round }
    }
}

/// A cell and those beside it.
fn sight(graph: &Graph, cell: u8) -> u16 {
    graph.beside(cell).iter().fold(1 << cell, |set, beside| set | 1 << beside)
}

/// Teams that start in every place; they have no goals.
pub(crate) struct Crew(pub(crate) Teams);

impl fmt::Display for Crew {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} robots, {}, every start, one at a time in any order", self.0.robots, self.0.graphs)
    }
}

impl<R: Explorers> Protocol for Exploration<R> {
    type Rule = R;
    type Bound = Crew;
    type State = State;
    const DEMANDS: &'static [Demand<Self>] = &[
        Demand::always("no two robots are in one cell", |_, before: &State, after: &State| {
            !conflicts(&before.2, &after.2)
        }),
        Demand::eventually("all cells are on the map", |exploration, state: &State| {
            state.1.count_ones() as usize == exploration.team(state).graph.len()
        }),
        Demand::always("no two robots have set out for one frontier", |_, _, (.., targets): &State| {
            let set = targets.iter().flatten();
            set.clone()
                .enumerate()
                .all(|(place, target)| set.clone().take(place).all(|other| other != target))
        }),
    ];

    fn new(&rule: &R, Crew(teams): &Crew) -> Result<Self, MethodError> {
        Ok(Self(rule, teams.robots, teams.graphs.all()?))
    }

    fn starts(&self) -> impl Iterator<Item = State> {
        self.2.iter().zip(0..).flat_map(|(graph, number)| {
            let places = graph.places(self.1).into_iter();
            places.map(move |cells| {
                let seen = cells.iter().fold(0, |set, &cell| set | sight(graph, cell));
                (number, seen, cells.clone(), vec![None; cells.len()])
            })
        })
    }

    fn moves(&self, state: &State) -> Vec<Move<State>> {
        let team = self.team(state);
        let mut moves = Vec::new();
        for me in 0..self.1 {
            let mut to = state.clone();
            let (here, target) = (state.2[me], self.0.target(&team, me));
            to.3[me] = target;
            let mut words = "waits";
            if let Some(target) = target {
                let steps = team.steps(target);
                let nearer = |&&cell: &&u8| steps[usize::from(cell)] < steps[usize::from(here)];
                let next = team
                    .graph
                    .beside(here)
                    .iter()
                    .filter(nearer)
                    .min_by_key(|&&cell| steps[usize::from(cell)]);
                if let Some(&cell) = next.filter(|cell| !state.2.contains(cell)) {
                    to.2[me] = cell;
                    to.1 |= sight(team.graph, cell);
                    words = "goes";
                }
            }
            if to != *state {
                moves.push(Move::of(me, words, to));
            }
        }
        moves
    }

    fn draw(&self, state: &State) -> String {
        let team = self.team(state);
        let sign = |cell: u8| {
            let here = state.2.iter().position(|&other| other == cell);
            let set_out = state.3.iter().position(|&target| target == Some(cell));
            let unseen = if team.has_seen(cell) { '.' } else { '?' };
            let who = here.map_or(unseen, |robot| char::from(b'0' + robot as u8));
            format!("{who}{}", set_out.map_or(' ', |robot| char::from(b'a' + robot as u8)))
        };
        team.graph.draw(sign)
    }
}
