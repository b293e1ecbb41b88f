//! The verdicts in words, as JSON, as a picture and as a page.

use std::fmt::Write;

use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::diagnostic::{Diagnostic, one_line};
use tautline_io::svg::Panel;
use tautline_logs::{Breach, Demand, Doubt, Form, Limits, Log, Numbers, Strays, Tracks, Verdict};
use tautline_proofs::plural::counted;

use super::ground::LogMap;
use tautline_grids::layout::Layout;
use tautline_sim::draw::svg;

/// The report of a log.
pub(super) struct LogReport<'a> {
    pub(super) file: String,
    pub(super) log: &'a Log,
    pub(super) numbers: &'a Numbers,
    pub(super) tracks: &'a Tracks,
    pub(super) limits: &'a Limits,
    pub(super) given: &'a LogMap,
    pub(super) misplaced: Option<Strays>,
    pub(super) verdicts: &'a [(&'static str, Demand, Verdict)],
}

/// The JSON of a log that was judged.
#[derive(JsonSchema, Serialize)]
pub(crate) struct JudgeJson<'a> {
    log: &'a str,
    /// The positions that were taken.
    positions: usize,
    /// The names of the robots, by number.
    robots: &'a [String],
    /// The first stamp and the last one.
    span_us: [i64; 2],
    tolerance_mm: u32,
    gap_us: u64,
    cell_mm: f64,
    /// Remarks on what was not taken, and on what the log does not have.
    remarks: Vec<String>,
    clauses: Vec<ClauseJson>,
}

#[derive(JsonSchema, Serialize)]
struct ClauseJson {
    clause: &'static str,
    verdict: Word,
    /// The first breach.
    breach: Option<BreachJson>,
    /// Why the verdict is unknown.
    reason: Option<String>,
}

#[derive(Clone, Copy, JsonSchema, Serialize)]
#[serde(rename_all = "lowercase")]
enum Word {
    Kept,
    Broken,
    Unknown,
}

#[derive(JsonSchema, Serialize)]
struct BreachJson {
    at_us: i64,
    /// From 1.
    robots: Vec<u32>,
    /// The distance in millimetres, the robots in the cell, or the cells that nobody visited.
    measured: u32,
    /// The most or the least that is allowed, without the tolerance.
    allowed: u32,
    /// Column and row: rows are counted southwards on a map, and else northwards.
    cell: Option<[i32; 2]>,
    /// The line or the message of the log.
    place: u32,
    /// The stamps at which the clause is broken.
    moments: u32,
}

/// Names that a line shows.
const SHOWN: usize = 8;

/// Robots of a moment that are drawn.
const DRAWN: usize = 400;

/// Cells along a side of a picture that has no map.
const ACROSS: f64 = 40.0;

/// The stamps that the page of a breach shows.
const STAMPS: usize = 12;

