//! The search on graphs that one can look at.

use tautline_kernel::choice::Oracle;

use super::super::{Bits, MemoryLimit};
use super::*;
use crate::engine::world::{Turn, World};

/// An arc of a graph that one can look at: where it leads, and who acts.
type SketchArc = (usize, Bits);

/// Such a graph, and the demands on it. Node 0 is the start.
struct Graphic {
    arcs: &'static [&'static [SketchArc]],
    /// No step leads there.
    forbidden: usize,
    /// No run ends there.
    dead: usize,
    /// Where something is owed.
    owing: &'static [usize],
    /// Whom nothing but their own acts puts to sleep.
    awake: Bits,
    /// Whether one demand is enough.
    is_enough: bool,
}

const STEP: &str = "a step";
const ROUND: &str = "no run owes something for ever";

impl World for Graphic {
    type State = usize;
    type Plan = &'static [SketchArc];
    type Event = SketchArc;
    type Demand = &'static str;

    fn plan(&self, &mut node: &mut usize, _: &[u8]) -> Option<&'static [SketchArc]> {
        Some(self.arcs[node]).filter(|arcs| !arcs.is_empty())
    }

    fn settle(
        &self,
        node: &mut usize,
        arcs: &&'static [SketchArc],
        _: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> SketchArc {
        let arc = arcs[world.pick(arcs.len() as u32) as usize];
        *node = arc.0;
        arc
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<&'static str> {
        if *turn.after == self.forbidden { vec!["not there"] } else { Vec::new() }
    }

    fn broken_at_end(&self, &node: &usize, _: &[u8]) -> Vec<&'static str> {
        if node == self.dead { vec!["no end there", "no end at all"] } else { Vec::new() }
    }

    fn covers(&self) -> Vec<&'static str> {
        vec![STEP]
    }

    fn occurs(&self, _: &Turn<'_, Self>) -> u64 {
        1
    }
}

impl System for Graphic {
    type Part = usize;

    fn part(&self, &node: &usize, _: usize) -> usize {
        node
    }

    fn put(&self, state: &mut usize, _: usize, &node: &usize) {
        *state = node;
    }

    fn acting(&self, turn: &Turn<'_, Self>) -> Bits {
        turn.event.1
    }

    fn is_bound(&self, turn: &Turn<'_, Self>) -> bool {
        turn.event.1 != 0
    }

    fn broken_by_endless_runs(&self) -> Option<&'static str> {
        Some(ROUND)
    }

    fn owed(&self, node: &usize) -> Bits {
        self.owing.contains(node).into()
    }

    fn awake(&self, _: &usize) -> Bits {
        self.awake
    }

    fn is_enough(&self, _: &'static str) -> bool {
        self.is_enough
    }
}

const NOWHERE: usize = 99;

/// 0, 1 and 2 go round, and so do 3 and 4, and 6; a fault leads from 5 to 6. A second agent acts only between 0 and 2.
const GRAPH: Graphic = Graphic {
    arcs: &[&[(1, 1)], &[(2, 1), (3, 1)], &[(0, 2)], &[(4, 1)], &[(3, 1), (5, 1)], &[(6, 0)], &[(6, 1)]],
    forbidden: NOWHERE,
    dead: NOWHERE,
    owing: &[],
    awake: 0,
    is_enough: true,
};

fn found(graph: &Graphic) -> Findings<&'static str> {
    search(graph, [0], Limits::NONE)
}

fn broken(graph: &Graphic) -> Option<Run<&'static str>> {
    found(graph).broken.pop()
}

#[test]
fn every_state_is_looked_at_once() {
    let bytes = found(&GRAPH).bytes;
    let all = Findings {
        states: 7,
        looked_at: 7,
        steps: 9,
        bytes,
        is_whole: true,
        is_shortest: true,
        covered: vec![STEP],
        broken: Vec::new(),
    };
    assert_eq!(found(&GRAPH), all);
    assert_eq!(search(&GRAPH, [0, 3, 0], Limits::steps(9)), all);
}

#[test]
fn a_search_stops_at_the_most_steps() {
    let some = search(&GRAPH, [0], Limits::steps(4));
    assert_eq!((some.states, some.looked_at, some.steps, some.is_whole), (4, 4, 4, false));
}

