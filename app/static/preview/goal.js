/**
 * The goal as a handle over the 3D scene: dragged on the floor it changes the step, its knob on the ring the
 * turn. The live plan follows; letting go makes one edit.
 */

import { stepLength, stepTurn, withTurn, withWorldStep, worldStep } from "../document/step.js";
import { clamp } from "../lib/clamp.js";
import { byId, h, svg } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { previewedDocument, shownPlan } from "../state/store.js";
import { ARROWS, SNAP, floorOf, handle, movable, place, snapped } from "./handle.js";

const TURN_SNAP = 1;
const RING_ROOM = 0.022;
const RING_CORNERS = 64;
const UNKNOWN_RADIUS = 0.053;
const MOST_TURN = 90;
const FLATTEST_PX = 40;

const radians = (degrees) => (degrees * Math.PI) / 180;

/** Where the goal lies and which way the robot looks there, in the scene. */
export function goalOf(document, plan) {
  const [x, y] = worldStep(document).map((value) => value * document.iterations);
  const front = (document.orientation === "FB" ? 45 : 0) + 90 * (document.direction - 1);
  const body = plan?.body?.[0] ?? [0, 0];
  const reach = plan?.feet?.[0]?.map((foot) => Math.hypot(foot[0] - body[0], foot[1] - body[1])) ?? [];
  return {
    x,
    y,
    front,
    heading: front + stepTurn(document) * document.iterations,
    radius: Math.max(UNKNOWN_RADIUS, ...reach) + RING_ROOM,
  };
}

