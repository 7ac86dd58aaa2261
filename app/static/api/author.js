/**
 * Who edits: this tab, and the person who sits at it. Both go along with every request, so that undo takes
 * back one's own edits. The tab's id survives a reload; a tab that a browser made as a copy of another takes
 * a new one.
 */

const KEY = "footfall.page";

const random = () =>
  [...crypto.getRandomValues(new Uint8Array(12))].map((byte) => byte.toString(16).padStart(2, "0")).join("");

function recalled() {
  try {
    return sessionStorage.getItem(KEY);
  } catch {
    return null;
  }
}

/** @param {string} id */
function keep(id) {
  try {
    sessionStorage.setItem(KEY, id);
  } catch {
    return;
  }
}

const load = random();
let page = recalled() ?? load;
let name = "";
let edits = 0;
let renamed = () => {};
keep(page);

const channel = new BroadcastChannel(KEY);
channel.addEventListener("message", ({ data }) => {
  if (data.asks === page && data.load !== load) channel.postMessage({ taken: page, load: data.load });
  if (data.taken !== page || data.load !== load) return;
  page = random();
  keep(page);
  renamed();
});
channel.postMessage({ asks: page, load });

/** A number for an edit that no other one has, also after a reload. */
export const editNumber = () => `${load}.${(edits += 1)}`;

/** This tab's id. */
export const pageId = () => page;

/**
 * `act` is called when the tab had to take another id.
 * @param {() => void} act
 */
export function onRenamed(act) {
  renamed = act;
}

/**
 * Tells the studio from now on who sits here.
 * @param {string} person
 */
export function nameAuthor(person) {
  name = person;
}

/**
 * The headers that identify who edits.
 * @returns {Record<string, string>}
 */
export function authorHeaders() {
  return { "X-Footfall-Page": page, ...(name ? { "X-Footfall-Name": encodeURIComponent(name) } : {}) };
}

/**
 * What this tab can undo and redo of a gait: names of edits, or null.
 * @param {Record<string, any>|null} view
 * @returns {{undo: string|null, redo: string|null}}
 */
export function ownSteps(view) {
  return view?.steps?.[page] ?? { undo: view?.undo ?? null, redo: view?.redo ?? null };
}
