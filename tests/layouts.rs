//! Layouts are read, written and made as their formats say, and what is wrong with one is told in one line.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{self, Write};
use std::num::NonZeroU16;
use std::path::{Path, PathBuf};

use insta::{allow_duplicates, assert_snapshot};
use proptest::prelude::*;
use tautline_grids::layout::{self, Generator, Layout, movingai, ros};
use tautline_io::diagnostic::Diagnostic;
use tautline_io::json_lines::MAX_FILE_BYTES;
use tautline_kernel::ground::{Cell, Edge, Side};

use crate::folder::{folder, write};
use crate::fuzz_corpus::targets::report::{Colour, render, with_flags};

const DRAWING: &str = "\
tautline layout 1
robots 4
+--+--+--+
|     |  |
+  +--+  +
|   B  ##|
+--+--+--+
";

const MAP: &str = "type octile\nheight 2\nwidth 4\nmap\n.GS@\nOTW.\n";

const YAML: &str = "\
image: map.pgm
resolution: 0.05
origin: [-1, 2.5, 0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
";

fn drawing(source: &str) -> Layout {
    source.parse().expect("a drawing")
}

/// The free cells that a robot can come to from the default base.
fn reached(layout: &Layout) -> usize {
    let mut seen = vec![layout.default_base().expect("a free cell")];
    let mut next = 0;
    while let Some(&cell) = seen.get(next) {
        next += 1;
        for side in Side::ALL {
            let beyond = cell.beyond(side);
            if layout.is_open(Edge::new(cell, side)) && !seen.contains(&beyond) {
                seen.push(beyond);
            }
        }
    }
    seen.len()
}

fn made(description: &str, seed: u64) -> Layout {
    description.parse::<Generator>().expect("a generator").generate(seed).expect("a layout")
}

/// The one line that is said about a file of this name and content.
fn refused(name: &str, content: impl AsRef<[u8]>) -> String {
    let folder = &folder();
    let file = folder.join(name);
    fs::write(&file, content).expect("a file");
    plain(&layout::load(file.to_str().expect("a name"), 0, None).expect_err("a fault"), folder)
}

fn plain(fault: &Diagnostic, folder: &Path) -> String {
    with_flags(&fault.to_string()).replace(&format!("{}/", folder.display()), "")
}

/// The drawing of a fault without the blanks at the ends of its lines.
fn shown(fault: &Diagnostic) -> String {
    render(fault, Colour::Plain).lines().map(str::trim_end).collect::<Vec<_>>().join("\n")
}

#[test]
fn a_drawing_says_what_it_shows() {
    let layout = drawing(DRAWING);
    assert_eq!((layout.width(), layout.height(), layout.free_cells()), (3, 2, 5));
    assert_eq!((layout.robots(), layout.base()), (Some(4), Some(Cell::new(1, 1))));
    let walls: Vec<Edge> = layout.walls().collect();
    assert_eq!(walls, [Edge::new(Cell::new(1, 0), Side::East), Edge::new(Cell::new(1, 0), Side::South)]);
    assert!(layout.is_open(Edge::new(Cell::new(0, 0), Side::South)));
    assert!(!layout.is_open(Edge::new(Cell::new(1, 1), Side::East)), "the cell beyond is blocked");
    assert!(!layout.is_open(Edge::new(Cell::new(0, 0), Side::West)), "the rim is closed");
    assert_eq!(layout.to_string(), DRAWING);
    assert_eq!(drawing(&DRAWING.replace('\n', "\r\n")), layout);
    assert_eq!(drawing(DRAWING.trim_end()), layout);
}

#[test]
fn the_default_base_is_the_free_cell_nearest_the_centre() {
    let base = |layout: &Layout| layout.default_base();
    assert_eq!(base(&made("open:15x15", 0)), Ok(Cell::new(7, 7)));
    assert_eq!(base(&made("open:4x2", 0)), Ok(Cell::new(1, 0)));
    let mut layout = made("open:3x3", 0);
    layout.block(Cell::new(1, 1));
    assert_eq!(base(&layout), Ok(Cell::new(1, 0)));
    layout.cells().for_each(|cell| layout.block(cell));
    assert_eq!(base(&layout), Err(layout::no_free_cell()));
}

#[test]
fn a_base_must_be_inside_and_free() {
    let mut layout = drawing(DRAWING);
    assert_snapshot!(layout.place_base(Cell::new(2, 1)).expect_err("blocked"),
        @"the base 2,1 is on a blocked cell; the nearest free cell is 2,0; put the base on 2,0");
    assert_snapshot!(layout.place_base(Cell::new(3, 0)).expect_err("outside"),
        @"the base 3,0 is outside the 3x2 cells; columns go from 0 to 2, rows from 0 to 1");
    assert_eq!(layout.place_base(Cell::new(0, 1)), Ok(()));
    layout.block(Cell::new(0, 1));
    assert_eq!(layout.base(), None);
}

#[test]
fn the_rim_stays_closed_and_the_outside_empty() {
    let mut layout = made("open:2x2", 0);
    let rim = Edge::new(Cell::new(1, 0), Side::East);
    let outside = Edge::new(Cell::new(5, 5), Side::East);
    layout.remove_wall(rim);
    layout.build_wall(outside);
    assert!(layout.has_wall(rim) && !layout.has_wall(outside));
    assert_eq!(layout.walls().count(), 0);
    assert_eq!(layout, made("open:2x2", 0));
}

#[test]
fn sizes_out_of_bounds_are_refused() {
    for (width, height) in [(0, 5), (5, 0), (32_001, 1), (32_000, 31_250), (u64::MAX, u64::MAX)] {
        assert_eq!(Layout::open(width, height), Err(layout::of_size(width, height)));
    }
    assert_eq!(Layout::open(4096, 4096).map(|layout| layout.free_cells()), Ok(1 << 24));
}

fn any_layout() -> impl Strategy<Value = Layout> {
    (1_u64..12, 1_u64..12).prop_flat_map(|(width, height)| {
        let cells = (width * height) as usize;
        let bits = || prop::collection::vec(any::<bool>(), 2 * cells);
        let blocked = prop::collection::vec(prop::bool::weighted(0.3), cells);
        let base = prop::option::of((0..width as i16, 0..height as i16));
        let robots = prop::option::of(1..=256_u16);
        (bits(), blocked, base, robots).prop_filter_map(
            "a free cell is left",
            move |(walls, blocked, base, robots)| {
                let mut layout = Layout::open(width, height).expect("a small size");
                layout
                    .edges()
                    .zip(walls)
                    .filter(|(_, wall)| *wall)
                    .for_each(|(edge, _)| layout.build_wall(edge));
                layout
                    .cells()
                    .zip(blocked)
                    .filter(|(_, blocked)| *blocked)
                    .for_each(|(cell, _)| layout.block(cell));
                if let Some((x, y)) = base.filter(|&(x, y)| layout.is_free(Cell::new(x, y))) {
                    layout.place_base(Cell::new(x, y)).expect("a free cell");
                }
                if let Some(robots) = robots.and_then(NonZeroU16::new) {
                    layout.set_robots(robots).expect("a team");
                }
                (layout.free_cells() > 0).then_some(layout)
            },
        )
    })
}

proptest! {
    #[test]
    fn a_layout_is_the_same_after_it_was_written_and_read(layout in any_layout()) {
        let written = layout.to_string();
        let read: Layout = written.parse().expect("our own drawing");
        prop_assert_eq!(&read, &layout);
        prop_assert_eq!(read.to_string(), written);
    }

    #[test]
    fn no_text_makes_a_reader_or_a_fault_panic(
        text in "(tautline layout 1\n)?(type octile\nheight 2\nwidth 2\nmap\n)?([+|# B.@é-]{0,7}\r?\n){0,5}",
        start in 0_usize..90,
        length in 0_usize..9,
    ) {
        let _ = text.parse::<Layout>();
        let _ = movingai::read(&text);
        let _ = ros::describe(&text);
        let fault = Diagnostic::at("a.txt", &text, start..start + length, "wrong", "right");
        prop_assert!(render(&fault, Colour::Plain).contains("wrong"));
    }

    #[test]
    fn a_changed_drawing_is_another_layout_or_refused(at in 18_usize..75, symbol in "[+|# B-]") {
        let mut changed = DRAWING.to_owned();
        changed.replace_range(at..=at, &symbol);
        if let Ok(layout) = changed.parse::<Layout>() {
            prop_assert_eq!(layout.to_string(), changed);
        }
    }
}

#[test]
fn a_bad_drawing_is_refused_at_its_place() {
    let bad = |from: &str, to: &str| {
        assert!(DRAWING.contains(from));
        refused("a.txt", DRAWING.replacen(from, to, 1))
    };
    assert_snapshot!(bad("layout 1", "layout 2"),
        @"a.txt:1:17: this is version 2, this program reads version 1; write the drawing again with this program");
    assert_snapshot!(bad("tautline layout 1\n", ""),
        @"a.txt:1:1: this is not the first line of a layout; a drawing begins with `tautline layout 1`; \
          name MovingAI maps .map and ROS maps .yaml");
    assert_snapshot!(bad("robots 4", "robots 257"),
        @r#"a.txt:2:8: "257" is no number of robots; write `robots N` with N from 1 to 256, or leave the line out"#);
    assert_snapshot!(bad("robots 4", "robots 0"),
        @r#"a.txt:2:8: "0" is no number of robots; write `robots N` with N from 1 to 256, or leave the line out"#);
    assert_snapshot!(bad("robots 4", "robot 4"),
        @"a.txt:2:1: the northern rim should be drawn here; draw it as `+--+--+`, one `--` for each column");
    assert_snapshot!(bad("+--+--+--+\n", ""),
        @"a.txt:3:1: the northern rim should be drawn here; draw it as `+--+--+`, one `--` for each column");
    assert_snapshot!(bad("|     |  |", "|     |  | "),
        @"a.txt:4:1: this row ends after character 11, not 10; make all rows equally long");
    assert_snapshot!(bad("|     |  |", "|     |"),
        @"a.txt:4:1: this row ends after character 7, not 10; make all rows equally long");
    assert_snapshot!(bad("##", "#?"),
        @r##"a.txt:6:8: the symbol "#?" is unknown; a cell is two spaces (free), `##` (blocked) or `B` and a space (the base); before each cell, and at the end of the row, stands `|` (a wall) or a space"##);
    assert_snapshot!(bad("##", "é "),
        @r#"a.txt:6:8: the symbol "é" is unknown; a cell is two spaces (free), `##` (blocked) or `B` and a space (the base); before each cell, and at the end of the row, stands `|` (a wall) or a space"#);
    assert_snapshot!(bad("##|", "##x"),
        @r#"a.txt:6:10: the symbol "x" is unknown; a cell is two spaces (free), `##` (blocked) or `B` and a space (the base); before each cell, and at the end of the row, stands `|` (a wall) or a space"#);
    assert_snapshot!(bad("+  +--+  +", "+  +--+ -+"),
        @r#"a.txt:5:8: the symbol " -" is unknown; a line between two rows is made of `+` corners, each followed by `--` (a wall) or two spaces"#);
    assert_snapshot!(bad("+  +--+  +", "+  *--+  +"),
        @r#"a.txt:5:4: the symbol "*" is unknown; a line between two rows is made of `+` corners, each followed by `--` (a wall) or two spaces"#);
    assert_snapshot!(bad("##|", "## "),
        @"a.txt:6:10: the rim has a gap; close it: `--` in the north and south, `|` in the east and west");
    assert_snapshot!(bad("+--+--+--+\n|     ", "+--+  +--+\n|     "),
        @"a.txt:3:1: the northern rim should be drawn here; draw it as `+--+--+`, one `--` for each column");
    assert_snapshot!(bad("##|\n+--+--+--+", "##|\n+--+  +--+"),
        @"a.txt:7:5: the rim has a gap; close it: `--` in the north and south, `|` in the east and west");
    assert_snapshot!(bad("##|\n+--+--+--+\n", "##|\n"),
        @"a.txt:6:11: the drawing ends before its southern rim; a drawing is a line of walls, then for \
          each row a line of cells and a line of walls");
    assert_snapshot!(bad("|   B  ##|\n+--+--+--+\n", ""),
        @"a.txt:5:2: the rim has a gap; close it: `--` in the north and south, `|` in the east and west");
    assert_snapshot!(bad("|     |", "|B    |"), @"a.txt:6:5: a second base; the first is 0,0; leave one of them");
    assert_snapshot!(refused("a.txt", "tautline layout 1\n"),
        @"a.txt:1:18: the drawing ends before its southern rim; a drawing is a line of walls, then for \
          each row a line of cells and a line of walls");
    assert_snapshot!(refused("a.txt", "tautline layout 1\n+--+\n|##|\n+--+\n"),
        @"a.txt:2:1: no cell is free; leave at least one cell free for the base");
    let wide = format!("+{}\n", "--+".repeat(32_001));
    assert_snapshot!(refused("a.txt", format!("tautline layout 1\n{wide}{wide}{wide}")),
        @"a.txt:2:1: the size 32001x1 is out of bounds; a layout has 1 to 32000 \
          cells on a side and at most 16777216 in all");
}

#[test]
fn a_movingai_map_says_what_it_shows() {
    let layout = movingai::read(MAP).expect("a map");
    assert_snapshot!(layout, @r"
    tautline layout 1
    +--+--+--+--+
    |         ##|
    +  +  +  +  +
    |## ## ##   |
    +--+--+--+--+
    ");
    assert_eq!(movingai::read(&MAP.replace('\n', "\r\n")), Ok(layout.clone()));
    assert_eq!(movingai::read(MAP.trim_end()), Ok(layout));
}

#[test]
fn a_bad_movingai_map_is_refused_at_its_place() {
    let bad = |from: &str, to: &str| {
        assert!(MAP.contains(from));
        refused("a.map", MAP.replacen(from, to, 1))
    };
    assert_snapshot!(bad("type octile", "type hex"),
        @"a.map:1:1: the header line `type octile` is missing here; a map begins with the lines \
          `type octile`, `height N`, `width N` and `map`");
    assert_snapshot!(bad("height 2", "height two"),
        @r#"a.map:2:8: "two" is not the number N of the header line `height N`; write a whole number from 1 to 32000"#);
    assert_snapshot!(bad("height 2\n", ""),
        @"a.map:2:1: the header line `height N` is missing here; a map begins with the lines \
          `type octile`, `height N`, `width N` and `map`");
    assert_snapshot!(bad("map\n", ""),
        @"a.map:4:1: the header line `map` is missing here; a map begins with the lines \
          `type octile`, `height N`, `width N` and `map`");
    assert_snapshot!(bad("\nwidth 4\nmap\n.GS@\nOTW.\n", ""),
        @"a.map:2:9: the header line `width N` is missing here; a map begins with the lines \
          `type octile`, `height N`, `width N` and `map`");
    assert_snapshot!(bad("height 2", "height 3"),
        @"a.map:6:5: the map ends after row 2, not 3; make `height` the number of rows that follow `map`");
    assert_snapshot!(bad("height 2", "height 1"),
        @"a.map:6:1: this is row 2, but `height` is 1; make `height` the number of rows that follow `map`");
    assert_snapshot!(bad("width 4", "width 5"),
        @"a.map:5:1: this row ends after character 4, not 5; make all rows equally long");
    assert_snapshot!(bad("OTW.", "OTW"),
        @"a.map:6:1: this row ends after character 3, not 4; make all rows equally long");
    assert_snapshot!(bad("OTW.", "OTx."),
        @r#"a.map:6:3: the symbol "x" is unknown; a cell is `.`, `G` or `S` (free), `@`, `O`, `T` or `W` (blocked)"#);
    assert_snapshot!(bad("height 2\nwidth 4", "height 31250\nwidth 32000"),
        @"a.map:2:1: the size 32000x31250 is out of bounds; a layout has 1 to 32000 \
          cells on a side and at most 16777216 in all");
    assert_snapshot!(bad("height 2\nwidth 4", "height 1000000000\nwidth 1"),
        @"a.map:2:1: the size 1x1000000000 is out of bounds; a layout has 1 to 32000 \
          cells on a side and at most 16777216 in all");
    assert_snapshot!(refused("a.map", "type octile\nheight 1\nwidth 1\nmap\nT\n"),
        @"a.map:2:1: no cell is free; leave at least one cell free for the base");
}

/// The map that the YAML and the image make together.
fn ros_map(yaml: &str, image: &[u8], named: Option<&str>) -> Result<(Layout, ros::Frame), String> {
    let folder = &folder();
    let file = folder.join("map.yaml");
    fs::write(&file, yaml).expect("a file");
    write(folder, "map.pgm", image);
    let named = named.map(|name| folder.join(name));
    ros::load(&file, named.as_deref()).map_err(|fault| plain(&fault, folder))
}

#[test]
fn a_ros_map_says_what_it_shows() {
    let dark_to_bright = b"P2\n# a comment\n4 2\n255\n0 100 205 206\n255 254 128 255\n";
    let (layout, frame) = ros_map(YAML, dark_to_bright, None).expect("a map");
    assert_snapshot!(layout, @r"
    tautline layout 1
    +--+--+--+--+
    |## ## ##   |
    +  +  +  +  +
    |      ##   |
    +--+--+--+--+
    ");
    assert_eq!(frame, ros::Frame { resolution_m: 0.05, x_m: -1.0, y_m: 2.5, yaw_rad: 0.0 });
    for negate in ["1", "true"] {
        let yaml = YAML.replace("negate: 0", &format!("negate: {negate}"));
        let (negated, _) = ros_map(&yaml, dark_to_bright, None).expect("a map");
        allow_duplicates! { assert_snapshot!(negated, @r"
        tautline layout 1
        +--+--+--+--+
        |   ## ## ##|
        +  +  +  +  +
        |## ## ## ##|
        +--+--+--+--+
        ") }
    }
    let (binary, _) = ros_map(YAML, b"P5 2 1 255\n\x00\xff", None).expect("a map");
    assert_eq!(binary.free_cells(), 1);
    let (another, _) =
        ros_map(&YAML.replace("map.pgm", "gone.png"), b"P5 2 1 255\n\xff\xff", Some("map.pgm"))
            .expect("a map");
    assert_eq!(another.free_cells(), 2);
}

#[test]
fn a_png_is_read_and_what_is_not_opaque_is_blocked() {
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, 3, 1);
    encoder.set_color(png::ColorType::Rgba);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&[255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 100]).expect("three pixels");
    writer.finish().expect("a PNG");
    let (layout, _) = ros_map(YAML, &png, None).expect("a map");
    assert_snapshot!(layout, @r"
    tautline layout 1
    +--+--+--+
    |   ## ##|
    +--+--+--+
    ");
}

#[test]
fn a_ros_map_is_the_same_however_its_yaml_is_written() {
    let image = b"P5 2 1 255\n\x00\xff";
    let plain = ros_map(YAML, image, None).expect("a map");
    for (from, to) in [
        ("map.pgm", "\"map.pgm\"  # the image"),
        ("map.pgm", "'map.pgm'\t# the image"),
        ("image:", "---\nimage:"),
        ("image:", "# by a map saver\n\nimage:"),
        ("image: ", "image:\t "),
        ("0.05", "5e-2"),
        ("0.05", "+0.050000"),
        ("[-1, 2.5, 0]", "[ -1.0,2.5 , '0' ]  # x, y, yaw"),
        ("[-1, 2.5, 0]", "\n- -1\n- 2.5\n# yaw\n- 0"),
        ("[-1, 2.5, 0]", "# below\n  - -1\n  - 2.5\n  - 0"),
        ("negate: 0", "negate: false"),
        ("negate: 0", "negate: 0\nmode: \"scale\"\nsaver: {any: [thing]}\nmore:\n  nested: &a\n  - list"),
        ("\n", "\r\n"),
        ("free_thresh: 0.196\n", "free_thresh: 0.196"),
    ] {
        assert!(YAML.contains(from));
        let yaml = YAML.replace(from, to);
        assert_eq!(ros_map(&yaml, image, None).expect(&yaml), plain, "{yaml}");
    }
}

#[test]
fn yaml_that_no_map_needs_is_refused_as_such() {
    let refused = |from: &str, to: &str| {
        assert!(YAML.contains(from));
        let fault = ros_map(&YAML.replacen(from, to, 1), b"P5 1 1 255\n\xff", None).expect_err("a fault");
        let (what, remedy) = fault.split_once("; ").expect("a remedy");
        assert!(
            remedy.starts_with("write one `key: value` a line") || remedy.starts_with("a map has the fields")
        );
        format!("{to:?} {what}")
    };
    let faults = [
        ("map.pgm", "&here map.pgm"),
        ("map.pgm", "!!str map.pgm"),
        ("map.pgm", "|\n  map.pgm"),
        ("map.pgm", "map.pgm\n  of two lines"),
        ("map.pgm", "'map.pgm"),
        ("map.pgm", "'the map''s.pgm'"),
        ("map.pgm", "\"map\\x2e.pgm\""),
        ("map.pgm", "'map'.pgm"),
        ("map.pgm", "map: pgm"),
        ("map.pgm", ""),
        ("map.pgm", "[map.pgm]"),
        ("image:", "  image:"),
        ("image:", "\"image\":"),
        ("image: map", "image:map"),
        ("image:", "? image\n:"),
        ("image:", "%YAML 1.2\n---\nimage:"),
        ("negate:", "---\nnegate:"),
        ("negate:", "image: again.pgm\nnegate:"),
        ("negate: 0", "{negate: 0}"),
        ("[-1, 2.5, 0]", "[-1, 2.5,\n  0]"),
        ("[-1, 2.5, 0]", "[-1, 2.5, 0] 1"),
        ("[-1, 2.5, 0]", "[-1, [2.5], 0]"),
        ("[-1, 2.5, 0]", "[-1, , 0]"),
        ("[-1, 2.5, 0]", "[]"),
        ("[-1, 2.5, 0]", "-1, 2.5, 0"),
        ("[-1, 2.5, 0]", "\n- -1\n- 2.5\n-0"),
        ("[-1, 2.5, 0]", "[-1, 2.5, east]"),
        ("0.05", "0x1"),
    ]
    .map(|(from, to)| refused(from, to));
    assert_snapshot!(faults.join("\n"), @r##"
    "&here map.pgm" map.yaml:1:8: this does not describe a map: this value is YAML that is not read here
    "!!str map.pgm" map.yaml:1:8: this does not describe a map: this value is YAML that is not read here
    "|\n  map.pgm" map.yaml:1:8: this does not describe a map: this value is YAML that is not read here
    "map.pgm\n  of two lines" map.yaml:2:1: this does not describe a map: this line is YAML that is not read here
    "'map.pgm" map.yaml:1:8: this does not describe a map: the text has no end on its line
    "'the map''s.pgm'" map.yaml:1:8: this does not describe a map: this value is YAML that is not read here
    "\"map\\x2e.pgm\"" map.yaml:1:8: this does not describe a map: this value is YAML that is not read here
    "'map'.pgm" map.yaml:1:13: this does not describe a map: what follows the value is YAML that is not read here
    "map: pgm" map.yaml:1:8: this does not describe a map: this value is YAML that is not read here
    "" map.yaml:1:1: this does not describe a map: --image is to have one value
    "[map.pgm]" map.yaml:1:8: this does not describe a map: --image is to have one value
    "  image:" map.yaml:1:1: this does not describe a map: this line is YAML that is not read here
    "\"image\":" map.yaml:1:1: this does not describe a map: this line is YAML that is not read here
    "image:map" map.yaml:1:1: this does not describe a map: this line is YAML that is not read here
    "? image\n:" map.yaml:1:1: this does not describe a map: this line is YAML that is not read here
    "%YAML 1.2\n---\nimage:" map.yaml:1:1: this does not describe a map: this line is YAML that is not read here
    "---\nnegate:" map.yaml:4:1: this does not describe a map: this line is YAML that is not read here
    "image: again.pgm\nnegate:" map.yaml:4:1: this does not describe a map: --image stands here again
    "{negate: 0}" map.yaml:4:1: this does not describe a map: this line is YAML that is not read here
    "[-1, 2.5,\n  0]" map.yaml:3:9: this does not describe a map: the list has no end on its line
    "[-1, 2.5, 0] 1" map.yaml:3:22: this does not describe a map: what follows the value is YAML that is not read here
    "[-1, [2.5], 0]" map.yaml:3:14: this does not describe a map: this value is YAML that is not read here
    "[-1, , 0]" map.yaml:3:14: this does not describe a map: this value is YAML that is not read here
    "[]" map.yaml:3:9: this does not describe a map: `origin` is no list of 3 numbers
    "-1, 2.5, 0" map.yaml:3:9: this does not describe a map: "-1, 2.5, 0" is no number
    "\n- -1\n- 2.5\n-0" map.yaml:6:1: this does not describe a map: this line is YAML that is not read here
    "[-1, 2.5, east]" map.yaml:3:19: this does not describe a map: "east" is no number
    "0x1" map.yaml:2:13: this does not describe a map: "0x1" is no number
    "##);
}

#[test]
fn a_bad_ros_map_is_refused_at_its_place() {
    let image = b"P5 2 1 255\n\x00\xff";
    let bad = |from: &str, to: &str| {
        assert!(YAML.contains(from));
        ros_map(&YAML.replacen(from, to, 1), image, None).expect_err("a fault")
    };
    assert_snapshot!(bad("map.pgm", "gone.png"),
        @"map.yaml:1:8: the image gone.png is not there; name another image with --image FILE");
    assert_snapshot!(bad("resolution: 0.05\n", ""),
        @"map.yaml:5:1: this does not describe a map: missing field `resolution`; a map has the fields image, \
          resolution, origin: [x, y, yaw], negate, occupied_thresh and free_thresh");
    assert_snapshot!(bad("0.05", "0"),
        @"map.yaml:2:13: `resolution` is out of bounds; write the metres of a pixel's side, from 0.000001 to 1000000");
    assert_snapshot!(bad("0.05", ".nan"),
        @"map.yaml:2:13: `resolution` is out of bounds; write the metres of a pixel's side, from 0.000001 to 1000000");
    assert_snapshot!(bad("0.05", "1e308"),
        @"map.yaml:2:13: `resolution` is out of bounds; write the metres of a pixel's side, from 0.000001 to 1000000");
    assert_snapshot!(bad("0.05", "[1"),
        @"map.yaml:2:13: this does not describe a map: the list has no end on its line; write one `key: value` a line, \
          where a value is a word, a text between quotes, or a list such as [0, 0, 0]");
    assert_snapshot!(bad("[-1, 2.5, 0]", "[-1, 2.5]"),
        @"map.yaml:3:9: this does not describe a map: `origin` is no list of 3 numbers; a map has the fields image, \
          resolution, origin: [x, y, yaw], negate, occupied_thresh and free_thresh");
    assert_snapshot!(bad("[-1, 2.5, 0]", "[-1, 2.5, .inf]"),
        @"map.yaml:3:9: `origin` is out of bounds; write x and y in metres and \
          the yaw in radians, each at most 1000000000");
    assert_snapshot!(bad("[-1, 2.5, 0]", "[-1e300, 2.5, 0]"),
        @"map.yaml:3:9: `origin` is out of bounds; write x and y in metres and \
          the yaw in radians, each at most 1000000000");
    assert_snapshot!(bad("negate: 0", "negate: 2"), @"map.yaml:4:9: `negate` is out of bounds; write 0 or 1");
    assert_snapshot!(bad("negate: 0", "negate: perhaps"),
        @"map.yaml:4:9: this does not describe a map: expected 0 or 1; a map has the fields image, resolution, origin: \
          [x, y, yaw], negate, occupied_thresh and free_thresh");
    assert_snapshot!(bad("0.65", "1.5"),
        @"map.yaml:5:18: `occupied_thresh` is out of bounds; write a number from 0 to 1");
    assert_snapshot!(bad("0.196", "0.7"),
        @"map.yaml:6:14: `free_thresh` is out of bounds; write a number from 0 to `occupied_thresh`");
    assert_snapshot!(bad("negate: 0", "negate: 0\nmode: raw"),
        @r#"map.yaml:5:7: the mode "raw" is not supported; save the map in mode trinary or scale"#);
    assert_snapshot!(ros_map(YAML, image, Some("gone.pgm")).expect_err("a fault"),
        @"the image gone.pgm is not there; name another image with --image FILE");

    let bad = |image: &[u8]| ros_map(YAML, image, None).expect_err("a fault");
    assert_snapshot!(bad(b""), @"map.pgm: the image cannot be read: the file is empty; give a whole PGM or PNG file");
    assert_snapshot!(bad(b"neither"),
        @"map.pgm: the image cannot be read: it is neither PGM nor PNG; give a whole PGM or PNG file");
    assert_snapshot!(bad(b"GIF89a"),
        @"map.pgm: the image cannot be read: it is neither PGM nor PNG; give a whole PGM or PNG file");
    assert_snapshot!(bad(b"P5 2 2 255\n\x00\xff"),
        @"map.pgm: the image cannot be read: it ends before its last pixel; give a whole PGM or PNG file");
    assert_snapshot!(bad(b"P2 2 1 255\n254 -3\n"),
        @"map.pgm: the image cannot be read: before its last pixel it ends, or has something that \
          is no number; give a whole PGM or PNG file");
    assert_snapshot!(bad(b"P2 2 1 255\n254 300\n"),
        @"map.pgm: the image cannot be read: a pixel is above its largest level; give a whole PGM or PNG file");
    assert_snapshot!(bad(b"P5 2 1 100\n\x10\xff"),
        @"map.pgm: the image cannot be read: a pixel is above its largest level; give a whole PGM or PNG file");
    assert_snapshot!(bad(b"P5\r\n2 1\r\n255\r\n\xff\xff"),
        @"map.pgm: the image cannot be read: its header ends in CR LF, and the LF would be its \
          first pixel; give a whole PGM or PNG file");
    assert_snapshot!(bad(b"P5 32000 31250 255\n\x00\xff"),
        @"map.pgm: the size 32000x31250 is out of bounds; a layout has 1 to 32000 \
          cells on a side and at most 16777216 in all");
    assert_snapshot!(bad(b"P5 2 1 255\n\x00\x00"),
        @"map.pgm: no cell is free; leave at least one cell free for the base");
}

#[test]
fn a_file_that_is_no_layout_is_refused() {
    assert_snapshot!(refused("a.txt", ""), @"a.txt: the file is empty; a drawing begins with `tautline layout 1`");
    assert_snapshot!(refused("a.txt", b"tautline \xff"),
        @"a.txt: byte 9 is not UTF-8 text; a layout is a drawing, a MovingAI map or a ROS map's .yaml file");
    assert_snapshot!(refused("a.pgm", "P2 1 1 255 0"),
        @"a.pgm: this is an image alone; name the .yaml file that describes it");
    assert_snapshot!(refused("a.txt", "\u{1b}[31mred"),
        @"a.txt:1:1: this is not the first line of a layout; a drawing begins with `tautline layout 1`; \
          name MovingAI maps .map and ROS maps .yaml");
    let load = |description: &str, image| {
        with_flags(&layout::load(description, 0, image).expect_err("a fault").to_string())
    };
    assert_snapshot!(load("no/such/file.map", None),
        @"no/such/file.map: there is no such file; name a layout file or one of the generators open:15x15, \
          walls:15x15:0.1, rooms-a, rooms-b, office:30x30:4x4, cells:32x32:0.2");
    assert_snapshot!(load("src", None),
        @"src: this is a folder; name a layout file or one of the generators open:15x15, walls:15x15:0.1, rooms-a, \
          rooms-b, office:30x30:4x4, cells:32x32:0.2");
    assert_snapshot!(load("open:3x3", Some(Path::new("map.pgm"))),
        @"--image is given, but the layout is not a ROS map; leave --image out, or name the map's .yaml file");

    let folder = &folder();
    let file = folder.join("large.map");
    fs::File::create(&file).and_then(|large| large.set_len(MAX_FILE_BYTES + 1)).expect("a file");
    let fault = layout::load(file.to_str().expect("a name"), 0, None).expect_err("a fault");
    assert_snapshot!(plain(&fault, folder),
        @"large.map: the file has more than 128 MiB; a layout has 1 to 32000 \
          cells on a side and at most 16777216 in all");
}

#[test]
fn the_drawing_of_the_largest_layout_is_not_too_large_to_be_read() {
    for width in [1_u64, 600, 4_096, 32_000] {
        let height = (layout::MAX_CELLS / width).min(layout::MAX_SIDE_CELLS);
        let lines = ["tautline layout 1", "robots 65535"].map(|line| line.len() as u64 + 2);
        let bytes = lines.iter().sum::<u64>() + (3 * width + 1 + 2) * (2 * height + 1);
        assert!(bytes < MAX_FILE_BYTES, "{width}x{height}: {bytes}");
    }
}

#[test]
fn a_description_that_is_no_generator_is_refused() {
    let load = |description| layout::load(description, 0, None).expect_err("a fault").to_string();
    assert_snapshot!(load("opn:3x3"),
        @r#""opn:3x3" names no generator; the generators are open:15x15, walls:15x15:0.1, rooms-a, rooms-b, office:30x30:4x4, cells:32x32:0.2"#);
    assert_snapshot!(load("walls:15x15"),
        @r#""walls:15x15" is not a whole description; write walls:WIDTHxHEIGHT:PROBABILITY, for example walls:15x15:0.1"#);
    assert_snapshot!(load("walls"),
        @r#""walls" is not a whole description; write walls:WIDTHxHEIGHT:PROBABILITY, for example walls:15x15:0.1"#);
    assert_snapshot!(load("walls:15x15:1.5"),
        @r#""1.5" is no probability; write a number from 0 to 1, for example 0.1"#);
    assert_snapshot!(load("cells:15x15:NaN"),
        @r#""NaN" is no probability; write a number from 0 to 1, for example 0.1"#);
    assert_snapshot!(load("open:15"),
        @r#""open:15" is not a whole description; write open:WIDTHxHEIGHT, for example open:15x15"#);
    assert_snapshot!(load("open:0x5"),
        @"the size 0x5 is out of bounds; a layout has 1 to 32000 cells on a side and at most 16777216 in all");
    assert_snapshot!(load("open:32000x31250"),
        @"the size 32000x31250 is out of bounds; a layout has 1 to 32000 cells on a side and at most 16777216 in all");
    assert_snapshot!(load("rooms-a:3x3"), @r#""rooms-a:3x3" is not a whole description; write rooms-a"#);
    assert_snapshot!(load("office:4x4:5x1"),
        @"4x4 cells cannot hold 5x1 rooms; at least one room each way, and at most one for each column and row");
    assert_snapshot!(load("office:4x4:0x1"),
        @"4x4 cells cannot hold 0x1 rooms; at least one room each way, and at most one for each column and row");
    assert_snapshot!(load("cells:3x3:1"), @"no cell is free; leave at least one cell free for the base");
}

#[test]
fn a_generator_is_written_as_it_was_described() {
    for description in
        ["open:15x10", "walls:15x15:0.1", "rooms-a", "rooms-b", "office:30x20:4x3", "cells:32x32:0.2"]
    {
        assert_eq!(
            description.parse::<Generator>().map(|generator| generator.to_string()),
            Ok(description.to_owned())
        );
    }
}

#[test]
fn the_same_seed_makes_the_same_layout() {
    assert_snapshot!(made("walls:6x3:0.3", 1), @r"
    tautline layout 1
    +--+--+--+--+--+--+
    |  |        |     |
    +--+  +  +  +  +  +
    |              |  |
    +  +--+  +  +--+  +
    |  |     |        |
    +--+--+--+--+--+--+
    ");
    assert_snapshot!(made("cells:6x3:0.3", 1), @r"
    tautline layout 1
    +--+--+--+--+--+--+
    |##    ##       ##|
    +  +  +  +  +  +  +
    |##       ##    ##|
    +  +  +  +  +  +  +
    |                 |
    +--+--+--+--+--+--+
    ");
    assert_snapshot!(made("office:7x5:3x2", 1), @r"
    tautline layout 1
    +--+--+--+--+--+--+--+
    |        |     |     |
    +  +  +  +  +  +  +  +
    |        |           |
    +  +  +  +  +  +  +  +
    |              |     |
    +--+  +--+  +--+--+  +
    |              |     |
    +  +  +  +  +  +  +  +
    |        |           |
    +--+--+--+--+--+--+--+
    ");
    assert_ne!(made("walls:6x3:0.3", 1), made("walls:6x3:0.3", 2));
    assert_eq!(made("walls:4x4:0", 1), made("open:4x4", 1));
    assert_eq!(made("walls:4x4:1", 1).walls().count(), 24);
}

/// Where the columns and the rows of an office are divided: its lines of walls, each with a door for every room.
fn divisions(layout: &Layout, across: i16, down: i16) -> [Vec<i16>; 2] {
    let (width, height) = (layout.width(), layout.height());
    let west = |x, y| layout.has_wall(Edge::new(Cell::new(x, y), Side::West));
    let north = |x, y| layout.has_wall(Edge::new(Cell::new(x, y), Side::North));
    let columns = (1..width).filter(|&x| (0..height).filter(|&y| west(x, y)).count() as i16 == height - down);
    let rows = (1..height).filter(|&y| (0..width).filter(|&x| north(x, y)).count() as i16 == width - across);
    [columns.collect(), rows.collect()]
}

/// The cells between divisions.
fn between(divisions: &[i16], cells: i16) -> Vec<i16> {
    let ends = divisions.iter().copied().chain([cells]);
    let starts = [0].into_iter().chain(divisions.iter().copied());
    starts.zip(ends).map(|(start, end)| end - start).collect()
}

#[test]
fn rooms_of_an_office_are_three_cells_wide_or_as_wide_as_all_can_be() {
    for (description, across, down, least) in [
        ("office:30x30:4x4", 4, 4, [3, 3]),
        ("office:12x20:4x3", 4, 3, [3, 3]),
        ("office:11x7:4x3", 4, 3, [2, 2]),
        ("office:9x40:1x13", 1, 13, [9, 3]),
    ] {
        for seed in 0..50 {
            let layout = made(description, seed);
            let [columns, rows] = divisions(&layout, across, down);
            let place = format!("{description}, seed {seed}");
            assert_eq!((columns.len() as i16, rows.len() as i16), (across - 1, down - 1), "{place}");
            assert!(between(&columns, layout.width()).iter().all(|&cells| cells >= least[0]), "{place}");
            assert!(between(&rows, layout.height()).iter().all(|&cells| cells >= least[1]), "{place}");
            // A wall between any two rooms is whole but for one door.
            let (lines, doors) = (
                (across - 1) * layout.height() + (down - 1) * layout.width(),
                (across - 1) * down + (down - 1) * across,
            );
            assert_eq!(layout.walls().count() as i16, lines - doors, "{place}");
            assert_eq!(reached(&layout), layout.free_cells(), "{place}");
        }
    }
    // Rooms of one cell are all doors.
    for seed in 0..5 {
        assert_eq!(made("office:4x3:4x3", seed), made("open:4x3", 0));
        assert_eq!(made("office:1x1:1x1", seed), made("open:1x1", 0));
        assert_eq!(made("office:9x9:1x1", seed), made("open:9x9", 0));
        assert_eq!(made("office:1x9:1x4", seed), made("open:1x9", 0));
    }
}

#[test]
fn all_ways_to_divide_an_office_are_as_likely() {
    // Ten columns of three rooms, each at least three: the spare column goes to one of them.
    // Eight rows of two rooms: 3 and 5, 4 and 4, 5 and 3.
    let mut counts = BTreeMap::new();
    for seed in 0..900 {
        let divided = divisions(&made("office:10x8:3x2", seed), 3, 2);
        *counts.entry(divided).or_insert(0_u32) += 1;
    }
    let ways = |divisions: &[Vec<i16>; 2]| (between(&divisions[0], 10), between(&divisions[1], 8));
    assert_eq!(counts.keys().map(ways).collect::<BTreeSet<_>>().len(), 9);
    // 100 each, with a standard deviation of 9.4.
    assert!(counts.values().all(|count| (65..=135).contains(count)), "{counts:?}");
}

#[test]
fn every_seed_makes_another_office() {
    let offices: BTreeSet<String> = (0..500).map(|seed| made("office:30x30:4x4", seed).to_string()).collect();
    assert_eq!(offices.len(), 500);
    let lines: BTreeSet<[Vec<i16>; 2]> =
        (0..500).map(|seed| divisions(&made("office:30x30:4x4", seed), 4, 4)).collect();
    assert!(lines.len() > 490, "{}", lines.len());
}

#[test]
fn buildings_are_connected() {
    for description in ["rooms-a", "rooms-b"] {
        let layout = made(description, 0);
        assert_eq!((layout.width(), layout.height(), reached(&layout)), (15, 15, 225), "{description}");
    }
    for seed in 0..50 {
        assert_eq!(reached(&made("office:17x11:4x5", seed)), 187, "seed {seed}");
    }
    assert_snapshot!(made("rooms-a", 0), @r"
    tautline layout 1
    +--+--+--+--+--+--+--+--+--+--+--+--+--+--+--+
    |                    |                       |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |                    |                       |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |                    |                       |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |                    |                       |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |                    |                       |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |                    |                       |
    +--+--+--+  +--+--+--+--+--+--+  +--+--+--+--+
    |                                   |        |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |                                            |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |                                   |        |
    +--+--+--+--+--+  +--+--+--+--+--+  +--+--+--+
    |                          |                 |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |                          |                 |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |                          |                 |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |                                            |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |                          |                 |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |                          |                 |
    +--+--+--+--+--+--+--+--+--+--+--+--+--+--+--+
    ");
    assert_snapshot!(made("rooms-b", 0), @r"
    tautline layout 1
    +--+--+--+--+--+--+--+--+--+--+--+--+--+--+--+
    |        |        |        |        |        |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |        |        |                 |        |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |        |        |        |        |        |
    +--+  +--+  +--+--+--+--+  +--+  +--+--+  +--+
    |        |        |        |        |        |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |        |        |        |        |        |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |                 |        |        |        |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |        |        |        |        |        |
    +  +--+--+--+  +--+--+  +--+--+--+  +  +--+--+
    |                                            |
    +--+--+  +--+  +--+  +--+--+--+  +--+--+--+  +
    |        |        |        |        |        |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |        |                 |        |        |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |        |        |        |        |        |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |        |        |        |        |        |
    +--+  +--+--+--+  +--+  +--+  +--+--+  +--+--+
    |        |        |        |        |        |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |        |        |        |                 |
    +  +  +  +  +  +  +  +  +  +  +  +  +  +  +  +
    |        |        |        |        |        |
    +--+--+--+--+--+--+--+--+--+--+--+--+--+--+--+
    ");
}

#[test]
fn a_fault_shows_its_spot() {
    let source = DRAWING.replace("##", "#é");
    let at = source.find("#é").expect("the spot");
    let fault =
        Diagnostic::at("arena.txt", &source, at..at + 3, "the symbol \"#é\" is unknown", "write `##`");
    assert_snapshot!(shown(&fault), @r##"
    Error: the symbol "#é" is unknown
       ╭─[ arena.txt:6:8 ]
       │
     6 │ |   B  #é|
       │        ─┬
       │         ╰── here
       │
       │ Help: write `##`
    ───╯
    "##);
    assert!(!render(&fault, Colour::Plain).contains('\u{1b}'));
    assert!(render(&fault, Colour::Ansi).contains('\u{1b}'));
    assert_snapshot!(shown(&Diagnostic::usage("too many robots", "give at most 9")), @r"
    Error: too many robots
     Help: give at most 9
    ");
    assert_snapshot!(shown(&Diagnostic::in_file("a.txt", "empty", "fill it")), @r"
    Error: a.txt: empty
     Help: fill it
    ");
}

#[test]
fn a_fault_in_a_large_text_keeps_its_neighbourhood_only() {
    let line = "0123456789".repeat(1_000_000);
    let source = format!("{}{line}", "\n".repeat(99_999));
    let fault = Diagnostic::at("trace.jsonl", &source, 5_099_999..5_100_000, "wrong", "right");
    assert_snapshot!(shown(&fault), @r"
    Error: wrong
            ╭─[ trace.jsonl:100000:5000001 ]
            │
     100000 │ …89012345678901234567890123456789012345678901234567890123456789012…
            │                                  ┬
            │                                  ╰── here
            │
            │ Help: right
    ────────╯
    ");
    assert!(format!("{fault:?}").len() < 1_000);
    let end = Diagnostic::at("trace.jsonl", "{}\n", 3..3, "the trace ends here", "give it whole");
    assert_snapshot!(shown(&end), @r"
    Error: the trace ends here
       ╭─[ trace.jsonl:2:1 ]
       │
     2 │
       │ ┬
       │ ╰── here
       │
       │ Help: give it whole
    ───╯
    ");
}

/// The folder of published maps, if there is one here.
fn maps() -> Option<PathBuf> {
    let folder = std::env::var_os("TAUTLINE_MAPS").map(PathBuf::from);
    if folder.is_none() {
        // Past the capture of the test harness, so that a skipped test is seen.
        writeln!(io::stderr(), "skipped: TAUTLINE_MAPS names no folder of maps").expect("stderr");
    }
    folder
}

#[test]
fn published_movingai_maps_are_read() {
    let Some(folder) = maps() else { return };
    let mut files: Vec<PathBuf> = fs::read_dir(&folder)
        .expect("the folder of TAUTLINE_MAPS")
        .map(|entry| entry.expect("a file").path())
        .filter(|file| file.extension().is_some_and(|extension| extension == "map"))
        .collect();
    files.sort();
    let lines: Vec<String> = files
        .iter()
        .map(|file| {
            let layout = layout::load(file.to_str().expect("a name"), 0, None).expect("a map");
            let base = layout.default_base().expect("a free cell");
            let name = file.file_name().expect("a name").to_string_lossy();
            assert_eq!(layout.to_string().parse().as_ref(), Ok(&layout), "{name}");
            format!("{name}: {}, {} free, base {base}", layout.size(), layout.free_cells())
        })
        .collect();
    assert_snapshot!(lines.join("\n"), @r"
    32room_000.map: 512x512, 240671 free, base 255,255
    Berlin_1_256.map: 256x256, 47540 free, base 127,127
    Boston_0_512.map: 512x512, 196725 free, base 255,255
    den312d.map: 65x81, 2445 free, base 32,40
    empty-16-16.map: 16x16, 256 free, base 7,7
    ht_chantry.map: 162x141, 7461 free, base 80,70
    lak303d.map: 194x194, 14784 free, base 96,96
    maze-32-32-2.map: 32x32, 666 free, base 16,15
    maze512-8-0.map: 512x512, 232931 free, base 255,255
    random-32-32-20.map: 32x32, 819 free, base 16,15
    random512-10-0.map: 512x512, 235900 free, base 255,255
    room-32-32-4.map: 32x32, 682 free, base 15,15
    room-64-64-8.map: 64x64, 3232 free, base 31,31
    warehouse-10-20-10-2-1.map: 161x63, 5699 free, base 80,31
    ");
}

#[test]
fn published_ros_maps_are_read_or_refused() {
    let Some(folder) = maps() else { return };
    let folder = folder.join("ros");
    let load = |file: &str, image: Option<&str>| {
        let image = image.map(|image| folder.join(image));
        match ros::load(&folder.join(file), image.as_deref()) {
            Ok((layout, frame)) => format!(
                "{}, {} free, {} m from {},{} yaw {}",
                layout.size(),
                layout.free_cells(),
                frame.resolution_m,
                frame.x_m,
                frame.y_m,
                frame.yaw_rad
            ),
            Err(fault) => plain(&fault, &folder),
        }
    };
    assert_snapshot!(load("depot.yaml", None), @"604x307, 179481 free, 0.05 m from 0,0 yaw 0");
    assert_snapshot!(load("tb3_map.yaml", None),
        @"tb3_map.yaml:1:8: the image map.pgm is not there; name another image with --image FILE");
    assert_snapshot!(load("tb3_map.yaml", Some("tb3_map.pgm")), @"384x384, 7939 free, 0.05 m from -10,-10 yaw 0");
    assert_snapshot!(load("testmap.yaml", None),
        @"testmap.yaml:1:8: the image testmap.png is not there; name another image with --image FILE");
    assert_snapshot!(load("testmap.yaml", Some("testmap.pgm")), @"10x10, 71 free, 0.1 m from 2,3 yaw 1");
    let (testmap, _) =
        ros::load(&folder.join("testmap.yaml"), Some(&folder.join("testmap.pgm"))).expect("a map");
    assert_snapshot!(testmap, @r"
    tautline layout 1
    +--+--+--+--+--+--+--+--+--+--+
    |##                           |
    +  +  +  +  +  +  +  +  +  +  +
    |##                ## ##      |
    +  +  +  +  +  +  +  +  +  +  +
    |##                ## ##      |
    +  +  +  +  +  +  +  +  +  +  +
    |##                ## ##      |
    +  +  +  +  +  +  +  +  +  +  +
    |##                ## ##      |
    +  +  +  +  +  +  +  +  +  +  +
    |##                           |
    +  +  +  +  +  +  +  +  +  +  +
    |##                           |
    +  +  +  +  +  +  +  +  +  +  +
    |## ## ## ##       ## ## ##   |
    +  +  +  +  +  +  +  +  +  +  +
    |## ## ## ##       ## ## ##   |
    +  +  +  +  +  +  +  +  +  +  +
    |                             |
    +--+--+--+--+--+--+--+--+--+--+
    ");
}
