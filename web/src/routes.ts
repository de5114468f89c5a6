// The six views, and the address of each. The part after # is never sent to a server.

export const ROUTES = [
  { id: 'live', title: 'Live' },
  { id: 'plan', title: 'Plan' },
  { id: 'life', title: 'Life' },
  { id: 'playback', title: 'Playback' },
  { id: 'care', title: 'Care' },
  { id: 'log', title: 'Log' },
] as const;

export type Route = (typeof ROUTES)[number]['id'];

/** The view of `#/plan` or `#/plan/anything`; the first view for unknown addresses. */
export function routeOf(hash: string): Route {
  const asked = hash.replace(/^#\/?/, '').split('/')[0];
  return ROUTES.find((route) => route.id === asked)?.id ?? 'live';
}

/** NAME of `#/life/NAME` or `#/life/NAME@MOMENT`; null for another view, or without a name. */
export function nameIn(hash: string, route: Route): string | null {
  const begin = `#/${route}/`;
  // An @ in the name itself is encoded.
  const name = hash.startsWith(begin) ? hash.slice(begin.length).split('@')[0]! : '';
  if (name === '') return null;
  try {
    return decodeURIComponent(name);
  } catch {
    return null;
  }
}

/** PANEL of `#/plan/@PANEL`, the panel that the view opens; null for another view, or without a panel. */
export function panelIn(hash: string, route: Route): string | null {
  return new RegExp(`^#/${route}/@([a-z]+)$`).exec(hash)?.[1] ?? null;
}

/** MOMENT of `#/playback/NAME@MOMENT`, a date and perhaps a time on the home's clock; null without one. */
export function momentIn(hash: string): string | null {
  return /@(\d{4}-\d{2}-\d{2}(T\d{2}:\d{2}:\d{2})?)$/.exec(hash)?.[1] ?? null;
}

export function hashOf(route: Route, name: string, moment: string | null = null): string {
  return `#/${route}/${encodeURIComponent(name)}${moment === null ? '' : `@${moment}`}`;
}
