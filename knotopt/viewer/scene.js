// Robots and cable in space: perspective, turned and zoomed by mouse, finger and keys.

const NEAR = 2.2; // distance of the eye over the diagonal of what it looks at
const VIEWS = { oblique: [-0.45, 0.62], top: [0, Math.PI / 2], side: [0, 0.04] };

function makeScene(canvas, flight, redraw) {
  const camera = { yaw: 0, pitch: 0, zoom: 1 };

  function view(name) {
    [camera.yaw, camera.pitch] = VIEWS[name];
    camera.zoom = 1;
    redraw();
  }

  // A point in space to [x, y, depth, pixels per metre] on the picture, which a box just fills;
  // null behind the eye.
  function projection(width, height, [low, high]) {
    const [cy, sy] = [Math.cos(camera.yaw), Math.sin(camera.yaw)];
    const [cp, sp] = [Math.cos(camera.pitch), Math.sin(camera.pitch)];
    const centre = low.map((value, k) => (value + high[k]) / 2);
    const distance = NEAR * Math.hypot(...low.map((value, k) => high[k] - value));
    const flat = (point) => {
      const [x, y, z] = point.map((value, k) => value - centre[k]);
      const away = y * cy - x * sy;
      const depth = distance + away * cp - z * sp;
      return [(x * cy + y * sy) / depth, (z * cp + away * sp) / depth, depth];
    };
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((bits) =>
      flat(low.map((value, k) => ((bits >> k) & 1 ? high[k] : value))));
    const [[left, right], [bottom, top]] = [0, 1].map((k) =>
      [Math.min, Math.max].map((pick) => pick(...corners.map((corner) => corner[k]))));
    const scale = Math.min((width - 40) / (right - left), (height - 56) / (top - bottom))
      / camera.zoom;
    return (point) => {
      const [x, y, depth] = flat(point);
      return depth < 0.1 ? null : [
        width / 2 + scale * (x - (left + right) / 2),
        height / 2 + 10 - scale * (y - (bottom + top) / 2), depth, scale / depth,
      ];
    };
  }

  function ground(context, project, [low, high]) {
    const { step } = flight.data;
    const first = low.map((v) => Math.floor(v / step));
    const last = high.map((v) => Math.ceil(v / step));
    for (let axis = 0; axis < 2; axis += 1) {
      for (let i = first[axis]; i <= last[axis]; i += 1) {
        const ends = [first[1 - axis], last[1 - axis]].map((j) => {
          const point = axis ? [j * step, i * step, 0] : [i * step, j * step, 0];
          return project(point);
        });
        if (ends[0] && ends[1]) {
          stroke(context, ends.map((p) => p.slice(0, 2)), theme.grid, 1);
        }
      }
    }
  }

  function shadow(context, strands, project) {
    for (const { points } of strands) {
      const below = points.map((p) => project([p[0], p[1], 0])).filter(Boolean);
      stroke(context, below.map((p) => p.slice(0, 2)), theme.shadow, 1.5);
    }
  }

  function robot(position, index, colour, project) {
    const seen = project(position);
    if (!seen) {
      return null;
    }
    const leader = index === flight.robots - 1;
    const arm = Math.min(0.16, Math.max(0.07, 8 / seen[3])) * (leader ? 1.25 : 1);
    return {
      depth: seen[2] - 0.02,
      draw: (context) => {
        const foot = project([position[0], position[1], 0]);
        if (foot) {
          context.globalAlpha = 0.35;
          stroke(context, [seen.slice(0, 2), foot.slice(0, 2)], colour, 1);
          context.globalAlpha = 1;
        }
        for (const turn of [1, 3, 5, 7]) {
          const at = [Math.cos, Math.sin].map((f, k) => position[k] + arm * f((turn * Math.PI) / 4));
          const hub = project([...at, position[2]]);
          if (hub) {
            stroke(context, [seen.slice(0, 2), hub.slice(0, 2)], colour, 2.5);
            rotor(context, at, position[2], arm * 0.62, colour, project);
          }
        }
        context.fillStyle = leader ? theme.ink : colour;
        context.beginPath();
        context.arc(seen[0], seen[1], leader ? 4 : 3, 0, 2 * Math.PI);
        context.fill();
      },
      text: leader ? `${index + 1} leader` : `${index + 1}`,
      at: [seen[0], seen[1] - seen[3] * arm - 9],
    };
  }

  // Numbers, the leader's first, each where none is yet.
  function numbers(context, robots) {
    const placed = [];
    for (const { text, at } of [...robots].reverse()) {
      const half = 4 * text.length;
      const free = placed.every(([x, y, other]) =>
        Math.abs(x - at[0]) > half + other || Math.abs(y - at[1]) > 12);
      if (free) {
        label(context, text, ...at, placed.length ? theme.quiet : theme.ink);
        placed.push([...at, half]);
      }
    }
  }

  function rotor(context, at, z, radius, colour, project) {
    const rim = [];
    for (let i = 0; i < 12; i += 1) {
      const angle = (i * Math.PI) / 6;
      rim.push(project([at[0] + radius * Math.cos(angle), at[1] + radius * Math.sin(angle), z]));
    }
    if (rim.every(Boolean)) {
      context.beginPath();
      rim.forEach((p, i) => (i ? context.lineTo(p[0], p[1]) : context.moveTo(p[0], p[1])));
      context.closePath();
      context.globalAlpha = 0.3;
      context.fillStyle = colour;
      context.fill();
      context.globalAlpha = 1;
      context.lineWidth = 1.2;
      context.strokeStyle = colour;
      context.stroke();
    }
  }

  function line(context, points, project, colour, width, dash) {
    const seen = points.map(project).filter(Boolean).map((p) => p.slice(0, 2));
    context.setLineDash(dash);
    stroke(context, seen, colour, width);
    context.setLineDash([]);
  }

  function draw(state, options) {
    const { context, width, height } = sharp(canvas);
    const box = [[...state.box[0].slice(0, 2), 0], state.box[1]];
    const project = projection(width, height, box);
    const shades = flight.colours();
    ground(context, project, box);
    shadow(context, state.cable, project);
    if (options.route) {
      line(context, flight.route, project, theme.quiet, 1, [1, 5]);
      line(context, state.track, project, shades[flight.robots - 1], 1, []);
    }
    if (options.planned && state.planned) {
      for (const { points } of state.plannedCable) {
        line(context, points, project, theme.quiet, 1.2, [5, 4]);
      }
      for (const seen of state.planned.map(project).filter(Boolean)) {
        context.beginPath();
        context.arc(seen[0], seen[1], 6, 0, 2 * Math.PI);
        context.lineWidth = 1.2;
        context.strokeStyle = theme.quiet;
        context.stroke();
      }
    }
    const things = cablePieces(state.cable, project, 2.6);
    const robots = state.robots.map((position, i) => robot(position, i, shades[i], project))
      .filter(Boolean);
    drawFarToNear(context, [...things, ...robots]);
    numbers(context, robots);
  }

  function turn(yaw, pitch) {
    camera.yaw += yaw;
    camera.pitch = Math.max(0.02, Math.min(Math.PI / 2, camera.pitch + pitch));
    redraw();
  }

  function zoom(factor) {
    camera.zoom = Math.max(0.15, Math.min(3, camera.zoom * factor));
    redraw();
  }

  steer(canvas, turn, zoom, () => view("oblique"));
  [camera.yaw, camera.pitch] = VIEWS.oblique;
  return { draw, view, zoom, camera };
}

