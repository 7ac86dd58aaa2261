/** The robots that a gait may be for, and the choice of one in the gait's own fields. */

import { api } from "../api/gaits.js";
import { h } from "../lib/dom.js";
import { attempt } from "../lib/toasts.js";

let request = null;

/** Every robot with its title, legs, motors and foot orders; requested once. */
export function robots() {
  request ??= api.robots().then(
    (answer) => answer.robots,
    (error) => {
      request = null;
      throw error;
    },
  );
  return request;
}

/** An option a robot. A robot with other legs is marked, since choosing it makes a new gait. */
export function robotOptions(list, legs = null) {
  return list.map(({ name, title, legs: own }) =>
    h("option", { value: name, text: legs === null || own === legs ? title : `${title}…` }),
  );
}

/**
 * The choice of the gait's robot: one with as many legs is an edit, any other one leads to a new gait.
 * @param {import("../state/edits.js").Edits} edits
 * @param {(robot: Record<string, any>, document: Record<string, any>) => void} makeNew asks for a new gait
 */
export function robotField(edits, makeNew) {
  const select = h("select", { "aria-label": "Robot" });
  const title =
    "The robot that walks this gait. "
    + "If you choose a robot with a different number of legs, a dialog for a new gait opens";
  const element = h(
    "label",
    { class: "field robot-field", title },
    h("span", { class: "name", text: "Robot" }),
    select,
  );
  let [known, shown, legs] = [[], null, null];

  function fill() {
    if (!shown) return;
    const own = shown.timeline.feet.length;
    if (known.length && own !== legs) {
      legs = own;
      select.replaceChildren(...robotOptions(known, legs));
    }
    select.value = shown.robot;
  }

  select.addEventListener("change", () => {
    const chosen = known.find(({ name }) => name === select.value);
    const document = edits.shown();
    fill();
    if (chosen.legs !== document.timeline.feet.length) makeNew(chosen, document);
    else edits.edit((before) => ({ ...before, robot: chosen.name }), `Robot to ${chosen.title}`);
  });
  attempt(async () => {
    known = await robots();
    fill();
  })();
  return {
    element,
    show: (document) => {
      shown = document;
      fill();
    },
  };
}
