//! Values that a person chooses by a word, on the command line and in a file.

/// Values that have words.
pub trait NamedValues: Copy + PartialEq + 'static {
    /// Each value, its word, and one line about it.
    const WORDS: &'static [(Self, &'static str, &'static str)];

    /// The word for this value.
    fn word(self) -> &'static str {
        Self::WORDS.iter().find(|(value, ..)| *value == self).map_or("", |(_, word, _)| word)
    }

    /// The value with this word.
    fn of(word: &str) -> Option<Self> {
        Self::WORDS.iter().find(|(_, known, _)| *known == word).map(|&(value, ..)| value)
    }
}
