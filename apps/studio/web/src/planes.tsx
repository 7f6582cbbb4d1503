// Shows a scan in three planes through one of its voxels, in grey from a least to a greatest number, which window and
// level set.
import { useEffect, useRef, useState } from "preact/hooks";
import { Refused, Reply, connection } from "./session/connection";
import { Slider } from "./slider";
import { state, useStore } from "./store";

interface Scan {
  file: string;
  count: number[];
  steps_mm: number[];
  has_place: boolean;
  space: string;
  type: string;
  channels: number;
  least: number;
  greatest: number;
  shown: [number, number];
}

interface Plane {
  width: number;
  height: number;
  step: number; // voxels from one number to the next
  numbers: Float32Array;
}

interface Voxel {
  index: number[];
  value: number;
  at_mm?: number[];
}

// The axes to the right and upwards in the plane across each axis.
const planeAxes = [
  [1, 2],
  [0, 2],
  [0, 1],
];
const names = ["i", "j", "k"];

const short = (value: number) => String(+value.toPrecision(7));

function pictureOf(plane: Plane, low: number, high: number): ImageData {
  const picture = new ImageData(plane.width, plane.height);
  const pixels = new Uint32Array(picture.data.buffer);
  const scale = 255 / (high - low || 1);
  for (let row = 0; row < plane.height; ++row)
    for (let column = 0; column < plane.width; ++column) {
      const grey = Math.max(0, Math.min(255, (plane.numbers[row * plane.width + column] - low) * scale)) | 0;
      pixels[(plane.height - 1 - row) * plane.width + column] = 0xff000000 | (grey << 16) | (grey << 8) | grey;
    }
  return picture;
}

// Returns the plane's place in its canvas, in pixels of the page: as large as fits, in the proportions of its sides in
// mm.
function frameOf(scan: Scan, axis: number, width: number, height: number) {
  const [right, up] = planeAxes[axis];
  const sides = [right, up].map((n) => scan.count[n] * scan.steps_mm[n]);
  const scale = Math.min(width / sides[0], height / sides[1]);
  const size = sides.map((side) => side * scale);
  return { x: (width - size[0]) / 2, y: (height - size[1]) / 2, width: size[0], height: size[1] };
}

