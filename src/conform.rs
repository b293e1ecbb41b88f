//! `tautline conform`: a stored run against a program that is not this one. The program is told line by line what the
//! model's robots learn, and answers with what it plans; the first difference is shown.

mod program;

use std::ffi::OsString;
use std::num::NonZeroU32;
use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_kernel::chain::Kind;
use tautline_kernel::ground::{Cell, Edge, Side, Step};
use tautline_proofs::plural::counted;
use tautline_proofs::run::Frame;

use self::program::Program;
use super::catalogue::CATALOGUE;
use super::exit::Exit;
use super::options::{Format, FormatArgs};
use super::output::Output;
use super::value_parser::positive;
use tautline_grids::layout::ColumnRow;
use tautline_grids::layout::Layout;
use tautline_io::text_blocks::{Block, beside};
use tautline_sim::draw::{self, Pose};
use tautline_sim::explore::{Completeness, Play, Report, Senses, Setup, StopReason, Survey, TeamMove};
use tautline_sim::options::Options;
use tautline_sim::trace::{self, StoredRun, steps};

const EXAMPLES: &str = "\
Examples:
  tautline conform chain-1-published-n4.jsonl -- ./chain
  tautline conform run.jsonl --patience 60 -- python3 robots.py --fast";

/// Seconds that an answer may take, unless the user says otherwise.
const PATIENCE: NonZeroU32 = NonZeroU32::new(10).expect("it is above 0");

/// Hold a program of yours to a stored run: it is told what the robots learn, and must plan what they did.
///
/// The program reads lines of JSON and answers each team move with one. docs/conform.md shows all of them.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Conform {
    /// A file that `explore --trace`, `hunt`, `minimise` or `prove --out` wrote.
    file: PathBuf,
    /// Seconds that each answer may take.
    #[arg(long, value_name = "SECONDS", value_parser = positive::<NonZeroU32>, default_value_t = PATIENCE)]
    patience: NonZeroU32,
    #[command(flatten)]
    format: FormatArgs,
    /// The program and its arguments.
    #[arg(last = true, required = true, value_name = "PROGRAM")]
    program: Vec<OsString>,
}

/// A line that the program reads.
#[derive(JsonSchema, Serialize)]
#[serde(untagged)]
pub(super) enum ToldLine<'a> {
    /// The first: which run it is.
    Run {
        format: &'static str,
        version: u32,
        scheme: &'a str,
        rule: &'a str,
        robots: usize,
        /// Columns and rows.
        size: [i16; 2],
        #[schemars(with = "Vec<ColumnRow>")]
        starts: Vec<Cell>,
        /// 0 where robots are counted from 0; left out where from 1.
        #[serde(skip_serializing_if = "Option::is_none")]
        numbered_from: Option<usize>,
    },
    /// One before each team move: an answer is due.
    Move(Learnt<'a>),
    /// The last.
    End { end: StopReason },
}

/// The news for the robots since the last team move.
#[derive(JsonSchema, Serialize)]
pub(super) struct Learnt<'a> {
    /// The number of the team move to be planned, from 1.
    step: u32,
    /// Where the robots are.
    #[schemars(with = "Vec<ColumnRow>")]
    cells: &'a [Cell],
    /// The numbers of the robots that met a wall in the last team move.
    blocked: Vec<usize>,
    /// On a sensor floor, the open sides of each agent's cell.
    #[serde(skip_serializing_if = "Option::is_none")]
    sides: Option<Vec<String>>,
    /// Likewise, of the eight cells around it, clockwise from 0 in the north, those from which the next is open.
    #[serde(skip_serializing_if = "Option::is_none")]
    rims: Option<Vec<String>>,
}

/// A line that the program writes: what each robot tries, or that nothing is left to do.
#[derive(JsonSchema, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Answer {
    /// One letter a robot.
    #[serde(skip_serializing_if = "Option::is_none")]
    tried: Option<String>,
    /// Not compared if it is left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<String>")]
    kind: Option<Kind>,
    /// True, if it is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    done: Option<bool>,
}

#[derive(JsonSchema, Serialize)]
pub(super) struct ConformJson<'a> {
    file: String,
    scheme: &'a str,
    rule: &'a str,
    robots: u16,
    /// Team moves of the run.
    steps: u32,
    /// Those before the first difference.
    same: u32,
    difference: Option<DifferenceJson>,
}

