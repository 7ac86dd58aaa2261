// The robot at a moment: state between two knots, and its parts from the floor upwards.
const robot = data.robot;
const FLOOR = -robot.sole_depth;
const LEGS = data.colours.length;
const last = data.times.length - 1;
const PLATE = "#e4e8ee";
const MOTOR = "#4a5463";
const ROD = "#b9c2ce";
const BOARD = "#2f6f5e";

/** Index of the knot at or before a time, and the part of the way to the next one. */
function place(time) {
  let [low, high] = [0, last];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (data.times[middle] <= time) low = middle;
    else high = middle;
  }
  const part = (time - data.times[low]) / (data.times[high] - data.times[low]);
  return { knot: low, next: high, part: Math.min(Math.max(part, 0), 1) };
}

function between(a, b, part) {
  if (a === null || b === null) return null;
  return Array.isArray(a) ? a.map((value, i) => between(value, b[i], part)) : mix(a, b, part);
}

function stateAt(time) {
  const { knot, next, part } = place(time);
  const of = (rows) => between(rows[knot], rows[next], part);
  const shown = part < 1 ? knot : next;
  return {
    shown,
    body: of(data.body),
    heading: of(data.heading),
    feet: of(data.feet),
    strokes: of(data.strokes),
    contact: data.contact[shown],
    margin: of(data.margins),
  };
}

function robotPoint(state, x, y) {
  const [c, s] = [Math.cos(state.heading), Math.sin(state.heading)];
  return [state.body[0] + c * x - s * y, state.body[1] + s * x + c * y];
}

function turned(state, direction) {
  const [c, s] = [Math.cos(state.heading), Math.sin(state.heading)];
  return [c * direction[0] - s * direction[1], s * direction[0] + c * direction[1]];
}

/** Paints parts in one layer, the farthest from the eye first. */
function paintSorted(parts) {
  for (const part of parts) part.depth = project(part.at)[2];
  parts.sort((a, b) => b.depth - a.depth);
  for (const part of parts) part.paint();
}

function legParts(state, leg) {
  const foot = state.feet[leg];
  const colour = data.colours[leg];
  const parts = [{ at: foot, paint: () => paintFoot(foot, colour, state.heading) }];
  robot.directions[leg].forEach((direction, motor) => {
    const stroke = state.strokes[leg][motor];
    const [cx, cy] = robot.centres[leg];
    const base = robotPoint(
      state,
      cx + robot.base_radius * direction[0],
      cy + robot.base_radius * direction[1],
    );
    const out = turned(state, direction);
    const end = [foot[0] + robot.platform_radius * out[0], foot[1] + robot.platform_radius * out[1], foot[2]];
    const knee = [...base, state.body[2] - (stroke ?? 0)];
    parts.push({
      at: [...base, state.body[2]],
      paint: () => bar([...base, state.body[2] + robot.plate_heights[0]], knee, robot.rod_diameter, ROD),
    });
    parts.push({
      at: between(knee, end, 0.5),
      paint: () => paintLink(knee, end, out, stroke === null ? palette.bad : colour),
    });
  });
  return parts;
}

/** The parallelogram that keeps the platform level: two rods with a bar at either end. */
function paintLink(knee, end, out, colour) {
  const half = robot.rod_spacing / 2;
  const side = (point, sign) => [point[0] - sign * half * out[1], point[1] + sign * half * out[0], point[2]];
  const shade = blended(colour, "#f4f6f9", 0.35);
  bar(side(end, -1), side(end, 1), robot.rod_diameter * 0.55, shade);
  for (const sign of [-1, 1]) bar(side(knee, sign), side(end, sign), robot.rod_diameter * 0.6, shade);
  bar(side(knee, -1), side(knee, 1), robot.rod_diameter * 0.7, ROD);
}

function paintFoot(foot, colour, heading) {
  const sole = foot[2] - robot.sole_depth;
  prism(circle(foot, robot.sole_diameter / 2), sole, sole + robot.sole_depth * 0.4, colour);
  prism(
    circle(foot, robot.foot_diameter / 2, 14),
    sole + robot.sole_depth * 0.4,
    foot[2],
    blended(colour, "#ffffff", 0.25),
  );
  prism(circle(foot, robot.platform_radius + 0.006, 6, heading), foot[2] - 0.001, foot[2] + 0.002, PLATE);
}

function plateOutline(state) {
  const corner = robot.plate_across / 2 / Math.cos(Math.PI / 8);
  return circle([0, 0], corner, 8, Math.PI / 8).map(([x, y]) => robotPoint(state, x, y));
}

function motorOutline(state, leg, direction) {
  const [cx, cy] = robot.centres[leg];
  const [x, y] = [cx + robot.base_radius * direction[0], cy + robot.base_radius * direction[1]];
  const half = robot.motor_width / 2;
  const [u, v] = [direction, [-direction[1], direction[0]]];
  return [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ].map(([a, b]) => robotPoint(state, x + half * (a * u[0] + b * v[0]), y + half * (a * u[1] + b * v[1])));
}

function motors(state, low, high) {
  const parts = [];
  robot.directions.forEach((directions, leg) =>
    directions.forEach((direction) => {
      const corners = motorOutline(state, leg, direction);
      parts.push({
        at: [...corners[0], low],
        paint: () => prism(corners, state.body[2] + low, state.body[2] + high, MOTOR),
      });
    }),
  );
  return parts;
}

/** The robot from the floor upwards: whatever lies higher hides what is below it from an eye above. */
function paintRobot(state) {
  const [lower, upper] = robot.plate_heights;
  const [z, thick] = [state.body[2], robot.plate_thickness];
  const plate = plateOutline(state);
  paintSorted(Array.from({ length: LEGS }, (_, leg) => legParts(state, leg)).flat());
  if (!camera.showsBody) {
    const edge = plate.map((point) => [...point, z + lower]);
    line([...edge, edge[0]], palette.quiet, 1.5, 0.8, [6, 4]);
    return;
  }
  prism(plate, z + lower, z + lower + thick, PLATE);
  paintSorted(motors(state, lower + thick, upper));
  prism(plate, z + upper, z + upper + thick, PLATE);
  paintSorted(motors(state, upper + thick, robot.motor_length));
  const [a, b] = [robot.board[0] / 2, robot.board[1] / 2];
  const board = [
    [-a, -b],
    [a, -b],
    [a, b],
    [-a, b],
  ].map(([x, y]) => robotPoint(state, x, y));
  prism(board, z + robot.board_height, z + robot.board_height + robot.board[2], BOARD);
}
