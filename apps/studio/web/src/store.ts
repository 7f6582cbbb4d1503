// The state of the page. Components read it, and are drawn again when it changes.
import { useEffect, useState } from "preact/hooks";
import type { ScriptGraph } from "./session/graph";

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

// Values of variables under a name, as texts, as in the file beside the script.
export interface Preset {
  name: string;
  values: Record<string, string>;
}

export interface Material {
  name: string;
  colour: number[];
  density?: number;
}

// A node, and the place of its call in the script, if there is one.
export interface NodeCall {
  type: string;
  from?: number;
  to?: number;
  line?: number;
}

export interface GraphNode extends NodeCall {
  id: number;
  category: string;
  ports: Port[]; // inputs that have edges
  frame?: number[][] | null; // rows of the map to the design's space, unless it stands there; null: not known
}

// An input for other nodes: solids, or a parameter that holds outputs of nodes.
export interface Port {
  name: string;
  type: string;
  from: { node: number; output?: string }[];
}

// The solids that a statement makes which is no call of a node.
export interface MadeSolids {
  from: number;
  nodes: number[];
}

// A value that an expression gives, by its number.
export interface MadeValue {
  from: number;
  to: number;
  value: number;
}

// The thing that a small picture shows: a node, solids together, or the value of an expression.
export type Shown = Pick<MadeSolids, "nodes"> | Pick<MadeValue, "value">;

export interface Design {
  design: string;
  bounds_mm: [number[], number[]];
  materials: Material[];
  parts: string[];
  part_nodes: number[];
  attributes: { name: string; type: string; unit: string }[];
  nodes: GraphNode[];
  made: (MadeSolids | MadeValue)[];
  scans: string[]; // files of the folder that the design reads
}

// A point of an opacity curve: a place between the least and the greatest value, and its opacity, both 0 to 1.
export interface CurvePoint {
  at: number;
  opacity: number;
}

// The kind of a file beside designs.
export type DataKind = "scan" | "results" | "table" | "model";
export interface DataFile {
  name: string;
  kind: DataKind;
}

export interface NodeType {
  name: string;
  category: string;
  sentence: string;
  parameters: { name: string; doc: string; kind: string; widget: string; unit: string; in_space: string; required: boolean; default: unknown; written_default?: string; choices: string[] }[];
  inputs: { least: number; most: number | null };
  gives: string;
  outputs: { name: string; doc: string; type: string }[];
  example: string;
  library?: string; // of an operator: what to write between < and > after `use`
}

export interface Hello {
  program: string;
  folder: string;
  file: string;
  opens_folders: boolean;
  files: string[];
  data: DataFile[];
  printers: { name: string; title: string }[];
  job_options: JobOption[]; // options of `ombre slice`
  kinds: JobKind[]; // kinds of other jobs
  palettes: { name: string; colours: number[][] }[]; // colours from the least value to the greatest, mixed in linear light
  nodes: NodeType[];
  functions: { name: string; signature: string }[];
  endings: string[]; // of files that designs read
  drafts: string[]; // files with a text that is not on the disk
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
  path: string; // absolute path of the folder
  resumes: boolean; // it goes on from where it was interrupted; others begin again
  is_download: boolean; // its output is fetched by the browser
  kind: string; // "slice", "mesh", ...
  folder: string; // folder or file that it writes, or its subject
  file: string;
  options: JobOptions;
  report: ({ event: string } & Record<string, unknown>)[]; // its events, except for progress and messages
  layers: number;
  done: number;
  total: number;
  seconds_left: number;
  message: string;
}

export interface Amount {
  name: string;
  volume_mm3: number;
  mass_g?: number; // present if all materials have a density
}

export interface Probe {
  at: number[];
  inside: boolean;
  distance_mm: number | null;
  composition: Record<string, number>;
  attributes: Record<string, number>;
  parts: string[];
  nodes: NodeCall[]; // nodes from the outermost to the innermost solid that holds the point
  voxel: { index?: number[]; material?: string };
}

