// The visible part of the plan: all of it, until the user zooms.

import type { At } from '../../plan/geometry';
import { type Bounds, type Size, type View, fit, pan, toPlan, toScreen, zoom } from '../../plan/transform';

/** Dimension lines, tools and the scale are at the edges. */
const INSETS = { left: 58, top: 48, right: 60, bottom: 84 };
/** Points nearer to the edge are moved to the middle when they are shown. */
const EDGE = 50;

export class Viewport {
  view = $state.raw<View>({ scale: 50, x: 0, y: 0 });
  size = $state.raw<Size>({ width: 0, height: 0 });
  private fitted = true;
  private bounds: Bounds = [[0, 0], [10, 7]];

  /** Keeps all visible parts visible: another home is shown as a whole, while an edited one does not jump. */
  know(bounds: Bounds): void {
    this.bounds = bounds;
    const { width, height } = this.size;
    const isSeen = bounds.every((corner) => {
      const [x, y] = toScreen(this.view, corner);
      return x >= 0 && y >= 0 && x <= width && y <= height;
    });
    if (this.fitted && !isSeen) this.fit();
  }

  resize(width: number, height: number): void {
    if (width < 1 || height < 1) return;
    const before = toPlan(this.view, [this.size.width / 2, this.size.height / 2]);
    this.size = { width, height };
    if (this.fitted) this.fit();
    else this.centre(before);
  }

  fit(): void {
    this.fitted = true;
    if (this.size.width > 0) this.view = fit(this.bounds, this.size, INSETS);
  }

  zoom(factor: number, at: At = [this.size.width / 2, this.size.height / 2]): void {
    this.fitted = false;
    this.view = zoom(this.view, factor, at);
  }

  pan(dx: number, dy: number): void {
    this.fitted = false;
    this.view = pan(this.view, dx, dy);
  }

  show(at: At): void {
    const [x, y] = toScreen(this.view, at);
    const { width, height } = this.size;
    if (x < EDGE || y < EDGE || x > width - EDGE || y > height - EDGE) this.centre(at);
  }

  get middle(): At {
    return toPlan(this.view, [this.size.width / 2, this.size.height / 2]);
  }

  private centre(at: At): void {
    const [x, y] = toScreen(this.view, at);
    this.pan(this.size.width / 2 - x, this.size.height / 2 - y);
  }
}
