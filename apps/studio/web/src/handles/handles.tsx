// Handles in the views that share the camera, by which the numbers of a call are moved where they are places.
import { RefObject } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { axes, barLength, projected, sightThrough } from "../camera";
import { Card, cardsOf } from "../graph/model";
import { Edit, Stroke, hasGraph, moveValues, readGraph } from "../session/graph";
import { editor, followCaret } from "../session/script";
import { Camera, state, useStore } from "../store";
import { frameOf } from "./frames";
import { Handle, Key, Sight, cardAt, handlesOf, hasPlaces, valuesOf } from "./model";
import { roundedTo, withNumbers } from "./numbers";
import { Picking } from "./picking";
import { Rows, Vec, inverseOf, lengthOf, mapDirection, mapPoint, mapRay, unit } from "./space";

interface Chosen {
  card: Card;
  handles: Handle[];
}

// The last answer of chosenCall, and what it was found for.
let last: { of: unknown[]; chosen?: Chosen } | undefined;

// Returns the call at the caret with its handles, or undefined if it has none.
function chosenCall(): Chosen | undefined {
  const { graph, values, hello } = state;
  if (!graph || !editor || !hasGraph() || graph.text !== editor.text()) return undefined;
  const of = [graph, values, hello, editor.caret()];
  if (last?.of.every((one, n) => one === of[n])) return last.chosen;
  const card = cardAt(cardsOf(graph, () => true), editor.caret());
  last = { of, chosen: card && hasPlaces(card) ? { card, handles: handlesOf(graph, card) } : undefined };
  return last.chosen;
}

const sizeOf = (canvas: HTMLCanvasElement) => ({ width: canvas.clientWidth, height: canvas.clientHeight });

// The factor by which lengths of the frame are longer in the design.
const scaleOf = (frame: Rows) => lengthOf(mapDirection(frame, unit([1, 1, 1]))) || 1;

function sightOf(camera: Camera, canvas: HTMLCanvasElement, frame: Rows): Sight {
  const mm = 1 / scaleOf(frame);
  return { arm: camera.height * 0.2 * mm, finest: (camera.height / canvas.clientHeight) * mm };
}

// Returns numbers that are as fine as can be seen.
const rounded = (handle: Handle, values: number[], finest: number) =>
  values.map((v) => roundedTo(handle.is === "direction" ? 0.001 * (lengthOf(values as Vec) || 1) : finest, v));

// Returns the edits of the text that give a handle its numbers.
function editsFor(key: string, handleKey: string, values: number[]): Edit[] {
  const chosen = chosenCall();
  const handle = chosen?.card.key === key ? chosen.handles.find((h) => h.key === handleKey) : undefined;
  if (!handle) return [];
  const texts = new Map<string, { where: Handle["coordinates"][0]["where"]; changes: Parameters<typeof withNumbers>[1] }>();
  handle.coordinates.forEach(({ where, at }, n) => {
    if (at.value === values[n]) return;
    const id = `${where.item} ${where.index}`;
    const own = texts.get(id) ?? { where, changes: [] };
    own.changes.push({ at, value: values[n] });
    texts.set(id, own);
  });
  return [...texts.values()].map(({ where, changes }) => ({
    edit: "set", item: where.item, ...(where.index === undefined ? { name: where.name } : { index: where.index }), value: withNumbers(where.text, changes),
  }));
}

const told = (handle: Handle, values: number[]) => `${handle.label}: ${values.map((v) => +v.toPrecision(6)).join(", ")}${handle.is === "direction" ? "" : " mm"}`;

const keys: Record<string, { axis: "right" | "down" | "forward"; sign: number }> = {
  ArrowRight: { axis: "right", sign: 1 },
  ArrowLeft: { axis: "right", sign: -1 },
  ArrowUp: { axis: "down", sign: -1 },
  ArrowDown: { axis: "down", sign: 1 },
  PageUp: { axis: "forward", sign: 1 },
  PageDown: { axis: "forward", sign: -1 },
};

// Returns what a key does in a frame, or undefined for other keys.
function keyOf(event: KeyboardEvent, camera: Camera, inverse: Rows): Key | undefined {
  const found = keys[event.key];
  return found && { axis: unit(mapDirection(inverse, axes(camera)[found.axis] as Vec)), sign: found.sign };
}

interface Drag {
  key: string;
  handle: string;
  values: number[];
}

