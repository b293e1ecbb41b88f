//! Monitors against a judge of whole logs, which is written from the sentences of SPEC.md and shares nothing with them:
//! it keeps every sample, and looks at all pairs and all ways at each one.

#![expect(
    clippy::disallowed_methods,
    reason = "a test that shares nothing with what it tries has its bounds beside it"
)]

use tautline_monitor::{
    AnyDemand, Apart, Cells, Connectivity, Demand, Doubt, Monitor, Neighbours, Own, Place, Robot, SetupError,
    Track, Verdict,
};

const ROBOTS: usize = 4;
const GAP_US: u64 = 1_000_000;

/// A sample: the microseconds of its arrival, robot, the microseconds of its stamp, two coordinates in millimetres.
type Sample = (u64, usize, u64, [i32; 2]);

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
const LINKS: Connectivity = Connectivity { range_mm: 2_549, tolerance_mm: TOLERANCE_MM };
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

/// A log of robots that start side by side and go on by small steps; single samples are mutated: another place, an
/// earlier stamp, one far ahead, a long silence, a robot that there is not, a place beyond all others; some come
/// together in one cell, or go back to where they started.
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
        let taken = (at_us, robot, at_us, places[robot]);
        match chance.below(22) {
            0 => (at_us, robot, at_us, [chance.below(6_000) as i32 - 1_000, chance.below(2_000) as i32]),
            1 => (at_us, robot, at_us.saturating_sub(400_000), taken.3),
            2 => {
                at_us += 1_200_000;
                (at_us, robot, at_us, taken.3)
            }
            3 => (at_us, ROBOTS, at_us, taken.3),
            4 => (at_us, robot, at_us, [i32::MAX, 0]),
            mutation @ 5..9 => {
                places[robot] = [if mutation < 7 { 500 } else { 1_500 }, 500];
                (at_us, robot, at_us, places[robot])
            }
            9 => (at_us, robot, at_us + chance.below(2 * GAP_US), taken.3),
            10 => {
                places[robot] = [1_200 * robot as i32 + 500, 500];
                (at_us, robot, at_us, places[robot])
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
    for &(now_us, robot, at_us, place) in log {
        let last = taken.iter().rev().find(|one| one.1 == robot);
        let is_refused = robot >= ROBOTS
            || place.iter().any(|along| along.unsigned_abs() > 1_000_000_000)
            || last.is_some_and(|last| at_us < last.2)
            || at_us > now_us + GAP_US;
        if !is_refused {
            taken.push((now_us, robot, at_us, place));
        }
        let seen: Vec<Option<[i32; 2]>> = (0..ROBOTS)
            .map(|robot| {
                taken
                    .iter()
                    .rev()
                    .find(|one| one.1 == robot)
                    .filter(|one| now_us.saturating_sub(one.2) <= GAP_US)
                    .map(|one| one.3)
            })
            .collect();
        // Whether it was ever as far from its start as the demand, within its tolerance.
        let has_left = |robot: usize| {
            let mut places = taken.iter().filter(|one| one.1 == robot).map(|one| one.3);
            let start = places.next().expect("it was heard");
            places.any(|place| far(start, place) >= 1_000.0 - tolerance)
        };
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
                has_left(one) && has_left(other) && far(at, there) < 1_000.0 - tolerance
            }),
            Clause::Chain2 => most(2, Some([0, 0])),
            Clause::Frontier2 => most(1, None),
        };
        let is_whole = seen.iter().all(Option::is_some);
        verdicts.push(if is_broken { Some(true) } else { (is_whole && !is_refused).then_some(false) });
    }
    verdicts
}

/// The verdicts of a monitor that hears the log.
fn monitored<const N: usize>(demand: impl Demand, gap_us: u64, log: &[Sample]) -> Vec<Option<bool>> {
    let mut monitor = Monitor::new(demand, gap_us, [Robot::UNHEARD; N]).expect("a monitor");
    let hear = |&(now_us, robot, at_us, [x_mm, y_mm]): &Sample| match monitor.hear(
        now_us,
        robot,
        at_us,
        Place::new(x_mm, y_mm),
    ) {
        Verdict::Kept => Some(false),
        Verdict::Broken(_) => Some(true),
        Verdict::Unknown(_) => None,
    };
    log.iter().map(hear).collect()
}

