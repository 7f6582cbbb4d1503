// The editor of a design's text, with its mistakes.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab, redo, undo, undoDepth } from "@codemirror/commands";
import { pythonLanguage } from "@codemirror/lang-python";
import { bracketMatching, indentOnInput, indentUnit, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, lintKeymap, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { Annotation, EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, keymap, lineNumbers } from "@codemirror/view";
import { classHighlighter } from "@lezer/highlight";
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { formatted } from "./format";
import { complete, hover, vcad } from "./language";
import { keepAsDesign, newFile } from "./session/documents";
import { freeName } from "./session/folder";
import { edited, save, settle } from "./session/saving";
import { caretMoved, reveal, setEditor } from "./session/script";
import { Diagnostic, set, state, useStore } from "./store";

const fromElsewhere = Annotation.define<boolean>();

function shown(diagnostic: Diagnostic, length: number) {
  const from = Math.min(diagnostic.from ?? 0, length);
  const to = Math.min(Math.max(diagnostic.to ?? from, from), length);
  return {
    from,
    to,
    severity: diagnostic.severity === "note" ? ("info" as const) : diagnostic.severity,
    message: diagnostic.hint ? `${diagnostic.message}; ${diagnostic.hint}` : diagnostic.message,
  };
}

const isPython = () => state.file.toLowerCase().endsWith(".py");

// Indents the lines, as one step for undo. Python is left alone, since its indentation has a meaning.
function format(view: EditorView): boolean {
  if (state.kind !== "" || isPython()) return false;
  const text = view.state.doc.toString(), wanted = formatted(text);
  if (wanted === text) return true;
  const row = view.state.doc.lineAt(view.state.selection.main.head).number;
  view.dispatch({ changes: { from: 0, to: text.length, insert: wanted } });
  const line = view.state.doc.line(Math.min(row, view.state.doc.lines));
  view.dispatch({ selection: { anchor: line.to }, scrollIntoView: true });
  return true;
}

function makeEditor(parent: HTMLElement): EditorView {
  const extensions = [
    lineNumbers(),
    highlightActiveLine(),
    highlightActiveLineGutter(),
    history(),
    drawSelection(),
    indentOnInput(),
    indentUnit.of("  "),
    bracketMatching(),
    closeBrackets(),
    highlightSelectionMatches(),
    syntaxHighlighting(classHighlighter),
    lintGutter(),
    EditorView.lineWrapping,
    hover,
    autocompletion({ override: [complete] }),
    EditorView.contentAttributes.of({ "aria-label": "Script of the design", tabindex: "0" }),
    keymap.of([
      { key: "Mod-s", run: () => (save(), true), preventDefault: true },
      { key: "Shift-Alt-f", run: format, preventDefault: true },
      ...closeBracketsKeymap,
      ...completionKeymap,
      ...lintKeymap,
      ...searchKeymap,
      ...historyKeymap,
      ...defaultKeymap,
      indentWithTab,
    ]),
    EditorView.updateListener.of((update) => {
      if (update.docChanged && !update.transactions.some((t) => t.annotation(fromElsewhere))) edited();
      if (update.docChanged || update.selectionSet) caretMoved();
    }),
  ];
  // The states of other files, so that undo goes on where it was when a person comes back to a file.
  const others = new Map<string, EditorState>();
  const mostOthers = 40;
  const leave = (file: string) => {
    if (!file || view.state.readOnly) return;
    others.delete(file);
    others.set(file, view.state);
    if (others.size > mostOthers) others.delete(others.keys().next().value!);
  };
  const change = (text: string) => {
    const head = Math.min(view.state.selection.main.head, text.length);
    view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text }, selection: { anchor: head }, annotations: fromElsewhere.of(true) });
  };
  const extended = () => [...extensions, isPython() ? pythonLanguage : vcad, EditorState.readOnly.of(state.kind !== "")];
  const view: EditorView = new EditorView({ parent, state: EditorState.create({ extensions: extended() }) });
  setEditor({
    text: () => view.state.doc.toString(),
    replace(text) {
      const before = view.dom.dataset.file ?? "";
      if (before === state.file) {
        const isUntouched = view.state.doc.length === 0 && undoDepth(view.state) === 0;
        if (isUntouched) view.setState(EditorState.create({ doc: text, extensions: extended() }));
        else change(text);
        return;
      }
      leave(before);
      view.dom.dataset.file = state.file;
      const known = state.kind === "" ? others.get(state.file) : undefined;
      others.delete(state.file);
      view.setState(known ?? EditorState.create({ doc: text, extensions: extended() }));
      if (view.state.doc.toString() !== text) change(text);
    },
    rename(from, to) {
      const known = others.get(from);
      others.delete(from);
      if (known) others.set(to, known);
      if ((view.dom.dataset.file ?? "") === from) view.dom.dataset.file = to;
    },
    write: (from, to, insert) => view.dispatch({ changes: { from, to, insert } }),
    apply: (steps, event) => view.dispatch(...steps.map((changes) => ({ changes, sequential: true, userEvent: event }))),
    undo: () => undo(view),
    redo: () => redo(view),
    reveal(from, to) {
      const [anchor, head] = [from, to].map((at) => Math.min(at, view.state.doc.length)); // the text may be shorter by now
      view.dispatch({ selection: { anchor, head }, effects: EditorView.scrollIntoView(anchor, { y: "center" }) });
      view.focus();
    },
    caret: () => view.state.selection.main.head,
    putCaret: (at) => view.dispatch({ selection: { anchor: Math.min(at, view.state.doc.length) }, effects: EditorView.scrollIntoView(Math.min(at, view.state.doc.length)) }),
    setDiagnostics: () => {
      const own = state.diagnostics.filter((d) => d.from !== undefined || !d.line);
      view.dispatch(setDiagnostics(view.state, own.map((d) => shown(d, view.state.doc.length))));
    },
  });
  return view;
}

