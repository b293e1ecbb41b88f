//! Line charts as SVG, for light and dark pages: series of points with 95 % intervals over round ticks. Series differ
//! by colour and by mark; dashed ones with hollow marks are what a paper prints. The same chart gives the same bytes
//! everywhere. Any text may stand in it; it is escaped.

use std::fmt::Write;

use tautline_field::stats::Estimate;
use tautline_io::svg::{MARGIN, SERIES, SERIES_STYLE, document, escaped, text_width};

/// The size of the area of the points.
const WIDTH: i32 = 560;
const HEIGHT: i32 = 320;
/// The height of a line of text.
const LINE: i32 = 20;
/// The length of a tick, and half the size of a mark.
const TICK: i32 = 5;
/// The sample of a series in the legend.
const SAMPLE: i32 = 36;
/// The most steps between ticks.
const MOST_STEPS: f64 = 8.0;
/// Numbers of this size or more are not drawn, so that nothing overflows.
const TOO_LARGE: f64 = 1e100;

/// The marks, round 0,0. They go round after another number than colours, so that more series differ too.
const MARKS: [&str; 5] = [
    "m-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0z",
    "m-4-4h8v8h-8z",
    "m0-5l5 9h-10z",
    "m0-5l5 5l-5 5l-5-5z",
    "m0 5l5-9h-10z",
];

const STYLE: &str = "\
.title{text-anchor:start;font-size:15px;font-weight:600}.start{text-anchor:start}.end{text-anchor:end}\
.axes{stroke:var(--ink);fill:none}.line{fill:none;stroke-width:2;stroke-linejoin:round}\
.interval{fill:none;stroke-width:1.5;stroke-opacity:.7}.marks{stroke-width:2}\
.dashed .line{stroke-dasharray:6 4}.dashed .marks{fill:var(--ground)}\
.series-0{stroke:var(--series-0);fill:var(--series-0)}.series-1{stroke:var(--series-1);fill:var(--series-1)}\
.series-2{stroke:var(--series-2);fill:var(--series-2)}.series-3{stroke:var(--series-3);fill:var(--series-3)}\
.series-4{stroke:var(--series-4);fill:var(--series-4)}.series-5{stroke:var(--series-5);fill:var(--series-5)}";

/// A chart.
#[derive(Clone, PartialEq, Debug)]
pub struct LineChart {
    /// A title of one line.
    pub title: String,
    /// From left to right.
    pub x: Axis,
    /// From below to above.
    pub y: Axis,
    /// Drawn one over the other, the last one on top.
    pub series: Vec<Series>,
}

/// An axis of a chart.
#[derive(Clone, PartialEq, Debug)]
pub struct Axis {
    /// The quantity that it measures.
    pub name: String,
    /// In what; empty for plain numbers.
    pub unit: String,
    /// Numbers that it shows in any case, beside those of the points: 0 and 100 for percent.
    pub shows: Vec<f64>,
}

/// Points that belong together.
#[derive(Clone, PartialEq, Debug)]
pub struct Series {
    /// The series' name.
    pub name: String,
    /// How they are drawn.
    pub stroke: Stroke,
    /// In any order; the line goes from left to right. Those that are not numbers, or 10¹⁰⁰ and more, are left out.
    pub points: Vec<Point>,
}

/// How a series is drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Stroke {
    /// A solid line with filled marks: measured.
    Solid,
    /// A dashed line with hollow marks, in the colour of the last solid series before: a paper's own points.
    Dashed,
}

/// A point of a series, in the units of the axes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Point {
    /// Along.
    pub x: f64,
    /// Up.
    pub y: f64,
    /// The ends of its 95 % interval, if it has one.
    pub interval: Option<[f64; 2]>,
}

impl Series {
    /// A series of points that are measured.
    pub fn measured(name: impl Into<String>, points: impl IntoIterator<Item = Point>) -> Self {
        Self { name: name.into(), stroke: Stroke::Solid, points: points.into_iter().collect() }
    }

    /// A series of points that a paper prints.
    pub fn printed(name: impl Into<String>, points: impl IntoIterator<Item = Point>) -> Self {
        Self { stroke: Stroke::Dashed, ..Self::measured(name, points) }
    }

    /// The points that can be drawn. An interval that cannot be drawn is left out.
    fn shown(&self) -> impl Iterator<Item = Point> {
        let points = self.points.iter().filter(|point| is_drawn(point.x) && is_drawn(point.y));
        points.map(|&point| Point {
            interval: point.interval.filter(|ends| ends.iter().all(|&end| is_drawn(end))),
            ..point
        })
    }
}

impl Point {
    /// A point without an interval.
    pub const fn plain(x: f64, y: f64) -> Self {
        Self { x, y, interval: None }
    }

    /// A mean or a share with its interval, at `x`.
    pub const fn of(x: f64, estimate: Estimate) -> Self {
        Self { x, y: estimate.mean, interval: estimate.interval }
    }
}

