//! A file with states: blocks of at least 16 KiB but for the last ones, each behind its length and its hash. First the
//! states in the order in which they were found; then in that of their hashes, of which each block ends with where its
//! entries begin; then numbers: how many states there are, the blocks of both kinds, and what the search has to say.

use std::fs::File;
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::mem;
use std::ops::Range;
use std::path::{Path, PathBuf};

use tautline_certificates::{put, take};

use super::super::code::{HashOfState, hash_of};
use super::super::tables::Codes;

/// How each file begins.
pub const HEAD: &str = "tautline states 1\n";

/// A state that is looked for, and its number once it is found.
pub(in super::super) struct Lookup<'a> {
    pub(in super::super) hash: HashOfState,
    pub(in super::super) code: &'a [u8],
    pub(in super::super) node: &'a mut Option<u32>,
}

/// The blocks of one kind in a file: of each the key of its first entry, and where it begins.
pub(super) type Index = Vec<(u32, u64)>;

/// A file.
pub(super) struct Segment {
    pub(super) path: PathBuf,
    pub(super) nodes: Range<usize>,
    pub(super) in_order: Index,
    pub(super) by_hash: Index,
}

impl Segment {
    /// Opens a file whose first state has this number, and which answers this question.
    pub(super) fn open(path: &Path, first: usize, question: &str) -> io::Result<(Self, Numbers)> {
        let mut blocks = Blocks::open(path)?;
        let right = head(question, first);
        let mut head = vec![0; right.len()];
        blocks.file.read_exact(&mut head)?;
        let mut last = [0; size_of::<u64>()];
        blocks.file.seek(SeekFrom::End(-(last.len() as i64))).map_err(|_| damaged())?;
        blocks.file.read_exact(&mut last)?;
        let mut numbers = Numbers { blocks, at: 0, next: u64::from_le_bytes(last) };
        let count = numbers.next()? as usize;
        if head != right || first + count > u32::MAX as usize {
            return Err(damaged());
        }
        let mut index = || -> io::Result<Index> {
            let count = numbers.next()?;
            (0..count).map(|_| Ok((numbers.next()? as u32, numbers.next()?))).collect()
        };
        let (in_order, by_hash) = (index()?, index()?);
        Ok((Self { path: path.to_owned(), nodes: first..first + count, in_order, by_hash }, numbers))
    }

    /// Adds the states from the block of the first of these nodes on.
    pub(super) fn load(&self, nodes: &Range<usize>, window: &mut Option<(usize, Codes)>) -> io::Result<()> {
        let mut blocks = Blocks::open(&self.path)?;
        let before = self.in_order.partition_point(|&(first, _)| first as usize <= nodes.start);
        for &(first, offset) in &self.in_order[before.saturating_sub(1)..] {
            if first as usize >= nodes.end {
                break;
            }
            let codes = &mut window.get_or_insert_with(|| (first as usize, Codes::default())).1;
            blocks.read(offset)?;
            let mut rest = &blocks.bytes[..];
            while !rest.is_empty() {
                codes.push(code(&mut rest)?);
            }
        }
        Ok(())
    }

    /// Looks for states, which are in the order of their hashes.
    pub(super) fn look_up(&self, wanted: &mut [Lookup<'_>]) -> io::Result<()> {
        let (mut blocks, mut loaded, mut before) = (Blocks::open(&self.path)?, usize::MAX, 0);
        for Lookup { hash, code, node } in wanted.iter_mut().filter(|wanted| wanted.node.is_none()) {
            while self.by_hash.get(before + 1).is_some_and(|(first, _)| first < hash) {
                before += 1;
            }
            let may_have = self.by_hash[before..].iter().take_while(|(first, _)| first <= hash);
            for (place, &(_, offset)) in (before..).zip(may_have) {
                if loaded != place {
                    blocks.read(offset)?;
                    loaded = place;
                }
                **node = blocks.find(*hash, code);
                if node.is_some() {
                    break;
                }
            }
        }
        Ok(())
    }
}

/// The first lines of a file whose first state has this number.
fn head(question: &str, first: usize) -> Vec<u8> {
    format!("{HEAD}{question}, from state {first}\n").into_bytes()
}

fn damaged() -> io::Error {
    io::ErrorKind::InvalidData.into()
}

fn number(bytes: &mut &[u8]) -> io::Result<u64> {
    take(bytes).ok_or_else(damaged)
}

fn code<'a>(bytes: &mut &'a [u8]) -> io::Result<&'a [u8]> {
    let length = number(bytes)? as usize;
    bytes.split_off(..length).ok_or_else(damaged)
}

/// Bytes from which on a block is full. An entry stands in one block.
const BLOCK: usize = 1 << 14;

/// The end of a block as it is written.
fn within_block(block: &[u8]) -> io::Result<[u8; 2]> {
    let end = u16::try_from(block.len());
    end.map(u16::to_le_bytes).map_err(|_| io::Error::other("a state takes more than 48 KiB"))
}

/// A file that is written in blocks, each behind its length and its hash.
pub(super) struct Writer {
    file: BufWriter<Box<dyn Write>>,
    at: u64,
    block: Vec<u8>,
    /// Where the entries of the block begin, if it is to end with that.
    begins: Option<Vec<u8>>,
    index: Index,
}

impl Writer {
    pub(super) fn new(file: Box<dyn Write>, question: &str, first: usize) -> io::Result<Self> {
        let (mut file, head) = (BufWriter::new(file), head(question, first));
        file.write_all(&head)?;
        Ok(Self { file, at: head.len() as u64, block: Vec::new(), begins: None, index: Vec::new() })
    }

