//! BA*: Viet, Dang, Laskar and Chung (Applied Intelligence 39, 2013). A robot covers an area that it does not know by
//! boustrophedon motions: it goes on to the first cell beside it, north, south, east, west, that is neither covered nor
//! blocked. Where there is none, it goes back, by a shortest way through covered cells, to the nearest backtracking
//! point. That is a covered cell beside which a corner of what is not covered begins: a free cell in the east or west
//! whose northern or southern neighbour is blocked or covered, or in the south whose eastern or western one is; so the
//! paper's (7) and (8) are, as public implementations write them. By these a robot leaves cells out. It does not if
//! every covered cell beside a free one is a backtracking point.

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy)]
struct Conditions {
    /// A robot goes back where it is stuck.
    goes_back: bool,
    /// Only cells beside which a corner begins are backtracking points.
    by_corners: bool,
    /// It goes back to the nearest backtracking point, and not to the farthest.
    to_nearest: bool,
}

/// Whether beside `cell` begins a corner of what is not covered.
fn is_at_corner(graph: &Graph, covered: KnownGraph<'_>, cell: u8) -> bool {
    let free = |cell: u8, side| graph.to_side(cell, side).filter(|&next| !covered.has(next));
    let (rows, columns) = ([Side::North, Side::South], [Side::East, Side::West]);
    [(Side::East, rows), (Side::West, rows), (Side::South, columns)].into_iter().any(|(side, beside)| {
        free(cell, side).is_some_and(|next| beside.into_iter().any(|side| free(next, side).is_none()))
    })
}

/// Where the robot is, the cells that are covered, and its backtracking point.
type State = (u8, u64, Option<u8>);

impl Protocol for Conditions {
    type Bound = Crew;
    type State = State;
    demands! {
        eventually "all cells are covered",
            |_, crew, &(_, cells, _)| KnownGraph { graph: &crew.graph, cells }.is_whole();
        always "a robot goes to cells that are new", |_, _, before, after| before.1 >> after.0 & 1 == 0;
    }

    fn starts(&self, crew: &Deployment) -> impl IntoIterator<Item = State> {
        (0..crew.graph.len() as u8).map(|cell| (cell, 1 << cell, None))
    }

    fn moves(
        &self,
        Deployment { graph, .. }: &Deployment,
        &(here, cells, point): &State,
    ) -> Vec<Move<State>> {
        let covered = KnownGraph { graph, cells };
        let sides = [Side::North, Side::South, Side::East, Side::West];
        let mut ahead = sides.into_iter().filter_map(|side| graph.to_side(here, side));
        let point = point.filter(|&point| point != here);
        if let (Some(cell), None) = (ahead.find(|&cell| !covered.has(cell)), point) {
            return vec![Move::of(0, "sweeps", (cell, cells | 1 << cell, None))];
        }
        let steps = covered.steps(here, &[]);
        let far =
            |&cell: &u8| if self.to_nearest { steps[usize::from(cell)] } else { !steps[usize::from(cell)] };
        let is_point =
            |&cell: &u8| self.goes_back && (!self.by_corners || is_at_corner(graph, covered, cell));
        let points = || covered.frontiers().filter(is_point);
        let point = point.or_else(|| points().min_by_key(far));
        let next = point.and_then(|point| graph.nearer(here, &covered.steps(point, &[])));
        next.map(|cell| Move::of(0, "goes back", (cell, cells, point))).into_iter().collect()
    }

    fn draw(&self, crew: &Deployment, &(here, covered, _): &State) -> String {
        let sign = |cell: u8| match covered >> cell & 1 {
            _ if cell == here => "0",
            0 => ".",
            _ => "+",
        };
        crew.graph.draw(|cell| sign(cell).to_owned())
    }
}

const fn floors(width: i16, height: i16) -> Crew {
    Crew { robots: 1, graphs: Graphs::within(Kind::Connected, width, height) }
}

entry! { Conditions: "ba-star", "BA*", "SWEEP",
    "Viet, Dang, Laskar, Chung, *BA\\*: An Online Complete Coverage Algorithm for Cleaning Robots*, Applied \
     Intelligence 39, 2013";
    PUBLISHED = "published", Conditions { goes_back: true, by_corners: true, to_nearest: true };
    ANY = "to any free cell", Conditions { goes_back: true, by_corners: false, to_nearest: true };
    STUCK = "boustrophedon alone", Conditions { goes_back: false, by_corners: false, to_nearest: true };
    FAR = "to the farthest", Conditions { goes_back: true, by_corners: false, to_nearest: false };
    1: "Every cell MUST be covered." {
        Refuted PUBLISHED within floors(3, 3);
        Holds ANY within floors(3, 3), not STUCK;
        Refuted STUCK within floors(3, 3);
        Holds FAR within floors(3, 3);
    } larger {
        Holds ANY within floors(4, 4), not STUCK;
    }
    2: "No cell MUST be entered twice." {
        Refuted PUBLISHED within floors(3, 3);
    }
}
