//! The small floors of the checks of agents that search in trees: which plans, how many agents, what they miss, whether
//! they fail, and what is demanded of every state.

use tautline_kernel::bricks::tree::Note;

use super::team::{Demand, Team, Turns};
use super::{Deception, Observed};
use crate::decide::{Answer, Context, Depiction, Evidence, Method, MethodError, RefutationPlay};
use crate::engine::states::Limits;
use crate::engine::{Choices, Script, ScriptError, Until};
use crate::floor::look::Explored;
use crate::floor::plans::Area;

/// Teams to look at: all plans of an area, how many agents start in any of their cells, and what may go wrong.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Series {
    area: Area,
    agents: u32,
    max_misses: u8,
    turns: Turns,
    may_fail: bool,
    /// How far sensors count crossings, so that runs that go on for ever come round.
    most_crossings: u16,
}

/// How far sensors count crossings where an agent is to go on for ever: an agent reads which of two counts is less.
const FEW: u16 = 3;

impl Series {
    /// Every action one step, every schedule, nothing missed, nobody fails.
    const fn new(area: Area, agents: u32) -> Self {
        let turns = Turns::Whole;
        Self { area, agents, max_misses: 0, turns, may_fail: false, most_crossings: Note::MOST_CROSSINGS }
    }

    const fn missing(area: Area, agents: u32, max_misses: u8) -> Self {
        Self { max_misses, ..Self::new(area, agents) }
    }

    /// Sensors count no farther than to [`FEW`].
    const fn counting(area: Area, agents: u32, max_misses: u8) -> Self {
        Self { most_crossings: FEW, ..Self::missing(area, agents, max_misses) }
    }

    const fn failing(area: Area, agents: u32) -> Self {
        Self { may_fail: true, ..Self::new(area, agents) }
    }

    /// Scanning and writing are two steps.
    const fn taking_turns(area: Area) -> Self {
        Self { turns: Turns::Overlapping, ..Self::new(area, 2) }
    }

    /// The teams, one in each plan.
    fn teams(self, observed: &Observed, demand: Demand) -> Vec<Team> {
        let Self { area, agents: _, max_misses, turns, may_fail, most_crossings } = self;
        let Observed { way, deception } = *observed;
        let is_at_once = turns == Turns::Overlapping && deception == Deception::ActsAtOnce;
        let turns = if is_at_once { Turns::Free } else { turns };
        let team = |plan| Team { plan, way, deception, turns, max_misses, may_fail, most_crossings, demand };
        area.plans().map(team).collect()
    }

    /// What it is, `who` standing for its agents.
    fn words(self, who: &str) -> String {
        let Self { area, agents, max_misses, turns, may_fail, most_crossings } = self;
        let turns = match turns {
            Turns::Whole => None,
            Turns::Overlapping => Some("scans and writes in every order unless scans overlap".to_owned()),
            Turns::Free => Some("scans and writes in every order".to_owned()),
        };
        let words = [
            Some(format!("{agents}{who} to {area}")),
            (max_misses > 0).then(|| format!("{max_misses} missed")),
            may_fail.then(|| "all but one may fail".to_owned()),
            (most_crossings == FEW).then(|| format!("crossings counted to {FEW}")),
            turns,
        ];
        words.into_iter().flatten().collect::<Vec<_>>().join(", ")
    }
}

/// The small floors of a check, and what is demanded of every state of the agents on them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(in crate::bricks) struct Floors {
    series: &'static [Series],
    demand: Demand,
}

