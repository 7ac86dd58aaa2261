/** The range of colours that a person clicks in a picture. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { rangeOf } from "../../../app/static/cameras/camera_feet.js";

test("a clicked colour gives a range, over red too, and grey gives none", () => {
  const [lowRed, highRed] = rangeOf([
    [220, 30, 40],
    [220, 40, 30],
    [200, 30, 30],
  ]).hue;
  assert.ok(lowRed > 0.9);
  assert.ok(highRed < 0.1);
  const [lowBlue, highBlue] = rangeOf([
    [30, 60, 220],
    [40, 70, 230],
  ]).hue;
  assert.ok(lowBlue < 0.64 && 0.64 < highBlue && highBlue < lowBlue + 0.2);
  assert.equal(
    rangeOf([
      [120, 120, 122],
      [90, 91, 90],
    ]),
    null,
  );
});
