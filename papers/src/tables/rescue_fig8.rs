//! Figure 8 of [Jiang 2011]: three robots come to three WFRs. The paper draws the ways in one network, and says that
//! robots reach the WFRs “for all simulated scenarios” (4.3) and that each WFR gets “one nearby” robot (abstract).
//! Ours: how often that is so in many networks, under MRC as published and repaired, without any fault, and how much
//! farther the robots have to go than under the best of all assignments; whether the robot that comes is the nearest by
//! hops (1), and how many targets are served at once (4.3). Both rules have the same networks.

mod choice;

use self::choice::Choices;
use tautline_kernel::notice::Scheme;

use super::notice_fig5::{RANGE_M, SIDE_M};
use super::prelude::*;
use tautline_field::draw::field::picture;
use tautline_field::draw::rescue::map;
use tautline_field::radio::{ChannelName, FREE_SPACE, Point};
use tautline_field::rescue::{CallTimes, Fate, Problem, Report, SchemeName, rescue};
use tautline_field::tan::shortest_m;
use tautline_io::value_parser::within;
use tautline_sim::explore::RuleName;

/// The robots of the figure.
const ROBOTS: usize = 3;

/// The WFRs of the figure.
const WFRS: usize = 3;

/// Nodes, which the paper does not tell: the middle of its range.
const NODES: usize = 700;

/// The share that is usual: the paper has no number.
const USUALLY: f64 = 0.5;

/// The most robots and WFRs: all assignments are tried.
const MOST: u64 = 6;

/// The paper's share of the topologies: all are served, each by a robot of its own.
const PAPER: f64 = 1.0;

/// Figure 8.
#[derive(Clone, Copy, Debug)]
pub struct RescueFig8;

settings! {
    /// The settings of the figure.
    #[derive(Eq)]
    pub struct Settings {
        /// Nodes
        pub nodes: usize = NODES, one("nodes", "N", whole);
        /// Robots
        pub robots: usize = ROBOTS, one("robots", "N", |text| within(text, &(1..=MOST)));
        /// WFRs
        pub wfrs: usize = WFRS, one("wfr", "N", |text| within(text, &(1..=MOST)));
        /// The k of k-FNF
        pub k: Senders = Senders::ONE, one("k", "K", Senders::read);
        /// Topologies
        pub topologies: u32 = 200, one("runs", "COUNT", from_to(1..=100_000));
        /// The seed of the first topology; the others follow
        pub seed: u64 = 0, one("seed", "SEED", number);
    }
}

/// One topology under one rule.
type Job = Run<RuleName>;

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    #[serde(flatten)]
    settings: Settings,
    /// Rule by rule.
    pub rules: Vec<Line>,
}

/// One rule.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// MRC as published, or repaired.
    pub rule: RuleName,
    /// The share of the topologies in which each WFR was served once.
    pub served: Comparison,
    /// The share of the topologies in which each was served by a robot of its own.
    pub own: Comparison,
    /// RD: the distances moved over the shortest, of all who came.
    pub distance_ratio: Option<Estimate>,
    /// The shortest distances of the robots to the WFRs that they served, over those of the best assignment; of the
    /// topologies in which each WFR has a robot of its own.
    pub over_best: Option<Estimate>,
    /// The share of these in which the assignment is the best.
    pub best: Option<Estimate>,
    /// Seconds until the last WFR was served, where all were.
    pub last_s: Option<Estimate>,
    /// NOTICE packets of a topology.
    pub notices: Option<Estimate>,
    /// MRC's control packets of a topology: MOVE, RESB, the answers to them and receipts, hop by hop.
    pub control: Option<Estimate>,
    /// The share of the WFRs served to which a robot came that had the fewest hops of those not on their way when it
    /// was chosen.
    pub nearest_available: Option<Estimate>,
    /// The share of them to which one came that had the fewest hops of all robots at the first call.
    pub nearest: Option<Estimate>,
    /// The most WFRs of a topology to which robots are on their way at once.
    pub at_once: Option<Estimate>,
    /// Those to which they would be if each robot went to the WFR that it has the fewest hops from, by Reich's scheme.
    pub uncoordinated: Option<Estimate>,
    /// The former less the latter.
    pub gain: Option<Estimate>,
    /// The share of the topologies in which several robots would go to one WFR then.
    pub crowded: Option<Estimate>,
}

