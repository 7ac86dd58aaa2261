/** A picture to look closely at: zoomed by wheel, buttons and keys, moved by drag, with drawings over it. */

import { clamp } from "../lib/clamp.js";
import { h, icon, svg } from "../lib/dom.js";

const CLOSEST = 24;
const WHEEL = 0.0015;
const STEP = 1.4;
const CLICK_PX = 4;
const PAN_PX = 48;
const KEYS_HELP = "The arrow keys move the picture. The keys + and − zoom. The key F shows the whole picture";

/** The scale and place of a picture in its frame; `x`, `y` is where its corner lies, screen px. */
function createView(changed) {
  const view = { scale: 1, x: 0, y: 0, fitted: true };
  return {
    view,
    fit(frame, size) {
      view.scale = Math.min(frame.width / size.width, frame.height / size.height) || 1;
      view.x = (frame.width - size.width * view.scale) / 2;
      view.y = (frame.height - size.height * view.scale) / 2;
      view.fitted = true;
      changed();
    },
    /** Zooms so that the place under the pointer stays there. */
    zoom(factor, at, frame, size) {
      const least = Math.min(frame.width / size.width, frame.height / size.height, 1) / 2;
      const scale = clamp(view.scale * factor, least, CLOSEST);
      view.x = at.x - ((at.x - view.x) * scale) / view.scale;
      view.y = at.y - ((at.y - view.y) * scale) / view.scale;
      view.scale = scale;
      view.fitted = false;
      changed();
    },
    move(dx, dy, frame, size) {
      view.x = clamp(view.x + dx, 40 - size.width * view.scale, frame.width - 40);
      view.y = clamp(view.y + dy, 40 - size.height * view.scale, frame.height - 40);
      view.fitted = false;
      changed();
    },
    /** @param {number[]} place */
    toScreen: ([x, y]) => [view.x + (x + 0.5) * view.scale, view.y + (y + 0.5) * view.scale],
    toPlace: ({ x, y }) => [(x - view.x) / view.scale - 0.5, (y - view.y) / view.scale - 0.5],
  };
}

/** A click that was no drag, dragging, and the wheel. */
function mountPointer(frame, { pan, zoom, click, hover }) {
  let from = null;
  const at = (event) => {
    const { left, top } = frame.getBoundingClientRect();
    return { x: event.clientX - left, y: event.clientY - top };
  };
  frame.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || event.target.closest(".video-point, .video-zoom")) return;
    from = { x: event.clientX, y: event.clientY, moved: false };
    frame.setPointerCapture(event.pointerId);
  });
  frame.addEventListener("pointermove", (event) => {
    if (!from) return hover(event.target.closest(".video-zoom") ? null : at(event));
    const [dx, dy] = [event.clientX - from.x, event.clientY - from.y];
    if (!from.moved && Math.hypot(dx, dy) < CLICK_PX) return undefined;
    from = { x: event.clientX, y: event.clientY, moved: true };
    hover(null);
    return pan(dx, dy);
  });
  frame.addEventListener("pointerup", (event) => {
    const clicked = from && !from.moved;
    from = null;
    if (clicked) click(at(event));
  });
  frame.addEventListener("pointercancel", () => {
    from = null;
  });
  frame.addEventListener("pointerleave", () => hover(null));
  frame.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      zoom(Math.exp(-event.deltaY * WHEEL), at(event));
    },
    { passive: false },
  );
}

function mountKeys(frame, { closer, further, fit, pan }) {
  const actions = {
    "+": closer,
    "=": closer,
    "-": further,
    "−": further,
    f: fit,
    ArrowLeft: () => pan(PAN_PX, 0),
    ArrowRight: () => pan(-PAN_PX, 0),
    ArrowUp: () => pan(0, PAN_PX),
    ArrowDown: () => pan(0, -PAN_PX),
  };
  frame.addEventListener("keydown", (event) => {
    const act = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act || event.target !== frame || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  });
}

function zoomButtons({ closer, further, fit }) {
  const button = (text, name, act) =>
    h("button", {
      type: "button",
      class: "icon-only",
      "aria-label": name,
      title: name,
      text,
      on: { click: act },
    });
  const fitting = button("", "Show the whole picture", fit);
  fitting.append(icon("fit"));
  return h(
    "div",
    { class: "video-zoom", role: "group", "aria-label": "Zoom" },
    button("−", "Zoom out", further),
    button("+", "Zoom in", closer),
    fitting,
  );
}

/** All ways to look at another part of the picture: buttons, pointer and keys. */
function mountControls(frame, { pan, zoom, fit, hover, click }) {
  const middle = () => ({ x: frame.clientWidth / 2, y: frame.clientHeight / 2 });
  const closer = () => zoom(STEP, middle());
  const further = () => zoom(1 / STEP, middle());
  frame.append(zoomButtons({ closer, further, fit }));
  mountPointer(frame, { pan, zoom, hover, click });
  mountKeys(frame, { closer, further, fit, pan });
}

