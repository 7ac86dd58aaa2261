/** Why a sequence has no motion, or why an edit of it was refused, and the one click that helps. */

import { restarted } from "../document/sequence_edits.js";
import { h, setText } from "../lib/dom.js";

/** What a refusal names that different sample times are the reason of. */
export const SAMPLE_TIMES = "sample_time";

const RESAMPLE =
  "Gives all parts the sample time that most parts have. "
  + "Phases are rounded up to whole samples, so no motion becomes faster. "
  + "Optimised parts that change must be optimised again. One Undo reverts the whole change.";
const RESTART =
  "Each repetition starts and ends at rest, like a part that runs only once. "
  + "One Undo reverts this change.";

/** The parts that have no motion without a pause but one of their own, counted from 0. */
const restartable = (plan) =>
  (plan?.parts ?? []).filter((part) => part.has_own_motion).map(({ part }) => part);

/**
 * @param {import("../state/edits.js").Edits} edits
 */
export function sequenceTrouble(edits) {
  let act = null;
  const sentence = h("span");
  const button = h("button", { on: { click: () => act?.() } });
  const price = h("p", { class: "why" });
  const help = h("div", {}, h("div", { class: "buttons" }, button), price);
  const element = h(
    "div",
    { class: "box-note", role: "alert", data: { tone: "bad" }, hidden: true },
    sentence,
    help,
  );

  function offer(text, words, doIt) {
    act = doIt;
    help.hidden = !doIt;
    setText(button, text);
    setText(price, words);
  }

  /**
   * What helps against what is shown; nothing where no single click does.
   * @param {Record<string, any>} state
   * @param {Record<string, any>} document
   * @param {Record<string, any>|null} plan
   */
  function chosen({ formError, formRefusal }, document, plan) {
    if (formError) {
      const isTimes = formRefusal?.sentence === formError && formRefusal.where === SAMPLE_TIMES;
      return isTimes
        ? ["Resample", RESAMPLE, formRefusal.resample ?? (() => edits.resample(formRefusal.batch))]
        : null;
    }
    const parts = restartable(plan).filter((part) => document.sequence[part]);
    if (!parts.length) return null;
    const start = () => {
      const { apply, label } = restarted(document, parts, true);
      edits.edit(apply, label);
    };
    return ["Start each repetition from rest", RESTART, start];
  }

  return {
    element,
    show(state, document, plan) {
      const text = state.formError ?? plan?.refusal?.sentence ?? null;
      element.hidden = !text;
      setText(sentence, text ?? "");
      offer(...((text && chosen(state, document, plan)) || ["", "", null]));
    },
  };
}
