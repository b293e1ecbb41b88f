//! Positions from ranges (POSITION): what each way gives, and what is refused.

use core::mem::size_of;

use proptest::prelude::*;
use tautline_kernel::net::Propagation;
use tautline_kernel::position::{
    Area, Estimate, Fix, Layout, Order, Parameters, Particle, Point, Range, Refusal, Residual, Signal, Swarm,
    bound, check, check_meeting, closed_form, linear, locate,
};

use crate::numbers::Congruence;
use crate::ranges::{SQUARE, swarm, wrong};

fn signal(noise_db: f64) -> Signal {
    Signal::new(Propagation::FREE_SPACE, noise_db).expect("a noise")
}

fn ranges(anchors: &[Point], at: Point) -> Vec<Range> {
    anchors.iter().map(|&anchor| Range::new(anchor, anchor.distance_m(at))).collect()
}

#[test]
fn distances_without_noise_give_the_position_by_every_way() {
    for (x, y) in [(1.0, 2.0), (10.0, 10.0), (19.0, 3.0), (-7.0, 40.0), (20.0, 20.0)] {
        let at = Point::new(x, y);
        let ranges = ranges(&SQUARE, at);
        let near =
            |found: Point, most_m: f64| assert!(found.distance_m(at) < most_m, "{found:?}, not {at:?}");
        near(closed_form(&ranges).expect("a triangle"), 1e-12);
        near(linear(&ranges).expect("a triangle"), 1e-12);
        for residual in [Residual::Metres, Residual::Decibels] {
            let fix = locate(&ranges, residual, &signal(0.0), None).expect("a fix");
            assert!(matches!(fix, Fix::One(_)), "{fix:?}");
            near(fix.best().at, 1e-9);
            assert!(fix.best().residual < 1e-8 && !fix.best().flags.is_unsettled, "{fix:?}");
        }
    }
}

#[test]
fn equation_8_divides_by_0_for_anchors_that_stand_well() {
    let anchors = [SQUARE[1], SQUARE[0], SQUARE[2]];
    let ranges = ranges(&anchors, Point::new(3.0, 4.0));
    assert_eq!(closed_form(&ranges), Err(Refusal::Division));
    let found = linear(&ranges).expect("a triangle");
    assert!(found.distance_m(Point::new(3.0, 4.0)) < 1e-12);
    let four = [ranges.clone(), ranges].concat();
    assert_eq!(closed_form(&four), Err(Refusal::Anchors(6)));
}

#[test]
fn what_gives_no_position_is_refused_by_every_way() {
    let at = Point::new(3.0, 4.0);
    let good = ranges(&SQUARE, at);
    let with = |anchor: usize, change: fn(&mut Range)| {
        let mut ranges = good.clone();
        change(&mut ranges[anchor]);
        ranges
    };
    let cases = [
        (good[..2].to_vec(), Refusal::Anchors(2)),
        (Vec::new(), Refusal::Anchors(0)),
        (with(1, |range| range.distance_m = f64::NAN), Refusal::NotFinite(1)),
        (with(2, |range| range.distance_m = f64::INFINITY), Refusal::NotFinite(2)),
        (with(0, |range| range.anchor.x_m = 2e9), Refusal::NotFinite(0)),
        (with(2, |range| range.distance_m = -0.5), Refusal::Negative(2)),
        (with(2, |range| range.anchor = SQUARE[0]), Refusal::Coincident { first: 0, second: 2 }),
    ];
    for (ranges, refusal) in cases {
        assert_eq!(check(&ranges), Err(refusal));
        assert_eq!(closed_form(&ranges), Err(refusal));
        assert_eq!(linear(&ranges), Err(refusal));
        assert_eq!(locate(&ranges, Residual::Metres, &signal(1.0), None), Err(refusal));
        let mut particles = [Particle::UNUSED; 3];
        let swarm = Swarm::start(&ranges, at, Parameters::FALLING, &mut particles, &mut Congruence(1));
        assert_eq!(swarm.err(), Some(refusal));
        assert!(refusal.to_string().contains("anchor") && !refusal.remedy().is_empty(), "{refusal}");
    }
    let swarm = Swarm::start(&good, at, Parameters::FALLING, &mut [], &mut Congruence(1));
    assert_eq!(swarm.err(), Some(Refusal::NoParticle));
    let nowhere = Point::new(f64::NAN, 0.0);
    let mut particles = [Particle::UNUSED; 3];
    let swarm = Swarm::start(&good, nowhere, Parameters::FALLING, &mut particles, &mut Congruence(1));
    assert_eq!(swarm.err(), Some(Refusal::NoPlace));
    let zero = with(1, |range| range.distance_m = 0.0);
    assert_eq!(locate(&zero, Residual::Decibels, &signal(1.0), None), Err(Refusal::Zero(1)));
    assert!(locate(&zero, Residual::Metres, &signal(1.0), None).is_ok());
    let least = with(1, |range| range.distance_m = 1e-6);
    assert!(locate(&least, Residual::Decibels, &signal(1.0), None).is_ok(), "a micrometre is a distance");
    let near = with(2, |range| range.anchor = Point::new(20.0, 1e-7));
    assert_eq!(linear(&near), Err(Refusal::Coincident { first: 1, second: 2 }));
}

