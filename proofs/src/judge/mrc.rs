//! The judge of MRC: runs of robots and WFRs as published (MRC-1 to MRC-6, MRC-8, MRC-9), and what a robot records
//! ([`Record`]: MRC-10). It knows the sentences of `SPEC.md` alone.

use std::collections::BTreeSet;

use super::change::plain;
use super::{Case, Objection, breaks_at_last, must};

/// A run of robots and WFRs.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Run {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// By robot and WFR: hops between them.
    pub hops: Vec<Vec<i32>>,
    /// Messages that are lost or come twice, and robots that fail.
    pub faults: usize,
    /// The events, in order.
    pub steps: Vec<Step>,
}

/// An event.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Step {
    /// An event, a message, or something that a robot does.
    pub what: What,
    /// The fate of a message.
    pub fate: Fate,
    /// The WFR that it is about; 0 of a robot that fails.
    pub wfr: usize,
    /// The robot that it is about; 0 of an event.
    pub robot: usize,
    /// The number of the call, of a message; else 0.
    pub epoch: i32,
    /// The robot chosen, of a RESB.
    pub chosen: Option<usize>,
}

/// An event, a message, or something that a robot does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum What {
    /// Something happens at a WFR, and it calls.
    Calls,
    /// A NOTICE from the WFR to the robot.
    Notice,
    /// A MOVE from the robot to the WFR.
    Move,
    /// A RESB from the WFR to the robot.
    Resb,
    /// A robot comes to the WFR for which it is on its way.
    Comes,
    /// A robot fails for good.
    Fails,
}

/// The fate of a message.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fate {
    /// It arrives; so is whatever is no message.
    Arrives,
    /// It is lost.
    IsLost,
    /// It will arrive once more.
    ComesTwice,
}

plain!(Run { hops, faults, steps });
plain!(Step { what, fate, wfr, robot, epoch, chosen });
plain!(What one of Calls, Notice, Move, Resb, Comes, Fails);
plain!(Fate one of Arrives, IsLost, ComesTwice);

/// A message on its way.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Message {
    what: What,
    wfr: usize,
    robot: usize,
    epoch: i32,
    chosen: Option<usize>,
}

/// A WFR.
#[derive(Clone, Debug, Default)]
struct Wfr {
    epoch: i32,
    waits: bool,
    /// On whom it counts: it has done with choosing when it has chosen.
    choice: Option<usize>,
    /// The robots whose MOVEs it has received under this call.
    asked: BTreeSet<usize>,
    /// Whether a message to or from it is on its way: its window. The robots whose MOVE of this call came in it, and
    /// the best.
    is_open: bool,
    heard: BTreeSet<usize>,
    best: Option<(i32, usize)>,
}

/// The task of a robot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Task {
    Free,
    /// It asks for the call of a WFR.
    Asks(usize, i32),
    /// It has taken the lease of a call, and is on its way.
    Goes(usize, i32),
}

#[derive(Clone, Debug)]
struct Robot {
    task: Task,
    lives: bool,
    /// By WFR: the epoch of its call, and whether its SBit is set.
    records: Vec<Option<(i32, bool)>>,
    /// By WFR: the call whose lease it took last.
    taken: Vec<Option<i32>>,
}

struct Court<'a> {
    run: &'a Run,
    robots: Vec<Robot>,
    wfrs: Vec<Wfr>,
    network: Vec<Message>,
}

impl Case for Run {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        let wfrs = self.hops.first().map_or(0, Vec::len);
        let is_table = self.hops.iter().all(|row| row.len() == wfrs && row.iter().all(|&hops| hops >= 1));
        must(wfrs > 0 && is_table, "each robot is some hops from each WFR")?;
        let is_fault = |step: &&Step| step.fate != Fate::Arrives || step.what == What::Fails;
        must(self.steps.iter().filter(is_fault).count() == self.faults, "there are more faults, or fewer")?;
        let robot =
            Robot { task: Task::Free, lives: true, records: vec![None; wfrs], taken: vec![None; wfrs] };
        let robots = vec![robot; self.hops.len()];
        let mut court = Court { run: self, robots, wfrs: vec![Wfr::default(); wfrs], network: Vec::new() };
        for (number, step) in (1..).zip(&self.steps) {
            let object = |what| Objection { at: number, what };
            let happened = court.step(step).map_err(object)?;
            court.close_windows();
            if self.clause != "MRC-5" {
                let breaks = court.is_broken(happened).map_err(object)?;
                breaks_at_last(breaks, number == self.steps.len()).map_err(object)?;
            }
        }
        must(!self.steps.is_empty(), "nothing happens")?;
        if self.clause == "MRC-5" {
            let goes = court.robots.iter().any(|robot| robot.lives && matches!(robot.task, Task::Goes(..)));
            must(court.network.is_empty() && !goes, "something more is bound to happen")?;
            must(court.wfrs.iter().any(|wfr| wfr.waits), "no WFR waits")?;
            must(court.robots.iter().any(|robot| robot.lives), "no robot lives")?;
        }
        Ok(())
    }
}

