//! How long an agent takes [Ferranti 2009, V.A]: the means that the paper measured, in whole milliseconds.
//!
//! Our reading: each sensor takes up one turn of a scan, in which it is detected, identified and localized; in the other
//! turns the agent just moves on. A sensor that is missed costs what an empty turn costs.

/// Turns of a scan, in hundredths: 18.28.
pub const TURNS_HUNDREDTHS: u32 = 1_828;
/// A turn in which a sensor is detected: 9.55 s.
pub const TURN_WITH_SENSOR_MILLISECONDS: u32 = 9_550;
/// A turn in which none is: 1.81 s.
pub const TURN_WITHOUT_SENSOR_MILLISECONDS: u32 = 1_810;
/// The way to the next cell: 55.42 s.
pub const TRAVEL_MILLISECONDS: u32 = 55_420;

/// A scan in which that many sensors are detected, rounded to the nearest millisecond. More than 18 take a turn each, and
/// there are no others.
pub const fn scan_milliseconds(sensors: u8) -> u32 {
    let sensors = sensors as u32;
    let empty_hundredths = TURNS_HUNDREDTHS.saturating_sub(100 * sensors);
    sensors * TURN_WITH_SENSOR_MILLISECONDS + (empty_hundredths * TURN_WITHOUT_SENSOR_MILLISECONDS + 50) / 100
}

/// A scan in which that many sensors are detected, and the way to the next cell.
pub const fn step_milliseconds(sensors: u8) -> u32 {
    scan_milliseconds(sensors) + TRAVEL_MILLISECONDS
}