pub(super) fn metres(mm: f64) -> String {
    format!("{:.3}", mm / 1e3).trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn seconds(us: i64) -> String {
    let (sign, us) = (if us < 0 { "-" } else { "" }, us.unsigned_abs());
    let text = format!("{sign}{}.{:06}", us / 1_000_000, us % 1_000_000);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

impl LogReport<'_> {
    /// A robot by its number, from 1, and its name.
    fn robot(&self, robot: u32) -> String {
        let name = self.numbers.names().get(robot as usize).map_or_else(String::new, |name| one_line(name));
        if name == (robot + 1).to_string() { name } else { format!("{} ({name})", robot + 1) }
    }

    pub(super) fn title(&self) -> String {
        format!("tautline judge {}", self.file)
    }

    /// The line about the whole.
    fn sentence(&self) -> String {
        let [first, last] = self.tracks.span_us();
        let positions = self.tracks.samples().count();
        format!(
            "{}: {} of {} in {} s",
            one_line(&self.file),
            counted(positions, "position"),
            counted(self.tracks.count(), "robot"),
            seconds(last.saturating_sub(first))
        )
    }

    /// Remarks on what was not taken, and on what does not fit.
    fn remarks(&self) -> Vec<String> {
        let (log, place) = (self.log, self.log.form.place());
        let refused = self.tracks.refused();
        let mut remarks = Vec::new();
        let mut say = |counted: Option<(u32, u32)>, what: &str| {
            if let Some((count, first)) = counted {
                remarks.push(format!("{count} × {what}, first in {place} {first}"));
            }
        };
        say(refused.late, "not taken: a stamp before an earlier one of the same robot");
        say(refused.astray, "not taken: a stamp farther than --jump from those before and behind it");
        say(refused.replaced, "not taken: a position before another one of the same robot at the same stamp");
        say(
            refused.contradicted,
            "not taken: a position of a robot that is somewhere else at the same stamp",
        );
        say(refused.nobody, "not taken: a name that is no robot");
        say(log.unplaced, "not taken: a position that is no number, or beyond 1,000 km");
        if let Some(misplaced) = self.misplaced {
            say(misplaced.off, "a position in a blocked cell or off the map");
            say(misplaced.through, "a step through a wall of the map");
            if misplaced.is_milli {
                let what = "a thousandth of most positions would be on the map: are they millimetres? Name columns \
                            x_mm and y_mm";
                remarks.push(what.to_owned());
            }
        }
        if let Some(cut) = log.cut {
            let why = if log.form == Form::Csv { "has no line break, and " } else { "" };
            remarks.push(format!("the log is cut in {place} {cut}, which {why}is not taken"));
        }
        if log.frames.len() > 1 {
            let frames: Vec<_> = log.frames.iter().take(SHOWN).map(|frame| one_line(frame)).collect();
            remarks.push(format!(
                "positions are given in several frames, and taken as if they were one: {}",
                frames.join(", ")
            ));
        }
        if !self.numbers.absent().is_empty() {
            remarks.push(format!("not in the log: {}", one_line(&self.numbers.absent().join(", "))));
        }
        let steps = self.tracks.samples().count().saturating_sub(self.tracks.count());
        let silences = self.tracks.silences().count();
        if silences * 2 > steps && steps > 0 {
            let what = "after most positions a robot is silent for longer than --gap: are stamps in seconds? Name \
                        the column t_ms, or give a longer --gap";
            remarks.push(what.to_owned());
        }
        remarks
    }

    /// The verdicts in lines.
    pub(super) fn text(&self) -> String {
        let mut text = self.sentence();
        let names = self.numbers.names();
        let first: Vec<String> = (0..names.len().min(SHOWN) as u32).map(|robot| self.robot(robot)).collect();
        let more = if names.len() > SHOWN { ", …" } else { "" };
        let _ = write!(text, "\nrobots: {}{more}\n", first.join(", "));
        let Limits { tolerance_mm, gap_us, .. } = *self.limits;
        let (gap, tolerance) = (seconds(gap_us as i64), metres(tolerance_mm.into()));
        let _ = writeln!(text, "tolerance {tolerance} m, gap {gap} s, cells of {} m", self.given.cell_m());
        for remark in self.remarks() {
            let _ = writeln!(text, "{remark}");
        }
        for (id, demand, verdict) in self.verdicts {
            let _ = match verdict {
                Verdict::Kept => writeln!(text, "{id}: kept"),
                Verdict::Broken(breach) => writeln!(text, "{id}: broken {}", self.breach(demand, breach)),
                Verdict::Unknown(doubt) => writeln!(text, "{id}: unknown: {}", self.doubt(doubt)),
            };
        }
        text
    }

    fn cell(&self, cell: [i32; 2]) -> String {
        let [column, row] = self.given.counted(cell);
        format!("({column},{row})")
    }

    fn breach(&self, demand: &Demand, breach: &Breach) -> String {
        let Breach { at_us, robots, measured, allowed, cells, place, moments } = breach;
        let names: Vec<String> = robots.iter().take(SHOWN).map(|&robot| self.robot(robot)).collect();
        let cell = cells.first().map_or_else(String::new, |&cell| self.cell(cell));
        let who = names.join(" and ");
        let far = |mm: u32| metres(mm.into());
        let what = match demand {
            Demand::Neighbours { .. } => {
                format!(
                    "robots {who} are {} m apart, at most {} m are allowed",
                    far(*measured),
                    far(*allowed)
                )
            }
            Demand::Joined { .. } => {
                format!(
                    "no link joins robots {who}, which are {} m apart, to one another; links have at most {} m",
                    far(*measured),
                    far(*allowed)
                )
            }
            Demand::Apart { .. } => {
                format!(
                    "robots {who} are {} m apart, at least {} m are demanded",
                    far(*measured),
                    far(*allowed)
                )
            }
            Demand::Crowd { .. } if cells.len() > 1 => {
                let cells: Vec<_> = cells.iter().map(|&cell| self.cell(cell)).collect();
                format!("robots {who} are in the cells {}, at most {allowed} may be", cells.join(" and "))
            }
            Demand::Crowd { .. } => format!("robots {who} are in the cell {cell}, at most {allowed} may be"),
            Demand::Visited { .. } => {
                return format!(
                    "at the end, {} s: nobody was in {}, the first is {cell}",
                    seconds(*at_us),
                    counted(*measured, "cell")
                );
            }
        };
        let often = if *moments > 1 { format!("; at {moments} stamps in all") } else { String::new() };
        format!("at {} s: {what} ({} {place}{often})", seconds(*at_us), self.log.form.place())
    }

    fn doubt(&self, doubt: &Doubt) -> String {
        match doubt {
            Doubt::Silent(silence, count) => {
                let robot = self.robot(silence.robot);
                let what = if self.tracks.samples().any(|sample| sample.robot == silence.robot) {
                    let (from, to) = (seconds(silence.from_us), seconds(silence.to_us));
                    format!("robot {robot} is silent from {from} s to {to} s, longer than --gap")
                } else {
                    format!("the log has no position of robot {robot}")
                };
                let all = if *count > 1 { format!("; {count} silences in all") } else { String::new() };
                what + &all
            }
            Doubt::Alone => "it speaks of several robots, and the log has one".to_owned(),
            Doubt::Parted(at_us) => {
                format!(
                    "at {} s, the first moment that has all robots, they do not hear \
                     each other, and the clause asks for nothing",
                    seconds(*at_us)
                )
            }
            Doubt::Leaving(at_us, robots) => {
                let [one, other] = robots.map(|robot| self.robot(robot));
                format!(
                    "at {} s robots {one} and {other} are too near, and one is on its way from its start: whether it \
                     has left it is not told by positions",
                    seconds(*at_us)
                )
            }
            Doubt::Cell(cell, count) => {
                format!(
                    "within the tolerance {} may have been visited or not, the first is {}",
                    counted(*count, "cell"),
                    self.cell(*cell)
                )
            }
            Doubt::Border(at_us, cell, robots) => {
                let who: Vec<_> = robots.iter().take(SHOWN).map(|&robot| self.robot(robot)).collect();
                format!(
                    "at {} s robots {} may be in the cell {}, at whose border they are within the tolerance",
                    seconds(*at_us),
                    who.join(" and "),
                    self.cell(*cell)
                )
            }
            Doubt::Base => {
                "the base is the cell in which robot 1 is first, and it is at the border of a cell then: \
                            say where the base is with --base"
                    .to_owned()
            }
            Doubt::Astray(robot) => format!(
                "robot {} is not first in a free cell of the map, and which cells it can reach is not known",
                self.robot(*robot)
            ),
            Doubt::Nowhere => {
                "no robot is first in a free cell of the map, and the clause asks for nothing".to_owned()
            }
            Doubt::Contradiction { robot, at_us, place, count } => {
                let (robot, at, form) = (self.robot(*robot), seconds(*at_us), self.log.form.place());
                let all =
                    if *count > 1 { format!("; {count} times in all some robot is") } else { String::new() };
                format!(
                    "robot {robot} is at several places at {at} s, farther apart than --tolerance ({form} {place}{all})"
                )
            }
            Doubt::Refused => "more than half of the positions were not taken".to_owned(),
            Doubt::Ending(at_us, robots) => {
                let who: Vec<_> = robots.iter().map(|&robot| self.robot(robot)).collect();
                format!(
                    "at {} s robots {} would break it if one of them stood still before its first position, or behind \
                     its last one",
                    seconds(*at_us),
                    who.join(" and ")
                )
            }
            Doubt::Cut => "the log is cut, and the run may have gone on".to_owned(),
            Doubt::OtherMap => {
                "more than half of the positions are not on the map: it is another one, or has other \
                                units, or another --origin"
                    .to_owned()
            }
        }
    }

    pub(super) fn json(&self) -> JudgeJson<'_> {
        let clause = |(clause, _, verdict): &(&'static str, Demand, Verdict)| {
            let (verdict, breach, reason) = match verdict {
                Verdict::Kept => (Word::Kept, None, None),
                Verdict::Broken(breach) => (Word::Broken, Some(self.breach_json(breach)), None),
                Verdict::Unknown(doubt) => (Word::Unknown, None, Some(self.doubt(doubt))),
            };
            ClauseJson { clause, verdict, breach, reason }
        };
        JudgeJson {
            log: &self.file,
            positions: self.tracks.samples().count(),
            robots: self.numbers.names(),
            span_us: self.tracks.span_us(),
            tolerance_mm: self.limits.tolerance_mm,
            gap_us: self.limits.gap_us,
            cell_mm: self.given.grid().cell_mm,
            remarks: self.remarks(),
            clauses: self.verdicts.iter().map(clause).collect(),
        }
    }

    fn breach_json(&self, breach: &Breach) -> BreachJson {
        BreachJson {
            at_us: breach.at_us,
            robots: breach.robots.iter().map(|robot| robot + 1).collect(),
            measured: breach.measured,
            allowed: breach.allowed,
            cell: breach.cells.first().map(|&cell| self.given.counted(cell)),
            place: breach.place,
            moments: breach.moments,
        }
    }

    /// The first breach of all clauses.
    fn first(&self) -> Option<(&'static str, &Demand, &Breach)> {
        let breaches = self.verdicts.iter().filter_map(|(id, demand, verdict)| match verdict {
            Verdict::Broken(breach) => Some((*id, demand, breach)),
            Verdict::Kept | Verdict::Unknown(_) => None,
        });
        breaches.min_by_key(|(_, _, breach)| breach.at_us)
    }

    /// The robots whose places are known at a stamp, those that break a clause first.
    fn places(&self, at_us: i64, broken: &[u32]) -> Vec<(u32, [f64; 2])> {
        let others = (0..self.tracks.count() as u32).filter(|robot| !broken.contains(robot));
        let robots = broken.iter().copied().chain(others);
        let placed = robots.filter_map(|robot| Some((robot, self.tracks.at(robot as usize, at_us)?)));
        placed.take(DRAWN).collect()
    }

    /// The picture of the first breach, or of the last stamp if there is none.
    pub(super) fn picture(&self) -> Result<String, Diagnostic> {
        let first = self.first();
        let at_us = first.map_or(self.tracks.span_us()[1], |(_, _, breach)| breach.at_us);
        let broken = first.map_or(&[][..], |(_, _, breach)| &breach.robots);
        let places = self.places(at_us, broken);
        let grid = self.given.grid();
        let (layout, [left, bottom], side) = match self.given.layout() {
            Some(layout) => (layout.clone(), grid.origin_mm, grid.cell_mm),
            None => around(&places, grid.cell_mm)?,
        };
        let area = layout.size().area();
        svg::check_size(area)?;
        let (columns, rows) = (f64::from(layout.width()), f64::from(layout.height()));
        let inside = places.into_iter().filter_map(|(robot, [x, y])| {
            let place = [(x - left) / side, rows - (y - bottom) / side];
            let is_inside = (0.0..=columns).contains(&place[0]) && (0.0..=rows).contains(&place[1]);
            is_inside.then_some((robot, place))
        });
        let inside: Vec<(u32, [f64; 2])> = inside.collect();
        let marked = |robot: &u32| inside.iter().position(|(other, _)| other == robot);
        let marked: Vec<usize> = broken.iter().filter_map(marked).collect();
        let robots: Vec<_> = inside.iter().map(|(robot, place)| (*place, (robot + 1).to_string())).collect();
        let caption = first.map_or_else(
            || format!("{} s: nothing is broken; cells of {} m", seconds(at_us), metres(side)),
            |(id, _, _)| format!("{id} is broken at {} s; cells of {} m", seconds(at_us), metres(side)),
        );
        let unvisited = first.map_or_else(Vec::new, |(_, demand, breach)| match demand {
            Demand::Visited { .. } => self.given.on_map(&breach.cells),
            Demand::Neighbours { .. }
            | Demand::Joined { .. }
            | Demand::Apart { .. }
            | Demand::Crowd { .. } => Vec::new(),
        });
        let moment = svg::moment(&layout, &caption, (&robots, &marked), &unvisited);
        Ok(Panel::picture(&self.title(), &[moment]))
    }

    /// The positions at the last stamps up to the first breach.
    pub(super) fn moments(&self) -> Vec<String> {
        let Some((id, demand, breach)) = self.first() else { return Vec::new() };
        let mut stamps: Vec<i64> =
            self.tracks.samples().map(|sample| sample.at_us).filter(|&at| at <= breach.at_us).collect();
        stamps.sort_unstable();
        stamps.dedup();
        let shown = stamps.split_off(stamps.len().saturating_sub(STAMPS));
        let drawn = |&at_us: &i64| {
            let mut part = format!("{} s, x and y in metres", seconds(at_us));
            if at_us == breach.at_us {
                let _ = write!(part, ": {id} is broken {}", self.breach(demand, breach));
            }
            for (robot, [x, y]) in self.places(at_us, &breach.robots).into_iter().take(STAMPS) {
                let mark = if breach.robots.contains(&robot) { '!' } else { ' ' };
                let _ = write!(part, "\n{mark} {:24} {:>10} {:>10}", self.robot(robot), metres(x), metres(y));
            }
            part
        };
        shown.iter().map(drawn).collect()
    }
}

/// An open layout around robots, its lower left corner, and the side of its cells.
fn around(places: &[(u32, [f64; 2])], cell_mm: f64) -> Result<(Layout, [f64; 2], f64), Diagnostic> {
    let bound = |axis: usize, better: fn(f64, f64) -> f64| {
        places.iter().map(|(_, place)| place[axis]).reduce(better).unwrap_or(0.0)
    };
    let [low, high] = [f64::min, f64::max].map(|better| [bound(0, better), bound(1, better)]);
    let extent = (high[0] - low[0]).max(high[1] - low[1]);
    let side = cell_mm * (extent / cell_mm / ACROSS).ceil().max(1.0);
    let corner = low.map(|low| ((low / side).floor() - 1.0) * side);
    let cells = |axis: usize| ((high[axis] - corner[axis]) / side).floor() as u64 + 2;
    Ok((Layout::open(cells(0), cells(1))?, corner, side))
}
