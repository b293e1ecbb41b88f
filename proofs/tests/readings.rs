//! The readings of the chain that Kovács, Pásztor and Istenes 2011 leave open, beyond what the ledger decides of them:
//! those that change nothing, and those that the paper's own figures exclude.

use std::collections::BTreeSet;

use tautline_kernel::chain::{Chain, High, Intent, Kind, Message, Move, Outcome, Rule};
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Edge, Side, Step, TinyGrid};
use tautline_proofs::chain::Subject;
use tautline_proofs::chain::breach::Breach;
use tautline_proofs::chain::invariant::Invariant;
use tautline_proofs::chain::plain::{PlainChain, PlainIntent};
use tautline_proofs::chain::readings::Reading::{self, InARow, LastMoved, NullLast, Pathless, Unfollowed};
use tautline_proofs::chain::readings::Readings;
use tautline_proofs::chain::search::{Bounds, search};
use tautline_proofs::engine::tree::unwatched;
use tautline_proofs::engine::{Stop, exhaust, require};

/// The area of the paper for so many robots, and its base.
fn area(robots: i16) -> (Area, Cell) {
    let Bounds { area, base, .. } = Bounds::new(Subject::PUBLISHED, robots as usize, 0);
    (area, base)
}

/// The published chain of so many robots in the paper's area, under these readings.
fn chain(robots: i16, readings: &[Reading]) -> PlainChain {
    let (area, base) = area(robots);
    let subject = Subject { readings: Readings::of(readings), ..Subject::PUBLISHED };
    PlainChain::of(&subject, robots as usize, base, area).expect("room for a row").that_floods_once()
}

fn plan(chain: &mut PlainChain) -> PlainIntent {
    chain.plan(u64::MAX).expect("any number of candidates").0
}

/// The team moves in which the area is explored, if it has no walls.
fn in_the_open(robots: i16, readings: &[Reading]) -> usize {
    let mut chain = chain(robots, readings);
    for moves in 0.. {
        match plan(&mut chain) {
            PlainIntent::Explored => return moves,
            PlainIntent::Exhausted => panic!("cells are left"),
            intent => chain.settle(&intent, |_| true),
        }
    }
    unreachable!("a run ends")
}

/// Row 7: R_{i+1} has five steps in the next team move, and those count that end in E_C of R_i. It has all of them if R_i
/// is in E_N of it, and three if R_i is at a corner.
#[test]
fn a_follower_in_e_n_of_the_planned_place_leaves_the_robot_ahead_all_five_steps() {
    let (here, rule) = (Cell::new(0, 0), Rule::PUBLISHED);
    let cells: Vec<Cell> = (-4..=4).flat_map(|x| (-4..=4).map(move |y| Cell::new(x, y))).collect();
    let variety = |follower: Cell, ahead: Cell| {
        Step::ALL.into_iter().filter(|&step| rule.covered.covers(follower, ahead.after(step))).count()
    };
    // By whether the list of R_i prefers its place: how many steps R_{i+1} has from where it is sent to, and from where
    // it is if that way is blocked.
    let varieties = |high: High| {
        let (mut sent, mut blocked) =
            ([BTreeSet::new(), BTreeSet::new()], [BTreeSet::new(), BTreeSet::new()]);
        for ahead in Step::ALL.map(|step| Move { from: here, step, known_open: false }) {
            for &from in &cells {
                let preferred = Rule { high, ..rule }.high_steps(from, ahead);
                for step in
                    Step::ALL.into_iter().filter(|&step| rule.safe.covers(ahead.to(), from.after(step)))
                {
                    let is_preferred = usize::from(preferred.has(step));
                    sent[is_preferred].insert(variety(from.after(step), ahead.to()));
                    blocked[is_preferred].insert(variety(from.after(step), here));
                }
            }
        }
        [sent, blocked].map(|kinds| kinds.map(|kind| kind.into_iter().collect::<Vec<_>>()))
    };
    let [sent, blocked] = varieties(High::Planned);
    assert_eq!((sent, blocked), ([vec![3], vec![5]], [vec![2, 3, 5], vec![2, 3, 5]]));
    let [sent, blocked] = varieties(High::Present);
    assert_eq!((sent, blocked), ([vec![3, 5], vec![3, 5]], [vec![2, 3], vec![5]]));
}

/// The paper's Table I has 62 team moves for eight robots.
#[test]
fn a_chain_that_starts_in_a_row_takes_other_figures_than_the_papers() {
    for robots in 2..=16 {
        let ring = 8 * (robots as usize - 1);
        assert_eq!(in_the_open(robots, &[]), ring + robots as usize - 2);
        assert_eq!(in_the_open(robots, &[NullLast]), ring + robots as usize - 2);
        assert_eq!(in_the_open(robots, &[InARow]), ring - 1);
        assert_eq!(in_the_open(robots, &[InARow, NullLast]), ring - 1);
    }
    assert_eq!(in_the_open(8, &[]), 62);
    assert_eq!(in_the_open(8, &[InARow]), 55);
}

