// What this page is of, by its address: a server's only scenario, a folder of homes, or a home of that folder.

export type Site = { kind: 'alone' } | { kind: 'library' } | { kind: 'home'; name: string };

/** The address of the first page of a library. */
export const LIBRARY = '/library/';

export function siteOf(pathname: string): Site {
  if (pathname === LIBRARY) return { kind: 'library' };
  const name = /^\/homes\/([^/]+)\/$/.exec(pathname)?.[1];
  if (name === undefined) return { kind: 'alone' };
  try {
    return { kind: 'home', name: decodeURIComponent(name) };
  } catch {
    return { kind: 'alone' };
  }
}

/** Below which path the server answers for it. */
export function apiOf(site: Site): string {
  return site.kind === 'home' ? `/api/homes/${encodeURIComponent(site.name)}` : '/api';
}

/** The address of a home's page, and of a view of it. */
export function homeHref(name: string, hash = '#/live'): string {
  return `/homes/${encodeURIComponent(name)}/${hash}`;
}
