//! Radio fields as SVG, for light and dark pages: nodes, the links of a navigation tree, obstacles, and the ways of
//! robots to those who wait for rescue (WFRs). North is up. The same field gives the same bytes everywhere. Any text
//! may stand in it; it is escaped.

use std::fmt::Write;

use crate::radio::{Field, Point};
use crate::rescue::Ordinal;
use tautline_io::svg::{MARGIN, SERIES, SERIES_STYLE, document, escaped, text_width};

/// The longest side of a map that stands alone, and of one among others.
const ALONE: i32 = 600;
const AMONG: i32 = 290;
/// Maps in a row.
const ROW: usize = 3;
/// The height of a line of text.
const LINE: i32 = 20;
/// The length of a sample in the legend.
const SAMPLE: i32 = 36;

/// A robot, round 0,0: a disc.
const ROBOT: &str = "m-6 0a6 6 0 1 0 12 0a6 6 0 1 0-12 0z";
/// A WFR: a star of four points.
const WFR: &str = "m0-9l2.5 6.5l6.5 2.5l-6.5 2.5l-2.5 6.5l-2.5-6.5l-6.5-2.5l6.5-2.5z";
/// Where a robot has given up: a cross.
const CROSS: &str = "m-5-5l10 10m0-10l-10 10";
/// Where a robot has failed: a square.
const SQUARE: &str = "m-5-5h10v10h-10z";

const STYLE: &str = "\
.rim{fill:none;stroke:var(--ink)}.obstacle{fill:var(--blocked);stroke:var(--blocked);stroke-width:2;\
stroke-linejoin:round}.start{text-anchor:start}.title{text-anchor:start;font-size:15px;font-weight:600}\
.tree{stroke:var(--blocked);stroke-opacity:.6;fill:none}.nodes{stroke:var(--ink);stroke-opacity:.45;stroke-width:2.5;\
stroke-linecap:round;fill:none}.trail{fill:none;stroke-width:2.5;stroke-linejoin:round}.terminus{fill:none;\
stroke-width:3}.wfr{fill:var(--bad);stroke:var(--ground)}.mark{stroke:var(--ground)}\
.trail-0{color:var(--series-0)}.trail-1{color:var(--series-1)}.trail-2{color:var(--series-2)}\
.trail-3{color:var(--series-3)}.trail-4{color:var(--series-4)}.trail-5{color:var(--series-5)}\
.trail,.terminus{stroke:currentColor}.mark{fill:currentColor}";

/// A field, and what has happened in it.
#[derive(Clone, PartialEq, Debug)]
pub struct Map<'a> {
    /// A caption of one line; empty for none.
    pub caption: String,
    /// The area, the obstacles and the nodes.
    pub field: &'a Field,
    /// How many of the nodes are drawn: robots may stand after them.
    pub nodes: usize,
    /// Links that are drawn, from place to place.
    pub links: Vec<[Point; 2]>,
    /// The ways of robots, the last one on top. Each has a colour of its own, up to six.
    pub trails: Vec<Trail>,
    /// Who waits for rescue.
    pub wfrs: Vec<Point>,
}

/// The way of a robot.
#[derive(Clone, PartialEq, Debug)]
pub struct Trail {
    /// Whose it is, for the legend.
    pub name: String,
    /// Its start and the places to which it went straight, one after the other. None at all is not drawn.
    pub places: Vec<Point>,
    /// How it ended.
    pub end: Terminus,
}

/// How the way of a robot ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Terminus {
    /// Where it wanted to be.
    There,
    /// Where it gave up, which is marked.
    GaveUp,
    /// Where it failed, which is marked.
    Failed,
}

impl Terminus {
    /// The mark, round 0,0.
    const fn mark(self) -> Option<&'static str> {
        match self {
            Self::There => None,
            Self::GaveUp => Some(CROSS),
            Self::Failed => Some(SQUARE),
        }
    }
}

