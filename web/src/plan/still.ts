// The still parts of a plan: furniture, walls, sensors with their beams and areas, and all names. They are drawn once
// and copied into each frame; the floor changes with the sun and the lamps, and is not among them.

import type { HomeView, SensorView } from '../wire';
import { drawCameraFloors } from './cameras';
import { drawFloorNames, drawFrames } from './floors';
import { type At, box, facing, middle } from './geometry';
import { kindOf } from './kinds';
import type { Layers } from './layers';
import type { Palette } from './palette';
import { type Box, FONT, type Pen, glyph, segments, text, trace } from './pen';
import { drawSymbol, frameOf } from './symbols';
import { type Size, type View, toScreen } from './transform';
import { fitting, isolated, shortened } from './words';

export const GLYPH = 6.5;

/** Pixels a metre below which signs of furniture are blots, and names of sensors hide the home (our choice). */
const LEAST_SYMBOL = 22;
const LEAST_SENSOR_NAME = 20;

export function drawStill(pen: Pen, home: HomeView, view: View, layers: Layers, palette: Palette): void {
  drawFrames(pen, home, view, palette);
  if (layers.cameras) drawCameraFloors(pen, home.sensors, view);
  furniture(pen, home, view, palette);
  if (layers.areas) areas(pen, home.sensors, view, palette);
  if (layers.beams) beams(pen, home.sensors, view, palette);
  walls(pen, home, view, palette);
}

/**
 * Glyphs and names. None overlaps another: those without a place are omitted.
 * @param marks later drawings, which they avoid.
 */
export function drawNames(pen: Pen, home: HomeView, view: View, layers: Layers, palette: Palette, size: Size, marks: Box[] = []): void {
  const taken: Box[] = [...marks];
  drawFloorNames(pen, home, view, palette, taken);
  sensors(pen, home.sensors, view, palette, taken);
  roomNames(pen, home, view, palette, taken);
  if (layers.furnitureNames) furnitureNames(pen, home, view, palette, taken);
  if (layers.sensorNames && view.scale >= LEAST_SENSOR_NAME) sensorNames(pen, home.sensors, view, palette, taken, size);
}

function furniture(pen: Pen, home: HomeView, view: View, palette: Palette): void {
  const walls = home.solids.filter(({ kind }) => kind === 'wall').map(({ outline }) => outline);
  for (const solid of home.solids) {
    if (solid.kind !== 'furniture') continue;
    pen.beginPath();
    trace(pen, view, solid.outline);
    // The floor shines through, so that furniture, too, is darker at night.
    pen.globalAlpha = 0.6;
    pen.fillStyle = solid.enterable ? palette.soft : palette.furniture;
    pen.fill();
    pen.globalAlpha = 1;
    pen.lineWidth = 1.1;
    pen.strokeStyle = palette.furnitureEdge;
    pen.setLineDash(solid.enterable ? [5, 3] : []);
    pen.stroke();
    const frame = solid.name === null ? null : frameOf(solid.name, solid.outline, walls);
    if (frame === null || view.scale < LEAST_SYMBOL) continue;
    pen.setLineDash([]);
    pen.lineWidth = 0.9;
    pen.globalAlpha = 0.7;
    drawSymbol(pen, view, solid.name!, frame);
    pen.globalAlpha = 1;
  }
  pen.setLineDash([]);
}

function areas(pen: Pen, sensors: SensorView[], view: View, palette: Palette): void {
  pen.beginPath();
  for (const sensor of sensors) if (sensor.area) trace(pen, view, sensor.area);
  pen.globalAlpha = 0.07;
  pen.fillStyle = palette.area;
  pen.fill();
  pen.globalAlpha = 0.75;
  pen.strokeStyle = palette.area;
  pen.lineWidth = 1.2;
  pen.setLineDash([6, 4]);
  pen.stroke();
  pen.setLineDash([]);
  pen.globalAlpha = 1;
}

function beams(pen: Pen, sensors: SensorView[], view: View, palette: Palette): void {
  pen.strokeStyle = palette.beam;
  pen.lineWidth = 0.8;
  // The more there are, the fainter is each, so that the plan remains readable.
  pen.globalAlpha = Math.min(0.22, 3 / Math.max(sensors.length, 1));
  for (const sensor of sensors) {
    pen.beginPath();
    segments(pen, view, sensor.beams);
    pen.stroke();
  }
  pen.globalAlpha = 1;
}

function walls(pen: Pen, home: HomeView, view: View, palette: Palette): void {
  pen.beginPath();
  for (const solid of home.solids) if (solid.kind === 'wall') trace(pen, view, solid.outline);
  pen.fillStyle = palette.wall;
  pen.fill();
  // Without it, walls that meet leave a hairline between them.
  pen.lineWidth = 0.6;
  pen.strokeStyle = palette.wall;
  pen.stroke();
}

