//! What a chain can reach at all, by a team that knows the layout: the cells that count as missed when a run leaves
//! them unexplored. The conditions stand here in plain words, those of [`super::invariant`]: of the kernel's
//! rule only the names of its conditions are used, and nothing of the planner.
//!
//! A configuration is where the robots R_2 … R_N are. [`Ground::reachable`] goes through all of them: it keeps for
//! every place of the followers the set of the leader's cells, one bit each, and moves whole sets at once. Where that
//! is too much, [`within_reach`](super::links::within_reach) and [`Ground::perhaps_reachable`] bound the answer from both
//! sides.

use std::collections::VecDeque;
use std::fmt;

use tautline_kernel::chain::{self, Condition, Rule};
use tautline_kernel::ground::{Area, Cell, Edge, Side, Step};

use super::invariant::{in_covered, in_safe};

/// Most cells of a ground that [`Ground::reachable`] bears: one bit each in a word.
pub const MAX_CELLS: usize = 128;

/// Most places of the followers that [`Ground::reachable`] bears: up to six robots in the open.
pub const MAX_PLACES: usize = 1 << 20;

/// Why it cannot be said exactly what is reachable.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TooLarge {
    /// The chain's area has more than [`MAX_CELLS`].
    Cells {
        /// Cells it has.
        cells: usize,
    },
    /// The followers can be placed in more than [`MAX_PLACES`] ways, or are more than [`MAX_FOLLOWERS`].
    Places,
}

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cells { cells } => {
                write!(f, "{cells} cells are too many to say what is reachable: at most {MAX_CELLS}")
            }
            Self::Places => {
                write!(f, "the followers have too many places to say what is reachable: at most {MAX_PLACES}")
            }
        }
    }
}

impl std::error::Error for TooLarge {}

/// Cells of an area.
#[derive(Clone, PartialEq, Eq)]
pub struct CellSet {
    area: Area,
    /// Row by row, one bit each.
    words: Vec<u64>,
}

impl CellSet {
    /// No cell of `area`.
    pub fn new(area: Area) -> Self {
        Self { area, words: vec![0; cells_of(area).div_ceil(64)] }
    }

    /// The cells that it may hold.
    pub const fn area(&self) -> Area {
        self.area
    }

    /// Adds `cell`; no effect outside the area.
    pub fn insert(&mut self, cell: Cell) {
        if let Some(index) = index(self.area, cell) {
            self.words[index / 64] |= 1 << (index % 64);
        }
    }

    /// Whether `cell` is in the set.
    pub fn contains(&self, cell: Cell) -> bool {
        index(self.area, cell).is_some_and(|index| self.words[index / 64] >> (index % 64) & 1 == 1)
    }

    /// How many cells it holds.
    pub fn len(&self) -> usize {
        self.words.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// Whether it holds none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Its cells, row by row.
    pub fn iter(&self) -> impl Iterator<Item = Cell> {
        self.area.cells().filter(|&cell| self.contains(cell))
    }

    pub(crate) fn of_bits(area: Area, bits: u128) -> Self {
        let words = (0..cells_of(area).div_ceil(64)).map(|word| (bits >> (64 * word)) as u64).collect();
        Self { area, words }
    }
}

impl fmt::Debug for CellSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.iter()).finish()
    }
}

const fn cells_of(area: Area) -> usize {
    area.width() * area.height()
}

fn index(area: Area, cell: Cell) -> Option<usize> {
    area.locate(cell).map(|(column, row)| row * area.width() + column)
}

/// The part of a layout that a chain could explore: no cell farther than N−1 columns or rows from the base.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Ground {
    area: Area,
    base: Cell,
    robots: usize,
    /// By cell, row by row: whether each of its [`Side::ALL`] is open.
    open: Vec<[bool; 4]>,
}

impl Ground {
    /// The ground of `robots`, the base counted, all in the cell `base` of `area`. `is_open` tells of every edge inside
    /// the area whether it can be crossed; the border is closed. `None` if the base is outside the area.
    pub fn new(area: Area, base: Cell, robots: usize, is_open: impl Fn(Edge) -> bool) -> Option<Self> {
        let area = chain::area(area, base, robots)?;
        let mut open = vec![[false; 4]; cells_of(area)];
        for edge in area.edges() {
            let (one, other) = (edge.cell(), edge.cell().beyond(edge.side()));
            if let (true, Some(one), Some(other)) = (is_open(edge), index(area, one), index(area, other)) {
                open[one][edge.side() as usize] = true;
                open[other][edge.side().opposite() as usize] = true;
            }
        }
        Some(Self { area, base, robots, open })
    }

