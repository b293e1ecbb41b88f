//! The small floors of the checks of Brick&Mortar: which plans, how many agents, what they miss, and what is demanded
//! of every state (BRICKS-2 to BRICKS-6).

use tautline_kernel::bricks::Rule;

use super::team::{Demand, Team, Turns};
use super::{Deception, Observed};
use crate::decide::{Answer, Context, Depiction, Evidence, Method, MethodError, RefutationPlay};
use crate::engine::states::Limits;
use crate::engine::{Choices, Script, ScriptError, Until};
use crate::floor::look::Explored;
use crate::floor::plans::Area;

/// Teams to look at: all plans of an area, how many agents start in any of their cells, and how many sensors they miss.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Series {
    area: Area,
    agents: u32,
    max_misses: u8,
    max_streak: Option<u8>,
    turns: Turns,
    may_fail: bool,
    /// Idle moves before an agent goes round; none where what it gains before can only come earlier.
    patience: u8,
    /// Moves after which a lap is cut short: few, so that in small layouts some are and some are not.
    reach: u8,
}

/// Idle moves before an agent goes round where it is to go to least crossed cells for a while: few, so that it does
/// both in small layouts.
const PATIENT: u8 = 2;

impl Series {
    /// Every action one step, every schedule, nothing missed, no patience.
    const fn new(area: Area, agents: u32) -> Self {
        let turns = Turns::Whole;
        Self { area, agents, max_misses: 0, max_streak: None, turns, may_fail: false, patience: 0, reach: 4 }
    }

    /// The same with missed sensors; no agent acts more than twice while another waits.
    const fn missing(area: Area, agents: u32, max_misses: u8) -> Self {
        Self { max_misses, max_streak: Some(2), ..Self::new(area, agents) }
    }

    /// The same with patient agents, which read the crossings of cells: they count up without end where an agent is
    /// kept from acting, so no agent acts more than twice while another waits.
    const fn patient(area: Area, agents: u32, max_misses: u8) -> Self {
        Self { patience: PATIENT, ..Self::missing(area, agents, max_misses) }
    }

    /// The teams, one in each plan.
    fn teams(self, observed: &Observed, demand: Demand) -> Vec<Team> {
        let Self { area, agents: _, max_misses, max_streak, turns, may_fail, patience, reach } = self;
        let rule = Rule { patience, reach, ..observed.rule };
        let is_atomic = observed.deception != Deception::ActsAtOnce;
        let turns = if turns == Turns::Overlapping && !is_atomic { Turns::Free } else { turns };
        let team = |plan| Team { plan, rule, turns, max_misses, max_streak, may_fail, demand };
        area.plans().map(team).collect()
    }

    /// What it is, `who` standing for its agents.
    fn words(self, who: &str) -> String {
        let Self { area, agents, max_misses, max_streak, turns, may_fail, patience, reach: _ } = self;
        let turns = match turns {
            Turns::Whole => None,
            Turns::Overlapping => Some("scans and writes in every order unless scans overlap".to_owned()),
            Turns::Free => Some("scans and writes in every order".to_owned()),
        };
        let streak = max_streak.filter(|_| agents > 1);
        let words = [
            Some(format!("{agents}{who} to {area}")),
            (max_misses > 0).then(|| format!("{max_misses} missed")),
            (patience > 0).then(|| format!("patience {patience}")),
            may_fail.then(|| "all but one may fail".to_owned()),
            turns,
            streak.map(|most| format!("at most {most} acts in a row")),
        ];
        words.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

/// The small floors of a check, and what is demanded of every state of the agents on them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Floors {
    series: &'static [Series],
    demand: Demand,
}

impl Floors {
    /// BRICKS-2, nothing missed, one agent.
    pub(super) const CONNECTED_ALONE: Self = Self { series: &ALONE, demand: Demand::Connected };
    /// BRICKS-2, nothing missed.
    pub(super) const CONNECTED: Self = Self { series: &TOGETHER, demand: Demand::Connected };
    /// BRICKS-2, sensors missed.
    pub(super) const CONNECTED_HALF_BLIND: Self = Self { series: &HALF_BLIND, demand: Demand::Connected };
    /// BRICKS-3
    pub(super) const CONNECTED_IN_TURNS: Self = Self { series: &IN_TURNS, demand: Demand::Connected };
    /// BRICKS-4, nothing missed.
    pub(super) const KNOWING: Self = Self { series: &TOGETHER, demand: Demand::Knowing };
    /// BRICKS-4, sensors missed.
    pub(super) const KNOWING_HALF_BLIND: Self = Self { series: &HALF_BLIND, demand: Demand::Knowing };
    /// BRICKS-5, sensors missed.
    pub(super) const EXPLORES_HALF_BLIND: Self = Self { series: &HALF_BLIND, demand: Demand::Explores };
    /// BRICKS-6, nothing missed, one agent.
    pub(super) const ENDS_ALONE: Self = Self { series: &ALONE, demand: Demand::Ends };
    /// BRICKS-6, nothing missed.
    pub(super) const ENDS: Self = Self { series: &TOGETHER, demand: Demand::Ends };
    /// BRICKS-6, nothing missed, and all gone over twice.
    pub(super) const ENDS_TWICE: Self = Self { series: &TWICE, demand: Demand::Ends };
    /// BRICKS-6, sensors missed.
    pub(super) const ENDS_HALF_BLIND: Self = Self { series: &HALF_BLIND, demand: Demand::Ends };

