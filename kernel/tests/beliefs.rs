//! A belief of wheels and fixes (POSITION-7): its size, and the numbers that it does not take.

use tautline_kernel::frontier::{Condition, Rule, midpoint};
use tautline_kernel::ground::Cell;
use tautline_kernel::position::{
    Belief, Correction, Gate, Odometry, Point, Propagation, Range, Refusal, SightError, Signal,
    SymmetricMatrix, best_three,
};

const FIX: SymmetricMatrix = SymmetricMatrix { xx: 0.04, xy: 0.01, yy: 0.09 };

/// A robot that has driven a metre, turned by a quarter and driven two.
fn driven() -> Belief {
    let mut belief = Belief::known(Point::new(1.0, 2.0), 0.0);
    belief.driven(1.0, &Odometry::USUAL);
    belief.turned(core::f64::consts::FRAC_PI_2, &Odometry::USUAL);
    belief.driven(2.0, &Odometry::USUAL);
    belief
}

#[test]
fn wheels_that_err_by_less_than_nothing_or_by_no_number_are_refused() {
    assert_eq!(Odometry::new(0.0, 0.0), Some(Odometry::EXACT));
    assert_eq!(Odometry::new(0.02, 1.0), Some(Odometry::USUAL));
    for (share, degrees) in
        [(-0.01, 1.0), (0.02, -1.0), (f64::NAN, 1.0), (0.02, f64::NAN), (1.1, 1.0), (0.02, 91.0)]
    {
        assert_eq!(Odometry::new(share, degrees), None, "{share}, {degrees}");
    }
}

#[test]
fn an_outlier_changes_nothing_unless_the_gate_is_open() {
    let far = Point::new(9.0, 9.0);
    let mut belief = driven();
    assert_eq!(belief.corrected(far, FIX, Gate::Closed), Correction::Outlier);
    assert_eq!(belief, driven());
    assert_eq!(belief.corrected(far, FIX, Gate::Open), Correction::Taken);
    assert_ne!(belief.at(), driven().at());
}

#[test]
fn what_says_nothing_changes_nothing() {
    let certain = SymmetricMatrix::default();
    let nowhere = Point::new(f64::NAN, 0.0);
    let endless = SymmetricMatrix { xx: f64::INFINITY, ..FIX };
    for (fix, covariance) in [(nowhere, FIX), (driven().at(), endless)] {
        let mut belief = driven();
        assert_eq!(belief.corrected(fix, covariance, Gate::Open), Correction::Nothing);
        assert_eq!(belief, driven());
    }
    let mut known = Belief::known(Point::new(0.0, 0.0), 0.0);
    assert_eq!(known.corrected(Point::new(1.0, 0.0), certain, Gate::Open), Correction::Nothing);
}

#[test]
fn a_belief_that_is_lost_refuses_each_fix_and_takes_none() {
    let signal = Signal::new(Propagation::FREE_SPACE, 1.0).expect("a noise");
    let ranges = [(0.0, 0.0), (9.0, 0.0), (0.0, 9.0)].map(|(x, y)| Range::new(Point::new(x, y), 5.0));
    assert_eq!(driven().located(&ranges, &signal, Gate::Open), Ok(Correction::Taken));
    let turned = |turn_rad| {
        let mut belief = driven();
        belief.turned(turn_rad, &Odometry::USUAL);
        belief
    };
    let gone = |way_m| {
        let mut belief = driven();
        belief.driven(way_m, &Odometry::USUAL);
        belief
    };
    let nowhere = Belief::known(Point::new(f64::NAN, 0.0), 0.0);
    let no_heading = Belief::known(Point::new(0.0, 0.0), f64::NAN);
    let endless = [turned(f64::INFINITY), gone(f64::INFINITY), gone(1e300)];
    for mut belief in [turned(f64::NAN), gone(f64::NAN), nowhere, no_heading].into_iter().chain(endless) {
        assert_eq!(belief.fix(&ranges, &signal), Err(Refusal::NoPlace), "{belief:?}");
        assert_eq!(belief.located(&ranges, &signal, Gate::Open), Err(Refusal::NoPlace), "{belief:?}");
        let before = format!("{belief:?}");
        assert_eq!(belief.corrected(Point::new(1.0, 1.0), FIX, Gate::Open), Correction::Nothing, "{before}");
        assert_eq!(format!("{belief:?}"), before);
    }
}

#[test]
fn the_way_to_a_place_is_a_turn_and_a_drive() {
    let mut belief = driven();
    let to = Point::new(-3.0, 2.5);
    let (turn, way_m) = belief.towards(to);
    belief.turned(turn, &Odometry::EXACT);
    belief.driven(way_m, &Odometry::EXACT);
    assert!(belief.at().distance_m(to) < 1e-12);
    assert_eq!(belief.towards(belief.at()), (0.0, 0.0));
}

#[test]
fn a_robot_moves_only_if_it_will_be_within_the_next_cell_with_four_deviations_to_spare() {
    let mut belief = Belief::known(Point::new(0.0, 0.0), 0.0);
    let one_by_one = Odometry::new(0.05, 0.0).expect("errors");
    // After n moves and one more the deviation is 0.05 √(n + 1): below an eighth for n up to five.
    for moves in 0..8_i16 {
        let to = Cell::new(moves + 1, 0);
        assert_eq!(Rule::REPAIRED.may_go(&belief, to, &one_by_one), moves < 6, "{moves} moves");
        assert!(Rule::REPAIRED.without(Condition::Sure).may_go(&belief, to, &one_by_one));
        belief.driven(1.0, &one_by_one);
        assert!(belief.at().distance_m(midpoint(to)) < 1e-12);
    }
}

#[test]
fn the_best_three_anchors_are_near_and_all_around() {
    let anchors = [(0, 0), (20, 0), (0, 20), (20, 20), (9, 8), (12, 9), (10, 13)];
    let anchors = anchors.map(|(x, y)| Point::new(f64::from(x), f64::from(y)));
    let at = Point::new(10.3, 10.1);
    assert_eq!(best_three(&anchors, at), Some([anchors[4], anchors[5], anchors[6]]));
    let line = [0.0, 1.0, 2.0].map(|x_m| Point::new(x_m, 0.0));
    assert_eq!(best_three(&line, Point::new(5.0, 0.0)), None);
    assert_eq!(best_three(&anchors[..2], at), None);
}

#[test]
fn an_object_is_where_the_paper_has_it_and_two_sights_are_better_than_one() {
    let exact = SightError { bearing_rad: 0.0, distance_m: 0.0 };
    let (bearing, far) = (0.7, 2.0);
    let seen = Belief::known(Point::new(0.0, 0.0), 0.0).sees(bearing, far, &exact);
    assert!(seen.at.distance_m(Point::new(far * bearing.cos(), -far * bearing.sin())) < 1e-12);
    assert_eq!(seen.covariance.trace().to_bits(), 0.0_f64.to_bits());
    let sight = SightError { bearing_rad: 0.02, distance_m: 0.05 };
    let [one, other] = [0.3, -0.4].map(|bearing| driven().sees(bearing, far, &sight));
    let both = one.merged(other);
    assert!(both.covariance.trace() < one.covariance.trace().min(other.covariance.trace()));
    let between = one.at.distance_m(other.at);
    assert!(both.at.distance_m(one.at) < between && both.at.distance_m(other.at) < between);
}
