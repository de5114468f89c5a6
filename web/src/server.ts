// The server by HTTP, and its token. `homebody serve` prints an address such as http://127.0.0.1:8642/#token=HEX, which
// gives all rights of the page.

import { decode } from '@msgpack/msgpack';
import { type Keeper, keep, read } from './browser-storage';
import type { RefusedView } from './wire';

const TOKEN = 'homebody-token';

/** The form of a token, so that other fragments are ignored. */
const FORM = /^[0-9A-Za-z_-]{8,256}$/;

/** The token in a fragment such as `#token=HEX`, in a pasted address, or by itself. */
export function tokenIn(text: string): string | null {
  const pasted = text.trim();
  const named = /[#&?]token=([^&\s]+)/.exec(pasted)?.[1];
  const token = named ?? pasted;
  return FORM.test(token) ? token : null;
}

/** The token from the address, or the stored one; `then` replaces it in the address bar. */
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

/** The server's reason for refusing a request. */
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

/** The reason in an answer without success. An answer that is not from Homebody is plain text. */
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
  /** @param onWrongToken is called if the server does not know the token. */
  constructor(
    private readonly token: string,
    private readonly onWrongToken: () => void,
    private readonly fetch: Fetch = (path, init) => window.fetch(path, init),
    /** Replaces `/api` in paths: each home of a library has its own. */
    private readonly api = '/api',
  ) {}

  /** The same server, with the requests of its library. */
  ofLibrary(): Server {
    return new Server(this.token, this.onWrongToken, this.fetch);
  }

  async json<T>(path: string): Promise<T> {
    return (await (await this.ask('GET', path)).json()) as T;
  }

  /** An answer in MessagePack; with a body, the request is a POST. */
  async packed<T>(path: string, body?: unknown): Promise<T> {
    return decode(await (await this.ask(body === undefined ? 'GET' : 'POST', path, body)).arrayBuffer()) as T;
  }

  async remove<T>(path: string): Promise<T> {
    return (await (await this.ask('DELETE', path)).json()) as T;
  }

  async text(path: string): Promise<string> {
    return (await this.ask('GET', path)).text();
  }

  /** @param stop cancels the request, and the server's work. */
  async post<T>(path: string, body: unknown, stop?: AbortSignal): Promise<T> {
    return (await (await this.ask('POST', path, body, stop)).json()) as T;
  }

  /** A file made from the posted data. */
  async made(path: string, body: unknown): Promise<Blob> {
    return (await this.ask('POST', path, body)).blob();
  }

  /** A file, and its name by the server. */
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

/** The message of an error. */
export function said(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

/** The path of a run's file; a run is the name of a folder, with any characters. */
export function runPath(id: string, file: 'log' | 'recording'): string {
  return `/api/runs/${encodeURIComponent(id)}/${file}`;
}

export function storedPath(name: string, day?: number): string {
  const run = `/api/runs/${encodeURIComponent(name)}`;
  return day === undefined ? run : `${run}/days/${day}`;
}

/** The path of the description of a run, stored or deleted. */
export function aboutPath(name: string): string {
  return `${storedPath(name)}/about`;
}

export function asidePath(key: string): string {
  return `/api/put-aside/${encodeURIComponent(key)}`;
}

export function findPath(name: string): string {
  return `${storedPath(name)}/find`;
}

/** The path of the camera pictures of a run between two instants, at an interval. */
export function filmPath(name: string, from_us: number, to_us: number, every_us: number): string {
  return `${storedPath(name)}/silhouettes/${from_us}/${to_us}/${every_us}`;
}

/** The path of the firing counts of each sensor of a run. */
export function readingPath(name: string): string {
  return `${storedPath(name)}/reading`;
}

export function lanesPath(name: string): string {
  return `${storedPath(name)}/lanes`;
}

/** The path of the rest of a day after an incomplete answer. */
export function restPath(name: string, day: number, from_us: number): string {
  return `${storedPath(name, day)}/from/${from_us}`;
}

/** The path for locating people from a log in the home of a stored run, or of the scenario. */
export function walkPath(log: string, run: string | null): string {
  const path = `/api/walk/${encodeURIComponent(log)}`;
  return run === null ? path : `${path}/${encodeURIComponent(run)}`;
}

/** The path of the summary of a run's log, or of its comparison with another one. */
export function toldPath(run: string, beside: string | null): string {
  return beside === null ? `${storedPath(run)}/look` : `${storedPath(run)}/realism/${encodeURIComponent(beside)}`;
}

export function notesPath(run: string): string {
  return `${storedPath(run)}/notes`;
}

/** The path for storing a log without a home. */
export function keepPath(log: string): string {
  return `/api/logs/${encodeURIComponent(log)}`;
}

/** The path of the care view of a run. */
export function carePath(run: string): string {
  return `${storedPath(run)}/care`;
}

/** Makes the browser save a file. */
export function save(blob: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  // The browser reads the file after the click has returned.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
