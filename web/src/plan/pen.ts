// Strokes that still and moving parts share.

import type { At } from './geometry';
import { type Kind, OUTLINES } from './kinds';
import type { Palette } from './palette';
import { type View, toScreen } from './transform';

export type Pen = CanvasRenderingContext2D;

/** The strokes of charts, which SVG pictures support as well as a canvas. */
export type Ink = Pick<
  Pen,
  'fillRect' | 'fillText' | 'measureText' | 'beginPath' | 'moveTo' | 'lineTo' | 'closePath' | 'arc' | 'fill' | 'stroke' | 'globalAlpha' | 'fillStyle' | 'strokeStyle' | 'lineWidth' | 'lineJoin' | 'font' | 'textAlign' | 'textBaseline'
>;

/** Left, top, right, bottom on the screen. */
export type Box = [number, number, number, number];

export const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", sans-serif';

/** Pixels of the screen for each pixel of the page; more than two are invisible. */
export function pixelRatio(): number {
  return Math.min(window.devicePixelRatio, 2);
}

/** Clears a canvas and returns its context, in pixels of the page; null while it has no size. */
export function penOf(canvas: HTMLCanvasElement, width: number, height: number): Pen | null {
  const pen = canvas.getContext('2d');
  if (pen === null || width < 1) return null;
  const ratio = pixelRatio();
  const [wide, high] = [Math.round(width * ratio), Math.round(height * ratio)];
  // Setting the size clears a canvas and reallocates its memory.
  if (canvas.width !== wide || canvas.height !== high) [canvas.width, canvas.height] = [wide, high];
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  return pen;
}

export function trace(pen: Pen, view: View, outline: At[]): void {
  outline.forEach((point, index) => {
    const [x, y] = toScreen(view, point);
    if (index === 0) pen.moveTo(x, y);
    else pen.lineTo(x, y);
  });
  pen.closePath();
}

export function segments(pen: Pen, view: View, beams: [At, At][]): void {
  for (const [from, to] of beams) {
    const [ax, ay] = toScreen(view, from);
    const [bx, by] = toScreen(view, to);
    pen.moveTo(ax, ay);
    pen.lineTo(bx, by);
  }
}

/** A kind's sign around a point on the screen; `angle` is its direction, counter-clockwise from east. */
export function glyph(pen: Ink, kind: Kind, [x, y]: At, size: number, angle: number, palette: Palette): void {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  pen.beginPath();
  OUTLINES[kind.shape].forEach(([ahead, aside], index) => {
    const px = x + (ahead * cos - aside * sin) * size;
    const py = y - (ahead * sin + aside * cos) * size;
    if (index === 0) pen.moveTo(px, py);
    else pen.lineTo(px, py);
  });
  pen.closePath();
  pen.lineJoin = 'round';
  pen.lineWidth = 4.5;
  pen.strokeStyle = palette.halo;
  pen.stroke();
  pen.fillStyle = kind.colour;
  pen.fill();
  pen.lineWidth = 1.4;
  pen.strokeStyle = palette.outline;
  pen.stroke();
  if (kind.shape === 'ring') {
    pen.beginPath();
    pen.arc(x, y, size * 0.28, 0, 2 * Math.PI);
    pen.fillStyle = palette.outline;
    pen.fill();
  }
}

/** Text around a point, with a rim in the colour of its ground, so that lines below do not cross it. */
export function text(pen: Pen, words: string, x: number, y: number, colour: string, rim: string | null, width = 3.5): void {
  if (rim !== null) {
    pen.lineJoin = 'round';
    pen.lineWidth = width;
    pen.strokeStyle = rim;
    pen.strokeText(words, x, y);
  }
  pen.fillStyle = colour;
  pen.fillText(words, x, y);
}

export function capsule(pen: Pen, x: number, y: number, width: number, height: number): void {
  pen.beginPath();
  pen.roundRect(x, y, width, height, Math.min(width, height) / 2);
}
