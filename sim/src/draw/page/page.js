// Plays a stored run on a canvas. The data stand beside this script: `film` is what stands still, `lines` is one line for each
// step with what changes in it (docs/formats.md says how). Nothing here knows a scheme: layers say by their shapes how they are drawn.

const find = id => document.getElementById(id);
const film = JSON.parse(find("film").textContent);
const board = film.board;
const inCells = board.kind === "cells";
const texts = find("lines").textContent.split("\n").filter(line => line);
const last = texts.length - 1;
const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
const counted = (number, one) => `${number} ${one}${number === 1 ? "" : "s"}`;
const capital = text => text[0].toUpperCase() + text.slice(1);

// ---- Reading the lines

const columns = inCells ? board.columns : 1, rows = inCells ? board.rows : 1, cells = columns * rows;
const SIDES = { E: [1, 0], S: [0, 1], W: [-1, 0], N: [0, -1] };
const WORDS = { E: "east", S: "south", W: "west", N: "north" };

/** Rising numbers to the base 36, each but the first as what it is more. */
function numbers(text) {
  let sum = 0;
  return text ? text.split(",").map(part => sum += parseInt(part, 36)) : [];
}

/** Calls `tell(robot, letter, isBlocked)` for each robot that does not stay. */
function eachStep(text, tell) {
  let robot = 0, count = 0;
  for (let i = 0; i < text.length; i++) {
    const code = text.charCodeAt(i);
    if (code >= 48 && code <= 57) { count = 10 * count + code - 48; continue; }
    if (code === 46) { robot += count || 1; count = 0; continue; }
    if (code === 45) return;
    tell(robot++, text[i].toUpperCase(), code >= 97);
  }
}

/** A line in its parts. */
function read(text) {
  const tab = text.indexOf("\t");
  const line = { steps: "", back: false, later: 0, unseen: [], lost: [], explored: [], known: [], puts: [], clears: [], marks: [], said: [], takes: [], failed: [], dead: [], share: null };
  Object.assign(line, tab < 0 ? {} : JSON.parse(text.slice(tab + 1)));
  const words = (tab < 0 ? text : text.slice(0, tab)).split(" ");
  line.steps = words[0];
  for (const word of words.slice(1)) {
    const colon = word.indexOf(":"), name = word.slice(1, colon), rest = word.slice(colon + 1);
    switch (word[0]) {
      case "b": line.back = true; break;
      case "+": line.later = +word.slice(1); break;
      case "=": line.share = +word.slice(1); break;
      case "u": line.unseen = numbers(rest); break;
      case "l": line.lost = numbers(rest); break;
      case "x": line.explored = numbers(rest); break;
      case "o": line.known.push([1, numbers(rest)]); break;
      case "w": line.known.push([2, numbers(rest)]); break;
      case "c": line.clears.push(+word.slice(1)); break;
      case "f": line.failed = numbers(rest); break;
      case "n": line.dead = numbers(rest); break;
      case "d": line.takes.push([+name, +rest]); break;
      case "p": {
        const [, layer, value, robots] = /^(\d+)\.(\d+)(?:@(.*))?$/.exec(name);
        line.puts.push([+layer, +value, robots ? robots.split(",").map(Number) : [0], numbers(rest)]);
        break;
      }
      case "e": {
        const [, layer, value, number] = /^(\d+)\.(\d+)@(\d+)$/.exec(name);
        line.marks.push([+layer, +number, { value: +value, figures: rest.split(",").map(part => parseInt(part, 36)) }]);
        break;
      }
      case "s": {
        const [layer, kind] = name.split(".").map(Number), [from, to] = rest.split(">");
        line.said.push({ layer, kind, from: +from, to: to === "*" ? null : to.split(",").map(Number) });
        break;
      }
    }
  }
  return line;
}

// ---- What is so after each line: a journal of changes, which is played forward and back

const EXPLORED = 0, KNOWN = cells, FRONTIER = 3 * cells;
let size = 4 * cells;
for (const layer of film.layers) {
  layer.start = size;
  layer.width = layer.shape === "cells" ? cells : layer.shape === "sides" ? 2 * cells : 0;
  layer.used = ["links", "circle", "reports"].includes(layer.shape);
  size += layer.width * (layer.each ? film.robots : 1);
}
const state = new Uint8Array(size);
const slots = [], olds = [], news = [], journal = new Uint32Array(last + 2);
const shares = new Float64Array(last + 1), times = new Float64Array(last + 1);
const KEY = 32, keys = [], drives = Array.from({ length: film.robots }, () => []);
const broken = [], bumpLines = [], events = [];
let isBlind = false;
const blocked = new Uint8Array(cells), walls = new Uint8Array(2 * cells);

function put(slot, value) {
  if (state[slot] === value) return;
  slots.push(slot); olds.push(state[slot]); news.push(value);
  state[slot] = value;
}

/** The side of a cell in a direction; -1 on the rim. */
function side(cell, letter) {
  const x = cell % columns;
  switch (letter) {
    case "E": return x + 1 < columns ? 2 * cell : -1;
    case "S": return cell + columns < cells ? 2 * cell + 1 : -1;
    case "W": return x > 0 ? 2 * (cell - 1) : -1;
    default: return cell >= columns ? 2 * (cell - columns) + 1 : -1;
  }
}

const beyond = (cell, letter) => cell + SIDES[letter][0] + SIDES[letter][1] * columns;

/** Whether a side is known to be closed; robots that see the sides of their cells know it of all that they explore. */
function isShut(cell, letter) {
  const at = side(cell, letter);
  return at < 0 || (board.sees ? walls[at] > 0 || blocked[beyond(cell, letter)] > 0 : state[KNOWN + at] === 2);
}

/** A frontier cell is unexplored, and no side that is known to be closed is between it and an explored one. */
function review(cell) {
  const is = !state[EXPLORED + cell] && !(board.sees && blocked[cell])
    && ["E", "S", "W", "N"].some(letter => !isShut(cell, letter) && state[EXPLORED + beyond(cell, letter)]);
  put(FRONTIER + cell, is ? 1 : 0);
}

function explore(cell) {
  if (state[EXPLORED + cell]) return 0;
  put(EXPLORED + cell, 1);
  review(cell);
  for (const letter in SIDES) if (side(cell, letter) >= 0) review(beyond(cell, letter));
  return 1;
}

function know(at, value) {
  if (at < 0 || state[KNOWN + at] === value) return;
  put(KNOWN + at, value);
  const cell = at >> 1;
  review(cell);
  const other = cell + (at & 1 ? columns : 1);
  if (other < cells) review(other);
}

if (inCells) {
  board.ground.forEach((row, y) => {
    let x = 0;
    for (const [, count, letter] of row.matchAll(/(\d*)([a-h])/g)) {
      for (let i = +count || 1; i > 0; i--, x++) {
        const code = letter.charCodeAt(0) - 97, cell = y * columns + x;
        blocked[cell] = code & 1; walls[2 * cell] = code >> 1 & 1; walls[2 * cell + 1] = code >> 2;
      }
    }
  });
}

function load() {
  const team = inCells ? Int32Array.from(board.start) : null;
  let share = 0, isTimed = false;
  for (let i = 0; i <= last; i++) {
    journal[i] = slots.length;
    const line = read(texts[i]);
    times[i] = (i ? times[i - 1] : 0) + line.later;
    isBlind ||= line.unseen.length > 0;
    isTimed ||= i > 0 && line.later > 0;
    if (inCells) {
      for (const cell of line.explored) share += explore(cell);
      if (i === 0) for (const cell of team) share += explore(cell);
      for (const [robot, lasts] of line.takes) drives[robot].push({ from: team[robot], begin: times[i], end: times[i] + lasts });
      let bumps = 0;
      eachStep(line.steps, (robot, letter, isBlocked) => {
        const from = team[robot];
        know(side(from, letter), isBlocked ? 2 : 1);
        if (isBlocked) bumps++;
        else share += explore(team[robot] = beyond(from, letter));
      });
      for (const [robot] of line.takes) drives[robot].at(-1).to = team[robot];
      if (bumps) bumpLines.push(i);
      for (const [value, places] of line.known) for (const place of places) know(place, value);
      if (i % KEY === 0) keys.push(team.slice());
    }
    for (const number of line.clears) {
      const { start, width, each } = film.layers[number];
      for (let slot = start; slot < start + width * (each ? film.robots : 1); slot++) put(slot, 0);
    }
    for (const [number, value, robots, places] of line.puts) {
      const layer = film.layers[number];
      layer.used = true;
      for (const robot of robots) for (const place of places) put(layer.start + robot * layer.width + place, value);
    }
    for (const [number, thing, mark] of line.marks) {
      const layer = film.layers[number];
      layer.used = true;
      ((layer.marks ??= [])[thing] ??= []).push({ i, ...mark });
    }
    for (const { layer } of line.said) film.layers[layer].used = true;
    if (line.share !== null) share = line.share;
    shares[i] = share;
    for (const [clause, told] of line.broken ?? []) broken.push({ i, clause, told });
    if (line.note) events.push({ i, text: line.note });
  }
  for (const { clause, what, cells: missed } of film.ends) {
    broken.push({ i: last, clause, told: what ? [`${what}: ${missed.slice(0, 20).map(cellName).join(" ")}${missed.length > 20 ? ` and ${missed.length - 20} more` : ""}.`] : [], missed, atEnd: read(texts[last]).again ? "such a run" : "the end" });
  }
  journal[last + 1] = slots.length;
  return isTimed;
}

