//! Verdicts of the clauses, as diagnostics and as markers.

use super::config::{Clause, Config, Id, Robot};
use super::messages::{
    Color, DiagnosticArray, DiagnosticStatus, Header, KeyValue, Marker, MarkerArray, Point, Pose, Quaternion,
    Time,
};
use super::watch::{Status, Watch, WatchedClause};
use tautline_monitor::Breach;

/// How long a viewer shows a marker that is not renewed.
const LIFETIME: Time = Time { sec: 3, nanosec: 0 };
const RED: Color = Color { r: 1.0, g: 0.1, b: 0.1, a: 1.0 };
const UPRIGHT: Quaternion = Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 };

/// Names of robots, one after the other.
fn names<'a>(config: &'a Config, robots: &[usize]) -> Vec<&'a str> {
    robots.iter().map(|&robot| config.robots[robot].name.as_str()).collect()
}

/// A quantity that a clause speaks of: robots in a cell, or millimetres.
fn quantity(id: Id, number: u32) -> String {
    match id {
        Id::Chain2 | Id::Frontier2 | Id::Pack2 => format!("{number} robots"),
        Id::Chain3 | Id::Kit1 | Id::Kit2 | Id::Kit3 | Id::Kit12 => {
            format!("{}.{:03} m", number / 1_000, number % 1_000)
        }
    }
}

/// The sentence for a person about a breach.
fn sentence(config: &Config, id: Id, breach: Breach) -> String {
    let [one, other] = breach.robots.map(|robot| &config.robots[robot].name);
    let [measured, allowed] = [breach.measured, breach.allowed].map(|number| quantity(id, number));
    match id {
        Id::Chain2 | Id::Frontier2 | Id::Pack2 => {
            format!("{measured} are in one cell, {one} and {other} among them; at most {allowed} may be")
        }
        Id::Chain3 => {
            format!("{one} and {other} are {measured} apart; at most {allowed} may be between neighbours")
        }
        Id::Kit1 | Id::Kit2 | Id::Kit12 => {
            format!(
                "the team is in two parts: {one} and {other}, its nearest, are {measured} apart; the range is {allowed}"
            )
        }
        Id::Kit3 => format!("{one} and {other} are {measured} apart; at least {allowed} have to be"),
    }
}

/// The name of a clause in diagnostics: with its robots, as two teams may be watched by one clause.
fn title(config: &Config, clause: &Clause) -> String {
    format!("tautline: {} of {}", clause.id, names(config, &clause.robots).join(", "))
}

impl WatchedClause {
    /// The diagnostic of a clause. `trouble` says why a robot is not heard, where that is known.
    fn diagnostic(&self, watch: &Watch, trouble: &impl Fn(&Robot) -> Option<String>) -> DiagnosticStatus {
        let (config, id) = (&watch.config, self.clause.id);
        let (level, message, robots, numbers) = match self.status {
            Status::Kept => (DiagnosticStatus::OK, "kept".to_owned(), &self.clause.robots[..], None),
            Status::Broken(ref breach) => {
                let message = format!("broken: {}", sentence(config, id, *breach));
                (
                    DiagnosticStatus::ERROR,
                    message,
                    &breach.robots[..],
                    Some([breach.measured, breach.allowed]),
                )
            }
            Status::Silent(ref silent) => {
                let robot = &config.robots[*silent];
                let refused = watch.heard[*silent].refused.as_ref();
                let why = refused.map(|why| format!("its last message was refused: {why}"));
                let why = why.or_else(|| trouble(robot)).map_or_else(String::new, |why| format!("; {why}"));
                let message = format!(
                    "unknown: {} was not heard within {} s{why}",
                    robot.name,
                    config.gap.as_secs_f64()
                );
                (DiagnosticStatus::STALE, message, std::slice::from_ref(silent), None)
            }
        };
        let moment = format!("{}.{:06}", self.moment.sec, self.moment.nanosec / 1_000);
        let mut values = vec![("clause", id.to_string()), ("robots", names(config, robots).join(", "))];
        if let Some([measured, allowed]) = numbers {
            values.extend([("measured", quantity(id, measured)), ("allowed", quantity(id, allowed))]);
        }
        values.push(("moment", moment));
        let value = |(key, value): (&str, String)| KeyValue { key: key.to_owned(), value };
        DiagnosticStatus {
            level,
            name: title(config, &self.clause),
            message,
            hardware_id: "tautline".to_owned(),
            values: values.into_iter().map(value).collect(),
        }
    }

    /// The markers of a clause: a line between the two robots that break it, and a text in its middle; both are taken
    /// away while the clause is not broken.
    fn markers(&self, number: usize, watch: &Watch) -> [Marker; 2] {
        let frame_id = watch.frame.clone().unwrap_or_default();
        let [line, text] = [0, 1].map(|part| Marker {
            header: Header { stamp: self.moment.clone(), frame_id: frame_id.clone() },
            ns: "tautline".to_owned(),
            id: (2 * number + part) as i32,
            action: Marker::DELETE,
            pose: Pose { orientation: UPRIGHT, ..Pose::default() },
            color: RED,
            lifetime: LIFETIME,
            ..Marker::default()
        });
        let Status::Broken(breach) = self.status else { return [line, text] };
        let place = |robot: usize| {
            watch.heard[robot].last.as_ref().map(|(_, place)| place.clone()).unwrap_or_default()
        };
        let [one, other] = breach.robots.map(place);
        let middle = Point {
            x: f64::midpoint(one.x, other.x),
            y: f64::midpoint(one.y, other.y),
            z: f64::midpoint(one.z, other.z),
        };
        let scale = |x: f64, z: f64| Point { x, y: 0.0, z };
        [
            Marker {
                kind: Marker::LINE_LIST,
                action: Marker::ADD,
                scale: scale(0.05, 0.0),
                points: vec![one, other],
                ..line
            },
            Marker {
                kind: Marker::TEXT_VIEW_FACING,
                action: Marker::ADD,
                scale: scale(0.0, 0.3),
                pose: Pose { position: middle, orientation: UPRIGHT },
                text: format!("{} {}", self.clause.id, quantity(self.clause.id, breach.measured)),
                ..text
            },
        ]
    }
}

impl Watch {
    /// The diagnostics of all clauses. `trouble` says why a robot is not heard, where that is known.
    pub fn diagnostics(&self, stamp: Time, trouble: impl Fn(&Robot) -> Option<String>) -> DiagnosticArray {
        let status = self.clauses.iter().map(|watched| watched.diagnostic(self, &trouble)).collect();
        DiagnosticArray { header: Header { stamp, frame_id: String::new() }, status }
    }

    /// The markers of all clauses.
    pub fn markers(&self) -> MarkerArray {
        let clauses = self.clauses.iter().enumerate();
        MarkerArray { markers: clauses.flat_map(|(number, watched)| watched.markers(number, self)).collect() }
    }
}
