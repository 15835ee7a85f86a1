/** The measured run that answers what is asked for, and where nothing was measured. */

/**
 * @param {Object} data the page's chooser data
 * @param {{scene: number, family: string, cells: number, matters: string, goal: string, most: number}} asked
 * @returns {{best: ?Object, fits: boolean, others: Object[], notes: string[]}} others: the best run of each
 *   other model
 */
export function found(data, asked) {
  const motion = asked.matters === "motion";
  const notes = [];
  let runs = data.runs.filter((run) => run.motion === motion && (motion || run.scene === asked.scene));
  if (motion && asked.scene !== 0)
    notes.push("Motion was measured on the cloth that hangs from two corners alone.");
  if (!runs.length) return { best: null, fits: false, others: [], notes: ["Nothing was measured for this."] };
  const own = runs.filter((run) => run.family === asked.family);
  if (own.length) runs = own;
  else
    notes.push(
      `Accuracy was not measured on ${data.families[asked.family]} in this scene. The answer is of ` +
        `${[...new Set(runs.map((run) => data.families[run.family] ?? run.family))].join(", ")}; ` +
        "./bendlab advise CONFIG measures your own.",
    );
  const cells = nearest(
    runs.map((run) => run.cells),
    asked.cells,
  );
  if (cells !== asked.cells) notes.push(otherSize(cells, asked.cells));
  // What costs least may be a coarser mesh.
  if (cells !== asked.cells || asked.matters !== "cost") runs = runs.filter((run) => run.cells === cells);
  const best = [...groups(runs)].map((some) => bestOf(some, asked));
  best.sort((a, b) => compare(a, b, asked, data));
  const [first, ...others] = best;
  return { best: first.run, fits: first.fits, others: others.map(({ run }) => run), notes };
}

function otherSize(cells, wanted) {
  const times = (wanted / cells) ** 2;
  const factor = times >= 1 ? `about ${times.toPrecision(2)} times as` : `about ${times.toPrecision(2)} of that`;
  return (
    `Nothing was measured on ${wanted} cells, so this is of ${cells}. A step takes ${factor}` +
    `${times >= 1 ? " long" : " time"} there if time grows with the vertices; the error there is not known.`
  );
}

function nearest(values, wanted) {
  const distance = (x) => Math.abs(Math.log(x / wanted));
  return values.reduce((best, x) => (distance(x) < distance(best) ? x : best));
}

// The runs of each model; a model with the paper's stiffness, which states no cloth, is another one.
function groups(runs) {
  const byModel = new Map();
  for (const run of runs) {
    const key = `${run.model}${run.paper ? ", paper" : ""}`;
    byModel.set(key, [...(byModel.get(key) ?? []), run]);
  }
  return byModel.values();
}

// Of one model: the cheapest run within the error, or the nearest one within the time; else what comes nearest.
function bestOf(runs, { goal, most }) {
  const [bound, wanted] = goal === "error" ? ["error", "ms"] : ["ms", "error"];
  const least = (some, name) => some.reduce((best, run) => (run[name] < best[name] ? run : best));
  const within = runs.filter((run) => run[bound] <= most);
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

// Of the hard cases, how many fail; a model that was not tried comes last.
function share(run, data) {
  const [red, count] = data.stability[""]?.[run.model] ?? [1, 1];
  return red / count;
}
