//! Runs of robots that explore cells, by the plain rule and by the repaired one, in drawn layouts: who might have acted
//! in each state and what was done, and what each robot knows at the end.

use tautline_kernel::frontier::{Condition, Map, Robot, Rule, Sight, Stance, Status, TinyMap};
use tautline_kernel::ground::{Area, Cell};
use tautline_proofs::frontier::areas::setting;
use tautline_proofs::frontier::world::{Event, Setting, Successor, World};

use super::term::{definition, list};
use crate::draw::Draw;

const KIND: &str = "list ((nat * nat * nat) * list nat * list nat * list (list (nat * nat) * bool * event nat)\n  \
                    * list (list nat * list nat * nat))";

const ENDLESS: &str = "(nat * nat * nat) * list nat * list nat * list (list (nat * nat) * bool * event nat)\n  \
                       * list (list (nat * nat) * bool * event nat)";

/// The situations that a set of runs must contain for the comparison to mean something.
#[derive(Default)]
struct Situations {
    obstacles: usize,
    meetings: usize,
    slots: usize,
    missed: usize,
    wrong: usize,
    returns: usize,
}

/// Of each rule's runs: robots, columns and rows; the obstacles and the starts; of each step the first
/// cells to which robots might have gone, whether a slot might have been over, and the event; and the
/// map and the cell of each robot at the end.
pub(super) fn terms() -> String {
    let rules = [("PLAIN", Rule::PLAIN), ("REPAIRED", Rule::REPAIRED)];
    let terms = rules.map(|(name, rule)| {
        let (mut draw, mut met) = (Draw(2024), Situations::default());
        let mut runs = vec![run::<1>(rule, (3, 3), &mut draw, &mut met)];
        runs.push(run::<2>(rule, (3, 2), &mut draw, &mut met));
        runs.push(run::<3>(rule, (3, 2), &mut draw, &mut met));
        runs.push(run::<4>(rule, (3, 2), &mut draw, &mut met));
        runs.push(run::<2>(rule, (3, 3), &mut draw, &mut met));
        runs.push(run::<3>(rule, (3, 3), &mut draw, &mut met));
        runs.extend((0..6).map(|_| run::<3>(rule, (5, 1), &mut draw, &mut met)));
        runs.extend((0..4).map(|_| run::<3>(rule, (4, 2), &mut draw, &mut met)));
        let Situations { obstacles, meetings, slots, missed, wrong, .. } = met;
        assert!(
            obstacles > 10 && meetings > 10 && slots > 5 && missed > 5 && wrong > 3,
            "{obstacles} {meetings} {slots} {missed} {wrong}"
        );
        runs.push(with_a_return(rule, &mut met));
        if rule.has(Condition::Keep) {
            runs.push(with_an_end());
        }
        definition(&format!("runs_{name}"), KIND, &list(runs))
    });
    format!("From Tautline Require Import Explorers.\n{}", terms.concat())
}

fn run<const ROBOTS: usize>(rule: Rule, size: (i16, i16), draw: &mut Draw, met: &mut Situations) -> String {
    let setting = setting::<ROBOTS>(rule, size).expect("a small area");
    let mut cells: Vec<Cell> = setting.area.cells().collect();
    let mut drawn = || cells.swap_remove(draw.below(cells.len() as u64) as usize);
    let starts: [Cell; ROBOTS] = std::array::from_fn(|_| drawn());
    let obstacles = [drawn(), drawn()];
    let mut given = TinyMap::new(setting.area).expect("a small area");
    for cell in obstacles {
        given.learn(cell, Status::Obstacle);
    }
    let setting = Setting { given: Some(given), max_losses: 3, max_wrong: 1, ..setting };
    story(&setting, (starts, &obstacles), met, |_, turns| draw.below(turns.len() as u64) as usize)
}

