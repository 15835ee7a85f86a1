/** The runs of a page. Each is read once, even if several players show it. */
import { pageData } from "../page/data.js";
import { Frames } from "./decode.js";

const opened = new Map();

/** A run of the page's data; a stand-in for an id that the page does not have. */
export function runOf(id) {
  return (pageData().runs ?? []).find((run) => run.id === id) ??
    { id, label: id, frames: null, remedy: "This page has no such run." };
}

/** Forgets a run's frames, so that they are read again: its script has new frames. */
export function forget(id) {
  opened.delete(id);
}

/** The frames of a run: the first is decoded, the others follow. */
export function framesOf(run) {
  if (!opened.has(run.id)) {
    const element = document.getElementById(run.frames.dom);
    opened.set(run.id, element ? new Frames(run.frames, element.textContent.trim()).open()
      : Promise.reject(new Error("Its frames are not in this page.")));
  }
  return opened.get(run.id);
}
