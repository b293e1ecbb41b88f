//! The actions that can happen next in a state, and those of them that are bound to happen.

use tautline_kernel::mrc::{Task, WfrTimer};
use tautline_kernel::net::Call;

use super::action::{Action, Actor, Message};
use super::setting::{Leases, LossKind, Setting};
use super::{State, node, place, robot_id};

impl State {
    /// Everything that can happen next in `setting`.
    pub fn actions(&self, setting: &Setting) -> Vec<Action> {
        let mut actions = Vec::with_capacity(32);
        let (robots, wfrs) = (0..setting.robots, 0..setting.wfrs);
        let can_expire = |actor: Actor| {
            self.timer_runs(actor) && (self.left.left(|left| left.delays) > 0 || self.is_due(setting, actor))
        };
        for (at, message) in self.network.iter().enumerate() {
            if at > 0 && self.network[at - 1] == *message {
                continue;
            }
            actions.push(Action::Deliver(at));
            let can_be_lost = match (setting.lossy, message) {
                (LossKind::All, _) | (LossKind::Resb, Message::Resb(_)) => true,
                (LossKind::Resb, Message::Notice(..) | Message::Up(_)) => false,
            };
            if can_be_lost && self.left.left(|left| left.losses) > 0 {
                actions.push(Action::Lose(at));
            }
            if self.left.left(|left| left.duplicates) > 0 {
                actions.push(Action::Duplicate(at));
            }
        }
        for wfr in wfrs.clone() {
            if self.events_left > 0 && !self.wfrs[wfr].is_waiting() {
                actions.push(Action::Raise(wfr));
            }
            if can_expire(Actor::Wfr(wfr)) {
                actions.push(Action::Expire(Actor::Wfr(wfr)));
            }
        }
        for robot in robots.filter(|&robot| !self.failed[robot]) {
            if self.collects(setting, robot) {
                actions.push(Action::Begin(robot));
            }
            if self.comes_for(robot).is_some() {
                actions.push(Action::Arrive(robot));
            }
            if self.can_lapse(setting, robot) {
                actions.push(Action::Lapse(robot));
            }
            if can_expire(Actor::Robot(robot)) {
                actions.push(Action::Expire(Actor::Robot(robot)));
            }
            if self.left.left(|left| left.robots) > 0 {
                actions.push(Action::FailRobot(robot));
            }
            for wfr in wfrs.clone().filter(|_| self.left.left(|left| left.nodes) > 0) {
                let epoch = Some(self.wfrs[wfr].call().epoch);
                if self.wfrs[wfr].is_waiting() && self.cut[robot][wfr] != epoch {
                    actions.push(Action::FailNode { robot, wfr });
                }
            }
        }
        actions
    }

    /// Whether `action` is bound to happen sooner or later if nothing else does: no fault, and no event.
    pub fn is_bound_to_happen(&self, setting: &Setting, action: Action) -> bool {
        match action {
            Action::Begin(_) | Action::Deliver(_) | Action::Arrive(_) | Action::Lapse(_) => true,
            Action::Expire(actor) => self.is_due(setting, actor),
            Action::Raise(_)
            | Action::Lose(_)
            | Action::Duplicate(_)
            | Action::FailRobot(_)
            | Action::FailNode { .. } => false,
        }
    }

    /// Whether the timer of a robot that lives, or of a WFR, runs.
    pub fn timer_runs(&self, actor: Actor) -> bool {
        match actor {
            Actor::Robot(robot) => !self.failed[robot] && self.robots[robot].timer().is_some(),
            Actor::Wfr(wfr) => self.wfrs[wfr].timer().is_some(),
        }
    }

    /// Whether a timer that runs may go off without a fault: what it waits for is no longer on its way. A WFR waits for
    /// its messages and for robots that come to it; a robot for the messages between it and the WFR that it asks, and
    /// until the window of that call is closed.
    pub(super) fn is_due(&self, setting: &Setting, actor: Actor) -> bool {
        match actor {
            Actor::Robot(robot) => self.robots[robot].timer().is_some_and(|timer| {
                let Call { wfr, epoch } = timer.call;
                let is_between =
                    |message: &Message| (message.robot(), message.call().wfr) == (robot_id(robot), wfr);
                let is_window_open = self.wfrs[place(wfr)].timer() == Some(WfrTimer::Window(epoch));
                !is_window_open && !self.network.iter().any(is_between)
            }),
            Actor::Wfr(wfr) => {
                let is_of_wfr = |call: Call| call.wfr == node(wfr);
                let comes = |robot| self.comes_for(robot).is_some_and(is_of_wfr);
                let is_on_its_way = |message: &Message| is_of_wfr(message.call());
                !self.network.iter().any(is_on_its_way) && !(0..setting.robots).any(comes)
            }
        }
    }

    /// Whether a robot that lives has put off asking.
    pub(in crate::mrc) fn collects(&self, setting: &Setting, robot: usize) -> bool {
        !self.failed[robot] && setting.reading.collects(&self.robots[robot])
    }

    /// The call for which a robot is on its way, if it finds it.
    pub(in crate::mrc) fn comes_for(&self, robot: usize) -> Option<Call> {
        match self.robots[robot].task() {
            Task::Leased { call }
                if !self.failed[robot] && self.cut[robot][place(call.wfr)] != Some(call.epoch) =>
            {
                Some(call)
            }
            Task::Free | Task::Asking { .. } | Task::Leased { .. } => None,
        }
    }

    fn can_lapse(&self, setting: &Setting, robot: usize) -> bool {
        let Task::Leased { call } = self.robots[robot].task() else { return false };
        let wfr = &self.wfrs[place(call.wfr)];
        match setting.leases {
            Leases::UntilCalled => false,
            Leases::UntilOver => wfr.call() != call || !wfr.is_waiting(),
            Leases::Any => true,
        }
    }
}
