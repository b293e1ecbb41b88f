//! How an event spreads, under every order in which NOTICEs arrive and waits end (NOTICE-1 to NOTICE-6). Time is left
//! out: whatever is under way may arrive next, once or again, whoever waits may be next to forward, and what never
//! arrives is lost. So node numbers play no part either, and one network of each shape is enough.

use core::num::NonZeroU32;
use core::ops::RangeInclusive;

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::{Call, Epoch, Heard, NodeId, Notice};
use tautline_kernel::notice::{Count, Node, Reaction, Rule, Scheme, Stage, Surroundings};

use crate::clause::{Sabotage, Subject};
use crate::decide::Evidence;
use crate::engine::{Outcome, Stop, Tally, cover, require};
use crate::evidence::{Played, Script, Unfit};
use crate::states::{Run, Step, System, search};

/// A network: for each node a bit for each neighbour. The source is node 0.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct Links<const NODES: usize>([u64; NODES]);

impl<const NODES: usize> Links<NODES> {
    const NONE: Self = Self([0; NODES]);

    fn add(&mut self, one: usize, other: usize) {
        self.0[one] |= 1 << other;
        self.0[other] |= 1 << one;
    }

    /// The nodes that links connect to the source, a bit for each.
    fn component(&self) -> u64 {
        let mut found = 1;
        loop {
            let further = ones(found).fold(found, |found, node| found | self.0[node]);
            if further == found {
                return found;
            }
            found = further;
        }
    }
}

/// The places of the ones, ascending.
fn ones(bits: u64) -> impl Iterator<Item = usize> {
    (0..64).filter(move |place| bits >> place & 1 == 1)
}

/// What can happen next.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Event {
    /// A NOTICE arrives.
    Arrives { from: usize, to: usize },
    /// A NOTICE arrives, and another copy of it is still under way.
    ArrivesAgain { from: usize, to: usize },
    /// A wait ends.
    Expires { at: usize },
}

/// An event on its way through a network.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
struct Spread<const NODES: usize> {
    nodes: [Node; NODES],
    /// The hop count of each node's last NOTICE.
    sent: [u16; NODES],
    /// For each node a bit for each to whom its NOTICE is under way.
    under_way: [u64; NODES],
    /// How often each node has forwarded; more than twice is twice.
    forwards: [u8; NODES],
    /// What an observer notes down of each node: of those it has heard before it forwarded or fell silent, the first with
    /// the least hop count, and that hop count.
    nearest: [Option<(usize, u16)>; NODES],
}

/// A source that is never asked for more than a wait, which plays no part.
struct AtOnce;

impl Oracle for AtOnce {
    fn pick(&mut self, _: u32) -> u32 {
        0
    }
}

/// Any distance will do.
const RANGE: NonZeroU32 = NonZeroU32::MIN;

const fn call(event: u32) -> Call {
    Call { wfr: NodeId(0), epoch: Epoch(event) }
}

/// A NOTICE of the first event.
const fn notice(sender: usize) -> Notice {
    Notice { call: call(1), sender: NodeId(sender as u32), hops: 0 }
}

/// All waits are over as soon as they begin.
fn hear(node: &mut Node, rule: &Rule, notice: Notice) -> Reaction {
    let heard = Heard { message: notice, distance_um: RANGE.get(), now_ns: 0 };
    node.receive(rule, heard, Surroundings::none, &mut AtOnce)
}

impl<const NODES: usize> Spread<NODES> {
    /// The source has sent.
    fn start(links: &Links<NODES>) -> Self {
        let mut spread = Self {
            nodes: core::array::from_fn(|id| Node::new(NodeId(id as u32), NodeId(0))),
            sent: [0; NODES],
            under_way: [0; NODES],
            forwards: [0; NODES],
            nearest: [None; NODES],
        };
        spread.nodes[0].originate();
        spread.under_way[0] = links.0[0];
        spread
    }

    fn events(&self) -> Vec<Event> {
        let mut events = Vec::new();
        for from in 0..NODES {
            for to in ones(self.under_way[from]) {
                events.extend([Event::Arrives { from, to }, Event::ArrivesAgain { from, to }]);
            }
        }
        let waits = |&at: &usize| matches!(self.nodes[at].stage(), Stage::Waiting { .. });
        events.extend((0..NODES).filter(waits).map(|at| Event::Expires { at }));
        events
    }

