// Shows layers at the printer's resolution: pixels are those of the job's files.
import { useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import { length } from "./camera";
import { CutControls, removedAt } from "./cuts";
import { followFingers } from "./fingers";
import { OptionControl } from "./joboptions";
import { probe } from "./session/measures";
import { reveal } from "./session/script";
import { Slider } from "./slider";
import { NodeCall, Plan, set, state, useStore } from "./store";
import { Legend, ScaleBar } from "./surface";
import { Tile, Tiles, tileSize } from "./tiles";

interface Look {
  x: number; // mm, in the middle
  y: number;
  scale: number; // mm for each pixel of the page
}

export const layerAt = (plan: Plan, z: number) =>
  Math.max(0, Math.min(plan.count[2] - 1, Math.floor((z - plan.origin_mm[2]) / plan.pitch_mm[2])));

const coarsest = 12;
function levelFor(plan: Plan, scale: number): number {
  const pixel = Math.min(plan.pitch_mm[0], plan.pitch_mm[1]);
  return Math.max(0, Math.min(coarsest, Math.floor(Math.log2(scale / Math.min(devicePixelRatio, 2) / pixel))));
}

// How much longer along x and y the voxels of a first picture are: 2^3 times, so that it takes a 64th of the time.
const coarser = 3;

function fit(plan: Plan, canvas: HTMLCanvasElement): Look {
  const size = [0, 1].map((n) => plan.count[n] * plan.pitch_mm[n]);
  return {
    x: plan.origin_mm[0] + size[0] / 2,
    y: plan.origin_mm[1] + size[1] / 2,
    scale: 1.1 * Math.max(size[0] / canvas.clientWidth, size[1] / canvas.clientHeight),
  };
}

class Painter {
  tiles = new Tiles(() => this.paint());
  look?: Look;
  private before?: { plan: Plan; tiles: Tile[] }; // the last complete layer
  private shown: { of: string; levels: number[] } = { of: "", levels: [] };
  constructor(private canvas: HTMLCanvasElement) {}

  paint() {
    const { canvas, look } = this;
    if (!look || !state.plan || canvas.clientWidth === 0) return;
    const ratio = Math.min(devicePixelRatio, 2);
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    const level = levelFor(state.plan, look.scale);
    const layer = layerAt(state.plan, state.z);
    canvas.dataset.state = "drawing";
    const { plan, tiles } = this.tilesOf(level, layer);
    const isComplete = plan !== undefined && tiles.every((tile) => tile.picture || tile.problem);
    const first = isComplete || (plan && tiles.length === 1) ? { tiles: [] } : this.tilesOf(Math.min(coarsest, level + coarser), layer);
    this.tiles.want([...first.tiles, ...tiles]);
    if (!isComplete && this.before) this.draw(this.before.plan, this.before.tiles);
    if (first.plan) this.draw(first.plan, first.tiles);
    if (plan) this.draw(plan, tiles);
    this.cutOpen(layer);
    this.note(layer, [...first.tiles, ...tiles]);
    if (!isComplete) return;
    this.before = { plan: plan!, tiles };
    const problem = tiles.find((tile) => tile.problem)?.problem;
    if (problem && state.planProblem !== problem) set({ planProblem: problem });
    Object.assign(canvas.dataset, { state: "ready", layer, level, design: state.design?.design });
  }

  // Returns the tiles in view of the job with voxels 2^level times as long along x and y.
  private tilesOf(level: number, layer: number): { plan?: Plan; tiles: Tile[] } {
    const plan = this.tiles.plan(level);
    return { plan, tiles: plan ? this.tiles.find(level, layer, this.places(plan)) : [] };
  }

  // Lists in the page which levels of a layer were shown, in their order.
  private note(layer: number, tiles: Tile[]) {
    const of = `${state.design?.design} ${layer}`;
    if (this.shown.of !== of) this.shown = { of, levels: [] };
    for (const { picture, level } of tiles) if (picture && !this.shown.levels.includes(level)) this.shown.levels.push(level);
    this.canvas.dataset.levels = this.shown.levels.join(" ");
  }

  // Forgets the layer of another file.
  clear() {
    if (state.design) return;
    this.before = this.look = undefined;
    this.canvas.getContext("2d")!.clearRect(0, 0, this.canvas.width, this.canvas.height);
    delete this.canvas.dataset.state;
    delete this.canvas.dataset.design;
  }

  // Returns columns and rows of the tiles in view.
  private places(plan: Plan): [number, number][] {
    const { x, y, scale } = this.look!;
    const half = [(this.canvas.clientWidth / 2) * scale, (this.canvas.clientHeight / 2) * scale];
    const range = [x, y].map((middle, n) => {
      const tile = tileSize * plan.pitch_mm[n],
        last = Math.ceil(plan.count[n] / tileSize) - 1;
      const from = Math.max(0, Math.floor((middle - half[n] - plan.origin_mm[n]) / tile));
      return [from, Math.min(last, Math.floor((middle + half[n] - plan.origin_mm[n]) / tile))];
    });
    const places: [number, number][] = [];
    for (let row = range[1][0]; row <= range[1][1]; ++row)
      for (let column = range[0][0]; column <= range[0][1]; ++column) places.push([column, row]);
    return places;
  }

  private draw(plan: Plan, tiles: Tile[]) {
    const { canvas, look } = this;
    const context = canvas.getContext("2d")!;
    const perMm = Math.min(devicePixelRatio, 2) / look!.scale;
    context.imageSmoothingEnabled = false;
    const [px, py] = plan.pitch_mm;
    const left = (i: number) => Math.round(canvas.width / 2 + (plan.origin_mm[0] + i * px - look!.x) * perMm);
    const top = (j: number) => Math.round(canvas.height / 2 - (plan.origin_mm[1] + j * py - look!.y) * perMm);
    for (const { picture, x, y } of tiles) {
      if (!picture) continue;
      // The top row of a tile has its greatest y.
      const x0 = left(x), x1 = left(x + picture.width), y1 = top(y), y0 = top(y + picture.height);
      context.clearRect(x0, y0, x1 - x0, y1 - y0);
      context.drawImage(picture, x0, y0, x1 - x0, y1 - y0);
    }
  }

  // Clears what the cut removes of the layer, with edges between pixels.
  private cutOpen(layer: number) {
    const { canvas, look } = this;
    const { plan, cut } = state;
    const context = canvas.getContext("2d")!;
    const perMm = Math.min(devicePixelRatio, 2) / look!.scale;
    const column = (x: number) => Math.max(0, Math.min(canvas.width, Math.round(canvas.width / 2 + (x - look!.x) * perMm)));
    const row = (y: number) => Math.max(0, Math.min(canvas.height, Math.round(canvas.height / 2 - (y - look!.y) * perMm)));
    const z = plan!.origin_mm[2] + (layer + 0.5) * plan!.pitch_mm[2];
    for (const [x0, y0, x1, y1] of removedAt(cut, z)) context.clearRect(column(x0), row(y1), column(x1) - column(x0), row(y0) - row(y1));
  }

  // Returns the point in the middle of the layer under a place of the page.
  pointAt(x: number, y: number): number[] {
    const { canvas, look } = this;
    const plan = state.plan!;
    return [
      look!.x + (x - canvas.clientWidth / 2) * look!.scale,
      look!.y - (y - canvas.clientHeight / 2) * look!.scale,
      plan.origin_mm[2] + (layerAt(plan, state.z) + 0.5) * plan.pitch_mm[2],
    ];
  }
}

const percent = (share: number) => `${+(100 * share).toPrecision(3)} %`;

const mostCalls = 4;

// Links to the calls of the script that made the solid at the point, the innermost first.
function Calls({ nodes }: { nodes: NodeCall[] }) {
  const calls = nodes.filter((node) => node.from !== undefined).reverse().slice(0, mostCalls);
  if (calls.length === 0) return null;
  return (
    <>
      <dt>made by</dt>
      <dd class="calls">
        {calls.map((node) => (
          <button onClick={() => reveal(node.from!, node.to!)} title="Show it in the script">
            {node.type} <span class="quiet">line {node.line}</span>
          </button>
        ))}
      </dd>
    </>
  );
}

function ProbeCard() {
  const { probe, probeBefore } = useStore();
  if (!probe) return null;
  const rows: [string, string][] = [["at", probe.at.map((v) => +v.toFixed(4)).join(", ") + " mm"]];
  if (probe.voxel.material) rows.push(["voxel", `${probe.voxel.material} (${probe.voxel.index!.join(", ")})`]);
  for (const [name, share] of Object.entries(probe.composition)) rows.push([name, percent(share)]);
  if (probe.distance_mm !== null) rows.push(["distance", length(Math.abs(probe.distance_mm)) + (probe.inside ? " inside" : " outside")]);
  for (const [name, value] of Object.entries(probe.attributes)) rows.push([name, String(+value.toPrecision(6))]);
  if (probeBefore) rows.push(["from the last", length(Math.hypot(...probe.at.map((v, n) => v - probeBefore[n])))]);
  if (probe.parts.length > 0) rows.push(["in", probe.parts.join(", ")]);
  return (
    <dl class="probe" aria-label="Point" aria-live="polite" data-voxel={probe.voxel.index?.join(",")} data-material={probe.voxel.material}>
      {rows.map(([name, value]) => (
        <>
          <dt>{name}</dt>
          <dd>{value}</dd>
        </>
      ))}
      <Calls nodes={probe.nodes} />
    </dl>
  );
}

// A finger or the mouse moves the layer, two fingers also zoom it. A click that moves nothing probes.
function pointerMoves(painter: () => Painter, zoom: (by: number, at: { x: number; y: number }) => void) {
  let moved = 4;
  const move = (dx: number, dy: number) => {
    const { look } = painter();
    if (!look) return;
    painter().look = { ...look, x: look.x - dx * look.scale, y: look.y + dy * look.scale };
    painter().paint();
  };
  const fingers = followFingers({
    begin: () => (moved = 0),
    one: (dx, dy) => {
      moved += Math.abs(dx) + Math.abs(dy);
      if (moved >= 4) move(dx, dy);
    },
    two: (dx, dy, by, at) => {
      moved = 4;
      move(dx, dy);
      zoom(by, at);
    },
  });
  return {
    ...fingers,
    onPointerUp(event: PointerEvent) {
      if (moved < 4 && state.plan && painter().look) probe(painter().pointAt(event.offsetX, event.offsetY));
      moved = 4;
      fingers.onPointerUp(event);
    },
  };
}

export function SliceView() {
  const { plan, planProblem, z, design, isOld, file } = useStore();
  const canvas = useRef<HTMLCanvasElement>(null);
  const painter = useRef<Painter>();
  const [, redraw] = useState({});
  const zoomNow = useRef<(by: number, at?: { x: number; y: number }) => void>(() => undefined);
  const pointer = useMemo(() => pointerMoves(() => painter.current!, (by, at) => zoomNow.current(by, at)), []);
  useLayoutEffect(() => {
    painter.current = new Painter(canvas.current!);
    const size = new ResizeObserver(() => painter.current!.paint());
    size.observe(canvas.current!);
    return () => size.disconnect();
  }, []);
  useLayoutEffect(() => painter.current?.clear(), [file, design === undefined]);
  useLayoutEffect(() => {
    const p = painter.current!;
    if (plan && !p.look && canvas.current!.clientWidth > 0) {
      p.look = fit(plan, canvas.current!);
      redraw({});
    }
    p.paint();
  });
  const zoom = (by: number, at?: { x: number; y: number }) => {
    const p = painter.current!;
    if (!p.look) return;
    const scale = p.look.scale / by;
    const shift = at ? p.look.scale - scale : 0;
    const dx = at ? at.x - canvas.current!.clientWidth / 2 : 0, dy = at ? at.y - canvas.current!.clientHeight / 2 : 0;
    p.look = { x: p.look.x + dx * shift, y: p.look.y - dy * shift, scale };
    p.paint();
    redraw({});
  };
  zoomNow.current = zoom;
  const refit = () => {
    if (plan) painter.current!.look = fit(plan, canvas.current!);
    redraw({});
  };
  const layer = plan ? layerAt(plan, z) : 0;
  const setLayer = (n: number) => {
    if (plan) set({ z: plan.origin_mm[2] + (Math.max(0, Math.min(plan.count[2] - 1, n)) + 0.5) * plan.pitch_mm[2] });
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const look = painter.current?.look;
    if (!look) return;
    const step = 40 * look.scale;
    const moves: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const move = moves[event.key];
    if (move) painter.current!.look = { ...look, x: look.x + move[0] * step, y: look.y + move[1] * step };
    else if (event.key === "+" || event.key === "=") zoom(1.5);
    else if (event.key === "-") zoom(1 / 1.5);
    else if (event.key === "PageUp") setLayer(layer + 1);
    else if (event.key === "PageDown") setLayer(layer - 1);
    else if (event.key === "Home") refit();
    else if (event.key === "Enter") probe(painter.current!.pointAt(canvas.current!.clientWidth / 2, canvas.current!.clientHeight / 2));
    else return;
    event.preventDefault();
    painter.current!.paint();
  };
  const level = plan && painter.current?.look ? levelFor(plan, painter.current.look.scale) : 0;
  return (
    <section class="view slices" aria-label="Slices">
      <div class="viewbar">
        <OptionControl name="printer" />
        <OptionControl name="dither" />
        <CutControls />
        <span class="grow">
          Layer
          <Slider label="Layer" min={0} max={plan ? plan.count[2] - 1 : 0} step={1} value={layer} isDisabled={!plan}
                  take={(value) => setLayer(Math.round(value))} valueText={`layer ${layer}, z ${z.toFixed(3)} mm`} />
        </span>
        <output class="layer">
          z {isFinite(z) ? z.toFixed(3) : "–"} mm
        </output>
        <span class="controls">
          <button onClick={() => zoom(2)} aria-label="Zoom in">+</button>
          <button onClick={() => zoom(0.5)} aria-label="Zoom out">−</button>
          <button onClick={refit}>fit</button>
        </span>
      </div>
      <div class="stage">
        <canvas ref={canvas} tabIndex={0} role="img" {...pointer} onKeyDown={onKeyDown}
                onWheel={(e) => {
                  e.preventDefault();
                  zoom(Math.exp(-e.deltaY / 400), { x: e.offsetX, y: e.offsetY });
                }}
                aria-label={`Layer ${layer}${design ? "" : ", nothing yet"}. Arrows move it, plus and minus zoom, Page Up and Down change the layer, Enter probes the middle.`} />
        <p class="viewproblem" role="status">{planProblem && !isOld ? planProblem : level > 0 ? `Voxels are ${2 ** level} times as long here; zoom in for those of the job.` : ""}</p>
        <Legend />
        <ProbeCard />
        {painter.current?.look && <ScaleBar pixelMm={painter.current.look.scale} />}
      </div>
    </section>
  );
}
