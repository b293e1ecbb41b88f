//! Every small network, and every state that it can come to (NOTICE-1 to NOTICE-6).

use std::fmt;

use tautline_kernel::choice::Oracle;
use tautline_kernel::notice::{Count, Rule, Scheme, Stage};

pub use super::shapes::SMALL;
use super::shapes::shapes;
use super::spread::{Demand, Event, Links, Point, Spread, ones};
use super::{CountOf, Subject};
use crate::decide::{
    Answer, Context, Depiction, DrawnCertificate, Evidence, Method, MethodError, MethodResult,
    RefutationPlay, Size, Systems,
};
use crate::engine::model::StatesModel;
use crate::engine::smallest::{Certificate, ClassFindings};
use crate::engine::states::{AnySystem, Limits, Run, System, search};
use crate::engine::world::{Turn, World, any_of, picked};
use crate::engine::{Choices, Script, ScriptError, Stop, Tally, Until, cover, threads};
use crate::judge::{AnyCase, notice as judge};
use crate::plural::counted;

/// A network, the rule of its nodes, and what is demanded of them.
pub struct Case {
    links: Links<SMALL>,
    rule: Rule,
    counted: CountOf,
    demands: &'static [Demand],
}

/// Among five nodes nobody hears more than three senders besides the first: all k there are.
fn every_k() -> [Option<Count>; 4] {
    [Some(Count::ONE), Count::new(2), Count::new(3), None]
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

impl Rules {
    fn list(self, observed: &Subject) -> Vec<Rule> {
        match self {
            Self::EveryK => every_k().map(|k| observed.farthest(k)).to_vec(),
            Self::Endless => vec![observed.farthest(None), observed.rule(Scheme::Flooding)],
            Self::Only(k) => vec![observed.farthest(Count::new(k))],
        }
    }
}

/// The findings in all networks under one rule, whatever is demanded.
struct Findings {
    rule: Rule,
    /// Without a violation.
    tally: Tally,
    /// The demands that are broken.
    broken: Vec<Demand>,
}

/// Every small network, and every state that it can come to. The choices of a violation are the network with its rule,
/// then event by event.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Networks {
    demand: Demand,
    rules: Rules,
}

/// NOTICE-1
pub(super) const TREE: Networks = Networks { demand: Demand::Tree, rules: Rules::EveryK };
/// NOTICE-2
pub(super) const ONCE: Networks = Networks { demand: Demand::Once, rules: Rules::EveryK };
/// NOTICE-3
pub(super) const FLOOD: Networks = Networks { demand: Demand::Floods, rules: Rules::Endless };
/// NOTICE-5, k = 1
pub(super) const REACH_WITH_ONE: Networks = Networks { demand: Demand::Reaches, rules: Rules::Only(1) };
/// NOTICE-5, k = 2
pub(super) const REACH_WITH_TWO: Networks = Networks { demand: Demand::Reaches, rules: Rules::Only(2) };
/// NOTICE-5, k = ∞
pub(super) const REACH_WITH_ALL: Networks = Networks { demand: Demand::Reaches, rules: Rules::Only(0) };
/// NOTICE-6
pub(super) const NEAREST_PARENT: Networks = Networks { demand: Demand::NearestParent, rules: Rules::EveryK };

/// The situations that going through every state covers.
const EVENTS: [&str; 4] = ["a NOTICE arrives", "a copy arrives", "a node forwards", "an end"];

impl Case {
    /// A network in which these pairs of nodes have a link, of which everything is demanded.
    pub fn new(pairs: impl IntoIterator<Item = (usize, usize)>, rule: Rule) -> Self {
        let mut links = Links::NONE;
        pairs.into_iter().for_each(|(one, other)| links.add(one, other));
        Self { links, rule, counted: CountOf::Senders, demands: &Demand::ALL }
    }

    /// The network after its source has sent.
    pub fn start(&self) -> Spread<SMALL> {
        Spread::start(&self.links, self.counted)
    }

    /// The demands that are broken at some point of a run.
    fn broken(&self, spread: &Spread<SMALL>, point: Point) -> impl Iterator<Item = (Demand, &'static str)> {
        self.demands.iter().filter_map(move |&demand| match demand.check(&self.links, spread, point) {
            Err(Stop::Violated(words)) => Some((demand, words)),
            Ok(()) | Err(Stop::Assumed | Stop::GivenUp) => None,
        })
    }
}

