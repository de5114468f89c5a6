// Motion density: a column for each day, its hours from top to bottom, coloured by the number of firings.

import { date, dayMonth, read, twoDigits } from '../clock';
import { livedOf } from '../localtime';
import { type Palette, viridis } from '../plan/palette';
import { penOf, pixelRatio } from '../plan/pen';
import type { DateView } from '../wire';

export const HOURS = 24;

export type Density = {
  days: DateView[];
  /** By day and hour of the clock. */
  hours: number[][];
  /** Later hours are not known yet. */
  until_us: number;
  /** The count with the brightest colour. */
  most: number;
};

/** A round upper bound: the colours of a growing log seldom change. */
export function scaleOf(hours: number[][]): number {
  const most = hours.reduce((a, row) => row.reduce((b, count) => Math.max(b, count), a), 0);
  const tens = 10 ** Math.floor(Math.log10(Math.max(most, 10)));
  return [1, 2, 5, 10].map((step) => step * tens).find((step) => step >= most) ?? most;
}

/** The number of firings; null for an hour that was not simulated. */
export function countAt({ days, hours, until_us }: Density, day: number, hour: number): number | null {
  const of = days[day];
  return of === undefined || livedOf(of, hour, until_us) <= 0 ? null : (hours[day]?.[hour] ?? 0);
}

/** From 0 to 1; few firings are visible next to many. */
function share(count: number, most: number): number {
  return most === 0 ? 0 : Math.sqrt(count / most);
}

export function drawDensity(canvas: HTMLCanvasElement, width: number, high: number, density: Density, palette: Palette): void {
  const pen = penOf(canvas, width, high);
  if (pen === null) return;
  const ratio = pixelRatio();
  hatch(pen, width, high, palette);
  const [wide, tall] = [width / Math.max(density.days.length, 1), high / HOURS];
  for (let day = 0; day < density.days.length; day++) {
    for (let hour = 0; hour < HOURS; hour++) {
      const count = countAt(density, day, hour);
      if (count === null) continue;
      pen.fillStyle = count === 0 ? palette.halo : viridis(share(count, density.most));
      // Neighbours meet at whole pixels, to avoid visible seams.
      const [left, top] = [Math.round(day * wide * ratio) / ratio, Math.round(hour * tall * ratio) / ratio];
      pen.fillRect(left, top, Math.max(Math.round((day + 1) * wide * ratio) / ratio - left, 1), Math.round((hour + 1) * tall * ratio) / ratio - top);
    }
  }
}

/** Draws excess and deficit; null is a day that the other run lacks. */
export function drawMore(canvas: HTMLCanvasElement, width: number, high: number, more: (number[] | null)[], most: number, palette: Palette): void {
  const pen = penOf(canvas, width, high);
  if (pen === null) return;
  hatch(pen, width, high, palette);
  const [wide, tall] = [width / Math.max(more.length, 1), high / HOURS];
  more.forEach((hours, day) => {
    if (hours === null) return;
    pen.fillStyle = palette.halo;
    pen.fillRect(day * wide, 0, wide + 0.5, high);
    hours.forEach((count, hour) => {
      if (count === 0) return;
      pen.globalAlpha = share(Math.abs(count), most);
      pen.fillStyle = count < 0 ? palette.seen : palette.beam;
      pen.fillRect(day * wide, hour * tall, Math.max(wide, 1), tall);
      pen.globalAlpha = 1;
    });
  });
}

/** Hatches the unknown part. */
function hatch(pen: CanvasRenderingContext2D, width: number, high: number, palette: Palette): void {
  pen.fillStyle = palette.outside;
  pen.fillRect(0, 0, width, high);
  pen.beginPath();
  for (let at = 0; at < width + high; at += 9) {
    pen.moveTo(at, 0);
    pen.lineTo(at - high, high);
  }
  pen.globalAlpha = 0.28;
  pen.lineWidth = 1;
  pen.strokeStyle = palette.furnitureEdge;
  pen.stroke();
  pen.globalAlpha = 1;
}

/** The dates below, as close as their width permits: position from the left, and text. */
export function datesOf(days: DateView[], width: number): { x: number; label: string }[] {
  const apart = Math.max(Math.ceil((74 * days.length) / Math.max(width, 1)), 1);
  const step = [1, 2, 7, 14, 28, 56, 91, 182, 364].find((one) => one >= apart) ?? apart;
  return days.flatMap(({ date }, index) =>
    index % step === 0 && (index + 0.2) * (width / days.length) < width - 50 ? [{ x: (index / days.length) * width, label: dayMonth(read(`${date} 00:00:00`)) }] : [],
  );
}

/** `Mon, 2 March 2009, 07 to 08 h: 112 firings`. */
export function words(density: Density, day: number, hour: number): string {
  const count = countAt(density, day, hour);
  const said = count === null ? 'no data' : count === 0 ? 'no firings' : count === 1 ? '1 firing' : `${count.toLocaleString('en-GB')} firings`;
  return `${date(read(`${density.days[day]?.date} 00:00:00`))}, ${twoDigits(hour)} to ${twoDigits(hour + 1)} h: ${said}`;
}

/** The hour with the most firings of a day, in words. */
export function busiest(hours: number[]): string {
  const top = hours.reduce((a, b) => Math.max(a, b), 0);
  const from = hours.indexOf(top);
  return top === 0 ? 'none' : `${twoDigits(from)} to ${twoDigits(from + 1)} h`;
}
