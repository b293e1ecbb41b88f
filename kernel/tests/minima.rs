//! The promises of a fix, said without its way downhill: its positions are minima, also within a rectangle; two are
//! told when the noise cannot tell them apart; and it has no unit of its own.

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::Propagation;
use tautline_kernel::position::{
    Area, Estimate, Fix, Layout, Parameters, Particle, Point, Range, Refusal, Residual, Signal, Swarm, bound,
    check, check_meeting, closed_form, linear, locate, locate_from,
};

use crate::numbers::Congruence;

const RESIDUALS: [Residual; 2] = [Residual::Metres, Residual::Decibels];

fn signal(noise_db: f64) -> Signal {
    Signal::new(Propagation::FREE_SPACE, noise_db).expect("a noise")
}

fn between(drawn: &mut Congruence, least: f64, greatest: f64) -> f64 {
    least + (greatest - least) * f64::from(drawn.pick(1 << 20)) / f64::from(1 << 20)
}

fn place(drawn: &mut Congruence, most_m: f64) -> Point {
    Point::new(between(drawn, -most_m, most_m), between(drawn, -most_m, most_m))
}

/// Three to five anchors, and distances that need not fit each other.
fn wild(drawn: &mut Congruence) -> Vec<Range> {
    let count = 3 + drawn.pick(3);
    (0..count).map(|_| Range::new(place(drawn, 30.0), between(drawn, 1.0, 40.0))).collect()
}

fn exact(anchors: &[Point], at: Point) -> Vec<Range> {
    anchors.iter().map(|&anchor| Range::new(anchor, anchor.distance_m(at))).collect()
}

/// The sum of the squared residuals, in m² or dB².
fn cost(ranges: &[Range], residual: Residual, signal: &Signal, at: Point) -> f64 {
    let misses = ranges.iter().map(|range| match residual {
        Residual::Metres => range.distance_m - range.anchor.distance_m(at),
        Residual::Decibels => {
            signal.level_db(range.distance_m) - signal.level_db(range.anchor.distance_m(at))
        }
    });
    misses.map(|miss| miss * miss).sum()
}

fn estimates(fix: &Fix) -> Vec<&Estimate> {
    match fix {
        Fix::One(one) => vec![one],
        Fix::Two(one, other) => vec![one, other],
    }
}

#[test]
fn every_estimate_is_a_minimum_and_tells_its_cost() {
    let (mut drawn, signal) = (Congruence(7), signal(3.0));
    let mut on_the_rim = 0;
    for _ in 0..400 {
        let ranges = wild(&mut drawn);
        let corner = place(&mut drawn, 20.0);
        let (width_m, height_m) = (between(&mut drawn, 1.0, 30.0), between(&mut drawn, 1.0, 30.0));
        let area = Area::new(corner, Point::new(corner.x_m + width_m, corner.y_m + height_m));
        for (residual, area) in
            RESIDUALS.into_iter().flat_map(|residual| [(residual, None), (residual, area)])
        {
            let fix = locate(&ranges, residual, &signal, area).expect("a fix");
            for estimate in estimates(&fix) {
                let at = estimate.at;
                let here = cost(&ranges, residual, &signal, at);
                let count = f64::from(u32::try_from(ranges.len()).expect("a few"));
                assert!((estimate.cost - here).abs() <= 1e-9 * here.max(1.0), "{estimate:?}, not {here}");
                assert!((estimate.residual - (estimate.cost / count).sqrt()).abs() <= 1e-12, "{estimate:?}");
                let is_on_rim = area.is_some_and(|area| {
                    [at.x_m - area.least().x_m, area.greatest().x_m - at.x_m].contains(&0.0)
                        || [at.y_m - area.least().y_m, area.greatest().y_m - at.y_m].contains(&0.0)
                });
                assert!(is_on_rim || !estimate.flags.is_outside, "{estimate:?}");
                on_the_rim += u32::from(is_on_rim);
                assert!(!estimate.flags.is_unsettled, "{estimate:?} of {ranges:?} in {area:?}");
                for turn in 0..16 {
                    let (sine, cosine) = (f64::from(turn) * core::f64::consts::PI / 8.0).sin_cos();
                    let beside = Point::new(at.x_m + 0.02 * cosine, at.y_m + 0.02 * sine);
                    let beside = area.map_or(beside, |area| area.nearest(beside));
                    let there = cost(&ranges, residual, &signal, beside);
                    assert!(
                        there >= here * (1.0 - 1e-9),
                        "{estimate:?}: {there} at {beside:?} of {ranges:?} in {area:?}"
                    );
                }
            }
        }
    }
    assert!(on_the_rim > 100, "{on_the_rim}");
}

