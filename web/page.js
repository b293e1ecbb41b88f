// A page to draw on, with the engine inside. Everything that is shown comes from the engine as data: nothing here knows
// a scheme. A game is its settings and the answers that were given; a step back, another answer, a link and a file are
// made of these two.

const find = id => document.getElementById(id);
const make = (name, about = {}, ...inside) => {
  const element = Object.assign(document.createElement(name), about);
  element.append(...inside);
  return element;
};
const counted = (number, one) => `${number.toLocaleString("en")} ${one}${number === 1 ? "" : "s"}`;
const capital = text => text[0].toUpperCase() + text.slice(1);

// ---- The engine, in this page and in a worker

/** Calls the engine of a module: a request goes in and an answer comes out, four bytes at a time. */
function engineOf(instance) {
  const { page_begin: begin, page_room: room, page_put: put, page_call: call, page_get: get, memory } = instance.exports;
  // A page of a rule of one's own puts it among the schemes.
  begin?.();
  const ask = request => {
    const bytes = new TextEncoder().encode(JSON.stringify(request));
    room(bytes.length);
    for (let i = 0; i < bytes.length; i += 4) {
      put(i / 4, (bytes[i] | (bytes[i + 1] ?? 32) << 8 | (bytes[i + 2] ?? 32) << 16 | (bytes[i + 3] ?? 32) << 24) >>> 0);
    }
    const length = call();
    const words = new Uint32Array(Math.ceil(length / 4));
    for (let i = 0; i < words.length; i++) words[i] = get(i);
    return JSON.parse(new TextDecoder().decode(new Uint8Array(words.buffer, 0, length)));
  };
  ask.bytes = () => memory.buffer.byteLength;
  return ask;
}

/** Hunts in a worker: says how far it is after each slice, and hears "stop" between two of them. */
function worker(engineOf) {
  let ask = null, goesOn = false, isAllowed = false, shown = -1;
  const say = (kind, about) => postMessage({ kind, ...about });
  const findings = () => {
    const found = ask({ do: "found" });
    if (!found.error && found.found.length !== shown) {
      shown = found.found.length;
      say("found", { found });
    }
    return found;
  };
  const guarded = work => {
    try {
      return work();
    } catch (error) {
      goesOn = false;
      say("lost", { bytes: ask ? ask.bytes() : 0, words: String(error) });
      return null;
    }
  };
  const channel = new MessageChannel();
  const later = () => channel.port2.postMessage(0);
  channel.port1.onmessage = () => guarded(() => {
    if (!goesOn) return;
    const far = ask({ do: "slice" });
    if (far.error) {
      goesOn = false;
      return say("fault", far);
    }
    say("far", far);
    findings();
    if (!far.more) {
      goesOn = false;
      say("done", { found: ask({ do: "found" }) });
    } else if (far.large && !isAllowed) {
      goesOn = false;
      say("large", far);
    } else {
      later();
    }
  });
  onmessage = ({ data }) => guarded(() => {
    switch (data.kind) {
      case "begin": {
        ask = engineOf(new WebAssembly.Instance(data.module));
        const begun = ask({ do: "hunt", settings: data.settings, bounds: data.bounds });
        if (begun.error) return say("fault", begun);
        say("begun", begun);
        if (begun.large) return say("large", begun);
        goesOn = true;
        return later();
      }
      case "allow":
        isAllowed = goesOn = true;
        return later();
      case "stop":
        goesOn = false;
        return say("done", { found: ask({ do: "found" }), stopped: true });
    }
  });
}

let ask = null, wasm = null;

async function load() {
  const text = find("wasm").textContent.trim();
  const bytes = Uint8Array.from(atob(text), sign => sign.charCodeAt(0));
  const unpacked = new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip")));
  wasm = await WebAssembly.compile(await unpacked.arrayBuffer());
  restart();
}

function restart() {
  ask = engineOf(new WebAssembly.Instance(wasm));
}

/** The answer to a request. An engine that has come to grief begins anew. */
function asked(request) {
  try {
    return ask(request);
  } catch (error) {
    const isFull = ask.bytes() > 900 << 20;
    restart();
    return { error: isFull ? "the memory of this page is exhausted" : `the engine stopped: ${error}`, remedy: isFull ? "take a smaller layout, or the program in a terminal" : "please report it with this page's link" };
  }
}

// ---- The settings, and the ground as it is drawn

let schemes = [], settings = null, columns = 0, rows = 0, blocked = null, walls = null;
/** The ground that was drawn, while a world that brings a board of its own is shown. */
let drawn = null;
let tool = "wall", cursor = [0, 0], isByHand = false;

const schemeOf = name => schemes.find(scheme => scheme.name === name);
const scheme = () => schemeOf(settings.scheme);
const rule = () => scheme().rules.find(rule => rule.name === settings.rule);

function blank(width, height) {
  // What is too large is thrown here, and the ground stays.
  blocked = new Uint8Array(width * height);
  walls = new Uint8Array(2 * width * height);
  columns = width;
  rows = height;
}

/** The rows of the ground: a letter for so many cells, one letter more if they are blocked, two and four for a wall in the east and south. */
function ground() {
  const all = [];
  for (let y = 0; y < rows; y++) {
    let row = "", last = -1, count = 0;
    const flush = () => { if (count) row += (count > 1 ? count : "") + String.fromCharCode(97 + last); };
    for (let x = 0; x < columns; x++) {
      const cell = y * columns + x, code = blocked[cell] + 2 * walls[2 * cell] + 4 * walls[2 * cell + 1];
      if (code !== last) { flush(); last = code; count = 0; }
      count++;
    }
    flush();
    all.push(row);
  }
  return all;
}

function readGround(lines) {
  const width = [...lines[0].matchAll(/(\d*)[a-h]/g)].reduce((sum, [, count]) => sum + (+count || 1), 0);
  blank(width, lines.length);
  lines.forEach((row, y) => {
    let x = 0;
    for (const [, count, letter] of row.matchAll(/(\d*)([a-h])/g)) {
      const code = letter.charCodeAt(0) - 97;
      for (let i = +count || 1; i > 0; i--, x++) {
        const cell = y * columns + x;
        blocked[cell] = code & 1; walls[2 * cell] = code >> 1 & 1; walls[2 * cell + 1] = code >> 2;
      }
    }
  });
}

/** The settings as the engine takes them. */
function full() {
  const all = { ...settings, ground: ground() };
  for (const key of Object.keys(all)) {
    const value = all[key];
    if (value === null || value === 0 || value === false || Array.isArray(value) && !value.length || typeof value === "object" && !Array.isArray(value) && !Object.keys(value).length) delete all[key];
  }
  return all;
}

const cellName = cell => `${cell % columns},${Math.floor(cell / columns)}`;
const numberOf = ([x, y]) => y * columns + x;
const beyond = side => side & 1 ? (side >> 1) + columns : (side >> 1) + 1;
const sideName = side => `the side between ${cellName(side >> 1)} and ${cellName(beyond(side))}`;

// ---- The game: steps, and what each of them changes

let board = null, frames = [], at = 0, answers = [], over = null, question = null, would = [], fault = null, refused = null;
let explored, known, values, undo = [], timer = 0;
/** Whether a step by hand was made of which nothing was asked. */
let isSilent = false;

