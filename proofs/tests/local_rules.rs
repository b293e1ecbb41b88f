//! A table of local rules, right ones and wrong ones, each decided for every number of robots: what comes out, the
//! invariant, and of the wrong ones the smallest team that breaks its promise, which is played again.

use tautline_kernel::chain::{Condition, Role, Rule};
use tautline_kernel::frontier::{Rule as FrontierRule, Stance};
use tautline_kernel::ground::{Cell, Side, Step};
use tautline_kernel::kit::{Condition as KitCondition, Rule as KitRule};
use tautline_proofs::chain::local::{Contact, Crowd};
use tautline_proofs::clause::{AnyCheck, Check, NamedRule};
use tautline_proofs::decide::{Cache, Method, Verdict};
use tautline_proofs::engine::Until;
use tautline_proofs::engine::tree::unwatched;
use tautline_proofs::frontier::local::Alone;
use tautline_proofs::frontier::world::Rim;
use tautline_proofs::kit::local::Two;
use tautline_proofs::local::{
    Act, EveryNumber, Far, GuardedPlanner, Invariant, Local, Plan, Robot, all_tuples,
};

use crate::local::decided_by;
use crate::refuted;

/// A line of the table.
fn line<R: Local>(name: &str, rule: &R) -> String {
    line_by(EveryNumber::DEFAULT, name, rule)
}

fn line_by<R: Local>(method: EveryNumber, name: &str, rule: &R) -> String {
    let (verdict, run, story) = decided_by(method, rule);
    let invariant = Invariant::of(rule).expect("a local rule");
    let (places, safe) = invariant.places;
    let (kept, cases, verdict) = (invariant.kept.len(), invariant.cases, verdict.word());
    let found = match run {
        Some((robots, steps)) => format!("{robots} robots, {steps} steps"),
        None => format!("{kept} of {safe} of {places}, {cases} cases"),
    };
    assert_eq!(run.is_some(), !story.is_empty(), "{name}");
    format!("{name:<38} {verdict:<8} {found}\n")
}

