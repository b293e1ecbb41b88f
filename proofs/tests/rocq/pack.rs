//! Links and runs of packs: which cells have a link, and what robots do on drawn floors, step by step.

use tautline_kernel::ground::{Area, Cell, Step};
use tautline_kernel::pack::{Chart, MAX_ROBOTS, MoveKind, Rule, Scratch, Team};
use tautline_proofs::pack::Moves;

use super::term::{at, bits, cell, definition, everywhere, list, offsets};
use crate::draw::Draw;

/// Columns and rows up to which links are asked for.
const REACH: i16 = 6;
/// How many columns and rows the floors have.
const WIDTH: i16 = 5;
/// R_c of the tables.
const RANGES: [u16; 3] = [3, 4, 5];

pub(super) fn terms() -> String {
    let links = |rule: Rule| {
        let tables = RANGES.map(|range| {
            let rule = rule.within(1, range).expect("a range");
            let answers = offsets(REACH).map(|offset| everywhere(|here| rule.links(here, at(here, offset))));
            format!("({range}%Z,{})", bits(&answers.collect::<Vec<_>>()))
        });
        list(tables)
    };
    let mut text = definition("reach", "Z", &REACH.to_string());
    text += &definition("links_REPAIRED", "list (Z * N)", &links(Rule::REPAIRED));
    text += &definition("links_PUBLISHED", "list (Z * N)", &links(Rule::PUBLISHED));
    text += &definition("width", "Z", &WIDTH.to_string());
    let (mut draw, mut kinds) = (Draw(2013), [0; 2]);
    let runs: Vec<String> = (0..30).filter_map(|number| run(2 + number % 3, &mut draw, &mut kinds)).collect();
    assert!(runs.len() > 5 && kinds.iter().all(|&times| times > 2), "{} {kinds:?}", runs.len());
    text + &definition("runs", "list (Z * list (Z * Z) * list (Z * Z) * list (bool * list nat))", &list(runs))
}

/// R_c, the starts, the obstacles, and of each team move whether one was taken back, and the step of each robot; `None`
/// if the robots are no pack. Counts the team moves that were led or marched, and those that were taken back.
fn run(robots: usize, draw: &mut Draw, kinds: &mut [usize; 2]) -> Option<String> {
    let area = Area::new(Cell::new(0, 0), Cell::new(WIDTH - 1, WIDTH - 1)).expect("an area");
    let mut cells: Vec<Cell> = area.cells().collect();
    let mut drawn = || cells.swap_remove(draw.below(cells.len() as u64) as usize);
    let obstacles: Vec<Cell> = (0..6).map(|_| drawn()).collect();
    let starts: Vec<Cell> = (0..robots).map(|_| drawn()).collect();
    let rule = Rule::REPAIRED.within(1, 3).expect("a range");
    let mut team = Team::new(rule, &starts).ok()?;
    let mut chart = Chart::new(area, vec![[0; 2]; Chart::<Vec<[u64; 2]>>::words(area)])?;
    let count = area.width() * area.height();
    let (mut reached, mut queue) = (vec![0; count], vec![Cell::default(); count]);
    let (mut gains, mut rounds) = (vec![0; count], 0);
    let (mut past, mut steps, mut moves) = (Moves::default(), [Step::Stay; MAX_ROBOTS], Vec::new());
    for _ in 0..60 {
        for &cell in team.cells() {
            let is_obstacle = |cell: Cell| !area.contains(cell) || obstacles.contains(&cell);
            chart.look(rule.sight(), cell, is_obstacle, |_, _| ());
        }
        let mut memory =
            Scratch { reached: &mut reached, queue: &mut queue, gains: &mut gains, rounds: &mut rounds };
        let Ok(kind) = team.advance(&chart, &mut past, &mut memory, &mut steps) else { break };
        let is_back = kind == MoveKind::TakenBack;
        kinds[0] += usize::from(matches!(kind, MoveKind::Led(_) | MoveKind::Marched));
        kinds[1] += usize::from(is_back);
        let number =
            |step: &Step| Step::ALL.iter().position(|other| other == step).expect("a step").to_string();
        moves.push(format!("({is_back},{}%nat)", list(steps[..robots].iter().map(number))));
    }
    let [starts, obstacles] = [starts, obstacles].map(|cells| list(cells.into_iter().map(cell)));
    Some(format!("\n (3%Z,{starts}%Z,{obstacles}%Z,\n  {})", list(moves)))
}
