/** The convergence curve: objective and primal violation over iterations, log scale; stays after the job. */

import { h, setText, svg } from "../lib/dom.js";
import { compact, seconds } from "../lib/format.js";
import { isOlder, jobOf, jobTone } from "../shell/job_list.js";

const WIDTH = 276;
const HEIGHT = 84;
const FRAME = { left: 34, right: 8, top: 22, bottom: 15 };
const SMALLEST = 1e-12;

const decade = (value) => Math.log10(Math.max(Math.abs(value), SMALLEST));

function rangeOf(progress) {
  const logs = progress
    .flatMap((point) => [decade(point.objective), decade(point.primal)])
    .filter(Number.isFinite);
  const [low, high] = [Math.floor(Math.min(...logs)), Math.ceil(Math.max(...logs))];
  return high > low ? [low, high] : [low - 1, high + 1];
}

function scales(progress) {
  const [low, high] = rangeOf(progress);
  const first = progress[0].iteration;
  const span = Math.max(1, progress.at(-1).iteration - first);
  return {
    low,
    high,
    x: (iteration) => FRAME.left + ((iteration - first) / span) * (WIDTH - FRAME.left - FRAME.right),
    y: (log) => FRAME.top + ((high - log) / (high - low)) * (HEIGHT - FRAME.top - FRAME.bottom),
  };
}

function gridLines({ low, high, y }) {
  const every = Math.max(1, Math.ceil((high - low) / 4));
  const lines = [];
  for (let log = high; log >= low; log -= every) {
    lines.push(
      svg("line", { class: "grid", x1: FRAME.left, x2: WIDTH - FRAME.right, y1: y(log), y2: y(log) }),
      svg("text", {
        x: FRAME.left - 5,
        y: y(log) + 3.5,
        "text-anchor": "end",
        text: Math.abs(log) <= 1 ? 10 ** log : `1e${log}`,
      }),
    );
  }
  return lines;
}

function iterationLabels(progress, { x }) {
  return [progress[0], progress.at(-1)]
    .filter((point, index, both) => index === 0 || point !== both[0])
    .map((point, index) =>
      svg("text", {
        x: x(point.iteration),
        y: HEIGHT - 5,
        "text-anchor": index ? "end" : "start",
        text: index ? `iteration ${point.iteration}` : point.iteration,
      }),
    );
}

function curve(progress, name, { x, y }) {
  const known = progress.filter((point) => Number.isFinite(point[name]));
  const d = known
    .map(
      (point, index) =>
        `${index ? "L" : "M"}${x(point.iteration).toFixed(1)} ${y(decade(point[name])).toFixed(1)}`,
    )
    .join("");
  const last = known.at(-1);
  return last
    ? [
        svg("path", { class: name, d }),
        svg("circle", { class: name, r: 2.5, cx: x(last.iteration), cy: y(decade(last[name])) }),
      ]
    : [];
}

function draw(progress) {
  const scale = scales(progress);
  return svg(
    "svg",
    { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, "aria-hidden": "true" },
    ...gridLines(scale),
    ...iterationLabels(progress, scale),
    ...curve(progress, "objective", scale),
    ...curve(progress, "primal", scale),
  );
}

function stateText(job) {
  const stale = isOlder(job);
  const figures = job.result
    ? ` · ${job.result.iterations} iterations · ${seconds(job.result.solve_seconds)} s`
    : "";
  return `${stale ? "older version" : job.state}${figures}`;
}

/** The iteration that is looked at, else the last one. */
function shownPoint(progress, job, iterate) {
  return iterate?.job === job?.id && iterate
    ? progress.find(({ iteration }) => iteration === iterate.number)
    : progress.at(-1);
}

/** What the two curves are, each with its last value. */
function curveKey(last) {
  return h(
    "div",
    { class: "curve-key" },
    h(
      "span",
      { title: "Value of the cost that the optimiser minimises. You choose the cost under More" },
      h("i"),
      "objective ",
      last.objective,
    ),
    h(
      "span",
      {
        class: "primal",
        title:
          "Largest violation of a limit, in the solver's scaled units. "
          + "The value is 0 when all limits are kept",
      },
      h("i"),
      "violation ",
      last.primal,
    ),
  );
}

/** Appends the curve to a section and keeps it current. */
export function mountConvergence(store, section) {
  const state = h("span");
  const frame = h("div", { role: "img" });
  const last = { objective: h("span"), primal: h("span") };
  const key = curveKey(last);
  const line = h("p", { class: "why" });
  const plot = h("div", { class: "curve" }, frame, key);
  section.append(
    h(
      "h3",
      { title: "Objective and violation at each iteration of the optimiser during the last optimisation" },
      "Convergence",
      state,
    ),
    plot,
    line,
  );
  let drawn = null;

  store.watch(
    ({ jobs, shownJob, selected, iterate }) => [jobs, shownJob, selected, iterate],
    (now) => {
      const job = jobOf(now);
      const progress = job?.progress ?? [];
      const stale = isOlder(job);
      setText(state, job ? stateText(job) : "");
      state.title = job?.sentence ?? "";
      state.dataset.toneText = stale ? "caution" : job ? jobTone(job) : "";
      line.hidden = progress.length > 0;
      setText(line, job ? job.sentence : "Press Optimise to see the convergence curve here.");
      const point = shownPoint(progress, job, now.iterate);
      setText(last.objective, compact(point?.objective));
      setText(last.primal, compact(point?.primal));
      plot.hidden = progress.length === 0;
      frame.setAttribute("aria-label", `Convergence over ${progress.length} iterations: ${key.textContent}`);
      const version = `${job?.id}/${progress.length}`;
      if (version === drawn) return;
      drawn = version;
      frame.replaceChildren(...(progress.length ? [draw(progress)] : []));
    },
  );
}
