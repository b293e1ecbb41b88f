//! How far the chain, which meets its walls on the way, is from a team that knows them: team moves until the last
//! chain-reachable cell is explored, against the fewest in which that can be done, in all layouts of small areas.
//! Layouts that a symmetry of the square makes of one another have one optimum, so it is solved once for them; the
//! chain, whose order of directions has no such symmetry, runs in each. The counts are whole numbers, so that the
//! result is the same on any number of threads.

mod area;
mod sums;

use self::area::{Area, WallSet, solve};
use self::sums::Sums;
pub use self::sums::{Line, Worst};
use super::prelude::*;
use tautline_io::text_blocks::{Block, beside};
use tautline_sim::draw;
use tautline_sim::explore::{RuleName, Setup, Survey, explore};

/// The table.
#[derive(Clone, Copy, Debug)]
pub struct Optimum;

settings! {
    /// How far it goes.
    #[derive(Copy, Eq)]
    pub struct Settings {
        /// Most walls of a layout of three robots; one more takes ten times as long
        pub max_walls: u32 = 4, one("max-walls", "WALLS", from_to(0..=6));
    }
}

/// A team, and the layouts of its area that it is measured in: (2N−1)² cells, the base in the middle.
#[derive(Clone, Copy, PartialEq, Eq, Debug, JsonSchema, Serialize, Deserialize)]
pub struct Field {
    robots: u16,
    /// The fewest walls and the most.
    walls: [u32; 2],
}

impl Field {
    /// Two robots in all 4096 layouts.
    const TWO_ROBOTS: Self = Self { robots: 2, walls: [0, 12] };

    /// Three robots in all layouts with so many walls.
    const fn three_robots(walls: u32) -> Self {
        Self { robots: 3, walls: [walls, walls] }
    }
}

/// Layouts of a team: those together that are images of one another.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Job {
    field: Field,
    orbits: Vec<Vec<WallSet>>,
}

/// Orbits of one job: so few that all threads end at about the same time, and so many that their results take little
/// room.
const ORBITS: usize = 16;

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    /// Field by field, each under every rule.
    pub lines: Vec<Line>,
}

impl Settings {
    fn fields(self) -> impl Iterator<Item = Field> {
        std::iter::once(Field::TWO_ROBOTS).chain((0..=self.max_walls).map(Field::three_robots))
    }
}

impl Table for Optimum {
    type Settings = Settings;
    type Job = Job;
    type Sample = [Sums; RuleName::ALL.len()];
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "optimum",
            shows: "the chain against the fewest team moves of a team that knows the walls, in all \
                    layouts of small areas: how often it takes as few, how many times as many on \
                    average and at worst, and what it misses",
            help: "How far the chain is from the fewest team moves of a team that knows the walls",
            more: "Two robots in all layouts of 3×3 cells, three in those of 5×5 cells with few walls.",
            examples: &["optimum", "optimum --max-walls 2 --format json"],
            doing: "solving",
            takes: "some seconds",
            ..Description::NOTHING
        }
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        let mut jobs = Vec::new();
        for field in settings.fields() {
            let area = Area::new(field.robots)?;
            let orbits: Vec<Vec<WallSet>> =
                (field.walls[0]..=field.walls[1]).flat_map(|walls| area.orbits(walls)).collect();
            jobs.extend(orbits.chunks(ORBITS).map(|orbits| Job { field, orbits: orbits.into() }));
        }
        Ok(jobs)
    }

    fn parts(&self, job: &Job) -> u64 {
        job.orbits.iter().map(|orbit| orbit.len() as u64).sum()
    }

    fn measure(&self, _: &Settings, job: &Job, _: &dyn Observer) -> Result<Self::Sample, Halt> {
        let area = Area::new(job.field.robots)?;
        let mut sums = Self::Sample::default();
        for orbit in &job.orbits {
            sums::compare(&area, orbit, &mut sums)?;
        }
        Ok(sums)
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let mut results = results.into_iter().peekable();
        let mut lines = Vec::new();
        for field in settings.fields() {
            let mut all = Self::Sample::default();
            while let Some((_, sums)) = results.next_if(|(job, _)| job.field == field) {
                for (all, sums) in all.iter_mut().zip(sums) {
                    all.add(sums);
                }
            }
            let area = Area::new(field.robots)?;
            let rules = RuleName::ALL.into_iter().zip(&all);
            lines.extend(rules.map(|(rule, sums)| sums.line(&area, field.walls, rule)));
        }
        Ok(Summary { lines })
    }

    fn text(&self, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        let walls = |line: &Line| match line.walls {
            [fewest, most] if fewest == most => most.to_string(),
            [fewest, most] => format!("{fewest}…{most}"),
        };
        // The heading of the rules is as wide as the longer of them; the shorter one pulls on what follows it.
        let columns = Columns::of(&merged.lines)
            .left("robots", |line| line.robots)
            .left("walls", walls)
            .left("rule     ", |line| line.rule)
            .right("layouts", |line| line.layouts)
            .right("walled in", |line| line.walled_in)
            .right("missed", |line| line.missed)
            .right("beyond", |line| line.beyond)
            .right("below", |line| line.below)
            .right("optimal", |line| line.optimal)
            .number("mean", 2, |line| line.mean)
            .left("worst", |line| line.worst.as_ref().map_or("-".to_owned(), Worst::ratio));
        let mut text = format!(
            "Team moves until the last chain-reachable cell is explored, by the \
             fewest of a team that knows the walls,\n\
             in all layouts of (2N−1)² cells with so many walls\n\n{}\n\
             walled in: nothing to explore · missed: the chain leaves a \
             chain-reachable cell unexplored; not compared ·\n\
             beyond: it explores one that is not chain-reachable · below, optimal: it takes fewer, as few\n",
            columns.text()
        );
        for robots in [2, 3] {
            let lines = merged.lines.iter().filter(|line| line.robots == robots);
            let lines = lines.filter(|line| line.rule == RuleName::Repaired);
            let worst = lines.filter_map(|line| Some((line, line.worst.as_ref()?)));
            let worst = worst.reduce(|one, other| if other.1.is_worse(one.1) { other } else { one });
            if let Some((line, worst)) = worst {
                text.push_str(&drawing(line, worst)?);
            }
        }
        Ok(text)
    }

    fn is_broken(&self, merged: &Summary) -> bool {
        merged.lines.iter().any(|line| line.below > 0)
    }
}

