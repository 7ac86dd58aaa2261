/** The fields that say which feet are held up at the start and at the end. */

import { textField } from "../state/fields.js";
import { heldOf, withHeld } from "../document/held_feet.js";

function refusal(feet, text, legs) {
  const odd = feet.find((foot, at) => foot < 1 || foot > legs || feet.indexOf(foot) !== at);
  if (odd !== undefined) return `“${text}” must name feet 1 to ${legs}, each once; leave it empty for none.`;
  return feet.length >= legs ? "The robot would fall with every foot up: keep at least three down." : null;
}

function heldField(store, edits, end, words) {
  return textField(store, {
    label: words, name: `Held ${words.toLowerCase()}`,
    help: `Feet that rest in the air at the ${end === "start" ? "first" : "last"} sample, where their rows must swing; empty for none`,
    read: (document) => heldOf(document)[end].join(" "),
    commit(text) {
      const shown = edits.shown();
      const feet = text.split(/[^0-9]+/).filter(Boolean).map(Number);
      const sentence = refusal(feet, text, shown.timeline.feet.length);
      if (!sentence && feet.join() !== heldOf(shown)[end].join()) {
        edits.edit((document) => withHeld(document, { ...heldOf(document), [end]: feet }), feet.length ? `Hold up ${feet.join(", ")} at the ${end}` : `Hold none up at the ${end}`);
      }
      return sentence;
    },
  });
}

/** The fields of both ends. */
export const heldFields = (store, edits) => [heldField(store, edits, "start", "Up at start"), heldField(store, edits, "end", "Up at end")];
