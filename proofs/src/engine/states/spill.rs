//! States on disk, for a search that needs more memory than it may have: delayed duplicate detection (Stern and Dill
//! 1998; Korf 2008). When memory is full, all states in it are written to a file, once in the order in which they were
//! found and once in that of their hashes, and memory is empty again. From then on the steps from many states are made
//! before it is asked whether the states to which they lead are known: in memory at once, and then in each file, which
//! is read from its beginning to its end at most. States keep their numbers and their order, so that counts and first
//! runs are those of a search in memory.
//!
//! Each file also has what was added to the graph, and how far the search is, and is put in its place when it is whole:
//! a search that is killed is taken up after its last file, by the same program. Blocks have checksums.

mod file;

use std::env;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{LazyLock, Mutex, PoisonError};

use tautline_certificates::digest;

pub use self::file::HEAD;
pub(super) use self::file::{Lookup, Numbers};
use self::file::{Segment, Writer};
use super::tables::Codes;
use crate::engine::threads;

/// The end of the name of a file from which a search can be taken up.
pub const WHOLE: &str = "states";

/// The end of the name of a file that is of use to its own search alone.
pub const PART: &str = "part";

/// A folder in which searches go on for which memory does not suffice, and which nobody else uses meanwhile.
#[derive(Debug)]
pub struct Spill {
    folder: PathBuf,
    create: Create,
    fault: Mutex<Option<SpillError>>,
}

/// Makes a file that is to be written.
pub type Create = fn(&Path) -> io::Result<Box<dyn Write>>;

impl Spill {
    /// This folder.
    pub const fn new(folder: PathBuf) -> Self {
        Self::with(folder, |path| Ok(Box::new(File::create(path)?)))
    }

    /// This folder, in which files are made so.
    pub const fn with(folder: PathBuf, create: Create) -> Self {
        Self { folder, create, fault: Mutex::new(None) }
    }

    /// Why the first search that could not go on did not.
    pub(super) fn fault(&self) -> Option<SpillError> {
        self.fault.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    pub(super) fn note(&self, fault: SpillError) {
        self.fault.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(fault);
    }
}

/// Why a search cannot go on in its folder.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct SpillError {
    /// The file.
    pub path: PathBuf,
    /// Its fault.
    pub fault: SpillFault,
}

/// The fault of a file with states.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum SpillFault {
    /// It cannot be written: why.
    Unwritable(String),
    /// It cannot be read: why.
    Unreadable(String),
    /// It is not as it was written.
    Damaged,
    /// It is of a rule whose steps lead elsewhere.
    Foreign,
}

impl SpillFault {
    fn of_reading(error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::InvalidData | io::ErrorKind::UnexpectedEof => Self::Damaged,
            _ => Self::Unreadable(error.to_string()),
        }
    }

    /// A sentence that says what can be done about it.
    pub const fn remedy(&self) -> &'static str {
        match self {
            Self::Unwritable(_) => {
                "make room there, or name a folder on a larger disk: the same command takes up what is whole there"
            }
            Self::Unreadable(_) => "see that the folder can be read, and run the same command again",
            Self::Damaged | Self::Foreign => "empty the folder, and run the same command again",
        }
    }
}

impl fmt::Display for SpillFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unwritable(why) => write!(f, "the states of a search cannot be written: {why}"),
            Self::Unreadable(why) => write!(f, "the states of a search cannot be read: {why}"),
            Self::Damaged => f.write_str("the states of a search are damaged"),
            Self::Foreign => f.write_str("these are the states of another rule, or of another program"),
        }
    }
}

impl fmt::Display for SpillError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}; {}", self.path.display(), self.fault, self.fault.remedy())
    }
}

impl std::error::Error for SpillError {}

/// The states of a search that stand on disk.
pub(super) struct Disk {
    folder: PathBuf,
    create: Create,
    /// The beginning of the names of its files.
    name: String,
    /// The question, if the search can be taken up.
    question: Option<String>,
    segments: Vec<Segment>,
    /// States that were read, which follow one another, and the number of the first.
    window: (usize, Codes),
    fault: Option<SpillError>,
}

/// The digest of the program: another one may have another rule or demand by the same name. Where it cannot be read
/// nothing is taken up.
static PROGRAM: LazyLock<Option<u128>> =
    LazyLock::new(|| env::current_exe().and_then(fs::read).ok().map(|bytes| digest(&bytes)));

/// The number of the next search that cannot be taken up.
static NEXT: AtomicU64 = AtomicU64::new(0);

impl Disk {
    /// Nothing yet, of a search that can be taken up if there is a question.
    pub(super) fn new(spill: &Spill, question: Option<(&str, usize)>) -> Self {
        let question = question.zip(*PROGRAM);
        let question =
            question.map(|((words, number), program)| format!("{program:032x}, {words}, {number}"));
        let name = match &question {
            Some(question) => format!("{:016x}", digest(question.as_bytes()) as u64),
            None => NEXT.fetch_add(1, Ordering::Relaxed).to_string(),
        };
        let (folder, create) = (spill.folder.clone(), spill.create);
        Self { folder, create, name, question, segments: Vec::new(), window: Default::default(), fault: None }
    }

    /// The number of states.
    pub(super) fn len(&self) -> usize {
        self.segments.last().map_or(0, |segment| segment.nodes.end)
    }

