/** Everything that a page of bendlab does by itself. */
import "./page/page.css";
import "./charts/charts.css";
import "./tables/tables.css";
import "./player/player.css";

import { startCharts } from "./charts/index.js";
import { startLive } from "./live/live.js";
import { startNavigation } from "./page/navigation.js";
import { startPlayers } from "./player/index.js";
import { startTables } from "./tables/index.js";

function start() {
  startNavigation();
  startTables();
  startCharts();
  startPlayers();
  startLive();
}

if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", start);
else start();
