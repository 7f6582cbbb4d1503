// Actions of the page: it opens, saves, evaluates, slices. Components call them; answers go into the store.
import { Connection, Refused, Reply } from "./connection";
import { listFileChoices } from "./filechoice";
import { Draft, dropDraft, keepDraft, keptDraft, keptDrafts, keptView, renameKept, takeEarlyText } from "./kept";
import { Link, takeLink } from "./links";
import { hearPresets, listPresets } from "./presets";
import { DataFile, Diagnostic, Hello, Job, JobOption, JobOptions, Mark, Plan, State, Value, set, state } from "./store";

// The part of the editor that the session needs.
export interface Editor {
  text(): string;
  replace(text: string): void;
  write(from: number, to: number, text: string): void;
  reveal(from: number, to: number): void;
  setDiagnostics(): void;
  rename(from: string, to: string): void; // what is kept of a file belongs to its new name
}

let editor: Editor | undefined;
let version = ""; // the version of the text that was opened or saved last
let savedText = "";
let sentText: string | undefined; // the text of a save whose answer may have been lost
let ownTexts: string[] = []; // the texts that this window saved last
const mostOwnTexts = 8;
let saving: Promise<void> = Promise.resolve();
let usesCrlf = false;

export const connection = new Connection({
  opened: () => greet(),
  lost: () => set({ status: "lost", isBusy: false }),
  refused: () => set({ status: "refused" }),
  event: (name, members) => heard(name, members),
});

export function setEditor(made: Editor) {
  editor = made;
}

let isNew = false; // the open file is not on the disk yet
let link: Link | undefined = takeLink();

// Keeps only options that the server knows, since another version of the program may have saved them.
const knownOptions = (hello: Hello) =>
  Object.fromEntries(
    Object.entries(state.options).filter(([name, value]) =>
      name === "printer" ? hello.printers.some((p) => p.name === value) : hello.job_options.some((o) => o.name === name && (o.choices.length === 0 || o.choices.includes(String(value)))),
    ),
  );

async function greet() {
  const hello = (await connection.ask("hello").answer) as any;
  const isFirst = !state.hello;
  set({ status: "open", hello, files: hello.files, data: hello.data, options: knownOptions(hello) });
  hello.drafts = [...new Set([...hello.drafts, ...keptDrafts()])];
  set({ jobs: (await connection.ask("jobs").answer).jobs });
  if (!isFirst) return comeBack();
  if (await adoptEarlyText()) return;
  const first = firstFile(hello);
  if (first) await openFile(first);
}

function firstFile(hello: Hello): string | undefined {
  const isThere = (file: string) => hello.files.includes(file) || hello.data.some((d: DataFile) => d.name === file) || hello.drafts.includes(file);
  const last = localStorage.getItem(`ombre:file:${hello.folder}`);
  if (link) return link.file;
  if (hello.file) return hello.file;
  if (last && isThere(last)) return last;
  return hello.files.find((file) => file.endsWith(".vcad")) ?? hello.drafts[0];
}

export function freeName(stem: string): string {
  const isTaken = (name: string) => state.files.includes(name) || state.hello?.drafts.includes(name);
  for (let n = 1; ; ++n) {
    const name = n === 1 ? `${stem}.vcad` : `${stem}_${n}.vcad`;
    if (!isTaken(name)) return name;
  }
}

// Text that was typed before the server answered becomes a new file.
async function adoptEarlyText(): Promise<boolean> {
  const early = takeEarlyText();
  const typed = isNew ? editor!.text() : "";
  const text = typed || early;
  if (!text) return false;
  const name = freeName("untitled");
  if (isNew) editor!.rename(state.file, name);
  set({ file: name, kind: "" });
  isNew = true;
  if (!typed) editor!.replace(text);
  keepDraft(name, text, "");
  localStorage.setItem(`ombre:file:${state.hello?.folder}`, name);
  await save();
  evaluate();
  return true;
}

// Continues after the server was away. Text typed meanwhile is kept, unless the disk has something new.
async function comeBack() {
  if (!state.file) return;
  const disk = await connection.ask("open", { file: state.file }).answer.catch(() => undefined);
  listPresets();
  if (disk && state.kind !== "") return showData(disk);
  if (disk && disk.version !== version) takeFromDisk(disk);
  if (!state.conflict && isDirty()) save();
  evaluate();
}

function fromDisk(text: string): string {
  usesCrlf = text.includes("\r\n");
  return text.replaceAll("\r\n", "\n");
}

