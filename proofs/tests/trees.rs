//! Agents that search in trees, on floors of this test's own: what *OneLabel* is for, and an agent that has no label
//! left.

use std::collections::{BTreeMap, BTreeSet};

use tautline_kernel::bricks::tree::{Agent, Condition, Label, Next, Note, Rule, State, act, settle};
use tautline_kernel::floor;
use tautline_kernel::ground::{Cell, Edge};
use tautline_proofs::engine::Tape;

const WOVEN: [&str; 5] = ["....##", "#.#.##", "....##", ".#...#", "...#.."];

const STARTS: [(i16, i16); 4] = [(1, 0), (5, 4), (1, 4), (3, 3)];

/// Who acts, in order.
const ORDER: [u8; 27] = [0, 0, 3, 3, 3, 3, 3, 3, 1, 3, 3, 3, 0, 2, 2, 2, 2, 3, 3, 3, 3, 3, 0, 0, 1, 1, 1];

#[derive(Default)]
struct Floor {
    notes: BTreeMap<Cell, Note>,
    /// Each label that a cell has had, with its parent then.
    had: BTreeMap<Cell, Vec<(Label, Option<Cell>)>>,
}

impl floor::Floor<Note> for Floor {
    fn sensor(&self, cell: Cell) -> Option<Note> {
        self.notes.get(&cell).copied()
    }

    fn put(&mut self, cell: Cell, note: Note) {
        let Some(there) = self.notes.get_mut(&cell) else { return };
        *there = note;
        let had = self.had.entry(cell).or_default();
        if let Some(label) = note.tree().filter(|&label| had.last().is_none_or(|&(last, _)| last != label)) {
            had.push((label, note.side.map(|side| cell.beyond(side))));
        }
    }

    fn unpack(&mut self, _: Cell) -> u16 {
        0
    }

    fn is_open(&self, edge: Edge) -> bool {
        [edge.cell(), edge.cell().beyond(edge.side())].iter().all(|cell| self.notes.contains_key(cell))
    }
}

impl Floor {
    fn new(rows: &[&str]) -> Self {
        let row = |(y, row): (i16, &&str)| {
            let cells: Vec<(i16, char)> = (0..).zip(row.chars()).collect();
            let free = cells.into_iter().filter(|&(_, cell)| cell == '.');
            free.map(|(x, _)| (Cell::new(x, y), Note::default())).collect::<Vec<_>>()
        };
        Self { notes: (0..).zip(rows).flat_map(row).collect(), ..Self::default() }
    }

    fn is_left(&self, cell: &Cell) -> bool {
        self.notes.get(cell).is_some_and(|note| note.state != State::Visited)
    }

    /// Whether `cells` are connected by these `sides`, and by cells that are left.
    fn are_connected(&self, cells: &BTreeSet<Cell>, sides: &[(Cell, Cell)]) -> bool {
        let mut reached: BTreeSet<Cell> = cells.first().copied().into_iter().collect();
        loop {
            let is_new = |(one, other): &&(Cell, Cell)| reached.contains(one) != reached.contains(other);
            let Some(&(one, other)) =
                sides.iter().filter(|(one, other)| self.is_left(one) && self.is_left(other)).find(is_new)
            else {
                return cells.is_subset(&reached);
            };
            reached.extend([one, other]);
        }
    }

    fn labels(&self) -> BTreeSet<Label> {
        self.had.values().flatten().map(|&(label, _)| label).collect()
    }

    /// The claim of the argument.
    fn is_claim_true(&self) -> bool {
        self.labels().into_iter().all(|label| {
            let all = || self.had.iter().flat_map(|(&cell, had)| had.iter().map(move |&had| (cell, had)));
            let cells = all().filter(|&(cell, (had, _))| had == label && self.is_left(&cell));
            let sides =
                all().filter_map(|(cell, (had, parent))| Some((cell, parent.filter(|_| had >= label)?)));
            self.are_connected(&cells.map(|(cell, _)| cell).collect(), &sides.collect::<Vec<_>>())
        })
    }

    /// The sentence of BRICKS-8.
    fn are_trees_whole(&self) -> bool {
        self.labels().into_iter().all(|label| {
            let with = |is: fn(Label, Label) -> bool| {
                let has = move |(&cell, note): (&Cell, &Note)| {
                    Some(cell).filter(|_| note.tree().is_some_and(|tree| is(tree, label)))
                };
                self.notes.iter().filter_map(has).collect::<BTreeSet<_>>()
            };
            let among = with(|tree, label| tree >= label);
            let beside = |&cell: &Cell| {
                [Cell::new(cell.x + 1, cell.y), Cell::new(cell.x, cell.y + 1)].map(|other| (cell, other))
            };
            let sides = among.iter().flat_map(beside).filter(|(_, other)| among.contains(other));
            self.are_connected(&with(|tree, label| tree == label), &sides.collect::<Vec<_>>())
        })
    }
}

/// After which actions the claim does not hold; the sentence always does.
fn fails(rule: Rule) -> Vec<usize> {
    let mut floor = Floor::new(&WOVEN);
    let mut cells = STARTS.map(|(x, y)| Cell::new(x, y));
    let mut agents = [0, 1, 2, 3].map(Agent::new);
    settle(&mut floor, &cells);
    let mut failed = Vec::new();
    for (number, agent) in ORDER.into_iter().map(usize::from).enumerate() {
        (_, cells[agent]) = act(rule, &mut floor, &mut agents[agent], cells[agent], &mut Tape(&[]));
        failed.extend((!floor.is_claim_true()).then_some(number + 1));
        assert!(floor.are_trees_whole(), "after {} actions", number + 1);
    }
    failed
}

/// The claim in the argument for BRICKS-8: the cells which have ever had a label are connected by the sides through
/// which cells became children with it or with greater ones. This is the smallest run known in which it fails without
/// the condition, found at random; the sentence of the clause itself holds there.
#[test]
fn without_one_label_the_claim_behind_trees_that_stay_whole_fails() {
    assert_eq!(fails(Rule::TREE.without(Condition::OneLabel)), [27]);
    assert_eq!(fails(Rule::TREE), [0; 0]);
}

#[test]
fn an_agent_that_has_founded_as_many_trees_as_there_are_labels_founds_no_more_and_is_not_done() {
    let mut floor = Floor::new(&["...", ".#.", "..."]);
    let mut cell = Cell::new(0, 0);
    let mut agent = Agent::new(0);
    agent.founded = Label::TREES;
    settle(&mut floor, &[cell]);
    for _ in 0..100 {
        let (done, next) = act(Rule::TREE, &mut floor, &mut agent, cell, &mut Tape(&[]));
        assert!(matches!(done.next, Next::Goes(_) | Next::Explores(_)), "{done:?}");
        cell = next;
    }
    assert_eq!((agent.founded, floor.labels().len()), (Label::TREES, 0));
}
