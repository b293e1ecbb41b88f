//! The network: poses are heard by a DDS library, and what is known of the clauses is published: at once when there is
//! news, and once a second.

use super::config::{Config, Kind, Robot};
use super::messages::{DiagnosticArray, Header, MarkerArray, Odometry, Point, PoseStamped, Time};
use super::tell;
use super::watch::Watch;
use ros2_client::qos::{History, WhenFull};
use ros2_client::{
    Context, ContextOptions, MessageTypeName, Name, Node, NodeName, NodeOptions, Publisher, QosProfile,
    Subscription,
};
use rustdds::mio1::event::Source;
use rustdds::mio1::{Events, Interest, Poll, Token};
use socket2::{Domain, SockAddr, Socket, Type};
use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::fmt::{self, Display};
use std::io;
use std::net::{Ipv4Addr, SocketAddr};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};
use tautline_monitor::SetupError;

/// How often all is published without news.
const EACH: Duration = Duration::from_secs(1);

/// How long the node sleeps where nobody publishes. Silence is noticed that much later than the gap.
const PATIENCE: Duration = Duration::from_millis(20);

/// How many poses of a robot are kept until they are judged.
const KEPT: usize = 100;

/// The last domain whose ports all exist.
pub const LAST_DOMAIN: u16 = 231;

/// The reason why there is no node.
#[derive(Debug)]
pub enum NodeError {
    /// A port that all programs of a domain share is taken by one that does not share it.
    Taken {
        /// The UDP port.
        port: u16,
        /// The domain.
        domain: u16,
        /// The word of the system.
        why: io::Error,
    },
    /// The DDS library has no network.
    Dds(String),
    /// A clause cannot be watched.
    Setup(SetupError),
}

impl Display for NodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Taken { port, domain, why } => write!(
                f,
                "UDP port {port}, which all programs of domain {domain} share, cannot be had ({why}): end the program \
                 that has it (`ss -ulpn` names it), or choose another --domain"
            ),
            Self::Dds(why) => write!(f, "the network cannot be opened: {why}"),
            Self::Setup(why) => write!(f, "a clause cannot be watched: {why}"),
        }
    }
}

impl std::error::Error for NodeError {}

/// The word of the DDS library.
fn dds(why: impl Display) -> NodeError {
    NodeError::Dds(why.to_string())
}

/// Checks that the ports can be had at which all programs of a domain hear: the library would go on without them, and
/// hear nobody of another machine.
fn check_ports(domain: u16) -> Result<(), NodeError> {
    let first = 7_400 + 250 * domain;
    for port in [first, first + 1] {
        let bind = || {
            let socket = Socket::new(Domain::IPV4, Type::DGRAM, None)?;
            socket.set_reuse_address(true)?;
            #[cfg(unix)]
            socket.set_reuse_port(true)?;
            socket.bind(&SockAddr::from(SocketAddr::from((Ipv4Addr::UNSPECIFIED, port))))
        };
        bind().map_err(|why| NodeError::Taken { port, domain, why })?;
    }
    Ok(())
}

/// A node of a domain.
///
/// # Errors
/// A port of the domain is taken, or the DDS library has no network.
pub fn join(name: &str, domain: u16) -> Result<(Context, Node), NodeError> {
    if domain > LAST_DOMAIN {
        return Err(NodeError::Dds(format!("domains are from 0 to {LAST_DOMAIN}")));
    }
    check_ports(domain)?;
    let context = Context::with_options(ContextOptions::new().domain_id(domain)).map_err(dds)?;
    // Nobody answers for parameters, as there are none.
    let options = NodeOptions::new().enable_rosout(false).start_parameter_services(false);
    let name = NodeName::new("/", name).map_err(dds)?;
    let node = context.new_node(name, options).map_err(dds)?;
    Ok((context, node))
}

impl Kind {
    fn message_type(self) -> MessageTypeName {
        match self {
            Self::PoseStamped => MessageTypeName::new("geometry_msgs", "PoseStamped"),
            Self::Odometry => MessageTypeName::new("nav_msgs", "Odometry"),
        }
    }
}

/// A subscription to the poses of a robot.
enum Poses {
    Stamped(Subscription<PoseStamped>),
    Odometry(Subscription<Odometry>),
}

impl Poses {
    /// Whoever publishes is heard, also without acknowledgements: an old pose is not worth asking for again.
    fn subscribe(node: &mut Node, robot: &Robot) -> Result<Self, NodeError> {
        let quality = QosProfile::subscription_default().history(History::KeepLast { depth: KEPT });
        let name = Name::parse(&robot.topic).map_err(dds)?;
        let topic = node.create_topic(&name, robot.kind.message_type(), &quality).map_err(dds)?;
        Ok(match robot.kind {
            Kind::PoseStamped => Self::Stamped(node.create_subscription(&topic, None).map_err(dds)?),
            Kind::Odometry => Self::Odometry(node.create_subscription(&topic, None).map_err(dds)?),
        })
    }

    fn source(&mut self) -> &mut dyn Source {
        match self {
            Self::Stamped(subscription) => subscription,
            Self::Odometry(subscription) => subscription,
        }
    }

