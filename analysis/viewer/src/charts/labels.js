/** Labels beside the ends of curves, moved apart where they would overlap. */

/**
 * The positions nearest to `wanted` at which labels of this height do not overlap. The labels stay in order,
 * and between low and high if there is room.
 * @param {number[]} wanted @param {number} height @param {number} low @param {number} high
 */
export function apart(wanted, height, low, high) {
  const order = wanted.map((_, i) => i).sort((a, b) => wanted[a] - wanted[b]);
  const blocks = []; // labels that touch move together: the mean of their wanted places, and their number
  order.forEach((label, rank) => {
    let mean = wanted[label] - rank * height,
      count = 1;
    while (blocks.length && blocks.at(-1).mean > mean) {
      const other = blocks.pop();
      mean = (mean * count + other.mean * other.count) / (count + other.count);
      count += other.count;
    }
    blocks.push({ mean, count });
  });
  const first = blocks.flatMap(({ mean, count }) => Array(count).fill(mean));
  const last = high - (order.length - 1) * height;
  const places = Array(wanted.length);
  order.forEach((label, rank) => {
    places[label] = Math.min(Math.max(first[rank], low), Math.max(low, last)) + rank * height;
  });
  return places;
}
