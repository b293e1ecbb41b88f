//! Surroundings of one's own are told, searched and refused in words: the bound says all that a setting fixes, what is
//! known of the layout is no part of the way to it, and a check that is open or refused says why.

use std::ops::ControlFlow;
use std::sync::Arc;

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Edge, Side};
use tautline_proofs::clause::{Check, Clause, NamedRule};
use tautline_proofs::decide::{Answer, Cache, Context, Depiction, EveryAnswer, Method, Verdict};
use tautline_proofs::engine::states::{Limits, MemoryLimit};
use tautline_proofs::engine::tree::{self, Tree, Waves, unwatched};
use tautline_proofs::engine::{Outcome, Until, assume};
use tautline_proofs::protocol::{self, Move, Protocol};
use tautline_proofs::team::{
    Act, Demand, Ground, Keeps, Map, Moves, Places, Promise, Rule, Scene, Senses, Setting, Strategy, View,
    Which,
};
use tautline_proofs::{bound, demands, ledger};

use crate::exhausted::certify;

fn decided<R>(method: &impl Method<R>, rule: &R) -> Answer {
    let (cache, watch) = (&mut Cache::default(), &mut unwatched);
    let mut context = Context { cache, watch, memory: MemoryLimit::any() };
    let answer = method.decide(rule, Until::Exhausted, &mut context).expect("it can be decided");
    certify(method, rule, answer.verdict);
    answer
}

/// A robot's walk.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Walk {
    /// A step east, a step west, for ever.
    ToAndFro,
    /// Round the cells, turning right at a wall.
    Round,
    /// Nowhere.
    Waits,
}

impl Rule for Walk {
    type Memory = Side;
    type Message = ();

    fn start(&self, _: usize, _: &[Cell]) -> Side {
        Side::East
    }

    fn act(&self, view: &mut View<'_, Self>, heading: &mut Side) -> Act {
        let side = *heading;
        match self {
            Self::ToAndFro => *heading = heading.opposite(),
            Self::Round if view.was_blocked() => {
                *heading = heading.turned_right();
                return Act::Go(*heading);
            }
            Self::Round => {}
            Self::Waits => return Act::Wait,
        }
        Act::Go(side)
    }
}

const CORNER: Places<Walk> = Places::At(|_| vec![Cell::new(0, 0)]);
const ENDS: Demand<'static, Walk> = Demand::never_endless("W-1", "it ends");

const fn walking(ground: Ground, starts: Places<Walk>) -> Setting<'static, Walk> {
    Setting { demands: &[ENDS], ..Setting::new("walk", ground, 1, starts) }
}

