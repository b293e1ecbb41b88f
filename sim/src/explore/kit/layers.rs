//! The layers of a page of robots that keep in touch: the radio circle, who hears whom at all speeds, each robot's
//! record, and who asks before it drives.

use tautline_kernel::kit::Reach;

use crate::explore::{Change, Hearers, Ink, Joins, Kind, Layer, Place, Scene, Shape, Value, Zone};
use crate::kit::{Course, Drive, PATH_MILLIMETRES, reach_millimetres};

/// The places of the records and of the messages among the layers.
const RECORDS: usize = 2;
const MESSAGES: usize = 3;

/// The places of the kinds of messages.
const ASKS: usize = 0;
const ANSWERS: usize = 1;

const KINDS: &[Kind] =
    &[Kind::heard("asks for the covered sides"), Kind::heard("answers with the covered sides")];

const DRIVEN: u8 = 1;
const BLOCKED: u8 = 2;

/// The zone of robots that hear so many paths far, and first that of the paper's 10 m.
static ZONES: [Zone; Reach::MOST_PATHS as usize + 1] =
    [in_reach::<0>(), in_reach::<1>(), in_reach::<2>(), in_reach::<3>(), in_reach::<4>(), in_reach::<5>()];

const fn in_reach<const PATHS: u16>() -> Zone {
    let about = if PATHS == 0 { "at most 10 m from node to node" } else { "in range from node to node" };
    let has = |one, other| Reach::of_paths(PATHS).unwrap_or(Reach::PAPER).joins(one, other);
    Zone { name: "in reach", about, has }
}

pub(super) fn layers(reach: Reach) -> Vec<Layer> {
    const RECORD: &[Value] =
        &[Value { name: "driven", ink: Ink::Open }, Value { name: "seen blocked", ink: Ink::Wall }];
    let paths = if reach == Reach::PAPER { 0 } else { usize::from(reach.squared().isqrt()) };
    let millimetres = reach_millimetres(reach);
    let (metres, thousandths) = (millimetres / 1000, (millimetres * 1000 / PATH_MILLIMETRES) as u32);
    vec![
        Layer::new(
            "links",
            "robots that hear each other at the nodes where they go",
            Shape::Links(Joins::All, &ZONES[paths..=paths]),
        ),
        Layer::new(
            "radio circle",
            format!("{metres} m: so far a robot is heard"),
            Shape::Circle(thousandths),
        ),
        Layer::new(
            "records",
            "what the followed robot has driven and seen blocked itself",
            Shape::SidesOfEach(RECORD),
        ),
        Layer::new(
            "messages",
            "a robot that stands asks the others for their records, and drives when they have answered",
            Shape::Messages(KINDS),
        ),
    ]
}

/// The changes that the team has learned of when a drive begins, and how long the drive takes.
pub(super) fn show(course: &dyn Course, drive: Drive, robots: usize, scene: &mut Scene) {
    for robot in 0..robots {
        for (side, is_open) in course.recorded(robot) {
            scene.note(Change::Know { side, is_open });
            scene.put_for(RECORDS, robot, Place::Side(side), if is_open { DRIVEN } else { BLOCKED });
        }
    }
    let others: Vec<usize> = (0..robots).filter(|&other| other != drive.robot).collect();
    if !others.is_empty() {
        scene.say(MESSAGES, ASKS, drive.robot, Hearers::All);
    }
    for other in others {
        scene.say(MESSAGES, ANSWERS, other, Hearers::These(vec![drive.robot]));
    }
    let [begin, end] = drive.time;
    scene.note(Change::Take { robot: drive.robot, milliseconds: end - begin });
}
