//! The sentences that every team move of a run is checked for. They are those of `SPEC.md`, in plain arithmetic of
//! their own: of the kernel's rule only the names of its conditions are used, and for CHAIN-16, which is about it, the
//! admission relation.

use serde::{Deserialize, Serialize};
use tautline_kernel::chain::{Budget, Chain, Condition, Intent, Kind, Message, Outcome, Plan, Pursuit, Rule};
use tautline_kernel::ground::{Avoid, Cell, CellMark, Edge, EdgeMark, Grid, Step};

use super::breach::Breach;
use super::environment::{in_covered, in_safe};
use super::plain_reel::PlainReel;
use super::plain_walk::{Map, walk};
use super::subject::Subject;
use crate::engine::{Stop, require};

/// One team move, with the chain in its three states.
pub(crate) struct Moment<'a, G, const ROBOTS: usize> {
    pub(crate) observed: &'a Subject,
    /// When it was asked for a plan.
    pub(crate) before: &'a Chain<G, ROBOTS>,
    /// When it had planned: new virtual obstacles, perhaps a new epoch.
    pub(crate) planned: &'a Chain<G, ROBOTS>,
    /// When it had moved.
    pub(crate) after: &'a Chain<G, ROBOTS>,
    pub(crate) plan: &'a Plan<ROBOTS>,
    /// The steps that are taken for the plan's, base first.
    pub(crate) steps: &'a [Step],
    /// Of R_2 … R_N, as they arrived.
    pub(crate) messages: &'a [u8],
}

/// A demand on every team move.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Invariant {
    /// CHAIN-1, CHAIN-2, CHAIN-3, and at the end of a run CHAIN-13.
    Without(Breach),
    /// CHAIN-4: only admitted plans.
    Admitted,
    /// CHAIN-5: no shared planned cell outside the base.
    Distinct,
    /// CHAIN-6: the base stays.
    BaseStays,
    /// CHAIN-7: the measure that makes every run end.
    Progress,
    /// CHAIN-7, by another way: no run comes back to where it was.
    Ends,
    /// CHAIN-8: who hears the bytes knows the state.
    Heard,
    /// CHAIN-12: no plan costs more than the budget of the rule.
    Cheap,
    /// CHAIN-14: at the end of a run, every cell that a chain can reach at all is explored.
    Exhausts,
    /// CHAIN-16: the planner makes no plan that is not admitted.
    Certified,
    /// CHAIN-17: the measure that makes every run of the reel end.
    Falls,
    /// CHAIN-18: what is rehearsed comes so.
    Arrives,
    /// CHAIN-19: contact, whoever goes first or not at all.
    AnyOrder,
    /// CHAIN-23: take-backs of 1, 2, 4 and more team moves.
    Doubles,
    /// CHAIN-24: at the end of a run, not too many team moves for the walls that it has met.
    Short,
    /// CHAIN-25: the team moves are those of the procedure.
    Chosen,
    /// CHAIN-27: of two robots that come together one is blocked.
    Meets,
    /// CHAIN-27, of advances alone.
    MeetsInAdvance,
    /// CHAIN-28: no two robots exchange their cells.
    Exchanges,
}

impl Invariant {
    /// CHAIN-1.
    pub const CONTACT: Self = Self::Without(Breach::Contact);
    /// CHAIN-2.
    pub const CROWDING: Self = Self::Without(Breach::Crowding);
    /// CHAIN-3.
    pub const COVERAGE: Self = Self::Without(Breach::Coverage);
    /// CHAIN-13.
    pub const COMPLETENESS: Self = Self::Without(Breach::Completeness);

    /// Those that a run can be seen to break from outside.
    pub const OF_RUNS: [Self; 5] =
        [Self::CONTACT, Self::CROWDING, Self::COVERAGE, Self::COMPLETENESS, Self::Ends];