/// Before, every ground was "all layouts", and nothing else of it was told.
#[test]
fn the_bound_says_which_layouts_starts_and_senses() {
    const WALL: &[Edge] = &[Edge::new(Cell::new(0, 0), Side::East)];
    const OPEN: Ground = Ground::open(3, 3);
    static SETTINGS: [(Setting<'static, Walk>, &str); 6] = [
        (walking(OPEN, CORNER), "3×3 cells without walls, 1 robot, given starts, sight of nothing"),
        (
            walking(OPEN.walls(Which::Any(1)).assume("no wall stands", |map| map.walls().is_empty()), CORNER),
            "all layouts of 3×3 cells, any 1 wall at most, where no wall stands, 1 robot, given starts, \
             sight of nothing",
        ),
        (
            walking(OPEN.walls(Which::These(WALL)), Places::Any),
            "3×3 cells, 1 wall given, 1 robot, any starts, sight of nothing",
        ),
        (
            Setting { senses: Senses::TEAM, ..walking(OPEN.walls(Which::Met(2)), CORNER) },
            "all layouts of 3×3 cells, at most 2 walls, 1 robot, given starts, sight of all robots",
        ),
        (
            Setting {
                senses: Senses { ground: 1, robots: 2 },
                ..walking(
                    OPEN.obstacles(Which::Any(1)).assume("the free cells are connected", Map::is_connected),
                    CORNER,
                )
            },
            "all layouts of 3×3 cells without walls, any 1 blocked cell at most, where the free cells are \
             connected, 1 robot, given starts, sight of walls within 1 step and robots within 2 steps",
        ),
        (
            Setting {
                senses: Senses::ALL,
                goals: Places::Distinct,
                moves: Moves::OneAtATime,
                ..walking(OPEN, Places::Distinct)
            },
            "3×3 cells without walls, 1 robot, any starts apart, any goals apart, sight of all walls and all \
             robots, one at a time",
        ),
    ];
    for (setting, words) in &SETTINGS {
        assert_eq!(Keeps(setting, 0).bound(), *words);
    }
}

/// Two robots that go anywhere.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Chase;

impl Rule for Chase {
    type Memory = ();
    type Message = ();

    fn start(&self, _: usize, _: &[Cell]) {}

    fn act(&self, view: &mut View<'_, Self>, (): &mut ()) -> Act {
        let (own, other) = (view.cell(), view.sees(1 - view.me()).expect("it sees all robots"));
        match (other.x - own.x, other.y - own.y) {
            (0, 0) => Act::Wait,
            (1.., _) => Act::Go(Side::East),
            (..0, _) => Act::Go(Side::West),
            (0, 1..) => Act::Go(Side::South),
            (0, ..0) => Act::Go(Side::North),
        }
    }
}

/// Before, the sides that robots had met were told apart though nothing can stand there, so that one team in the same
/// cells was in many states, and a round began only once all of its sides were met.
#[test]
fn what_is_known_of_the_layout_from_the_start_makes_no_states() {
    static PURSUIT: Setting<'static, Chase> = Setting {
        senses: Senses::TEAM,
        moves: Moves::OneAtATime,
        demands: &[Demand::always("C-1", "they are in the area", &|_| true)],
        ..Setting::new("chase", Ground::open(3, 3), 2, Places::Any)
    };
    let found = Keeps(&PURSUIT, 0).search(&Chase, Limits::NONE).expect("it can be searched");
    assert_eq!((found.states, found.is_whole), (9 * 9, true));
}

#[test]
fn a_round_in_a_known_layout_begins_at_once() {
    static LANE: Setting<'static, Walk> = walking(Ground::open(4, 1), CORNER);
    let found = Keeps(&LANE, 0).search(&Walk::ToAndFro, Limits::NONE).expect("it can be searched");
    let run = found.broken.first().expect("it goes on for ever");
    assert_eq!((run.steps.len(), run.round().len(), found.states, found.is_shortest), (0, 2, 2, true));
}

#[test]
fn a_run_that_has_met_its_most_walls_knows_the_layout() {
    const KNOWS: Demand<'static, Walk> =
        Demand::always("W-2", "with its wall the layout is decided", &|moved| {
            let map = moved.after.map().expect("a layout that is searched");
            map.walls().is_empty() || map.area().edges().all(|edge| map.edge(edge).is_some())
        });
    static MET: Setting<'static, Walk> = Setting {
        demands: &[KNOWS, ENDS],
        longest_run: 200,
        ..walking(Ground::open(3, 2).walls(Which::Met(1)), CORNER)
    };
    static STATES: Setting<'static, Walk> = Setting { moves: Moves::OneAtATime, ..MET };
    assert_eq!((MET.strategy(), STATES.strategy()), (Strategy::Tree, Strategy::States));
    for setting in [&MET, &STATES] {
        assert_eq!(decided(&Keeps(setting, 0), &Walk::Round).verdict, Verdict::Holds);
        assert_eq!(decided(&Keeps(setting, 1), &Walk::Round).verdict, Verdict::Refuted);
    }
}

/// The cells in which no robot is, a bit for each.
fn unvisited(scene: &Scene<Walk>) -> u16 {
    let number = |cell: Cell| (cell.y * 2 + cell.x) as u16;
    scene.cells().fold(0b1111, |left, cell| left & !(1 << number(cell)))
}