function PlaneView({ scan, axis, at, low, high, move, hover }: { scan: Scan; axis: number; at: number[]; low: number; high: number; move: (at: number[]) => void; hover: (at?: number[]) => void }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [plane, setPlane] = useState<Plane & { of: string; index: number }>();
  const [problem, setProblem] = useState("");
  const [size, setSize] = useState("");
  const [right, up] = planeAxes[axis];
  useEffect(() => {
    const observer = new ResizeObserver(() => setSize(`${canvas.current!.clientWidth} ${canvas.current!.clientHeight}`));
    observer.observe(canvas.current!);
    return () => observer.disconnect();
  }, []);
  useEffect(() => {
    connection
      .ask("plane", { file: scan.file, axis, index: at[axis] }, `plane ${axis}`)
      .answer.then((reply: Reply) => {
        setPlane({ ...(reply as any), of: scan.file, index: at[axis], numbers: new Float32Array(reply.bytes!.slice().buffer) });
        setProblem("");
      })
      .catch((error: Refused) => error.isCancelled || setProblem(error.message));
  }, [scan, at[axis]]);
  useEffect(() => {
    const element = canvas.current!;
    if (!plane || plane.of !== scan.file || element.clientWidth === 0) return;
    const ratio = Math.min(devicePixelRatio, 2);
    element.width = Math.round(element.clientWidth * ratio);
    element.height = Math.round(element.clientHeight * ratio);
    const context = element.getContext("2d")!;
    const picture = new OffscreenCanvas(plane.width, plane.height);
    picture.getContext("2d")!.putImageData(pictureOf(plane, low, high), 0, 0);
    const frame = frameOf(scan, axis, element.width, element.height);
    context.imageSmoothingEnabled = false;
    context.drawImage(picture, frame.x, frame.y, frame.width, frame.height);
    const x = frame.x + ((at[right] + 0.5) / scan.count[right]) * frame.width;
    const y = frame.y + (1 - (at[up] + 0.5) / scan.count[up]) * frame.height;
    context.strokeStyle = "#ffb000";
    context.lineWidth = ratio;
    context.beginPath();
    for (const [x0, y0, x1, y1] of [[frame.x, y, x - 6, y], [x + 6, y, frame.x + frame.width, y], [x, frame.y, x, y - 6], [x, y + 6, x, frame.y + frame.height]]) {
      context.moveTo(x0, y0);
      context.lineTo(x1, y1);
    }
    context.stroke();
    Object.assign(element.dataset, { state: "ready", index: plane.index });
  }, [plane, low, high, size, at.join()]);

  const voxelUnder = (event: MouseEvent): number[] | undefined => {
    const element = canvas.current!;
    const frame = frameOf(scan, axis, element.clientWidth, element.clientHeight);
    const shares = [(event.offsetX - frame.x) / frame.width, 1 - (event.offsetY - frame.y) / frame.height];
    if (shares.some((share) => share < 0 || share >= 1)) return undefined;
    const found = [...at];
    found[right] = Math.floor(shares[0] * scan.count[right]);
    found[up] = Math.floor(shares[1] * scan.count[up]);
    return found;
  };
  const moveTo = (event: PointerEvent) => {
    const found = voxelUnder(event);
    if (found) move(found);
  };
  const step = (along: number, by: number) => move(at.map((n, k) => (k === along ? Math.max(0, Math.min(scan.count[k] - 1, n + by)) : n)));
  const onKeyDown = (event: KeyboardEvent) => {
    const by = event.shiftKey ? 10 : 1;
    const steps: Record<string, [number, number]> = { ArrowLeft: [right, -by], ArrowRight: [right, by], ArrowUp: [up, by], ArrowDown: [up, -by], PageUp: [axis, by], PageDown: [axis, -by] };
    if (!steps[event.key]) return;
    step(...steps[event.key]);
    event.preventDefault();
  };
  return (
    <div class="plane">
      <canvas ref={canvas} tabIndex={0} role="img" onKeyDown={onKeyDown}
              aria-label={`Plane ${names[axis]} = ${at[axis]} of the scan. Arrows move the crosshair, Page Up and Down change the plane, with Shift ten at a time.`}
              onPointerDown={(e) => { canvas.current!.setPointerCapture(e.pointerId); moveTo(e); }}
              onPointerMove={(e) => { hover(voxelUnder(e)); if (e.buttons === 1) moveTo(e); }}
              onPointerLeave={() => hover(undefined)}
              onWheel={(e) => { e.preventDefault(); step(axis, e.deltaY < 0 ? 1 : -1); }} />
      <label class="planeindex">
        {names[axis]}
        <input type="range" aria-label={`Plane across ${names[axis]}`} min={0} max={scan.count[axis] - 1} value={at[axis]} onInput={(e) => move(at.map((n, k) => (k === axis ? +e.currentTarget.value : n)))} />
        <output>{at[axis]}</output>
      </label>
      {problem && <p class="viewproblem error" role="status">{problem}</p>}
    </div>
  );
}

// Returns the number at a voxel. Only one request is under way; the last wanted voxel waits for it.
function useVoxel(file: string, at?: number[]): Voxel | undefined {
  const [voxel, setVoxel] = useState<Voxel>();
  const isAtWork = useRef(false);
  const wanted = useRef<number[]>();
  const ask = async () => {
    if (isAtWork.current) return;
    isAtWork.current = true;
    while (wanted.current) {
      const index = wanted.current;
      wanted.current = undefined;
      const reply = await connection.ask("voxel", { file, at: index }).answer.catch(() => undefined);
      setVoxel(reply && { index, value: reply.value, at_mm: reply.at_mm });
    }
    isAtWork.current = false;
  };
  const key = at?.join();
  useEffect(() => {
    wanted.current = at;
    if (at) ask();
    else setVoxel(undefined);
  }, [file, key]);
  return voxel;
}

