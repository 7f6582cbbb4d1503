// Shows the inside, by rays through a texture of the materials' fractions, or of an attribute's values.
import { useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import { axes, eyeDistance } from "./camera";
import { Handles } from "./handles/handles";
import { moveByKeys, moveByPointer, placeCamera } from "./navigation";
import { Refused } from "./session/connection";
import { about } from "./session/evaluation";
import { Design, state, useStore } from "./store";
import { ViewBar, attributeOptions } from "./surface";
import { TransferCurve, curveOf, tableSize, transferTable } from "./transfer";

const most = 8; // materials

const vertexShader = `#version 300 es
in vec2 place;
out vec2 at;
void main() { at = place; gl_Position = vec4(place, 0.0, 1.0); }`;

// Marches from front to back. A material's opacity is that of one millimetre-like unit: a twentieth of the box.
const fragmentShader = `#version 300 es
precision highp float;
precision highp sampler3D;
in vec2 at;
out vec4 colour;
uniform sampler3D fractions0, fractions1;
uniform vec3 origin, size, target, right, down, forward;
uniform float height, aspect, unit;
uniform float distance_to_eye; // distance from the target; 0: rays are parallel
uniform vec3 box_lo, box_hi; // only the inside is shown
uniform vec3 wedge, wedge_at; // the part on all these sides is removed; 1 and -1 are sides, 0 any
uniform bool has_wedge;
uniform int steps;
uniform vec4 materials[${most}]; // colours, and opacities in w
uniform bool by_value; // fractions0 has the value times the share inside, and the share inside
uniform sampler2D transfer;     // colours, and opacities in w, from the least value to the greatest

float[${most}] fractions(vec3 p) {
  vec4 a = texture(fractions0, p), b = texture(fractions1, p);
  return float[${most}](a.r, a.g, a.b, a.a, b.r, b.g, b.b, b.a);
}
vec4 shade_of_value(vec3 p) {
  vec2 v = texture(fractions0, p).rg;
  if (v.g < 0.004) return vec4(0.0);
  vec4 shade = texture(transfer, vec2((clamp(v.r / v.g, 0.0, 1.0) * ${tableSize - 1}.0 + 0.5) / ${tableSize}.0, 0.5));
  return vec4(shade.rgb, 1.0) * shade.a * v.g;
}
// Returns the opacity in w, and colours times it.
vec4 shade_at(vec3 p) {
  if (by_value) return shade_of_value(p);
  float f[${most}] = fractions(p);
  vec4 shade = vec4(0.0);
  for (int m = 0; m < ${most}; ++m) shade += f[m] * materials[m].w * vec4(materials[m].rgb, 1.0);
  return shade;
}
float density(vec3 p) { return shade_at(p).w; }

bool is_cut(vec3 p) {
  if (any(lessThan(p, box_lo)) || any(greaterThan(p, box_hi))) return true;
  if (!has_wedge) return false;
  return all(greaterThan(wedge * (p - wedge_at) + vec3(equal(wedge, vec3(0.0))), vec3(0.0)));
}

void main() {
  vec3 from = target + right * at.x * 0.5 * height * aspect - down * at.y * 0.5 * height;
  vec3 eye = target - forward * distance_to_eye;
  vec3 along = distance_to_eye > 0.0 ? normalize(from - eye) : forward;
  vec3 inverse = 1.0 / (along + vec3(equal(along, vec3(0.0))) * 1e-6);
  vec3 a = (origin - from) * inverse, b = (origin + size - from) * inverse;
  vec3 near = min(a, b), far = max(a, b);
  float begin = max(near.x, max(near.y, near.z)), end = min(far.x, min(far.y, far.z));
  if (distance_to_eye > 0.0) begin = max(begin, -length(from - eye));
  colour = vec4(0.0);
  if (begin >= end) return;
  float step = length(size) / float(steps);
  vec3 cell = 2.0 / vec3(textureSize(fractions0, 0));
  for (float t = begin + 0.5 * step; t < end; t += step) {
    vec3 place = from + along * t;
    if (is_cut(place)) continue;
    vec3 p = (place - origin) / size;
    vec4 shade = shade_at(p);
    float sum = shade.w;
    vec3 mixed = shade.rgb;
    if (sum < 0.003) continue;
    float alpha = 1.0 - pow(1.0 - min(sum, 0.9999), step / unit);
    vec3 slope = vec3(density(p + vec3(cell.x, 0, 0)) - density(p - vec3(cell.x, 0, 0)),
                      density(p + vec3(0, cell.y, 0)) - density(p - vec3(0, cell.y, 0)),
                      density(p + vec3(0, 0, cell.z)) - density(p - vec3(0, 0, cell.z)));
    float steep = length(slope);
    float light = steep > 0.05 ? mix(1.0, 0.5 + 0.5 * max(0.0, dot(slope / steep, normalize(forward + 0.4 * right + 0.6 * down))), min(1.0, steep * 2.0)) : 1.0;
    colour += (1.0 - colour.a) * vec4(mixed / sum * light, 1.0) * alpha;
    if (colour.a > 0.98) break;
  }
}`;

interface Grid {
  design: string;
  count: number[];
  origin_mm: number[];
  pitch_mm: number;
  materials?: { name: string; colour: number[] }[];
  left_out?: number;
  by: string; // the attribute whose values it has; empty: it has fractions of materials
  range?: [number, number];
}

// True for attributes of one number, which can be shown; others are colours, for example.
const isNumber = (design: Design | undefined, name: string) => design?.attributes.some((a) => a.name === name && a.type === "number") ?? false;

const coloursOf = (palette: string) => (state.hello?.palettes.find((p) => p.name === palette) ?? state.hello?.palettes[0])?.colours ?? [[0, 0, 0], [255, 255, 255]];

function cutUniforms() {
  const { cut } = state;
  const wedge = [0, 0, 0],
    wedgeAt = [0, 0, 0];
  for (const side of cut?.sides ?? []) {
    wedge[side.axis] = side.side === ">" ? 1 : -1;
    wedgeAt[side.axis] = side.mm;
  }
  const [lo, hi] = cut?.box ?? [[-1e9, -1e9, -1e9], [1e9, 1e9, 1e9]];
  return { lo, hi, wedge, wedgeAt };
}

class VolumePainter {
  private gl: WebGL2RenderingContext;
  private program: WebGLProgram;
  private textures: WebGLTexture[];
  grid?: Grid;
  isOld = true; // another grid is on its way

  // Throws if the browser has no WebGL 2.
  constructor(private canvas: HTMLCanvasElement) {
    const gl = canvas.getContext("webgl2", { premultipliedAlpha: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("this browser has no WebGL 2, which the volume view needs");
    this.gl = gl;
    this.program = gl.createProgram()!;
    for (const [type, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]] as const) {
      const shader = gl.createShader(type)!;
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS)) throw new Error(`the volume's shader: ${gl.getProgramInfoLog(this.program)}`);
    gl.useProgram(this.program);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 3, -1, -1, 3]), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(gl.getAttribLocation(this.program, "place"));
    gl.vertexAttribPointer(gl.getAttribLocation(this.program, "place"), 2, gl.FLOAT, false, 0, 0);
    this.textures = [gl.createTexture()!, gl.createTexture()!];
    this.textures.forEach((texture, n) => {
      gl.activeTexture(gl.TEXTURE0 + n);
      gl.bindTexture(gl.TEXTURE_3D, texture);
      for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR], [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_R, gl.CLAMP_TO_EDGE]] as const)
        gl.texParameteri(gl.TEXTURE_3D, name, value);
      gl.uniform1i(this.at(`fractions${n}`), n);
    });
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.LINEAR);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    gl.uniform1i(this.at("transfer"), 2);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  }

  private at(name: string) {
    return this.gl.getUniformLocation(this.program, name);
  }

  // Tells that the grid is no longer the one that is wanted. It is shown until the next one arrives.
  wait() {
    this.isOld = true;
    this.canvas.dataset.state = "drawing";
  }

  take(grid: Grid, bytes: Uint8Array) {
    const { gl } = this;
    const [nx, ny, nz] = grid.count,
      size = nx * ny * nz * (grid.by ? 2 : 4);
    this.textures.forEach((_, n) => {
      gl.activeTexture(gl.TEXTURE0 + n);
      const part = bytes.subarray(n * size, (n + 1) * size);
      if (part.length === size && grid.by) gl.texImage3D(gl.TEXTURE_3D, 0, gl.RG8, nx, ny, nz, 0, gl.RG, gl.UNSIGNED_BYTE, part);
      else if (part.length === size) gl.texImage3D(gl.TEXTURE_3D, 0, gl.RGBA8, nx, ny, nz, 0, gl.RGBA, gl.UNSIGNED_BYTE, part);
      else gl.texImage3D(gl.TEXTURE_3D, 0, gl.RGBA8, 1, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    });
    this.grid = grid;
    this.isOld = false;
  }

  // Removes the grid of another file.
  clear() {
    if (state.design) return;
    this.grid = undefined;
    this.gl.clearColor(0, 0, 0, 0);
    this.gl.clear(this.gl.COLOR_BUFFER_BIT);
    delete this.canvas.dataset.state;
    delete this.canvas.dataset.design;
  }

  paint() {
    const { gl, canvas, grid } = this;
    const camera = state.camera;
    if (!grid || !camera || canvas.clientWidth === 0) return;
    canvas.width = canvas.clientWidth;
    canvas.height = canvas.clientHeight;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    const { right, down, forward } = axes(camera);
    const size = grid.count.map((n) => n * grid.pitch_mm);
    const { lo, hi, wedge, wedgeAt } = cutUniforms();
    for (const [name, value] of Object.entries({ box_lo: lo, box_hi: hi, wedge, wedge_at: wedgeAt, origin: grid.origin_mm, size, target: camera.target, right, down, forward })) gl.uniform3fv(this.at(name), value);
    gl.uniform1i(this.at("has_wedge"), wedge.some((side) => side !== 0) ? 1 : 0);
    gl.uniform1f(this.at("distance_to_eye"), eyeDistance(camera));
    gl.uniform1f(this.at("height"), camera.height);
    gl.uniform1f(this.at("aspect"), canvas.width / canvas.height);
    gl.uniform1f(this.at("unit"), Math.hypot(...size) / 30);
    gl.uniform1i(this.at("steps"), 2 * Math.max(...grid.count));
    gl.uniform1i(this.at("by_value"), grid.by ? 1 : 0);
    gl.activeTexture(gl.TEXTURE2);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, tableSize, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, transferTable(coloursOf(state.palette), curveOf(grid.by)));
    const values = new Float32Array(4 * most);
    grid.materials?.forEach((m, n) => values.set([...m.colour.slice(0, 3).map((c) => c / 255), state.opacity[m.name] ?? (m.colour[3] ?? 255) / 255], 4 * n));
    gl.uniform4fv(this.at("materials"), values);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    canvas.dataset.state = this.isOld ? "drawing" : "ready";
    canvas.dataset.design = grid.design;
    canvas.dataset.by = grid.by;
  }
}

