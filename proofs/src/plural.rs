//! Words for numbers.

use std::fmt::Display;

/// A number of things, by the word for one of them: `1 wall`, `2 walls`, `3 topologies`.
pub fn counted<N: Copy + Display + PartialEq + From<u8>>(count: N, one: &str) -> String {
    if count == N::from(1) {
        return format!("{count} {one}");
    }
    match one.strip_suffix("gy") {
        Some(stem) => format!("{count} {stem}gies"),
        None => format!("{count} {one}s"),
    }
}

/// Things one after the other.
pub fn listed<T: ToString>(things: impl IntoIterator<Item = T>) -> String {
    things.into_iter().map(|thing| thing.to_string()).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_thing_is_no_things() {
        let words = [0_u64, 1, 2].map(|count| counted(count, "team move"));
        assert_eq!(words, ["0 team moves", "1 team move", "2 team moves"]);
        assert_eq!([1_u32, 5].map(|count| counted(count, "topology")), ["1 topology", "5 topologies"]);
    }
}
