// Notes on alerts and days. They are stored with the run, so that other users see them.

import { Refused, type Server, notesPath, said } from '../../server';
import type { AlertView, NoteChange, NoteView } from '../../wire';

/** The subject of a note: an alert, or with an empty rule a day. */
export type Of = Pick<AlertView, 'day' | 'rule'>;

/** The server's answer if another page has changed the notes meanwhile. */
const CHANGED = 409;

export class Notes {
  notes = $state.raw<readonly NoteView[]>([]);
  problem = $state('');
  /** Grows when the notes of a run arrive. */
  came = $state(0);
  private run: string | null = null;
  /** The notes on the server. */
  private kept: readonly NoteView[] = [];
  /** One after the other: each note is based on the one before. */
  private queue: Promise<void> = Promise.resolve();

  constructor(private readonly server: Pick<Server, 'json' | 'post'>) {}

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

  of({ day, rule }: Of): NoteView {
    return find(this.notes, { day, rule }) ?? { day, rule, seen: false, note: '' };
  }

  /** Shows a note at once, and restores the old one if it cannot be stored. */
  change(of: Of, changed: Partial<Pick<NoteView, 'seen' | 'note'>>): Promise<void> {
    const { run } = this;
    if (run === null) return Promise.resolve();
    const note = { ...this.of(of), ...changed };
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

function find(notes: readonly NoteView[], { day, rule }: Of): NoteView | undefined {
  return notes.find((note) => note.day === day && note.rule === rule);
}
