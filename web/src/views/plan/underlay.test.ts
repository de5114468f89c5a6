import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { FakeStore } from '../../testing/store';
import { Underlay, carryUnderlay } from './underlay.svelte';

let store: FakeStore;
let underlay: Underlay;
const noPicture = { json: <T>() => Promise.resolve(null as T), file: () => Promise.reject(new Error('no picture')) };
const picture = () => new File(['a picture'], 'plan.png', { type: 'image/png' });

beforeEach(async () => {
  store = new FakeStore();
  vi.stubGlobal('indexedDB', store);
  vi.stubGlobal('Image', class { naturalWidth = 100; naturalHeight = 200; decode = () => Promise.resolve(); });
  underlay = new Underlay(noPicture);
  await underlay.open('cottage');
});

afterEach(() => vi.unstubAllGlobals());

test('a picture is kept by the home’s name, as large as fits', async () => {
  await underlay.choose(picture(), [1, 2], [8, 8]);
  expect(underlay.problem).toBe('');
  const again = new Underlay(noPicture);
  await again.open('cottage');
  expect([again.name, again.lies]).toEqual(['plan.png', { at: [1, 2], width_m: 4, turn_deg: 0, opacity: 0.5 }]);
  expect(store.closed).toBe(store.opened);
  expect(again.bounds).toEqual([[-1, -2], [3, 6]]);
  await again.lie({ turn_deg: -90 });
  expect(again.bounds!.flat().map((metres) => Math.round(metres) + 0)).toEqual([-3, 0, 5, 4]);
});

test('a picture that a full store does not keep is said so', async () => {
  store.isFull = true;
  await underlay.choose(picture(), [1, 2], [8, 8]);
  expect([underlay.name, underlay.problem]).toEqual(['plan.png', 'The browser cannot store the image. Choose it again next time.']);
  expect(store.closed).toBe(store.opened);
});

test('a picture of the scenario’s folder is shown where the browser has none', async () => {
  const lies = { picture: 'plan.png', at: [5, 2.5], width_m: 10, turn_deg: 90 };
  const ofFolder = { json: <T>() => Promise.resolve(lies as T), file: () => Promise.resolve({ blob: picture(), name: 'x' }) };
  const first = new Underlay(ofFolder);
  await first.open('cottage');
  expect([first.name, first.lies]).toEqual(['plan.png', { at: [5, 2.5], width_m: 10, turn_deg: 90, opacity: 0.5 }]);
  // The user's choice has priority.
  await first.choose(picture(), [1, 2], [8, 8]);
  const again = new Underlay(ofFolder);
  await again.open('cottage');
  expect(again.lies.width_m).toBe(4);
});

test('a picture that is chosen before there is a home is kept for it when it is made, and goes where it goes', async () => {
  const before = new Underlay(noPicture);
  await before.choose(picture(), [5, 3.5], [10, 7]);
  expect([before.lies.width_m, store.kept.size]).toEqual([3.5, 0]);
  await before.layUnder('flat');
  await carryUnderlay('flat', 'flat 2', 'copy');
  await carryUnderlay('flat', 'house', 'name');
  await carryUnderlay('no picture', 'shed', 'name');
  expect([...store.kept.keys()]).toEqual(['flat 2', 'house']);
  // Another home with this name has none.
  await new Underlay(noPicture).layUnder('house');
  expect([...store.kept.keys()]).toEqual(['flat 2']);
});
