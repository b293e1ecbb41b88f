//! Logs in all forms, made of the same positions.

use std::collections::BTreeMap;
use std::fmt::Write;

use mcap::Writer;
use mcap::records::MessageHeader;

/// A position: microseconds, the name of the robot, millimetres.
pub(crate) type Row<'a> = (i64, &'a str, [i32; 2]);

fn metres(mm: i32) -> f64 {
    f64::from(mm) / 1e3
}

pub(crate) fn csv(rows: &[Row<'_>]) -> Vec<u8> {
    let mut text = "robot,t_us,x_m,y_mm,battery\n".to_owned();
    for (at_us, robot, [x, y]) in rows {
        writeln!(text, "{robot},{at_us},{},{y},80", metres(*x)).expect("a string");
    }
    text.into()
}

/// Flat lines and lines like the messages of ROS, in turn.
pub(crate) fn json(rows: &[Row<'_>]) -> Vec<u8> {
    let mut text = String::new();
    for (number, (at_us, robot, [x, y])) in rows.iter().enumerate() {
        let [x, y] = [x, y].map(|&along| metres(along));
        let line = if number % 2 == 0 {
            format!(r#"{{"time_us":{at_us},"robot":"{robot}","x":{x},"y":{y}}}"#)
        } else {
            let (sec, nanosec) = (at_us.div_euclid(1_000_000), at_us.rem_euclid(1_000_000) * 1_000);
            let header = format!(r#"{{"stamp":{{"sec":{sec},"nanosec":{nanosec}}},"frame_id":"map"}}"#);
            let pose = format!(r#"{{"pose":{{"position":{{"x":{x},"y":{y},"z":0}}}}}}"#);
            format!(r#"{{"robot":"{robot}","header":{header},"pose":{pose}}}"#)
        };
        text += &line;
        text.push('\n');
    }
    text.into()
}

/// A message in CDR.
struct Cdr {
    bytes: Vec<u8>,
    is_big: bool,
}

impl Cdr {
    fn new(is_big: bool) -> Self {
        Self { bytes: vec![0, u8::from(!is_big), 0, 0], is_big }
    }

    fn number<const N: usize>(&mut self, mut little: [u8; N]) {
        while !(self.bytes.len() - 4).is_multiple_of(N) {
            self.bytes.push(0);
        }
        if self.is_big {
            little.reverse();
        }
        self.bytes.extend(little);
    }

    fn text(&mut self, text: &str) {
        self.number((text.len() as u32 + 1).to_le_bytes());
        self.bytes.extend(text.bytes().chain([0]));
    }

    fn header(&mut self, at_us: i64) {
        self.number((at_us.div_euclid(1_000_000) as i32).to_le_bytes());
        self.number((at_us.rem_euclid(1_000_000) as u32 * 1_000).to_le_bytes());
        self.text("map");
    }

    fn pose(&mut self, [x, y]: [i32; 2]) {
        for value in [metres(x), metres(y), 0.0, 0.0, 0.0, 0.0, 1.0] {
            self.number(value.to_le_bytes());
        }
    }
}

/// The types of messages, by their numbers; the names of robots are topics, but for transforms.
pub(crate) const KINDS: [&str; 5] = [
    "geometry_msgs/msg/PoseStamped",
    "geometry_msgs/msg/PoseWithCovarianceStamped",
    "nav_msgs/msg/Odometry",
    "tf2_msgs/msg/TFMessage",
    "json",
];

fn message(kind: &str, is_big: bool, (at_us, robot, place): Row<'_>) -> Vec<u8> {
    if kind == "json" {
        let line = json(&[(0, "", [0, 0]), (at_us, robot, place)]);
        return line.split(|&byte| byte == b'\n').nth(1).expect("the second line").to_vec();
    }
    let mut cdr = Cdr::new(is_big);
    if kind.ends_with("TFMessage") {
        cdr.number(1_u32.to_le_bytes());
    }
    cdr.header(at_us);
    if kind.ends_with("Odometry") || kind.ends_with("TFMessage") {
        cdr.text(robot);
    }
    cdr.pose(place);
    if kind.contains("Covariance") || kind.ends_with("Odometry") {
        (0..36).for_each(|_| cdr.number(0_f64.to_le_bytes()));
    }
    cdr.bytes
}

/// A recording; each robot has messages of another type.
pub(crate) fn mcap(rows: &[Row<'_>], is_big: bool) -> Vec<u8> {
    let mut bytes = Vec::new();
    let options = mcap::WriteOptions::new().compression(None);
    let mut writer = Writer::with_options(std::io::Cursor::new(&mut bytes), options).expect("a writer");
    let mut channels: BTreeMap<&str, (u16, &str)> = BTreeMap::new();
    for (number, row) in (0..).zip(rows) {
        let (channel, kind) = *channels.entry(row.1).or_insert_with_key(|robot| {
            let kind = KINDS[robot.bytes().map(usize::from).sum::<usize>() % KINDS.len()];
            let (schema, encoding) = if kind == "json" { ("jsonschema", "json") } else { ("ros2msg", "cdr") };
            let schema = writer.add_schema(kind, schema, b"").expect("a schema");
            let topic = if kind.ends_with("TFMessage") { "/tf" } else { robot };
            (writer.add_channel(schema, topic, encoding, &BTreeMap::new()).expect("a channel"), kind)
        });
        let at_ns = row.0.cast_unsigned() * 1_000 + 5;
        let header =
            MessageHeader { channel_id: channel, sequence: number, log_time: at_ns, publish_time: at_ns };
        writer.write_to_known_channel(&header, &message(kind, is_big, *row)).expect("a message");
    }
    writer.finish().expect("an end");
    drop(writer);
    bytes
}
