//! Monitors against a judge of whole logs, which is written from the sentences of SPEC.md and shares nothing with them: it
//! keeps every sample, and looks at all pairs and all ways at each one.

use tautline_monitor::{
    Apart, Cells, Demand, Doubt, Joined, Monitor, Neighbours, Own, Place, Track, Verdict,
};

const ROBOTS: usize = 4;
const GAP_US: u64 = 1_000_000;

/// A sample: robot, microseconds, two coordinates in millimetres.
type Sample = (usize, u64, [i32; 2]);

/// The clauses, each with the numbers of its demand.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Clause {
    Chain3,
    Kit12,
    Kit3,
    Chain2,
    Frontier2,
}

const CLAUSES: [Clause; 5] = [Clause::Chain3, Clause::Kit12, Clause::Kit3, Clause::Chain2, Clause::Frontier2];
const TOLERANCE_MM: u32 = 100;
const RANGE: Neighbours = Neighbours { range_mm: 2_549, tolerance_mm: TOLERANCE_MM };
const LINKS: Joined = Joined { range_mm: 2_549, tolerance_mm: TOLERANCE_MM };
const APART: Apart = Apart { least_mm: 1_000, tolerance_mm: TOLERANCE_MM };
const PAIRS: Cells = Cells { cell_mm: 1_000, most: 2, base: Some([0, 0]), tolerance_mm: TOLERANCE_MM };
const SINGLE: Cells = Cells { most: 1, base: None, ..PAIRS };

/// Random numbers (xorshift), the same on every machine.
struct Chance(u64);

impl Chance {
    fn below(&mut self, below: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) % below
    }
}

/// A log of robots that start side by side and go on by small steps; single samples are mutated: another place, an earlier
/// stamp, a long silence, a robot that there is not, a place beyond all others; some come together in one cell.
fn log(chance: &mut Chance) -> Vec<Sample> {
    let mut places: Vec<[i32; 2]> = (0..ROBOTS).map(|robot| [1_200 * robot as i32 + 500, 500]).collect();
    let mut at_us = 0;
    let samples = 8 + chance.below(24);
    let mut sample = |number: u64| {
        let robot = chance.below(ROBOTS as u64) as usize;
        let robot = if number < ROBOTS as u64 { number as usize } else { robot };
        at_us += chance.below(300_000);
        for along in &mut places[robot] {
            *along += chance.below(801) as i32 - 400;
        }
        let taken = (robot, at_us, places[robot]);
        match chance.below(20) {
            0 => (robot, at_us, [chance.below(6_000) as i32 - 1_000, chance.below(2_000) as i32]),
            1 => (robot, at_us.saturating_sub(400_000), taken.2),
            2 => {
                at_us += 1_200_000;
                (robot, at_us, taken.2)
            }
            3 => (ROBOTS, at_us, taken.2),
            4 => (robot, at_us, [i32::MAX, 0]),
            mutation @ 5..9 => {
                places[robot] = [if mutation < 7 { 500 } else { 1_500 }, 500];
                (robot, at_us, places[robot])
            }
            _ => taken,
        }
    };
    (0..samples).map(&mut sample).collect()
}

