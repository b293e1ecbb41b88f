//! KIT-1, KIT-3, KIT-6 to KIT-8, KIT-12 and KIT-13. Lengths are metres, times are seconds.

use std::collections::{BTreeSet, VecDeque};

use super::{BrokenClause, Floor, Place, broken};

/// A drive over a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drive {
    pub(crate) robot: usize,
    pub(crate) from: Place,
    pub(crate) to: Place,
    pub(crate) begin: f64,
    pub(crate) end: f64,
}

/// A whole run of robots that keep in touch.
pub(crate) struct Kit<'a> {
    pub(crate) floor: &'a Floor,
    pub(crate) starts: &'a [Place],
    pub(crate) drives: &'a [Drive],
    /// Whether it has ended by itself.
    pub(crate) by_itself: bool,
    /// Whether every robot knows that it has.
    pub(crate) is_known: bool,
}

/// From a node to the next one.
const PATH: f64 = 3.0;
/// As far as robots hear each other.
const REACH: f64 = 10.0;
/// The error that rounding may make.
const SLIP: f64 = 1e-6;

impl Kit<'_> {
    pub(crate) fn judge(&self) -> Result<(), BrokenClause> {
        let robots = self.starts.len();
        let contact = if robots > 2 { "KIT-12" } else { "KIT-1" };
        let mut at = self.starts.to_vec();
        for drive in self.drives {
            let is_a_drive = at[drive.robot] == drive.from && self.floor.is_open(drive.from, drive.to);
            broken(!is_a_drive || drive.begin >= drive.end, "KIT-3", || format!("{drive:?} leads nowhere"))?;
            at[drive.robot] = drive.to;
            let ends = self.ends(drive);
            let is_near = |&(one, other): &(usize, usize)| {
                ends[one].iter().all(|&one| {
                    ends[other].iter().all(|&other| distance(metres(one), metres(other)) <= REACH)
                })
            };
            broken(!is_connected(robots, is_near), contact, || format!("at some speeds, in {drive:?}"))?;
            let is_met = |other: usize| other != drive.robot && ends[other].contains(&drive.to);
            broken((0..robots).any(is_met), "KIT-3", || format!("at some speeds, in {drive:?}"))?;
        }
        let mut times: Vec<f64> = self.drives.iter().flat_map(|drive| [drive.begin, drive.end]).collect();
        times.sort_by(f64::total_cmp);
        for span in times.windows(2) {
            let [before, after] = [span[0], span[1]].map(|time| self.positions(time));
            // Robots keep their speeds in between: they are farthest from each other at an end.
            let is_near = |&(one, other): &(usize, usize)| {
                [&before, &after].iter().all(|at| distance(at[one], at[other]) <= REACH + SLIP)
            };
            broken(!is_connected(robots, is_near), contact, || format!("at {span:?} s"))?;
            let is_close = |(one, other): (usize, usize)| {
                nearest([before[one], after[one]], [before[other], after[other]]) < PATH - SLIP
            };
            broken(pairs(robots).any(is_close), "KIT-3", || format!("at {span:?} s"))?;
        }
        broken(!self.by_itself, "KIT-7", || "the run goes on".to_owned())?;
        let driven: BTreeSet<(Place, Place)> =
            self.drives.iter().map(|drive| side(drive.from, drive.to)).collect();
        let joined = self.floor.walkable(self.starts);
        let is_left = |node: Place| self.floor.beside(node).find(|&to| !driven.contains(&side(node, to)));
        let left = joined.iter().find_map(|&node| Some((node, is_left(node)?)));
        if robots > 2 {
            let is_full = joined.len() == robots;
            broken(left.is_some() && !is_full, "KIT-13", || format!("{left:?} is not driven"))?;
            return broken(!self.is_known && !is_full, "KIT-13", || {
                "not all know that it is over".to_owned()
            });
        }
        let within_reach = left.and_then(|_| self.within_reach(&at, &driven));
        let clause = if self.is_known { "KIT-8" } else { "KIT-6" };
        broken(within_reach.is_some(), clause, || {
            format!("{within_reach:?} is within reach and not driven")
        })?;
        broken(!self.is_known, "KIT-8", || "not all know that it is over".to_owned())
    }

    /// By robot: both ends of its stance when this drive begins.
    fn ends(&self, drive: &Drive) -> Vec<[Place; 2]> {
        let mut ends: Vec<[Place; 2]> = self.starts.iter().map(|&start| [start; 2]).collect();
        let begun = self.drives.iter().take_while(|other| !std::ptr::eq(*other, drive));
        for other in begun.chain([drive]) {
            let is_over = other.end <= drive.begin;
            ends[other.robot] = if is_over { [other.to; 2] } else { [other.from, other.to] };
        }
        ends
    }

    /// Where all robots are.
    fn positions(&self, time: f64) -> Vec<[f64; 2]> {
        let mut at: Vec<[f64; 2]> = self.starts.iter().map(|&start| metres(start)).collect();
        for drive in self.drives.iter().filter(|drive| drive.begin <= time) {
            let gone = ((time - drive.begin) / (drive.end - drive.begin)).min(1.0);
            let (from, to) = (metres(drive.from), metres(drive.to));
            at[drive.robot] = [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * gone);
        }
        at
    }

    /// A side that is not driven, and that two robots could come to and drive through: by single drives over driven
    /// paths, each in contact and to a node of its own.
    fn within_reach(&self, at: &[Place], driven: &BTreeSet<(Place, Place)>) -> Option<(Place, Place)> {
        let &[one, other] = at else {
            // A robot alone comes to whatever paths join to it.
            let nodes = self.floor.walkable(at).into_iter();
            let mut left = nodes.flat_map(|node| self.floor.beside(node).map(move |to| (node, to)));
            return left.find(|&(node, to)| !driven.contains(&side(node, to)));
        };
        let mut seen = BTreeSet::from([[one, other]]);
        let mut queue = VecDeque::from([[one, other]]);
        while let Some(nodes) = queue.pop_front() {
            for robot in 0..2 {
                let (from, other) = (nodes[robot], nodes[1 - robot]);
                for to in self.floor.beside(from) {
                    if to == other || distance(metres(to), metres(other)) > REACH {
                        continue;
                    }
                    if !driven.contains(&side(from, to)) {
                        return Some((from, to));
                    }
                    let mut next = nodes;
                    next[robot] = to;
                    if seen.insert(next) {
                        queue.push_back(next);
                    }
                }
            }
        }
        None
    }
}

