//! NOTICE by hand: which message arrives next, once or again, and who forwards. Nodes that are beside each other, also
//! corner to corner, have a link, unless a wall is between them.

use core::num::NonZeroU32;
use serde_json::{Value as Json, json};
use tautline_io::diagnostic::Diagnostic;
use tautline_kernel::choice::Oracle;
use tautline_kernel::ground::{Area, Cell, Edge, Side};
use tautline_kernel::notice::{Conditions, Count, Rule, Scheme, Stage};
use tautline_proofs::engine::world::{Turn, World};
use tautline_proofs::notice::networks::{Case, SMALL};
use tautline_proofs::notice::spread::{Demand, Event, Spread};
use tautline_sim::explore::{Ink, Kind, Layer, Place, Shape, Value};

use super::scene::{Picture, Scene, SceneWorld, WorldRun};
use super::setup::{ByHand, HuntFindings, chosen, number, of_world, search, starts};
use crate::play::Play;
use crate::settings::Settings;

pub(super) const NOTICE: ByHand = ByHand { name: "notice", start, row: Some((row, hunt)) };

const STAGES: &[Value] = &[
    Value { name: "waits", ink: Ink::Aim },
    Value { name: "has forwarded", ink: Ink::Closed },
    Value { name: "is silent", ink: Ink::Closing },
];
const KINDS: &[Kind] =
    &[Kind::heard("a NOTICE under way"), Kind::heard("a link"), Kind::heard("a node's parent")];

/// The rule with k = 1, and with these conditions.
fn rule(conditions: Conditions, k: u8) -> Rule {
    let scheme = Scheme::Farthest { k: Count::new(k) };
    Rule { conditions, ..Rule::new(scheme, NonZeroU32::MIN, 0) }
}

fn row() -> Json {
    json!({
        "name": "notice",
        "about": "NOTICE: a message that spreads from node to node; each start is a node, the first the source",
        "team": "network", "robot": "node", "robots": [2, SMALL], "base": false, "starts": "anywhere",
        "misses": false, "draws": true, "by_hand": "only",
        "options": [{ "field": "k", "takes": "COUNT",
            "about": "How many senders besides the first keep a node from forwarding; 0 is any number. Without it 1" }],
        "rules": [
            of_world("repaired", "With the repairs of its refuted claims", &rule(Conditions::REPAIRED, 1)),
            of_world("published", "As the paper publishes it", &rule(Conditions::PUBLISHED, 1)),
        ],
    })
}

/// A network on a board.
struct Network {
    case: Case,
    rule: Rule,
    area: Area,
    cells: Vec<Cell>,
    pairs: Vec<(usize, usize)>,
}

fn start(settings: &Settings) -> Result<Box<dyn Play>, Diagnostic> {
    let network = network(settings)?;
    let state = network.case.start();
    Ok(WorldRun::boxed(network, state, settings.seed))
}

fn hunt(settings: &Settings, most_steps: u64) -> Result<HuntFindings, Diagnostic> {
    let Network { case, rule, .. } = network(settings)?;
    Ok(search(&case, &case.start(), most_steps, |(demand, _)| {
        is_asked(&rule, demand).then(|| clause(demand))
    }))
}

fn network(settings: &Settings) -> Result<Network, Diagnostic> {
    let layout = settings.layout()?;
    let count = usize::from(settings.robots);
    if !(2..=SMALL).contains(&count) {
        let what = format!("{count} nodes are no network that is played by hand");
        return Err(Diagnostic::of_field("robots", what, format_args!("take 2 to {SMALL}")));
    }
    let area = layout.size().area();
    let cells = starts(settings, area, count);
    let is_linked = |one: Cell, other: Cell| {
        let (dx, dy) = one.apart(other);
        let side = Side::ALL.into_iter().find(|&side| one.beyond(side) == other);
        dx.max(dy) == 1 && side.is_none_or(|side| layout.is_open(Edge::new(one, side)))
    };
    let pairs = (0..cells.len()).flat_map(|one| (one + 1..cells.len()).map(move |other| (one, other)));
    let pairs: Vec<(usize, usize)> =
        pairs.filter(|&(one, other)| is_linked(cells[one], cells[other])).collect();
    let k = number(settings, "k", 1, Count::MOST)?;
    let rules = [("published", Conditions::PUBLISHED), ("repaired", Conditions::REPAIRED)];
    let rule = chosen(&rules.map(|(name, conditions)| (name, rule(conditions, k))), settings)?;
    Ok(Network { case: Case::new(pairs.iter().copied(), rule), rule, area, cells, pairs })
}

