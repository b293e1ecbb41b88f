//! One action of an agent that searches in trees: it scans, writes into the sensor of its cell and of the one that it
//! enters, and goes there. Reading and writing are one step: two agents whose scans overlap take turns (BRICKS-3).

use core::mem;

use super::note::{Label, Note, State};
use super::rule::{Condition, Rule};
use super::view::View;
use crate::bricks::marking::blocks;
use crate::bricks::rule as paper;
use crate::choice::Oracle;
use crate::floor::{Floor, Ring};
use crate::ground::{Cell, Side};

/// Cells around that read as unexplored: in the last scan, in the last two, and so on.
type MissedCells = [Ring; Rule::MOST_READINGS as usize - 1];

const NONE_MISSED: MissedCells = [Ring(0); Rule::MOST_READINGS as usize - 1];

/// An agent's memory: no map, and no place.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Agent {
    /// No two agents have the same.
    pub id: u8,
    /// The trees that it has founded.
    pub founded: u32,
    /// The side that leads back, if it has gone to a cell that read as unexplored.
    back: Option<Side>,
    /// The cells around its cell that it knows to have sensors.
    known: Ring,
    /// Those that have read as unexplored in its last scan, in its last two scans, and so on.
    missed: MissedCells,
}

/// An agent's action after a scan.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Act {
    /// The note that the sensor of its cell stores from now on.
    pub here: Note,
    /// Where the agent goes, or that it ends.
    pub next: Next,
}

/// An agent's next cell, or its end, after an action.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Next {
    /// It goes through a side, to a cell whose sensor it has seen.
    Goes(Side),
    /// It goes through a side, to a cell that it makes a child of the one it leaves, in its tree.
    Adopts(Side),
    /// It goes through a side, to a cell that reads as unexplored, where it places a sensor.
    Explores(Side),
    /// It stays, and scans again: it has missed a sensor that it knows of.
    Waits,
    /// All is visited.
    Done,
}

impl Next {
    /// The side that it goes through.
    pub const fn side(self) -> Option<Side> {
        match self {
            Self::Goes(side) | Self::Adopts(side) | Self::Explores(side) => Some(side),
            Self::Waits | Self::Done => None,
        }
    }
}

impl Agent {
    /// An agent before its first action.
    pub const fn new(id: u8) -> Self {
        Self { id, founded: 0, back: None, known: Ring(0), missed: NONE_MISSED }
    }

    /// The agent's action after a scan.
    pub fn decide(&mut self, rule: Rule, view: &View) -> Act {
        let (known, doubted) = (view.known.or(self.known), self.doubted(rule, view.scan.unexplored));
        let view = View { known, doubted, ..*view };
        let view = if rule.has(Condition::Restores) { View { here: view.restored(), ..view } } else { view };
        let act = self.choose(rule, &view);
        if rule.has(Condition::Remembers) {
            self.known = act.next.side().map_or(view.known, |side| view.known.seen_beyond(side));
        }
        if rule.readings > 1 {
            self.misses(view.scan.unexplored, act.next.side());
        }
        self.back = match act.next {
            Next::Explores(side) if rule.has(Condition::Underfoot) => Some(side.opposite()),
            Next::Waits => self.back,
            Next::Goes(_) | Next::Adopts(_) | Next::Explores(_) | Next::Done => None,
        };
        act
    }

    /// Those of the cells that read as `unexplored` which have done so too few times in a row.
    fn doubted(&self, rule: Rule, unexplored: Ring) -> Ring {
        let often = usize::from(rule.readings).checked_sub(2).and_then(|before| self.missed.get(before));
        often.map_or(Ring::default(), |often| unexplored.and(often.not()))
    }

    /// Counts the cells that read as `unexplored`, and goes through `side`.
    fn misses(&mut self, unexplored: Ring, side: Option<Side>) {
        let before = mem::replace(&mut self.missed, [unexplored; NONE_MISSED.len()]);
        for (now, before) in self.missed.iter_mut().skip(1).zip(before) {
            *now = unexplored.and(before);
        }
        if let Some(side) = side {
            let left = Ring::of(side.opposite());
            self.missed = self.missed.map(|missed| missed.seen_beyond(side).and(left.not()));
        }
    }

    fn choose(&mut self, rule: Rule, view: &View) -> Act {
        if let Some(back) = self.back.filter(|_| !view.here.is_new()) {
            return Act { here: view.here, next: Next::Goes(back) };
        }
        if view.here.state == State::Visited {
            return Act { here: view.here, next: follow(rule, view) };
        }
        let is_brick = rule.has(Condition::Bricks) && !blocks(paper::Rule::PUBLISHED, &view.scan);
        if is_brick && may_mark(rule, view) {
            let next = leave(view);
            return Act { here: mark(rule, view.here, next.side()), next };
        }
        let here = self.join(rule, view);
        go_on(rule, view, here)
    }

    /// The sensor of its cell, which blocks, as one of a tree: the one it belongs to; or that with the greatest label
    /// beside it; or, if nothing beside it is unexplored, a new one.
    fn join(&mut self, rule: Rule, view: &View) -> Note {
        let here = view.here;
        if here.state == State::Open {
            return here;
        }
        if let Some((side, note)) =
            view.neighbours().max_by_key(|(_, note)| note.tree()).filter(|(_, note)| note.tree().is_some())
        {
            return child(rule, here, note, side);
        }
        if rule.has(Condition::Bricks) && view.unexplored() != Ring::default() {
            return here;
        }
        match Label::new(self.founded, self.id) {
            Some(label) => {
                self.founded += 1;
                here.of_tree(label.lowest(rule.label_bits), None).at_depth(0)
            }
            None => here,
        }
    }
}

