/**
 * Decodes the frames that analysis/draw/frames.py packed. analysis/draw/frame_coding.py explains the coding.
 * Lengths in m, times in s.
 */

const WEIGHT_BITS = 12;
const PARENTS = 6;
const CLASSES = 16;
const SLICE_MS = 12; // of decoding before the page may do something else

/** The bytes of a script element with base64. */
export function bytesOf(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** Inflates a zlib stream. */
export async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** One run: its mesh, its pins and obstacles, and its frames, which are decoded one after the other. */
export class Frames {
  /** @param {object} head the run's `frames` of the page's data @param {string} text its bytes as base64 */
  constructor(head, text) {
    this.head = head;
    this.text = text;
    // Everything before the second frame, because this is enough for a first picture
    this.bytes = bytesOf(text.slice(0, 4 * Math.ceil(head.sections.frames.offset / 3)));
    this.vertices = head.vertices;
    this.count = head.count;
    this.times = Float64Array.from(head.times);
    this.decoded = 0; // number of decoded frames
    this.lattice = null; // (count, V, 3) integers
  }

  /** Decodes the mesh. */
  async open() {
    const { sections } = this.head;
    [this.rest, this.triangles, this.pinned, this.seeds] = await Promise.all(
      ["rest", "triangles", "pinned", "seeds"].map((name) => this.array(name)));
    this.obstacles = await Promise.all(this.head.obstacles.map(async ({ section, velocity }) => ({
      velocity, points: await this.array(`${section}-points`),
      triangles: await this.array(`${section}-triangles`) })));
    this.lattice = new Uint16Array(3 * this.vertices * this.count);
    this.lattice.set(await this.array("first"));
    this.decoded = 1;
    return this;
  }

  #decoder;

  #part(section) {
    return this.bytes.subarray(section.offset, section.offset + section.size);
  }

  async #prepare() {
    const { frames } = this.head.sections;
    if (this.#decoder || this.count < 2) return;
    const from = Math.floor(frames.offset / 3); // four characters are three bytes
    const bytes = bytesOf(this.text.slice(4 * from));
    this.text = null;
    const [parents, groups, planes] = await Promise.all([this.array("parents"), this.array("groups"),
      inflated(bytes.subarray(frames.offset - 3 * from, frames.offset - 3 * from + frames.size))]);
    this.#decoder = frameDecoder(planes, frames, parents, groups, this.lattice, this.vertices);
  }

  #decodeOne() {
    this.#decoder();
    if (++this.decoded === this.count) this.#decoder = null;
  }

  /** Decodes all frames after the first, a few at a time. @param {() => boolean} wanted false: stop */
  async decodeAll(wanted = () => true) {
    if (this.decoded === this.count) return;
    this.preparing ??= this.#prepare();
    await this.preparing;
    while (this.decoded < this.count && wanted()) {
      const end = performance.now() + SLICE_MS;
      while (this.decoded < this.count && performance.now() < end) this.#decodeOne();
      await new Promise((resume) => setTimeout(resume));
    }
  }

  /** The numbers of a section (rows · columns), Float32Array or Uint32Array; null without this section. */
  async array(name) {
    const section = this.head.sections[name];
    if (!section) return null;
    const planes = await inflated(this.#part(section));
    const numbers = joined(planes, section.rows, section.columns);
    return section.kind === "floats" ? new Float32Array(numbers.buffer)
      : summed(numbers, section.rows, section.columns);
  }

  /** Writes the positions of a decoded frame to `out` (V · 3). */
  positions(frame, out = new Float32Array(3 * this.vertices)) {
    const { origin: [x, y, z], step } = this.head;
    const from = frame * this.vertices * 3;
    for (let i = 0; i < out.length; i += 3) {
      out[i] = x + step * this.lattice[from + i];
      out[i + 1] = y + step * this.lattice[from + i + 1];
      out[i + 2] = z + step * this.lattice[from + i + 2];
    }
    return out;
  }

  /** Index of the last decoded frame that is not later than a time; the first frame if all are later. */
  frameAt(time) {
    let low = 0, high = this.decoded - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.times[middle] <= time + 1e-9) low = middle;
      else high = middle - 1;
    }
    return low;
  }
}

