//! Recordings, read back by the reader of the format's own crate, are equal to the trace of the same run.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use mcap::MessageStream;
use serde_json::{Value, json};

use crate::folder::folder;

fn ran(folder: &Path, arguments: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tautline"));
    command.current_dir(folder).args(arguments.split(' ')).output().expect("the program runs")
}

/// Reads a message in CDR from its first value on.
struct Cdr<'a>(&'a [u8], usize);

impl Cdr<'_> {
    fn of(data: &[u8]) -> Cdr<'_> {
        assert_eq!(data[..4], [0, 1, 0, 0]);
        Cdr(&data[4..], 0)
    }

    fn take<const N: usize>(&mut self) -> [u8; N] {
        self.1 = self.1.next_multiple_of(N);
        let bytes = self.0[self.1..self.1 + N].try_into().expect("so many");
        self.1 += N;
        bytes
    }

    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take())
    }

    fn f64(&mut self) -> f64 {
        f64::from_le_bytes(self.take())
    }

    fn text(&mut self) -> String {
        let bytes: Vec<u8> = self.list(|cdr| cdr.take::<1>()[0]);
        let (&end, text) = bytes.split_last().expect("a zero at its end");
        assert_eq!(end, 0);
        String::from_utf8(text.to_vec()).expect("text")
    }

    fn list<T>(&mut self, mut item: impl FnMut(&mut Self) -> T) -> Vec<T> {
        (0..self.u32()).map(|_| item(self)).collect()
    }

    /// The seconds of the header.
    fn header(&mut self) -> u32 {
        let seconds = self.u32();
        assert_eq!((self.u32(), self.text().as_str()), (0, "map"));
        seconds
    }

    /// Nothing is left.
    fn end(self) {
        assert_eq!(self.1, self.0.len());
    }
}

/// The content of a recording.
#[derive(Default)]
struct Read {
    /// As the lines of a trace.
    moves: Vec<Value>,
    end: Value,
    layout: Vec<i8>,
    /// The map with all updates, and how often it was sent whole and in parts.
    map: Vec<i8>,
    sent: [u32; 2],
    /// By topic: the type.
    kinds: BTreeMap<String, String>,
    /// The places of the robots, in metres, after each team move.
    robots: Vec<Vec<[f64; 2]>>,
    /// How many links there are, and how many are lost.
    links: Vec<[usize; 2]>,
}

fn grid(cdr: &mut Cdr<'_>) -> ([u32; 2], Vec<i8>) {
    cdr.header();
    assert_eq!([cdr.u32(), cdr.u32()], [0, 0]);
    assert_eq!(f32::from_le_bytes(cdr.take()).to_bits(), 0.5_f32.to_bits());
    let size = [cdr.u32(), cdr.u32()];
    let _origin: [f64; 7] = std::array::from_fn(|_| cdr.f64());
    (size, cdr.list(|cdr| i8::from_le_bytes(cdr.take())))
}

fn team_move(cdr: &mut Cdr<'_>) -> Value {
    let time = cdr.header();
    let step = cdr.u32();
    assert_eq!(time, step);
    let (kind, tried) = (cdr.text(), cdr.text());
    let blocked = cdr.list(|cdr| cdr.take::<1>() == [1]);
    let blocked: Vec<usize> = (1..).zip(blocked).filter(|(_, is)| *is).map(|(robot, _)| robot).collect();
    let cells = cdr.list(|cdr| [cdr.u32(), cdr.u32()]);
    let _broken = cdr.list(Cdr::text);
    let (title, again) = (cdr.text(), cdr.take::<1>() == [1]);
    assert_eq!((title.as_str(), again), ("", false), "robots that count from 1 have no titles");
    json!({ "move": { "step": step, "kind": kind, "tried": tried, "blocked": blocked, "cells": cells } })
}

fn end(cdr: &mut Cdr<'_>) -> Value {
    cdr.header();
    let stopped = cdr.text();
    let [steps, explored, cells] = [cdr.u32(), cdr.u32(), cdr.u32()];
    let violations = cdr.list(|cdr| json!({ "clause": cdr.text(), "step": cdr.u32() }));
    json!({ "end": { "stopped": stopped, "steps": steps, "explored": explored, "cells": cells,
                     "violations": violations } })
}

