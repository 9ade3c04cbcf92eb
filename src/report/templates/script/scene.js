// A scene: its films, what is chosen, and its pictures: a large one (the stage), and a figure a film.

/** How the `i`-th film is called for by a key. */
const keyOf = (i) => (i < 10 ? String(i) : i < 20 ? `⇧${i - 10}` : "");

class Scene {
  constructor(section) {
    this.section = section;
    this.settings = JSON.parse(section.querySelector(".settings").textContent);
    const { width, height, frames, reference, against, insets } = this.settings;
    this.camera = new Camera(width, height);
    this.insets = [...insets];
    this.maps = mapsOf(this.settings);
    const below = ["flicker", "signed"].find((name) => this.maps.includes(name)) ?? null;
    this.state = { one: Math.min(1, this.count - 1), other: against, map: "radiance", below, frame: 0 };
    Object.assign(this.state, { stops: 0, wipe: null, held: false, at: null, inset: -1 });
    if (this.state.one === reference) this.state.one = 0;
    section.style.setProperty("--shape", `${width} / ${height}`);
    this.player = frames > 1 ? new Player(this) : null;
    this.bench = new Bench(this);
    this.figures = [...section.querySelectorAll(".row figure")].map((figure, i) => new FilmFigure(this, figure, i));
    this.redraw = oncePerFrame(() => this.draw());
    watchPointer(this, this.bench.canvas, null);
    this.awake = false;
    // A figure of a paper stands as it was printed until one looks closer.
    this.open = !section.classList.contains("exact");
    this.bench.tell();
  }

  /** Shows the bench. */
  lookCloser(open) {
    if (open === this.open) return;
    this.open = open;
    this.section.classList.toggle("open", open);
    this.redraw();
  }

  get count() {
    return this.settings.labels.length;
  }

  label(i) {
    return this.settings.labels[i];
  }

  /** The film that is shown: the reference while its key is held. */
  get shown() {
    return this.state.held ? (this.settings.reference ?? this.state.one) : this.state.one;
  }

  /** The radiances of a film in the frame that is shown, or `by` frames on; there is none before the first. */
  frameOf(film, by = 0) {
    const { width, height } = this.settings;
    const first = Math.max(0, this.state.frame + by) * width * height;
    return this.films[film].subarray(first, first + width * height);
  }

  /** The mean change of a film over all frames, pixel by pixel. */
  flickerOf(film) {
    const { width, height } = this.settings;
    this.flickers ??= [];
    return (this.flickers[film] ??= meanChange(this.films[film], null, width * height));
  }

  /** The mean change of its error. */
  wrongFlickerOf(film) {
    const { width, height, reference } = this.settings;
    this.wrongFlickers ??= [];
    return (this.wrongFlickers[film] ??= meanChange(this.films[film], this.films[reference], width * height));
  }

  /** Decodes the films, once. */
  async load() {
    this.loading ??= Promise.all(
      this.figures.map(({ packed }) => unpack(packed.textContent, this.settings.scale)),
    ).then((films) => {
      this.films = films;
      this.figures.forEach(({ packed }) => packed.remove());
    });
    return this.loading;
  }

  /** Draws from now on: the scene is near what is seen of the page. */
  async wake() {
    this.awake = true;
    await this.load();
    this.redraw();
    this.player?.run();
  }

  /** Lets go of its pictures; they are drawn anew when it wakes. */
  sleep() {
    this.awake = false;
    this.pictures = undefined;
    for (const canvas of this.section.querySelectorAll("canvas")) canvas.width = 0;
  }

  /** Changes what is chosen. */
  set(change) {
    Object.assign(this.state, change);
    if (change.map && change.map !== "radiance") this.state.below = change.map;
    this.bench.tell();
    this.redraw();
  }

  choose(i) {
    if (i < 0 || i >= this.count) return;
    this.lookCloser(true);
    this.set({ one: i });
  }

  step(by) {
    this.choose((this.state.one + by + this.count) % this.count);
  }

  /** Moves the camera; all pictures of the scene follow. */
  look(move) {
    move(this.camera);
    this.bench.tell();
    this.redraw();
  }

  /** Shows the next inset, and after the last one all of the image. */
  nextInset() {
    const inset = this.state.inset + 1 < this.insets.length ? this.state.inset + 1 : -1;
    this.showInset(inset);
  }

