// The cards of a graph: what each shows of a call, its inputs and its outputs.
import { nodeCalled } from "../language";
import { GraphItem, ScriptGraph, keysOf } from "../session/graph";
import { Design, MadeValue, NodeType, Shown, Variable, state } from "../store";

export type PortType = "solid" | "number" | "vector" | "mixture" | "text" | "truth" | "other";
type Parameter = NodeType["parameters"][0];

export interface Input {
  name: string;
  type: PortType;
  index?: number; // of the argument; none if the call does not give it
  text: string;
  parameter?: Parameter;
  isRequired: boolean;
  from: { item: number; output: string }[];
}

export interface Output {
  name: string; // empty: the value itself
  type: PortType;
}

export interface Card {
  item: number;
  key: string; // stays the same when calls elsewhere come and go
  of: GraphItem;
  type?: NodeType;
  title: string;
  inputs: Input[];
  outputs: Output[];
  takesChildren: boolean;
  children: number[]; // items
  isLocked: boolean;
  holds: number; // items within a group
}

// Returns the type of a port for what a parameter or an output says of itself.
export function portType(kind: string): PortType {
  if (/solid/.test(kind)) return "solid";
  if (/mixture|material/.test(kind)) return "mixture";
  if (/truth|bool/.test(kind)) return "truth";
  if (/vector|point|colour|frame|curve|axis|size/.test(kind)) return "vector";
  if (/number|field|value|region|index|integer|formula|radius|length/.test(kind)) return "number";
  if (/text|file|choice|image|one of/.test(kind)) return "text";
  return "other";
}

const areLike = (a: PortType, b: PortType) => a === b || a === "other" || b === "other" || (a === "number" && b === "truth") || (a === "truth" && b === "number") || (a === "text" && b === "mixture") || (a === "number" && b === "vector");
export const fits = (from: PortType, to: PortType) => (from === "solid") === (to === "solid") && areLike(from, to);

