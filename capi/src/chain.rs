//! The chain of robots [Kovács 2011, III: Algorithms 1 to 3]: begin, plan, settle or hear, and what is known.
//! Clauses CHAIN-1 to CHAIN-19 hold of it as of [`tautline_kernel::chain`].

use core::ffi::c_void;
use core::mem::MaybeUninit;

use tautline_kernel::chain::{Chain, Intent, Kind, Plan, Rule};
use tautline_kernel::ground::{Area, Cell, CellMark, Edge, Grid, Side, SmallGrid, Step};

use crate::caller::{bytes, give, read, status, write};
use crate::status::TautlineStatus;

/// The most robots of a chain, the base counted.
pub const TAUTLINE_CHAIN_ROBOTS: usize = 16;
/// The most columns and rows of an area.
pub const TAUTLINE_CHAIN_CELLS: usize = 16;
/// The size of a chain in words of 8 bytes.
pub const TAUTLINE_CHAIN_WORDS: usize = 128;

/// The chain as the paper publishes it.
pub const TAUTLINE_RULE_PUBLISHED: u32 = 0;
/// The chain with the repairs of its refuted claims.
pub const TAUTLINE_RULE_REPAIRED: u32 = 1;
/// The repaired chain that reels itself in and out instead of taking moves back.
pub const TAUTLINE_RULE_REEL: u32 = 2;

/// A plan that seeks new cells.
pub const TAUTLINE_KIND_ADVANCE: u32 = 0;
/// A plan that takes an earlier move back.
pub const TAUTLINE_KIND_BACKTRACK: u32 = 1;

/// The robot goes one column east.
pub const TAUTLINE_STEP_EAST: u8 = 0;
/// The robot goes one row south.
pub const TAUTLINE_STEP_SOUTH: u8 = 1;
/// The robot goes one column west.
pub const TAUTLINE_STEP_WEST: u8 = 2;
/// The robot goes one row north.
pub const TAUTLINE_STEP_NORTH: u8 = 3;
/// The robot stays.
pub const TAUTLINE_STEP_STAY: u8 = 4;

/// A cell: its column, counted eastwards, and its row, counted southwards.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct TautlineCell {
    /// The column.
    pub x: i16,
    /// The row.
    pub y: i16,
}

/// A step for every robot of a team, for one team move.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct TautlinePlan {
    /// One of `TAUTLINE_KIND_…`.
    pub kind: u32,
    /// How many robots there are, the base counted.
    pub robots: u32,
    /// For each robot one of `TAUTLINE_STEP_…`; the base is the first, and stays.
    pub steps: [u8; TAUTLINE_CHAIN_ROBOTS],
}

/// Whether a robot can go between two cells beside each other: any other number than 0 if it can. `context` is what the
/// caller gave with the function.
pub type TautlineIsOpen =
    Option<unsafe extern "C" fn(context: *mut c_void, one: TautlineCell, other: TautlineCell) -> i32>;

/// A chain and the memory that it needs. A caller reads and writes nothing in it, and may copy it as a whole.
#[repr(C)]
pub struct TautlineChain {
    mark: u64,
    memory: [MaybeUninit<u64>; TAUTLINE_CHAIN_WORDS],
}

/// The content of the memory.
#[derive(Clone, Copy)]
struct State {
    chain: Chain<SmallGrid, TAUTLINE_CHAIN_ROBOTS>,
    /// The plan to be settled.
    plan: Option<Plan<TAUTLINE_CHAIN_ROBOTS>>,
}

/// The mark of memory that holds a [`State`]: the letters of the name and the size.
const MARK: u64 = 0x7461_7574_6c69_0000 | size_of::<State>() as u64;

const _: () = assert!(size_of::<State>() <= 8 * TAUTLINE_CHAIN_WORDS, "TAUTLINE_CHAIN_WORDS is too small");
const _: () = assert!(align_of::<State>() <= align_of::<u64>(), "a chain needs more than words of 8 bytes");

impl TautlineChain {
    fn state(&self) -> Result<&State, TautlineStatus> {
        if self.mark != MARK {
            return Err(TautlineStatus::NotBegun);
        }
        // SAFETY: the mark says that `tautline_chain_begin` has written a state here, which fits in size and alignment.
        Ok(unsafe { &*self.memory.as_ptr().cast() })
    }

