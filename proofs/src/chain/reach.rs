//! The cells that a chain can reach at all, by a team that knows the layout: they count as missed when a run leaves
//! them unexplored. The conditions stand here in plain words, those of [`invariant`](super::invariant): of the kernel's
//! rule only the names of its conditions are used, and nothing of the planner.
//!
//! A configuration is where the robots R_2 … R_N are. [`Ground::reachable`] goes through all of them: it keeps for
//! every place of the followers the set of the leader's cells, one bit each, and moves whole sets at once. Where that
//! is too much, [`within_reach`](super::links::within_reach) bounds the answer from below.

mod cells;
mod ground;
mod limits;
mod relation;
mod search;

pub use cells::CellSet;
pub use ground::Ground;
pub use limits::{MAX_CELLS, MAX_FOLLOWERS, MAX_PLACES, TooLarge};
pub(super) use relation::{Followers, Relation};

#[cfg(test)]
pub(super) mod tests {
    use std::collections::{HashSet, VecDeque};

    use tautline_kernel::chain::{Condition, Move, Role, Rule};
    use tautline_kernel::choice::Oracle;
    use tautline_kernel::ground::{Area, Cell, Edge, Side, Step};

    use super::cells::cells_of;
    use super::{CellSet, Ground, TooLarge};
    use crate::chain::links::within_reach;
    use crate::chain::whole_runs;
    use crate::engine::SeededOracle;

    const RULES: [Rule; 7] = [
        Rule::PUBLISHED,
        Rule::REPAIRED,
        Rule::PUBLISHED.without(Condition::SafeAhead),
        Rule::PUBLISHED.without(Condition::CoveredBehind),
        Rule::PUBLISHED.without(Condition::Distinct),
        Rule::REPAIRED.without(Condition::Distinct),
        Rule::REPAIRED.without(Condition::Distinct).without(Condition::FullForLeader),
    ];

    /// The area of the paper, with the walls that `is_wall` says.
    pub(crate) fn ground(robots: usize, is_wall: impl Fn(Edge) -> bool) -> Ground {
        let (area, base) = whole_runs::area(robots);
        Ground::new(area, base, robots, |edge| !is_wall(edge)).expect("a base inside")
    }

    /// So many of the edges in a hundred are walls.
    pub(crate) fn random(
        robots: usize,
        area: Area,
        base: Cell,
        oracle: &mut SeededOracle,
        walls_percent: u32,
    ) -> Ground {
        let walls: HashSet<Edge> = area.edges().filter(|_| oracle.pick(100) < walls_percent).collect();
        Ground::new(area, base, robots, |edge| !walls.contains(&edge)).expect("a base inside")
    }

    /// All 4096 of them.
    pub(crate) fn layouts_of_two_robots() -> impl Iterator<Item = Ground> {
        let edges: Vec<Edge> = whole_runs::area(2).0.edges().collect();
        (0..1_u32 << edges.len()).map(move |walls| {
            ground(2, |edge| {
                edges.iter().position(|&one| one == edge).is_some_and(|place| walls >> place & 1 == 1)
            })
        })
    }

    /// One configuration after the other, each team move tried step by step, and admitted by the kernel's relation.
    fn plainly(ground: &Ground, rule: &Rule) -> CellSet {
        let mut reached = CellSet::new(ground.area());
        let start = vec![ground.base(); ground.robots()];
        let mut seen = HashSet::from([start.clone()]);
        let mut queue = VecDeque::from([start]);
        while let Some(cells) = queue.pop_front() {
            for &cell in &cells {
                reached.insert(cell);
            }
            for moves in team_moves(ground, rule, &cells) {
                let after: Vec<Cell> = moves.iter().map(|planned| planned.to()).collect();
                if seen.insert(after.clone()) {
                    queue.push_back(after);
                }
            }
        }
        reached
    }

    pub(crate) fn team_moves(ground: &Ground, rule: &Rule, cells: &[Cell]) -> Vec<Vec<Move>> {
        let mut teams = vec![vec![Move::stay(cells[0])]];
        for (robot, &from) in cells.iter().enumerate().skip(1) {
            let is_leader = robot + 1 == cells.len();
            let role = if is_leader { Role::Leader } else { Role::Follower };
            let mut longer = Vec::new();
            for team in teams {
                for step in Step::ALL.into_iter().filter(|&step| ground.admits(from, step)) {
                    let own = Move { from, step, known_open: true };
                    let stays = step == Step::Stay;
                    let others = cells.iter().filter(|&&cell| cell == own.to()).count();
                    let is_distinct = own.to() == cells[0]
                        || !rule.has(Condition::Distinct)
                        || team.iter().all(|other: &Move| other.to() != own.to());
                    if rule.admits_ahead(team[robot - 1], own)
                        && (is_leader && stays || rule.admits_behind(own.to(), cells[robot - 1]))
                        && (stays || own.to() == cells[0] || rule.admits_entry(role, others))
                        && is_distinct
                    {
                        longer.push([team.as_slice(), &[own]].concat());
                    }
                }
            }
            teams = longer;
        }
        teams
    }

