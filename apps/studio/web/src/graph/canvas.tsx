// The graph of a script on a canvas: cards and wires, which are edited by pointer and keys.
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { ask } from "../asking";
import { editGraph, isDesignFile } from "../session/graph";
import { editor, reveal } from "../session/script";
import { NodeType, set, state, useStore } from "../store";
import { CardView, End } from "./card";
import { Place, heightOf, rowsOf, sizes, tidy, yOfRow } from "./layout";
import { Card, cardsOf, fits, freeName, numberOf, shownOf, startingCall, startingNode } from "./model";
import { Palette, Where, numberNode } from "./palette";

// What is kept while the page is open, by files: which cards are opened, and where a person has put some.
const openedIn = new Map<string, Set<string>>();
const movedIn = new Map<string, Map<string, Place>>();
const of = <T,>(kept: Map<string, T>, make: () => T): T => {
  if (!kept.has(state.file)) kept.set(state.file, make());
  return kept.get(state.file)!;
};

interface View {
  x: number;
  y: number;
  zoom: number;
}

interface Laid {
  cards: Card[];
  rows: Map<number, ReturnType<typeof rowsOf>>;
  places: Map<number, Place>;
}

function lay(opened: Set<string>, moved: Map<string, Place>): Laid {
  const cards = state.graph ? cardsOf(state.graph, (key) => opened.has(key)) : [];
  const rows = new Map(cards.map((card) => [card.item, rowsOf(card, opened.has(card.key))]));
  const places = tidy(cards, new Map(cards.map((card) => [card.item, heightOf(rows.get(card.item)!)])));
  for (const card of cards) {
    const own = moved.get(card.key);
    if (own) places.set(card.item, own);
  }
  return { cards, rows, places };
}

interface Line {
  from: Place;
  to: Place;
  type: string;
  child?: number; // a solid that goes into a call
  isDim: boolean;
}

function linesOf({ cards, rows, places }: Laid): Line[] {
  const byItem = new Map(cards.map((card) => [card.item, card]));
  const lines: Line[] = [];
  const add = (from: number, output: string, card: Card, row: "input" | "children", n: number) => {
    const source = byItem.get(from);
    if (!source) return;
    const number = Math.max(0, source.outputs.findIndex((o) => o.name === output));
    const begin = places.get(from)!, end = places.get(card.item)!;
    lines.push({
      from: { x: begin.x + sizes.width, y: begin.y + yOfRow(rows.get(from)!, "output", number) }, to: { x: end.x, y: end.y + yOfRow(rows.get(card.item)!, row, n) },
      type: source.outputs[number]?.type ?? "other", child: row === "children" && !source.isLocked ? from : undefined, isDim: source.isLocked,
    });
  };
  for (const card of cards) {
    card.inputs.forEach((input, n) => input.from.forEach((f) => rows.get(card.item)!.some((r) => r.kind === "input" && r.n === n) && add(f.item, f.output, card, "input", n)));
    for (const child of card.children) add(child, "", card, "children", 0);
  }
  return lines;
}

const curve = (from: Place, to: Place) => {
  const bow = Math.max(30, Math.abs(to.x - from.x) / 2);
  return `M${from.x},${from.y} C${from.x + bow},${from.y} ${to.x - bow},${to.y} ${to.x},${to.y}`;
};

const problem = (text: string) => set({ graphProblem: text });

// Connects two ends of wires.
function connectEnds(a: End, b: End, byItem: Map<number, Card>) {
  const [out, into] = a.side === "output" ? [a, b] : [b, a];
  if (out.side !== "output" || into.side === "output") return problem("a wire goes from an output to an input");
  const source = byItem.get(out.item)!, goal = byItem.get(into.item)!;
  const output = source.outputs[out.n];
  if (into.side === "children") {
    if (output.type !== "solid") return problem(`only solids go into ${goal.title}, and this is a ${output.type}`);
    if (source.of.kind === "node" && output.name) return problem(`${output.name} goes into a solid_of, which goes into ${goal.title}`);
    if (source.of.kind !== "variable" && source.of.kind !== "value") return editGraph({ edit: "move", item: source.item, into: goal.item });
    return editGraph({ edit: "insert", where: "inside", item: goal.item, call: `solid_of(${source.of.variable})` });
  }
  const input = goal.inputs[into.n];
  if (!fits(output.type, input.type)) return problem(`a ${output.type} does not fit ${input.name} of ${goal.title}, which is a ${input.type}`);
  return editGraph({ edit: "connect", source: source.item, output: output.name, item: goal.item, ...(input.index === undefined ? { name: input.name } : { index: input.index }) });
}

