/** Sorts a table by a column: by the number in `data-v` of a cell, or by its text if it has no `data-v`. */

/** @param {HTMLTableElement} table */
export function makeSortable(table) {
  const heads = [...table.tHead.rows[table.tHead.rows.length - 1].cells];
  heads.forEach((head, column) => {
    if (head.classList.contains("fixed")) return;
    const press = document.createElement("button");
    press.type = "button";
    press.className = "sort";
    press.append(...head.childNodes);
    head.append(press);
    press.addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      for (const other of heads) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      sortBy(table, column, down ? -1 : 1);
    });
  });
}

function sortBy(table, column, direction) {
  const body = table.tBodies[0];
  const rows = [...body.rows].map((row, i) => ({ row, i, key: keyOf(row.cells[column]) }));
  rows.sort((a, b) => compare(a.key, b.key, direction) || a.i - b.i);
  body.append(...rows.map(({ row }) => row));
}

// A number, a text, or null for an empty cell.
function keyOf(cell) {
  const written = cell?.dataset.v;
  if (written !== undefined) {
    const number = Number(written.replace("∞", "Infinity"));
    return written === "" ? null : Number.isNaN(number) ? written : number;
  }
  const text = cell?.textContent.trim();
  return text ? (numberOf(text) ?? text) : null;
}

// The number at the beginning of a text, written as on pages: 1,824 or −0.5 or 1.2·10⁻⁵ or ± 5 %.
function numberOf(text) {
  const found = /^(?:± ?)?([-−]?\d[\d,\u202f]*(?:\.\d+)?)(?:·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)|e([-+]?\d+))?(?![\w²])/.exec(text);
  if (/^[-−]?∞$/.test(text)) return text === "∞" ? Infinity : -Infinity;
  if (!found) return null;
  const plain = Number(found[1].replace("−", "-").replace(/[,\u202f]/g, ""));
  const power = found[3] ?? found[2]?.replace(/./g, (c) => (c === "⁻" ? "-" : "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c))) ?? 0;
  return plain * 10 ** Number(power);
}

// Empty cells come last in both directions; numbers come before texts.
function compare(a, b, direction) {
  if (a === null || b === null) return a === b ? 0 : a === null ? 1 : -1;
  if (typeof a !== typeof b) return typeof a === "number" ? -1 : 1;
  const order =
    typeof a === "number"
      ? Math.sign(a - b) || 0
      : a.localeCompare(b, "en", { numeric: true, sensitivity: "base" });
  return direction * order;
}