/// The cells that the published chain of so many robots explores in (2N+1)² cells, the base in the middle.
fn explored_in_larger(robots: i16, mut is_open: impl FnMut(Edge) -> bool) -> BTreeSet<Cell> {
    let (inner, base) = area(robots);
    let [first, last] = [inner.first().at_offset(-1, -1), inner.last().at_offset(1, 1)];
    let area = Area::new(first, last).expect("an area");
    let chain = PlainChain::new(Rule::PUBLISHED, robots as usize, base, area);
    let (mut chain, mut explored) = (chain.that_floods_once(), BTreeSet::new());
    loop {
        explored.extend(chain.cells());
        match plan(&mut chain) {
            PlainIntent::Explored => panic!("robots come to the rim"),
            PlainIntent::Exhausted => return explored,
            intent => chain.settle(&intent, &mut is_open),
        }
    }
}

/// The paper: “the maximal size of the area can be explored is (2N+1)²”.
#[test]
fn of_2n_plus_1_squared_cells_the_rim_is_left_out() {
    for robots in 2..=8 {
        let inner = area(robots).0.cells().collect();
        assert_eq!(explored_in_larger(robots, |_| true), inner, "{robots} robots");
    }
    for (robots, most) in FEW_WALLS {
        let tally = exhaust(|oracle: &mut dyn Oracle| {
            let explored = explored_in_larger(robots, open_by(oracle, most));
            let is_inner = |cell: &Cell| area(robots).0.contains(*cell);
            require(explored.iter().all(is_inner), "no robot is at the rim")?;
            Ok("an end")
        });
        assert_eq!(tally.violation, None);
        assert!(tally.cases > 500, "{} runs", tally.cases);
    }
}

#[test]
fn a_chain_that_starts_in_a_row_breaks_contact_among_four_walls() {
    let wall = |x, y, side| Edge::new(Cell::new(x, y), side);
    let walls =
        [wall(0, 3, Side::East), wall(0, 3, Side::South), wall(4, 1, Side::South), wall(5, 1, Side::South)];
    for readings in [&[InARow][..], &[InARow, NullLast]] {
        let mut chain = chain(4, readings);
        let breaks = |_: &usize| {
            let (before, intent) = (chain.cells().to_vec(), plan(&mut chain));
            chain.settle(&intent, |edge| !walls.contains(&edge));
            Breach::Contact.is_in(&before, chain.cells())
        };
        assert_eq!((1..=100).find(breaks), Some(30), "{readings:?}");
    }
}

/// Of three robots also CHAIN-1 and CHAIN-2 hold as published: CHAIN-15.
#[test]
fn a_row_and_a_null_move_at_the_end_break_no_sentence_that_holds_as_published() {
    let [contact, crowding, coverage] =
        [Breach::Contact, Breach::Crowding, Breach::Coverage].map(Invariant::Without);
    let of_three = vec![contact, crowding, coverage, Invariant::Ends];
    for (robots, walls, invariants) in [(3, 3, of_three), (4, 2, vec![coverage, Invariant::Ends])] {
        for readings in [&[NullLast][..], &[InARow], &[InARow, NullLast]] {
            let observed = Subject { readings: Readings::of(readings), ..Subject::PUBLISHED };
            let bounds = Bounds { invariants: invariants.clone(), ..Bounds::new(observed, robots, walls) };
            let found = search(&bounds, &mut unwatched).expect("bounds that can be searched");
            let is_clean = found.complete && found.given_up == 0 && found.counterexamples.is_empty();
            assert!(is_clean && found.runs > 300, "{readings:?}: {found:?}");
        }
    }
}

/// All layouts of the paper's area in which a run meets at most so many walls.
const FEW_WALLS: [(i16, u32); 2] = [(3, 3), (4, 2)];

/// Whether an edge is open of which nobody knows yet: the oracle says which are walls, so many at most.
fn open_by(oracle: &mut dyn Oracle, most_walls: u32) -> impl FnMut(Edge) -> bool {
    let mut left = most_walls;
    move |_| {
        let is_wall = left > 0 && oracle.flip();
        left -= u32::from(is_wall);
        !is_wall
    }
}

