//! Figure 5 of [Jiang 2011]: how many nodes of a random network a broadcast reaches, and how many forward it, by scheme
//! and density. The paper counts all nodes; those that no link connects to the source nothing can reach, so the reach
//! within the source's component stands beside it. Every scheme broadcasts over the same topologies, from the same
//! sources. Beside the figure stand three more promises of the paper: that k-FNF prolongs the lifetime of the network
//! (1), that other schemes than flooding have fewer collisions (2.2), and that of a sender's hearers the farthest is
//! the likeliest to forward (3.2).

mod lifetime;

use std::cmp::Reverse;

use tautline_io::named_values::NamedValues;
use tautline_kernel::choice::Oracle;
use tautline_kernel::net::NodeId;
use tautline_kernel::notice::{Count, Node, Rule, Scheme, Stage};
use tautline_proofs::engine::SeededOracle;

pub use self::lifetime::{BROADCASTS, Lifetime};
use super::prelude::*;
use super::sentences::NEAR;
use tautline_field::radio::{
    Area, ChannelName, Faults, Field, LONGEST_WAIT_NS, Model, Network, Problem, Radio, broadcast,
};

/// The numbers of nodes of the paper.
pub const NODES: [usize; 5] = [300, 500, 700, 900, 1100];

/// The side of the paper's square, in metres.
pub const SIDE_M: f64 = 300.0;

/// The paper's radio range, in metres.
pub const RANGE_M: f64 = 25.0;

/// The k of the paper's figure, and what it has k-FNF reach there: “near 100 %”, at every density. All else it draws
/// only.
const PAPER: (Count, f64) = (Count::ONE, 1.0);

/// The name of the scalable broadcast algorithm.
const SBA: &str = "sba";

/// The name of k-FNF.
const K_FNF: &str = "k-fnf";

/// The hearers of a sender by their distance.
const RANKS: [&str; 3] = ["farthest", "second", "others"];

/// Figure 5.
#[derive(Clone, Copy, Debug)]
pub struct NoticeFig5;

settings! {
    /// The settings of the figure.
    pub struct Settings {
        /// Numbers of nodes
        pub nodes: Vec<usize> = NODES.into(), list("nodes", whole);
        /// The side of the square, in metres
        pub side_m: f64 = SIDE_M, one("side", "METRES", real);
        /// The radio range, in metres
        pub range_m: f64 = RANGE_M, one("range", "METRES", real);
        /// The k of k-FNF: how many senders, the first not counted, make a node silent
        pub ks: Vec<Senders> = [1, 2, 3].into_iter().filter_map(Count::new).map(Senders).collect(),
            joined("k", Senders::read);
        /// Topologies for each number of nodes
        pub topologies: u32 = 200, one("runs", "COUNT", from_to(1..=100_000));
        /// The seed of all topologies
        pub seed: u64 = 0, one("seed", "SEED", number);
        /// The channel between the nodes
        pub channel: ChannelName = ChannelName::Ideal, word("channel", "CHANNEL");
    }
}

/// One topology, by the place of the number of nodes.
type Job = Run<usize>;

/// The whole figure.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Summary {
    side_m: f64,
    range_m: f64,
    topologies: u32,
    seed: u64,
    channel: ChannelName,
    /// Density by density.
    pub densities: Vec<Density>,
}

/// All schemes at one number of nodes.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Density {
    /// The number of nodes.
    pub nodes: usize,
    /// The share of the topologies in which links connect all nodes.
    pub connected: Estimate,
    /// The share of the nodes that links connect to the source, the source included.
    pub component: Estimate,
    /// Scheme by scheme.
    pub schemes: Vec<Line>,
    /// The lifetime by k-FNF, of the first k, over that by flooding.
    pub lifetimes: Vec<Lifetime>,
    /// The share that forwards by k-FNF, of the first k, among the nodes that are the farthest from their parent of all
    /// that have it, those that are the second, and the others.
    pub forwarding: Vec<Option<Estimate>>,
}

