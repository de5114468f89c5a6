// The home as somebody edits it: its text, what is selected, which tool is held, and the way back. The text is the only state
// of the home; all else is read from it.

import type { Drafts } from '../../drafts.svelte';
import { type Change, type Fault, apply, insert } from '../../json';
import type { At } from '../../plan/geometry';
import { copyOf, type Piece, type SensorKind } from './library';
import { type Element, type Home, type List, type Value, isHome, readHome } from './model';
import { turnBy, move } from './move';

export type Tool =
  | { tool: 'select' }
  | { tool: 'wall' }
  | { tool: 'room' }
  | { tool: 'fill' }
  | { tool: 'door' }
  | { tool: 'place' }
  | { tool: 'furniture'; piece: Piece }
  | { tool: 'sensor'; kind: SensorKind }
  | { tool: 'scale' };

type Former = { text: string; selected: string[] };

/** Steps back that are kept, and letters in all of them. */
const MOST_STEPS = 300;
const MOST_LETTERS = 60_000_000;
/** Changes of one kind that follow each other faster than this are one step. */
const ONE_STEP_MS = 900;

const SHIFT_M: At = [0.3, -0.3];

export class Editor {
  selected = $state.raw<string[]>([]);
  tool = $state.raw<Tool>({ tool: 'select' });
  /** Corners that were clicked of what is being drawn. */
  drawn = $state.raw<At[]>([]);
  /** What is said about the last thing done. */
  said = $state('');
  copied = $state.raw<{ list: List; value: Value }[]>([]);
  private past = $state.raw<Former[]>([]);
  private future = $state.raw<Former[]>([]);
  private last: { tag: string; at_ms: number } | null = null;
  private known: string | undefined;
  /** The text as it was when a drag began. */
  private held: Former | null = null;

  /** The name of the home's file. */
  readonly file: string | null = $derived.by(() => this.drafts.files?.home ?? null);
  readonly text: string | undefined = $derived.by(() => (this.file === null ? undefined : this.drafts.text(this.file)));
  readonly read: Home | Fault | null = $derived.by(() => (this.text === undefined ? null : readHome(this.text)));
  readonly home: Home | null = $derived.by(() => (this.read && isHome(this.read) ? this.read : null));
  readonly fault: Fault | null = $derived.by(() => (this.read && !isHome(this.read) ? this.read : null));
  readonly chosen: Element[] = $derived.by(() => this.selected.flatMap((id) => this.home?.byId.get(id) ?? []));
  readonly canUndo: boolean = $derived.by(() => this.past.length > 0);
  readonly canRedo: boolean = $derived.by(() => this.future.length > 0);

  constructor(readonly drafts: Drafts) {}

  /** The one element that is selected. */
  get one(): Element | null {
    return this.chosen.length === 1 ? this.chosen[0]! : null;
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

  /** Another text takes the place of the one there is; what has the same tag and follows at once is one step. */
  write(text: string, tag = '', selected = this.selected): void {
    const before = this.text;
    if (before === undefined || this.file === null || text === before) return;
    const now = Date.now();
    const goesOn = tag !== '' && this.last?.tag === tag && now - this.last.at_ms < ONE_STEP_MS;
    if (!goesOn) this.keep({ text: before, selected: this.selected });
    this.last = { tag, at_ms: now };
    this.put(text);
    this.selected = selected;
  }

  change(changes: Change[], tag = ''): void {
    if (this.text !== undefined && changes.length > 0) this.write(apply(this.text, changes), tag);
  }

  /** A drag begins: until it ends nothing is a step of its own. */
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
    if (held && this.text !== held.text) this.keep(held);
    this.last = null;
  }

  cancel(): void {
    if (this.held) this.put(this.held.text);
    this.held = null;
  }

  undo(): void {
    this.step('past', 'future');
  }

  redo(): void {
    this.step('future', 'past');
  }

  /** What was written by somebody else can be undone, too. */
  notice(): void {
    const { text } = this;
    if (text === this.known) return;
    if (this.known !== undefined && text !== undefined) {
      this.held = null;
      this.keep({ text: this.known, selected: [] });
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
    // Pasted again it comes to lie beside.
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

  private step(from: 'past' | 'future', to: 'past' | 'future'): void {
    const former = this[from].at(-1);
    if (former === undefined || this.text === undefined) return;
    this.cancel();
    this[to] = [...this[to], { text: this.text, selected: this.selected }];
    this[from] = this[from].slice(0, -1);
    this.last = null;
    this.put(former.text);
    this.selected = former.selected.filter((id) => this.home?.byId.has(id));
    this.drawn = [];
  }

  private put(text: string): void {
    if (this.file === null) return;
    this.known = text;
    this.drafts.write(this.file, text);
  }

  private keep(former: Former): void {
    const past = [...this.past, former].slice(-MOST_STEPS);
    let letters = past.reduce((sum, { text }) => sum + text.length, 0);
    while (past.length > 1 && letters > MOST_LETTERS) letters -= past.shift()!.text.length;
    this.past = past;
    this.future = [];
  }
}

const editors = new WeakMap<Drafts, Editor>();

/** One editor as long as there are these drafts, so that what was done can be undone after another view was looked at. */
export function editorOf(drafts: Drafts): Editor {
  let editor = editors.get(drafts);
  if (editor === undefined) {
    // What is derived in it must not end with the view that was the first to ask.
    $effect.root(() => {
      editor = new Editor(drafts);
    });
    editors.set(drafts, editor!);
  }
  return editor!;
}
