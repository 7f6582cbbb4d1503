// What the design is made of, as a tree whose entries lead to the script.
import { useState } from "preact/hooks";
import { reveal } from "./session";
import { Design, GraphNode, useStore } from "./store";

const mostShown = 600;

interface Branch {
  node: GraphNode;
  isRepeated: boolean;
  below: Branch[];
}

// Nodes that are used more than once are shown once.
function branchOf(node: GraphNode, design: Design, seen: Set<number>): Branch {
  if (seen.has(node.id)) return { node, isRepeated: true, below: [] };
  seen.add(node.id);
  const below: Branch[] = [];
  for (const id of [...node.inputs, ...node.values])
    if (design.nodes[id] && seen.size < mostShown) below.push(branchOf(design.nodes[id], design, seen));
  return { node, isRepeated: false, below };
}

function Entry({ branch, depth }: { branch: Branch; depth: number }) {
  const { node, isRepeated, below } = branch;
  const [isOpen, setOpen] = useState(depth < 6);
  return (
    <li>
      {below.length > 0 && (
        <button class="fold" aria-expanded={isOpen} aria-label={`What ${node.type} is made of`} onClick={() => setOpen(!isOpen)}>
          {isOpen ? "▾" : "▸"}
        </button>
      )}
      <button class="node" disabled={node.from === undefined} onClick={() => reveal(node.from!, node.to ?? node.from!)}>
        {node.type}
        <span class="place">{isRepeated ? "see above" : node.line ? `line ${node.line}` : ""}</span>
      </button>
      {isOpen && below.length > 0 && <ul>{below.map((b) => <Entry branch={b} depth={depth + 1} />)}</ul>}
    </li>
  );
}

export function GraphView() {
  const { design } = useStore();
  const seen = new Set<number>();
  return (
    <section class="view graph" aria-label="Graph">
      <div class="stage scroll" tabIndex={0} role="group" aria-label="Nodes of the design">
        {!design && <p>Nothing yet.</p>}
        <ul class="tree">
          {design && design.part_nodes.map((id, n) => (
            <>
              {design.parts[n] && <li class="part">{design.parts[n]}</li>}
              <Entry branch={branchOf(design.nodes[id], design, seen)} depth={0} />
            </>
          ))}
        </ul>
        {design && seen.size > mostShown && <p>Of {design.nodes.length} nodes, the first {mostShown} are shown.</p>}
      </div>
    </section>
  );
}
