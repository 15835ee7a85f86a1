/** The form "Which model for my mesh?", which shows the measured run that fits the user's wishes.
 * analysis/pages/start.py makes the data. */
import { choice } from "../charts/controls.js";
import { button, copy, html } from "../page/dom.js";
import { pageData } from "../page/data.js";
import { number } from "../page/numbers.js";
import { configText } from "../tables/settings.js";
import { found } from "./found.js";

const MATTERS = { shape: "its shape", stability: "that it never fails", cost: "its cost" };
const GOALS = { error: "at most this error (%)", budget: "at most this time (ms per frame)" };
const OTHERS = 5; // number of other models that are listed

export function startChooser() {
  const place = document.getElementById("chooser");
  const data = pageData().chooser;
  if (!place || !data?.runs.length) return;
  const asked = { scene: 0, family: "equilateral", cells: 24, matters: "shape", goal: "error", most: 1 };
  const said = html("div", { role: "status", id: "chosen-said" }), // only the sentence is read aloud
    details = html("div", {});
  const show = (problem) => {
    const [sentence, ...rest] = problem
      ? [html("p", { class: "note open" }, problem)]
      : answered(found(data, asked), asked, data);
    said.replaceChildren(sentence);
    details.replaceChildren(...rest);
  };
  place.append(form(asked, data, show), html("div", { class: "chosen" }, said, details));
  show();
}

function form(asked, data, show) {
  const pick = (name, keys) => (at) => {
    asked[name] = keys[at];
    show();
  };
  const of = (label, name, texts, keys) => choice(label, texts, keys.indexOf(asked[name]), pick(name, keys));
  const numeric = (name, least, label) => {
    const input = html("input", {
      type: "number",
      min: least,
      step: "any",
      value: asked[name],
      oninput: () => {
        const x = Number(input.value);
        const allowed = input.value !== "" && x >= least && Number.isFinite(x);
        input.setAttribute("aria-invalid", !allowed);
        input.setAttribute("aria-describedby", allowed ? "" : "chosen-said");
        asked[name] = x;
        show(allowed ? "" : `${label}: give a number of at least ${least}.`);
      },
    });
    return html("label", { class: "choice" }, html("span", {}, label), input);
  };
  const families = Object.keys(data.families);
  return html(
    "form",
    { class: "asked", onsubmit: (event) => event.preventDefault() },
    of("My cloth", "scene", data.scenes, [...data.scenes.keys()]),
    of("Its mesh is", "family", Object.values(data.families), families),
    numeric("cells", 1, "Cells along its width"),
    of("What matters is", "matters", Object.values(MATTERS), Object.keys(MATTERS)),
    of("I want", "goal", Object.values(GOALS), Object.keys(GOALS)),
    numeric("most", 1e-6, "Error or time"),
  );
}

function answered(result, asked, data) {
  const { best, fits, others, notes } = result;
  if (!best) return [html("p", {}, ...notes)];
  const run = pageData().byId.get(best.id);
  const text = configText(run);
  const lead = fits ? [] : [html("b", {}, nothingFits(asked)), " The nearest: "];
  return [
    html("p", { class: "answer" }, ...lead, ...sentence(best)),
    facts(best, asked, data),
    ...notes.map((note) => html("p", { class: "note open" }, note)),
    html("h3", {}, "Its config"),
    html(
      "p",
      { class: "small grey" },
      "This config is the whole scene of the run. Copy bending and solver from the config, or save the " +
        "config as FILE and call ",
      html("code", {}, "./bendlab run FILE"),
      ".",
    ),
    html("p", {}, button("Copy config", (event) => copy(text, event.currentTarget))),
    html("details", {}, html("summary", {}, "Show it"), html("pre", {}, text)),
    others.length ? table(others) : "",
  ];
}

const nothingFits = (asked) =>
  asked.goal === "error"
    ? `No measured run comes within ${number(asked.most)} %.`
    : `No measured run takes at most ${number(asked.most)} ms.`;

function sentence(run) {
  return [
    html("b", {}, run.model),
    ` by ${run.method} on ${run.cells} cells, ${run.substeps} × ${run.iterations} substeps × iterations, ` +
      `${run.precision}: `,
    html("b", {}, `${number(run.error)} %`),
    ` off ${run.against} in `,
    html("b", {}, `${number(run.ms)} ms`),
    " per frame.",
  ];
}

// Further measurements of this model, each with a link.
function facts(run, asked, data) {
  const [red, count] = data.stability[""]?.[run.model] ?? [0, 0];
  const own = data.stability[asked.family]?.[run.model];
  const ratio = data.stiffness[asked.family]?.[run.model];
  const item = (text, href, link) => html("li", {}, text, " ", html("a", { href }, link));
  const share = (some, all) => `${some} of ${all}`;
  return html(
    "ul",
    {},
    item("The run itself:", `accuracy/index.html#run-${encodeURIComponent(run.id)}`, "error, config and command"),
    count > 0 && item(`Fails in ${share(red, count)} hard cases:`, "stability/index.html", "stability"),
    own && item(`On such meshes it fails in ${share(...own)} cases:`, "stability/index.html#meshes-and-units", "cases"),
    ratio
      ? item(
          `Its stated stiffness changes by ${number(100 * (ratio - 1), 2)} % with the resolution on such meshes:`,
          "stiffness/index.html#calibrated",
          "stiffness",
        )
      : html("li", { class: "grey" }, "Stiffness against resolution was not measured on such meshes."),
  );
}

function table(runs) {
  const head = ["model", "method", "cells", "substeps × iterations", "error (%)", "ms per frame", "red hard cases"];
  return html(
    "div",
    {},
    html("h3", {}, "The other models and methods, each with its best run"),
    html(
      "div",
      { class: "scroll" },
      html(
        "table",
        {},
        html("thead", {}, html("tr", {}, ...head.map((name, i) => html("th", { class: i ? null : "t" }, name)))),
        html("tbody", {}, ...runs.slice(0, OTHERS).map(row)),
      ),
    ),
  );
}

function row(run) {
  const link = html("a", { href: `accuracy/index.html#run-${encodeURIComponent(run.id)}` }, run.model);
  const [red, count] = pageData().chooser.stability[""]?.[run.model] ?? [0, 0];
  const cells = [
    run.method,
    run.cells,
    `${run.substeps} × ${run.iterations}`,
    number(run.error),
    number(run.ms),
    count ? `${red} of ${count}` : "not measured",
  ];
  return html("tr", {}, html("td", { class: "t" }, link), ...cells.map((text) => html("td", {}, String(text))));
}
