// The subject of this page, by its address: a server's only scenario, a folder of homes, or a home of that folder.

export type Site = { kind: 'alone' } | { kind: 'library' } | { kind: 'home'; name: string };

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

/** The path of its requests. */
export function apiOf(site: Site): string {
  return site.kind === 'home' ? `/api/homes/${encodeURIComponent(site.name)}` : '/api';
}

export function homeHref(name: string, hash = '#/live'): string {
  return `/homes/${encodeURIComponent(name)}/${hash}`;
}
