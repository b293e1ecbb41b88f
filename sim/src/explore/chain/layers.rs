//! The layers of a page of a chain: its links by E_S and E_C, the virtual obstacles of its leader, and its messages.

use tautline_kernel::ground::{Cell, Circle, Edge, EdgeMark, Grid, Step};

use crate::explore::{Change, Ink, Joins, Kind, Layer, Place, Scene, Shape, Value, Zone};

/// The place of the virtual obstacles among the layers.
const VIRTUAL: usize = 1;

const ZONES: &[Zone] = &[
    Zone {
        name: "E_S",
        about: "wholly within r_safe: both robots may go where they like",
        has: |one, other| Circle::SAFE.covers(one, other),
    },
    Zone {
        name: "E_C",
        about: "wholly within r_cov: in contact",
        has: |one, other| Circle::COVERED.covers(one, other),
    },
];

/// The place of the lost bytes among the layers of a chain in which something fails.
pub(super) const LOST: usize = 3;

/// The layers; of a chain in which something is to fail there are the bytes that are lost, too.
pub(super) fn layers(is_faulty: bool) -> Vec<Layer> {
    const VIRTUALS: &[Value] = &[Value { name: "virtual obstacle", ink: Ink::Barred }];
    const LOST_BYTES: &[Kind] = &[Kind::lost("lost byte")];
    let mut layers = vec![
        Layer::new(
            "links",
            "each robot of the chain with the next: in E_S, in E_C, or lost",
            Shape::Links(Joins::Next, ZONES),
        ),
        Layer::new(
            "virtual obstacles",
            "sides that the leader does not cross in this epoch",
            Shape::Sides(VIRTUALS),
        ),
        Layer::new(
            "messages",
            "after a team move every robot tells in one byte what it tried and what came of it",
            Shape::Reports,
        ),
    ];
    if is_faulty {
        layers.push(Layer::new(
            "lost bytes",
            "who did not hear a byte when it was first said; it is said again until all have it",
            Shape::Messages(LOST_BYTES),
        ));
    }
    layers
}

/// The virtual obstacles that a team move from the cells `before` has set; whether an epoch ended before it.
pub(super) fn show<G: Grid>(grid: &G, before: &[Cell], is_new_epoch: bool, scene: &mut Scene) {
    if is_new_epoch {
        scene.note(Change::Clear { layer: VIRTUAL });
    }
    // They are set where the leader stands that plans.
    let Some(&leader) = before.last() else { return };
    for step in grid.sides(EdgeMark::Virtual, leader).iter() {
        if let Step::Cross(side) = step {
            scene.put(VIRTUAL, Place::Side(Edge::new(leader, side)), 1);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use tautline_kernel::chain::{Chain, Intent, Rule};
    use tautline_kernel::ground::{Area, MediumGrid};

    use super::*;
    use tautline_grids::layout::Generator;

    /// The grid of a chain knows all virtual obstacles; what is shown of them team move by team move comes to the same.
    #[test]
    fn the_virtual_obstacles_that_are_shown_are_those_of_the_grid() {
        let (mut most, mut epochs) = (0, 0);
        for seed in 0..20 {
            let generator: Generator = "walls:9x9:0.3".parse().expect("a generator");
            let layout = generator.generate(seed).expect("a layout");
            let area = Area::new(Cell::new(0, 0), Cell::new(8, 8)).expect("an area");
            let grid = MediumGrid::new(area).expect("a small area");
            let mut chain = Chain::<_, 4>::new(Rule::REPAIRED, 4, Cell::new(4, 4), grid).expect("a chain");
            let (mut log, mut shown) = (Vec::new(), BTreeSet::new());
            loop {
                let (before, epoch) = (chain.cells().to_vec(), chain.epochs());
                let Ok(Intent::Go(plan)) = chain.plan(&log) else { break };
                let settled = chain.settle(&plan, |edge| layout.is_open(edge));
                log.extend_from_slice(settled.messages());
                let mut scene = Scene::default();
                show(chain.grid(), &before, epoch < chain.epochs(), &mut scene);
                for change in scene.changes() {
                    match change {
                        Change::Put { place: Place::Side(edge), value: 1, .. } => {
                            shown.insert(*edge);
                        }
                        Change::Clear { .. } => shown.clear(),
                        other => panic!("{other:?}"),
                    }
                }
                let is_virtual = |edge: &Edge| chain.grid().edge_has(EdgeMark::Virtual, *edge);
                let known: BTreeSet<Edge> = area.edges().filter(is_virtual).collect();
                assert_eq!(shown, known, "seed {seed}");
                most = most.max(known.len());
            }
            epochs += chain.epochs();
        }
        assert!(most > 2 && epochs > 0, "{most} virtual obstacles, {epochs} epochs");
    }
}
