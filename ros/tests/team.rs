//! The node's program, and a team of robots that it watches: both speak over loopback, and what the team writes and
//! reads is encoded by the crate `cdr`, which shares no code with the node's `cdr-encoding`.

use ros2_client::{Context, Node};
use rustdds::bytes::Bytes;
use rustdds::no_key::{
    DataWriter, Decode, DefaultDecoder, DeserializerAdapter, SerializerAdapter, SimpleDataReader,
};
use rustdds::{QosPolicies, QosPolicyBuilder, RepresentationIdentifier, TopicKind, policy};
use serde::Serialize;
use serde::de::DeserializeOwned;
use signal_hook::consts::SIGTERM;
use std::fs::{self, File};
use std::marker::PhantomData;
use std::process::{Child, Command, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::sleep;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};
use tautline_ros::messages::{Header, Point, Pose, PoseStamped, Time};
use tautline_ros::node::join;
use tempfile::TempDir;

/// A domain for a test of this process: its ports are below those that systems give away.
pub(crate) fn domain(test: u16) -> u16 {
    30 + (std::process::id() % 17) as u16 * 4 + test
}

/// The node's program.
pub(crate) fn program() -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_tautline-ros"));
    program.env_remove("ROS_DOMAIN_ID").stdin(Stdio::null());
    program
}

/// A node that runs. It ends with the test.
pub(crate) struct NodeProcess {
    child: Child,
    folder: TempDir,
}

impl NodeProcess {
    pub(crate) fn start(domain: u16, config: &str) -> Self {
        let folder = TempDir::new().expect("a folder");
        let file = folder.path().join("tautline.toml");
        fs::write(&file, config).expect("a file");
        let said = File::create(folder.path().join("said")).expect("a file");
        let child = program().arg(file).args(["--domain", &domain.to_string()]).stderr(said).spawn();
        Self { child: child.expect("the program"), folder }
    }

    /// The memory that it has in use, in KiB, where the system says so.
    pub(crate) fn memory_kib(&self) -> Option<u64> {
        let status = fs::read_to_string(format!("/proc/{}/status", self.child.id())).ok()?;
        status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?.trim().strip_suffix(" kB")?.parse().ok()
    }

    /// Ends it as a system does, and returns its exit code and what it said.
    pub(crate) fn end(mut self) -> (Option<i32>, String) {
        let pid = self.child.id().to_string();
        let killed = Command::new("kill").args([format!("-{SIGTERM}"), pid]).status();
        assert!(killed.expect("kill").success());
        let code = self.child.wait().expect("an end").code();
        (code, fs::read_to_string(self.folder.path().join("said")).expect("text"))
    }
}

impl Drop for NodeProcess {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The crate `cdr` in the place of the library's own code.
#[derive(Clone)]
pub(crate) struct Cdr;

impl<M: Serialize> SerializerAdapter<M> for Cdr {
    type Error = cdr::Error;

    fn output_encoding() -> RepresentationIdentifier {
        RepresentationIdentifier::CDR_LE
    }

    fn to_bytes(message: &M) -> Result<Bytes, cdr::Error> {
        let bytes = cdr::serialize::<_, _, cdr::CdrLe>(message, cdr::Infinite)?;
        Ok(Bytes::from(bytes).slice(4..))
    }
}

impl<M: DeserializeOwned> DeserializerAdapter<M> for Cdr {
    type Error = cdr::Error;
    type Decoded = M;

    fn supported_encodings() -> &'static [RepresentationIdentifier] {
        &[RepresentationIdentifier::CDR_LE]
    }

    fn transform_decoded(decoded: M) -> M {
        decoded
    }
}

impl<M: DeserializeOwned> DefaultDecoder<M> for Cdr {
    type Decoder = Self;
    const DECODER: Self = Self;
}

impl<M: DeserializeOwned> Decode<'_, M> for Cdr {
    type Error = cdr::Error;

    fn decode_bytes(self, bytes: &[u8], _: RepresentationIdentifier) -> Result<M, cdr::Error> {
        cdr::deserialize(&[&[0, 1, 0, 0], bytes].concat())
    }
}

/// The team's publisher on one topic.
pub(crate) type Mouth<M> = DataWriter<M, Cdr>;

/// The team's subscriber on one topic.
pub(crate) struct Ear<M: DeserializeOwned + 'static>(SimpleDataReader<M, Cdr>, PhantomData<M>);

impl<M: DeserializeOwned + 'static> Ear<M> {
    /// The next message, if there is one.
    pub(crate) fn take(&self) -> Option<M> {
        Some(self.0.try_take_one().expect("a message")?.into_value())
    }
}

/// The library wants one participant in a process.
static ALONE: Mutex<()> = Mutex::new(());

/// The programs of the robots. There is one team at a time.
pub(crate) struct Team {
    context: Context,
    _node: Node,
    quality: QosPolicies,
    _alone: MutexGuard<'static, ()>,
}

impl Team {
    pub(crate) fn new(domain: u16) -> Self {
        let alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
        let (context, node) = join("team", domain).expect("a network");
        let reliable =
            policy::Reliability::Reliable { max_blocking_time: rustdds::Duration::from_millis(100) };
        let history = policy::History::KeepLast { depth: 100 };
        let quality = QosPolicyBuilder::new().reliability(reliable).history(history).build();
        Self { context, _node: node, quality, _alone: alone }
    }

    fn topic(&self, name: &str, kind: &str) -> rustdds::Topic {
        let (package, message) = kind.split_once('/').expect("a type");
        let (name, kind) = (format!("rt{name}"), format!("{package}::msg::dds_::{message}_"));
        let participant = self.context.domain_participant();
        participant.create_topic(name, kind, &self.quality, TopicKind::NoKey).expect("a topic")
    }

    pub(crate) fn mouth<M: Serialize>(&self, name: &str, kind: &str) -> Mouth<M> {
        let publisher =
            self.context.domain_participant().create_publisher(&self.quality).expect("a publisher");
        publisher.create_datawriter_no_key(&self.topic(name, kind), None).expect("a writer")
    }

    pub(crate) fn ear<M: DeserializeOwned + 'static>(&self, name: &str, kind: &str) -> Ear<M> {
        let subscriber =
            self.context.domain_participant().create_subscriber(&self.quality).expect("a subscriber");
        let reader = subscriber.create_simple_datareader_no_key(&self.topic(name, kind), None);
        Ear(reader.expect("a reader"), PhantomData)
    }
}

/// The header of a message of now, in the frame of the map.
pub(crate) fn header() -> Header {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).expect("a clock");
    Header { stamp: Time::from_micros(since.as_micros() as u64), frame_id: "map".to_owned() }
}

/// A place along the first axis, in the middle of cells of one metre along the second.
pub(crate) fn at(x: f64) -> Pose {
    Pose { position: Point { x, y: 0.5, z: 0.0 }, ..Pose::default() }
}

/// A pose of now.
pub(crate) fn pose(x: f64) -> PoseStamped {
    PoseStamped { header: header(), pose: at(x) }
}

/// Repeats `step` every few milliseconds until it has an answer. That there is none for a minute is a failure: no test
/// waits for long, and none says how long it waited.
pub(crate) fn until<T>(awaited: &str, mut step: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(answer) = step() {
            return answer;
        }
        assert!(start.elapsed() < Duration::from_mins(1), "{awaited} did not come");
        sleep(Duration::from_millis(5));
    }
}
