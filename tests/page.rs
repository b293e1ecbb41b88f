//! Pages in a real browser: no error on the console, and at any move the page says what the trace says. The browser is
//! the one that `TAUTLINE_BROWSER` names, or `chromium`; without one the test says that it is skipped. It is driven
//! over a pair of pipes, as the [protocol](https://chromedevtools.github.io/devtools-protocol/) of its tools has it.
#![cfg(unix)]

use std::fs::{self, File};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Instant;

use serde_json::{Value, json};

use crate::cli::says;
use crate::folder::{folder, read};

/// A browser with one page open.
struct Browser {
    child: Child,
    asks: File,
    answers: BufReader<File>,
    session: Option<String>,
    asked: u64,
    /// The messages that it has sent without being asked.
    events: Vec<Value>,
}

impl Browser {
    /// The browser, with its files in `folder`; none if there is none.
    fn open(folder: &Path) -> Option<Self> {
        let named = std::env::var("TAUTLINE_BROWSER").ok();
        let program = named.clone().unwrap_or_else(|| "chromium".to_owned());
        let version = Command::new(&program).arg("--version").stderr(Stdio::null()).output();
        if !version.is_ok_and(|output| output.status.success()) {
            assert!(named.is_none(), "TAUTLINE_BROWSER names {program}, which does not run");
            return None;
        }
        let [asks, answers] = ["asks", "answers"].map(|name| folder.join(name));
        assert!(Command::new("mkfifo").args([&asks, &answers]).status().expect("mkfifo").success());
        let script = "exec \"$0\" --headless --no-sandbox --disable-gpu --remote-debugging-pipe \
                      --user-data-dir=profile --window-size=1280,900 3<asks 4>answers";
        let mut shell = Command::new("sh");
        let child = shell
            .current_dir(folder)
            .args(["-c", script, &program])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("a shell");
        let asks = File::options().write(true).open(asks).expect("a pipe");
        let answers = BufReader::new(File::open(answers).expect("a pipe"));
        let mut browser = Self { child, asks, answers, session: None, asked: 0, events: Vec::new() };
        let target = browser.ask("Target.createTarget", &json!({ "url": "about:blank" }));
        let attached = json!({ "targetId": target["targetId"], "flatten": true });
        let session = browser.ask("Target.attachToTarget", &attached);
        browser.session = session["sessionId"].as_str().map(str::to_owned);
        for part in ["Page", "Runtime", "Log"] {
            browser.ask(&format!("{part}.enable"), &json!({}));
        }
        Some(browser)
    }

    fn next(&mut self) -> Value {
        let mut message = Vec::new();
        self.answers.read_until(0, &mut message).expect("a message");
        message.pop();
        serde_json::from_slice(&message).expect("the browser is there, and tells JSON")
    }

    fn ask(&mut self, method: &str, parameters: &Value) -> Value {
        self.asked += 1;
        let mut question = json!({ "id": self.asked, "method": method, "params": parameters });
        if let Some(session) = &self.session {
            question["sessionId"] = json!(session);
        }
        self.asks.write_all(format!("{question}\0").as_bytes()).expect("the browser listens");
        loop {
            let message = self.next();
            if message["id"] == self.asked {
                assert!(message["error"].is_null(), "{method}: {message}");
                return message["result"].clone();
            }
            self.events.push(message);
        }
    }

    /// Loads the page in this file, at a move.
    fn load(&mut self, page: &Path, hash: &str) {
        self.ask("Page.navigate", &json!({ "url": format!("file://{}{hash}", page.display()) }));
        while !self.events.iter().any(|event| event["method"] == "Page.loadEventFired") {
            let message = self.next();
            self.events.push(message);
        }
        self.events.retain(|event| event["method"] != "Page.loadEventFired");
    }

