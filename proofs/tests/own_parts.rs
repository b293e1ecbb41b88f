//! The parts of which a stranger's surroundings are put together, each with a rule that holds and one that does not:
//! blocked cells, goals, starts, sight, who acts when, lost messages, robots that die, and eventually under weak
//! fairness. Where a question can be asked of a tree and of the states, both say the same.

use tautline_kernel::ground::{Cell, Edge, Side};
use tautline_proofs::decide::{Answer, Depiction, Method, Verdict};
use tautline_proofs::engine::states;
use tautline_proofs::engine::world::play;
use tautline_proofs::engine::{Outcome, SeededOracle, Stop, Until};
use tautline_proofs::run::Run;
use tautline_proofs::team::{
    Act, Demand, Ground, Keeps, Map, Moves, Places, Promise, Rule, Scene, Senses, Setting, Strategy, View,
    Which,
};

use crate::exhausted::certify;
use crate::refuted::decide;

fn decided<R: Rule + PartialEq + 'static>(
    rule: &R,
    setting: &'static Setting<'static, R>,
    demand: usize,
) -> Answer {
    let keeps = Keeps(setting, demand);
    let answer = decide(&keeps, rule, Until::Exhausted).expect("it can be decided");
    certify(&keeps, rule, answer.verdict);
    if let Some(found) = &answer.counterexample {
        let played = keeps.replay(rule, &found.choices).expect("it can be played again");
        assert_eq!(played.evidence, *found);
    }
    answer
}

fn verdict<R: Rule + PartialEq + 'static>(
    rule: &R,
    setting: &'static Setting<'static, R>,
    demand: usize,
) -> Verdict {
    decided(rule, setting, demand).verdict
}

fn starts<R: Rule>(setting: &Setting<'_, R>, rule: &R) -> Vec<Scene<R>> {
    setting.starts(rule).expect("they can be made").into_iter().collect()
}

fn run(answer: Answer) -> Run {
    match answer.counterexample.map(|found| found.seen) {
        Some(Depiction::Robots(run)) => *run,
        _ => panic!("robots that move"),
    }
}

/// Robots that each walk to their goal: straight, or round about by the cells that are free, or never where another
/// robot is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Walk {
    /// By column, then by row, whatever stands there.
    Blind,
    /// Only into a cell in which it sees nobody.
    Polite,
    /// As politely, and with a step aside where another robot is in the way and has a smaller number.
    Yielding,
}

impl Rule for Walk {
    type Memory = ();
    type Message = ();

    fn start(&self, _: usize, _: &[Cell]) {}

    fn act(&self, view: &mut View<'_, Self>, (): &mut ()) -> Act {
        let (cell, goal) = (view.cell(), view.goal().expect("robots have goals"));
        let side = match (goal.x - cell.x, goal.y - cell.y) {
            (1.., _) => Side::East,
            (..=-1, _) => Side::West,
            (0, 1..) => Side::South,
            (0, ..=-1) => Side::North,
            (0, 0) => return Act::Wait,
        };
        let in_the_way = |view: &View<'_, Self>, side: Side| {
            (0..view.robots()).find(|&other| view.sees(other) == Some(cell.beyond(side)))
        };
        match (self, in_the_way(view, side)) {
            (Self::Blind, _) | (_, None) => Act::Go(side),
            (Self::Yielding, Some(other)) if other < view.me() => {
                let mut aside = Side::ALL.into_iter().filter(|&side| {
                    in_the_way(view, side).is_none() && view.is_open(cell, side) == Some(true)
                });
                aside.next().map_or(Act::Wait, Act::Go)
            }
            _ => Act::Wait,
        }
    }

    fn is_done(&self, _: usize, scene: &Scene<Self>) -> bool {
        (0..scene.robots()).all(|robot| Some(scene.cell(robot)) == scene.goal(robot))
    }
}

const ALONE: Demand<'static, Walk> =
    Demand::always("WALK-1", "no two robots are in one cell", &|moved| moved.after.cells_differ());
const ARRIVES: Demand<'static, Walk> =
    Demand::eventually("WALK-2", "all are at their goals at some time", &|scene| {
        (0..scene.robots()).all(|robot| Some(scene.cell(robot)) == scene.goal(robot))
    });

