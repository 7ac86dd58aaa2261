/** Sends a press of Stop while the rest of the page is still loading. */

import { sendStop } from "../api/gaits.js";
import { toast } from "../lib/toasts.js";

/** The message if the studio has not taken a Stop. */
export const NOT_TAKEN =
  "Stop did not reach the studio, which does not answer. Switch off the robot's power.";

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
