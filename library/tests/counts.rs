//! The search over states counts the states that other model checkers count: stateright, which shares the moves of a
//! rule and no engine, and SPIN, whose models in `spin` share nothing.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::path::Path;
use std::process::{Command, Output};
use std::time::Instant;
use std::{env, fmt, fs, io, process};

use stateright::{Checker, Model};
use tautline_library::{RULES, alpha, dijkstra, gathering, ricart};
use tautline_proofs::decide::{Answer, Cache, Context, MethodError, Portion, Verdict};
use tautline_proofs::demands;
use tautline_proofs::engine::Until;
use tautline_proofs::engine::states::{Limits, MemoryLimit};
use tautline_proofs::engine::tree::Progress;
use tautline_proofs::protocol::{Bound, Keeps, Move, Protocol};
use tautline_proofs::team::Moves;

use crate::model::CountedModel;

/// The states of the first demand's search.
fn ours<P: Protocol>(rule: &P, bound: P::Bound) -> u64 {
    let found = Keeps::<P>(bound, 0).search(rule, Limits::NONE).expect("it can be searched");
    assert!(found.is_whole && found.broken.is_empty());
    found.states
}

fn stateright<P: Protocol + Send>(rule: &P, bound: &P::Bound) -> u64
where
    P::State: Send + Sync + std::hash::Hash,
{
    let surroundings = bound.each().expect("there is such a bound").remove(0);
    let model = CountedModel(rule.clone(), surroundings);
    model.checker().spawn_bfs().join().unique_state_count() as u64
}

#[test]
fn stateright_counts_the_same_states_of_three_rules() {
    fn both<P: Protocol + Send>(rule: &P, bound: impl Fn() -> P::Bound) -> [u64; 2]
    where
        P::State: Send + Sync + std::hash::Hash,
    {
        [ours(rule, bound()), stateright(rule, &bound())]
    }
    assert_eq!(both(&dijkstra::Rule::Published, || dijkstra::Machines::of(5, 5)), [3125; 2]);
    for (losses, states) in [(0, 3300), (1, 10522)] {
        assert_eq!(both(&ricart::RULE, || ricart::Net::of(3, losses)), [states; 2]);
    }
    assert_eq!(both(&gathering::RULE, || gathering::row(3, Moves::LookThenMove)), [9; 2]);
}

/// States, steps, memory, and the first run that breaks the demand.
#[test]
fn any_number_of_workers_finds_the_same() {
    fn same<P: Protocol>(rule: &P, bound: impl Fn() -> P::Bound, demand: usize) -> bool {
        let by = |workers| {
            Keeps::<P>(bound(), demand)
                .search(rule, Limits { workers: NonZeroUsize::new(workers), ..Limits::NONE })
                .expect("a search")
        };
        let alone = by(1);
        assert!([3, 8].into_iter().all(|workers| by(workers) == alone));
        alone.broken.is_empty()
    }
    use dijkstra::{Machines, Rule};

    assert!(same(&Rule::Published, || Machines::of(6, 6), 1));
    assert!(!same(&Rule::Published, || Machines::of(7, 4), 1));
    assert!(!same(&Rule::Uniform, || Machines::of(6, 6), 1));
    assert!(!same(&Rule::CountsOn, || Machines::of(6, 6), 0));
    assert!(same(&ricart::RULE, || ricart::Net::of(3, 1), 0));
    let hasty = ricart::Conditions { defers: false, ..ricart::RULE };
    assert!(!same(&hasty, || ricart::Net::of(3, 1), 0));
}

/// Checks over many layouts, as one and in portions.
#[test]
fn a_check_in_portions_has_the_verdict_the_counts_and_the_counterexample_of_the_whole() {
    let rules = RULES.iter().filter(|rule| ["yamauchi", "lacam"].contains(&rule.name));
    let checks = rules.flat_map(|rule| rule.clauses()).flat_map(|clause| clause.checks);
    let mut refuted = 0;
    for check in checks {
        let watch = &mut |_: &Progress<'_>| ControlFlow::Continue(());
        let mut context = Context { cache: &mut Cache::default(), watch, memory: MemoryLimit::any() };
        let whole = check.decide_rule(None, Until::Exhausted, &mut context).expect("it is decided");
        refuted += usize::from(whole.verdict == Verdict::Refuted);
        let portion =
            |number| check.decide_portion(None, Portion { number, of: 3 }, &mut context).expect("a portion");
        let mut parts: Vec<_> = (0..3).map(portion).collect();
        parts.reverse();
        assert_eq!(Answer::merged(parts), whole, "{check:?}");
    }
    assert_eq!(refuted, 3);
}

