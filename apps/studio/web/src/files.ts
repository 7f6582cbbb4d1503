// Files that the browser gets from people and gives to them.
import { ask } from "./asking";
import { linkToHere } from "./links";
import { Refused, connection } from "./session/connection";
import { deleteOpenFile, newFile, openFile, renameOpenFile } from "./session/documents";
import { about } from "./session/evaluation";
import { noteJob } from "./session/exports";
import { listFiles } from "./session/folder";
import { save } from "./session/saving";
import { Job, set, state } from "./store";

export function download(name: string, content: Blob) {
  const address = URL.createObjectURL(content);
  fetchAs(name, address);
  setTimeout(() => URL.revokeObjectURL(address), 60000);
}

function fetchAs(name: string, address: string) {
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
}

// The name of the open file, without its folder and its ending.
export const stem = () => state.file.split("/").pop()!.replace(/\.[^.]*$/, "") || "design";

const report = (notice: string) => set({ notice });

// Does something and shows what went wrong.
async function tried<T>(work: () => Promise<T>): Promise<T | undefined> {
  try {
    return await work();
  } catch (error) {
    if (!(error as Refused).isCancelled) report((error as Error).message);
    return undefined;
  }
}

export async function downloadBundle() {
  await save();
  await tried(async () => {
    const reply = await connection.ask("bundle", { file: state.file }, "bundle").answer;
    download(`${stem()}.ombre`, new Blob([reply.bytes as BlobPart], { type: "application/zip" }));
    report(reply.left_outside.length > 0 ? `The bundle lacks ${reply.left_outside.join(", ")}, which belong to the system.` : "");
  });
}

// Downloads a file that a job has written, or a folder as a zip archive.
export async function downloadJob(job: Job) {
  await tried(async () => {
    const reply = await connection.ask("download", { job: job.id }).answer.catch((error: Refused) => {
      if (error.code !== "gone") throw error;
      return connection.ask("zip", { job: job.id }, `zip ${job.id}`).answer;
    });
    fetchAs(reply.name, reply.address);
  });
  set({ transfer: undefined });
}

const wanted = new Set<number>(); // jobs whose output is downloaded when they are done

// Makes a mesh of the design, which the browser fetches when it is done.
export async function downloadMesh(ending: string) {
  await tried(async () => {
    const options = { output: stem() + ending };
    const { job } = await about("run", { kind: "mesh", file: state.file, options, download: true }, "");
    wanted.add(job.id);
    noteJob(job);
  });
}

// Follows jobs that make downloads.
export function watchDownloads() {
  addEventListener("jobs", () => {
    for (const job of state.jobs.filter((known) => wanted.has(known.id))) {
      if (job.state === "working") set({ transfer: { name: job.folder, share: job.total > 0 ? job.done / job.total : 0 } });
      if (["working", "waiting", "paused"].includes(job.state)) continue;
      wanted.delete(job.id);
      set({ transfer: undefined });
      if (job.state === "done") downloadJob(job);
      else if (job.state === "failed") report(job.message);
    }
  });
}

const mostBundleBytes = 11 << 20; // as text in a request it becomes a third larger

function base64(bytes: Uint8Array): string {
  let text = "";
  for (let at = 0; at < bytes.length; at += 8192) text += String.fromCharCode(...bytes.subarray(at, at + 8192));
  return btoa(text);
}

async function openBundle(file: File) {
  if (file.size > mostBundleBytes) return report(`${file.name} is too large to come in by the page; copy it here, and write: ombre studio ${file.name}`);
  await tried(async () => {
    const bytes = base64(new Uint8Array(await file.arrayBuffer()));
    const reply = await connection.ask("unbundle", { name: file.name, bytes }).answer;
    await listFiles();
    await openFile(reply.file);
  });
}

export async function listExamples(): Promise<{ name: string; sentence: string }[]> {
  return (await connection.ask("examples").answer.catch(() => ({ examples: [] })) as any).examples;
}