impl World for Case {
    type State = Spread<SMALL>;
    type Plan = Vec<Event>;
    type Event = Event;
    type Demand = (Demand, &'static str);

    fn plan(&self, spread: &mut Spread<SMALL>, _: &[u8]) -> Option<Vec<Event>> {
        any_of(spread.events())
    }

    fn settle(
        &self,
        spread: &mut Spread<SMALL>,
        events: &Vec<Event>,
        _: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> Event {
        let event = picked(events, world);
        *spread = spread.after(&self.rule, &self.links, event);
        event
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<Self::Demand> {
        self.broken(turn.after, Point::OnTheWay).collect()
    }

    /// A demand that can be broken on the way is told there, not at the end once more.
    fn broken_at_end(&self, spread: &Spread<SMALL>, _: &[u8]) -> Vec<Self::Demand> {
        let is_of_ends = |(demand, _): &(Demand, _)| self.demands.len() == 1 || demand.is_of_ends();
        self.broken(spread, Point::End).filter(is_of_ends).collect()
    }

    fn covers(&self) -> Vec<&'static str> {
        EVENTS[..3].to_vec()
    }

    fn occurs(&self, turn: &Turn<'_, Self>) -> u64 {
        match turn.event {
            Event::Arrives { .. } => 1,
            Event::ArrivesAgain { .. } => 1 << 1,
            Event::Expires { .. } => 1 << 2,
        }
    }
}

impl System for Case {
    type Part = Spread<SMALL>;

    fn part(&self, spread: &Spread<SMALL>, _: usize) -> Spread<SMALL> {
        *spread
    }

    fn put(&self, spread: &mut Spread<SMALL>, _: usize, part: &Spread<SMALL>) {
        *spread = *part;
    }

    /// Among several demands the others are looked for.
    fn is_enough(&self, _: Self::Demand) -> bool {
        self.demands.len() == 1
    }
}

/// Networks with so many nodes and links.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Class {
    nodes: u32,
    links: u32,
}

impl Class {
    fn of(Case { links, .. }: &Case) -> Self {
        let ends: u32 = links.0.iter().map(|links| links.count_ones()).sum();
        Self { nodes: links.component().count_ones(), links: ends / 2 }
    }
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}", counted(self.nodes, "node"), counted(self.links, "link"))
    }
}

impl Networks {
    fn cases(self, observed: &Subject) -> impl Iterator<Item = Case> {
        let rules = self.rules.list(observed);
        let (counted, demands) = (observed.counted, self.demand.alone());
        shapes().into_iter().flat_map(move |links| {
            let rules = rules.clone();
            rules.into_iter().map(move |rule| Case { links, rule, counted, demands })
        })
    }

    /// Goes through all states, until the first violation. A case is a state.
    fn explore(self, observed: &Subject) -> Tally {
        let mut tally = Tally::default();
        for (place, case) in (0..).zip(self.cases(observed)) {
            let found = search(&case, [case.start()], Limits::NONE);
            tally.cases += found.looked_at;
            for situation in found.covered {
                cover(&mut tally.covered, situation);
            }
            if let Some(Run { steps, demand: (_, words), .. }) = found.broken.into_iter().next() {
                tally.violation = Some(([&[place], &steps[..]].concat(), words));
                break;
            }
        }
        tally
    }

    /// The tally of the rules of this check, if its demand is kept under them.
    fn kept(self, observed: &Subject, shown: &[Findings]) -> Option<Tally> {
        let rules = self.rules.list(observed);
        let mut tally = Tally::default();
        for Findings { tally: one, broken, .. } in shown.iter().filter(|shown| rules.contains(&shown.rule)) {
            if broken.iter().any(|broken| broken.is_of_ends() == self.demand.is_of_ends()) {
                return None;
            }
            tally.cases += one.cases;
            one.covered.iter().for_each(|situation| cover(&mut tally.covered, situation));
        }
        Some(tally)
    }
}

/// Goes through all states of every small network under every rule that some check is about, once for all demands.
fn show(observed: &Subject) -> Vec<Findings> {
    let mut rules = Rules::EveryK.list(observed);
    rules.push(observed.rule(Scheme::Flooding));
    let shapes = shapes();
    let show = |rule: Rule| {
        let look = |&links: &Links<SMALL>| {
            let case = Case { links, rule, counted: observed.counted, demands: &Demand::ALL };
            search(&case, [case.start()], Limits::NONE)
        };
        let found = threads::each(&shapes, look);
        let mut shown = Findings { rule, tally: Tally::default(), broken: Vec::new() };
        for found in found {
            shown.tally.cases += found.looked_at;
            found.covered.iter().for_each(|situation| cover(&mut shown.tally.covered, situation));
            shown.broken.extend(found.broken.iter().map(|run| run.demand.0));
        }
        shown
    };
    threads::each(rules, show)
}