/// One scheme at one number of nodes.
#[derive(Clone, PartialEq, Debug, JsonSchema, Serialize)]
pub struct Line {
    /// The scheme.
    pub scheme: String,
    /// The share of all nodes that know of the event in the end, the source included.
    pub reach: Estimate,
    /// The paper's number.
    pub paper: Option<f64>,
    /// Ours less the paper's.
    pub difference: Option<f64>,
    /// The share of the nodes of the source's component that do.
    pub reach_component: Estimate,
    /// Nodes that forward, the source not included.
    pub rebroadcasts: Estimate,
    /// Messages that a node does not hear for another signal, where signals can collide.
    pub collisions: Option<Estimate>,
    /// Those for each packet sent.
    pub collisions_per_packet: Option<Estimate>,
}

/// One topology: the nodes that links connect to the source, and scheme by scheme the nodes reached, the rebroadcasts
/// and the collisions; of k-FNF the lifetimes, and by rank the nodes that forward and all.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Sample {
    component: u32,
    schemes: Vec<(u32, u32, u32)>,
    lifetimes: [f64; 4],
    ranks: [(u32, u32); RANKS.len()],
}

impl Settings {
    /// The schemes of the figure by name, k-FNF for each k.
    fn schemes(&self, range_um: u32) -> Vec<(String, Scheme)> {
        let farthest =
            |&Senders(k): &Senders| (format!("{K_FNF} k={}", k.get()), Scheme::Farthest { k: Some(k) });
        let counter = |below: Count| (format!("counter C={}", below.get()), Scheme::Counter { below });
        let distance = |tenths: u32| {
            let least_um = (u64::from(range_um) * u64::from(tenths) / 10) as u32;
            (format!("distance 0.{tenths}"), Scheme::Distance { least_um })
        };
        let rivals = [2, 3].into_iter().filter_map(Count::new).map(counter).chain([8, 5].map(distance));
        let plain = [(SBA.to_owned(), Scheme::Scalable), ("flooding".to_owned(), Scheme::Flooding)];
        self.ks.iter().map(farthest).chain(rivals).chain(plain).collect()
    }

    fn radio(&self) -> Result<Radio, Problem> {
        Radio::new(self.range_m, Model::Disc)
    }

    /// A topology and its source, with a stream of answers to themselves.
    fn topology(&self, nodes: usize, topology: u32) -> Result<(Network, NodeId), Problem> {
        let (area, radio) = (Area::new(self.side_m, self.side_m)?, self.radio()?);
        let chance = &mut SeededOracle::new(self.seed, 2 * u64::from(topology));
        let field = Field::random(area, Vec::new(), nodes, chance)?;
        Ok((Network::new(&field, radio, chance)?, NodeId(chance.pick(nodes as u32))))
    }

    /// A broadcast by every scheme in a topology; all draw their waits from the start of the same stream.
    fn sample(&self, nodes: usize, topology: u32) -> Result<Sample, Problem> {
        let (network, source) = self.topology(nodes, topology)?;
        let (range_um, channel) = (self.radio()?.range_um(), self.channel.channel());
        let rules = self.schemes(range_um.get()).into_iter();
        let rules: Vec<Rule> =
            rules.map(|(_, scheme)| Rule::new(scheme, range_um, LONGEST_WAIT_NS)).collect();
        let mut ranks = None;
        let schemes = rules.iter().map(|rule| {
            let chance = &mut SeededOracle::new(self.seed, 2 * u64::from(topology) + 1);
            let (report, nodes) = broadcast(&network, rule, channel, &Faults::NONE, source, chance)?;
            ranks.get_or_insert_with(|| by_rank(&network, &nodes));
            Ok((report.reached, report.rebroadcasts, report.air.collided as u32))
        });
        let schemes = schemes.collect::<Result<_, Problem>>()?;
        // A stream of its own: topologies count their streams from 0.
        let chance = &mut SeededOracle::new(self.seed, u64::MAX - u64::from(topology));
        let lifetimes = lifetime::ratios(&network, &rules[0], channel, source, chance)?;
        let component = network.component(source) as u32;
        Ok(Sample { component, schemes, lifetimes, ranks: ranks.unwrap_or_default() })
    }