// Adds a node to the script. Returns the name of the variable that holds it, if it gives values.
async function addNode(node: NodeType, where: Where, item?: number): Promise<string | undefined> {
  const text = editor!.text();
  const begin = isDesignFile() ? startingNode : startingCall;
  if (node.gives === "solid") {
    await editGraph({ edit: "insert", where: item === undefined ? "end" : where, item, call: begin(node), library: node.library });
    return undefined;
  }
  const name = freeName(node === numberNode ? "number" : `${node.name}_values`, text);
  const value = node === numberNode ? "1" : begin(node);
  return (await editGraph({ edit: "variable", name, value, library: node.library })) ? name : undefined;
}

// Makes a module of calls; their plain numbers become its parameters.
async function group(cards: Card[]) {
  const text = editor!.text(), seen = state.graph;
  const chosen = await ask({ title: "Make a group", text: "The calls become a module of this name. Their numbers become its parameters.", name: freeName("group", text), buttons: ["Group"] });
  if (!chosen) return;
  const names: string[] = [];
  const parameters = cards.flatMap((card) => card.inputs.filter((i) => i.index !== undefined && numberOf(i.text) !== undefined).map((input) => {
    // A parameter hides a variable of its name, which other arguments may need.
    names.push(freeName(input.name, [...names, chosen.name, ...state.graph!.items.map((item) => item.variable)].join(" ")));
    return { item: card.item, argument: input.index! };
  }));
  await editGraph({ edit: "group", items: cards.map((card) => card.item), name: chosen.name, parameter_items: parameters.map((p) => p.item), parameter_arguments: parameters.map((p) => p.argument), parameter_names: names }, "input", seen);
}

// A module at the top level, which may become a library.
const isModule = (card: Card | undefined) => card?.of.kind === "group" && card.of.callee === "module" && card.of.parent === undefined;

// Moves a module into a file beside the script, from which other designs can use it.
async function saveAsLibrary(card: Card) {
  const module = card.of.variable;
  const chosen = await ask({ title: "Save as a library", text: `The module ${module} moves into a file beside this one. Other designs use it by a line use <${module}.vcad>.`, name: `${module}.vcad`, buttons: ["Save"] });
  if (!chosen) return;
  const path = /\.vcad$/.test(chosen.name) ? chosen.name : `${chosen.name}.vcad`;
  await editGraph({ edit: "library", module, path, sentence: `${module[0].toUpperCase()}${module.slice(1)}, from ${state.file || "a script"}.` });
}

const directions: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

// Returns the nearest card in a direction.
function neighbour(laid: Laid, from: Card, [dx, dy]: [number, number]): Card | undefined {
  const middle = (card: Card) => {
    const place = laid.places.get(card.item)!;
    return { x: place.x + sizes.width / 2, y: place.y + heightOf(laid.rows.get(card.item)!) / 2 };
  };
  const here = middle(from);
  const cost = (card: Card) => {
    const there = middle(card), x = there.x - here.x, y = there.y - here.y;
    const along = x * dx + y * dy, across = Math.abs(x * dy) + Math.abs(y * dx);
    return along < 10 ? Infinity : along + 2 * across;
  };
  const best = laid.cards.filter((card) => card !== from).sort((a, b) => cost(a) - cost(b))[0];
  return best && cost(best) < Infinity ? best : undefined;
}

