/**
 * The segment table as a sheet: a row a segment, the link's segments below, a column a foot of the robot.
 *
 * A document's table is of direction 1; the sheet's columns are the robot's own feet. Rows and feet count
 * from 0 here, the repeating part `from`–`to` from 1, as persons count.
 */

/**
 * `rows` are the segments' names, `count` of them before the link; `words` the definitions of segments.
 * @typedef {{legs: number, shift: number, iterations: number, rows: string[][], count: number, from: number,
 *   to: number, toEnd: boolean, samples: number, words: Record<string, any>}} Sheet
 * @typedef {import("./drawable.js").GaitDocument} GaitDocument
 */

/** @param {number} value @param {number} count */
const mod = (value, count) => ((value % count) + count) % count;
/** @param {number} legs @param {number} direction */
const shiftOf = (legs, direction) => mod(Math.floor(((direction - 1) * legs) / 4), legs);
/** @param {string[][]} rows */
const transposed = (rows) => (rows[0] ?? []).map((_, index) => rows.map((row) => row[index]));

/**
 * Which row of a document's table a foot of the robot has.
 * @param {Pick<Sheet, "legs"|"shift">} sheet
 * @param {number} foot
 */
export const ownRow = ({ legs, shift }, foot) => mod(foot - shift, legs);

/**
 * The sheet of a document, or null where it has no segment table.
 * @param {GaitDocument|null|undefined} document
 * @returns {Sheet|null}
 */
export function segmentSheetOf(document) {
  const table = document?.segment_table;
  if (!table) return null;
  const legs = table.feet.length;
  const sheet = { legs, shift: shiftOf(legs, document.direction), iterations: document.iterations };
  const own = (/** @type {string[][]} */ rows) =>
    rows?.length ? rows.map((_, foot) => rows[ownRow(sheet, foot)]) : [];
  const [feet, link] = [transposed(own(table.feet)), transposed(own(table.link))];
  return {
    ...sheet,
    rows: [...feet, ...link],
    count: feet.length,
    from: table.repeat_from,
    to: table.repeat_to ?? feet.length,
    toEnd: table.repeat_to === null || table.repeat_to === undefined,
    samples: table.samples_per_segment,
    words: table.definitions,
  };
}

/** The document's segment table of a sheet. @param {Sheet} sheet */
export function tableOf(sheet) {
  const columns = (/** @type {string[][]} */ rows) =>
    rows.length
      ? Array.from({ length: sheet.legs }, (_, row) =>
          rows.map((names) => names[mod(row + sheet.shift, sheet.legs)]),
        )
      : [];
  return {
    samples_per_segment: sheet.samples,
    repeat_from: sheet.from,
    repeat_to: sheet.toEnd && sheet.to === sheet.count ? null : sheet.to,
    link: columns(sheet.rows.slice(sheet.count)),
    feet: columns(sheet.rows.slice(0, sheet.count)),
    definitions: sheet.words,
  };
}

/**
 * What a row is called: "segment 4", or "link segment 1".
 * @param {Pick<Sheet, "count">} sheet
 * @param {number} row
 */
export const rowName = ({ count }, row) =>
  row < count ? `segment ${row + 1}` : `link segment ${row - count + 1}`;

/**
 * Where a foot is before a row's segment; null where anything may begin.
 * @param {Sheet} sheet
 * @param {number} row
 * @param {number} foot
 */
export function placeBefore({ rows, count, to, words }, row, foot) {
  if (row === 0) return null;
  return words.segments[rows[(row === count ? to : row) - 1][foot]]?.end ?? null;
}

/**
 * Where a foot is after a row's segment.
 * @param {Sheet} sheet
 * @param {number} row
 * @param {number} foot
 */
export const placeAfter = ({ rows, words }, row, foot) => words.segments[rows[row][foot]]?.end ?? null;

/** @param {Sheet} sheet @param {number} row @param {number} foot */
function cellError(sheet, row, foot) {
  const name = sheet.rows[row][foot];
  const segment = sheet.words.segments[name];
  if (!segment) return `there is no segment “${name}”.`;
  const before = placeBefore(sheet, row, foot);
  return before && before !== segment.start
    ? `“${name}” starts at ${segment.start}, but the segment before it ends at ${before}.`
    : null;
}

