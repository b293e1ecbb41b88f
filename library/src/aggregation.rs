//! Aggregation without computing: Gauci, Chen, Li, Dodd and Groß (International Journal of Robotics Research 33, 2014). A
//! robot has a sensor of one bit, whether it sees a robot straight ahead, and no memory. If it sees none it goes backwards
//! along an arc; if it sees one it turns on the spot. The paper's robots are discs on a plane; here they are on cells: an
//! arc is a step back and a quarter turn, and a robot whose way is blocked only turns.

use crate::prelude::*;

/// How a robot goes back that sees no other one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Rule {
    /// Along an arc.
    Published,
    /// Straight, and it turns only where its way is blocked.
    Straight,
}

/// Robots, the cells of a side of the arena, and who acts at once.
struct Arena(usize, i8, Moves);

impl fmt::Display for Arena {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} robots, {1}×{1} cells, every start, {2}", self.0, self.1, self.2)
    }
}

/// Column, row, and heading in quarter turns.
type Robot = (i8, i8, u8);

struct Robots(Rule, &'static Arena);

/// The cell so many steps ahead.
fn ahead((x, y, heading): Robot, steps: i8) -> (i8, i8) {
    let (columns, rows) = WAYS[usize::from(heading)];
    (x + columns * steps, y + rows * steps)
}

impl Robots {
    fn sees(&self, robots: &[Robot], me: usize) -> bool {
        let is_at = |cell: (i8, i8)| robots.iter().any(|robot| (robot.0, robot.1) == cell);
        (1..self.1.1).any(|steps| is_at(ahead(robots[me], steps)))
    }

    /// Where a robot goes and how it heads then; and how it heads if its way is blocked.
    fn wish(&self, robots: &[Robot], me: usize) -> (Robot, u8) {
        let (column, row, heading) = robots[me];
        if self.sees(robots, me) {
            return ((column, row, (heading + 1) % 4), heading);
        }
        let (back, turned) = (ahead(robots[me], -1), (heading + 3) % 4);
        ((back.0, back.1, if self.0 == Rule::Published { turned } else { heading }), turned)
    }

    /// The robots once these have acted: none enters a cell that is taken, or that another one enters.
    fn after(&self, robots: &[Robot], acting: Bits) -> Vec<Robot> {
        let stays = |me: usize| (robots[me], robots[me].2);
        let wish = |me: usize| if acting >> me & 1 == 1 { self.wish(robots, me) } else { stays(me) };
        let wishes: Vec<(Robot, u8)> = (0..robots.len()).map(wish).collect();
        let is_free = |me: usize| {
            let (column, row, _) = wishes[me].0;
            let is_there = |robot: &Robot| (robot.0, robot.1) == (column, row);
            let is_taken = |other: usize| is_there(&robots[other]) || is_there(&wishes[other].0);
            let side = 0..self.1.1;
            let others = (0..robots.len()).filter(|&other| other != me);
            side.contains(&column) && side.contains(&row) && !others.into_iter().any(is_taken)
        };
        let go =
            |me: usize| if is_free(me) { wishes[me].0 } else { (robots[me].0, robots[me].1, wishes[me].1) };
        (0..robots.len()).map(go).collect()
    }

    /// Whether the robots are in cells that hang together.
    fn is_cluster(robots: &[Robot]) -> bool {
        let is_beside = |one: &Robot, other: &Robot| one.0.abs_diff(other.0) + one.1.abs_diff(other.1) == 1;
        hang_together(robots, is_beside)
    }
}

impl Protocol for Robots {
    type Rule = Rule;
    type Bound = &'static Arena;
    type State = Vec<Robot>;
    const DEMANDS: &'static [Demand<Self>] = &[
        Demand::eventually("all robots are in one cluster", |_, robots: &Vec<Robot>| {
            Self::is_cluster(robots)
        }),
        Demand::always("a cluster stays one", |_, before: &Vec<Robot>, after: &Vec<Robot>| {
            !Self::is_cluster(before) || Self::is_cluster(after)
        }),
    ];

    fn new(&rule: &Rule, arena: &&'static Arena) -> Result<Self, MethodError> {
        MethodError::unless(arena.0 <= (arena.1 * arena.1) as usize, "the arena has no room for the robots")?;
        Ok(Self(rule, arena))
    }

    fn starts(&self) -> impl Iterator<Item = Vec<Robot>> {
        let side = self.1.1;
        let at = |cell: i8| (0..4).map(move |heading| (cell % side, cell / side, heading));
        let any: Vec<Robot> = (0..side * side).flat_map(at).collect();
        let apart =
            |robots: &Vec<Robot>| robots.is_sorted_by(|one, other| (one.1, one.0) < (other.1, other.0));
        combinations(iter::repeat_n(any, self.1.0)).filter(apart)
    }

    fn moves(&self, robots: &Vec<Robot>) -> Vec<Move<Vec<Robot>>> {
        let act = |actors: Bits| Move { actors, words: "act", to: self.after(robots, actors) };
        self.1.2.sets(robots.len()).map(act).collect()
    }

    /// The arena in its quarter turns.
    fn alike(&self, robots: &Vec<Robot>) -> Vec<Vec<Robot>> {
        let turn = |&(x, y, heading): &Robot| (self.1.1 - 1 - y, x, (heading + 1) % 4);
        turned(robots, |robots| robots.iter().map(turn).collect())
    }

    fn draw(&self, robots: &Vec<Robot>) -> String {
        let at = |x, y| robots.iter().find(|robot| (robot.0, robot.1) == (x, y));
        arrows(self.1.1, |x, y| at(x, y).map(|robot| robot.2))
    }
}

const TWO: Arena = Arena(2, 4, Moves::Together);
const ONE_BY_ONE: Arena = Arena(2, 4, Moves::OneAtATime);
const THREE: Arena = Arena(3, 4, Moves::Together);
const PUBLISHED: NamedRule<Rule> = NamedRule::new("published", Rule::Published);
const STRAIGHT: NamedRule<Rule> = NamedRule::new("goes straight", Rule::Straight);

/// The rule.
pub(crate) static ENTRY: Entry = Entry {
    name: "aggregation",
    title: "aggregation without computing",
    source: "after Gauci, Chen, Li, Dodd, Groß, *Self-organized Aggregation without Computation*, International Journal of \
             Robotics Research 33, 2014: its controller, on cells",
    promises: &[
        promise(
            "AGGREGATE-1",
            "All robots MUST come into one cluster.",
            &[
                &Check::new(PUBLISHED, &Keeps::<Robots>(&TWO, 0), Refuted, &[]),
                &Check::new(PUBLISHED, &Keeps::<Robots>(&ONE_BY_ONE, 0), Refuted, &[]),
                &Check::new(PUBLISHED, &Keeps::<Robots>(&THREE, 0), Refuted, &[]),
                &Check::new(STRAIGHT, &Keeps::<Robots>(&TWO, 0), Refuted, &[]),
            ],
        ),
        promise(
            "AGGREGATE-2",
            "A cluster MUST stay one.",
            &[&Check::new(PUBLISHED, &Keeps::<Robots>(&TWO, 1), Refuted, &[])],
        ),
    ],
};