#[test]
fn the_conditions_of_the_chain_for_every_n() {
    let mut table = String::new();
    for (name, rule) in [("published", Rule::PUBLISHED), ("repaired", Rule::REPAIRED), ("reel", Rule::REEL)] {
        table += &line(&format!("contact, {name}"), &Contact::<false>(rule));
        table += &line(&format!("contact whoever fails, {name}"), &Contact::<true>(rule));
    }
    for condition in Condition::ALL {
        table += &line(
            &format!("contact without {condition:?}"),
            &Contact::<false>(Rule::REPAIRED.without(condition)),
        );
    }
    let crowd = |rule| Crowd::<1> { rule, roles: &[Role::Follower] };
    table += &line("crowding", &crowd(Rule::REPAIRED));
    for condition in [Condition::FullForFollower, Condition::Distinct] {
        table += &line(&format!("crowding without {condition:?}"), &crowd(Rule::REPAIRED.without(condition)));
    }
    insta::assert_snapshot!(table, @r"
    contact, published                     refuted  3 robots, 3 steps
    contact whoever fails, published       refuted  3 robots, 2 steps
    contact, repaired                      holds    13 of 13 of 25, 837 cases
    contact whoever fails, repaired        refuted  3 robots, 2 steps
    contact, reel                          holds    13 of 13 of 25, 789 cases
    contact whoever fails, reel            holds    13 of 13 of 25, 1734 cases
    contact without SafeAhead              refuted  3 robots, 2 steps
    contact without CoveredBehind          refuted  3 robots, 2 steps
    contact without Distinct               holds    13 of 13 of 25, 837 cases
    contact without RefusedIsVirtual       holds    13 of 13 of 25, 837 cases
    contact without EpochMustGain          holds    13 of 13 of 25, 837 cases
    contact without UnsureAhead            refuted  3 robots, 3 steps
    contact without FullForFollower        holds    13 of 13 of 25, 837 cases
    contact without FullForLeader          holds    13 of 13 of 25, 837 cases
    contact without Unfold                 holds    13 of 13 of 25, 837 cases
    contact without Hold                   holds    13 of 13 of 25, 837 cases
    contact without NoExchange             holds    13 of 13 of 25, 837 cases
    contact without PartsAtOnce            holds    13 of 13 of 25, 837 cases
    crowding                               holds    0 of 0 of 1, 405672 cases
    crowding without FullForFollower       refuted  3 robots, 2 steps
    crowding without Distinct              refuted  3 robots, 1 steps
    ");
}

#[test]
fn the_conditions_of_robots_that_keep_in_touch_for_every_n() {
    let touch = |name: &str, rule, of_nodes| {
        let two = EveryNumber { most_robots: 2, most_starts: 2, ..EveryNumber::DEFAULT };
        line_by(two, name, &Two { of_nodes, ..Two::in_contact(rule) })
    };
    let mut table = touch("contact", KitRule::REPAIRED, false);
    table += &touch("contact, promised of nodes", KitRule::REPAIRED, true);
    for condition in [KitCondition::FromInReach, KitCondition::NextInReach] {
        table +=
            &touch(&format!("contact without {condition:?}"), KitRule::REPAIRED.without(condition), false);
    }
    let apart = |rule, of_nodes| Two { of_nodes, ..Two::apart(rule) };
    table += &line("apart", &apart(KitRule::REPAIRED, false));
    table += &line("apart, promised of nodes", &apart(KitRule::REPAIRED, true));
    table += &line("apart without Apart", &apart(KitRule::REPAIRED.without(KitCondition::Apart), false));
    insta::assert_snapshot!(table, @r"
    contact                                holds    653 of 653 of 2025, 2637 cases
    contact, promised of nodes             holds    653 of 925 of 2025, 3397 cases
    contact without FromInReach            refuted  2 robots, 6 steps
    contact without NextInReach            refuted  2 robots, 4 steps
    apart                                  holds    552 of 552 of 625, 8176 cases
    apart, promised of nodes               holds    552 of 600 of 625, 8336 cases
    apart without Apart                    refuted  2 robots, 1 steps
    ");
}

#[test]
fn robots_among_frontier_cells_need_no_rim_unless_they_act_at_once() {
    let alone = Alone::of(FrontierRule::REPAIRED);
    let no_rim = Alone { is_met: |cell, at, stance| Rim::No.is_met(cell, at, stance), ..alone };
    let not_entering = Alone {
        is_met: |cell, at, stance| match stance {
            Stance::Enters(_) => cell == at,
            Stance::Stands | Stance::Tries(_) => Rim::Counts.is_met(cell, at, stance),
        },
        ..alone
    };
    let not_within =
        Alone { is_met: |cell, at, stance| cell != at && Rim::Counts.is_met(cell, at, stance), ..alone };
    let mut table = line("one at a time", &alone);
    table += &line("one at a time, the rim does not count", &no_rim);
    table += &line("entering does not count", &not_entering);
    table += &line("robots in a cell do not count", &not_within);
    table += &line("at once", &Alone { at_once: true, ..alone });
    table += &line("at once, the rim does not count", &Alone { at_once: true, ..no_rim });
    insta::assert_snapshot!(table, @r"
    one at a time                          holds    1864 of 1944 of 2025, 35040 cases
    one at a time, the rim does not count  holds    1864 of 1944 of 2025, 35088 cases
    entering does not count                refuted  2 robots, 9 steps
    robots in a cell do not count          refuted  2 robots, 3 steps
    at once                                holds    1864 of 1944 of 2025, 66592 cases
    at once, the rim does not count        refuted  2 robots, 6 steps
    ");
}

/// Plans of two robots that take steps.
type Plans<'a> = &'a [Plan<(), Step>];

/// A rule of two robots that take steps, as data.
#[derive(Clone, Copy)]
struct Own<const COLOURS: u8> {
    admits: fn(Plans<'_>) -> bool,
    keeps: fn(&[Robot<()>]) -> bool,
    reach: (i16, Far),
    /// Whether a robot may meet a wall.
    meets_walls: bool,
    /// The cell of a robot of so many.
    start: fn(usize, usize) -> Cell,
    tuples: fn(usize) -> Vec<Vec<usize>>,
}

impl<const COLOURS: u8> Local for Own<COLOURS> {
    type State = ();
    type Act = Step;

    fn colours(&self) -> u8 {
        COLOURS
    }

    fn states(&self) -> Vec<()> {
        vec![()]
    }

    fn acts(&self, (): ()) -> Vec<Act<(), Step>> {
        let mut acts = Act::steps(());
        if !self.meets_walls {
            for act in &mut acts {
                act.ends.truncate(1);
            }
        }
        acts
    }

    fn admits(&self, plans: Plans<'_>) -> bool {
        (self.admits)(plans)
    }

    fn keeps(&self, robots: &[Robot<()>]) -> bool {
        (self.keeps)(robots)
    }

    fn reach(&self) -> (i16, Far) {
        self.reach
    }

    fn may_start(&self, robots: &[Robot<()>]) -> bool {
        self.keeps(robots)
    }

    fn start(&self, robots: usize) -> Vec<Robot<()>> {
        (0..robots).map(|robot| Robot::new((self.start)(robot, robots), ())).collect()
    }

    fn is_sure(&self, _: Step) -> bool {
        !self.meets_walls
    }

    fn tuples(&self, robots: usize) -> Vec<Vec<usize>> {
        (self.tuples)(robots)
    }
}

fn steps(one: Cell, other: Cell) -> u16 {
    let (columns, rows) = one.apart(other);
    columns + rows
}

/// Each robot with the next one, and the last one with the first.
fn ring(robots: usize) -> Vec<Vec<usize>> {
    let pairs = (0..robots).map(|robot| vec![robot, (robot + 1) % robots]);
    pairs.filter(|pair| pair[0] != pair[1]).collect()
}

fn leash(admits: fn(Plans<'_>) -> bool) -> Own<1> {
    Own {
        admits,
        keeps: |robots| is_on_leash(robots[0].at, robots[1].at),
        reach: (2, Far::Broken),
        meets_walls: true,
        // In four cells, no two neighbours on the ring in one.
        start: |robot, robots| {
            let place = if robot + 1 == robots { robot.min(3) } else { robot % 3 };
            [(0, 0), (1, 0), (1, 1), (0, 1)].map(Cell::from)[place]
        },
        tuples: ring,
    }
}

fn is_on_leash(one: Cell, other: Cell) -> bool {
    (1..=2).contains(&steps(one, other))
}

fn of_goals(plans: Plans<'_>) -> bool {
    is_on_leash(plans[0].to(), plans[1].to())
}

fn of_cells_and_goals(plans: Plans<'_>) -> bool {
    let [one, other] = [&plans[0], &plans[1]];
    is_on_leash(one.robot.at, other.to()) && is_on_leash(one.to(), other.robot.at)
}

#[test]
fn robots_on_a_ring_keep_their_distance_if_they_look_at_cells_and_goals() {
    let mut table = line("leash", &leash(|plans| of_goals(plans) && of_cells_and_goals(plans)));
    table += &line("leash, of goals alone", &leash(of_goals));
    table += &line("leash, of goals and cells crosswise", &leash(of_cells_and_goals));
    let far = |plans: Plans<'_>| {
        let [one, other] = [&plans[0], &plans[1]];
        [one.robot.at, one.to()]
            .into_iter()
            .all(|one| [other.robot.at, other.to()].into_iter().all(|other| steps(one, other) <= 2))
    };
    table += &line("leash, cells may be shared", &leash(far));
    insta::assert_snapshot!(table, @r"
    leash                                  holds    12 of 12 of 25, 172 cases
    leash, of goals alone                  refuted  2 robots, 1 steps
    leash, of goals and cells crosswise    refuted  2 robots, 1 steps
    leash, cells may be shared             refuted  2 robots, 1 steps
    ");
}

#[test]
fn a_robot_that_is_sure_to_go_does_so_over_an_edge_alone_that_is_known_to_be_open() {
    let rule = Own { meets_walls: false, ..leash(|_| true) };
    let planner = |robots: &[Robot<()>]| {
        let east = rule.acts(()).into_iter().find(|act| act.step == Step::Cross(Side::East));
        vec![east.expect("an act"); robots.len()]
    };
    let (kept, team) = (GuardedPlanner { rule, planner }, rule.start(2));
    assert!(kept.plan(&team, |_| true, |_| 0).is_some());
    assert!(kept.plan(&team, |_| false, |_| 0).is_none());
}

/// Its promise is an invariant all the same: where nobody starts as the rule says, that says nothing.
#[test]
fn a_team_that_starts_with_a_broken_promise_is_refused() {
    let right = leash(|plans| of_goals(plans) && of_cells_and_goals(plans));
    let wrong = Own { start: |_, _| Cell::new(0, 0), ..right };
    let certificate = EveryNumber::DEFAULT.certificate(&wrong).expect("an answer");
    for error in
        [refuted::decide(&EveryNumber::DEFAULT, &wrong, Until::Exhausted).map(drop), certificate.map(drop)]
    {
        let error = error.expect_err("two robots are in one cell").to_string();
        assert!(error.contains("a team of 2 may not start so"), "{error}");
    }
}

fn in_a_row(robot: usize, _: usize) -> Cell {
    Cell::new(robot as i16, 0)
}

/// Robots of which no two plan to be in one cell, as planners for many robots have it (PIBT).
const NO_COLLISION: Own<1> = Own {
    admits: |plans| plans[0].to() != plans[1].to(),
    keeps: |robots| robots[0].at != robots[1].at,
    reach: (0, Far::Fine),
    meets_walls: false,
    start: in_a_row,
    tuples: |robots| all_tuples(robots, 2),
};

/// Doors are cells of the second colour.
const DOOR: u8 = 1;

/// Robots of which no two enter one door at once, nor one in which another one is.
const DOORS: Own<2> = Own {
    admits: |plans| {
        let may_enter = |own: &Plan<(), Step>, other: &Plan<(), Step>| {
            own.aims != DOOR || own.step == Step::Stay || own.to() != other.robot.at && own.to() != other.to()
        };
        may_enter(&plans[0], &plans[1]) && may_enter(&plans[1], &plans[0])
    },
    keeps: |robots| robots[0].on != DOOR || robots[0].at != robots[1].at,
    reach: (0, Far::Fine),
    meets_walls: true,
    start: in_a_row,
    tuples: |robots| all_tuples(robots, 2),
};

#[test]
fn rules_of_other_people_are_decided_as_well() {
    let mut table = line("no collision", &NO_COLLISION);
    table += &line("no collision, walls unknown", &Own { meets_walls: true, ..NO_COLLISION });
    table += &line("no collision, goals do not count", &Own { admits: |_| true, ..NO_COLLISION });
    table += &line("doors", &DOORS);
    let leaves = |plans: Plans<'_>| plans[0].aims != DOOR || plans[0].to() != plans[1].to();
    table += &line("doors, where others are does not count", &Own { admits: leaves, ..DOORS });
    let enters = |plans: Plans<'_>| {
        let is_free =
            |own: &Plan<(), Step>, other: &Plan<(), Step>| own.aims != DOOR || own.to() != other.robot.at;
        plans[0].step == Step::Stay || is_free(&plans[0], &plans[1])
    };
    table += &line("doors, goals of others do not count", &Own { admits: enters, ..DOORS });
    insta::assert_snapshot!(table, @r"
    no collision                           holds    0 of 0 of 1, 580 cases
    no collision, walls unknown            refuted  2 robots, 1 steps
    no collision, goals do not count       refuted  2 robots, 1 steps
    doors                                  holds    1 of 1 of 2, 865 cases
    doors, where others are does not count refuted  2 robots, 2 steps
    doors, goals of others do not count    refuted  2 robots, 2 steps
    ");
}

/// A robot raises a flag, which nobody is to see, if every other one is in the cell east of it. Two robots may start
/// so; of three one is elsewhere.
struct Flags<const LEAST: usize>;

impl<const LEAST: usize> Local for Flags<LEAST> {
    type State = bool;
    type Act = bool;

    fn least(&self) -> usize {
        LEAST
    }

    fn states(&self) -> Vec<bool> {
        vec![false, true]
    }

    fn acts(&self, is_up: bool) -> Vec<Act<bool, bool>> {
        let act =
            |raises| Act { act: raises, step: Step::Stay, ends: vec![(false, raises)], needs_open: false };
        if is_up { vec![act(true)] } else { vec![act(false), act(true)] }
    }

    fn admits(&self, plans: &[Plan<bool, bool>]) -> bool {
        let is_east = |own: Cell, other: Cell| other == Cell::new(own.x + 1, own.y);
        let may_raise = |own: &Plan<bool, bool>, other: &Plan<bool, bool>| {
            !own.act || is_east(own.robot.at, other.robot.at)
        };
        may_raise(&plans[0], &plans[1]) && may_raise(&plans[1], &plans[0])
    }

    fn keeps(&self, robots: &[Robot<bool>]) -> bool {
        robots[0].at != robots[1].at && robots.iter().all(|robot| !robot.state)
    }

    fn reach(&self) -> (i16, Far) {
        (1, Far::Broken)
    }

    fn may_start(&self, robots: &[Robot<bool>]) -> bool {
        robots.iter().all(|robot| robot.at.x.abs() <= 1 && robot.at.y.abs() <= 1) && self.keeps(robots)
    }

    fn start(&self, robots: usize) -> Vec<Robot<bool>> {
        let cells = [(0, 0), (0, 1), (1, 1), (1, 0)].map(Cell::from);
        cells.into_iter().take(robots).map(|cell| Robot::new(cell, false)).collect()
    }
}

#[test]
fn where_two_robots_are_too_coarse_three_are_looked_at_and_else_the_question_is_open() {
    // No five robots are each within a cell of all others.
    const FOUR: EveryNumber =
        EveryNumber { teams: "up to four robots", most_starts: 4, ..EveryNumber::DEFAULT };
    static OPEN: Check<Flags<2>> = Check::new(NamedRule::new("flags", Flags::<2>), &FOUR, Verdict::Open, &[]);
    assert_eq!(decided_by(FOUR, &Flags::<3>).0, Verdict::Holds);
    assert!(!Invariant::of(&Flags::<3>).expect("a local rule").holds());
    let decision = OPEN.decide(&mut Cache::default(), &mut unwatched).expect("a local rule");
    assert_eq!((decision.verdict, decision.counterexample), (Verdict::Open, None));
    insta::assert_snapshot!(decision.note.expect("what was found"),
        @"places of 2 robots are too coarse, and no run of up to 4 robots was found; as far as these places tell, \
          robots may go from 0,0 false | -1,0 false to 0,0 false | -1,0 true");
}
