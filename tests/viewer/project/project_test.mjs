// Uses the committed pages like a reader: project_test.mjs RESULTS FOLDER [SCREENSHOTS]
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { opened, until, usable } from "../player/browser.mjs";
import { found } from "../../../analysis/viewer/src/chooser/found.js";

if (!usable()) process.exit(77);
const { axisScale } = await import("../../../analysis/viewer/src/charts/scales.js"); // needs the npm packages
const [results, folder, shots] = process.argv.slice(2);
const only = process.env.BENDLAB_VIEWER_TEST; // part of the name of a test
const PAGES = ["", "paper/", "verification/", "stiffness/", "accuracy/", "stability/", "performance/", "plain/"];
const runs = JSON.parse(readFileSync(`${results}/accuracy/summary.json`, "utf8"));

async function withPage(name, how, use, address = "") {
  const all = await opened(`file://${results}/${name}index.html${address}`, { calm: true, ...how });
  try {
    await all.page.waitForFunction(() => document.readyState === "complete");
    await use(all.page);
    assert.deepEqual(all.errors, [], name);
    assert.deepEqual(
      all.requests.filter((url) => !url.startsWith(`file://${results}/`)),
      [],
    );
  } finally {
    await all.browser.close();
  }
}

const everywhere = async (how, use) => {
  for (const name of PAGES) await withPage(name, how, (page) => use(page, name));
};

// Lists texts whose contrast to their background is below level AA. Runs in the page.
function faint() {
  const parsed = (text) => (text.match(/[\d.]+/g) ?? []).map(Number);
  const light = (c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);
  const luminance = ([r, g, b]) => 0.2126 * light(r) + 0.7152 * light(g) + 0.0722 * light(b);
  const ground = (element) => {
    for (let at = element; at; at = at.parentElement) {
      const colour = parsed(getComputedStyle(at).backgroundColor);
      if (colour.length === 3 || colour[3] > 0.99) return colour;
    }
    return [255, 255, 255];
  };
  const texts = [];
  for (const element of document.querySelectorAll("body *")) {
    const own = [...element.childNodes].some((node) => node.nodeType === 3 && node.data.trim());
    if (!own || !element.getClientRects().length || element.closest("script, option, :disabled")) continue;
    const style = getComputedStyle(element);
    if (Number(style.opacity) < 0.5 || element.classList.contains("anchor")) continue; // shown on focus
    const text = parsed(element.closest("svg") ? style.fill : style.color);
    const [low, high] = [luminance(text), luminance(ground(element))].sort((a, b) => a - b);
    const large = parseFloat(style.fontSize) >= 24 || (parseFloat(style.fontSize) >= 18.7 && style.fontWeight >= 700);
    const ratio = (high + 0.05) / (low + 0.05);
    if (ratio < (large ? 3 : 4.5))
      texts.push(`${element.tagName}.${element.className.baseVal ?? element.className} ${ratio.toFixed(2)}`);
  }
  return [...new Set(texts)];
}