/// Whether something is demanded of this rule: of flooding alone that all forward.
fn is_asked(rule: &Rule, demand: Demand) -> bool {
    demand != Demand::Floods || matches!(rule.scheme, Scheme::Farthest { k: None } | Scheme::Flooding)
}

const fn clause(demand: Demand) -> &'static str {
    match demand {
        Demand::Tree => "NOTICE-1",
        Demand::Once => "NOTICE-2",
        Demand::Floods => "NOTICE-3",
        Demand::Reaches => "NOTICE-5",
        Demand::NearestParent => "NOTICE-6",
    }
}

impl World for Network {
    type State = Spread<SMALL>;
    type Plan = Vec<Event>;
    type Event = Event;
    type Demand = (Demand, &'static str);

    fn plan(&self, state: &mut Self::State, log: &[u8]) -> Option<Self::Plan> {
        self.case.plan(state, log)
    }

    fn settle(
        &self,
        state: &mut Self::State,
        plan: &Self::Plan,
        log: &mut Vec<u8>,
        world: &mut impl Oracle,
    ) -> Event {
        self.case.settle(state, plan, log, world)
    }

    fn broken_by(&self, turn: &Turn<'_, Self>) -> Vec<Self::Demand> {
        let &Turn { before, planned, after, plan, event, sent } = turn;
        let broken = self.case.broken_by(&Turn { before, planned, after, plan, event, sent });
        broken.into_iter().filter(|&(demand, _)| is_asked(&self.rule, demand)).collect()
    }

    fn broken_at_end(&self, state: &Self::State, log: &[u8]) -> Vec<Self::Demand> {
        let broken = self.case.broken_at_end(state, log);
        broken.into_iter().filter(|&(demand, _)| is_asked(&self.rule, demand)).collect()
    }
}

impl SceneWorld for Network {
    fn scene(&self) -> Scene {
        Scene {
            area: self.area,
            actor: "node",
            squares: 1,
            names: Vec::new(),
            layers: vec![
                Layer::new("stages", "what has become of each node", Shape::Cells(STAGES)),
                Layer::new(
                    "network",
                    "links, what is under way, and the parent of each node",
                    Shape::Messages(KINDS),
                ),
            ],
        }
    }

    fn options(&self, _: &Self::State, plan: &Vec<Event>) -> Vec<String> {
        let told = |event: &Event| match event {
            Event::Arrives { from, to } => {
                format!("the NOTICE of node {} arrives at node {}", from + 1, to + 1)
            }
            Event::ArrivesAgain { from, to } => {
                format!(
                    "the NOTICE of node {} arrives at node {}, and a copy is still under way",
                    from + 1,
                    to + 1
                )
            }
            Event::Expires { at } => {
                format!("the wait of node {} is over: it forwards or falls silent", at + 1)
            }
        };
        plan.iter().map(told).collect()
    }

    fn picture(&self, state: &Self::State) -> Picture {
        let mut picture = Picture { cells: self.cells.clone(), ..Picture::default() };
        picture.say.extend(self.pairs.iter().map(|&(one, other)| (1, 1, one, other)));
        for (at, (node, &cell)) in state.nodes.iter().zip(&self.cells).enumerate() {
            let value = match node.stage() {
                Stage::Unaware => 0,
                Stage::Waiting { .. } => 1,
                Stage::Forwarded => 2,
                Stage::Silent => 3,
            };
            picture.put.extend((value > 0).then_some((0, None, Place::Cell(cell), value)));
            let parent = node.parent().map(|parent| parent.0 as usize).filter(|&parent| parent != at);
            picture.say.extend(parent.map(|parent| (1, 2, at, parent)));
            let under_way = (0..self.cells.len()).filter(|to| state.under_way[at] >> to & 1 == 1);
            picture.say.extend(under_way.map(|to| (1, 0, at, to)));
        }
        picture
    }

    fn clause(&self, (demand, words): Self::Demand) -> (&'static str, String) {
        (clause(demand), format!("It is not so that {words}."))
    }
}
