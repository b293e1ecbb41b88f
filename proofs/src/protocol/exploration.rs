//! Robots that explore together: they share a map of what each has seen, the cell where it is and those beside it. A
//! frontier is a cell on the map beside which a cell is not yet on it. Robots act one at a time, in any order.

use super::{Move, Protocol, with};
use crate::demands;
use crate::team::{Crew, Deployment, KnownGraph};

/// How robots choose where to go.
pub trait Explorers: Copy + Sync + 'static {
    /// The frontier to which a robot goes now, if any.
    fn target(&self, team: &Team<'_>, robot: usize) -> Option<u8>;

    /// Whether ways lead round other robots.
    fn goes_round(&self) -> bool {
        false
    }
}

/// Robots in a layout, as far as it is on their map.
#[derive(Debug)]
pub struct Team<'a> {
    /// The map.
    pub map: KnownGraph<'a>,
    /// Where they are.
    pub cells: &'a [u8],
    /// The frontier for which each has set out.
    pub targets: &'a [Option<u8>],
    goes_round: bool,
}

impl Team<'_> {
    /// Steps on the map from a cell to each; [`u8::MAX`] where no way leads.
    pub fn steps(&self, from: u8) -> Vec<u8> {
        self.map.steps(from, if self.goes_round { self.cells } else { &[] })
    }
}

/// All robots follow a rule in one of the layouts.
#[derive(Clone, Copy, Debug)]
pub struct Exploration<R>(
    /// The rule.
    pub R,
);

/// The cells on the map, where robots are, and for where they have set out.
type State = (u64, Vec<u8>, Vec<Option<u8>>);

impl<R: Explorers> Protocol for Exploration<R> {
    type Bound = Crew;
    type State = State;
    demands! {
        eventually "all cells are on the map",
            |_, crew, &(cells, ..)| KnownGraph { graph: &crew.graph, cells }.is_whole();
        always "no two robots have set out for one frontier", |_, _, _, (_, _, targets)| {
            let mut set: Vec<_> = targets.iter().flatten().collect();
            set.sort_unstable();
            set.is_sorted_by(|one, other| one < other)
        };
    }

    fn starts(&self, crew: &Deployment) -> impl IntoIterator<Item = State> {
        let known = |cells: &Vec<u8>| {
            let see = |known, &cell: &u8| KnownGraph { graph: &crew.graph, cells: known }.with_sight(cell);
            cells.iter().fold(0, see)
        };
        let none = vec![None; crew.robots];
        crew.graph.places(crew.robots).into_iter().map(move |cells| (known(&cells), cells, none.clone()))
    }

    fn moves(&self, crew: &Deployment, state: &State) -> Vec<Move<State>> {
        let (known, cells, targets) = state;
        let map = KnownGraph { graph: &crew.graph, cells: *known };
        let team = Team { map, cells, targets, goes_round: self.0.goes_round() };
        let act = |me: usize| {
            let target = self.0.target(&team, me);
            let next = target.and_then(|target| crew.graph.nearer(cells[me], &team.steps(target)));
            let targets = with(targets, me, target);
            match next.filter(|next| !cells.contains(next)) {
                Some(next) => Move::of(me, "goes", (map.with_sight(next), with(cells, me, next), targets)),
                None => Move::of(me, "waits", (*known, cells.clone(), targets)),
            }
        };
        (0..cells.len()).map(act).filter(|next| next.to != *state).collect()
    }

    fn draw(&self, crew: &Deployment, (known, cells, targets): &State) -> String {
        let map = KnownGraph { graph: &crew.graph, cells: *known };
        let sign = |cell: u8| {
            let here = cells.iter().position(|&other| other == cell);
            let set_out = targets.iter().position(|&target| target == Some(cell));
            let who =
                here.map_or(if map.has(cell) { '.' } else { '?' }, |robot| char::from(b'0' + robot as u8));
            format!("{who}{}", set_out.map_or(' ', |robot| char::from(b'a' + robot as u8)))
        };
        crew.graph.draw(sign)
    }
}
