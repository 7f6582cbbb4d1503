// Numbers in the text of an argument, which are changed where they stand.

export interface NumberAt {
  value: number;
  from: number;
  to: number;
}

// A number, or a list of numbers or lists.
export type Nest = NumberAt | Nest[];

export const isNumberAt = (nest: Nest): nest is NumberAt => !Array.isArray(nest);

const token = /\s*(?:([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|([[(])|([\])])|(,))/y;

// Reads a text that has nothing but numbers and lists of them. Returns undefined for all others, such as names and sums.
export function readNumbers(text: string): Nest | undefined {
  const lists: Nest[][] = [[]];
  let wantsValue = true;
  token.lastIndex = 0;
  const end = text.trimEnd().length;
  while (token.lastIndex < end) {
    const found = token.exec(text);
    if (!found) return undefined;
    const [, number, opens, closes, comma] = found;
    if (number !== undefined || opens) {
      if (!wantsValue) return undefined;
      wantsValue = false;
      if (opens) {
        lists.push([]);
        wantsValue = true;
      } else lists.at(-1)!.push({ value: +number, from: token.lastIndex - number.length, to: token.lastIndex });
    } else if (closes) {
      const made = lists.pop()!;
      if (lists.length === 0) return undefined;
      lists.at(-1)!.push(made);
      wantsValue = false;
    } else if (comma) {
      if (wantsValue || lists.length === 1) return undefined;
      wantsValue = true;
    }
  }
  return lists.length === 1 && lists[0].length === 1 ? lists[0][0] : undefined;
}

// Returns the text with other numbers; what stands between them stays.
export function withNumbers(text: string, changes: { at: NumberAt; value: number }[]): string {
  let made = text;
  for (const { at, value } of [...changes].sort((a, b) => b.at.from - a.at.from)) made = made.slice(0, at.from) + String(value) + made.slice(at.to);
  return made;
}

// Rounds to a power of ten that is at most `step`.
export function roundedTo(step: number, value: number): number {
  const digits = Math.max(0, Math.min(12, -Math.floor(Math.log10(step))));
  return +value.toFixed(digits) || 0;
}
