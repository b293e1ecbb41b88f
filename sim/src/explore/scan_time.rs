//! How long an agent takes [Ferranti 2009, V.A]: the means that the paper measured, in whole milliseconds. The camera
//! with which an agent finds sensors (section IV) is not modelled.
//!
//! Our reading: each sensor takes up one turn of a scan, in which it is detected, identified and localized; in the
//! other turns the agent just moves on. A sensor that is missed costs what an empty turn costs.

/// Turns of a scan, in hundredths: 18.28.
const TURNS_HUNDREDTHS: u32 = 1_828;
/// A turn in which a sensor is detected: 9.55 s.
const TURN_WITH_SENSOR_MILLISECONDS: u32 = 9_550;
/// A turn in which none is: 1.81 s.
const TURN_WITHOUT_SENSOR_MILLISECONDS: u32 = 1_810;
/// The way to the next cell: 55.42 s.
pub(super) const TRAVEL_MILLISECONDS: u32 = 55_420;

/// A scan in which that many sensors are detected, rounded to the nearest millisecond. More than 18 take a turn each,
/// and there are no others.
pub(super) const fn scan_milliseconds(sensors: u8) -> u32 {
    let sensors = sensors as u32;
    let empty_hundredths = TURNS_HUNDREDTHS.saturating_sub(100 * sensors);
    sensors * TURN_WITH_SENSOR_MILLISECONDS + (empty_hundredths * TURN_WITHOUT_SENSOR_MILLISECONDS + 50) / 100
}

#[cfg(test)]
mod tests {
    use super::{TRAVEL_MILLISECONDS, scan_milliseconds};

    #[test]
    fn times_are_those_of_the_paper() {
        // No sensor: 18.28 · 1.81 s = 33.0868 s.
        assert_eq!(scan_milliseconds(0), 33_087);
        // Eight: 8 · 9.55 s + 10.28 · 1.81 s = 76.4 s + 18.6068 s.
        assert_eq!(scan_milliseconds(8), 95_007);
        assert_eq!(scan_milliseconds(8) + TRAVEL_MILLISECONDS, 150_427);
        // Eighteen leave 0.28 turns: 171.9 s + 0.5068 s. The nineteenth leaves none.
        assert_eq!(scan_milliseconds(18), 172_407);
        assert_eq!(scan_milliseconds(19), 181_450);
        assert_eq!(scan_milliseconds(u8::MAX), 2_435_250);
    }
}
