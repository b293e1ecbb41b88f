//! Brick&Mortar (BRICKS): what is promised of agents that mark cells, over every neighbourhood and over all states on
//! small floors.

pub mod clauses;
mod floors;
mod marking;
#[cfg(test)]
mod next_cell;
pub mod tree;

use std::convert::Infallible;

use tautline_kernel::bricks::{Act, Agent, Condition, Next, Rule, carry_out};
use tautline_kernel::floor::{Floor, Mark, Scan, Sensor};
use tautline_kernel::ground::{Cell, Step};

use crate::floor::crew::{BodyOf, Scheme, Sight};
use crate::floor::team::Demands;

impl Scheme for Rule {
    type Sensor = Sensor;
    type Memory = Agent;
    type Act = Act;

    fn memory(&self, id: u8) -> Agent {
        Agent::new(id)
    }

    fn decide(&self, agent: &mut Agent, scan: &Scan) -> Act {
        agent.decide(*self, scan)
    }

    fn carry_out(&self, floor: &mut impl Floor, cell: Cell, act: &Act) -> Cell {
        carry_out(floor, cell, act)
    }

    fn step(act: &Act) -> Option<Step> {
        match act.next {
            Next::Goes(side, ..) => Some(Step::Cross(side)),
            Next::Waits => Some(Step::Stay),
            Next::Done => None,
        }
    }

    fn reads_serials(&self, sight: Sight) -> bool {
        sight == Sight::Partial && self.has(Condition::SeenOnly)
    }

    /// Not if the agent goes round at once and is never lost.
    fn reads_crossings(&self, sight: Sight) -> bool {
        self.has(Condition::LeastCrossed) && (sight == Sight::Partial || self.patience > 0)
    }

    fn passes(&self, mark: Mark) -> bool {
        match mark {
            Mark::Unexplored | Mark::Explored | Mark::Closing => true,
            Mark::Visited => self.has(Condition::SecondPass),
            Mark::Sealed => false,
        }
    }

    /// By those who go over visited cells again, to whom missed sensors always show something.
    fn may_roam(&self, sight: Sight) -> bool {
        sight == Sight::Partial && self.has(Condition::SecondPass)
    }

    fn promises(&self, sight: Sight) -> bool {
        sight == Sight::Whole
    }
}

/// Moves after which a lap is cut short on small floors: few, so that in small layouts some are and some are not.
const REACH: u8 = 4;

impl Demands for Rule {
    type Own = Infallible;

    fn bounds() -> Option<String> {
        Some(format!("reach {REACH}"))
    }

    fn with_patience(self, patience: u8) -> Self {
        Self { patience, reach: REACH, ..self }
    }

    /// Whoever has failed is taken for one that is done: their sensors tell the others of them.
    fn fail(body: &mut BodyOf<Self>) {
        body.is_done = true;
    }

    fn forget(agent: &mut Agent, id: u8) {
        *agent = Agent::new(id);
    }
}

#[cfg(test)]
mod tests {
    use rustc_hash::FxHashSet;
    use tautline_kernel::floor::SensorFate;

    use super::*;
    use crate::engine::states::{Limits, search, steps};
    use crate::floor::plans::Area;
    use crate::floor::series::Subject;
    use crate::floor::small::StateOf;
    use crate::floor::team::{Demand, Series, Team};