function Conflict() {
  const { conflict, file } = useStore();
  if (!conflict) return null;
  const isGone = conflict.text === undefined;
  return (
    <div class="bar warning" role="alert">
      <span>{isGone ? `${file} was deleted on the disk.` : `${file} was changed on the disk, and here as well.`}</span>
      <button onClick={() => settle(true)}>{isGone ? "Write it again" : "Keep what is here"}</button>
      {!isGone && <button onClick={() => settle(false)}>Take what is on the disk</button>}
    </div>
  );
}

// A bar above scans and results, whose script nobody wrote.
function DataBar() {
  const { kind, file } = useStore();
  const [problem, setProblem] = useState("");
  if (kind === "") return null;
  return (
    <div class="bar">
      <span>{kind === "table" ? `The table ${file}` : `A script that shows ${file}`}</span>
      {kind !== "table" && <button onClick={async () => setProblem(await keepAsDesign())}>Keep it as a design</button>}
      {problem && <span class="error" role="alert">{problem}</span>}
    </div>
  );
}

function Problems() {
  const { diagnostics, problem, notice, echo, saveProblem } = useStore();
  return (
    <section class="problems" aria-label="Problems" aria-live="polite" data-errors={diagnostics.filter((d) => d.severity === "error").length}>
      {saveProblem && <p class="error">Not saved: {saveProblem}</p>}
      {problem && <p class="error">{problem}</p>}
      {notice && <p class="error">{notice}</p>}
      <ul>
        {diagnostics.map((d) => (
          <li class={d.severity}>
            <button disabled={d.from === undefined} onClick={() => reveal(d.from!, d.to ?? d.from!)}>
              <span class="place">{d.line ? `${d.from === undefined ? `${d.file?.split("/").pop()}:` : ""}${d.line}:${d.column}` : d.severity}</span>
              {d.message}
              {d.hint && <em>; {d.hint}</em>}
            </button>
          </li>
        ))}
      </ul>
      {echo.length > 0 && <pre class="echo">{echo.join("\n")}</pre>}
    </section>
  );
}

// Offers a start in a folder without designs.
function Welcome() {
  const { status, hasBegun, files, file } = useStore();
  if (status !== "open" || !hasBegun || file) return null;
  return (
    <div class="bar">
      <span>{files.length > 0 ? "Choose a design above, or make a new one." : "There is no design in this folder yet."}</span>
      <button class="main" onClick={() => newFile(freeName("part")).then(() => set({ panel: "variables" }))}>Begin with a ball</button>
      <button onClick={() => set({ panel: "examples" })}>See examples</button>
    </div>
  );
}

export function EditorPane() {
  const host = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const view = makeEditor(host.current!);
    return () => view.destroy();
  }, []);
  return (
    <section class="editor" aria-label="Editor">
      <Welcome />
      <Conflict />
      <DataBar />
      <div class="code" ref={host} />
      <Problems />
    </section>
  );
}
