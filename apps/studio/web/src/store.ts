// What the page knows. Components read it, and are drawn again when it changes.
import { useEffect, useState } from "preact/hooks";

export interface Diagnostic {
  severity: "note" | "warning" | "error";
  message: string;
  hint?: string;
  file?: string;
  line?: number;
  column?: number;
  from?: number;
  to?: number;
}

export type Value = number | boolean | string | number[];

export interface Variable {
  name: string;
  kind: "number" | "boolean" | "text" | "vector" | "choice";
  value: Value;
  description?: string;
  section?: string;
  least?: number;
  step?: number;
  most?: number;
  longest?: number;
  choices?: { value: Value; label: string }[];
  from: number;
  to: number;
}

// Values of variables under a name, as texts, as the file beside the script has them.
export interface Preset {
  name: string;
  values: Record<string, string>;
}

export interface Material {
  name: string;
  colour: number[];
  density?: number;
}

// A node, and where its call stands in the script, if it does.
export interface NodeCall {
  type: string;
  from?: number;
  to?: number;
  line?: number;
}

export interface GraphNode extends NodeCall {
  id: number;
  category: string;
  ports: Port[]; // that have edges
}

// Where other nodes go in: solids, or a parameter that holds outputs of nodes.
export interface Port {
  name: string;
  type: string;
  from: { node: number; output?: string }[];
}

export interface Design {
  design: string;
  bounds_mm: [number[], number[]];
  materials: Material[];
  parts: string[];
  part_nodes: number[];
  attributes: { name: string; type: string; unit: string }[];
  nodes: GraphNode[];
  scans: string[]; // files of the folder that it reads
}

// How opaque a value is: its place between the least and the greatest, and the opacity, both 0 to 1.
export interface CurvePoint {
  at: number;
  opacity: number;
}

// A file beside designs.
export type DataKind = "scan" | "results" | "table";
export interface DataFile {
  name: string;
  kind: DataKind;
}

export interface NodeType {
  name: string;
  category: string;
  sentence: string;
  parameters: { name: string; doc: string; kind: string; unit: string; required: boolean; default: unknown; choices: string[] }[];
  gives: string;
  outputs: { name: string; doc: string; type: string }[];
  example: string;
}

export interface Hello {
  program: string;
  folder: string;
  file: string;
  opens_folders: boolean;
  files: string[];
  printers: { name: string; title: string }[];
  job_options: JobOption[]; // of `ombre slice`
  kinds: JobKind[]; // of other jobs
  palettes: { name: string; colours: number[][] }[]; // from the least value to the greatest, mixed in linear light
  nodes: NodeType[];
  functions: { name: string; signature: string }[];
}

export interface Plan {
  design: string;
  title: string;
  count: number[];
  pitch_mm: number[];
  origin_mm: number[];
  materials: { name: string; colour: number[] }[];
  remarks: Diagnostic[];
  job: string;
}

export interface Job {
  id: number;
  state: "waiting" | "working" | "paused" | "done" | "failed" | "cancelled" | "interrupted";
  path: string; // of the folder, whole
  rotate?: number[]; // which the page remembers
  kind: string; // "slice", "mesh", ...
  folder: string; // or the file that it writes, or what it is of
  file: string;
  options: JobOptions;
  report: ({ event: string } & Record<string, unknown>)[]; // what it told, but for progress and messages
  layers: number;
  done: number;
  total: number;
  seconds_left: number;
  message: string;
}

export interface Amount {
  name: string;
  volume_mm3: number;
  mass_g?: number; // where all materials have a density
}

export interface Probe {
  at: number[];
  inside: boolean;
  distance_mm: number | null;
  composition: Record<string, number>;
  attributes: Record<string, number>;
  parts: string[];
  nodes: NodeCall[]; // from the outermost to the innermost solid that holds the point
  voxel: { index?: number[]; material?: string };
}

export interface Camera {
  azimuth: number;
  elevation: number;
  target: number[];
  height: number; // mm, of what the view shows
}

// A cut takes away what lies beyond all of its planes (one plane, or the planes of a wedge), or what lies outside of a box.
export interface Cut {
  sides: { axis: number; side: "<" | ">"; mm: number }[];
  box?: [number[], number[]];
}

// A row of the options of a job, from which the form is made.
export interface JobOption {
  name: string;
  help: string;
  placeholder: string;
  kind: string; // "flag", "word", "number", ...
  takes: "nothing" | "one" | "several";
  is_required: boolean;
  choices: string[];
  needs: string[];
  excludes: string[];
  least?: number;
  most?: number;
}
export type JobOptions = Record<string, string | boolean>;

