//! States as bytes: as few as a search over states has to keep of each.

use std::collections::{BTreeMap, BTreeSet};

use tautline_kernel::ground::{Cell, Side};

/// Something that a state is made of, and its bytes.
#[diagnostic::on_unimplemented(note = "`compact! {{ {Self} {{ field, … }} }}` makes a type of your own so")]
pub trait Compact: Sized {
    /// Appends the bytes that tell it from every other value.
    fn write(&self, to: &mut Vec<u8>);

    /// Takes its bytes from the beginning of these. Of bytes that [`Self::write`] did not make, anything may come.
    fn read(from: &mut &[u8]) -> Self;

    /// Appends the bytes of several, one after the other.
    #[inline]
    fn write_all(all: &[Self], to: &mut Vec<u8>) {
        for value in all {
            value.write(to);
        }
    }

    /// Takes so many.
    #[inline]
    fn read_all(count: usize, from: &mut &[u8]) -> Vec<Self> {
        (0..count).map(|_| Self::read(from)).collect()
    }
}

impl Compact for u8 {
    #[inline]
    fn write(&self, to: &mut Vec<u8>) {
        to.push(*self);
    }

    #[inline]
    fn read(from: &mut &[u8]) -> Self {
        from.split_off_first().copied().unwrap_or(0)
    }

    #[inline]
    fn write_all(all: &[Self], to: &mut Vec<u8>) {
        to.extend_from_slice(all);
    }

    #[inline]
    fn read_all(count: usize, from: &mut &[u8]) -> Vec<Self> {
        from.split_off(..count).unwrap_or(&[]).to_vec()
    }
}

macro_rules! number {
    ($($number:ty),*) => {$(
        impl Compact for $number {
            #[inline]
            fn write(&self, to: &mut Vec<u8>) {
                to.extend_from_slice(&self.to_le_bytes());
            }

            #[inline]
            fn read(from: &mut &[u8]) -> Self {
                from.split_off(..size_of::<Self>())
                    .and_then(|bytes| bytes.try_into().ok())
                    .map_or(0, Self::from_le_bytes)
            }
        }
    )*};
}

number!(u16, u32, u64, u128, i8, i16, i32, i64, i128);

/// In seven bits a byte, the lowest first: most are small.
impl Compact for usize {
    #[inline]
    fn write(&self, to: &mut Vec<u8>) {
        let mut left = *self;
        while left > 0x7f {
            to.push(left as u8 | 0x80);
            left >>= 7;
        }
        to.push(left as u8);
    }

    #[inline]
    fn read(from: &mut &[u8]) -> Self {
        let (mut number, mut shift) = (0, 0);
        loop {
            let byte = u8::read(from);
            number |= Self::from(byte & 0x7f) << shift;
            shift += 7;
            if byte < 0x80 || shift >= Self::BITS {
                return number;
            }
        }
    }
}

/// As the `usize` that has the sign as its lowest bit: numbers near 0 are short.
impl Compact for isize {
    #[inline]
    fn write(&self, to: &mut Vec<u8>) {
        let sign = *self >> (Self::BITS - 1);
        (self << 1 ^ sign).cast_unsigned().write(to);
    }

    #[inline]
    fn read(from: &mut &[u8]) -> Self {
        let bits = usize::read(from);
        (bits >> 1).cast_signed() ^ -((bits & 1).cast_signed())
    }
}

/// As its number.
impl Compact for char {
    #[inline]
    fn write(&self, to: &mut Vec<u8>) {
        (u32::from(*self) as usize).write(to);
    }

    #[inline]
    fn read(from: &mut &[u8]) -> Self {
        u32::try_from(usize::read(from)).ok().and_then(Self::from_u32).unwrap_or_default()
    }
}

impl Compact for bool {
    fn write(&self, to: &mut Vec<u8>) {
        to.push((*self).into());
    }

    fn read(from: &mut &[u8]) -> Self {
        u8::read(from) != 0
    }
}

impl<T: Compact> Compact for Option<T> {
    fn write(&self, to: &mut Vec<u8>) {
        self.is_some().write(to);
        if let Some(value) = self {
            value.write(to);
        }
    }

    fn read(from: &mut &[u8]) -> Self {
        bool::read(from).then(|| T::read(from))
    }
}

impl<T: Compact> Compact for Vec<T> {
    #[inline]
    fn write(&self, to: &mut Vec<u8>) {
        self.len().write(to);
        T::write_all(self, to);
    }

    #[inline]
    fn read(from: &mut &[u8]) -> Self {
        T::read_all(usize::read(from), from)
    }
}

impl<T: Compact, const LENGTH: usize> Compact for [T; LENGTH] {
    #[inline]
    fn write(&self, to: &mut Vec<u8>) {
        T::write_all(self, to);
    }

