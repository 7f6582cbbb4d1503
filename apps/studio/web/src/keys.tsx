// Keys of the page as a whole, and the list of all keys.
import { useLayoutEffect, useRef } from "preact/hooks";
import { downloadBundle } from "./files";
import { makeTurntable, takePicture } from "./pictures";
import { State, set, useStore } from "./store";

const views: State["view"][] = ["surface", "slices", "volume", "graph", "all", "planes"];
const panels: State["panel"][] = ["variables", "materials", "export", "reference", "examples"];

const focusOn = (selector: string) => document.querySelector<HTMLElement>(selector)?.focus();

// Keys with Alt, so that plain letters go to the script.
const actions: Record<string, () => void> = {
  KeyE: () => focusOn(".cm-content"),
  KeyV: () => focusOn(".views canvas, .views .stage"),
  KeyS: () => {
    set({ panel: "export" });
    setTimeout(() => focusOn(".panel"));
  },
  KeyP: takePicture,
  KeyT: () => makeTurntable("webm"),
  KeyG: () => makeTurntable("gif"),
  KeyB: downloadBundle,
  KeyK: () => set({ showsKeys: true }),
};

export function listenToKeys() {
  addEventListener("keydown", (event) => {
    if (!event.altKey || event.ctrlKey || event.metaKey) return;
    const number = /^Digit(\d)$/.exec(event.code);
    const chosen = number ? +number[1] - 1 : -1;
    if (number && event.shiftKey && panels[chosen]) set({ panel: panels[chosen] });
    else if (number && !event.shiftKey && views[chosen]) set({ view: views[chosen] });
    else if (actions[event.code] && !event.shiftKey) actions[event.code]();
    else return;
    event.preventDefault();
  });
}

const list: [string, string][] = [
  ["Alt 1 to 6", "surface, slices, volume, graph, all four, the scan"],
  ["Alt Shift 1 to 5", "variables, materials, slicing, nodes, examples"],
  ["Alt E, Alt V, Alt S", "to the script, to the view, to slicing"],
  ["Alt P", "a picture of the view, as PNG"],
  ["Alt T", "a turntable, as WebM; again: stop it"],
  ["Alt G", "a turntable, as GIF; again: stop it"],
  ["Alt B", "the design with its files as a bundle"],
  ["Ctrl S, Ctrl F, Ctrl Space", "in the script: save, find, complete"],
  ["Shift Alt F", "in the script: put lines in their places"],
  ["Escape, then Tab", "in the script: leave it"],
  ["arrows, Shift arrows, + -, Home", "in a view: turn, move, zoom, show all"],
  ["arrows, Page Up, Page Down", "on a handle: move it by a step, with Shift by ten"],
  ["Page Up, Page Down, Enter", "in slices: the layer above or below, what is in the middle"],
];

export function KeysDialog() {
  const { showsKeys } = useStore();
  const dialog = useRef<HTMLDialogElement>(null);
  useLayoutEffect(() => {
    if (showsKeys) dialog.current!.showModal();
  }, [showsKeys]);
  return (
    <dialog ref={dialog} aria-label="Keys" onClose={() => set({ showsKeys: false })}>
      <h2>Keys</h2>
      <dl class="keys">
        {list.map(([keys, what]) => (
          <>
            <dt>{keys}</dt>
            <dd>{what}</dd>
          </>
        ))}
      </dl>
      <form method="dialog"><button>Close</button></form>
    </dialog>
  );
}