#[test]
fn steps_from_a_place_lead_to_the_minimum_that_they_are_near_to() {
    let (mut drawn, signal) = (Congruence(11), signal(1.0));
    for _ in 0..200 {
        let at = place(&mut drawn, 20.0);
        let anchors: Vec<Point> = (0..4).map(|_| place(&mut drawn, 30.0)).collect();
        let ranges = exact(&anchors, at);
        if anchors.iter().any(|anchor| anchor.distance_m(at) < 2.0) {
            continue;
        }
        let beside =
            Point::new(at.x_m + between(&mut drawn, -0.3, 0.3), at.y_m + between(&mut drawn, -0.3, 0.3));
        for residual in RESIDUALS {
            let estimate = locate_from(beside, &ranges, residual, &signal, None).expect("an estimate");
            assert!(estimate.at.distance_m(at) < 1e-6 && estimate.steps <= 8, "{estimate:?}, not {at:?}");
            // A place that is a minimum stays, and the rest that is said of it is the same.
            let best = *locate(&ranges, residual, &signal, None).expect("a fix").best();
            let again = locate_from(best.at, &ranges, residual, &signal, None).expect("an estimate");
            assert!(again.at.distance_m(best.at) < 1e-6 && again.steps == 1, "{again:?}, not {best:?}");
            assert_eq!(again.flags, best.flags);
        }
    }
}

#[test]
fn steps_know_no_second_minimum_and_leave_no_rectangle() {
    let anchors = [Point::new(0.0, 0.0), Point::new(20.0, 0.0), Point::new(10.0, 0.0)];
    let ranges = exact(&anchors, Point::new(6.0, 8.0));
    let to = |from: Point, area| locate_from(from, &ranges, Residual::Metres, &signal(0.0), area);
    for (from, there) in [((5.0, 7.0), (6.0, 8.0)), ((5.0, -7.0), (6.0, -8.0))] {
        let estimate = to(Point::new(from.0, from.1), None).expect("an estimate");
        assert!(estimate.at.distance_m(Point::new(there.0, there.1)) < 1e-6, "{estimate:?}");
    }
    // Steps begin in the rectangle, too: at the nearest place of its rim.
    let area = Area::new(Point::new(0.0, 0.0), Point::new(5.0, 20.0));
    let estimate = to(Point::new(50.0, 3.0), area).expect("an estimate");
    assert!(estimate.at.x_m >= 5.0 && estimate.at.y_m > 3.0 && estimate.flags.is_outside, "{estimate:?}");
    for nowhere in [f64::NAN, f64::INFINITY, -2e9] {
        assert_eq!(to(Point::new(nowhere, 0.0), None), Err(Refusal::NoPlace));
        assert_eq!(to(Point::new(0.0, nowhere), None), Err(Refusal::NoPlace));
    }
    let two = locate_from(Point::default(), &ranges[..2], Residual::Metres, &signal(0.0), None);
    assert_eq!(two, Err(Refusal::Anchors(2)));
    let zero = [Range::new(anchors[0], 0.0), ranges[1], ranges[2]];
    let zero = locate_from(Point::default(), &zero, Residual::Decibels, &signal(0.0), None);
    assert_eq!(zero, Err(Refusal::Zero(0)));
}

#[test]
fn a_robot_on_the_rim_of_its_rectangle_is_not_outside() {
    let anchors = [(4.0, 3.0), (-4.0, 3.0), (4.0, -3.0), (-4.0, -3.0)].map(|(x, y)| Point::new(x, y));
    let ranges = exact(&anchors, Point::default());
    for (least, greatest) in [((0.0, -9.0), (9.0, 9.0)), ((-9.0, -9.0), (0.0, 9.0))] {
        let area = Area::new(Point::new(least.0, least.1), Point::new(greatest.0, greatest.1));
        for residual in RESIDUALS {
            let fix = locate(&ranges, residual, &signal(0.0), area).expect("a fix");
            assert!(
                fix.best().at.distance_m(Point::default()) < 1e-9 && !fix.best().flags.is_outside,
                "{fix:?}"
            );
            // Also where nothing leads away from it, to the last bit.
            let there =
                locate_from(Point::default(), &ranges, residual, &signal(0.0), area).expect("a place");
            assert_eq!((there.at, there.steps, there.flags.is_outside), (Point::default(), 1, false));
        }
    }
}

