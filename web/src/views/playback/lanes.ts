// A day as lanes: what residents did as bands, below them a lane for each sensor with a tick where it fired.

import { kindOf } from '../../plan/kinds';
import { colourOf } from '../../plan/moving';
import { type Palette, contrast, viridis } from '../../plan/palette';
import { FONT, glyph } from '../../plan/pen';
import { fitting, isolated } from '../../plan/words';
import type { PlaybackView } from '../../wire';
import type { Day } from './day';
import { clockOf } from './localtime';

export const LANE = 15;
const BAND = 19;
const AXIS = 18;

/** Where names end and time begins, in pixels. */
export function left(width: number): number {
  return Math.min(150, width * 0.3);
}

export function right(width: number): number {
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

export function height(run: PlaybackView, truth: boolean): number {
  return AXIS + (truth ? run.residents.length * BAND : 0) + run.sensors.length * LANE + 4;
}

export function drawLanes(canvas: HTMLCanvasElement, width: number, dpr: number, run: PlaybackView, number: number, day: Day | null, truth: boolean, palette: Palette): void {
  const pen = canvas.getContext('2d');
  if (pen === null || width < 1) return;
  const high = height(run, truth);
  [canvas.width, canvas.height] = [Math.round(width * dpr), Math.round(high * dpr)];
  pen.setTransform(dpr, 0, 0, dpr, 0, 0);
  const { begin_us, end_us } = run.days[number]!;
  const x = (at: number) => xOf(begin_us, end_us, width, Math.min(Math.max(at, begin_us), end_us));
  pen.textBaseline = 'middle';
  hours(pen, run, number, width, high, x, palette);
  const measure = (words: string) => pen.measureText(words).width;
  let top = AXIS;
  if (truth) {
    run.residents.forEach((resident, index) => {
      pen.font = `600 12px ${FONT}`;
      pen.textAlign = 'left';
      pen.fillStyle = palette.text;
      pen.fillText(isolated(fitting(resident.name, left(width) - 16, measure) ?? ''), 8, top + BAND / 2);
      const colour = colourOf(index);
      for (const [from, to, activity] of day?.view.lives[index]?.activities ?? []) {
        const [begin, wide] = [x(from), Math.max(x(to) - x(from), 1)];
        pen.fillStyle = colour;
        pen.globalAlpha = activity % 2 === 0 ? 0.95 : 0.6;
        pen.fillRect(begin, top + 2, Math.max(wide - 0.6, 0.6), BAND - 4);
        pen.globalAlpha = 1;
        if (wide < 30) continue;
        pen.font = `10.5px ${FONT}`;
        const name = fitting((run.activities[activity] ?? '').replaceAll('_', ' '), wide - 6, measure);
        if (name === null) continue;
        const ground = palette.halo;
        const plain = activity % 2 === 0 ? colour : blend(colour, ground);
        pen.fillStyle = contrast(plain, '#ffffff') >= 4.5 ? '#ffffff' : '#000000';
        pen.textAlign = 'left';
        pen.fillText(isolated(name), begin + 3, top + BAND / 2 + 0.5);
      }
      top += BAND;
    });
  }
  run.sensors.forEach((id, index) => {
    const sensor = run.home.sensors[index];
    const middle = top + LANE / 2;
    pen.globalAlpha = 0.3;
    pen.fillStyle = palette.furnitureEdge;
    pen.fillRect(left(width), middle, right(width) - left(width), 1);
    pen.globalAlpha = 1;
    glyph(pen, kindOf(sensor?.kind ?? ''), [13, middle], 4.2, 0, palette);
    pen.font = `11.5px ${FONT}`;
    pen.textAlign = 'left';
    pen.fillStyle = palette.text;
    const name = fitting(sensor?.name ?? id, left(width) - 30, measure);
    if (name !== null) pen.fillText(isolated(name), 23, middle + 0.5);
    pen.fillStyle = palette.text;
    let last = -Infinity;
    for (const at of day?.fired[index] ?? []) {
      const place = x(at);
      // Ticks nearer than half a pixel are one.
      if (place - last < 0.5) continue;
      last = place;
      pen.fillRect(place - 0.5, middle - 4.5, 1, 9);
    }
    top += LANE;
  });
}

function blend(colour: string, ground: string): string {
  const channel = (text: string, at: number) => parseInt(text.slice(at, at + 2), 16);
  return `#${[1, 3, 5].map((at) => Math.round(channel(colour, at) * 0.6 + channel(ground, at) * 0.4).toString(16).padStart(2, '0')).join('')}`;
}

/** Marks at round times of a day's clock, across the whole drawing. */
export function hours(pen: CanvasRenderingContext2D, run: Pick<PlaybackView, 'days'>, number: number, width: number, high: number, x: (at: number) => number, palette: Palette): void {
  const { begin_us, end_us } = run.days[number]!;
  const span = end_us - begin_us;
  // As many marks as there is room for, at round times.
  const steps = [1, 5, 10, 30, 60, 300, 600, 1800, 3600, 7200, 10_800].map((seconds) => seconds * 1e6);
  const step = steps.find((one) => (span / one) * 62 <= right(width) - left(width)) ?? steps.at(-1)!;
  pen.font = `11px ${FONT}`;
  pen.textAlign = 'center';
  const offset = (clockOf(run, begin_us) * 1000) % step;
  for (let at = begin_us - offset + (offset > 0 ? step : 0); at <= end_us; at += step) {
    const place = x(at);
    pen.globalAlpha = 0.35;
    pen.fillStyle = palette.furnitureEdge;
    pen.fillRect(place, AXIS - 3, 1, high);
    pen.globalAlpha = 1;
    const clock = clockOf(run, Math.min(at, end_us - 1));
    if (place > width - 22 || !Number.isFinite(clock)) continue;
    pen.fillStyle = palette.quiet;
    pen.fillText(new Date(Math.round(clock / 1000) * 1000).toISOString().slice(11, step < 60e6 ? 19 : 16), place, AXIS / 2);
  }
}

/** The whole run: a column for each day, its hours from the top down. */
export function drawRun(canvas: HTMLCanvasElement, width: number, high: number, dpr: number, run: PlaybackView, palette: Palette): void {
  const pen = canvas.getContext('2d');
  if (pen === null || width < 1) return;
  [canvas.width, canvas.height] = [Math.round(width * dpr), Math.round(high * dpr)];
  pen.setTransform(dpr, 0, 0, dpr, 0, 0);
  pen.fillStyle = palette.outside;
  pen.fillRect(0, 0, width, high);
  const most = run.hours.reduce((a, hours) => Math.max(a, ...hours), 0);
  const [wide, tall] = [width / Math.max(run.hours.length, 1), high / 24];
  run.hours.forEach((hours, day) =>
    hours.forEach((count, hour) => {
      pen.fillStyle = viridis(most === 0 ? 0 : Math.sqrt(count / most));
      pen.fillRect(day * wide, hour * tall, wide + 0.5, tall + 0.5);
    }),
  );
}
