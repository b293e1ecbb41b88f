//! The judge of agents on a sensor floor, turn by turn, with what they write to the sensors where that matters:
//! BRICKS-2 to BRICKS-6, BRICKS-11 and BRICKS-12. It knows the sentences of `SPEC.md` alone, and not which cells a rule
//! marks: whoever asks it plays the rule, too.

use std::collections::{BTreeMap, BTreeSet};

use super::change::{Change, Plain, plain};
use super::{Case, Floor, Objection, Place, beside, must};

/// The state of a cell; no agent has been in a cell without one.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub enum Mark {
    /// Agents have been there.
    #[default]
    Explored,
    /// Explored, and nobody enters it any more.
    Closing,
    /// Nobody need go through it again: it counts as a wall.
    Visited,
}

/// A mark that an agent writes to the sensor of a cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Write {
    /// The cell.
    pub at: Place,
    /// The mark.
    pub mark: Mark,
}

impl Write {
    /// The writes of a turn in the order of their cells.
    pub(crate) fn in_order(mut writes: Vec<Self>) -> Vec<Self> {
        writes.sort_unstable_by_key(|write| write.at);
        writes
    }
}

/// The fate of an agent in its turn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fate {
    /// It goes on.
    Awake,
    /// It is done.
    Done,
    /// It fails, and acts no more.
    Fails,
}

/// One agent's turn.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Turn {
    /// Its place among the agents.
    pub agent: usize,
    /// The side by which it leaves its cell, if it goes: east, south, west, north.
    pub side: Option<usize>,
    /// Its fate.
    pub fate: Fate,
    /// The marks that it changes; none in a run of which marks do not matter.
    pub writes: Vec<Write>,
    /// Whether it has missed the sensor of the cell to which it goes, and something comes of that.
    pub is_missed: bool,
}

/// Agents' turns on a floor.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Run {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// The floor.
    pub floor: Floor,
    /// Walls between neighbours, the western or northern cell first.
    pub walls: BTreeSet<(Place, Place)>,
    /// Where each agent starts.
    pub starts: Vec<Place>,
    /// The turns.
    pub turns: Vec<Turn>,
    /// The last of the turns that are said to come again for ever; 0 if the run ends.
    pub round: usize,
}

plain!(Mark one of Explored, Closing, Visited);
plain!(Fate one of Awake, Done, Fails);
plain!(Write { at, mark });
plain!(Turn { agent, side, fate, writes, is_missed });

impl Plain for Run {
    fn change(&mut self, change: &mut Change) {
        let Self { floor, walls, starts, turns, round, .. } = self;
        let places: Vec<Place> = floor.places().collect();
        change.toggles("an obstacle", &mut floor.barred, &places);
        let pairs = places.iter().flat_map(|&(x, y)| [(x + 1, y), (x, y + 1)].map(|next| ((x, y), next)));
        let inside: Vec<(Place, Place)> = pairs.filter(|&(_, next)| floor.has(next)).collect();
        change.toggles("a wall", walls, &inside);
        change.within("columns", &mut floor.columns);
        change.within("rows", &mut floor.rows);
        change.within("start", starts);
        change.within("turn", turns);
        change.within("round", round);
    }
}

/// The agents and the floor.
#[derive(Clone, PartialEq, Eq)]
struct Scene {
    places: Vec<Place>,
    fates: Vec<Fate>,
    explored: BTreeSet<Place>,
    marks: BTreeMap<Place, Mark>,
    /// By agent: whether it has scanned, and is to write.
    has_scanned: Vec<bool>,
    moves: usize,
}

impl Run {
    /// Whether an agent can go from one cell to the other in one turn.
    fn is_open(&self, from: Place, to: Place) -> bool {
        let is_beside = (0..4).any(|side| beside(from, side) == Some(to));
        is_beside && self.floor.is_free(to) && !self.walls.contains(&(from.min(to), from.max(to)))
    }