    /// The cells it spans.
    pub const fn area(&self) -> Area {
        self.area
    }

    /// The base.
    pub const fn base(&self) -> Cell {
        self.base
    }

    /// Robots, base included.
    pub const fn robots(&self) -> usize {
        self.robots
    }

    /// Whether a robot in `cell` can make `step`: it stays, or crosses an open edge.
    pub fn admits(&self, cell: Cell, step: Step) -> bool {
        match step {
            Step::Stay => true,
            Step::Cross(side) => index(self.area, cell).is_some_and(|index| self.open[index][side as usize]),
        }
    }

    /// The cells that can be walked to from the base.
    fn walkable(&self) -> CellSet {
        let mut seen = CellSet::new(self.area);
        seen.insert(self.base);
        let mut queue = VecDeque::from([self.base]);
        while let Some(cell) = queue.pop_front() {
            for side in Side::ALL {
                let beyond = cell.beyond(side);
                if self.admits(cell, Step::Cross(side)) && !seen.contains(beyond) {
                    seen.insert(beyond);
                    queue.push_back(beyond);
                }
            }
        }
        seen
    }

    /// All cells that the chain can reach under `rule`, and perhaps others, for any number of robots.
    ///
    /// Every two neighbours are looked at alone, from the base outwards: of R_i it is remembered which steps it can
    /// make from which cell, as the robot ahead of R_{i−1}; what R_{i+1} can do is then found with whatever step of
    /// R_i suits it. What a whole chain does, each of its pairs can do, but not the other way round. Without
    /// *SafeAhead* neighbours can be anywhere, and all cells that can be walked to are returned.
    pub fn perhaps_reachable(&self, rule: &Rule) -> CellSet {
        if !rule.has(Condition::SafeAhead) {
            return self.walkable();
        }
        let mut reached = CellSet::new(self.area);
        reached.insert(self.base);
        let mut behind = Steps::new(self.area);
        behind.insert(self.base, Step::Stay);
        for robot in 2..=self.robots {
            behind = self.pair(rule, robot, &behind, &mut reached);
        }
        reached
    }

    /// The steps of R_`robot` if the one behind it makes those of `behind`, all from the base.
    fn pair(&self, rule: &Rule, robot: usize, behind: &Steps, reached: &mut CellSet) -> Steps {
        let mut steps = Steps::new(self.area);
        // Of every cell of the robot behind: where this one has been seen with it, by offset in E_S.
        let mut seen = vec![[false; 9]; cells_of(self.area)];
        let mut pairs = vec![(self.base, self.base)];
        while let Some((from_behind, from)) = pairs.pop() {
            for to_behind in behind.from(from_behind) {
                for step in Step::ALL.into_iter().filter(|&step| self.admits(from, step)) {
                    let to = from.after(step);
                    let is_null = robot == self.robots && step == Step::Stay;
                    let is_covered =
                        is_null || !rule.has(Condition::CoveredBehind) || in_covered(from_behind, to);
                    let is_distinct = !rule.has(Condition::Distinct) || to != to_behind || to == self.base;
                    if !(in_safe(to, to_behind) && is_covered && is_distinct) {
                        continue;
                    }
                    steps.insert(from, step);
                    reached.insert(to);
                    let offset = (to.x - to_behind.x + 1) + 3 * (to.y - to_behind.y + 1);
                    if let Some(index) = index(self.area, to_behind)
                        && !std::mem::replace(&mut seen[index][offset as usize], true)
                    {
                        pairs.push((to_behind, to));
                    }
                }
            }
        }
        steps
    }

    /// The cells that the chain can reach under `rule`: every configuration is looked at.
    ///
    /// # Errors
    /// [`TooLarge`] if there are too many.
    pub fn reachable(&self, rule: &Rule) -> Result<CellSet, TooLarge> {
        let walkable = self.bits(&self.walkable())?;
        let reached = Search::new(self, rule)?.run(|reached| reached == walkable);
        Ok(CellSet::of_bits(self.area, reached))
    }

