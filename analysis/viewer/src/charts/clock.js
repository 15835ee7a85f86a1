/** The current time of the page's player, for charts over time. */

const EVERY_MS = 60;

/** While the figure is visible, calls `show` with the player's time whenever the time has changed. */
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