/// The first difference. Who has nothing left to do tries nothing.
#[derive(JsonSchema, Serialize)]
struct DifferenceJson {
    step: u32,
    /// The number of the first robot that differs, if it is not the kind of the team move, or the end.
    robot: Option<usize>,
    model: Option<StoredPlan>,
    program: Option<StoredPlan>,
}

/// A planned team move.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize)]
struct StoredPlan {
    tried: String,
    #[schemars(with = "String")]
    kind: Kind,
}

/// The step of each robot as a program plans it, and the kind of team move, if it says so.
type Plan = (Vec<Step>, Option<Kind>);

/// The first difference, drawn.
struct Difference {
    told: DifferenceJson,
    drawing: Option<[Block; 2]>,
}

/// The run and the program that is held to it.
struct Trial<'a> {
    run: &'a dyn Play,
    chart: &'a Survey,
    program: Program,
    /// The robots that met a wall in the last team move.
    blocked: Vec<usize>,
    difference: Option<Difference>,
}

impl Conform {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let (run, report): (Box<dyn Play>, Report) = match trace::open(&self.file, CATALOGUE)? {
            StoredRun::Known(trace) => {
                let setup = trace.setup.clone();
                check(&setup).map_err(|fault| fault.found_in(&self.file))?;
                (Box::new(setup), trace.replay(&mut |_| Ok(()))?)
            }
            StoredRun::Foreign(run) => {
                let report = run.play(&mut |made| match made.team.title() {
                    None => Ok(()),
                    Some(title) => Err(untold(title, made.step).found_in(&self.file).into()),
                })?;
                (Box::new(run), report)
            }
        };
        let program = Program::start(&self.program, Duration::from_secs(self.patience.get().into()))?;
        let trial =
            Trial { run: &*run, chart: &report.chart, program, blocked: Vec::new(), difference: None };
        let found = trial.hold(&report)?;
        self.tell(&*run, &report, found, out)
    }

    /// Tells how far program and model agree.
    fn tell(
        &self,
        run: &dyn Play,
        report: &Report,
        found: Option<Difference>,
        out: &mut Output,
    ) -> Result<Exit, Halt> {
        let exit = if found.is_some() { Exit::Violation } else { Exit::Expected };
        let setup = run.setup();
        let file = self.file.display().to_string();
        let same = found.as_ref().map_or(report.steps, |found| found.told.step - 1);
        if self.format.format == Format::Json {
            let difference = found.map(|found| found.told);
            let (scheme, rule, robots) = (setup.scheme.name, setup.rule.as_str(), setup.robots);
            out.json(&ConformJson { file, scheme, rule, robots, steps: report.steps, same, difference })?;
            return Ok(exit);
        }
        out.text(format_args!("{}: {file}\n", setup.title()))?;
        let Some(Difference { told, drawing }) = found else {
            out.text(format_args!(
                "the program plans all {} as the model does\n",
                counted(report.steps, "team move")
            ))?;
            return Ok(exit);
        };
        let first = setup.scheme.look.first_number();
        let same = match same {
            0 => "the program differs".to_owned(),
            _ => format!("the program plans {} as the model does, and differs", counted(same, "team move")),
        };
        out.text(format_args!("{same} in team move {}:\n{}", told.step, told.words(first)))?;
        if let Some(drawing) = drawing {
            let legend = draw::legend(setup.scheme.look);
            out.text(format_args!("\n{legend}\n\n{}", beside(drawing.into())))?;
        }
        Ok(exit)
    }
}

/// Refuses runs of which a program would have to know what it is not told.
fn check(setup: &Setup) -> Result<(), Diagnostic> {
    let scheme = setup.scheme;
    let what = if scheme.told == Completeness::Part {
        format!("robots of {} learn more than where they are and what they meet", scheme.name)
    } else if scheme.draws(setup) || !setup.missed.is_empty() || !setup.choices.is_empty() {
        "in this run something is left to chance, or was chosen by a search".to_owned()
    } else if setup.options != Options::default() {
        "in this run something happens that the rule is not told".to_owned()
    } else {
        return Ok(());
    };
    let names = scheme.among.names(|scheme| scheme.told == Completeness::All).join(", ");
    let remedy = format!("name a run of {names}, in which nothing is missed, lost or late");
    Err(Diagnostic::usage(format_args!("{what}: no program could plan along"), remedy))
}