const pathOf = (points) =>
  points.map(([x, y], index) => `${index ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");

/** Whether the floor is seen flat enough for a place on it to be pointed at. */
function isVisible(points) {
  if (points.includes(null)) return false;
  const heights = points.map(([, y]) => y);
  return Math.max(...heights) - Math.min(...heights) > FLATTEST_PX;
}

/** Draws the goal; false where it cannot be seen. */
function draw(parts, floor, goal, document) {
  const around = (degrees, radius) =>
    floor.toStage([
      goal.x + radius * Math.cos(radians(degrees)),
      goal.y + radius * Math.sin(radians(degrees)),
    ]);
  const [start, end, knob] = [
    floor.toStage([0, 0]),
    floor.toStage([goal.x, goal.y]),
    around(goal.heading, goal.radius),
  ];
  const corners = Array.from({ length: RING_CORNERS }, (_, index) =>
    around((360 * index) / RING_CORNERS, goal.radius),
  );
  if (!isVisible(corners) || !start || !end) return false;
  parts.ring.setAttribute("d", `${pathOf(corners)}Z`);
  parts.way.setAttribute("d", pathOf([start, end]));
  parts.look.setAttribute("d", pathOf([around(goal.heading, goal.radius * 0.86), knob]));
  parts.start.setAttribute("cx", start[0]);
  parts.start.setAttribute("cy", start[1]);
  place(parts.goal, end);
  place(parts.turn, knob);
  const label = document.iterations > 1 ? `${document.iterations} × ` : "";
  const turn = stepTurn(document);
  const length = `${label}${fixed(stepLength(document) * 1000)} mm`;
  parts.label.textContent = turn ? `${length}, ${fixed(turn, 0)}°` : length;
  place(parts.label, end);
  return true;
}

function describe(parts, document) {
  const [x, y] = worldStep(document).map((value) => value * 1000);
  const turn = stepTurn(document);
  parts.goal.setAttribute("aria-valuenow", fixed(stepLength(document) * 1000, 2));
  parts.goal.setAttribute(
    "aria-valuetext",
    `step ${fixed(stepLength(document) * 1000)} mm: x ${fixed(x)}, y ${fixed(y)} mm`,
  );
  parts.turn.setAttribute("aria-valuenow", turn.toFixed(1));
  parts.turn.setAttribute("aria-valuetext", `turn ${fixed(turn)}°`);
}

function stepDrag(edits, preview) {
  return {
    name: (document) => `Goal to ${fixed(stepLength(document) * 1000)} mm`,
    begin(pointer) {
      const [x, y] = floorOf(preview)?.ofPointer(pointer) ?? [];
      if (x === undefined) return null;
      const document = edits.shown();
      const now = worldStep(document).map((value) => value * document.iterations);
      return { offset: [now[0] - x, now[1] - y], iterations: document.iterations };
    },
    drag(pointer, { offset, iterations }, free) {
      const at = floorOf(preview)?.ofPointer(pointer);
      if (!at) return null;
      const step = at.map((value, axis) => (value + offset[axis]) / iterations);
      return (document) => withWorldStep(document, free ? step : step.map((value) => snapped(value, SNAP)));
    },
    key({ key, shiftKey }) {
      const way = ARROWS[key];
      if (!way) return null;
      const next = worldStep(edits.shown()).map(
        (value, axis) => value + way[axis] * SNAP * (shiftKey ? 10 : 1),
      );
      return (document) => withWorldStep(document, next);
    },
  };
}

function turnDrag(edits, preview, goal) {
  const angleAt = (pointer) => {
    const at = floorOf(preview)?.ofPointer(pointer);
    const { x, y } = goal();
    return at ? (Math.atan2(at[1] - y, at[0] - x) * 180) / Math.PI : null;
  };
  return {
    name: (document) => `Turn to ${fixed(stepTurn(document))}°`,
    begin(pointer) {
      const angle = angleAt(pointer);
      return angle === null
        ? null
        : { angle, turn: stepTurn(edits.shown()), iterations: edits.shown().iterations };
    },
    drag(pointer, { angle, turn, iterations }, free) {
      const now = angleAt(pointer);
      if (now === null) return null;
      const moved = ((now - angle + 540) % 360) - 180;
      const next = clamp(turn + moved / iterations, -MOST_TURN, MOST_TURN);
      return (document) => withTurn(document, free ? next : snapped(next, TURN_SNAP));
    },
    key({ key, shiftKey }) {
      const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[key];
      if (!way) return null;
      const next = clamp(
        stepTurn(edits.shown()) + way * TURN_SNAP * (shiftKey ? 10 : 1),
        -MOST_TURN,
        MOST_TURN,
      );
      return (document) => withTurn(document, next);
    },
  };
}

function build() {
  const parts = {
    ring: svg("path", { class: "ring" }),
    way: svg("path", { class: "way-line" }),
    look: svg("path", { class: "look" }),
    start: svg("circle", { class: "start", r: 3 }),
    goal: handle(
      "goal-place",
      "Goal",
      "Drag the goal on the floor to change the step. "
        + "The arrow keys change the step by 0.5 mm, with Shift by 5 mm",
    ),
    turn: handle(
      "goal-turn",
      "Goal turn",
      "Drag this handle around the goal to change the turn. "
        + "The arrow keys change the turn by 1°, with Shift by 10°",
    ),
    label: h("span", { class: "goal-label" }),
  };
  byId("goal").replaceChildren(
    svg("svg", { "aria-hidden": "true" }, parts.ring, parts.way, parts.look, parts.start),
    parts.turn,
    parts.label,
    parts.goal,
  );
  return parts;
}

/** Lays the goal over the scene and keeps it where the camera sees it. */
export function mountGoal(store, edits, preview) {
  const parts = build();
  const layer = byId("goal");
  let goal = null;
  let drawn = null;
  const cancels = [
    movable(parts.goal, store, edits, stepDrag(edits, preview)),
    movable(
      parts.turn,
      store,
      edits,
      turnDrag(edits, preview, () => goal),
    ),
  ];

  function follow() {
    requestAnimationFrame(follow);
    const document = layer.hidden ? null : previewedDocument(store.state);
    const floor = document && floorOf(preview);
    if (!floor) return;
    goal = goalOf(document, shownPlan(store.state));
    const key = `${floor.key} ${Object.values(goal)} ${document.step}`;
    if (key === drawn) return;
    const isFirst = drawn === null;
    drawn = key;
    layer.toggleAttribute("data-flat", !draw(parts, floor, goal, document));
    describe(parts, document);
    if (isFirst) show(store.state);
  }

  /** Where the scene's floor is not known the goal has no place. */
  const show = ({ iterate, view }) =>
    layer.toggleAttribute("data-off", Boolean(iterate) || !view || drawn === null);
  store.watch(({ iterate, view }) => [Boolean(iterate), Boolean(view)], show);
  window.addEventListener(
    "keydown",
    (event) => {
      if (event.key === "Escape") cancels.forEach((cancel) => cancel());
    },
    true,
  );
  follow();
}
