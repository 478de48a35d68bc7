// Time: slider, play button, keys; and everything that follows it.

const find = (id) => document.getElementById(id);

async function start() {
  const flight = await readFlight();
  const now = { time: 0, shown: flight.records.length ? 0 : -1, playing: false, last: 0 };
  let waiting = false;

  function redraw() {
    if (!waiting) {
      waiting = true;
      requestAnimationFrame(draw);
    }
  }

  const scene = makeScene(find("scene"), flight, redraw);
  const above = makeAbove(find("above"), flight);
  const heights = makeHeights(find("heights"), flight, (time) => seek(time));

  function draw(stamp) {
    waiting = false;
    if (now.playing) {
      now.time += ((stamp - now.last) / 1000) * Number(find("speed").value);
      now.last = stamp;
      if (now.time >= flight.duration(now.shown)) {
        now.time = flight.duration(now.shown);
        play(false);
      }
      find("time").value = now.time;
    }
    const state = flight.at(now.shown, now.time);
    const options = { planned: find("planned-too").checked, route: find("route-too").checked };
    scene.draw(state, options);
    above.draw(state, options);
    heights.draw(now.shown, now.time);
    report(state);
    if (now.playing) {
      redraw();
    }
  }

  function report(state) {
    const total = flight.duration(now.shown);
    find("clock").value = `${now.time.toFixed(1)} / ${total.toFixed(1)} s`;
    const { crossings } = flight.data;
    const flown = crossings.filter((crossing) => crossing.time <= state.clock).length;
    const words = [];
    if (now.shown >= 0) {
      words.push(`${state.clock.toFixed(1)} s of the plan`);
    }
    if (crossings.length) {
      words.push(`${flown} of ${crossings.length} crossings due`);
    }
    if (flown) {
      words.push(`last: ${crossings[flown - 1].name}`);
    }
    find("status").textContent = words.join(" · ");
    find("time").setAttribute("aria-valuetext",
      [`${now.time.toFixed(1)} seconds of ${total.toFixed(1)}`, ...words].join(", "));
    document.querySelectorAll(".go").forEach((button, i) =>
      button.closest("tr").classList.toggle("now", i === flown - 1));
  }

  function play(on) {
    now.playing = on;
    if (on && now.time >= flight.duration(now.shown)) {
      now.time = 0;
    }
    now.last = performance.now();
    find("play").textContent = on ? "❚❚" : "▶";
    find("play").setAttribute("aria-label", on ? "Pause" : "Play");
    redraw();
  }

  function seek(time) {
    now.time = Math.max(0, Math.min(time, flight.duration(now.shown)));
    find("time").value = now.time;
    redraw();
  }

  function show(shown) {
    now.shown = shown;
    find("shown").value = shown;
    find("time").max = flight.duration(shown);
    find("planned-too").disabled = shown < 0;
    seek(now.time);
  }

  flight.records.forEach((record, i) => find("shown").add(new Option(record.name, i)));
  for (const id of ["shown", "planned-too"]) {
    find(id).closest("label").hidden = !flight.records.length;
  }
  find("play").addEventListener("click", () => play(!now.playing));
  find("time").addEventListener("input", (event) => seek(Number(event.target.value)));
  find("shown").addEventListener("change", (event) => show(Number(event.target.value)));
  for (const id of ["planned-too", "route-too"]) {
    find(id).addEventListener("change", redraw);
  }
  document.querySelectorAll("[data-view]").forEach((button) =>
    button.addEventListener("click", () => scene.view(button.dataset.view)));
  document.querySelectorAll("[data-zoom]").forEach((button) =>
    button.addEventListener("click", () => scene.zoom(Number(button.dataset.zoom))));
  document.querySelectorAll(".go").forEach((button) => button.addEventListener("click", () => {
    const crossing = flight.data.crossings[Number(button.dataset.crossing)];
    seek(flight.when(now.shown, crossing.time) ?? flight.duration(now.shown));
  }));
  document.addEventListener("keydown", (event) => {
    const own = event.target.closest("button, select, a, input[type=checkbox]");
    if (event.key === " " && !own) {
      event.preventDefault();
      play(!now.playing);
    }
  });
  const recolour = () => {
    readTheme();
    regionsKey(above);
    redraw();
  };
  dark.addEventListener("change", recolour);
  new ResizeObserver(redraw).observe(document.querySelector(".views"));
  recolour();
  show(now.shown);
  await offerFiles(flight.data.downloads);

  // For whoever scripts the page.
  window.flight = {
    robots: () => flight.at(now.shown, now.time).robots,
    cable: () => flight.at(now.shown, now.time).cable.map(({ points }) => points),
    time: () => now.time,
    duration: () => flight.duration(now.shown),
    camera: () => ({ ...scene.camera }),
    seek,
  };
  document.documentElement.dataset.ready = "true";
}

function regionsKey({ shades, deepest }) {
  const words = [];
  for (let layer = 1; layer <= shades; layer += 1) {
    const low = Math.floor(((layer - 1) * deepest) / shades) + 1;
    const high = Math.floor((layer * deepest) / shades);
    const count = low === high ? `${high}` : `${low}–${high}`;
    const entry = document.createElement("span");
    entry.innerHTML = '<svg viewBox="0 0 1 1" aria-hidden="true"><rect width="1" height="1"/></svg>';
    entry.querySelector("rect").setAttribute("fill", theme[`layer-${layer}`]);
    entry.append(`${count} active region${high > 1 ? "s" : ""}`);
    words.push(entry);
  }
  find("regions-key").replaceChildren(...words);
}

async function offerFiles(downloads) {
  for (const [name, packed] of downloads) {
    const bytes = await inflated(packed);
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([bytes], { type: "text/plain;charset=utf-8" }));
    link.download = name;
    link.textContent = name;
    const size = document.createElement("span");
    size.textContent = ` ${Math.max(1, Math.round(bytes.length / 1000))} kB`;
    const entry = document.createElement("li");
    entry.append(link, size);
    find("files").append(entry);
  }
  find("downloads-section").hidden = !downloads.length;
}

start().catch((error) => {
  find("trouble").textContent = `The pictures cannot be drawn in this browser: ${error.message}`;
  find("trouble").hidden = false;
});
