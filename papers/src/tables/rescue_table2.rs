//! Table 2 of [Jiang 2011]: k-FNF, MRC and TAN beside Verma's and Reich's schemes. The paper has words
//! where it could have numbers: low and high, shorter and longer. Ours are those of figures 5, 7 and 8
//! at one number of nodes; both rivals flood.

use super::journeys::{self, Claim, RESCUE_FIG7, Way};
use super::notice_fig5::{self, NoticeFig5};
use super::prelude::*;
use super::rescue_fig8::{self, RescueFig8};
use super::sentences::NEAR;
use tautline_sim::explore::RuleName;

/// Table 2.
#[derive(Clone, Copy, Debug)]
pub struct RescueTable2;

settings! {
    /// The settings of the table.
    #[derive(Eq)]
    pub struct Settings {
        /// Nodes
        pub nodes: usize = 700, one("nodes", "N", whole);
        /// The k of k-FNF
        pub k: Senders = Senders::ONE, one("k", "K", Senders::read);
        /// Topologies of each kind of run
        pub topologies: u32 = 200, one("runs", "COUNT", from_to(1..=100_000));
        /// The seed of all topologies
        pub seed: u64 = 0, one("seed", "SEED", number);
    }
}

/// A kind of run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub enum Part {
    /// Broadcasts by k-FNF and by flooding.
    Spread,
    /// A robot's ways to a WFR.
    Way,
    /// Three robots for three WFRs.
    Rescue,
}

/// A run's outcome.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub enum Sample {
    /// Of broadcasts.
    Spread(notice_fig5::Sample),
    /// Of ways.
    Way(journeys::Sample),
    /// Of a rescue.
    Rescue(rescue_fig8::Sample),
}

/// The whole table.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    #[serde(flatten)]
    settings: Settings,
    /// Figure 5's broadcasts: k-FNF first, flooding last.
    pub spread: Option<notice_fig5::Density>,
    /// Figure 7's ways.
    pub way: Option<journeys::Density>,
    /// Figure 8's rescues under the published rule.
    pub rescue: Option<rescue_fig8::Line>,
}

impl Settings {
    fn spread(&self) -> notice_fig5::Settings {
        let &Self { nodes, k, topologies, seed } = self;
        notice_fig5::Settings { nodes: vec![nodes], ks: vec![k], topologies, seed, ..Default::default() }
    }

    fn way(&self) -> journeys::Settings {
        let &Self { nodes, k, topologies, seed } = self;
        journeys::Settings { nodes: vec![nodes], k, topologies, seed, ..Default::default() }
    }

    fn rescue(&self) -> rescue_fig8::Settings {
        let &Self { nodes, k, topologies, seed } = self;
        rescue_fig8::Settings { nodes, k, topologies, seed, ..Default::default() }
    }
}