/// Plays the published chain and one under `reading` side by side in these layouts; `takes_turn` says whether the other
/// one takes part in a team move of the published one.
fn play_along(reading: Reading, takes_turn: impl Fn(&PlainIntent) -> bool) {
    for (robots, most) in FEW_WALLS {
        let tally = exhaust(|oracle: &mut dyn Oracle| {
            let (mut published, mut other) = (chain(robots, &[]), chain(robots, &[reading]));
            let mut is_open = open_by(oracle, most);
            loop {
                let intent = plan(&mut published);
                let mut answers = Vec::new();
                published.settle(&intent, |edge| {
                    let is_open = is_open(edge);
                    answers.push((edge, is_open));
                    is_open
                });
                if takes_turn(&intent) {
                    require(plan(&mut other) == intent, "the same plan")?;
                    other.settle(&intent, |asked| answers.contains(&(asked, true)));
                    let mut obstacles = published.virtual_obstacles();
                    require(
                        other.virtual_obstacles().all(|edge| obstacles.next() == Some(edge)),
                        "obstacles",
                    )?;
                }
                require(published.cells() == other.cells(), "the same cells")?;
                if intent.steps().is_none() {
                    return Ok("an end");
                }
            }
        });
        assert_eq!(tally.violation, None, "{reading:?}");
        assert!(tally.cases > 1000, "{} runs", tally.cases);
    }
}

#[test]
fn a_candidate_is_refused_because_no_chain_follows_or_for_its_place_alone() {
    play_along(Unfollowed, |_| true);
}

/// The leader has a way to an unexplored cell when followers are asked, and they stand where the team has walked.
#[test]
fn a_follower_always_has_a_way_to_an_unexplored_cell() {
    play_along(Pathless, |_| true);
}

/// A team move in which nobody moved is taken back by one in which nobody moves.
#[test]
fn a_backtrack_of_a_blocked_team_move_changes_nothing() {
    let moves = |intent: &PlainIntent| match intent {
        PlainIntent::Backtrack(steps) => steps.iter().any(|&step| step != Step::Stay),
        PlainIntent::Advance(_) | PlainIntent::Explored | PlainIntent::Exhausted => true,
    };
    play_along(LastMoved, moves);
}

/// Three bits for the step and one for a wall.
const FOUR_BITS: u8 = 0b1111;

/// The messages that four bits confuse are those of an advance and a backtrack by the same step. So
/// who hears them knows where robots are and which walls they met; and who plans along knows the
/// rest, since the plan is the one or the other.
#[test]
fn four_bits_are_enough_for_one_who_plans_along() {
    let messages = Step::ALL.into_iter().flat_map(|step| {
        [Outcome::Arrived, Outcome::Blocked, Outcome::TookBack].map(|outcome| Message { step, outcome })
    });
    let messages: Vec<Message> =
        messages.filter(|message| Message::decode(message.encode()) == Ok(*message)).collect();
    assert_eq!(messages.len(), 14);
    let mut confused = 0;
    for (place, one) in messages.iter().enumerate() {
        for other in &messages[..place] {
            if one.encode() & FOUR_BITS == other.encode() & FOUR_BITS {
                let is_blocked = |message: &Message| message.outcome == Outcome::Blocked;
                assert_eq!((one.made(), is_blocked(one)), (other.made(), is_blocked(other)));
                confused += 1;
            }
        }
    }
    assert_eq!(confused, Step::ALL.len());
    for (robots, most) in FEW_WALLS {
        let tally = exhaust(|oracle: &mut dyn Oracle| {
            let (area, base) = area(robots);
            let grid = TinyGrid::new(area).ok_or(Stop::Assumed)?;
            let chain = Chain::<_, 4>::new(Rule::PUBLISHED, robots as usize, base, grid);
            let mut sender = chain.map_err(|_| Stop::Assumed)?;
            let (mut listener, mut log, mut restored) = (sender, Vec::new(), Vec::new());
            let mut is_open = open_by(oracle, most);
            loop {
                let (sent, heard) = (sender.plan(&log), listener.plan(&restored));
                require(sent == heard, "the same plan")?;
                let Ok(Intent::Go(plan)) = sent else { return Ok("an end") };
                let settled = sender.settle(&plan, &mut is_open);
                log.extend_from_slice(settled.messages());
                let backtrack =
                    Message { step: Step::Stay, outcome: Outcome::TookBack }.encode() & !FOUR_BITS;
                let fifth = if plan.kind == Kind::Backtrack { backtrack } else { 0 };
                let bytes: Vec<u8> = settled.messages().iter().map(|byte| byte & FOUR_BITS | fifth).collect();
                require(listener.hear(&plan, &bytes).is_ok() && listener == sender, "the same state")?;
                restored.extend(bytes);
            }
        });
        assert_eq!(tally.violation, None);
        assert!(tally.cases > 1000, "{} runs", tally.cases);
    }
}
