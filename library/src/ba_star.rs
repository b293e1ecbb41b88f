//! BA*: Viet, Dang, Laskar and Chung (Applied Intelligence 39, 2013). A robot covers an area that it does not know by
//! boustrophedon motions: it goes on to the first cell beside it, north, south, east, west, that is neither covered nor
//! blocked. Where there is none, it goes back, by a shortest way through covered cells, to the nearest backtracking
//! point, a covered cell beside which one is not covered. Without going back, boustrophedon motions leave cells out.

use tautline_kernel::ground::Side;

use crate::prelude::*;

/// The conditions of the rule.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Conditions {
    /// A robot goes back where it is stuck.
    goes_back: bool,
    /// It goes back to the nearest backtracking point, and not to the farthest.
    to_nearest: bool,
}

/// One robot in these layouts, from every start.
struct Floors(Graphs);

impl fmt::Display for Floors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "1 robot, {}, every start", self.0)
    }
}

struct Sweep(Conditions, Vec<Graph>);

/// The number of the layout, where the robot is, the cells that are covered, and its backtracking point.
type State = (u16, u8, u16, Option<u8>);

impl Protocol for Sweep {
    type Rule = Conditions;
    type Bound = Floors;
    type State = State;
    const DEMANDS: &'static [Demand<Self>] = &[
        Demand::eventually("all cells are covered", |sweep, &(graph, _, covered, _): &State| {
            covered.count_ones() as usize == sweep.1[usize::from(graph)].len()
        }),
        Demand::always("a robot goes to cells that are new", |_, before: &State, after: &State| {
            before.2 >> after.1 & 1 == 0
        }),
    ];

    fn new(&rule: &Conditions, Floors(graphs): &Floors) -> Result<Self, MethodError> {
        Ok(Self(rule, graphs.all()?))
    }

    fn starts(&self) -> impl Iterator<Item = State> {
        let all = self.1.iter().zip(0..);
        all.flat_map(|(graph, number)| {
            (0..graph.len() as u8).map(move |cell| (number, cell, 1 << cell, None))
        })
    }

    fn moves(&self, &(number, here, covered, point): &State) -> Vec<Move<State>> {
        let graph = &self.1[usize::from(number)];
        let is_new = |&cell: &u8| covered >> cell & 1 == 0;
        let sides = [Side::North, Side::South, Side::East, Side::West];
        let ahead = sides.into_iter().filter_map(|side| graph.to_side(here, side)).find(is_new);
        let point = point.filter(|&point| point != here);
        if let (Some(cell), None) = (ahead, point) {
            return vec![Move::of(0, "sweeps", (number, cell, covered | 1 << cell, None))];
        }
        let steps = |from: u8| graph.steps_through(from, |cell| !is_new(&cell));
        let ways = steps(here);
        let is_point = |&cell: &u8| !is_new(&cell) && graph.beside(cell).iter().any(&is_new);
        let far = |&cell: &u8| {
            if self.0.to_nearest { ways[usize::from(cell)] } else { u8::MAX - ways[usize::from(cell)] }
        };
        let points = (0..graph.len() as u8).filter(is_point).filter(|_| self.0.goes_back);
        let Some(point) = point.or_else(|| points.min_by_key(far)) else { return Vec::new() };
        let back = steps(point);
        let next = graph.beside(here).iter().min_by_key(|&&cell| back[usize::from(cell)]);
        next.map(|&cell| Move::of(0, "goes back", (number, cell, covered, Some(point)))).into_iter().collect()
    }

    fn draw(&self, &(number, here, covered, _): &State) -> String {
        let sign = |cell: u8| {
            if cell == here {
                "0"
            } else if covered >> cell & 1 == 1 {
                "+"
            } else {
                "."
            }
        };
        self.1[usize::from(number)].draw(|cell| sign(cell).to_owned())
    }
}

const fn floors(width: i16, height: i16) -> Floors {
    Floors(Graphs::within(Kind::Connected, width, height))
}

const RULE: Conditions = Conditions { goes_back: true, to_nearest: true };
const PUBLISHED: NamedRule<Conditions> = NamedRule::new("published", RULE);
const STUCK: NamedRule<Conditions> =
    NamedRule::new("boustrophedon alone", Conditions { goes_back: false, ..RULE });
const FAR: NamedRule<Conditions> =
    NamedRule::new("to the farthest", Conditions { to_nearest: false, ..RULE });

/// The rule.
pub(crate) static ENTRY: Entry = Entry {
    name: "ba-star",
    title: "BA*",
    source: "Viet, Dang, Laskar, Chung, *BA\\*: An Online Complete Coverage Algorithm for Cleaning Robots*, Applied \
             Intelligence 39, 2013",
    promises: &[
        promise(
            "SWEEP-1",
            "Every cell MUST be covered.",
            &[
                &Check::new(PUBLISHED, &Keeps::<Sweep>(floors(3, 3), 0), Holds, &[STUCK]),
                &Check::new(STUCK, &Keeps::<Sweep>(floors(3, 3), 0), Refuted, &[]),
                &Check::new(FAR, &Keeps::<Sweep>(floors(3, 3), 0), Holds, &[]),
            ],
        )
        .larger(&[&Check::new(PUBLISHED, &Keeps::<Sweep>(floors(4, 4), 0), Holds, &[STUCK])]),
        promise(
            "SWEEP-2",
            "No cell MUST be entered twice.",
            &[&Check::new(PUBLISHED, &Keeps::<Sweep>(floors(3, 3), 1), Refuted, &[])],
        ),
    ],
};