/** Begins the game anew, with so many steps and these answers. */
function open(steps = 0, given = []) {
  pause();
  question = over = refused = null;
  would = [];
  const opened = asked({ do: "open", settings: full(), answers: given, steps });
  fault = opened.error ? opened : null;
  if (fault) {
    board = null;
    frames = [];
    undo = [];
    at = 0;
    answers = [];
    render();
    return;
  }
  board = opened.board;
  // A world that has no layout brings a board of its own.
  if (board.columns !== columns || board.rows !== rows) {
    const ground = { columns, rows, blocked, walls };
    blank(board.columns, board.rows);
    drawn ??= ground;
  }
  frames = [board.start];
  answers = given;
  const cells = columns * rows;
  explored = new Uint8Array(cells);
  known = new Uint8Array(2 * cells);
  values = board.layers.map(() => new Map());
  undo = [];
  at = 0;
  apply(board.start);
  undo.length = 0;
  layers();
  take(opened.made);
  go(frames.length - 1);
}

/** Takes in steps that were made. */
function take(made) {
  for (const one of made) {
    if (one.over) over = one.over;
    else frames.push({ ...one.made, asked: one.asked });
  }
}

/** Puts what a step changes, and notes how to take it back. */
function apply(frame) {
  const back = [];
  const put = (array, place, value) => {
    if (array[place] === value) return;
    back.push([array, place, array[place]]);
    array[place] = value;
  };
  const write = (map, key, value) => {
    const before = map.get(key);
    if (before === value) return;
    back.push([map, key, before]);
    if (value) map.set(key, value); else map.delete(key);
  };
  for (const cell of frame.explored ?? []) put(explored, cell, 1);
  for (const [side, isOpen] of frame.known ?? []) put(known, side, isOpen ? 1 : 2);
  for (const [side, isWall] of frame.walls ?? []) put(walls, side, isWall ? 1 : 0);
  for (const layer of frame.clear ?? []) for (const key of [...values[layer].keys()]) write(values[layer], key, 0);
  for (const [layer, robot, place, value] of frame.put ?? []) write(values[layer], `${robot ?? ""}@${place}`, value);
  for (const [layer, thing, value, figures] of frame.marks ?? []) write(values[layer], thing, { value, figures });
  undo.push(back);
}

function go(to) {
  to = Math.max(0, Math.min(to, frames.length - 1));
  while (at < to) apply(frames[++at]);
  while (at > to) {
    for (const [array, place, value] of undo.pop().reverse()) {
      if (array instanceof Map) { if (value) array.set(place, value); else array.delete(place); } else array[place] = value;
    }
    at--;
  }
  refused = null;
  render();
  isSilent = false;
}

/** The answers that were given until the step that is shown. */
const given = () => at ? answers.slice(0, frames[at].asked ?? 0) : [];

/** Begins the engine's game anew, up to this step of it. */
const replayed = (answers, steps) => asked({ do: "open", settings: fullAtStart(), answers, steps });

/** Before another future: the game ends at the step that is shown. */
function cut() {
  if (at === frames.length - 1) return;
  const kept = given(), here = at;
  // Walls that later answers made are gone with them.
  const opened = replayed(kept, here);
  if (!opened.error) answers = kept;
  frames.length = here + 1;
  over = question = null;
}

/** The settings of the game's start: without the walls that answers have made. */
function fullAtStart() {
  const here = at;
  const changes = [];
  for (let i = 1; i <= here; i++) for (const [side, isWall] of frames[i].walls ?? []) changes.push([side, isWall]);
  for (const [side, isWall] of [...changes].reverse()) walls[side] = isWall ? 0 : 1;
  const all = full();
  for (const [side, isWall] of changes) walls[side] = isWall ? 1 : 0;
  return all;
}

/** The steps that are refused at the step that is shown. The later ones stay. */
function refusals() {
  const isLast = at >= frames.length - 1;
  if (!isLast) replayed(given(), at);
  const all = asked({ do: "refusals" });
  if (!isLast) replayed(answers, frames.length - 1);
  return all.error ? { without: [] } : all;
}

/** Makes the next step, or shows it if it was made; by hand it is decided anew. */
function step(more = [], count = 1) {
  if (!board) return false;
  const isLast = at === frames.length - 1;
  if (!more.length && !isLast && !isByHand) { go(at + count); return true; }
  if (over && isLast && !more.length) { render(); return false; }
  cut();
  const made = asked({ do: "step", by_hand: isByHand, answers: more, steps: count });
  if (made.error) { fault = made; render(); return false; }
  answers = made.answers;
  question = made.question ?? null;
  would = made.would ?? [];
  if (question) { render(); return false; }
  isSilent = isByHand && !more.length && !made.made[0]?.over;
  take(made.made);
  go(frames.length - 1);
  if (frames.at(-1).broken?.length) pause();
  return !over;
}

function pause() {
  cancelAnimationFrame(timer);
  timer = 0;
}

/** Runs on, so many steps a second. */
function run() {
  if (timer) { pause(); render(); return; }
  let last = performance.now(), due = 1;
  const tick = now => {
    due = Math.min(due + (now - last) / 1000 * +find("speed").value, 64);
    last = now;
    timer = requestAnimationFrame(tick);
    if (due < 1) return;
    const count = Math.floor(due);
    due -= count;
    if (!step([], count)) { pause(); render(); }
  };
  timer = requestAnimationFrame(tick);
  render();
}

// ---- The board as SVG

const CELL = 24;
const STYLE = `text{font:600 9px system-ui,sans-serif;fill:var(--name);text-anchor:middle;dominant-baseline:central}
.ground{fill:var(--unexplored)}.outside{fill:var(--outside)}.explored{fill:var(--explored)}.blocked{fill:var(--blocked)}
.lines{stroke:var(--line);stroke-width:.7;fill:none}.rim{stroke:var(--ink);stroke-width:3;fill:none}
.walls{stroke:var(--ink);stroke-width:3;stroke-linecap:round;fill:none}.unmet{stroke:var(--soft);stroke-width:2.5;stroke-dasharray:4 3}
.link{stroke:var(--robot);stroke-width:2;stroke-opacity:.65}.loose{stroke-dasharray:5 3}.lost{stroke:var(--bad);stroke-width:3;stroke-dasharray:3 3}
.robot{fill:var(--robot)}.leader{fill:var(--leader)}.base{fill:var(--base)}.dead{fill:var(--soft)}.ghost{fill-opacity:.25;stroke-dasharray:2 2;stroke:var(--ink)}
.bump{stroke:var(--bad);stroke-width:3;stroke-linecap:round}.missed{fill:none;stroke:var(--bad);stroke-width:2}.bad{fill:none;stroke:var(--bad);stroke-width:3}
.circle{fill:var(--robot);fill-opacity:.06;stroke:var(--robot);stroke-opacity:.4}.said{stroke:var(--aim);stroke-width:2.5;stroke-dasharray:3 3;fill:none}.k1{stroke:var(--soft);stroke-width:1;stroke-dasharray:none}.k2{stroke:var(--open);stroke-width:4;stroke-dasharray:none;stroke-opacity:.45}
.cursor{fill:none;stroke:var(--accent);stroke-width:3}.asked{stroke:var(--accent);stroke-width:6;stroke-opacity:.6;stroke-linecap:round}
.start{fill:none;stroke:var(--base);stroke-width:2}.refused{stroke:var(--bad);stroke-width:2;fill:none}
.c-open{fill:var(--open);fill-opacity:.3}.c-wall{fill:var(--ink)}.c-barred{fill:var(--barred)}.c-aim{fill:var(--aim)}.c-goal{fill:var(--aim)}.c-closing{fill:var(--closing)}.c-closed{fill:var(--closed)}.c-sealed{fill:var(--sealed)}
.s{fill:none;stroke-width:2.5}.s-open{stroke:var(--open)}.s-wall{stroke:var(--ink);stroke-width:4}.s-barred{stroke:var(--barred);stroke-dasharray:3 2;stroke-width:3.5}.s-aim,.s-goal{stroke:var(--aim);stroke-dasharray:6 2}.s-closing,.s-closed,.s-sealed{stroke:var(--sealed)}.s.m{stroke-width:.8}.m.s-aim{stroke-dasharray:none}`;

