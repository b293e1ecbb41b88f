//! The purpose of the silence in step 2 of TAN [Jiang 2011, 3.4], “to prevent interference”, under three readings of
//! the nodes that keep it. TAN-4 is about the first, whose node is the kernel's.
//!
//! A few path nodes and robots stand still, whoever hears whom; a robot asks one node, which hears it. Events are a
//! REQNAV, which all nodes receive that hear the robot, and a third of T_x. A node sends NAV “continually”: after each
//! event whoever hears a node that signals has heard its NAV. No packet is lost.

use core::array::from_fn;
use std::collections::{HashMap, VecDeque};

use tautline_kernel::net::{NodeId, RobotId};
use tautline_kernel::tan::{Guide, Nav, ReqNav};

/// Which nodes keep silent.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Reading {
    /// A node that was asked before goes on, and a silent one that is asked stays silent: the kernel's.
    GoesOn,
    /// A node that was asked before falls silent, too.
    FallsSilent,
    /// A node that was asked before goes on, and a silent one that is asked signals.
    Answers,
}

/// How long a silence lasts.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Silence {
    /// For T_x from the first packet, as in simulated rescues.
    FromFirst,
    /// For T_x from the last packet.
    FromLast,
}

/// T_x, in steps of time.
const STEPS: u8 = 3;

const WFR: NodeId = NodeId(9);

/// Nodes or robots, a bit each.
type Set = u8;

fn has(set: Set, member: usize) -> bool {
    set & (1 << member) != 0
}

/// Who hears whom.
#[derive(Clone, Debug)]
struct Scene {
    /// By node the nodes that hear it.
    links: Vec<Set>,
    /// By robot the node that it asks, and the nodes that hear it.
    robots: Vec<(usize, Set)>,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Event {
    /// A robot asks its node.
    Ask(usize),
    /// A step of time.
    Step,
}

/// By node its conduct and for how many steps more; and the robots whose node has signalled since they asked it.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
struct State {
    guides: Vec<(Guide, u8)>,
    served: Set,
}

/// A breach of what the silence is for, or of a promise to the robot that asked.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Harm {
    /// Two nodes that hear each other signal at once.
    AmongNodes,
    /// A robot that hears its node's signal hears another one, too.
    AtRobot,
    /// A signal ends before T_x has passed.
    CutShort,
}

const HARMS: [Harm; 3] = [Harm::AmongNodes, Harm::AtRobot, Harm::CutShort];

fn requested(reading: Reading, guide: Guide, asked: usize, node: usize) -> Guide {
    let id = |node: usize| NodeId(node as u32);
    let own = Nav { wfr: WFR, node: id(node), hops: 1, parent: WFR };
    match (reading, guide) {
        (Reading::FallsSilent, Guide::Signals(_)) if asked != node => Guide::Silent,
        (Reading::Answers, Guide::Silent) if asked == node => Guide::Signals(own),
        (Reading::GoesOn | Reading::FallsSilent | Reading::Answers, _) => {
            guide.request(ReqNav { wfr: WFR, robot: RobotId(0), node: id(asked) }, id(node), Some(own))
        }
    }
}

fn overheard(reading: Reading, guide: Guide) -> Guide {
    match reading {
        Reading::FallsSilent => Guide::Silent,
        Reading::GoesOn | Reading::Answers => guide.overhear(),
    }
}

impl Scene {
    /// All scenes of so many nodes and robots, in each of which any may be out of hearing of all others.
    fn all(nodes: usize, robots: usize) -> Vec<Self> {
        let pairs: Vec<(usize, usize)> = (0..nodes).flat_map(|a| (0..a).map(move |b| (a, b))).collect();
        let hearing = |node: usize| (0..1_u8 << nodes).filter(move |&heard| has(heard, node));
        let robot: Vec<(usize, Set)> =
            (0..nodes).flat_map(|node| hearing(node).map(move |heard| (node, heard))).collect();
        let mut teams = vec![(0, Vec::new())];
        for _ in 0..robots {
            // Robots that change places make no other scene.
            let more = teams.iter().flat_map(|(from, team): &(usize, Vec<(usize, Set)>)| {
                (*from..robot.len()).map(|kind| (kind, [&team[..], &[robot[kind]]].concat()))
            });
            teams = more.collect();
        }
        let graph = |set: usize| {
            let mut links = vec![0; nodes];
            for &(a, b) in
                pairs.iter().enumerate().filter(|(pair, _)| set & (1 << pair) != 0).map(|(_, pair)| pair)
            {
                (links[a], links[b]) = (links[a] | 1 << b, links[b] | 1 << a);
            }
            links
        };
        let graphs = (0..1 << pairs.len()).map(graph);
        graphs
            .flat_map(|links| {
                teams.iter().map(move |(_, robots)| Self { links: links.clone(), robots: robots.clone() })
            })
            .collect()
    }