fn read(bytes: &[u8]) -> Read {
    let (mut read, mut width, mut last) = (Read::default(), 0, 0);
    for message in MessageStream::new(bytes).expect("a recording") {
        let message = message.expect("a message");
        assert!(message.log_time >= last, "messages are in the order of time");
        last = message.log_time;
        let schema = message.channel.schema.as_ref().expect("a type");
        assert_eq!((schema.encoding.as_str(), message.channel.message_encoding.as_str()), ("ros2msg", "cdr"));
        read.kinds.insert(message.channel.topic.clone(), schema.name.clone());
        let mut cdr = Cdr::of(&message.data);
        match message.channel.topic.as_str() {
            "/layout" => read.layout = grid(&mut cdr).1,
            "/map" => {
                let ([columns, _], values) = grid(&mut cdr);
                if !read.map.is_empty() && read.sent[1] > 0 {
                    assert_eq!(read.map, values, "the updates lead to the map that is sent whole");
                }
                (width, read.map) = (columns as usize, values);
                read.sent[0] += 1;
            }
            "/map_updates" => {
                cdr.header();
                let [x, y, columns, rows] = std::array::from_fn(|_| cdr.u32() as usize);
                let values = cdr.list(|cdr| i8::from_le_bytes(cdr.take()));
                assert_eq!(values.len(), columns * rows);
                for (row, values) in values.chunks(columns).enumerate() {
                    let start = (y + row) * width + x;
                    read.map[start..start + columns].copy_from_slice(values);
                }
                read.sent[1] += 1;
            }
            "/robots" => {
                cdr.header();
                read.robots.push(cdr.list(|cdr| {
                    let [x, y, ..]: [f64; 7] = std::array::from_fn(|_| cdr.f64());
                    [x, y]
                }));
            }
            "/team_move" => read.moves.push(team_move(&mut cdr)),
            "/end" => read.end = end(&mut cdr),
            "/links" => {
                cdr.header();
                let _name = cdr.text();
                let _id_kind_and_action = [cdr.u32(), cdr.u32(), cdr.u32()];
                let _pose_and_scale: [f64; 10] = std::array::from_fn(|_| cdr.f64());
                let colour = |cdr: &mut Cdr<'_>| <[u32; 4]>::from_fn(|_| cdr.u32());
                let lost = colour(&mut cdr);
                let _lifetime = [cdr.u32(), cdr.u32()];
                cdr.take::<1>();
                let points = cdr.list(|cdr| <[f64; 3]>::from_fn(|_| cdr.f64()));
                let colours = cdr.list(colour);
                assert_eq!(points.len(), colours.len());
                let is_lost = colours.iter().filter(|colour| **colour == lost).count();
                read.links.push([points.len() / 2, is_lost / 2]);
                continue;
            }
            topic => panic!("{topic}"),
        }
        cdr.end();
    }
    read
}

/// An array by its places.
trait FromFn<T> {
    fn from_fn(of: impl FnMut(usize) -> T) -> Self;
}

impl<T, const N: usize> FromFn<T> for [T; N] {
    fn from_fn(of: impl FnMut(usize) -> T) -> Self {
        std::array::from_fn(of)
    }
}

#[test]
fn a_recording_reads_back_equal_to_the_trace_and_is_the_same_bytes_each_time() {
    let folder = &folder();
    for run in [
        "open:7x7 --robots 4",
        "walls:15x15:0.15 --robots 6 --seed 3 --rule published",
        "cells:8x8:0.2 --scheme bricks --robots 3 --seed 1",
        "walls:5x5:0.1 --scheme kit --robots 2",
        "cells:6x6:0.1 --scheme frontier --robots 2",
        "open:7x7 --scheme full-search --robots 4",
        "walls:40x40:0.1 --robots 5 --max-moves 300",
    ] {
        let made = ran(folder, &format!("explore {run} --trace run.jsonl --mcap run.mcap"));
        assert!(made.status.code().is_some_and(|code| code < 2), "{}", String::from_utf8_lossy(&made.stderr));
        let bytes = fs::read(folder.join("run.mcap")).expect("a recording");
        let read = read(&bytes);
        let trace = fs::read_to_string(folder.join("run.jsonl")).expect("a trace");
        let mut lines = trace.lines().map(|line| serde_json::from_str::<Value>(line).expect("JSON"));
        let header = lines.next().expect("a header");
        let (end, moves) = lines
            .collect::<Vec<_>>()
            .split_last()
            .map(|(end, moves)| (end.clone(), moves.to_vec()))
            .expect("an end");
        assert_eq!(read.moves, moves, "{run}");
        assert_eq!(read.end, end, "{run}");
        // Robots stand in the middle of their cells.
        let rows = u32::try_from(
            header["layout"]
                .as_str()
                .expect("a drawing")
                .lines()
                .filter(|line| line.starts_with('|'))
                .count(),
        )
        .expect("few rows");
        for (robots, made) in read.robots[1..].iter().zip(&moves) {
            let cells = made["move"]["cells"].as_array().expect("cells");
            let middle = |cell: &Value| {
                let [x, y] = [&cell[0], &cell[1]].map(|number| number.as_f64().expect("a number"));
                [x + 0.5, f64::from(rows) - y - 0.5]
            };
            assert_eq!(*robots, cells.iter().map(middle).collect::<Vec<_>>(), "{run}");
        }
        // What the team knows is so, and it knows at least where it was.
        assert_eq!(read.map.len(), read.layout.len());
        assert!(read.map.iter().zip(&read.layout).all(|(known, is)| known == is || *known == -1), "{run}");
        assert!(read.map.iter().filter(|known| **known == 0).count() > moves.len().min(20));
        let is_large = read.map.len() > 64 * 64;
        assert_eq!(is_large, read.sent[1] > 0, "{run}: {:?}", read.sent);
        // The same command replaces its own file, and a stored run gives the same bytes.
        ran(folder, &format!("explore {run} --mcap run.mcap"));
        assert_eq!(fs::read(folder.join("run.mcap")).expect("a recording"), bytes, "{run}");
        ran(folder, "replay run.jsonl --mcap again.mcap");
        assert!(fs::read(folder.join("again.mcap")).expect("a recording") == bytes, "{run}");
    }
}

