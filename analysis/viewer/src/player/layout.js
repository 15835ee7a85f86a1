/** How views are laid out in a player. Pixels of the page. */

export const MOST = 8; // views

/** The number of columns for a number of views in a given width. */
export function columnsFor(count, width) {
  if (width < 620) return Math.min(count, 2);
  if (count <= 3) return count;
  if (count === 4) return width > 1000 ? 4 : 2;
  return count <= 6 ? 3 : 4;
}

/** Height of the stage. */
export function heightFor(count, width, room) {
  const columns = columnsFor(count, width), rows = Math.ceil(count / columns);
  const one = width / columns;
  const tall = count === 1 ? Math.min(0.62 * width, 560) : Math.min(Math.max(0.95 * one, 190), 460);
  return Math.round(Math.max(Math.min(rows * tall, Math.max(0.78 * room, rows * 170)), 220));
}
