// How likely everybody was where, of a log that was walked back. Places are rooms by their number, -1 is out, -2 between the rooms.

import type { Chance } from '../../charts/shades';
import { type Pen, trace } from '../../plan/pen';
import { colourOf } from '../../plan/moving';
import type { View } from '../../plan/transform';
import type { HomeView, PersonDay, PlaybackView } from '../../wire';
import { above } from './above';

export const OUT = -1;
export const BETWEEN = -2;

/** Less likely places are not told. */
const TOLD = 0.05;

/** How strong the colour of a room is where somebody is for certain. */
const STRONGEST = 0.45;

/** At each instant from which something holds: by place, from -2 on, how likely it is. They come to 1. */
export type Doubt = { at: Float64Array; chances: Float32Array[] };

export function doubtOf(run: PlaybackView, life: PersonDay): Doubt {
  const at: number[] = [];
  const chances: Float32Array[] = [];
  let now = new Float32Array(run.home.rooms.length + 2);
  life.chances.forEach(([when, place, chance], index) => {
    now[place - BETWEEN] = chance;
    // What changes at one instant is one change.
    if (life.chances[index + 1]?.[0] === when) return;
    at.push(when);
    // Small changes are not told: what is known comes to nearly 1.
    const sum = now.reduce((a, b) => a + b, 0) || 1;
    chances.push(now.map((one) => one / sum));
    now = now.slice();
  });
  return { at: Float64Array.from(at), chances };
}

/** The chances at an instant; nothing before the first. */
export function chancesAt(doubt: Doubt | undefined, at_us: number): Float32Array | null {
  return doubt?.chances[above(doubt.at, at_us, (at) => at) - 1] ?? null;
}

export function chanceOf(chances: Float32Array, place: number): number {
  return chances[place - BETWEEN] ?? 0;
}

/** How likely somebody is in the room in which they are drawn; on the way between two, in the most likely place. */
export function sureOf(chances: Float32Array, room: number | null): number {
  return room === null ? likely(chances)[0]![1] : chanceOf(chances, room);
}

/** The places by how likely they are, with their chances; those that hardly are left out, but not the first. */
export function likely(chances: Float32Array): [place: number, chance: number][] {
  const all = [...chances].map((chance, index): [number, number] => [index + BETWEEN, chance]).sort((a, b) => b[1] - a[1]);
  return all.filter(([, chance], index) => index === 0 || chance >= TOLD);
}

export function placeName(home: HomeView, place: number): string {
  return place === OUT ? 'out' : place === BETWEEN ? 'between rooms' : (home.rooms[place]?.name ?? '');
}

/** `87 %`; what is not certain is not called so. */
export function percent(chance: number): string {
  return `${chance >= 1 ? 100 : Math.min(Math.round(chance * 100), 99)} %`;
}

/** From when to when somebody was how likely in a place, where that is likely at all. */
export function spansIn(doubt: Doubt, place: number, end_us: number): Chance[] {
  return doubt.chances.flatMap((chances, index): Chance[] => {
    const chance = chanceOf(chances, place);
    return chance < TOLD ? [] : [[doubt.at[index]!, doubt.at[index + 1] ?? end_us, chance]];
  });
}

/** Rooms in the colour of who may be there, as strong as it is likely. */
export function drawDoubt(pen: Pen, view: View, home: HomeView, of: (Float32Array | null)[]): void {
  of.forEach((chances, resident) => {
    if (chances === null) return;
    home.rooms.forEach((room, index) => {
      const chance = chanceOf(chances, index);
      if (chance < 0.01) return;
      pen.beginPath();
      trace(pen, view, room.outline);
      pen.globalAlpha = STRONGEST * chance;
      pen.fillStyle = colourOf(resident);
      pen.fill();
    });
  });
  pen.globalAlpha = 1;
}
