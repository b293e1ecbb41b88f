//! The state of a small floor whose sensors store trees, and of the agents on it.

use std::array;

use tautline_kernel::bricks::tree::{Act, Label, Note, Notes, State as Cellular, settle};
use tautline_kernel::floor::Mark;
use tautline_kernel::ground::{Cell, Edge};

use super::Memory;
use crate::engine::states::Places;
use crate::floor::plans::{CELLS, Edges, FloorPlan};

/// An agent on the floor.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Body {
    pub(super) memory: Memory,
    pub(super) cell: Cell,
    pub(super) is_done: bool,
    /// Whether it acts no more, although it is not done.
    pub(super) has_failed: bool,
    /// The cells that it has entered, where that is bounded.
    pub(super) moves: u8,
    /// What it has decided and has yet to carry out.
    pub(super) pending: Option<Act>,
}

impl Body {
    pub(super) const fn new(memory: Memory, cell: Cell) -> Self {
        Self { memory, cell, is_done: false, has_failed: false, moves: 0, pending: None }
    }

    pub(super) const fn is_awake(&self) -> bool {
        !self.is_done && !self.has_failed
    }
}

/// What a small floor stores, and those on it.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) struct State {
    pub(super) notes: [Note; CELLS],
    pub(super) bodies: Vec<Body>,
    /// Sensors missed so far.
    pub(super) misses: u8,
}

const QUARTER: usize = CELLS / 4;

/// The place of the count, behind the quarters, and of the first body.
const COUNT: usize = CELLS / QUARTER;
const FIRST_BODY: usize = COUNT + 1;

/// A part of a [`State`].
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) enum Part {
    /// A quarter of the floor.
    Floor([Note; QUARTER]),
    /// Sensors missed so far.
    Misses(u8),
    /// An agent.
    Body(Body),
}

impl State {
    /// The start of these, who are in `cells` of `plan`.
    pub(super) fn start(plan: &FloorPlan, cells: &[Cell], bodies: Vec<Body>) -> Self {
        let mut state = Self { notes: [Note::default(); CELLS], bodies, misses: 0 };
        settle(&mut Small { plan, notes: &mut state.notes }, cells);
        state
    }

    pub(super) const fn places(&self) -> usize {
        FIRST_BODY + self.bodies.len()
    }

    pub(super) fn part(&self, place: usize) -> Part {
        if place < COUNT {
            Part::Floor(array::from_fn(|number| self.notes[place * QUARTER + number]))
        } else if place < FIRST_BODY {
            Part::Misses(self.misses)
        } else {
            Part::Body(self.bodies[place - FIRST_BODY])
        }
    }

    pub(super) fn differing(&self, other: &Self) -> Places {
        let mut differing: Places = 0;
        for (cell, (one, other)) in self.notes.iter().zip(&other.notes).enumerate() {
            differing |= Places::from(one != other) << (cell / QUARTER);
        }
        differing |= Places::from(self.misses != other.misses) << COUNT;
        for (place, (one, other)) in (FIRST_BODY..).zip(self.bodies.iter().zip(&other.bodies)) {
            differing |= Places::from(one != other) << place;
        }
        differing
    }

    pub(super) fn put(&mut self, place: usize, part: &Part) {
        match part {
            Part::Floor(notes) => {
                self.notes[place * QUARTER..(place + 1) * QUARTER].copy_from_slice(notes);
            }
            Part::Misses(misses) => self.misses = *misses,
            Part::Body(body) => self.bodies[place - FIRST_BODY] = *body,
        }
    }

    /// No sensor counts farther than to `most`.
    pub(super) fn count_to(&mut self, most: u16) {
        self.notes.iter_mut().for_each(|note| note.crossings = note.crossings.min(most));
    }

    /// The cells of `plan` of which this is so.
    pub(super) fn cells(&self, plan: &FloorPlan, is: impl Fn(&Note) -> bool) -> u16 {
        let cells = (0..).zip(&self.notes).filter(|(_, note)| is(note));
        cells.fold(0, |set, (place, _)| set | 1 << place) & plan.free
    }

    /// The cells that are left to go through.
    pub(super) fn left(&self, plan: &FloorPlan) -> u16 {
        self.cells(plan, |note| note.mark() != Mark::Visited)
    }

    pub(super) fn is_explored(&self, plan: &FloorPlan) -> bool {
        self.cells(plan, |note| note.mark() == Mark::Unexplored) == 0
    }

    /// Whether the cells of each tree are connected through cells of trees with labels that are not lower (BRICKS-8).
    pub(super) fn are_trees_whole(&self, plan: &FloorPlan) -> bool {
        let labels = self.notes.iter().filter_map(|note| note.tree());
        labels.into_iter().all(|label: Label| {
            let own = self.cells(plan, |note| note.tree() == Some(label));
            let mut among = self.cells(plan, |note| note.tree().is_some_and(|other| other >= label));
            while among != 0 {
                let part = plan.spread(among, Edges::default());
                if part & own != 0 {
                    return own & !part == 0;
                }
                among &= !part;
            }
            true
        })
    }

    /// Whether every cell of a tree that has a parent has one in a tree with a label that is not lower (BRICKS-9).
    pub(super) fn do_labels_rise(&self, plan: &FloorPlan) -> bool {
        (0..).zip(&self.notes).all(|(place, note)| {
            let (Some(label), Some(side)) = (note.tree(), note.side) else { return true };
            let parent = plan.place(plan.cell(place).beyond(side)).map(|parent| self.notes[parent]);
            parent.is_some_and(|parent| parent.state == Cellular::Open && parent.label >= label)
        })
    }
}

/// The sensors of a plan.
pub(super) struct Small<'a> {
    pub(super) plan: &'a FloorPlan,
    pub(super) notes: &'a mut [Note; CELLS],
}

impl Notes for Small<'_> {
    fn note(&self, cell: Cell) -> Option<Note> {
        self.plan.place(cell).map(|place| self.notes[place])
    }

    fn write(&mut self, cell: Cell, note: Note) {
        if let Some(place) = self.plan.place(cell) {
            self.notes[place] = note;
        }
    }

    fn is_open(&self, edge: Edge) -> bool {
        !self.plan.has_wall(edge)
    }
}