    fn hears(&self, rule: &Rule, from: usize, to: usize) -> Node {
        let mut node = self.nodes[to];
        hear(&mut node, rule, Notice { hops: self.sent[from], ..notice(from) });
        node
    }

    /// The state after `event`, without what no longer plays a part.
    fn after(self, rule: &Rule, links: &Links<NODES>, event: Event) -> Self {
        let mut next = self.happens(rule, links, event);
        next.drop_idle(rule);
        next
    }

    fn happens(mut self, rule: &Rule, links: &Links<NODES>, event: Event) -> Self {
        match event {
            Event::Arrives { from, to } => {
                self.arrives(rule, from, to);
                self.under_way[from] &= !(1 << to);
            }
            Event::ArrivesAgain { from, to } => self.arrives(rule, from, to),
            Event::Expires { at } => {
                let forwarded = self.nodes[at].expire(0);
                self.sent[at] = forwarded.map_or(0, |notice| notice.hops);
                self.under_way[at] = links.0[at];
                self.forwards[at] = 2.min(self.forwards[at] + 1);
            }
        }
        self
    }

    fn arrives(&mut self, rule: &Rule, from: usize, to: usize) {
        let hops = self.sent[from];
        match self.nodes[to].stage() {
            Stage::Unaware | Stage::Waiting { .. } => {
                let heard = self.nearest[to].into_iter().chain([(from, hops)]);
                self.nearest[to] = heard.min_by_key(|&(_, hops)| hops);
            }
            Stage::Silent | Stage::Forwarded => {}
        }
        self.nodes[to] = self.hears(rule, from, to);
    }

    /// Leaves out what is under way to a node that is done and does not change by it, which then never will.
    fn drop_idle(&mut self, rule: &Rule) {
        for from in 0..NODES {
            for to in ones(self.under_way[from]) {
                let is_done = matches!(self.nodes[to].stage(), Stage::Silent | Stage::Forwarded);
                if is_done && self.hears(rule, from, to) == self.nodes[to] {
                    self.under_way[from] &= !(1 << to);
                }
            }
        }
    }

    /// The parent of every node that knows of the event, and its hop count, are those that the observer expects.
    fn has_nearest_parents(&self) -> Result<(), Stop> {
        for (node, &nearest) in self.nodes.iter().zip(&self.nearest).skip(1) {
            let parent = nearest.map(|(sender, _)| NodeId(sender as u32));
            require(
                node.parent() == parent,
                "the parent is the first heard of those with the least hop count",
            )?;
            let hops = nearest.map(|(_, hops)| hops + 1);
            require(node.hops() == hops, "a node is one hop farther from the source than its parent")?;
        }
        Ok(())
    }

    /// Parent by parent every node that knows of the event comes to the source, each one hop farther than the next.
    fn is_tree(&self) -> Result<(), Stop> {
        for node in self.nodes.iter().filter(|node| node.event().is_some()) {
            let mut ancestor = node;
            for _ in 0..NODES {
                if let Some(parent) = ancestor.parent().and_then(|parent| self.nodes.get(parent.0 as usize)) {
                    ancestor = parent;
                }
            }
            require(ancestor == &self.nodes[0], "parent by parent every node comes to the source")?;
            if let Some(parent) = node.parent().and_then(|parent| self.nodes.get(parent.0 as usize)) {
                let farther = parent.hops().map(|hops| hops + 1);
                require(node.hops() == farther, "a node is one hop farther from the source than its parent")?;
                require(
                    parent.stage() == Stage::Forwarded,
                    "a parent is the source or a node that has forwarded",
                )?;
            }
        }
        Ok(())
    }
}

/// The largest network of which every state is looked at.
const SMALL: usize = 5;

/// A network, the rule of its nodes, and what is demanded of them.
struct Case {
    links: Links<SMALL>,
    rule: Rule,
    demand: Demand,
}

const fn rule(subject: &Subject, scheme: Scheme) -> Rule {
    Rule { conditions: subject.notice, ..Rule::new(scheme, RANGE, 0) }
}