/// The fault of a run in which something happens that no program is told.
fn untold(title: &str, step: u32) -> Diagnostic {
    let what = format!("{title} in team move {step}, and no program is told: none could plan along");
    Diagnostic::usage(what, "name a run in which all robots act at once, none dies and no message is lost")
}

impl Trial<'_> {
    /// Goes through the run up to the first difference.
    fn hold(mut self, report: &Report) -> Result<Option<Difference>, Halt> {
        let run = self.run;
        let Setup { scheme, rule, layout, .. } = run.setup();
        let starts = run.setup().starts();
        self.program.tell(&ToldLine::Run {
            format: "tautline conform",
            version: 1,
            scheme: scheme.name,
            rule: rule.as_str(),
            robots: starts.len(),
            size: [layout.size().width(), layout.size().height()],
            starts,
            numbered_from: trace::numbered_from(scheme.look),
        });
        let made = run.play(&mut |made| {
            self.compare(made)?;
            if self.difference.is_some() { Err(Halt::Interrupted) } else { Ok(()) }
        });
        match made {
            Err(_) if self.difference.is_some() => {}
            Err(halt) => return Err(halt),
            // Agents on a floor do not know it where somebody else ends their run.
            Ok(_)
                if scheme.senses == Senses::Bumps
                    && matches!(report.stopped, StopReason::Explored | StopReason::Exhausted) =>
            {
                self.compare_end(report)?;
            }
            Ok(_) => {}
        }
        self.program.tell(&ToldLine::End { end: report.stopped });
        self.program.end();
        Ok(self.difference)
    }

    /// The plan of the program for team move `step` of robots in `cells`.
    fn asked(&mut self, step: u32, cells: &[Cell]) -> Result<Option<Plan>, Diagnostic> {
        let Setup { scheme, layout, .. } = self.run.setup();
        let around = |tell: fn(&Layout, Cell) -> String| {
            let are_told = scheme.senses == Senses::Floor;
            are_told.then(|| cells.iter().map(|&cell| tell(layout, cell)).collect())
        };
        let blocked = std::mem::take(&mut self.blocked);
        let learnt = Learnt { step, cells, blocked, sides: around(sides), rims: around(rims) };
        self.program.tell(&ToldLine::Move(learnt));
        let (answer, text) = self.program.answer::<Answer>(&format!("team move {step}"))?;
        match answer {
            Answer { tried: Some(tried), kind, done: None | Some(false) } => {
                let steps = steps(&tried, cells.len()).map_err(|what| {
                    self.program.fault(
                        &text,
                        text.find(&tried).unwrap_or_default(),
                        format_args!("{tried:?} is no plan of the team: {what}"),
                    )
                })?;
                Ok(Some((steps, kind)))
            }
            Answer { tried: None, kind: None, done: Some(true) } => Ok(None),
            Answer { .. } => {
                Err(self.program.fault(&text, 0, "an answer has either `tried`, or `done`, which is true"))
            }
        }
    }

    /// The number of the first robot.
    fn first_number(&self) -> usize {
        self.run.setup().scheme.look.first_number()
    }

    fn compare(&mut self, made: &TeamMove<'_>) -> Result<(), Halt> {
        let plan = self.asked(made.step, made.before)?;
        self.blocked = trace::blocked_numbers(made.frame, self.first_number());
        let theirs = plan.map(|(steps, kind)| self.frame(made, steps, kind.unwrap_or(made.frame.kind)));
        let model = StoredPlan::of(made.frame);
        let program = theirs.as_ref().map(StoredPlan::of);
        if program.as_ref() == Some(&model) {
            return Ok(());
        }
        let (chart, run, step) = (self.chart, self.run, made.step);
        let drawn = |who: &str, frame: &Frame| {
            let made = TeamMove { frame, broken: &[], ..*made };
            let block = draw::team_move(run, chart, &made, Pose::Before);
            Block { title: format!("{who}, {}", block.title), ..block }
        };
        let drawing = theirs.as_ref().map(|theirs| [drawn("model", made.frame), drawn("program", theirs)]);
        let told = DifferenceJson::new(self.first_number(), step, Some(model), program);
        self.difference = Some(Difference { told, drawing });
        Ok(())
    }

    /// The team move that the program plans in place of `made`.
    fn frame(&self, made: &TeamMove<'_>, steps: Vec<Step>, kind: Kind) -> Frame {
        let is_blocked = |(&cell, &step): (&Cell, &Step)| match step {
            Step::Cross(side) => !self.run.setup().layout.is_open(Edge::new(cell, side)),
            Step::Stay => false,
        };
        let blocked = made.before.iter().zip(&steps).map(is_blocked).collect();
        Frame { kind, steps, blocked, cells: made.before.to_vec() }
    }

    /// Compares at the end of the run, where the model has nothing left to do.
    fn compare_end(&mut self, report: &Report) -> Result<(), Halt> {
        let step = report.steps + 1;
        if let Some((steps, kind)) = self.asked(step, &report.team)? {
            let (kind, cells, blocked) = (kind.unwrap_or(Kind::Advance), Vec::new(), Vec::new());
            let program = StoredPlan::of(&Frame { kind, steps, blocked, cells });
            let told = DifferenceJson::new(self.first_number(), step, None, Some(program));
            self.difference = Some(Difference { told, drawing: None });
        }
        Ok(())
    }
}