impl Axis {
    /// An axis of `name` in `unit`, as long as the points need.
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into(), shows: Vec::new() }
    }

    /// The axis reaches from the one to the other at least.
    #[must_use]
    pub fn showing(mut self, numbers: [f64; 2]) -> Self {
        self.shows.extend(numbers);
        self
    }

    fn words(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" ({})", self.unit) };
        escaped(&(self.name.clone() + &unit))
    }
}

impl LineChart {
    /// A chart of these series.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis, series: impl IntoIterator<Item = Series>) -> Self {
        Self { title: title.into(), x, y, series: series.into_iter().collect() }
    }

    /// The chart without series that have no point.
    #[must_use]
    pub fn without_empty(mut self) -> Self {
        self.series.retain(|series| !series.points.is_empty());
        self
    }

    /// The whole picture.
    pub fn svg(&self) -> String {
        let shown = || self.series.iter().flat_map(Series::shown);
        let across = shown().map(|point| point.x);
        let up = shown().flat_map(|point| [Some([point.y; 2]), point.interval]).flatten().flatten();
        let across = Scale::of(across.chain(self.x.shows.iter().copied()), WIDTH);
        let up = Scale::of(up.chain(self.y.shows.iter().copied()), HEIGHT);

        let (title, x_name, y_name) = (&self.title, self.x.words(), self.y.words());
        let left = MARGIN + 2 * TICK + up.ticks.iter().map(|tick| text_width(&tick.label)).max().unwrap_or(0);
        let top = MARGIN + 3 * LINE;
        let below = HEIGHT + 3 * LINE;
        let (middle, x_name_at) = (LINE / 2, HEIGHT + LINE / 2 + TICK + LINE);
        // Writing to a string cannot fail.
        let mut body = format!(
            "<text class=\"title\" x=\"{MARGIN}\" y=\"{}\">{}</text>",
            MARGIN + middle,
            escaped(title)
        );
        let _ = writeln!(body, "<text class=\"start\" x=\"{MARGIN}\" y=\"{}\">{y_name}</text>", top - LINE);
        let _ = writeln!(body, "<g transform=\"translate({left},{top})\">{}", axes(&across, &up));
        let _ = writeln!(body, "<text x=\"{}\" y=\"{x_name_at}\">{x_name}</text>", WIDTH / 2);
        let mut solid = 0_usize;
        for (place, series) in self.series.iter().enumerate() {
            solid += match series.stroke {
                Stroke::Solid => 1,
                Stroke::Dashed => 0,
            };
            let look = solid.saturating_sub(1);
            let _ = writeln!(body, "{}", drawn(look, series, &across, &up));
            let y = below + LINE * place as i32;
            let sample = legend(look, series);
            let _ = writeln!(body, "<g transform=\"translate(0,{y})\">{sample}</g>");
        }
        body.push_str("</g>\n");
        let names = self.series.iter().map(|series| left + SAMPLE + 2 * TICK + text_width(&series.name));
        // The title is larger than other text, and the last label sticks out by half.
        let texts = [
            left + WIDTH + LINE,
            left + WIDTH / 2 + text_width(&x_name) / 2,
            MARGIN + text_width(&y_name),
            MARGIN + text_width(title) * 5 / 4,
        ];
        let width = names.chain(texts).max().unwrap_or(0) + MARGIN;
        document(
            title,
            &format!("{SERIES_STYLE}{STYLE}"),
            (width, top + below + LINE * self.series.len() as i32),
            &body,
        )
    }
}

fn is_drawn(number: f64) -> bool {
    number.abs() < TOO_LARGE
}

/// From numbers to places in the picture.
struct Scale {
    least: f64,
    greatest: f64,
    length: i32,
    ticks: Vec<Tick>,
}

/// A round number.
struct Tick {
    number: f64,
    label: String,
}

impl Scale {
    /// A scale with all these numbers, from one tick to another.
    fn of(numbers: impl Iterator<Item = f64>, length: i32) -> Self {
        let ends = numbers.filter(|&number| is_drawn(number)).map(|number| (number, number));
        let ends = ends.reduce(|(least, greatest), (number, _)| (least.min(number), greatest.max(number)));
        let (least, greatest) = match ends {
            None | Some((0.0, 0.0)) => (0.0, 1.0),
            // One number is seen by its distance from 0.
            Some((least, greatest)) if greatest <= least => (least.min(0.0), greatest.max(0.0)),
            Some(ends) => ends,
        };
        let ticks = ticks(least, greatest);
        let end = |tick: Option<&Tick>, otherwise| tick.map_or(otherwise, |tick| tick.number);
        Self { least: end(ticks.first(), least), greatest: end(ticks.last(), greatest), length, ticks }
    }

    /// From the left, in tenths.
    fn along(&self, number: f64) -> String {
        format!("{:.1}", f64::from(self.length) * (number - self.least) / (self.greatest - self.least))
    }

    /// From above, in tenths.
    fn down(&self, number: f64) -> String {
        format!("{:.1}", f64::from(self.length) * (self.greatest - number) / (self.greatest - self.least))
    }
}

