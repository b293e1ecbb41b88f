//! Rescues drawn: a map of the ways that robots went, and a page that plays what happened, event by event.

use std::fmt::Write;
use std::mem;
use std::path::Path;

use serde::Serialize;

use super::field::{Map, Terminus, Trail};
use crate::radio::Point;
use crate::rescue::{Event, Fix, Journey, LogEntry, Ordinal, Report, SchemeName, Setting, seconds};
use tautline_io::diagnostic::Diagnostic;
use tautline_io::named_values::NamedValues;
use tautline_io::number::Number;
use tautline_sim::draw::page::film::{self, Again, Board, Film, Share};
use tautline_sim::draw::page::{base36, is_too_large, too_large, word};
use tautline_sim::explore::{ClauseId, Kind, Layer, Shape};

/// The map of a rescue: the nodes, the WFRs, and where each robot went. The place where one failed is marked.
pub fn map(caption: String, report: &Report) -> Map<'_> {
    let trail = |(number, path): (Ordinal, &Vec<Fix>)| {
        let fails =
            |logged: &LogEntry| matches!(logged.event, Event::RobotFails { robot, .. } if robot == number);
        let end = if report.log.iter().any(fails) { Terminus::Failed } else { Terminus::There };
        let places = path.iter().map(|fix| fix.at).collect();
        Trail { name: format!("robot {number}"), places, end }
    };
    Map {
        caption,
        field: &report.field,
        nodes: report.field.nodes().len(),
        links: Vec::new(),
        trails: (0..).map(Ordinal).zip(&report.paths).map(trail).collect(),
        wfrs: report.wfrs.clone(),
    }
}

/// The places of the layers.
const MESSAGES: usize = 0;

/// The kinds of messages.
const KINDS: &[Kind] = &[
    Kind::heard("NOTICE: calls"),
    Kind::heard("NOTICE: has come"),
    Kind::heard("MOVE: asks"),
    Kind::heard("RESB: chooses"),
    Kind::heard("declines"),
];

/// The page that plays a rescue by `setting` with this seed.
///
/// # Errors
/// A [`Diagnostic`] if it would be too large to stand at `path`.
pub fn page(
    path: &Path,
    (setting, seed): (&Setting, u64),
    [title, outcome]: [&str; 2],
    report: &Report,
) -> Result<String, Diagnostic> {
    let film = film(setting, seed, [title, outcome], report);
    let page = film::head(title) + &lines(report) + &film::foot(&film);
    if is_too_large(page.len()) {
        return Err(too_large(path, "take fewer nodes, robots or WFRs, or store a trace"));
    }
    Ok(page)
}

fn film(setting: &Setting, seed: u64, [title, outcome]: [&str; 2], report: &Report) -> Film {
    let (field, events) = (&report.field, report.fates.len() as u32);
    let messages = Layer::new(
        "messages",
        "who calls, asks, chooses and declines; from node to node in between",
        Shape::Messages(KINDS),
    );
    let range = Layer::new(
        "radio circle",
        format!("{} m: the radio range, where nothing is in the way", setting.range_m),
        Shape::Circle((setting.range_m * 1000.0) as u32),
    );
    let clauses = report.violations.iter().map(|broken| broken.demand.clause());
    let sentence = |id: &'static str| (id, ClauseId::new(id).sentence().unwrap_or_default().to_owned());
    Film {
        title: title.to_owned(),
        outcome: outcome.to_owned(),
        unit: "event",
        robot: "robot",
        robots: report.paths.len(),
        has_base: false,
        has_leader: false,
        numbered_from: None,
        first: 0,
        of: report.log.len() as u32,
        share: Share { of: events, what: "events served", visits: false },
        board: Board::Metres {
            size: [field.area().width_m(), field.area().height_m()].map(metres),
            obstacles: field.obstacles().iter().map(|&of| <[f64; 4]>::from(of).map(metres)).collect(),
            nodes: field.nodes().iter().map(|&node| millimetres(node)).collect(),
            caller: "WFR",
            callers: report.wfrs.iter().map(|&wfr| millimetres(wfr)).collect(),
            paths: report.paths.iter().map(|path| way(path)).collect(),
        },
        layers: [messages, range].iter().map(film::layer).collect(),
        clauses: clauses.map(sentence).collect(),
        ends: Vec::new(),
        notes: Vec::new(),
        again: Again { command: Some(command(setting, seed)), layout: None },
    }
}

fn metres(length_m: f64) -> u32 {
    (length_m * 1000.0).round() as u32
}

fn millimetres(at: Point) -> [u32; 2] {
    [at.x_m, at.y_m].map(metres)
}

const fn milliseconds(at_ns: u64) -> u64 {
    at_ns / 1_000_000
}

