//! Two robots that keep in touch as published (Peiris, sections 3 to 5), played plainly: a robot's marks are kept by
//! node and side, as the paper keeps them, so that readings of the request and of the mark can be played that the
//! kernel, which marks paths, does not have. Nothing of the kernel is used.
//!
//! Nodes are numbered row by row, sides are east, south, west, north from 0. A step is an arrival, a look ahead, or a
//! decision. Walls are decided as robots look at them, and where it is a matter of speeds whether a robot is seen, both
//! is tried. A robot that stands does not answer; one that asks is answered while the other one drives, and decides at
//! that moment. So news is true where a robot asks, which is the best for contact.

/// Where a robot runs KIT (row 27).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Runs {
    /// At every node.
    Every,
    /// Where the way ahead is blocked; else it drives straight on.
    Ahead,
}

/// Where a robot asks, and waits for the answer (row 27). A drive straight on needs no news.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Asks {
    /// At every node.
    Everywhere,
    /// Before a turn alone: it looks ahead first, and asks if the way is not free.
    BeforeTurns,
    /// At nodes alone that are new in its database. Elsewhere it decides by what it was told last: where the other one
    /// goes, and which sides that had marked then.
    NewNodes,
    /// At new nodes, and elsewhere before a turn.
    NewNodesAndTurns,
}

/// The side that a robot marks at the node to which it comes, when it comes (row 105). At the node that it leaves, it
/// always marks the side by which it leaves: “keep track of their turning directions”.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Marks {
    /// The one through which it has come.
    Entrance,
    /// The one towards which it was heading.
    Heading,
}

/// The nodes at which a robot that comes marks a side (row 105).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum At {
    EveryNode,
    /// Those that are not in its own database.
    NewNodes,
}

/// The sides of which the nearest is taken if no uncovered one is left (row 32).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Fallback {
    All,
    /// Those in reach of where the other one goes.
    Filtered,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Reading {
    pub(super) runs: Runs,
    pub(super) asks: Asks,
    pub(super) marks: Marks,
    pub(super) at: At,
    pub(super) fallback: Fallback,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Speeds {
    Any,
    /// The robot that has left first arrives first.
    Equal,
}

/// A clause that a step or the end of a run can break.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Demand {
    /// KIT-1, and at equal speeds KIT-2.
    Contact,
    /// KIT-1, where both stand.
    AtNodes,
    /// KIT-3.
    Apart,
    /// KIT-4.
    Answered,
    /// KIT-5.
    Fresh,
    /// KIT-6.
    Moves,
    /// KIT-8. No robot ever knows that all is done, so every end breaks it.
    Covers,
    /// KIT-10, of sides seen blocked.
    Marks,
    /// KIT-11.
    Shortens,
    /// KIT-14.
    AnyShortest,
}

#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
enum Task {
    /// It drives, or has come and not asked.
    None,
    /// It waits for an answer.
    Asks,
    /// It has found no side, and waits until the other one leaves or arrives.
    Stays,
}

/// A robot. What plays no part under a reading is left as it was at the start.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Robot {
    from: u8,
    to: u8,
    /// The way that it drove last.
    heading: Option<u8>,
    task: Task,
    /// Four bits for each node. If nobody decides by old news, those of both are in the record of the first.
    marks: u64,
    /// The other one's marks and next node, as it was told.
    told: u64,
    told_next: Option<u8>,
    /// A bit for each node of its database.
    database: u16,
}

impl Robot {
    pub(super) fn stands(&self) -> bool {
        self.from == self.to
    }

    fn has(&self, node: u8) -> bool {
        self.from == node || self.to == node
    }

    /// The node that it has left last, and the one where it goes or stands.
    pub(super) fn ends(&self) -> [u8; 2] {
        [self.from, self.to]
    }
}

/// Two robots, and what is decided of their lattice, with a bit for each path.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct State {
    pub(super) robots: [Robot; 2],
    /// Whether the first robot has left the reference node, so that the second one has entered.
    has_entered: bool,
    /// Of two that drive at equal speeds, the one that has left first.
    first: u8,
    open: u32,
    walls: u32,
    /// Whatever is marked.
    pub(super) driven: u32,
}

impl State {
    /// The other robot, if it has entered.
    fn other(&self, robot: usize) -> Option<Robot> {
        self.has_entered.then_some(self.robots[1 - robot])
    }