const cellName = cell => `${cell % columns + board.first[0]},${Math.floor(cell / columns) + board.first[1]}`;
/** The number of a robot as its rule has it. */
const numberOf = robot => robot + (film.numbered_from ?? 1);
const robotName = robot => film.has_base && robot === 0 ? "the base" : `R${numberOf(robot)}`;
const label = robot => film.has_base && robot === 0 ? "B" : `${numberOf(robot)}`;
const isTimed = load();
const frames = { now: last, line: null, cells: [] };

/** What robots tried in line `i`. */
const stepsOf = i => /^[^ \t]*/.exec(texts[i])[0];

/** Where each robot is after line `i`, by cell. */
function team(i) {
  const places = keys[Math.floor(i / KEY)].slice();
  for (let k = i - i % KEY + 1; k <= i; k++) {
    eachStep(stepsOf(k), (robot, letter, isBlocked) => {
      if (!isBlocked) places[robot] = beyond(places[robot], letter);
    });
  }
  return places;
}

/** Makes the state that after line `i`; calls `changed(slot)` for what differs. */
function seek(i, changed) {
  while (frames.now < i) {
    frames.now++;
    for (let k = journal[frames.now]; k < journal[frames.now + 1]; k++) { state[slots[k]] = news[k]; changed(slots[k]); }
  }
  while (frames.now > i) {
    for (let k = journal[frames.now + 1] - 1; k >= journal[frames.now]; k--) { state[slots[k]] = olds[k]; changed(slots[k]); }
    frames.now--;
  }
}

// ---- Places on the board, in cells or metres

const paths = inCells ? [] : board.paths.map(text => {
  const path = [];
  let at = [0, 0, 0];
  for (const [k, part] of text.split(",").entries()) {
    at[k % 3] += parseInt(part, 36);
    if (k % 3 === 2) path.push([...at]);
  }
  return path;
});
const width = inCells ? columns : board.size[0] / 1000, height = inCells ? rows : board.size[1] / 1000;
const middle = cell => [cell % columns + .5, Math.floor(cell / columns) + .5];

/** The last entry of a list, by `key`, that is not after `time`; -1 if there is none. */
function latest(list, key, time) {
  let low = 0, high = list.length;
  while (low < high) {
    const half = low + high >> 1;
    if (key(list[half]) <= time) low = half + 1; else high = half;
  }
  return low - 1;
}

/** Where a robot is at a time, in metres. */
function along(path, time) {
  const k = Math.max(latest(path, fix => fix[0], time), 0), [t, x, y] = path[k], next = path[k + 1];
  const part = next && next[0] > t ? Math.min(Math.max((time - t) / (next[0] - t), 0), 1) : 0;
  return [(x + part * ((next ?? path[k])[1] - x)) / 1000, (y + part * ((next ?? path[k])[2] - y)) / 1000];
}

/** Where all robots are drawn after line `i`, at `time` if it is scrubbed by seconds. */
function places(i, time) {
  if (!inCells) return paths.map(path => along(path, time ?? times[i]));
  return Array.from(frames.cells, (cell, robot) => {
    const list = drives[robot], drive = time === null ? null : list[latest(list, one => one.begin, time)];
    if (!drive || drive.end <= time) return middle(cell);
    const part = (time - drive.begin) / (drive.end - drive.begin), from = middle(drive.from), to = middle(drive.to);
    return [from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])];
  });
}

// ---- What is shown, with its legend

// Where no robot is to explore, cells are those that robots have visited, and there is no frontier.
const explores = !film.share.visits;
const BUILT_IN = inCells ? [
  { name: "what is", about: "walls and blocked cells, known or not", keys: [["wall", "wall"], ["blocked", "blocked"]] },
  { name: "what the team knows", about: `${explores ? "explored cells" : "cells where robots were"}, and walls that robots met or saw`, keys: [["explored", explores ? "explored" : "visited"], ["known", "known wall"]] },
  ...explores ? [{ name: "frontier", about: "unexplored cells beside explored ones", keys: [["frontier", "frontier cell"]] }] : [],
  { name: "plan and outcome", about: "what each robot tried in this step, and whether a wall was in the way", keys: [["arrow", "went"], ["bump", "met a wall"], ...isBlind ? [["missed", "missed a sensor"]] : []] },
  { name: "way", about: "where the followed robot has been", keys: [["trail", "way"]] },
] : [
  { name: "field", about: "nodes and obstacles", keys: [["node", "node"], ["blocked", "obstacle"], ["caller", "waits for a robot"], ["dead", "has failed"]] },
  { name: "ways", about: "where robots have been", keys: [["trail", "way"]] },
];
// Many circles hide more than they show.
const isOn = { way: false, frontier: explores };
for (const layer of film.layers) if (layer.shape === "circle") isOn[layer.name] = film.robots <= 3;
const shows = name => isOn[name] !== false;
const shapes = shape => film.layers.filter(layer => layer.shape === shape && layer.used && shows(layer.name));

function keysOf(layer) {
  switch (layer.shape) {
    case "cells": case "sides": case "marks": return layer.values.map(value => [value.ink + "-" + layer.shape, value.name]);
    case "links": return [...layer.zones.map((zone, k) => [`link${k}`, `${zone.name}: ${zone.about}`]), ...layer.joins === "next" ? [["lost", "lost"]] : []];
    case "circle": return [["circle", layer.about]];
    case "messages": return layer.kinds.map(kind => [kind.heard ? "message" : "deaf", kind.name]);
    default: return [["message", layer.about]];
  }
}

// ---- Drawing

const canvas = find("board"), pen = canvas.getContext("2d");
const still = document.createElement("canvas"), stillPen = still.getContext("2d");
const image = document.createElement("canvas");
image.width = columns; image.height = rows;
const imagePen = image.getContext("2d"), pixels = imagePen.createImageData(columns, rows), pixel = new Uint32Array(pixels.data.buffer);
let ink = {}, rgba = {}, view = { scale: 1, x: 0, y: 0 }, isFit = true, isStill = false, isPainted = false;
let shown = 0, clock = null, followed = -1, from = null, moved = 1, begun = 0;

function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["page", "card", "ink", "soft", "line", "accent", "unexplored", "explored", "blocked", "wall", "unknown", "frontier", "frontier-ink", "closing", "closed", "sealed", "robot", "leader", "base", "name", "link", "bad", "barred", "open", "aim", "message", "trail"]) {
    ink[name] = style.getPropertyValue(`--${name}`).trim();
    const [r, g, b] = /^#(..)(..)(..)$/.exec(ink[name].replace(/^#(.)(.)(.)$/, "#$1$1$2$2$3$3")).slice(1).map(part => parseInt(part, 16));
    rgba[name] = (255 << 24 | b << 16 | g << 8 | r) >>> 0;
  }
}

/** The colour of a cell, by what is known of it. */
function colour(cell) {
  if (blocked[cell] && shows("what is")) return rgba.blocked;
  for (const layer of film.layers) {
    if (layer.shape !== "cells" || !shows(layer.name) || layer.each && followed < 0) continue;
    const value = state[layer.start + (layer.each ? followed * cells : 0) + cell];
    if (value) return rgba[{ open: "explored", wall: "blocked", aim: "frontier", goal: "frontier" }[layer.values[value - 1].ink] ?? layer.values[value - 1].ink];
  }
  if (state[FRONTIER + cell] && shows("frontier")) return rgba.frontier;
  return state[EXPLORED + cell] && shows("what the team knows") ? rgba.explored : rgba.unexplored;
}

