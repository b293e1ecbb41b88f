//! The layers of a page of a pack: the obstacles that it has seen, where its robots are going, and how far they see and
//! hear.

use tautline_kernel::ground::Cell;
use tautline_kernel::pack::Rule;

use crate::explore::{Change, Ink, Layer, Place, Scene, Shape, Value};

/// The places of the layers.
const OBSTACLES: usize = 0;
const AIMS: usize = 1;

const OBSTACLE: &[Value] = &[Value { name: "seen obstacle", ink: Ink::Wall }];
const AIM: &[Value] = &[Value { name: "aim", ink: Ink::Aim }];

pub(super) fn layers(rule: &Rule) -> Vec<Layer> {
    let circle =
        |name, about: String, cells: u16| Layer::new(name, about, Shape::Circle(u32::from(cells) * 1000));
    let (sight_cells, range_cells) = (rule.sight().radius_cells(), rule.range_cells());
    vec![
        Layer::new("obstacles", "the obstacles that a robot has seen", Shape::Cells(OBSTACLE)),
        Layer::new("aims", "the frontier cells that robots are going to", Shape::Cells(AIM)),
        circle("sight", format!("R_s, {sight_cells} cells: so far a robot sees"), sight_cells.into()),
        circle("radio circle", format!("R_c, {range_cells} cells: so far a robot is heard"), range_cells),
    ]
}

/// The obstacles that were seen in the last team move, and where robots are going.
pub(super) fn show(obstacles: &[Cell], aims: impl Iterator<Item = Cell>, scene: &mut Scene) {
    for &cell in obstacles {
        scene.put(OBSTACLES, Place::Cell(cell), 1);
    }
    scene.note(Change::Clear { layer: AIMS });
    for cell in aims {
        scene.put(AIMS, Place::Cell(cell), 1);
    }
}
