// Draws days: each as a row of the clock's 24 hours, or one of them large.

import { drawAxis, left, xOf } from '../../charts/axis';
import { twoDigits } from '../../clock';
import { clockOf } from '../../localtime';
import { type Palette, contrast } from '../../plan/palette';
import { FONT, type Pen, penOf } from '../../plan/pen';
import { fitting, isolated, spoken } from '../../plan/words';
import type { DateView, MonthView } from '../../wire';
import { activityKind } from '../../charts/kinds-of-activities';
import { type Span, isWeekend, piecesOf, touching, weekday } from './days';

export const ROW = 14;
export const AXIS = 18;
const HOUR_US = 3_600_000_000;
const DAY_US = 24 * HOUR_US;

/** Width of the names of days before the first drawing. */
export const NAMES = 84;

/** The start and end of the 24 hours of a row, with or without the name of the day before them. */
function edges(width: number, named: boolean): [number, number] {
  return [named ? NAMES : 0, width - 10];
}

function begin(canvas: HTMLCanvasElement, width: number, high: number): Pen | null {
  const pen = penOf(canvas, width, high);
  if (pen !== null) pen.textBaseline = 'middle';
  return pen;
}

/** A month of one resident. With `only` the other kinds of activities are faint. */
export function drawMonth(canvas: HTMLCanvasElement, width: number, view: MonthView, resident: number, named: boolean, only: string | null, palette: Palette): void {
  const high = AXIS + view.days.length * ROW;
  const pen = begin(canvas, width, high);
  if (pen === null) return;
  const [from, to] = edges(width, named);
  const x = (at_us: number) => from + (at_us / DAY_US) * (to - from);
  view.days.forEach((day, row) => {
    const top = AXIS + row * ROW;
    pen.fillStyle = palette.outside;
    pen.fillRect(from, top + 1, to - from, ROW - 2);
    if (named) {
      pen.font = `${isWeekend(day.date) ? '600 ' : ''}11px ${FONT}`;
      pen.textAlign = 'left';
      pen.fillStyle = palette.text;
      pen.fillText(weekday(day.date), 2, top + ROW / 2 + 0.5);
    }
    for (const { from_us, to_us, what, pass } of piecesOf(day, view.spans[resident] ?? [])) {
      const kind = activityKind(view.activities[what] ?? '');
      pen.globalAlpha = only === null || only === kind.id ? 1 : 0.12;
      pen.fillStyle = kind.colour(palette);
      // A repeated hour is drawn in two halves, the first time above.
      const [down, tall] = { only: [1, ROW - 2], first: [1, (ROW - 2) / 2], second: [ROW / 2, (ROW - 2) / 2] }[pass] as [number, number];
      pen.fillRect(x(from_us), top + down, Math.max(x(to_us) - x(from_us), 0.7), tall);
    }
    pen.globalAlpha = 1;
  });
  pen.font = `11px ${FONT}`;
  pen.textAlign = 'center';
  for (let hour = 0; hour <= 24; hour += to - from > 260 ? 3 : 6) {
    const place = x(hour * HOUR_US);
    pen.fillStyle = palette.furnitureEdge;
    pen.globalAlpha = 0.45;
    pen.fillRect(place - 0.5, AXIS - 3, 1, high);
    pen.globalAlpha = 1;
    pen.fillStyle = palette.quiet;
    pen.fillText(twoDigits(hour), Math.min(Math.max(place, 7), width - 8), AXIS / 2);
  }
}

/** The day and time at a position on the drawing of a month. */
export function pointed(view: MonthView, width: number, named: boolean, x: number, y: number): { row: number; since_midnight_us: number } | null {
  const [from, to] = edges(width, named);
  const row = Math.floor((y - AXIS) / ROW);
  const share = (x - from) / (to - from);
  return view.days[row] === undefined || share < 0 || share >= 1 ? null : { row, since_midnight_us: share * DAY_US };
}

const BAND = 26;
const BARS = 46;
const GAP = 8;

export function dayHigh(sides: number): number {
  return AXIS + sides * (2 * BAND + BARS + GAP);
}

