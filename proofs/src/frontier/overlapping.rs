//! “Avoiding overlapping” (Rajesh, Nagaraja and Suja 2024) as double coverage: no robot enters as its frontier cell
//! what another one has entered before. It is no clause: FRONTIER-2 is the other reading, two robots in one cell.

use std::collections::BTreeMap;

use tautline_kernel::choice::Oracle;
use tautline_kernel::frontier::{Condition, Map, Rule, Sight, Status};
use tautline_kernel::ground::Cell;

use super::areas::{setting, words};
use super::clauses::TWO;
use super::readings::OF_TEAMS;
use super::world::{Event, Setting, Successor, World};
use crate::engine::states::{Findings, Limits, Run, System, search};
use crate::engine::world::{self, Turn};

/// The moment at which the cell ahead must be unexplored by the map of a robot that enters it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Moment {
    /// When the robot decides: the cell is its frontier cell.
    Decision,
    /// Still when it looks, at the rim of its own cell.
    Look,
}

/// A team whose robots enter no such cell that another one has entered before.
struct Overlap<const ROBOTS: usize>(Setting<ROBOTS>, Moment);

/// A team, and the robots that are on their way to their frontier cells, a bit for each.
type Team<const ROBOTS: usize> = (World<ROBOTS>, u8);

impl<const ROBOTS: usize> world::World for Overlap<ROBOTS> {
    type State = Team<ROBOTS>;
    type Plan = Vec<Successor<ROBOTS>>;
    type Event = usize;
    type Demand = Moment;

    fn plan(&self, (world, _): &mut Team<ROBOTS>, _: &[u8]) -> Option<Vec<Successor<ROBOTS>>> {
        world::any_of(self.0.turns(world))
    }

    fn settle(
        &self,
        (world, heading): &mut Team<ROBOTS>,
        turns: &Vec<Successor<ROBOTS>>,
        _: &mut Vec<u8>,
        oracle: &mut impl Oracle,
    ) -> usize {
        let number = oracle.pick(turns.len() as u32) as usize;
        match turns[number].event {
            Event::Decides(robot, side, ..) => {
                let known = &world.robots()[robot];
                let is_new = known.map.status(known.at().beyond(side)) == Status::Unexplored;
                *heading |= u8::from(is_new) << robot;
            }
            Event::Looks(robot, ..) => *heading &= !(1 << robot),
            Event::Arrives(..) | Event::Ticks => {}
        }
        *world = turns[number].world;
        number
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<Moment> {
        let is_double =
            entered(turn, self.1).is_some_and(|cell| turn.before.0.truth().status(cell) == Status::Explored);
        is_double.then_some(self.1).into_iter().collect()
    }

    fn covers(&self) -> Vec<&'static str> {
        vec![ENTERED]
    }

    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        entered(turn, Moment::Decision).is_some().into()
    }
}

/// The situation without which nothing is explored.
const ENTERED: &str = "a frontier cell is entered";

/// The cell that a robot enters in this step, if it was unexplored by the robot's map at that moment.
fn entered<const ROBOTS: usize>(turn: &Turn<'_, Overlap<ROBOTS>>, moment: Moment) -> Option<Cell> {
    let (before, heading) = turn.before;
    let Event::Looks(robot, side, Sight::Open, ..) = turn.plan[*turn.event].event else { return None };
    let known = &before.robots()[robot];
    let cell = known.at().beyond(side);
    let is_new = match moment {
        Moment::Decision => heading >> robot & 1 == 1,
        Moment::Look => known.map.status(cell) == Status::Unexplored,
    };
    is_new.then_some(cell)
}

impl<const ROBOTS: usize> System for Overlap<ROBOTS> {
    type Part = Team<ROBOTS>;

    fn part(&self, state: &Team<ROBOTS>, _: usize) -> Team<ROBOTS> {
        *state
    }

    fn put(&self, state: &mut Team<ROBOTS>, _: usize, part: &Team<ROBOTS>) {
        *state = *part;
    }
}

impl<const ROBOTS: usize> Overlap<ROBOTS> {
    fn findings(&self) -> Findings<Moment> {
        let starts = self.0.starts().into_iter().map(|world| (world, 0));
        let found = search(self, starts, Limits::NONE);
        assert!(found.is_whole && found.is_shortest, "the search was cut off, or found a longer run");
        found
    }

