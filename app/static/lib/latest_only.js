/**
 * Runs one task at a time, and drops all waiting values but the newest.
 * @param {(value: any) => Promise<void>} work must not reject
 * @returns {(value: any) => void} offers a value to be worked on
 */
export function latestOnly(work) {
  let busy = false;
  /** @type {{value: any}|null} */
  let next = null;

  /** @param {any} value */
  async function run(value) {
    busy = true;
    await work(value);
    busy = false;
    if (next === null) return;
    const { value: newest } = next;
    next = null;
    run(newest);
  }

  return (value) => {
    if (busy) next = { value };
    else run(value);
  };
}

/**
 * Finds out whether a response is out of date: responses may arrive in another order than their requests.
 * @returns {() => () => boolean} takes a ticket: a function that returns whether a later ticket was taken
 */
export function ticket() {
  let turn = 0;
  return () => {
    const mine = (turn += 1);
    return () => mine !== turn;
  };
}
