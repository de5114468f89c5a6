import { mount } from 'svelte';
import App from './App.svelte';
import type { Wire } from './socket';
import './theme.css';

const target = document.getElementById('page')!;

/** With `--mode fake` the page plays with a made-up home instead of a server; otherwise none of it is in the page. */
async function begin(): Promise<void> {
  let fake: (() => Wire) | undefined;
  if (import.meta.env.MODE === 'fake') {
    const { fakeServer } = await import('./testing/fake');
    fake = fakeServer(new URLSearchParams(window.location.search));
  }
  mount(App, { target, props: fake ? { fake } : {} });
}

void begin();
