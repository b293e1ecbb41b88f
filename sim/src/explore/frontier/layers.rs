//! The layers of a page of robots that explore cells: each robot's repository, the cells that they have claimed, how
//! far they are heard, who misses what they say, who stands to take another fix, and where robots and objects are and
//! are taken to be; of rivals the obstacles that all know, and who is assigned to which cell.

use tautline_kernel::frontier::Status;

use crate::explore::{Change, Hearers, Ink, Kind, Layer, Mark, Place, Scene, Shape, Value};
use crate::frontier::{AssignedTeam, Explorers};

/// The places among the layers.
const REPOSITORIES: usize = 0;
const CLAIMS: usize = 1;
const MESSAGES: usize = 2;

const KINDS: &[Kind] = &[Kind::heard("tells what it knows"), Kind::lost("is not heard")];

const EXPLORED: u8 = 1;
const OBSTACLE: u8 = 2;

/// The names of layers that only some teams have.
const STANDING: &str = "unsure";
const BELIEFS: &str = "beliefs";
const FIXES: &str = "fixes";
const OBJECTS: &str = "objects";
const SMALL: &str = "small obstacles";

/// The values of a thing that is taken to be somewhere, and is there.
const GUESSED: u8 = 1;
const REAL: u8 = 2;

const UNSURE: &[Value] = &[Value { name: "takes another fix", ink: Ink::Goal }];

const CLAIM: &[Value] = &[Value { name: "claimed", ink: Ink::Aim }];

/// The places among the layers of a team whose cells are assigned.
const OBSTACLES: usize = 0;
const ASSIGNMENT: usize = 1;
const ALL_CLAIMS: usize = 2;

pub(super) fn layers_of_assigned() -> Vec<Layer> {
    const MET: &[Value] = &[Value { name: "obstacle", ink: Ink::Wall }];
    const OWN: &[Value] = &[Value { name: "assigned to the followed robot", ink: Ink::Goal }];
    vec![
        Layer::new(
            "obstacles",
            "the obstacles that a robot has met: all robots know them",
            Shape::Cells(MET),
        ),
        Layer::new(
            "assignment",
            "the frontier cell that the followed robot goes to next",
            Shape::CellsOfEach(OWN),
        ),
        Layer::new("claims", "the frontier cells that robots go to next", Shape::Cells(CLAIM)),
    ]
}

/// The obstacles that robots have met in the last team move, and who is assigned to which cell from now on.
pub(super) fn show_assigned(robots: &AssignedTeam, scene: &mut Scene) {
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
        Layer::new(
            "repositories",
            "what the followed robot has stored of cells",
            Shape::CellsOfEach(REPOSITORY),
        ),
        Layer::new("claims", "the unexplored cells that robots are going to", Shape::Cells(CLAIM)),
        Layer::new("messages", "what robots tell, and who does not hear it", Shape::Messages(KINDS)),
    ];
    if let Some(range_cells) = robots.range_cells() {
        let about = format!("{range_cells} cells: so far a robot is heard");
        layers.push(Layer::new("radio circle", about, Shape::Circle(u32::from(range_cells) * 1000)));
    }
    if robots.is_noisy() {
        const BELIEF: &[Value] = &[
            Value { name: "takes itself to be here and to head there, with 95 %", ink: Ink::Aim },
            Value { name: "is here", ink: Ink::Wall },
        ];
        const FIX: &[Value] = &[Value { name: "its last fix, with 95 %", ink: Ink::Barred }];
        let about = "robots that stand in this team move to take another fix, since \
                     they are not sure to stay in the next cell";
        layers.push(Layer::new(STANDING, about, Shape::Cells(UNSURE)));
        let about = "where robots are, and where they take themselves to be by wheels and fixes";
        layers.push(Layer::new(BELIEFS, about, Shape::Marks(BELIEF)));
        layers.push(Layer::new(FIXES, "the places that robots were told last by anchors", Shape::Marks(FIX)));
    }
    if robots.has_small() {
        const DETOUR: &[Value] = &[Value { name: "a robot has gone round one", ink: Ink::Barred }];
        layers.push(Layer::new(
            SMALL,
            "obstacles between cells that are smaller than a cell",
            Shape::Sides(DETOUR),
        ));
    }
    if !robots.objects().is_empty() {
        const OBJECT: &[Value] = &[
            Value { name: "an object is taken to be here, with 95 %", ink: Ink::Open },
            Value { name: "is here", ink: Ink::Wall },
        ];
        let about = "objects, and where the robots that have seen them take them to be";
        layers.push(Layer::new(OBJECTS, about, Shape::Marks(OBJECT)));
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
                Status::Obstacle | Status::Body => OBSTACLE,
            };
            scene.put_for(REPOSITORIES, robot, Place::Cell(cell), value);
        }
    }
    scene.note(Change::Clear { layer: CLAIMS });
    for cell in robots.claims() {
        scene.put(CLAIMS, Place::Cell(cell), 1);
    }
    let layers = layers(robots);
    let layer = |name: &str| layers.iter().position(|layer| layer.name == name);
    if let (Some(unsure), Some(beliefs), Some(fixes)) = (layer(STANDING), layer(BELIEFS), layer(FIXES)) {
        scene.note(Change::Clear { layer: unsure });
        robots.unsure().for_each(|cell| scene.put(unsure, Place::Cell(cell), 1));
        let count = robots.cells().len();
        for (robot, (at, belief, fix)) in robots.poses().enumerate() {
            let guess = Mark::guess(robot, GUESSED, belief.at(), belief.covariance());
            let [.., variance] = belief.heading_covariance();
            scene.mark(beliefs, guess.heading(belief.heading_rad(), variance));
            scene.mark(beliefs, Mark::exact(count + robot, REAL, at));
            if let Some(fix) = fix {
                scene.mark(fixes, Mark::guess(robot, GUESSED, fix.at, fix.covariance));
            }
        }
    }
    if let Some(small) = layer(SMALL) {
        robots.detours().for_each(|edge| scene.put(small, Place::Side(edge), 1));
    }
    if let Some(objects) = layer(OBJECTS) {
        let count = robots.objects().len();
        for (number, (at, known)) in robots.objects().iter().enumerate() {
            scene.mark(objects, Mark::exact(count + number, REAL, *at));
            if let Some(known) = known {
                scene.mark(objects, Mark::guess(number, GUESSED, known.at, known.covariance));
            }
        }
    }
    for (from, deaf) in robots.told() {
        scene.say(MESSAGES, 0, from, Hearers::All);
        if !deaf.is_empty() {
            scene.say(MESSAGES, 1, from, Hearers::These(deaf.clone()));
        }
    }
}
