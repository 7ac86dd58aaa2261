/** A rectangle of the timeline: `{feet: [first, last], samples: [first, last]}`, 0-based, both ends included. */

import { clamp } from "../lib/clamp.js";

const sizeOf = ({ timeline }) => [timeline.feet.length, timeline.feet[0].length];

/** The whole timeline. */
export function wholeOf(document) {
  const [feet, samples] = sizeOf(document);
  return { feet: [0, feet - 1], samples: [0, samples - 1] };
}

/** The rectangle between two cells, each [foot, sample]. */
export const spanning = ([foot, sample], [otherFoot, otherSample]) => ({
  feet: [Math.min(foot, otherFoot), Math.max(foot, otherFoot)],
  samples: [Math.min(sample, otherSample), Math.max(sample, otherSample)],
});

/** The part of a region that lies on the timeline; null where none does. */
export function within(document, region) {
  const [feet, samples] = sizeOf(document);
  if (!region || region.feet[0] >= feet || region.samples[0] >= samples) return null;
  const clamped = (range, count) => range.map((value) => clamp(value, 0, count - 1));
  return { feet: clamped(region.feet, feet), samples: clamped(region.samples, samples) };
}

export const lengthOf = ({ samples: [first, last] }) => last - first + 1;

export const feetOf = ({ feet: [first, last] }) =>
  Array.from({ length: last - first + 1 }, (_, index) => first + index);

export const samplesOf = ({ samples: [first, last] }) =>
  Array.from({ length: last - first + 1 }, (_, index) => first + index);

export const cellsOf = (region) =>
  feetOf(region).flatMap((foot) => samplesOf(region).map((sample) => [foot, sample]));

export const hasCell = ({ feet, samples }, [foot, sample]) =>
  foot >= feet[0] && foot <= feet[1] && sample >= samples[0] && sample <= samples[1];

export const allFeet = (document, { feet: [first, last] }) =>
  first === 0 && last === document.timeline.feet.length - 1;

export const isWhole = (document, region) =>
  allFeet(document, region) && lengthOf(region) === document.timeline.feet[0].length;

const range = (one, many, [first, last]) =>
  first === last ? `${one} ${first + 1}` : `${many} ${first + 1}–${last + 1}`;

/** In words, counted from 1: "foot 3, samples 6–10". */
export function regionText(document, region) {
  if (isWhole(document, region)) return "the whole timeline";
  const feet = allFeet(document, region) ? "all feet" : range("foot", "feet", region.feet);
  return lengthOf(region) === document.timeline.feet[0].length
    ? `all of ${feet}`
    : `${feet}, ${range("sample", "samples", region.samples)}`;
}
