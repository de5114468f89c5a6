// The position of the head of a person who lies in a bed or on a sofa: the log only has the direction of the last walk.

import type { BodyView, HomeView } from '../wire';
import { type At, inside } from './geometry';
import { frameOf, headsOf } from './symbols';

/** A piece to lie in, with the possible positions of heads, relative to its middle. */
export type Lain = { outline: At[]; heads: At[] };

export function lainIn(home: HomeView): Lain[] {
  const walls = home.solids.filter(({ kind }) => kind === 'wall').map(({ outline }) => outline);
  return home.solids.flatMap(({ name, outline, enterable }) => {
    const frame = enterable && name !== null ? frameOf(name, outline, walls) : null;
    const heads = frame === null ? [] : headsOf(name!, frame);
    return heads.length === 0 ? [] : [{ outline, heads }];
  });
}

/** The body with its head at the right end of its piece; unchanged elsewhere, or in another posture. */
export function laid(body: BodyView, pieces: Lain[]): BodyView {
  const piece = body.posture === 'lying' ? pieces.find(({ outline }) => inside(outline, body.at)) : undefined;
  if (piece === undefined) return body;
  const known = (body.heading_deg * Math.PI) / 180;
  // If both ends are possible, the one nearer to the known heading.
  const along = ([x, y]: At) => x * Math.cos(known) + y * Math.sin(known);
  const [x, y] = piece.heads.reduce((best, head) => (along(head) > along(best) ? head : best));
  return { ...body, heading_deg: (Math.atan2(y, x) * 180) / Math.PI };
}