/** A path over all cells that are so, whole rows of them at a time. */
function cellsPath(is) {
  let path = "";
  for (let y = 0; y < rows; y++) {
    for (let x = 0; x < columns; x++) {
      if (!is(y * columns + x)) continue;
      const from = x;
      while (x + 1 < columns && is(y * columns + x + 1)) x++;
      path += `M${from * CELL} ${y * CELL}h${(x - from + 1) * CELL}v${CELL}H${from * CELL}z`;
    }
  }
  return path;
}

function sidePath(side) {
  const x = (side >> 1) % columns * CELL, y = Math.floor((side >> 1) / columns) * CELL;
  return side & 1 ? `M${x + 2} ${y + CELL}h${CELL - 4}` : `M${x + CELL} ${y + 2}v${CELL - 4}`;
}

function sidesPath(is) {
  let path = "";
  for (let side = 0; side < 2 * columns * rows; side++) if (is(side)) path += sidePath(side);
  return path;
}

const centre = cell => [(cell % columns + .5) * CELL, (Math.floor(cell / columns) + .5) * CELL];
const path = (name, d) => d ? `<path class="${name}" d="${d}"/>` : "";

/** Where robots are drawn: those that share a cell side by side. */
function places(cells) {
  const by = new Map();
  cells.forEach((cell, robot) => { if (cell !== null) by.set(cell, [...by.get(cell) ?? [], robot]); });
  const spots = cells.map(() => null);
  for (const [cell, robots] of by) {
    const [x, y] = centre(cell), count = robots.length;
    robots.forEach((robot, i) => {
      const turn = 2 * Math.PI * i / count - Math.PI / 2, far = count > 1 ? CELL * .22 : 0;
      spots[robot] = [x + far * Math.cos(turn), y + far * Math.sin(turn), count > 1 ? CELL * .22 : CELL * .34];
    });
  }
  return spots;
}

const nameOf = robot => board.names?.[robot] ?? robot + 1;
const kindOf = (robot, count) => robot < board.squares ? "base" : board.has_leader && robot === count - 1 ? "leader" : "robot";
const isShown = layer => !hidden.has(board.layers[layer].name);
const hidden = new Set(["radio circle", "messages"]);

function drawLayers(cells, spots) {
  let below = "", above = "", over = "";
  board.layers.forEach((layer, number) => {
    if (!isShown(number)) return;
    const own = layer.each ? `${Math.min(followed, cells.length - 1)}@` : "@";
    const of = value => {
      const all = new Set();
      for (const [key, is] of values[number]) if (is === value && (layer.each ? key.startsWith(own) : true)) all.add(+key.split("@")[1]);
      return all;
    };
    if (layer.shape === "cells") layer.values.forEach((value, i) => {
      const all = of(i + 1);
      if (all.size) below += path(`c-${value.ink}`, cellsPath(cell => all.has(cell)));
    });
    if (layer.shape === "sides") layer.values.forEach((value, i) => { above += path(`s s-${value.ink}`, [...of(i + 1)].map(sidePath).join("")); });
    if (layer.shape === "circle") for (const spot of spots) if (spot) above += `<circle class="circle" cx="${spot[0]}" cy="${spot[1]}" r="${layer.radius * CELL / 1000}"/>`;
    if (layer.shape === "marks") for (const { value, figures } of values[number].values()) {
      over += `<path class="s m s-${layer.values[value - 1].ink}" d="${markPath(figures, (x, y) => [x * CELL, y * CELL], CELL)}"/>`;
    }
    if (layer.shape === "links") above += drawLinks(layer, cells, spots);
    if (layer.shape === "messages") for (const [of, kind, from, to] of frames[at].say ?? []) {
      if (of !== number) continue;
      for (const robot of to ?? cells.keys()) if (robot !== from && spots[robot] && spots[from]) above += `<path class="said k${kind}" d="M${spots[from][0]} ${spots[from][1]}L${spots[robot][0]} ${spots[robot][1]}"/>`;
    }
  });
  return [below, above, over];
}

function drawLinks(layer, cells, spots) {
  const zone = (one, other) => {
    const dx = other % columns - one % columns, dy = Math.floor(other / columns) - Math.floor(one / columns);
    return layer.zones.findIndex(zone => zone.cells.some(([x, y]) => x === dx && y === dy));
  };
  const pairs = [];
  const joined = new Set([0]);
  if (layer.joins === "next") for (let i = 0; i + 1 < cells.length; i++) pairs.push([i, i + 1]);
  else if (layer.joins === "all") for (let i = 0; i < cells.length; i++) for (let j = i + 1; j < cells.length; j++) pairs.push([i, j]);
  else for (const from of joined) cells.forEach((_, to) => {
    if (!joined.has(to) && zone(cells[from], cells[to]) >= 0) { joined.add(to); pairs.push([from, to]); }
  });
  let drawn = "";
  for (const [one, other] of pairs) {
    if (!spots[one] || !spots[other]) continue;
    const number = zone(cells[one], cells[other]);
    const isLost = layer.joins === "next" && (number < 0 || frames[at].lost?.includes(one));
    if (number < 0 && !isLost) continue;
    const name = isLost ? "lost" : number > 0 ? "link loose" : "link";
    drawn += `<path class="${name}" d="M${spots[one][0]} ${spots[one][1]}L${spots[other][0]} ${spots[other][1]}"/>`;
  }
  return drawn;
}