/// k-FNF, with k = ∞ taken for 1 where it is sabotaged.
fn farthest(subject: &Subject, k: Option<Count>) -> Rule {
    let is_finite = k.is_none() && subject.sabotage == Sabotage::FiniteForEndless;
    let k = if is_finite { Some(Count::ONE) } else { k };
    rule(subject, Scheme::Farthest { k })
}

/// Among five nodes nobody hears more than three senders besides the first: all k there are.
fn every_k() -> [Option<Count>; 4] {
    [Some(Count::ONE), Count::new(2), Count::new(3), None]
}

/// Every connected network of at most [`SMALL`] nodes, one of each shape as seen from the source, the smallest first.
fn shapes() -> Vec<Links<SMALL>> {
    let mut shapes = Vec::new();
    for nodes in 1..=SMALL {
        let pairs: Vec<(usize, usize)> =
            (0..nodes).flat_map(|one| (one + 1..nodes).map(move |other| (one, other))).collect();
        let orders = orders(nodes);
        let drawn = |set: u32, order: &[usize]| {
            let mut links = Links::NONE;
            for (_, &(one, other)) in pairs.iter().enumerate().filter(|(place, _)| set >> place & 1 == 1) {
                links.add(order[one], order[other]);
            }
            links
        };
        let mut sets: Vec<u32> = (0..1 << pairs.len()).collect();
        sets.sort_by_key(|set| set.count_ones());
        let all = (1 << nodes) - 1;
        let shape = |set: u32| {
            let links = drawn(set, &orders[0]);
            let is_first = || orders.iter().all(|order| links <= drawn(set, order));
            (links.component() == all && is_first()).then_some(links)
        };
        shapes.extend(sets.into_iter().filter_map(shape));
    }
    shapes
}

/// Every order of `nodes` that leaves the source in its place.
fn orders(nodes: usize) -> Vec<Vec<usize>> {
    let mut orders = vec![vec![0]];
    for node in 1..nodes {
        let longer = |order: Vec<usize>| {
            (1..=node).map(move |place| {
                let mut longer = order.clone();
                longer.insert(place, node);
                longer
            })
        };
        orders = orders.into_iter().flat_map(longer).collect();
    }
    orders
}

/// Where in a run a state is looked at.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Point {
    OnTheWay,
    /// Nothing is under way and nobody waits.
    End,
}

/// What is demanded of every state.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Demand {
    /// NOTICE-1
    Tree,
    /// NOTICE-2
    Once,
    /// NOTICE-3
    Floods,
    /// NOTICE-5
    Reaches,
    /// NOTICE-6
    NearestParent,
}

/// The rules under which it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Rules {
    /// Every k that makes a difference.
    EveryK,
    /// k = ∞, and flooding.
    Endless,
    /// One k; 0 is ∞.
    Only(u8),
}

/// Every small network, and every state that it can come to. The choices of a violation are the network with its rule,
/// then event by event.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Networks {
    demand: Demand,
    rules: Rules,
}

/// NOTICE-1
pub const TREE: Networks = Networks { demand: Demand::Tree, rules: Rules::EveryK };
/// NOTICE-2
pub const ONCE: Networks = Networks { demand: Demand::Once, rules: Rules::EveryK };
/// NOTICE-3
pub const FLOOD: Networks = Networks { demand: Demand::Floods, rules: Rules::Endless };
/// NOTICE-5, k = 1
pub const REACH_WITH_ONE: Networks = Networks { demand: Demand::Reaches, rules: Rules::Only(1) };
/// NOTICE-5, k = 2
pub const REACH_WITH_TWO: Networks = Networks { demand: Demand::Reaches, rules: Rules::Only(2) };
/// NOTICE-5, k = ∞
pub const REACH_WITH_ALL: Networks = Networks { demand: Demand::Reaches, rules: Rules::Only(0) };
/// NOTICE-6
pub const NEAREST_PARENT: Networks = Networks { demand: Demand::NearestParent, rules: Rules::EveryK };

/// What is covered by going through every state.
pub const EVENTS: [&str; 4] = ["a NOTICE arrives", "a copy arrives", "a node forwards", "an end"];

