// A folder of homes: its content, the last requests, and the deletions that can be undone.

import { type Server, said } from '../../server';
import { Underlay, carryUnderlay } from '../plan/underlay.svelte';
import type { CallHome, CardView, DeletedHome, DeletedKey, HomeEntryView, LibraryView, MadeView, NewHome } from '../../wire';

/** Number of cards that are requested at once (our choice): the server checks a scenario for each. */
const AT_ONCE = 2;

type Note = { text: string; bad: boolean };

/** A home that was deleted in this page: the name of the next home, the height of its card, and the reason why it could not be restored. */
export type Deleted = { home: HomeEntryView; aside: DeletedHome; before: string | null; height_px: number; problem: string };

/** An item of the library. */
type Entry = { key: string; home: HomeEntryView; deleted: Deleted | null };

/** The origin of a new home. */
export type From = { kind: 'empty' } | { kind: 'template'; name: string } | { kind: 'plan' | 'image' | 'log'; file: File };

/** The position of a picture in an empty home, in metres: in the middle of the plan view, and nearly as large. */
const PICTURE = { at: [5, 3.5], within_m: [10, 7] } as const;

const MOST_LETTERS = 100;

export class Library {
  view = $state.raw<LibraryView | null>(null);
  /** By the home's name. */
  cards = $state.raw<Record<string, CardView | string>>({});
  note = $state.raw<Note | null>(null);
  private deleted = $state.raw<Deleted[]>([]);
  private waiting: (() => Promise<void>)[] = [];
  private busy = 0;

  constructor(private readonly server: Server) {}

  async load(): Promise<void> {
    try {
      const before = this.view;
      this.view = await this.server.json<LibraryView>('/api/library');
      // Changed homes are requested again when they become visible.
      const same = new Map(before?.homes.map(({ name, changed_ms }) => [name, changed_ms]));
      const kept = this.view.homes.filter(({ name, changed_ms }) => same.get(name) === changed_ms).map(({ name }) => name);
      this.cards = Object.fromEntries(Object.entries(this.cards).filter(([name]) => kept.includes(name)));
    } catch (error) {
      this.tell(said(error), true);
    }
  }

  /** The homes in their order; those that were just deleted keep their places. */
  get entries(): Entry[] {
    const entries: Entry[] = (this.view?.homes ?? []).map((home) => ({ key: `home ${home.name}`, home, deleted: null }));
    // The home after one may be deleted, too.
    let left = this.deleted;
    for (let before = -1; left.length !== before; ) {
      before = left.length;
      left = left.filter((deleted) => {
        const at = deleted.before === null ? entries.length : entries.findIndex(({ home }) => home.name === deleted.before);
        if (at >= 0) entries.splice(at, 0, entryOf(deleted));
        return at < 0;
      });
    }
    return [...entries, ...left.map(entryOf)];
  }

  tell(text: string, bad: boolean): void {
    this.note = { text, bad };
  }

  dismiss(): void {
    this.note = null;
  }

  /** Requests a card, after earlier requests. */
  want(name: string): void {
    if (name in this.cards) return;
    this.soon(async () => {
      if (name in this.cards) return;
      const card = await this.server.json<CardView>(`/api/library/homes/${encodeURIComponent(name)}`).catch(said);
      this.cards = { ...this.cards, [name]: card };
    });
  }

  /** The rows of a run by day and hour; null if they cannot be read. */
  picture(home: string, run: string): Promise<number[][] | null> {
    return new Promise((done) => {
      this.soon(async () => {
        const path = `/api/library/homes/${encodeURIComponent(home)}/runs/${encodeURIComponent(run)}`;
        done(await this.server.json<number[][]>(path).catch(() => null));
      });
    });
  }

  /** Creates a home. @returns the result, or the reason of a failure. */
  async make(name: string, from: From): Promise<MadeView | string> {
    const at = encodeURIComponent(name);
    const underlay = new Underlay(this.server);
    if (from.kind === 'image') await underlay.choose(from.file, [...PICTURE.at], [...PICTURE.within_m]);
    if (underlay.problem !== '') return underlay.problem;
    const [path, body]: [string, unknown] =
      from.kind === 'plan' ? [`/api/library/plans/${at}`, from.file]
      : from.kind === 'log' ? [`/api/library/logs/${at}/${encodeURIComponent(from.file.name.slice(-100) || 'log')}`, from.file]
      : [`/api/library/homes/${at}`, (from.kind === 'template' ? { from: 'template', name: from.name } : { from: 'empty' }) satisfies NewHome];
    try {
      const made = await this.server.post<MadeView>(path, body);
      // A picture stored for a deleted home with this name belongs to that one.
      await underlay.layUnder(made.name);
      await this.load();
      return underlay.problem === '' ? made : { ...made, remarks: [...made.remarks, underlay.problem] };
    } catch (error) {
      return said(error);
    }
  }

