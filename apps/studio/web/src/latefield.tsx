// A field for a text that counts once the field is left.
import { useState } from "preact/hooks";

interface Props {
  type: "text" | "number";
  value: string | number;
  take: (text: string) => void;
  [attribute: string]: unknown;
}

// What is typed is state of the field. Without it, the page would put back the value before whenever it is drawn anew,
// for example at each step of a job.
export function LateField({ value, take, ...attributes }: Props) {
  const [typed, setTyped] = useState<string>();
  return (
    <input {...attributes} value={typed ?? value} onInput={(e) => setTyped(e.currentTarget.value)} onBlur={() => setTyped(undefined)}
           onChange={(e) => {
             setTyped(undefined);
             take(e.currentTarget.value);
           }} />
  );
}
