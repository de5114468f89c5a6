// A made-up scenario with all its files, for looking at the page without a server.

import type { Fetch } from '../server';
import type { Draft, Explain, FilesView, HomeView, Month, WriteStatement } from '../wire';
import { FakeFiles } from './files';
import { fakeLives } from './life';
import { madeUpLogger } from './logger';
import { homeText, planned } from './plan';

export async function madeUpScenario(home: HomeView, residents: string[]): Promise<Fetch> {
  const lives = fakeLives(residents);
  const living = (await (await lives('/api/files', {})).json()) as FilesView;
  const log = madeUpLogger(home);
  const texts = { ...log.texts, 'home.json': homeText(home), ...Object.fromEntries(living.files.map(({ name, text }) => [name, text])) };
  // Only this page knows saved texts, and the server knows nothing of the other files.
  const routines = (draft: Draft): Draft => ({ texts: Object.fromEntries(Object.entries({ ...texts, ...draft.texts }).filter(([name]) => name.endsWith('.routine'))) });
  const ask = (path: string, body: unknown) => lives(path, { method: 'POST', body: JSON.stringify(body) });
  return new FakeFiles(texts, { home: 'home.json', logger: 'logger.json', lives: living.lives }, {
    ...log.answers,
    '/api/plan': ({ texts: drafts }: Draft) => planned(drafts['home.json'] ?? texts['home.json']),
    '/api/check': (draft: Draft) => ask('/api/check', routines(draft)),
    '/api/explain': ({ draft, file }: Explain) => ask('/api/explain', { draft: routines(draft), file }),
    '/api/statements': ({ draft, file }: Explain) => ask('/api/statements', { draft: routines(draft), file }),
    '/api/statement': (asked: WriteStatement) => ask('/api/statement', { ...asked, draft: routines(asked.draft) }),
    '/api/month': (month: Month) => ask('/api/month', { ...month, draft: routines(month.draft) }),
  }).fetch;
}
