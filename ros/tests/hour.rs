//! An hour of four robots, told in a minute: how long breaches take to be seen, and what memory the node has.

use super::team::{NodeProcess, Team, at, domain, until};
use std::thread::sleep;
use std::time::{Duration, Instant};
use tautline_ros::messages::{DiagnosticArray, DiagnosticStatus, Header, PoseStamped, Time};

const ROBOTS: usize = 4;
const ROUNDS: u64 = 36_000;
/// A breach lasts for one round, and comes once in so many.
const EACH: u64 = 30;

/// The number at a share of sorted ones.
fn quantile(sorted: &[Duration], share: f64) -> Duration {
    sorted[((sorted.len() - 1) as f64 * share).round() as usize]
}

/// Prints the table of `docs/ros.md`:
/// `cargo test --release --manifest-path ros/Cargo.toml hour -- --ignored --nocapture`.
///
/// Four robots publish ten poses a second each for an hour by their stamps, sixty times as fast; in every thirtieth
/// round, the last robot is out of reach. The latency of a breach is from before its pose is written to after its
/// diagnostic is read, both by the same process, which looks for diagnostics each 100 microseconds.
#[test]
#[ignore = "takes a minute"]
fn an_hour_in_a_minute_loses_no_breach() {
    let robots: Vec<_> = (1..=ROBOTS).map(|robot| format!("{{ name = 'robot_{robot}' }}")).collect();
    let clause = "{ clause = 'CHAIN-3', range_m = 2.549, tolerance_m = 0.1 }";
    let config = format!("gap_s = 1.0\nrobots = [{}]\nclauses = [{clause}]", robots.join(", "));
    let domain = domain(3);
    let node = NodeProcess::start(domain, &config);
    let team = Team::new(domain);
    let mouths: Vec<_> = (1..=ROBOTS)
        .map(|robot| team.mouth::<PoseStamped>(&format!("/robot_{robot}/pose"), "geometry_msgs/PoseStamped"))
        .collect();
    let ear = team.ear::<DiagnosticArray>("/diagnostics", "diagnostic_msgs/DiagnosticArray");
    // The stamps before the hour, by which all find one another, and those of the hour.
    let write = |robot: usize, at_us: u64, x: f64| {
        let header = Header { stamp: Time::from_micros(at_us), frame_id: "map".to_owned() };
        mouths[robot].write(PoseStamped { header, pose: at(x) }, None).expect("written");
    };
    let place = |robot: usize| 2.0 * robot as f64;
    let mut before = 0;
    until("a kept clause", || {
        before += 1_000;
        (0..ROBOTS).for_each(|robot| write(robot, before, place(robot)));
        ear.take().filter(|array| array.status[0].level == DiagnosticStatus::OK)
    });
    let (mut latencies, mut memories) = (Vec::new(), Vec::new());
    let (start, mut breach) = (Instant::now(), None);
    let mut planted = 0_u64;
    // After the hour, some rounds without a breach: the last one takes its time, too.
    for round in 0..ROUNDS + EACH - 1 {
        let due = start + Duration::from_mins(1) * round as u32 / ROUNDS as u32;
        let at_us = 3_600_000_000 + round * 100_000;
        let is_out = round % EACH == EACH - 1;
        for robot in 0..ROBOTS {
            let is_breach = is_out && robot == ROBOTS - 1;
            if is_breach {
                planted += 1;
                breach = Some(Instant::now());
            }
            write(robot, at_us, place(robot) + if is_breach { 1.0 } else { 0.0 });
        }
        if round % 3_600 == 1_800 {
            memories.extend(node.memory_kib());
        }
        while Instant::now() < due + Duration::from_mins(1) / ROUNDS as u32 {
            while let Some(array) = ear.take() {
                let is_error = array.status[0].level == DiagnosticStatus::ERROR;
                if let Some(written) = breach.take_if(|_| is_error) {
                    latencies.push(written.elapsed());
                }
            }
            sleep(Duration::from_micros(100));
        }
    }
    let took = start.elapsed();
    latencies.sort();
    let messages = ROUNDS * ROBOTS as u64;
    println!(
        "{messages} messages in {:.1} s; {} of {planted} breaches seen",
        took.as_secs_f64(),
        latencies.len()
    );
    for (name, share) in [("median", 0.5), ("99 %", 0.99), ("99.9 %", 0.999), ("longest", 1.0)] {
        println!("{name}: {:.3} ms", quantile(&latencies, share).as_secs_f64() * 1_000.0);
    }
    let soon = latencies.iter().filter(|latency| **latency <= Duration::from_millis(10)).count();
    println!("within 10 ms: {soon}");
    println!("memory, KiB, each six seconds: {memories:?}");
    assert_eq!(latencies.len() as u64, planted);
    let (code, said) = node.end();
    assert_eq!(code, Some(0), "{said}");
}
