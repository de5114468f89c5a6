// Kinds of sensors: each has a shape, a colour and a word, so that none of these is needed alone.

import { okabeIto } from './palette';
import { SENSOR_KINDS } from '../sensors';
import type { At } from './geometry';
import { spoken } from './words';

export type Kind = { word: string; shape: Shape; colour: string };

type Row = (typeof SENSOR_KINDS)[keyof typeof SENSOR_KINDS];
type Shape = Row['shape'] | 'square';

/** The core's row of a kind; null for a kind that this page does not know. */
export function rowOf(kind: string): Row | null {
  return Object.hasOwn(SENSOR_KINDS, kind) ? SENSOR_KINDS[kind as keyof typeof SENSOR_KINDS] : null;
}

/** The mount of a kind; null for a kind that this page does not know. */
export function mountOf(kind: unknown): Row['mount'] | null {
  return typeof kind === 'string' ? (rowOf(kind)?.mount ?? null) : null;
}

/** Whether a kind looks for movement. */
export function sensesMotion(kind: unknown): boolean {
  const mount = mountOf(kind);
  return mount === 'wall' || mount === 'ceiling';
}

/** A kind that this page does not know is a grey square with its own name. */
export function kindOf(kind: string): Kind {
  const row = rowOf(kind);
  return row ? { word: row.label, shape: row.shape, colour: okabeIto[row.colour] } : { word: spoken(kind), shape: 'square', colour: '#8a949f' };
}

/** Outlines in a square from -1 to 1, x to the front, y to the left: canvas and SVG draw the same. */
export const OUTLINES: Record<Shape, At[]> = {
  arrow: [[1.15, 0], [-0.85, 0.85], [-0.4, 0], [-0.85, -0.85]],
  ring: circle(0.8, 20),
  pill: [[-1, 0.35], [-0.8, 0.6], [0.8, 0.6], [1, 0.35], [1, -0.35], [0.8, -0.6], [-0.8, -0.6], [-1, -0.35]],
  gap: [[-1, 0.7], [-0.2, 0.7], [-0.2, 0.15], [0.2, 0.15], [0.2, 0.7], [1, 0.7], [1, -0.7], [0.2, -0.7], [0.2, -0.15], [-0.2, -0.15], [-0.2, -0.7], [-1, -0.7]],
  hexagon: circle(0.95, 6),
  bolt: [[0.25, 1.05], [-0.75, -0.15], [-0.1, -0.15], [-0.25, -1.05], [0.75, 0.2], [0.1, 0.2]],
  flame: [[0, 1.1], [0.4, 0.45], [0.8, 0], [0.75, -0.55], [0.35, -0.9], [-0.35, -0.9], [-0.75, -0.55], [-0.8, 0], [-0.35, 0.2]],
  drop: [[0, 1.1], [0.4, 0.4], [0.65, -0.05], [0.65, -0.45], [0.35, -0.8], [0, -0.9], [-0.35, -0.8], [-0.65, -0.45], [-0.65, -0.05], [-0.4, 0.4]],
  star: star(8, 1.05, 0.6),
  cross: [[-0.3, 0.95], [0.3, 0.95], [0.3, 0.3], [0.95, 0.3], [0.95, -0.3], [0.3, -0.3], [0.3, -0.95], [-0.3, -0.95], [-0.3, -0.3], [-0.95, -0.3], [-0.95, 0.3], [-0.3, 0.3]],
  eye: [[1.1, 0.55], [0.45, 0.25], [0.45, 0.6], [-1, 0.6], [-1, -0.6], [0.45, -0.6], [0.45, -0.25], [1.1, -0.55]],
  square: [[-0.7, 0.7], [0.7, 0.7], [0.7, -0.7], [-0.7, -0.7]],
};

function circle(radius: number, corners: number): At[] {
  return Array.from({ length: corners }, (_, index) => {
    const angle = (index / corners) * 2 * Math.PI;
    return [Math.cos(angle) * radius, Math.sin(angle) * radius];
  });
}

function star(points: number, far: number, near: number): At[] {
  return Array.from({ length: 2 * points }, (_, index) => {
    const angle = (index / (2 * points)) * 2 * Math.PI;
    const radius = index % 2 === 0 ? far : near;
    return [Math.cos(angle) * radius, Math.sin(angle) * radius];
  });
}
