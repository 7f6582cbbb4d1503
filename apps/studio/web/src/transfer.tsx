// The transfer function of an attribute in the volume view: a palette's colours, and a curve of opacities.
import { useRef } from "preact/hooks";
import { CurvePoint, set, state, useStore } from "./store";

const usual: CurvePoint[] = [
  { at: 0, opacity: 0.1 },
  { at: 1, opacity: 0.8 },
];

export const curveOf = (attribute: string) => state.curves[attribute] ?? usual;

// Interpolates linearly between the points, which are in order.
export function opacityAt(curve: CurvePoint[], at: number): number {
  const next = curve.findIndex((point) => point.at >= at);
  if (next === 0) return curve[0].opacity;
  if (next < 0) return curve.at(-1)!.opacity;
  const a = curve[next - 1], b = curve[next];
  return a.opacity + ((b.opacity - a.opacity) * (at - a.at)) / (b.at - a.at);
}

const toLight = (byte: number) => (byte <= 10.31475 ? byte / 3294.6 : ((byte / 255 + 0.055) / 1.055) ** 2.4); // IEC 61966-2-1
const toByte = (light: number) => 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055);

export const tableSize = 256;

// Returns a table of colours, mixed in linear light as in the server's pictures, and opacities, each a byte.
export function transferTable(colours: number[][], curve: CurvePoint[]): Uint8Array {
  const table = new Uint8Array(4 * tableSize);
  for (let n = 0; n < tableSize; ++n) {
    const at = n / (tableSize - 1), place = at * (colours.length - 1), first = Math.min(Math.floor(place), colours.length - 2);
    const part = place - first;
    const mixed = [0, 1, 2].map((c) => toByte((1 - part) * toLight(colours[first][c]) + part * toLight(colours[first + 1][c])));
    table.set([...mixed.map(Math.round), Math.round(255 * opacityAt(curve, at))], 4 * n);
  }
  return table;
}

const width = 240, height = 84;
const within = (value: number, lo: number, hi: number) => Math.max(lo, Math.min(hi, value));
const short = (value: number) => String(+value.toPrecision(4));

// Moves a point. Points keep their order, and the first and the last their places.
function moved(curve: CurvePoint[], n: number, to: CurvePoint): CurvePoint[] {
  const least = n === 0 ? 0 : n === curve.length - 1 ? 1 : curve[n - 1].at + 0.005;
  const most = n === 0 ? 0 : n === curve.length - 1 ? 1 : curve[n + 1].at - 0.005;
  return curve.map((point, k) => (k === n ? { at: within(to.at, least, most), opacity: within(to.opacity, 0, 1) } : point));
}

// Adds a point in the middle of the widest gap.
function withOneMore(curve: CurvePoint[]): CurvePoint[] {
  let widest = 1;
  for (let n = 2; n < curve.length; ++n) if (curve[n].at - curve[n - 1].at > curve[widest].at - curve[widest - 1].at) widest = n;
  const at = (curve[widest - 1].at + curve[widest].at) / 2;
  return curve.toSpliced(widest, 0, { at, opacity: opacityAt(curve, at) });
}

export function TransferCurve({ attribute, range, colours }: { attribute: string; range: [number, number]; colours: number[][] }) {
  const { design } = useStore();
  const svg = useRef<SVGSVGElement>(null);
  const curve = curveOf(attribute);
  const unit = design?.attributes.find((a) => a.name === attribute)?.unit;
  const change = (to: CurvePoint[] | undefined) => {
    const { [attribute]: _, ...others } = state.curves;
    set({ curves: to ? { ...others, [attribute]: to } : others });
  };
  const under = (event: PointerEvent): CurvePoint => {
    const box = svg.current!.getBoundingClientRect();
    return { at: (event.clientX - box.left) / box.width, opacity: 1 - (event.clientY - box.top) / box.height };
  };
  const onKeyDown = (event: KeyboardEvent, n: number) => {
    const step = event.shiftKey ? 0.1 : 0.02;
    const [right, up] = { ArrowRight: [step, 0], ArrowLeft: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] }[event.key] ?? [0, 0];
    if (right !== 0 || up !== 0) change(moved(curve, n, { at: curve[n].at + right, opacity: curve[n].opacity + up }));
    else if (event.key === "Delete" && n > 0 && n < curve.length - 1) change(curve.toSpliced(n, 1));
    else return;
    event.preventDefault();
  };
  const left = (point: CurvePoint) => point.at * width, top = (point: CurvePoint) => (1 - point.opacity) * height;
  const valueAt = (at: number) => short(range[0] + at * (range[1] - range[0]));
  return (
    <div class="transfer" role="group" aria-label={`Opacity by ${attribute}`} data-points={curve.length}>
      <span>{attribute}{unit && unit !== "1" ? `, ${unit}` : ""}: opacity</span>
      <svg ref={svg} viewBox={`0 0 ${width} ${height}`} role="group" aria-label="Points of the curve; arrows move them, Delete removes one">
        <polyline points={curve.map((point) => `${left(point)},${top(point)}`).join(" ")} />
        {curve.map((point, n) => (
          <circle cx={left(point)} cy={top(point)} r="6" tabindex={0} role="slider" aria-label={`Point ${n + 1}`} aria-valuemin={0} aria-valuemax={1}
                  aria-valuenow={+point.opacity.toFixed(3)} aria-valuetext={`${attribute} ${valueAt(point.at)}, opacity ${point.opacity.toFixed(2)}`}
                  onKeyDown={(e) => onKeyDown(e, n)} onPointerDown={(e) => e.currentTarget.setPointerCapture(e.pointerId)}
                  onPointerMove={(e) => e.currentTarget.hasPointerCapture(e.pointerId) && change(moved(curve, n, under(e)))} />
        ))}
      </svg>
      <span class="ramp" style={{ background: `linear-gradient(in srgb-linear to right, ${colours.map((c) => `rgb(${c.join(",")})`).join(",")})` }} />
      <span class="controls">
        <span>{short(range[0])}</span>
        <button onClick={() => change(withOneMore(curve))}>Add a point</button>
        <button disabled={!(attribute in state.curves)} onClick={() => change(undefined)}>Reset</button>
        <span>{short(range[1])}</span>
      </span>
    </div>
  );
}
