// The user's choices: colours and units. They stay in the browser.

import { keep, read } from './browser-storage';
import type { Units } from './units';

export type Theme = 'system' | 'light' | 'dark';

const storage = () => window.localStorage;

class Choices {
  theme = $state<Theme>('system');
  units = $state<Units>('metric');
  private systemDark = $state(false);
  reducedMotion = $state(false);

  readonly dark = $derived(this.theme === 'dark' || (this.theme === 'system' && this.systemDark));

  constructor() {
    const theme = read(storage, 'homebody-theme');
    if (theme === 'light' || theme === 'dark') this.theme = theme;
    if (read(storage, 'homebody-units') === 'feet') this.units = 'feet';
    watch('(prefers-color-scheme: dark)', (matches) => (this.systemDark = matches));
    watch('(prefers-reduced-motion: reduce)', (matches) => (this.reducedMotion = matches));
    this.paint();
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    keep(storage, 'homebody-theme', theme === 'system' ? null : theme);
    this.paint();
  }

  setUnits(units: Units): void {
    this.units = units;
    keep(storage, 'homebody-units', units);
  }

  private paint(): void {
    if (this.theme === 'system') delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = this.theme;
  }
}

function watch(query: string, tell: (matches: boolean) => void): void {
  const media = window.matchMedia(query);
  tell(media.matches);
  media.addEventListener('change', (event) => tell(event.matches));
}

export const choices = new Choices();
