/** Shows what a way out leads to while it is pointed at or focused: timeline, plots, 3D and verdict strip. */

import { api } from "../api/gaits.js";
import { latestOnly } from "../lib/latest_only.js";
import { measured } from "../state/live_plan.js";

/** `show(document)` and `end()`; an edit or another gait ends it too. */
export function tryouts(store) {
  let wanted = null;
  const offer = latestOnly(async ({ document, since }) => {
    if (wanted !== document) return;
    const id = store.state.selected;
    // A plan that is not to be had is not shown; taking the way out says why.
    const plan = await api.live(id, { document }).then(
      (answer) => answer.plan,
      () => null,
    );
    if (!plan || wanted !== document || store.state.selected !== id) return;
    store.set({ preview: document, tryout: plan });
    measured("pointing to preview", since);
  });
  const end = () => {
    wanted = null;
    if (store.state.tryout) store.set({ preview: null, tryout: null });
  };
  store.watch(({ selected, view, pending, gesture }) => [selected, view, pending, gesture], end);
  return {
    show(document) {
      wanted = document;
      offer({ document, since: performance.now() });
    },
    end,
  };
}
