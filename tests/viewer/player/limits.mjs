// Measures the two pages of limits.py, and compares the results with the goals.
import { readdirSync, readFileSync, statSync } from "node:fs";
import { opened, usable } from "./browser.mjs";

if (!usable()) process.exit(77);
const [eight, large] = process.argv.slice(2);
let missed = 0;

function report(name, value, unit, goal, atLeast) {
  const held = atLeast ? value >= goal : value <= goal;
  missed += !held;
  console.log(`${held ? "ok    " : "MISSED"}  ${name}: ${value.toFixed(1)} ${unit} (goal: ${atLeast ? "≥" : "≤"} ${goal})`);
}

/** CPU time of the child processes of this process, which are the browser; s. */
function processorSeconds() {
  const all = new Map();
  for (const id of readdirSync("/proc").filter((name) => /^\d+$/.test(name)))
    try {
      const fields = readFileSync(`/proc/${id}/stat`, "utf8").replace(/^.*\) /s, "").split(" ");
      all.set(id, { parent: fields[1], ticks: Number(fields[11]) + Number(fields[12]) });
    } catch { /* the process has ended */ }
  const ours = new Set([String(process.pid)]);
  for (let grown = true; grown;) {
    grown = false;
    for (const [id, { parent }] of all) if (!ours.has(id) && ours.has(parent)) grown = Boolean(ours.add(id));
  }
  return [...ours].reduce((sum, id) => sum + (id === String(process.pid) ? 0 : all.get(id).ticks / 100), 0);
}

/** Time from the start of the page until its cloth is drawn, ms. Reading a pixel waits for the drawing. */
async function firstFrame(page, file) {
  await page.addInitScript(() => {
    const look = () => {
      const player = document.querySelector(".player")?.player;
      if (!player?.drawn) return setTimeout(look, 4);
      const gl = player.stage.renderer.getContext();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      globalThis.firstFrame = performance.now();
    };
    look();
  });
  await page.goto(`file://${file}`);
  while (!(await page.evaluate("globalThis.firstFrame"))) await page.waitForTimeout(20);
  return page.evaluate("globalThis.firstFrame");
}

async function framesPerSecond(page, runs) {
  while (!(await page.evaluate("document.querySelector('.player').player.decoded"))) await page.waitForTimeout(50);
  await page.evaluate(async (runs) => {
    const { player } = document.querySelector(".player");
    if (runs < player.ids.length) await player.show(player.ids.slice(0, runs));
    while (!player.decoded) await new Promise((resume) => setTimeout(resume, 50));
    player.setLoop(true);
    player.setSpeed(4); // fast enough for a new frame in every picture
    player.play();
  }, runs);
  await page.waitForTimeout(3000);
  const drawn = () => page.evaluate("document.querySelector('.player').player.drawn");
  const [before, processor, start] = [await drawn(), processorSeconds(), performance.now()];
  await page.waitForTimeout(6000);
  const pictures = (await drawn()) - before, seconds = (performance.now() - start) / 1000;
  console.log(`        ${((processorSeconds() - processor) / pictures * 1000).toFixed(0)} ms of processor time for a picture, ` +
    `level ${await page.evaluate("document.querySelector('.player').player.stage.movingLevel")}`);
  return pictures / seconds;
}

for (const { file, name, bytes, runs, rate } of [
  { file: eight, name: "8 runs × 151 frames × 4 096 vertices", bytes: 12, runs: 1, rate: 30 },
  { file: large, name: "1 run × 61 frames × 66 049 vertices", bytes: 60, runs: 1, rate: 10 }]) {
  console.log(name);
  report("page", statSync(file).size / 1e6, "MB", bytes, false);
  const { browser, page } = await opened("about:blank", { calm: true });
  const first = await firstFrame(page, file);
  if (file === eight) report("first frame", first / 1000, "s", 2, false);
  else console.log(`        first frame ${(first / 1000).toFixed(1)} s`);
  report("playback of one run", await framesPerSecond(page, runs), "frames/s", rate, true);
  await browser.close();
}
process.exit(missed ? 1 : 0);
