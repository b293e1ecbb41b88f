//! Robots watched by clauses, without a network. What positions say of a clause is the word of `tautline-monitor`; this
//! file adds what stamps, frames and this machine's clock have to say.

use super::config::{Clause, Config, Id};
use super::messages::{Header, Point, Time};
use super::tell;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};
use tautline_monitor::{
    AnyDemand, Apart, Breach, Cells, Connectivity, Doubt, Monitor, Neighbours, Place, Robot, SetupError,
    Verdict,
};

/// How far a stamp may be ahead of this machine's clock, at most: no farther than the gap. One that is farther ahead
/// would make all other robots look silent, until their stamps reach it.
const MOST_AHEAD_US: u64 = 1_000_000;

/// How often stderr is told, for each robot, that messages are refused.
const EACH: Duration = Duration::from_secs(10);

/// The monitor of a clause.
fn monitor(clause: &Clause, gap: Duration) -> Result<Monitor<AnyDemand, Vec<Robot>>, SetupError> {
    let &Clause { id, length_mm, tolerance_mm, base, .. } = clause;
    let cells = |most| AnyDemand::Cells(Cells { cell_mm: length_mm, most, base, tolerance_mm });
    let demand = match id {
        Id::Chain3 => AnyDemand::Neighbours(Neighbours { range_mm: length_mm, tolerance_mm }),
        Id::Kit1 | Id::Kit2 | Id::Kit12 => {
            AnyDemand::Connectivity(Connectivity { range_mm: length_mm, tolerance_mm })
        }
        Id::Kit3 => AnyDemand::Apart(Apart { least_mm: length_mm, tolerance_mm }),
        Id::Chain2 => cells(2),
        Id::Frontier2 | Id::Pack2 => cells(1),
    };
    Monitor::new(demand, gap.as_micros() as u64, vec![Robot::UNHEARD; clause.robots.len()])
}

/// The state of a clause. Robots are numbered as in the configuration.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Status {
    /// Every robot was heard within the gap, and the clause is not broken.
    Kept,
    /// The clause is broken by these robots.
    Broken(Breach),
    /// This robot was not heard within the gap.
    Silent(usize),
}

impl Status {
    /// Whether a person has to be told at once that it follows `before`: another word, or other robots.
    fn is_news(self, before: Self) -> bool {
        match (self, before) {
            (Self::Broken(now), Self::Broken(before)) => now.robots != before.robots,
            _ => self != before,
        }
    }
}

/// A clause, and what is known of it.
pub(crate) struct WatchedClause {
    pub(crate) clause: Clause,
    monitor: Monitor<AnyDemand, Vec<Robot>>,
    pub(crate) status: Status,
    /// The stamp of the position that was judged last.
    pub(crate) moment: Time,
    /// The state that was published last.
    pub(crate) told: Status,
}

/// The positions heard of a robot.
#[derive(Clone, Default)]
pub(crate) struct Reception {
    /// When a position was last taken, by this machine, and which.
    pub(crate) last: Option<(Instant, Point)>,
    /// Why the last message was refused, if it was.
    pub(crate) refused: Option<String>,
    /// When stderr was told last that a message was refused.
    told: Option<Instant>,
}

/// Robots, and the clauses that they are watched by.
pub struct Watch {
    pub(crate) config: Config,
    pub(crate) frame: Option<String>,
    pub(crate) heard: Vec<Reception>,
    pub(crate) clauses: Vec<WatchedClause>,
}

/// A coordinate in millimetres, to the nearest. One that is beyond all places stays beyond.
fn millimetres(metres: f64) -> Option<i32> {
    metres.is_finite().then_some((metres * 1_000.0).round() as i32)
}

impl Watch {
    /// The watch that a configuration asks for. It has heard nobody.
    ///
    /// # Errors
    /// [`SetupError`] of a clause that would be kept wherever robots are.
    pub fn new(config: Config) -> Result<Self, SetupError> {
        let watched = |clause: &Clause| {
            let (monitor, status) = (monitor(clause, config.gap)?, Status::Silent(clause.robots[0]));
            Ok(WatchedClause {
                clause: clause.clone(),
                monitor,
                status,
                moment: Time::default(),
                told: status,
            })
        };
        Ok(Self {
            frame: config.frame.clone(),
            heard: vec![Reception::default(); config.robots.len()],
            clauses: config.clauses.iter().map(watched).collect::<Result<_, _>>()?,
            config,
        })
    }