    /// BRICKS-11, small areas first.
    pub(super) const SURVIVES: Self = Self { series: &FAILING, demand: Demand::Ends };

    /// The same floors with the demands of all clauses that are about them, if these are several.
    fn together(self) -> Option<Self> {
        let shared = [
            Self::CONNECTED,
            Self::KNOWING,
            Self::ENDS,
            Self::CONNECTED_HALF_BLIND,
            Self::KNOWING_HALF_BLIND,
            Self::ENDS_HALF_BLIND,
        ];
        shared.contains(&self).then_some(Self { demand: Demand::All, ..self })
    }

    /// Looks at the states of each plan within `limits`, series by series, until the first violation. Its choices are
    /// the numbers of the series, the plan and the start, then the steps. What is wrong with a mutant is sought in
    /// small areas first.
    fn explore(self, observed: &Observed, (limits, until): (Limits<'_>, Until)) -> Explored {
        let mut explored = Explored::new();
        let mut series: Vec<(u32, &Series)> = (0..).zip(self.series).collect();
        if until == Until::Violation {
            series.sort_by_key(|(_, series)| (series.patience, series.area.cells()));
        }
        for (number, series) in series {
            let teams = series.teams(observed, self.demand);
            let starts = |team: &Team| team.starts(series.agents).collect();
            let Some((team, run)) = explored.look(number, &teams, starts, (limits, until)) else { continue };
            explored.again = run.round().to_vec();
            explored.course = team.starts(series.agents).nth(run.start).map(|start| team.course(start, &run));
            break;
        }
        explored
    }
}

impl Method<Observed> for Floors {
    fn engine(&self) -> &'static str {
        "states"
    }

    fn bound(&self) -> String {
        let name = |agents: u32| if agents == 1 { " agent" } else { " agents" };
        let first = self.series.iter().take(1).map(|series| series.words(name(series.agents)));
        let mut words: Vec<String> =
            first.chain(self.series.iter().skip(1).map(|series| series.words(""))).collect();
        let mut reaches: Vec<u8> = self.series.iter().map(|series| series.reach).collect();
        reaches.dedup();
        words.extend(reaches.into_iter().map(|reach| format!("reach {reach}")));
        words.join("; ")
    }

    fn family(&self, observed: &Observed) -> Option<String> {
        self.together().map(|together| format!("{together:?} {observed:?}"))
    }

    /// What several clauses demand of the same floors is looked at in one pass. Where something is broken there, each
    /// looks for its own first violation.
    fn decide(
        &self,
        observed: &Observed,
        until: Until,
        desk: &mut Context<'_, '_>,
    ) -> Result<Answer, MethodError> {
        let limits = Limits { room: desk.room, ..Limits::NONE };
        let Some(together) = self.together().filter(|_| until == Until::Exhausted) else {
            return Ok(self.explore(observed, (limits, until)).answer(self.shows()));
        };
        let key = (together, *observed);
        let explored: Result<&Explored, MethodError> =
            desk.memory.recall(key, |(floors, observed)| Ok(floors.explore(observed, (limits, until))));
        let explored = explored?.clone();
        let is_kept = explored.tally.violation.is_none();
        Ok(if is_kept { explored } else { self.explore(observed, (limits, until)) }.answer(self.shows()))
    }

