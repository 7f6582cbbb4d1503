// The browser keeps of this page: texts for the time when the server is away, and how each file was seen.
import { State, state, subscribe } from "./store";

export interface Draft {
  text: string;
  version: string; // of the file that the text was typed into; empty for a new one
  time: number; // seconds since 1970
}

const folder = () => state.hello?.folder ?? "";
const draftKey = (file: string) => `ombre:draft:${folder()}:${file}`;
const viewKey = (file: string) => `ombre:view:${folder()}:${file}`;

// The browser may refuse, for example when its space is full; the server has the draft as well.
function put(key: string, value: unknown) {
  try {
    localStorage.setItem(key, JSON.stringify(value));
  } catch {
    localStorage.removeItem(key);
  }
}

function take(key: string): any {
  try {
    return JSON.parse(localStorage.getItem(key) ?? "null");
  } catch {
    return null;
  }
}

export const keepDraft = (file: string, text: string, version: string) => put(draftKey(file), { text, version, time: Date.now() / 1000 });
export const dropDraft = (file: string) => localStorage.removeItem(draftKey(file));
export const keptDraft = (file: string): Draft | null => take(draftKey(file));

// Names the files of this folder that have a draft.
export function keptDrafts(): string[] {
  const before = draftKey("");
  return Object.keys(localStorage).filter((key) => folder() !== "" && key.startsWith(before)).map((key) => key.slice(before.length));
}

// Returns the text that was typed before the server had said which folder it shows, and forgets it.
export function takeEarlyText(): string {
  const found = Object.keys(localStorage).find((key) => key.startsWith("ombre:draft::"));
  const text = found ? take(found)?.text : "";
  if (found) localStorage.removeItem(found);
  return text ?? "";
}

// How a file is seen: values of sliders, camera, cut and so on.
const viewParts = ["values", "camera", "cut", "by", "palette", "range", "rotate", "z", "opacity", "preset"] as const;
export type View = Partial<Pick<State, (typeof viewParts)[number]>>;

export const viewOf = (from: State): View => Object.fromEntries(viewParts.map((part) => [part, from[part]]).filter(([, value]) => value !== undefined && !Number.isNaN(value)));
export const keptView = (file: string): View => take(viewKey(file)) ?? {};

let timer = 0;
let last = state;

// Keeps how the file was seen, if that is still to be done.
function keepView(seen: State) {
  if (timer === 0) return;
  clearTimeout(timer);
  timer = 0;
  if (seen.file && seen.hello) put(viewKey(seen.file), viewOf(seen));
}

// Keeps the view of the open file whenever a person changes it.
export function watchView() {
  subscribe(() => {
    const before = last;
    last = state;
    if (before.file !== state.file) return keepView(before);
    if (viewParts.every((part) => before[part] === state[part])) return;
    clearTimeout(timer);
    timer = window.setTimeout(() => keepView(state), 300);
  });
  addEventListener("pagehide", () => keepView(state));
}

export function renameKept(from: string, to: string) {
  for (const key of [draftKey, viewKey]) {
    const value = localStorage.getItem(key(from));
    localStorage.removeItem(key(from));
    if (value !== null) localStorage.setItem(key(to), value);
  }
}