function steer(canvas, turn, zoom, reset) {
  const held = new Map();
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held.set(event.pointerId, [event.clientX, event.clientY]);
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = held.get(event.pointerId);
    if (!before) {
      return;
    }
    const now = [event.clientX, event.clientY];
    if (held.size === 1) {
      turn((before[0] - now[0]) * 0.008, (now[1] - before[1]) * 0.008);
    } else {
      const other = [...held].find(([id]) => id !== event.pointerId)[1];
      const apart = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
      zoom(apart(before) / Math.max(apart(now), 1));
    }
    held.set(event.pointerId, now);
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, (event) => held.delete(event.pointerId));
  }
  canvas.addEventListener("wheel", (event) => {
    // Without focus the wheel scrolls the page.
    if (event.ctrlKey || document.activeElement === canvas) {
      event.preventDefault();
      zoom(Math.exp(event.deltaY * 0.0012));
    }
  }, { passive: false });
  const keys = {
    ArrowLeft: () => turn(0.08, 0), ArrowRight: () => turn(-0.08, 0),
    ArrowUp: () => turn(0, 0.06), ArrowDown: () => turn(0, -0.06),
    "+": () => zoom(0.85), "=": () => zoom(0.85), "-": () => zoom(1.18), 0: reset,
  };
  canvas.addEventListener("keydown", (event) => {
    if (Object.hasOwn(keys, event.key)) {
      event.preventDefault();
      keys[event.key]();
    }
  });
}
