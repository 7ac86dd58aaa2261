/** The card at the pointer: a time, and the values of all feet at that time. */

import { MOTORS, fixed } from "../lib/format.js";
import { h, setText } from "../lib/dom.js";

const AWAY_PX = 14;
const known = (value, decimals = 1) =>
  (value ?? null) === null || !Number.isFinite(value) ? "–" : fixed(value, decimals);
const motors = Array.from({ length: MOTORS }, (_, motor) => motor);

function footRow(foot, role) {
  const cells = Array.from({ length: 1 + MOTORS }, () => h("td", { class: "number" }));
  const row = h(
    "tr",
    { data: { foot: foot + 1 } },
    h("th", { scope: "row" }, h("i", { class: "foot-dot" }), ` ${foot + 1} ${role}`),
    ...cells,
  );
  return { row, cells };
}

/** Builds the card in `place`; `show` shows it, `hide` hides it. */
export function plotCard(place) {
  const [time, robot, note] = [h("b", {}), h("span", { class: "quiet" }), h("p", { class: "quiet" })];
  const body = h("tbody", {});
  const margin = h("b", { class: "number" });
  const head = h(
    "tr",
    {},
    ...["Foot", "Lift mm", ...motors.map((motor) => `M${motor + 1} mm`)].map((text) =>
      h("th", { scope: "col", text }),
    ),
  );
  const element = h(
    "div",
    { class: "plot-card", "aria-hidden": "true", hidden: true },
    h("div", { class: "plot-card-head" }, time, robot),
    h("table", {}, h("thead", {}, head), body),
    h("div", { class: "plot-card-head" }, h("span", { text: "Margin" }), margin),
    note,
  );
  place.append(element);
  let rows = [];
  let named = "";

  function fit(roles) {
    if (roles.join() === named) return;
    named = roles.join();
    rows = roles.map((role, foot) => footRow(foot, role));
    body.replaceChildren(...rows.map(({ row }) => row));
  }

  /** Places the card beside the pointer, inside the window. */
  function put({ clientX, clientY }) {
    const { offsetWidth: width, offsetHeight: height } = element;
    const left =
      clientX + AWAY_PX + width > window.innerWidth ? clientX - AWAY_PX - width : clientX + AWAY_PX;
    const top = Math.min(Math.max(clientY - height / 2, 4), window.innerHeight - height - 4);
    element.style.transform = `translate(${Math.round(Math.max(left, 4))}px, ${Math.round(top)}px)`;
  }

  return {
    /**
     * @param {{clientX: number, clientY: number}} event of the pointer
     * @param {Record<string, any>} values `time`, `robotTime` (null for none), `roles`, `lifts` and `strokes`
     *   (mm; null for none), `margin` (mm), `nearest` ({foot, motor} under the pointer) and `note`
     */
    show(event, { time: seconds, robotTime, roles, lifts, strokes, margin: room, nearest, note: words }) {
      fit(roles);
      setText(time, `${fixed(seconds, 2)} s plan`);
      setText(robot, robotTime === null ? "" : `${fixed(robotTime)} s on the robot`);
      rows.forEach(({ row, cells }, foot) => {
        row.toggleAttribute("data-near", nearest?.foot === foot);
        const lift = lifts[foot];
        setText(cells[0], Math.abs(lift) < 0.05 ? "down" : known(lift));
        motors.forEach((motor) => {
          setText(cells[1 + motor], known(strokes?.[foot * MOTORS + motor]));
          cells[1 + motor].toggleAttribute("data-near", nearest?.foot === foot && nearest.motor === motor);
        });
      });
      setText(margin, room === null ? "–" : `${fixed(room)} mm`);
      setText(note, words);
      note.hidden = !words;
      element.hidden = false;
      put(event);
    },
    hide() {
      element.hidden = true;
    },
  };
}