export function isDirty(): boolean {
  return editor !== undefined && state.file !== "" && state.kind === "" && (isNew || editor.text() !== savedText);
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

export async function openFile(file: string) {
  if (isDirty()) await save();
  try {
    const disk = await readFile(file);
    version = disk.version;
    savedText = fromDisk(disk.text);
    sentText = undefined;
    ownTexts = [];
    ++loads; // an answer about another file no longer counts
    const kind = disk.kind as State["kind"];
    isNew = kind === "" && version === "";
    const linked = link?.file === file ? link : undefined;
    link = undefined;
    set({ file, kind, table: "", by: "", palette: "", range: undefined, rotate: [0, 0, 0], opacity: {}, values: {}, filesByEnding: {}, presets: [], preset: "", presetsProblem: "", conflict: undefined, design: undefined, camera: undefined, cut: undefined, diagnostics: [], echo: [], variables: [], plan: undefined,
          planProblem: "", probe: undefined, probeBefore: undefined, measure: undefined, saved: "saved", saveProblem: "", problem: "", notice: "", z: NaN, isOld: false, isBusy: false, isRunning: false,
          ...keptView(file), ...linked?.view, ...(linked?.tab ? { view: linked.tab } : {}) });
    localStorage.setItem(`ombre:file:${state.hello?.folder}`, file);
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
    set({ problem: String((error as Error).message) });
  }
}

const newest = (a: Draft | null, b: Draft | undefined) => (a && b ? (a.time >= b.time ? a : b) : (a ?? b));

// Shows a scan or results by the script that comes with them.
function showData(disk: Reply) {
  editor!.replace(disk.text);
  if (state.kind === "table") set({ table: disk.text, design: undefined, isBusy: false });
  else evaluate();
}

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
  localStorage.setItem(`ombre:file:${state.hello?.folder}`, to);
  set({ file: to });
  await listFiles();
  evaluate();
  listPresets();
}

// Moves the open file into the trash, and shows another one. Returns its place there.
export async function deleteOpenFile(): Promise<string> {
  const file = state.file;
  clearTimeout(saveTimer);
  await saving;
  const reply = await connection.ask("delete", { file }).answer;
  dropDraft(file);
  savedText = editor!.text(); // it is not written again
  set({ saved: "saved", conflict: undefined });
  await listFiles();
  const other = state.files[0] ?? state.data[0]?.name;
  if (other) await openFile(other);
  else closeFile();
  return reply.trash;
}

function closeFile() {
  version = savedText = "";
  set({ file: "", kind: "", design: undefined, plan: undefined, variables: [], values: {}, diagnostics: [], conflict: undefined, camera: undefined, saved: "saved", isOld: false });
  editor!.replace("");
}

