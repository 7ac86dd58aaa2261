/** Requests for the tables of published experiments. */

import { bytes, onEach, request } from "./gaits.js";

const table = (/** @type {string} */ id) => `/api/published/${encodeURIComponent(id)}`;
/** @type {(id: string, row: string) => string} */
const rowOf = (id, row) => `${table(id)}/${encodeURIComponent(row)}`;

const onTable = onEach(table);

export const publishedApi = {
  list: () => request("GET", "/api/published"),
  table: onTable("GET"),
  compute: onTable("POST", "/compute"),
  cancel: onTable("DELETE", "/compute"),
  /** @param {string} folder "" forgets the folder */
  setReference: (folder) => request("PUT", "/api/published/reference", { folder }),
  /** @type {(id: string, row: string, source: string) => Promise<any>} */
  open: (id, row, source) => request("POST", `${rowOf(id, row)}/open`, { source }),
  /**
   * The x-y plot of a row as SVG.
   * @type {(id: string, row: string) => Promise<ArrayBuffer>}
   */
  plot: (id, row) => bytes("GET", `${rowOf(id, row)}/plot.svg`),
};