    /// Those that a hunt looks for in the runs of a chain that claims to follow `rule`. CHAIN-14 no rule keeps, and
    /// CHAIN-27 and CHAIN-28 one, so that every other hunt would end with them; and of advances CHAIN-27 follows from
    /// CHAIN-5 in any layout.
    pub fn of_hunts(rule: &Rule) -> Vec<Self> {
        let of_reels = match rule.pursuit {
            Pursuit::Reel(_) => Some(Self::Short),
            Pursuit::Epochs => None,
        };
        let meets = rule.has(Condition::PartsAtOnce).then_some(Self::Meets);
        let exchanges = rule.has(Condition::NoExchange).then_some(Self::Exchanges);
        Self::OF_RUNS.into_iter().chain(of_reels).chain(meets).chain(exchanges).collect()
    }

    /// Those of plans and what is said of them.
    const OF_PLANS: [Self; 6] =
        [Self::Admitted, Self::Distinct, Self::BaseStays, Self::Progress, Self::Heard, Self::Cheap];

    /// Those of the reel.
    const OF_REELS: [Self; 14] = [
        Self::CONTACT,
        Self::CROWDING,
        Self::COVERAGE,
        Self::COMPLETENESS,
        Self::Admitted,
        Self::Distinct,
        Self::BaseStays,
        Self::Ends,
        Self::Heard,
        Self::Falls,
        Self::Arrives,
        Self::Doubles,
        Self::Short,
        Self::AnyOrder,
    ];

    /// Those that are looked for in one search with this one, of a chain that claims to follow `rule`: only those
    /// that the rule promises are among them.
    pub(super) const fn companions(self, rule: &Rule) -> &'static [Self] {
        match (self, rule.pursuit, Self::OF_REELS.split_last()) {
            (Self::Certified, ..) => &[Self::Certified],
            (Self::AnyOrder, ..) => &[Self::AnyOrder],
            (Self::Chosen, ..) => &[Self::Chosen],
            (Self::Meets | Self::Exchanges, ..) if rule.has(Condition::NoExchange) => {
                &[Self::Meets, Self::Exchanges]
            }
            (Self::Meets, ..) => &[Self::Meets],
            (Self::MeetsInAdvance, ..) => &[Self::MeetsInAdvance],
            (Self::Exchanges, ..) => &[Self::Exchanges],
            (_, Pursuit::Reel(_), Some((Self::AnyOrder, others))) if !rule.has(Condition::Hold) => others,
            (_, Pursuit::Reel(_), _)
            | (Self::Falls | Self::Arrives | Self::Doubles | Self::Short, Pursuit::Epochs, _) => {
                &Self::OF_REELS
            }
            (Self::Without(_) | Self::Ends, Pursuit::Epochs, _) => &Self::OF_RUNS,
            (Self::Exhausts, Pursuit::Epochs, _) => &[Self::Exhausts],
            (
                Self::Admitted
                | Self::Distinct
                | Self::BaseStays
                | Self::Progress
                | Self::Heard
                | Self::Cheap,
                Pursuit::Epochs,
                _,
            ) => &Self::OF_PLANS,
        }
    }

    /// Whether it is demanded of the end of a run.
    pub(super) const fn is_of_the_end(self) -> bool {
        matches!(self, Self::Without(Breach::Completeness) | Self::Exhausts | Self::Short)
    }

    /// The breach that it forbids, if anyone sees one who watches the run.
    pub const fn breach(self) -> Option<Breach> {
        if let Self::Without(breach) = self { Some(breach) } else { None }
    }

    /// The id of its clause.
    pub const fn clause(self) -> &'static str {
        match self {
            Self::Without(breach) => breach.clause(),
            Self::Admitted => "CHAIN-4",
            Self::Distinct => "CHAIN-5",
            Self::BaseStays => "CHAIN-6",
            Self::Progress | Self::Ends => "CHAIN-7",
            Self::Heard => "CHAIN-8",
            Self::Cheap => "CHAIN-12",
            Self::Exhausts => "CHAIN-14",
            Self::Certified => "CHAIN-16",
            Self::Falls => "CHAIN-17",
            Self::Arrives => "CHAIN-18",
            Self::AnyOrder => "CHAIN-19",
            Self::Doubles => "CHAIN-23",
            Self::Short => "CHAIN-24",
            Self::Chosen => "CHAIN-25",
            Self::Meets | Self::MeetsInAdvance => "CHAIN-27",
            Self::Exchanges => "CHAIN-28",
        }
    }

    /// Whether the team move meets the demand.
    #[inline]
    pub(crate) fn check<G: Grid + Copy + Eq, const ROBOTS: usize>(
        self,
        moment: &Moment<'_, G, ROBOTS>,
    ) -> Result<(), Stop> {
        match self {
            Self::Without(breach) => {
                let safe = !breach.is_in(moment.before.cells(), moment.after.cells());
                require(safe, breach.words())
            }
            Self::Admitted => moment.is_admitted(),
            Self::Distinct => moment.is_distinct(),
            Self::BaseStays => {
                let stays = moment.steps.first() == Some(&Step::Stay);
                let is_there = moment.after.cells().first() == moment.before.cells().first();
                require(stays && is_there, "the base neither plans to move nor moves")
            }
            Self::Progress => moment.progresses(),
            // Of the end of a run, or of its never coming.
            Self::Ends | Self::Exhausts | Self::Short => Ok(()),
            Self::Heard => moment.is_heard(),
            Self::Cheap => moment.is_cheap(),
            Self::Certified => moment.is_certified(),
            Self::Falls => moment.falls(),
            Self::Arrives => moment.arrives(),
            Self::AnyOrder => moment.holds_in_any_order(),
            Self::Chosen => moment.is_chosen(),
            Self::Doubles => moment.doubles(),
            Self::MeetsInAdvance if moment.plan.kind == Kind::Backtrack => Ok(()),
            Self::Meets | Self::MeetsInAdvance => moment.meets_blocked(),
            Self::Exchanges => {
                let exchange = exchange(moment.before.cells(), moment.after.cells());
                require(!exchange, "no two robots outside the base exchange their cells")
            }
        }
    }
}

