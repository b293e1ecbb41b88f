//! The readings of KIT that the kernel does not have (rows 27 and 105 of the readings in `SPEC.md`): where a robot
//! asks, and which side it marks at which nodes. A plain program plays them. By the readings that both have it does as
//! the kernel does, which comes first here. The smallest run has the fewest nodes, of these the fewest walls, and of
//! these the fewest drives.

mod plain;

use std::ops::ControlFlow;

use rustc_hash::{FxHashMap, FxHashSet};
use tautline_kernel::ground::{Area, Cell, EdgeMark, Grid};
use tautline_kernel::kit::{self, Rule};
use tautline_proofs::engine::states::{Limits, search};
use tautline_proofs::kit::counterexample::fewest;
use tautline_proofs::kit::world;

use plain::{Asks, At, Demand, Fallback, Marks, Reading, Runs, Setting, Size, Speeds, State};

impl Setting {
    /// The fewest drives after which `demand` is broken, or the number of states in which none breaks it with at most
    /// so many drives.
    fn fewest_drives(&self, demand: Demand, most_drives: usize) -> Result<usize, usize> {
        let at_end = matches!(demand, Demand::Answered | Demand::Moves | Demand::Covers);
        let needs_driven = at_end || matches!(demand, Demand::Shortens | Demand::AnyShortest);
        let (mut known, mut now) = (FxHashSet::default(), self.starts());
        for drives in 0..=most_drives {
            let mut later = Vec::new();
            while let Some(state) = now.pop() {
                if !known.insert(state) {
                    continue;
                }
                let steps = self.steps(&state);
                if at_end && steps.is_empty() && self.broken_at_end(&state).contains(&demand) {
                    return Ok(drives);
                }
                for mut step in steps {
                    let drives = drives + usize::from(step.is_drive);
                    if drives <= most_drives && step.breaks.contains(&demand) {
                        return Ok(drives);
                    }
                    // What was driven plays no part in what robots do.
                    if !needs_driven {
                        step.after.driven = 0;
                    }
                    if step.is_drive { &mut later } else { &mut now }.push(step.after);
                }
            }
            if later.is_empty() {
                break;
            }
            now = later;
        }
        Err(known.len())
    }

    /// Whether a run goes on for ever in which everybody acts who can (KIT-7).
    fn goes_on_for_ever(&self) -> bool {
        let mut states = self.starts();
        let mut numbers: FxHashMap<State, usize> =
            states.iter().copied().enumerate().map(|(number, state)| (state, number)).collect();
        let mut steps: Vec<Vec<(usize, u8)>> = Vec::new();
        while let Some(state) = states.get(steps.len()).copied() {
            let next = self.steps(&state).into_iter().map(|mut step| {
                step.after.driven = 0;
                let number = *numbers.entry(step.after).or_insert_with(|| {
                    states.push(step.after);
                    states.len() - 1
                });
                (number, 1 << step.robot)
            });
            steps.push(next.collect());
        }
        // The robots that need not act, a bit for each: they stand, and can do nothing.
        let idle = |number: usize| {
            let can = steps[number].iter().fold(0, |can, (_, robot)| can | robot);
            let is_idle = |robot: &usize| can >> robot & 1 == 0 && states[number].robots[*robot].stands();
            (0..2).filter(is_idle).fold(0_u8, |idle, robot| idle | 1 << robot)
        };
        (0..states.len()).any(|home| {
            let (mut known, mut left) = (FxHashSet::default(), vec![(home, idle(home))]);
            while let Some((at, done)) = left.pop() {
                for &(to, robot) in &steps[at] {
                    let after = (to, done | robot | idle(to));
                    if after == (home, 0b11) {
                        return true;
                    }
                    if known.insert(after) {
                        left.push(after);
                    }
                }
            }
            false
        })
    }

    /// Whether a run from `start` drives all of these paths, a bit for each.
    fn can_drive(&self, start: State, paths: u32) -> bool {
        let (mut known, mut left) = (FxHashSet::from_iter([start]), vec![start]);
        while let Some(state) = left.pop() {
            if state.driven & paths == paths {
                return true;
            }
            let after = self.steps(&state).into_iter().map(|step| step.after);
            left.extend(after.filter(|&after| known.insert(after)));
        }
        false
    }

    /// Every node of every layout of this size, with the paths that are open.
    fn layouts(&self) -> impl Iterator<Item = (u8, u32)> {
        let (nodes, all) = (self.size.0 * self.size.1, self.paths_from(0, u32::MAX));
        (0..=all)
            .filter(move |open| open & !all == 0)
            .flat_map(move |open| (0..nodes).map(move |node| (node, open)))
    }
}

