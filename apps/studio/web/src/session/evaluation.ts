// Evaluates the design, with the values that sliders set, and plans its slices.
import { listFileChoices } from "../filechoice";
import { Diagnostic, Plan, State, Value, set, state } from "../store";
import { Refused, Reply, connection } from "./connection";
import { editor } from "./script";

// An edit cancels the running evaluation; a slider waits for it, so that something is seen while it moves.
let evaluateTimer = 0;
let isLoading = false,
  isWanted = false;

export function evaluate(after = 0) {
  clearTimeout(evaluateTimer);
  evaluateTimer = window.setTimeout(() => load(), after);
}

export function setVariable(name: string, value: Value) {
  setValues({ ...state.values, [name]: value });
}

export function setValues(values: State["values"]) {
  set({ values });
  if (isLoading) isWanted = true;
  else load();
}

export function resetVariables() {
  set({ values: {}, preset: "" });
  evaluate();
}

let textOfVariables = ""; // the text in which the known variables have their places

// Writes the values that sliders set into the script, once the places of its variables are known in the text as it is.
export async function writeVariables() {
  if (editor!.text() !== textOfVariables) {
    clearTimeout(evaluateTimer);
    await load();
  }
  if (editor!.text() !== textOfVariables) return set({ notice: "The text was changed meanwhile; write the values into it again." });
  for (const variable of [...state.variables].reverse())
    if (variable.name in state.values) editor!.write(variable.from, variable.to, literal(state.values[variable.name]));
  set({ values: {} });
}

function literal(value: Value): string {
  return JSON.stringify(value).replaceAll(",", ", ");
}

const isPython = () => state.file.endsWith(".py");

// Runs the open Python script. It may do anything, so it only runs when a person asks for it.
export const runScript = () => load(true);

export function stopPython() {
  ++loads;
  connection.cancelLane("load");
  set({ isBusy: false, isRunning: false, problem: "The script was stopped." });
}

// The output of a Python script while it runs.
export function hearScript(file: string, line: string) {
  const mostLines = 200;
  if (state.isRunning && file === state.file && state.echo.length < mostLines) set({ echo: [...state.echo, line] });
}

// Shows the script that comes with a scan or results, or a table as it is.
export function showData(disk: Reply) {
  editor!.replace(disk.text);
  if (state.kind === "table") set({ table: disk.text, design: undefined, isBusy: false });
  else evaluate();
}

// Lists the values that the page sets instead of those in the text, for variables that the text still has.
function definitions(): string[] {
  const known = new Set(state.variables.map((v) => v.name));
  return Object.entries(state.values)
    .filter(([name]) => known.size === 0 || known.has(name))
    .map(([name, value]) => `${name}=${JSON.stringify(value)}`);
}

// Chooses the number of results that is shown: the one that was shown before, else the stress.
function fieldToShow(attributes: { name: string }[]): string {
  const names = attributes.map((a) => a.name);
  if (names.includes(state.by)) return state.by;
  return names.find((name) => /von_?mises/i.test(name)) ?? names.at(-1) ?? "";
}

export let shown = { file: "", text: "", definitions: [] as string[], rotate: [0, 0, 0] }; // source of the shown design

let loads = 0;

// Answers about the file that was open before no longer count.
export function forgetLoads() {
  ++loads;
}

// Mistakes stand in the order of the text; those of other files come first.
const inOrder = (diagnostics: Diagnostic[]) => [...diagnostics].sort((a, b) => (a.from ?? -1) - (b.from ?? -1));

async function load(isRun = false) {
  if (!editor || !state.file || !connection.isOpen || state.kind === "table") return;
  if (isPython() && !isRun) return set({ isOld: state.design !== undefined, problem: "" });
  isLoading = true;
  isWanted = false;
  const number = ++loads;
  set({ isBusy: true, ...(isRun ? { isRunning: true, echo: [], problem: "" } : {}) });
  const sent = { file: state.file, text: editor.text(), definitions: definitions(), rotate: state.rotate };
  try {
    const reply = await connection.ask("load", { ...sent, ...(isRun ? { run: true } : {}) }, "load").answer;
    if (number !== loads) return; // the answer crossed the cancelling by a newer one
    const change: any = { isBusy: false, isRunning: false, problem: "", diagnostics: inOrder(reply.diagnostics), echo: reply.echo, variables: reply.variables ?? [], isOld: !reply.ok };
    if (reply.ok) change.design = reply;
    if (reply.ok && state.kind === "results") change.by = fieldToShow(reply.attributes);
    textOfVariables = sent.text;
    if (reply.ok) shown = sent;
    if (reply.ok && isNaN(state.z)) change.z = (reply.bounds_mm[0][2] + reply.bounds_mm[1][2]) / 2;
    set(change);
    editor.setDiagnostics();
    listFileChoices();
    if (reply.ok) plan();
  } catch (error) {
    const refused = error as Refused;
    if (refused.isCancelled || number !== loads) return;
    set({ isBusy: false, isRunning: false, isOld: state.design !== undefined, problem: refused.message, diagnostics: [], variables: refused.code === "unsupported" ? [] : state.variables });
    editor.setDiagnostics();
  } finally {
    isLoading = false;
    if (isWanted) load();
  }
}

// Asks something about the design. If the server has forgotten the design, it is loaded again.
export async function about(what: string, members: Record<string, unknown>, lane: string): Promise<Reply> {
  try {
    return await connection.ask(what, { design: state.design!.design, ...members }, lane).answer;
  } catch (error) {
    if ((error as Refused).code === "gone") evaluate();
    throw error;
  }
}

export async function plan() {
  if (!state.design) return;
  const design = state.design.design;
  try {
    const reply = await about("plan", state.options, "plan");
    set({ plan: { ...(reply as unknown as Plan), design }, planProblem: "" });
  } catch (error) {
    if (!(error as Refused).isCancelled) set({ planProblem: (error as Error).message });
  }
}
