/** A rest mesh: its edges, rings and hinges, and the map from another mesh to this mesh. Lengths in m. */

/** A number that identifies a pair of vertices, in either order. */
const pairKey = (a, b) => (a < b ? a * 67108864 + b : b * 67108864 + a);

export class Mesh {
  /** @param {Float32Array} rest (V · 3) @param {Uint32Array} triangles (T · 3) */
  constructor(rest, triangles) {
    this.rest = rest;
    this.triangles = triangles;
    this.vertexCount = rest.length / 3;
    this.triangleCount = triangles.length / 3;
    this.frames = restFrames(rest, triangles);
  }

  /** Interior edges: (E · 4) the ends a, b and the opposite vertices c, d; (E · 2) the two triangles. */
  get hinges() {
    this._hinges ??= hingesOf(this.triangles);
    return this._hinges;
  }

  /** `list`: the triangles around each vertex. `first` (V + 1): the index in `list` of the first triangle of
   * each vertex. */
  get around() {
    this._around ??= trianglesAround(this.triangles, this.vertexCount);
    return this._around;
  }

  /** (V) number of edges on the shortest path from a vertex; -1 without a path. */
  ringsFrom(vertex) {
    const rings = new Int32Array(this.vertexCount).fill(-1);
    rings[vertex] = 0;
    const { first, list } = this.around;
    for (let queue = [vertex], at = 0; at < queue.length; ++at)
      for (let i = first[queue[at]]; i < first[queue[at] + 1]; ++i)
        for (let c = 0; c < 3; ++c) {
          const other = this.triangles[3 * list[i] + c];
          if (rings[other] < 0) {
            rings[other] = rings[queue[at]] + 1;
            queue.push(other);
          }
        }
    return rings;
  }

  /** Whether another mesh has the same triangles and rest positions. */
  equals(other) {
    const near = 1e-6 * Math.max(...this.rest.map(Math.abs));
    return other === this || (other.rest.length === this.rest.length &&
      other.triangles.length === this.triangles.length &&
      this.triangles.every((v, i) => v === other.triangles[i]) &&
      this.rest.every((x, i) => Math.abs(x - other.rest[i]) <= near));
  }
}

/** For each triangle: the inverse of the matrix of its rest edges in its plane (q0, q1, q2, q3), the larger
 * singular value of this inverse (`reach`), and the area. A triangle without area has q = 0. As in
 * lib/bendlab/metrics/stretch.cpp. */
function restFrames(rest, triangles) {
  const count = triangles.length / 3;
  const inverse = new Float64Array(4 * count), areas = new Float64Array(count), reach = new Float64Array(count);
  for (let t = 0; t < count; ++t) {
    const a = 3 * triangles[3 * t], b = 3 * triangles[3 * t + 1], c = 3 * triangles[3 * t + 2];
    const ux = rest[b] - rest[a], uy = rest[b + 1] - rest[a + 1], uz = rest[b + 2] - rest[a + 2];
    const vx = rest[c] - rest[a], vy = rest[c + 1] - rest[a + 1], vz = rest[c + 2] - rest[a + 2];
    const length = Math.sqrt(ux * ux + uy * uy + uz * uz);
    const along = (ux * vx + uy * vy + uz * vz) / length;
    const hx = vx - along * ux / length, hy = vy - along * uy / length, hz = vz - along * uz / length;
    const height = Math.sqrt(hx * hx + hy * hy + hz * hz);
    areas[t] = length * height / 2;
    if (!(height > 1e-9 * length)) continue;
    // The edges are (length, 0) and (along, height). The inverse of this matrix, column by column
    inverse[4 * t] = 1 / length;
    inverse[4 * t + 2] = -along / (length * height);
    inverse[4 * t + 3] = 1 / height;
    const trace = 1 / length ** 2 + (along / (length * height)) ** 2 + 1 / height ** 2;
    reach[t] = Math.sqrt((trace + Math.sqrt(Math.max(trace ** 2 - 4 / (length * height) ** 2, 0))) / 2);
  }
  return { inverse, areas, reach };
}

function hingesOf(triangles) {
  const open = new Map();
  const vertices = [], faces = [];
  for (let t = 0; t < triangles.length / 3; ++t)
    for (let k = 0; k < 3; ++k) {
      const a = triangles[3 * t + k], b = triangles[3 * t + (k + 1) % 3], c = triangles[3 * t + (k + 2) % 3];
      const key = pairKey(a, b);
      const other = open.get(key);
      if (other === undefined) open.set(key, [a, b, c, t]);
      else {
        vertices.push(other[0], other[1], other[2], c);
        faces.push(other[3], t);
      }
    }
  return { vertices: Uint32Array.from(vertices), faces: Uint32Array.from(faces) };
}

function trianglesAround(triangles, vertices) {
  const first = new Uint32Array(vertices + 1);
  for (const v of triangles) ++first[v + 1];
  for (let v = 0; v < vertices; ++v) first[v + 1] += first[v];
  const next = first.slice(), list = new Uint32Array(triangles.length);
  triangles.forEach((v, i) => { list[next[v]++] = Math.floor(i / 3); });
  return { first, list };
}