/// The verdicts of the judge, one for each sample: `Some(true)` if the clause is broken, `Some(false)` if it is kept.
fn judged(clause: Clause, log: &[Sample]) -> Vec<Option<bool>> {
    let far = |one: [i32; 2], other: [i32; 2]| {
        let along = |axis: usize| f64::from(one[axis]) - f64::from(other[axis]);
        along(0).hypot(along(1))
    };
    let tolerance = f64::from(TOLERANCE_MM);
    let (mut taken, mut verdicts): (Vec<Sample>, Vec<Option<bool>>) = (Vec::new(), Vec::new());
    for &(robot, at_us, place) in log {
        let last = taken.iter().rev().find(|one| one.0 == robot);
        let is_refused = robot >= ROBOTS
            || place.iter().any(|along| along.unsigned_abs() > 1_000_000_000)
            || last.is_some_and(|last| at_us < last.1);
        if is_refused {
            verdicts.push(None);
            continue;
        }
        taken.push((robot, at_us, place));
        let now_us = taken.iter().map(|one| one.1).max().expect("a sample");
        let seen: Vec<Option<[i32; 2]>> = (0..ROBOTS)
            .map(|robot| {
                taken
                    .iter()
                    .rev()
                    .find(|one| one.0 == robot)
                    .filter(|one| now_us - one.1 <= GAP_US)
                    .map(|one| one.2)
            })
            .collect();
        let start = |robot: usize| taken.iter().find(|one| one.0 == robot).expect("it was heard").2;
        let pairs = || {
            let all = (0..ROBOTS).flat_map(|one| (one + 1..ROBOTS).map(move |other| (one, other)));
            all.filter_map(|(one, other)| Some(((one, seen[one]?), (other, seen[other]?))))
        };
        let middle = |place: [i32; 2]| {
            let along = |axis: usize| {
                let cell = f64::from(place[axis]).div_euclid(1_000.0);
                let left = f64::from(place[axis]) - 1_000.0 * cell;
                (left >= tolerance && left + tolerance < 1_000.0).then_some(cell as i32)
            };
            Some([along(0)?, along(1)?])
        };
        let most = |most: usize, free: Option<[i32; 2]>| {
            let cells: Vec<[i32; 2]> = seen.iter().flatten().filter_map(|&place| middle(place)).collect();
            cells
                .iter()
                .any(|cell| Some(*cell) != free && cells.iter().filter(|other| *other == cell).count() > most)
        };
        let is_broken = match clause {
            Clause::Chain3 => pairs()
                .any(|((one, at), (other, there))| one + 1 == other && far(at, there) > 2_549.0 + tolerance),
            // Every way from the first robot to the last one is tried, as the relation's closure.
            Clause::Kit12 => {
                seen.iter().all(Option::is_some) && {
                    let mut joins = [[false; ROBOTS]; ROBOTS];
                    for ((one, at), (other, there)) in pairs() {
                        joins[one][other] = far(at, there) <= 2_549.0 + tolerance;
                        joins[other][one] = joins[one][other];
                    }
                    for over in 0..ROBOTS {
                        for one in 0..ROBOTS {
                            for other in 0..ROBOTS {
                                joins[one][other] |= joins[one][over] && joins[over][other];
                            }
                        }
                    }
                    (1..ROBOTS).any(|robot| !joins[0][robot])
                }
            }
            Clause::Kit3 => pairs().any(|((one, at), (other, there))| {
                let has_left = |robot: usize, at: [i32; 2]| far(start(robot), at) >= 1_000.0;
                has_left(one, at) && has_left(other, there) && far(at, there) < 1_000.0 - tolerance
            }),
            Clause::Chain2 => most(2, Some([0, 0])),
            Clause::Frontier2 => most(1, None),
        };
        let is_whole = seen.iter().all(Option::is_some);
        verdicts.push(if is_broken { Some(true) } else { is_whole.then_some(false) });
    }
    verdicts
}

/// The verdicts of a monitor that hears the log through `changed`.
fn monitored<D: Demand<N>, const N: usize>(demand: D, gap_us: u64, log: &[Sample]) -> Vec<Option<bool>> {
    let mut monitor: Monitor<D, N> = Monitor::new(demand, gap_us);
    let hear =
        |&(robot, at_us, [x_mm, y_mm]): &Sample| match monitor.hear(robot, at_us, Place::new(x_mm, y_mm)) {
            Verdict::Kept => Some(false),
            Verdict::Broken(_) => Some(true),
            Verdict::Unknown(_) => None,
        };
    log.iter().map(hear).collect()
}