fn side(one: Place, other: Place) -> (Place, Place) {
    (one.min(other), one.max(other))
}

fn metres((x, y): Place) -> [f64; 2] {
    [f64::from(x) * PATH, f64::from(y) * PATH]
}

fn distance(one: [f64; 2], other: [f64; 2]) -> f64 {
    (one[0] - other[0]).hypot(one[1] - other[1])
}

/// The least distance of two robots that go from the first to the second place each, at steady speeds in the same time.
fn nearest(one: [[f64; 2]; 2], other: [[f64; 2]; 2]) -> f64 {
    let apart = |end: usize| [0, 1].map(|axis| one[end][axis] - other[end][axis]);
    let (first, last) = (apart(0), apart(1));
    let gone = [0, 1].map(|axis| last[axis] - first[axis]);
    let length = gone[0] * gone[0] + gone[1] * gone[1];
    let share = if length > 0.0 { -(first[0] * gone[0] + first[1] * gone[1]) / length } else { 0.0 };
    let share = share.clamp(0.0, 1.0);
    (first[0] + share * gone[0]).hypot(first[1] + share * gone[1])
}

fn pairs(robots: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..robots).flat_map(move |one| (one + 1..robots).map(move |other| (one, other)))
}

/// Whether these pairs join all robots.
fn is_connected(robots: usize, is_near: impl Fn(&(usize, usize)) -> bool) -> bool {
    let mut groups: Vec<usize> = (0..robots).collect();
    for (one, other) in pairs(robots).filter(is_near) {
        let (kept, gone) = (groups[one], groups[other]);
        for group in groups.iter_mut().filter(|group| **group == gone) {
            *group = kept;
        }
    }
    groups.iter().all(|&group| group == groups[0])
}
