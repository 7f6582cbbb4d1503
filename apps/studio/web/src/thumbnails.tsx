// Small pictures of nodes and values. The server makes them one at a time, for visible entries, so that other questions wait for
// one of them at most.
import { useEffect, useRef, useState } from "preact/hooks";
import { useWhenSeen } from "./seen";
import { connection } from "./session/connection";
import { Shown, state } from "./store";

const size = { width: 48, height: 36 };
const ratio = Math.min(Math.ceil(devicePixelRatio), 2);

interface Wanted {
  design: string;
  of: Shown;
  show: (url: string) => void;
}

let waiting: Wanted[] = [];
let isAtWork = false;

async function work() {
  if (isAtWork) return;
  isAtWork = true;
  for (let next = waiting.shift(); next; next = waiting.shift()) {
    if (next.design !== state.design?.design) continue;
    const { design, of, show } = next;
    const ask = { design, ...named(of), width: ratio * size.width, height: ratio * size.height };
    const reply = await connection.ask("thumbnail", ask).answer.catch(() => undefined); // fails for example for a formula without bounds
    show(reply ? URL.createObjectURL(new Blob([reply.bytes as BlobPart], { type: "image/png" })) : "");
  }
  isAtWork = false;
}

function named(of: Shown) {
  if ("value" in of) return { value: of.value };
  return of.nodes.length === 1 ? { node: of.nodes[0] } : { nodes: of.nodes };
}

// Shows the previous picture until there is a new one.
export function Thumbnail({ of, type }: { of: Shown; type: string }) {
  const design = state.design!.design;
  const [url, setUrl] = useState("");
  const known = useRef("");
  const place = useWhenSeen<HTMLSpanElement>(() => {
    const wanted: Wanted = { design, of, show: (made) => {
      URL.revokeObjectURL(known.current);
      known.current = made;
      setUrl(made);
    } };
    waiting.push(wanted);
    work();
    return () => (waiting = waiting.filter((other) => other !== wanted));
  }, [design, JSON.stringify(named(of))]);
  useEffect(() => () => URL.revokeObjectURL(known.current), []);
  return <span ref={place} class="thumbnail" style={size}>{url && <img src={url} alt={`What ${type} makes`} {...size} />}</span>;
}