/// A share beside the paper's.
#[derive(Clone, Copy, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Comparison {
    /// The paper's.
    pub paper: f64,
    /// Ours.
    pub ours: Estimate,
    /// Ours less the paper's.
    pub difference: f64,
}

impl Comparison {
    fn of(samples: &[&Sample], is_such: impl Fn(&Sample) -> bool) -> Self {
        // So many decimals that one topology of all that there can be is told.
        let ours = rounded(share(samples, |sample| is_such(sample)).unwrap_or(Estimate::NOTHING), 1e6);
        Self { paper: PAPER, ours, difference: decimals(ours.mean - PAPER, 1e6) }
    }
}

/// The part of a topology's outcome that is kept.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Sample {
    is_served: bool,
    /// The distances moved, and the shortest.
    way_m: (f64, f64),
    /// The shortest distances of the assignment and of the best one, if each WFR has a robot of its own.
    assigned_m: Option<(f64, f64)>,
    last_s: Option<f64>,
    /// NOTICE and control packets.
    packets: (u32, u32),
    choices: Choices,
}

impl Settings {
    fn rescue(&self, rule: RuleName, seed: u64) -> Result<Report, Problem> {
        let setting = tautline_field::rescue::Setting {
            rule,
            scheme: SchemeName::KFnf,
            k: self.k.0.get(),
            nodes: self.nodes,
            area_m: [SIDE_M, SIDE_M],
            range_m: RANGE_M,
            obstacles_m: Vec::new(),
            wfrs: self.wfrs,
            wfrs_at: Vec::new(),
            robots: self.robots,
            robots_at_m: Vec::new(),
            events_per_wfr: 1,
            calls: CallTimes::Together,
            channel: ChannelName::Ideal,
            loss: 0.0,
            shadowing_db: 0.0,
            exponent: FREE_SPACE,
            noise_db: 0.0,
            failing: 0,
            failing_nodes: 0,
        };
        rescue(&setting, seed)
    }

    /// The ways in the first topology in which each WFR has a robot of its own, or else in the first of all, under the
    /// repaired rule.
    fn picture(&self) -> Result<String, Halt> {
        let drawn = |seed, report: &Report| {
            let team = counted(self.robots, "robot");
            let title = format!("{team} for {}, seed {seed}", counted(self.wfrs, "WFR"));
            picture(&title, &[map(String::new(), report)])
        };
        for run in runs([RuleName::Repaired], |_| self.topologies) {
            let report = self.rescue(run.at, run.seed(self.seed)).map_err(Diagnostic::from)?;
            if Sample::of(&report).assigned_m.is_some() {
                return Ok(drawn(run.seed(self.seed), &report));
            }
        }
        let first = self.rescue(RuleName::Repaired, self.seed).map_err(Diagnostic::from)?;
        Ok(drawn(self.seed, &first))
    }
}

