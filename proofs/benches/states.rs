//! The cost of a state of the search over all states, in time and memory: against stateright in the same run, for MRC
//! and for ants on an open floor. The same ants stand in `ants.pml` for SPIN, which is started by hand: see
//! `docs/performance.md`. All must find the same states.

#[path = "../tests/common/rescue.rs"]
mod model;

use std::collections::{HashSet, VecDeque};
use std::hash::Hash;
use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::Instant;

use stateright::{Checker, Model, Property};
use tautline_kernel::choice::Oracle;
use tautline_kernel::mrc::Rule;
use tautline_proofs::engine::states::{Bits, Findings, Limits, MOST_AT_ONCE, System, pieces, search};
use tautline_proofs::engine::world::{Turn, World};
use tautline_proofs::mrc::space::{self, Until};
use tautline_proofs::mrc::{Demand, Faults, Leases, LossKind, RobotReading, Setting};

use self::model::Rescue;

const WIDTH: usize = 5;
const CELLS: usize = 20;
const ANTS: usize = 3;

/// Ants on an open floor: how often each cell was entered, and where the ants are.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
struct Floor {
    crossings: [u8; CELLS],
    at: [usize; ANTS],
}

/// Whoever is next goes to the neighbour that was entered least often, ties in the order of the compass, until every
/// cell was entered.
struct Ants;

impl Floor {
    const START: Self = {
        let mut crossings = [0; CELLS];
        crossings[0] = ANTS as u8;
        Self { crossings, at: [0; ANTS] }
    };

    fn is_over(&self) -> bool {
        !self.crossings.contains(&0)
    }

    fn after(mut self, ant: usize) -> Self {
        let here = self.at[ant];
        let (column, row) = (here % WIDTH, here / WIDTH);
        let around = [
            (row > 0).then(|| here - WIDTH),
            (column + 1 < WIDTH).then_some(here + 1),
            (here + WIDTH < CELLS).then_some(here + WIDTH),
            (column > 0).then(|| here - 1),
        ];
        let best = around.into_iter().flatten().min_by_key(|&cell| self.crossings[cell]).unwrap_or(here);
        self.crossings[best] += 1;
        self.at[ant] = best;
        self
    }
}

/// Cells of a part: a row.
type Row = [u8; WIDTH];

#[derive(Clone, PartialEq, Eq, Hash)]
enum Part {
    Row(Row),
    Ants([usize; ANTS]),
}

impl World for Ants {
    type State = Floor;
    type Plan = ();
    type Event = u32;
    type Demand = ();

    fn plan(&self, floor: &mut Floor, _: &[u8]) -> Option<()> {
        (!floor.is_over()).then_some(())
    }

    fn settle(&self, floor: &mut Floor, (): &(), _: &mut Vec<u8>, world: &mut impl Oracle) -> u32 {
        let ant = world.pick(ANTS as u32);
        *floor = floor.after(ant as usize);
        ant
    }

    fn broken_by(&self, _: &Turn<'_, Self>) -> Vec<()> {
        Vec::new()
    }
}

impl System for Ants {
    type Part = Part;

    fn places(&self, _: &Floor) -> usize {
        CELLS / WIDTH + 1
    }

    fn part(&self, floor: &Floor, place: usize) -> Part {
        floor.crossings.as_chunks().0.get(place).map_or(Part::Ants(floor.at), |&row| Part::Row(row))
    }

    fn put(&self, floor: &mut Floor, place: usize, part: &Part) {
        match part {
            Part::Row(row) => floor.crossings[WIDTH * place..WIDTH * (place + 1)].copy_from_slice(row),
            Part::Ants(at) => floor.at = *at,
        }
    }

    fn acting(&self, turn: &Turn<'_, Self>) -> Bits {
        1 << turn.event
    }
}

impl Model for Ants {
    type State = Floor;
    type Action = usize;

    fn init_states(&self) -> Vec<Floor> {
        vec![Floor::START]
    }

    fn actions(&self, floor: &Floor, actions: &mut Vec<usize>) {
        actions.extend(if floor.is_over() { 0..0 } else { 0..ANTS });
    }

    fn next_state(&self, floor: &Floor, ant: usize) -> Option<Floor> {
        Some(floor.after(ant))
    }

    fn properties(&self) -> Vec<Property<Self>> {
        vec![Property::always("nothing", |_, _| true)]
    }
}

