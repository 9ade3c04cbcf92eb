// Colours of values: the same scales as the pictures beside the page.

const scales = JSON.parse(document.getElementById("colours")?.textContent ?? "{}");

const STEPS = 1024;
const OPAQUE = 0xff000000;
const BLACK = OPAQUE;

const pixelOf = ([red, green, blue]) => (OPAQUE | (blue << 16) | (green << 8) | red) >>> 0;

/** The colour at `along`, from 0 to 1, between equally spaced anchors. */
const between = (anchors, along) => {
  const place = clamp(along, 0, 1) * (anchors.length - 1);
  const low = Math.min(Math.floor(place), anchors.length - 2);
  return anchors[low].map((from, c) => Math.round(from + (anchors[low + 1][c] - from) * (place - low)));
};

const tableOf = (colourAt) => Uint32Array.from({ length: STEPS + 1 }, (_, i) => pixelOf(colourAt(i / STEPS)));

/** The 8-bit sRGB code of a linear value (IEC 61966-2-1). */
const srgb = (linear) => {
  const held = clamp(linear, 0, 1);
  return Math.round(255 * (held <= 0.0031308 ? 12.92 * held : 1.055 * held ** (1 / 2.4) - 0.055));
};

const magnitudes = scales.magnitude && tableOf((share) => between(scales.magnitude, share));
const signs = scales.signed && tableOf((share) => between(scales.signed, share));

/** Pixels of values from 0 to 1: linear grey, a magnitude, and, from −1 to 1, a signed value. */
const grey = (value) => (Number.isNaN(value) ? BLACK : (OPAQUE | (srgb(value) * 0x010101)) >>> 0);
const magnitude = (value) => (Number.isNaN(value) ? BLACK : magnitudes[Math.round(clamp(value, 0, 1) * STEPS)]);
const signed = (value) => (Number.isNaN(value) ? BLACK : signs[Math.round((0.5 + 0.5 * clamp(value, -1, 1)) * STEPS)]);

/** The scale as a CSS gradient, for a key. */
const gradient = (anchors) => `linear-gradient(90deg, ${anchors.map((rgb) => `rgb(${rgb.join(" ")})`).join(", ")})`;
const greyRamp = Array.from({ length: 9 }, (_, i) => Array(3).fill(srgb(i / 8)));
