// Clicks and previews of each tool.

import { type At, distance, inside, middle, minus } from '../../plan/geometry';
import { backOf, frameOf, frontOf } from '../../plan/symbols';
import type { Editor, Tool } from './editor.svelte';
import { enclosed } from './enclosed';
import { AREA_M, DOOR_WIDTH_M, FARTHEST_PUT_UP_M, type Mount, type Piece, SENSORS, freshName, newPiece, newSensor } from './library';
import { type Home, formOf, of, titleOf, wallsOf } from './model';
import { add, angleOf, area, direction, exact, times, toSegment, turnedBox } from './shape';
import { type Guides, type Snapping, flush, mount, snapPoint, snapShift, spanAt, targetsOf } from './snap';

/** Lower pieces are walked over. */
const LOW_M = 0.1;

const PROMPTS: Record<Tool['tool'], string> = {
  select: '',
  wall: 'Click where the wall starts, then where it ends, or type a length and press an arrow key. The next wall starts there. Escape ends.',
  room: 'Click the corners of the room in order, or type lengths and press arrow keys. Enter, or a click on the first corner, closes the room.',
  fill: 'Click a space enclosed by walls to make it a room. Click again for the next room. Escape ends.',
  door: 'Click the wall where the door goes.',
  place: 'Click where people stand.',
  furniture: 'Click where it stands.',
  sensor: '',
  scale: 'Click two points of the image with a known distance.',
};

const MOUNTS: Record<Mount, string> = {
  wall: 'Click near a wall. The sensor is mounted there and faces the room.',
  ceiling: 'Click the middle of the area that the sensor sees from the ceiling.',
  thing: 'Click the element that carries the sensor.',
  room: 'Click the room that the sensor measures.',
  free: 'Click near a wall. The camera is mounted there and faces the room. Without Snap it is mounted where you click.',
};

export function promptOf({ tool, drawn }: Pick<Editor, 'tool' | 'drawn'>): string {
  if (tool.tool === 'scale' && drawn.length === 2) return 'Type the real distance of the two points under Image.';
  return tool.tool === 'sensor' ? MOUNTS[SENSORS[tool.kind]] : PROMPTS[tool.tool];
}

/** A preview of a click. */
export type Preview = { forms: At[][]; line: At[]; at: At; guides: Guides };

/** The point of a click at `at` after snapping. */
function meant(home: Home, drawn: At[], at: At, snapping: Snapping | null): { at: At; guides: Guides } {
  if (!snapping) return { at: exact(at), guides: {} };
  const { ends, xs, ys, ...others } = targetsOf(home, new Set());
  // Straight on from the last corner, and closing at the start.
  const last = drawn.slice(-1);
  const more = { ends: [...ends, ...drawn.slice(0, 1)], xs: [...xs, ...last.map(([x]) => x)], ys: [...ys, ...last.map(([, y]) => y)] };
  return snapPoint(at, { ...others, ...more }, snapping);
}

export function preview(editor: Editor, home: Home, at: At, snapping: Snapping | null): Preview {
  const { tool, drawn } = editor;
  const grid = snapping?.grid_m ?? null;
  const point = meant(home, drawn, at, snapping);
  const none: Preview = { forms: [], line: [], at, guides: {} };
  switch (tool.tool) {
    case 'wall':
    case 'room':
      return { ...none, ...point, line: [...drawn, point.at] };
    case 'scale':
      return { ...none, line: drawn.length === 1 ? [...drawn, at] : drawn };
    case 'place':
      return { ...none, ...point };
    case 'fill': {
      const outline = enclosed(wallsOf(home), at);
      return { ...none, forms: outline ? [outline] : [] };
    }
    case 'door': {
      const span = spanAt(at, wallsOf(home), DOOR_WIDTH_M, grid);
      return span ? { ...none, line: [span.from, span.to], at: middle([span.from, span.to]) } : none;
    }
    case 'furniture': {
      const put = stand(home, tool.piece, at, snapping);
      const outline = turnedBox(put.at, tool.piece.size_m, put.turn_deg);
      const frame = frameOf(tool.piece.name, outline, wallsOf(home).flatMap(({ element }) => [formOf(element) ?? []]));
      return { forms: frame ? [outline, frontOf(frame)] : [outline], line: [], at: put.at, guides: put.guides };
    }
    case 'sensor': {
      if (SENSORS[tool.kind] === 'ceiling') {
        const { shift, guides } = settle(home, [AREA_M, AREA_M], at, snapping);
        return { forms: [turnedBox(add(at, shift), [AREA_M, AREA_M], 0)], line: [], at: add(at, shift), guides };
      }
      const isMounted = SENSORS[tool.kind] === 'wall' || (SENSORS[tool.kind] === 'free' && snapping !== null);
      const mounted = isMounted ? mount(at, targetsOf(home, new Set()), grid, FARTHEST_PUT_UP_M) : null;
      return mounted ? { ...none, at: mounted.at, line: [mounted.at, add(mounted.at, times(direction(mounted.normal_deg), 0.6))] } : none;
    }
    case 'select':
      return none;
  }
}