fn watched(clause: Clause, log: &[Sample]) -> Vec<Option<bool>> {
    match clause {
        Clause::Chain3 => monitored::<_, ROBOTS>(RANGE, GAP_US, log),
        Clause::Kit12 => monitored::<_, ROBOTS>(LINKS, GAP_US, log),
        Clause::Kit3 => monitored::<_, ROBOTS>(APART, GAP_US, log),
        Clause::Chain2 => monitored::<_, ROBOTS>(PAIRS, GAP_US, log),
        Clause::Frontier2 => monitored::<_, ROBOTS>(SINGLE, GAP_US, log),
    }
}

/// Compares monitors and judge on so many logs; returns how many samples were broken, kept and unknown, by clause.
fn compared(logs: u64) -> Vec<[u64; 3]> {
    let mut counts = vec![[0; 3]; CLAUSES.len()];
    let mut chance = Chance(0x9e37_79b9_7f4a_7c15);
    for number in 0..logs {
        let log = log(&mut chance);
        for (clause, counts) in CLAUSES.into_iter().zip(&mut counts) {
            let watched = watched(clause, &log);
            assert_eq!(watched, judged(clause, &log), "log {number}, {clause:?}: {log:?}");
            for verdict in watched {
                counts[match verdict {
                    Some(true) => 0,
                    Some(false) => 1,
                    None => 2,
                }] += 1;
            }
        }
    }
    counts
}

#[test]
fn monitors_say_what_the_judge_says_of_ten_thousand_mutated_logs() {
    for (clause, counts) in CLAUSES.into_iter().zip(compared(10_000)) {
        assert!(counts.iter().all(|&count| count > 500), "{clause:?}: {counts:?}");
    }
}

/// Takes about half a minute: `cargo test --release -p tautline-monitor -- --ignored --nocapture`.
#[test]
#[ignore = "a hundred times as many logs as the test above"]
fn monitors_say_what_the_judge_says_of_a_million_mutated_logs() {
    println!("broken, kept, unknown: {:?}", compared(1_000_000));
}