export interface Camera {
  azimuth: number;
  elevation: number;
  target: number[];
  height: number; // height of the view, mm
}

// A cut removes what lies beyond all of its planes (one plane, or the planes of a wedge), or outside of a box.
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

// The server's estimate of a job; `of` is the job's request as text, by which outdated answers are recognised.
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

// The comparison of `design` with `mark`.
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
  hasBegun: boolean; // the page's first file is open, or there is none
  hello?: Hello;
  files: string[];
  data: DataFile[];
  file: string;
  kind: "" | DataKind; // kind of the file: a design, or data, whose text is not edited
  table: string; // text of the open table
  saved: "saved" | "unsaved" | "saving" | "failed";
  saveProblem: string;
  conflict?: { text?: string; version?: string }; // version on the disk; without text the file is gone
  design?: Design; // the last one without mistakes
  isOld: boolean; // the text has mistakes, or is being evaluated: the shown design is of an earlier text
  isBusy: boolean;
  problem: string; // problem of the evaluation as a whole
  notice: string; // the result or problem of an action, such as a download
  graph?: ScriptGraph; // of the last text without mistakes
  graphProblem: string; // why an edit of the graph was not made
  graphMade?: number; // place in the text of what an edit has just added
  diagnostics: Diagnostic[];
  echo: string[];
  variables: Variable[];
  values: Record<string, Value>; // values set by sliders, which replace those of the text
  presets: Preset[]; // presets of the script
  filesByEnding: Record<string, string[]>; // files that the script may read, as it names them
  preset: string; // the preset that was chosen last; empty: none
  presetsProblem: string;
  camera?: Camera;
  cut?: Cut;
  perspective: boolean;
  handles: boolean; // the view shows handles of the call at the caret
  showsVoxels: boolean; // on the faces of cuts
  by: string;
  palette: string;
  range?: [number, number]; // range of the values that colours span; undefined: that of the design
  shownRange?: { of: string; range: [number, number] }; // range of the last picture
  opacity: Record<string, number>;
  curves: Record<string, CurvePoint[]>; // opacities by an attribute's values, in the volume view
  options: JobOptions; // options that were chosen; the others are as the printer and the design have them
  rotate: number[]; // rotation of the part in degrees about x, then y, then z
  estimate?: Estimate;
  plan?: Plan;
  planProblem: string;
  z: number; // mm
  probe?: Probe;
  probeBefore?: number[]; // place of the probe before, mm
  measure?: { design: string; volume_mm3: number; pitch_mm: number; materials: Amount[]; parts?: Amount[] };
  mark?: Mark;
  comparison?: Comparison;
  comparisonProblem: string;
  jobs: Job[];
  view: ViewName | "all";
  panel: "variables" | "materials" | "export" | "jobs" | "reference" | "examples";
  theme: "system" | "light" | "dark";
  turntable?: number; // share of the turntable that is made, while one is under way
  showsKeys: boolean;
  isRunning: boolean; // a Python script is run
  transfer?: { name: string; share: number }; // a file that comes in or goes out
  asking?: Asking;
}

// A question to the person, in a dialog. A question for a name has a field for it.
export interface Asking {
  title: string;
  text?: string;
  name?: string;
  buttons: string[]; // the first is the usual one
  answer: (button: string, name: string) => void;
}

// Choices of a person that stay when the page is loaded again.
const kept = ["perspective", "handles", "options", "view", "panel", "theme"] as const;
const known: Partial<State> = JSON.parse(localStorage.getItem("ombre:choices") ?? "{}");

const listeners = new Set<() => void>();
export let state: State = {
  status: "connecting",
  hasBegun: false,
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
  notice: "",
  graphProblem: "",
  diagnostics: [],
  echo: [],
  variables: [],
  values: {},
  presets: [],
  filesByEnding: {},
  preset: "",
  presetsProblem: "",
  perspective: false,
  handles: true,
  showsVoxels: false,
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
  isRunning: false,
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
