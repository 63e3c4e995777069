// Places labels along an axis so that none overlaps another.

/**
 * Moves the wanted places as little as its simple rule allows until neighbours are `gap` apart and all lie in [lo, hi];
 * the order stays. Where they cannot all fit, they go on past `hi`.
 */
export function spread(wanted: readonly number[], gap: number, lo: number, hi: number): number[] {
  const order = wanted.map((_, i) => i).sort((a, b) => (wanted[a] ?? 0) - (wanted[b] ?? 0) || a - b);
  const placed = order.map((i) => wanted[i] ?? 0);
  for (let i = 0, least = lo; i < placed.length; ++i) {
    placed[i] = Math.max(placed[i] ?? 0, least);
    least = (placed[i] ?? 0) + gap;
  }
  // Pushed down they may leave at the bottom: back up from there, as far as there is room.
  for (let i = placed.length - 1, most = hi; i >= 0; --i) {
    placed[i] = Math.max(Math.min(placed[i] ?? 0, most), lo + i * gap);
    most = (placed[i] ?? 0) - gap;
  }
  const out = new Array<number>(wanted.length);
  order.forEach((from, i) => (out[from] = placed[i] ?? 0));
  return out;
}
