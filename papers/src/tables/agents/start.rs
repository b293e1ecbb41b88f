//! The cells in which agents start, of which the paper says nothing.

use tautline_kernel::ground::Cell;

use super::super::prelude::*;
use tautline_grids::chance::Dice;
use tautline_io::named_values::NamedValues;

/// The way in which a team starts in a layout.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Start {
    /// All agents in the free cell nearest the centre.
    Centre,
    /// Each agent in a cell of its own, drawn by the seed.
    Apart,
    /// All agents in the free cell nearest the middle of the northern side, as behind a door.
    Edge,
}

impl NamedValues for Start {
    const WORDS: &'static [(Self, &'static str, &'static str)] = &[
        (Self::Centre, "centre", "All in the free cell nearest the centre"),
        (Self::Apart, "apart", "Each in a cell of its own, drawn by the seed"),
        (Self::Edge, "edge", "All in the free cell nearest the middle of the northern side"),
    ];
}

impl Start {
    /// The cells of so many agents, all in the part of `layout` in which the free cell nearest the centre is.
    ///
    /// # Errors
    /// [`Halt`] when no cell is free, or that part has fewer cells than agents that start [`Start::Apart`].
    pub(super) fn cells(self, layout: &Layout, agents: u16, seed: u64) -> Result<Vec<Cell>, Halt> {
        let centre = layout.default_base()?;
        let part = || layout.reachable(&[centre]);
        let from_door = |cell: &Cell| {
            let (x, y) = (2 * i64::from(cell.x) - i64::from(layout.width()) + 1, 2 * i64::from(cell.y));
            x * x + y * y
        };
        let all_in = |cell| vec![cell; agents.into()];
        match self {
            Self::Centre => Ok(all_in(centre)),
            Self::Edge => Ok(all_in(part().into_iter().min_by_key(from_door).unwrap_or(centre))),
            Self::Apart => {
                let (mut part, mut dice) = (part(), Dice::new(seed, *b"starts  "));
                if part.len() < agents.into() {
                    let what =
                        format!("{agents} agents have no cells of their own: there are {}", part.len());
                    return Err(Diagnostic::usage(what, "let fewer agents start").into());
                }
                let draw = |_| part.swap_remove(dice.below(part.len() as u64) as usize);
                Ok((0..agents).map(draw).collect())
            }
        }
    }

    /// A line about it in the text of a figure, where it is not the default.
    pub(super) const fn line(self) -> &'static str {
        match self {
            Self::Centre => "",
            Self::Apart => "Each agent starts in a cell of its own\n",
            Self::Edge => "All agents start in the cell nearest the middle of the northern side\n",
        }
    }

    /// Whether it is the default, which no output names.
    pub(super) const fn is_default(&self) -> bool {
        matches!(self, Self::Centre)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// A layout in two parts, the smaller one in the north.
    fn in_two_parts() -> Layout {
        let layout = Layout::open(6, 7).expect("a layout");
        layout.with_blocked((0..6).map(|x| Cell::new(x, 1)))
    }

    #[test]
    fn agents_that_start_apart_have_cells_of_their_own_in_the_part_of_the_centre() {
        let layout = in_two_parts();
        let part = layout.reachable(&[layout.default_base().expect("a free cell")]);
        assert_eq!(part.len(), 30);
        let starts = |agents, seed| Start::Apart.cells(&layout, agents, seed).expect("cells");
        for (agents, seed) in pairs([1, 7, 30], 0..20) {
            let cells: BTreeSet<Cell> = starts(agents, seed).into_iter().collect();
            assert_eq!(cells.len(), usize::from(agents));
            assert!(cells.iter().all(|cell| part.contains(cell)), "{cells:?}");
        }
        assert_eq!(starts(7, 3), starts(7, 3));
        assert_ne!(starts(7, 3), starts(7, 4));
        assert!(Start::Apart.cells(&layout, 31, 0).is_err());
    }

    #[test]
    fn all_agents_start_in_one_cell_of_the_part_of_the_centre_if_not_apart() {
        let layout = in_two_parts();
        let starts = |start: Start| start.cells(&layout, 3, 0).expect("cells");
        assert_eq!(starts(Start::Centre), [layout.default_base().expect("a free cell"); 3]);
        assert_eq!(starts(Start::Edge), [Cell::new(2, 2); 3]);
    }
}
