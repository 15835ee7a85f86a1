// Uses the page of test_report.py like a reader, and compares it with the values that h5py read.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { opened, usable } from "../player/browser.mjs";

if (!usable()) process.exit(77);
const [folder, shots] = process.argv.slice(2);
const expected = JSON.parse(readFileSync(`${folder}/expected.json`, "utf8"));
const only = process.env.BENDLAB_VIEWER_TEST; // part of the name of a test

async function withPage(how, use, address = "") {
  const all = await opened(`file://${folder}/page.html${address}`, { calm: true, ...how });
  try {
    await all.page.waitForSelector("figure.chart svg.picture");
    await use(all.page);
    assert.deepEqual(all.errors, []);
    assert.deepEqual(
      all.requests.filter((url) => !url.startsWith("file:")),
      [],
    );
    assert.equal(all.requests.length, 1, `requests: ${all.requests}`);
  } finally {
    await all.browser.close();
  }
}

/** Reads a number in the format of the page: 0.00123 or 1.23·10⁻⁵. */
function read(text) {
  const [first, power] = text.replace("−", "-").split("·10");
  const exponent = power?.replace(/[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]/g, (c) => (c === "⁻" ? "-" : "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c))) ?? 0;
  return parseFloat(first) * 10 ** Number(exponent);
}

const shownRows = (page) =>
  page.$$eval("table.sortable tbody tr", (rows) =>
    rows.filter((row) => row.getClientRects().length).map((row) => row.cells[0].dataset.run),
  );

const tests = {
  async "texts do not become markup"() {
    await withPage({}, async (page) => {
      assert.equal(await page.title(), "bendlab: hostile");
      assert.equal(await page.textContent("p.lead"), expected.markup);
      assert.equal(await page.$$eval("img, main script", (elements) => elements.length), 0);
      await page.click("td[data-run] button");
      await page.click("dialog.run summary");
      assert.equal(await page.$$eval("dialog.run img, dialog.run script", (elements) => elements.length), 0);
      assert.match(await page.textContent("dialog.run .worst"), /<script>document/);
      assert.match(await page.textContent("dialog.run code"), /it.*s <b> "quoted" <!--\.json/);
    });
  },

  async "a script that is inserted into the page does not run"() {
    const all = await opened(`file://${folder}/page.html`, { calm: true });
    await all.page.evaluate(() => {
      const script = document.createElement("script");
      script.textContent = "document.title = 'injected'";
      document.body.append(script);
      const link = document.createElement("a");
      link.setAttribute("onclick", "document.title = 'injected'");
      document.body.append(link);
      link.click();
    });
    assert.equal(await all.page.title(), "bendlab: hostile");
    assert.ok(all.errors.some((text) => /Content Security Policy/.test(text)));
    await all.browser.close();
  },

  async "the values under the pointer are median and range of the run files"() {
    await withPage({}, async (page) => {
      const figure = page.locator("figure[data-chart='s1-against-1']");
      await figure.scrollIntoViewIfNeeded();
      const points = await figure.evaluate((element) =>
        element.chart.shown.flatMap(({ series, points }) =>
          points.map((p) => ({ label: series.label, x: p.x, at: p.at })),
        ),
      );
      assert.equal(points.length, Object.keys(expected.medians).length);
      const compared = new Set();
      const plot = figure.locator(".plot");
      for (const {
        at: [x, y],
      } of points) {
        // where marks overlap, the tip shows only one mark
        const box = await plot.boundingBox();
        await page.mouse.move(box.x + x, box.y + y);
        const shown = await figure.locator(".tip dd").allTextContents();
        const label = await figure.locator(".tip strong").textContent();
        const key = `${label} ${shown[2]}`;
        const [median, low, high] = expected.medians[key];
        const close = (text, value) =>
          assert.ok(Math.abs(read(text) - value) <= 6e-4 * value, `${key}: ${text}, ${value}`);
        close(shown[0], median);
        shown[1].split(", ").forEach((text, i) => close(text, [low, high][i]));
        assert.equal(shown[3], "3");
        compared.add(key);
      }
      assert.ok(compared.size >= 3, `${[...compared]}`);
      await page.mouse.down({ button: "right" });
      await page.mouse.up({ button: "right" });
      assert.equal(await page.locator("dialog[open]").count(), 0);
      const bars = page.locator("figure[data-chart=s1-passes]");
      await bars.locator(".plot").press("ArrowDown");
      assert.equal(await bars.locator(".tip").isVisible(), true);
      await page.keyboard.press("Escape");
      assert.equal(await bars.locator(".tip").isVisible(), false);
    });
  },

  async "the CSV file of a chart has the values of the chart"() {
    await withPage({}, async (page) => {
      const figure = page.locator("figure[data-chart='s1-against-1']");
      const [download] = await Promise.all([page.waitForEvent("download"), figure.getByText("CSV").click()]);
      const rows = readFileSync(await download.path(), "utf8")
        .trim()
        .split("\n")
        .map((line) => line.split(","));
      const at = (name) => rows[0].indexOf(name);
      assert.equal(rows.length, 1 + Object.keys(expected.medians).length);
      for (const row of rows.slice(1)) {
        const numbers = expected.medians[`${row[0]} ${row[at("/mesh/cells")]}`];
        ["mean_strain", "mean_strain_low", "mean_strain_high"].forEach((name, i) =>
          assert.ok(Math.abs(row[at(name)] - numbers[i]) <= 6e-5 * numbers[i]),
        );
      }
    });
  },

  async "series can be switched, axes can be logarithmic, zoom can be reset"() {
    await withPage({}, async (page) => {
      const figure = page.locator("figure[data-chart='s1-against-1']");
      const series = () => figure.locator("svg.picture .series").count();
      assert.equal(await series(), 3);
      await figure.locator(".series-name", { hasText: "dihedral" }).click();
      assert.equal(await series(), 2);
      await figure.locator(".series-name", { hasText: "adaptive" }).click({ modifiers: ["Shift"] });
      assert.equal(await series(), 1);
      await figure.locator(".series-name", { hasText: "adaptive" }).click({ modifiers: ["Shift"] });
      assert.equal(await series(), 3);
      const heights = () =>
        figure.evaluate((element) =>
          element.chart.shown.flatMap(({ points }) => points.map((p) => [p.y, p.at[1]])),
        );
      if (await figure.locator(".tools .button[aria-pressed=false]", { hasText: "Log" }).count())
        await figure.locator(".tools .button", { hasText: "Log" }).click();
      const [[y0, p0], ...rest] = await heights();
      const [y1, p1] = rest.find(([y]) => Math.abs(Math.log(y / y0)) > 0.3);
      const [y2, p2] = rest.toSorted(
        (a, b) => Math.abs(Math.log(b[0] / y0)) - Math.abs(Math.log(a[0] / y0)),
      )[0];
      assert.ok(Math.abs((p1 - p0) / Math.log(y1 / y0) - (p2 - p0) / Math.log(y2 / y0)) < 0.5);
      const plot = figure.locator(".plot");
      await plot.scrollIntoViewIfNeeded();
      const box = await plot.boundingBox();
      await page.mouse.move(box.x + box.width * 0.35, box.y + 120);
      await page.mouse.down();
      await page.mouse.move(box.x + box.width * 0.6, box.y + 120, { steps: 4 });
      await page.mouse.up();
      const zoom = await figure.evaluate((element) => element.chart.state.zoom);
      assert.ok(zoom[0] > 4 && zoom[1] < 8 && zoom[0] < zoom[1], String(zoom));
      await figure.getByText("Reset zoom").click();
      assert.equal(await figure.evaluate((element) => element.chart.state.zoom), null);
    });
  },

  async "a column sorts in both directions"() {
    await withPage({}, async (page) => {
      const head = page.locator("table.sortable th", { hasText: "mean strain" }).locator("button");
      await head.click();
      const values = async () => (await shownRows(page)).map((id) => expected.values[id]);
      const ordered = Object.values(expected.values).sort((a, b) => a - b);
      const close = (actual, wanted) =>
        actual.forEach((x, i) =>
          assert.ok(Math.abs(x - wanted[i]) <= 1e-8 * wanted[i], `${i}: ${x}, ${wanted[i]}`),
        );
      close(await values(), ordered);
      assert.equal(await page.locator("th[aria-sort='ascending']").count(), 1);
      await head.click();
      close(await values(), ordered.toReversed());
    });
  },

  async "words and lists filter the rows"() {
    await withPage({}, async (page) => {
      assert.equal((await shownRows(page)).length, expected.count);
      await page.fill(".filters input", "adaptive");
      await page.selectOption(".filters select[aria-label^='cells']", { label: "6" });
      assert.deepEqual((await shownRows(page)).toSorted(), expected.adaptive6);
      assert.match(await page.textContent(".filters output"), /^3 of 27 runs$/);
      await page.fill(".filters input", "nothing like it");
      assert.equal((await shownRows(page)).length, 0);
    });
  },

  async "a run opens, leads to the next run, and gives the focus back"() {
    await withPage({}, async (page) => {
      await page.fill(".filters input", "adaptive");
      const rows = await shownRows(page);
      const button = page.locator(`td[data-run='${rows[1]}'] button`);
      await button.focus();
      await page.keyboard.press("Enter");
      assert.ok(await page.locator("dialog.run[open]").count());
      assert.match(await page.textContent("dialog.run header"), /2 of 9/);
      assert.equal(await page.evaluate(() => location.hash), `#run-${rows[1]}`);
      await page.waitForSelector("dialog.run .player.player-ready");
      await page.click("dialog.run [aria-label='The next run']");
      assert.equal(await page.evaluate(() => location.hash), `#run-${rows[2]}`);
      const settings = await page.locator("dialog.run td.t code").allTextContents();
      assert.ok(settings.includes("/initial/seed") || settings.includes("/mesh/cells"), String(settings));
      await page.keyboard.press("Escape");
      await page.waitForFunction(() => !location.hash);
      assert.equal(await page.locator("dialog.run[open]").count(), 0);
      assert.equal(
        await page.evaluate(() => document.activeElement.closest("[data-run]")?.dataset.run),
        rows[1],
      );
    });
  },

  async "an address opens a run"() {
    await withPage(
      {},
      async (page) => {
        assert.ok(await page.locator("dialog.run[open]").count());
        assert.match(await page.textContent("dialog.run"), new RegExp(Object.keys(expected.values)[0]));
      },
      `#run-${Object.keys(expected.values)[0]}`,
    );
  },

  async "every control can be reached by keyboard"() {
    await withPage({}, async (page) => {
      const wanted = await page.evaluate(() => {
        const able = "a[href], button:not(:disabled), select, input, summary, [tabindex='0']";
        const all = [...document.querySelectorAll(able)].filter(
          (element) =>
            element.getClientRects().length &&
            !element.closest("details:not([open]) > :not(summary)") &&
            element.tabIndex >= 0,
        );
        all.forEach((element, i) => {
          element.dataset.n = i;
        });
        return all.length;
      });
      const reached = new Set();
      for (let i = 0; i < wanted + 40 && reached.size < wanted; ++i) {
        await page.keyboard.press("Tab");
        const at = await page.evaluate(() => document.activeElement.dataset?.n);
        if (at !== undefined) reached.add(at); // the controls of a chart that is drawn later have no number
      }
      const missed = await page.evaluate(
        (numbers) =>
          [...document.querySelectorAll("[data-n]")]
            .filter((element) => !numbers.includes(element.dataset.n))
            .map((element) => element.outerHTML.slice(0, 120)),
        [...reached],
      );
      assert.deepEqual(missed, []);
      const visible = await page.evaluate(() => {
        const { outlineStyle, outlineWidth } = getComputedStyle(document.activeElement);
        return outlineStyle !== "none" && parseFloat(outlineWidth) > 0;
      });
      assert.ok(visible);
      await page.locator("figure[data-chart='s1-against-1'] .plot").focus();
      await page.keyboard.press("ArrowRight");
      await page.keyboard.press("ArrowRight");
      assert.ok(await page.locator("figure[data-chart='s1-against-1'] .tip:visible").count());
      await page.keyboard.press("Enter");
      assert.match(await page.textContent("dialog.run header"), /1 of 3/);
    });
  },

  async "keys choose runs on the lines, and groups"() {
    await withPage({}, async (page) => {
      const counted = () => page.textContent("#explorer .tools output");
      const handle = page.locator("#explorer .handle").last();
      assert.equal(await page.getAttribute("#explorer .parallel svg", "role"), "group");
      assert.match(await handle.getAttribute("aria-valuetext"), /^all, \d/);
      await handle.focus();
      for (const key of ["ArrowDown", "ArrowDown", "ArrowRight"]) await page.keyboard.press(key);
      assert.equal(await counted(), "24 of 27 runs");
      assert.match(await handle.getAttribute("aria-valuetext"), /^\d\S* to \d/);
      const groups = page.locator("#explorer tbody button");
      assert.equal(await page.locator("#explorer tbody [aria-pressed=true]").count(), 0);
      await groups.nth(1).focus();
      await page.keyboard.press("Enter");
      assert.equal(await counted(), "9 of 27 runs");
      assert.match(await handle.getAttribute("aria-valuetext"), /^all/);
      assert.equal(await groups.nth(1).evaluate((button) => button === document.activeElement), true);
      await groups.nth(2).press("Enter");
      assert.equal(await counted(), "18 of 27 runs");
      const pressed = await groups.evaluateAll((all) => all.map((button) => button.ariaPressed));
      assert.deepEqual(pressed, ["false", "true", "true"]);
      await handle.press("ArrowUp");
      await handle.press("ArrowDown");
      assert.equal(await counted(), "26 of 27 runs");
      await page.click("#explorer summary");
      await page.locator("#explorer .choices input:checked").last().uncheck();
      assert.equal(await counted(), "27 runs", "a line that is no longer shown chooses no runs");
    });
  },

  async "a chart of the explorer has a number above an axis, and goes when another is drawn"() {
    await withPage({}, async (page) => {
      const [numbers, all] = await page.$$eval("#explorer .tools select", (lists) =>
        lists.slice(1).map((list) => [...list.options].map((option) => option.text)),
      );
      assert.ok(!numbers.includes("model") && all.includes("model"));
      const listeners = await page.evaluate(() => {
        let count = 0;
        for (const [name, by] of [["addEventListener", 1], ["removeEventListener", -1]]) {
          const own = document[name];
          document[name] = (type, ...more) => {
            count += type === "bendlab:chosen" ? by : 0;
            own.call(document, type, ...more);
          };
        }
        const list = [...document.querySelectorAll("#explorer .tools select")].at(-1);
        for (let i = 0; i < 5; ++i) {
          list.selectedIndex = i;
          list.dispatchEvent(new Event("change"));
        }
        return count;
      });
      assert.equal(listeners, 0);
    });
  },

  async "on a phone, no element is wider than the screen, and rows are cards"() {
    await withPage({ width: 420 }, async (page) => {
      await page.waitForTimeout(500);
      await page.screenshot({ path: `${shots}/phone.png`, fullPage: true });
      const wide = await page.evaluate(() =>
        [...document.querySelectorAll("body *")]
          .filter(
            (element) =>
              element.getBoundingClientRect().right > innerWidth + 1 &&
              !element.closest(".scroll, nav, .player, svg"),
          )
          .map((element) => element.outerHTML.slice(0, 100)),
      );
      assert.deepEqual(wide, []);
      assert.equal(await page.$eval("table.sortable td", (cell) => getComputedStyle(cell).display), "flex");
      assert.equal(
        await page.$eval("table.sortable td:nth-child(2)", (cell) => cell.dataset.label),
        "verdict",
      );
      const expectation = await page.$$eval("section[aria-labelledby=expectations] tr:first-child td", (cells) =>
        cells.map((cell) => [cell.dataset.label, getComputedStyle(cell).display]),
      );
      assert.deepEqual(expectation[0], ["verdict", "flex"]);
      assert.deepEqual(
        expectation.map(([label]) => label),
        ["verdict", "what is expected", "worst", "in", "why"],
      );
    });
  },

  async "runs that are chosen on a line are chosen in the table, the groups and the charts"() {
    await withPage({}, async (page) => {
      const all = (await shownRows(page)).length;
      const lines = await page.$$eval("#explorer .run-line", (curves) => curves.length);
      const handle = page.locator("#explorer .handle").last();
      await handle.scrollIntoViewIfNeeded();
      const box = await handle.boundingBox();
      await page.mouse.move(box.x + box.width / 2, box.y + 2);
      await page.mouse.down();
      await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 3 });
      await page.mouse.up();
      const chosen = await shownRows(page);
      assert.ok(chosen.length > 0 && chosen.length < all, `${chosen.length} of ${all}`);
      const pale = await page.$$eval("#explorer .run-line.off", (curves) => curves.length);
      assert.equal(lines - pale, chosen.length);
      assert.match(await page.textContent("#explorer .tools output"), new RegExp(`^${chosen.length} of ${lines} `));
      const counts = await page.$$eval("#explorer tbody tr", (rows) => rows.map((row) => Number(row.cells[1].textContent)));
      assert.equal(counts.reduce((sum, count) => sum + count, 0), chosen.length);
      assert.ok(await page.$$eval("figure.chart .mark.off", (marks) => marks.length));
      await page.click("#explorer .tools button >> text=All runs");
      assert.equal((await shownRows(page)).length, all);
    });
  },

  async "the player first shows the runs that the text names, under labels that tell all runs apart"() {
    await withPage({}, async (page) => {
      await page.waitForSelector(".player[data-decoded]");
      const labels = await page.$$eval("main .player-name", (names) => names.map((name) => name.textContent));
      assert.equal(labels.length, 3);
      assert.equal(await page.textContent(".player-runs summary"), `3 of ${expected.count} runs shown`);
      const all = await page.$$eval(".player-choices label", (boxes) => boxes.map((box) => box.textContent));
      assert.equal(new Set(all).size, expected.count);
    });
  },

  async "a run can be compared with any other run"() {
    await withPage({}, async (page) => {
      const [first, , third] = await shownRows(page);
      await page.click(`td[data-run="${first}"] button`);
      const titles = await page.$$eval("dialog.run .choice option", (options) => options.map((o) => o.textContent));
      const title = await page.evaluate((id) => JSON.parse(document.getElementById("bendlab-data").textContent).runs
        .find((run) => run.id === id).title, third);
      await page.selectOption("dialog.run .choice select", { index: titles.indexOf(title) });
      const heads = await page.$$eval("dialog.run th", (cells) => cells.map((cell) => cell.textContent));
      assert.ok(heads.filter((text) => text === title).length >= 1, heads.join("; "));
    });
  },

  async "dark mode and print have their own colours"() {
    const ground = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    await withPage({ dark: true }, async (page) => {
      assert.equal(await ground(page), "rgb(20, 23, 26)");
      await page.screenshot({ path: `${shots}/dark.png`, fullPage: true });
      await page.emulateMedia({ media: "print" });
      assert.equal(await ground(page), "rgb(255, 255, 255)");
      assert.equal(await page.locator("header.bar:visible, .filters:visible").count(), 0);
      assert.ok(await page.locator("rect.bar:visible").count());
      await page.screenshot({ path: `${shots}/print.png`, fullPage: true });
    });
    await withPage({}, async (page) => {
      assert.equal(await ground(page), "rgb(255, 255, 255)");
      await page.screenshot({ path: `${shots}/light.png`, fullPage: true });
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