#[test]
fn a_step_as_long_as_the_last_one_may_be_is_the_last() {
    let anchors = [(4.0, 3.0), (4.0, -3.0), (-4.0, 3.0), (-4.0, -3.0)].map(|(x, y)| Point::new(x, y));
    let ranges = exact(&anchors, Point::new(2.0, 0.0));
    let last_m = 1e-5 * Layout::of(&ranges).spread_m[0];
    let area = Area::new(Point::new(-9.0, -9.0), Point::new(0.0, 9.0));
    for (times, steps) in [(0.999, 1), (1.0, 1), (1.001, 2)] {
        let from = Point::new(-times * last_m, 0.0);
        let there = locate_from(from, &ranges, Residual::Metres, &signal(0.0), area).expect("a place");
        assert_eq!((there.at, there.steps), (Point::default(), steps), "{times}");
    }
}

#[test]
fn two_minima_are_told_if_their_costs_differ_by_less_than_3_84_times_the_variance() {
    let mut drawn = Congruence(3);
    let mut told = 0;
    for _ in 0..60 {
        let anchors = [0.0, 11.0, 24.0].map(|along| Point::new(along, between(&mut drawn, -2.0, 2.0)));
        let at = Point::new(between(&mut drawn, 3.0, 21.0), between(&mut drawn, 6.0, 15.0));
        let mut ranges = exact(&anchors, at);
        for range in &mut ranges {
            range.distance_m *= between(&mut drawn, 0.9, 1.1);
        }
        let mean_m2 = ranges.iter().map(|range| range.distance_m * range.distance_m).sum::<f64>() / 3.0;
        for residual in RESIDUALS {
            let Ok(Fix::Two(one, other)) = locate(&ranges, residual, &signal(20.0), None) else {
                panic!("with so much noise the mirror image fits as well: {ranges:?}");
            };
            // The standard deviation of a level at which the difference is 3.84 variances.
            let deviations = ((other.cost - one.cost) / 3.84).sqrt();
            let noise_db = match residual {
                Residual::Metres => deviations / mean_m2.sqrt() * signal(0.0).decibels(),
                Residual::Decibels => deviations,
            };
            let tells_two =
                |noise_db| matches!(locate(&ranges, residual, &signal(noise_db), None), Ok(Fix::Two(..)));
            assert!(tells_two(1.001 * noise_db) && !tells_two(0.999 * noise_db), "{noise_db} of {ranges:?}");
            told += 1;
        }
    }
    assert_eq!(told, 120);
}

#[test]
fn a_mirror_image_is_told_without_noise_too() {
    let mut drawn = Congruence(11);
    for round in 0..100 {
        // Also where rounding makes costs differ by more than other layouts cost, and where anchors are a hundredth of
        // a millimetre apart.
        let scale = [1.0, 1e6, 3e-5][round % 3];
        let (from, along) = (place(&mut drawn, 30.0 * scale), place(&mut drawn, scale));
        let on_line = |far_m: f64| Point::new(from.x_m + far_m * along.x_m, from.y_m + far_m * along.y_m);
        let off = Point::new(from.x_m - 7.0 * along.y_m, from.y_m + 7.0 * along.x_m);
        let ranges = exact(&[on_line(0.0), on_line(9.0), on_line(20.0)], off);
        for residual in RESIDUALS {
            let fix = locate(&ranges, residual, &signal(0.0), None);
            assert!(matches!(fix, Ok(Fix::Two(..))), "{fix:?} of {ranges:?}");
        }
    }
}

