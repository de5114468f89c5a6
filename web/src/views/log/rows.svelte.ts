// The first rows of the log as the file being written would have them; asked anew once somebody has stopped writing.

import type { Drafts } from '../../drafts.svelte';
import { Latest } from '../../latest';
import type { Draft, RowsView } from '../../wire';

/** How long after the last key rows are asked for. */
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
        // What was shown stays while there are problems.
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
