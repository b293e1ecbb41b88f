//! A check that no state, and no run, breaks a demand within a setting.

use super::chart::chart;
use super::space::{self, Refutation};
use super::{Demand, Setting, Subject};
use crate::decide::{Answer, Context, Depiction, Evidence, Method, MethodError, RefutationPlay};
use crate::engine::states::Limits;
use crate::engine::{Choices, Script, ScriptError, Until};

/// Every state within a setting is checked for a demand.
pub(super) struct Within(pub Demand, pub Setting);

/// Steps between states at which a check is left open.
const MOST_STEPS: u64 = 20_000_000;

impl Within {
    fn setting(&self, observed: &Subject) -> Setting {
        Setting { rule: observed.rule, ..self.1 }
    }

    fn evidence(setting: &Setting, broken: &Refutation) -> Evidence {
        let seen = Depiction::Messages { events: broken.actions.len(), chart: chart(setting, broken) };
        Evidence { choices: broken.choices(setting), demand: broken.demand.broken(), seen }
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

    fn decide(
        &self,
        observed: &Subject,
        until: Until,
        desk: &mut Context<'_, '_>,
    ) -> Result<Answer, MethodError> {
        let (demand, setting) = (self.0, self.setting(observed));
        let until = match until {
            Until::Exhausted => space::Until::Exhausted,
            Until::Violation => space::Until::Broken(demand),
        };
        let limits = Limits { most_steps: MOST_STEPS, room: desk.room };
        let found: Result<&space::Findings, MethodError> = desk
            .memory
            .recall((setting, until), |(setting, until)| Ok(space::search(setting, *until, limits)));
        let found = found?;
        let evidence = found.broken(demand).map(|broken| Self::evidence(&setting, broken));
        Ok(Answer::new(evidence, found.complete, self.shows(), found.states))
    }

    fn replay(&self, observed: &Subject, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let setting = self.setting(observed);
        let (of, broken) = space::replay(&setting, self.0, Script::new(choices))?;
        Ok(RefutationPlay { of, evidence: Self::evidence(&setting, &broken) })
    }
}