    /// Takes a position of `robot`, or says on stderr why not.
    pub fn hear(&mut self, robot: usize, header: &Header, position: &Point, now: Instant) {
        if let Err(why) = self.take(robot, header, position) {
            self.refuse(robot, why, now);
        } else {
            let heard = &mut self.heard[robot];
            (heard.last, heard.refused) = (Some((now, position.clone())), None);
        }
    }

    /// Notes that a message of `robot` cannot be used.
    pub fn refuse(&mut self, robot: usize, why: String, now: Instant) {
        let heard = &mut self.heard[robot];
        if heard.told.is_none_or(|told| now.duration_since(told) >= EACH) {
            tell!("a message on {} is refused: {why}", self.config.robots[robot].topic);
            heard.told = Some(now);
        }
        heard.refused = Some(why);
    }

    /// Judges a position by every clause of its robot.
    fn take(&mut self, robot: usize, header: &Header, position: &Point) -> Result<(), String> {
        let at_us = header.stamp.micros().ok_or("its stamp is before 1970")?;
        let clock = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        let most_ahead_us = MOST_AHEAD_US.min(self.config.gap.as_micros() as u64);
        if at_us > clock.as_micros() as u64 + most_ahead_us {
            return Err(
                "its stamp is ahead of this machine's clock: set the clocks of the machines".to_owned()
            );
        }
        let axes = (millimetres(position.x), millimetres(position.y));
        let (Some(x_mm), Some(y_mm)) = axes else { return Err("its position is no number".to_owned()) };
        let frame = self.frame.as_ref().unwrap_or(&header.frame_id);
        if *frame != header.frame_id {
            return Err(format!(
                "its frame is {:?}, and positions are compared in {frame:?}",
                header.frame_id
            ));
        }
        for watched in &mut self.clauses {
            let robots = &watched.clause.robots;
            let Some(number) = robots.iter().position(|&other| other == robot) else { continue };
            let monitor = &mut watched.monitor;
            let place = Place::new(x_mm, y_mm);
            monitor.take(at_us, number, at_us, place).map_err(|refusal| refusal.to_string())?;
            watched.status = match monitor.at(at_us) {
                Verdict::Kept => Status::Kept,
                Verdict::Broken(breach) => {
                    Status::Broken(Breach { robots: breach.robots.map(|number| robots[number]), ..breach })
                }
                Verdict::Unknown(Doubt::Silent(number)) => Status::Silent(robots[number]),
                Verdict::Unknown(refusal) => return Err(refusal.to_string()),
            };
            watched.moment = header.stamp.clone();
        }
        self.frame.get_or_insert_with(|| header.frame_id.clone());
        Ok(())
    }

    /// Takes back what rests on robots that were not heard within the gap by this machine's clock, and says whether
    /// there is news since the last diagnostics.
    pub fn look(&mut self, now: Instant) -> bool {
        let (heard, gap) = (&self.heard, self.config.gap);
        let is_silent =
            |robot: &usize| heard[*robot].last.as_ref().is_none_or(|(at, _)| now.duration_since(*at) > gap);
        for watched in &mut self.clauses {
            let silent = match watched.status {
                Status::Broken(breach) => breach.robots.into_iter().find(is_silent),
                Status::Kept => watched.clause.robots.iter().copied().find(is_silent),
                Status::Silent(_) => None,
            };
            watched.status = silent.map_or(watched.status, Status::Silent);
        }
        self.clauses.iter().any(|watched| watched.status.is_news(watched.told))
    }
    /// Notes that all of this is published, and says of each clause whether it is news.
    pub fn mark_told(&mut self) -> Vec<bool> {
        let told = |watched: &mut WatchedClause| {
            let is_news = watched.status.is_news(watched.told);
            watched.told = watched.status;
            is_news
        };
        self.clauses.iter_mut().map(told).collect()
    }
}
