// The palette of the graph: nodes and operators with pictures, to be put into the script.
import { useEffect, useRef, useState } from "preact/hooks";
import { useSearch } from "../search";
import { useWhenSeen } from "../seen";
import { connection } from "../session/connection";
import { NodeType, useStore } from "../store";

export type Where = "end" | "inside" | "around" | "after";

const pictures = new Map<string, Promise<string>>(); // addresses, or "" for none, by the names of nodes
let last: Promise<unknown> = Promise.resolve();

// Asks for the picture of a node's example, one after the other.
function pictureOf(name: string): Promise<string> {
  const known = pictures.get(name);
  if (known) return known;
  const made = last.then(async () => {
    const reply = await connection.ask("node_picture", { name, node: 0, width: 96, height: 72 }).answer.catch(() => undefined);
    return reply?.bytes?.length ? URL.createObjectURL(new Blob([reply.bytes as BlobPart], { type: "image/png" })) : "";
  });
  last = made;
  pictures.set(name, made);
  return made;
}

function Picture({ name }: { name: string }) {
  const [url, setUrl] = useState("");
  const place = useWhenSeen<HTMLSpanElement>(() => void pictureOf(name).then(setUrl), [name]);
  return <span class="picture" ref={place}>{url && <img src={url} alt="" width={48} height={36} />}</span>;
}

// A number of the script, which is no node.
export const numberNode: NodeType = { name: "number", category: "values", sentence: "A number that calls may share.", parameters: [], inputs: { least: 0, most: 0 }, gives: "values", outputs: [], example: "" };

interface Props {
  chosen: string; // what is selected; empty: nothing
  where: Where;
  setWhere: (where: Where) => void;
  add: (node: NodeType) => void;
  pull: (event: PointerEvent, node: NodeType) => void;
  close: () => void;
}

export function Palette({ chosen, where, setWhere, add, pull, close }: Props) {
  const { hello } = useStore();
  const panel = useRef<HTMLElement>(null);
  const { found, field } = useSearch([numberNode, ...(hello?.nodes ?? [])], (n) => `${n.name} ${n.category} ${n.sentence}`, "nodes");
  useEffect(() => panel.current!.querySelector("input")!.focus(), []);
  return (
    <section class="palette" aria-label="Palette" ref={panel} onKeyDown={(e) => e.key === "Escape" && close()}>
      {field}
      <label>
        Put it
        <select value={chosen ? where : "end"} onChange={(e) => setWhere(e.currentTarget.value as Where)}>
          <option value="end">at the end</option>
          {chosen && <option value="inside">inside {chosen}</option>}
          {chosen && <option value="around">around {chosen}</option>}
          {chosen && <option value="after">after {chosen}</option>}
        </select>
      </label>
      <ul tabIndex={0} aria-label="Nodes">
        {found.map((node) => (
          <li key={node.name}>
            <button data-node={node.name} title={node.sentence} onPointerDown={(e) => pull(e, node)} onClick={(e) => e.detail === 0 && add(node)}>
              <Picture name={node.name} />
              <span>
                <strong>{node.name}</strong>
                <small>{node.sentence}</small>
              </span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}
