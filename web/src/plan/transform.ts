// The map from metres on the plan, y up, to CSS pixels on the screen, y down, and back.

import type { At } from './geometry';

/** The position of the plan on the screen: pixels a metre, and the plan's origin. */
export type View = { scale: number; x: number; y: number };

export type Size = { width: number; height: number };

export type Bounds = [At, At];

/** At a larger scale a shoe fills the screen; at a smaller one a house is a dot. */
const NEAREST = 600;
const FARTHEST = 4;

/** Free space at the edges, in pixels. */
export type Insets = { left: number; top: number; right: number; bottom: number };

/** The view with all of `bounds`, in the middle of the space between the insets. */
export function fit(bounds: Bounds, size: Size, insets: Insets): View {
  const [[left, bottom], [right, top]] = bounds;
  const wide = Math.max(right - left, 0.1);
  const high = Math.max(top - bottom, 0.1);
  const room = { width: Math.max(size.width - insets.left - insets.right, 1), height: Math.max(size.height - insets.top - insets.bottom, 1) };
  const scale = Math.min(room.width / wide, room.height / high);
  return {
    scale,
    x: insets.left + room.width / 2 - ((left + right) / 2) * scale,
    y: insets.top + room.height / 2 + ((bottom + top) / 2) * scale,
  };
}

/** Of several insets, those with the largest plan. */
export function fitBest(bounds: Bounds, size: Size, ways: Insets[]): View {
  const views = ways.map((insets) => fit(bounds, size, insets));
  return views.reduce((best, view) => (view.scale > best.scale ? view : best));
}

export function toScreen(view: View, [x, y]: At): At {
  return [view.x + x * view.scale, view.y - y * view.scale];
}

export function toPlan(view: View, [x, y]: At): At {
  return [(x - view.x) / view.scale, (view.y - y) / view.scale];
}

/** Zooms by `factor`; the point under `at` stays there. */
export function zoom(view: View, factor: number, at: At): View {
  const scale = Math.min(Math.max(view.scale * factor, FARTHEST), NEAREST);
  const by = scale / view.scale;
  return { scale, x: at[0] - (at[0] - view.x) * by, y: at[1] - (at[1] - view.y) * by };
}

export function pan(view: View, dx: number, dy: number): View {
  return { scale: view.scale, x: view.x + dx, y: view.y + dy };
}
