/** Photos of a trial: chosen, dropped or taken, with captions; a deleted photo can be restored. */

import { request, sendFile } from "../api/gaits.js";
import { h, icon } from "../lib/dom.js";
import { announce, attempt, toast } from "../lib/toasts.js";

const KINDS = "image/png,image/jpeg";

const photosOf = (trial) => `/api/trials/${encodeURIComponent(trial)}/photos`;
const photoAt = (trial, photo) => `${photosOf(trial)}/${encodeURIComponent(photo)}`;

const photoApi = {
  list: async (trial) => (await request("GET", photosOf(trial))).photos,
  add: (trial, file) =>
    sendFile(
      `${photosOf(trial)}?name=${encodeURIComponent(file.name || "The photo")}`,
      file,
      file.type || "application/octet-stream",
    ),
  caption: (trial, photo, caption) => request("PUT", photoAt(trial, photo), { caption }),
  remove: (trial, photo) => request("DELETE", photoAt(trial, photo)),
  restore: (trial, photo) => request("POST", `${photoAt(trial, photo)}/restore`),
};

/** A button that lets a person choose files; `attributes` are the chooser's. */
function chooser(name, help, attributes, chosen) {
  const input = h("input", { type: "file", accept: KINDS, hidden: true, "aria-label": name, ...attributes });
  input.addEventListener("change", () => {
    chosen([...input.files]);
    input.value = "";
  });
  return [h("button", { class: "link", text: name, title: help, on: { click: () => input.click() } }), input];
}

function photoItem(trial, { id, caption, name, width, height }, number, refresh) {
  const at = photoAt(trial, id);
  const words = caption || name;
  const picture = h("img", { src: `${at}/picture?small=true`, alt: words, width, height, loading: "lazy" });
  const field = h("input", {
    type: "text",
    "aria-label": `Caption of photo ${number}`,
    placeholder: "Caption",
    maxlength: "500",
  });
  field.value = caption;
  field.addEventListener(
    "change",
    attempt(async () => {
      await photoApi.caption(trial, id, field.value.trim());
      picture.alt = field.value.trim() || name;
      announce("Caption kept.");
    }),
  );
  const erase = h(
    "button",
    {
      class: "plain icon-only",
      "aria-label": `Delete photo ${number}`,
      title: "Deletes this photo. Undo brings the photo back",
    },
    icon("close"),
  );
  erase.addEventListener(
    "click",
    attempt(async () => {
      await photoApi.remove(trial, id);
      await refresh();
      toast(`The photo “${words}” is deleted.`, {
        action: {
          label: "Undo",
          act: attempt(async () => {
            await photoApi.restore(trial, id);
            await refresh();
          }),
        },
      });
    }),
  );
  return h(
    "li",
    {},
    h(
      "a",
      { href: `${at}/picture`, target: "_blank", rel: "noopener", title: "Opens the photo in a new tab" },
      picture,
    ),
    field,
    erase,
  );
}

/**
 * Builds the photos of a trial.
 * @param {string} trial its id
 * @returns {HTMLElement}
 */
export function photosPart(trial) {
  const list = h("ul", { class: "photo-list", role: "list", "aria-label": "Photos" });

  const refresh = attempt(async () => {
    const photos = await photoApi.list(trial);
    list.replaceChildren(...photos.map((photo, index) => photoItem(trial, photo, index + 1, refresh)));
  });

  const add = attempt(async (files) => {
    try {
      for (const file of files) await photoApi.add(trial, file);
    } finally {
      await refresh();
    }
  });

  const ways = chooser(
    "Add photos…",
    "Add PNG or JPEG files, or drop them here. The studio removes the location and time stored in a photo",
    { multiple: true },
    add,
  );
  // A tablet's own camera; elsewhere it would be a second button for the same.
  const camera = matchMedia("(pointer: coarse)").matches
    ? chooser("Take a photo", "Takes a photo with the camera of this device", { capture: "environment" }, add)
    : [];
  const element = h(
    "section",
    { class: "trial-photos", "aria-label": "Photos of this trial" },
    h("div", { class: "photo-ways" }, h("span", { class: "quiet", text: "Photos" }), ...ways, ...camera),
    list,
  );
  const hold = (on) => (event) => {
    event.preventDefault();
    element.toggleAttribute("data-drop", on);
  };
  element.addEventListener("dragover", hold(true));
  element.addEventListener("dragleave", hold(false));
  element.addEventListener("drop", (event) => {
    hold(false)(event);
    add([...event.dataTransfer.files]);
  });
  refresh();
  return element;
}
