/**
 * "Send to robot": held for a second, by the pointer or by Enter, or pressed shortly and then a countdown
 * that can be cancelled. Either way a person has a second or more to think again.
 */

import { h, onPress, setAllowed, setText } from "../lib/dom.js";
import { runningTimer } from "../lib/running_timer.js";
import { announce, toast } from "../lib/toasts.js";

const HOLD_MS = 1000;
const COUNTDOWN_S = 3;

const SLEPT = "Nothing was sent, because the page did not run for a while. Press Send to robot again.";

const isInReach = (element) => element.checkVisibility() && !element.closest("[inert]");

/**
 * The countdown that takes the place of the button; `start` is called at its end.
 * @returns {{element: HTMLElement, count: () => Promise<void>, cancel: () => boolean}}
 */
function countdownPart(button, prepare, start) {
  const number = h("b", { text: String(COUNTDOWN_S) });
  const cancelButton = h("button", { text: "Cancel" });
  const words = h("span", { text: "The robot starts to move when the countdown reaches 0." });
  const element = h(
    "div",
    { class: "countdown", role: "group", "aria-label": "Countdown", hidden: true },
    number,
    words,
    cancelButton,
  );
  let endTimer = null;

  function end() {
    endTimer();
    endTimer = null;
    [element.hidden, button.hidden] = [true, false];
  }

  function cancel() {
    if (endTimer === null) return false;
    end();
    announce("Sending is cancelled.");
    return true;
  }

  async function count() {
    if (endTimer !== null || !(await prepare())) return;
    [element.hidden, button.hidden] = [false, true];
    setText(number, String(COUNTDOWN_S));
    cancelButton.focus({ preventScroll: true });
    element.scrollIntoView({ block: "nearest" });
    announce(`The studio sends the gait to the robot in ${COUNTDOWN_S} seconds.`);
    endTimer = runningTimer(COUNTDOWN_S * 1000, {
      tell: (left) => {
        // Where Cancel cannot be seen or pressed any more, nothing is sent.
        if (isInReach(element)) setText(number, String(Math.ceil(left / 1000)));
        else cancel();
      },
      act: () => {
        const canBeSeen = isInReach(element);
        end();
        if (canBeSeen) start();
      },
      slept: () => {
        end();
        toast(SLEPT);
      },
    });
  }

  cancelButton.addEventListener("click", cancel);
  return { element, count, cancel };
}

/**
 * Makes a button act when it is held for a second, by the pointer or by Enter; a shorter press calls `press`.
 * @param {HTMLElement} button
 * @param {{isBlocked: () => boolean, act: () => void, press: () => void}} options
 * @returns {() => void} lets the button go, if it is held
 */
function holding(button, { isBlocked, act, press }) {
  let endTimer = null;
  let held = false;

  function letGo() {
    endTimer?.();
    endTimer = null;
    delete button.dataset.holding;
  }

  function hold(isPointer) {
    button.dataset.holding = "";
    endTimer = runningTimer(HOLD_MS, {
      act: () => {
        held = isPointer;
        letGo();
        act();
      },
      slept: () => {
        held = isPointer;
        letGo();
        toast(SLEPT);
      },
    });
  }

  button.addEventListener("pointerdown", (event) => {
    held = false;
    if (isBlocked() || event.button !== 0) return;
    letGo();
    hold(true);
  });
  // Enter acts when it is let go, so that it can be held; one that was held already when the focus came here
  // does nothing.
  button.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" || isBlocked()) return;
    event.preventDefault();
    if (!event.repeat && endTimer === null) hold(false);
  });
  button.addEventListener("keyup", (event) => {
    if (event.key !== "Enter" || endTimer === null) return;
    letGo();
    press();
  });
  for (const type of ["pointerup", "pointerleave", "pointercancel", "blur"])
    button.addEventListener(type, letGo);
  button.addEventListener("contextmenu", (event) => event.preventDefault());
  onPress(
    button,
    () => {
      if (!held) press();
      held = false;
    },
    (why) => toast(why),
  );
  return letGo;
}

/**
 * @param {object} options
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
  let reason = null;

  const start = async () => {
    if (!reason) await send();
  };
  const countdown = countdownPart(button, prepare, start);
  const letGo = holding(button, {
    isBlocked: () => Boolean(reason),
    act: async () => {
      if (await prepare()) start();
    },
    press: countdown.count,
  });

  return {
    element: h("div", {}, button, countdown.element),
    cancel: countdown.cancel,
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
      countdown.cancel();
      letGo();
    },
  };
}
