//! Aggregation without computing: Gauci, Chen, Li, Dodd and Groß (International Journal of Robotics Research 33, 2014).
//! A robot has a sensor of one bit, whether it sees a robot straight ahead, and no memory. If it sees none it goes
//! backwards along an arc; if it sees one it turns on the spot. The paper's robots are discs on a plane; here they are
//! on cells: an arc is a step back and a quarter turn, and a robot whose way is blocked only turns.

use crate::prelude::*;

/// How a robot goes back that sees no other one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Rule {
    /// Along an arc.
    Published,
    /// Straight, and it turns only where its way is blocked.
    Straight,
}

bound! {
    /// Robots, the cells of a side of the arena, and who acts at once.
    Arena { robots: usize, side: i8, moves: Moves } "{robots} robots, {side}×{side} cells, every start, {moves}";
    robots <= (side * side) as usize, "the arena has no room for the robots";
    moves != Moves::LookThenMove, "a robot looks and goes in one step here"
}

/// Column, row, and heading in quarter turns.
type Robot = (i8, i8, u8);

/// The cell so many steps ahead.
fn ahead((x, y, heading): Robot, steps: i8) -> (i8, i8) {
    let (columns, rows) = WAYS[usize::from(heading)];
    (x + columns * steps, y + rows * steps)
}

impl Rule {
    /// Where a robot goes and how it heads then; and how it heads if its way is blocked.
    fn wish(self, arena: &Arena, robots: &[Robot], me: usize) -> (Robot, u8) {
        let (column, row, heading) = robots[me];
        let is_at = |cell: (i8, i8)| robots.iter().any(|robot| (robot.0, robot.1) == cell);
        if (1..arena.side).any(|steps| is_at(ahead(robots[me], steps))) {
            return ((column, row, (heading + 1) % 4), heading);
        }
        let (back, turned) = (ahead(robots[me], -1), (heading + 3) % 4);
        ((back.0, back.1, if self == Self::Published { turned } else { heading }), turned)
    }

    /// The robots once these have acted: none enters a cell that is taken, or that another one enters.
    fn after(self, arena: &Arena, robots: &[Robot], acting: Bits) -> Vec<Robot> {
        let wish = |me: usize| match acting >> me & 1 {
            1 => self.wish(arena, robots, me),
            _ => (robots[me], robots[me].2),
        };
        let wishes: Vec<(Robot, u8)> = (0..robots.len()).map(wish).collect();
        let go = |me: usize| {
            let ((column, row, _), side) = (wishes[me].0, 0..arena.side);
            let is_there = |robot: &Robot| (robot.0, robot.1) == (column, row);
            let is_taken = |other: usize| is_there(&robots[other]) || is_there(&wishes[other].0);
            let is_inside = side.contains(&column) && side.contains(&row);
            let is_free = is_inside && !(0..robots.len()).any(|other| other != me && is_taken(other));
            if is_free { wishes[me].0 } else { (robots[me].0, robots[me].1, wishes[me].1) }
        };
        (0..robots.len()).map(go).collect()
    }
}

/// Whether the robots are in cells that hang together.
fn is_cluster(robots: &[Robot]) -> bool {
    hang_together(robots, |one, other| one.0.abs_diff(other.0) + one.1.abs_diff(other.1) == 1)
}

impl Protocol for Rule {
    type Bound = Arena;
    type State = Vec<Robot>;
    demands! {
        eventually "all robots are in one cluster", |_, _, robots| is_cluster(robots);
        always "a cluster stays one", |_, _, before, after| !is_cluster(before) || is_cluster(after);
    }

    fn starts(&self, &Arena { robots, side, .. }: &Arena) -> impl IntoIterator<Item = Vec<Robot>> {
        let at = |cell: i8| (0..4).map(move |heading| (cell % side, cell / side, heading));
        let any: Vec<Robot> = (0..side * side).flat_map(at).collect();
        let apart =
            |robots: &Vec<Robot>| robots.is_sorted_by(|one, other| (one.1, one.0) < (other.1, other.0));
        combinations(vec![any; robots]).filter(apart)
    }

    fn moves(&self, arena: &Arena, robots: &Vec<Robot>) -> Vec<Move<Vec<Robot>>> {
        let act = |actors: Bits| Move::of_set(actors, "act", self.after(arena, robots, actors));
        arena.moves.sets(robots.len()).map(act).collect()
    }

    /// The arena in its quarter turns.
    fn alike(&self, arena: &Arena, robots: &Vec<Robot>) -> Vec<Vec<Robot>> {
        let turn = |&(x, y, heading): &Robot| (arena.side - 1 - y, x, (heading + 1) % 4);
        turned(robots, |robots| robots.iter().map(turn).collect())
    }

    fn draw(&self, arena: &Arena, robots: &Vec<Robot>) -> String {
        let at = |x, y| robots.iter().find(|robot| (robot.0, robot.1) == (x, y));
        arrows(arena.side, |x, y| at(x, y).map(|robot| robot.2))
    }
}

const TWO: Arena = Arena { robots: 2, side: 4, moves: Moves::Together };

entry! { Rule: "aggregation", "aggregation without computing", "AGGREGATE",
    "after Gauci, Chen, Li, Dodd, Groß, *Self-organized Aggregation without Computation*, International Journal of \
     Robotics Research 33, 2014: its controller, on cells";
    ON_CELLS = "controller on cells", Rule::Published;
    STRAIGHT = "goes straight", Rule::Straight;
    1: "All robots MUST come into one cluster." {
        Refuted ON_CELLS within TWO;
        Refuted ON_CELLS within Arena { moves: Moves::OneAtATime, ..TWO };
        Refuted ON_CELLS within Arena { robots: 3, ..TWO };
        Refuted STRAIGHT within TWO;
    }
    2: "A cluster MUST stay one: a demand of ours." {
        Refuted ON_CELLS within TWO;
    }
}
