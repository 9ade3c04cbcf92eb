// Starts what the page has.

watchTheme();
watchFigures();
document.querySelectorAll(".scene:has(.frames)").forEach(flip);

const scenes = [...document.querySelectorAll(".scene:has(.settings)")].map((section) => new Scene(section));
watchKeys(scenes);

// Scenes draw when they come near.
const near = new IntersectionObserver(
  (entries) => {
    for (const { target, isIntersecting } of entries) {
      const scene = scenes.find(({ section }) => section === target);
      if (isIntersecting) scene.wake();
      else if (scene.awake) scene.sleep();
    }
  },
  { rootMargin: "100% 0px" },
);
scenes.forEach(({ section }) => near.observe(section));
new ResizeObserver(() => scenes.filter(({ awake }) => awake).forEach((scene) => scene.redraw())).observe(document.body);

// A print shows all of them: the films of what is still are at hand soon after the page is; what moves is printed as
// pictures of its first frame, and its films are decoded only when it comes near.
window.addEventListener("beforeprint", () => scenes.forEach((scene) => scene.draw()));
const loadAll = async () => {
  for (const scene of scenes.filter(({ player }) => !player)) await scene.load();
  document.documentElement.dataset.films = "loaded";
};
loadAll();