    /// Whether the chain can reach any of the cells `wanted` under `rule`; ends as soon as it does.
    ///
    /// # Errors
    /// [`TooLarge`] if there are too many configurations.
    pub fn reaches_any(&self, rule: &Rule, wanted: &CellSet) -> Result<bool, TooLarge> {
        let wanted = self.bits(wanted)?;
        Ok(Search::new(self, rule)?.run(|reached| reached & wanted != 0) & wanted != 0)
    }

    pub(crate) fn bits(&self, cells: &CellSet) -> Result<u128, TooLarge> {
        let count = cells_of(self.area);
        if count > MAX_CELLS {
            return Err(TooLarge::Cells { cells: count });
        }
        let bits = cells.iter().filter_map(|cell| index(self.area, cell));
        Ok(bits.fold(0, |bits, index| bits | 1 << index))
    }
}

/// For every cell, steps that a robot can make there.
struct Steps {
    area: Area,
    by_cell: Vec<[bool; 5]>,
}

impl Steps {
    fn new(area: Area) -> Self {
        Self { area, by_cell: vec![[false; 5]; cells_of(area)] }
    }

    fn insert(&mut self, cell: Cell, step: Step) {
        if let Some(index) = index(self.area, cell) {
            self.by_cell[index][step.place()] = true;
        }
    }

    /// Where the steps lead from `cell`.
    fn from(&self, cell: Cell) -> impl Iterator<Item = Cell> + '_ {
        let steps = index(self.area, cell).map_or([false; 5], |index| self.by_cell[index]);
        Step::ALL.into_iter().filter(move |step| steps[step.place()]).map(move |step| cell.after(step))
    }
}

/// Most followers that [`Ground::reachable`] bears: in two cells already more have more than [`MAX_PLACES`].
pub const MAX_FOLLOWERS: usize = 20;

/// Followers R_2 … R_{N−1}, by the index of their cells.
pub(crate) type Followers = [u8; MAX_FOLLOWERS];

/// The team moves that a rule admits on a ground where every edge is known. Cells are indices, sets of them bits.
pub(crate) struct Relation {
    rule: Rule,
    followers: usize,
    base: u8,
    width: u32,
    /// Cells whose eastern, and whose southern side is open.
    east: u128,
    south: u128,
    cells: Vec<Around>,
}

/// What is round a cell.
struct Around {
    /// E_S, or everything if the rule has no *SafeAhead*.
    safe: u128,
    /// E_C, or everything if the rule has no *CoveredBehind*.
    covered: u128,
    /// Where a robot can be after a step.
    after: Vec<u8>,
}

/// Takes the followers' next cells, and all those that the leader can then be in.
type Sink<'a> = &'a mut dyn FnMut(&Followers, u128);

impl Relation {
    pub(crate) fn new(ground: &Ground, rule: &Rule) -> Result<Self, TooLarge> {
        let Ground { area, base, robots, .. } = *ground;
        let cells = cells_of(area);
        if cells > MAX_CELLS {
            return Err(TooLarge::Cells { cells });
        }
        let followers = robots.saturating_sub(2);
        if followers > MAX_FOLLOWERS {
            return Err(TooLarge::Places);
        }
        let set = |cells: &mut dyn Iterator<Item = Cell>| {
            cells.filter_map(|cell| index(area, cell)).fold(0_u128, |set, index| set | 1 << index)
        };
        let environment = |condition, cell: Cell, is_in: fn(Cell, Cell) -> bool| {
            let near = area.around(cell, 2).into_iter().flat_map(Area::cells);
            if rule.has(condition) { set(&mut near.filter(|&other| is_in(cell, other))) } else { u128::MAX }
        };
        let open = |side| set(&mut area.cells().filter(|&cell| ground.admits(cell, Step::Cross(side))));
        let around = |cell: Cell| Around {
            safe: environment(Condition::SafeAhead, cell, in_safe),
            covered: environment(Condition::CoveredBehind, cell, in_covered),
            after: Step::ALL
                .into_iter()
                .filter(|&step| ground.admits(cell, step))
                .filter_map(|step| index(area, cell.after(step)).map(|index| index as u8))
                .collect(),
        };
        Ok(Self {
            rule: *rule,
            followers,
            base: index(area, base).unwrap_or(0) as u8,
            width: area.width() as u32,
            east: open(Side::East),
            south: open(Side::South),
            cells: area.cells().map(around).collect(),
        })
    }

