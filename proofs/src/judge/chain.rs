//! The judge of counterexamples. It reads a layout and the moves of a run as anyone may write them down, knows only
//! the sentences of `SPEC.md`, and has geometry, history and knowledge of its own: it shares no code with the
//! planner, the search or the simulator.

use std::collections::{BTreeSet, HashSet, VecDeque};
use std::fmt;

/// Column and row.
pub type Place = (i32, i32);

/// A counterexample, written down.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Exhibit {
    /// The clause that its last move is said to break, `CHAIN-1`, `CHAIN-2` or `CHAIN-3`, or its end, `CHAIN-13` or
    /// `CHAIN-14`.
    pub clause: String,
    /// The rule that the team is said to follow.
    pub repairs: Repairs,
    /// Columns of the layout.
    pub width: i32,
    /// Rows of the layout.
    pub height: i32,
    /// Pairs of neighbouring cells, the western or northern first, with a wall between them.
    pub walls: BTreeSet<(Place, Place)>,
    /// Cells that nobody can enter.
    pub blocked: BTreeSet<Place>,
    /// The base.
    pub base: Place,
    /// Robots, base included.
    pub robots: usize,
    /// The team moves.
    pub moves: Vec<Move>,
}

/// Whether the team follows the repaired rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Repairs {
    /// The rule as published.
    Without,
    /// The rule with all repairs.
    With,
}

/// One team move, base first.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Move {
    /// Whether it takes an earlier move back.
    pub is_backtrack: bool,
    /// What each robot tried: columns and rows.
    pub tried: Vec<Place>,
    /// Whether it was blocked.
    pub blocked: Vec<bool>,
    /// Where it is now.
    pub places: Vec<Place>,
}

/// Why an exhibit is no counterexample: the sentence, and the team move that it is about, counted from 1; 0 for
/// the exhibit as a whole.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Objection {
    /// The team move.
    pub at: usize,
    /// What is wrong.
    pub what: &'static str,
}

impl fmt::Display for Objection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.at {
            0 => f.write_str(self.what),
            at => write!(f, "team move {at}: {}", self.what),
        }
    }
}

impl std::error::Error for Objection {}

/// Judges an exhibit: whether its moves are possible in its layout and admitted by its rule; whether in each of them the
/// leader does what its rule says, and a backtrack is due; whether each of the walls was met; and whether the last move,
/// and no earlier one, breaks the clause, or the run is over after it and not before, and its end breaks the clause. What
/// followers prefer among the moves that are admitted is not asked, nor by which way a chain unfolds. Of more than 12
/// robots it is not asked either what the leader does, so that the end of their runs cannot be judged.
///
/// # Errors
/// The first [`Objection`].
pub fn judge(exhibit: &Exhibit) -> Result<(), Objection> {
    let whole = |what| Objection { at: 0, what };
    let Some(clause) = broken(&exhibit.clause) else {
        return Err(whole("there is no such clause to break in a run"));
    };
    let first = exhibit.moves.first().filter(|_| exhibit.robots >= 2);
    let Some(first) = first else { return Err(whole("a counterexample needs two robots and a move")) };
    if !exhibit.is_free(exhibit.base) {
        return Err(whole("the base is not a free cell of the layout"));
    }
    if matches!(clause, Broken::AtEnd(_)) && exhibit.robots > MOST_LED {
        return Err(whole("the judge cannot say of more than 12 robots whether their run is over"));
    }
    let mut court = Court {
        exhibit,
        // The number of robots is checked with each move, and may be any before.
        places: vec![exhibit.base; first.places.len()],
        history: Vec::new(),
        walls: BTreeSet::new(),
        open: BTreeSet::new(),
        explored: BTreeSet::from([exhibit.base]),
        refused: BTreeSet::new(),
        gained: true,
        unfolds: false,
    };
    for (index, made) in exhibit.moves.iter().enumerate() {
        let at = index + 1;
        let object = |what| Objection { at, what };
        court.are_all_there(made).map_err(object)?;
        if exhibit.robots <= MOST_LED {
            court.duty().and_then(|duty| duty.is_done_by(made)).map_err(object)?;
        }
        court.hear(made).map_err(object)?;
        let is_last = at == exhibit.moves.len();
        if let Broken::ByMove(is_broken) = clause {
            match (is_broken(&court, made), is_last) {
                (true, false) => return Err(object("the clause is broken before the last move")),
                (false, true) => return Err(object("the last move does not break the clause")),
                (true, true) | (false, false) => {}
            }
        }
        court.places.clone_from(&made.places);
    }
    if let Broken::AtEnd(is_broken) = clause {
        if court.duty().map_err(whole)? != Duty::Nothing {
            return Err(whole("the run goes on after the last move"));
        }
        if !is_broken(&court).map_err(whole)? {
            return Err(whole("the end of the run does not break the clause"));
        }
    }
    if exhibit.walls.iter().any(|wall| !court.walls.contains(wall)) {
        return Err(whole("a wall was never met"));
    }
    Ok(())
}

