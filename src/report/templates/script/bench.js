// The bench of a scene: the stage with its wipe, the list of films with their values, the tools, the key to colours.

class Bench {
  constructor(scene) {
    this.scene = scene;
    this.canvas = make("canvas", { tabindex: "0", role: "img" });
    this.handle = make("div", { class: "wipe", role: "slider", tabindex: "0", "aria-label": "wipe", "aria-valuemin": "0", "aria-valuemax": "100" });
    this.caption = make("p", { class: "says", "aria-live": "polite" });
    this.pixel = make("p", { class: "pixel" });
    this.key = { bar: make("span", { class: "bar" }), ends: [0, 1, 2].map(() => make("span")) };
    this.films = scene.settings.labels.map((label, i) => this.filmButton(label, i));
    const stage = make("div", { class: "stage" }, this.canvas, this.handle);
    const list = make("div", { class: "films", role: "group", "aria-label": "images" }, this.pixel, ...this.films);
    const key = make("div", { class: "key" }, this.key.bar, ...this.key.ends);
    const below = [scene.player?.element, key, this.caption].filter(Boolean);
    this.element = make("div", { class: "bench" }, this.tools(), make("div", { class: "view" }, stage, ...below), list);
    scene.section.querySelector(".row").before(this.element);
    this.watchHandle();
  }

  filmButton(label, i) {
    const value = make("span", { class: "value" });
    const choose = (event) => this.scene.set(event.shiftKey ? { other: i } : { one: i });
    const name = make("span", { class: "name", text: label });
    return make("button", { type: "button", onclick: choose, title: "Shift-click: compare with it" }, make("kbd", { text: keyOf(i) }), name, value);
  }

  tools() {
    const { scene } = this;
    const tool = (text, title, run) => make("button", { type: "button", text, title, onclick: run });
    this.maps = scene.maps.map((name) => [name, tool(maps[name].name, maps[name].says ?? "m: the next", () => scene.set({ map: name }))]);
    this.wipe = tool("wipe", "w: one image to the left of a line, the other to the right", () => toggleWipe(scene));
    this.other = make(
      "select",
      { "aria-label": "compared with", onchange: (event) => scene.set({ other: Number(event.target.value) }) },
      ...scene.settings.labels.map((label, i) => make("option", { value: i, text: label })),
    );
    this.exposure = make("output");
    return make(
      "div",
      { class: "tools", role: "toolbar", "aria-label": "how images are shown" },
      make("span", { class: "group" }, ...this.maps.map(([, button]) => button)),
      make("label", { class: "group" }, "against ", this.other),
      make("span", { class: "group" }, this.wipe),
      make("span", { class: "group" }, tool("−", "Shift+E: darker", () => expose(scene, -0.5)), this.exposure, tool("+", "e: brighter", () => expose(scene, 0.5))),
      make("span", { class: "group" }, tool("−", "zoom out", () => scene.look((camera) => camera.zoomBy(0.5))), "zoom", tool("+", "zoom in", () => scene.look((camera) => camera.zoomBy(2))), tool("fit", "f", () => scene.showInset(-1)), tool("inset", "i: the next", () => scene.nextInset())),
      make("span", { class: "group" }, tool("?", "all keys", showHelp)),
    );
  }

