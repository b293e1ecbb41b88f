//! `tautline rescue`: rescues over a radio field.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::atomic_file::AtomicFile;
use tautline_io::diagnostic::{Diagnostic, Halt, Watch};
use tautline_io::named_values::NamedValues;
use tautline_io::number::Number;
use tautline_io::text_table::{Align, TextTable};
use tautline_io::value_parser::{Metres, real, whole};
use tautline_proofs::mrc::Demand;
use tautline_proofs::plural::counted;

use super::exit::Exit;
use super::options::{ForceArgs, Format, FormatArgs, refuse_needless};
use super::output::Output;
use super::value_parser::chosen;
use super::{interrupt, progress, viewers};
use tautline_field::draw::{self, field::picture};
use tautline_field::radio::{ChannelName, FREE_SPACE, Lake};
use tautline_field::rescue::{
    Assignments, CallTimes, Event, LogEntry, Ordinal, Report, RobotFailures, SchemeName, Setting, Summary,
    rescue, seconds, trace,
};
use tautline_field::stats::Estimate;
use tautline_sim::explore::RuleName;

const EXAMPLES: &str = "\
Examples:
  tautline rescue --seeds 0
  tautline rescue --wfr 3 --robots 3 --loss 0.1 --failing 1 --seeds 0..999
  tautline rescue --wfr 3 --robots 3 --loss 0.1 --failing 1 --seeds 0..999 --rule published --format json
  tautline rescue --obstacle 100,100,200,200 --robot 20,150 --wfr-at 350 --seeds 7
  tautline rescue --obstacle u:75,75,225,225 --robot 150,150 --seeds 0..999
  tautline rescue --wfr 2 --robots 3 --loss 0.1 --events 3 --rule published
  tautline rescue --nodes 300 --scheme flooding --channel shared --noise-db 2
  tautline rescue --wfr 3 --robots 3 --seeds 8 --rule published --trace rescue.jsonl --html rescue.html

What the JSON says: reach, reach_component and rebroadcasts are means over the seeds of what becomes of the first call \
for each event at a WFR; assignments counts all WFRs and events of all seeds, and the events that were served_once, \
served_more_often, never (a robot that lives is connected with the WFR and has heard of the event), unheard \
(connected, but the broadcast has not reached it), cut_off (not connected) and still_to_come (the one before was not \
served); robots_failed counts the robots that failed on their way to a WFR, before the last arrival of all but not on \
their way, and after it; distance_ratio is the sum of the distances moved over the sum of the shortest; wait_s the \
time from the first call for an event to the robot; violations the clauses broken, in how many rescues, and where \
first. Each mean has its 95 % interval.

A rescue ends when nothing more happens, or after six hours for each event: who then still waits for a robot counts as \
never served.

The exit code is 1 if a clause is broken.";

