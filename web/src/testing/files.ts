// A scenario's files in memory, and a server that answers requests about them.

import type { Fetch } from '../server';
import type { CheckView, Draft, FilesView, Save, SavedView } from '../wire';

export class FakeFiles {
  /** The requests: path and body. */
  readonly asked: { path: string; body: unknown }[] = [];
  check: CheckView = { problems: [], warnings: [] };

  /** @param answers for other paths, by body; an `Error` is a refusal of the server. */
  constructor(
    readonly texts: Record<string, string>,
    private readonly links: Omit<FilesView, 'entry' | 'files'>,
    private readonly answers: Record<string, (body: never) => unknown> = {},
  ) {}

  readonly fetch: Fetch = async (path, init) => {
    const body: unknown = typeof init.body === 'string' ? JSON.parse(init.body) : undefined;
    this.asked.push({ path, body });
    if (path === '/api/files' && init.method === 'POST') return Response.json(this.save(body as Save));
    if (path === '/api/files') return Response.json(this.view());
    if (path === '/api/files/versions') return Response.json(Object.fromEntries(this.view().files.map(({ name, version }) => [name, version])));
    const answer = await this.answers[path]?.(body as never);
    if (answer instanceof Response) return answer;
    if (answer === undefined && path === '/api/check') return Response.json(this.check);
    if (answer === undefined) return new Response(`There is no ${path}.`, { status: 404 });
    return answer instanceof Error ? new Response(answer.message, { status: 422 }) : Response.json(answer);
  };

  /** The drafts that were last sent to a path. */
  drafts(path: string): Record<string, string> | undefined {
    return (this.asked.findLast((one) => one.path === path)?.body as Draft | undefined)?.texts;
  }

  private view(): FilesView {
    const files = Object.entries(this.texts).map(([name, text]) => ({ name, text, version: `of ${text}` }));
    return { entry: 'scenario.json', ...this.links, files };
  }

  private save({ files }: Save): SavedView {
    const changed = this.view().files.filter(({ name, version }) => files.some((one) => one.name === name && one.version !== version));
    if (changed.length > 0) return { saved: {}, changed };
    for (const { name, text } of files) this.texts[name] = text;
    return { saved: Object.fromEntries(files.map(({ name, text }) => [name, `of ${text}`])), changed: [] };
  }
}
