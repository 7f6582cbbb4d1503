// The graph of the open script, and edits of it, which are edits of the text.
import { set, state } from "../store";
import { Reply, connection } from "./connection";
import { listFiles } from "./folder";
import { EditEvent, editor } from "./script";

export interface Wire {
  from: number; // an item that is a variable
  output: string;
  argument: number;
  is_whole: boolean;
}

export interface GraphItem {
  kind: "call" | "variable" | "value" | "group" | "node" | "part"; // the last two in design files (JSON)
  callee: string;
  variable: string;
  parent?: number;
  inputs?: number[]; // of nodes and parts: the items that they take
  argument: number;
  locked_by: string;
  line: number;
  from: number;
  to: number;
  at: number;
  arguments: { name: string; text: string }[];
  wires: Wire[];
}

export interface Definition {
  name: string;
  is_module: boolean;
  line: number;
  parameters: { name: string; default: string }[];
}

// The graph of a text. It counts for as long as the editor has this text.
export interface ScriptGraph {
  text: string;
  items: GraphItem[];
  definitions: Definition[];
  is_cut: boolean;
}

// An edit of the kind `edit`, with the members that docs/reference/studio-api.md lists for it.
export type Edit = { edit: string } & Record<string, unknown>;

// Returns keys of the items, made of their names and those around them, which stay the same when others come and go.
export function keysOf(graph: ScriptGraph): string[] {
  const keys: string[] = [];
  const counts = new Map<string, number>();
  for (const item of graph.items) {
    const above = item.parent === undefined ? "" : keys[item.parent];
    // Names of nodes and parts may be the same.
    const name = `${above}/${item.kind === "part" ? `part ${item.variable}` : item.variable || item.callee}`;
    const count = counts.get(name) ?? 0;
    counts.set(name, count + 1);
    keys.push(count === 0 ? name : `${name}#${count}`);
  }
  return keys;
}

const file = () => state.file || "untitled.vcad";
const graphOf = (text: string, reply: Reply): ScriptGraph => ({ text, items: reply.items, definitions: reply.definitions, is_cut: reply.is_cut });
const reasonIn = (reply: Reply) => reply.diagnostics.map((d: any) => (d.hint ? `${d.message}; ${d.hint}` : d.message)).join("\n");

export const hasGraph = () => state.kind === "" && !/\.(py|scad)$/i.test(state.file);
export const isDesignFile = () => /\.json$/i.test(state.file);

let reading: { text: string; isRead: Promise<void> } | undefined;

// Reads the graph of the text, if it is not known yet.
export async function readGraph() {
  if (!editor || !connection.isOpen || !hasGraph()) return;
  const text = editor.text();
  if (state.graph?.text === text) return;
  if (reading?.text !== text) reading = { text, isRead: readGraphOf(text) };
  const now = reading;
  await now.isRead;
  if (reading === now) reading = undefined;
}

async function readGraphOf(text: string) {
  const reply = await connection.ask("script_graph", { file: file(), text }, "graph").answer.catch(() => undefined);
  if (reply?.ok && editor!.text() === text) set({ graph: graphOf(text, reply), graphProblem: "" });
}

let edits: Promise<boolean> = Promise.resolve(true);

// Makes an edit of the items of the graph `seen` after the edits before it. Returns true if it was made; else the page says
// why not.
export function editGraph(edit: Edit, event: EditEvent = "input", seen = state.graph): Promise<boolean> {
  edits = edits.then(() => editNow(edit, seen, event));
  return edits;
}

const isMeanwhile = "the text was changed meanwhile; do it again";

// Returns the edit, which was made of the graph `seen`, with the numbers that its items have in the graph of the text now.
async function ofTextNow(edit: Edit, seen: ScriptGraph | undefined): Promise<Edit> {
  const members = ["item", "source", "into", "items", "parameter_items"].filter((name) => edit[name] !== undefined);
  if (!seen || members.length === 0 || seen.text === editor!.text()) return edit;
  await readGraph();
  if (state.graph?.text !== editor!.text()) throw new Error(isMeanwhile);
  const before = keysOf(seen), now = keysOf(state.graph!);
  const renumbered = (items: unknown): unknown => {
    if (Array.isArray(items)) return items.map(renumbered);
    const at = now.indexOf(before[items as number]);
    if (at < 0) throw new Error(isMeanwhile);
    return at;
  };
  return { ...edit, ...Object.fromEntries(members.map((name) => [name, renumbered(edit[name])])) };
}

async function editNow(made: Edit, seen: ScriptGraph | undefined, event: EditEvent): Promise<boolean> {
  try {
    const edit = await ofTextNow(made, seen);
    const text = editor!.text();
    const reply = await connection.ask("edit_graph", { file: file(), text, ...edit }).answer;
    if (!reply.ok) throw new Error(reasonIn(reply));
    if (editor!.text() !== text) throw new Error(isMeanwhile);
    if (reply.library) await writeLibrary(edit.path as string, reply.library);
    editor!.apply(reply.steps, event);
    set({ graph: graphOf(editor!.text(), reply), graphProblem: "", graphMade: reply.made });
    return true;
  } catch (error) {
    set({ graphProblem: (error as Error).message });
    return false;
  }
}

// Writes a library beside the script, which names it by its path from there.
async function writeLibrary(path: string, text: string) {
  const made = await connection.ask("save", { file: `${file().replace(/[^/]*$/, "")}${path}`, text, version: "" }).answer;
  if (!made.saved) throw new Error(`${path} is there already`);
  await listFiles();
}

// A movement that makes many edits, such as a drag, and the event of its next one.
export interface Stroke {
  event: EditEvent;
}

// Sets arguments while something moves: what comes while an edit is on its way replaces each other. The edits are made
// of the graph as it is then.
let next: { make: () => Edit[]; stroke: Stroke } | undefined;
let isMoving = false;

export async function moveValues(make: () => Edit[], stroke: Stroke) {
  next = { make, stroke };
  if (isMoving) return;
  isMoving = true;
  while (next) {
    const now = next as { make: () => Edit[]; stroke: Stroke };
    next = undefined;
    for (const edit of now.make())
      if ((await editGraph(edit, now.stroke.event)) && now.stroke.event === "input") now.stroke.event = "input.type.compose";
  }
  isMoving = false;
}
