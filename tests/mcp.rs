//! The server of the Model Context Protocol, as a client speaks with it over pipes.
#![cfg(all(unix, feature = "mcp"))]

use std::fs;
use std::io::{BufRead, BufReader, Lines, Write};
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::cli::says;
use crate::folder::{Folder, folder, write};

/// A client, and the server that it has started.
struct Client {
    child: Child,
    input: ChildStdin,
    output: Lines<BufReader<ChildStdout>>,
    sent: u32,
}

impl Client {
    fn new(folder: &Path) -> Self {
        Self::with(folder, &[])
    }

    /// The client of a server that has these variables in its environment.
    fn with(folder: &Path, environment: &[(&str, &str)]) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_tautline"));
        command.args(["mcp", "--folder", "runs"]).current_dir(folder).envs(environment.iter().copied());
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = command.spawn().expect("the program runs");
        let input = child.stdin.take().expect("a pipe");
        let output = BufReader::new(child.stdout.take().expect("a pipe")).lines();
        let mut client = Self { child, input, output, sent: 0 };
        let client_info = json!({"name": "a test", "version": "1"});
        let who = json!({"protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": client_info});
        assert_eq!(client.asks("initialize", &who)["result"]["serverInfo"]["name"], "tautline");
        client.tells(&json!({"jsonrpc": "2.0", "method": "notifications/initialized"}));
        client
    }

    fn tells(&mut self, message: &Value) {
        writeln!(self.input, "{message}").expect("a server that reads");
    }

    fn begins(&mut self, method: &str, params: &Value) -> u32 {
        self.sent += 1;
        self.tells(&json!({"jsonrpc": "2.0", "id": self.sent, "method": method, "params": params}));
        self.sent
    }

    fn asks(&mut self, method: &str, params: &Value) -> Value {
        let id = self.begins(method, params);
        let line = self.output.next().expect("an answer").expect("text");
        let answer: Value = serde_json::from_str(&line).expect("JSON");
        assert_eq!(answer["id"], id, "{answer}");
        answer
    }

    fn calls(&mut self, tool: &str, arguments: &Value) -> Value {
        self.asks("tools/call", &json!({"name": tool, "arguments": arguments}))
    }

    /// The object that a tool answers with.
    fn told(&mut self, tool: &str, arguments: &Value) -> Value {
        let mut answer = self.calls(tool, arguments);
        assert_eq!(answer["result"]["isError"], false, "{answer}");
        answer["result"]["structuredContent"].take()
    }

    /// Why a call is refused, or has failed.
    fn refused(&mut self, tool: &str, arguments: &Value) -> String {
        let answer = self.calls(tool, arguments);
        let said = answer["error"]["message"].as_str().or(answer["result"]["content"][0]["text"].as_str());
        assert!(answer["error"].is_object() || answer["result"]["isError"] == true, "{answer}");
        said.expect("words").to_owned()
    }
}

/// A folder with a folder for the server, and a run beside it.
fn with_runs() -> Folder {
    let folder = folder();
    fs::create_dir(folder.join("runs")).expect("a folder");
    let run = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/chain-1-published-n4.jsonl");
    fs::copy(run, folder.join("outside.jsonl")).expect("a file");
    folder
}

#[test]
fn each_tool_answers_as_its_command_does() {
    let folder = &with_runs();
    let mut client = Client::new(folder);
    let listed = client.asks("tools/list", &json!({}));
    let tools = listed["result"]["tools"].as_array().expect("a list");
    let names: Vec<&str> = tools.iter().filter_map(|tool| tool["name"].as_str()).collect();
    assert_eq!(names, ["prove", "hunt", "explore", "minimise", "replay"]);
    assert!(tools.iter().all(|tool| tool["inputSchema"]["properties"]["seconds"].is_object()), "{listed}");
    let explored = json!({"layout": "open:5x5", "robots": 3, "trace": "run.jsonl"});
    let hunted = json!({"rule": "published", "robots": 3, "max_walls": 2});
    for (tool, arguments, schema) in [
        ("explore", explored, "explore"),
        ("replay", json!({"file": "run.jsonl", "moves": "1..2"}), "replay"),
        ("hunt", hunted, "hunt"),
        ("minimise", json!({"file": "found/chain-13-published-n3.jsonl"}), "minimise"),
        ("prove", json!({"clauses": ["NOTICE-4"]}), "prove"),
    ] {
        let told = client.told(tool, &arguments);
        crate::schema::check(schema, &told, tool);
    }
    assert!(folder.join("runs/minimal/chain-13-published-n3.jsonl").is_file());
    drop(client.input);
    assert!(client.child.wait().expect("it ends").success());
}

