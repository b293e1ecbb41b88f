//! The air between the nodes: what is sent arrives, collides or is lost. Every node has one antenna and one queue.
//!
//! Over the ideal channel whoever is linked to a sender hears it at once. Over the shared one sending takes time, a
//! node listens before it sends and puts it off while it hears somebody, and where two signals overlap neither is
//! heard. A node that sends hears nothing. There is no capture of a stronger signal, and nobody gives up.

use std::collections::VecDeque;

use tautline_kernel::choice::Oracle;
use tautline_kernel::net::{NodeId, Propagation, Reception};

use tautline_grids::chance::{Probability, deviation};

use super::network::Link;
use super::problem::checked_deviation;
use super::queue::Queue;
use super::{Network, Problem};

/// The nodes' protocol: their answers to messages and timers. Beside the nodes of the network there may be rovers:
/// stations that move, so that their links are the protocol's to tell. Their numbers follow those of the nodes.
pub trait Protocol {
    /// A message of the nodes.
    type Message: Copy;

    /// Node `at` hears a message. If its timer is to go off: when, in nanoseconds.
    fn receive(
        &mut self,
        at: NodeId,
        heard: Reception<Self::Message>,
        chance: &mut dyn Oracle,
    ) -> Option<u64>;

    /// The timer of node `at` goes off: what it sends, if anything.
    fn expire(&mut self, at: NodeId, now_ns: u64, chance: &mut dyn Oracle) -> Option<Self::Message>;

    /// The timer of node `at` has gone off. If it is to go off again: when, in nanoseconds.
    #[inline]
    fn again(&mut self, _at: NodeId, _now_ns: u64) -> Option<u64> {
        None
    }

    /// How many rovers there are.
    #[inline]
    fn rovers(&self) -> usize {
        0
    }

    /// Adds the links on which what `at` sends now is heard, beside those of the network: a node's to the rovers, a
    /// rover's to all that hear it.
    #[inline]
    fn roving(&self, _at: NodeId, _links: &mut Vec<Link>) {}
}

/// A channel between a sender and those linked to it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Channel {
    /// Nothing.
    Ideal,
    /// A channel that carries one signal at a time.
    Shared(SharedChannel),
}

/// A channel that carries one signal at a time, and how it is shared.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct SharedChannel {
    /// How long a message is on the air, in nanoseconds.
    pub airtime_ns: u32,
    /// From listening to sending, in nanoseconds: what begins in between goes unnoticed.
    pub turnaround_ns: u32,
    /// Who hears somebody listens again after 1 to `slots` of these, in nanoseconds.
    pub slot_ns: u32,
    /// See `slot_ns`; at least 1.
    pub slots: u32,
}

impl SharedChannel {
    /// A sensor's radio of 250 kbit/s (IEEE 802.15.4 at 2.4 GHz) with a message of 31 bytes in all: 992 µs on the air,
    /// 192 µs to turn round, slots of 320 µs.
    pub const SENSOR: Self = Self { airtime_ns: 992_000, turnaround_ns: 192_000, slot_ns: 320_000, slots: 8 };
}

/// Faults that may happen on the way.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Faults {
    loss: Probability,
    /// The noise of signal strength in dB, and how power falls with the distance.
    noise: Option<(f64, Propagation)>,
}

impl Faults {
    /// Nothing goes wrong.
    pub const NONE: Self = Self { loss: Probability::NEVER, noise: None };

    /// Each message is lost with this probability on each link, anew each time.
    #[must_use]
    pub const fn with_loss(self, loss: Probability) -> Self {
        Self { loss, ..self }
    }

    /// The strength of each signal that is heard is off by a standard deviation of `deviation_db`, anew each time. It
    /// tells another distance then.
    ///
    /// # Errors
    /// [`Problem::Deviation`] if that is not from 0 to 20 dB.
    pub fn with_noise(self, deviation_db: f64, propagation: Propagation) -> Result<Self, Problem> {
        Ok(Self { noise: Some((checked_deviation(deviation_db)?, propagation)), ..self })
    }

    #[inline]
    fn measured_um(&self, distance_um: u32, chance: &mut dyn Oracle) -> u32 {
        match self.noise {
            None => distance_um,
            Some(noise) => noisy_um(noise, distance_um, chance),
        }
    }
}

