// Films as the page holds them: see src/report/viewer/pack.rs.

/** Bytes from Base64 of a deflated stream. */
const inflate = async (text) => {
  const packed = Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
};

/** The value of every half float (IEEE 754 binary16), by its bits. */
const halves = Float32Array.from({ length: 1 << 16 }, (_, bits) => {
  const sign = bits >> 15 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const fraction = (bits & 1023) / 1024;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent ? (1 + fraction) * 2 ** (exponent - 15) : fraction * 2 ** -14);
});

/** The radiances of a packed film. */
const unpack = async (text, scale) => {
  const bytes = await inflate(text);
  const count = bytes.length / 2;
  const film = new Float32Array(count);
  for (let i = 0, bits = 0; i < count; i += 1) {
    bits = (bits + bytes[i] + 256 * bytes[count + i]) & 0xffff;
    film[i] = halves[bits] / scale;
  }
  return film;
};
