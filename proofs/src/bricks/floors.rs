//! The small floors of the checks of Brick&Mortar, of agents that mark cells and of those that search in trees: which
//! plans, how many agents, and what they miss.

use crate::floor::plans::Area;
use crate::floor::team::Series;

/// Some sensors missed; no agent acts more than twice while another waits.
const fn missing(area: Area, agents: u32, max_misses: u8) -> Series {
    Series { max_streak: Some(2), ..Series::missing(area, agents, max_misses) }
}

/// Idle moves before an agent goes round where it is to go to least crossed cells for a while: few, so that it does
/// both in small layouts. Elsewhere it has no patience: what it gains before can only come earlier.
const PATIENT: u8 = 2;

/// Patient agents, which read the crossings of cells: they count up without end where an agent is kept from acting, so
/// no agent acts more than twice while another waits.
const fn patient(area: Area, agents: u32, max_misses: u8) -> Series {
    Series { patience: PATIENT, ..missing(area, agents, max_misses) }
}

/// How far sensors count crossings where an agent is to go on for ever: an agent reads which of two counts is less.
const FEW: Option<u32> = Some(3);

/// One agent, some sensors missed, and no more than a few crossings counted.
const fn counting(area: Area, max_misses: u8) -> Series {
    Series { most_crossings: FEW, ..Series::missing(area, 1, max_misses) }
}

/// Nothing missed: one agent alone, two and three in every order; patient ones last, since what is wrong with a rule
/// may let them go on without end.
pub(super) const TOGETHER: [Series; 7] = [
    Series::new(Area::blocked(4, 4), 1),
    Series::new(Area::walled(3, 3), 1),
    Series::new(Area::walled(3, 2), 2),
    Series::new(Area::blocked(3, 2), 3),
    Series::new(Area::blocked(3, 3), 2),
    patient(Area::blocked(4, 3), 1, 0),
    patient(Area::blocked(4, 2), 2, 0),
];

/// One agent alone, nothing missed.
pub(super) const ALONE: [Series; 1] = [Series::new(Area::blocked(4, 4), 1)];

/// Two agents in three cells, the fewest in which one shuts the other in.
pub(super) const PAIR: Series = Series::new(Area::blocked(3, 1), 2);

/// Those floors with a missed sensor.
pub(super) const HALF_BLIND_PAIR: Series = pair_of(Series::missing(Area::blocked(3, 1), 1, 1));

/// Two agents in three cells, else as in another series.
pub(super) const fn pair_of(series: Series) -> Series {
    Series { area: Area::blocked(3, 1), agents: 2, ..series }
}

/// One agent in six cells, round one of whose walls it can go for ever.
pub(super) const BEHIND_A_WALL: Series = Series::new(Area::walled(3, 2), 1);

/// One agent in ten cells, the fewest in which it goes round walls for ever and leaves a cell unexplored.
pub(super) const ROUND_WALLS: Series = Series::new(Area::walled(5, 2), 1);

/// One agent in fifteen cells, the fewest in which it does so round blocked ones.
pub(super) const ROUND_BLOCKED: [Series; 1] = [Series::new(Area::blocked(5, 3), 1)];

/// Two agents in the only cell, of which one may fail.
pub(super) const IN_ONE_CELL: Series = Series::failing(Area::blocked(1, 1), 2);

/// Sensors missed; small areas first and patient agents last, as in [`TOGETHER`].
pub(super) const HALF_BLIND: [Series; 7] = [
    missing(Area::blocked(3, 2), 1, 4),
    missing(Area::walled(3, 2), 1, 2),
    missing(Area::blocked(3, 3), 1, 2),
    missing(Area::blocked(3, 2), 2, 1),
    patient(Area::blocked(3, 3), 1, 1),
    patient(Area::blocked(3, 2), 1, 2),
    patient(Area::blocked(2, 2), 2, 1),
];

/// Scanning and writing are two steps.
pub(super) const IN_TURNS: [Series; 1] = [Series::taking_turns(Area::blocked(5, 2))];

/// Agents fail, the smallest areas first.
pub(super) const FAILING: [Series; 3] = [
    Series::failing(Area::blocked(2, 1), 2),
    Series::failing(Area::blocked(3, 1), 2),
    Series::failing(Area::blocked(2, 2), 2),
];

