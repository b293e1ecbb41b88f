//! `tautline replay`: a stored run again.

use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use schemars::JsonSchema;
use serde::ser::{Error, SerializeSeq};
use serde::{Serialize, Serializer};
use tautline_io::atomic_file::AtomicFile;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_io::json_lines;
use tautline_kernel::ground::Area;
use tautline_proofs::clause::{AnyCheck, Clause};
use tautline_proofs::decide::{Depiction, Evidence};
use tautline_proofs::judge::Case;
use tautline_proofs::judge::chain::judges;
use tautline_proofs::ledger::indented;
use tautline_proofs::plural::counted;
use tautline_proofs::run::Frame;

use super::catalogue::CATALOGUE;
use super::evidence::{self, EvidenceJson, setup, shown, story};
use super::exit::Exit;
use super::explore::{DrawnMoves, draw_moves, summary};
use super::options::{ForceArgs, Format, FormatArgs};
use super::output::Output;
use super::rescue::{Files, tell};
use super::viewers::{self, ViewerArgs, ViewerFiles};
use tautline_field::rescue;
use tautline_sim::counterexample::refutation::{self, Refutation};
use tautline_sim::draw::{self, page, svg};
use tautline_sim::explore::judge_input::judge_input;
use tautline_sim::explore::{ClauseId, Play, Report, Setup, team};
use tautline_sim::trace::{self, ForeignRun, StoredMove, StoredRun, Summary, Trace};

const EXAMPLES: &str = "\
Examples:
  tautline replay chain-1-published-n4.jsonl
  tautline replay run.jsonl --moves 10..20
  tautline replay run.jsonl --all
  tautline replay run.jsonl --html run.html
  tautline replay rescue.jsonl --svg map.svg";

/// Play a stored run, counterexample or rescue, and check that it is what its rule makes.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Replay {
    /// A file that `explore --trace`, `rescue --trace`, `hunt`, `minimise`, `prove --out` or `library --out` wrote.
    file: PathBuf,
    /// The team moves to show, the first and the last. Without it the last 100 are shown, or as many as fit into 500
    /// lines.
    #[arg(long, value_name = "A..B", allow_hyphen_values = true)]
    moves: Option<Moves>,
    /// Show all team moves.
    #[arg(long, conflicts_with = "moves")]
    all: bool,
    /// Store the run as a page that plays it.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Store the team moves as a picture, by default the last one; of a rescue the map.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    #[command(flatten)]
    viewers: ViewerArgs,
    #[command(flatten)]
    force: ForceArgs,
    #[command(flatten)]
    format: FormatArgs,
}

/// The files in which a run is stored.
struct RunFiles {
    page: Option<AtomicFile>,
    picture: Option<AtomicFile>,
    viewers: ViewerFiles,
}

/// Team moves from the first to the last.
#[derive(Clone, Debug)]
struct Moves(RangeInclusive<u32>);

impl FromStr for Moves {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parts: Option<(u32, u32)> =
            text.split_once("..").and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
        match parts {
            None => Err("write the first and the last team move as A..B, for example 10..20".to_owned()),
            Some((0, last)) => Err(format!("team moves are counted from 1 on; write 1..{}", last.max(1))),
            Some((first, last)) if last < first => {
                Err(format!("the first team move comes after the last; write {last}..{first}"))
            }
            Some((first, last)) => Ok(Self(first..=last)),
        }
    }
}

/// The remedy that names the files that can be replayed.
const REPLAYABLE: &str = "name a file that `tautline explore --trace`, `tautline rescue --trace`, `tautline hunt`, \
                          `tautline minimise` or `tautline prove --out` wrote";

/// Team moves that are shown of a run when nobody says which.
const SHOWN: u32 = 100;

/// Robots that the judge can judge, over all team moves of a counterexample: all of them are held.
const MAX_JUDGED: usize = 1 << 22;

#[derive(JsonSchema, Serialize)]
pub(super) struct ReplayJson<'a> {
    #[serde(flatten)]
    run: Summary<'a>,
    /// The clause that the file says it is a counterexample to. Where a judge reads such a run, the judge agrees.
    counterexample_to: Option<ClauseId>,
    /// Of a scheme that this program does not know, that its rule was not run.
    #[serde(skip_serializing_if = "Option::is_none")]
    is_rule_run: Option<bool>,
    /// Of such a scheme, the broken demand in words, if the file has them.
    #[serde(skip_serializing_if = "Option::is_none")]
    demand: Option<&'a str>,
    /// Of such a scheme, the number of the first robot.
    #[serde(skip_serializing_if = "Option::is_none")]
    numbered_from: Option<usize>,
    #[schemars(with = "Vec<StoredMove>")]
    moves: MovesJson<'a>,
}

