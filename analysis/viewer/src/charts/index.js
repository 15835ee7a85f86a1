/** Draws the charts of a page: `<figure class="chart" data-chart="ID">`. */
import { pageData } from "../page/data.js";
import { BarChart } from "./bar_chart.js";
import { LineChart } from "./line_chart.js";

const PAPER = 680; // px, about the width of A4 between its margins: printed charts are drawn for it

export function startCharts() {
  const charts = new Map((pageData().charts ?? []).map((chart) => [chart.id, chart]));
  for (const figure of document.querySelectorAll("figure.chart[data-chart]")) {
    const chart = charts.get(figure.dataset.chart);
    if (!chart) continue;
    figure.classList.add("drawn");
    figure.chart = chart.kind === "bars" ? new BarChart(figure, chart) : new LineChart(figure, chart);
  }
  const redraw = (paper) => {
    const figures = document.querySelectorAll("figure.chart.drawn");
    for (const { chart } of figures) Object.assign(chart, { paper }).draw();
  };
  addEventListener("beforeprint", () => redraw(PAPER));
  addEventListener("afterprint", () => redraw(null));
}
