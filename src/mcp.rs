//! `tautline mcp`: a server of the Model Context Protocol over stdin and stdout. Each tool is a command of this
//! program, run as a process of its own that is bounded in time, memory and output, in one folder.

use std::ffi::OsString;
use std::fs;
use std::path::{Component, Path, PathBuf};
use std::process::Stdio;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use clap::Args;
use rmcp::model::{
    CallToolRequestParams, CallToolResponse, CallToolResult, ContentBlock, Implementation, ListToolsResult,
    PaginatedRequestParams, ServerCapabilities, ServerConfig, Tool,
};
use rmcp::service::RequestContext;
use rmcp::transport::stdio_pipes;
use rmcp::{ErrorData, RoleServer, ServerHandler, ServiceExt};
use schemars::{JsonSchema, schema_for};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use tokio::io::{AsyncRead, AsyncReadExt};
use tokio::process::Command;
use tokio::time::{sleep, timeout};

use super::exit::Exit;
use super::interrupt;
use super::output::Output;
use tautline_grids::layout::is_ros;
use tautline_io::diagnostic::{Diagnostic, Halt};
use tautline_proofs::plural::counted;

const EXAMPLES: &str = "\
Examples:
  tautline mcp --folder runs";

/// The most seconds of a call, and those of one that does not say.
const MOST_SECONDS: u32 = 600;
const SECONDS: u32 = 60;

/// The least and the most mebibytes of a call, and those of one that does not say.
const LEAST_MEMORY: u32 = 256;
const MOST_MEMORY: u32 = 16 * 1024;
const MEMORY: u32 = 2048;

/// Bytes of an answer.
const MAX_ANSWER: u64 = 4 << 20;

/// The server looks so often whether a signal has asked for its end.
const PULSE: Duration = Duration::from_millis(50);

/// Serve prove, hunt, explore, minimise and replay to an assistant, by the Model Context Protocol on stdin and stdout.
///
/// Calls read and write files of one folder, and none elsewhere. docs/mcp.md says how an editor is told of it.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Mcp {
    /// The folder of the files that are read and written.
    #[arg(long, value_name = "DIR")]
    folder: PathBuf,
}

/// The bounds of a call, which every tool takes beside its own arguments.
#[derive(Clone, Copy, Deserialize, JsonSchema)]
struct Bounds {
    /// Seconds that the call may take: 60 unless this says otherwise.
    #[schemars(range(min = 1, max = MOST_SECONDS))]
    seconds: Option<u32>,
    /// Mebibytes that it may take: 2048 unless this says otherwise.
    #[schemars(range(min = LEAST_MEMORY, max = MOST_MEMORY))]
    memory_mib: Option<u32>,
}

/// Decide clauses of SPEC.md within their bounds.
#[derive(Deserialize, JsonSchema)]
struct Prove {
    /// Ids of clauses, such as CHAIN-1; at least one.
    #[schemars(length(min = 1))]
    clauses: Vec<String>,
    /// A folder for the counterexamples.
    out: Option<String>,
}

/// Search all layouts within a bound for runs that break a clause, and store the smallest of each.
#[derive(Deserialize, JsonSchema)]
struct Hunt {
    /// A scheme, such as chain, kit or frontier.
    scheme: Option<String>,
    /// A rule of the scheme, such as published or repaired.
    rule: Option<String>,
    /// Robots of the team, the base counted.
    robots: Option<u16>,
    /// The most walls of a layout.
    max_walls: Option<u32>,
    /// Search all areas of at most so many cells, with any number of walls up to `max_walls`.
    max_cells: Option<u32>,
    /// Columns and rows, such as 5x1.
    size: Option<String>,
    /// Team moves after which it ends.
    budget: Option<u64>,
    /// A folder for the counterexamples.
    out: Option<String>,
}