fn noisy_um(
    (standard_db, propagation): (f64, Propagation),
    distance_um: u32,
    chance: &mut dyn Oracle,
) -> u32 {
    (f64::from(distance_um) * propagation.times_as_far(-deviation(standard_db, chance))) as u32
}

/// The traffic on the air.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Air {
    /// Messages sent.
    pub sent: u64,
    /// Messages heard, each by each who heard it.
    pub heard: u64,
    /// Messages not heard for another signal, each by each who would have heard it.
    pub collided: u64,
    /// Messages lost, each by each who would have heard it.
    pub lost: u64,
    /// How often sending was put off.
    pub put_off: u64,
    /// When the last message ended, in nanoseconds.
    pub end_ns: u64,
}

/// Runs `protocol` until nothing more happens. It begins with the timers in `begin`, each of a node or rover at a time
/// in nanoseconds. What happens at once, happens in the order of the nodes.
///
/// # Errors
/// [`Problem::NoNode`] if there is no such node.
pub fn run<P: Protocol>(
    network: &Network,
    channel: Channel,
    faults: &Faults,
    protocol: &mut P,
    begin: &[(NodeId, u64)],
    chance: &mut dyn Oracle,
) -> Result<Air, Problem> {
    let stations = network.nodes() + protocol.rovers();
    if let Some((node, _)) = begin.iter().find(|(node, _)| node.0 as usize >= stations) {
        return Err(Problem::NoNode { node: node.0, nodes: stations });
    }
    let mut world = World { faults, protocol, chance, air: Air::default() };
    match channel {
        Channel::Ideal => world.run_ideal(network, begin),
        Channel::Shared(shared) => Crowd::new(network, stations, shared).run(&mut world, begin),
    }
    Ok(world.air)
}

struct World<'a, P> {
    faults: &'a Faults,
    protocol: &'a mut P,
    chance: &'a mut dyn Oracle,
    air: Air,
}

impl<P: Protocol> World<'_, P> {
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "called for every reception, and a tenth of a flood slower otherwise"
    )]
    fn deliver(&mut self, message: P::Message, link: Link, now_ns: u64) -> Option<u64> {
        if self.faults.loss.is_picked(self.chance) {
            self.air.lost += 1;
            return None;
        }
        self.air.heard += 1;
        let distance_um = self.faults.measured_um(link.distance_um, self.chance);
        self.protocol.receive(link.to, Reception { message, distance_um, now_ns }, self.chance)
    }

    fn run_ideal(&mut self, network: &Network, begin: &[(NodeId, u64)]) {
        let mut queue = Queue::new();
        for &(node, at_ns) in begin {
            queue.put(at_ns, node);
        }
        let mut roving = Vec::new();
        while let Some((now_ns, node)) = queue.take() {
            if let Some(message) = self.protocol.expire(node, now_ns, self.chance) {
                self.air.sent += 1;
                self.air.end_ns = now_ns;
                self.protocol.roving(node, &mut roving);
                for link in network.links(node) {
                    if let Some(at_ns) = self.deliver(message, link, now_ns) {
                        queue.put(at_ns.max(now_ns), link.to);
                    }
                }
                for link in roving.drain(..) {
                    if let Some(at_ns) = self.deliver(message, link, now_ns) {
                        queue.put(at_ns.max(now_ns), link.to);
                    }
                }
            }
            if let Some(at_ns) = self.protocol.again(node, now_ns) {
                queue.put(at_ns.max(now_ns), node);
            }
        }
    }
}

/// An event on a shared channel, in the order of events at one time: a signal that ends makes room for one that begins.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Event {
    End(NodeId),
    Begin(NodeId),
    Timer(NodeId),
    Listen(NodeId),
}

/// The state of a node's antenna.
#[derive(Clone, Copy)]
struct Antenna {
    /// Signals that reach it.
    signals: u32,
    /// The one that it will have heard when it ends, if nothing comes between.
    hears: Option<NodeId>,
    is_sending: bool,
}

/// The nodes on a shared channel.
struct Crowd<'a, M> {
    network: &'a Network,
    shared: SharedChannel,
    queue: Queue<Event>,
    antennas: Vec<Antenna>,
    /// Messages that each node has yet to send, the one on the air first.
    waiting: Vec<VecDeque<M>>,
    /// The links to and from rovers on which what each node has on the air is heard: those of its beginning.
    roving: Vec<Vec<Link>>,
}

