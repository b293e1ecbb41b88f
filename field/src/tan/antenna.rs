//! The robot's antenna. Figure 4 of [Jiang 2011] shows how the strength falls off the axis, without numbers in the
//! text, so the pattern is ours: the parabola that radio standards take for the element of a sector antenna (3GPP TR
//! 38.901, 7.3), with a floor. At half the beam width off the axis the strength is 3 dB less than on it.

use tautline_kernel::tan::Heading;

/// An antenna's gain by the angle off its axis: G − min(12·(θ/θ₃)², A).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Antenna {
    /// G: on the axis, in dB, against one that hears all round.
    gain_db: f64,
    /// θ₃: the beam width, in degrees.
    beam_degrees: f64,
    /// A: it is never less by more, in dB.
    floor_db: f64,
}

impl Antenna {
    /// The standard's element: 8 dB on the axis, 65° wide, 30 dB less behind.
    pub const DIRECTIONAL: Self = Self { gain_db: 8.0, beam_degrees: 65.0, floor_db: 30.0 };

    /// An element that hears all round alike: 0 dB in every direction.
    pub const ALL_ROUND: Self = Self { gain_db: 0.0, beam_degrees: 360.0, floor_db: 0.0 };

    /// The gain on the axis, in dB.
    pub const fn most_db(&self) -> f64 {
        self.gain_db
    }

    /// The gain so many degrees off the axis, in dB.
    pub fn gain_db(&self, degrees: f64) -> f64 {
        let off = degrees / self.beam_degrees;
        self.gain_db - (12.0 * off * off).min(self.floor_db)
    }
}

/// The angle between a heading and the way (`x`, `y`), in degrees; 0 if there is no way.
pub(super) fn degrees_off(axis: Heading, x: f64, y: f64) -> f64 {
    let (cosine, sine) = axis.vector();
    let (cosine, sine) = (f64::from(cosine), f64::from(sine));
    libm::atan2((cosine * y - sine * x).abs(), cosine * x + sine * y).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gain_falls_from_the_axis_to_the_floor() {
        let gain = |degrees| Antenna::DIRECTIONAL.gain_db(degrees);
        let tenths = |degrees| (10.0 * gain(degrees)).round() as i32;
        assert_eq!([0.0, 32.5, 65.0, 180.0].map(tenths), [80, 50, -40, -220]);
        assert!((0..180).all(|degrees| gain(f64::from(degrees)) >= gain(f64::from(degrees + 1))));
        assert!(Antenna::ALL_ROUND.gain_db(180.0).abs() < 1e-9);
    }

    #[test]
    fn the_angle_off_the_axis_is_the_same_on_both_sides() {
        let axis = Heading::FIRST.turned(2);
        for (x, y, degrees) in [(1.0, 0.0, 30.0), (0.5, 3_f64.sqrt() / 2.0, 30.0), (0.0, -2.0, 120.0)] {
            assert!((degrees_off(axis, x, y) - degrees).abs() < 1e-4, "{x}, {y}");
        }
        assert!(degrees_off(axis, 0.0, 0.0).abs() < 1e-9);
    }
}