/** The drawing of the board; with its colours if it is to stand alone. */
function drawing(isAlone = false) {
  const width = columns * CELL, height = rows * CELL;
  let inside = `<rect class="ground" width="${width}" height="${height}"/>`;
  if (board) {
    const [x0, y0, w, h] = board.area;
    inside += path("outside", cellsPath(cell => { const x = cell % columns, y = Math.floor(cell / columns); return x < x0 || y < y0 || x >= x0 + w || y >= y0 + h; }));
    inside += path("explored", cellsPath(cell => explored[cell] && !blocked[cell]));
  }
  const frame = frames[at], cells = frame?.cells ?? [], spots = places(cells);
  const [below, above, over] = board ? drawLayers(cells, spots) : ["", "", ""];
  inside += below + path("blocked", cellsPath(cell => blocked[cell]));
  let lines = "";
  if (columns * rows <= 10000) {
    for (let x = 1; x < columns; x++) lines += `M${x * CELL} 0v${height}`;
    for (let y = 1; y < rows; y++) lines += `M0 ${y * CELL}h${width}`;
  }
  inside += path("lines", lines);
  const isMet = side => !board || board.sees || known[side] === 2;
  inside += path("walls unmet", sidesPath(side => walls[side] && !isMet(side)));
  inside += path("walls", sidesPath(side => walls[side] && isMet(side)));
  inside += `<rect class="rim" width="${width}" height="${height}"/>`;
  for (const cell of startCells()) { const [x, y] = centre(cell); inside += `<rect class="start" x="${x - 9}" y="${y - 9}" width="18" height="18" rx="3"/>`; }
  inside += above;
  for (const broken of brokenHere()) for (const cell of broken.cells ?? []) { const [x, y] = centre(cell); inside += `<circle class="missed" cx="${x}" cy="${y}" r="8"/>`; }
  const before = at ? frames[at - 1].cells : [], dead = new Set();
  for (let i = 1; i <= at; i++) for (const robot of frames[i].failed ?? []) dead.add(robot);
  const isBroken = frame?.broken?.length > 0;
  spots.forEach((spot, robot) => {
    if (!spot) return;
    const [x, y, r] = spot, kind = dead.has(robot) ? "dead" : kindOf(robot, cells.length);
    inside += kind === "base" ? `<rect class="base" x="${x - r}" y="${y - r}" width="${2 * r}" height="${2 * r}" rx="2"/>` : `<circle class="${kind}" cx="${x}" cy="${y}" r="${r}"${over ? ` fill-opacity=".4"` : ""}/>`;
    if (isBroken) inside += `<circle class="bad" cx="${x}" cy="${y}" r="${r + 2}"/>`;
    inside += `<text x="${x}" y="${y}" font-size="${r > 6 ? 9 : 7}"${over ? ` style="fill:var(--ink)"` : ""}>${nameOf(robot)}</text>`;
    const letter = frame.tried[robot];
    if (letter && "eswn".includes(letter)) {
      const [dx, dy] = { e: [1, 0], s: [0, 1], w: [-1, 0], n: [0, -1] }[letter];
      const [bx, by] = centre(before[robot] ?? cells[robot]), tx = bx + dx * CELL / 2, ty = by + dy * CELL / 2;
      inside += `<path class="bump" d="M${tx - 6 * Math.abs(dy)} ${ty - 6 * Math.abs(dx)}L${tx + 6 * Math.abs(dy)} ${ty + 6 * Math.abs(dx)}"/>`;
    }
  });
  inside += over;
  if (question?.side !== undefined && question) inside += path("asked", sidePath(question.side));
  for (const { robot, to } of refused?.refused ?? []) {
    const [x, y] = centre(cells[robot]), [tx, ty] = centre(to), mx = (x + 2 * tx) / 3, my = (y + 2 * ty) / 3;
    if (cells[robot] !== to) inside += `<path class="refused" d="M${mx - 3} ${my - 3}l6 6m0 -6l-6 6"/>`;
  }
  if (!isAlone && document.activeElement === find("board")) {
    const [x, y] = cursor, cell = (y >> 1) * columns + (x >> 1);
    inside += x & 1 || y & 1 ? path("asked", sidePath(2 * cell + (y & 1))) : `<rect class="cursor" x="${x / 2 * CELL + 2}" y="${y / 2 * CELL + 2}" width="${CELL - 4}" height="${CELL - 4}" rx="3"/>`;
  }
  return inside;
}

const startCells = () => !settings || scheme().by_hand === "only" && !settings.starts?.length ? [] : settings.starts?.length ? settings.starts.map(numberOf) : settings.base ? [numberOf(settings.base)] : [];
const brokenHere = () => !board ? [] : [...frames[at]?.broken ?? [], ...over && at === frames.length - 1 ? over.broken : []];

let followed = 0;

function render() {
  const svg = find("board");
  svg.setAttribute("viewBox", `-4 -4 ${columns * CELL + 8} ${rows * CELL + 8}`);
  svg.innerHTML = `<style>${STYLE}</style>${drawing()}`;
  const last = frames.length - 1;
  Object.assign(find("at"), { max: Math.max(last, 0), value: at });
  find("first").disabled = find("back").disabled = at <= 0;
  find("step").disabled = !board || Boolean(over) && at >= last;
  find("run").textContent = timer ? "Pause" : "Run";
  find("run").setAttribute("aria-pressed", timer !== 0);
  find("refusals").setAttribute("aria-pressed", refused !== null);
  find("say").textContent = sentence();
  find("why").replaceChildren(...reasons());
  renderQuestion();
}

const WAYS = { E: "east", S: "south", W: "west", N: "north" };

/** The step in words, for who sees it and for who hears it. */
function sentence() {
  if (!board) return "";
  const frame = frames[at];
  const parts = [];
  if (at === 0) parts.push(`The start: ${counted(frame.cells.length, board.robot)}`);
  else {
    parts.push(`${capital(board.unit)} ${at} of ${frames.length - 1}${frame.back ? ", taken back" : ""}`);
    if (frame.words) parts.push(frame.words);
    const moves = [...frame.tried].map((letter, robot) => letter === "." ? "" : `${nameOf(robot)} ${letter === letter.toLowerCase() ? "meets a wall in the" : "goes"} ${WAYS[letter.toUpperCase()]}`).filter(move => move);
    if (moves.length && moves.length <= 6) parts.push(moves.join(", "));
    if (isSilent) parts.push("nothing was asked: the robots know or see all that this step depends on, as it is drawn");
  }
  let count = 0;
  for (const is of explored) count += is;
  if (board.due) parts.push(`${count} of ${counted(board.due, "cell")} explored`);
  if (over && at === frames.length - 1) parts.push(`the end: ${over.words}`);
  return `${parts.join("; ")}.`;
}

/** What is broken or wrong, and what refuses steps. */
function reasons() {
  if (fault) return [make("p", {}, make("b", { textContent: `${capital(fault.error)}. ` }), fault.remedy ? `${capital(fault.remedy)}.` : "")];
  const all = brokenHere().map(({ clause, sentence, told }) => make("p", {}, make("b", { textContent: `${clause} is broken` }), `: ${sentence} ${told.join(" ")}`));
  if (refused?.without) {
    // What each condition changes is seen without it.
    const would = ({ by, since, next }) => make("p", {}, make("b", { textContent: by }), since ? ` is needed: without it the run would be another one from ${board.unit} ${since} on.` : ` refuses what would happen next without it: ${next.slice(0, 12).map(words => settings.world ? words : `${board.robot} ${words}`).join("; ")}${next.length > 12 ? " …" : ""}.`);
    all.push(...refused.without.map(would));
    if (!refused.without.length) all.push(make("p", { textContent: rule().conditions ? "No condition changes what happens next." : "This rule has no conditions that could be switched." }));
  }
  if (refused?.refused) {
    const by = new Map();
    for (const { robot, to, by: names } of refused.refused) {
      const name = names.join(" and ") || "a known wall";
      by.set(name, [...by.get(name) ?? [], `${board.robot} ${nameOf(robot)} to ${cellName(to)}`]);
    }
    for (const [name, steps] of by) all.push(make("p", {}, make("b", { textContent: name }), ` refuses, as the others plan: ${steps.slice(0, 12).join("; ")}${steps.length > 12 ? " …" : ""}`));
  }
  return all;
}

function renderQuestion() {
  const box = find("ask");
  box.hidden = !question;
  if (!question) return;
  const outcome = one => one?.over ? `the end: ${one.over.words}` : one?.made ? [...one.made.tried].map((letter, robot) => letter === "." ? "" : `${nameOf(robot)}${letter === letter.toLowerCase() ? " bumps" : ""} ${WAYS[letter.toUpperCase()]}`).filter(part => part).join(", ") || one.made.words || "nobody moves" : "";
  const buttons = question.options.map((option, number) => {
    const broken = [...would[number]?.made?.broken ?? [], ...would[number]?.over?.broken ?? []].map(({ clause }) => clause);
    const words = `${capital(option)}${number === question.usual && !settings.world ? " (as it is)" : ""}${settings.world ? "" : `: ${outcome(would[number])}`}${broken.length ? `, breaks ${broken.join(", ")}` : ""}`;
    return make("button", { textContent: words, onclick: () => step([number]) });
  });
  box.replaceChildren(make("p", { textContent: question.words }), ...buttons);
}

// ---- Drawing by pointer and keys

const TOOLS = [["wall", "Walls"], ["block", "Blocked cells"], ["start", "Base"]];