impl Demand {
    fn check<const NODES: usize>(
        self,
        links: &Links<NODES>,
        spread: &Spread<NODES>,
        point: Point,
    ) -> Result<(), Stop> {
        let connected = || ones(links.component());
        match (self, point) {
            (Self::Tree, _) => spread.is_tree(),
            (Self::NearestParent, _) => spread.has_nearest_parents(),
            (Self::Once, _) => {
                let is_once = spread.forwards.iter().all(|&forwards| forwards <= 1);
                require(is_once, "a node forwards an event at most once")
            }
            (Self::Floods | Self::Reaches, Point::OnTheWay) => Ok(()),
            (Self::Floods, Point::End) => require(
                connected().all(|node| node == 0 || spread.forwards[node] == 1),
                "everybody connected to the source receives and forwards",
            ),
            (Self::Reaches, Point::End) => require(
                connected().all(|node| spread.nodes[node].event().is_some()),
                "everybody connected to the source receives the event",
            ),
        }
    }
}

impl Case {
    /// What is broken at some point of a run.
    fn broken(&self, spread: &Spread<SMALL>, point: Point) -> Option<&'static str> {
        match self.demand.check(&self.links, spread, point) {
            Err(Stop::Violated(demand)) => Some(demand),
            Ok(()) | Err(Stop::Assumed | Stop::GivenUp) => None,
        }
    }
}

impl System for Case {
    type State = Spread<SMALL>;
    type Key = Spread<SMALL>;
    type Demand = &'static str;

    fn key(&self, spread: &Spread<SMALL>) -> Spread<SMALL> {
        *spread
    }

    fn steps(&self, spread: &Spread<SMALL>) -> impl Iterator<Item = Step<Spread<SMALL>, &'static str>> {
        let step = |event| {
            let state = spread.after(&self.rule, &self.links, event);
            let situation = match event {
                Event::Arrives { .. } => "a NOTICE arrives",
                Event::ArrivesAgain { .. } => "a copy arrives",
                Event::Expires { .. } => "a node forwards",
            };
            let breaks = self.broken(&state, Point::OnTheWay).into_iter().collect();
            Step { state, situation, acting: 0, is_bound: true, breaks }
        };
        spread.events().into_iter().map(step)
    }

    fn broken_at_end(&self, spread: &Spread<SMALL>) -> Option<&'static str> {
        self.broken(spread, Point::End)
    }
}

impl Networks {
    fn cases(self, subject: &Subject) -> impl Iterator<Item = Case> {
        let rules = match self.rules {
            Rules::EveryK => every_k().map(|k| farthest(subject, k)).to_vec(),
            Rules::Endless => vec![farthest(subject, None), rule(subject, Scheme::Flooding)],
            Rules::Only(k) => vec![farthest(subject, Count::new(k))],
        };
        shapes().into_iter().flat_map(move |links| {
            let rules = rules.clone();
            rules.into_iter().map(move |rule| Case { links, rule, demand: self.demand })
        })
    }
}

impl Networks {
    /// What it covers.
    pub fn bound(self) -> String {
        let rules = match self.rules {
            Rules::EveryK => "every k".to_owned(),
            Rules::Endless => "k = ∞ and flooding".to_owned(),
            Rules::Only(0) => "k = ∞".to_owned(),
            Rules::Only(k) => format!("k = {k}"),
        };
        format!("all networks of up to {SMALL} nodes, {rules}, every order")
    }

    /// Goes through all states, until the first violation. A case is a state.
    pub fn explore(self, subject: &Subject) -> Tally {
        let mut tally = Tally::default();
        for (place, case) in (0..).zip(self.cases(subject)) {
            let found = search(&case, [Spread::start(&case.links)], u32::MAX);
            tally.cases += found.looked_at;
            for situation in found.covered {
                cover(&mut tally.covered, situation);
            }
            if let Some(Run { steps, demand, .. }) = found.broken.into_iter().next() {
                tally.violation = Some(([&[place], &steps[..]].concat(), demand));
                break;
            }
        }
        tally
    }

