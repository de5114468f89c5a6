import { expect, test } from 'vitest';
import { routeOf } from './routes';
import { area, inMetres, inUnits, length, percent, scaleBar } from './units';

test('lengths in metres and in feet', () => {
  expect(length(1.2, 'metric')).toBe('1.20 m');
  expect([0.1, 0.3048, 1.2, 1.524].map((metres) => length(metres, 'feet'))).toEqual(['4 in', '1 ft', '3 ft 11 in', '5 ft']);
});

test('areas, and lengths for fields', () => {
  expect([area(12.345, 'metric'), area(0.043, 'metric'), area(1, 'feet')]).toEqual(['12.3 m²', '0.04 m²', '10.8 ft²']);
  expect([inUnits(1.2, 'metric'), inUnits(0.3048, 'feet'), inMetres(2, 'metric')]).toEqual([1.2, 1, 2]);
  expect(inMetres(inUnits(3.81, 'feet'), 'feet')).toBeCloseTo(3.81, 2);
});

test('a share is told to the nearest tenth, but less than all is not said to be all, nor what is not nothing to be nothing', () => {
  expect([1, 1 - 1e-12, 0.99964, 0.9994, 0.29, 0.2846, 0.2844].map(percent)).toEqual(['100.0 %', '100.0 %', '99.9 %', '99.9 %', '29.0 %', '28.5 %', '28.4 %']);
  expect([0.001, 0.0006, 0.0004, 1e-12, 0].map(percent)).toEqual(['0.1 %', '0.1 %', '<0.1 %', '0.0 %', '0.0 %']);
});

test('a scale bar is round and no wider than it may be', () => {
  expect(scaleBar(50, 130, 'metric')).toEqual({ label: '2 m', pixels: 100 });
  expect(scaleBar(400, 130, 'metric')).toEqual({ label: '0.2 m', pixels: 80 });
  for (const scale of [4, 17, 99, 600]) {
    for (const units of ['metric', 'feet'] as const) {
      const { pixels } = scaleBar(scale, 130, units);
      expect(pixels).toBeGreaterThan(50);
      expect(pixels).toBeLessThanOrEqual(130);
    }
  }
});

test('an address that is none of ours is the live view', () => {
  expect(['#/plan', '#/log/3', '#playback', '', '#/nowhere', '#/__proto__'].map(routeOf)).toEqual(['plan', 'log', 'playback', 'live', 'live', 'live']);
});