/// So many surroundings, in each of which a number grows to 20.
struct Many(u16);

impl fmt::Display for Many {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} surroundings", self.0)
    }
}

impl Bound for Many {
    type Surroundings = u16;

    fn each(&self) -> Result<Vec<u16>, MethodError> {
        Ok((0..self.0).collect())
    }
}

#[derive(Clone, Debug)]
struct Grows;

impl Protocol for Grows {
    type Bound = Many;
    type State = u8;
    demands! { always "it is small", |_, _, _, &number| number < 21; }

    fn starts(&self, _: &u16) -> impl IntoIterator<Item = u8> {
        [0]
    }

    fn moves(&self, _: &u16, &number: &u8) -> Vec<Move<u8>> {
        (number < 20).then(|| Move::of(0, "grows", number + 1)).into_iter().collect()
    }
}

/// Before, how far a budget went depended on the number of threads, and one that was overdrawn was as good as none.
#[test]
fn a_budget_ends_a_search_of_many_surroundings_in_the_same_place_on_any_number_of_threads() {
    for steps in [100, 6_000, 1_000_000] {
        let found = |workers| {
            let limits = Limits { workers: NonZeroUsize::new(workers), ..Limits::steps(steps) };
            let found = Keeps::<Grows>(Many(1000), 0).search(&Grows, limits).expect("a search");
            (found.states, found.steps, found.is_whole)
        };
        let one = found(1);
        assert_eq!((one.2, [2, 3, 8].map(found)), (steps == 1_000_000, [one; 3]), "{steps} steps");
    }
}

/// Four robots of Alpha on a square of `ALPHA_SIDE` cells a side, 16 unless it says otherwise; what is found is
/// printed: `cargo test -p tautline-library --test all four_robots -- --ignored --nocapture`.
#[test]
#[ignore = "it takes minutes"]
fn four_robots_of_alpha_on_a_large_square_are_decided_in_two_gigabytes() {
    let width = env::var("ALPHA_SIDE").map_or(16, |side| side.parse().expect("cells a side"));
    let (swarm, begun) = (alpha::Swarm { robots: 4, width, ..alpha::SWARM }, Instant::now());
    let starts = alpha::RULE.starts(&swarm).into_iter().count();
    eprintln!("{starts} starts, listed in {:.0} s", begun.elapsed().as_secs_f64());
    let found = Keeps::<alpha::Conditions>(swarm, 0).search(&alpha::RULE, Limits::NONE).expect("a search");
    let (states, steps, megabytes) = (found.states, found.steps, found.bytes >> 20);
    eprintln!("{states} states, {steps} steps, {megabytes} MB, {:.0} s", begun.elapsed().as_secs_f64());
    assert!(found.is_whole && !found.broken.is_empty() && found.bytes < 2 << 30);
}

/// The states that SPIN stores for a model of `spin`; `None` where there is no SPIN or no C compiler.
fn spin(model: &str, define: &str) -> Option<u64> {
    let folder = env::temp_dir().join(format!("{model}-{define}-{}", process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/spin").join(model).with_extension("pml");
    let run = |program: &str, arguments: &[&str]| -> Option<Output> {
        let run = Command::new(program).args(arguments).current_dir(&folder).output();
        match run {
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            run => Some(run.expect("it runs")),
        }
    };
    let made = run("spin", &[define, "-a", source.to_str()?])
        .and_then(|_| run("cc", &["-w", "-DSAFETY", "-DNOREDUCE", "-o", "pan", "pan.c"]));
    let output = made
        .map(|_| run(folder.join("pan").to_str().expect("a path"), &["-E", "-m100000"]).expect("it runs"));
    fs::remove_dir_all(&folder).expect("the folder goes");
    let told = String::from_utf8(output?.stdout).expect("text");
    let line = told.lines().find_map(|line| line.strip_suffix(" states, stored")).expect("a count");
    line.trim().parse().ok()
}

#[test]
fn spin_counts_the_same_states() {
    for (losses, define) in [(0, "-DLOSSES=0"), (1, "-DLOSSES=1")] {
        let Some(stored) = spin("ricart", define) else {
            eprintln!("skipped: there is no SPIN and C compiler here");
            return;
        };
        assert_eq!(ours(&ricart::RULE, ricart::Net::of(3, losses)), stored, "{define}");
    }
}