    /// Makes the choices of a violation again.
    pub(crate) fn replay(self, subject: &Subject, mut script: Script<'_>) -> Result<Played, Unfit> {
        let cases: Vec<Case> = self.cases(subject).collect();
        let case = &cases[script.choose(cases.len())?];
        let choices = script.choices();
        let (of, run) = script.play(case, (0, Spread::start(&case.links)), |_| true)?;
        Ok(Played { of, evidence: Evidence::Choices(choices.clone(), run.demand) })
    }

    /// What happens when these choices are made, in lines.
    pub fn story(self, subject: &Subject, choices: &[u32]) -> String {
        let (&place, choices) = choices.split_first().unwrap_or((&0, &[]));
        let Some(Case { links, rule, .. }) = self.cases(subject).nth(place as usize) else {
            return String::new();
        };
        let pairs =
            (0..SMALL).flat_map(|one| ones(links.0[one] >> one).map(move |beyond| (one, one + beyond)));
        let pairs: Vec<String> = pairs.map(|(one, other)| format!("{one}-{other}")).collect();
        let mut lines = vec![format!("The source is 0, the links are {}.", pairs.join(" "))];
        let mut spread = Spread::start(&links);
        for &choice in choices {
            let Some(&event) = spread.events().get(choice as usize) else { break };
            spread = spread.after(&rule, &links, event);
            let became = |node: usize| match spread.nodes[node].stage() {
                Stage::Unaware => "knows nothing",
                Stage::Waiting { .. } => "waits",
                Stage::Silent => "is silent",
                Stage::Forwarded => "has forwarded",
            };
            lines.push(match event {
                Event::Arrives { from, to } => format!("{to} hears {from} and {}.", became(to)),
                Event::ArrivesAgain { from, to } => {
                    format!("{to} hears {from}, not for the last time, and {}.", became(to))
                }
                Event::Expires { at } => format!("{at} forwards."),
            });
        }
        let unaware = ones(links.component()).filter(|&node| spread.nodes[node].event().is_none());
        let unaware: Vec<String> = unaware.map(|node| node.to_string()).collect();
        if spread.events().is_empty() && !unaware.is_empty() {
            lines.push(format!("Nothing more happens; {} has not heard of the event.", unaware.join(" ")));
        }
        lines.join("\n") + "\n"
    }
}

/// The largest of the random networks.
const LARGE: usize = 40;

/// Nodes of a random network.
const NODES: RangeInclusive<usize> = SMALL + 1..=LARGE;

/// Links of a random network, in percent of all pairs of nodes.
const LINKS: RangeInclusive<u32> = 5..=44;

/// What [`tree_at_random`] and its like draw.
pub fn random_networks() -> String {
    format!("{}, k = 1 … {} or ∞", random_nodes(), Count::MOST)
}

/// What [`flood_at_random`] draws.
pub fn random_floods() -> String {
    format!("{}, k = ∞", random_nodes())
}

fn random_nodes() -> String {
    let (nodes, links) = (NODES, LINKS);
    let (fewest, most, thin, dense) = (nodes.start(), nodes.end(), links.start(), links.end());
    format!("random networks of {fewest} to {most} nodes with {thin} to {dense} % links")
}

/// Events after which nothing more is left to chance, so that copies do not go on arriving for ever.
const MOST_EVENTS: usize = 4_000;

/// A random network, a random order and some k, the demand checked after every event.
fn spread_at_random(subject: &Subject, oracle: &mut dyn Oracle, demand: Demand) -> Outcome {
    // k = ∞ is one of them, and for flooding the only one.
    let k = if demand == Demand::Floods { 0 } else { oracle.pick(u32::from(Count::MOST) + 1) };
    let rule = farthest(subject, Count::new(k as u8));
    let nodes = NODES.end() - oracle.pick(NODES.count() as u32) as usize;
    let links_percent = LINKS.start() + oracle.pick(LINKS.count() as u32);
    let mut links = Links::<LARGE>::NONE;
    for one in 0..nodes {
        for other in one + 1..nodes {
            if oracle.pick(100) < links_percent {
                links.add(one, other);
            }
        }
    }
    let mut spread = Spread::start(&links);
    for happened in 0.. {
        let events = spread.events();
        let choice = if happened < MOST_EVENTS { oracle.pick(events.len().max(1) as u32) } else { 0 };
        let Some(&event) = events.get(choice as usize) else { break };
        spread = spread.after(&rule, &links, event);
        demand.check(&links, &spread, Point::OnTheWay)?;
    }
    demand.check(&links, &spread, Point::End)?;
    let forwarded = spread.forwards.iter().filter(|&&forwards| forwards > 0).count();
    Ok(if forwarded * 2 > nodes { "most nodes forward" } else { "few nodes forward" })
}

