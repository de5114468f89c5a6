// The number of sensors that see each spot of the floor, as colours; dead zones are hatched and numbered, so that
// colour is never alone.

import type { At } from '../../plan/geometry';
import type { Palette } from '../../plan/palette';
import { FONT, type Pen, text, trace } from '../../plan/pen';
import { type View, toScreen } from '../../plan/transform';
import type { CoverageView } from '../../wire';

export const MODES = [
  { id: 'count', title: 'Number of sensors' },
  { id: 'dead', title: 'Dead zones only' },
  { id: 'alone', title: 'Selected sensor only' },
  { id: 'off', title: 'Off' },
] as const;

export type Mode = (typeof MODES)[number]['id'];

const NOWHERE = 255;
const OPACITY = 0.62;

/** The colours of spots in view of one, of two, and of three or more sensors: those of the printed sheet. */
export const COLOURS = ['#f2e96b', '#4fbf83', '#31688e'] as const;

/** Spots that only the chosen sensor sees, and those that others see, too. */
export const ALONE = { only: COLOURS[0], others: COLOURS[1] };

/** The colour of each cell, or null. */
export function colours(coverage: CoverageView, mode: Mode, alone: CoverageView | null): (string | null)[] {
  if (mode === 'count') {
    return Array.from(coverage.cells, (count) => (count === NOWHERE || count === 0 ? null : COLOURS[Math.min(count, COLOURS.length) - 1]!));
  }
  // Both have the same cells, which depend on the building only; if it has changed meanwhile, nothing is shown.
  if (mode !== 'alone' || alone === null || alone.cells.length !== coverage.cells.length) return [];
  return Array.from(alone.cells, (count, cell) => (count !== 1 ? null : coverage.cells[cell]! > 1 ? ALONE.others : ALONE.only));
}

/** A pixel a cell, with the north on top. */
export function heatOf(coverage: CoverageView, mode: Mode, alone: CoverageView | null): HTMLCanvasElement | null {
  const { columns } = coverage;
  const rows = Math.ceil(coverage.cells.length / Math.max(columns, 1));
  const of = colours(coverage, mode, alone);
  const canvas = document.createElement('canvas');
  const pen = canvas.getContext('2d');
  if (pen === null || of.length === 0 || columns === 0) return null;
  [canvas.width, canvas.height] = [columns, rows];
  const image = pen.createImageData(columns, rows);
  const pixels = new Uint32Array(image.data.buffer);
  const values = new Map<string, number>();
  of.forEach((colour, cell) => {
    if (colour === null) return;
    let value = values.get(colour);
    if (value === undefined) values.set(colour, (value = pixelOf(colour)));
    pixels[(rows - 1 - Math.floor(cell / columns)) * columns + (cell % columns)] = value;
  });
  pen.putImageData(image, 0, 0);
  return canvas;
}

/** Opaque, in the byte order of memory. */
function pixelOf(colour: string): number {
  const [r, g, b] = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16)) as [number, number, number];
  return new Uint32Array(new Uint8Array([r, g, b, 255]).buffer)[0]!;
}

export function drawHeat(pen: Pen, view: View, coverage: CoverageView, picture: HTMLCanvasElement, faded: boolean): void {
  const rows = Math.ceil(coverage.cells.length / coverage.columns);
  const [x, y] = toScreen(view, [coverage.corner[0], coverage.corner[1] + rows * coverage.step_m]);
  pen.globalAlpha = faded ? OPACITY * 0.4 : OPACITY;
  pen.imageSmoothingEnabled = false;
  pen.drawImage(picture, x, y, coverage.columns * coverage.step_m * view.scale, rows * coverage.step_m * view.scale);
  pen.globalAlpha = 1;
}

const HATCH = 9;

export function drawDeadZones(pen: Pen, view: View, coverage: CoverageView, palette: Palette, faded: boolean): void {
  pen.globalAlpha = faded ? 0.35 : 1;
  pen.lineWidth = 1.3;
  pen.strokeStyle = palette.seen;
  for (const { outline, holes } of coverage.dead_zones) {
    pen.save();
    pen.beginPath();
    for (const ring of [outline, ...holes]) trace(pen, view, ring);
    pen.stroke();
    pen.clip('evenodd');
    const xs = outline.map((at) => toScreen(view, at));
    const [left, right] = [Math.min(...xs.map(([x]) => x)), Math.max(...xs.map(([x]) => x))];
    const [top, bottom] = [Math.min(...xs.map(([, y]) => y)), Math.max(...xs.map(([, y]) => y))];
    pen.beginPath();
    for (let at = Math.floor((left + top) / HATCH) * HATCH; at <= right + bottom; at += HATCH) {
      pen.moveTo(at - top, top);
      pen.lineTo(at - bottom, bottom);
    }
    pen.lineWidth = 0.9;
    pen.stroke();
    pen.restore();
  }
  pen.globalAlpha = 1;
}

/** The numbers of dead zones that are large enough on the screen, with their places. */
export function numbersOf({ dead_zones }: CoverageView, view: View): { number: number; at: At }[] {
  const large = dead_zones.filter(({ area_m2 }) => area_m2 * view.scale * view.scale >= 120);
  return large.map(({ number, middle }) => ({ number, at: toScreen(view, middle) }));
}

export function drawNumbers(pen: Pen, view: View, coverage: CoverageView, palette: Palette): void {
  pen.font = `700 11px ${FONT}`;
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  for (const { number, at: [x, y] } of numbersOf(coverage, view)) {
    pen.beginPath();
    pen.arc(x, y, 9, 0, 2 * Math.PI);
    pen.fillStyle = palette.halo;
    pen.fill();
    pen.lineWidth = 1.5;
    pen.strokeStyle = palette.seen;
    pen.stroke();
    text(pen, String(number), x, y + 0.5, palette.text, null);
  }
}
