/** What a strip of the plots draws: a row for each foot, limits, and lines that feet share. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { acrossOf } from "../../../app/static/plots/curves.js";
import { stripPicture } from "../../../app/static/plots/strip_picture.js";

function pictureOf({ rows, feet, lanes = false, ...content }) {
  const times = rows[0].map((_, index) => index);
  const axis = { start: -0.5, step: 1, first: 0, shown: times.length };
  const series = rows.map((row, at) => {
    return { foot: feet[at], motor: lanes ? at % 3 : null, valueAt: (index) => row[index] };
  });
  const across = acrossOf(axis, times);
  const view = { axis, across, count: times.length, overs: [], rules: [], grey: null, isUnder: false };
  return stripPicture({ floor: null, ...content, lanes, series }, view);
}

function assertClose(value, expected) {
  assert.ok(Math.abs(value - expected) <= 1e-6 * Math.abs(expected), `${value} is not ${expected}`);
}

test("a foot has a row of its own and the bad colour is beyond its limit", () => {
  const rows = [...Array(3).fill([5, 9, 12, 5]), ...Array(3).fill([5, 6, 7, 5])];
  const picture = pictureOf({ rows, feet: [0, 0, 0, 1, 1, 1], lanes: true, low: 0, high: 10 });
  const { bands, scaleFor, drawing } = picture;
  const probes = [
    [0, 10],
    [1, 10],
    [1, 5],
  ];
  const [first, second, half] = probes.map(([foot, value]) => scaleFor(foot)(value));
  assert.deepEqual(
    bands.map(({ top, bottom }) => [top, bottom]),
    [
      [0, 50],
      [50, 100],
    ],
  );
  assertClose(first, drawing.clips[0].height);
  assert.equal(drawing.clips[1].y, 50);
  assertClose(drawing.clips[1].height, second - 50);
  assert.ok(50 < second && second < half && half < 100);
  assert.deepEqual(
    drawing.curves.map(({ width }) => width),
    [2, 1.25, 0.75, 2, 1.25, 0.75],
  );
});

test("a limit far from the values is named but not drawn", () => {
  const { named, drawing } = pictureOf({ rows: [[3, 4, 5]], feet: [0], low: 0.5, high: 30, most: null });
  assert.deepEqual(
    new Set(named.map(({ value, away }) => `${value} ${away}`)),
    new Set(["30 up", "0.5 null"]),
  );
  assert.deepEqual(
    drawing.lines.map(({ kind }) => kind),
    ["limit"],
  );
});

test("feet that rise together share one line and feet that stand are not drawn", () => {
  const rise = [0, 0, 1, 3, 3, 1, 0, 0];
  const stay = Array(8).fill(0);
  const picture = pictureOf({ rows: [rise, stay, rise], feet: [0, 1, 2], rises: true, floor: 0 });
  const [first, never, third] = picture.drawing.curves;
  assert.equal(never.d, "");
  assert.deepEqual(
    [first.dash, third.dash],
    [
      [7, 7],
      [7, 7],
    ],
  );
  assert.notEqual(first.offset, third.offset);
  // The sample before the rise and the one after it belong to it.
  assert.equal(first.d.split("L").length - 1, 5);
  assert.deepEqual(
    picture.peaks.map(({ foot }) => foot),
    [0, 2],
  );
});