    /// This state in a lattice whose paths are known.
    pub(super) fn among(self, open: u32, walls: u32) -> Self {
        Self { open, walls, ..self }
    }
}

pub(super) struct Step {
    pub(super) after: State,
    pub(super) robot: usize,
    pub(super) is_drive: bool,
    pub(super) breaks: Vec<Demand>,
}

/// Columns, rows, and the most walls of a run.
pub(super) type Size = (u8, u8, u32);

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Setting {
    pub(super) reading: Reading,
    pub(super) speeds: Speeds,
    pub(super) size: Size,
}

/// The lattice.
impl Setting {
    pub(super) fn beyond(&self, node: u8, side: u8) -> Option<u8> {
        let (columns, rows, _) = self.size;
        let (x, y) = (node % columns, node / columns);
        match side {
            0 => (x + 1 < columns).then(|| node + 1),
            1 => (y + 1 < rows).then(|| node + columns),
            2 => (x > 0).then(|| node - 1),
            _ => (y > 0).then(|| node - columns),
        }
    }

    /// The bit of the path between two neighbours.
    pub(super) fn path(one: u8, other: u8) -> u32 {
        1 << (2 * u32::from(one.min(other)) + u32::from(one.abs_diff(other) > 1))
    }

    /// Those of these paths that paths join to a node.
    pub(super) fn paths_from(&self, node: u8, open: u32) -> u32 {
        let (mut nodes, mut place, mut paths) = (vec![node], 0, 0);
        while let Some(&from) = nodes.get(place) {
            for to in (0..4).filter_map(|side| self.beyond(from, side)) {
                let path = Self::path(from, to) & open;
                paths |= path;
                if path != 0 && !nodes.contains(&to) {
                    nodes.push(to);
                }
            }
            place += 1;
        }
        paths
    }

    /// The squared distance in paths.
    fn apart(&self, one: u8, other: u8) -> u32 {
        let columns = self.size.0;
        let (dx, dy) = ((one % columns).abs_diff(other % columns), (one / columns).abs_diff(other / columns));
        u32::from(dx).pow(2) + u32::from(dy).pow(2)
    }

    /// Whether nodes are at most 10 m apart, each path being 3 m.
    fn near(&self, one: u8, other: u8) -> bool {
        9 * self.apart(one, other) <= 100
    }

    /// Both robots at a node: the first one decides, and the second one has asked.
    pub(super) fn start(&self, node: u8) -> State {
        let database = if self.keeps_databases() { 1 << node } else { 0 };
        let (heading, task, told_next) = (None, Task::Asks, None);
        let robot = Robot { from: node, to: node, heading, task, marks: 0, told: 0, told_next, database };
        State { robots: [robot; 2], has_entered: false, first: 0, open: 0, walls: 0, driven: 0 }
    }

    /// Every start, but for those that are another one in a mirror.
    pub(super) fn starts(&self) -> Vec<State> {
        let (columns, rows, _) = self.size;
        let is_first = |node: &u8| 2 * (node % columns) < columns && 2 * (node / columns) < rows;
        (0..columns * rows).filter(is_first).map(|node| self.start(node)).collect()
    }

    /// The fewest single drives over driven paths, in contact and to different nodes, until a robot could drive an
    /// uncovered path; `None` if there is no such way.
    fn joint_way(&self, state: &State, places: [u8; 2]) -> Option<usize> {
        let (mut known, mut place) = (vec![(places, 0)], 0);
        while let Some(&(places, length)) = known.get(place) {
            for (robot, side) in (0..2).flat_map(|robot| (0..4).map(move |side| (robot, side))) {
                let (from, other) = (places[robot], places[1 - robot]);
                let Some(to) = self.beyond(from, side).filter(|&to| to != other) else { continue };
                let path = Self::path(from, to);
                if state.walls & path != 0 || !self.near(from, other) || !self.near(to, other) {
                    continue;
                }
                if state.driven & path == 0 {
                    return Some(length);
                }
                let mut after = places;
                after[robot] = to;
                if known.iter().all(|&(places, _)| places != after) {
                    known.push((after, length + 1));
                }
            }
            place += 1;
        }
        None
    }
}

/// The robots.
impl Setting {
    fn decides_by_old_news(&self) -> bool {
        self.reading.asks == Asks::NewNodes
    }

