//! An exhausted search, written down: the states as a tree, from each its steps, and where endless runs are
//! looked for, ranks. No step that is bound to be made and owes the same thing leads to a higher rank, and among states
//! of one rank somebody is awake throughout who does not act.

use std::cmp::Reverse;
use std::fmt;
use std::ops::{ControlFlow, Range};

use rustc_hash::FxHashMap;
use tautline_certificates::{Counts, Model, Refusal, check_states, put};

use super::graph::Graph;
use super::limits::{Limits, MemoryLimit, MemoryShare};
use super::rounds::{NONE, TooLarge};
use super::search::{Search, search};
use super::{Bits, Scratch, System};
use crate::engine::model::{LOST, StatesModel};

/// Why there is no certificate.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NoCertificate {
    /// The search breaks something.
    Broken,
    /// It is not whole.
    Unfinished,
    /// A step was made again and led to another state.
    Unrepeatable,
    /// The bytes of a state leave something of it out.
    Lost,
}

impl fmt::Display for NoCertificate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Broken => "its search finds something broken",
            Self::Unfinished => "its search did not come to its end",
            Self::Unrepeatable => "from one state a step led to two",
            Self::Lost => LOST,
        })
    }
}

impl From<TooLarge> for NoCertificate {
    fn from(_: TooLarge) -> Self {
        Self::Unfinished
    }
}

/// A system whose states or runs are all searched, whatever its type.
pub trait AnySystem: Sync {
    /// Its states or runs as a section of a certificate, and how many states it has.
    ///
    /// # Errors
    /// [`NoCertificate`] if a search within `limits` does not exhaust it, or finds something broken.
    fn exhausted(&self, limits: Limits<'_>) -> Result<(Vec<u8>, u64), NoCertificate>;

    /// Checks such a section in a file of this digest.
    ///
    /// # Errors
    /// [`Refusal`] if it does not show that nothing is broken.
    fn check(&self, section: &[u8], digest: u128) -> Result<Counts, Refusal>;

    /// The number of states that a search within `limits` finds.
    fn search(&self, limits: Limits<'_>) -> u64;
}

impl<S> AnySystem for StatesModel<S>
where
    S: System + Sync,
    S::State: Send,
{
    fn exhausted(&self, limits: Limits<'_>) -> Result<(Vec<u8>, u64), NoCertificate> {
        let (system, starts) = (&self.system, (self.starts)(&self.system));
        // All states are gone through in any order.
        let mut search = Search::new(system, Limits { memory: limits.memory.in_memory(), ..limits });
        let unwatched = &mut |_| ControlFlow::Continue(());
        let found = search.run_from(&mut starts.iter().cloned(), limits.most_steps, unwatched);
        if found.broken.iter().any(|run| (self.is_asked)(system, run.demand)) {
            return Err(NoCertificate::Broken);
        }
        if !found.is_whole || found.looked_at < found.states {
            return Err(NoCertificate::Unfinished);
        }
        let section = search.section(starts, |state| match self.owed(state) {
            0 => (0, 0),
            owed => (owed, system.awake(state)),
        })?;
        Ok((section, found.states))
    }

    fn check(&self, section: &[u8], digest: u128) -> Result<Counts, Refusal> {
        check_states(self, section, digest)
    }

    fn search(&self, limits: Limits<'_>) -> u64 {
        search(&self.system, (self.starts)(&self.system), limits).states
    }
}

impl<S: System> Search<'_, S> {
    /// The section, once all states are known. `duties` are what is owed in a state, and who is awake.
    fn section(
        &mut self,
        starts: Vec<S::State>,
        duties: impl Fn(&S::State) -> (Bits, Bits),
    ) -> Result<Vec<u8>, NoCertificate> {
        let mut links = Links::new(self.graph.len());
        for mut state in starts {
            links.add(self.node(&mut state)?);
        }
        let (mut all_owed, mut awake, mut scratch) = (0, Vec::new(), Scratch::default());
        for node in 0..self.graph.len() {
            links.first.push(links.to.len());
            let shown = self.show(node).ok_or(NoCertificate::Unrepeatable)?;
            let (owed, is_awake) = duties(&shown.state);
            all_owed |= owed;
            awake.push(is_awake);
            let flow = self.system.each_step(&shown.state, &mut scratch, |step| {
                let added = self.node(step.state).map(|node| links.add(node));
                added.map_or_else(ControlFlow::Break, ControlFlow::Continue)
            });
            flow.break_value().map_or(Ok(()), Err)?;
            self.shown = Some(shown);
        }
        links.first.push(links.to.len());
        let ranks = bits(all_owed).map(|owed| ranks(&self.graph, owed, &awake));
        Ok(links.section(all_owed, &ranks.collect::<Result<Vec<_>, TooLarge>>()?))
    }

    /// The number of a state that is known.
    fn node(&mut self, state: &mut S::State) -> Result<u32, NoCertificate> {
        self.system.make_canonical(state);
        if self.system.is_lost(state) {
            return Err(NoCertificate::Lost);
        }
        self.known.find(self.system, state).ok_or(NoCertificate::Unrepeatable)
    }
}

/// The rank of each node of a graph in which `owed` is owed. Of a component of several steps it is its level, the
/// longest way through components to the last ones, and who is awake throughout and does not act.
fn ranks(graph: &Graph, owed: Bits, awake: &[Bits]) -> Result<Vec<u32>, TooLarge> {
    let part = graph.components(owed, &mut MemoryShare::new(MemoryLimit::any()))?;
    let mut nodes: Vec<usize> = (0..part.len()).filter(|&node| part[node] != NONE).collect();
    // Steps lead to components that were numbered before, from above.
    nodes.sort_unstable_by_key(|&node| Reverse(part[node]));
    let mut ranks = vec![0; part.len()];
    for component in nodes.chunk_by(|&one, &other| part[one] == part[other]) {
        let (mut level, mut acting, mut is_awake, mut has_steps) = (0, 0, Bits::MAX, false);
        for &node in component {
            is_awake &= awake[node];
            for arc in graph.arcs(node).filter(|arc| part[arc.to as usize] != NONE) {
                let to = arc.to as usize;
                if part[to] == part[node] {
                    (acting, has_steps) = (acting | arc.acting, true);
                } else {
                    level = level.max(1 + ranks[to] / RANKS);
                }
            }
        }
        let idle = if has_steps { (is_awake & !acting).trailing_zeros() } else { 0 };
        for &node in component {
            ranks[node] = level * RANKS + idle;
        }
    }
    let mut all: Vec<u32> = ranks.clone();
    all.sort_unstable();
    all.dedup();
    let dense: FxHashMap<u32, u32> = all.into_iter().zip(0..).collect();
    for rank in &mut ranks {
        *rank = dense[rank];
    }
    Ok(ranks)
}

/// Ranks of one level.
const RANKS: u32 = Bits::BITS;

/// These bits, each alone.
fn bits(set: Bits) -> impl Iterator<Item = Bits> {
    (0..Bits::BITS).map(|bit| 1 << bit).filter(move |bit| set & bit != 0)
}

/// The nodes to which the starts and then all steps lead.
struct Links {
    to: Vec<u32>,
    /// Of each node the number of its first link.
    first: Vec<usize>,
    /// Of each node the link by which it was met first.
    met_by: Vec<usize>,
}

impl Links {
    fn new(nodes: usize) -> Self {
        Self { to: Vec::new(), first: Vec::new(), met_by: vec![usize::MAX; nodes] }
    }