/// What the random runs cover.
pub const SPREADS: [&str; 2] = ["few nodes forward", "most nodes forward"];

/// NOTICE-1: larger networks, at random.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub fn tree_at_random(subject: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    spread_at_random(subject, oracle, Demand::Tree)
}

/// NOTICE-2: the same.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub fn once_at_random(subject: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    spread_at_random(subject, oracle, Demand::Once)
}

/// NOTICE-6: the same.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub fn nearest_parent_at_random(subject: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    spread_at_random(subject, oracle, Demand::NearestParent)
}

/// NOTICE-3: the same with k = ∞.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub fn flood_at_random(subject: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    spread_at_random(subject, oracle, Demand::Floods)
}

/// What can have become of the event before.
const FATES: [&str; 4] =
    ["unaware of the first", "waiting with the first", "silent about the first", "through with the first"];

/// Later events, their senders and their hop counts.
const LATER: [u32; 3] = [2, 3, 3];

/// What [`second_event`] looks at.
pub fn later_events() -> String {
    let [events, senders, hops] = LATER;
    format!(
        "{} fates of an event, {events} later ones by {senders} senders with {hops} hop counts",
        FATES.len()
    )
}

/// NOTICE-4: whatever a node has made of one event, the next one is new to it.
///
/// # Errors
/// [`Stop`] if the clause is broken.
pub fn second_event(subject: &Subject, oracle: &mut dyn Oracle) -> Outcome {
    let rule = farthest(subject, Some(Count::ONE));
    let mut node = Node::new(NodeId(1), NodeId(0));
    let fate = oracle.pick(FATES.len() as u32);
    match fate {
        0 => {}
        1 => {
            hear(&mut node, &rule, notice(2));
        }
        2 => {
            hear(&mut node, &rule, notice(2));
            hear(&mut node, &rule, notice(3));
        }
        _ => {
            hear(&mut node, &rule, notice(2));
            node.expire(0);
        }
    }
    let [events, senders, most_hops] = LATER;
    let (event, sender) = (2 + oracle.pick(events), 2 + oracle.pick(senders));
    let hops = oracle.pick(most_hops) as u16;
    let reaction = hear(&mut node, &rule, Notice { call: call(event), hops, ..notice(sender as usize) });
    require(reaction == Reaction::Armed { at_ns: 0 }, "the first NOTICE of a newer event begins a wait")?;
    require(node.parent() == Some(NodeId(sender)), "its sender is the parent")?;
    require(node.hops() == Some(hops + 1), "the node is one hop farther than its sender")?;
    Ok(FATES[fate as usize])
}

#[cfg(test)]
mod tests {
    use stateright::{Checker, Model, Property};
    use tautline_kernel::notice::Condition;

    use super::*;

    #[test]
    fn there_is_one_network_of_each_shape() {
        let shapes = shapes();
        let of_size =
            |nodes: u32| shapes.iter().filter(|links| links.component().count_ones() == nodes).count();
        assert_eq!([1, 2, 3, 4, 5].map(of_size), [1, 1, 3, 11, 58]);
    }

    /// The demand that a subject breaks first, and how.
    fn broken(networks: Networks, subject: Subject) -> (&'static str, String) {
        let (choices, demand) = networks.explore(&subject).violation.expect("it is broken");
        (demand, networks.story(&subject, &choices))
    }

    #[test]
    fn a_parent_that_changes_after_forwarding_closes_a_circle() {
        let (demand, _) = broken(TREE, Subject::hearing_without(Condition::FrozenOnceForwarded));
        assert_eq!(demand, "parent by parent every node comes to the source");
    }

    #[test]
    fn a_parent_that_is_the_last_heard_makes_a_tree_all_the_same_but_another() {
        for condition in [Condition::LeastHops, Condition::FirstHeard] {
            let subject = Subject::hearing_without(condition);
            assert_eq!(TREE.explore(&subject).violation, None);
            let (demand, _) = broken(NEAREST_PARENT, subject);
            assert_eq!(demand, "the parent is the first heard of those with the least hop count");
        }
    }