    fn keeps_databases(&self) -> bool {
        let Reading { asks, at, .. } = self.reading;
        at == At::NewNodes || matches!(asks, Asks::NewNodes | Asks::NewNodesAndTurns)
    }

    fn mark(&self, state: &mut State, robot: usize, node: u8, side: u8) {
        let keeper = if self.decides_by_old_news() { robot } else { 0 };
        state.robots[keeper].marks |= 1 << (4 * node + side);
    }

    /// A robot that stays begins anew when the other one leaves or arrives. Its node is no new one then.
    fn wake(&self, robot: &mut Robot) {
        if robot.task == Task::Stays {
            robot.task = if self.reading.asks == Asks::Everywhere { Task::Asks } else { Task::None };
        }
    }

    pub(super) fn steps(&self, state: &State) -> Vec<Step> {
        let mut steps = Vec::new();
        for robot in 0..2 {
            let [it, other] = [robot, 1 - robot].map(|robot| state.robots[robot]);
            if it.stands() {
                let is_there = robot == 0 || state.has_entered;
                steps.extend(is_there.then(|| self.decided(state, robot)).into_iter().flatten());
            } else if self.speeds == Speeds::Any || other.stands() || usize::from(state.first) == robot {
                steps.push(self.arrived(state, robot));
            }
        }
        for step in steps.iter_mut().filter(|step| self.leaves_blocked_side_unmarked(&step.after)) {
            step.breaks.push(Demand::Marks);
        }
        steps
    }

    /// Whether a path that was seen blocked is marked at neither end.
    fn leaves_blocked_side_unmarked(&self, state: &State) -> bool {
        let marks = state.robots[0].marks | state.robots[1].marks;
        let is_marked = |node: u8, side: u8| marks >> (4 * node + side) & 1 == 1;
        (0..self.size.0 * self.size.1).any(|node| {
            (0..4).any(|side| {
                let Some(to) = self.beyond(node, side) else { return false };
                let is_blocked = state.walls & Self::path(node, to) != 0;
                is_blocked && !is_marked(node, side) && !is_marked(to, (side + 2) % 4)
            })
        })
    }

    fn arrived(&self, state: &State, robot: usize) -> Step {
        let (mut after, Reading { asks, marks, at, .. }) = (*state, self.reading);
        let Robot { from, to, database, .. } = state.robots[robot];
        let is_new = database >> to & 1 == 0;
        let heading = (0..4).find(|&side| self.beyond(from, side) == Some(to)).expect("a side");
        if at == At::EveryNode || is_new {
            let entrance = (heading + 2) % 4;
            self.mark(&mut after, robot, to, if marks == Marks::Heading { heading } else { entrance });
        }
        let it = &mut after.robots[robot];
        it.from = to;
        it.database |= if self.keeps_databases() { 1 << to } else { 0 };
        it.task = match asks {
            Asks::Everywhere => Task::Asks,
            Asks::NewNodes | Asks::NewNodesAndTurns if is_new => Task::Asks,
            Asks::BeforeTurns | Asks::NewNodes | Asks::NewNodesAndTurns => Task::None,
        };
        let other = &mut after.robots[1 - robot];
        self.wake(other);
        let is_lost = other.stands() && !self.near(to, other.to);
        after.first = if self.speeds == Speeds::Equal { 1 - robot as u8 } else { 0 };
        let breaks = if is_lost { vec![Demand::AtNodes] } else { Vec::new() };
        Step { after, robot, is_drive: false, breaks }
    }

