//! A page that plays a run: one file without anything from elsewhere, drawn on a canvas from data. Of each team move
//! it holds what changes, in words of a few letters that `docs/formats.md` explains, so that long runs stay small; it
//! is written as the run goes on. What a scheme shows beside its robots comes from its [`Layer`]s: the page knows no
//! scheme.

pub mod film;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::ops::RangeInclusive;
use std::path::Path;
use std::{iter, mem};

use tautline_io::atomic_file::AtomicFile;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Area, Cell, Edge, Side, Step};
use tautline_proofs::run::Frame;

use self::film::{Board, EndBreach, Film, Share, Told, again, notes, outcome};
pub use self::film::{in_words, place_of};
use crate::explore::{
    Change, ClauseId, Hearers, Layer, Look, Mark, Place, Play, Report, Scene, Survey, TeamMove,
};
use crate::trace::{letter, numbered_from};
use tautline_grids::layout::Generator;

/// Bytes of a page. Larger ones take a browser too long.
const MAX_BYTES: usize = 10_000_000;

/// A place for a page as it is made.
pub trait Sink {
    /// Adds `text` at the end.
    fn add(&mut self, text: &str);

    /// Gives the page up, which is too large.
    fn leave_out(&mut self);
}

impl Sink for AtomicFile {
    fn add(&mut self, text: &str) {
        self.append(text);
    }

    fn leave_out(&mut self) {
        let remedy = "store a trace, and give `tautline replay` fewer `moves` to show";
        let fault = too_large(self.path(), remedy);
        Self::leave_out(self, fault);
    }
}

impl Sink for String {
    fn add(&mut self, text: &str) {
        self.push_str(text);
    }

    fn leave_out(&mut self) {
        self.clear();
    }
}

/// A page in the making. One that grows too large is left out.
struct Page<'a> {
    sink: &'a mut dyn Sink,
    run: &'a dyn Play,
    /// The generator of its layout, if that is known.
    generator: Option<&'a Generator>,
    report: &'a Report,
    moves: RangeInclusive<u32>,
    bytes: usize,
    /// The layers of the team, once one of its team moves is known.
    layers: Option<Vec<Layer>>,
    line: Line,
    /// Where the robots were before the first of the team moves, once that is known.
    start: Option<Vec<Cell>>,
    /// The clauses that the last of the team moves so far breaks.
    broken: Vec<&'static str>,
    /// By clause, what it says.
    clauses: BTreeMap<&'static str, &'a str>,
}

impl Page<'_> {
    fn put(&mut self, text: &str) {
        self.bytes += text.len();
        if self.bytes > MAX_BYTES {
            self.sink.leave_out();
        } else {
            self.sink.add(text);
        }
    }

    /// The number of the team move before the first.
    fn first(&self) -> u32 {
        self.moves.start().saturating_sub(1)
    }

    /// Adds a team move; those before the first are shown as what the team knows by then.
    fn add(&mut self, made: &TeamMove<'_>) {
        self.layers.get_or_insert_with(|| made.team.layers());
        let mut scene = Scene::default();
        made.team.show(made.before, &mut scene);
        if made.step <= self.first() {
            self.line.take(made, &scene);
            return;
        }
        self.begin(made.before);
        let mut text = self.line.of(self.run.setup().scheme.look, made, &scene);
        self.broken = made.broken.iter().map(|clause| clause.as_str()).collect();
        for &clause in made.broken {
            self.clauses.insert(clause.as_str(), self.run.sentence(clause).unwrap_or_default());
        }
        let lines = |&clause| (ClauseId::as_str(clause), self.run.lines(clause, &self.report.chart, made));
        let told = Told {
            broken: made.broken.iter().map(lines).collect(),
            title: made.team.title().unwrap_or_default(),
            again: made.team.comes_again(),
        };
        if !(told.broken.is_empty() && told.title.is_empty() && !told.again) {
            text += &film::told(&told);
        }
        self.put(&(text + "\n"));
    }

    /// Writes what there was before the first team move, once.
    fn begin(&mut self, cells: &[Cell]) {
        if self.start.is_none() {
            self.start = Some(cells.to_vec());
            let text = self.line.before(&self.report.chart, self.first());
            self.put(&(text + "\n"));
        }
    }

    fn film(&mut self) -> Film {
        let (setup, report) = (self.run.setup(), self.report);
        let scheme = setup.scheme;
        let area = report.chart.area();
        let start = self.start.take().unwrap_or_default();
        let ends = self.ends();
        Film {
            title: self.run.setup().title(),
            outcome: outcome(scheme, report),
            unit: "team move",
            robot: scheme.look.robot(),
            robots: start.len(),
            has_base: scheme.look.has_base(),
            has_leader: matches!(scheme.look, Look::Linked { .. }),
            numbered_from: numbered_from(scheme.look),
            first: self.first(),
            of: report.steps,
            share: Share::of(report, &setup.layout),
            board: Board::cells(&setup.layout, area, &start, scheme.knowledge.is_some()),
            layers: self.layers.iter().flatten().map(film::layer).collect(),
            clauses: self.clauses.iter().map(|(&id, &says)| (id, says.to_owned())).collect(),
            ends,
            notes: notes(report),
            again: again(setup, self.generator),
        }
    }

    /// The clauses that the end of the run breaks, if the end is shown.
    fn ends(&mut self) -> Vec<EndBreach> {
        let report = self.report;
        if !self.moves.contains(&report.steps) && report.steps > 0 {
            return Vec::new();
        }
        let mut left = self.broken.clone();
        let mut ends = Vec::new();
        for violation in report.violations.iter().filter(|broken| broken.step == report.steps) {
            let clause = violation.clause;
            if let Some(place) = left.iter().position(|&id| id == clause.as_str()) {
                left.remove(place);
                continue;
            }
            self.clauses.insert(clause.as_str(), self.run.sentence(clause).unwrap_or_default());
            let (what, cells) = self.run.missed(clause, &report.chart).unwrap_or(("", Vec::new()));
            let cells = cells.iter().filter_map(|&cell| place_of(report.chart.area(), cell)).collect();
            ends.push(EndBreach { clause: clause.as_str(), what, cells });
        }
        ends
    }
}

