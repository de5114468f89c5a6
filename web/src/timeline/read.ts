// The readings at a position on the time line.

import type { Band, Counts, Lane } from '../charts/lanes';
import { firstFrom } from '../charts/axis';
import { countBetween } from '../charts/lanes';
import { spoken } from '../plan/words';

/** The reading of a lane at an instant, within a distance. */
export function laneAt(lane: Lane, at_us: number, near_us: number): { at_us: number; words: string } | null {
  if (lane.density !== undefined) {
    const about = (counts: Counts) => Math.round(countBetween(counts, at_us - near_us, at_us + near_us));
    const count = about(lane.density);
    const words = count === 0 ? 'nothing' : count === 1 ? 'about 1 event here' : `about ${count.toLocaleString('en-GB')} events here`;
    return { at_us, words: lane.densityBeside === undefined ? words : `${words}, in the second run ${about(lane.densityBeside.counts).toLocaleString('en-GB')}` };
  }
  const own = saidNear(lane.fired, lane.said, at_us, near_us);
  const other = lane.beside === undefined ? null : saidNear(lane.beside.fired, lane.beside.said, at_us, near_us);
  const isOther = other !== null && (own === null || Math.abs(other.at_us - at_us) < Math.abs(own.at_us - at_us));
  return isOther ? { at_us: other.at_us, words: `${other.words} in the second run`.trimStart() } : own;
}

function saidNear(fired: ArrayLike<number>, said: ((index: number) => string) | undefined, at_us: number, near_us: number): { at_us: number; words: string } | null {
  const at = nearest(fired, at_us);
  if (at === null || Math.abs(fired[at]! - at_us) > near_us) return null;
  return { at_us: fired[at]!, words: said?.(at) ?? '' };
}

/** The index of the nearest element of a sorted list. */
function nearest(all: ArrayLike<number>, at_us: number): number | null {
  if (all.length === 0) return null;
  const after = Math.min(firstFrom(all, at_us), all.length - 1);
  const before = Math.max(after - 1, 0);
  return at_us - all[before]! <= all[after]! - at_us ? before : after;
}

/** The firing after an instant, or before it. */
export function neighbour(fired: ArrayLike<number>, at_us: number, forward: boolean): number | null {
  const index = forward ? firstFrom(fired, at_us + 1) : firstFrom(fired, at_us) - 1;
  return fired[index] ?? null;
}

/** The reading of a band at an instant, with its interval. */
export function bandAt(band: Band, at_us: number): { begin_us: number; end_us: number; words: string } | null {
  const span = band.spans.findLast(([begin, end]) => begin <= at_us && at_us < end);
  return span === undefined ? null : { begin_us: span[0], end_us: span[1], words: spoken(band.names[span[2]] ?? '') };
}
