// The scenario's files as somebody writes them: what is on disk, what was written since, and what is wrong with it. The views
// that edit share one of these, so that a wall moved in one and a sentence written in another are checked and saved together.

import { Latest } from './latest';
import { type Server, said } from './server';
import type { CheckView, Draft, FileView, FilesView, Save, SavedView } from './wire';

/** How long after the last key everything is checked. */
const PAUSE_MS = 250;
/** How often is looked whether somebody else has changed a file. */
const LOOK_MS = 2000;

/** What a button has mended, and the texts as they were before. */
type Mended = { what: string; changed: { name: string; was: string; is: string }[] };

export class Drafts {
  files = $state.raw<FilesView | null>(null);
  /** What was written and is not saved yet, by the file's name. */
  texts = $state.raw<Record<string, string>>({});
  /** What is wrong with all of it; of a moment ago, while somebody writes. */
  check = $state.raw<CheckView | null>(null);
  /** The drafts that it is of. */
  private checkedTexts = $state.raw<Draft['texts'] | null>(null);
  /** Files that another program has changed while there are drafts of them, as they are on disk now; without a version where they are gone. */
  changed = $state.raw<FileView[]>([]);
  saving = $state(false);
  private lastMend = $state.raw<Mended | null>(null);
  /** The files as they were when some were there last: they can be written back once none is. */
  private whole = $state.raw<FileView[]>([]);

  private readonly checks: Latest<Draft, CheckView>;
  /** Grows with each load and each save: what was asked before is older than what is known. */
  private loads = 0;
  /** Whether what was saved has not been loaded yet: with a file of the scenario the others may be other ones. */
  private behind = false;

  /** @param note tells people what happened. */
  constructor(
    public server: Server,
    private note: (text: string, bad: boolean) => void,
  ) {
    this.checks = new Latest(
      PAUSE_MS,
      (draft) => this.server.post<CheckView>('/api/check', draft),
      (check, { texts }) => ([this.check, this.checkedTexts] = [check, texts]),
      (why) => this.note(`Cannot check the files: ${why}`, true),
    );
  }

  /** The server has begun anew: what was written here stays. */
  meet(server: Server, note: (text: string, bad: boolean) => void): void {
    [this.server, this.note] = [server, note];
  }

  get unsaved(): string[] {
    return Object.keys(this.texts).sort();
  }

  /** Whether none of the scenario's files is on the disk any more; drafts of some may be here still. */
  get isGone(): boolean {
    const gone = new Set(this.changed.flatMap(({ name, version }) => (version === '' ? [name] : [])));
    return this.files !== null && this.files.files.every(({ name, version }) => version === '' || gone.has(name));
  }

  get draft(): Draft {
    return { texts: this.texts };
  }

  /** Whether what is known to be wrong is wrong with what is written now. */
  get isChecked(): boolean {
    return this.checkedTexts === this.texts;
  }

  /** Loads what is on disk, and looks at it until the function that is returned is called. */
  open(): () => void {
    void this.look();
    const timer = setInterval(() => void this.look(), LOOK_MS);
    return () => clearInterval(timer);
  }

  /** The text as it was written, or as it is on disk. */
  text(name: string): string | undefined {
    return this.texts[name] ?? this.onDisk(name)?.text;
  }

  write(name: string, text: string): void {
    const texts = { ...this.texts, [name]: text };
    if (this.onDisk(name)?.text === text) delete texts[name];
    this.texts = texts;
    this.checkSoon();
  }

  /** Texts that mend something take the places of those there are. */
  mend(what: string, texts: Record<string, string>): void {
    const changed = Object.entries(texts).flatMap(([name, is]) => {
      const was = this.text(name);
      return was === undefined || was === is ? [] : [{ name, was, is }];
    });
    for (const { name, is } of changed) this.write(name, is);
    this.lastMend = { what, changed };
  }

  /** The last mend, as long as nothing was written over it. */
  get mended(): Mended | null {
    const { lastMend } = this;
    return lastMend !== null && lastMend.changed.length > 0 && lastMend.changed.every(({ name, is }) => this.text(name) === is) ? lastMend : null;
  }

  /** What the last mend has changed is as it was. */
  unmend(): void {
    for (const { name, was } of this.mended?.changed ?? []) this.write(name, was);
    this.lastMend = null;
  }

  /** Back to what is on disk. */
  discard(name: string): void {
    const theirs = this.changed.find((file) => file.name === name);
    if (theirs) this.take(theirs);
    const { [name]: _, ...texts } = this.texts;
    this.texts = texts;
    this.checkSoon();
  }