#[test]
fn circles_that_do_not_meet_are_told_unless_the_noise_explains_it() {
    let apart = |distances_m: [f64; 3], noise_db: f64| {
        let ranges: Vec<Range> = SQUARE
            .iter()
            .zip(distances_m)
            .map(|(&anchor, distance_m)| Range::new(anchor, distance_m))
            .collect();
        check_meeting(&ranges, &signal(noise_db)).err()
    };
    let exact = ranges(&SQUARE, Point::new(3.0, 4.0));
    assert_eq!(check_meeting(&exact, &signal(0.0)), Ok(()));
    assert_eq!(apart([5.0, 14.0, 16.0], 0.0), Some(Refusal::Apart { first: 0, second: 1 }));
    assert_eq!(apart([5.0, 14.0, 16.0], 1.0), None);
    assert_eq!(apart([5.0, 5.0, 20.0], 1.0), Some(Refusal::Apart { first: 0, second: 1 }));
    // One circle within the other.
    assert_eq!(apart([15.0, 15.0, 90.0], 1.0), Some(Refusal::Apart { first: 0, second: 2 }));
}

#[test]
fn anchors_on_a_line_are_known_far_from_the_origin_and_in_any_number() {
    for count in [3, 16, 32, 100, 1_000_u32] {
        for line in 0..100_u32 {
            let (across, up) = (6.76 + f64::from(line), 2.11 + f64::from(line % 7));
            let anchor = |along: f64| Point::new(667_500.0 + along * across, 3_177_040.0 + along * up);
            let anchors: Vec<Point> = (0..count).map(|number| anchor(f64::from(number))).collect();
            let told = linear(&ranges(&anchors, Point::new(667_549.77, 3_177_066.186)));
            assert_eq!(told, Err(Refusal::Collinear), "{count} anchors, line {line}");
        }
    }
}

#[test]
fn anchors_on_a_line_leave_two_positions_and_the_closed_form_none() {
    let anchors = [0.0, 7.0, 20.0].map(|along| Point::new(along, 2.0 * along + 1.0));
    let at = Point::new(3.0, 15.0);
    let ranges = ranges(&anchors, at);
    assert_eq!(closed_form(&ranges), Err(Refusal::Collinear));
    assert_eq!(linear(&ranges), Err(Refusal::Collinear));
    for residual in [Residual::Metres, Residual::Decibels] {
        let Ok(Fix::Two(one, other)) = locate(&ranges, residual, &signal(1.0), None) else {
            panic!("a mirror image fits as well");
        };
        let mirror = Point::new(9.4, 11.8);
        for place in [at, mirror] {
            let nearest_m = one.at.distance_m(place).min(other.at.distance_m(place));
            assert!(nearest_m < 1e-6, "{one:?}, {other:?}");
        }
    }
    // A rectangle that has only one of them decides.
    let area = Area::new(Point::new(0.0, 13.0), Point::new(20.0, 41.0));
    assert!(matches!(locate(&ranges, Residual::Metres, &signal(0.0), area), Ok(Fix::One(_))));
}