#[test]
fn the_links_of_a_recording_are_those_of_the_scheme() {
    let folder = &folder();
    let recorded = |arguments: &str| {
        ran(folder, &format!("{arguments} --mcap run.mcap"));
        read(&fs::read(folder.join("run.mcap")).expect("a recording"))
    };
    let chain = recorded("explore open:7x7 --robots 4");
    assert!(chain.links.len() == chain.robots.len() && chain.links.iter().all(|links| *links == [3, 0]));
    assert_eq!(chain.kinds["/links"], "visualization_msgs/msg/Marker");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).display().to_string();
    // Two robots are out of contact at the end, and not before.
    let lost = recorded(&format!("replay {root}/docs/chain-1-published-n4.jsonl"));
    let (last, before) = lost.links.split_last().expect("links");
    assert!(*last == [3, 1] && before.iter().all(|links| *links == [3, 0]), "{:?}", lost.links);
    assert!(!recorded("explore cells:6x6:0.1 --scheme ants --max-moves 20").kinds.contains_key("/links"));
}

#[test]
fn the_recording_of_a_rescue_has_the_lines_of_its_trace_and_the_places_of_its_robots() {
    let folder = &folder();
    let rescue = "rescue --nodes 300 --wfr 2 --robots 2 --obstacle 100,100,150,150 --seeds 8";
    ran(folder, &format!("{rescue} --trace rescue.jsonl --mcap rescue.mcap"));
    let bytes = fs::read(folder.join("rescue.mcap")).expect("a recording");
    let trace = fs::read_to_string(folder.join("rescue.jsonl")).expect("a trace");
    let (mut lines, mut robots, mut topics) = (Vec::new(), BTreeMap::new(), BTreeSet::new());
    for message in MessageStream::new(&bytes).expect("a recording") {
        let message = message.expect("a message");
        let mut cdr = Cdr::of(&message.data);
        let stamp = u64::from(cdr.u32()) * 1_000_000_000 + u64::from(cdr.u32());
        assert_eq!((stamp, cdr.text().as_str()), (message.log_time, "map"));
        match message.channel.topic.as_str() {
            "/event" | "/end" => lines.push(cdr.text()),
            "/robots" => {
                let places = cdr.list(|cdr| {
                    let [x, y, _, _, _, z, w]: [f64; 7] = std::array::from_fn(|_| cdr.f64());
                    assert!((z * z + w * w - 1.0).abs() < 1e-9, "a direction");
                    [x, y]
                });
                assert_eq!(places.len(), 2);
                robots.insert(stamp, places);
            }
            topic => assert!(topics.insert(topic.to_owned()), "{topic} stands still"),
        }
    }
    assert_eq!(lines, trace.lines().skip(1).collect::<Vec<_>>());
    assert_eq!(topics.into_iter().collect::<Vec<_>>(), ["/nodes", "/obstacles", "/wfrs"]);
    // Where a robot sets out and arrives, it is at that time. What it passes is told up to a step ahead.
    let mut compared = 0;
    for line in trace.lines() {
        let line: Value = serde_json::from_str(line).expect("JSON");
        let Some(at_ns) = line["at_ns"].as_u64() else { continue };
        for name in ["sets-out", "arrives"] {
            let of = &line[name];
            let (Some(robot), Some(at)) = (of["robot"].as_u64(), of["at"].as_array()) else { continue };
            let [x, y] = robots[&at_ns][robot as usize - 1];
            let [east, south] = [&at[0], &at[1]].map(|side| side.as_f64().expect("a number") / 1000.0);
            assert!((x - east).abs() < 0.001 && (300.0 - y - south).abs() < 0.001, "{line}: {x}, {y}");
            compared += 1;
        }
    }
    assert!(compared >= 4, "{compared}");
    ran(folder, "replay rescue.jsonl --mcap again.mcap");
    assert!(fs::read(folder.join("again.mcap")).expect("a recording") == bytes);
}

#[test]
fn what_has_no_team_moves_has_no_trace_of_them() {
    let folder = &folder();
    let refused = |arguments: &str, what: &str| {
        let refused = ran(folder, arguments);
        let said = String::from_utf8_lossy(&refused.stderr);
        assert_eq!(refused.status.code(), Some(2), "{said}");
        assert!(said.contains(what), "{said}");
        assert!(!folder.join("run.out").exists());
    };
    assert_eq!(ran(folder, "rescue --nodes 300 --seeds 8 --trace rescue.jsonl").status.code(), Some(0));
    refused("replay rescue.jsonl --itf run.out", "a rescue has no team moves for --itf");
    refused("rescue --nodes 300 --seeds 8..9 --mcap run.out", "several rescues do not fit into one file");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).display().to_string();
    refused(
        &format!("replay {root}/docs/kit-7-published.jsonl --mcap run.out"),
        "a refutation has no team moves for --mcap",
    );
}
