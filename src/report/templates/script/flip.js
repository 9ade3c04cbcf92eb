// Flips pictures in place: click one, then arrow or number keys or buttons; Escape shows all again.

const flip = (scene) => {
  const figures = [...scene.querySelectorAll(".frames figure")];
  const keys = document.createElement("div");
  keys.className = "keys";
  let shown = -1;
  const show = (index) => {
    shown = index;
    const on = index >= 0 && index < figures.length;
    scene.classList.toggle("flip", on);
    figures.forEach((figure, i) => figure.classList.toggle("on", i === index));
    [...keys.children].forEach((key, i) => key.setAttribute("aria-pressed", String(on ? i === index + 1 : i === 0)));
  };
  const add = (text, index) => {
    const key = document.createElement("button");
    key.type = "button";
    key.textContent = text;
    key.addEventListener("click", () => show(index));
    keys.append(key);
  };
  add("all", -1);
  figures.forEach((figure, i) => {
    add(`${i + 1} ${figure.dataset.label}`, i);
    figure.addEventListener("click", () => show(scene.classList.contains("flip") ? (i + 1) % figures.length : i));
  });
  scene.querySelector(".frames").before(keys);
  scene.tabIndex = 0;
  scene.addEventListener("mouseenter", () => scene.focus({ preventScroll: true }));
  scene.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Escape" || event.key === "0") show(-1);
    else if (shown >= 0 && (event.key === "ArrowRight" || event.key === "ArrowLeft")) {
      const step = event.key === "ArrowRight" ? 1 : -1;
      show((shown + step + figures.length) % figures.length);
      event.preventDefault();
    } else if (/^[1-9]$/.test(event.key)) show(Number(event.key) - 1);
  });
  show(-1);
};
