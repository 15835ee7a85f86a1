/** The live page of a run that is being computed: asks the server for new frames, and shows these frames. */
import { pageData } from "../page/data.js";
import { number } from "../page/numbers.js";
import { forget } from "../player/runs.js";

const calls = {
  complete: "The run is complete.",
  implausible: "The run ended as implausible.",
  diverged: "The run diverged.",
  interrupted: "The run was stopped.",
};

/** Starts to ask for frames, if the page's data say that the run is being computed. */
export function startLive() {
  const { live } = pageData();
  const line = document.getElementById("live");
  if (!live || !line) return;
  for (const element of document.querySelectorAll(".player")) {
    // begins with the newest frame, not with the first frame
    if (element.player) Object.assign(element.player, { time: Infinity, played: true });
  }
  let have = `${live.frames}-running`,
    missed = 0;

  async function ask() {
    try {
      const answer = await fetch(`frames?have=${have}`, { cache: "no-store" });
      if (answer.status === 200) {
        const news = await answer.json();
        have = `${news.frames}-${news.status}`;
        await show(news, line);
        if (calls[news.status]) return;
      }
      missed = 0;
    } catch {
      if (++missed >= 3)
        line.textContent = "The server does not answer: bendlab view --live has ended. The frames here stay.";
    }
    setTimeout(ask, 1000 * live.every * Math.min(2 ** missed, 16));
  }

  setTimeout(ask, 1000 * live.every);
}

async function show(news, line) {
  line.textContent =
    `${news.frames} frames, t = ${number(news.time)} s of ${number(news.duration)} s. ` +
    (calls[news.status] ?? "The run goes on.");
  const run = pageData().byId.get(news.run.id);
  if (!run || !news.run.frames) return;
  Object.assign(run, news.run, { status: news.status });
  document.getElementById(run.frames.dom).textContent = news.scripts;
  forget(run.id);
  for (const element of document.querySelectorAll(".player")) await renew(element.player);
  const figure = document.querySelector("figure.chart[data-chart='over-time']");
  if (news.chart && figure?.chart) figure.chart.replace(news.chart);
}

// Reads the frames of a player again. Cameras stay. A player at the last frame goes to the new last frame.
async function renew(player) {
  if (!player || player.disposed || !player.views.length) return;
  const atEnd = player.time >= player.last - 1e-9 || player.playing;
  const cameras = player.views.map((view) => view.orbit);
  await player.start();
  player.views.forEach((view, i) => {
    if (cameras[i]?.moved) view.orbit.copy(cameras[i]);
  });
  if (atEnd) player.seek(player.last);
}