    /// All that a robot may do that stands.
    fn decided(&self, state: &State, robot: usize) -> Vec<Step> {
        let Reading { runs, asks, .. } = self.reading;
        let (mut now, other) = (*state, state.other(robot));
        let Robot { heading, task, .. } = state.robots[robot];
        let is_told = task == Task::Asks;
        if task == Task::Stays || is_told && other.is_some_and(|other| other.stands()) {
            return Vec::new();
        }
        let is_old = self.decides_by_old_news();
        if is_told && is_old {
            now.robots[robot].told = state.robots[1 - robot].marks;
            now.robots[robot].told_next = other.map(|other| other.to);
        }
        // Before a turn it has looked ahead, and then asked.
        let has_looked = is_told && asks == Asks::BeforeTurns;
        let ahead = heading.filter(|_| runs == Runs::Ahead && !has_looked);
        let turns_unasked = !is_told && matches!(asks, Asks::BeforeTurns | Asks::NewNodesAndTurns);
        let next = if is_old { now.robots[robot].told_next } else { other.map(|other| other.to) };
        let mut steps = Vec::new();
        for (mut seen, is_free) in
            ahead.map_or_else(|| vec![(now, false)], |side| self.see(&now, robot, side))
        {
            if let Some(side) = ahead.filter(|_| is_free) {
                let mut step = self.drives(&seen, robot, side);
                step.breaks.extend(self.broken_by_taking(&seen, robot, &[side]));
                steps.push(step);
            } else if turns_unasked {
                seen.robots[robot].task = Task::Asks;
                steps.push(Step { after: seen, robot, is_drive: false, breaks: Vec::new() });
            } else {
                let (turns, sides) = (steps.len(), self.sides(&seen, robot, next));
                self.turns(&seen, robot, next, sides, &mut steps);
                let looks = if ahead.is_some() { Vec::new() } else { self.looks(&seen, robot, next, sides) };
                if let Some(demand) = self.broken_by_taking(&seen, robot, &looks) {
                    let drives = steps[turns..].iter_mut().filter(|step| step.is_drive);
                    drives.for_each(|step| step.breaks.push(demand));
                }
                if next != other.map(|other| other.to) {
                    steps[turns..].iter_mut().for_each(|step| step.breaks.push(Demand::Fresh));
                }
            }
        }
        steps
    }

    /// The uncovered sides in reach of where the other one goes, and those of the fallback, a bit for each.
    fn sides(&self, state: &State, robot: usize, next: Option<u8>) -> [u8; 2] {
        let [one, two] = state.robots;
        let Robot { to: at, marks, told, .. } = state.robots[robot];
        let marks = if self.decides_by_old_news() { marks | told } else { one.marks | two.marks };
        let (mut uncovered, mut all) = (0, 0);
        for side in 0..4 {
            let Some(to) = self.beyond(at, side) else { continue };
            let is_near = next.is_none_or(|next| self.near(to, next));
            uncovered |= u8::from(is_near && marks >> (4 * at + side) & 1 == 0) << side;
            all |= u8::from(is_near || self.reading.fallback == Fallback::All) << side;
        }
        [uncovered, all]
    }

    /// The sides at one of which it looks next: any of the uncovered ones that are `left`, else that of the others that
    /// leads nearest to where the other one goes.
    fn looks(&self, state: &State, robot: usize, next: Option<u8>, left: [u8; 2]) -> Vec<u8> {
        let at = state.robots[robot].to;
        let far = |side: u8| match (self.beyond(at, side), next) {
            (Some(to), Some(next)) => self.apart(to, next),
            (None, _) | (_, None) => 0,
        };
        let sides = |list: u8| (0..4).filter(move |side| list >> side & 1 == 1);
        if left[0] != 0 {
            return sides(left[0]).collect();
        }
        let least = sides(left[1]).map(far).min();
        sides(left[1]).filter(|&side| Some(far(side)) == least).collect()
    }

    /// It looks at one side after the other until one is free.
    fn turns(&self, state: &State, robot: usize, next: Option<u8>, left: [u8; 2], steps: &mut Vec<Step>) {
        let list = usize::from(left[0] == 0);
        for side in self.looks(state, robot, next, left) {
            let mut fewer = left;
            fewer[list] &= !(1 << side);
            for (seen, is_free) in self.see(state, robot, side) {
                if is_free {
                    steps.push(self.drives(&seen, robot, side));
                } else {
                    self.turns(&seen, robot, next, fewer, steps);
                }
            }
        }
        if left == [0; 2] {
            let mut after = *state;
            after.robots[robot].task = Task::Stays;
            steps.push(Step { after, robot, is_drive: false, breaks: Vec::new() });
        }
    }

    /// All that a robot may see at a side of its node, and whether that is free: it sees half a metre beyond the next
    /// node.
    fn see(&self, state: &State, robot: usize, side: u8) -> Vec<(State, bool)> {
        let at = state.robots[robot].to;
        let Some(ahead) = self.beyond(at, side) else { return vec![(*state, false)] };
        let path = Self::path(at, ahead);
        let mut seen = Vec::new();
        if state.walls & path != 0 || state.open & path == 0 && state.walls.count_ones() < self.size.2 {
            seen.push((State { walls: state.walls | path, ..*state }, false));
        }
        if state.walls & path == 0 {
            let open = State { open: state.open | path, ..*state };
            let is_on = |end: u8| end == at || end == ahead;
            let other = state.other(robot).filter(|other| other.has(ahead));
            let is_sure = other.is_some_and(|other| is_on(other.from) && is_on(other.to));
            seen.extend(other.map(|_| (open, false)));
            seen.extend((!is_sure).then_some((open, true)));
        }
        seen
    }

