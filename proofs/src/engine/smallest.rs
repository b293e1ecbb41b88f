//! The smallest counterexample over everything: in the fewest cells, of these with the fewest barriers, which are walls
//! or blocked cells, of these with the fewest robots, and of these in the fewest moves. A certificate lists all that is
//! smaller: it was exhausted.
//!
//! An area and the same one turned are two: where ties have an order, robots do otherwise in the other.

use std::fmt;
use std::ops::RangeInclusive;

use tautline_kernel::ground::{Area, Cell};

use super::Until;
use crate::plural::counted;

/// Columns and rows of all areas with so many cells, the flattest first.
pub fn areas_of(cells: u32) -> impl Iterator<Item = Area> {
    let sizes = (1..=cells).filter(move |rows| cells.is_multiple_of(*rows));
    sizes.filter_map(move |rows| {
        let (columns, rows) = (i16::try_from(cells / rows).ok()?, i16::try_from(rows).ok()?);
        Area::new(Cell::new(0, 0), Cell::new(columns - 1, rows - 1))
    })
}

/// Teams of so many robots in all layouts of an area with at most so many barriers.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Class {
    /// The area.
    pub area: Area,
    /// Walls or blocked cells at most.
    pub barriers: u32,
    /// Robots.
    pub robots: usize,
}

impl Class {
    /// Columns and rows.
    pub const fn size(&self) -> (i16, i16) {
        (self.area.width() as i16, self.area.height() as i16)
    }
}

/// The findings in a class.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ClassFindings<F> {
    /// Runs or states; none if there is no such team.
    pub cases: u64,
    /// Whether all were looked at, or enough to know the shortest counterexample.
    pub is_whole: bool,
    /// The shortest counterexample, and its moves.
    pub shortest: Option<(usize, F)>,
}

impl<F> Default for ClassFindings<F> {
    fn default() -> Self {
        Self { cases: 0, is_whole: true, shortest: None }
    }
}

impl<F> ClassFindings<F> {
    /// Adds what is found elsewhere in the class; of equally short counterexamples the first counts.
    pub fn add(&mut self, other: Self) {
        self.cases += other.cases;
        self.is_whole &= other.is_whole;
        let is_shorter =
            |(moves, _): &(usize, F)| self.shortest.as_ref().is_none_or(|known| *moves < known.0);
        if let Some(shorter) = other.shortest.filter(is_shorter) {
            self.shortest = Some(shorter);
        }
    }
}

/// The largest classes that are looked at.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Most {
    /// Cells.
    pub cells: u32,
    /// Walls or blocked cells.
    pub barriers: u32,
    /// Robots, from the fewest on.
    pub robots: RangeInclusive<usize>,
}

/// The smallest counterexample.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Smallest<K, F> {
    /// Its class.
    pub class: K,
    /// Its moves.
    pub moves: usize,
    /// The counterexample.
    pub found: F,
}

/// The smallest counterexample, and all that was looked at.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Certificate<K, F> {
    /// The classes in which there is none, each with its cases.
    pub exhausted: Vec<(K, u64)>,
    /// Whether nothing was cut off.
    pub is_whole: bool,
    /// The smallest counterexample, if there is one.
    pub smallest: Option<Smallest<K, F>>,
}

impl<K, F> Default for Certificate<K, F> {
    fn default() -> Self {
        Self { exhausted: Vec::new(), is_whole: true, smallest: None }
    }
}

/// The smallest counterexample that `search` finds in an area within `most`. Until a violation any one is enough, else
/// the shortest is sought.
///
/// # Errors
/// Whatever `search` returns.
pub fn smallest<F, E>(
    most: &Most,
    mut search: impl FnMut(Class, Until) -> Result<ClassFindings<F>, E>,
) -> Result<Certificate<Class, F>, E> {
    let mut made = Certificate::default();
    let level = |cells, barriers, robots| areas_of(cells).map(move |area| Class { area, barriers, robots });
    for cells in 1..=most.cells {
        // As long as there is none in these cells at all, barriers and robots need no order.
        let mut all = Certificate::default();
        for robots in most.robots.clone() {
            all.look(level(cells, most.barriers, robots), &mut |class| search(class, Until::Violation))?;
        }
        if all.smallest.is_none() {
            made.exhausted.append(&mut all.exhausted);
            made.is_whole &= all.is_whole;
            continue;
        }
        for (barriers, robots) in
            (0..=most.barriers).flat_map(|one| most.robots.clone().map(move |robots| (one, robots)))
        {
            made.look(level(cells, barriers, robots), &mut |class| search(class, Until::Exhausted))?;
            if made.smallest.is_some() {
                return Ok(made);
            }
        }
    }
    Ok(made)
}

