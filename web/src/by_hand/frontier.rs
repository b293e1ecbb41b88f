//! Frontier cells by hand: which robot looks or arrives next, and which messages are lost.

use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::frontier::{Map, Rule, Status, TinyMap};
use tautline_kernel::ground::Cell;
use tautline_proofs::frontier::areas::{setting, words};
use tautline_proofs::frontier::world::{Demand, Event, Setting, Successor, World};
use tautline_sim::explore::{Ink, Layer, Place, Shape, Value};

use super::scene::{Picture, Scene, SceneWorld, WorldRun};
use super::setup::{ByHand, chosen, small_team, too_large};
use crate::play::Play;
use crate::settings::Settings;

pub(super) const FRONTIER: ByHand = ByHand { name: "frontier", start, row: None };

const NOTES: &[Value] =
    &[Value { name: "explored", ink: Ink::Closing }, Value { name: "an obstacle", ink: Ink::Wall }];

/// The rules of the kernel by the names that the catalogue has for them.
const RULES: [(&str, Rule); 6] = [
    ("published", Rule::PUBLISHED),
    ("repaired", Rule::REPAIRED),
    ("plain", Rule::PLAIN),
    ("wanders", Rule::WANDERS),
    ("literal", Rule::LITERAL),
    ("printed", Rule::PRINTED),
];

fn start(settings: &Settings) -> Result<Box<dyn Play>, Diagnostic> {
    small_team(settings, [begin::<1>, begin::<2>, begin::<3>, begin::<4>, begin::<5>])
}

fn begin<const ROBOTS: usize>(settings: &Settings) -> Result<Box<dyn Play>, Diagnostic> {
    let mut plain = settings.clone();
    let is_lossy = plain.options.remove("loss").is_some();
    let setup = plain.setup()?;
    let layout = &setup.layout;
    let rule = chosen(&RULES, settings)?;
    let setting = setting::<ROBOTS>(rule, (layout.width(), layout.height())).ok_or_else(too_large)?;
    let mut given = TinyMap::new(setting.area).ok_or_else(too_large)?;
    layout.cells().filter(|&cell| !layout.is_free(cell)).for_each(|cell| given.learn(cell, Status::Obstacle));
    // The number of messages lost by hand is bounded, so that the options stay few.
    let max_losses = if is_lossy { 3 } else { 0 };
    let setting = Setting { given: Some(given), max_losses, ..setting };
    let cells = setup.starts();
    let world = <[Cell; ROBOTS]>::try_from(cells.as_slice()).ok().and_then(|cells| setting.start(cells));
    let world = world.ok_or_else(too_large)?;
    Ok(WorldRun::boxed(setting, world, settings.seed))
}

impl<const ROBOTS: usize> SceneWorld for Setting<ROBOTS> {
    fn scene(&self) -> Scene {
        let about = "what the followed robot has noted of cells";
        Scene {
            area: self.area,
            actor: "robot",
            squares: 0,
            names: Vec::new(),
            layers: vec![Layer::new("repository", about, Shape::CellsOfEach(NOTES))],
        }
    }

    fn options(&self, _: &World<ROBOTS>, plan: &Vec<Successor<ROBOTS>>) -> Vec<String> {
        let told = |turned: &Successor<ROBOTS>| {
            let Event::Decides(robot, side, aim, _) = turned.event else {
                return words(&turned.event, &turned.world.cells()).unwrap_or_default();
            };
            let claims = words(&turned.event, &turned.world.cells())
                .map_or(String::new(), |claims| format!("; {claims}"));
            format!("R{} goes to the rim in the {side:?}, for {aim}{claims}", robot + 1)
        };
        plan.iter().map(told).collect()
    }

    fn picture(&self, world: &World<ROBOTS>) -> Picture {
        let mut put = Vec::new();
        for (robot, body) in world.robots().iter().enumerate() {
            for cell in self.area.cells() {
                let value = match body.map.status(cell) {
                    Status::Unexplored => continue,
                    Status::Explored => 1,
                    Status::Obstacle | Status::Body => 2,
                };
                put.push((0, Some(robot), Place::Cell(cell), value));
            }
        }
        let explored = self.area.cells().filter(|&cell| world.truth().status(cell) == Status::Explored);
        Picture { cells: world.cells().to_vec(), explored: explored.collect(), put, ..Picture::default() }
    }

    fn clause(&self, demand: Demand) -> (&'static str, String) {
        (demand.clause(), String::new())
    }
}
