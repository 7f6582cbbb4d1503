// The text of the open file, as the parts beside the editor see it.

// The part of the editor that other parts of the page need.
export interface Editor {
  text(): string;
  replace(text: string): void;
  write(from: number, to: number, text: string): void;
  // Makes steps of replacements, each of the text that the one before has made, as one step for undo.
  apply(steps: { from: number; to: number; insert: string }[][], isTyping: boolean): void;
  undo(): void;
  redo(): void;
  reveal(from: number, to: number): void;
  setDiagnostics(): void;
  rename(from: string, to: string): void; // what is kept of a file belongs to its new name
}

export let editor: Editor | undefined;

export function setEditor(made: Editor) {
  editor = made;
}

export const reveal = (from: number, to: number) => editor?.reveal(from, to);

// Writes a call at the end of the script, and names the library of an operator at its begin.
export const insert = (text: string, library?: string) => {
  const use = `use <${library}>`;
  if (library && !editor!.text().includes(use)) editor!.write(0, 0, `${use}\n`);
  const end = editor!.text().length;
  editor!.write(end, end, `\n${text}\n`);
};