/// Let sensor nodes call for help and robots come, over a radio field at random, and judge what they do.
///
/// A node that calls is a WFR, a node that waits for rescue. Nodes pass its call on by a broadcast scheme, robots that
/// hear the call and the node agree by messages which robot comes (MRC, mobile robot coordination), and this robot
/// walks from node to node by the strength of their signals (TAN, tree-assisted navigation). The rules are those of
/// Jiang (2011); docs/rescue.md and docs/glossary.md explain them.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Rescue {
    /// How many sensor nodes stand in the area, at random places.
    #[arg(long, value_name = "N", default_value = "700", value_parser = whole::<usize>)]
    nodes: usize,
    /// Width and height of the area, in metres.
    #[arg(long, value_name = "WxH", default_value = "300x300", allow_hyphen_values = true)]
    area: AreaArg,
    /// The radio range, in metres.
    #[arg(long, value_name = "METRES", allow_hyphen_values = true, default_value_t = 25.0, value_parser = real)]
    range: f64,
    /// West, north, east and south of an obstacle, in metres: no signal and no robot passes it. Before them its shape,
    /// if it is no rectangle: l, u, c, spiral, ring, or rows of # and . with / between them. May be given repeatedly.
    #[arg(long, value_name = "[SHAPE:]W,N,E,S", allow_hyphen_values = true)]
    obstacle: Vec<Lake>,
    /// How nodes pass a call on: which node that hears it sends it again, and which is silent.
    #[arg(long, value_parser = chosen::<SchemeName>(), default_value = "k-fnf")]
    scheme: SchemeName,
    /// For k-fnf and counter: a node that has heard a call from so many senders besides the first does not send it
    /// again. Without it 1.
    #[arg(long, value_parser = whole::<u8>)]
    k: Option<u8>,
    /// How many nodes call for help. Without it as many as --wfr-at names, or one.
    #[arg(long, value_name = "N", value_parser = whole::<usize>)]
    wfr: Option<usize>,
    /// The number of a node that calls, from 0 on. May be given repeatedly; the others are random ones.
    #[arg(long, value_name = "NODE", value_parser = whole::<u32>)]
    wfr_at: Vec<u32>,
    /// How many robots there are. Without it as many as --robot places, or one.
    #[arg(long, value_name = "N", value_parser = whole::<usize>)]
    robots: Option<usize>,
    /// Where a robot begins, in metres. May be given repeatedly; the others are at random places.
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    robot: Vec<Metres<2>>,
    /// How often something happens at each node that calls: again at a random time of the ten minutes after it was
    /// served.
    #[arg(long, value_name = "N", default_value = "1", value_parser = whole::<usize>)]
    events: usize,
    /// When nodes call for the first time.
    #[arg(long, value_parser = chosen::<CallTimes>(), default_value = "together")]
    calls: CallTimes,
    /// The rule by which robots and the nodes that call agree on who comes (MRC).
    #[arg(long, value_parser = chosen::<RuleName>(), default_value = "repaired")]
    rule: RuleName,
    /// The first and the last seed, or only one. Each is a rescue.
    #[arg(long, value_name = "A..B", default_value = "0..99", allow_hyphen_values = true)]
    seeds: Seeds,
    /// The channel between a sender and those who hear it.
    #[arg(long, value_parser = chosen::<ChannelName>(), default_value = "ideal")]
    channel: ChannelName,
    /// How likely it is that a message is lost, on each link anew, from 0 to 1.
    #[arg(long, value_name = "PROBABILITY", allow_hyphen_values = true, default_value_t = 0.0, value_parser = real)]
    loss: f64,
    /// The standard deviation of the shadow on each link, in dB: a lasting difference of its strength from what the
    /// distance says, as a tree between two nodes makes one. It changes how far off a sender seems.
    #[arg(long, value_name = "DB", allow_hyphen_values = true, default_value_t = 0.0, value_parser = real)]
    shadowing_db: f64,
    /// The path loss exponent, from 2 in free space to 5: power falls with the distance to the power of this. The
    /// larger, the less do shadows and noise change.
    #[arg(long, value_name = "ALPHA", allow_hyphen_values = true, default_value_t = FREE_SPACE, value_parser = real)]
    exponent: f64,
    /// The standard deviation of the noise of each signal that is heard, each time anew, in dB.
    #[arg(long, value_name = "DB", allow_hyphen_values = true, default_value_t = 0.0, value_parser = real)]
    noise_db: f64,
    /// How many robots fail, each at a random time of the first ten minutes.
    #[arg(long, value_name = "N", default_value = "0", value_parser = whole::<usize>)]
    failing: usize,
    /// How many nodes fail, likewise; none that calls.
    #[arg(long, value_name = "N", default_value = "0", value_parser = whole::<usize>)]
    failing_nodes: usize,
    /// Store the rescue as JSON lines; one seed only.
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Store the rescue as a page that plays it; one seed only.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Store a map of the field with the ways of the robots as a picture; one seed only.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Store the rescue as a recording of ROS 2, for its viewers; one seed only.
    #[cfg_attr(not(feature = "viewers"), arg(skip))]
    #[cfg_attr(feature = "viewers", arg(long, value_name = "FILE"))]
    mcap: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

