/** The style sheet of videos and cameras, which comes with their modules. */

import { h } from "../lib/dom.js";

document.head.append(
  h("link", { rel: "stylesheet", href: new URL("./pictures.css", import.meta.url).pathname }),
);
