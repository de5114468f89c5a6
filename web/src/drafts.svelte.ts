// The scenario's files as the user edits them: the text on disk, the changes since, and their problems. All editing
// views share one object, so that a moved wall and a new sentence are checked and saved together.

import { Latest } from './latest';
import { type Server, said } from './server';
import type { CheckView, Draft, FileView, FilesView, Save, SavedView } from './wire';

/** Time from the last key until the check. */
const PAUSE_MS = 250;
/** Interval of looking for changes by others. */
const LOOK_MS = 2000;

/** The label of a fix, and the texts before and after it. */
type AppliedFix = { what: string; changed: { name: string; was: string; is: string }[] };

export class Drafts {
  files = $state.raw<FilesView | null>(null);
  /** Unsaved texts, by file name. */
  texts = $state.raw<Record<string, string>>({});
  /** Problems of all files; while the user types, those of a moment ago. */
  check = $state.raw<CheckView | null>(null);
  /** The drafts that were checked. */
  private checkedTexts = $state.raw<Draft['texts'] | null>(null);
  /** Files on disk that another program changed while there are drafts of them; without a version if they are deleted. */
  changed = $state.raw<FileView[]>([]);
  saving = $state(false);
  private applied = $state.raw<AppliedFix | null>(null);
  /** The last existing files: they can be written back after all are deleted. */
  private whole = $state.raw<FileView[]>([]);

  private readonly checks: Latest<Draft, CheckView>;
  /** Grows with each load and each save: answers to earlier requests are outdated. */
  private loads = 0;
  /** Saved files have not been loaded yet: a change of the scenario's file may change the list of files. */
  private behind = false;

  /** @param note shows a message. */
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

  /** The server has restarted: unsaved texts stay. */
  reconnect(server: Server, note: (text: string, bad: boolean) => void): void {
    [this.server, this.note] = [server, note];
  }

  get unsaved(): string[] {
    return Object.keys(this.texts).sort();
  }

  /** No file of the scenario is on disk any more; there may still be drafts. */
  get isDeleted(): boolean {
    const gone = new Set(this.changed.flatMap(({ name, version }) => (version === '' ? [name] : [])));
    return this.files !== null && this.files.files.every(({ name, version }) => version === '' || gone.has(name));
  }

  get draft(): Draft {
    return { texts: this.texts };
  }

  /** The known problems are those of the present texts. */
  get isChecked(): boolean {
    return this.checkedTexts === this.texts;
  }

  /** Loads the files, and polls them until the returned function is called. */
  open(): () => void {
    void this.look();
    const timer = setInterval(() => void this.look(), LOOK_MS);
    return () => clearInterval(timer);
  }

  /** The draft, or the text on disk. */
  text(name: string): string | undefined {
    return this.texts[name] ?? this.onDisk(name)?.text;
  }

  write(name: string, text: string): void {
    const texts = { ...this.texts, [name]: text };
    if (this.onDisk(name)?.text === text) delete texts[name];
    this.texts = texts;
    this.checkSoon();
  }

  /** Replaces texts by fixed ones. */
  applyFix(what: string, texts: Record<string, string>): void {
    const changed = Object.entries(texts).flatMap(([name, is]) => {
      const was = this.text(name);
      return was === undefined || was === is ? [] : [{ name, was, is }];
    });
    for (const { name, is } of changed) this.write(name, is);
    this.applied = { what, changed };
  }

  /** The last fix, until one of its texts changes. */
  get lastFix(): AppliedFix | null {
    const { applied } = this;
    return applied !== null && applied.changed.length > 0 && applied.changed.every(({ name, is }) => this.text(name) === is) ? applied : null;
  }

  /** Undoes the last fix. */
  undoFix(): void {
    for (const { name, was } of this.lastFix?.changed ?? []) this.write(name, was);
    this.applied = null;
  }

  /** Drops a draft. */
  discard(name: string): void {
    const theirs = this.changed.find((file) => file.name === name);
    if (theirs) this.take(theirs);
    const { [name]: _, ...texts } = this.texts;
    this.texts = texts;
    this.checkSoon();
  }

  /** Keeps a draft although its file has changed: saving replaces the version that is known now. */
  keepDraft(name: string): void {
    const theirs = this.changed.find((file) => file.name === name);
    if (theirs) this.take(theirs);
  }

  /** Saves all drafts, or those of some files; nothing if a file has changed meanwhile. */
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
        // Texts that changed during the save remain drafts.
        if (this.texts[name] === text) {
          const { [name]: _, ...texts } = this.texts;
          this.texts = texts;
        }
      }
      this.behind = true;
      // The files are saved all the same; the next poll loads them.
      await this.reload().catch(() => {});
      return true;
    } catch (error) {
      this.note(`Not saved: ${said(error)}`, true);
      return false;
    } finally {
      this.saving = false;
    }
  }

  /** The number of files to write back if the home is deleted. */
  get kept(): number {
    return this.whole.length;
  }

  /** Writes the last existing files with their drafts, if none is on disk any more. */
  async writeBack(): Promise<void> {
    if (this.saving || this.files === null) return;
    this.texts = { ...Object.fromEntries(this.whole.map(({ name, text }) => [name, text])), ...this.texts };
    [this.files, this.changed] = [{ ...this.files, files: [] }, []];
    await this.save();
  }

  private onDisk(name: string): FileView | undefined {
    return this.files?.files.find((file) => file.name === name);
  }

  private take(file: FileView): void {
    if (this.files === null) return;
    const others = this.files.files.filter(({ name }) => name !== file.name);
    this.files = { ...this.files, files: [...others, file].sort(byName) };
    this.changed = this.changed.filter(({ name }) => name !== file.name);
  }

  /** Notes files that differ from the known versions. */
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
      // The header reports the lost connection; the poll tries again.
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
      // A file with a draft keeps the base of the draft until the user decides.
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
