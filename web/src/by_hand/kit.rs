//! Keep In Touch by hand: which robot arrives next, which decides, and where it turns.

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::ground::{Cell, EdgeMark, Grid, TinyGrid};
use tautline_kernel::kit::{Reach, Rule, Stance};
use tautline_proofs::kit::counterexample::words;
use tautline_proofs::kit::world::{Demand, Setting, Speeds, Successor, World};
use tautline_sim::explore::{Ink, Joins, Layer, Place, Shape, Value, Zone};

use super::scene::{Picture, Scene, SceneWorld, WorldRun};
use super::setup::{ByHand, chosen, small_team, too_large};
use crate::play::Play;
use crate::settings::Settings;

pub(super) const KIT: ByHand = ByHand { name: "kit", start, row: None };

const REACH: Zone = Zone {
    name: "in reach",
    about: "at most 10 m from node to node",
    has: |one, other| Reach::PAPER.joins(one, other),
};

const RECORD: &[Value] =
    &[Value { name: "driven", ink: Ink::Open }, Value { name: "seen blocked", ink: Ink::Wall }];

/// The place of the records among the layers.
const RECORDS: usize = 1;

/// The rules of the kernel by the names that the catalogue has for them.
const RULES: [(&str, Rule); 3] =
    [("published", Rule::PUBLISHED), ("repaired", Rule::REPAIRED), ("ahead", Rule::AHEAD)];

fn start(settings: &Settings) -> Result<Box<dyn Play>, Diagnostic> {
    small_team(settings, [begin::<1>, begin::<2>, begin::<3>, begin::<4>, begin::<5>])
}

fn begin<const ROBOTS: usize>(settings: &Settings) -> Result<Box<dyn Play>, Diagnostic> {
    let setup = settings.setup()?;
    let layout = &setup.layout;
    let rule = chosen(&RULES, settings)?;
    let setting = Setting::<ROBOTS>::new(rule, (layout.width(), layout.height())).ok_or_else(too_large)?;
    let mut given = TinyGrid::new(setting.area).ok_or_else(too_large)?;
    for edge in setting.area.edges().filter(|&edge| !layout.is_open(edge)) {
        given.put_edge(EdgeMark::Wall, edge);
    }
    let setting = Setting { given: Some(given), speeds: Speeds::Any, ..setting };
    let cells = setup.starts();
    let world = <[Cell; ROBOTS]>::try_from(cells.as_slice()).ok().and_then(|cells| setting.start(cells));
    let world = world.ok_or_else(|| {
        Diagnostic::of_field("starts", "the robots cannot start so", "start each of them beside another one")
    })?;
    Ok(WorldRun::boxed(setting, world, settings.seed))
}

impl<const ROBOTS: usize> SceneWorld for Setting<ROBOTS> {
    fn scene(&self) -> Scene {
        let heard = "robots that hear each other at the nodes where they go";
        let driven = "what the followed robot has driven and seen blocked itself";
        Scene {
            area: self.area,
            actor: "robot",
            squares: 0,
            names: Vec::new(),
            layers: vec![
                Layer::new("links", heard, Shape::Links(Joins::All, &[REACH])),
                Layer::new("records", driven, Shape::SidesOfEach(RECORD)),
            ],
        }
    }

    fn options(&self, _: &World<ROBOTS>, plan: &Vec<Successor<ROBOTS>>) -> Vec<String> {
        let told = |turned: &Successor<ROBOTS>| -> String {
            turned.events.iter().map(words).collect::<Vec<_>>().join("; ")
        };
        plan.iter().map(told).collect()
    }

    fn picture(&self, world: &World<ROBOTS>) -> Picture {
        let mut put = Vec::new();
        for (robot, record) in world.team.records().iter().enumerate() {
            for edge in self.area.edges() {
                let value = match () {
                    () if record.edge_has(EdgeMark::Open, edge) => 1,
                    () if record.edge_has(EdgeMark::Wall, edge) => 2,
                    () => continue,
                };
                put.push((RECORDS, Some(robot), Place::Side(edge), value));
            }
        }
        let known = self.area.edges().filter_map(|edge| {
            let is = |mark| world.team.records().iter().any(|record| record.edge_has(mark, edge));
            (is(EdgeMark::Open) || is(EdgeMark::Wall)).then(|| (edge, is(EdgeMark::Open)))
        });
        Picture {
            cells: world.team.stances().map(Stance::to).collect(),
            known: known.collect(),
            put,
            ..Picture::default()
        }
    }

    fn clause(&self, demand: Demand) -> (&'static str, String) {
        (demand.clause(ROBOTS), String::new())
    }
}