/// Multiples of 1, 2 or 5 times a power of ten, [`MOST_STEPS`] or one more apart at most, from below `least` to above
/// `greatest`. Powers of ten are read from decimals, which rounds alike everywhere.
fn ticks(least: f64, greatest: f64) -> Vec<Tick> {
    let spread = greatest - least;
    let exponent = format!("{spread:e}").split_once('e').and_then(|(_, exponent)| exponent.parse().ok());
    let exponent: i32 = exponent.unwrap_or(0);
    let steps = (exponent - 1..=exponent + 1).flat_map(|exponent| [1, 2, 5].map(|digit| (digit, exponent)));
    let size = |(digit, exponent): (i64, i32)| decimal(digit, exponent).1;
    let fitting = steps.into_iter().find(|&step| spread / size(step) <= MOST_STEPS);
    let step = fitting.unwrap_or((1, exponent + 1));
    // A number that is a tick but for rounding is one.
    let steps_to = |number: f64| {
        let steps = number / size(step);
        if (steps - steps.round()).abs() < 1e-9 { steps.round() } else { steps }
    };
    let (first, last) = (steps_to(least).floor() as i64, steps_to(greatest).ceil() as i64);
    (first..=last.max(first.saturating_add(1)))
        .map(|steps| decimal(steps.saturating_mul(step.0), step.1))
        .map(|(label, number)| Tick { number, label })
        .collect()
}

/// `digits`·10^`exponent`, written out, and as the number next to it.
fn decimal(digits: i64, exponent: i32) -> (String, f64) {
    let number = format!("{digits}e{exponent}").parse().unwrap_or(0.0);
    let label = match exponent {
        _ if digits == 0 => "0".to_owned(),
        -9..0 => format!("{number:.*}", exponent.unsigned_abs() as usize),
        0..7 => format!("{number:.0}"),
        ..-9 | 7.. => format!("{number:e}"),
    };
    (label.replace('-', "−"), number)
}

/// The lines at the ticks, the axes, and the labels.
fn axes(across: &Scale, up: &Scale) -> String {
    let (mut lines, mut axes, mut labels) = (String::new(), format!("M0 0V{HEIGHT}H{WIDTH}"), String::new());
    for tick in &up.ticks {
        let y = up.down(tick.number);
        let _ = write!(lines, "M0 {y}h{WIDTH}");
        let _ = write!(labels, "<text class=\"end\" x=\"-{}\" y=\"{y}\">{}</text>", 2 * TICK, tick.label);
    }
    for tick in &across.ticks {
        let x = across.along(tick.number);
        let _ = write!(axes, "M{x} {HEIGHT}v{TICK}");
        let _ = write!(labels, "<text x=\"{x}\" y=\"{}\">{}</text>", HEIGHT + TICK + LINE / 2, tick.label);
    }
    format!("<path class=\"lines\" d=\"{lines}\"/><path class=\"axes\" d=\"{axes}\"/>\n{labels}")
}

/// A series: its intervals, its line and its marks.
fn drawn(look: usize, series: &Series, across: &Scale, up: &Scale) -> String {
    let mut points: Vec<Point> = series.shown().collect();
    points.sort_by(|one, other| one.x.total_cmp(&other.x));
    let (mut line, mut intervals, mut marks) = (String::new(), String::new(), String::new());
    for point in points {
        let (x, y) = (across.along(point.x), up.down(point.y));
        let _ = write!(line, "{}{x} {y}", if line.is_empty() { 'M' } else { 'L' });
        let _ = write!(marks, "M{x} {y}{}", mark(look));
        if let Some([low, high]) = point.interval {
            let (low, high) = (up.down(low), up.down(high));
            let _ = write!(intervals, "M{x} {low}V{high}m-{TICK} 0h{}", 2 * TICK);
            let _ = write!(intervals, "M{x} {low}m-{TICK} 0h{}", 2 * TICK);
        }
    }
    group(look, series.stroke, &line, &intervals, &marks)
}

/// A sample of the line and the mark of a series, and its name.
fn legend(look: usize, series: &Series) -> String {
    let sample = group(
        look,
        series.stroke,
        &format!("M0 0h{SAMPLE}"),
        "",
        &format!("M{} 0{}", SAMPLE / 2, mark(look)),
    );
    format!(
        "{sample}<text class=\"start\" x=\"{}\" y=\"0\">{}</text>",
        SAMPLE + 2 * TICK,
        escaped(&series.name)
    )
}

fn mark(look: usize) -> &'static str {
    MARKS[look % MARKS.len()]
}

fn group(look: usize, stroke: Stroke, line: &str, intervals: &str, marks: &str) -> String {
    let dashed = match stroke {
        Stroke::Solid => "",
        Stroke::Dashed => " dashed",
    };
    let path = |class, d: &str| {
        if d.is_empty() { String::new() } else { format!("<path class=\"{class}\" d=\"{d}\"/>") }
    };
    format!(
        "<g class=\"series-{}{dashed}\">{}{}{}</g>",
        look % SERIES,
        path("interval", intervals),
        path("line", line),
        path("marks", marks)
    )
}