    /// The next pose, if there is one, or why it cannot be read.
    fn take(&self) -> Result<Option<(Header, Point)>, String> {
        match self {
            Self::Stamped(subscription) => {
                let taken = subscription.take().map_err(|error| error.to_string())?;
                Ok(taken.map(|(message, _)| (message.header, message.pose.position)))
            }
            Self::Odometry(subscription) => {
                let taken = subscription.take().map_err(|error| error.to_string())?;
                Ok(taken.map(|(message, _)| (message.header, message.pose.pose.position)))
            }
        }
    }
}

fn publisher<M: serde::Serialize>(
    node: &mut Node,
    topic: &str,
    message: MessageTypeName,
) -> Result<Publisher<M>, NodeError> {
    let quality = QosProfile::publisher_default()
        .reliability_reliable(WhenFull::DEFAULT)
        .history(History::KeepLast { depth: 10 });
    let topic = node.create_topic(&Name::parse(topic).map_err(dds)?, message, &quality).map_err(dds)?;
    node.create_publisher(&topic, None).map_err(dds)
}

/// By topic, as DDS calls it: the types of those who publish it.
fn published_types(context: &Context) -> BTreeMap<String, String> {
    let writers = context.domain_participant().discovered_writers().into_iter();
    let named = writers.map(|writer| {
        let topic = writer.publication_topic_data;
        (topic.topic_name, topic.type_name)
    });
    named.collect()
}

/// Why a robot that is not heard is not, if that is for all to see.
fn trouble(robot: &Robot, published: &BTreeMap<String, String>) -> Option<String> {
    match published.get(&format!("rt{}", robot.topic)) {
        None => Some(format!("nobody publishes {}", robot.topic)),
        Some(kind) if *kind != robot.kind.message_type().dds_msg_type() => {
            Some(format!("{} is published as {kind}: give that type in the configuration", robot.topic))
        }
        Some(_) => None,
    }
}

/// The publishers of what is known.
struct Voice<'a> {
    context: &'a Context,
    diagnostics: Publisher<DiagnosticArray>,
    markers: Publisher<MarkerArray>,
}

impl Voice<'_> {
    /// Publishes all that is known, and says on stderr what is news.
    fn say(&self, watch: &mut Watch) {
        let published = OnceCell::new();
        let trouble = |robot: &Robot| trouble(robot, published.get_or_init(|| published_types(self.context)));
        let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        let diagnostics = watch.diagnostics(Time::from_micros(since.as_micros() as u64), trouble);
        let told = diagnostics.status.iter().zip(watch.mark_told()).filter(|(_, is_news)| *is_news);
        let news: Vec<_> = told.map(|(status, _)| format!("{}: {}", status.name, status.message)).collect();
        // Robots come first: whoever reads stderr may be slow.
        if let Err(error) = self.diagnostics.publish(diagnostics) {
            tell!("diagnostics are not published: {}", error.forget_data());
        }
        if let Err(error) = self.markers.publish(watch.markers()) {
            tell!("markers are not published: {}", error.forget_data());
        }
        news.iter().for_each(|line| tell!("{line}"));
    }
}

/// Watches robots until `stop` is set.
///
/// # Errors
/// There is no network, or a clause would be kept wherever robots are.
pub fn run(config: Config, (context, mut node): (Context, Node), stop: &AtomicBool) -> Result<(), NodeError> {
    let subscribed = config.robots.iter().map(|robot| Poses::subscribe(&mut node, robot));
    let mut robots = subscribed.collect::<Result<Vec<_>, _>>()?;
    let diagnostics =
        publisher(&mut node, "/diagnostics", MessageTypeName::new("diagnostic_msgs", "DiagnosticArray"))?;
    let markers =
        publisher(&mut node, "/tautline/markers", MessageTypeName::new("visualization_msgs", "MarkerArray"))?;
    let voice = Voice { context: &context, diagnostics, markers };
    let mut poll = Poll::new().map_err(dds)?;
    for (robot, poses) in robots.iter_mut().enumerate() {
        poll.registry().register(poses.source(), Token(robot), Interest::READABLE).map_err(dds)?;
    }
    let mut watch = Watch::new(config).map_err(NodeError::Setup)?;
    let (mut events, mut due) = (Events::with_capacity(64), Instant::now());
    while !stop.load(Ordering::Relaxed) {
        match poll.poll(&mut events, Some(PATIENCE)) {
            Err(error) if error.kind() != io::ErrorKind::Interrupted => return Err(dds(error)),
            Ok(()) | Err(_) => {}
        }
        // One pose of each robot after the other: a backlog of one robot is not judged by old poses of the others.
        // There is a bound, so that a flood of poses does not keep the node from its other duties.
        for _ in 0..KEPT {
            let mut is_quiet = true;
            for (robot, poses) in robots.iter().enumerate() {
                let (taken, now) = (poses.take(), Instant::now());
                match taken {
                    Ok(Some((header, position))) => watch.hear(robot, &header, &position, now),
                    Ok(None) => continue,
                    Err(why) => watch.refuse(robot, why, now),
                }
                is_quiet = false;
                if watch.look(now) {
                    voice.say(&mut watch);
                }
            }
            if is_quiet {
                break;
            }
        }
        let now = Instant::now();
        if watch.look(now) || now >= due {
            voice.say(&mut watch);
            due = now + EACH;
        }
    }
    Ok(())
}
