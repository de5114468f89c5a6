import { expect, test } from 'vitest';
import { DEVICES } from '../../devices';
import { apply } from '../../json';
import { FLAT } from '../../testing/flat';
import { aboutDevice, becomes, deviceOf, madeOf } from './devices';
import { sensorsOf, withSensors } from './layouts.svelte';
import { newSensor } from './library';
import { isHome, of, readHome } from './model';
import { targetsOf } from './snap';

const flat = (() => {
  const read = readHome(FLAT);
  if (!isHome(read)) throw new Error(read.what);
  return read;
})();
const fibaro = DEVICES.find(({ key }) => key === 'fibaro')!;

test('a sensor that is put up as a device has its numbers', () => {
  const value = newSensor(flat, 'motion', [1, 1], targetsOf(flat, new Set()), null, fibaro);
  expect(value).toMatchObject({ kind: 'motion', preset: 'fibaro', height_m: 2.4, field_deg: fibaro.field_deg });
  // The control: without a device it has the defaults of the schema.
  expect(newSensor(flat, 'motion', [1, 1], targetsOf(flat, new Set()), null)).not.toHaveProperty('preset');
});

test('what looks for movement becomes another device, and nothing else does', () => {
  const sensors = of(flat, 'sensors');
  const motion = sensors.filter((element) => deviceOf(element) !== null);
  expect(motion.length).toBeGreaterThan(0);
  const changed = JSON.parse(apply(FLAT, becomes(sensors, fibaro))) as { sensors: Record<string, unknown>[] };
  for (const [index, { value }] of sensors.entries()) {
    const wall = value.kind === 'motion';
    if (wall) expect(changed.sensors[index]).toMatchObject(madeOf(fibaro));
    else if (value.kind === 'ceiling_motion') expect(changed.sensors[index]).toEqual({ ...value, preset: 'fibaro' });
    else expect(changed.sensors[index]).toEqual(value);
  }
  expect(aboutDevice(fibaro)).toBe(`Z-Wave, mounted 2.4 m high, field ${fibaro.field_deg[0]}° by ${fibaro.field_deg[1]}°, range ${fibaro.reach_m} m, repeats after 8 s`);
});

test('a layout that was kept is put back into the text of now', () => {
  const kept = sensorsOf(FLAT);
  const fewer = withSensors(FLAT, kept.slice(1))!;
  expect(sensorsOf(fewer)).toEqual(kept.slice(1));
  expect(sensorsOf(withSensors(fewer, kept)!)).toEqual(kept);
  expect(withSensors('{', kept)).toBeNull();
});
