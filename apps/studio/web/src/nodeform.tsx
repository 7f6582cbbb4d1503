// A form of a node's parameters, which writes a call of the node into the script.
import { useEffect, useState } from "preact/hooks";
import { connection } from "./session/connection";
import { insert } from "./session/script";
import { NodeType, state, useStore } from "./store";

type Parameter = NodeType["parameters"][0];
type Texts = Record<string, string>; // what is typed, by the names of parameters

const quoted = (text: string) => JSON.stringify(text);
// A material is a name, or a mixture as a script writes it.
const material = (text: string) => (/^[A-Za-z_]\w*$/.test(text) ? quoted(text) : text);
const written: Record<string, (text: string) => string> = { text: quoted, choice: quoted, file: quoted, material };

// Returns the call that a script has for the values.
function callOf(node: NodeType, texts: Texts): string {
  const given = node.parameters.filter((p) => texts[p.name]?.trim()).map((p) => `${p.name} = ${(written[p.widget] ?? String)(texts[p.name].trim())}`);
  const call = `${node.name}(${given.join(", ")})`;
  if (node.gives !== "solid") return `${node.name}_values = ${call};`;
  return node.inputs.most === 0 ? `${call};` : `${call} {\n}`;
}

// Asks for the files beside the design that a node may read.
function useFiles(isWanted: boolean): string[] {
  const [files, setFiles] = useState<string[]>([]);
  useEffect(() => {
    if (!isWanted || !state.file) return;
    connection.ask("files_ending_in", { file: state.file, endings: state.hello!.endings }).answer.then((reply) => setFiles(reply.files as string[]), () => {});
  }, [isWanted]);
  return files;
}

function Select({ words, value, change }: { words: string[]; value: string; change: (next: string) => void }) {
  return (
    <select value={value} onChange={(e) => change(e.currentTarget.value)}>
      <option value=""></option>
      {words.map((word) => <option value={word}>{word}</option>)}
    </select>
  );
}

// The control for a kind of value; `words` are suggested for it.
function Widget({ id, p, words, value, change }: { id: string; p: Parameter; words: string[]; value: string; change: (next: string) => void }) {
  const usual = p.default === null || p.default === undefined ? "" : typeof p.default === "string" ? p.default : JSON.stringify(p.default);
  if (p.widget === "choice") return <Select words={p.choices} value={value} change={change} />;
  if (p.widget === "boolean") return <Select words={["true", "false"]} value={value} change={change} />;
  const list = words.length > 0 ? id : undefined;
  return (
    <>
      <input type={p.widget === "number" ? "number" : "text"} step="any" list={list} value={value} placeholder={usual} required={p.required}
             onInput={(e) => change(e.currentTarget.value)} />
      {list && <datalist id={list}>{words.map((word) => <option value={word} />)}</datalist>}
    </>
  );
}

export function NodeForm({ node }: { node: NodeType }) {
  const { design, file, kind } = useStore();
  const [texts, setTexts] = useState<Texts>({});
  const files = useFiles(node.parameters.some((p) => p.widget === "file"));
  const suggested: Record<string, string[]> = { file: files, material: (design?.materials ?? []).map((m) => m.name) };
  const change = (name: string, next: string) => {
    const others = Object.entries(texts).filter(([other]) => other !== name);
    setTexts(Object.fromEntries(next === "" ? others : [...others, [name, next]]));
  };
  return (
    <form class="nodeform" onSubmit={(e) => {
      e.preventDefault();
      insert(callOf(node, texts), node.library);
    }}>
      {node.parameters.map((p) => (
        <label class="option" title={p.doc}>
          <span>{p.name}{p.unit && ` (${p.unit})`}{p.required ? " *" : ""}</span>
          <Widget id={`words-of-${node.name}-${p.name}`} p={p} words={suggested[p.widget] ?? []} value={texts[p.name] ?? ""} change={(next) => change(p.name, next)} />
        </label>
      ))}
      <button type="submit" disabled={!file || kind !== ""}>Add to the script</button>
    </form>
  );
}
