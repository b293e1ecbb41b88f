//! `tautline locate`: positions, their errors, and what is refused.

use insta::assert_snapshot;

use super::{folder, json, names, on_any_threads, printed, read, refusals, refused, says, write};

#[test]
fn errors_are_those_that_theory_and_an_independent_program_expect() {
    let folder = &folder();
    let told = |solver: &str| json(folder, &["locate", "--solver", solver], 0);
    // Medians of 10,000 trials of an independent program with noise of its own.
    for (solver, median_m) in
        [("closed-form", 2.42), ("pso", 1.87), ("least-squares", 1.87), ("decibel", 1.70)]
    {
        let told = told(solver);
        let found_m = told["error_m"]["median"].as_f64().expect("a number");
        assert!((found_m - median_m).abs() < 0.06, "{solver}: {found_m}, not {median_m}");
        let bound_m = told["crlb_rms_m"].as_f64().expect("a number");
        assert!((bound_m - 2.35).abs() < 0.02, "{bound_m}");
        for name in ["median", "p95", "rms"] {
            let ends = &told["error_m"]["interval"][name];
            let (least, most) = (ends[0].as_f64().expect("a number"), ends[1].as_f64().expect("a number"));
            assert!(
                (least..=most).contains(&told["error_m"][name].as_f64().expect("a number")),
                "{solver} {name}"
            );
        }
    }
    let swarm = told("pso")["optimum_m"]["median"].as_f64().expect("a number");
    assert!((0.0027..0.0044).contains(&swarm), "{swarm}");
    let inside = json(folder, &["locate", "--inside"], 0);
    assert!(
        inside["error_m"]["rms"].as_f64() < inside["crlb_rms_m"].as_f64(),
        "a biased way beats the bound"
    );
}

#[test]
fn the_report_is_the_same_on_any_number_of_threads() {
    let folder = &folder();
    let swarm = ["locate", "--solver", "pso", "--runs", "3000", "--advice"];
    assert_snapshot!("positions_of_a_swarm", on_any_threads(folder, &swarm));
}

#[test]
fn advice_says_how_many_cells_a_floor_can_have() {
    let folder = &folder();
    let cells = |noise_db: &str| {
        let advice = json(folder, &["locate", "--noise-db", noise_db, "--advice"], 0)["advice"].clone();
        let number = |name: &str| advice[name].as_f64().expect("a number");
        assert!(number("cells_believed") <= number("side_m") / (4.0 * number("p99_m")));
        assert!(number("cells_tracked") <= number("side_m") / (2.0 * number("p99_m")));
        [number("cells_believed") as u32, number("cells_tracked") as u32]
    };
    assert_eq!([cells("1"), cells("0.25"), cells("0.1")], [[0, 1], [3, 6], [8, 16]]);
    let exact = printed(folder, &["locate", "--noise-db", "0", "--advice"], 0);
    says(
        &exact,
        &["1000000000 cells and more where a robot believes", "1000000000 cells and more where it counts"],
    );
}

/// Three robots: the second one on the line of its anchors' mirror, the third one with four anchors.
const MEASUREMENTS: &str = "fix,x_m,y_m,range_m\n\
    a,0,0,5\na,20,0,17.5\na,0,20,16.5\n\
    b,0,0,5\nb,10,0,8.062\nb,20,0,17.464\n\
    c,0,0,10\nc,20,0,14.2\nc,0,20,14\nc,20,20,17.4\n";

