// The hull in space: shaded, with curves, combs and maps of curvature. Plain WebGL, parallel projection.
"use strict";
(function () {
  const scene = JSON.parse(document.getElementById("scene").textContent);
  const canvas = document.getElementById("view");
  const gl = canvas.getContext("webgl", { antialias: true, preserveDrawingBuffer: true });
  const done = (word) => { document.documentElement.dataset.viewer = word; };
  if (!gl) {
    document.getElementById("no-view").hidden = false;
    canvas.hidden = true;
    done("none");
    return;
  }
  const KINDS = ["station", "waterline", "buttock", "diagonal"];
  const COLOURS = { station: [0, 0, 0], waterline: [0.04, 0.24, 0.47], buttock: [0.48, 0.18, 0], diagonal: [0, 0.33, 0.24] };
  const INKS = { station: "black", waterline: "blue", buttock: "brown", diagonal: "green" };
  const state = { azimuth: -0.6, elevation: 0.35, zoom: 1, pan: [0, 0] };
  const input = (id) => document.getElementById(id);
  const on = (id) => { const box = input(id); return !!box && box.checked && !box.disabled; };
  const MAPS = ["gaussian", "mean", "zebra"];

  // Maps are painted on the surface, which a body plan has not: what would change nothing cannot be chosen.
  function enable() {
    const plan = on("body");
    for (const id of ["surface", ...MAPS]) {
      const box = input(id);
      box.disabled = plan || (id !== "surface" && !input("surface").checked);
      box.parentNode.classList.toggle("off", box.disabled);
    }
  }

  // Size of everything.
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const hull of scene.hulls) {
    for (let k = 0; k < hull.points.length; k++) {
      const d = k % 3;
      low[d] = Math.min(low[d], hull.points[k]);
      high[d] = Math.max(high[d], hull.points[k]);
    }
  }
  const breadth = Math.max(high[1], 1e-6);
  const centre = [0.5 * (low[0] + high[0]), 0, 0.5 * (low[2] + high[2])];
  const radius = 0.5 * Math.hypot(high[0] - low[0], 2 * breadth, high[2] - low[2]);

  function program(vertex, fragment) {
    const result = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(result, shader);
    }
    gl.linkProgram(result);
    if (!gl.getProgramParameter(result, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(result));
    return result;
  }
  const PLACE = `
    attribute vec3 place;
    uniform mat3 turn; uniform vec3 centre; uniform vec2 scale, pan; uniform float side, depth, lift;
    vec4 placed() {
      vec3 q = turn * (vec3(place.x, side * place.y, place.z) - centre);
      return vec4(q.xy * scale + pan, -q.z * depth - lift, 1.0);
    }`;
  // Borders of stripes are as wide as a pixel, however slowly the reflection turns.
  const fine = gl.getExtension("OES_standard_derivatives") ? "#extension GL_OES_standard_derivatives : enable\n" : "";
  const WIDTH = fine ? "max(fwidth(s), 1e-5)" : "0.06";
  const surfaceProgram = program(PLACE + `
    attribute vec3 normal; attribute vec3 tint; varying vec3 facing, colour;
    void main() { gl_Position = placed(); facing = turn * vec3(normal.x, side * normal.y, normal.z); colour = tint; }`, fine + `
    precision highp float; varying vec3 facing, colour; uniform float zebra;
    void main() {
      vec3 n = normalize(facing); if (n.z < 0.0) n = -n;
      float light = 0.68 + 0.34 * max(dot(n, normalize(vec3(-0.3, 0.6, 0.75))), 0.0);
      vec3 shown = colour * light;
      if (zebra > 0.5) {
        vec3 r = reflect(vec3(0.0, 0.0, -1.0), n);
        // What faces the observer, as an upright side does from abeam, is in the middle of a bright stripe.
        float s = cos(18.0 * atan(r.y, r.z + 1.001));
        float border = ${WIDTH};
        shown = mix(vec3(0.08), vec3(0.97), smoothstep(-border, border, s));
      }
      gl_FragColor = vec4(shown, 1.0);
    }`);
  const lineProgram = program(PLACE + "void main() { gl_Position = placed(); }",
    "precision mediump float; uniform vec3 ink; void main() { gl_FragColor = vec4(ink, 1.0); }");

  function buffer(values, target) {
    const result = gl.createBuffer();
    gl.bindBuffer(target || gl.ARRAY_BUFFER, result);
    gl.bufferData(target || gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    return result;
  }

  // Blue where saddle-shaped or hollow, orange where convex, white where neither; the root shows small curvatures beside large ones.
  function tints(values, full) {
    const result = new Float32Array(3 * values.length);
    values.forEach((value, k) => {
      const part = full > 0 ? 0.9 * Math.sqrt(Math.min(Math.abs(value) / full, 1)) : 0;
      const end = value > 0 ? [0.70, 0.345, 0.02] : [0.13, 0.40, 0.675];
      for (let d = 0; d < 3; d++) result[3 * k + d] = 1 + part * (end[d] - 1);
    });
    return result;
  }

  function surface(hull) {
    const rows = hull.rows, columns = hull.points.length / 3 / rows, p = hull.points;
    const at = (i, j) => 3 * (Math.min(Math.max(i, 0), columns - 1) * rows + Math.min(Math.max(j, 0), rows - 1));
    const normals = new Float32Array(p.length), cells = [];
    for (let i = 0; i < columns; i++) {
      for (let j = 0; j < rows; j++) {
        const [a, b, c, d] = [at(i - 1, j), at(i + 1, j), at(i, j - 1), at(i, j + 1)];
        const u = [0, 1, 2].map((k) => p[b + k] - p[a + k]), v = [0, 1, 2].map((k) => p[d + k] - p[c + k]);
        const n = [v[1] * u[2] - v[2] * u[1], v[2] * u[0] - v[0] * u[2], v[0] * u[1] - v[1] * u[0]];
        const size = Math.hypot(n[0], n[1], n[2]) || 1;
        // Those of the surface itself; where it has no tangent plane, those of the grid.
        const own = hull.normals.slice(at(i, j), at(i, j) + 3), exact = Math.hypot(own[0], own[1], own[2]) > 0.5;
        for (let k = 0; k < 3; k++) normals[at(i, j) + k] = exact ? own[k] : size > 1e-12 ? n[k] / size : (k === 1 ? 1 : 0);
        if (i + 1 < columns && j + 1 < rows) {
          const [s, t] = [i * rows + j, (i + 1) * rows + j];
          cells.push(s, t, s + 1, s + 1, t, t + 1);
        }
      }
    }
    // Bottom, transom and flat bow are what lies between the edges and the centreplane.
    const closing = [];
    const strip = (points) => {
      for (let k = 0; k + 1 < points.length; k++) {
        const [a, b] = [points[k], points[k + 1]];
        const [c, d] = [[a[0], 0, a[2]], [b[0], 0, b[2]]];
        closing.push(...a, ...b, ...c, ...c, ...b, ...d);
      }
    };
    const point = (i, j) => p.slice(at(i, j), at(i, j) + 3);
    strip(Array.from({ length: columns }, (_, i) => point(i, 0)));
    strip(Array.from({ length: rows }, (_, j) => point(0, j)));
    strip(Array.from({ length: rows }, (_, j) => point(columns - 1, j)));
    const facing = [];
    for (let k = 0; k < closing.length; k += 9) {
      const q = closing.slice(k, k + 9), u = [0, 1, 2].map((d) => q[3 + d] - q[d]), v = [0, 1, 2].map((d) => q[6 + d] - q[d]);
      const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      const size = Math.hypot(n[0], n[1], n[2]);
      for (let c = 0; c < 3; c++) facing.push(...(size > 1e-12 ? n.map((w) => w / size) : [0, 0, 1]));
    }
    return {
      closing: {
        place: buffer(new Float32Array(closing)), normal: buffer(new Float32Array(facing)),
        tint: buffer(new Float32Array(closing.length).fill(0.78)), count: closing.length / 3,
      },
      place: buffer(new Float32Array(p)), normal: buffer(normals), count: cells.length,
      cells: buffer(new Uint16Array(cells), gl.ELEMENT_ARRAY_BUFFER),
      plain: buffer(new Float32Array(p.length).fill(0.86)),
      gaussian: buffer(tints(hull.gaussian, scene.full[0])), mean: buffer(tints(hull.mean, scene.full[1])),
    };
  }

  const middle = scene.midship;
  function segments(lists, keep) {
    const out = [];
    for (const list of lists) {
      if (keep && !keep(list)) continue;
      for (let k = 3; k + 2 < list.length; k += 3) {
        for (let d = -3; d < 3; d++) out.push(list[k + d]);
      }
    }
    return { buffer: buffer(new Float32Array(out)), count: out.length / 3, curves: lists.length };
  }
  const hulls = scene.hulls.map((hull) => {
    const lines = {};
    for (const kind of KINDS) lines[kind] = segments(hull.curves[kind] || []);
    lines.aft = segments(hull.curves.station || [], (list) => list[0] <= middle);
    lines.fore = segments(hull.curves.station || [], (list) => list[0] >= middle);
    return { lines, surface: surface(hull), combs: hull.combs };
  });

  // The usual tooth of a kind is a quarter of the half-breadth long, of stations half of that, before and after alike; the
  // slider multiplies, up to the longest. A body plan leaves room for the longest tooth of a station.
  const usual = {}, LENGTH = { station: 0.12 * breadth }, LONGEST = { station: 0.3 * breadth };
  let reaching = 0;
  for (const kind of KINDS) {
    const sizes = [];
    for (const hull of scene.hulls) {
      for (const comb of hull.combs[kind] || []) {
        for (let k = 0; k < comb.teeth.length; k += 3) sizes.push(Math.hypot(comb.teeth[k], comb.teeth[k + 1], comb.teeth[k + 2]));
      }
    }
    sizes.sort((a, b) => a - b);
    usual[kind] = sizes[Math.floor(0.8 * sizes.length)] || 1;
  }
  let combs = null;
  function combLines() {
    const words = [];
    const scales = {};
    for (const kind of KINDS) {
      scales[kind] = (LENGTH[kind] || 0.25 * breadth) / usual[kind] * Math.pow(10, Number(input("comb-scale").value));
      words.push(kind + "s " + (1 / scales[kind]).toPrecision(2));
    }
    const lines = (list, scale, longest) => {
      const out = [];
      for (const comb of list) {
        let last = null;
        for (let k = 0; k < comb.feet.length; k += 3) {
          const foot = comb.feet.slice(k, k + 3);
          let tooth = comb.teeth.slice(k, k + 3).map((t) => t * scale);
          const size = Math.hypot(tooth[0], tooth[1], tooth[2]);
          if (size > longest) tooth = tooth.map((t) => t * longest / size);
          const tip = foot.map((f, d) => f + tooth[d]);
          out.push(...foot, ...tip);
          if (last) out.push(...last, ...tip);
          last = tip;
        }
      }
      return { buffer: buffer(new Float32Array(out)), count: out.length / 3 };
    };
    reaching = 0;
    combs = hulls.map((hull) => {
      const result = {};
      for (const kind of KINDS) result[kind] = lines(hull.combs[kind] || [], scales[kind], LONGEST[kind] || 0.6 * breadth);
      const stations = hull.combs.station || [];
      result.aft = lines(stations.filter((comb) => comb.feet[0] <= middle), scales.station, LONGEST.station);
      result.fore = lines(stations.filter((comb) => comb.feet[0] >= middle), scales.station, LONGEST.station);
      for (const comb of stations) {
        for (let k = 0; k < comb.teeth.length; k += 3) {
          const size = scales.station * Math.hypot(comb.teeth[k], comb.teeth[k + 1], comb.teeth[k + 2]);
          reaching = Math.max(reaching, Math.min(size, LONGEST.station));
        }
      }
      return result;
    });
    input("comb-words").textContent = "1 m of comb in 1/m: " + words.join(", ");
  }

  function turn() {
    const [a, e] = [state.azimuth, state.elevation];
    const out = [Math.cos(e) * Math.sin(a), -Math.cos(e) * Math.cos(a), Math.sin(e)];
    const right = [Math.cos(a), Math.sin(a), 0];
    const up = [out[1] * right[2] - out[2] * right[1], out[2] * right[0] - out[0] * right[2], out[0] * right[1] - out[1] * right[0]];
    return [right[0], up[0], out[0], right[1], up[1], out[1], right[2], up[2], out[2]];
  }

  function attribute(which, name, source) {
    const at = gl.getAttribLocation(which, name);
    if (at < 0) return;
    gl.bindBuffer(gl.ARRAY_BUFFER, source);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, 3, gl.FLOAT, false, 0, 0);
  }

  let scale = [1, 1];
  function use(which, side, lift, nudge) {
    gl.useProgram(which);
    const where = (name) => gl.getUniformLocation(which, name);
    gl.uniformMatrix3fv(where("turn"), false, turn());
    gl.uniform3fv(where("centre"), centre);
    gl.uniform2fv(where("scale"), scale);
    gl.uniform2f(where("pan"), state.pan[0] + nudge[0], state.pan[1] + nudge[1]);
    gl.uniform1f(where("side"), side);
    gl.uniform1f(where("depth"), 0.5 / radius);
    gl.uniform1f(where("lift"), lift);
  }

  function drawLines(lines, ink, side, wide) {
    if (!lines.count) return;
    const step = [1 / canvas.width, 1 / canvas.height];
    const nudges = wide ? [[-step[0], 0], [step[0], 0], [0, step[1]], [0, -step[1]]] : [[0, 0]];
    for (const nudge of nudges) {
      use(lineProgram, side, 0.002, nudge);
      gl.uniform3fv(gl.getUniformLocation(lineProgram, "ink"), ink);
      attribute(lineProgram, "place", lines.buffer);
      gl.drawArrays(gl.LINES, 0, lines.count);
    }
  }

  function draw() {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    gl.viewport(0, 0, width, height);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    // The box of the hull, turned, fills the view.
    const more = on("body") && on("combs") && on("station") ? reaching : 0;
    const t = turn(), half = [0.5 * (high[0] - low[0]), breadth + more, 0.5 * (high[2] - low[2]) + more];
    const reach = [0, 1].map((d) => Math.abs(t[d]) * half[0] + Math.abs(t[3 + d]) * half[1] + Math.abs(t[6 + d]) * half[2]);
    const shape = width / Math.max(height, 1);
    const fit = 0.92 * state.zoom / Math.max(reach[0], reach[1] * shape, 1e-9);
    scale = [fit, fit * shape];
    const which = on("before") ? 1 : 0;
    const hull = hulls[Math.min(which, hulls.length - 1)];
    const sides = on("full") ? [1, -1] : [1];
    const plan = on("body");
    const tint = on("gaussian") ? hull.surface.gaussian : on("mean") ? hull.surface.mean : hull.surface.plain;
    if (on("surface") && !plan) {
      gl.enable(gl.POLYGON_OFFSET_FILL);
      gl.polygonOffset(1, 1);
      for (const side of sides) {
        use(surfaceProgram, side, 0, [0, 0]);
        gl.uniform1f(gl.getUniformLocation(surfaceProgram, "zebra"), on("zebra") ? 1 : 0);
        attribute(surfaceProgram, "place", hull.surface.place);
        attribute(surfaceProgram, "normal", hull.surface.normal);
        attribute(surfaceProgram, "tint", tint);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, hull.surface.cells);
        gl.drawElements(gl.TRIANGLES, hull.surface.count, gl.UNSIGNED_SHORT, 0);
        const closing = hull.surface.closing;
        attribute(surfaceProgram, "place", closing.place);
        attribute(surfaceProgram, "normal", closing.normal);
        attribute(surfaceProgram, "tint", closing.tint);
        gl.drawArrays(gl.TRIANGLES, 0, closing.count);
      }
      gl.disable(gl.POLYGON_OFFSET_FILL);
    }
    for (const kind of KINDS) {
      if (!on(kind)) continue;
      if (plan && kind === "station") {
        // Aft on the left, forward on the right.
        drawLines(hull.lines.aft, COLOURS.station, -1, true);
        drawLines(hull.lines.fore, COLOURS.station, 1, true);
        continue;
      }
      for (const side of sides) drawLines(hull.lines[kind], COLOURS[kind], side, hull.lines[kind].curves < 16);
    }
    if (on("combs") && combs) {
      const set = combs[Math.min(which, combs.length - 1)];
      const ink = which ? [0.55, 0.55, 0.55] : [0.75, 0.37, 0];
      if (plan && on("station")) {
        drawLines(set.aft, ink, -1, false);
        drawLines(set.fore, ink, 1, false);
      }
      for (const kind of KINDS) {
        if (!plan && on(kind)) drawLines(set[kind], ink, 1, false);
      }
    }
    // What is parallel to the screen has one scale.
    const pixels = 0.5 * fit * canvas.clientWidth, power = Math.pow(10, Math.floor(Math.log10(160 / pixels)));
    const bar = [5, 2, 1].map((m) => m * power).find((metres) => metres * pixels <= 160) || power;
    input("scale-bar").style.width = bar * pixels + "px";
    input("scale-words").textContent = Number(bar.toPrecision(1)) + " m, parallel to the screen";
    const words = KINDS.filter(on).map((kind) => INKS[kind] + ": " + kind + "s");
    if (on("combs")) words.push((which ? "grey" : "orange") + ": combs, " + (which ? "before" : "after"));
    const [name, full, unit] = on("gaussian") ? ["Gaussian", scene.full[0], "1/m²"] : ["mean", scene.full[1], "1/m"];
    if (on("gaussian") || on("mean")) {
      words.push(name + " curvature: blue " + -full + " " + unit + ", white 0, orange +" + full + " " + unit + " (colours go with the root)");
    }
    if (on("zebra")) words.push("stripes: reflections of lamps, the observer before the screen");
    input("legend").textContent = words.join(" · ");
    state.frames = (state.frames || 0) + 1;
  }

  let waiting = false;
  function redraw() {
    if (waiting) return;
    waiting = true;
    setTimeout(() => { waiting = false; draw(); done("drawn"); }, 16);
  }

  const VIEWS = { space: [-0.6, 0.35], ahead: [Math.PI / 2, 0], profile: [0, 0], plan: [0, Math.PI / 2] };
  function look(name) {
    [state.azimuth, state.elevation] = VIEWS[name];
    [state.zoom, state.pan] = [1, [0, 0]];
    redraw();
  }
  for (const button of document.querySelectorAll("[data-view]")) {
    button.addEventListener("click", () => look(button.dataset.view));
  }
  for (const box of document.querySelectorAll("#controls input")) {
    box.addEventListener("input", () => {
      if (box.id === "comb-scale") combLines();
      enable();
      if (box.id === "gaussian" && box.checked && input("mean")) input("mean").checked = false;
      if (box.id === "mean" && box.checked) input("gaussian").checked = false;
      if (box.id === "body" && box.checked) look("ahead");
      redraw();
    });
  }
  let held = null;
  canvas.addEventListener("pointerdown", (event) => {
    held = [event.clientX, event.clientY, event.shiftKey || event.button > 0];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    const [dx, dy] = [event.clientX - held[0], event.clientY - held[1]];
    [held[0], held[1]] = [event.clientX, event.clientY];
    if (held[2]) {
      state.pan[0] += 2 * dx / canvas.clientWidth;
      state.pan[1] -= 2 * dy / canvas.clientHeight;
    } else {
      state.azimuth -= 0.008 * dx;
      state.elevation = Math.min(Math.max(state.elevation + 0.008 * dy, -Math.PI / 2), Math.PI / 2);
    }
    redraw();
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { held = null; });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    state.zoom = Math.min(Math.max(state.zoom * Math.exp(-0.0015 * event.deltaY), 0.2), 60);
    redraw();
  }, { passive: false });
  window.addEventListener("resize", redraw);
  enable();
  combLines();
  draw();
  done("drawn");
})();
