//! A whole exploration allocates nothing. The one allocator of a program is counted, so this test has a program for
//! itself.

use std::alloc::{GlobalAlloc, Layout, System};
use std::ffi::c_void;
use std::mem::MaybeUninit;
use std::ptr;
use std::sync::atomic::{AtomicU64, Ordering};

use tautline_capi::{
    TAUTLINE_RULE_REPAIRED, TAUTLINE_STEP_STAY, TautlineCell, TautlineChain, TautlinePlan, TautlineStatus,
    tautline_chain_begin, tautline_chain_hear, tautline_chain_plan, tautline_chain_settle,
};

struct CountingAllocator;

static ALLOCATIONS: AtomicU64 = AtomicU64::new(0);

// SAFETY: everything is left to the system's allocator.
unsafe impl GlobalAlloc for CountingAllocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller's promise.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

unsafe extern "C" fn open(_: *mut c_void, _: TautlineCell, _: TautlineCell) -> i32 {
    1
}

/// A chain of 8 robots in the middle of 15×15 cells, in memory that held nothing.
fn begun(memory: &mut MaybeUninit<TautlineChain>) -> *mut TautlineChain {
    let chain = memory.as_mut_ptr();
    let (first, last) = (TautlineCell { x: 0, y: 0 }, TautlineCell { x: 14, y: 14 });
    let base = TautlineCell { x: 7, y: 7 };
    // SAFETY: the memory is large enough, and of this function alone.
    let status = unsafe { tautline_chain_begin(chain, TAUTLINE_RULE_REPAIRED, 8, first, last, base) };
    assert_eq!(status, TautlineStatus::Ok);
    chain
}

/// A team plans and moves; another one plans along and hears it.
#[test]
fn a_whole_exploration_allocates_nothing() {
    let mut log = [0_u8; 7 * 62];
    let (mut one, mut other) = (MaybeUninit::uninit(), MaybeUninit::uninit());
    let (team, listener) = (begun(&mut one), begun(&mut other));
    let (mut bytes, mut sent) = (0, 0);
    let mut plan = TautlinePlan { kind: 0, robots: 0, steps: [TAUTLINE_STEP_STAY; 16] };
    let mut heard = plan;
    let before = ALLOCATIONS.load(Ordering::Relaxed);
    let end = loop {
        // SAFETY: all memory is of this function.
        let status = unsafe { tautline_chain_plan(team, log.as_ptr(), bytes, &raw mut plan) };
        // SAFETY: all memory is of this function.
        let along = unsafe { tautline_chain_plan(listener, log.as_ptr(), bytes, &raw mut heard) };
        assert_eq!((status, plan), (along, heard));
        if status != TautlineStatus::Ok {
            break status;
        }
        let room = &mut log[bytes..];
        // SAFETY: all memory is of this function.
        let status = unsafe {
            tautline_chain_settle(
                team,
                Some(open),
                ptr::null_mut(),
                room.as_mut_ptr(),
                room.len(),
                &raw mut sent,
            )
        };
        assert_eq!(status, TautlineStatus::Ok);
        // SAFETY: all memory is of this function.
        let refused = unsafe { tautline_chain_hear(listener, room.as_ptr(), sent - 1) };
        assert_eq!(refused, TautlineStatus::DamagedLength);
        // SAFETY: all memory is of this function.
        let heard = unsafe { tautline_chain_hear(listener, room.as_ptr(), sent) };
        assert_eq!(heard, TautlineStatus::Ok);
        bytes += sent;
    };
    assert_eq!(ALLOCATIONS.load(Ordering::Relaxed), before);
    assert_eq!((end, bytes), (TautlineStatus::Explored, log.len()));
}
