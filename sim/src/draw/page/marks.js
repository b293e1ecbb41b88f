"use strict";
// Marks of things that are somewhere, or are taken to be: every page draws them so.

/** The figures of marks in a legend, by ink: what is so, and what is a guess. */
const MARK_KEY = { guess: [0, 0, 250, 150, 300], wall: [0, 0] };

/**
 * The drawing of a mark as the path of an SVG. The numbers of a mark are its place, in thousandths of a cell's side from the midpoint
 * of cell 0,0; then, if it is a guess, the two standard deviations, the correlation in thousandths, and the heading of a robot with
 * its standard deviation in milliradians. A guess is a cross in the ellipse that it is in with 95 %, between two strokes for a
 * heading; what is so is a square. `place(x, y)` is a place in cells on the board, `unit` the side of a cell there.
 */
function markPath([x, y, dx, dy, correlation, heading, deviation], place, unit) {
  const WITHIN = Math.sqrt(5.991), at = (u, v) => place((x + u) / 1000 + .5, (y + v) / 1000 + .5).map(part => part.toFixed(2)).join(" ");
  const [px, py] = place(x / 1000 + .5, y / 1000 + .5), r = unit * .07;
  if (dx === undefined) return `M${px - r} ${py - r}h${2 * r}v${2 * r}h${-2 * r}z`;
  const across = correlation / 1000, along = Math.sqrt(Math.max(1 - across * across, 0)), points = [];
  for (let k = 0; k < 48; k++) {
    const cosine = Math.cos(k * Math.PI / 24), sine = Math.sin(k * Math.PI / 24);
    points.push(at(WITHIN * dx * cosine, WITHIN * dy * (across * cosine + along * sine)));
  }
  const strokes = heading === undefined ? [] : [-1.96, 1.96].map(times => (heading + times * deviation) / 1000);
  return `M${px - r} ${py}h${2 * r}M${px} ${py - r}v${2 * r}M${points.join("L")}z`
    + strokes.map(angle => `M${at(0, 0)}L${at(480 * Math.cos(angle), 480 * Math.sin(angle))}`).join("");
}
