// The logger's file while it is written: what it says, what is wrong with it, and each change of it as a small change of its
// text. A scenario that has none gets one with the first change.

import { untrack } from 'svelte';
import type { Drafts } from '../../drafts.svelte';
import { type Change, type Path, apply, isObject, pathAt, valueOf } from '../../json';
import type { FilesView, ProblemView } from '../../wire';
import { type Logger, type Sensor, loggerOf, sensorsOf } from './logger';

/** Letters that are typed into one field within this time are taken back together. */
const TOGETHER_MS = 1000;
const KEPT = 200;

export type Placed = { problem: ProblemView; path: Path };

export class Editor {
  /** What the text was, the latest last. */
  private past = $state.raw<string[]>([]);
  private future = $state.raw<string[]>([]);
  private last = { key: '', at_ms: 0 };

  constructor(
    private readonly drafts: Drafts,
    private readonly now_ms: () => number = () => performance.now(),
  ) {}

  /** The file's name; nothing where the scenario links none. */
  readonly name: string | null = $derived.by(() => {
    const { files } = this.drafts;
    if (files === null) return null;
    const link = linkIn(this.drafts.text(files.entry));
    const stored = linkIn(files.files.find(({ name }) => name === files.entry)?.text);
    return link === stored ? files.logger : link;
  });

  readonly text: string = $derived.by(() => (this.name === null ? undefined : this.drafts.text(this.name)) ?? this.fresh());

  private readonly value: unknown = $derived.by(() => valueOf(this.text));

  /** Whether the form can show it. */
  readonly readable: boolean = $derived.by(() => isObject(this.value));

  readonly logger: Logger = $derived.by(() => loggerOf(this.value));

  /** The home's sensors, as its file has them now; of one that cannot be read, none. */
  readonly sensors: Sensor[] | null = $derived.by(() => {
    const { files } = this.drafts;
    return files?.home == null ? null : sensorsOf(valueOf(this.drafts.text(files.home) ?? ''));
  });

  /** What is wrong with the file, and where in it. */
  readonly problems: Placed[] = $derived.by(() => {
    const { check } = this.drafts;
    // The check is of the text as it was when it came; while somebody writes, the next one is on its way.
    const [name, text] = untrack(() => [this.name, this.text]);
    const own = (check?.problems ?? []).filter(({ file }) => file === name);
    return own.map((problem) => ({ problem, path: pathAt(text, problem.line, problem.column) ?? [] }));
  });

  /** What is wrong at a path or below it. */
  at(path: Path): ProblemView[] {
    return this.problems.filter(({ path: of }) => path.every((part, index) => of[index] === part)).map(({ problem }) => problem);
  }

  /** What is wrong, but with none of the form's fields. */
  readonly others: ProblemView[] = $derived.by(() => {
    const fields = ['to', 'table', 'columns', 'ids', 'messages', 'time'];
    return this.problems.filter(({ path }) => !fields.includes(String(path[0]))).map(({ problem }) => problem);
  });

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  set(path: Path, value: unknown): void {
    this.change([{ path, value }], JSON.stringify(path));
  }

  /** Several changes are taken back as one. */
  change(changes: Change[], key = ''): void {
    this.write(apply(this.text, changes), key);
  }

  write(text: string, key = 'text'): void {
    if (text === this.text) return;
    const now = this.now_ms();
    if (key === '' || key !== this.last.key || now - this.last.at_ms > TOGETHER_MS) this.past = [...this.past, this.text].slice(-KEPT);
    this.last = { key, at_ms: now };
    this.future = [];
    this.put(text);
  }

  undo(): void {
    const text = this.past.at(-1);
    if (text === undefined) return;
    this.future = [...this.future, this.text];
    this.past = this.past.slice(0, -1);
    this.last.key = '';
    this.put(text);
  }

  redo(): void {
    const text = this.future.at(-1);
    if (text === undefined) return;
    this.past = [...this.past, this.text];
    this.future = this.future.slice(0, -1);
    this.put(text);
  }

  private put(text: string): void {
    const { files } = this.drafts;
    if (files === null) return;
    let { name } = this;
    if (name === null) {
      const entry = this.drafts.text(files.entry);
      if (entry === undefined) return;
      name = freeName(files, Object.keys(this.drafts.texts));
      this.drafts.write(files.entry, apply(entry, [{ path: ['logger'], value: name }]));
    }
    this.drafts.write(name, text);
  }

  /** The text of a file that is not there yet. Editors find its schema beside the scenario's. */
  private fresh(): string {
    const { files } = this.drafts;
    const entry = files === null ? undefined : valueOf(this.drafts.text(files.entry) ?? '');
    const schema = isObject(entry) && typeof entry.$schema === 'string' ? entry.$schema : '';
    if (!schema.endsWith('scenario.schema.json')) return '{}\n';
    return `${apply('{}', [{ path: ['$schema'], value: schema.replace(/scenario\.schema\.json$/, 'logger.schema.json') }])}\n`;
  }
}

function linkIn(text: string | undefined): string | null {
  const entry = valueOf(text ?? '');
  return isObject(entry) && typeof entry.logger === 'string' ? entry.logger : null;
}

function freeName(files: FilesView, drafted: string[]): string {
  const taken = new Set([...files.files.map(({ name }) => name), ...drafted]);
  for (let number = 1; ; number += 1) {
    const name = number === 1 ? 'logger.json' : `logger-${number}.json`;
    if (!taken.has(name)) return name;
  }
}
