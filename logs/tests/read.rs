//! Logs that are read, and the words for those that are cut, damaged or of no use.

use tautline_logs::{
    Demand, Doubt, Fault, FaultPlace, Limits, Log, NamesError, Numbers, Silence, Tracks, Verdict, judge, read,
};

use super::forms::{self, Row};

const ROWS: [Row<'_>; 6] = [
    (1_700_000_000_000_000, "/robot_a", [1_000, -2_000]),
    (1_700_000_000_000_250, "/robot_b", [0, 5]),
    (1_700_000_000_500_000, "/robot_c", [1_234, 0]),
    (1_700_000_000_600_000, "/robot_d", [1, 2]),
    (1_700_000_000_700_000, "/robot_e", [3, 4]),
    (1_700_000_001_000_000, "/robot_a", [1_100, -2_000]),
];

fn rows(log: &Log) -> Vec<Row<'_>> {
    let row = |sample: &tautline_logs::Sample| {
        (sample.at_us, log.names[sample.robot as usize].as_str(), [sample.x_mm, sample.y_mm])
    };
    log.samples.iter().map(row).collect()
}

fn line(fault: &Fault) -> Option<usize> {
    match fault.place {
        FaultPlace::Line { line, .. } => Some(line),
        FaultPlace::Whole | FaultPlace::Message(_) => None,
    }
}

#[test]
fn every_form_yields_the_positions_that_were_written() {
    for bytes in [forms::csv(&ROWS), forms::json(&ROWS), forms::mcap(&ROWS, false), forms::mcap(&ROWS, true)]
    {
        let log = read(&bytes).expect("a log");
        assert_eq!(rows(&log), ROWS, "{:?}", log.form);
        assert_eq!((log.cut, log.unplaced), (None, None));
    }
    let places = |bytes: &[u8]| -> Vec<u32> {
        read(bytes).expect("a log").samples.iter().map(|one| one.place).collect()
    };
    let table = String::from_utf8(forms::csv(&ROWS)).expect("text");
    for ends in ["\n", "\r\n"] {
        assert_eq!(places(table.replace('\n', ends).as_bytes()), [2, 3, 4, 5, 6, 7]);
        assert_eq!(places(table.replace('\n', &ends.repeat(2)).as_bytes()), [3, 5, 7, 9, 11, 13]);
    }
}

/// `logs/sumo-fcd.csv`: floating car data as Eclipse SUMO 1.28.0 writes them (`sumo --fcd-output fcd.csv`), of three
/// carts one behind the other. `logs/rosbags.mcap`: a recording of ROS 2, written by the library rosbags 0.11.9.
#[test]
fn logs_of_other_programs_are_read() {
    let log = read(include_bytes!("logs/sumo-fcd.csv")).expect("a log");
    assert_eq!((log.names.join(" "), log.cut), ("cart_0 cart_1 cart_2".to_owned(), None));
    assert_eq!(rows(&log)[2], (1_000_000, "cart_0", [1_600, 7_800]));
    let log = read(include_bytes!("logs/rosbags.mcap")).expect("a log");
    assert_eq!(
        (log.names.join(" "), log.frames.join(" ")),
        ("/ugv1/pose /ugv2/odom".to_owned(), "map".to_owned())
    );
    assert_eq!(rows(&log)[3], (1_700_000_000_250_000, "/ugv2/odom", [1_000, 1_000]));
    assert_eq!(log.samples.len(), 16);
}

#[test]
fn a_log_that_is_cut_anywhere_is_read_up_to_there() {
    for bytes in [forms::csv(&ROWS), forms::json(&ROWS), forms::mcap(&ROWS, false)] {
        for end in 0..bytes.len() {
            let Ok(log) = read(&bytes[..end]) else { continue };
            let taken = rows(&log);
            assert_eq!(taken, ROWS[..taken.len()], "{:?}, {end} bytes", log.form);
        }
    }
    let cut = |bytes: &[u8]| read(bytes).expect("a log").cut;
    assert_eq!(cut(b"t,robot,x,y\n0,a,0,0\n1,a,0,12"), Some(3));
    assert_eq!(cut(b"t,robot,x,y,z\n0,a,0,0,0\n1,a,0,12,1"), None);
    assert_eq!(cut(b"{\"t\":0,\"robot\":1,\"x\":0,\"y\":0}\n{\"t\":0,\"rob"), Some(2));
    let whole = forms::mcap(&ROWS, false);
    assert!(cut(&whole[..whole.len() - 1]).is_some());
}

