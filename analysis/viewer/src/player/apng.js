/** Animated PNG (https://www.w3.org/TR/png-3/), for browsers that record no WebM. */

const TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n >>> 0;
});

function checksum(bytes) {
  let sum = 0xffffffff;
  for (const byte of bytes) sum = TABLE[(sum ^ byte) & 255] ^ (sum >>> 8);
  return (sum ^ 0xffffffff) >>> 0;
}

function chunk(type, data) {
  const bytes = new Uint8Array(12 + data.length), view = new DataView(bytes.buffer);
  view.setUint32(0, data.length);
  for (let i = 0; i < 4; ++i) bytes[4 + i] = type.charCodeAt(i);
  bytes.set(data, 8);
  view.setUint32(8 + data.length, checksum(bytes.subarray(4, 8 + data.length)));
  return bytes;
}

/** The bytes of numbers from [size in bytes, value], most significant byte first. */
function fields(...pairs) {
  const bytes = new Uint8Array(pairs.reduce((sum, [size]) => sum + size, 0)), view = new DataView(bytes.buffer);
  let at = 0;
  for (const [size, value] of pairs) {
    if (size === 4) view.setUint32(at, value);
    else if (size === 2) view.setUint16(at, value);
    else view.setUint8(at, value);
    at += size;
  }
  return bytes;
}

async function deflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The rows of an RGB picture, each minus the row above (filter 2 of PNG). */
function rowsOf({ data, width, height }) {
  const bytes = new Uint8Array(height * (1 + 3 * width));
  for (let y = 0, to = 0; y < height; ++y) {
    bytes[to++] = 2;
    for (let x = 0, from = 4 * y * width; x < width; ++x, from += 4)
      for (let c = 0; c < 3; ++c) bytes[to++] = data[from + c] - (y ? data[from + c - 4 * width] : 0);
  }
  return bytes;
}

/** Collects pictures of one size. */
export class AnimatedPng {
  constructor() {
    this.pictures = [];
  }

  /** @param {ImageData} picture @param {number} seconds how long it is shown */
  async add(picture, seconds) {
    this.size = [picture.width, picture.height];
    this.pictures.push({ data: await deflated(rowsOf(picture)), milliseconds: Math.round(1000 * seconds) });
  }

  blob() {
    const [width, height] = this.size;
    let sequence = 0;
    const parts = [Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a),
      chunk("IHDR", fields([4, width], [4, height], [1, 8], [1, 2], [1, 0], [1, 0], [1, 0])),
      chunk("acTL", fields([4, this.pictures.length], [4, 0]))];
    this.pictures.forEach(({ data, milliseconds }, i) => {
      parts.push(chunk("fcTL", fields([4, sequence++], [4, width], [4, height], [4, 0], [4, 0],
                                      [2, milliseconds], [2, 1000], [1, 0], [1, 0])));
      if (i === 0) parts.push(chunk("IDAT", data));
      else {
        const numbered = new Uint8Array(4 + data.length);
        new DataView(numbered.buffer).setUint32(0, sequence++);
        numbered.set(data, 4);
        parts.push(chunk("fdAT", numbered));
      }
    });
    parts.push(chunk("IEND", new Uint8Array()));
    return new Blob(parts, { type: "image/png" });
  }
}
