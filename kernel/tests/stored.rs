//! Stored sensors and messages come back, no two of them are stored alike, and a ring of cells is where it is drawn.

use std::collections::BTreeSet;

use tautline_kernel::bricks::tree::{Label, Note, State};
use tautline_kernel::chain::Message;
use tautline_kernel::floor::{Claim, Mark, Ring, Sensor};
use tautline_kernel::ground::{Cell, Circle, Edge, Side, Step, Steps};

#[test]
fn every_sensor_comes_back_from_bits_of_its_own() {
    let marks = [Mark::Unexplored, Mark::Explored, Mark::Closing, Mark::Visited, Mark::Sealed];
    let mut stored = BTreeSet::new();
    let mut count = 0;
    for (mark, crossings, agents) in marks.into_iter().flat_map(|mark| {
        [0, 1, 1 << 31, u32::MAX]
            .into_iter()
            .flat_map(move |crossings| [0, 1, 128, 255].map(|agents| (mark, crossings, agents)))
    }) {
        for set in 0..16_u8 {
            let shut = Steps::of_bits(set);
            for claim in
                [None, Some(Claim { owner: 0 }), Some(Claim { owner: 1 }), Some(Claim { owner: 255 })]
            {
                let sensor = Sensor { mark, crossings, agents, shut, claim, serial: 0 };
                assert_eq!(Sensor::from_bits(sensor.to_bits()), Some(sensor));
                stored.insert(sensor.to_bits());
                count += 1;
            }
        }
    }
    assert_eq!(stored.len(), count);
}

#[test]
fn every_note_comes_back_from_bits_of_its_own() {
    let states = [State::Unexplored, State::Explored, State::Open, State::Visited];
    let labels = [(0, 0), (0, 255), (Label::TREES - 1, 0), (Label::TREES - 1, 1), (7, 3)];
    let mut stored = BTreeSet::new();
    let mut count = 0;
    for (state, (founded, id)) in states.into_iter().flat_map(|state| labels.map(|label| (state, label))) {
        let label = Label::new(founded, id).expect("a label");
        for side in [None].into_iter().chain(Side::ALL.map(Some)) {
            for crossings in 0..=Note::MOST_CROSSINGS {
                let note = Note { state, label, side, crossings, depth: 0 };
                assert_eq!(Note::from_bits(note.to_bits()), Some(note));
                assert_eq!(note.is_new(), crossings == 1);
                stored.insert(note.to_bits());
                count += 1;
            }
        }
    }
    assert_eq!((stored.len(), Note::MOST_CROSSINGS, Note::BITS_WITH_DEPTH), (count, 2047, 64));
    let end = 1_u64 << Note::BITS;
    assert!(stored.iter().all(|&bits| bits < end && Note::from_bits(bits | end).is_none()));
    for (depth, kept) in
        [(0, 0), (5, 5), ((1 << 24) - 1, (1 << 24) - 1), (1 << 24, (1 << 24) - 1), (u32::MAX, (1 << 24) - 1)]
    {
        assert_eq!(Note::default().at_depth(depth).depth, kept);
    }
    let label = Label::new(3, 4).expect("a label");
    let done = Note::default().of_tree(label, Some(Side::East)).at_depth(9).visited(Some(Side::West));
    assert_eq!(done, Note { state: State::Visited, side: Some(Side::West), ..Note::default() });
}

#[test]
fn fourteen_bytes_are_messages_of_the_chain_and_each_of_them_comes_back() {
    let read =
        (0..=u8::MAX).filter(|&byte| Message::decode(byte).is_ok_and(|message| message.encode() == byte));
    // Five steps, four of them blocked, and five taken back.
    assert_eq!(read.collect::<Vec<_>>(), [0, 1, 2, 3, 4, 8, 9, 10, 11, 16, 17, 18, 19, 20]);
}

/// The cells around 0,0, clockwise from the northern one.
const AROUND: [(i32, i32); 8] = [(0, -1), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1)];

#[test]
fn a_ring_is_seen_from_beyond_a_side_as_it_lies() {
    for (set, side) in (0..=u8::MAX).flat_map(|set| Side::ALL.map(|side| (set, side))) {
        let (x, y) = AROUND[Ring::place(side) as usize];
        let is_known = |cell: (i32, i32)| {
            cell == (0, 0)
                || AROUND.iter().zip(0..).any(|(&around, place)| around == cell && set >> place & 1 == 1)
        };
        let beyond = AROUND.iter().enumerate().filter(|(_, (dx, dy))| is_known((x + dx, y + dy)));
        let expected = beyond.fold(0_u8, |ring, (place, _)| ring | 1 << place);
        assert_eq!(Ring(set).seen_beyond(side), Ring(expected), "{set:b} {side:?}");
    }
}

#[test]
fn a_sensor_is_in_the_cell_around_which_its_place_tells() {
    for side in [1_u16, 2, 7, 1000] {
        let length = i32::from(side);
        for (x, y) in (-2..=2).flat_map(|x| (-2..=2).map(move |y| (x, y))) {
            let place = AROUND.iter().zip(0..).find(|&(&around, _)| around == (x, y)).map(|(_, place)| place);
            // Its middle, and as far to either rim as the cell goes.
            for (east, south) in [(0, 0), (-(length / 2), 0), (0, (length - 1) / 2)] {
                assert_eq!(
                    Ring::locate(x * length + east, y * length + south, side),
                    place,
                    "{x} {y} {side}"
                );
            }
        }
    }
    for far in [1 << 20, -(1 << 20), i32::MAX, i32::MIN] {
        for side in [1, u16::MAX] {
            assert_eq!((Ring::locate(far, 0, side), Ring::locate(0, far, side)), (None, None), "{far}");
        }
    }
    assert_eq!(Ring::locate(0, 1, 0), None);
}

#[test]
fn sides_and_steps_lead_where_the_compass_says() {
    let at = Cell::new(5, -7);
    let beyond = [(Side::East, 6, -7), (Side::South, 5, -6), (Side::West, 4, -7), (Side::North, 5, -8)];
    for (side, x, y) in beyond {
        let cell = Cell::new(x, y);
        assert_eq!((at.beyond(side), at.after(Step::Cross(side))), (cell, cell));
        assert_eq!(Edge::new(at, side), Edge::new(cell, side.opposite()));
        assert!(Circle::SAFE.covers(at, cell));
    }
    assert_eq!(at.after(Step::Stay), at);
    for bits in 0..32_u8 {
        let steps = Steps::of_bits(bits);
        assert_eq!((steps.len(), steps.is_choice()), (bits.count_ones(), bits.count_ones() > 1), "{bits:b}");
    }
}
