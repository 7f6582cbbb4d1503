// The graph of the open script, and edits of it, which are edits of the text.
import { set, state } from "../store";
import { Reply, connection } from "./connection";
import { listFiles } from "./folder";
import { editor } from "./script";

export interface Wire {
  from: number; // an item that is a variable
  output: string;
  argument: number;
  is_whole: boolean;
}

export interface GraphItem {
  kind: "call" | "variable" | "value" | "group";
  callee: string;
  variable: string;
  parent?: number;
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

const file = () => state.file || "untitled.vcad";
const graphOf = (text: string, reply: Reply): ScriptGraph => ({ text, items: reply.items, definitions: reply.definitions, is_cut: reply.is_cut });
const reasonIn = (reply: Reply) => reply.diagnostics.map((d: any) => (d.hint ? `${d.message}; ${d.hint}` : d.message)).join("\n");

export const hasGraph = () => state.kind === "" && !/\.(py|json|scad)$/i.test(state.file);

// Reads the graph of the text, if it is not known yet.
export async function readGraph() {
  if (!editor || !connection.isOpen || !hasGraph()) return;
  const text = editor.text();
  if (state.graph?.text === text) return;
  const reply = await connection.ask("script_graph", { file: file(), text }, "graph").answer.catch(() => undefined);
  if (!reply || editor.text() !== text) return;
  if (reply.ok) set({ graph: graphOf(text, reply), graphProblem: "" });
}

let edits: Promise<boolean> = Promise.resolve(true);

// Makes an edit after those before it. Returns true if it was made; else the page says why not.
export function editGraph(edit: Edit, isTyping = false): Promise<boolean> {
  edits = edits.then(() => editNow(edit, isTyping));
  return edits;
}

async function editNow(edit: Edit, isTyping: boolean): Promise<boolean> {
  const text = editor!.text();
  try {
    const reply = await connection.ask("edit_graph", { file: file(), text, ...edit }).answer;
    if (!reply.ok) throw new Error(reasonIn(reply));
    if (editor!.text() !== text) throw new Error("the text was changed meanwhile; do it again");
    if (reply.library) await writeLibrary(edit.path as string, reply.library);
    editor!.apply(reply.steps, isTyping);
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

// Sets an argument while a slider moves: values that come while one is on its way replace each other.
let next: Edit | undefined;
let isMoving = false;

export async function moveValue(edit: Edit) {
  next = edit;
  if (isMoving) return;
  isMoving = true;
  while (next) {
    const now: Edit = next;
    next = undefined;
    await editGraph(now, true);
  }
  isMoving = false;
}