const fn to_goals(width: i16, height: i16, moves: Moves) -> Setting<'static, Walk> {
    let setting = Setting::new("walk", Ground::open(width, height), 2, Places::Distinct);
    Setting { goals: Places::Distinct, senses: Senses::ALL, moves, demands: &[ALONE, ARRIVES], ..setting }
}

static LANE: Setting<'static, Walk> = to_goals(3, 1, Moves::OneAtATime);
static LANE_TOGETHER: Setting<'static, Walk> = to_goals(3, 1, Moves::Together);
static LANE_LOOKING: Setting<'static, Walk> = to_goals(3, 1, Moves::LookThenMove);
static LANE_SUBSETS: Setting<'static, Walk> = to_goals(3, 1, Moves::AnySubset);

#[test]
fn robots_that_act_one_at_a_time_and_look_never_meet_and_those_that_act_together_do() {
    assert_eq!(verdict(&Walk::Blind, &LANE, 0), Verdict::Refuted);
    assert_eq!(verdict(&Walk::Polite, &LANE, 0), Verdict::Holds);
    for setting in [&LANE_TOGETHER, &LANE_LOOKING, &LANE_SUBSETS] {
        let found = run(decided(&Walk::Polite, setting, 0));
        assert_eq!(found.frames.last().map(|frame| frame.cells[0] == frame.cells[1]), Some(true));
    }
}

/// In a lane two polite robots that have to pass each other wait for ever: a deadlock, of which no robot acts wrongly.
#[test]
fn polite_robots_do_not_pass_each_other_in_a_lane() {
    let found = decided(&Walk::Polite, &LANE, 1);
    assert_eq!(found.verdict, Verdict::Refuted);
    assert!(!found.counterexample.expect("a deadlock").choices.again.is_empty(), "it goes on for ever");
}

/// A passing place: a row of three with one cell beside it, in every layout of 3×2 cells with two blocked cells that is
/// connected.
static BAYS: Setting<'static, Walk> = {
    let ground =
        Ground::open(3, 2).obstacles(Which::Any(2)).assume("all cells are connected", Map::is_connected);
    Setting { ground, ..to_goals(3, 2, Moves::OneAtATime) }
};

static LOOPS: Setting<'static, Walk> = {
    let ground =
        Ground::open(3, 3).obstacles(Which::Any(1)).assume("all cells are biconnected", Map::is_biconnected);
    Setting { ground, ..to_goals(3, 3, Moves::OneAtATime) }
};

#[test]
fn blocked_cells_are_a_quantifier_and_so_are_layouts_of_a_kind() {
    assert_eq!(verdict(&Walk::Polite, &BAYS, 0), Verdict::Holds);
    let blind = run(decided(&Walk::Blind, &BAYS, 0));
    assert!(blind.obstacles.is_empty(), "the layout with the fewest blocked cells comes first: {blind:?}");
    // Without a cell, or without one of the four in the corners or none at all, 3×3 cells stay biconnected: the ring
    // without its centre, and with a corner cut off.
    let layouts: Vec<Vec<Cell>> =
        starts(&LOOPS, &Walk::Polite).iter().filter_map(|scene| scene.map().map(Map::obstacles)).collect();
    let mut kinds = layouts.clone();
    kinds.dedup();
    assert_eq!(kinds.len(), 1 + 4 + 1);
    // Nine cells, or eight: two robots apart, and two goals apart.
    assert_eq!(layouts.len(), (9 * 8) * (9 * 8) + 5 * (8 * 7) * (8 * 7));
}

static NOWHERE: Setting<'static, Walk> = Setting {
    ground: Ground::open(2, 1).assume("there is none", |_| false),
    ..to_goals(2, 1, Moves::OneAtATime)
};

#[test]
fn a_quantifier_over_nothing_is_open() {
    assert_eq!(verdict(&Walk::Polite, &NOWHERE, 0), Verdict::Open);
}

/// A robot that knows the way tells the other one, which sets out when it has heard.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Teller {
    Once,
    Again,
}

impl Rule for Teller {
    type Memory = (bool, bool);
    type Message = Side;

    fn start(&self, robot: usize, _: &[Cell]) -> (bool, bool) {
        (robot == 0, false)
    }

