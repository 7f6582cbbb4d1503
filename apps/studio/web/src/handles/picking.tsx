// Places on surfaces that a click in the view chooses, and writes into the call that takes them.
import { RefObject } from "preact";
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { Card, Input } from "../graph/model";
import { LateField } from "../latefield";
import { Edit, isDesignFile, moveValues } from "../session/graph";
import { about } from "../session/evaluation";
import { Camera, state } from "../store";
import { bendOf, pickedInputs, whereOf } from "./model";
import { isNumberAt, readNumbers, roundedTo } from "./numbers";
import { Rows, Vec, mapPoint } from "./space";

const mostPixelsOfClick = 4; // a pointer that moves farther turns the view
const usualBend = 20; // degrees; joins facets of a round side, and ends at the edges of a part

const written = (values: number[], old: string) => {
  const list = values.join(", ");
  return old.trimStart().startsWith("[") || isDesignFile() ? `[${list}]` : `(${list})`;
};

// Returns the edit that gives an input a place, or undefined if its place is computed.
function placeEdit(card: Card, input: Input, values: number[]): Edit | undefined {
  if (input.index === undefined) return { edit: "set", item: card.item, name: input.name, value: written(values, "") };
  const where = whereOf(state.graph!, card, input), numbers = where && readNumbers(where.text);
  if (!where || !numbers || isNumberAt(numbers) || !numbers.every(isNumberAt)) return undefined;
  return { edit: "set", item: where.item, index: where.index, value: written(values, where.text) };
}

// Other conditions for the part, which a click takes the place of.
const conditions = ["normal", "min", "max", "kind", "least_area", "most_area"];

// Returns the edits that remove them, the last argument first, so that the others keep their places.
function conditionEdits(card: Card, input: Input): Edit[] {
  const prefix = input.name.replace(/at$/, "");
  const given = card.inputs.filter((one) => one.index !== undefined && conditions.some((name) => prefix + name === one.name));
  return given
    .filter((one) => card.of.arguments[one.index!].name !== "")
    .sort((a, b) => b.index! - a.index!)
    .map((one) => ({ edit: "set", item: card.item, index: one.index }));
}

function bendEdit(card: Card, degrees: string): Edit[] {
  const bend = bendOf(card);
  if (!bend || degrees === "" || +degrees === +bend.text) return [];
  const { index, name } = bend.input;
  return [{ edit: "set", item: card.item, ...(index === undefined ? { name } : { index }), value: degrees }];
}

interface Props {
  canvas: RefObject<HTMLCanvasElement>;
  card: Card;
  inverse: Rows; // from the design to the space of the call
  finest: number; // the step to which numbers are rounded, mm
  members: (camera: Camera) => Record<string, unknown>; // of the request for the picture that is seen
}

export function Picking({ canvas, card, inverse, finest, members }: Props) {
  const [wanted, setWanted] = useState(""); // the name of the input that the next click gives a place
  const [bend, setBend] = useState("");
  const [said, setSaid] = useState("");
  const inputs = pickedInputs(card), input = inputs.find((one) => one.name === wanted);
  const degrees = bend || bendOf(card)?.text || String(usualBend);
  const from = useRef<PointerEvent>(); // the press whose release may be a click
  useLayoutEffect(() => setSaid(""), [card.key]);

  const pick = async (x: number, y: number) => {
    const { clientWidth: width, clientHeight: height } = canvas.current!;
    const pixel = [Math.min(width - 1, Math.max(0, Math.floor(x))), Math.min(height - 1, Math.max(0, Math.floor(y)))];
    try {
      const { at } = await about("seen_at", { width, height, pixel, ...members(state.camera!) }, "seen_at");
      if (!at) return setSaid("There is no surface under the pointer.");
      const values = mapPoint(inverse, at as Vec).map((v) => roundedTo(finest, v));
      const edit = placeEdit(card, input!, values);
      if (!edit) return setSaid(`The script computes ${input!.name}: write a place there first.`);
      setWanted("");
      setSaid(`${input!.name}: ${values.join(", ")} mm`);
      await moveValues(() => [edit, ...bendEdit(card, degrees), ...conditionEdits(card, input!)], { event: "input" });
    } catch (error) {
      setSaid((error as Error).message);
    }
  };

  // Runs at once, so that a click counts as soon as the page says where to click.
  useLayoutEffect(() => {
    const view = canvas.current;
    if (!view || !input) return;
    const press = (event: PointerEvent) => void (from.current = event.button === 0 ? event : undefined);
    const release = (event: PointerEvent) => {
      const begun = from.current;
      from.current = undefined;
      if (!begun || Math.hypot(event.clientX - begun.clientX, event.clientY - begun.clientY) > mostPixelsOfClick) return;
      const box = view.getBoundingClientRect();
      void pick(event.clientX - box.left, event.clientY - box.top);
    };
    const leave = (event: KeyboardEvent) => event.key === "Escape" && setWanted("");
    view.classList.add("picking");
    view.addEventListener("pointerdown", press);
    view.addEventListener("pointerup", release);
    addEventListener("keydown", leave);
    return () => {
      view.classList.remove("picking");
      view.removeEventListener("pointerdown", press);
      view.removeEventListener("pointerup", release);
      removeEventListener("keydown", leave);
    };
  });

  if (inputs.length === 0) return null;
  return (
    <div class="pickbar">
      {inputs.map((one) => (
        <button aria-pressed={one.name === wanted} title={`The next click on the surface gives ${one.name} its place`} onClick={() => setWanted(one.name === wanted ? "" : one.name)}>
          Pick {one.name}
        </button>
      ))}
      {bendOf(card) && (
        <label title="Triangles are linked over edges that bend by at most this angle">
          Bend
          <LateField type="number" min="0" max="180" step="any" aria-label="Greatest bend, degrees" value={degrees} take={setBend} />
        </label>
      )}
      <span role="status">{input ? `Click the surface that ${card.of.variable || card.title} takes.` : said}</span>
    </div>
  );
}