  showInset(inset) {
    this.state.inset = inset;
    this.look((camera) => (inset < 0 ? camera.fit() : camera.show(this.insets[inset])));
  }

  /** Takes a rectangle of the image as the reader's own inset. */
  mark(rectangle) {
    this.insets = [...this.settings.insets, rectangle];
    this.redraw();
  }

  /** The value shown as the last colour. */
  unit(map) {
    return maps[map].unit(this.settings) * 2 ** -this.state.stops;
  }

  /** What a map says of a film at a pixel. */
  valueAt(map, film, x, y) {
    const i = y * this.settings.width + x;
    return maps[map].value(...this.layersOf(map, film).map((layer) => layer[i]));
  }

  layersOf(map, film) {
    return maps[map].layers.map((layer) => layers[layer](this, film));
  }

  /** A map of a film as a picture, painted anew only if what it depends on has changed. */
  picture(film, map) {
    this.pictures ??= new Map();
    const name = `${film} ${map === "radiance" ? "above" : "below"}`;
    const { stops, other, frame } = this.state;
    const stamp = [map, stops, maps[map].layers.includes("other") ? other : "", frame].join(" ");
    let found = this.pictures.get(name);
    if (found?.stamp === stamp) return found.canvas;
    const { width, height } = this.settings;
    found ??= { canvas: make("canvas", { width, height }) };
    paintMap(found.canvas, maps[map], this.unit(map), this.layersOf(map, film));
    this.pictures.set(name, { ...found, stamp });
    return found.canvas;
  }

  draw() {
    if (!this.films) return;
    if (this.open) this.bench.draw();
    this.figures.forEach((figure) => figure.draw());
  }
}

/** A film's figure: its image, a map of its error, and its insets. */
class FilmFigure {
  constructor(scene, figure, film) {
    Object.assign(this, { scene, film });
    this.packed = figure.querySelector("script");
    const label = scene.label(film);
    const canvas = (what) => make("canvas", { role: "img", "aria-label": `${label}: ${what}` });
    this.above = canvas("image");
    this.below = scene.state.below && canvas("map");
    this.close = make("canvas", { role: "img", class: "close", "aria-label": `${label}: insets` });
    figure.append(...[this.above, this.below, this.close].filter(Boolean));
    figure.style.setProperty("--insets", String(Math.max(1, scene.insets.length)));
    figure.querySelector("figcaption").prepend(make("kbd", { text: keyOf(film) }));
    watchPointer(scene, this.above, film);
    if (this.below) watchPointer(scene, this.below, film);
    this.close.addEventListener("click", (event) => {
      const { width } = this.close.getBoundingClientRect();
      scene.showInset(Math.floor((event.offsetX / width) * scene.insets.length));
    });
    this.figure = figure;
  }

  draw() {
    const { scene, film } = this;
    const { seen } = scene.camera;
    this.figure.classList.toggle("on", scene.open && film === scene.state.one);
    for (const [canvas, map] of [[this.above, "radiance"], [this.below, scene.state.below]]) {
      if (!canvas) continue;
      const { context, width, height } = prepare(canvas);
      drawSeen(context, scene.picture(film, map), seen, 0, 0, width, height);
      if (canvas === this.above) drawFrames(context, scene.insets, seen, width, height);
      if (scene.state.at) drawMark(context, scene.state.at, seen, width, height);
    }
    this.drawInsets();
  }

  drawInsets() {
    const { scene, film } = this;
    const { insets } = scene;
    this.figure.style.setProperty("--insets", String(Math.max(1, insets.length)));
    this.close.hidden = insets.length === 0;
    if (this.close.hidden) return;
    const { context, width, height } = prepare(this.close);
    context.clearRect(0, 0, width, height);
    const gap = 3;
    const across = (width + gap) / Math.max(1, insets.length) - gap;
    insets.forEach((inset, i) => {
      const left = i * (across + gap);
      drawSeen(context, scene.picture(film, "radiance"), inset, left, 0, across, height);
      context.lineWidth = 2;
      context.strokeStyle = INSET_COLOURS[i % INSET_COLOURS.length];
      context.strokeRect(left + 1, 1, across - 2, height - 2);
    });
  }
}
