/** The quantity that colours the cloth, or its difference from another run. */
import { differences, distances, FIELDS } from "./fields.js";
import { RestMap } from "./mesh.js";

const OTHER_CLOTH = 0.2; // sizes; rest shapes farther apart are not one cloth

export class Compare {
  /** @param {object[]} quantities of the page's data */
  constructor(quantities) {
    this.quantities = quantities;
    this.maps = new Map();
    this.ranges = new Map();
  }

  /** The map from a view's rest shape to another view's rest shape; null if their cloths are different. */
  map(view, other) {
    const key = `${view.run.id} ${other.run.id}`;
    if (!this.maps.has(key)) {
      const map = new RestMap(view.mesh, other.mesh);
      this.maps.set(key, map.same || map.farthest <= OTHER_CLOTH * Math.max(view.size, other.size) ? map : null);
    }
    return this.maps.get(key);
  }

  /** The quantities that the user can choose; with a reference, the differences in these quantities. */
  choices(reference) {
    return this.quantities.filter(({ key }) => reference || key !== "distance").map((quantity) =>
      reference ? compared(quantity) : quantity);
  }

  /** The quantity with this key; with a reference, the difference in this quantity. */
  quantity(key, reference) {
    const found = this.quantities.find((each) => each.key === key) ?? this.quantities[0];
    return reference ? compared(found) : found;
  }

  /**
   * Values of a view's frame: {values, smooth}, or null for a plain cloth.
   * @param {import("./view.js").View|null} reference
   */
  values(key, view, reference, positions = view.cloth.positions, others = reference?.cloth.positions) {
    if (key === "none" || (reference && reference === view)) return null;
    if (!reference) return { values: FIELDS[key](view.mesh, positions), smooth: false };
    const map = this.map(view, reference);
    if (!map) return null;
    if (key === "distance") return { values: distances(positions, map, others), smooth: true };
    return { values: differences(FIELDS[key](view.mesh, positions), map, FIELDS[key](reference.mesh, others)),
             smooth: false };
  }

  /** The range of the colours: the user's choice, or the range of the quantity, or the range of the data. */
  range(key, views, reference) {
    const name = `${key} ${reference?.run.id ?? ""}`;
    if (!this.ranges.has(name)) {
      const quantity = this.quantity(key, reference);
      this.ranges.set(name, quantity.range ?? this.#measured(quantity, views, reference));
    }
    return this.ranges.get(name);
  }

  setRange(key, reference, range) {
    this.ranges.set(`${key} ${reference?.run.id ?? ""}`, range);
  }

  /** The range of the values in some frames, up to the 99.5th percentile, which is rounded up. */
  #measured(quantity, views, reference) {
    const seen = [];
    for (const view of views)
      for (const share of [0, 0.2, 0.45, 0.7, 1]) {
        const time = view.frames.times[0] + share * (view.frames.times.at(-1) - view.frames.times[0]);
        const found = this.values(quantity.key, view, reference, view.frames.positions(view.frames.frameAt(time)),
          reference?.frames.positions(reference.frames.frameAt(time)));
        if (!found) continue;
        const stride = Math.max(1, Math.floor(found.values.length / 2000));
        for (let i = 0; i < found.values.length; i += stride)
          if (Number.isFinite(found.values[i])) seen.push(quantity.signed ? Math.abs(found.values[i]) : found.values[i]);
      }
    seen.sort((a, b) => a - b);
    const at = (share) => seen.length ? seen[Math.min(seen.length - 1, Math.floor(share * seen.length))] : 0;
    const high = roundUp(at(0.995)) || 1;
    if (quantity.signed) return [-high, high];
    return quantity.scale === "log" ? [high / 1e4, high] : [0, high];
  }
}

function compared(quantity) {
  if (["none", "distance"].includes(quantity.key)) return quantity;
  return { ...quantity, name: `Difference in ${quantity.name.toLowerCase()}`, symbol: `Δ ${quantity.symbol}`,
           map: "difference", scale: "linear", range: null, signed: true,
           meaning: `This run minus the other run. ${quantity.meaning}` };
}

/** Rounds up to 1, 2 or 5 times a power of ten. */
function roundUp(x) {
  if (!(x > 0)) return 0;
  const unit = 10 ** Math.floor(Math.log10(x));
  return unit * ([1, 2, 5, 10].find((step) => step * unit >= x * (1 - 1e-9)));
}