/// Demands that a step has broken, and no state shows.
#[derive(Clone, Copy, Default)]
struct StepBreaches {
    /// A robot has heard a new call, and its SBit is set.
    is_set: bool,
    /// A robot has taken the lease of a call for which it did not ask, or for which it was not chosen.
    is_unasked: bool,
    /// A WFR has not told its choice to those who have asked, and to them alone.
    is_untold: bool,
}

impl Court<'_> {
    fn step(&mut self, step: &Step) -> Result<StepBreaches, &'static str> {
        let &Step { what, fate, wfr, robot, epoch, chosen } = step;
        must(wfr < self.wfrs.len() && robot < self.robots.len(), "there is no such robot or WFR")?;
        let mut happened = StepBreaches::default();
        if let What::Notice | What::Move | What::Resb = what {
            let message = Message { what, wfr, robot, epoch, chosen };
            let place = self
                .network
                .iter()
                .position(|other| *other == message)
                .ok_or("no such message is on its way")?;
            match fate {
                Fate::ComesTwice => self.network.push(message),
                Fate::IsLost => drop(self.network.swap_remove(place)),
                Fate::Arrives => {
                    self.network.swap_remove(place);
                    happened = self.arrives(message);
                }
            }
            return Ok(happened);
        }
        must(fate == Fate::Arrives && epoch == 0 && chosen.is_none(), "this is no message")?;
        match what {
            What::Calls => {
                must(robot == 0 && !self.wfrs[wfr].waits, "a WFR that waits does not call anew")?;
                let epoch = self.wfrs[wfr].epoch + 1;
                self.wfrs[wfr] = Wfr { epoch, waits: true, is_open: true, ..Wfr::default() };
                for robot in (0..self.robots.len()).filter(|&robot| self.robots[robot].lives) {
                    self.network.push(Message { what: What::Notice, wfr, robot, epoch, chosen: None });
                }
            }
            What::Comes => {
                let Task::Goes(to, _) = self.robots[robot].task else {
                    return Err("a robot comes that does not go");
                };
                must(to == wfr && self.robots[robot].lives, "a robot comes where it does not go")?;
                self.wfrs[wfr].waits = false;
                self.wfrs[wfr].choice = None;
                self.robots[robot].task = Task::Free;
                self.ask(robot);
            }
            _ => {
                must(wfr == 0 && self.robots[robot].lives, "a robot fails once")?;
                self.robots[robot].lives = false;
                self.network.retain(|message| message.what == What::Move || message.robot != robot);
            }
        }
        Ok(happened)
    }

    fn arrives(&mut self, message: Message) -> StepBreaches {
        let Message { what, wfr, robot, epoch, chosen } = message;
        let mut happened = StepBreaches::default();
        let task = self.robots[robot].task;
        match what {
            What::Notice => {
                let known = self.robots[robot].records[wfr];
                let (old, is_set) = known.unwrap_or((epoch, false));
                // As published a NOTICE does not say which event it is about: the SBit stays.
                self.robots[robot].records[wfr] = Some((old.max(epoch), is_set));
                happened.is_set = is_set && old < epoch;
                self.ask(robot);
            }
            What::Resb => {
                let Some(record) = self.robots[robot].records[wfr].as_mut() else { return happened };
                record.1 = true;
                let is_about = matches!(task, Task::Asks(other, _) | Task::Goes(other, _) if other == wfr);
                if chosen == Some(robot) {
                    let taken = Task::Goes(wfr, epoch);
                    happened.is_unasked = task != taken && task != Task::Asks(wfr, epoch);
                    self.robots[robot].task = taken;
                    self.robots[robot].taken[wfr] = Some(epoch);
                } else {
                    if is_about {
                        self.robots[robot].task = Task::Free;
                    }
                    self.ask(robot);
                }
            }
            _ => happened.is_untold = self.hears_move(wfr, robot, epoch),
        }
        happened
    }

    /// A robot that is free asks for the call of least (HC, SN) whose SBit is clear.
    fn ask(&mut self, robot: usize) {
        let Robot { task, records, .. } = &mut self.robots[robot];
        let hops = &self.run.hops[robot];
        let open = (0..records.len())
            .filter_map(|wfr| records[wfr].filter(|record| !record.1).map(|(epoch, _)| (wfr, epoch)));
        if *task == Task::Free
            && let Some((wfr, epoch)) = open.min_by_key(|&(wfr, _)| (hops[wfr], wfr))
        {
            *task = Task::Asks(wfr, epoch);
            if self.robots[robot].lives {
                self.network.push(Message { what: What::Move, wfr, robot, epoch, chosen: None });
            }
        }
    }

    /// A WFR that waits chooses at every MOVE anew among all that have asked, and tells them all; whether it has
    /// told others.
    fn hears_move(&mut self, wfr: usize, robot: usize, epoch: i32) -> bool {
        let rank = |robot: usize| (self.run.hops[robot][wfr], robot);
        let own = &mut self.wfrs[wfr];
        let is_own = epoch == own.epoch;
        if is_own && own.is_open {
            own.heard.insert(robot);
            own.best = own.best.into_iter().chain([rank(robot)]).min();
        }
        let before = own.choice;
        if own.waits {
            own.asked.insert(robot);
            own.choice = own.asked.iter().copied().min_by_key(|&robot| rank(robot));
        }
        let told = if own.waits { own.asked.clone() } else { BTreeSet::new() };
        let (epoch, chosen) = (own.epoch, own.choice);
        let bidder: BTreeSet<usize> = is_own.then_some(robot).into_iter().collect();
        let has_decided = epoch > 0 && (chosen.is_some() || !own.waits);
        let mut due = if has_decided { bidder.clone() } else { BTreeSet::new() };
        if chosen.is_some() && before != chosen {
            due.extend(&own.heard);
        }
        let may: BTreeSet<usize> = own.heard.iter().copied().chain(bidder).chain(chosen).collect();
        for &robot in told.iter().filter(|&&robot| self.robots[robot].lives) {
            self.network.push(Message { what: What::Resb, wfr, robot, epoch, chosen });
        }
        !due.is_subset(&told) || !told.is_subset(&may)
    }

    /// A window is closed when no message to or from its WFR is on its way, and when a robot has come.
    fn close_windows(&mut self) {
        for (number, wfr) in self.wfrs.iter_mut().enumerate() {
            wfr.is_open &= wfr.waits && self.network.iter().any(|message| message.wfr == number);
            if !wfr.is_open {
                wfr.heard.clear();
            }
        }
    }

    fn is_broken(&self, happened: StepBreaches) -> Result<bool, &'static str> {
        let chosen = |wfr: &Wfr| wfr.choice.filter(|_| wfr.waits);
        let wfrs =
            || self.wfrs.iter().enumerate().filter_map(|(number, wfr)| Some((number, wfr, chosen(wfr)?)));
        Ok(match self.run.clause {
            "MRC-1" => {
                let goes = |robot: &&Robot| robot.lives && matches!(robot.task, Task::Goes(..));
                let tasks: Vec<Task> = self.robots.iter().filter(goes).map(|robot| robot.task).collect();
                (0..tasks.len()).any(|one| tasks[..one].contains(&tasks[one]))
            }
            "MRC-2" => {
                let counted: Vec<usize> = wfrs().map(|(_, _, robot)| robot).collect();
                (0..counted.len()).any(|one| counted[..one].contains(&counted[one]))
            }
            "MRC-3" => wfrs().any(|(_, wfr, robot)| wfr.best.is_none_or(|(_, best)| best != robot)),
            "MRC-4" => wfrs().any(|(number, wfr, robot)| self.robots[robot].taken[number] != Some(wfr.epoch)),
            "MRC-6" => happened.is_set,
            "MRC-8" => happened.is_unasked,
            "MRC-9" => happened.is_untold,
            _ => return Err("the judge does not know this clause"),
        })
    }
}

