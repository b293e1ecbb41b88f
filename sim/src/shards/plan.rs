//! Plans and the files of their shards.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use sha2::{Digest, Sha256};

use crate::atomic_file::{AtomicFile, Replaceable};
use crate::checkpoint::{self, Checkpoint, Header, Lines};
use crate::diagnostic::{Diagnostic, Halt};
use crate::resumable::Resumable;

/// The most shards: more than there are machines.
const MAX_SHARDS: u32 = 100_000;

/// What is dealt out.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Of {
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
}

/// The first line of a plan.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Planned {
    format: String,
    version: u32,
    of: Of,
    shards: u32,
    /// The SHA-256 of the program.
    program: String,
}

impl Header for Planned {
    const FORMAT: &'static str = "tautline plan";
    const NOUN: &'static str = "a plan";
    const OTHER: &'static str = "this is another plan";
    const FIELDS: &'static [&'static str] = &["of", "shards", "program"];
    const AGAIN: &'static str = "name a plan, as a hunt or a table with `shards` writes it";
    const ELSEWHERE: &'static str = "plan anew";
}

/// The first line of a shard's file.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Sharded {
    format: String,
    version: u32,
    /// The SHA-256 of the plan: of what is done, by which program, and of what is dealt out.
    plan: String,
    shard: u32,
    done: bool,
}

impl Header for Sharded {
    const FORMAT: &'static str = "tautline shard";
    const NOUN: &'static str = "a shard";
    const OTHER: &'static str = "this is another shard";
    const FIELDS: &'static [&'static str] = &["plan", "shard"];
    const AGAIN: &'static str = "remove it, and run the shard again";
    const ELSEWHERE: &'static str = "give the plan that it was run by, or remove it and run the shard again";
}

/// A plan.
#[derive(Clone, Debug)]
pub struct Plan {
    path: PathBuf,
    /// What is dealt out.
    pub of: Of,
    /// Among how many shards.
    pub shards: u32,
    /// How it is dealt out.
    pub deal: Box<RawValue>,
    digest: String,
}

/// A shard that says that it is at its end.
#[derive(Debug)]
pub struct Done {
    /// Its file.
    path: PathBuf,
    /// How far it is.
    pub far: Box<RawValue>,
}

impl Done {
    /// Checks that it has done what it was dealt, where `part` is the shard as its file says that it is.
    ///
    /// # Errors
    /// [`Halt`] if it has not, or `part` cannot be had.
    pub fn check(&self, part: Result<Box<dyn Resumable + '_>, Halt>) -> Result<(), Halt> {
        match part {
            Ok(part) if part.is_done() => Ok(()),
            Ok(part) => {
                let what = format!("this shard has done less than the plan dealt it: {}", part.words());
                Err(Diagnostic::in_file(&self.path, what, Sharded::AGAIN).into())
            }
            Err(Halt::Diagnostic(fault)) => {
                Err(fault.with_remedy(Sharded::AGAIN).found_in(&self.path).into())
            }
            Err(halt @ Halt::Interrupted) => Err(halt),
        }
    }
}

/// What keeps a merge from being whole.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Gap {
    /// There is no file of this shard.
    Missing(u32),
    /// This shard is not at its end.
    Unfinished(u32),
}

impl Plan {
    /// Stores a plan. Its file has yet to be put in its place.
    ///
    /// # Errors
    /// A [`Diagnostic`] if nothing can be written there, or this program cannot be read.
    pub fn store(
        path: &Path,
        of: Of,
        shards: u32,
        deal: &RawValue,
        replaceable: &Replaceable,
    ) -> Result<AtomicFile, Diagnostic> {
        let header = Planned {
            format: Planned::FORMAT.to_owned(),
            version: checkpoint::VERSION,
            of,
            shards,
            program: program()?,
        };
        let mut aside = AtomicFile::new(path, replaceable)?;
        aside.append(checkpoint::text(&header, &deal));
        Ok(aside)
    }

    /// Checks that so many shards can be planned.
    ///
    /// # Errors
    /// A [`Diagnostic`] if they are none, or too many.
    pub fn check(shards: u32) -> Result<(), Diagnostic> {
        if (1..=MAX_SHARDS).contains(&shards) {
            return Ok(());
        }
        let remedy = format!("give `shards` a number from 1 to {MAX_SHARDS}");
        Err(Diagnostic::of_field("shards", format_args!("nothing is dealt out among {shards}"), remedy))
    }