#[test]
fn damaged_logs_are_refused_with_the_place() {
    let faults: [(&[u8], Option<usize>, &str); 17] = [
        (b"t,robot,x,y\n,,,\n0,,0,0\n", Some(3), "no robot"),
        (b"", None, "the log is empty"),
        (b"t,robot,x,y\n", None, "no position"),
        (b"t,robot,x\n0,a,0\n", Some(1), "no column for y"),
        (b"t,time,robot,x,y\n", Some(1), "a second column for the time"),
        (b"t,robot,x,y\n0,a,0,0\n0,a,1.0.0,0\n", Some(3), "\"1.0.0\" is no number"),
        (b"t,robot,x,y\n0,a,0\n0,a,0,0\n", Some(2), "no field 4"),
        (b"t,robot,x,y\n0,a,1,5,0,0\n", Some(2), "6 fields, and the first one 4"),
        (b"t,robot,x,y\ninf,a,0,0\n", Some(2), "no such time"),
        (b"t,robot,x,y\n0,\xff,0,0\n", Some(2), "not UTF-8 text"),
        (b"{\"t\":0,\"robot\":\"a\",\"x\":0}\n", Some(1), "no y"),
        (b"{\"t\":0,\"x\":0,\"y\":0}\n", Some(1), "no robot"),
        (b"{\"t\":0,\"robot\":\"a\",\"id\":1,\"x\":0,\"y\":0}\n", Some(1), "two robots"),
        (b"{\"t\":0,\"robot\":\"a\",\"x\":0,\"x_mm\":0,\"y\":0}\n", Some(1), "two x"),
        (b"{\"t\":1.7e18,\"robot\":\"a\",\"x\":0,\"y\":0}\n", Some(1), "no such time"),
        (b"{\"t\":0,\"robot\":\"a\",\"x\":0,\"y\":0}\n[]\n", Some(2), "no object"),
        (b"\x89MCAP1\r\n", None, "no MCAP"),
    ];
    for (bytes, place, what) in faults {
        let fault = read(bytes).expect_err(what);
        assert!(fault.to_string().contains(what) && line(&fault) == place, "{fault} {:?}", fault.place);
    }
    // Whatever byte is another one: no panic.
    let whole = forms::mcap(&ROWS, false);
    for place in 0..whole.len() {
        let mut bytes = whole.clone();
        bytes[place] ^= 0x55;
        let _ = read(&bytes);
        // Nor is there one where a length is any other.
        for length in [0, 5, 200, 1 << 40, u64::MAX - 9, u64::MAX] {
            let mut bytes = whole.clone();
            bytes.splice(place..whole.len().min(place + 8), length.to_le_bytes());
            let _ = read(&bytes);
        }
    }
    let endless = [mcap::MAGIC, &[1], &u64::MAX.to_le_bytes()].concat();
    assert_eq!(
        read(&endless).expect_err("no end").what,
        "a record of this MCAP says that it ends where none can"
    );
}

#[test]
fn numbers_that_are_none_are_counted() {
    let log = read(b"t,robot,x,y\n0,a,0,0\n1,a,NaN,0\n2,a,1e10,0\n").expect("a log");
    assert_eq!((log.samples.len(), log.unplaced), (1, Some((2, 3))));
    let log = read(b"{\"t\":0,\"robot\":1,\"x\":0,\"y\":0}\n{\"t\":1,\"robot\":1,\"x\":null,\"y\":0}\n")
        .expect("a log");
    assert_eq!((log.samples.len(), log.unplaced), (1, Some((1, 2))));
}

#[test]
fn a_robot_without_a_valid_position_has_its_number_and_is_silent() {
    let log = read(b"t,robot,x,y\n0,r1,0,0\n0,r2,NaN,NaN\n0,r3,4,0\n2,r1,0,0\n").expect("a log");
    assert_eq!(log.names, ["r1", "r2", "r3"]);
    let tracks = Tracks::new(&log, &Numbers::natural(&log.names), &LIMITS);
    assert_eq!(tracks.at(2, 0), Some([4_000.0, 0.0]));
    // Also where the whole log is shorter than the gap.
    let short = read(b"t,robot,x,y\n0,r1,0,0\n0,r2,NaN,NaN\n0.5,r1,0,0\n").expect("a log");
    let silent = Tracks::new(&short, &Numbers::natural(&short.names), &LIMITS);
    let robots: Vec<u32> = silent.silences().map(|silence| silence.robot).collect();
    assert_eq!(robots, [1]);
    let silence = Silence { robot: 1, from_us: 0, to_us: 2_000_000 };
    assert!(tracks.silences().any(|other| other == silence));
    let verdict = judge(&tracks, &LIMITS, &Demand::Neighbours { range_mm: 2_549 });
    assert!(matches!(verdict, Ok(Verdict::Unknown(Doubt::Silent(..)))), "{verdict:?}");
}

