// Controls of cuts, which show the inside of a design by removing the part behind a plane, in a wedge, or outside of a
// box.
import { axes } from "./camera";
import { Slider } from "./slider";
import { Cut, Design, set, state, useStore } from "./store";

const axisNames = ["x", "y", "z"];

// Returns the cut as the server takes it.
export function cutMembers(cut: Cut | undefined): Record<string, unknown> {
  if (cut?.box) return { box: cut.box.flat() };
  return { cuts: cut ? [cut.sides.map((s) => `${axisNames[s.axis]}${s.side}${s.mm}`).join()] : [] };
}

export type Rectangle = [number, number, number, number]; // from x and y to x and y, mm; its sides may be infinite

// Returns what a cut removes of the layer at z.
export function removedAt(cut: Cut | undefined, z: number): Rectangle[] {
  if (!cut) return [];
  const all = Infinity;
  if (cut.box) {
    const [[x0, y0, z0], [x1, y1, z1]] = cut.box;
    if (z < z0 || z > z1) return [[-all, -all, all, all]];
    return [[-all, -all, x0, all], [x1, -all, all, all], [x0, -all, x1, y0], [x0, y1, x1, all]];
  }
  const of = (axis: number) => cut.sides.find((s) => s.axis === axis);
  const range = (axis: number): [number, number] => {
    const side = of(axis);
    return !side ? [-all, all] : side.side === "<" ? [-all, side.mm] : [side.mm, all];
  };
  const [low, high] = range(2);
  if (z < low || z > high) return [];
  const [x, y] = [range(0), range(1)];
  return [[x[0], y[0], x[1], y[1]]];
}

const middle = (design: Design, axis: number) => (design.bounds_mm[0][axis] + design.bounds_mm[1][axis]) / 2;

const sideOfEye = (axis: number) => (state.camera && axes(state.camera).forward[axis] < 0 ? ">" : "<");

function chosen(cut: Cut | undefined): string {
  if (!cut) return "";
  if (cut.box) return "box";
  return cut.sides.length > 1 ? "wedge" : axisNames[cut.sides[0].axis] + cut.sides[0].side;
}

function choose(name: string, design: Design) {
  if (name === "") return set({ cut: undefined });
  if (name === "box") return set({ cut: { sides: [], box: [[...design.bounds_mm[0]], design.bounds_mm[1].map((_, n) => middle(design, n))] } });
  if (name === "wedge") return set({ cut: { sides: [0, 1].map((axis) => ({ axis, side: sideOfEye(axis), mm: middle(design, axis) })) } });
  const axis = axisNames.indexOf(name[0]);
  set({ cut: { sides: [{ axis, side: name[1] as "<", mm: middle(design, axis) }] } });
}

function Place({ label, axis, value, take }: { label: string; axis: number; value: number; take: (mm: number) => void }) {
  const { design } = useStore();
  const [lo, hi] = design!.bounds_mm.map((corner) => corner[axis]);
  return <Slider label={label} min={lo} max={hi} step={(hi - lo) / 200} value={value} take={take} />;
}

function Wedge({ cut }: { cut: Cut }) {
  const { design } = useStore();
  const change = (axis: number, side: string, mm: number) => {
    const others = cut.sides.filter((s) => s.axis !== axis);
    const sides = side ? [...others, { axis, side: side as "<", mm }] : others;
    if (sides.length > 0) set({ cut: { sides: sides.sort((a, b) => a.axis - b.axis) } });
  };
  return (
    <>
      {axisNames.map((name, axis) => {
        const own = cut.sides.find((s) => s.axis === axis);
        return (
          <span class="controls">
            <label>
              {name}
              <select value={own?.side ?? ""} onChange={(e) => change(axis, e.currentTarget.value, own?.mm ?? middle(design!, axis))}>
                <option value="">any</option>
                <option value="<">&lt;</option>
                <option value=">">&gt;</option>
              </select>
            </label>
            {own && <Place label={`Place of the wedge, ${name}`} axis={axis} value={own.mm} take={(mm) => change(axis, own.side, mm)} />}
          </span>
        );
      })}
    </>
  );
}

// The two ends along an axis cannot pass each other.
function BoxEnds({ box }: { box: [number[], number[]] }) {
  const { design } = useStore();
  const change = (end: number, axis: number, mm: number) => {
    const least = (design!.bounds_mm[1][axis] - design!.bounds_mm[0][axis]) / 200;
    const made = box.map((corner) => [...corner]) as [number[], number[]];
    made[end][axis] = end === 0 ? Math.min(mm, box[1][axis] - least) : Math.max(mm, box[0][axis] + least);
    set({ cut: { sides: [], box: made } });
  };
  return (
    <>
      {axisNames.map((name, axis) => (
        <span class="controls">
          {name}
          {["from", "to"].map((word, end) => <Place label={`Box, ${name} ${word}`} axis={axis} value={box[end][axis]} take={(mm) => change(end, axis, mm)} />)}
        </span>
      ))}
    </>
  );
}

export function CutControls() {
  const { cut, design } = useStore();
  const name = chosen(cut);
  return (
    <span class="controls">
      <label>
        Cut
        <select class="cut" value={name} onChange={(e) => design && choose(e.currentTarget.value, design)}>
          <option value="">none</option>
          {["x<", "x>", "y<", "y>", "z<", "z>"].map((plane) => (
            <option value={plane}>
              {plane[0]} {plane[1]}
            </option>
          ))}
          <option value="wedge">wedge</option>
          <option value="box">box</option>
        </select>
      </label>
      {cut && design && cut.box && <BoxEnds box={cut.box} />}
      {cut && design && name === "wedge" && <Wedge cut={cut} />}
      {cut && design && !cut.box && name !== "wedge" && (
        <Place label="Place of the cut" axis={cut.sides[0].axis} value={cut.sides[0].mm} take={(mm) => set({ cut: { sides: [{ ...cut.sides[0], mm }] } })} />
      )}
    </span>
  );
}
