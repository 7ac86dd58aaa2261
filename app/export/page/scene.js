// What lies on the floor and in the air around the robot: grid, shadows, support polygon, traces, names.
const CELL = 0.02;
const NEAREST = 0.32; // from where the robot is seen from sole to board, m
const NEAR_EDGE = 0.005; // a margin below this is shown in the colour of caution, m

function extent() {
  const xs = data.body.map((point) => point[0]);
  const ys = data.body.map((point) => point[1]);
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  return {
    centre: [(x0 + x1) / 2, (y0 + y1) / 2],
    radius: Math.hypot(x1 - x0, y1 - y0) / 2 + robot.plate_across / 2,
  };
}

const world = extent();

function homeView() {
  camera.yaw = Math.atan2(-1, 0.42);
  camera.pitch = 0.36;
  camera.target = [...world.centre, 0.034];
  camera.distance = Math.max(3.6 * world.radius, NEAREST);
}

function paintFloor(width, height) {
  const backdrop = pen.createLinearGradient(0, 0, 0, height);
  backdrop.addColorStop(0, palette.sky);
  backdrop.addColorStop(0.75, palette.ground);
  pen.fillStyle = backdrop;
  pen.fillRect(0, 0, width, height);
  pen.strokeStyle = palette.grid;
  pen.lineWidth = 1;
  for (const [alpha, pieces] of GRID) {
    pen.globalAlpha = alpha;
    pen.beginPath();
    for (const [a, b] of pieces) {
      const [p, q] = [project(a), project(b)];
      pen.moveTo(p[0], p[1]);
      pen.lineTo(q[0], q[1]);
    }
    pen.stroke();
  }
  pen.globalAlpha = 1;
}

/** Lines of the floor, cell by cell: groups that are painted equally faint, fainter outwards. */
function gridPieces() {
  const cells = Math.ceil((world.radius * 2.6) / CELL);
  const [cx, cy] = world.centre.map((part) => Math.round(part / CELL) * CELL);
  const groups = new Map();
  const add = (i, j, towards) => {
    const [a, b] = [
      [cx + i * CELL, cy + j * CELL, FLOOR],
      [cx + towards[0] * CELL, cy + towards[1] * CELL, FLOOR],
    ];
    const radius = Math.hypot(i + towards[0], j + towards[1]) / 2 / cells;
    const alpha = Math.round(8 * (1 - Math.min(radius, 1) ** 2)) / 8;
    if (alpha > 0) groups.set(alpha, [...(groups.get(alpha) ?? []), [a, b]]);
  };
  for (let i = -cells; i <= cells; i += 1) {
    for (let j = -cells; j < cells; j += 1) {
      add(i, j, [i, j + 1]);
      add(j, i, [j + 1, i]);
    }
  }
  return [...groups];
}

const GRID = gridPieces();

function paintShadows(state) {
  const plate = plateOutline(state);
  const middle = [state.body[0], state.body[1]];
  for (let grow = 1.14; grow > 0.8; grow -= 0.05) {
    fillFace(
      plate.map(([x, y]) => [mix(middle[0], x, grow), mix(middle[1], y, grow), FLOOR]),
      "#0b1018",
      null,
      0.018,
    );
  }
  for (const foot of state.feet) {
    const spread = 1 + Math.max(foot[2], 0) * 40;
    for (const grow of [1.5, 1.2]) {
      const ring = circle(foot, (robot.sole_diameter / 2) * grow * spread).map((point) => [...point, FLOOR]);
      fillFace(ring, "#0b1018", null, 0.09 / spread);
    }
  }
}

/** Corners of the convex hull, counter-clockwise. */
function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (ordered) => {
    const chain = [];
    for (const point of ordered) {
      while (chain.length > 1) {
        const [a, b] = chain.slice(-2);
        if ((b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]) > 0) break;
        chain.pop();
      }
      chain.push(point);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

function toneOf(margin) {
  if (margin === null || margin < 0) return palette.bad;
  return margin < NEAR_EDGE ? palette.caution : palette.good;
}

function paintSupport(state) {
  const standing = state.feet.filter((_, leg) => state.contact[leg]).map((foot) => [foot[0], foot[1]]);
  const tone = toneOf(state.margin);
  const corners = hull(standing).map((point) => [...point, FLOOR]);
  if (corners.length > 2) fillFace(corners, tone, null, 0.16);
  if (corners.length > 1) line([...corners, corners[0]], tone, 1.6, 0.9);
}

function paintTraces(state, time) {
  const upTo = place(time).knot + 1;
  data.colours.forEach((colour, leg) => {
    const path = data.feet.map((feet) => [feet[leg][0], feet[leg][1], feet[leg][2] + FLOOR]);
    const now = [...state.feet[leg]];
    now[2] += FLOOR;
    line(path, colour, 1.4, 0.35, [3, 3]);
    line([...path.slice(0, upTo), now], colour, 2.2, 0.95);
  });
  const middle = data.body.map((body) => [body[0], body[1], FLOOR]);
  line(middle, palette.ink, 1.2, 0.35, [3, 3]);
  line([...middle.slice(0, upTo), [state.body[0], state.body[1], FLOOR]], palette.ink, 2, 0.9);
}

function paintCentre(state) {
  const ring = circle(state.body, 0.003).map((point) => [...point, FLOOR]);
  fillFace(ring, palette.panel, palette.ink);
  fillFace(
    circle(state.body, 0.0016).map((point) => [...point, FLOOR]),
    palette.ink,
  );
}

/** Whether a place on the canvas lies on the picture of a plate, which hides what is below it. */
function behindPlate(state, x, y) {
  return robot.plate_heights.some((height) => {
    const corners = plateOutline(state).map((point) => project([...point, state.body[2] + height]));
    return corners.every(([ax, ay], i) => {
      const [bx, by] = corners[(i + 1) % corners.length];
      return (bx - ax) * (y - ay) - (by - ay) * (x - ax) <= 0;
    });
  });
}

function paintNames(state) {
  pen.font = "650 13px system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  state.feet.forEach((foot, leg) => {
    const away = unit([foot[0] - state.body[0], foot[1] - state.body[1], 0]);
    const [x, y] = project([foot[0] + away[0] * 0.028, foot[1] + away[1] * 0.028, foot[2] + FLOOR]);
    if (camera.showsBody && behindPlate(state, x, y)) return;
    const role = data.roles[leg] === String(leg + 1) ? "" : ` ${data.roles[leg]}`;
    const words = `${leg + 1}${role}${state.contact[leg] ? "" : " ↑"}`;
    pen.lineWidth = 4;
    pen.lineJoin = "round";
    pen.strokeStyle = palette.panel;
    pen.strokeText(words, x, y);
    pen.fillStyle = palette.ink;
    pen.fillText(words, x, y);
  });
}

function paint(time) {
  const ratio = window.devicePixelRatio || 1;
  const { clientWidth: width, clientHeight: height } = canvas;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  pen.save(); // every picture begins with the same pen, so that the same moment is the same picture
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  aim(width, height);
  const state = stateAt(time);
  paintFloor(width, height);
  paintShadows(state);
  paintSupport(state);
  paintTraces(state, time);
  paintCentre(state);
  paintRobot(state);
  paintNames(state);
  pen.restore();
  return state;
}
