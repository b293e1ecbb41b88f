//! The types of the messages, as ROS 2 defines them, and some of our own. A definition names the types of its fields; a
//! file has each type with all that it is made of, so that a reader needs no installed ROS.

use std::collections::BTreeSet;

/// A type's name, and its fields, one a line.
type Type = (&'static str, &'static str);

/// Every type, by its name without `msg`.
const TYPES: &[Type] = &[
    ("builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"),
    ("builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"),
    ("geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"),
    ("geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"),
    ("geometry_msgs/PoseArray", "std_msgs/Header header\ngeometry_msgs/Pose[] poses\n"),
    ("geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"),
    ("geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"),
    (
        "map_msgs/OccupancyGridUpdate",
        "std_msgs/Header header\nint32 x\nint32 y\nuint32 width\nuint32 height\nint8[] data\n",
    ),
    (
        "nav_msgs/MapMetaData",
        "builtin_interfaces/Time map_load_time\nfloat32 resolution\nuint32 width\nuint32 height\n\
         geometry_msgs/Pose origin\n",
    ),
    ("nav_msgs/OccupancyGrid", "std_msgs/Header header\nnav_msgs/MapMetaData info\nint8[] data\n"),
    ("sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"),
    ("std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"),
    ("std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"),
    (
        "tautline/End",
        "std_msgs/Header header\nstring stopped\nuint32 steps\nuint32 explored\nuint32 cells\n\
         tautline/Violation[] violations\n",
    ),
    (
        "tautline/TeamMove",
        "std_msgs/Header header\nuint32 step\nstring kind\nstring tried\nbool[] blocked\n\
         tautline/Cell[] cells\nstring[] broken\nstring title\nbool again\n",
    ),
    ("tautline/Cell", "int32 column\nint32 row\n"),
    ("tautline/Line", "std_msgs/Header header\nstring json\n"),
    ("tautline/Violation", "string clause\nuint32 step\n"),
    (
        "visualization_msgs/Marker",
        "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\ngeometry_msgs/Pose pose\n\
         geometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\nbuiltin_interfaces/Duration lifetime\n\
         bool frame_locked\ngeometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\nstring texture_resource\n\
         sensor_msgs/CompressedImage texture\nvisualization_msgs/UVCoordinate[] uv_coordinates\nstring text\n\
         string mesh_resource\nvisualization_msgs/MeshFile mesh_file\nbool mesh_use_embedded_materials\n",
    ),
    ("visualization_msgs/MeshFile", "string filename\nuint8[] data\n"),
    ("visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n"),
];

/// The line between two types of a definition.
const RULE: &str = "================================================================================\n";

/// The fields of a type; none if there is no such type.
fn fields(name: &str) -> &'static str {
    TYPES.iter().find(|(known, _)| *known == name).map_or("", |&(_, fields)| fields)
}

/// The types that a type is made of, each once, in the order in which they are first met.
fn parts(name: &str, found: &mut Vec<&'static str>, seen: &mut BTreeSet<&'static str>) {
    for line in fields(name).lines() {
        let part = line.split([' ', '[']).next().unwrap_or_default();
        if part.contains('/') && seen.insert(part) {
            found.push(part);
            parts(part, found, seen);
        }
    }
}

/// The definition of the type `name`, such as `nav_msgs/OccupancyGrid`, with all that it is made of.
pub(super) fn definition(name: &str) -> String {
    let (mut found, mut seen) = (Vec::new(), BTreeSet::new());
    parts(name, &mut found, &mut seen);
    let parts = found.into_iter().map(|part| format!("{RULE}MSG: {part}\n{}", fields(part)));
    fields(name).to_owned() + &parts.collect::<String>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_definition_has_each_type_that_it_names_once() {
        for &(name, of) in TYPES {
            let text = definition(name);
            assert!(text.starts_with(of) && !of.is_empty());
            let named = text.lines().filter_map(|line| line.split([' ', '[']).next());
            for part in named.filter(|part| part.contains('/')) {
                assert_eq!(text.matches(&format!("MSG: {part}\n")).count(), 1, "{part} of {name}");
            }
        }
    }
}
