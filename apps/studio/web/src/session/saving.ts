// Saves what is typed, and keeps drafts of what cannot be saved. Texts of others on the disk are never overwritten unasked.
import { dropDraft, keepDraft, takeEarlyText } from "../kept";
import { set, state } from "../store";
import { Reply, connection } from "./connection";
import { evaluate, showData } from "./evaluation";
import { freeName, keepLastFile, listFiles } from "./folder";
import { editor } from "./script";

export let version = ""; // the version of the text that was opened or saved last
export let savedText = "";
let sentText: string | undefined; // the text of a save whose answer may have been lost
let ownTexts: string[] = []; // the texts that this window saved last
const mostOwnTexts = 8;
let saving: Promise<void> = Promise.resolve();
let usesCrlf = false;
export let isNew = false; // the open file is not on the disk yet

function fromDisk(text: string): string {
  usesCrlf = text.includes("\r\n");
  return text.replaceAll("\r\n", "\n");
}

// Begins with a file as it is on the disk; without a version it is not there yet.
export function beginWith(disk: Reply, isDesign: boolean) {
  version = disk.version;
  savedText = fromDisk(disk.text);
  sentText = undefined;
  ownTexts = [];
  isNew = isDesign && version === "";
}

// Begins with a file that is not on the disk, for a text that was typed before a file was open.
export function beginNewFile(name: string) {
  version = savedText = "";
  isNew = true;
  set({ file: name, kind: "" });
  keepLastFile(name);
}

// Begins with no file.
export function beginWithNothing() {
  version = savedText = "";
}

export function isDirty(): boolean {
  return editor !== undefined && state.file !== "" && state.kind === "" && (isNew || editor.text() !== savedText);
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
  editor!.rename("", file);
  beginNewFile(file);
}

// Text that was typed before the server answered becomes a new file.
export async function adoptEarlyText(): Promise<boolean> {
  const early = takeEarlyText();
  const typed = isNew ? editor!.text() : "";
  const text = typed || early;
  if (!text) return false;
  const name = freeName("untitled");
  if (isNew) editor!.rename(state.file, name);
  beginNewFile(name);
  if (!typed) editor!.replace(text);
  keepDraft(name, text, "");
  await save();
  evaluate();
  return true;
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

// Waits for the save that is under way; none begins after it.
export async function endSaving() {
  clearTimeout(saveTimer);
  await saving;
}

// The text is not written again, though it is not what the file holds.
export function countAsSaved() {
  savedText = editor!.text();
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

export function takeFromDisk(disk: Reply) {
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

// Takes the news that somebody else has changed a file of the design.
export async function hearChange(file: string, changed: string) {
  await saving;
  if (file !== state.file) return evaluate(100);
  if (changed === version) return;
  if (changed === "" && state.kind === "") return set({ conflict: {}, saved: "unsaved" });
  const disk = await connection.ask("open", { file }).answer;
  if (disk.version === version) return;
  if (state.kind !== "") {
    version = disk.version;
    return showData(disk);
  }
  takeFromDisk(disk);
  evaluate();
}