    fn act(&self, view: &mut View<'_, Self>, (knows, has_told): &mut (bool, bool)) -> Act {
        if view.me() == 0 {
            if *self == Self::Again || !*has_told {
                view.tell(Side::East);
                *has_told = true;
            }
            return Act::Wait;
        }
        match view.heard() {
            [(0, side)] if !*knows => {
                let side = *side;
                *knows = true;
                Act::Go(side)
            }
            _ => Act::Wait,
        }
    }

    fn is_done(&self, _: usize, scene: &Scene<Self>) -> bool {
        scene.memory(1).0
    }
}

const SETS_OUT: Demand<'static, Teller> =
    Demand::eventually("TELL-1", "the second robot sets out", &|scene: &Scene<Teller>| scene.memory(1).0);

const fn telling(losses: u32, deaths: u32) -> Setting<'static, Teller> {
    let corner = Places::At(|_: &Teller| vec![Cell::new(0, 0); 2]);
    let setting = Setting::new("teller", Ground::open(3, 1), 2, corner);
    Setting { moves: Moves::OneAtATime, losses, deaths, demands: &[SETS_OUT], ..setting }
}

static ALL_ARRIVE: Setting<'static, Teller> = telling(0, 0);
static TWO_LOST: Setting<'static, Teller> = telling(2, 0);
static ONE_DIES: Setting<'static, Teller> = telling(0, 1);

#[test]
fn a_lost_message_must_be_sent_again_and_a_dead_robot_sends_none() {
    assert_eq!(verdict(&Teller::Once, &ALL_ARRIVE, 0), Verdict::Holds);
    assert_eq!(verdict(&Teller::Once, &TWO_LOST, 0), Verdict::Refuted);
    assert_eq!(verdict(&Teller::Again, &TWO_LOST, 0), Verdict::Holds);
    assert_eq!(verdict(&Teller::Again, &ONE_DIES, 0), Verdict::Refuted);
}

#[test]
fn a_demand_reads_what_robots_have_heard_and_which_move_is_pending() {
    static HEARS: Setting<'static, Teller> = Setting {
        demands: &[Demand::always("TELL-2", "nobody hears", &|moved| moved.after.heard(1).is_empty())],
        ..telling(0, 0)
    };
    const NONE_PENDING: Demand<'static, Walk> =
        Demand::always("WALK-3", "no move is pending", &|moved| moved.after.pending(0).is_none());
    static LOOKS: Setting<'static, Walk> =
        Setting { demands: &[NONE_PENDING], ..to_goals(3, 1, Moves::LookThenMove) };
    static GOES: Setting<'static, Walk> =
        Setting { demands: &[NONE_PENDING], ..to_goals(3, 1, Moves::OneAtATime) };
    assert_eq!(verdict(&Teller::Once, &HEARS, 0), Verdict::Refuted);
    assert_eq!(verdict(&Walk::Blind, &LOOKS, 0), Verdict::Refuted);
    assert_eq!(verdict(&Walk::Blind, &GOES, 0), Verdict::Holds);
}

/// Robots that go round a wall on their right hand, any number of them, from any cell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Sweeper;

impl Rule for Sweeper {
    type Memory = Side;
    type Message = ();

    fn start(&self, _: usize, _: &[Cell]) -> Side {
        Side::East
    }

    fn act(&self, view: &mut View<'_, Self>, heading: &mut Side) -> Act {
        if view.was_blocked() {
            *heading = heading.turned_right();
        }
        Act::Go(*heading)
    }
}

const WEST_OF_THE_EDGE: Demand<'static, Sweeper> =
    Demand::always("SWEEP-1", "it stays out of the last column", &|moved| moved.after.cell(0).x < 2);
const ENDS: Demand<'static, Sweeper> = Demand::never_endless("SWEEP-2", "no run goes on for ever");

const fn sweeping(moves: Moves, most: u32) -> Setting<'static, Sweeper> {
    let ground = Ground::open(3, 2).walls(Which::Met(most)).obstacles(Which::Met(1));
    let corner = Places::At(|_: &Sweeper| vec![Cell::new(0, 0)]);
    Setting { moves, demands: &[WEST_OF_THE_EDGE, ENDS], ..Setting::new("sweeper", ground, 1, corner) }
}

