// Devices of the catalogue, as values of a home's sensor.

import { DEVICES, type Product } from '../../devices';
import type { Change } from '../../json';
import { sensesMotion } from '../../plan/kinds';
import type { Element, Value } from './model';
import { takes } from './schema';

/** The values that a device sets, of those that a kind of sensor has. */
export function madeOf({ key, height_m, field_deg, reach_m }: Product): Value {
  return { height_m, field_deg, reach_m, preset: key };
}

/** The device of a sensor; null for sensors without motion. */
export function deviceOf({ list, value }: Element): Product | null {
  if (list !== 'sensors' || !sensesMotion(value.kind)) return null;
  return DEVICES.find(({ key }) => key === (value.preset ?? 'paper')) ?? null;
}

/** Changes that assign a device to motion sensors. */
export function becomes(elements: Element[], device: Product): Change[] {
  return elements.flatMap((element) => {
    if (deviceOf(element) === null) return [];
    const made = Object.entries(madeOf(device)).filter(([key]) => takes(element, key));
    return made.map(([key, value]) => ({ path: ['sensors', element.index, key], value }));
  });
}

export function aboutDevice({ network, height_m, field_deg, reach_m, refire_s }: Product): string {
  const [least, most] = refire_s;
  const again = least === most ? `${least}` : `${least} to ${most}`;
  return `${network === '' ? '' : `${network}, `}mounted ${height_m} m high, field ${field_deg[0]}° by ${field_deg[1]}°, range ${reach_m} m, repeats after ${again} s`;
}

/** The sources of the numbers of a device. */
export function sourcesOf({ sources }: Product): string {
  return `Height: ${sources.height}. Field: ${sources.field}. Range: ${sources.reach}. Timing: ${sources.timing}.`;
}