// `members` are those of the request for the picture that is seen; a view without them has no surface to click.
export function Handles({ canvas, members }: { canvas: RefObject<HTMLCanvasElement>; members?: (camera: Camera) => Record<string, unknown> }) {
  const { camera, handles: isShown, design, file, isBusy } = useStore();
  const [, redraw] = useState({});
  const [drag, setDrag] = useState<Drag>();
  const [said, setSaid] = useState({ key: "", text: "" }); // what moved last, of a call
  const frames = useRef(new Map<string, Rows | null>());
  useLayoutEffect(() => followCaret(() => redraw({})), []);
  useEffect(() => void readGraph(), [file, isBusy]);
  useLayoutEffect(() => frames.current.clear(), [file]);
  const chosen = isShown && design && camera && canvas.current ? chosenCall() : undefined;
  if (!chosen || !camera) return <p class="handlestatus" role="status" />;
  const { card, handles } = chosen;
  // While the text is evaluated, places of nodes in it are those of an earlier text.
  const known = !state.isOld && !state.isBusy ? frameOf(state.graph!, card.of) : undefined;
  if (known !== undefined) frames.current.set(card.key, known);
  const frame = frames.current.get(card.key);
  const inverse = frame && inverseOf(frame);
  if (!frame || !inverse) return <p class="handlestatus" role="status">{handles.length > 0 && frame === null ? "Handles are shown where nothing bends the space of a call." : ""}</p>;

  const size = sizeOf(canvas.current!), sight = sightOf(camera, canvas.current!, frame);
  const seenAt = (p: Vec) => projected(camera, size, mapPoint(frame, p));
  const valuesShown = (handle: Handle) => (drag?.key === card.key && drag.handle === handle.key ? drag.values : valuesOf(handle));
  const move = (handle: Handle, values: number[], stroke: Stroke) => {
    setSaid({ key: card.key, text: told(handle, values) });
    return moveValues(() => editsFor(card.key, handle.key, values), stroke);
  };

  const grab = (handle: Handle) => (event: PointerEvent) => {
    if (event.button !== 0) return;
    event.preventDefault();
    event.stopPropagation();
    (event.currentTarget as HTMLElement).focus();
    const begun = valuesOf(handle), seen = seenAt(handle.at(begun, sight));
    if (!seen) return;
    const box = canvas.current!.getBoundingClientRect();
    // The handle keeps its place under the pointer.
    const [dx, dy] = [seen.x - (event.clientX - box.left), seen.y - (event.clientY - box.top)];
    const forward = unit(mapDirection(inverse, axes(camera).forward as Vec));
    const stroke: Stroke = { event: "input" };
    let done: Promise<void> = Promise.resolve();
    const drawTo = (e: PointerEvent) => {
      const ray = mapRay(inverse, sightThrough(camera, size, e.clientX - box.left + dx, e.clientY - box.top + dy));
      const found = handle.follow(begun, ray, forward, sight);
      if (!found) return;
      const values = rounded(handle, found, sight.finest);
      setDrag({ key: card.key, handle: handle.key, values });
      done = move(handle, values, stroke);
    };
    const drop = async () => {
      removeEventListener("pointermove", drawTo);
      removeEventListener("pointerup", drop);
      removeEventListener("pointercancel", drop);
      await done;
      setDrag(undefined);
    };
    addEventListener("pointermove", drawTo);
    addEventListener("pointerup", drop);
    addEventListener("pointercancel", drop);
  };
  const press = (handle: Handle) => (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey) {
      const letter = event.key.toLowerCase();
      if (letter !== "z" && letter !== "y") return;
      letter === "y" || event.shiftKey ? editor!.redo() : editor!.undo();
      return event.preventDefault();
    }
    const key = event.altKey ? undefined : keyOf(event, camera, inverse);
    if (!key) return;
    event.preventDefault();
    event.stopPropagation();
    const amount = barLength(sight.finest * 10) * (event.shiftKey ? 10 : 1);
    const values = handle.step(valuesOf(handle), key, amount).map((v) => +v.toPrecision(12));
    move(handle, handle.is === "direction" ? rounded(handle, values, sight.finest) : values, { event: "input" });
  };

  const shown = handles.map((handle) => ({ handle, values: valuesShown(handle) })).map((one) => ({ ...one, at: seenAt(one.handle.at(one.values, sight)), from: one.handle.from && seenAt(one.handle.from) }));
  return (
    <div class="handles" role="group" aria-label={`Handles of ${card.of.variable || card.title}`}>
      <svg aria-hidden="true">
        {shown.map(({ at, from }) => at && from && <line x1={from.x} y1={from.y} x2={at.x} y2={at.y} />)}
        <Lines places={shown.filter(({ handle }) => handle.is === "point").map(({ handle, at }) => ({ list: handle.key.split(" ")[0], at }))} />
      </svg>
      {shown.map(({ handle, values, at }) => at && (
        <button key={handle.key} class={`handle ${handle.is}`} style={{ left: at.x, top: at.y }} aria-label={told(handle, values)} title={`${told(handle, values)}. Drag it, or press arrows and Page Up and Down.`}
                data-handle={handle.key} onPointerDown={grab(handle)} onKeyDown={press(handle)} />
      ))}
      <p class="handlestatus" role="status">{said.key === card.key ? said.text : ""}</p>
      {members && <Picking canvas={canvas} card={card} inverse={inverse} finest={sight.finest} members={members} />}
    </div>
  );
}

// Lines from each point of a list to the next.
function Lines({ places }: { places: { list: string; at?: { x: number; y: number } }[] }) {
  return (
    <>
      {places.slice(1).map((place, n) => {
        const before = places[n];
        return before.list === place.list && before.at && place.at && <line x1={before.at.x} y1={before.at.y} x2={place.at.x} y2={place.at.y} />;
      })}
    </>
  );
}
