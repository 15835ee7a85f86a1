/** Everything that a page of bendlab does by itself. */
import "./page/page.css";
import "./charts/charts.css";
import "./tables/tables.css";
import "./chooser/chooser.css";
import "./player/player.css";

import { startArticle, whenRead } from "./article.js";
import { startLive } from "./live/live.js";
import { startPlayers } from "./player/index.js";

whenRead(() => {
  startArticle();
  startPlayers();
  startLive();
});