    fn state_mut(&mut self) -> Result<&mut State, TautlineStatus> {
        if self.mark != MARK {
            return Err(TautlineStatus::NotBegun);
        }
        // SAFETY: as in `state`; the chain is borrowed for as long as its state.
        Ok(unsafe { &mut *self.memory.as_mut_ptr().cast() })
    }
}

const fn cell(TautlineCell { x, y }: TautlineCell) -> Cell {
    Cell::new(x, y)
}

const fn told(Cell { x, y }: Cell) -> TautlineCell {
    TautlineCell { x, y }
}

const fn code(step: Step) -> u8 {
    match step {
        Step::Cross(Side::East) => TAUTLINE_STEP_EAST,
        Step::Cross(Side::South) => TAUTLINE_STEP_SOUTH,
        Step::Cross(Side::West) => TAUTLINE_STEP_WEST,
        Step::Cross(Side::North) => TAUTLINE_STEP_NORTH,
        Step::Stay => TAUTLINE_STEP_STAY,
    }
}

/// Makes a chain in the caller's memory: `robots`, the base counted, all in the cell `base`. The area goes from the
/// cell `first` in the north-west to the cell `last` in the south-east; nothing is known of it but its border.
///
/// # Safety
/// `chain` is null, or memory of the caller that nobody else uses meanwhile.
// SAFETY: no other function of this name is linked.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tautline_chain_begin(
    chain: *mut TautlineChain,
    rule: u32,
    robots: u32,
    first: TautlineCell,
    last: TautlineCell,
    base: TautlineCell,
) -> TautlineStatus {
    let begin = || {
        if chain.is_null() {
            return Err(TautlineStatus::NullPointer);
        }
        let rule = match rule {
            TAUTLINE_RULE_PUBLISHED => Rule::PUBLISHED,
            TAUTLINE_RULE_REPAIRED => Rule::REPAIRED,
            TAUTLINE_RULE_REEL => Rule::REEL,
            _ => return Err(TautlineStatus::UnknownRule),
        };
        let area = Area::new(cell(first), cell(last)).ok_or(TautlineStatus::BadArea)?;
        let grid = SmallGrid::new(area).ok_or(TautlineStatus::BadArea)?;
        let state = State { chain: Chain::new(rule, robots as usize, cell(base), grid)?, plan: None };
        // SAFETY: the caller's promise; the memory need not hold anything yet.
        let memory = unsafe { &raw mut (*chain).memory };
        // SAFETY: a state fits in size and alignment.
        unsafe { memory.cast::<State>().write(state) };
        // SAFETY: the caller's promise.
        let mark = unsafe { &raw mut (*chain).mark };
        // SAFETY: a number fits where it is declared.
        unsafe { mark.write(MARK) };
        Ok(TautlineStatus::Ok)
    };
    status(begin())
}

/// Says in `plan` what the team intends. `log` has the messages of all team moves so far, as `tautline_chain_settle`
/// wrote them. When the run is over, the status says how it ended, and `plan` stays as it was.
///
/// # Safety
/// `chain` and `plan` are null, or memory of the caller that nobody else uses meanwhile; `log` has so many bytes.
// SAFETY: no other function of this name is linked.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tautline_chain_plan(
    chain: *mut TautlineChain,
    log: *const u8,
    log_bytes: usize,
    plan: *mut TautlinePlan,
) -> TautlineStatus {
    let make = || {
        // SAFETY: the caller's promise.
        let state = unsafe { write(chain) }?.state_mut()?;
        // SAFETY: the caller's promise.
        let told = unsafe { write(plan) }?;
        // SAFETY: the caller's promise.
        let log = unsafe { bytes(log, log_bytes) }?;
        state.plan = None;
        let made = match state.chain.plan(log)? {
            Intent::Done(end) => return Ok(end.into()),
            Intent::Go(made) => made,
        };
        let mut steps = [TAUTLINE_STEP_STAY; TAUTLINE_CHAIN_ROBOTS];
        for (place, &step) in steps.iter_mut().zip(made.steps()) {
            *place = code(step);
        }
        let kind = match made.kind {
            Kind::Advance => TAUTLINE_KIND_ADVANCE,
            Kind::Backtrack => TAUTLINE_KIND_BACKTRACK,
        };
        *told = TautlinePlan { kind, robots: made.steps().len() as u32, steps };
        state.plan = Some(made);
        Ok(TautlineStatus::Ok)
    };
    status(make())
}

