// An interval as lanes: bands with the activities of residents, and below them a lane for each sensor with a tick for
// each firing.

import { type Calendar } from '../localtime';
import { kindOf } from '../plan/kinds';
import { colourOf } from '../plan/moving';
import { type Palette, contrast } from '../plan/palette';
import { FONT, type Ink, glyph, penOf } from '../plan/pen';
import { fitting, isolated, spoken } from '../plan/words';
import { AXIS, type Sight, drawAxis, firstFrom, left, right, xOf } from './axis';
import { activityKind } from './kinds-of-activities';
import { type Shade, columns } from './shades';
import { type Unseen, hatch, unseenIn } from './unseen';

export const LANE = 15;
export const BAND = 19;

/** Activities of a person, as a band above the lanes. `who` is a resident's number, whose colour is shown before the name; `isBeside` marks another run; `unseen` is unknown. */
export type Band = { name: string; who: number | null; spans: readonly Span[]; names: readonly string[]; isRoom?: boolean; isBeside?: boolean; unseen?: readonly Unseen[] };
type Span = readonly [begin: number, end: number, what: number];

/** The name of a band; a long name is cut at its end. */
export function bandName({ name, isBeside }: Pick<Band, 'name' | 'isBeside'>): string {
  return isBeside ? `second: ${name}` : name;
}

/** A sensor, or several of one kind, with its firings. */
export type Lane = {
  name: string;
  kind: string;
  /** In order. */
  fired: ArrayLike<number>;
  /** The room that it is in. */
  place?: string;
  /** The value of a firing, by its index in `fired`. */
  said?: (index: number) => string;
  /** The values of a numeric sensor, by the index in `fired`. */
  curve?: Curve;
  /** Its firings in each part of the run, drawn instead of single firings. */
  density?: Counts;
  beside?: Beside;
  /** Intervals with firings that are not known one by one. */
  unseen?: readonly Unseen[];
  /** For counts: those of another run, and its own in the parts that both runs have. */
  densityBeside?: { counts: Counts; shared: Counts };
};

export type Curve = { values: ArrayLike<number>; low: number; high: number };

/** Firings, counted in parts of equal length from the run's start on. `sums` has the total before each part. */
export type Counts = { bucket_us: number; counts: ArrayLike<number>; sums: Float64Array; most: number };

export function countsOf(bucket_us: number, counts: ArrayLike<number>): Counts {
  const sums = new Float64Array(counts.length + 1);
  let most = 0;
  for (let part = 0; part < counts.length; part++) {
    sums[part + 1] = sums[part]! + counts[part]!;
    most = Math.max(most, counts[part]!);
  }
  return { bucket_us, counts, sums, most };
}

/** Approximate number of firings between two instants. */
export function countBetween({ bucket_us, counts, sums }: Counts, from_us: number, to_us: number): number {
  const before = (at_us: number) => {
    const place = Math.min(Math.max(at_us / bucket_us, 0), counts.length);
    const part = Math.min(Math.floor(place), counts.length - 1);
    return part < 0 ? 0 : sums[part]! + (place - part) * counts[part]!;
  };
  return before(to_us) - before(from_us);
}

/** Firings of a lane in sight, including all of those that were not seen. */
export function countIn({ fired, density, beside, densityBeside, unseen }: Lane, sight: Sight): number {
  const { from_us, to_us } = sight;
  if (density !== undefined) return countBetween(density, from_us, to_us) + (densityBeside === undefined ? 0 : countBetween(densityBeside.counts, from_us, to_us));
  const of = (all: ArrayLike<number>) => firstFrom(all, to_us) - firstFrom(all, from_us);
  const missing = unseenIn(unseen, sight).reduce((sum, part) => sum + part.missing, 0);
  return of(fired) + missing + (beside === undefined ? 0 : of(beside.fired));
}

/** Firings and values of the same sensor in another run, and those without a counterpart in each. Its curve has the range of the lane's own. */
export type Beside = { fired: ArrayLike<number>; said: (index: number) => string; curve?: Curve; onlyFirst: ArrayLike<number>; onlySecond: ArrayLike<number> };

/** The content of a drawing: bands of activities, shades of uncertain places, lanes of firings. */
export type Drawing = { calendar: Pick<Calendar, 'days'>; sight: Sight; bands: Band[]; shades?: Shade[]; lanes: Lane[] };

/** The height of the part above the lanes. */
export function headHeight({ bands, shades = [] }: Pick<Drawing, 'bands' | 'shades'>): number {
  return AXIS + bands.length * BAND + shades.length * LANE;
}