    /// KIT-14, if it is broken by a robot that may take any of these sides after one look: those that were driven must
    /// be those that begin a shortest joint way.
    fn broken_by_taking(&self, state: &State, robot: usize, looks: &[u8]) -> Option<Demand> {
        let (at, places) = (state.robots[robot].to, state.robots.map(|robot| robot.to));
        let is_old =
            |side: u8| self.beyond(at, side).is_some_and(|to| state.driven & Self::path(at, to) != 0);
        let other = state.other(robot)?;
        let far = self.joint_way(state, places);
        let is_due = |side: u8| {
            let Some(to) = self.beyond(at, side).filter(|&to| is_old(side) && !other.has(to)) else {
                return false;
            };
            let mut after = places;
            after[robot] = to;
            other.ends().iter().all(|&end| self.near(at, end) && self.near(to, end))
                && self.joint_way(state, after).is_some_and(|left| Some(left + 1) == far)
        };
        let taken: Vec<u8> = (0..4).filter(|side| is_old(*side) && looks.contains(side)).collect();
        let is_other = !taken.is_empty() && !(0..4).filter(|&side| is_due(side)).eq(taken);
        is_other.then_some(Demand::AnyShortest)
    }

    fn drives(&self, state: &State, robot: usize, side: u8) -> Step {
        let (mut after, Reading { runs, marks, at, .. }) = (*state, self.reading);
        let from = state.robots[robot].to;
        let to = self.beyond(from, side).expect("a free side leads to a node");
        let it = &mut after.robots[robot];
        (it.to, it.task) = (to, Task::None);
        it.heading = Some(side).filter(|_| runs == Runs::Ahead);
        self.mark(&mut after, robot, from, side);
        if (marks, at) == (Marks::Entrance, At::EveryNode) {
            // The kernel marks both ends of a path at once.
            self.mark(&mut after, robot, to, (side + 2) % 4);
        }
        after.driven |= Self::path(from, to);
        after.has_entered = true;
        self.wake(&mut after.robots[1 - robot]);
        let is_equal = self.speeds == Speeds::Equal;
        let is_late = is_equal && state.other(robot).is_some_and(|other| !other.stands());
        after.first = if is_late { state.first } else { u8::from(is_equal && robot == 1) };
        let mut breaks = Vec::new();
        if let Some(other) = state.other(robot) {
            // The later one is not at its end while the earlier one is still where it left.
            let corners = [(from, other.from), (from, other.to), (to, other.to), (to, other.from)];
            let counted = &corners[..if is_late { 3 } else { 4 }];
            if !counted.iter().all(|&(one, other)| self.near(one, other)) {
                breaks.push(Demand::Contact);
            }
            let is_behind = is_late && other.from == to && self.beyond(to, side) == Some(other.to);
            if other.has(to) && !is_behind {
                breaks.push(Demand::Apart);
            }
        }
        let mut places = state.robots.map(|robot| robot.to);
        if state.driven & Self::path(from, to) != 0 {
            let now = self.joint_way(state, places);
            places[robot] = to;
            let then = self.joint_way(state, places);
            if !matches!((then, now), (Some(then), Some(now)) if then < now) {
                breaks.push(Demand::Shortens);
            }
        }
        Step { after, robot, is_drive: true, breaks }
    }

    /// The demands that are broken if a run ends here.
    pub(super) fn broken_at_end(&self, state: &State) -> Vec<Demand> {
        let entered = &state.robots[..=usize::from(state.has_entered)];
        let is_asked = entered.iter().any(|robot| robot.task == Task::Asks);
        let is_owed = self.joint_way(state, state.robots.map(|robot| robot.to)).is_some();
        let broken = [(Demand::Covers, true), (Demand::Answered, is_asked), (Demand::Moves, is_owed)];
        broken.into_iter().filter(|&(_, is)| is).map(|(demand, _)| demand).collect()
    }
}
