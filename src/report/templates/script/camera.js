// Which part of an image is seen: one camera for all images of a scene.

const MOST = 64;

class Camera {
  constructor(width, height) {
    Object.assign(this, { width, height });
    this.fit();
  }

  /** All of the image. */
  fit() {
    Object.assign(this, { zoom: 1, left: 0, top: 0 });
  }

  /** What is seen, in pixels of the image. */
  get seen() {
    return { x: this.left, y: this.top, width: this.width / this.zoom, height: this.height / this.zoom };
  }

  /** Zooms so that the point of the image at this share of the view stays where it is. */
  zoomBy(factor, [across, down] = [0.5, 0.5]) {
    const before = this.seen;
    this.zoom = clamp(this.zoom * factor, 1, Math.max(MOST, this.width / 8));
    const after = this.seen;
    this.moveTo(before.x + across * (before.width - after.width), before.y + down * (before.height - after.height));
  }

  /** Moves by a share of the view. */
  moveBy(across, down) {
    this.moveTo(this.left + across * this.seen.width, this.top + down * this.seen.height);
  }

  moveTo(left, top) {
    const { width, height } = this.seen;
    this.left = clamp(left, 0, this.width - width);
    this.top = clamp(top, 0, this.height - height);
  }

  /** Shows a rectangle of the image, as large as it goes. */
  show({ x, y, width, height }) {
    this.zoom = Math.max(1, Math.min(this.width / width, this.height / height));
    const seen = this.seen;
    this.moveTo(x + 0.5 * (width - seen.width), y + 0.5 * (height - seen.height));
  }

  /** The point of the image at a share of the view. */
  pointAt([across, down]) {
    const { x, y, width, height } = this.seen;
    return [x + across * width, y + down * height];
  }
}
