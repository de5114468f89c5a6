// How likely everybody was in a place, over a day.

/** A place; by resident, from when to when they were how likely there, from 0 to 1. */
export type Shade = { name: string; by: readonly (readonly Chance[])[] };

export type Chance = readonly [begin: number, end: number, chance: number];

/** The mean chance in each of so many equal parts of a span, in which the chances are in order. */
export function columns(chances: readonly Chance[], begin_us: number, end_us: number, count: number): Float32Array {
  const means = new Float32Array(count);
  const part = Math.max(end_us - begin_us, 1) / count;
  for (const [from, to, chance] of chances) {
    const [begin, end] = [(Math.max(from, begin_us) - begin_us) / part, (Math.min(to, end_us) - begin_us) / part];
    for (let column = Math.floor(begin); column < Math.min(end, count); column++) {
      means[column]! += chance * Math.max(Math.min(end, column + 1) - Math.max(begin, column), 0);
    }
  }
  return means;
}