    fn density(&self, nodes: usize, samples: &[&Sample], schemes: Vec<(String, Scheme)>) -> Density {
        let all = f64::from(nodes as u32);
        let mean = |value: &dyn Fn(&Sample) -> f64| {
            mean(samples.iter().map(|sample| value(sample))).unwrap_or(Estimate::NOTHING)
        };
        let connected = share(samples, |sample| sample.component as usize == nodes);
        let is_papers = self.side_m == SIDE_M && self.range_m == RANGE_M && NODES.contains(&nodes);
        let sum = |pair: &dyn Fn(&Sample) -> (u32, u32)| {
            let pairs = samples.iter().map(|sample| pair(sample));
            ratio(pairs.map(|(part, all)| (f64::from(part), f64::from(all))))
        };
        let line = |(place, (name, scheme)): (usize, (String, Scheme))| {
            let (paper_k, paper_reach) = PAPER;
            let is_paper = is_papers && scheme == Scheme::Farthest { k: Some(paper_k) };
            let reached = |sample: &Sample| f64::from(sample.schemes[place].0);
            let paper = is_paper.then_some(paper_reach);
            let reach = mean(&|sample| reached(sample) / all);
            Line {
                scheme: name,
                reach: rounded(reach, 1e4),
                paper,
                difference: paper.map(|paper| decimals(reach.mean - paper, 1e4)),
                reach_component: rounded(mean(&|sample| reached(sample) / f64::from(sample.component)), 1e4),
                rebroadcasts: rounded(mean(&|sample| f64::from(sample.schemes[place].1)), 1e2),
                collisions: self
                    .can_collide()
                    .then(|| rounded(mean(&|sample| f64::from(sample.schemes[place].2)), 1e2)),
                collisions_per_packet: self
                    .can_collide()
                    .then(|| {
                        sum(&|sample| {
                            let (_, rebroadcasts, collided) = sample.schemes[place];
                            (collided, rebroadcasts + 1)
                        })
                    })
                    .flatten(),
            }
        };
        let lifetimes: Vec<_> = samples.iter().map(|sample| sample.lifetimes).collect();
        Density {
            nodes,
            connected: rounded(connected.unwrap_or(Estimate::NOTHING), 1e4),
            component: rounded(mean(&|sample| f64::from(sample.component) / all), 1e4),
            schemes: schemes.into_iter().enumerate().map(line).collect(),
            lifetimes: Lifetime::of(&lifetimes),
            forwarding: (0..RANKS.len()).map(|rank| sum(&|sample| sample.ranks[rank])).collect(),
        }
    }

    fn can_collide(&self) -> bool {
        match self.channel {
            ChannelName::Ideal => false,
            ChannelName::Shared => true,
        }
    }
}

/// By rank the nodes that have forwarded, and all: of those that have a parent in common, the farthest from it first.
fn by_rank(network: &Network, nodes: &[Node]) -> [(u32, u32); RANKS.len()] {
    let mut children: Vec<Vec<(Reverse<u32>, usize)>> = vec![Vec::new(); nodes.len()];
    for (place, node) in nodes.iter().enumerate() {
        if let Some(parent) = node.parent()
            && let Some(apart_um) = network.distance_um(parent, NodeId(place as u32))
        {
            children[parent.0 as usize].push((Reverse(apart_um), place));
        }
    }
    let mut ranks = [(0, 0); RANKS.len()];
    for children in &mut children {
        children.sort_unstable();
        for (rank, &(_, place)) in children.iter().enumerate() {
            let (forwarded, all) = &mut ranks[rank.min(RANKS.len() - 1)];
            *forwarded += u32::from(nodes[place].stage() == Stage::Forwarded);
            *all += 1;
        }
    }
    ranks
}

