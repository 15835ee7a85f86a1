/** The parts of the script that every page needs, with or without a player. */
import { startCharts } from "./charts/index.js";
import { startChooser } from "./chooser/chooser.js";
import { startNavigation } from "./page/navigation.js";
import { startTables } from "./tables/index.js";

export function startArticle() {
  startNavigation();
  startTables();
  startCharts();
  startChooser();
}

/** Calls `start` as soon as the page is read. */
export function whenRead(start) {
  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
  else start();
}
