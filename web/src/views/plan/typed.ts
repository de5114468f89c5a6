// A length, and perhaps an angle, typed while walls or a room are drawn: `4.5`, `4.5<90`.

import { type At, distance, minus } from '../../plan/geometry';
import { type Units, inMetres } from '../../units';
import { add, angleOf, direction, exact, times } from './shape';

const FORM = /^(\d+(?:[.,]\d*)?)(?:\s*[<@ ]\s*(-?\d*(?:[.,]\d*)?))?$/;

/** Largest length of a wall in metres (our choice). */
const LONGEST_M = 1000;

/** The typed text with another key; null for a key that does not belong to it. */
export function typedOn(typed: string, key: string): string | null {
  if (key === 'Backspace') return typed === '' ? null : typed.slice(0, -1);
  if (key.length !== 1 || !/[0-9.,<@ -]/.test(key)) return null;
  // Other keys are those of the plan.
  if (typed === '' && !/[0-9.,]/.test(key)) return null;
  const next = typed + (key === '@' || key === ' ' ? '<' : key);
  return FORM.test(next.replace(/^[.,]/, '0.')) && next.length <= 20 ? next : typed;
}

/** The end of a line of the typed length from a point; without an angle, toward another point. */
export function typedEnd(from: At, typed: string, toward: At | null, units: Units): At | null {
  const read = FORM.exec(typed.replace(/^[.,]/, '0.'));
  if (read === null) return null;
  const number = (text: string) => Number(text.replace(',', '.'));
  const length_m = inMetres(number(read[1]!), units);
  if (!(length_m > 0.009 && length_m <= LONGEST_M)) return null;
  if (read[2] !== undefined) {
    const angle_deg = read[2] === '' || read[2] === '-' ? NaN : number(read[2]);
    return Number.isFinite(angle_deg) ? exact(add(from, times(direction(angle_deg), length_m))) : null;
  }
  const way = toward !== null && distance(from, toward) > 0.001 ? angleOf(minus(toward, from)) : 0;
  return exact(add(from, times(direction(way), length_m)));
}