/// Whether all schemes but k-FNF and flooding have fewer collisions than flooding at all densities, counted in one way.
fn fewer(densities: &[Density], of: &str, collisions: fn(&Line) -> Option<Estimate>) -> Option<Judgement> {
    let mut verdict = Verdict::Holds;
    let mut most: Option<(f64, String)> = None;
    for density in densities {
        let [rivals @ .., flooding] = &density.schemes[..] else { return None };
        let flooding = collisions(flooding)?;
        for line in rivals.iter().filter(|line| !line.scheme.starts_with(K_FNF)) {
            let ours = collisions(line)?;
            verdict = verdict.and(below(ours.interval, flooding.interval));
            let share = ours.mean / flooding.mean;
            if most.as_ref().is_none_or(|(most, _)| share > *most) {
                let nodes = counted(density.nodes as u32, "node");
                let measured =
                    format!("{} by {}, {} by flooding, {nodes}", ours.text(2), line.scheme, flooding.text(2));
                most = Some((share, measured));
            }
        }
    }
    let sentence =
        "flooding “increases the possibility of packet collision”, the others “reduce” it (2.2): collisions";
    Some(Judgement::new(sentence, of, format!("at most {}", most?.1), verdict))
}

/// Whether nodes that are farthest from their parent are the likeliest to forward, at all densities.
fn farthest(densities: &[Density]) -> Option<Judgement> {
    let mut verdict = Verdict::Holds;
    for density in densities {
        let [first, others @ ..] = &density.forwarding[..] else { return None };
        for other in others {
            verdict = verdict.and(below(ends(*other), ends(*first)));
        }
    }
    let least = densities.iter().filter_map(|density| Some((density, (*density.forwarding.first()?)?)));
    let (density, share) = least.min_by(|(_, one), (_, other)| one.mean.total_cmp(&other.mean))?;
    Some(Judgement::new(
        "“the farthest node has … the highest probability to forward the packet first” (3.2)",
        RANKS[0],
        format!(
            "{} % of them forward at {}, the least",
            percent(share, 1),
            counted(density.nodes as u32, "node")
        ),
        verdict,
    ))
}

impl Table for NoticeFig5 {
    type Settings = Settings;
    type Job = Job;
    type Sample = Sample;
    type Summary = Summary;

    fn about(&self) -> Description {
        Description {
            id: "notice-fig5",
            shows: "k-FNF, flooding, counter, distance and scalable broadcasts in random networks: the share of all \
                    nodes and of those connected to the source that each reaches, and how many nodes forward",
            help: "How many nodes a broadcast reaches, and how many forward it, by scheme and density",
            more: "Nodes at random places in a square, from a random source: of all nodes, and \
                   of those that links connect to the source.",
            examples: &[
                "notice-fig5",
                "notice-fig5 --svg-reach reach.svg --svg-rebroadcasts rebroadcasts.svg",
                "notice-fig5 --nodes 300 --k 1,2,4,8 --runs 1000 --format json",
                "notice-fig5 --channel shared",
            ],
            doing: "broadcasting",
            takes: "some seconds",
            pictures: &[
                ("svg-reach", "Store the reach as a picture"),
                ("svg-rebroadcasts", "Store the rebroadcasts as a picture"),
            ],
            ..Description::NOTHING
        }
    }

    fn jobs(&self, settings: &Settings) -> Result<Vec<Job>, Halt> {
        for &nodes in &settings.nodes {
            settings.topology(nodes, 0).map_err(usage)?;
        }
        Ok(runs(0..settings.nodes.len(), |_| settings.topologies))
    }

    fn measure(&self, settings: &Settings, run: &Job, _: &dyn Observer) -> Result<Sample, Halt> {
        let nodes = settings.nodes.get(run.at).copied().unwrap_or_default();
        settings.sample(nodes, run.number).map_err(usage)
    }

    fn merge(&self, settings: &Settings, results: Results<Self>) -> Result<Summary, Halt> {
        let Settings { side_m, range_m, topologies, seed, channel, .. } = *settings;
        let range_um = settings.radio().map_err(usage)?.range_um().get();
        let densities = settings.nodes.iter().enumerate().map(|(density, &nodes)| {
            settings.density(nodes, &at(&results, density), settings.schemes(range_um))
        });
        Ok(Summary { side_m, range_m, topologies, seed, channel, densities: densities.collect() })
    }

