// Colours of the plan. Kinds use the palette of Okabe and Ito, which colour-blind people can distinguish; the outline
// of a glyph, not its fill, contrasts with the floor.

export const okabeIto = {
  orange: '#E69F00',
  sky: '#56B4E9',
  green: '#009E73',
  yellow: '#F0E442',
  blue: '#0072B2',
  vermillion: '#D55E00',
  purple: '#CC79A7',
  black: '#000000',
} as const;

/** Of residents, in their order; a name is next to each, so that colour is never alone. */
export const people: readonly string[] = [
  okabeIto.vermillion,
  okabeIto.blue,
  okabeIto.green,
  okabeIto.purple,
  okabeIto.orange,
  okabeIto.sky,
  okabeIto.yellow,
];

/** Viridis at eleven steps, from Matplotlib; colours in between are mixed. */
const VIRIDIS = [
  '#440154', '#482475', '#414487', '#355f8d', '#2a788e', '#21918c', '#22a884', '#44bf70', '#7ad151', '#bddf26', '#fde725',
];

/** The colour of a share from 0 to 1. */
export function viridis(share: number): string {
  const at = Math.min(Math.max(share, 0), 1) * (VIRIDIS.length - 1);
  const below = Math.min(Math.floor(at), VIRIDIS.length - 2);
  return mix(VIRIDIS[below]!, VIRIDIS[below + 1]!, at - below);
}

/** `share` of `b` in `a`, both `#rrggbb`. */
export function mix(a: string, b: string, share: number): string {
  const [from, to] = [channels(a), channels(b)];
  const mixed = from.map((value, index) => Math.round(value + (to[index]! - value) * share));
  return `#${mixed.map((value) => value.toString(16).padStart(2, '0')).join('')}`;
}

function channels(colour: string): number[] {
  return [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
}

/** The contrast of two colours by WCAG, from 1 to 21. */
export function contrast(a: string, b: string): number {
  const [dark, bright] = [luminance(a), luminance(b)].sort((x, y) => x - y) as [number, number];
  return (bright + 0.05) / (dark + 0.05);
}

function luminance(colour: string): number {
  const [r, g, b] = channels(colour).map((value) => {
    const c = value / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  }) as [number, number, number];
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

export type Palette = {
  outside: string;
  floorDay: string;
  floorNight: string;
  floorLit: string;
  wall: string;
  furniture: string;
  furnitureEdge: string;
  soft: string;
  text: string;
  quiet: string;
  sensor: string;
  halo: string;
  beam: string;
  /** Detections; of two compared runs the first, as `beam` is the second. */
  seen: string;
  /** On a time line: hits of a search, and marks of the user. */
  found: string;
  marked: string;
  area: string;
  on: string;
  outline: string;
};

export const light: Palette = {
  outside: '#eef1f4',
  floorDay: '#fbf8f1',
  floorNight: '#c3c9d8',
  floorLit: '#fff3cf',
  wall: '#2b3440',
  furniture: '#ffffff',
  furnitureEdge: '#7f8894',
  soft: '#f0ebdf',
  text: '#1d2630',
  quiet: '#47515d',
  sensor: '#004f7c',
  halo: '#ffffff',
  beam: '#0072B2',
  seen: '#D55E00',
  found: '#00795A',
  marked: '#A4497B',
  area: '#0072B2',
  on: '#B34700',
  outline: '#16202b',
};

export const dark: Palette = {
  outside: '#10151b',
  floorDay: '#2b333d',
  floorNight: '#171d2b',
  floorLit: '#453f2a',
  wall: '#a9b4c0',
  furniture: '#3a4450',
  furnitureEdge: '#85919e',
  soft: '#333c47',
  text: '#f1f4f7',
  quiet: '#c3cbd4',
  sensor: '#a9d8f6',
  halo: '#12171d',
  beam: '#56B4E9',
  seen: '#F5B041',
  found: '#3FD0A2',
  marked: '#E39AC4',
  area: '#56B4E9',
  on: '#FFC247',
  outline: '#f4f7fa',
};

/** Daylight by the height of the sun, from 0 to 1: dark below the horizon, with some twilight on either side. */
export function daylight(sun: number): number {
  return Math.min(Math.max((sun + 0.12) / 0.27, 0), 1);
}

/** The floor by daylight and lamp, each from 0 to 1. By day a lamp adds little. */
export function floor(palette: Palette, day: number, lamp: number): string {
  const unlit = mix(palette.floorNight, palette.floorDay, day);
  return lamp > 0 ? mix(unlit, palette.floorLit, lamp * (1 - 0.6 * day)) : unlit;
}
