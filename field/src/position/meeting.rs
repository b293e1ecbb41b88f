//! Whether every two circles meet, as the kernel says it, for files with so many distances that not every two can be
//! compared: circles stand in a tree of boxes, and what is in a box is looked at only where its bounds leave it open.

use tautline_kernel::position::{Point, Range, Refusal, Signal, check, do_meet, most_error};

use super::analysis::span;

/// Circles of a box that is not divided.
const FEW: usize = 8;

/// Bounds give way by so much, for the rounding of numbers.
const SLACK: f64 = 1.0 + 1e-12;

/// As the kernel's `check_meeting`, in a time that hardly grows faster than the number of circles.
///
/// # Errors
/// [`Refusal::Apart`] if two circles do not meet, and what [`check`] returns.
pub(super) fn check_meeting(ranges: &[Range], signal: &Signal) -> Result<(), Refusal> {
    check(ranges)?;
    let most_error = most_error(signal);
    let mut order: Vec<usize> = (0..ranges.len()).collect();
    let tree = Circles::of(ranges, &mut order);
    let has_foe = |&second: &usize| tree.has_foe(ranges, second, most_error);
    let Some(second) = (1..ranges.len()).find(has_foe) else { return Ok(()) };
    let is_foe = |first: &usize| !do_meet(&ranges[*first], &ranges[second], most_error);
    Err((0..second).find(is_foe).map_or(Refusal::NoPlace, |first| Refusal::Apart { first, second }))
}

/// Circles in a box.
struct Circles {
    least: Point,
    most: Point,
    /// The least and the greatest distance.
    distances_m: [f64; 2],
    /// The first of them in the file.
    first: usize,
    inner: Inner,
}

enum Inner {
    Few(Vec<usize>),
    Halves(Box<[Circles; 2]>),
}

impl Circles {
    fn of(ranges: &[Range], order: &mut [usize]) -> Self {
        let all = || order.iter().map(|&number| &ranges[number]);
        let [west, east] = span(all().map(|range| range.anchor.x_m));
        let [north, south] = span(all().map(|range| range.anchor.y_m));
        let [near, far] = span(all().map(|range| range.distance_m));
        let first = order.iter().copied().min().unwrap_or(0);
        let inner = if order.len() <= FEW {
            Inner::Few(order.to_vec())
        } else {
            let along: fn(&Range) -> f64 = match (east - west, south - north, far - near) {
                (x, y, distance) if distance > x.max(y) => |range| range.distance_m,
                (x, y, _) if x > y => |range| range.anchor.x_m,
                _ => |range| range.anchor.y_m,
            };
            let middle = order.len() / 2;
            order.select_nth_unstable_by(middle, |&one, &other| {
                along(&ranges[one]).total_cmp(&along(&ranges[other])).then(one.cmp(&other))
            });
            let (one, other) = order.split_at_mut(middle);
            Inner::Halves(Box::new([Self::of(ranges, one), Self::of(ranges, other)]))
        };
        let (least, most) = (Point::new(west, north), Point::new(east, south));
        Self { least, most, distances_m: [near, far], first, inner }
    }

    /// Whether a circle here does not meet that of number `second`, which comes after it in the file.
    fn has_foe(&self, ranges: &[Range], second: usize, most_error: f64) -> bool {
        if self.first >= second || !self.may_have_foe(&ranges[second], most_error) {
            return false;
        }
        match &self.inner {
            Inner::Few(numbers) => numbers
                .iter()
                .any(|&first| first < second && !do_meet(&ranges[first], &ranges[second], most_error)),
            Inner::Halves(halves) => halves.iter().any(|half| half.has_foe(ranges, second, most_error)),
        }
    }

    /// Whether the bounds leave it open that a circle here does not meet `other`.
    fn may_have_foe(&self, other: &Range, most_error: f64) -> bool {
        let Self { least, most, distances_m: [near, far], .. } = *self;
        let (at, distance_m) = (other.anchor, other.distance_m);
        let nearest = Point::new(at.x_m.clamp(least.x_m, most.x_m), at.y_m.clamp(least.y_m, most.y_m));
        let farther = |at: f64, one: f64, other: f64| if at - one > other - at { one } else { other };
        let farthest = Point::new(farther(at.x_m, least.x_m, most.x_m), farther(at.y_m, least.y_m, most.y_m));
        let (least_m, most_m) = (at.distance_m(nearest), at.distance_m(farthest));
        let is_outside = (distance_m + near) * most_error < most_m * SLACK;
        let is_around = distance_m / most_error * SLACK > least_m + near * most_error;
        let is_inside = far / most_error * SLACK > least_m + distance_m * most_error;
        is_outside || is_around || is_inside
    }
}

#[cfg(test)]
mod tests {
    use tautline_kernel::choice::Oracle;
    use tautline_kernel::net::Propagation;
    use tautline_kernel::position;
    use tautline_proofs::engine::SeededOracle;

    use super::*;

    #[test]
    fn circles_meet_where_the_kernel_says_so_which_compares_every_two() {
        let mut refused = 0;
        for seed in 0..600 {
            let dice = &mut SeededOracle::new(seed, 0);
            let mut number = |below: u32| f64::from(dice.pick(below));
            let noise_db = [0.0, 0.1, 1.0, 6.0][seed as usize % 4];
            let signal = Signal::new(Propagation::FREE_SPACE, noise_db).expect("a signal");
            let count = 3 + seed as usize % 60;
            let robot = Point::new(number(100), number(100));
            // Few places, so that anchors come again; few distances are wrong.
            let places = 2 + number(40) as u32;
            let ranges: Vec<Range> = (0..count)
                .map(|_| {
                    let place = number(places);
                    let anchor = Point::new(place * 7.0 % 101.0, place * place % 103.0);
                    let wrong = if number(40) < 1.0 { 0.2 + number(4) } else { 1.0 };
                    Range::new(anchor, robot.distance_m(anchor) * wrong)
                })
                .collect();
            let found = check_meeting(&ranges, &signal);
            assert_eq!(found, position::check_meeting(&ranges, &signal), "seed {seed}");
            refused += usize::from(matches!(found, Err(Refusal::Apart { .. })));
        }
        assert!((100..500).contains(&refused), "{refused}");
    }
}