/// The main readings, which the kernel has, too.
const MAIN: Reading = Reading {
    runs: Runs::Every,
    asks: Asks::Everywhere,
    marks: Marks::Entrance,
    at: At::EveryNode,
    fallback: Fallback::All,
};

/// The other readings of the request under *ahead*, of which the last joins the two before.
const REQUESTS: [Asks; 3] = [Asks::BeforeTurns, Asks::NewNodes, Asks::NewNodesAndTurns];

/// The other readings of the mark.
const MARKS: [(Marks, At); 3] =
    [(Marks::Entrance, At::NewNodes), (Marks::Heading, At::EveryNode), (Marks::Heading, At::NewNodes)];

/// The lattices of the ledger's rows, those with the fewest nodes first.
const SMALL: [Size; 6] = [(2, 1, 1), (3, 1, 2), (2, 2, 4), (4, 1, 3), (5, 1, 4), (3, 2, 7)];

/// Those of at most ten nodes with two nodes out of reach, but for 10×1.
const WIDE: [Size; 6] = [(5, 1, 4), (6, 1, 5), (7, 1, 6), (8, 1, 7), (9, 1, 8), (5, 2, 2)];

const EVER: usize = usize::MAX;

/// A clause, at some speeds.
type Question = (Demand, Speeds);

const CONTACT: Question = (Demand::Contact, Speeds::Any);
const AT_EQUAL_SPEEDS: Question = (Demand::Contact, Speeds::Equal);
const AT_NODES: Question = (Demand::AtNodes, Speeds::Equal);

/// Sizes and drives that no reading changes: of KIT-3 at any and at equal speeds, and of KIT-4, 6, 8, 10 and 11.
const SAME: [(Question, Size, usize); 7] = [
    ((Demand::Apart, Speeds::Any), (3, 1, 0), 3),
    ((Demand::Apart, Speeds::Equal), (3, 1, 0), 4),
    ((Demand::Answered, Speeds::Any), (2, 1, 0), 1),
    ((Demand::Moves, Speeds::Any), (3, 1, 0), 1),
    ((Demand::Covers, Speeds::Any), (2, 1, 0), 1),
    ((Demand::Marks, Speeds::Any), (2, 1, 1), 0),
    ((Demand::Shortens, Speeds::Any), (3, 1, 0), 3),
];

/// Each size with each number of walls.
fn by_walls(sizes: &[Size]) -> impl Iterator<Item = Size> {
    sizes.iter().flat_map(|&(columns, rows, most)| (0..=most).map(move |walls| (columns, rows, walls)))
}

/// The smallest run of at most so many drives.
fn smallest(
    reading: Reading,
    (demand, speeds): Question,
    sizes: &[Size],
    most_drives: usize,
) -> Option<(Size, usize)> {
    by_walls(sizes).find_map(|size| {
        let drives = Setting { reading, speeds, size }.fewest_drives(demand, most_drives);
        drives.ok().map(|drives| (size, drives))
    })
}

/// The smallest lattice on which a run need not end.
fn smallest_endless(reading: Reading) -> Option<Size> {
    by_walls(&SMALL).find(|&size| Setting { reading, speeds: Speeds::Any, size }.goes_on_for_ever())
}

/// The kernel's rule by a reading that it has.
fn rule(reading: Reading) -> Rule {
    let runs = match reading.runs {
        Runs::Every => kit::Runs::Every,
        Runs::Ahead => kit::Runs::Ahead,
    };
    let fallback = match reading.fallback {
        Fallback::All => kit::Fallback::Nearest,
        Fallback::Filtered => kit::Fallback::Admitted,
    };
    Rule { runs, fallback, ..Rule::PUBLISHED }
}

/// The readings that the kernel has.
fn known_to_the_kernel() -> impl Iterator<Item = Reading> {
    [Runs::Every, Runs::Ahead].into_iter().flat_map(|runs| {
        [Fallback::All, Fallback::Filtered].map(|fallback| Reading { runs, fallback, ..MAIN })
    })
}

