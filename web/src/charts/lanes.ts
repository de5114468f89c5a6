// A day as lanes: what residents did as bands, below them a lane for each sensor with a tick where it fired.

import { type Calendar, clockOf } from '../localtime';
import { kindOf } from '../plan/kinds';
import { colourOf } from '../plan/moving';
import { type Palette, contrast, mix } from '../plan/palette';
import { FONT, glyph, penOf } from '../plan/pen';
import { type Shade, columns } from './shades';
import { fitting, isolated, spoken } from '../plan/words';

export const LANE = 15;
const BAND = 19;
const AXIS = 18;

/** Where names end and time begins, in pixels. */
export function left(width: number): number {
  return Math.min(150, width * 0.3);
}

function right(width: number): number {
  return width - 12;
}

/** Where on the drawing an instant of the day is, and back. */
export function xOf(begin_us: number, end_us: number, width: number, at_us: number): number {
  return left(width) + ((at_us - begin_us) / Math.max(end_us - begin_us, 1)) * (right(width) - left(width));
}

export function instantAt(begin_us: number, end_us: number, width: number, x: number): number {
  const share = Math.min(Math.max((x - left(width)) / (right(width) - left(width)), 0), 1);
  return begin_us + share * (end_us - begin_us);
}

/** What somebody did, as a band above the lanes. */
type Band = { name: string; spans: readonly [begin: number, end: number, activity: number][] };

/** A sensor, or several of one kind, and when they fired. */
export type Lane = { name: string; kind: string; fired: ArrayLike<number> };

/** A day of a run, and what is drawn of it: bands of what was done, shades of where it was unsure who is, lanes of firings. */
export type DayDrawing = { calendar: Pick<Calendar, 'days'>; number: number; bands: Band[]; activities: string[]; shades?: Shade[]; lanes: Lane[] };

export function height({ bands, shades = [], lanes }: Pick<DayDrawing, 'bands' | 'shades' | 'lanes'>): number {
  return AXIS + bands.length * BAND + shades.length * LANE + lanes.length * LANE + 4;
}

export function drawLanes(canvas: HTMLCanvasElement, width: number, { calendar, number, bands, activities, shades = [], lanes }: DayDrawing, palette: Palette): void {
  const day = calendar.days[number];
  if (day === undefined) return;
  const high = height({ bands, shades, lanes });
  const pen = penOf(canvas, width, high);
  if (pen === null) return;
  const { begin_us, end_us } = day;
  const x = (at: number) => xOf(begin_us, end_us, width, Math.min(Math.max(at, begin_us), end_us));
  pen.textBaseline = 'middle';
  hours(pen, calendar, number, width, high, x, palette);
  const measure = (words: string) => pen.measureText(words).width;
  let top = AXIS;
  bands.forEach(({ name, spans }, index) => {
    pen.font = `600 12px ${FONT}`;
    pen.textAlign = 'left';
    pen.fillStyle = palette.text;
    pen.fillText(isolated(fitting(name, left(width) - 16, measure) ?? ''), 8, top + BAND / 2);
    const colour = colourOf(index);
    for (const [from, to, activity] of spans) {
      const [begin, wide] = [x(from), Math.max(x(to) - x(from), 1)];
      pen.fillStyle = colour;
      pen.globalAlpha = activity % 2 === 0 ? 0.95 : 0.6;
      pen.fillRect(begin, top + 2, Math.max(wide - 0.6, 0.6), BAND - 4);
      pen.globalAlpha = 1;
      if (wide < 30) continue;
      pen.font = `10.5px ${FONT}`;
      const words = fitting(spoken(activities[activity] ?? ''), wide - 6, measure);
      if (words === null) continue;
      const plain = activity % 2 === 0 ? colour : mix(palette.halo, colour, 0.6);
      pen.fillStyle = contrast(plain, '#ffffff') >= 4.5 ? '#ffffff' : '#000000';
      pen.textAlign = 'left';
      pen.fillText(isolated(words), begin + 3, top + BAND / 2 + 0.5);
    }
    top += BAND;
  });
  for (const { name, by } of shades) {
    pen.font = `11.5px ${FONT}`;
    pen.textAlign = 'left';
    pen.fillStyle = palette.text;
    const words = fitting(name, left(width) - 30, measure);
    if (words !== null) pen.fillText(isolated(words), 23, top + LANE / 2 + 0.5);
    const wide = Math.max(Math.floor(right(width) - left(width)), 1);
    by.forEach((spans, index) => {
      pen.fillStyle = colourOf(index);
      columns(spans, begin_us, end_us, wide).forEach((chance, column) => {
        if (chance < 0.01) return;
        pen.globalAlpha = chance;
        pen.fillRect(left(width) + column, top + 1.5, 1, LANE - 3);
      });
    });
    pen.globalAlpha = 1;
    top += LANE;
  }
  for (const { name, kind, fired } of lanes) {
    const middle = top + LANE / 2;
    pen.globalAlpha = 0.3;
    pen.fillStyle = palette.furnitureEdge;
    pen.fillRect(left(width), middle, right(width) - left(width), 1);
    pen.globalAlpha = 1;
    glyph(pen, kindOf(kind), [13, middle], 4.2, 0, palette);
    pen.font = `11.5px ${FONT}`;
    pen.textAlign = 'left';
    pen.fillStyle = palette.text;
    const words = fitting(name, left(width) - 30, measure);
    if (words !== null) pen.fillText(isolated(words), 23, middle + 0.5);
    pen.fillStyle = palette.text;
    let last = -Infinity;
    for (let index = 0; index < fired.length; index++) {
      const place = x(fired[index]!);
      // Ticks nearer than half a pixel are one.
      if (place - last < 0.5) continue;
      last = place;
      pen.fillRect(place - 0.5, middle - 4.5, 1, 9);
    }
    top += LANE;
  }
}

/** Marks at round times of a day's clock, across the whole drawing. */
export function hours(pen: CanvasRenderingContext2D, calendar: Pick<Calendar, 'days'>, number: number, width: number, high: number, x: (at: number) => number, palette: Palette): void {
  const { begin_us, end_us } = calendar.days[number]!;
  const span = end_us - begin_us;
  // As many marks as there is room for, at round times.
  const steps = [1, 5, 10, 30, 60, 300, 600, 1800, 3600, 7200, 10_800].map((seconds) => seconds * 1e6);
  const step = steps.find((one) => (span / one) * 62 <= right(width) - left(width)) ?? steps.at(-1)!;
  pen.font = `11px ${FONT}`;
  pen.textAlign = 'center';
  const offset = (clockOf(calendar, begin_us) * 1000) % step;
  for (let at = begin_us - offset + (offset > 0 ? step : 0); at <= end_us; at += step) {
    const place = x(at);
    pen.globalAlpha = 0.35;
    pen.fillStyle = palette.furnitureEdge;
    pen.fillRect(place, AXIS - 3, 1, high);
    pen.globalAlpha = 1;
    const clock = clockOf(calendar, Math.min(at, end_us - 1));
    if (place > width - 22 || !Number.isFinite(clock)) continue;
    pen.fillStyle = palette.quiet;
    pen.fillText(new Date(Math.round(clock / 1000) * 1000).toISOString().slice(11, step < 60e6 ? 19 : 16), place, AXIS / 2);
  }
}
