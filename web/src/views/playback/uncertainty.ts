// Probabilities of places of located people. Places are rooms by their number; -1 is out, -2 between the rooms.

import type { Chance } from '../../charts/shades';
import { type Pen, trace } from '../../plan/pen';
import { colourOf } from '../../plan/moving';
import type { View } from '../../plan/transform';
import type { HomeView, PersonDay, PlaybackView } from '../../wire';
import { above } from './sorted-search';

export const OUT = -1;
export const BETWEEN = -2;

/** Smallest probability that is reported. */
const TOLD = 0.05;

/** Opacity of a room's colour for a certain position. */
const STRONGEST = 0.45;

/** By instant of a change: the probability of each place, from -2 on. They sum to 1. */
export type Uncertainty = { at: Float64Array; chances: Float32Array[] };

export function uncertaintyOf(run: PlaybackView, life: PersonDay): Uncertainty {
  const at: number[] = [];
  const chances: Float32Array[] = [];
  let now = new Float32Array(run.home.rooms.length + 2);
  life.chances.forEach(([when, place, chance], index) => {
    now[place - BETWEEN] = chance;
    // Changes at one instant are one change.
    if (life.chances[index + 1]?.[0] === when) return;
    at.push(when);
    // Small changes are not sent: the known values sum to nearly 1.
    const sum = now.reduce((a, b) => a + b, 0) || 1;
    chances.push(now.map((one) => one / sum));
    now = now.slice();
  });
  return { at: Float64Array.from(at), chances };
}

/** The probabilities at an instant; null before the first. */
export function chancesAt(doubt: Uncertainty | undefined, at_us: number): Float32Array | null {
  return doubt?.chances[above(doubt.at, at_us, (at) => at) - 1] ?? null;
}

export function chanceOf(chances: Float32Array, place: number): number {
  return chances[place - BETWEEN] ?? 0;
}

/** The probability of the room of a drawn person; on the way between two, that of the most likely place. */
export function sureOf(chances: Float32Array, room: number | null): number {
  return room === null ? likely(chances)[0]![1] : chanceOf(chances, room);
}

/** The places by probability; unlikely ones are left out, except the first. */
export function likely(chances: Float32Array): [place: number, chance: number][] {
  const all = [...chances].map((chance, index): [number, number] => [index + BETWEEN, chance]).sort((a, b) => b[1] - a[1]);
  return all.filter(([, chance], index) => index === 0 || chance >= TOLD);
}

export function placeName(home: HomeView, place: number): string {
  return place === OUT ? 'out' : place === BETWEEN ? 'between rooms' : (home.rooms[place]?.name ?? '');
}

/** `87 %`; only certainty is 100 %. */
export function percent(chance: number): string {
  return `${chance >= 1 ? 100 : Math.min(Math.round(chance * 100), 99)} %`;
}

/** The intervals of a likely place, with the probability. */
export function spansIn(doubt: Uncertainty, place: number, end_us: number): Chance[] {
  return doubt.chances.flatMap((chances, index): Chance[] => {
    const chance = chanceOf(chances, place);
    return chance < TOLD ? [] : [[doubt.at[index]!, doubt.at[index + 1] ?? end_us, chance]];
  });
}

/** Rooms in the colour of the people who may be there, by probability. */
export function drawUncertainty(pen: Pen, view: View, home: HomeView, of: (Float32Array | null)[]): void {
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