#[test]
fn positions_have_no_unit_of_their_own() {
    let mut drawn = Congruence(5);
    for _ in 0..150 {
        let ranges = wild(&mut drawn);
        let spread = place(&mut drawn, 20.0);
        let area = Area::new(spread, Point::new(spread.x_m + 10.0, spread.y_m + 15.0));
        for times in [1.0 / 64.0, 64.0] {
            let larger = |point: Point| Point::new(times * point.x_m, times * point.y_m);
            let scaled: Vec<Range> = ranges
                .iter()
                .map(|range| Range::new(larger(range.anchor), times * range.distance_m))
                .collect();
            let scaled_area = area.and_then(|area| Area::new(larger(area.least()), larger(area.greatest())));
            let is_same = |one: Point, other: Point| larger(one).distance_m(other) <= 1e-6 * times;
            let (one, other) = (linear(&ranges).expect("no line"), linear(&scaled).expect("no line"));
            assert!(is_same(one, other), "{one:?} {other:?}");
            for residual in RESIDUALS {
                let one = locate_from(spread, &ranges, residual, &signal(2.0), area).expect("an estimate");
                let other = locate_from(larger(spread), &scaled, residual, &signal(2.0), scaled_area);
                let other = other.expect("an estimate");
                assert!(is_same(one.at, other.at) && one.steps == other.steps, "{one:?} {other:?}");
            }
            for (residual, area, scaled_area) in [
                (Residual::Metres, None, None),
                (Residual::Decibels, None, None),
                (Residual::Metres, area, scaled_area),
                (Residual::Decibels, area, scaled_area),
            ] {
                let fix = locate(&ranges, residual, &signal(2.0), area).expect("a fix");
                let other = locate(&scaled, residual, &signal(2.0), scaled_area).expect("a fix");
                let (one, other) = (estimates(&fix), estimates(&other));
                assert_eq!(one.len(), other.len(), "{ranges:?} times {times}");
                for (one, other) in one.iter().zip(other) {
                    assert!(is_same(one.at, other.at) && one.flags == other.flags, "{one:?} {other:?}");
                }
            }
        }
    }
}

#[test]
fn anchors_on_a_line_are_on_one_wherever_it_is() {
    let mut drawn = Congruence(9);
    for (x, y) in [(0.0, 0.0), (1e6, 0.0), (0.0, 1e6), (-3e5, 0.0), (0.0, -3e5), (4e7, -5e7)] {
        for _ in 0..20 {
            let along = place(&mut drawn, 1.0);
            // Also where the centre of the anchors is on an axis.
            for far_m in [[0.0, 9.0, 20.0], [-11.0, 2.0, 9.0]] {
                let anchors = far_m.map(|far_m| Point::new(x + far_m * along.x_m, y + far_m * along.y_m));
                let ranges = exact(&anchors, Point::new(x + 3.0, y - 8.0));
                assert_eq!(linear(&ranges), Err(Refusal::Collinear), "{ranges:?}");
                assert_eq!(closed_form(&ranges), Err(Refusal::Collinear), "{ranges:?}");
            }
        }
    }
}

#[test]
fn anchors_a_millimetre_apart_are_at_two_places() {
    let [near, far] = [Point::new(1.0, 2.0), Point::new(20.0, 2.0)];
    for (apart_m, is_one) in [(1e-3, false), (1e-5, false), (2e-6, false), (9e-7, true), (0.0, true)] {
        let ranges = exact(&[near, Point::new(1.0, 2.0 + apart_m), far], Point::new(5.0, 9.0));
        let refusal = Refusal::Coincident { first: 0, second: 1 };
        assert_eq!(check(&ranges), if is_one { Err(refusal) } else { Ok(()) }, "{apart_m}");
    }
    // The direction of an anchor does not depend on how near it is.
    let dilution = |apart_m: f64| {
        let at = Point::new(near.x_m + 0.6 * apart_m, near.y_m + 0.8 * apart_m);
        bound([near, far, Point::new(9.0, 30.0)].into_iter(), at, &signal(1.0)).expect("a bound").dilution
    };
    assert!((dilution(1e-3) - dilution(1e-4)).abs() < 1e-3, "{} {}", dilution(1e-3), dilution(1e-4));
}

#[test]
fn circles_meet_up_to_four_standard_deviations_and_to_the_rounding_of_numbers() {
    let mut drawn = Congruence(13);
    for noise_db in [0.0, 1.0, 6.0] {
        let signal = signal(noise_db);
        let most = (4.0 * signal.relative_error()).exp();
        for _ in 0..50 {
            let (first, second) = (place(&mut drawn, 30.0), place(&mut drawn, 30.0));
            let between_m = first.distance_m(second);
            let meets = |one_m: f64, other_m: f64| {
                // A third circle round both meets them: it has room on either side.
                let third = Point::new(first.x_m + 1e3, first.y_m);
                let ranges = [(first, one_m), (second, other_m), (third, 1e3)];
                let ranges = ranges.map(|(anchor, distance_m)| Range::new(anchor, distance_m));
                check_meeting(&ranges, &signal) != Err(Refusal::Apart { first: 0, second: 1 })
            };
            let part = between(&mut drawn, 0.1, 0.9) * between_m;
            let beside = |one_m: f64, off: f64| (one_m / most, (between_m - one_m) / most * (1.0 + off));
            let within = |one_m: f64, off: f64| (one_m, most * (between_m + one_m * most) * (1.0 + off));
            // Circles that touch meet, also where a sum is rounded.
            assert!(meets(beside(part, 0.0).0, beside(part, 0.0).1), "{first:?} {second:?} {part}");
            assert!(meets(within(part, 0.0).0, within(part, 0.0).1), "{first:?} {second:?} {part}");
            assert!(meets(within(part, 0.0).1, within(part, 0.0).0), "{first:?} {second:?} {part}");
            assert!(!meets(beside(part, -1e-6).0, beside(part, -1e-6).1), "{first:?} {second:?} {part}");
            assert!(!meets(within(part, 1e-6).0, within(part, 1e-6).1), "{first:?} {second:?} {part}");
            assert!(!meets(within(part, 1e-6).1, within(part, 1e-6).0), "{first:?} {second:?} {part}");
        }
    }
}