const tests = {
  async "every page opens without an error, and its text has contrast AA in light and dark mode"() {
    for (const dark of [false, true])
      await everywhere({ dark }, async (page, name) => {
        assert.deepEqual(await page.evaluate(faint), [], `${name} dark: ${dark}`);
        if (shots) await page.screenshot({ path: `${shots}/${name.replace("/", "") || "start"}${dark ? "-dark" : ""}.png` });
      });
  },

  async "every page begins with its answer, and links every page and section"() {
    await everywhere({}, async (page, name) => {
      assert.equal(await page.$$eval(".site a", (links) => links.length), PAGES.length);
      const current = await page.getAttribute(".site [aria-current=page]", "href");
      assert.ok(current.endsWith(name ? `${name}index.html` : "index.html"), current);
      if (name) {
        const [answer, first] = await page.evaluate(() => [
          document.querySelector(".answer").getBoundingClientRect().top,
          document.querySelector("h2").getBoundingClientRect().top,
        ]);
        assert.ok(answer < 300 && answer < first, name);
      }
      const dead = await page.$$eval("a[href^='#']", (links) =>
        links.map((link) => link.hash.slice(1)).filter((id) => id && !id.startsWith("run-") && !document.getElementById(id)),
      );
      assert.deepEqual(dead, [], name);
      assert.match(await page.textContent(".foot"), name ? /Commit.*Date.*Machine/s : /analysis\/page\.py/);
    });
  },

  async "a script that is inserted into a page does not run"() {
    for (const name of PAGES) {
      const all = await opened(`file://${results}/${name}index.html`, { calm: true });
      const title = await all.page.title();
      await all.page.evaluate(() => {
        const script = document.createElement("script");
        script.textContent = "document.title = 'injected'";
        document.body.append(script);
      });
      // After a timeout, as the policy does not apply to code that a debugger evaluates directly.
      const evaluated = await all.page.evaluate(
        () =>
          new Promise((done) =>
            setTimeout(() => {
              try {
                done(new Function("return true")());
              } catch {
                done(false);
              }
            }),
          ),
      );
      assert.equal(await all.page.title(), title);
      assert.equal(evaluated, false, name);
      assert.ok(all.errors.some((text) => /Content Security Policy/.test(text)));
      await all.browser.close();
    }
  },

  async "at the width of a tablet, no element is off the screen"() {
    await everywhere({ width: 820 }, async (page, name) => {
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 820, name);
    });
  },

  async "on a phone, no element is off the screen, and verdicts are cards"() {
    await everywhere({ width: 420, height: 900, touch: true }, async (page, name) => {
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 420, name);
      const right = await page.$$eval(".cards .verdict, .cards .share", (cells) =>
        Math.max(0, ...cells.filter((cell) => cell.getClientRects().length).map((cell) => cell.getBoundingClientRect().right)),
      );
      assert.ok(right <= 420, `${name}: ${right}`);
      const tall = await page.$$eval(".scroll.tall", (all) =>
        Math.max(0, ...all.map((element) => element.clientHeight)),
      );
      assert.ok(tall <= 900, `${name}: a table is ${tall} px tall`);
      if (shots) await page.screenshot({ path: `${shots}/${name.replace("/", "") || "start"}-420.png` });
    });
  },

  async "print has no controls, dark text and a white background"() {
    await everywhere({ dark: true, width: 800 }, async (page, name) => {
      await page.emulateMedia({ media: "print", colorScheme: "dark" });
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 800, `${name} is cut off`);
      const shown = await page.$$eval("header.bar, .button, .filters, .site nav", (all) =>
        all.filter((element) => element.getClientRects().length).map((element) => element.className),
      );
      assert.deepEqual(shown, [], name);
      await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
      const bars = await page.$$eval("rect.bar", (all) => all.map((bar) => getComputedStyle(bar).display));
      assert.ok(bars.every((display) => display !== "none"), name);
      assert.equal(await page.locator("svg.picture:not([width='680'])").count(), 0, name);
      assert.equal(await page.locator(".legend.beside").count(), 0, name);
      const [ground, text] = await page.evaluate(() => {
        const style = getComputedStyle(document.body);
        return [style.backgroundColor, style.color];
      });
      assert.deepEqual([ground, text], ["rgb(255, 255, 255)", "rgb(0, 0, 0)"], name);
      if (shots) await page.pdf({ path: `${shots}/${name.replace("/", "") || "start"}.pdf` });
    });
  },

  async "every cell that opens by click can be reached by keyboard, and the focus is visible"() {
    await everywhere({}, async (page, name) => {
      const unreachable = await page.$$eval("[data-run]", (cells) =>
        cells.filter((cell) => !cell.matches("button") && !cell.querySelector("button")).length,
      );
      assert.equal(unreachable, 0, name);
      const stuck = await page.$$eval("a, button, select, input, summary", (all) =>
        all.filter((element) => element.tabIndex < 0).length,
      );
      assert.equal(stuck, 0, name);
      const visited = new Set();
      for (let i = 0; i < 40; ++i) {
        await page.keyboard.press("Tab");
        const now = await page.evaluate(() => {
          const element = document.activeElement;
          const style = getComputedStyle(element);
          const all = [...document.querySelectorAll("*")];
          return { at: all.indexOf(element), visible: style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0 };
        });
        assert.ok(now.visible, `${name}: no focus ring after ${i + 1} steps`);
        visited.add(now.at);
      }
      assert.ok(visited.size >= 20, `${name}: ${visited.size}`);
    });
  },

  async "a chart draws every point, and says which keys it knows"() {
    await everywhere({}, async (page, name) => {
      await page.$$eval("details", (all) => all.forEach((details) => details.setAttribute("open", "")));
      await page.waitForTimeout(500);
      const wrong = await page.$$eval("figure.chart.drawn", (figures) =>
        figures.flatMap(({ chart }) => {
          const { id, title, series, rows, joined } = chart.chart;
          const label = chart.plot.getAttribute("aria-label").replace(title, "");
          const runs = (rows ?? series).some(({ run, runs }) => run || runs?.flat().length);
          const wrong = [
            label.includes("Enter") !== runs && "Enter",
            label.includes("zoom") !== (!rows && !chart.bands) && "zoom",
          ];
          if (rows) return wrong.filter(Boolean).map((text) => `${id}: ${text}`);
          const points = chart.shown.flatMap(({ series, points }) => (series.line ? [] : points));
          const least = chart.value.scale.domain()[0];
          if (chart.bands || !joined) wrong.push(points.some((p) => !p.drawn) && "a point without a mark");
          const marked = points.filter((p) => p.drawn?.classList.contains("mark"));
          wrong.push(chart.state.log && marked.some((p) => p.y < least) && "a false mark");
          return wrong.filter(Boolean).map((text) => `${id}: ${text}`);
        }),
      );
      assert.deepEqual(wrong, [], name);
    });
  },

  async "names of categories are whole on a phone, and stay when all series are hidden"() {
    await withPage("paper/", { width: 390, height: 900 }, async (page) => {
      await page.locator("figure[data-chart=ablations]").scrollIntoViewIfNeeded();
      await page.waitForSelector("figure[data-chart=ablations] .category");
      const names = await page.locator("figure[data-chart=ablations] .category").allTextContents();
      assert.ok(names.length > 50 && names.every((text) => !text.endsWith("…")), names.join("; "));
    });
    await withPage("accuracy/", {}, async (page) => {
      const figure = page.locator("figure[data-chart=levels]");
      await figure.scrollIntoViewIfNeeded();
      for (const name of await figure.locator(".series-name").all()) await name.click();
      assert.ok((await figure.locator(".category").count()) > 5);
    });
  },

  async "a malformed address changes nothing"() {
    await withPage("accuracy/", {}, (page) => page.waitForSelector("svg.picture"), "#run-100%");
  },

  async "Enter on a cell opens its run: worst metric, limit, config and command"() {
    await withPage("stability/", {}, async (page) => {
      const cell = page.locator("button.v.red").first();
      const name = await cell.getAttribute("aria-label");
      await cell.focus();
      await page.keyboard.press("Enter");
      const dialog = page.locator("dialog.run[open]");
      const [model, precision] = name.split(/[,:] ?/);
      assert.match(await dialog.locator("h2").textContent(), new RegExp(`${model}, ${precision}$`));
      assert.match(await dialog.locator(".worst").textContent(), /limit .*broken/);
      assert.match(await dialog.locator("code").first().textContent(), /^\.\/bendlab run configs\/stability\//);
      await dialog.locator("summary").last().click();
      const config = JSON.parse(await dialog.locator("pre").last().textContent());
      assert.equal(config.bending.model, model);
      assert.equal(config.solver.precision, precision);
      assert.match(await page.evaluate(() => location.hash), /^#run-/);
      await page.keyboard.press("Escape");
      assert.equal(await page.locator("dialog.run[open]").count(), 0);
      assert.equal(await cell.evaluate((element) => element === document.activeElement), true);
    });
  },

  async "a red cell shows the last frame of its cloth"() {
    await withPage("stability/", {}, async (page) => {
      const id = await page.evaluate(() => {
        const data = JSON.parse(document.getElementById("bendlab-data").textContent);
        return data.runs.find((run) => run.frames).id;
      });
      await page.locator(`button.v.red[data-run="${id}"]`).click();
      await page.waitForSelector("dialog.run .player[data-decoded] canvas");
      const { time, end } = await page.$eval("dialog.run .player", ({ player }) => ({ time: player.time, end: player.last }));
      assert.ok(time >= end && end > 0);
      await page.keyboard.press("Escape");
    });
  },

  async "cloth moves by itself, except if the reader prefers reduced motion"() {
    for (const calm of [true, false])
      await withPage("paper/", { calm }, async (page) => {
        await page.locator("#motion").scrollIntoViewIfNeeded();
        await page.waitForSelector("main .player[data-decoded]");
        const time = () => page.$eval("main .player", ({ player }) => player.time);
        if (calm) {
          const before = await time();
          await page.waitForTimeout(1500);
          assert.equal(await time(), before);
        } else await until(page, "document.querySelector('main .player').player.time > 0");
      });
  },

  async "a share in the matrix opens its red runs one by one"() {
    await withPage("stability/", {}, async (page) => {
      const share = page.locator("td:has(> button.share)").nth(0);
      const count = (await share.getAttribute("data-run")).split(" ").length;
      await share.locator("button").click();
      assert.match(await page.textContent("dialog.run header"), new RegExp(`1 of ${count}\\b`));
      assert.ok(count > 1);
      await page.getByLabel("The next run").focus();
      for (let i = 1; i < count; ++i) await page.keyboard.press("Enter");
      assert.equal(await page.evaluate(() => document.activeElement.textContent), "Close");
      await page.keyboard.press("Escape");
    });
  },

  async "a cell of models and meshes counts its runs, and opens the runs that broke a bound"() {
    const mixed = JSON.parse(readFileSync(`${results}/plain/summary.json`, "utf8")).filter((run) =>
      ["metres", "millimetres", "methods"].includes(run.config),
    );
    const title = (run) => Object.entries(run.settings).map((pair) => pair.join(" ")).join(", ");
    await withPage("plain/", {}, async (page) => {
      const cells = await page.$$eval("table.matrix tbody tr", (rows) => {
        const heads = [...rows[0].closest("table").tHead.rows[0].cells].map((head) => head.textContent);
        return rows.flatMap((row) =>
          [...row.cells].slice(1).map((cell, i) => ({
            model: row.cells[0].textContent,
            mesh: heads[i + 1],
            text: cell.textContent,
            ring: Boolean(cell.querySelector(".ring")),
          })),
        );
      });
      const inCell = ({ model, mesh }) =>
        mixed.filter(({ settings }) => settings.model === model && settings.mesh === mesh);
      const wrong = (cell) => inCell(cell).filter((run) => run.broken.length);
      let counted = 0;
      for (const cell of cells) {
        const all = inCell(cell).length;
        counted += all;
        assert.equal(cell.text, all ? `${wrong(cell).length}/${all}` : "–", `${cell.model} on ${cell.mesh}`);
        assert.equal(cell.ring, wrong(cell).some((run) => run.verdict === "silent"));
      }
      assert.equal(counted, mixed.length);
      const most = cells.reduce((a, b) => (wrong(b).length > wrong(a).length ? b : a));
      const single = cells.find((cell) => wrong(cell).length === 1);
      for (const cell of [most, single].filter(Boolean)) {
        await page.locator(`table.matrix button[aria-label^="${cell.model} on ${cell.mesh}:"]`).focus();
        await page.keyboard.press("Enter");
        const titles = [];
        for (const next = page.getByLabel("The next run"); ; await next.click()) {
          titles.push(await page.textContent("#run-title"));
          if (!(await next.count()) || (await next.isDisabled())) break;
        }
        assert.deepEqual(titles.sort(), wrong(cell).map(title).sort(), `${cell.model} on ${cell.mesh}`);
        await page.keyboard.press("Escape");
      }
    });
  },

  async "tables sort by numbers and filter by words"() {
    await withPage("accuracy/", {}, async (page) => {
      const table = page.locator("table.sortable[data-rows=runs]");
      await page.locator("details", { has: table }).locator("summary").first().click();
      await table.getByRole("button", { name: /time per frame/ }).click();
      const column = await table.evaluate((element) =>
        [...element.tBodies[0].rows].map((row) => row.cells[8].textContent.trim()).filter((text) => text !== "–"),
      );
      const numbers = column.map(Number); // 0.0123 or 1.23e-05
      assert.ok(numbers.length > 500);
      numbers.forEach((x, i) => assert.ok(i === 0 || x >= numbers[i - 1], `${column[i - 1]} before ${column[i]}`));
      const section = page.locator("section[aria-labelledby=runs]");
      await section.locator("input[type=search]").fill("isometric beat");
      const expected = runs.filter((run) => run.model === "isometric" && run.experiment === "accuracy_beat").length;
      assert.match(await section.locator("output").textContent(), new RegExp(`^${expected} of ${runs.length} runs$`));
    });
  },

  async "the chooser answers with the cheapest measured run, and links this run"() {
    const scene = (run) => /^accuracy_(front_cantilever|paper_cantilever)/.test(run.experiment);
    const fits = runs.filter((run) => scene(run) && run.status === "complete" && run.error_physical_rms <= 0.02);
    const best = fits.reduce((a, b) => (b.ms_per_frame < a.ms_per_frame ? b : a));
    let href;
    await withPage("", {}, async (page) => {
      await page.getByLabel("My cloth").selectOption({ index: 1 });
      await page.getByLabel("Cells along its width").fill("12");
      await page.getByLabel("Error or time").fill("2");
      const answer = await page.textContent(".chosen .answer");
      assert.equal(await page.textContent(".chosen [role=status]"), answer);
      const { method, substeps, iterations } = best.settings;
      assert.ok(answer.startsWith(`${best.model} by ${method} on 12 cells, ${substeps} × ${iterations}`), answer);
      const read = parseFloat(answer.match(/: ([\d.]+) %/)[1]);
      assert.ok(Math.abs(read - 100 * best.error_physical_rms) < 0.01, answer);
      href = await page.locator(".chosen a").first().getAttribute("href");
      await page.locator(".chosen summary").click();
      const config = await page.textContent(".chosen pre");
      assert.equal(JSON.parse(config).solver.substeps, substeps);
      writeFileSync(`${folder}/chosen.json`, config);
      assert.equal(await page.locator(".chosen .note").count(), 0);
      await page.getByLabel("Its mesh is").selectOption({ index: 2 });
      assert.match(await page.textContent(".chosen"), /Accuracy was not measured on irregular/);
      await page.getByLabel("Cells along its width").fill("100");
      assert.match(await page.textContent(".chosen"), /Nothing was measured on 100 cells/);
      await page.getByLabel("Cells along its width").fill("0");
      const problem = /^Cells along its width: give a number of at least 1\.$/;
      assert.match(await page.textContent(".chosen"), problem);
      const described = await page.getByLabel("Cells along its width").getAttribute("aria-describedby");
      assert.match(await page.textContent(`#${described}[role=status]`), problem);
      await page.getByLabel("Cells along its width").fill("12");
      await page.getByLabel("Error or time").fill("0.000001");
      assert.match(await page.textContent(".chosen .answer"), /No measured run comes within/);
    });
    const [path, hash] = href.split("#");
    await withPage(path.replace("index.html", ""), {}, async (page) => {
      const error = parseFloat(await page.textContent("dialog.run .worst b"));
      assert.ok(Math.abs(error - 100 * best.error_physical_rms) < 0.01);
    }, `#${hash}`);
  },

  async "the answer of the chooser depends on priority, goal and limit"() {
    const same = { method: "pbd", cells: 8, scene: 0, family: "grid", unknown: 0 };
    const run = (model, error, ms, more) => ({ id: model, model, error, ms, ...same, ...more });
    const data = {
      runs: [
        run("a", 1, 5),
        run("a", 3, 1),
        run("a", 2, 7, { method: "newton" }),
        run("b", 0.5, 9),
        run("c", 0.5, 2, { scene: 1, unknown: 1.5 }),
      ],
      families: { grid: "grid", ball: "ball" },
      stability: { "": { a: [4, 10], b: [1, 10] } },
    };
    const asked = { scene: 0, family: "grid", cells: 8, matters: "shape", goal: "error", most: 1 };
    const of = (changes) => found(data, { ...asked, ...changes });
    assert.equal(of({}).best.ms, 5);
    assert.equal(of({ most: 3 }).best.ms, 1);
    assert.equal(of({ matters: "stability" }).best.model, "b");
    assert.equal(of({ goal: "budget", most: 5 }).best.error, 1);
    assert.deepEqual([of({ most: 0.1 }).fits, of({ most: 0.1 }).best.model], [false, "b"]);
    assert.deepEqual([of({ scene: 1, most: 1.5 }).fits, of({ scene: 1, most: 1.5 }).notes], [true, []]);
    // An error of 0.5 % is not certainly below 1 % if the reference itself is known only to 1.5 %.
    assert.equal(of({ scene: 1, most: 1 }).fits, false);
    assert.match(of({ scene: 1, most: 1 }).notes[0], /Errors below 1\.5 % are not known/);
    assert.equal(of({ scene: 2 }).best, null);
    assert.match(of({ family: "ball" }).notes[0], /not measured on ball/);
    assert.match(of({ cells: 16 }).notes[0], /Nothing was measured on 16 cells/);
    assert.deepEqual(of({}).others.map((other) => `${other.model} by ${other.method}`), ["b by pbd", "a by newton"]);
  },

  async "an axis writes the values of a sweep with three digits"() {
    const values = [1089, 66049, 263169, 1050625];
    const { ticks, text } = axisScale("log", [1000, 2e6], [0, 600], values);
    assert.deepEqual(ticks.map(text), ["1089", "66049", "2.63·10⁵", "1.05·10⁶"]);
    const decades = axisScale("log", [1e-7, 1e6], [0, 600]);
    assert.deepEqual([1e5, 2e-4, 1e-7].map(decades.text), ["10⁵", "2·10⁻⁴", "10⁻⁷"]);
  },

  async "a chart shows values on keys, and its data can be saved"() {
    await withPage("stiffness/", {}, async (page) => {
      const figure = page.locator("figure.chart").first();
      await figure.scrollIntoViewIfNeeded();
      await page.waitForSelector("figure.chart svg.picture");
      await figure.locator(".plot").focus();
      await page.keyboard.press("ArrowDown");
      const [, value] = await figure.locator(".tip dd").allTextContents();
      assert.ok(value);
      const [download] = await Promise.all([page.waitForEvent("download"), figure.getByText("CSV").click()]);
      const lines = readFileSync(await download.path(), "utf8").trim().split("\n");
      assert.match(lines[0], /^series,name,ratio/);
      assert.ok(lines.length > 10);
    });
  },
};

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
  if (only && !name.includes(only)) continue;
  try {
    await test();
    console.log(`ok      ${name}`);
  } catch (error) {
    ++failed;
    console.log(`FAILED  ${name}\n${error.stack}`);
  }
}
process.exit(failed ? 1 : 0);