/// Explore a layout once, and check every team move.
#[derive(Deserialize, JsonSchema)]
struct Explore {
    /// A file, or a generator such as open:15x15 or walls:15x15:0.1.
    layout: String,
    /// A scheme, such as chain, kit or frontier.
    scheme: Option<String>,
    /// A rule of the scheme, such as published or repaired.
    rule: Option<String>,
    /// Robots of the team, the base counted.
    robots: Option<u16>,
    /// The seed of whatever is left to chance.
    seed: Option<u64>,
    /// The cells that a robot may enter.
    max_moves: Option<u32>,
    /// A file in which the run is stored.
    trace: Option<String>,
}

/// Shrink a stored run that breaks a clause until nothing of it can go, and store what is left.
#[derive(Deserialize, JsonSchema)]
struct Minimise {
    /// A stored run.
    file: String,
    /// The clause that is to stay broken.
    clause: Option<String>,
    /// A folder for the minimal run.
    out: Option<String>,
}

/// Play a stored run, counterexample or rescue, and check that it is what its rule makes.
#[derive(Deserialize, JsonSchema)]
struct Replay {
    /// A stored run.
    file: String,
    /// The first and the last team move to tell, such as 10..20.
    moves: Option<String>,
}

/// The arguments of a command, in the making.
struct Line<'a> {
    folder: &'a Path,
    words: Vec<OsString>,
    bounds: Bounds,
}

/// A tool: a command that is called with an object of arguments.
trait ToolCommand: DeserializeOwned + JsonSchema {
    const NAME: &'static str;

    /// Puts the arguments into the command's line.
    ///
    /// # Errors
    /// The words for an argument that is refused.
    fn line(self, line: &mut Line<'_>) -> Result<(), String>;
}

impl Line<'_> {
    /// Adds a word that is no option.
    fn word(&mut self, word: &str) -> Result<(), String> {
        if word.is_empty() || word.starts_with('-') || word.len() > 200 || word.contains(char::is_control) {
            return Err(format!("{word:?} is no such word"));
        }
        self.words.push(word.into());
        Ok(())
    }

    /// Adds an option, if it has a value.
    fn option(&mut self, name: &str, value: Option<impl ToString>) {
        if let Some(value) = value {
            self.words.push(format!("--{name}={}", value.to_string()).into());
        }
    }

    /// Adds a file within the folder.
    fn file(&mut self, path: &str) -> Result<(), String> {
        self.check(path)?;
        self.word(path)
    }

    /// Adds an option that names a file or a folder within the folder, if it has a value.
    fn place(&mut self, name: &str, path: Option<&str>) -> Result<(), String> {
        path.map_or(Ok(()), |path| self.check(path))?;
        self.option(name, path);
        Ok(())
    }

    /// Refuses a path that leaves the folder.
    fn check(&self, path: &str) -> Result<(), String> {
        let refused = |why| Err(format!("{path:?} {why}: name a file within the folder"));
        if path.is_empty() || path.split('/').any(|part| part == ".") {
            return refused("is empty or has a part `.`");
        }
        let mut at = self.folder.to_owned();
        for part in Path::new(path).components() {
            let Component::Normal(name) = part else { return refused("leaves the folder") };
            at.push(name);
            if at.is_symlink() {
                return refused("goes through a symbolic link");
            }
        }
        if is_ros(&at) {
            return refused("names an image, which may be elsewhere");
        }
        let links = |folder: &Path| {
            fs::read_dir(folder)
                .is_ok_and(|mut all| all.any(|one| one.is_ok_and(|one| one.path().is_symlink())))
        };
        if links(&at) { refused("has a symbolic link inside") } else { Ok(()) }
    }
}

impl ToolCommand for Prove {
    const NAME: &'static str = "prove";

    fn line(self, line: &mut Line<'_>) -> Result<(), String> {
        if self.clauses.is_empty() {
            return Err("name a clause: all of them take minutes".to_owned());
        }
        self.clauses.iter().try_for_each(|clause| line.word(clause))?;
        // Searches stop before the system stops them.
        line.option("memory", Some(format!("{}MiB", (line.bounds.memory_mib.unwrap_or(MEMORY) / 2).max(1))));
        line.place("out", self.out.as_deref())
    }
}

