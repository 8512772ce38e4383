
// Replays: a view of a run that the reader can turn, joined in time to the estimators' beliefs.
(() => {
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const floats = (text) => new Float32Array(bytes(text).buffer);
  const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
  const darkness = window.matchMedia("(prefers-color-scheme: dark)");
  const IDENTITY = new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
  const IN_CONTACT = [0.13, 0.62, 0.33], IN_THE_AIR = [0.95, 0.5, 0.1];
  // By the wheels in flight: 1 is the left one, 2 the right one.
  const STATES = ["ON THE GROUND", "LEFT WHEEL IN THE AIR", "RIGHT WHEEL IN THE AIR", "IN THE AIR"];

  const unpacked = (data) => {
    for (const scene of data.scenes) for (const mesh of scene.meshes) {
      const v = floats(mesh.vertices);
      mesh.points = Array.from({ length: v.length / 3 }, (_, i) => [v[3 * i], v[3 * i + 1], v[3 * i + 2]]);
    }
    for (const run of data.runs) {
      run.positions = floats(run.positions);
      run.orientations = floats(run.orientations);
      run.truth = bytes(run.truth);
      for (const estimator of run.estimators) estimator.beliefs = bytes(estimator.beliefs);
      run.bodies = data.scenes[run.scene].bodies.length - 1; // without the terrain
      run.frames = run.bodies ? run.positions.length / (3 * run.bodies) : 1;
      run.end = (run.truth.length - 1) / run.belief_rate;
      run.path = pathOf(run);
    }
    return data;
  };
  // The base's path, low-passed forward and backward, so that the camera has no lag.
  const pathOf = (run) => {
    const gain = 1 - Math.exp(-1 / (0.35 * run.pose_rate)), path = [];
    for (let i = 0; i < run.frames; ++i) {
      const at = 3 * (i * run.bodies + run.base - 1);
      path.push([0, 1, 2].map((k) => run.positions[at + k]));
    }
    const blend = (to, from) => { for (let k = 0; k < 3; ++k) to[k] = from[k] + gain * (to[k] - from[k]); };
    for (let i = 1; i < path.length; ++i) blend(path[i], path[i - 1]);
    for (let i = path.length - 2; i >= 0; --i) blend(path[i], path[i + 1]);
    return path;
  };
  const posesAt = (run, time) => {
    const at = clamp(time * run.pose_rate, 0, run.frames - 1);
    const i = Math.min(Math.floor(at), Math.max(0, run.frames - 2)), j = Math.min(i + 1, run.frames - 1), share = at - i;
    const matrices = [IDENTITY];
    for (let body = 0; body < run.bodies; ++body) {
      const a = i * run.bodies + body, b = j * run.bodies + body;
      const p = [0, 1, 2].map((k) => run.positions[3 * a + k] * (1 - share) + run.positions[3 * b + k] * share);
      let same = 0;
      for (let k = 0; k < 4; ++k) same += run.orientations[4 * a + k] * run.orientations[4 * b + k];
      const sign = same < 0 ? -1 : 1;
      const q = [0, 1, 2, 3].map((k) => run.orientations[4 * a + k] * (1 - share) + sign * run.orientations[4 * b + k] * share);
      const length = Math.hypot(...q) || 1, [w, x, y, z] = q.map((v) => v / length);
      matrices.push(new Float32Array([
        1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0,
        2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0,
        2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0, p[0], p[1], p[2], 1]));
    }
    return { matrices, camera: run.path[i].map((v, k) => v * (1 - share) + run.path[j][k] * share) };
  };
  const lightened = (hex) => {
    if (!darkness.matches) return hex;
    const rgb = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
    const light = (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]) / 255;
    const share = clamp(0.62 - light, 0, 0.6);
    return `rgb(${rgb.map((v) => Math.round(v + share * (255 - v))).join(",")})`;
  };
  // A canvas in the size of its place, with its context in CSS pixels.
  const prepared = (canvas) => {
    const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    return { pen, width, height };
  };

  const start = (root) => {
    const find = (selector) => root.querySelector(selector);
    const data = unpacked(JSON.parse(find("script").textContent));
    const [view, overview, curves, slider, state, play] = [".view", ".overview", ".curves", ".time", ".state", ".play"].map(find);
    const scene = openScene(view);
    if (!scene) {
      view.hidden = true;
      state.dataset.flight = "none";
      state.textContent = "This browser has no WebGL 2: the curves are shown without the robot.";
    }
    const initial = () => ({ ...data.camera });
    let run, camera = initial(), time = 0, playing = false, speed = 1, before = 0, waiting = false, loaded = -1;
    const shown = data.runs[0].estimators.map(() => true);

    const refresh = () => { if (!waiting) { waiting = true; requestAnimationFrame(frame); } };
    const go = (to) => { time = clamp(to, 0, run.end); refresh(); };
    const setPlaying = (on) => {
      playing = on;
      before = 0;
      play.textContent = on ? "Pause" : "Play";
      play.setAttribute("aria-pressed", String(on));
      refresh();
    };
    const frame = (now) => {
      waiting = false;
      if (playing) {
        if (before) time += (speed * Math.min(now - before, 100)) / 1000;
        before = now;
        if (time >= run.end) { time = run.end; setPlaying(false); }
      }
      draw();
      if (!performance.getEntriesByName("replay").length) performance.mark("replay"); // its first picture
      if (playing) refresh();
    };

    const stepAt = (t) => clamp(Math.round(t * run.belief_rate), 0, run.truth.length - 1);
    const inContact = (step, wheel) => (run.truth[step] >> wheel) & 1;
    const decision = (estimator, step, wheel) => estimator.beliefs[2 * step + wheel] & 1;
    const belief = (estimator, step, wheel) => (estimator.beliefs[2 * step + wheel] >> 1) / 127;
    const inFlight = () => run.flights.reduce((wheels, [takeoff, landing, wheel]) => (time >= takeoff && time < landing ? wheels | (wheel + 1) : wheels), 0);
    const isWrong = (estimator, step) => [0, 1].some((wheel) => decision(estimator, step, wheel) !== inContact(step, wheel));
    const firstShown = () => run.estimators[shown.indexOf(true)];
    const errorsOf = (estimator) => {
      estimator.errors ??= run.truth.reduce((starts, _, k) => {
        if (isWrong(estimator, k) && (k === 0 || !isWrong(estimator, k - 1))) starts.push(k / run.belief_rate);
        return starts;
      }, []);
      return estimator.errors;
    };

    const palette = () => {
      const style = getComputedStyle(root), of = (name) => style.getPropertyValue(name).trim();
      return { paper: of("--paper"), raised: of("--raised"), ink: of("--ink"), quiet: of("--quiet"), line: of("--line"),
        contact: darkness.matches ? "#274a33" : "#bfe0c4", error: darkness.matches ? "#ff7a66" : "#c3261b" };
    };
    const drawOverview = (colours) => {
      const { pen, width, height } = prepared(overview), x = (t) => (t / (run.end || 1)) * width;
      pen.fillStyle = colours.raised;
      pen.fillRect(0, 0, width, height);
      for (let k = 0; k < run.truth.length;) {
        let end = k + 1;
        while (end < run.truth.length && run.truth[end] === run.truth[k]) ++end;
        pen.fillStyle = colours.contact;
        for (const wheel of [0, 1]) if (inContact(k, wheel)) pen.fillRect(x(k / run.belief_rate), (wheel * height) / 2, x((end - k) / run.belief_rate) + 0.5, height / 2);
        k = end;
      }
      const estimator = firstShown();
      if (estimator) {
        pen.fillStyle = colours.error;
        for (let k = 0; k < run.truth.length; ++k) if (isWrong(estimator, k)) pen.fillRect(x(k / run.belief_rate), height - 6, Math.max(1, x(1 / run.belief_rate)), 6);
      }
      pen.fillStyle = colours.ink;
      pen.fillRect(clamp(x(time) - 1, 0, width - 2), 0, 2, height);
    };
    const LEFT = 34, RIGHT = 8, TOP = 8, BOTTOM = 20, GAP = 8;
    const span = () => (curves.clientWidth < 600 ? 2.4 : 5);
    const drawCurves = (colours) => {
      const { pen, width, height } = prepared(curves), seconds = span(), plot = width - LEFT - RIGHT;
      const rowHeight = (height - TOP - BOTTOM - GAP) / 2, from = time - seconds / 2;
      const x = (t) => LEFT + ((t - from) / seconds) * plot;
      pen.fillStyle = colours.paper;
      pen.fillRect(0, 0, width, height);
      pen.font = "12px system-ui, sans-serif";
      const first = Math.max(0, Math.floor(from * run.belief_rate) - 1), last = Math.min(run.truth.length - 1, Math.ceil((from + seconds) * run.belief_rate) + 1);
      for (const wheel of [0, 1]) {
        const top = TOP + wheel * (rowHeight + GAP), y = (p) => top + 3 + (1 - p) * (rowHeight - 6);
        pen.save();
        pen.beginPath();
        pen.rect(LEFT, top, plot, rowHeight);
        pen.clip();
        pen.fillStyle = colours.raised;
        pen.fillRect(LEFT, top, plot, rowHeight);
        pen.fillStyle = colours.contact;
        for (let k = first; k <= last; ++k) if (inContact(k, wheel)) pen.fillRect(x((k - 0.5) / run.belief_rate), top, plot / seconds / run.belief_rate + 0.6, rowHeight);
        pen.strokeStyle = colours.line;
        pen.lineWidth = 1;
        pen.beginPath();
        pen.moveTo(LEFT, y(0.5));
        pen.lineTo(LEFT + plot, y(0.5));
        pen.stroke();
        pen.lineJoin = "round";
        for (let i = run.estimators.length - 1; i >= 0; --i) {
          if (!shown[i]) continue;
          pen.strokeStyle = lightened(run.estimators[i].colour);
          pen.lineWidth = 1.8;
          pen.beginPath();
          for (let k = first; k <= last; ++k) pen.lineTo(x(k / run.belief_rate), y(belief(run.estimators[i], k, wheel)));
          pen.stroke();
        }
        pen.restore();
        pen.fillStyle = colours.quiet;
        pen.textAlign = "right";
        pen.textBaseline = "middle";
        pen.fillText(wheel ? "right" : "left", LEFT - 4, top + rowHeight / 2);
        pen.fillText("1", LEFT - 4, top + 7);
        pen.fillText("0", LEFT - 4, top + rowHeight - 6);
      }
      pen.textAlign = "center";
      pen.textBaseline = "bottom";
      const tick = seconds > 3 ? 1 : 0.5;
      for (let t = Math.ceil(from / tick) * tick; t < from + seconds; t += tick) {
        if (t < 0 || t > run.end || x(t) < LEFT + 8 || x(t) > width - RIGHT - 12) continue;
        pen.fillStyle = colours.quiet;
        pen.fillText(`${t.toFixed(tick < 1 ? 1 : 0)} s`, x(t), height - 2);
      }
      pen.fillStyle = colours.ink;
      pen.fillRect(x(time) - 0.75, TOP - 4, 1.5, height - TOP - BOTTOM + 8);
    };
    const draw = () => {
      const step = stepAt(time), contact = [inContact(step, 0), inContact(step, 1)];
      if (scene) {
        if (loaded !== run.scene) { scene.load(data.scenes[run.scene]); loaded = run.scene; }
        const poses = posesAt(run, time), tints = [];
        contact.forEach((on, wheel) => { tints[run.wheels[wheel]] = on ? IN_CONTACT : IN_THE_AIR; });
        scene.draw({ ...camera, matrices: poses.matrices, tints, robot: poses.camera,
          target: poses.camera.map((v, k) => v + camera.look_at[k]), dark: darkness.matches });
        state.dataset.flight = inFlight();
        state.textContent = `${time.toFixed(2)} s  ${STATES[inFlight()]}`;
      }
      slider.value = time;
      slider.setAttribute("aria-valuetext", `${time.toFixed(2)} seconds, ${STATES[inFlight()].toLowerCase()}`);
      run.estimators.forEach((estimator, i) => {
        readouts[i].textContent = [0, 1].map((wheel) => belief(estimator, step, wheel).toFixed(2)).join(" ");
      });
      const colours = palette();
      drawOverview(colours);
      drawCurves(colours);
    };

    // Estimators: one box each, which shows or hides its curve.
    const picks = find(".estimators-shown");
    const swatches = [];
    const readouts = data.runs[0].estimators.map((estimator, i) => {
      const [label, box, swatch, output] = ["label", "input", "span", "output"].map((tag) => document.createElement(tag));
      box.type = "checkbox";
      box.checked = true;
      box.addEventListener("change", () => { shown[i] = box.checked; refresh(); });
      swatch.className = "swatch";
      swatches.push(swatch);
      output.setAttribute("aria-live", "off");
      label.append(box, swatch, estimator.name, output);
      picks.append(label);
      return output;
    });
    const colourSwatches = () => swatches.forEach((swatch, i) => { swatch.style.background = lightened(data.runs[0].estimators[i].colour); });
    colourSwatches();
    const choose = (i) => {
      run = data.runs[i];
      slider.max = run.end;
      go(time);
    };
    for (const radio of root.querySelectorAll(".engines input")) radio.addEventListener("change", () => choose(Number(radio.value)));

    play.addEventListener("click", () => { if (!playing && time >= run.end) time = 0; setPlaying(!playing); });
    find(".speed select").addEventListener("change", (event) => { speed = Number(event.target.value); });
    find(".reset").addEventListener("click", () => { camera = initial(); refresh(); });
    slider.addEventListener("input", () => { setPlaying(false); go(Number(slider.value)); });
    for (const button of root.querySelectorAll("[data-jump]")) {
      button.addEventListener("click", () => {
        const times = button.dataset.jump === "flight" ? run.flights.map(([takeoff]) => takeoff) : firstShown() ? errorsOf(firstShown()) : [];
        const forward = Number(button.dataset.step) > 0;
        const to = forward ? times.find((t) => t > time + 0.015) : times.findLast((t) => t < time - 0.015);
        setPlaying(false);
        if (to !== undefined) go(to);
      });
    }

    // The view: one pointer turns it, two move it closer or further away.
    const pointers = new Map();
    const turn = (right, down) => {
      camera.azimuth -= 0.35 * right;
      camera.elevation = clamp(camera.elevation - 0.35 * down, -89, -1);
      refresh();
    };
    const approach = (factor) => { camera.distance = clamp(camera.distance * factor, 0.5, 12); refresh(); };
    const apart = () => { const [a, b] = [...pointers.values()]; return Math.hypot(a.x - b.x, a.y - b.y); };
    view.addEventListener("pointerdown", (event) => {
      view.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    });
    view.addEventListener("pointermove", (event) => {
      const old = pointers.get(event.pointerId);
      if (!old) return;
      const gap = pointers.size > 1 ? apart() : 0;
      pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      if (pointers.size > 1) approach(gap / Math.max(1, apart()));
      else turn(event.clientX - old.x, event.clientY - old.y);
    });
    for (const kind of ["pointerup", "pointercancel"]) view.addEventListener(kind, (event) => pointers.delete(event.pointerId));
    view.addEventListener("wheel", (event) => {
      if (document.activeElement !== view && !event.ctrlKey) return; // the page scrolls
      event.preventDefault();
      approach(Math.exp(clamp(event.deltaY, -200, 200) * 0.0015));
    }, { passive: false });
    view.addEventListener("keydown", (event) => {
      const actions = { ArrowLeft: () => turn(20, 0), ArrowRight: () => turn(-20, 0), ArrowUp: () => turn(0, 14), ArrowDown: () => turn(0, -14),
        "+": () => approach(0.9), "=": () => approach(0.9), "-": () => approach(1 / 0.9), Home: () => find(".reset").click(), " ": () => play.click() };
      if (event.ctrlKey || event.metaKey || event.altKey || !(event.key in actions)) return;
      event.preventDefault();
      actions[event.key]();
    });

    // Time: a drag moves the curves; the overview jumps.
    let grabbed = null;
    curves.addEventListener("pointerdown", (event) => { curves.setPointerCapture(event.pointerId); grabbed = { x: event.clientX, time }; setPlaying(false); });
    curves.addEventListener("pointermove", (event) => { if (grabbed) go(grabbed.time - ((event.clientX - grabbed.x) / (curves.clientWidth - LEFT - RIGHT)) * span()); });
    for (const kind of ["pointerup", "pointercancel"]) curves.addEventListener(kind, () => { grabbed = null; });
    const jump = (event) => { setPlaying(false); go(((event.clientX - overview.getBoundingClientRect().left) / overview.clientWidth) * run.end); };
    overview.addEventListener("pointerdown", (event) => { overview.setPointerCapture(event.pointerId); jump(event); });
    overview.addEventListener("pointermove", (event) => { if (event.buttons & 1) jump(event); });

    new ResizeObserver(refresh).observe(root);
    darkness.addEventListener("change", () => { colourSwatches(); refresh(); });
    choose(0);
    if (run.flights.length) go(Math.max(0, run.flights[0][0] + 0.5 * (run.flights[0][1] - run.flights[0][0])));
  };

  // The page is painted before the replay's preparation begins.
  for (const root of document.querySelectorAll(".replay")) {
    root.hidden = false;
    requestAnimationFrame(() => setTimeout(() => start(root)));
  }
})();
