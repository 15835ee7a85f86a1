/** The runs of a page. Each run is read once, even if several players show this run. */
import { pageData } from "../page/data.js";
import { Frames } from "./decode.js";

const opened = new Map();

/** The run with this id; a run without frames if the page has no such id. */
export function runOf(id) {
  return (pageData().runs ?? []).find((run) => run.id === id) ??
    { id, label: id, frames: null, remedy: "This page has no such run." };
}

/** Forgets the frames of a run, so that new frames in the page are read. */
export function forget(id) {
  opened.delete(id);
}

/** The frames of a run. The first frame is decoded; decodeAll() decodes the other frames. */
export function framesOf(run) {
  if (!opened.has(run.id)) {
    const element = document.getElementById(run.frames.dom);
    opened.set(run.id, element ? new Frames(run.frames, element.textContent.trim()).open()
      : Promise.reject(new Error("Its frames are not in this page.")));
  }
  return opened.get(run.id);
}