/** A slot of the state has changed: so does the colour of a cell. */
function repaint(slot) {
  if (slot >= KNOWN && slot < FRONTIER) return;
  let cell = slot % cells;
  if (slot >= 4 * cells) {
    const layer = film.layers.find(one => slot >= one.start && slot < one.start + one.width * (one.each ? film.robots : 1));
    if (layer?.shape !== "cells") return;
    cell = (slot - layer.start) % cells;
  }
  pixel[cell] = colour(cell);
  isPainted = false;
}

function repaintAll() {
  if (inCells) for (let cell = 0; cell < cells; cell++) pixel[cell] = colour(cell);
  isPainted = isStill = false;
}

function resize() {
  const ratio = devicePixelRatio || 1;
  for (const one of [canvas, find("curve")]) {
    const box = one.getBoundingClientRect();
    one.width = Math.max(Math.round(box.width * ratio), 1);
    one.height = Math.max(Math.round(box.height * ratio), 1);
  }
  still.width = canvas.width; still.height = canvas.height;
  if (isFit) fit(); else isStill = false;
  draw();
}

/** The part of the board that is not blocked, with a cell round it: a map may be a small one in a large picture. */
const freePart = (() => {
  let [left, top, right, bottom] = [width, height, 0, 0];
  if (inCells) for (let cell = 0; cell < cells; cell++) {
    if (blocked[cell]) continue;
    const x = cell % columns, y = Math.floor(cell / columns);
    left = Math.min(left, x - 1); right = Math.max(right, x + 2);
    top = Math.min(top, y - 1); bottom = Math.max(bottom, y + 2);
  }
  if (left >= right) return { left: 0, top: 0, width, height };
  left = Math.max(left, 0); top = Math.max(top, 0);
  return { left, top, width: Math.min(right, width) - left, height: Math.min(bottom, height) - top };
})();

function fit() {
  const margin = 14 * (devicePixelRatio || 1);
  view.scale = Math.max(Math.min((canvas.width - 2 * margin) / freePart.width, (canvas.height - 2 * margin) / freePart.height, 64 * (devicePixelRatio || 1)), .01);
  view.x = (canvas.width - freePart.width * view.scale) / 2 - freePart.left * view.scale;
  view.y = (canvas.height - freePart.height * view.scale) / 2 - freePart.top * view.scale;
  isFit = true; isStill = false;
}

function zoom(factor, x = canvas.width / 2, y = canvas.height / 2) {
  const scale = Math.min(Math.max(view.scale * factor, .2), 200);
  view.x = x - (x - view.x) * scale / view.scale;
  view.y = y - (y - view.y) * scale / view.scale;
  view.scale = scale;
  isFit = isStill = false;
  drawSoon();
}

const px = x => view.x + x * view.scale, py = y => view.y + y * view.scale;

/** Calls `tell(cell, x, y)` for the cells in sight. */
function eachSeen(tell) {
  const [left, top] = [Math.max(Math.floor(-view.x / view.scale), 0), Math.max(Math.floor(-view.y / view.scale), 0)];
  const right = Math.min(Math.ceil((canvas.width - view.x) / view.scale), columns), bottom = Math.min(Math.ceil((canvas.height - view.y) / view.scale), rows);
  for (let y = top; y < bottom; y++) for (let x = left; x < right; x++) tell(y * columns + x, x, y);
}

/** Adds a side of a cell to the path of `to`: the bar where a wall stands. */
function bar(to, at, inset = 0) {
  const cell = at >> 1, x = cell % columns, y = Math.floor(cell / columns);
  if (at & 1) { to.moveTo(px(x + inset), py(y + 1)); to.lineTo(px(x + 1 - inset), py(y + 1)); }
  else { to.moveTo(px(x + 1), py(y + inset)); to.lineTo(px(x + 1), py(y + 1 - inset)); }
}

function stroke(to, colour, thick, dash = []) {
  to.strokeStyle = colour; to.lineWidth = thick; to.setLineDash(dash); to.stroke(); to.setLineDash([]);
}

const thin = () => Math.max(view.scale * .02, .5 * (devicePixelRatio || 1));
const wallWidth = () => Math.min(Math.max(view.scale * .1, 1), 4 * (devicePixelRatio || 1));

/** What only changes with the view: lines, walls, rim; nodes and obstacles. */
function drawStill() {
  const to = stillPen, scale = view.scale;
  to.clearRect(0, 0, still.width, still.height);
  to.lineCap = "square";
  if (inCells) {
    if (scale >= 8) {
      to.beginPath();
      for (let x = 1; x < columns; x++) { to.moveTo(px(x), py(0)); to.lineTo(px(x), py(rows)); }
      for (let y = 1; y < rows; y++) { to.moveTo(px(0), py(y)); to.lineTo(px(columns), py(y)); }
      stroke(to, ink.line, thin());
    }
    if (shows("what is") && scale >= 2) {
      to.beginPath();
      eachSeen(cell => { for (const at of [2 * cell, 2 * cell + 1]) if (walls[at]) bar(to, at); });
      stroke(to, ink.unknown, wallWidth());
    }
  } else if (shows("field")) {
    to.fillStyle = ink.blocked;
    for (const [w, n, e, s] of board.obstacles) to.fillRect(px(w / 1000), py(n / 1000), (e - w) / 1000 * scale, (s - n) / 1000 * scale);
    to.fillStyle = ink.soft;
    const side = (board.nodes.length > 5000 ? 1 : 3) * (devicePixelRatio || 1);
    for (const [x, y] of board.nodes) to.fillRect(px(x / 1000) - side / 2, py(y / 1000) - side / 2, side, side);
  }
  to.lineCap = "butt";
  to.strokeStyle = ink.wall; to.lineWidth = wallWidth();
  to.strokeRect(px(0), py(0), width * scale, height * scale);
  isStill = true;
}

/** Signs inside cells, so that no meaning hangs on a colour alone. */
function drawSigns() {
  if (view.scale < 12) return;
  const signs = {};
  const add = (name, cell) => (signs[name] ??= []).push(cell);
  const layers = shapes("cells").filter(layer => !layer.each || followed >= 0);
  eachSeen(cell => {
    if (blocked[cell] && shows("what is")) return;
    let is = "";
    for (const layer of layers) {
      const value = state[layer.start + (layer.each ? followed * cells : 0) + cell];
      if (value) { is = layer.values[value - 1].ink; break; }
    }
    if (is && is !== "open") add(is, cell);
    else if (!is && state[FRONTIER + cell] && shows("frontier")) add("frontier", cell);
  });
  for (const name in signs) {
    pen.beginPath();
    for (const cell of signs[name]) {
      const [x, y] = middle(cell);
      sign(pen, name, px(x), py(y), view.scale);
    }
    stroke(pen, signInk(name), Math.max(view.scale * .04, 1));
  }
}

const signInk = name => ({ frontier: ink["frontier-ink"], aim: ink.aim, goal: ink.aim, wall: ink.wall })[name] ?? ink.barred;

/** The sign of a kind of cell round a place: a diamond, a ring, two rings, one stroke, two, a cross. */
function sign(pen, name, x, y, scale) {
  const r = scale * .13;
  switch (name) {
    case "frontier": pen.moveTo(x, y - r); pen.lineTo(x + r, y); pen.lineTo(x, y + r); pen.lineTo(x - r, y); pen.closePath(); break;
    case "goal": pen.moveTo(x + r, y); pen.arc(x, y, r, 0, 7);
    // Falls through: two rings are one more than one.
    case "aim": pen.moveTo(x + 2 * r, y); pen.arc(x, y, 2 * r, 0, 7); break;
    case "closing": pen.moveTo(x + r / 2, y); pen.arc(x, y, r / 2, 0, 7); break;
    case "sealed": pen.moveTo(x - 2 * r, y - 2 * r); pen.lineTo(x + 2 * r, y + 2 * r);
    // Falls through: two strokes are one more than one.
    case "closed": pen.moveTo(x - 2 * r, y + 2 * r); pen.lineTo(x + 2 * r, y - 2 * r); break;
    case "wall": pen.moveTo(x - r, y - r); pen.lineTo(x + r, y + r); pen.moveTo(x - r, y + r); pen.lineTo(x + r, y - r); break;
  }
}

