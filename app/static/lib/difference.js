/** How two documents differ, for people. */

import { h } from "./dom.js";

/**
 * What is different, in groups of sentences.
 * @param {{title: string, sentences: string[]}[]} groups
 */
export function sentences(groups) {
  if (!groups.length) return [h("p", { class: "quiet", text: "Nothing is different." })];
  return groups.flatMap(({ title, sentences: list }) => [
    h("h4", { text: title }),
    h("ul", {}, ...list.map((text) => h("li", { text }))),
  ]);
}