#[test]
fn a_line_that_is_no_json_is_passed_over_and_one_that_is_no_message_refused() {
    let folder = &with_runs();
    let mut client = Client::new(folder);
    writeln!(client.input, "no JSON").expect("a server that reads");
    client.tells(&json!({"neither": "a call"}));
    let line = client.output.next().expect("an answer").expect("text");
    let answer: Value = serde_json::from_str(&line).expect("JSON");
    assert_eq!(answer["error"]["code"], -32600, "{answer}");
    assert!(client.asks("ping", &json!({}))["result"].is_object());
}

#[test]
fn a_call_that_could_not_store_its_file_has_failed() {
    let folder = &with_runs();
    let foreign = folder.join("runs/found/chain-13-published-n3.jsonl");
    fs::create_dir(folder.join("runs/found")).expect("a folder");
    fs::write(&foreign, "mine").expect("a file");
    let mut client = Client::new(folder);
    let said = client.refused("hunt", &json!({"rule": "published", "robots": 3, "max_walls": 2}));
    assert!(said.contains("tautline did not write this file"), "{said}");
    assert!(said.ends_with("Help: store it elsewhere"), "{said}");
    assert_eq!(fs::read_to_string(foreign).expect("a file"), "mine");
}

#[test]
fn no_call_leaves_the_folder() {
    let folder = &with_runs();
    let outside = folder.join("outside.jsonl");
    symlink(&outside, folder.join("runs/link.jsonl")).expect("a link");
    symlink(folder, folder.join("runs/up")).expect("a link");
    write(folder, "runs/map.yaml", "image: ../map.png");
    let mut client = Client::new(folder);
    let outside = outside.to_str().expect("text");
    for file in [
        "../outside.jsonl",
        outside,
        "link.jsonl",
        "up/outside.jsonl",
        "./../outside.jsonl",
        "a/./b",
        "--help",
        "",
    ] {
        let said = client.refused("replay", &json!({"file": file}));
        assert!(said.contains("within the folder") || said.contains("no such word"), "{file}: {said}");
    }
    for out in ["..", "up", "a/../..", "/tmp", ".", "a/./b", ""] {
        let said =
            client.refused("hunt", &json!({"rule": "published", "robots": 3, "max_walls": 2, "out": out}));
        assert!(said.contains("within the folder"), "{out}: {said}");
    }
    for (key, path) in [("trace", "../new.jsonl"), ("trace", "link.jsonl"), ("layout", "map.yaml")] {
        let mut arguments = json!({"layout": "open:5x5"});
        arguments[key] = path.into();
        let said = client.refused("explore", &arguments);
        assert!(said.contains("within the folder"), "{path}: {said}");
    }
    assert_eq!(fs::read_dir(folder).expect("a folder").count(), 2, "something was written beside");
    // What is within is read.
    fs::copy(outside, folder.join("runs/inside.jsonl")).expect("a file");
    assert_eq!(client.told("replay", &json!({"file": "inside.jsonl"}))["counterexample_to"], "CHAIN-1");
}

#[test]
fn a_call_is_bounded_and_can_be_cancelled_and_wrong_arguments_are_named() {
    let folder = &with_runs();
    let mut client = Client::new(folder);
    let long = |seconds: u32| json!({"robots": 6, "max_walls": 7, "seconds": seconds});
    let start = Instant::now();
    assert!(client.refused("hunt", &long(1)).contains("took more than 1 second and"));
    assert!(start.elapsed() < Duration::from_secs(30), "{:?}", start.elapsed());
    for (tool, arguments, word) in [
        ("explore", json!({}), "layout"),
        ("explore", json!({"layout": "open:5x5", "robots": "many"}), "many"),
        ("explore", json!({"layout": "open:5x5", "colour": 1}), "colour"),
        ("explore", json!({"layout": "open:5x5", "seconds": 601}), "1 to 600 seconds"),
        ("explore", json!({"layout": "open:5x5", "memory_mib": 1}), "256 to 16384 MiB"),
        #[cfg(target_os = "linux")]
        (
            "explore",
            json!({"layout": "open:4000x4000", "scheme": "ants", "memory_mib": 256}),
            "256 MiB are too few",
        ),
        ("hunt", json!({"robots": 3, "max_walls": 99}), "give max_walls a number up to"),
        (
            "hunt",
            json!({"size": "5x"}),
            "for 'size <WxH>': write columns and rows as WIDTHxHEIGHT, for example 7x7",
        ),
        ("explore", json!({"layout": "open:5x5", "seed": 3}), "seed has no effect"),
        ("prove", json!({"clauses": []}), "name a clause"),
        ("prove", json!({"clauses": ["CHAIN-99"]}), "there is no clause"),
        ("replay", json!({"file": "no-such.jsonl"}), "no-such.jsonl: there is no such file"),
        ("explore", json!({"layout": "open:5x5", "colour": 1}), ", max_moves, "),
        ("dance", json!({}), "\"dance\": the tools are prove, hunt, explore, minimise, replay"),
    ] {
        let said = client.refused(tool, &arguments);
        assert!(said.contains(word), "{tool} {arguments}: {said}");
        // A command of a terminal is one between backticks.
        let beside: String = said.split('`').step_by(2).collect();
        assert!(!beside.contains("--") && !said.contains("drawn"), "{tool} {arguments}: {said}");
    }
    // What the caller wrote stands as it was written.
    for file in ["no--such-file.jsonl", "a--trace.jsonl"] {
        let said = client.refused("replay", &json!({"file": file}));
        says(&said, &[&format!("{file}: there is no such file"), "`tautline explore --trace`"]);
    }
    let id = client.begins("tools/call", &json!({"name": "hunt", "arguments": long(600)}));
    client
        .tells(&json!({"jsonrpc": "2.0", "method": "notifications/cancelled", "params": {"requestId": id}}));
    let start = Instant::now();
    assert_eq!(client.told("explore", &json!({"layout": "open:5x5", "robots": 3}))["explored"], 25);
    drop(client.input);
    assert!(client.child.wait().expect("it ends").success());
    assert!(start.elapsed() < Duration::from_secs(5), "the hunt went on: {:?}", start.elapsed());
}

