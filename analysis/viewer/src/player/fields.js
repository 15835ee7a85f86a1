/**
 * Quantities of a frame, computed from its positions: per triangle (T) or per vertex (V).
 * The definitions are those of the program: lib/bendlab/metrics/stretch.hpp, lib/bendlab/mesh/quality.hpp,
 * lib/bendlab/bending/models/discrete_shells.cpp.
 */

/** Principal stretches of a triangle; both are 1 for a triangle without area at rest. */
export function stretchesOf(mesh, positions, t) {
  const { inverse } = mesh.frames;
  const { triangles } = mesh;
  const q0 = inverse[4 * t], q2 = inverse[4 * t + 2], q3 = inverse[4 * t + 3];
  if (q3 === 0) return [1, 1];
  const a = 3 * triangles[3 * t], b = 3 * triangles[3 * t + 1], c = 3 * triangles[3 * t + 2];
  const ex = positions[b] - positions[a], ey = positions[b + 1] - positions[a + 1],
    ez = positions[b + 2] - positions[a + 2];
  const gx = positions[c] - positions[a], gy = positions[c + 1] - positions[a + 1],
    gz = positions[c + 2] - positions[a + 2];
  const fx = ex * q0, fy = ey * q0, fz = ez * q0;
  const hx = ex * q2 + gx * q3, hy = ey * q2 + gy * q3, hz = ez * q2 + gz * q3;
  const s11 = fx * fx + fy * fy + fz * fz, s22 = hx * hx + hy * hy + hz * hz, s12 = fx * hx + fy * hy + fz * hz;
  const largest = Math.sqrt(0.5 * (s11 + s22 + Math.sqrt((s11 - s22) ** 2 + 4 * s12 * s12)));
  const nx = fy * hz - fz * hy, ny = fz * hx - fx * hz, nz = fx * hy - fy * hx;
  return [largest, largest > 0 ? Math.sqrt(nx * nx + ny * ny + nz * nz) / largest : 0];
}

/** Directions in space of the two principal stretches, each as long as its stretch. */
export function principalDirections(mesh, positions, t) {
  const { inverse } = mesh.frames;
  const [a, b, c] = [0, 1, 2].map((k) => 3 * mesh.triangles[3 * t + k]);
  const q0 = inverse[4 * t], q2 = inverse[4 * t + 2], q3 = inverse[4 * t + 3];
  const f = [0, 1, 2].map((i) => (positions[b + i] - positions[a + i]) * q0);
  const h = [0, 1, 2].map((i) => (positions[b + i] - positions[a + i]) * q2 +
    (positions[c + i] - positions[a + i]) * q3);
  const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
  const angle = 0.5 * Math.atan2(2 * dot(f, h), dot(f, f) - dot(h, h));
  return [angle, angle + Math.PI / 2].map((turn) =>
    [0, 1, 2].map((i) => f[i] * Math.cos(turn) + h[i] * Math.sin(turn)));
}

/** Largest error of a principal stretch because positions are rounded to multiples of `step`. */
export function stretchUncertainty(mesh, t, step) {
  // The error of an edge vector is at most √3 step: half a step at each end, on three axes. E is the matrix
  // of the two edge vectors, so |δE| ≤ √6 step. With Q, the inverse of E at rest, a singular value of E Q
  // changes by at most |δE| |Q|.
  return Math.sqrt(6) * step * mesh.frames.reach[t];
}

const perTriangle = (mesh, value) => {
  const values = new Float32Array(mesh.triangleCount);
  for (let t = 0; t < values.length; ++t) values[t] = value(t);
  return values;
};

function shapeOf(mesh, positions, t) {
  const { triangles } = mesh;
  const a = 3 * triangles[3 * t], b = 3 * triangles[3 * t + 1], c = 3 * triangles[3 * t + 2];
  const ux = positions[b] - positions[a], uy = positions[b + 1] - positions[a + 1],
    uz = positions[b + 2] - positions[a + 2];
  const vx = positions[c] - positions[a], vy = positions[c + 1] - positions[a + 1],
    vz = positions[c + 2] - positions[a + 2];
  const uu = ux * ux + uy * uy + uz * uz, vv = vx * vx + vy * vy + vz * vz, uv = ux * vx + uy * vy + uz * vz;
  const area = Math.sqrt(Math.max(uu * vv - uv * uv, 0)) / 2;
  const sum = uu + vv + (uu + vv - 2 * uv);
  return sum > 0 ? 4 * Math.sqrt(3) * area / sum : 0;
}

