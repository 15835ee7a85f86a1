/** The current time of the page's player, for charts over time. */

const EVERY_MS = 60;

/** Calls `show` with the player's time whenever it has changed, while the figure is in sight. */
export function followPlayer(figure, show) {
  let timer = null,
    shown = null;
  const look = () => {
    const time = document.querySelector("main .player")?.player?.time;
    if (time === undefined || time === shown) return;
    shown = time;
    show(time);
  };
  new IntersectionObserver(([entry]) => {
    clearInterval(timer);
    timer = entry.isIntersecting ? setInterval(look, EVERY_MS) : null;
  }).observe(figure);
}
