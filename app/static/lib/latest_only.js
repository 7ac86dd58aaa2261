/**
 * One task at a time, and of those that come meanwhile only the newest.
 * @param {(value: any) => Promise<void>} work must not reject
 * @returns {(value: any) => void} offers a value to be worked on
 */
export function latestOnly(work) {
  let busy = false;
  let next = null;

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
 * Answers may come in another order than their questions.
 * @returns {() => () => boolean} begins a question; what it gives says whether a later one was begun since
 */
export function ticket() {
  let turn = 0;
  return () => {
    const mine = (turn += 1);
    return () => mine !== turn;
  };
}