/// Metres as `WxH`.
#[derive(Clone, Copy, Debug)]
struct AreaArg([f64; 2]);

impl FromStr for AreaArg {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let sides = text
            .split_once('x')
            .and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
        sides.map(Self).ok_or("write width and height in metres as WIDTHxHEIGHT, for example 300x300")
    }
}

/// Seeds from the first to the last.
#[derive(Clone, Debug)]
struct Seeds(RangeInclusive<u64>);

/// More rescues do not fit into memory.
const MAX_RESCUES: u64 = 1_000_000;

impl FromStr for Seeds {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (first, last) = text.split_once("..").unwrap_or((text, text));
        let (Ok(first), Ok(last)) = (first.parse::<u64>(), last.parse::<u64>()) else {
            return Err(
                "write the first and the last seed as A..B, for example 0..99, or one seed".to_owned()
            );
        };
        match last.checked_sub(first) {
            None => Err(format!("the first seed comes after the last; write {last}..{first}")),
            Some(others) if others >= MAX_RESCUES => Err(format!("give up to {MAX_RESCUES} seeds")),
            Some(_) => Ok(Self(first..=last)),
        }
    }
}

impl Seeds {
    /// The seed, if it is the only one.
    fn one(&self) -> Option<u64> {
        (self.0.start() == self.0.end()).then_some(*self.0.start())
    }
}

/// The JSON of rescues.
#[derive(JsonSchema, Serialize)]
pub(super) struct RescueJson<'a> {
    #[serde(flatten)]
    setting: &'a Setting,
    /// The first and the last.
    seeds: [u64; 2],
    /// Whether these are all that were asked for: a signal ended nothing.
    complete: bool,
    /// The clauses that were looked at.
    judged: [&'static str; Demand::ALL.len()],
    #[serde(flatten)]
    summary: &'a Summary,
    /// The events, of one rescue alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    events: Option<&'a [LogEntry]>,
}

/// How many seeds: [`Seeds`] has at most [`MAX_RESCUES`].
fn count(seeds: &RangeInclusive<u64>) -> u64 {
    1 + (seeds.end() - seeds.start())
}

impl Rescue {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let counts = matches!(self.scheme, SchemeName::KFnf | SchemeName::Counter);
        let why = format_args!("{} does not count senders", self.scheme.word());
        refuse_needless([("--k", self.k.is_some() && !counts)], why)?;
        let setting = self.setting();
        let seeds = &self.seeds.0;
        if let Some(seed) = self.seeds.one() {
            let files = [&self.trace, &self.html, &self.svg, &self.mcap];
            let [trace, page, map, recording] = self.force.files(files, [])?;
            let report = rescue(&setting, seed).map_err(Diagnostic::from)?;
            tracing::info!("the rescue with seed {seed} has {}", counted(report.log.len(), "event"));
            let files = Files { trace, page, map, recording };
            return tell(out, self.format.format, (&setting, seed, &report), files);
        }
        if [&self.trace, &self.html, &self.svg, &self.mcap].into_iter().any(Option::is_some) {
            let first = seeds.start();
            let remedy = format!("give one seed, for example --seeds {first}");
            return Err(Diagnostic::usage("several rescues do not fit into one file", remedy).into());
        }
        let measure = |watch: &Watch<'_>| Summary::measure(&setting, seeds.clone(), watch);
        let (summary, made) = progress::during("rescuing", count(seeds), measure)?;
        let exit = print(out, self.format.format, (&setting, seeds, made), (&summary, None))?;
        Ok(if made < count(seeds) { Exit::Unfinished } else { exit })
    }

    fn setting(&self) -> Setting {
        Setting {
            rule: self.rule,
            scheme: self.scheme,
            k: self.k.unwrap_or(1),
            nodes: self.nodes,
            area_m: self.area.0,
            range_m: self.range,
            obstacles_m: self.obstacle.iter().flat_map(|Lake(parts)| parts.iter().copied()).collect(),
            wfrs: self.wfr.unwrap_or(self.wfr_at.len().max(1)),
            wfrs_at: self.wfr_at.clone(),
            robots: self.robots.unwrap_or(self.robot.len().max(1)),
            robots_at_m: self.robot.iter().map(|&Metres(place)| place).collect(),
            events_per_wfr: self.events,
            calls: self.calls,
            channel: self.channel,
            loss: self.loss,
            shadowing_db: self.shadowing_db,
            exponent: self.exponent,
            noise_db: self.noise_db,
            failing: self.failing,
            failing_nodes: self.failing_nodes,
        }
    }
}

