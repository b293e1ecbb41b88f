//! A robot on its whole way by TAN, and a node that guides robots, once more in few words (TAN-3, TAN-4): what is
//! asked, how the antenna is read, when a robot goes back, and when a node keeps silent, follow from lists of what
//! happened.

use tautline_kernel::choice::{Oracle, one_of};
use tautline_kernel::net::{NodeId, RobotId, Strength};
use tautline_kernel::tan::{Guide, Heading, Homing, Nav, Nearness, Order, ReqNav, Stage};

use crate::engine::{Outcome, Stop, require};

/// The number of events of a robot.
const EVENTS: u8 = 6;

/// Hops at the start: two nodes, and the WFR.
const HOPS: u16 = 3;

const WFR: NodeId = NodeId(0);
const ME: RobotId = RobotId(1);
const NEAR: i32 = 100;
const CLOSER: u16 = 10;

/// How often a robot asks a node, and goes nearer to one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Patience {
    pub(super) tries: u8,
    pub(super) times: u8,
    /// Whether it takes a signal that is as strong as at its node for none while it walks.
    pub(super) walks_past: bool,
    /// Whether it compares a signal with that of its scan, not with that of its last step.
    pub(super) recalls_scan: bool,
}

/// The knowledge that a robot should have.
struct Way {
    asked: u16,
    in_vain: u8,
    /// The node where it has been last, and how often it has gone nearer to that one since.
    last: Option<(u16, u8)>,
}

impl Way {
    /// The node that it asks next when one more attempt was in vain; none if it is lost.
    fn fails(&mut self) -> Option<u16> {
        self.in_vain += 1;
        if self.in_vain < TRUE.tries {
            return Some(self.asked);
        }
        let (last, nearer) = self.last.filter(|&(last, nearer)| last != self.asked && nearer < TRUE.times)?;
        (self.in_vain, self.last, self.asked) = (0, Some((last, nearer + 1)), last);
        Some(last)
    }

    /// How strong the signal is to be where the robot is at the node.
    fn due(&self) -> i32 {
        let nearer = self.last.filter(|&(last, _)| last == self.asked).map_or(0, |(_, nearer)| nearer);
        NEAR + i32::from(nearer) * i32::from(CLOSER)
    }

    fn reaches(&mut self) {
        let nearer = self.last.filter(|&(last, _)| last == self.asked).map_or(0, |(_, nearer)| nearer);
        (self.last, self.in_vain) = (Some((self.asked, nearer)), 0);
        self.asked = self.asked.saturating_sub(1);
    }
}

/// The rule's patience.
pub(super) const TRUE: Patience = Patience { tries: 2, times: 1, walks_past: false, recalls_scan: false };

/// The bound of [`whole_way`].
pub(super) fn events() -> String {
    format!("{EVENTS} events from {HOPS} hops on, {} tries, {} time nearer", TRUE.tries, TRUE.times)
}

/// TAN-3: what a robot does next.
///
/// # Errors
/// [`crate::engine::Stop`] if the clause is broken.
pub(super) fn whole_way(patience: &Patience, oracle: &mut dyn Oracle) -> Outcome {
    let nearness = Nearness { near: Strength(NEAR), closer: CLOSER, times: patience.times };
    let mut robot = Homing::new(WFR, ME, NodeId(2), HOPS, nearness, patience.tries);
    let mut way = Way { asked: HOPS - 1, in_vain: 0, last: None };
    for number in 0..EVENTS {
        let node = NodeId(way.asked.into());
        let is_asked = robot.order() == Order::Ask(ReqNav { wfr: WFR, robot: ME, node });
        require(is_asked && robot.hops() == way.asked + 1, "it asks the node that is due")?;
        if oracle.flip() {
            robot = robot.expire();
        } else {
            let parent = NodeId(way.asked.saturating_sub(1).into());
            robot = robot.hear(Nav { wfr: WFR, node, hops: way.asked, parent });
            let Some(comes) = walks(&mut robot, &way, (number, patience), oracle)? else {
                return Ok("on its way");
            };
            require(
                (robot.hops() == way.asked) == comes,
                "it is at the node where it hears it as strong as there",
            )?;
            if comes {
                way.reaches();
                if robot.stage() == Stage::Arrived {
                    require(robot.hops() == 0, "it has arrived at the WFR alone")?;
                    return Ok("at the WFR");
                }
                continue;
            }
        }
        if way.fails().is_none() {
            require(robot.stage() == Stage::Lost, "it is lost when all was in vain")?;
            return Ok("lost");
        }
    }
    Ok("it asks")
}