function drawSides() {
  if (view.scale < 3) return;
  pen.lineCap = "square";
  if (shows("what the team knows")) {
    pen.beginPath();
    eachSeen(cell => { for (const at of [2 * cell, 2 * cell + 1]) if (state[KNOWN + at] === 2) bar(pen, at); });
    stroke(pen, ink.wall, wallWidth() * 1.4);
  }
  for (const layer of shapes("sides")) {
    if (layer.each && followed < 0) continue;
    const start = layer.start + (layer.each ? followed * layer.width : 0);
    for (const [k, value] of layer.values.entries()) {
      pen.beginPath();
      eachSeen(cell => {
        for (const at of [2 * cell, 2 * cell + 1]) {
          if (state[start + at] !== k + 1) continue;
          if (value.ink !== "open") { bar(pen, at, .1); continue; }
          const [x, y] = middle(cell), [dx, dy] = at & 1 ? SIDES.S : SIDES.E;
          pen.moveTo(px(x), py(y)); pen.lineTo(px(x + dx), py(y + dy));
        }
      });
      pen.lineCap = value.ink === "barred" ? "butt" : "square";
      stroke(pen, ink[value.ink], wallWidth() * (value.ink === "open" ? 1 : 1.6), value.ink === "barred" ? [view.scale * .16, view.scale * .14] : []);
    }
  }
  pen.lineCap = "butt";
}

/** The zone of a layer in which robots in these cells have each other; -1 for none. */
function zone(layer, one, other) {
  layer.sets ??= layer.zones.map(one => new Set(one.cells.map(([x, y]) => `${x},${y}`)));
  const key = `${other % columns - one % columns},${Math.floor(other / columns) - Math.floor(one / columns)}`;
  return layer.sets.findIndex(set => set.has(key));
}

function drawLinks(at) {
  for (const layer of shapes("links")) {
    const lines = {}, add = (name, one, other) => (lines[name] ??= []).push([one, other]);
    const places = frames.cells, lost = new Set(frames.line.lost);
    if (layer.joins === "next") {
      const gone = new Set(failed(shown)), left = Array.from(places.keys()).filter(robot => !gone.has(robot));
      for (const [k, robot] of left.slice(0, -1).entries()) {
        const next = left[k + 1], found = zone(layer, places[robot], places[next]);
        add(gone.size === 0 && lost.has(robot) || found < 0 ? "lost" : found, robot, next);
      }
    } else if (layer.joins === "all") {
      for (let k = 0; k < places.length; k++) for (let j = k + 1; j < places.length; j++) if (zone(layer, places[k], places[j]) >= 0) add(0, k, j);
    } else {
      const joined = [0], rest = new Set(Array.from(places.keys()).slice(1));
      for (const one of joined) for (const other of rest) {
        if (zone(layer, places[one], places[other]) < 0) continue;
        add(0, one, other); joined.push(other); rest.delete(other);
      }
    }
    for (const name in lines) {
      pen.beginPath();
      for (const [one, other] of lines[name]) { pen.moveTo(px(at[one][0]), py(at[one][1])); pen.lineTo(px(at[other][0]), py(at[other][1])); }
      pen.globalAlpha = name === "lost" ? 1 : .65;
      stroke(pen, name === "lost" ? ink.bad : ink.link, wallWidth() * (name === "0" ? 1.3 : .8), name === "lost" ? [6, 4] : name === "0" ? [] : [2, 3]);
      pen.globalAlpha = 1;
    }
    if (followed >= 0 && view.scale >= 8 && layer.joins === "next") {
      for (const [k, one] of [...layer.zones.entries()].reverse()) {
        pen.fillStyle = ink.link; pen.globalAlpha = .07;
        for (const [dx, dy] of one.cells) {
          const [x, y] = [at[followed][0] + dx - .5, at[followed][1] + dy - .5];
          if (x >= 0 && y >= 0 && x < columns && y < rows) pen.fillRect(px(x), py(y), view.scale, view.scale);
        }
        pen.globalAlpha = 1;
      }
    }
  }
}

function drawCircles(at) {
  for (const layer of shapes("circle")) {
    for (const [robot, [x, y]] of at.entries()) {
      if (followed >= 0 && robot !== followed) continue;
      pen.beginPath();
      pen.arc(px(x), py(y), layer.radius / 1000 * view.scale, 0, 7);
      stroke(pen, ink.link, thin() * 1.5, [5, 4]);
    }
  }
}

function drawWays() {
  if (inCells) {
    if (followed < 0 || !shows("way")) return;
    const far = Math.max(0, shown - 400);
    let at = team(far)[followed];
    pen.beginPath();
    pen.moveTo(px(middle(at)[0]), py(middle(at)[1]));
    for (let i = far + 1; i <= shown; i++) {
      eachStep(stepsOf(i), (robot, letter, isBlocked) => {
        if (robot !== followed || isBlocked) return;
        at = beyond(at, letter);
        pen.lineTo(px(middle(at)[0]), py(middle(at)[1]));
      });
    }
    stroke(pen, ink.trail, wallWidth());
  } else if (shows("ways")) {
    const time = clock ?? times[shown];
    for (const [robot, path] of paths.entries()) {
      if (followed >= 0 && robot !== followed) continue;
      pen.beginPath();
      for (const [t, x, y] of path) { if (t > time) break; pen.lineTo(px(x / 1000), py(y / 1000)); }
      const [x, y] = along(path, time);
      pen.lineTo(px(x), py(y));
      stroke(pen, ink.robot, 1.6 * (devicePixelRatio || 1), robot % 3 ? [robot % 3 === 1 ? 8 : 2, 3] : []);
    }
  }
}

/** What robots tried: an arrow from where they were, or a bar where a wall was in the way. */
function drawPlan() {
  if (!inCells || !shows("plan and outcome") || view.scale < 6 || clock !== null) return;
  const before = shown > 0 ? team(shown - 1) : frames.cells, s = view.scale;
  const went = new Path2D(), bumps = new Path2D(), tips = new Path2D();
  eachStep(frames.line.steps, (robot, letter, isBlocked) => {
    const [x, y] = middle(before[robot]), [dx, dy] = SIDES[letter];
    const edge = [px(x + dx * .5), py(y + dy * .5)];
    went.moveTo(px(x), py(y)); went.lineTo(...edge);
    if (isBlocked) { bumps.moveTo(edge[0] - dy * s * .42, edge[1] - dx * s * .42); bumps.lineTo(edge[0] + dy * s * .42, edge[1] + dx * s * .42); return; }
    tips.moveTo(edge[0] + dx * s * .14, edge[1] + dy * s * .14);
    tips.lineTo(edge[0] + dy * s * .11, edge[1] + dx * s * .11); tips.lineTo(edge[0] - dy * s * .11, edge[1] - dx * s * .11); tips.closePath();
  });
  pen.strokeStyle = ink.ink; pen.lineWidth = Math.max(s * .045, 1); pen.stroke(went);
  pen.fillStyle = ink.ink; pen.fill(tips);
  pen.strokeStyle = ink.bad; pen.lineWidth = Math.max(s * .13, 2); pen.stroke(bumps);
  pen.beginPath();
  for (const cell of frames.line.unseen) { const [x, y] = middle(cell); pen.rect(px(x - .4), py(y - .4), s * .8, s * .8); }
  stroke(pen, ink.bad, Math.max(s * .05, 1), [s * .15, s * .12]);
}

/** Where things are, and are taken to be, after the line. */
function drawMarks() {
  for (const layer of shapes("marks")) for (const list of layer.marks) {
    const mark = list?.[latest(list, one => one.i, shown)];
    if (mark) strokeMark(pen, layer.values[mark.value - 1].ink, mark.figures, (x, y) => [px(x), py(y)], view.scale);
  }
}

function strokeMark(to, name, figures, place, unit) {
  const path = new Path2D(markPath(figures, place, unit)), thick = Math.max(unit * .03, 1);
  to.setLineDash(name === "barred" ? [2 * thick, 2 * thick] : []);
  to.strokeStyle = ink[name]; to.lineWidth = thick; to.stroke(path); to.setLineDash([]);
}

const CORNERS = [[-.23, -.23], [.23, -.23], [-.23, .23], [.23, .23]];

