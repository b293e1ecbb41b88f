//! Positions as SVG, for light and dark pages: anchors, where a robot is, where it took itself to be, the ellipse of
//! its errors and that of the Cramér–Rao bound. +y is up. The same positions give the same bytes everywhere.

use std::fmt::Write;

use tautline_kernel::position::Point;

use crate::position::analysis::Ellipse;
use crate::position::{FixReport, Place, Spot};
use tautline_io::svg::{MARGIN, SERIES_STYLE, document, escaped, text_width};

/// The longest side of the ground.
const SIDE: f64 = 600.0;
/// The height of a line of text.
const LINE: i32 = 20;
/// The margin round the ground, in proportion to its longer side, in which errors may be drawn.
const RIM: f64 = 0.25;

/// The most ticks along a side.
const MOST_TICKS: f64 = 8.0;

/// An anchor, round 0,0: a triangle.
const ANCHOR: &str = "m0-8l7 12h-14z";
/// A robot, round 0,0: a cross.
const ROBOT: &str = "m-5 0h10m-5-5v10";

const STYLE: &str = "\
.title{text-anchor:start;font-size:15px;font-weight:600}.start{text-anchor:start}.rim{fill:none;stroke:var(--faint)}\
.anchor{fill:var(--ink)}.robot{fill:none;stroke:var(--ink);stroke-width:2}\
.found{stroke:var(--series-0);stroke-opacity:.35;stroke-width:3;stroke-linecap:round;fill:none}\
.tick{stroke:var(--ink)}\
.errors{fill:none;stroke:var(--series-0);stroke-width:2}.bound{fill:none;stroke:var(--series-1);stroke-width:2;\
stroke-dasharray:6 4}";

/// The picture of trials at some places.
pub fn spots(title: &str, anchors: &[Point], spots: &[Spot]) -> String {
    let ground = Ground::of(anchors.iter().copied().chain(spots.iter().map(|spot| spot.at)));
    let mut body = ground.anchors(anchors);
    // Writing to a string cannot fail.
    for spot in spots {
        body += &ground.points("found", &spot.found);
        let ellipses = [("errors", spot.errors), ("bound", spot.bound)];
        for (class, ellipse) in ellipses.into_iter().filter_map(|(class, ellipse)| Some((class, ellipse?))) {
            body += &ground.ellipse(class, &ellipse);
        }
        let _ = writeln!(body, "<path class=\"robot\" d=\"M{}{ROBOT}\"/>", ground.place(spot.at));
    }
    let key = [
        (format!("<path class=\"anchor\" d=\"M8 2{ANCHOR}\"/>"), "anchor"),
        (format!("<path class=\"robot\" d=\"M8 0{ROBOT}\"/>"), "robot"),
        ("<path class=\"found\" d=\"M4 0h0M9-3h0M12 2h0\"/>".to_owned(), "position found"),
        ("<ellipse class=\"errors\" cx=\"8\" rx=\"9\" ry=\"5\"/>".to_owned(), "95 % of them"),
        ("<ellipse class=\"bound\" cx=\"8\" rx=\"9\" ry=\"5\"/>".to_owned(), "95 % at the Cramér–Rao bound"),
    ];
    ground.picture(title, &body, &key)
}

/// The picture of positions found in measurements.
pub fn found(title: &str, anchors: &[Point], found: &[FixReport]) -> String {
    let places = || found.iter().flat_map(|found| &found.positions);
    let ground = Ground::of(anchors.iter().copied().chain(places().map(Place::at)));
    let mut body = ground.anchors(anchors);
    for place in places() {
        body += &place.ellipse.map_or_else(String::new, |ellipse| ground.ellipse("errors", &ellipse));
    }
    body += &ground.points("found", &places().map(Place::at).collect::<Vec<_>>());
    let key = [
        (format!("<path class=\"anchor\" d=\"M8 2{ANCHOR}\"/>"), "anchor"),
        ("<path class=\"found\" d=\"M8 0h0\"/>".to_owned(), "position found"),
        ("<ellipse class=\"errors\" cx=\"8\" rx=\"9\" ry=\"5\"/>".to_owned(), "where the robot is with 95 %"),
    ];
    ground.picture(title, &body, &key)
}

/// From metres to places in the picture.
struct Ground {
    least: Point,
    greatest: Point,
    scale: f64,
}

impl Ground {
    /// The ground that shows these places, with a margin for what is wrong about them.
    fn of(places: impl Iterator<Item = Point>) -> Self {
        let far = [f64::INFINITY, f64::NEG_INFINITY];
        let wider = |[least, most]: [f64; 2], at: f64| [least.min(at), most.max(at)];
        let (x, y) = places.fold((far, far), |(x, y), place| (wider(x, place.x_m), wider(y, place.y_m)));
        let side_m = (x[1] - x[0]).max(y[1] - y[0]).max(f64::MIN_POSITIVE);
        let rim_m = RIM * side_m;
        Self {
            least: Point::new(x[0] - rim_m, y[0] - rim_m),
            greatest: Point::new(x[1] + rim_m, y[1] + rim_m),
            scale: SIDE / (side_m + 2.0 * rim_m),
        }
    }

    fn size(&self) -> (i32, i32) {
        let size = |from: f64, to: f64| ((to - from) * self.scale).ceil() as i32;
        (size(self.least.x_m, self.greatest.x_m), size(self.least.y_m, self.greatest.y_m))
    }

