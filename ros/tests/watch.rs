//! Verdicts of clauses from positions, without a network.

use super::team::{at, header};
use std::time::{Duration, Instant};
use tautline_ros::config::Config;
use tautline_ros::messages::{DiagnosticStatus, Header, Time};
use tautline_ros::watch::Watch;

const GAP: Duration = Duration::from_millis(500);

/// The watch of so many robots by one clause.
fn watch(robots: usize, clause: &str) -> Watch {
    let robots: Vec<_> = (0..robots).map(|robot| format!("{{ name = 'r{robot}' }}")).collect();
    let text = format!("gap_s = 0.5\nrobots = [{}]\nclauses = [{{ {clause} }}]", robots.join(", "));
    Watch::new(Config::parse(&text).expect("a configuration")).expect("a watch")
}

/// The only diagnostic.
fn status(watch: &Watch) -> DiagnosticStatus {
    watch.diagnostics(Time::default(), |_| None).status.pop().expect("a clause")
}

/// Tells the watch where robots are, a second after the start of all stamps.
fn hear(watch: &mut Watch, places: &[f64], now: Instant) -> DiagnosticStatus {
    for (robot, &x) in places.iter().enumerate() {
        let header = Header { stamp: Time { sec: 1, nanosec: 0 }, frame_id: "map".to_owned() };
        watch.hear(robot, &header, &at(x).position, now);
    }
    status(watch)
}

#[test]
fn every_clause_is_kept_by_some_places_and_broken_by_others() {
    let now = Instant::now();
    let (range, cell) = ("range_m = 3.0, tolerance_m = 0.1", "cell_m = 1.0, tolerance_m = 0.1");
    for (id, lengths, kept, broken, said) in [
        ("CHAIN-2", cell, [0.5, 0.5, 1.5], [0.5, 0.5, 0.5], "3 robots are in one cell, r0 and r1 among them"),
        ("CHAIN-3", range, [0.0, 3.0, 0.0], [3.0, 0.0, 3.2], "r1 and r2 are 3.200 m apart; at most 3.000 m"),
        (
            "FRONTIER-2",
            cell,
            [0.5, 1.5, 2.5],
            [0.5, 1.5, 1.5],
            "2 robots are in one cell, r1 and r2 among them",
        ),
        ("PACK-2", cell, [0.5, 1.5, 2.5], [0.5, 1.5, 0.5], "2 robots are in one cell, r0 and r2 among them"),
        ("KIT-1", range, [0.0, 3.0, 9.0], [0.0, 4.0, 9.0], "r0 and r1, its nearest, are 4.000 m apart"),
        ("KIT-2", range, [0.0, 3.0, 9.0], [0.0, 4.0, 9.0], "the range is 3.000 m"),
        ("KIT-12", range, [0.0, 6.0, 3.0], [0.0, 6.0, 2.0], "the team is in two parts"),
        ("KIT-12", range, [0.0, 6.0, 3.0], [0.0, 6.0, 2.0], "r1 and r2, its nearest, are 4.000 m apart"),
        (
            "KIT-3",
            "least_m = 3.0, tolerance_m = 0.1",
            [0.0, 0.0, 9.0],
            [20.0, 22.0, 9.0],
            "at least 3.000 m have to be",
        ),
    ] {
        // KIT-1 and KIT-2 speak of two.
        let robots = if ["KIT-1", "KIT-2"].contains(&id) { 2 } else { 3 };
        let mut watch = watch(robots, &format!("clause = '{id}', {lengths}"));
        let status = hear(&mut watch, &kept[..robots], now);
        assert_eq!((status.level, status.message.as_str()), (DiagnosticStatus::OK, "kept"), "{id}");
        let status = hear(&mut watch, &broken[..robots], now);
        assert_eq!(status.level, DiagnosticStatus::ERROR, "{id}: {}", status.message);
        assert!(status.message.contains(said), "{id}: {}", status.message);
    }
}

#[test]
fn teams_of_two_to_sixty_four_robots_are_watched() {
    for robots in 2..=64 {
        let mut watch = watch(robots, "clause = 'CHAIN-3', range_m = 2, tolerance_m = 0");
        let mut places: Vec<f64> = (0..robots).map(|robot| 2.0 * robot as f64).collect();
        assert_eq!(hear(&mut watch, &places, Instant::now()).level, DiagnosticStatus::OK);
        places[robots - 1] += 0.001;
        let status = hear(&mut watch, &places, Instant::now());
        assert!(status.message.contains("2.001 m"), "{robots}: {}", status.message);
    }
}

