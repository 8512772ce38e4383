
"use strict";
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];

  // Heatmaps: pointing, tapping or the arrow keys choose a cell, whose numbers are read out.
  for (const section of all(".heatmaps")) {
    const readout = section.querySelector(".readout");
    const choose = (cell) => {
      for (const other of all(".cell.chosen", section)) other.classList.remove("chosen");
      cell.classList.add("chosen");
      readout.textContent = cell.dataset.say;
    };
    for (const map of all("svg.map", section)) {
      const cells = all(".cell", map);
      const columns = Number(map.dataset.columns);
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
        if (next) choose(next);
      });
    }
    const show = (estimator) => {
      for (const map of all("[data-estimator]", section)) map.hidden = map.dataset.estimator !== estimator;
    };
    for (const radio of all(".choice input", section)) {
      radio.addEventListener("change", () => show(radio.value));
      if (radio.checked) show(radio.value);
    }
  }

  // Drops: a button takes its video to shortly before the takeoff.
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