  /** @returns the reason of a failure. */
  async call(name: string, as: string, what: 'name' | 'copy'): Promise<string | null> {
    try {
      await this.server.post<unknown>(`/api/library/homes/${encodeURIComponent(name)}/${what}`, { name: as } satisfies CallHome);
      // A browser without storage has nothing to carry.
      await carryUnderlay(name, as, what).catch(() => {});
      if (what === 'name') this.deleted = this.deleted.map((deleted) => (deleted.before === name ? { ...deleted, before: as } : deleted));
      this.tell(what === 'name' ? `Renamed ${name} to ${as}.` : `Copied ${name} to ${as}, without its runs.`, false);
      await this.load();
      return null;
    } catch (error) {
      return said(error);
    }
  }

  /** Sends a log to the home made from it, to locate its people. @returns the reason of a failure. */
  async walk(home: string, log: File): Promise<string | null> {
    return this.server.post<unknown>(`/api/homes/${encodeURIComponent(home)}/walk/${encodeURIComponent(log.name)}`, log).then(() => null, said);
  }

  /** @param height_px the height of its card, which its place keeps. */
  async remove(home: HomeEntryView, height_px: number): Promise<void> {
    const { name } = home;
    // By the time it is deleted others may be, too.
    const { entries } = this;
    const before = entries[entries.findIndex(({ key }) => key === `home ${name}`) + 1]?.home.name ?? null;
    try {
      const { key } = await this.server.remove<DeletedKey>(`/api/library/homes/${encodeURIComponent(name)}`);
      this.deleted = [...this.deleted, { home, aside: { key, name }, before, height_px, problem: '' }];
      if (this.view) this.view = { ...this.view, homes: this.view.homes.filter((other) => other.name !== name) };
    } catch (error) {
      this.tell(said(error), true);
    }
    await this.load();
  }

  /** @returns whether it is restored; otherwise its place, if it has one, shows the reason. */
  async putBack({ key, name }: DeletedHome): Promise<boolean> {
    const hasPlace = this.deleted.some(({ aside }) => aside.key === key);
    try {
      await this.server.post<string>(`/api/library/put-aside/${encodeURIComponent(key)}`, {});
    } catch (error) {
      if (hasPlace) this.deleted = this.deleted.map((deleted) => (deleted.aside.key === key ? { ...deleted, problem: said(error) } : deleted));
      else this.tell(said(error), true);
      await this.load();
      return false;
    }
    if (!hasPlace) this.tell(`Restored ${name}.`, false);
    await this.load();
    this.deleted = this.deleted.filter(({ aside }) => aside.key !== key);
    return true;
  }

  /** Gives up the place of a deleted home: its predecessor is then before its successor. */
  forget(key: string): void {
    const gone = this.deleted.find(({ aside }) => aside.key === key);
    if (gone === undefined) return;
    const left = this.deleted.filter((deleted) => deleted !== gone);
    this.deleted = left.map((deleted) => (deleted.before === gone.home.name ? { ...deleted, before: gone.before } : deleted));
  }

  private soon(ask: () => Promise<void>): void {
    this.waiting.push(ask);
    while (this.busy < AT_ONCE && this.waiting.length > 0) void this.next();
  }

  private async next(): Promise<void> {
    this.busy += 1;
    for (let ask = this.waiting.shift(); ask; ask = this.waiting.shift()) await ask();
    this.busy -= 1;
  }
}

function entryOf(deleted: Deleted): Entry {
  return { key: `deleted ${deleted.aside.key}`, home: deleted.home, deleted };
}

/** The name of a home made from a file: the file's, as far as it is allowed. */
export function nameOf(file: string): string {
  const bare = file.replace(/\.[^.]*$/, '').replace(/[/\\:*?"<>|\p{C}]+/gu, ' ').replace(/^[\s.]+/, '');
  return [...bare].slice(0, MOST_LETTERS).join('').replace(/[\s.]+$/, '') || 'home';
}

/** An unused name: `flat 2` if there is a `flat`. */
export function freshName(name: string, taken: string[]): string {
  const base = name.replace(/ \d+$/, '');
  let [fresh, count] = [name, 1];
  while (taken.some((other) => other.toLowerCase() === fresh.toLowerCase())) fresh = `${base} ${++count}`;
  return fresh;
}

/** A time in words: how long ago, or the date. */
export function ago(then_ms: number, now_ms: number): string {
  const minutes = Math.round((now_ms - then_ms) / 60_000);
  if (minutes < 1) return 'just now';
  if (minutes < 60) return minutes === 1 ? 'a minute ago' : `${minutes} minutes ago`;
  const hours = Math.round(minutes / 60);
  if (hours < 24) return hours === 1 ? 'an hour ago' : `${hours} hours ago`;
  return new Date(then_ms).toLocaleDateString('en-GB', { dateStyle: 'medium' });
}
