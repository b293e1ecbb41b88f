//! A check that no state, and no run, breaks a demand within a setting.

use std::fmt;

use tautline_kernel::mrc::{Rule, Upward, Word};

use super::chart::chart;
use super::space::{self, Refutation};
use super::state::{Action, Message, place};
use super::{Demand, Faults, RobotReading, Setting, Subject};
use crate::decide::{
    Answer, Context, Depiction, DrawnCertificate, Evidence, Method, MethodError, MethodResult,
    RefutationPlay, Size, Systems,
};
use crate::engine::smallest::{Certificate, ClassFindings};
use crate::engine::states::Limits;
use crate::engine::{Choices, Script, ScriptError, Until};
use crate::judge::{AnyCase, mrc as judge};
use crate::plural::counted;

/// Every state within a setting is checked for a demand.
pub(super) struct Within(pub Demand, pub Setting);

/// Steps between states at which a check is left open.
const MOST_STEPS: u64 = 20_000_000;

impl Within {
    fn setting(&self, observed: &Subject) -> Setting {
        Setting { rule: observed.rule, misread: observed.misread, reading: observed.reading, ..self.1 }
    }

    fn evidence(setting: &Setting, broken: &Refutation) -> Evidence {
        let seen = Depiction::Messages { events: broken.actions.len(), chart: chart(setting, broken) };
        Evidence { choices: broken.run.choices(), demand: broken.run.demand.broken(), seen }
    }
}

impl Method<Subject> for Within {
    fn engine(&self) -> &'static str {
        "states"
    }

    fn bound(&self) -> String {
        self.1.bound()
    }

    fn family(&self, observed: &Subject) -> Option<String> {
        Some(format!("{:?}", self.setting(observed)))
    }

    fn decide(&self, observed: &Subject, until: Until, context: &mut Context<'_, '_>) -> MethodResult {
        let (demand, setting) = (self.0, self.setting(observed));
        let until = match until {
            Until::Exhausted => space::Until::Exhausted,
            Until::Violation => space::Until::Broken(demand),
        };
        let limits = Limits { memory: context.memory, ..Limits::steps(MOST_STEPS) };
        let found: Result<&space::Findings, MethodError> = context
            .cache
            .recall((setting, until), |(setting, until)| Ok(space::search(setting, *until, limits)));
        let found = found?;
        let evidence = found.broken(demand).map(|broken| Self::evidence(&setting, broken));
        Ok(Answer::new(evidence, found.complete, self.shows(), found.states))
    }

    fn systems(&self, observed: &Subject) -> Result<Systems, MethodError> {
        Ok(vec![space::started(self.setting(observed), self.0)])
    }

    fn replay(&self, observed: &Subject, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let setting = self.setting(observed);
        let (of, broken) = space::replay(&setting, self.0, Script::new(choices))?;
        Ok(RefutationPlay { of, evidence: Self::evidence(&setting, &broken) })
    }

    fn case(&self, observed: &Subject, choices: &Choices) -> Option<Box<dyn AnyCase>> {
        let setting = self.setting(observed);
        let (_, broken) = space::replay(&setting, self.0, Script::new(choices)).ok()?;
        written(&setting, &broken)
    }

    fn size(&self, observed: &Subject, choices: &Choices) -> Option<Size> {
        let setting = self.setting(observed);
        let (_, broken) = space::replay(&setting, self.0, Script::new(choices)).ok()?;
        Some((Counts::of(&setting).to_string(), broken.run.length()))
    }

    /// Fewest WFRs first, then faults, robots, hops and events.
    fn smallest(&self, observed: &Subject) -> Result<Option<DrawnCertificate>, MethodError> {
        let (demand, most) = (self.0, self.setting(observed));
        let search = |Counts([wfrs, faults, robots, max_hops, events]): Counts| {
            let faults = Faults::any(faults as u8);
            let setting =
                Setting { wfrs, faults, robots, max_hops: max_hops as u16, events: events as u8, ..most };
            let found = space::search(&setting, space::Until::Broken(demand), Limits::NONE);
            let broken = found.broken(demand);
            let shortest = broken.map(|broken| (broken.run.length(), chart(&setting, broken)));
            Ok::<_, MethodError>(ClassFindings { cases: found.states, is_whole: found.is_shortest, shortest })
        };
        Ok(Some(Certificate::in_order(Counts::up_to(&most), search)?.drawn(|chart| chart)))
    }
}