/// A picture of maps beside each other.
pub fn picture(title: &str, maps: &[Map<'_>]) -> String {
    let side = if maps.len() == 1 { ALONE } else { AMONG };
    let (mut x, mut y, mut row_height) = (MARGIN, MARGIN + LINE + MARGIN / 2, 0);
    let mut width = MARGIN + text_width(title) * 5 / 4;
    // Writing to a string cannot fail.
    let mut body = format!(
        "<text class=\"title\" x=\"{MARGIN}\" y=\"{}\">{}</text>\n",
        MARGIN + LINE / 2,
        escaped(title)
    );
    for (place, map) in maps.iter().enumerate() {
        if place > 0 && place % ROW == 0 {
            (x, y, row_height) = (MARGIN, y + row_height + MARGIN, 0);
        }
        let drawn = Picture::of(map, side);
        let _ = writeln!(body, "<g transform=\"translate({x},{y})\">{}</g>", drawn.body);
        x += drawn.width + MARGIN;
        width = width.max(x);
        row_height = row_height.max(drawn.height);
    }
    y += row_height + LINE;
    let key = key(maps);
    let _ = writeln!(body, "<g transform=\"translate({MARGIN},{y})\">{}</g>", key.body);
    document(
        title,
        &format!("{SERIES_STYLE}{STYLE}"),
        (width.max(MARGIN + key.width) + MARGIN, y + LINE / 2 + MARGIN),
        &body,
    )
}

/// A part of the picture with its size, its corner at 0,0.
struct Picture {
    width: i32,
    height: i32,
    body: String,
}

impl Picture {
    fn of(map: &Map<'_>, side: i32) -> Self {
        let (scale, (width, height)) = Scale::of(map, side);
        let caption = escaped(&map.caption);
        let top = if caption.is_empty() { 0 } else { LINE };
        let mut body = String::new();
        if top > 0 {
            let _ = write!(body, "<text class=\"start\" y=\"{}\">{caption}</text>", LINE / 2 - 2);
        }
        let _ = writeln!(body, "<g transform=\"translate(0,{top})\">{}", ground(map, scale));
        for (look, trail) in map.trails.iter().enumerate() {
            body.push_str(&way(look, trail, scale));
        }
        for (number, &wfr) in (0..).map(Ordinal).zip(&map.wfrs) {
            let place = scale.place(wfr);
            // One alone needs no number.
            body.push_str(&if map.wfrs.len() > 1 { numbered(&place, number) } else { star(&place) });
        }
        body.push_str("</g>");
        let mut drawn = Self { width: width.max(text_width(&caption)), height: top + height, body };
        // One way alone needs no name beside the caption.
        if map.trails.len() > 1 {
            for (look, trail) in map.trails.iter().enumerate() {
                drawn.name(look, &trail.name);
            }
        }
        drawn
    }

    /// A line of the legend.
    fn name(&mut self, look: usize, name: &str) {
        let name = escaped(name);
        let y = self.height + LINE / 2;
        let _ = write!(
            self.body,
            "<g class=\"trail-{}\" transform=\"translate(0,{y})\"><path class=\"trail\" d=\"M0 0h{SAMPLE}\"/></g>\
             <text class=\"start\" x=\"{}\" y=\"{y}\">{name}</text>",
            look % SERIES,
            SAMPLE + 8
        );
        self.height += LINE;
        self.width = self.width.max(SAMPLE + 8 + text_width(&name));
    }
}

/// From metres to places in the picture.
#[derive(Clone, Copy)]
struct Scale(f64);

impl Scale {
    /// That at which a map has its longest side, and its size.
    fn of(map: &Map<'_>, side: i32) -> (Self, (i32, i32)) {
        let area = map.field.area();
        let scale = f64::from(side) / area.width_m().max(area.height_m());
        let size = |side_m: f64| (side_m * scale).ceil() as i32;
        (Self(scale), (size(area.width_m()), size(area.height_m())))
    }

    /// In tenths.
    fn place(self, point: Point) -> String {
        format!("{:.1} {:.1}", point.x_m * self.0, point.y_m * self.0)
    }
}

/// A WFR.
fn star(place: &str) -> String {
    format!("<path class=\"wfr\" d=\"M{place}{WFR}\"/>")
}

/// A WFR with its number.
fn numbered(place: &str, number: Ordinal) -> String {
    let (x, y) = place.split_once(' ').unwrap_or_default();
    format!("{}<text class=\"start\" dx=\"10\" x=\"{x}\" y=\"{y}\">{number}</text>", star(place))
}

/// The area with obstacles, links and nodes.
fn ground(map: &Map<'_>, scale: Scale) -> String {
    let (mut obstacles, mut links, mut nodes) = (String::new(), String::new(), String::new());
    for &obstacle in map.field.obstacles() {
        let [west, north, east, south] = obstacle.into();
        let [one, two, three, four] = [[west, north], [east, north], [east, south], [west, south]]
            .map(|[x_m, y_m]| scale.place(Point { x_m, y_m }));
        let _ = write!(obstacles, "M{one}L{two}L{three}L{four}z");
    }
    for &[from, to] in &map.links {
        let _ = write!(links, "M{}L{}", scale.place(from), scale.place(to));
    }
    for &node in map.field.nodes().iter().take(map.nodes) {
        let _ = write!(nodes, "M{}h0", scale.place(node));
    }
    let path = |class, d: String| {
        if d.is_empty() { d } else { format!("<path class=\"{class}\" d=\"{d}\"/>") }
    };
    let area = map.field.area();
    let corner = scale.place(Point { x_m: area.width_m(), y_m: area.height_m() });
    let (width, height) = corner.split_once(' ').unwrap_or_default();
    path("obstacle", obstacles)
        + &path("tree", links)
        + &path("nodes", nodes)
        + &format!("<path class=\"rim\" d=\"M0 0H{width}V{height}H0z\"/>")
}

/// The way of a robot, its start, and its end if that is marked.
fn way(look: usize, trail: &Trail, scale: Scale) -> String {
    let Some((&start, others)) = trail.places.split_first() else { return String::new() };
    let mut line = format!("M{}", scale.place(start));
    for &place in others {
        let _ = write!(line, "L{}", scale.place(place));
    }
    let end = others.last().copied().unwrap_or(start);
    let end = trail.end.mark().map_or(String::new(), |mark| {
        format!("<path class=\"terminus\" d=\"M{}{mark}\"/>", scale.place(end))
    });
    format!(
        "<g class=\"trail-{}\"><path class=\"trail\" d=\"{line}\"/><path class=\"mark\" d=\"M{}{ROBOT}\"/>{end}</g>\n",
        look % SERIES,
        scale.place(start)
    )
}

/// The meaning of the marks that there are, in one line.
fn key(maps: &[Map<'_>]) -> Picture {
    let has = |is_drawn: &dyn Fn(&Map<'_>) -> bool| maps.iter().any(is_drawn);
    let has_end = |end: Terminus| {
        has(&|map| map.trails.iter().any(|trail| trail.end == end && !trail.places.is_empty()))
    };
    let end = |mark: &str| format!("<g class=\"trail-0\"><path class=\"terminus\" d=\"M6 0{mark}\"/></g>");
    let mut key = Picture { width: 0, height: LINE, body: String::new() };
    let marks = [
        (has(&|map| map.nodes > 0), "<path class=\"nodes\" d=\"M6 0h0\"/>".to_owned(), "node"),
        (
            has(&|map| map.trails.iter().any(|trail| !trail.places.is_empty())),
            format!("<g class=\"trail-0\"><path class=\"mark\" d=\"M6 0{ROBOT}\"/></g>"),
            "robot at its start",
        ),
        (has(&|map| !map.wfrs.is_empty()), format!("<path class=\"wfr\" d=\"M6 0{WFR}\"/>"), "WFR"),
        (
            has(&|map| !map.links.is_empty()),
            "<path class=\"tree\" d=\"M-4 0h20\"/>".to_owned(),
            "to the parent",
        ),
        (
            has(&|map| !map.field.obstacles().is_empty()),
            "<path class=\"obstacle\" d=\"M-2-6h16v12h-16z\"/>".to_owned(),
            "obstacle",
        ),
        (has_end(Terminus::GaveUp), end(CROSS), "gave up"),
        (has_end(Terminus::Failed), end(SQUARE), "failed"),
    ];
    for (_, mark, meaning) in marks.into_iter().filter(|(is_drawn, ..)| *is_drawn) {
        let _ = write!(
            key.body,
            "<g transform=\"translate({},0)\">{mark}<text class=\"start\" x=\"22\" y=\"0\">{meaning}</text></g>",
            key.width
        );
        key.width += 22 + text_width(meaning) + MARGIN;
    }
    key
}
