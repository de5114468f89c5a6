// Devices of the catalogue, as values of a home's sensor.

import { DEVICES, type Product } from '../../devices';
import type { Change } from '../../json';
import type { Element, Value } from './model';

/** The values of a wall sensor that a device sets. */
export function madeOf({ key, height_m, field_deg, reach_m }: Product): Value {
  return { height_m, field_deg, reach_m, preset: key };
}

/** The device of a sensor; null for sensors without motion. */
export function deviceOf({ list, value }: Element): Product | null {
  if (list !== 'sensors' || (value.kind !== 'motion' && value.kind !== 'ceiling_motion')) return null;
  return DEVICES.find(({ key }) => key === (value.preset ?? 'paper')) ?? null;
}

/** Changes that assign a device to motion sensors. */
export function becomes(elements: Element[], device: Product): Change[] {
  return elements.flatMap((element) => {
    if (deviceOf(element) === null) return [];
    const made = element.value.kind === 'motion' ? madeOf(device) : { preset: device.key };
    return Object.entries(made).map(([key, value]) => ({ path: ['sensors', element.index, key], value }));
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
