// The parts of a plan that change from frame to frame: the floor's light, doors, states of things, detections, and
// people.

import type { BodyView, HomeView, ResidentView } from '../wire';
import { type At, box, distance, inside, openDoors, openLeaf } from './geometry';
import type { Layers } from './layers';
import { type Palette, contrast, floor, people } from './palette';
import { FONT, type Pen, capsule, segments, text, trace } from './pen';
import { GLYPH, place } from './still';
import { type Step, Trails } from './trails';
import { type Size, type View, toScreen } from './transform';
import { isolated, shortened } from './words';

/** A wider opening has no leaf. */
const WIDEST_LEAF_M = 1.3;

/** The floor by daylight, and by the brightness of the lamp of each room. */
export function drawFloor(pen: Pen, home: HomeView, view: View, palette: Palette, day: number, lamps: number[]): void {
  home.rooms.forEach((room, index) => {
    pen.beginPath();
    trace(pen, view, room.outline);
    pen.fillStyle = floor(palette, day, lamps[index] ?? 0);
    pen.fill();
  });
}

/** Rooms with their lamp on: a lamp has its room's name. */
export function litRooms(home: HomeView, on: number[]): number[] {
  const lit = new Set(on.flatMap((index) => (home.things[index]?.kind === 'lamp' ? [home.things[index].name] : [])));
  return home.rooms.flatMap((room, index) => (lit.has(room.name) ? [index] : []));
}

/** The side to which each door opens: 1 is a quarter turn counter-clockwise from the second jamb. */
export function sides(home: HomeView): number[] {
  const furniture = home.solids.filter(({ kind }) => kind === 'furniture').map(({ outline }) => ({ outline, box: box(outline) }));
  return home.doors.map((door) => {
    const [x, y, reach] = [door.from[0], door.from[1], 2 * distance(door.from, door.to)];
    const near = furniture.filter(({ box: [left, bottom, right, top] }) => left <= x + reach && right >= x - reach && bottom <= y + reach && top >= y - reach);
    const cost = (leaf: At) => {
      const spots: At[] = [[0.2, 0.8], [0.5, 0.5], [0.8, 0.2], [0.1, 0.4], [0.4, 0.1], [0.4, 0.8]].map(([along, across]) => [
        door.from[0] + (door.to[0] - door.from[0]) * along! + (leaf[0] - door.from[0]) * across!,
        door.from[1] + (door.to[1] - door.from[1]) * along! + (leaf[1] - door.from[1]) * across!,
      ]);
      const stands = near.filter(({ outline }) => spots.some((spot) => inside(outline, spot)));
      return stands.length + (home.rooms.some((room) => inside(room.outline, spots[1]!)) ? 0 : 20);
    };
    return cost(openLeaf(door.from, door.to)) <= cost(mirrored(door.from, door.to)) ? 1 : -1;
  });
}

function mirrored(from: At, to: At): At {
  const leaf = openLeaf(from, to);
  return [2 * from[0] - leaf[0], 2 * from[1] - leaf[1]];
}

export function drawDoors(pen: Pen, home: HomeView, view: View, palette: Palette, on: number[], side: number[]): void {
  const open = openDoors(home, on);
  home.doors.forEach((door, index) => {
    const [from, to] = [toScreen(view, door.from), toScreen(view, door.to)];
    const width = Math.hypot(door.to[0] - door.from[0], door.to[1] - door.from[1]);
    pen.lineCap = 'butt';
    if (!open[index]) {
      pen.beginPath();
      line(pen, from, to);
      pen.lineWidth = Math.max(view.scale * 0.09, 4);
      pen.strokeStyle = palette.wall;
      pen.stroke();
      pen.lineWidth = Math.max(view.scale * 0.09 - 2.4, 1.6);
      pen.strokeStyle = door.outside ? palette.on : palette.furniture;
      pen.stroke();
    } else if (width <= WIDEST_LEAF_M) {
      const hinge = door.from;
      const leaf = toScreen(view, side[index] === -1 ? mirrored(hinge, door.to) : openLeaf(hinge, door.to));
      const begin = Math.atan2(to[1] - from[1], to[0] - from[0]);
      const end = Math.atan2(leaf[1] - from[1], leaf[0] - from[0]);
      pen.beginPath();
      pen.arc(from[0], from[1], width * view.scale, begin, end, side[index] !== -1);
      pen.lineWidth = 1;
      pen.strokeStyle = palette.furnitureEdge;
      pen.stroke();
      pen.beginPath();
      line(pen, from, leaf);
      pen.lineWidth = Math.max(view.scale * 0.035, 2);
      pen.strokeStyle = door.outside ? palette.on : palette.wall;
      pen.stroke();
    }
  });
}

