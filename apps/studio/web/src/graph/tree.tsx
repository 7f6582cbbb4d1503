// The nodes of the design as a tree, whose entries lead to the script.
import { useState } from "preact/hooks";
import { reveal } from "../session/script";
import { Design, GraphNode, Port, state, useStore } from "../store";
import { Thumbnail } from "../thumbnails";

const mostShown = 600;

interface Branch {
  node: GraphNode;
  output?: string; // output at which the edge begins
  isRepeated: boolean;
  below: { port: Port; branches: Branch[] }[];
}

// Returns the tree below a node; nodes that are used more than once are shown once.
function branchOf(node: GraphNode, design: Design, seen: Set<number>, output?: string): Branch {
  if (seen.has(node.id)) return { node, output, isRepeated: true, below: [] };
  seen.add(node.id);
  const below = node.ports.map((port) => ({
    port,
    branches: port.from.filter((edge) => design.nodes[edge.node] && seen.size < mostShown).map((edge) => branchOf(design.nodes[edge.node], design, seen, edge.output)),
  }));
  return { node, output, isRepeated: false, below: below.filter(({ branches }) => branches.length > 0) };
}

const typeOf = (node: GraphNode) => state.hello?.nodes.find((known) => known.name === node.type);

// Returns the parameters that may hold nodes, but hold numbers or names.
const freePorts = (node: GraphNode) =>
  (typeOf(node)?.parameters ?? []).filter((parameter) => /field|mixture|solid/.test(parameter.kind) && !node.ports.some((port) => port.name === parameter.name));

function outputs(node: GraphNode): string {
  const type = typeOf(node);
  return type?.gives === "values" ? type.outputs.map((output) => `${output.name}: ${output.type}`).join(", ") : "solid";
}

function Ports({ branch, depth }: { branch: Branch; depth: number }) {
  const free = freePorts(branch.node);
  return (
    <ul>
      {branch.below.map(({ port, branches }) => (
        <li>
          <span class="port">{port.name}: {port.type}</span>
          <ul>{branches.map((b) => <Entry branch={b} depth={depth + 1} />)}</ul>
        </li>
      ))}
      {free.length > 0 && <li class="free">{free.map((parameter) => `${parameter.name}: ${parameter.kind}`).join(" · ")}</li>}
    </ul>
  );
}

function Entry({ branch, depth }: { branch: Branch; depth: number }) {
  const { node, output, isRepeated } = branch;
  const [isOpen, setOpen] = useState(depth < 6);
  const hasPorts = !isRepeated && (branch.below.length > 0 || freePorts(node).length > 0);
  return (
    <li>
      {hasPorts && (
        <button class="fold" aria-expanded={isOpen} aria-label={`Inputs of ${node.type}`} onClick={() => setOpen(!isOpen)}>
          {isOpen ? "▾" : "▸"}
        </button>
      )}
      {!isRepeated && <Thumbnail of={{ nodes: [node.id] }} type={node.type} />}
      <button class="node" disabled={node.from === undefined} onClick={() => reveal(node.from!, node.to ?? node.from!)}>
        {node.type}
        {output && `.${output}`}
        <span class="outputs">→ {outputs(node)}</span>
        <span class="place">{isRepeated ? "see above" : node.line ? `line ${node.line}` : ""}</span>
      </button>
      {isOpen && hasPorts && <Ports branch={branch} depth={depth} />}
    </li>
  );
}

export function TreeView() {
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
