// The plan view: active regions, cable, the leader's way so far, crossings that it has flown.

function makeAbove(canvas, flight) {
  const { step, size, layers, crossings } = flight.data;
  const deepest = Math.max(1, ...layers.flat());
  const shades = Math.min(deepest, 4);

  function regions(context, place) {
    layers.forEach((column, c) => column.forEach((count, r) => {
      if (count) {
        const [left, bottom] = place([c * step, r * step, 0]);
        const [right, top] = place([(c + 1) * step, (r + 1) * step, 0]);
        context.fillStyle = theme[`layer-${Math.ceil((count * shades) / deepest)}`];
        context.fillRect(left - 0.3, top - 0.3, right - left + 0.6, bottom - top + 0.6);
      }
    }));
  }

  function grid(context, place) {
    for (let i = 1; i <= size; i += 1) {
      const ends = [1, size].map((j) => j * step);
      for (const line of [[[i * step, ends[0]], [i * step, ends[1]]],
        [[ends[0], i * step], [ends[1], i * step]]]) {
        stroke(context, line.map((p) => place([...p, 0]).slice(0, 2)), theme.grid, 1);
      }
    }
  }

  function scaleBar(context, height, metres) {
    const y = height - 14;
    stroke(context, [[14, y - 4], [14, y], [14 + metres, y], [14 + metres, y - 4]], theme.quiet, 1.2);
    label(context, "1 m", 14 + metres / 2, y - 9, theme.quiet, 11, 400);
  }

  // Smaller and without its number where others are close.
  function robot(context, places, index, colour) {
    const leader = index === flight.robots - 1;
    const [x, y] = places[index];
    const nearest = Math.min(...places.map((p, i) =>
      (i === index ? Infinity : Math.hypot(p[0] - x, p[1] - y))));
    const radius = Math.max(3.5, Math.min(8, nearest / 2));
    context.fillStyle = colour;
    context.strokeStyle = leader ? theme.ink : theme.panel;
    context.lineWidth = leader ? 2 : 1;
    context.beginPath();
    if (leader) {
      const tip = radius + 2;
      [[0, -tip], [tip, 0], [0, tip], [-tip, 0]].forEach(([dx, dy], i) =>
        (i ? context.lineTo(x + dx, y + dy) : context.moveTo(x + dx, y + dy)));
      context.closePath();
    } else {
      context.arc(x, y, radius, 0, 2 * Math.PI);
    }
    context.fill();
    context.stroke();
    if (radius > 6) {
      context.font = "700 10px system-ui, sans-serif";
      context.fillStyle = textOn(colour);
      context.fillText(index + 1, x, y + 0.5);
    }
  }

  function marks(context, place, clock) {
    const labels = [];
    for (const crossing of crossings) {
      const flown = crossing.time <= clock;
      const [x, y] = place([...crossing.place, 0]);
      const colour = theme[crossing.over ? "over" : "under"];
      triangle(context, x, y, crossing.over, colour, flown);
      if (flown) {
        labels.push({ text: `${crossing.over ? "over" : "under"} ${crossing.older}`, x, y, colour });
      }
    }
    return labels;
  }

  function draw(state, options) {
    const { context, width, height } = sharp(canvas);
    const low = [0, 1].map((k) => Math.min(state.box[0][k], 0.5 * step));
    const high = [0, 1].map((k) => Math.max(state.box[1][k], (size + 0.5) * step));
    const scale = Math.min((width - 28) / (high[0] - low[0]), (height - 44) / (high[1] - low[1]));
    const place = ([x, y, z]) => [
      width / 2 + scale * (x - (low[0] + high[0]) / 2),
      height / 2 - 8 - scale * (y - (low[1] + high[1]) / 2), -z,
    ];
    const colours = flight.colours();
    regions(context, place);
    grid(context, place);
    const flat = (points) => points.map((p) => place(p).slice(0, 2));
    if (options.route) {
      context.setLineDash([1, 5]);
      stroke(context, flat(flight.route), theme.quiet, 1);
      context.setLineDash([]);
    }
    if (options.planned && state.planned) {
      context.setLineDash([5, 4]);
      state.plannedCable.forEach(({ points }) => stroke(context, flat(points), theme.quiet, 1.2));
      context.setLineDash([]);
    }
    drawFarToNear(context, cablePieces(state.cable, place, 2.4));
    if (options.route) {
      stroke(context, flat(state.track), colours[flight.robots - 1], 1.2);
    }
    const places = state.robots.map(place);
    const labels = marks(context, place, state.clock);
    places.forEach((_, i) => robot(context, places, i, colours[i]));
    placeLabels(context, labels, places);
    scaleBar(context, height, scale);
  }

  return { draw, shades, deepest };
}

function triangle(context, x, y, up, colour, filled) {
  const tip = up ? -5 : 5;
  context.beginPath();
  context.moveTo(x, y + tip);
  context.lineTo(x + 5, y - 0.8 * tip);
  context.lineTo(x - 5, y - 0.8 * tip);
  context.closePath();
  context.fillStyle = filled ? colour : theme.panel;
  context.fill();
  context.strokeStyle = colour;
  context.lineWidth = 1.3;
  context.stroke();
}