static SWEPT: Setting<'static, Sweeper> = sweeping(Moves::Together, 2);
static SWEPT_AS_STATES: Setting<'static, Sweeper> = sweeping(Moves::OneAtATime, 2);

#[test]
fn a_tree_and_the_states_say_the_same() {
    assert_eq!((SWEPT.strategy(), SWEPT_AS_STATES.strategy()), (Strategy::Tree, Strategy::States));
    for demand in [0, 1] {
        let (tree, states) = (decided(&Sweeper, &SWEPT, demand), decided(&Sweeper, &SWEPT_AS_STATES, demand));
        assert_eq!(tree.verdict, Verdict::Refuted);
        assert_eq!(states.verdict, tree.verdict);
        let (tree, states) = (run(tree), run(states));
        assert!(tree.walls.len() + tree.obstacles.len() <= states.walls.len() + states.obstacles.len());
        assert!(states.frames.len() <= tree.frames.len());
    }
}

/// A robot that waits, goes round four cells, and is done where it knows that the first way south is open.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Tour;

const GATE: Edge = Edge::new(Cell::new(0, 0), Side::South);

impl Rule for Tour {
    type Memory = usize;
    type Message = ();

    fn start(&self, _: usize, _: &[Cell]) -> usize {
        0
    }

    fn act(&self, _: &mut View<'_, Self>, acts: &mut usize) -> Act {
        let ahead = [Side::East, Side::South, Side::West, Side::North];
        let waits = 32;
        *acts = if *acts < waits { *acts + 1 } else { waits + (*acts + 1 - waits) % ahead.len() };
        acts.checked_sub(waits).map_or(Act::Wait, |place| Act::Go(ahead[(place + 3) % 4]))
    }

    fn is_done(&self, _: usize, scene: &Scene<Self>) -> bool {
        scene.cell(0) == Cell::new(1, 0) && scene.map().is_some_and(|map| map.edge(GATE) == Some(true))
    }
}

const AT_HOME: Demand<'static, Tour> =
    Demand::at_the_end("T-1", "it ends at home", &|scene| scene.cell(0) == Cell::new(0, 0));
const TOUR_ENDS: Demand<'static, Tour> = Demand::never_endless("T-2", "it ends");

const fn touring(moves: Moves) -> Setting<'static, Tour> {
    let ground = Ground::open(2, 2).walls(Which::Met(1));
    let corner = Places::At(|_: &Tour| vec![Cell::new(0, 0)]);
    let demands = &[AT_HOME, TOUR_ENDS];
    Setting { moves, longest_run: 1000, demands, ..Setting::new("tour", ground, 1, corner) }
}

static TOUR: Setting<'static, Tour> = touring(Moves::Together);
static TOUR_AS_STATES: Setting<'static, Tour> = touring(Moves::OneAtATime);

/// A team that comes back and has met more of the layout is not where it was. Before, a search of the tree took the
/// robot that came back for one that goes on for ever, although it knew more than when it was there first.
#[test]
fn a_robot_that_comes_back_and_knows_more_of_the_layout_does_not_go_round() {
    assert_eq!((TOUR.strategy(), TOUR_AS_STATES.strategy()), (Strategy::Tree, Strategy::States));
    for setting in [&TOUR, &TOUR_AS_STATES] {
        assert_eq!(verdict(&Tour, setting, 0), Verdict::Refuted);
    }
    let rounds = [&TOUR, &TOUR_AS_STATES].map(|setting| run(decided(&Tour, setting, 1)).walls.len());
    assert_eq!(rounds, [1, 1], "without a wall it ends");
}

/// Robots that go to the middle of three cells, until somebody is there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Seat;

const SEAT: Cell = Cell::new(1, 0);

impl Rule for Seat {
    type Memory = ();
    type Message = ();

    fn start(&self, _: usize, _: &[Cell]) {}

    fn act(&self, view: &mut View<'_, Self>, (): &mut ()) -> Act {
        let is_taken = (0..view.robots()).any(|other| view.sees(other) == Some(SEAT));
        let side = if view.cell().x < SEAT.x { Side::East } else { Side::West };
        if is_taken || view.cell() == SEAT { Act::Wait } else { Act::Go(side) }
    }

    fn is_done(&self, _: usize, scene: &Scene<Self>) -> bool {
        scene.cells().any(|cell| cell == SEAT)
    }
}

