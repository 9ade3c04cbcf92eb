// Keys of scenes: one table, which the help shows too.

const nextMap = (scene) => {
  const { maps: names } = scene;
  scene.set({ map: names[(names.indexOf(scene.state.map) + 1) % names.length] });
};
const swap = (scene) => scene.set({ one: scene.state.other, other: scene.state.one });
const fitOrClose = (scene) => {
  if (scene.camera.zoom === 1 && scene.section.classList.contains("exact")) scene.lookCloser(false);
  scene.showInset(-1);
};
const pan = (across, down) => (scene) => scene.look((camera) => camera.moveBy(across, down));
const zoom = (factor) => (scene) => scene.look((camera) => camera.zoomBy(factor));

/** [keys as `event.key` says them, as the help says them, what they do, how]. */
const bindings = [
  [["ArrowRight"], "→", "the next image", (scene) => scene.step(1)],
  [["ArrowLeft"], "←", "the image before", (scene) => scene.step(-1)],
  [["r"], "hold r", "the reference, as long as the key is down", (scene) => scene.set({ held: true })],
  [["m"], "m", "what is shown: radiance, |error|, signed error, improvement; of what moves also changes", nextMap],
  [["b"], "b", "compare with the image that is shown", (scene) => scene.set({ other: scene.state.one })],
  [["x"], "x", "swap the image shown and the one compared with", swap],
  [["w"], "w", "wipe between the two", toggleWipe],
  [[","], ",", "the wipe’s line to the left", (scene) => moveWipe(scene, -0.02)],
  [["."], ".", "the wipe’s line to the right", (scene) => moveWipe(scene, 0.02)],
  [["e"], "e", "half a stop brighter; errors so much stronger", (scene) => expose(scene, 0.5)],
  [["E"], "Shift+E", "half a stop darker", (scene) => expose(scene, -0.5)],
  [["+", "="], "+", "zoom in", zoom(Math.SQRT2)],
  [["-"], "−", "zoom out", zoom(Math.SQRT1_2)],
  [["h", "j", "k", "l"], "h j k l", "move to the left, down, up, to the right", null],
  [["i"], "i", "the next inset, then all of the image", (scene) => scene.nextInset()],
  [["f", "Escape"], "f, Esc", "all of the image; then, of a paper’s figure, as it was printed", fitOrClose],
  [["?"], "?", "this help", () => showHelp()],
];
/** The same of scenes that move. */
const frameBindings = [
  [[" "], "space", "play, pause", ({ player }) => player.toggle()],
  [["<"], "<", "the frame before", ({ player }) => player.step(-1)],
  [[">"], ">", "the next frame", ({ player }) => player.step(1)],
  [["s"], "s", "slower", ({ player }) => player.shift(-1)],
  [["S"], "Shift+S", "faster", ({ player }) => player.shift(1)],
];
const moves = { h: pan(-0.1, 0), j: pan(0, 0.1), k: pan(0, -0.1), l: pan(0.1, 0) };

const help = make(
  "dialog",
  { class: "help", "aria-label": "keys" },
  make("h2", { text: "Keys" }),
  make(
    "dl",
    {},
    ...[
      ["0", "the reference; of a paper’s figure, its first image"],
      ["1 … 9", "a method, or image; with Shift, or by its number’s key, ten more"],
      ...bindings.map(([, keys, does]) => [keys, does]),
      ...frameBindings.map(([, keys, does]) => [keys, `of what moves: ${does}`]),
      ["wheel", "zoom about the pointer, once a scene was clicked or reached by Tab; with Ctrl always"],
      ["drag", "move all images of the scene; with Shift, mark an inset"],
      ["click", "on an image: show it; with Shift: compare with it; on an inset: go there"],
      ["click", "on a figure of a table: the rows of metrics.csv that it follows from"],
    ].flatMap(([keys, does]) => [make("dt", {}, make("kbd", { text: keys })), make("dd", { text: does })]),
  ),
  make("form", { method: "dialog" }, make("button", { text: "close" })),
);

const showHelp = () => {
  if (!help.isConnected) document.body.append(help);
  help.showModal();
};

/** The number of the film that a digit key asks for. */
const filmOf = (event) => {
  const digit = /^(?:Digit|Numpad)([0-9])$/.exec(event.code)?.[1] ?? (/^[0-9]$/.test(event.key) ? event.key : null);
  return digit === null ? null : Number(digit) + (event.shiftKey ? 10 : 0);
};

/** The scene that keys go to: the one with the focus, else under the pointer, else most in view. */
const activeScene = (scenes) => {
  const focused = scenes.find(({ section }) => section.contains(document.activeElement));
  const hovered = () => scenes.find(({ section }) => section.matches(":hover"));
  const inView = ({ section }) => {
    const { top, bottom } = section.getBoundingClientRect();
    return Math.min(bottom, innerHeight) - Math.max(top, 0);
  };
  const seen = () => scenes.filter((scene) => inView(scene) > 0).sort((a, b) => inView(b) - inView(a))[0];
  return focused ?? hovered() ?? seen();
};

/** What a key does in a scene, if anything. */
const actionOf = (scene, key) => {
  const found = (table) => table.find(([keys]) => keys.includes(key))?.[3];
  return moves[key] ?? found(bindings) ?? (scene.player ? found(frameBindings) : undefined);
};

/** Whether a key is meant for the element that has the focus, not for a scene. */
const meantElsewhere = ({ target, key }) => {
  const on = (selector) => target.closest?.(selector);
  if (on("input[type=range]")) return /^(Arrow|Home|End|Page)/.test(key);
  // A button that was reached by keys is pressed by the space bar; one that was clicked has had its turn.
  if (key === " " && on("button, a, summary")) return target.matches(":focus-visible");
  return on("input, select, textarea, dialog");
};

const watchKeys = (scenes) => {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || meantElsewhere(event)) return;
    if (event.key === "?") return showHelp();
    const scene = activeScene(scenes);
    if (!scene) return;
    const film = filmOf(event);
    const run = actionOf(scene, event.key);
    if (film !== null) scene.choose(film);
    else if (run) run(scene);
    else return;
    // Some browsers press a button when the space bar goes up again.
    if (event.key === " ") scene.bench.canvas.focus({ preventScroll: true });
    event.preventDefault();
  });
  const letGo = () => scenes.filter(({ state }) => state.held).forEach((scene) => scene.set({ held: false }));
  document.addEventListener("keyup", ({ key }) => key === "r" && letGo());
  window.addEventListener("blur", letGo);
};
