/** The Simulate section: simulates exactly the waypoints that would be sent to the robot. */

import { api } from "../api/gaits.js";
import { byId, h, onPress, setAllowed, setAttribute, setText } from "../lib/dom.js";
import { fixed, mm } from "../lib/format.js";
import { attempt, report, toast } from "../lib/toasts.js";
import { followSimulation, simulationJob, simulationOf, simulationOver } from "../state/simulation.js";
import { fallOf } from "../state/live_plan.js";
import { openStep } from "../steps/steps.js";
import { simulateState } from "../steps/step_states.js";
import { reportParts } from "./simulation_report.js";

const VARIATIONS = 64;
const CHANGES =
  "friction, masses, motor speed, one weak motor, a slope of up to 1°, and softer or stiffer legs";
const VARY_HELP =
  `Simulates the gait ${VARIATIONS} times with random changes: ${CHANGES}. `
  + "Each press of this button uses the same random changes";
const HELP =
  "Simulates exactly the waypoints that would be sent to the robot, "
  + "with the timing of the firmware. The model has masses, friction and flexible legs";
const AXIS =
  "The timing of the robot differs from the timing of the plan. "
  + "The page shows each result at the matching time of the plan.";

function whyNot(state) {
  const { view, pending } = state;
  if (!view) return "No gait is selected.";
  if (pending.length) return "The studio is still saving your last edit.";
  if (simulationJob(state)) return "Wait for the running simulation of this gait, or cancel it.";
  if (!view.plan?.waypoints_hash) {
    return view.plan?.refusal?.sentence ?? "There is no plan to simulate. Press Optimise first.";
  }
  return null;
}

/** The choice of physics parameters, of those that fit the shown gait's robot. */
function setChooser(store) {
  const select = h("select", {
    "aria-label": "Physics parameters",
    title: "Masses, friction and motors of the simulated robot",
  });
  store.watch(
    ({ view, physicsSets }) => [view?.document.robot, physicsSets],
    async ({ view }) => {
      if (!view) return;
      const { robot } = view.document;
      try {
        const { sets } = await api.physicsSets(robot);
        if (store.state.view?.document.robot !== robot) return;
        const chosen = select.value;
        select.replaceChildren(...sets.map(({ name, title }) => h("option", { value: name, text: title })));
        if (sets.some(({ name }) => name === chosen)) select.value = chosen;
      } catch (error) {
        report(error);
      }
    },
  );
  return {
    select,
    element: h("label", { class: "set-choice" }, h("span", { class: "quiet", text: "Physics" }), select),
  };
}

/** A bar with the share that is done, and Cancel. */
function progressPart() {
  const [bar, text] = [
    h("i"),
    h("span", { class: "number quiet", role: "status", "aria-label": "Simulation" }),
  ];
  const cancel = h("button", { text: "Cancel", "aria-label": "Cancel simulation" });
  const element = h(
    "div",
    { class: "simulating", hidden: true },
    h("div", { class: "progress" }, bar),
    text,
    cancel,
  );
  let id = null;
  cancel.addEventListener(
    "click",
    attempt(async () => {
      if (id) await api.cancelJob(id);
    }),
  );
  return {
    element,
    show(job) {
      element.hidden = !job;
      id = job?.id ?? null;
      if (!job) return;
      bar.style.transform = `scaleX(${job.share ?? 0})`;
      setText(text, job.state === "running" ? `${fixed((job.share ?? 0) * 100, 0)} %` : job.state);
      setAllowed(cancel, job.state === "cancelling" ? "The simulation is being cancelled." : null);
    },
  };
}

/** What came of the last simulation that did not come to its end. */
function failure({ jobs, selected }) {
  const last = jobs.find((job) => job.gait === selected && job.kind === "simulate");
  return last?.state === "failed" || last?.state === "interrupted" ? last.sentence : null;
}

function standing(state) {
  const { view, simulation } = state;
  const failed = failure(state);
  if (failed) return [failed, "bad"];
  if (!view?.simulation)
    return [
      "Not simulated yet. Press Simulate to see whether the robot walks, tips over or slips, "
        + "and whether its motors are strong enough.",
      "plain",
    ];
  if (!view.simulation.fresh)
    return ["The gait has changed, so these figures are out of date. Simulate again.", "caution"];
  if (!simulation) return ["Loading the simulation.", "plain"];
  return view.plan?.source === "draft"
    ? ["This plan cannot be sent. The simulation shows what would happen on the robot.", "caution"]
    : null;
}

/** What came of the simulation, with a note where it is out of date or there is none. */
function resultPart(store, goToTime) {
  const [note, figures, map] = [
    h("p", { class: "box-note" }),
    h("div", { class: "simulated" }),
    robustness(),
  ];
  const help = h("button", {
    class: "link",
    text: "See what would help",
    hidden: true,
    on: { click: () => openStep("design") },
  });
  const follow = () =>
    store.watch(
      (state) => [simulationOf(state), simulationOver(state), state.view, state.jobs, state.selected],
      (state) => {
        const [simulation, words] = [simulationOf(state), standing(state)];
        note.hidden = !words;
        setText(note, words?.[0] ?? "");
        setAttribute(note, "data-tone", words?.[1]);
        help.hidden = !fallOf(state);
        const stale = simulation !== null && simulationOver(state) === null;
        figures.replaceChildren(...(simulation ? reportParts(simulation, goToTime) : []));
        figures.toggleAttribute("data-stale", stale);
        map.show(simulation?.variations ?? null, stale);
      },
    );
  return { elements: [note, help, figures, map.element], follow };
}