/** A badge on each piece of furniture that is on or open: a ring with a stroke, as on a switch. */
export function drawOn(pen: Pen, home: HomeView, view: View, palette: Palette, on: number[]): void {
  for (const index of on) {
    const thing = home.things[index];
    if (thing?.kind !== 'furniture') continue;
    const [x, y] = toScreen(view, thing.at);
    pen.beginPath();
    pen.arc(x, y, 8.5, 0, 2 * Math.PI);
    pen.fillStyle = palette.halo;
    pen.fill();
    pen.lineWidth = 1.5;
    pen.strokeStyle = palette.on;
    pen.stroke();
    pen.beginPath();
    pen.arc(x, y + 0.5, 4, -Math.PI / 2 + 0.7, 1.5 * Math.PI - 0.7);
    pen.moveTo(x, y - 5);
    pen.lineTo(x, y);
    pen.lineWidth = 1.8;
    pen.stroke();
  }
}

/** Beams and areas of sensors that detect a person, as bright as their glow. */
export function drawSeen(pen: Pen, home: HomeView, view: View, palette: Palette, levels: number[], layers: Layers): void {
  // Many at once would cover the plan with a colour without information.
  const alpha = Math.min(0.45, 2.2 / Math.max(levels.filter((level) => level > 0.3).length, 1));
  home.sensors.forEach((sensor, index) => {
    const level = levels[index] ?? 0;
    if (level <= 0.01) return;
    pen.strokeStyle = palette.seen;
    pen.fillStyle = palette.seen;
    if (sensor.area && layers.areas) {
      pen.beginPath();
      trace(pen, view, sensor.area);
      pen.globalAlpha = 0.16 * level;
      pen.fill();
      pen.globalAlpha = 0.9 * level;
      pen.lineWidth = 2;
      pen.stroke();
    }
    if (layers.beams && sensor.beams.length > 0) {
      pen.globalAlpha = Math.max(alpha, 0.1) * level;
      pen.lineWidth = 1;
      pen.beginPath();
      segments(pen, view, sensor.beams);
      pen.stroke();
    }
    const [x, y] = place(sensor, view);
    pen.globalAlpha = level;
    pen.lineWidth = 2.2;
    pen.beginPath();
    pen.arc(x, y, GLYPH + 4, 0, 2 * Math.PI);
    pen.stroke();
  });
  pen.globalAlpha = 1;
}

export function drawPulses(pen: Pen, home: HomeView, view: View, palette: Palette, pulses: { sensor: number; age: number }[], still: boolean): void {
  for (const { sensor, age } of pulses) {
    const fired = home.sensors[sensor];
    if (fired === undefined) continue;
    const [x, y] = place(fired, view);
    pen.globalAlpha = 1 - age;
    pen.lineWidth = still ? 3 : 3.5 - 2 * age;
    pen.strokeStyle = palette.seen;
    pen.beginPath();
    pen.arc(x, y, still ? GLYPH + 7 : GLYPH + 5 + 22 * age, 0, 2 * Math.PI);
    pen.stroke();
  }
  pen.globalAlpha = 1;
}

/** In fast time: the count of each sensor next to it. */
export function drawCounts(pen: Pen, home: HomeView, view: View, palette: Palette, counts: number[]): void {
  pen.font = `600 11px ${FONT}`;
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  home.sensors.forEach((sensor, index) => {
    const count = counts[index] ?? 0;
    if (count === 0) return;
    const [x, y] = place(sensor, view);
    const words = count < 10_000 ? String(count) : `${Math.floor(count / 1000)}k`;
    const width = pen.measureText(words).width + 9;
    capsule(pen, x - width / 2, y - 24, width, 16);
    pen.fillStyle = palette.outline;
    pen.fill();
    text(pen, words, x, y - 15.5, palette.halo, null);
  });
}

export function drawTrails(pen: Pen, view: View, trails: Step[][], now_ms: number): void {
  pen.lineCap = 'round';
  trails.forEach((steps, index) => {
    pen.strokeStyle = colourOf(index);
    for (let at = 1; at < steps.length; at++) {
      const [before, step] = [steps[at - 1]!, steps[at]!];
      const left = Trails.left(step, now_ms);
      pen.globalAlpha = 0.65 * left;
      pen.beginPath();
      pen.lineWidth = 1 + 2.5 * left;
      line(pen, toScreen(view, before.at), toScreen(view, step.at));
      pen.stroke();
    }
  });
  pen.globalAlpha = 1;
}