function drawRobots(at) {
  const s = view.scale, least = 3 * (devicePixelRatio || 1), groups = new Map();
  for (const [robot, [x, y]] of at.entries()) {
    const key = inCells ? `${x},${y}` : robot;
    if (groups.has(key)) groups.get(key).push(robot); else groups.set(key, [robot]);
  }
  const one = (robot, x, y, r, text) => {
    const isBase = film.has_base && robot === 0, isLeader = film.has_leader && robot === film.robots - 1;
    pen.beginPath();
    if (isBase) pen.roundRect(x - r, y - r, 2 * r, 2 * r, r * .35); else pen.arc(x, y, r, 0, 7);
    pen.fillStyle = isBase ? ink.base : isLeader ? ink.leader : ink.robot;
    // What is known of places is drawn over robots.
    if (shapes("marks").length) pen.globalAlpha = .4;
    if (gone.has(robot)) { stroke(pen, ink.bad, 2); pen.globalAlpha = .35; }
    pen.fill();
    pen.globalAlpha = 1;
    if (isLeader) { pen.beginPath(); pen.arc(x, y, r + Math.max(r * .2, 1.5), 0, 7); stroke(pen, ink.leader, Math.max(r * .13, 1)); }
    if (robot === followed) { pen.beginPath(); pen.arc(x, y, r * 1.35 + 2, 0, 7); stroke(pen, ink.accent, 2.5); }
    if (r < 5.5) return;
    pen.fillStyle = shapes("marks").length ? ink.ink : ink.name;
    pen.font = `600 ${Math.min(r * (text.length > 2 ? .85 : 1.15), 22 * (devicePixelRatio || 1))}px system-ui, sans-serif`;
    pen.textAlign = "center"; pen.textBaseline = "middle";
    pen.fillText(text, x, y + r * .07);
  };
  const gone = new Set(failed(shown));
  for (const robots of groups.values()) {
    const [x, y] = at[robots[0]];
    const alone = inCells ? Math.max(s * .36, least) : 9 * (devicePixelRatio || 1);
    const holdsBase = film.has_base && robots[0] === 0;
    if (robots.length === 1) one(robots[0], px(x), py(y), alone, label(robots[0]));
    else if (holdsBase && robots.length > 2 || robots.length > 4 || s < 18) one(robots.includes(followed) ? followed : robots[0], px(x), py(y), alone, holdsBase ? `B+${robots.length - 1}` : `${robots.length}×`);
    else robots.forEach((robot, k) => one(robot, px(x + CORNERS[k][0]), py(y + (robots.length === 2 ? 0 : CORNERS[k][1])), Math.max(s * .21, least), label(robot)));
  }
}

/** The robots that have failed by line `i`, and the nodes. */
const failures = [], deaths = [];
for (let i = 0; i <= last; i++) {
  if (inCells && !texts[i].includes(" f:")) continue;
  const line = read(texts[i]);
  for (const robot of line.failed) failures.push({ i, of: robot });
  for (const node of line.dead) deaths.push({ i, of: node });
}
const failed = i => failures.filter(one => one.i <= i).map(one => one.of);

function star(pen, x, y, radius) {
  pen.beginPath();
  for (let tip = 0; tip < 8; tip++) {
    const r = tip % 2 ? radius * .4 : radius, turn = tip * Math.PI / 4;
    pen.lineTo(x + r * Math.sin(turn), y - r * Math.cos(turn));
  }
  pen.closePath();
  pen.fillStyle = ink.bad; pen.fill();
}

function drawCallers() {
  if (inCells || !shows("field")) return;
  const unit = devicePixelRatio || 1;
  for (const [k, [x, y]] of board.callers.entries()) {
    const at = [px(x / 1000), py(y / 1000)];
    star(pen, at[0], at[1], 10 * unit);
    pen.font = `600 ${13 * unit}px system-ui, sans-serif`; pen.textAlign = "left"; pen.textBaseline = "middle";
    pen.fillStyle = ink.ink; pen.fillText(`${board.caller} ${k + 1}`, at[0] + 12 * unit, at[1]);
  }
  pen.beginPath();
  for (const { i, of } of deaths) {
    if (i > shown) break;
    const [x, y] = board.nodes[of], r = 4 * unit;
    pen.moveTo(px(x / 1000) - r, py(y / 1000) - r); pen.lineTo(px(x / 1000) + r, py(y / 1000) + r);
    pen.moveTo(px(x / 1000) - r, py(y / 1000) + r); pen.lineTo(px(x / 1000) + r, py(y / 1000) - r);
  }
  stroke(pen, ink.bad, 1.5 * unit);
}

/** Messages on their way: a dot from who says it to who hears it, a growing ring where all do. */
function drawMessages(at) {
  const part = moved, reach = inCells ? 1 : 12 / view.scale;
  const place = who => who < at.length ? at[who] : board.callers[who - at.length].map(millimetres => millimetres / 1000);
  const ring = (x, y) => {
    pen.beginPath();
    pen.arc(px(x), py(y), view.scale * reach * (.45 + .55 * part), 0, 7);
    pen.globalAlpha = part < 1 ? 1 - part * .6 : .35;
    stroke(pen, ink.message, 1.5 * (devicePixelRatio || 1), part < 1 ? [] : [2, 4]);
    pen.globalAlpha = 1;
  };
  if (shapes("reports").length && shown > 0 && film.robots <= 64) at.slice(1).forEach(([x, y]) => ring(x, y));
  for (const said of frames.line.said) {
    const layer = film.layers[said.layer];
    if (!shows(layer.name)) continue;
    const [x, y] = place(said.from);
    if (said.to === null) { ring(x, y); continue; }
    for (const to of said.to) {
      const [tx, ty] = place(to);
      const unit = devicePixelRatio || 1, isHeard = layer.kinds[said.kind].heard;
      pen.beginPath();
      pen.moveTo(px(x), py(y)); pen.lineTo(px(tx), py(ty));
      stroke(pen, isHeard ? ink.message : ink.bad, 1.2 * unit, [3, 4]);
      pen.beginPath();
      if (!isHeard) {
        // A cross on the way, nearer to who should have heard it: the message back has one of its own.
        const [cx, cy] = [px(x + (tx - x) * .6), py(y + (ty - y) * .6)], r = 4 * unit;
        pen.moveTo(cx - r, cy - r); pen.lineTo(cx + r, cy + r); pen.moveTo(cx - r, cy + r); pen.lineTo(cx + r, cy - r);
        stroke(pen, ink.bad, 2 * unit);
      } else if (part < 1) {
        pen.arc(px(x + (tx - x) * part), py(y + (ty - y) * part), 4 * unit, 0, 7);
        pen.fillStyle = ink.message; pen.fill();
      }
    }
  }
}

function drawMissed() {
  const cells = broken.filter(one => one.missed && one.i === shown).flatMap(one => one.missed);
  if (!cells.length) return;
  pen.beginPath();
  for (const cell of cells) { const [x, y] = middle(cell); pen.rect(px(x - .42), py(y - .42), view.scale * .84, view.scale * .84); }
  stroke(pen, ink.bad, Math.max(view.scale * .09, 2), [5, 3]);
}

let due = 0;
const drawSoon = () => due ||= requestAnimationFrame(now => { due = 0; draw(now); });

function draw(now = performance.now()) {
  moved = calm || !begun ? 1 : Math.min(Math.max((now - begun) / glide(), 0), 1);
  const to = places(shown, clock), ease = moved * (2 - moved);
  const at = from && moved < 1 && from.length === to.length ? to.map(([x, y], k) => [from[k][0] + ease * (x - from[k][0]), from[k][1] + ease * (y - from[k][1])]) : to;
  if (followed >= 0 && !isFit) {
    const [x, y] = at[followed], [left, top] = [canvas.width / 2 - x * view.scale, canvas.height / 2 - y * view.scale];
    if (left !== view.x || top !== view.y) { view.x = left; view.y = top; isStill = false; }
  }
  pen.fillStyle = ink.page;
  pen.fillRect(0, 0, canvas.width, canvas.height);
  if (inCells) {
    if (!isPainted) { imagePen.putImageData(pixels, 0, 0); isPainted = true; }
    pen.imageSmoothingEnabled = view.scale < 1;
    pen.drawImage(image, px(0), py(0), columns * view.scale, rows * view.scale);
  } else {
    pen.fillStyle = ink.card;
    pen.fillRect(px(0), py(0), width * view.scale, height * view.scale);
  }
  if (!isStill) drawStill();
  pen.drawImage(still, 0, 0);
  if (inCells) { drawSigns(); drawSides(); drawLinks(at); drawMissed(); }
  drawCircles(at); drawWays(); drawCallers(); drawMessages(at); drawPlan(); drawRobots(at); drawMarks();
  drawCurve();
  if (moved < 1) drawSoon();
}