/// When each cell is explored, by the chain and in the optimum.
fn drawing(line: &Line, worst: &Worst) -> Result<String, Halt> {
    let (setup, charts) = surveys(line, worst)?;
    let titles = [format!("chain: {}", worst.chain), format!("optimum: {}", worst.optimum)];
    let lines = charts.map(|chart| draw::order(&setup, &chart).lines().map(str::to_owned).collect());
    let blocks: Vec<Block> =
        titles.into_iter().zip(lines).map(|(title, lines)| Block { title, lines }).collect();
    let title = format!("The worst for {} robots ({}): when each cell is explored", line.robots, line.rule);
    Ok(format!("\n{title}\n\n{}", beside(blocks)))
}

/// The run of the chain in the layout of `worst`, and when each cell is explored in it and in the optimum.
fn surveys(line: &Line, worst: &Worst) -> Result<(Setup, [Survey; 2]), Halt> {
    let area = Area::new(line.robots)?;
    let setup = area.setup(line.rule, worst.layout.clone());
    let report = explore(&setup, &mut |_| Ok(()))?;
    let (ground, goals) = area.goals(&worst.layout)?;
    let optimum = solve(&ground, &goals)?;
    let charted = Survey::of(ground.area(), optimum.configurations.iter().map(Vec::as_slice));
    Ok((setup, [report.chart, charted]))
}

#[cfg(test)]
mod tests {
    use tautline_kernel::ground::{Cell, Edge, Side};
    use tautline_proofs::chain::optimum::{Guide, explore_all};

    use super::area::{MOST_STATES, WallSet};
    use super::*;
    use tautline_sim::explore::chain::REEL;

    /// The number of sets of so many walls, among those of a team's area.
    fn layouts(field: Field) -> u64 {
        let side = 2 * u64::from(field.robots) - 1;
        let edges = 2 * side * (side - 1);
        let of = |walls: u32| {
            (0..u64::from(walls)).fold(1, |sets, less| sets * edges.saturating_sub(less) / (less + 1))
        };
        (field.walls[0]..=field.walls[1]).map(of).sum()
    }

    #[test]
    fn every_layout_is_in_one_orbit() {
        for field in [Field::TWO_ROBOTS, Field::three_robots(3)] {
            let area = Area::new(field.robots).map_err(|_| ()).expect("an area");
            let walls = field.walls[0]..=field.walls[1];
            let mut all: Vec<WallSet> = walls.flat_map(|walls| area.orbits(walls)).flatten().collect();
            assert_eq!(all.len() as u64, layouts(field));
            all.sort_unstable();
            all.dedup();
            assert_eq!(all.len() as u64, layouts(field));
        }
        assert_eq!(layouts(Field::TWO_ROBOTS), 4096);
        assert_eq!(layouts(Field::three_robots(4)), 91_390);
    }