export function VolumeView() {
  const { design, camera, cut, perspective, opacity, by: chosen, palette, curves, file } = useStore();
  const by = isNumber(design, chosen) ? chosen : "";
  const [range, setRange] = useState<[number, number]>();
  const canvas = useRef<HTMLCanvasElement>(null);
  const painter = useRef<VolumePainter>();
  const [side, setSide] = useState(64);
  const [problem, setProblem] = useState("");
  const [, setSize] = useState("");
  const pointer = useMemo(() => moveByPointer(canvas), []);
  useLayoutEffect(() => {
    try {
      painter.current = new VolumePainter(canvas.current!);
    } catch (error) {
      setProblem((error as Error).message);
      return;
    }
    const size = new ResizeObserver(() => {
      painter.current!.paint();
      setSize(`${canvas.current!.clientWidth} ${canvas.current!.clientHeight}`); // the handles move
    });
    size.observe(canvas.current!);
    return () => size.disconnect();
  }, []);
  useLayoutEffect(() => painter.current?.clear(), [file, design === undefined]);
  useLayoutEffect(() => placeCamera(canvas.current!), [design]);
  useLayoutEffect(() => {
    if (!design || !painter.current) return;
    painter.current.wait();
    about("volume", { side, ...(by ? { by } : {}) }, "volume")
      .then((reply) => {
        if (state.file !== file) return; // another file was opened meanwhile
        painter.current!.take({ ...(reply as any), design: design.design, by }, reply.bytes!);
        painter.current!.paint();
        setRange(reply.range);
        setProblem(reply.left_out > 0 ? `${reply.left_out} materials are left out: the view shows ${most}.` : "");
      })
      .catch((error: Refused) => error.isCancelled || setProblem(error.message));
  }, [design, side, by]);
  useLayoutEffect(() => painter.current?.paint(), [camera, cut, perspective, opacity, palette, curves]);
  return (
    <section class="view volume" aria-label="Volume">
      <ViewBar others={attributeOptions(design?.attributes.filter((a) => isNumber(design, a.name)))}>
        <label>
          Detail
          <select value={side} onChange={(e) => setSide(+e.currentTarget.value)}>
            {[32, 64, 96, 128, 192].map((n) => <option value={n}>{n}³</option>)}
          </select>
        </label>
      </ViewBar>
      <div class="stage">
        <canvas ref={canvas} tabIndex={0} role="img" {...pointer} onKeyDown={moveByKeys}
                aria-label="The inside of the design; opacities are in the panel of materials. Arrows turn it, with Shift they move it." />
        <Handles canvas={canvas} />
        <p class="viewproblem" role="status">{problem}</p>
        {by && range && <TransferCurve attribute={by} range={range} colours={coloursOf(palette)} />}
      </div>
    </section>
  );
}
