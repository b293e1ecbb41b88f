//! The words for a step that its frame cannot show: which robots acted, which one died, which messages were lost.

use super::Moves;
use super::rule::Rule;
use super::world::{Event, TeamWorld};

impl<R: Rule> TeamWorld<'_, R> {
    /// The words for a step, such as `robot 0 dies`; none where all robots act in each step and no message is lost.
    /// Robots count from 0.
    pub fn title(&self, event: &Event) -> String {
        let Event { died, looked, lost, .. } = event;
        if let Some(robot) = died {
            return format!("robot {robot} dies");
        }
        let acting = (0..event.steps.len()).filter(|robot| event.acted >> robot & 1 == 1);
        let acting: Vec<String> = acting.map(|robot| robot.to_string()).collect();
        let verb = match (self.setting.moves, *looked != 0) {
            (Moves::Together, _) => None,
            (Moves::OneAtATime | Moves::AnySubset, _) => Some("act"),
            (Moves::LookThenMove, true) => Some("look"),
            (Moves::LookThenMove, false) => Some("move"),
        };
        let deed = verb.map(|verb| match &acting[..] {
            [robot] => format!("robot {robot} {verb}s"),
            robots => format!("robots {} {verb}", robots.join(" and ")),
        });
        let is_lost =
            |(from, to): &(usize, usize)| format!("the message of robot {from} to robot {to} is lost");
        deed.into_iter().chain(lost.iter().map(is_lost)).collect::<Vec<_>>().join(", ")
    }
}