/** 4-byte numbers from planes of bytes: for each column the first byte of all rows, then the second byte … */
function joined(planes, rows, columns) {
  const numbers = new Uint32Array(rows * columns);
  const bytes = new Uint8Array(numbers.buffer);
  for (let c = 0, at = 0; c < columns; ++c)
    for (let b = 0; b < 4; ++b)
      for (let r = 0; r < rows; ++r, ++at) bytes[4 * (r * columns + c) + b] = planes[at];
  return numbers;
}

/** Sums the differences to the row before. */
function summed(numbers, rows, columns) {
  for (let c = 0; c < columns; ++c)
    for (let r = 0, at = c, sum = 0; r < rows; ++r, at += columns) {
      const folded = numbers[at];
      sum += (folded >>> 1) ^ -(folded & 1);
      numbers[at] = sum;
    }
  return numbers;
}

/** Returns a function, each call of which decodes one more frame behind the earlier frames in `lattice`. At first
 * `lattice` has the first frame, and room for all. */
function frameDecoder(planes, { weights, counts }, parentSteps, groups, lattice, vertices) {
  const size = 3 * vertices;
  const total = lattice.length - size;
  const at = new Uint32Array(CLASSES);
  counts.reduce((sum, n, i) => { at[i] = sum; return sum + n; }, 0);
  const parents = new Uint32Array(parentSteps.length); // places of coordinates
  for (let v = 0, p = 0; v < vertices; ++v)
    for (let k = 0; k < PARENTS; ++k, ++p) parents[p] = 3 * (v - parentSteps[p]);
  let motion = new Int32Array(size), motionBefore = new Int32Array(size);
  let sizes = new Int32Array(size), sizesBefore = new Int32Array(size);
  let frame = 1;
  const unit = 2 ** WEIGHT_BITS;

  function remainder(near) {
    const kind = Math.min(31 - Math.clz32(near + 1), CLASSES - 1);
    const place = at[kind]++;
    const folded = planes[place] | (planes[total + place] << 8);
    return (folded >>> 1) ^ -(folded & 1);
  }

  return () => {
    const from = frame * size;
    motion.fill(0, 0, 3); // vertex 0 is its own parent
    for (let v = 0, i = 0, p = 0; v < vertices; ++v, p += PARENTS) {
      const p1 = parents[p], p2 = parents[p + 1], p3 = parents[p + 2], p4 = parents[p + 3], p5 = parents[p + 4],
        p6 = parents[p + 5];
      const w = weights[groups[v]];
      for (let c = 0; c < 3; ++c, ++i) {
        let near = v === 0 ? sizesBefore[i] : sizes[p1 + c] + sizes[p2 + c] + 2 * sizesBefore[i];
        if (c > 0) near += sizes[i - 1];
        const left = remainder(near);
        sizes[i] = Math.abs(left);
        const guess = w[0] * motionBefore[i] + w[1] * motion[p1 + c] + w[2] * motion[p2 + c] +
          w[3] * motion[p3 + c] + w[4] * motion[p4 + c] + w[5] * motion[p5 + c] + w[6] * motion[p6 + c] +
          w[7] * motionBefore[p1 + c] + w[8] * motionBefore[p2 + c] + w[9] * motionBefore[p3 + c] +
          w[10] * motionBefore[p4 + c] + w[11] * motionBefore[p5 + c] + w[12] * motionBefore[p6 + c];
        const before = lattice[from - size + i];
        const value = (before + Math.floor((guess + unit / 2) / unit) + left) & 65535;
        motion[i] = value - before;
        lattice[from + i] = value;
      }
    }
    ++frame;
    [motion, motionBefore] = [motionBefore, motion];
    [sizes, sizesBefore] = [sizesBefore, sizes];
  };
}