    /// The events of a run, a line for each.
    fn story(&self, run: &Run<Moment>) -> String {
        let mut world = self.0.starts()[run.start];
        let mut lines = vec![format!("R1 starts in {}, R2 in {}", world.cells()[0], world.cells()[1])];
        for &number in &run.steps {
            let turned = self.0.turns(&world).remove(number as usize);
            world = turned.world;
            lines.extend(match turned.event {
                Event::Decides(robot, _, aim, 0) => Some(format!("R{} decides for {aim}", robot + 1)),
                event => words(&event, &world.cells()),
            });
        }
        format!("  {}\n", lines.join("\n  "))
    }
}

/// Whether two robots of `rule` break this in the areas of two, at most so many of whose messages are lost, and the
/// smallest run in which they do: of the fewest cells, of these of the fewest obstacles, of these of the fewest steps.
fn decided(rule: Rule, max_losses: u8, moment: Moment) -> (String, String) {
    let mut explores = false;
    for (width, height) in TWO {
        let of = setting::<2>(rule, (width, height)).expect("a small area");
        let overlap = |max_obstacles| Overlap(Setting { max_obstacles, max_losses, ..of }, moment);
        let found = overlap(of.max_obstacles).findings();
        explores |= found.covered.contains(&ENTERED);
        if found.broken.is_empty() {
            continue;
        }
        for max_obstacles in 0..=of.max_obstacles {
            let overlap = overlap(max_obstacles);
            if let Some(run) = overlap.findings().broken.first() {
                let verdict = format!("{width}×{height}, {max_obstacles} obstacles, {} steps", run.length());
                return (verdict, overlap.story(run));
            }
        }
    }
    let verdict = if explores { "holds" } else { "no robot enters a frontier cell" };
    (verdict.to_owned(), String::new())
}