impl Table for RescueFig8 {
    type Settings = Settings;
    type Job = Job;
    type Sample = Sample;
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "rescue-fig8",
            shows: "three robots for three that wait for rescue, MRC as published and repaired: how often each gets a \
                    robot, and one of its own, how far they go, and how far from the best assignment that is",
            help: "Which robot comes to whom, and how far it goes, where several call at once",
            more: "Nodes, robots and those who wait for rescue (WFRs) at random in a square, without any fault, under \
                   MRC as published and repaired. The paper draws one case of it.",
            examples: &[
                "rescue-fig8 --svg ways.svg",
                "rescue-fig8 --nodes 1100 --runs 1000 --format json",
                "rescue-fig8 --robots 2 --wfr 4",
            ],
            doing: "rescuing",
            takes: "some seconds",
            pictures: &[(
                "svg",
                "Store the ways of the first topology in which each WFR has a robot of its own as a picture",
            )],
            ..Description::NOTHING
        }
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        settings.rescue(RuleName::Published, settings.seed).map_err(Diagnostic::from)?;
        Ok(runs(RuleName::ALL, |_| settings.topologies))
    }

    fn measure(&self, settings: &Settings, run: &Job, _: &dyn Observer) -> Result<Sample, Halt> {
        let report = settings.rescue(run.at, run.seed(settings.seed)).map_err(Diagnostic::from)?;
        let scheme = Scheme::Farthest { k: Some(settings.k.0) };
        Ok(Sample { choices: Choices::of(scheme, &report).map_err(usage)?, ..Sample::of(&report) })
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let rules = RuleName::ALL.map(|rule| Line::of(rule, &at(&results, rule)));
        Ok(Summary { settings: settings.clone(), rules: rules.into() })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        let Settings { nodes, robots, wfrs, k, topologies, seed } = settings;
        let heading = format!(
            "{}, {}, {nodes} nodes in 300×300 m, range 25 m, k = {}, {}, seed {seed}",
            counted(*robots, "robot"),
            counted(*wfrs, "WFR"),
            k.0.get(),
            counted(*topologies, "topology")
        );
        let paper = |share: f64| format!("{:.2}", 100.0 * share);
        let mut table = Figures::new(heading, &merged.rules);
        table.row("MRC", |line| line.rule.to_string());
        for (name, of) in [
            ("served, %", (|line| line.served) as fn(&Line) -> Comparison),
            ("a robot each, %", |line| line.own),
        ] {
            table.row(name, |line| percent(of(line).ours, 2));
            table.row("  paper", |line| paper(of(line).paper));
            table.row("  difference", |line| paper(of(line).difference));
        }
        table.row("RD", |line| text(line.distance_ratio, 3));
        table.row("over the best assignment", |line| text(line.over_best, 3));
        table.row("the best assignment, %", |line| percent(line.best, 2));
        table.row("seconds to the last", |line| text(line.last_s, 1));
        table.row("NOTICE packets", |line| text(line.notices, 1));
        table.row("control packets", |line| text(line.control, 1));
        table.row("nearest available, %", |line| percent(line.nearest_available, 2));
        table.row("nearest of all, %", |line| percent(line.nearest, 2));
        table.row("targets at once", |line| text(line.at_once, 3));
        table.row("  each to the nearest", |line| text(line.uncoordinated, 3));
        table.row("  two to the same, %", |line| percent(line.crowded, 2));
        Ok(table.with_notes(
            "served: % of the topologies in which one robot comes to each WFR, and one only · a robot each: a \
             different one to each ·\npaper: a picture of one topology in which it is so, and “for all simulated \
             scenarios” · RD: metres walked for each metre\nof the shortest ways · over the best assignment: how many \
             times as far the robots are off the WFRs that they come to as\nunder the best of all assignments, where \
             each WFR has a robot of its own · the best assignment: % of these in which it is\nthat one · control \
             packets: MOVE, RESB, the answers to them and receipts, at each hop · nearest available, of all: % \
             of\nthe WFRs served to which a robot comes that has the fewest hops, of those not on their way when \
             it is chosen, or of all\nat the first call · targets at once: WFRs to which robots are on their way; \
             each to the nearest: if each robot went to\nthe one with the fewest hops, as by Reich's scheme; two \
             to the same: % of the topologies in which two do · ±, […]: the\n95 % interval",
        ))
    }

    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        let judged = |sentence: &'static str, what: &'static str, share: fn(&Line) -> Comparison| {
            merged.rules.iter().map(move |line| {
                let ours = share(line).ours;
                let measured = format!("{} % of the topologies", percent(ours, 2));
                Judgement::new(sentence, format!("{}, {what}", line.rule), measured, always(Some(ours)))
            })
        };
        let served = judged("“for all simulated scenarios” (4.3)", "all served", |line| line.served);
        let own =
            judged("“one nearby mobile node” for each WFR (abstract)", "a robot each", |line| line.own);
        let usually = merged.rules.iter().flat_map(|line| {
            let readings =
                [("of those available", line.nearest_available), ("of all robots", line.nearest)];
            readings.map(|(of, share)| {
                Judgement::new(
                    "“usually rescued by an available mobile node with the minimum hop count” (1): more than half",
                    format!("{}, {of}", line.rule),
                    format!("{} % of the WFRs served", percent(share, 2)),
                    below(Some([USUALLY; 2]), share.and_then(|share| share.interval)),
                )
            })
        });
        let more = merged.rules.iter().map(|line| {
            let [ours, nearest] = [line.at_once, line.uncoordinated].map(|targets| text(targets, 2));
            Judgement::new(
                "“more targets can be served simultaneously” (4.3)",
                format!("{}, than by the nearest", line.rule),
                format!("{ours} at once, {nearest} if each robot goes to the nearest"),
                below(Some([0.0; 2]), line.gain.and_then(|gain| gain.interval)),
            )
        });
        let crowded = merged.rules.first().map(|line| {
            Judgement::new(
                "by Reich's scheme robots “may move towards the same target simultaneously” (2.1)",
                "each to the nearest",
                format!("so in {} % of the topologies", percent(line.crowded, 2)),
                Verdict::decided(line.crowded.is_some_and(|share| share.mean > 0.0), false),
            )
        });
        served.chain(own).chain(usually).chain(more).chain(crowded).collect()
    }

    fn draw(&self, _: usize, settings: &Settings, _: &Summary) -> Result<String, Halt> {
        settings.picture()
    }
}

