// Links to a file and to how it is seen: /?file=part.vcad&view=slices&cut=y<0&D=radius=12
import { View } from "./kept";
import { Cut, State, Value, state } from "./store";

export interface Link {
  file: string;
  tab?: State["view"];
  view: View;
}

const axisNames = "xyz";
const tabs = ["surface", "slices", "volume", "graph", "all", "planes", "chart"];

// Reads a cut as the command line writes it, "y<0" or "x>0,y<0", or a box of six numbers.
export function cutOf(text: string): Cut | undefined {
  const numbers = text.split(",").map(Number);
  if (numbers.length === 6 && numbers.every(isFinite)) return { sides: [], box: [numbers.slice(0, 3), numbers.slice(3)] };
  const sides = text.split(",").map((part) => /^([xyz])([<>])(-?[\d.]+(?:e-?\d+)?)$/i.exec(part.trim()));
  if (text === "" || sides.some((side) => !side || !isFinite(+side[3]))) return undefined;
  return { sides: sides.map((side) => ({ axis: axisNames.indexOf(side![1].toLowerCase()), side: side![2] as "<", mm: +side![3] })) };
}

export const cutText = (cut: Cut) => (cut.box ? cut.box.flat() : cut.sides.map((s) => `${axisNames[s.axis]}${s.side}${s.mm}`)).join();

function valueOf(text: string): Value {
  try {
    return JSON.parse(text);
  } catch {
    return text;
  }
}

function numbersOf(text: string | null, count: number): number[] | undefined {
  const numbers = (text ?? "").split(",").map(Number);
  return text && numbers.length === count && numbers.every(isFinite) ? numbers : undefined;
}

// Returns what the page's address asks for, and takes it out of the address, since the page keeps it from then on.
export function takeLink(): Link | undefined {
  const query = new URLSearchParams(location.search);
  const file = query.get("file");
  if (query.size > 0) history.replaceState(null, "", location.pathname);
  if (!file) return undefined;
  const view: View = {};
  const values = query.getAll("D").map((text) => [text.slice(0, text.indexOf("=")), valueOf(text.slice(text.indexOf("=") + 1))] as const);
  if (values.length > 0) view.values = Object.fromEntries(values.filter(([name]) => name !== ""));
  const cut = cutOf(query.get("cut") ?? "");
  if (cut) view.cut = cut;
  const camera = numbersOf(query.get("camera"), 6);
  if (camera) view.camera = { azimuth: camera[0], elevation: camera[1], target: camera.slice(2, 5), height: camera[5] };
  const rotate = numbersOf(query.get("rotate"), 3);
  if (rotate) view.rotate = rotate;
  const z = numbersOf(query.get("z"), 1);
  if (z) view.z = z[0];
  if (query.has("by")) view.by = query.get("by")!;
  const tab = query.get("view") ?? "";
  return { file, view, tab: tabs.includes(tab) ? (tab as State["view"]) : undefined };
}

const short = (value: number) => +value.toPrecision(6);

// Returns the link to what is seen now.
export function linkToHere(): string {
  const query = new URLSearchParams({ file: state.file, view: state.view });
  if (state.cut) query.set("cut", cutText(state.cut));
  for (const [name, value] of Object.entries(state.values)) query.append("D", `${name}=${JSON.stringify(value)}`);
  if (state.camera) query.set("camera", [state.camera.azimuth, state.camera.elevation, ...state.camera.target, state.camera.height].map(short).join());
  if (state.rotate.some((degrees) => degrees !== 0)) query.set("rotate", state.rotate.join());
  if (isFinite(state.z)) query.set("z", String(short(state.z)));
  if (state.by) query.set("by", state.by);
  return `${location.origin}/?${query}`;
}