impl<K: Copy, F> Certificate<K, F> {
    /// The smallest counterexample that `search` finds in classes of which each is larger than the one before.
    ///
    /// # Errors
    /// Whatever `search` returns.
    pub fn in_order<E>(
        classes: impl IntoIterator<Item = K>,
        mut search: impl FnMut(K) -> Result<ClassFindings<F>, E>,
    ) -> Result<Self, E> {
        let mut made = Self::default();
        for class in classes {
            made.look([class], &mut search)?;
            if made.smallest.is_some() {
                break;
            }
        }
        Ok(made)
    }

    /// Looks at classes of which none is smaller than another: the shortest counterexample in them is the smallest.
    ///
    /// # Errors
    /// Whatever `search` returns.
    pub fn look<E>(
        &mut self,
        classes: impl IntoIterator<Item = K>,
        search: &mut impl FnMut(K) -> Result<ClassFindings<F>, E>,
    ) -> Result<(), E> {
        for class in classes {
            let ClassFindings { cases, is_whole, shortest } = search(class)?;
            self.is_whole &= is_whole;
            match shortest {
                Some((moves, found)) if self.smallest.as_ref().is_none_or(|best| moves < best.moves) => {
                    self.smallest = Some(Smallest { class, moves, found });
                }
                None if cases > 0 => self.exhausted.push((class, cases)),
                Some(_) | None => {}
            }
        }
        Ok(())
    }
}

impl<K: fmt::Display, F> Certificate<K, F> {
    /// The certificate with its classes in words, and its counterexample drawn.
    pub fn drawn(self, draw: impl FnOnce(F) -> String) -> Certificate<String, String> {
        let Self { exhausted, is_whole, smallest } = self;
        let exhausted = exhausted.into_iter().map(|(class, cases)| (class.to_string(), cases)).collect();
        let smallest = smallest.map(|Smallest { class, moves, found }| Smallest {
            class: class.to_string(),
            moves,
            found: draw(found),
        });
        Certificate { exhausted, is_whole, smallest }
    }
}

impl<F> Certificate<Class, F> {
    /// As [`Certificate::drawn`], the classes with as many cells and barriers together.
    pub fn drawn_by_cells(self, draw: impl FnOnce(F) -> String) -> Certificate<String, String> {
        let size = |class: &Class| (class.area.width() * class.area.height(), class.barriers);
        let groups = self.exhausted.chunk_by(|(one, _), (other, _)| size(one) == size(other));
        let group = |group: &[(Class, u64)]| {
            let (cells, barriers) = size(&group[0].0);
            let least = group.iter().map(|(class, _)| class.robots).min().unwrap_or(0);
            let most = group.iter().map(|(class, _)| class.robots).max().unwrap_or(0);
            let robots =
                if least == most { counted(most, "robot") } else { format!("{least} to {most} robots") };
            let (cells, barriers) = (counted(cells, "cell"), counted(barriers, "barrier"));
            (format!("{cells}, at most {barriers}, {robots}"), group.iter().map(|(_, cases)| cases).sum())
        };
        let exhausted = groups.map(group).collect();
        Certificate { exhausted, ..self.drawn(draw) }
    }
}

impl<K: fmt::Display, F> Certificate<K, F> {
    /// The size of the smallest counterexample, in words.
    pub fn size(&self) -> String {
        match &self.smallest {
            Some(Smallest { class, moves, .. }) => format!("{class}, {}", counted(*moves, "move")),
            None => "none".to_owned(),
        }
    }
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ((columns, rows), robots) = (self.size(), counted(self.robots, "robot"));
        write!(f, "{columns}×{rows}, {}, {robots}", counted(self.barriers, "barrier"))
    }
}

/// A line for each class that was exhausted, with its cases.
impl<K: fmt::Display, F> fmt::Display for Certificate<K, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.exhausted.iter().try_for_each(|(class, cases)| writeln!(f, "{class}: {cases}"))
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    /// Three robots break something in 2×3 and 3×2 with a barrier, sooner in the former; four do without one, in 6×1.
    #[expect(clippy::unnecessary_wraps, reason = "a search may fail")]
    fn search(class: Class, _: Until) -> Result<ClassFindings<&'static str>, Infallible> {
        let shortest = match (class.size(), class.robots, class.barriers) {
            ((6, 1), 4, _) => Some((9, "four")),
            ((3, 2), 3, 1..) => Some((5, "wide")),
            ((2, 3), 3, 1..) => Some((4, "high")),
            _ => None,
        };
        Ok(ClassFindings { cases: 1, is_whole: true, shortest })
    }

    #[test]
    fn cells_come_before_barriers_before_robots_before_moves() {
        let found = |robots, barriers| {
            let Ok(found) = smallest(&Most { cells: 7, barriers, robots }, search);
            (found.smallest.map(|one| one.found), found.exhausted.len())
        };
        // Ten areas of up to five cells; then four of six cells with each number of robots and barriers.
        assert_eq!(found(2..=3, 1), (Some("high"), 2 * 10 + 2 * 4 + 4 + 2));
        assert_eq!(found(2..=4, 1), (Some("four"), 3 * 10 + 2 * 4 + 3));
        assert_eq!(found(2..=2, 1), (None, 16));
    }
}