/** Begins the simulation that another part of the page wants, as soon as the gait has a plan. */
function followWanted(store, begin) {
  store.watch(
    ({ simulateWanted, selected, view, jobs, pending }) => [
      simulateWanted,
      selected,
      view,
      jobs,
      pending.length,
    ],
    (state) => {
      const { simulateWanted: wanted, selected, view } = state;
      if (!wanted || (selected === wanted && (view?.id !== wanted || whyNot(state)))) return;
      store.set({ simulateWanted: null });
      if (selected === wanted && simulateState(state).mark !== "done") begin();
    },
  );
}

/** Builds the section; `goToTime` brings the playhead to a time of the plan. */
export function mountSimulate(store, goToTime) {
  const run = h("button", { id: "act-simulate", text: "Simulate" });
  const vary = h("button", { text: `${VARIATIONS} variations` });
  const { select, element: sets } = setChooser(store);
  const progress = progressPart();
  const result = resultPart(store, goToTime);
  const press = (variations) =>
    attempt(async () => {
      await api.simulate(store.state.selected, select.value || null, variations);
    });
  onPress(run, press(0), (why) => toast(why));
  onPress(vary, press(VARIATIONS), (why) => toast(why));
  byId("foot-simulate").append(h("div", { class: "solve" }, run, vary));
  byId("simulate").append(sets, progress.element, ...result.elements, h("p", { class: "why", text: AXIS }));
  followSimulation(store);
  followWanted(store, press(0));

  store.watch(
    ({ jobs, view, pending, selected, simulation, live }) => [
      jobs,
      view,
      pending.length,
      selected,
      simulation,
      live,
    ],
    (state) => {
      const why = whyNot(state);
      setAllowed(run, why, HELP);
      run.classList.toggle("primary", simulateState(state).mark !== "done");
      setAllowed(vary, why, VARY_HELP);
      progress.show(simulationJob(state));
    },
  );
  result.follow();
}

const COLUMNS = 16;
const degrees = (radians) => fixed((radians * 180) / Math.PI);

/** How a variation came out: what it is called, its sign, and its sentence. */
function cameOf(run) {
  const { walks, fell, max_tilt: tilt, distance, feet_error: error, ended_early: early } = run;
  if (fell) return ["falls", "×", `The robot falls over, with a tilt of ${degrees(tilt)}°`];
  if (early) return ["falls", "×", `The simulation ends early: ${early.replace(/\.$/, "")}`];
  const walked = `distance walked ${mm(distance)} mm, mean foot error ${mm(error)} mm`;
  const figures = `Tilt up to ${degrees(tilt)}°, ${walked}`;
  if (walks) return ["walks", "", `The robot walks. ${figures}`];
  const made = Math.min(run.way_share ?? 1, run.turn_share ?? 1);
  const part = fixed(made * 100, 0);
  if (made < 0.5) return ["tips", "!", `The robot makes ${part} % of its way or turn. ${figures}`];
  return ["tips", "!", `The robot tips onto a foot that should be in the air. ${figures}`];
}

function cell(run, number) {
  const [came, sign, words] = cameOf(run);
  const sentence = `Variation ${number + 1}: ${run.name}. ${words}.`;
  return h("li", {
    class: "variation",
    title: sentence,
    "aria-label": sentence,
    tabindex: number ? "-1" : "0",
    text: sign,
    data: { came },
  });
}

/** Arrows go from cell to cell; the focused cell is described below the map. */
function mountKeys(list, description) {
  list.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -COLUMNS, ArrowDown: COLUMNS }[event.key];
    const cells = [...list.children];
    const to = step && cells[cells.indexOf(document.activeElement) + step];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    if (!to) return;
    cells.forEach((one) => {
      one.tabIndex = one === to ? 0 : -1;
    });
    to.focus();
  });
  for (const kind of ["focusin", "pointerover"])
    list.addEventListener(kind, ({ target }) => {
      if (target.matches(".variation")) setText(description, target.title);
    });
}

/** Builds the map. */
export function robustness() {
  const [share, list, description] = [
    h("b"),
    h("ul", { class: "variations", role: "list", "aria-label": "Variations" }),
    h("p", { class: "why said" }),
  ];
  const element = h(
    "div",
    { class: "robustness", hidden: true },
    h("h3", { text: "Variations" }),
    h("p", {}, share),
    list,
    description,
  );
  list.style.setProperty("--columns", String(COLUMNS));
  mountKeys(list, description);
  let known = null;
  return {
    element,
    show(variations, stale) {
      element.hidden = !variations;
      element.toggleAttribute("data-stale", stale);
      if (!variations || variations === known) return;
      known = variations;
      const walking = variations.runs.filter(({ walks }) => walks).length;
      setText(
        share,
        `${walking} of ${variations.count} walk (${fixed((100 * walking) / variations.count, 0)} %)`,
      );
      setText(
        description,
        `Each cell is one variation, a simulation with random changes: ${CHANGES}. `
          + "Point at a cell to read the result of this variation.",
      );
      list.replaceChildren(...variations.runs.map(cell));
    },
  };
}
