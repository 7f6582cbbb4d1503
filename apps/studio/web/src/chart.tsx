// Shows a table of numbers, such as the history of a study, as line charts, one below the other, since each has its own
// unit.
import { useState } from "preact/hooks";
import { useStore } from "./store";

interface Column {
  name: string;
  numbers: number[]; // NaN for cells without a number
}

// Reads the columns of a CSV file that hold numbers. A first line of words names them.
export function columnsOf(text: string): Column[] {
  const lines = text.split(/\r?\n/).filter((line) => line.trim() !== "" && !line.startsWith("#"));
  if (lines.length === 0) return [];
  const separator = [",", ";", "\t"].find((c) => lines[0].includes(c)) ?? /\s+/;
  const cells = lines.map((line) => line.split(separator).map((word) => word.trim().replace(/^"(.*)"$/, "$1")));
  const numberOf = (word: string | undefined) => (word === undefined || word === "" ? NaN : Number(word));
  const hasNames = cells[0].some((word) => isNaN(numberOf(word)));
  const rows = hasNames ? cells.slice(1) : cells;
  return cells[0]
    .map((word, n) => ({ name: hasNames ? word || `column ${n + 1}` : `column ${n + 1}`, numbers: rows.map((row) => numberOf(row[n])) }))
    .filter((column) => column.numbers.some((v) => isFinite(v)));
}

const short = (value: number) => String(+value.toPrecision(5));

const size = { width: 640, height: 190, left: 76, right: 14, top: 12, bottom: 30 };

function rangeOf(numbers: number[]): [number, number] {
  const finite = numbers.filter(isFinite);
  const lo = finite.reduce((a, b) => Math.min(a, b), Infinity), hi = finite.reduce((a, b) => Math.max(a, b), -Infinity);
  return lo < hi ? [lo, hi] : [lo - 0.5, hi + 0.5];
}

function ticks([lo, hi]: [number, number], about: number): number[] {
  const rough = (hi - lo) / about, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((n) => n * power).find((s) => s >= rough)!;
  const found = [];
  for (let n = Math.ceil(lo / step - 1e-9); n * step <= hi + 1e-9 * (hi - lo); ++n) found.push(n * step);
  return found;
}

function LineChart({ x, y }: { x: Column; y: Column }) {
  const xRange = rangeOf(x.numbers), yRange = rangeOf(y.numbers);
  const left = (v: number) => size.left + ((v - xRange[0]) / (xRange[1] - xRange[0])) * (size.width - size.left - size.right);
  const top = (v: number) => size.height - size.bottom - ((v - yRange[0]) / (yRange[1] - yRange[0])) * (size.height - size.top - size.bottom);
  const points = x.numbers.map((v, n) => [v, y.numbers[n]]).filter(([a, b]) => isFinite(a) && isFinite(b));
  const last = points.at(-1);
  return (
    <figure class="chart" data-column={y.name} data-points={points.length}>
      <figcaption>{y.name}{last && <span class="quiet"> · last {short(last[1])}</span>}</figcaption>
      <svg viewBox={`0 0 ${size.width} ${size.height}`} role="img" aria-label={`${y.name} by ${x.name}: ${points.length} points from ${short(yRange[0])} to ${short(yRange[1])}${last ? `, the last is ${short(last[1])}` : ""}`}>
        {ticks(yRange, 4).map((v) => (
          <>
            <line class="rule" x1={size.left} x2={size.width - size.right} y1={top(v)} y2={top(v)} />
            <text x={size.left - 6} y={top(v) + 4} text-anchor="end">{short(v)}</text>
          </>
        ))}
        {ticks(xRange, 8).map((v) => <text x={left(v)} y={size.height - size.bottom + 18} text-anchor="middle">{short(v)}</text>)}
        <polyline points={points.map(([a, b]) => `${left(a).toFixed(1)},${top(b).toFixed(1)}`).join(" ")} />
        {points.length <= 200 && points.map(([a, b]) => (
          <circle cx={left(a)} cy={top(b)} r={3}>
            <title>{`${x.name} ${short(a)}: ${short(b)}`}</title>
          </circle>
        ))}
      </svg>
    </figure>
  );
}

export function ChartView() {
  const { table, file } = useStore();
  const [chosen, choose] = useState("");
  const columns = columnsOf(table);
  const numbered: Column = { name: "line", numbers: (columns[0]?.numbers ?? []).map((_, n) => n + 1) };
  // The axis shows the first column if its numbers grow, and the numbers of the lines otherwise.
  const counts = columns.length > 1 && columns[0].numbers.every((v, n, all) => n === 0 || v > all[n - 1]);
  const x = columns.find((c) => c.name === chosen) ?? (chosen === "" && counts ? columns[0] : numbered);
  return (
    <section class="view charts" aria-label="Chart">
      <div class="viewbar">
        <label>
          Along
          <select value={x.name} onChange={(e) => choose(e.currentTarget.value)}>
            {[numbered, ...columns].map((c) => <option value={c.name}>{c.name}</option>)}
          </select>
        </label>
      </div>
      <div class="stage scroll" tabIndex={0} role="group" aria-label={`Charts of ${file}`}>
        {columns.length === 0 && <p>The table holds no columns of numbers.</p>}
        {columns.filter((c) => c.name !== x.name).map((y) => <LineChart x={x} y={y} />)}
      </div>
    </section>
  );
}