/// Two robots that explore anything explore one cell twice: in 3×1 cells, or in 3×2 where they see each other and stop
/// without a candidate.
#[test]
fn two_robots_enter_one_frontier_cell_under_every_reading_under_which_they_enter_any() {
    let mut by_verdict: BTreeMap<(String, String), Vec<&str>> = BTreeMap::new();
    for (name, rule) in [("published", Rule::PUBLISHED)].into_iter().chain(OF_TEAMS) {
        by_verdict.entry(decided(rule, 0, Moment::Decision)).or_default().push(name);
    }
    let table = by_verdict.into_iter().map(|((verdict, story), names)| {
        let lines: Vec<String> = names.chunks(2).map(|names| names.join(", ")).collect();
        format!("{verdict}: {} readings\n{story}  {}\n", names.len(), lines.join(",\n  "))
    });
    insta::assert_snapshot!(table.collect::<String>(), @r"
    3×1, 0 obstacles, 4 steps: 8 readings
      R1 starts in 0,0, R2 in 2,0
      R1 decides for 1,0
      R1 goes east
      R2 decides for 1,0
      R2 goes west
      published, wanders,
      literal, wanders + literal,
      adaptive, wanders + adaptive,
      literal + adaptive, wanders + literal + adaptive
    3×1, 0 obstacles, 8 steps: 4 readings
      R1 starts in 0,0, R2 in 2,0
      R1 decides for 1,0
      R1 goes east
      R2 decides for 1,0
      R1 arrives in 1,0
      R1 decides for 0,0
      R1 goes west
      R1 arrives in 0,0
      R2 goes west
      wanders + sees, wanders + literal + sees,
      wanders + adaptive + sees, wanders + literal + adaptive + sees
    3×2, 0 obstacles, 11 steps: 2 readings
      R1 starts in 0,0, R2 in 0,1
      R1 decides for 1,0
      R1 goes east
      R2 decides for 1,1
      R2 goes east
      R2 arrives in 1,1
      R2 decides for 1,0
      R1 arrives in 1,0
      R1 decides for 2,0
      R1 goes east
      R1 arrives in 2,0
      R2 goes north
      adaptive + sees, literal + adaptive + sees
    3×2, 0 obstacles, 8 steps: 2 readings
      R1 starts in 0,0, R2 in 2,0
      R1 decides for 1,0
      R1 goes east
      R2 decides for 1,0
      R1 arrives in 1,0
      R1 decides for 1,1
      R1 goes south
      R1 arrives in 1,1
      R2 goes west
      sees, literal + sees
    no robot enters a frontier cell: 16 readings
      printed, wanders + printed,
      literal + printed, wanders + literal + printed,
      printed + adaptive, wanders + printed + adaptive,
      literal + printed + adaptive, wanders + literal + printed + adaptive,
      printed + sees, wanders + printed + sees,
      literal + printed + sees, wanders + literal + printed + sees,
      printed + adaptive + sees, wanders + printed + adaptive + sees,
      literal + printed + adaptive + sees, wanders + literal + printed + adaptive + sees
    ");
}

/// Robots that are told while they are at the rim of their cell go on, *plain* and *repaired* ones as well.
#[test]
fn robots_with_look_enter_one_frontier_cell_though_their_maps_say_so_by_then() {
    let mut table = Vec::new();
    for (name, rule) in [("plain", Rule::PLAIN), ("repaired", Rule::REPAIRED)] {
        let (verdict, story) = decided(rule, 0, Moment::Decision);
        table.push(format!("{name}: {verdict}\n{story}"));
        for max_losses in 0.. {
            let (verdict, story) = decided(rule, max_losses, Moment::Look);
            table.push(format!("{name} by the map at the look, {max_losses} lost: {verdict}\n{story}"));
            if !story.is_empty() {
                break;
            }
        }
        let (verdict, _) = decided(rule.without(Condition::Look), 0, Moment::Look);
        table.push(format!("{name} by the map at the look, without Look: {verdict}\n"));
    }
    insta::assert_snapshot!(table.concat(), @r"
    plain: 4×1, 0 obstacles, 8 steps
      R1 starts in 0,0, R2 in 2,0
      R2 decides for 1,0
      R2 goes west
      R1 decides for 1,0
      R2 arrives in 1,0
      R2 decides for 3,0
      R2 goes east
      R2 arrives in 2,0
      R1 goes east
    plain by the map at the look, 0 lost: holds
    plain by the map at the look, 1 lost: holds
    plain by the map at the look, 2 lost: 4×1, 0 obstacles, 8 steps
      R1 starts in 0,0, R2 in 2,0
      R2 decides for 1,0
      R2 goes west
      R1 decides for 1,0
      R2 arrives in 1,0; R1 misses the message
      R2 decides for 3,0
      R2 goes east
      R2 arrives in 2,0; R1 misses the message
      R1 goes east
    plain by the map at the look, without Look: 3×1, 0 obstacles, 4 steps
    repaired: 5×1, 0 obstacles, 8 steps
      R1 starts in 2,0, R2 in 4,0
      R1 decides for 3,0
      R1 goes east
      R2 decides for 3,0
      R1 arrives in 3,0
      R1 decides for 1,0
      R1 goes west
      R1 arrives in 2,0
      R2 goes west
    repaired by the map at the look, 0 lost: holds
    repaired by the map at the look, 1 lost: holds
    repaired by the map at the look, 2 lost: holds
    repaired by the map at the look, 3 lost: 4×1, 0 obstacles, 11 steps
      R1 starts in 0,0, R2 in 1,0
      R1 decides for 2,0
      R2 decides for 2,0
      R2 goes east
      R2 arrives in 2,0; R1 misses the message
      R1 goes east
      R1 arrives in 1,0
      R1 decides for 2,0
      R2 claims 3,0; R1 misses the message
      R2 goes east
      R2 arrives in 3,0; R1 misses the message
      R1 goes east
    repaired by the map at the look, without Look: 3×1, 0 obstacles, 4 steps
    ");
}

#[test]
fn robots_that_see_each_other_enter_nothing_twice_that_their_maps_have_for_unexplored_at_the_look() {
    let broken = |is_wanted: fn(&Rule) -> bool| {
        let rules = [Rule::PUBLISHED].into_iter().chain(OF_TEAMS.map(|(_, rule)| rule)).filter(is_wanted);
        rules.filter(|&rule| !decided(rule, 0, Moment::Look).1.is_empty()).count()
    };
    assert_eq!(broken(|rule| rule.has(Condition::Look)), 0);
    assert_eq!(broken(|rule| !rule.has(Condition::Look)), 8);
}
