//! The file: lines of text with what it is about, the sections, each behind its length, and a digest.

use std::fmt;
use std::str::FromStr;

use siphasher::sip128::SipHasher13;

/// The first line, which names the version of the format.
const FIRST: &str = "tautline certificate 1";

/// Bytes of a digest.
const DIGEST: usize = 16;

/// The subject of a certificate: who wrote it, and about which clause and bound.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Header {
    /// The program that wrote it, with its version.
    pub program: String,
    /// The clause.
    pub clause: String,
    /// The number of the check among those of the clause.
    pub check: usize,
    /// The name of the rule.
    pub rule: String,
    /// The digest of what it claims.
    pub claim: u128,
    /// The number of states in all sections.
    pub states: u64,
}

/// A file that is as it was written.
#[derive(Debug)]
pub struct File<'a> {
    /// Its subject.
    pub header: Header,
    /// A section for each system.
    pub sections: Vec<&'a [u8]>,
    /// The digest of all of it.
    pub digest: u128,
}

/// Why bytes are no certificate.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fault {
    /// They do not begin like one of this format.
    Foreign,
    /// They are too few, or not those that were written.
    Damaged,
    /// This line of the header, from 1, is none; so it should begin.
    Line(usize, &'static str),
    /// The sections do not end where the digest begins.
    Sections,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Foreign => write!(f, "it does not begin with the line {FIRST:?}"),
            Self::Damaged => {
                f.write_str("it is cut short or changed: its last 16 bytes are no digest of the others")
            }
            Self::Line(line, begin) => write!(f, "its line {line} is no line {begin:?} with a value"),
            Self::Sections => f.write_str("its sections do not end where its digest begins"),
        }
    }
}

impl std::error::Error for Fault {}

/// The digest of these bytes: SipHash-1-3 in 128 bits. It finds damage; whoever changes a file can make it anew.
pub fn digest(bytes: &[u8]) -> u128 {
    SipHasher13::new().hash(bytes).as_u128()
}

/// Appends a number in seven bits a byte, the lowest first.
pub fn put(to: &mut Vec<u8>, mut number: u64) {
    while number > 0x7f {
        to.push(number as u8 | 0x80);
        number >>= 7;
    }
    to.push(number as u8);
}

/// Takes a number that [`put`] has written from the beginning of `bytes`.
#[inline]
pub fn take(bytes: &mut &[u8]) -> Option<u64> {
    let (mut number, mut shift) = (0_u64, 0);
    loop {
        let byte = *bytes.split_off_first()?;
        let bits = u64::from(byte & 0x7f);
        if bits << shift >> shift != bits || shift > 0 && byte == 0 {
            return None;
        }
        number |= bits << shift;
        if byte < 0x80 {
            return Some(number);
        }
        shift += 7;
        if shift >= u64::BITS {
            return None;
        }
    }
}

/// The file with this header and these sections.
pub fn write(header: &Header, sections: &[Vec<u8>]) -> Vec<u8> {
    let Header { program, clause, check, rule, claim, states } = header;
    let mut bytes = format!(
        "{FIRST}\nprogram {program}\nclause {clause}\ncheck {check}\nrule {rule}\nclaim {claim:032x}\nstates {states}\n"
    )
    .into_bytes();
    for section in sections {
        put(&mut bytes, section.len() as u64);
        bytes.extend_from_slice(section);
    }
    let digest = digest(&bytes);
    bytes.extend(digest.to_le_bytes());
    bytes
}

/// The file that these bytes are.
///
/// # Errors
/// [`Fault`] if they are none.
pub fn read(bytes: &[u8]) -> Result<File<'_>, Fault> {
    let first = format!("{FIRST}\n");
    if !bytes.starts_with(first.as_bytes()) {
        return Err(Fault::Foreign);
    }
    let (content, written) = bytes.split_last_chunk::<DIGEST>().ok_or(Fault::Damaged)?;
    let digest = digest(content);
    let mut rest = content.get(first.len()..).ok_or(Fault::Damaged)?;
    if digest.to_le_bytes() != *written {
        return Err(Fault::Damaged);
    }
    let mut number = 1;
    let mut line = |begin: &'static str| {
        number += 1;
        let fault = Fault::Line(number, begin);
        let end = rest.iter().take(MOST_LINE).position(|&byte| byte == b'\n').ok_or(fault)?;
        let text = std::str::from_utf8(&rest[..end]).map_err(|_| fault)?;
        rest = &rest[end + 1..];
        let value = text.strip_prefix(begin).and_then(|value| value.strip_prefix(' '));
        value.map(|value| (value, fault)).ok_or(fault)
    };
    let (program, _) = line("program")?;
    let (clause, _) = line("clause")?;
    let (check, no_check) = line("check")?;
    let (rule, _) = line("rule")?;
    let (claim, no_claim) = line("claim")?;
    let (states, no_states) = line("states")?;
    let header = Header {
        program: program.to_owned(),
        clause: clause.to_owned(),
        check: number_of(check).ok_or(no_check)?,
        rule: rule.to_owned(),
        claim: u128::from_str_radix(claim, 16)
            .ok()
            .filter(|digest| format!("{digest:032x}") == claim)
            .ok_or(no_claim)?,
        states: number_of(states).ok_or(no_states)?,
    };
    let mut sections = Vec::new();
    while !rest.is_empty() {
        let length =
            take(&mut rest).and_then(|length| usize::try_from(length).ok()).ok_or(Fault::Sections)?;
        sections.push(rest.split_off(..length).ok_or(Fault::Sections)?);
    }
    Ok(File { header, sections, digest })
}

/// The number that has been written like this.
fn number_of<N: FromStr + ToString>(text: &str) -> Option<N> {
    text.parse().ok().filter(|number: &N| number.to_string() == text)
}

/// Bytes of a line of the header, at most.
const MOST_LINE: usize = 1 << 10;