#[test]
fn positions_of_measurements_are_found_and_drawn() {
    let folder = &folder();
    write(folder, "m.csv", MEASUREMENTS);
    assert_snapshot!(printed(folder, &["locate", "m.csv"], 0));
    let picture = ["locate", "m.csv", "--solver", "least-squares", "--svg", "m.svg", "--format", "json"];
    printed(folder, &picture, 0);
    let picture = ["locate", "--at", "5,5", "--runs", "10", "--svg", "at.svg"];
    printed(folder, &picture, 0);
    for (name, ellipses) in [("m.svg", 5), ("at.svg", 4)] {
        let drawn = read(folder, name);
        assert_eq!(drawn.matches("<ellipse").count(), ellipses, "{name}");
        assert!(!drawn.contains("NaN") && !drawn.contains("inf"), "{name}");
        assert!(drawn.contains(">0 m</text>") && drawn.contains(">5 m</text>"), "{name}");
    }
    // The columns may stand in any order, with others between them, and a byte order mark before them.
    let other = "\u{feff}range_m,time,y_m,x_m,fix\r\n5,1,0,0,a\r\n17.5,2,0,20,a\r\n16.5,3,20,0,a\r\n";
    write(folder, "other.csv", other);
    let found = |file: &str| json(folder, &["locate", file], 0)["fixes"][0].clone();
    assert_eq!(found("m.csv"), found("other.csv"));
}

#[test]
fn levels_tell_the_distances_that_they_fall_over() {
    let folder = &folder();
    // A robot at 3,4 hears anchors at −40 dBm at one metre, and 25 dB less at ten times the distance.
    let at = [(0.0, 0.0), (20.0, 0.0), (0.0, 20.0)];
    #[expect(clippy::disallowed_methods, reason = "printed with six decimals")]
    let level = |(x, y): (f64, f64)| -40.0 - 25.0 * (x - 3.0).hypot(y - 4.0).log10();
    let lines = at.map(|anchor| format!("a,{},{},{:.6}\n", anchor.0, anchor.1, level(anchor)));
    write(folder, "levels.csv", format!("fix,x_m,y_m,level_dbm\n{}", lines.concat()));
    let found = json(folder, &["locate", "levels.csv", "--power-dbm", "-40", "--exponent", "2.5"], 0);
    let place = &found["fixes"][0]["positions"][0];
    for (name, expected_m) in [("x_m", 3.0), ("y_m", 4.0)] {
        let told_m = place[name].as_f64().expect("a number");
        assert!((told_m - expected_m).abs() < 1e-3, "{name}: {told_m}");
    }
}