  watchHandle() {
    const { scene, handle } = this;
    const follow = (event) => {
      const { left, width } = this.canvas.getBoundingClientRect();
      scene.set({ wipe: clamp((event.clientX - left) / width, 0, 1) });
    };
    handle.addEventListener("pointerdown", (event) => {
      handle.setPointerCapture(event.pointerId);
      event.preventDefault();
      handle.focus({ preventScroll: true });
    });
    handle.addEventListener("pointermove", (event) => handle.hasPointerCapture(event.pointerId) && follow(event));
    handle.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -0.02, ArrowRight: 0.02 }[event.key];
      if (!by) return;
      moveWipe(scene, by);
      event.preventDefault();
      event.stopPropagation();
    });
  }

  /** Says in words and marks on buttons what is chosen. */
  tell() {
    const { scene } = this;
    const { state } = scene;
    const pressed = (button, on) => button.setAttribute("aria-pressed", String(on));
    this.films.forEach((button, i) => {
      pressed(button, i === scene.shown);
      button.classList.toggle("other", i === state.other && (state.wipe !== null || state.map === "improvement"));
    });
    this.maps.forEach(([name, button]) => pressed(button, name === state.map));
    pressed(this.wipe, state.wipe !== null);
    this.other.value = String(state.other);
    this.exposure.textContent = `${state.stops < 0 ? "−" : "+"}${Math.abs(state.stops)} stops`;
    this.handle.hidden = state.wipe === null;
    this.handle.style.left = `${100 * (state.wipe ?? 0)}%`;
    this.handle.setAttribute("aria-valuenow", String(Math.round(100 * (state.wipe ?? 0))));
    const says = this.says();
    if (this.caption.textContent !== says) this.caption.textContent = says;
    this.canvas.setAttribute("aria-label", says);
    scene.player?.tell();
    this.tellColours();
    this.tellValues();
  }

  says() {
    const { scene } = this;
    const { state } = scene;
    const one = scene.label(scene.shown);
    const other = scene.label(state.other);
    const map = maps[state.map].says ?? maps[state.map].name;
    if (state.map === "improvement") return `Who is nearer to the reference: ${one} (blue) or ${other} (orange)`;
    return state.wipe === null ? `${one}: ${map}` : `${one} | ${other}: ${map}`;
  }

  tellColours() {
    const { scene } = this;
    const map = maps[scene.state.map];
    const ends = map.ends(scene.unit(scene.state.map), scene.label(scene.shown), scene.label(scene.state.other));
    this.key.bar.style.background = gradient(map.anchors);
    this.key.ends.forEach((end, i) => (end.textContent = ends[i]));
  }

  /** The radiance of every film at the pixel, and what it is off by. */
  tellValues() {
    const { scene } = this;
    const { at } = scene.state;
    const [x, y] = at ? at.map(Math.floor) : [];
    const compares = scene.maps.includes("signed");
    this.pixel.textContent = at ? `pixel (${x}, ${y}): radiance${compares ? ", error" : ""}` : "point at a pixel for its values";
    this.films.forEach((button, i) => {
      const value = button.querySelector(".value");
      const there = at && scene.films;
      value.textContent = there ? figure(scene.valueAt("radiance", i, x, y)) : "";
      const error = there && compares && i !== scene.settings.reference ? figure(scene.valueAt("signed", i, x, y), 2) : "";
      value.append(make("small", { text: error }));
    });
  }

  draw() {
    const { scene } = this;
    const { state, camera } = scene;
    const { context, width, height } = prepare(this.canvas);
    const { seen } = camera;
    const map = state.map;
    drawSeen(context, scene.picture(scene.shown, map), seen, 0, 0, width, height);
    const wiped = state.wipe !== null && map !== "improvement";
    if (wiped) {
      const from = state.wipe * width;
      context.save();
      context.beginPath();
      context.rect(from, 0, width - from, height);
      context.clip();
      drawSeen(context, scene.picture(state.other, map), seen, 0, 0, width, height);
      context.restore();
    }
    const filmAt = (share) => (wiped && share > state.wipe ? state.other : scene.shown);
    drawGrid(context, seen, scene.settings.width, width, height, (x, y, share) => figure(scene.valueAt(map, filmAt(share), x, y)));
    drawFrames(context, scene.insets, seen, width, height);
    if (state.drawn) drawFrames(context, [state.drawn], seen, width, height);
    if (state.at) drawMark(context, state.at, seen, width, height);
  }
}

const toggleWipe = (scene) => scene.set({ wipe: scene.state.wipe === null ? 0.5 : null });
const moveWipe = (scene, by) => scene.set({ wipe: clamp((scene.state.wipe ?? 0.5) + by, 0, 1) });
const expose = (scene, by) => scene.set({ stops: clamp(scene.state.stops + by, -12, 12) });
