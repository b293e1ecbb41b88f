//! The children of a cell tell of a sensor that has been placed in the stead of another one, and maps that are joined
//! keep what they had.

use std::collections::BTreeMap;

use tautline_kernel::bricks::tree::{Agent, Condition, Label, Next, Note, Rule, View};
use tautline_kernel::choice::Oracle;
use tautline_kernel::floor::{self, COMPASS};
use tautline_kernel::frontier::{Map, Status, TinyMap};
use tautline_kernel::ground::{Area, Cell, Edge, Side};

use crate::numbers::Congruence;

const MIDDLE: Cell = Cell::new(1, 1);

fn label(founded: u32) -> Label {
    Label::new(founded, 0).expect("a label")
}

/// Cells with sensors, and no walls.
struct Floor<'a>(&'a BTreeMap<Cell, Note>, Note);

impl floor::Floor<Note> for Floor<'_> {
    fn sensor(&self, cell: Cell) -> Option<Note> {
        if cell == MIDDLE { Some(self.1) } else { self.0.get(&cell).copied() }
    }

    fn put(&mut self, _: Cell, _: Note) {}

    fn unpack(&mut self, _: Cell) -> u16 {
        0
    }

    fn is_open(&self, _: Edge) -> bool {
        true
    }
}

/// Nothing goes wrong.
struct Luck;

impl Oracle for Luck {
    fn pick(&mut self, _: u32) -> u32 {
        0
    }
}

/// The view from the middle of `floor`, where its own sensor stores `here`.
fn view(floor: &BTreeMap<Cell, Note>, here: Note) -> View {
    View::new(&Floor(floor, here), MIDDLE, &mut Luck)
}

fn is_inside(cell: Cell) -> bool {
    (0..3).contains(&cell.x) && (0..3).contains(&cell.y)
}

/// A random tree on 3×3 cells, with the depth of each cell; if it begins at the rim, `deep` below a root outside.
fn tree(drawn: &mut Congruence, label: Label, deep: u32) -> BTreeMap<Cell, Note> {
    let root = Cell::new(drawn.pick(3) as i16, drawn.pick(3) as i16);
    let out = Side::ALL.into_iter().find(|&side| deep > 0 && !is_inside(root.beyond(side)));
    let first = Note::default().of_tree(label, out).at_depth(if out.is_some() { deep } else { 0 });
    let mut floor = BTreeMap::from([(root, first)]);
    while floor.len() < 9 {
        let (&cell, &note) = floor.iter().nth(drawn.pick(floor.len() as u32) as usize).expect("a cell");
        let side = Side::ALL[drawn.pick(4) as usize];
        let next = cell.beyond(side);
        if is_inside(next) && !floor.contains_key(&next) {
            let child = Note::default().of_tree(label, Some(side.opposite())).at_depth(note.depth + 1);
            floor.insert(next, child);
        }
    }
    floor
}

#[test]
fn children_restore_what_the_sensor_of_their_parent_stored() {
    let (mut drawn, mut restored, mut roots) = (Congruence(1), 0, 0);
    let (greater, old, less) = (label(0), label(1), label(2));
    for round in 0..2000 {
        let floor = tree(&mut drawn, old, 3 * (round % 2));
        let was = floor[&MIDDLE];
        let children: Vec<Side> =
            COMPASS.into_iter().filter(|&side| floor[&MIDDLE.beyond(side)].is_child_beyond(side)).collect();
        // A new sensor of a lesser tree, or of the same tree and as deep as the children or deeper, is not their
        // parent's.
        for here in [
            Note::default().of_tree(less, None),
            was.of_tree(old, None).at_depth(was.depth + 1 + drawn.pick(3)),
        ] {
            let found = view(&floor, here).restored();
            if children.is_empty() {
                assert_eq!(found, here, "{floor:?}");
                continue;
            }
            let parents = COMPASS.into_iter().filter(|&side| {
                let note = floor[&MIDDLE.beyond(side)];
                !children.contains(&side) && note.depth + 1 == was.depth
            });
            let expected: Vec<Note> = if was.depth == 0 {
                vec![here.of_tree(old, None).at_depth(0)]
            } else {
                parents.map(|side| here.of_tree(old, Some(side)).at_depth(was.depth)).collect()
            };
            assert!(expected.contains(&found), "{found:?} of {floor:?}");
            restored += 1;
            roots += u32::from(was.depth == 0);
        }
        // What is no older is no child's parent: a greater tree's sensor stays, and the true one does.
        for here in [Note::default().of_tree(greater, None), was] {
            assert_eq!(view(&floor, here).restored(), here, "{floor:?}");
        }
        // A cell of no tree stores nothing that could be restored.
        assert_eq!(view(&floor, Note::default()).restored(), Note::default());
        // With no parent in sight a neighbour of a greater tree leads on, or one nearer to the root; else it is left as
        // it is.
        let Some(&child) = children.first().filter(|_| was.depth > 0) else { continue };
        let only = |others: &[(Side, Note)]| {
            let mut floor = BTreeMap::from([(MIDDLE.beyond(child), floor[&MIDDLE.beyond(child)])]);
            floor.extend(others.iter().map(|&(side, note)| (MIDDLE.beyond(side), note)));
            view(&floor, Note::default().of_tree(less, None)).restored()
        };
        let new = Note::default().of_tree(less, None);
        assert_eq!(only(&[]), new);
        let [one, other, last] = [child.turned_left(), child.turned_right(), child.opposite()];
        let leads = |side| new.of_tree(old, Some(side)).at_depth(was.depth);
        let at = |label, depth| Note::default().of_tree(label, None).at_depth(depth);
        let (parent, nearer, beside) =
            (at(old, was.depth - 1), at(old, was.depth.saturating_sub(2)), at(old, was.depth));
        assert_eq!(only(&[(one, at(greater, 7))]), leads(one));
        assert_eq!(only(&[(one, at(less, 0)), (other, beside)]), new);
        assert_eq!(only(&[(one, at(less, 0)), (other, nearer), (last, beside)]), leads(other));
        assert_eq!(
            only(&[(one, at(greater, 7)), (other, nearer)]),
            if was.depth == 1 { leads(other) } else { leads(one) }
        );
        assert_eq!(
            only(&[(one, at(greater, 0)), (other, parent), (last, nearer)]),
            if was.depth == 1 { only(&[(other, parent), (last, nearer)]) } else { leads(other) }
        );
    }
    assert!(restored > 500 && roots > 100, "{restored} {roots}");
}