    /// All robots in the base.
    pub(crate) fn start(&self) -> (Followers, u8) {
        let mut start = [0; MAX_FOLLOWERS];
        start[..self.followers].fill(self.base);
        (start, self.base)
    }

    /// The cells of the followers, as a set.
    pub(crate) fn cells(&self, followers: &Followers) -> u128 {
        followers[..self.followers].iter().fold(0, |cells, &cell| cells | 1 << cell)
    }

    /// Every team move with the followers in `from` and the leader in any of `leaders`.
    pub(crate) fn moves(&self, from: &Followers, leaders: u128, sink: Sink<'_>) {
        self.choose(from, &mut [0; MAX_FOLLOWERS], 0, leaders, self.led(from, leaders), sink);
    }

    /// Chooses the step of follower number `follower` and of those ahead of it. `led` is where the leaders can go.
    fn choose(
        &self,
        from: &Followers,
        to: &mut Followers,
        follower: usize,
        leaders: u128,
        led: u128,
        sink: Sink<'_>,
    ) {
        let (planned_behind, behind) = match follower.checked_sub(1) {
            Some(behind) => (to[behind], from[behind]),
            None => (self.base, self.base),
        };
        let (planned_behind, behind) =
            (&self.cells[usize::from(planned_behind)], &self.cells[usize::from(behind)]);
        let is_distinct = self.rule.has(Condition::Distinct);
        if follower == self.followers {
            let taken = if is_distinct { self.cells(to) & !(1 << self.base) } else { 0 };
            sink(to, led & planned_behind.safe & !taken);
            return;
        }
        let at = from[follower];
        for &cell in &self.cells[usize::from(at)].after {
            let is_taken = is_distinct && cell != self.base && to[..follower].contains(&cell);
            if (planned_behind.safe & behind.covered) >> cell & 1 == 0 || is_taken {
                continue;
            }
            to[follower] = cell;
            let is_guarded = self.rule.has(Condition::FullForFollower) && cell != self.base && cell != at;
            let others = from[..self.followers].iter().filter(|&&other| is_guarded && other == cell).count();
            // With one follower in it, the cell is full if the leader is there, too.
            let unhindered = match others {
                0 => leaders,
                1 => leaders & !(1 << cell),
                _ => 0,
            };
            let led = if unhindered == leaders { led } else { self.led(from, unhindered) };
            if led != 0 {
                self.choose(from, to, follower + 1, unhindered, led, sink);
            }
        }
    }

    /// Where leaders can go while the followers are in `from`.
    fn led(&self, from: &Followers, leaders: u128) -> u128 {
        let present = &from[..self.followers];
        let moved = (leaders & self.east) << 1
            | leaders >> 1 & self.east
            | (leaders & self.south) << self.width
            | leaders >> self.width & self.south;
        let (mut once, mut twice) = (0_u128, 0);
        if self.rule.has(Condition::FullForLeader) {
            for bit in present.iter().filter(|&&cell| cell != self.base).map(|&cell| 1 << cell) {
                twice |= once & bit;
                once |= bit;
            }
        }
        let behind = present.last().copied().unwrap_or(self.base);
        leaders | moved & self.cells[usize::from(behind)].covered & !twice
    }
}

/// The search through all configurations.
struct Search {
    relation: Relation,
    visited: Visited,
}

/// The configurations that were met.
struct Visited {
    /// By follower and cell: what it adds to the index of the followers' place; none where the follower cannot be.
    strides: Vec<Vec<Option<u32>>>,
    /// By place: the leader's cells seen, and those of them not yet moved on from.
    seen: Vec<u128>,
    pending: Vec<u128>,
    work: VecDeque<(u32, Followers)>,
    /// Where some robot was.
    reached: u128,
}

impl Search {
    fn new(ground: &Ground, rule: &Rule) -> Result<Self, TooLarge> {
        let relation = Relation::new(ground, rule)?;
        let (mut strides, mut places) = (Vec::with_capacity(relation.followers), 1);
        for follower in 0..relation.followers {
            // By SafeAhead a robot is at most one column and row from the one behind.
            let reach = if rule.has(Condition::SafeAhead) { follower as u16 + 1 } else { u16::MAX };
            let mut place = 0;
            let stride = ground.area.cells().map(|cell| {
                let (dx, dy) = ground.base.apart(cell);
                (dx.max(dy) <= reach).then(|| {
                    place += 1;
                    (place - 1) * places
                })
            });
            strides.push(stride.collect());
            places *= place;
            if places as usize > MAX_PLACES {
                return Err(TooLarge::Places);
            }
        }
        let visited = Visited {
            strides,
            seen: vec![0; places as usize],
            pending: vec![0; places as usize],
            work: VecDeque::new(),
            reached: 0,
        };
        Ok(Self { relation, visited })
    }

