// The view of the graph: of a script or a design file that can be edited there its calls, else the nodes of the design.
import { useEffect } from "preact/hooks";
import { hasGraph, readGraph } from "../session/graph";
import { useStore } from "../store";
import { CanvasView } from "./canvas";
import { TreeView } from "./tree";

export function GraphView() {
  const { file, isBusy } = useStore();
  useEffect(() => {
    readGraph();
  }, [file, isBusy]);
  return hasGraph() ? <CanvasView /> : <TreeView />;
}