impl<'a, M: Copy> Crowd<'a, M> {
    fn new(network: &'a Network, stations: usize, shared: SharedChannel) -> Self {
        let idle = Antenna { signals: 0, hears: None, is_sending: false };
        Self {
            network,
            shared,
            queue: Queue::new(),
            antennas: vec![idle; stations],
            waiting: (0..stations).map(|_| VecDeque::new()).collect(),
            roving: vec![Vec::new(); stations],
        }
    }

    fn run<P: Protocol<Message = M>>(mut self, world: &mut World<'_, P>, begin: &[(NodeId, u64)]) {
        for &(node, at_ns) in begin {
            self.queue.put(at_ns, Event::Timer(node));
        }
        while let Some((now_ns, event)) = self.queue.take() {
            match event {
                Event::Timer(node) => {
                    if let Some(message) = world.protocol.expire(node, now_ns, world.chance) {
                        let waiting = &mut self.waiting[node.0 as usize];
                        waiting.push_back(message);
                        if waiting.len() == 1 {
                            self.queue.put(now_ns, Event::Listen(node));
                        }
                    }
                    if let Some(at_ns) = world.protocol.again(node, now_ns) {
                        self.queue.put(at_ns.max(now_ns), Event::Timer(node));
                    }
                }
                Event::Listen(node) => self.listen(node, now_ns, world),
                Event::Begin(node) => self.begin(node, now_ns, world.protocol),
                Event::End(node) => self.end(node, now_ns, world),
            }
        }
    }

    fn listen<P>(&mut self, node: NodeId, now_ns: u64, world: &mut World<'_, P>) {
        if self.antennas[node.0 as usize].signals == 0 {
            self.queue.put(now_ns + u64::from(self.shared.turnaround_ns), Event::Begin(node));
        } else {
            world.air.put_off += 1;
            let slots = 1 + world.chance.pick(self.shared.slots.max(1));
            // At least a nanosecond, so that time goes on.
            let wait_ns = (u64::from(self.shared.slot_ns) * u64::from(slots)).max(1);
            self.queue.put(now_ns + wait_ns, Event::Listen(node));
        }
    }

    fn begin<P: Protocol<Message = M>>(&mut self, node: NodeId, now_ns: u64, protocol: &P) {
        let antenna = &mut self.antennas[node.0 as usize];
        antenna.is_sending = true;
        antenna.hears = None;
        let roving = &mut self.roving[node.0 as usize];
        protocol.roving(node, roving);
        let rovers = roving.iter().map(|link| &link.to);
        for to in self.network.neighbours(node).iter().chain(rovers) {
            let antenna = &mut self.antennas[to.0 as usize];
            antenna.signals += 1;
            antenna.hears = (antenna.signals == 1 && !antenna.is_sending).then_some(node);
        }
        self.queue.put(now_ns + u64::from(self.shared.airtime_ns), Event::End(node));
    }