impl Sample {
    fn of(report: &Report) -> Self {
        let is_once = |fate: &Fate| matches!(fate, Fate::Served { visits: 1, .. });
        let is_served = report.fates.iter().all(is_once);
        let ways = report.journeys.iter().filter_map(|journey| Some((journey.moved_m, journey.shortest_m?)));
        let servants: Vec<usize> = report
            .fates
            .iter()
            .filter_map(|fate| match *fate {
                Fate::Served { by, .. } => Some(by),
                Fate::CutOff | Fate::Unheard | Fate::Abandoned | Fate::StillToCome => None,
            })
            .collect();
        let is_own = is_served && (1..servants.len()).all(|wfr| !servants[..wfr].contains(&servants[wfr]));
        let distance_m = |robot: usize, wfr: usize| {
            let start: Point = report.paths[robot].first()?.at;
            shortest_m(&report.field, start, report.wfrs[wfr])
        };
        let assigned_m = is_own.then(|| {
            let ours: Option<f64> =
                servants.iter().enumerate().map(|(wfr, &robot)| distance_m(robot, wfr)).sum();
            let robots: Vec<usize> = (0..report.paths.len()).collect();
            Some((ours?, best_m(report.wfrs.len(), &robots, &distance_m)?))
        });
        let last_ns = report.journeys.iter().map(|journey| journey.waited_ns).max();
        Self {
            is_served,
            way_m: ways.fold((0.0, 0.0), |sums, way| (sums.0 + way.0, sums.1 + way.1)),
            assigned_m: assigned_m.flatten(),
            last_s: last_ns.filter(|_| is_served).map(tautline_field::rescue::seconds),
            packets: (report.packets.notices, report.packets.control),
            choices: Choices::default(),
        }
    }
}

/// The least sum of distances when each of the first `wfrs` WFRs gets one of `robots`; `None` if they are too few, or
/// there is no way.
fn best_m(wfrs: usize, robots: &[usize], distance_m: &impl Fn(usize, usize) -> Option<f64>) -> Option<f64> {
    let Some(wfr) = wfrs.checked_sub(1) else { return Some(0.0) };
    let with = |&robot: &usize| {
        let others: Vec<usize> = robots.iter().copied().filter(|&other| other != robot).collect();
        Some(distance_m(robot, wfr)? + best_m(wfr, &others, distance_m)?)
    };
    robots.iter().filter_map(with).min_by(f64::total_cmp)
}

/// Sums that differ by no more are the same.
const SAME_M: f64 = 1e-6;