// Opens a copy in the folder, with the files that it reads.
export async function openExample(name: string) {
  await tried(async () => {
    const reply = await connection.ask("open_example", { name }).answer;
    await listFiles();
    await openFile(reply.file);
    set({ panel: "variables" });
  });
}

// A file that comes in, with its name in the folder: "part.stl", or "scan/0001.dcm" of a folder.
interface Incoming {
  name: string;
  file: File;
}

const designEndings = [".vcad", ".scad", ".py", ".json"];
const isDesign = (name: string) => designEndings.some((ending) => name.toLowerCase().endsWith(ending));
const isRead = (name: string) => (state.hello?.endings ?? []).some((ending) => name.toLowerCase().endsWith(ending));
export const openableEndings = () => [...new Set([...designEndings, ".ombre", ...(state.hello?.endings ?? [])])];

const pieceBytes = 4 << 20;
let uploads = 0;

async function upload({ name, file }: Incoming, replace: boolean, sent: (bytes: number) => void) {
  const upload = `${Date.now().toString(36)}x${++uploads}`;
  for (let at = 0; at === 0 || at < file.size; at += pieceBytes) {
    const bytes = new Uint8Array(await file.slice(at, at + pieceBytes).arrayBuffer());
    await connection.ask("upload", { upload, file: name, at, bytes: base64(bytes), last: at + pieceBytes >= file.size, replace }).answer;
    sent(bytes.length);
  }
}

// Gives files, or the folder in which they are, a name that is free.
async function renamed(files: Incoming[]): Promise<Incoming[]> {
  for (let n = 2; ; ++n) {
    const made = files.map(({ name, file }) => ({ file, name: name.includes("/") ? name.replace("/", `_${n}/`) : name.replace(/((\.nii)?\.[^.]*)?$/, (ending) => `_${n}${ending}`) }));
    const { files: taken } = await connection.ask("is_there", { files: made.map((f) => f.name) }).answer;
    if (taken.length === 0) return made;
  }
}

// Puts files into the folder, and opens what they are: a design as it is, anything else by a new design that imports it.
async function takeIn(files: Incoming[]) {
  const { files: taken } = await connection.ask("is_there", { files: files.map((f) => f.name) }).answer;
  let replace = false;
  if (taken.length > 0) {
    const more = taken.length > 1 ? ` and ${taken.length - 1} more` : "";
    const chosen = await ask({ title: `${taken[0]}${more} ${more ? "are" : "is"} there already`, text: "Keep what is there and give the new one another name, or replace what is there?", buttons: ["Keep both", "Replace"] });
    if (!chosen) return;
    replace = chosen.button === "Replace";
    if (!replace) files = await renamed(files);
  }
  const all = files.reduce((sum, { file }) => sum + file.size, 1);
  let done = 0;
  try {
    for (const one of files) await upload(one, replace, (bytes) => set({ transfer: { name: one.name, share: (done += bytes) / all } }));
  } finally {
    set({ transfer: undefined });
  }
  await listFiles();
  await openBest(files.map((f) => f.name));
}

async function openBest(names: string[]) {
  const slices = names.find((name) => name.toLowerCase().endsWith(".dcm"));
  const chosen = names.find(isDesign) ?? (slices?.includes("/") ? slices.slice(0, slices.lastIndexOf("/")) : undefined) ?? names.find(isRead);
  if (!chosen) return;
  if (isDesign(chosen) || chosen.endsWith(".csv")) return openFile(chosen);
  const reply = await connection.ask("import", { file: chosen }).answer;
  await listFiles();
  await openFile(reply.file);
}

const mostFiles = 5000;