#[test]
fn what_tells_no_position_is_refused_with_what_would_be_right() {
    let folder = &folder();
    let wrong: [&[&str]; 23] = [
        &["--anchors", "0,0", "--anchors", "20,0"],
        &["--anchors", "0,0", "--anchors", "20,0", "--anchors", "0,0"],
        &["--anchors", "0,0", "--anchors", "10,10", "--anchors", "20,20"],
        &["--anchors", "0,0", "--anchors", "NaN,10", "--anchors", "20,0"],
        &["--anchors", "0,0", "--anchors", "inf,10", "--anchors", "20,0"],
        &["--anchors", "0"],
        &["--anchors", "20,0", "--anchors", "0,0", "--anchors", "0,20", "--solver", "closed-form"],
        &[
            "--solver",
            "closed-form",
            "--anchors",
            "0,0",
            "--anchors",
            "9,1",
            "--anchors",
            "1,9",
            "--anchors",
            "7,7",
        ],
        &["--exponent", "0"],
        &["--exponent", "NaN"],
        &["--noise-db", "-1"],
        &["--runs", "0"],
        &["--at", "0,0"],
        &["--rule", "published"],
        &["--inside", "--solver", "pso"],
        &["--inside", "--at", "20.5,5"],
        &["--advice", "--at", "5,5"],
        &["--advice", "--runs", "299"],
        &["nowhere.csv"],
        &["nowhere.csv", "--runs", "5"],
        &["nowhere.csv", "--power-dbm", "-201"],
        &["nowhere.csv", "--power-dbm", "NaN"],
        &["--power-dbm", "-40"],
    ];
    assert_snapshot!("wrong_positions", refusals(folder, &["locate"], &wrong));
    let head = "fix,x_m,y_m,range_m\n";
    let contents = [
        String::new(),
        "fix,x_m,y_m\n1,0,0\n".to_owned(),
        head.to_owned(),
        format!("{head}1,0,0,5\n1,20,0\n"),
        format!("{head}1,0,0,5\n1,20,here,17\n"),
        format!("{head}1,0,0,5\n1,20,0,17\n"),
        format!("{head}1,0,0,5\n1,20,0,-17\n1,0,20,16\n"),
        format!("{head}1,0,0,5\n1,20,0,NaN\n1,0,20,16\n"),
        format!("{head}1,0,0,inf\n1,20,0,17\n1,0,20,16\n"),
        format!("{head}1,0,0,5\n1,20,0,0\n1,0,20,16\n"),
        format!("{head}1,0,0,5\n1,20,0,17\n1,0,0,16\n"),
        format!("{head}1,0,0,2\n1,20,0,2\n1,0,20,19\n"),
        format!("{head}1,0,0,90\n1,20,0,17\n1,0,20,16\n"),
    ];
    let said = |contents: &[String], more: &[&str]| {
        let said = contents.iter().map(|content| {
            write(folder, "m.csv", content);
            format!("{content}\n{}\n", refused(folder, &[&["locate", "m.csv"], more].concat()))
        });
        said.collect::<Vec<_>>().join("\n")
    };
    assert_snapshot!("wrong_measurements", said(&contents, &[]));
    let head = "fix,x_m,y_m,level_dbm\n";
    let levels = [
        format!("{head}1,0,0,-50\n1,20,0,loud\n"),
        format!("{head}1,0,0,-50\n1,20,0,inf\n"),
        format!("{head}1,0,0,-50\n1,20,0,-250\n"),
        format!("{head}1,0,0,-50\n1,20,0,-60\n"),
        "fix,x_m,y_m,range_m\n1,0,0,5\n".to_owned(),
    ];
    assert_snapshot!("wrong_levels", said(&levels, &["--power-dbm", "-40"]));
    write(folder, "m.csv", format!("{head}1,0,0,-50\n"));
    let remedy = "give --power-dbm, the level at one metre, and --exponent, how fast levels fall";
    assert!(refused(folder, &["locate", "m.csv"]).contains(remedy));
    write(folder, "m.csv", MEASUREMENTS);
    // The closed form knows no mirror images.
    assert!(refused(folder, &["locate", "m.csv", "--solver", "pso"]).contains("on one line"));
    let twice = "fix,x_m,y_m,range_m,range_m\na,0,0,5,5\na,20,0,20,5\na,0,20,20,5\n";
    write(folder, "m.csv", twice);
    assert!(refused(folder, &["locate", "m.csv"]).contains("the column `range_m` is there twice"));
    assert_eq!(names(folder), ["m.csv"]);
}

#[test]
fn what_is_wrong_with_the_place_or_the_noise_is_said_of_them() {
    let folder = &folder();
    let refused = |arguments: &[&str]| refused(folder, &[&["locate"], arguments].concat());
    for at in ["1e10,0", "NaN,0"] {
        let said = refused(&["--at", at]);
        says(&said, &["--at", "write metres from -100000000 to 100000000"]);
    }
    let said = refused(&["--noise-db", "100", "--runs", "1"]);
    says(&said, &["with this noise no distances tell a position", "--noise-db"]);
}

#[test]
fn without_noise_the_bound_is_0() {
    let told = json(&folder(), &["locate", "--noise-db", "0", "--runs", "10"], 0);
    assert_eq!(told["crlb_rms_m"], 0.0);
}

#[test]
fn the_rim_is_inside_and_numbers_are_written_as_people_do() {
    let folder = &folder();
    says(&printed(folder, &["locate", "--inside", "--at", "20,5", "--runs", "1"], 0), &["; 1 trial, seed 0"]);
    printed(folder, &["locate", "--advice", "--runs", "300"], 0);
    // A robot at the first anchor's corner, a hair to the west of it.
    let west = "fix,x_m,y_m,range_m\na,0,0,0.001\na,20,0,20.0001\na,0,20,20\n";
    write(folder, "m.csv", west);
    let told = printed(folder, &["locate", "m.csv"], 0);
    assert!(told.contains(" 0.000") && !told.contains("-0.000"), "{told}");
}
