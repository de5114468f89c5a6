// Undo and redo of an editor. The state is up to the editor: a text, and other data.

/** Largest number of steps, and of letters in all of them. */
const MOST_STEPS = 300;
const MOST_LETTERS = 60_000_000;
/** Changes of one kind within this time are one step. */
const ONE_STEP_MS = 1000;

export class History<State extends { text: string }> {
  /** The latest last. */
  private past = $state.raw<State[]>([]);
  private future = $state.raw<State[]>([]);
  private last = { tag: '', at_ms: 0 };

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** Records the state before a change; a change with the tag of the last one that follows at once belongs to its step. */
  keep(former: State, tag = ''): void {
    const now = performance.now();
    const continues = tag !== '' && tag === this.last.tag && now - this.last.at_ms < ONE_STEP_MS;
    this.last = { tag, at_ms: now };
    if (continues) return;
    const past = [...this.past, former].slice(-MOST_STEPS);
    let letters = past.reduce((sum, { text }) => sum + text.length, 0);
    while (past.length > 1 && letters > MOST_LETTERS) letters -= past.shift()!.text.length;
    this.past = past;
    this.future = [];
  }

  /** The state before the last step, if there is one. */
  undo(now: State): State | undefined {
    const former = this.past.at(-1);
    if (former === undefined) return undefined;
    this.past = this.past.slice(0, -1);
    this.future = [...this.future, now];
    this.last.tag = '';
    return former;
  }

  redo(now: State): State | undefined {
    const next = this.future.at(-1);
    if (next === undefined) return undefined;
    this.future = this.future.slice(0, -1);
    this.past = [...this.past, now];
    this.last.tag = '';
    return next;
  }
}