impl<G: Grid + Copy + Eq, const ROBOTS: usize> Moment<'_, G, ROBOTS> {
    fn planned_cells(&self) -> impl Iterator<Item = Cell> {
        self.before.cells().iter().zip(self.steps).map(|(cell, &step)| cell.after(step))
    }

    fn is_admitted(&self) -> Result<(), Stop> {
        if self.plan.kind == Kind::Backtrack {
            return Ok(());
        }
        let demanded = |condition| self.observed.intended.has(condition);
        let present = self.before.cells();
        let planned: Vec<Cell> = self.planned_cells().collect();
        let grid = self.planned.grid();
        let known = |robot: usize, mark| match self.steps[robot] {
            Step::Cross(side) => grid.edge_has(mark, Edge::new(present[robot], side)),
            Step::Stay => false,
        };
        let leader = present.len() - 1;
        for robot in 0..=leader {
            let stays = self.steps[robot] == Step::Stay;
            require(!known(robot, EdgeMark::Wall), "no robot plans to cross a known wall")?;
            if robot < leader {
                require(
                    in_safe(planned[robot + 1], planned[robot]),
                    "a follower plans to be in E_S of the planned position ahead",
                )?;
                let sure = self.steps[robot + 1] == Step::Stay || known(robot + 1, EdgeMark::Open);
                let doubts = demanded(Condition::Hold) || !sure && demanded(Condition::UnsureAhead);
                require(
                    !doubts || in_covered(present[robot + 1], planned[robot]),
                    "behind a neighbour that may stay a follower plans to be in E_C of its present position",
                )?;
            }
            if robot > 0 {
                // The leader may always fall back on the null move.
                let null = robot == leader && stays;
                require(
                    null || in_covered(present[robot - 1], planned[robot]),
                    "a robot plans to be in E_C of the present position behind",
                )?;
                let guard =
                    if robot == leader { Condition::FullForLeader } else { Condition::FullForFollower };
                let others = present.iter().filter(|&&cell| cell == planned[robot]).count();
                require(
                    stays || !demanded(guard) || planned[robot] == present[0] || others < 2,
                    "no robot enters a cell that two others occupy",
                )?;
            }
        }
        let exchanged = demanded(Condition::NoExchange) && exchange(present, &planned);
        require(!exchanged, "no two robots plan to exchange their cells")?;
        let all_virtual = known(leader, EdgeMark::Virtual);
        require(!all_virtual, "the leader does not cross a virtual obstacle")
    }

    /// Neither the relation that the planner asks refuses its plan, nor that of the rule that the team claims to have.
    fn is_certified(&self) -> Result<(), Stop> {
        let (mut grid, team) = (*self.planned.grid(), self.before.cells());
        let is_admitted = self.plan.kind == Kind::Backtrack
            || self.observed.intended.admits_plan(&mut grid, team, self.steps);
        require(!self.planned.is_refused() && is_admitted, "no plan is refused")
    }

    fn is_distinct(&self) -> Result<(), Stop> {
        if self.plan.kind == Kind::Backtrack {
            return Ok(());
        }
        let planned: Vec<Cell> = self.planned_cells().collect();
        let shared = (1..planned.len())
            .any(|robot| planned[robot] != planned[0] && planned[1..robot].contains(&planned[robot]));
        require(!shared, "no two robots plan to be in one cell outside the base")
    }

    /// Between two gains (a cell explored, a wall found) and two new virtual obstacles, an advance brings the leader
    /// nearer to the frontier, or while the chain unfolds one cell farther along the walk, and a backtrack makes the
    /// history shorter: all of these end.
    fn progresses(&self) -> Result<(), Stop> {
        let leader = |chain: &Chain<G, ROBOTS>| chain.cells()[chain.cells().len() - 1];
        let to_frontier = |chain: &Chain<G, ROBOTS>| {
            let mut grid = *chain.grid();
            grid.distance(leader(chain), Avoid::WallsAndVirtual)
        };
        let turned = self.planned.epochs() > self.before.epochs();
        let unfolds = self.planned.is_unfolding();
        require(
            !turned || self.before.gained() || unfolds,
            "an epoch without gain is the last, or the next unfolds the chain",
        )?;
        let gains = self.explores() || self.finds_wall();
        require(
            self.after.gained() == (self.planned.gained() || gains),
            "a cell explored and a wall found are gains, and nothing else is",
        )?;
        match self.plan.kind {
            Kind::Backtrack => {
                require(!unfolds, "an epoch that unfolds the chain gains before it takes anything back")?;
                require(
                    self.after.last_open() < self.before.last_open(),
                    "a backtrack shortens the history",
                )?;
                require(
                    to_frontier(self.planned).is_none(),
                    "a backtrack leaves a place without a way to the frontier",
                )
            }
            Kind::Advance if unfolds => {
                let walk = self.walk();
                let along = |chain| walk.iter().position(|&cell| cell == leader(chain));
                let farther =
                    along(self.after).zip(along(self.planned)).is_some_and(|(then, now)| then == now + 1);
                require(
                    gains || farther,
                    "while the chain unfolds, it explores, finds a wall, or the leader goes on along the walk",
                )
            }
            Kind::Advance => {
                let new_obstacle = self.planned.grid() != self.before.grid();
                let nearer = || {
                    let (now, then) = (to_frontier(self.after), to_frontier(self.before));
                    now.is_some_and(|now| then == Some(now + 1))
                };
                require(
                    gains || new_obstacle || nearer(),
                    "an advance explores, finds a wall, adds a virtual obstacle or brings the leader nearer",
                )
            }
        }
    }

    fn explores(&self) -> bool {
        self.after.cells().iter().any(|&cell| !self.planned.grid().has(CellMark::Explored, cell))
    }

    fn finds_wall(&self) -> bool {
        let is_blocked = |message: Message| message.outcome == Outcome::Blocked;
        self.messages.iter().any(|&byte| Message::decode(byte).is_ok_and(is_blocked))
    }

    /// A cell explored and a wall found can be counted: between two of them the measure of the reel falls.
    fn falls(&self) -> Result<(), Stop> {
        let gains = self.explores() || self.finds_wall();
        require(
            gains || self.after.measure() < self.planned.measure(),
            "a team move gains, or the measure falls",
        )?;
        require(
            self.before.gained() || gains || self.planned.measure() <= self.before.measure(),
            "what is begun without a gain has a lesser measure",
        )
    }

    /// Where no wall is met, a cell is explored in the last of the rehearsed team moves, and not before.
    fn arrives(&self) -> Result<(), Stop> {
        match self.planned.until_gain() {
            Some(left) if !self.finds_wall() => require(
                self.explores() == (left == 1),
                "a rehearsal without surprise arrives in its number of moves",
            ),
            Some(_) | None => Ok(()),
        }
    }

    /// The team moves left of a take-back, if one is under way in `chain`, and how many have been begun since the last
    /// gain.
    fn take_back(chain: &Chain<G, ROBOTS>) -> (Option<u32>, u32) {
        let [not_begun, is_under_way, left] = chain.measure();
        ((is_under_way == 1).then_some(left), u32::from(u8::MAX) - not_begun)
    }

    /// Each backtrack belongs to a take-back. One that is begun has twice as many team moves as the one before, the
    /// first since the last gain one; and it goes on until they are made, the history ends, or something is gained.
    fn doubles(&self) -> Result<(), Stop> {
        let (before, begun) = if self.before.gained() { (None, 0) } else { Self::take_back(self.before) };
        let (planned, now) = Self::take_back(self.planned);
        let gains = self.explores() || self.finds_wall();
        let goes_on = before.is_some_and(|left| left > 0) && self.before.last_open().is_some();
        require(
            planned.is_some() == (self.plan.kind == Kind::Backtrack),
            "team moves are taken back in a take-back alone",
        )?;
        if goes_on {
            return require(
                gains || planned == before && Self::take_back(self.after).0 == before.map(|left| left - 1),
                "a take-back goes on until its team moves are made",
            );
        }
        let due = 1_u32.checked_shl(begun).unwrap_or(u32::MAX);
        require(
            planned.is_none_or(|left| left == due && now == begun + 1),
            "each take-back without a gain has twice as many team moves as the one before",
        )
    }

    /// The team move is A if there is one; what is begun else is B or C, as the procedure has them to their ends, and D
    /// if there is none.
    fn is_chosen(&self) -> Result<(), Stop> {
        if self.planned.is_cut_short() {
            return Ok(());
        }
        let team = self.planned.cells();
        if let Some(touched) = self.on_map(|map| PlainReel::new(map, team).touch()) {
            return require(self.steps == touched, "the leader touches as the procedure says");
        }
        let (take_back, _) = Self::take_back(self.before);
        let goes_on = self.before.until_gain().is_some()
            || take_back.is_some_and(|left| left > 0) && self.before.last_open().is_some();
        if goes_on && !self.before.gained() {
            return Ok(());
        }
        let Some(task) = self.on_map(|map| PlainReel::new(map, team).task()) else {
            return require(
                self.plan.kind == Kind::Backtrack,
                "nothing is begun where the procedure finds nothing",
            );
        };
        let left = self.planned.until_gain().and_then(|left| usize::try_from(left).ok());
        require(left == Some(task.len()), "what is begun has as many team moves as the procedure says")?;
        let (mut chain, mut plan) = (*self.planned, *self.plan);
        for steps in &task {
            require(plan.steps() == steps, "what is begun is what the procedure says")?;
            chain.settle(&plan, |_| true);
            if chain.gained() {
                break;
            }
            match chain.plan(&[]) {
                Ok(Intent::Go(next)) if chain.until_gain().is_some() => plan = next,
                // A comes first.
                Ok(_) | Err(_) => break,
            }
        }
        Ok(())
    }

    /// Where a robot enters a cell other than the base in which another one then is, one of the two was blocked.
    fn meets_blocked(&self) -> Result<(), Stop> {
        let passes = |robot: usize| {
            let message = Message::decode(self.messages[robot - 1]);
            message.is_ok_and(|message| message.outcome != Outcome::Blocked)
        };
        let meet = meet_unblocked(self.before.cells(), self.after.cells(), passes);
        require(!meet, "of two robots that come together in a cell one is blocked")
    }

    /// Each of two neighbours has gone, or not yet.
    fn holds_in_any_order(&self) -> Result<(), Stop> {
        let holds = holds_in_any_order(self.before.cells(), self.after.cells());
        require(holds, "neighbours keep contact in whatever order they go")
    }

    /// The cells of the walk from the base to the nearest unexplored cell, by links; none if it is out of reach. It
    /// stays as it is until something is gained.
    fn walk(&self) -> Vec<Cell> {
        let team = self.planned.cells();
        let walk = self.on_map(|map| walk(map, team[0], team.len() - 1));
        walk.map_or(Vec::new(), |(cells, _)| cells)
    }

    /// Asks something of the map of the planned move.
    fn on_map<T>(&self, ask: impl FnOnce(Map<'_>) -> T) -> T {
        let grid = self.planned.grid();
        let is_open = |edge| !grid.edge_has(EdgeMark::Wall, edge);
        ask((grid.area(), &is_open, &|cell| grid.has(CellMark::Explored, cell)))
    }

    /// The budget of the rule that the team claims to follow.
    fn is_cheap(&self) -> Result<(), Stop> {
        let most = match self.observed.intended.budget {
            Budget::Unlimited => u32::MAX,
            Budget::LooksPerRobot(looks) => u32::from(looks) * self.planned.cells().len() as u32,
        };
        require(self.planned.looked_at() <= most, "a plan looks at no more candidates than its budget allows")
    }

    /// One who had the state before, planned the same and hears the bytes, has the state after: so a second chain that
    /// is fed with bytes alone is at every time what the first one is.
    fn is_heard(&self) -> Result<(), Stop> {
        let mut listener = *self.planned;
        let understood = listener.hear(self.plan, self.messages).is_ok();
        require(understood, "every byte is a message that fits the plan")?;
        require(listener == *self.after, "one who hears the bytes has the state of the whole team")
    }
}

