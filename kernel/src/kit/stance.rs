//! Where robots are on the lattice, and who is sure to hear whom (KIT-1, KIT-3). The unit is the path between two
//! nodes, 3 m; 10 m are between √11 and √12 of it, and no two nodes are √11 apart.

use crate::ground::{Cell, Circle, EdgeMark, Side};

/// A path that was seen free from one end to a robot at the other, and that nobody has driven. It is the third mark
/// that a grid has for edges; robots of a chain use it for virtual obstacles.
pub(super) const SEEN: EdgeMark = EdgeMark::Virtual;

/// How far robots hear each other.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Reach {
    /// The largest squared distance of two nodes in contact, in squared paths.
    squared: u8,
}

impl Reach {
    /// The paper's 10 m: (10 m / 3 m)² = 11.1.
    pub const PAPER: Self = Self { squared: 11 };

    /// The most paths that are planned for, 15 m.
    pub const MOST_PATHS: u16 = 5;

    /// So many paths, from two on: within one path no robot could drive.
    pub const fn of_paths(paths: u16) -> Option<Self> {
        match paths {
            2..=Self::MOST_PATHS => Some(Self { squared: (paths * paths) as u8 }),
            _ => None,
        }
    }

    /// The largest squared distance of two nodes in contact, in squared paths.
    pub const fn squared(self) -> u8 {
        self.squared
    }

    /// Whether robots at these nodes hear each other.
    pub const fn joins(self, one: Cell, other: Cell) -> bool {
        Circle::new(4 * self.squared as u64).reaches(one, other)
    }
}

/// Where a robot is.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Stance {
    /// At this node.
    Stands(Cell),
    /// Somewhere on the path between two neighbouring nodes.
    Drives {
        /// The node that it has left.
        from: Cell,
        /// The node where it will arrive.
        to: Cell,
    },
}

impl Stance {
    /// The node that it has left last, or where it stands.
    pub const fn from(self) -> Cell {
        match self {
            Self::Stands(at) => at,
            Self::Drives { from, .. } => from,
        }
    }

    /// The node where it will be next, or where it stands.
    pub const fn to(self) -> Cell {
        match self {
            Self::Stands(at) => at,
            Self::Drives { to, .. } => to,
        }
    }

    /// Whether it stands.
    pub const fn stands(self) -> bool {
        matches!(self, Self::Stands(_))
    }

    /// Whether `node` is one of its ends.
    pub fn has(self, node: Cell) -> bool {
        self.from() == node || self.to() == node
    }

    /// Whether robots with these stances hear each other within `reach` at whatever speeds they
    /// drive. Their distance is a convex function of how far each has come, so it is largest where
    /// both are at an end: the four corners decide.
    pub const fn is_sure_of(self, other: Self, reach: Reach) -> bool {
        reach.joins(self.from(), other.from())
            && reach.joins(self.from(), other.to())
            && reach.joins(self.to(), other.from())
            && reach.joins(self.to(), other.to())
    }

    /// Whether robots with these stances are at least one path, 3 m, apart at whatever speeds they drive: two paths of
    /// the lattice that have no end in common are.
    pub fn is_apart_from(self, other: Self) -> bool {
        !other.has(self.from()) && !other.has(self.to())
    }
}

/// Whether a robot that looks from a node through `side` sees another one within 3.5 m: always, never, or at some
/// speeds only. It sees as far as the next node and half a metre beyond.
pub fn touch(node: Cell, side: Side, other: Stance) -> Option<bool> {
    let ahead = node.beyond(side);
    let is_on_the_path = |end: Cell| end == node || end == ahead;
    match (is_on_the_path(other.from()), is_on_the_path(other.to())) {
        (true, true) => Some(other != Stance::Stands(node)),
        (true, false) | (false, true) if other.has(ahead) => None,
        (true, false) | (false, _) => Some(false),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HERE: Cell = Cell::new(0, 0);

    fn in_reach(one: Cell, other: Cell) -> bool {
        Reach::PAPER.joins(one, other)
    }

    #[test]
    fn ten_metres_are_three_paths_and_one_to_the_side() {
        assert!(in_reach(HERE, Cell::new(3, 1)) && in_reach(HERE, Cell::new(-2, 2)));
        assert!(!in_reach(HERE, Cell::new(3, 2)) && !in_reach(HERE, Cell::new(4, 0)));
        for (dx, dy) in (-5..=5).flat_map(|dx| (-5..=5).map(move |dy| (dx, dy))) {
            assert_eq!(in_reach(HERE, Cell::new(dx, dy)), 9 * (dx * dx + dy * dy) <= 100, "{dx} {dy}");
        }
        let (first, last) = (i16::MIN, i16::MAX);
        for far in [(last, first), (first, last), (last, last)] {
            assert!(!in_reach(Cell::new(first, first), Cell::new(far.0, far.1)));
        }
    }

    #[test]
    fn another_reach_is_two_to_five_paths() {
        let [two, three, five] = [2, 3, 5].map(|paths| Reach::of_paths(paths).expect("a reach"));
        assert!(two.joins(HERE, Cell::new(2, 0)) && !two.joins(HERE, Cell::new(2, 1)));
        assert!(three.joins(HERE, Cell::new(2, 2)) && !three.joins(HERE, Cell::new(3, 1)));
        assert!(five.joins(HERE, Cell::new(4, 3)) && !five.joins(HERE, Cell::new(5, 1)));
        assert_eq!([0, 1, 6, u16::MAX].map(Reach::of_paths), [None; 4]);
    }

    #[test]
    fn a_robot_ahead_is_seen_for_sure_only_on_the_path_ahead() {
        let ahead = Cell::new(1, 0);
        let seen = |from, to| touch(HERE, Side::East, Stance::Drives { from, to });
        assert_eq!(touch(HERE, Side::East, Stance::Stands(ahead)), Some(true));
        assert_eq!(seen(HERE, ahead), Some(true));
        assert_eq!(seen(ahead, HERE), Some(true));
        assert_eq!(seen(Cell::new(2, 0), ahead), None);
        assert_eq!(seen(HERE, Cell::new(0, 1)), Some(false));
        assert_eq!(seen(Cell::new(0, 1), Cell::new(1, 1)), Some(false));
    }
}
