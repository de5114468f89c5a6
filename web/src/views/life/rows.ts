// Positions of rows next to lines of the editor.

/** The height of a line, and of the rows next to it. */
export const LINE_PX = 24;

/** Largest number of rows next to a line that do not push later ones. */
export const MOST_ROWS = 12;

/** Next to their lines, or below the row before if that is in the way. */
export function stacked(tops: readonly number[], height: number): number[] {
  let next = 0;
  return tops.map((top) => {
    const place = Math.max(top, next);
    next = place + height;
    return place;
  });
}

/** The rows with room for a second line before the next row. */
export function roomy(tops: readonly number[], height: number): boolean[] {
  return tops.map((top, index) => (tops[index + 1] ?? Infinity) - top >= 2 * height);
}
