// What the design is made of, as a tree whose entries lead to the script.
import { useState } from "preact/hooks";
import { reveal } from "./session";
import { Design, GraphNode, state, useStore } from "./store";
import { Thumbnail } from "./thumbnails";

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

const counted = (count: number, noun: string) => `${count} ${noun}${count === 1 ? "" : "s"}`;

// What comes in, and what goes out with its type.
function ports(node: GraphNode): string {
  const type = state.hello?.nodes.find((known) => known.name === node.type);
  const inputs = [node.inputs.length > 0 && counted(node.inputs.length, "solid"), node.values.length > 0 && counted(node.values.length, "value")].filter(Boolean);
  const outputs = type?.gives === "values" ? type.outputs.map((output) => `${output.name}: ${output.type}`).join(", ") : "solid";
  return `${inputs.length > 0 ? `${inputs.join(", ")} ` : ""}→ ${outputs}`;
}

const isSolid = (node: GraphNode) => state.hello?.nodes.find((known) => known.name === node.type)?.gives !== "values";

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
      {!isRepeated && isSolid(node) && <Thumbnail node={node.id} type={node.type} />}
      <button class="node" disabled={node.from === undefined} onClick={() => reveal(node.from!, node.to ?? node.from!)}>
        {node.type}
        <span class="ports">{ports(node)}</span>
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
