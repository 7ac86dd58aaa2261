/** The text of a chosen file: UTF-8 to the last character, anything else refused. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { textOf } from "../../../app/static/lib/file_text.js";

/** @param {Uint8Array<ArrayBuffer>} bytes */
const file = (bytes) => new File([bytes], "mine.csv");

for (const text of ["0.1,0.2\n", "\ufeff0.1\r\n", "Länge\n", "", "\u{1f600}"]) {
  test(`UTF-8 stays as it is: ${JSON.stringify(text)}`, async () => {
    assert.equal(await textOf(file(new TextEncoder().encode(text))), text);
  });
}

for (const bytes of [
  [0xff, 0xfe, 0x31, 0x00],
  [0xfe, 0xff, 0x00, 0x31],
  [0x31, 0x00, 0x2c, 0x00],
  [0x4c, 0xe4, 0x6e],
  [0x50, 0x4b, 0x03, 0x04, 0x14, 0x00],
]) {
  test(`what is no UTF-8 is refused: ${bytes}`, async () => {
    await assert.rejects(textOf(file(new Uint8Array(bytes))), /mine\.csv is not text in UTF-8\. Save it/);
  });
}
