/** The optimiser's options: their fields, and those that depend on each other or on the feet. */

import { drawnOrder, isDrawn } from "../document/drawn_timeline.js";
import { heldOf, withHeld } from "../document/held_feet.js";
import { robotField } from "../shell/robots.js";
import { choiceField, numberField, textField } from "../state/fields.js";
import { notesField } from "./notes_field.js";
import { CHOICES, ITERATIONS, LIMITS, MORE_CHOICES, MORE_NUMBERS, SHARES, STEP } from "./option_fields.js";
import { OVERLAP, POSE_CHOICES, POSE_NUMBERS } from "./pose_option_fields.js";

function orderField(store, edits) {
  return textField(store, {
    label: "Foot order",
    name: "Foot order",
    help: "The order in which the feet step. If you change the order, the timeline is drawn again",
    read: (document) => drawnOrder(document).join(" "),
    commit(text) {
      const document = edits.shown();
      const [order, options] = [drawnOrder(document), document.options];
      const digits = text.split(/[^0-9]+/).filter(Boolean);
      const wanted = (digits.length === 1 && digits[0].length === order.length ? [...digits[0]] : digits).map(
        Number,
      );
      if ([...wanted].sort((a, b) => a - b).join() !== [...order].sort((a, b) => a - b).join()) {
        return (
          `The foot order “${text}” must contain each of the ${order.length} feet exactly once. `
          + `Type for example ${order.join(" ")}.`
        );
      }
      if (wanted.join() !== order.join())
        edits.redraw({
          order: wanted,
          phase_knots: options.phase_knots,
          closing_knots: options.closing_knots,
        });
      return null;
    },
  });
}

function phaseFields(store, edits) {
  const redraw = (change) => {
    const { order, options } = edits.shown();
    edits.redraw({
      order,
      phase_knots: options.phase_knots,
      closing_knots: options.closing_knots,
      ...change,
    });
  };
  const knots = { unit: "samples", step: 1, decimals: 0, whole: true, fallback: 5, unsaid: "as drawn" };
  const asDrawn = (name) => ({ read: (document) => (isDrawn(document) ? document.options[name] : null) });
  return [
    {
      label: "Phase length",
      name: "Phase length",
      min: 2,
      max: 50,
      help:
        "Number of samples of each swing "
        + "and of each stance phase. If you change the number, the timeline is drawn again",
      ...knots,
      ...asDrawn("phase_knots"),
      act: (value) => redraw({ phase_knots: value }),
    },
    {
      label: "Final stance",
      name: "Final stance",
      min: 0,
      max: 100,
      help:
        "Number of samples with all "
        + "feet down after the last swing. If you change the number, the timeline is drawn again",
      ...knots,
      ...asDrawn("closing_knots"),
      act: (value) => redraw({ closing_knots: value }),
    },
  ].map((field) => numberField(store, edits, field));
}

/**
 * Builds all fields.
 * @param {import("../state/store.js").Store} store
 * @param {import("../state/edits.js").Edits} edits
 * @param {(robot: Record<string, any>, document: Record<string, any>) => void} makeNew offers a new gait for
 *   a robot with other legs
 * @returns {Record<string, any>} `robot`, `order`, and lists `main` and `more`: fields with `element` and
 *   `show(document)`
 */
export function optimiserOptions(store, edits, makeNew) {
  const number = (field) => numberField(store, edits, field);
  const choice = (field) => choiceField(edits, field);
  return {
    robot: robotField(edits, makeNew),
    order: orderField(store, edits),
    main: [
      ...STEP.map(number),
      ...POSE_CHOICES.map(choice),
      number(ITERATIONS),
      ...phaseFields(store, edits),
      ...LIMITS.map(number),
    ],
    more: [
      choice(OVERLAP),
      ...[...POSE_NUMBERS, ...SHARES].map(number),
      ...CHOICES.map(choice),
      ...MORE_NUMBERS.map(number),
      ...MORE_CHOICES.map(choice),
      ...heldFields(store, edits),
      notesField(store, edits),
    ],
  };
}

function refusal(feet, text, legs) {
  const odd = feet.find((foot, at) => foot < 1 || foot > legs || feet.indexOf(foot) !== at);
  if (odd !== undefined)
    return (
      `“${text}” is not valid. Type feet from 1 to ${legs}, each foot at most `
      + `once. To hold up no foot, leave the field empty.`
    );
  return feet.length >= legs ? "The robot falls when all feet are up. Keep at least three feet down." : null;
}

function heldField(store, edits, end, words) {
  return textField(store, {
    label: words,
    name: `Held ${words.toLowerCase()}`,
    help:
      `Feet that the robot holds up at the ${end === "start" ? "first" : "last"} sample. `
      + `These feet must swing at this sample on the timeline. To hold up no foot, leave the field empty`,
    read: (document) => heldOf(document)[end].join(" "),
    commit(text) {
      const shown = edits.shown();
      const feet = text
        .split(/[^0-9]+/)
        .filter(Boolean)
        .map(Number);
      const sentence = refusal(feet, text, shown.timeline.feet.length);
      if (!sentence && feet.join() !== heldOf(shown)[end].join()) {
        edits.edit(
          (document) => withHeld(document, { ...heldOf(document), [end]: feet }),
          feet.length
            ? `Hold up ${feet.length > 1 ? "feet" : "foot"} ${feet.join(", ")} at the ${end}`
            : `Hold no foot up at the ${end}`,
        );
      }
      return sentence;
    },
  });
}

/** The fields of both ends. */
const heldFields = (store, edits) => [
  heldField(store, edits, "start", "Up at start"),
  heldField(store, edits, "end", "Up at end"),
];