    fn end<P: Protocol<Message = M>>(&mut self, node: NodeId, now_ns: u64, world: &mut World<'_, P>) {
        self.antennas[node.0 as usize].is_sending = false;
        let waiting = &mut self.waiting[node.0 as usize];
        let Some(message) = waiting.pop_front() else { return };
        if !waiting.is_empty() {
            self.queue.put(now_ns, Event::Listen(node));
        }
        world.air.sent += 1;
        world.air.end_ns = now_ns;
        let mut roving = std::mem::take(&mut self.roving[node.0 as usize]);
        for link in self.network.links(node).chain(roving.drain(..)) {
            let antenna = &mut self.antennas[link.to.0 as usize];
            antenna.signals -= 1;
            if antenna.hears == Some(node) {
                antenna.hears = None;
                if let Some(at_ns) = world.deliver(message, link, now_ns) {
                    self.queue.put(at_ns.max(now_ns), Event::Timer(link.to));
                }
            } else {
                world.air.collided += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use tautline_proofs::engine::{SeededOracle, Tape};

    use super::*;
    use crate::radio::{Area, Field, Model, Point, Radio};

    /// Nodes in a row, each in reach of those beside it; some say their number when their timers go off.
    struct Talk {
        heard: Vec<(u32, u32, u64)>,
    }

    impl Protocol for Talk {
        type Message = u32;

        fn receive(&mut self, at: NodeId, heard: Reception<u32>, _: &mut dyn Oracle) -> Option<u64> {
            self.heard.push((at.0, heard.message, heard.now_ns));
            None
        }

        fn expire(&mut self, at: NodeId, _: u64, _: &mut dyn Oracle) -> Option<u32> {
            Some(at.0)
        }
    }

    fn row(nodes: u32) -> Network {
        let area = Area::new(100.0, 1.0).expect("an area");
        let nodes = (0..nodes).map(|x| Point { x_m: f64::from(x), y_m: 0.0 }).collect();
        let field = Field::new(area, vec![], nodes).expect("a field");
        let radio = Radio::new(1.5, Model::Disc).expect("a radio");
        Network::new(&field, radio, &mut Tape(&[])).expect("a network")
    }

    const SHARED: SharedChannel = SharedChannel { airtime_ns: 100, turnaround_ns: 10, slot_ns: 30, slots: 4 };

    fn talk(channel: Channel, faults: &Faults, begin: &[(u32, u64)]) -> (Air, Vec<(u32, u32, u64)>) {
        let begin: Vec<(NodeId, u64)> = begin.iter().map(|&(node, at)| (NodeId(node), at)).collect();
        let mut talk = Talk { heard: Vec::new() };
        let air = run(&row(3), channel, faults, &mut talk, &begin, &mut Tape(&[]));
        (air.expect("known nodes"), talk.heard)
    }

    #[test]
    fn over_the_ideal_channel_neighbours_hear_at_once() {
        let (air, heard) = talk(Channel::Ideal, &Faults::NONE, &[(2, 5), (1, 5)]);
        assert_eq!(heard, [(0, 1, 5), (2, 1, 5), (1, 2, 5)]);
        assert_eq!(air, Air { sent: 2, heard: 3, end_ns: 5, ..Air::default() });
    }

    #[test]
    fn over_the_shared_channel_sending_takes_time() {
        let (air, heard) = talk(Channel::Shared(SHARED), &Faults::NONE, &[(1, 5)]);
        assert_eq!(heard, [(0, 1, 115), (2, 1, 115)]);
        assert_eq!(air, Air { sent: 1, heard: 2, end_ns: 115, ..Air::default() });
    }

    #[test]
    fn who_cannot_hear_the_other_collides_with_it() {
        let (air, heard) = talk(Channel::Shared(SHARED), &Faults::NONE, &[(0, 0), (2, 50)]);
        assert_eq!((air.sent, air.heard, air.collided, heard), (2, 0, 2, vec![]));
        let (air, heard) = talk(Channel::Shared(SHARED), &Faults::NONE, &[(0, 0), (2, 100)]);
        assert_eq!((air.collided, heard), (0, vec![(1, 0, 110), (1, 2, 210)]));
    }

    #[test]
    fn who_hears_the_other_puts_it_off_unless_both_have_just_listened() {
        let (air, heard) = talk(Channel::Shared(SHARED), &Faults::NONE, &[(0, 0), (1, 11)]);
        assert_eq!(heard, [(1, 0, 110), (0, 1, 241), (2, 1, 241)]);
        assert_eq!((air.put_off, air.collided), (4, 0));
        let (air, heard) = talk(Channel::Shared(SHARED), &Faults::NONE, &[(0, 0), (1, 9)]);
        assert_eq!(heard, [(2, 1, 119)]);
        assert_eq!((air.put_off, air.collided), (0, 2));
    }

    #[test]
    fn what_a_node_has_to_send_waits_for_its_turn() {
        let (air, heard) = talk(Channel::Shared(SHARED), &Faults::NONE, &[(1, 0), (1, 1), (1, 2)]);
        assert_eq!(heard.iter().map(|&(_, _, at)| at).collect::<Vec<_>>(), [110, 110, 220, 220, 330, 330]);
        assert_eq!(air.sent, 3);
    }

    /// Three nodes in a row and a rover that goes one node on each time that it says something, thrice.
    struct Stroll {
        at: u32,
        heard: Vec<(u32, u32, u64)>,
    }

    const ROVER: NodeId = NodeId(3);

    impl Protocol for Stroll {
        type Message = u32;

        fn receive(&mut self, at: NodeId, heard: Reception<u32>, _: &mut dyn Oracle) -> Option<u64> {
            self.heard.push((at.0, heard.message, heard.now_ns));
            None
        }

        fn expire(&mut self, at: NodeId, _: u64, _: &mut dyn Oracle) -> Option<u32> {
            if at == ROVER {
                self.at += 1;
            }
            Some(at.0)
        }

        fn again(&mut self, at: NodeId, now_ns: u64) -> Option<u64> {
            (at == ROVER && self.at < 3).then_some(now_ns + 500)
        }

        fn rovers(&self) -> usize {
            1
        }

        fn roving(&self, at: NodeId, links: &mut Vec<Link>) {
            let near = NodeId(self.at.min(2));
            if at == ROVER {
                links.push(Link { to: near, distance_um: 1 });
            } else if at == near {
                links.push(Link { to: ROVER, distance_um: 1 });
            }
        }
    }

    /// The traffic on the air, and who heard whom when.
    type StrollResult = (Result<Air, Problem>, Vec<(u32, u32, u64)>);

    fn stroll(channel: Channel, begin: &[(NodeId, u64)]) -> StrollResult {
        let mut stroll = Stroll { at: 0, heard: Vec::new() };
        let air = run(&row(3), channel, &Faults::NONE, &mut stroll, begin, &mut Tape(&[]));
        (air, stroll.heard)
    }

    #[test]
    fn a_rover_is_heard_where_it_is_and_hears_who_is_near() {
        let begin = [(ROVER, 5), (NodeId(1), 600)];
        let (air, heard) = stroll(Channel::Ideal, &begin);
        assert_eq!(heard, [(1, 3, 5), (2, 3, 505), (0, 1, 600), (2, 1, 600), (2, 3, 1005)]);
        assert_eq!(air.map(|air| (air.sent, air.heard)), Ok((4, 5)));
        let (_, heard) = stroll(Channel::Ideal, &[(ROVER, 5), (NodeId(2), 600)]);
        assert_eq!(heard, [(1, 3, 5), (2, 3, 505), (1, 2, 600), (3, 2, 600), (2, 3, 1005)]);
        let (_, heard) = stroll(Channel::Shared(SHARED), &[(ROVER, 5)]);
        assert_eq!(heard, [(1, 3, 115), (2, 3, 615), (2, 3, 1115)]);
        assert_eq!(stroll(Channel::Ideal, &[(NodeId(4), 0)]).0, Err(Problem::NoNode { node: 4, nodes: 4 }));
    }

    #[test]
    fn a_rover_collides_with_nodes() {
        // Node 2 does not hear the rover at node 1, which hears both.
        let (air, heard) = stroll(Channel::Shared(SHARED), &[(ROVER, 5), (NodeId(2), 50)]);
        assert_eq!(heard.iter().filter(|&&(_, _, at_ns)| at_ns < 200).count(), 0);
        assert_eq!(air.map(|air| air.collided), Ok(2));
    }

    #[test]
    fn everything_sent_is_heard_or_collides_or_is_lost() {
        let network = row(50);
        let begin: Vec<(NodeId, u64)> =
            (0..50).map(|node| (NodeId(node), u64::from(node * node % 17) * 40)).collect();
        let faults = Faults::NONE.with_loss(Probability::new(0.3).expect("a probability"));
        let mut talk = Talk { heard: Vec::new() };
        let source = &mut SeededOracle::new(5, 5);
        let air =
            run(&network, Channel::Shared(SHARED), &faults, &mut talk, &begin, source).expect("known nodes");
        assert_eq!((air.sent, air.heard + air.collided + air.lost), (50, 98));
        assert!(air.heard > 0 && air.collided > 0 && air.lost > 0, "{air:?}");
        assert_eq!(air.heard, talk.heard.len() as u64);
    }

    #[test]
    fn noise_changes_the_distance_and_nothing_else() {
        let noisy = Faults::NONE.with_noise(6.0, Propagation::FREE_SPACE).expect("a noise");
        let mut source = SeededOracle::new(1, 1);
        let measured: Vec<u32> = (0..1000).map(|_| noisy.measured_um(1_000_000, &mut source)).collect();
        let nearer = measured.iter().filter(|&&one| one < 1_000_000).count();
        assert!((400..600).contains(&nearer), "{nearer}");
        assert_eq!(noisy.measured_um(1_000_000, &mut Tape(&[])), 1_000_000);
        assert!(
            [20.5, f64::NAN].iter().all(|&db| Faults::NONE.with_noise(db, Propagation::FREE_SPACE).is_err())
        );
    }
}
