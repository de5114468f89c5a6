// The first rows of the log as the file being written would have them; asked anew once somebody has stopped writing.

import { type Drafts, said } from '../../drafts.svelte';
import type { RowsView } from '../../wire';

/** How long after the last key rows are asked for. */
const PAUSE_MS = 400;

export class Rows {
  view = $state.raw<RowsView | null>(null);
  problem = $state('');
  private timer: ReturnType<typeof setTimeout> | undefined;
  private asked = 0;

  constructor(private readonly drafts: Drafts) {}

  askSoon(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.ask(), PAUSE_MS);
  }

  stop(): void {
    clearTimeout(this.timer);
    this.asked += 1;
  }

  private async ask(): Promise<void> {
    const number = ++this.asked;
    try {
      const view = await this.drafts.server.post<RowsView>('/api/rows', this.drafts.draft);
      if (number !== this.asked) return;
      // What was shown stays while there are problems.
      this.view = view.problems.length > 0 && this.view !== null ? { ...view, places: this.view.places } : view;
      this.problem = '';
    } catch (error) {
      if (number === this.asked) this.problem = said(error);
    }
  }
}
