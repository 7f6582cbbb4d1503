// The handles of a call: which of its numbers are places, and how they follow a line of sight or a key.
import { Card, Input } from "../graph/model";
import { GraphItem, ScriptGraph } from "../session/graph";
import { state } from "../store";
import { Nest, NumberAt, isNumberAt, readNumbers } from "./numbers";
import { Ray, Vec, acrossTo, alongLine, cross, dot, lengthOf, onBall, onPlane, plus, times, turnedAbout, unit } from "./space";

// The place of a number in the script: an argument of an item, and a place in its text.
interface Where {
  item: number;
  index?: number; // none if the call does not give the argument yet
  name: string;
  text: string;
}

export interface Coordinate {
  where: Where;
  at: NumberAt;
}

// How the view shows and moves places. Lengths are mm in the frame of the call.
export interface Sight {
  arm: number; // the length at which directions are drawn
  finest: number; // the step to which numbers are rounded
}

export interface Handle {
  key: string;
  label: string; // "origin of in_box"
  is: "point" | "direction" | "length";
  coordinates: Coordinate[];
  from?: Vec; // where its line begins
  at(values: number[], sight: Sight): Vec;
  // Returns the numbers with which it lies on a line of sight, or undefined if none do. `forward` is the direction of the view.
  follow(values: number[], ray: Ray, forward: Vec, sight: Sight): number[] | undefined;
  step(values: number[], key: Key, amount: number): number[];
}

// An arrow key, as a direction in the frame of the call.
export interface Key {
  axis: Vec;
  sign: number;
}

// The frame of a call's handles, as its arguments say.
interface Surroundings {
  centre: Vec;
  axis?: Vec;
  toward: Vec;
}

const axes: Vec[] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
const turnPerStep = 5;
const origin: Vec = [0, 0, 0];

const withAxes = (values: number[], used: number[]): Vec => used.reduce((p, axis, n) => plus(p, axes[axis], values[n]), origin);

// A place that has coordinates along some of the axes.
function placeHandle(key: string, label: string, coordinates: Coordinate[], used: number[]): Handle {
  return {
    key, label, is: "point", coordinates,
    at: (values) => withAxes(values, used),
    follow(values, ray, forward) {
      const normal = used.length === 3 ? forward : axes[3 - used[0] - used[1]];
      const found = onPlane(ray, withAxes(values, used), normal);
      return found && used.map((axis) => found[axis]);
    },
    step(values, { axis, sign }, amount) {
      // Keys move along one axis, so that the other numbers stay as they are.
      const best = used.reduce((a, b) => (Math.abs(axis[b]) > Math.abs(axis[a]) + 1e-9 ? b : a));
      const way = axis[best] < 0 ? -sign : sign;
      return values.map((v, n) => (used[n] === best ? v + way * amount : v));
    },
  };
}

function directionHandle(key: string, label: string, coordinates: Coordinate[], { centre }: Surroundings): Handle {
  const scaled = (values: number[], direction: Vec) => times(lengthOf(values as Vec) || 1, direction);
  return {
    key, label, is: "direction", coordinates, from: centre,
    at: (values, { arm }) => plus(centre, unit(values as Vec), arm),
    follow: (values, ray, _, { arm }) => scaled(values, onBall(ray, centre, arm, unit(values as Vec))),
    step(values, { axis, sign }) {
      const about = cross(values as Vec, times(sign, axis)); // turns the tip towards where the key points
      return lengthOf(about) < 1e-6 * lengthOf(values as Vec) ? values : turnedAbout(values as Vec, about, turnPerStep);
    },
  };
}

// A length from a point along a direction.
function lengthHandle(key: string, label: string, coordinates: Coordinate[], from: Vec, along: Vec, isSigned: boolean): Handle {
  const limited = (length: number) => (isSigned ? length : Math.max(0, length));
  return {
    key, label, is: "length", coordinates, from,
    at: ([length]) => plus(from, along, length),
    follow(_, ray) {
      const length = alongLine(ray, from, along);
      return length === undefined ? undefined : [limited(length)];
    },
    step: ([length], { axis, sign }, amount) => [limited(length + (dot(axis, along) < -1e-9 ? -sign : sign) * amount)],
  };
}

type Maker = (key: string, label: string, coordinates: Coordinate[], around: Surroundings) => Handle | undefined;

// The handles by what a parameter says of the place of its numbers.
const makers: Record<string, { counts: number[]; isList: boolean; make: Maker }> = {
  point: { counts: [2, 3], isList: true, make: (key, label, c) => placeHandle(key, label, c, c.length === 3 ? [0, 1, 2] : [0, 1]) },
  surface: { counts: [3], isList: false, make: (key, label, c) => placeHandle(key, label, c, [0, 1, 2]) },
  profile: { counts: [2], isList: true, make: (key, label, c) => placeHandle(key, label, c, [0, 2]) },
  direction: { counts: [3], isList: false, make: directionHandle },
  offset: { counts: [1], isList: false, make: (key, label, c, around) => lengthHandle(key, label, c, origin, unit(around.axis ?? [0, 0, 1]), true) },
  radius: { counts: [1], isList: false, make: (key, label, c, around) => lengthHandle(key, label, c, around.centre, acrossTo(around.axis ?? [0, 0, 1], around.toward), false) },
};

