//! Monitors of robots that move, whatever program moves them: begin, hear, at, as [`tautline_monitor`] has them. Each
//! is told one stamped position at a time, and says whether a safety clause of `SPEC.md` is kept, broken or unknown.

use core::mem::MaybeUninit;
use core::slice;

use tautline_monitor::{
    AnyDemand, Apart, Breach, Cells, Connectivity, Doubt, Monitor, Neighbours, Place, Robot, SetupError,
    Verdict,
};

use crate::caller::{read, status, write};
use crate::status::TautlineStatus;

/// The size of a monitor in words of 8 bytes.
pub const TAUTLINE_MONITOR_WORDS: usize = 8;
/// The size of a robot in words of 8 bytes.
pub const TAUTLINE_ROBOT_WORDS: usize = 5;

/// CHAIN-3: robots whose numbers follow each other are at most `length_mm` apart.
pub const TAUTLINE_DEMAND_NEIGHBOURS: u32 = 0;
/// KIT-12, and of two robots KIT-1 and KIT-2: robots that are at most `length_mm` apart join all robots, directly or
/// over others. Whether they did when they started, as KIT-12 asks, is not looked at.
pub const TAUTLINE_DEMAND_JOINED: u32 = 1;
/// KIT-3: robots that have left their starts are at least `length_mm` apart.
pub const TAUTLINE_DEMAND_APART: u32 = 2;
/// CHAIN-2, FRONTIER-2, PACK-2: at most `most` robots are in one cell of the width `length_mm`, but for a base.
pub const TAUTLINE_DEMAND_CELLS: u32 = 3;

/// Every robot was heard within the gap, and the clause is not broken.
pub const TAUTLINE_VERDICT_KEPT: u32 = 0;
/// The clause is broken, whatever the robots that were not heard do.
pub const TAUTLINE_VERDICT_BROKEN: u32 = 1;
/// The clause is not seen to be broken, but not enough is known.
pub const TAUTLINE_VERDICT_UNKNOWN: u32 = 2;

/// This robot was not heard yet, or not within the gap.
pub const TAUTLINE_DOUBT_SILENT: u32 = 1;
/// The stamp is before one of the same robot; the position was not taken.
pub const TAUTLINE_DOUBT_LATE: u32 = 2;
/// The stamp is further ahead of now than the gap; the position was not taken.
pub const TAUTLINE_DOUBT_AHEAD: u32 = 3;
/// There is no robot of this number; the position was not taken.
pub const TAUTLINE_DOUBT_NOBODY: u32 = 4;
/// The place is more than 1,000 km away; the position was not taken.
pub const TAUTLINE_DOUBT_TOO_FAR: u32 = 5;

/// A demand of positions. What it does not speak of is not read.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct TautlineDemand {
    /// One of `TAUTLINE_DEMAND_...`.
    pub kind: u32,
    /// The range, the least distance, or the width of a cell, in millimetres.
    pub length_mm: u32,
    /// How far off a distance, or a position in cells, may be: less than the
    /// range, the least distance, or half the width of a cell.
    pub tolerance_mm: u32,
    /// The most robots in a cell.
    pub most: u32,
    /// Any other number than 0 if there is a base, a cell in which any number may be.
    pub has_base: u32,
    /// The column of the base.
    pub base_column: i32,
    /// The row of the base.
    pub base_row: i32,
}

/// The answer of a monitor.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct TautlineVerdict {
    /// One of `TAUTLINE_VERDICT_...`.
    pub kind: u32,
    /// The reason of an unknown verdict, one of `TAUTLINE_DOUBT_...`; else 0.
    pub doubt: u32,
    /// Two of the robots that break the clause, from 0, or one that breaks it alone
    /// twice; of a silent robot, or of one that there is not, its number first.
    pub robots: [u32; 2],
    /// The distance in millimetres, or the robots in the cell, of a broken clause.
    pub measured: u32,
    /// The most or the least that the clause allows, without the tolerance.
    pub allowed: u32,
}

/// The memory of one robot. A caller reads and writes nothing in it.
#[repr(C)]
pub struct TautlineRobot {
    memory: [MaybeUninit<u64>; TAUTLINE_ROBOT_WORDS],
}

