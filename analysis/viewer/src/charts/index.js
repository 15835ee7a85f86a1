/** Draws the charts of a page: `<figure class="chart" data-chart="ID">`. */
import { pageData } from "../page/data.js";
import { BarChart } from "./bar_chart.js";
import { LineChart } from "./line_chart.js";

/** @param {ParentNode} root */
export function startCharts(root = document) {
  const charts = new Map((pageData().charts ?? []).map((chart) => [chart.id, chart]));
  for (const figure of root.querySelectorAll("figure.chart[data-chart]")) {
    const chart = charts.get(figure.dataset.chart);
    if (!chart) continue;
    figure.classList.add("drawn");
    figure.chart = chart.kind === "bars" ? new BarChart(figure, chart) : new LineChart(figure, chart);
  }
}