    #[inline]
    fn read(from: &mut &[u8]) -> Self {
        [(); LENGTH].map(|()| T::read(from))
    }
}

impl Compact for String {
    fn write(&self, to: &mut Vec<u8>) {
        self.len().write(to);
        to.extend_from_slice(self.as_bytes());
    }

    fn read(from: &mut &[u8]) -> Self {
        Self::from_utf8_lossy(&Vec::read(from)).into_owned()
    }
}

/// In the order of its members, whatever order they came in.
impl<T: Compact + Ord> Compact for BTreeSet<T> {
    fn write(&self, to: &mut Vec<u8>) {
        self.len().write(to);
        for member in self {
            member.write(to);
        }
    }

    fn read(from: &mut &[u8]) -> Self {
        Vec::read(from).into_iter().collect()
    }
}

/// In the order of its keys, whatever order they came in.
impl<K: Compact + Ord, V: Compact> Compact for BTreeMap<K, V> {
    fn write(&self, to: &mut Vec<u8>) {
        self.len().write(to);
        for (key, value) in self {
            key.write(to);
            value.write(to);
        }
    }

    fn read(from: &mut &[u8]) -> Self {
        Vec::read(from).into_iter().collect()
    }
}

macro_rules! tuple {
    ($($part:ident)*) => {
        impl<$($part: Compact),*> Compact for ($($part,)*) {
            #[inline]
            #[expect(non_snake_case, reason = "a part has the name of its type")]
            fn write(&self, to: &mut Vec<u8>) {
                let ($($part,)*) = self;
                $($part.write(to);)*
            }

            #[inline]
            fn read(from: &mut &[u8]) -> Self {
                ($($part::read(from),)*)
            }
        }
    };
}

tuple!(A);
tuple!(A B);
tuple!(A B C);
tuple!(A B C D);
tuple!(A B C D E);
tuple!(A B C D E F);

