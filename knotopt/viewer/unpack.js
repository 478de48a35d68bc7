// Undoes what packing.py did.

async function inflated(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// A motion: frames of points. `at(place)` interpolates between frames.
async function motion(packed) {
  const bytes = await inflated(packed.bytes);
  const size = packed.points * packed.axes;
  const whole = new Int16Array(bytes.length / 2); // sums wrap around as the differences did
  for (let i = 0; i < whole.length; i += 1) {
    whole[i] = (bytes[i] | (bytes[whole.length + i] << 8)) + (i >= size ? whole[i - size] : 0);
  }
  const frames = [];
  for (let f = 0; f < packed.frames; f += 1) {
    const points = [];
    for (let p = 0; p < packed.points; p += 1) {
      const start = f * size + p * packed.axes;
      points.push(Array.from(whole.subarray(start, start + packed.axes), (v) => v * packed.unit));
    }
    frames.push(points);
  }
  const at = (place) => {
    const low = Math.max(0, Math.min(Math.floor(place), frames.length - 2));
    const share = Math.max(0, Math.min(place - low, 1));
    const next = frames[low + 1];
    return frames[low].map((point, p) => point.map((v, k) => v + share * (next[p][k] - v)));
  };
  return { frames, at };
}
