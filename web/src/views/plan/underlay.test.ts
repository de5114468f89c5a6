import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Underlay } from './underlay.svelte';

/** A browser's store, which may be full: then a request succeeds and its transaction does not. */
class Store {
  readonly kept = new Map<string, unknown>();
  isFull = false;
  opened = 0;
  closed = 0;

  open() {
    const opening = { result: this.database(), onsuccess: () => {} };
    queueMicrotask(() => {
      this.opened += 1;
      opening.onsuccess();
    });
    return opening;
  }

  private database() {
    const transaction = { error: null as Error | null, oncomplete: () => {}, onabort: () => {}, objectStore: () => objects };
    const objects = {
      get: (key: string) => request(this.kept.get(key)),
      put: (value: unknown, key: string) => {
        if (!this.isFull) this.kept.set(key, value);
        return request(key);
      },
    };
    const request = (result: unknown) => {
      const request = { result, transaction, onsuccess: () => {}, onerror: () => {} };
      queueMicrotask(() => {
        request.onsuccess();
        transaction.error = this.isFull ? new Error('QuotaExceededError') : null;
        if (this.isFull) transaction.onabort();
        else transaction.oncomplete();
      });
      return request;
    };
    return { transaction: () => transaction, close: () => (this.closed += 1) };
  }
}

let store: Store;
let underlay: Underlay;
const noPicture = { json: <T>() => Promise.resolve(null as T), file: () => Promise.reject(new Error('no picture')) };
const picture = () => new File(['a picture'], 'plan.png', { type: 'image/png' });

beforeEach(async () => {
  store = new Store();
  vi.stubGlobal('indexedDB', store);
  vi.stubGlobal('Image', class { decode = () => Promise.resolve(); });
  underlay = new Underlay(noPicture);
  await underlay.open('cottage');
});

afterEach(() => vi.unstubAllGlobals());

test('a picture is kept by the scenario’s name', async () => {
  await underlay.choose(picture(), [1, 2], 8);
  expect(underlay.problem).toBe('');
  const again = new Underlay(noPicture);
  await again.open('cottage');
  expect([again.name, again.lies]).toEqual(['plan.png', { at: [1, 2], width_m: 8, turn_deg: 0, opacity: 0.5 }]);
  expect(store.closed).toBe(store.opened);
});

test('a picture that a full store does not keep is said so', async () => {
  store.isFull = true;
  await underlay.choose(picture(), [1, 2], 8);
  expect([underlay.name, underlay.problem]).toEqual(['plan.png', 'The browser does not keep the picture: choose it again next time.']);
  expect(store.closed).toBe(store.opened);
});

test('a picture of the scenario’s folder is shown where the browser has none', async () => {
  const lies = { picture: 'plan.png', at: [5, 2.5], width_m: 10, turn_deg: 90 };
  const ofFolder = { json: <T>() => Promise.resolve(lies as T), file: () => Promise.resolve({ blob: picture(), name: 'x' }) };
  const first = new Underlay(ofFolder);
  await first.open('cottage');
  expect([first.name, first.lies]).toEqual(['plan.png', { at: [5, 2.5], width_m: 10, turn_deg: 90, opacity: 0.5 }]);
  // What somebody has chosen here comes before it.
  await first.choose(picture(), [1, 2], 8);
  const again = new Underlay(ofFolder);
  await again.open('cottage');
  expect(again.lies.width_m).toBe(8);
});
