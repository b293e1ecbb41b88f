//! The judge of counterexamples. It reads a layout and the moves of a run as anyone may write them down, knows only
//! the sentences of `SPEC.md`, and has geometry, history and knowledge of its own: it shares no code with the
//! planner, the search or the simulator.

use std::collections::BTreeSet;
use std::fmt;

/// Column and row.
pub type Place = (i32, i32);

/// A counterexample, written down.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Exhibit {
    /// The clause that its last move is said to break, `CHAIN-1`, `CHAIN-2` or `CHAIN-3`, or its end, `CHAIN-13`.
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

/// Judges an exhibit: whether its moves are possible in its layout and admitted by its rule, whether each of its
/// walls was met, and whether its last move, and no earlier one, breaks the clause; or whether the clause is broken if
/// the run ends here.
///
/// # Errors
/// The first [`Objection`].
pub fn judge(exhibit: &Exhibit) -> Result<(), Objection> {
    let whole = |what| Objection { at: 0, what };
    let is_broken: fn(&Court<'_>, &Move) -> bool = match exhibit.clause.as_str() {
        "CHAIN-1" => |_, made| contact_is_lost(&made.places),
        "CHAIN-2" => |_, made| cell_is_crowded(&made.places),
        "CHAIN-3" => |court, made| range_is_left(&court.places, &made.places),
        "CHAIN-13" => |court, _| court.misses_a_cell(),
        _ => return Err(whole("there is no such clause to break in a run")),
    };
    let is_about_the_end = exhibit.clause == "CHAIN-13";
    if is_about_the_end && exhibit.repairs == Repairs::With {
        return Err(whole("with its repairs the team would go on: it unfolds towards the cell"));
    }
    let first = exhibit.moves.first().filter(|_| exhibit.robots >= 2);
    let Some(first) = first else { return Err(whole("a counterexample needs two robots and a move")) };
    if !exhibit.is_free(exhibit.base) {
        return Err(whole("the base is not a free cell of the layout"));
    }
    let mut court = Court {
        exhibit,
        // The number of robots is checked with each move, and may be any before.
        places: vec![exhibit.base; first.places.len()],
        history: Vec::new(),
        walls: BTreeSet::new(),
        open: BTreeSet::new(),
        explored: BTreeSet::from([exhibit.base]),
    };
    for (index, made) in exhibit.moves.iter().enumerate() {
        let at = index + 1;
        court.hear(made).map_err(|what| Objection { at, what })?;
        court.explored.extend(&made.places);
        let is_last = at == exhibit.moves.len();
        let broken = (is_last || !is_about_the_end) && is_broken(&court, made);
        court.places.clone_from(&made.places);
        match (broken, is_last) {
            (true, false) => return Err(Objection { at, what: "the clause is broken before the last move" }),
            (false, true) => return Err(Objection { at, what: "the last move does not break the clause" }),
            (true, true) | (false, false) => {}
        }
    }
    if exhibit.walls.iter().any(|wall| !court.walls.contains(wall)) {
        return Err(whole("a wall was never met"));
    }
    Ok(())
}

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

    /// The border of the area: known from the start.
    fn is_border(&self, side: (Place, Place)) -> bool {
        !(self.is_inside(side.0) && self.is_inside(side.1))
    }

    /// The places of the area that are one link from `from`.
    fn linked(&self, from: Place) -> Vec<Place> {
        let pass = |from: Place, step: Place| {
            let to = add(from, step);
            (self.is_inside(to) && self.is_open(side_between(from, to))).then_some(to)
        };
        let mut linked = Vec::new();
        for (x, y) in [(1, 0), (0, 1), (-1, 0), (0, -1)] {
            if let Some(next) = pass(from, (x, y)) {
                linked.push(next);
                linked.extend([(y, x), (-y, -x)].into_iter().filter_map(|turn| pass(next, turn)));
            }
        }
        linked
    }
}

/// What the team knows, kept by the judge.
struct Court<'a> {
    exhibit: &'a Exhibit,
    places: Vec<Place>,
    /// Displacements of the advances that are not taken back.
    history: Vec<Vec<Place>>,
    walls: BTreeSet<(Place, Place)>,
    open: BTreeSet<(Place, Place)>,
    explored: BTreeSet<Place>,
}

