/** The 3D preview's frame: loads a plan's poses once, follows the playhead, says what the plan is worth. */

import { api } from "./api.js";
import { byId, h, setText } from "./dom.js";
import { fixed, mm } from "./format.js";
import { Preview } from "./preview/preview.js";
import { extremes } from "./samples.js";

const SOURCES = {
  optimised: ["Feasible", "good"], manual: ["Manual", "good"], draft: ["Draft", "caution"],
};

function message(text) {
  byId("stage-message").hidden = !text;
  setText(byId("stage-message"), text ?? "");
}

async function openPreview(dark) {
  const frame = byId("viser");
  frame.src = Preview.url({ dark: dark.matches });
  const preview = new Preview(frame);
  dark.addEventListener("change", () => preview.setDark(dark.matches));
  await preview.ready();
  preview.setDark(dark.matches);
  message(null);
  return preview;
}

function mountTools(preview) {
  byId("camera").addEventListener("change", () => preview.setView(byId("camera").value));
  const toggles = { "show-polygon": ["polygon"], "show-traces": ["traces", "com"] };
  for (const [id, parts] of Object.entries(toggles)) {
    byId(id).addEventListener("click", () => {
      const visible = byId(id).getAttribute("aria-pressed") !== "true";
      byId(id).setAttribute("aria-pressed", String(visible));
      parts.forEach((part) => preview.show(part, visible));
    });
  }
}

function verdictWords(view, before) {
  if (view.approval) return ["approved", "good"];
  if (view.verdict) return view.verdict.passed ? ["checked", "good"] : ["check failed", "bad"];
  if (before === "approved") return ["approval gone: the gait changed", "caution"];
  return [before ? "check gone: the gait changed" : "not checked", before ? "caution" : "quiet"];
}

function planNote({ view, checked }) {
  const plan = view?.plan;
  if (!plan) return view ? [h("div", { class: "sentence", text: "No plan: optimise this gait to see it move." })] : [];
  if (plan.refusal) {
    return [h("div", {}, h("b", { text: "No motion", data: { toneText: "bad" } }), " · the reason stands at the timeline")];
  }
  const { strokes } = extremes(plan);
  const margin = plan.balance;
  const failed = view.verdict && !view.verdict.passed;
  const [word, tone] = failed ? ["Check failed", "bad"] : (SOURCES[plan.source] ?? [plan.source, "quiet"]);
  const [state, stateTone] = verdictWords(view, checked[view.id]);
  const figures = h("div", { class: "figures" }, h("b", { text: word, data: { toneText: tone } }),
    margin !== null && " · ", margin !== null && h("span", { text: `margin ${mm(margin)} mm`, title: "Least distance from the edge of the support polygon: of the centre of pressure where the motion is optimised, else of the centre of mass", data: { toneText: margin < 0 ? "bad" : "" } }),
    strokes && ` · strokes ${fixed(strokes[0])}…${fixed(strokes[1])} mm`,
    !failed && " · ", !failed && h("span", { text: state, data: { toneText: stateTone } }));
  const sentence = plan.note.replace(/^\w+: /, "");
  return [figures, h("div", { class: "sentence", text: sentence, title: plan.note })];
}

function mountLegend(store) {
  store.watch(({ view }) => [view?.roles], ({ view }) => {
    const feet = (view?.roles ?? []).map((role, foot) =>
      h("span", { data: { foot: foot + 1 }, title: `Foot ${foot + 1}: ${role}` }, h("i", { class: "foot-dot" }), String(foot + 1)));
    byId("legend").hidden = feet.length === 0;
    byId("legend").replaceChildren("foot", ...feet);
  });
}

/** Opens the preview; the page works without it, and says so. */
export async function mountStage(store, playback) {
  mountLegend(store);
  store.watch(({ view, checked }) => [view, checked], (state) => byId("plan-note").replaceChildren(...planNote(state)));
  store.watch(({ connected, greeted }) => [connected, greeted], ({ connected, greeted }) => {
    byId("banner").hidden = connected || !greeted;
    setText(byId("banner"), connected ? "" : "Connection to the studio lost: what stands here may be old. Trying again; Stop is tried all the same.");
  });
  let preview;
  try {
    preview = await openPreview(matchMedia("(prefers-color-scheme: dark)"));
  } catch (error) {
    message(`The 3D scene could not be loaded: ${error.message}`);
    return null;
  }
  mountTools(preview);
  playback.addEventListener("time", () => preview.setTime(playback.time));
  store.watch(({ view }) => [view?.id, view?.plan?.hash, Boolean(view?.plan?.refusal)], async ({ view }) => {
    if (!view?.plan || view.plan.refusal) return;
    try {
      await preview.loadPoses(api.posesPath(view.id, view.plan.hash));
      preview.setTime(playback.time);
      message(null);
    } catch (error) {
      message(`The plan cannot be shown: ${error.message}`);
    }
  });
  return preview;
}