#[cfg(target_os = "linux")]
#[test]
fn a_search_stops_at_half_of_little_memory() {
    let folder = &with_runs();
    // So many arenas of glibc, one for each thread, would take all of it.
    let mut client = Client::with(folder, &[("RAYON_NUM_THREADS", "8")]);
    let told = client.told("prove", &json!({"clauses": ["KIT-5"], "memory_mib": 256}));
    assert_eq!(told["clauses"][0]["id"], "KIT-5");
}

/// The processes whose parent is `parent`.
#[cfg(target_os = "linux")]
fn children(parent: u32) -> Vec<String> {
    let all = fs::read_dir("/proc").expect("processes").filter_map(Result::ok);
    let names = all.filter_map(|entry| entry.file_name().into_string().ok());
    let is_child = |id: &String| {
        let status = fs::read_to_string(format!("/proc/{id}/status")).unwrap_or_default();
        status.lines().any(|line| line == format!("PPid:\t{parent}"))
    };
    names.filter(|name| name.bytes().all(|byte| byte.is_ascii_digit())).filter(is_child).collect()
}

/// Whether it comes true in so many seconds.
#[cfg(target_os = "linux")]
fn comes_true(seconds: u64, is_so: impl Fn() -> bool) -> bool {
    let start = Instant::now();
    while !is_so() && start.elapsed() < Duration::from_secs(seconds) {
        std::thread::sleep(Duration::from_millis(20));
    }
    is_so()
}

/// As clients end a server: its input ends, then it gets a signal.
#[cfg(target_os = "linux")]
#[test]
fn no_call_outlives_the_server() {
    for (signal, code, seconds) in
        [("TERM", Some(3), 600), ("INT", Some(3), 600), ("HUP", Some(3), 600), ("KILL", None, 1)]
    {
        let folder = &with_runs();
        let Client { mut child, mut input, .. } = Client::new(folder);
        let hunt = json!({"robots": 6, "max_walls": 7, "seconds": seconds});
        let call = json!({"name": "hunt", "arguments": hunt});
        writeln!(input, "{}", json!({"jsonrpc": "2.0", "id": 2, "method": "tools/call", "params": call}))
            .expect("a server that reads");
        assert!(comes_true(20, || !children(child.id()).is_empty()), "{signal}: no call");
        let calls = children(child.id());
        drop(input);
        let start = Instant::now();
        let kill = format!("kill -{signal} {}", child.id());
        assert!(Command::new("sh").args(["-c", &kill]).status().expect("a shell").success());
        assert_eq!(child.wait().expect("it ends").code(), code, "{signal}");
        assert!(start.elapsed() < Duration::from_secs(4), "{signal}: {:?}", start.elapsed());
        let is_over = || {
            calls.iter().all(|id| {
                let status = fs::read_to_string(format!("/proc/{id}/status")).unwrap_or_default();
                status.is_empty() || status.contains("State:\tZ")
            })
        };
        let patience = if code.is_some() { 5 } else { 60 };
        assert!(comes_true(patience, is_over), "{signal}: a call goes on");
    }
}
