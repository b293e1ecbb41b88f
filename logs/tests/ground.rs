//! Logs against a small map whose faults are seen by hand.

use std::fmt::Write;

use tautline_logs::{Grid, Ground, Limits, Numbers, Strays, Tracks, misplaced, read};

const LIMITS: Limits = Limits { tolerance_mm: 100, gap_us: 1_000_000, jump_us: 60_000_000 };
const GRID: Grid = Grid { origin_mm: [0.0, 0.0], cell_mm: 1_000.0 };

/// Three columns and two rows; the cell (2,0) is blocked, and a wall is between (0,0) and (1,0).
struct Floor;

impl Ground for Floor {
    fn is_free(&self, [column, row]: [i32; 2]) -> bool {
        (0..3).contains(&column) && (0..2).contains(&row) && [column, row] != [2, 0]
    }

    fn is_open(&self, cell: [i32; 2], beside: [i32; 2]) -> bool {
        let apart: u32 = (0..2).map(|axis| cell[axis].abs_diff(beside[axis])).sum();
        let mut ends = [cell, beside];
        ends.sort_unstable();
        apart == 1 && self.is_free(cell) && self.is_free(beside) && ends != [[0, 0], [1, 0]]
    }
}

/// The faults of one robot that is at these places, in millimetres, at these tenths of a second; how many of each.
fn faults(rows: &[(u32, [i32; 2])]) -> [u32; 2] {
    let mut text = "t_ms,robot,x_mm,y_mm\n".to_owned();
    for (tenths, [x, y]) in rows {
        writeln!(text, "{tenths}00,a,{x},{y}").expect("a string");
    }
    let log = read(text.as_bytes()).expect("a log");
    let tracks = Tracks::new(&log, &Numbers::natural(&log.names), &LIMITS);
    let Strays { off, through, .. } = misplaced(&tracks, &LIMITS, GRID, &Floor);
    [off, through].map(|found| found.map_or(0, |(count, _)| count))
}

#[test]
fn a_position_is_off_the_map_and_a_step_through_a_wall_where_they_leave_no_doubt() {
    let (west, east, south, blocked) = ([500, 500], [1_500, 500], [1_500, 1_500], [2_500, 500]);
    assert_eq!(faults(&[(0, west), (5, east)]), [0, 1], "through the wall");
    assert_eq!(faults(&[(0, west), (11, east)]), [0, 0], "silent meanwhile");
    assert_eq!(faults(&[(0, west), (3, [1_000, 500]), (6, east)]), [0, 1], "by its border");
    assert_eq!(faults(&[(0, west), (5, south)]), [0, 0], "round the corner");
    assert_eq!(faults(&[(0, east), (5, south)]), [0, 0], "through an open side");
    assert_eq!(
        faults(&[(0, east), (5, blocked), (9, [500, -500])]),
        [2, 0],
        "in a blocked cell, and outside"
    );
    assert_eq!(faults(&[(0, [1_950, 500]), (5, [2_050, 500])]), [0, 0], "within the tolerance");
}
