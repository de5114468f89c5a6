// Approximate answers of a server about a home's text: a sensor on a wall sees its room, one on the ceiling its area.

import { encode } from '@msgpack/msgpack';
import { type At, box, inside } from '../plan/geometry';
import { type Home, boundsOf, formOf, isHome, of, readHome, spotOf } from '../views/plan/model';
import { pictured } from '../views/plan/picture';
import { area } from '../views/plan/shape';
import type { CoverageView, DeadZoneView, FloorView, HomeView, PlanView } from '../wire';

const STEP_M = 0.25;

/** The text of a home's file that corresponds to this home. */
export function homeText({ name, rooms, solids, doors, sensors }: HomeView): string {
  const walls = solids.filter(({ kind }) => kind === 'wall').map(({ outline }) => {
    const [left, bottom, right, top] = box(outline);
    const [x, y] = [(left + right) / 2, (bottom + top) / 2];
    const flat = right - left > top - bottom;
    return flat ? { from: [left, y], to: [right, y], thickness_m: top - bottom } : { from: [x, bottom], to: [x, top], thickness_m: right - left };
  });
  const furniture = solids.filter(({ kind }) => kind === 'furniture').map(({ name, outline, enterable }) => ({ name, outline, height_m: 0.8, enterable }));
  const hung = sensors.map(({ name, kind, at, facing_deg, area }) => {
    if (kind === 'motion') return { kind, name, at, facing_deg: facing_deg ?? 0 };
    return kind === 'ceiling_motion' ? { kind, name, area } : { kind, name, on: furniture[0]?.name };
  });
  return JSON.stringify({ name, rooms: rooms.map(({ name, outline }) => ({ name, outline })), walls, doors, furniture, sensors: hung }, null, 2);
}

/** The answer for the text of a home's file. */
export function planned(text: string): Response {
  const home = readHome(text);
  const wrong = (what: string): PlanView => ({ problems: [{ file: 'home.json', line: 1, column: 1, width: 1, what, hint: null }], home: null, coverage: null });
  const view: PlanView = isHome(home) ? { problems: [], home: pictured(home, null), coverage: covered(home) } : wrong(home.what);
  return new Response(encode(view) as BodyInit);
}

function covered(home: Home): CoverageView {
  const rooms = of(home, 'rooms').map(({ name, ...room }) => ({ name, outline: formOf({ name, ...room }) ?? [] }));
  const areas = of(home, 'sensors').flatMap((sensor) => {
    if (sensor.value.kind === 'ceiling_motion') return [{ name: sensor.name, outline: formOf(sensor) ?? [] }];
    const at = sensor.value.kind === 'motion' ? spotOf(home, sensor) : null;
    const room = at && rooms.find(({ outline }) => inside(outline, at));
    return room ? [{ name: sensor.name, outline: room.outline }] : [];
  });
  const [[left, bottom], [right, top]] = boundsOf(home);
  const [columns, rows] = [Math.ceil((right - left) / STEP_M), Math.ceil((top - bottom) / STEP_M)];
  const middleOf = (cell: number): At => [left + ((cell % columns) + 0.5) * STEP_M, bottom + (Math.floor(cell / columns) + 0.5) * STEP_M];
  const cells = Uint8Array.from({ length: columns * rows }, (_, cell) => {
    const at = middleOf(cell);
    return rooms.some(({ outline }) => inside(outline, at)) ? areas.filter(({ outline }) => inside(outline, at)).length : 255;
  });
  const dead_zones = rooms.flatMap(({ name, outline }): Omit<DeadZoneView, 'number'>[] => {
    const seen = areas.filter((one) => one.outline.every((at) => inside(outline, at)));
    if (areas.some((one) => one.outline === outline)) return [];
    const area_m2 = Math.abs(area(outline)) - seen.reduce((sum, one) => sum + Math.abs(area(one.outline)), 0);
    return [{ room: name, area_m2, middle: outline[0]!.map((value, axis) => value * 0.85 + outline[2]![axis]! * 0.15) as At, outline, holes: seen.map((one) => one.outline.toReversed()) }];
  });
  const floor = (name: string, outlines: At[][]): FloorView => {
    const counts = [...cells].filter((count, cell) => count !== 255 && outlines.some((outline) => inside(outline, middleOf(cell))));
    const share = (of: (count: number) => boolean) => counts.filter(of).length / Math.max(counts.length, 1);
    return { name, floor_m2: counts.length * STEP_M ** 2, seen_by: [share((n) => n === 0), share((n) => n === 1), share((n) => n === 2), share((n) => n > 2)] };
  };
  return {
    step_m: STEP_M, corner: [left, bottom], columns, cells,
    whole: floor(String(home.value.name), rooms.map(({ outline }) => outline)),
    rooms: rooms.map(({ name, outline }) => floor(name, [outline])),
    sensors: areas.map(({ name, outline }) => ({ name, seen_m2: Math.abs(area(outline)), alone_m2: Math.abs(area(outline)) })),
    overlaps: [],
    dead_zones: dead_zones.map((zone, index) => ({ ...zone, number: index + 1 })),
  };
}
