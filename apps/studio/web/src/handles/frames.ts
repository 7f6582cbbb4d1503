// The frames of calls: the map from the space of a call's numbers to that of the design.
import { GraphItem, ScriptGraph } from "../session/graph";
import { GraphNode, state } from "../store";
import { Rows, identity } from "./space";

const nodeOf = (item: GraphItem): GraphNode | undefined => state.design!.nodes.find((node) => node.from === item.at);

// A null frame is one that nobody knows.
const frameOfNode = (node: GraphNode): Rows | null => (node.frame === undefined ? identity : node.frame);

// Returns the frame of the solids in a node.
function frameInside(node: GraphNode): Rows | null {
  const edge = node.ports.find((port) => port.name === "solid" || port.name === "solids")?.from[0];
  return edge ? frameOfNode(state.design!.nodes[edge.node]) : frameOfNode(node);
}

// Returns the frame of a call: that of its node; of a value that is no node the frame of what uses it; of an operator
// that of what stands in the same braces.
export function frameOf(graph: ScriptGraph, item: GraphItem): Rows | null {
  const seen = new Set<GraphItem>();
  let isInside = false; // the item stands in the braces of `at`
  for (let at = item; !seen.has(at); ) {
    seen.add(at);
    const node = nodeOf(at);
    if (node) return isInside ? frameInside(node) : frameOfNode(node);
    isInside = at.kind === "call" || at.kind === "group";
    if (at.kind === "variable") {
      const number = graph.items.indexOf(at);
      const user = graph.items.find((other) => other.wires.some((wire) => wire.from === number));
      if (!user) return null;
      at = user;
    } else if (at.parent !== undefined) {
      at = graph.items[at.parent];
    } else break;
  }
  return state.rotate.every((angle) => angle === 0) ? identity : null;
}