const NO_TWO: Demand<'static, Seat> =
    Demand::always("S-1", "no two robots are in one cell", &|moved| moved.after.cells_differ());

const fn seating(moves: Moves) -> Setting<'static, Seat> {
    let ends = Places::At(|_: &Seat| vec![Cell::new(0, 0), Cell::new(2, 0)]);
    let setting = Setting::new("seat", Ground::open(3, 1), 2, ends);
    Setting { senses: Senses::TEAM, moves, demands: &[NO_TWO], ..setting }
}

static SEATS: [Setting<'static, Seat>; 3] =
    [seating(Moves::Together), seating(Moves::AnySubset), seating(Moves::LookThenMove)];

/// Whatever robots can do together they can do when they look and move at times of their own. Before, the second one
/// forgot its move when the first one came in.
#[test]
fn a_robot_that_has_looked_moves_although_nothing_is_left_to_do() {
    for setting in &SEATS {
        assert_eq!(verdict(&Seat, setting, 0), Verdict::Refuted, "{:?}", setting.moves);
    }
}

/// Every way to put a blocked cell that the robot meets is one that it could have met from the start.
#[test]
fn what_is_decided_as_it_is_met_is_what_is_decided_before() {
    static MET: Setting<'static, Walk> = Setting {
        ground: Ground::open(3, 2).obstacles(Which::Met(1)),
        starts: Places::At(|_: &Walk| vec![Cell::new(0, 0), Cell::new(0, 1)]),
        goals: Places::At(|_: &Walk| vec![Cell::new(2, 0), Cell::new(2, 1)]),
        ..to_goals(3, 2, Moves::OneAtATime)
    };
    static ANY: Setting<'static, Walk> = Setting {
        ground: Ground::open(3, 2)
            .obstacles(Which::Any(1))
            .assume("all cells are connected", Map::is_connected),
        starts: Places::At(|_: &Walk| vec![Cell::new(0, 0), Cell::new(0, 1)]),
        goals: Places::None,
        ..to_goals(3, 2, Moves::OneAtATime)
    };
    assert_eq!(verdict(&Walk::Yielding, &MET, 1), Verdict::Refuted);
    assert!(ANY.starts(&Walk::Yielding).is_err(), "a blocked cell can stand where a robot starts");
}

#[test]
fn robots_are_as_many_as_are_asked_for() {
    for (robots, scenes) in [(1, 3), (2, 3 * 2), (3, 3 * 2)] {
        let setting = Setting { robots, goals: Places::None, ..to_goals(3, 1, Moves::OneAtATime) };
        assert_eq!(starts(&setting, &Walk::Polite).len(), scenes);
    }
    let none = Setting { robots: 0, ..to_goals(3, 1, Moves::OneAtATime) };
    let refused = none.starts(&Walk::Polite).err().expect("no robots");
    assert_eq!(refused.to_string(), "a team has 1 to 16 robots, not 0");
}

/// One world is a body: of a property, of a fuzz target, of a harness.
#[test]
fn a_world_is_a_body() {
    let outcome = |rule: Walk, seed: u64| -> Outcome {
        let playing = LANE.playing(&rule, &[Promise(0)]).expect("it can be played");
        let starts = starts(&LANE, &rule);
        let mut answers = SeededOracle::new(seed, 0);
        let start = starts[seed as usize % starts.len()].clone();
        play(&playing, start, 50, &mut answers, |promise| playing.demand(promise).words)
    };
    assert!(
        (0..200)
            .any(|seed| outcome(Walk::Blind, seed) == Err(Stop::Violated("no two robots are in one cell")))
    );
    assert!((0..200).all(|seed| matches!(outcome(Walk::Polite, seed), Ok(_) | Err(Stop::GivenUp))));
}

/// States that are the same are gone on from once, so there are at most so many as places and memories.
#[test]
fn ways_that_lead_to_the_same_merge() {
    let playing = LANE.playing(&Walk::Polite, &[Promise(0)]).expect("it can be played");
    let starts = starts(&LANE, &Walk::Polite);
    let found = states::search(&playing, starts.clone(), states::Limits::NONE);
    assert!(found.is_whole && found.states <= (starts.len() * 4) as u64, "{found:?}");
}