function VoxelRow({ name, voxel }: { name: string; voxel?: Voxel }) {
  if (!voxel) return null;
  return (
    <>
      <dt>{name}</dt>
      <dd data-value={voxel.value}>
        <strong>{short(voxel.value)}</strong> at {voxel.index.join(", ")}
        {voxel.at_mm && ` · ${voxel.at_mm.map((v) => +v.toFixed(3)).join(", ")} mm`}
      </dd>
    </>
  );
}

function Planes({ scan }: { scan: Scan }) {
  const [at, move] = useState(scan.count.map((n) => n >> 1));
  const [[low, high], setShown] = useState(scan.shown);
  const [over, hover] = useState<number[]>();
  const here = useVoxel(scan.file, at), under = useVoxel(scan.file, over);
  const width = scan.greatest - scan.least || 1;
  const level = (low + high) / 2, window = high - low;
  const show = (middle: number, span: number) => setShown([middle - span / 2, middle + span / 2]);
  return (
    <>
      <div class="viewbar">
        <span class="grow">
          Level
          <Slider id="scan-level" label="Level" min={scan.least} max={scan.greatest} step={width / 500} value={level} take={(value) => show(value, window)} />
        </span>
        <span class="grow">
          Window
          <Slider id="scan-window" label="Window" min={width / 500} max={width} step={width / 500} value={window} take={(value) => show(level, value)} />
        </span>
        <button onClick={() => setShown(scan.shown)}>Most values</button>
        <button onClick={() => setShown([scan.least, scan.greatest])}>All values</button>
      </div>
      <div class="stage planes">
        {[2, 1, 0].map((axis) => <PlaneView scan={scan} axis={axis} at={at} low={low} high={high} move={move} hover={hover} />)}
        <dl class="scaninfo" aria-label="Scan">
          <VoxelRow name="crosshair" voxel={here} />
          <VoxelRow name="pointer" voxel={under} />
          <dt>values</dt>
          <dd>{short(scan.least)} to {short(scan.greatest)}, {scan.type}</dd>
          <dt>voxels</dt>
          <dd>{scan.count.join(" × ")}</dd>
          <dt>of</dt>
          <dd>{scan.has_place ? `${scan.steps_mm.map(short).join(" × ")} mm, ${scan.space}` : "no length that the file says"}</dd>
        </dl>
      </div>
    </>
  );
}

// The scans that can be shown: the open file, or those that the design reads.
export const scansToSee = () => (state.kind === "scan" ? [state.file] : (state.design?.scans ?? []));

export function PlanesView() {
  useStore();
  const files = scansToSee();
  const [chosen, choose] = useState("");
  const file = files.includes(chosen) ? chosen : (files[0] ?? "");
  const [scan, setScan] = useState<Scan>();
  const [problem, setProblem] = useState("");
  useEffect(() => {
    setScan(undefined);
    setProblem("");
    if (!file) return;
    connection
      .ask("scan", { file }, "scan")
      .answer.then((reply) => setScan({ ...(reply as any), file }))
      .catch((error: Refused) => error.isCancelled || setProblem(error.message));
  }, [file]);
  return (
    <section class="view scan" aria-label="Planes">
      {files.length > 1 && (
        <div class="viewbar">
          <label>
            Scan
            <select value={file} onChange={(e) => choose(e.currentTarget.value)}>
              {files.map((name) => <option value={name}>{name}</option>)}
            </select>
          </label>
        </div>
      )}
      {problem && <p class="error" role="alert">{problem}</p>}
      {!scan && !problem && <p role="status">{file ? "reading the scan…" : "The design reads no scan."}</p>}
      {scan && scan.file === file && <Planes key={file} scan={scan} />}
    </section>
  );
}