/// The note stored as a child of `parent`, which is beyond `side`.
fn child(rule: Rule, note: Note, parent: Note, side: Side) -> Note {
    let note = note.of_tree(parent.label, Some(side));
    if rule.has(Condition::Restores) { note.at_depth(parent.depth.saturating_add(1)) } else { note }
}

/// Whether the trees allow that the cell is marked.
fn may_mark(rule: Rule, view: &View) -> bool {
    let is_childless = !rule.has(Condition::Childless) || view.children().next().is_none();
    let own = view.here.tree();
    let is_one =
        !rule.has(Condition::OneLabel) || own.is_none_or(|own| view.trees().all(|(_, label)| label == own));
    is_childless && is_one
}

/// The sensor of a cell that is marked, `exit` leading to where more is left to do.
fn mark(rule: Rule, here: Note, exit: Option<Side>) -> Note {
    here.visited(exit.filter(|_| rule.has(Condition::Exit)))
}

/// Where an agent goes that has marked its cell: where something is left to do.
fn leave(view: &View) -> Next {
    view.way_on().map(Next::Explores).or_else(|| back_to_work(view)).unwrap_or(Next::Done)
}

/// To a neighbour that is not visited: one that belongs to no tree, else the parent, else any.
fn back_to_work(view: &View) -> Option<Next> {
    let beside = |state| view.neighbours().find(|(_, note)| note.state == state).map(|(side, _)| side);
    let parent = || view.here.tree().and(view.here.side);
    beside(State::Explored).or_else(parent).or_else(|| beside(State::Open)).map(Next::Goes)
}

/// Where an agent goes from a cell that another one has marked: through the side that the cell stores. So helpers with
/// one tree go down to no cell twice (BRICKS-10). Agents that mark bricks look beside first: the side may lead far.
fn follow(rule: Rule, view: &View) -> Next {
    let beside = if rule.has(Condition::Bricks) { leave(view) } else { Next::Done };
    if beside == Next::Done { view.here.side.map_or(Next::Done, Next::Goes) } else { beside }
}

/// The agent's action in a cell that it cannot mark as it stands, and whose sensor is to store `here`.
fn go_on(rule: Rule, view: &View, here: Note) -> Act {
    let act = |next| Act { here, next };
    if let Some(side) = view.way_on() {
        return act(Next::Explores(side));
    }
    let misses = view.unexplored() != Ring::default();
    let Some(own) = here.tree() else {
        // It may have missed a tree beside it; or no label is left, and it goes to any cell that is not visited.
        let anywhere = back_to_work(view).unwrap_or(Next::Done);
        return act(if misses { Next::Waits } else { anywhere });
    };
    if let Some(side) = adopted(rule, view, here, own) {
        return act(Next::Adopts(side));
    }
    if let Some(side) = least(view.children()).filter(|_| rule.has(Condition::Childless)) {
        return act(Next::Goes(side));
    }
    if let Some((side, _)) = view.trees().filter(|&(_, label)| label > own).max_by_key(|&(_, label)| label) {
        return act(Next::Goes(side));
    }
    if misses {
        return act(Next::Waits);
    }
    Act { here: mark(rule, here, here.side), next: here.side.map_or(Next::Done, Next::Goes) }
}

/// The neighbour that becomes a child of the cell, which is one of the tree `own` as `here` says: one that belongs to
/// no tree, or else to one with a lower label.
fn adopted(rule: Rule, view: &View, here: Note, own: Label) -> Option<Side> {
    let is_lower = |&(side, note): &(Side, Note)| {
        let is_other = || !note.is_child_beyond(side) && here.side != Some(side);
        note.tree().is_some_and(|label| label < own || !rule.has(Condition::LowerOnly) && is_other())
    };
    let explored = view.neighbours().filter(|(_, note)| note.state == State::Explored);
    least(explored).or_else(|| least(view.neighbours().filter(is_lower)))
}

/// The one of `notes` that was entered least, ties in the order of the compass.
fn least(notes: impl Iterator<Item = (Side, Note)>) -> Option<Side> {
    notes.min_by_key(|(_, note)| note.crossings).map(|(side, _)| side)
}

/// Writes what an agent in `cell` has decided; where it is then.
pub fn carry_out(rule: Rule, floor: &mut impl Floor<Note>, cell: Cell, act: &Act) -> Cell {
    let Act { here, next } = *act;
    floor.put(cell, here);
    let Some(side) = next.side() else { return cell };
    let beyond = cell.beyond(side);
    let there = floor.sensor(beyond).unwrap_or_default();
    let found = match next {
        Next::Explores(_) if !rule.has(Condition::Underfoot) => Note::default(),
        Next::Goes(_) | Next::Adopts(_) | Next::Explores(_) | Next::Waits | Next::Done => there,
    };
    let is_adopted = match next {
        Next::Goes(_) | Next::Waits | Next::Done => false,
        Next::Adopts(_) => true,
        Next::Explores(_) => !rule.has(Condition::Bricks) && found.state == State::Unexplored,
    };
    let entered = found.entered();
    floor.put(beyond, if is_adopted { child(rule, entered, here, side.opposite()) } else { entered });
    beyond
}

/// One action of `agent` in `cell`: what it did, and where it is then. Whether sensors are missed is asked of `world`.
pub fn act(
    rule: Rule,
    floor: &mut impl Floor<Note>,
    agent: &mut Agent,
    cell: Cell,
    world: &mut (impl Oracle + ?Sized),
) -> (Act, Cell) {
    let view = View::new(floor, cell, world);
    let act = agent.decide(rule, &view);
    (act, carry_out(rule, floor, cell, &act))
}