    /// The cells that some robot has been in when `is_enough` says so of them, or when there are no more.
    fn run(self, is_enough: impl Fn(u128) -> bool) -> u128 {
        let Self { relation, mut visited } = self;
        let (start, leader) = relation.start();
        visited.add(&relation, &start, 1 << leader);
        while let Some((place, from)) = visited.work.pop_front() {
            if is_enough(visited.reached) {
                break;
            }
            let leaders = std::mem::take(&mut visited.pending[place as usize]);
            relation.moves(&from, leaders, &mut |to, led| visited.add(&relation, to, led));
        }
        visited.reached
    }
}

impl Visited {
    /// Notes the configurations with the leader in any of `leaders`.
    fn add(&mut self, relation: &Relation, followers: &Followers, leaders: u128) {
        let parts = followers.iter().zip(&self.strides).map(|(&cell, strides)| strides[usize::from(cell)]);
        let Some(place) = parts.sum::<Option<u32>>() else { return };
        let new = leaders & !self.seen[place as usize];
        if new == 0 {
            return;
        }
        self.seen[place as usize] |= new;
        if self.pending[place as usize] == 0 {
            self.work.push_back((place, *followers));
        }
        self.pending[place as usize] |= new;
        self.reached |= relation.cells(followers) | new;
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use std::collections::HashSet;

    use tautline_kernel::chain::{Move, Role};
    use tautline_kernel::choice::Oracle;

    use super::super::links::within_reach;
    use super::super::whole;
    use super::*;
    use crate::engine::Seeded;

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
        let (area, base) = whole::area(robots);
        Ground::new(area, base, robots, |edge| !is_wall(edge)).expect("a base inside")
    }

    /// So many of the edges in a hundred are walls.
    pub(crate) fn random(
        robots: usize,
        area: Area,
        base: Cell,
        oracle: &mut Seeded,
        walls_percent: u32,
    ) -> Ground {
        let walls: HashSet<Edge> = area.edges().filter(|_| oracle.pick(100) < walls_percent).collect();
        Ground::new(area, base, robots, |edge| !walls.contains(&edge)).expect("a base inside")
    }

    /// All 4096 of them.
    pub(crate) fn layouts_of_two_robots() -> impl Iterator<Item = Ground> {
        let edges: Vec<Edge> = whole::area(2).0.edges().collect();
        (0..1_u32 << edges.len()).map(move |walls| {
            ground(2, |edge| {
                edges.iter().position(|&one| one == edge).is_some_and(|place| walls >> place & 1 == 1)
            })
        })
    }

    /// One configuration after the other, each team move tried step by step, and admitted by the kernel's relation.
    fn plainly(ground: &Ground, rule: &Rule) -> CellSet {
        let mut reached = CellSet::new(ground.area);
        let start = vec![ground.base; ground.robots];
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
        let perhaps = ground.perhaps_reachable(rule);
        let is_open = |edge: Edge| ground.admits(edge.cell(), Step::Cross(edge.side()));
        let within_reach = within_reach(ground.area, ground.base, ground.robots, is_open);
        assert!(within_reach.into_iter().all(|cell| reached.contains(cell)), "{rule:?} {ground:?}");
        for cell in ground.area.cells() {
            assert!(!reached.contains(cell) || perhaps.contains(cell), "{cell} {rule:?} {ground:?}");
            let mut wanted = CellSet::new(ground.area);
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
        let edges: Vec<Edge> = ground(3, |_| false).area.edges().collect();
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
        let mut oracle = Seeded::new(0, 0);
        let mut next = |robots, walls_percent| {
            let (area, base) = whole::area(robots);
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
            let all = cells_of(ground.area);
            assert_eq!(ground.reachable(&Rule::REPAIRED).expect("a small ground").len(), all, "{robots}");
        }
        assert_eq!(ground(40, |_| false).perhaps_reachable(&Rule::REPAIRED).len(), 79 * 79);
    }
}
