/** Which runs of a page are chosen. The explorer chooses; tables, charts and groups follow. */
let chosen = null;

/** @returns {Set<string>|null} ids; null: all runs */
export const chosenRuns = () => chosen;

/** @param {Iterable<string>|null} ids null: all runs */
export function choose(ids) {
  chosen = ids && new Set(ids);
  document.dispatchEvent(new CustomEvent("bendlab:chosen"));
}

/** Calls `act` whenever the choice has changed. */
export function whenChosen(act) {
  document.addEventListener("bendlab:chosen", () => act());
}

/** Whether at least one of these runs is chosen. @param {string[]} ids without ids always true */
export function isChosen(ids) {
  return !chosen || !ids.length || ids.some((id) => chosen.has(id));
}
