// What a picture shows of films: radiance, or what differs from the reference. Each map is a function of the film's
// value, the reference's and the other film's, and says what its colours mean.

const maps = {
  radiance: {
    name: "radiance",
    value: (film) => film,
    paint: grey,
    unit: (settings) => settings.white,
    anchors: greyRamp,
    ends: (unit) => ["0", "", figure(unit)],
  },
  error: {
    name: "|error|",
    value: (film, truth) => Math.abs(film - truth),
    paint: magnitude,
    unit: (settings) => settings.full,
    anchors: scales.magnitude,
    ends: (unit) => ["0", "", `${figure(unit)} or more off`],
  },
  signed: {
    name: "signed error",
    value: (film, truth) => film - truth,
    paint: signed,
    unit: (settings) => settings.full,
    anchors: scales.signed,
    ends: (unit) => [`too dark −${figure(unit)}`, "0", `+${figure(unit)} too bright`],
  },
  improvement: {
    name: "improvement",
    value: (film, truth, other) => Math.abs(film - truth) - Math.abs(other - truth),
    paint: signed,
    unit: (settings) => settings.full,
    anchors: scales.signed,
    ends: (unit, one, other) => [`${one} nearer by ${figure(unit)}`, "as near", `${other} nearer by ${figure(unit)}`],
  },
};

/** Paints a map of a film, one pixel of the canvas a pixel of the film. */
const paintMap = (canvas, map, unit, film, truth, other) => {
  const context = canvas.getContext("2d");
  const image = context.createImageData(canvas.width, canvas.height);
  const pixels = new Uint32Array(image.data.buffer);
  for (let i = 0; i < pixels.length; i += 1) {
    pixels[i] = map.paint(map.value(film[i], truth[i], other[i]) / unit);
  }
  context.putImageData(image, 0, 0);
};
