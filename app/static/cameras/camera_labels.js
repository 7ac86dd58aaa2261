/** Labels and texts of cameras and setups. */

export const FOOT_NAMES = ["Foot 1, green", "Foot 2, red", "Foot 3, orange", "Foot 4, blue"];

export const USES = [
  ["under", "under the platform"],
  ["side", "from the side"],
];

const TONES = { live: "good", starting: "accent", idle: "quiet", unplugged: "bad" };
const STATES = { live: "live", starting: "starting", idle: "connected", unplugged: "unplugged" };

export const cameraTone = ({ state }) => TONES[state] ?? "quiet";
export const cameraLabel = ({ state, recording }) => (recording ? "recording" : (STATES[state] ?? state));

/** What is missing from a setup, in one line. */
export const setupText = ({ ready, missing }) => (ready ? "Complete." : missing.join(" "));

/** Seconds as minutes and seconds. */
export const durationText = (seconds) =>
  seconds < 60 ? `${seconds.toFixed(1)} s` : `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`;

/** Bytes as megabytes. */
export const sizeText = (bytes) => `${(bytes / 1e6).toFixed(bytes < 1e7 ? 1 : 0)} MB`;
