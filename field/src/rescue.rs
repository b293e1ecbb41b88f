//! Rescues end to end over the radio field [Jiang 2011, 3.2 to 3.4]: nodes at random places call for help, each its
//! event under its epoch, by a broadcast scheme; robots hear, ask by MOVE from parent to parent, are chosen by RESB,
//! and find their way from path node to path node. Robots, nodes that wait for rescue (WFRs), path nodes and guides are
//! the kernel's; what is added here is time, places, and what goes wrong.
//!
//! Everything left to chance is asked of an `Oracle`: the same [`Setting`] and seed make the same rescue on every
//! machine. While it runs, what the clauses MRC-1 to MRC-9 demand is looked at after every turn.

mod acks;
mod agenda;
mod event;
mod judge;
mod pace;
mod problem;
mod report;
mod rover;
mod scenario;
mod setting;
mod summary;
mod timers;
pub mod trace;
mod world;

pub use event::{Event, LogEntry, Millimetres, Ordinal};
pub use judge::Violation;
pub use problem::Problem;
pub use report::{Fate, Fix, Journey, Packets, Report, Spread};
pub use setting::{CallTimes, MAX_EVENTS, MAX_ROBOTS, MAX_WFRS, SchemeName, Setting};
pub use summary::{Assignments, ClauseViolation, RobotFailures, Summary, seconds};
pub use world::rescue;

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tautline_kernel::mrc::{Condition, Rule};
    use tautline_kernel::net::NodeId;
    use tautline_kernel::notice::{self, Scheme};
    use tautline_proofs::engine::SeededOracle;
    use tautline_proofs::mrc::Demand;

    use super::scenario::{Caller, Place, Scenario};
    use super::*;
    use crate::radio::{
        self, Area, Channel, ChannelName, FREE_SPACE, Faults, Field, Model, Network, Point, Radio,
    };
    use crate::tan::{Equipment, Signal};
    use tautline_sim::explore::RuleName;

    /// Three robots, three WFRs, one message in ten lost on each link, one robot failing.
    fn setting(rule: RuleName) -> Setting {
        Setting {
            rule,
            scheme: SchemeName::KFnf,
            k: 1,
            nodes: 700,
            area_m: [300.0, 300.0],
            range_m: 25.0,
            obstacles_m: vec![],
            wfrs: 3,
            wfrs_at: vec![],
            robots: 3,
            robots_at_m: vec![],
            events_per_wfr: 1,
            calls: CallTimes::Together,
            channel: ChannelName::Ideal,
            loss: 0.1,
            shadowing_db: 0.0,
            exponent: FREE_SPACE,
            noise_db: 0.0,
            failing: 1,
            failing_nodes: 0,
        }
    }

    fn is_served_once(fate: &Fate) -> bool {
        matches!(fate, Fate::Served { visits: 1, .. })
    }

    fn breaks(report: &Report, demand: Demand) -> bool {
        report.violations.iter().any(|violation| violation.demand == demand)
    }

    #[test]
    fn with_losses_and_a_robot_failing_every_wfr_is_served_once_repaired_and_half_the_rescues_fail_as_published()
     {
        let of_a_hundred = |rule: RuleName, is_counted: &dyn Fn(&Report) -> bool| {
            let rescues = (0..100).map(|seed| rescue(&setting(rule), seed).expect("a rescue"));
            rescues.filter(is_counted).count()
        };
        let is_good =
            |report: &Report| report.fates.iter().all(is_served_once) && report.violations.is_empty();
        assert_eq!(of_a_hundred(RuleName::Repaired, &is_good), 100);
        let is_served = |report: &Report| report.fates.iter().all(is_served_once);
        assert_eq!(of_a_hundred(RuleName::Published, &is_served), 52);
    }

    #[test]
    fn with_losses_and_a_robot_failing_every_event_is_served_once_repaired_and_no_second_as_published() {
        let counts = |rule: RuleName| {
            let setting = Setting { events_per_wfr: 3, ..setting(rule) };
            let rescues: Vec<Report> =
                (0..30).map(|seed| rescue(&setting, seed).expect("a rescue")).collect();
            assert!(rescues.iter().all(|report| report.fates.len() == 9));
            let of_event = |event: usize| {
                let fates = rescues.iter().flat_map(|report| report.fates.iter().skip(event).step_by(3));
                fates.filter(|fate| is_served_once(fate)).count()
            };
            let broken = |demand: Demand| rescues.iter().filter(|report| breaks(report, demand)).count();
            ([0, 1, 2].map(of_event), Demand::ALL.map(broken))
        };
        assert_eq!(counts(RuleName::Repaired), ([90, 90, 90], [0; 9]));
        let (served, broken) = counts(RuleName::Published);
        assert_eq!((served, broken), ([74, 0, 0], [1, 0, 0, 30, 30, 30, 0, 0, 0]));
    }

    #[test]
    fn the_first_event_is_the_same_however_many_follow() {
        let told = |events_per_wfr: usize| {
            let setting = Setting { events_per_wfr, ..setting(RuleName::Repaired) };
            rescue(&setting, 3).expect("a rescue").log
        };
        let (once, thrice) = (told(1), told(3));
        let second = thrice.iter().position(|logged| matches!(logged.event, Event::Recurs { .. }));
        let second = second.expect("a second event");
        assert!(second > 50);
        assert_eq!(once[..second], thrice[..second]);
    }

    #[test]
    fn the_same_seed_makes_the_same_rescue_and_another_another() {
        for channel in [ChannelName::Ideal, ChannelName::Shared] {
            let setting = Setting { channel, noise_db: 1.0, ..setting(RuleName::Repaired) };
            let rescues = [4, 4, 5].map(|seed| rescue(&setting, seed).expect("a rescue"));
            assert_eq!(rescues[0], rescues[1]);
            assert_ne!(rescues[0].log, rescues[2].log);
        }
    }

    /// A rescue under a rule that is wrong in one thing.
    fn under(rule: Rule, setting: &Setting, seed: u64) -> Report {
        let scenario = setting.lay_out(&mut SeededOracle::new(seed, 0)).expect("a scenario");
        Scenario { rule, ..scenario }.rescue(&mut SeededOracle::new(seed, 1)).expect("a rescue")
    }

    #[test]
    fn the_judge_sees_what_conditions_are_for() {
        let setting = &Setting { calls: CallTimes::Spread, ..setting(RuleName::Repaired) };
        let rescues = |rule: Rule| (0..60).map(move |seed| under(rule, setting, seed));
        let found = |rule: Rule, demand: Demand| rescues(rule).any(|report| breaks(&report, demand));
        let repaired: Vec<Report> = rescues(Rule::REPAIRED).collect();
        for (condition, demand) in [
            (Condition::NearestRobot, Demand::BestOfTheWindow),
            (Condition::ChoiceStands, Demand::OneRobotForACall),
            (Condition::Epochs, Demand::AsksAnew),
            (Condition::Consent, Demand::CountsOnConsent),
            (Condition::Renewal, Demand::IsServed),
            (Condition::NearestCall, Demand::AsksNearest),
            (Condition::AnswersAgain, Demand::TellsWhoAsked),
        ] {
            assert!(found(Rule::REPAIRED.without(condition), demand), "{condition:?}");
            assert!(!repaired.iter().any(|report| breaks(report, demand)), "{condition:?}");
        }
        assert!(found(Rule::PUBLISHED, Demand::OneRobotForACall));
    }

    /// Nothing is broken but, perhaps, that all are served in time, and nobody comes twice.
    fn safe(report: &Report) -> Result<(), TestCaseError> {
        for violation in &report.violations {
            prop_assert_eq!(violation.demand, Demand::IsServed);
        }
        for fate in &report.fates {
            let came_twice = matches!(fate, Fate::Served { visits: 2.., .. });
            prop_assert!(!came_twice);
        }
        Ok(())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        #[test]
        fn repaired_nothing_is_broken_and_nobody_comes_twice_whatever_goes_wrong(
            seed in any::<u64>(),
            nodes in 40_usize..300,
            (robots, wfrs) in (1_usize..5, 1_usize..5),
            (loss, noise_db) in (0.0..0.3, 0.0..3.0),
            (failing, failing_nodes, events_per_wfr) in (0_usize..2, 0_usize..30, 1_usize..4),
            (is_shared, is_spread, has_lake) in any::<(bool, bool, bool)>(),
            scheme in prop::sample::select(vec![
                SchemeName::KFnf, SchemeName::Flooding, SchemeName::Counter, SchemeName::Distance, SchemeName::Sba,
            ]),
        ) {
            let setting = Setting {
                scheme,
                nodes,
                area_m: [120.0, 90.0],
                obstacles_m: if has_lake { vec![[40.0, 30.0, 70.0, 50.0]] } else { vec![] },
                wfrs,
                robots,
                events_per_wfr,
                calls: if is_spread { CallTimes::Spread } else { CallTimes::Together },
                channel: if is_shared { ChannelName::Shared } else { ChannelName::Ideal },
                loss,
                noise_db,
                failing,
                failing_nodes,
                ..setting(RuleName::Repaired)
            };
            let report = rescue(&setting, seed).expect("a rescue");
            safe(&report)?;
            prop_assert_eq!(report.fates.len(), wfrs * events_per_wfr);
            for fates in report.fates.chunks(events_per_wfr) {
                // The next event comes when the one before is served.
                let is_served = |fate: &Fate| matches!(fate, Fate::Served { .. });
                let served = fates.iter().take_while(|fate| is_served(fate)).count();
                prop_assert!(fates.iter().skip(served + 1).all(|&fate| fate == Fate::StillToCome));
            }
            prop_assert!(report.log.is_sorted_by_key(|logged| logged.at_ns));
            for journey in &report.journeys {
                let shortest_m = journey.shortest_m.expect("one lake is no barrier");
                prop_assert!(journey.moved_m >= shortest_m - 2.0, "{:?}", journey);
            }
        }

        #[test]
        fn repaired_nothing_is_broken_and_nobody_comes_twice_under_shadows(
            seed in any::<u64>(),
            (robots, wfrs, failing) in (1_usize..4, 1_usize..4, 0_usize..2),
            (loss, noise_db) in (0.0..0.2, 0.0..2.0),
            (shadowing_db, exponent) in (0.1..8.0, 2.0..5.0),
            (is_shared, has_lake) in any::<(bool, bool)>(),
        ) {
            let setting = Setting {
                nodes: 120,
                area_m: [120.0, 90.0],
                obstacles_m: if has_lake { vec![[40.0, 30.0, 70.0, 50.0]] } else { vec![] },
                wfrs,
                robots,
                channel: if is_shared { ChannelName::Shared } else { ChannelName::Ideal },
                loss,
                shadowing_db,
                exponent,
                noise_db,
                failing,
                ..setting(RuleName::Repaired)
            };
            let report = rescue(&setting, seed).expect("a rescue");
            safe(&report)?;
        }
    }

    #[test]
    fn under_shadows_links_are_others_and_every_wfr_is_served_all_the_same() {
        let setting = Setting { shadowing_db: 4.0, exponent: 3.0, ..setting(RuleName::Repaired) };
        let lies_beyond = |scenario: &Scenario| {
            let place = |node: NodeId| scenario.field.nodes()[node.0 as usize];
            let nodes = (0..700).map(NodeId).flat_map(|node| {
                scenario.network.neighbours(node).iter().map(move |&other| (place(node), place(other)))
            });
            nodes.filter(|(one, other)| libm::hypot(one.x_m - other.x_m, one.y_m - other.y_m) > 25.0).count()
        };
        let of_scenario =
            |setting: &Setting| setting.lay_out(&mut SeededOracle::new(0, 0)).expect("a scenario");
        let plain = Setting { shadowing_db: 0.0, ..setting.clone() };
        assert_eq!(lies_beyond(&of_scenario(&plain)), 0);
        assert!(lies_beyond(&of_scenario(&setting)) > 1_000);
        for seed in 0..20 {
            let report = rescue(&setting, seed).expect("a rescue");
            assert!(report.fates.iter().all(is_served_once) && report.violations.is_empty(), "seed {seed}");
        }
    }

    #[test]
    fn without_shadows_and_noise_the_exponent_changes_no_link_and_no_fate() {
        let of = |exponent: f64| {
            let report = rescue(&Setting { exponent, ..setting(RuleName::Repaired) }, 2).expect("a rescue");
            (report.spreads, report.fates)
        };
        assert_eq!(of(2.0), of(3.5));
    }

    #[test]
    fn a_robot_has_the_shadows_of_the_node_at_which_it_was_last() {
        let setting = Setting { shadowing_db: 4.0, exponent: 3.0, ..setting(RuleName::Repaired) };
        let scenario = setting.lay_out(&mut SeededOracle::new(0, 0)).expect("a scenario");
        let place = NodeId(9);
        let at = scenario.field.nodes()[9];
        let mut links = scenario.network.links(place).peekable();
        assert!(links.peek().is_some());
        for link in links {
            let heard = scenario
                .link(link.to, scenario.signal(link.to, Some(place)), at)
                .expect("it hears whom the node hears");
            assert!(heard.distance_um.abs_diff(link.distance_um) <= 1);
            let plain = scenario.signal(link.to, None);
            assert_eq!(plain, Signal::plain(scenario.field.nodes()[link.to.0 as usize]));
        }
        let far = (0..700).map(NodeId).find(|&node| scenario.network.distance_um(place, node).is_none());
        let far = far.expect("a node that is not linked");
        assert_eq!(scenario.signal(far, Some(place)), scenario.signal(far, None));
    }

    #[test]
    fn every_node_that_a_robot_hears_is_near_it_and_few_others_are() {
        for (shadowing_db, most) in [(0.0, 200), (12.0, 700)] {
            let setting = Setting { shadowing_db, exponent: 3.0, ..setting(RuleName::Repaired) };
            let scenario = setting.lay_out(&mut SeededOracle::new(0, 0)).expect("a scenario");
            let nodes = || (0..700).map(NodeId);
            let mut heard = 0;
            for (place, at) in nodes().zip(scenario.field.nodes()).step_by(7) {
                for away_m in [-150.0, -40.0, 0.0, 40.0, 150.0] {
                    let at = Point { x_m: at.x_m + away_m, y_m: at.y_m - away_m / 2.0 };
                    let near = scenario.grid.nodes_near(at);
                    assert!(near.is_sorted() && near.len() <= most);
                    let hears = |node| scenario.link(node, scenario.signal(node, Some(place)), at).is_some();
                    let all = nodes().filter(|&node| hears(node));
                    heard += all.inspect(|node| assert!(near.contains(node), "{at:?}, {node:?}")).count();
                }
            }
            assert!(heard > 1_000, "{heard}");
        }
    }

    /// Nodes at these places, WFR the first, that flood; robots at these, some of which fail.
    fn row(
        rule: Rule,
        nodes: &[(f64, f64)],
        robots: &[(f64, Option<u64>)],
        failing: &[(u32, u64)],
    ) -> Scenario {
        let area = Area::new(200.0, 20.0).expect("an area");
        let nodes = nodes.iter().map(|&(x_m, y_m)| Point { x_m, y_m }).collect();
        let field = Field::new(area, vec![], nodes).expect("a field");
        let radio = Radio::new(25.0, Model::Disc).expect("a radio");
        let network = Network::new(&field, radio, &mut SeededOracle::new(0, 0)).expect("a network");
        let range_um = std::num::NonZeroU32::new(25_000_000).expect("a range");
        let second = |at: u64| at * 1_000_000_000;
        Scenario {
            rule,
            broadcast: notice::Rule::new(Scheme::Flooding, range_um, 100_000_000),
            radio,
            noise_db: 0.0,
            equipment: Equipment::new(radio, 0.0).expect("an equipment"),
            wfrs: vec![Caller::new(&network, NodeId(0), 0)],
            robots: robots
                .iter()
                .map(|&(x_m, fails)| Place { at: Point { x_m, y_m: 10.0 }, fails_ns: fails.map(second) })
                .collect(),
            failing: failing.iter().map(|&(node, at)| (NodeId(node), second(at))).collect(),
            channel: Channel::Ideal,
            faults: Faults::NONE,
            grid: Scenario::grid(&field, radio),
            field,
            network,
        }
    }

    fn events(report: &Report) -> Vec<Event> {
        report.log.iter().map(|logged| logged.event).collect()
    }

    const ROW: [(f64, f64); 4] = [(10.0, 10.0), (30.0, 10.0), (50.0, 10.0), (70.0, 10.0)];

    #[test]
    fn the_nearest_robot_comes_from_node_to_node_and_only_it() {
        let report = row(Rule::REPAIRED, &ROW, &[(85.0, None), (60.0, None)], &[])
            .rescue(&mut SeededOracle::new(0, 0))
            .expect("a rescue");
        assert_eq!(report.fates, [Fate::Served { by: 1, visits: 1 }]);
        let who = |event: Event| {
            if let Event::Passes { robot, node, .. } = event { Some((robot, node)) } else { None }
        };
        let passed: Vec<(Ordinal, u32)> = events(&report).into_iter().filter_map(who).collect();
        assert_eq!(passed, [(Ordinal(1), 2), (Ordinal(1), 1)]);
        let [journey] = &report.journeys[..] else { panic!("one journey") };
        assert!((journey.moved_m - 50.0).abs() < 1.0, "{journey:?}");
        assert_eq!(journey.shortest_m.map(f64::round), Some(50.0));
        assert_eq!(report.spreads, [Spread { reached: 4, component: 4, rebroadcasts: 3 }]);
    }

    #[test]
    fn when_the_robot_on_its_way_fails_the_lease_lapses_and_another_comes_but_not_as_published() {
        let fate = |rule: Rule| {
            let scenario = row(rule, &ROW, &[(85.0, None), (60.0, Some(20))], &[]);
            let report = scenario.rescue(&mut SeededOracle::new(0, 0)).expect("a rescue");
            (report.fates[0], breaks(&report, Demand::IsServed))
        };
        assert_eq!(fate(Rule::REPAIRED), (Fate::Served { by: 0, visits: 1 }, false));
        assert_eq!(fate(Rule::PUBLISHED), (Fate::Abandoned, true));
    }

    #[test]
    fn a_robot_that_has_lost_its_way_is_free_when_its_lease_has_lapsed_and_comes_another_way() {
        // Nodes 2 and 4, side by side, connect the two ends; one of them is the guide when it fails.
        let nodes = [&ROW[..], &[(50.0, 18.0)]].concat();
        let served = Fate::Served { by: 0, visits: 1 };
        let of_either = |rule: Rule, is_end: fn(&Event) -> bool| {
            let mut fates = [[(2, 25)], [(4, 25)]].map(|failing| {
                let scenario = row(rule, &nodes, &[(85.0, None)], &failing);
                let report = scenario.rescue(&mut SeededOracle::new(0, 0)).expect("a rescue");
                (report.fates[0], events(&report).iter().any(is_end))
            });
            fates.sort_by_key(|&(_, has_ended)| has_ended);
            fates
        };
        let lets_go = |event: &Event| matches!(event, Event::LetsGo { .. });
        assert_eq!(of_either(Rule::REPAIRED, lets_go), [(served, false), (served, true)]);
        let is_lost = |event: &Event| matches!(event, Event::LosesItsWay { .. });
        assert_eq!(of_either(Rule::PUBLISHED, is_lost), [(served, false), (Fate::Abandoned, true)]);
    }

    #[test]
    fn as_published_the_robot_beside_the_wfr_stays_deaf_to_its_second_event() {
        let outcome = |rule: Rule| {
            let mut scenario = row(rule, &ROW, &[(60.0, None)], &[]);
            scenario.wfrs[0].pauses_ns = vec![100_000_000_000];
            let report = scenario.rescue(&mut SeededOracle::new(0, 0)).expect("a rescue");
            let journeys: Vec<(usize, f64)> =
                report.journeys.iter().map(|journey| (journey.event, journey.moved_m.round())).collect();
            let found = [Demand::AsksAnew, Demand::IsServed]
                .map(|demand| report.violations.iter().any(|one| (one.demand, one.event) == (demand, 1)));
            (report.fates, journeys, found)
        };
        let served = Fate::Served { by: 0, visits: 1 };
        assert_eq!(
            outcome(Rule::REPAIRED),
            (vec![served, served], vec![(0, 50.0), (1, 0.0)], [false, false])
        );
        assert_eq!(outcome(Rule::PUBLISHED), (vec![served, Fate::Abandoned], vec![(0, 50.0)], [true, true]));
    }

    #[test]
    fn without_numbers_nodes_do_not_send_the_second_event_on() {
        let outcome = |conditions: notice::Conditions| {
            // The robot that serves the first event fails before the second; the other one is three hops off.
            let mut scenario = row(Rule::REPAIRED, &ROW, &[(85.0, None), (60.0, Some(100))], &[]);
            scenario.wfrs[0].pauses_ns = vec![100_000_000_000];
            scenario.broadcast.conditions = conditions;
            let report = scenario.rescue(&mut SeededOracle::new(0, 0)).expect("a rescue");
            let spreads: Vec<u32> = report.spreads.iter().map(|spread| spread.reached).collect();
            (report.fates, spreads)
        };
        let served = |by: usize| Fate::Served { by, visits: 1 };
        assert_eq!(outcome(notice::Conditions::REPAIRED), (vec![served(1), served(0)], vec![4, 4]));
        assert_eq!(outcome(notice::Conditions::PUBLISHED), (vec![served(1), Fate::Unheard], vec![4, 1]));
    }

    #[test]
    fn nodes_that_failed_before_the_call_and_those_behind_them_are_not_connected() {
        let mut scenario = row(Rule::REPAIRED, &ROW, &[(20.0, None)], &[(2, 100)]);
        scenario.wfrs[0].pauses_ns = vec![100_000_000_000];
        let report = scenario.rescue(&mut SeededOracle::new(0, 0)).expect("a rescue");
        let spreads = report.spreads.iter().map(|spread| (spread.reached, spread.component));
        assert_eq!(spreads.collect::<Vec<_>>(), [(4, 4), (2, 2)]);
    }

    #[test]
    fn whom_nobody_can_reach_or_has_heard_of_is_told_apart() {
        let alone = row(Rule::REPAIRED, &ROW, &[(150.0, None)], &[]);
        let fates =
            |scenario: Scenario| scenario.rescue(&mut SeededOracle::new(0, 0)).expect("a rescue").fates;
        assert_eq!(fates(alone), [Fate::CutOff]);
        let dead = row(Rule::REPAIRED, &ROW, &[(60.0, Some(0))], &[]);
        assert_eq!(fates(dead), [Fate::CutOff]);
        let mut deaf = row(Rule::REPAIRED, &ROW, &[(85.0, None)], &[]);
        // Whoever hears the WFR is nearer than the threshold, and silent.
        deaf.broadcast.scheme = Scheme::Distance { least_um: 25_000_000 };
        assert_eq!(fates(deaf), [Fate::Unheard]);
    }

    #[test]
    fn what_makes_no_rescue_is_refused() {
        let good = || setting(RuleName::Repaired);
        let field = |setting, problem: radio::Problem| (setting, Problem::Field(problem));
        let counter = Setting { scheme: SchemeName::Counter, k: 8, ..good() };
        let robots_at_m = |robots_at_m| Setting { robots_at_m, ..good() };
        let lake = Setting { obstacles_m: vec![[0.0, 0.0, 9.0, 9.0]], ..robots_at_m(vec![[1.0, 1.0]]) };
        let (probability, deviation_db) = (1.5, 20.5);
        let cases = [
            field(Setting { nodes: 1, ..good() }, radio::Problem::Nodes { nodes: 1 }),
            field(Setting { range_m: 0.0, ..good() }, radio::Problem::Range { range_m: 0.0 }),
            field(Setting { loss: probability, ..good() }, radio::Problem::Probability { probability }),
            field(Setting { noise_db: -1.0, ..good() }, radio::Problem::Deviation { deviation_db: -1.0 }),
            field(
                Setting { shadowing_db: deviation_db, ..good() },
                radio::Problem::Deviation { deviation_db },
            ),
            field(Setting { exponent: 1.9, ..good() }, radio::Problem::Exponent { exponent: 1.9 }),
            field(Setting { wfrs_at: vec![700], ..good() }, radio::Problem::NoNode { node: 700, nodes: 700 }),
            (Setting { k: 0, ..good() }, Problem::K { k: 0, scheme: SchemeName::KFnf, most: 8 }),
            (counter, Problem::K { k: 8, scheme: SchemeName::Counter, most: 7 }),
            (Setting { wfrs: 0, ..good() }, Problem::Wfrs { wfrs: 0, nodes: 700 }),
            (Setting { wfrs: 17, ..good() }, Problem::Wfrs { wfrs: 17, nodes: 700 }),
            (Setting { nodes: 2, ..good() }, Problem::WfrsOfNodes { wfrs: 3, nodes: 2 }),
            (Setting { wfrs_at: vec![5, 6, 5], ..good() }, Problem::WfrTwice { node: 5 }),
            (Setting { wfrs_at: vec![1, 2, 3, 4], ..good() }, Problem::WfrPlaces { places: 4, wfrs: 3 }),
            (Setting { events_per_wfr: 0, ..good() }, Problem::Events { events: 0 }),
            (Setting { events_per_wfr: 17, ..good() }, Problem::Events { events: 17 }),
            (Setting { robots: 17, ..good() }, Problem::Robots { robots: 17 }),
            (robots_at_m(vec![[0.0; 2]; 4]), Problem::RobotPlaces { places: 4, robots: 3 }),
            (
                robots_at_m(vec![[1.0, 1.0], [1.0, 301.0]]),
                Problem::RobotOutside { robot: 2, x_m: 1.0, y_m: 301.0 },
            ),
            (lake, Problem::RobotBlocked { robot: 1 }),
            (Setting { failing: 4, ..good() }, Problem::Failing { failing: 4, robots: 3 }),
            (Setting { failing_nodes: 698, ..good() }, Problem::FailingNodes { failing: 698, others: 697 }),
            (
                Setting { nodes: 1_000_000, wfrs: 5, ..good() },
                Problem::TooLarge { nodes: 1_000_000, wfrs: 5 },
            ),
        ];
        for (setting, problem) in cases {
            assert_eq!(rescue(&setting, 0).map(|_| ()), Err(problem));
        }
        let nowhere = rescue(&robots_at_m(vec![[f64::NAN, 1.0]]), 0);
        assert!(matches!(nowhere, Err(Problem::RobotOutside { robot: 1, .. })));
    }
}
