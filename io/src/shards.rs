//! Work dealt out to many machines: a *plan* says what is done, by which program, in how many shards; each shard keeps
//! how far it is in a file of its own, from which it is taken up again after whatever has killed it; and all shards
//! together give what one process gives, byte for byte. Who runs which shard where is the business of engines that
//! exist.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use sha2::{Digest, Sha256};

use crate::atomic_file::{AtomicFile, Replaceable};
use crate::checkpoint::{self, Lines, Part, Task};
use crate::diagnostic::{Diagnostic, Halt, Place};

/// The most shards: more than there are machines.
const MAX_SHARDS: u32 = 100_000;

/// The work that a plan deals out.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Work {
    /// A hunt.
    Hunt {
        /// The name of the scheme.
        scheme: String,
        /// The name of its rule.
        rule: String,
    },
    /// A table.
    Table {
        /// Its name.
        id: String,
    },
    /// Checks of published rules.
    Library {
        /// The names of the rules.
        rules: Vec<String>,
        /// Whether within larger bounds.
        larger: bool,
    },
}

/// The first line of a plan.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PlanTask {
    format: String,
    version: u32,
    of: Work,
    shards: u32,
    /// The SHA-256 of the program.
    program: String,
}

impl Task for PlanTask {
    const FORMAT: &'static str = "tautline plan";
    const VERSION: u32 = 2;
    const NOUN: &'static str = "a plan";
    const OTHER: &'static str = "this is another plan";
    const FIELDS: &'static [&'static str] = &["of", "shards", "program"];
    const AGAIN: &'static str = "name a plan, as a hunt or a table with `shards` writes it";
    const ELSEWHERE: &'static str = "plan anew";
    const OTHER_BUILD: &'static str = "run all shards and the merge with that build, or plan anew";
}

/// The first line of a shard's file.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ShardTask {
    format: String,
    version: u32,
    /// The SHA-256 of the plan: of what is done, by which program, and of what is dealt out.
    plan: String,
    shard: u32,
    done: bool,
}

impl Task for ShardTask {
    const FORMAT: &'static str = "tautline shard";
    const NOUN: &'static str = "a shard";
    const OTHER: &'static str = "this is another shard";
    const FIELDS: &'static [&'static str] = &["plan", "shard"];
    const AGAIN: &'static str = "remove it, and run the shard again";
    const OTHER_FORMAT: &'static str = "leave it out, or name a shard in its place";
    const ELSEWHERE: &'static str = "give the plan that it was run by, or remove it and run the shard again";

    fn set_done(&mut self, is_done: bool) {
        self.done = is_done;
    }
}

/// A plan.
#[derive(Clone, Debug)]
pub struct Plan {
    path: PathBuf,
    /// The work that is dealt out.
    pub of: Work,
    /// Among how many shards.
    pub shards: u32,
    /// How it is dealt out.
    pub deal: Box<RawValue>,
    digest: String,
}

/// The file of a shard that says that it is at its end.
#[derive(Debug)]
pub struct ShardFile {
    path: PathBuf,
    /// How far the shard is.
    pub far: Box<RawValue>,
}

impl ShardFile {
    /// Checks that it has done what it was dealt, where `part` is the shard as its file says that it is.
    ///
    /// # Errors
    /// [`Halt`] if it has not, or `part` cannot be had.
    pub fn check(&self, part: Result<Box<dyn Part + '_>, Halt>) -> Result<(), Halt> {
        match part {
            Ok(part) if part.is_done() => Ok(()),
            Ok(part) => {
                let what = format!("this shard has done less than the plan dealt it: {}", part.words());
                Err(Diagnostic::in_file(&self.path, what, ShardTask::AGAIN).into())
            }
            Err(Halt::Diagnostic(fault)) => {
                Err(fault.with_remedy(ShardTask::AGAIN).found_in(&self.path).into())
            }
            Err(halt @ Halt::Interrupted) => Err(halt),
        }
    }
}

/// A shard that keeps a merge from being whole.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Gap {
    /// There is no file of this shard.
    Missing(u32),
    /// This shard is not at its end.
    Unfinished(u32),
}

/// Where the file of a shard of the plan at `plan` stands.
fn shard_path(plan: &Path, shard: u32) -> PathBuf {
    let stem = plan.file_stem().unwrap_or_default().to_string_lossy();
    let end = plan.extension().map_or(String::new(), |end| format!(".{}", end.to_string_lossy()));
    plan.with_file_name(format!("{stem}-{shard}{end}"))
}

impl Plan {
    /// Stores a plan. Its file has yet to be put in its place.
    ///
    /// # Errors
    /// A [`Diagnostic`] if nothing can be written there, if another plan stands there of which a shard is kept, or if
    /// this program cannot be read.
    pub fn store(
        path: &Path,
        of: Work,
        shards: u32,
        deal: &RawValue,
        replaceable: &Replaceable,
    ) -> Result<AtomicFile, Diagnostic> {
        let task = PlanTask {
            format: PlanTask::FORMAT.to_owned(),
            version: PlanTask::VERSION,
            of,
            shards,
            program: program()?,
        };
        let mut file = AtomicFile::new(path, replaceable)?;
        let text = checkpoint::text(&task, deal);
        let before = fs::read_to_string(path).ok().filter(|before| *before != text);
        let old = before.and_then(|before| serde_json::from_str::<PlanTask>(before.lines().next()?).ok());
        let kept = old.and_then(|old| {
            (1..=old.shards.min(MAX_SHARDS)).map(|shard| shard_path(path, shard)).find(|shard| shard.exists())
        });
        if let Some(shard) = kept {
            let what = format!("this is another plan, and {} is a shard of it", shard.display());
            return Err(Diagnostic::in_file(path, what, "name another plan, or remove that one's shards"));
        }
        file.append(text);
        Ok(file)
    }