type Drag =
  | { kind: "pan"; x: number; y: number; view: View }
  | { kind: "card"; x: number; y: number; card: Card; place: Place; isMoved: boolean }
  | { kind: "wire"; x: number; y: number; end: End; isMoved: boolean }
  | { kind: "new"; x: number; y: number; node: NodeType; isMoved: boolean };

export function CanvasView() {
  const { graph, graphProblem, graphMade, file, design, isOld } = useStore();
  const stage = useRef<HTMLDivElement>(null);
  const [view, setView] = useState<View>({ x: 20, y: 20, zoom: 1 });
  const [selected, setSelected] = useState<string[]>([]);
  const [focus, setFocus] = useState("");
  const [pending, setPending] = useState<End>();
  const [rubber, setRubber] = useState<{ x: number; y: number; node?: NodeType; end?: End }>();
  const [showsPalette, setShowsPalette] = useState(false);
  const [where, setWhere] = useState<Where>("inside");
  const [, redraw] = useState({});
  const opened = of(openedIn, () => new Set<string>()), moved = of(movedIn, () => new Map<string, Place>());
  const laid = lay(opened, moved);
  const byItem = new Map(laid.cards.map((card) => [card.item, card]));
  const chosen = laid.cards.filter((card) => selected.includes(card.key));
  const focused = laid.cards.find((card) => card.key === focus) ?? laid.cards[0];
  const lines = linesOf(laid);

  const fit = () => {
    const box = stage.current!.getBoundingClientRect();
    const rights = laid.cards.map((c) => laid.places.get(c.item)!.x + sizes.width), bottoms = laid.cards.map((c) => laid.places.get(c.item)!.y + heightOf(laid.rows.get(c.item)!));
    const left = Math.min(0, ...laid.cards.map((c) => laid.places.get(c.item)!.x)), top = Math.min(0, ...laid.cards.map((c) => laid.places.get(c.item)!.y));
    const zoom = Math.max(0.25, Math.min(1, (box.width - 40) / (Math.max(1, ...rights) - left), (box.height - 40) / (Math.max(1, ...bottoms) - top)));
    setView({ x: 20 - zoom * left, y: 20 - zoom * top, zoom });
  };
  const zoomBy = (factor: number, x = stage.current!.clientWidth / 2, y = stage.current!.clientHeight / 2) =>
    setView((old) => {
      const zoom = Math.max(0.2, Math.min(2, old.zoom * factor)), ratio = zoom / old.zoom;
      return { zoom, x: x - ratio * (x - old.x), y: y - ratio * (y - old.y) };
    });
  const onCanvas = (x: number, y: number): Place => {
    const box = stage.current!.getBoundingClientRect();
    return { x: (x - box.left - view.x) / view.zoom, y: (y - box.top - view.y) / view.zoom };
  };
  const open = (card: Card) => {
    if (!opened.delete(card.key)) opened.add(card.key);
    redraw({});
  };
  const openPalette = () => setShowsPalette(true);
  const closePalette = () => {
    setShowsPalette(false);
    stage.current!.querySelector<HTMLElement>(".card[tabindex='0']")?.focus();
  };

  // The whole graph is seen when a file is opened; later edits leave the view where it is.
  useLayoutEffect(() => {
    if (graph) fit();
  }, [file, graph === undefined]);
  // What was added is chosen.
  useLayoutEffect(() => {
    if (graphMade === undefined) return;
    const made = laid.cards.find((card) => card.of.from === graphMade);
    set({ graphMade: undefined });
    if (!made) return;
    setSelected([made.key]);
    setFocus(made.key);
    editor!.putCaret(made.of.from);
    setWhere("inside");
  }, [graphMade, graph]);
  useLayoutEffect(() => {
    const roll = (event: WheelEvent) => {
      event.preventDefault();
      const box = stage.current!.getBoundingClientRect();
      if (event.ctrlKey) zoomBy(Math.exp(-event.deltaY / 300), event.clientX - box.left, event.clientY - box.top);
      else setView((old) => ({ ...old, x: old.x - event.deltaX, y: old.y - event.deltaY }));
    };
    stage.current!.addEventListener("wheel", roll, { passive: false });
    return () => stage.current?.removeEventListener("wheel", roll);
  }, []);

  const onPort = (end: End) => {
    if (!pending) return setPending(end);
    setPending(undefined);
    if (pending.item !== end.item || pending.side !== end.side || pending.n !== end.n) connectEnds(pending, end, byItem);
  };
  const endAt = (element: Element | null): End | undefined => {
    const words = element?.closest<HTMLElement>("[data-end]")?.dataset.end?.split(" ");
    return words && { item: +words[0], side: words[1] as End["side"], n: +words[2] };
  };
  const cardAt = (element: Element | null) => {
    const item = element?.closest<HTMLElement>("[data-item]")?.dataset.item;
    return item === undefined ? undefined : byItem.get(+item);
  };

  const dropWire = (end: End, element: Element | null) => {
    const other = endAt(element);
    if (other) return connectEnds(end, other, byItem);
    const card = cardAt(element);
    if (card && end.side === "output" && card.takesChildren && card.item !== end.item) return connectEnds(end, { item: card.item, side: "children", n: 0 }, byItem);
    const source = byItem.get(end.item);
    const mayLeave = source?.of.kind === "node" || (source?.of.kind === "call" && source.of.parent !== undefined);
    if (!card && end.side === "output" && source?.outputs[end.n].type === "solid" && mayLeave) return editGraph({ edit: "move", item: end.item });
  };
  const dropNode = async (node: NodeType, element: Element | null) => {
    const end = endAt(element), card = cardAt(element), wire = element?.closest<SVGElement>("[data-child]")?.dataset.child;
    if (node.gives !== "solid") {
      const name = await addNode(node, "end");
      const item = name === undefined ? undefined : state.graph?.items.findIndex((i) => i.variable === name);
      if (!name || item === undefined || end?.side !== "input") return;
      // The new variable comes before or after the card's item.
      const goal = end.item + (item <= end.item ? (state.graph!.items.length - graph!.items.length) : 0);
      const input = byItem.get(end.item)!.inputs[end.n];
      return void editGraph({ edit: "connect", source: item, output: node.outputs[0]?.name ?? "", item: goal, ...(input.index === undefined ? { name: input.name } : { index: input.index }) });
    }
    if (wire !== undefined) return void addNode(node, "around", +wire);
    if (card?.takesChildren && !card.isLocked) return void addNode(node, "inside", card.item);
    if (card) return void addNode(node, node.inputs.most === 0 ? "after" : "around", card.item);
    addNode(node, "end");
  };

  const begin = (event: PointerEvent, drag: Drag) => {
    if (event.button !== 0) return;
    const move = (e: PointerEvent) => {
      const dx = e.clientX - drag.x, dy = e.clientY - drag.y;
      if (drag.kind === "pan") return setView({ ...drag.view, x: drag.view.x + dx, y: drag.view.y + dy });
      drag.isMoved ||= Math.abs(dx) + Math.abs(dy) > 4;
      if (!drag.isMoved) return;
      if (drag.kind === "card") {
        moved.set(drag.card.key, { x: drag.place.x + dx / view.zoom, y: drag.place.y + dy / view.zoom });
        return redraw({});
      }
      setRubber({ ...onCanvas(e.clientX, e.clientY), ...(drag.kind === "new" ? { node: drag.node } : { end: drag.end }) });
    };
    const drop = (e: PointerEvent) => {
      removeEventListener("pointermove", move);
      removeEventListener("pointerup", drop);
      removeEventListener("pointercancel", drop);
      setRubber(undefined);
      if (e.type === "pointercancel") return;
      const element = document.elementFromPoint(e.clientX, e.clientY);
      if (drag.kind === "wire") drag.isMoved ? dropWire(drag.end, element) : onPort(drag.end);
      if (drag.kind === "new" && !drag.isMoved) add(drag.node);
      else if (drag.kind === "new" && stage.current!.contains(element)) dropNode(drag.node, element);
      if (drag.kind === "card" && !drag.isMoved) choose(drag.card, e.shiftKey || e.ctrlKey);
    };
    addEventListener("pointermove", move);
    addEventListener("pointerup", drop);
    addEventListener("pointercancel", drop);
  };
  const choose = (card: Card, isMore: boolean) => {
    setSelected((old) => (isMore ? (old.includes(card.key) ? old.filter((key) => key !== card.key) : [...old, card.key]) : [card.key]));
    setFocus(card.key);
    editor!.putCaret(card.of.from);
    stage.current!.querySelector<HTMLElement>(`[data-item="${card.item}"]`)?.focus();
  };
  const add = (node: NodeType) => addNode(node, chosen.length === 1 ? where : "end", chosen.length === 1 ? chosen[0].item : undefined);

  const leave = (event: KeyboardEvent) => {
    if (event.key !== "Escape") return;
    setPending(undefined);
    setRubber(undefined);
    (event.currentTarget as HTMLElement).focus();
    event.stopPropagation();
  };
  const onCardKey = (card: Card) => (event: KeyboardEvent) => {
    if (event.target !== event.currentTarget) return leave(event);
    const element = event.currentTarget as HTMLElement;
    if (directions[event.key] && !event.altKey) {
      const next = neighbour(laid, card, directions[event.key]);
      if (next) choose(next, event.shiftKey);
    } else if (event.key === "Delete" || event.key === "Backspace") {
      editGraph({ edit: "remove", item: card.item, keeps_children: event.shiftKey });
    } else if (event.key === "Enter") {
      const field = element.querySelector<HTMLElement>(".row input:not([type=range]):not(:disabled), .row select:not(:disabled)");
      (field ?? element.querySelector<HTMLElement>("button"))?.focus();
    } else if (event.key === " ") {
      choose(card, true);
    } else if (event.key === "Escape") {
      setPending(undefined);
      setSelected([]);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  };
  const onStageKey = (event: KeyboardEvent) => {
    const isInField = (event.target as Element).matches("input, select");
    const isUndo = (event.ctrlKey || event.metaKey) && !isInField;
    if (isUndo && event.key.toLowerCase() === "z") event.shiftKey ? editor!.redo() : editor!.undo();
    else if (isUndo && event.key.toLowerCase() === "y") editor!.redo();
    else if (isInField || event.altKey || event.ctrlKey) return;
    else if (event.key === "a" || event.key === "Insert") openPalette();
    else if (event.key === "+") zoomBy(1.2);
    else if (event.key === "-") zoomBy(1 / 1.2);
    else if (event.key === "Home") fit();
    else return;
    event.preventDefault();
  };

  const isShown = design !== undefined && !isOld;
  const isStale = graph !== undefined && editor !== undefined && graph.text !== editor.text();
  const rubberLine = rubber?.end && portPlace(laid, rubber.end);
  const label = chosen.length === 1 ? chosen[0].of.variable || chosen[0].title : "";

  return (
    <section class="view graph" aria-label="Graph" data-stale={isStale}>
      <div class="viewbar">
        <button aria-expanded={showsPalette} onClick={() => (showsPalette ? closePalette() : openPalette())} title="Nodes and operators (A)">Add…</button>
        <button disabled={chosen.length === 0 || isDesignFile()} onClick={() => group(chosen)} title="Make a module of the chosen calls, which follow each other">Group…</button>
        <button disabled={chosen.length !== 1 || !isModule(chosen[0])} onClick={() => saveAsLibrary(chosen[0])} title="Move the chosen module into a file that other designs can use">Save as library…</button>
        <button disabled={chosen.length !== 1 || chosen[0].isLocked && chosen[0].of.locked_by !== ""} onClick={() => editGraph({ edit: "remove", item: chosen[0].item, keeps_children: true })} title="Remove it and keep its children (Shift Delete)">Unwrap</button>
        <button disabled={chosen.length !== 1} onClick={() => editGraph({ edit: "remove", item: chosen[0].item })} title="Remove it (Delete)">Remove</button>
        <button onClick={() => (moved.clear(), fit(), redraw({}))} title="Put the cards in their columns again">Tidy</button>
        <span class="controls">
          <button aria-label="Smaller" onClick={() => zoomBy(1 / 1.2)}>−</button>
          <button title="Show all" onClick={fit}>{Math.round(100 * view.zoom)} %</button>
          <button aria-label="Larger" onClick={() => zoomBy(1.2)}>+</button>
        </span>
        <span class="pending" role="status">{pending ? `A wire from ${byItem.get(pending.item)?.of.variable || byItem.get(pending.item)?.title}: choose its other end, or press Escape.` : ""}</span>
      </div>
      <div class="canvasrow">
        {showsPalette && <Palette chosen={label} where={where} setWhere={setWhere} add={add} close={closePalette} pull={(e, node) => (e.preventDefault(), begin(e, { kind: "new", x: e.clientX, y: e.clientY, node, isMoved: false }))} />}
        <div class="stage canvas" ref={stage} tabIndex={0} role="group" aria-label={isDesignFile() ? "Nodes of the design" : "Calls of the script"} onKeyDown={onStageKey}
             onPointerDown={(e) => e.target instanceof Element && !e.target.closest(".card, .wirehit") && (setSelected([]), setPending(undefined), begin(e, { kind: "pan", x: e.clientX, y: e.clientY, view }))}>
          {laid.cards.length === 0 && <p class="empty">{graph ? "The script makes nothing yet. Add a node: press A, or Add." : state.file ? "The graph comes as soon as the script has no mistakes." : "Add a node, and a design begins."}</p>}
          <div class="world" style={{ transform: `translate(${view.x}px, ${view.y}px) scale(${view.zoom})` }}>
            <svg class="wires" aria-hidden="true">
              {lines.map((line) => (
                <>
                  <path class={`wire type-${line.type}${line.isDim ? " dim" : ""}`} d={curve(line.from, line.to)} />
                  {line.child !== undefined && <path class="wirehit" data-child={line.child} d={curve(line.from, line.to)} />}
                </>
              ))}
              {rubber && rubberLine && <path class="wire rubber" d={rubber.end!.side === "output" ? curve(rubberLine, rubber) : curve(rubber, rubberLine)} />}
            </svg>
            {laid.cards.map((card) => (
              <CardView key={card.key} card={card} place={laid.places.get(card.item)!} rows={laid.rows.get(card.item)!} shown={isShown && graph ? shownOf(design, graph, card) : undefined} isOpen={opened.has(card.key)} isSelected={selected.includes(card.key)} isFocus={card === focused}
                        pending={pending} onFocus={() => setFocus(card.key)} onPort={onPort} onOpen={() => open(card)} onKey={onCardKey(card)} onLine={() => reveal(card.of.from, card.of.to)}
                        onGrab={(e) => !(e.target as Element).closest("button, input") && begin(e, { kind: "card", x: e.clientX, y: e.clientY, card, place: laid.places.get(card.item)!, isMoved: false })}
                        onPull={(e, end) => (e.preventDefault(), e.stopPropagation(), begin(e, { kind: "wire", x: e.clientX, y: e.clientY, end, isMoved: false }))} />
            ))}
            {rubber?.node && <span class="ghost" style={{ left: rubber.x, top: rubber.y }}>{rubber.node.name}</span>}
          </div>
          {graphProblem && <p class="graphproblem error" role="alert">{graphProblem} <button onClick={() => problem("")}>Close</button></p>}
          {graph?.is_cut && <p class="viewproblem">The script has more calls than are shown.</p>}
        </div>
      </div>
    </section>
  );
}

// Returns the place of an end of a wire.
function portPlace({ places, rows }: Laid, end: End): Place | undefined {
  const place = places.get(end.item), own = rows.get(end.item);
  return place && own && { x: place.x + (end.side === "output" ? sizes.width : 0), y: place.y + yOfRow(own, end.side, end.n) };
}
