/**
 * A camera around a cloth. The user moves the camera by dragging, pinching, the wheel or keys. z is up.
 * Lengths are in sizes of the cloth, from its centre (see anchorViews()), so that one camera suits any run.
 */
import { PerspectiveCamera, Vector3 } from "three";

const FIELD = 30; // degrees, from bottom to top

export class Orbit {
  constructor() {
    this.home = null;
    Object.assign(this, { azimuth: -62, elevation: 18, distance: 3, target: [0, 0, 0], moved: false });
  }

  copy(other) {
    Object.assign(this, { azimuth: other.azimuth, elevation: other.elevation, distance: other.distance,
                          target: [...other.target], moved: other.moved, home: other.home });
  }

  /** Rows: right, up, backward. */
  axes() {
    const a = this.azimuth * Math.PI / 180, e = this.elevation * Math.PI / 180;
    const backward = [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)];
    const right = [-Math.sin(a), Math.cos(a), 0];
    const up = [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)];
    return [right, up, backward];
  }

  turn(right, up) {
    this.azimuth -= right;
    this.elevation = Math.min(89, Math.max(-89, this.elevation + up));
    this.moved = true;
  }

  zoom(factor) {
    this.distance = Math.min(60, Math.max(0.02, this.distance * factor));
    this.moved = true;
  }

  /** Moves the picture by shares of its height. */
  pan(right, up) {
    const [r, u] = this.axes();
    const far = 2 * this.distance * Math.tan(FIELD / 360 * Math.PI);
    this.target = this.target.map((x, i) => x - far * (right * r[i] + up * u[i]));
    this.moved = true;
  }

  /** Moves the camera so that a picture of this aspect ratio shows the points (n · 3, in sizes). A camera
   * that the user has moved stays. */
  frame(points, aspect) {
    if (!this.moved || !this.home) {
      const [right, up, back] = this.axes();
      const slope = Math.tan(FIELD / 360 * Math.PI);
      let low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
      const at = (i, axis) => points[i] * axis[0] + points[i + 1] * axis[1] + points[i + 2] * axis[2];
      for (let i = 0; i < points.length; i += 3)
        [right, up, back].forEach((axis, k) => {
          low[k] = Math.min(low[k], at(i, axis));
          high[k] = Math.max(high[k], at(i, axis));
        });
      const middle = low.map((x, k) => (x + high[k]) / 2);
      let distance = 0.05;
      for (let i = 0; i < points.length; i += 3) {
        const depth = at(i, back) - middle[2];
        distance = Math.max(distance, depth + 1.10 * Math.abs(at(i, right) - middle[0]) / (slope * aspect),
                            depth + 1.14 * Math.abs(at(i, up) - middle[1]) / slope);
      }
      this.target = [0, 1, 2].map((c) => middle[0] * right[c] + middle[1] * up[c] + middle[2] * back[c]);
      this.distance = distance;
      this.moved = false;
      this.home = { azimuth: this.azimuth, elevation: this.elevation };
    }
  }

  reset() {
    if (this.home) Object.assign(this, this.home);
    this.moved = false;
  }

  /** Applies this orbit to a camera of three.js, for cloth with this centre and size. */
  place(camera, middle, size, aspect) {
    const back = this.axes()[2];
    const target = middle.map((x, i) => x + size * this.target[i]);
    camera.position.set(...target.map((x, i) => x + size * this.distance * back[i]));
    camera.up.set(0, 0, 1);
    camera.lookAt(new Vector3(...target));
    camera.fov = FIELD;
    camera.aspect = aspect;
    camera.near = size * Math.max(0.01, this.distance - 3);
    camera.far = size * (this.distance + 5);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }
}

export const newCamera = () => new PerspectiveCamera(FIELD, 1, 0.01, 10);

/**
 * Lets pointers and wheels move the camera of an element.
 * @param {(change: (orbit: Orbit) => void) => void} move
 * @param {(x: number, y: number) => void} click after a press without a drag, in pixels of the element
 */
export function followPointers(element, move, click) {
  const pointers = new Map();
  let travelled = 0;
  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (pointers.size === 1) travelled = 0;
  });
  element.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before.x, dy = event.clientY - before.y;
    travelled += Math.abs(dx) + Math.abs(dy);
    const height = element.clientHeight || 1;
    const [other] = [...pointers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
    if (other) {
      const far = (place) => Math.hypot(place.x - other.x, place.y - other.y) || 1;
      const factor = far(before) / far({ x: event.clientX, y: event.clientY });
      move((orbit) => { orbit.zoom(factor); orbit.pan(dx / 2 / height, -dy / 2 / height); });
    } else if (travelled > 3) {
      const sliding = event.buttons === 2 || event.buttons === 4 || event.ctrlKey || event.metaKey;
      move((orbit) => sliding ? orbit.pan(dx / height, -dy / height) : orbit.turn(dx * 0.4, dy * 0.4));
    }
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  const up = (event) => {
    if (pointers.delete(event.pointerId) && travelled <= 3 && event.type === "pointerup" && event.button === 0) {
      const box = element.getBoundingClientRect();
      click(event.clientX - box.left, event.clientY - box.top);
    }
  };
  element.addEventListener("pointerup", up);
  element.addEventListener("pointercancel", up);
  element.addEventListener("contextmenu", (event) => event.preventDefault());
  // The wheel scrolls the page, and zooms only if the view has the focus or the user holds Ctrl or Meta.
  element.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.metaKey && !element.contains(document.activeElement)) return;
    event.preventDefault();
    move((orbit) => orbit.zoom(Math.exp(event.deltaY * 0.0012)));
  }, { passive: false });
}