/// The largest of the settings that the tests count with stateright.
const SETTING: Setting = Setting {
    rule: Rule::REPAIRED,
    misread: None,
    robots: 2,
    wfrs: 2,
    events: 2,
    max_hops: 2,
    faults: Faults::any(1),
    lossy: LossKind::All,
    leases: Leases::UntilCalled,
    reading: RobotReading::PUBLISHED,
};

/// The count that `run` returns, and the seconds of the faster of two runs.
fn timed(run: impl Fn() -> u64) -> (u64, f64) {
    let seconds = || {
        let start = Instant::now();
        let states = black_box(run());
        (states, start.elapsed().as_secs_f64())
    };
    let (one, other) = (seconds(), seconds());
    if one.1 < other.1 { one } else { other }
}

#[expect(clippy::cast_precision_loss, reason = "a rate")]
fn rate((states, seconds): (u64, f64)) -> f64 {
    1e-6 * states as f64 / seconds
}

/// The number of steps from each state, breadth first.
fn steps_from_each<M: Model<State: Hash + Eq + Clone>>(model: &M) -> Vec<u64> {
    let (mut known, mut ahead, mut steps) = (HashSet::new(), VecDeque::from(model.init_states()), Vec::new());
    known.extend(ahead.iter().cloned());
    while let Some(state) = ahead.pop_front() {
        let next = model.next_states(&state);
        steps.push(next.len() as u64);
        ahead.extend(next.into_iter().filter(|state| known.insert(state.clone())));
    }
    steps
}

/// The percentage of their time that so many workers wait for one another, if a state takes as long as it has steps.
#[expect(clippy::cast_precision_loss, reason = "a percentage")]
fn waits(steps: &[u64], workers: usize) -> f64 {
    let span = |states: &[u64]| {
        let mut made = vec![0; workers];
        for piece in pieces(0..states.len(), workers) {
            // Whoever is done first takes it.
            if let Some(own) = made.iter_mut().min() {
                *own += states[piece].iter().sum::<u64>();
            }
        }
        made.into_iter().max().unwrap_or(0)
    };
    let spans: u64 = steps.chunks(MOST_AT_ONCE).map(span).sum();
    100.0 * (1.0 - steps.iter().sum::<u64>() as f64 / (spans * workers as u64) as f64)
}

fn main() {
    // A bench is also built and run as a test, which asks for nothing.
    if !std::env::args().any(|argument| argument == "--bench") {
        return;
    }
    let by = |workers| Limits { workers: NonZeroUsize::new(workers), ..Limits::NONE };
    let ants = || search(&Ants, [Floor::START], by(1));
    let rescue = || space::search(&SETTING, Until::Exhausted, by(1));
    let model = || Rescue(SETTING, Demand::ALL.to_vec());
    let rows = [
        (
            "ants",
            timed(|| ants().states),
            timed(|| Ants.checker().threads(1).spawn_bfs().join().unique_state_count() as u64),
            ants().bytes,
        ),
        (
            "mrc",
            timed(|| rescue().states),
            timed(|| model().checker().threads(1).spawn_bfs().join().unique_state_count() as u64),
            rescue().bytes,
        ),
    ];
    println!(
        "Million states a second of one thread, and bytes a state; MRC with its search for endless runs"
    );
    println!("            states   ours  stateright  ratio  bytes");
    for (name, ours, theirs, bytes) in rows {
        assert_eq!(ours.0, theirs.0, "both find the same states");
        let (mine, other) = (rate(ours), rate(theirs));
        let each = bytes / ours.0;
        println!("  {name:6} {:>9} {mine:>6.2} {other:>11.2} {:>6.1} {each:>6}", ours.0, mine / other);
    }
    let (_, alone) = timed(|| rescue().states);
    let (_, together) = timed(|| space::search(&SETTING, Until::Exhausted, by(2)).states);
    println!("\nMRC takes two workers {:.2} times as long as one", together / alone);
    println!("\nHow much of their time 2, 8, 32 and 128 workers wait for one another, counted in steps");
    for (name, steps) in [("ants", steps_from_each(&Ants)), ("mrc", steps_from_each(&model()))] {
        let percentages = [2, 8, 32, 128].map(|workers| format!("{:.1} %", waits(&steps, workers)));
        println!("  {name:6} {}", percentages.join(", "));
    }
    let Findings { states, steps, .. } = ants();
    println!(
        "\nSPIN counts one state and one transition more for the start of ants.pml: {states} states, {steps} steps"
    );
}