impl ToolCommand for Hunt {
    const NAME: &'static str = "hunt";

    fn line(self, line: &mut Line<'_>) -> Result<(), String> {
        line.option("scheme", self.scheme);
        line.option("rule", self.rule);
        line.option("robots", self.robots);
        line.option("max-walls", self.max_walls);
        line.option("max-cells", self.max_cells);
        line.option("size", self.size);
        line.option("budget", self.budget);
        line.place("out", Some(self.out.as_deref().unwrap_or("found")))
    }
}

impl ToolCommand for Explore {
    const NAME: &'static str = "explore";

    fn line(self, line: &mut Line<'_>) -> Result<(), String> {
        line.file(&self.layout)?;
        line.option("scheme", self.scheme);
        line.option("rule", self.rule);
        line.option("robots", self.robots);
        line.option("seed", self.seed);
        line.option("max-moves", self.max_moves);
        line.place("trace", self.trace.as_deref())
    }
}

impl ToolCommand for Minimise {
    const NAME: &'static str = "minimise";

    fn line(self, line: &mut Line<'_>) -> Result<(), String> {
        line.file(&self.file)?;
        line.option("clause", self.clause);
        line.place("out", Some(self.out.as_deref().unwrap_or("minimal")))
    }
}

impl ToolCommand for Replay {
    const NAME: &'static str = "replay";

    fn line(self, line: &mut Line<'_>) -> Result<(), String> {
        line.file(&self.file)?;
        line.option("moves", self.moves);
        Ok(())
    }
}

/// A tool of the list, and what makes its command's line of arguments.
struct Entry {
    tool: Tool,
    line: fn(Value, &mut Line<'_>) -> Result<(), String>,
}

impl Entry {
    fn of<T: ToolCommand>() -> Self {
        let [mut schema, bounds] = [schema_for!(T), schema_for!(Bounds)]
            .map(|schema| schema.as_object().cloned().unwrap_or_default());
        let about = schema.remove("description").and_then(|text| text.as_str().map(str::to_owned));
        let bounds = bounds.get("properties").and_then(Value::as_object).cloned();
        if let Some(own) = schema.get_mut("properties").and_then(Value::as_object_mut) {
            own.extend(bounds.unwrap_or_default());
        }
        schema.insert("additionalProperties".to_owned(), false.into());
        let line = |arguments: Value, line: &mut Line<'_>| read::<T>(arguments)?.line(line);
        Self { tool: Tool::new(T::NAME, about.unwrap_or_default(), Arc::new(schema)), line }
    }

    /// The names of its arguments.
    fn arguments(&self) -> impl Iterator<Item = &str> {
        let known = self.tool.input_schema.get("properties").and_then(Value::as_object);
        known.into_iter().flat_map(Map::keys).map(String::as_str)
    }

    /// Whether it has an argument of this name.
    fn takes(&self, name: &str) -> bool {
        self.arguments().any(|known| known == name)
    }

    /// The line of a call with these arguments in `folder`.
    ///
    /// # Errors
    /// The words for an argument that is unknown or refused.
    fn line<'a>(&self, arguments: Map<String, Value>, folder: &'a Path) -> Result<Line<'a>, String> {
        if let Some(unknown) = arguments.keys().find(|key| !self.takes(key)) {
            let known: Vec<&str> = self.arguments().collect();
            return Err(format!("there is no argument {unknown:?}: the arguments are {}", known.join(", ")));
        }
        let arguments = Value::from(arguments);
        let words = vec![self.tool.name.to_string().into()];
        let mut line = Line { folder, words, bounds: read(arguments.clone())? };
        (self.line)(arguments, &mut line)?;
        Ok(line)
    }
}

/// The arguments as a `T`, which leaves out those of others.
fn read<T: DeserializeOwned>(arguments: Value) -> Result<T, String> {
    serde_json::from_value(arguments).map_err(|error| error.to_string())
}

