// A small picture of a home: the outlines in its file, valid or not.

import type { At } from '../../plan/geometry';
import { boundsOf, formOf, isHome, of, readHome, spanOf } from '../plan/model';

export type Sketch = {
  /** Left, top, width and height, in metres, with y downward. */
  box: [number, number, number, number];
  rooms: string[];
  furniture: string[];
  walls: string[];
  /** Gaps in walls. */
  doors: { from: At; to: At }[];
};

/** Around the home, in metres (our choice). */
const MARGIN_M = 0.4;

/** The picture of a home's text; null without anything to draw. */
export function sketchOf(text: string): Sketch | null {
  const home = readHome(text);
  if (!isHome(home) || home.elements.length === 0) return null;
  const [[left, bottom], [right, top]] = boundsOf(home);
  const outlines = (list: 'rooms' | 'furniture' | 'walls') => of(home, list).flatMap((element) => {
    const form = formOf(element);
    return form ? [form.map(([x, y]) => `${round(x)},${round(-y)}`).join(' ')] : [];
  });
  const doors = of(home, 'doors').flatMap((door) => {
    const span = spanOf(door);
    return span ? [{ from: down(span.from), to: down(span.to) }] : [];
  });
  return {
    box: [left - MARGIN_M, -top - MARGIN_M, right - left + 2 * MARGIN_M, top - bottom + 2 * MARGIN_M],
    rooms: outlines('rooms'), furniture: outlines('furniture'), walls: outlines('walls'), doors,
  };
}

function down([x, y]: At): At {
  return [round(x), round(-y)];
}

function round(metres: number): number {
  return Math.round(metres * 100) / 100;
}
