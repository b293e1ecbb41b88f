//! The functions that a browser calls. Texts pass through a buffer, four bytes at a time, so that nobody handles a
//! pointer: a page says how long its request is, puts it, calls, and gets the answer.

#![allow(
    unsafe_code,
    reason = "a browser finds a function by its name, and a name that is kept is called unsafe"
)]

use std::cell::RefCell;

use crate::Page;

/// The page, and the words of what passes.
#[derive(Default)]
struct Door {
    page: Page,
    buffer: Vec<u8>,
}

thread_local! {
    static DOOR: RefCell<Door> = RefCell::default();
}

/// Makes room for a request of so many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn page_room(bytes: u32) {
    DOOR.with_borrow_mut(|door| {
        door.buffer.clear();
        door.buffer.resize((bytes as usize).next_multiple_of(4), b' ');
    });
}

/// Puts four bytes of the request, the first in the lowest bits.
#[unsafe(no_mangle)]
pub extern "C" fn page_put(place: u32, word: u32) {
    DOOR.with_borrow_mut(|door| {
        if let Some((four, _)) =
            door.buffer.get_mut(4 * place as usize..).and_then(<[u8]>::split_first_chunk_mut)
        {
            *four = word.to_le_bytes();
        }
    });
}

/// Answers the request that was put. Returns the bytes of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn page_call() -> u32 {
    DOOR.with_borrow_mut(|door| {
        let Door { page, buffer } = door;
        let mut answer = page.answer(&String::from_utf8_lossy(buffer)).into_bytes();
        let bytes = answer.len();
        answer.resize(bytes.next_multiple_of(4), b' ');
        *buffer = answer;
        bytes as u32
    })
}

/// Four bytes of the answer, the first in the lowest bits.
#[unsafe(no_mangle)]
pub extern "C" fn page_get(place: u32) -> u32 {
    DOOR.with_borrow(|door| {
        let four = door.buffer.get(4 * place as usize..).and_then(<[u8]>::first_chunk);
        four.map_or(0, |four| u32::from_le_bytes(*four))
    })
}