impl Court<'_> {
    fn hear(&mut self, made: &Move) -> Result<(), &'static str> {
        let robots = self.exhibit.robots;
        if [made.tried.len(), made.blocked.len(), made.places.len()] != [robots; 3] {
            return Err("every robot has a step, an outcome and a place");
        }
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
        for robot in 0..robots {
            let arrived = if made.blocked[robot] { self.places[robot] } else { self.target(made, robot) };
            if made.places[robot] != arrived {
                return Err("a robot is not where its step leads");
            }
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
            let side = self.side(made, robot);
            if made.blocked[robot] && !is_step {
                return Err("a robot that stays is not blocked");
            }
            if is_step && made.blocked[robot] == self.exhibit.is_open(side) {
                return Err("a robot is blocked where nothing is in the way, or passes where something is");
            }
        }
        for robot in 1..made.tried.len() {
            if made.tried[robot] != (0, 0) {
                let known = if made.blocked[robot] { &mut self.walls } else { &mut self.open };
                known.insert(side_between(self.places[robot], add(self.places[robot], made.tried[robot])));
            }
        }
        let zero = |robot: usize| if made.blocked[robot] { (0, 0) } else { made.tried[robot] };
        self.history.push((0..made.tried.len()).map(zero).collect());
        Ok(())
    }

    /// The sentences of the rule.
    fn admits(&self, made: &Move) -> Result<(), &'static str> {
        let leader = made.tried.len() - 1;
        let planned: Vec<Place> = (0..=leader).map(|robot| self.target(made, robot)).collect();
        for robot in 1..=leader {
            let stays = made.tried[robot] == (0, 0);
            let side = self.side(made, robot);
            if !stays && (self.walls.contains(&side) || self.exhibit.is_border(side)) {
                return Err("a robot plans to cross a known wall");
            }
            let is_null = robot == leader && stays;
            if !is_null && !is_covered(self.places[robot - 1], planned[robot]) {
                return Err("a planned position is not in E_C of the present position behind");
            }
            if !is_safe(planned[robot], planned[robot - 1]) {
                return Err("a planned position is not in E_S of the planned position ahead");
            }
            let is_sure = stays || self.open.contains(&side);
            let others = self.places.iter().filter(|&&place| place == planned[robot]).count();
            if self.exhibit.repairs == Repairs::With {
                if !is_sure && !is_covered(self.places[robot], planned[robot - 1]) {
                    return Err(
                        "behind an unsure neighbour a robot plans to leave E_C of its present position",
                    );
                }
                if !stays && planned[robot] != self.exhibit.base && others >= 2 {
                    return Err("a robot plans to enter a cell that two others occupy");
                }
            }
            if planned[robot] != self.exhibit.base && planned[1..robot].contains(&planned[robot]) {
                return Err("two robots plan to be in one cell outside the base");
            }
        }
        Ok(())
    }

    /// CHAIN-13: everything is taken back, and some place at most N−1 links from the base was never explored.
    fn misses_a_cell(&self) -> bool {
        let mut within_reach = BTreeSet::from([self.exhibit.base]);
        for _ in 1..self.exhibit.robots {
            let wider: Vec<Place> =
                within_reach.iter().flat_map(|&place| self.exhibit.linked(place)).collect();
            within_reach.extend(wider);
        }
        self.history.is_empty() && !within_reach.is_subset(&self.explored)
    }

    fn target(&self, made: &Move, robot: usize) -> Place {
        add(self.places[robot], made.tried[robot])
    }

    fn side(&self, made: &Move, robot: usize) -> (Place, Place) {
        side_between(self.places[robot], self.target(made, robot))
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

#[cfg(test)]
mod tests {
    use tautline_kernel::chain::{Kind, Rule};
    use tautline_kernel::lattice::{Cell, Step};

    use super::*;
    use crate::clause::Subject;
    use crate::search::{Bounds, Counterexample, search, unwatched};

    fn place(cell: Cell) -> Place {
        (i32::from(cell.x), i32::from(cell.y))
    }

    fn exhibit(found: &Counterexample) -> Exhibit {
        let tried = |step: &Step| place(Cell::new(0, 0).after(*step));
        Exhibit {
            clause: found.invariant.clause().to_owned(),
            repairs: Repairs::Without,
            width: 7,
            height: 7,
            walls: found
                .walls
                .iter()
                .map(|wall| (place(wall.cell()), place(wall.cell().beyond(wall.side()))))
                .collect(),
            blocked: BTreeSet::new(),
            base: (3, 3),
            robots: 4,
            moves: found
                .frames
                .iter()
                .map(|frame| Move {
                    is_backtrack: frame.kind == Kind::Backtrack,
                    tried: frame.steps.iter().map(tried).collect(),
                    blocked: frame.blocked.clone(),
                    places: frame.cells.iter().copied().map(place).collect(),
                })
                .collect(),
        }
    }

    fn counterexamples() -> Vec<Exhibit> {
        assert_eq!(Subject::PUBLISHED.rule, Rule::PUBLISHED);
        let found = search(&Bounds::new(Subject::PUBLISHED, 4, 4), &mut unwatched).expect("four robots fit");
        found.counterexamples.iter().map(exhibit).collect()
    }

    #[test]
    fn the_minimal_counterexamples_are_accepted_and_none_with_one_change() {
        let exhibits = counterexamples();
        assert_eq!(
            exhibits.iter().map(|exhibit| exhibit.clause.as_str()).collect::<Vec<_>>(),
            ["CHAIN-1", "CHAIN-2", "CHAIN-13"]
        );
        for exhibit in exhibits {
            assert_eq!(judge(&exhibit), Ok(()));
            let rejects = |change: &dyn Fn(&mut Exhibit), what: &str| {
                let mut changed = exhibit.clone();
                change(&mut changed);
                assert!(judge(&changed).is_err(), "{}: {what} is accepted", exhibit.clause);
            };
            for x in 0..7 {
                for y in 0..7 {
                    for wall in [((x, y), (x + 1, y)), ((x, y), (x, y + 1))] {
                        if wall.1.0 < 7 && wall.1.1 < 7 {
                            rejects(
                                &|changed| {
                                    if !changed.walls.remove(&wall) {
                                        changed.walls.insert(wall);
                                    }
                                },
                                &format!("a changed wall {wall:?}"),
                            );
                        }
                    }
                }
            }
            for index in 0..exhibit.moves.len() {
                rejects(&|changed| drop(changed.moves.remove(index)), &format!("move {index} left out"));
                let twice = |changed: &mut Exhibit| changed.moves.insert(index, changed.moves[index].clone());
                rejects(&twice, &format!("move {index} twice: {:?}", exhibit.moves[index]));
                for robot in 0..4 {
                    let flip = |changed: &mut Exhibit| changed.moves[index].blocked[robot] ^= true;
                    rejects(&flip, "another outcome");
                    for step in [(1, 0), (0, 1), (-1, 0), (0, -1), (0, 0)] {
                        if exhibit.moves[index].tried[robot] != step {
                            let change = |changed: &mut Exhibit| changed.moves[index].tried[robot] = step;
                            rejects(&change, &format!("step {step:?} of robot {robot} in move {index}"));
                        }
                        let shift = |changed: &mut Exhibit| {
                            let place = &mut changed.moves[index].places[robot];
                            *place = add(*place, step);
                        };
                        if step != (0, 0) {
                            rejects(&shift, "another place");
                        }
                    }
                }
            }
            rejects(&|changed| changed.repairs = Repairs::With, "the repaired rule");
            rejects(&|changed| changed.clause = "CHAIN-3".to_owned(), "another clause");
            rejects(&|changed| changed.robots = 5, "another robot");
            rejects(&|changed| changed.base = (2, 3), "another base");
            rejects(&|changed| changed.blocked = BTreeSet::from([(3, 3)]), "a blocked base");
            rejects(&|changed| changed.robots = usize::MAX, "more robots than there can be");
        }
    }
}
