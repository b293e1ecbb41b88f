//! `tautline judge`: a log of robots that this program did not move, held to clauses by a judge that knows no rule.

pub(super) mod ground;
pub(super) mod report;

use std::path::PathBuf;

use clap::Args;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_logs::{
    CLAUSES, Demand, Doubt, Fault, FaultPlace, Kind, Limits, Log, NamesError, Numbers, Strays, Tracks,
    Verdict, judge, misplaced, not_judged, read,
};
use tautline_proofs::ledger;

use self::ground::{LogMap, MapArgs};
use self::report::{LogReport, metres};
use super::exit::Exit;
use super::options::{ForceArgs, Format, FormatArgs, refuse_needless};
use super::output::Output;
use super::value_parser::{above_0, from_0};
use tautline_sim::draw::page;

const EXAMPLES: &str = "\
Examples:
  tautline judge log.csv --clauses CHAIN-3
  tautline judge field.mcap --clauses CHAIN-2,CHAIN-3 --names names.csv --cell 0.5 --tolerance 0.1
  tautline judge log.jsonl --clauses KIT-12,KIT-3 --gap 2 --svg moment.svg
  tautline judge log.csv --clauses FRONTIER-1,FRONTIER-2 --map floor.yaml --cell 0.5 --radius 0.2

LOG is a table (CSV) with columns time, robot, x and y, lines of JSON with these fields or like messages of ROS, or a \
recording of ROS 2 in MCAP. Names end with units that are not seconds and metres: t_ms, x_mm. docs/judge.md shows all \
of it.

Clauses, and what each demands of a log:
  CHAIN-2     at most two robots are in a cell, the base left out
  CHAIN-3     robots whose numbers follow each other are in range
  KIT-1       two robots are in range of each other
  KIT-3       robots that have left their starts keep the least distance
  KIT-12      robots that hear each other at first, directly or over others, always do
  FRONTIER-1  every cell that robots can reach was visited when the log ends; it takes --map
  FRONTIER-2  at most one robot is in a cell
  PACK-2      at most one robot is in a cell";

/// The longest log that is read.
const MOST_BYTES: u64 = 1 << 30;