/// A run from these starts among these obstacles, in which of the turns that there are this one is taken.
fn story<const ROBOTS: usize>(
    setting: &Setting<ROBOTS>,
    (starts, obstacles): ([Cell; ROBOTS], &[Cell]),
    met: &mut Situations,
    mut taken: impl FnMut(&World<ROBOTS>, &[Successor<ROBOTS>]) -> usize,
) -> String {
    let number = |cell: Cell| setting.area.place(cell).expect("it is inside").to_string();
    let mut world = setting.start(starts).expect("a small area");
    let mut steps = Vec::new();
    loop {
        let turns: Vec<Successor<ROBOTS>> =
            setting.turns(&world).into_iter().filter(|turn| !is_unclear(&world, &turn.event)).collect();
        if turns.is_empty() {
            break;
        }
        let turn = &turns[taken(&world, &turns)];
        assert!(turn.breaks.is_empty(), "{turn:?}");
        steps.push(step(&world, &turns, turn, number, met));
        world = turn.world;
    }
    let end = world.robots().map(|robot| knows(setting.area, &robot));
    let (columns, rows) = (setting.area.width(), setting.area.height());
    let (starts, steps) = (list(starts.map(number)), list(steps));
    let obstacles = list(obstacles.iter().copied().map(number));
    format!("\n (({ROBOTS},{columns},{rows}),{obstacles},{starts},\n  {steps},\n  {})", list(end))
}

/// The first cells to which robots might have gone, whether a slot might have been over, and the event.
fn step<const ROBOTS: usize>(
    world: &World<ROBOTS>,
    turns: &[Successor<ROBOTS>],
    turn: &Successor<ROBOTS>,
    number: impl Fn(Cell) -> String,
    met: &mut Situations,
) -> String {
    let mut might: Vec<String> = turns
        .iter()
        .filter_map(|turn| match turn.event {
            Event::Decides(robot, side, ..) => {
                Some(format!("({robot},{})", number(world.robots()[robot].at().beyond(side))))
            }
            Event::Looks(..) | Event::Returns(..) | Event::Arrives(..) | Event::Ticks | Event::Dies(_) => {
                None
            }
        })
        .collect();
    might.dedup();
    let ticks = turns.iter().any(|turn| turn.event == Event::Ticks);
    format!("({},{ticks},{})", list(might), event(world, &turn.event, number, met))
}

/// A run of four robots without Keep in 4×3 cells that has no end: two of them miss what the other two find, and each
/// of the two waits for the other one to make way. Its events, and those that follow each other for ever then.
const WITHOUT_END: [&str; 2] = [
    "Decides 0 8 8 [] | Looks 0 [] [] 0 | Decides 1 11 11 [] | Arrives 0 [] | Decides 2 4 4 [] | Looks 1 [] [] 0 | \
     Arrives 1 [] | Looks 2 [] [] 0 | Decides 0 9 6 [] | Decides 1 7 7 [] | Decides 3 1 1 [1] | Looks 1 [] [] 0 | \
     Looks 0 [] [] 0 | Arrives 2 [1] | Arrives 1 [] | Arrives 0 [] | Looks 3 [] [] 0 | Decides 1 11 0 [] | \
     Looks 1 [] [] 0 | Arrives 3 [0;1] | Decides 3 0 0 [0;1] | Looks 3 [0;1] [] 0 | Arrives 1 [] | \
     Decides 1 10 0 [] | Decides 2 5 6 [0;1] | Looks 1 [] [] 0 | Decides 3 2 3 [0;1] | Looks 3 [] [] 0 | \
     Looks 2 [] [] 0 | Arrives 2 [0;1] | Arrives 3 [0;1] | Arrives 1 [] | Decides 3 3 3 [0;1] | \
     Decides 2 6 6 [0;1] | Looks 3 [] [] 0 | Looks 2 [] [] 0 | Arrives 3 [0;1] | Arrives 2 [0;1] | \
     Decides 0 10 3 [] | Looks 0 [] [] 0 | Decides 1 9 0 [] | Looks 1 [] [] 0",
    "Ticks | Decides 1 9 0 [] | Looks 1 [] [] 1 | Ticks | Ticks | Ticks | Decides 0 10 3 [] | Looks 0 [] [] 0",
];

