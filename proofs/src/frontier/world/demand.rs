//! Demands on a team at frontier cells.

/// A demand on a team.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Demand {
    /// FRONTIER-1: every cell in reach is explored in the end.
    Covers,
    /// FRONTIER-2: robots keep apart.
    Alone,
    /// FRONTIER-3: runs end.
    Ends,
    /// FRONTIER-4: robots know when nothing is left.
    Knows,
    /// FRONTIER-5: repositories are true.
    Marks,
    /// FRONTIER-13: no cell is explored twice.
    Once,
}

impl Demand {
    /// All of them, in the order of their clauses.
    pub const ALL: [Self; 6] = [Self::Covers, Self::Alone, Self::Ends, Self::Knows, Self::Marks, Self::Once];

    /// The clause that it is of.
    pub const fn clause(self) -> &'static str {
        match self {
            Self::Covers => "FRONTIER-1",
            Self::Alone => "FRONTIER-2",
            Self::Ends => "FRONTIER-3",
            Self::Knows => "FRONTIER-4",
            Self::Marks => "FRONTIER-5",
            Self::Once => "FRONTIER-13",
        }
    }

    /// The demand in words.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Covers => "every cell in reach is explored when the run ends",
            Self::Alone => "no two robots are in one cell",
            Self::Ends => "no run goes on for ever",
            Self::Knows => "every robot knows at the end that nothing is left",
            Self::Marks => "explored is where a robot was, and an obstacle is where one stands",
            Self::Once => "no robot enters a frontier cell that one has entered before",
        }
    }
}