#[test]
fn an_agent_that_restores_acts_on_what_is_restored() {
    let (mut drawn, mut restored) = (Congruence(1), 0);
    let [old, less] = [label(1), label(2)];
    for round in 0..300 {
        let floor = tree(&mut drawn, old, 3 * (round % 2));
        let found = view(&floor, Note::default().of_tree(less, None));
        let decide = |rule, view: &View| Agent::new(0).decide(rule, view);
        let act = decide(Rule::DOUBTING, &found);
        assert_eq!(act, decide(Rule::DOUBTING, &View { here: found.restored(), ..found }), "{floor:?}");
        restored += u32::from(act != decide(Rule::DOUBTING.without(Condition::Restores), &found));
    }
    assert!(restored > 100, "{restored}");
}

#[test]
fn an_agent_that_doubts_nothing_it_reads_remembers_nothing_of_what_it_missed() {
    let here = Note::default().visited(Some(Side::East));
    let unexplored: BTreeMap<Cell, Note> =
        (0..9).map(|place| (Cell::new(place % 3, place / 3), Note::default())).collect();
    for (readings, remembers) in [(1, false), (2, true), (3, true)] {
        let mut agent = Agent::new(0);
        agent.decide(Rule::HELPERS.reading(readings), &view(&unexplored, here));
        assert_eq!(agent != Agent::new(0), remembers, "{readings}");
    }
}

#[test]
fn an_agent_that_finds_a_sensor_where_it_missed_one_goes_back() {
    let root = Note::default().of_tree(label(0), None);
    for side in Side::ALL {
        // One cell reads as unexplored.
        let beyond = BTreeMap::from([(MIDDLE.beyond(side), Note::default())]);
        let back = BTreeMap::from([(MIDDLE.beyond(side.opposite()), root)]);
        for (rule, goes_back) in [(Rule::ROBUST, true), (Rule::ROBUST.without(Condition::Underfoot), false)] {
            let mut agent = Agent::new(0);
            assert_eq!(agent.decide(rule, &view(&beyond, root)).next, Next::Explores(side));
            let there = Note { crossings: 2, ..Note::default().of_tree(label(0), None) };
            // Nothing else leads it there: it is the root of that tree, too.
            let next = agent.decide(rule, &view(&back, there)).next;
            assert_eq!(next == Next::Goes(side.opposite()), goes_back, "{rule:?} {next:?}");
        }
    }
}

#[test]
fn two_maps_joined_know_the_greater_status_of_each_cell() {
    let area = Area::new(Cell::new(-3, 2), Cell::new(4, 8)).expect("an area");
    let cells: Vec<Cell> = (1..10).flat_map(|y| (-4..6).map(move |x| Cell::new(x, y))).collect();
    let mut drawn = Congruence(5);
    for _ in 0..200 {
        let mut maps = [TinyMap::new(area).expect("56 cells"); 2];
        let mut told: [BTreeMap<Cell, Status>; 2] = [const { BTreeMap::new() }; 2];
        for _ in 0..drawn.pick(60) {
            let (which, cell) = (drawn.pick(2) as usize, cells[drawn.pick(cells.len() as u32) as usize]);
            let status = [Status::Obstacle, Status::Explored, Status::Body, Status::Unexplored]
                [drawn.pick(4) as usize];
            maps[which].learn(cell, status);
            let known = told[which].entry(cell).or_insert(status);
            *known = (*known).max(status);
        }
        let mut joined = maps[0];
        joined.join(&maps[1]);
        let mut obstacles = 0;
        for &cell in &cells {
            let [one, other] =
                [0, 1].map(|which| told[which].get(&cell).copied().unwrap_or(Status::Unexplored));
            let both = one.max(other);
            // Outside the area nothing is to be found.
            let seen = |status| if area.contains(cell) { status } else { Status::Obstacle };
            assert_eq!((maps[0].status(cell), joined.status(cell)), (seen(one), seen(both)), "{cell}");
            obstacles += u32::from(area.contains(cell) && both == Status::Obstacle);
        }
        assert_eq!(joined.obstacles(), obstacles);
        assert!(
            maps.iter()
                .all(|map| joined.is_within(&joined) && (map.is_within(&joined) || joined.obstacles() < 56))
        );
    }
}
