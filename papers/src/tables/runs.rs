//! Jobs that are runs at the points that a table varies, and their results by point.

use serde::{Deserialize, Serialize};

/// A run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Run<P> {
    /// Where it is among what the table varies.
    pub(super) at: P,
    /// Its number among the runs there, from 0.
    pub(super) number: u32,
}

impl<P> Run<P> {
    /// Its seed, where `first` is that of the first run.
    pub(super) fn seed(&self, first: u64) -> u64 {
        first.wrapping_add(self.number.into())
    }
}

/// As many runs as `count` says at each point.
pub(super) fn runs<P: Copy>(points: impl IntoIterator<Item = P>, count: impl Fn(P) -> u32) -> Vec<Run<P>> {
    points.into_iter().flat_map(|at| (0..count(at)).map(move |number| Run { at, number })).collect()
}

/// The pairs of two settings, the second one varied first.
pub(super) fn pairs<A: Copy, B: Copy>(
    these: impl IntoIterator<Item = A>,
    those: impl IntoIterator<Item = B> + Clone,
) -> impl Iterator<Item = (A, B)> {
    these.into_iter().flat_map(move |this| those.clone().into_iter().map(move |that| (this, that)))
}

/// The results of the runs at one point.
pub(super) fn at<P: Copy + PartialEq, M>(results: &[(Run<P>, M)], point: P) -> Vec<&M> {
    results.iter().filter(|(run, _)| run.at == point).map(|(_, measured)| measured).collect()
}

/// The results of the runs at one point, team by team, where each run has a result for every team.
pub(super) fn of_teams<P: Copy + PartialEq, M, const TEAMS: usize>(
    results: &[(Run<P>, [M; TEAMS])],
    point: P,
) -> [Vec<&M>; TEAMS] {
    let here = at(results, point);
    std::array::from_fn(|team| here.iter().map(|outcomes| &outcomes[team]).collect())
}