/** The map from one rest mesh to another: for each vertex, the nearest triangle and weights of corners. */
export class RestMap {
  /** @param {Mesh} from @param {Mesh} onto */
  constructor(from, onto) {
    this.same = from.equals(onto);
    this.onto = onto;
    if (this.same) return;
    const grid = new TriangleGrid(onto);
    const count = from.vertexCount;
    this.vertexTriangle = new Uint32Array(count);
    this.shares = new Float32Array(3 * count);
    let farthest = 0;
    for (let v = 0; v < count; ++v) {
      const found = grid.nearest(from.rest.subarray(3 * v, 3 * v + 3));
      this.vertexTriangle[v] = found.triangle;
      this.shares.set(found.shares, 3 * v);
      farthest = Math.max(farthest, found.distance);
    }
    this.faceTriangle = Uint32Array.from({ length: from.triangleCount }, (_, t) => {
      const middle = [0, 1, 2].map((c) => [0, 1, 2].reduce((sum, k) =>
        sum + from.rest[3 * from.triangles[3 * t + k] + c] / 3, 0));
      return grid.nearest(middle).triangle;
    });
    this.farthest = farthest; // m; large if the two are not one cloth
  }

  /** The vertex of the other mesh that is nearest to vertex v at rest. */
  vertex(v) {
    if (this.same) return v;
    const shares = this.shares.subarray(3 * v, 3 * v + 3);
    return this.onto.triangles[3 * this.vertexTriangle[v] + shares.indexOf(Math.max(...shares))];
  }

  face(t) {
    return this.same ? t : this.faceTriangle[t];
  }

  /** Writes the position of the other cloth at vertex v to `out` (3). */
  place(v, positions, out) {
    if (this.same) {
      for (let c = 0; c < 3; ++c) out[c] = positions[3 * v + c];
      return;
    }
    const t = 3 * this.vertexTriangle[v];
    for (let c = 0; c < 3; ++c)
      out[c] = [0, 1, 2].reduce((sum, k) =>
        sum + this.shares[3 * v + k] * positions[3 * this.onto.triangles[t + k] + c], 0);
  }
}

/** A grid that lists the triangles in each of its cells, to find the nearest triangle quickly. */
class TriangleGrid {
  constructor(mesh) {
    this.mesh = mesh;
    this.low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    mesh.rest.forEach((x, i) => {
      this.low[i % 3] = Math.min(this.low[i % 3], x);
      high[i % 3] = Math.max(high[i % 3], x);
    });
    const span = Math.hypot(...high.map((x, c) => x - this.low[c])) || 1;
    this.cell = span / Math.max(4, Math.sqrt(mesh.triangleCount));
    this.cells = new Map();
    for (let t = 0; t < mesh.triangleCount; ++t) {
      const corners = [0, 1, 2].map((k) => this.#at(this.#corner(t, k)));
      const from = [0, 1, 2].map((c) => Math.min(...corners.map((p) => p[c])));
      const to = [0, 1, 2].map((c) => Math.max(...corners.map((p) => p[c])));
      for (let x = from[0]; x <= to[0]; ++x)
        for (let y = from[1]; y <= to[1]; ++y)
          for (let z = from[2]; z <= to[2]; ++z) {
            const key = `${x},${y},${z}`;
            if (!this.cells.has(key)) this.cells.set(key, []);
            this.cells.get(key).push(t);
          }
    }
  }

  #corner(t, k) {
    const v = 3 * this.mesh.triangles[3 * t + k];
    return this.mesh.rest.subarray(v, v + 3);
  }

  #at(point) {
    return [0, 1, 2].map((c) => Math.floor((point[c] - this.low[c]) / this.cell));
  }

  /** @returns {{triangle: number, shares: number[], distance: number}} */
  nearest(point) {
    const home = this.#at(point);
    let best = null;
    for (let reach = 0; reach < 64; ++reach) {
      if (best && best.distance <= (reach - 1) * this.cell) break;
      for (let x = -reach; x <= reach; ++x)
        for (let y = -reach; y <= reach; ++y)
          for (let z = -reach; z <= reach; ++z) {
            if (Math.max(Math.abs(x), Math.abs(y), Math.abs(z)) !== reach) continue;
            for (const t of this.cells.get(`${home[0] + x},${home[1] + y},${home[2] + z}`) ?? []) {
              const found = nearestOn(point, this.#corner(t, 0), this.#corner(t, 1), this.#corner(t, 2));
              if (!best || found.distance < best.distance) best = { triangle: t, ...found };
            }
          }
    }
    return best ?? { triangle: 0, shares: [1, 0, 0], distance: Infinity };
  }
}

/** The barycentric coordinates of the point of a triangle that is nearest to p, and its distance from p
 * (Ericson, Real-Time Collision Detection, 5.1.5). */
export function nearestOn(p, a, b, c) {
  const minus = (u, v) => [u[0] - v[0], u[1] - v[1], u[2] - v[2]];
  const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  const ab = minus(b, a), ac = minus(c, a), ap = minus(p, a), bp = minus(p, b), cp = minus(p, c);
  const d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp), d6 = dot(ac, cp);
  const va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  let shares;
  if (d1 <= 0 && d2 <= 0) shares = [1, 0, 0];
  else if (d3 >= 0 && d4 <= d3) shares = [0, 1, 0];
  else if (d6 >= 0 && d5 <= d6) shares = [0, 0, 1];
  else if (vc <= 0 && d1 >= 0 && d3 <= 0) shares = [1 - d1 / (d1 - d3), d1 / (d1 - d3), 0];
  else if (vb <= 0 && d2 >= 0 && d6 <= 0) shares = [1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)];
  else if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const w = (d4 - d3) / (d4 - d3 + d5 - d6);
    shares = [0, 1 - w, w];
  } else {
    const sum = va + vb + vc || 1;
    shares = [va / sum, vb / sum, vc / sum];
  }
  const at = [0, 1, 2].map((i) => shares[0] * a[i] + shares[1] * b[i] + shares[2] * c[i]);
  return { shares, distance: Math.hypot(...minus(p, at)) };
}
