//! The next turns on a small lattice: whoever drives arrives, and whoever may decide decides.

use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Cell, Edge, EdgeMark, Grid, Side, TinyGrid};
use tautline_kernel::kit::{Answers as Answering, Next, Records, Sight, Stance, touch};

use super::{Answers, DRIVEN, Demand, Event, Setting, Speeds, Successor, Team, World};
use crate::engine::outcomes;

/// Looks after which a decision is taken for one that never ends: each side once for each reason that there is to look.
const MOST_LOOKS: usize = 4 * 5;

impl<const ROBOTS: usize> Setting<ROBOTS> {
    /// Every step from `world`.
    pub fn turns(&self, world: &World<ROBOTS>) -> Vec<Successor<ROBOTS>> {
        let mut turns = Vec::new();
        let is_in_between =
            self.speeds == Speeds::OneByOne && world.team.stances().any(|stance| !stance.stands());
        for robot in 0..ROBOTS {
            let is_driving = world.team.stance(robot).is_some_and(|stance| !stance.stands());
            if !is_driving && is_in_between {
                continue;
            }
            if !is_driving {
                turns.extend(self.decided(world, robot));
                continue;
            }
            let all_drive = world.team.stances().all(|stance| !stance.stands());
            if self.speeds == Speeds::Equal && all_drive && usize::from(world.first) != robot {
                continue;
            }
            let mut after = *world;
            if after.team.arrived(robot).is_err() {
                continue;
            }
            after.fresh &= !(1 << robot);
            // Of two, the other one is now the one that has left first.
            after.first = u8::from(robot == 0 && ROBOTS > 1);
            let node = Self::ends(&after)[robot];
            let arrival = Event::Arrives(robot, node);
            if self.answers == Answers::AtOnce && after.team.may_decide(robot) {
                turns.extend(self.decided(&after, robot).into_iter().map(|mut turned| {
                    turned.events.insert(0, arrival.clone());
                    turned
                }));
                continue;
            }
            let mut breaks = self.broken_by_marks(&after);
            breaks.extend(self.broken_by_arrival(&after, robot));
            turns.push(Successor {
                world: self.settled(after),
                events: vec![arrival],
                robot,
                situation: "an arrival",
                breaks,
            });
        }
        turns
    }

    /// All that comes of a decision of `robot`, if it may decide. Where it drives an old path at once, it is any that
    /// begins a shortest way.
    fn decided(&self, world: &World<ROBOTS>, robot: usize) -> Vec<Successor<ROBOTS>> {
        let mut decided: Vec<_> = outcomes(|oracle| self.decide(world, robot, oracle)).collect();
        let taken = |turned: &Successor<ROBOTS>| match (turned.situation, &turned.events[..]) {
            ("an old path", [Event::Decides(_, looks, _)]) if looks.len() == 1 => Some(looks[0].0),
            _ => None,
        };
        let sides: Vec<Side> = decided.iter().filter_map(taken).collect();
        if self.is_wanted(Demand::AnyShortest) && !sides.is_empty() {
            let due = self.shortest(world, robot);
            if !due.iter().all(|side| sides.contains(side)) || !sides.iter().all(|side| due.contains(side)) {
                for turned in decided.iter_mut().filter(|turned| taken(turned).is_some()) {
                    turned.breaks.push(Demand::AnyShortest);
                }
            }
        }
        decided
    }

    /// The team as the kernel has it when `robot` decides, where robots that stand answer it as if they drove.
    fn answered(&self, team: &Team<ROBOTS>, robot: usize) -> Option<Team<ROBOTS>> {
        if (self.answers, self.rule.answers) != (Answers::TrueNews, Answering::Always) {
            return None;
        }
        let mut answered = *team;
        let others = answered.robots_mut().iter_mut().enumerate().filter(|&(other, _)| other != robot);
        for (_, other) in others {
            other.stance = Stance::Drives { from: other.stance.from(), to: other.stance.to() };
        }
        Some(answered)
    }

    /// Whether `robot` stands, has been answered, and has not decided yet.
    pub(super) fn may_decide(&self, team: &Team<ROBOTS>, robot: usize) -> bool {
        self.answered(team, robot).as_ref().unwrap_or(team).may_decide(robot)
    }