// ---- The curve under the board, which is the axis of moves or seconds

const curve = find("curve"), curvePen = curve.getContext("2d");
const span = () => times[last] - times[0] || 1;
const isByTime = () => find("axis").value === "time";
const partOf = i => isByTime() ? (times[i] - times[0]) / span() : last ? i / last : 0;

function drawCurve() {
  const to = curvePen, unit = devicePixelRatio || 1, w = curve.width, h = curve.height, bottom = h - 16 * unit, top = 6 * unit;
  const x = part => (4 + part * (w / unit - 8)) * unit, y = i => bottom - (bottom - top) * Math.min(shares[i] / (film.share.of || 1), 1);
  to.clearRect(0, 0, w, h);
  to.beginPath();
  to.moveTo(x(0), bottom);
  const few = Math.max(1, Math.floor((last + 1) / 1500));
  let height = y(0);
  for (let i = 0; i <= last; i += i + few > last && i < last ? last - i : few) { to.lineTo(x(partOf(i)), height); to.lineTo(x(partOf(i)), height = y(i)); }
  to.lineTo(x(1), height); to.lineTo(x(1), bottom);
  to.fillStyle = ink.explored; to.fill();
  to.beginPath(); to.moveTo(x(0), bottom); to.lineTo(x(1), bottom);
  stroke(to, ink.unknown, unit);
  for (const i of new Set(broken.map(one => one.i))) {
    const at = x(partOf(i));
    to.beginPath(); to.moveTo(at, top); to.lineTo(at, bottom);
    stroke(to, ink.bad, 1.5 * unit);
    to.beginPath(); to.moveTo(at, bottom); to.lineTo(at - 5 * unit, bottom + 9 * unit); to.lineTo(at + 5 * unit, bottom + 9 * unit); to.closePath();
    to.fillStyle = ink.bad; to.fill();
  }
  const at = x(clock === null ? partOf(shown) : (clock - times[0]) / span());
  to.beginPath(); to.moveTo(at, 0); to.lineTo(at, bottom);
  stroke(to, ink.ink, 2 * unit);
  to.fillStyle = ink.soft; to.font = `${11 * unit}px system-ui, sans-serif`; to.textBaseline = "bottom";
  const text = `${percent(shown)} % of ${counted(film.share.of, film.share.what.split(" ")[0].replace(/s$/, ""))} ${film.share.what.split(" ")[1]}`;
  const wide = to.measureText(text).width, marks = [...new Set(broken.map(one => x(partOf(one.i))))];
  // Beside the marks of violations, away from the hand if both ends are free; on a plate if there are marks everywhere.
  const spots = [x(0), x(1) - wide, x(.5) - wide / 2], isFree = spot => marks.every(mark => mark < spot - 8 * unit || mark > spot + wide + 8 * unit);
  if (at <= w / 2) spots.unshift(spots.splice(1, 1)[0]);
  const spot = spots.find(isFree) ?? spots[0];
  if (!isFree(spot)) { to.fillStyle = ink.card; to.fillRect(spot - 2 * unit, h - 13 * unit, wide + 4 * unit, 13 * unit); to.fillStyle = ink.soft; }
  to.textAlign = "left";
  to.fillText(text, spot, h);
}

const percent = i => film.share.of ? Math.floor(100 * shares[i] / film.share.of) : 100;
const seconds = milliseconds => (milliseconds / 1000).toFixed(inCells ? 1 : 3);

// ---- Words

/** What a line says, in a sentence. */
function words(i, line) {
  const number = film.first + i;
  if (!inCells) return i === 0 ? "The start" : `${seconds(times[i])} s: ${line.note}`;
  let text;
  if (i === 0) {
    const others = film.has_base ? `the base, with ${counted(film.robots - 1, film.robot)} in its cell` : counted(film.robots, film.robot);
    text = number === 0 ? `The start: ${others}` : `After ${film.unit} ${number}`;
  } else {
    text = `${capital(film.unit)} ${number} of ${film.of}${film.has_leader ? line.back ? ", a backtrack" : ", an advance" : ""}${line.again ? ", again and again" : ""}${line.title ? `: ${line.title}` : ""}`;
    const bumps = [];
    eachStep(line.steps, (robot, letter, isBlocked) => { if (isBlocked) bumps.push(robotName(robot)); });
    text += bumps.length > 6 ? `; ${bumps.length} ${film.robot}s meet walls` : bumps.map(name => `; ${name} meets a wall`).join("");
  }
  if (isTimed) text += `; ${seconds(times[i])} s`;
  for (const one of broken) if (one.i === i) text += one.atEnd ? `; ${one.atEnd} breaks ${one.clause}` : `; breaks ${one.clause}`;
  return text;
}

/** What a robot did in a line. */
function did(robot, letter, isBlocked, cell) {
  const name = capital(robotName(robot));
  return isBlocked ? `${name} tries to go ${WORDS[letter]} from ${cellName(cell)}, meets a wall and stays.` : `${name} goes ${WORDS[letter]} from ${cellName(cell)} to ${cellName(beyond(cell, letter))}.`;
}

function element(name, text, attributes = {}) {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  for (const key in attributes) made.setAttribute(key, attributes[key]);
  return made;
}

const MOST_TOLD = 12;

/** The sentence of a clause that is broken. That of a rule of one's own, whose robots count from 0, says what is so where it is kept. */
const demanded = clause => film.clauses[clause] && (film.numbered_from === undefined ? "" : "It demands: ") + film.clauses[clause];

/** Which clauses a line breaks, and how. */
function explain(i, line) {
  const here = broken.filter(one => one.i === i);
  const said = here.map(({ clause, told, atEnd }) => {
    const p = element("p");
    p.append(element("b", `${capital(atEnd || `${film.unit} ${film.first + i}`)} breaks ${clause}. `), [demanded(clause), ...told].filter(text => text).join(" "));
    return p;
  });
  if (inCells && here.some(one => !one.atEnd) && i > 0) {
    const before = team(i - 1), told = [];
    eachStep(line.steps, (robot, letter, isBlocked) => told.push(did(robot, letter, isBlocked, before[robot])));
    const more = told.length - MOST_TOLD;
    said.push(element("p", told.slice(0, MOST_TOLD).join(" ") + (more > 0 ? ` And ${counted(more, film.robot)} more.` : ""), { class: "small" }));
  }
  find("why").replaceChildren(...said);
}

/** The robots in a table: where each is, what it tried, and what it says. */
function tell(i, line) {
  if (!find("who").open) return;
  const tried = new Map(), says = new Map();
  eachStep(line.steps, (robot, letter, isBlocked) => tried.set(robot, isBlocked ? `${WORDS[letter]}, a wall` : WORDS[letter]));
  if (film.layers.some(layer => layer.shape === "reports") && i > 0) {
    // Bits 0 to 2 the step, bit 3 a wall, bit 4 taken back.
    const bytes = Array(film.robots).fill(4 + (line.back ? 16 : 0));
    eachStep(line.steps, (robot, letter, isBlocked) => { bytes[robot] = "ESWN".indexOf(letter) + (isBlocked ? 8 : 0) + (line.back ? 16 : 0); });
    bytes.slice(1).forEach((byte, k) => says.set(k + 1, `0x${byte.toString(16).padStart(2, "0")}`));
  }
  for (const { layer, kind, from, to } of line.said) {
    const text = `${film.layers[layer].kinds[kind].name}${to === null ? "" : `: ${to.map(who => who < film.robots ? `R${numberOf(who)}` : `${board.caller} ${who - film.robots + 1}`).join(", ")}`}`;
    says.set(from, says.has(from) ? `${says.get(from)}; ${text}` : text);
  }
  const gone = new Set(failed(i));
  const where = inCells ? Array.from(frames.cells, cellName) : places(i, clock).map(at => at.map(metres => metres.toFixed(1)).join(", ") + " m");
  find("rows").replaceChildren(...where.map((place, robot) => {
    const row = element("tr");
    row.append(element("th", label(robot), { scope: "row" }), element("td", place), element("td", gone.has(robot) ? "has failed" : tried.get(robot) ?? ""), element("td", says.get(robot) ?? ""));
    return row;
  }));
}

// ---- Showing and playing

let timer = null, hashing = 0, lastHash = "", lastTick = 0;
const SPEEDS = [.5, 1, 2, 4, 8, 16, 32, 60], PACES = [.1, 1, 2, 5, 10, 30, 60, 300];
const speed = () => +find("speed").value;
const glide = () => timer === null ? 180 : Math.min(500 / speed(), 180);