/// Team moves of a run, made one by one as they are written.
struct MovesJson<'a> {
    run: &'a dyn Play,
    moves: &'a RangeInclusive<u32>,
}

impl Serialize for MovesJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(None)?;
        let mut written = Ok(());
        self.run
            .among(self.moves, &mut |made| {
                if written.is_ok() {
                    written = list.serialize_element(&StoredMove::new(made, self.run.setup().scheme.look));
                }
                Ok(())
            })
            .map_err(|_| S::Error::custom("the run cannot be made again"))?;
        written?;
        list.end()
    }
}

#[derive(JsonSchema, Serialize)]
pub(super) struct RefutationJson {
    file: String,
    counterexample_to: &'static str,
    rule: &'static str,
    engine: &'static str,
    bound: String,
    counterexample: EvidenceJson,
    /// Whether a judge who shares no code with the rule has accepted it.
    is_judged: bool,
}

impl Replay {
    /// The replay that stores a page.
    pub(super) fn as_page(file: PathBuf, html: PathBuf, force: ForceArgs) -> Self {
        let format = FormatArgs { format: Format::Text };
        Self {
            file,
            moves: None,
            all: false,
            html: Some(html),
            svg: None,
            viewers: ViewerArgs::default(),
            force,
            format,
        }
    }

    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let [itf, mcap] = self.viewers.paths();
        let files = [&self.html, &self.svg, itf, mcap];
        let [page, picture, itf, mcap] = self.force.files(files, [self.file.clone()])?;
        let viewers = [itf, mcap];
        match json_lines::format(&self.file).as_deref() {
            Some(rescue::trace::FORMAT) => {
                let [itf, recording] = viewers;
                viewers::refuse(itf.as_ref(), ("--itf", "a rescue"), &self.file)?;
                self.run_rescue(Files { trace: None, page, map: picture, recording }, out)
            }
            Some(refutation::FORMAT) => {
                for (file, option) in viewers.iter().zip(["--itf", "--mcap"]) {
                    viewers::refuse(file.as_ref(), (option, "a refutation"), &self.file)?;
                }
                self.run_refutation(page, out)
            }
            format => {
                let is_run = format == Some(trace::FORMAT);
                let foreign = |fault: Diagnostic| if is_run { fault } else { fault.with_remedy(REPLAYABLE) };
                let files = RunFiles { page, picture, viewers };
                match trace::open(&self.file, CATALOGUE).map_err(foreign)? {
                    StoredRun::Known(trace) => self.run_team(trace, files, out),
                    StoredRun::Foreign(run) => self.run_recorded(&run, files, out),
                }
            }
        }
    }

    fn run_team(&self, trace: Trace, files: RunFiles, out: &mut Output) -> Result<Exit, Halt> {
        let (setup, clause) = (trace.setup.clone(), trace.clause);
        self.check_drawing(team(&setup)?.area(&setup.layout), &files)?;
        let case = |frames: &[Frame]| (setup.scheme.case)(&setup, clause?, frames);
        let (is_read, mut frames) = (case(&[]).is_some(), Vec::new());
        let report = trace.replay(&mut |made| {
            frames.extend(is_read.then(|| made.frame.clone()));
            if frames.len() * usize::from(setup.robots) <= MAX_JUDGED {
                return Ok(());
            }
            let what = format!("the judge reads no more than {MAX_JUDGED} robots in all team moves");
            Err(Diagnostic::in_file(&self.file, what, "shrink the run with `tautline minimise`").into())
        })?;
        let is_judged = self.judge_case(case(&frames))?;
        let said = clause.map(|clause| said(clause.as_str(), is_judged));
        self.show(&setup, &report, clause, Remarks { said, is_rule_run: None }, files, out)
    }

    /// A run of a scheme that this program does not know, as it was written.
    fn run_recorded(&self, run: &ForeignRun, files: RunFiles, out: &mut Output) -> Result<Exit, Halt> {
        let Setup { scheme, rule, layout, .. } = run.setup();
        let scheme = scheme.name;
        self.check_drawing(layout.size().area(), &files)?;
        let report = run.play(&mut |_| Ok(()))?;
        let said = format!(
            "this program does not know the scheme {scheme}: its rule {rule} was not run, the team moves are those of \
             the file"
        );
        let named = run.clause.map_or_else(String::new, |clause| {
            format!("\nthe file says that it is a counterexample to {clause}")
        });
        self.show(
            run,
            &report,
            run.clause,
            Remarks { said: Some(said + &named), is_rule_run: Some(false) },
            files,
            out,
        )
    }

    /// Checks that a page and a picture can hold what they are to show of `area`.
    fn check_drawing(&self, area: Area, files: &RunFiles) -> Result<(), Diagnostic> {
        let RunFiles { page, picture, .. } = files;
        if page.is_some() || picture.is_some() {
            svg::check_size(area)?;
        }
        match (picture, &self.moves) {
            (Some(_), Some(Moves(moves))) => svg::check_moves(moves),
            _ => Ok(()),
        }
    }

    /// Draws and tells a run that came out as `report`.
    fn show(
        &self,
        run: &dyn Play,
        report: &Report,
        clause: Option<ClauseId>,
        told: Remarks,
        RunFiles { page, picture, viewers }: RunFiles,
        out: &mut Output,
    ) -> Result<Exit, Halt> {
        let is_drawn = page.is_none() && picture.is_none();
        let moves = self.moves(report)?;
        let is_said = self.all || self.moves.is_some();
        let [all, last] = [1, report.steps].map(|first| first..=report.steps);
        out.store(page, |page| page::write(page, run, report, if is_said { &moves } else { &all }))?;
        out.store(picture, |picture| {
            picture.draw(svg::team_moves(run, report, if is_said { &moves } else { &last }))
        })?;
        viewers::store(viewers, run, out)?;
        let name = self.file.display().to_string();
        match self.format.format {
            Format::Json => {
                let foreign = told.is_rule_run.map(|_| run);
                out.json(&ReplayJson {
                    run: Summary::new(run, &name, report),
                    counterexample_to: clause,
                    is_rule_run: told.is_rule_run,
                    demand: foreign.zip(clause).and_then(|(run, clause)| run.sentence(clause)),
                    numbered_from: foreign.map(|run| run.setup().scheme.look.first_number()),
                    moves: MovesJson { run, moves: &moves },
                })?;
            }
            Format::Text => {
                out.text(summary(run, &name, report))?;
                if let Some(said) = told.said {
                    out.text(format_args!("{said}\n"))?;
                }
                if is_drawn {
                    let wanted = if is_said { DrawnMoves::All(moves) } else { DrawnMoves::Last(moves) };
                    let first = *draw(run, report, &wanted, out)?.start();
                    if !is_said && first > 1 {
                        let left = if first == 2 {
                            "Team move 1 is".to_owned()
                        } else {
                            format!("Team moves 1 to {} are", first - 1)
                        };
                        out.text(format_args!(
                            "\n{left} not shown: --moves A..B shows some, --all every one.\n"
                        ))?;
                    }
                }
            }
        }
        Ok(if report.violations.is_empty() { Exit::Expected } else { Exit::Violation })
    }

    fn run_rescue(&self, files: Files, out: &mut Output) -> Result<Exit, Halt> {
        if self.moves.is_some() || self.all {
            let what = "a rescue has no team moves";
            let option = if self.all { "--all" } else { "--moves" };
            let remedy = format!("leave out {option}, or name a run of a team");
            return Err(Diagnostic::usage(what, remedy).into());
        }
        let (setting, seed, report) = rescue::trace::replay(&self.file)?;
        tell(out, self.format.format, (&setting, seed, &report), files)
    }

    fn run_refutation(&self, page: Option<AtomicFile>, out: &mut Output) -> Result<Exit, Halt> {
        if self.moves.is_some() || self.all || self.svg.is_some() {
            let what = "a refutation has no team moves to choose from, and no picture";
            let remedy = "leave out --moves, --all and --svg, or name a run of a team; a refutation has a page, with \
                          --html";
            return Err(Diagnostic::usage(what, remedy).into());
        }
        let Refutation { clause, check, evidence } = evidence::read(&self.file)?;
        let is_judged = self.is_judged(clause, check, &evidence)?;
        let (rule, engine, bound) = (check.rule(), check.engine(), check.bound());
        let story = story(clause, check, &evidence)?;
        out.store(page, |page| evidence::page(clause, check, &evidence, page))?;
        match self.format.format {
            Format::Json => out.json(&RefutationJson {
                file: self.file.display().to_string(),
                counterexample_to: clause.id,
                rule,
                engine,
                bound,
                counterexample: shown(check, &evidence)?,
                is_judged,
            })?,
            Format::Text => {
                let judged = said(clause.id, is_judged);
                out.text(format_args!(
                    "{}: a counterexample to {} as {rule}, by {engine} within\n{}{judged}\n\n{story}",
                    self.file.display(),
                    clause.id,
                    indented(2, &bound)
                ))?;
            }
        }
        Ok(Exit::Violation)
    }

    /// Whether a judge who shares no code with the rule accepts it; where there is none for the clause, none does.
    fn is_judged(&self, clause: &Clause, check: &dyn AnyCheck, evidence: &Evidence) -> Result<bool, Halt> {
        match &evidence.seen {
            Depiction::Robots(run) => match setup(check, run)? {
                Some(setup) if judges(clause.id) => {
                    self.judge_case(Some(Box::new(judge_input(&setup, clause.id, &run.frames))))
                }
                Some(_) | None => Ok(false),
            },
            Depiction::Agents(_) | Depiction::Choices | Depiction::Story(_) | Depiction::Messages { .. } => {
                self.judge_case(check.case(&evidence.choices))
            }
        }
    }

    /// Whether a judge accepts what is written down for it, if anything is.
    fn judge_case(&self, case: Option<Box<impl Case + ?Sized>>) -> Result<bool, Halt> {
        let Some(case) = case else { return Ok(false) };
        case.judge().map_err(|objection| self.rejected(&objection.of(case.step())))?;
        Ok(true)
    }

    /// The judge has an objection.
    fn rejected(&self, objection: &str) -> Diagnostic {
        let what = format!("the judge rejects this counterexample: {objection}");
        Diagnostic::in_file(&self.file, what, "make it again with `tautline hunt` or `tautline prove --out`")
    }

    /// The team moves to show.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the run has none of those that are asked for.
    fn moves(&self, report: &Report) -> Result<RangeInclusive<u32>, Diagnostic> {
        match &self.moves {
            Some(Moves(moves)) if *moves.start() > report.steps => {
                let what = format!("the run has {}, from 1 on", counted(report.steps, "team move"));
                let remedy = "give `moves` the first and the last of some of them";
                Err(Diagnostic::of_field("moves", what, remedy))
            }
            Some(Moves(moves)) => Ok(moves.clone()),
            None if self.all => Ok(1..=report.steps),
            None => Ok(report.steps.saturating_sub(SHOWN - 1).max(1)..=report.steps),
        }
    }
}

