// Small pictures of nodes. The server makes them one at a time, for visible entries, so that other questions wait for
// one of them at most.
import { useEffect, useRef, useState } from "preact/hooks";
import { useWhenSeen } from "./seen";
import { connection } from "./session/connection";
import { state } from "./store";

const size = { width: 48, height: 36 };
const ratio = Math.min(Math.ceil(devicePixelRatio), 2);

interface Wanted {
  design: string;
  nodes: number[]; // solids together, or one node
  show: (url: string) => void;
}

let waiting: Wanted[] = [];
let isAtWork = false;

async function work() {
  if (isAtWork) return;
  isAtWork = true;
  for (let next = waiting.shift(); next; next = waiting.shift()) {
    if (next.design !== state.design?.design) continue;
    const { design, nodes, show } = next;
    const ask = { design, ...(nodes.length === 1 ? { node: nodes[0] } : { nodes }), width: ratio * size.width, height: ratio * size.height };
    const reply = await connection.ask("thumbnail", ask).answer.catch(() => undefined); // fails for example for a formula without bounds
    show(reply ? URL.createObjectURL(new Blob([reply.bytes as BlobPart], { type: "image/png" })) : "");
  }
  isAtWork = false;
}

// Shows the previous picture until there is a new one.
export function Thumbnail({ nodes, type }: { nodes: number[]; type: string }) {
  const design = state.design!.design;
  const [url, setUrl] = useState("");
  const known = useRef("");
  const place = useWhenSeen<HTMLSpanElement>(() => {
    const wanted: Wanted = { design, nodes, show: (made) => {
      URL.revokeObjectURL(known.current);
      known.current = made;
      setUrl(made);
    } };
    waiting.push(wanted);
    work();
    return () => (waiting = waiting.filter((other) => other !== wanted));
  }, [design, nodes.join()]);
  useEffect(() => () => URL.revokeObjectURL(known.current), []);
  return <span ref={place} class="thumbnail" style={size}>{url && <img src={url} alt={`What ${type} makes`} {...size} />}</span>;
}
