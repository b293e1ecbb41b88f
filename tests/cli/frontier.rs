//! Frontier cells on the command line: what is refused, with what would be right.

use super::{folder, names, printed, refused};

#[test]
fn what_no_team_of_frontier_cells_can_be_told_is_refused() {
    let folder = folder();
    let folder = folder.path();
    let wrong: [(&[&str], &str); 18] = [
        (&["explore", "cells:3x3:0", "--threshold", "1.5"], "--threshold a number from 0 to 1"),
        (&["explore", "cells:3x3:0", "--threshold", "nan"], "--threshold a number from 0 to 1"),
        (&["explore", "cells:3x3:0", "--robots", "10"], "--robots a number up to 9"),
        (&["explore", "cells:3x3:0", "--noise-db", "-1"], "decibels from 0 to 100"),
        (&["explore", "cells:3x3:0", "--odometry", "-0.1:1"], "--odometry a share of the way from 0 to 1"),
        (&["explore", "cells:3x3:0", "--odometry", "0.02:nan"], "--odometry a share of the way from 0 to 1"),
        (&["explore", "cells:3x3:0", "--odometry", "0.02"], "such as 0.02:1"),
        (&["explore", "cells:3x3:0", "--anchors", "2"], "--anchors 3 to 8"),
        (&["explore", "cells:3x3:0", "--readings", "x"], "whole number"),
        (&["explore", "open:60x60", "--noise-db", "4"], "a smaller floor, less --noise-db"),
        (&["explore", "open:6x6", "--noise-db", "1", "--odometry", "0.02:5"], "--odometry smaller errors"),
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

#[test]
fn a_map_of_ros_is_read_again_as_far_as_it_was_explored() {
    let folder = folder();
    let folder = folder.path();
    let explored = ["explore", "cells:6x7:0.2", "--scheme", "frontier", "--robots", "2", "--noise-db", "1"];
    let told = printed(folder, &[&explored[..], &["--map", "map.yaml"]].concat(), 0);
    let cells = told.lines().find_map(|line| line.split_once(" explored")).expect("what is explored").0;
    let again = ["explore", "map.yaml", "--scheme", "frontier", "--robots", "2"];
    assert!(printed(folder, &again, 0).contains(&format!("{cells} explored")), "{told}");
    assert_eq!(names(folder), ["map.pgm", "map.yaml"]);
}