    /// The block for an entry with this key.
    fn entry(&mut self, key: u32) -> io::Result<&mut Vec<u8>> {
        if self.block.len() >= BLOCK {
            self.end_block()?;
        }
        if self.block.is_empty() {
            self.index.push((key, self.at));
        }
        if let Some(begins) = &mut self.begins {
            begins.extend(within_block(&self.block)?);
        }
        Ok(&mut self.block)
    }

    fn end_block(&mut self) -> io::Result<()> {
        if let Some(begins) = &mut self.begins {
            let end = within_block(&self.block)?;
            self.block.append(begins);
            self.block.extend(end);
        }
        for part in
            [&(self.block.len() as u32).to_le_bytes()[..], &hash_of(&self.block).to_le_bytes(), &self.block]
        {
            self.file.write_all(part)?;
            self.at += part.len() as u64;
        }
        self.block.clear();
        Ok(())
    }

    /// The index of the blocks since the last one.
    fn end_index(&mut self) -> io::Result<Index> {
        self.end_block()?;
        Ok(mem::take(&mut self.index))
    }

    /// Writes all of a file: the indexes of its states in order and by hash.
    pub(super) fn write(
        mut self,
        first: u32,
        (codes, sorted): (&Codes, &[u64]),
        numbers: impl Iterator<Item = u64>,
    ) -> io::Result<[Index; 2]> {
        for place in 0..codes.length {
            let (block, code) = (self.entry(first + place as u32)?, codes.entry(place));
            put(block, code.len() as u64);
            block.extend_from_slice(code);
        }
        let in_order = self.end_index()?;
        self.begins = Some(Vec::new());
        for &slot in sorted {
            let (hash, node) = ((slot >> u32::BITS) as u32, slot as u32);
            let block = self.entry(hash)?;
            block.extend(hash.to_le_bytes());
            block.extend(node.to_le_bytes());
            block.extend_from_slice(codes.entry((node - first) as usize));
        }
        let by_hash = self.end_index()?;
        self.begins = None;
        let numbers_at = self.at;
        put(self.entry(0)?, codes.length as u64);
        for index in [&in_order, &by_hash] {
            put(self.entry(0)?, index.len() as u64);
            for &(key, offset) in index {
                put(self.entry(0)?, key.into());
                put(self.entry(0)?, offset);
            }
        }
        for number in numbers {
            put(self.entry(0)?, number);
        }
        self.end_block()?;
        self.file.write_all(&numbers_at.to_le_bytes())?;
        self.file.flush()?;
        Ok([in_order, by_hash])
    }
}

/// A file that is read in blocks.
struct Blocks {
    file: File,
    bytes: Vec<u8>,
}

impl Blocks {
    fn open(path: &Path) -> io::Result<Self> {
        Ok(Self { file: File::open(path)?, bytes: Vec::new() })
    }

    /// Reads the block that begins there.
    fn read(&mut self, offset: u64) -> io::Result<()> {
        self.file.seek(SeekFrom::Start(offset)).map_err(|_| damaged())?;
        let mut header = [0; 8];
        self.file.read_exact(&mut header)?;
        let [length, hash] = [0, 4].map(|at| u32::from_le_bytes([0, 1, 2, 3].map(|byte| header[at + byte])));
        self.bytes.clear();
        (&self.file).take(length.into()).read_to_end(&mut self.bytes)?;
        if self.bytes.len() == length as usize && hash_of(&self.bytes) == hash {
            Ok(())
        } else {
            Err(damaged())
        }
    }

    /// The number of a state in the block that was read.
    fn find(&self, hash: HashOfState, code: &[u8]) -> Option<u32> {
        let (rest, &end) = self.bytes.split_last_chunk()?;
        let (entries, begins) = rest.split_at_checked(u16::from_le_bytes(end).into())?;
        let begins = begins.as_chunks().0;
        let begin =
            |place: usize| begins.get(place).map_or(entries.len(), |&at| u16::from_le_bytes(at).into());
        let entry = |place: usize| {
            let (&hash, rest) = entries.get(begin(place)..begin(place + 1))?.split_first_chunk()?;
            let (&node, code) = rest.split_first_chunk()?;
            Some((u32::from_le_bytes(hash), u32::from_le_bytes(node), code))
        };
        let (mut first, mut last) = (0, begins.len());
        while first < last {
            let middle = first.midpoint(last);
            if entry(middle)?.0 < hash {
                first = middle + 1;
            } else {
                last = middle;
            }
        }
        let mut same = (first..begins.len()).map_while(entry).take_while(|&(other, ..)| other == hash);
        same.find(|&(.., its)| its == code).map(|(_, node, _)| node)
    }
}

/// The numbers that a file has, one after the other.
pub(in super::super) struct Numbers {
    blocks: Blocks,
    at: usize,
    /// Where the next block begins.
    next: u64,
}

impl Numbers {
    pub(in super::super) fn next(&mut self) -> io::Result<u64> {
        if self.at == self.blocks.bytes.len() {
            self.blocks.read(self.next)?;
            self.at = 0;
            self.next += 8 + self.blocks.bytes.len() as u64;
        }
        let mut rest = &self.blocks.bytes[self.at..];
        let number = number(&mut rest)?;
        self.at = self.blocks.bytes.len() - rest.len();
        Ok(number)
    }
}