    /// `robot` decides, if it may.
    fn decide(
        &self,
        world: &World<ROBOTS>,
        robot: usize,
        oracle: &mut dyn Oracle,
    ) -> Option<Successor<ROBOTS>> {
        let mut after = *world;
        let from = Self::ends(world)[robot];
        if let Some(answered) = self.answered(&world.team, robot) {
            after.team = answered;
        }
        let mut next = after.team.decide(robot, oracle).ok()?;
        for (other, at) in after.team.robots_mut().iter_mut().zip(world.team.robots()) {
            other.stance = at.stance;
        }
        let mut looks = Vec::new();
        let (mut is_old, mut never_ends) = (false, false);
        while let Next::Looks(side) = next {
            never_ends = looks.len() == MOST_LOOKS;
            if never_ends {
                break;
            }
            is_old = world.truth.edge_has(DRIVEN, Edge::new(from, side));
            let sight = self.see(&mut after, (robot, from, side), oracle);
            looks.push((side, sight));
            next = after.team.looked(robot, sight, oracle).ok()?;
        }
        let situation = match next {
            Next::Drives(_) if is_old => "an old path",
            Next::Drives(_) => "a new path",
            Next::Stays | Next::Looks(_) => "a stay",
            Next::Done => "done",
        };
        let seen = World { team: world.team, ..after };
        if let Next::Drives(to) = next
            && let Some(side) = Side::ALL.into_iter().find(|&side| from.beyond(side) == to)
        {
            after.truth.put_edge(DRIVEN, Edge::new(from, side));
        }
        let mut breaks = self.broken_by_marks(&after);
        if never_ends && self.is_wanted(Demand::Ends) {
            breaks.push(Demand::Ends);
        }
        if let Next::Drives(to) = next {
            if !is_old {
                after.fresh |= 1 << robot;
            }
            let others_drive = world.team.stances().any(|stance| !stance.stands());
            after.first = if others_drive { world.first } else { robot as u8 };
            breaks.extend(self.broken_by_drive(&seen, robot, Stance::Drives { from, to }, is_old));
        }
        let events = vec![Event::Decides(robot, looks, next)];
        Some(Successor { world: self.settled(after), events, robot, situation, breaks })
    }

    /// The sight of `robot` at a side of its node.
    pub(in crate::kit) fn see(
        &self,
        world: &mut World<ROBOTS>,
        (robot, node, side): (usize, Cell, Side),
        oracle: &mut dyn Oracle,
    ) -> Sight {
        let edge = Edge::new(node, side);
        if !world.truth.edge_has(EdgeMark::Wall, edge) && !world.truth.edge_has(EdgeMark::Open, edge) {
            let is_wall = match &self.given {
                Some(given) => given.edge_has(EdgeMark::Wall, edge),
                None => world.walls < self.max_walls && oracle.mishap(),
            };
            world.walls += u8::from(is_wall);
            world.truth.put_edge(if is_wall { EdgeMark::Wall } else { EdgeMark::Open }, edge);
        }
        if world.truth.edge_has(EdgeMark::Wall, edge) {
            return Sight::Obstacle;
        }
        let others = world.team.stances().enumerate().filter(|&(other, _)| other != robot);
        let seen: Vec<Option<bool>> = others.map(|(_, stance)| touch(node, side, stance)).collect();
        let is_seen = seen.contains(&Some(true)) || seen.contains(&None) && oracle.flip();
        if is_seen { Sight::Robot } else { Sight::Free }
    }

    /// Where all records count, it does not matter who has driven a path.
    pub(in crate::kit) fn settled(&self, mut world: World<ROBOTS>) -> World<ROBOTS> {
        if self.rule.records == Records::Union {
            let blank = TinyGrid::new(self.area).unwrap_or(world.truth);
            let mut union = blank;
            world.team.records().iter().for_each(|record| union.add_edges(record));
            world.team = world.team.with_records(|robot| if robot == 0 { union } else { blank });
        }
        world
    }
}
