//! Values in CDR, the encoding of ROS 2 on the wire: little-endian, each number at a multiple of its own size, counted
//! from behind a head of four bytes.

/// CDR, little-endian, without options.
const HEAD: [u8; 4] = [0, 1, 0, 0];

/// A message in the making.
#[derive(Clone, Debug)]
pub(crate) struct Cdr(Vec<u8>);

impl Cdr {
    /// No value yet.
    pub(crate) fn new() -> Self {
        Self(HEAD.to_vec())
    }

    /// The whole message.
    pub(crate) fn into_bytes(self) -> Vec<u8> {
        self.0
    }

    fn aligned(&mut self, bytes: &[u8]) {
        let past = (self.0.len() - HEAD.len()) % bytes.len();
        if past > 0 {
            self.0.resize(self.0.len() + bytes.len() - past, 0);
        }
        self.0.extend_from_slice(bytes);
    }

    /// One or zero, in a byte.
    pub(crate) fn bool(&mut self, value: bool) {
        self.0.push(value.into());
    }

    /// A whole number of 32 bits that may be negative.
    pub(crate) fn i32(&mut self, value: i32) {
        self.aligned(&value.to_le_bytes());
    }

    /// A whole number of 32 bits.
    pub(crate) fn u32(&mut self, value: u32) {
        self.aligned(&value.to_le_bytes());
    }

    /// A number of single precision.
    pub(crate) fn f32(&mut self, value: f32) {
        self.aligned(&value.to_le_bytes());
    }

    /// Numbers of double precision.
    pub(crate) fn f64s<const N: usize>(&mut self, values: [f64; N]) {
        for value in values {
            self.aligned(&value.to_le_bytes());
        }
    }

    /// How many elements follow.
    pub(crate) fn length(&mut self, count: usize) {
        self.u32(count as u32);
    }

    /// A text: its length with the zero at its end, and both.
    pub(crate) fn string(&mut self, text: &str) {
        self.length(text.len() + 1);
        self.0.extend_from_slice(text.as_bytes());
        self.0.push(0);
    }

    /// A list of bytes.
    pub(crate) fn bytes(&mut self, bytes: impl ExactSizeIterator<Item = i8>) {
        self.length(bytes.len());
        self.0.extend(bytes.map(i8::cast_unsigned));
    }

    /// A list, each element written by `write`.
    pub(crate) fn list<T>(&mut self, items: &[T], mut write: impl FnMut(&mut Self, &T)) {
        self.length(items.len());
        for item in items {
            write(self, item);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_at_multiples_of_their_size_behind_the_head() {
        let mut cdr = Cdr::new();
        cdr.bool(true);
        cdr.u32(2);
        cdr.string("ab");
        cdr.f64s([1.0]);
        let expected = [
            &[0, 1, 0, 0][..],
            &[1, 0, 0, 0],
            &[2, 0, 0, 0],
            &[3, 0, 0, 0, b'a', b'b', 0, 0],
            &[0, 0, 0, 0, 0, 0, 0xf0, 0x3f],
        ];
        assert_eq!(cdr.into_bytes(), expected.concat());
    }
}