/// Makes a struct or an enum [`Compact`]: of a type that stands already, it names the parts, and makes an enum besides
/// where it begins so. A variant is one byte, before its fields.
///
/// ```
/// use tautline_proofs::compact;
///
/// struct Node {
///     phase: Phase,
///     clock: u8,
/// }
/// compact! { Node { phase, clock } }
///
/// struct Lift(u8, bool);
/// compact! { Lift(floor, is_open) }
///
/// enum Door {
///     Shut,
///     Opens(u8),
/// }
/// compact! { Door: Shut, Opens(since) }
///
/// compact! { enum Phase { Idle, Wants, Done } }
/// compact! { enum State { Idle, Waits(u8), Serves { robot: u8 } } }
/// ```
///
/// All parts are to be named:
///
/// ```compile_fail,E0004
/// enum Phase {
///     Idle,
///     Wants,
///     Done,
/// }
/// tautline_proofs::compact! { Phase: Idle, Wants }
/// ```
///
/// An enum that it makes is `Clone`, `Eq`, `Ord`, `Hash` and `Debug`; one without fields is `Copy`, too. Its variants
/// have at most three fields without a name.
#[macro_export]
macro_rules! compact {
    ($(#[$about:meta])* $vis:vis enum $name:ident { $($variant:ident),* $(,)? }) => {
        $(#[$about])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        #[allow(missing_docs, reason = "what it is made for says what its words mean")]
        $vis enum $name { $($variant),* }

        $crate::compact! { $name: $($variant),* }
    };
    ($(#[$about:meta])* $vis:vis enum $name:ident { $(
        $variant:ident
        $(($one:ty $(, $two:ty $(, $three:ty)?)? $(,)?))?
        $({ $($field:ident: $part:ty),* $(,)? })?
    ),* $(,)? }) => {
        $(#[$about])*
        #[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        #[allow(missing_docs, reason = "what it is made for says what its words mean")]
        $vis enum $name { $($variant $(($one $(, $two $(, $three)?)?))? $({ $($field: $part),* })?),* }

        $crate::compact! { $name: $(
            $variant $((one: $one $(, two: $two $(, three: $three)?)?))? $({ $($field),* })?
        ),* }
    };
    ($name:ident: $(
        $variant:ident
        $(($($place:ident $(: $type:ty)?),* $(,)?))?
        $({ $($field:ident),* $(,)? })?
    ),* $(,)?) => {
        const _: () = {
            #[derive(Clone, Copy)]
            #[repr(u8)]
            enum __Number { $($variant),* }

            impl $crate::protocol::Compact for $name {
                fn write(&self, to: &mut Vec<u8>) {
                    match self {$(
                        Self::$variant $(($($place),*))? $({ $($field),* })? => {
                            to.push(__Number::$variant as u8);
                            $($($crate::protocol::Compact::write($place, to);)*)?
                            $($($crate::protocol::Compact::write($field, to);)*)?
                        }
                    )*}
                }

                fn read(from: &mut &[u8]) -> Self {
                    let number: u8 = $crate::protocol::Compact::read(from);
                    match [$(__Number::$variant),*][usize::from(number)] {$(
                        __Number::$variant => {
                            $($(let $place = $crate::protocol::Compact::read(from);)*)?
                            Self::$variant $(($($place),*))? $({ $($field: $crate::protocol::Compact::read(from)),* })?
                        }
                    )*}
                }
            }
        };
    };
    ($name:ident { $($field:ident),* $(,)? }) => {
        impl $crate::protocol::Compact for $name {
            fn write(&self, to: &mut Vec<u8>) {
                $($crate::protocol::Compact::write(&self.$field, to);)*
            }

            fn read(from: &mut &[u8]) -> Self {
                Self { $($field: $crate::protocol::Compact::read(from)),* }
            }
        }
    };
    ($name:ident($($place:ident),* $(,)?)) => {
        impl $crate::protocol::Compact for $name {
            fn write(&self, to: &mut Vec<u8>) {
                let Self($($place),*) = self;
                $($crate::protocol::Compact::write($place, to);)*
            }

            fn read(from: &mut &[u8]) -> Self {
                $(let $place = $crate::protocol::Compact::read(from);)*
                Self($($place),*)
            }
        }
    };
}

compact! { Cell { x, y } }
compact! { Side: East, South, West, North }

#[cfg(test)]
mod tests {
    use super::*;
    use crate::protocol::Mail;

    compact! { enum Light { Off, On, } }

    #[derive(PartialEq, Eq, Debug)]
    struct Lamp {
        light: Light,
        hours: i16,
    }
    compact! { Lamp { light, hours, } }

    #[derive(PartialEq, Eq, Debug)]
    struct Lift(u8, bool);
    compact! { Lift(floor, is_open) }

    compact! { enum State { Idle, Waits(u8), Serves { robot: u8, at: Cell }, Meets(u8, Light) } }

    #[derive(PartialEq, Eq, Debug)]
    enum Door {
        Shut,
        Opens(u16, u8),
        Open { by: String },
    }
    compact! {
        Door:
            Shut,
            Opens(since, to),
            Open { by },
    }

    #[derive(PartialEq, Eq, Debug)]
    enum Gate {
        Left,
        Right,
    }
    compact! { Gate: Right, Left }

    #[test]
    fn a_value_comes_back_from_its_bytes() {
        fn comes_back<T: Compact + PartialEq + std::fmt::Debug>(value: T, length: usize) {
            let mut bytes = Vec::new();
            value.write(&mut bytes);
            let mut left = &bytes[..];
            assert_eq!((T::read(&mut left), left, bytes.len()), (value, &[][..], length));
        }
        comes_back((0x1234_u16, -3_i8, true), 4);
        comes_back((127_usize, 128_usize, usize::MAX), 13);
        comes_back((0_isize, -1_isize, 63_isize, -64_isize, 64_isize), 1 + 1 + 1 + 1 + 2);
        comes_back((isize::MIN, isize::MAX), 20);
        comes_back(('a', '\u{e9}', char::MAX, '\0'), 1 + 2 + 3 + 1);
        comes_back((None::<u8>, Some([1_u32, 2]), 7_u64, [Some(false); 3]), 24);
        comes_back(vec![(vec![1_u8, 2], 3_u128), (vec![], 4)], 1 + 3 + 16 + 1 + 16);
        comes_back(Lamp { light: Light::On, hours: -700 }, 3);
        comes_back((Light::Off, 1_u8, 2_u8, 3_u8, 4_u8, 5_u8), 6);
        let mut mail = Mail::new(2);
        mail.send((0, 1, 9_u8));
        comes_back((mail, 0_i32), 1 + 3 + 4 + 4);
        comes_back((Cell::new(-1, 2), Side::North), 5);
        comes_back((BTreeSet::from([3_u8, 1]), (BTreeMap::from([(2_u8, true), (1, false)]),)), 3 + 5);
        comes_back((Lift(7, true), String::from("dock")), 2 + 5);
        comes_back([State::Idle, State::Waits(7), State::Meets(2, Light::On)], 1 + 2 + 3);
        comes_back((Gate::Left, Gate::Right), 2);
        comes_back(State::Serves { robot: 3, at: Cell::new(0, 300) }, 6);
        comes_back((Door::Shut, Door::Opens(300, 1), Door::Open { by: "me".to_owned() }), 1 + 4 + 4);
    }
}