/// Writes the page to `sink` that plays the team moves in `moves` of a run that came out as `report`.
///
/// # Errors
/// [`Halt`] if the run cannot be made.
pub fn write(
    sink: &mut dyn Sink,
    run: &dyn Play,
    report: &Report,
    moves: &RangeInclusive<u32>,
) -> Result<(), Halt> {
    write_in(sink, (run, None), report, moves)
}

/// As [`write()`], of a run in the layout that this generator makes of its seed, if one is named.
///
/// # Errors
/// As of [`write()`].
pub fn write_in(
    sink: &mut dyn Sink,
    (run, generator): (&dyn Play, Option<&Generator>),
    report: &Report,
    moves: &RangeInclusive<u32>,
) -> Result<(), Halt> {
    let mut page = Page {
        sink,
        run,
        generator,
        report,
        moves: moves.clone(),
        bytes: 0,
        layers: None,
        line: Line::new(report.chart.area()),
        start: None,
        broken: Vec::new(),
        clauses: BTreeMap::new(),
    };
    page.put(&film::head(&run.setup().title()));
    run.among(&(1..=*moves.end()), &mut |made| {
        page.add(made);
        Ok(())
    })?;
    page.begin(&report.team);
    let film = page.film();
    page.put(&film::foot(&film));
    Ok(())
}

/// The fault of a page that is too large.
pub fn too_large(path: &Path, remedy: &str) -> Diagnostic {
    let what = format!("a page of more than {} MB is left out", MAX_BYTES / 1_000_000);
    Diagnostic::in_file(path, what, remedy)
}

/// Whether a page of so many bytes is too large.
pub const fn is_too_large(bytes: usize) -> bool {
    bytes > MAX_BYTES
}

/// The sides and layers that are known so far, and so need not be said again.
#[derive(Debug)]
struct Line {
    area: Area,
    /// Whether a side can be crossed, by its place.
    known: BTreeMap<u32, bool>,
    /// The value that a place of a layer has, by layer, robot and place.
    values: BTreeMap<(usize, Option<usize>, u32), u8>,
    /// By layer and number, where a thing is.
    marks: BTreeMap<(usize, usize), Mark>,
    milliseconds: u64,
}

impl Line {
    /// Nothing is known of `area`.
    fn new(area: Area) -> Self {
        Self {
            area,
            known: BTreeMap::new(),
            values: BTreeMap::new(),
            marks: BTreeMap::new(),
            milliseconds: 0,
        }
    }

    /// The places of these cells, in order.
    fn places(&self, cells: &[Cell]) -> Vec<u32> {
        let mut places: Vec<u32> = cells.iter().filter_map(|&cell| place_of(self.area, cell)).collect();
        places.sort_unstable();
        places
    }

    /// Takes in a team move that is not shown.
    fn take(&mut self, made: &TeamMove<'_>, scene: &Scene) {
        self.changes(scene);
        self.milliseconds = made.team.milliseconds().unwrap_or(0);
        for (robot, &from) in made.before.iter().enumerate() {
            if let Step::Cross(side) = made.frame.steps[robot]
                && let Some(place) = side_of(self.area, Edge::new(from, side))
            {
                self.known.insert(place, !made.frame.blocked[robot]);
            }
        }
    }

