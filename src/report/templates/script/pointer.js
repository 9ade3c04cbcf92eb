// The mouse, a pen or a finger on a canvas of a scene: values under it, dragging, the wheel, the reader's own inset.

/** `film` is the one that a click chooses; null on the stage. */
const watchPointer = (scene, canvas, film) => {
  /** Where the pointer is, as shares of the canvas. */
  const share = (event) => {
    const box = canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  };
  const pointAt = (event) => {
    const { width, height } = scene.settings;
    const [x, y] = scene.camera.pointAt(share(event));
    return [clamp(x, 0, width - 0.001), clamp(y, 0, height - 0.001)];
  };
  let drag = null;

  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    drag = { from: share(event), first: pointAt(event), far: false, marks: event.shiftKey };
    scene.bench.canvas.focus({ preventScroll: true });
    event.preventDefault();
  });
  canvas.addEventListener("pointermove", (event) => {
    if (drag) {
      const [across, down] = share(event);
      drag.far ||= Math.hypot(across - drag.from[0], down - drag.from[1]) > 0.01;
      if (drag.marks) scene.state.drawn = rectangle(drag.first, pointAt(event));
      else if (drag.far) scene.look((camera) => camera.moveBy(drag.from[0] - across, drag.from[1] - down));
      drag.from = drag.far ? [across, down] : drag.from;
    }
    scene.set({ at: pointAt(event) });
  });
  canvas.addEventListener("pointerup", (event) => {
    if (drag?.marks && drag.far) scene.mark(scene.state.drawn);
    else if (drag && !drag.far && film !== null && event.shiftKey) scene.set({ other: film });
    else if (drag && !drag.far && film !== null) scene.choose(film);
    drag = null;
    scene.set({ drawn: null });
  });
  canvas.addEventListener("pointercancel", () => (drag = null));
  canvas.addEventListener("pointerleave", () => scene.set({ at: null }));
  canvas.addEventListener("dblclick", () => scene.showInset(-1));
  canvas.addEventListener(
    "wheel",
    (event) => {
      // Who scrolls past a scene goes on scrolling; who works in it zooms.
      if (!event.ctrlKey && !scene.section.contains(document.activeElement)) return;
      event.preventDefault();
      scene.look((camera) => camera.zoomBy(2 ** (-event.deltaY / 240), share(event)));
    },
    { passive: false },
  );
};

/** The pixels between two points. */
const rectangle = ([x0, y0], [x1, y1]) => {
  const [x, y] = [Math.floor(Math.min(x0, x1)), Math.floor(Math.min(y0, y1))];
  return { x, y, width: Math.floor(Math.max(x0, x1)) + 1 - x, height: Math.floor(Math.max(y0, y1)) + 1 - y };
};