#[test]
fn a_robot_on_the_line_of_its_anchors_is_told_with_no_precision_across() {
    let anchors = [0.0, 7.0, 20.0].map(|along| Point::new(along, 0.0));
    let fix =
        locate(&ranges(&anchors, Point::new(3.0, 0.0)), Residual::Metres, &signal(1.0), None).expect("a fix");
    assert!(fix.best().at.distance_m(Point::new(3.0, 0.0)) < 0.1 && fix.best().flags.is_weak, "{fix:?}");
    assert_eq!(bound(anchors.into_iter(), Point::new(3.0, 0.0), &signal(1.0)), None);
}

#[test]
fn nearly_collinear_anchors_give_far_positions_that_are_numbers() {
    for off_m in [1e-3, 1e-7, 1e-11, 1e-13] {
        let anchors = [Point::new(0.0, 0.0), Point::new(10.0, off_m), Point::new(20.0, 0.0)];
        let mut ranges = ranges(&anchors, Point::new(3.0, 4.0));
        ranges[0].distance_m += 0.5;
        let found = linear(&ranges).expect("no line");
        assert!(found.is_finite(), "{found:?}");
        let fix = locate(&ranges, Residual::Metres, &signal(1.0), None).expect("a fix");
        assert!(matches!(fix, Fix::Two(..)), "{fix:?}");
    }
}

#[test]
fn a_covariance_too_large_for_a_number_is_none() {
    let far = Point::new(1e8, 1e-160);
    let ranges = [Point::new(-1.5, 0.0), Point::new(0.0, 0.0), far].map(|anchor| Range::new(anchor, 0.0));
    let area = Area::new(Point::new(-5.0, -5.0), Point::new(5.0, 7.0));
    let fix = locate(&ranges, Residual::Metres, &signal(0.0), area).expect("a fix");
    assert!(fix.best().precision.is_none() && fix.best().flags.is_weak, "{fix:?}");
}

#[test]
fn an_estimate_outside_the_rectangle_is_on_its_rim_and_says_so() {
    let area = Area::new(SQUARE[0], Point::new(20.0, 20.0)).expect("a rectangle");
    let outside = ranges(&SQUARE, Point::new(23.0, 8.0));
    for residual in [Residual::Metres, Residual::Decibels] {
        let fix = locate(&outside, residual, &signal(1.0), Some(area)).expect("a fix");
        let at = fix.best().at;
        assert!(
            (at.x_m - 20.0).abs() < 1e-12 && (at.y_m - 8.0).abs() < 2.0 && fix.best().flags.is_outside,
            "{fix:?}"
        );
        let inside = locate(&ranges(&SQUARE, Point::new(3.0, 8.0)), residual, &signal(1.0), Some(area))
            .expect("a fix");
        assert!(!inside.best().flags.is_outside, "{inside:?}");
    }
    assert_eq!(area.nearest(Point::new(30.0, -1.0)), Point::new(20.0, 0.0));
    assert_eq!(Area::new(SQUARE[1], SQUARE[0]), None);
    assert_eq!(Area::new(SQUARE[0], Point::new(f64::INFINITY, 1.0)), None);
}

/// The estimate from distances to these anchors without an error, but for the one of `wrong` that is longer by the
/// share `by`.
fn estimate_with(anchors: &[Point], at: Point, residual: Residual, wrong: usize, by: f64) -> Estimate {
    let mut ranges = ranges(anchors, at);
    ranges[wrong].distance_m *= 1.0 + by;
    *locate(&ranges, residual, &signal(1.0), None).expect("a fix").best()
}