#[test]
fn a_patrol_comes_to_every_cell_again_and_again() {
    static PATROL: Setting<'static, Walk> = Setting {
        demands: &[Demand::again_and_again("W-3", "every cell is visited again and again", &unvisited)],
        ..Setting::new("patrol", Ground::open(2, 2), 1, CORNER)
    };
    static TURNS: Setting<'static, Walk> =
        Setting { moves: Moves::OneAtATime, robots: 2, starts: Places::Any, ..PATROL };
    static WALLS: Setting<'static, Walk> =
        Setting { ground: Ground::open(2, 2).walls(Which::Met(1)), ..PATROL };
    assert_eq!(PATROL.strategy(), Strategy::States);
    for setting in [&PATROL, &TURNS] {
        assert_eq!(decided(&Keeps(setting, 0), &Walk::Round).verdict, Verdict::Holds);
    }
    assert_eq!(decided(&Keeps(&WALLS, 0), &Walk::Round).verdict, Verdict::Refuted, "a wall is in its way");
    for (rule, round) in [(Walk::ToAndFro, 2), (Walk::Waits, 1)] {
        let keeps = Keeps(&PATROL, 0);
        let found = decided(&keeps, &rule).counterexample.expect("cells that are left out");
        assert_eq!((found.choices.once.len(), found.choices.again.len()), (1, round), "{rule:?}");
        assert_eq!(keeps.replay(&rule, &found.choices).expect("it can be played").evidence, found);
    }
}

/// A search as a tree may be asked, too, of several demands at once.
#[test]
fn a_tree_says_of_a_patrol_what_the_states_say() {
    static PATROL: Setting<'static, Walk> = Setting {
        demands: &[
            Demand::again_and_again("W-3", "every cell is visited again and again", &unvisited),
            Demand::again_and_again("W-5", "its first cell is left", &|scene| !unvisited(scene) & 1),
        ],
        longest_run: 200,
        ..Setting::new("patrol", Ground::open(2, 2).walls(Which::Met(1)), 1, CORNER)
    };
    for rule in [Walk::Round, Walk::ToAndFro, Walk::Waits] {
        let by_states = [0, 1].map(|demand| decided(&Keeps(&PATROL, demand), &rule).verdict);
        let playing = PATROL.playing(&rule, &[Promise(0)]).expect("it can be played");
        let limits = tree::Limits { max_walls: 1, budget_moves: None, until: Until::Exhausted };
        let mut search =
            Tree::new(playing.wanting(&[0, 1].map(Promise)), &limits).expect("it can be searched");
        while search.wave() {}
        let found = search.found();
        let is_broken =
            |demand| found.counterexamples.iter().any(|example| example.broken == Promise(demand));
        let by_tree = [0, 1].map(|demand| if is_broken(demand) { Verdict::Refuted } else { Verdict::Holds });
        assert_eq!((by_tree, found.given_up), (by_states, 0), "{rule:?}");
    }
}

#[test]
fn a_setting_that_is_made_while_the_program_runs_is_searched() {
    let states = [3, 4].map(|side| {
        let demands = [ENDS];
        let setting =
            Setting { demands: &demands, ..Setting::new("walk", Ground::open(side, side), 1, CORNER) };
        let found = Keeps(&setting, 0).search(&Walk::Round, Limits::NONE).expect("it can be searched");
        assert_eq!(found.broken.first().map(|run| run.demand), Some("it ends"));
        found.states
    });
    // The start, each step round, and each wall at which it turns.
    assert_eq!(states, [1 + 4 * 2 + 4, 1 + 4 * 3 + 4]);
}

#[test]
fn an_open_check_says_why() {
    static UNCOVERED: Setting<'static, Walk> = Setting {
        demands: &[Demand::always("W-4", "it is there", &|_| true)],
        covers: &[
            ("a step", &|moved| moved.has_moved(0)),
            ("a step south", &|moved| moved.after.cell(0).y > 0),
        ],
        ..walking(Ground::open(3, 1), CORNER)
    };
    static AS_STATES: Setting<'static, Walk> = Setting { moves: Moves::OneAtATime, ..UNCOVERED };
    static NOWHERE: Setting<'static, Walk> = Setting {
        ground: Ground::open(3, 1).assume("there is no layout", |_| false),
        covers: &[],
        ..AS_STATES
    };
    for (setting, why) in [
        (&UNCOVERED, "never occurred: a step south"),
        (&AS_STATES, "never occurred: a step south"),
        (&NOWHERE, "there is no start"),
    ] {
        let answer = decided(&Keeps(setting, 0), &Walk::ToAndFro);
        assert_eq!((answer.verdict, answer.note.as_deref()), (Verdict::Open, Some(why)));
    }
    let answer = decided(&protocol::Keeps::<Steps>(Numbers { actor: 0, starts: 1 }, 0), &Steps);
    assert_eq!(answer.note.as_deref(), Some("never occurred: stops"));
    let answer = decided(&protocol::Keeps::<Steps>(Numbers { actor: 0, starts: 0 }, 0), &Steps);
    assert_eq!((answer.verdict, answer.note.as_deref()), (Verdict::Open, Some("there is no start")));
}

