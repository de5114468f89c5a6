// Only the visible rows of a long table are in the page.

type Window = { from: number; to: number; above: number; below: number };

/** The visible rows, and the height of those above and below them. */
export function inSight(rows: number, rowHeight: number, scrolled: number, height: number, spare = 6): Window {
  const first = Math.floor(Math.max(scrolled, 0) / rowHeight);
  const from = Math.min(Math.max(first - spare, 0), Math.max(rows - 1, 0));
  const to = Math.min(first + Math.ceil(height / rowHeight) + spare, rows);
  return { from, to: Math.max(to, from), above: from * rowHeight, below: (rows - Math.max(to, from)) * rowHeight };
}