#[test]
fn circles_that_touch_to_the_last_bit_meet() {
    let most = 1.0 + 1e-9;
    for (apart_m, one_m, other_m) in [(most, 0.5, 0.5), (1.0, most, 0.0), (1.0, 0.0, most)] {
        let ranges = [(0.0, 0.0, one_m), (apart_m, 0.0, other_m), (50.0, 50.0, 70.0)]
            .map(|(x, y, distance_m)| Range::new(Point::new(x, y), distance_m));
        let apart = Err(Refusal::Apart { first: 0, second: 1 });
        assert_ne!(check_meeting(&ranges, &signal(0.0)), apart, "{one_m} and {other_m}");
    }
}

#[test]
fn a_line_is_told_in_one_direction_and_anchors_spread_alike_have_the_axes() {
    let along = |anchors: &[(f64, f64)]| {
        let ranges: Vec<Range> = anchors.iter().map(|&(x, y)| Range::new(Point::new(x, y), 1.0)).collect();
        Layout::of(&ranges).along
    };
    assert_eq!(along(&[(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)]), Point::new(1.0, 0.0));
    // From the diagonal that leads up to the left, round by the right, to the one that leads down to the right, which
    // is not.
    let mut drawn = Congruence(19);
    for round in 0..200 {
        let to = match round {
            0 => Point::new(1.0, -1.0),
            1 => Point::new(-4.0, 4.0),
            _ => place(&mut drawn, 9.0),
        };
        let Point { x_m, y_m } = along(&[(to.x_m, to.y_m), (0.0, 0.0), (-to.x_m, -to.y_m)]);
        assert!(x_m + y_m > 0.0 || x_m + y_m == 0.0 && x_m < 0.0, "{to:?}: {x_m} {y_m}");
    }
}

#[test]
fn of_two_mirror_images_that_fit_alike_the_left_one_is_told_first() {
    let anchors = [Point::new(0.0, 0.0), Point::new(20.0, 0.0), Point::new(10.0, 0.0)];
    for residual in RESIDUALS {
        let fix =
            locate(&exact(&anchors, Point::new(6.0, 8.0)), residual, &signal(1.0), None).expect("a fix");
        let Fix::Two(first, second) = fix else { panic!("{fix:?}") };
        assert!(first.at.y_m > 0.0 && second.at.y_m < 0.0, "{fix:?}");
    }
}

#[test]
fn a_direction_of_which_rounding_leaves_nothing_is_not_told() {
    let anchors = [-9.0, 4.0, 11.0].map(|along| Point::new(along, 3.0 * along));
    for off_m in [0.0, 1e-10, 1e-9, 3e-9, 5e-9, 1e-8, 2e-8] {
        let at = Point::new(3.0 - 3.0 * off_m, 9.0 + off_m);
        assert_eq!(bound(anchors.into_iter(), at, &signal(1.0)), None, "{off_m} m off the line");
    }
}

#[test]
fn a_swarm_tells_the_cost_of_its_best_position() {
    let mut drawn = Congruence(17);
    for _ in 0..20 {
        let ranges = wild(&mut drawn);
        let mut particles = [Particle::UNUSED; 6];
        let mut swarm =
            Swarm::start(&ranges, Point::default(), Parameters::FALLING, &mut particles, &mut drawn)
                .expect("ranges");
        for _ in 0..10 {
            let there = cost(&ranges, Residual::Metres, &signal(0.0), swarm.best());
            assert!((swarm.best_cost() - there).abs() <= 1e-9 * there, "{} {there}", swarm.best_cost());
            swarm.step(&mut drawn);
        }
    }
    assert_eq!(signal(2.5).noise_db().to_bits(), 2.5_f64.to_bits());
}