    /// The plan that stands at `path`.
    ///
    /// # Errors
    /// A [`Diagnostic`] if there is none, it is damaged, or another program made it.
    pub fn read(path: &Path) -> Result<Self, Diagnostic> {
        let Some(file) = checkpoint::open::<Planned>(path)? else {
            return Err(Diagnostic::in_file(path, "there is no such file", Planned::AGAIN));
        };
        let lines = Lines::<Planned>::read(path, &file, None)?;
        let Planned { of, shards, program: planned, .. } = lines.header().clone();
        if !(1..=MAX_SHARDS).contains(&shards) {
            let what = format!("there are no plans of {shards} shards");
            return Err(lines.in_header("shards", what, Planned::AGAIN));
        }
        if planned != program()? {
            let what = "another build of tautline made this plan".to_owned();
            let remedy = "run all shards and the merge with that build, or plan anew";
            return Err(lines.in_header("program", what, remedy));
        }
        let digest = hex(&Sha256::digest(lines.text()));
        Ok(Self { path: path.to_owned(), of, shards, deal: lines.far()?, digest })
    }

    /// Where it stands.
    pub fn path(&self) -> &Path {
        &self.path
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
        let stem = self.path.file_stem().unwrap_or_default().to_string_lossy();
        let end = self.path.extension().map_or(String::new(), |end| format!(".{}", end.to_string_lossy()));
        self.path.with_file_name(format!("{stem}-{shard}{end}"))
    }

    fn header(&self, shard: u32) -> Sharded {
        let (format, version) = (Sharded::FORMAT.to_owned(), checkpoint::VERSION);
        Sharded { format, version, plan: self.digest.clone(), shard, done: false }
    }

    /// How far each shard is that `files` tell of, and which of them does, in the order of the shards; or what is
    /// missing.
    ///
    /// # Errors
    /// A [`Diagnostic`] if a file is no shard of this plan, or two are the same shard.
    pub fn results(&self, files: &[PathBuf]) -> Result<Result<Vec<Done>, Vec<Gap>>, Diagnostic> {
        let mut found: Vec<Option<(bool, Done)>> = (0..self.shards).map(|_| None).collect();
        for path in files {
            let Some(file) = checkpoint::open::<Sharded>(path)? else {
                return Err(Diagnostic::in_file(path, "there is no such file", "give the files of shards"));
            };
            let lines = Lines::<Sharded>::read(path, &file, None)?;
            let &Sharded { shard, done, .. } = lines.header();
            lines.check(&self.header(shard))?;
            let Some(place) = found.get_mut((shard as usize).wrapping_sub(1)) else {
                let what = format!("there is no shard {shard} of {}", self.shards);
                return Err(lines.in_header("shard", what, Sharded::AGAIN));
            };
            if place.is_some() {
                let what = format!("shard {shard} is there twice");
                return Err(lines.in_header("shard", what, "give each shard once"));
            }
            *place = Some((done, Done { path: path.clone(), far: lines.far()? }));
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

/// Keeps how far a shard is.
#[derive(Debug)]
pub struct Keeper<'a> {
    kept: Checkpoint<'a, Sharded>,
}

impl<'a> Keeper<'a> {
    /// The keeper of a shard of `plan`, whose file stands at `path`; and how far that shard is, if there is such a
    /// file.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the file is damaged, of another shard or in use.
    pub fn open(
        plan: &Plan,
        shard: u32,
        path: &'a Path,
    ) -> Result<(Self, Option<Box<RawValue>>), Diagnostic> {
        let mut kept = Checkpoint::new(path, plan.header(shard));
        let far = kept.read()?;
        Ok((Self { kept }, far))
    }

    /// Keeps how far `part` is.
    ///
    /// # Errors
    /// [`Halt`] if that cannot be written.
    pub fn keep(&mut self, part: &dyn Resumable) -> Result<(), Halt> {
        self.kept.header_mut().done = part.is_done();
        Ok(self.kept.write(&part.far()?)?)
    }
}

/// The SHA-256 of this program.
fn program() -> Result<String, Diagnostic> {
    let read = || Ok(hex(&Sha256::digest(fs::read(env::current_exe()?)?)));
    read().map_err(|error: io::Error| {
        let what = format_args!("the file of this program cannot be read: {error}");
        Diagnostic::usage(what, "run it from a file that it may read: a plan says which program made it")
    })
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}
