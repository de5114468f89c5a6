// Helpers of the tests of views: a socket without a server, and functions that act and look like a user.

import { flushSync } from 'svelte';
import { expect } from 'vitest';
import type { Wire } from '../socket';

/** A name that would be a picture and a script if it were not shown as text. */
export const EVIL = '<img src=x onerror="globalThis.broken=1"><script>globalThis.broken=1</script>';

export function fakeWire(send: (text: string) => void = () => {}): Wire {
  return { binaryType: '', onopen: null, onmessage: null, onclose: null, onerror: null, send, close: () => {} };
}

/** The first button whose name starts so. */
export function button(name: string): HTMLButtonElement {
  return [...document.querySelectorAll('button')].find((one) => (one.getAttribute('aria-label') ?? one.textContent!).trim().startsWith(name))!;
}

/** The field of a label. */
export function fieldOf(label: string): HTMLInputElement {
  return [...document.querySelectorAll('label')].find((one) => one.textContent!.trim() === label)!.control as HTMLInputElement;
}

export function write(field: HTMLInputElement | HTMLSelectElement, value: string, event: 'input' | 'change' = 'input'): void {
  field.value = value;
  field.dispatchEvent(new Event(event, { bubbles: true }));
  flushSync();
}

/** Hostile names are shown, and only as text. */
export function expectText(name: string): void {
  expect(document.body.textContent).toContain(name);
  expect(document.querySelectorAll('img, script')).toHaveLength(0);
  expect((globalThis as { broken?: number }).broken).toBeUndefined();
}