impl Table for RescueTable2 {
    type Settings = Settings;
    type Job = Run<Part>;
    type Sample = Sample;
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "rescue-table2",
            shows: "k-FNF, MRC and TAN beside Verma's and Reich's schemes: \
                    rebroadcasts, reach, metres walked, control packets",
            help: "Table 2 of the paper on rescues: broadcasts, reach, ways and control packets",
            more: "The figures are those of notice-fig5, rescue-fig7 and rescue-fig8 at one number of nodes.",
            examples: &["rescue-table2", "rescue-table2 --nodes 1100 --format json"],
            doing: "comparing",
            takes: "some seconds",
            ..Description::NOTHING
        }
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Self::Job>, Halt> {
        NoticeFig5.jobs(&settings.spread())?;
        RESCUE_FIG7.jobs(&settings.way())?;
        RescueFig8.jobs(&settings.rescue())?;
        Ok(runs([Part::Spread, Part::Way, Part::Rescue], |_| settings.topologies))
    }

    fn measure(
        &self,
        settings: &Settings,
        &Run { at, number }: &Self::Job,
        seen: &dyn Observer,
    ) -> Result<Sample, Halt> {
        Ok(match at {
            Part::Spread => {
                Sample::Spread(NoticeFig5.measure(&settings.spread(), &Run { at: 0, number }, seen)?)
            }
            Part::Way => Sample::Way(RESCUE_FIG7.measure(&settings.way(), &Run { at: 0, number }, seen)?),
            Part::Rescue => {
                let run = Run { at: RuleName::Published, number };
                Sample::Rescue(RescueFig8.measure(&settings.rescue(), &run, seen)?)
            }
        })
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let (mut spreads, mut ways, mut rescues) = (Vec::new(), Vec::new(), Vec::new());
        for (Run { number, .. }, sample) in results {
            match sample {
                Sample::Spread(sample) => spreads.push((Run { at: 0, number }, sample)),
                Sample::Way(sample) => ways.push((Run { at: 0, number }, sample)),
                Sample::Rescue(sample) => rescues.push((Run { at: RuleName::Published, number }, sample)),
            }
        }
        Ok(Summary {
            settings: settings.clone(),
            spread: NoticeFig5.merge(&settings.spread(), spreads)?.densities.pop(),
            way: RESCUE_FIG7.merge(&settings.way(), ways)?.densities.pop(),
            rescue: RescueFig8.merge(&settings.rescue(), rescues)?.rules.into_iter().next(),
        })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        let Settings { nodes, k, topologies, seed } = settings;
        let heading = format!(
            "{nodes} nodes in 300×300 m, range 25 m, k = {}, {}, seed {seed}",
            k.0.get(),
            counted(*topologies, "topology")
        );
        let schemes = [("k-FNF, MRC, TAN", Way::Tan), ("Verma's", Way::Verma), ("Reich's", Way::Reich)];
        let spread = |way: Way, of: fn(&notice_fig5::Line) -> Estimate| {
            let lines = &merged.spread.as_ref()?.schemes;
            (if way == Way::Tan { lines.first() } else { lines.last() }).map(of)
        };
        let mut table = Figures::new(heading, &schemes);
        table.row("scheme", |(name, _)| (*name).to_owned());
        table
            .row("positions", |&(_, way)| if way == Way::Verma { "needed" } else { "not needed" }.to_owned());
        table.row("rebroadcasts", |&(_, way)| text(spread(way, |line| line.rebroadcasts), 1));
        table.row("reach, %", |&(_, way)| {
            spread(way, |line| line.reach).map_or("-".to_owned(), |reach| percent(reach, 2))
        });
        table.row("RD", |&(_, way)| {
            let ways = merged.way.as_ref().map_or(&[][..], |density| &density.ways);
            text(ways.iter().find(|line| line.way == way).and_then(|line| line.ratio), 3)
        });
        table.row("control packets", |&(_, way)| {
            let control = merged.rescue.as_ref().and_then(|line| line.control).filter(|_| way == Way::Tan);
            text(control, 1)
        });
        Ok(table.with_notes(
            "positions: by the rules themselves · both rivals flood · RD: metres walked for each metre of the \
             shortest ways · control\npackets: of a rescue of three WFRs by three robots; the rivals \
             coordinate nobody · ±, […]: the 95 % interval",
        ))
    }

    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        let Summary { spread: Some(spread), way: Some(way), rescue: Some(rescue), .. } = merged else {
            return Vec::new();
        };
        let (Some(ours), Some(flooding)) = (spread.schemes.first(), spread.schemes.last()) else {
            return Vec::new();
        };
        let fewer = |one: Estimate, other: Estimate| below(one.interval, other.interval);
        let mut judged = vec![Judgement::new(
            "Table 2, “broadcasting redundancy”: low, high, high",
            "k-FNF against flooding",
            format!("{} rebroadcasts, {}", ours.rebroadcasts.text(1), flooding.rebroadcasts.text(1)),
            fewer(ours.rebroadcasts, flooding.rebroadcasts),
        )];
        judged.extend([("k-FNF", ours), ("flooding", flooding)].map(|(name, line)| {
            let verdict = at_least(NEAR, line.reach);
            let (sentence, of) =
                ("Table 2, “reachability”: high, high, high", format!("{name}, {NEAR} or more"));
            Judgement::new(sentence, of, format!("{} %", percent(line.reach, 2)), verdict)
        }));
        judged.extend([Claim::ShorterThanVerma, Claim::LikeReich].into_iter().filter_map(|claim| {
            let decision = way.claims.iter().find(|decision| decision.paper == claim)?;
            let of = format!("TAN and {}", claim.rival().word());
            let measured = format!("RD differs by {}", text(decision.difference, 2));
            let sentence = "Table 2, “moving distance of mobile robots”: shorter, longer, shorter";
            Some(Judgement::new(sentence, of, measured, decision.verdict))
        }));
        if let (Some(control), Some(notices)) = (rescue.control, rescue.notices) {
            judged.push(Judgement::new(
                "“it causes only a small amount of control packets” (1)",
                "MRC against NOTICE, fewer are few",
                format!("{} control packets, {} of NOTICE", control.text(1), notices.text(1)),
                fewer(control, notices),
            ));
        }
        judged
    }
}