    /// All that there is before the first team move that is shown, the one after `step`.
    fn before(&self, chart: &Survey, step: u32) -> String {
        let cells = self.area.cells();
        let explored = cells.filter(|&cell| chart.step(cell).is_some_and(|explored| explored <= step));
        let explored: Vec<u32> = explored.filter_map(|cell| place_of(self.area, cell)).collect();
        let mut text = format!("- +{} {}", self.milliseconds, word("x", &explored));
        for is_open in [true, false] {
            let sides = self.known.iter().filter(|&(_, &open)| open == is_open).map(|(&place, _)| place);
            text += &known(is_open, &sides.collect::<Vec<_>>());
        }
        let mut puts = Puts::default();
        for (&(layer, robot, place), &value) in self.values.iter().filter(|&(_, &value)| value > 0) {
            puts.add(layer, robot, place, value);
        }
        text += &puts.text();
        self.marks.iter().fold(text, |text, (&(layer, _), mark)| text + &marked(layer, mark))
    }

    /// A team move.
    fn of(&mut self, look: Look, made: &TeamMove<'_>, scene: &Scene) -> String {
        let mut text = steps(made.frame);
        if made.frame.kind == Kind::Backtrack {
            text += " b";
        }
        if let Some(milliseconds) = made.team.milliseconds() {
            let later = milliseconds - self.milliseconds.min(milliseconds);
            // Writing to a string cannot fail.
            let _ = write!(text, " +{later}");
            self.milliseconds = milliseconds;
        }
        text += &listed("u", &self.places(made.unseen));
        text += &listed("x", &self.places(made.team.seen()));
        text += &listed("l", &look.lost(made.before, &made.frame.cells));
        text + &self.changes(scene)
    }

    /// The changes of a scene, in words; from now on they are known.
    fn changes(&mut self, scene: &Scene) -> String {
        let (mut text, mut said) = (String::new(), String::new());
        let (mut puts, mut sides) = (Puts::default(), [Vec::new(), Vec::new()]);
        for change in scene.changes() {
            match change {
                Change::Clear { layer } => {
                    let of_layer = (*layer, None, 0)..(layer + 1, None, 0);
                    let gone: Vec<_> = self.values.range(of_layer).map(|(&key, _)| key).collect();
                    if !gone.is_empty() {
                        let _ = write!(text, " c{layer}");
                    }
                    for key in gone {
                        self.values.remove(&key);
                    }
                }
                &Change::Put { layer, robot, place, value } => {
                    let Some(place) = number_of(self.area, place) else { continue };
                    let before = match value {
                        0 => self.values.remove(&(layer, robot, place)),
                        _ => self.values.insert((layer, robot, place), value),
                    };
                    if before.unwrap_or(0) != value {
                        puts.add(layer, robot, place, value);
                    }
                }
                Change::Mark { layer, mark } => {
                    if self.marks.insert((*layer, mark.number), mark.clone()).as_ref() != Some(mark) {
                        said += &marked(*layer, mark);
                    }
                }
                &Change::Know { side, is_open } => {
                    if let Some(place) = side_of(self.area, side)
                        && self.known.insert(place, is_open) != Some(is_open)
                    {
                        sides[usize::from(is_open)].push(place);
                    }
                }
                Change::Say { layer, kind, from, to } => {
                    let to = match to {
                        Hearers::All => "*".to_owned(),
                        Hearers::These(robots) => {
                            robots.iter().map(usize::to_string).collect::<Vec<_>>().join(",")
                        }
                    };
                    let _ = write!(said, " s{layer}.{kind}:{from}>{to}");
                }
                Change::Take { robot, milliseconds } => {
                    let _ = write!(said, " d{robot}:{milliseconds}");
                }
                &Change::Fail { robot } => said += &listed("f", &[robot as u32]),
            }
        }
        let [mut blocked, mut open] = sides;
        blocked.sort_unstable();
        open.sort_unstable();
        text + &known(true, &open) + &known(false, &blocked) + &puts.text() + &said
    }
}

/// The number of a side between two cells: that of the western or northern cell, twice, and one more for its southern
/// side; none on the rim.
pub fn side_of(area: Area, edge: Edge) -> Option<u32> {
    let axis = match edge.side() {
        Side::East | Side::West => 0,
        Side::South | Side::North => 1,
    };
    place_of(area, edge.cell()).map(|place| 2 * place + axis)
}

