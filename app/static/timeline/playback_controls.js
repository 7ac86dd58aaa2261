/** Play, step, speed, loop, clock and the playhead. A moved playhead changes a transform and a few texts. */

import { axisKey, axisOf, fractionAt } from "../state/time_axis.js";
import { byId, h, icon, setAttribute, setText } from "../lib/dom.js";
import { fixed } from "../lib/format.js";
import { robotTime } from "../state/plan_samples.js";
import { shownPlan } from "../state/store.js";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10];

function mountButtons(playback, loop) {
  byId("play").addEventListener("click", () => playback.toggle());
  byId("step-back").addEventListener("click", () => playback.step(-1));
  byId("step-forward").addEventListener("click", () => playback.step(1));
  byId("loop").addEventListener("click", loop);
  const speed = byId("speed");
  speed.append(...SPEEDS.map((value) => h("option", { value, text: `${value}×` })));
  speed.value = "1";
  speed.addEventListener("change", () => playback.setSpeed(Number(speed.value)));
}

function showState(playback) {
  const button = byId("play");
  const name = playback.playing ? "Pause" : "Play";
  if (button.getAttribute("aria-label") !== name) {
    button.setAttribute("aria-label", name);
    button.title = `${name} (Space)`;
    button.replaceChildren(icon(playback.playing ? "pause" : "play"));
  }
  setAttribute(byId("loop"), "aria-pressed", playback.loop ? "true" : "false");
  byId("speed").value = String(playback.speed);
}

function mountClock() {
  const now = h("b");
  const whole = h("span");
  byId("clock").replaceChildren(now, whole);
  return (time, duration) => {
    setText(now, fixed(time));
    setText(whole, ` / ${fixed(duration)} s`);
    const ruler = byId("ruler");
    setAttribute(ruler, "aria-valuemax", fixed(duration));
    setAttribute(ruler, "aria-valuenow", time.toFixed(1));
    setAttribute(ruler, "aria-valuetext", `${fixed(time)} of ${fixed(duration)} s`);
  };
}

/** Puts a marker at a fraction of the overlay's width. */
function place(marker, overlayWidth, fraction) {
  marker.style.transform = `translateX(${(fraction * overlayWidth).toFixed(2)}px)`;
}

/**
 * Wires playback to the page.
 * @param {import("../state/store.js").Store} store
 * @param {import("../preview/playback.js").Playback} playback
 * @param {(time: number) => void} showFigures called with every move of the playhead
 * @param {() => void} loop what the key L does
 */
export function mountPlayback(store, playback, showFigures, loop) {
  const overlay = byId("overlay");
  const showClock = mountClock();
  let axis = axisOf(store.state);
  let width = overlay.clientWidth;

  const movePlayhead = () => {
    place(byId("playhead"), width, fractionAt(axis, playback.time));
    showClock(playback.time, playback.duration);
    showFigures(playback.time);
  };
  const moveRobot = () => {
    const time = robotTime(store.state.robot, store.state.view);
    byId("robot-cursor").hidden = time === null;
    if (time === null) return;
    byId("robot-cursor").toggleAttribute("data-late", fractionAt(axis, time) > 0.9);
    place(byId("robot-cursor"), width, fractionAt(axis, time));
  };

  mountButtons(playback, loop);
  playback.addEventListener("time", movePlayhead);
  playback.addEventListener("state", () => showState(playback));
  new ResizeObserver(() => {
    width = overlay.clientWidth;
    movePlayhead();
    moveRobot();
  }).observe(overlay);
  store.watch(
    (state) => [
      state.view?.id,
      shownPlan(state),
      state.view?.document.timeline.sample_time,
      state.pending.length,
    ],
    (state) => {
      axis = axisOf(state);
      playback.setPlan(axis.duration, axis.times ?? axis.step);
      movePlayhead();
    },
  );
  store.watch(
    (state) => [axisKey(state)],
    (state) => {
      axis = axisOf(state);
      movePlayhead();
      moveRobot();
    },
  );
  store.watch(({ robot, view }) => [robot?.run, robot?.robot, view?.plan], moveRobot);
  showState(playback);
}
