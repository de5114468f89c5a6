// Where rows stand that belong beside lines: there, or below the row before where that is still in the way.

export function stacked(tops: readonly number[], height: number): number[] {
  let next = 0;
  return tops.map((top) => {
    const place = Math.max(top, next);
    next = place + height;
    return place;
  });
}
