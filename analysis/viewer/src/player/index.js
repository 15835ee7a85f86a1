/** Fills every element of class "player": a player that begins when it comes into view. */
import { Player } from "./player.js";

/**
 * Makes a player of an element with data-runs. It reads its runs when it comes into view.
 * @returns {Player} dispose() frees its graphics context
 */
export function makePlayer(element) {
  if (element.player) return element.player;
  const player = element.player = new Player(element);
  const watch = new IntersectionObserver((entries) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    watch.disconnect();
    if (!player.disposed) player.start();
  }, { rootMargin: "200px" });
  watch.observe(element);
  return player;
}

/** Starts the players of the page. Later it starts and disposes of players for other parts of the page. */
export function startPlayers(root = document) {
  for (const element of root.querySelectorAll(".player")) makePlayer(element);
  document.addEventListener("bendlab:player", ({ detail }) => makePlayer(detail.element));
  document.addEventListener("bendlab:discard", ({ detail }) => detail.element?.player?.dispose());
}
