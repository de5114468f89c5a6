// The six views, and which of them the address asks for. The part after # is never sent to a server.

export const ROUTES = [
  { id: 'live', title: 'Live' },
  { id: 'plan', title: 'Plan' },
  { id: 'life', title: 'Life' },
  { id: 'playback', title: 'Playback' },
  { id: 'care', title: 'Care' },
  { id: 'log', title: 'Log' },
] as const;

export type Route = (typeof ROUTES)[number]['id'];

/** The view of `#/plan` or `#/plan/anything`; the first one where it is none of ours. */
export function routeOf(hash: string): Route {
  const asked = hash.replace(/^#\/?/, '').split('/')[0];
  return ROUTES.find((route) => route.id === asked)?.id ?? 'live';
}

/** NAME of `#/life/NAME` or `#/life/NAME@MOMENT`; nothing where the address is of another view, or names nothing. */
export function nameIn(hash: string, route: Route): string | null {
  const begin = `#/${route}/`;
  // An @ of the name itself is written otherwise.
  const name = hash.startsWith(begin) ? hash.slice(begin.length).split('@')[0]! : '';
  if (name === '') return null;
  try {
    return decodeURIComponent(name);
  } catch {
    return null;
  }
}

/** PANEL of `#/plan/@PANEL`, which is what the view shows first; nothing where the address is of another view, or names none. */
export function panelIn(hash: string, route: Route): string | null {
  return new RegExp(`^#/${route}/@([a-z]+)$`).exec(hash)?.[1] ?? null;
}

/** MOMENT of `#/playback/NAME@MOMENT`, a date and perhaps a time on the home's clock; nothing where there is none. */
export function momentIn(hash: string): string | null {
  return /@(\d{4}-\d{2}-\d{2}(T\d{2}:\d{2}:\d{2})?)$/.exec(hash)?.[1] ?? null;
}

export function hashOf(route: Route, name: string, moment: string | null = null): string {
  return `#/${route}/${encodeURIComponent(name)}${moment === null ? '' : `@${moment}`}`;
}
