//! Layouts counted by what the chain and the optimum take in them, and the lines that come of it.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use serde::{Deserializer, Serializer};
use tautline_proofs::chain::reach::CellSet;

use super::super::prelude::*;
use super::area::{Area, WallSet, solve};
use tautline_sim::explore::{RuleName, Survey, explore};

/// One rule in the layouts of one team with some numbers of walls.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// Robots, base included.
    pub robots: u16,
    /// The fewest walls and the most.
    pub walls: [u32; 2],
    /// As published or repaired.
    pub rule: RuleName,
    /// How many layouts.
    pub layouts: u64,
    /// Those in which no cell but the base can be reached: there is nothing to compare.
    pub walled_in: u64,
    /// Those in which the chain leaves a chain-reachable cell unexplored: they are not compared.
    pub missed: u64,
    /// Those in which the chain explores a cell that is not chain-reachable.
    pub beyond: u64,
    /// Those that are compared.
    pub compared: u64,
    /// Of those compared: the chain takes fewer team moves than the optimum. There must be none.
    pub below: u64,
    /// Of those compared: the chain takes as few.
    pub optimal: u64,
    /// The mean of the chain's team moves by the optimum, over those compared.
    pub mean: Option<f64>,
    /// The layout in which it is largest: of several, one with the fewest walls.
    pub worst: Option<Worst>,
}

/// The layout in which the chain is farthest from the optimum.
#[derive(Clone, PartialEq, Eq, Debug, JsonSchema, Serialize)]
pub struct Worst {
    /// The chain's team moves.
    pub chain: u32,
    /// The optimum.
    pub optimum: u32,
    /// The layout, with the base.
    #[serde(serialize_with = "as_drawing")]
    #[schemars(with = "String")]
    pub layout: Layout,
}

fn as_drawing<S: Serializer>(layout: &Layout, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(layout)
}

impl Worst {
    pub(super) const fn is_worse(&self, than: &Self) -> bool {
        self.chain * than.optimum > than.chain * self.optimum
    }

    pub(super) fn ratio(&self) -> String {
        let Self { chain, optimum, layout: _ } = self;
        format!("{chain}/{optimum} = {:.2}", f64::from(*chain) / f64::from(*optimum))
    }
}

/// Sums over layouts.
#[derive(Clone, Default, Debug, Serialize, Deserialize)]
pub struct Sums {
    layouts: u64,
    walled_in: u64,
    missed: u64,
    beyond: u64,
    #[serde(serialize_with = "as_list", deserialize_with = "of_list")]
    compared: Comparison,
}

/// By team moves of the chain and of the optimum: how many layouts, and the first by number of walls.
type Comparison = BTreeMap<(u32, u32), (u64, (u32, WallSet))>;

/// Maps in JSON have words for keys; these are numbers.
fn as_list<S: Serializer>(map: &Comparison, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(map)
}

fn of_list<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Comparison, D::Error> {
    Ok(Vec::deserialize(deserializer)?.into_iter().collect())
}

impl Sums {
    pub(super) fn count(&mut self, walls: WallSet, optimum: u32, goals: &CellSet, chart: &Survey) {
        self.layouts += 1;
        let is_beyond = |cell| chart.step(cell).is_some() && !goals.contains(cell);
        self.beyond += u64::from(chart.area().cells().any(is_beyond));
        let last = goals.iter().map(|goal| chart.step(goal)).try_fold(0, |last, step| Some(step?.max(last)));
        match last {
            _ if optimum == 0 => self.walled_in += 1,
            None => self.missed += 1,
            Some(last) => self.pair((last, optimum), 1, (walls.count_ones(), walls)),
        }
    }

    fn pair(&mut self, moves: (u32, u32), layouts: u64, first: (u32, WallSet)) {
        let known = self.compared.entry(moves).or_insert((0, first));
        *known = (known.0 + layouts, known.1.min(first));
    }

    pub(super) fn add(&mut self, other: Self) {
        let Self { layouts, walled_in, missed, beyond, compared } = other;
        self.layouts += layouts;
        self.walled_in += walled_in;
        self.missed += missed;
        self.beyond += beyond;
        for (moves, (layouts, first)) in compared {
            self.pair(moves, layouts, first);
        }
    }

    /// The layouts compared whose team moves are as `is_such` says.
    fn layouts(&self, is_such: impl Fn(u32, u32) -> bool) -> u64 {
        let such = self.compared.iter().filter(|&(&(chain, optimum), _)| is_such(chain, optimum));
        such.map(|(_, &(layouts, _))| layouts).sum()
    }

    /// The mean is summed in the order of team moves, so that it rounds alike on every machine.
    #[expect(clippy::cast_precision_loss, reason = "the counts stay far below 2⁵³")]
    pub(super) fn line(&self, area: &Area, walls: [u32; 2], rule: RuleName) -> Line {
        let compared = self.layouts(|_, _| true);
        let ratios = self
            .compared
            .iter()
            .map(|(&(chain, optimum), &(layouts, _))| layouts as f64 * f64::from(chain) / f64::from(optimum));
        let mean = ratios.sum::<f64>() / compared as f64;
        let worst = self.compared.iter().min_by(|(one, (_, one_first)), (other, (_, other_first))| {
            let ratios = (one.0 * other.1, other.0 * one.1);
            Reverse(ratios.0).cmp(&Reverse(ratios.1)).then(one_first.cmp(other_first))
        });
        Line {
            robots: area.robots,
            walls,
            rule,
            layouts: self.layouts,
            walled_in: self.walled_in,
            missed: self.missed,
            beyond: self.beyond,
            compared,
            below: self.layouts(|chain, optimum| chain < optimum),
            optimal: self.layouts(|chain, optimum| chain == optimum),
            mean: (compared > 0).then(|| hundredths(mean)),
            worst: worst.map(|(&(chain, optimum), &(_, (_, walls)))| Worst {
                chain,
                optimum,
                layout: area.layout(walls),
            }),
        }
    }
}

/// Runs the chain under both rules in layouts of `area` that have one optimum.
pub(super) fn compare(
    area: &Area,
    orbit: &[WallSet],
    sums: &mut [Sums; RuleName::ALL.len()],
) -> Result<(), Halt> {
    let mut optimum = None;
    for &walls in orbit {
        let layout = area.layout(walls);
        let (ground, goals) = area.goals(&layout)?;
        let optimum = match optimum {
            Some(optimum) => optimum,
            None => *optimum.insert(solve(&ground, &goals)?.moves()),
        };
        for (rule, sums) in RuleName::ALL.into_iter().zip(&mut *sums) {
            let report = explore(&area.setup(rule, layout.clone()), &mut |_| Ok(()))?;
            sums.count(walls, optimum, &goals, &report.chart);
        }
    }
    Ok(())
}
