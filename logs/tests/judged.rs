//! The judge on small logs whose verdicts are seen by hand, and wrong judges, each of which one of these logs finds.

use std::fmt::Write;

use tautline_logs::{Breach, Demand, Doubt, Grid, Group, Limits, Numbers, Tracks, Verdict, judge, read};

const LIMITS: Limits = Limits { tolerance_mm: 100, gap_us: 1_000_000, jump_us: 60_000_000 };
const GRID: Grid = Grid { origin_mm: [0.0, 0.0], cell_mm: 1_000.0 };
const RANGE: Demand = Demand::Neighbours { range_mm: 2_549 };
const JOINED: Demand = Demand::Joined { range_mm: 2_549, of: Group::JoinedAtStart };
const APART: Demand = Demand::Apart { least_mm: 3_000 };
const CHAIN_2: Demand = Demand::Crowd { grid: GRID, most: 2, base: Some([0, 0]) };
const FRONTIER_2: Demand = Demand::Crowd { grid: GRID, most: 1, base: None };

fn row(cells: &[[i32; 2]], is_whole: bool) -> Demand {
    Demand::Visited { grid: GRID, cells: cells.to_vec(), is_whole }
}

/// The tracks of rows: the tenths of a second, and the place of each robot along the first axis in millimetres, or
/// `-`. All are in the middle of the first row of cells.
fn tracks(rows: &str, limits: &Limits) -> Tracks {
    let mut text = "t_ms,robot,x_mm,y_mm\n".to_owned();
    for row in rows.split("; ") {
        let (tenths, places) = row.split_once(' ').expect("a time");
        for (robot, x) in places.split(' ').enumerate().filter(|(_, x)| *x != "-") {
            writeln!(text, "{tenths}00,{robot},{x},500").expect("a string");
        }
    }
    let log = read(text.as_bytes()).expect("a log");
    Tracks::new(&log, &Numbers::natural(&log.names), limits)
}