/// Small errors in proportion to the distances, one by one, moved to both sides.
#[test]
fn a_covariance_and_a_dilution_are_what_small_errors_of_the_distances_do_to_the_position() {
    const BY: f64 = 1e-4;
    let anchors =
        [(0.0, 0.0), (20.0, 1.0), (3.0, 17.0), (25.0, 22.0), (-4.0, 9.0)].map(|(x, y)| Point::new(x, y));
    for (count, residual) in
        [(3, Residual::Metres), (5, Residual::Metres), (3, Residual::Decibels), (5, Residual::Decibels)]
    {
        let anchors = &anchors[..count];
        for at in [Point::new(6.0, 7.0), Point::new(15.0, 3.0), Point::new(9.0, -5.0)] {
            let error = signal(1.0).relative_error();
            let (mut covariance, mut squared_dilution) = ([0.0; 3], 0.0);
            for (anchor, range) in ranges(anchors, at).into_iter().enumerate() {
                let moved = |residual| {
                    let [to, from] = [BY, -BY].map(|by| estimate_with(anchors, at, residual, anchor, by).at);
                    ((to.x_m - from.x_m) / (2.0 * BY), (to.y_m - from.y_m) / (2.0 * BY))
                };
                let (x, y) = moved(residual);
                let [xx, xy, yy] = covariance;
                covariance = [xx + x * x, xy + x * y, yy + y * y];
                let (x, y) = moved(Residual::Metres);
                squared_dilution += (x * x + y * y) / (range.distance_m * range.distance_m);
            }
            let precision = estimate_with(anchors, at, residual, 0, 0.0).precision.expect("a precision");
            let told = precision.covariance;
            let near =
                |told: f64, measured: f64| (told - measured).abs() < 1e-4 * precision.covariance.trace();
            let [xx, xy, yy] = covariance.map(|sum| sum * error * error);
            assert!(
                near(told.xx, xx) && near(told.xy, xy) && near(told.yy, yy),
                "{told:?}, not {xx} {xy} {yy}"
            );
            let measured = squared_dilution.sqrt();
            assert!((precision.dilution - measured).abs() < 1e-4, "{} and {measured}", precision.dilution);
            assert!((precision.rms_m() - (told.xx + told.yy).sqrt()).abs() < 1e-12);
        }
    }
}

/// In decibels the estimate is the most likely position, whose covariance is the bound.
#[test]
fn the_covariance_in_decibels_is_the_bound_and_in_metres_never_below_it() {
    for at in [Point::new(6.0, 7.0), Point::new(15.0, 3.0), Point::new(9.0, -5.0)] {
        let told = |residual| estimate_with(&SQUARE, at, residual, 0, 0.0);
        let (decibels, metres) = (told(Residual::Decibels), told(Residual::Metres));
        let least = bound(SQUARE.into_iter(), decibels.at, &signal(1.0));
        assert_eq!(decibels.precision, least);
        let rms_m = |estimate: &Estimate| estimate.precision.expect("a precision").rms_m();
        assert!(rms_m(&metres) > rms_m(&decibels), "at {at:?}");
        let twice = bound(SQUARE.into_iter(), decibels.at, &signal(2.0)).expect("a bound");
        assert!((twice.rms_m() - 2.0 * rms_m(&decibels)).abs() < 1e-12, "at {at:?}");
    }
}

#[test]
fn the_corrected_order_comes_nearer_to_the_optimum_than_the_printed_one() {
    let mean_m = |order: Order| {
        let mut drawn = Congruence(5);
        let mut sum = 0.0;
        for _ in 0..300 {
            let ranges = wrong(&mut drawn);
            let optimum = locate(&ranges, Residual::Metres, &signal(1.0), None).expect("a fix").best().at;
            sum += swarm(&ranges, Parameters { order, ..Parameters::CONTRACTING }, &mut drawn)
                .distance_m(optimum)
                .min(1.0);
        }
        sum / 300.0
    };
    assert!(4.0 * mean_m(Order::Corrected) < mean_m(Order::Published));
}