/// Whether of two robots that come together in a cell other than the base both pass, as `passes` says of each but the
/// base.
pub(super) fn meet_unblocked(before: &[Cell], after: &[Cell], passes: impl Fn(usize) -> bool) -> bool {
    let meet = |one: usize, other: usize| {
        let is_entered = before[one] != after[one] || before[other] != after[other];
        after[one] == after[other] && after[one] != after[0] && is_entered
    };
    (2..after.len()).any(|other| (1..other).any(|one| meet(one, other) && passes(one) && passes(other)))
}

/// Whether two robots have exchanged their cells, neither of which is the base.
pub(super) fn exchange(before: &[Cell], after: &[Cell]) -> bool {
    let exchange = |one: usize, other: usize| {
        let (from, to) = (before[one], after[one]);
        from != to && from == after[other] && to == before[other] && ![from, to].contains(&after[0])
    };
    (2..after.len()).any(|other| (1..other).any(|one| exchange(one, other)))
}

/// Whether neighbours are in contact, each of the two having gone, or not yet.
pub(super) fn holds_in_any_order(before: &[Cell], after: &[Cell]) -> bool {
    (1..after.len()).all(|ahead| {
        let [behind, ahead] = [ahead - 1, ahead].map(|robot| [before[robot], after[robot]]);
        behind.iter().all(|&behind| ahead.iter().all(|&ahead| in_covered(behind, ahead)))
    })
}
