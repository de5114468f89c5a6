// Where rows stand that belong beside lines of the editor.

/** The height of a line; what stands beside it goes by the same one. */
export const LINE_PX = 24;

/** So many rows stand beside a line at most without pushing those below it. */
export const MOST_ROWS = 12;

/** Beside their lines, or below the row before where that is still in the way. */
export function stacked(tops: readonly number[], height: number): number[] {
  let next = 0;
  return tops.map((top) => {
    const place = Math.max(top, next);
    next = place + height;
    return place;
  });
}

/** Which of them have room for a second line before the next row. */
export function roomy(tops: readonly number[], height: number): boolean[] {
  return tops.map((top, index) => (tops[index + 1] ?? Infinity) - top >= 2 * height);
}
