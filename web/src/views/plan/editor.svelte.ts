// The home in the editor: its text, the selection, the tool, and undo. The text is the only state of the home; all else
// is derived from it.

import type { Drafts } from '../../drafts.svelte';
import type { Forget, Named, NamesView, Rename } from '../../wire';
import type { Product } from '../../devices';
import { History } from '../../history.svelte';
import { type Change, type Fault, apply, insert } from '../../json';
import type { At } from '../../plan/geometry';
import { copyOf, type Piece, type SensorKind } from './library';
import { type Element, type Home, type List, type Value, isHome, of, readHome } from './model';
import { turnBy, move } from './move';
import type { Place, Underlay } from './underlay.svelte';

export type Tool =
  | { tool: 'select' }
  | { tool: 'wall' }
  | { tool: 'room' }
  | { tool: 'fill' }
  | { tool: 'door' }
  | { tool: 'place' }
  | { tool: 'furniture'; piece: Piece }
  | { tool: 'sensor'; kind: SensorKind; device?: Product }
  | { tool: 'scale' };

/** Texts of other files that a step has changed: before and after. */
type Others = Record<string, { was: string; is: string }>;

/** The picture under the plan, with its position. */
type Laid = { name: string; place: Place };

type Former = { text: string; selected: string[]; others?: Others; laid?: Laid };

const KINDS: Partial<Record<List, Named>> = { rooms: 'room', doors: 'door', furniture: 'furniture', places: 'place', sensors: 'sensor' };

const SHIFT_M: At = [0.3, -0.3];

export class Editor {
  selected = $state.raw<string[]>([]);
  tool = $state.raw<Tool>({ tool: 'select' });
  /** The clicked corners of the present drawing. */
  drawn = $state.raw<At[]>([]);
  /** The report of the last action. */
  said = $state('');
  copied = $state.raw<{ list: List; value: Value }[]>([]);
  /** References to deleted things, and the texts without them. */
  left = $state.raw<NamesView | null>(null);
  /** The picture under the plan: its position is part of a step. */
  underlay: Pick<Underlay, 'name' | 'lies' | 'lie'> | null = null;
  private readonly history = new History<Former>();
  private known: string | undefined;
  /** The text at the start of a drag. */
  private held: Former | null = null;

  /** The name of the home's file. */
  readonly file: string | null = $derived.by(() => this.drafts.files?.home ?? null);
  readonly text: string | undefined = $derived.by(() => (this.file === null ? undefined : this.drafts.text(this.file)));
  readonly read: Home | Fault | null = $derived.by(() => (this.text === undefined ? null : readHome(this.text)));
  readonly home: Home | null = $derived.by(() => (this.read && isHome(this.read) ? this.read : null));
  readonly fault: Fault | null = $derived.by(() => (this.read && !isHome(this.read) ? this.read : null));
  readonly chosen: Element[] = $derived.by(() => this.selected.flatMap((id) => this.home?.byId.get(id) ?? []));

  constructor(readonly drafts: Drafts) {}

  /** The only selected element. */
  get one(): Element | null {
    return this.chosen.length === 1 ? this.chosen[0]! : null;
  }

  get canUndo(): boolean {
    return this.history.canUndo;
  }

  get canRedo(): boolean {
    return this.history.canRedo;
  }

  get dragging(): boolean {
    return this.held !== null;
  }

  select(ids: string[]): void {
    this.selected = ids;
  }

  hold(tool: Tool): void {
    this.tool = tool;
    this.drawn = [];
    if (tool.tool !== 'select') this.selected = [];
  }

  /** Replaces the text; changes with the same tag that follow at once are one step. */
  write(text: string, tag = '', selected = this.selected): void {
    const before = this.text;
    if (before === undefined || this.file === null || text === before) return;
    this.history.keep({ text: before, selected: this.selected }, tag);
    this.put(text);
    this.selected = selected;
  }

  /** Moves the picture under the plan. */
  lay(part: Partial<Place>, tag = ''): void {
    const { text, laid } = this;
    if (text === undefined || laid === undefined || this.underlay === null) return;
    const known: Partial<Place> = laid.place;
    if (Object.entries(part).every(([name, value]) => JSON.stringify(value) === JSON.stringify(known[name as keyof Place]))) return;
    this.history.keep({ text, selected: this.selected, laid }, tag);
    void this.underlay.lie(part);
  }

