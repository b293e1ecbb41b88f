//! The clauses that positions decide, and why they do not decide others.

/// A kind of clause, by what it demands of positions.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// Robots whose numbers follow each other are within range.
    Neighbours,
    /// Two robots hear each other.
    Pair,
    /// All robots hear each other, directly or over others, from the start on.
    Joined,
    /// Robots that have left their starts are apart.
    Apart,
    /// No more than so many robots are in a cell.
    Crowd {
        /// So many.
        most: u32,
        /// Whether the cell in which the first robot starts may have more.
        is_base_free: bool,
    },
    /// Each cell that robots can reach was visited.
    Visited,
}

/// The clauses that can be judged, by their ids in SPEC.md.
pub const CLAUSES: [(&str, Kind); 8] = [
    ("CHAIN-2", Kind::Crowd { most: 2, is_base_free: true }),
    ("CHAIN-3", Kind::Neighbours),
    ("KIT-1", Kind::Pair),
    ("KIT-3", Kind::Apart),
    ("KIT-12", Kind::Joined),
    ("FRONTIER-1", Kind::Visited),
    ("FRONTIER-2", Kind::Crowd { most: 1, is_base_free: false }),
    ("PACK-2", Kind::Crowd { most: 1, is_base_free: false }),
];

/// The reason why positions do not decide a clause of this id.
pub fn not_judged(id: &str) -> &'static str {
    match id {
        "CHAIN-1" | "PACK-1" => {
            "it speaks of the moments after team moves, and a log of positions does not say when these are"
        }
        "CHAIN-13" | "CHAIN-14" => {
            "it speaks of cells that a chain of robots can reach, which takes a search and not a log"
        }
        "KIT-2" => "it speaks of robots that drive at equal speeds; KIT-1 speaks of any",
        "KIT-8" | "KIT-13" => "it speaks of sides that robots have seen blocked and of what they know",
        "PACK-3" | "PACK-5" => "it speaks of cells that robots have seen",
        _ => "it speaks of more than where robots are",
    }
}