impl Line {
    fn of(rule: RuleName, samples: &[&Sample]) -> Self {
        let own: Vec<(f64, f64)> = samples.iter().filter_map(|sample| sample.assigned_m).collect();
        let ways = samples.iter().map(|sample| sample.way_m).filter(|&(_, shortest_m)| shortest_m > 0.0);
        let best = share(&own, |(ours_m, best_m)| ours_m - best_m <= SAME_M);
        let of_served = |such: fn(&Choices) -> u32| {
            ratio(
                samples
                    .iter()
                    .map(|sample| (f64::from(such(&sample.choices)), f64::from(sample.choices.served))),
            )
        };
        let targets = |of: fn(&Choices) -> f64| {
            mean(samples.iter().map(|sample| of(&sample.choices))).map(|targets| rounded(targets, 1e4))
        };
        Self {
            rule,
            served: Comparison::of(samples, |sample| sample.is_served),
            own: Comparison::of(samples, |sample| sample.assigned_m.is_some()),
            distance_ratio: ratio(ways),
            over_best: ratio(own.iter().copied()),
            best: best.map(|share| rounded(share, 1e4)),
            last_s: mean(samples.iter().filter_map(|sample| sample.last_s)).map(|last| rounded(last, 1e2)),
            notices: mean(samples.iter().map(|sample| f64::from(sample.packets.0))),
            control: mean(samples.iter().map(|sample| f64::from(sample.packets.1))),
            nearest_available: of_served(|choices| choices.nearest_available),
            nearest: of_served(|choices| choices.nearest),
            at_once: targets(|choices| f64::from(choices.at_once)),
            uncoordinated: targets(|choices| f64::from(choices.uncoordinated)),
            gain: targets(|choices| f64::from(choices.at_once) - f64::from(choices.uncoordinated)),
            crowded: share(samples, |sample| sample.choices.crowd > 1).map(|share| rounded(share, 1e4)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::measure;
    use super::*;

    #[test]
    fn the_best_assignment_is_the_least_of_all() {
        let table = [[4.0, 1.0, 3.0], [2.0, 0.0, 5.0], [3.0, 2.0, 2.0]];
        let distance_m = |robot: usize, wfr: usize| Some(table[robot][wfr]);
        assert_eq!(best_m(3, &[0, 1, 2], &distance_m), Some(5.0), "1 + 2 + 2");
        assert_eq!(best_m(2, &[0, 1, 2], &distance_m), Some(3.0), "1 + 2, the third robot stays");
        assert_eq!(best_m(3, &[0, 1], &distance_m), None);
    }

    #[test]
    fn each_number_is_of_the_topologies_that_its_heading_says() {
        let sample = |is_served, way_m, assigned_m, last_s, packets| Sample {
            is_served,
            way_m,
            assigned_m,
            last_s,
            packets,
            choices: Choices {
                served: 3,
                nearest_available: packets.1.min(3),
                nearest: 2,
                at_once: 3,
                uncoordinated: 1 + packets.1 % 4 / 2,
                crowd: 2,
            },
        };
        let samples = [
            sample(true, (150.0, 100.0), Some((105.0, 100.0)), Some(60.0), (10, 2)),
            sample(true, (300.0, 300.0), Some((300.0, 300.0)), Some(120.0), (20, 4)),
            sample(true, (50.0, 50.0), None, Some(30.0), (30, 6)),
            sample(false, (0.0, 0.0), None, None, (40, 8)),
        ];
        let line = Line::of(RuleName::Repaired, &samples.iter().collect::<Vec<_>>());
        let mean = |estimate: Option<Estimate>| estimate.map(|estimate| (estimate.count, estimate.mean));
        let shares = [line.served, line.own].map(|share| (share.ours.mean, share.difference));
        assert_eq!(shares, [(0.75, -0.25), (0.5, -0.5)]);
        assert_eq!(mean(line.distance_ratio), Some((3, 1.1111)), "500 m over 450 m");
        assert_eq!(mean(line.over_best), Some((2, 1.0125)), "405 m over 400 m");
        assert_eq!(mean(line.best), Some((2, 0.5)), "5 m farther is not the best");
        assert_eq!(mean(line.last_s), Some((3, 70.0)));
        assert_eq!([mean(line.notices), mean(line.control)], [Some((4, 25.0)), Some((4, 5.0))]);
        assert_eq!(
            [mean(line.nearest_available), mean(line.nearest)],
            [Some((4, 0.9167)), Some((4, 0.6667))]
        );
        assert_eq!([mean(line.at_once), mean(line.uncoordinated)], [Some((4, 3.0)), Some((4, 1.5))]);
        assert_eq!([mean(line.gain), mean(line.crowded)], [Some((4, 1.5)), Some((4, 1.0))]);
    }

    #[test]
    fn greedy_assignments_are_never_better_than_the_best() {
        let settings = Settings { topologies: 20, ..Settings::default() };
        let lines = measure(&RescueFig8, &settings, &()).expect("rescues").rules;
        for line in &lines {
            assert!(line.over_best.is_some_and(|ratio| ratio.mean >= 1.0), "{line:?}");
        }
        assert!(lines[1].served.difference.abs() < 1e-9, "repaired all are served once");
    }
}
