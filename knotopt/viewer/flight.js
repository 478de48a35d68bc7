// What is where at a time: the plan, or one of its records beside the plan.

async function readFlight() {
  const data = JSON.parse(document.getElementById("data").textContent);
  const plan = await motion(data.positions);
  const route = (await motion(data.route)).frames.map((points) => points[0]);
  const records = [];
  for (const record of data.records) {
    records.push({ ...record, motion: await motion(record.cable) });
  }
  const robots = data.lengths.length + 1;
  const placeInPlan = (time) => (time / data.duration) * (plan.frames.length - 1);
  const plannedAt = (time) => plan.at(placeInPlan(time));
  const colours = () => data.colours.map(shade);

  function spans(positions) {
    const shades = colours();
    return data.lengths.map((length, j) => ({
      points: hanging(positions[j], positions[j + 1], length, 22), colour: shades[j],
    }));
  }

  function cut(cable, held) {
    const shades = colours();
    return held.slice(1).map((end, j) => ({
      points: cable.slice(held[j], end + 1), colour: shades[j],
    }));
  }

  // The leader's way up to now: a point for every frame, and where it is now.
  function track(frames, leader, place, now) {
    const before = frames.slice(0, Math.floor(place) + 1).map((points) => points[leader]);
    return [...before, now];
  }

  // The box that holds all robots from each frame on: what the pictures show closes in on the knot.
  const boxes = [];
  for (let f = plan.frames.length - 1; f >= 0; f -= 1) {
    const points = [...plan.frames[f], ...(boxes[0] || [])];
    boxes.unshift([Math.min, Math.max].map((pick) =>
      [0, 1, 2].map((k) => pick(...points.map((point) => point[k])))));
  }

  function boxAt(clock) {
    const place = placeInPlan(clock);
    const low = Math.max(0, Math.min(Math.floor(place), boxes.length - 2));
    return boxes[low].map((corner, i) => corner.map((v, k) =>
      v + (place - low) * (boxes[low + 1][i][k] - v) + (i ? 0.1 : -0.1)));
  }

  function at(shown, time) {
    if (shown < 0) {
      const positions = plannedAt(time);
      return {
        clock: time, box: boxAt(time), robots: positions, cable: spans(positions),
        planned: null, plannedCable: null,
        track: track(plan.frames, robots - 1, placeInPlan(time), positions[robots - 1]),
      };
    }
    const record = records[shown];
    const place = record.duration ? (time / record.duration) * (record.cable.frames - 1) : 0;
    const cable = record.motion.at(place);
    const low = Math.min(Math.floor(place), record.clock.length - 2);
    const clock = record.clock[low] + (place - low) * (record.clock[low + 1] - record.clock[low]);
    const positions = record.held.map((vertex) => cable[vertex]);
    const planned = plannedAt(clock);
    return {
      clock, box: boxAt(clock), robots: positions, cable: cut(cable, record.held),
      planned, plannedCable: spans(planned),
      track: track(record.motion.frames, record.held[robots - 1], place, positions[robots - 1]),
    };
  }

  function duration(shown) {
    return shown < 0 ? data.duration : records[shown].duration;
  }

  // When something planned for a time happens in what is shown; null if it never does.
  function when(shown, time) {
    if (shown < 0) {
      return time;
    }
    const record = records[shown];
    const frame = record.clock.findIndex((clock) => clock >= time - 1e-6);
    return frame < 0 ? null : (frame / (record.clock.length - 1)) * record.duration;
  }

  // The leader's height over time, in what is shown.
  function heights(shown) {
    const frames = shown < 0 ? plan.frames : records[shown].motion.frames;
    const leader = shown < 0 ? robots - 1 : records[shown].held[robots - 1];
    const last = frames.length - 1;
    return frames.map((points, f) => [(f / last) * duration(shown), points[leader][2]]);
  }

  return { data, plan, route, records, robots, at, duration, when, heights, colours };
}