    /// The cells of `among` that are connected with `from` through them.
    fn connected(&self, from: &[Place], among: impl Fn(Place) -> bool) -> BTreeSet<Place> {
        let (mut found, mut rim) = (BTreeSet::new(), from.to_vec());
        while let Some(cell) = rim.pop() {
            if among(cell) && found.insert(cell) {
                let next = (0..4).filter_map(|side| beside(cell, side));
                rim.extend(next.filter(|&next| self.is_open(cell, next)));
            }
        }
        found
    }

    fn start(&self) -> Scene {
        let agents = self.starts.len();
        Scene {
            places: self.starts.clone(),
            fates: vec![Fate::Awake; agents],
            explored: self.starts.iter().copied().collect(),
            marks: self.starts.iter().map(|&start| (start, Mark::Explored)).collect(),
            has_scanned: vec![false; agents],
            moves: 0,
        }
    }

    /// Whether marks are written down.
    fn has_marks(&self) -> bool {
        self.turns.iter().any(|turn| !turn.writes.is_empty())
    }

    fn take(&self, scene: &mut Scene, turn: &Turn) -> Result<(), &'static str> {
        let Turn { agent, side, fate, ref writes, is_missed } = *turn;
        let Some(&from) = scene.places.get(agent) else { return Err("there is no such agent") };
        must(scene.fates[agent] == Fate::Awake, "an agent acts that acts no more")?;
        let to = side.map_or(Some(from), |side| beside(from, side)).ok_or("there is no such side")?;
        must(to == from || self.is_open(from, to), "an agent goes where it cannot go")?;
        must(fate == Fate::Awake || to == from, "an agent that goes is not done, and has not failed")?;
        if fate == Fate::Fails {
            must(self.clause == "BRICKS-11", "no agent fails here")?;
            must(writes.is_empty() && !is_missed, "an agent that fails does nothing")?;
        } else if self.clause == "BRICKS-3" {
            // A scan, and then what follows from it.
            if !std::mem::replace(&mut scene.has_scanned[agent], true) {
                scene.fates[agent] = fate;
                return must(
                    to == from && fate == Fate::Awake && writes.is_empty() && !is_missed,
                    "an agent only looks when it scans",
                );
            }
            scene.has_scanned[agent] = false;
        }
        must(!is_missed || self.has_marks(), "marks play no part")?;
        if self.has_marks() {
            let known = scene.marks.clone();
            let mark = |cell: Place| known.get(&cell).copied();
            let is_shut = mark(to).is_some_and(|mark| mark != Mark::Explored);
            let falls = |write: &Write| mark(write.at).is_some_and(|known| write.mark < known);
            let needs = to != from && (is_shut || writes.iter().any(|write| write.at == to && falls(write)));
            must(is_missed || !needs, "an agent enters a cell that is shut, or a mark falls")?;
            must(!is_missed || needs, "nothing comes of a sensor that is missed")?;
            for (number, write) in writes.iter().enumerate() {
                must(
                    write.at == from || write.at == to,
                    "an agent writes to a cell that it neither leaves nor enters",
                )?;
                let is_first = writes[..number].iter().all(|other| other.at < write.at);
                must(is_first, "marks are written cell by cell, each once")?;
                must(mark(write.at) != Some(write.mark), "a mark is written that is there")?;
                must(write.at == to || !falls(write), "a mark falls")?;
                scene.marks.insert(write.at, write.mark);
            }
            must(
                scene.marks.contains_key(&to),
                "an agent is in a cell whose sensor says that none has been there",
            )?;
        }
        scene.moves += usize::from(to != from);
        scene.places[agent] = to;
        scene.fates[agent] = fate;
        scene.explored.insert(to);
        Ok(())
    }

    /// Whether the clause is broken when an agent has come to be in this state, by what one sees at once.
    fn is_broken(&self, scene: &Scene, turn: &Turn, due: &BTreeSet<Place>) -> bool {
        let is_left = |cell: &Place| scene.marks.get(cell) != Some(&Mark::Visited);
        match self.clause {
            "BRICKS-2" | "BRICKS-3" => {
                let left: BTreeSet<Place> = due.iter().copied().filter(is_left).collect();
                let first: Vec<Place> = left.first().copied().into_iter().collect();
                self.connected(&first, |cell| left.contains(&cell)) != left
            }
            "BRICKS-4" if turn.fate == Fate::Done => {
                let is_other = |cell: &&Place| **cell != scene.places[turn.agent];
                !due.is_subset(&scene.explored)
                    || self.has_marks() && due.iter().filter(is_other).any(is_left)
            }
            "BRICKS-12" => scene.moves > 2 * due.len(),
            _ => false,
        }
    }
}

