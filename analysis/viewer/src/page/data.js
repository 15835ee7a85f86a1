/** The data of the page, and the event by which a part of the page opens runs. */

let read = null;

/** The data that analysis/web/html_parts.py put into #bendlab-data; see analysis/viewer/README.md. */
export function pageData() {
  if (!read) {
    const element = document.getElementById("bendlab-data");
    read = element ? JSON.parse(element.textContent) : { runs: [], charts: [] };
    read.byId = new Map((read.runs ?? []).map((run) => [run.id, run]));
  }
  return read;
}

/** Opens runs: shows the first run; buttons lead to the other runs. */
export function openRuns(ids, from = document.activeElement) {
  document.dispatchEvent(new CustomEvent("bendlab:open", { detail: { ids, from } }));
}