impl Floors {
    /// BRICKS-2
    pub(super) const CONNECTED: Self = Self { series: &TOGETHER, demand: Demand::Connected };
    /// BRICKS-2, more orders for each floor.
    pub(super) const HELPERS_CONNECTED: Self = Self { series: &HELPING, demand: Demand::Connected };
    /// BRICKS-2, sensors missed.
    pub(super) const CONNECTED_HALF_BLIND: Self = Self { series: &HALF_BLIND, demand: Demand::Connected };
    /// BRICKS-3
    pub(super) const CONNECTED_IN_TURNS: Self = Self { series: &IN_TURNS, demand: Demand::Connected };
    /// BRICKS-3, the smallest areas first.
    pub(super) const CONNECTED_AT_ONCE: Self = Self { series: &AT_ONCE, demand: Demand::Connected };
    /// BRICKS-4
    pub(super) const KNOWING: Self = Self { series: &TOGETHER, demand: Demand::Knowing };
    /// BRICKS-4, more orders for each floor.
    pub(super) const HELPERS_KNOWING: Self = Self { series: &HELPING, demand: Demand::Knowing };
    /// BRICKS-4, sensors missed.
    pub(super) const KNOWING_HALF_BLIND: Self = Self { series: &HALF_BLIND, demand: Demand::Knowing };
    /// BRICKS-5, sensors missed.
    pub(super) const EXPLORES_HALF_BLIND: Self = Self { series: &HALF_BLIND, demand: Demand::Explores };
    /// BRICKS-6
    pub(super) const ENDS: Self = Self { series: &TOGETHER, demand: Demand::Ends };
    /// BRICKS-6, more orders for each floor.
    pub(super) const HELPERS_END: Self = Self { series: &HELPING, demand: Demand::Ends };
    /// BRICKS-6, sensors missed.
    pub(super) const ENDS_HALF_BLIND: Self = Self { series: &HALF_BLIND, demand: Demand::Ends };
    /// BRICKS-8
    pub(super) const WHOLE: Self = Self { series: &TOGETHER, demand: Demand::Whole };
    /// BRICKS-9
    pub(super) const RISING: Self = Self { series: &TOGETHER, demand: Demand::Rising };
    /// BRICKS-10
    pub(super) const BOUNDED: Self = Self { series: &COUNTED, demand: Demand::Bounded };
    /// BRICKS-12
    pub(super) const TWICE: Self = Self { series: &ALONE, demand: Demand::Twice };
    /// BRICKS-4, sensors missed, and counted so far that what goes on for ever comes round.
    pub(super) const KNOWING_ROUND: Self = Self { series: &ROUND, demand: Demand::Knowing };
    /// BRICKS-6, likewise.
    pub(super) const ENDS_ROUND: Self = Self { series: &ROUND, demand: Demand::Ends };
    /// BRICKS-4, three scans being believed.
    pub(super) const KNOWING_AS_SHIPPED: Self = Self { series: &AS_SHIPPED, demand: Demand::Knowing };
    /// BRICKS-6, three scans being believed.
    pub(super) const ENDS_AS_SHIPPED: Self = Self { series: &AS_SHIPPED, demand: Demand::Ends };
    /// BRICKS-6, with one missed more.
    pub(super) const ENDS_SEVEN_MISSED: Self = Self { series: &SEVEN_MISSED, demand: Demand::Ends };
    /// BRICKS-6, with one missed more than [`Floors::ENDS_ROUND`] has.
    pub(super) const ENDS_THRICE_MISSED: Self = Self { series: &THRICE_MISSED, demand: Demand::Ends };
    /// BRICKS-13
    pub(super) const LEAST_ENTERED: Self = Self { series: &TOGETHER, demand: Demand::LeastEntered };
    /// BRICKS-13, as many agents as it takes until one has two children to choose from.
    pub(super) const HELPERS_LEAST_ENTERED: Self = Self { series: &THREE, demand: Demand::LeastEntered };
    /// BRICKS-11
    pub(super) const SURVIVES: Self = Self { series: &FAILING, demand: Demand::Ends };

    /// The same floors with the demands of all clauses that are about them, if these are several.
    fn together(self) -> Option<Self> {
        let is_shared = [&TOGETHER[..], &HELPING, &HALF_BLIND, &ROUND, &AS_SHIPPED].contains(&self.series);
        is_shared.then_some(Self { demand: Demand::All, ..self })
    }

