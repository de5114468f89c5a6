// A picture under the plan, such as a scanned drawing. The browser stores it by the home's name, and sends it nowhere.
// Without one, it is the picture in the home's own folder.

import { type At, distance, minus } from '../../plan/geometry';
import type { Pen } from '../../plan/pen';
import { type Bounds, type View, toScreen } from '../../plan/transform';
import type { Server } from '../../server';
import type { UnderlayView } from '../../wire';
import { add, exact, rounded, times } from './shape';

/** Its position: its middle, its width, and its counter-clockwise turn. */
export type Place = { at: At; width_m: number; turn_deg: number };

type Lies = Place & { opacity: number };

type Kept = Lies & { file: Blob; name: string };

const STORE = 'underlays';
const TYPES = ['image/png', 'image/jpeg', 'image/svg+xml'];
export const ACCEPTED = TYPES.join();
/** Larger files would fill the browser's store. */
const MOST_BYTES = 50_000_000;

export class Underlay {
  name = $state('');
  lies = $state.raw<Lies>({ at: [0, 0], width_m: 10, turn_deg: 0, opacity: 0.5 });
  image = $state.raw<HTMLImageElement | null>(null);
  problem = $state('');
  private file: Blob | null = null;
  private home: string | null = null;

  constructor(private readonly server: Pick<Server, 'json' | 'file'>) {}

  /** The stored picture of this home, or the one in its folder. */
  async open(home: string): Promise<void> {
    this.home = home;
    // A browser without storage has nothing to show.
    const kept = await keptOf(home).catch(() => undefined);
    const found = kept ?? (await this.ofFolder().catch(() => undefined));
    if (found === undefined || this.home !== home) return;
    const { at, width_m, turn_deg, opacity } = found;
    this.lies = { at, width_m, turn_deg, opacity };
    await this.load(found.file, found.name);
  }

  private async ofFolder(): Promise<Kept | undefined> {
    const lies = await this.server.json<UnderlayView | null>('/api/underlay');
    if (lies === null) return undefined;
    const { picture: name, at, width_m, turn_deg } = lies;
    const { blob } = await this.server.file('/api/underlay/picture', name);
    return { at, width_m, turn_deg, opacity: this.lies.opacity, file: blob, name };
  }

  /** Places a chosen file, as large as fits between these sides. */
  async choose(file: File, at: At, [width_m, height_m]: At): Promise<void> {
    this.problem = '';
    if (!TYPES.includes(file.type)) this.problem = 'This file is not a PNG, JPEG or SVG image.';
    else if (file.size > MOST_BYTES) this.problem = 'This file is larger than 50 MB. Choose a smaller image.';
    else if (await this.load(file, file.name)) {
      this.lies = { ...this.lies, at: exact(at), width_m: rounded(Math.min(width_m, height_m / this.tallness)), turn_deg: 0 };
      await this.keep();
    } else this.problem = 'The browser cannot read this image. Save it as PNG and try again.';
  }

  /** Stores the picture, or its absence, for a new home. */
  async layUnder(home: string): Promise<void> {
    this.home = home;
    await (this.image === null ? this.drop() : this.keep());
  }

  async lie(part: Partial<Lies>): Promise<void> {
    this.lies = { ...this.lies, ...part };
    await this.keep();
  }

  /** The position with two points at a real distance: the first stays. Null for equal points. */
  scaled(a: At, b: At, real_m: number): Partial<Place> | null {
    const by = real_m / distance(a, b);
    if (!Number.isFinite(by) || by <= 0) return null;
    return { width_m: rounded(this.lies.width_m * by), at: exact(add(a, times(minus(this.lies.at, a), by))) };
  }

  async drop(): Promise<void> {
    this.image = this.file = null;
    this.name = '';
    const { home } = this;
    if (home !== null) await inStore('readwrite', (store) => store.delete(home)).catch(() => {});
  }

  /** Height divided by width; 1 for a picture without a size, such as some SVGs. */
  private get tallness(): number {
    const { naturalWidth = 0, naturalHeight = 0 } = this.image ?? {};
    return naturalWidth > 0 && naturalHeight > 0 ? naturalHeight / naturalWidth : 1;
  }

  get bounds(): Bounds | null {
    if (this.image === null) return null;
    const { at, width_m, turn_deg } = this.lies;
    const [half, turn] = [width_m / 2, (turn_deg * Math.PI) / 180];
    const [along, across] = [Math.abs(Math.cos(turn)), Math.abs(Math.sin(turn))];
    const reach: At = [half * (along + across * this.tallness), half * (across + along * this.tallness)];
    return [minus(at, reach), add(at, reach)];
  }

  draw(pen: Pen, view: View): void {
    const { image } = this;
    const { at, width_m, turn_deg, opacity } = this.lies;
    if (image === null) return;
    const [x, y] = toScreen(view, at);
    const width = width_m * view.scale;
    const height = width * this.tallness;
    pen.save();
    pen.translate(x, y);
    pen.rotate((-turn_deg * Math.PI) / 180);
    pen.globalAlpha = opacity;
    pen.imageSmoothingEnabled = true;
    pen.drawImage(image, -width / 2, -height / 2, width, height);
    pen.restore();
  }

  private async load(file: Blob, name: string): Promise<boolean> {
    const image = new Image();
    const url = URL.createObjectURL(file);
    image.src = url;
    try {
      await image.decode();
    } catch {
      URL.revokeObjectURL(url);
      return false;
    }
    this.file = file;
    this.name = name;
    this.image = image;
    return true;
  }

  private async keep(): Promise<void> {
    const { file, home, name } = this;
    if (file === null || home === null) return;
    const kept: Kept = { ...this.lies, file, name };
    try {
      await inStore('readwrite', (store) => store.put(kept, home));
    } catch {
      this.problem = 'The browser cannot store the image. Choose it again next time.';
    }
  }
}

function keptOf(home: string): Promise<Kept | undefined> {
  return inStore('readonly', (store) => store.get(home)) as Promise<Kept | undefined>;
}

/** A renamed or copied home takes the picture along. */
export async function carryUnderlay(from: string, to: string, what: 'name' | 'copy'): Promise<void> {
  const kept = await keptOf(from);
  if (kept === undefined) return;
  await inStore('readwrite', (store) => store.put(kept, to));
  if (what === 'name') await inStore('readwrite', (store) => store.delete(from));
}

function inStore(mode: IDBTransactionMode, ask: (store: IDBObjectStore) => IDBRequest): Promise<unknown> {
  return new Promise((done, failed) => {
    const opening = indexedDB.open('homebody', 1);
    opening.onupgradeneeded = () => opening.result.createObjectStore(STORE);
    opening.onerror = () => failed(opening.error);
    opening.onsuccess = () => {
      const database = opening.result;
      const transaction = database.transaction(STORE, mode);
      const request = ask(transaction.objectStore(STORE));
      // A request may succeed without being stored, such as on a full disk.
      transaction.oncomplete = () => {
        database.close();
        done(request.result);
      };
      transaction.onabort = () => {
        database.close();
        failed(transaction.error);
      };
    };
  });
}
