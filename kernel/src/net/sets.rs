//! Sets of robots, and which of them hang together.

/// Robots, a bit for each.
pub(crate) type Set = u32;

/// So many robots, from the first one on.
pub(crate) const fn first_robots(robots: usize) -> Set {
    (1_u64 << robots).wrapping_sub(1) as Set
}

/// The sets into which `all` fall, two being together if they are `linked` directly or over others; the rest are empty.
pub(crate) fn sets<const ROBOTS: usize>(all: Set, linked: impl Fn(usize, usize) -> bool) -> [Set; ROBOTS] {
    let mut sets = [0; ROBOTS];
    let mut rest = all;
    for set in &mut sets {
        let mut new = rest & rest.wrapping_neg();
        while new != 0 {
            let one = new.trailing_zeros() as usize;
            new &= new.wrapping_sub(1);
            *set |= 1 << one;
            rest &= !(1 << one);
            for other in robots(rest & !new) {
                new |= Set::from(linked(one, other)) << other;
            }
        }
    }
    sets
}

/// The numbers of the robots of a set.
pub(crate) fn robots(set: Set) -> impl Iterator<Item = usize> {
    let mut rest = set;
    core::iter::from_fn(move || {
        let robot = rest.trailing_zeros() as usize;
        rest &= rest.wrapping_sub(1);
        (robot < Set::BITS as usize).then_some(robot)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn robots_fall_into_sets_of_those_that_are_linked() {
        let linked = |one: usize, other: usize| one.abs_diff(other) == 2;
        assert_eq!(sets::<5>(0b11111, linked), [0b10101, 0b01010, 0, 0, 0]);
        assert_eq!(sets::<5>(0b11011, linked), [0b00001, 0b01010, 0b10000, 0, 0]);
        assert_eq!([0, 1, 32].map(first_robots), [0, 1, Set::MAX]);
    }
}