export function height(drawing: Pick<Drawing, 'bands' | 'shades' | 'lanes'>): number {
  return headHeight(drawing) + drawing.lanes.length * LANE + 4;
}

export function drawLanes(canvas: HTMLCanvasElement, width: number, drawing: Drawing, palette: Palette): void {
  const pen = penOf(canvas, width, height(drawing));
  if (pen === null) return;
  drawAxis(pen, drawing.calendar, drawing.sight, width, height(drawing), palette);
  drawHead(pen, width, drawing, palette);
  drawFirings(pen, width, headHeight(drawing), drawing, palette);
}

/** The bands and shades, below the row of times. */
export function drawHead(pen: Ink, width: number, { sight, bands, shades = [] }: Omit<Drawing, 'lanes'>, palette: Palette): void {
  pen.textBaseline = 'middle';
  const measure = (words: string) => pen.measureText(words).width;
  let top = AXIS;
  for (const band of bands) {
    const named = band.who === null ? 8 : 22;
    if (band.who !== null) {
      pen.fillStyle = colourOf(band.who);
      pen.fillRect(9, top + BAND / 2 - 4, 8, 8);
    }
    pen.font = `600 12px ${FONT}`;
    pen.textAlign = 'left';
    pen.fillStyle = palette.text;
    pen.fillText(isolated(fitting(bandName(band), left(width) - named - 6, measure) ?? ''), named, top + BAND / 2);
    hatch(pen, width, sight, band.unseen, [top + 3, BAND - 6], palette.quiet);
    drawBand(pen, width, top, sight, band, palette);
    top += BAND;
  }
  for (const { name, by } of shades) {
    pen.font = `11.5px ${FONT}`;
    pen.textAlign = 'left';
    pen.fillStyle = palette.text;
    const words = fitting(name, left(width) - 30, measure);
    if (words !== null) pen.fillText(isolated(words), 23, top + LANE / 2 + 0.5);
    const wide = Math.max(Math.floor(right(width) - left(width)), 1);
    by.forEach((spans, index) => {
      pen.fillStyle = colourOf(index);
      columns(spans, sight.from_us, sight.to_us, wide).forEach((chance, column) => {
        if (chance < 0.01) return;
        pen.globalAlpha = chance;
        pen.fillRect(left(width) + column, top + 1.5, 1, LANE - 3);
      });
    });
    pen.globalAlpha = 1;
    top += LANE;
  }
}

function drawBand(pen: Ink, width: number, top: number, { from_us, to_us }: Sight, { spans, names, isRoom }: Band, palette: Palette): void {
  const measure = (words: string) => pen.measureText(words).width;
  const x = (at: number) => xOf(from_us, to_us, width, Math.min(Math.max(at, from_us), to_us));
  pen.textAlign = 'left';
  let last = -Infinity;
  for (const [from, to, what] of spans) {
    if (to <= from_us || from >= to_us) continue;
    const begin = Math.max(x(from), last);
    const end = Math.max(x(to), begin + 0.5);
    // The next interval is drawn over one that is narrower than a pixel.
    last = end - begin < 1 ? begin : end;
    const name = names[what] ?? '';
    const colour = isRoom ? palette.soft : activityKind(name).colour(palette);
    pen.fillStyle = colour;
    pen.fillRect(begin, top + 2, Math.max(end - begin - 0.8, 0.6), BAND - 4);
    if (isRoom && end - begin > 3) {
      pen.globalAlpha = 0.6;
      pen.fillStyle = palette.furnitureEdge;
      pen.fillRect(begin, top + 2, 1, BAND - 4);
      pen.globalAlpha = 1;
    }
    if (end - begin < 30) continue;
    pen.font = `10.5px ${FONT}`;
    const words = fitting(spoken(name), end - begin - 6, measure);
    if (words === null) continue;
    pen.fillStyle = contrast(colour, '#ffffff') >= 4.5 ? '#ffffff' : '#000000';
    pen.fillText(isolated(words), begin + 3, top + BAND / 2 + 0.5);
  }
}

/** Nights in the background; over months there are none, as they would be nothing but stripes. */
export function drawNights(pen: Ink, width: number, top: number, high: number, { from_us, to_us }: Sight, nights: readonly (readonly [begin: number, end: number])[], palette: Palette): void {
  if (to_us - from_us > 45 * 86_400e6) return;
  const x = (at: number) => xOf(from_us, to_us, width, Math.min(Math.max(at, from_us), to_us));
  pen.fillStyle = palette.floorNight;
  pen.globalAlpha = 0.45;
  for (const [begin, end] of nights) {
    if (end > from_us && begin < to_us) pen.fillRect(x(begin), top, x(end) - x(begin), high);
  }
  pen.globalAlpha = 1;
}