export interface JobKind {
  name: string;
  help: string;
  options: JobOption[];
}

// The server estimates a job before it begins; `of` is the job's request as text, so that an old answer is known as such.
export interface Estimate {
  of: string;
  seconds: number;
  bytes: number;
  is_least: boolean;
  memory_bytes: number;
  free_bytes?: number;
  checks: string[];
}

// A version that later ones are compared with.
export interface Mark {
  design: string; // its handle, until the server forgets it
  file: string;
  text: string;
  definitions: string[];
  rotate: number[];
  time: string;
}

// `design` against `mark`.
export interface Comparison {
  design: string;
  mark: Mark;
  gained_mm3: number;
  lost_mm3: number;
  changed_mm3: number;
  unchanged_mm3: number;
  pitch_mm: number;
}

export type ViewName = "surface" | "slices" | "volume" | "graph" | "planes" | "chart";

export interface State {
  status: "connecting" | "open" | "lost" | "refused";
  hello?: Hello;
  files: string[];
  data: DataFile[];
  file: string;
  kind: "" | DataKind; // of the file: a design, or data, whose text is not edited
  table: string; // text of the table that is open
  saved: "saved" | "unsaved" | "saving" | "failed";
  saveProblem: string;
  conflict?: { text?: string; version?: string }; // what the disk has; no text: it is gone
  design?: Design; // the last one that was right
  isOld: boolean; // the text has mistakes, or is being evaluated: what is shown is of an earlier text
  isBusy: boolean;
  problem: string; // of the evaluation as a whole
  diagnostics: Diagnostic[];
  echo: string[];
  variables: Variable[];
  values: Record<string, Value>; // set by sliders, in place of the text's
  presets: Preset[]; // of the script
  filesByEnding: Record<string, string[]>; // that the script may read, as it names them
  preset: string; // that was chosen last; empty: none
  presetsProblem: string;
  camera?: Camera;
  cut?: Cut;
  perspective: boolean;
  by: string;
  palette: string;
  range?: [number, number]; // of the values that colours span; nothing: those of the design
  shownRange?: { of: string; range: [number, number] }; // of the last picture
  opacity: Record<string, number>;
  curves: Record<string, CurvePoint[]>; // opacities by an attribute's values, in the volume view
  options: JobOptions; // that were chosen; others are as the printer and the design have them
  rotate: number[]; // degrees about x, then y, then z: how the part lies
  estimate?: Estimate;
  plan?: Plan;
  planProblem: string;
  z: number; // mm
  probe?: Probe;
  probeBefore?: number[]; // where the one before was, mm
  measure?: { design: string; volume_mm3: number; pitch_mm: number; materials: Amount[]; parts?: Amount[] };
  mark?: Mark;
  comparison?: Comparison;
  comparisonProblem: string;
  jobs: Job[];
  view: ViewName | "all";
  panel: "variables" | "materials" | "export" | "jobs" | "reference" | "examples";
  theme: "system" | "light" | "dark";
  turntable?: number; // the share of one under way that is made
  showsKeys: boolean;
}

// What a person chose of the page, which stays when it is loaded again.
const kept = ["perspective", "options", "view", "panel", "theme"] as const;
const known: Partial<State> = JSON.parse(localStorage.getItem("ombre:choices") ?? "{}");

const listeners = new Set<() => void>();
export let state: State = {
  status: "connecting",
  files: [],
  data: [],
  file: "",
  kind: "",
  table: "",
  saved: "saved",
  saveProblem: "",
  isOld: false,
  isBusy: false,
  problem: "",
  diagnostics: [],
  echo: [],
  variables: [],
  values: {},
  presets: [],
  filesByEnding: {},
  preset: "",
  presetsProblem: "",
  perspective: false,
  by: "",
  palette: "",
  opacity: {},
  curves: {},
  options: {},
  rotate: [0, 0, 0],
  planProblem: "",
  z: NaN,
  comparisonProblem: "",
  jobs: [],
  view: "surface",
  panel: "variables",
  theme: "system",
  showsKeys: false,
  ...known,
};

export function set(change: Partial<State>) {
  state = { ...state, ...change };
  if (kept.some((name) => name in change)) localStorage.setItem("ombre:choices", JSON.stringify(Object.fromEntries(kept.map((name) => [name, state[name]]))));
  for (const listener of [...listeners]) listener();
}

export function subscribe(listener: () => void): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

export function useStore(): State {
  const [, redraw] = useState({});
  useEffect(() => subscribe(() => redraw({})), []);
  return state;
}