/** Smallest opacity of a body with an uncertain position. */
const FAINTEST = 0.2;

/** Probability below which a person has a question mark. */
const SURE = 0.5;

export function colourOf(resident: number): string {
  return people[resident % people.length]!;
}

/** Half of the length of a lying person, and half of the head's, relative to half of the shoulders' breadth (our choice). */
const LYING = 3.65;
const HEAD = 0.55;

/** `sure` is the probability of the position, from 0 to 1: uncertain people are faint. */
export type Person = { resident: ResidentView; body: BodyView; index: number; driven: boolean; sure: number };

export function drawPeople(pen: Pen, view: View, palette: Palette, persons: Person[], size: Size): void {
  for (const person of persons) body(pen, view, palette, person);
  for (const person of persons) name(pen, view, palette, person, size);
}

function body(pen: Pen, view: View, palette: Palette, { resident, body, index, driven, sure }: Person): void {
  const [x, y] = toScreen(view, body.at);
  const radius = Math.max(resident.radius_m * view.scale, 6);
  pen.save();
  pen.globalAlpha = FAINTEST + (1 - FAINTEST) * sure;
  pen.translate(x, y);
  pen.rotate((-body.heading_deg * Math.PI) / 180);
  pen.fillStyle = colourOf(index);
  pen.strokeStyle = palette.outline;
  pen.lineWidth = 1.6;
  pen.beginPath();
  if (body.posture === 'lying') {
    // From above: trunk and head in one line, centred on the position.
    const [feet, neck] = [-radius * LYING, radius * (LYING - 2 * HEAD + 0.15)];
    pen.roundRect(feet, -radius * 0.75, neck - feet, radius * 1.5, radius * 0.7);
    pen.fill();
    pen.stroke();
    pen.beginPath();
    pen.arc(radius * (LYING - HEAD), 0, radius * HEAD, 0, 2 * Math.PI);
  } else if (body.posture === 'sitting') {
    // Two thighs in front of the trunk.
    pen.roundRect(0, -radius * 0.85, radius * 1.6, radius * 0.7, radius * 0.3);
    pen.roundRect(0, radius * 0.15, radius * 1.6, radius * 0.7, radius * 0.3);
    pen.fill();
    pen.stroke();
    pen.beginPath();
    pen.arc(0, 0, radius, 0, 2 * Math.PI);
  } else {
    pen.moveTo(radius * 1.55, 0);
    pen.lineTo(radius * 0.75, radius * 0.66);
    pen.lineTo(radius * 0.75, -radius * 0.66);
    pen.closePath();
    pen.fill();
    pen.stroke();
    pen.beginPath();
    pen.arc(0, 0, radius, 0, 2 * Math.PI);
  }
  pen.fill();
  pen.stroke();
  pen.restore();
  if (!driven) return;
  pen.beginPath();
  pen.arc(x, y, radius * 1.55 + 4, 0, 2 * Math.PI);
  pen.lineWidth = 2;
  pen.setLineDash([5, 4]);
  pen.strokeStyle = palette.outline;
  pen.stroke();
  pen.setLineDash([]);
}

function name(pen: Pen, view: View, palette: Palette, { resident, body, index, sure }: Person, size: Size): void {
  const [at, y] = toScreen(view, body.at);
  const radius = Math.max(resident.radius_m * view.scale, 6);
  const words = `${shortened(resident.name, 18)}${sure < SURE ? '?' : ''}`;
  pen.font = `600 11px ${FONT}`;
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  const width = pen.measureText(words).width + 12;
  // At an edge of the picture the name stays inside, as long as the body does.
  const isIn = at >= 0 && at <= size.width;
  const x = isIn ? Math.min(Math.max(at, width / 2 + 2), Math.max(size.width - width / 2 - 2, width / 2 + 2)) : at;
  const reach = radius * Math.max(1.6, body.posture === 'lying' ? LYING * Math.abs(Math.sin((body.heading_deg * Math.PI) / 180)) : 0);
  const above = y - reach - 21;
  const top = above < 2 && y >= 0 ? y + reach + 4 : above;
  capsule(pen, x - width / 2, top, width, 17);
  const colour = colourOf(index);
  pen.fillStyle = colour;
  pen.fill();
  pen.lineWidth = 1;
  pen.strokeStyle = palette.outline;
  pen.stroke();
  const ink = contrast(colour, '#ffffff') >= 4.5 ? '#ffffff' : '#000000';
  text(pen, isolated(words), x, top + 9, ink, null);
}

function line(pen: Pen, from: At, to: At): void {
  pen.moveTo(from[0], from[1]);
  pen.lineTo(to[0], to[1]);
}
