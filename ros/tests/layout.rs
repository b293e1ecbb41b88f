//! The bytes of messages, against the definitions of ROS written down a second time: as tuples, which have no names.

use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;
use tautline_ros::messages::{
    Color, CompressedImage, DiagnosticArray, DiagnosticStatus, Header, KeyValue, Marker, MeshFile, Odometry,
    Point, Pose, PoseWithCovariance, Quaternion, Time, Twist, TwistWithCovariance, UvCoordinate,
};

type RawHeader = ((i32, u32), String);
type RawPoint = (f64, f64, f64);
type RawPose = (RawPoint, (f64, f64, f64, f64));
type RawColor = (f32, f32, f32, f32);
/// A line each: `header`, `ns`, `id`, `type`, `action`; `pose`, `scale`, `color`, `lifetime`, `frame_locked`; `points`,
/// `colors`, `texture_resource`, `texture`, `uv_coordinates`; and `text`, `mesh_resource`, `mesh_file`,
/// `mesh_use_embedded_materials`.
type RawMarker = (
    (RawHeader, String, i32, i32, i32),
    (RawPose, RawPoint, RawColor, (i32, u32), bool),
    (Vec<RawPoint>, Vec<RawColor>, String, (RawHeader, String, Vec<u8>), Vec<(f32, f32)>),
    (String, String, (String, Vec<u8>), bool),
);

/// Holds the bytes of a message to those of a tuple.
fn compare<M: Serialize, R: Serialize + DeserializeOwned + PartialEq + Debug>(message: &M, raw: &R) {
    let bytes = |bytes: cdr::Result<Vec<u8>>| bytes.expect("bytes");
    let message = bytes(cdr::serialize::<_, _, cdr::CdrLe>(message, cdr::Infinite));
    assert_eq!(message, bytes(cdr::serialize::<_, _, cdr::CdrLe>(raw, cdr::Infinite)));
    assert_eq!(cdr::deserialize::<R>(&message).expect("a tuple"), *raw);
}

fn text(text: &str) -> String {
    text.to_owned()
}

fn header(sec: i32) -> Header {
    Header { stamp: Time { sec, nanosec: 2 }, frame_id: text("map") }
}

fn raw_header(sec: i32) -> RawHeader {
    ((sec, 2), text("map"))
}

fn pose() -> Pose {
    Pose {
        position: Point { x: 1.0, y: 2.0, z: 3.0 },
        orientation: Quaternion { x: 4.0, y: 5.0, z: 6.0, w: 7.0 },
    }
}

const RAW_POSE: RawPose = ((1.0, 2.0, 3.0), (4.0, 5.0, 6.0, 7.0));

#[test]
fn a_marker_has_the_fields_of_ros_in_their_order() {
    let color = |r: f32| Color { r, g: 0.2, b: 0.3, a: 0.4 };
    let marker = Marker {
        header: header(1),
        ns: text("ns"),
        id: 11,
        kind: 12,
        action: 13,
        pose: pose(),
        scale: Point { x: 8.0, y: 9.0, z: 10.0 },
        color: color(0.1),
        lifetime: Time { sec: 14, nanosec: 15 },
        frame_locked: true,
        points: vec![Point { x: 16.0, y: 17.0, z: 18.0 }],
        colors: vec![color(0.5)],
        texture_resource: text("texture"),
        texture: CompressedImage { header: header(19), format: text("png"), data: vec![20] },
        uv_coordinates: vec![UvCoordinate { u: 21.0, v: 22.0 }],
        text: text("text"),
        mesh_resource: text("mesh"),
        mesh_file: MeshFile { filename: text("file"), data: vec![23, 24] },
        mesh_use_embedded_materials: false,
    };
    let raw: RawMarker = (
        (raw_header(1), text("ns"), 11, 12, 13),
        (RAW_POSE, (8.0, 9.0, 10.0), (0.1, 0.2, 0.3, 0.4), (14, 15), true),
        (
            vec![(16.0, 17.0, 18.0)],
            vec![(0.5, 0.2, 0.3, 0.4)],
            text("texture"),
            (raw_header(19), text("png"), vec![20]),
            vec![(21.0, 22.0)],
        ),
        (text("text"), text("mesh"), (text("file"), vec![23, 24]), false),
    );
    compare(&marker, &raw);
}

#[test]
fn a_diagnostic_has_the_fields_of_ros_in_their_order() {
    let status = DiagnosticStatus {
        level: 2,
        name: text("name"),
        message: text("message"),
        hardware_id: text("id"),
        values: vec![KeyValue { key: text("key"), value: text("value") }],
    };
    let raw = (2_u8, text("name"), text("message"), text("id"), vec![(text("key"), text("value"))]);
    compare(&DiagnosticArray { header: header(1), status: vec![status] }, &(raw_header(1), vec![raw]));
}

#[test]
fn odometry_has_the_fields_of_ros_in_their_order() {
    let covariance = |first: f64| [0, 1, 2, 3, 4, 5].map(|row| [first + f64::from(row); 6]);
    let odometry = Odometry {
        header: header(1),
        child_frame_id: text("child"),
        pose: PoseWithCovariance { pose: pose(), covariance: covariance(10.0) },
        twist: TwistWithCovariance {
            twist: Twist {
                linear: Point { x: 21.0, y: 22.0, z: 23.0 },
                angular: Point { x: 24.0, y: 25.0, z: 26.0 },
            },
            covariance: covariance(30.0),
        },
    };
    let twist = ((21.0, 22.0, 23.0), (24.0, 25.0, 26.0));
    let raw = (raw_header(1), text("child"), (RAW_POSE, covariance(10.0)), (twist, covariance(30.0)));
    compare(&odometry, &raw);
}