function tools() {
  find("tools").hidden = scheme().starts === "none";
  const name = scheme().starts === "base" ? "Base" : "Starts";
  find("tools").replaceChildren(...TOOLS.map(([kind, words]) => {
    const button = make("button", { textContent: kind === "start" ? name : words, onclick: () => { tool = kind; tools(); } });
    button.setAttribute("role", "radio");
    button.setAttribute("aria-checked", tool === kind);
    button.dataset.tool = kind;
    return button;
  }));
}

/** The ground has changed: the game begins anew. */
function edited(words) {
  open();
  if (words) find("say").textContent = words;
}

function setWall(side, is) {
  if (walls[side] === is) return false;
  walls[side] = is;
  return true;
}

function setBlocked(cell, is) {
  if (blocked[cell] === is) return false;
  if (is) {
    settings.starts = (settings.starts ?? []).filter(start => numberOf(start) !== cell);
    if (settings.base && numberOf(settings.base) === cell) settings.base = null;
  }
  blocked[cell] = is;
  return true;
}

function toggleStart(cell) {
  const spot = [cell % columns, Math.floor(cell / columns)];
  blocked[cell] = 0;
  if (scheme().starts === "base") settings.base = spot;
  else {
    const starts = settings.starts ?? [];
    const left = starts.filter(start => numberOf(start) !== cell);
    settings.starts = left.length < starts.length ? left : [...starts, spot];
    settings.base = settings.starts[0] ?? null;
    if (settings.starts.length) settings.robots = Math.max(settings.starts.length, scheme().robots[0]);
    find("robots").value = settings.robots;
  }
}

/** The cell and the nearest side under a pointer. */
function under(event) {
  const svg = find("board"), point = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
  const x = point.x / CELL, y = point.y / CELL, cx = Math.floor(x), cy = Math.floor(y);
  if (cx < 0 || cy < 0 || cx >= columns || cy >= rows) return null;
  const dx = x - cx - .5, dy = y - cy - .5, cell = cy * columns + cx;
  let side = -1;
  if (Math.abs(dx) > Math.abs(dy)) side = dx > 0 ? (cx + 1 < columns ? 2 * cell : -1) : cx > 0 ? 2 * (cell - 1) : -1;
  else side = dy > 0 ? (cy + 1 < rows ? 2 * cell + 1 : -1) : cy > 0 ? 2 * (cell - columns) + 1 : -1;
  return { cell, side, isNear: Math.max(Math.abs(dx), Math.abs(dy)) > .22 };
}

let stroke = null;

function draw(spot) {
  if (!spot) return false;
  if (tool === "wall") {
    if (spot.side < 0 || !spot.isNear) return false;
    stroke.value ??= 1 - walls[spot.side];
    return setWall(spot.side, stroke.value);
  }
  stroke.value ??= 1 - blocked[spot.cell];
  return setBlocked(spot.cell, stroke.value);
}

function pointers() {
  const svg = find("board");
  svg.onpointerdown = event => {
    const spot = under(event);
    if (!spot) return;
    svg.focus({ preventScroll: true });
    svg.setPointerCapture(event.pointerId);
    cursor = [2 * (spot.cell % columns), 2 * Math.floor(spot.cell / columns)];
    if (tool === "start") { toggleStart(spot.cell); edited(); return; }
    // What answers have changed is kept: the ground is as it is seen.
    stroke = { value: null, isChanged: false };
    stroke.isChanged = draw(spot);
    if (stroke.isChanged) render();
  };
  svg.onpointermove = event => {
    if (!stroke || !draw(under(event))) return;
    stroke.isChanged = true;
    render();
  };
  svg.onpointerup = svg.onpointercancel = () => {
    const isChanged = stroke?.isChanged;
    stroke = null;
    if (isChanged) edited();
  };
  svg.onfocus = svg.onblur = () => render();
}

/** What is under the cursor, in words. */
function told() {
  const [x, y] = cursor, cell = (y >> 1) * columns + (x >> 1);
  if (x & 1 || y & 1) {
    const side = 2 * cell + (y & 1);
    return `${capital(sideName(side))}: ${walls[side] ? "a wall" : "open"}.`;
  }
  const robots = (frames[at]?.cells ?? []).flatMap((at, robot) => at === cell ? [`${board.robot} ${nameOf(robot)}`] : []);
  return `Cell ${cellName(cell)}: ${blocked[cell] ? "blocked" : explored?.[cell] ? "explored" : "free"}${robots.length ? `, ${robots.join(", ")}` : ""}.`;
}

const ARROWS = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1] };

function keys() {
  find("board").onkeydown = event => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const arrow = ARROWS[event.key];
    if (arrow) {
      let [x, y] = cursor;
      const far = event.shiftKey || (arrow[0] ? y & 1 : x & 1) ? 2 : 1;
      x += arrow[0] * far;
      y += arrow[1] * far;
      if (x >= 0 && y >= 0 && x < 2 * columns - 1 && y < 2 * rows - 1) cursor = [x, y];
      render();
      find("say").textContent = told();
    } else if (event.key === "Enter") {
      const [x, y] = cursor, cell = (y >> 1) * columns + (x >> 1), side = 2 * cell + (y & 1);
      if (x & 1 || y & 1) setWall(side, 1 - walls[side]);
      else if (tool === "start") toggleStart(cell);
      else setBlocked(cell, 1 - blocked[cell]);
      edited();
      find("say").textContent = told();
    } else if (event.key === " ") run();
    else if (event.key === "n" || event.key === "N") step();
    else if (event.key === "p" || event.key === "P") go(at - 1);
    else if (event.key === "Home") go(0);
    else if (event.key === "End") go(frames.length - 1);
    else return;
    event.preventDefault();
  };
}

// ---- The forms

function options(select, all, value) {
  select.replaceChildren(...all.map(name => make("option", { value: name, textContent: name, selected: name === value })));
}

/** Shows the settings in the forms. */
function form() {
  const now = scheme(), own = rule();
  options(find("scheme"), schemes.map(scheme => scheme.name), now.name);
  options(find("rule"), now.rules.map(rule => rule.name), own.name);
  find("about").textContent = `${now.about}.`;
  find("rule-about").textContent = `${own.about}.`;
  find("robots-name").textContent = `${capital(now.robot)}s${now.base ? ", the base counted" : ""}`;
  Object.assign(find("robots"), { min: now.robots[0], max: now.robots[1], value: settings.robots });
  find("seed-label").hidden = !now.draws;
  find("seed").value = settings.seed ?? 0;
  find("miss-label").hidden = !now.misses;
  find("miss").value = settings.miss ?? 0;
  find("columns").value = columns;
  find("rows").value = rows;
  find("options").replaceChildren(...now.options.map(({ field, about, takes }) => {
    const value = settings.options?.[field];
    const input = takes ? make("input", { type: "text", size: 9, placeholder: takes, value: value ?? "" }) : make("input", { type: "checkbox", checked: value !== undefined });
    input.dataset.option = field;
    input.onchange = () => {
      const all = { ...settings.options };
      if (takes ? input.value.trim() : input.checked) all[field] = takes ? input.value.trim() : "";
      else delete all[field];
      settings.options = all;
      edited();
    };
    return make("label", { title: about }, `${field} `, input);
  }));
  find("more").hidden = !now.options.length;
  find("hand").disabled = now.by_hand === "none";
  find("hand").checked = isByHand &&= now.by_hand !== "none";
  conditions();
  huntBounds();
  tools();
}

function bits() {
  return settings.on ?? (rule().conditions ?? []).reduce((bits, { on }, bit) => bits | on << bit, 0);
}