const mostHandles = 200;

const textOf = (value: unknown) => (value === null || value === undefined ? "" : JSON.stringify(value).replaceAll(",", ", "));

// A variable is not changed here while a slider of the panel stands for its text.
const isPlainVariable = (item: GraphItem) => item.kind === "variable" && item.callee === "" && item.locked_by === "" && !(item.variable in state.values);

// Returns where the numbers of an input stand: in the call, in the variable that it names, or in the default.
export function whereOf(graph: ScriptGraph, card: Card, input: Input): Where | undefined {
  if (input.index === undefined) {
    const text = textOf(input.parameter?.default) || (input.parameter?.written_default ?? "");
    return text ? { item: card.item, name: input.name, text } : undefined;
  }
  const wire = card.of.wires.find((w) => w.argument === input.index && w.is_whole && w.output === "");
  if (!wire) return { item: card.item, index: input.index, name: input.name, text: input.text };
  const source = graph.items[wire.from];
  return isPlainVariable(source) ? { item: wire.from, index: 0, name: source.variable, text: source.arguments[0].text } : undefined;
}

const numbersIn = (where: Where, nest: Nest[]): Coordinate[] | undefined => (nest.every(isNumberAt) ? (nest as NumberAt[]).map((at) => ({ where, at })) : undefined);

// Three numbers that a call gives one by one, as in translate(5, 0, 0), are one place.
function oneByOne(card: Card, input: Input): Coordinate[] | undefined {
  const rest = card.inputs.filter((i) => !i.parameter && i.index !== undefined);
  const given = [input, ...rest];
  if (given.length !== 3 || given.some((i, n) => card.of.arguments[i.index!].name !== "" || i.index !== input.index! + n)) return undefined;
  const read = given.map((i) => ({ where: { item: card.item, index: i.index, name: i.name, text: i.text }, at: readNumbers(i.text) }));
  return read.every((r) => r.at && isNumberAt(r.at)) ? (read as Coordinate[]) : undefined;
}

// Returns the numbers of each place of an input. One number stands alone.
function placesOf(graph: ScriptGraph, card: Card, input: Input, isList: boolean): Coordinate[][] {
  const where = whereOf(graph, card, input);
  const nest = where && readNumbers(where.text);
  if (!where || !nest) return [];
  if (isNumberAt(nest)) return [(input.index !== undefined && oneByOne(card, input)) || [{ where, at: nest }]];
  const own = numbersIn(where, nest);
  if (own) return [own];
  if (!isList) return [];
  return nest.slice(0, mostHandles).flatMap((one) => {
    const numbers = Array.isArray(one) ? numbersIn(where, one) : undefined;
    return numbers ? [numbers] : [];
  });
}

const kindOf = (input: Input) => input.parameter?.in_space ?? "";
export const valuesOf = (handle: Handle) => handle.coordinates.map((c) => c.at.value);

// Returns the place or direction that an input of this kind gives, if its numbers are known.
function firstOf(graph: ScriptGraph, card: Card, kind: string, skip = 0): Vec | undefined {
  const input = card.inputs.filter((i) => kindOf(i) === kind)[skip];
  const place = input && placesOf(graph, card, input, false)[0];
  return place?.length === 3 ? (place.map((c) => c.at.value) as Vec) : undefined;
}

// Returns the handles of a card; none if the script does not have its numbers as they are.
export function handlesOf(graph: ScriptGraph, card: Card): Handle[] {
  if (card.isLocked) return [];
  const around = { centre: firstOf(graph, card, "point") ?? origin, axis: firstOf(graph, card, "direction"), toward: firstOf(graph, card, "direction", 1) ?? ([1, 0, 0] as Vec) };
  return card.inputs.flatMap((input) => {
    const maker = makers[kindOf(input)];
    if (!maker) return [];
    const places = placesOf(graph, card, input, maker.isList);
    return places.flatMap((coordinates, n) => {
      if (!maker.counts.includes(coordinates.length)) return [];
      const label = `${input.name}${places.length > 1 ? ` ${n + 1}` : ""} of ${card.of.variable || card.title}`;
      return maker.make(`${input.name} ${n}`, label, coordinates, around) ?? [];
    });
  });
}

// The inputs of a card that are places on surfaces, which a click in the view chooses.
export const pickedInputs = (card: Card): Input[] => (card.isLocked ? [] : card.inputs.filter((input) => kindOf(input) === "surface"));

// The greatest bend of linked triangles that a card has or may be given; none if it takes faces of a CAD file.
export function bendOf(card: Card): { input: Input; text: string } | undefined {
  const input = card.inputs.find((one) => one.name === "angle" && one.parameter?.unit === "deg");
  const readsCad = card.inputs.some((one) => /\.(step|stp|iges|igs)"\s*$/i.test(one.text));
  return input && !readsCad ? { input, text: input.index === undefined ? "" : input.text } : undefined;
}

export const hasPlaces = (card: Card) => !card.isLocked && card.inputs.some((input) => kindOf(input) in makers);

// Returns the innermost card at a place of the text.
export function cardAt(cards: Card[], place: number): Card | undefined {
  let found: Card | undefined;
  for (const card of cards) if (card.of.from <= place && place <= card.of.to && (!found || card.of.from >= found.of.from)) found = card;
  return found;
}

