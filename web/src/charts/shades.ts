// The probabilities of places of all residents, over a day.

/** A place; by resident, intervals with their probability of being there, from 0 to 1. */
export type Shade = { name: string; by: readonly (readonly Chance[])[] };

export type Chance = readonly [begin: number, end: number, chance: number];

/** The mean probability in each of `count` equal parts of an interval; the probabilities are in order. */
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
