/**
 * Runs first inside the embedded Viser client (the server puts it into that page's head).
 *
 * - The client retries a lost connection only while its document has focus; a frame seldom has it.
 * - The backdrop has its colours before the page around the frame can say so.
 * - Keys pressed in the frame belong to the page around it: Escape and Space must work wherever the focus is.
 * - Without a GPU, antialiasing costs more than it shows, and so do keeping each drawing for those who read
 *   it later and laying a drawing that can be seen through over the backdrop; the backdrop is drawn with the
 *   scene there.
 * - The client's sorter of Gaussian splats, which nothing here uses, wants to evaluate text; our policy
 *   refuses that, and the refusal need not be reported.
 */
(() => {
  document.hasFocus = () => true;
  document.documentElement.dataset.theme = matchMedia("(prefers-color-scheme: dark)").matches
    ? "dark"
    : "light";

  const handOver = (event) => {
    event.stopImmediatePropagation();
    if (window.parent === window) return;
    const { KeyboardEvent } = /** @type {any} */ (window.parent);
    const copy = new KeyboardEvent(event.type, event);
    if (!window.parent.document.dispatchEvent(copy)) event.preventDefault();
  };
  for (const type of ["keydown", "keyup"]) window.addEventListener(type, handOver, { capture: true });

  window.addEventListener("unhandledrejection", (event) => {
    if (event.reason instanceof EvalError) event.preventDefault();
  });

  const software = /swiftshader|llvmpipe|softpipe|software/i;
  const rendererName = () => {
    const gl = document.createElement("canvas").getContext("webgl2");
    const info = gl?.getExtension("WEBGL_debug_renderer_info");
    const name = info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
    gl?.getExtension("WEBGL_lose_context")?.loseContext();
    return name;
  };

  let backdrop = { theme: null, bands: [] };
  const bandsNow = () => {
    const { theme } = document.documentElement.dataset;
    if (theme === backdrop.theme) return backdrop.bands;
    const style = getComputedStyle(document.documentElement);
    const ends = ["--backdrop-low", "--backdrop-high"].map((name) =>
      style
        .getPropertyValue(name)
        .match(/[0-9a-f]{2}/gi)
        ?.map((part) => parseInt(part, 16)),
    );
    if (!ends[0] || !ends[1]) return [];
    // As many as there are steps of eight bits between the two ends.
    const count = 1 + Math.max(...ends[0].map((low, part) => Math.abs(ends[1][part] - low)));
    const bands = Array.from({ length: count }, (_, band) =>
      ends[0].map((low, part) => (low + ((ends[1][part] - low) * (band + 0.5)) / count) / 255),
    );
    backdrop = { theme, bands };
    return bands;
  };

  /** Fills the canvas with the backdrop; the drawer's own state of the context stays as it was. */
  const drawBackdrop = (gl, clear) => {
    const bands = bandsNow();
    const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
    const before = gl.getParameter(gl.COLOR_CLEAR_VALUE);
    gl.enable(gl.SCISSOR_TEST);
    bands.forEach((colour, band) => {
      const [low, high] = [band, band + 1].map((edge) => Math.round((edge * height) / bands.length));
      gl.scissor(0, low, width, high - low);
      gl.clearColor(...colour, 1);
      clear.call(gl, gl.COLOR_BUFFER_BIT);
    });
    gl.disable(gl.SCISSOR_TEST);
    gl.scissor(0, 0, width, height);
    gl.clearColor(...before);
  };

  /** Makes clearing the canvas draw the backdrop. */
  const withBackdrop = (gl) => {
    if (!gl || Object.hasOwn(gl, "clear")) return gl;
    const { clear } = gl;
    gl.clear = (mask) => {
      const isCanvas =
        mask & gl.COLOR_BUFFER_BIT
        && !gl.getParameter(gl.FRAMEBUFFER_BINDING)
        && !gl.isEnabled(gl.SCISSOR_TEST);
      if (isCanvas) drawBackdrop(gl, clear);
      clear.call(gl, isCanvas ? mask & ~gl.COLOR_BUFFER_BIT : mask);
    };
    return gl;
  };

  const shared = /** @type {any} */ (window);
  shared.footfallSoftwareDrawing = software.test(rendererName());
  if (shared.footfallSoftwareDrawing) {
    const getContext = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function lean(kind, options) {
      if (!kind.startsWith("webgl")) return getContext.call(this, kind, options);
      return withBackdrop(
        getContext.call(this, kind, {
          ...options,
          alpha: false,
          antialias: false,
          preserveDrawingBuffer: false,
        }),
      );
    };
  }
})();
