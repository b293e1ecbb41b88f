//! A path node's part in MRC [Jiang 2011, 3.3, step 3]: what a robot sends goes from parent to parent, and a RESB the
//! same way back. The paper names no way back: a path node remembers, by SN and MID, who gave it the robot's message.

use super::message::{Resb, Upward};
use crate::net::{Call, NodeId, RobotId};

/// Who is one hop away.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Hop {
    /// A path node.
    Node(NodeId),
    /// The robot itself.
    Robot(RobotId),
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
struct Route {
    call: Call,
    robot: RobotId,
    back: Hop,
}

/// A path node that remembers at most `ROUTES` ways back: it needs one for each robot and WFR.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Relay<const ROUTES: usize> {
    id: NodeId,
    routes: [Option<Route>; ROUTES],
}

impl<const ROUTES: usize> Relay<ROUTES> {
    /// A node that knows no way.
    pub const fn new(id: NodeId) -> Self {
        Self { id, routes: [None; ROUTES] }
    }

    /// A robot's message has come from `from`: what this node sends on, to its own `parent` in the tree of the call.
    /// Nothing, if the message is another node's to send on. The latest way back is kept; one of an older call of the
    /// same WFR never takes the place of a newer one, and where there is no room for another the way is not kept: its
    /// RESB ends here.
    pub fn up(mut self, message: Upward, from: Hop, parent: NodeId) -> (Self, Option<Upward>) {
        if message.parent != self.id {
            return (self, None);
        }
        let Upward { call, robot, .. } = message;
        let is_same = |known: &Option<Route>| {
            known.is_some_and(|known| (known.call.wfr, known.robot) == (call.wfr, robot))
        };
        let known = self.routes.iter().position(is_same);
        let place = known.or_else(|| self.routes.iter().position(Option::is_none));
        if let Some(place) = place.and_then(|place| self.routes.get_mut(place))
            && place.is_none_or(|known| known.call.epoch <= call.epoch)
        {
            *place = Some(Route { call, robot, back: from });
        }
        (self, Some(Upward { parent, ..message }))
    }

    /// A RESB has come: who gets it next. Nobody, if the robot's message did not come by here.
    pub fn down(&self, resb: Resb) -> Option<Hop> {
        let is_there = |known: &&Route| (known.call, known.robot) == (resb.call, resb.robot);
        self.routes.iter().flatten().find(is_there).map(|route| route.back)
    }
}

#[cfg(test)]
mod tests {
    use super::super::message::Word;
    use super::*;
    use crate::net::Epoch;

    const fn message(robot: u16, epoch: u32, parent: u32) -> Upward {
        let call = Call { wfr: NodeId(0), epoch: Epoch(epoch) };
        Upward { call, robot: RobotId(robot), word: Word::Move { hops: 3 }, parent: NodeId(parent) }
    }

    const fn resb(robot: u16, epoch: u32) -> Resb {
        let Upward { call, robot, .. } = message(robot, epoch, 0);
        Resb { call, robot, chosen: None }
    }

    #[test]
    fn a_resb_goes_back_the_way_that_the_move_came() {
        let (low, up) = Relay::<4>::new(NodeId(7)).up(message(1, 0, 7), Hop::Robot(RobotId(1)), NodeId(3));
        assert_eq!(up, Some(message(1, 0, 3)));
        let (high, up) =
            Relay::<4>::new(NodeId(3)).up(up.expect("a message"), Hop::Node(NodeId(7)), NodeId(0));
        assert_eq!(up, Some(message(1, 0, 0)));
        assert_eq!(high.down(resb(1, 0)), Some(Hop::Node(NodeId(7))));
        assert_eq!(low.down(resb(1, 0)), Some(Hop::Robot(RobotId(1))));
    }

    #[test]
    fn a_message_for_another_parent_leaves_no_trace() {
        let node = Relay::<4>::new(NodeId(7));
        assert_eq!(node.up(message(1, 0, 8), Hop::Robot(RobotId(1)), NodeId(3)), (node, None));
    }

    #[test]
    fn a_resb_of_another_robot_or_epoch_ends_here() {
        let (node, _) = Relay::<4>::new(NodeId(7)).up(message(1, 0, 7), Hop::Robot(RobotId(1)), NodeId(3));
        assert_eq!(node.down(resb(2, 0)), None);
        assert_eq!(node.down(resb(1, 1)), None);
    }

    #[test]
    fn the_latest_way_of_a_robot_is_the_way_back() {
        let (node, _) = Relay::<2>::new(NodeId(7)).up(message(1, 1, 7), Hop::Node(NodeId(9)), NodeId(3));
        let (node, _) = node.up(message(1, 1, 7), Hop::Robot(RobotId(1)), NodeId(3));
        assert_eq!(node.down(resb(1, 1)), Some(Hop::Robot(RobotId(1))));
    }

    #[test]
    fn a_newer_call_takes_the_way_of_an_older_one_and_not_the_reverse() {
        let (node, _) = Relay::<1>::new(NodeId(7)).up(message(1, 1, 7), Hop::Node(NodeId(9)), NodeId(3));
        let (node, up) = node.up(message(1, 0, 7), Hop::Node(NodeId(8)), NodeId(3));
        assert!(up.is_some());
        assert_eq!(node.down(resb(1, 1)), Some(Hop::Node(NodeId(9))));
        let (node, _) = node.up(message(1, 2, 7), Hop::Node(NodeId(8)), NodeId(3));
        assert_eq!(node.down(resb(1, 2)), Some(Hop::Node(NodeId(8))));
        let (node, up) = node.up(message(2, 2, 7), Hop::Node(NodeId(8)), NodeId(3));
        assert!(up.is_some());
        assert_eq!(node.down(resb(2, 2)), None, "there is no room");
    }
}
