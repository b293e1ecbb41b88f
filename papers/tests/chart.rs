//! Line charts: what stands where in the picture, and that any numbers and texts give a whole one.

use insta::assert_snapshot;
use proptest::collection::vec;
use proptest::prelude::*;
use tautline_field::stats::Estimate;
use tautline_papers::chart::{Axis, LineChart, Point, Series, Stroke};

fn points(points: &[(f64, f64)]) -> Vec<Point> {
    points.iter().map(|&(x, y)| Point { x, y, interval: None }).collect()
}

fn series(name: &str, points: Vec<Point>) -> Series {
    Series { name: name.to_owned(), stroke: Stroke::Solid, points }
}

fn chart(series: Vec<Series>) -> LineChart {
    LineChart {
        title: "A chart".to_owned(),
        x: Axis::new("agents", ""),
        y: Axis::new("explored", "%"),
        series,
    }
}

/// Two series measured, and one that a paper prints.
fn explored() -> LineChart {
    let share = |hits, x| {
        let share = Estimate::share(hits, 200).expect("a share").times(100.0);
        Point { x, y: share.mean, interval: share.interval }
    };
    let bricks = [(1.0, 98), (10.0, 151), (20.0, 170), (40.0, 184)].map(|(x, hits)| share(hits, x));
    let ants = [1.0, 10.0, 20.0, 40.0].map(|x| share(200, x));
    let paper = Series {
        name: "Brick&Mortar, as the paper prints it".to_owned(),
        stroke: Stroke::Dashed,
        points: points(&[(1.0, 50.0)]),
    };
    let series = vec![series("Brick&Mortar", bricks.into()), paper, series("Ants", ants.into())];
    LineChart {
        title: "Explored cells by number of agents".to_owned(),
        x: Axis::new("agents", "").showing([0.0, 40.0]),
        y: Axis::new("explored", "%").showing([0.0, 100.0]),
        series,
    }
}

/// The elements of a picture, each as its name with attributes and the text right after it, checked to be nested.
fn elements(svg: &str) -> Vec<(String, String)> {
    let mut open = Vec::new();
    let mut elements = Vec::new();
    assert!(svg.starts_with('<'));
    for part in svg.split('<').skip(1) {
        let (tag, text) = part.split_once('>').expect("an end of the tag");
        if let Some(closed) = tag.strip_prefix('/') {
            assert_eq!(open.pop().as_deref(), Some(closed), "{svg}");
        } else {
            assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
            if !tag.ends_with('/') {
                open.push(tag.split(' ').next().unwrap_or(tag).to_owned());
            }
            elements.push((tag.to_owned(), text.to_owned()));
        }
        // Ampersands begin one of our four entities.
        let entities = ["amp;", "lt;", "gt;", "quot;"];
        let is_entity = |rest: &str| entities.iter().any(|entity| rest.starts_with(entity));
        assert!(part.split('&').skip(1).all(is_entity), "{part}");
    }
    assert!(open.is_empty(), "{svg}");
    elements
}

/// The body of the drawing.
fn body(svg: &str) -> &str {
    svg.split_once("</style>").expect("a style").1
}

fn attribute<'a>(tag: &'a str, name: &str) -> &'a str {
    let (_, rest) = tag.split_once(&format!(" {name}=\"")).expect("the attribute");
    rest.split('"').next().expect("its value")
}

/// The labels at the y axis and at the x axis, with their places.
fn labels(svg: &str) -> [Vec<(f64, f64)>; 2] {
    let texts: Vec<(String, String)> =
        elements(svg).into_iter().filter(|(tag, _)| tag.starts_with("text ")).collect();
    let read = |(tag, text): &(String, String), place: &str| {
        let number = text.replace('−', "-").parse::<f64>().expect("a number");
        (attribute(tag, place).parse::<f64>().expect("a place"), number)
    };
    let up =
        texts.iter().filter(|(tag, _)| tag.contains("class=\"end\"")).map(|text| read(text, "y")).collect();
    let plain = |tag: &str| tag.starts_with("text x=") && !tag.ends_with("y=\"355\"");
    let across = texts.iter().filter(|(tag, _)| plain(tag)).map(|text| read(text, "x")).collect();
    [up, across]
}

/// The places of the points of all series.
fn marks(svg: &str) -> Vec<(f64, f64)> {
    let drawn = elements(svg).into_iter().filter(|(tag, _)| tag.starts_with("path class=\"line\""));
    let paths: Vec<String> = drawn.map(|(tag, _)| attribute(&tag, "d").to_owned()).collect();
    let points =
        paths.iter().filter(|path| !path.contains('h')).flat_map(|path| path.split(['M', 'L']).skip(1));
    let place = |point: &str| {
        let (x, y) = point.split_once(' ').expect("two numbers");
        (x.parse().expect("a number"), y.parse().expect("a number"))
    };
    points.map(place).collect()
}

#[test]
fn a_chart_of_three_series() {
    assert_snapshot!(body(&explored().svg()));
}

#[test]
fn points_stand_where_the_ticks_say() {
    let square = chart(vec![series("a", points(&[(0.0, 0.0), (10.0, 50.0), (40.0, 100.0)]))]).svg();
    assert_eq!(marks(&square), [(0.0, 320.0), (140.0, 160.0), (560.0, 0.0)]);
    let [up, across] = labels(&square);
    assert_eq!(up, [(320.0, 0.0), (256.0, 20.0), (192.0, 40.0), (128.0, 60.0), (64.0, 80.0), (0.0, 100.0)]);
    assert_eq!(across.len(), 9);
    assert_eq!(across[1], (70.0, 5.0));
}

