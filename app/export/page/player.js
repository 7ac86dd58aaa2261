// Playing: one time for view, scrubber and diagram; the browser's own clock drives it.
const find = (id) => document.getElementById(id);
const START = data.times[0];
const END = data.times[last];
const SHAPES = { play: "M4 2.5v11l9-5.5z", pause: "M4 3h3v10H4zM9 3h3v10H9z" };
const scrub = /** @type {HTMLInputElement} */ (find("scrub"));
const speed = /** @type {HTMLSelectElement} */ (find("speed"));
const diagram = find("diagram").querySelector("svg");
const playhead = find("playhead");
const player = { time: START, playing: false, before: null, asked: false, from: 0, scale: 1 };

function show() {
  player.asked = false;
  const state = paint(player.time);
  scrub.value = String(player.time);
  scrub.setAttribute("aria-valuetext", `${(player.time - START).toFixed(1)} s`);
  find("clock").textContent = `${(player.time - START).toFixed(2)} / ${(END - START).toFixed(1)} s`;
  find("margin-dot").style.background = toneOf(state.margin);
  find("margin").textContent =
    state.margin === null
      ? "Too few feet stand for a support polygon"
      : `Stability margin ${(state.margin * 1000).toFixed(1)} mm`
        + (state.margin < 0 ? ", outside the support polygon" : "");
  const { places } = data.diagram;
  const { knot, part } = place(player.time);
  const x = mix(places[knot], places[Math.min(knot + 1, last)], part);
  playhead.style.transform = `translate(${player.from + x * player.scale}px, 0)`;
}

function ask() {
  if (player.asked) return;
  player.asked = true;
  requestAnimationFrame(tick);
}

function tick(now) {
  if (player.playing) {
    const passed = player.before === null ? 0 : Math.min((now - player.before) / 1000, 0.25);
    player.before = now;
    player.time += passed * Number(speed.value);
    if (player.time > END) player.time = START;
  }
  show();
  if (player.playing) ask();
}

function setPlaying(playing) {
  player.playing = playing;
  player.before = null;
  find("play").setAttribute("aria-label", playing ? "Pause" : "Play");
  find("play-shape").setAttribute("d", playing ? SHAPES.pause : SHAPES.play);
  ask();
}

function goTo(time) {
  player.time = Math.min(Math.max(time, START), END);
  ask();
}

function stepBy(knots) {
  setPlaying(false);
  const { knot, part } = place(player.time);
  const from = part >= 1 - 1e-9 ? knot + 1 : knot;
  const target = knots < 0 && part > 1e-9 && part < 1 - 1e-9 ? from : from + knots;
  goTo(data.times[Math.min(Math.max(target, 0), last)]);
}

function onKey(event) {
  if (["SELECT", "TEXTAREA"].includes(event.target.tagName) || event.ctrlKey || event.metaKey || event.altKey)
    return;
  const steps = event.shiftKey ? 10 : 1;
  const actions = {
    " ": () => setPlaying(!player.playing),
    ArrowLeft: () => stepBy(-steps),
    ArrowRight: () => stepBy(steps),
    Home: () => goTo(START),
    End: () => {
      setPlaying(false);
      goTo(END);
    },
  };
  if (event.key === " " && event.target.tagName === "BUTTON") return;
  if (actions[event.key] === undefined) return;
  event.preventDefault();
  actions[event.key]();
}

function installPointer() {
  const held = new Map();
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, [event.clientX, event.clientY]);
  });
  const release = (event) => held.delete(event.pointerId);
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("pointermove", (event) => {
    const from = held.get(event.pointerId);
    if (from === undefined) return;
    const to = [event.clientX, event.clientY];
    if (held.size === 1) orbit(to[0] - from[0], to[1] - from[1]);
    else {
      const other = [...held].find(([id]) => id !== event.pointerId)[1];
      zoom(
        Math.hypot(from[0] - other[0], from[1] - other[1]) / Math.hypot(to[0] - other[0], to[1] - other[1]),
      );
    }
    held.set(event.pointerId, to);
  });
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      zoom(Math.exp(event.deltaY * 0.001));
    },
    { passive: false },
  );
}

function orbit(dx, dy) {
  camera.yaw -= dx * 0.008;
  camera.pitch = Math.min(Math.max(camera.pitch + dy * 0.008, LOWEST_PITCH), 1.55);
  ask();
}

function zoom(factor) {
  camera.distance = Math.min(Math.max(camera.distance * factor, world.radius * 2), world.radius * 14);
  ask();
}

function installDiagram() {
  const { top, bottom, places } = data.diagram;
  const fit = () => {
    const matrix = diagram.getScreenCTM();
    const frame = find("diagram").getBoundingClientRect();
    player.from = matrix.e - frame.left;
    player.scale = matrix.a;
    playhead.style.top = `${matrix.f - frame.top + (top - 8) * matrix.a}px`;
    playhead.style.height = `${(bottom - top + 16) * matrix.a}px`;
    ask();
  };
  new ResizeObserver(fit).observe(diagram);
  const scrubTo = (event) => {
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(
      diagram.getScreenCTM().inverse(),
    );
    const low = Math.min(
      Math.max(
        places.findLastIndex((x) => x <= point.x),
        0,
      ),
      last - 1,
    );
    const part = (point.x - places[low]) / (places[low + 1] - places[low]);
    goTo(mix(data.times[low], data.times[low + 1], Math.min(Math.max(part, 0), 1)));
  };
  diagram.addEventListener("pointerdown", (event) => {
    diagram.setPointerCapture(event.pointerId);
    setPlaying(false);
    scrubTo(event);
  });
  diagram.addEventListener("pointermove", (event) => {
    if (event.buttons) scrubTo(event);
  });
}

scrub.min = START;
scrub.max = END;
scrub.addEventListener("input", () => {
  setPlaying(false);
  goTo(Number(scrub.value));
});
find("play").addEventListener("click", () => setPlaying(!player.playing));
find("body").addEventListener("click", () => {
  camera.showsBody = !camera.showsBody;
  find("body").setAttribute("aria-pressed", String(camera.showsBody));
  ask();
});
find("home").addEventListener("click", () => {
  homeView();
  ask();
});
document.addEventListener("keydown", onKey);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  palette = readPalette();
  ask();
});
new ResizeObserver(ask).observe(canvas);
addEventListener("beforeprint", show);
installPointer();
installDiagram();
homeView();
setPlaying(!matchMedia("(prefers-reduced-motion: reduce)").matches);