function conditions() {
  const all = rule().conditions;
  find("conditions-box").hidden = !all;
  if (!all) return;
  const now = bits(), off = all.filter(({ on }, bit) => on && !(now >> bit & 1)).length;
  find("conditions-head").textContent = `Conditions: ${all.filter((_, bit) => now >> bit & 1).length} of ${all.length} in force${off ? `, a mutant` : ""}`;
  find("conditions").replaceChildren(...all.map(({ name, sentence, on }, bit) => {
    const input = make("input", { type: "checkbox", checked: now >> bit & 1 });
    input.dataset.condition = name;
    input.onchange = () => {
      settings.on = bits() ^ 1 << bit;
      if (settings.on === all.reduce((bits, { on }, bit) => bits | on << bit, 0)) settings.on = null;
      conditions();
      edited();
      find(`condition-${bit}`)?.focus();
    };
    input.id = `condition-${bit}`;
    const item = make("li", {}, make("label", {}, input, make("span", {}, make("b", { textContent: `${name}. ` }), sentence.replaceAll("`", ""))));
    if (Boolean(now >> bit & 1) !== on) item.className = "changed";
    return item;
  }));
}

/** The legend: what is shown, and a switch for each layer. */
function layers() {
  find("layers").replaceChildren(...board.layers.map(layer => {
    const input = make("input", { type: "checkbox", checked: !hidden.has(layer.name) });
    input.onchange = () => { if (input.checked) hidden.delete(layer.name); else hidden.add(layer.name); render(); };
    const item = make("li", {}, make("label", { title: layer.about }, input, make("span", { textContent: `${layer.name}${layer.each ? " of robot" : ""} ` })));
    if (layer.each) {
      const number = make("input", { type: "number", min: 1, max: 255, value: followed + 1, ariaLabel: "The robot that is followed" });
      number.onchange = () => { followed = Math.max(0, number.value - 1); render(); };
      item.append(number);
    }
    const key = (layer.values ?? []).map(({ name, ink }) => {
      const swatch = layer.shape === "marks" ? `<path class="s m s-${ink}" d="${markPath(MARK_KEY[ink] ?? MARK_KEY.guess, (x, y) => [x * 14 + 4, y * 14], 42)}"/>` : layer.shape === "cells" ? `<rect class="c-${ink}" width="22" height="14"/>` : `<path class="s s-${ink}" d="M0 7h22"/>`;
      const line = make("span");
      line.innerHTML = `<svg viewBox="0 0 22 14" aria-hidden="true"><style>${STYLE}</style>${swatch}</svg> `;
      line.append(name);
      return line;
    });
    for (const [number, { name }] of (layer.kinds ?? []).entries()) {
      const line = make("span");
      line.innerHTML = `<svg viewBox="0 0 22 14" aria-hidden="true"><style>${STYLE}</style><path class="said k${number}" d="M0 7h22"/></svg> `;
      line.append(name);
      key.push(line);
    }
    for (const zone of layer.zones ?? []) key.push(make("span", { textContent: `${zone.name}: ${zone.about}` }));
    if (key.length) item.append(make("div", { className: "key" }, ...key));
    return item;
  }));
}

/** The first layout of a rule of one's own. */
function firstLayout({ size: [width, height], starts }) {
  blank(width, height);
  settings.starts = starts;
  settings.base = starts[0] ?? null;
  settings.robots = starts.length || settings.robots;
}

/** Takes another scheme, on the ground that was drawn. */
function choose(name) {
  if (drawn) {
    ({ columns, rows, blocked, walls } = drawn);
    drawn = null;
    cursor = [0, 0];
  }
  const now = schemeOf(name), robots = Math.min(Math.max(settings.robots, now.robots[0]), now.robots[1]);
  const own = now.rules.find(({ name }) => name === settings.rule) ?? now.rules[0];
  settings = { scheme: name, rule: own.name, on: null, robots, seed: settings.seed, base: settings.base, starts: now.starts === "base" ? [] : settings.starts, options: {}, world: now.by_hand === "only" };
  if (now.opens) firstLayout(now.opens);
  isByHand = isByHand && now.by_hand !== "none" || now.by_hand === "only";
  settings.world ||= isByHand && now.by_hand === "world";
  form();
  open();
}

function resize(width, height) {
  const old = { columns, rows, blocked, walls };
  blank(width, height);
  for (let y = 0; y < Math.min(rows, old.rows); y++) for (let x = 0; x < Math.min(columns, old.columns); x++) {
    const cell = y * columns + x, was = y * old.columns + x;
    blocked[cell] = old.blocked[was];
    if (x + 1 < columns) walls[2 * cell] = old.walls[2 * was];
    if (y + 1 < rows) walls[2 * cell + 1] = old.walls[2 * was + 1];
  }
  const isIn = ([x, y]) => x < columns && y < rows;
  settings.starts = (settings.starts ?? []).filter(isIn);
  if (settings.base && !isIn(settings.base)) settings.base = null;
  cursor = [0, 0];
}

// ---- Find

const BOUNDS = { "max-walls": ["Walls at most", "max_walls", 2], "max-misses": ["Missed sensors at most", "max_misses", 1], "max-losses": ["Lost messages at most", "max_losses", ""], error: ["Wrong fixes, in cells", "error", ""] };
let hunter = null, command = null, isOnBoard = false, sought = "";

function huntBounds() {
  const bounds = rule().hunt;
  if (!hunter) {
    find("found").replaceChildren();
    find("far").textContent = find("far").className = "";
  }
  find("find").disabled = !bounds;
  if (!bounds) {
    find("hunt-bounds").replaceChildren(make("p", { className: "small", textContent: "No hunt searches this rule: draw its layouts by hand." }));
    return;
  }
  if (scheme().by_hand === "only" || scheme().opens) {
    const words = scheme().opens ? "All layouts and orders within the bounds of the rule's own setting." : "Every order of what can happen from the start above, the shortest first.";
    find("hunt-bounds").replaceChildren(make("p", { className: "small", textContent: words }));
    return;
  }
  // Bounds that were typed stay while the scheme does.
  const typed = find("hunt-bounds").dataset.scheme === scheme().name ? Object.fromEntries([...find("hunt-bounds").querySelectorAll("[data-bound]")].map(input => [input.dataset.bound, input.value])) : {};
  find("hunt-bounds").dataset.scheme = scheme().name;
  const number = (words, key, value, more = {}) => {
    const input = make("input", { type: "number", min: 0, value, ...more });
    input.dataset.bound = key;
    return make("label", {}, `${words} `, input);
  };
  const size = make("input", { type: "text", size: 7, placeholder: "its own" });
  size.dataset.bound = "size";
  find("hunt-bounds").replaceChildren(
    number(`${capital(scheme().robot)}s`, "robots", "", { min: 1, placeholder: "its own" }),
    make("label", {}, "Size, as 3x2 ", size),
    ...bounds.filter(bound => BOUNDS[bound] && bound !== "max-cells").map(bound => number(...BOUNDS[bound], bound === "error" ? { step: "any" } : { max: 255 })));
  for (const input of find("hunt-bounds").querySelectorAll("[data-bound]")) input.value = typed[input.dataset.bound] ?? input.value;
}

function readQuarry() {
  const all = {};
  for (const input of find("hunt-bounds").querySelectorAll("[data-bound]")) {
    const key = input.dataset.bound, text = input.value.trim();
    if (!input.checkValidity()) return { error: `“${labelOf(input)}”: ${range(input)}`, remedy: "type another, or none" };
    if (!text) continue;
    if (key === "size") {
      const parts = /^(\d+)\s*[x×]\s*(\d+)$/.exec(text);
      if (!parts) return { error: `the size ${text} is none`, remedy: "write columns and rows, as 3x2" };
      all.size = [+parts[1], +parts[2]];
    } else all[key] = +text;
  }
  return all;
}

