//! Assumptions of Turns.v about agents that walk laps; of those that search in trees their runs show them.

use tautline_kernel::bricks::{Agent, Next, Rule, act};
use tautline_kernel::floor::{Sensor, settle};
use tautline_kernel::ground::Cell;

use super::ground::Ground;
use super::trees::{Eyes, drawn};
use crate::draw::Draw;

#[test]
fn an_agent_reads_and_writes_no_cell_but_those_around_it() {
    let (mut draw, mut cells_read) = (Draw(2024), 0);
    for _ in 0..40 {
        let mut floor: Ground<Sensor> = drawn(&mut draw);
        let cells: Vec<Cell> = floor.sensors.keys().map(|&at| Cell::from(at)).collect();
        let start = |_| cells[draw.below(cells.len() as u64) as usize];
        let starts: Vec<Cell> = (0..3).map(start).collect();
        settle(&mut floor, &starts);
        let mut team: Vec<(Agent, Cell, bool)> =
            (0..).zip(starts).map(|(id, start)| (Agent::new(id), start, false)).collect();
        for _ in 0..200 {
            let (agent, at, is_done) = &mut team[draw.below(3) as usize];
            if *is_done {
                continue;
            }
            let (here, before) = (*at, floor.clone());
            let (mut near, mut twin) = (floor.near(here), *agent);
            let done = act(Rule::REPAIRED, &mut floor, agent, here, &mut Eyes::all());
            let of_twin = act(Rule::REPAIRED, &mut near, &mut twin, here, &mut Eyes::all());
            assert_eq!((of_twin, twin), (done, *agent));
            let mut written = floor.sensors.iter().filter(|&(at, sensor)| before.sensors[at] != *sensor);
            assert!(written.all(|(at, sensor)| near.sensors.get(at) == Some(sensor)));
            cells_read += near.sensors.len();
            (*at, *is_done) = (done.1, done.0.next == Next::Done);
        }
    }
    assert!(cells_read > 1000, "{cells_read}");
}