    fn agrees(ground: &Ground, rule: &Rule) {
        let reached = ground.reachable(rule).expect("a small ground");
        assert_eq!(reached, plainly(ground, rule), "{rule:?} {ground:?}");
        let is_open = |edge: Edge| ground.admits(edge.cell(), Step::Cross(edge.side()));
        let within_reach = within_reach(ground.area(), ground.base(), ground.robots(), is_open);
        assert!(within_reach.into_iter().all(|cell| reached.contains(cell)), "{rule:?} {ground:?}");
        for cell in ground.area().cells() {
            let mut wanted = CellSet::new(ground.area());
            wanted.insert(cell);
            let is_reached = ground.reaches_any(rule, &wanted).expect("a small ground");
            assert_eq!(is_reached, reached.contains(cell), "{cell}");
        }
    }

    #[test]
    fn two_robots_reach_what_plain_search_says_in_all_layouts() {
        for ground in layouts_of_two_robots() {
            for rule in &RULES {
                agrees(&ground, rule);
            }
        }
    }

    #[test]
    fn three_robots_miss_a_corner_behind_an_inner_corner_and_nothing_else_behind_two_walls() {
        let edges: Vec<Edge> = ground(3, |_| false).area().edges().collect();
        let mut missed = Vec::new();
        for (place, &one) in edges.iter().enumerate() {
            for &other in &edges[place..] {
                let ground = ground(3, |edge| edge == one || edge == other);
                agrees(&ground, &Rule::REPAIRED);
                let reached = ground.reachable(&Rule::REPAIRED).expect("a small ground");
                let walkable = ground.walkable();
                let cells: Vec<Cell> = walkable.iter().filter(|&cell| !reached.contains(cell)).collect();
                missed.extend((!cells.is_empty()).then_some(((one, other), cells)));
            }
        }
        // The walls stand on the two sides of an inner corner that look towards the base.
        let behind = |corner: Cell, towards: [Side; 2], cell| {
            let [one, other] = towards.map(|side| Edge::new(corner, side));
            ((one, other), vec![cell])
        };
        assert_eq!(
            missed,
            [
                behind(Cell::new(1, 1), [Side::East, Side::South], Cell::new(0, 0)),
                behind(Cell::new(3, 1), [Side::West, Side::South], Cell::new(4, 0)),
                behind(Cell::new(1, 3), [Side::North, Side::East], Cell::new(0, 4)),
                behind(Cell::new(3, 3), [Side::North, Side::West], Cell::new(4, 4)),
            ]
        );
    }

    #[test]
    fn what_is_too_large_is_said() {
        assert_eq!(ground(7, |_| false).reachable(&Rule::REPAIRED), Err(TooLarge::Cells { cells: 169 }));
        let row = Area::new(Cell::new(0, 0), Cell::new(4, 4)).expect("cells");
        let crowd = |robots| Ground::new(row, Cell::new(2, 2), robots, |_| true).expect("a base inside");
        assert_eq!(crowd(8).reachable(&Rule::REPAIRED), Err(TooLarge::Places));
        assert_eq!(crowd(60_000).reachable(&Rule::REPAIRED), Err(TooLarge::Places));
        assert_eq!(Ground::new(row, Cell::new(5, 2), 3, |_| true), None);
    }

    #[test]
    fn more_robots_reach_what_plain_search_says_in_random_layouts() {
        let mut oracle = SeededOracle::new(0, 0);
        let mut next = |robots, walls_percent| {
            let (area, base) = whole_runs::area(robots);
            random(robots, area, base, &mut oracle, walls_percent)
        };
        for (robots, layouts, rules) in [(3, 60, &RULES[..]), (4, 6, &RULES[..2])] {
            for _ in 0..layouts {
                for walls_percent in [10, 25, 40, 50] {
                    let ground = next(robots, walls_percent);
                    for rule in rules {
                        agrees(&ground, rule);
                    }
                }
            }
        }
        agrees(&next(4, 30), &RULES[6]);
        agrees(&next(5, 35), &Rule::REPAIRED);
    }

    #[test]
    fn an_open_area_is_reached_whole() {
        for robots in 1..=6 {
            let ground = ground(robots, |_| false);
            let all = cells_of(ground.area());
            assert_eq!(ground.reachable(&Rule::REPAIRED).expect("a small ground").len(), all, "{robots}");
        }
    }
}