/// Logs, each with what it is held to, and when it is broken in tenths of a second, kept or unknown.
fn cases() -> Vec<(&'static str, &'static str, Demand, Result<i64, bool>)> {
    let kept = Err(true);
    let unknown = Err(false);
    vec![
        ("in range within the tolerance", "0 0 2600", RANGE, kept),
        ("out of range", "0 0 2000; 5 0 2650", RANGE, Ok(5)),
        ("far from a robot that is no neighbour", "0 0 2000 4000", RANGE, kept),
        ("between two positions", "0 0 2000; 5 - 4000; 8 3000 4000", RANGE, kept),
        ("silent", "0 0 0; 5 - 9000; 11 9000 9000", RANGE, unknown),
        ("silent, and broken", "0 0 0; 11 0 9000", RANGE, Ok(11)),
        ("silent at the end", "0 0 0; 9 - 0; 18 - 0", RANGE, unknown),
        ("in range behind the last position of one", "0 0 2000; 6 - 2100", RANGE, kept),
        ("out of range behind the last position of one", "0 0 2000; 6 - 9000", RANGE, unknown),
        ("out of range before the first position of one", "0 - 4000; 5 0 2000", RANGE, unknown),
        ("most positions late", "9 0 2000; 8 0 2000; 7 0 2000", RANGE, unknown),
        ("half of the positions late", "9 0 2000; 8 0 2000", RANGE, kept),
        (
            "at two places at once, the far one first",
            "0 0 2000; 5 0 9000; 5 - 2000; 9 0 2000",
            RANGE,
            unknown,
        ),
        (
            "at two places at once, the near one first",
            "0 0 2000; 5 0 2000; 5 - 9000; 9 0 2000",
            RANGE,
            unknown,
        ),
        ("at two places at once, and broken", "0 0 2000; 5 0 9000; 5 - 2000; 9 0 9000", RANGE, Ok(9)),
        ("at two places within the tolerance", "0 0 2000; 5 0 2100; 5 - 2000", RANGE, kept),
        ("alone", "0 0", RANGE, unknown),
        ("joined over another", "0 0 4000 2000", JOINED, kept),
        ("parted", "0 0 2000; 5 0 3000", JOINED, Ok(5)),
        ("parted from the start on", "0 0 3000; 5 0 3000", JOINED, unknown),
        (
            "parted where all have to be joined",
            "0 0 3000",
            Demand::Joined { range_mm: 2_549, of: Group::All },
            Ok(0),
        ),
        ("near at the starts", "0 0 1000; 5 2000 1000", APART, kept),
        ("near, and one has never left", "0 0 9000; 5 4000 9000; 10 8000 9000", APART, kept),
        (
            "near beside the start of one that has come back",
            "0 0 9000; 5 4000 13000; 10 8000 9000",
            APART,
            Ok(10),
        ),
        ("near before one of them leaves its start", "0 0 9000; 5 8000 9000; 9 8000 20000", APART, kept),
        ("near within the tolerance", "0 0 9000; 5 4000 13000; 10 6050 9000", APART, kept),
        ("near a node away from their start", "0 3000 3000; 3 6000 3000; 6 1000 50", APART, Ok(6)),
        ("near on the way from their start", "0 3000 3000; 3 6000 3000; 6 3000 2700", APART, unknown),
        ("head on", "0 0 4000; 2 1900 2100", APART, unknown),
        ("on two ways from one start", "0 3000 3000; 1 4000 2000", APART, kept),
        ("three in a cell", "0 500 1500 1200; 5 1800 1500 1500", CHAIN_2, Ok(5)),
        ("two in a cell", "0 500 1500 1200", CHAIN_2, kept),
        ("three in the base", "0 500 500 500", CHAIN_2, kept),
        ("two in a cell of one", "0 500 500", FRONTIER_2, Ok(0)),
        ("in one cell or beside it", "0 500 950", FRONTIER_2, unknown),
        ("in two cells, or in one within the tolerance", "0 500 1050", FRONTIER_2, kept),
        ("at one point of a border", "0 1000 1000", FRONTIER_2, unknown),
        ("in two cells, or at one point", "0 950 1050", FRONTIER_2, unknown),
        ("three at one point of a border", "0 1000 1000 1000", FRONTIER_2, Ok(0)),
        ("one behind the other over a border", "0 500 1500; 5 990 1990; 9 1500 2500", FRONTIER_2, kept),
        (
            "at one point of a border, one before the other has a position",
            "0 - 9000; 5 2000 2000",
            FRONTIER_2,
            unknown,
        ),
        ("three at one point of a border of cells of two", "0 500 2000 2000 2000", CHAIN_2, unknown),
        ("five at one point of a border of cells of two", "0 500 2000 2000 2000 2000 2000", CHAIN_2, Ok(0)),
        ("five at a border of the base", "0 1000 1000 1000 1000 1000", CHAIN_2, unknown),
        ("nothing to be visited", "0 500", row(&[], true), unknown),
        ("all visited", "0 500; 9 2500", row(&[[0, 0], [1, 0], [2, 0]], true), kept),
        ("one not visited", "0 500; 9 1500", row(&[[0, 0], [1, 0], [2, 0]], true), Ok(9)),
        ("at its border", "0 500; 9 1950", row(&[[0, 0], [1, 0], [2, 0]], true), unknown),
        (
            "within it by less than the tolerance",
            "0 500; 9 2050",
            row(&[[0, 0], [1, 0], [2, 0]], true),
            unknown,
        ),
        ("passed in a silence", "0 500; 11 2500", row(&[[0, 0], [1, 0], [2, 0]], true), unknown),
        ("visited perhaps in a silence", "0 500; 11 1500", row(&[[0, 0], [2, 0]], true), unknown),
        ("visited on neither of two ways", "0 500; 5 2500; 5 500; 9 2500", row(&[[1, 0]], true), unknown),
        ("visited beside two places at once", "0 500; 5 9500; 5 500; 9 500", row(&[[0, 0]], true), kept),
        ("perhaps later", "0 500; 9 1500", row(&[[0, 0], [2, 0]], false), unknown),
    ]
}