/** One day of one resident: activities, rooms, and motion; one variant below the other. */
export function drawDay(canvas: HTMLCanvasElement, width: number, sides: readonly { title: string; view: MonthView }[], number: number, resident: number, palette: Palette): void {
  const high = dayHigh(sides.length);
  const pen = begin(canvas, width, high);
  const day = sides[0]?.view.days[number];
  if (pen === null || day === undefined) return;
  const x = (at: number) => xOf(day.begin_us, day.end_us, width, Math.min(Math.max(at, day.begin_us), day.end_us));
  drawAxis(pen, sides[0]!.view, { from_us: day.begin_us, to_us: day.end_us }, width, high, palette);
  const most = sides.reduce((all, { view }) => Math.max(all, ...(view.hours[number] ?? [])), 1);
  sides.forEach(({ title, view }, side) => {
    let top = AXIS + side * (2 * BAND + BARS + GAP);
    const lane = (name: string, high: number) => {
      pen.font = `600 12px ${FONT}`;
      pen.textAlign = 'left';
      pen.fillStyle = palette.text;
      pen.fillText(isolated(fitting(name, left(width) - 14, (words) => pen.measureText(words).width) ?? ''), 8, top + high / 2);
    };
    lane(title === '' ? 'Activities' : title, BAND);
    bands(pen, touching(day, view.spans[resident] ?? []), x, top, (what) => [spoken(view.activities[what] ?? ''), activityKind(view.activities[what] ?? '').colour(palette)], palette);
    top += BAND;
    lane('Rooms', BAND);
    bands(pen, touching(day, view.stays[resident] ?? []), x, top, (what) => [view.rooms[what] ?? '', palette.furniture], palette);
    top += BAND;
    lane('Firings per hour', BARS);
    motion(pen, day, view, number, x, top, most, palette);
  });
}

function bands(pen: Pen, spans: readonly Span[], x: (at: number) => number, top: number, of: (what: number) => [name: string, colour: string], palette: Palette): void {
  for (const [from, to, what] of spans) {
    const [name, colour] = of(what);
    const [begin, wide] = [x(from), Math.max(x(to) - x(from), 1)];
    pen.fillStyle = colour;
    pen.fillRect(begin, top + 3, wide, BAND - 6);
    if (wide > 3) {
      pen.strokeStyle = palette.furnitureEdge;
      pen.lineWidth = 1;
      pen.strokeRect(begin + 0.5, top + 3.5, wide - 1, BAND - 7);
    }
    if (wide < 26) continue;
    pen.font = `11px ${FONT}`;
    const shown = fitting(name, wide - 8, (words) => pen.measureText(words).width);
    if (shown === null) continue;
    pen.fillStyle = contrast(colour, '#ffffff') >= 4.5 ? '#ffffff' : '#000000';
    pen.textAlign = 'left';
    pen.fillText(isolated(shown), begin + 4, top + BAND / 2 + 0.5);
  }
}

function motion(pen: Pen, day: DateView, view: MonthView, number: number, x: (at: number) => number, top: number, most: number, palette: Palette): void {
  for (const [from, to, hour] of clockHours(view, day)) {
    const count = view.hours[number]?.[hour] ?? 0;
    const tall = (count / most) * (BARS - 16);
    const [begin, wide] = [x(from), x(to) - x(from)];
    pen.fillStyle = palette.beam;
    pen.fillRect(begin + 1, top + BARS - tall, Math.max(wide - 2, 1), tall);
    if (wide < 22 || count === 0) continue;
    pen.font = `10.5px ${FONT}`;
    pen.textAlign = 'center';
    pen.fillStyle = palette.text;
    pen.fillText(String(count), begin + wide / 2, top + BARS - tall - 6);
  }
}

/** The hours of a day's clock, each with its begin and end; a repeated one has the length of both. */
export function clockHours(view: Pick<MonthView, 'days'>, day: DateView): [from: number, to: number, hour: number][] {
  const hourOf = (at: number) => new Date(clockOf(view, at)).getUTCHours();
  const edges = new Set([day.begin_us, day.end_us]);
  for (let at = day.begin_us - (day.clock_us % HOUR_US); at < day.end_us; at += HOUR_US / 4) if (at > day.begin_us) edges.add(at);
  if (day.turn !== null) edges.add(day.turn[0]);
  const all: [number, number, number][] = [];
  const sorted = [...edges].sort((a, b) => a - b);
  for (let edge = 0; edge + 1 < sorted.length; edge++) {
    const [from, to] = [sorted[edge]!, sorted[edge + 1]!];
    const [last, hour] = [all.at(-1), hourOf(from)];
    if (last?.[2] === hour) last[1] = to;
    else all.push([from, to, hour]);
  }
  return all;
}