    fn text(&self, settings: &Settings, merged: &Summary) -> Result<String, Halt> {
        let densities = &merged.densities;
        let heading = format!(
            "{side}×{side} m, range {} m, {} for each number of nodes, seed {}, {} channel",
            Number(settings.range_m),
            counted(settings.topologies, "topology"),
            settings.seed,
            settings.channel.word(),
            side = Number(settings.side_m),
        );
        let mut table = Figures::new(heading, densities);
        table.row("nodes", |density| density.nodes.to_string());
        table.row("connected", |density| percent(density.connected, 1));
        table.row("component", |density| percent(density.component, 2));
        let schemes = densities.first().map_or(&[][..], |density| &density.schemes);
        table.title("Reach, % of all nodes");
        for (place, line) in schemes.iter().enumerate() {
            table.row(line.scheme.as_str(), |density| percent(density.schemes[place].reach, 2));
            if densities.iter().any(|density| density.schemes[place].paper.is_some()) {
                let said = |part: Option<f64>| plain(part.map(|part| 100.0 * part), 2);
                table.row("  paper", |density| said(density.schemes[place].paper));
                table.row("  difference", |density| said(density.schemes[place].difference));
            }
        }
        table.title("Reach, % of the nodes connected to the source");
        for (place, line) in schemes.iter().enumerate() {
            table.row(line.scheme.as_str(), |density| percent(density.schemes[place].reach_component, 2));
        }
        table.title("Rebroadcasts");
        for (place, line) in schemes.iter().enumerate() {
            table.row(line.scheme.as_str(), |density| density.schemes[place].rebroadcasts.text(2));
        }
        if settings.can_collide() {
            table.title("Collisions");
            for (place, line) in schemes.iter().enumerate() {
                table.row(line.scheme.as_str(), |density| text(density.schemes[place].collisions, 2));
            }
            table.title("Collisions for each packet sent");
            for (place, line) in schemes.iter().enumerate() {
                table.row(line.scheme.as_str(), |density| {
                    text(density.schemes[place].collisions_per_packet, 2)
                });
            }
        }
        let first = schemes.first().map_or("", |line| &line.scheme);
        table.title(&format!("Lifetime by {first}, times that by flooding"));
        for (place, lifetime) in densities.first().iter().flat_map(|density| &density.lifetimes).enumerate() {
            table.row(lifetime.name(), |density| density.lifetimes[place].ratio.text(2));
        }
        table.title(&format!("Forwarding by {first}, % of the nodes that have one parent in common"));
        for (rank, name) in RANKS.into_iter().enumerate() {
            table.row(name, |density| percent(density.forwarding[rank], 2));
        }
        let collisions = match settings.channel {
            ChannelName::Ideal => "",
            ChannelName::Shared => {
                "collisions: messages that a node does not hear for another signal, each at each such node\n"
            }
        };
        Ok(table.with_notes(&format!(
            "connected: % of the networks in which links connect all nodes · component: % of the \
             nodes that they connect to the\nsource · ±, […]: the 95 % interval · paper: “near 100 %” \
             at every density; all else it draws only\n{collisions}\
             lifetime: broadcasts until the first node has spent its energy, by {BROADCASTS} of each topology · sent: \
             only sending costs ·\nheard: and hearing a signal half as much · fixed, drawn: all from one source, or \
             each from another · farthest, second: by\nthe distance from the parent",
        )))
    }