bound! { Numbers { actor: usize, starts: u8 } "actor {actor}, {starts} starts" }

/// An actor that takes a step.
#[derive(Clone, Copy)]
struct Steps;

impl Protocol for Steps {
    type Bound = Numbers;
    type State = u8;
    const COVERS: &'static [&'static str] = &["goes", "stops"];
    demands! {
        always "it goes on", |_, _, before, after| after > before;
    }

    fn starts(&self, numbers: &Numbers) -> impl IntoIterator<Item = u8> {
        0..numbers.starts
    }

    fn moves(&self, numbers: &Numbers, &state: &u8) -> Vec<Move<u8>> {
        Move::of(numbers.actor, "goes", 9).when(state < 9).into_iter().collect()
    }
}

#[test]
fn an_actor_that_there_cannot_be_is_refused_with_its_move() {
    for actor in [16, 20] {
        let keeps = protocol::Keeps::<Steps>(Numbers { actor, starts: 1 }, 0);
        let refused = keeps.search(&Steps, Limits::NONE).expect_err("it is refused").to_string();
        let words = "the actors of a protocol have the numbers 0 to 15, not";
        assert_eq!(refused, format!("{words} {actor}: \"goes\" in the state 0"));
    }
    let all = [16, 17].map(|actors| Move::of_all(actors, "go", ()));
    assert_eq!((all[0].actors, all[1].actors), (u16::MAX, 0));
}

/// Machines that are one actor, an actor with a name, two actors at once, and a fault.
#[derive(Clone, Copy)]
struct Named;

impl Protocol for Named {
    type Bound = Numbers;
    type State = u8;
    demands! { always "it stays below 4", |_, _, _, &after| after < 4; }

    fn starts(&self, _: &Numbers) -> impl IntoIterator<Item = u8> {
        [0]
    }

    fn moves(&self, _: &Numbers, &state: &u8) -> Vec<Move<u8>> {
        vec![match state {
            0 => Move::of(0, "acts", 1).by(41),
            1 => Move::of(1, "opens", 2),
            2 => Move::of_all(2, "both go", 3),
            _ => Move::fault("a message is lost", 4),
        }]
    }

    fn actor(&self, number: usize) -> String {
        if number == 1 { "the door".to_owned() } else { format!("machine {number}") }
    }
}