/// Whether the judge knows this clause.
pub fn judges(clause: &str) -> bool {
    broken(clause).is_some()
}

/// What breaks the clause with this id, if the judge knows it.
fn broken(clause: &str) -> Option<Broken> {
    Some(match clause {
        "CHAIN-1" => Broken::ByMove(|_, made| contact_is_lost(&made.places)),
        "CHAIN-2" => Broken::ByMove(|_, made| cell_is_crowded(&made.places)),
        "CHAIN-3" => Broken::ByMove(|court, made| range_is_left(&court.places, &made.places)),
        "CHAIN-13" => Broken::AtEnd(|court| Ok(misses_within_reach(court))),
        "CHAIN-14" => Broken::AtEnd(misses_reachable),
        _ => return None,
    })
}

/// What breaks a clause.
#[derive(Clone, Copy)]
enum Broken {
    ByMove(fn(&Court<'_>, &Move) -> bool),
    AtEnd(fn(&Court<'_>) -> Result<bool, &'static str>),
}

/// What the team has to do next.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Duty {
    /// To advance, the leader by this step.
    Lead(Place),
    /// To advance, since the chain unfolds.
    Unfold,
    /// To take the latest open move back.
    TakeBack,
    /// The run is over.
    Nothing,
}

impl Duty {
    fn is_done_by(self, made: &Move) -> Result<(), &'static str> {
        match self {
            Self::Nothing => Err("the run is over before this move"),
            Self::TakeBack if !made.is_backtrack => {
                Err("the leader has no way on: the team takes a move back")
            }
            Self::Lead(_) | Self::Unfold if made.is_backtrack => {
                Err("the leader has a way on: the team takes no move back")
            }
            Self::Lead(step) if made.tried.last() != Some(&step) => {
                Err("the leader has a candidate that comes first")
            }
            Self::Lead(_) | Self::Unfold | Self::TakeBack => Ok(()),
        }
    }
}

/// Robots of which the judge looks at everything that they could do behind a leader.
const MOST_LED: usize = 12;

/// Ways of followers that the judge looks at for one step of the leader.
const MOST_LOOKS: u32 = 1_000_000;

/// Places of all robots that the judge looks at to say what a chain can reach.
const MOST_CONFIGURATIONS: usize = 1_000_000;

/// East, south, west, north: the order that settles ties.
const SIDES: [Place; 4] = [(1, 0), (0, 1), (-1, 0), (0, -1)];

impl Exhibit {
    fn is_free(&self, (x, y): Place) -> bool {
        (0..self.width).contains(&x) && (0..self.height).contains(&y) && !self.blocked.contains(&(x, y))
    }

    fn is_open(&self, side: (Place, Place)) -> bool {
        self.is_free(side.0) && self.is_free(side.1) && !self.walls.contains(&side)
    }