/** Shows line `i`; at a time of its own if it is scrubbed by seconds. */
function show(i, time = null) {
  i = Math.min(Math.max(i, 0), last);
  const isStep = Math.abs(i - shown) === 1 && time === null;
  from = isStep && inCells ? places(shown, null) : null;
  begun = isStep ? performance.now() : 0;
  clock = time;
  shown = i;
  if (inCells) {
    seek(i, repaint);
    frames.cells = team(i);
  }
  frames.line = read(texts[i]);
  const text = words(i, frames.line);
  find("say").textContent = text;
  canvas.setAttribute("aria-label", `${text}. ${percent(i)} % of ${film.share.what}.`);
  curve.setAttribute("aria-label", `${capital(film.share.what)}: ${shares[i]} of ${film.share.of}`);
  explain(i, frames.line);
  const at = find("at");
  at.value = isByTime() ? time ?? times[i] : i;
  at.setAttribute("aria-valuetext", text);
  tell(i, frames.line);
  if (timer === null) settle();
  drawSoon();
}

/** The address tells the step, once it stands still: browsers take few changes a second. */
function putHash() {
  lastHash = `#${film.first + shown}`;
  if (location.hash === lastHash) return;
  try { history.replaceState(null, "", lastHash); } catch { location.hash = lastHash; }
}

/** What need not follow every step while the run plays. */
function settle() {
  clearTimeout(hashing);
  hashing = setTimeout(putHash, 150);
  find("events").querySelector("[aria-current]")?.removeAttribute("aria-current");
  const k = latest(events, one => one.i, shown);
  const item = k < 0 ? null : find("events").children[k]?.firstChild;
  if (item) {
    item.setAttribute("aria-current", "step");
    const list = find("events"), top = item.offsetTop - list.offsetTop;
    if (top < list.scrollTop || top + item.offsetHeight > list.scrollTop + list.clientHeight) list.scrollTop = top - list.clientHeight / 2;
  }
}

function stop() {
  if (timer === null) return;
  cancelAnimationFrame(timer);
  timer = null;
  find("toggle").textContent = "Play";
  find("toggle").setAttribute("aria-pressed", "false");
  find("say").setAttribute("aria-live", "polite");
  settle();
}

function start() {
  if (shown === last) show(0);
  find("toggle").textContent = "Pause";
  find("toggle").setAttribute("aria-pressed", "true");
  find("say").setAttribute("aria-live", "off");
  lastTick = performance.now();
  clock = isByTime() ? clock ?? times[shown] : null;
  timer = requestAnimationFrame(tick);
}

/** The first line from `i` to `to` that breaks a clause. */
const violation = (i, to) => broken.map(one => one.i).sort((a, b) => a - b).find(k => k >= i && k <= to);

function tick(now) {
  timer = requestAnimationFrame(tick);
  const gone = (now - lastTick) / 1000;
  let to = shown, time = null;
  if (isByTime()) {
    time = Math.min(clock + gone * speed() * 1000, times[last]);
    to = Math.max(latest(times, one => one, time), shown);
    lastTick = now;
  } else {
    const steps = Math.floor(gone * speed());
    if (!steps) return;
    lastTick += steps / speed() * 1000;
    to = Math.min(shown + steps, last);
  }
  const bad = to > shown ? violation(shown + 1, to) : undefined;
  if (bad !== undefined) show(bad); else show(to, time);
  if (bad !== undefined || shown === last && (time === null || time >= times[last])) stop();
}

const toggle = () => timer === null ? start() : stop();
const go = i => { stop(); show(i); };

function goToPart(part) {
  stop();
  if (!isByTime()) return show(Math.round(part * last));
  const time = times[0] + part * span();
  show(Math.max(latest(times, one => one, time), 0), time);
}

// ---- Controls

/** A small picture of what the legend names. */
function key(name) {
  const made = document.createElement("canvas"), unit = devicePixelRatio || 1, [w, h] = [22 * unit, 16 * unit];
  made.width = w; made.height = h; made.dataset.key = name;
  const ownPen = made.getContext("2d");
  const line = (colour, thick, dash) => { ownPen.beginPath(); ownPen.moveTo(1, h / 2); ownPen.lineTo(w - 1, h / 2); stroke(ownPen, colour, thick * unit, dash); };
  const [kind, shape] = name.split("-"), fill = { explored: ink.explored, blocked: ink.blocked, frontier: ink.frontier, closing: ink.closing, closed: ink.closed, sealed: ink.sealed }[kind];
  if (shape === "marks") strokeMark(ownPen, kind, MARK_KEY[kind] ?? MARK_KEY.guess, (x, y) => [w / 2 + (x - .5) * h, h / 2 + (y - .5) * h], 3 * h);
  else if (shape === "sides" || ["wall", "known", "bump", "trail", "lost", "link0", "link1", "circle", "arrow", "missed"].includes(name)) {
    const colour = { wall: ink.unknown, known: ink.wall, bump: ink.bad, trail: ink.trail, lost: ink.bad, link0: ink.link, link1: ink.link, circle: ink.link, arrow: ink.ink, missed: ink.bad }[name] ?? ink[kind];
    line(colour, { link1: 2, circle: 1.5, arrow: 1.5, missed: 1.5 }[name] ?? 3, { lost: [6, 4], link1: [2, 3], circle: [5, 4], missed: [3, 2] }[name] ?? (kind === "barred" ? [4, 3].map(part => part * unit) : []));
  } else if (fill || shape === "cells") {
    ownPen.fillStyle = fill ?? { open: ink.explored, wall: ink.blocked, aim: ink.frontier, goal: ink.frontier }[kind];
    ownPen.fillRect((w - h) / 2, 0, h, h);
  } else {
    ownPen.beginPath(); ownPen.arc(w / 2, h / 2, name === "node" ? 2 * unit : 5 * unit, 0, 7);
    ownPen.fillStyle = { message: ink.message, node: ink.soft }[name];
    if (name === "caller") star(ownPen, w / 2, h / 2, h / 2);
    else if (name === "dead" || name === "deaf") {
      ownPen.beginPath();
      const r = h * .3;
      ownPen.moveTo(w / 2 - r, h / 2 - r); ownPen.lineTo(w / 2 + r, h / 2 + r); ownPen.moveTo(w / 2 - r, h / 2 + r); ownPen.lineTo(w / 2 + r, h / 2 - r);
      stroke(ownPen, ink.bad, 2 * unit);
    } else ownPen.fill();
  }
  if (fill || shape === "cells") {
    ownPen.beginPath();
    sign(ownPen, kind, w / 2, h / 2, h);
    stroke(ownPen, signInk(kind), unit);
  }
  return made;
}

function listLayers() {
  const items = [...BUILT_IN, ...film.layers.filter(layer => layer.used)].map(layer => {
    const item = element("li"), box = element("input", undefined, { type: "checkbox" }), name = element("label");
    box.checked = shows(layer.name);
    box.onchange = () => { isOn[layer.name] = box.checked; repaintAll(); drawSoon(); };
    name.append(box, layer.name);
    name.title = layer.about;
    const keys = element("div", undefined, { class: "key" });
    for (const [sign, text] of layer.keys ?? keysOf(layer)) {
      const one = element("span");
      one.append(key(sign), text);
      keys.append(one);
    }
    if (layer.each) keys.append(element("span", "of the robot that is followed"));
    item.append(name, keys);
    return item;
  });
  find("layers").replaceChildren(...items);
}

const MOST_EVENTS = 3000;