/// The words about a run besides its outcome.
struct Remarks {
    /// Lines of text.
    said: Option<String>,
    is_rule_run: Option<bool>,
}

/// Who has judged a counterexample.
fn said(clause: &str, is_judged: bool) -> String {
    if is_judged {
        format!("the judge accepts it as a counterexample to {clause}")
    } else {
        "no independent judge for this clause: the rule itself was played again".to_owned()
    }
}

/// Draws the team moves, and tells the story of every violation among them; which ones are drawn.
pub(super) fn draw(
    run: &dyn Play,
    report: &Report,
    wanted: &DrawnMoves,
    out: &mut Output,
) -> Result<RangeInclusive<u32>, Halt> {
    let moves = draw_moves(run, report, wanted, draw::Pose::After, out)?;
    if report.violations.iter().any(|violation| moves.contains(&violation.step)) {
        run.among(&moves, &mut |made| {
            if made.broken.is_empty() || out.is_gone() {
                return Ok(());
            }
            Ok(out.text(format_args!("\n{}", draw::story::of(run, &report.chart, made)))?)
        })?;
    }
    let end = draw::story::of_end(run, report);
    if moves.contains(&report.steps) && !end.is_empty() {
        out.text(format_args!("\n{end}"))?;
    }
    Ok(moves)
}
