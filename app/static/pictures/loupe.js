/** A round loupe at a place of a picture: shows it six times as large, with a cross. */

import { h } from "../lib/dom.js";

const SIZE = 116;
const TIMES = 6;
const AWAY = 22;

/**
 * Builds the loupe over a picture.
 * @param {object} picture of `pictureView`
 * @returns {{show: (place: number[]|null) => void}} null hides it
 */
export function loupe(picture) {
  const canvas = h("canvas", { class: "video-loupe", width: SIZE, height: SIZE, "aria-hidden": "true", hidden: true });
  const pen = canvas.getContext("2d");
  picture.element.append(canvas);

  function draw([x, y]) {
    const side = SIZE / TIMES;
    pen.imageSmoothingEnabled = false;
    pen.fillStyle = "#808080";
    pen.fillRect(0, 0, SIZE, SIZE);
    const shown = picture.image.naturalWidth / picture.size.width;
    pen.drawImage(picture.image, ...[x + 0.5 - side / 2, y + 0.5 - side / 2, side, side].map((value) => value * shown), 0, 0, SIZE, SIZE);
    const middle = SIZE / 2 + 0.5;
    for (const [color, width] of [["#000", 3], ["#fff", 1]]) {
      pen.strokeStyle = color;
      pen.lineWidth = width;
      pen.beginPath();
      pen.moveTo(middle, 8);
      pen.lineTo(middle, middle - 5);
      pen.moveTo(middle, middle + 5);
      pen.lineTo(middle, SIZE - 8);
      pen.moveTo(8, middle);
      pen.lineTo(middle - 5, middle);
      pen.moveTo(middle + 5, middle);
      pen.lineTo(SIZE - 8, middle);
      pen.stroke();
    }
  }

  return {
    show(place) {
      canvas.hidden = !place || !picture.image.complete || !picture.image.naturalWidth;
      if (canvas.hidden) return;
      draw(place);
      const [x, y] = picture.toScreen(place);
      const { clientWidth: width } = picture.element;
      const left = x + AWAY + SIZE > width ? x - AWAY - SIZE : x + AWAY;
      const top = y - AWAY - SIZE < 0 ? y + AWAY : y - AWAY - SIZE;
      canvas.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`;
    },
  };
}
