// Uses the pages of test_player.py like a user, and compares them with the values that h5py read.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { opened, until, usable } from "./browser.mjs";

if (!usable()) process.exit(77);
const folder = process.argv[2];
const expected = JSON.parse(readFileSync(`${folder}/expected.json`, "utf8"));
const PLAYER = "document.querySelector('.player').player";
const only = process.env.BENDLAB_VIEWER_TEST; // part of the name of a test

async function ready(page) {
  await page.waitForSelector(".player[data-decoded]");
}

/** The screen position of a vertex of the first view. */
const onScreen = (page, vertex) => page.evaluate((vertex) => {
  const player = document.querySelector(".player").player, view = player.views[0];
  player.drawNow(); // else the camera is still that of the last picture
  const place = view.camera.position.clone().fromArray(view.cloth.positions, 3 * vertex).project(view.camera);
  const box = player.cells[0].element.getBoundingClientRect();
  return { x: box.left + (place.x + 1) / 2 * box.width, y: box.top + (1 - place.y) / 2 * box.height };
}, vertex);

async function withPage(name, how, use) {
  const all = await opened(`file://${folder}/${name}.html`, how);
  try {
    await ready(all.page);
    await use(all.page, all);
    assert.deepEqual(all.errors, []);
    assert.equal(all.requests.length, 1, `requests: ${all.requests}`);
  } finally {
    await all.browser.close();
  }
}

