/** Makes a player of every element of class "player". */
import { Player } from "./player.js";

/**
 * Makes a player of an element with data-runs. The player reads its runs when the element comes into view.
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

/** Makes the players of the page, and later makes and disposes of players on events of other parts. */
export function startPlayers() {
  for (const element of document.querySelectorAll(".player")) makePlayer(element);
  document.addEventListener("bendlab:player", ({ detail }) => makePlayer(detail.element));
  document.addEventListener("bendlab:discard", ({ detail }) => detail.element?.player?.dispose());
}
