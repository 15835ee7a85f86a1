// Compares the colour fields of the player with closed forms, without a browser.
import assert from "node:assert/strict";
import test from "node:test";
import { distances, FIELDS, principalDirections, stretchesOf, stretchUncertainty } from "../../../analysis/viewer/src/player/fields.js";
import { Mesh, nearestOn, RestMap } from "../../../analysis/viewer/src/player/mesh.js";

/** A sheet of equilateral triangles with sides of `side` m, n by n vertices. */
function lattice(n, side) {
  const rest = [], triangles = [];
  for (let y = 0; y < n; ++y)
    for (let x = 0; x < n; ++x) rest.push(side * (x + (y % 2) / 2), side * y * Math.sqrt(3) / 2, 0);
  for (let y = 0; y + 1 < n; ++y)
    for (let x = 0; x + 1 < n; ++x) {
      const a = y * n + x, b = a + 1, c = a + n, d = c + 1;
      triangles.push(...(y % 2 ? [a, b, d, a, d, c] : [a, b, c, b, d, c]));
    }
  return new Mesh(Float32Array.from(rest), Uint32Array.from(triangles));
}

const bent = (mesh, change) => Float32Array.from({ length: mesh.rest.length }, (_, i) =>
  change(...mesh.rest.subarray(3 * Math.floor(i / 3), 3 * Math.floor(i / 3) + 3))[i % 3]);
const near = (actual, wanted, off, text = "") => assert.ok(Math.abs(actual - wanted) <= off, `${text} ${actual}, not ${wanted}`);

test("stretches of an affine map are its singular values, also after a rotation", () => {
  const mesh = lattice(5, 0.1), turn = 0.7;
  const positions = bent(mesh, (x, y) => {
    const [u, v] = [1.3 * x, 0.6 * y];
    return [5 + u * Math.cos(turn), v, u * Math.sin(turn)];
  });
  for (let t = 0; t < mesh.triangleCount; ++t) {
    const [largest, smallest] = stretchesOf(mesh, positions, t);
    near(largest, 1.3, 2e-5);
    near(smallest, 0.6, 2e-5);
    const [first, second] = principalDirections(mesh, positions, t);
    near(Math.hypot(...first), 1.3, 2e-5);
    near(Math.abs(first[1]), 0, 1e-4);
    near(Math.abs(second[1]), 0.6, 2e-5);
  }
  near(FIELDS.stretch(mesh, positions)[0], 0.3, 2e-5);
  near(FIELDS.strain(mesh, positions)[0], 0.4, 2e-5);
});

test("rounding of positions changes a stretch by less than the stated uncertainty", () => {
  const mesh = lattice(6, 0.1), step = 1e-3;
  let seed = 1;
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647 - 0.5;
  for (let turn = 0; turn < 200; ++turn) {
    const positions = mesh.rest.map((x) => x + step * random());
    for (let t = 0; t < mesh.triangleCount; ++t)
      near(stretchesOf(mesh, positions, t)[0], 1, stretchUncertainty(mesh, t, step));
  }
});

test("the quality of an equilateral triangle is 1, of a flat one 0, of a right isosceles one √3 / 2", () => {
  const mesh = lattice(3, 0.1);
  near(FIELDS.quality(mesh, mesh.rest)[0], 1, 1e-5);
  const right = new Mesh(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), Uint32Array.of(0, 1, 2));
  near(FIELDS.quality(right, right.rest)[0], Math.sqrt(3) / 2, 1e-6);
  near(FIELDS.quality(right, Float32Array.of(0, 0, 0, 1, 0, 0, 2, 0, 0))[0], 0, 1e-6);
});

test("a sheet that is bent to a cylinder, in either direction, has the bending energy ½ κ²", () => {
  const n = 41, mesh = lattice(n, 0.02);
  for (const [radius, sign] of [[0.4, 1], [0.8, -1]]) {
    const positions = bent(mesh, (x, y) => [radius * Math.sin(x / radius), y, sign * radius * (1 - Math.cos(x / radius))]);
    const density = FIELDS.bending(mesh, positions);
    let sum = 0, count = 0;
    for (let t = 0; t < density.length; ++t) {
      const [a] = mesh.triangles.subarray(3 * t);
      if ([a % n, Math.floor(a / n)].some((k) => k < 3 || k > n - 5)) continue; // fewer hinges at the edge
      sum += density[t];
      ++count;
    }
    near(sum / count * 2 * radius * radius, 1, 0.01, "½ κ²");
  }
  assert.ok(FIELDS.bending(mesh, mesh.rest).every((x) => x === 0));
});

test("the distance to the nearest point of a triangle", () => {
  const corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0]];
  near(nearestOn([0.2, 0.3, 2], ...corners).distance, 2, 1e-12);
  near(nearestOn([-1, -1, 0], ...corners).distance, Math.SQRT2, 1e-12);
  near(nearestOn([1, 1, 0], ...corners).distance, Math.SQRT1_2, 1e-12);
  near(nearestOn([0.5, -3, 4], ...corners).distance, 5, 1e-12);
});

test("the distance between cloths of different meshes", () => {
  const [coarse, fine] = [lattice(9, 0.1), lattice(17, 0.05)];
  const map = new RestMap(coarse, fine);
  assert.equal(map.same, false);
  const moved = bent(fine, (x, y) => [x + 0.3, y, 0.4]);
  // Only where both meshes exist: the fine mesh ends half a side earlier on the right.
  const inside = [...distances(coarse.rest, map, moved)].filter((_, v) => v % 9 < 8);
  for (const distance of inside) near(distance, 0.5, 1e-5);
  assert.equal(new RestMap(coarse, lattice(9, 0.1)).same, true);
});

test("rings count edges", () => {
  const mesh = lattice(7, 0.1);
  const rings = mesh.ringsFrom(3 * 7 + 3);
  assert.equal(rings[3 * 7 + 3], 0);
  assert.equal([...rings].filter((ring) => ring === 1).length, 6);
  assert.equal([...rings].filter((ring) => ring === 2).length, 12);
});