const LIMITS: Limits = Limits { tolerance_mm: 50, gap_us: 1_000_000, jump_us: 10_000_000 };

#[test]
fn late_and_far_stamps_are_not_taken() {
    let rows = "t,robot,x,y\n0,a,0,0\n1,a,1,0\n0.5,a,9,0\n5000,b,0,0\n1.2,b,0,0\n0,b,0,0\n2,a,2,0\n2,c,0,0\n";
    let log = read(rows.as_bytes()).expect("a log");
    let numbers = Numbers::named(&log.names, "name,robot\n b , 1\na,2\n").expect("numbers");
    let tracks = Tracks::new(&log, &numbers, &LIMITS);
    let refused = tracks.refused();
    assert_eq!((refused.late, refused.astray, refused.nobody), (Some((2, 4)), Some((1, 5)), Some((1, 9))));
    assert_eq!(tracks.at(1, 1_500_000), Some([1_500.0, 0.0]));
    assert_eq!(tracks.at(0, 1_500_000), None);
    let log = read(b"t,robot,x,y\n0,a,0,0\n1,a,1.04,0\n1,a,1,0\n1,a,1,0\n").expect("a log");
    let tracks = Tracks::new(&log, &Numbers::natural(&log.names), &LIMITS);
    assert_eq!((tracks.at(0, 1_000_000), tracks.refused().replaced), (Some([1_000.0, 0.0]), Some((1, 3))));
    // None of the places of a robot that is at several ones at a stamp is taken, nor the straight way past it.
    let several = read(b"t,robot,x,y\n0.5,a,0,0\n1,a,9,0\n1,a,1,0\n1,a,1,0\n1.2,a,1,0\n").expect("a log");
    let tracks = Tracks::new(&several, &Numbers::natural(&several.names), &LIMITS);
    assert_eq!((tracks.refused().contradicted, tracks.refused().replaced), (Some((3, 3)), None));
    assert_eq!(tracks.contradictions().collect::<Vec<_>>(), [(0, 1_000_000, 4)]);
    assert_eq!(
        [500_000, 1_000_000, 1_100_000].map(|at_us| tracks.at(0, at_us)),
        [Some([0.0, 0.0]), None, None]
    );
    // Each is within the tolerance of the next, and the first is not of the last.
    let creeping =
        read(b"t,robot,x,y\n0,a,0,0\n1,a,1,0\n1,a,1.04,0\n1,a,1.08,0\n2,a,1.08,0\n").expect("a log");
    let tracks = Tracks::new(&creeping, &Numbers::natural(&creeping.names), &LIMITS);
    assert_eq!((tracks.refused().replaced, tracks.refused().contradicted), (Some((1, 3)), Some((2, 4))));
    assert_eq!(tracks.contradictions().collect::<Vec<_>>(), [(0, 1_000_000, 5)]);
    assert_eq!(tracks.at(0, 1_000_000), None);
    // A log that pauses goes on; a first stamp far off is not the log's.
    let pause = read(b"t,robot,x,y\n7,a,0,0\n1e6,a,0,0\n1000001,a,1,0\n").expect("a log");
    let tracks = Tracks::new(&pause, &Numbers::natural(&pause.names), &LIMITS);
    assert_eq!((tracks.refused().astray, tracks.samples().count()), (Some((1, 2)), 2));
}

#[test]
fn names_are_numbered_by_their_digits_or_by_a_file() {
    let names = ["robot_10", "robot_2", "base"].map(str::to_owned);
    assert_eq!(Numbers::natural(&names).names(), ["base", "robot_2", "robot_10"]);
    let named = |file: &str| Numbers::named(&names, file);
    assert_eq!(named("robot_2,2\nlost,3\nbase,1\n").expect("numbers").absent(), ["lost"]);
    assert_eq!(named("\u{feff}robot_2,2\r\nbase,1\r\n").expect("numbers").names(), ["base", "robot_2"]);
    assert_eq!(named("robot_2,1\nbase\n"), Err(NamesError::Line(2)));
    assert_eq!(named("robot_2,0\n"), Err(NamesError::Line(1)));
    assert_eq!(named("robot_2,1\nbase,1\n"), Err(NamesError::Twice(2)));
    assert_eq!(named("robot_2,2\n"), Err(NamesError::Gap(0)));
    assert_eq!(named("a,1\nb,2\n"), Err(NamesError::Nothing(names.to_vec())));
}
