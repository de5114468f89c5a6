// The fields of cameras: their visible floor is shaded, and the floor hidden by furniture is hatched, so that colour is
// never alone.

import type { SensorView } from '../wire';
import { kindOf } from './kinds';
import type { Pen } from './pen';
import { type View, toScreen } from './transform';

/** Distance between lines of a hatch, in pixels. */
const HATCH = 7;

type Rectangle = [left: number, lower: number, right: number, upper: number];

export function drawCameraFloors(pen: Pen, sensors: readonly SensorView[], view: View): void {
  for (const { kind, camera } of sensors) {
    if (camera === null) continue;
    pen.strokeStyle = pen.fillStyle = kindOf(kind).colour;
    pen.globalAlpha = 0.2;
    pen.beginPath();
    for (const rectangle of camera.seen) add(pen, view, rectangle);
    pen.fill();
    pen.globalAlpha = 0.75;
    hatch(pen, view, camera.hidden);
    pen.globalAlpha = 1;
  }
}

/** Adds a rectangle to the path, and returns its position on the screen. */
function add(pen: Pen, view: View, [left, lower, right, upper]: Rectangle): Rectangle {
  const [x, bottom] = toScreen(view, [left, lower]);
  const [end, y] = toScreen(view, [right, upper]);
  pen.rect(x, y, end - x, bottom - y);
  return [x, y, end, bottom];
}

function hatch(pen: Pen, view: View, rectangles: readonly Rectangle[]): void {
  if (rectangles.length === 0) return;
  pen.save();
  pen.beginPath();
  let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const rectangle of rectangles) {
    const [x, y, end, low] = add(pen, view, rectangle);
    [left, top, right, bottom] = [Math.min(left, x), Math.min(top, y), Math.max(right, end), Math.max(bottom, low)];
  }
  pen.clip();
  pen.beginPath();
  for (let at = Math.floor((left + top) / HATCH) * HATCH; at <= right + bottom; at += HATCH) {
    pen.moveTo(at - top, top);
    pen.lineTo(at - bottom, bottom);
  }
  pen.lineWidth = 0.9;
  pen.stroke();
  pen.restore();
}
