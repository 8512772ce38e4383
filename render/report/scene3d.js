
"use strict";
// Draws bodies of boxes, spheres, cylinders and meshes with WebGL 2, one sun and its shadows.
const openScene = (canvas) => {
  // The buffer is kept, so that the page can be printed.
  const gl = canvas.getContext("webgl2", { antialias: true, alpha: false, preserveDrawingBuffer: true });
  if (!gl) return null;

  const SHADOW_SIZE = 2048, SHADOW_REACH = 1.5; // texels; m around the robot
  const SUN = [0.36, 0.3, 0.88];
  const FIELD = (45 * Math.PI) / 180;

  const vertexShader = `#version 300 es
    layout(location = 0) in vec3 position;
    layout(location = 1) in vec3 normal;
    layout(location = 2) in vec3 colour;
    uniform mat4 body, camera, sun;
    out vec3 at, facing, paint, inSun;
    void main() {
      vec4 world = body * vec4(position, 1.0);
      at = world.xyz;
      facing = mat3(body) * normal;
      paint = colour;
      inSun = (sun * world).xyz * 0.5 + 0.5;
      gl_Position = camera * world;
    }`;
  const fragmentShader = `#version 300 es
    precision highp float;
    precision highp sampler2DShadow;
    in vec3 at, facing, paint, inSun;
    uniform vec3 eye, towardsSun, haze, tint;
    uniform float tinted, isTerrain, brightness;
    uniform sampler2DShadow shadows;
    out vec4 pixel;
    float lines(vec2 p, float spacing) {
      vec2 q = p / spacing;
      vec2 d = abs(fract(q - 0.5) - 0.5) / fwidth(q);
      return 1.0 - min(min(d.x, d.y), 1.0);
    }
    void main() {
      vec3 n = normalize(facing), towardsEye = normalize(eye - at);
      if (dot(n, towardsEye) < 0.0) n = -n;
      float sunny = max(dot(n, towardsSun), 0.0), lit = 1.0;
      if (all(greaterThan(inSun, vec3(0.0))) && all(lessThan(inSun, vec3(1.0)))) {
        float slope = clamp(sqrt(1.0 - sunny * sunny) / max(sunny, 0.15), 0.0, 5.0);
        lit = 0.0;
        for (int i = 0; i < 4; ++i) {
          vec2 shift = vec2(float(i & 1) - 0.5, float(i >> 1) - 0.5) / ${SHADOW_SIZE.toFixed(1)};
          lit += 0.25 * texture(shadows, vec3(inSun.xy + 1.4 * shift, inSun.z - 0.0004 * (1.0 + slope)));
        }
      }
      vec3 base = mix(paint, tint, tinted);
      if (isTerrain > 0.5 && min(base.r, min(base.g, base.b)) > 0.9) base = vec3(0.70, 0.76, 0.83); // a white floor would be sky
      if (isTerrain > 0.5 && n.z > 0.7) {
        float distance = length(eye - at);
        float grid = max(0.10 * lines(at.xy, 0.25), 0.22 * lines(at.xy, 1.0));
        base *= 1.0 - grid * clamp(1.6 - 0.16 * distance, 0.0, 1.0);
      }
      float shine = pow(max(dot(n, normalize(towardsSun + towardsEye)), 0.0), 40.0) * (1.0 - isTerrain);
      vec3 colour = base * (0.50 + 0.12 * n.z + 0.55 * sunny * lit) + 0.16 * shine * lit;
      float far = clamp((length(eye.xy - at.xy) - 4.0) / 9.0, 0.0, 1.0);
      pixel = vec4(mix(colour * brightness, haze, far * far * (3.0 - 2.0 * far)), 1.0);
    }`;
  const depthShader = `#version 300 es
    precision highp float;
    void main() {}`;

  const program = (vertex, fragment) => {
    const made = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
    const places = {};
    return { made, at: (name) => (places[name] ??= gl.getUniformLocation(made, name)) };
  };
  const shading = program(vertexShader, fragmentShader);
  const casting = program(vertexShader, depthShader);

  const map = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, map);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, SHADOW_SIZE, SHADOW_SIZE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
  const shadowBuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, shadowBuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, map, 0);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);

  // Vectors and matrices (column by column).
  const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const unit = (a) => { const l = Math.hypot(...a) || 1; return [a[0] / l, a[1] / l, a[2] / l]; };
  const product = (a, b) => {
    const c = new Float32Array(16);
    for (let i = 0; i < 16; ++i) for (let k = 0; k < 4; ++k) c[i] += a[(i & 3) + 4 * k] * b[k + (i & 12)];
    return c;
  };
  const lookAt = (eye, target) => {
    const back = unit(minus(eye, target)), right = unit(cross([0, 0, 1], back)), up = cross(back, right);
    return [right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
      -dot(right, eye), -dot(up, eye), -dot(back, eye), 1];
  };
  const rotated = ([w, x, y, z], v) => {
    const t = cross([x, y, z], v).map((c) => 2 * c), u = cross([x, y, z], t);
    return [v[0] + w * t[0] + u[0], v[1] + w * t[1] + u[1], v[2] + w * t[2] + u[2]];
  };

  // Unit solids as corners of triangles: [position, normal] each.
  const box = () => {
    const corners = [];
    for (let axis = 0; axis < 3; ++axis) for (const side of [-1, 1]) {
      const corner = (u, v) => { const p = [0, 0, 0]; p[axis] = side / 2; p[(axis + 1) % 3] = u / 2; p[(axis + 2) % 3] = v / 2; return p; };
      const normal = [0, 0, 0];
      normal[axis] = side;
      for (const [u, v] of [[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]]) corners.push([corner(u, v), normal]);
    }
    return corners;
  };
  const ring = (n) => Array.from({ length: n + 1 }, (_, i) => [Math.cos((2 * Math.PI * i) / n), Math.sin((2 * Math.PI * i) / n)]);
  const cylinder = () => {
    const corners = [], around = ring(40);
    for (let i = 0; i + 1 < around.length; ++i) {
      const [a, b] = [around[i], around[i + 1]];
      const at = ([x, y], z) => [[x / 2, y / 2, z / 2], [x, y, 0]];
      corners.push(at(a, -1), at(b, -1), at(b, 1), at(a, -1), at(b, 1), at(a, 1));
      for (const z of [-1, 1]) for (const [x, y] of [a, b, [0, 0]]) corners.push([[x / 2, y / 2, z / 2], [0, 0, z]]);
    }
    return corners;
  };
  const sphere = () => {
    const corners = [], around = ring(24), rows = 12;
    const at = ([x, y], i) => { const e = Math.PI * (i / rows - 0.5), c = Math.cos(e); const n = [c * x, c * y, Math.sin(e)]; return [n.map((v) => v / 2), n]; };
    for (let i = 0; i < rows; ++i) for (let k = 0; k + 1 < around.length; ++k) {
      const [a, b] = [around[k], around[k + 1]];
      corners.push(at(a, i), at(b, i), at(b, i + 1), at(a, i), at(b, i + 1), at(a, i + 1));
    }
    return corners;
  };
  // Normals of a mesh are smooth across edges below 40 degrees.
  const ofMesh = (mesh) => {
    const { points, triangles } = mesh, faces = [], around = points.map(() => []);
    for (let i = 0; i + 2 < triangles.length; i += 3) {
      const [a, b, c] = [points[triangles[i]], points[triangles[i + 1]], points[triangles[i + 2]]];
      const normal = cross(minus(b, a), minus(c, a));
      for (let k = 0; k < 3; ++k) around[triangles[i + k]].push(faces.length);
      faces.push({ normal, flat: unit(normal) });
    }
    const corners = [];
    triangles.forEach((vertex, i) => {
      const { flat } = faces[Math.floor(i / 3)], sum = [0, 0, 0];
      for (const face of around[vertex]) {
        if (dot(flat, faces[face].flat) > 0.766) for (let k = 0; k < 3; ++k) sum[k] += faces[face].normal[k];
      }
      corners.push([points[vertex], unit(sum)]);
    });
    return corners;
  };
  const solids = [box(), sphere(), cylinder()];

  let parts = []; // of each body: its triangles
  const load = (scene) => {
    for (const part of parts) { gl.deleteVertexArray(part.array); gl.deleteBuffer(part.buffer); }
    parts = scene.bodies.map((shapes) => {
      const numbers = [];
      for (const [shape, x, y, z, qw, qx, qy, qz, sx, sy, sz, r, g, b, mesh] of shapes) {
        const size = [sx, sy, sz], q = [qw, qx, qy, qz];
        for (const [p, n] of shape === 3 ? ofMesh(scene.meshes[mesh]) : solids[shape]) {
          const at = rotated(q, p.map((v, i) => v * size[i]));
          const normal = rotated(q, unit(n.map((v, i) => v / size[i])));
          numbers.push(at[0] + x, at[1] + y, at[2] + z, ...normal, r / 255, g / 255, b / 255);
        }
      }
      const array = gl.createVertexArray(), buffer = gl.createBuffer();
      gl.bindVertexArray(array);
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.STATIC_DRAW);
      for (let i = 0; i < 3; ++i) {
        gl.enableVertexAttribArray(i);
        gl.vertexAttribPointer(i, 3, gl.FLOAT, false, 36, 12 * i);
      }
      return { array, buffer, count: numbers.length / 9 };
    });
  };

  // `matrices`: the pose of each body. `tints`: by body, a colour or nothing.
  const draw = ({ matrices, tints, robot, target, azimuth, elevation, distance, dark }) => {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio)), height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
    const a = (azimuth * Math.PI) / 180, e = (elevation * Math.PI) / 180;
    const eye = [target[0] - distance * Math.cos(e) * Math.cos(a), target[1] - distance * Math.cos(e) * Math.sin(a), target[2] - distance * Math.sin(e)];
    const near = 0.05, far = 60, f = 1 / Math.tan(FIELD / 2);
    const lens = [(f * height) / width, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0];
    const camera = product(lens, lookAt(eye, target));
    const towardsSun = unit(SUN);
    const s = SHADOW_REACH;
    const sun = product([1 / s, 0, 0, 0, 0, 1 / s, 0, 0, 0, 0, -1 / 5, 0, 0, 0, -1, 1],
      lookAt(robot.map((v, i) => v + 5 * towardsSun[i]), robot));
    const bodies = (used, shade) => parts.forEach((part, i) => {
      if (part.count === 0) return;
      gl.uniformMatrix4fv(used.at("body"), false, matrices[i]);
      if (shade) {
        gl.uniform1f(used.at("isTerrain"), i === 0 ? 1 : 0);
        gl.uniform1f(used.at("tinted"), tints[i] ? 0.7 : 0);
        gl.uniform3fv(used.at("tint"), tints[i] ?? [0, 0, 0]);
      }
      gl.bindVertexArray(part.array);
      gl.drawArrays(gl.TRIANGLES, 0, part.count);
    });
    gl.enable(gl.DEPTH_TEST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, shadowBuffer);
    gl.viewport(0, 0, SHADOW_SIZE, SHADOW_SIZE);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.useProgram(casting.made);
    gl.uniformMatrix4fv(casting.at("camera"), false, sun);
    bodies(casting, false);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    const haze = dark ? [0.12, 0.14, 0.165] : [0.91, 0.93, 0.95];
    gl.clearColor(...haze, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.useProgram(shading.made);
    gl.uniformMatrix4fv(shading.at("camera"), false, camera);
    gl.uniformMatrix4fv(shading.at("sun"), false, sun);
    gl.uniform3fv(shading.at("eye"), eye);
    gl.uniform3fv(shading.at("towardsSun"), towardsSun);
    gl.uniform3fv(shading.at("haze"), haze);
    gl.uniform1f(shading.at("brightness"), dark ? 0.66 : 1);
    gl.bindTexture(gl.TEXTURE_2D, map);
    bodies(shading, true);
  };
  return { load, draw };
};