    fn nodes(&self, set: Set) -> impl Iterator<Item = usize> {
        (0..self.links.len()).filter(move |&node| has(set, node))
    }

    fn events(&self) -> Vec<Event> {
        (0..self.robots.len()).map(Event::Ask).chain([Event::Step]).collect()
    }

    fn start(&self) -> State {
        State { guides: vec![(Guide::Idle, 0); self.links.len()], served: 0 }
    }

    fn after(&self, (reading, silence): (Reading, Silence), before: &State, event: Event) -> State {
        let mut next = before.clone();
        let falls_silent = |guide: &mut (Guide, u8)| {
            if guide.0 != Guide::Silent || silence == Silence::FromLast {
                *guide = (Guide::Silent, STEPS);
            }
        };
        match event {
            Event::Ask(robot) => {
                let (asked, heard) = self.robots[robot];
                for node in self.nodes(heard) {
                    match requested(reading, before.guides[node].0, asked, node) {
                        Guide::Silent => falls_silent(&mut next.guides[node]),
                        signals @ Guide::Signals(_) if node == asked => next.guides[node] = (signals, STEPS),
                        Guide::Signals(_) | Guide::Idle => {}
                    }
                }
            }
            Event::Step => {
                for (guide, left) in &mut next.guides {
                    *left = left.saturating_sub(1);
                    *guide = if *left == 0 { guide.expire() } else { *guide };
                }
            }
        }
        let signalling = self.nodes(Set::MAX).filter(|&node| next.signals(node)).collect::<Vec<_>>();
        for node in signalling.iter().flat_map(|&from| self.nodes(self.links[from])) {
            if overheard(reading, next.guides[node].0) == Guide::Silent {
                falls_silent(&mut next.guides[node]);
            }
        }
        for (robot, &(node, _)) in self.robots.iter().enumerate() {
            let is_served = next.signals(node) && (has(before.served, robot) || event == Event::Ask(robot));
            next.served = next.served & !(1 << robot) | Set::from(is_served) << robot;
        }
        next
    }

    fn harms(&self, harm: Harm, before: &State, event: Event, after: &State) -> bool {
        let any_signals = |set: Set| self.nodes(set).any(|node| after.signals(node));
        match harm {
            Harm::AmongNodes => {
                self.nodes(Set::MAX).any(|node| after.signals(node) && any_signals(self.links[node]))
            }
            Harm::AtRobot => {
                self.robots.iter().enumerate().any(|(robot, &(node, heard))| {
                    has(after.served, robot) && any_signals(heard & !(1 << node))
                })
            }
            Harm::CutShort => event != Event::Step && before.served & !after.served != 0,
        }
    }
}

impl State {
    fn signals(&self, node: usize) -> bool {
        matches!(self.guides[node].0, Guide::Signals(_))
    }
}

/// All that can happen in a scene.
struct Search<'a> {
    scene: &'a Scene,
    events: Vec<Event>,
    states: Vec<State>,
    /// By state the next one for each event.
    next: Vec<Vec<usize>>,
    /// By state the one before it on a shortest way from the start, and the event.
    from: Vec<Option<(usize, Event)>>,
}

impl<'a> Search<'a> {
    fn new(scene: &'a Scene, rule: (Reading, Silence)) -> Self {
        let start = scene.start();
        let (mut numbers, mut states) = (HashMap::from([(start.clone(), 0)]), vec![start]);
        let (events, mut next, mut from) = (scene.events(), Vec::new(), vec![None]);
        while next.len() < states.len() {
            let at = next.len();
            let after = events.iter().map(|&event| {
                let after = scene.after(rule, &states[at], event);
                *numbers.entry(after.clone()).or_insert_with(|| {
                    states.push(after);
                    from.push(Some((at, event)));
                    states.len() - 1
                })
            });
            let after = after.collect();
            next.push(after);
        }
        Self { scene, events, states, next, from }
    }

    /// The events on the way to a state: a letter for the robot that asks, a dot for a step.
    fn way(&self, mut at: usize) -> String {
        let mut events = Vec::new();
        while let Some((before, event)) = self.from[at] {
            events.push(event);
            at = before;
        }
        told(events)
    }

    /// The fewest events to a harm.
    fn harm(&self, harm: Harm) -> Option<String> {
        let harmed = |(at, after): (usize, &Vec<usize>)| {
            let mut after = self.events.iter().zip(after);
            let is_it = |(event, after): &(&Event, &usize)| {
                self.scene.harms(harm, &self.states[at], **event, &self.states[**after])
            };
            after.find(is_it).map(|(event, _)| self.way(at) + &told(vec![*event]))
        };
        self.next.iter().enumerate().find_map(harmed)
    }

