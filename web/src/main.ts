import { mount } from 'svelte';
import App from './App.svelte';
import type { Wire } from './socket';
import './theme.css';

const target = document.getElementById('page')!;

/** With `--mode fake`, a made-up home replaces the server; other builds leave it out. */
async function begin(): Promise<void> {
  let fake: (() => Wire) | undefined;
  if (import.meta.env.MODE === 'fake') {
    const { fakeServer, hostile } = await import('./testing/fake');
    const asked = new URLSearchParams(window.location.search);
    fake = fakeServer(asked);
    const { fakeRuns, storedRun } = await import('./testing/stored');
    const { madeUpHome } = await import('./testing/home');
    const { madeUpScenario } = await import('./testing/scenario');
    const named = asked.has('hostile') ? hostile : (name: string) => name;
    const { careIn, fakeCare } = await import('./testing/care');
    const stored = fakeCare(fakeRuns(['cottage-2', 'cottage-1'].map(named), (name) => storedRun(name, 30)), (name) => careIn(asked.get('care'), name));
    const files = await madeUpScenario(madeUpHome(Number(asked.get('sensors') ?? 18), named), ['Agnes', 'Bertram'].map(named));
    window.fetch = async (path, init) => (/^\/api\/(runs|logs|walk)/.test(String(path)) ? stored : files)(String(path), init ?? {});
  }
  mount(App, { target, props: fake ? { fake } : {} });
}

void begin();
