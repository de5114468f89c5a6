import { expect, test } from 'vitest';
import { contrast, dark, daylight, floor, light, mix, okabeIto, viridis } from './palette';

test('contrast is that of WCAG', () => {
  expect(contrast('#000000', '#ffffff')).toBeCloseTo(21);
  expect(contrast('#777777', '#ffffff')).toBeCloseTo(4.48, 1);
});

test('mixing and viridis meet their ends', () => {
  expect(mix('#000000', '#ffffff', 0.5)).toBe('#808080');
  expect(viridis(-1)).toBe('#440154');
  expect(viridis(0.5)).toBe('#21918c');
  expect(viridis(2)).toBe('#fde725');
});

test('colours of kinds are those of Okabe and Ito', () => {
  expect(Object.values(okabeIto)).toEqual(['#E69F00', '#56B4E9', '#009E73', '#F0E442', '#0072B2', '#D55E00', '#CC79A7', '#000000']);
});

for (const [name, palette] of Object.entries({ light, dark })) {
  for (const [hour, sun, lamp] of [['noon', 1, 0], ['dusk', 0, 0], ['night', -1, 0], ['night with a lamp', -1, 1]] as const) {
    test(`text and outlines stand out from the floor: ${name}, ${hour}`, () => {
      const ground = floor(palette, daylight(sun), lamp);
      for (const ink of [palette.text, palette.quiet, palette.sensor]) expect(contrast(ink, ground)).toBeGreaterThanOrEqual(4.5);
      for (const mark of [palette.wall, palette.outline, palette.seen, palette.on]) {
        expect(Math.max(contrast(mark, ground), contrast(mark, palette.halo))).toBeGreaterThanOrEqual(3);
      }
      expect(contrast(palette.wall, ground)).toBeGreaterThanOrEqual(3);
      expect(contrast(palette.seen, ground)).toBeGreaterThanOrEqual(2.3);
    });
  }
}

for (const [name, palette] of Object.entries({ light, dark })) {
  test(`marks on a time line stand out, and are not taken for what one of two runs has alone: ${name}`, () => {
    for (const mark of [palette.found, palette.marked]) {
      expect(contrast(mark, palette.halo)).toBeGreaterThanOrEqual(4.5);
      expect([palette.seen, palette.beam]).not.toContain(mark);
    }
  });
}

test('it is dark at night and a lamp helps', () => {
  expect(contrast(floor(light, daylight(-1), 0), light.floorDay)).toBeGreaterThan(1.3);
  expect(floor(light, daylight(-1), 1)).toBe(light.floorLit);
});
