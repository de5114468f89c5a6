// The logger's file during editing: its values, its problems, and each change of it as a small change of its text. A
// scenario without one gets one with the first change.

import { untrack } from 'svelte';
import type { Drafts } from '../../drafts.svelte';
import { History } from '../../history.svelte';
import { type Change, type Path, apply, isObject, pathAt, valueOf } from '../../json';
import type { FilesView, ProblemView } from '../../wire';
import { type Logger, type Sensor, loggerOf, sensorsOf } from './logger';

type Placed = { problem: ProblemView; path: Path };

export class Editor {
  private readonly history = new History<{ text: string }>();
  /** The last known text. */
  private known: string | undefined;

  constructor(private readonly drafts: Drafts) {}

  /** The file's name; null if the scenario links none. */
  readonly name: string | null = $derived.by(() => {
    const { files } = this.drafts;
    if (files === null) return null;
    const link = linkIn(this.drafts.text(files.entry));
    const stored = linkIn(files.files.find(({ name }) => name === files.entry)?.text);
    return link === stored ? files.logger : link;
  });

  readonly text: string = $derived.by(() => (this.name === null ? undefined : this.drafts.text(this.name)) ?? this.fresh());

  private readonly value: unknown = $derived.by(() => valueOf(this.text));

  /** The form can show it. */
  readonly readable: boolean = $derived.by(() => isObject(this.value));

  readonly logger: Logger = $derived.by(() => loggerOf(this.value));

  /** The home's sensors, from its present text; null if it cannot be read. */
  readonly sensors: Sensor[] | null = $derived.by(() => {
    const { files } = this.drafts;
    return files?.home == null ? null : sensorsOf(valueOf(this.drafts.text(files.home) ?? ''));
  });

  /** The problems of the file, with their paths. */
  readonly problems: Placed[] = $derived.by(() => {
    const { check } = this.drafts;
    // The check belongs to its text; while the user types, the next one is on its way.
    const [name, text] = untrack(() => [this.name, this.text]);
    const own = (check?.problems ?? []).filter(({ file }) => file === name);
    return own.map((problem) => ({ problem, path: pathAt(text, problem.line, problem.column) ?? [] }));
  });

  /** The problems at a path or below it. */
  at(path: Path): ProblemView[] {
    return this.problems.filter(({ path: of }) => path.every((part, index) => of[index] === part)).map(({ problem }) => problem);
  }

  /** The problems outside of the form's fields. */
  readonly others: ProblemView[] = $derived.by(() => {
    const fields = ['to', 'table', 'columns', 'ids', 'messages', 'time'];
    return this.problems.filter(({ path }) => !fields.includes(String(path[0]))).map(({ problem }) => problem);
  });

  get canUndo(): boolean {
    return this.history.canUndo;
  }

  get canRedo(): boolean {
    return this.history.canRedo;
  }

  set(path: Path, value: unknown): void {
    this.change([{ path, value }], JSON.stringify(path));
  }

  /** Several changes are one step, and so are changes of one field at once. */
  change(changes: Change[], tag = ''): void {
    this.write(apply(this.text, changes), tag);
  }

  write(text: string, tag = 'text'): void {
    if (text === this.text) return;
    this.history.keep({ text: this.text }, tag);
    this.put(text);
  }

  /** A change from elsewhere is a step, too. */
  notice(): void {
    const { text } = this;
    if (this.known !== undefined && text !== this.known) this.history.keep({ text: this.known });
    this.known = text;
  }

  undo(): void {
    const former = this.history.undo({ text: this.text });
    if (former) this.put(former.text);
  }

  redo(): void {
    const next = this.history.redo({ text: this.text });
    if (next) this.put(next.text);
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
    this.known = text;
  }

  /** The text of a missing file. Editors find its schema next to the scenario's. */
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
