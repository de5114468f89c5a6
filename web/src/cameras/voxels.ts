// The voxel person: cubes in which two cameras agree, drawn from the south-east and from above.

import { mix, okabeIto, type Palette } from '../plan/palette';
import { FONT, type Pen } from '../plan/pen';
import type { At } from '../plan/geometry';
import type { PersonView } from '../wire';

/** Distance from the middle of a person to the edges of the drawn floor, in metres. */
const AROUND_M = 1.1;
/** Height of the drawing, in metres. */
const UP_M = 2;
/** Sine of the angle of the view below the horizon. */
const DOWN = 0.42;
const LEVEL = Math.sqrt(1 - DOWN * DOWN);
const HALF = Math.SQRT1_2;

type Space = { middle: At; scale: number; left: number; top: number };

/** The position on the screen of a point in metres east, north and up. */
function onScreen({ middle, scale, left, top }: Space, x: number, y: number, z: number): At {
  const [east, north] = [x - middle[0], y - middle[1]];
  return [left + (east + north) * HALF * scale, top - ((north - east) * HALF * DOWN + z * LEVEL) * scale];
}

/** The cubes from the farthest to the nearest: three numbers each. */
export function inOrder(cubes: readonly number[]): [number, number, number][] {
  const all = Array.from({ length: Math.floor(cubes.length / 3) }, (_, index): [number, number, number] => [cubes[index * 3]!, cubes[index * 3 + 1]!, cubes[index * 3 + 2]!]);
  return all.sort((a, b) => a[0] - a[1] - (b[0] - b[1]) || a[2] - b[2]);
}

export function drawPerson(pen: Pen, width: number, height: number, person: PersonView, corner: At, edge_m: number, palette: Palette): void {
  const wide = 4 * AROUND_M * HALF;
  const high = wide * DOWN + UP_M * LEVEL;
  const scale = Math.min((width - 26) / wide, (height - 8) / high);
  const space: Space = { middle: person.at, scale, left: width / 2 + 9, top: height - 4 - (wide / 2) * DOWN * scale };
  drawFloor(pen, space, palette);
  drawHeights(pen, space, palette);
  const tones = [mix(okabeIto.sky, '#ffffff', 0.45), okabeIto.sky, mix(okabeIto.sky, '#000000', 0.35)] as const;
  for (const [x, y, z] of inOrder(person.cubes)) {
    const [east, north, up] = [corner[0] + x * edge_m, corner[1] + y * edge_m, z * edge_m];
    const at = (dx: number, dy: number, dz: number) => onScreen(space, east + dx * edge_m, north + dy * edge_m, up + dz * edge_m);
    // Three sides of a cube are visible: the top, the south and the east.
    face(pen, [at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)], tones[0]);
    face(pen, [at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)], tones[1]);
    face(pen, [at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)], tones[2]);
  }
}

function face(pen: Pen, corners: At[], colour: string): void {
  pen.beginPath();
  corners.forEach(([x, y], index) => (index === 0 ? pen.moveTo(x, y) : pen.lineTo(x, y)));
  pen.closePath();
  pen.fillStyle = colour;
  pen.fill();
}

/** The floor around, with a line every half a metre. */
function drawFloor(pen: Pen, space: Space, palette: Palette): void {
  const [x, y] = space.middle;
  pen.beginPath();
  for (let at = -1; at <= 1; at += 0.5) {
    for (const [from, to] of [[[x - 1, y + at], [x + 1, y + at]], [[x + at, y - 1], [x + at, y + 1]]] as [At, At][]) {
      pen.moveTo(...onScreen(space, from[0], from[1], 0));
      pen.lineTo(...onScreen(space, to[0], to[1], 0));
    }
  }
  pen.lineWidth = 0.8;
  pen.strokeStyle = palette.furnitureEdge;
  pen.stroke();
}

/** The scale of heights at the western corner, every half a metre. */
function drawHeights(pen: Pen, space: Space, palette: Palette): void {
  const [x, y] = [space.middle[0] - 1, space.middle[1] - 1];
  pen.font = `10px ${FONT}`;
  pen.textAlign = 'right';
  pen.textBaseline = 'middle';
  pen.fillStyle = palette.quiet;
  pen.beginPath();
  pen.moveTo(...onScreen(space, x, y, 0));
  pen.lineTo(...onScreen(space, x, y, UP_M));
  for (let up = 0.5; up <= UP_M; up += 0.5) {
    const [left, top] = onScreen(space, x, y, up);
    pen.moveTo(left, top);
    pen.lineTo(left + 4, top);
    if (up % 1 === 0) pen.fillText(`${up} m`, left - 3, top);
  }
  pen.lineWidth = 1;
  pen.strokeStyle = palette.furnitureEdge;
  pen.stroke();
}

/** The posture of a person, in words. */
export function stateOf({ upright, in_between, on_the_ground }: PersonView): string {
  const states = [['upright', upright], ['in between', in_between], ['on the ground', on_the_ground]] as const;
  const best = states.reduce((a, b) => (b[1] > a[1] ? b : a));
  return best[1] > 0 ? best[0] : 'unclear';
}