/// The files in which a rescue is stored.
pub(super) struct Files {
    /// Itself.
    pub(super) trace: Option<AtomicFile>,
    /// The page that plays it.
    pub(super) page: Option<AtomicFile>,
    /// The map.
    pub(super) map: Option<AtomicFile>,
    /// The recording.
    pub(super) recording: Option<AtomicFile>,
}

/// Prints what came of one rescue, and stores it and the drawings of it.
pub(super) fn tell(
    out: &mut Output,
    format: Format,
    (setting, seed, report): (&Setting, u64, &Report),
    files: Files,
) -> Result<Exit, Halt> {
    let summary = Summary::of(setting, seed, report);
    let title = format!("{}, seed {seed}", title(setting));
    out.store(files.trace, |file| {
        trace::write(file, setting, seed, report);
        Ok(())
    })?;
    out.store(files.page, |page| {
        let served = summary.assignments.served_once + summary.assignments.served_more_often;
        let broken: Vec<&str> = summary.violations.iter().map(|broken| broken.clause).collect();
        let broken = if broken.is_empty() { none_broken() } else { format!("{} broken", broken.join(", ")) };
        let (events, what) = (summary.assignments.events, counted_as(setting));
        let outcome = format!("{served} of {events} {what} served; {broken}.");
        let drawn = draw::rescue::page(page.path(), (setting, seed), [&title, &outcome], report);
        page.draw(drawn.map_err(Halt::from))
    })?;
    let map = || picture(&title, &[draw::rescue::map(String::new(), report)]);
    out.store(files.map, |file| file.draw(Ok(map())))?;
    out.store(files.recording, |file| Ok(viewers::record(file, setting, seed, report)?))?;
    print(out, format, (setting, &(seed..=seed), 1), (&summary, Some(report)))
}

fn title(setting: &Setting) -> String {
    let (robots, wfrs) = (counted(setting.robots, "robot"), counted(setting.wfrs, "WFR"));
    format!("{robots} for {wfrs}{}, MRC ({})", events_each(setting), setting.rule)
}

/// How often something happens at each WFR, unless it is once.
fn events_each(setting: &Setting) -> String {
    match setting.events_per_wfr {
        1 => String::new(),
        several => format!(", {several} events each"),
    }
}

/// The noun for what has a fate: where each WFR has one event, WFRs.
const fn counted_as(setting: &Setting) -> &'static str {
    match setting.events_per_wfr {
        1 => "WFRs",
        _ => "events",
    }
}

/// Prints what came of rescues, of which the first ones were `made`, and what happened in the only one.
fn print(
    out: &mut Output,
    format: Format,
    (setting, wanted, made): (&Setting, &RangeInclusive<u64>, u64),
    (summary, report): (&Summary, Option<&Report>),
) -> Result<Exit, Halt> {
    let seeds = &(*wanted.start()..=wanted.start() + (made - 1));
    let complete = seeds == wanted;
    match format {
        Format::Json => out.json(&RescueJson {
            setting,
            seeds: [*seeds.start(), *seeds.end()],
            complete,
            judged: Demand::ALL.map(Demand::clause),
            summary,
            events: report.map(|report| &report.log[..]),
        })?,
        Format::Text => {
            out.text(heading(setting, seeds) + &table(setting, summary))?;
            if let Some(report) = report {
                out.text(story(&report.log))?;
            }
            if !complete {
                out.text(interrupt::part(made, format_args!("{} rescues", count(wanted))))?;
            }
        }
    }
    Ok(if summary.violations.is_empty() { Exit::Expected } else { Exit::Violation })
}