/// Where that run takes place, and where its robots begin.
fn place_without_end(rule: Rule) -> (Setting<4>, [Cell; 4]) {
    let setting = setting::<4>(rule, (4, 3)).expect("a small area");
    let cells: Vec<Cell> = setting.area.cells().collect();
    let mut given = TinyMap::new(setting.area).expect("a small area");
    given.learn(cells[0], Status::Obstacle);
    (Setting { given: Some(given), max_losses: 24, ..setting }, [9, 10, 5, 2].map(|place| cells[place]))
}

/// The run of repaired robots that begins as that one, as long as its events may happen, and in which no more messages
/// are missed then: it ends.
fn with_an_end() -> String {
    let (setting, starts) = place_without_end(Rule::REPAIRED);
    let said: Vec<&str> = WITHOUT_END.iter().flat_map(|events| events.split(" | ")).collect();
    let (story, taken) =
        beginning_as(&setting, (starts, &[Cell::new(0, 0)]), &said, &mut Situations::default());
    assert!(
        taken >= WITHOUT_END[0].split(" | ").count(),
        "the first part happens, and its messages are missed"
    );
    story
}

/// A run of two robots in a row of so many cells, one of which explores a cell and goes on while the other one is at its
/// rim, and turns back.
fn with_a_return(rule: Rule, met: &mut Situations) -> String {
    let (cells, starts, said) = if rule.has(Condition::Nearer) {
        let said = "Decides 0 3 3 [] | Looks 0 [] [] 0 | Decides 1 3 3 [] | Arrives 0 [] | Decides 0 2 1 []";
        (5, [2, 4], [said, "Looks 0 [] [] 0 | Arrives 0 [] | Looks 1 [] [] 0"])
    } else {
        let said = "Decides 1 1 1 [] | Looks 1 [] [] 0 | Decides 0 1 1 [] | Arrives 1 [] | Decides 1 2 3 []";
        (4, [0, 2], [said, "Looks 1 [] [] 0 | Arrives 1 [] | Looks 0 [] [] 0"])
    };
    let setting = setting::<2>(rule, (cells, 1)).expect("a small area");
    let setting = Setting { given: TinyMap::new(setting.area), ..setting };
    let said: Vec<&str> = said.iter().flat_map(|events| events.split(" | ")).collect();
    let (story, taken) = beginning_as(&setting, (starts.map(|x| Cell::new(x, 0)), &[]), &said, met);
    assert_eq!((taken, met.returns), (said.len(), 1), "a robot turns back");
    story
}

/// A run in which these events happen, as long as they may, and then any in which no message is missed: with how many
/// of them it begins.
fn beginning_as<const ROBOTS: usize>(
    setting: &Setting<ROBOTS>,
    (starts, blocked): ([Cell; ROBOTS], &[Cell]),
    said: &[&str],
    met: &mut Situations,
) -> (String, usize) {
    let number = |cell: Cell| setting.area.place(cell).expect("it is inside").to_string();
    let (mut draw, mut taken, mut goes_on) = (Draw(2024), 0, true);
    let story = story(setting, (starts, blocked), met, |world, turns| {
        let event = |turn: &Successor<ROBOTS>| event(world, &turn.event, number, &mut Situations::default());
        let is_next =
            |turn: &Successor<ROBOTS>| goes_on && said.get(taken).is_some_and(|&said| event(turn) == said);
        if let Some(place) = turns.iter().position(is_next) {
            taken += 1;
            return place;
        }
        goes_on = false;
        let is_heard = |turn: &&Successor<ROBOTS>| match turn.event {
            Event::Decides(.., missed) | Event::Looks(.., missed, _) | Event::Arrives(.., missed) => {
                missed == 0
            }
            Event::Returns(..) | Event::Ticks | Event::Dies(_) => true,
        };
        let heard: Vec<usize> = (0..turns.len()).filter(|&place| is_heard(&&turns[place])).collect();
        heard[draw.below(heard.len() as u64) as usize]
    });
    (story, taken)
}

