// The time line: a lane for each sensor, the last ten minutes from left to right, a tick where it fired.

import { type Firings, LANE_US } from '../../firings';
import { kindOf } from '../../plan/kinds';
import type { Palette } from '../../plan/palette';
import { FONT, glyph, penOf } from '../../plan/pen';
import { fitting, isolated } from '../../plan/words';
import type { SensorView } from '../../wire';

/** The height of a lane in pixels. */
export const LANE = 17;

const AXIS = 18;

/** Where a firing's tick is, in pixels from the left; nothing for what is too old. */
export function tickAt(at_us: number, now_us: number, left: number, right: number): number | null {
  const ago = now_us - at_us;
  return ago < 0 || ago > LANE_US ? null : right - (ago / LANE_US) * (right - left);
}

export function drawStrip(canvas: HTMLCanvasElement, width: number, sensors: SensorView[], firings: Firings, palette: Palette): void {
  const height = sensors.length * LANE + AXIS;
  const pen = penOf(canvas, width, height);
  if (pen === null) return;
  const [left, right] = [Math.min(190, width * 0.32), width - 14];
  axis(pen, left, right, height, palette);
  sensors.forEach((sensor, index) => {
    const middle = AXIS + index * LANE + LANE / 2;
    pen.fillStyle = palette.furnitureEdge;
    pen.globalAlpha = 0.35;
    pen.fillRect(left, middle, right - left, 1);
    pen.globalAlpha = 1;
    const kind = kindOf(sensor.kind);
    glyph(pen, kind, [14, middle], 5, 0, palette);
    pen.font = `12px ${FONT}`;
    pen.textAlign = 'left';
    pen.textBaseline = 'middle';
    pen.fillStyle = palette.text;
    const name = fitting(sensor.name, left - 34, (text) => pen.measureText(text).width);
    if (name !== null) pen.fillText(isolated(name), 26, middle + 0.5);
    pen.fillStyle = palette.text;
    let last = -Infinity;
    for (const at of firings.lanes[index] ?? []) {
      const x = tickAt(at, firings.now_us, left, right);
      // Ticks nearer than half a pixel are one.
      if (x === null || x - last < 0.5) continue;
      last = x;
      pen.fillRect(x - 0.75, middle - 5.5, 1.5, 11);
    }
  });
}

function axis(pen: CanvasRenderingContext2D, left: number, right: number, height: number, palette: Palette): void {
  pen.font = `11px ${FONT}`;
  pen.textBaseline = 'middle';
  for (let minutes = 0; minutes <= 10; minutes += 2) {
    const x = right - (minutes / 10) * (right - left);
    pen.globalAlpha = 0.3;
    pen.fillStyle = palette.furnitureEdge;
    pen.fillRect(x, AXIS - 3, 1, height - AXIS + 3);
    pen.globalAlpha = 1;
    pen.fillStyle = palette.quiet;
    pen.textAlign = minutes === 0 ? 'right' : 'center';
    pen.fillText(minutes === 0 ? 'now' : `-${minutes} min`, minutes === 0 ? x + 8 : x, AXIS / 2);
  }
}
