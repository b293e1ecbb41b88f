//! The graph of the states that were met, with nothing of what they are: how each was first found, and where endless
//! runs are looked for, what is owed in it and which steps are bound to be made from it.

use std::ops::Range;

use super::Bits;
use super::tables::Pile;

/// The states that were met, in the order in which they were.
pub(super) struct Graph {
    /// The numbers of the starts that were new, which are the first nodes.
    starts: Vec<u32>,
    /// From which node each was first found; of a start nothing is to be said.
    from: Pile<u32>,
    /// Whether endless runs are looked for.
    keeps_arcs: bool,
    pub(super) owed: Pile<Bits>,
    /// Of each node that is gone on from, where its arcs begin.
    first_arc: Pile<u32>,
    arcs: Pile<Arc>,
    /// How many nodes, and how many that are gone on from, stand on disk.
    on_disk: (usize, usize),
}

/// A step that is bound to be made.
#[derive(Clone, Copy)]
#[repr(C, packed(2))]
pub(super) struct Arc {
    pub(super) to: u32,
    pub(super) acting: Bits,
}

impl Graph {
    pub(super) const fn new(keeps_arcs: bool) -> Self {
        Self {
            starts: Vec::new(),
            from: Pile::new(),
            keeps_arcs,
            owed: Pile::new(),
            first_arc: Pile::new(),
            arcs: Pile::new(),
            on_disk: (0, 0),
        }
    }

    /// All that was added since the last time, as numbers.
    pub(super) fn added(&self) -> impl Iterator<Item = u64> {
        let (nodes, gone_on) = (self.on_disk.0..self.len(), self.on_disk.1..self.first_arc.len());
        let counts = [self.starts.len(), nodes.len(), gone_on.len()].map(|count| count as u64);
        let starts = self.starts.iter().map(|&start| start.into());
        let from = nodes.map(|node| self.from.at(node).into());
        let steps = gone_on.flat_map(|node| {
            let arcs = self.arcs(node).flat_map(|Arc { to, acting }| [to.into(), acting.into()]);
            [self.owed.at(node).into(), self.arcs(node).count() as u64].into_iter().chain(arcs)
        });
        counts.into_iter().chain(starts).chain(from).chain(steps)
    }

    /// All that was added stands on disk.
    pub(super) const fn is_on_disk(&mut self) {
        self.on_disk = (self.len(), self.first_arc.len());
    }

    /// Adds what was added once, from its numbers.
    pub(super) fn add_again<E>(&mut self, mut next: impl FnMut() -> Result<u64, E>) -> Result<(), E> {
        let [starts, nodes, gone_on] = [next()?, next()?, next()?];
        self.starts.clear();
        for _ in 0..starts {
            self.starts.push(next()? as u32);
        }
        for _ in 0..nodes {
            self.from.push(next()? as u32);
        }
        for _ in 0..gone_on {
            let (owed, arcs) = (next()? as Bits, next()?);
            self.go_on(|| owed);
            for _ in 0..arcs {
                self.add_arc(Arc { to: next()? as u32, acting: next()? as Bits });
            }
        }
        self.is_on_disk();
        Ok(())
    }

    /// The number of nodes.
    pub(super) const fn len(&self) -> usize {
        self.from.len()
    }

    /// Each node in its order, and the fewest steps to it.
    pub(super) fn depths(&self) -> impl Iterator<Item = (usize, usize)> {
        let mut level = (0, 0);
        (0..self.len()).map(move |node| {
            if node >= self.starts.len() && self.from.at(node) as usize >= level.0 {
                level = (node, 1 + level.1);
            }
            (node, level.1)
        })
    }

    pub(super) fn bytes(&self) -> u64 {
        let starts = self.starts.capacity() * size_of::<u32>();
        starts as u64 + self.from.bytes() + self.owed.bytes() + self.first_arc.bytes() + self.arcs.bytes()
    }

    /// Whether it has as many nodes or arcs as it can number.
    pub(super) const fn is_full(&self) -> bool {
        self.from.len() >= MOST || self.arcs.len() >= MOST
    }

    /// Adds the start with this number.
    pub(super) fn add_start(&mut self, start: u32) {
        self.starts.push(start);
        self.from.push(0);
    }

    /// Adds a node that was first found by a step from another.
    pub(super) fn add(&mut self, from: u32) {
        self.from.push(from);
    }

    /// The next node is gone on from, in which this is owed.
    pub(super) fn go_on(&mut self, owed: impl FnOnce() -> Bits) {
        if self.keeps_arcs {
            self.owed.push(owed());
            self.first_arc.push(self.arcs.len() as u32);
        }
    }

    /// Adds a step from the node that is gone on from.
    pub(super) fn add_arc(&mut self, arc: Arc) {
        if self.keeps_arcs {
            self.arcs.push(arc);
        }
    }

    /// The steps from a node that are bound to be made.
    pub(super) fn arcs(&self, node: usize) -> impl Iterator<Item = Arc> {
        (self.first_arc.at(node)..self.end(node)).map(|arc| self.arcs.at(arc as usize))
    }

    /// The step with this number among those from a node that are bound to be made.
    pub(super) fn arc(&self, node: usize, number: u32) -> Option<Arc> {
        let arc = self.first_arc.at(node) + number;
        (arc < self.end(node)).then(|| self.arcs.at(arc as usize))
    }

    fn end(&self, node: usize) -> u32 {
        if node + 1 < self.first_arc.len() { self.first_arc.at(node + 1) } else { self.arcs.len() as u32 }
    }

    /// The nodes that were first found from these.
    pub(super) fn found_from(&self, nodes: &Range<usize>) -> Range<usize> {
        let after = |node: usize| {
            let (mut first, mut last) = (self.starts.len(), self.len());
            while first < last {
                let middle = first.midpoint(last);
                if (self.from.at(middle) as usize) < node { first = middle + 1 } else { last = middle }
            }
            first
        };
        after(nodes.start)..after(nodes.end)
    }

    /// The number of the start of the way that first led to a node, and the nodes on it, the start's first.
    pub(super) fn way(&self, mut node: usize) -> (usize, Vec<usize>) {
        let mut way = vec![node];
        while node >= self.starts.len() {
            node = self.from.at(node) as usize;
            way.push(node);
        }
        way.reverse();
        (self.starts[node] as usize, way)
    }
}

/// Nodes and arcs are numbered in four bytes.
const MOST: usize = u32::MAX as usize - 1;