#[test]
fn a_move_is_told_by_the_name_of_whoever_makes_it() {
    let answer = decided(&protocol::Keeps::<Named>(Numbers { actor: 0, starts: 1 }, 0), &Named);
    let Some(Depiction::Story(story)) = answer.counterexample.map(|found| found.seen) else {
        panic!("it is refuted by a story")
    };
    insta::assert_snapshot!(story, @r"
    start   machine 41 acts   the door opens   both go   a message is lost
    0       1                 2                3         4
    ");
}

/// A number that grows without end.
#[derive(Clone, Copy)]
struct Endless;

impl Protocol for Endless {
    type Bound = Numbers;
    type State = u64;
    demands! { always "it grows", |_, _, before, after| after > before; }

    fn starts(&self, _: &Numbers) -> impl IntoIterator<Item = u64> {
        [0]
    }

    fn moves(&self, _: &Numbers, &state: &u64) -> Vec<Move<u64>> {
        vec![Move::of(0, "grows", state + 1)]
    }
}

/// Before, memory ended without a word: `decide_all` bounded none.
#[test]
fn states_without_end_are_cut_short_and_the_check_says_so() {
    static CLAUSE: Clause = Clause {
        id: "GROW-1",
        sentence: "It MUST grow.",
        checks: &[&Check::holds(
            NamedRule::new("endless", Endless),
            &protocol::Keeps::<Endless>(Numbers { actor: 0, starts: 1 }, 0),
            &[],
        )],
    };
    let few = ledger::Limits { memory: Arc::new(MemoryLimit::of(1 << 20, 1)), ..ledger::Limits::default() };
    let hear: ledger::Hear = Arc::new(|_: ledger::News<'_>| ControlFlow::Continue(()));
    let rows = ledger::decide(&ledger::checks(&[&CLAUSE]), &few, &hear).expect("it is decided");
    let note = rows[0].decision.note.clone().expect("a note");
    assert_eq!(rows[0].decision.verdict, Verdict::Open);
    let words = "states: bound the rule more closely, or give the search more memory or steps";
    assert!(note.starts_with("cut short after ") && note.ends_with(words), "{note}");
    assert!(ledger::table(&rows).contains("cut short after "));
    // As is one of `decide_all`, which takes longer.
    assert_eq!(ledger::Limits::default().memory.most(), ledger::MEMORY_BYTES / 4 * 3);
}

/// A body that panics for one rule.
fn careful(rule: &bool, oracle: &mut dyn Oracle) -> Outcome {
    assume(oracle.flip())?;
    assert!(*rule, "the map has no cell 7");
    Ok("an end")
}

#[test]
fn a_panic_names_the_clause_and_the_rule() {
    static CAREFUL: EveryAnswer<bool> =
        EveryAnswer { body: careful, range: || "once".to_owned(), covers: &[] };
    static CLAUSE: Clause = Clause {
        id: "CARE-1",
        sentence: "A rule MUST not panic.",
        checks: &[&Check::holds(
            NamedRule::new("careful", true),
            &CAREFUL,
            &[NamedRule::new("careless", false)],
        )],
    };
    let refused = ledger::decide_all(&[&CLAUSE]).expect_err("a mutant panics").to_string();
    assert_eq!(refused, "CARE-1 panics for the rule \"careless\": the map has no cell 7");
}

/// Five robots apart have 3 billion starts on 9×9 cells, and as many goals of each: memory has room for neither.
#[test]
fn starts_are_made_as_there_is_memory_for_them() {
    static MANY: Setting<'static, Walk> = Setting {
        goals: Places::Distinct,
        demands: &[Demand::always("WALK-1", "robots are apart", &|moved| moved.after.cells_differ())],
        ..Setting::new("walk", Ground::open(9, 9), 5, Places::Distinct)
    };
    let (cache, watch, limit) = (&mut Cache::default(), &mut unwatched, MemoryLimit::of(1 << 20, 1));
    let mut context = Context { cache, watch, memory: limit.asked("five robots apart") };
    let answer = Keeps(&MANY, 0).decide(&Walk::Waits, Until::Exhausted, &mut context);
    let answer = answer.expect("it can be decided");
    assert_eq!(answer.verdict, Verdict::Open);
}

#[test]
fn a_row_that_came_out_otherwise_says_how_it_is_registered() {
    static LANE: Setting<'static, Walk> = walking(Ground::open(4, 1), CORNER);
    static CLAUSE: Clause = Clause {
        id: "WALK-OF-A-ROBOT-IN-A-LANE-OF-FOUR-CELLS-WITH-AN-ID-AS-LONG-AS-A-LINE-OF-THE-TABLE-1",
        sentence: "A walk MUST end.",
        checks: &[&Check::holds(
            NamedRule::new("to and fro", Walk::ToAndFro),
            &Keeps(&LANE, 0),
            &[NamedRule::new("waits", Walk::Waits)],
        )],
    };
    let table = ledger::table(&ledger::decide_all(&[&CLAUSE]).expect("it is decided"));
    assert!(table.contains("not as registered: holds\n"), "{table}");
    let refused = ledger::certificate(&CLAUSE, 1, Limits::NONE).expect_err("there is one check").to_string();
    assert!(refused.ends_with("-1 has no check 1, counted from 0"), "{refused}");
}
