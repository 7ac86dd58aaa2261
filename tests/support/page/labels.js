() => {
  const near = 1.5;
  const isOpaque = (element) => {
    const { backgroundColor, opacity } = getComputedStyle(element);
    const alpha = backgroundColor.startsWith("rgba") ? Number(backgroundColor.split(",")[3].replace(")", "")) : backgroundColor === "transparent" ? 0 : 1;
    return alpha > 0.8 && Number(opacity) > 0.8;
  };
  const isShown = (element) => element.checkVisibility({ opacityProperty: true, visibilityProperty: true })
    && !element.closest(".hidden-text, .sprite, iframe, [data-user-text]");
  // A ruler lets its labels stand out a little.
  const grown = (one) => {
    const { left, right, top, bottom } = one.getBoundingClientRect();
    const style = getComputedStyle(one);
    const by = style.overflowX === "clip" ? parseFloat(style.overflowClipMargin) || 0 : 0;
    return { left: left - by, right: right + by, top: top - by, bottom: bottom + by };
  };
  const cutBy = (element) => {
    // What may hide a part of an element: every ancestor that clips, with how.
    const found = [];
    for (let one = element; one && one !== document.body; one = one.parentElement) {
      const { overflowX, overflowY, position } = getComputedStyle(one);
      if (overflowX !== "visible" || overflowY !== "visible") found.push({ box: grown(one), scrolls: /auto|scroll/.test(overflowX + overflowY), one });
      if (position === "fixed") break;
    }
    return found;
  };
  const texts = [];
  const problems = [];
  const name = (text) => text.trim().replace(/\s+/g, " ").slice(0, 60);
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const element = node.parentElement;
    if (!node.data.trim() || !element || ["SCRIPT", "STYLE", "OPTION", "TEMPLATE", "TEXTAREA"].includes(element.tagName) || !isShown(element)) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    for (const rect of range.getClientRects()) {
      if (rect.width < 1 || rect.height < 1) continue;
      let box = { left: rect.left, right: rect.right, top: rect.top, bottom: rect.bottom };
      let isAway = false;
      for (const { box: clip, scrolls } of cutBy(element)) {
        const over = box.left < clip.left - near || box.right > clip.right + near || box.top < clip.top - 3 || box.bottom > clip.bottom + 3;
        const out = box.right <= clip.left + 1 || box.left >= clip.right - 1 || box.bottom <= clip.top + 1 || box.top >= clip.bottom - 1;
        if (out) { isAway = true; break; }
        if (over && !scrolls && !element.closest("[aria-hidden]")) { problems.push(`cut: ${name(node.data)}`); break; }
        box = { left: Math.max(box.left, clip.left), right: Math.min(box.right, clip.right), top: Math.max(box.top, clip.top), bottom: Math.min(box.bottom, clip.bottom) };
      }
      if (isAway || box.right - box.left < 1 || box.bottom - box.top < 1) continue;
      if (rect.right > innerWidth + near || rect.bottom > innerHeight + near || rect.left < -near || rect.top < -near) {
        if (!cutBy(element).some(({ scrolls }) => scrolls)) problems.push(`out of the window: ${name(node.data)}`);
      }
      // Letters are lower than their line.
      const high = (box.bottom - box.top) * 0.2;
      texts.push({ element, text: node.data, box: { ...box, top: box.top + high, bottom: box.bottom - high } });
    }
  }
  for (const input of document.querySelectorAll("input:not([type=checkbox]):not([type=range]):not([type=file])")) {
    if (isShown(input) && input.value && input.id !== "gait-name" && input.scrollWidth > input.clientWidth + 1) problems.push(`cut: ${input.getAttribute("aria-label")} with “${input.value}”`);
  }
  const pen = document.createElement("canvas").getContext("2d");
  for (const select of document.querySelectorAll("select")) {
    if (!isShown(select) || !select.selectedOptions.length) continue;
    const style = getComputedStyle(select);
    pen.font = style.font;
    // The arrow takes its share beside the padding.
    const room = select.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight) - 16;
    if (pen.measureText(select.selectedOptions[0].text).width > room + near) problems.push(`cut: ${select.getAttribute("aria-label")} with “${select.selectedOptions[0].text}”`);
  }
  const covers = (element, other, box) => {
    for (let one = element; one && !one.contains(other); one = one.parentElement) {
      const own = one.getBoundingClientRect();
      if (isOpaque(one) && own.left <= box.left + 1 && own.right >= box.right - 1 && own.top <= box.top + 1 && own.bottom >= box.bottom - 1) return true;
    }
    return false;
  };
  texts.sort((a, b) => a.box.left - b.box.left);
  texts.forEach((a, index) => {
    for (let at = index + 1; at < texts.length && texts[at].box.left < a.box.right - near; at += 1) {
      const b = texts[at];
      if (a.element === b.element || a.box.bottom - near <= b.box.top || b.box.bottom - near <= a.box.top) continue;
      const shared = { left: b.box.left, right: Math.min(a.box.right, b.box.right), top: Math.max(a.box.top, b.box.top), bottom: Math.min(a.box.bottom, b.box.bottom) };
      if (covers(a.element, b.element, shared) || covers(b.element, a.element, shared)) continue;
      problems.push(`overlap: ${name(a.text)} | ${name(b.text)}`);
    }
  });
  return [...new Set(problems)];
}