/** Places a piece: with its back at a near wall. */
function stand(home: Home, { name, size_m, height_m }: Piece, at: At, snapping: Snapping | null): { at: At; turn_deg: number; guides: Guides } {
  // Flat pieces lie anywhere.
  const put = snapping && height_m > LOW_M ? flush(at, size_m, backOf(name), targetsOf(home, new Set()), snapping) : null;
  if (put) return { ...put, guides: {} };
  const { shift, guides } = settle(home, size_m, at, snapping);
  return { at: add(at, shift), turn_deg: 0, guides };
}

/** Snaps an area to the faces of walls, or to the grid. */
function settle(home: Home, size: At, at: At, snapping: Snapping | null): { shift: At; guides: Guides } {
  if (!snapping) return { shift: [0, 0], guides: {} };
  return snapShift([0, 0], [at, ...turnedBox(at, size, 0)], targetsOf(home, new Set()).faces, snapping);
}

export function click(editor: Editor, home: Home, at: At, snapping: Snapping | null): void {
  const { tool, drawn } = editor;
  const grid = snapping?.grid_m ?? null;
  editor.said = '';
  switch (tool.tool) {
    case 'wall': {
      const to = meant(home, drawn, at, snapping).at;
      const from = drawn.at(-1);
      if (from && distance(from, to) < 0.01) return finish(editor, home);
      if (from) editor.add('walls', { from, to });
      editor.drawn = [to];
      // A chain ends at an existing wall.
      if (from && wallsOf(home).some((wall) => toSegment(to, wall.from, wall.to) < 0.002)) finish(editor, home);
      return;
    }
    case 'room': {
      const to = meant(home, drawn, at, snapping).at;
      if (drawn.length > 2 && distance(drawn[0]!, to) < Math.max(snapping?.tolerance_m ?? 0, 0.02)) return finish(editor, home);
      if (!drawn.some((corner) => distance(corner, to) < 0.001)) editor.drawn = [...drawn, to];
      return;
    }
    case 'scale':
      editor.drawn = drawn.length >= 2 ? [at] : [...drawn, at];
      return;
    case 'fill': {
      const outline = enclosed(wallsOf(home), at);
      if (outline === null) {
        editor.said = 'No walls enclose this spot. Close the gap between the walls, or draw the room corner by corner.';
        return;
      }
      const there = of(home, 'rooms').find((room) => isSame(formOf(room) ?? [], outline, at));
      if (there) {
        editor.select([there.id]);
        editor.said = `This space is already ${titleOf(there).slice(0, 80)}.`;
      } else editor.add('rooms', { name: freshName(home, 'room'), outline });
      // A plan has several rooms: with the arrow the next click would select nothing, and the next name would be the
      // home's.
      return;
    }
    case 'door': {
      const span = spanAt(at, wallsOf(home), DOOR_WIDTH_M, grid);
      if (span === null) {
        editor.said = 'A door needs a wall. Draw the wall first.';
        return;
      }
      editor.add('doors', { name: freshName(home, 'door'), ...span, ...(leadsOut(home, span) ? { open: false, outside: true } : {}) });
      return release(editor);
    }
    case 'place':
      editor.add('places', { name: freshName(home, 'place'), at: meant(home, drawn, at, snapping).at });
      return release(editor);
    case 'furniture': {
      const put = stand(home, tool.piece, at, snapping);
      editor.add('furniture', newPiece(home, tool.piece, put.at, put.turn_deg));
      return release(editor);
    }
    case 'sensor': {
      const to = SENSORS[tool.kind] === 'ceiling' ? add(at, settle(home, [AREA_M, AREA_M], at, snapping).shift) : at;
      const value = newSensor(home, tool.kind, to, targetsOf(home, new Set()), grid, tool.device);
      if (typeof value === 'string') {
        editor.said = value;
        return;
      }
      editor.add('sensors', value);
      return release(editor);
    }
    case 'select':
      return;
  }
}

/** Finishes the drawing: closes a room, ends a chain of walls. */
export function finish(editor: Editor, home: Home): void {
  const { tool, drawn } = editor;
  if (tool.tool === 'room') {
    if (drawn.length < 3 || Math.abs(area(drawn)) < 0.01) {
      editor.said = 'A room needs at least three corners.';
      return;
    }
    editor.add('rooms', { name: freshName(home, 'room'), outline: drawn });
    release(editor);
  }
  if (tool.tool === 'wall') editor.drawn = [];
}

/** Back to the arrow; the new elements stay selected. */
function release(editor: Editor): void {
  editor.tool = { tool: 'select' };
  editor.drawn = [];
}

/** A room has this outline already, whatever its first corner. */
function isSame(room: At[], outline: At[], at: At): boolean {
  return inside(room, at) && Math.abs(Math.abs(area(room)) - Math.abs(area(outline))) < 0.01;
}

/** A room is on one side of a door only. */
function leadsOut(home: Home, { from, to }: { from: At; to: At }): boolean {
  const normal = direction(angleOf(minus(to, from)) + 90);
  const has = (side: number) => of(home, 'rooms').some((room) => inside(formOf(room) ?? [], add(middle([from, to]), times(normal, side * 0.3))));
  return has(1) !== has(-1);
}
