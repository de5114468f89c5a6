// The floors of a home with several, drawn next to each other: a frame around each, and its name.

import type { HomeView } from '../wire';
import { type At, box } from './geometry';
import type { Palette } from './palette';
import { type Box, FONT, type Pen, text, trace } from './pen';
import { type Bounds, type View, toScreen } from './transform';
import { fitting, isolated } from './words';

export type Floor = { name: string; least: At; most: At };

/** Distance from a frame to the rooms in it, so that walls and names of doors stay inside. */
const AROUND_M = 0.35;

/** Largest height of a name with the space around it, in pixels. */
export const NAME_HIGH = 24;

/** The floors in the order of the rooms. */
export function floorsOf(rooms: HomeView['rooms']): Floor[] {
  const floors: Floor[] = [];
  for (const { floor, outline } of rooms) {
    if (floor === null) continue;
    const [left, bottom, right, top] = box(outline);
    const known = floors.find(({ name }) => name === floor);
    if (known) {
      known.least = [Math.min(known.least[0], left - AROUND_M), Math.min(known.least[1], bottom - AROUND_M)];
      known.most = [Math.max(known.most[0], right + AROUND_M), Math.max(known.most[1], top + AROUND_M)];
    } else {
      floors.push({ name: floor, least: [left - AROUND_M, bottom - AROUND_M], most: [right + AROUND_M, top + AROUND_M] });
    }
  }
  return floors;
}

export function framed({ bounds, rooms }: Pick<HomeView, 'bounds' | 'rooms'>): Bounds {
  const [least, most] = bounds;
  return floorsOf(rooms).reduce<Bounds>(
    ([low, high], floor) => [[Math.min(low[0], floor.least[0]), Math.min(low[1], floor.least[1])], [Math.max(high[0], floor.most[0]), Math.max(high[1], floor.most[1])]],
    [least, most],
  );
}

export function drawFrames(pen: Pen, home: HomeView, view: View, palette: Palette): void {
  pen.lineWidth = 1.4;
  pen.strokeStyle = palette.quiet;
  pen.setLineDash([10, 5]);
  for (const { least, most } of floorsOf(home.rooms)) {
    pen.beginPath();
    trace(pen, view, [least, [most[0], least[1]], most, [least[0], most[1]]]);
    pen.stroke();
  }
  pen.setLineDash([]);
}

/** Names on the frames, outside of rooms; other names avoid them. */
export function drawFloorNames(pen: Pen, home: HomeView, view: View, palette: Palette, taken: Box[]): void {
  pen.textAlign = 'left';
  pen.textBaseline = 'bottom';
  const size = Math.min(Math.max(view.scale * 0.26, 12), 18);
  pen.font = `700 ${size}px ${FONT}`;
  for (const { name, least, most } of floorsOf(home.rooms)) {
    const words = fitting(name, (most[0] - least[0]) * view.scale, (t) => pen.measureText(t).width);
    if (words === null) continue;
    const [x, y] = toScreen(view, [least[0], most[1]]);
    text(pen, isolated(words), x, y - 3, palette.text, palette.halo);
    taken.push([x, y - 3 - size, x + pen.measureText(words).width, y - 3]);
  }
}
