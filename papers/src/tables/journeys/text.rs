//! The figures of journeys as text.

use super::super::prelude::*;
use super::claims::CLOSE;
use super::density::Density;
use super::world::{Settings, Way};
use tautline_field::tan::{NextSensor, Scans};

/// The figure for people.
pub(super) fn figures(settings: &Settings, densities: &[Density]) -> String {
    let is_by_shape = densities.iter().any(|density| density.shape.is_some());
    let obstacles = match settings.obstacles_m.len() + usize::from(is_by_shape) {
        0 => "no obstacle".to_owned(),
        some => counted(some, "obstacle"),
    };
    let scan = match settings.scan {
        Scans::Again => "",
        Scans::Once => ", one scan for each signal",
    };
    let reich = match settings.reich {
        NextSensor::Least => "",
        NextSensor::Largest => ", Reich's robot goes to the largest gradient",
        NextSensor::LargestAndBack => ", Reich's robot goes to the largest gradient, and back",
    };
    let near = match settings.near_percent {
        near if near.total_cmp(&1.0).is_eq() => String::new(),
        near => format!(", at a node within {} % of the range", Number(near)),
    };
    let heading = format!(
        "{side}×{side} m, range {} m, {obstacles}, k = {}, noise {} dB, {} for \
         each number of nodes, seed {}{scan}{reich}{near}",
        Number(settings.range_m),
        settings.k.0.get(),
        Number(settings.noise_db),
        counted(settings.topologies, "topology"),
        settings.seed,
        side = Number(settings.side_m),
    );
    let mut table = Figures::new(heading, densities);
    if is_by_shape {
        table.row("shape", |density| density.shape.unwrap_or_default().to_owned());
    }
    table.row("nodes", |density| density.nodes.to_string());
    table.row("linked", |density| percent(density.linked, 1));
    table.row("told", |density| percent(density.told, 1));
    table.title("Arrivals, % of those linked");
    for (place, way) in Way::ALL.into_iter().enumerate() {
        table.row(way.word(), |density| percent(density.ways[place].arrivals, 1));
    }
    table.title("RD where all arrive");
    table.row("topologies", |density| density.ways[0].ratio.map_or(0, |ratio| ratio.count).to_string());
    for (place, way) in Way::ALL.into_iter().enumerate() {
        table.row(way.word(), |density| text(density.ways[place].ratio, 2));
    }
    table.title("Seconds for each metre of the shortest way");
    for (place, way) in Way::ALL.into_iter().enumerate() {
        if densities.iter().any(|density| density.ways[place].seconds.is_some()) {
            table.row(way.word(), |density| text(density.ways[place].seconds, 2));
        }
    }
    table.title("TAN");
    table.row("hops", |density| text(density.hops, 2));
    table.row("shorter, %", |density| percent(density.shorter_than_reich, 1));
    table.with_notes(&format!(
        "linked: % of the topologies in which links lead from the robot to the WFR · told: % of those in \
         which the robot\nhears the call by k-FNF, which TAN needs · RD: metres walked for each metre of the \
         shortest way · hops: for each hop\nof the shortest chain of links · shorter: % of the topologies in \
         which TAN's way is shorter than Reich's · holds, fails:\nthe whole 95 % interval says so, close \
         being up to {CLOSE} · ±, […]: that interval"
    ))
}