#[test]
fn sizes_are_those_of_the_docs() {
    assert_eq!((size_of::<Range>(), size_of::<Particle>()), (24, 56));
    assert!(size_of::<Fix>() <= 200, "{}", size_of::<Fix>());
}

/// A motion of the plane: a turn, a mirror image or none before it, and a shift.
#[derive(Clone, Copy, Debug)]
struct Motion {
    degrees: f64,
    is_mirrored: bool,
    to: Point,
}

impl Motion {
    fn of(self, place: Point) -> Point {
        let (sine, cosine) = self.degrees.to_radians().sin_cos();
        let y_m = if self.is_mirrored { -place.y_m } else { place.y_m };
        let (x_m, y_m) = (cosine * place.x_m - sine * y_m, sine * place.x_m + cosine * y_m);
        Point::new(x_m + self.to.x_m, y_m + self.to.y_m)
    }
}

fn motions() -> impl Strategy<Value = Motion> {
    let parts = (0.0..360.0_f64, any::<bool>(), -50.0..50.0_f64, -50.0..50.0_f64);
    parts.prop_map(|(degrees, is_mirrored, x, y)| Motion { degrees, is_mirrored, to: Point::new(x, y) })
}

/// A way from distances to a position.
type Way = fn(&[Range]) -> Point;

fn by_metres(ranges: &[Range]) -> Point {
    locate(ranges, Residual::Metres, &signal(1.0), None).expect("a fix").best().at
}

fn by_decibels(ranges: &[Range]) -> Point {
    locate(ranges, Residual::Decibels, &signal(1.0), None).expect("a fix").best().at
}

fn by_equations(ranges: &[Range]) -> Point {
    linear(ranges).expect("a triangle")
}

/// Whether the position that `way` finds goes with the anchors.
fn goes_with(way: Way, ranges: &[Range], motion: Motion) -> bool {
    let moved: Vec<Range> =
        ranges.iter().map(|range| Range::new(motion.of(range.anchor), range.distance_m)).collect();
    way(&moved).distance_m(motion.of(way(ranges))) < 1e-5
}

#[test]
fn a_way_that_prefers_a_direction_does_not_go_with_its_anchors() {
    let drawn = wrong(&mut Congruence(1));
    let east: Way = |ranges| Point::new(by_metres(ranges).x_m + 1.0, by_metres(ranges).y_m);
    let north: Way = |ranges| Point::new(by_metres(ranges).x_m, by_metres(ranges).y_m.abs());
    let still = Motion { degrees: 0.0, is_mirrored: false, to: Point::default() };
    let (turn, mirror) = (Motion { degrees: 30.0, ..still }, Motion { is_mirrored: true, ..still });
    for way in [by_metres, by_decibels, by_equations, east, north] {
        assert!(goes_with(way, &drawn, still));
    }
    assert!(!goes_with(east, &drawn, turn) && goes_with(east, &drawn, mirror));
    assert!(!goes_with(north, &drawn, mirror));
}

/// Numbers of every kind, among them those that are none.
fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        -30.0..30.0_f64,
        any::<f64>(),
        Just(0.0),
        Just(f64::MIN_POSITIVE),
        -1e9..1e9_f64,
        Just(1e-160)
    ]
}

