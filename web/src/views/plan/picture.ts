// The edited home in the form of the other views: made from the file's text, so that a home with problems is shown,
// too.

import { type At, middle } from '../../plan/geometry';
import { usual } from '../../plan/layers';
import { drawDoors, drawFloor, sides } from '../../plan/moving';
import type { Palette } from '../../plan/palette';
import { type Box, type Pen, segments } from '../../plan/pen';
import { drawNames, drawStill } from '../../plan/still';
import type { Size, View } from '../../plan/transform';
import type { HomeView, SensorView, SolidView } from '../../wire';
import { type Home, IN_WALL_M, type Wall, boundsOf, formOf, number, of, spanOf, spotOf, wallsOf } from './model';
import { takes } from './schema';
import { add, along, direction, onLine, thick, times, toSegment } from './shape';

/** Computed parts, the middles of rooms and beams, are those of the last valid draft. */
export function pictured(home: Home, counted: HomeView | null): HomeView {
  const doors = of(home, 'doors').flatMap(({ name, value, ...element }) => {
    const span = spanOf({ name, value, ...element });
    return span ? [{ name, ...span, open: value.open !== false, outside: value.outside === true }] : [];
  });
  const rooms = of(home, 'rooms').flatMap((room) => {
    const outline = formOf(room);
    const known = counted?.rooms[room.index];
    return outline ? [{ name: room.name, outline, middle: known?.name === room.name ? known.middle : middle(outline), floor: typeof room.value.floor === 'string' ? room.value.floor : null }] : [];
  });
  const furniture = of(home, 'furniture').flatMap((piece): SolidView[] => {
    const outline = formOf(piece);
    return outline ? [{ kind: 'furniture', name: piece.name, outline, enterable: piece.value.enterable === true }] : [];
  });
  const walls = wallsOf(home).flatMap((wall) => partsOf(wall, doors).map((outline): SolidView => ({ kind: 'wall', name: null, outline, enterable: false })));
  const sensors = of(home, 'sensors').flatMap((sensor): SensorView[] => {
    const at = spotOf(home, sensor);
    if (!at) return [];
    const { kind, facing_deg, area } = sensor.value;
    const facing = takes(sensor, 'facing_deg') ? number(facing_deg) : null;
    // A short one in the direction of its sign.
    const beams: [At, At][] = facing === null ? [] : [[at, add(at, times(direction(facing), 0.001))]];
    return [{ name: sensor.name, kind: typeof kind === 'string' ? kind : '', room: null, at, facing_deg: facing, beams, area: area === undefined ? null : formOf(sensor), camera: null }];
  });
  const name = typeof home.value.name === 'string' ? home.value.name : '';
  return { name, bounds: boundsOf(home), rooms, solids: [...walls, ...furniture], doors, things: [], sensors };
}

/** A wall without the openings of its doors. */
function partsOf(wall: Wall, doors: { from: At; to: At }[]): At[][] {
  const { length_m } = along(wall.to, wall.from, wall.to);
  const gaps = doors.flatMap(({ from, to }) => {
    if ([from, to].some((at) => toSegment(at, wall.from, wall.to) > IN_WALL_M)) return [];
    const ends = [from, to].map((at) => along(at, wall.from, wall.to).along_m).sort((a, b) => a - b);
    return [ends as At];
  });
  const parts: At[][] = [];
  let begin = 0;
  for (const [from, to] of [...gaps.sort((a, b) => a[0] - b[0]), [length_m, length_m] as At]) {
    if (from > begin) parts.push(thick(onLine(wall.from, wall.to, begin), onLine(wall.from, wall.to, from), wall.thickness_m));
    begin = Math.max(begin, to);
  }
  return parts;
}

type Layered = {
  picture: HomeView;
  counted: HomeView | null;
  /** Over the floor, below everything on it. */
  under: (pen: Pen) => void;
  over: (pen: Pen) => void;
  /** Over all names, with its boxes, which names avoid. */
  top: (pen: Pen) => void;
  marks: Box[];
  /** The names of sensors with highlighted beams. */
  chosen: string[];
};

const sidesOf = new WeakMap<HomeView, number[]>();

export function drawPlan(pen: Pen, view: View, size: Size, palette: Palette, { picture, counted, under, over, top, marks, chosen }: Layered): void {
  const layers = { ...usual(picture.sensors.length), trails: false };
  pen.fillStyle = palette.outside;
  pen.fillRect(0, 0, size.width, size.height);
  drawFloor(pen, picture, view, palette, 1, []);
  under(pen);
  const known = new Map(counted?.sensors.map((sensor) => [sensor.name, sensor]));
  const seeing = picture.sensors.map((sensor) => ({ ...sensor, beams: known.get(sensor.name)?.beams ?? [], camera: known.get(sensor.name)?.camera ?? null }));
  drawStill(pen, { ...picture, sensors: seeing }, view, layers, palette);
  pen.beginPath();
  for (const { name, beams } of seeing) if (chosen.includes(name)) segments(pen, view, beams);
  pen.globalAlpha = 0.5;
  pen.strokeStyle = palette.seen;
  pen.lineWidth = 1;
  pen.stroke();
  pen.globalAlpha = 1;
  over(pen);
  const side = sidesOf.get(picture) ?? sides(picture);
  sidesOf.set(picture, side);
  drawDoors(pen, picture, view, palette, [], side);
  drawNames(pen, picture, view, layers, palette, size, marks);
  top(pen);
}
