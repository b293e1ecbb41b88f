//! Journeys of robots over random radio fields: who arrives, by how long a way, and what they never do.

use proptest::prelude::*;
use tautline_field::radio::{Area, Field, Model, Network, Obstacle, Point, Radio};
use tautline_field::tan::{End, Equipment, Journey, NextSensor, Site, Tree, hops, shortest_m};
use tautline_kernel::choice::Oracle;
use tautline_kernel::net::NodeId;
use tautline_kernel::notice::{Count, Rule, Scheme};
use tautline_proofs::engine::SeededOracle;

const LAKES: [Obstacle; 2] = [
    Obstacle { west_m: 60.0, north_m: 50.0, east_m: 110.0, south_m: 90.0 },
    Obstacle { west_m: 130.0, north_m: 100.0, east_m: 160.0, south_m: 170.0 },
];

/// A field of 200×200 m with a robot as its last node, its links, and a WFR.
struct World {
    field: Field,
    network: Network,
    radio: Radio,
    wfr: NodeId,
    chance: SeededOracle,
}

impl World {
    fn new(nodes: usize, obstacles: &[Obstacle], model: Model, seed: u64) -> Self {
        let mut chance = SeededOracle::new(seed, 0);
        let area = Area::new(200.0, 200.0).expect("an area");
        let field = Field::random(area, obstacles.to_vec(), nodes, &mut chance).expect("a field");
        let robot = field.place(&mut chance).expect("a place");
        let field = field.with(&[robot]).expect("a field");
        let radio = Radio::new(25.0, model).expect("a radio");
        let network = Network::new(&field, radio, &mut chance).expect("a network");
        let wfr = NodeId(chance.pick(nodes as u32));
        Self { field, network, radio, wfr, chance }
    }

    fn tree(&mut self) -> Tree {
        let rule = Rule::new(Scheme::Farthest { k: Some(Count::ONE) }, self.radio.range_um(), 100_000_000);
        let robot = NodeId(self.field.nodes().len() as u32 - 1);
        Tree::grow(&self.network, rule, (self.wfr, robot), &mut self.chance).expect("a tree")
    }

    /// The journeys by TAN, Verma, Reich and Sheu.
    fn journeys(&mut self, noise_db: f64) -> [Journey; 4] {
        let tree = self.tree();
        let equipment = Equipment::new(self.radio, noise_db).expect("equipment");
        let site = Site { field: &self.field, network: &self.network, equipment };
        [
            site.tan(&tree, self.wfr, &mut self.chance),
            site.verma(self.wfr),
            site.reich(self.wfr, NextSensor::Least, &mut self.chance),
            site.sheu(self.wfr, &mut self.chance),
        ]
    }

    fn is_connected(&self) -> bool {
        let robot = NodeId(self.field.nodes().len() as u32 - 1);
        hops(&self.network, self.wfr, |node| node != robot)[robot.0 as usize].is_some()
    }
}

fn apart_m(one: Point, other: Point) -> f64 {
    (one.x_m - other.x_m).hypot(one.y_m - other.y_m)
}

/// Asserts of a journey: it begins where the robot is, goes straight from place to place through no obstacle and is as
/// long as that, and one that ends at the WFR ends within `near_m` and is no shorter than the shortest way there.
fn check(world: &World, journey: &Journey, near_m: f64) -> Result<(), TestCaseError> {
    let start = world.field.nodes()[world.field.nodes().len() - 1];
    let goal = world.field.nodes()[world.wfr.0 as usize];
    prop_assert_eq!(journey.trail[0], start);
    let legs = || journey.trail.windows(2).map(|leg| (leg[0], leg[1]));
    let sum: f64 = legs().map(|(from, to)| apart_m(from, to)).sum();
    // The parts of a direction are rounded to millionths.
    prop_assert!((sum - journey.length_m).abs() <= 1e-6 * sum, "{} {}", sum, journey.length_m);
    for (from, to) in legs() {
        prop_assert!(world.field.has_way(from, to) && world.field.area().contains(to), "{:?} {:?}", from, to);
    }
    if journey.end == End::Arrived {
        let end = journey.trail[journey.trail.len() - 1];
        prop_assert!(apart_m(end, goal) <= near_m, "{:?}", end);
        let shortest = shortest_m(&world.field, start, goal).expect("there is a way");
        prop_assert!(journey.length_m >= shortest - near_m, "{} {}", journey.length_m, shortest);
    }
    Ok(())
}

/// How far from a node a robot may be that takes itself to be at it: 0.25 m, as the strengths are read. They are whole
/// hundredths of a dB, and two of them are compared: the distance may be 0.01 dB more, which in free space is 0.12 %.
fn near_m() -> f64 {
    0.25 * 10_f64.powf(0.01 / 20.0)
}

