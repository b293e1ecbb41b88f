//! The node's program over loopback: poses go in, and diagnostics and markers come out.

use super::team::{Ear, NodeProcess, Team, at, domain, header, pose, until};
use tautline_ros::messages::{
    DiagnosticArray, DiagnosticStatus, Marker, MarkerArray, Odometry, PoseStamped, PoseWithCovariance,
};

const CHAIN: &str = r#"
gap_s = 0.4
robots = [
    { name = "robot_1" },
    { name = "robot_2" },
    { name = "guest", topic = "/guest/odom", type = "nav_msgs/Odometry" },
]
clauses = [{ clause = "CHAIN-3", range_m = 2.549, tolerance_m = 0.1 }]
"#;

/// The latest diagnostic of the only clause that `is_awaited`.
fn diagnostic(
    ear: &Ear<DiagnosticArray>,
    is_awaited: impl Fn(&DiagnosticStatus) -> bool,
) -> Option<DiagnosticStatus> {
    let mut arrays = std::iter::from_fn(|| ear.take());
    arrays.find_map(|mut array| array.status.pop().filter(&is_awaited))
}

/// The values of a diagnostic, but for its moment.
fn values(status: &DiagnosticStatus) -> Vec<[&str; 2]> {
    let all = status.values.iter().map(|value| [value.key.as_str(), value.value.as_str()]);
    all.filter(|[key, _]| *key != "moment").collect()
}

#[test]
fn a_planted_breach_comes_back_as_a_diagnostic_and_a_line_and_goes_with_its_robots() {
    let domain = domain(0);
    let node = NodeProcess::start(domain, CHAIN);
    let team = Team::new(domain);
    let poses = ["/robot_1/pose", "/robot_2/pose"]
        .map(|topic| team.mouth::<PoseStamped>(topic, "geometry_msgs/PoseStamped"));
    let odometry = team.mouth::<Odometry>("/guest/odom", "nav_msgs/Odometry");
    let diagnostics = team.ear::<DiagnosticArray>("/diagnostics", "diagnostic_msgs/DiagnosticArray");
    let markers = team.ear::<MarkerArray>("/tautline/markers", "visualization_msgs/MarkerArray");
    let go = |guest: f64| {
        for (robot, mouth) in poses.iter().enumerate() {
            mouth.write(pose(2.0 * robot as f64), None).expect("written");
        }
        let pose = PoseWithCovariance { pose: at(guest), ..PoseWithCovariance::default() };
        odometry.write(Odometry { header: header(), pose, ..Odometry::default() }, None).expect("written");
    };
    let kept = until("a kept clause", || {
        go(4.0);
        diagnostic(&diagnostics, |status| status.level == DiagnosticStatus::OK)
    });
    assert_eq!(kept.name, "tautline: CHAIN-3 of robot_1, robot_2, guest");
    assert_eq!(values(&kept), [["clause", "CHAIN-3"], ["robots", "robot_1, robot_2, guest"]]);

    let broken = until("a breach", || {
        go(4.75);
        diagnostic(&diagnostics, |status| status.level == DiagnosticStatus::ERROR)
    });
    let said = "broken: robot_2 and guest are 2.750 m apart; at most 2.549 m may be between neighbours";
    assert_eq!(broken.message, said);
    let numbers = [["measured", "2.750 m"], ["allowed", "2.549 m"]];
    assert_eq!(
        values(&broken),
        [&[["clause", "CHAIN-3"], ["robots", "robot_2, guest"]], &numbers[..]].concat()
    );
    let shown = until("a line", || {
        let arrays = std::iter::from_fn(|| markers.take());
        arrays.map(|array| array.markers).find(|markers| markers[0].action == Marker::ADD)
    });
    assert_eq!(shown[0].kind, Marker::LINE_LIST);
    assert_eq!(shown[0].header.frame_id, "map");
    assert_eq!(shown[0].points, [at(2.0).position, at(4.75).position]);
    assert_eq!((shown[1].kind, shown[1].text.as_str()), (Marker::TEXT_VIEW_FACING, "CHAIN-3 2.750 m"));

    let silent =
        until("silence", || diagnostic(&diagnostics, |status| status.level == DiagnosticStatus::STALE));
    assert!(silent.message.ends_with("was not heard within 0.4 s"), "{}", silent.message);
    let (code, said) = node.end();
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains(&broken.message) && said.ends_with("tautline-ros: ended\n"), "{said}");
}

#[test]
fn a_robot_that_nobody_publishes_and_one_of_another_type_are_named() {
    let domain = domain(1);
    let node = NodeProcess::start(domain, CHAIN);
    let team = Team::new(domain);
    let diagnostics = team.ear::<DiagnosticArray>("/diagnostics", "diagnostic_msgs/DiagnosticArray");
    let poses =
        ["/robot_1/pose", "/robot_2/pose"].map(|topic| team.mouth(topic, "geometry_msgs/PoseStamped"));
    let said = |text: &str| {
        until(text, || {
            for (robot, mouth) in poses.iter().enumerate() {
                mouth.write(pose(robot as f64), None).expect("written");
            }
            diagnostic(&diagnostics, |status| status.message.contains(text))
        })
    };
    let nobody = said("guest was not heard within 0.4 s; nobody publishes /guest/odom");
    assert_eq!(nobody.level, DiagnosticStatus::STALE);
    let _guest = team.mouth::<PoseStamped>("/guest/odom", "geometry_msgs/PoseStamped");
    said(
        "/guest/odom is published as geometry_msgs::msg::dds_::PoseStamped_: give that type in the configuration",
    );
    assert_eq!(node.end().0, Some(0));
}