impl Case for Run {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        let Self { clause, ref floor, ref walls, ref starts, ref turns, round } = *self;
        let is_able = !starts.is_empty() && !turns.is_empty() && round <= turns.len();
        must(is_able, "a counterexample needs an agent and its turns")?;
        let is_placed = |place: &Place| floor.is_free(*place);
        must(starts.iter().all(is_placed), "an agent starts where there is no free cell")?;
        must(clause != "BRICKS-12" || starts.len() == 1, "the agent is not alone")?;
        must(clause != "BRICKS-3" || starts.len() == 2, "there are not two agents")?;
        let due = self.connected(starts, |_| true);
        let is_all = floor.places().filter(|place| floor.is_free(*place)).all(|place| due.contains(&place));
        must(is_all, "a cell is not connected with the agents")?;
        let is_wall = |&(one, other): &(Place, Place)| floor.is_free(one) && floor.is_free(other);
        must(walls.iter().all(is_wall), "a wall is not between free cells")?;
        let (mut scene, mut before, mut acting) = (self.start(), None, BTreeSet::new());
        for (number, turn) in turns.iter().enumerate() {
            let at = number + 1;
            if number == turns.len() - round {
                before = Some(scene.clone());
            }
            self.take(&mut scene, turn).map_err(|what| Objection { at, what })?;
            acting.extend((number >= turns.len() - round).then_some(turn.agent));
            let is_early = at < turns.len() && self.is_broken(&scene, turn, &due);
            must(!is_early, "the clause is broken before").map_err(|what| Objection { at, what })?;
        }
        let awake = |scene: &Scene, agent: usize| scene.fates[agent] == Fate::Awake;
        let is_over = (0..starts.len()).all(|agent| !awake(&scene, agent));
        let fails = scene.fates.iter().filter(|fate| **fate == Fate::Fails).count();
        must(clause != "BRICKS-11" || fails > 0 && fails < starts.len(), "nobody fails, or everybody")?;
        let goes_round = before.is_some_and(|before| {
            let acts = |agent: usize| !awake(&before, agent) || acting.contains(&agent);
            let is_same = Scene { moves: 0, ..before.clone() } == Scene { moves: 0, ..scene.clone() };
            is_same && (0..starts.len()).all(acts) && !is_over
        });
        let is_unexplored = !due.is_subset(&scene.explored);
        let is_left =
            self.has_marks() && due.iter().any(|cell| scene.marks.get(cell) != Some(&Mark::Visited));
        let is_broken = match (clause, round) {
            ("BRICKS-2" | "BRICKS-3" | "BRICKS-4" | "BRICKS-12", 0) => {
                self.is_broken(&scene, &turns[turns.len() - 1], &due)
            }
            ("BRICKS-5", 0) => is_over && is_unexplored,
            ("BRICKS-5", _) => goes_round && is_unexplored,
            ("BRICKS-6" | "BRICKS-11", 0) => is_over && (is_unexplored || is_left),
            ("BRICKS-6" | "BRICKS-11", _) => goes_round,
            _ => false,
        };
        must(is_broken, "the clause is not broken")?;
        // Marks are written down only where they matter.
        let matters = match clause {
            "BRICKS-2" | "BRICKS-3" => true,
            "BRICKS-4" | "BRICKS-6" | "BRICKS-11" => !is_unexplored && round == 0,
            _ => false,
        };
        Ok(must(matters || !self.has_marks(), "marks play no part")?)
    }
}
