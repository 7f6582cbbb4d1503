// The palette of the graph: nodes and operators with pictures, to be put into the script.
import { useLayoutEffect, useRef } from "preact/hooks";
import { NodePicture } from "../nodepicture";
import { useSearch } from "../search";
import { isDesignFile } from "../session/graph";
import { NodeType, useStore } from "../store";

export type Where = "end" | "inside" | "around" | "after";

// A number of the script, which is no node.
export const numberNode: NodeType = { name: "number", category: "values", sentence: "A number that calls may share.", parameters: [], inputs: { least: 0, most: 0 }, gives: "values", outputs: [], example: "" };

// Design files (JSON) know neither variables nor libraries.
const nodesFor = (nodes: NodeType[]) => (isDesignFile() ? nodes.filter((node) => !node.library) : [numberNode, ...nodes]);

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
  const { found, field } = useSearch(nodesFor(hello?.nodes ?? []), (n) => `${n.name} ${n.category} ${n.sentence}`, "nodes");
  useLayoutEffect(() => panel.current!.querySelector("input")!.focus(), []);
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
              <NodePicture name={node.name} />
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
