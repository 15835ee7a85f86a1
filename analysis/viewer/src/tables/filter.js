/** Shows only the table rows with all words that the user types, and all values that the user chooses. */
import { html } from "../page/dom.js";
import { isChosen, whenChosen } from "../page/selection.js";

/** @param {HTMLTableElement} table a column whose head has the class `choose` gets a list of its values */
export function makeFilterable(table) {
  const rows = [...table.tBodies[0].rows];
  const texts = new Map(rows.map((row) => [row, row.textContent.toLowerCase()]));
  const runsOf = new Map(rows.map((row) => [row, (row.querySelector("[data-run]")?.dataset.run ?? "").split(" ").filter(Boolean)]));
  const lists = [...table.tHead.rows[0].cells].flatMap((head, column) =>
    head.classList.contains("choose") ? [valueList(head, column, rows, apply)] : [],
  );
  const words = html("input", {
    type: "search",
    placeholder: "Filter, such as adaptive 64",
    oninput: apply,
    "aria-label": "Show the rows with these words",
  });
  const found = html("output", {});
  const name = table.dataset.rows ?? "rows";

  function apply() {
    const wanted = words.value.toLowerCase().split(/\s+/).filter(Boolean);
    let count = 0;
    for (const row of rows) {
      const text = texts.get(row);
      const fits =
        wanted.every((word) => text.includes(word)) &&
        lists.every((list) => list.fits(row)) &&
        isChosen(runsOf.get(row));
      row.hidden = !fits;
      count += fits;
    }
    found.textContent = count === rows.length ? `${count} ${name}` : `${count} of ${rows.length} ${name}`;
  }

  const place = table.closest(".scroll") ?? table;
  place.before(
    html("div", { class: "filters", role: "search" }, words, ...lists.map((list) => list.element), found),
  );
  whenChosen(apply);
  apply();
  return { words, apply };
}

function valueList(head, column, rows, apply) {
  const text = (row) => row.cells[column]?.textContent.trim() ?? "";
  const values = [...new Set(rows.map(text))];
  const select = html(
    "select",
    { onchange: apply, "aria-label": head.textContent.trim() },
    html("option", { value: "" }, `${head.textContent.trim()}: all`),
    ...values.map((value) => html("option", { value: `=${value}` }, value || "–")),
  );
  return { element: select, fits: (row) => !select.value || select.value === `=${text(row)}` };
}
