/**
 * Runs first inside the embedded Viser client (the server puts it into that page's head).
 *
 * - The client retries a lost connection only while its document has focus; a frame seldom has it.
 * - The backdrop has its colours before the page around the frame can say so.
 * - Keys pressed in the frame belong to the page around it: Escape and Space must work wherever the focus is.
 * - Without a GPU, antialiasing costs more than it shows, and so does keeping each drawing for those who read it later.
 * - The client's sorter of Gaussian splats, which nothing here uses, wants to evaluate text; our policy refuses
 *   that, and the refusal need not be reported.
 */
(() => {
  document.hasFocus = () => true;
  document.documentElement.dataset.theme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";

  const handOver = (event) => {
    event.stopImmediatePropagation();
    if (window.parent === window) return;
    const copy = new window.parent.KeyboardEvent(event.type, event);
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
  window.footfallSoftwareDrawing = software.test(rendererName());
  if (window.footfallSoftwareDrawing) {
    const getContext = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function lean(kind, options) {
      return getContext.call(this, kind, kind.startsWith("webgl") ? { ...options, antialias: false, preserveDrawingBuffer: false } : options);
    };
  }
})();