function sensors(pen: Pen, sensors: SensorView[], view: View, palette: Palette, taken: Box[]): void {
  for (const sensor of sensors) {
    const [x, y] = place(sensor, view);
    glyph(pen, kindOf(sensor.kind), [x, y], GLYPH, facing(sensor), palette);
    taken.push([x - GLYPH, y - GLYPH, x + GLYPH, y + GLYPH]);
  }
}

export function place(sensor: SensorView, view: View): At {
  return toScreen(view, sensor.at);
}

function roomNames(pen: Pen, home: HomeView, view: View, palette: Palette, taken: Box[]): void {
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  for (const room of home.rooms) {
    const [left, bottom, right, top] = box(room.outline);
    const size = Math.min(Math.max(view.scale * 0.24, 11), 17);
    pen.font = `600 ${size}px ${FONT}`;
    const words = fitting(room.name, (right - left) * view.scale - 8, (t) => pen.measureText(t).width);
    if (words === null || (top - bottom) * view.scale < size * 1.5) continue;
    const [x, y] = toScreen(view, room.middle);
    const half = pen.measureText(words).width / 2 + 2;
    const free = [0, -1.5, 1.5, -3, 3].map((lines) => y + lines * size).find((at) => isFree([x - half, at - size / 2, x + half, at + size / 2], taken)) ?? y;
    text(pen, isolated(words), x, free, palette.text, palette.halo);
    taken.push([x - half, free - size / 2, x + half, free + size / 2]);
  }
}

function furnitureNames(pen: Pen, home: HomeView, view: View, palette: Palette, taken: Box[]): void {
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  const size = Math.min(Math.max(view.scale * 0.16, 9.5), 12.5);
  pen.font = `${size}px ${FONT}`;
  const measure = (t: string) => pen.measureText(t).width;
  for (const solid of home.solids) {
    if (solid.kind !== 'furniture' || solid.name === null) continue;
    const [left, bottom, right, top] = box(solid.outline);
    const [wide, high] = [(right - left) * view.scale - 5, (top - bottom) * view.scale - 5];
    const upright = high > wide * 1.3 && measure(shortened(solid.name, 48)) > wide;
    const lines = broken(solid.name, upright ? high : wide, Math.floor((upright ? wide : high) / (size * 1.15)), measure);
    if (lines.length === 0) continue;
    const [x, y] = toScreen(view, middle(solid.outline));
    const half = Math.max(...lines.map(measure)) / 2;
    const tall = (lines.length * size * 1.15) / 2;
    const space: Box = upright ? [x - tall, y - half, x + tall, y + half] : [x - half, y - tall, x + half, y + tall];
    if (!isFree(space, taken)) continue;
    taken.push(space);
    pen.save();
    pen.translate(x, y);
    if (upright) pen.rotate(-Math.PI / 2);
    lines.forEach((line, index) => {
      const down = (index - (lines.length - 1) / 2) * size * 1.15;
      text(pen, isolated(line), 0, down, palette.quiet, solid.enterable ? palette.soft : palette.furniture, 2.5);
    });
    pen.restore();
  }
}

/** A name on one line, or on two if it has two words; empty if hardly anything of it would remain. */
function broken(name: string, width: number, lines: number, measure: (text: string) => number): string[] {
  const whole = shortened(name, 32);
  if (lines < 1) return [];
  if (measure(whole) <= width) return [whole];
  const gap = whole.indexOf(' ', Math.floor(whole.length / 3));
  if (lines >= 2 && gap > 0) {
    const two = [whole.slice(0, gap), whole.slice(gap + 1)];
    if (two.every((line) => measure(line) <= width)) return two;
  }
  const cut = fitting(name, width, measure);
  return cut !== null && cut.length >= 5 ? [cut] : [];
}

function sensorNames(pen: Pen, sensors: SensorView[], view: View, palette: Palette, taken: Box[], size: Size): void {
  pen.textAlign = 'left';
  pen.textBaseline = 'middle';
  pen.font = `10.5px ${FONT}`;
  for (const sensor of sensors) {
    const [x, y] = place(sensor, view);
    const words = shortened(sensor.name, 28);
    const width = pen.measureText(words).width;
    const [right, left]: At[] = [[x + 11, y], [x - 11 - width, y]];
    const looksLeft = Math.cos(facing(sensor)) < -0.1;
    const spots: At[] = [looksLeft ? left! : right!, looksLeft ? right! : left!, [x - width / 2, y + 15], [x - width / 2, y - 15], [x + 9, y + 13], [x + 9, y - 13], [x - 9 - width, y + 13], [x - 9 - width, y - 13]];
    const spot = spots.find(([left, at]) => left > 2 && left + width < size.width - 2 && at > 9 && at < size.height - 9 && isFree([left, at - 7, left + width, at + 7], taken));
    if (spot === undefined) continue;
    taken.push([spot[0], spot[1] - 7, spot[0] + width, spot[1] + 7]);
    text(pen, isolated(words), spot[0], spot[1], palette.sensor, palette.halo, 3);
  }
}

function isFree([left, top, right, bottom]: Box, taken: Box[]): boolean {
  return taken.every(([l, t, r, b]) => right < l || left > r || bottom < t || top > b);
}
