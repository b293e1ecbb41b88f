//! A team that keeps in touch: the lattice, its walls, the rule, the starts, who acts next and what is seen are in the
//! bytes. When the bytes have ended, there are no more walls, and the first robot acts that can.

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Edge, EdgeMark, Grid, Side, SmallGrid, TinyGrid};
use tautline_kernel::kit::{Condition, Kit, Message, Next, Reach, Rule, Sight, Stance, touch};
use tautline_proofs::engine::Tape;

use super::parts::numbers;

/// A team of at most four.
type Team = Kit<SmallGrid, 4, 256>;

/// The longest side, in nodes.
const SIDE: u32 = 8;

/// Acts of a robot that are enough to end any run of a repaired team here.
const PATIENT: usize = 20_000;

/// Acts of a robot after which a published team, which never ends, is left.
const IMPATIENT: usize = 500;

/// Which sides are blocked, decided as robots look at them.
struct Walls {
    met: TinyGrid,
    left: u32,
}

impl Walls {
    fn is_blocked(&mut self, edge: Edge, oracle: &mut dyn Oracle) -> bool {
        if self.met.edge_has(EdgeMark::Open, edge) || self.met.edge_has(EdgeMark::Wall, edge) {
            return self.met.edge_has(EdgeMark::Wall, edge);
        }
        let is_wall = self.left > 0 && oracle.pick(256) >= 192;
        self.left -= u32::from(is_wall);
        self.met.put_edge(if is_wall { EdgeMark::Wall } else { EdgeMark::Open }, edge);
        is_wall
    }
}

/// Any bytes as fields of a message: whatever is read is written the same. Then a team of one to four robots, from its
/// start until it is done: a repaired one stays connected, apart, and covers what it can.
pub fn kit(bytes: &[u8]) {
    let numbers = numbers(bytes);
    let mut oracle = Tape(&numbers);
    let rule = match oracle.pick(4) {
        0 => Rule::PUBLISHED,
        1 => Rule { reach: Reach::of_paths(oracle.pick(4) as u16 + 2).expect("a reach"), ..Rule::REPAIRED },
        _ => Rule::REPAIRED,
    };
    message(&rule, &mut oracle);
    let robots = oracle.pick(4) as usize + 1;
    run(rule, robots, &mut oracle);
}

fn message(rule: &Rule, oracle: &mut dyn Oracle) {
    let fields = std::array::from_fn(|place| {
        // Flag, x and y, and four sides.
        if place < 3 { (256 * oracle.pick(4) + oracle.pick(256)) as i16 - 512 } else { oracle.pick(3) as i16 }
    });
    if let Ok((message, number)) = Message::decode(fields, rule) {
        let written = message.encode(number, rule);
        assert_eq!(Message::decode(written, rule), Ok((message, number)), "{fields:?}");
    }
}

fn run(rule: Rule, robots: usize, oracle: &mut dyn Oracle) {
    let (width, height) = (SIDE - oracle.pick(SIDE), SIDE - oracle.pick(SIDE));
    let last = Cell::new(width as i16 - 1, height as i16 - 1);
    let area = Area::new(Cell::new(0, 0), last).expect("it has nodes");
    let met = TinyGrid::new(area).expect("at most 8 nodes a side");
    let mut walls = Walls { met, left: oracle.pick(32) };
    let start = |_| Cell::new(oracle.pick(width) as i16, oracle.pick(height) as i16);
    let starts: Vec<Cell> = (0..robots).map(start).collect();
    let map = SmallGrid::new(area).expect("at most 16 nodes a side");
    let Ok(mut team) = Team::new(rule, map, &starts) else { return };
    let is_repaired = rule.has(Condition::Stays);
    for act in 0.. {
        let acting: Vec<usize> = (0..robots)
            .filter(|&robot| {
                team.may_decide(robot) || team.stance(robot).is_some_and(|stance| !stance.stands())
            })
            .collect();
        if acting.is_empty() || act == IMPATIENT && !is_repaired {
            break;
        }
        assert!(act < PATIENT, "the team is still under way");
        let robot = acting[oracle.pick(acting.len() as u32) as usize];
        if team.may_decide(robot) {
            decide(&mut team, robot, &mut walls, oracle);
        } else {
            team.arrived(robot).expect("it drives");
        }
        if is_repaired {
            let stances: Vec<Stance> = team.stances().collect();
            assert!(are_connected(&stances, rule.reach), "out of contact: {stances:?}");
            assert!(are_apart(&stances), "nearer than a path: {stances:?}");
        }
    }
    if is_repaired && robots == 1 {
        let uncovered = area.cells().filter(|&node| !team.uncovered_by_all(node).is_empty());
        let known = uncovered.filter(|&node| !team.known(EdgeMark::Open, node).is_empty()).count();
        assert!(team.is_over() && known == 0, "one robot leaves {known} nodes with uncovered sides");
    }
    if is_repaired && robots <= 2 {
        assert!(team.is_over(), "the run ends, and a robot does not know it");
    }
}

/// `robot` decides, and looks until it has decided.
fn decide(team: &mut Team, robot: usize, walls: &mut Walls, oracle: &mut dyn Oracle) {
    let at = team.stance(robot).expect("a robot").to();
    let mut next = team.decide(robot, oracle).expect("it may decide");
    while let Next::Looks(side) = next {
        let sight = if walls.is_blocked(Edge::new(at, side), oracle) {
            Sight::Obstacle
        } else if sees(team, robot, (at, side), oracle) {
            Sight::Robot
        } else {
            Sight::Free
        };
        next = team.looked(robot, sight, oracle).expect("it looks");
    }
}

/// Whether `robot` sees another one at a side of its node; where that depends on speeds, the bytes say it.
fn sees(team: &Team, robot: usize, (at, side): (Cell, Side), oracle: &mut dyn Oracle) -> bool {
    let others = team.stances().enumerate().filter(|&(other, _)| other != robot);
    others.into_iter().any(|(_, other)| touch(at, side, other).unwrap_or_else(|| oracle.flip()))
}

/// Whether all robots hear each other, directly or over others, at any speeds, in plain arithmetic.
fn are_connected(stances: &[Stance], reach: Reach) -> bool {
    let ends = |stance: Stance| [stance.from(), stance.to()];
    let near = |one: Cell, other: Cell| {
        let (dx, dy) = (i64::from(one.x - other.x), i64::from(one.y - other.y));
        dx * dx + dy * dy <= i64::from(reach.squared())
    };
    let hear = |one: Stance, other: Stance| {
        ends(one).iter().all(|&one| ends(other).iter().all(|&other| near(one, other)))
    };
    let mut reached: Vec<usize> = vec![0];
    let mut place = 0;
    while let Some(&robot) = reached.get(place) {
        let new: Vec<usize> = (0..stances.len())
            .filter(|other| !reached.contains(other) && hear(stances[robot], stances[*other]))
            .collect();
        reached.extend(new);
        place += 1;
    }
    reached.len() == stances.len()
}

/// Whether no two robots have an end of their paths in common.
fn are_apart(stances: &[Stance]) -> bool {
    let pairs = stances
        .iter()
        .enumerate()
        .flat_map(|(place, one)| stances[place + 1..].iter().map(move |other| (*one, *other)));
    pairs.into_iter().all(|(one, other)| !one.has(other.from()) && !one.has(other.to()))
}