    #[test]
    fn images_have_one_optimum_and_both_rules_the_same() {
        let area = Area::new(3).map_err(|_| ()).expect("an area");
        for orbit in area.orbits(3).step_by(97) {
            let optima: Vec<u32> = orbit
                .iter()
                .flat_map(|&walls| {
                    let (ground, goals) = area.goals(&area.layout(walls)).map_err(|_| ()).expect("a ground");
                    RuleName::ALL.map(|rule| {
                        assert_eq!(ground.reachable(&rule.observed().rule).expect("a small ground"), goals);
                        let solved = explore_all(
                            &ground,
                            &rule.observed().rule,
                            &goals,
                            Guide::Distances,
                            MOST_STATES,
                        );
                        solved.expect("a small ground").moves()
                    })
                })
                .collect();
            assert!(optima.iter().all(|&moves| moves == optima[0]), "{orbit:?}: {optima:?}");
        }
    }

    /// The mean 1.50 and the worst 5.06 are the repaired rule's.
    #[test]
    #[ignore = "91,390 layouts take minutes"]
    fn with_four_walls_the_reel_takes_at_most_1_4_times_the_optimum_in_the_mean_and_3_times_at_worst() {
        let area = Area::new(3).map_err(|_| ()).expect("an area");
        let (mut ratios, mut missed) = (Vec::new(), 0);
        for orbit in area.orbits(4) {
            let mut optimum = None;
            for walls in orbit {
                let layout = area.layout(walls);
                let (ground, goals) = area.goals(&layout).map_err(|_| ()).expect("a ground");
                let least = *optimum
                    .get_or_insert_with(|| solve(&ground, &goals).map_err(|_| ()).expect("solved").moves());
                let setup = Setup { rule: REEL, ..area.setup(RuleName::Repaired, layout) };
                let report = explore(&setup, &mut |_| Ok(())).map_err(|_| ()).expect("a run");
                let mut steps = goals.iter().map(|cell| report.chart.step(cell));
                match steps.try_fold(0, |last, step| Some(last.max(step?))) {
                    Some(last) if least > 0 => ratios.push(f64::from(last) / f64::from(least)),
                    Some(_) => {}
                    None => missed += 1,
                }
            }
        }
        let mean = ratios.iter().sum::<f64>() / f64::from(ratios.len() as u32);
        let worst = ratios.iter().copied().fold(0.0, f64::max);
        println!("mean {mean:.3}, worst {worst:.3}, {} layouts, {missed} missed", ratios.len());
        assert!(mean <= 1.40 && worst <= 3.0, "mean {mean:.3}, worst {worst:.3}");
    }

    #[test]
    fn a_layout_counts_once_as_walled_in_missed_or_compared_and_besides_as_beyond() {
        let area = Area::new(2).map_err(|_| ()).expect("an area");
        let (base, corner) = (Cell::new(1, 1), Cell::new(0, 0));
        let mut layout = area.layout(0);
        for side in [Side::East, Side::South] {
            layout.build_wall(Edge::new(corner, side));
        }
        let (ground, goals) = area.goals(&layout).map_err(|_| ()).expect("a ground");
        let chart = |cells: &[Cell]| {
            let teams: Vec<[Cell; 2]> = cells.iter().map(|&cell| [base, cell]).collect();
            Survey::of(ground.area(), teams.iter().map(|team| &team[..]))
        };
        let all: Vec<Cell> = goals.iter().collect();
        assert!(!goals.contains(corner) && all.len() > 2);
        let mut sums = Sums::default();
        sums.count(0, 0, &goals, &chart(&all));
        sums.count(1, 2, &goals, &chart(&all[..all.len() - 1]));
        sums.count(3, 2, &goals, &chart(&[&all[..], &[corner]].concat()));
        sums.count(7, 2, &goals, &chart(&all));
        let line = sums.line(&area, [0, 3], RuleName::Repaired);
        let counts = [line.layouts, line.walled_in, line.missed, line.beyond, line.compared];
        assert_eq!(counts, [4, 1, 1, 1, 2]);
        // Of the two that are as bad, the one with fewer walls is drawn.
        assert_eq!(line.worst.map(|worst| worst.layout.walls().count()), Some(2));
    }

    #[test]
    fn a_blocked_follower_lets_the_leader_into_a_cell_that_is_not_chain_reachable() {
        let area = Area::new(3).map_err(|_| ()).expect("an area");
        let mut layout = area.layout(0);
        for x in 1..=3 {
            layout.build_wall(Edge::new(Cell::new(x, 1), Side::South));
        }
        let (_, goals) = area.goals(&layout).map_err(|_| ()).expect("a ground");
        let beyond = Cell::new(2, 0);
        assert!(!goals.contains(beyond));
        for rule in RuleName::ALL {
            let setup = area.setup(rule, layout.clone());
            let report = explore(&setup, &mut |_| Ok(())).map_err(|_| ()).expect("a run");
            assert!(report.chart.step(beyond).is_some() && report.violations.is_empty(), "{rule}");
        }
    }
}
