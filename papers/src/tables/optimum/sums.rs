//! Layouts counted by what the chain and the optimum take in them.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use tautline_proofs::chain::reach::CellSet;

use super::super::prelude::*;
use super::area::{Area, WallSet, solve};
use super::{Line, Worst};
use tautline_sim::explore::{RuleName, Survey, explore};

/// Sums over layouts.
#[derive(Clone, Default, Debug, Serialize, Deserialize)]
pub struct Sums {
    layouts: u64,
    walled_in: u64,
    missed: u64,
    beyond: u64,
    #[serde(with = "as_list")]
    compared: Comparison,
}

/// By team moves of the chain and of the optimum: how many layouts, and the first by number of walls.
type Comparison = BTreeMap<(u32, u32), (u64, (u32, WallSet))>;

/// Maps in JSON have words for keys; these are numbers.
mod as_list {
    use serde::{Deserialize, Deserializer, Serializer};

    use super::Comparison;

    pub(super) fn serialize<S: Serializer>(map: &Comparison, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(map)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Comparison, D::Error> {
        Ok(Vec::deserialize(deserializer)?.into_iter().collect())
    }
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
