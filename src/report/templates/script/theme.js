// Light or dark: as the system has it, until the reader chooses.

const watchTheme = () => {
  const root = document.documentElement;
  const names = ["auto", "light", "dark"];
  const memory = (value) => {
    // Some browsers keep nothing for files on disk.
    try {
      if (value) localStorage.setItem("theme", value);
      return localStorage.getItem("theme");
    } catch {
      return value;
    }
  };
  const button = make("button", { type: "button", class: "theme" });
  const show = (name) => {
    root.dataset.theme = name;
    button.textContent = { auto: "◐ as the system", light: "○ light", dark: "● dark" }[name];
    button.setAttribute("aria-label", `colours: ${name}`);
  };
  button.addEventListener("click", () => {
    const next = names[(names.indexOf(root.dataset.theme) + 1) % names.length];
    memory(next);
    show(next);
  });
  const kept = memory();
  show(names.includes(kept) ? kept : "auto");
  document.querySelector("header nav")?.append(button);
};
