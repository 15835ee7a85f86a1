/**
 * The moving surface of one run, in three forms. Fine: triangles share no corner, so that each has a colour
 * and lines. Quick: triangles share all corners except the last corner, which gives the colour. Shadow:
 * triangles share all corners. Without a graphics card, the number of corners determines the time.
 */
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh as Drawn, Sphere, Vector3 } from "three";

import { clothMaterial, quickClothMaterial } from "./shading.js";

export class Cloth {
  /** @param {import("./mesh.js").Mesh} mesh */
  constructor(mesh, light, colours) {
    this.mesh = mesh;
    this.positions = new Float32Array(3 * mesh.vertexCount);
    this.normals = new Float32Array(3 * mesh.vertexCount);
    this.material = clothMaterial(light, colours);
    this.quickMaterial = quickClothMaterial(this.material);
    this.corners = { fine: { vertices: mesh.triangles, drawn: null }, quick: { drawn: null } };
    const solid = new BufferGeometry();
    solid.setAttribute("position", new BufferAttribute(this.positions, 3).setUsage(DynamicDrawUsage));
    solid.setIndex(new BufferAttribute(mesh.triangles, 1));
    this.caster = neverCulled(solid, this.material);
    this.values = null;
    this.turn = {};
  }

  /** Shows the fine or the quick surface and hides the other surface. @param {import("three").Scene} scene */
  use(quick, scene) {
    const kind = quick ? "quick" : "fine", part = this.corners[kind];
    if (!part.drawn) {
      if (quick) Object.assign(part, sharedCorners(this.mesh));
      part.drawn = neverCulled(emptyGeometry(part), quick ? this.quickMaterial : this.material);
      scene.add(part.drawn);
    }
    for (const each of Object.values(this.corners)) if (each.drawn) each.drawn.visible = each === part;
    if (part.moved !== this.turn) {
      part.moved = this.turn;
      spread(part, "position", this.positions);
      spread(part, "normal", this.normals);
    }
    if (part.coloured !== this.values) {
      part.coloured = this.values;
      if (this.values) this.#spreadValues(part, quick);
    }
  }

  /** Call it after `positions` have changed. */
  moved() {
    vertexNormals(this.positions, this.mesh.triangles, this.normals);
    for (const attribute of Object.values(this.caster.geometry.attributes)) attribute.needsUpdate = true;
    this.turn = {};
  }

  /** A surface with normals that other views may draw. */
  get shared() {
    const { geometry } = this.caster;
    if (!geometry.getAttribute("normal"))
      geometry.setAttribute("normal", new BufferAttribute(this.normals, 3).setUsage(DynamicDrawUsage));
    return geometry;
  }

  /** Colours the cloth by values of triangles (T), or of vertices (V) if `smooth`; null: no colours. */
  colour(values, smooth = false) {
    this.material.uniforms.coloured.value = Boolean(values);
    this.values = values ? { values, smooth } : null;
  }

  #spreadValues(part, quick) {
    const { values, smooth } = this.values, { triangles } = this.mesh;
    const attribute = part.drawn.geometry.getAttribute("value"), to = attribute.array;
    if (quick) {
      for (let t = 0; t < this.mesh.triangleCount; ++t)
        to[t] = smooth ? (values[triangles[3 * t]] + values[triangles[3 * t + 1]] + values[triangles[3 * t + 2]]) / 3
          : values[t];
    } else if (smooth) for (let i = 0; i < to.length; ++i) to[i] = values[triangles[i]];
    else for (let i = 0; i < to.length; ++i) to[i] = values[(i / 3) | 0];
    attribute.needsUpdate = true;
  }

  dispose() {
    for (const { drawn } of Object.values(this.corners)) drawn?.geometry.dispose();
    this.caster.geometry.dispose();
    this.material.dispose();
    this.quickMaterial.dispose();
  }
}

function neverCulled(geometry, material) {
  geometry.boundingSphere = new Sphere(new Vector3(), Infinity);
  const drawn = new Drawn(geometry, material);
  drawn.frustumCulled = false;
  return drawn;
}

function emptyGeometry({ vertices, index }) {
  const geometry = new BufferGeometry();
  for (const [name, size] of [["position", 3], ["normal", 3], ["value", 1]])
    geometry.setAttribute(name,
      new BufferAttribute(new Float32Array(size * vertices.length), size).setUsage(DynamicDrawUsage));
  if (index) geometry.setIndex(new BufferAttribute(index, 1));
  return geometry;
}