function listEvents() {
  for (const [number, text] of film.notes) if (number >= film.first && number <= film.first + last) events.push({ i: number - film.first, text });
  for (const { i, clause, atEnd } of broken) events.push({ i, text: atEnd ? `${capital(atEnd)} breaks ${clause}` : `Breaks ${clause}`, isBad: true });
  if (inCells) for (const { i, of } of failures) events.push({ i, text: `${capital(robotName(of))} dies`, isBad: true });
  const some = bumpLines.length + events.length <= MOST_EVENTS ? bumpLines : [];
  for (const i of some) {
    const names = [];
    eachStep(stepsOf(i), (robot, letter, isBlocked) => { if (isBlocked) names.push(capital(robotName(robot))); });
    events.push({ i, text: names.length > 4 ? `${names.length} ${film.robot}s meet walls` : `${names.join(", ")} ${names.length > 1 ? "meet" : "meets a"} wall${names.length > 1 ? "s" : ""}` });
  }
  events.sort((one, other) => one.i - other.i);
  // What happens again and again is one event, where it begins.
  const once = [];
  for (const event of events) {
    const before = once.at(-1);
    if (before?.text === event.text && before.isBad === event.isBad) { before.times++; before.to = event.i; } else once.push({ ...event, times: 1 });
  }
  events.splice(0, events.length, ...once);
  const left = events.splice(MOST_EVENTS);
  const items = events.map(({ i, text, isBad, times: count, to }) => {
    const item = element("li"), button = element("button", undefined, isBad ? { class: "bad" } : {});
    const more = count > 1 ? `, ${count} times in a row, the last at ${inCells ? film.first + to : seconds(times[to])}` : "";
    button.append(element("i", inCells ? film.first + i : seconds(times[i])), element("span", text + more));
    button.onclick = () => go(i);
    item.append(button);
    return item;
  });
  if (left.length || some !== bumpLines) items.push(element("li", left.length ? `${left.length} later ones are not listed.` : `${bumpLines.length} ${film.unit}s in which ${film.robot}s meet walls are not listed.`, { class: "small" }));
  find("events").replaceChildren(...items);
}

function jump(direction) {
  const at = events.map(one => one.i);
  const to = direction > 0 ? at.find(i => i > shown) : at.findLast(i => i < shown);
  if (to !== undefined) go(to);
}

function follow(robot) {
  followed = robot;
  find("follow").value = robot;
  repaintAll();
  drawSoon();
}

function fillIn() {
  find("outcome").textContent = film.outcome;
  for (const clause in film.clauses) if (film.clauses[clause]) find("outcome").after(element("p", `${clause}: ${demanded(clause)}`));
  find("at").setAttribute("aria-label", film.unit);
  find("axis").options[0].textContent = `${film.unit}s`;
  find("axis-label").hidden = !isTimed;
  find("follow").append(element("option", "nobody", { value: -1 }));
  for (let robot = film.has_base ? 1 : 0; robot < film.robots; robot++) find("follow").append(element("option", capital(robotName(robot)), { value: robot }));
  find("who-head").textContent = `Where each ${film.robot} is`;
  for (const head of ["", inCells ? "cell" : "place", "tried", "says"]) find("columns").append(element("th", head, { scope: "col" }));
  find("who").open = film.robots <= 16;
  const { command, layout } = film.again;
  find("again-text").textContent = `This page holds the stored run only: it cannot say what would happen in another layout, with another seed or by another rule. ${
    command === null ? "The run was made by a search or by another program, not by one command; `tautline hunt --help` tells how runs are searched for."
      : command.startsWith("tautline explore ") && !command.startsWith("tautline explore LAYOUT ") ? `Change what you like and run it again${layout === null ? "" : "; to open or close a side, store the layout below in a file, change it, and name the file in place of the generator"}:`
        : inCells ? layout === null ? "Change your layout and run it again, with your file in the place of LAYOUT:" : "To run it again, store the layout below in a file, and name the file in the place of LAYOUT; open or close a side in it, and another run comes of it:"
          : "Change what you like and run it again:"}`;
  find("command").textContent = command ?? "";
  find("command").hidden = command === null;
  find("layout").textContent = layout ?? "";
  find("layout").hidden = layout === null || command === null;
  setAxis();
}

function setAxis() {
  stop();
  const byTime = isByTime(), list = byTime ? PACES : SPEEDS, at = find("at");
  find("speed").replaceChildren(...list.map(value => element("option", byTime ? `× ${value}` : `${value} a second`, { value })));
  // The whole run takes about a minute, but no slower than two steps a second.
  const least = byTime ? span() / 60000 : Math.max(last / 60, 2);
  find("speed").value = list.find(value => value >= least) ?? list.at(-1);
  at.min = byTime ? times[0] : 0; at.max = byTime ? times[last] : last; at.step = byTime ? "any" : 1;
}

find("first").onclick = () => go(0);
find("back").onclick = () => go(shown - 1);
find("next").onclick = () => go(shown + 1);
find("last").onclick = () => go(last);
find("toggle").onclick = toggle;
find("at").oninput = event => isByTime() ? goToPart((+event.target.value - times[0]) / span()) : go(+event.target.value);
find("axis").onchange = () => { setAxis(); show(shown); };
find("follow").onchange = event => follow(+event.target.value);
find("who").ontoggle = () => { if (frames.line) tell(shown, frames.line); };
find("in").onclick = () => zoom(1.4);
find("out").onclick = () => zoom(1 / 1.4);
find("fit").onclick = () => { fit(); drawSoon(); };

addEventListener("keydown", event => {
  if (event.altKey || event.ctrlKey || event.metaKey || event.target instanceof HTMLSelectElement) return;
  const many = event.shiftKey ? 10 : 1, isControl = event.target.matches?.("button, summary, input");
  switch (event.key) {
    case "ArrowLeft": go(shown - many); break;
    case "ArrowRight": go(shown + many); break;
    case "Home": go(0); break;
    case "End": go(last); break;
    case " ": if (isControl) return; toggle(); break;
    case "[": jump(-1); break;
    case "]": jump(1); break;
    case "+": case "=": zoom(1.4); break;
    case "-": zoom(1 / 1.4); break;
    case "0": fit(); drawSoon(); break;
    case "f": case "F": follow(followed + 1 >= film.robots ? -1 : Math.max(followed + 1, film.has_base ? 1 : 0)); break;
    default: return;
  }
  event.preventDefault();
});

const pointers = new Map();
let pinch = null, dragged = 0;
const spot = event => { const box = canvas.getBoundingClientRect(), ratio = canvas.width / box.width; return [(event.clientX - box.left) * ratio, (event.clientY - box.top) * ratio]; };
canvas.onpointerdown = event => { canvas.setPointerCapture(event.pointerId); pointers.set(event.pointerId, spot(event)); dragged = 0; pinch = null; };
canvas.onpointermove = event => {
  const before = pointers.get(event.pointerId), now = spot(event);
  if (!before) return;
  pointers.set(event.pointerId, now);
  if (pointers.size === 1) {
    dragged += Math.hypot(now[0] - before[0], now[1] - before[1]);
    if (dragged < 6) return;
    view.x += now[0] - before[0]; view.y += now[1] - before[1];
    isFit = isStill = false;
    if (followed >= 0 && dragged > 40) follow(-1);
    drawSoon();
  } else if (pointers.size === 2) {
    const [one, other] = [...pointers.values()], apart = Math.hypot(one[0] - other[0], one[1] - other[1]);
    if (pinch) zoom(apart / pinch, (one[0] + other[0]) / 2, (one[1] + other[1]) / 2);
    pinch = apart; dragged = 99;
  }
};
canvas.onpointerup = canvas.onpointercancel = event => {
  pointers.delete(event.pointerId);
  if (event.type !== "pointerup" || dragged >= 6) return;
  const [x, y] = spot(event), at = places(shown, clock);
  const near = at.map((place, robot) => [Math.hypot(px(place[0]) - x, py(place[1]) - y), robot]).filter(([far, robot]) => far < Math.max(view.scale * .5, 14 * (devicePixelRatio || 1)) && !(film.has_base && robot === 0));
  if (near.length) { const [, robot] = near.sort((a, b) => a[0] - b[0])[0]; follow(robot === followed ? -1 : robot); }
};
canvas.addEventListener("wheel", event => { event.preventDefault(); zoom(Math.exp(-event.deltaY * .0015), ...spot(event)); }, { passive: false });
const scrub = event => { const box = curve.getBoundingClientRect(); goToPart(Math.min(Math.max((event.clientX - box.left - 4) / (box.width - 8), 0), 1)); };
curve.onpointerdown = event => { curve.setPointerCapture(event.pointerId); scrub(event); };
curve.onpointermove = event => { if (event.buttons) scrub(event); };

const asked = address => { const number = parseInt(new URL(address).hash.slice(1), 10); return Number.isNaN(number) ? 0 : number - film.first; };
// Before the event comes, `putHash` may have written the step that is shown over the one that was asked for.
addEventListener("hashchange", event => { const step = asked(event.newURL); if (step !== shown) go(step); });
new ResizeObserver(resize).observe(canvas);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { readColours(); listLayers(); repaintAll(); drawSoon(); });

readColours();
fillIn();
listLayers();
listEvents();
if (inCells) seek(Math.min(Math.max(asked(location.href), 0), last), () => {});
repaintAll();
show(asked(location.href));
resize();