function seek() {
  const asked = readQuarry();
  if (asked.error) return ended(asked);
  sought = JSON.stringify(full());
  hunter?.terminate();
  const source = `"use strict";${engineOf};(${worker})(engineOf);`;
  const url = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  hunter = new Worker(url);
  URL.revokeObjectURL(url);
  isOnBoard = false;
  command = null;
  find("found").replaceChildren();
  find("find").hidden = true;
  find("stop").hidden = find("progress").hidden = false;
  find("progress").removeAttribute("value");
  find("far").className = "";
  find("far").textContent = "Hunting …";
  hunter.onmessage = ({ data }) => heard(data);
  hunter.onerror = error => ended({ error: `the hunt stopped: ${error.message}`, remedy: "hunt within smaller bounds" });
  hunter.postMessage({ kind: "begin", module: wasm, settings: full(), bounds: asked });
}

function heard(data) {
  switch (data.kind) {
    case "begun":
      command = data.command;
      break;
    case "far": {
      const { runs, moves, expected, walls, far } = data;
      find("far").textContent = runs === undefined ? `${capital(far || "searching")} …` : `${counted(runs, "run")}, ${counted(moves, "team move")}; ${counted(Math.max(walls, 0), "number")} of walls done …`;
      if (expected > moves) find("progress").value = moves / expected;
      break;
    }
    case "large": large(data); break;
    case "found": show(data.found, false); break;
    case "fault": ended(data); break;
    case "lost": ended(data.bytes > 900 << 20 ? { error: "the memory of the hunt is exhausted", remedy: `hunt within smaller bounds, or in a terminal${command ? `: ${command}` : ""}` } : { error: `the hunt stopped: ${data.words}`, remedy: "please report it with this page's link" }); break;
    case "done":
      show(data.found, true, data.stopped);
      ended();
  }
}

/** A hunt that takes a browser too long is said to, before it is made. */
function large({ expected, words }) {
  const box = find("large");
  box.hidden = false;
  find("far").textContent = "";
  const text = words ?? `This hunt takes about ${Math.round(expected / 1e6).toLocaleString("en")} million team moves: some ${Math.max(1, Math.round(expected / 1.2e8)).toLocaleString("en")} minutes in a browser, on one thread.`;
  box.replaceChildren(
    make("p", { textContent: `${text} ${command ? "In a terminal all processors do it:" : "Hunt within smaller bounds."}` }),
    ...command ? [make("code", { textContent: command })] : [],
    make("div", { className: "row" }, make("button", { textContent: "Hunt here", onclick: () => { box.hidden = true; hunter.postMessage({ kind: "allow" }); } }), make("button", { textContent: "Leave it", onclick: halt })));
}

function halt() {
  find("large").hidden = true;
  find("far").textContent = "Stopping …";
  hunter?.postMessage({ kind: "stop" });
  const stopping = hunter;
  // A slice that takes long is not waited for: what was found before it stands.
  setTimeout(() => { if (hunter === stopping && hunter) ended({ words: "Stopped. What was found so far stands below." }); }, 1500);
}

function ended(why = {}) {
  hunter?.terminate();
  hunter = null;
  find("find").hidden = false;
  find("stop").hidden = find("progress").hidden = find("large").hidden = true;
  if (why.error) {
    find("far").className = "fault";
    find("far").textContent = `${capital(why.error)}. ${why.remedy ? `${capital(why.remedy)}.` : ""}`;
  } else if (why.words) find("far").textContent = why.words;
}

/** The findings, each a button that puts it on the board; the first one is put there at once, if nothing was drawn or chosen since. */
function show(found, isDone, isStopped = false) {
  if (found.error) return ended(found);
  if (isDone) find("far").textContent = [isStopped ? "Stopped." : "", found.title ? `${capital(found.title)}.` : "", found.outcome ?? ""].filter(part => part).join(" ");
  find("found").replaceChildren(...found.found.map(one => make("li", {}, make("button", { onclick: () => put(one) }, make("b", { textContent: one.clause }), ` ${one.title}. ${one.sentence ?? ""}`))));
  if (found.found.length && !isOnBoard) { isOnBoard = true; if (JSON.stringify(full()) === sought) put(found.found[0]); }
}

/** Puts a counterexample on the board, at its last step. */
function put(one) {
  const list = [...find("found").children], { textContent, className } = find("far");
  restore({ settings: one.settings, answers: one.answers, steps: one.steps ?? MOST_STEPS });
  find("found").replaceChildren(...list);
  Object.assign(find("far"), { textContent, className });
  if (one.story && !board) find("say").textContent = one.story;
}

// ---- Links and files

const VERSION = 1;
/** Steps that are made at once: more of them would keep the page from answering. */
const MOST_STEPS = 100000;

function checksum(text) {
  let sum = 0x811c9dc5;
  for (let i = 0; i < text.length; i++) sum = Math.imul(sum ^ text.charCodeAt(i), 0x01000193) >>> 0;
  return sum.toString(36);
}

/** All that makes the page what it is. */
function held() {
  const all = given();
  while (all.length && all.at(-1) === -1) all.pop();
  return { settings: fullAtStart(), answers: all, steps: at + (over && at === frames.length - 1 ? 1 : 0), hand: isByHand };
}

function linkOf(all) {
  const text = btoa(String.fromCharCode(...new TextEncoder().encode(JSON.stringify(all)))).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
  return `#${VERSION}.${text}.${checksum(text)}`;
}

/** What a link holds, or what is wrong with it. */
function readLink(hash) {
  const [version, text, sum] = hash.slice(1).split(".");
  if (version !== String(VERSION)) return /^\d+$/.test(version) ? { error: `this link is of version ${version}, and this page reads version ${VERSION}`, remedy: "open it with the page that made it" } : { error: "this is no link of this page", remedy: "copy the whole link again" };
  if (!text || checksum(text) !== sum) return { error: "this link is cut or changed", remedy: "copy the whole link again" };
  try {
    const all = JSON.parse(new TextDecoder().decode(Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), sign => sign.charCodeAt(0))));
    if (all?.settings?.ground?.length) return all;
  } catch { /* It is said below. */ }
  return { error: "this link is damaged", remedy: "copy the whole link again" };
}

/** Makes the page what a link, a file or a finding holds; it is false if the page does not know the scheme or the rule. */
function restore({ settings: all, answers: given = [], steps = 0, hand = false }) {
  const { ground, ...rest } = all, remedy = "open it with the page that made it, or a newer one";
  if (!schemeOf(rest.scheme)) return complain({ error: `this page does not know the scheme ${rest.scheme}`, remedy });
  if (!schemeOf(rest.scheme).rules.some(({ name }) => name === rest.rule)) return complain({ error: `this page does not know the rule ${rest.rule} of ${rest.scheme}`, remedy });
  readGround(ground);
  if (schemeOf(rest.scheme).by_hand !== "only") drawn = null;
  settings = { on: null, robots: 1, seed: 0, base: null, starts: [], options: {}, ...rest };
  isByHand = find("hand").checked = hand;
  form();
  open(Math.min(steps, MOST_STEPS), given);
  return true;
}

function complain({ error, remedy }) {
  find("kept").className = "fault";
  find("kept").textContent = `${capital(error)}. ${remedy ? `${capital(remedy)}.` : ""}`;
  return false;
}

function keep(words) {
  find("kept").className = "";
  find("kept").textContent = words;
}

