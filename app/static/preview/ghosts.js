/** Ghosts in the 3D preview: the gait before the last edit, as saved, as measured, and as simulated. */

import { api } from "../api/gaits.js";
import { checkMenu } from "../lib/check_menu.js";
import { recalled, remember } from "../lib/remembered.js";
import { byId } from "../lib/dom.js";
import { latestOnly } from "../lib/latest_only.js";
import { simulationOver } from "../state/simulation.js";

const KINDS = {
  before: {
    text: "Before the last edit",
    help: "Shows the gait before the last edit. During a drag, shows the gait before the drag",
  },
  saved: { text: "As saved", help: "Shows the gait as you last saved it" },
  measured: {
    text: "As measured",
    shown: true,
    help:
      "Shows how the robot moved in the open run. "
      + "The motion is computed from the measured strokes and the planned feet on the ground",
  },
  simulated: {
    text: "As simulated",
    shown: true,
    help:
      "Shows the simulated robot, which can tilt and slip. "
      + "Green rings mark feet that carry load. Red lines show where a foot slid",
  },
};

const keyOf = (view, of) => `${view.id} ${of} ${view.revision} ${view.saved_at}`;

/** Which version is fetched for a ghost, and why there is none. */
function versionOf(kind, state) {
  const { view, live, run } = state;
  if (!view) return { reason: "No gait is selected." };
  if (kind === "simulated")
    return simulationOver(state)
      ? { of: `${view.simulation.key} ${view.simulation.made}` }
      : { reason: "This plan has not been simulated." };
  if (kind === "measured")
    return run?.gait === view.id
      ? { of: run.id }
      : { reason: "No run of this gait is open. Open a run of this gait under Runs." };
  if (kind === "saved")
    return view.edited || live ? { of: "saved" } : { reason: "The gait has not changed since it was saved." };
  if (live) return { of: "present" };
  return view.changed ? { of: "before" } : { reason: "This gait has not been changed yet." };
}

/** Keeps one ghost current: fetched once a version, shown while it is wanted. */
function follow(store, preview, kind, menu, isOn) {
  let shown = null;
  const offer = latestOnly(async ({ id, of, key }) => {
    let poses = null;
    try {
      poses = await (kind === "measured"
        ? api.runGhost(of)
        : kind === "simulated"
          ? api.simulatedGhost(of.split(" ")[0])
          : api.ghost(id, of));
    } catch {
      // That version makes no motion: there is nothing to be drawn.
    }
    if (shown === key) preview.setGhost(kind, poses);
  });
  return () => {
    const { of, reason } = versionOf(kind, store.state);
    menu.allow(kind, reason ?? null);
    const key = of && isOn() ? keyOf(store.state.view, of) : null;
    if (key === shown) return;
    shown = key;
    if (key) offer({ id: store.state.view.id, of, key });
    else preview.setGhost(kind, null);
  };
}

/** Builds the menu; the choice is kept. */
export function mountGhosts(store, preview) {
  const choice = recalled(
    "ghosts",
    Object.fromEntries(Object.entries(KINDS).map(([kind, { shown = false }]) => [kind, shown])),
  );
  const followers = {};
  const menu = checkMenu({
    id: "ghosts-menu",
    name: "Ghosts",
    help: "Shows a second robot: an earlier gait, a simulation or a run",
    entries: Object.entries(KINDS).map(([key, { text, help }]) => ({
      key,
      text,
      help,
      checked: choice[key],
      swatch: true,
    })),
    onChange(kind, checked) {
      choice[kind] = checked;
      remember("ghosts", choice);
      followers[kind]();
    },
  });
  for (const kind of Object.keys(KINDS))
    followers[kind] = follow(store, preview, kind, menu, () => choice[kind]);
  byId("stage-tools").append(menu.element);
  store.watch(
    (state) => [
      state.view?.id,
      state.view?.revision,
      state.view?.saved_at,
      state.view?.edited,
      Boolean(state.live),
      state.run?.id,
      simulationOver(state),
    ],
    () => Object.values(followers).forEach((update) => update()),
  );
}
