// Files that the browser gets from people and gives to them.
import { connection, listFiles, openFile, save } from "./session";
import { set, state } from "./store";

export function download(name: string, content: Blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

// The name of the open file, without its folder and its ending.
export const stem = () => state.file.split("/").pop()!.replace(/\.[^.]*$/, "") || "design";

const report = (problem: string) => set({ problem });

export async function downloadBundle() {
  await save();
  try {
    const reply = await connection.ask("bundle", { file: state.file }, "bundle").answer;
    download(`${stem()}.ombre`, new Blob([reply.bytes as BlobPart], { type: "application/zip" }));
    report(reply.left_outside.length > 0 ? `The bundle lacks ${reply.left_outside.join(", ")}, which belong to the system.` : "");
  } catch (error) {
    report((error as Error).message);
  }
}

const mostBundleBytes = 11 << 20; // as text in a request it becomes a third larger

function base64(bytes: Uint8Array): string {
  let text = "";
  for (let at = 0; at < bytes.length; at += 8192) text += String.fromCharCode(...bytes.subarray(at, at + 8192));
  return btoa(text);
}

export async function openBundle(file: File) {
  if (!file.name.endsWith(".ombre")) return report(`${file.name} is no bundle: expected a file that ends in .ombre`);
  if (file.size > mostBundleBytes) return report(`${file.name} is too large to come in by the page; copy it here, and write: ombre studio ${file.name}`);
  try {
    const bytes = base64(new Uint8Array(await file.arrayBuffer()));
    const reply = await connection.ask("unbundle", { name: file.name, bytes }).answer;
    await listFiles();
    await openFile(reply.file);
  } catch (error) {
    report((error as Error).message);
  }
}

export async function listExamples(): Promise<{ name: string; sentence: string }[]> {
  return (await connection.ask("examples").answer.catch(() => ({ examples: [] })) as any).examples;
}

// Opens a copy in the folder, with the files that it reads.
export async function openExample(name: string) {
  try {
    const reply = await connection.ask("open_example", { name }).answer;
    await listFiles();
    await openFile(reply.file);
    set({ panel: "variables" });
  } catch (error) {
    report((error as Error).message);
  }
}

export function takeDroppedFiles() {
  const isOfFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files");
  addEventListener("dragover", (event) => isOfFiles(event) && event.preventDefault());
  addEventListener("drop", (event) => {
    if (!isOfFiles(event)) return;
    event.preventDefault();
    const file = event.dataTransfer!.files[0];
    if (file) openBundle(file);
  });
}
