// A headless browser with software graphics, as the tests use it.
import { createRequire } from "node:module";
import { existsSync } from "node:fs";

// How long a page may take for one thing. A machine that computes beside the tests is ten times as slow as a
// free one, on which nothing here takes 10 s. What hangs fails all the same.
const PATIENCE_S = 120;

export const CHROMIUM = process.env.BENDLAB_CHROMIUM ?? "/usr/bin/chromium";

/** Opens a page; every console error, exception and request is noted. */
export async function opened(address, { width = 1200, height = 900, dark = false, calm = false, touch = false } = {}) {
  const { chromium } = createRequire(new URL("../../../analysis/viewer/package.json", import.meta.url))("playwright-core");
  const browser = await chromium.launch({ executablePath: CHROMIUM, args: ["--use-angle=swiftshader",
    "--enable-unsafe-swiftshader", "--no-sandbox", "--ignore-gpu-blocklist"] });
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: dark ? "dark" : "light",
    reducedMotion: calm ? "reduce" : "no-preference", hasTouch: touch, acceptDownloads: true });
  context.setDefaultTimeout(1000 * PATIENCE_S);
  const page = await context.newPage();
  const errors = [], requests = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("request", (request) => !/^(data|blob):/.test(request.url()) && requests.push(request.url()));
  await page.goto(address);
  return { browser, page, errors, requests };
}

/** Waits until an expression is true. (The page forbids eval, which waitForFunction() needs.) */
export async function until(page, expression) {
  for (const end = Date.now() + 1000 * PATIENCE_S; !(await page.evaluate(expression));) {
    if (Date.now() > end) throw new Error(`not within ${PATIENCE_S} s: ${expression}`);
    await page.waitForTimeout(30);
  }
}

/** Whether tests can run here; else prints why not. */
export function usable() {
  const reason = !existsSync(CHROMIUM) ? `no browser at ${CHROMIUM} (set BENDLAB_CHROMIUM)`
    : !existsSync(new URL("../../../analysis/viewer/node_modules/playwright-core", import.meta.url))
      ? "playwright-core is missing: npm ci in analysis/viewer" : null;
  if (reason) console.log(`skipped: ${reason}`);
  return !reason;
}
