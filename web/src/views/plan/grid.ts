// The snapping grid, as lines below the plan.

import type { Palette } from '../../plan/palette';
import type { Pen } from '../../plan/pen';
import { type Size, type View, toPlan, toScreen } from '../../plan/transform';
import type { Units } from '../../units';
import { gridOf } from './snap';

/** Multiples of the grid: 5 cm to 100 m, or 2 inches to 200 feet. */
const MULTIPLES: Record<Units, number[]> = { metric: [1, 2, 5, 10, 20, 100, 200, 1000, 2000], feet: [1, 3, 6, 30, 60, 300, 600, 1200] };
/** Smallest distance of lines in pixels; closer ones are a grey area (our choice). */
const NEAREST_PX = 9;
/** Smallest number of fine lines between two strong ones (our choice). */
const FEWEST_BETWEEN = 4;

/** The distances of lines at a scale, in metres: fine ones, and strong ones, which are fine ones as well. */
export function stepsOf(scale: number, units: Units): { fine_m: number; strong_m: number } {
  const all = MULTIPLES[units].map((times) => times * gridOf(units));
  const fine = all.findIndex((step_m) => step_m * scale >= NEAREST_PX);
  const fine_m = all[fine] ?? all.at(-1)!;
  const strong_m = all.find((step_m) => step_m >= fine_m * FEWEST_BETWEEN && isMultiple(step_m, fine_m)) ?? fine_m;
  return { fine_m, strong_m };
}

function isMultiple(of: number, one: number): boolean {
  return Math.abs(of / one - Math.round(of / one)) < 1e-6;
}

export function drawGrid(pen: Pen, view: View, size: Size, palette: Palette, units: Units): void {
  const { fine_m, strong_m } = stepsOf(view.scale, units);
  const [left, top] = toPlan(view, [0, 0]);
  const [right, bottom] = toPlan(view, [size.width, size.height]);
  pen.save();
  pen.strokeStyle = palette.quiet;
  pen.lineWidth = 1;
  for (const [step_m, alpha] of [[fine_m, 0.1], [strong_m, 0.17]] as const) {
    pen.globalAlpha = alpha;
    pen.beginPath();
    for (let line = Math.ceil(left / step_m); line * step_m <= right; line++) {
      const x = Math.round(toScreen(view, [line * step_m, 0])[0]) + 0.5;
      pen.moveTo(x, 0);
      pen.lineTo(x, size.height);
    }
    for (let line = Math.ceil(bottom / step_m); line * step_m <= top; line++) {
      const y = Math.round(toScreen(view, [0, line * step_m])[1]) + 0.5;
      pen.moveTo(0, y);
      pen.lineTo(size.width, y);
    }
    pen.stroke();
  }
  pen.restore();
}
