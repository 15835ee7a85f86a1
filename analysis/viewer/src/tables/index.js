/** The user can sort and filter a `<table class="sortable">`, and open the runs of cells with data-run. */
import { makeFilterable } from "./filter.js";
import { startRuns } from "./run_dialog.js";
import { makeSortable } from "./sort.js";

const MANY = 3; // a table with more rows has a filter

export function startTables() {
  for (const table of document.querySelectorAll("table.sortable")) {
    labelCells(table);
    if (table.tBodies[0].rows.length > MANY) makeFilterable(table);
    makeSortable(table);
  }
  for (const table of document.querySelectorAll("table.cards")) if (table.tHead) labelCells(table);
  startRuns();
}

// On a phone every row is a card, and each cell shows the name of its column.
function labelCells(table) {
  const labels = [...table.tHead.rows[table.tHead.rows.length - 1].cells].map((head) =>
    (head.dataset.label ?? head.textContent).trim(),
  );
  const narrow = matchMedia("(max-width: 560px)");
  const label = () => {
    if (!narrow.matches) return;
    narrow.removeEventListener("change", label);
    for (const row of table.tBodies[0].rows)
      [...row.cells].forEach((cell, i) => {
        cell.dataset.label = labels[i];
      });
  };
  narrow.addEventListener("change", label);
  label();
}