  private get laid(): Laid | undefined {
    if (this.underlay === null) return undefined;
    const { name, lies: { at, width_m, turn_deg } } = this.underlay;
    return { name, place: { at, width_m, turn_deg } };
  }

  /** Replaces the texts of several files, as one step. */
  writeAll(texts: Record<string, string>): void {
    const { [this.file ?? '']: own, ...rest } = texts;
    const before = this.text;
    if (before === undefined) return;
    const others: Others = Object.fromEntries(Object.entries(rest).flatMap(([name, is]) => {
      const was = this.drafts.text(name);
      return was === undefined || was === is ? [] : [[name, { was, is }]];
    }));
    this.history.keep({ text: before, selected: this.selected, others });
    for (const [name, { is }] of Object.entries(others)) this.drafts.write(name, is);
    if (own !== undefined) this.put(own);
  }

  /** Renames a thing in all files at once. */
  async rename(element: Element, name: string, alone: () => void): Promise<void> {
    const kind = KINDS[element.list];
    if (kind === undefined || element.name === '' || element.name === name) return alone();
    const { text } = this;
    try {
      const asked = { draft: this.drafts.draft, kind, from: element.name, to: name } satisfies Rename;
      const { mentions, texts, is_shared } = await this.drafts.server.post<NamesView>('/api/rename', asked);
      // The user has changed the text meanwhile.
      if (this.text !== text || this.file === null) return alone();
      if (texts[this.file] === undefined) {
        alone();
        if (is_shared) this.said = 'Renamed only here. Another element has the same name, and other files may refer to that one.';
        return;
      }
      this.writeAll(texts);
      const files = new Set(mentions.map(({ file }) => file).filter((file) => file !== this.file));
      this.said = `Renamed${files.size > 0 ? `, also in ${[...files].join(', ').slice(0, 200)}` : ''}.`;
    } catch {
      alone();
    }
  }

  /** Requests references to deleted things. */
  private async forget(gone: Element[]): Promise<void> {
    const { text } = this;
    const left: NamesView = { mentions: [], texts: {}, is_shared: false };
    for (const [list, kind] of Object.entries(KINDS)) {
      const names = gone.filter((element) => element.list === list && element.name !== '').map(({ name }) => name);
      if (names.length === 0 || kind === undefined) continue;
      try {
        const draft = { texts: { ...this.drafts.texts, ...left.texts } };
        const found = await this.drafts.server.post<NamesView>('/api/forget', { draft, kind, names } satisfies Forget);
        left.mentions.push(...found.mentions);
        Object.assign(left.texts, found.texts);
      } catch {
        return;
      }
    }
    if (this.text === text && left.mentions.length > 0) this.left = left;
  }

  /** Removes references to deleted things. */
  forgetAll(): void {
    const { left } = this;
    this.left = null;
    if (left) this.writeAll(left.texts);
  }

  change(changes: Change[], tag = ''): void {
    if (this.text !== undefined && changes.length > 0) this.write(apply(this.text, changes), tag);
  }

  /** Starts a drag: until it ends, all changes are one step. */
  begin(): { home: Home } | null {
    if (this.home === null || this.text === undefined) return null;
    this.held = { text: this.text, selected: this.selected };
    return { home: this.home };
  }

  drag(changes: Change[]): void {
    if (this.held) this.put(apply(this.held.text, changes));
  }

  end(): void {
    const { held } = this;
    this.held = null;
    if (held && this.text !== held.text) this.history.keep(held);
  }

  cancel(): void {
    if (this.held) this.put(this.held.text);
    this.held = null;
  }

  undo(): void {
    this.step('undo');
  }

  redo(): void {
    this.step('redo');
  }

  /** Changes from elsewhere can be undone, too. */
  notice(): void {
    const { text } = this;
    if (text === this.known) return;
    if (this.known !== undefined && text !== undefined) {
      this.held = null;
      this.history.keep({ text: this.known, selected: [] });
      this.selected = this.selected.filter((id) => this.home?.byId.has(id));
    }
    this.known = text;
  }