impl Networks {
    /// The events when these choices are made, in lines.
    fn story(self, observed: &Subject, choices: &[u32]) -> String {
        let (&place, choices) = choices.split_first().unwrap_or((&0, &[]));
        let Some(case) = self.cases(observed).nth(place as usize) else { return String::new() };
        let Case { links, rule, .. } = case;
        let pairs =
            (0..SMALL).flat_map(|one| ones(links.0[one] >> one).map(move |beyond| (one, one + beyond)));
        let pairs: Vec<String> = pairs.map(|(one, other)| format!("{one}-{other}")).collect();
        let mut lines = vec![format!("The source is 0, the links are {}.", pairs.join(" "))];
        let mut spread = case.start();
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

impl Method<Subject> for Networks {
    fn engine(&self) -> &'static str {
        "states"
    }

    fn bound(&self) -> String {
        let rules = match self.rules {
            Rules::EveryK => "every k".to_owned(),
            Rules::Endless => "k = ∞ and flooding".to_owned(),
            Rules::Only(0) => "k = ∞".to_owned(),
            Rules::Only(k) => format!("k = {k}"),
        };
        format!("all networks of up to {SMALL} nodes, {rules}, every order")
    }

    fn family(&self, observed: &Subject) -> Option<String> {
        Some(format!("networks {observed:?}"))
    }

    /// Demands of several clauses on the same networks are looked at in one pass. Each clause looks for its own
    /// violations.
    fn decide(&self, observed: &Subject, until: Until, context: &mut Context<'_, '_>) -> MethodResult {
        let kept = match until {
            Until::Violation => None,
            Until::Exhausted => {
                let shown: Result<&Vec<Findings>, MethodError> =
                    context.cache.recall(*observed, |observed| Ok(show(observed)));
                self.kept(observed, shown?)
            }
        };
        let tally = kept.unwrap_or_else(|| self.explore(observed));
        let mut answer = Answer::of_tally(tally, &EVENTS, self.shows());
        if let Some(evidence) = &mut answer.counterexample {
            evidence.seen = Depiction::Story(self.story(observed, &evidence.choices.once));
        }
        Ok(answer)
    }

    fn systems(&self, observed: &Subject) -> Result<Systems, MethodError> {
        let started = |case| -> Box<dyn AnySystem> {
            Box::new(StatesModel::new(case, |case: &Case| vec![case.start()]))
        };
        Ok(self.cases(observed).map(started).collect())
    }

    fn replay(&self, observed: &Subject, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let mut script = Script::new(choices);
        let cases: Vec<Case> = self.cases(observed).collect();
        let case = &cases[script.choose(cases.len())?];
        let (of, run) = script.play(case, (0, case.start()), |_| true)?;
        let seen = Depiction::Story(self.story(observed, &choices.once));
        Ok(RefutationPlay { of, evidence: Evidence { choices: choices.clone(), demand: run.demand.1, seen } })
    }

    fn size(&self, observed: &Subject, choices: &Choices) -> Option<Size> {
        let (&place, events) = choices.once.split_first()?;
        let case = self.cases(observed).nth(place as usize)?;
        Some((Class::of(&case).to_string(), events.len()))
    }

    /// Fewest nodes first, then links, then events.
    fn smallest(&self, observed: &Subject) -> Result<Option<DrawnCertificate>, MethodError> {
        let cases: Vec<(u32, Case)> = (0..).zip(self.cases(observed)).collect();
        let mut classes: Vec<Class> = cases.iter().map(|(_, case)| Class::of(case)).collect();
        classes.dedup();
        let search = |class| {
            let mut searched = ClassFindings::default();
            for (place, case) in cases.iter().filter(|(_, case)| Class::of(case) == class) {
                let found = search(case, [case.start()], Limits::NONE);
                let run = found.broken.into_iter().next();
                let shortest = run.map(|Run { steps, .. }| {
                    (steps.len(), self.story(observed, &[&[*place], &steps[..]].concat()))
                });
                searched.add(ClassFindings { cases: found.looked_at, is_whole: found.is_whole, shortest });
            }
            Ok::<_, MethodError>(searched)
        };
        Ok(Some(Certificate::in_order(classes, search)?.drawn(|story| story)))
    }

    fn case(&self, observed: &Subject, choices: &Choices) -> Option<Box<dyn AnyCase>> {
        let (Demand::Reaches, Rules::Only(k @ 1..), CountOf::Senders) =
            (self.demand, self.rules, observed.counted)
        else {
            return None;
        };
        let (&place, choices) = choices.once.split_first()?;
        let case = self.cases(observed).nth(place as usize)?;
        let (mut spread, mut steps) = (case.start(), Vec::new());
        let Case { links, rule, .. } = case;
        for &choice in choices {
            let event = *spread.events().get(choice as usize)?;
            spread = spread.after(&rule, &links, event);
            let (node, from, comes_again) = match event {
                Event::Arrives { from, to } => (to, Some(from), false),
                Event::ArrivesAgain { from, to } => (to, Some(from), true),
                Event::Expires { at } => (at, None, false),
            };
            steps.push(judge::Step { node, from, comes_again });
        }
        let nodes = links.component().count_ones() as usize;
        let pairs = (0..nodes).flat_map(|one| ones(links.0[one]).map(move |other| (one, other)));
        let network = judge::Network { nodes, links: pairs.filter(|(one, other)| one < other).collect() };
        Some(Box::new(judge::Spread { clause: "NOTICE-5", k: k.into(), network, steps }))
    }
}

#[cfg(test)]
mod tests {
    use stateright::{Checker, Model, Property};
    use tautline_kernel::notice::Condition;