    /// The value of an expression of JavaScript; a promise is waited for.
    fn value(&mut self, expression: &str) -> Value {
        let asked = json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let answer = self.ask("Runtime.evaluate", &asked);
        assert!(answer["exceptionDetails"].is_null(), "{expression}: {answer}");
        answer["result"]["value"].clone()
    }

    fn text(&mut self, expression: &str) -> String {
        self.value(expression).as_str().expect("text").to_owned()
    }

    /// Goes to a step by the address, once the page has heard of it.
    fn go_to(&mut self, step: usize) {
        self.value(&format!(
            "location.hash === '#{step}' || new Promise(done => {{ \
             addEventListener('hashchange', done, {{ once: true }}); location.hash = '#{step}'; }})"
        ));
    }

    /// The errors of the pages.
    fn errors(&self) -> Vec<&Value> {
        let is_error = |event: &&Value| {
            let method = event["method"].as_str().unwrap_or_default();
            matches!(method, "Runtime.exceptionThrown" | "Runtime.consoleAPICalled" | "Log.entryAdded")
        };
        self.events.iter().filter(is_error).collect()
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

const SAID: &str = "document.getElementById('say').textContent";

/// The move in the address, a while after the last one.
const HASH: &str = "new Promise(done => setTimeout(() => done(location.hash), 300))";

/// Where the robots are, as the page's table says.
const WHERE: &str = "document.getElementById('who').open = true, \
                     [...document.getElementById('rows').children].map(row => row.children[1].textContent)";

/// The cells of robots in a line of a trace, as a page writes them.
fn cells(line: &str) -> Value {
    let made: Value = serde_json::from_str(line).expect("JSON");
    let cells = made["move"]["cells"].as_array().expect("cells");
    cells.iter().map(|cell| format!("{},{}", cell[0], cell[1])).collect()
}

/// Runs the program, which may find what it looks for or not.
fn run(folder: &Path, arguments: &[&str]) {
    let mut program = Command::new(env!("CARGO_BIN_EXE_tautline"));
    let output = program.current_dir(folder).args(arguments).output().expect("the program runs");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code().is_some_and(|code| code < 2), "{arguments:?}: {errors}");
}

/// Every layer off and on, zoom, follow, jumps: nothing goes wrong.
const USED: &str = "for (const box of document.querySelectorAll('#layers input')) { box.click(); box.click(); } \
                for (const key of ['+', '-', 'f', 'f', '0', '[', ']', 'ArrowLeft', 'Home']) \
                dispatchEvent(new KeyboardEvent('keydown', { key })); \
                new Promise(done => setTimeout(done, 50))";

/// The counterexample stops where it breaks the clause, and says how.
fn shows_how_a_clause_is_broken(browser: &mut Browser, folder: &Path) {
    let stored = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/chain-2-published-n4.jsonl");
    run(folder, &["replay", stored, "--html", "broken.html"]);
    browser.load(&folder.join("broken.html"), "#3");
    let played = "document.getElementById('speed').value = 60, document.getElementById('toggle').click(), new \
                  Promise(done => { const wait = setInterval(() => { if (document.getElementById('toggle').textContent \
                  === 'Play') { clearInterval(wait); done(); } }, 20); })";
    browser.value(played);
    assert!(browser.text(SAID).ends_with("breaks CHAIN-2"));
    assert_eq!(browser.value(HASH), "#7");
    let why = browser.text("document.getElementById('why').textContent");
    says(&why, &["There MUST never be three robots or more in one cell other than the base."]);
    says(&why, &["R_2, R_3, R_4 are in one cell, 1,1", "meets a wall and stays"]);
}

/// The page of a rescue says at each arrival where the robot is.
fn shows_a_rescue(browser: &mut Browser, folder: &Path) {
    run(
        folder,
        &["rescue", "--wfr", "2", "--robots", "2", "--seeds", "8", "--trace", "r.jsonl", "--html", "r.html"],
    );
    browser.load(&folder.join("r.html"), "");
    let trace = read(folder, "r.jsonl");
    let events: Vec<&str> = trace.lines().filter(|line| line.starts_with("{\"at_ns\"")).collect();
    let mut arrivals = 0;
    for (step, line) in (1..).zip(events) {
        let event: Value = serde_json::from_str(line).expect("JSON");
        let Some(arrives) = event.get("arrives") else { continue };
        browser.go_to(step);
        let said = browser.text(SAID);
        says(&said, &[&format!("robot {} reaches WFR {}", arrives["robot"], arrives["wfr"])]);
        let robot = arrives["robot"].as_u64().expect("a number") as usize - 1;
        let place = browser.value(WHERE)[robot].as_str().expect("a place").to_owned();
        let told: Vec<f64> =
            place.trim_end_matches(" m").split(", ").map(|part| part.parse().expect("metres")).collect();
        for (told, at) in told.iter().zip(arrives["at"].as_array().expect("a place")) {
            assert!((told - at.as_f64().expect("millimetres") / 1000.0).abs() < 0.1, "{place}: {line}");
        }
        arrivals += 1;
    }
    assert_eq!(arrivals, 2);
}

/// Loads a page on which a robot dies: the list of events tells it, and jumps there.
fn shows_a_death(browser: &mut Browser, folder: &Path) {
    let faults = ["--rule", "reel", "--fail", "4@10", "--loss", "0.2", "--speeds"];
    let run_of_five = ["explore", "walls:9x9:0.1", "--robots", "5", "--html", "death.html"];
    run(folder, &[&run_of_five[..], &faults].concat());
    browser.load(&folder.join("death.html"), "#1");
    browser.value(
        "Array.from(document.querySelectorAll('#events button')).find(button => \
         button.textContent.endsWith('R4 dies')).click()",
    );
    assert!(browser.text(SAID).starts_with("Team move 10 of "), "{}", browser.text(SAID));
}

#[test]
fn a_browser_shows_every_kind_of_page_as_the_trace_has_it() {
    let folder = &folder();
    let folder = &folder.canonicalize().expect("a folder");
    let Some(mut browser) = Browser::open(folder) else {
        println!("skipped: there is no chromium; TAUTLINE_BROWSER can name a browser like it");
        return;
    };
    let schemes: [(&str, &[&str]); 9] = [
        ("chain", &["walls:9x9:0.1", "--robots", "5"]),
        ("full-search", &["walls:7x7:0.1", "--robots", "3"]),
        ("ants", &["cells:9x9:0.1", "--robots", "6"]),
        ("bricks", &["cells:9x9:0.1", "--robots", "3", "--rule", "tree"]),
        ("bricks-ants", &["cells:9x9:0.1", "--robots", "3", "--miss", "0.1"]),
        ("kit", &["walls:7x7:0.1", "--robots", "3"]),
        (
            "frontier",
            &["cells:9x9:0.1", "--robots", "3", "--range", "4", "--noise-db", "1", "--objects", "4"],
        ),
        ("frontier", &["cells:9x9:0.1", "--robots", "3", "--rule", "hungarian"]),
        ("helpers", &["cells:9x9:0.1", "--robots", "3", "--miss", "0.1"]),
    ];
    for (number, (scheme, arguments)) in schemes.into_iter().enumerate() {
        // Each has a file of its own: to another move of the same page a browser goes without loading it anew.
        let page = format!("{number}.html");
        let files = ["--trace", "run.jsonl", "--html", &page, "--force"];
        run(folder, &[&["explore", "--scheme", scheme][..], arguments, &files].concat());
        let trace = read(folder, "run.jsonl");
        let moves: Vec<&str> = trace.lines().filter(|line| line.starts_with("{\"move\"")).collect();
        let last = moves.len();
        browser.load(&folder.join(&page), &format!("#{last}"));
        browser.value("dispatchEvent(new KeyboardEvent('keydown', { key: 'Home' }))");
        let start = match scheme {
            "chain" => "The start: the base, with 4 robots in its cell",
            "full-search" => "The start: the base, with 2 robots in its cell",
            "ants" => "The start: 6 agents",
            "kit" | "frontier" => "The start: 3 robots",
            _ => "The start: 3 agents",
        };
        assert!(browser.text(SAID).starts_with(start), "{scheme}");
        assert_eq!(browser.value(HASH), "#0", "{scheme}");
        // From the end backwards, forwards again over a step, and to the end by a key.
        for step in [last, last / 2, 1, 2] {
            browser.go_to(step);
            let said = browser.text(SAID);
            assert!(said.starts_with(&format!("Team move {step} of {last}")), "{scheme}: {said}");
            assert_eq!(browser.value(WHERE), cells(moves[step - 1]), "{scheme}, team move {step}");
        }
        browser.value("dispatchEvent(new KeyboardEvent('keydown', { key: 'End' }))");
        assert_eq!(browser.value(WHERE), cells(moves[last - 1]), "{scheme}");
        assert_eq!(browser.value(HASH), format!("#{last}"), "{scheme}");
        let end: Value = serde_json::from_str(trace.lines().last().expect("an end")).expect("JSON");
        let share = browser.text("document.getElementById('curve').getAttribute('aria-label')");
        let due = format!("Cells explored: {} of {}", end["end"]["explored"], end["end"]["cells"]);
        assert_eq!(share, due, "{scheme}");
        browser.value(USED);
    }
    shows_how_a_clause_is_broken(&mut browser, folder);
    browser.value(USED);
    shows_a_death(&mut browser, folder);
    shows_a_rescue(&mut browser, folder);
    browser.value(
        "document.getElementById('axis').value = 'time', \
                   document.getElementById('axis').onchange(), document.getElementById('at').value = 1000, \
                   document.getElementById('at').oninput({ target: document.getElementById('at') })",
    );
    browser.value(USED);
    assert!(browser.errors().is_empty(), "{:#?}", browser.errors());
}

/// Loads the page of 10,000 team moves on 512×512 cells and steps through parts of it; a step counts until its picture
/// is there.
#[test]
#[ignore = "takes ten seconds: cargo test --release --test all page -- --ignored --nocapture \
            (790 kB, 0.5 s, a step 1 ms, 41 ms at most)"]
fn a_page_of_ten_thousand_team_moves_is_small_and_quick() {
    let folder = &folder();
    let folder = &folder.canonicalize().expect("a folder");
    let Some(mut browser) = Browser::open(folder) else {
        println!("skipped: there is no chromium; TAUTLINE_BROWSER can name a browser like it");
        return;
    };
    let layout = ["explore", "cells:512x512:0.1", "--scheme", "bricks", "--rule", "tree", "--robots", "20"];
    run(folder, &[&layout[..], &["--max-moves", "10000", "--html", "run.html"]].concat());
    let bytes = fs::metadata(folder.join("run.html")).expect("a page").len();
    let begun = Instant::now();
    browser.load(&folder.join("run.html"), "");
    assert!(browser.text(SAID).starts_with("The start"));
    let loaded = begun.elapsed();
    let steps = "(() => { const times = []; \
                 for (const from of [0, 4000, 9000]) { go(from); draw(); \
                 for (let step = 0; step < 100; step++) { const begun = performance.now(); go(shown + 1); draw(); \
                 pen.getImageData(0, 0, 1, 1); times.push(performance.now() - begun); } } \
                 times.sort((one, other) => one - other); return [times[150], times[299]]; })()";
    let times = browser.value(steps);
    println!("{bytes} bytes, loaded in {loaded:?}, a step in {} ms, {} ms at most", times[0], times[1]);
    assert!(bytes <= 10_000_000 && loaded.as_secs() < 5);
    assert!(times[1].as_f64().expect("milliseconds") < 50.0, "{times}");
}
