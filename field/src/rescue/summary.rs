//! Many rescues of one setting, seed by seed: means with their intervals, what became of the WFRs, and which clauses
//! were broken.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use schemars::JsonSchema;
use serde::Serialize;
use tautline_io::diagnostic::{Diagnostic, Halt, Watch};
use tautline_proofs::engine::SeededOracle;
use tautline_proofs::mrc::Demand;

use super::{Event, Fate, LogEntry, Ordinal, Report, Setting, Violation, rescue};
use crate::campaign;
use crate::stats::{Estimate, rounded};

/// The outcome of many rescues.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    /// The share of all nodes that the first call for an event reaches, the WFR included.
    pub reach: Estimate,
    /// The share of the nodes that live when the call goes out and that links connect with the WFR, over such nodes.
    pub reach_component: Estimate,
    /// Nodes that forward a first call, the WFR not included.
    pub rebroadcasts: Estimate,
    /// The fates of the events at the WFRs, counted over all rescues.
    pub assignments: Assignments,
    /// When robots failed, counted over all rescues.
    pub robots_failed: RobotFailures,
    /// RD: the sum of the distances that robots moved to WFRs over the sum of the shortest. None if nobody came.
    pub distance_ratio: Option<Estimate>,
    /// Seconds from the first call for an event to the first robot, of the events that were served: those of one rescue
    /// depend on each other, so that the interval is that of a ratio of sums over rescues. None if nobody came.
    pub wait_s: Option<Estimate>,
    /// Messages sent in a rescue.
    pub messages: Estimate,
    /// The clauses that were broken, in their order.
    pub violations: Vec<ClauseViolation>,
}

/// The fates of the events at the WFRs.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, JsonSchema, Serialize)]
pub struct Assignments {
    /// WFRs in all.
    pub wfrs: u32,
    /// Events in all. The following are counts of them.
    pub events: u32,
    /// One robot came.
    pub served_once: u32,
    /// Several robots came, or one several times.
    pub served_more_often: u32,
    /// Robots had heard of it, and none ever came, although one that lives is connected with the WFR.
    pub never: u32,
    /// No robot that lives and is connected has heard of it: the broadcast has not reached them.
    pub unheard: u32,
    /// Links connect no robot that lives with the WFR.
    pub cut_off: u32,
    /// It has not happened, since the one before was not served.
    pub still_to_come: u32,
}

/// When robots failed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, JsonSchema, Serialize)]
pub struct RobotFailures {
    /// While they had set out for a WFR and had not come.
    pub on_their_way: u32,
    /// Not on their way, and before a robot came to a WFR for the last time, if one ever did.
    pub not_on_their_way: u32,
    /// Not on their way, and after that.
    pub after_the_last_arrival: u32,
}

/// A clause that was broken.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct ClauseViolation {
    /// Its id.
    pub clause: &'static str,
    /// The violation, in words.
    #[serde(skip)]
    pub broken: &'static str,
    /// In how many rescues.
    pub rescues: u32,
    /// The first of their seeds.
    pub seed: u64,
    /// When it was broken there, in seconds from the beginning.
    pub at_s: f64,
    /// Of which WFR.
    pub wfr: Ordinal,
    /// During which of its events.
    pub event: Ordinal,
}

/// The part of a rescue's outcome that is kept.
struct RescueSample {
    seed: u64,
    reach: f64,
    reach_component: f64,
    rebroadcasts: f64,
    wfrs: u32,
    fates: Vec<Fate>,
    robots_failed: RobotFailures,
    moved_m: f64,
    shortest_m: f64,
    /// The sum of the waits of those that were served, and how many they are.
    waits_s: (f64, f64),
    messages: f64,
    violations: Vec<Violation>,
}

/// Of nanoseconds.
#[expect(clippy::cast_precision_loss, reason = "no rescue takes 2⁵³ nanoseconds, a hundred days")]
pub fn seconds(nanoseconds: u64) -> f64 {
    nanoseconds as f64 / 1e9
}

impl RescueSample {
    fn of(seed: u64, nodes: usize, report: &Report) -> Self {
        let mean = |part: &dyn Fn(&super::Spread) -> f64| {
            report.spreads.iter().map(part).sum::<f64>() / f64::from(report.spreads.len() as u32)
        };
        // Where there is no way round the obstacles nobody comes.
        let ways = report.journeys.iter().filter_map(|journey| Some((journey.moved_m, journey.shortest_m?)));
        let (moved_m, shortest_m) = ways.fold((0.0, 0.0), |sums, way| (sums.0 + way.0, sums.1 + way.1));
        let waits = report.journeys.iter().map(|journey| seconds(journey.waited_ns));
        Self {
            seed,
            reach: mean(&|spread| f64::from(spread.reached) / f64::from(nodes as u32)),
            reach_component: mean(&|spread| f64::from(spread.reached) / f64::from(spread.component)),
            rebroadcasts: mean(&|spread| f64::from(spread.rebroadcasts)),
            wfrs: report.wfrs.len() as u32,
            fates: report.fates.clone(),
            robots_failed: RobotFailures::of(&report.log),
            moved_m,
            shortest_m,
            waits_s: (waits.sum(), f64::from(report.journeys.len() as u32)),
            messages: f64::from(u32::try_from(report.air.sent).unwrap_or(u32::MAX)),
            violations: report.violations.clone(),
        }
    }
}