/// Judge a log of robots, whatever program moved them: is a clause kept, broken, or does the log not say enough?
///
/// The judge looks at positions alone. It knows no rule, and shares no code with one.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Judge {
    /// The log.
    log: PathBuf,
    /// The clauses, with commas between them; they are listed below.
    #[arg(long, value_name = "CLAUSE", required = true, value_delimiter = ',', value_parser = clause)]
    clauses: Vec<(&'static str, Kind)>,
    /// A file of lines NAME,NUMBER: which name of the log is which robot, from 1. Without it names are numbered in
    /// their order, robot 2 before robot 10.
    #[arg(long, value_name = "FILE")]
    names: Option<PathBuf>,
    #[command(flatten)]
    map: MapArgs,
    /// The range in metres, in place of 2.549 cells in CHAIN-3 and 10 m in KIT-1 and KIT-12.
    #[arg(long, value_name = "METRES", value_parser = above_0)]
    range: Option<f64>,
    /// The least distance of KIT-3 in metres, in place of 3 m.
    #[arg(long, value_name = "METRES", value_parser = above_0)]
    least: Option<f64>,
    /// How far off a distance, or a position at the border of a cell, may be, in metres.
    #[arg(long, value_name = "METRES", value_parser = from_0, default_value = "0.05")]
    tolerance: f64,
    /// The longest time between two positions of a robot that says where it was meanwhile, in seconds.
    #[arg(long, value_name = "SECONDS", value_parser = above_0, default_value = "1")]
    gap: f64,
    /// A stamp that is farther off than this from those before and behind it is not taken, in seconds.
    #[arg(long, value_name = "SECONDS", value_parser = above_0, default_value = "60")]
    jump: f64,
    /// Store the first moment in which a clause is broken as a picture.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Store the verdicts as a page, with the positions before the first breach.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

/// A clause that positions decide.
fn clause(id: &str) -> Result<(&'static str, Kind), String> {
    let id = id.trim().to_ascii_uppercase();
    CLAUSES.into_iter().find(|(known, _)| *known == id).ok_or_else(|| {
        let known = CLAUSES.map(|(known, _)| known).join(", ");
        let why = if ledger::clauses().any(|clause| clause.id == id) {
            format!("positions do not decide it: {}", not_judged(&id))
        } else {
            "there is no such clause".to_owned()
        };
        format!("{why}; name some of {known}")
    })
}

/// The whole thousandths of metres; decimal fractions are a little off.
fn milli(metres: f64) -> u32 {
    (metres * 1e3 + 1e-6) as u32
}

impl Judge {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let inputs =
            [Some(self.log.clone()), self.names.clone()].into_iter().flatten().chain(self.map.inputs());
        let [svg, html] = self.force.files([&self.svg, &self.html], inputs)?;
        self.check()?;
        let given = self.map.load(self.has(|kind| matches!(kind, Kind::Visited)))?;
        if given.layout().is_some() {
            given.check_cells("--map", &self.limits())?;
        }
        let bytes = ground::bytes(&self.log, MOST_BYTES, "cut it into parts")?;
        let log = read(&bytes).map_err(|fault| self.unread(fault))?;
        drop(bytes);
        let numbers = self.numbers(&log)?;
        let limits = self.limits();
        let tracks = Tracks::new(&log, &numbers, &limits);
        let misplaced = given.ground().map(|ground| misplaced(&tracks, &limits, given.grid(), ground));
        let is_other = misplaced.is_some_and(|misplaced| is_other_map(misplaced, &tracks));
        let mut verdicts = Vec::new();
        for (place, &(id, kind)) in self.clauses.iter().enumerate() {
            if self.clauses[..place].iter().any(|(before, _)| *before == id) {
                continue;
            }
            let demand = self.demand(id, kind, &given, &tracks, &limits, &log)?;
            let has_base = matches!(kind, Kind::Crowd { is_base_free: true, .. });
            let astray = if matches!(kind, Kind::Visited) { given.astray(&tracks, &limits) } else { None };
            let verdict = if is_other {
                Verdict::Unknown(Doubt::OtherMap)
            } else if has_base && given.is_base_in_doubt(&tracks, &limits) {
                Verdict::Unknown(Doubt::Base)
            } else {
                judge(&tracks, &limits, &demand).map_err(|much| self.too_much(id, &much.to_string()))?
            };
            let verdict = match (verdict, astray) {
                (Verdict::Kept, Some(robot)) => Verdict::Unknown(Doubt::Astray(robot)),
                (verdict, _) => verdict,
            };
            verdicts.push((id, demand, verdict));
        }
        let told = LogReport {
            file: self.log.display().to_string(),
            log: &log,
            numbers: &numbers,
            tracks: &tracks,
            limits: &limits,
            given: &given,
            misplaced,
            verdicts: &verdicts,
        };
        out.store(svg, |svg| svg.draw(told.picture().map_err(Halt::from)))?;
        out.store(html, |html| {
            let text = told.text();
            let (first, words) = text.split_once('\n').unwrap_or((&text, ""));
            html.draw(Ok(page::in_words(&told.title(), first, words, &told.moments())))
        })?;
        match self.format.format {
            Format::Json => out.json(&told.json())?,
            Format::Text => out.text(told.text())?,
        }
        let exit = |(_, _, verdict): &(_, _, Verdict)| match verdict {
            Verdict::Kept => Exit::Expected,
            Verdict::Broken(_) => Exit::Violation,
            Verdict::Unknown(_) => Exit::Unfinished,
        };
        Ok(verdicts.iter().map(exit).max().unwrap_or(Exit::Expected))
    }

    fn limits(&self) -> Limits {
        let micros = |seconds: f64| (seconds * 1e6).round() as u64;
        Limits { tolerance_mm: milli(self.tolerance), gap_us: micros(self.gap), jump_us: micros(self.jump) }
    }

    /// Whether one of the clauses is of such a kind.
    fn has(&self, is_it: fn(&Kind) -> bool) -> bool {
        self.clauses.iter().any(|(_, kind)| is_it(kind))
    }

    /// Refuses options that have no effect.
    fn check(&self) -> Result<(), Diagnostic> {
        let has_range = self.has(|kind| matches!(kind, Kind::Neighbours | Kind::Pair | Kind::Joined));
        let why = "CHAIN-3, KIT-1 and KIT-12 alone have a range";
        refuse_needless([("--range", self.range.is_some() && !has_range)], why)?;
        let has_least = self.has(|kind| matches!(kind, Kind::Apart));
        let why = "KIT-3 alone has a least distance";
        refuse_needless([("--least", self.least.is_some() && !has_least)], why)?;
        let has_cells = self.has(|kind| matches!(kind, Kind::Crowd { .. } | Kind::Visited));
        let has_base = self.has(|kind| matches!(kind, Kind::Crowd { is_base_free: true, .. }));
        let is_range_in_cells = self.range.is_none() && self.has(|kind| matches!(kind, Kind::Neighbours));
        self.map.check((has_cells, has_base), is_range_in_cells)
    }

    /// The numbers of the robots.
    fn numbers(&self, log: &Log) -> Result<Numbers, Diagnostic> {
        let Some(file) = &self.names else { return Ok(Numbers::natural(&log.names)) };
        let bytes = ground::bytes(file, MOST_BYTES, "cut it into parts")?;
        let text = String::from_utf8_lossy(&bytes);
        Numbers::named(&log.names, &text).map_err(|wrong| {
            let remedy = "write lines as robot_a,1 with the names of the log and the numbers of robots, from 1, each \
                          once";
            match wrong {
                NamesError::Line(line) | NamesError::Twice(line) => {
                    let text = text.lines().nth(line - 1).unwrap_or_default();
                    Diagnostic::in_line(file, line, text, 0..text.len(), wrong, remedy)
                }
                NamesError::Gap(_) | NamesError::Nothing(_) => Diagnostic::in_file(file, wrong, remedy),
            }
        })
    }

    /// The demand of a clause.
    fn demand(
        &self,
        id: &str,
        kind: Kind,
        given: &LogMap,
        tracks: &Tracks,
        limits: &Limits,
        log: &Log,
    ) -> Result<Demand, Diagnostic> {
        /// Metres of KIT: within them robots hear each other, and nearer than that they never come.
        const KIT_RANGE: f64 = 10.0;
        const KIT_LEAST: f64 = 3.0;
        let below = |length_mm: u32, option: &str| {
            if limits.tolerance_mm < length_mm {
                return Ok(length_mm);
            }
            let what =
                format!("{id} speaks of distances, and with this tolerance a log says nothing of them");
            Err(Diagnostic::usage(what, format!("give a --tolerance below {option}")))
        };
        let range = |default: f64| {
            let range_mm = milli(self.range.unwrap_or(default));
            below(range_mm, &format!("the range of {} m", metres(range_mm.into())))
        };
        Ok(match kind {
            Kind::Neighbours => Demand::Neighbours { range_mm: range(6.5_f64.sqrt() * given.cell_m())? },
            Kind::Pair if tracks.count() != 2 => {
                let what = format!("{id} speaks of two robots, and the log has {}", tracks.count());
                return Err(Diagnostic::in_file(&self.log, what, "name KIT-12, or two robots with --names"));
            }
            Kind::Pair => Demand::Joined { range_mm: range(KIT_RANGE)?, of: tautline_logs::Group::All },
            Kind::Joined => {
                Demand::Joined { range_mm: range(KIT_RANGE)?, of: tautline_logs::Group::JoinedAtStart }
            }
            Kind::Apart => {
                Demand::Apart { least_mm: below(milli(self.least.unwrap_or(KIT_LEAST)), "--least")? }
            }
            Kind::Crowd { most, is_base_free } => {
                given.check_cells(id, limits)?;
                let base = is_base_free.then(|| given.base(tracks).ok_or_else(|| self.no_base(id)));
                Demand::Crowd { grid: given.grid(), most, base: base.transpose()? }
            }
            Kind::Visited => {
                given.check_cells(id, limits)?;
                Demand::Visited {
                    grid: given.grid(),
                    cells: given.reachable(tracks, limits),
                    is_whole: log.cut.is_none(),
                }
            }
        })
    }

    /// The fault of a log that cannot be read.
    fn unread(&self, fault: Fault) -> Diagnostic {
        let Fault { place, what, remedy } = fault;
        match place {
            FaultPlace::Whole => Diagnostic::in_file(&self.log, what, remedy),
            FaultPlace::Line { line, text, bytes } => {
                Diagnostic::in_line(&self.log, line, &text, bytes, what, remedy)
            }
            FaultPlace::Message(message) => {
                Diagnostic::in_file(&self.log, format_args!("message {message}: {what}"), remedy)
            }
        }
    }

    fn no_base(&self, id: &str) -> Diagnostic {
        let what = format!(
            "{id} leaves out the base, where robot 1 is first, and the log has no position of robot 1"
        );
        Diagnostic::in_file(&self.log, what, "say where the base is with --base")
    }

    fn too_much(&self, id: &str, what: &str) -> Diagnostic {
        let remedy = "judge a part of the log, or fewer robots with --names";
        Diagnostic::in_file(&self.log, format_args!("for {id} {what}"), remedy)
    }
}

/// Whether more than half of the positions are not of the map.
fn is_other_map(misplaced: Strays, tracks: &Tracks) -> bool {
    misplaced.off.is_some_and(|(off, _)| off as usize * 2 > tracks.samples().count())
}
