/** The page's data, and what its parts tell one another. */

let read = null;

/** What analysis/html_parts.py put into #bendlab-data; see analysis/viewer/README.md. */
export function pageData() {
  if (!read) {
    const element = document.getElementById("bendlab-data");
    read = element ? JSON.parse(element.textContent) : { runs: [], charts: [] };
    read.byId = new Map((read.runs ?? []).map((run) => [run.id, run]));
  }
  return read;
}

/** Opens runs: the first one is shown, the others can be gone to. */
export function openRuns(ids, from = document.activeElement) {
  document.dispatchEvent(new CustomEvent("bendlab:open", { detail: { ids, from } }));
}
