//! The nodes' answers to what they hear: they broadcast calls, carry messages up and down the tree of a call as letters
//! from hop to hop, and guide robots.

use tautline_kernel::choice::Oracle;
use tautline_kernel::mrc::{Bid, Condition, Hop, Relay, Resb, Upward, Word};
use tautline_kernel::net::{NodeId, Reception};
use tautline_kernel::tan::{Guide, ReqNav};

use super::{Duty, Message, World};
use crate::radio::Protocol;
use crate::rescue::acks::{ANSWER_WAIT_NS, Content, Letter};
use crate::rescue::pace::SIGNAL_NS;

impl World<'_> {
    pub(super) fn node_hears(&mut self, at: NodeId, heard: Reception<Message>, chance: &mut dyn Oracle) {
        let Reception { message, distance_um, now_ns } = heard;
        match message {
            Message::Notice(message) => {
                let Some(wfr) = self.scenario.wfr(message.call.wfr) else { return };
                let heard = Reception { message, distance_um, now_ns };
                if let Some(at_ns) = self.broadcasts[wfr].receive(at, heard, chance) {
                    self.put(at, at_ns, Duty::Forward(wfr));
                }
            }
            Message::Letter(letter) => match self.open(at, letter) {
                Some(Content::Up(message)) => self.carry(at, message, letter.from, now_ns),
                Some(Content::Down(resb)) => self.send_down(at, resb, now_ns),
                None => {}
            },
            Message::Receipt { to, frame } => self.close(at, to, frame),
            Message::ReqNav(request) => self.guide(at, request, now_ns),
            Message::Nav(_) => {
                let guide = self.sensors[at.0 as usize].guide;
                self.conduct(at, guide.overhear(), now_ns);
            }
        }
    }

    /// Something for this node to send on, or for the WFR that it is.
    fn carry(&mut self, at: NodeId, message: Upward, from: Hop, now_ns: u64) {
        let Some(wfr) = self.scenario.wfr(message.call.wfr) else { return };
        let is_goal = message.call.wfr == at;
        let parent = if is_goal {
            Some(at)
        } else {
            self.broadcasts[wfr].nav(at, message.call.epoch).map(|nav| nav.parent)
        };
        let Some(parent) = parent else { return };
        let relay = &mut self.sensors[at.0 as usize].relay;
        let known = relay.as_deref().copied().unwrap_or_else(|| Relay::new(at));
        let (known, onward) = known.up(message, from, parent);
        *relay = Some(Box::new(known));
        if is_goal {
            let mut bidder = None;
            if let Word::Move { hops } = message.word
                && message.call == self.wfrs[wfr].call()
            {
                self.judge.bids(wfr, Bid { hops, robot: message.robot });
                bidder = Some(message.robot);
            }
            self.turn_wfr(wfr, now_ns, bidder, |machine| machine.receive(message));
        } else if let Some(message) = onward {
            self.post(at, Hop::Node(message.parent), Content::Up(message), now_ns);
        }
    }

    /// Who a station is to its neighbours.
    fn hop(&self, at: NodeId) -> Hop {
        self.robot(at).map_or(Hop::Node(at), |robot| Hop::Robot(self.rovers[robot].machine.id()))
    }

    pub(super) fn post(&mut self, at: NodeId, to: Hop, content: Content, now_ns: u64) {
        let from = self.hop(at);
        let letter = self.letters[at.0 as usize].write(from, to, content);
        self.send(at, Message::Letter(letter));
        self.put(at, now_ns + ANSWER_WAIT_NS, Duty::Repeat(letter.frame));
    }

    /// The content of a letter, if it is for this station, and new.
    pub(super) fn open(&mut self, at: NodeId, letter: Letter) -> Option<Content> {
        if letter.to != self.hop(at) {
            return None;
        }
        self.send(at, Message::Receipt { to: letter.from, frame: letter.frame });
        self.letters[at.0 as usize].is_news(&letter).then_some(letter.content)
    }

    pub(super) fn close(&mut self, at: NodeId, to: Hop, frame: u32) {
        if to == self.hop(at) {
            self.letters[at.0 as usize].close(frame);
        }
    }

    pub(super) fn send_down(&mut self, at: NodeId, resb: Resb, now_ns: u64) {
        let relay = self.sensors[at.0 as usize].relay.as_deref();
        if let Some(to) = relay.and_then(|relay| relay.down(resb)) {
            self.post(at, to, Content::Down(resb), now_ns);
        }
    }

    pub(super) fn guide(&mut self, at: NodeId, request: ReqNav, now_ns: u64) {
        let Some(wfr) = self.scenario.wfr(request.wfr) else { return };
        let broadcast = &self.broadcasts[wfr];
        let event = broadcast.nodes()[at.0 as usize].event();
        // Whoever comes to a WFR that is rescued comes in vain: it answers a MOVE with nobody's name, and a REQNAV not
        // at all.
        let is_over = self.wfrs[wfr].call().wfr == at
            && !self.wfrs[wfr].is_waiting()
            && self.scenario.rule.has(Condition::AnswersAgain);
        let own = event.filter(|_| !is_over).and_then(|event| broadcast.nav(at, event));
        let guide = self.sensors[at.0 as usize].guide.request(request, at, own);
        match guide {
            Guide::Signals(nav) if request.node == at => {
                self.sensors[at.0 as usize].guide = Guide::Idle;
                self.conduct(at, guide, now_ns);
                self.send(at, Message::Nav(nav));
            }
            Guide::Signals(_) | Guide::Silent | Guide::Idle => self.conduct(at, guide, now_ns),
        }
    }

    /// A node's conduct lasts for T_x from now. A silence that has begun is not prolonged: else each packet would put
    /// off the node's answer to its own robot.
    fn conduct(&mut self, at: NodeId, guide: Guide, now_ns: u64) {
        let sensor = &mut self.sensors[at.0 as usize];
        if sensor.guide != guide {
            let until_ns = now_ns + SIGNAL_NS;
            (sensor.guide, sensor.until_ns) = (guide, until_ns);
            self.put(at, until_ns, Duty::Quiet);
        }
    }
}
