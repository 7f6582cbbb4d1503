// The text of the open file, as the parts beside the editor see it.

// How undo counts an edit: alone, with others that follow soon at the same place, or always with the edit before it.
export type EditEvent = "input" | "input.type" | "input.type.compose";

// The part of the editor that other parts of the page need.
export interface Editor {
  text(): string;
  replace(text: string): void;
  write(from: number, to: number, text: string): void;
  // Makes steps of replacements, each of the text that the one before has made, as one step for undo.
  apply(steps: { from: number; to: number; insert: string }[][], event: EditEvent): void;
  undo(): void;
  redo(): void;
  reveal(from: number, to: number): void;
  caret(): number;
  putCaret(at: number): void; // leaves the focus where it is
  setDiagnostics(): void;
  rename(from: string, to: string): void; // what is kept of a file belongs to its new name
}

export let editor: Editor | undefined;

export function setEditor(made: Editor) {
  editor = made;
}

// Functions that are called when the caret moves, for example by the handles of the call where it stands.
const followers = new Set<() => void>();

export function followCaret(follower: () => void): () => void {
  followers.add(follower);
  return () => followers.delete(follower);
}

export function caretMoved() {
  for (const follower of [...followers]) follower();
}

export const reveal = (from: number, to: number) => editor?.reveal(from, to);

// Writes a call at the end of the script, and names the library of an operator at its begin.
export const insert = (text: string, library?: string) => {
  const use = `use <${library}>`;
  if (library && !editor!.text().includes(use)) editor!.write(0, 0, `${use}\n`);
  const end = editor!.text().length;
  editor!.write(end, end, `\n${text}\n`);
};
