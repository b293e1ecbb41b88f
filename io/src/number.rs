//! Numbers in lines for people. One that nobody would write out, as 1e-320 with its 320 zeros, stands with an exponent;
//! every other one stands as ever. A command line takes both forms.

use std::fmt::{self, Display, LowerExp};

/// A number with more signs has an exponent. One of 17 digits, a sign and four zeros behind its point has these.
const MOST_SIGNS: usize = 24;

/// A number as a line for people has it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Number(pub f64);

impl Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(number) = self;
        let is_long = f.precision().is_none() && number.to_string().len() > MOST_SIGNS;
        if is_long { LowerExp::fmt(number, f) } else { Display::fmt(number, f) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_use_stand_as_ever_and_others_have_an_exponent() {
        for number in [0.0, -0.0, 1.0, 0.1 + 0.2, 25.0, 1e-3, 2.0_f64.powi(53), 1e6, -0.05, f64::INFINITY] {
            assert_eq!(Number(number).to_string(), number.to_string());
        }
        assert_eq!(Number(f64::NAN).to_string(), "NaN");
        let written = [1e-320, -1e-320, 2.5e300, f64::MAX, 1.234_567_890_123_456e-9];
        let written = written.map(|number| {
            let text = Number(number).to_string();
            assert_eq!(text.parse(), Ok(number), "it reads back");
            text
        });
        assert_eq!(
            written,
            ["1e-320", "-1e-320", "2.5e300", "1.7976931348623157e308", "1.234567890123456e-9"]
        );
        assert_eq!(format!("{:>9}|{:.2}", Number(1e-320), Number(1e-320)), "   1e-320|0.00");
    }
}
