//! The readings of a robot's part in MRC: whose service the SBit stands for, which packets make a record, and when a
//! robot asks. The kernel's robot has the first of each; the others are made of it.

use tautline_kernel::mrc::{Downward, Request, Resb, Robot, ServiceBit, Task, Upward};
use tautline_kernel::net::{Call, Epoch, NodeId, Notice};

/// Whose service the SBit of a call stands for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Service {
    /// Any robot's: step 5 sets it when the robot hears whom the WFR has chosen.
    ByAny,
    /// The robot's own.
    ByItself,
}

/// The NOTICEs that make a record.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Records {
    /// The first of each WFR; later ones can only bring its hop count down.
    ByWfr,
    /// Every packet. A RESB sets the SBits of all records of its WFR, and of those that are clear the one of least HC
    /// alone is asked for: so one record stands for them, with a clear SBit as soon as another packet comes.
    ByPacket,
}

/// When a robot that had nothing to ask for asks for a call that it hears.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Start {
    /// At the NOTICE.
    AtOnce,
    /// At some time after it, when it may have heard of others.
    Later,
}

/// A reading of a robot's part.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct RobotReading {
    /// Whose service the SBit stands for.
    pub served: Service,
    /// The NOTICEs that make a record.
    pub records: Records,
    /// When a robot asks.
    pub start: Start,
}

type Turn<const CALLS: usize> = (Robot<CALLS>, Option<Upward>);

impl RobotReading {
    /// The reading of the kernel's robot.
    pub const PUBLISHED: Self =
        Self { served: Service::ByAny, records: Records::ByWfr, start: Start::AtOnce };

    /// A robot hears a NOTICE.
    pub fn hear<const CALLS: usize>(self, robot: Robot<CALLS>, notice: Notice) -> Turn<CALLS> {
        let of_wfr = |request: &Request| request.call.wfr == notice.call.wfr;
        let is_over = |request: &Request| of_wfr(request) && request.served == ServiceBit::Yes;
        let robot = match self.records {
            Records::ByWfr => robot,
            Records::ByPacket => with(&robot, |request| !is_over(request), robot.task()),
        };
        match (self.start, robot.task()) {
            (Start::Later, Task::Free) => {
                let busy = with(&robot, |_| true, Task::Leased { call: NOWHERE });
                let (heard, _) = busy.receive(Downward::Notice(notice));
                (with(&heard, |_| true, Task::Free), None)
            }
            (Start::AtOnce | Start::Later, _) => robot.receive(Downward::Notice(notice)),
        }
    }

    /// Whether a robot has put off asking: it is free, and knows of a call that it may ask for.
    pub fn collects<const CALLS: usize>(self, robot: &Robot<CALLS>) -> bool {
        self.start == Start::Later
            && robot.task() == Task::Free
            && robot.requests().any(|request| request.served == ServiceBit::No)
    }

    /// A robot hears of a choice.
    pub fn heed<const CALLS: usize>(self, robot: Robot<CALLS>, resb: Resb) -> Turn<CALLS> {
        let is_passed_over = self.served == Service::ByItself && resb.chosen != Some(resb.robot);
        match robot.task() {
            _ if !is_passed_over => robot.receive(Downward::Resb(resb)),
            Task::Asking { call, .. } | Task::Leased { call } if call.wfr == resb.call.wfr => begin(&robot),
            Task::Asking { .. } | Task::Leased { .. } | Task::Free => (robot, None),
        }
    }
}

/// A call of no WFR of a setting.
const NOWHERE: Call = Call { wfr: NodeId(u32::MAX), epoch: Epoch::FIRST };

/// A robot executes step 2 with the records that it has.
pub(super) fn begin<const CALLS: usize>(robot: &Robot<CALLS>) -> Turn<CALLS> {
    with(robot, |_| true, Task::Leased { call: NOWHERE }).arrive()
}

/// The robot with those of its records, and this task.
fn with<const CALLS: usize>(
    robot: &Robot<CALLS>,
    keeps: impl Fn(&Request) -> bool,
    task: Task,
) -> Robot<CALLS> {
    let mut requests = robot.requests().copied().filter(keeps);
    Robot::kept(*robot.rule(), robot.id(), std::array::from_fn(|_| requests.next()), task)
}

#[cfg(test)]
mod tests {
    use tautline_kernel::mrc::Rule;
    use tautline_kernel::net::RobotId;

    use super::*;

    const fn call(wfr: u32) -> Call {
        Call { wfr: NodeId(wfr), epoch: Epoch(1) }
    }

    const fn notice(wfr: u32, hops: u16) -> Notice {
        Notice { call: call(wfr), hops, sender: NodeId(9) }
    }

    /// A robot that has heard this, and the call for which it has asked last.
    fn after(reading: RobotReading, heard: &[Notice]) -> (Robot<2>, Option<Call>) {
        let fresh = (Robot::new(Rule::PUBLISHED, RobotId(1)), None);
        heard.iter().fold(fresh, |(robot, _), &notice| asks(reading.hear(robot, notice)))
    }

    fn asks(turn: Turn<2>) -> (Robot<2>, Option<Call>) {
        (turn.0, turn.1.map(|sent| sent.call))
    }

    const fn resb(wfr: u32) -> Resb {
        Resb { call: call(wfr), robot: RobotId(1), chosen: Some(RobotId(0)) }
    }

    /// “If a mobile node is not selected, it can reply to another un-replied notification packet”: not where its SBit
    /// stays clear.
    #[test]
    fn a_robot_whose_sbit_stays_clear_asks_the_same_wfr_again_and_again() {
        let [any, own] = [Service::ByAny, Service::ByItself]
            .map(|served| RobotReading { served, ..RobotReading::PUBLISHED });
        let (robot, _) = after(any, &[notice(1, 0), notice(2, 3)]);
        assert_eq!(asks(any.heed(robot, resb(1))).1, Some(call(2)));
        assert_eq!(asks(own.heed(robot, resb(1))), (robot, Some(call(1))));
    }

    #[test]
    fn another_packet_clears_the_sbit_where_each_makes_a_record() {
        let [by_wfr, by_packet] = [Records::ByWfr, Records::ByPacket]
            .map(|records| RobotReading { records, ..RobotReading::PUBLISHED });
        for (reading, asked) in [(by_wfr, None), (by_packet, Some(call(1)))] {
            let (robot, _) = after(reading, &[notice(1, 0)]);
            let (robot, _) = reading.heed(robot, resb(1));
            assert_eq!(asks(reading.hear(robot, notice(1, 4))).1, asked);
        }
        // Of clear ones the least HC counts, as in one record.
        let heard = [notice(1, 4), notice(1, 2), notice(1, 3)];
        assert_eq!(after(by_wfr, &heard), after(by_packet, &heard));
    }

    #[test]
    fn a_robot_that_collects_asks_for_the_nearest_of_all_that_it_has_heard() {
        let later = RobotReading { start: Start::Later, ..RobotReading::PUBLISHED };
        let (robot, asked) = after(later, &[notice(1, 3), notice(2, 0)]);
        assert_eq!((asked, later.collects(&robot)), (None, true));
        let (robot, asked) = asks(begin(&robot));
        assert_eq!((asked, later.collects(&robot)), (Some(call(2)), false));
        assert_eq!(asks(later.heed(robot, resb(2))).1, Some(call(1)));
    }
}
