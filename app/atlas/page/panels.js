// What stands beside the map: the legend, the front as a table, the chosen gait, and the card of a gait.
const CARD_KEYS = ["speed", "least_margin", "step", "seconds"];
const frontTable = /** @type {HTMLTableElement} */ (find("front"));

/** An element with words, and attributes. */
function element(name, words = "", attributes = {}) {
  const made = document.createElement(name);
  made.textContent = words;
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

function term(column, gait) {
  return [element("dt", column.title), element("dd", valueWords(column, gait))];
}

/** Columns by name, without those that the atlas does not have. */
function present(names) {
  return [...new Set(names)].map((name) => columns.get(name)).filter((column) => column !== undefined);
}

function counted(count, one, many) {
  return `${count.toLocaleString("en")} ${count === 1 ? one : many}`;
}

/** What each colour means, with how many of the shown gaits have it. */
function showLegend(column, gaits) {
  const tones = tonesOf(column);
  const swatch = (style) => {
    const dot = element("i", "", { class: "swatch" });
    dot.style.background = style;
    return dot;
  };
  if (column.choices === null || column.choices.length > MOST_TONES) {
    const [low, high] = rangeOf(column, gaits);
    const words = (value) => (column.isNumber ? numberWords(column, value) : choiceWords(column, value));
    const line = element("li", "", { class: "range" });
    const ends = gaits.length > 0 ? [words(low), words(high)] : ["–", "–"];
    const band = swatch(`linear-gradient(90deg, ${tones.join(", ")})`);
    line.append(element("span", ends[0]), band, element("span", ends[1]));
    find("legend").replaceChildren(line);
    return;
  }
  const counts = new Uint32Array(column.choices.length);
  for (const gait of gaits) counts[column.places[gait]] += 1;
  find("legend").replaceChildren(
    ...column.choices.map((_, place) => {
      const line = element("li");
      const count = element("span", counts[place].toLocaleString("en"), { class: "count" });
      line.append(swatch(tones[place]), element("span", withUnit(column, choiceWords(column, place))), count);
      return line;
    }),
  );
}

/** The front as a table, fastest first; one row is a stop of Tab, arrow keys lead to the others. */
function showFront(listed, gaits, chosen) {
  const keys = ["order", "step", "speed", "least_margin"].map((name) => columns.get(name));
  const body = frontTable.tBodies[0];
  const focused = body.contains(document.activeElement);
  body.replaceChildren(
    ...listed.map((gait) => {
      const row = element("tr", "", { "data-gait": gait });
      const head = element("th", "", { scope: "row" });
      head.append(element("button", String(ids[gait]), { type: "button" }));
      const cell = (column) => element("td", column === undefined ? "–" : bareWords(column, gait));
      row.append(head, ...keys.map(cell));
      return row;
    }),
  );
  find("front-count").textContent =
    `${counted(listed.length, "gait", "gaits")} of `
    + `${gaits.length.toLocaleString("en")} shown, the fastest first`;
  markRow(chosen, focused);
}

/** Marks the row of a gait, and makes it the stop of Tab. */
function markRow(chosen, takesFocus = false) {
  const rows = [...frontTable.tBodies[0].rows];
  const marked = rows.find((row) => Number(row.dataset.gait) === chosen);
  for (const row of rows) {
    const button = row.querySelector("button");
    button.setAttribute("aria-pressed", String(row === marked));
    button.tabIndex = row === (marked ?? rows[0]) ? 0 : -1;
  }
  const stop = marked ?? rows[0];
  if (marked !== undefined) showRow(marked);
  if (takesFocus && stop !== undefined) stop.querySelector("button").focus({ preventScroll: true });
}

/** Rolls the table, and nothing else, until a row is in sight below the table's head. */
function showRow(row) {
  const box = frontTable.parentElement;
  const head = frontTable.tHead.offsetHeight;
  const [top, bottom] = [row.offsetTop - head, row.offsetTop + row.offsetHeight - box.clientHeight];
  box.scrollTop = Math.min(Math.max(box.scrollTop, bottom), top);
}

/** The chosen gait: all its figures and parameters, and the command that opens it. */
function showGait(gait, isOnFront) {
  find("gait").hidden = gait === null;
  if (gait === null) {
    find("gait-title").textContent = "No gait chosen";
    find("gait-note").textContent = "Choose one on the map or in the table.";
    return;
  }
  find("gait-title").textContent = `Gait ${ids[gait]}`;
  find("gait-note").textContent = isOnFront ? "On the front" : "Not on the front";
  const all = [...columns.values()];
  find("figures").replaceChildren(...all.filter((one) => one.isFigure).flatMap((one) => term(one, gait)));
  find("parameters").replaceChildren(...all.filter((one) => !one.isFigure).flatMap((one) => term(one, gait)));
  find("command").textContent = atlas.open.join(ids[gait]);
  find("open-note").textContent = atlas.opens_as_file
    ? "It solves the gait again, compares it with the atlas, and makes it a gait file."
    : "It solves the gait again and compares it with the atlas. A gait file cannot hold its robot's numbers.";
  find("copy").textContent = "Copy";
}

/** A card with a gait's main figures beside its dot; null hides it. */
function showCard(gait, axes, isOnFront) {
  const card = find("card");
  card.hidden = gait === null;
  if (gait === null) return;
  const head = element("p");
  head.append(element("b", `Gait ${ids[gait]}`), element("span", isOnFront ? "On the front" : ""));
  const list = element("dl");
  const names = ["order", ...CARD_KEYS, ...axes.map((column) => column.name)];
  list.append(...present(names).flatMap((column) => term(column, gait)));
  card.replaceChildren(head, list);
  const [left, top] = placeOf(gait);
  const [width, height] = [card.offsetWidth, card.offsetHeight];
  const beside = left + 16 + width <= plot.width ? left + 16 : Math.max(left - 16 - width, 0);
  card.style.left = `${Math.min(beside, plot.width - width)}px`;
  card.style.top = `${Math.min(Math.max(top - height / 2, 0), Math.max(plot.height - height, 0))}px`;
}

/** Copies the command; where the browser does not allow it, marks the command so that a person can. */
async function copyCommand() {
  const command = find("command");
  try {
    await navigator.clipboard.writeText(command.textContent);
    find("copy").textContent = "Copied";
  } catch {
    getSelection().selectAllChildren(command);
    find("copy").textContent = "Press Ctrl C";
  }
}
