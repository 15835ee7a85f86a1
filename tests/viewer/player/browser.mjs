// A headless browser with software graphics, for the tests.
import { createRequire } from "node:module";
import { existsSync } from "node:fs";

// Time limit of a single action in a page. On a free machine, no action takes 10 s. On a busy machine, an
// action takes up to ten times as long. A page that hangs still fails.
const PATIENCE_S = 120;

export const CHROMIUM = process.env.BENDLAB_CHROMIUM ?? "/usr/bin/chromium";

/** Opens a page, and records console errors, console warnings, exceptions and requests. */
export async function opened(address, { width = 1200, height = 900, dark = false, calm = false, touch = false,
                                        early = [] } = {}) {
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
  if (early.length) // buttons that are clicked as soon as they exist
    await page.addInitScript((labels) => document.addEventListener("DOMContentLoaded", () => setTimeout(() => {
      for (const label of labels) document.querySelector(`[aria-label="${label}"]`)?.click();
    })), early);
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

/** Whether the browser tests can run on this machine; prints the reason if not. */
export function usable() {
  const reason = !existsSync(CHROMIUM) ? `no browser at ${CHROMIUM} (set BENDLAB_CHROMIUM)`
    : !existsSync(new URL("../../../analysis/viewer/node_modules/playwright-core", import.meta.url))
      ? "playwright-core is missing: npm ci in analysis/viewer" : null;
  if (reason) console.log(`skipped: ${reason}`);
  return !reason;
}
