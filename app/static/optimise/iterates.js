/** Shows the motion at each iteration of the exact tier, marked as not the plan. */

import { api } from "../api/gaits.js";
import { h, setText } from "../lib/dom.js";
import { jobIsOn, jobOf } from "../shell/job_list.js";
import { latestOnly } from "../lib/latest_only.js";
import { report } from "../lib/toasts.js";

const HELP =
  "Shows the motion at this iteration of the optimiser, in 3D and in the plots. "
  + "Iteration 0 is the motion from which the optimiser starts";

/** The slider's row, and a note where the motions are gone. */
function build() {
  const slider = h("input", { type: "range", id: "iteration", min: 0, step: 1, "aria-label": "Iteration" });
  const number = h("span", { class: "number" });
  const back = h("button", { text: "Back to the plan", hidden: true });
  const label = h("label", { class: "quiet", for: "iteration", text: "Iteration", title: HELP });
  const row = h("div", { class: "iterates" }, label, slider, number, back);
  const gone = h("p", { class: "why" });
  return { row, slider, number, back, gone };
}

const LOST =
  "The motions at the optimiser's iterations are no longer stored. Optimise again to see these motions.";

/** Shows the iterations of the newest job; `isAsked` where one of them is being fetched. */
function show({ row, slider, number, back, gone }, state, isAsked) {
  const job = jobOf(state);
  const count = job && !jobIsOn(job) ? (job.course ?? 0) : 0;
  row.hidden = count === 0;
  slider.max = String(Math.max(count - 1, 0));
  if (!state.iterate && !isAsked) slider.value = slider.max;
  const appears = back.hidden && state.iterate;
  back.hidden = !state.iterate;
  if (appears) back.scrollIntoView({ block: "nearest" });
  setText(number, `${slider.value} of ${slider.max}`);
  row.toggleAttribute("data-on", Boolean(state.iterate));
  const lost = job && !jobIsOn(job) && count === 0 && job.progress?.length > 1;
  gone.hidden = !lost;
  setText(gone, lost ? LOST : "");
}

/** Appends the slider to a section and keeps it current. */
export function mountIterates(store, section) {
  const parts = build();
  const { row, slider, back, gone } = parts;
  section.append(row, gone);

  let asked = null;
  const leave = () => {
    asked = null;
    if (store.state.iterate) store.set({ iterate: null });
  };
  const offer = latestOnly(async (wanted) => {
    const { job, at } = wanted;
    const isWanted = () => asked === wanted && jobOf(store.state)?.id === job;
    try {
      const plan = await api.iterate(job, at);
      if (isWanted()) store.set({ iterate: { job, number: at, plan } });
    } catch (error) {
      if (!isWanted()) return;
      leave();
      report(error);
    }
  });

  slider.addEventListener("input", () => {
    asked = { job: jobOf(store.state).id, at: Number(slider.value) };
    offer(asked);
  });
  back.addEventListener("click", () => {
    leave();
    slider.focus();
  });

  store.watch(
    ({ jobs, shownJob, selected, iterate }) => [jobs, shownJob, selected, iterate],
    (state) => show(parts, state, asked !== null),
  );
  store.watch(
    ({ selected, view, gesture, pending, shownJob }) => [
      selected,
      view?.revision,
      gesture,
      pending.length,
      shownJob,
    ],
    leave,
  );
  return {
    leave: () => {
      const on = Boolean(store.state.iterate);
      leave();
      return on;
    },
  };
}
