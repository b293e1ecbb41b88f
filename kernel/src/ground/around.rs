//! The steps of a robot by where they lead: into a circle round another cell, or beside it. For the circles of the
//! paper they stand in tables by the offset of the two cells, since planning asks for them all the time.

use super::{Cell, Circle, Step, Steps};

impl Circle {
    /// The steps from `at` that lead to a cell which lies wholly inside the circle round the centre of `round`.
    #[cold]
    const fn steps(self, round: Cell, at: Cell) -> Steps {
        let mut steps = Steps::NONE;
        let mut place = 0;
        while place < Step::ALL.len() {
            if self.covers(round, at.after(Step::ALL[place])) {
                steps = steps.with(Step::ALL[place]);
            }
            place += 1;
        }
        steps
    }
}

/// By offset, from −4 to 3 columns and rows: the steps from there that lead into a circle round 0,0.
struct Table([Steps; 64]);

impl Table {
    const fn of(circle: Circle) -> Self {
        let mut table = Self([Steps::NONE; 64]);
        let mut place = 0;
        while place < table.0.len() {
            let at = Cell::new((place % 8) as i16 - 4, (place / 8) as i16 - 4);
            table.0[place] = circle.steps(Cell::new(0, 0), at);
            place += 1;
        }
        table
    }

    /// The steps from `at` into the circle round `round`; `None` if they are too far apart to stand here.
    #[inline]
    const fn get(&self, round: Cell, at: Cell) -> Option<Steps> {
        let column = (at.x as i32 - round.x as i32 + 4) as u32;
        let row = (at.y as i32 - round.y as i32 + 4) as u32;
        if column | row < 8 { Some(self.0[(row << 3 | column) as usize]) } else { None }
    }
}

static SAFE: Table = Table::of(Circle::SAFE);
static COVERED: Table = Table::of(Circle::COVERED);
/// E_N is what lies wholly inside the circle of radius √10/2, and the cell itself what does inside that of √2/2.
static BESIDE: Table = Table::of(Circle::new(10));
static ONTO: Table = Table::of(Circle::new(2));

impl Circle {
    /// The steps from `at` that lead to a cell which lies wholly inside the circle round the centre of `round`.
    #[inline]
    pub fn covered_steps(self, round: Cell, at: Cell) -> Steps {
        let known = match self {
            Self::SAFE => SAFE.get(round, at),
            Self::COVERED => COVERED.get(round, at),
            _ => None,
        };
        known.unwrap_or_else(|| self.steps(round, at))
    }
}

/// The steps from `at` that lead into E_N(`to`).
#[inline]
pub fn neighbouring_steps(to: Cell, at: Cell) -> Steps {
    BESIDE.get(to, at).unwrap_or(Steps::NONE)
}

/// The step from `at` that leads to the cell `to`, if there is one.
#[inline]
pub fn steps_to(to: Cell, at: Cell) -> Steps {
    ONTO.get(to, at).unwrap_or(Steps::NONE)
}

#[cfg(test)]
mod tests {
    use super::super::neighbours;
    use super::*;

    const CIRCLES: [Circle; 3] = [Circle::SAFE, Circle::COVERED, Circle::new(34)];

    #[test]
    fn tables_say_of_every_step_what_the_circles_say_of_its_cell() {
        let round = Cell::new(-3, 20);
        for (dx, dy) in (-6..=6).flat_map(|dx| (-6..=6).map(move |dy| (dx, dy))) {
            let at = Cell::new(round.x + dx, round.y + dy);
            for circle in CIRCLES {
                let covered = Steps::ALL.filter(|step| circle.covers(round, at.after(step)));
                assert_eq!(circle.covered_steps(round, at), covered, "{circle:?} {at}");
            }
            let beside = Steps::ALL.filter(|step| neighbours(round, at.after(step)));
            assert_eq!(neighbouring_steps(round, at), beside, "{at}");
            let onto = Steps::ALL.filter(|step| at.after(step) == round);
            assert_eq!(steps_to(round, at), onto, "{at}");
        }
    }

    #[test]
    fn cells_at_opposite_rims_are_far_apart() {
        let (west, east) = (Cell::new(i16::MIN, 0), Cell::new(i16::MAX, 0));
        assert!(Circle::COVERED.covered_steps(west, east).is_empty());
        assert!(neighbouring_steps(east, west).is_empty());
    }
}
