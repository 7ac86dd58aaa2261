/** A timer for acts that must not happen because a page slept: it counts only time in which the page ran. */

const TICK_MS = 50;

/** Between two ticks no more than this counts. */
const MOST_MS = 250;

/** A page that did not run for so long has slept; what was being counted is given up. */
const SLEPT_MS = 2000;

/**
 * Calls `act` after a time, unless the page sleeps before.
 * @param {number} duration ms
 * @param {object} options
 * @param {() => void} options.act
 * @param {() => void} options.slept
 * @param {(left: number) => void} [options.tell] hears what is left, ms
 * @param {(() => number)[]} [options.clocks] ms; the first one may stand still while the machine is
 *   suspended, the second one may be set
 * @returns {() => void} ends the timer
 */
export function runningTimer(duration, { act, slept, tell, clocks = [() => performance.now(), Date.now] }) {
  let left = duration;
  let seen = clocks.map((clock) => clock());
  const timer = setInterval(() => {
    const now = clocks.map((clock) => clock());
    const passed = Math.max(...now.map((time, i) => Math.abs(time - seen[i])));
    left -= Math.min(now[0] - seen[0], MOST_MS);
    seen = now;
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
