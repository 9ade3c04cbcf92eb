// Frames of a scene that moves: one clock for all its images, and the controls under the stage.

const SPEEDS = [0.125, 0.25, 0.5, 1, 2, 4];
/** What follows the last frame: each a function from a frame and a direction to the next ones, or null at the end. */
const rounds = {
  loop: { text: "again and again", next: (frame, way, last) => [frame + way > last ? 0 : frame + way < 0 ? last : frame + way, way] },
  turn: { text: "to and fro", next: (frame, way, last) => (frame + way > last || frame + way < 0 ? [frame - way, -way] : [frame + way, way]) },
  once: { text: "once", next: (frame, way, last) => (frame + way > last || frame + way < 0 ? null : [frame + way, way]) },
};
const stillness = matchMedia("(prefers-reduced-motion: reduce)");

class Player {
  constructor(scene) {
    Object.assign(this, { scene, playing: !stillness.matches, speed: 1, round: "loop", way: 1, asked: 0 });
    const { frames } = scene.settings;
    const button = (text, label, title, onclick) => make("button", { type: "button", text, title, "aria-label": label, onclick });
    this.button = button("", "play", "space", () => this.toggle());
    this.slider = make("input", { type: "range", min: 1, max: frames, step: 1, "aria-label": "frame" });
    this.slider.addEventListener("input", () => this.halt(Number(this.slider.value) - 1));
    this.number = make("output");
    this.pace = make(
      "select",
      { "aria-label": "speed", title: "s, Shift+S", onchange: (event) => this.hasten(Number(event.target.value)) },
      ...SPEEDS.map((speed) => make("option", { value: speed, text: speed < 1 ? `1/${1 / speed} speed` : `${speed}× speed` })),
    );
    this.after = make(
      "select",
      { "aria-label": "after the last frame", onchange: (event) => (this.round = event.target.value) },
      ...Object.entries(rounds).map(([value, { text }]) => make("option", { value, text })),
    );
    const before = button("‹", "the frame before", "<", () => this.step(-1));
    const next = button("›", "the next frame", ">", () => this.step(1));
    this.element = make("div", { class: "player", role: "group", "aria-label": "frames" }, this.button, before, this.slider, next, this.number, this.pace, this.after);
  }

  get last() {
    return this.scene.settings.frames - 1;
  }

  /** Shows a frame, and stays there. */
  halt(frame) {
    this.playing = false;
    this.scene.set({ frame });
  }

  step(by) {
    const count = this.last + 1;
    this.halt((this.scene.state.frame + by + count) % count);
  }

  toggle() {
    this.playing = !this.playing;
    if (this.playing && this.round === "once" && this.scene.state.frame === this.last) this.scene.set({ frame: 0 });
    this.scene.bench.tell();
    this.run();
  }

  hasten(speed) {
    this.speed = speed;
    this.scene.bench.tell();
  }

  /** The next speed in the list, or the one before. */
  shift(by) {
    this.hasten(SPEEDS[clamp(SPEEDS.indexOf(this.speed) + by, 0, SPEEDS.length - 1)]);
  }

  /** Starts the clock if there is something to play; it stops by itself when there is not. */
  run() {
    if (this.asked) return;
    this.due = performance.now() + this.period;
    this.tick();
  }

  get period() {
    return 1000 / (this.scene.settings.motion.fps * this.speed);
  }

  tick() {
    const { scene } = this;
    this.asked = this.playing && scene.awake && scene.films ? requestAnimationFrame((now) => this.advance(now)) : 0;
  }

  /** Whether some of the scene is seen: what nobody sees does not move on. */
  get inView() {
    const { top, bottom } = this.scene.section.getBoundingClientRect();
    return bottom > 0 && top < innerHeight;
  }

  /** No frame is left out: where the page cannot keep up, time passes more slowly. */
  advance(now) {
    if (now >= this.due && this.playing && this.inView) {
      this.due = Math.max(this.due + this.period, now);
      const next = rounds[this.round].next(this.scene.state.frame, this.round === "turn" ? this.way : 1, this.last);
      if (next) {
        this.way = next[1];
        this.scene.set({ frame: next[0] });
      } else {
        this.playing = false;
        this.scene.bench.tell();
      }
    }
    this.tick();
  }

  /** Says which frame is shown. */
  tell() {
    const { frame } = this.scene.state;
    this.button.textContent = this.playing ? "❚❚" : "▶";
    this.button.setAttribute("aria-label", this.playing ? "pause" : "play");
    this.slider.value = String(frame + 1);
    this.number.textContent = `frame ${frame + 1} of ${this.last + 1}`;
    this.pace.value = String(this.speed);
  }
}