/// A monitor and the memory that it needs. A caller reads and writes nothing in it.
#[repr(C)]
pub struct TautlineMonitor {
    mark: u64,
    memory: [MaybeUninit<u64>; TAUTLINE_MONITOR_WORDS],
}

impl TautlineDemand {
    const fn demand(&self) -> Option<AnyDemand> {
        let &Self { kind, length_mm, tolerance_mm, most, .. } = self;
        Some(match kind {
            TAUTLINE_DEMAND_NEIGHBOURS => {
                AnyDemand::Neighbours(Neighbours { range_mm: length_mm, tolerance_mm })
            }
            TAUTLINE_DEMAND_JOINED => {
                AnyDemand::Connectivity(Connectivity { range_mm: length_mm, tolerance_mm })
            }
            TAUTLINE_DEMAND_APART => AnyDemand::Apart(Apart { least_mm: length_mm, tolerance_mm }),
            TAUTLINE_DEMAND_CELLS => {
                let base = if self.has_base == 0 { None } else { Some([self.base_column, self.base_row]) };
                AnyDemand::Cells(Cells { cell_mm: length_mm, most, base, tolerance_mm })
            }
            _ => return None,
        })
    }
}

/// The content of the memory: the robots are the caller's, who keeps them where they are.
type State = Monitor<AnyDemand, &'static mut [Robot]>;

/// The mark of memory that holds a [`State`]: the letters of the name and the size.
const MARK: u64 = 0x7461_7574_6d6f_0000 | size_of::<State>() as u64;

const _: () =
    assert!(size_of::<State>() <= 8 * TAUTLINE_MONITOR_WORDS, "TAUTLINE_MONITOR_WORDS is too small");
const _: () = assert!(size_of::<Robot>() == 8 * TAUTLINE_ROBOT_WORDS, "TAUTLINE_ROBOT_WORDS is another size");
const _: () = assert!(align_of::<State>() <= align_of::<u64>(), "a monitor needs more than words of 8 bytes");
const _: () = assert!(align_of::<Robot>() <= align_of::<u64>(), "a robot needs more than words of 8 bytes");

impl TautlineMonitor {
    fn state(&mut self) -> Result<&mut State, TautlineStatus> {
        if self.mark != MARK {
            return Err(TautlineStatus::NotBegun);
        }
        // SAFETY: the mark says that `tautline_monitor_begin` has written a
        // state here, which fits in size and alignment.
        Ok(unsafe { &mut *self.memory.as_mut_ptr().cast() })
    }
}

impl From<Verdict> for TautlineVerdict {
    fn from(verdict: Verdict) -> Self {
        let said = Self { kind: TAUTLINE_VERDICT_KEPT, doubt: 0, robots: [0; 2], measured: 0, allowed: 0 };
        let unknown = |doubt, robot: usize| {
            let robot = u32::try_from(robot).unwrap_or(u32::MAX);
            Self { kind: TAUTLINE_VERDICT_UNKNOWN, doubt, robots: [robot, 0], ..said }
        };
        match verdict {
            Verdict::Kept => said,
            Verdict::Broken(Breach { robots, measured, allowed }) => {
                let robots = robots.map(|robot| robot as u32);
                Self { kind: TAUTLINE_VERDICT_BROKEN, robots, measured, allowed, ..said }
            }
            Verdict::Unknown(Doubt::Silent(robot)) => unknown(TAUTLINE_DOUBT_SILENT, robot),
            Verdict::Unknown(Doubt::Late) => unknown(TAUTLINE_DOUBT_LATE, 0),
            Verdict::Unknown(Doubt::Ahead) => unknown(TAUTLINE_DOUBT_AHEAD, 0),
            Verdict::Unknown(Doubt::Nobody(robot)) => unknown(TAUTLINE_DOUBT_NOBODY, robot),
            Verdict::Unknown(Doubt::TooFar) => unknown(TAUTLINE_DOUBT_TOO_FAR, 0),
        }
    }
}