    /// Checks that so many shards can be planned.
    ///
    /// # Errors
    /// A [`Diagnostic`] if they are none, or too many.
    pub fn check(shards: u32) -> Result<(), Diagnostic> {
        if (1..=MAX_SHARDS).contains(&shards) {
            return Ok(());
        }
        let what =
            if shards == 0 { "nothing is dealt out among no shards" } else { "these are too many shards" };
        Err(Diagnostic::of_field(
            "shards",
            what,
            format_args!("give `shards` a number from 1 to {MAX_SHARDS}"),
        ))
    }

    /// The fault of a plan that deals out something else than `work`.
    pub fn none_of(&self, work: &str) -> Diagnostic {
        let what = format!("this plan is none of {work}");
        Diagnostic::in_file(&self.path, what, "run it with the command that planned it")
    }

    /// The plan that stands at `path`.
    ///
    /// # Errors
    /// A [`Diagnostic`] if there is none, it is damaged, or another program made it.
    pub fn read(path: &Path) -> Result<Self, Diagnostic> {
        let Some(file) = checkpoint::open::<PlanTask>(path)? else {
            return Err(Diagnostic::in_file(path, "there is no such file", PlanTask::AGAIN));
        };
        let lines = Lines::<PlanTask>::read(path, &file, None)?;
        let PlanTask { of, shards, program: planned, .. } = lines.task().clone();
        if !(1..=MAX_SHARDS).contains(&shards) {
            let what = format!("there are no plans of {shards} shards");
            return Err(lines.in_header("shards", what, PlanTask::AGAIN));
        }
        if planned != program()? {
            return Err(lines.of_another_build());
        }
        let digest = hex(&Sha256::digest(lines.text()));
        Ok(Self { path: path.to_owned(), of, shards, deal: lines.far()?, digest })
    }

    /// Where it stands.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The fault in a `part` of the deal, as one of the plan's file: at its place, if it has one.
    #[must_use]
    pub fn fault(&self, part: &str, fault: &Diagnostic) -> Diagnostic {
        let Place::Spot { column, .. } = fault.place() else { return fault.clone().found_in(&self.path) };
        let deal = self.deal.get();
        let at = deal.find(part).unwrap_or_default() + column - 1;
        Diagnostic::in_line(&self.path, 2, deal, at..at + 1, fault.what(), fault.remedy())
    }

    /// Checks that it has this shard.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it has not.
    pub fn check_shard(&self, shard: u32) -> Result<(), Diagnostic> {
        if (1..=self.shards).contains(&shard) {
            return Ok(());
        }
        let what = format!("there is no shard {shard} of {}", self.shards);
        Err(Diagnostic::of_field("shard", what, format!("give `shard` a number from 1 to {}", self.shards)))
    }

    /// Where the file of a shard stands unless it is said otherwise: beside the plan, with its number at the end of the
    /// name.
    pub fn shard_path(&self, shard: u32) -> PathBuf {
        shard_path(&self.path, shard)
    }

    /// The task of a shard.
    pub fn task(&self, shard: u32) -> ShardTask {
        let (format, version) = (ShardTask::FORMAT.to_owned(), checkpoint::VERSION);
        ShardTask { format, version, plan: self.digest.clone(), shard, done: false }
    }

    /// How far each shard is that `files` tell of, and which of them does, in the order of the shards; or what is
    /// missing.
    ///
    /// # Errors
    /// A [`Diagnostic`] if a file is no shard of this plan, or two are the same shard.
    pub fn results(&self, files: &[PathBuf]) -> Result<Result<Vec<ShardFile>, Vec<Gap>>, Diagnostic> {
        let mut found: Vec<Option<(bool, ShardFile)>> = (0..self.shards).map(|_| None).collect();
        for path in files {
            let Some(file) = checkpoint::open::<ShardTask>(path)? else {
                return Err(Diagnostic::in_file(path, "there is no such file", "give the files of shards"));
            };
            let lines = Lines::<ShardTask>::read(path, &file, None)?;
            let &ShardTask { shard, done, .. } = lines.task();
            lines.check(&self.task(shard))?;
            let Some(place) = found.get_mut((shard as usize).wrapping_sub(1)) else {
                let what = format!("there is no shard {shard} of {}", self.shards);
                return Err(lines.in_header("shard", what, ShardTask::AGAIN));
            };
            if place.is_some() {
                let what = format!("shard {shard} is there twice");
                return Err(lines.in_header("shard", what, "give each shard once"));
            }
            *place = Some((done, ShardFile { path: path.clone(), far: lines.far()? }));
        }
        let gap = |(place, shard): (&Option<(bool, _)>, u32)| match place {
            None => Some(Gap::Missing(shard)),
            Some((false, _)) => Some(Gap::Unfinished(shard)),
            Some((true, _)) => None,
        };
        let gaps: Vec<Gap> = found.iter().zip(1..).filter_map(gap).collect();
        if !gaps.is_empty() {
            return Ok(Err(gaps));
        }
        Ok(Ok(found.into_iter().flatten().map(|(_, done)| done).collect()))
    }
}

/// The SHA-256 of this program.
///
/// # Errors
/// A [`Diagnostic`] if it cannot be read.
pub fn program() -> Result<String, Diagnostic> {
    let read = || Ok(hex(&Sha256::digest(fs::read(env::current_exe()?)?)));
    read().map_err(|error: io::Error| {
        let what = format_args!("the file of this program cannot be read: {error}");
        let remedy =
            "run it from a file that it may read: a file that work goes on from says which program made it";
        Diagnostic::usage(what, remedy)
    })
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}