    /// Looks at the states of each plan within `limits`, series by series, until the first violation. Its choices are
    /// the numbers of the series, the plan and the start, then the steps. What is wrong with a mutant is sought in
    /// small areas first.
    fn explore(self, observed: &Observed, (limits, until): (Limits<'_>, Until)) -> Explored {
        let mut explored = Explored::new();
        let mut series: Vec<(u32, &Series)> = (0..).zip(self.series).collect();
        if until == Until::Violation {
            series.sort_by_key(|(_, series)| series.area.cells());
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
        let words: Vec<String> =
            first.chain(self.series.iter().skip(1).map(|series| series.words(""))).collect();
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

/// Nothing missed: one agent alone, two and three in every order.
const TOGETHER: [Series; 5] = [
    Series::new(Area::blocked(4, 4), 1),
    Series::new(Area::walled(3, 3), 1),
    Series::new(Area::walled(3, 2), 2),
    Series::new(Area::blocked(3, 2), 3),
    Series::new(Area::blocked(3, 3), 2),
];

/// The same for those who let all cells join trees, whose states are more.
const HELPING: [Series; 3] = [
    Series::new(Area::blocked(4, 4), 1),
    Series::new(Area::walled(3, 3), 1),
    Series::new(Area::blocked(4, 2), 2),
];

/// Three of them, in areas so small that all their orders can be looked at.
const THREE: [Series; 2] = [Series::new(Area::blocked(2, 2), 3), Series::new(Area::blocked(4, 1), 3)];

/// Sensors missed.
const HALF_BLIND: [Series; 5] = [
    Series::missing(Area::blocked(2, 2), 1, 1),
    Series::missing(Area::blocked(3, 2), 1, 4),
    Series::missing(Area::walled(3, 2), 1, 2),
    Series::missing(Area::blocked(3, 3), 1, 2),
    Series::missing(Area::blocked(3, 2), 2, 1),
];

/// Sensors missed on rings of cells, and crossings counted so far that runs that go on for ever come round.
const ROUND: [Series; 1] = [Series::counting(Area::blocked(3, 3), 1, 2)];

/// As many missed as three scans in a row bear on each layout of this area: six, where two scans bear four.
const AS_SHIPPED: [Series; 1] = [Series::counting(Area::blocked(3, 2), 1, 6)];
const SEVEN_MISSED: [Series; 1] = [Series::counting(Area::blocked(3, 2), 1, 7)];

/// One missed more, the smallest areas first.
const THRICE_MISSED: [Series; 3] = [
    Series::counting(Area::blocked(3, 1), 1, 3),
    Series::counting(Area::blocked(2, 2), 1, 3),
    Series::counting(Area::blocked(3, 2), 1, 3),
];

/// Moves of one agent are counted.
const ALONE: [Series; 3] = [
    Series::new(Area::blocked(3, 3), 1),
    Series::new(Area::walled(3, 3), 1),
    Series::new(Area::blocked(4, 4), 1),
];

/// Scanning and writing are two steps.
const IN_TURNS: [Series; 1] = [Series::taking_turns(Area::blocked(5, 2))];

/// The same for those who do not take turns, the smallest areas first. They may go on for ever.
const AT_ONCE: [Series; 2] = [
    Series { most_crossings: FEW, ..Series::taking_turns(Area::blocked(2, 1)) },
    Series { most_crossings: FEW, ..Series::taking_turns(Area::blocked(3, 1)) },
];

/// Moves are counted.
const COUNTED: [Series; 3] = [
    Series::new(Area::blocked(4, 4), 1),
    Series::new(Area::walled(3, 3), 1),
    Series::new(Area::walled(3, 2), 2),
];

/// Agents fail.
const FAILING: [Series; 2] =
    [Series::failing(Area::blocked(3, 2), 3), Series::failing(Area::blocked(4, 2), 2)];

#[cfg(test)]
mod tests {
    use tautline_kernel::bricks::tree::Rule;

    use super::*;
    use crate::engine::states::search;

    #[test]
    #[ignore = "takes minutes: cargo test --release -p tautline-proofs --lib -- --ignored --nocapture trees"]
    fn trees_hold_on_larger_floors() {
        let larger = [
            (Rule::TREE, Series::new(Area::blocked(4, 3), 2)),
            (Rule::HELPERS, Series::new(Area::blocked(3, 3), 2)),
            (Rule::HELPERS, Series::new(Area::blocked(3, 2), 3)),
            (Rule::ROBUST, Series::missing(Area::blocked(3, 3), 2, 1)),
        ];
        for (rule, series) in larger {
            let teams = series.teams(&Observed::following(rule), Demand::All);
            let (mut states, mut most) = (0, 0);
            for team in &teams {
                let found = search(team, team.starts(series.agents), Limits::NONE);
                assert!(found.is_whole && found.broken.is_empty(), "{series:?}");
                states += found.states;
                most = most.max(found.bytes);
            }
            println!("{rule:?}, {}: {states} states, at most {} MiB", series.words(" agents"), most >> 20);
        }
    }
}
