import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig } from 'vitest/config';

// The program answers here while `npm run dev` serves the page itself; it hears only pages that come from its own address.
const server = 'http://127.0.0.1:8642';

export default defineConfig({
  plugins: [svelte({ compilerOptions: { runes: true } })],
  // The server lets no data: scripts or styles through, so nothing small is folded into another file.
  build: { assetsInlineLimit: 0, modulePreload: { polyfill: false }, target: 'es2022' },
  // Tests read the examples of the documents.
  server: { ...(process.env.VITEST ? { fs: { allow: ['..'] } } : {}), port: 5173, proxy: { '/api': { target: server, ws: true, headers: { origin: server } } } },
  // Components are mounted in tests, so the browser's half of Svelte is wanted.
  resolve: process.env.VITEST ? { conditions: ['browser'] } : {},
  // How fast a machine is says nothing about what is tested.
  test: { environment: 'happy-dom', include: ['src/**/*.test.ts'], testTimeout: 60_000 },
});
