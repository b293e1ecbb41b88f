//! Frontier cells on the command line: what is refused, with what would be right.

use super::{folder, names, refused};

#[test]
fn what_no_team_of_frontier_cells_can_be_told_is_refused() {
    let folder = folder();
    let folder = folder.path();
    let wrong: [(&[&str], &str); 11] = [
        (&["explore", "cells:3x3:0", "--threshold", "1.5"], "--threshold a number from 0 to 1"),
        (&["explore", "cells:3x3:0", "--threshold", "nan"], "--threshold a number from 0 to 1"),
        (&["explore", "cells:3x3:0", "--robots", "10"], "--robots a number up to 9"),
        (&["explore", "cells:3x3:0", "--noise-db", "-1"], "decibels from 0 to 100"),
        (&["explore", "cells:3x3:0", "--loss", "2"], "from 0 to 1"),
        (&["explore", "cells:3x3:0", "--range", "x"], "whole number"),
        (&["hunt", "--robots", "7", "--size", "3x2"], "--robots a number from 1 to 3"),
        (&["hunt", "--rule", "greedy", "--robots", "7", "--size", "3x2"], "--robots a number up to 6"),
        (&["hunt", "--size", "9x9"], "--size at most 16 cells"),
        (&["hunt", "--error", "0.3"], "sixteenths from 0 to 1"),
        (&["hunt", "--robots", "2", "--error", "0.25"], "--robots 1, or --error 1"),
    ];
    for (arguments, right) in wrong {
        let said = refused(folder, &[arguments, &["--scheme", "frontier"]].concat());
        assert!(said.contains(right), "{arguments:?}: {said}");
    }
    assert!(names(folder).is_empty());
}