/**
 * Why a foot's iterations cannot follow one another: `{row, sentence}`, or null.
 * @param {Sheet} sheet
 * @param {number} foot
 */
function chainError(sheet, foot) {
  const last = (sheet.rows.length > sheet.count ? sheet.rows.length : sheet.to) - 1;
  const [after, goal] = [
    placeAfter(sheet, last, foot),
    sheet.words.segments[sheet.rows[sheet.from - 1]?.[foot]]?.start,
  ];
  const sentence = `the segment ends at ${after}, but the next iteration starts at ${goal}.`;
  return after === goal ? null : { row: last, sentence };
}

/**
 * Cells that do not fit, the first ones first: `{row, foot, sentence, stops}`. Those of the link and of the
 * way into the next iteration stop nothing while there is one iteration only.
 * @param {Sheet} sheet
 */
export function errorsOf(sheet) {
  /** @type {{row: number, foot: number, sentence: string, stops: boolean}[]} */
  const found = [];
  for (let foot = 0; foot < sheet.legs; foot += 1) {
    for (let row = 0; row < sheet.rows.length; row += 1) {
      const sentence = cellError(sheet, row, foot);
      if (sentence) found.push({ row, foot, sentence, stops: row < sheet.count || sheet.iterations > 1 });
    }
    const chain = chainError(sheet, foot);
    if (chain && !found.some((one) => one.foot === foot))
      found.push({ ...chain, foot, stops: sheet.iterations > 1 });
  }
  return found.sort((a, b) => Number(b.stops) - Number(a.stops) || a.row - b.row);
}

/**
 * "Foot 2, segment 4: …"
 * @param {Pick<Sheet, "count">} sheet
 * @param {{row: number, foot: number, sentence: string}} error
 */
export const errorSentence = (sheet, { row, foot, sentence }) =>
  `Foot ${foot + 1}, ${rowName(sheet, row)}: ${sentence}`;

/**
 * Every segment for a cell: `{name, segment, why}`, those that fit first; `why` says why one does not.
 * @param {Sheet} sheet
 * @param {number} row
 * @param {number} foot
 */
export function choicesOf(sheet, row, foot) {
  const before = placeBefore(sheet, row, foot);
  const all = Object.entries(sheet.words.segments).map(([name, segment]) => ({
    name,
    segment,
    why: before && before !== segment.start ? `starts at ${segment.start}` : null,
  }));
  return [...all.filter(({ why }) => !why), ...all.filter(({ why }) => why)];
}

/** The segment that waits at a position, or null. @param {Sheet} sheet @param {string} place */
export const waitAt = ({ words }, place) =>
  Object.entries(words.segments).find(
    ([, { start, end, swing }]) => start === place && end === place && !swing,
  )?.[0] ?? null;

/** Rows in the order in which all iterations run through them. @param {Sheet} sheet @returns {number[]} */
export function walked({ count, rows, from, to, iterations }) {
  const range = (/** @type {number} */ first, /** @type {number} */ end) =>
    Array.from({ length: Math.max(end - first, 0) }, (_, index) => first + index);
  const again = Array.from({ length: iterations - 1 }, () => [
    ...range(count, rows.length),
    ...range(from - 1, to),
  ]).flat();
  return [...range(0, to), ...again, ...range(to, count)];
}

/**
 * The samples of rows, where they first come: `[first, last]`, 0-based; null for a link that is not walked.
 * @param {Sheet} sheet
 * @param {number[]} rows
 */
export function samplesOf(sheet, [first, last]) {
  const places = walked(sheet);
  /** @type {number[]} */
  const found = [];
  for (let row = first; row <= last; row += 1) if (places.includes(row)) found.push(places.indexOf(row));
  return found.length
    ? [Math.min(...found) * sheet.samples, (Math.max(...found) + 1) * sheet.samples - 1]
    : null;
}

/** The rows that samples belong to: `[first, last]`. @param {Sheet} sheet @param {number[]} samples */
export function rowsOf(sheet, [first, last]) {
  const rows = walked(sheet).slice(Math.floor(first / sheet.samples), Math.floor(last / sheet.samples) + 1);
  return rows.length ? [Math.min(...rows), Math.max(...rows)] : null;
}