impl Summary {
    /// The rescues of `setting` with these seeds, and how many they are: all, or the first ones if `watch`, which is
    /// called before each, ends the work. The result is the same on any number of threads.
    ///
    /// # Errors
    /// [`Halt`], as `watch` returned it before the first rescue, or if the setting makes no rescue.
    pub fn measure(
        setting: &Setting,
        seeds: RangeInclusive<u64>,
        watch: &Watch<'_>,
    ) -> Result<(Self, u64), Halt> {
        // What is wrong with all is to be the same fault each time, not that of whichever thread is first.
        setting.lay_out(&mut SeededOracle::new(*seeds.start(), 0)).map_err(Diagnostic::from)?;
        let one = |seed: u64| {
            watch()?;
            let report = rescue(setting, seed).map_err(Diagnostic::from)?;
            Ok(RescueSample::of(seed, setting.nodes, &report))
        };
        let kept = campaign::first(seeds, one)?;
        Ok((Self::over(&kept), kept.len() as u64))
    }

    /// That of one rescue alone.
    pub fn of(setting: &Setting, seed: u64, report: &Report) -> Self {
        Self::over(&[RescueSample::of(seed, setting.nodes, report)])
    }

    fn over(kept: &[RescueSample]) -> Self {
        let mean = |part: &dyn Fn(&RescueSample) -> f64| {
            Estimate::of_values(&kept.iter().map(part).collect::<Vec<_>>()).unwrap_or(Estimate::NOTHING)
        };
        let ratio = |pair: &dyn Fn(&RescueSample) -> (f64, f64)| {
            let pairs: Vec<(f64, f64)> = kept.iter().map(pair).filter(|&(_, under)| under > 0.0).collect();
            Estimate::of_ratio(&pairs)
        };
        let broken = |demand: Demand| {
            let found = |one: &RescueSample| {
                let violation = one.violations.iter().find(|violation| violation.demand == demand)?;
                Some((one.seed, *violation))
            };
            let mut all = kept.iter().filter_map(found);
            let (seed, Violation { at_ns, wfr, event, .. }) = all.next()?;
            let rescues = 1 + all.count() as u32;
            let (clause, broken) = (demand.clause(), demand.broken());
            let (wfr, event) = (Ordinal(wfr), Ordinal(event));
            Some(ClauseViolation { clause, broken, rescues, seed, at_s: seconds(at_ns), wfr, event })
        };
        Self {
            reach: rounded(mean(&|one| one.reach), 1e4),
            reach_component: rounded(mean(&|one| one.reach_component), 1e4),
            rebroadcasts: rounded(mean(&|one| one.rebroadcasts), 1e2),
            assignments: kept.iter().fold(Assignments::default(), Assignments::and),
            robots_failed: kept.iter().fold(RobotFailures::default(), RobotFailures::and),
            distance_ratio: ratio(&|one| (one.moved_m, one.shortest_m)).map(|ratio| rounded(ratio, 1e4)),
            wait_s: ratio(&|one| one.waits_s).map(|wait| rounded(wait, 1e2)),
            messages: rounded(mean(&|one| one.messages), 1e2),
            violations: Demand::ALL.into_iter().filter_map(broken).collect(),
        }
    }
}

impl RobotFailures {
    fn of(log: &[LogEntry]) -> Self {
        let arrives = |logged: &LogEntry| matches!(logged.event, Event::Arrives { .. });
        let last = log.iter().rposition(arrives);
        let mut failed = Self::default();
        let mut on_their_way = BTreeSet::new();
        for (place, logged) in log.iter().enumerate() {
            match logged.event {
                Event::SetsOut { robot, .. } => {
                    on_their_way.insert(robot);
                }
                Event::Arrives { robot, .. } | Event::LetsGo { robot, .. } => {
                    on_their_way.remove(&robot);
                }
                Event::RobotFails { robot, .. } if on_their_way.contains(&robot) => failed.on_their_way += 1,
                Event::RobotFails { .. } if last.is_some_and(|last| last < place) => {
                    failed.after_the_last_arrival += 1;
                }
                Event::RobotFails { .. } => failed.not_on_their_way += 1,
                Event::Recurs { .. }
                | Event::Calls { .. }
                | Event::Hears { .. }
                | Event::Asks { .. }
                | Event::Chooses { .. }
                | Event::CountsOn { .. }
                | Event::Declines { .. }
                | Event::Passes { .. }
                | Event::LosesItsWay { .. }
                | Event::NodeFails { .. } => {}
            }
        }
        failed
    }

