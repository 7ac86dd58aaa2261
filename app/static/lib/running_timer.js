/** A timer for acts that must not happen because a page slept: it counts only time in which the page ran. */

const TICK_MS = 50;

/** A page that did not run for so long has slept; what was being counted is given up. */
const SLEPT_MS = 2000;

/**
 * Calls `act` after a time, unless the page sleeps before.
 * @param {number} duration ms
 * @param {{act: () => void, slept: () => void, tell?: (left: number) => void, clock?: () => number}} options
 *   `tell` hears what is left, ms.
 * @returns {() => void} ends the timer
 */
export function runningTimer(duration, { act, slept, tell, clock = () => performance.now() }) {
  let [left, seen] = [duration, clock()];
  const timer = setInterval(() => {
    const now = clock();
    const passed = now - seen;
    seen = now;
    left -= passed;
    if (passed <= SLEPT_MS && left > 0) {
      tell?.(left);
      return;
    }
    clearInterval(timer);
    if (passed > SLEPT_MS) slept();
    else act();
  }, TICK_MS);
  return () => clearInterval(timer);
}
