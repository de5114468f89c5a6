// The server by HTTP, and the token that it asks for. `homebody serve` prints an address such as
// http://127.0.0.1:8642/#token=HEX; whoever has it may do what the page can.

import { decode } from '@msgpack/msgpack';
import { type Keeper, keep, read } from './kept';
import type { RefusedView } from './wire';

const TOKEN = 'homebody-token';

/** What a token looks like, so that other fragments are left alone. */
const FORM = /^[0-9A-Za-z_-]{8,256}$/;

/** The token in a fragment such as `#token=HEX`, or in a whole address that was pasted, or by itself. */
export function tokenIn(text: string): string | null {
  const pasted = text.trim();
  const named = /[#&?]token=([^&\s]+)/.exec(pasted)?.[1];
  const token = named ?? pasted;
  return FORM.test(token) ? token : null;
}

/** The token from the address, or the one that was kept; it is gone from the address bar afterwards, where `then` is instead. */
export function takeToken(location: Pick<Location, 'hash'>, history: Pick<History, 'replaceState'>, keeper: () => Keeper, then = '#/live') {
  if (/^#(.*&)?token=/.test(location.hash)) {
    const token = tokenIn(location.hash);
    history.replaceState(null, '', then);
    if (token !== null) {
      keep(keeper, TOKEN, token);
      return token;
    }
  }
  return read(keeper, TOKEN);
}

export function keepToken(keeper: () => Keeper, token: string | null): void {
  keep(keeper, TOKEN, token);
}

/** Why the server did not do what it was asked. */
export class Refused extends Error {
  constructor(
    readonly status: number,
    message: string,
    /** The stable code of the message, such as `page::no-run`. */
    readonly code: string | null = null,
  ) {
    super(message);
  }
}

/** The reason in an answer without success. An answer that is not from Homebody has plain text. */
async function refusal(answer: Response): Promise<Refused> {
  const text = (await answer.text()).trim();
  if (answer.headers.get('content-type')?.startsWith('application/json')) {
    const told = JSON.parse(text) as RefusedView;
    return new Refused(answer.status, told.what.slice(0, 500), told.code ?? null);
  }
  return new Refused(answer.status, text.slice(0, 500) || `The server answered with status ${answer.status}.`);
}

export type Fetch = (path: string, init: RequestInit) => Promise<Response>;

export class Server {
  /** @param onWrongToken is told when the server does not know the token. */
  constructor(
    private readonly token: string,
    private readonly onWrongToken: () => void,
    private readonly fetch: Fetch = (path, init) => window.fetch(path, init),
    /** What stands for `/api` in paths: each home of a library has its own. */
    private readonly api = '/api',
  ) {}

  async json<T>(path: string): Promise<T> {
    return (await (await this.ask('GET', path)).json()) as T;
  }

  /** What comes as MessagePack; with a body it is posted. */
  async packed<T>(path: string, body?: unknown): Promise<T> {
    return decode(await (await this.ask(body === undefined ? 'GET' : 'POST', path, body)).arrayBuffer()) as T;
  }

  async remove<T>(path: string): Promise<T> {
    return (await (await this.ask('DELETE', path)).json()) as T;
  }

  async text(path: string): Promise<string> {
    return (await this.ask('GET', path)).text();
  }

  /** @param stop ends the waiting; the server then stops as well. */
  async post<T>(path: string, body: unknown, stop?: AbortSignal): Promise<T> {
    return (await (await this.ask('POST', path, body, stop)).json()) as T;
  }

  /** A file that is made of what is posted. */
  async made(path: string, body: unknown): Promise<Blob> {
    return (await this.ask('POST', path, body)).blob();
  }

  /** A file, and the name that the server gives it. */
  async file(path: string, otherwise: string): Promise<{ blob: Blob; name: string }> {
    const answer = await this.ask('GET', path);
    const named = /filename="([^"\\/]+)"/.exec(answer.headers.get('content-disposition') ?? '')?.[1];
    return { blob: await answer.blob(), name: named ?? otherwise };
  }

  private async ask(method: string, path: string, body?: unknown, stop?: AbortSignal): Promise<Response> {
    const headers: Record<string, string> = { 'x-homebody-token': this.token };
    const init: RequestInit = { method, headers, cache: 'no-store' };
    if (stop) init.signal = stop;
    if (body instanceof Blob) {
      headers['content-type'] = 'application/octet-stream';
      init.body = body;
    } else if (body !== undefined) {
      headers['content-type'] = 'application/json';
      init.body = JSON.stringify(body);
    }
    let answer: Response;
    try {
      answer = await this.fetch(path.replace(/^\/api(?=\/)/, () => this.api), init);
    } catch {
      throw new Refused(0, 'Cannot reach the server.');
    }
    if (answer.status === 401) {
      this.onWrongToken();
      throw new Refused(401, 'The server does not accept this access token.');
    }
    if (!answer.ok) {
      throw await refusal(answer);
    }
    return answer;
  }
}

/** What an error says. */
export function said(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

/** The path of a run's file; a run is a folder's name, which may hold anything. */
export function runPath(id: string, file: 'log' | 'recording'): string {
  return `/api/runs/${encodeURIComponent(id)}/${file}`;
}

/** The path of a stored run, or of a day of it. */
export function storedPath(name: string, day?: number): string {
  const run = `/api/runs/${encodeURIComponent(name)}`;
  return day === undefined ? run : `${run}/days/${day}`;
}

/** The path of what a run is called, and of a run that was put aside. */
export function aboutPath(name: string): string {
  return `${storedPath(name)}/about`;
}

export function asidePath(key: string): string {
  return `/api/put-aside/${encodeURIComponent(key)}`;
}

/** The path on which something is looked for over a whole run. */
export function findPath(name: string): string {
  return `${storedPath(name)}/find`;
}

/** The path of what a run's cameras kept between two instants, of instants so far apart. */
export function filmPath(name: string, from_us: number, to_us: number, every_us: number): string {
  return `${storedPath(name)}/silhouettes/${from_us}/${to_us}/${every_us}`;
}

/** The path of how often each sensor of a run spoke. */
export function readingPath(name: string): string {
  return `${storedPath(name)}/reading`;
}

export function lanesPath(name: string): string {
  return `${storedPath(name)}/lanes`;
}

/** The path of what a day's answer had no time for. */
export function restPath(name: string, day: number, from_us: number): string {
  return `${storedPath(name, day)}/from/${from_us}`;
}

/** The path on which a log is sent to be walked back through the home of a stored run, or of the scenario. */
export function walkPath(log: string, run: string | null): string {
  const path = `/api/walk/${encodeURIComponent(log)}`;
  return run === null ? path : `${path}/${encodeURIComponent(run)}`;
}

/** The path of what the log of a run holds, or of how near another one is to it. */
export function toldPath(run: string, beside: string | null): string {
  return beside === null ? `${storedPath(run)}/look` : `${storedPath(run)}/realism/${encodeURIComponent(beside)}`;
}

/** The path of what was noted about a run. */
export function notesPath(run: string): string {
  return `${storedPath(run)}/notes`;
}

/** The path on which a log is sent to be kept without a home. */
export function keepPath(log: string): string {
  return `/api/logs/${encodeURIComponent(log)}`;
}

/** The path of how the resident of a run is. */
export function carePath(run: string): string {
  return `${storedPath(run)}/care`;
}

/** Has the browser save a file, as if its link had been clicked. */
export function save(blob: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  // The browser reads the file after the click has returned.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