/** (E) signed angle between the two triangles of each hinge, radians; 0 for a flat hinge. */
function hingeAngles(vertices, positions) {
  const angles = new Float64Array(vertices.length / 4);
  for (let e = 0, i = 0; e < angles.length; ++e, i += 4) {
    const a = 3 * vertices[i], b = 3 * vertices[i + 1], c = 3 * vertices[i + 2], d = 3 * vertices[i + 3];
    const ax = positions[a], ay = positions[a + 1], az = positions[a + 2];
    const ex = positions[b] - ax, ey = positions[b + 1] - ay, ez = positions[b + 2] - az;
    const cx = positions[c] - ax, cy = positions[c + 1] - ay, cz = positions[c + 2] - az;
    const dx = positions[d] - ax, dy = positions[d + 1] - ay, dz = positions[d + 2] - az;
    const mx = ey * cz - ez * cy, my = ez * cx - ex * cz, mz = ex * cy - ey * cx; // e × c
    const nx = dy * ez - dz * ey, ny = dz * ex - dx * ez, nz = dx * ey - dy * ex; // d × e
    const kx = my * nz - mz * ny, ky = mz * nx - mx * nz, kz = mx * ny - my * nx;
    const length = Math.sqrt(ex * ex + ey * ey + ez * ez) || 1;
    angles[e] = Math.atan2((kx * ex + ky * ey + kz * ez) / length, mx * nx + my * ny + mz * nz);
  }
  return angles;
}

/** Per hinge: the rest angle θ0 and the weight w = edge² / (2 · area) of its energy E = D w (θ - θ0)². */
function restHinges(mesh) {
  if (mesh._restHinges) return mesh._restHinges;
  const { vertices, faces } = mesh.hinges;
  const weights = new Float64Array(faces.length / 2);
  for (let e = 0; e < weights.length; ++e) {
    const a = 3 * vertices[4 * e], b = 3 * vertices[4 * e + 1];
    const squared = [0, 1, 2].reduce((sum, c) => sum + (mesh.rest[a + c] - mesh.rest[b + c]) ** 2, 0);
    const area = mesh.frames.areas[faces[2 * e]] + mesh.frames.areas[faces[2 * e + 1]];
    weights[e] = area > 0 ? squared / (2 * area) : 0;
  }
  mesh._restHinges = { weights, angles: hingeAngles(vertices, mesh.rest) };
  return mesh._restHinges;
}

function bendingOf(mesh, positions) {
  const { vertices, faces } = mesh.hinges;
  const rest = restHinges(mesh);
  const angles = hingeAngles(vertices, positions);
  const density = new Float32Array(mesh.triangleCount);
  for (let e = 0; e < angles.length; ++e) {
    let turn = angles[e] - rest.angles[e];
    if (turn > Math.PI) turn -= 2 * Math.PI;
    if (turn < -Math.PI) turn += 2 * Math.PI;
    const energy = rest.weights[e] * turn * turn;
    density[faces[2 * e]] += energy / 2;
    density[faces[2 * e + 1]] += energy / 2;
  }
  for (let t = 0; t < density.length; ++t)
    density[t] = mesh.frames.areas[t] > 0 ? density[t] / mesh.frames.areas[t] : NaN;
  return density;
}

/** Key of a quantity → (T) values of a frame. */
export const FIELDS = {
  stretch: (mesh, positions) => perTriangle(mesh, (t) => stretchesOf(mesh, positions, t)[0] - 1),
  strain: (mesh, positions) => perTriangle(mesh, (t) => {
    const [s1, s2] = stretchesOf(mesh, positions, t);
    return Math.max(Math.abs(s1 - 1), Math.abs(s2 - 1));
  }),
  quality: (mesh, positions) => perTriangle(mesh, (t) => shapeOf(mesh, positions, t)),
  bending: bendingOf,
};

/** (V) distance in m between two cloths, at points that coincide at rest. */
export function distances(positions, map, others) {
  const values = new Float32Array(positions.length / 3), place = [0, 0, 0];
  for (let v = 0; v < values.length; ++v) {
    map.place(v, others, place);
    values[v] = Math.hypot(positions[3 * v] - place[0], positions[3 * v + 1] - place[1],
                           positions[3 * v + 2] - place[2]);
  }
  return values;
}

/** (T) values minus the values of another cloth. */
export function differences(values, map, others) {
  return values.map((value, t) => value - others[map.face(t)]);
}
