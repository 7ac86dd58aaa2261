// The page: axes, colour, the gait that is pointed at and the one that is chosen, by pointer and by keys.
const REACH = { mouse: 14, touch: 28 }; // how far from its dot a gait is still met, px
const allButton = /** @type {HTMLButtonElement} */ (find("all"));
const wide = matchMedia("(min-width: 1100px)");
const state = {
  x: null,
  y: null,
  colour: null,
  gaits: [],
  front: [], // the front lies along the horizontal axis
  onFront: new Set(),
  pointed: null,
  chosen: null, // gaits, or null
  asked: false,
  isStale: true,
};

function find(id) {
  return document.getElementById(id);
}

/** Asks for one painting before the next picture. */
function ask(isStale = false) {
  state.isStale ||= isStale;
  if (state.asked) return;
  state.asked = true;
  requestAnimationFrame(paint);
}

function paint() {
  state.asked = false;
  if (state.isStale) paintMap(state);
  state.isStale = false;
  const [pointed, chosen] = [state.pointed, state.chosen].map((gait) => (isShown(gait) ? gait : null));
  paintMarks(pointed, chosen);
  showCard(pointed, [state.x, state.y], state.onFront.has(pointed));
}

/** Whether the filters let a gait through; the list of gaits rises. There is none for null. */
function isShown(gait) {
  if (gait === null) return false;
  let [low, high] = [0, state.gaits.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (state.gaits[middle] < gait) low = middle + 1;
    else high = middle;
  }
  return state.gaits[low] === gait;
}

/** Looks anew at which gaits are shown, and which of them are the front. */
function update() {
  const { x, y, colour } = state;
  state.gaits = shownGaits(x, y);
  const front = frontOf(state.gaits, x, y);
  state.onFront = new Set(front);
  state.front = [...front].sort((a, b) => x.numbers[a] - x.numbers[b] || y.numbers[a] - y.numbers[b]);
  showFront(byDecreasing(front, columns.get("speed")), state.gaits, state.chosen);
  showLegend(colour, state.gaits);
  showRanges([x, y, colour], update);
  showGait(state.chosen, state.onFront.has(state.chosen));
  allButton.disabled = !isFiltered();
  const [some, total] = [state.gaits.length, atlas.count].map((count) => count.toLocaleString("en"));
  find("shown").textContent = `${some} of ${total} solved shown`;
  find("better").textContent = betterSentence(x, y);
  find("empty").hidden = state.gaits.length > 0;
  find("empty").textContent = "No gait is left. Make the filters wider, or show all gaits.";
  const shown = counted(state.gaits.length, "gait", "gaits");
  map.setAttribute("aria-label", `Map of ${shown}: ${titled(y)} over ${titled(x)}`);
  ask(true);
}

function byDecreasing(gaits, column) {
  if (column === undefined) return gaits;
  return [...gaits].sort((a, b) => column.numbers[b] - column.numbers[a] || a - b);
}

function betterSentence(x, y) {
  const wish = (column) => {
    const title = column.title.charAt(0).toLowerCase() + column.title.slice(1);
    if (column.better === 0) return `more ${title} to either side`;
    return column.better > 0 ? `more ${title}` : `less ${title}`;
  };
  return `Rings: the front, which no other shown gait beats. What counts is ${wish(y)} and ${wish(x)}.`;
}

/** Points at a gait, and keeps it if asked to. */
function look(gait, isChosen) {
  state.pointed = gait;
  if (isChosen) choose(gait);
  ask();
}

function choose(gait) {
  state.chosen = gait;
  showGait(gait, state.onFront.has(gait));
  markRow(gait);
  if (gait === null) find("said").textContent = "No gait chosen.";
  else {
    const named = present(["order", "speed", "least_margin"]);
    const words = named.map((column) => `${column.title} ${valueWords(column, gait)}`);
    find("said").textContent = `Gait ${ids[gait]}: ${words.join(", ")}.`;
  }
  ask();
}

/** Goes along the front: so many gaits further to the right, or upwards. */
function walk(steps, column) {
  if (state.front.length === 0) return;
  const along =
    column === state.x
      ? state.front
      : [...state.front].sort((a, b) => column.numbers[a] - column.numbers[b] || a - b);
  const place = along.indexOf(state.chosen);
  const start = steps > 0 ? 0 : along.length - 1;
  look(along[place < 0 ? start : Math.min(Math.max(place + steps, 0), along.length - 1)], true);
}

function onMapKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const acts = {
    ArrowRight: () => walk(1, state.x),
    ArrowLeft: () => walk(-1, state.x),
    ArrowUp: () => walk(1, state.y),
    ArrowDown: () => walk(-1, state.y),
    Home: () => walk(-Infinity, state.x),
    End: () => walk(Infinity, state.x),
    Escape: () => look(null, true),
  };
  if (acts[event.key] === undefined) return;
  event.preventDefault();
  acts[event.key]();
}

/** The row of the table where something happened, or null. */
function rowOf(event) {
  return event.target.closest("tr");
}

/** Arrow keys in the table. */
function onTableKey(event) {
  const rows = [...frontTable.tBodies[0].rows];
  const row = rowOf(event);
  const moves = { ArrowDown: 1, ArrowUp: -1, Home: -Infinity, End: Infinity };
  if (moves[event.key] === undefined || rows.length === 0) return;
  event.preventDefault();
  const next = rows[Math.min(Math.max(rows.indexOf(row) + moves[event.key], 0), rows.length - 1)];
  look(Number(next.dataset.gait), true);
  next.querySelector("button").focus({ preventScroll: true });
}

function met(event) {
  const frame = map.getBoundingClientRect();
  const reach = event.pointerType === "touch" ? REACH.touch : REACH.mouse;
  return nearest(state.gaits, event.clientX - frame.left, event.clientY - frame.top, reach);
}

function installMap() {
  map.addEventListener("pointermove", (event) => {
    if (event.pointerType !== "touch") look(met(event), false);
  });
  map.addEventListener("pointerleave", (event) => {
    if (event.pointerType !== "touch") look(null, false);
  });
  map.addEventListener("click", (event) => look(met(event), true));
  map.addEventListener("keydown", onMapKey);
  map.addEventListener("blur", () => look(null, false));
  new ResizeObserver(() => ask(true)).observe(map);
}

function installTable() {
  frontTable.tBodies[0].addEventListener("click", (event) => {
    const row = rowOf(event);
    if (row !== null) look(Number(row.dataset.gait), true);
  });
  frontTable.tBodies[0].addEventListener("keydown", onTableKey);
}

/** A list of keys: figures, then parameters. */
function fillKeys(list, keys, name) {
  const group = (label, members) => {
    const made = element("optgroup", "", { label });
    made.append(...members.map((column) => element("option", titled(column), { value: column.name })));
    return made;
  };
  list.append(
    group(
      "Figures",
      keys.filter((column) => column.isFigure),
    ),
    group(
      "Parameters",
      keys.filter((column) => !column.isFigure),
    ),
  );
  list.value = name;
}

function installKeys() {
  const all = [...columns.values()];
  const numbers = all.filter((column) => column.isNumber && (varies(column) || column.isFigure));
  const colours = all.filter((column) => varies(column) || column.name === "order");
  const usual = { x: "least_margin", y: "speed", colour: "order" };
  for (const [id, keys] of [
    ["x", numbers],
    ["y", numbers],
    ["colour", colours],
  ]) {
    const list = /** @type {HTMLSelectElement} */ (find(id));
    fillKeys(list, keys, usual[id]);
    state[id] = columns.get(usual[id]);
    list.addEventListener("change", () => {
      state[id] = columns.get(list.value);
      update();
    });
  }
}

/** The filters are unfolded where there is room for them. */
function installFolding() {
  const folded = /** @type {HTMLDetailsElement} */ (find("filters"));
  const fold = () => {
    folded.open = wide.matches;
  };
  wide.addEventListener("change", fold);
  fold();
}

function start() {
  installFolding();
  if (atlas.count === 0) {
    document.body.dataset.empty = "";
    find("empty").hidden = false;
    find("empty").textContent = "No gait of this atlas is solved, so there is nothing to draw.";
    return;
  }
  installKeys();
  showChoices(update);
  installMap();
  installTable();
  allButton.addEventListener("click", () => {
    clearFilters();
    update();
  });
  find("copy").addEventListener("click", copyCommand);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    palette = readPalette();
    update();
  });
  update();
}

start();
