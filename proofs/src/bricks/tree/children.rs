//! To which child an agent goes (BRICKS-13), whatever is beside its cell: in the areas that are searched no agent of
//! brick-tree ever has two children to choose from.

use tautline_kernel::bricks::tree::{Agent, Label, Note, State, View};
use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::floor::{COMPASS, Ring, Scan};
use tautline_kernel::ground::Side;

use super::TreeRule;
use super::demands::{LEAST_ENTERED, TravelRule, entered, goes_to_least_entered};
use crate::engine::{Outcome, require};

/// The situations that occur.
pub(crate) const COVERS: [&str; 4] =
    ["children entered alike", "children entered unlike", "elsewhere", "the only child"];

/// Whatever is beyond a side.
#[derive(Clone, Copy)]
enum Beyond {
    Wall,
    Unexplored,
    Explored,
    Visited,
    /// A cell of the same tree that is no child.
    Open,
    /// A child, and how many times it was entered.
    Child(u16),
}

const BEYOND: [Beyond; 9] = [
    Beyond::Wall,
    Beyond::Unexplored,
    Beyond::Explored,
    Beyond::Visited,
    Beyond::Open,
    Beyond::Child(1),
    Beyond::Child(2),
    Beyond::Child(3),
    Beyond::Child(4),
];

/// The bound of [`next`].
pub(crate) fn views() -> String {
    format!(
        "all {} views from the root of a tree: beside it walls, cells unexplored, explored, visited or of \
         its tree, and children entered 1 to 4 times",
        BEYOND.len().pow(4)
    )
}

/// The sensor beyond `side`, if no wall is there.
fn note(beyond: Beyond, side: Side) -> Option<Note> {
    let seen = |state| Note { state, crossings: 1, ..Note::default() };
    let open = |crossings| Note { crossings, ..Note::default() }.of_tree(Label::default(), None);
    match beyond {
        Beyond::Wall => None,
        Beyond::Unexplored => Some(Note::default()),
        Beyond::Explored => Some(seen(State::Explored)),
        Beyond::Visited => Some(seen(State::Visited)),
        Beyond::Open => Some(open(1)),
        Beyond::Child(crossings) => Some(Note { side: Some(side.opposite()), ..open(crossings) }),
    }
}

/// BRICKS-13: of the children that an agent sees it goes to one that was entered least, if it goes to one.
///
/// # Errors
/// [`crate::engine::Stop`] if the choices break the clause.
pub(crate) fn next(going: &TravelRule, oracle: &mut dyn Oracle) -> Outcome {
    let (mut scan, mut beside) = (Scan::default(), [Note::default(); 4]);
    for (place, side) in COMPASS.into_iter().enumerate() {
        let Some(note) = note(one_of(oracle, &BEYOND), side) else { continue };
        beside[place] = note;
        let seen = match note.state {
            State::Unexplored => &mut scan.unexplored,
            State::Explored | State::Open => &mut scan.explored,
            State::Visited => &mut scan.visited,
        };
        *seen = seen.or(Ring::of(side));
        scan.beside = scan.beside.or(Ring::of(side));
    }
    scan.open = scan.beside;
    let here = Note { crossings: 1, ..Note::default() }.of_tree(Label::default(), None);
    let view = View { here, scan, beside, known: scan.explored.or(scan.visited), doubted: Ring::default() };
    let act = going.decide(&mut Agent::new(0), &view);
    require(goes_to_least_entered(&view, act.next), LEAST_ENTERED)?;
    let goes_to_child = act.next.side().is_some_and(|side| entered(&view, side).is_some());
    let mut often = COMPASS.into_iter().filter_map(|side| entered(&view, side));
    Ok(COVERS[match (often.next().filter(|_| goes_to_child), often.next()) {
        (None, _) => 2,
        (Some(_), None) => 3,
        (Some(first), Some(second)) => usize::from(first != second || often.any(|other| other != first)),
    }])
}
