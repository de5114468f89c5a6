// The symbol and the front of a piece of furniture, as strokes inside its outline. A file does not state the front: the
// back is the side at a wall, or else the back of the unturned piece.

import { type At, distance, middle, minus } from './geometry';
import type { Pen } from './pen';
import { type View, toScreen } from './transform';

/** Points from -1 to 1, with the back above: across, and from the front to the back. */
type Line = { points: At[]; closed?: true } | { centre: At; radius: number };

type Symbol = {
  /** The words of its names. */
  names: RegExp;
  /** The sides that can be its back: those as short as beds' heads, or as long as sofas' backs. */
  back: 'short' | 'long';
  lines: Line[];
  /** Whether people lie in it. */
  isLainIn?: true;
};

const box = (left: number, bottom: number, right: number, top: number): Line => ({ points: [[left, bottom], [right, bottom], [right, top], [left, top]], closed: true });
const line = (...points: At[]): Line => ({ points });
const circle = (x: number, y: number, radius: number): Line => ({ centre: [x, y], radius });

const SYMBOLS: Symbol[] = [
  { names: /double bed/, back: 'short', lines: [box(-0.85, 0.6, -0.08, 0.9), box(0.08, 0.6, 0.85, 0.9), line([-1, 0.4], [1, 0.4])], isLainIn: true },
  { names: /\bbed\b/, back: 'short', lines: [box(-0.7, 0.6, 0.7, 0.9), line([-1, 0.4], [1, 0.4])], isLainIn: true },
  { names: /sofa|couch|settee|armchair|recliner|easy chair/, back: 'long', lines: [line([-1, 0.55], [1, 0.55]), line([-0.75, -1], [-0.75, 0.55]), line([0.75, -1], [0.75, 0.55])], isLainIn: true },
  { names: /chair|stool|bench/, back: 'long', lines: [line([-0.8, 0.7], [0.8, 0.7])] },
  { names: /toilet|\bwc\b/, back: 'short', lines: [line([-1, 0.5], [1, 0.5]), circle(0, -0.25, 0.62)] },
  { names: /bath ?tub|\bbath\b/, back: 'short', lines: [box(-0.82, -0.86, 0.82, 0.86), circle(0, 0.7, 0.06)] },
  { names: /shower/, back: 'long', lines: [line([-1, -1], [1, 1]), line([-1, 1], [1, -1])] },
  { names: /stove|cooker|\bhob\b|oven/, back: 'long', lines: [circle(-0.42, 0.42, 0.26), circle(0.42, 0.42, 0.26), circle(-0.42, -0.36, 0.26), circle(0.42, -0.36, 0.26), line([-0.8, -0.84], [0.8, -0.84])] },
  { names: /sink|basin/, back: 'long', lines: [box(-0.7, -0.7, 0.7, 0.5), circle(0, 0.72, 0.09)] },
  { names: /fridge|freezer|refrigerator|dishwasher/, back: 'long', lines: [line([-1, -0.8], [1, -0.8]), line([0.55, -0.92], [0.85, -0.92])] },
  { names: /washing machine|washer|dryer/, back: 'long', lines: [circle(0, 0.05, 0.6), line([-1, -0.8], [1, -0.8])] },
  { names: /wardrobe|cupboard|dresser|drawers|cabinet|closet|nightstand|counter/, back: 'long', lines: [line([-1, -0.8], [1, -0.8]), line([0, -1], [0, -0.8])] },
  { names: /bookcase|bookshelf|shelf|shelves/, back: 'long', lines: [line([-0.33, -1], [-0.33, 1]), line([0.33, -1], [0.33, 1])] },
  { names: /\btv\b|television/, back: 'long', lines: [box(-0.7, 0.25, 0.7, 0.45)] },
  { names: /desk/, back: 'long', lines: [box(-0.3, 0.3, 0.3, 0.6)] },
];

/** Largest distance of a side at a wall from the wall's face (our choice). */
const AT_WALL_M = 0.15;
/** Ratio of the sides of a long piece (our choice): any side of other pieces can be the back. */
const LONG = 1.15;

/** A rectangle's own axes: half of its width to the right and half of its depth to the back, from its middle. */
export type Frame = { at: At; right: At; back: At };

function symbolOf(name: string): Symbol | undefined {
  const lower = name.toLowerCase();
  return SYMBOLS.find(({ names }) => names.test(lower));
}

/** The possible back of a piece with a name. */
export function backOf(name: string): 'short' | 'long' {
  return symbolOf(name)?.back ?? 'long';
}