/// As [`smallest`], of the kernel's robots.
fn smallest_of_the_kernel(
    reading: Reading,
    (demand, speeds): Question,
    sizes: &[Size],
) -> Option<(Size, usize)> {
    let demand = match demand {
        Demand::Contact => world::Demand::Contact,
        Demand::AtNodes => world::Demand::AtNodes,
        Demand::Apart => world::Demand::Apart,
        Demand::Moves => world::Demand::Moves,
        Demand::Covers => world::Demand::Covers,
        Demand::Marks => world::Demand::Marks,
        Demand::Shortens => world::Demand::Shortens,
        Demand::AnyShortest => world::Demand::AnyShortest,
        Demand::Answered | Demand::Fresh => unreachable!("these are about messages"),
    };
    let speeds = match speeds {
        Speeds::Any => world::Speeds::Any,
        Speeds::Equal => world::Speeds::Equal,
    };
    sizes.iter().find_map(|&(columns, rows, most)| {
        let open = world::Setting::<2>::new(rule(reading), (columns.into(), rows.into())).expect("a lattice");
        let setting = world::Setting { speeds, max_walls: most as u8, ..open };
        let look = |setting: &world::Setting<2>| {
            ControlFlow::Continue(search(setting, setting.starts(), Limits::NONE))
        };
        let ControlFlow::Continue(found) = fewest(setting, demand, look) else { unreachable!("it looks on") };
        found.map(|found| ((columns, rows, found.setting.max_walls.into()), found.drives()))
    })
}

#[test]
fn the_plain_program_has_the_smallest_counterexamples_of_the_kernel() {
    // All 3×2 nodes are in reach of each other.
    let sizes = &SMALL[..5];
    for reading in known_to_the_kernel() {
        let mut questions = vec![AT_NODES];
        for demand in [
            Demand::Contact,
            Demand::Apart,
            Demand::Moves,
            Demand::Covers,
            Demand::Marks,
            Demand::Shortens,
            Demand::AnyShortest,
        ] {
            questions.extend([(demand, Speeds::Any), (demand, Speeds::Equal)]);
        }
        for question in questions {
            let plain = smallest(reading, question, sizes, EVER);
            assert_eq!(plain, smallest_of_the_kernel(reading, question, sizes), "{reading:?}, {question:?}");
        }
        assert_eq!(smallest_endless(reading), Some((3, 1, 0)));
    }
}

/// KIT-1, KIT-2, KIT-4 and KIT-7 as `docs/kit.md` has them, where the search of the kernel's states takes long.
#[test]
fn the_plain_program_has_the_smallest_counterexamples_of_the_documents() {
    assert_eq!(smallest(MAIN, CONTACT, &WIDE, EVER), Some(((5, 1, 0), 5)));
    for question in [AT_EQUAL_SPEEDS, AT_NODES] {
        assert_eq!(smallest(MAIN, question, &WIDE, EVER), Some(((5, 2, 2), 7)));
        let filtered = Reading { fallback: Fallback::Filtered, ..MAIN };
        assert_eq!(smallest(filtered, question, &[(5, 1, 4), (5, 2, 2)], EVER), None);
    }
    for reading in known_to_the_kernel() {
        let is_smallest = |&(question, size, drives): &(Question, Size, usize)| {
            smallest(reading, question, &SMALL, EVER) == Some((size, drives))
        };
        assert!(SAME.iter().all(is_smallest), "{reading:?}");
        assert_eq!(smallest(reading, (Demand::Fresh, Speeds::Any), &SMALL, EVER), None);
    }
}

/// Both ends of each stance, and the paths driven.
type Scene = ([[u8; 2]; 2], u32);

/// The scenes to which robots of the kernel come.
fn scenes_of_the_kernel(setting: &world::Setting<2>, columns: i16) -> FxHashSet<Scene> {
    let number = |cell: Cell| (cell.y * columns + cell.x) as u8;
    let scene = |world: &world::World<2>| {
        let ends = [0, 1].map(|robot| {
            let stance = world.team.stance(robot).expect("a robot");
            [stance.from(), stance.to()].map(number)
        });
        let area: Area = setting.area;
        let driven = area.edges().filter(|&edge| world.truth.edge_has(EdgeMark::Virtual, edge));
        let path = |cell: Cell, beyond: Cell| Setting::path(number(cell), number(beyond));
        (ends, driven.fold(0, |all, edge| all | path(edge.cell(), edge.cell().beyond(edge.side()))))
    };
    let mut left = setting.starts();
    let mut known: FxHashSet<world::World<2>> = left.iter().copied().collect();
    while let Some(world) = left.pop() {
        let after = setting.turns(&world).into_iter().map(|turned| turned.world);
        left.extend(after.filter(|&after| known.insert(after)));
    }
    known.iter().map(scene).collect()
}