#[test]
fn a_robot_whose_strengths_are_rounded_stops_a_hair_beyond_a_quarter_of_a_metre() {
    let mut world = World::new(109, &[], Model::Disc, 2_877_360_739_464_539_715);
    let goal = world.field.nodes()[world.wfr.0 as usize];
    let [.., sheu] = world.journeys(0.0);
    let far_m = apart_m(sheu.trail[sheu.trail.len() - 1], goal);
    assert!(sheu.end == End::Arrived && 0.25 < far_m && far_m <= near_m(), "{far_m}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn without_obstacles_and_noise_every_journey_over_connected_nodes_arrives(seed: u64, nodes in 2_usize..600) {
        let mut world = World::new(nodes, &[], Model::Disc, seed);
        let has_heard = world.tree().entry().is_some();
        let [tan, verma, reich, sheu] = world.journeys(0.0);
        let ends = |arrives: bool| if arrives { End::Arrived } else { End::Unaware };
        let connected = ends(world.is_connected());
        prop_assert_eq!(tan.end, ends(has_heard));
        prop_assert_eq!([verma.end, reich.end, sheu.end], [connected; 3]);
        for journey in [tan, verma, reich, sheu] {
            check(&world, &journey, near_m())?;
        }
    }

    #[test]
    fn nobody_walks_into_an_obstacle_whatever_is_heard(
        seed: u64, nodes in 100_usize..600, noise_db in 0.0..4.0_f64, deviation_db in 0.0..4.0_f64
    ) {
        let model = Model::Shadowed { exponent: 3.0, deviation_db };
        let mut world = World::new(nodes, &LAKES, model, seed);
        // A shadow and noise of 12 dB each make a node seem 10^0.8 times as near.
        for journey in world.journeys(noise_db) {
            check(&world, &journey, 0.25 * 6.4)?;
        }
    }
}

/// With shadows, noise and obstacles: whatever a library of floats could have a say in.
#[test]
fn the_same_seed_makes_the_same_journeys_on_every_machine() {
    let mut world = World::new(500, &LAKES, Model::Shadowed { exponent: 3.0, deviation_db: 2.0 }, 3);
    let journeys = world.journeys(0.5);
    let made = journeys.map(|journey| (journey.end, (journey.length_m * 1e6) as u64, journey.time_ns));
    assert_eq!(
        made,
        [
            (End::Arrived, 66_402_981, Some(208_926_540_713)),
            (End::Arrived, 62_673_171, None),
            (End::Arrived, 66_210_455, Some(189_568_990_558)),
            (End::Arrived, 187_253_610, None),
        ]
    );
}

/// Noise makes ways longer and scans more, but a directional antenna gets a robot there.
#[test]
fn by_a_directional_antenna_robots_arrive_in_spite_of_noise_and_convex_lakes() {
    let arrivals = (0..100).map(|seed| {
        let mut world = World::new(500, &LAKES, Model::Disc, seed);
        world.journeys(1.0).map(|journey| u32::from(journey.end == End::Arrived))
    });
    let arrivals =
        arrivals.fold([0; 4], |[tan, verma, reich, sheu], [more, more_verma, more_reich, more_sheu]| {
            [tan + more, verma + more_verma, reich + more_reich, sheu + more_sheu]
        });
    assert_eq!(arrivals, [100; 4]);
}

/// By journey and way to read Reich's rule: how the journey ended, and its whole metres.
fn by_reich(worlds: impl Iterator<Item = World>) -> Vec<[(End, u64); 3]> {
    let orders = [NextSensor::Least, NextSensor::Largest, NextSensor::LargestAndBack];
    let journeys = |mut world: World| {
        let equipment = Equipment::new(world.radio, 0.0).expect("equipment");
        let site = Site { field: &world.field, network: &world.network, equipment };
        orders.map(|order| {
            let journey = site.reich(world.wfr, order, &mut world.chance);
            (journey.end, journey.length_m as u64)
        })
    };
    worlds.map(journeys).collect()
}

/// By the largest gradient a robot leaves the target, and comes there only if nothing unvisited is farther.
#[test]
fn in_a_row_of_nodes_the_largest_gradient_leads_to_the_end_that_is_far_from_the_target() {
    let row = |last: u32, robot_m: f64| {
        let area = Area::new(400.0, 10.0).expect("an area");
        let at = |x_m: f64| Point { x_m, y_m: 5.0 };
        let nodes = (0..=last).map(|node| at(1.0 + 20.0 * f64::from(node)));
        let nodes = nodes.chain([at(1.0 + robot_m)]).collect();
        let field = Field::new(area, vec![], nodes).expect("a field");
        let radio = Radio::new(25.0, Model::Disc).expect("a radio");
        let mut chance = SeededOracle::new(0, 0);
        let network = Network::new(&field, radio, &mut chance).expect("a network");
        World { field, network, radio, wfr: NodeId(0), chance }
    };
    let [middle, near, short] = [row(10, 105.0), row(10, 10.0), row(1, 10.0)];
    assert_eq!(
        by_reich([middle, near, short].into_iter()),
        [
            [(End::Arrived, 104), (End::Lost, 94), (End::Arrived, 294)],
            [(End::Arrived, 9), (End::Lost, 189), (End::Arrived, 9)],
            [(End::Arrived, 9), (End::Arrived, 29), (End::Arrived, 9)],
        ]
    );
}

#[test]
fn by_the_largest_gradient_25_of_200_robots_arrive_and_all_that_go_back_on_ways_33_times_as_long() {
    let worlds = (0..200).map(|seed| World::new(300, &[], Model::Disc, seed));
    let journeys = by_reich(worlds.filter(World::is_connected));
    let arrived = |order: usize| {
        let arrived = journeys.iter().map(|ends| ends[order]).filter(|(end, _)| *end == End::Arrived);
        arrived.fold((0, 0), |(count, metres), (_, length_m)| (count + 1, metres + length_m))
    };
    assert_eq!(
        (journeys.len(), [0, 1, 2].map(arrived)),
        (200, [(200, 23_274), (25, 106_313), (200, 760_599)])
    );
}