    /// All states of two agents in a few cells; wherever one is done, it might as well remember what the other does.
    #[test]
    fn what_an_agent_remembers_that_is_done_plays_no_part() {
        for (rule, max_misses, width) in [(Rule::REPAIRED, 0, 3), (Rule::ROBUST, 1, 2)] {
            let missing = Series::missing(Area::blocked(width, 2), 2, max_misses);
            let series = Series { max_streak: Some(2), patience: 2, ..missing };
            let team = &series.teams(&Subject::of(rule), Demand::All)[0];
            let come_of = |state: &StateOf<Rule>| -> Vec<_> {
                steps(team, state).map(|step| (step.state, step.event.agent, step.breaks)).collect()
            };
            let (mut known, mut ahead) = (FxHashSet::default(), team.starts().collect::<Vec<_>>());
            let mut compared = 0;
            while let Some(state) = ahead.pop() {
                if !known.insert(state.clone()) {
                    continue;
                }
                let next = come_of(&state);
                for (one, other) in [(0, 1), (1, 0)] {
                    let mut remembering = state.clone();
                    let mut agent = state.bodies[other].memory;
                    agent.id = state.bodies[one].memory.id;
                    remembering.bodies[one].memory = agent;
                    if state.bodies[one].is_done && remembering != state {
                        compared += 1;
                        assert_eq!(come_of(&remembering), next);
                    }
                }
                ahead.extend(next.into_iter().map(|(state, ..)| state));
            }
            assert!(compared > 100, "{compared} states");
        }
    }

    #[test]
    fn a_state_of_the_largest_floor_takes_at_most_64_bytes() {
        let series = Series::new(Area::blocked(3, 3), 2);
        let open = &series.teams(&Subject::of(Rule::REPAIRED), Demand::All)[0];
        let found = search(open, open.starts(), Limits::NONE);
        assert!(
            found.is_whole && found.bytes <= 64 * found.states,
            "{} bytes for {}",
            found.bytes,
            found.states
        );
    }

    /// With one sensor missed no cell is missed that has two: whether these are missed one by one plays no part.
    #[test]
    fn one_missed_sensor_is_enough_where_the_old_one_stays() {
        let subject = Subject::of(Rule { replaced: SensorFate::Beside, ..Rule::PUBLISHED });
        for demand in [Demand::Knowing, Demand::Explores, Demand::Ends] {
            let teams = Series::missing(Area::blocked(3, 3), 1, 1).teams(&subject, demand);
            let is_broken = |team: &Team<Rule>| !search(team, team.starts(), Limits::NONE).broken.is_empty();
            assert!(teams.iter().any(is_broken), "{demand:?}");
        }
    }

    /// Three turns in four cells are enough; of two agents that act in turn none is shut in.
    #[test]
    fn an_agent_that_acts_twice_shuts_another_in_beside_an_unexplored_cell() {
        let broken = |area: Area, max_streak: Option<u8>| -> Vec<&'static str> {
            let series = Series { max_streak, ..Series::new(area, 2) };
            let teams = series.teams(&Subject::of(Rule::PUBLISHED), Demand::Knowing);
            let runs = teams.iter().flat_map(|team| search(team, team.starts(), Limits::NONE).broken);
            runs.map(|run| run.demand).collect()
        };
        let first = broken(Area::blocked(4, 1), Some(2)).first().copied();
        assert_eq!(first, Some("an agent is done only when every cell is explored"));
        for (width, height) in [(4, 2), (3, 3)] {
            assert_eq!(broken(Area::blocked(width, height), Some(1)), [""; 0], "{width}×{height}");
        }
    }

    #[test]
    #[ignore = "takes minutes: cargo test --release -p tautline-proofs -- --ignored --nocapture two_agents"]
    fn two_agents_keep_all_layouts_of_four_by_three_cells_connected_and_end_with_every_cell_visited() {
        for reach in [u8::MAX, REACH] {
            let series = Series::new(Area::blocked(4, 3), 2);
            let teams = series.teams(&Subject::of(Rule::REPAIRED), Demand::All);
            let (mut all, mut states, mut bytes) = (0, 0, 0);
            for team in teams {
                let team = Team { scheme: Rule { reach, ..team.scheme }, ..team };
                let found = search(&team, team.starts(), Limits::NONE);
                assert!(found.is_whole && found.broken.is_empty(), "{series:?}");
                all += found.states;
                (states, bytes) = (states, bytes).max((found.states, found.bytes));
            }
            println!("reach {reach}: {all} states, the largest layout {states} in {} MiB", bytes >> 20);
        }
    }
}