/** The axes of a piece with four corners; null for other outlines. */
export function frameOf(name: string, outline: At[], walls: At[][]): Frame | null {
  if (outline.length !== 4) return null;
  const [a, b, c, d] = outline as [At, At, At, At];
  if (Math.abs(distance(a, c) - distance(b, d)) > 0.01) return null;
  const at = middle([a, c]);
  const half = (from: At, to: At): At => [(to[0] - from[0]) / 2, (to[1] - from[1]) / 2];
  const [width, depth] = [half(a, b), half(b, c)];
  const opposite = ([x, y]: At): At => [-x, -y];
  // Each side by the way to it from the middle; the back of an unturned piece is above.
  const ways: { to: At; along: number }[] = [depth, opposite(depth), opposite(width), width].map((to, index) => ({ to, along: Math.hypot(...(index < 2 ? width : depth)) }));
  const [least, most] = [Math.min(...ways.map(({ along }) => along)), Math.max(...ways.map(({ along }) => along))];
  const short = backOf(name) === 'short';
  const proper = ways.filter(({ along }) => most < least * LONG || (short ? along === least : along === most));
  const far = ({ to }: { to: At }) => Math.min(...walls.map((wall) => distanceTo(wall, [at[0] + to[0], at[1] + to[1]])), Infinity);
  const atWall = proper.map((way) => ({ way, far_m: far(way) })).filter(({ far_m }) => far_m <= AT_WALL_M);
  const nearest = atWall.sort((one, other) => one.far_m - other.far_m)[0]?.way;
  const back = (nearest ?? proper[0]!).to;
  // Right as seen toward the back.
  const turned: At = [back[1], -back[0]];
  const wide = Math.abs(turned[0] * width[0] + turned[1] * width[1]) > Math.abs(turned[0] * depth[0] + turned[1] * depth[1]) ? width : depth;
  const right = wide[0] * turned[0] + wide[1] * turned[1] < 0 ? opposite(wide) : wide;
  return { at, right, back };
}

/**
 * The ways from its middle to the heads of people who lie in a piece: at its back, where beds have their pillows, or at
 * either end of one that is wider than deep, as sofas are. Empty for other pieces.
 */
export function headsOf(name: string, { right, back }: Frame): At[] {
  if (symbolOf(name)?.isLainIn === undefined) return [];
  return Math.hypot(...right) < Math.hypot(...back) * LONG ? [back] : [right, [-right[0], -right[1]]];
}

/** The distance of a point from the sides of an outline. */
function distanceTo(outline: At[], at: At): number {
  return Math.min(...outline.map((from, index) => toLine(at, from, outline[(index + 1) % outline.length]!)));
}

function toLine(at: At, from: At, to: At): number {
  const [way, off] = [minus(to, from), minus(at, from)];
  const share = (way[0] * off[0] + way[1] * off[1]) / (way[0] ** 2 + way[1] ** 2 || 1);
  const held = Math.min(Math.max(share, 0), 1);
  return distance(at, [from[0] + way[0] * held, from[1] + way[1] * held]);
}

/** The strokes of a piece, in metres; a small arrow at the front of a piece without a symbol. */
export function strokesOf(name: string, frame: Frame): { points: At[]; closed: boolean }[] {
  const place = ([across, back]: At): At => [
    frame.at[0] + frame.right[0] * across + frame.back[0] * back,
    frame.at[1] + frame.right[1] * across + frame.back[1] * back,
  ];
  const symbol = symbolOf(name);
  if (symbol === undefined) return [];
  return symbol.lines.map((one) => {
    if ('points' in one) return { points: one.points.map(place), closed: one.closed === true };
    // A circle stays round in a piece that is longer than wide.
    const [wide, deep] = [Math.hypot(...frame.right), Math.hypot(...frame.back)];
    const radius = one.radius * Math.min(wide, deep);
    const points = Array.from({ length: 20 }, (_, index): At => {
      const angle = (index / 20) * 2 * Math.PI;
      return place([one.centre[0] + (Math.cos(angle) * radius) / wide, one.centre[1] + (Math.sin(angle) * radius) / deep]);
    });
    return { points, closed: true };
  });
}

/** The front of a piece: a small arrow that stands out of it, in metres. */
export function frontOf({ at, right, back }: Frame): At[] {
  const [wide, deep] = [Math.hypot(...right) || 1, Math.hypot(...back) || 1];
  const unit = (to: At, by: number, size: number): At => [(to[0] / size) * by, (to[1] / size) * by];
  const [tip, foot] = [unit(back, -(deep + 0.14), deep), unit(back, -(deep + 0.03), deep)];
  const aside = unit(right, 0.09, wide);
  return [[at[0] + tip[0], at[1] + tip[1]], [at[0] + foot[0] + aside[0], at[1] + foot[1] + aside[1]], [at[0] + foot[0] - aside[0], at[1] + foot[1] - aside[1]]];
}

export function drawSymbol(pen: Pen, view: View, name: string, frame: Frame): void {
  pen.beginPath();
  for (const { points, closed } of strokesOf(name, frame)) {
    points.forEach((point, index) => {
      const [x, y] = toScreen(view, point);
      if (index === 0) pen.moveTo(x, y);
      else pen.lineTo(x, y);
    });
    if (closed) pen.closePath();
  }
  pen.stroke();
}
