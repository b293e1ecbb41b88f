//! A program that answers line by line, within a time limit, and is ended when nobody needs it any more.

use std::ffi::OsString;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};
use tautline_io::diagnostic::Diagnostic;
use tautline_io::json_lines::{line_of, parse};
use tautline_proofs::plural::counted;

/// Longer lines are refused.
const MAX_LINE_BYTES: u64 = 1 << 20;

/// How long a program that has closed its output may take to end.
const GRACE: Duration = Duration::from_secs(1);

/// The remedy for a program that does not answer as it should.
const PROTOCOL: &str = "docs/conform.md shows each line that a program reads and writes";

/// A program that was started.
pub(super) struct Program {
    name: String,
    child: Child,
    /// The lines that it is still to be told. Without it its input is closed.
    told: Option<Sender<String>>,
    heard: Receiver<Vec<u8>>,
    /// Lines that were heard.
    count: usize,
    patience: Duration,
}

impl Program {
    /// Starts a program with its arguments; it may take so long for each answer.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it cannot be started.
    pub(super) fn start(words: &[OsString], patience: Duration) -> Result<Self, Diagnostic> {
        let (program, arguments) =
            words.split_first().map_or((OsString::new(), &[][..]), |(one, rest)| (one.clone(), rest));
        let name = program.to_string_lossy().into_owned();
        let mut command = Command::new(&program);
        command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped());
        let unable = |error| {
            let remedy = "name a program behind --, with its folder if it is not in the PATH: ./robots";
            Diagnostic::usage(format_args!("the program {name} cannot be started: {error}"), remedy)
        };
        let mut child = command.spawn().map_err(unable)?;
        let (tell, told) = mpsc::channel::<String>();
        // At most one line waits here, whatever the program writes.
        let (hear, heard) = mpsc::sync_channel(1);
        if let Some(mut input) = child.stdin.take() {
            // Who does not read is found by the time that the answer takes.
            thread::spawn(move || told.iter().try_for_each(|line| input.write_all(line.as_bytes())));
        }
        if let Some(output) = child.stdout.take() {
            thread::spawn(move || {
                let mut output = BufReader::new(output);
                loop {
                    let mut line = Vec::new();
                    let read = output.by_ref().take(MAX_LINE_BYTES + 1).read_until(b'\n', &mut line);
                    if read.is_err() || line.is_empty() || hear.send(line).is_err() {
                        return;
                    }
                }
            });
        }
        Ok(Self { name, child, told: Some(tell), heard, count: 0, patience })
    }

    /// Tells the program a line.
    pub(super) fn tell(&self, line: &impl Serialize) {
        if let Some(told) = &self.told {
            // A program that has ended is found by its silence.
            let _ = told.send(line_of(line));
        }
    }

    /// The next line of the program, which is about `what`.
    ///
    /// # Errors
    /// A [`Diagnostic`] if there is none in time, or it is no such thing.
    pub(super) fn answer<T: for<'a> Deserialize<'a>>(
        &mut self,
        what: &str,
    ) -> Result<(T, String), Diagnostic> {
        let line = match self.heard.recv_timeout(self.patience) {
            Ok(line) => line,
            Err(RecvTimeoutError::Timeout) => {
                let patience = counted(self.patience.as_secs() as usize, "second");
                let silent = format!("the program has not answered {what} within {patience}");
                let remedy =
                    "let it write a line for each that it reads, and flush it; or give --patience more";
                return Err(Diagnostic::in_file(&self.name, silent, remedy));
            }
            Err(RecvTimeoutError::Disconnected) => {
                let ended = format!("{} before it answered {what}", self.ended());
                let remedy = "its own messages, if it has written any, stand above";
                return Err(Diagnostic::in_file(&self.name, ended, remedy));
            }
        };
        self.count += 1;
        let text = String::from_utf8_lossy(&line);
        if line.len() as u64 > MAX_LINE_BYTES {
            return Err(self.fault(&text, 0, format_args!("this line has more than {MAX_LINE_BYTES} bytes")));
        }
        let text = text.trim_end().to_owned();
        let answer = parse(&text).map_err(|(column, message)| {
            self.fault(&text, column, format_args!("this does not answer {what}: {message}"))
        })?;
        Ok((answer, text))
    }

    /// A fault at a byte of the line that was heard last.
    pub(super) fn fault(&self, text: &str, at: usize, what: impl std::fmt::Display) -> Diagnostic {
        Diagnostic::in_line(&self.name, self.count, text, at..at + 1, what, PROTOCOL)
    }

    /// The end of a program that has closed its output, in words.
    fn ended(&mut self) -> String {
        match self.wait() {
            Some(status) => format!("the program has ended ({status})"),
            None => "the program has closed its output".to_owned(),
        }
    }

    /// Waits a little for the program to end.
    fn wait(&mut self) -> Option<std::process::ExitStatus> {
        let start = Instant::now();
        loop {
            match self.child.try_wait() {
                Ok(Some(status)) => return Some(status),
                Ok(None) if start.elapsed() < GRACE => thread::sleep(Duration::from_millis(5)),
                Ok(None) | Err(_) => return None,
            }
        }
    }

    /// Lets the program end by itself; if it does not, it is ended.
    pub(super) fn end(mut self) {
        self.told = None;
        self.wait();
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