/** Share of the drawing above which a mark is too wide to be filled (our choice). */
const LONG_SHARE = 0.05;
/** Height of such a mark. */
const THIN = 3;

/** A mark of the user, or a hit: a flag in the row of times, and a stripe below it. A long one has its stripe in the first row only, with a line at its beginning and end. */
export type Mark = { begin_us: number; end_us: number; isOwn?: boolean };

export function drawMarks(pen: Ink, width: number, top: number, high: number, { from_us, to_us }: Sight, marks: readonly Mark[], palette: Palette, flags: boolean): void {
  let last = -Infinity;
  for (const { begin_us, end_us, isOwn } of marks) {
    if (end_us < from_us || begin_us > to_us) continue;
    const begin = xOf(from_us, to_us, width, Math.max(begin_us, from_us));
    const end = xOf(from_us, to_us, width, Math.min(end_us, to_us));
    pen.fillStyle = isOwn ? palette.marked : palette.found;
    const isLong = end - begin > LONG_SHARE * (right(width) - left(width));
    if (isLong && flags) {
      pen.globalAlpha = 0.7;
      pen.fillRect(begin, top, end - begin, THIN);
    }
    pen.globalAlpha = 0.22;
    if (!isLong && end - begin >= 1) pen.fillRect(begin, top, end - begin, high);
    pen.globalAlpha = 0.7;
    const begins = begin_us >= from_us;
    if (begins && begin - last >= 1) pen.fillRect(begin - 0.5, top, 1, high);
    if (isLong && end_us <= to_us) pen.fillRect(end - 0.5, top, 1, high);
    pen.globalAlpha = 1;
    if (flags && begins && begin - last >= 2) {
      pen.beginPath();
      pen.moveTo(begin - 4, top);
      pen.lineTo(begin + 4, top);
      pen.lineTo(begin, top + 6);
      pen.closePath();
      pen.fill();
      last = begin;
    }
  }
}

/** The lanes from `top` on. */
export function drawFirings(pen: Ink, width: number, top: number, { sight, lanes }: Pick<Drawing, 'sight' | 'lanes'>, palette: Palette): void {
  pen.textBaseline = 'middle';
  const measure = (words: string) => pen.measureText(words).width;
  for (const lane of lanes) {
    const middle = top + LANE / 2;
    pen.globalAlpha = 0.3;
    pen.fillStyle = palette.furnitureEdge;
    pen.fillRect(left(width), middle, right(width) - left(width), 1);
    pen.globalAlpha = 1;
    glyph(pen, kindOf(lane.kind), [13, middle], 4.2, 0, palette);
    pen.font = `11.5px ${FONT}`;
    pen.textAlign = 'left';
    pen.fillStyle = palette.text;
    const words = fitting(lane.name, left(width) - 30, measure);
    if (words !== null) pen.fillText(isolated(words), 23, middle + 0.5);
    hatch(pen, width, sight, lane.unseen, [middle - 4.5, 9], palette.quiet);
    if (lane.density !== undefined && lane.densityBeside !== undefined) shadesBeside(pen, width, sight, lane.density, lane.densityBeside, middle, palette);
    else if (lane.density !== undefined) shadesOf(pen, width, sight, [lane.density], counted(lane.density), [middle - 5, 10], palette.text);
    else if (lane.curve !== undefined) drawCurves(pen, width, sight, lane, lane.curve, middle, palette);
    else if (lane.beside === undefined) ticks(pen, width, sight, lane.fired, middle - 4.5, 9, palette.text);
    else besides(pen, width, sight, lane.fired, lane.beside, middle, palette);
    top += LANE;
  }
}

/** Number of shades; neighbours of one shade are one stroke. */
const SHADES = 12;

type Between = (from_us: number, to_us: number) => number;

const counted = (counts: Counts): Between => (from_us, to_us) => countBetween(counts, from_us, to_us);

/** The excess of one count over another; less than half a firing counts as zero. */
const more = (counts: Counts, less: Counts): Between => (from_us, to_us) => {
  const by = countBetween(counts, from_us, to_us) - countBetween(less, from_us, to_us);
  return by < 0.5 ? 0 : by;
};

