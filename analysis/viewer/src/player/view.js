/** One run in its view: cloth, obstacles, floor, pins, and the picked vertex and triangle. */
import { BufferAttribute, BufferGeometry, Color, DepthTexture, GLSL3, LessEqualCompare,
         Matrix4, Mesh as Drawn, NearestFilter, LinearFilter, OrthographicCamera, PlaneGeometry, Points, Scene, ShaderMaterial,
         UnsignedIntType, Vector3, WebGLRenderTarget } from "three";

import { Cloth, vertexNormals } from "./cloth.js";
import { Mesh } from "./mesh.js";
import { newCamera, Orbit } from "./orbit.js";
import { Picked } from "./picked.js";
import { floorMaterial, ghostMaterial, lighting, obstacleMaterial, shadowMaterial } from "./shading.js";

const CASTS = 1; // layer of the objects that throw a shadow
export const OVER = 2; // layer of marks, drawn after the cloth

export class View {
  /** @param {object} run of the page's data @param {import("./decode.js").Frames} frames */
  constructor(run, frames, colours) {
    this.run = run;
    this.frames = frames;
    this.colours = colours;
    this.mesh = new Mesh(frames.rest, frames.triangles);
    this.size = frames.head.size;
    this.middle = middleOf(frames.rest);
    this.anchor = { centre: this.middle, size: this.size }; // of the camera, see anchorViews()
    this.orbit = new Orbit();
    this.camera = newCamera();
    this.light = lighting(colours);
    this.light.size.value = this.size;
    this.scene = new Scene();
    this.cloth = new Cloth(this.mesh, this.light, colours);
    this.cloth.caster.layers.set(CASTS);
    this.scene.add(this.cloth.caster);
    this.#addObstacles();
    this.#addFloor();
    this.#addPins();
    this.#addShadow();
    this.picked = new Picked(this);
    this.frame = -1;
    this.shadowDue = true;
  }