    fn add(&mut self, to: u32) {
        let met_by = &mut self.met_by[to as usize];
        *met_by = (*met_by).min(self.to.len());
        self.to.push(to);
    }

    /// These links, each with its node, and whether the node was met first by it.
    fn among(&self, links: Range<usize>) -> impl DoubleEndedIterator<Item = (usize, bool)> {
        links.map(|link| (self.to[link] as usize, self.met_by[self.to[link] as usize] == link))
    }

    fn of(&self, node: usize) -> impl DoubleEndedIterator<Item = (usize, bool)> {
        self.among(self.first[node]..self.first[node + 1])
    }

    /// The section with these ranks of each obligation.
    fn section(&self, owed: Bits, ranks: &[Vec<u32>]) -> Vec<u8> {
        let new = |(to, is_new): (usize, bool)| is_new.then_some(to);
        let starts = || self.among(0..self.first.first().copied().unwrap_or(0));
        let mut ahead: Vec<usize> = starts().rev().filter_map(new).collect();
        let (mut nodes, mut place) = (Vec::new(), vec![0_i64; self.met_by.len()]);
        while let Some(node) = ahead.pop() {
            place[node] = nodes.len() as i64;
            nodes.push(node);
            ahead.extend(self.of(node).rev().filter_map(new));
        }
        let mut section = Vec::new();
        put(&mut section, owed.into());
        put(&mut section, starts().count() as u64);
        for (to, is_new) in starts() {
            put(&mut section, if is_new { 0 } else { 1 + place[to] as u64 });
        }
        for node in nodes {
            put(&mut section, self.of(node).count() as u64);
            for (to, is_new) in self.of(node) {
                let way = place[to] - place[node];
                put(&mut section, if is_new { 0 } else { 1 + (way << 1 ^ way >> 63) as u64 });
            }
            for ranks in ranks {
                put(&mut section, ranks[node].into());
            }
        }
        section
    }
}
