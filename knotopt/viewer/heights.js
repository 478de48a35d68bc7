// The leader's height over time, beside the older cable's where it is crossed.

function makeHeights(canvas, flight, seek) {
  const margin = { left: 34, right: 12, top: 12, bottom: 20 };
  let span = 1;

  function bounds(series, crossings) {
    const values = [...series.map((p) => p[1]), ...crossings.flatMap((c) => [c.height, c.cable])];
    const low = values.reduce((a, b) => Math.min(a, b));
    const high = values.reduce((a, b) => Math.max(a, b));
    return [Math.floor((low - 0.05) * 5) / 5, Math.ceil((high + 0.05) * 5) / 5];
  }

  function axes(context, width, height, x, y, [low, high]) {
    const rise = high - low > 2 ? 1 : high - low > 0.8 ? 0.4 : 0.2;
    for (let z = Math.ceil(low / rise - 1e-9) * rise; z <= high + 1e-9; z += rise) {
      stroke(context, [[margin.left, y(z)], [width - margin.right, y(z)]], theme.grid, 1);
      label(context, z.toFixed(1), margin.left - 16, y(z), theme.quiet, 10, 400);
    }
    const wanted = span / Math.max(3, width / 90);
    const every = [1, 2, 5, 10, 20, 30, 60, 120, 300].find((s) => s >= wanted) || 600;
    for (let t = 0; t <= span; t += every) {
      label(context, `${t} s`, x(t), height - 9, theme.quiet, 10, 400);
    }
  }

  function draw(shown, time) {
    const { context, width, height } = sharp(canvas);
    const series = flight.heights(shown);
    span = flight.duration(shown) || 1;
    const limits = bounds(series, flight.data.crossings);
    const x = (t) => margin.left + (t / span) * (width - margin.left - margin.right);
    const y = (z) => margin.top + ((limits[1] - z) / (limits[1] - limits[0])) *
      (height - margin.top - margin.bottom);
    axes(context, width, height, x, y, limits);
    stroke(context, series.map(([t, z]) => [x(t), y(z)]), theme.quiet, 1);
    const flown = series.filter(([t]) => t <= time).map(([t, z]) => [x(t), y(z)]);
    stroke(context, flown, flight.colours()[flight.robots - 1], 2);
    for (const crossing of flight.data.crossings) {
      const at = flight.when(shown, crossing.time);
      if (at !== null) {
        const colour = theme[crossing.over ? "over" : "under"];
        const [u, v, w] = [x(at), y(crossing.height), y(crossing.cable)];
        stroke(context, [[u, v], [u, w]], colour, 1);
        stroke(context, [[u - 5, w], [u + 5, w]], theme.ink, 2);
        triangle(context, u, v, crossing.over, colour, at <= time);
      }
    }
    stroke(context, [[x(time), margin.top], [x(time), height - margin.bottom]], theme.accent, 1.5);
  }

  const follow = (event) => {
    const box = canvas.getBoundingClientRect();
    const share = (event.clientX - box.left - margin.left) / (box.width - margin.left - margin.right);
    seek(Math.max(0, Math.min(1, share)) * span);
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    follow(event);
  });
  canvas.addEventListener("pointermove", (event) => event.buttons && follow(event));
  return { draw };
}
