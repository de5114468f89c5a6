// Where the head of somebody is who lies in a bed or on a sofa: what a path knows is only where they walked last.

import type { BodyView, HomeView } from '../wire';
import { type At, inside } from './geometry';
import { frameOf, headsOf } from './symbols';

/** A piece that people lie in, and where their heads can be, as ways from its middle. */
export type Lain = { outline: At[]; heads: At[] };

/** All pieces of a home that people lie in. */
export function lainIn(home: HomeView): Lain[] {
  const walls = home.solids.filter(({ kind }) => kind === 'wall').map(({ outline }) => outline);
  return home.solids.flatMap(({ name, outline, enterable }) => {
    const frame = enterable && name !== null ? frameOf(name, outline, walls) : null;
    const heads = frame === null ? [] : headsOf(name!, frame);
    return heads.length === 0 ? [] : [{ outline, heads }];
  });
}

/** The body with its head where it is in the piece that it lies in; as it was where it lies elsewhere, or does not lie. */
export function laid(body: BodyView, pieces: Lain[]): BodyView {
  const piece = body.posture === 'lying' ? pieces.find(({ outline }) => inside(outline, body.at)) : undefined;
  if (piece === undefined) return body;
  const known = (body.heading_deg * Math.PI) / 180;
  // Where either end will do, it is the one that is nearer to how they are known to be.
  const along = ([x, y]: At) => x * Math.cos(known) + y * Math.sin(known);
  const [x, y] = piece.heads.reduce((best, head) => (along(head) > along(best) ? head : best));
  return { ...body, heading_deg: (Math.atan2(y, x) * 180) / Math.PI };
}