/// The tools.
fn entries() -> [Entry; 5] {
    [
        Entry::of::<Prove>(),
        Entry::of::<Hunt>(),
        Entry::of::<Explore>(),
        Entry::of::<Minimise>(),
        Entry::of::<Replay>(),
    ]
}

struct Server {
    folder: PathBuf,
    entries: [Entry; 5],
}

impl ServerHandler for Server {
    fn get_info(&self) -> ServerConfig {
        let capabilities = ServerCapabilities::builder().enable_tools().build();
        ServerConfig::new(capabilities)
            .with_server_info(Implementation::new("tautline", env!("CARGO_PKG_VERSION")))
            .with_instructions(
                "Decides what published rules for robot teams promise. Paths are within one folder.",
            )
    }

    async fn list_tools(
        &self,
        _: Option<PaginatedRequestParams>,
        _: RequestContext<RoleServer>,
    ) -> Result<ListToolsResult, ErrorData> {
        Ok(ListToolsResult::with_all_items(self.entries.iter().map(|entry| entry.tool.clone()).collect()))
    }

    async fn call_tool(
        &self,
        request: CallToolRequestParams,
        context: RequestContext<RoleServer>,
    ) -> Result<CallToolResponse, ErrorData> {
        let Some(entry) = self.entries.iter().find(|entry| entry.tool.name == request.name) else {
            let known: Vec<&str> = self.entries.iter().map(|entry| &*entry.tool.name).collect();
            let what = format!("there is no tool {:?}: the tools are {}", request.name, known.join(", "));
            return Err(ErrorData::invalid_params(what, None));
        };
        let line = entry.line(request.arguments.unwrap_or_default(), &self.folder);
        let line = line.map_err(|what| ErrorData::invalid_params(what, None))?;
        // What is dropped here is killed.
        let answer = tokio::select! {
            answer = answer(entry, &line) => answer,
            () = context.ct.cancelled() => Err("the call was cancelled".to_owned()),
        };
        Ok(match answer {
            Ok(value) => CallToolResult::structured(value),
            Err(what) => CallToolResult::error(vec![ContentBlock::text(what)]),
        }
        .into())
    }
}

/// The JSON that the command of a tool prints.
async fn answer(entry: &Entry, line: &Line<'_>) -> Result<Value, String> {
    let Bounds { seconds, memory_mib } = line.bounds;
    let (seconds, memory) = (seconds.unwrap_or(SECONDS), memory_mib.unwrap_or(MEMORY));
    if !(1..=MOST_SECONDS).contains(&seconds) || !(LEAST_MEMORY..=MOST_MEMORY).contains(&memory) {
        return Err(format!(
            "a call takes 1 to {MOST_SECONDS} seconds and {LEAST_MEMORY} to {MOST_MEMORY} MiB"
        ));
    }
    let program = std::env::current_exe().map_err(|error| format!("this program is not found: {error}"))?;
    let mut command = if cfg!(target_os = "linux") {
        let mut shell = Command::new("sh");
        // A server that is killed ends no call: then its processor time does, which no call uses up within its seconds.
        let cores = thread::available_parallelism().map_or(1, usize::from) as u64;
        let processor_seconds = u64::from(seconds) * (cores + 1);
        let limits =
            format!("ulimit -t {processor_seconds} 2> /dev/null; ulimit -v {}", u64::from(memory) * 1024);
        shell.arg("-c").arg(limits + " && exec \"$0\" \"$@\"").arg(program);
        // Each arena of glibc would take 64 MiB of the address space, used or not.
        shell.env("MALLOC_ARENA_MAX", "1");
        shell
    } else {
        Command::new(program)
    };
    command.args(&line.words).args(["--format", "json"]).current_dir(line.folder).kill_on_drop(true);
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().map_err(|error| format!("the command cannot be started: {error}"))?;
    let (stdout, stderr) = (child.stdout.take(), child.stderr.take());
    let ended = async { tokio::join!(bounded(stdout), bounded(stderr), child.wait()) };
    let late = |_| {
        format!(
            "the call took more than {} and was ended: ask for less, or give it more",
            counted(seconds, "second")
        )
    };
    let (told, said, status) = timeout(Duration::from_secs(seconds.into()), ended).await.map_err(late)?;
    if told.len() as u64 > MAX_ANSWER {
        return Err(format!("the answer has more than {MAX_ANSWER} bytes: ask for less"));
    }
    // A command without a code was ended, as happens where memory is out.
    let code = status.ok().and_then(|status| status.code()).ok_or_else(|| {
        format!("the call was ended, as where {memory} MiB are too few: ask for less, or give it more")
    })?;
    let reason = || with_arguments(&String::from_utf8_lossy(&said), |name| entry.takes(name));
    // One that could not store a file has printed its result, and says on stderr what would be right.
    if [Exit::Diagnostic, Exit::Bug].iter().any(|exit| i32::from(exit.code()) == code) {
        return Err(reason());
    }
    serde_json::from_slice(&told).map_err(|_| reason())
}

