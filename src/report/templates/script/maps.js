// What a picture shows of films: radiance, what differs from the reference, what changes from frame to frame. A map is
// a function of layers, numbers at a pixel, and says what its colours mean.

/** Layers of a scene: what a map is made of, for a film in the frame that is shown. */
const layers = {
  film: (scene, film) => scene.frameOf(film),
  truth: (scene) => scene.frameOf(scene.settings.reference),
  other: (scene) => scene.frameOf(scene.state.other),
  before: (scene, film) => scene.frameOf(film, -1),
  truthBefore: (scene) => scene.frameOf(scene.settings.reference, -1),
  flicker: (scene, film) => scene.flickerOf(film),
  wrongFlicker: (scene, film) => scene.wrongFlickerOf(film),
};
const needsReference = ["truth", "truthBefore", "wrongFlicker"];
const needsMotion = ["before", "truthBefore", "flicker", "wrongFlicker"];

const toSize = (unit) => ["0", "", `${figure(unit)} or more`];

const maps = {
  radiance: {
    name: "radiance",
    layers: ["film"],
    value: (film) => film,
    paint: grey,
    unit: ({ white }) => white,
    anchors: greyRamp,
    ends: (unit) => ["0", "", figure(unit)],
  },
  error: {
    name: "|error|",
    layers: ["film", "truth"],
    value: (film, truth) => Math.abs(film - truth),
    paint: magnitude,
    unit: ({ full }) => full,
    anchors: scales.magnitude,
    ends: (unit) => ["0", "", `${figure(unit)} or more off`],
  },
  signed: {
    name: "signed error",
    layers: ["film", "truth"],
    value: (film, truth) => film - truth,
    paint: signed,
    unit: ({ full }) => full,
    anchors: scales.signed,
    ends: (unit) => [`too dark −${figure(unit)}`, "0", `+${figure(unit)} too bright`],
  },
  improvement: {
    name: "improvement",
    layers: ["film", "truth", "other"],
    value: (film, truth, other) => Math.abs(film - truth) - Math.abs(other - truth),
    paint: signed,
    unit: ({ full }) => full,
    anchors: scales.signed,
    ends: (unit, one, other) => [`${one} nearer by ${figure(unit)}`, "as near", `${other} nearer by ${figure(unit)}`],
  },
  change: {
    name: "change",
    says: "change from the frame before",
    layers: ["film", "before"],
    value: (film, before) => Math.abs(film - before),
    paint: magnitude,
    unit: ({ motion }) => motion.change,
    anchors: scales.magnitude,
    ends: toSize,
  },
  wrongChange: {
    name: "wrong change",
    says: "change of the error from the frame before",
    layers: ["film", "truth", "before", "truthBefore"],
    value: (film, truth, before, truthBefore) => Math.abs(film - truth - (before - truthBefore)),
    paint: magnitude,
    unit: ({ motion }) => motion.change,
    anchors: scales.magnitude,
    ends: toSize,
  },
  flicker: {
    name: "flicker",
    says: "mean change over all frames",
    layers: ["flicker"],
    value: (flicker) => flicker,
    paint: magnitude,
    unit: ({ motion }) => motion.flicker,
    anchors: scales.magnitude,
    ends: toSize,
  },
  wrongFlicker: {
    name: "wrong flicker",
    says: "mean change of the error over all frames",
    layers: ["wrongFlicker"],
    value: (flicker) => flicker,
    paint: magnitude,
    unit: ({ motion }) => motion.flicker,
    anchors: scales.magnitude,
    ends: toSize,
  },
};

/** The maps that a scene has layers for. */
const mapsOf = ({ reference, frames }) => {
  const lacks = (layer) => (reference === null && needsReference.includes(layer)) || (frames < 2 && needsMotion.includes(layer));
  return Object.keys(maps).filter((name) => !maps[name].layers.some(lacks));
};

/** Each pixel's mean |change| from frame to frame, of films less a truth (or nothing), all frames one after the other. */
const meanChange = (film, truth, size) => {
  const sums = new Float64Array(size);
  for (let i = size; i < film.length; i += 1) {
    const change = film[i] - film[i - size];
    sums[i % size] += Math.abs(truth ? change - (truth[i] - truth[i - size]) : change);
  }
  return sums.map((sum) => (sum * size) / (film.length - size));
};

/** Paints a map, one pixel of the canvas a pixel of the film. */
const paintMap = (canvas, map, unit, [a, b = a, c = a, d = a]) => {
  const context = canvas.getContext("2d");
  const image = context.createImageData(canvas.width, canvas.height);
  const pixels = new Uint32Array(image.data.buffer);
  for (let i = 0; i < pixels.length; i += 1) {
    pixels[i] = map.paint(map.value(a[i], b[i], c[i], d[i]) / unit);
  }
  context.putImageData(image, 0, 0);
};
