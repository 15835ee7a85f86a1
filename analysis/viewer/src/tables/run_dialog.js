/** The dialog of a run, which a table, a chart or an address opens: motion, worst metric, config, command. */
import { choice } from "../charts/controls.js";
import { button, copy, html } from "../page/dom.js";
import { pageData } from "../page/data.js";
import { number, value, withUnit } from "../page/numbers.js";
import { configText, differences } from "./settings.js";

const NOTES = { diverged: "diverged", amber: "open", green: "yes" };

let dialog = null,
  list = [],
  back = null,
  playing = null,
  other = null; // the run that the opened run is compared with; null: its neighbours in the list

/** Opens runs: on the event bendlab:open, on a click on a cell with data-run, for an address with #run-ID. */
export function startRuns() {
  document.addEventListener("bendlab:open", (event) => open(event.detail.ids, event.detail.from));
  document.addEventListener("click", (event) => {
    const cell = event.target.closest?.("[data-run]");
    if (!cell || cell.closest("dialog") || event.target.closest("a, summary")) return;
    const ids = neighbours(cell);
    open(ids.list, cell.querySelector("button") ?? cell, ids.at);
  });
  addEventListener("hashchange", fromAddress);
  fromAddress();
}

function fromAddress() {
  try {
    const id = decodeURIComponent(location.hash.match(/^#run-(.+)$/)?.[1] ?? "");
    if (pageData().byId.has(id)) open([id], null);
  } catch (error) {
    if (!(error instanceof URIError)) throw error; // an address without a run, such as #run-100%
  }
}

// The runs of a table, in the present order of its rows. In a table of counts: the runs of the cell.
function neighbours(cell) {
  const table = cell.closest("table.shares") ? null : cell.closest("tbody");
  const shown = [...(table?.querySelectorAll("[data-run]") ?? [cell])]
    .filter((other) => other.getClientRects().length)
    .flatMap((other) => other.dataset.run.split(" "));
  const all = [...new Set(shown)];
  return { list: all, at: all.indexOf(cell.dataset.run.split(" ")[0]) };
}

function open(ids, from, at = 0) {
  list = ids.filter((id) => pageData().byId.has(id));
  if (!list.length) return;
  back = from;
  if (!dialog) {
    dialog = html("dialog", { class: "run", "aria-labelledby": "run-title" });
    dialog.addEventListener("close", closed);
    dialog.addEventListener("click", (event) => {
      if (event.target === dialog) dialog.close();
    });
    document.body.append(dialog);
  }
  show(Math.max(0, at));
  if (!dialog.open) dialog.showModal();
}

function closed() {
  stop();
  history.replaceState(null, "", location.pathname + location.search);
  back?.focus?.();
}

function stop() {
  document.dispatchEvent(new CustomEvent("bendlab:discard", { detail: { element: playing } }));
  playing = null;
}

function show(at) {
  const run = pageData().byId.get(list[at]);
  stop();
  const step = (by, text, name) =>
    button(
      text,
      () => {
        show(at + by);
        const again = dialog.querySelector(`[aria-label="${name}"]:not(:disabled)`);
        (again ?? dialog.querySelector("[autofocus]")).focus(); // at the last run: Close
      },
      { "aria-label": name, disabled: at + by < 0 || at + by >= list.length },
    );
  const head = html(
    "header",
    {},
    html("h2", { id: "run-title" }, run.title ?? run.label),
    list.length > 1 && html("span", { class: "grey small" }, `${at + 1} of ${list.length}`),
    list.length > 1 && step(-1, "‹", "The run before"),
    list.length > 1 && step(1, "›", "The next run"),
    button("Close", () => dialog.close(), { autofocus: true }),
  );
  dialog.replaceChildren(head, html("div", { class: "body" }, ...about(run)));
  dialog.scrollTop = 0;
  history.replaceState(null, "", `#run-${encodeURIComponent(run.id)}`);
  if (playing) play(run);
}

// A run that has only its first and last frame starts at the last frame.
function play(run) {
  document.dispatchEvent(new CustomEvent("bendlab:player", { detail: { element: playing } }));
  if (run.frames.count <= 2 && playing.player)
    Object.assign(playing.player, { time: Infinity, played: true });
}

function about(run) {
  const parts = [
    html(
      "p",
      {},
      html("span", { class: `status ${run.status}` }, run.status),
      run.outcome && html("span", { class: "grey" }, ` · ${run.outcome}`),
    ),
  ];
  const why = typeof run.why === "number" ? pageData().texts[run.why] : run.why;
  parts.push(worst(run));
  if (why)
    parts.push(html("div", { class: `note ${NOTES[run.status] ?? "no"}` }, html("p", {}, why)));
  if (run.frames) {
    playing = html("div", { class: "player", "data-runs": run.id });
    parts.push(playing);
  } else if (run.view) {
    parts.push(html("h3", {}, "Watch it"), command(run.view));
  }
  for (const warning of run.warnings ?? []) {
    parts.push(
      html("div", { class: "note open" }, html("p", {}, html("b", {}, warning.code), `: ${warning.message}`)),
    );
  }
  if (run.stills) parts.push(stills(run.stills));
  if (run.command) parts.push(html("h3", {}, "Repeat it"), command(run.command));
  const compared = html("div", {}, ...numbers(run), ...config(run));
  parts.push(...chooseOther(run, compared), compared);
  return parts;
}

// A link to the pictures of the group of cases to which this run belongs.
function stills(address) {
  const link = html("a", { href: address, onclick: () => dialog.close() }, "Stills of this group of cases");
  return html("p", { class: "small" }, link);
}

function command(text) {
  const press = (event) => copy(text, event.currentTarget);
  return html("div", { class: "copy" }, html("code", {}, text), button("Copy", press));
}

function worst(run) {
  const found = run.worst;
  if (!found) return html("p", { class: "worst grey" }, "No bound is stated for this run.");
  const limit =
    found.limit === undefined || found.limit === null
      ? ""
      : ` — limit ${withUnit(value(found.limit), found.unit)}${found.held ? ", held" : ", broken"}`;
  return html(
    "p",
    { class: "worst" },
    `${found.label} `,
    html("b", {}, found.text ?? withUnit(value(found.value), found.unit)),
    html("span", { class: "grey" }, limit, found.note ? ` (${found.note})` : ""),
  );
}

// A list to choose another run, whose metrics and config are then shown beside the values of this run.
function chooseOther(run, compared) {
  const others = pageData().runs.filter((each) => each !== run && (each.summary || each.changes));
  if (!others.length) return [];
  const texts = ["its neighbours in the list", ...others.map((each) => each.title ?? each.label)];
  const chosen = (at) => {
    other = others[at - 1] ?? null;
    compared.replaceChildren(...numbers(run), ...config(run));
  };
  return [html("p", { class: "tools" }, choice("Compare with", texts, 1 + others.indexOf(other), chosen))];
}

function numbers(run) {
  const metrics = pageData().summary ?? {};
  const rows = Object.entries(run.summary ?? {}).filter(([name]) => name in metrics);
  if (!rows.length) return [];
  const beside = other === run ? null : other;
  const heads = ["", "this run", beside?.title ?? beside?.label, "ratio"];
  return [
    html("h3", {}, "Numbers"),
    html(
      "div",
      { class: "scroll" },
      html(
        "table",
        {},
        beside && html("thead", {}, html("tr", {}, ...heads.map((text) => html("th", {}, text)), html("th", {}))),
        html(
          "tbody",
          {},
          ...rows.map(([name, x]) =>
            html(
              "tr",
              {},
              html("th", { class: "t", scope: "row" }, metrics[name].label),
              html("td", {}, withUnit(value(x), metrics[name].unit, 4)),
              beside && html("td", {}, withUnit(value(beside.summary?.[name]), metrics[name].unit, 4)),
              beside && html("td", {}, number(value(x) / value(beside.summary?.[name]))),
              html("td", { class: "t text grey" }, metrics[name].meaning ?? ""),
            ),
          ),
        ),
      ),
    ),
  ];
}

// The settings in which this run differs from the chosen run. Without a chosen run: from its neighbours in
// the list. Without neighbours: from two other runs with the same base config.
function config(run) {
  if (!run.changes && run.base === undefined) return [];
  const at = list.indexOf(run.id);
  const beside = other && other !== run
    ? [other]
    : list.length > 1
      ? [list[at - 1], list[at + 1]].filter(Boolean).map((id) => pageData().byId.get(id))
      : pageData()
          .runs.filter((other) => other !== run && other.base === run.base)
          .slice(0, 2);
  const rows = differences([run, ...beside]);
  const table = rows.length
    ? html(
        "div",
        { class: "scroll" },
        html(
          "table",
          {},
          html(
            "thead",
            {},
            html(
              "tr",
              {},
              html("th", { class: "t" }, "setting"),
              html("th", { class: "t" }, "this run"),
              ...beside.map((other) => html("th", { class: "t" }, other.title ?? other.label)),
            ),
          ),
          html(
            "tbody",
            {},
            ...rows.map(({ pointer, values }) =>
              html(
                "tr",
                {},
                html("td", { class: "t" }, html("code", {}, pointer)),
                ...values.map((text, i) => html("td", { class: i === 0 ? "t here" : "t" }, text)),
              ),
            ),
          ),
        ),
      )
    : html("p", { class: "grey" }, "No setting differs.");
  const text = configText(run);
  return [
    html("h3", {}, "Config, where it differs"),
    table,
    html(
      "details",
      {},
      html("summary", {}, "The whole config"),
      html(
        "p",
        {},
        button("Copy", (event) => copy(text, event.currentTarget)),
      ),
      html("pre", {}, text),
    ),
  ];
}