/** Counts as shades: the more firings a pixel has, the darker; the darkest is the maximum of `all` counts. */
function shadesOf(pen: Ink, width: number, { from_us, to_us }: Sight, all: readonly Counts[], between: Between, [top, high]: [number, number], colour: string, palest = 0.12): void {
  const [begin, wide] = [left(width), Math.max(Math.floor(right(width) - left(width)), 1)];
  const a_pixel = (to_us - from_us) / wide;
  const most = Math.max(...all.map(({ most, bucket_us }) => most * Math.max(a_pixel / bucket_us, 0.02)), 1e-9);
  pen.fillStyle = colour;
  let [shade, since] = [0, 0];
  const flush = (until: number) => {
    if (shade === 0) return;
    pen.globalAlpha = palest + ((1 - palest) * shade) / SHADES;
    pen.fillRect(begin + since, top, until - since, high);
  };
  for (let column = 0; column < wide; column++) {
    const from = from_us + column * a_pixel;
    const count = between(from, from + a_pixel);
    const now = count <= 0 ? 0 : Math.max(Math.ceil(Math.sqrt(Math.min(count / most, 1)) * SHADES), 1);
    if (now === shade) continue;
    flush(column);
    [shade, since] = [now, column];
  }
  flush(wide);
  pen.globalAlpha = 1;
}

/** Two runs: the first run's counts above the line, the second's below it; the excess of each is in its colour, and farther out. */
function shadesBeside(pen: Ink, width: number, sight: Sight, density: Counts, { counts, shared }: { counts: Counts; shared: Counts }, middle: number, palette: Palette): void {
  const both = [density, counts];
  shadesOf(pen, width, sight, both, counted(density), [middle - 4, 4], palette.text);
  shadesOf(pen, width, sight, both, counted(counts), [middle + 1, 4], palette.text);
  // A small excess on a thin stripe would be invisible.
  shadesOf(pen, width, sight, both, more(shared, counts), [middle - 7, 3], palette.seen, 0.4);
  shadesOf(pen, width, sight, both, more(counts, shared), [middle + 5, 3], palette.beam, 0.4);
}

/** The values of a numeric sensor; two runs have their own colours, the first one's on top. */
function drawCurves(pen: Ink, width: number, sight: Sight, { fired, beside }: Lane, curve: Curve, middle: number, palette: Palette): void {
  if (beside?.curve !== undefined) drawCurve(pen, width, sight, beside.fired, beside.curve, middle, palette.beam);
  drawCurve(pen, width, sight, fired, curve, middle, beside === undefined ? palette.beam : palette.seen);
}

/** Values as a line in steps, between the lowest and the highest of all. */
function drawCurve(pen: Ink, width: number, { from_us, to_us }: Sight, fired: ArrayLike<number>, { values, low, high }: Curve, middle: number, colour: string): void {
  const x = (at: number) => xOf(from_us, to_us, width, Math.min(Math.max(at, from_us), to_us));
  const y = (value: number) => middle + 5.5 - ((value - low) / Math.max(high - low, 1e-9)) * 11;
  const first = Math.max(firstFrom(fired, from_us) - 1, 0);
  pen.beginPath();
  let [last, level] = [-Infinity, 0];
  for (let index = first; index < fired.length && fired[index]! <= to_us; index++) {
    const place = x(fired[index]!);
    const next = y(values[index]!);
    if (last === -Infinity) pen.moveTo(place, next);
    else if (place - last < 0.5 && index + 1 < fired.length) continue;
    else {
      pen.lineTo(place, level);
      pen.lineTo(place, next);
    }
    [last, level] = [place, next];
  }
  if (last !== -Infinity) pen.lineTo(x(to_us), level);
  pen.strokeStyle = colour;
  pen.lineWidth = 1.4;
  pen.stroke();
}

/** The first run's firings above the line, the second's below it; firings without a counterpart are in the run's colour, and longer. */
function besides(pen: Ink, width: number, sight: Sight, fired: ArrayLike<number>, { fired: other, onlyFirst, onlySecond }: Beside, middle: number, palette: Palette): void {
  pen.globalAlpha = 0.5;
  ticks(pen, width, sight, fired, middle - 4, 4, palette.text);
  ticks(pen, width, sight, other, middle + 1, 4, palette.text);
  pen.globalAlpha = 1;
  ticks(pen, width, sight, onlyFirst, middle - 7, 7, palette.seen, 2);
  ticks(pen, width, sight, onlySecond, middle + 1, 7, palette.beam, 2);
}

function ticks(pen: Ink, width: number, { from_us, to_us }: Sight, fired: ArrayLike<number>, top: number, high: number, colour: string, wide = 1): void {
  pen.fillStyle = colour;
  let last = -Infinity;
  for (let index = firstFrom(fired, from_us); index < fired.length && fired[index]! <= to_us; index++) {
    const place = xOf(from_us, to_us, width, fired[index]!);
    // Ticks within half a pixel are one.
    if (place - last < 0.5) continue;
    last = place;
    pen.fillRect(place - wide / 2, top, wide, high);
  }
}
