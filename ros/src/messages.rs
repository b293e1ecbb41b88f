//! The messages of ROS 2, Humble and later, that the node hears and publishes: `geometry_msgs/PoseStamped`,
//! `nav_msgs/Odometry`, `diagnostic_msgs/DiagnosticArray` and `visualization_msgs/MarkerArray`, with what they are made
//! of. The order of the fields is that of the definitions in ROS, which is the order of the bytes.

use serde::{Deserialize, Serialize};

/// Structs whose fields are all public, in the order of their definition.
macro_rules! messages {
    ($($(#[$about:meta])* $name:ident { $($field:ident: $kind:ty),* $(,)? })*) => {
        $(
            $(#[$about])*
            #[derive(Clone, PartialEq, Default, Debug, Serialize, Deserialize)]
            #[allow(missing_docs)]
            pub struct $name {
                $(pub $field: $kind,)*
            }
        )*
    };
}

messages! {
    /// `builtin_interfaces/Time`, since 1970 or since the start of a simulation, and `builtin_interfaces/Duration`.
    Time { sec: i32, nanosec: u32 }

    /// `std_msgs/Header`.
    Header { stamp: Time, frame_id: String }

    /// `geometry_msgs/Point` and `geometry_msgs/Vector3`, in metres.
    Point { x: f64, y: f64, z: f64 }

    /// `geometry_msgs/Quaternion`.
    Quaternion { x: f64, y: f64, z: f64, w: f64 }

    /// `geometry_msgs/Pose`.
    Pose { position: Point, orientation: Quaternion }

    /// `geometry_msgs/PoseStamped`.
    PoseStamped { header: Header, pose: Pose }

    /// `geometry_msgs/Twist`.
    Twist { linear: Point, angular: Point }

    /// `geometry_msgs/PoseWithCovariance`. The covariance is an array of 36 in ROS, which has the same bytes.
    PoseWithCovariance { pose: Pose, covariance: [[f64; 6]; 6] }

    /// `geometry_msgs/TwistWithCovariance`.
    TwistWithCovariance { twist: Twist, covariance: [[f64; 6]; 6] }

    /// `nav_msgs/Odometry`.
    Odometry { header: Header, child_frame_id: String, pose: PoseWithCovariance, twist: TwistWithCovariance }

    /// `diagnostic_msgs/KeyValue`.
    KeyValue { key: String, value: String }

    /// `diagnostic_msgs/DiagnosticStatus`.
    DiagnosticStatus { level: u8, name: String, message: String, hardware_id: String, values: Vec<KeyValue> }

    /// `diagnostic_msgs/DiagnosticArray`.
    DiagnosticArray { header: Header, status: Vec<DiagnosticStatus> }

    /// `std_msgs/ColorRGBA`.
    Color { r: f32, g: f32, b: f32, a: f32 }

    /// `sensor_msgs/CompressedImage`.
    CompressedImage { header: Header, format: String, data: Vec<u8> }

    /// `visualization_msgs/UVCoordinate`.
    UvCoordinate { u: f32, v: f32 }

    /// `visualization_msgs/MeshFile`.
    MeshFile { filename: String, data: Vec<u8> }

    /// `visualization_msgs/Marker`. The field `kind` is `type` in ROS.
    Marker {
        header: Header,
        ns: String,
        id: i32,
        kind: i32,
        action: i32,
        pose: Pose,
        scale: Point,
        color: Color,
        lifetime: Time,
        frame_locked: bool,
        points: Vec<Point>,
        colors: Vec<Color>,
        texture_resource: String,
        texture: CompressedImage,
        uv_coordinates: Vec<UvCoordinate>,
        text: String,
        mesh_resource: String,
        mesh_file: MeshFile,
        mesh_use_embedded_materials: bool,
    }

    /// `visualization_msgs/MarkerArray`.
    MarkerArray { markers: Vec<Marker> }
}

impl Time {
    /// Microseconds, if the stamp is not before its zero.
    pub fn micros(&self) -> Option<u64> {
        Some(u64::try_from(self.sec).ok()? * 1_000_000 + u64::from(self.nanosec) / 1_000)
    }

    /// A stamp of so many microseconds.
    pub fn from_micros(us: u64) -> Self {
        let sec = i32::try_from(us / 1_000_000).unwrap_or(i32::MAX);
        Self { sec, nanosec: (us % 1_000_000) as u32 * 1_000 }
    }
}

impl DiagnosticStatus {
    /// The level of what is as it should be.
    pub const OK: u8 = 0;
    /// The level of an error.
    pub const ERROR: u8 = 2;
    /// The level of what is not known.
    pub const STALE: u8 = 3;
}

impl Marker {
    /// The kind of a marker that has a line between each two points.
    pub const LINE_LIST: i32 = 5;
    /// The kind of a marker that has a text.
    pub const TEXT_VIEW_FACING: i32 = 9;
    /// The action that shows a marker.
    pub const ADD: i32 = 0;
    /// The action that takes a marker away.
    pub const DELETE: i32 = 2;
}
