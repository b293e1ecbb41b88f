//! The places in a paper whose words allow more than one reading. The rule that is called *published* takes one
//! interpretation at each; the other combinations are decided beside it.

use std::fmt;

/// How far an interpretation goes to make the paper's promise hold.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Charity {
    /// It takes the words to the letter, or fills a gap in the plainest way.
    Literal,
    /// The author has probably meant it.
    Probable,
    /// The promise has the best chance under it.
    Charitable,
}

/// One way to understand an ambiguity.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Interpretation {
    /// The name, in the name of each reading that takes it.
    pub name: &'static str,
    /// Its meaning, in one sentence.
    pub sentence: &'static str,
    /// How far it goes.
    pub charity: Charity,
}

impl Interpretation {
    /// It, by name, meaning and charity.
    pub const fn new(name: &'static str, sentence: &'static str, charity: Charity) -> Self {
        Self { name, sentence, charity }
    }
}

/// A place in a paper whose words allow more than one interpretation.
#[derive(Clone, Copy, Debug)]
pub struct Ambiguity {
    /// The paper's words, or that it says nothing.
    pub words: &'static str,
    /// The interpretations, first that of the published rule.
    pub interpretations: &'static [Interpretation],
}

impl Ambiguity {
    fn find(&self, name: &str) -> Option<&'static Interpretation> {
        self.interpretations.iter().find(|one| one.name == name)
    }
}

/// The ambiguities of a rule, and the rules that repair it.
#[derive(Clone, Copy, Debug)]
pub struct Paper {
    /// The ambiguities.
    pub ambiguities: &'static [Ambiguity],
    /// Pairs of interpretations that contradict each other, though they are not of one ambiguity.
    pub excluded: &'static [(&'static str, &'static str)],
    /// The names of the rules that are repairs of ours, and no reading.
    pub repairs: &'static [&'static str],
}

/// An interpretation with the words that it is about.
type Quote = (&'static str, &'static Interpretation);

/// Why no reading is what was asked for.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum ReadingError {
    /// An interpretation that there is not.
    Unknown {
        /// The name that was asked for.
        asked: String,
        /// All names.
        known: Vec<&'static str>,
    },
    /// Two that contradict each other.
    Contradiction(Quote, Quote),
}

impl fmt::Display for ReadingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown { asked, known } => {
                write!(f, "there is no reading {asked:?}: the readings are {}", known.join(", "))
            }
            Self::Contradiction((words, one), (others, other)) => write!(
                f,
                "{:?} and {:?} contradict each other: {words} means “{}”, {others} means “{}”",
                one.name, other.name, one.sentence, other.sentence
            ),
        }
    }
}

impl std::error::Error for ReadingError {}

/// The text between the interpretations in the name of a reading.
const AND: &str = " + ";

/// The name of the reading that takes the first interpretation of each ambiguity.
pub const PUBLISHED: &str = "published";

impl Paper {
    /// The reading with these interpretations and, of each ambiguity of which there is none, the first: its name.
    ///
    /// # Errors
    /// [`ReadingError`] if there is no such interpretation, or if two contradict each other.
    pub fn reading(&self, asked: &[&str]) -> Result<String, ReadingError> {
        let mut taken: Vec<Option<Quote>> = vec![None; self.ambiguities.len()];
        for &name in asked {
            let found = self
                .ambiguities
                .iter()
                .zip(&mut taken)
                .find_map(|(ambiguity, taken)| Some(((ambiguity.words, ambiguity.find(name)?), taken)));
            let Some((quoted, taken)) = found else {
                let known = self.ambiguities.iter().flat_map(|one| one.interpretations);
                let known = known.map(|one| one.name).collect();
                return Err(ReadingError::Unknown { asked: name.to_owned(), known });
            };
            if let Some(before) = taken.replace(quoted).filter(|before| *before != quoted) {
                return Err(ReadingError::Contradiction(before, quoted));
            }
        }
        let first = |(ambiguity, taken): (&Ambiguity, Option<Quote>)| {
            taken.or_else(|| Some((ambiguity.words, ambiguity.interpretations.first()?)))
        };
        let all: Vec<Quote> = self.ambiguities.iter().zip(taken).filter_map(first).collect();
        let find = |name: &str| all.iter().copied().find(|(_, one)| one.name == name);
        for &(one, other) in self.excluded {
            if let (Some(one), Some(other)) = (find(one), find(other)) {
                return Err(ReadingError::Contradiction(one, other));
            }
        }
        let others = self
            .ambiguities
            .iter()
            .zip(&all)
            .filter(|(place, (_, one))| place.interpretations.first() != Some(*one));
        let names: Vec<&str> = others.map(|(_, (_, one))| one.name).collect();
        Ok(if names.is_empty() { PUBLISHED.to_owned() } else { names.join(AND) })
    }