  add(list: List, value: Value): void {
    if (this.home === null) return;
    const count = this.home.elements.filter((element) => element.list === list).length;
    this.write(insert(this.home.text, list, value), '', [`${list}/${count}`]);
  }

  delete(): void {
    const { home, chosen } = this;
    if (home === null || chosen.length === 0) return;
    this.write(apply(home.text, chosen.map(({ list, index }) => ({ path: [list, index], value: undefined }))), '', []);
    this.left = null;
    void this.forget(chosen);
  }

  /** Replaces sensors by others, as one step, and reports references to the old ones. */
  exchange(gone: Element[], fresh: Value[]): void {
    const { home } = this;
    if (home === null) return;
    const kept = of(home, 'sensors').length - gone.length;
    const without = apply(home.text, gone.map(({ list, index }) => ({ path: [list, index], value: undefined })));
    this.write(fresh.reduce((text, sensor) => insert(text, 'sensors', sensor), without), '', fresh.map((_, index) => `sensors/${kept + index}`));
    this.left = null;
    const names = new Set(fresh.map(({ name }) => name));
    void this.forget(gone.filter(({ name }) => !names.has(name)));
  }

  copy(): void {
    if (this.chosen.length > 0) this.copied = this.chosen.map(({ list, value }) => ({ list, value }));
  }

  paste(): void {
    const pasted: string[] = [];
    let home = this.home;
    for (const { list, value } of this.copied) {
      if (home === null) return;
      const like = { id: '', list, index: 0, name: typeof value.name === 'string' ? value.name : '', value, offset: 0, length: 0 };
      const count = home.elements.filter((element) => element.list === list).length;
      const next = readHome(insert(home.text, list, copyOf(home, like)));
      if (!isHome(next)) return;
      home = next;
      pasted.push(`${list}/${count}`);
    }
    if (home === null || pasted.length === 0) return;
    const elements = pasted.flatMap((id) => home.byId.get(id) ?? []);
    const { changes } = move(home, elements, SHIFT_M, { snapping: null, alone: true });
    this.write(apply(home.text, changes), '', pasted);
    // A second copy is placed next to the first.
    this.copied = this.chosen.map(({ list, value }) => ({ list, value }));
  }

  duplicate(): void {
    const { copied } = this;
    this.copy();
    this.paste();
    this.copied = copied;
  }

  nudge(by: At, alone: boolean): void {
    if (this.home === null) return;
    this.change(move(this.home, this.chosen, by, { snapping: null, alone }).changes, `nudge ${this.selected.join()}`);
  }

  turn(deg: number): void {
    this.change(this.chosen.flatMap((element) => turnBy(element, deg)), `turn ${this.selected.join()}`);
  }

  private step(way: 'undo' | 'redo'): void {
    if (this.text === undefined) return;
    const now: Former = { ...(this.held ?? { text: this.text, selected: this.selected }) };
    const former = this.history[way](now);
    if (former === undefined) return;
    this.held = null;
    this.left = null;
    // The picture may be another one by now.
    if (former.laid !== undefined && former.laid.name === this.laid?.name) {
      now.laid = this.laid;
      void this.underlay?.lie(former.laid.place);
    }
    now.others = {};
    for (const [name, { was, is }] of Object.entries(former.others ?? {})) {
      // Later changes of the file stay.
      if (this.drafts.text(name) !== is) continue;
      this.drafts.write(name, was);
      now.others[name] = { was: is, is: was };
    }
    this.put(former.text);
    this.selected = former.selected.filter((id) => this.home?.byId.has(id));
    this.drawn = [];
  }

  private put(text: string): void {
    if (this.file === null) return;
    this.known = text;
    this.drafts.write(this.file, text);
  }
}

const editors = new WeakMap<Drafts, Editor>();

/** One editor for the lifetime of the drafts, so that steps can be undone after a visit of another view. */
export function editorOf(drafts: Drafts): Editor {
  let editor = editors.get(drafts);
  if (editor === undefined) {
    // Its derived values must outlive the view that asked first.
    $effect.root(() => {
      editor = new Editor(drafts);
    });
    editors.set(drafts, editor!);
  }
  return editor!;
}