/// The scenes to which plain robots come.
fn scenes(setting: Setting) -> FxHashSet<Scene> {
    let (columns, rows, _) = setting.size;
    let mut left: Vec<State> = (0..columns * rows).map(|node| setting.start(node)).collect();
    let mut known: FxHashSet<State> = left.iter().copied().collect();
    while let Some(state) = left.pop() {
        let after = setting.steps(&state).into_iter().map(|step| step.after);
        left.extend(after.filter(|&after| known.insert(after)));
    }
    known.iter().map(|state| (state.robots.map(|robot| robot.ends()), state.driven)).collect()
}

#[test]
fn plain_robots_come_where_robots_of_the_kernel_come() {
    for reading in known_to_the_kernel() {
        for size @ (columns, rows, walls) in [(4, 1, 3), (2, 2, 4), (3, 2, 1)] {
            let open =
                world::Setting::<2>::new(rule(reading), (columns.into(), rows.into())).expect("a lattice");
            let setting =
                world::Setting { max_walls: walls as u8, demand: Some(world::Demand::Apart), ..open };
            let plain = scenes(Setting { reading, speeds: Speeds::Any, size });
            assert!(
                plain.len() > 100 && plain == scenes_of_the_kernel(&setting, columns.into()),
                "{reading:?}"
            );
        }
    }
}

/// Asserts that the sizes of KIT-3, 4, 6, 7, 8, 10 and 11 are those of the main reading.
fn assert_same(reading: Reading) {
    for (question, size, drives) in SAME {
        assert_eq!(
            smallest(reading, question, &SMALL, EVER),
            Some((size, drives)),
            "{reading:?}, {question:?}"
        );
    }
    assert_eq!(smallest_endless(reading), Some((3, 1, 0)), "{reading:?}");
}

/// Row 27, and its combinations with row 105 and the filtered fallback of row 32.
#[test]
fn where_robots_ask_under_ahead_refutes_nothing_less_and_nothing_later() {
    for asks in REQUESTS.into_iter().chain([Asks::Everywhere]) {
        for (marks, at) in MARKS.into_iter().chain([(Marks::Entrance, At::EveryNode)]) {
            for fallback in [Fallback::All, Fallback::Filtered] {
                let reading = Reading { runs: Runs::Ahead, asks, marks, at, fallback };
                for question in [CONTACT, AT_EQUAL_SPEEDS, AT_NODES] {
                    let found = smallest(reading, question, &WIDE, EVER);
                    assert_eq!(found, Some(((5, 1, 0), 4)), "{reading:?}, {question:?}");
                }
                assert_same(reading);
                let stale = smallest(reading, (Demand::Fresh, Speeds::Equal), &SMALL[..4], EVER);
                let expected = (asks == Asks::NewNodes).then_some(((3, 1, 0), 4));
                assert_eq!(stale, expected, "{reading:?}");
            }
        }
    }
}

/// Row 27, with KIT at every node. News that is asked for at new nodes alone is old elsewhere, so that no filter keeps
/// contact.
#[test]
fn robots_that_ask_at_new_nodes_alone_lose_contact_though_they_filter() {
    for fallback in [Fallback::All, Fallback::Filtered] {
        let reading = Reading { asks: Asks::NewNodes, fallback, ..MAIN };
        assert_eq!(smallest(reading, CONTACT, &WIDE, EVER), Some(((5, 1, 0), 5)));
        for question in [AT_EQUAL_SPEEDS, AT_NODES] {
            assert_eq!(smallest(reading, question, &WIDE, EVER), Some(((5, 1, 0), 10)));
        }
        assert_eq!(smallest(reading, (Demand::Fresh, Speeds::Equal), &SMALL, EVER), Some(((3, 1, 0), 4)));
        assert_same(reading);
    }
}

