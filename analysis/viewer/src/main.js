/** The script of a page with a player. */
import "./page/page.css";
import "./charts/charts.css";
import "./tables/tables.css";
import "./chooser/chooser.css";
import "./player/player.css";
import "./explorer/explorer.css";

import { startArticle, whenRead } from "./article.js";
import { startExplorer } from "./explorer/explorer.js";
import { startLive } from "./live/live.js";
import { startPlayers } from "./player/index.js";

whenRead(() => {
  startArticle();
  startExplorer();
  startPlayers();
  startLive();
});