  #addObstacles() {
    const material = this.frames.obstacles.length ? obstacleMaterial(this.light, this.colours) : null;
    this.obstacles = this.frames.obstacles.map(({ points, triangles, velocity }) => {
      const normals = vertexNormalsOf(points, triangles);
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(points, 3));
      geometry.setAttribute("normal", new BufferAttribute(normals, 3));
      geometry.setIndex(new BufferAttribute(triangles, 1));
      const drawn = new Drawn(geometry, material);
      drawn.frustumCulled = false;
      drawn.layers.enable(CASTS);
      this.scene.add(drawn);
      return { drawn, velocity };
    });
  }

  #addFloor() {
    const { floor, box } = this.frames.head;
    const height = floor ?? box[0][2] - 0.06 * this.size;
    this.floor = new Drawn(new PlaneGeometry(2, 2), floorMaterial(this.light));
    this.floor.position.z = height;
    this.floor.frustumCulled = false;
    this.floor.material.uniforms.middle.value.set(...[0, 1].map((c) => (box[0][c] + box[1][c]) / 2), height);
    this.scene.add(this.floor);
  }

  #addPins() {
    const { pinned, seeds } = this.frames;
    const named = new Set(seeds);
    const shown = [...pinned].sort((a, b) => named.has(a) - named.has(b));
    this.pins = Uint32Array.from(shown);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * shown.length), 3));
    geometry.setAttribute("wide", new BufferAttribute(
      Float32Array.from(shown, (v) => shown.length > 40 ? 3.5 : !named.has(v) ? 4.5 : seeds.length > 8 ? 6 : 8), 1));
    this.pinMarks = new Points(geometry, pointMaterial("#1f2429"));
    this.pinMarks.frustumCulled = false;
    this.pinMarks.layers.set(OVER);
    this.scene.add(this.pinMarks);
  }

  #addShadow() {
    this.shadowCamera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
    this.shadowCamera.layers.set(CASTS);
    this.shadowMaterial = shadowMaterial();
    this.light.shadowMatrix.value = new Matrix4();
  }

  #shadowTargetOf(pixels) {
    if (this.shadowTarget?.width === pixels) return this.shadowTarget;
    this.shadowTarget?.depthTexture.dispose();
    this.shadowTarget?.dispose();
    const depth = new DepthTexture(pixels, pixels, UnsignedIntType);
    depth.compareFunction = LessEqualCompare;
    depth.magFilter = depth.minFilter = LinearFilter;
    this.shadowTarget = new WebGLRenderTarget(pixels, pixels, { depthTexture: depth, minFilter: NearestFilter,
      magFilter: NearestFilter });
    this.light.shadowMap.value = depth;
    return this.shadowTarget;
  }

  /** Fits the shadow map to the present shape of the cloth, so that no texel is wasted. */
  #aimShadow() {
    const toLight = new Vector3(...this.colours.light);
    const { low, high } = roughBox(this.cloth.positions);
    const centre = low.map((x, c) => (x + high[c]) / 2);
    const reach = Math.max(0.57 * Math.hypot(...high.map((x, c) => x - low[c])), 0.05 * this.size);
    const camera = this.shadowCamera;
    const far = 20 * reach;
    camera.position.set(...centre).addScaledVector(toLight, far / 2);
    camera.up.set(0, 1, 0);
    camera.lookAt(new Vector3(...centre));
    Object.assign(camera, { left: -reach, right: reach, bottom: -reach, top: reach, near: 0, far });
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    this.light.shadowMatrix.value.set(0.5, 0, 0, 0.5, 0, 0.5, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0, 1)
      .multiply(camera.projectionMatrix).multiply(camera.matrixWorldInverse);
    // The floor is drawn only where the shadow falls
    const away = (this.floor.position.z - centre[2]) / toLight.z;
    this.floor.position.setX(centre[0] + away * toLight.x).setY(centre[1] + away * toLight.y);
    this.floor.scale.set(reach * 1.1 / toLight.z, reach * 1.1 / toLight.z, 1);
    // The soft edge of the shadow has a fixed width, relative to the size of the cloth
    this.light.shadowTexel.value = 0.0042 * this.size / (2 * reach) * 0.6;
  }

  /** Shows the frame at a time. Returns whether another frame was shown before. */
  goTo(time) {
    const frame = this.frames.frameAt(time);
    if (frame === this.frame) return false;
    this.frame = frame;
    this.frames.positions(frame, this.cloth.positions);
    this.cloth.moved();
    for (const { drawn, velocity } of this.obstacles)
      drawn.position.set(...velocity.map((v) => v * this.frames.times[frame]));
    const marks = this.pinMarks.geometry.getAttribute("position");
    this.pins.forEach((v, i) => marks.array.set(this.cloth.positions.subarray(3 * v, 3 * v + 3), 3 * i));
    marks.needsUpdate = true;
    this.picked.moved();
    this.shadowDue = true;
    return true;
  }

  get time() {
    return this.frames.times[this.frame];
  }

  /** Also shows the cloth of another run, transparent; null: only the cloth of this run. */
  overlay(other) {
    if (this.ghost) this.scene.remove(this.ghost);
    this.ghost = null;
    if (!other || other === this) return;
    this.ghostMaterial ??= ghostMaterial(this.light);
    this.ghost = new Drawn(other.cloth.shared, this.ghostMaterial);
    this.ghost.frustumCulled = false;
    this.ghost.renderOrder = 2;
    this.scene.add(this.ghost);
  }

  /** The positions, in m, of some vertices in some frames, which the camera should show. */
  sample() {
    const points = [], last = this.frames.decoded - 1;
    const frames = new Set([0, this.frame, ...[0.2, 0.4, 0.6, 0.8, 1].map((share) => Math.round(share * last))]);
    const stride = Math.max(1, Math.floor(this.mesh.vertexCount / 600));
    const at = new Float32Array(3 * this.mesh.vertexCount);
    for (const frame of frames) {
      if (frame < 0 || frame > last) continue;
      this.frames.positions(frame, at);
      for (let i = 0; i < at.length; i += 3 * stride) {
        const away = Math.hypot(at[i] - this.middle[0], at[i + 1] - this.middle[1], at[i + 2] - this.middle[2]);
        if (away < 1.6 * this.size) points.push(at[i], at[i + 1], at[i + 2]); // other points have flown away
      }
    }
    return points;
  }

  /** @param {number} pixels on each side of the shadow map; 0: no shadow */
  drawShadow(renderer, pixels) {
    this.light.shadowed.value = pixels > 0;
    if (!pixels) return;
    if (!this.shadowDue && this.shadowTarget?.width === pixels) return;
    if (this.shadowDue) this.#aimShadow();
    renderer.setRenderTarget(this.#shadowTargetOf(pixels));
    renderer.setScissorTest(false);
    renderer.clear();
    this.scene.overrideMaterial = this.shadowMaterial;
    renderer.render(this.scene, this.shadowCamera);
    this.scene.overrideMaterial = null;
    this.shadowDue = false;
  }

  dispose() {
    this.cloth.dispose();
    this.shadowTarget?.depthTexture.dispose();
    this.shadowTarget?.dispose();
    this.shadowMaterial.dispose();
    this.overlay(null); // the overlay's geometry belongs to another view
    this.scene.traverse((node) => { node.geometry?.dispose(); node.material?.dispose?.(); });
  }
}

