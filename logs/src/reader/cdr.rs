//! Values in CDR, the encoding of ROS 2 on the wire: each number at a multiple of its own size, counted from behind a
//! head of four bytes, which says their order.

/// A message that is being read. Whatever is not there is `None`.
pub(super) struct Cdr<'a> {
    rest: &'a [u8],
    at: usize,
    is_big: bool,
}

impl<'a> Cdr<'a> {
    /// A message, behind its head.
    pub(super) fn new(bytes: &'a [u8]) -> Option<Self> {
        match bytes {
            [0, order @ (0 | 1), _, _, rest @ ..] => Some(Self { rest, at: 0, is_big: *order == 0 }),
            _ => None,
        }
    }

    fn bytes(&mut self, count: usize) -> Option<&'a [u8]> {
        let bytes = self.rest.get(self.at..self.at.checked_add(count)?)?;
        self.at += count;
        Some(bytes)
    }

    fn number<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.at = self.at.next_multiple_of(N);
        let mut bytes: [u8; N] = self.bytes(N)?.try_into().ok()?;
        if self.is_big {
            bytes.reverse();
        }
        Some(bytes)
    }

    pub(super) fn u32(&mut self) -> Option<u32> {
        self.number().map(u32::from_le_bytes)
    }

    pub(super) fn f64(&mut self) -> Option<f64> {
        self.number().map(f64::from_le_bytes)
    }

    /// A text, without the zero at its end.
    pub(super) fn text(&mut self) -> Option<&'a str> {
        let count = self.u32()? as usize;
        let bytes = self.bytes(count)?;
        std::str::from_utf8(bytes.strip_suffix(&[0]).unwrap_or(bytes)).ok()
    }

    /// Seconds and nanoseconds.
    pub(super) fn stamp(&mut self) -> Option<(i32, u32)> {
        Some((self.u32()?.cast_signed(), self.u32()?))
    }

    /// Two numbers of the so many that follow.
    pub(super) fn first_two_of(&mut self, count: usize) -> Option<[f64; 2]> {
        let two = [self.f64()?, self.f64()?];
        (2..count).try_for_each(|_| self.f64().map(drop))?;
        Some(two)
    }
}
