// Pictures on canvases: the part that a camera sees, with frames, a cross, a grid and values.

const INSET_COLOURS = ["#e69f00", "#0072b2", "#cc79a7"];
/** Pixels of the image get a grid from this size on the screen, and values from that. */
const GRID = 12;
const VALUES = 44;

/** Fits a canvas's dots to the size it is shown at; gives its context, and its size in CSS pixels. */
const prepare = (canvas) => {
  const dense = Math.min(devicePixelRatio || 1, 2);
  const width = Math.max(1, canvas.clientWidth);
  const height = Math.max(1, canvas.clientHeight);
  const dots = [Math.round(width * dense), Math.round(height * dense)];
  if (canvas.width !== dots[0] || canvas.height !== dots[1]) [canvas.width, canvas.height] = dots;
  const context = canvas.getContext("2d");
  context.setTransform(dots[0] / width, 0, 0, dots[1] / height, 0, 0);
  context.imageSmoothingEnabled = false;
  return { context, width, height };
};

/** Draws what is seen of a picture into a rectangle of the canvas. */
const drawSeen = (context, picture, seen, x, y, width, height) => {
  context.drawImage(picture, seen.x, seen.y, seen.width, seen.height, x, y, width, height);
};

/** Frames rectangles of the image. */
const drawFrames = (context, rectangles, seen, width, height) => {
  const [across, down] = [width / seen.width, height / seen.height];
  context.lineWidth = 2;
  rectangles.forEach((inset, i) => {
    context.strokeStyle = INSET_COLOURS[i % INSET_COLOURS.length];
    context.strokeRect((inset.x - seen.x) * across, (inset.y - seen.y) * down, inset.width * across, inset.height * down);
  });
};

/** Marks a pixel of the image. */
const drawMark = (context, [x, y], seen, width, height) => {
  const [across, down] = [width / seen.width, height / seen.height];
  const box = [(Math.floor(x) - seen.x) * across, (Math.floor(y) - seen.y) * down, across, down];
  const grow = Math.max(0, 4 - across / 2);
  context.lineWidth = 1;
  for (const [colour, by] of [["#000", grow + 1], ["#fff", grow]]) {
    context.strokeStyle = colour;
    context.strokeRect(box[0] - by, box[1] - by, box[2] + 2 * by, box[3] + 2 * by);
  }
};

/** A grid between pixels that were zoomed to some size, and their values if they are larger. */
const drawGrid = (context, seen, fullWidth, width, height, valueAt) => {
  const size = width / seen.width;
  if (size < GRID || size <= width / fullWidth) return;
  const [x0, y0] = [Math.floor(seen.x), Math.floor(seen.y)];
  const [x1, y1] = [Math.ceil(seen.x + seen.width), Math.ceil(seen.y + seen.height)];
  context.lineWidth = 0.5;
  context.strokeStyle = "rgb(128 128 128 / 0.6)";
  context.beginPath();
  for (let x = x0; x <= x1; x += 1) {
    context.moveTo((x - seen.x) * size, 0);
    context.lineTo((x - seen.x) * size, height);
  }
  for (let y = y0; y <= y1; y += 1) {
    context.moveTo(0, (y - seen.y) * size);
    context.lineTo(width, (y - seen.y) * size);
  }
  context.stroke();
  if (size < VALUES) return;
  context.save();
  context.font = "11px ui-monospace, monospace";
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineWidth = 2.5;
  context.lineJoin = "round";
  for (let y = y0; y < y1; y += 1) {
    for (let x = x0; x < x1; x += 1) {
      const text = valueAt(x, y, ((x - seen.x + 0.5) * size) / width);
      const at = [(x - seen.x + 0.5) * size, (y - seen.y + 0.5) * size];
      context.strokeStyle = "#000";
      context.strokeText(text, ...at);
      context.fillStyle = "#fff";
      context.fillText(text, ...at);
    }
  }
  context.restore();
};