    /// The names of all readings, the published one first.
    pub fn readings(&self) -> Vec<String> {
        let mut asked: Vec<Vec<&str>> = vec![Vec::new()];
        for ambiguity in self.ambiguities {
            let with = |before: &Vec<&'static str>| {
                let before = before.clone();
                ambiguity.interpretations.iter().map(move |one| [before.as_slice(), &[one.name]].concat())
            };
            asked = asked.iter().flat_map(with).collect();
        }
        asked.iter().filter_map(|names| self.reading(names).ok()).collect()
    }

    /// The interpretations that the reading of this name takes.
    fn taken(&self, reading: &str) -> impl Iterator<Item = &'static Interpretation> {
        self.ambiguities.iter().filter_map(move |ambiguity| {
            let named = reading.split(AND).find_map(|name| ambiguity.find(name));
            named.or(ambiguity.interpretations.first())
        })
    }

    /// The interpretation that `some` of these readings take and none of the `others`, if there is one.
    pub fn dividing(&self, some: &[&str], others: &[&str]) -> Option<&'static Interpretation> {
        let takes = |reading: &str, one: &Interpretation| self.taken(reading).any(|taken| *taken == *one);
        let divides = |&one: &&Interpretation| {
            some.iter().all(|reading| takes(reading, one))
                && !others.iter().any(|reading| takes(reading, one))
        };
        self.ambiguities.iter().flat_map(|ambiguity| ambiguity.interpretations).find(divides)
    }

    /// How charitable the reading of this name is, the more the greater: at how many ambiguities it takes a charitable
    /// interpretation, and at how many a probable one.
    pub fn charity(&self, reading: &str) -> (usize, usize) {
        let count = |wanted| self.taken(reading).filter(|one| one.charity == wanted).count();
        (count(Charity::Charitable), count(Charity::Probable))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAPER: Paper = Paper {
        ambiguities: &[
            Ambiguity {
                words: "“selects a robot”",
                interpretations: &[
                    Interpretation::new("anew", "it selects at each message", Charity::Literal),
                    Interpretation::new("window", "it selects when a window closes", Charity::Charitable),
                ],
            },
            Ambiguity {
                words: "“answers all”",
                interpretations: &[
                    Interpretation::new("once", "later messages have no answer", Charity::Literal),
                    Interpretation::new("answered", "later messages have one", Charity::Probable),
                ],
            },
        ],
        excluded: &[("anew", "answered")],
        repairs: &[],
    };

    #[test]
    fn a_reading_is_named_by_what_sets_it_apart() {
        assert_eq!(PAPER.readings(), ["published", "window", "window + answered"]);
        assert_eq!(PAPER.reading(&["answered", "window"]).as_deref(), Ok("window + answered"));
        assert_eq!(PAPER.charity("published"), (0, 0));
        assert!(PAPER.charity("window") < PAPER.charity("window + answered"));
        let dividing = |some: &[&str], others: &[&str]| PAPER.dividing(some, others).map(|one| one.name);
        assert_eq!(dividing(&["published"], &["window", "window + answered"]), Some("anew"));
        assert_eq!(dividing(&["window", "window + answered"], &["published"]), Some("window"));
        assert_eq!(dividing(&["published", "window + answered"], &["window"]), None);
    }

    #[test]
    fn a_contradiction_is_refused_with_both_sentences_and_an_unknown_name_with_the_list() {
        let refused = |asked: &[&str]| PAPER.reading(asked).expect_err("no such reading").to_string();
        assert_eq!(
            refused(&["late"]),
            r#"there is no reading "late": the readings are anew, window, once, answered"#
        );
        assert_eq!(
            refused(&["anew", "window"]),
            "\"anew\" and \"window\" contradict each other: “selects a robot” means “it selects at each message”, \
             “selects a robot” means “it selects when a window closes”"
        );
        assert_eq!(
            refused(&["answered"]),
            "\"anew\" and \"answered\" contradict each other: “selects a robot” means “it selects at each message”, \
             “answers all” means “later messages have one”"
        );
    }
}