#[test]
fn whoever_watches_a_search_hears_of_each_state_and_may_end_it() {
    let mut heard = Vec::new();
    let mut watch = |looked_at| {
        heard.push(looked_at);
        if looked_at == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let some = watched(&GRAPH, [0], Limits::NONE, &mut watch);
    assert_eq!((some.looked_at, some.is_whole, heard), (2, false, vec![1, 2, 3]));
}

#[test]
fn a_shortest_run_comes_from_the_nearest_start() {
    let graph = Graphic { forbidden: 5, ..GRAPH };
    let run = |start, steps| Run { demand: "not there", start, steps, ending: Ending::There };
    assert_eq!(broken(&graph), Some(run(0, vec![0, 1, 0, 1])));
    assert_eq!(search(&graph, [0, 3], Limits::NONE).broken, [run(1, vec![0, 1])]);
}

#[test]
fn a_run_ends_where_no_step_is_bound_to_be_made() {
    let run = Run { demand: "no end there", start: 0, steps: vec![0, 1, 0, 1], ending: Ending::Still };
    assert_eq!(broken(&Graphic { dead: 5, ..GRAPH }), Some(run));
    assert_eq!(broken(&Graphic { dead: 4, ..GRAPH }), None);
}

/// The step to 1 is forbidden, and all runs make it first.
#[test]
fn a_demand_that_is_broken_first_hides_none_of_the_others() {
    let alone = |graph: Graphic| broken(&Graphic { is_enough: true, ..graph }).expect("it is broken");
    let (forbidden, dead, owing) = (1, 5, &[6]);
    let all = Graphic { forbidden, dead, owing, is_enough: false, ..GRAPH };
    let step = alone(Graphic { forbidden, ..GRAPH });
    let end = alone(Graphic { dead, ..GRAPH });
    let other_end = Run { demand: "no end at all", ..end.clone() };
    let round = alone(Graphic { owing, ..GRAPH });
    assert_eq!(found(&all).broken, [step, end, other_end, round]);
}

#[test]
fn an_endless_run_goes_round_where_something_is_owed_throughout() {
    let round = |steps, round| Run { demand: ROUND, start: 0, steps, ending: Ending::Round(round) };
    let owing = |owing| Graphic { owing, ..GRAPH };
    assert_eq!(broken(&owing(&[0, 2, 3, 5])), None);
    assert_eq!(broken(&owing(&[0, 1, 2, 3, 4])), Some(round(vec![], vec![0, 0, 0])));
    assert_eq!(broken(&owing(&[0, 3, 4, 6])), Some(round(vec![0, 1], vec![0, 0])));
    assert_eq!(broken(&owing(&[5, 6])), Some(round(vec![0, 1, 0, 1, 0], vec![0])));
}

#[test]
fn an_endless_run_keeps_nobody_from_acting() {
    let owing = &[1, 2, 3, 4, 5, 6];
    assert_eq!(broken(&Graphic { awake: 3, owing, ..GRAPH }), None);
    let round = |steps, round| Run { demand: ROUND, start: 0, steps, ending: Ending::Round(round) };
    assert_eq!(broken(&Graphic { awake: 1, owing, ..GRAPH }), Some(round(vec![0, 1], vec![0, 0])));
    let owing = &[0, 1, 2];
    assert_eq!(broken(&Graphic { awake: 3, owing, ..GRAPH }), Some(round(vec![], vec![0, 0, 0])));
}

#[test]
fn everybody_who_is_awake_acts_in_a_round() {
    const SHARED: &[&[SketchArc]] = &[&[(0, 1), (1, 2)], &[(0, 2)]];
    const FAR: &[&[SketchArc]] = &[&[(0, 1), (1, 1)], &[(1, 2), (2, 1), (0, 1)], &[(1, 1), (2, 4)]];
    let round = |awake, arcs| {
        let found = broken(&Graphic { awake, arcs, owing: &[0, 1, 2], ..GRAPH });
        found.map(|run| run.ending)
    };
    assert_eq!(round(1, SHARED), Some(Ending::Round(vec![0])));
    assert_eq!(round(3, SHARED), Some(Ending::Round(vec![0, 1, 0])));
    assert_eq!(round(1, FAR), Some(Ending::Round(vec![0])));
    assert_eq!(round(3, FAR), Some(Ending::Round(vec![1, 0, 2])));
    assert_eq!(round(7, FAR), Some(Ending::Round(vec![0, 1, 1, 0])));
    assert_eq!(round(15, FAR), None);
}

#[test]
fn a_search_that_would_take_too_much_memory_is_not_whole() {
    let all = found(&GRAPH);
    let in_room =
        |bytes| search(&GRAPH, [0], Limits { memory: MemoryLimit::of(bytes, 1).memory(), ..Limits::NONE });
    assert_eq!(in_room(2 * all.bytes), all);
    let cut_off = in_room(8);
    assert_eq!((cut_off.is_whole, cut_off.looked_at, cut_off.broken), (false, 0, vec![]));
    // The states have room, and the search for rounds has not.
    let owing = Graphic { owing: &[3, 4], ..GRAPH };
    let all = found(&owing);
    assert!(all.is_whole && all.broken.len() == 1);
    let cut_off = search(
        &owing,
        [0],
        Limits { memory: MemoryLimit::of(all.bytes * 4 / 3 - 4, 1).memory(), ..Limits::NONE },
    );
    assert_eq!((cut_off.is_whole, cut_off.looked_at, cut_off.broken), (false, 7, vec![]));
}

/// From 0 a fault and then a step to 1 and back.
#[test]
fn the_steps_of_a_round_are_numbered_among_all_steps() {
    const FAULTY: &[&[SketchArc]] = &[&[(2, 0), (1, 1)], &[(2, 0), (2, 0), (0, 1)], &[]];
    let round = broken(&Graphic { arcs: FAULTY, owing: &[0, 1], ..GRAPH });
    assert_eq!(round.map(|run| run.ending), Some(Ending::Round(vec![1, 2])));
}

/// A binary tree in an array. One part of a node is its own, others are those of many, and from each leaf a step leads
/// back to the middle.
struct Heap {
    nodes: u32,
    forbidden: u32,
    is_enough: bool,
}

impl World for Heap {
    type State = [u32; 3];
    type Plan = [u32; 2];
    type Event = ();
    type Demand = &'static str;

    fn plan(&self, &mut [node, ..]: &mut [u32; 3], _: &[u8]) -> Option<[u32; 2]> {
        Some([1, 2].map(|child| (2 * node + child) % self.nodes))
    }

    fn settle(&self, state: &mut [u32; 3], children: &[u32; 2], _: &mut Vec<u8>, world: &mut impl Oracle) {
        let node = children[world.pick(2) as usize];
        *state = [node, self.nodes + node % 5_000, node % 7];
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<&'static str> {
        if turn.after[0] == self.forbidden { vec![STEP] } else { Vec::new() }
    }
}

impl System for Heap {
    type Part = u32;

    fn places(&self, _: &[u32; 3]) -> usize {
        3
    }

    fn part(&self, state: &[u32; 3], place: usize) -> u32 {
        state[place]
    }

    fn differing(&self, from: &[u32; 3], to: &[u32; 3]) -> Places {
        super::super::places(from.iter().zip(to).map(|(from, to)| from != to))
    }

    fn put(&self, state: &mut [u32; 3], place: usize, &part: &u32) {
        state[place] = part;
    }

    fn is_enough(&self, _: &'static str) -> bool {
        self.is_enough
    }
}

/// Workers number the same new parts each for itself, and more of them than one and two bytes can number.
#[test]
fn any_number_of_workers_finds_the_same_in_the_same_memory() {
    const ALL: u64 = u64::MAX;
    let cases = [(50_000, false, ALL, 80_000), (50_000, true, ALL, 50_001), (99, false, 60_001, 60_002)];
    for (forbidden, is_enough, most_steps, states) in cases {
        let heap = Heap { nodes: 80_000, forbidden, is_enough };
        let by = |workers| {
            let limits = Limits { workers: NonZeroUsize::new(workers), ..Limits::steps(most_steps) };
            search(&heap, [[0, heap.nodes, 0]], limits)
        };
        let alone = by(1);
        assert_eq!((alone.states, alone.broken.len()), (states, 1));
        assert!([2, 3, 8].into_iter().all(|workers| by(workers) == alone), "{alone:?}");
    }
}