/// Where a robot was: milliseconds, millimetres east and south, each as what it is more than before.
fn way(path: &[Fix]) -> String {
    let (mut text, mut last) = (String::new(), [0; 3]);
    let more = path.iter().flat_map(|fix| {
        let [x, y] = millimetres(fix.at).map(i64::from);
        let now = [milliseconds(fix.at_ns) as i64, x, y];
        let before = mem::replace(&mut last, now);
        [0, 1, 2].map(|place| now[place] - before[place])
    });
    base36(&mut text, more);
    text
}

/// The lines: the start, then one for each event, with the clauses that are broken by then.
fn lines(report: &Report) -> String {
    let robots = report.paths.len();
    let mut broken = report.violations.clone();
    broken.sort_by_key(|violation| violation.at_ns);
    let mut broken = broken.into_iter().peekable();
    let (mut text, mut before, mut served) = ("-\n".to_owned(), 0, 0);
    for (place, &LogEntry { at_ns, event }) in report.log.iter().enumerate() {
        let now = milliseconds(at_ns);
        let says = |kind: usize, from: usize, to: &str| format!(" s{MESSAGES}.{kind}:{from}>{to}");
        let caller = |wfr: Ordinal| robots + wfr.0;
        let words = match event {
            Event::Calls { wfr, .. } => says(0, caller(wfr), "*"),
            Event::Hears { robot, wfr, .. } => says(1, caller(wfr), &robot.0.to_string()),
            Event::Asks { robot, wfr, .. } => says(2, robot.0, &caller(wfr).to_string()),
            Event::Chooses { wfr, robot, .. } => says(3, caller(wfr), &robot.0.to_string()),
            Event::Declines { robot, wfr, .. } => says(4, robot.0, &caller(wfr).to_string()),
            Event::RobotFails { robot, .. } => format!(" {}", word("f", &[robot.0 as u32])),
            Event::NodeFails { node } => format!(" {}", word("n", &[node])),
            Event::Recurs { .. }
            | Event::CountsOn { .. }
            | Event::SetsOut { .. }
            | Event::Passes { .. }
            | Event::LosesItsWay { .. }
            | Event::LetsGo { .. }
            | Event::Arrives { .. } => String::new(),
        };
        if report.journeys.iter().any(|journey| is_arrival(journey, at_ns, event)) {
            served += 1;
        }
        let is_last = place + 1 == report.log.len();
        let mut here = Vec::new();
        while let Some(found) = broken.next_if(|found| is_last || found.at_ns <= at_ns) {
            let (wfr, of) = (Ordinal(found.wfr), Ordinal(found.event));
            let told = format!("So it is after {:.3} s for WFR {wfr}, event {of}.", seconds(found.at_ns));
            here.push((found.demand.clause(), vec![told]));
        }
        // Writing to a string cannot fail.
        let _ = write!(text, "- +{}{words} ={served}", now - before);
        text += &film::told(&LineDetails { note: event.to_string(), broken: here });
        text.push('\n');
        before = now;
    }
    text
}

/// A line's details beside its words.
#[derive(Serialize)]
struct LineDetails {
    note: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    broken: Vec<(&'static str, Vec<String>)>,
}

/// Whether a robot's first arrival for an event is this.
fn is_arrival(journey: &Journey, at_ns: u64, event: Event) -> bool {
    let arrives = |robot: Ordinal, wfr: Ordinal| (robot.0, wfr.0) == (journey.robot, journey.wfr);
    journey.at_ns == at_ns && matches!(event, Event::Arrives { robot, wfr, .. } if arrives(robot, wfr))
}

/// The command that makes the rescue again.
fn command(setting: &Setting, seed: u64) -> String {
    let Setting { rule, scheme, nodes, area_m, range_m, .. } = setting;
    let ([width_m, height_m], range_m) = (area_m.map(Number), Number(*range_m));
    let mut command = format!(
        "tautline rescue --seeds {seed} --rule {rule} --scheme {} --nodes {nodes} --area {width_m}x{height_m} \
         --range {range_m} --wfr {} --robots {} --events {} --calls {} --channel {} --loss {} --shadowing-db {} \
         --exponent {} --noise-db {} --failing {} --failing-nodes {}",
        scheme.word(),
        setting.wfrs,
        setting.robots,
        setting.events_per_wfr,
        setting.calls.word(),
        setting.channel.word(),
        Number(setting.loss),
        Number(setting.shadowing_db),
        setting.exponent,
        Number(setting.noise_db),
        setting.failing,
        setting.failing_nodes,
    );
    if matches!(scheme, SchemeName::KFnf | SchemeName::Counter) {
        let _ = write!(command, " --k {}", setting.k);
    }
    for sides_m in &setting.obstacles_m {
        let [west, north, east, south] = sides_m.map(Number);
        let _ = write!(command, " --obstacle {west},{north},{east},{south}");
    }
    for node in &setting.wfrs_at {
        let _ = write!(command, " --wfr-at {node}");
    }
    for place_m in &setting.robots_at_m {
        let [x, y] = place_m.map(Number);
        let _ = write!(command, " --robot {x},{y}");
    }
    command + " --html rescue.html"
}