/// The number of a place among the cells or among the sides.
pub fn number_of(area: Area, place: Place) -> Option<u32> {
    match place {
        Place::Cell(cell) => place_of(area, cell),
        Place::Side(edge) => side_of(area, edge),
    }
}

/// The steps that robots tried: a letter each, small where a wall was met; a number before a point is how many robots
/// in a row stay.
fn steps(frame: &Frame) -> String {
    let (mut text, tried) = (String::new(), frame.steps.iter().zip(&frame.blocked).collect::<Vec<_>>());
    for alike in tried.chunk_by(|(one, _), (other, _)| **one == Step::Stay && one == other) {
        let (letter, is_blocked) = (letter(*alike[0].0), *alike[0].1);
        if alike.len() > 1 {
            let _ = write!(text, "{}", alike.len());
        }
        text.push(if is_blocked { letter.to_ascii_lowercase() } else { letter });
    }
    text
}

/// A word with numbers in rising order: the first, then each as what it is more than the one before, to the base 36.
pub fn word(name: &str, numbers: &[u32]) -> String {
    let (mut text, mut last) = (format!("{name}:"), 0);
    base36(&mut text, numbers.iter().map(|&number| i64::from(number - mem::replace(&mut last, number))));
    text
}

/// Numbers to the base 36, with commas between them.
pub fn base36(text: &mut String, numbers: impl IntoIterator<Item = i64>) {
    for (place, number) in numbers.into_iter().enumerate() {
        text.push_str(if place > 0 { "," } else { "" });
        text.push_str(if number < 0 { "-" } else { "" });
        let shorter = |left: &u64| Some(left / 36).filter(|&left| left > 0);
        let digits: Vec<u64> = iter::successors(Some(number.unsigned_abs()), shorter).collect();
        text.extend(digits.iter().rev().filter_map(|digits| char::from_digit((digits % 36) as u32, 36)));
    }
}

/// A word with a blank before it; nothing if there are no numbers.
fn listed(name: &str, numbers: &[u32]) -> String {
    if numbers.is_empty() { String::new() } else { format!(" {}", word(name, numbers)) }
}

/// The word of a thing that is somewhere from now on.
fn marked(layer: usize, mark: &Mark) -> String {
    let mut text = format!(" e{layer}.{}@{}:", mark.value, mark.number);
    base36(&mut text, mark.figures.iter().map(|&figure| figure.into()));
    text
}

fn known(is_open: bool, places: &[u32]) -> String {
    listed(if is_open { "o" } else { "w" }, places)
}

/// Values that places get, those of one layer, value and robot together.
#[derive(Default)]
struct Puts(BTreeMap<(usize, u8, u32), Vec<Option<usize>>>);

impl Puts {
    fn add(&mut self, layer: usize, robot: Option<usize>, place: u32, value: u8) {
        self.0.entry((layer, value, place)).or_default().push(robot);
    }

    fn text(self) -> String {
        // Robots that get the same in the same places are told of together.
        let mut groups = BTreeMap::<(usize, u8, Vec<Option<usize>>), Vec<u32>>::new();
        for ((layer, value, place), mut robots) in self.0 {
            robots.sort_unstable();
            groups.entry((layer, value, robots)).or_default().push(place);
        }
        let mut text = String::new();
        for ((layer, value, robots), places) in groups {
            let robots: Vec<String> = robots.iter().flatten().map(usize::to_string).collect();
            let of = if robots.is_empty() { String::new() } else { format!("@{}", robots.join(",")) };
            text += &listed(&format!("p{layer}.{value}{of}"), &places);
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn robots_that_stay_are_counted() {
        let [east, north] = [Side::East, Side::North].map(Step::Cross);
        let frame = |steps: &[Step]| Frame {
            kind: Kind::Advance,
            blocked: steps.iter().map(|&step| step == north).collect(),
            steps: steps.to_vec(),
            cells: vec![Cell::new(0, 0); steps.len()],
        };
        let stay = Step::Stay;
        for (steps_made, text) in [
            (&[stay, stay, east, stay, north][..], "2.E.n"),
            (&[stay; 12][..], "12."),
            (&[east, stay][..], "E."),
            (&[][..], ""),
        ] {
            assert_eq!(steps(&frame(steps_made)), text);
        }
    }

    #[test]
    fn numbers_are_written_as_what_they_are_more() {
        assert_eq!(word("x", &[0, 35, 36, 1332]), "x:0,z,1,100");
        assert_eq!(word("x", &[]), "x:");
        let mut text = String::new();
        base36(&mut text, [-37, 36]);
        assert_eq!(text, "-11,10");
    }
}
