//! Each judge hears one small run that breaks each of its clauses, and one that breaks none: a judge that finds nothing
//! would not be noticed otherwise.

use std::collections::BTreeSet;

use super::{BrokenClause, Chain, Drive, Floor, Frontier, Kit, Pack, Place, Trouble};

/// A row of so many cells.
fn row(columns: i32) -> Floor {
    Floor { columns, rows: 1, blocked: BTreeSet::new(), walls: BTreeSet::new() }
}

/// The cells of a row in these columns.
fn at<const ROBOTS: usize>(columns: [i32; ROBOTS]) -> [Place; ROBOTS] {
    columns.map(|column| (column, 0))
}

/// The clause that is broken, if one is.
fn found(judged: Result<(), BrokenClause>) -> &'static str {
    judged.err().map_or("none", |(clause, _)| clause)
}

#[test]
fn robots_that_keep_in_touch() {
    // Which robot drives from where to where; each drive takes a second.
    let judged =
        |columns, starts: &[Place], drives: &[(usize, i32, i32)], [by_itself, is_known]: [bool; 2]| {
            let drive = |(second, &(robot, from, to)): (usize, &(usize, i32, i32))| {
                let begin = f64::from(second as u32);
                Drive { robot, from: (from, 0), to: (to, 0), begin, end: begin + 1.0 }
            };
            let drives: Vec<Drive> = drives.iter().enumerate().map(drive).collect();
            found(Kit { floor: &row(columns), starts, drives: &drives, by_itself, is_known }.judge())
        };
    let (two, three) = (at([0, 1]), at([0, 1, 2]));
    let whole = [(1, 1, 2), (0, 0, 1)];
    assert_eq!(judged(3, &two, &whole, [true, true]), "none");
    assert_eq!(judged(3, &two, &whole, [true, false]), "KIT-8");
    assert_eq!(judged(3, &two, &whole, [false, true]), "KIT-7");
    assert_eq!(judged(3, &two, &whole[..1], [true, false]), "KIT-6");
    assert_eq!(judged(3, &two, &whole[..1], [true, true]), "KIT-8");
    assert_eq!(judged(3, &two, &[(0, 0, 1)], [true, true]), "KIT-3");
    assert_eq!(judged(5, &two, &[(1, 1, 2), (1, 2, 3), (1, 3, 4)], [true, true]), "KIT-1");
    assert_eq!(judged(7, &three, &[(2, 2, 3), (2, 3, 4), (2, 4, 5)], [true, true]), "KIT-12");
    assert_eq!(judged(4, &three, &[(2, 2, 3)], [true, true]), "KIT-13");
    assert_eq!(judged(3, &three, &[], [true, true]), "none");
}

#[test]
fn robots_that_see() {
    let judged = |columns, moves: &[[i32; 2]], by_itself| {
        let floor = row(columns);
        let mut judge = Pack::new(&floor, &at([0, 1]), 1, 3);
        let heard = moves.iter().try_for_each(|&columns| judge.hear(&at(columns)));
        found(heard.and_then(|()| judge.end(by_itself)))
    };
    assert_eq!(judged(3, &[], true), "none");
    assert_eq!(judged(3, &[], false), "PACK-4");
    assert_eq!(judged(4, &[], true), "PACK-3");
    assert_eq!(judged(4, &[[0, 2]], true), "none");
    assert_eq!(judged(4, &[[0, 2], [0, 3]], true), "PACK-1");
    assert_eq!(judged(4, &[[1, 1]], true), "PACK-2");
    assert_eq!(judged(4, &[[0, 3]], true), "PACK-2");
}

#[test]
fn chains_in_which_something_fails() {
    let judged = |columns, trouble, moves: &[(bool, [i32; 4])], by_itself| {
        let floor = row(columns);
        let mut judge = Chain::new(&floor, (0, 0), 4, trouble);
        let heard = moves.iter().try_for_each(|&(takes_back, columns)| judge.hear(takes_back, &at(columns)));
        found(heard.and_then(|()| judge.end(by_itself)))
    };
    let out = [(false, [0, 0, 1, 1]), (false, [0, 0, 1, 2]), (false, [0, 0, 2, 3])];
    assert_eq!(judged(4, Trouble::None, &out, true), "none");
    assert_eq!(judged(4, Trouble::None, &out, false), "CHAIN-7");
    assert_eq!(judged(4, Trouble::None, &out[..2], true), "CHAIN-13");
    assert_eq!(judged(4, Trouble::None, &[(false, [0, 1, 1, 1])], true), "CHAIN-2");
    let far = [(false, [0, 0, 1, 3]), (false, [0, 0, 1, 4])];
    assert_eq!(judged(5, Trouble::None, &[&out[..2], &far].concat(), true), "CHAIN-19");
    let wall = Trouble::Wall(at([2, 3]), 3);
    assert_eq!(judged(4, wall, &out[..2], true), "none");
    assert_eq!(judged(4, wall, &out[..2], false), "CHAIN-22");
    assert_eq!(judged(4, wall, &out, true), "CHAIN-22");
    // The third robot dies in the third team move, and the fourth is out of contact with the rest.
    let apart = [out[0], out[1], far[0]];
    let back = (true, [0, 0, 1, 3]);
    let death = Trouble::Death(2, 3);
    let re_forming = |moves: &[(bool, [i32; 4])]| judged(4, death, &[&apart, moves].concat(), true);
    assert_eq!(re_forming(&[]), "CHAIN-21");
    assert_eq!(re_forming(&[(false, [0, 0, 1, 3])]), "CHAIN-21");
    assert_eq!(re_forming(&[back; 7]), "CHAIN-21");
    assert_eq!(re_forming(&[(true, [0, 0, 0, 3])]), "CHAIN-21");
    assert_eq!(re_forming(&[(true, [0, 0, 1, 2])]), "none");
}

#[test]
fn robots_that_explore_cells() {
    let judged = |robots: &[i32], moves: &[&[i32]], news: &[(usize, i32, bool)], by_itself| {
        let floor = row(3);
        let places = |columns: &[i32]| columns.iter().map(|&column| (column, 0)).collect::<Vec<Place>>();
        let mut judge = Frontier::new(&floor, &places(robots));
        let heard = moves.iter().try_for_each(|columns| judge.hear(&places(columns), []));
        let told = news.iter().map(|&(robot, column, is_obstacle)| (robot, (column, 0), is_obstacle));
        let last = places(moves.last().unwrap_or(&robots));
        found(heard.and_then(|()| judge.hear(&last, told)).and_then(|()| judge.end(by_itself)))
    };
    let (moves, news): ([&[i32]; 2], _) = ([&[1], &[2]], [(0, 0, false), (0, 1, false), (0, 2, false)]);
    assert_eq!(judged(&[0], &moves, &news, true), "none");
    assert_eq!(judged(&[0], &moves, &news, false), "FRONTIER-3");
    assert_eq!(judged(&[0], &moves[..1], &news[..2], true), "FRONTIER-1");
    assert_eq!(judged(&[0], &moves, &news[..2], true), "FRONTIER-4");
    assert_eq!(judged(&[0], &moves[..1], &news, true), "FRONTIER-5");
    assert_eq!(judged(&[0, 2], &[&[1, 1]], &[], true), "FRONTIER-2");
    assert_eq!(judged(&[0], &[&[2]], &[], true), "FRONTIER-2");
}