/** Corner t is the last corner of triangle t and gives this triangle its colour. Other corners are shared. */
function sharedCorners({ triangles, triangleCount, vertexCount }) {
  const last = new Uint32Array(triangleCount), corner = new Int32Array(vertexCount).fill(-1);
  for (let t = 0; t < triangleCount; ++t) {
    let k = 0;
    while (k < 2 && corner[triangles[3 * t + k]] >= 0) ++k;
    last[t] = k;
    if (corner[triangles[3 * t + k]] < 0) corner[triangles[3 * t + k]] = t;
  }
  const vertices = Array.from(last, (k, t) => triangles[3 * t + k]);
  corner.forEach((at, v) => { if (at < 0) corner[v] = vertices.push(v) - 1; });
  const index = new Uint32Array(3 * triangleCount);
  for (let t = 0; t < triangleCount; ++t) {
    index[3 * t] = corner[triangles[3 * t + (last[t] + 1) % 3]];
    index[3 * t + 1] = corner[triangles[3 * t + (last[t] + 2) % 3]];
    index[3 * t + 2] = t;
  }
  return { vertices: Uint32Array.from(vertices), index };
}

function spread({ vertices, drawn }, name, from) {
  const attribute = drawn.geometry.getAttribute(name), to = attribute.array;
  for (let i = 0, j = 0; i < vertices.length; ++i, j += 3) {
    const v = 3 * vertices[i];
    to[j] = from[v];
    to[j + 1] = from[v + 1];
    to[j + 2] = from[v + 2];
  }
  attribute.needsUpdate = true;
}

/** (V · 3) area-weighted unit normals. */
export function vertexNormals(positions, triangles, normals) {
  normals.fill(0);
  for (let i = 0; i < triangles.length; i += 3) {
    const a = 3 * triangles[i], b = 3 * triangles[i + 1], c = 3 * triangles[i + 2];
    const ux = positions[b] - positions[a], uy = positions[b + 1] - positions[a + 1],
      uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a], vy = positions[c + 1] - positions[a + 1],
      vz = positions[c + 2] - positions[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    normals[a] += x; normals[a + 1] += y; normals[a + 2] += z;
    normals[b] += x; normals[b + 1] += y; normals[b + 2] += z;
    normals[c] += x; normals[c + 1] += y; normals[c + 2] += z;
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.sqrt(normals[i] ** 2 + normals[i + 1] ** 2 + normals[i + 2] ** 2) || 1;
    normals[i] /= length; normals[i + 1] /= length; normals[i + 2] /= length;
  }
}

/** The nearest triangle that a ray meets, from either side (Möller and Trumbore); null without a triangle. */
export function pickedTriangle(origin, direction, positions, triangles) {
  let best = null;
  for (let i = 0; i < triangles.length; i += 3) {
    const a = 3 * triangles[i], b = 3 * triangles[i + 1], c = 3 * triangles[i + 2];
    const ux = positions[b] - positions[a], uy = positions[b + 1] - positions[a + 1],
      uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a], vy = positions[c + 1] - positions[a + 1],
      vz = positions[c + 2] - positions[a + 2];
    const px = direction[1] * vz - direction[2] * vy, py = direction[2] * vx - direction[0] * vz,
      pz = direction[0] * vy - direction[1] * vx;
    const determinant = ux * px + uy * py + uz * pz;
    if (determinant === 0) continue;
    const tx = origin[0] - positions[a], ty = origin[1] - positions[a + 1], tz = origin[2] - positions[a + 2];
    const u = (tx * px + ty * py + tz * pz) / determinant;
    if (u < 0 || u > 1) continue;
    const qx = ty * uz - tz * uy, qy = tz * ux - tx * uz, qz = tx * uy - ty * ux;
    const v = (direction[0] * qx + direction[1] * qy + direction[2] * qz) / determinant;
    if (v < 0 || u + v > 1) continue;
    const far = (vx * qx + vy * qy + vz * qz) / determinant;
    if (far > 0 && (!best || far < best.far)) best = { triangle: i / 3, far, shares: [1 - u - v, u, v] };
  }
  return best;
}