export async function listFiles() {
  const { files, data } = await connection.ask("list").answer;
  set({ files, data });
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

let saveTimer = 0, draftTimer = 0;
let sentDraft: { file: string; isKept: Promise<unknown> } | undefined;
export function edited() {
  if (!state.file) beginFile();
  keepDraft(state.file, editor!.text(), version);
  set({ saved: "unsaved" });
  clearTimeout(saveTimer);
  saveTimer = window.setTimeout(save, 800);
  draftTimer ||= window.setTimeout(sendDraft, 1000);
  evaluate(200);
}

// Text typed before a file is open belongs to a new file.
function beginFile() {
  const file = freeName("untitled");
  version = savedText = "";
  isNew = true;
  editor!.rename("", file);
  set({ file, kind: "" });
  localStorage.setItem(`ombre:file:${state.hello?.folder}`, file);
}

// Gives the server a text that is not in its file yet, so that it also outlives this browser.
async function sendDraft() {
  draftTimer = 0;
  if (!isDirty() || !connection.isOpen) return;
  const { file } = state;
  sentDraft = { file, isKept: connection.ask("keep_draft", { file, text: editor!.text(), version }).answer.catch(() => undefined) };
  await sentDraft.isKept;
}

// Removes the draft from the server, once it is there, so that it does not come after the saved text.
async function removeDrafts(file: string) {
  dropDraft(file);
  if (sentDraft?.file !== file) return;
  const { isKept } = sentDraft;
  sentDraft = undefined;
  await isKept;
  await connection.ask("drop_draft", { file }).answer.catch(() => undefined);
}

export function save(): Promise<void> {
  clearTimeout(saveTimer);
  saving = saving.then(saveNow);
  return saving;
}

async function saveNow() {
  if (!isDirty() && state.saved !== "unsaved") return;
  if (!connection.isOpen || state.conflict || !editor) return;
  const file = state.file,
    text = editor.text();
  set({ saved: "saving" });
  sentText = text;
  ownTexts = [...ownTexts.slice(-mostOwnTexts), text];
  try {
    const reply = await connection.ask("save", { file, text: usesCrlf ? text.replaceAll("\n", "\r\n") : text, version }).answer;
    if (file !== state.file) return;
    const onDisk = reply.saved || reply.text === undefined ? undefined : fromDisk(reply.text);
    const isOwn = onDisk !== undefined && (onDisk === savedText || ownTexts.includes(onDisk));
    version = reply.saved || onDisk === text || isOwn ? reply.version : version;
    // A version that this window, or another one with the same text, has just saved does not count as a change by others.
    if (isOwn && onDisk !== text) return await saveNow();
    if (!reply.saved && onDisk !== text) {
      set({ saved: "unsaved", conflict: { text: reply.text, version: reply.version } });
      return void sendDraft();
    }
    savedText = text;
    if (isNew) listFiles();
    isNew = false;
    if (editor.text() === text) removeDrafts(file);
    set({ saved: editor.text() === text ? "saved" : "unsaved", saveProblem: "" });
  } catch (error) {
    if (file !== state.file) return;
    set({ saved: "failed", saveProblem: (error as Error).message });
    sendDraft();
  }
}

function takeFromDisk(disk: Reply) {
  // Another window with the same draft may have saved it first.
  if (fromDisk(disk.text) === editor!.text()) {
    version = disk.version;
    savedText = editor!.text();
    removeDrafts(state.file);
    return set({ saved: "saved", saveProblem: "", conflict: undefined });
  }
  if (fromDisk(disk.text) === sentText) {
    version = disk.version;
    savedText = sentText;
    return;
  }
  if (isDirty() && ownTexts.includes(fromDisk(disk.text))) return; // news of an earlier save of this window
  if (isDirty()) return set({ conflict: { text: disk.text, version: disk.version }, saved: "unsaved" });
  version = disk.version;
  savedText = fromDisk(disk.text);
  if (editor!.text() !== savedText) editor!.replace(savedText);
}

// Settles which of two texts counts, when others changed the file as well.
export function settle(mine: boolean) {
  const disk = state.conflict;
  if (!disk) return;
  version = disk.version ?? "";
  if (mine || disk.text === undefined) {
    set({ conflict: undefined, saved: "unsaved" });
    save();
    return;
  }
  savedText = fromDisk(disk.text);
  isNew = false;
  dropDraft(state.file);
  connection.ask("drop_draft", { file: state.file }).answer.catch(() => undefined);
  set({ conflict: undefined, saved: "saved" });
  editor!.replace(savedText);
  evaluate();
}

async function heard(name: string, members: Reply) {
  if (name === "job") return takeJob(members.job);
  if (name === "presets") return hearPresets(members.file, members.presets);
  if (name === "list") return set({ files: members.files, data: members.data });
  if (name === "zipping") return set({ transfer: { name: members.name, share: members.share } });
  if (name === "said") return hearScript(members.file, members.line);
  if (name !== "changed") return;
  await saving;
  if (members.file !== state.file) return evaluate(100);
  if (members.version === version) return;
  if (members.version === "" && state.kind === "") return set({ conflict: {}, saved: "unsaved" });
  const disk = await connection.ask("open", { file: state.file }).answer;
  if (disk.version === version) return;
  if (state.kind !== "") {
    version = disk.version;
    return showData(disk);
  }
  takeFromDisk(disk);
  evaluate();
}

// The output of a Python script while it runs.
function hearScript(file: string, line: string) {
  const mostLines = 200;
  if (state.isRunning && file === state.file && state.echo.length < mostLines) set({ echo: [...state.echo, line] });
}

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

export function writeVariables() {
  for (const variable of [...state.variables].reverse())
    if (variable.name in state.values) editor!.write(variable.from, variable.to, literal(state.values[variable.name]));
  set({ values: {} });
}

function literal(value: Value): string {
  return JSON.stringify(value).replaceAll(",", ", ");
}

const isPython = () => state.file.endsWith(".py");

// Runs a Python script as it is on the disk. It may do anything, so it only runs when a person asks for it.
export async function runPython() {
  await save();
  if (!state.conflict) load(true);
}

export function stopPython() {
  ++loads;
  connection.cancelLane("load");
  set({ isBusy: false, isRunning: false, problem: "The script was stopped." });
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

let shown = { file: "", text: "", definitions: [] as string[], rotate: [0, 0, 0] }; // source of the shown design

let loads = 0;

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

// Two jobs with the same key are the same job.
export const jobKey = () => JSON.stringify([state.design?.design, state.options]);

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

// Sets an option; an empty text, or false, removes it. Options that it excludes are removed.
export function chooseOption(option: JobOption, value: string | boolean) {
  const others = Object.entries(state.options).filter(([name]) => {
    const other = state.hello!.job_options.find((o) => o.name === name);
    return name !== option.name && !(value && (option.excludes.includes(name) || other?.excludes.includes(option.name)));
  });
  const options: JobOptions = Object.fromEntries(value ? [...others, [option.name, value]] : others);
  // Options that need a removed one are removed with it.
  for (const { name, needs } of state.hello!.job_options) if (needs.some((needed) => !(needed in options))) delete options[name];
  set({ options });
  plan();
}

// Turns the part on the tray; the views show it so.
export function turn(rotate: number[]) {
  set({ rotate });
  evaluate(150);
}

export async function openFolder(job: Job) {
  await connection.ask("open_folder", { folder: job.folder }).answer.catch((error) => set({ notice: (error as Error).message }));
}

export async function estimate(): Promise<string> {
  const of = jobKey();
  try {
    set({ estimate: { of, ...((await about("estimate", state.options, "estimate")) as any) } });
    return "";
  } catch (error) {
    return (error as Refused).isCancelled ? "" : (error as Error).message;
  }
}

export async function measure() {
  if (!state.design) return;
  const design = state.design.design;
  try {
    set({ measure: { design, ...((await about("measure", {}, "measure")) as any) } });
  } catch {
    // Another request is under way, or the design is gone.
  }
}

export function markVersion() {
  if (!state.design) return;
  set({ mark: { design: state.design.design, ...shown, time: new Date().toLocaleTimeString() }, comparison: undefined, comparisonProblem: "" });
}

export function forgetMark() {
  set({ mark: undefined, comparison: undefined, comparisonProblem: "" });
}

// Loads the marked design again, since the server keeps only few designs.
async function remake(mark: Mark): Promise<Mark> {
  if (mark.file.endsWith(".py")) throw new Error("the server has forgotten the marked version: mark another one");
  const { file, text, definitions, rotate } = mark;
  const reply = await connection.ask("load", { file, text, definitions, rotate }, "mark").answer;
  if (!reply.ok) throw new Error("the marked version can no longer be made; files that it reads have changed");
  const made = { ...mark, design: reply.design as string };
  if (state.mark === mark) set({ mark: made });
  return made;
}

async function compareWith(mark: Mark, design: string) {
  const reply = (await connection.ask("compare", { before: mark.design, design }, "compare").answer) as any;
  if (state.mark === mark) set({ comparison: { design, mark, ...reply } });
}

export async function compare() {
  const { mark, design } = state;
  if (!mark || !design) return;
  set({ comparisonProblem: "" });
  try {
    await compareWith(mark, design.design).catch(async (error) => {
      if ((error as Refused).code !== "gone") throw error;
      await compareWith(await remake(mark), design.design);
    });
  } catch (error) {
    if (!(error as Refused).isCancelled) set({ comparisonProblem: (error as Error).message });
  }
}

export async function probe(at: number[]) {
  try {
    const probe = (await about("probe", { at, ...state.options }, "probe")) as any;
    set({ probe, probeBefore: state.probe?.at });
  } catch {
    // The next probe reports more.
  }
}

function takeJob(job: Job) {
  set({ jobs: [...state.jobs.filter((known) => known.id !== job.id && known.path !== job.path), job] });
  dispatchEvent(new Event("jobs"));
}

// Takes a job that was just started. News of it may have come before.
export function noteJob(job: Job) {
  if (state.jobs.some((known) => known.id === job.id)) dispatchEvent(new Event("jobs"));
  else takeJob(job);
}

export async function startExport(folder: string, replace: boolean): Promise<string> {
  try {
    const reply = await about("export", { folder, file: state.file, replace, ...state.options }, "");
    noteJob(reply.job);
    return "";
  } catch (error) {
    return (error as Error).message;
  }
}

// Starts a job of any kind. Returns a message if that fails.
export async function startKind(kind: string, options: JobOptions, replace: boolean): Promise<string> {
  try {
    const given = Object.fromEntries(Object.entries(options).filter(([, value]) => value !== "" && value !== false));
    noteJob((await about("run", { kind, file: state.file, options: given, replace }, "")).job);
    return "";
  } catch (error) {
    return (error as Error).message;
  }
}

export async function changeJob(job: Job, to: "pause" | "resume" | "cancel") {
  await connection.ask("change_export", { job: job.id, to }).answer.catch((error) => set({ notice: (error as Error).message }));
}

export const reveal = (from: number, to: number) => editor?.reveal(from, to);
export const insert = (text: string) => {
  const end = editor!.text().length;
  editor!.write(end, end, `\n${text}\n`);
};
