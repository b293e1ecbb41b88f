//! Lines of JSON: each an object with a position, flat under the names of a table, or nested as the messages of ROS
//! are.

use serde_json::{Map, Value};

use super::columns::{Part, part};
use super::log::{Fault, FaultPlace, Form, Log, MOST_US, Pose, Reading, micros};

const REMEDY: &str = "write lines as {\"time\": 12.5, \"robot\": \"a\", \"x\": 1.0, \"y\": 2.0}, or as the \
                      messages of ROS, with header.stamp and pose";

/// The position that an object has, without its robot; `at_us` is the time of an object that has none.
pub(super) fn pose(object: &Map<String, Value>, at_us: Option<i64>) -> Result<(i64, [f64; 2]), &'static str> {
    let (mut named, mut along) = (None, [None; 2]);
    for (name, value) in object {
        let (before, twice, scale) = match part(name) {
            Some((Part::Time, scale)) => (&mut named, "two times", scale),
            Some((Part::Along(axis), scale)) => (&mut along[axis], ["two x", "two y"][axis], scale),
            Some((Part::Robot, _)) | None => continue,
        };
        let Some(number) = value.as_f64() else { continue };
        if before.replace(number * scale).is_some() {
            return Err(twice);
        }
    }
    let time = match named {
        Some(us) if us.abs() > MOST_US => {
            return Err("no such time; write seconds as 12.5, or a unit as in time_ns");
        }
        Some(us) => Some(us.round() as i64),
        // A stamp of 0 is one that nobody has set.
        None => stamp(object).filter(|&us| us != 0 || at_us.is_none()).or(at_us),
    };
    let position = position(object);
    for (axis, name) in ["x", "y"].into_iter().enumerate() {
        // A number that JSON has no word for is null.
        let number = |value: &Value| value.as_f64().or(value.is_null().then_some(f64::NAN));
        let nested = || Some(number(position?.get(name)?)? * 1e3);
        along[axis] = along[axis].or_else(nested).or_else(|| object.get(name)?.is_null().then_some(f64::NAN));
    }
    match (time, along) {
        (None, _) => Err("no time"),
        (_, [None, _]) => Err("no x"),
        (_, [_, None]) => Err("no y"),
        (Some(time), [Some(x), Some(y)]) => Ok((time, [x, y])),
    }
}

/// The nested stamp: `header.stamp` of ROS 2 and ROS 1, or `timestamp` of Foxglove.
fn stamp(object: &Map<String, Value>) -> Option<i64> {
    let stamp =
        object.get("header").and_then(|header| header.get("stamp")).or_else(|| object.get("timestamp"))?;
    let whole = |names: [&str; 3]| names.into_iter().find_map(|name| stamp.get(name)?.as_i64());
    micros(whole(["sec", "secs", "seconds"])?, whole(["nanosec", "nsec", "nsecs"]).unwrap_or(0))
}

/// The nested position: `position`, `pose.position`, `pose.pose.position`.
fn position(object: &Map<String, Value>) -> Option<&Map<String, Value>> {
    let mut within = object;
    for _ in 0..2 {
        if let Some(inner) = within.get("pose").and_then(Value::as_object) {
            within = inner;
        }
    }
    within.get("position")?.as_object()
}

/// The robot that an object names.
fn robot(object: &Map<String, Value>) -> Result<String, &'static str> {
    let mut named = object.iter().filter(|(name, _)| matches!(part(name), Some((Part::Robot, _))));
    let value = named.next().map(|(_, value)| value);
    if named.next().is_some() {
        return Err("two robots");
    }
    match value.or_else(|| object.get("child_frame_id")).or_else(|| object.get("topic")) {
        Some(Value::String(name)) => Ok(name.clone()),
        Some(Value::Number(number)) => Ok(number.to_string()),
        Some(Value::Null | Value::Bool(_) | Value::Array(_) | Value::Object(_)) | None => Err("no robot"),
    }
}

pub(super) fn read(bytes: &[u8]) -> Result<Log, Fault> {
    let mut reading = Reading::new(Form::JsonLines);
    let mut lines = (1_u32..).zip(bytes.split(|&byte| byte == b'\n')).peekable();
    while let Some((line, bytes)) = lines.next() {
        if bytes.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        let text = || String::from_utf8_lossy(bytes).trim_end().to_owned();
        let fault = |column: usize, what: String| {
            let text = text();
            let place = FaultPlace::Line { line: line as usize, bytes: column..text.len(), text };
            Fault { place, what, remedy: REMEDY.to_owned() }
        };
        let object: Map<String, Value> = match serde_json::from_slice(bytes) {
            Ok(object) => object,
            Err(error) if error.is_eof() && lines.peek().is_none() => {
                reading.log.cut = Some(line);
                break;
            }
            Err(error) => {
                let why = error.to_string();
                let why = why.split(" at line ").next().unwrap_or_default();
                let what = format!("this is no object of JSON: {why}");
                return Err(fault(error.column().saturating_sub(1), what));
            }
        };
        let wrong = |what| fault(0, format!("this line has {what}"));
        let (at_us, mm) = pose(&object, None).map_err(wrong)?;
        let robot = robot(&object).map_err(wrong)?;
        if let Some(frame) = object.get("header").and_then(|header| header.get("frame_id")?.as_str()) {
            reading.frame(frame);
        }
        reading.take(line, Pose { at_us, robot: &robot, mm })?;
    }
    Ok(reading.log)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stamp_of_0_is_none_where_the_time_of_recording_is_known() {
        let object = |nanos: u32| {
            let text = format!(r#"{{"header":{{"stamp":{{"sec":0,"nanosec":{nanos}}}}},"x":1,"y":2}}"#);
            serde_json::from_str(&text).expect("an object")
        };
        let time = |nanos, at_us| pose(&object(nanos), at_us).map(|(time, _)| time);
        assert_eq!([time(0, Some(5)), time(0, None), time(7_000, Some(5))], [Ok(5), Ok(0), Ok(7)]);
    }
}