fn watched(clause: Clause, log: &[Sample]) -> Vec<Option<bool>> {
    match clause {
        Clause::Chain3 => monitored::<ROBOTS>(RANGE, GAP_US, log),
        Clause::Kit12 => monitored::<ROBOTS>(LINKS, GAP_US, log),
        Clause::Kit3 => monitored::<ROBOTS>(APART, GAP_US, log),
        Clause::Chain2 => monitored::<ROBOTS>(PAIRS, GAP_US, log),
        Clause::Frontier2 => monitored::<ROBOTS>(SINGLE, GAP_US, log),
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
    let mutants: [Mutant; 11] = [
        ("a range that is a tolerance too long", Clause::Chain3, |log| {
            monitored::<ROBOTS>(Neighbours { tolerance_mm: 2 * TOLERANCE_MM, ..RANGE }, GAP_US, log)
        }),
        ("a range without its tolerance", Clause::Chain3, |log| {
            monitored::<ROBOTS>(Neighbours { tolerance_mm: 0, ..RANGE }, GAP_US, log)
        }),
        ("a robot left out", Clause::Chain3, |log| monitored::<{ ROBOTS - 1 }>(RANGE, GAP_US, log)),
        ("positions that never grow old", Clause::Chain3, |log| monitored::<ROBOTS>(RANGE, u64::MAX, log)),
        ("links of neighbours alone", Clause::Kit12, |log| monitored::<ROBOTS>(RANGE, GAP_US, log)),
        ("starts that count", Clause::Kit3, |log| {
            let near = |track: &Track<&mut [Robot]>| {
                let is_near = |[one, other]: &[(usize, Place); 2]| {
                    f64::from(one.1.x_mm - other.1.x_mm).hypot(f64::from(one.1.y_mm - other.1.y_mm)) < 900.0
                };
                let [one, other] = track.pairs().find(is_near)?;
                Some(tautline_monitor::Breach { robots: [one.0, other.0], measured: 0, allowed: 1_000 })
            };
            monitored::<ROBOTS>(Own(near), GAP_US, log)
        }),
        ("starts that count once a robot is back", Clause::Kit3, |log| {
            let mut starts = [None; ROBOTS];
            let is_taken = |one: &&Sample| one.1 < ROBOTS && one.3[0] != i32::MAX && one.2 <= one.0 + GAP_US;
            for one in log.iter().rev().filter(is_taken) {
                starts[one.1] = Some(Place::new(one.3[0], one.3[1]));
            }
            let far = |one: Place, other: Place| {
                f64::from(one.x_mm - other.x_mm).hypot(f64::from(one.y_mm - other.y_mm))
            };
            let near = move |track: &Track<&mut [Robot]>| {
                let has_left =
                    |(robot, at): (usize, Place)| starts[robot].is_some_and(|start| far(start, at) > 900.0);
                let mut pairs = track.pairs().filter(|[one, other]| far(one.1, other.1) < 900.0);
                let [one, other] = pairs.find(|[one, other]| has_left(*one) && has_left(*other))?;
                Some(tautline_monitor::Breach { robots: [one.0, other.0], measured: 0, allowed: 1_000 })
            };
            monitored::<ROBOTS>(Own(near), GAP_US, log)
        }),
        ("stamps that are always believed", Clause::Chain3, |log| {
            let at_once = |&(now_us, robot, at_us, place): &Sample| (now_us.max(at_us), robot, at_us, place);
            monitored::<ROBOTS>(RANGE, GAP_US, &log.iter().map(at_once).collect::<Vec<_>>())
        }),
        ("a base like any cell", Clause::Chain2, |log| {
            monitored::<ROBOTS>(Cells { base: None, ..PAIRS }, GAP_US, log)
        }),
        ("one robot more in a cell", Clause::Frontier2, |log| {
            monitored::<ROBOTS>(Cells { most: 2, ..SINGLE }, GAP_US, log)
        }),
        ("borders that are no doubt", Clause::Frontier2, |log| {
            monitored::<ROBOTS>(Cells { tolerance_mm: 0, ..SINGLE }, GAP_US, log)
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
fn what_nothing_would_break_is_refused() {
    let refused = |demand: AnyDemand, robots: usize| {
        Monitor::new(demand, GAP_US, vec![Robot::UNHEARD; robots]).err().map(|error| error.to_string())
    };
    let demands = |off: u32| {
        let at_most = |length: u32| length - off;
        [
            AnyDemand::Neighbours(Neighbours { tolerance_mm: at_most(2_549), ..RANGE }),
            AnyDemand::Connectivity(Connectivity { tolerance_mm: at_most(2_549), ..LINKS }),
            AnyDemand::Apart(Apart { tolerance_mm: at_most(1_000), ..APART }),
            AnyDemand::Cells(Cells { tolerance_mm: at_most(500), ..PAIRS }),
        ]
    };
    for (blind, seeing) in demands(0).into_iter().zip(demands(1)) {
        assert!(refused(blind, 2).expect("refused").starts_with("with this tolerance"), "{blind:?}");
        assert_eq!(refused(seeing, 2), None, "{seeing:?}");
        assert_eq!(refused(seeing, 0).as_deref(), Some("there are no robots: give at least one"));
    }
    let endless = Neighbours { tolerance_mm: u32::MAX, ..RANGE };
    assert!(matches!(Monitor::new(endless, GAP_US, [Robot::UNHEARD; 2]), Err(SetupError::Blind)));
}

#[test]
fn what_cannot_be_taken_is_said() {
    let mut monitor = Monitor::new(LINKS, GAP_US, [Robot::UNHEARD; 2]).expect("a monitor");
    let mut hear =
        |robot, at_us: u64, x_mm| monitor.hear(at_us.min(GAP_US + 20), robot, at_us, Place::new(x_mm, 0));
    assert_eq!(hear(0, 10, 0), Verdict::Unknown(Doubt::Silent(1)));
    assert_eq!(hear(2, 20, 0), Verdict::Unknown(Doubt::Nobody(2)));
    assert_eq!(hear(1, 20, i32::MIN), Verdict::Unknown(Doubt::TooFar));
    assert_eq!(hear(1, 20, 0), Verdict::Kept);
    assert_eq!(hear(1, 19, 0), Verdict::Unknown(Doubt::Late));
    // The other one is silent for longer than the gap.
    assert_eq!(hear(1, 20 + GAP_US, 0), Verdict::Unknown(Doubt::Silent(0)));
    assert_eq!(hear(1, 2 * GAP_US + 21, 0), Verdict::Unknown(Doubt::Ahead));
    assert_eq!(hear(0, 2 * GAP_US + 20, 0), Verdict::Kept);
    // Silence is said although nobody is heard.
    assert_eq!(monitor.at(3 * GAP_US), Verdict::Unknown(Doubt::Silent(1)));
    assert_eq!(Doubt::Silent(0).to_string(), "robot 0 was not heard within the gap");
}

#[test]
fn a_position_that_is_not_taken_hides_no_breach() {
    let mut chain = Monitor::new(RANGE, GAP_US, [Robot::UNHEARD; 2]).expect("a monitor");
    chain.hear(10, 0, 10, Place::new(0, 0));
    let broken = chain.hear(10, 1, 10, Place::new(5_000, 0));
    assert!(matches!(broken, Verdict::Broken(_)));
    for (robot, at_us, x_mm) in [(1, 5, 0), (1, 2 * GAP_US, 0), (2, 20, 0), (0, 20, i32::MAX)] {
        assert_eq!(chain.hear(20, robot, at_us, Place::new(x_mm, 0)), broken, "{robot} {at_us} {x_mm}");
    }
    // Once the breach is too old to be believed, the reason is told.
    assert_eq!(chain.hear(11 + GAP_US, 1, 5, Place::new(0, 0)), Verdict::Unknown(Doubt::Late));
}

#[test]
fn where_no_robot_may_be_one_is_a_breach() {
    let mut cell = Monitor::new(Cells { most: 0, ..PAIRS }, GAP_US, [Robot::UNHEARD; 2]).expect("a monitor");
    cell.hear(0, 0, 0, Place::new(500, 500));
    let Verdict::Broken(breach) = cell.hear(0, 1, 0, Place::new(2_500, 500)) else {
        panic!("a robot is in a cell")
    };
    assert_eq!((breach.robots, breach.measured, breach.allowed), ([1, 1], 1, 0));
}

#[test]
fn a_breach_names_its_robots_and_what_was_measured() {
    let mut chain = Monitor::new(RANGE, GAP_US, [Robot::UNHEARD; 3]).expect("a monitor");
    for (robot, x_mm) in [(0, 0), (1, 2_000)] {
        chain.hear(0, robot, 0, Place::new(x_mm, 0));
    }
    let Verdict::Broken(breach) = chain.hear(0, 2, 0, Place::new(2_000, 2_650)) else {
        panic!("it is out of range")
    };
    assert_eq!((breach.robots, breach.measured, breach.allowed), ([1, 2], 2_650, 2_549));
}

/// The bytes that the README says.
#[test]
fn a_monitor_takes_the_bytes_that_its_page_says() {
    let page = include_str!("../README.md");
    let sizes = [
        size_of::<Monitor<Neighbours, [Robot; 4]>>(),
        size_of::<Monitor<Neighbours, [Robot; 16]>>(),
        size_of::<Monitor<Cells, [Robot; 4]>>(),
    ];
    for (name, size) in ["`Neighbours` of 4", "`Neighbours` of 16", "`Cells` of 4"].into_iter().zip(sizes) {
        assert!(page.contains(&format!("| {name} | {size} |")), "{name}: {size}");
    }
}

/// Prints nanoseconds: `cargo test --release -p tautline-monitor -- --ignored --nocapture nanoseconds`.
#[test]
#[ignore = "it measures, and fails never"]
fn nanoseconds_a_position() {
    fn measured<const N: usize>(name: &str, demand: impl Demand) {
        let mut monitor = Monitor::new(demand, GAP_US, [Robot::UNHEARD; N]).expect("a monitor");
        let (rounds, start) = (2_000_000_u32, std::time::Instant::now());
        let mut kept = 0_u32;
        for number in 0..rounds {
            let robot = number as usize % N;
            let place = Place::new(2_000 * robot as i32 + (number % 7) as i32, 500);
            kept +=
                u32::from(monitor.hear(u64::from(number), robot, u64::from(number), place) == Verdict::Kept);
        }
        println!("{name} of {N}: {} ns, {kept} kept", start.elapsed().as_nanos() / u128::from(rounds));
    }
    measured::<4>("Neighbours", RANGE);
    measured::<16>("Neighbours", RANGE);
    measured::<4>("Joined", LINKS);
    measured::<16>("Joined", LINKS);
    measured::<4>("Cells", SINGLE);
    measured::<16>("Cells", SINGLE);
}
