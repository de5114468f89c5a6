// Layouts of sensors that the user has kept to compare them, until the page is closed.

import type { Drafts } from '../../drafts.svelte';
import { apply, isFault, tree } from '../../json';
import type { Draft } from '../../wire';
import type { Editor } from './editor.svelte';
import { isHome, of, readHome } from './model';

export type Layout = { name: string; sensors: unknown[] };

/** Largest number of layouts. */
const MOST = 20;

export class Layouts {
  kept = $state.raw<Layout[]>([]);

  keep(name: string, sensors: unknown[]): Layout {
    let [fresh, count] = [name, 1];
    while (this.kept.some((layout) => layout.name === fresh)) fresh = `${name} ${++count}`;
    const layout = { name: fresh, sensors };
    this.kept = [...this.kept, layout].slice(-MOST);
    return layout;
  }

  forget(name: string): void {
    this.kept = this.kept.filter((layout) => layout.name !== name);
  }
}

const all = new WeakMap<Drafts, Layouts>();

export function layoutsOf(drafts: Drafts): Layouts {
  let layouts = all.get(drafts);
  if (layouts === undefined) all.set(drafts, (layouts = new Layouts()));
  return layouts;
}

/** The sensors in the present home. */
export function sensorsOf(text: string): unknown[] {
  const home = readHome(text);
  return isHome(home) ? of(home, 'sensors').map(({ value }) => value) : [];
}

/** The home's text with other sensors; null for invalid JSON. */
export function withSensors(text: string, sensors: unknown[]): string | null {
  return isFault(tree(text)) ? null : apply(text, [{ path: ['sensors'], value: sensors }]);
}

/** The drafts with another home. */
export function draftWith({ drafts, file }: Editor, text: string): Draft {
  return { texts: { ...drafts.texts, [file ?? '']: text } };
}

/** The home's text on disk. */
export function savedText({ drafts, file }: Editor): string | null {
  return drafts.files?.files.find(({ name }) => name === file)?.text ?? null;
}
