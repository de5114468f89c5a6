// Notes on episodes, days and references. They are stored with the run, so that other users see them.

import { type Keeper, keep, read } from '../../browser-storage';
import { Refused, type Server, notesPath, said } from '../../server';
import type { NoteChange, NoteView } from '../../wire';

/** The subject of a note: an episode by the day on which it was found, a day, or a reference by its first day. */
export type Subject = Pick<NoteView, 'day' | 'about'>;

/** The server's answer if another page has changed the notes meanwhile. */
const CHANGED = 409;

const WHO = 'homebody-who';

export class Notes {
  notes = $state.raw<readonly NoteView[]>([]);
  problem = $state('');
  /** The name of the user, as last given in this browser. */
  who = $state('');
  /** Grows when the notes of a run arrive. */
  came = $state(0);
  private run: string | null = null;
  /** The notes on the server. */
  private kept: readonly NoteView[] = [];
  /** One after the other: each note is based on the one before. */
  private queue: Promise<void> = Promise.resolve();

  constructor(
    private readonly server: Pick<Server, 'json' | 'post'>,
    private readonly keeper: () => Keeper = () => window.localStorage,
  ) {
    this.who = read(keeper, WHO) ?? '';
  }

  async open(run: string): Promise<void> {
    this.run = run;
    this.take(run, []);
    this.problem = '';
    try {
      this.take(run, await this.server.json<NoteView[]>(notesPath(run)));
    } catch (error) {
      if (run === this.run) this.problem = said(error);
    }
    if (run === this.run) this.came += 1;
  }

  of({ day, about }: Subject): NoteView {
    return find(this.notes, { day, about }) ?? { day, about, seen: false, note: '', who: '', at: '' };
  }

  /** Remembers the name of the user. */
  be(who: string): void {
    this.who = who;
    keep(this.keeper, WHO, who === '' ? null : who);
  }

  /** Shows a note at once, and restores the old one if it cannot be stored. The server gives it its time. */
  change(of: Subject, changed: Partial<Pick<NoteView, 'seen' | 'note'>>): Promise<void> {
    const { run } = this;
    if (run === null) return Promise.resolve();
    const note: NoteView = { ...this.of(of), ...changed, who: this.who, at: '' };
    this.notes = [...this.notes.filter((other) => find([other], of) === undefined), note];
    this.queue = this.queue.then(() => this.send(run, note));
    return this.queue;
  }

  private async send(run: string, note: NoteView): Promise<void> {
    const it: NoteChange = { before: find(this.kept, note) ?? null, note };
    try {
      const kept = await this.server.post<NoteView[]>(notesPath(run), it);
      if (run !== this.run) return;
      this.problem = '';
      this.take(run, kept);
    } catch (error) {
      if (run !== this.run) return;
      const isChanged = error instanceof Refused && error.status === CHANGED;
      const kept = isChanged ? await this.server.json<NoteView[]>(notesPath(run)).catch(() => this.kept) : this.kept;
      this.take(run, kept);
      this.problem = isChanged ? `${said(error)} The saved note is shown now. Enter yours again.` : `Cannot save the note: ${said(error)}`;
    }
  }

  private take(run: string, notes: readonly NoteView[]): void {
    if (run === this.run) [this.kept, this.notes] = [notes, notes];
  }
}

function find(notes: readonly NoteView[], { day, about }: Subject): NoteView | undefined {
  return notes.find((note) => note.day === day && note.about === about);
}
