//! The cost of an agent's step on a sensor floor: by scheme, among rooms and in the open, on 30×30 and on 512×512
//! cells.
//! Criterion follows each figure over time; the table at the end relates them to one another.

use criterion::{BenchmarkId, Criterion};
use tautline_benches::{Cost, Group, group, measure};
use tautline_grids::chance::Probability;
use tautline_grids::layout::{Generator, Layout};
use tautline_kernel::bricks::tree;
use tautline_kernel::ground::Cell;
use tautline_kernel::{ants, bricks};
use tautline_proofs::bricks::tree::mdfs::Mdfs;
use tautline_proofs::floor::crew::Scheme;
use tautline_sim::explore::agents::Agents;

/// The work of a run.
#[derive(Clone, Copy, Default)]
struct Work {
    team_moves: u32,
    /// Actions of agents that were not done.
    agent_steps: u32,
}

impl tautline_benches::Work for Work {
    fn parts(&self) -> u32 {
        self.team_moves
    }
}

const AGENTS: usize = 20;

/// The most team moves of a run.
const MOST: u32 = 20_000;

/// Agents of a scheme that can be measured.
trait Crew {
    /// A measurement from these starts.
    fn cost(&self, group: &mut Group<'_>, name: &str, layout: &Layout, starts: &[Cell]) -> Cost<Work>;
}

const SCHEMES: [(&str, &dyn Crew); 7] = [
    ("bricks", &bricks::Rule::REPAIRED),
    ("bricks-ants", &bricks::Rule::ROBUST),
    ("ants", &ants::Rule::Repaired),
    ("bricks (tree)", &tree::Rule::TREE),
    ("helpers", &tree::Rule::ROBUST),
    ("helpers (trusting)", &tree::Rule::HELPERS),
    ("mdfs", &Mdfs),
];

const LAYOUTS: [&str; 4] = ["office:30x30:4x4", "open:30x30", "office:512x512:16x16", "open:512x512"];

impl<S: Scheme> Crew for S {
    /// A team of ants and one that marks cells as visited are both followed to the end of exploration; the latter until
    /// all agents are done.
    fn cost(&self, group: &mut Group<'_>, name: &str, layout: &Layout, starts: &[Cell]) -> Cost<Work> {
        let start = Agents::new(*self, layout, starts, Probability::NEVER, 0);
        measure(group, BenchmarkId::from_parameter(name), || {
            let (mut team, mut work) = (start.clone(), Work::default());
            while work.team_moves < MOST && !team.is_over() {
                work.team_moves += 1;
                work.agent_steps += u32::from(team.whole().active);
                team.advance();
            }
            work
        })
    }
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut rows = Vec::new();
    for described in LAYOUTS {
        let generator: Generator = described.parse().expect("a generator");
        let layout = generator.generate(0).expect("a layout");
        let starts = vec![layout.default_base().expect("a free cell"); AGENTS];
        let mut group = group(&mut criterion, described);
        for (scheme, crew) in SCHEMES {
            rows.push((described, scheme, crew.cost(&mut group, scheme, &layout, &starts)));
        }
    }
    criterion.final_summary();

    println!("\nAgent steps a second, and over those of bricks, {AGENTS} agents, at most {MOST} team moves");
    let mut bricks = 1.0;
    for (described, scheme, cost) in rows {
        let seconds = 1e-6 * cost.micros * f64::from(cost.work.team_moves);
        let millions = 1e-6 * f64::from(cost.work.agent_steps) / seconds;
        if scheme == "bricks" {
            bricks = millions;
        }
        println!(
            "  {described:22} {scheme:18} {:>8} steps {millions:>7.2} million/s {:>6.2}",
            cost.work.agent_steps,
            millions / bricks
        );
    }
}
