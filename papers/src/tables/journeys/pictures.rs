//! The figures of journeys as pictures: the ways in one topology, or RD as a chart.

use tautline_kernel::net::NodeId;

use super::super::prelude::*;
use super::density::Density;
use super::world::{Settings, Way, World};
use tautline_field::draw::field::{self, Map, Terminus, Trail};
use tautline_field::tan::End;

/// The journeys by some ways in the topology in which the shortest is the longest.
pub(super) fn picture(
    cases: &[(usize, Option<&str>, Settings)],
    ways: &[Way],
    densities: &[Density],
) -> Result<String, Halt> {
    let drawn = cases.iter().zip(densities).find_map(|(case, density)| Some((case, density.longest?)));
    let (&(nodes, _, ref settings), topology) = drawn.ok_or_else(|| {
        let remedy = "take more topologies or nodes";
        Diagnostic::usage("there is no topology to draw in which all arrive", remedy)
    })?;
    let world = World::new(settings, nodes, topology).map_err(usage)?;
    let tree = world.tree().map_err(usage)?;
    let place = |node: NodeId| world.field.nodes()[node.0 as usize];
    let map = |&way: &Way| {
        let journey = world.journey(&tree, way);
        let times = world.shortest_m().map_or(String::new(), |shortest_m| {
            format!(", {:.2} times the shortest way", journey.length_m / shortest_m)
        });
        let links = match way {
            Way::Tan => tree.links().map(|(node, parent)| [place(node), place(parent)]).collect(),
            Way::Verma | Way::Reich | Way::Sheu => Vec::new(),
        };
        let end = match journey.end {
            End::Arrived => Terminus::There,
            End::Unaware | End::Lost | End::Astray => Terminus::GaveUp,
        };
        Map {
            caption: format!("{}: {:.0} m{times}", way.word(), journey.length_m),
            field: &world.field,
            nodes,
            links,
            trails: vec![Trail { name: way.word().to_owned(), places: journey.trail, end }],
            wfrs: vec![world.goal()],
        }
    };
    let maps: Vec<Map<'_>> = ways.iter().map(map).collect();
    Ok(field::picture("The way of a robot to the node that waits for rescue", &maps))
}

/// RD by the number of nodes, as a chart.
pub(super) fn chart(densities: &[Density]) -> LineChart {
    let series = |(place, way): (usize, Way)| {
        let point = |density: &Density| {
            Some(Point::of(f64::from(density.nodes as u32), density.ways.get(place)?.ratio?))
        };
        Series::measured(way.word(), densities.iter().filter_map(point))
    };
    LineChart::new(
        "Metres walked for each metre of the shortest way",
        Axis::new("nodes", ""),
        Axis::new("RD", "").showing([1.0, 1.0]),
        Way::ALL.into_iter().enumerate().map(series),
    )
}