    fn pair(&self, place: Point) -> (f64, f64) {
        ((place.x_m - self.least.x_m) * self.scale, (self.greatest.y_m - place.y_m) * self.scale)
    }

    /// Ticks along the lower and the left rim, with metres.
    fn ticks(&self) -> String {
        let side_m = (self.greatest.x_m - self.least.x_m).max(self.greatest.y_m - self.least.y_m);
        // 0.001, 0.002, 0.005, 0.01 and so on.
        let mut factors = [2.0, 2.5, 2.0].into_iter().cycle();
        let mut step_m = 0.001;
        while side_m / step_m > MOST_TICKS {
            step_m *= factors.next().unwrap_or(2.0);
        }
        let along = |from: f64, to: f64| {
            let count = ((to - from) / step_m) as i32;
            let first = (from / step_m).ceil();
            // A corner has no room for words.
            let is_inside = move |at: &f64| (at - from).min(to - at) > step_m / 4.0;
            (0..=count).map(move |tick| (first + f64::from(tick)) * step_m).filter(is_inside)
        };
        let metres = |at: f64| {
            // Zero has no sign.
            let text = format!("{:.3}", at + 0.0);
            format!("{} m", text.trim_end_matches('0').trim_end_matches('.'))
        };
        let (_, height) = self.size();
        let mut text = String::new();
        // Writing to a string cannot fail.
        for x_m in along(self.least.x_m, self.greatest.x_m) {
            let (x, label) = (self.pair(Point::new(x_m, 0.0)).0, metres(x_m));
            let tick = format!("<path class=\"tick\" d=\"M{x:.1} {height}v-6\"/>");
            let _ = writeln!(
                text,
                "{tick}<text class=\"small\" x=\"{x:.1}\" y=\"{}\">{label}</text>",
                height - 14
            );
        }
        for y_m in along(self.least.y_m, self.greatest.y_m) {
            let (y, label) = (self.pair(Point::new(0.0, y_m)).1, metres(y_m));
            let tick = format!("<path class=\"tick\" d=\"M0 {y:.1}h6\"/>");
            let _ = writeln!(text, "{tick}<text class=\"small start\" x=\"9\" y=\"{y:.1}\">{label}</text>");
        }
        text
    }

    /// In tenths.
    fn place(&self, place: Point) -> String {
        let (x, y) = self.pair(place);
        format!("{x:.1} {y:.1}")
    }

    fn has(&self, place: Point) -> bool {
        (self.least.x_m..=self.greatest.x_m).contains(&place.x_m)
            && (self.least.y_m..=self.greatest.y_m).contains(&place.y_m)
    }

    fn anchors(&self, anchors: &[Point]) -> String {
        let mut d = String::new();
        for &anchor in anchors {
            let _ = write!(d, "M{}{ANCHOR}", self.place(anchor));
        }
        format!("<path class=\"anchor\" d=\"{d}\"/>\n")
    }

    /// Dots at the places that are on the ground.
    fn points(&self, class: &str, places: &[Point]) -> String {
        let mut d = String::new();
        for &place in places.iter().filter(|&&place| self.has(place)) {
            let _ = write!(d, "M{}h0", self.place(place));
        }
        format!("<path class=\"{class}\" d=\"{d}\"/>\n")
    }

    fn ellipse(&self, class: &str, ellipse: &Ellipse) -> String {
        let [x_m, y_m] = ellipse.middle_m;
        let (x, y) = self.pair(Point::new(x_m, y_m));
        let [long, short] = ellipse.half_axes_m.map(|half_m| half_m * self.scale);
        // Degrees of a picture turn the other way.
        format!(
            "<ellipse class=\"{class}\" rx=\"{long:.1}\" ry=\"{short:.1}\" \
                transform=\"translate({x:.1},{y:.1})rotate({:.1})\"/>\n",
            -ellipse.degrees
        )
    }

    /// The whole picture: the title, the ground with `body`, cut off at its rim, and the key.
    fn picture(&self, title: &str, body: &str, key: &[(String, &str)]) -> String {
        let (width, height) = self.size();
        let top = MARGIN + LINE + MARGIN / 2;
        let mut whole = format!(
            "<text class=\"title\" x=\"{MARGIN}\" y=\"{}\">{}</text>\n\
             <svg x=\"{MARGIN}\" y=\"{top}\" width=\"{width}\" height=\"{height}\">\n\
             <rect class=\"rim\" width=\"{width}\" height=\"{height}\"/>\n{}{body}</svg>\n",
            MARGIN + LINE / 2,
            escaped(title),
            self.ticks(),
        );
        let (mut x, y) = (MARGIN, top + height + LINE);
        for (mark, meaning) in key {
            let _ = writeln!(
                whole,
                "<g transform=\"translate({x},{y})\">{mark}<text class=\"start\" x=\"24\" y=\"0\">{meaning}</text></g>"
            );
            x += 24 + text_width(meaning) + MARGIN;
        }
        let widest = [MARGIN + width, x, MARGIN + text_width(title) * 5 / 4];
        let width = widest.into_iter().max().unwrap_or(0) + MARGIN;
        document(title, &format!("{SERIES_STYLE}{STYLE}"), (width, y + LINE / 2 + MARGIN), &whole)
    }
}