function save(name, type, text) {
  const link = make("a", { href: URL.createObjectURL(new Blob([text], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  keep(`${name} is saved.`);
}

/** The board as a picture that stands alone, in the colours of the page. */
function picture() {
  const style = getComputedStyle(document.documentElement);
  const colours = ["unexplored", "explored", "outside", "blocked", "line", "ink", "soft", "robot", "leader", "base", "name", "bad", "barred", "open", "aim", "closing", "closed", "sealed", "accent"].map(name => `--${name}:${style.getPropertyValue(`--${name}`).trim()}`).join(";");
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="-4 -4 ${columns * CELL + 8} ${rows * CELL + 8}" width="${columns * CELL + 8}"><title>${settings.scheme} (${settings.rule}), step ${at}</title><style>svg{${colours}}${STYLE}</style>${drawing(true)}</svg>\n`;
}

async function dropped(file) {
  keep(`Reading ${file.name} …`);
  if (file.size > 16 << 20) return complain({ error: `${file.name} is larger than 16 MB`, remedy: "read it with tautline in a terminal" });
  let text;
  try {
    text = new TextDecoder("utf-8", { fatal: true }).decode(await file.arrayBuffer());
  } catch {
    return complain({ error: `${file.name} is no text`, remedy: "drop a layout, a MovingAI map or a stored run" });
  }
  const read = asked({ do: "read", name: file.name, text });
  if (read.error) return complain({ error: `${file.name}: ${read.error}`, remedy: read.remedy });
  if (read.run) {
    restore({ settings: read.run.settings, steps: read.run.steps + 1 });
    keep(`${file.name} is a run of ${counted(read.run.steps, "team move")}${read.run.clause ? ` that breaks ${read.run.clause}` : ""}; it is as stored.`);
    return;
  }
  readGround(read.layout.ground);
  drawn = null;
  settings.starts = [];
  settings.base = read.layout.base;
  if (read.layout.robots) settings.robots = read.layout.robots;
  cursor = [0, 0];
  form();
  open();
  keep(`${file.name} is a layout of ${columns} × ${rows} cells.`);
}

// ---- Everything together

const labelOf = input => input.ariaLabel ?? input.labels[0].textContent.trim();
const range = ({ min, max, step }) => `a ${step === "any" ? "" : "whole "}number ${max ? `from ${min} to ${max}` : `of at least ${min}`} is needed`;

/** The number of a field. One that cannot be is said to, and the field shows the old one again. */
function read(id, old) {
  const input = find(id);
  if (input.value && input.checkValidity()) return +input.value;
  input.value = old;
  complain({ error: `“${labelOf(input)}”: ${range(input)}`, remedy: `${old} stays` });
  return null;
}

function listen() {
  find("scheme").onchange = event => choose(event.target.value);
  find("rule").onchange = event => { settings.rule = event.target.value; settings.on = null; form(); open(); };
  find("robots").onchange = () => {
    const robots = read("robots", settings.robots);
    if (robots === null) return;
    settings.robots = robots;
    if (settings.starts?.length > 1) settings.starts = settings.starts.slice(0, settings.robots);
    huntBounds();
    open();
  };
  find("seed").onchange = () => {
    const seed = read("seed", settings.seed ?? 0);
    if (seed !== null) { settings.seed = seed; open(); }
  };
  find("miss").onchange = event => { settings.miss = +event.target.value || 0; open(); };
  for (const [id, old] of [["columns", () => columns], ["rows", () => rows]]) find(id).onchange = () => {
    const size = read(id, old());
    if (size === null) return;
    resize(id === "columns" ? size : columns, id === "rows" ? size : rows);
    open();
  };
  find("at").oninput = event => { pause(); go(+event.target.value); };
  find("first").onclick = () => { pause(); go(0); };
  find("back").onclick = () => { pause(); question = null; go(at - 1); };
  find("run").onclick = run;
  find("step").onclick = () => { pause(); step(); };
  find("hand").onchange = event => {
    isByHand = event.target.checked;
    question = null;
    if (scheme().by_hand === "world") {
      settings.world = isByHand;
      open();
    } else render();
  };
  find("refusals").onclick = () => {
    refused = refused ? null : refusals();
    render();
  };
  find("find").onclick = seek;
  find("stop").onclick = halt;
  find("clear").onclick = () => { blank(columns, rows); settings.starts = []; settings.base = null; edited("The layout is clear."); };
  find("link").onclick = async () => {
    history.replaceState(null, "", linkOf(held()));
    try {
      await navigator.clipboard.writeText(location.href);
      keep("The link is copied. It holds the layout, the settings and the step that is shown.");
    } catch {
      keep("The link stands in the address bar. It holds the layout, the settings and the step that is shown.");
    }
  };
  find("picture").onclick = () => save(`tautline-${settings.scheme}.svg`, "image/svg+xml", picture());
  find("drawing").onclick = () => {
    const drawn = asked({ do: "draw", settings: full() });
    if (drawn.error) return complain(drawn);
    save("layout.txt", "text/plain", drawn.text);
    if (settings.starts?.length > 1) keep(`layout.txt is saved. A drawing holds no starts: ${settings.starts.map(cell => `--start ${cell}`).join(" ")} gives them in a terminal.`);
  };
  find("store").onclick = () => {
    // Walls that were decided by hand are in the ground; other answers are not.
    if (["sensors", "choices"].includes(scheme().by_hand) && answers.some(answer => answer > 0)) return complain({ error: "a stored run does not hold who acted first by hand, and what was missed or lost", remedy: "keep the link instead: it does" });
    const stored = asked({ do: "store", settings: full() });
    if (stored.error) complain(stored); else save(`${settings.scheme}-${settings.rule}.jsonl`, "application/x-ndjson", stored.text);
  };
  find("file").onchange = event => { if (event.target.files[0]) dropped(event.target.files[0]); event.target.value = ""; };
  addEventListener("dragover", event => { event.preventDefault(); document.body.classList.add("drop"); });
  addEventListener("dragleave", () => document.body.classList.remove("drop"));
  addEventListener("drop", event => {
    event.preventDefault();
    document.body.classList.remove("drop");
    if (event.dataTransfer.files[0]) dropped(event.dataTransfer.files[0]);
  });
  addEventListener("hashchange", fromLink);
  pointers();
  keys();
}

function fromLink() {
  if (location.hash.length < 2) return false;
  const all = readLink(location.hash);
  if (all.error) return complain(all);
  try {
    // The engine knows what settings can be: what it does not take is not put on the page.
    const tried = schemeOf(all.settings.scheme) ? asked({ do: "open", settings: all.settings, answers: all.answers ?? [] }) : {};
    if (tried.error) return complain({ error: `this link cannot be played: ${tried.error}`, remedy: "copy the whole link again" });
    if (!restore(all)) return false;
  } catch {
    return complain({ error: "this link is damaged", remedy: "copy the whole link again" });
  }
  keep("");
  return true;
}

async function begin() {
  try {
    await load();
  } catch (error) {
    find("say").textContent = `The engine does not run in this browser: ${error}`;
    return;
  }
  ({ schemes } = ask({ do: "schemes" }));
  blank(7, 7);
  const first = schemes[0], own = first.rules.find(({ name }) => name === "repaired") ?? first.rules[0];
  settings = { scheme: first.name, rule: own.name, on: null, robots: 4, seed: 0, base: [3, 3], starts: [], options: {} };
  if (first.opens) firstLayout(first.opens);
  listen();
  if (!fromLink()) { form(); open(); }
  document.body.dataset.ready = "yes";
}

begin();
