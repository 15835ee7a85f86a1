/** Marks the visible section in the navigation. */
export function startNavigation() {
  const links = new Map(
    [...document.querySelectorAll(".bar nav a")].map((link) => [link.hash.slice(1), link]),
  );
  const sections = [...links.keys()].map((id) => document.getElementById(id)).filter(Boolean);
  if (!sections.length) return;
  const mark = () => {
    const line = innerHeight * 0.35;
    const last = innerHeight + scrollY >= document.documentElement.scrollHeight - 4;
    const now = last
      ? sections.at(-1)
      : sections.findLast((section) => section.getBoundingClientRect().top <= line);
    for (const [id, link] of links) {
      if (id === now?.id) link.setAttribute("aria-current", "true");
      else link.removeAttribute("aria-current");
    }
  };
  let waiting = false;
  addEventListener(
    "scroll",
    () => {
      if (waiting) return;
      waiting = true;
      requestAnimationFrame(() => {
        waiting = false;
        mark();
      });
    },
    { passive: true },
  );
  mark();
}
