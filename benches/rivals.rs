//! How fast the rivals' team moves are: Full search of eight robots against plain enumeration, and the best joint step
//! of a chain of 8 and of 256 robots.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use tautline_kernel::chain::{Condition, Rule};
use tautline_kernel::ground::{Area, Cell, Step, Steps};
use tautline_papers::rivals::joint::Joint;
use tautline_papers::rivals::joint_step::{Options, Position, best};
use tautline_papers::rivals::{Links, Parameters, Team};

/// Eight robots in 15×15 cells after so many team moves of Full search under E_C.
fn team(team_moves: u32) -> Team {
    let area = Area::new(Cell::new(0, 0), Cell::new(14, 14)).expect("an area");
    let parameters = Parameters { patience: 10_000, ..Parameters::FULL.linked(Links::Covered) };
    let mut team = Team::new(parameters, 8, Cell::new(7, 7), area, 7).expect("a team");
    for _ in 0..team_moves {
        team.advance(&mut |_| true).expect("unexplored cells");
    }
    team
}

/// The least score of all joint moves, each looked at.
fn enumerate(joint: &Joint) -> Option<i64> {
    let mut chosen = vec![0; joint.robots.len()];
    let mut team = vec![joint.base; joint.robots.len()];
    let mut least = None;
    loop {
        let mut price = 0;
        for ((cell, robot), &place) in team.iter_mut().zip(&joint.robots).zip(&chosen) {
            *cell = robot[place].to;
            price += robot[place].price;
        }
        let score = joint.score(&team, price);
        if least.is_none_or(|least| score < least) {
            least = Some(score);
        }
        let Some(place) = (0..chosen.len()).find(|&place| chosen[place] + 1 < joint.robots[place].len())
        else {
            return least.map(|score| score.price);
        };
        chosen[..place].fill(0);
        chosen[place] += 1;
    }
}

fn full_search(bench: &mut Criterion) {
    let joint = team(20).joint().expect("unexplored cells");
    let mut group = bench.benchmark_group("full search, 8 robots");
    group.sample_size(10);
    group.bench_function("a team move", |bencher| {
        let team = team(20);
        bencher.iter(|| team.clone().advance(&mut |_| true).map(|frame| frame.cells.len()));
    });
    group.bench_function("plain enumeration", |bencher| bencher.iter(|| enumerate(black_box(&joint))));
    group.finish();
}

fn step_solver(bench: &mut Criterion) {
    let mut group = bench.benchmark_group("the best joint step of a chain");
    let loose = Rule::REPAIRED.without(Condition::Distinct);
    for robots in [8, 256_i16] {
        let cells: Vec<Cell> = (0..robots).map(|robot| Cell::new(robot, robot / 3)).collect();
        let options: Vec<Options> = (0..i64::from(robots))
            .map(|robot| Options {
                allowed: Steps::ALL,
                known_open: Steps::of_bits((robot % 32) as u8),
                values: std::array::from_fn(|step| (robot * 7 + step as i64 * 11) % 23 - 11),
            })
            .collect();
        assert_eq!(Step::ALL.len(), 5);
        for (name, rule) in [("shared cells", &loose), ("distinct cells", &Rule::REPAIRED)] {
            let position = Position { rule, cells: &cells, options: &options };
            group.bench_function(format!("{robots} robots, {name}"), |bencher| {
                bencher.iter(|| best(black_box(&position)));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, full_search, step_solver);
criterion_main!(benches);
