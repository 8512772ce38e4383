
"use strict";
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];

  // Heatmaps: pointing, tapping or the arrow keys choose a cell, and the readout shows its numbers. The drawing
  // is a picture, so cells are boxes over it, in percent of its size.
  for (const section of all(".heatmaps")) {
    const readout = section.querySelector(".readout");
    for (const map of all(".map", section)) {
      const { columns, panels } = JSON.parse(map.querySelector("script").textContent);
      const cells = panels.flatMap(({ place: [left, top, width, height], cells: texts }) =>
        texts.map((text, i) => {
          const rows = texts.length / columns;
          const cell = document.createElement("span");
          cell.className = "cell";
          cell.dataset.readout = text;
          cell.style.left = `${100 * (left + width * (i % columns) / columns)}%`;
          cell.style.top = `${100 * (top + height * (rows - 1 - Math.floor(i / columns)) / rows)}%`;
          cell.style.width = `${100 * width / columns}%`;
          cell.style.height = `${100 * height / rows}%`;
          return cell;
        }));
      map.append(...cells);
      const choose = (cell) => {
        for (const other of all(".cell.chosen", section)) other.classList.remove("chosen");
        cell.classList.add("chosen");
        readout.textContent = cell.dataset.readout;
      };
      const pointed = (event) => {
        const cell = event.target.closest(".cell");
        if (cell) choose(cell);
      };
      map.addEventListener("pointerover", pointed);
      map.addEventListener("click", pointed);
      map.addEventListener("keydown", (event) => {
        const steps = { ArrowRight: 1, ArrowLeft: -1, ArrowUp: columns, ArrowDown: -columns };
        if (!(event.key in steps)) return;
        event.preventDefault();
        const now = cells.findIndex((cell) => cell.classList.contains("chosen"));
        const next = cells[now < 0 ? 0 : now + steps[event.key]];
        if (!next) return;
        choose(next);
        next.scrollIntoView({ block: "nearest", inline: "nearest" });
      });
    }
  }

  // Accuracy tables: a heading sorts the rows by its column, the best first, then the worst.
  for (const table of all("table.shares")) {
    const body = table.tBodies[0];
    for (const button of all("button.sort", table)) {
      button.addEventListener("click", () => {
        const heading = button.closest("th");
        const order = heading.getAttribute("aria-sort") === "descending" ? "ascending" : "descending";
        const sign = order === "descending" ? -1 : 1;
        const value = (row) => Number(row.cells[heading.cellIndex].dataset.value ?? -1);
        for (const other of all("th[aria-sort]", table)) other.removeAttribute("aria-sort");
        heading.setAttribute("aria-sort", order);
        body.append(...all("tr", body).sort((a, b) => sign * (value(a) - value(b))));
      });
    }
  }

  // Drops: a button plays the video from shortly before the takeoff.
  for (const film of all(".film")) {
    const video = film.querySelector("video");
    const drops = all(".drop", film);
    for (const drop of drops) {
      drop.addEventListener("click", () => {
        video.currentTime = Number(drop.dataset.seek);
        video.play().catch(() => {});
        video.scrollIntoView({ block: "nearest" });
      });
    }
    video.addEventListener("timeupdate", () => {
      for (const drop of drops) {
        const there = video.currentTime >= Number(drop.dataset.seek) && video.currentTime < Number(drop.dataset.end);
        drop.setAttribute("aria-current", String(there));
      }
    });
  }
})();
