// Places for the cards: what goes in stands to the left of where it goes.
import { Card, shownInputs } from "./model";

export interface Place {
  x: number;
  y: number;
}

export const sizes = { width: 236, head: 44, row: 28, gapX: 70, gapY: 18, slider: 20 };

// A row of a card, from the top.
export interface Row {
  kind: "input" | "children" | "output" | "more";
  n: number; // of the input or output
}

export function rowsOf(card: Card, isOpen: boolean): Row[] {
  const shown = shownInputs(card, isOpen);
  const rows: Row[] = card.inputs.flatMap((input, n) => (shown.includes(input) ? [{ kind: "input" as const, n }] : []));
  if (card.inputs.length > shownInputs(card, false).length) rows.push({ kind: "more", n: 0 });
  if (card.takesChildren) rows.push({ kind: "children", n: 0 });
  card.outputs.forEach((_, n) => rows.push({ kind: "output", n }));
  return rows;
}

export const heightOf = (rows: Row[]) => sizes.head + rows.length * sizes.row + 6;
export const yOfRow = (rows: Row[], kind: Row["kind"], n: number) => sizes.head + (rows.findIndex((r) => r.kind === kind && r.n === n) + 0.5) * sizes.row;

const sources = (card: Card) => [...card.inputs.flatMap((input) => input.from.map((f) => f.item)), ...card.children];

// Returns the places of cards in columns. A card stands one column to the left of the leftmost one that it goes into.
export function tidy(cards: Card[], heights: Map<number, number>): Map<number, Place> {
  const byItem = new Map(cards.map((card) => [card.item, card]));
  const users = new Map<number, number[]>();
  for (const card of cards) for (const from of sources(card)) users.set(from, [...(users.get(from) ?? []), card.item]);
  const depths = new Map<number, number>();
  const depth = (item: number): number => {
    const known = depths.get(item);
    if (known !== undefined) return known;
    depths.set(item, 0); // ends a circle
    const found = Math.max(0, ...(users.get(item) ?? []).map((user) => depth(user) + 1));
    depths.set(item, found);
    return found;
  };
  const most = Math.max(0, ...cards.map((card) => depth(card.item)));
  const bottoms: number[] = Array(most + 1).fill(0);
  const places = new Map<number, Place>();
  const place = (item: number) => {
    const card = byItem.get(item);
    if (!card || places.has(item)) return;
    places.set(item, { x: 0, y: 0 });
    const inputs = sources(card).filter((from) => byItem.has(from) && !places.has(from));
    inputs.forEach(place);
    const height = heights.get(item)!;
    const middles = inputs.map((from) => places.get(from)!.y + heights.get(from)! / 2);
    const wanted = middles.length > 0 ? middles.reduce((a, b) => a + b) / middles.length - height / 2 : 0;
    const column = most - depth(item);
    const y = Math.max(wanted, bottoms[column]);
    bottoms[column] = y + height + sizes.gapY;
    places.set(item, { x: column * (sizes.width + sizes.gapX), y });
  };
  for (const card of cards) if (!users.has(card.item)) place(card.item);
  for (const card of cards) place(card.item);
  return places;
}
