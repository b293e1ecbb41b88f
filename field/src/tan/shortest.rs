//! The shortest way between two places round the obstacles of a field: straight from corner to corner. Corners are
//! passed a micrometre off, so that the way meets no obstacle, and obstacles that touch each other leave no gap.

use super::ear::apart_m;
use super::walker::is_open;
use crate::radio::{Field, Point};

/// How far off a corner is passed, in metres, along each axis.
const OFF_M: f64 = 1e-6;

/// The length of the shortest way, in metres, inside the area and through no obstacle; `None` if there is none.
pub fn shortest_m(field: &Field, from: Point, to: Point) -> Option<f64> {
    let corners = field.obstacles().iter().flat_map(|obstacle| {
        let columns = [obstacle.west_m - OFF_M, obstacle.east_m + OFF_M];
        let rows = [obstacle.north_m - OFF_M, obstacle.south_m + OFF_M];
        columns.into_iter().flat_map(move |x_m| rows.map(|y_m| Point { x_m, y_m }))
    });
    let places: Vec<Point> = [from, to].into_iter().chain(corners).collect();
    let mut lengths_m = vec![f64::INFINITY; places.len()];
    let mut is_settled = vec![false; places.len()];
    lengths_m[0] = 0.0;
    loop {
        let open = (0..places.len()).filter(|&place| !is_settled[place] && lengths_m[place].is_finite());
        let here = open.min_by(|&one, &other| lengths_m[one].total_cmp(&lengths_m[other]))?;
        if here == 1 {
            return Some(lengths_m[1]);
        }
        is_settled[here] = true;
        let so_far_m = lengths_m[here];
        for (length_m, &place) in lengths_m.iter_mut().zip(&places) {
            if is_open(field, places[here], place) {
                *length_m = length_m.min(so_far_m + apart_m(places[here], place));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::radio::{Area, Obstacle};

    fn at(x_m: f64, y_m: f64) -> Point {
        Point { x_m, y_m }
    }

    fn field(obstacles: Vec<Obstacle>) -> Field {
        let area = Area::new(10.0, 10.0).expect("an area");
        Field::new(area, obstacles, vec![at(0.0, 0.0), at(10.0, 10.0)]).expect("a field")
    }

    const fn lake(west_m: f64, north_m: f64, east_m: f64, south_m: f64) -> Obstacle {
        Obstacle { west_m, north_m, east_m, south_m }
    }

    fn is_about(length_m: Option<f64>, expected_m: f64) -> bool {
        length_m.is_some_and(|length_m| (length_m - expected_m).abs() < 1e-4)
    }

    #[test]
    fn the_way_is_straight_where_it_can_be_and_round_the_nearer_corners_else() {
        let field = field(vec![lake(4.0, 2.0, 6.0, 7.0)]);
        assert!(is_about(shortest_m(&field, at(1.0, 1.0), at(9.0, 1.0)), 8.0));
        let over = 2.0 * (9_f64 + 4.0).sqrt() + 2.0;
        assert!(is_about(shortest_m(&field, at(1.0, 4.0), at(9.0, 4.0)), over));
        let under = 2.0 * (9_f64 + 1.0).sqrt() + 2.0;
        assert!(is_about(shortest_m(&field, at(1.0, 6.0), at(9.0, 6.0)), under));
    }

    #[test]
    fn there_is_no_way_through_walls_that_touch_or_past_the_rim() {
        let across = |west_m, east_m| lake(west_m, 5.0, east_m, 5.0);
        let shortest = |obstacles| shortest_m(&field(obstacles), at(5.0, 1.0), at(5.0, 9.0));
        assert_eq!(shortest(vec![across(0.0, 5.0), across(5.0, 10.0)]), None);
        let gap_m = 2.0 * (16_f64 + 0.01).sqrt();
        assert!(is_about(shortest(vec![across(0.0, 5.1), across(5.2, 10.0)]), gap_m));
    }

    /// The shortest way over any sequence of corners, tried one after the other.
    fn tried(field: &Field, from: Point, to: Point, corners: &[Point]) -> f64 {
        let straight = if is_open(field, from, to) { apart_m(from, to) } else { f64::INFINITY };
        (0..corners.len())
            .filter(|&first| is_open(field, from, corners[first]))
            .map(|first| {
                let others: Vec<Point> = corners
                    .iter()
                    .enumerate()
                    .filter(|&(other, _)| other != first)
                    .map(|(_, &point)| point)
                    .collect();
                apart_m(from, corners[first]) + tried(field, corners[first], to, &others)
            })
            .fold(straight, f64::min)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn no_way_over_corners_is_shorter(
            places in prop::array::uniform8(0.5..9.5_f64), sizes in prop::array::uniform4(0.1..3.0_f64)
        ) {
            let [x, y, to_x, to_y, west, north, other_west, other_north] = places;
            let end = |start: f64, size: f64| (start + size).min(9.9);
            let one = lake(west, north, end(west, sizes[0]), end(north, sizes[1]));
            let other = lake(other_west, other_north, end(other_west, sizes[2]), end(other_north, sizes[3]));
            let (from, to) = (at(x, y), at(to_x, to_y));
            prop_assume!([one, other].iter().all(|lake| !lake.contains(from) && !lake.contains(to)));
            let field = field(vec![one, other]);
            let corners: Vec<Point> = [one, other]
                .iter()
                .flat_map(|lake| {
                    [lake.west_m - OFF_M, lake.east_m + OFF_M]
                        .into_iter()
                        .flat_map(|x| [lake.north_m - OFF_M, lake.south_m + OFF_M].map(|y| at(x, y)))
                })
                .collect();
            let naive = tried(&field, from, to, &corners);
            match shortest_m(&field, from, to) {
                None => prop_assert!(naive.is_infinite()),
                Some(ours) => prop_assert!((ours - naive).abs() < 1e-9, "{} {}", ours, naive),
            }
        }
    }
}
