//! Certificates of checks that search all states or all layouts: which check a file
//! is about, and the sections of its systems.

use std::fmt;

use tautline_certificates::{Counts, Fault, File, Header, Refusal, digest, read, write};

use crate::clause::Clause;
use crate::decide::MethodError;
use crate::engine::states::Limits;
use crate::engine::threads;

/// The program that writes certificates.
const PROGRAM: &str = concat!("tautline ", env!("CARGO_PKG_VERSION"));

/// Why a file is no certificate of a check of ours.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Misfit {
    /// It is none at all.
    File(Fault),
    /// Another program wrote it.
    Program(String),
    /// There is no such clause.
    Clause(String),
    /// The clause has no check with this number.
    Check(String, usize),
    /// The check is about another rule than the certificate.
    Rule {
        /// The rule of the certificate.
        said: String,
        /// That of the check.
        found: &'static str,
    },
    /// It claims something else of the clause than the check does.
    Claim,
    /// Its states are not as many as it says, or its sections not as many as the systems.
    Count,
    /// The check has no systems.
    Method(MethodError),
}

impl fmt::Display for Misfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(fault) => write!(f, "it is no certificate: {fault}"),
            Self::Program(said) => write!(f, "it is a certificate of {said:?}, and this is {PROGRAM}"),
            Self::Clause(said) => {
                write!(f, "it is a certificate of the clause {said:?}, which is not known here")
            }
            Self::Check(clause, number) => {
                write!(f, "it is a certificate of check {number} of {clause}, which it has not")
            }
            Self::Rule { said, found } => {
                write!(f, "it is a certificate of the rule {said:?}, and the check is about {found:?}")
            }
            Self::Claim => {
                f.write_str("it claims something else than the check: its sentence, bound or engine differs")
            }
            Self::Count => f.write_str("it has not as many states, or sections, as it should"),
            Self::Method(why) => write!(f, "its check has no certificate: {why}"),
        }
    }
}

impl std::error::Error for Misfit {}

/// The judgement of a certificate of a check of ours.
#[derive(Debug)]
pub struct Examination {
    /// The clause.
    pub clause: &'static Clause,
    /// The number of the check among those of the clause.
    pub number: usize,
    /// The number of systems.
    pub systems: usize,
    /// All that it has; or the first section that is refused, from 1, and why.
    pub outcome: Result<Counts, (usize, Refusal)>,
}

/// The claim of a check, by a digest: its clause, rule, engine and bound.
fn claim(clause: &Clause, number: usize) -> u128 {
    let check = clause.checks[number];
    let (rule, engine, bound) = (check.rule(), check.engine(), check.bound());
    digest(format!("{:?}", (clause.id, clause.sentence, number, rule, engine, bound)).as_bytes())
}

/// The certificate of the check of `clause` with this number, from 0 on, which holds.
///
/// # Errors
/// [`MethodError`] if there is no such check, if it is none that searches all states or layouts, or finds something
/// broken, or too much within `limits`.
pub fn certificate(clause: &Clause, number: usize, limits: Limits<'_>) -> Result<Vec<u8>, MethodError> {
    let none = || MethodError::new(format_args!("{} has no check {number}, counted from 0", clause.id));
    let check = clause.checks.get(number).ok_or_else(none)?;
    let systems = check.systems()?;
    let sections = threads::each(&systems, |system| system.exhausted(limits));
    let sections = sections.into_iter().collect::<Result<Vec<_>, _>>().map_err(MethodError::new)?;
    let (sections, states): (Vec<Vec<u8>>, Vec<u64>) = sections.into_iter().unzip();
    let header = Header {
        program: PROGRAM.to_owned(),
        clause: clause.id.to_owned(),
        check: number,
        rule: check.rule().to_owned(),
        claim: claim(clause, number),
        states: states.into_iter().sum(),
    };
    Ok(write(&header, &sections))
}

/// Examines a certificate of one of these clauses.
///
/// # Errors
/// [`Misfit`] if it is none.
pub fn examine(
    bytes: &[u8],
    clauses: impl IntoIterator<Item = &'static Clause>,
) -> Result<Examination, Misfit> {
    let File { header, sections, digest } = read(bytes).map_err(Misfit::File)?;
    let Header { program, clause: id, check: number, rule, claim: claimed, states } = header;
    if program != PROGRAM {
        return Err(Misfit::Program(program));
    }
    let named: Vec<&Clause> = clauses.into_iter().filter(|clause| clause.id == id).collect();
    let mut with_check = named.iter().copied().filter(|clause| number < clause.checks.len()).peekable();
    let first = match (with_check.peek(), named.is_empty()) {
        (Some(first), _) => *first,
        (None, true) => return Err(Misfit::Clause(id)),
        (None, false) => return Err(Misfit::Check(id, number)),
    };
    // A clause may stand there twice, within other bounds.
    let is_it = |clause: &&Clause| claim(clause, number) == claimed && clause.checks[number].rule() == rule;
    let clause = with_check.find(is_it);
    let clause = clause.ok_or_else(|| match first.checks[number].rule() {
        found if found == rule => Misfit::Claim,
        found => Misfit::Rule { said: rule, found },
    })?;
    let systems = clause.checks[number].systems().map_err(Misfit::Method)?;
    if systems.len() != sections.len() {
        return Err(Misfit::Count);
    }
    let pairs = systems.iter().zip(&sections);
    let checked = threads::each(pairs, |(system, section)| system.check(section, digest));
    let mut outcome = Ok(Counts::default());
    for (number, counts) in (1..).zip(checked) {
        outcome = outcome.and_then(|all: Counts| Ok(all.with(counts.map_err(|refusal| (number, refusal))?)));
    }
    if outcome.as_ref().is_ok_and(|counts| counts.states != states) {
        return Err(Misfit::Count);
    }
    Ok(Examination { clause, number, systems: systems.len(), outcome })
}