fn heading(setting: &Setting, seeds: &RangeInclusive<u64>) -> String {
    let Setting { rule, scheme, k, nodes, area_m, range_m, channel, .. } = setting;
    let ([width_m, height_m], range_m) = (area_m.map(Number), Number(*range_m));
    let k = match scheme {
        SchemeName::KFnf | SchemeName::Counter => format!(", k = {k}"),
        SchemeName::Flooding | SchemeName::Distance | SchemeName::Sba => String::new(),
    };
    let times = match setting.calls {
        CallTimes::Together => "at once",
        CallTimes::Spread => "within ten minutes",
    };
    let seeds = match (seeds.start(), seeds.end()) {
        (first, last) if first == last => format!("seed {first}"),
        (first, last) => format!("{} rescues, seeds {first}..{last}", count(seeds)),
    };
    let Setting { loss, noise_db, failing, failing_nodes, .. } = setting;
    let [loss, noise_db] = [*loss, *noise_db].map(Number);
    format!(
        "{} for {}, calling {times}{}: MRC ({rule}), {}{k}\n\
         {nodes} nodes in {width_m}×{height_m} m, range {range_m} m{}, {}, {} channel\n\
         loss {loss}, noise {noise_db} dB, {} and {} fail; {seeds}\n\n",
        counted(setting.robots, "robot"),
        counted(setting.wfrs, "WFR"),
        events_each(setting),
        scheme.word(),
        shadows(setting),
        counted(setting.obstacles_m.len(), "rectangular obstacle"),
        channel.word(),
        counted(*failing, "robot"),
        counted(*failing_nodes, "node"),
    )
}

/// How signals spread, unless everything within the range is heard, and nothing else.
fn shadows(setting: &Setting) -> String {
    let Setting { shadowing_db, exponent, .. } = *setting;
    let shadows =
        if shadowing_db == 0.0 { String::new() } else { format!(", shadows {} dB", Number(shadowing_db)) };
    let exponent = if exponent == FREE_SPACE { String::new() } else { format!(", exponent {exponent}") };
    shadows + &exponent
}

fn table(setting: &Setting, summary: &Summary) -> String {
    let percent = |share: Estimate| share.times(100.0).text(2);
    let Assignments {
        events, served_once, served_more_often, never, unheard, cut_off, still_to_come, ..
    } = summary.assignments;
    let of_all = |count: u32| format!("{count} of {events}");
    let fate = |words: &str| format!("{} {words}", counted_as(setting));
    let mut rows = vec![
        ("reach, % of all nodes".to_owned(), percent(summary.reach)),
        ("reach, % of the nodes connected with the WFR".to_owned(), percent(summary.reach_component)),
        ("rebroadcasts of a first call".to_owned(), summary.rebroadcasts.text(2)),
        ("messages in a rescue".to_owned(), summary.messages.text(0)),
        (fate("served once"), of_all(served_once)),
        (fate("served more often"), of_all(served_more_often)),
        (fate("never served"), of_all(never)),
        (fate("that no robot has heard"), of_all(unheard)),
        (fate("with no robot connected"), of_all(cut_off)),
    ];
    if setting.events_per_wfr > 1 {
        rows.push((fate("still to come"), of_all(still_to_come)));
    }
    if setting.failing > 0 {
        let RobotFailures { on_their_way, not_on_their_way, after_the_last_arrival } = summary.robots_failed;
        let robots = on_their_way + not_on_their_way + after_the_last_arrival;
        let failed =
            |words: &str, count: u32| (format!("robots failed {words}"), format!("{count} of {robots}"));
        rows.extend([
            failed("on their way", on_their_way),
            failed("not on their way", not_on_their_way),
            failed("after the last arrival", after_the_last_arrival),
        ]);
    }
    rows.push((
        "distance moved / shortest distance".to_owned(),
        Estimate::text_or_dash(summary.distance_ratio, 3),
    ));
    rows.push((
        "seconds from the first call to the robot".to_owned(),
        Estimate::text_or_dash(summary.wait_s, 1),
    ));
    let mut columns = TextTable::new([Align::Left; 2]);
    for (name, value) in rows {
        columns.row([name, value]);
    }
    let mut text = columns.text() + "\n";
    // Writing to a string cannot fail.
    for broken in &summary.violations {
        let rescues = counted(broken.rescues as usize, "rescue");
        let event = match setting.events_per_wfr {
            1 => String::new(),
            _ => format!(", event {}", broken.event),
        };
        let _ = writeln!(
            text,
            "{} is broken in {rescues}, first with seed {} after {:.3} s, WFR {}{event}: {}",
            broken.clause, broken.seed, broken.at_s, broken.wfr, broken.broken
        );
    }
    if summary.violations.is_empty() {
        let _ = writeln!(text, "{}", none_broken());
    }
    text
}

