/** The tools over the 3D preview: a list of views if there is no cube, Fit, and a menu of layers. */

import { api } from "../api/gaits.js";
import { checkMenu } from "../lib/check_menu.js";
import { recalled, remember } from "../lib/remembered.js";
import { byId } from "../lib/dom.js";
import { latestOnly } from "../lib/latest_only.js";
import { oneTabStop } from "../lib/tab_stop.js";
import { shownDocument } from "../state/store.js";
import { drawnPlan } from "../state/worked_plan.js";

/**
 * Entries of the menu: parts of the preview and layer over it that each shows, and whether it is on at first.
 * @type {{key: string, text: string, shown: boolean, parts: string[], layer?: string, help: string}[]}
 */
const ENTRIES = [
  {
    key: "robot",
    text: "Robot",
    shown: true,
    parts: ["robot"],
    help: "Hide the robot to see the whole floor. After a reload of the page, the robot is shown again",
  },
  {
    key: "polygon",
    text: "Support polygon",
    shown: true,
    parts: ["polygon", "trouble"],
    help:
      "Shows the area between the feet on the ground. The area is mustard if the centre of mass is near "
      + "the edge, and magenta if the centre of mass is outside. Otherwise the area is teal",
  },
  {
    key: "com",
    text: "Centre of mass",
    shown: true,
    parts: ["com"],
    help: "Shows the centre of mass as a disc on the floor, with its path",
  },
  {
    key: "cop",
    text: "Centre of pressure",
    shown: true,
    parts: ["cop"],
    help:
      "Shows the centre of pressure as a diamond on the floor, with its path. "
      + "At this point the total force of the ground acts on the robot",
  },
  {
    key: "traces",
    text: "Swings and footholds",
    shown: true,
    parts: ["traces", "footholds"],
    help: "Shows the paths of the feet in the air, and a ring where a foot lands",
  },
  {
    key: "reach",
    text: "Reach of the feet",
    shown: false,
    parts: ["reach"],
    help:
      "Outlines the area that each foot can reach, on the floor and up to 12 mm above the floor. "
      + "The area depends on the present body height",
  },
  {
    key: "shadow",
    text: "Contact shadows",
    shown: true,
    parts: ["shadow"],
    help: "Shows a soft shadow under each foot on the ground",
  },
  {
    key: "labels",
    text: "Labels",
    shown: true,
    parts: [],
    layer: "foot-labels",
    help: "Shows the number and place of each foot, with an arrow while the foot is in the air",
  },
  {
    key: "guides",
    text: "Arrow and scale",
    shown: true,
    parts: [],
    layer: "guides",
    help: "Shows the direction and length of a step as an arrow, and a scale of 10 mm on the floor",
  },
  {
    key: "goal",
    text: "Goal",
    shown: true,
    parts: [],
    layer: "goal",
    help:
      "Drag the goal to change the step and the turn. "
      + "The goal is hidden if you look almost along the floor",
  },
  {
    key: "pose",
    text: "Pose",
    shown: true,
    parts: [],
    layer: "pose",
    help:
      "Drag this handle to move the body in the pose at the playhead. "
      + "Only gaits for the robot's clock have this handle. "
      + "The robot's firmware decides the timing of such gaits",
  },
];

const NO_PRESSURE =
  "The centre of pressure is known only for optimised and live plans. "
  + "The computation of this point needs the accelerations of the motion.";

/** Fetches the reach of the drawn plan while its layer is on. */
function followReach(store, preview, isOn) {
  const offer = latestOnly(async ({ id, hash, workspace }) => {
    try {
      const reach = await api.reach(id, hash, workspace);
      if (drawnPlan(store.state)?.hash === hash) preview.setReach(reach);
    } catch {
      // The plan was replaced meanwhile; the next one makes its own request.
    }
  });
  let requested = null;
  const ask = () => {
    const plan = drawnPlan(store.state);
    if (!isOn() || !plan?.times.length) return;
    const wanted = {
      id: store.state.view.id,
      hash: plan.hash,
      workspace: shownDocument(store.state).options.workspace,
    };
    const key = JSON.stringify(wanted);
    if (key === requested) return;
    requested = key;
    offer(wanted);
  };
  // New poses remove the reach from the scene: request it again.
  preview.addEventListener("poses", () => {
    requested = null;
    ask();
  });
  store.watch((state) => [shownDocument(state)?.options?.workspace], ask);
  return ask;
}

/**
 * Builds the tools; the choice of layers is remembered, but the robot is visible again after a reload.
 * @param {import("../state/store.js").Store} store
 * @param {import("../preview/preview.js").Preview} preview
 * @param {(view: string) => void} look
 * @param {(layer: string, shown: boolean) => void} onShow
 */
export function mountTools(store, preview, look, onShow) {
  const lookAgain = () => look(byId("camera").value);
  byId("camera").addEventListener("change", lookAgain);
  byId("fit-view").addEventListener("click", lookAgain);

  const choice = recalled("scene", Object.fromEntries(ENTRIES.map(({ key, shown }) => [key, shown])));
  const requestReach = followReach(store, preview, () => choice.reach);
  /** @param {typeof ENTRIES[number]} entry */
  const apply = ({ key, parts, layer }) => {
    parts.forEach((part) => preview.show(part, choice[key]));
    if (layer) byId(layer).hidden = !choice[key];
    onShow(key, choice[key]);
    if (key === "reach") requestReach();
  };
  const menu = checkMenu({
    id: "show-menu",
    name: "Show",
    help: "Choose what the 3D preview shows",
    entries: ENTRIES.map(({ key, text, help }) => ({ key, text, help, checked: choice[key] })),
    onChange(key, checked) {
      choice[key] = checked;
      remember("scene", { ...choice, robot: true });
      apply(ENTRIES.find((entry) => entry.key === key));
    },
  });
  byId("stage-tools").append(menu.element);
  oneTabStop(byId("stage-tools"), { items: "#camera, #fit-view, .menu-button", isToolbar: true });
  ENTRIES.forEach(apply);
  preview.addEventListener("poses", () => menu.allow("cop", preview.knowsPressure ? null : NO_PRESSURE));
}