  /** What was written stays, though the file has changed: saving it replaces what has been seen now. */
  insist(name: string): void {
    const theirs = this.changed.find((file) => file.name === name);
    if (theirs) this.take(theirs);
  }

  /** Writes all drafts, or those of some files; nothing where a file has changed meanwhile. */
  async save(names = this.unsaved): Promise<boolean> {
    const files = names.flatMap((name) => {
      const text = this.texts[name];
      return text === undefined ? [] : [{ name, text, version: this.onDisk(name)?.version ?? null }];
    });
    if (files.length === 0 || this.saving) return files.length === 0;
    this.saving = true;
    this.loads += 1;
    try {
      const { saved, changed } = await this.server.post<SavedView>('/api/files', { files } satisfies Save);
      if (changed.length > 0) {
        this.differ(changed);
        return false;
      }
      for (const { name, text } of files) {
        this.take({ name, text, version: saved[name]! });
        // What was written while it was being saved is a draft still.
        if (this.texts[name] === text) {
          const { [name]: _, ...texts } = this.texts;
          this.texts = texts;
        }
      }
      this.behind = true;
      // It is saved all the same; the next look loads it.
      await this.reload().catch(() => {});
      return true;
    } catch (error) {
      this.note(`Not saved: ${said(error)}`, true);
      return false;
    } finally {
      this.saving = false;
    }
  }

  /** How many files are written back where the home is gone. */
  get kept(): number {
    return this.whole.length;
  }

  /** Writes the files that were there last, with what was written since, where none is on the disk any more. */
  async writeBack(): Promise<void> {
    if (this.saving || this.files === null) return;
    this.texts = { ...Object.fromEntries(this.whole.map(({ name, text }) => [name, text])), ...this.texts };
    [this.files, this.changed] = [{ ...this.files, files: [] }, []];
    await this.save();
  }

  private onDisk(name: string): FileView | undefined {
    return this.files?.files.find((file) => file.name === name);
  }

  /** Another text is on disk now. */
  private take(file: FileView): void {
    if (this.files === null) return;
    const others = this.files.files.filter(({ name }) => name !== file.name);
    this.files = { ...this.files, files: [...others, file].sort(byName) };
    this.changed = this.changed.filter(({ name }) => name !== file.name);
  }

  /** Files that are another on disk than was thought. */
  private differ(theirs: FileView[]): void {
    const drafted = theirs.filter(({ name, text }) => name in this.texts && this.texts[name] !== text);
    for (const file of theirs) if (!drafted.includes(file)) this.take(file);
    if (drafted.length > 0) this.changed = drafted;
  }

  private async look(): Promise<void> {
    if (this.saving) return;
    try {
      if (this.files === null || this.behind) {
        await this.reload();
        return;
      }
      const versions = await this.server.json<Record<string, string>>('/api/files/versions');
      const known = new Map([...this.files.files, ...this.changed].map(({ name, version }) => [name, version]));
      const names = new Set([...known.keys(), ...Object.keys(versions)]);
      if (!this.saving && [...names].some((name) => known.get(name) !== versions[name])) await this.reload();
    } catch {
      // The header says that there is no connection; it is tried again.
    }
  }

  private async reload(): Promise<void> {
    const load = ++this.loads;
    const fresh = await this.server.json<FilesView>('/api/files');
    if (load !== this.loads) return;
    this.behind = false;
    const before = this.files;
    if (before === null) {
      this.files = fresh;
    } else {
      // Of a file that has a draft, what the draft was made from stays until somebody has decided.
      const there = (files: FileView[], name: string) => files.find((file) => file.name === name) ?? { name, text: '', version: '' };
      const drafted = Object.keys(this.texts).map((name) => there(before.files, name));
      const now = (name: string) => there(fresh.files, name);
      const isAnother = (old: FileView) => now(old.name).version !== old.version && now(old.name).text !== this.texts[old.name];
      const held = drafted.filter(isAnother);
      const others = fresh.files.filter(({ name }) => !held.some((old) => old.name === name));
      const changed = held.map(({ name }) => now(name));
      this.files = { ...fresh, files: [...others, ...held].sort(byName) };
      this.changed = changed;
    }
    const texts = Object.entries(this.texts).filter(([name, text]) => this.onDisk(name)?.text !== text);
    this.texts = Object.fromEntries(texts);
    if (fresh.files.length > 0) this.whole = this.files.files;
    this.checkSoon();
  }

  private checkSoon(): void {
    this.checks.want(this.draft);
  }
}

function byName(a: FileView, b: FileView): number {
  return a.name < b.name ? -1 : 1;
}