/// A scan, and a walk; whether the robot has come to the node or lost its signal, unless it goes on. In scan `number`
/// two directions are as good; every second one hears a signal that can get stronger before the node is reached.
fn walks(
    robot: &mut Homing,
    way: &Way,
    (number, patience): (u8, &Patience),
    oracle: &mut dyn Oracle,
) -> Result<Option<bool>, Stop> {
    let far = way.due() - 1 - i32::from(number % 2);
    let strongest = one_of(oracle, &[None, Some(far), Some(way.due())]);
    let best = [5 + number % 2, 9].map(|steps| Heading::FIRST.turned(steps));
    for heading in Heading::all() {
        require(robot.order() == Order::Point(heading), "it turns its antenna once round")?;
        let weaker = if best.contains(&heading) { 0 } else { 7 };
        *robot = robot.measure(strongest.map(|strongest| Strength(strongest - weaker)));
    }
    let strongest = match strongest {
        Some(strongest) if strongest < way.due() => strongest,
        near_or_none => return Ok(Some(near_or_none.is_some())),
    };
    let ahead = Order::Walk(best[0]);
    require(robot.order() == ahead, "it walks in the first of the strongest directions")?;
    let heard = match oracle.pick(5) {
        0 => {
            for heard in strongest..way.due() {
                *robot = robot.measure(Some(Strength(heard)));
                require(robot.order() == ahead, "it goes on while the signal is not weaker")?;
            }
            if strongest < way.due() - 1 {
                let weaker = if patience.recalls_scan { way.due() - 1 } else { strongest };
                *robot = robot.measure(Some(Strength(weaker)));
                require(
                    robot.order() == Order::Point(Heading::FIRST),
                    "it scans again where it gets weaker",
                )?;
            }
            return Ok(None);
        }
        1 => None,
        2 => Some(way.due()),
        walk => {
            *robot = if walk == 3 { robot.bump() } else { robot.measure(Some(Strength(strongest - 1))) };
            for heading in Heading::all() {
                require(robot.order() == Order::Point(heading), "it scans again")?;
                *robot = robot.measure(None);
            }
            return Ok(Some(false));
        }
    };
    *robot = robot.measure(heard.filter(|_| !patience.walks_past).map(Strength));
    Ok(Some(heard.is_some()))
}

/// The number of events of a node that guides.
const REQUESTS: usize = 4;

/// The bound of [`guides`].
pub(super) fn requests() -> String {
    format!("{REQUESTS} requests, signals of others, or ends of T_x")
}

/// TAN-4: what a node does until T_x has passed.
///
/// # Errors
/// [`crate::engine::Stop`] if the clause is broken.
pub(super) fn guides(is_patient: &bool, oracle: &mut dyn Oracle) -> Outcome {
    let own = |hops| Nav { wfr: WFR, node: NodeId(2), hops, parent: NodeId(1) };
    let mut guide = Guide::Idle;
    // Since T_x has passed: the places in the tree under which it was asked, none for what was not for it.
    let mut since: Vec<Option<Nav>> = Vec::new();
    for _ in 0..REQUESTS {
        let event = oracle.pick(4);
        let node = NodeId(if event == 0 { 2 } else { 3 });
        let own = own(1 + oracle.pick(2) as u16);
        guide = match event {
            0 | 1 => guide.request(ReqNav { wfr: WFR, robot: ME, node }, NodeId(2), Some(own)),
            2 => guide.overhear(),
            _ => guide.expire(),
        };
        match event {
            3 => since.clear(),
            _ => since.push((event == 0).then_some(own)),
        }
        if !is_patient {
            since.retain(Option::is_some);
        }
        let due = match since.first() {
            None => Guide::Idle,
            Some(None) => Guide::Silent,
            Some(Some(_)) => {
                since.iter().rev().flatten().next().map_or(Guide::Idle, |&nav| Guide::Signals(nav))
            }
        };
        require(
            guide == due,
            "it signals if it was asked before it had to keep silent, as it was asked last",
        )?;
    }
    Ok(match guide {
        Guide::Idle => "idle",
        Guide::Signals(_) => "it signals",
        Guide::Silent => "it keeps silent",
    })
}
