//! How many bytes the state of each rule takes: the table of docs/embed.md.

use std::fmt::Write;
use std::fs;

use tautline_kernel::chain::Chain;
use tautline_kernel::frontier::{self, TinyMap};
use tautline_kernel::ground::{CompactGrid, LargeGrid, MediumGrid, SmallGrid, TinyGrid};
use tautline_kernel::kit::{Kit, Talk};
use tautline_kernel::mrc::{Relay, Robot, Wfr};
use tautline_kernel::position::{Belief, Particle};
use tautline_kernel::tan::Homing;
use tautline_kernel::{bricks, notice};

/// A container of states, its type, and the bytes of it.
type Row = (&'static str, &'static str, usize);

const STATES: [Row; 16] = [
    ("a chain of 4 robots, 7×7 cells", "chain::Chain<TinyGrid, 4>", size_of::<Chain<TinyGrid, 4>>()),
    ("a chain of 6 robots, 11×11 cells", "chain::Chain<CompactGrid, 6>", size_of::<Chain<CompactGrid, 6>>()),
    ("a chain of 8 robots, 15×15 cells", "chain::Chain<SmallGrid, 8>", size_of::<Chain<SmallGrid, 8>>()),
    ("a chain of 32 robots, 63×63 cells", "chain::Chain<MediumGrid, 32>", size_of::<Chain<MediumGrid, 32>>()),
    ("a chain of 64 robots, 127×127 cells", "chain::Chain<LargeGrid, 64>", size_of::<Chain<LargeGrid, 64>>()),
    ("an agent of Brick&Mortar", "bricks::Agent", size_of::<bricks::Agent>()),
    ("a node that broadcasts", "notice::Node", size_of::<notice::Node>()),
    ("a robot that knows of 8 calls", "mrc::Robot<8>", size_of::<Robot<8>>()),
    ("a WFR that 8 robots answer", "mrc::Wfr<8>", size_of::<Wfr<8>>()),
    ("a path node with 8 routes", "mrc::Relay<8>", size_of::<Relay<8>>()),
    ("a robot on its way to a node", "tan::Homing", size_of::<Homing>()),
    ("a team of 4 on a lattice", "kit::Kit<TinyGrid, 4, 64>", size_of::<Kit<TinyGrid, 4, 64>>()),
    ("a robot of it that talks", "kit::Talk", size_of::<Talk>()),
    ("a robot at frontier cells", "frontier::Robot<TinyMap>", size_of::<frontier::Robot<TinyMap>>()),
    ("a particle of a swarm that locates a robot", "position::Particle", size_of::<Particle>()),
    ("where a robot takes itself to be, by wheels and fixes", "position::Belief", size_of::<Belief>()),
];

#[test]
#[cfg(target_pointer_width = "64")]
fn the_page_on_embedding_has_the_size_of_every_state() {
    let mut table = "| who keeps it | state | bytes |\n|---|---|---|\n".to_owned();
    for (who, state, bytes) in STATES {
        writeln!(table, "| {who} | `{state}` | {bytes} |").expect("room");
    }
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/embed.md");
    let page = fs::read_to_string(page).expect("the page");
    assert!(page.contains(&table), "docs/embed.md has another table, not\n{table}");
}