#[test]
fn an_axis_begins_at_a_number_that_is_round_and_holds_intervals() {
    // 0.3 by 0.05 is a little less than 6.
    let mut given = points(&[(0.3, 5.0), (0.7, 6.0)]);
    given[0].interval = Some([1.0, 9.0]);
    let [up, across] = labels(&chart(vec![series("a", given)]).svg());
    assert_eq!((across.first(), across.last()), (Some(&(0.0, 0.3)), Some(&(560.0, 0.7))));
    assert_eq!((up.first(), up.last()), (Some(&(320.0, 1.0)), Some(&(0.0, 9.0))));
}

#[test]
fn a_line_goes_from_left_to_right_in_whatever_order_its_points_come() {
    let given = [(3.0, 1.0), (1.0, 2.0), (2.0, 3.0)];
    let sorted = [(1.0, 2.0), (2.0, 3.0), (3.0, 1.0)];
    let drawn = |given: &[(f64, f64)]| chart(vec![series("a", points(given))]).svg();
    assert_eq!(drawn(&given), drawn(&sorted));
}

#[test]
fn one_point_or_none_or_equal_ones_give_a_chart() {
    for (given, shown) in [
        (vec![], vec![]),
        (vec![(0.0, 0.0)], vec![(0.0, 320.0)]),
        (vec![(20.0, 7.0)], vec![(560.0, 0.0)]),
        (vec![(20.0, -7.0)], vec![(560.0, 320.0)]),
        (vec![(2.0, 4.0), (2.0, 4.0)], vec![(560.0, 0.0), (560.0, 0.0)]),
    ] {
        let svg = chart(vec![series("a", points(&given))]).svg();
        assert_eq!(marks(&svg), shown, "{given:?}");
    }
    for given in [vec![], points(&[(0.0, 0.0)])] {
        let [up, across] = labels(&chart(vec![series("a", given)]).svg());
        assert_eq!((up.first(), up.last()), (Some(&(320.0, 0.0)), Some(&(0.0, 1.0))));
        assert_eq!(across.len(), up.len());
    }
}

#[test]
fn what_is_no_number_is_left_out() {
    let given = [(1.0, 1.0), (f64::NAN, 2.0), (2.0, f64::INFINITY), (3.0, 1e100), (2.0, 2.0)];
    let mut with = points(&given);
    with[0].interval = Some([f64::NEG_INFINITY, 3.0]);
    let without = points(&[(1.0, 1.0), (2.0, 2.0)]);
    assert_eq!(chart(vec![series("a", with)]).svg(), chart(vec![series("a", without)]).svg());
    let mut shows = chart(vec![]);
    shows.y = shows.y.showing([f64::NAN, f64::INFINITY]);
    assert_eq!(shows.svg(), chart(vec![]).svg());
}

#[test]
fn texts_are_escaped() {
    let text = "</text><script>\"a\" & 'b'\u{7}\u{ffff}";
    let mut hostile = chart(vec![series(text, points(&[(1.0, 1.0)]))]);
    hostile.title = text.to_owned();
    hostile.x = Axis::new(text, text);
    let svg = hostile.svg();
    let escaped = "&lt;/text&gt;&lt;script&gt;&quot;a&quot; &amp; 'b'\u{fffd}\u{fffd}";
    // The title is in an attribute, an element and the picture; the axis has a name and a unit.
    assert_eq!(
        (svg.matches(escaped).count(), elements(&svg).iter().any(|(tag, _)| tag == "script")),
        (6, false)
    );
}

#[test]
fn more_series_than_colours_differ_still() {
    let many = (0..12).map(|place| series("a", points(&[(f64::from(place), 1.0)]))).collect();
    let svg = chart(many).svg();
    let mut looks: Vec<(String, String)> = Vec::new();
    let mut class = String::new();
    for (tag, _) in elements(&svg) {
        if tag.starts_with("g class=") {
            class = attribute(&tag, "class").to_owned();
        } else if tag.starts_with("path class=\"marks\" d=\"M18 0") {
            looks.push((class.clone(), attribute(&tag, "d").to_owned()));
        }
    }
    assert_eq!(looks.len(), 12);
    looks.sort();
    looks.dedup();
    assert_eq!(looks.len(), 12);
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![-1000..1000_i32, -1_000_000..1_000_000_i32,]
        .prop_map(|number| f64::from(number) / 100.0)
        .boxed()
        .prop_union(any::<f64>().boxed())
}

proptest! {
    #[test]
    fn any_numbers_give_round_ticks_that_hold_them(given in vec((number(), number(), number(), number()), 0..6)) {
        let of = |&(x, y, low, high): &(f64, f64, f64, f64)| Point { x, y, interval: Some([low, high]) };
        let svg = chart(vec![series("a", given.iter().map(of).collect())]).svg();
        let lowered = body(&svg).to_lowercase();
        prop_assert!(!lowered.contains("nan") && !lowered.contains("inf"), "{svg}");
        for (x, y) in marks(&svg) {
            prop_assert!((0.0..=560.0).contains(&x) && (0.0..=320.0).contains(&y), "{svg}");
        }
        for ticks in labels(&svg) {
            prop_assert!((2..=11).contains(&ticks.len()), "{ticks:?}");
            let step = (ticks[ticks.len() - 1].1 - ticks[0].1) / f64::from(ticks.len() as u32 - 1);
            prop_assert!(step > 0.0, "{ticks:?}");
            // The labels are shorter where a number is large beside the step between.
            let digit = format!("{step:.6e}");
            let is_round = ["1.000000e", "2.000000e", "5.000000e"].iter().any(|round| digit.starts_with(round));
            prop_assert!(is_round || ticks[0].1.abs() > 1e6 * step, "{step} {ticks:?}");
            for pair in ticks.windows(2) {
                prop_assert!(pair[0].1 < pair[1].1);
            }
        }
    }
}