/// NOTICEs that a robot has heard, and what it has recorded of one WFR, as published.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Record {
    /// The clause that it is said to break.
    pub clause: &'static str,
    /// The NOTICEs that were heard, in order.
    pub heard: Vec<NoticeRecord>,
    /// The record of the WFR of the last NOTICE, with the hop count of the robot.
    pub record: NoticeRecord,
}

/// A NOTICE, or a record of it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct NoticeRecord {
    /// The WFR that calls.
    pub wfr: usize,
    /// The number of its call.
    pub epoch: i32,
    /// The hop count.
    pub hops: i32,
    /// The node that has sent it, which is the robot's parent.
    pub sender: i32,
}

plain!(Record { heard, record });
plain!(NoticeRecord { wfr, epoch, hops, sender });

impl Case for Record {
    fn clause(&self) -> &'static str {
        self.clause
    }

    fn judge(&self) -> Result<(), Objection> {
        must(self.clause == "MRC-10", "the judge does not know this clause")?;
        let is_notice = |heard: &NoticeRecord| heard.epoch >= 1 && heard.hops >= 0 && heard.sender >= 0;
        must(self.heard.iter().all(is_notice), "that is no NOTICE")?;
        let wfr = self.record.wfr;
        must(self.heard.last().is_some_and(|last| last.wfr == wfr), "the last NOTICE is of another WFR")?;
        for length in 1..=self.heard.len() {
            let object = |what| Objection { at: length, what };
            let of_wfr = || self.heard[..length].iter().filter(|heard| heard.wfr == wfr);
            let Some(newest) = of_wfr().map(|heard| heard.epoch).max() else { continue };
            let one_hop_more =
                |heard: &NoticeRecord| NoticeRecord { epoch: newest, hops: heard.hops + 1, ..*heard };
            // As published the event of a NOTICE is not told: the least hop count of all counts.
            let record = of_wfr().min_by_key(|heard| heard.hops).map(one_hop_more);
            let due = of_wfr()
                .filter(|heard| heard.epoch == newest)
                .min_by_key(|heard| heard.hops)
                .map(one_hop_more);
            if length < self.heard.len() {
                must(record == due, "the clause is broken before").map_err(object)?;
            } else {
                must(record == Some(self.record), "the rule records something else").map_err(object)?;
                must(record != due, "the clause is not broken").map_err(object)?;
            }
        }
        Ok(())
    }
}
