/** Stop from the page's first moment on: while the rest of it is still being read, a press of the button sends it from here. */

import { sendStop } from "../api/gaits.js";
import { toast } from "../lib/toasts.js";

/** What is said where nobody has taken a Stop. */
export const NOT_TAKEN = "Stop did not reach the studio: it does not answer. Cut the robot's power.";

async function press({ target }) {
  if (!target.closest?.("#stop")) return;
  try {
    await sendStop("");
  } catch {
    toast(NOT_TAKEN, { tone: "bad", of: "studio" });
  }
}

document.addEventListener("click", press);

/** The top bar is there and sends Stop from now on. */
export const takeOverStop = () => document.removeEventListener("click", press);