    /// Whether a place is in the area that the team is given.
    fn is_inside(&self, (x, y): Place) -> bool {
        let range = self.robots as i32 - 1;
        (0..self.width).contains(&x)
            && (0..self.height).contains(&y)
            && (x - self.base.0).abs() <= range
            && (y - self.base.1).abs() <= range
    }

    /// The places of that area.
    fn inside(&self) -> impl Iterator<Item = Place> {
        let range = i32::try_from(self.robots).unwrap_or(i32::MAX) - 1;
        let (x, y) = self.base;
        let columns = x.saturating_sub(range).max(0)..=x.saturating_add(range).min(self.width - 1);
        let rows = y.saturating_sub(range).max(0)..=y.saturating_add(range).min(self.height - 1);
        rows.flat_map(move |y| columns.clone().map(move |x| (x, y)))
    }

    /// The border of the area: known from the start.
    fn is_border(&self, side: (Place, Place)) -> bool {
        !(self.is_inside(side.0) && self.is_inside(side.1))
    }

    /// The places of the area at most N−1 links from the base, where links cross the sides that `is_open`.
    fn within_reach(&self, is_open: impl Fn((Place, Place)) -> bool) -> BTreeSet<Place> {
        let pass = |from: Place, step: Place| {
            let to = add(from, step);
            (self.is_inside(to) && is_open(side_between(from, to))).then_some(to)
        };
        let linked = |from: Place| {
            SIDES
                .into_iter()
                .filter_map(move |(x, y)| pass(from, (x, y)).map(|next| (next, (x, y))))
                .flat_map(move |(next, (x, y))| {
                    let turns = [(y, x), (-y, -x)].into_iter().filter_map(move |turn| pass(next, turn));
                    std::iter::once(next).chain(turns)
                })
        };
        let mut reached = BTreeSet::from([self.base]);
        let mut rim = vec![self.base];
        for _ in 1..self.robots {
            rim = rim.into_iter().flat_map(linked).filter(|&place| reached.insert(place)).collect();
        }
        reached
    }
}

/// What the team knows, kept by the judge.
#[derive(Clone)]
struct Court<'a> {
    exhibit: &'a Exhibit,
    places: Vec<Place>,
    /// Displacements of the advances that are not taken back.
    history: Vec<Vec<Place>>,
    walls: BTreeSet<(Place, Place)>,
    open: BTreeSet<(Place, Place)>,
    explored: BTreeSet<Place>,
    /// The sides with a virtual obstacle.
    refused: BTreeSet<(Place, Place)>,
    /// Whether this epoch has explored a cell or found a wall; the first begins with one explored.
    gained: bool,
    /// Whether this epoch began by unfolding the chain.
    unfolds: bool,
}

