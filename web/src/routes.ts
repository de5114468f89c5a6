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

/** NAME of `#/life/NAME`; nothing where the address is of another view, or names nothing. */
export function nameIn(hash: string, route: Route): string | null {
  const begin = `#/${route}/`;
  if (!hash.startsWith(begin) || hash === begin) return null;
  try {
    return decodeURIComponent(hash.slice(begin.length));
  } catch {
    return null;
  }
}

export function hashOf(route: Route, name: string): string {
  return `#/${route}/${encodeURIComponent(name)}`;
}
