/** Finds the measured run that fits the user's wishes, and says what was not measured. */

/**
 * @param {Object} data the page's chooser data
 * @param {{scene: number, family: string, cells: number, matters: string, goal: string, most: number}} asked
 *   scene: index among the data's scenes
 * @returns {{best: ?Object, fits: boolean, others: Object[], notes: string[]}} others: the best run of each
 *   other model
 */
export function found(data, asked) {
  const notes = [];
  let runs = data.runs.filter((run) => run.scene === asked.scene);
  if (!runs.length)
    return { best: null, fits: false, others: [], notes: ["No run was measured for this cloth."] };
  const own = runs.filter((run) => run.family === asked.family);
  if (own.length) runs = own;
  else
    notes.push(
      `Accuracy was not measured on ${data.families[asked.family]} in this scene. The answer is a run on ` +
        `${[...new Set(runs.map((run) => data.families[run.family] ?? run.family))].join(", ")}; ` +
        "./bendlab advise CONFIG measures your own scene.",
    );
  const cells = nearest(
    runs.map((run) => run.cells),
    asked.cells,
  );
  if (cells !== asked.cells) notes.push(otherSize(cells, asked.cells));
  // If the cost matters, runs on all meshes count: the cheapest run may be on a coarser mesh.
  if (cells !== asked.cells || asked.matters !== "cost") runs = runs.filter((run) => run.cells === cells);
  const unknown = Math.max(...runs.map((run) => run.unknown));
  if (asked.goal === "error" && asked.most < unknown)
    notes.push(
      `Errors below ${unknown.toPrecision(2)} % are not known here: the reference is that far from a coarser ` +
        "reference.",
    );
  const best = [...groups(runs)].map((some) => bestOf(some, asked, unknown));
  best.sort((a, b) => compare(a, b, asked, data));
  const [first, ...others] = best;
  return { best: first.run, fits: first.fits, others: others.map(({ run }) => run), notes };
}

function otherSize(cells, wanted) {
  const times = (wanted / cells) ** 2;
  const factor = times >= 1 ? `about ${times.toPrecision(2)} times as` : `about ${times.toPrecision(2)} of this run's`;
  return (
    `Nothing was measured on ${wanted} cells, so this run has ${cells} cells. If time grows with the vertices, ` +
    `a step on ${wanted} cells takes ${factor}${times >= 1 ? " long" : " time"}. The error there is not known` +
    `${times > 1 ? ": finer meshes need more substeps" : ""}; ./bendlab advise CONFIG measures your scene.`
  );
}

function nearest(values, wanted) {
  const distance = (x) => Math.abs(Math.log(x / wanted));
  return values.reduce((best, x) => (distance(x) < distance(best) ? x : best));
}

// Groups the runs by model and method. Runs with the paper's stiffness, which defines no cloth, are groups of
// their own.
function groups(runs) {
  const byModel = new Map();
  for (const run of runs) {
    const key = `${run.model}, ${run.method}${run.paper ? ", paper" : ""}`;
    byModel.set(key, [...(byModel.get(key) ?? []), run]);
  }
  return byModel.values();
}

// The best run of a model: the cheapest run within the allowed error, or the most accurate run within the
// allowed time. If no run is within this bound, the run nearest to the bound. An error below the uncertainty
// of the reference counts as this uncertainty.
function bestOf(runs, { goal, most }, unknown) {
  const [bound, wanted] = goal === "error" ? ["error", "ms"] : ["ms", "error"];
  const least = (some, name) => some.reduce((best, run) => (run[name] < best[name] ? run : best));
  const within = runs.filter((run) => Math.max(run[bound], bound === "error" ? unknown : 0) <= most);
  return within.length
    ? { run: least(within, wanted), fits: true }
    : { run: least(runs, bound), fits: false };
}

function compare(a, b, { goal, matters }, data) {
  if (a.fits !== b.fits) return a.fits ? -1 : 1;
  if (matters === "stability") {
    const order = share(a.run, data) - share(b.run, data);
    if (order) return order;
  }
  const wanted = (goal === "error") === a.fits ? "ms" : "error";
  return a.run[wanted] - b.run[wanted];
}

// The share of the hard cases in which the model fails; 1 for a model without hard cases.
function share(run, data) {
  const [red, count] = data.stability[""]?.[run.model] ?? [1, 1];
  return red / count;
}