function typeOfText(text: string): PortType {
  if (/^[-+]?(\d|\.\d)/.test(text)) return "number";
  if (/^"/.test(text)) return "text";
  if (/^[[(]/.test(text)) return "vector";
  return /^(true|false)$/.test(text) ? "truth" : "other";
}

const isNumber = (text: string) => /^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$/.test(text);
export const numberOf = (text: string) => (isNumber(text) ? +text : undefined);

// A module or a function of the script, as a node.
function definedType(graph: ScriptGraph, name: string): NodeType | undefined {
  const found = graph.definitions.find((d) => d.name === name);
  if (!found) return undefined;
  const parameters = found.parameters.map((p) => ({ name: p.name, doc: "", kind: "", widget: "", unit: "", in_space: "", required: p.default === "", default: p.default || null, choices: [] }));
  return { name, category: "", sentence: "", parameters, inputs: { least: 0, most: found.is_module ? null : 0 }, gives: found.is_module ? "solid" : "values", outputs: [], example: "" };
}

const typeOf = (graph: ScriptGraph, name: string) => definedType(graph, name) ?? nodeCalled(name);

// Calls of plain functions, such as abs(), stay within the texts of their arguments.
const isCard = (graph: ScriptGraph, item: GraphItem) => item.kind !== "value" || typeOf(graph, item.callee) !== undefined;

// Returns the card in which an item stands, and the argument there.
function holderOf(graph: ScriptGraph, item: GraphItem): { item: number; argument: number } {
  let at = item;
  while (!isCard(graph, graph.items[at.parent!])) at = graph.items[at.parent!];
  return { item: at.parent!, argument: at.argument };
}

// Pairs arguments with parameters, as a call does: those without names go to the first parameters that are free.
function inputsOf(item: GraphItem, type: NodeType | undefined): Input[] {
  const inputs: Input[] = [];
  if (item.kind === "part") return inputs;
  if (item.kind === "variable" && item.callee === "") {
    const text = item.arguments[0]?.text ?? "";
    return [{ name: "value", type: typeOfText(text), index: 0, text, isRequired: true, from: [] }];
  }
  const parameters = type?.parameters ?? [];
  const indices = new Map<string, number>();
  const rest: number[] = [];
  item.arguments.forEach((argument, n) => {
    const name = argument.name || parameters.find((p) => !indices.has(p.name) && !item.arguments.some((other) => other.name === p.name))?.name;
    if (name && parameters.some((p) => p.name === name)) indices.set(name, n);
    else rest.push(n);
  });
  for (const p of parameters) {
    const index = indices.get(p.name);
    inputs.push({ name: p.name, type: portType(p.kind || ""), index, text: index === undefined ? "" : item.arguments[index].text, parameter: p, isRequired: p.required, from: [] });
  }
  for (const n of rest) inputs.push({ name: item.arguments[n].name || `value ${n + 1}`, type: typeOfText(item.arguments[n].text), index: n, text: item.arguments[n].text, isRequired: true, from: [] });
  return inputs;
}

function outputsOf(item: GraphItem, type: NodeType | undefined): Output[] {
  if (item.kind === "part") return [];
  if (item.kind === "node") return type?.gives === "values" ? type.outputs.map((o) => ({ name: o.name, type: portType(o.type) })) : [{ name: "", type: "solid" }];
  if (item.kind === "call" || item.kind === "group") return item.callee === "module" ? [] : [{ name: "", type: "solid" }];
  if (item.callee === "") return [{ name: "", type: typeOfText(item.arguments[0]?.text ?? "") }];
  if (type?.gives === "solid") return [{ name: "", type: "solid" }];
  // The first output is what the variable itself means, if it is called the value.
  const named = (type?.outputs ?? []).map((o, n) => ({ name: n === 0 && o.name === "value" ? "" : o.name, type: portType(o.type) }));
  if (named.length === 0) return [{ name: "", type: "other" }];
  return named.some((o) => o.name === "") || named.length > 1 ? named : [{ name: "", type: named[0].type }];
}

const word = (item: GraphItem) => (item.kind === "part" ? "part" : item.callee || item.variable || "value");
const takesSolids = (item: GraphItem, type: NodeType | undefined) =>
  item.kind === "group" || item.kind === "part" || ((item.kind === "call" || item.kind === "node") && (!type || type.inputs.most !== 0));
// Items that have a name which a person may change.
export const isNamed = (item: GraphItem) => item.kind === "variable" || item.kind === "node" || item.kind === "part";

// Returns the cards of a graph. Items in groups are there only if their group is open.
export function cardsOf(graph: ScriptGraph, isOpen: (key: string) => boolean): Card[] {
  const keys = keysOf(graph);
  const cards = new Map<number, Card>();
  graph.items.forEach((item, n) => {
    if (!isCard(graph, item)) return;
    for (let at = item.parent; at !== undefined; at = graph.items[at].parent)
      if (graph.items[at].kind === "group" && !isOpen(keys[at])) {
        const group = cards.get(at);
        if (group) ++group.holds;
        return;
      }
    const type = typeOf(graph, item.callee);
    cards.set(n, {
      item: n, key: keys[n], of: item, type, title: word(item), inputs: item.kind === "group" ? [] : inputsOf(item, type), outputs: outputsOf(item, type), takesChildren: takesSolids(item, type), children: [],
      isLocked: item.locked_by !== "" || item.kind === "group", holds: 0,
    });
  });
  for (const card of cards.values()) connect(graph, card, cards);
  return [...cards.values()];
}

function connect(graph: ScriptGraph, card: Card, cards: Map<number, Card>) {
  const { of } = card;
  for (const wire of of.wires) {
    const input = card.inputs.find((i) => i.index === wire.argument);
    if (input && !input.from.some((f) => f.item === wire.from && f.output === wire.output)) input.from.push({ item: wire.from, output: wire.output });
  }
  card.children.push(...(of.inputs ?? []).filter((input) => cards.has(input)));
  if (of.parent === undefined) return;
  if (of.kind !== "value") return void cards.get(of.parent)?.children.push(card.item);
  const holder = holderOf(graph, of);
  const input = cards.get(holder.item)?.inputs.find((i) => i.index === holder.argument);
  input?.from.push({ item: card.item, output: "" });
}

// Returns what a card stands for: the value of its expression, its own node, or the solids that its statement makes; of the
// definition of a module the solids that its first call makes.
export function shownOf(design: Design, graph: ScriptGraph, card: Card): Shown | undefined {
  const { of } = card;
  if (of.kind === "part") {
    const nodes = design.part_nodes.filter((_, n) => design.parts[n] === of.variable);
    return nodes.length > 0 ? { nodes } : undefined;
  }
  if (of.kind === "variable" || of.kind === "value") {
    // A variable ends with its expression, which may begin with a shorter one.
    const values = design.made.filter((one) => "value" in one && one.from === of.at && one.to <= of.to) as MadeValue[];
    if (values.length > 0) return values.reduce((longest, one) => (one.to > longest.to ? one : longest));
  }
  const own = of.kind === "group" ? undefined : design.nodes.find((node) => node.from === of.at);
  if (own) return { nodes: [own.id] };
  const at = of.callee === "module" ? graph.items.find((item) => item.kind === "call" && item.callee === of.variable)?.at : of.at;
  return design.made.find((one) => "nodes" in one && one.from === at);
}

// Returns the inputs that a card shows when it is not opened: those that are given, or have to be.
export const shownInputs = (card: Card, isOpen: boolean) => (isOpen ? card.inputs : card.inputs.filter((i) => i.index !== undefined || i.isRequired));

// Returns what a slider for a number reaches.
export function rangeOf(card: Card, input: Input, value: number): { min: number; max: number; step: number | "any" } {
  const declared: Partial<Variable> | undefined = card.of.callee === "" ? state.variables.find((v) => v.name === card.of.variable) : (input.parameter as Partial<Variable> | undefined);
  const max = declared?.most ?? (value === 0 ? 10 : 2 * Math.abs(value));
  const min = declared?.least ?? (value < 0 ? -max : 0);
  return { min, max, step: declared?.step ?? (Number.isInteger(value) && max - min >= 10 ? 1 : +((max - min) / 100).toPrecision(1)) };
}

// Returns the arguments of a call that an example makes, as texts by the names of parameters.
function exampleArguments(node: NodeType): Record<string, string> {
  const begin = new RegExp(`(^|[^\\w])${node.name}\\(`).exec(node.example);
  if (!begin) return {};
  const found: Record<string, string> = {};
  let depth = 0, text = "", isString = false, position = 0;
  const put = () => {
    const named = /^\s*([A-Za-z_]\w*)\s*=(?!=)/.exec(text);
    const name = named ? named[1] : node.parameters[position++]?.name;
    const value = (named ? text.slice(named[0].length) : text).trim();
    if (name && value) found[name] = value;
    text = "";
  };
  for (let n = begin.index + begin[0].length; n < node.example.length; ++n) {
    const c = node.example[n];
    if (c === '"' && node.example[n - 1] !== "\\") isString = !isString;
    if (!isString && "([{".includes(c)) ++depth;
    if (!isString && ")]}".includes(c) && --depth < 0) break;
    if (c === "," && depth === 0 && !isString) put();
    else text += c;
  }
  put();
  return found;
}

// Returns the call by which a node begins: with the values of its example where it needs them.
export function startingCall(node: NodeType): string {
  const known = exampleArguments(node);
  const usual: Record<string, string> = { number: "1", material: '"red"', text: '""', boolean: "true" };
  const given = node.parameters.filter((p) => p.required).map((p) => `${p.name} = ${known[p.name] ?? (p.choices[0] ? JSON.stringify(p.choices[0]) : (usual[p.widget] ?? "1"))}`);
  return `${node.name}(${given.join(", ")})`;
}

// Returns a value of an example as JSON, if it is one.
function jsonOf(text: string | undefined): unknown {
  try {
    return JSON.parse((text ?? "").replaceAll("(", "[").replaceAll(")", "]"));
  } catch {
    return undefined;
  }
}

// Returns what a node of a design file begins with, as startingCall does for scripts.
export function startingNode(node: NodeType): string {
  const known = exampleArguments(node);
  const usual: Record<string, unknown> = { number: 1, material: "red", text: "", boolean: true };
  const given = node.parameters.filter((p) => p.required).map((p) => [p.name, jsonOf(known[p.name]) ?? p.choices[0] ?? usual[p.widget] ?? 1]);
  return JSON.stringify({ type: node.name, parameters: Object.fromEntries(given) });
}

// Returns the wanted name, with a number if the text has it already.
export function freeName(wanted: string, text: string): string {
  const isUsed = (name: string) => new RegExp(`\\b${name}\\b`).test(text);
  let name = wanted;
  for (let n = 2; isUsed(name); ++n) name = `${wanted}${n}`;
  return name;
}
