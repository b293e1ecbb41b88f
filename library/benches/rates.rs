//! States a second and bytes a state of the search over states beside stateright's on one core, both with the moves of
//! one protocol: Dijkstra's ring of eight machines from all starts. Ours also looks for runs that never come to one
//! privilege. Each search is a process of its own, so that its memory is what the kernel says.

#[path = "../tests/common/model.rs"]
mod model;

use std::num::NonZeroUsize;
use std::process::Command;
use std::{env, fs};

use stateright::{Checker, Model};
use tautline_library::dijkstra::{Machines, Rule};
use tautline_proofs::engine::states::Limits;
use tautline_proofs::protocol::Keeps;

use self::model::CountedModel;

/// The milliseconds of processor time of all threads of this process.
fn processor_time() -> u64 {
    let stat = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after = stat.rsplit(')').next().unwrap_or_default();
    // In hundredths of a second, in user code and in the kernel's.
    after
        .split_whitespace()
        .skip(11)
        .take(2)
        .filter_map(|ticks| ticks.parse::<u64>().ok())
        .map(|ticks| 10 * ticks)
        .sum()
}

/// The most kilobytes that this process had at a time.
fn peak() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.trim().trim_end_matches(" kB").parse().ok()).unwrap_or(0)
}

/// Searches by one of them, and prints states, milliseconds and kilobytes.
fn search(who: &str, states: u8) {
    let (rule, ring) = (Rule::Published, Machines::of(8, states));
    let count = if who == "ours" {
        let alone = Limits { workers: NonZeroUsize::new(1), ..Limits::NONE };
        Keeps::<Rule>(ring, 1).search(&rule, alone).expect("there is a ring").states
    } else {
        let model = CountedModel(rule, ring);
        model.checker().threads(1).spawn_bfs().join().unique_state_count() as u64
    };
    println!("{count} {} {}", processor_time(), peak());
}

/// The states, milliseconds and kilobytes of the faster of two searches.
fn fastest(who: &str, states: u8) -> [u64; 3] {
    let run = |_| {
        let program = env::current_exe().expect("this program");
        let output = Command::new(program).args([who, &states.to_string()]).output().expect("it runs");
        let mut numbers = str::from_utf8(&output.stdout).expect("numbers").split_whitespace();
        [(); 3].map(|()| numbers.next().and_then(|number| number.parse().ok()).expect("a number"))
    };
    (0..2).map(run).min_by_key(|&[_, millis, _]| millis).expect("two runs")
}

#[expect(clippy::cast_precision_loss, reason = "a ratio")]
fn ratio(one: u64, other: u64) -> f64 {
    one as f64 / other as f64
}

fn main() {
    let arguments: Vec<String> = env::args().skip(1).collect();
    match &arguments[..] {
        [who, states] if who == "ours" || who == "theirs" => {
            search(who, states.parse().expect("states of a machine"));
        }
        _ if arguments.iter().any(|argument| argument == "--bench") => {
            println!("Dijkstra's ring of 8 machines on one core: million states a second, bytes a state");
            println!("states of each      states   ours  stateright  ratio   ours  stateright  ratio");
            for states in [5, 6, 7, 8] {
                let [[count, millis, kilos], [same, other_millis, other_kilos]] =
                    ["ours", "theirs"].map(|who| fastest(who, states));
                assert_eq!(count, same, "both find the same states");
                let (rate, other_rate) = (ratio(count, 1000 * millis), ratio(count, 1000 * other_millis));
                println!(
                    "{states:14} {count:11} {rate:6.2} {other_rate:11.2} {:6.2} {:6} {:11} {:6.2}",
                    rate / other_rate,
                    1024 * kilos / count,
                    1024 * other_kilos / count,
                    ratio(kilos, other_kilos)
                );
            }
        }
        // A bench is also built and run as a test, which asks for nothing.
        _ => {}
    }
}
