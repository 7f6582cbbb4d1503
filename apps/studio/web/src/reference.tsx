// The panel of all nodes: their pages and forms.
import { useState } from "preact/hooks";
import { page } from "./language";
import { NodeForm } from "./nodeform";
import { NodePicture } from "./nodepicture";
import { useSearch } from "./search";
import { isDesignFile } from "./session/graph";
import { insert } from "./session/script";
import { NodeType, useStore } from "./store";

function NodePage({ node }: { node: NodeType }) {
  const [isOpen, setIsOpen] = useState(false);
  const writesScript = !isDesignFile(); // nodes of design files (JSON) are added in the graph
  return (
    <details class={`reference node-${node.name}`} onToggle={(e) => setIsOpen(e.currentTarget.open)}>
      <summary>
        <NodePicture name={node.name} />
        <strong>{node.name}</strong> {node.sentence}
      </summary>
      {isOpen && (
        <div>
          <div ref={(element) => element?.replaceChildren(page(node))} />
          {writesScript && node.example && <button onClick={() => insert(node.example, node.library)}>Add the example to the script</button>}
          {writesScript && <NodeForm node={node} />}
        </div>
      )}
    </details>
  );
}

export function Reference() {
  const { hello } = useStore();
  const { found, field } = useSearch(hello?.nodes ?? [], (n) => `${n.name} ${n.category} ${n.sentence}`, "nodes");
  let category = "";
  return (
    <div class="panelbody">
      {field}
      {found.map((node) => {
        const heading = node.category !== category ? node.category : "";
        category = node.category;
        return (
          <>
            {heading && <h2>{heading}</h2>}
            <NodePage key={node.name} node={node} />
          </>
        );
      })}
    </div>
  );
}