/// Makes a monitor in the caller's memory that has heard none of the `count` robots, whose memory is `robots` and stays
/// where it is. A position that is older than `gap_us` microseconds is no longer believed.
///
/// # Safety
/// `monitor` and `robots` are null, or memory of the caller that nobody else uses as long as the monitor is used, of
/// one monitor and of so many robots; `demand` is null or can be read.
// SAFETY: no other function of this name is linked.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tautline_monitor_begin(
    monitor: *mut TautlineMonitor,
    demand: *const TautlineDemand,
    gap_us: u64,
    robots: *mut TautlineRobot,
    count: usize,
) -> TautlineStatus {
    let begin = || {
        if monitor.is_null() || robots.is_null() {
            return Err(TautlineStatus::NullPointer);
        }
        // SAFETY: the caller's promise.
        let demand = unsafe { read(demand) }?.demand().ok_or(TautlineStatus::BadDemand)?;
        if count > isize::MAX as usize / size_of::<Robot>() {
            return Err(TautlineStatus::TooManyRobots);
        }
        let robots = robots.cast::<Robot>();
        for robot in 0..count {
            // SAFETY: the caller has memory of so many robots.
            let place = unsafe { robots.add(robot) };
            // SAFETY: a robot fits in size and alignment; the memory need not hold anything yet.
            unsafe { place.write(Robot::UNHEARD) };
        }
        // SAFETY: the caller's promise, for as long as the monitor is used; every robot is written.
        let robots = unsafe { slice::from_raw_parts_mut(robots, count) };
        let state = Monitor::new(demand, gap_us, robots).map_err(|error| match error {
            SetupError::Blind => TautlineStatus::BadDemand,
            SetupError::NoRobots => TautlineStatus::TooFewRobots,
        })?;
        // SAFETY: the caller's promise; the memory need not hold anything yet.
        let memory = unsafe { &raw mut (*monitor).memory };
        // SAFETY: a state fits in size and alignment.
        unsafe { memory.cast::<State>().write(state) };
        // SAFETY: the caller's promise.
        let mark = unsafe { &raw mut (*monitor).mark };
        // SAFETY: a number fits where it is declared.
        unsafe { mark.write(MARK) };
        Ok(TautlineStatus::Ok)
    };
    status(begin())
}

/// Takes the position of `robot`, from 0, stamped `at_us` microseconds, and writes to `verdict` what the monitor says
/// of the moment `now_us` by the same clock. A stamp further ahead of now than the gap is not believed.
///
/// # Safety
/// `monitor` and `verdict` are null, or memory of the caller that nobody else uses meanwhile.
// SAFETY: no other function of this name is linked.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tautline_monitor_hear(
    monitor: *mut TautlineMonitor,
    now_us: u64,
    robot: usize,
    at_us: u64,
    x_mm: i32,
    y_mm: i32,
    verdict: *mut TautlineVerdict,
) -> TautlineStatus {
    // SAFETY: the caller's promise.
    unsafe { said(monitor, verdict, |state| state.hear(now_us, robot, at_us, Place::new(x_mm, y_mm))) }
}

/// Writes to `verdict` what the monitor says of the moment `now_us`, if nobody was heard for a while.
///
/// # Safety
/// As of `tautline_monitor_hear`.
// SAFETY: no other function of this name is linked.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tautline_monitor_at(
    monitor: *mut TautlineMonitor,
    now_us: u64,
    verdict: *mut TautlineVerdict,
) -> TautlineStatus {
    // SAFETY: the caller's promise.
    unsafe { said(monitor, verdict, |state| state.at(now_us)) }
}

/// Asks a monitor, and writes its verdict.
///
/// # Safety
/// As of `tautline_monitor_hear`.
unsafe fn said(
    monitor: *mut TautlineMonitor,
    verdict: *mut TautlineVerdict,
    ask: impl FnOnce(&mut State) -> Verdict,
) -> TautlineStatus {
    let tell = || {
        // SAFETY: the caller's promise.
        let state = unsafe { write(monitor) }?.state()?;
        // SAFETY: the caller's promise.
        let told = unsafe { write(verdict) }?;
        *told = ask(state).into();
        Ok(TautlineStatus::Ok)
    };
    status(tell())
}
