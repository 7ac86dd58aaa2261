/**
 * "Send to robot": held for a second, by the pointer or by Enter, or pressed shortly and then a countdown that can be cancelled.
 * Either way a person has a second or more to think again.
 */

import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { announce, toast } from "../lib/toasts.js";

const HOLD_MS = 1000;
const COUNTDOWN_S = 3;

const isInReach = (element) => element.checkVisibility() && !element.closest("[inert]");

/**
 * @param {Record<string, any>} options
 * @param {() => Promise<boolean>} options.prepare asked before the countdown: the operator's name is known
 * @param {() => Promise<void>} options.send carries it out
 * @returns {{element: HTMLElement, allow: (reason: string|null) => void, cancel: () => boolean}}
 */
export function sendControl({ prepare, send }) {
  const button = h(
    "button",
    { class: "primary wide hold", "data-robot": true },
    h("span", { class: "fill" }),
    h("span", { text: "Send to robot" }),
  );
  const number = h("b", { text: String(COUNTDOWN_S) });
  const cancelButton = h("button", { text: "Cancel" });
  const words = h("span", { text: "The robot starts to move when the countdown reaches 0." });
  const countdown = h(
    "div",
    { class: "countdown", role: "group", "aria-label": "Countdown", hidden: true },
    number,
    words,
    cancelButton,
  );
  let timer = null;
  let holdTimer = null;
  let held = false;
  let reason = null;

  const start = async () => {
    if (!reason) await send();
  };

  function cancel() {
    if (timer === null) return false;
    clearInterval(timer);
    timer = null;
    [countdown.hidden, button.hidden] = [true, false];
    announce("Sending is cancelled.");
    return true;
  }

  function finish() {
    clearInterval(timer);
    timer = null;
    [countdown.hidden, button.hidden] = [true, false];
    start();
  }

  async function count() {
    if (timer !== null || !(await prepare())) return;
    const begun = performance.now();
    [countdown.hidden, button.hidden] = [false, true];
    setText(number, String(COUNTDOWN_S));
    cancelButton.focus({ preventScroll: true });
    countdown.scrollIntoView({ block: "nearest" });
    announce(`The studio sends the gait to the robot in ${COUNTDOWN_S} seconds.`);
    timer = setInterval(() => {
      // Where Cancel cannot be seen or pressed any more, nothing is sent.
      if (!isInReach(countdown)) return cancel();
      const left = COUNTDOWN_S - (performance.now() - begun) / 1000;
      if (left <= 0) return finish();
      return setText(number, String(Math.ceil(left)));
    }, 100);
  }

  function letGo() {
    clearTimeout(holdTimer);
    holdTimer = null;
    delete button.dataset.holding;
  }

  function hold(isPointer) {
    button.dataset.holding = "";
    holdTimer = setTimeout(async () => {
      held = isPointer;
      letGo();
      if (await prepare()) start();
    }, HOLD_MS);
  }

  button.addEventListener("pointerdown", (event) => {
    held = false;
    if (reason || event.button !== 0) return;
    letGo();
    hold(true);
  });
  // Enter acts when it is let go, so that it can be held; one that was held already when the focus came here does nothing.
  button.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" || reason) return;
    event.preventDefault();
    if (!event.repeat && holdTimer === null) hold(false);
  });
  button.addEventListener("keyup", (event) => {
    if (event.key !== "Enter" || holdTimer === null) return;
    letGo();
    count();
  });
  for (const type of ["pointerup", "pointerleave", "pointercancel", "blur"])
    button.addEventListener(type, letGo);
  button.addEventListener("contextmenu", (event) => event.preventDefault());
  onPress(
    button,
    () => {
      if (!held) count();
      held = false;
    },
    (why) => toast(why),
  );
  cancelButton.addEventListener("click", cancel);

  return {
    element: h("div", {}, button, countdown),
    cancel,
    allow(why) {
      reason = why;
      button.classList.toggle("primary", !why);
      setAllowed(
        button,
        why,
        "To send the gait, hold the button or the key Enter for one second. "
          + "Or click once to start a countdown that you can cancel",
      );
      if (!why) return;
      cancel();
      letGo();
    },
  };
}