    fn replay(&self, observed: &Observed, choices: &Choices) -> Result<RefutationPlay, ScriptError> {
        let mut script = Script::new(choices);
        let series = self.series[script.choose(self.series.len())?];
        let teams = series.teams(observed, self.demand);
        let team = &teams[script.choose(teams.len())?];
        let mut starts: Vec<_> = team.starts(series.agents).collect();
        let number = script.choose(starts.len())?;
        let start = starts.swap_remove(number);
        let (of, run) = script.play(team, (number, start.clone()), |_| true)?;
        let seen = Depiction::Agents(Box::new(team.course(start, &run)));
        Ok(RefutationPlay { of, evidence: Evidence { choices: choices.clone(), demand: run.demand, seen } })
    }
}

/// Nothing missed: one agent alone, two and three in every order; patient ones last, since what is wrong with a rule
/// may let them go on without end.
const TOGETHER: [Series; 7] = [
    Series::new(Area::blocked(4, 4), 1),
    Series::new(Area::walled(3, 3), 1),
    Series::new(Area::walled(3, 2), 2),
    Series::new(Area::blocked(3, 2), 3),
    Series::new(Area::blocked(3, 3), 2),
    Series::patient(Area::blocked(4, 3), 1, 0),
    Series::patient(Area::blocked(4, 2), 2, 0),
];

/// One agent alone, nothing missed.
const ALONE: [Series; 1] = [Series::new(Area::blocked(4, 4), 1)];

/// Sensors missed; small areas first and patient agents last, as in [`TOGETHER`].
const HALF_BLIND: [Series; 7] = [
    Series::missing(Area::blocked(3, 2), 1, 4),
    Series::missing(Area::walled(3, 2), 1, 2),
    Series::missing(Area::blocked(3, 3), 1, 2),
    Series::missing(Area::blocked(3, 2), 2, 1),
    Series::patient(Area::blocked(3, 3), 1, 1),
    Series::patient(Area::blocked(3, 2), 1, 2),
    Series::patient(Area::blocked(2, 2), 2, 1),
];

/// Scanning and writing are two steps.
const IN_TURNS: [Series; 1] = [Series { turns: Turns::Overlapping, ..Series::new(Area::blocked(5, 2), 2) }];

/// Agents fail.
const FAILING: [Series; 3] = [
    Series { may_fail: true, ..Series::new(Area::blocked(2, 1), 2) },
    Series { may_fail: true, ..Series::new(Area::blocked(3, 1), 2) },
    Series { may_fail: true, ..Series::new(Area::blocked(2, 2), 2) },
];

/// Nothing missed, and all gone over twice.
const TWICE: [Series; 5] = [
    Series::new(Area::blocked(4, 3), 1),
    Series::new(Area::walled(3, 3), 1),
    Series::new(Area::blocked(4, 2), 2),
    Series::patient(Area::blocked(4, 3), 1, 0),
    Series::patient(Area::blocked(3, 2), 2, 0),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::states::search;

    /// All states of a series, and the bytes of the largest search of it.
    fn all_states(series: Series, demand: Demand) -> (u64, u64, u64) {
        let teams = series.teams(&Observed::marking(Rule::REPAIRED), demand);
        let found = teams.iter().map(|team| {
            let found = search(team, team.starts(series.agents), Limits::NONE);
            assert!(found.is_whole && found.broken.is_empty(), "{series:?}");
            found
        });
        found.fold((0, 0, 0), |(all, states, bytes), found| {
            let most = if found.states > states { (found.states, found.bytes) } else { (states, bytes) };
            (all + found.states, most.0, most.1)
        })
    }

    #[test]
    fn a_state_of_the_largest_floor_takes_at_most_64_bytes() {
        let series = Series::new(Area::blocked(3, 3), 2);
        let open = &series.teams(&Observed::marking(Rule::REPAIRED), Demand::All)[0];
        let found = search(open, open.starts(series.agents), Limits::NONE);
        assert!(
            found.is_whole && found.bytes <= 64 * found.states,
            "{} bytes for {}",
            found.bytes,
            found.states
        );
    }

    #[test]
    #[ignore = "takes minutes: cargo test --release -p tautline-proofs -- --ignored --nocapture two_agents"]
    fn two_agents_keep_all_layouts_of_four_by_three_cells_connected_and_end_with_every_cell_visited() {
        for reach in [u8::MAX, 4] {
            let series = Series { reach, ..Series::new(Area::blocked(4, 3), 2) };
            let (all, states, bytes) = all_states(series, Demand::All);
            println!("reach {reach}: {all} states, the largest layout {states} in {} MiB", bytes >> 20);
        }
    }
}
