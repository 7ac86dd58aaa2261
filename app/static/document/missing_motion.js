/** Where an infeasible plan lacks what: for the timeline's cells, its ruler, and the marks in 3D. */

/** Feet whose rows a lack concerns: its own, or those that stand in its phase where it is about the body. */
function rowsOf(lack, contact) {
  if (lack.feet.length) return lack.feet;
  const standing = contact[lack.first]?.map((stands, foot) => (stands ? foot : -1)).filter((foot) => foot >= 0) ?? [];
  return standing.length ? standing : (contact[0] ?? []).map((_, foot) => foot);
}

/** "foot,sample" to `{sentence, tone, first, last}`; the worst lack wins. */
export function missingMotionByCell(plan) {
  const found = new Map();
  (plan?.live?.lacks ?? []).forEach((lack, rank) => {
    for (const foot of rowsOf(lack, plan.contact)) {
      for (let sample = lack.first; sample <= lack.last; sample += 1) {
        const key = `${foot},${sample}`;
        if (!found.has(key)) found.set(key, { sentence: lack.sentence, tone: rank === 0 ? "bad" : "caution", first: sample === lack.first, last: sample === lack.last });
      }
    }
  });
  return found;
}

/** What the preview marks: the lacks with where each phase begins and ends. */
export const missingMotionOf = (plan) => plan?.live?.lacks ?? [];
