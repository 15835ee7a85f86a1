/** The script of pages without a player. */
import { startArticle, whenRead } from "./article.js";

whenRead(startArticle);
