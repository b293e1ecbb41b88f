//! Which plans of whole teams the kernel accepts, on drawn maps, by three rules.

use tautline_kernel::chain::Rule;
use tautline_kernel::ground::{Area, Cell, Edge, EdgeMark, Grid, SmallGrid, Step};

use super::runs::border;
use super::term::{bits, cell, definition, edge, list, number};
use crate::draw::Draw;

const BASE: Cell = Cell::new(2, 2);
const MOST: usize = 5;
const TEAMS: usize = 48;
const PLANS: usize = 32;
const RULES: [Rule; 3] = [Rule::PUBLISHED, Rule::REPAIRED, Rule::REEL];

/// Of each team: how many robots, where they are, the known walls and the sides known to be open, the plans (the step
/// of R_2 in the lowest byte), and of each rule a bit for each plan.
pub(super) fn terms() -> String {
    let (mut draw, mut accepted) = (Draw(6), [0; RULES.len()]);
    let teams: Vec<String> =
        (0..TEAMS).map(|number| team(2 + number % (MOST - 1), &mut draw, &mut accepted)).collect();
    assert!(accepted.iter().all(|&count| (200..TEAMS * PLANS - 200).contains(&count)), "{accepted:?}");
    let kind = "list (nat * list (Z * Z) * list ((Z * Z) * bool) * list ((Z * Z) * bool) * list N * list N)";
    definition("accepted", kind, &list(teams))
}

fn step(draw: &mut Draw) -> Step {
    Step::ALL[draw.below(5) as usize]
}

fn team(robots: usize, draw: &mut Draw, accepted: &mut [usize; RULES.len()]) -> String {
    let area = Area::new(Cell::new(0, 0), Cell::new(4, 4)).expect("an area");
    let mut grid = SmallGrid::new(area).expect("it is small");
    let mut walls: Vec<Edge> = border(area).collect();
    let mut open = Vec::new();
    for edge in area.edges() {
        match draw.below(6) {
            0 => {
                grid.put_edge(EdgeMark::Wall, edge);
                walls.push(edge);
            }
            1 | 2 => {
                grid.put_edge(EdgeMark::Open, edge);
                open.push(edge);
            }
            _ => {}
        }
    }
    let mut cells = vec![BASE];
    for behind in 0..robots - 1 {
        let to = (0..draw.below(3)).fold(cells[behind], |at, _| at.after(step(draw)));
        cells.push(if area.contains(to) { to } else { cells[behind] });
    }
    let (mut plans, mut answers) = (Vec::new(), [const { Vec::new() }; RULES.len()]);
    for _ in 0..PLANS {
        // Those from one robot on go one way, and two of them may go others.
        let (from, way) = (draw.below(robots as u64) as usize, step(draw));
        let mut steps: Vec<Step> =
            (0..robots).map(|robot| if robot > from { way } else { Step::Stay }).collect();
        for _ in 0..2 {
            let other = draw.below(2 * robots as u64) as usize;
            if (1..robots).contains(&other) {
                steps[other] = step(draw);
            }
        }
        plans.push(number(steps.iter().skip(1).map(|step| step.place() as u8)));
        for (rule, (answers, accepted)) in RULES.iter().zip(answers.iter_mut().zip(&mut *accepted)) {
            let answer = rule.admits_plan(&mut grid, &cells, &steps);
            *accepted += usize::from(answer);
            answers.push(answer);
        }
    }
    format!(
        "\n ({robots}%nat,{}%Z,{}%Z,\n  {}%Z,\n  {}%N,{})",
        list(cells.into_iter().map(cell)),
        list(walls.into_iter().map(edge)),
        list(open.into_iter().map(edge)),
        list(plans),
        list(answers.iter().map(|answers| bits(answers)))
    )
}