const newImage = () => Object.assign(new Image(), { className: "video-image", alt: "", draggable: false });

/**
 * Puts a new picture in the old one's place once it can be drawn, so that nothing flickers.
 * @param {(image: HTMLImageElement, size: {width: number, height: number}) => void} replace
 * @returns {(source: Blob|string, size?: number[]) => Promise<boolean>} resolves to whether it is the newest
 */
function mountImage(replace) {
  let [requested, shown] = [0, null];
  return async (source, size) => {
    const number = ++requested;
    const url = source instanceof Blob ? URL.createObjectURL(source) : source;
    const forget = () => {
      if (url !== source) URL.revokeObjectURL(url);
    };
    const next = newImage();
    next.src = url;
    try {
      await next.decode();
    } catch {
      forget();
      throw new Error("The browser cannot show the picture.");
    }
    if (number < requested) {
      forget();
      return false;
    }
    replace(
      next,
      size ? { width: size[0], height: size[1] } : { width: next.naturalWidth, height: next.naturalHeight },
    );
    shown?.();
    shown = forget;
    return true;
  };
}

/** The picture with the drawings and points over it, in a frame; `draw` places them as a view says. */
function pictureFrame(name) {
  let image = newImage();
  const drawing = svg("g");
  const overlay = svg("svg", { class: "video-overlay", "aria-hidden": "true" }, drawing);
  const layer = h("div", { class: "video-layer" });
  const element = h(
    "div",
    {
      class: "video-frame",
      role: "group",
      tabindex: "0",
      "aria-label": name,
      data: { keys: "", arrows: "" },
      "aria-description": KEYS_HELP,
    },
    image,
    overlay,
    layer,
  );
  return {
    element,
    drawing,
    layer,
    get image() {
      return image;
    },
    replace(next) {
      image.replaceWith(next);
      image = next;
    },
    draw({ scale, x, y }) {
      image.style.transform = `translate(${x}px, ${y}px) scale(${scale})`;
      image.toggleAttribute("data-close", scale >= 4);
      drawing.setAttribute("transform", `translate(${x + scale / 2} ${y + scale / 2}) scale(${scale})`);
    },
  };
}

/**
 * Builds the view. Places are in the picture's pixels as cameras count: 0, 0 is the first pixel's middle.
 * @param {string} name of the picture, for assistive tools
 * @returns {Record<string, any>} `element`; `show(blob or address, size)`, where the size in px is told if
 *   the picture comes smaller; `drawing`, an SVG group in the picture's pixels; `layer` for points over it;
 *   `size`; `toScreen(place)`; `toPlace(screen)`; `onView(act)` after each change of scale; `onClick(act)`
 *   and `onHover(act)` with the place; `reveal(place)`; `image`
 */
export function pictureView(name) {
  const frame = pictureFrame(name);
  const { element, drawing, layer } = frame;
  const { view, fit, zoom, move, toScreen, toPlace } = createView(drawn);
  const listeners = { view: [], click: [], hover: [] };
  let size = { width: 1280, height: 720 };
  const bounds = () => ({ width: element.clientWidth, height: element.clientHeight });
  /** @param {number[]} place */
  const isInside = ([x, y]) => x >= 0 && y >= 0 && x <= size.width - 1 && y <= size.height - 1;

  function drawn() {
    frame.draw(view);
    listeners.view.forEach((act) => act(view.scale));
  }
  const fitted = () => fit(bounds(), size);
  const panned = (dx, dy) => move(dx, dy, bounds(), size);
  const resized = () => (view.fitted ? fitted() : drawn());

  mountControls(element, {
    pan: panned,
    zoom: (factor, at) => zoom(factor, at, bounds(), size),
    fit: fitted,
    hover: (at) => listeners.hover.forEach((act) => act(at && isInside(toPlace(at)) ? toPlace(at) : null)),
    click: (at) => {
      if (isInside(toPlace(at))) listeners.click.forEach((act) => act(toPlace(at)));
    },
  });
  new ResizeObserver(resized).observe(element);

  return {
    element,
    drawing,
    layer,
    toScreen,
    toPlace,
    isInside,
    get image() {
      return frame.image;
    },
    get size() {
      return size;
    },
    show: mountImage((next, nextSize) => {
      if (nextSize.width !== size.width || nextSize.height !== size.height) view.fitted = true;
      size = nextSize;
      frame.replace(Object.assign(next, size));
      resized();
    }),
    onView: (act) => {
      listeners.view.push(act);
      act(view.scale);
    },
    onClick: (act) => listeners.click.push(act),
    onHover: (act) => listeners.hover.push(act),
    /** Brings a place into the frame where it is outside. */
    reveal(place) {
      const [[x, y], { width, height }] = [toScreen(place), bounds()];
      panned(clamp(x, 30, width - 30) - x, clamp(y, 30, height - 30) - y);
    },
  };
}