/// Carries the plan out. `is_open` answers for every pair of cells that a robot goes between for the first time, once
/// each, in the order of the robots. The messages of the robots behind the base, one byte each, go to `messages`, and
/// their number to `sent`: the caller appends them to the log.
///
/// # Safety
/// `chain` is null, or memory of the caller that nobody else uses meanwhile; `messages` has room for `capacity` bytes;
/// `is_open` returns, and does not use `chain`.
// SAFETY: no other function of this name is linked.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tautline_chain_settle(
    chain: *mut TautlineChain,
    is_open: TautlineIsOpen,
    context: *mut c_void,
    messages: *mut u8,
    capacity: usize,
    sent: *mut usize,
) -> TautlineStatus {
    let settle = || {
        // SAFETY: the caller's promise.
        let state = unsafe { write(chain) }?.state_mut()?;
        let is_open = is_open.ok_or(TautlineStatus::NullPointer)?;
        if messages.is_null() || sent.is_null() {
            return Err(TautlineStatus::NullPointer);
        }
        if capacity < state.chain.cells().len() - 1 {
            return Err(TautlineStatus::TooSmall);
        }
        let plan = state.plan.take().ok_or(TautlineStatus::NoPlan)?;
        let settled = state.chain.settle(&plan, |edge: Edge| {
            let (one, other) = (edge.cell(), edge.cell().beyond(edge.side()));
            // SAFETY: the function is the caller's own, with its own context.
            (unsafe { is_open(context, told(one), told(other)) }) != 0
        });
        // SAFETY: the caller's promise.
        unsafe { give(settled.messages(), messages, capacity, sent) }?;
        Ok(TautlineStatus::Ok)
    };
    status(settle())
}

/// Carries the plan out as a robot that plans along and hears of the rest (CHAIN-8): `messages` has one byte of each
/// robot but the base about this team move. A message that cannot be about it is refused, and the plan is still to be
/// settled.
///
/// # Safety
/// `chain` is null, or memory of the caller that nobody else uses meanwhile; `messages` has so many bytes.
// SAFETY: no other function of this name is linked.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tautline_chain_hear(
    chain: *mut TautlineChain,
    messages: *const u8,
    message_bytes: usize,
) -> TautlineStatus {
    let hear = || {
        // SAFETY: the caller's promise.
        let state = unsafe { write(chain) }?.state_mut()?;
        // SAFETY: the caller's promise.
        let messages = unsafe { bytes(messages, message_bytes) }?;
        let plan = state.plan.ok_or(TautlineStatus::NoPlan)?;
        state.chain.hear(&plan, messages)?;
        state.plan = None;
        Ok(TautlineStatus::Ok)
    };
    status(hear())
}

/// Writes to `cells` where the robots are, the base first and the leader last, and their number to `robots`.
///
/// # Safety
/// `chain` is null, or a chain that nobody changes meanwhile; `cells` has room for `capacity` cells.
// SAFETY: no other function of this name is linked.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tautline_chain_cells(
    chain: *const TautlineChain,
    cells: *mut TautlineCell,
    capacity: usize,
    robots: *mut usize,
) -> TautlineStatus {
    let tell = || {
        // SAFETY: the caller's promise.
        let team = unsafe { read(chain) }?.state()?.chain.cells();
        let mut known = [TautlineCell { x: 0, y: 0 }; TAUTLINE_CHAIN_ROBOTS];
        for (place, &cell) in known.iter_mut().zip(team) {
            *place = told(cell);
        }
        // SAFETY: the caller's promise.
        unsafe { give(known.get(..team.len()).unwrap_or(&known), cells, capacity, robots) }?;
        Ok(TautlineStatus::Ok)
    };
    status(tell())
}

/// Writes to `is_explored` 1 if a robot has been in the cell, or if it is outside the area, else 0.
///
/// # Safety
/// `chain` is null, or a chain that nobody changes meanwhile; `is_explored` is null or the caller's own.
// SAFETY: no other function of this name is linked.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tautline_chain_is_explored(
    chain: *const TautlineChain,
    asked: TautlineCell,
    is_explored: *mut u8,
) -> TautlineStatus {
    let tell = || {
        // SAFETY: the caller's promise.
        let state = unsafe { read(chain) }?.state()?;
        // SAFETY: the caller's promise.
        *unsafe { write(is_explored) }? = u8::from(state.chain.grid().has(CellMark::Explored, cell(asked)));
        Ok(TautlineStatus::Ok)
    };
    status(tell())
}