/// Row 27. Elsewhere no run drives everything from a start with one way out: the first robot asks at the next node, and
/// the second one, which has not come out behind it, is silent. Before a turn alone they ask if the way turns there.
#[test]
fn robots_that_ask_before_a_turn_alone_come_out_of_a_dead_end() {
    for (runs, asks, expected) in [
        (Runs::Every, Asks::Everywhere, [2, 6, 16, 216]),
        (Runs::Ahead, Asks::Everywhere, [2, 6, 16, 216]),
        (Runs::Ahead, Asks::BeforeTurns, [0, 0, 16, 152]),
        (Runs::Ahead, Asks::NewNodes, [2, 6, 16, 216]),
        (Runs::Ahead, Asks::NewNodesAndTurns, [2, 6, 16, 216]),
    ] {
        let sizes = [((3, 1, 2), 7), ((4, 1, 3), 20), ((2, 2, 4), 48), ((3, 2, 7), 608)];
        for ((size, starts), expected) in sizes.into_iter().zip(expected) {
            let setting = Setting { reading: Reading { runs, asks, ..MAIN }, speeds: Speeds::Any, size };
            let all = setting.paths_from(0, u32::MAX);
            let mut left = Vec::new();
            for (node, open) in setting.layouts() {
                let due = setting.paths_from(node, open);
                if due == 0 {
                    continue;
                }
                let is_left = !setting.can_drive(setting.start(node).among(open, all & !open), due);
                let beyond = |node, side| {
                    setting.beyond(node, side).filter(|&next| Setting::path(node, next) & open != 0)
                };
                let ways: Vec<(u8, u8)> =
                    (0..4).filter_map(|side| Some((side, beyond(node, side)?))).collect();
                let is_dead_end = matches!(ways[..], [(side, next)] if due.count_ones() > 1
                    && (asks != Asks::BeforeTurns || beyond(next, side).is_none()));
                assert_eq!(is_left, is_dead_end, "{asks:?}, {size:?}, {node}, {open:b}");
                left.push(is_left);
            }
            let counts = (left.len(), left.iter().filter(|&&is_left| is_left).count());
            assert_eq!(counts, (starts, expected), "{asks:?}, {size:?}");
        }
    }
}

/// Row 105, where KIT runs at every node. If the heading is marked, the smallest run that loses contact has more nodes,
/// since robots that count the way straight on as covered turn off.
#[test]
fn what_is_marked_at_a_node_saves_no_clause() {
    let (rows, two_rows) = WIDE.split_at(5);
    for (marks, at) in MARKS {
        let (lost, later) = match marks {
            Marks::Entrance => (((5, 1, 0), 5), ((5, 2, 2), 7)),
            Marks::Heading => (((5, 2, 0), 7), ((5, 2, 2), 9)),
        };
        let reading = Reading { marks, at, ..MAIN };
        assert_eq!(smallest(reading, CONTACT, &WIDE, EVER), Some(lost), "{reading:?}");
        for question in [AT_EQUAL_SPEEDS, AT_NODES] {
            let filtered = Reading { fallback: Fallback::Filtered, ..reading };
            for reading in [reading, filtered] {
                assert_eq!(smallest(reading, question, rows, EVER), None, "{reading:?}, {question:?}");
            }
            assert_eq!(smallest(reading, question, two_rows, 12), Some(later), "{reading:?}, {question:?}");
            assert_eq!(smallest(filtered, question, two_rows, 9), None, "{filtered:?}, {question:?}");
        }
        assert_same(reading);
    }
}

/// Row 105, for the two readings whose states are few enough.
#[test]
#[ignore = "minutes and 4 GiB: cargo test --release -p tautline-proofs --test all -- --ignored kit_readings"]
fn two_walls_are_the_fewest_by_which_contact_is_lost_at_equal_speeds() {
    for (marks, at) in [(Marks::Entrance, At::NewNodes), (Marks::Heading, At::EveryNode)] {
        let reading = Reading { marks, at, ..MAIN };
        assert_eq!(smallest(reading, AT_EQUAL_SPEEDS, &[(5, 2, 1)], EVER), None, "{reading:?}");
    }
}

/// Rows 27 and 105, filtered (32) or not: no reading keeps KIT-14, and what is marked does not change its size.
#[test]
fn where_robots_ask_a_robot_may_take_again_a_path_that_begins_no_shortest_way() {
    for (runs, asks, expected) in [
        (Runs::Every, Asks::Everywhere, ((3, 1, 0), 3)),
        (Runs::Every, Asks::NewNodes, ((3, 1, 0), 3)),
        (Runs::Ahead, Asks::Everywhere, ((4, 1, 0), 5)),
        (Runs::Ahead, Asks::BeforeTurns, ((3, 1, 0), 3)),
        (Runs::Ahead, Asks::NewNodes, ((3, 1, 0), 5)),
        (Runs::Ahead, Asks::NewNodesAndTurns, ((3, 1, 0), 5)),
    ] {
        for (marks, at) in MARKS.into_iter().chain([(Marks::Entrance, At::EveryNode)]) {
            for fallback in [Fallback::All, Fallback::Filtered] {
                let reading = Reading { runs, asks, marks, at, fallback };
                let found = smallest(reading, (Demand::AnyShortest, Speeds::Any), &SMALL, EVER);
                assert_eq!(found, Some(expected), "{reading:?}");
            }
        }
    }
}