/// WFRs, faults, robots, hops and events.
#[derive(Clone, Copy)]
struct Counts([usize; 5]);

impl Counts {
    const fn of(setting: &Setting) -> Self {
        let Setting { wfrs, robots, faults, max_hops, events, .. } = *setting;
        Self([wfrs, faults.in_all as usize, robots, max_hops as usize, events as usize])
    }

    /// All within a setting, in order.
    fn up_to(most: &Setting) -> impl Iterator<Item = Self> {
        let Self(bounds) = Self::of(most);
        let least = [1, 0, 1, 1, 1];
        let of = (0..5).map(|place| bounds[place] + 1 - least[place]).product::<usize>();
        (0..of).map(move |mut number| {
            let mut counts = least;
            for place in (0..5).rev() {
                let of = bounds[place] + 1 - least[place];
                counts[place] += number % of;
                number /= of;
            }
            Self(counts)
        })
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self([wfrs, faults, robots, hops, events]) = *self;
        let things = [(wfrs, "WFR"), (faults, "fault"), (robots, "robot"), (hops, "hop"), (events, "event")];
        f.write_str(&things.map(|(count, one)| counted(count, one)).join(", "))
    }
}

/// A run by the published rule, written down for the judge; `None` if more happens in it than the judge knows.
fn written(setting: &Setting, broken: &Refutation) -> Option<Box<dyn AnyCase>> {
    let Refutation { run, actions, round } = broken;
    if setting.rule != Rule::PUBLISHED || setting.reading != RobotReading::PUBLISHED || !round.is_empty() {
        return None;
    }
    let mut state = setting.start(run.start as u32);
    let hops = |robot: usize| (0..setting.wfrs).map(|wfr| i32::from(state.hops(robot, wfr))).collect();
    let hops: Vec<Vec<i32>> = (0..setting.robots).map(hops).collect();
    let does = |what, wfr, robot| {
        let (fate, epoch, chosen) = (judge::Fate::Arrives, 0, None);
        Some(judge::Step { what, fate, wfr, robot, epoch, chosen })
    };
    let mut steps = Vec::new();
    for &action in actions {
        let of = |at: usize, fate| message(state.network()[at], fate);
        steps.push(match action {
            Action::Raise(wfr) => does(judge::What::Calls, wfr, 0),
            Action::Deliver(at) => of(at, judge::Fate::Arrives),
            Action::Lose(at) => of(at, judge::Fate::IsLost),
            Action::Duplicate(at) => of(at, judge::Fate::ComesTwice),
            Action::Arrive(robot) => does(judge::What::Comes, place(state.comes_for(robot)?.wfr), robot),
            Action::FailRobot(robot) => does(judge::What::Fails, 0, robot),
            Action::Begin(_) | Action::Expire(_) | Action::Lapse(_) | Action::FailNode { .. } => None,
        }?);
        state = state.after(setting, action);
    }
    let is_fault = |step: &&judge::Step| step.fate != judge::Fate::Arrives || step.what == judge::What::Fails;
    let faults = steps.iter().filter(is_fault).count();
    Some(Box::new(judge::Run { clause: run.demand.clause(), hops, faults, steps }))
}

/// The fate of a message, as the judge reads it.
fn message(message: Message, fate: judge::Fate) -> Option<judge::Step> {
    let (what, chosen) = match message {
        Message::Notice(..) => (judge::What::Notice, None),
        Message::Resb(resb) => (judge::What::Resb, resb.chosen.map(|robot| usize::from(robot.0))),
        Message::Up(Upward { word: Word::Move { .. }, .. }) => (judge::What::Move, None),
        Message::Up(_) => return None,
    };
    let (call, robot) = (message.call(), usize::from(message.robot().0));
    let epoch = i32::try_from(call.epoch.0).ok()?;
    Some(judge::Step { what, fate, wfr: place(call.wfr), robot, epoch, chosen })
}
