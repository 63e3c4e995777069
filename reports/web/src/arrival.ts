// Keeps a section at the window's top while what lies around it takes its size: a link to it is followed as the page
// opens, and charts, tables and images grow or shrink until they are drawn.

const kQuiet = 400; // ms without a change of size, once everything is drawn
const kPatience = 6000; // ms: whatever still grows then is left alone
const kGestures = ["wheel", "touchstart", "pointerdown", "keydown"] as const;

/**
 * Scrolls to the section now, and again whenever the page's layout moves it, until `settled()` holds and nothing has
 * changed for a while. It gives way at once to a reader, or to a script, that scrolls elsewhere. Returns how to stop.
 */
export function stayAt(section: HTMLElement, settled: () => boolean): () => void {
  const end = new AbortController();
  const begun = performance.now();
  let changed = begun;
  let layout = "";
  let own = NaN; // where we scrolled to
  const where = (): string => `${section.offsetTop} ${document.documentElement.scrollHeight}`;
  const align = (): void => {
    layout = where();
    section.scrollIntoView({ block: "start", behavior: "instant" });
    own = scrollY;
  };
  const look = (now: number): void => {
    if (end.signal.aborted) return;
    if (!section.isConnected || now - begun > kPatience) return end.abort();
    if (where() !== layout) {
      changed = now;
      align();
    } else if (Math.abs(scrollY - own) > 2) {
      return end.abort(); // the layout is the same: somebody else has scrolled
    }
    if (settled() && now - changed > kQuiet) return end.abort();
    requestAnimationFrame(look);
  };
  for (const kind of kGestures)
    addEventListener(kind, () => end.abort(), { signal: end.signal, passive: true, capture: true });
  align();
  requestAnimationFrame(look);
  return () => end.abort();
}