    /// Everything that can happen in a small network, nothing left out.
    impl Model for Case {
        type State = Spread<SMALL>;
        type Action = Event;

        fn init_states(&self) -> Vec<Spread<SMALL>> {
            vec![Spread::start(&self.links)]
        }

        fn actions(&self, spread: &Spread<SMALL>, events: &mut Vec<Event>) {
            events.extend(spread.events());
        }

        fn next_state(&self, spread: &Spread<SMALL>, event: Event) -> Option<Spread<SMALL>> {
            Some(spread.happens(&self.rule, &self.links, event))
        }

        fn properties(&self) -> Vec<Property<Self>> {
            let keeps = |case: &Self, spread: &Spread<SMALL>| {
                let is_end = spread.events().is_empty();
                case.broken(spread, if is_end { Point::End } else { Point::OnTheWay }).is_none()
            };
            vec![Property::always("keeps", keeps)]
        }
    }

    /// The search leaves out what is under way to a node that it no longer changes. Stateright, which is not told to, finds
    /// more states and the same verdicts: what is left out plays no part.
    #[test]
    fn stateright_comes_to_the_same_verdicts_where_nothing_is_left_out() {
        let demands = [Demand::Tree, Demand::Once, Demand::Reaches, Demand::NearestParent];
        let compared = |pairs: &[(usize, usize)], subject: Subject, k: Option<Count>| {
            let mut links = Links::NONE;
            for &(one, other) in pairs {
                links.add(one, other);
            }
            let rule = farthest(&subject, k);
            let broken = demands.into_iter().filter(|&demand| {
                let case = Case { links, rule, demand };
                let found = search(&case, [Spread::start(&links)], u32::MAX);
                let theirs = case.checker().threads(1).spawn_bfs().join();
                assert_eq!(theirs.discovery("keeps").is_some(), !found.broken.is_empty(), "{demand:?}");
                !found.broken.is_empty()
            });
            let broken: Vec<Demand> = broken.collect();
            let case = Case { links, rule, demand: Demand::Once };
            let ours = search(&case, [Spread::start(&links)], u32::MAX).states;
            let theirs = case.checker().threads(1).spawn_bfs().join().unique_state_count();
            (ours, theirs, broken)
        };
        let tail = [(0, 1), (0, 2), (1, 2), (2, 3)];
        let round = [(0, 1), (0, 2), (1, 3), (2, 3)];
        let (one, all) = (Some(Count::ONE), None);
        assert_eq!(compared(&tail, Subject::PUBLISHED, one), (51, 1641, vec![Demand::Reaches]));
        assert_eq!(compared(&tail, Subject::PUBLISHED, all), (84, 2601, vec![]));
        assert_eq!(compared(&round, Subject::PUBLISHED, one), (50, 1601, vec![]));
        let unfrozen = Subject::hearing_without(Condition::FrozenOnceForwarded);
        let broken = vec![Demand::Tree, Demand::NearestParent];
        assert_eq!(compared(&tail, unfrozen, all), (176, 9065, broken));
        let last = Subject::hearing_without(Condition::LeastHops);
        assert_eq!(compared(&tail, last, all), (102, 3561, vec![Demand::NearestParent]));
        let last_of_equals = Subject::hearing_without(Condition::FirstHeard);
        assert_eq!(compared(&round, last_of_equals, all), (70, 2689, vec![Demand::NearestParent]));
    }

    #[test]
    fn who_is_silenced_may_be_the_only_one_on_the_way() {
        let (_, story) = broken(REACH_WITH_ONE, Subject::PUBLISHED);
        let lines: Vec<&str> = story.lines().collect();
        let expected = [
            "The source is 0, the links are 0-1 0-2 1-2 2-3.",
            "1 hears 0 and waits.",
            "2 hears 0 and waits.",
            "1 forwards.",
            "2 hears 1 and is silent.",
            "Nothing more happens; 3 has not heard of the event.",
        ];
        assert_eq!(lines, expected);
    }
}