#[test]
fn a_robot_that_falls_silent_by_the_clock_takes_back_what_rests_on_it_alone() {
    let start = Instant::now();
    let mut watch = watch(3, "clause = 'CHAIN-3', range_m = 2, tolerance_m = 0");
    hear(&mut watch, &[0.0, 1.0, 9.0], start);
    assert!(watch.look(start));
    assert_eq!(watch.mark_told(), [true]);
    assert!(!watch.look(start + GAP));
    let later = start + GAP + Duration::from_millis(1);
    assert!(watch.look(later));
    assert_eq!(status(&watch).level, DiagnosticStatus::STALE);
    let stamp = Header { stamp: Time { sec: 1, nanosec: 0 }, frame_id: "map".to_owned() };
    for robot in [1, 2] {
        watch.hear(robot, &stamp, &at(4.0 * robot as f64 - 3.0).position, later);
    }
    watch.look(later);
    let broken = status(&watch);
    assert!(
        broken.message.contains("r1 and r2"),
        "the first robot is no part of this breach: {}",
        broken.message
    );
}

#[test]
fn a_message_that_cannot_be_used_changes_nothing_and_is_named_once_its_robot_is_silent() {
    let start = Instant::now();
    let good = header();
    let stamp = |sec| Header { stamp: Time { sec, nanosec: 0 }, ..good.clone() };
    // Ahead by more than the gap, though by less than a second.
    let soon = good.stamp.micros().expect("after 1970") + 950_000;
    for (header, x, why) in [
        (
            Header { frame_id: "odom".to_owned(), ..good.clone() },
            0.0,
            r#"its frame is "odom", and positions are compared in "map""#,
        ),
        (good.clone(), f64::NAN, "its position is no number"),
        (good.clone(), 1e300, "1,000 km"),
        (stamp(good.stamp.sec - 1), 0.0, "older than the last one of its robot"),
        (stamp(good.stamp.sec + 60), 0.0, "ahead of this machine's clock"),
        (Header { stamp: Time::from_micros(soon), ..good.clone() }, 0.0, "ahead of this machine's clock"),
        (stamp(-1), 0.0, "its stamp is before 1970"),
    ] {
        let mut watch = watch(2, "clause = 'CHAIN-3', range_m = 2, tolerance_m = 0");
        for robot in [0, 1] {
            watch.hear(robot, &good, &at(0.0).position, start);
        }
        watch.mark_told();
        watch.hear(1, &header, &at(x).position, start);
        assert!(!watch.look(start), "{why}: {}", status(&watch).message);
        let later = start + 2 * GAP;
        watch.hear(0, &good, &at(0.0).position, later);
        assert!(watch.look(later));
        let status = status(&watch);
        assert_eq!(status.level, DiagnosticStatus::STALE);
        assert!(
            status.message.contains("r1 was not heard") && status.message.contains(why),
            "{}",
            status.message
        );
    }
}

#[test]
fn a_message_that_cannot_be_used_does_not_choose_the_frame() {
    let mut watch = watch(2, "clause = 'CHAIN-3', range_m = 2, tolerance_m = 0");
    let (now, garbage) = (Instant::now(), Header { frame_id: "garbage".to_owned(), ..header() });
    watch.hear(0, &garbage, &at(1e300).position, now);
    for robot in [0, 1] {
        watch.hear(robot, &header(), &at(0.0).position, now);
    }
    assert_eq!(status(&watch).level, DiagnosticStatus::OK);
}

#[test]
fn the_sample_and_the_configuration_of_the_page_are_taken() {
    let page = include_str!("../../docs/ros.md");
    let shown =
        page.split("```toml").nth(1).and_then(|rest| rest.split("```").next()).expect("a configuration");
    for text in [include_str!("../launch/tautline.toml"), shown] {
        let config = Config::parse(text).expect("a configuration");
        assert_eq!(
            (config.clauses.len(), config.robots.last().map(|robot| robot.name.as_str())),
            (2, Some("guest"))
        );
    }
}

#[test]
fn a_breach_by_other_robots_is_news_and_one_by_the_same_robots_is_none() {
    let now = Instant::now();
    let mut watch = watch(3, "clause = 'CHAIN-3', range_m = 2, tolerance_m = 0");
    for (places, is_news) in [([0.0, 1.0, 9.0], true), ([0.0, 1.0, 8.0], false), ([0.0, 7.0, 8.0], true)] {
        hear(&mut watch, &places, now);
        assert_eq!(watch.look(now), is_news, "{places:?}");
        watch.mark_told();
    }
}
