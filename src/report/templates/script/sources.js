// Where a figure comes from: a click on it shows the rows of metrics.csv that it follows from.

const metricsRows = async () => {
  const bytes = await inflate(document.getElementById("metrics").textContent);
  return new TextDecoder().decode(bytes).split("\n");
};

/** The cells of a line of CSV. */
const cellsOf = (line) => [...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)].map(([, cell]) => cell.replace(/^"|"$/g, "").replaceAll('""', '"'));

const watchFigures = () => {
  if (!document.getElementById("metrics")) return;
  let rows = null;
  const box = make("dialog", { class: "sources", "aria-label": "rows of metrics.csv" });
  const show = async (text, lines) => {
    rows ??= await metricsRows();
    // What was measured comes before where.
    const from = cellsOf(rows[0]).indexOf("method");
    const cellsAt = (line) => ((cells) => [...cells.slice(from), ...cells.slice(0, from)])(cellsOf(rows[line - 1]).slice(0, -1));
    const row = (tag, first, cells) => make("tr", {}, make("th", { scope: tag, text: first }), ...cells.map((cell) => make(tag === "col" ? "th" : "td", { text: cell })));
    const table = make("table", {}, make("thead", {}, row("col", "line", cellsAt(1))), make("tbody", {}, ...lines.map((line) => row("row", line, cellsAt(line)))));
    const count = lines.length === 1 ? "this row" : `these ${lines.length} rows`;
    box.replaceChildren(
      make("p", {}, make("strong", { text }), ` follows from ${count} of metrics.csv:`),
      make("div", { class: "scroll" }, table),
      make("form", { method: "dialog" }, make("button", { text: "close" })),
    );
    if (!box.isConnected) document.body.append(box);
    box.showModal();
  };
  const cells = document.querySelectorAll("[data-lines]");
  for (const cell of cells) {
    cell.title = `metrics.csv, line${cell.dataset.lines.includes(" ") ? "s" : ""} ${cell.dataset.lines}`;
  }
  document.addEventListener("click", (event) => {
    const cell = event.target.closest?.("[data-lines]");
    if (cell) show(cell.firstChild.textContent, cell.dataset.lines.split(" ").map(Number));
  });
};