    /// The bytes of memory that it takes.
    pub(super) fn bytes(&self) -> u64 {
        let entries = |segment: &Segment| segment.in_order.len() + segment.by_hash.len();
        let entries: usize = self.segments.iter().map(entries).sum();
        self.window.1.bytes() + (entries * size_of::<(u32, u64)>()) as u64
    }

    pub(super) fn fault(&self) -> Option<&SpillError> {
        self.fault.as_ref()
    }

    /// The path of the file with this number, and of the one that becomes it.
    fn path(&self, number: usize, end: &str) -> PathBuf {
        self.folder.join(format!("{}-{number}.{end}", self.name))
    }

    /// Notes that something went wrong with a file.
    fn fails(&mut self, path: PathBuf, fault: SpillFault) {
        self.fault.get_or_insert(SpillError { path, fault });
    }

    /// The search cannot be taken up from here on.
    pub(super) fn forget_question(&mut self) {
        self.question = None;
    }

    /// The states are of another rule.
    pub(super) fn is_foreign(&mut self) {
        self.fails(self.path(0, WHOLE), SpillFault::Foreign);
    }

    /// Removes the files of a search, unless it may be taken up.
    pub(super) fn leave(&self, is_over: bool) {
        let is_left = |segment: &Segment| is_over || segment.path.extension().is_some_and(|end| end == PART);
        for segment in self.segments.iter().filter(|segment| is_left(segment)) {
            let _ = fs::remove_file(&segment.path);
        }
    }

    /// Writes states, of which the first has the next number; their slots in the order of their hashes; and numbers.
    /// Writes a file; one that cannot be written to its end is removed, and false returned.
    pub(super) fn write(
        &mut self,
        (codes, sorted): (&Codes, &[u64]),
        numbers: impl Iterator<Item = u64>,
    ) -> bool {
        let number = self.segments.len();
        let part = self.path(number, PART);
        let is_whole = self.question.is_some();
        // Nobody reads them where nothing is taken up.
        let numbers = numbers.take(if is_whole { usize::MAX } else { 0 });
        let path = if is_whole { self.path(number, WHOLE) } else { part.clone() };
        let nodes = self.len()..self.len() + codes.length;
        let question = self.question.as_deref().unwrap_or_default();
        let written = (self.create)(&part).and_then(|file| {
            let first = nodes.start as u32;
            let [in_order, by_hash] =
                Writer::new(file, question, nodes.start)?.write(first, (codes, sorted), numbers)?;
            if is_whole {
                fs::rename(&part, &path)?;
            }
            Ok(Segment { path: path.clone(), nodes, in_order, by_hash })
        });
        match written {
            Ok(segment) => self.segments.push(segment),
            Err(error) => {
                let _ = fs::remove_file(&part);
                self.fails(path, SpillFault::Unwritable(error.to_string()));
            }
        }
        self.fault.is_none()
    }

    /// Takes up the next file, if there is one: the numbers that were written with its states.
    pub(super) fn take_up(&mut self) -> Option<Numbers> {
        let path = self.path(self.segments.len(), WHOLE);
        let question = self.question.as_deref().filter(|_| path.exists() && self.fault.is_none())?;
        match Segment::open(&path, self.len(), question) {
            Ok((segment, numbers)) => {
                self.segments.push(segment);
                Some(numbers)
            }
            Err(error) => {
                self.fails(path, SpillFault::of_reading(&error));
                None
            }
        }
    }

    /// The numbers of the last file that was taken up are no good.
    pub(super) fn is_damaged(&mut self, error: &io::Error) {
        let path = self.path(self.segments.len().saturating_sub(1), WHOLE);
        self.fails(path, SpillFault::of_reading(error));
    }

    /// The code of a state that was loaded.
    pub(super) fn code(&self, node: usize) -> Option<&[u8]> {
        let place = node.checked_sub(self.window.0).filter(|&place| place < self.window.1.length)?;
        Some(self.window.1.entry(place))
    }

    /// Loads those of these states that stand here. False if they cannot be read.
    pub(super) fn load(&mut self, nodes: Range<usize>) -> bool {
        let nodes = nodes.start..nodes.end.min(self.len());
        if nodes.is_empty() || self.code(nodes.start).is_some() && self.code(nodes.end - 1).is_some() {
            return true;
        }
        let mut window: Option<(usize, Codes)> = None;
        let overlaps =
            |segment: &&Segment| segment.nodes.start < nodes.end && nodes.start < segment.nodes.end;
        for segment in self.segments.iter().filter(overlaps) {
            if let Err(error) = segment.load(&nodes, &mut window) {
                let (path, fault) = (segment.path.clone(), SpillFault::of_reading(&error));
                self.fails(path, fault);
                return false;
            }
        }
        self.window = window.unwrap_or_default();
        true
    }

    /// Looks for states in all files, by so many workers. False if one cannot be read.
    pub(super) fn look_up(&mut self, mut wanted: Vec<Lookup<'_>>, workers: usize) -> bool {
        wanted.sort_unstable_by_key(|wanted| wanted.hash);
        let segments = &self.segments;
        let sweep = |part: &mut [Lookup<'_>]| {
            let failed =
                |segment: &Segment| segment.look_up(part).err().map(|error| (segment.path.clone(), error));
            segments.iter().find_map(failed)
        };
        let each = wanted.len().div_ceil(workers).max(1);
        let failed = threads::each_by(workers, wanted.chunks_mut(each), sweep);
        if let Some((path, error)) = failed.into_iter().flatten().next() {
            self.fails(path, SpillFault::of_reading(&error));
        }
        self.fault.is_none()
    }
}
