//! Maps of radio fields: what stands where in the picture.

use insta::assert_snapshot;
use tautline_field::draw::field::{Map, Terminus, Trail, picture};
use tautline_field::radio::{Area, Field, Obstacle, Point};

const fn at(x_m: f64, y_m: f64) -> Point {
    Point { x_m, y_m }
}

fn field() -> Field {
    let area = Area::new(60.0, 30.0).expect("an area");
    let lake = Obstacle { west_m: 20.0, north_m: 10.0, east_m: 30.0, south_m: 20.0 };
    Field::new(area, vec![lake], vec![at(5.0, 5.0), at(25.0, 5.0), at(45.0, 5.0), at(1.0, 29.0)])
        .expect("a field")
}

fn trail(name: &str, end: Terminus) -> Trail {
    Trail { name: name.to_owned(), places: vec![at(45.0, 25.0), at(45.0, 5.0), at(5.0, 5.0)], end }
}

fn map(field: &Field, trails: Vec<Trail>) -> Map<'_> {
    let links = vec![[at(25.0, 5.0), at(5.0, 5.0)]];
    Map { caption: "By <TAN>".to_owned(), field, nodes: 3, links, trails, wfrs: vec![at(5.0, 5.0)] }
}

#[test]
fn a_map_of_two_robots() {
    let field = field();
    let trails = vec![trail("Robot 1", Terminus::There), trail("Robot \"2\"", Terminus::GaveUp)];
    assert_snapshot!(picture("Two robots & a lake", &[map(&field, trails)]));
}

#[test]
fn one_robot_needs_no_name_and_its_end_is_marked_if_it_gave_up_or_failed() {
    let field = field();
    let drawn = |end| picture("A robot", &[map(&field, vec![trail("Robot 1", end)])]);
    let ends = [Terminus::There, Terminus::GaveUp, Terminus::Failed].map(drawn);
    // One is in the key.
    let marks = |drawn: &String| drawn.matches("class=\"terminus\"").count();
    assert_eq!(ends.each_ref().map(marks), [0, 2, 2]);
    let words = |drawn: &String| ["gave up", "failed"].map(|word| drawn.contains(&format!(">{word}<")));
    assert_eq!(ends.each_ref().map(words), [[false, false], [true, false], [false, true]]);
    assert!(!ends[0].contains("Robot 1"));
}

#[test]
fn maps_stand_three_in_a_row() {
    let field = field();
    let maps = vec![map(&field, vec![]); 4];
    let places: Vec<String> = picture("Maps", &maps)
        .lines()
        .filter_map(|line| line.strip_prefix("<g transform=\"translate("))
        .filter(|line| line.contains("By &lt;TAN&gt;"))
        .filter_map(|line| line.split_once(')').map(|(place, _)| place.to_owned()))
        .collect();
    let [first, second, third, fourth] = &places[..] else { panic!("{places:?}") };
    let row = |place: &str| place.split_once(',').map(|(_, y)| y.to_owned());
    assert_eq!([row(second), row(third)], [row(first), row(first)]);
    assert!(row(fourth) != row(first) && fourth.split(',').next() == first.split(',').next());
}
