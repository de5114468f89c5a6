// Devices of the catalogue, as what a sensor of the home is.

import { DEVICES, type Product } from '../../devices';
import type { Change } from '../../json';
import type { Element, Value } from './model';

/** What a device changes of a sensor on a wall. */
export function madeOf({ key, height_m, field_deg, reach_m }: Product): Value {
  return { height_m, field_deg, reach_m, preset: key };
}

/** The device that a sensor is; nothing for one that does not look for movement. */
export function deviceOf({ list, value }: Element): Product | null {
  if (list !== 'sensors' || (value.kind !== 'motion' && value.kind !== 'ceiling_motion')) return null;
  return DEVICES.find(({ key }) => key === (value.preset ?? 'paper')) ?? null;
}

/** What makes sensors that look for movement another device. */
export function becomes(elements: Element[], device: Product): Change[] {
  return elements.flatMap((element) => {
    if (deviceOf(element) === null) return [];
    const made = element.value.kind === 'motion' ? madeOf(device) : { preset: device.key };
    return Object.entries(made).map(([key, value]) => ({ path: ['sensors', element.index, key], value }));
  });
}

/** What is known of a device, in a line. */
export function aboutDevice({ network, height_m, field_deg, reach_m, refire_s }: Product): string {
  const [least, most] = refire_s;
  const again = least === most ? `${least}` : `${least} to ${most}`;
  return `${network === '' ? '' : `${network}, `}mounted ${height_m} m high, field ${field_deg[0]}° by ${field_deg[1]}°, range ${reach_m} m, repeats after ${again} s`;
}

/** Where the numbers of a device are from. */
export function sourcesOf({ sources }: Product): string {
  return `Height: ${sources.height}. Field: ${sources.field}. Range: ${sources.reach}. Timing: ${sources.timing}.`;
}
