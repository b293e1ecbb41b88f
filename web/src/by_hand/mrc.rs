//! MRC by hand: which message arrives, is lost or comes twice, whose timer goes off, and who fails.

use serde_json::{Value as Json, json};
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::{Area, Cell};
use tautline_kernel::mrc::{Phase, Rule, Task};
use tautline_proofs::mrc::space::{Space, Until};
use tautline_proofs::mrc::{
    Action, Actor, Demand, Faults, Leases, LossKind, ROBOTS, RobotReading, Setting, State, WFRS, chart,
};
use tautline_sim::explore::{Ink, Kind, Layer, Place, Shape, Value};

use super::scene::{Picture, Scene, SceneWorld, WorldRun};
use super::setup::{ByHand, HuntFindings, chosen, number, of_world, search};
use crate::play::Play;
use crate::settings::Settings;

pub(super) const MRC: ByHand = ByHand { name: "mrc", start, row: Some((row, hunt)) };

const STAGES: &[Value] = &[
    Value { name: "a robot asks", ink: Ink::Closing },
    Value { name: "a robot is on its way", ink: Ink::Closed },
    Value { name: "a WFR hears robots", ink: Ink::Aim },
    Value { name: "a WFR has chosen", ink: Ink::Sealed },
    Value { name: "a WFR is rescued", ink: Ink::Open },
];
const KINDS: &[Kind] = &[Kind::heard("a message under way")];

fn row() -> Json {
    let option = |field: &str, about: &str| json!({ "field": field, "takes": "COUNT", "about": about });
    json!({
        "name": "mrc",
        "about": "MRC: robots and those that wait for rescue agree who comes, by messages that may be lost",
        "team": "team", "robot": "robot", "robots": [1, ROBOTS], "base": false, "starts": "none",
        "misses": false, "draws": true, "by_hand": "only",
        "options": [
            option("wfrs", "How many wait for rescue, from 1 to 3. Without it 2"),
            option("events", "How often something happens to them. Without it 2"),
            option("faults", "How many messages may be lost or come twice, and \
                              timers, robots and nodes fail. Without it 2"),
        ],
        "rules": [
            of_world("repaired", "With the repairs of its refuted claims", &Rule::REPAIRED),
            of_world("published", "As the paper publishes it", &Rule::PUBLISHED),
        ],
    })
}

fn start(settings: &Settings) -> Result<Box<dyn Play>, Diagnostic> {
    let setting = setting(settings)?;
    Ok(WorldRun::boxed(Space { setting, until: Until::Exhausted }, setting.start(0), settings.seed))
}

fn hunt(settings: &Settings, most_steps: u64) -> Result<HuntFindings, Diagnostic> {
    let setting = setting(settings)?;
    let space = Space { setting, until: Until::Exhausted };
    Ok(search(&space, &setting.start(0), most_steps, |demand: Demand| Some(demand.clause())))
}

fn setting(settings: &Settings) -> Result<Setting, Diagnostic> {
    let robots = usize::from(settings.robots);
    if !(1..=ROBOTS).contains(&robots) {
        let what = format!("{robots} robots are not played by hand");
        return Err(Diagnostic::of_field("robots", what, format_args!("take 1 to {ROBOTS}")));
    }
    Ok(Setting {
        rule: chosen(&[("published", Rule::PUBLISHED), ("repaired", Rule::REPAIRED)], settings)?,
        misread: None,
        reading: RobotReading::PUBLISHED,
        robots,
        wfrs: usize::from(number(settings, "wfrs", 2, WFRS as u8)?).max(1),
        events: number(settings, "events", 2, 9)?,
        max_hops: 1,
        faults: Faults::any(number(settings, "faults", 2, 9)?),
        lossy: LossKind::All,
        leases: Leases::UntilCalled,
    })
}

/// Where an actor is drawn: those that wait above, robots below.
const fn spot(actor: Actor) -> Cell {
    match actor {
        Actor::Wfr(wfr) => Cell::new(2 * wfr as i16 + 1, 1),
        Actor::Robot(robot) => Cell::new(2 * robot as i16 + 1, 5),
    }
}

/// The actors, those that wait first.
fn actors(setting: &Setting) -> Vec<Actor> {
    (0..setting.wfrs).map(Actor::Wfr).chain((0..setting.robots).map(Actor::Robot)).collect()
}

impl SceneWorld for Space {
    fn scene(&self) -> Scene {
        let columns = 2 * self.setting.robots.max(self.setting.wfrs) as i16;
        let first = Cell::new(0, 0);
        let name = |actor: &Actor| match actor {
            Actor::Wfr(wfr) => format!("W{}", wfr + 1),
            Actor::Robot(robot) => format!("R{}", robot + 1),
        };
        Scene {
            area: Area::new(first, Cell::new(columns, 6)).unwrap_or(Area::of(first)),
            actor: "actor",
            squares: self.setting.wfrs,
            names: actors(&self.setting).iter().map(name).collect(),
            layers: vec![
                Layer::new("stages", "what each robot and each WFR does", Shape::Cells(STAGES)),
                Layer::new("network", "the messages under way", Shape::Messages(KINDS)),
            ],
        }
    }

    fn options(&self, state: &State, plan: &Vec<Action>) -> Vec<String> {
        let told = |&action: &Action| {
            chart::happens(&self.setting, state, action, &state.after(&self.setting, action))
        };
        plan.iter().map(told).collect()
    }

    fn picture(&self, state: &State) -> Picture {
        let actors = actors(&self.setting);
        let place = |actor: Actor| actors.iter().position(|&other| other == actor).unwrap_or(0);
        let stage = |actor: Actor| match actor {
            Actor::Robot(robot) => match state.robot(robot).task() {
                Task::Free => 0,
                Task::Asking { .. } => 1,
                Task::Leased { .. } => 2,
            },
            Actor::Wfr(wfr) => match state.wfr(wfr).phase() {
                Phase::Idle => 0,
                Phase::Collecting { .. } => 3,
                Phase::Offered { .. } | Phase::Leased { .. } => 4,
                Phase::Rescued { .. } => 5,
            },
        };
        let put = actors.iter().map(|&actor| (0, None, Place::Cell(spot(actor)), stage(actor)));
        let say = state.network().iter().map(|&message| {
            let (from, to) = chart::between(message);
            (1, 0, place(from), place(to))
        });
        Picture {
            cells: actors.iter().map(|&actor| spot(actor)).collect(),
            put: put.filter(|&(.., value)| value > 0).collect(),
            say: say.collect(),
            ..Picture::default()
        }
    }

    fn clause(&self, demand: Demand) -> (&'static str, String) {
        (demand.clause(), format!("{}.", demand.broken()))
    }
}