/// The moment of a breach, in tenths of a second, or whether the clause is kept.
fn short(verdict: Verdict) -> Result<i64, bool> {
    match verdict {
        Verdict::Broken(breach) => Ok(breach.at_us / 100_000),
        Verdict::Kept => Err(true),
        Verdict::Unknown(_) => Err(false),
    }
}

#[test]
fn small_logs_are_judged_as_seen_by_hand() {
    for (name, rows, demand, expected) in cases() {
        let verdict = judge(&tracks(rows, &LIMITS), &LIMITS, &demand).expect("few");
        assert_eq!(short(verdict), expected, "{name}");
    }
}

/// A wrong judge: its name, and its limits and its demand in place of the right ones.
type Mutant = (&'static str, fn(Limits, Demand) -> (Limits, Demand));

#[test]
fn each_wrong_judge_is_found() {
    let mutants: [Mutant; 12] = [
        ("twice the tolerance", |limits, demand| (Limits { tolerance_mm: 200, ..limits }, demand)),
        ("no tolerance", |limits, demand| (Limits { tolerance_mm: 0, ..limits }, demand)),
        ("robots that are never silent", |limits, demand| (Limits { gap_us: u64::MAX, ..limits }, demand)),
        ("robots that are always silent", |limits, demand| (Limits { gap_us: 1, ..limits }, demand)),
        ("all pairs for neighbours", |limits, demand| match demand {
            Demand::Neighbours { range_mm } => {
                (limits, Demand::Joined { range_mm: range_mm / 2, of: Group::All })
            }
            other => (limits, other),
        }),
        ("neighbours for all that are joined", |limits, demand| match demand {
            Demand::Joined { range_mm, .. } => (limits, Demand::Neighbours { range_mm }),
            other => (limits, other),
        }),
        ("no start", |limits, demand| match demand {
            Demand::Joined { range_mm, .. } => (limits, Demand::Joined { range_mm, of: Group::All }),
            other => (limits, other),
        }),
        ("always a start", |limits, demand| match demand {
            Demand::Joined { range_mm, .. } => {
                (limits, Demand::Joined { range_mm, of: Group::JoinedAtStart })
            }
            other => (limits, other),
        }),
        ("a base like any cell", |limits, demand| match demand {
            Demand::Crowd { grid, most, .. } => (limits, Demand::Crowd { grid, most, base: None }),
            other => (limits, other),
        }),
        ("one more in a cell", |limits, demand| match demand {
            Demand::Crowd { grid, most, base } => (limits, Demand::Crowd { grid, most: most + 1, base }),
            other => (limits, other),
        }),
        ("cells from their middles on", |limits, demand| match demand {
            Demand::Crowd { grid, most, base } => {
                (limits, Demand::Crowd { grid: Grid { origin_mm: [500.0, 0.0], ..grid }, most, base })
            }
            other => (limits, other),
        }),
        ("a log that is never cut", |limits, demand| match demand {
            Demand::Visited { grid, cells, .. } => (limits, Demand::Visited { grid, cells, is_whole: true }),
            other => (limits, other),
        }),
    ];
    for (name, mutated) in mutants {
        let is_found = cases().into_iter().any(|(_, rows, demand, expected)| {
            let (limits, demand) = mutated(LIMITS, demand);
            short(judge(&tracks(rows, &limits), &limits, &demand).expect("few")) != expected
        });
        assert!(is_found, "{name}");
    }
}

#[test]
fn a_breach_says_who_when_how_far_and_where_in_the_log() {
    let rows = "0 0 0 0; 5 0 0 3000; 9 - 0 3000";
    let Ok(Verdict::Broken(breach)) = judge(&tracks(rows, &LIMITS), &LIMITS, &RANGE) else {
        panic!("it is broken")
    };
    let expected = Breach {
        at_us: 500_000,
        robots: vec![1, 2],
        measured: 3_000,
        allowed: 2_549,
        cells: Vec::new(),
        place: 7,
        moments: 2,
    };
    assert_eq!(breach, expected);
}

#[test]
fn of_several_breaches_at_once_the_worst_is_told() {
    let told = |rows: &str, demand: Demand| match judge(&tracks(rows, &LIMITS), &LIMITS, &demand) {
        Ok(Verdict::Broken(Breach { robots, measured, cells, .. })) => (robots, measured, cells),
        other => panic!("{other:?}"),
    };
    assert_eq!(told("0 0 3000 6500 9500", RANGE), (vec![1, 2], 3_500, vec![]));
    let away = "0 0 20000 40000; 5 60000 61000 63000";
    assert_eq!(told(away, APART), (vec![0, 1], 1_000, vec![]), "not the 2 m between the others");
    let crowds = "0 1500 1500 3500 3500 3500 5500 5500";
    assert_eq!(told(crowds, FRONTIER_2), (vec![2, 3, 4], 3, vec![[3, 0]]));
    assert_eq!(
        told("0 500; 9 1500", row(&[[0, 0], [2, 0], [3, 0]], true)),
        (vec![], 2, vec![[2, 0], [3, 0]]),
        "both cells are counted and named"
    );
}

#[test]
fn a_log_that_is_cut_is_kept_by_no_clause_that_a_later_position_can_break() {
    let log = |rest: &str| {
        let log =
            read(format!("time,robot,x,y\n0,a,0.5,0.5\n0,b,1.5,0.5\n{rest}").as_bytes()).expect("a log");
        Tracks::new(&log, &Numbers::natural(&log.names), &LIMITS)
    };
    let told = |tracks: &Tracks, demand: &Demand| judge(tracks, &LIMITS, demand).expect("few");
    for demand in [RANGE, JOINED, CHAIN_2, FRONTIER_2] {
        assert_eq!(told(&log("0.5,a,0.5,0.5\n"), &demand), Verdict::Kept, "{demand:?}");
        assert_eq!(told(&log("0.5,a,0."), &demand), Verdict::Unknown(Doubt::Cut), "{demand:?}");
    }
    assert_eq!(short(told(&log("0,c,9,0.5\n0.5,a,0."), &RANGE)), Ok(0), "what is broken stays so");
    let visited = row(&[[0, 0], [1, 0]], false);
    assert_eq!(told(&log("0.5,a,0."), &visited), Verdict::Kept, "a cell that was visited stays so");
}

#[test]
fn a_doubt_at_a_border_says_when_who_and_which_cell() {
    let at_a_point = tracks("0 500 2500; 5 1000 1000", &LIMITS);
    let verdict = judge(&at_a_point, &LIMITS, &FRONTIER_2);
    assert_eq!(verdict, Ok(Verdict::Unknown(Doubt::Border(500_000, [0, 0], vec![0, 1]))));
    let three = tracks("0 1000 1000 1000", &LIMITS);
    let Ok(Verdict::Broken(Breach { robots, measured, allowed, cells, .. })) =
        judge(&three, &LIMITS, &FRONTIER_2)
    else {
        panic!("two cells have three robots")
    };
    assert_eq!((robots, measured, allowed, cells), (vec![0, 1, 2], 3, 2, vec![[0, 0], [1, 0]]));
}

#[test]
fn a_silence_says_who_and_how_long() {
    let rows = "0 0 0; 5 0 -; 11 0 0";
    let Ok(Verdict::Unknown(Doubt::Silent(silence, 1))) = judge(&tracks(rows, &LIMITS), &LIMITS, &RANGE)
    else {
        panic!("robot 1 is silent")
    };
    assert_eq!((silence.robot, silence.from_us, silence.to_us), (1, 0, 1_100_000));
}

#[test]
fn too_many_robots_are_refused_before_any_is_compared() {
    let mut rows = "t,robot,x,y\n".to_owned();
    (0..100_000).for_each(|robot| writeln!(rows, "0,{robot},{robot},0").expect("a string"));
    let log = read(rows.as_bytes()).expect("a log");
    let tracks = Tracks::new(&log, &Numbers::natural(&log.names), &LIMITS);
    assert!(judge(&tracks, &LIMITS, &JOINED).expect_err("too much").comparisons == 10_000_000_000);
    assert_eq!(judge(&tracks, &LIMITS, &RANGE), Ok(Verdict::Kept));
    assert!(matches!(judge(&tracks, &LIMITS, &FRONTIER_2), Ok(Verdict::Kept)));
}