    use super::super::spread::Event;

    use super::*;

    /// The demand that a observed breaks first, and how.
    fn broken(networks: Networks, observed: Subject) -> (&'static str, String) {
        let (choices, demand) = networks.explore(&observed).violation.expect("it is broken");
        (demand, networks.story(&observed, &choices))
    }

    #[test]
    fn a_parent_that_changes_after_forwarding_closes_a_circle() {
        let (demand, _) = broken(TREE, Subject::hearing_without(Condition::FrozenOnceForwarded));
        assert_eq!(demand, "parent by parent every node comes to the source");
    }

    #[test]
    fn a_parent_that_is_the_last_heard_makes_a_tree_all_the_same_but_another() {
        for condition in [Condition::LeastHops, Condition::FirstHeard] {
            let observed = Subject::hearing_without(condition);
            assert_eq!(TREE.explore(&observed).violation, None);
            let (demand, _) = broken(NEAREST_PARENT, observed);
            assert_eq!(demand, "the parent is the first heard of those with the least hop count");
        }
    }

    /// Everything that can happen in a small network, nothing left out.
    impl Model for Case {
        type State = Spread<SMALL>;
        type Action = Event;

        fn init_states(&self) -> Vec<Spread<SMALL>> {
            vec![self.start()]
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
                case.broken(spread, if is_end { Point::End } else { Point::OnTheWay }).next().is_none()
            };
            vec![Property::always("keeps", keeps)]
        }
    }

    /// The search leaves out what is under way to a node that it no longer changes. Stateright, which is not told to,
    /// finds more states and the same verdicts: what is left out plays no part.
    #[test]
    fn stateright_comes_to_the_same_verdicts_where_nothing_is_left_out() {
        let demands = [Demand::Tree, Demand::Once, Demand::Reaches, Demand::NearestParent];
        let compared = |pairs: &[(usize, usize)], observed: Subject, k: Option<Count>| {
            let mut links = Links::NONE;
            for &(one, other) in pairs {
                links.add(one, other);
            }
            let (rule, counted) = (observed.farthest(k), observed.counted);
            let asked = |demand: Demand| Case { links, rule, counted, demands: demand.alone() };
            let broken = demands.into_iter().filter(|&demand| {
                let case = asked(demand);
                let found = search(&case, [case.start()], Limits::NONE);
                let theirs = case.checker().threads(1).spawn_bfs().join();
                assert_eq!(theirs.discovery("keeps").is_some(), !found.broken.is_empty(), "{demand:?}");
                !found.broken.is_empty()
            });
            let broken: Vec<Demand> = broken.collect();
            let case = asked(Demand::Once);
            let ours = search(&case, [case.start()], Limits::NONE).states;
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

    /// Where k counts packets, the copy of one silences the only node on the way: three nodes in a row are enough.
    #[test]
    fn a_packet_that_comes_twice_silences_the_only_node_on_the_way() {
        let packets = Subject { counted: CountOf::Packets, ..Subject::PUBLISHED };
        let (_, story) = broken(REACH_WITH_ONE, packets);
        let expected = "The source is 0, the links are 0-1 1-2.\n1 hears 0, not for the last time, and waits.\n\
                        1 hears 0 and is silent.\nNothing more happens; 2 has not heard of the event.\n";
        assert_eq!(story, expected);
    }

    /// The way of counting plays no part in who is whose parent, and who forwards does so once. Of five nodes the
    /// states would be too many.
    #[test]
    fn where_packets_are_counted_parents_make_the_same_kind_of_tree() {
        let packets = Subject { counted: CountOf::Packets, ..Subject::PUBLISHED };
        let rule = packets.farthest(Some(Count::ONE));
        for links in shapes().into_iter().filter(|links| links.component().count_ones() < SMALL as u32) {
            let case = Case { links, rule, counted: packets.counted, demands: &Demand::ALL };
            let found = search(&case, [case.start()], Limits::NONE);
            assert!(found.broken.iter().all(|run| run.demand.0.is_of_ends()), "{links:?}");
        }
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
