//! Tables that a search keeps its states in: things in the order in which they came, and numbers by hashes.

use super::code::HashOfState;

/// Things in the order in which they came, in pieces, so that none is ever moved.
pub(super) struct Pile<T> {
    pieces: Vec<Vec<T>>,
    length: usize,
}

/// Entries of a piece.
const PIECE: usize = 1 << 16;

impl<T> Pile<T> {
    pub(super) const fn new() -> Self {
        Self { pieces: Vec::new(), length: 0 }
    }

    pub(super) const fn len(&self) -> usize {
        self.length
    }

    /// The bytes that it takes.
    pub(super) fn bytes(&self) -> u64 {
        let full = self.pieces.len().saturating_sub(1) * PIECE;
        ((full + self.pieces.last().map_or(0, Vec::capacity)) * size_of::<T>()) as u64
    }

    pub(super) fn push(&mut self, entry: T) {
        if self.length.is_multiple_of(PIECE) {
            self.pieces.push(Vec::new());
        }
        if let Some(piece) = self.pieces.last_mut() {
            piece.push(entry);
            self.length += 1;
        }
    }
}

impl<T: Copy> Pile<T> {
    pub(super) fn at(&self, place: usize) -> T {
        self.pieces[place / PIECE][place % PIECE]
    }
}

/// Strings of bytes in the order in which they came, in pieces.
#[derive(Default)]
pub(super) struct Codes {
    pieces: Vec<Piece>,
    pub(super) length: usize,
    /// Bytes of all pieces but the last one.
    full: usize,
}

#[derive(Default)]
struct Piece {
    bytes: Vec<u8>,
    /// The length of all its strings, while it is the same.
    width: usize,
    /// Else where each string ends.
    ends: Vec<u32>,
}

impl Piece {
    const fn size(&self) -> usize {
        self.bytes.capacity() + self.ends.capacity() * size_of::<u32>()
    }
}

impl Codes {
    /// The bytes that they take.
    pub(super) fn bytes(&self) -> u64 {
        (self.full + self.pieces.last().map_or(0, Piece::size)) as u64
    }

    pub(super) fn push(&mut self, code: &[u8]) {
        let place = self.length % PIECE;
        if place == 0 {
            self.full += self.pieces.last().map_or(0, Piece::size);
            self.pieces.push(Piece { width: code.len(), ..Piece::default() });
        }
        let Some(piece) = self.pieces.last_mut() else { return };
        if piece.ends.is_empty() && code.len() != piece.width {
            piece.ends = (1..=place).map(|before| (before * piece.width) as u32).collect();
        }
        piece.bytes.extend_from_slice(code);
        if !piece.ends.is_empty() || code.len() != piece.width {
            piece.ends.push(piece.bytes.len() as u32);
        }
        self.length += 1;
    }

    pub(super) fn entry(&self, place: usize) -> &[u8] {
        let (piece, place) = (&self.pieces[place / PIECE], place % PIECE);
        if piece.ends.is_empty() {
            return &piece.bytes[place * piece.width..(place + 1) * piece.width];
        }
        let first = place.checked_sub(1).map_or(0, |before| piece.ends[before]);
        &piece.bytes[first as usize..piece.ends[place] as usize]
    }
}

/// Nodes by their hashes, each in the first slot that was free from the one on that its hash asks for. A slot has the
/// hash of its node, too, so that the table grows without a look at the codes, and most looks that fail end here.
#[derive(Default)]
pub(super) struct Slots {
    slots: Vec<u64>,
    length: usize,
}

/// A slot without a node.
const FREE: u64 = u64::MAX;

impl Slots {
    /// The bytes that they take, and will have taken once the next one is there.
    pub(super) fn bytes_with_the_next(&self) -> u64 {
        let grown = if self.is_full() { self.grown() } else { 0 };
        (self.bytes() + grown * size_of::<u64>()) as u64
    }

    pub(super) const fn bytes(&self) -> usize {
        self.slots.len() * size_of::<u64>()
    }

    const fn is_full(&self) -> bool {
        self.length >= self.slots.len() / 4 * 3
    }

    const fn grown(&self) -> usize {
        self.slots.len() / 8 * 12 + 64
    }

    /// Those that are taken, in the order of their hashes: a hash, and its node.
    pub(super) fn into_sorted(mut self) -> Vec<u64> {
        self.slots.retain(|&slot| slot != FREE);
        self.slots.sort_unstable();
        self.slots
    }

    /// The slot that a hash asks for. Larger hashes ask for later ones.
    const fn place(&self, hash: HashOfState) -> usize {
        ((hash as u64 * self.slots.len() as u64) >> HashOfState::BITS) as usize
    }

    /// The content of the slot that a hash asks for.
    #[inline]
    pub(super) fn slot(&self, hash: HashOfState) -> u64 {
        self.slots.get(self.place(hash)).copied().unwrap_or(FREE)
    }

    /// The first node with this hash.
    pub(super) fn first(&self, hash: HashOfState) -> Option<u32> {
        self.find(hash, |_| true)
    }

    /// The first node with this hash that `is_it`.
    #[inline]
    pub(super) fn find(&self, hash: HashOfState, mut is_it: impl FnMut(u32) -> bool) -> Option<u32> {
        let mut place = self.place(hash);
        while let Some(&slot) = self.slots.get(place).filter(|&&slot| slot != FREE) {
            if (slot >> u32::BITS) as HashOfState == hash && is_it(slot as u32) {
                return Some(slot as u32);
            }
            place = if place + 1 == self.slots.len() { 0 } else { place + 1 };
        }
        None
    }

    /// Adds a node that is not there.
    pub(super) fn insert(&mut self, hash: HashOfState, node: u32) {
        if self.is_full() {
            let grown = vec![FREE; self.grown()];
            let before = std::mem::replace(&mut self.slots, grown);
            before.into_iter().filter(|&slot| slot != FREE).for_each(|slot| self.put(slot));
        }
        self.put(u64::from(hash) << u32::BITS | u64::from(node));
        self.length += 1;
    }

    fn put(&mut self, slot: u64) {
        let mut place = self.place((slot >> u32::BITS) as HashOfState);
        while self.slots[place] != FREE {
            place += 1;
            if place == self.slots.len() {
                place = 0;
            }
        }
        self.slots[place] = slot;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_those_of_full_pieces_and_of_the_last_one() {
        let mut pile = Pile::new();
        (0..=PIECE as u32).for_each(|entry| pile.push([entry, !entry]));
        assert_eq!((pile.len(), pile.at(PIECE)), (PIECE + 1, [PIECE as u32, !(PIECE as u32)]));
        let full = (PIECE * 2 * size_of::<u32>()) as u64;
        assert!((full + 8..full + 64).contains(&pile.bytes()), "{}", pile.bytes());
    }

    /// In the second piece, the first three are as long as each other, and the rest are not.
    #[test]
    fn codes_of_any_length_come_back() {
        let code = |place: usize| {
            let length = if place < PIECE + 3 { 3 } else { place % 5 };
            place.to_le_bytes()[..length].to_vec()
        };
        let mut codes = Codes::default();
        (0..2 * PIECE + 9).for_each(|place| codes.push(&code(place)));
        assert!((0..codes.length).all(|place| codes.entry(place) == code(place)));
        let (first, second) = (3 * PIECE, 2 * PIECE + 4 * PIECE);
        assert!((first + second..2 * (first + second)).contains(&(codes.bytes() as usize)));
    }
}
