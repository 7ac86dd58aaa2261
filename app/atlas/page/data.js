// The atlas as columns of numbers: reading them, their words for people, filters, and the front.

/**
 * A key of all gaits.
 * @typedef {Object} Column
 * @property {string} name
 * @property {string} title
 * @property {string} unit in which a person reads it
 * @property {number} factor from SI to that unit
 * @property {number | null} decimals
 * @property {1 | -1 | 0} better 1 where more is better, -1 where less is, 0 where the size counts
 * @property {boolean} isFigure
 * @property {boolean} isNumber whether it can be an axis
 * @property {Float64Array} numbers SI, a value a gait; NaN where there is none
 * @property {any[] | null} choices all values; null of a range
 * @property {Uint16Array | null} places of each gait's value among the choices
 */

/** Limits that a person has set: from and to, in the unit of people, and places of choices, by key. */
const filters = { from: new Map(), to: new Map(), choice: new Map() };

const atlas = JSON.parse(document.getElementById("atlas").textContent);
const DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
const ids = unpackedNumbers(atlas.ids);
/** @type {Map<string, Column>} */
const columns = readColumns();

/** Whole numbers of so many digits to the base of 64. */
function unpacked(packed, digits) {
  const worth = new Uint8Array(128);
  for (let place = 0; place < DIGITS.length; place += 1) worth[DIGITS.charCodeAt(place)] = place;
  const codes = new Float64Array(atlas.count);
  for (let gait = 0; gait < codes.length; gait += 1) {
    let code = 0;
    for (let i = gait * digits; i < (gait + 1) * digits; i += 1) {
      code = code * 64 + worth[packed.charCodeAt(i)];
    }
    codes[gait] = code;
  }
  return codes;
}

function unpackedNumbers({ low, step, digits, packed }) {
  const missing = 64 ** digits - 1;
  return unpacked(packed, digits).map((code) => (code === missing ? NaN : (low + code) * step));
}

function readColumns() {
  const read = atlas.columns.map((column) => {
    const { name, title, unit, factor, decimals, better, is_figure: isFigure, is_number: isNumber } = column;
    const words = { name, title, unit, factor, decimals, better, isFigure, isNumber };
    if (column.values === undefined) {
      return { ...words, numbers: unpackedNumbers(column), choices: null, places: null };
    }
    const places = Uint16Array.from(unpacked(column.packed, column.digits));
    const numbers = Float64Array.from(places, (place) => (isNumber ? column.values[place] : NaN));
    return { ...words, numbers, choices: column.values, places };
  });
  return new Map(withStep(read).map((column) => [column.name, column]));
}

/** The columns with the length of the step, which has no column of its own. */
function withStep(read) {
  const [along, across] = ["step_x", "step_y"].map((name) => read.find((column) => column.name === name));
  if (along === undefined || across === undefined) return read;
  const numbers = along.numbers.map((value, gait) => Math.hypot(value, across.numbers[gait]));
  const step = { ...along, name: "step", title: "Step", better: 1, numbers, choices: null, places: null };
  return [...read.slice(0, read.indexOf(along)), step, ...read.slice(read.indexOf(along))];
}

/** Whether gaits differ in a key. */
function varies(column) {
  if (column.choices !== null) return column.choices.length > 1;
  const first = column.numbers.find((value) => !Number.isNaN(value));
  return column.numbers.some((value) => !Number.isNaN(value) && value !== first);
}

/** A title with its unit: “Speed, mm/s”. */
function titled(column) {
  return column.unit === "" ? column.title : `${column.title}, ${column.unit}`;
}

/** A number of a key as a person reads it, without its unit. */
function numberWords(column, value) {
  if (Number.isNaN(value)) return "–";
  const shown = value * column.factor;
  const { decimals } = column;
  const text = decimals === null ? String(Number(shown.toPrecision(4))) : shown.toFixed(decimals);
  return text.replace(/^-0(\.0*)?$/, "0$1").replace("-", "−");
}

/** A choice as a person reads it, without a unit. */
function choiceWords(column, place) {
  const value = column.choices[place];
  if (column.isNumber) return numberWords(column, value);
  if (typeof value === "boolean") return value ? "yes" : "no";
  return value === "" ? "none" : String(value).replaceAll(",", "-");
}

/** Words of a value with its unit. */
function withUnit(column, text) {
  if (column.unit === "" || text === "–") return text;
  return /^[°%]/.test(column.unit) ? `${text}${column.unit}` : `${text} ${column.unit}`;
}

/** A gait's value of a key as a person reads it, without its unit. */
function bareWords(column, gait) {
  const { choices, numbers, places } = column;
  return choices === null ? numberWords(column, numbers[gait]) : choiceWords(column, places[gait]);
}

/** The same with its unit. */
function valueWords(column, gait) {
  return withUnit(column, bareWords(column, gait));
}

/** Gaits that every filter lets through, and that have a value on both axes. */
function shownGaits(x, y) {
  const tests = [(gait) => !Number.isNaN(x.numbers[gait]) && !Number.isNaN(y.numbers[gait])];
  for (const [name, low] of filters.from) {
    const { numbers, factor } = columns.get(name);
    tests.push((gait) => numbers[gait] * factor >= low - 1e-9);
  }
  for (const [name, high] of filters.to) {
    const { numbers, factor } = columns.get(name);
    tests.push((gait) => numbers[gait] * factor <= high + 1e-9);
  }
  for (const [name, place] of filters.choice) {
    const { places } = columns.get(name);
    tests.push((gait) => places[gait] === place);
  }
  const gaits = [];
  for (let gait = 0; gait < atlas.count; gait += 1) {
    if (tests.every((test) => test(gait))) gaits.push(gait);
  }
  return gaits;
}

/** How good a gait is in a key: its value, its negative where less is better, or its size. */
function gain(column, gait) {
  const value = column.numbers[gait];
  return column.better === 0 ? Math.abs(value) : column.better * value;
}

/** Gaits that no other of them beats in one key without losing in the other; the best in `y` first. */
function frontOf(gaits, x, y) {
  const sorted = [...gaits].sort((a, b) => gain(y, b) - gain(y, a) || gain(x, b) - gain(x, a) || a - b);
  let best = -Infinity;
  return sorted.filter((gait) => {
    if (gain(x, gait) <= best) return false;
    best = gain(x, gait);
    return true;
  });
}