    /// The fewest events to a state, and from there back to it, in which time passes, each robot asks, and no robot's
    /// node signals: so it can go on for ever.
    fn livelock(&self) -> Option<String> {
        let all: Set = (1 << self.events.len()) - 1;
        let is_silent = |state: &State| self.scene.robots.iter().all(|&(node, _)| !state.signals(node));
        let ends = (0..self.states.len()).filter(|&end| is_silent(&self.states[end])).filter_map(|end| {
            let (mut known, mut queue) = (HashMap::new(), VecDeque::from([(end, 0)]));
            while let Some((at, seen)) = queue.pop_front() {
                for (place, &after) in self.next[at].iter().enumerate() {
                    let now = (after, seen | 1 << place);
                    if is_silent(&self.states[after]) && !known.contains_key(&now) {
                        known.insert(now, ((at, seen), self.events[place]));
                        queue.push_back(now);
                    }
                }
            }
            let (mut here, mut lap) = ((end, all), Vec::new());
            while here != (end, 0) {
                let &(before, event) = known.get(&here)?;
                lap.push(event);
                here = before;
            }
            Some(format!("{} {}", self.way(end), told(lap)))
        });
        ends.min_by_key(String::len)
    }
}

/// Events, the last one first, in letters.
fn told(mut events: Vec<Event>) -> String {
    events.reverse();
    let letter = |event: Event| match event {
        Event::Ask(robot) => ["a", "b", "c"][robot],
        Event::Step => ".",
    };
    events.into_iter().map(letter).collect()
}

/// The shortest of each that is found in any scene of so many nodes and robots.
fn shortest<const N: usize>(
    rule: (Reading, Silence),
    (nodes, robots): (usize, usize),
    find: impl Fn(&Search<'_>) -> [Option<String>; N],
) -> [Option<String>; N] {
    let found =
        Scene::all(nodes, robots).iter().map(|scene| find(&Search::new(scene, rule))).collect::<Vec<_>>();
    from_fn(|place| found.iter().filter_map(|found| found[place].clone()).min_by_key(String::len))
}

fn harms(reading: Reading, silence: Silence, size: (usize, usize)) -> [Option<String>; 3] {
    shortest((reading, silence), size, |search| HARMS.map(|harm| search.harm(harm)))
}

fn livelock(reading: Reading, silence: Silence, size: (usize, usize)) -> Option<String> {
    let [lap] = shortest((reading, silence), size, |search| [search.livelock()]);
    lap
}

const BOTH: [Silence; 2] = [Silence::FromFirst, Silence::FromLast];

/// Without their owners, to be compared.
fn words<const N: usize>(found: &[Option<String>; N]) -> [Option<&str>; N] {
    found.each_ref().map(Option::as_deref)
}

#[test]
fn a_node_that_goes_on_is_heard_beside_another_by_a_robot_alone() {
    for silence in BOTH {
        // b hears both nodes, which do not hear each other, and asks after a.
        assert_eq!(words(&harms(Reading::GoesOn, silence, (2, 2))), [None, Some("ab"), None]);
        assert_eq!(words(&harms(Reading::GoesOn, silence, (3, 3))), [None, Some("ac"), None]);
    }
}

#[test]
fn a_node_that_falls_silent_cuts_a_signal_short_and_a_robot_may_still_hear_two() {
    let [first, last] = BOTH.map(|silence| harms(Reading::FallsSilent, silence, (2, 2)));
    assert_eq!(words(&first), [None, Some("b.b..a"), Some("ab")]);
    assert_eq!(words(&last), [None, None, Some("ab")]);
    let [first, last] = BOTH.map(|silence| harms(Reading::FallsSilent, silence, (3, 3)));
    assert_eq!(words(&first), [None, Some("c.c..a"), Some("ac")]);
    assert_eq!(words(&last), [None, Some("b.a..c"), Some("ac")]);
}

#[test]
fn silent_nodes_that_answer_signal_side_by_side() {
    for silence in BOTH {
        assert_eq!(words(&harms(Reading::Answers, silence, (2, 2))), [Some("ab"), Some("ab"), None]);
        assert_eq!(words(&harms(Reading::Answers, silence, (3, 3))), [Some("ac"), Some("ac"), None]);
    }
}

#[test]
fn two_robots_can_keep_each_others_nodes_silent_for_ever_unless_silent_nodes_answer() {
    let of = |reading: Reading, size| BOTH.map(|silence| livelock(reading, silence, size));
    assert_eq!(words(&of(Reading::GoesOn, (2, 2))), [Some("a.a... b..a."), Some("a...b a.b")]);
    assert_eq!(words(&of(Reading::FallsSilent, (2, 2))), [Some("a.b ..a.b"), Some("ab a.b")]);
    assert_eq!(words(&of(Reading::Answers, (2, 2))), [None, None]);
    for reading in [Reading::GoesOn, Reading::FallsSilent, Reading::Answers] {
        assert_eq!(words(&of(reading, (3, 1))), [None, None], "one robot alone is answered");
    }
    assert_eq!(words(&of(Reading::Answers, (2, 3))), [None, None]);
}
