// The first rows of the log by the edited file; requested again when the user pauses.

import type { Drafts } from '../../drafts.svelte';
import { Latest } from '../../latest';
import type { Draft, RowsView } from '../../wire';

/** Pause after the last key. */
const PAUSE_MS = 400;

export class Rows {
  view = $state.raw<RowsView | null>(null);
  problem = $state('');
  private readonly rows: Latest<Draft, RowsView>;

  constructor(private readonly drafts: Drafts) {
    this.rows = new Latest(
      PAUSE_MS,
      (draft) => drafts.server.post<RowsView>('/api/rows', draft),
      (view) => {
        // The last rows stay while there are problems.
        this.view = view.problems.length > 0 && this.view !== null ? { ...view, places: this.view.places } : view;
        this.problem = '';
      },
      (why) => (this.problem = why),
    );
  }

  askSoon(): void {
    this.rows.want(this.drafts.draft);
  }

  close(): void {
    this.rows.close();
  }
}