/// That run: after the second part every robot is as it was after the first one.
pub(super) fn without_end() -> String {
    let (setting, starts) = place_without_end(Rule::REPAIRED.without(Condition::Keep));
    let mut world = setting.start(starts).expect("a small area");
    let number = |cell: Cell| setting.area.place(cell).expect("it is inside").to_string();
    let mut met = Situations::default();
    let mut worlds = Vec::new();
    let parts = WITHOUT_END.map(|events| {
        let steps = events.split(" | ").map(|said| {
            let turns = setting.turns(&world);
            let is_said = |turn: &&Successor<4>| event(&world, &turn.event, number, &mut met) == said;
            let turn = turns.iter().find(is_said).expect(said);
            let step = step(&world, &turns, turn, number, &mut Situations::default());
            world = turn.world;
            step
        });
        let steps = list(steps.collect::<Vec<_>>());
        worlds.push(world);
        steps
    });
    assert_eq!(worlds[0], worlds[1], "the second part leads back");
    let run = format!("((4,4,3),[0],[9;10;5;2],\n  {},\n  {})", parts[0], parts[1]);
    format!("From Tautline Require Import Explorers.\n{}", definition("endless_without_Keep", ENDLESS, &run))
}

/// The other robots that are met by one that looks.
fn meets<const ROBOTS: usize>(world: &World<ROBOTS>, robot: usize, cell: Cell) -> Vec<usize> {
    let is_there = |other: &Robot<TinyMap>| match other.stance() {
        Stance::Stands => other.at() == cell,
        Stance::Tries(side) | Stance::Enters(side) => other.at() == cell || other.at().beyond(side) == cell,
    };
    (0..ROBOTS).filter(|&other| other != robot && is_there(&world.robots()[other])).collect()
}

/// Whether the event does not say whom of several robots the one that looks has missed.
fn is_unclear<const ROBOTS: usize>(world: &World<ROBOTS>, event: &Event) -> bool {
    let Event::Looks(robot, side, Sight::Robot, missed, _) = *event else { return false };
    missed >> robot & 1 == 1 && meets(world, robot, world.robots()[robot].at().beyond(side)).len() > 1
}

fn event<const ROBOTS: usize>(
    world: &World<ROBOTS>,
    event: &Event,
    number: impl Fn(Cell) -> String,
    met: &mut Situations,
) -> String {
    let at = |robot: usize| world.robots()[robot].at();
    let mut those = |missed: u8| {
        met.missed += usize::from(missed != 0);
        let robots = (0..ROBOTS).filter(|robot| missed >> robot & 1 == 1);
        list(robots.map(|robot| robot.to_string()))
    };
    match *event {
        Event::Decides(robot, side, aim, missed) => {
            format!("Decides {robot} {} {} {}", number(at(robot).beyond(side)), number(aim), those(missed))
        }
        Event::Looks(robot, side, sight, missed, slot) => {
            met.obstacles += usize::from(sight == Sight::Obstacle);
            met.meetings += usize::from(sight == Sight::Robot);
            let own = missed >> robot & 1 == 1;
            let unheard = if own { meets(world, robot, at(robot).beyond(side)) } else { Vec::new() };
            let unheard = list(unheard.iter().map(usize::to_string));
            format!("Looks {robot} {} {unheard} {slot}", those(missed & !(1 << robot)))
        }
        Event::Arrives(robot, fix, missed) => {
            met.wrong += usize::from(match world.robots()[robot].stance() {
                Stance::Enters(side) => at(robot).beyond(side) != fix,
                Stance::Stands | Stance::Tries(_) => true,
            });
            format!("Arrives {robot} {}", those(missed))
        }
        Event::Returns(robot, _) => {
            met.returns += 1;
            format!("Looks {robot} [] [] 0")
        }
        Event::Ticks => {
            met.slots += 1;
            "Ticks".to_owned()
        }
        Event::Dies(_) => unreachable!("no robot dies in these runs"),
    }
}

/// The cells that a robot takes for explored and for obstacles, and where it is.
fn knows(area: Area, robot: &Robot<TinyMap>) -> String {
    let those = |status: Status| {
        let cells = area.cells().filter(move |&cell| robot.map.status(cell) == status);
        list(cells.filter_map(|cell| area.place(cell)).map(|place| place.to_string()))
    };
    let at = area.place(robot.at()).expect("it is inside");
    format!("({},{},{at})", those(Status::Explored), those(Status::Obstacle))
}