const tests = {
  async "clicks before the frames are read cause no error"() {
    await withPage("page", { calm: true, early: ["One frame on", "Play", "One frame back", "One frame on"] },
      async (page) => {
        assert.doesNotMatch(await page.textContent(".player-clock"), /NaN/);
        assert.ok(Number.isFinite(await page.evaluate(`${PLAYER}.time`)));
      });
  },

  async "a pick in moving cloth shows its values immediately"() {
    await withPage("page", {}, async (page) => {
      await page.evaluate(`${PLAYER}.setLoop(true), ${PLAYER}.setSpeed(0.1), ${PLAYER}.play()`);
      assert.ok(await page.evaluate(`(${PLAYER}.pickNumber("vertex", 3), !${PLAYER}.controls.panel.element.hidden)`));
    });
  },

  async "positions differ from the run file by at most half a step in every frame"() {
    await withPage("page", { calm: true }, async (page) => {
      for (const [i, { positions, times, triangles, pinned }] of expected.entries()) {
        const played = await page.evaluate(([i, positions]) => {
          const { frames } = document.querySelector(".player").player.views[i];
          const points = new Float64Array(3 * frames.vertices);
          let worst = 0;
          for (let frame = 0; frame < frames.count; ++frame) {
            frames.positions(frame, points);
            for (let k = 0; k < points.length; ++k)
              worst = Math.max(worst, Math.abs(points[k] - positions[frame * points.length + k]));
          }
          return { worst, half: frames.head.step / 2, count: frames.count, times: [...frames.times],
                   triangles: [...frames.triangles], pinned: [...frames.pinned],
                   box: frames.head.box[1].map((x, c) => x - frames.head.box[0][c]) };
        }, [i, positions]);
        assert.ok(played.worst <= played.half * (1 + 1e-9), `${played.worst} > ${played.half}`);
        assert.ok(played.half <= Math.max(...played.box) / 65535 / 2 * (1 + 1e-9), "16 bits within the run's box");
        assert.equal(played.count, times.length);
        played.times.forEach((time, k) => assert.ok(Math.abs(time - times[k]) < 1e-8));
        assert.deepEqual(played.triangles, triangles);
        assert.deepEqual(played.pinned, pinned);
      }
    });
  },

  async "stretches and shapes differ from the run file only by rounding"() {
    await withPage("page", { calm: true }, async (page) => {
      for (const [i, { max_stretch, min_stretch, shape }] of expected.entries()) {
        const worst = await page.evaluate(async ([i, largest, smallest, shape]) => {
          const player = document.querySelector(".player").player, view = player.views[i];
          const { frames, mesh } = view;
          const result = { stretch: 0, shape: 0, uncertainty: 0 };
          for (let frame = 0; frame < frames.count; ++frame) {
            player.time = frames.times[frame];
            player.drawNow(true, true);
            const strain = player.compare.values("strain", view, null).values;
            const stretch = player.compare.values("stretch", view, null).values;
            const quality = player.compare.values("quality", view, null).values;
            for (let t = 0; t < mesh.triangleCount; ++t) {
              const k = frame * mesh.triangleCount + t;
              // |dF| of two edges whose ends are half a step off on three axes, and the rounding of float32.
              const off = Math.sqrt(6) * frames.head.step * mesh.frames.reach[t] + 2e-6 * largest[k];
              result.uncertainty = Math.max(result.uncertainty, off);
              const stored = Math.max(Math.abs(largest[k] - 1), Math.abs(smallest[k] - 1));
              result.stretch = Math.max(result.stretch, Math.abs(stretch[t] + 1 - largest[k]) / off,
                                        Math.abs(strain[t] - stored) / off);
              result.shape = Math.max(result.shape, Math.abs(quality[t] - shape[k]));
            }
          }
          return result;
        }, [i, max_stretch, min_stretch, shape]);
        assert.ok(worst.stretch <= 1, `${worst.stretch} of the uncertainty`);
        assert.ok(worst.uncertainty < 2e-3, `${worst.uncertainty}`);
        assert.ok(worst.shape < 2e-3, `${worst.shape}`);
      }
    });
  },

  async "the values of a pick agree with the run file"() {
    await withPage("page", { calm: true }, async (page) => {
      await page.evaluate(`${PLAYER}.seek(0.5), ${PLAYER}.drawNow()`);
      // The screen position of a vertex in the middle.
      const at = await onScreen(page, 6 * 13 + 6);
      await page.mouse.click(at.x, at.y);
      await page.waitForSelector(".player-panel:not([hidden])");
      const row = async (name, column = 1) => page.evaluate(([name, column]) =>
        [...document.querySelectorAll(".player-panel tr")].filter((line) => line.cells[0].textContent === name)
          .map((line) => line.cells[column].textContent), [name, column]);
      const [vertex, triangle] = (await row("number")).map(Number);
      const [run] = expected, frame = run.times.findLastIndex((time) => time <= 0.5 + 1e-9);
      assert.deepEqual(await row("frame"), [`${frame} (${run.times[frame].toFixed(4)} s)`]);
      const half = await page.evaluate(`${PLAYER}.views[0].frames.head.step / 2`);
      const [position] = await row("position (m)");
      const vertices = run.positions.length / 3 / run.times.length;
      position.replaceAll("−", "-").split(", ").map(Number).forEach((x, c) => {
        const stored = run.positions[3 * (frame * vertices + vertex) + c];
        assert.ok(Math.abs(x - stored) <= half + 6e-6, `${x} is not ${stored}`);
      });
      const count = run.triangles.length / 3;
      const [largest] = await row("stretch σ₁"), [smallest] = await row("stretch σ₂");
      for (const [text, stored] of [[largest, run.max_stretch[frame * count + triangle]],
                                    [smallest, run.min_stretch[frame * count + triangle]]]) {
        const [value, off] = text.replace(/·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)/, (_, e) => `e${[...e].map((c) =>
          c === "⁻" ? "-" : "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c)).join("")}`).split(" ± ").map(Number);
        assert.ok(Math.abs(value - stored) <= off * 1.05 + 1e-4, `${text} is not ${stored}`);
      }
      assert.deepEqual((await row("vertices"))[0].split(", ").map(Number), run.triangles.slice(3 * triangle, 3 * triangle + 3));
      assert.ok(run.triangles.slice(3 * triangle, 3 * triangle + 3).includes(vertex));
      // All springs that the file has at this vertex are drawn.
      const springs = [];
      for (let i = 0; i < run.springs.length; i += 2)
        if (run.springs[i] === vertex || run.springs[i + 1] === vertex)
          springs.push(run.springs[i] === vertex ? run.springs[i + 1] : run.springs[i]);
      assert.ok(springs.length > 0);
      await until(page, `${PLAYER}.views.every((view) => view.picked.read)`);
      const drawn = await page.evaluate(`${PLAYER}.views[0].picked.springs.flatMap((ring) => ring.others)`);
      assert.deepEqual(drawn.sort((a, b) => a - b), springs.sort((a, b) => a - b));
      const texts = await page.locator(".player-springs").textContent();
      assert.match(texts, /ring 1: \d/);
      assert.match(texts, /--set \/output\/constraints=true/, "the run without springs has the setting that records them");
      // In the finer mesh, the picked vertex at rest is near the same place.
      const away = await page.evaluate(() => {
        const [a, , c] = document.querySelector(".player").player.views;
        return Math.hypot(...[0, 1, 2].map((k) => a.mesh.rest[3 * a.picked.vertex + k] - c.mesh.rest[3 * c.picked.vertex + k]));
      });
      assert.ok(away <= 1 / 17, `${away}`);
      await page.keyboard.press("Escape");
      assert.equal(await page.locator(".player-panel").isHidden(), true);
    });
  },

  async "the panel does not state that there are no springs before they are read"() {
    await withPage("page", { calm: true }, async (page) => {
      const text = await page.evaluate(() => {
        const { player } = document.querySelector(".player");
        player.pickNumber("vertex", 84);
        player.drawNow();
        return document.querySelector(".player-springs").textContent;
      });
      assert.match(text, /being read/);
      assert.doesNotMatch(text, /No spring/);
      await until(page, "/ring 1: /.test(document.querySelector('.player-springs').textContent)");
    });
  },

  async "printed cloth has a light background, also in dark mode"() {
    await withPage("page", { calm: true, dark: true }, async (page) => {
      const ground = () => page.evaluate(`[...${PLAYER}.stage.ground.bottom]`);
      assert.ok((await ground()).every((c) => c < 0.2));
      await page.emulateMedia({ media: "print", colorScheme: "dark" });
      await until(page, `[...${PLAYER}.stage.ground.bottom].every((c) => c > 0.8)`);
      assert.equal(await page.locator(".player-top label:visible, .player-bottom:visible").count(), 0);
      await page.emulateMedia({ media: "screen", colorScheme: "dark" });
      await until(page, `[...${PLAYER}.stage.ground.bottom].every((c) => c < 0.2)`);
    });
  },

  async "time: play, pause, step, slider, speed, loop, different rates"() {
    await withPage("page", { calm: true }, async (page) => {
      const time = () => page.evaluate(`${PLAYER}.time`);
      assert.equal(await time(), 0, "the player does not start by itself with reduced motion");
      await page.locator(".player-view").first().focus();
      await page.keyboard.press("ArrowRight");
      assert.ok(Math.abs(await time() - 1 / 30) < 1e-6);
      await page.keyboard.press("ArrowLeft");
      assert.equal(await time(), 0);
      await page.keyboard.press("Space");
      assert.equal(await page.getByLabel("Pause").getAttribute("title"), "Pause (Space)");
      await until(page, `${PLAYER}.time > 0.3`);
      await page.keyboard.press("Space");
      const stopped = await time();
      await page.waitForTimeout(200);
      assert.equal(await time(), stopped);
      await page.keyboard.press("End");
      assert.equal(await time(), 1);
      const frames = await page.evaluate(`${PLAYER}.drawNow(), ${PLAYER}.views.map((view) => view.frame)`);
      assert.deepEqual(frames, expected.map(({ times }) => times.length - 1));
      assert.match(await page.locator(".player-view").nth(2).textContent(), /ends at 0\.60 s/);
      await page.locator(".player-slider").focus();
      await page.keyboard.press("Home");
      assert.equal(await time(), 0);
      await page.locator(".player-slider").fill("0.5");
      const at = await page.evaluate(`${PLAYER}.drawNow(), ${PLAYER}.views.map((view) => view.time)`);
      at.forEach((shown, i) => {
        const last = expected[i].times.findLast((time) => time <= 0.5 + 1e-9);
        assert.ok(Math.abs(shown - last) < 1e-8);
      });
      await page.locator(".player-view").first().focus();
      await page.keyboard.press("]");
      assert.equal(await page.evaluate(`${PLAYER}.speed`), 2);
      await page.keyboard.press("l");
      assert.equal(await page.getByRole("button", { name: "Loop" }).getAttribute("aria-pressed"), "true");
    });
  },

  async "the player starts by itself and plays once if motion is allowed"() {
    await withPage("page", {}, async (page) => {
      await until(page, `${PLAYER}.time >= 1`);
      assert.equal(await page.evaluate(`${PLAYER}.playing`), false);
    });
  },

  async "cameras turn together, or separately"() {
    await withPage("page", { calm: true }, async (page) => {
      const turns = () => page.evaluate(`${PLAYER}.views.map((view) => view.orbit.azimuth)`);
      const box = await page.locator(".player-view").nth(1).boundingBox();
      const drag = async () => {
        await page.mouse.move(box.x + 100, box.y + 100);
        await page.mouse.down();
        await page.mouse.move(box.x + 160, box.y + 110, { steps: 4 });
        await page.mouse.up();
      };
      await drag();
      const locked = await turns();
      assert.ok(locked[0] !== -62 && locked.every((turn) => turn === locked[0]), `${locked}`);
      await page.keyboard.press("c");
      await drag();
      const free = await turns();
      assert.equal(free[0], locked[0]);
      assert.notEqual(free[1], locked[1]);
      await page.keyboard.press("c");
      assert.equal(new Set(await turns()).size, 1);
      await page.keyboard.press("Shift+ArrowLeft");
      assert.notDeepEqual(await turns(), free);
      await page.keyboard.press("r");
      assert.deepEqual(await turns(), [-62, -62, -62]);
    });
  },

  async "colours show the distance and the differences to another run"() {
    await withPage("page", { calm: true }, async (page) => {
      await page.getByLabel("Compare with").selectOption({ label: "dihedral" });
      assert.equal(await page.evaluate(`${PLAYER}.key`), "distance");
      await page.evaluate(`${PLAYER}.seek(0.5), ${PLAYER}.drawNow()`);
      const distances = await page.evaluate(() => {
        const player = document.querySelector(".player").player;
        return [...player.compare.values("distance", player.views[0], player.reference).values];
      });
      const [a, b] = expected, vertices = distances.length;
      const frame = a.times.findLastIndex((time) => time <= 0.5 + 1e-9);
      distances.forEach((distance, v) => {
        const stored = Math.hypot(...[0, 1, 2].map((c) => a.positions[3 * (frame * vertices + v) + c] -
          b.positions[3 * (frame * vertices + v) + c]));
        assert.ok(Math.abs(distance - stored) < 1e-4, `${distance} is not ${stored}`);
      });
      assert.match(await page.locator(".player-bar-name").textContent(), /\(m\)/);
      // At rest, two meshes of the same sheet are at the same place.
      const rest = await page.evaluate(() => {
        const player = document.querySelector(".player").player, view = player.views[2];
        return Math.max(...player.compare.values("distance", view, player.reference, view.mesh.rest,
          player.reference.mesh.rest).values);
      });
      assert.ok(rest < 1e-6, `${rest}`);
      await page.getByLabel("Colour", { exact: true }).selectOption("stretch");
      const range = await page.evaluate(`${PLAYER}.compare.range("stretch", ${PLAYER}.views, ${PLAYER}.reference)`);
      assert.equal(range[0], -range[1]);
    });
  },

  async "the colour bar has a unit and a range, and the range can be typed"() {
    await withPage("page", { calm: true }, async (page) => {
      await page.getByLabel("Colour", { exact: true }).selectOption("bending");
      await page.evaluate(`${PLAYER}.drawNow()`);
      assert.match(await page.locator(".player-bar-name").textContent(), /1\/m²/);
      const high = page.getByLabel("Largest value of the colour bar");
      await high.fill("250");
      await high.press("Enter");
      assert.equal((await page.evaluate(`${PLAYER}.compare.range("bending", ${PLAYER}.views, null)`))[1], 250);
      await high.fill("none");
      await high.press("Enter");
      assert.equal(await page.locator(".player-wrong").count(), 1);
    });
  },

  async "the picture shows the cloth, and front and back have different colours"() {
    await withPage("page", { calm: true }, async (page) => {
      await page.getByLabel("Colour", { exact: true }).selectOption("none");
      const colour = async () => page.evaluate(() => {
        const player = document.querySelector(".player").player;
        player.drawNow();
        const { canvas } = player.controls, copy = document.createElement("canvas");
        [copy.width, copy.height] = [canvas.width, canvas.height];
        const context = copy.getContext("2d");
        context.drawImage(canvas, 0, 0);
        const view = player.views[0], cell = player.cells[0], { ratio } = player.stage;
        const place = view.camera.position.clone().fromArray(view.cloth.positions, 3 * (3 * 13 + 4)).project(view.camera);
        const x = (cell.x + (place.x + 1) / 2 * cell.width) * ratio, y = (cell.y + (1 - place.y) / 2 * cell.height) * ratio;
        return [...context.getImageData(Math.round(x), Math.round(y), 1, 1).data];
      });
      const front = await colour();
      await page.evaluate(`${PLAYER}.move((orbit) => { orbit.elevation = -40; })`);
      const back = await colour();
      assert.ok(front[0] > front[2] + 5, `the front is warm: ${front}`);
      assert.ok(back[2] > back[0] + 5, `the back is cool: ${back}`);
    });
  },

  async "obstacles move with their velocity, and pins move with the cloth"() {
    await withPage("page", { calm: true }, async (page) => {
      for (const frame of [0, 17]) {
        const drawn = await page.evaluate((frame) => {
          const player = document.querySelector(".player").player, view = player.views[0];
          player.time = view.frames.times[frame];
          player.drawNow();
          const [{ drawn: mesh }] = view.obstacles, points = mesh.geometry.getAttribute("position").array;
          const low = [0, 1, 2].map((c) => points.filter((_, i) => i % 3 === c).reduce((a, b) => Math.min(a, b)));
          const high = [0, 1, 2].map((c) => points.filter((_, i) => i % 3 === c).reduce((a, b) => Math.max(a, b)));
          return { centre: low.map((x, c) => (x + high[c]) / 2 + mesh.position.getComponent(c)), wide: high[0] - low[0],
                   visible: mesh.visible, pins: [...view.pinMarks.geometry.getAttribute("position").array],
                   order: [...view.pins], time: view.time };
        }, frame);
        [0.1, -0.2, -0.4 + 0.2 * drawn.time].forEach((x, c) => assert.ok(Math.abs(drawn.centre[c] - x) < 1e-3));
        assert.ok(Math.abs(drawn.wide - 0.3) < 1e-3 && drawn.visible);
        const vertices = expected[0].positions.length / 3 / expected[0].times.length;
        drawn.order.forEach((v, i) => [0, 1, 2].forEach((c) => assert.ok(
          Math.abs(drawn.pins[3 * i + c] - expected[0].positions[3 * (frame * vertices + v) + c]) < 1e-4)));
      }
    });
  },

  async "full screen can be opened and closed"() {
    await withPage("page", { calm: true }, async (page) => {
      await page.locator(".player-view").first().focus();
      const height = () => page.evaluate("document.querySelector('.player-stage').clientHeight");
      const before = await height();
      await page.keyboard.press("f");
      await until(page, `${PLAYER}.isFull() && document.querySelector('.player-stage').clientHeight > ${before} + 50`);
      await page.keyboard.press("f");
      await until(page, `!${PLAYER}.isFull() && document.querySelector('.player-stage').clientHeight === ${before}`);
    });
  },

  async "a run without frames states its remedy, and texts do not become markup"() {
    await withPage("bare", { calm: true }, async (page) => {
      assert.match(await page.locator(".player-empty").textContent(), /Do this: .*\.\/bendlab run again/);
      assert.equal(await page.evaluate(`${PLAYER}.views.length`), 3);
      assert.equal(await page.title(), "Player");
      assert.match(await page.locator(".player-name").nth(1).textContent(), /<script>.*<!--/);
    });
  },

  async "the page states how many frames are left out"() {
    await withPage("thin", { calm: true }, async (page) => {
      assert.match(await page.locator(".player-notes").textContent(), /\d+ of 31 frames are shown, one of \d+/);
      const { chosen, times } = await page.evaluate(`${PLAYER}.views[0].frames.head`);
      assert.equal(chosen.at(-1), 30);
      chosen.forEach((frame, k) => assert.ok(Math.abs(times[k] - expected[0].times[frame]) < 1e-8));
    });
  },

  async "a still, a WebM video and an animated PNG can be saved"() {
    await withPage("page", { calm: true }, async (page) => {
      const saved = async (key) => {
        const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press(key)]);
        return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
      };
      await page.locator(".player-view").first().focus();
      const still = await saved("s");
      assert.match(still.name, /0\.00s\.png$/);
      assert.deepEqual([...still.bytes.subarray(0, 4)], [0x89, 0x50, 0x4e, 0x47]);
      assert.ok(still.bytes.length > 10_000, `${still.bytes.length} bytes`);
      await page.evaluate(`${PLAYER}.setSpeed(2), ${PLAYER}.recorder.slowest = Infinity`);
      const film = await saved("a");
      assert.match(film.name, /\.webm$/);
      assert.deepEqual([...film.bytes.subarray(0, 4)], [0x1a, 0x45, 0xdf, 0xa3], "EBML");
      assert.ok(film.bytes.length > 1_000, `${film.bytes.length} bytes`);
      await page.evaluate("delete window.MediaRecorder; delete globalThis.MediaRecorder");
      await page.evaluate(`${PLAYER}.setSpeed(4)`);
      const pictures = await saved("a");
      assert.match(pictures.name, /\.png$/);
      const text = pictures.bytes.toString("latin1");
      assert.ok(text.includes("acTL") && text.includes("fdAT"), "more than one picture");
      const size = await page.evaluate(async (bytes) => {
        const image = new Image();
        image.src = URL.createObjectURL(new Blob([Uint8Array.from(bytes)], { type: "image/png" }));
        await image.decode();
        return [image.width, image.height];
      }, [...pictures.bytes]);
      assert.ok(size[0] > 100 && size[1] > 100);
    });
  },

  async "every control can be reached by keyboard"() {
    await withPage("page", { calm: true }, async (page) => {
      const wanted = await page.evaluate(() => [...document.querySelectorAll(
        ".player button, .player select, .player input, .player summary, .player-view")]
        .filter((element) => element.checkVisibility() && !element.closest("dialog")).length);
      const reached = new Set();
      for (let i = 0; i < wanted + 5; ++i) {
        await page.keyboard.press("Tab");
        const focused = await page.evaluate(() => {
          const element = document.activeElement;
          if (!element.closest(".player")) return null;
          element.dataset.reached ??= String(Math.random());
          const { outlineStyle, outlineWidth } = getComputedStyle(element);
          return { id: element.dataset.reached, ring: outlineStyle !== "none" && outlineWidth !== "0px",
                   name: element.ariaLabel ?? element.textContent };
        });
        if (focused) {
          assert.ok(focused.ring, `${focused.name} shows that it has the focus`);
          reached.add(focused.id);
        }
      }
      assert.equal(reached.size, wanted);
      await page.locator(".player-view").first().focus();
      await page.keyboard.press("?");
      assert.match(await page.locator("dialog[open]").textContent(), /play, pause/);
      await page.keyboard.press("g");
      assert.equal(await page.evaluate(`${PLAYER}.lines`), true, "keys act outside their list");
      await page.evaluate(`${PLAYER}.pickNumber("vertex", 3)`);
      await page.keyboard.press("Escape");
      await until(page, "!document.querySelector('dialog[open]')");
      assert.equal(await page.evaluate(`${PLAYER}.hasPick()`), true, "Escape closes the list alone");
      await page.locator(".player-panel .scroll").focus();
      await page.keyboard.press("ArrowRight");
      assert.equal(await page.evaluate(`${PLAYER}.time`), 0, "arrows scroll the values");
      await page.locator(".player-view").first().focus();
      await page.keyboard.press("v");
      await page.keyboard.type("2");
      await page.evaluate(`${PLAYER}.drawNow()`); // the player does this itself a moment after the last change
      await page.keyboard.type("0");
      await page.keyboard.press("Enter");
      await until(page, `${PLAYER}.views[0].picked.vertex === 20`);
      await page.keyboard.press("v");
      await page.keyboard.type("9999");
      await page.keyboard.press("Enter");
      await until(page, `${PLAYER}.views[0].picked.vertex === 168`); // the last vertex
      await until(page, "document.activeElement.value === '168'");
      await page.keyboard.type("7");
      await page.keyboard.press("Escape"); // Escape discards the typed number
      await until(page, `${PLAYER}.views[0].picked.vertex === null`);
      assert.equal(await page.evaluate("document.activeElement.className"), "player-view player-left player-upper");
      const named = await page.evaluate(() => [...document.querySelectorAll(".player button, .player input, .player select")]
        .filter((control) => !(control.ariaLabel || control.textContent.trim() || control.labels?.length)).length);
      assert.equal(named, 0, "every control has a name");
    });
  },

  async "runs can be deselected, and the player frees its graphics"() {
    await withPage("page", { calm: true }, async (page) => {
      await page.locator(".player-runs summary").click();
      await page.locator(".player-runs input").nth(1).uncheck();
      await until(page, `${PLAYER}.views.length === 2 && ${PLAYER}.decoded`);
      assert.equal(await page.locator(".player-view").count(), 2);
      await page.evaluate(`${PLAYER}.dispose()`);
      assert.equal(await page.evaluate("document.querySelector('.player-stage canvas').getContext('webgl2').isContextLost()"), true);
    });
  },

  async "on a phone, a tap picks, and no element is wider than the screen"() {
    await withPage("page", { calm: true, width: 420, height: 800, touch: true }, async (page) => {
      assert.ok(await page.evaluate("document.documentElement.scrollWidth <= 420"));
      const { x, y } = await onScreen(page, 6 * 13 + 6);
      await page.touchscreen.tap(x, y);
      await until(page, `${PLAYER}.hasPick()`);
    });
  },
};

let failed = 0, passed = 0;
for (const [name, test] of Object.entries(tests)) {
  if (only && !name.includes(only)) continue;
  const start = performance.now();
  try {
    await test();
    ++passed;
    console.log(`ok      ${name} (${Math.round(performance.now() - start)} ms)`);
  } catch (error) {
    ++failed;
    console.log(`FAILED  ${name}\n${error.stack ?? error}`);
  }
}
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
