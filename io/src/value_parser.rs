//! Values as a person writes them, on a command line for example. What is wrong with one is said as what to write
//! instead.

use std::fmt::Display;
use std::num::{IntErrorKind, ParseIntError};
use std::ops::RangeInclusive;
use std::str::FromStr;

/// A whole number, as large as its type holds.
///
/// # Errors
/// The words for what to write.
pub fn number<T: FromStr>(text: &str) -> Result<T, String> {
    let largest = u128::MAX >> (128 - 8 * size_of::<T>());
    text.parse().map_err(|_| format!("write a whole number from 0 to {largest}"))
}

/// A whole number of which something else says how large it may be.
///
/// # Errors
/// The words for what to write.
pub fn whole<T: FromStr<Err = ParseIntError>>(text: &str) -> Result<T, &'static str> {
    text.parse().map_err(|error: ParseIntError| match error.kind() {
        IntErrorKind::PosOverflow => "write a smaller number",
        _ if text.starts_with('-') => "write a whole number, from 0 on",
        _ => "write a whole number",
    })
}

/// A whole number of `range`.
///
/// # Errors
/// The words for what to write.
pub fn within<N, T>(text: &str, range: &RangeInclusive<N>) -> Result<T, String>
where
    N: FromStr<Err = ParseIntError> + PartialOrd + Copy + Display,
    T: TryFrom<N>,
{
    let fitting = text.parse().ok().filter(|number: &N| range.contains(number));
    let outside = || format!("write a whole number from {} to {}", range.start(), range.end());
    fitting.and_then(|number| number.try_into().ok()).ok_or_else(outside)
}

/// A number that need not be whole.
///
/// # Errors
/// The words for what to write.
pub fn real(text: &str) -> Result<f64, &'static str> {
    text.parse().map_err(|_| "write a number")
}

/// Metres, with commas between them.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Metres<const COUNT: usize>(pub [f64; COUNT]);

impl<const COUNT: usize> FromStr for Metres<COUNT> {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
        let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
        numbers.map(Self).ok_or_else(|| {
            let example: Vec<String> = (1..=COUNT).map(|place| (place * 50).to_string()).collect();
            format!("write {COUNT} numbers of metres, for example {}", example.join(","))
        })
    }
}

/// Metres that are all within so many of 0.
///
/// # Errors
/// The words for what to write.
pub fn metres_within<const COUNT: usize>(text: &str, most: f64) -> Result<Metres<COUNT>, String> {
    let metres: Metres<COUNT> = text.parse()?;
    let are_near = metres.0.iter().all(|along| along.abs() <= most);
    are_near.then_some(metres).ok_or_else(|| format!("write metres from -{most} to {most}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_outside_its_range_is_told_the_range() {
        let read = |text| within::<i64, u32>(text, &(1..=6));
        assert_eq!([read("1"), read("6")], [Ok(1), Ok(6)]);
        for wrong in ["0", "7", "-1", "six"] {
            assert_eq!(read(wrong), Err("write a whole number from 1 to 6".to_owned()));
        }
    }

    #[test]
    fn metres_are_as_many_as_are_wanted() {
        assert_eq!("1, 2.5".parse(), Ok(Metres([1.0, 2.5])));
        assert_eq!(metres_within("-9,9", 9.0), Ok(Metres([-9.0, 9.0])));
        for wrong in ["NaN,0", "0,inf", "0,9.1"] {
            assert_eq!(
                metres_within::<2>(wrong, 9.0),
                Err("write metres from -9 to 9".to_owned()),
                "{wrong}"
            );
        }
        let wrong: Result<Metres<2>, String> = "1,2,3".parse();
        assert_eq!(wrong, Err("write 2 numbers of metres, for example 50,100".to_owned()));
    }
}
