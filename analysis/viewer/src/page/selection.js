/** Which runs of a page are chosen. The user chooses in the explorer; tables and charts show the choice. */
let chosen = null;

/** @returns {Set<string>|null} ids; null: all runs */
export const chosenRuns = () => chosen;

/** @param {Iterable<string>|null} ids null: all runs */
export function choose(ids) {
  chosen = ids && new Set(ids);
  document.dispatchEvent(new CustomEvent("bendlab:chosen"));
}

/** Calls `act` whenever the choice has changed. @returns {() => void} ends the calls */
export function whenChosen(act) {
  document.addEventListener("bendlab:chosen", act);
  return () => document.removeEventListener("bendlab:chosen", act);
}

/** Whether at least one of these runs is chosen. @param {string[]} ids without ids always true */
export function isChosen(ids) {
  return !chosen || !ids.length || ids.some((id) => chosen.has(id));
}
