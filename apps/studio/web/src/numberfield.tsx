// A field for a number that counts at each key.
import { useState } from "preact/hooks";

interface Props {
  value: number;
  take: (value: number) => void;
  [attribute: string]: unknown;
}

const short = (value: number) => +value.toPrecision(6);

// What is typed stays as it is, such as "13." before "13.25", as long as it is the value.
export function NumberField({ value, take, ...attributes }: Props) {
  const [typed, setTyped] = useState<string>();
  const isTyped = typed === "" || (typed !== undefined && short(+typed) === short(value));
  return (
    <input {...attributes} type="number" step="any" value={isTyped ? typed : short(value)} onBlur={() => setTyped(undefined)}
           onInput={(e) => {
             const text = e.currentTarget.value;
             setTyped(text);
             if (text !== "") take(+text);
           }} />
  );
}
