/** Makes elements. Texts are set as text, never as markup: a name from a config cannot add markup. */

const SVG = "http://www.w3.org/2000/svg";

/**
 * An HTML element.
 * @param {string} tag
 * @param {Object<string, any>} [attributes] `on…`: a listener; a missing or false value: no attribute
 * @param {...(Node|string|null|undefined|false)} children
 */
export function html(tag, attributes = {}, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

/** An SVG element; the arguments are those of html(). */
export function svg(tag, attributes = {}, ...children) {
  return filled(document.createElementNS(SVG, tag), attributes, children);
}

function filled(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    const states = name.startsWith("aria-"); // true and false are values
    if (value === undefined || value === null || (value === false && !states)) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true && !states ? "" : String(value));
  }
  element.append(...children.filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

/** A button that calls `press`. */
export function button(text, press, attributes = {}) {
  return html("button", { type: "button", class: "button", onclick: press, ...attributes }, text);
}

/** Copies text to the clipboard, also in a page from file://. The button shows the result for a moment. */
export async function copy(text, from) {
  const said = (await clipboard(text)) ? "Copied" : "Press Ctrl-C";
  if (!from) return;
  const before = (from.dataset.text ??= from.textContent);
  from.textContent = said;
  setTimeout(() => {
    from.textContent = before;
  }, 1400);
}

async function clipboard(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = html("textarea", { class: "off-screen", readonly: true });
    area.value = text;
    (document.querySelector("dialog[open]") ?? document.body).append(area);
    area.select();
    const copied = document.execCommand("copy");
    area.remove();
    return copied;
  }
}

/** Offers bytes to the user as a file to save. */
export function save(name, blob) {
  const address = URL.createObjectURL(blob);
  const link = html("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