/// Nothing missed, and all gone over twice.
pub(super) const TWICE: [Series; 6] = [
    Series::new(Area::blocked(4, 3), 1),
    Series::new(Area::walled(3, 3), 1),
    Series::new(Area::walled(3, 2), 2),
    Series::new(Area::blocked(4, 2), 2),
    patient(Area::blocked(4, 3), 1, 0),
    patient(Area::blocked(3, 2), 2, 0),
];

/// Nothing missed in trees: one agent alone, two and three in every order.
pub(super) const TREES: [Series; 5] = [
    Series::new(Area::blocked(4, 4), 1),
    Series::new(Area::walled(3, 3), 1),
    Series::new(Area::walled(3, 2), 2),
    Series::new(Area::blocked(3, 2), 3),
    Series::new(Area::blocked(3, 3), 2),
];

/// Nothing missed by agents that let all cells join trees, whose states are more.
pub(super) const HELPING: [Series; 3] = [
    Series::new(Area::blocked(4, 4), 1),
    Series::new(Area::walled(3, 3), 1),
    Series::new(Area::blocked(4, 2), 2),
];

/// As many agents as it takes until one has two children to choose from, in areas so small that all their orders can be
/// looked at.
pub(super) const THREE: [Series; 2] =
    [Series::new(Area::blocked(2, 2), 3), Series::new(Area::blocked(4, 1), 3)];

/// Sensors missed in trees.
pub(super) const TREES_HALF_BLIND: [Series; 5] = [
    Series::missing(Area::blocked(2, 2), 1, 1),
    Series::missing(Area::blocked(3, 2), 1, 4),
    Series::missing(Area::walled(3, 2), 1, 2),
    Series::missing(Area::blocked(3, 3), 1, 2),
    Series::missing(Area::blocked(3, 2), 2, 1),
];

/// Sensors missed on rings of cells, and crossings counted so far that runs that go on for ever come round.
pub(super) const ROUND: [Series; 1] = [counting(Area::blocked(3, 3), 2)];

/// As many missed as three scans in a row bear on each layout of this area: six, where two scans bear four.
pub(super) const AS_SHIPPED: [Series; 1] = [counting(Area::blocked(3, 2), 6)];
/// One missed more than in [`AS_SHIPPED`].
pub(super) const SEVEN_MISSED: [Series; 1] = [counting(Area::blocked(3, 2), 7)];

/// One missed more than in [`ROUND`], the smallest areas first.
pub(super) const THRICE_MISSED: [Series; 3] =
    [counting(Area::blocked(3, 1), 3), counting(Area::blocked(2, 2), 3), counting(Area::blocked(3, 2), 3)];

/// Moves of one agent are counted.
pub(super) const ONE_COUNTED: [Series; 3] = [
    Series::new(Area::blocked(3, 3), 1),
    Series::new(Area::walled(3, 3), 1),
    Series::new(Area::blocked(4, 4), 1),
];

/// Moves are counted.
pub(super) const COUNTED: [Series; 3] = [
    Series::new(Area::blocked(4, 4), 1),
    Series::new(Area::walled(3, 3), 1),
    Series::new(Area::walled(3, 2), 2),
];

/// Agents beside each other act at once, the smallest areas first. They may go on for ever.
pub(super) const AT_ONCE: [Series; 2] = [
    Series { most_crossings: FEW, ..Series::taking_turns(Area::blocked(2, 1)) },
    Series { most_crossings: FEW, ..Series::taking_turns(Area::blocked(3, 1)) },
];

/// Agents fail that search in trees.
pub(super) const TREES_FAILING: [Series; 2] =
    [Series::failing(Area::blocked(3, 2), 3), Series::failing(Area::blocked(4, 2), 2)];

#[cfg(test)]
mod tests {
    use tautline_kernel::bricks::tree::Rule;

    use super::*;
    use crate::engine::states::{Limits, search};
    use crate::floor::series::Subject;
    use crate::floor::team::Demand;

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
            let (mut states, mut most) = (0, 0);
            for team in &series.teams(&Subject::of(rule), Demand::All) {
                let found = search(team, team.starts(), Limits::NONE);
                assert!(found.is_whole && found.broken.is_empty(), "{series:?}");
                states += found.states;
                most = most.max(found.bytes);
            }
            println!("{rule:?}, {}: {states} states, at most {} MiB", series.words(" agents"), most >> 20);
        }
    }
}
