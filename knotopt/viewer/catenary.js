// A cable of a given length that hangs between two robots, down to the ground at most.
function hanging(a, b, length, pieces) {
  const across = Math.hypot(b[0] - a[0], b[1] - a[1]);
  const rise = b[2] - a[2];
  const line = (share, z) => [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), z];
  const points = [a];
  if (length <= 1.0001 * Math.hypot(across, rise)) {
    return [a, b];
  }
  if (across < 0.001) {
    const lowest = Math.max(0, (a[2] + b[2] - length) / 2);
    return [a, line(0.5, lowest), b];
  }
  // sinh(x) / x = ratio, with x = across / (2 c) for the catenary c cosh(s / c), by Newton's method
  // from above, where it is convex.
  const ratio = Math.sqrt(length * length - rise * rise) / across;
  let x = ratio < 3 ? Math.sqrt(6 * (ratio - 1)) : 1 + Math.log(2 * ratio * Math.log(2 * ratio));
  for (let i = 0; i < 30; i += 1) {
    x -= (Math.sinh(x) - ratio * x) / (Math.cosh(x) - ratio);
  }
  const c = across / (2 * x);
  const lowest = across / 2 - c * Math.atanh(rise / length);
  const start = c * Math.sinh(-lowest / c); // length of cable from its lowest point to a
  for (let i = 1; i < pieces; i += 1) {
    const along = start + (length * i) / pieces;
    const z = a[2] + Math.hypot(c, along) - Math.hypot(c, start);
    points.push(line((lowest + c * Math.asinh(along / c)) / across, Math.max(0, z)));
  }
  points.push(b);
  return points;
}
