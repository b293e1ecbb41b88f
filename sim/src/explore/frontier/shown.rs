//! The layers of a page of robots that explore cells: each robot's repository, the cells that they have claimed, how
//! far they are heard, who misses what they say, and who stands to take another fix; of rivals the obstacles that all
//! know, and who is assigned to which cell.

use tautline_kernel::frontier::Status;

use crate::explore::{Change, Hearers, Ink, Kind, Layer, Place, Scene, Shape, Value};
use crate::frontier::{Assigned, Explorers};

/// The places among the layers.
const REPOSITORIES: usize = 0;
const CLAIMS: usize = 1;
const MESSAGES: usize = 2;

const KINDS: &[Kind] = &[Kind::heard("tells what it knows"), Kind::lost("is not heard")];

const EXPLORED: u8 = 1;
const OBSTACLE: u8 = 2;

const UNSURE: &[Value] = &[Value { name: "takes another fix", ink: Ink::Goal }];

const CLAIM: &[Value] = &[Value { name: "claimed", ink: Ink::Aim }];

/// The places among the layers of a team whose cells are assigned.
const OBSTACLES: usize = 0;
const ASSIGNMENT: usize = 1;
const ALL_CLAIMS: usize = 2;

fn layer(name: &'static str, about: &str, shape: Shape) -> Layer {
    Layer { name, about: about.to_owned(), shape }
}

pub(super) fn layers_of_assigned() -> Vec<Layer> {
    const MET: &[Value] = &[Value { name: "obstacle", ink: Ink::Wall }];
    const OWN: &[Value] = &[Value { name: "assigned to the followed robot", ink: Ink::Goal }];
    vec![
        layer("obstacles", "the obstacles that a robot has met: all robots know them", Shape::Cells(MET)),
        layer(
            "assignment",
            "the frontier cell that the followed robot goes to next",
            Shape::CellsOfEach(OWN),
        ),
        layer("claims", "the frontier cells that robots go to next", Shape::Cells(CLAIM)),
    ]
}

/// The obstacles that robots have met in the last team move, and who is assigned to which cell from now on.
pub(super) fn show_assigned(robots: &Assigned, scene: &mut Scene) {
    for cell in robots.met() {
        scene.put(OBSTACLES, Place::Cell(cell), 1);
    }
    scene.note(Change::Clear { layer: ASSIGNMENT });
    scene.note(Change::Clear { layer: ALL_CLAIMS });
    for (robot, cell) in robots.aims() {
        scene.put_for(ASSIGNMENT, robot, Place::Cell(cell), 1);
        scene.put(ALL_CLAIMS, Place::Cell(cell), 1);
    }
}

pub(super) fn layers(robots: &Explorers) -> Vec<Layer> {
    const REPOSITORY: &[Value] =
        &[Value { name: "explored", ink: Ink::Open }, Value { name: "obstacle", ink: Ink::Wall }];
    let mut layers = vec![
        layer("repositories", "what the followed robot has stored of cells", Shape::CellsOfEach(REPOSITORY)),
        layer("claims", "the unexplored cells that robots are going to", Shape::Cells(CLAIM)),
        layer("messages", "what robots tell, and who does not hear it", Shape::Messages(KINDS)),
    ];
    if let Some(range_cells) = robots.range_cells() {
        let about = format!("{range_cells} cells: so far a robot is heard");
        layers.push(Layer {
            name: "radio circle",
            about,
            shape: Shape::Circle(u32::from(range_cells) * 1000),
        });
    }
    if robots.is_noisy() {
        let about = "robots that stand in this team move to take another fix, since they are not sure to stay in the next cell";
        layers.push(layer("unsure", about, Shape::Cells(UNSURE)));
    }
    layers
}

/// The cells that robots have learned, claimed and told in the last team move.
pub(super) fn show(robots: &Explorers, scene: &mut Scene) {
    for (robot, news) in robots.news() {
        for &(cell, status) in news {
            let value = match status {
                Status::Unexplored => 0,
                Status::Explored => EXPLORED,
                Status::Obstacle => OBSTACLE,
            };
            scene.put_for(REPOSITORIES, robot, Place::Cell(cell), value);
        }
    }
    scene.note(Change::Clear { layer: CLAIMS });
    for cell in robots.claims() {
        scene.put(CLAIMS, Place::Cell(cell), 1);
    }
    if robots.is_noisy() {
        let unsure = if robots.range_cells().is_some() { MESSAGES + 2 } else { MESSAGES + 1 };
        scene.note(Change::Clear { layer: unsure });
        robots.unsure().for_each(|cell| scene.put(unsure, Place::Cell(cell), 1));
    }
    for (from, deaf) in robots.told() {
        scene.say(MESSAGES, 0, from, Hearers::All);
        if !deaf.is_empty() {
            scene.say(MESSAGES, 1, from, Hearers::These(deaf.clone()));
        }
    }
}
