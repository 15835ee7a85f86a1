/** Draws the picked vertex with its springs by ring, and the picked triangle with its principal stretches. */
import { BufferAttribute, BufferGeometry, Points } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";

import { principalDirections, stretchesOf } from "./fields.js";
import { OVER, pointMaterial } from "./view.js";

const LONGER = "#c1121f", SHORTER = "#1d4e89"; // arrows of stretches above and below 1

export class Picked {
  constructor(view) {
    this.view = view;
    this.vertex = null;
    this.triangle = null;
    this.springs = []; // {ring, others: number[]} of the picked vertex
    this.read = true; // whether the springs of the run are read
    this.rings = view.colours.rings;
    this.lines = this.#lines(2.2);
    this.arrows = this.#lines(2.4);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(3), 3));
    geometry.setAttribute("wide", new BufferAttribute(Float32Array.of(9), 1));
    this.mark = new Points(geometry, pointMaterial("#c1121f"));
    this.mark.frustumCulled = false;
    this.mark.layers.set(OVER);
    this.mark.visible = false;
    view.scene.add(this.mark);
  }

  #lines(width) {
    const drawn = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({
      vertexColors: true, linewidth: width, transparent: true, depthTest: false, toneMapped: false }));
    drawn.onBeforeRender = () => {}; // resize() sets the resolution, because a view is not the whole canvas
    drawn.frustumCulled = false;
    drawn.layers.set(OVER);
    drawn.visible = false;
    drawn.renderOrder = 5;
    this.view.scene.add(drawn);
    return drawn;
  }

  /**
   * @param {number|null} vertex @param {number|null} triangle @param {object[]|null} springs see springsOf(); null:
   * the springs are being read
   */
  set(vertex, triangle, springs) {
    this.vertex = vertex;
    this.triangle = triangle;
    this.springs = springs ?? [];
    this.read = springs !== null;
    this.moved();
  }

  /** Call it after the cloth has moved. */
  moved() {
    this.#drawVertex();
    this.#drawTriangle();
  }

  #drawVertex() {
    this.mark.visible = this.vertex !== null;
    this.lines.visible = this.vertex !== null && this.springs.length > 0;
    if (this.vertex === null) return;
    const { positions } = this.view.cloth;
    const at = [...positions.subarray(3 * this.vertex, 3 * this.vertex + 3)];
    this.mark.geometry.getAttribute("position").array.set(at);
    this.mark.geometry.getAttribute("position").needsUpdate = true;
    if (!this.springs.length) return;
    const places = [], colours = [];
    for (const { ring, others } of this.springs.toReversed()) { // the nearest ring on top
      const colour = rgb(this.rings[(ring - 1 + this.rings.length) % this.rings.length]);
      for (const other of others) {
        places.push(...at, ...positions.subarray(3 * other, 3 * other + 3));
        colours.push(...colour, ...colour);
      }
    }
    fill(this.lines, places, colours);
  }

  #drawTriangle() {
    this.arrows.visible = this.triangle !== null;
    if (this.triangle === null) return;
    const { mesh, cloth: { positions } } = this.view;
    const corners = [0, 1, 2].map((k) => {
      const v = 3 * mesh.triangles[3 * this.triangle + k];
      return [...positions.subarray(v, v + 3)];
    });
    const middle = [0, 1, 2].map((c) => (corners[0][c] + corners[1][c] + corners[2][c]) / 3);
    const places = [], colours = [];
    const line = (a, b, colour) => { places.push(...a, ...b); colours.push(...colour, ...colour); };
    for (let k = 0; k < 3; ++k) line(corners[k], corners[(k + 1) % 3], rgb("#1f2429"));
    // The length of an arrow at stretch 1: long enough to be visible on small triangles
    const unit = Math.max(0.09 * this.view.size, 2 * Math.sqrt(mesh.frames.areas[this.triangle]));
    const stretches = stretchesOf(mesh, positions, this.triangle);
    const directions = principalDirections(mesh, positions, this.triangle);
    directions.forEach((direction, i) => {
      const colour = rgb(stretches[i] >= 1 ? LONGER : SHORTER);
      const half = direction.map((x) => 0.5 * unit * x);
      const across = directions[1 - i].map((x) => 0.5 * unit * x / (stretches[1 - i] || 1));
      for (const way of [1, -1]) {
        const tip = middle.map((x, c) => x + way * half[c]);
        line(middle, tip, colour);
        // Arrow heads point outward if the cloth is stretched, inward if it is compressed
        const inward = stretches[i] >= 1 ? 0.78 : 1.22;
        for (const side of [1, -1])
          line(tip, middle.map((x, c) => x + way * inward * half[c] + side * 0.13 * across[c]), colour);
      }
    });
    fill(this.arrows, places, colours);
  }

  /** Gives the lines the size of the picture, in pixels. */
  resize(width, height, ratio) {
    for (const drawn of [this.lines, this.arrows]) drawn.material.resolution.set(width / ratio, height / ratio);
    this.mark.material.uniforms.ratio.value = ratio;
  }
}

/** The sRGB values of a colour, without the colour management of three.js. */
function rgb(hex) {
  return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
}

function fill(drawn, places, colours) {
  drawn.geometry.dispose();
  drawn.geometry = new LineSegmentsGeometry();
  drawn.geometry.setPositions(places);
  drawn.geometry.setColors(colours);
}

/**
 * The constraints that act on a vertex, by ring: the number of edges to a constraint's farthest vertex.
 * @param {Array<{columns: number, vertices: Uint32Array}>} kinds
 * @returns {Array<{ring: number, others: number[], count: number}>}
 */
export function springsOf(mesh, kinds, vertex) {
  const rings = mesh.ringsFrom(vertex);
  const found = new Map();
  for (const { columns, vertices } of kinds)
    for (let i = 0; i < vertices.length; i += columns) {
      let here = false;
      for (let c = 0; c < columns; ++c) here ||= vertices[i + c] === vertex;
      if (!here) continue;
      const others = [...vertices.subarray(i, i + columns)].filter((v) => v !== vertex);
      const ring = Math.max(...others.map((v) => rings[v]));
      const entry = found.get(ring) ?? { ring, others: [], count: 0 };
      entry.others.push(...others);
      entry.count += 1;
      found.set(ring, entry);
    }
  return [...found.values()].sort((a, b) => a.ring - b.ring);
}
