// Opens, makes, renames and deletes files.
import { Draft, dropDraft, keptDraft, keptView, renameKept } from "../kept";
import { Link, takeLink } from "../links";
import { listPresets } from "../presets";
import { DataFile, Hello, State, set, state } from "../store";
import { Reply, connection } from "./connection";
import { evaluate, forgetLoads, runScript, showData } from "./evaluation";
import { keepLastFile, lastFile, listFiles } from "./folder";
import { beginWith, beginWithNothing, countAsSaved, endSaving, isDirty, isNew, save, savedText, version } from "./saving";
import { editor } from "./script";

let link: Link | undefined = takeLink();

// Returns the file that the page opens first: that of a link, of the command line, or the one that was open last.
function firstFile(hello: Hello): string | undefined {
  const isThere = (file: string) => hello.files.includes(file) || hello.data.some((d: DataFile) => d.name === file) || hello.drafts.includes(file);
  const last = lastFile();
  if (link) return link.file;
  if (hello.file) return hello.file;
  if (last && isThere(last)) return last;
  return hello.files.find((file) => file.endsWith(".vcad")) ?? hello.drafts[0];
}

// Reads a file. One that was never saved has a draft alone.
async function readFile(file: string): Promise<Reply> {
  try {
    return await connection.ask("open", { file }).answer;
  } catch (error) {
    const isMissing = !state.files.includes(file) && !state.data.some((d) => d.name === file);
    if (isMissing && keptDraft(file)) return { text: "", version: "", kind: "" };
    throw error;
  }
}

let opens = 0, opening = 0; // calls of openFile(), and those that have not ended

// Opens a file. Of several that are asked for one after another the last one counts, whichever is read first.
export async function openFile(file: string) {
  const number = ++opens;
  ++opening;
  try {
    if (isDirty()) await save();
    const disk = await readFile(file);
    if (number !== opens) return;
    const kind = disk.kind as State["kind"];
    beginWith(disk, kind === "");
    forgetLoads();
    const linked = link?.file === file ? link : undefined;
    link = undefined;
    set({ file, kind, table: "", by: "", palette: "", range: undefined, rotate: [0, 0, 0], opacity: {}, values: {}, filesByEnding: {}, presets: [], preset: "", presetsProblem: "", conflict: undefined, design: undefined, graph: undefined, graphProblem: "", camera: undefined, cut: undefined, diagnostics: [], echo: [], variables: [], plan: undefined,
          planProblem: "", probe: undefined, probeBefore: undefined, measure: undefined, saved: "saved", saveProblem: "", problem: "", notice: "", z: NaN, isOld: false, isBusy: false, isRunning: false,
          ...keptView(file), ...linked?.view, ...(linked?.tab ? { view: linked.tab } : {}) });
    keepLastFile(file);
    listPresets();
    if (kind === "scan") set({ view: "planes" });
    if (kind === "results" && !["surface", "slices"].includes(state.view)) set({ view: "surface" });
    if (kind !== "") return showData(disk);
    let text = savedText;
    const draft = newest(keptDraft(file), disk.draft);
    if (draft && draft.text !== savedText) {
      text = draft.text;
      if (draft.version !== version) set({ conflict: { text: disk.text, version: disk.version }, saved: "unsaved" });
    }
    editor!.replace(text);
    evaluate();
    if ((text !== savedText || (isNew && draft)) && !state.conflict) save();
  } catch (error) {
    if (number === opens) set({ problem: String((error as Error).message) });
  } finally {
    --opening;
  }
}

// Opens the page's first file, unless a person has chosen one already.
export async function openFirst(hello: Hello) {
  const first = firstFile(hello);
  if (first && !state.file && opening === 0) await openFile(first);
}

const newest = (a: Draft | null, b: Draft | undefined) => (a && b ? (a.time >= b.time ? a : b) : (a ?? b));

const firstText = "// A new design: lengths are mm, z is up.\nsize = 10; // [2:40]\n\nfgrade([\"0.5 + x / size\", \"0.5 - x / size\"], [red, blue])\n  sphere(size / 2);\n";

export async function newFile(name: string, text = firstText): Promise<string> {
  if (!/\.(vcad|scad|py)$/.test(name)) name += ".vcad";
  const made = await connection.ask("save", { file: name, text, version: "" }).answer;
  if (!made.saved) throw new Error(`${name} is there already`);
  await listFiles();
  await openFile(name);
  return name;
}

// Gives the open file another name. Its text, its undo and how it was seen go with it.
export async function renameOpenFile(to: string) {
  const from = state.file;
  if (isDirty()) await save();
  await connection.ask("rename", { file: from, to }).answer;
  await connection.ask("open", { file: to }).answer; // the server tells changes of files that were opened
  renameKept(from, to);
  editor!.rename(from, to);
  keepLastFile(to);
  set({ file: to });
  await listFiles();
  evaluate();
  listPresets();
}

// Moves the open file into the trash, and shows another one. Returns its place there.
export async function deleteOpenFile(): Promise<string> {
  const file = state.file;
  await endSaving();
  const reply = await connection.ask("delete", { file }).answer;
  dropDraft(file);
  countAsSaved(); // it is not written again
  set({ saved: "saved", conflict: undefined });
  await listFiles();
  const other = state.files[0] ?? state.data[0]?.name;
  if (other) await openFile(other);
  else closeFile();
  return reply.trash;
}

function closeFile() {
  beginWithNothing();
  set({ file: "", kind: "", design: undefined, graph: undefined, plan: undefined, variables: [], values: {}, diagnostics: [], conflict: undefined, camera: undefined, saved: "saved", isOld: false });
  editor!.replace("");
}

// Writes the script that shows a scan or results as a design beside it, which can be changed.
export async function keepAsDesign(): Promise<string> {
  const name = state.file.replace(/(\.nii)?\.[^./]*$/, "") + ".vcad";
  try {
    await newFile(name, editor!.text());
    return "";
  } catch (error) {
    return (error as Error).message;
  }
}

// Runs a Python script as it is on the disk.
export async function runPython() {
  await save();
  if (!state.conflict) runScript();
}
