// The script language in the editor: colours, completion and help, from the server's lists of nodes and functions.
import { CompletionContext, CompletionResult, snippetCompletion, Completion } from "@codemirror/autocomplete";
import { LanguageSupport, StreamLanguage, StreamParser } from "@codemirror/language";
import { EditorView, hoverTooltip } from "@codemirror/view";
import { NodeType, state } from "./store";

const keywords = new Set(["if", "else", "for", "let", "module", "function", "include", "use", "each", "assert", "echo", "children"]);
const constants = new Set(["true", "false", "undef", "PI"]);

export const fold = (name: string) => name.toLowerCase().replaceAll(/[-_]/g, "");

export function nodeCalled(name: string): NodeType | undefined {
  return state.hello?.nodes.find((node) => fold(node.name) === fold(name));
}
const functionCalled = (name: string) => state.hello?.functions.find((f) => f.name === name);

interface Reading {
  inComment: boolean;
  inString: boolean;
}

const parser: StreamParser<Reading> = {
  startState: () => ({ inComment: false, inString: false }),
  token(stream, reading) {
    if (reading.inComment) {
      if (stream.skipTo("*/")) {
        stream.match("*/");
        reading.inComment = false;
      } else stream.skipToEnd();
      return "comment";
    }
    if (reading.inString) return string(stream, reading);
    if (stream.eatSpace()) return null;
    if (stream.match("//")) {
      stream.skipToEnd();
      return "comment";
    }
    if (stream.match("/*")) {
      reading.inComment = true;
      return "comment";
    }
    if (stream.eat('"')) {
      reading.inString = true;
      return string(stream, reading);
    }
    if (stream.match(/^(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?/)) return "number";
    const name = stream.match(/^\$?[A-Za-z_][A-Za-z0-9_]*/) as RegExpMatchArray | null;
    if (name) return kind(name[0], stream.string.slice(stream.pos));
    if (stream.match(/^[-+*/%^<>=!&|?:#]/)) return "operator";
    stream.next();
    return null;
  },
  languageData: { commentTokens: { line: "//", block: { open: "/*", close: "*/" } }, closeBrackets: { brackets: ["(", "[", "{", '"'] } },
};

function string(stream: any, reading: Reading): string {
  while (!stream.eol()) {
    const c = stream.next();
    if (c === "\\") stream.next();
    if (c === '"') {
      reading.inString = false;
      break;
    }
  }
  return "string";
}

function kind(name: string, after: string): string {
  if (keywords.has(name)) return "keyword";
  if (constants.has(name)) return "atom";
  if (name.startsWith("$")) return "variableName.special";
  if (nodeCalled(name) && /^\s*[({]/.test(after)) return "typeName";
  if (functionCalled(name)) return "variableName.standard";
  if (state.design?.materials.some((m) => m.name === name)) return "atom";
  return "variableName";
}

export const vcad = new LanguageSupport(StreamLanguage.define(parser));

const placeholder = (parameter: NodeType["parameters"][0]) =>
  parameter.required || parameter.default === null ? parameter.name : String(JSON.stringify(parameter.default));

function nodeCompletion(node: NodeType): Completion {
  const shown = node.parameters.filter((p) => p.required);
  const template = `${node.name}(${shown.map((p) => `\${${placeholder(p)}}`).join(", ")})`;
  return snippetCompletion(template, { label: node.name, type: "class", detail: node.category, info: () => page(node) });
}

function parametersOf(context: CompletionContext): Completion[] {
  const before = context.state.doc.sliceString(Math.max(0, context.pos - 2000), context.pos);
  let depth = 0;
  for (let n = before.length - 1; n >= 0; --n) {
    if (")]}".includes(before[n])) ++depth;
    if ("([{".includes(before[n]) && --depth < 0) {
      const node = nodeCalled(/([A-Za-z_][\w-]*)\s*$/.exec(before.slice(0, n))?.[1] ?? "");
      return (node?.parameters ?? []).map((p) => ({ label: p.name, apply: `${p.name}=`, type: "property", detail: [p.kind, p.unit].filter(Boolean).join(", "), info: p.doc, boost: 20 }));
    }
  }
  return [];
}

export function complete(context: CompletionContext): CompletionResult | null {
  const word = context.matchBefore(/[A-Za-z_$][\w-]*/);
  if (!word && !context.explicit) return null;
  const hello = state.hello;
  if (!hello) return null;
  const own = new Set(context.state.doc.toString().match(/\b[A-Za-z_]\w{2,}\b/g) ?? []);
  const known = new Set([...hello.nodes.map((n) => n.name), ...hello.functions.map((f) => f.name), ...keywords]);
  return {
    from: word ? word.from : context.pos,
    options: [
      ...parametersOf(context),
      ...hello.nodes.map(nodeCompletion),
      ...hello.functions.map((f) => ({ label: f.name, type: "function", detail: f.signature, apply: `${f.name}(` })),
      ...[...keywords].map((label) => ({ label, type: "keyword" })),
      ...[...own].filter((name) => !known.has(name) && name !== word?.text).map((label) => ({ label, type: "variable", boost: -1 })),
    ],
    validFor: /^[\w$-]*$/,
  };
}

// Returns the reference of a node, as elements.
export function page(node: NodeType): HTMLElement {
  const element = document.createElement("div");
  element.className = "page";
  const add = (tag: string, text: string, to: HTMLElement = element) => {
    const made = document.createElement(tag);
    made.textContent = text;
    to.append(made);
    return made;
  };
  add("strong", node.name);
  add("p", node.sentence);
  const list = add("dl", "");
  for (const p of node.parameters) {
    add("dt", p.name, list);
    const facts = [p.kind, p.unit, p.required ? "required" : p.default === null ? "" : `default ${JSON.stringify(p.default)}`, p.choices.join(" | ")];
    add("dd", `${p.doc} (${facts.filter(Boolean).join(", ")})`, list);
  }
  for (const o of node.outputs) {
    add("dt", `.${o.name}`, list);
    add("dd", `${o.doc} (${o.type})`, list);
  }
  if (node.example) add("pre", node.example);
  return element;
}

export const hover = hoverTooltip((view: EditorView, position: number) => {
  const line = view.state.doc.lineAt(position);
  for (const match of line.text.matchAll(/[A-Za-z_][\w-]*/g)) {
    const from = line.from + match.index!,
      to = from + match[0].length;
    if (position < from || position > to) continue;
    const node = nodeCalled(match[0]),
      call = functionCalled(match[0]);
    if (!node && !call) return null;
    return {
      pos: from,
      end: to,
      create: () => {
        if (node) return { dom: page(node) };
        const dom = document.createElement("div");
        dom.className = "page";
        dom.textContent = call!.signature;
        return { dom };
      },
    };
  }
  return null;
});