/// A wrong monitor: its name, its clause, and what it says of a log.
type Mutant = (&'static str, Clause, fn(&[Sample]) -> Vec<Option<bool>>);

#[test]
fn each_wrong_monitor_is_found() {
    let mutants: [Mutant; 9] = [
        ("a range that is a tolerance too long", Clause::Chain3, |log| {
            monitored::<_, ROBOTS>(Neighbours { tolerance_mm: 2 * TOLERANCE_MM, ..RANGE }, GAP_US, log)
        }),
        ("a range without its tolerance", Clause::Chain3, |log| {
            monitored::<_, ROBOTS>(Neighbours { tolerance_mm: 0, ..RANGE }, GAP_US, log)
        }),
        ("a robot left out", Clause::Chain3, |log| monitored::<_, { ROBOTS - 1 }>(RANGE, GAP_US, log)),
        ("positions that never grow old", Clause::Chain3, |log| monitored::<_, ROBOTS>(RANGE, u64::MAX, log)),
        ("links of neighbours alone", Clause::Kit12, |log| monitored::<_, ROBOTS>(RANGE, GAP_US, log)),
        ("starts that count", Clause::Kit3, |log| {
            let near = |track: &Track<ROBOTS>| {
                let is_near = |[one, other]: &[(usize, Place); 2]| {
                    f64::from(one.1.x_mm - other.1.x_mm).hypot(f64::from(one.1.y_mm - other.1.y_mm)) < 900.0
                };
                let [one, other] = track.pairs().find(is_near)?;
                Some(tautline_monitor::Breach { robots: [one.0, other.0], measured: 0, allowed: 1_000 })
            };
            monitored::<_, ROBOTS>(Own(near), GAP_US, log)
        }),
        ("a base like any cell", Clause::Chain2, |log| {
            monitored::<_, ROBOTS>(Cells { base: None, ..PAIRS }, GAP_US, log)
        }),
        ("one robot more in a cell", Clause::Frontier2, |log| {
            monitored::<_, ROBOTS>(Cells { most: 2, ..SINGLE }, GAP_US, log)
        }),
        ("borders that are no doubt", Clause::Frontier2, |log| {
            monitored::<_, ROBOTS>(Cells { tolerance_mm: 0, ..SINGLE }, GAP_US, log)
        }),
    ];
    for (name, clause, says) in mutants {
        let mut chance = Chance(7);
        let is_found = (0..2_000).any(|_| {
            let log = log(&mut chance);
            says(&log) != judged(clause, &log)
        });
        assert!(is_found, "{name}");
    }
}

#[test]
fn what_cannot_be_taken_is_said() {
    let mut monitor: Monitor<_, 2> = Monitor::new(LINKS, GAP_US);
    let mut hear = |robot, at_us, x_mm| monitor.hear(robot, at_us, Place::new(x_mm, 0));
    assert_eq!(hear(0, 10, 0), Verdict::Unknown(Doubt::Silent(1)));
    assert_eq!(hear(2, 20, 0), Verdict::Unknown(Doubt::Nobody(2)));
    assert_eq!(hear(1, 20, i32::MIN), Verdict::Unknown(Doubt::TooFar));
    assert_eq!(hear(1, 20, 0), Verdict::Kept);
    assert_eq!(hear(1, 19, 0), Verdict::Unknown(Doubt::Late));
    // The other one is silent for longer than the gap.
    assert_eq!(hear(1, 20 + GAP_US, 0), Verdict::Unknown(Doubt::Silent(0)));
    assert_eq!(Doubt::Silent(0).to_string(), "robot 0 was not heard within the gap");
}

#[test]
fn a_breach_names_its_robots_and_what_was_measured() {
    let mut chain: Monitor<_, 3> = Monitor::new(RANGE, GAP_US);
    for (robot, x_mm) in [(0, 0), (1, 2_000)] {
        chain.hear(robot, 0, Place::new(x_mm, 0));
    }
    let Verdict::Broken(breach) = chain.hear(2, 0, Place::new(2_000, 2_650)) else {
        panic!("it is out of range")
    };
    assert_eq!((breach.robots, breach.measured, breach.allowed), ([1, 2], 2_650, 2_549));
}

/// The bytes that the README says.
#[test]
fn a_monitor_takes_the_bytes_that_its_page_says() {
    let page = include_str!("../README.md");
    let sizes = [
        size_of::<Monitor<Neighbours, 4>>(),
        size_of::<Monitor<Neighbours, 16>>(),
        size_of::<Monitor<Cells, 4>>(),
    ];
    for (name, size) in ["`Neighbours` of 4", "`Neighbours` of 16", "`Cells` of 4"].into_iter().zip(sizes) {
        assert!(page.contains(&format!("| {name} | {size} |")), "{name}: {size}");
    }
}

/// Prints nanoseconds: `cargo test --release -p tautline-monitor -- --ignored --nocapture nanoseconds`.
#[test]
#[ignore = "it measures, and fails never"]
fn nanoseconds_a_position() {
    fn measured<D: Demand<N>, const N: usize>(name: &str, demand: D) {
        let mut monitor: Monitor<D, N> = Monitor::new(demand, GAP_US);
        let (rounds, start) = (2_000_000_u32, std::time::Instant::now());
        let mut kept = 0_u32;
        for number in 0..rounds {
            let robot = number as usize % N;
            let place = Place::new(2_000 * robot as i32 + (number % 7) as i32, 500);
            kept += u32::from(monitor.hear(robot, u64::from(number), place) == Verdict::Kept);
        }
        println!("{name} of {N}: {} ns, {kept} kept", start.elapsed().as_nanos() / u128::from(rounds));
    }
    measured::<_, 4>("Neighbours", RANGE);
    measured::<_, 16>("Neighbours", RANGE);
    measured::<_, 4>("Joined", LINKS);
    measured::<_, 16>("Joined", LINKS);
    measured::<_, 4>("Cells", SINGLE);
    measured::<_, 16>("Cells", SINGLE);
}