/// The line that says that nothing is broken, and which clauses were looked at.
fn none_broken() -> String {
    let [first, .., last] = Demand::ALL.map(Demand::clause);
    format!("none of {first} to {last} is broken")
}

/// Of so many calls of one WFR, with nothing but calls between them, all are told.
const CALLS_TOLD: u32 = 3;

/// The story of a rescue, event by event. Of more calls that come to nothing the first and the last are told.
fn story(log: &[LogEntry]) -> String {
    let calls =
        |logged: &LogEntry| if let Event::Calls { wfr, .. } = logged.event { Some(wfr) } else { None };
    let mut text = "\nseconds\n".to_owned();
    for run in log.chunk_by(|one, other| calls(one).is_some() && calls(other).is_some()) {
        let mut left = BTreeMap::<Ordinal, u32>::new();
        for wfr in run.iter().filter_map(calls) {
            *left.entry(wfr).or_default() += 1;
        }
        let all = left.clone();
        for logged in run {
            let place = calls(logged).and_then(|wfr| Some((wfr, left.get_mut(&wfr)?, *all.get(&wfr)?)));
            if let Some((wfr, left, all)) = place {
                *left -= 1;
                let told_before = all - 1 - *left;
                if all > CALLS_TOLD && told_before > 0 && *left > 0 {
                    if told_before == 1 {
                        let _ = writeln!(text, "{:>10}  WFR {wfr} calls {} times more", "…", all - 2);
                    }
                    continue;
                }
            }
            let _ = writeln!(text, "{:>10.3}  {}", seconds(logged.at_ns), logged.event);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calls_that_come_to_nothing_are_folded_wfr_by_wfr() {
        let call = |wfr: usize, epoch| Event::Calls { wfr: Ordinal(wfr - 1), node: 7, epoch };
        let told = |events: &[Event]| {
            let log: Vec<LogEntry> =
                (0..).zip(events).map(|(at_ns, &event)| LogEntry { at_ns, event }).collect();
            let text = story(&log);
            let words =
                |line: &str| line.trim_start().split_once("  ").map(|(_, words)| words.trim().to_owned());
            text.lines().filter_map(words).collect::<Vec<_>>()
        };
        let three = [call(1, 1), call(1, 2), call(1, 3)];
        assert_eq!(told(&three), three.map(|event| event.to_string()));
        let both: Vec<Event> = (1..=5).flat_map(|epoch| [call(1, epoch), call(2, epoch)]).collect();
        let fails = Event::NodeFails { node: 3 };
        let more = "calls 3 times more";
        assert_eq!(
            told(&[&both[..], &[fails, call(1, 6)]].concat()),
            [
                call(1, 1).to_string(),
                call(2, 1).to_string(),
                format!("WFR 1 {more}"),
                format!("WFR 2 {more}"),
                call(1, 5).to_string(),
                call(2, 5).to_string(),
                fails.to_string(),
                call(1, 6).to_string(),
            ]
        );
    }
}