proptest! {
    #[test]
    fn no_position_has_a_coordinate_that_is_no_number(
        numbers in prop::collection::vec((any_number(), any_number(), any_number()), 0..6),
        noise_db in 0.0..100.0_f64,
        exponent in 2.0..5.0_f64,
    ) {
        let ranges: Vec<Range> = numbers.into_iter().map(|(x, y, d)| Range::new(Point::new(x, y), d)).collect();
        let signal = Signal::new(Propagation::new(exponent).expect("an exponent"), noise_db).expect("a noise");
        for found in [closed_form(&ranges), linear(&ranges)].into_iter().flatten() {
            prop_assert!(found.is_finite(), "{:?} of {:?}", found, ranges);
        }
        let area = Area::new(Point::new(-5.0, -5.0), Point::new(5.0, 7.0));
        let residuals = [Residual::Metres, Residual::Decibels];
        for (residual, area) in residuals.into_iter().flat_map(|residual| [(residual, None), (residual, area)]) {
            let fix = locate(&ranges, residual, &signal, area);
            let estimates = match &fix {
                Ok(Fix::One(one)) => vec![one],
                Ok(Fix::Two(one, other)) => vec![one, other],
                Err(_) => Vec::new(),
            };
            for estimate in estimates {
                let is_precise = estimate.precision.is_none_or(|it| it.rms_m() >= 0.0 && it.dilution >= 0.0);
                let is_sound = estimate.at.is_finite() && estimate.cost >= 0.0 && is_precise;
                prop_assert!(is_sound, "{:?} of {:?}", estimate, ranges);
            }
        }
        let mut particles = [Particle::UNUSED; 4];
        let start = Point::default();
        if let Ok(swarm) = Swarm::start(&ranges, start, Parameters::FALLING, &mut particles, &mut Congruence(2)) {
            prop_assert!(swarm.run(&mut Congruence(3)).is_finite());
        }
    }

    #[test]
    fn positions_are_moved_turned_and_mirrored_with_their_anchors(seed in any::<u64>(), motion in motions()) {
        let ranges = wrong(&mut Congruence(seed));
        for way in [by_metres, by_decibels, by_equations] {
            prop_assert!(goes_with(way, &ranges, motion), "{:?}", ranges);
        }
    }

    #[test]
    fn distances_without_noise_give_the_position_by_anchors_anywhere(
        anchors in prop::collection::vec((-50.0..50.0_f64, -50.0..50.0_f64), 3),
        (x, y) in (-50.0..50.0_f64, -50.0..50.0_f64),
    ) {
        let anchors: Vec<Point> = anchors.into_iter().map(|(x, y)| Point::new(x, y)).collect();
        let (ranges, at) = (ranges(&anchors, Point::new(x, y)), Point::new(x, y));
        // Equation (8) divides by what is between these two; nearly collinear anchors tell little.
        prop_assume!((anchors[2].x_m - anchors[1].x_m).abs() > 1.0 && Layout::of(&ranges).spread_m[1] > 3.0);
        for found in [closed_form(&ranges), linear(&ranges)] {
            let found = found.expect("a triangle");
            prop_assert!(found.distance_m(at) < 1e-6, "{found:?}, not {at:?}");
        }
    }

    #[test]
    fn the_best_of_a_swarm_never_worsens(seed in any::<u64>(), is_published in any::<bool>()) {
        let mut drawn = Congruence(seed);
        let order = if is_published { Order::Published } else { Order::Corrected };
        let ranges = wrong(&mut drawn);
        let mut particles = [Particle::UNUSED; 5];
        let parameters = Parameters { order, ..Parameters::CONTRACTING };
        let mut swarm = Swarm::start(&ranges, SQUARE[1], parameters, &mut particles, &mut drawn).expect("ranges");
        let mut before = f64::INFINITY;
        for _ in 0..20 {
            prop_assert!(swarm.best_cost() <= before);
            before = swarm.best_cost();
            swarm.step(&mut drawn);
        }
    }

    #[test]
    fn a_layout_keeps_distances(places in prop::collection::vec((-50.0..50.0_f64, -50.0..50.0_f64), 3..8)) {
        let ranges: Vec<Range> = places.iter().map(|&(x, y)| Range::new(Point::new(x, y), 1.0)).collect();
        let Layout { centre, along, spread_m: [most, least] } = Layout::of(&ranges);
        let squares: f64 = ranges.iter().map(|range| range.anchor.distance_m(centre).powi(2)).sum();
        prop_assert!((squares - most * most - least * least).abs() < 1e-9 * squares);
        prop_assert!(most >= least && (along.distance_m(Point::default()) - 1.0).abs() < 1e-12);
    }
}
