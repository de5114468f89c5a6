import { mount } from 'svelte';
import App from './App.svelte';
import type { Wire } from './socket';
import './theme.css';

const target = document.getElementById('page')!;

/** With `--mode fake` the page plays with a made-up home instead of a server; otherwise none of it is in the page. */
async function begin(): Promise<void> {
  let fake: (() => Wire) | undefined;
  if (import.meta.env.MODE === 'fake') {
    const { fakeServer, hostile } = await import('./testing/fake');
    const asked = new URLSearchParams(window.location.search);
    fake = fakeServer(asked);
    const { fakeRuns, storedRun } = await import('./testing/stored');
    const names = ['cottage-2', 'cottage-1'].map(asked.has('hostile') ? hostile : (name) => name);
    const stored = fakeRuns(names, (name) => storedRun(name, 30));
    const { fakeLives, routinesOf } = await import('./testing/life');
    const { fakePlans } = await import('./testing/plan');
    const { FLAT } = await import('./testing/flat');
    const people = ['Agnes', 'Bertram'].map(asked.has('hostile') ? hostile : (name) => name);
    const lives = fakeLives(people, routinesOf(people).set('home.json', FLAT));
    const answers = (path: string) => (path.startsWith('/api/runs') ? stored : path === '/api/plan' ? fakePlans(FLAT) : lives);
    window.fetch = async (path, init) => answers(String(path))(String(path), init ?? {});
  }
  mount(App, { target, props: fake ? { fake } : {} });
}

void begin();
