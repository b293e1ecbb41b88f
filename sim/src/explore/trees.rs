//! Agents that search in trees on a sensor floor (BRICKS-8 to BRICKS-12): brick-tree, helpers and MDFS. The team is
//! that of all agents.

use tautline_kernel::bricks::tree::{Next, Note, Rule as Trees, View, settle};
use tautline_kernel::floor::Scan;
use tautline_kernel::ground::{Cell, Step};
use tautline_proofs::bricks::tree::{Memory, Way};

use super::agents::{Acted, Crew, Misses};
use super::floor::SensorFloor;

/// Brick-tree.
pub const TREE: Way = Way::Trees(Trees::TREE);
/// Helpers as long as no sensor is missed.
pub const HELPERS_TRUSTING: Way = Way::Trees(Trees::HELPERS);
/// Helpers, robust against missed sensors.
pub const HELPERS_ROBUST: Way = Way::Trees(Trees::ROBUST);
/// Helpers that place sensors unasked, and doubt what they miss.
pub const HELPERS_DOUBTING: Way = Way::Trees(Trees::DOUBTING);

impl Crew for Way {
    type Stored = Note;
    type Mind = Memory;
    type View = View;

    fn mind(&self, id: u8) -> Memory {
        self.memory(id)
    }

    fn settle(&self, floor: &mut SensorFloor<Note>, starts: &[Cell]) {
        settle(floor, starts);
    }

    fn look(&self, floor: &SensorFloor<Note>, cell: Cell, world: &mut Misses) -> View {
        View::new(floor, cell, world)
    }

    fn scan(view: &View) -> &Scan {
        &view.scan
    }

    fn act(&self, floor: &mut SensorFloor<Note>, mind: &mut Memory, cell: Cell, view: &View) -> Acted {
        let act = self.decide(mind, view);
        self.carry_out(floor, cell, &act);
        Acted { step: act.next.side().map_or(Step::Stay, Step::Cross), is_done: act.next == Next::Done }
    }

    fn may_roam(&self, _: bool) -> bool {
        false
    }

    /// An agent reads the crossings.
    fn repeats(&self) -> bool {
        false
    }

    fn promises(&self, is_blind: bool) -> bool {
        !is_blind || self.looks_underfoot()
    }
}
