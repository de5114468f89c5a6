// Drawings of lines as SVG, by the strokes of a canvas.

import type { Ink } from '../plan/pen';

const escaped = (text: string) => text.replace(/[&<>"']/g, (sign) => `&#${sign.charCodeAt(0)};`).replace(/[\u0000-\u0008\u000b\u000c\u000e-\u001f\ufffe\uffff]/g, '');
const short = (number: number) => String(Math.round(number * 100) / 100);

export class SvgInk implements Ink {
  globalAlpha = 1;
  fillStyle: string | CanvasGradient | CanvasPattern = '#000';
  strokeStyle: string | CanvasGradient | CanvasPattern = '#000';
  lineWidth = 1;
  lineJoin: CanvasLineJoin = 'miter';
  font = '12px sans-serif';
  textAlign: CanvasTextAlign = 'left';
  textBaseline: CanvasTextBaseline = 'alphabetic';
  private readonly parts: string[] = [];
  private path = '';

  /** @param measuring measures the width of words. */
  constructor(private readonly measuring: Pick<CanvasRenderingContext2D, 'font' | 'measureText'> | null) {}

  private get alpha(): string {
    return this.globalAlpha < 1 ? ` opacity="${short(this.globalAlpha)}"` : '';
  }

  fillRect(x: number, y: number, width: number, height: number): void {
    this.parts.push(`<rect x="${short(x)}" y="${short(y)}" width="${short(width)}" height="${short(height)}" fill="${escaped(String(this.fillStyle))}"${this.alpha}/>`);
  }

  fillText(words: string, x: number, y: number): void {
    const [, weight, size, family] = /^(?:(\d+|bold) )?([\d.]+)px (.*)$/.exec(this.font) ?? [, undefined, '12', 'sans-serif'];
    const anchor = { center: 'middle', right: 'end', end: 'end' }[this.textAlign as string] ?? 'start';
    const base = this.textBaseline === 'middle' ? ' dominant-baseline="central"' : '';
    // Direction marks belong to the page, and are not letters.
    const plain = words.replace(/[\u2066-\u2069]/g, '');
    this.parts.push(`<text x="${short(x)}" y="${short(y)}" font-size="${size}" font-family="${escaped(family!)}"${weight === undefined ? '' : ` font-weight="${weight}"`} text-anchor="${anchor}"${base} fill="${escaped(String(this.fillStyle))}"${this.alpha}>${escaped(plain)}</text>`);
  }

  measureText(words: string): TextMetrics {
    if (this.measuring === null) return { width: words.length * 6 } as TextMetrics;
    this.measuring.font = this.font;
    return this.measuring.measureText(words);
  }

  beginPath(): void {
    this.path = '';
  }

  moveTo(x: number, y: number): void {
    this.path += `M${short(x)} ${short(y)}`;
  }

  lineTo(x: number, y: number): void {
    this.path += `L${short(x)} ${short(y)}`;
  }

  closePath(): void {
    this.path += 'Z';
  }

  /** Only whole circles are drawn. */
  arc(x: number, y: number, radius: number): void {
    this.path += `M${short(x - radius)} ${short(y)}a${short(radius)} ${short(radius)} 0 1 0 ${short(2 * radius)} 0a${short(radius)} ${short(radius)} 0 1 0 ${short(-2 * radius)} 0`;
  }

  fill(): void {
    this.parts.push(`<path d="${this.path}" fill="${escaped(String(this.fillStyle))}"${this.alpha}/>`);
  }

  stroke(): void {
    this.parts.push(`<path d="${this.path}" fill="none" stroke="${escaped(String(this.strokeStyle))}" stroke-width="${short(this.lineWidth)}" stroke-linejoin="${this.lineJoin}"${this.alpha}/>`);
  }

  svg(width: number, height: number, ground: string): string {
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${short(width)}" height="${short(height)}" viewBox="0 0 ${short(width)} ${short(height)}"><rect width="100%" height="100%" fill="${ground}"/>${this.parts.join('')}</svg>\n`;
  }
}