/**
 * Sets the centre and size for the lengths of each camera. Views whose cloth has the same size and place at
 * rest share a centre and size, so that linked cameras show the same part of each cloth.
 * @returns {number[][]} for each view the points that its camera should show, in sizes from the centre
 */
export function anchorViews(views) {
  const groups = [];
  for (const view of views) {
    const home = groups.find(([first]) => Math.abs(first.size / view.size - 1) < 0.01 &&
      Math.hypot(...first.middle.map((x, c) => x - view.middle[c])) < 0.01 * view.size);
    if (home) home.push(view);
    else groups.push([view]);
  }
  const shown = new Map();
  for (const group of groups) {
    const points = group.map((view) => view.sample());
    const { low, high } = boxOf(points.flat());
    const anchor = { centre: low.map((x, c) => (x + high[c]) / 2),
                     size: Math.hypot(...high.map((x, c) => x - low[c])) || group[0].size };
    group.forEach((view, i) => {
      view.anchor = anchor;
      shown.set(view, points[i].map((x, k) => (x - anchor.centre[k % 3]) / anchor.size));
    });
  }
  return views.map((view) => shown.get(view));
}

function middleOf(rest) {
  const { low, high } = boxOf(rest);
  return low.map((x, c) => (x + high[c]) / 2);
}

/** The box around some of the points. */
function roughBox(points) {
  const stride = 3 * Math.max(1, Math.floor(points.length / 3 / 1500)), some = [];
  for (let i = 0; i < points.length; i += stride) some.push(points[i], points[i + 1], points[i + 2]);
  return boxOf(some);
}

function boxOf(points) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  points.forEach((x, i) => {
    low[i % 3] = Math.min(low[i % 3], x);
    high[i % 3] = Math.max(high[i % 3], x);
  });
  return { low, high };
}

function vertexNormalsOf(points, triangles) {
  const normals = new Float32Array(points.length);
  vertexNormals(points, triangles, normals);
  return normals;
}

/** Round marks with a diameter of `wide` pixels; marks behind the cloth are not drawn. */
export function pointMaterial(colour) {
  return new ShaderMaterial({
    glslVersion: GLSL3, transparent: true, depthWrite: false,
    uniforms: { tint: { value: new Color(colour).convertLinearToSRGB() }, ratio: { value: 1 } },
    vertexShader: /* glsl */`
      in float wide;
      uniform float ratio;
      out float radius;
      void main() {
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
        gl_Position.z -= 0.004 * gl_Position.w;
        radius = 0.5 * wide * ratio;
        gl_PointSize = 2.0 * radius + 3.0 * ratio;
      }`,
    fragmentShader: /* glsl */`
      uniform vec3 tint;
      uniform float ratio;
      in float radius;
      layout(location = 0) out vec4 colour;
      void main() {
        float far = length(gl_PointCoord - 0.5) * (2.0 * radius + 3.0 * ratio);
        float inside = clamp(radius + 0.5 - far, 0.0, 1.0), ring = clamp(radius + ratio + 0.5 - far, 0.0, 1.0);
        if (ring <= 0.0) discard;
        colour = vec4(mix(vec3(1.0), tint, inside), ring);
      }` });
}