    fn sentences(&self, merged: &Summary) -> Vec<Judgement> {
        let densities = merged.densities.iter();
        let lines = densities.flat_map(|density| density.schemes.iter().map(move |line| (density, line)));
        let of_paper: Vec<(&Density, &Line)> = lines.filter(|(_, line)| line.paper.is_some()).collect();
        let near = of_paper.iter().map(|(density, line)| {
            Judgement::new(
                format!("k-FNF reaches “near 100 %”: {:.0} % or more", 100.0 * NEAR),
                counted(density.nodes as u32, "node"),
                format!("{} %", percent(line.reach, 2)),
                at_least(NEAR, line.reach),
            )
        });
        let like_sba = of_paper.iter().filter_map(|(density, line)| {
            let sba = density.schemes.iter().find(|line| line.scheme == SBA)?;
            let difference = line.reach.interval.zip(sba.reach.interval);
            let difference = difference.map(|([low, high], [least, most])| [low - most, high - least]);
            Some(Judgement::new(
                format!("“very close to the reachability of SBA”: at most {:.0} % off", 100.0 * (1.0 - NEAR)),
                counted(density.nodes as u32, "node"),
                format!("{} %, SBA {} %", percent(line.reach, 2), percent(sba.reach, 2)),
                within([NEAR - 1.0, 1.0 - NEAR], difference),
            ))
        });
        let lifetimes: Vec<(usize, &[Lifetime])> =
            merged.densities.iter().map(|density| (density.nodes, &density.lifetimes[..])).collect();
        let collisions = [
            fewer(&merged.densities, "of a broadcast", |line| line.collisions),
            fewer(&merged.densities, "of a packet", |line| line.collisions_per_packet),
        ];
        let others = lifetime::judged(&lifetimes).into_iter().chain(collisions.into_iter().flatten());
        near.chain(like_sba).chain(others).chain(farthest(&merged.densities)).collect()
    }

    /// A part of the figure by the number of nodes: (a) the reach of all nodes, (b) the rebroadcasts.
    fn draw(&self, picture: usize, _: &Settings, merged: &Summary) -> Result<String, Halt> {
        let (title, y, of): (_, _, fn(&Line) -> Estimate) = if picture == 0 {
            let y = Axis::new("reach", "%").showing([0.0, 100.0]);
            ("Nodes that a broadcast reaches", y, |line| line.reach.times(100.0))
        } else {
            let y = Axis::new("rebroadcasts", "").showing([0.0, 0.0]);
            ("Nodes that forward a broadcast", y, |line| line.rebroadcasts)
        };
        let schemes = merged.densities.first().map_or(&[][..], |density| &density.schemes);
        let series = |(place, line): (usize, &Line)| {
            let point = |density: &Density| {
                Some(Point::of(f64::from(density.nodes as u32), of(density.schemes.get(place)?)))
            };
            Series::measured(&line.scheme, merged.densities.iter().filter_map(point))
        };
        Ok(LineChart::new(title, Axis::new("nodes", ""), y, schemes.iter().enumerate().map(series)).svg())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_number_stands_beside_its_own_k_nodes_and_square_alone() {
        let density = |settings: &Settings, nodes: usize| {
            let sample = |component: u32, first: (u32, u32, u32)| Sample {
                component,
                schemes: [vec![first], vec![(component, 50, 6); 8]].concat(),
                lifetimes: [1.0; 4],
                ranks: [(3, 4), (1, 4), (0, 0)],
            };
            let samples =
                [sample(nodes as u32, (nodes as u32, 40, 3)), sample(nodes as u32 / 2, (90, 20, 5))];
            settings.density(nodes, &[&samples[0], &samples[1]], settings.schemes(25_000_000))
        };
        let usual = Settings::default();
        let of_paper = density(&usual, 300);
        assert_eq!((of_paper.connected.mean, of_paper.component.mean), (0.5, 0.75));
        let line = &of_paper.schemes[0];
        assert_eq!((line.reach.mean, line.paper, line.difference), (0.65, Some(1.0), Some(-0.35)));
        assert_eq!((line.reach_component.mean, line.rebroadcasts.mean), (0.8, 30.0));
        assert!(of_paper.schemes[1..].iter().all(|line| line.paper.is_none() && line.difference.is_none()));
        for other in [
            density(&usual, 400),
            density(&Settings { range_m: 30.0, ..usual.clone() }, 300),
            density(&Settings { side_m: 200.0, ..usual }, 300),
        ] {
            assert!(other.schemes.iter().all(|line| line.paper.is_none()));
        }
    }
}
