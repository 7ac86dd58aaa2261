/** Where an infeasible plan misses its limits: for the timeline's cells, its ruler, and the marks in 3D. */

/** The feet of an entry, or those in stance in its phase if it is about the body. */
function rowsOf(missing, contact) {
  if (missing.feet.length) return missing.feet;
  const standing = contact[missing.first]?.map((stands, foot) => (stands ? foot : -1)).filter((foot) => foot >= 0) ?? [];
  return standing.length ? standing : (contact[0] ?? []).map((_, foot) => foot);
}

/** "foot,sample" to `{sentence, tone, first, last}`; the worst entry wins. */
export function missingMotionByCell(plan) {
  const found = new Map();
  (plan?.live?.lacks ?? []).forEach((missing, rank) => {
    for (const foot of rowsOf(missing, plan.contact)) {
      for (let sample = missing.first; sample <= missing.last; sample += 1) {
        const key = `${foot},${sample}`;
        if (!found.has(key)) found.set(key, { sentence: missing.sentence, tone: rank === 0 ? "bad" : "caution", first: sample === missing.first, last: sample === missing.last });
      }
    }
  });
  return found;
}

/** The entries that the preview marks, with the begin and end of each phase. */
export const missingMotionOf = (plan) => plan?.live?.lacks ?? [];
