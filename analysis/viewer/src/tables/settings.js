/** Configs of runs as JSON pointers and values. A page has complete base configs, and for each run the
 * settings that differ from one base config. */
import { pageData } from "../page/data.js";

/** Pointer → value of every setting of a run. @returns {Map<string, any>} */
export function settingsOf(run) {
  const settings = new Map(Object.entries(pageData().settings?.[run.base ?? 0] ?? {}));
  for (const [pointer, value] of Object.entries(run.changes ?? {})) {
    if (value === null) settings.delete(pointer);
    else settings.set(pointer, value[0]);
  }
  return settings;
}

/** The settings that differ among runs: pointers, and each run's values. @param {Object[]} runs */
export function differences(runs) {
  const all = runs.map(settingsOf);
  const pointers = new Set(all.flatMap((settings) => [...settings.keys()]));
  return [...pointers]
    .filter((pointer) => new Set(all.map((settings) => shown(settings.get(pointer)))).size > 1)
    .map((pointer) => ({ pointer, values: all.map((settings) => shown(settings.get(pointer))) }));
}

/** The config as JSON text, from its pointers. */
export function configText(run) {
  const root = {};
  for (const [pointer, value] of settingsOf(run)) put(root, pointer.split("/").slice(1), value);
  return JSON.stringify(lists(root), null, 2);
}

function put(node, path, value) {
  const [key, ...rest] = path;
  if (!rest.length)
    Object.defineProperty(node, key, { value, enumerable: true, configurable: true, writable: true });
  else put(Object.hasOwn(node, key) ? node[key] : (node[key] = {}), rest, value);
}

// Turns objects with the keys 0, 1, … back into lists.
function lists(node) {
  if (node === null || typeof node !== "object" || Array.isArray(node)) return node;
  const keys = Object.keys(node);
  const values = Object.fromEntries(keys.map((key) => [key, lists(node[key])]));
  return keys.length && keys.every((key, i) => key === String(i)) ? Object.values(values) : values;
}

export function shown(value) {
  return value === undefined ? "–" : typeof value === "string" ? value : JSON.stringify(value);
}