/// The words of a command with arguments instead of the options that the tool takes, as `is_taken` tells: `max_walls`
/// for `--max-walls`. An alternative is left out if it names another option; else that is left as it stands, as is what
/// is no option.
fn with_arguments(words: &str, is_taken: impl Fn(&str) -> bool) -> String {
    let mut told = String::new();
    for line in words.trim().lines().take_while(|line| !line.starts_with("For more information")) {
        let parts = line.replace("; ", "\0; ").replace(", or ", "\0, or ");
        for (number, part) in parts.split('\0').enumerate() {
            let mut pieces = part.split("--");
            let mut part = pieces.next().unwrap_or_default().to_owned();
            let mut is_open = true;
            for piece in pieces {
                let end = piece.find(|sign: char| !sign.is_ascii_lowercase() && sign != '-');
                let (name, rest) = piece.split_at(end.unwrap_or(piece.len()));
                let argument = name.replace('-', "_");
                let is_option = !part.ends_with(|sign: char| sign.is_alphanumeric() || "-_./".contains(sign));
                if is_option && is_taken(&argument) {
                    part += &(argument + rest);
                } else {
                    is_open &= !is_option;
                    part += &["--", name, rest].concat();
                }
            }
            if is_open || number == 0 {
                told += &part;
            }
        }
        told.push('\n');
    }
    told.trim_end().to_owned()
}

/// As much as an answer can have, and one byte more.
async fn bounded(output: Option<impl AsyncRead + Unpin>) -> Vec<u8> {
    let mut read = Vec::new();
    if let Some(output) = output {
        // What cannot be read is left out.
        let _ = output.take(MAX_ANSWER + 1).read_to_end(&mut read).await;
    }
    read
}

impl Mcp {
    pub(super) fn run(&self, out: &mut Output) -> Result<Exit, Halt> {
        let folder = self.folder.canonicalize().ok().filter(|folder| folder.is_dir());
        let folder = folder.ok_or_else(|| {
            Diagnostic::in_file(&self.folder, "this is no folder", "name one that is there")
        })?;
        // Stdout is the server's.
        out.leave();
        let unable = |error: &dyn std::fmt::Display| {
            let remedy = "start it from an editor that speaks the protocol";
            Diagnostic::usage(format_args!("the server cannot go on: {error}"), remedy)
        };
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
        let runtime = runtime.map_err(|error| unable(&error))?;
        let serve = async {
            let service = Server { folder, entries: entries() }
                .serve(stdio_pipes())
                .await
                .map_err(|error| unable(&error))?;
            service.waiting().await.map_err(|error| unable(&error))?;
            Ok(Exit::Expected)
        };
        // A signal that ended the process at once would leave its calls behind.
        interrupt::defer();
        let interrupted = async {
            while !interrupt::is_requested() {
                sleep(PULSE).await;
            }
        };
        let served = runtime.block_on(async {
            tokio::select! {
                served = serve => served,
                () = interrupted => Ok(Exit::Unfinished),
            }
        });
        // Calls that go on are dropped here, and killed thereby.
        runtime.shutdown_background();
        served
    }
}