impl Court<'_> {
    fn are_all_there(&self, made: &Move) -> Result<(), &'static str> {
        let robots = self.exhibit.robots;
        if [made.tried.len(), made.blocked.len(), made.places.len(), self.places.len()] != [robots; 4] {
            return Err("every robot has a step, an outcome and a place");
        }
        Ok(())
    }

    fn hear(&mut self, made: &Move) -> Result<(), &'static str> {
        if made.tried.iter().any(|&(x, y)| x.unsigned_abs().saturating_add(y.unsigned_abs()) > 1) {
            return Err("a step leads to a side neighbour or nowhere");
        }
        if made.tried[0] != (0, 0) || made.blocked[0] || made.places[0] != self.exhibit.base {
            return Err("the base does something");
        }
        if made.is_backtrack {
            self.hear_backtrack(made)?;
        } else {
            self.hear_advance(made)?;
        }
        for robot in 0..self.exhibit.robots {
            let arrived = if made.blocked[robot] { self.places[robot] } else { self.target(made, robot) };
            if made.places[robot] != arrived {
                return Err("a robot is not where its step leads");
            }
            self.gained |= self.explored.insert(arrived);
        }
        Ok(())
    }

    fn hear_backtrack(&mut self, made: &Move) -> Result<(), &'static str> {
        let Some(last) = self.history.pop() else { return Err("there is nothing to take back") };
        if made.blocked.contains(&true) {
            return Err("a backtrack is not blocked");
        }
        if last.iter().zip(&made.tried).any(|(&(x, y), &back)| (-x, -y) != back) {
            return Err("a backtrack takes the last open move back");
        }
        Ok(())
    }

    fn hear_advance(&mut self, made: &Move) -> Result<(), &'static str> {
        self.admits(made)?;
        for robot in 1..made.tried.len() {
            let is_step = made.tried[robot] != (0, 0);
            if made.blocked[robot] && !is_step {
                return Err("a robot that stays is not blocked");
            }
            if is_step && made.blocked[robot] == self.exhibit.is_open(self.side(robot, made.tried[robot])) {
                return Err("a robot is blocked where nothing is in the way, or passes where something is");
            }
        }
        for robot in 1..made.tried.len() {
            let side = self.side(robot, made.tried[robot]);
            if made.blocked[robot] {
                self.gained |= self.walls.insert(side);
            } else if made.tried[robot] != (0, 0) {
                self.open.insert(side);
            }
        }
        let displaced = |robot: usize| if made.blocked[robot] { (0, 0) } else { made.tried[robot] };
        self.history.push((0..made.tried.len()).map(displaced).collect());
        Ok(())
    }

    /// The sentences of the rule about a planned move.
    fn admits(&self, made: &Move) -> Result<(), &'static str> {
        let planned: Vec<Place> = (0..made.tried.len()).map(|robot| self.target(made, robot)).collect();
        for robot in 1..planned.len() {
            self.admits_step(robot, made.tried[robot])?;
            self.admits_pair(robot, made.tried[robot], planned[robot - 1])?;
            if planned[robot] != self.exhibit.base && planned[1..robot].contains(&planned[robot]) {
                return Err("two robots plan to be in one cell outside the base");
            }
        }
        Ok(())
    }

    /// Those about a robot alone.
    fn admits_step(&self, robot: usize, step: Place) -> Result<(), &'static str> {
        let (stays, planned) = (step == (0, 0), add(self.places[robot], step));
        if !stays && self.is_known_wall(self.side(robot, step)) {
            return Err("a robot plans to cross a known wall");
        }
        let is_null = stays && robot + 1 == self.exhibit.robots;
        if !is_null && !is_covered(self.places[robot - 1], planned) {
            return Err("a planned position is not in E_C of the present position behind");
        }
        let others = self.places.iter().filter(|&&place| place == planned).count();
        let is_full = !stays && planned != self.exhibit.base && others >= 2;
        if is_full && self.exhibit.repairs == Repairs::With {
            return Err("a robot plans to enter a cell that two others occupy");
        }
        Ok(())
    }

    /// Those about a robot that plans to make `step`, and the one behind it, which plans to be at `behind`.
    fn admits_pair(&self, robot: usize, step: Place, behind: Place) -> Result<(), &'static str> {
        if !is_safe(add(self.places[robot], step), behind) {
            return Err("a planned position is not in E_S of the planned position ahead");
        }
        let is_sure = step == (0, 0) || self.open.contains(&self.side(robot, step));
        if self.exhibit.repairs == Repairs::With && !is_sure && !is_covered(self.places[robot], behind) {
            return Err("behind an unsure neighbour a robot plans to leave E_C of its present position");
        }
        Ok(())
    }

    /// What the team has to do next, by the rule; new virtual obstacles and epochs are noted.
    fn duty(&mut self) -> Result<Duty, &'static str> {
        if self.exhibit.inside().all(|place| self.explored.contains(&place)) {
            return Ok(Duty::Nothing);
        }
        let is_target = self.exhibit.repairs == Repairs::With
            && !self.exhibit.within_reach(|side| !self.is_known_wall(side)).is_subset(&self.explored);
        for is_fresh in [false, true] {
            if self.unfolds && !self.gained && is_target {
                return Ok(Duty::Unfold);
            }
            if let Some(step) = self.lead()? {
                return Ok(Duty::Lead(step));
            }
            if !self.history.is_empty() {
                return Ok(Duty::TakeBack);
            }
            let unfolds = !is_fresh && is_target;
            if !self.gained && !unfolds {
                break;
            }
            (self.gained, self.unfolds) = (false, unfolds);
            self.refused.clear();
        }
        Ok(Duty::Nothing)
    }

    /// The step of the leader that its rule chooses: of its candidates the first that the others can follow.
    fn lead(&mut self) -> Result<Option<Place>, &'static str> {
        let leader = self.places.len() - 1;
        let (at, base) = (self.places[leader], self.exhibit.base);
        let mut list: Vec<(u32, i32, Place)> = SIDES
            .into_iter()
            .filter(|&step| !self.is_shut(self.side(leader, step)))
            .filter_map(|step| {
                let outward = step.0 * (at.0 - base.0) + step.1 * (at.1 - base.1);
                Some((self.distance(add(at, step))?, -outward, step))
            })
            .collect();
        // A stable sort: direction settles what is left.
        list.sort_by_key(|&(distance, inward, _)| (distance, inward));
        let mut candidates = Vec::new();
        for (_, _, step) in list {
            let side = self.side(leader, step);
            let is_covered = is_covered(self.places[leader - 1], add(at, step));
            if !is_covered {
                self.refused.insert(side);
            }
            candidates.push((side, if is_covered { step } else { (0, 0) }));
        }
        for (side, step) in candidates {
            let mut tried = vec![(0, 0); leader + 1];
            tried[leader] = step;
            let is_admitted = self.admits_step(leader, step).is_ok();
            if is_admitted && self.can_follow(&mut tried, leader, &mut MOST_LOOKS.clone())? {
                return Ok(Some(step));
            }
            self.refused.insert(side);
        }
        Ok(None)
    }

    /// Whether the robots behind `robot` have steps that are admitted with those of `tried` from it on.
    fn can_follow(&self, tried: &mut [Place], robot: usize, looks: &mut u32) -> Result<bool, &'static str> {
        let behind = robot - 1;
        if behind == 0 {
            return Ok(self.admits_pair(robot, tried[robot], self.exhibit.base).is_ok());
        }
        for step in SIDES.into_iter().chain([(0, 0)]) {
            *looks = looks.checked_sub(1).ok_or("followers have too many ways for the judge to look at")?;
            let planned = add(self.places[behind], step);
            let is_taken = planned != self.exhibit.base
                && (robot..tried.len()).any(|ahead| add(self.places[ahead], tried[ahead]) == planned);
            if is_taken
                || self.admits_step(behind, step).is_err()
                || self.admits_pair(robot, tried[robot], planned).is_err()
            {
                continue;
            }
            tried[behind] = step;
            if self.can_follow(tried, behind, looks)? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Steps from `from` to the nearest unexplored place, over sides that are not shut for the leader.
    fn distance(&self, from: Place) -> Option<u32> {
        let mut seen = BTreeSet::from([from]);
        let mut queue = VecDeque::from([(from, 0)]);
        while let Some((place, steps)) = queue.pop_front() {
            if !self.explored.contains(&place) {
                return Some(steps);
            }
            for step in SIDES {
                let next = add(place, step);
                if !self.is_shut(side_between(place, next)) && seen.insert(next) {
                    queue.push_back((next, steps + 1));
                }
            }
        }
        None
    }

    /// The places of all robots after each team move that is admitted and begins with the steps `tried`, base first.
    fn configurations(&self, tried: &mut Vec<Place>, sink: &mut dyn FnMut(Vec<Place>)) {
        let robot = tried.len();
        let planned: Vec<Place> = tried.iter().zip(&self.places).map(|(&step, &at)| add(at, step)).collect();
        if robot == self.exhibit.robots {
            return sink(planned);
        }
        for step in SIDES.into_iter().chain([(0, 0)]) {
            let to = add(self.places[robot], step);
            let is_taken = to != self.exhibit.base && planned[1..].contains(&to);
            if !is_taken
                && self.admits_step(robot, step).is_ok()
                && self.admits_pair(robot, step, planned[robot - 1]).is_ok()
            {
                tried.push(step);
                self.configurations(tried, sink);
                tried.pop();
            }
        }
    }

    fn is_known_wall(&self, side: (Place, Place)) -> bool {
        self.walls.contains(&side) || self.exhibit.is_border(side)
    }

    /// Whether the leader does not cross a side in this epoch.
    fn is_shut(&self, side: (Place, Place)) -> bool {
        self.is_known_wall(side) || self.refused.contains(&side)
    }

    fn target(&self, made: &Move, robot: usize) -> Place {
        add(self.places[robot], made.tried[robot])
    }

    fn side(&self, robot: usize, step: Place) -> (Place, Place) {
        side_between(self.places[robot], add(self.places[robot], step))
    }
}