export async function openIncoming(files: Incoming[]) {
  if (files.length === 1 && files[0].name.endsWith(".ombre")) return openBundle(files[0].file);
  if (files.length === 0) return report("There is no file in it.");
  if (files.length > mostFiles) return report(`These are more than ${mostFiles} files; copy them into ${state.hello?.folder}.`);
  if (!files.some(({ name }) => isDesign(name) || isRead(name)))
    return report(`${files[0].name} is no file that designs read: expected one that ends in ${openableEndings().join(", ")}`);
  report("");
  await tried(() => takeIn(files));
}

const isHidden = (path: string) => path.split("/").some((part) => part.startsWith("."));

// Lists the files of an entry that was dropped, with those of its folders.
async function filesIn(entry: FileSystemEntry): Promise<Incoming[]> {
  const name = entry.fullPath.replace(/^\//, "");
  if (isHidden(name)) return [];
  if (entry.isFile) return [{ name, file: await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject)) }];
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  const found: Incoming[] = [];
  for (;;) {
    const entries = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject)); // some at a time
    if (entries.length === 0 || found.length > mostFiles) return found;
    for (const inner of entries) found.push(...(await filesIn(inner)));
  }
}

// Opens files that a person has chosen. Those of a folder have its name before them.
export async function openChosen(input: HTMLInputElement) {
  const files = [...(input.files ?? [])].map((file) => ({ name: file.webkitRelativePath || file.name, file }));
  input.value = "";
  if (files.length > 0) await openIncoming(files.filter(({ name }) => !isHidden(name)));
}

export function takeDroppedFiles() {
  const isOfFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files");
  addEventListener("dragover", (event) => isOfFiles(event) && event.preventDefault());
  addEventListener("drop", async (event) => {
    if (!isOfFiles(event)) return;
    event.preventDefault();
    // The entries have to be taken before the event is over.
    const items = [...event.dataTransfer!.items].filter((item) => item.kind === "file");
    const taken = items.map((item) => ({ entry: item.webkitGetAsEntry(), file: item.getAsFile() }));
    const files: Incoming[] = [];
    for (const { entry, file } of taken) {
      if (entry) files.push(...(await filesIn(entry).catch(() => [])));
      else if (file) files.push({ name: file.name, file });
    }
    openIncoming(files);
  });
}

const withEnding = (name: string) => (/\.[^./]+$/.test(name) ? name : name + state.file.replace(/^.*?((\.nii)?\.[^./]*)$/, "$1"));

export async function makeDesign() {
  const chosen = await ask({ title: "New design", name: "part.vcad", buttons: ["Make"] });
  if (chosen) await tried(() => newFile(chosen.name));
}

export async function renameDesign() {
  const chosen = await ask({ title: `Rename ${state.file}`, name: state.file, buttons: ["Rename"] });
  if (chosen && chosen.name !== state.file) await tried(() => renameOpenFile(withEnding(chosen.name)));
}

export async function duplicateDesign() {
  const copy = state.file.replace(/((\.nii)?\.[^./]*)$/, "_copy$1");
  const chosen = await ask({ title: `Duplicate ${state.file}`, name: copy, buttons: ["Duplicate"] });
  if (!chosen) return;
  await tried(async () => {
    const to = withEnding(chosen.name);
    await save();
    await connection.ask("duplicate", { file: state.file, to }).answer;
    await listFiles();
    await openFile(to);
  });
}

export async function deleteDesign() {
  const chosen = await ask({ title: `Delete ${state.file}?`, text: "It is moved into the folder .ombre-trash beside the designs.", buttons: ["Delete"] });
  if (chosen) await tried(async () => report(`The file is now ${await deleteOpenFile()}`));
}

export async function newFolder() {
  const chosen = await ask({ title: "New folder", name: "parts", text: "A design is put into it by its name: parts/knob.vcad", buttons: ["Make"] });
  if (chosen) await tried(() => connection.ask("make_folder", { name: chosen.name }).answer);
}

export async function copyLink() {
  const link = linkToHere();
  await navigator.clipboard.writeText(link).then(() => report(""), () => report(link));
}