    const fn and(mut self, one: &RescueSample) -> Self {
        let Self { on_their_way, not_on_their_way, after_the_last_arrival } = one.robots_failed;
        self.on_their_way += on_their_way;
        self.not_on_their_way += not_on_their_way;
        self.after_the_last_arrival += after_the_last_arrival;
        self
    }
}

impl Assignments {
    fn and(mut self, one: &RescueSample) -> Self {
        self.wfrs += one.wfrs;
        for fate in &one.fates {
            self.events += 1;
            match fate {
                Fate::Served { visits: 0 | 1, .. } => self.served_once += 1,
                Fate::Served { .. } => self.served_more_often += 1,
                Fate::Abandoned => self.never += 1,
                Fate::Unheard => self.unheard += 1,
                Fate::CutOff => self.cut_off += 1,
                Fate::StillToCome => self.still_to_come += 1,
            }
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept(seed: u64, fates: &[Fate], (moved_m, shortest_m): (f64, f64)) -> RescueSample {
        let violation = Violation { demand: Demand::IsServed, at_ns: 1_500_000_000 * seed, wfr: 1, event: 2 };
        RescueSample {
            seed,
            reach: 0.5,
            reach_component: 1.0,
            rebroadcasts: 10.0,
            wfrs: 2,
            fates: fates.to_vec(),
            robots_failed: RobotFailures::default(),
            moved_m,
            shortest_m,
            waits_s: (0.0, 0.0),
            messages: 7.0,
            violations: if seed > 1 { vec![violation] } else { vec![] },
        }
    }

    #[test]
    fn a_robot_fails_on_its_way_or_not_or_when_all_is_over() {
        let at = [0, 0];
        let wfr = Ordinal(0);
        let sets_out = |robot| Event::SetsOut { robot: Ordinal(robot), wfr, epoch: 1, at };
        let arrives = |robot| Event::Arrives { robot: Ordinal(robot), wfr, at };
        let lets_go = |robot| Event::LetsGo { robot: Ordinal(robot), wfr, epoch: 1, at };
        let fails = |robot| Event::RobotFails { robot: Ordinal(robot), at };
        let counted = |events: &[Event]| {
            let log: Vec<LogEntry> =
                (0..).zip(events).map(|(at_ns, &event)| LogEntry { at_ns, event }).collect();
            let RobotFailures { on_their_way, not_on_their_way, after_the_last_arrival } =
                RobotFailures::of(&log);
            [on_their_way, not_on_their_way, after_the_last_arrival]
        };
        assert_eq!(counted(&[sets_out(1), fails(1), sets_out(2), arrives(2)]), [1, 0, 0]);
        assert_eq!(counted(&[sets_out(1), fails(2), arrives(1)]), [0, 1, 0]);
        assert_eq!(counted(&[sets_out(1), lets_go(1), fails(1), arrives(2)]), [0, 1, 0]);
        assert_eq!(counted(&[sets_out(1), arrives(1), fails(1), fails(2)]), [0, 0, 2]);
        assert_eq!(counted(&[sets_out(1), sets_out(2), arrives(1), fails(2)]), [1, 0, 0]);
        assert_eq!(counted(&[fails(1)]), [0, 1, 0]);
    }

    #[test]
    fn fates_are_counted_and_ratios_are_those_of_sums() {
        let once = Fate::Served { by: 0, visits: 1 };
        let twice = Fate::Served { by: 0, visits: 2 };
        let all = [
            kept(1, &[once, twice], (110.0, 100.0)),
            kept(2, &[once, Fate::Abandoned], (60.0, 50.0)),
            kept(3, &[Fate::CutOff, Fate::Unheard], (0.0, 0.0)),
            kept(4, &[once, once, once, Fate::StillToCome], (13.0, 10.0)),
        ];
        let summary = Summary::over(&all);
        let assignments = Assignments {
            wfrs: 8,
            events: 10,
            served_once: 5,
            served_more_often: 1,
            never: 1,
            unheard: 1,
            cut_off: 1,
            still_to_come: 1,
        };
        assert_eq!(summary.assignments, assignments);
        let ratio = summary.distance_ratio.expect("a ratio");
        assert_eq!((ratio.count, ratio.mean), (3, 1.1438), "183 m over 160 m");
        assert!(ratio.interval.is_some_and(|[low, high]| low < 1.1438 && 1.1438 < high));
        let words = Demand::IsServed.broken();
        let first = ClauseViolation {
            clause: "MRC-5",
            broken: words,
            rescues: 3,
            seed: 2,
            at_s: 3.0,
            wfr: Ordinal(1),
            event: Ordinal(2),
        };
        assert_eq!(summary.violations, [first]);
        assert_eq!((summary.reach.mean, summary.wait_s), (0.5, None));
        assert_eq!(Summary::over(&all[2..3]).distance_ratio, None);
    }
}