fn add(place: Place, step: Place) -> Place {
    (place.0 + step.0, place.1 + step.1)
}

fn side_between(one: Place, other: Place) -> (Place, Place) {
    (one.min(other), one.max(other))
}

/// E_S: the block of nine cells.
fn is_safe(centre: Place, place: Place) -> bool {
    (centre.0 - place.0).abs() <= 1 && (centre.1 - place.1).abs() <= 1
}

/// E_C: E_S, and the four cells two steps straight ahead.
fn is_covered(centre: Place, place: Place) -> bool {
    is_safe(centre, place) || (centre.0 - place.0).abs() + (centre.1 - place.1).abs() == 2
}

/// CHAIN-13: some place at most N−1 links from the base was never explored.
fn misses_within_reach(court: &Court<'_>) -> bool {
    let within_reach = court.exhibit.within_reach(|side| court.exhibit.is_open(side));
    !within_reach.is_subset(&court.explored)
}

/// CHAIN-14: a team that knows the layout, and tries no wall, can bring a robot to a place that was never explored.
fn misses_reachable(court: &Court<'_>) -> Result<bool, &'static str> {
    let start = vec![court.exhibit.base; court.exhibit.robots];
    // One who knows all sides: nobody is unsure, and no wall is planned to be crossed.
    let mut informed = Court { open: BTreeSet::new(), walls: BTreeSet::new(), ..court.clone() };
    for place in court.exhibit.inside() {
        for step in [(1, 0), (0, 1)] {
            let side = side_between(place, add(place, step));
            let known = if court.exhibit.is_open(side) { &mut informed.open } else { &mut informed.walls };
            known.insert(side);
        }
    }
    let mut seen = HashSet::from([start.clone()]);
    let mut left = vec![start];
    while let Some(places) = left.pop() {
        if places.iter().any(|place| !court.explored.contains(place)) {
            return Ok(true);
        }
        informed.places = places;
        informed.configurations(&mut vec![(0, 0)], &mut |next| {
            if seen.insert(next.clone()) {
                left.push(next);
            }
        });
        if seen.len() > MOST_CONFIGURATIONS {
            return Err("the robots have too many places for the judge to say what they can reach");
        }
    }
    Ok(false)
}

/// CHAIN-1
fn contact_is_lost(after: &[Place]) -> bool {
    after.windows(2).any(|pair| !is_covered(pair[0], pair[1]))
}

/// CHAIN-2
fn cell_is_crowded(after: &[Place]) -> bool {
    after.iter().any(|place| *place != after[0] && after.iter().filter(|other| *other == place).count() > 2)
}

/// CHAIN-3: four times the squared distance is above 26 for some pair of ends.
fn range_is_left(before: &[Place], after: &[Place]) -> bool {
    let is_far = |one: Place, other: Place| {
        let (dx, dy) = (one.0 - other.0, one.1 - other.1);
        4 * (dx * dx + dy * dy) > 26
    };
    (1..after.len()).any(|robot| {
        [before[robot], after[robot]].into_iter().any(|ahead| {
            [before[robot - 1], after[robot - 1]].into_iter().any(|behind| is_far(ahead, behind))
        })
    })
}
