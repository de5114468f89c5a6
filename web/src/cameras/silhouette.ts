// Silhouettes in the server's packed form, and their drawing.

/** A byte for each pixel, row by row: 1 for a person. Invalid data give an empty picture. */
export function unpacked(packed: ArrayLike<number>, [columns, rows]: readonly [number, number]): Uint8Array {
  const pixels = new Uint8Array(columns * rows);
  for (const [from, to] of runs(packed)) pixels.fill(1, from, to);
  return pixels;
}

/** The number of pixels of people. */
export function areaOf(packed: ArrayLike<number>): number {
  let area = 0;
  for (const [from, to] of runs(packed)) area += to - from;
  return area;
}

/** Runs of pixels that are on. Lengths of off and on runs alternate, in groups of seven bits, the lowest first; the last byte of each is below 128. */
function* runs(packed: ArrayLike<number>): Generator<[number, number]> {
  let [at, length, factor, on] = [0, 0, 1, false];
  for (let index = 0; index < packed.length; index++) {
    const byte = packed[index]!;
    length += (byte & 127) * factor;
    factor *= 128;
    if (byte >= 128) continue;
    if (on) yield [at, at + length];
    [at, length, factor, on] = [at + length, 0, 1, !on];
  }
}

/** The state of a camera: asleep, or awake with a silhouette, which may be empty. */
export type Look = { awake: boolean; packed: ArrayLike<number> };

export function wordOf(look: Look | null): string {
  if (look === null) return 'not loaded';
  if (look.packed.length > 0) return 'person in view';
  return look.awake ? 'no person in view' : 'asleep';
}

/** Red, green and blue: these do not change with the page's theme, like those of a film. */
const ASLEEP = [12, 16, 21] as const;
const GROUND = [43, 51, 61] as const;
const BODY = [255, 255, 255] as const;

/** Draws a look, one pixel of the canvas for each pixel of the camera. */
export function drawLook(canvas: HTMLCanvasElement, size: readonly [number, number], look: Look | null): void {
  const pen = canvas.getContext('2d');
  if (pen === null) return;
  const [columns, rows] = size;
  if (canvas.width !== columns || canvas.height !== rows) [canvas.width, canvas.height] = [columns, rows];
  const image = pen.createImageData(columns, rows);
  const pixels = unpacked(look?.packed ?? [], size);
  const ground = look !== null && (look.awake || look.packed.length > 0) ? GROUND : ASLEEP;
  for (let pixel = 0; pixel < pixels.length; pixel++) {
    image.data.set(pixels[pixel] === 1 ? BODY : ground, pixel * 4);
    image.data[pixel * 4 + 3] = 255;
  }
  pen.putImageData(image, 0, 0);
}

/** Two looks have the same drawing. */
export function isSame(one: Look | null, other: Look | null): boolean {
  if (one === other) return true;
  if (one === null || other === null || one.awake !== other.awake || one.packed.length !== other.packed.length) return false;
  for (let index = 0; index < one.packed.length; index++) if (one.packed[index] !== other.packed[index]) return false;
  return true;
}
