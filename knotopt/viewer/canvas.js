// What the three pictures share: sharp canvases, colours of the scheme, things drawn far to near.

const dark = matchMedia("(prefers-color-scheme: dark)");
let theme = {};

function readTheme() {
  const style = getComputedStyle(document.documentElement);
  theme = {};
  for (const name of ["ground", "panel", "ink", "quiet", "line", "accent", "grid", "shadow", "over",
    "under", "layer-1", "layer-2", "layer-3", "layer-4"]) {
    theme[name] = style.getPropertyValue(`--${name}`).trim();
  }
}

// White on dark colours, black on light ones.
function textOn(colour) {
  const parts = colour.startsWith("#")
    ? [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16)) : colour.match(/\d+/g).map(Number);
  return 0.3 * parts[0] + 0.59 * parts[1] + 0.11 * parts[2] > 125 ? "#101418" : "#ffffff";
}

// On dark ground the darker colours are lifted.
function shade(colour) {
  if (!dark.matches) {
    return colour;
  }
  const parts = [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
  return `rgb(${parts.map((v) => Math.round(v + 0.28 * (255 - v))).join(" ")})`;
}

function sharp(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth;
  const height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.fillStyle = theme.panel;
  context.fillRect(0, 0, width, height);
  context.lineCap = "round";
  context.lineJoin = "round";
  context.textAlign = "center";
  context.textBaseline = "middle";
  return { context, width, height };
}

function stroke(context, points, colour, width) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.beginPath();
  points.forEach((point, i) => (i ? context.lineTo(...point) : context.moveTo(...point)));
  context.stroke();
}

// The pieces of a cable as things to draw: each clears its surroundings first, so that what lies
// below it looks interrupted.
function cablePieces(strands, project, width) {
  const pieces = [];
  for (const { points, colour } of strands) {
    const seen = points.map(project);
    for (let i = 1; i < seen.length; i += 1) {
      const [a, b] = [seen[i - 1], seen[i]];
      if (a && b) {
        pieces.push({
          depth: (a[2] + b[2]) / 2,
          draw: (context) => {
            const ends = [a.slice(0, 2), b.slice(0, 2)];
            context.lineCap = "butt";
            stroke(context, ends, theme.panel, 2.6 * width);
            context.lineCap = "round";
            stroke(context, ends, colour, width);
          },
        });
      }
    }
  }
  return pieces;
}

function drawFarToNear(context, things) {
  things.sort((a, b) => b.depth - a.depth);
  for (const thing of things) {
    thing.draw(context);
  }
}

function label(context, text, x, y, colour, size = 11, weight = 600) {
  context.font = `${weight} ${size}px system-ui, sans-serif`;
  context.strokeStyle = theme.panel;
  context.lineWidth = 3;
  context.strokeText(text, x, y);
  context.fillStyle = colour;
  context.fillText(text, x, y);
}

// Labels beside their points, where they are least in the way of each other and of what is `taken`.
function placeLabels(context, labels, taken) {
  const boxes = taken.map(([x, y]) => [x - 8, y - 8, x + 8, y + 8]);
  for (const { text, x, y, colour } of labels) {
    context.font = "600 11px system-ui, sans-serif";
    const half = context.measureText(text).width / 2 + 1;
    let best = null;
    for (const [dx, dy] of [[1, -1], [1, 1], [-1, -1], [-1, 1], [0, -1.8], [0, 1.8]]) {
      const [u, v] = [x + dx * (half + 5), y + dy * 9];
      const box = [u - half, v - 6, u + half, v + 6];
      const cost = boxes.reduce((sum, [l, t, r, b]) => sum +
        Math.max(0, Math.min(r, box[2]) - Math.max(l, box[0])) *
        Math.max(0, Math.min(b, box[3]) - Math.max(t, box[1])), 0);
      if (!best || cost < best.cost) {
        best = { cost, u, v, box };
      }
    }
    boxes.push(best.box);
    label(context, text, best.u, best.v, colour);
  }
}
