//! Memory behind a caller's pointers, as slices and references.

use core::slice;

use crate::status::TautlineStatus;

/// The value behind a caller's pointer.
///
/// # Safety
/// The pointer is null, or valid for reads as long as the result is used.
pub(crate) unsafe fn read<'a, T>(pointer: *const T) -> Result<&'a T, TautlineStatus> {
    // SAFETY: the caller's promise.
    unsafe { pointer.as_ref() }.ok_or(TautlineStatus::NullPointer)
}

/// The value behind a caller's pointer, to be changed.
///
/// # Safety
/// The pointer is null, or valid for reads and writes, and nobody else uses it as long as the result is used.
pub(crate) unsafe fn write<'a, T>(pointer: *mut T) -> Result<&'a mut T, TautlineStatus> {
    // SAFETY: the caller's promise.
    unsafe { pointer.as_mut() }.ok_or(TautlineStatus::NullPointer)
}

/// A caller's bytes; none if there are 0, wherever the pointer leads.
///
/// # Safety
/// The pointer is null, or valid for reads of so many bytes as long as the result is used.
pub(crate) unsafe fn bytes<'a>(pointer: *const u8, length: usize) -> Result<&'a [u8], TautlineStatus> {
    if length == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() || isize::try_from(length).is_err() {
        return Err(TautlineStatus::NullPointer);
    }
    // SAFETY: the caller's promise; the pointer is not null.
    Ok(unsafe { slice::from_raw_parts(pointer, length) })
}

/// Writes `values` into a caller's array that has room for so many, and their number.
///
/// # Safety
/// The pointers are null, or valid for writes: of so many values, and of one number.
pub(crate) unsafe fn give<T: Copy>(
    values: &[T],
    pointer: *mut T,
    capacity: usize,
    count: *mut usize,
) -> Result<(), TautlineStatus> {
    if pointer.is_null() || count.is_null() {
        return Err(TautlineStatus::NullPointer);
    }
    if capacity < values.len() {
        return Err(TautlineStatus::TooSmall);
    }
    // SAFETY: there is room for the values, and what a caller gives does not overlap with a chain.
    unsafe { pointer.copy_from_nonoverlapping(values.as_ptr(), values.len()) };
    // SAFETY: the pointer is not null.
    unsafe { count.write(values.len()) };
    Ok(())
}

/// The status of a call.
pub(crate) fn status(done: Result<TautlineStatus, TautlineStatus>) -> TautlineStatus {
    done.unwrap_or_else(|refused| refused)
}