impl StoredPlan {
    fn of(frame: &Frame) -> Self {
        Self { tried: frame.steps.iter().map(|&step| trace::letter(step)).collect(), kind: frame.kind }
    }

    /// Of a robot, what it tries.
    fn tries(&self, robot: usize) -> char {
        self.tried.chars().nth(robot).unwrap_or('.')
    }
}

impl DifferenceJson {
    /// The difference of team move `step` in a team of which the first robot has the number `first`.
    fn new(first: usize, step: u32, model: Option<StoredPlan>, program: Option<StoredPlan>) -> Self {
        let robot = model.as_ref().zip(program.as_ref()).and_then(|(model, program)| {
            model.tried.chars().zip(program.tried.chars()).position(|(one, other)| one != other)
        });
        Self { step, robot: robot.map(|robot| robot + first), model, program }
    }

    /// The difference in words, a line for each robot that differs; the first is number `first`.
    fn words(&self, first: usize) -> String {
        match (&self.model, &self.program) {
            (Some(model), Some(program)) => {
                let kinds = (model.kind != program.kind).then(|| {
                    let word = |kind| match kind {
                        Kind::Advance => "an advance",
                        Kind::Backtrack => "a backtrack",
                    };
                    format!("the model plans {}, the program {}\n", word(model.kind), word(program.kind))
                });
                let robots =
                    (0..model.tried.len()).filter(|&robot| model.tries(robot) != program.tries(robot));
                let tries = |robot| {
                    format!(
                        "robot {}: the model {}, the program {}\n",
                        robot + first,
                        model.tries(robot),
                        program.tries(robot)
                    )
                };
                kinds.into_iter().chain(robots.map(tries)).collect()
            }
            (Some(model), None) => {
                format!("the model plans {}, the program has nothing left to do\n", model.tried)
            }
            (None, Some(program)) => {
                format!("the model has nothing left to do, the program plans {}\n", program.tried)
            }
            (None, None) => String::new(),
        }
    }
}

/// The open sides of `cell`.
fn sides(layout: &Layout, cell: Cell) -> String {
    let open = Side::ALL.into_iter().filter(|&side| layout.is_open(Edge::new(cell, side)));
    open.map(|side| trace::letter(Step::Cross(side))).collect()
}

/// The places of the cells around `cell` from which the next one, clockwise, is open: 0 is the northern.
fn rims(layout: &Layout, cell: Cell) -> String {
    use Side::{East, North, South, West};
    let mut at = cell.beyond(North);
    let mut open = String::new();
    for (place, side) in ('0'..).zip([East, South, South, West, West, North, North, East]) {
        if layout.is_open(Edge::new(at, side)) {
            open.push(place);
        }
        at = at.beyond(side);
    }
    open
}
